"""The tables of cases, one file for each rule of the checker."""

from tests.certificates.checker.rules import (
    boxes,
    cases_and_signs,
    close,
    counterexample,
    definitions,
    division,
    have_and_root,
    integral,
    iterates,
    point,
    psatz,
    sharp,
    text,
    use,
    witness,
)

MODULES = (
    close,
    psatz,
    cases_and_signs,
    boxes,
    integral,
    use,
    have_and_root,
    witness,
    point,
    counterexample,
    definitions,
    division,
    sharp,
    iterates,
    text,
    definitions,
)
TABLES = {module.__name__.rsplit(".", 1)[1]: module for module in MODULES}
