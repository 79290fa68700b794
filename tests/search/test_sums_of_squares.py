"""Sums of squares as multipliers: the steps from a semidefinite hint to an identity that the
checker accepts, and points with several roots.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.algebra.polynomials import Ring
from juggleproof.algebra.semidefinite import (
    GramBlock,
    LinearEquations,
    as_squares,
    feasible,
    rational_image,
)
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.certificate import search_certificate
from juggleproof.search.closing import SQUARED, search_closing
from juggleproof.search.points import search_values
from juggleproof.statements.states import SearchState, state_of
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

rows = st.lists(st.lists(st.integers(-3, 3), min_size=4, max_size=4), min_size=1, max_size=4)


def statement(text: str) -> checker.Statement:
    return checker.read_statements(f"statement t/t\n{text}")["t/t"]


def gram(vectors: list[list[int]]) -> list[list[Fraction]]:
    size = len(vectors[0])
    return [[Fraction(sum(v[i] * v[j] for v in vectors)) for j in range(size)] for i in range(size)]


@given(rows)
def test_a_gram_matrix_is_the_sum_of_its_squares_holds(vectors: list[list[int]]) -> None:
    matrix = gram(vectors)
    squares = as_squares(matrix)
    assert squares is not None and all(c > 0 for c, _ in squares)
    assert [
        [sum((c * row[i] * row[j] for c, row in squares), Fraction(0)) for j in range(4)]
        for i in range(4)
    ] == matrix


@given(rows)
def test_a_matrix_with_a_negative_direction_has_no_squares_holds(vectors: list[list[int]]) -> None:
    matrix = gram(vectors)
    matrix[3][3] -= sum(v[3] ** 2 for v in vectors) + 1  # now e_3 goes down
    assert as_squares(matrix) is None


@given(rows)
def test_the_image_of_a_matrix_is_found_again_as_integers_holds(vectors: list[list[int]]) -> None:
    matrix = np.array(vectors, dtype=float)
    left, values, _ = np.linalg.svd(matrix.T, full_matrices=False)
    image = rational_image(left[:, values > 1e-9], 1e-9)  # exact but for rounding
    rank = int((values > 1e-9).sum())
    if image is not None:
        assert (
            len(image)
            == rank
            == np.linalg.matrix_rank(
                np.vstack([matrix, np.array(image, dtype=float).reshape(-1, 4)])
            )
        )


def test_an_irrational_direction_is_refused_holds() -> None:
    assert rational_image(np.array([[1.0], [np.sqrt(2)]]), 1e-4) is None


def test_a_semidefinite_program_without_a_solution_has_none_holds() -> None:
    trace = np.eye(2).reshape(1, 2, 2)
    assert feasible([trace], np.zeros((1, 0)), np.array([-1.0]), Budget(10**6), 1e-4, 1e-9) is None
    found = feasible([trace], np.zeros((1, 0)), np.array([1.0]), Budget(10**6), 1e-4, 1e-9)
    assert (
        found is not None
        and abs(np.trace(found[0]) - 1) < 1e-5
        and np.linalg.eigvalsh(found[0])[0] > 0
    )


def program() -> LinearEquations:
    """2 x^2 - 2 x y + 2 y^2 + 1 > 0, as the negation's strict term and a sum of squares."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    goal = GramBlock(-(2 * x**2 - 2 * x * y + 2 * y**2 + 1), True, [ring.one])
    return LinearEquations([goal, GramBlock(ring.one, False, [ring.one, x, y])], [], Fraction(1, 3))


@each_row("denominator", [1, 7, 1 << 20])
def test_rounded_entries_meet_every_equation_holds(denominator: int) -> None:
    equations = program()
    grams = equations.solve(Budget(10**6), 1e-6, 1e-7)
    assert grams is not None
    found = list(equations.rounded(grams, denominator))
    assert found
    for entries, multipliers in found:
        left = equations.combination([*(entries[e] for e in equations.entries), *multipliers])
        assert left == [0] * (equations.rows - 1) + [Fraction(1, 3)]


def test_what_no_entry_alone_can_make_up_for_is_not_spread_holds() -> None:
    ring = Ring(("x",))
    (x,) = ring.gens
    blocks = [
        GramBlock(-(x**2) - 1, True, [ring.one]),
        GramBlock(1 - x, False, [ring.one, x]),
    ]
    equations = LinearEquations(blocks, [], Fraction(1))
    missing = [Fraction(1)] * equations.rows
    assert equations.spread(missing) is None
    assert program().spread([Fraction(1)] * (program().rows - 1) + [Fraction(0)]) is not None


def test_few_entries_make_up_for_what_is_missing_in_every_equation_holds() -> None:
    block = program().blocks[1]
    equations = LinearEquations([*program().blocks, block], [], Fraction(1, 3))
    missing = [Fraction(k + 1, 7) for k in range(equations.rows)]
    change = equations.basic(missing)
    assert change is not None and equations.combination(change) == missing
    assert sum(map(bool, change)) <= equations.rows < len(change)


