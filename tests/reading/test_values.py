"""Vectors and matrices of exact scalars: the identities that define their operations, on random
rationals.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.reading.values import Matrix, ShapeError, Vector, over, plus, times
from juggleproof.statements.language import ClaimError, reals

rationals = st.builds(Fraction, st.integers(-81, 81), st.integers(1, 9))
vectors = st.tuples(rationals, rationals).map(Vector)
matrices = st.tuples(st.tuples(rationals, rationals), st.tuples(rationals, rationals)).map(Matrix)
IDENTITY = Matrix(((1, 0), (0, 1)))


@given(matrices, matrices, vectors)
def test_a_product_of_matrices_acts_as_one_after_the_other(a: Matrix, b: Matrix, x: Vector) -> None:
    assert (a * b) * x == a * (b * x)


@given(matrices, vectors, vectors, rationals)
def test_a_matrix_is_linear(a: Matrix, x: Vector, y: Vector, scalar: Fraction) -> None:
    assert a * (x + y) == a * x + a * y
    assert a * (x * scalar) == (a * scalar) * x == (a * x) * scalar
    assert a * -x == -(a * x) == -a * x


@given(matrices)
def test_the_inverse_undoes_wherever_there_is_one(a: Matrix) -> None:
    if a.determinant() == 0:
        with pytest.raises(ShapeError, match="division by zero"):
            a.inverse()
    else:
        assert a * a.inverse() == a.inverse() * a == a.power(0) == IDENTITY
        assert a.power(-2) == a.inverse() * a.inverse()


@given(matrices, st.integers(0, 4))
def test_a_power_is_repeated_multiplication(a: Matrix, exponent: int) -> None:
    assert a.power(exponent + 1) == a.power(exponent) * a


@given(vectors, vectors)
def test_a_row_times_a_vector_is_the_dot_product(x: Vector, y: Vector) -> None:
    assert Matrix((x.entries,)) * y == sum(a * b for a, b in zip(x, y, strict=True))


def test_components_are_counted_from_one() -> None:
    assert [Vector((5, 7)).component(i) for i in (1, 2)] == [5, 7]
    for wrong in (0, 3, -1):
        with pytest.raises(ShapeError):
            Vector((5, 7)).component(wrong)


def test_literal_zeros_and_ones_leave_terms_as_they_are() -> None:
    (x,) = reals("x")
    assert plus(0, x) == plus(x, 0) == times(1, x) == times(x, 1) == x
    assert times(0, x) == 0 and over(1, 3) == Fraction(1, 3)


def test_what_does_not_fit_is_refused() -> None:
    one, two = Vector((1,)), Vector((1, 2))
    square, row = Matrix(((1, 2), (3, 4))), Matrix(((1, 2),))
    for attempt in (
        lambda: one + two,
        lambda: two + 1,
        lambda: two * two,
        lambda: two / 0,
        lambda: square + row,
        lambda: square * one,
        lambda: row.inverse(),
        lambda: row.power(2),
        lambda: Vector((0.5, 1)),
        lambda: Matrix(((two, 1),)),
        lambda: square * "x",
    ):
        with pytest.raises(ClaimError):
            attempt()
