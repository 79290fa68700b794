"""Votes against checked outcomes: agreement passes, a contradiction stops with both sides in one
line.
"""

import pickle

import pytest

from juggleproof.statements.vote import Disagreement, Vote, VoteBudget, compare
from juggleproof.votes import boxes, z3
from juggleproof.votes.casting import cast_votes
from juggleproof.votes.questions import read_statement
from tests.rows import each_row
from tests.votes.corpus import STATEMENTS

HOLDS = Vote("z3", "holds", "unsat")
FAILS = Vote("z3", "fails", "sat", model=(("alpha", "1/2"), ("x", "0")))


@each_row(
    "outcome, cast",
    [
        ("certified", HOLDS),
        ("refuted", FAILS),
        ("unknown", HOLDS),
        ("unknown", FAILS),
        ("refuted", Vote("z3", "unknown", "")),
        ("certified", Vote("boxes", "not applicable", "")),
        ("refuted", Vote("boxes", "enclosed", "")),
    ],
)
def test_what_does_not_contradict_passes(outcome: str, cast: Vote) -> None:
    compare("a/b", outcome, [cast])


@each_row(
    "outcome, cast, parts",
    [
        ("refuted", HOLDS, ("refuted", "z3 says holds")),
        ("certified", FAILS, ("certified", "z3 says fails at alpha = 1/2, x = 0")),
    ],
)
def test_a_contradiction_names_statement_route_both_sides_and_model(
    outcome: str, cast: Vote, parts: tuple[str, ...]
) -> None:
    with pytest.raises(Disagreement) as caught:
        compare("claim/main", outcome, [cast])
    message = str(caught.value)
    assert (
        message.startswith("claim/main: ")
        and "\n" not in message
        and all(part in message for part in parts)
    )


def test_two_routes_that_contradict_each_other_stop_even_where_nothing_is_checked() -> None:
    with pytest.raises(Disagreement, match="z3 says holds.*boxes says fails"):
        compare("a/b", "unknown", [HOLDS, Vote("boxes", "fails", "an exact point")])


def test_a_disagreement_passes_between_processes() -> None:
    first = Disagreement("a/b", "one side", "the other")
    again = pickle.loads(pickle.dumps(first))
    assert str(again) == str(first) == "a/b: one side, but the other"


@each_row(
    "name", ["circle", "third-f1-R-in-R", "trap", "circle-half", "kinetic-decreases", "sup-is-sup"]
)
def test_both_routes_agree_with_what_is_known(name: str) -> None:
    statement, expected = STATEMENTS[name]
    z3_vote, boxes_vote = cast_votes(statement, "certified" if expected else "refuted")
    assert z3_vote.decided and (z3_vote.route, boxes_vote.route) == ("z3", "boxes")
    assert pickle.loads(pickle.dumps((z3_vote, boxes_vote))) == (z3_vote, boxes_vote)


@each_row("name", ["circle", "circle-half"])
@each_row("route", ["z3", "boxes"])
def test_a_wrong_outcome_is_contradicted_by_either_route(name: str, route: str) -> None:
    statement, expected = STATEMENTS[name]
    with pytest.raises(Disagreement, match=statement.name):
        cast_votes(statement, "refuted" if expected else "certified", (route,))


def test_a_route_gone_wrong_is_stopped_by_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    statement = read_statement("statement t/t\nforall x\ngiven 0 <= x and x <= 1\nshow x < 2")
    monkeypatch.setattr(z3, "vote", lambda *rest: Vote("z3", "fails", "sat", model=(("x", "3"),)))
    with pytest.raises(Disagreement, match=r"t/t: z3 says fails at x = 3 .*, but boxes says holds"):
        cast_votes(statement, "unknown")
    monkeypatch.setattr(boxes, "vote", lambda *rest: Vote("boxes", "unknown", ""))
    with pytest.raises(
        Disagreement, match="the checked certificate says certified, but z3 says fails"
    ):
        cast_votes(statement, "certified")


def test_only_the_routes_named_are_asked() -> None:
    statement, _ = STATEMENTS["square"]
    assert [cast.route for cast in cast_votes(statement, "certified", ("exact", "boxes"))] == [
        "boxes"
    ]
    assert cast_votes(statement, "certified", ()) == ()
    assert cast_votes(statement, "certified", ("z3",), VoteBudget(rlimit=1))[0].answer in (
        "unknown",
        "holds",
    )
