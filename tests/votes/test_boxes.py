"""The boxes' votes: never wrong on the corpus, decisive on bounded strict statements, an enclosure
where equality is attained.
"""

from fractions import Fraction
from functools import cache

import pytest

from juggleproof.statements.vote import Vote, VoteBudget
from juggleproof.votes import box_search, boxes
from juggleproof.votes.questions import Atom, questions, read_statement
from tests.rows import each_row
from tests.votes.corpus import FALSE, STATEMENTS, TRUE
from tests.votes.independent import fails_at

BOUNDED_AND_STRICT = [
    "square",
    "circle",
    "p-outside-R",
    "e1-in-R",
    "sup-negative",
    "third-outside-loses",
    "third-f1-R-in-R",
    "third-physical-f1-R",
    "third-near-in-B1",
]
ATTAINED = ["bump", "third-gain-at-most-max", "third-B1-plus-in-Emax"]


@cache
def vote_on(name: str) -> Vote:
    return boxes.vote(STATEMENTS[name][0])


def vote(*rows: str, budget: VoteBudget | None = None) -> Vote:
    return boxes.vote(read_statement("\n".join(("statement t/t", *rows))), None, budget)


@each_row("name", STATEMENTS)
def test_no_vote_is_wrong(name: str) -> None:
    expected, cast = STATEMENTS[name][1], vote_on(name)
    assert cast.answer != ("fails" if expected else "holds"), str(cast)
    assert cast.work <= VoteBudget().boxes + 64
    if cast.answer == "fails":
        assert fails_at(FALSE[name], cast.model)
    if cast.answer == "enclosed":
        assert all(e.high - e.low <= e.wanted + Fraction(2, 1 << 20) for e in cast.enclosures)


@each_row("name", BOUNDED_AND_STRICT)
def test_bounded_strict_statements_are_decided(name: str) -> None:
    cast = vote_on(name)
    assert cast.answer == "holds" and cast.work > 0 and "boxes discarded" in cast.detail


@each_row("name", ATTAINED)
def test_attained_bounds_are_enclosed_around_zero(name: str) -> None:
    cast = vote_on(name)
    (enclosure,) = cast.enclosures
    assert cast.answer == "enclosed" and enclosure.low <= 0 <= enclosure.high
    assert enclosure.high - enclosure.low <= VoteBudget().width + Fraction(2, 1 << 20)


def test_the_width_is_the_one_that_is_asked_for() -> None:
    rows = ("forall x", "given -1 <= x and x <= 2", "show x^4 - 2*x^2 + 1 + (x - 1)^2*(x + 2) >= 0")
    for width in (Fraction(1, 4), Fraction(1, 256)):
        cast = vote(*rows, budget=VoteBudget(width=width))
        assert cast.answer in ("enclosed", "holds")
        assert all(
            e.low <= 0 <= e.high and e.high - e.low <= width + Fraction(2, 1 << 20)
            for e in cast.enclosures
        )


@each_row(
    "rows, reason",
    [
        (("forall x", "given x >= 0", "show x^2 + 1 > x - 1/2*x^3"), "not bounded in x"),
        (("forall x", "exists y", "show y > x"), "exist"),
        (("forall K", "integer K", "given 0 <= K and K <= 1", "show K < 3/2"), "integer"),
    ],
)
def test_what_boxes_cannot_do_has_its_reason(rows: tuple[str, ...], reason: str) -> None:
    cast = vote(*rows)
    assert cast.answer == "holds" or cast.answer == "not applicable" and reason in cast.detail


def test_an_unbounded_true_statement_is_not_applicable() -> None:
    cast = vote("forall x y", "given x >= 0 and y >= 0", "show x*y + 1 > x - x^2*y")
    assert cast.answer in ("not applicable", "fails")
    assert (
        vote("forall x y", "show x^4 + y^2 + 1 > x").answer == "holds"
    )  # its denial bounds both variables


def test_an_undecided_comparison_is_no_vote(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(box_search, "surely", lambda value, relation: None)
    monkeypatch.setattr(box_search, "ball_ends", lambda value: None)
    for name in ("circle", "square", "e1-in-R"):
        assert boxes.vote(STATEMENTS[name][0], None, VoteBudget(boxes=200)).answer != "holds"


def test_touching_the_edge_of_a_fact_decides_nothing() -> None:
    assert (
        vote(
            "forall x y", "given 0 <= x and x <= 1 and 0 <= y and y <= 1", "show x + y + x*y < 3"
        ).answer
        != "holds"
    )
    assert (
        vote("forall x y", "given x^2 + y^2 <= 1 and x + y >= 0", "show 5*x + 12*y < 13").answer
        != "holds"
    )
    assert (
        vote(
            "forall x y", "given x^2 + y^2 <= 1 and x + y >= 0", "show 5*x + 12*y < 13 + 1/4"
        ).answer
        == "holds"
    )


def test_counted_boxes_end_as_unknown() -> None:
    cast = boxes.vote(STATEMENTS["third-f1-R-in-R"][0], None, VoteBudget(boxes=32))
    assert cast.answer == "unknown" and cast.work <= 128


def test_every_discarded_box_is_counted() -> None:
    box = ((1, 1, -1), (1, 1, -1))
    found = box_search.refute(
        [fact_of("forall x y", "given x*y + x - 3 > 0")], box, 100, lambda point: False
    )
    assert found.empty and found.boxes >= found.leaves > 0
    wide = ((0, 4, 0), (0, 4, 0))
    found = box_search.refute(
        [fact_of("forall x y", "given x*y + x - 3 > 0")], wide, 100, lambda point: True
    )
    assert found.point is not None and not found.empty


def fact_of(*rows: str) -> Atom:
    (question,) = questions(read_statement("\n".join(("statement t/t", *rows, "show 0 = 1"))))
    (fact,) = question.assumed
    assert isinstance(fact, Atom)
    return fact


def test_votes_do_not_depend_on_the_precision_set_outside_and_leave_it() -> None:
    flint = pytest.importorskip("flint")
    before = vote_on("circle")
    with flint.ctx.workprec(200):
        assert boxes.vote(STATEMENTS["circle"][0]) == before and flint.ctx.prec == 200


def test_true_statements_are_many() -> None:
    assert sum(vote_on(name).answer == "holds" for name in TRUE) >= 18
