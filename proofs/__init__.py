"""What the paper says, as claims; the command that derives, proves and checks them; and the
language for claims of one's own.

    encoding              SymPy expressions as terms
    forms                 claims as statements: for all, there is, maximum, supremum
    claims                a claim, its body and its verdict
    reading               the reader of prints
    paper, theorem, part  the claims, section by section
    ledger                what the paper prints, item by item
    derivations           what a claim rests on in `symbolic`
    rules                 what follows from map rules
    ranges                sharp ranges
    correcting            the correction of a refuted print
    judging               the verdict of one claim
    kept                  what is kept between runs
    register              the verdicts that stand
    run                   many claims over processes
    bounds                certified enclosures of minima
    smtlib                problems in SMT-LIB
    reports               reports of what was proved
    api, pytest_plugin    certify from Python and in pytest
    command               the command `juggleproof`
"""

from juggleproof.certificates.language import (
    ClaimError,
    Formula,
    Iterates,
    MapRule,
    Statement,
    Term,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    implies,
    real,
    reals,
    term,
)
from juggleproof.proofs.claims import Argument, Assertion, Claim, Following, Readings, claim
from juggleproof.proofs.forms import always, exists_some

__all__ = [
    "Argument",
    "Assertion",
    "Claim",
    "ClaimError",
    "Following",
    "Formula",
    "Iterates",
    "MapRule",
    "Readings",
    "Statement",
    "Term",
    "always",
    "claim",
    "conjunction",
    "different",
    "disjunction",
    "equal",
    "exists_some",
    "iff",
    "implies",
    "real",
    "reals",
    "term",
]
