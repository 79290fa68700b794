"""The map rules on other maps: accepted as they are, rejected with the premise's name where one
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
from tests.certificates.checker.maps import (
    ASKED,
    COUNT,
    DOUBLE,
    FLIP,
    NEST,
    PUSH,
    SCALE,
    SUBTRACT,
    SWITCH,
    TURN,
    WHOLE,
    checked,
    edited,
    read,
    searched,
    up_to,
)

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
    ("lyapunov", "domain a > 0 and a < 1", "domain a > 0 and a < 0", "possible"),
    ("lyapunov", "domain a > 0 and a < 1", "domain a > 0 and a < 2", "inside"),
    ("lyapunov", "radius 1/2", "radius 0", "constants"),
    ("lyapunov", "upper 1", "upper 0", "constants"),
    ("lyapunov", "least (1 - a)*distance", "least 0", "positive"),
    ("lyapunov", "least (1 - a)*distance", "least (1 - a)*level", "positive"),
    ("lyapunov", "point 0", "point -1", "point"),
    ("lyapunov", "point 0", "point 0\nhave x_point = 1", "point"),
    ("lyapunov", "point 0", "point 0\nhave 0 = 1", "point"),
    ("lyapunov", "value x", "have x_point >= 0\nvalue x_gap", "surrounds"),
    ("lyapunov", "radius 1/2", "radius 2", "surrounds"),
    ("lyapunov", "value x", "value x - 1", "bounded"),
    ("lyapunov", "loss (1 - a)*value", "loss (1 - a)*value - 1", "loss"),
    ("lyapunov", "least (1 - a)*distance", "least distance", "least"),
    ("lyapunov", "upper 1", "upper 1/2", "small-1"),
    ("lyapunov", "on x < 1", "on x < 1 or x = 3", "stays-1"),
    ("lyapunov", "on x < 1", "on x < 3/2", "falls-1-1"),
    ("lyapunov", "on x < 1", "on x <= 1/2 or x > 3/4 and x < 1", "stays-2"),
    ("lyapunov", "loss (1 - a)*value", "loss (1 - a/2)*value", "falls-2-1"),
    ("escapes", "start 1/2", "start 0", "start"),
    ("escapes", "start 1/2", "start 3/2", "start"),
    ("escapes", "word 2", "word 1", "start"),
    ("escapes", "domain a = 1", "domain a = 2", "inside"),
    ("escapes", "domain a = 1", "domain a < a", "possible"),
]
UNSTABLE = "domain a > 1 and a > 0 and 1 + a > 0"
FAILING_WITH_GUARDS = [
    ("lyapunov", "value x >= 0 -> x", "value x > 0 -> x", "bounded"),
    ("lyapunov", "(a - 3)*x/4", "-2*x", "small-2"),
    ("lyapunov", "(a - 3)*x/4", "-x", "falls-1-2"),
    ("lyapunov", "(a - 3)*x/4", "-x/2", "falls-2-1"),
    ("unstable", UNSTABLE, "domain a > 1 and a < 1", "possible"),
    ("unstable", UNSTABLE, "domain a > 1/2 and a > 0 and 1 + a > 0", "inside"),
    ("unstable", "direction distance", "direction distance\nhave x_point = a", "point"),
    ("unstable", "rate 2*a/(1 + a)", "rate 1", "constants"),
    ("unstable", "radius 1", "radius 0", "constants"),
    ("unstable", "upper 1", "upper 0", "constants"),
    ("unstable", "direction distance", "direction 0", "direction"),
    ("unstable", "direction distance", "direction 2*distance", "direction"),
    ("unstable", "direction distance", "direction -2*distance", "direction"),
    ("unstable", "upper 1", "upper 1/2", "bounded-1"),
    ("unstable", "-(1 + a)*x/(4*a)", "-2*x", "bounded-2"),
    ("unstable", "-(1 + a)*x/(4*a)", "-x/(2*a)", "grows-1-1"),
    ("unstable", "-(1 + a)*x/(4*a)", "-x/2", "grows-2-2"),
    ("unstable", "value x >= 0 -> x", "value x > 2 -> x", "direction"),
]
FAILING_IN_A_SPACE = [
    ("unstable", "direction distance", "direction -distance", "direction"),
]
FAILING_OF_A_RELATION = [
    ("relation", "domain a >= 0 and a < 1", "domain a >= 0 and a < 0", "possible"),
    ("relation", "a and x > -1", "a and x > 2", "covers"),
    ("relation", "u <= a and x > -1", "u < -a and x > -1", "covers"),
    ("relation", "space 0 = 0", "space x >= -1", "stays-1"),
    ("relation", "space 0 = 0", "space x <= 9", "stays-2"),
    ("descends", "stage 0 = 0", "stage x < 1", "falls-1"),
    ("contracts", "rate 1/2", "rate 1/4", "closer-1"),
    ("lyapunov", "loss value/2", "loss value", "falls-1-1"),
]
FAILING_WITHOUT_INPUTS = [
    ("relation", "piece x >= -1", "piece x > 2", "covers"),
    ("contracts", "rate 1/2", "rate 1/3", "closer-1"),
    ("contracts", "rate 1/2", "rate 1", "constants"),
]
FAILING_WITH_RANKS = [
    ("descends", "rank 2*x, y", "rank 2*x - 1, y", "bounded"),
    ("descends", "rank 2*x, y", "rank 2*x, y - 1", "bounded"),
    ("descends", "rank 2*x, y", "rank y, 2*x", "falls-2"),
    ("descends", "rank 2*x, y", "rank 2*x, y/2", "falls-1"),
    ("descends", "rank 2*x, y", "rank x, y", "falls-2"),
    ("descends", "rank 2*x, y", "rank 2*x + y, 0", "falls-2"),
    ("side", "rank x <= 1 -> -x", "rank x < -5 -> -x", "bounded"),
    ("side", "rank x\n", "rank x > 1 -> x\n", "bounded"),
    ("side", "rank x\n", "rank x\nrank x > -5 -> 2 + x\n", "falls-2"),
    ("side", "rank x\n", "rank x\nrank 3 - x\n", "falls-1"),
    ("both", "1, -x", "1, x", "bounded"),
    ("both", "1, -x", "1, -x/2", "falls-2"),
    ("both", "-> 0, 0", "-> 1, 9", "falls-1"),
    ("both", "-> 0, 0", "-> 2, 0", "falls-1"),
]
FAILING_OF_INTEGERS = [
    ("map", "domain n != 0", "domain n != 0 and 0 < n and n < 1", "possible"),
    ("subtracts-descends", "rank x", "rank x/2", "falls-1"),
    ("contracts", "radius 1/2", "radius 1", "surrounds"),
]
FAILING_INTO = [("into", "radius 1", "radius 0", "constants")]
# What joins two statements fails through the one or the other: (statement changed, from, to,
# statement that fails, premise)
JOINS = [
    ("contracts", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "attracts", "inside"),
    ("contracts", "on x < 1", "on x < 3/4", "attracts", "enters"),
    ("lyapunov", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "settles", "inside"),
    ("lyapunov", "on x < 1", "on x < 3/4", "settles", "enters"),
    ("escapes", "point 0", "point 1/3", "exactly", "same-point-1"),
    ("descends", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "exactly", "covers"),
]
JOINS_OF_INTEGERS = [
    ("map", "integer n\n", "", "exactly", "covers"),
]
JOINS_INTO = [
    ("at-once", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "into", "inside"),
    ("middle", "space x >= 0 and x <= 5", "space x > 0 and x <= 5", "into", "point"),
    ("inner", "space x >= 0 and x <= 1", "space x >= 0 and x <= 1/2", "into", "surrounds"),
    ("descends", "stage x <= 1", "stage x <= 3/2", "into", "enters"),
    ("descends-first", "stage x <= 4", "stage x <= 6", "into-twice", "enters"),
    ("escapes", "point 0", "point 1/3", "exactly", "same-point-1"),
]
JOINS_OF_SEVERAL = [
    ("unstable", "domain a^2 > 1", "domain a > 1", "exactly", "covers"),
    ("descends", "domain a > -1", "domain a > 0", "exactly", "covers"),
    ("flips", "point a - a", "point a + 3", "exactly", "same-point-1"),
    ("stays", "point 0", "point a + 1", "exactly", "same-point-3"),
]


@pytest.mark.parametrize(
    "text", [SUBTRACT, TURN, FLIP, NEST, DOUBLE, PUSH, SWITCH, SCALE, COUNT, WHOLE]
)
def test_every_rule_holds_on_another_map(text: str) -> None:
    results = checked(text, searched(text))
    assert {outcome for outcome, _ in results.values()} == {"certified"}, results


def test_what_a_statement_has_of_its_point_is_known_to_its_premises_holds() -> None:
    text = edited(SUBTRACT, "lyapunov", "value x\n", "have x_point = 0\nvalue x_gap\n")
    text = edited(text, "lyapunov", "on x < 1", "on x_gap < 1")
    results = checked(text, searched(text))
    assert {outcome for outcome, _ in results.values()} == {"certified"}, results


def test_every_rule_holds_of_a_map_without_parameters() -> None:
    text = SUBTRACT.split("statement demo/escapes")[0].replace("over a", "over")
    for domain in ("a > 0 and a <= 1", "a > 0 and a < 1"):
        text = text.replace(f"domain {domain}", "domain 0 = 0")
    for old, new in (("a*x", "x/2"), ("rate a", "rate 1/2"), ("(1 - a)", "1/2")):
        text = text.replace(old, new)
    results = checked(text, searched(text))
    assert len(results) == 6 and {outcome for outcome, _ in results.values()} == {"certified"}


def named(text: str, kind: str) -> str:
    """The name of the statement of this kind."""
    (name,) = (name for name in read(text) if name.split("/")[1] == kind)
    return name


@pytest.mark.parametrize(
    ("whole", "kind", "old", "new", "premise"),
    [
        *((SUBTRACT, *row) for row in FAILING),
        *((FLIP, *row) for row in FAILING_WITH_GUARDS),
        *((DOUBLE, *row) for row in FAILING_IN_A_SPACE),
        *((PUSH, *row) for row in FAILING_OF_A_RELATION),
        *((SWITCH, *row) for row in FAILING_WITHOUT_INPUTS),
        *((NEST, *row) for row in FAILING_INTO),
        *((COUNT, *row) for row in FAILING_WITH_RANKS),
        *((WHOLE, *row) for row in FAILING_OF_INTEGERS),
    ],
)
def test_a_rule_fails_without_its_premise(
    whole: str, kind: str, old: str, new: str, premise: str
) -> None:
    text, name = edited(whole, kind, old, new), named(whole, kind)
    assert searched(text)[name] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(up_to(text, name), searched(whole))[name]
    assert outcome == "rejected" and reason is not None
    assert reason.place.startswith("premise ") or reason.kind is Kind.PREMISES


@pytest.mark.parametrize(
    ("whole", "kind", "old", "new", "joined", "premise"),
    [
        *((SUBTRACT, *row) for row in JOINS),
        *((NEST, *row) for row in JOINS_INTO),
        *((SCALE, *row) for row in JOINS_OF_SEVERAL),
        *((WHOLE, *row) for row in JOINS_OF_INTEGERS),
    ],
)
def test_joined_statements_fail_without_what_joins_them(
    whole: str, kind: str, old: str, new: str, joined: str, premise: str
) -> None:
    text, name = edited(whole, kind, old, new), named(whole, joined)
    found = searched(text)
    assert found[name] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(up_to(text, name), {**found, name: searched(whole)[name]})[name]
    assert outcome == "rejected" and reason is not None
    assert reason.place == f"premise {premise} of {name}"


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


def test_rejects_a_refutation_that_is_named_and_not_certified() -> None:
    for left_out in ("unstable", "stays", "flips"):
        found = {k: one for k, one in searched(SCALE).items() if k != f"scale/{left_out}"}
        outcome, reason = checked(SCALE, found)["scale/exactly"]
        assert outcome == "rejected" and reason is not None and reason.kind is Kind.EARLIER


@pytest.mark.parametrize("line", ["escape scale/flips", "escape scale/stays"])
def test_rejects_a_domain_on_which_nothing_is_refuted(line: str) -> None:
    text = edited(SCALE, "exactly", f"{line}\n" if "flips" in line else f"\n{line}", "")
    name = "scale/exactly"
    assert searched(text)[name] == {"unknown": "no proof of the premise covers was found"}
    assert checked(text, searched(SCALE))[name][0] == "rejected"


@pytest.mark.parametrize(
    ("kind", "name"), [("subtracts", "whole/subtracts-descends"), ("relation", "whole/related")]
)
def test_rejects_a_descent_for_integers_where_there_are_others(kind: str, name: str) -> None:
    text = edited(WHOLE, kind, "integer n\n", "")
    assert searched(text)[name] == {"unknown": "no proof of the premise falls-1 was found"}
    assert checked(text, {**searched(WHOLE), **searched(text)})[name][0] != "certified"
    proofs = searched(WHOLE)[name]["certified"]
    statements = read(text)
    falls = checker.premises_of(statements[name], statements)["falls-1"]
    with pytest.raises(checker.Rejected) as info:
        prove(falls, proofs["falls-1"], {})
    assert info.value.kind is Kind.INTEGRAL


def test_rejects_an_integer_that_is_an_input() -> None:
    text = edited(PUSH, "relation", "over a", "over a\ninteger u")
    _, reason = checked(text, searched(PUSH))["push/relation"]
    assert refused(reason, (Kind.NO_VARIABLE, "push/relation"))


@pytest.mark.parametrize("kind", ["inner", "middle"])
def test_rejects_an_attraction_of_a_map_for_integers_alone(kind: str) -> None:
    statements = read(edited(NEST, kind, "over a", "over a\ninteger a"))
    with pytest.raises(checker.Rejected) as info:
        checker.premises_of(statements["nest/into"], statements)
    assert refused(info.value, (Kind.OTHER_MAP, "nest/into"))


def test_rejects_an_escape_of_another_map_of_the_same_text() -> None:
    copy = SUBTRACT.split("\n\n")[0].replace("demo/map", "demo/copy")
    text = copy + "\n\n" + edited(SUBTRACT, "escapes", "map demo/map", "map demo/copy")
    results = checked(text, {**searched(SUBTRACT), **searched(copy)})
    assert results["demo/attracts"] == results["demo/escapes"] == ("certified", None)
    outcome, reason = results["demo/exactly"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.OTHER_MAP, "demo/exactly"))


@pytest.mark.parametrize(("old", "new"), [("over a", "over a b"), ("x", "y"), ("a*x", "a*x/2")])
def test_rejects_an_attraction_of_a_map_with_other_lines(old: str, new: str) -> None:
    text = edited(NEST, "inner", old, new)
    before = searched(text.split("statement nest/into")[0])
    results = checked(text, {**searched(NEST), **before})
    assert results["nest/attracts"] == results["nest/descends"] == ("certified", None)
    outcome, reason = results["nest/into"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.OTHER_MAP, "nest/into"))


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("stage 0 = 0", "stage x < u", (Kind.STAGE_INPUT, "push/descends")),
        ("rank 0", "rank u", (Kind.UNDECLARED, "u", "premise bounded of push/descends")),
        ("rank 0", "root h = sqrt(u)\nrank 0", (Kind.UNDECLARED, "u")),
        ("relation push/relation", "map push/relation", (Kind.EARLIER, "map push/relation")),
    ],
)
def test_rejects_a_descent_of_a_relation(old: str, new: str, expected: Expected) -> None:
    outcome, reason = checked(edited(PUSH, "descends", old, new), searched(PUSH))["push/descends"]
    assert outcome == "rejected"
    assert refused(reason, expected), reason


def test_rejects_a_periodic_orbit_of_a_relation() -> None:
    text = edited(SUBTRACT, "escapes", "map demo/map", "relation demo/map")
    with pytest.raises(checker.Rejected) as info:
        read(text)
    assert refused(info.value, (Kind.ORDER, "demo/escapes"))


def test_rejects_a_loss_that_is_negative_at_the_point() -> None:
    """0 and 1 change places, so 0 is no fixed point; every other premise holds."""
    text = """
