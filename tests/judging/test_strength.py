"""Counterexamples within what their section assumes, and strict ones, come first."""

from __future__ import annotations

from fractions import Fraction

import pytest

from juggleproof.judging import limits
from juggleproof.judging.searches import ClaimSearch
from juggleproof.judging.strength import Strength, loosened, refuted_more_strongly, strength_of
from juggleproof.papers.paper import opened
from juggleproof.proofs.paper.names import assumed
from juggleproof.reports.errata import point_of, told_outside
from juggleproof.statements.formulas import Formula, equal, iff, implies
from juggleproof.statements.language import NO_ROLES, Roles, Statement, real
from juggleproof.statements.store import DEFAULT, Store
from juggleproof.statements.work import read
from tests.rows import each_row

alpha, x, y = real("alpha"), real("x"), real("y")
ONLY_NUMBERS = {  # goals that fail by equality alone, with the reason
    "s2.2.1-H/kept-without-impact": "the height vanishes at the edge",
    "s3.5-fixed-points-of-f/of-f.main": "an equation has no witness",
    "s3.5.3-locally-stable/same-pieces.main": "the state is on the edge between two pieces",
    "s3.5.3-locally-stable/conclusion.main": "the state is on the edge between two pieces",
    "s4.3.1-DK-negative/main": "(alpha^2 - 1) z2^2 vanishes at most",
    "s4.3.1-LaSalle/falls-at-impacts.main": "(alpha^2 - 1) z2^2 vanishes at most",
}


@each_row(
    "goal, loose",
    [
        (x < y, x <= y),
        ((x > y) & ~(x >= y), (x >= y) & ~(x > y)),
        (implies(x <= y, (x < y) | equal(x, 1)), implies(x <= y, (x <= y) | equal(x, 1))),
        (iff(x < y, y > 0), iff(x < y, y > 0)),
    ],
)
def test_a_loosened_goal_follows_from_the_goal_holds(goal: Formula, loose: Formula) -> None:
    assert str(loosened(goal)) == str(loose)


@each_row(
    "at, value, strength",
    [
        (Fraction(1, 4), 1, Strength(True, False)),
        (Fraction(1, 4), 2, Strength(True, True)),
        (Fraction(1, 2), 2, Strength(False, True)),
    ],
)
def test_strength_of_a_point_holds(at: Fraction, value: int, strength: Strength) -> None:
    text = "statement demo/falls\nforall alpha x\nshow x^2 < x"
    point = {"alpha": at, "x": Fraction(value)}
    assert strength_of(text, point, (alpha < Fraction(1, 3),)) == strength


def test_the_strongest_is_sought_first_and_nothing_weaker_than_what_is_known_holds() -> None:
    statement = Statement("demo/falls", ("alpha", "x"), show=x**2 < x)

    def sought(than: Strength) -> list[tuple[bool, str]]:
        return [
            (bool(one.lines), str(one.show))
            for one in refuted_more_strongly(statement, (alpha < Fraction(1, 3),), than)
        ]

    every = [(True, "x^2 <= x"), (True, "x^2 < x"), (False, "x^2 <= x")]
    assert sought(Strength(False, False)) == every
    assert sought(Strength(False, True)) == every[:2]
    assert sought(Strength(True, False)) == every[:1]
    assert sought(Strength(True, True)) == []


def test_counterexamples_of_the_paper_are_within_what_their_section_assumes_holds() -> None:
    store, claims = Store(DEFAULT), {claim.id: claim for claim in opened().claims()}
    weak = set()
    for name, text in store.texts.items():
        refuted = (store.certificate(name, text) or {}).get("refuted")
        if refuted is None or name.split("/")[0] not in claims:
            continue
        point = point_of(text, refuted)
        assert point is not None, name
        within, strict = strength_of(text, point, claims[name.split("/")[0]].assumed)
        assert within, name
        weak |= set() if strict else {name}
    assert weak == {*ONLY_NUMBERS}


def test_section_4_assumes_21_and_section_3_does_not_holds() -> None:
    assert [str(one) for one in assumed("4.2")] == ["alpha < 1/3"] == [*map(str, assumed("A.3.1"))]
    assert assumed("3.5.3") == () == assumed("B.2")


def test_what_lies_outside_is_told_holds() -> None:
    within = (alpha < Fraction(1, 3),)
    assert told_outside(within, Strength(True, False)) == ""
    told = " The section assumes alpha < 1/3; there no counterexample is known."
    assert told_outside(within, Strength(False, True)) == told


def test_a_trial_that_runs_out_refutes_nothing_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    """As one that ended the run, with what it could not decide."""
    statement = Statement("demo/falls", ("x",), show=x**2 < x)
    search = ClaimSearch(10**6, None, (), (), NO_ROLES, {}, {}, {}, {}, is_trial=True)
    parsed = read(statement.text(), statement.name)
    assert search.is_refuted_by_sampling(parsed)
    monkeypatch.setattr(limits, "QUICK_WORK", 1)
    assert not search.is_refuted_by_sampling(parsed)


def test_a_refutation_becomes_strict_and_within_what_is_assumed_holds() -> None:
    statement = Statement(
        "demo/falls", ("alpha", "x"), (("given", alpha > 0), ("given", x > 0)), show=x**2 < x
    )
    roles = Roles({"alpha": (alpha > 0,)})
    parsed = read(statement.text(), statement.name)

    def found(*assumed: Formula) -> dict[str, str]:
        search = ClaimSearch(10**6, None, (), assumed, roles, {}, {}, {}, {}, is_trial=False)
        return dict(search.certificate(statement, parsed, False, "")["refuted"].terms)

    assert Fraction(found()["x"]) > 1
    within = found(alpha < Fraction(1, 3))
    assert Fraction(within["alpha"]) < Fraction(1, 3) and Fraction(within["x"]) > 1
