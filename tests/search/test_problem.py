"""The parts of the proof search: polynomials, scales, eliminations, linear programs, interior
points.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from flint import fmpz_mpoly
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.algebra.box_trees import tree_above_zero
from juggleproof.algebra.numbers import fraction, univariate
from juggleproof.algebra.polynomials import (
    Packing,
    Ring,
    coefficients_in,
    pseudo_divide,
)
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.closing import search_closing
from juggleproof.search.psatz.candidates import digits, resultants
from juggleproof.search.psatz.facts import Scaling
from juggleproof.search.psatz.lifting import (
    LiftedTerm,
    shortest_divisor,
    without_common_facts,
)
from juggleproof.search.psatz.linear_program import Program, SparseMatrix, presolve, solve
from juggleproof.search.psatz.problem import LeafProblem, has_interior_point
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

RING = Ring(("x", "y", "z"))
monomials = st.tuples(st.integers(0, 3), st.integers(0, 3), st.integers(0, 2))
polynomials = st.dictionaries(
    monomials, st.integers(-5, 5).filter(bool), min_size=1, max_size=5
).map(RING.ctx.from_dict)


def state_of(text: str, names: str, integers: str = "") -> SearchState:
    context = checker.Context()
    for name in names.split():
        context.declare(name, name in integers.split())
    return SearchState(context).assume(context.formula(checker.parse(text)))


def test_long_numbers_of_one_denominator_become_short_fractions_holds() -> None:
    first, second = 2**201 - 3, 3**140
    weights = [second, first, first * second]  # of 1/first, 1/second and 1
    assert shortest_divisor(weights, []) == first * second


@each_row(("relation", "left"), [(">", 0), (">=", 0), ("!=", 2)])
def test_an_identity_is_divided_by_common_facts_with_a_sign_holds(relation: str, left: int) -> None:
    state = state_of(f"x {relation} 0 and y > 0 and x + y^2 > 1", "x y")  # without scales
    source = LeafProblem(state, Ring(("x", "y")), True).source
    ring = source.ring
    terms = [
        LiftedTerm(Fraction(1), ((0, 2), (1, 1)), ring.one),
        LiftedTerm(Fraction(2), ((0, 2),), ring.one),
    ]
    x, y = ring.gens
    found, owed = without_common_facts(source, terms, {7: x**2 * y})
    assert [dict(one.factors).get(0, 0) for one in found] == [left] * 2
    assert owed == {7: x**left * y}


def test_a_common_fact_that_a_cofactor_lacks_is_kept_holds() -> None:
    state = state_of("x > 0 and y > 0 and x + y^2 > 1", "x y")
    source = LeafProblem(state, Ring(("x", "y")), True).source
    terms = [LiftedTerm(Fraction(1), ((0, 2),), source.ring.one)]
    found, owed = without_common_facts(source, terms, {7: source.ring.gens[1]})
    assert found == terms and owed == {7: source.ring.gens[1]}


@given(polynomials, polynomials, polynomials)
def test_pseudo_division_is_an_identity(
    poly: fmpz_mpoly, lead: fmpz_mpoly, rest: fmpz_mpoly
) -> None:
    x = RING.gens[0]
    lead, rest = lead.subs({"x": 2}), rest.subs({"x": 1})
    if not lead:
        return
    count, quotient, remainder = pseudo_divide(poly, 0, x, lead, rest)
    assert lead**count * poly == quotient * (lead * x - rest) + remainder
    assert not remainder or remainder.degrees()[0] == 0


@given(polynomials)
def test_coefficients_give_the_polynomial_back(poly: fmpz_mpoly) -> None:
    x = RING.gens[0]
    assert sum((c * x**k for k, c in enumerate(coefficients_in(poly, 0))), RING.zero) == poly


@given(polynomials, polynomials)
def test_keys_add_where_monomials_multiply(p: fmpz_mpoly, q: fmpz_mpoly) -> None:
    packing = Packing(RING, [RING.gens[0] * RING.gens[1] * RING.gens[2]])
    sums = {int(a) + int(b) for a in packing.row(p)[0] for b in packing.row(q)[0]}
    assert {int(k) for k in packing.row(p * q)[0]} <= sums
    assert packing.exponents(packing.row(p)[0]).tolist() == [list(map(int, m)) for m in p.monoms()]


@given(polynomials)
def test_what_is_lowered_is_lifted_back(poly: fmpz_mpoly) -> None:
    x, y, z = RING.gens
    scaling = Scaling(RING, [x**2 - y * z], [0])  # x a scale: y + z has its weight twice
    assert scaling.scales == (0,)
    lifted = (
        scaling.lift(scaling.lower(poly), scaling.largest(scaling.lower(poly)))
        if scaling.lower(poly)
        else None
    )
    assert lifted is None or scaling.lower(lifted) == scaling.lower(poly)


def test_scales_are_found_for_lengths_and_times() -> None:
    ring = Ring(("b", "v", "r", "g", "t"))
    b, v, r, g, t = ring.gens
    scaling = Scaling(
        ring, [g * b + 2 * r * v - 2 * r**2, 2 * b + 2 * v * t - g * t**2, r, g], [2, 3]
    )
    assert scaling.scales == (2, 3)
    assert str(scaling.lower(g * b + 2 * r * v - 2 * r**2)) == "b + 2*v - 2"
    assert scaling.lift(b + 2 * v - 2, (2, 0)) == g * b + 2 * r * v - 2 * r**2


@each_row(
    "text",
    [
        "x + y = 3 and x - y = 1 and x != 2",
        "x*y = 0 and x != 0 and y != 0",
        "z > 0 and z*x = y and z*x < y",
        "x^2 = 2 and x^4 != 4",
        "z > 0 and x*z = 1 and y*z = 1 and x != y",
        "x = y and y = z and z = x + 1",
        "z != 0 and z*(x - 1) = 0 and x > 1",
        "x >= 0 and y >= 0 and z >= 0 and x^2 = y^2 + z and x < y",
    ],
)
def test_equations_are_used_up(text: str) -> None:
    state = state_of(text, "x y z")
    node = search_closing(state, {}, Budget(10**6))
    assert node is not None and state.is_closed_by(node, {})


@each_row(
    ("text", "integers"),
    [
        ("x > 0 and x < 1", "x"),
        ("2*x + 4*y > 0 and x + 2*y < 1", "x y"),
        ("z > 0 and z < 3 and x*z >= z and x < 2 and x != 1", "x"),
    ],
)
def test_strict_facts_in_integers_are_rounded(text: str, integers: str) -> None:
    state = state_of(text, "x y z", integers)
    node = search_closing(state, {}, Budget(10**6))
    assert node is not None and state.is_closed_by(node, {})
    assert search_closing(state_of(text, "x y z"), {}, Budget(10**6)) is None


def test_a_state_with_points_is_never_closed() -> None:
    for text in (
        "x > 0 and y > 0",
        "x^2 + y^2 = 1 and x > y",
        "(x > 1 or x < 0) and x*y = 1",
        "x^2*y >= 1 and y <= 1",
    ):
        assert search_closing(state_of(text, "x y"), {}, Budget(10**6)) is None


def test_interior_points_are_seen_and_empty_states_are_not() -> None:
    def seen(text: str) -> bool:
        return has_interior_point(
            LeafProblem(state_of(text, "x y"), Ring(("x", "y"))), Budget(10**6)
        )

    assert seen("x > 0 and y > x^2 and y < 2*x")
    assert not seen("x > 0 and y > x^2 and y < 0")
    assert not seen("x^2 + y^2 = 1")  # where an equation is left nothing is claimed


def test_a_program_without_solution_has_none() -> None:
    packing = Packing(RING, RING.gens)
    program = Program()
    for poly, strict in ((RING.gens[0] - 2, False), (3 - RING.gens[0], False), (RING.one, True)):
        keys, values = packing.row(poly)
        program.add(0 * keys, keys, values, np.array([strict]), np.ones(1))
    assert solve(program, Budget(10**5)) is None


def test_a_program_that_is_too_large_is_not_paid_for_holds() -> None:
    columns = np.arange(3_000)
    program = Program()
    program.add(columns, columns, np.ones(3_000), np.ones(3_000, dtype=bool), np.ones(3_000))
    budget = Budget(10_000)
    assert solve(program, budget) is None and budget.left > 0


@given(st.lists(st.integers(-4, 4), min_size=2, max_size=6).filter(lambda c: bool(c[-1])))
def test_positivity_on_an_interval_agrees_with_samples(coefficients: list[int]) -> None:
    ring = Ring(("x",))
    (x,) = ring.gens
    poly = sum((c * x**k for k, c in enumerate(coefficients)), ring.zero)
    values = [sum(c * Fraction(k, 16) ** n for n, c in enumerate(coefficients)) for k in range(17)]
    tree = tree_above_zero(map(fraction, univariate(poly, 0).coeffs()), Fraction(0), Fraction(1))
    if tree is not None:
        assert min(values) > 0
    if (
        min(values) > 3
    ):  # the derivative is at most 4 * (1 + .. + 5) = 60 and samples are 1/16 apart
        assert tree is not None


def test_parts_of_a_budget_spend_from_the_whole_holds() -> None:
    whole = Budget(100)
    whole.part(40).part(30).spend(25)
    assert whole.left == 75


def test_what_is_too_large_takes_nothing_from_a_budget_holds() -> None:
    whole = Budget(100)
    first, second = whole.part(90), whole.part(90)
    with pytest.raises(Exhausted):
        first.spend(91)
    first.spend(90)
    with pytest.raises(Exhausted):  # a part has no more than the whole has left
        second.spend(11)
    assert (whole.left, second.left) == (10, 90)


def test_what_was_done_takes_what_is_left_holds() -> None:
    whole = Budget(100)
    part = whole.part(40)
    part.charge(15)
    with pytest.raises(Exhausted):
        part.charge(26)
    assert (whole.left, part.left) == (60, 0)


def test_resultants_are_factored_holds() -> None:
    ring = Ring(("x", "y"))
    x, y = ring.gens
    found = resultants(ring, [x * y - 1, x**2 - y], -1)
    assert y**2 + y + 1 in found and y - 1 in found


def test_rejects_resultants_whose_work_no_count_bounds() -> None:
    """Of large coefficients, or of a high degree, which would not end in the time of this suite."""
    ring = Ring(("x", "y"))
    x, y = ring.gens

    def pair(power: int) -> list[fmpz_mpoly]:
        one, other = (sum((k + m) ** power * y**k for k in range(20)) for m in (1, 2))
        assert digits(one) < limits.MOST_DIGITS  # which the resultant exceeds, if any
        return [x * one - other, x * other + one]

    assert resultants(ring, pair(3), -1) and not resultants(ring, pair(20), -1)
    assert not resultants(ring, [pair(3)[0], x**100 + y], -1)


def test_columns_that_fall_one_after_another_are_counted_work_holds() -> None:
    turned = np.eye(100) - np.eye(100, k=1)  # 0 = c_0, 0 = c_1 - c_0, ..: a round for each
    chain = SparseMatrix.of(turned)
    strict, budget = np.arange(100) == 99, Budget(2000)
    assert presolve(chain, 100, strict, budget) is None and budget.left == 1000
    with pytest.raises(Exhausted):
        presolve(chain, 100, strict, Budget(900))
