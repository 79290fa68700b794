"""Counterexamples in words: each line agrees with exact values that are worked out here anew."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

import pytest

from juggleproof.proofs.counterexample_words import NOUNS, SIDES, meeting, named_terms
from juggleproof.proofs.paper.names import definitions
from juggleproof.reports import errata
from juggleproof.reports.counterexample_words import in_words
from juggleproof.statements.store import DEFAULT, Store

NUMBER = r"-?\d+(?:/\d+)?"
STATE = """
forall alpha r g beta v
given r > 0
given g > 0"""


def refuted() -> Iterator[tuple[str, str, dict[str, Fraction]]]:
    """Every refuted statement of the store: its name, its text and the point at which it fails."""
    store = Store(DEFAULT)
    for name, text in store.texts.items():
        certificate = store.certificate(name, text) or {}
        if "refuted" in certificate:
            point = errata.point_of(text, certificate["refuted"])
            assert point is not None, name
            yield name, text, point


@pytest.fixture(scope="module")
def lines() -> dict[str, str]:
    """The line of every refuted statement."""
    return {name: in_words(text, point) for name, text, point in refuted()}


def test_every_counterexample_has_a_line_holds(lines: dict[str, str]) -> None:
    assert len(lines) > 50
    assert [name for name, line in lines.items() if not line.endswith(".")] == []


def test_lines_order_numbers_as_they_are_holds(lines: dict[str, str]) -> None:
    """Every "is A, more than B" of a line, and every "less"; the counts are far from zero."""
    pattern = rf"is ({NUMBER})(?: [a-z\d ]*)?, (more|less) than ([^;.]*)"
    compared = [found for line in lines.values() for found in re.findall(pattern, line)]
    assert len(compared) > 40
    for first, order, rest in compared:
        after = re.match(rf"{NUMBER}", rest) or re.findall(rf", ({NUMBER})(?=$|,)", rest)
        second = Fraction(after[0])
        assert (Fraction(first) > second) == (order == "more") and Fraction(first) != second, rest


def test_lines_show_the_numbers_that_disagree_holds(lines: dict[str, str]) -> None:
    """Both numbers of a relation that fails, as `in numbers` has them; a zero may be in words."""
    shown = 0
    store = Store(DEFAULT)
    for name, line in lines.items():
        certificate = store.certificate(name, store.texts[name]) or {}
        numbers = errata.numbers_of(store.texts[name], certificate["refuted"])
        alone = re.fullmatch(rf"({NUMBER}) (?:[<>!]?=|[<>]) ({NUMBER})", numbers)
        if alone and "impact comes" not in line:
            shown += 1
            for number in {*alone.groups()} - {"0"}:
                assert re.search(rf"(?<![\d/-]){number}(?![\d/])", line), (name, numbers, line)
    assert shown > 25


@pytest.mark.parametrize("name", SIDES)
def test_sides_are_of_refuted_statements_holds(name: str, lines: dict[str, str]) -> None:
    assert all(
        noun in lines[name].replace("An entry", "an entry").replace("The", "the")
        for noun in SIDES[name]
    ), lines[name]


def test_nouns_are_of_named_terms_or_variables_holds() -> None:
    terms = {one.name for one in named_terms()}
    assert {one.name for one in definitions() if one.name in NOUNS} <= terms
    written = "\n".join(text for _, text, _ in refuted())
    for name in NOUNS.keys() - terms:
        assert re.search(rf"\b{name}\b", written), name


def test_ball_and_table_meet_where_their_heights_cross_holds() -> None:
    """The distance of ball and table is linear in time: its signs at both ends of the period tell
    whether it vanishes in between; heights are worked out here from the law of fall.
    """
    r, g = Fraction(3, 2), Fraction(2)
    period = 2 * r / g
    seen = set()
    for height in (Fraction(0), Fraction(1, 2), Fraction(3, 2), Fraction(9, 4), Fraction(4)):
        for speed in (Fraction(-2), Fraction(0), Fraction(1, 2), Fraction(3, 2), Fraction(2)):

            def distance(t: Fraction, h: Fraction = height, v: Fraction = speed) -> Fraction:
                return (h + v * t - g * t**2 / 2) - (r * t - g * t**2 / 2)

            words = meeting(height, speed, r, g)
            if found := re.match(rf"meets the table at time ({NUMBER}), before", words):
                time = Fraction(found[1])
                assert 0 <= time < period and distance(time) == 0 and speed < r
            elif words.startswith("meets the table only as the period ends"):
                assert distance(period) == 0 < distance(Fraction(0))
            elif words.startswith("keeps"):
                assert distance(period) == distance(Fraction(0)) == 0
            elif words.startswith("leaves"):
                assert distance(period) > 0 == distance(Fraction(0))
            else:
                assert words.startswith("does not meet") and distance(Fraction(0)) > 0
                assert distance(period) > 0 and ("no faster" in words) == (speed >= r)
            seen.add(words.partition(" at ")[0].partition(" as ")[0])
    assert len(seen) == 6


@pytest.mark.parametrize(
    "goal, point, line",
    [
        (
            "v < 0",
            {"beta": 1, "v": 1},
            "The ball is at height 1, rising at 1; the velocity is 1, more than 0.",
        ),
        ("beta != 1", {"beta": 1, "v": 0}, "The ball is at height 1, at rest; the height is 1."),
        (
            "beta/(r - v) < 1 or v = 2",
            {"beta": 1, "v": 0},
            "The ball is at height 1, at rest, and meets the table at time 1, before the period"
            " ends, at 2; the time to collision by (6) is 1, and the velocity is 0, less than 2.",
        ),
        (
            "-alpha*v + alpha*u + u = v",
            {"beta": 0, "v": 1, "u": 2},
            "The ball is at height 0, rising at 1; the velocity after the impact for ball velocity"
            " 1 and table velocity 2 is 5/2, more than the velocity, 1.",
        ),
    ],
)
def test_values_of_a_point_change_its_line_holds(
    goal: str, point: dict[str, int], line: str
) -> None:
    values = {"alpha": Fraction(1, 2), "r": Fraction(1), "g": Fraction(1)}
    values |= {name: Fraction(value) for name, value in point.items()}
    assert in_words(f"statement a/b{STATE}\nshow {goal}", values) == line


def test_f1_of_a_state_of_b2_is_not_the_next_state_holds() -> None:
    """From (1, 1) no impact comes: f1 there is no period of the ball."""
    image = "alpha*r - alpha*v - r"
    values = {name: Fraction(1) for name in ("r", "g", "beta", "v")} | {"alpha": Fraction(1, 2)}
    text = f"statement a/b{STATE}\nshow {image} > 0"
    assert in_words(text, values).endswith("the velocity of f1(b) is -1, less than 0.")
    falling = {**values, "v": Fraction(-1)}
    assert in_words(text, falling).endswith("the velocity is 0 a period later.")


def test_a_point_without_a_value_has_no_line() -> None:
    text = f"statement a/b{STATE}\nshow 1/(v - 1) > 0"
    assert in_words(text, {"beta": Fraction(1), "v": Fraction(1)}) == ""
