"""Algebraic numbers as polynomials in one of them."""

from __future__ import annotations

from flint import fmpq, fmpq_poly

from juggleproof.algebra import limits
from juggleproof.algebra.number_field import common_field, degree
from juggleproof.algebra.numbers import AlgebraicNumber, real_roots
from juggleproof.statements.work import Budget


def root(*coefficients: int, number: int = -1) -> AlgebraicNumber:
    """A root of a polynomial, constant first."""
    return real_roots(fmpq_poly(list(coefficients)))[number]


VALUES: list[dict[str, fmpq | AlgebraicNumber]] = [
    {"x": root(-2, 0, 1), "y": root(-3, 0, 1)},
    {"x": root(-2, 0, 1), "y": root(-3, 0, 1), "z": root(-6, 0, 1), "w": root(1, 0, -10, 0, 1)},
    {"x": root(-1, 0, 2), "y": root(-1, 0, 2, number=0), "z": fmpq(3, 7)},
    {"x": root(1, -3, 0, 1, number=0), "y": root(1, -3, 0, 1, number=1)},
    {"x": root(-2, 0, 0, 1), "y": root(-1, -1, 1), "z": root(-7, 1)},
]


def test_polynomials_in_one_number_are_the_values_holds() -> None:
    for values in VALUES:
        field = common_field(values, Budget(10**6))
        assert field is not None
        polys, number = field
        assert number is not None
        assert list(polys) == list(values)
        for name, value in values.items():
            if isinstance(value, fmpq):
                assert polys[name] == fmpq_poly([value])
                continue
            own = fmpq_poly(value.poly)
            assert own(polys[name]) % fmpq_poly(number.poly) == 0
            gaps = [polys[name] - end for end in (value._low, value._high)]
            assert [number.sign_of(gap) for gap in gaps] in ([1, -1], [0, 0])


def test_the_field_is_no_larger_than_it_must_be_holds() -> None:
    found = [common_field(values, Budget(10**6)) for values in VALUES]
    assert [degree(one[1]) for one in found if one and one[1]] == [4, 4, 2, 3, 6]


def test_rational_values_need_no_number_holds() -> None:
    assert common_field({"x": fmpq(1, 2)}, Budget(10)) == ({"x": fmpq_poly([fmpq(1, 2)])}, None)


def test_rejects_a_field_of_too_high_a_degree() -> None:
    high = {"x": root(*[-2, *[0] * 8, 1]), "y": root(*[-3, *[0] * 8, 1])}
    assert 9 * 9 > limits.MOST_FIELD_DEGREE
    assert common_field(high, Budget(10**6)) is None
