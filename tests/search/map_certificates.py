"""Finds the certificates of the checker's tests of map rules anew, and writes `maps.json`.

python -m tests.search.map_certificates          # or with another file to be written

The tests themselves say which texts they ask for: they are run with the search in place of the
file.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.search.certificate import search_premises
from juggleproof.search.ranges import Violation
from juggleproof.statements.language import NO_ROLES
from juggleproof.statements.store import canonical, write_file
from juggleproof.statements.work import Budget
from tests.certificates.checker import maps
from tests.certificates.checker.maps import FOUND, Json, key, read

BUDGET = 40_000
ROOT = Path(__file__).resolve().parents[2]
ASKING = (  # the files of tests that read what was found
    "tests/certificates/checker/test_definitions.py",
    "tests/certificates/checker/test_map_rules.py",
    "tests/certificates/checker/test_returns.py",
    "tests/certificates/checker/test_settles.py",
    "tests/command/test_check.py",
)


def search(text: str) -> Json:
    """A proof of each premise of the last statement, or the first premise that has none."""
    *earlier, (_, statement) = read(text).items()
    known = dict(earlier)
    premises, proofs = checker.premises_of(statement, known), {}

    def is_false(name: str) -> bool:
        violation = Violation.of(premises[name], None, NO_ROLES)
        return violation.absent_everywhere(Budget(BUDGET)) is False

    for name, proof in search_premises(premises, known, BUDGET, is_false=is_false):
        if proof is None:
            return {"unknown": f"no proof of the premise {name} was found"}
        proofs[name] = proof
    return {"certified": proofs}


def find() -> dict[str, Json]:
    """What the search finds for all texts that the tests ask for, by their keys.

    Raises RuntimeError where one of these tests fails.
    """
    found: dict[str, Json] = {}

    def certificate_of(text: str) -> Json:
        if key(text) not in found:
            found[key(text)] = search(text)
        return found[key(text)]

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(maps, "certificate_of", certificate_of)
        options = ["-q", "-n", "0", "-p", "no:cacheprovider"]
        if code := pytest.main([*options, *(str(ROOT / one) for one in ASKING)]):
            raise RuntimeError(f"a test of {', '.join(ASKING)} failed: pytest ended with {code}")
    return found


if __name__ == "__main__":
    write_file(Path(sys.argv[1]) if len(sys.argv) > 1 else FOUND, canonical(find()))
