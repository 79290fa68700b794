"""Fast evaluation on samples agrees with plain substitution, and counted work is the same however
often a question is asked.
"""

from __future__ import annotations

import pytest
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    univariate,
    valued,
)
from juggleproof.certificates import checker
from juggleproof.search.closing import Closing
from juggleproof.search.hints.asking import ask
from juggleproof.search.psatz.linear import FIRST, search
from juggleproof.search.terms import RingPoint, TermQuotient, Trial
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row
from tests.statements.drawn import fractions

RING = fmpq_mpoly_ctx.get(["a", "x", "y"], Ordering.lex)
A, X, Y = RING.gens()
NUMBERS = fractions(-3, 3, 4).map(lambda c: fmpq(c.numerator, c.denominator))
POLYS = st.dictionaries(st.tuples(*[st.integers(0, 3)] * 3), NUMBERS, max_size=5).map(
    lambda d: RING.from_dict({k: c for k, c in d.items() if c})
)
RELATIONS = st.sampled_from([">", ">=", "=", "!="])


@given(POLYS, NUMBERS, NUMBERS, NUMBERS)
def test_a_value_is_what_substitution_gives(poly: fmpq_mpoly, a: fmpq, x: fmpq, y: fmpq) -> None:
    whole = {"a": a, "x": x, "y": y}
    expected = poly.subs(whole)
    assert valued(poly, whole) == (expected.leading_coefficient() if expected != 0 else 0)


def test_a_missing_variable_leaves_a_value_open_only_where_it_occurs() -> None:
    assert valued(A * X, {"a": fmpq(2)}) is None
    assert valued(A * A, {"a": fmpq(2)}) == 4
    assert valued(RING.constant(0), {"a": fmpq(2)}) == 0


@given(POLYS)
def test_coefficients_add_up_to_the_polynomial(poly: fmpq_mpoly) -> None:
    parts = coefficients_in(poly, "x")
    assert sum((c * X**k for k, c in enumerate(parts)), RING.constant(0)) == poly
    assert all(c == 0 or c.degrees()[1] == 0 for c in parts)


@each_row("poly", [X**3 + 2 * X**2 - X + 5, X**3 - 1, 3 * X, RING.constant(7), RING.constant(0)])
def test_a_dense_polynomial_has_the_same_values(poly: fmpq_mpoly) -> None:
    dense = univariate(poly, "x")
    assert all(dense(fmpq(k)) == valued(poly, {"x": fmpq(k)}) for k in range(-2, 3))


@given(
    st.lists(st.tuples(POLYS, RELATIONS), min_size=1, max_size=4),
    st.sampled_from(["and", "or"]),
    st.lists(NUMBERS, min_size=1, max_size=4),
)
def test_a_trial_fails_where_substitution_folds_to_false(
    facts: list[tuple[fmpq_mpoly, str]], op: str, values: list[fmpq]
) -> None:
    parts = [(k, relation) for k, (_, relation) in enumerate(facts)]
    tree = (op, parts) if len(parts) > 1 else parts[0]
    start = Condition(RING, [poly for poly, _ in facts], tree).substituted({})
    if start.tree is not False:
        trial = Trial(start, "x")
        for value in values:
            assert trial.fails(value) == (start.substituted({"x": value}).tree is False)


@given(POLYS, POLYS, POLYS, NUMBERS)
def test_sums_of_quotients_have_the_sum_of_their_values(
    top: fmpq_mpoly, other: fmpq_mpoly, more: fmpq_mpoly, a: fmpq
) -> None:
    point = RingPoint.of(RING, {"a": a, "x": fmpq(2, 7), "y": fmpq(-5, 3)})
    p, q = (
        TermQuotient.reduced(top, 1 + other * other),
        TermQuotient.reduced(more, RING.constant(3)),
    )
    values = [one.within(point) for one in (p, q, p.plus(q))]
    assert None not in values and values[0] + values[1] == values[2]
    assert p.key() == TermQuotient.reduced(top * (2 + A), (1 + other * other) * (2 + A)).key()


def test_z3_spends_the_same_however_many_questions_came_before() -> None:
    condition = Condition(
        RING, [X**2 * Y - 2, 1 - Y, X - A], ("and", [(0, "="), (1, ">"), (2, ">=")])
    )
    spent = []
    budget = Budget(10**7)
    for _ in range(3):
        before = budget.left
        assert ask(condition, budget).verdict == "sat"
        spent.append(before - budget.left)
    assert max(spent) < 2 * min(spent)  # and not the sum over all questions of the session


def test_a_search_that_found_nothing_costs_the_same_again() -> None:
    context = checker.Context()
    for name in ("u", "w"):
        context.declare(name)
    state = SearchState(context).assume(
        context.formula(checker.parse("u > 0 and w > u^2 and w < 3 and u*w < 1"))
    )
    costs = []
    for _ in range(2):
        budget = Budget(10**6)
        assert search(Closing({}, Budget(10**6), 2).problem(state), FIRST, budget) is None
        costs.append(10**6 - budget.left)
    assert costs[0] == costs[1] > 0
    with pytest.raises(Exhausted):
        search(Closing({}, Budget(10**6), 2).problem(state), FIRST, Budget(costs[0] - 1))
