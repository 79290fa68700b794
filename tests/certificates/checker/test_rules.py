"""Every rule, from its tables: certificates that it accepts, and defects that it rejects with the
reason that names them.
"""

from __future__ import annotations

import pytest

from tests.certificates.checker.harness import Case, judge, refused
from tests.certificates.checker.rules import TABLES


def named(table: str) -> list[object]:
    return [
        pytest.param(case, id=f"{rule}: {case.defect}")
        for rule, module in TABLES.items()
        for case in getattr(module, table)
    ]


@pytest.mark.parametrize("case", named("ACCEPTED"))
def test_accepts(case: Case) -> None:
    assert judge(case) == (case.expected, None)


@pytest.mark.parametrize("case", named("REJECTED"))
def test_rejects(case: Case) -> None:
    outcome, reason = judge(case)
    assert outcome in ("rejected", "unreadable")
    assert refused(reason, case.expected), reason


def test_every_case_has_a_name_of_its_own() -> None:
    for module in TABLES.values():
        defects = [case.defect for case in [*module.ACCEPTED, *module.REJECTED]]
        assert len(set(defects)) == len(defects)
