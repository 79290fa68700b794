"""Trees and squares that the searches find: the checker accepts them, and an independent evaluation
finds no point below.
"""

from __future__ import annotations

import itertools
import json
import random
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.algebra.box_trees import value_at
from juggleproof.certificates import checker
from juggleproof.judging.bounds import LOWER, Enclosure, enclose_minimum
from juggleproof.search.boxes.branching import Branching, bernstein_tensor
from juggleproof.search.boxes.squares import program_around
from juggleproof.search.psatz.sums_of_squares import search_squares
from juggleproof.statements.work import Budget
from tests.certificates.checker.evaluator import term_at
from tests.rows import each_row
from tests.statements.drawn import fractions

MANY = settings(max_examples=40, deadline=None, derandomize=True)
NAMES = ("x", "y", "z")
ends = st.tuples(
    fractions(-2, 2, 3),
    fractions(0, 3, 3),
)
boxes = st.lists(ends, min_size=3, max_size=3).map(
    lambda pairs: {name: (low, low + width) for name, (low, width) in zip(NAMES, pairs)}
)
monomials = st.tuples(
    st.integers(-6, 6).filter(bool), st.integers(0, 4), st.integers(0, 3), st.integers(0, 2)
)
polynomials = st.lists(monomials, min_size=1, max_size=6).map(
    lambda parts: " + ".join(f"({c})*x^{a}*y^{b}*z^{d}" for c, a, b, d in parts)
)
Box = dict[str, tuple[Fraction, Fraction]]


def points(box: Box, count: int = 60) -> list[dict[str, Fraction]]:
    source = random.Random(count)
    places = [
        *itertools.product((Fraction(0), Fraction(1)), repeat=len(box)),
        *([Fraction(source.randrange(13), 12) for _ in box] for _ in range(count)),
    ]
    return [
        {name: low + (high - low) * t for (name, (low, high)), t in zip(box.items(), place)}
        for place in places
    ]


def outcome_of(found: Enclosure, tree: str) -> str:
    """What the checker says where another tree takes the place of the one found."""
    certificate = {
        **found.certificates[LOWER],
        "certified": ["proof", [], [*found.certificates[LOWER]["certified"][2][:3], tree]],
    }
    return str(
        checker.check_one(checker.read_statements(found.statements)[LOWER], certificate, {}, {})[0]
    )


@MANY
@given(polynomials, boxes)
def test_no_point_is_below_what_is_enclosed(text: str, box: Box) -> None:
    found = enclose_minimum(text, box, Fraction(1, 1000), budget=300)
    values = [term_at(text, point) for point in points(box)]
    assert found.low <= min(values)
    assert found.low <= term_at(text, found.point) <= found.high
    assert all(low <= found.point[name] <= high for name, (low, high) in box.items())
    assert found.reached == (found.width <= Fraction(1, 1000))


@MANY
@given(polynomials, boxes, st.integers(0, 10**6))
def test_a_changed_tree_is_rejected_or_proves_what_is_true(text: str, box: Box, seed: int) -> None:
    found = enclose_minimum(text, box, Fraction(1, 10), budget=100)
    node = found.certificates[LOWER]["certified"][2]
    if node[0] != "boxes":
        return
    source, tree = random.Random(seed), node[3]
    for _ in range(5):
        place = source.randrange(len(tree))
        changed = (
            tree[:place]
            + source.choice(["", ".", "a", "b", "A", "B", tree[place] * 2])
            + tree[place + 1 :]
        )
        higher = found.statements.replace(f">= {found.low}", f">= {found.high + Fraction(1, 7)}")
        assert (
            outcome_of(
                Enclosure(found.low, found.high, found.point, 0, True, higher, found.certificates),
                changed,
            )
            == "rejected"
        )
    assert outcome_of(found, tree) == "certified"
    assert outcome_of(found, tree + ".") == outcome_of(found, tree[:-1]) == "rejected"


@MANY
@given(
    st.dictionaries(
        st.tuples(st.integers(0, 4), st.integers(0, 3)),
        st.integers(-9, 9).filter(bool).map(Fraction),
        min_size=1,
    ),
    boxes,
)
def test_corner_coefficients_are_values(terms: dict[tuple[int, int], Fraction], box: Box) -> None:
    sides = [box["x"], box["y"]]
    tensor, unit = bernstein_tensor(terms, sides)
    for corner in itertools.product((0, -1), repeat=2):
        assert Fraction(int(tensor[corner]), unit) == value_at(
            terms, [side[k] for side, k in zip(sides, corner)]
        )