def test_a_sum_of_squares_in_many_squares_keeps_its_numbers_short_holds() -> None:
    text = "forall x y z\nshow x^4 + y^4 + z^4 + x^2 + y^2 + z^2 + 1 > 2*x*y*z + x*y/3 - z/5"
    found = search_certificate(statement(text), {}, Budget(10**6), attempts=limits.SQUARES_FIRST)
    _, _, (_, products, _) = found["certified"]
    assert max(len(c) for c, _, _ in products) < 60


TRUE = {
    "motzkin": "forall x y\nshow x^4*y^2 + x^2*y^4 + 1 >= 3*x^2*y^2",
    "choi-lam": "forall x y z\nshow x^2*y^2 + y^2*z^2 + z^2*x^2 + 1 >= 4*x*y*z",
    "positive": "forall x\nshow x^8 - x^5 + x^2 - x + 1 > 0",
    "schur": (
        "forall x y z\nshow x^2*(x - y)*(x - z) + y^2*(y - x)*(y - z) + z^2*(z - x)*(z - y) >= 0"
    ),
    "modulo-equations": "forall x y z\ngiven x^2 + y^2 + z^2 = 1\nshow x + y + z < 174/100",
    "disjunction": "forall x y\ngiven x != 0 or y != 0\nshow x^2 - x*y + y^2 > 0",
    "root-that-occurs-once": "forall x y\ngiven x >= 0\ngiven x^2 = 3 - y\nshow y <= 3",
}
FALSE = {
    "motzkin": "forall x y\nshow x^4*y^2 + x^2*y^4 + 1 >= 301/100*x^2*y^2",
    "touching": "forall x\nshow x^8 - 2*x^4 + 1 > 0",
    "modulo-equations": "forall x y z\ngiven x^2 + y^2 + z^2 = 1\nshow x + y + z < 173/100",
}


@each_row("name", TRUE)
def test_squares_close_what_is_true_holds(name: str) -> None:
    unfolding = checker.Unfolding(statement(TRUE[name]), checker.Context())
    state = state_of(unfolding).assume(unfolding.goal(False))
    node = search_closing(state, {}, Budget(2_000_000), SQUARED)
    assert node is not None and state.is_closed_by(node, {})


@each_row("name", FALSE)
def test_squares_close_nothing_that_is_false_holds(name: str) -> None:
    unfolding = checker.Unfolding(statement(FALSE[name]), checker.Context())
    try:
        assert (
            search_closing(
                state_of(unfolding).assume(unfolding.goal(False)), {}, Budget(200_000), SQUARED
            )
            is None
        )
    except Exhausted:
        pass


def test_rejects_squares_whose_sum_is_changed() -> None:
    unfolding = checker.Unfolding(statement(TRUE["motzkin"]), checker.Context())
    state = state_of(unfolding).assume(unfolding.goal(False))
    node = search_closing(state, {}, Budget(2_000_000), SQUARED)
    assert node is not None and state.is_closed_by(node, {})
    for k, (c, factors, root) in enumerate(node[1]):
        for changed in (
            [str(Fraction(c) * 2), factors, root],
            [c, factors, f"{root} + 1"],
            [f"-{c}", factors, root],
        ):
            wrong = ["psatz", [*node[1][:k], changed, *node[1][k + 1 :]], node[2]]
            assert not state.is_closed_by(wrong, {})


POINTS = {
    "two roots": "forall a b\nshow not (a^2 = 2 and b^2 = 3 and a > 0 and b > 0)",
    "a root of a root": "forall a b\nshow not (a^2 = 2 and b^2 = a + 1 and a > 0 and b < 0)",
    "two curves": "forall x y\nshow not (x^2 + 2*y^2 = 2 and 3*x^2 + x*y + y^2 = 3 and y > 0)",
    "four on a circle": (
        "forall p q r s t u\nshow not (p^2 + q^2 = 1 and r^2 + s^2 = 1 and t^2 + u^2 = 1 and p + r"
        " + t = 0 and q > 0 and 3*p = 1)"
    ),
}


@each_row("name", POINTS)
def test_points_with_irrational_values_are_found_holds(name: str) -> None:
    one = statement(POINTS[name])
    found = search_values(
        one, SearchState(checker.Context()), "counterexample", {}, {}, Budget(2_000_000), effort=1
    )
    assert found is not None and found[1]
    assert SearchState(checker.Context()).is_served_by(found, {}, "counterexample", one)


def test_a_condition_without_points_has_none_holds() -> None:
    one = statement("forall a b\nshow not (a^2 = 2 and b^2 = a - 2)")
    assert (
        search_values(
            one,
            SearchState(checker.Context()),
            "counterexample",
            {},
            {},
            Budget(300_000),
            effort=1,
        )
        is None
    )


def test_a_search_is_the_same_every_time_holds() -> None:
    one = statement(TRUE["choi-lam"])
    first = search_certificate(one, {}, Budget(2_000_000), attempts=limits.SQUARES_FIRST)
    again = search_certificate(
        one, {}, Budget(2_000_001), attempts=limits.SQUARES_FIRST
    )  # another budget, so that it is sought anew
    assert first == again and "certified" in first