statement swap/map
over
domain 0 = 0
state x
space x = 0 or x = 1
piece 0 = 0 -> 1 - x

statement swap/lyapunov
map swap/map
domain 0 = 0
on 0 = 0
point 0
value x
loss 2*x - 1
least 1
upper 1
radius 1/2
"""
    unknown = {"unknown": "no proof of the premise loss was found"}
    assert searched(text)["swap/lyapunov"] == unknown


def test_rejects_a_direction_from_elsewhere_where_a_state_is_called_distance() -> None:
    text = DOUBLE.replace("x", "distance")
    assert checked(text, searched(text))["double/unstable"] == ("certified", None)
    text = edited(text, "unstable", "direction distance", "direction distance + 2")
    unknown = {"unknown": "no proof of the premise direction was found"}
    assert searched(text)["double/unstable"] == unknown


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


@pytest.mark.parametrize(
    ("kind", "old", "new", "premise", "expected"),
    [
        ("map", "state x y", "state x rank_2", "bounded", (Kind.VARIABLE_TWICE, "rank_2")),
        ("map", "over a", "over a rank_1", "falls-1", (Kind.VARIABLE_TWICE, "rank_1")),
        ("descends", "stage x < 1", "stage rank_1 < 1", "stage-1-2", (Kind.UNDECLARED, "rank_1")),
        (
            "descends",
            "rank 2*x, y\n",
            "root h = sqrt(rank_1)\nrank 2*x, y\n",
            "inside",
            (Kind.UNDECLARED, "rank_1"),
        ),
    ],
)
def test_rejects_other_uses_of_the_names_of_what_is_at_least_the_rank(
    kind: str, old: str, new: str, premise: str, expected: Expected
) -> None:
    text = edited(COUNT.replace("rank 2*x, y\n", "rank 2*x, y\nrank x, 0\n"), kind, old, new)
    if "rank_2" in new:
        text = (
            text.replace("x/2, a*x^2", "x/2, x")
            .replace("y", "rank_2")
            .replace("2*x, rank_2", "x, x")
        )
    statements = read(text)
    written = checker.premises_of(statements["count/descends"], statements)
    with pytest.raises(checker.Rejected) as info:
        prove(written[premise], ["proof", [], ["close"]], {})
    assert refused(info.value, expected), info.value


@pytest.mark.parametrize(("terms", "lines"), [(20_000, 1), (400, 200)])
def test_rejects_a_rank_of_very_many_terms(terms: int, lines: int) -> None:
    rank = "\n".join([f"rank {', '.join(['x'] * terms)}"] * lines)
    text = edited(SUBTRACT, "descends", "rank x", rank)
    _, reason = checked(text, searched(SUBTRACT))["demo/descends"]
    assert refused(reason, Kind.WORK)


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
        "map": {"descends", "contracts", "lyapunov", "attracts", "settles", "escapes", "exactly"},
        "descends": {"attracts", "settles", "exactly"},
        "contracts": {"attracts", "exactly"},
        "lyapunov": {"settles"},
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
    ("descends", "rank x", "rank x\nrank x, x", Kind.VALUE),
    ("descends", "rank x", "rank x, x\nrank x", Kind.VALUE),
    ("descends", "rank x", "rank x\nrank (x > 0, x < 1) -> x", Kind.VALUE),
    ("descends", "rank x", "rank x\nrank rank_1", Kind.VALUE),
    ("descends", "rank x", "rank x\nrank rank_1 < 0 -> x", Kind.VALUE),
    ("descends", "rank x", "rank x\nrank rank_2", (Kind.UNDECLARED, "rank_2")),
    ("descends", "rank x", "rank x, rank_2 + x", Kind.VALUE),
    ("descends", "rank x", "rank ()", Kind.TEXT),
    ("descends", "rank x", "rank ()\nrank ()", Kind.TEXT),
    (
        "descends",
        "rank x",
        "root rank_1 = sqrt(x)\nrank x\nrank x",
        (Kind.VARIABLE_TWICE, "rank_1", "premise bounded of demo/descends"),
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
    (
        "lyapunov",
        "radius 1/2",
        "radius distance/2",
        (Kind.UNDECLARED, "distance", "premise constants of demo/lyapunov"),
    ),
    (
        "lyapunov",
        "upper 1",
        "upper 1 + distance",
        (Kind.UNDECLARED, "distance", "premise constants of demo/lyapunov"),
    ),
    (
        "lyapunov",
        "least (1 - a)*distance",
        "least (1 - a)*x",
        (Kind.UNDECLARED, "x", "premise positive of demo/lyapunov"),
    ),
    (
        "lyapunov",
        "loss (1 - a)*value",
        "loss (1 - a)*value + level",
        (Kind.UNDECLARED, "level", "premise loss of demo/lyapunov"),
    ),
    ("lyapunov", "value x", "have x >= 0\nvalue x", (Kind.UNDECLARED, "x")),
    ("lyapunov", "value x", "have distance > 0\nvalue x", (Kind.UNDECLARED, "distance")),
    ("lyapunov", "radius 1/2", "radius 1/2 + x_gap", (Kind.UNDECLARED, "x_gap")),
    ("lyapunov", "value x", "value value", Kind.VALUE),
    ("lyapunov", "value x", "value value < 1 -> x", Kind.VALUE),
    ("lyapunov", "value x", "value x, x", Kind.VALUE),
    ("lyapunov", "value x", "value x\nvalue x, x", Kind.VALUE),
    ("lyapunov", "value x", "value (x > 0, x < 1) -> x", Kind.VALUE),
    ("lyapunov", "point 0", "point x", Kind.STATE_TERMS),
    (
        "settles",
        "demo/lyapunov",
        "demo/contracts",
        (Kind.EARLIER, "lyapunov "),
    ),
    ("map", "state x", "state x iff", Kind.PIECE),
    ("map", "over a", "over a\ninteger x", (Kind.NO_VARIABLE, "demo/map")),
    ("map", "over a", "over a\ninteger z", (Kind.NO_VARIABLE, "demo/map")),
    ("map", "over a", "over a\ninteger a x", (Kind.NO_VARIABLE, "demo/map")),
    ("map", "over a", "over a\ninteger iff", (Kind.NO_VARIABLE, "demo/map.possible")),
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


def flip(a: Fraction, x: Fraction) -> Fraction:
    return -2 * a * x if x >= 0 else -x / 2


@given(
    a=st.fractions(Fraction(1, 100), Fraction(99, 100), max_denominator=100),
    x=st.fractions(-20, 20, max_denominator=50),
    d=st.fractions(Fraction(1, 50), 5, max_denominator=50),
)
def test_a_lyapunov_function_counts_the_states_away_from_the_point_holds(
    a: Fraction, x: Fraction, d: Fraction
) -> None:
    value = x if x >= 0 else (a - 3) * x / 4
    count = 0
    for _ in range(100):
        count += abs(x) >= d
        x = flip(a, x)
    assert count <= value / ((1 - a) * d / 8)


@given(
    a=st.fractions(Fraction(21, 20), 3, max_denominator=50),
    d=st.fractions(Fraction(1, 50), 1, max_denominator=50),
)
def test_an_orbit_from_the_direction_of_an_unstable_point_leaves_holds(
    a: Fraction, d: Fraction
) -> None:
    x = value = farthest = d
    while value <= 1:  # as long as the Chetaev function may stay below `upper`
        x, value = flip(a, x), value * 2 * a / (1 + a)
        farthest = max(farthest, abs(x))
    assert farthest > 1