@each_row("exact", [False, True])
def test_a_tree_reaches_its_target_in_both_arithmetics(exact: bool) -> None:
    terms = {(3,): Fraction(1), (1,): Fraction(-2)}
    tree = Branching(
        terms, [(Fraction(0), Fraction(2))], lambda: Fraction(-109, 100), lambda place: None, exact
    ).run(100)
    assert tree.reached
    assert tree.bound >= Fraction(-109, 100)


def test_a_tree_stops_at_its_budget_with_the_bound_it_came_to() -> None:
    terms = {(2,): Fraction(1), (1,): Fraction(-2, 3)}
    target = Fraction(-1, 9) - Fraction(1, 10**8)
    few, more = (
        Branching(
            terms, [(Fraction(0), Fraction(1))], lambda: target, lambda place: None, True
        ).run(boxes)
        for boxes in (5, 11)
    )
    assert not few.reached
    assert few.bound < more.bound < Fraction(-1, 9)


VALLEYS = {
    "Rosenbrock, 3 variables": (
        "100*(y - x^2)^2 + (1 - x)^2 + 100*(z - y^2)^2 + (1 - y)^2",
        "1 1 1",
    ),
    "Schwefel": ("(x - y^2)^2 + (y - 1)^2 + (x - z^2)^2 + (z - 1)^2", "1 1 1"),
    "a singular Hessian": ("(x + 10*y)^2 + (y - 2*z)^4 + (x - z)^4", "0 0 0"),
    "held at a side": ("100*(y - x^2)^2 + 3*(z - 2) + (x - 1/3)^2 + (y - 1/9)^2", "1/3 1/9 -2"),
    "held at an upper side": ("100*(y - x^2)^2 - 3*z + (x - 1/3)^2 + (y - 1/9)^2", "1/3 1/9 2"),
}


@each_row("name", VALLEYS)
def test_squares_prove_the_minimum_of_a_valley(name: str) -> None:
    text, at = VALLEYS[name]
    found = enclose_minimum(text, dict.fromkeys(NAMES, (-2, 2)), 0, budget=2000)
    assert found.low == found.high
    assert list(found.point.values()) == [Fraction(value) for value in at.split()]


@pytest.mark.exhaust
@each_row("exponent", [3, 9])
def test_squares_enclose_an_irrational_minimum_of_a_valley(exponent: int) -> None:
    text = "100*(y - x^2)^2 + (1 - x)^2 + 100*(z - y^2)^2 + (1 - y)^2 + x*z/10"
    found = enclose_minimum(
        text, dict.fromkeys(NAMES, (-2, 2)), Fraction(1, 10**exponent), budget=300
    )
    assert found.reached and 0 < found.width <= Fraction(1, 10**exponent)
    assert found.certificates[LOWER]["certified"][2][0] == "psatz"
    assert found.low <= min(
        term_at(text, point)
        for point in points({name: (Fraction(1, 2), Fraction(1)) for name in NAMES})
    )


def test_a_changed_square_is_rejected() -> None:
    found = enclose_minimum(VALLEYS["Schwefel"][0], dict.fromkeys(NAMES, (-2, 2)), 0, budget=400)
    certificate = json.loads(json.dumps(found.certificates[LOWER]))
    node = certificate["certified"][2]
    assert node[0] == "psatz"
    node[1][1][0] = str(Fraction(node[1][1][0]) + Fraction(1, 10**6))
    assert (
        checker.check_one(checker.read_statements(found.statements)[LOWER], certificate, {}, {})[0]
        == "rejected"
    )


def test_no_program_where_the_point_is_not_stationary() -> None:
    box, terms = [(Fraction(-1), Fraction(1))], {(2,): Fraction(1), (1,): Fraction(1)}
    assert program_around(terms, box, [Fraction(0)], ["x"], [[0, 1]], 2) is None


def test_no_squares_where_the_point_is_not_least() -> None:
    box, terms = [(Fraction(-2), Fraction(2))], {(4,): Fraction(1), (2,): Fraction(-1)}
    program = program_around(terms, box, [Fraction(0)], ["x"], [[0, 1]], 2)
    assert program is not None and search_squares([program], Budget(10**7)) is None
