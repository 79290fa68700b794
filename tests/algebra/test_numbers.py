"""Algebraic numbers: order, signs and rounding are exact."""

from fractions import Fraction

from flint import fmpq, fmpq_poly
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.algebra.conditions import candidate_numbers
from juggleproof.algebra.numbers import AlgebraicNumber, real_roots, simplest_between

fractions = st.fractions(min_value=-5, max_value=5, max_denominator=60)


@given(st.lists(fractions, min_size=1, max_size=4, unique=True))
def test_rational_roots_are_found_in_order(roots):
    poly = fmpq_poly([1])
    for root in roots:
        poly = poly * fmpq_poly([fmpq(-root.numerator, root.denominator), 1]) * fmpq_poly([1, 0, 1])
    assert [root.as_fraction() for root in real_roots(poly)] == sorted(roots)


@given(fractions, st.fractions(min_value=Fraction(1, 500), max_value=2, max_denominator=500))
def test_nothing_simpler_lies_between(low, width):
    bottom, top = (
        fmpq(low.numerator, low.denominator),
        fmpq((low + width).numerator, (low + width).denominator),
    )
    middle = simplest_between(bottom, top)
    assert bottom < middle < top
    for q in range(1, int(middle.q)):
        first = (bottom * q).floor() + 1
        assert not first < top * q


@given(st.integers(2, 200).filter(lambda n: int(n**0.5 + 0.5) ** 2 != n), fractions)
def test_order_against_rationals(n, value):
    root = real_roots(fmpq_poly([-n, 0, 1]))[1]
    assert (root > value) == (value < 0 or value * value < n)
    assert (root == value) is False


def test_equal_numbers_with_other_intervals():
    first = AlgebraicNumber([-2, 0, 1], Fraction(1), Fraction(2))
    second = AlgebraicNumber([-2, 0, 1], Fraction(7, 5), Fraction(3, 2))
    assert first == second
    assert first != real_roots(fmpq_poly([-2, 0, 1]))[0]


def test_decimals_are_rounded_exactly():
    assert (
        AlgebraicNumber([-2, 0, 1], Fraction(1), Fraction(2)).decimal(20)
        == "1.41421356237309504880"
    )
    assert AlgebraicNumber.rational(Fraction(-2, 3)).decimal(3) == "-0.667"
    assert candidate_numbers([], "alpha") == []
