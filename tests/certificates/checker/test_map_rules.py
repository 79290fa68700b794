"""The map rules on two other maps: accepted as they are, rejected with the premise's name where one
premise fails, and nothing can be left out.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind
from juggleproof.certificates.checker.rules import prove
from tests.certificates.checker.harness import Expected, refused
from tests.certificates.checker.maps import ASKED, SUBTRACT, TURN, checked, edited, read, searched

Json = Any

ON = "on x < 1\npoint 0\nweights 1\nrate a\nradius 1/2\nsize 1"
# (statement, what stands there, what is put in its place, the premise that fails)
FAILING = [
    ("map", "domain a > 0 and a <= 1", "domain a > 0 and a < 0", "possible"),
    ("map", "space x >= 0", "space x >= 0 and x < 0", "possible"),
    ("map", "piece x >= 1", "piece x > 1", "covers"),
    ("map", "piece x < 1", "piece x <= 1", "apart-2-1"),
    ("map", "x - 1", "x - 2", "stays-1"),
    ("map", "a*x", "-a*x", "stays-2"),
    ("descends", "domain a > 0 and a < 1", "domain a > 0 and a < 0", "possible"),
    ("descends", "domain a > 0 and a < 1", "domain a > 0 and a < 2", "inside"),
    ("descends", "rank x", "rank x - 1", "bounded"),
    ("descends", "rank x", "rank x/2", "falls-1"),
    ("descends", "stage x < 1", "stage x < 1/2", "falls-2"),
    ("descends", "stage x < 1", "stage x < 1 or x > 9", "stage-1-1"),
    ("descends", "stage x < 1", "stage x < 1\nstage x < 1/4", "stage-1-2"),
    ("contracts", "domain a > 0 and a < 1", "domain a > 0 and a < 0", "possible"),
    ("contracts", "domain a > 0 and a < 1", "domain a > 0 and a < 1 or a = 2", "inside"),
    ("contracts", "rate a", "rate 1", "constants"),
    ("contracts", "weights 1", "weights 0", "constants"),
    ("contracts", "radius 1/2", "radius 0", "constants"),
    ("contracts", "point 0", "point -1", "point"),
    ("contracts", "radius 1/2", "radius 2", "surrounds"),
    ("contracts", "size 1", "size 1/2", "size"),
    ("contracts", "on x < 1", "on x < 1 or x = 3", "size"),
    ("contracts", ON, ON.replace("x < 1", "x < 1 or x = 3").replace("size 1", "size 3"), "stays-1"),
    ("contracts", ON, ON.replace("x < 1", "x < 3/2").replace("size 1", "size 2"), "closer-1"),
    ("contracts", "on x < 1", "on x <= 1/2 or x > 3/4 and x < 1", "stays-2"),
    ("contracts", "rate a", "rate a/2", "closer-2"),
    ("escapes", "start 1/2", "start 0", "start"),
    ("escapes", "start 1/2", "start 3/2", "start"),
    ("escapes", "word 2", "word 1", "start"),
    ("escapes", "domain a = 1", "domain a = 2", "inside"),
    ("escapes", "domain a = 1", "domain a < a", "possible"),
]
# What joins two statements fails through the one or the other: (statement changed, from, to,
# statement that fails, premise)
JOINS = [
    ("contracts", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "attracts", "inside"),
    ("contracts", "on x < 1", "on x < 3/4", "attracts", "enters"),
    ("escapes", "point 0", "point 1/3", "exactly", "same-point"),
    ("descends", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "exactly", "covers"),
]


@pytest.mark.parametrize("text", [SUBTRACT, TURN], ids=["subtract", "turn"])
def test_every_rule_holds_on_another_map(text: str) -> None:
    results = checked(text, searched(text))
    assert {outcome for outcome, _ in results.values()} == {"certified"}, results


@pytest.mark.parametrize(
    ("kind", "old", "new", "premise"),
    FAILING,
    ids=[f"{row[0]}: {row[3]} ({row[2][:24]})" for row in FAILING],
)
def test_a_rule_fails_without_its_premise(kind: str, old: str, new: str, premise: str) -> None:
    text, name = edited(SUBTRACT, kind, old, new), f"demo/{kind}"
    assert searched(text)[name] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(text, searched(SUBTRACT))[name]
    assert outcome == "rejected" and reason is not None
    assert reason.place.startswith("premise ") or reason.kind is Kind.PREMISES


@pytest.mark.parametrize(
    ("kind", "old", "new", "joined", "premise"), JOINS, ids=[f"{row[3]}: {row[4]}" for row in JOINS]
)
def test_joined_statements_fail_without_what_joins_them(
    kind: str, old: str, new: str, joined: str, premise: str
) -> None:
    text = edited(SUBTRACT, kind, old, new)
    found = searched(text)
    assert found[f"demo/{joined}"] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(
        text, {**found, f"demo/{joined}": searched(SUBTRACT)[f"demo/{joined}"]}
    )[f"demo/{joined}"]
    assert outcome == "rejected" and reason is not None
    assert reason.place == f"premise {premise} of demo/{joined}"


def test_the_premises_of_every_rule_are_these() -> None:
    """Word for word: what a rule writes is what its conclusion rests on."""
    statements = read(ASKED)
    premises = [
        premise.text() + "\n"
        for statement in statements.values()
        for premise in checker.premises_of(statement, statements).values()
    ]
    assert "\n".join(premises) == Path(__file__).with_name("premises.txt").read_text()


def test_rejects_a_contraction_of_another_map_of_the_same_text() -> None:
    copy = SUBTRACT.split("\n\n")[0].replace("demo/map", "demo/copy")
    text = copy + "\n\n" + edited(SUBTRACT, "contracts", "map demo/map", "map demo/copy")
    results = checked(
        text, {**searched(SUBTRACT), **searched(text.split("statement demo/attracts")[0])}
    )
    assert results["demo/descends"] == results["demo/contracts"] == ("certified", None)
    outcome, reason = results["demo/attracts"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.OTHER_MAP, "demo/attracts"))


def test_rejects_an_escape_of_another_map_of_the_same_text() -> None:
    copy = SUBTRACT.split("\n\n")[0].replace("demo/map", "demo/copy")
    text = copy + "\n\n" + edited(SUBTRACT, "escapes", "map demo/map", "map demo/copy")
    results = checked(text, {**searched(SUBTRACT), **searched(copy)})
    assert results["demo/attracts"] == results["demo/escapes"] == ("certified", None)
    outcome, reason = results["demo/exactly"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.OTHER_MAP, "demo/exactly"))


def test_rejects_one_name_for_the_roots_of_two_terms() -> None:
    """c is 2 in the descent and 1 in the contraction: read as one, x < 2 would lie in x < 1."""
    text = edited(
        SUBTRACT, "descends", "rank x\nstage x < 1", "root c = sqrt(4)\nrank x\nstage x < c"
    )
    text = edited(text, "contracts", "on x < 1", "root c = sqrt(1)\non x < c")
    results = checked(
        text, {**searched(SUBTRACT), **searched(text.split("statement demo/attracts")[0])}
    )
    assert results["demo/descends"] == results["demo/contracts"] == ("certified", None)
    statements = read(text)
    enters = checker.premises_of(statements["demo/attracts"], statements)["enters"]
    with pytest.raises(checker.Rejected) as info:
        prove(enters, ["proof", [], ["close"]], {})
    assert refused(info.value, (Kind.VARIABLE_TWICE, "c"))


def test_rejects_a_missing_or_left_over_premise() -> None:
    for name, certificate in searched(SUBTRACT).items():
        for premise in certificate["certified"]:
            fewer = {
                "certified": {
                    key: proof for key, proof in certificate["certified"].items() if key != premise
                }
            }
            outcome, reason = checked(SUBTRACT, {**searched(SUBTRACT), name: fewer})[name]
            assert outcome == "rejected"
            assert refused(reason, (Kind.PREMISES, f"['{premise}']"))
        more = {"certified": {**certificate["certified"], "falls-9": ["proof", [], ["close"]]}}
        _, reason = checked(SUBTRACT, {**searched(SUBTRACT), name: more})[name]
        assert refused(reason, (Kind.PREMISES, "['falls-9']"))


def test_rejects_whatever_rests_on_what_is_not_certified() -> None:
    after = {
        "map": {"descends", "contracts", "attracts", "escapes", "exactly"},
        "descends": {"attracts", "exactly"},
        "contracts": {"attracts", "exactly"},
        "attracts": {"exactly"},
        "escapes": {"exactly"},
        "exactly": set(),
    }
    for kind, resting in after.items():
        without = {name: one for name, one in searched(SUBTRACT).items() if name != f"demo/{kind}"}
        lost = {
            name
            for name, (outcome, _) in checked(SUBTRACT, without).items()
            if outcome != "certified"
        }
        assert lost == {f"demo/{one}" for one in {kind, *resting}}


MALFORMED = [
    (
        "descends",
        "map demo/map",
        "map demo/descends",
        (Kind.EARLIER, "map demo/descends"),
    ),  # a circle
    (
        "descends",
        "map demo/map",
        "map demo/contracts",
        (Kind.EARLIER, "map demo/contracts"),
    ),
    (
        "attracts",
        "demo/contracts",
        "demo/descends",
        (Kind.EARLIER, "contracts "),
    ),
    (
        "exactly",
        "demo/attracts",
        "demo/exactly",
        (Kind.EARLIER, "attracts "),
    ),
    (
        "map",
        "a*x",
        "a*x, x",
        Kind.PIECE,
    ),
    (
        "map",
        "a*x",
        "a*x_next",
        Kind.PIECE,
    ),
    (
        "map",
        "a*x",
        "a*distance",
        Kind.PIECE,
    ),
    (
        "map",
        "x < 1",
        "x < 1 and z > 0",
        Kind.PIECE,
    ),
    (
        "map",
        "x < 1",
        "(x < 1, x < 2)",
        Kind.PIECE,
    ),
    (
        "descends",
        "rank x",
        "rank x_next + x",
        (Kind.UNDECLARED, "x_next", "premise bounded of demo/descends"),
    ),
    ("descends", "rank x", "rank z", (Kind.UNDECLARED, "z", "premise bounded of demo/descends")),
    (
        "descends",
        "stage x < 1",
        "stage x_next < 1",
        (Kind.UNDECLARED, "x_next", "premise falls-1 of demo/descends"),
    ),
    (
        "descends",
        "rank x",
        "rank 0 <= x",
        (Kind.TERM, "0 <= x", "premise bounded of demo/descends"),
    ),
    (
        "descends",
        "rank x",
        "rank x >= 0 and x",
        (Kind.TERM, "x >= 0 and x", "premise bounded of demo/descends"),
    ),
    (
        "contracts",
        "point 0",
        "point x",
        Kind.STATE_TERMS,
    ),
    (
        "contracts",
        "point 0",
        "point 0, 0",
        Kind.STATE_TERMS,
    ),
    ("contracts", "weights 1", "weights 1 + x", Kind.STATE_TERMS),
    (
        "contracts",
        "rate a",
        "rate a*x",
        (Kind.UNDECLARED, "x", "premise constants of demo/contracts"),
    ),
    (
        "contracts",
        "radius 1/2",
        "radius x/2",
        (Kind.UNDECLARED, "x", "premise constants of demo/contracts"),
    ),
    (
        "contracts",
        "size 1",
        "size 1 + x",
        (Kind.UNDECLARED, "x", "premise constants of demo/contracts"),
    ),
    (
        "contracts",
        "on x < 1",
        "on x < 1 and distance < 1",
        (Kind.UNDECLARED, "distance", "premise surrounds of demo/contracts"),
    ),
    (
        "contracts",
        "on x < 1",
        "on x_next < 1",
        (Kind.UNDECLARED, "x_next", "premise surrounds of demo/contracts"),
    ),
    ("map", "state x", "state x iff", Kind.PIECE),
    ("map", "over a", "over a implies", (Kind.NAME, "implies", "premise possible of demo/map")),
    ("escapes", "word 2", "word", (Kind.WORD, "demo/escapes")),
    ("escapes", "word 2", "word 3", Kind.INDEX),
    ("escapes", "word 2", "word 0", Kind.INDEX),
    ("escapes", "point 0", "point x_0 + 1", Kind.STATE_TERMS),
    ("escapes", "start 1/2", "start x_point + 1/2", Kind.STATE_TERMS),
]


@pytest.mark.parametrize(
    ("kind", "old", "new", "expected"), MALFORMED, ids=[f"{row[0]}: {row[2]}" for row in MALFORMED]
)
def test_rejects_names_that_mean_nothing_there(
    kind: str, old: str, new: str, expected: Expected
) -> None:
    outcome, reason = checked(edited(SUBTRACT, kind, old, new), searched(SUBTRACT))[f"demo/{kind}"]
    assert outcome == "rejected"
    assert refused(reason, expected), reason


@pytest.mark.parametrize(
    ("kind", "old", "new"),
    [
        ("descends", "stage x < 1", "stage x < 1) or (0 = 0"),
        ("contracts", "rate a", "rate a) - (1"),
        ("contracts", "point 0", "point 0 -> 1"),
        ("descends", "rank x", "root u = root(x^2 - 2, 0, 2)\nrank u"),
        ("map", "piece x < 1 -> a*x", "piece x < 1 a*x"),
        ("map", "space x >= 0", "space x >= 0\nspace x >= 1"),
        ("descends", "rank x", "rank x\nrank x - 1"),
        ("attracts", "descent demo/descends\n", ""),
        ("escapes", "word 2", "word two"),
    ],
)
def test_rejects_unreadable_lines(kind: str, old: str, new: str) -> None:
    with pytest.raises(checker.Rejected):
        text = edited(SUBTRACT, kind, old, new)
        read(text)
        outcome, reason = checked(text, searched(SUBTRACT))[f"demo/{kind}"]
        raise reason if reason is not None else AssertionError(outcome)


@given(
    a=st.fractions(Fraction(1, 100), Fraction(99, 100)),
    x=st.fractions(0, 30, max_denominator=50),
    more=st.integers(0, 6),
)
def test_what_the_rules_conclude_holds_of_orbits(a: Fraction, x: Fraction, more: int) -> None:
    def step(y: Fraction) -> Fraction:
        return y - 1 if y >= 1 else a * y

    y = x
    for _ in range(-(-x.numerator // x.denominator)):
        y = step(y)
    assert y < 1
    for _ in range(more):
        y = step(y)
    assert y <= a**more
