"""The work of a check is its own: no other check can spend it, put it back, or see it."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind, Rejected, Work, settling
from juggleproof.certificates.checker.rules import State, prove
from tests.certificates.checker.harness import CLOSE, lines, proof, refused

POWER = lines("forall x", "show (x + 1)^60 - (x + 1)^60 = 0", "")
(STATEMENT,) = checker.read_statements(POWER.rstrip() + "\n").values()
CERTIFICATE = proof(CLOSE, at={"x": "0"})


def outcome(limit: int) -> tuple[str, Kind | None]:
    found, reason = checker.check_one(STATEMENT, CERTIFICATE, {}, {}, Work(limit))
    return found, reason.kind if reason else None


def least() -> int:
    """The least limit within which the certificate is accepted."""
    low, high = 0, checker.MAX_WORK
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if outcome(middle)[0] == "certified" else (middle, high)
    return high


def test_a_check_ends_where_its_own_work_does() -> None:
    needed = least()
    assert 1000 < needed < checker.MAX_WORK
    assert outcome(needed) == ("certified", None)
    assert outcome(needed - 1) == ("rejected", Kind.WORK)


def test_checks_at_once_do_not_disturb_each_other() -> None:
    needed = least()
    limits = [needed, needed - 1] * 40
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(outcome, limits))
    assert found == [("certified", None), ("rejected", Kind.WORK)] * 40


def test_a_check_inside_another_spends_nothing_of_it() -> None:
    outer = Work(10**6)
    context = checker.Context(work=outer)
    context.declare("x")
    before = outer.left
    assert outcome(checker.MAX_WORK) == ("certified", None)
    assert outer.left == before
    context.polynomial("(x + 1)^9")
    assert outer.left < before


def test_what_is_made_in_a_check_holds_its_meter() -> None:
    work = Work(500)
    context = checker.Context(work=work)
    context.declare("x")
    inner = checker.Context(context)
    poly = inner.polynomial("x^2 + 3*x - 1/2")
    results = [poly + poly, poly - poly, poly * poly, -poly, poly**3, poly**0, poly.primitive()[1]]
    assert all(one.work is work for one in results)
    state = State(inner)
    assert all(one.context.work is work for one in (state.branch(), *state.by_sign("x")))
    with pytest.raises(Rejected) as info:
        inner.polynomial("(x + 1)^100")
    assert refused(info.value, Kind.WORK)


def test_an_orbit_rule_has_one_meter_for_all_premises() -> None:
    shift = ("forall x K", "integer K", "iterates x -> x + 1", "after K -> x + K")
    (statement,) = checker.read_statements(lines(*shift)).values()
    done = {"certified": {name: ["proof", [], CLOSE] for name in ("start", "step")}}
    limits = [
        limit
        for limit in range(2000)
        if checker.check_one(statement, done, {}, {}, Work(limit))[0] == "certified"
    ]
    parts = []
    for premise in checker.premises_of(statement, {}).values():
        work = Work()
        prove(premise, ["proof", [], CLOSE], {}, work=work)
        parts.append(checker.MAX_WORK - work.left)
    assert limits[0] == sum(parts) > max(parts)


def test_all_statements_of_a_folder_have_one_meter(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What one has spent, those after it have not; a statement alone has at most MAX_WORK."""
    names = ["a/a", "a/b", "a/c"]
    texts = [POWER.replace("rule/case", name) for name in names]
    entries = [
        json.dumps([name, json.loads(json.dumps(CERTIFICATE).replace("rule/case", name))])
        for name in names
    ]
    (tmp_path / checker.STATEMENTS).write_text("\n".join(texts))
    (tmp_path / checker.CERTIFICATES).write_text("\n".join(entries) + "\n")
    for enough in range(4):
        monkeypatch.setattr(settling, "MAX_FOLDER_WORK", enough * least() + least() // 2)
        outcomes = [outcome for _, outcome, _ in checker.check_folder(str(tmp_path))]
        assert outcomes == (["certified"] * enough + ["rejected"] * 3)[:3]
