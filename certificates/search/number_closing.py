"""Closing a state whose only variable is an adjoined algebraic number: signs on its interval,
arithmetic modulo its polynomial."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from flint import fmpq_poly, fmpz_poly

from certificates import checker

from .algebraic import AlgebraicNumber, exact, fraction, polynomial_text


def dense_text(poly: fmpq_poly, name: str) -> str:
    """A rational polynomial in one name as text of the statement language."""
    numerator, denominator = [int(c) for c in poly.numer().coeffs()], int(poly.denom())
    text = polynomial_text(numerator, name)
    return text if denominator == 1 else f"({text})/{denominator}"


class Adjoined:
    """An algebraic number under a name, between decimals, as the checker adjoins it: its polynomial
    rises through the root."""

    def __init__(
        self, name: str, number: AlgebraicNumber, poly: fmpz_poly, low: Fraction, high: Fraction
    ) -> None:
        self.name, self.number, self.poly, self.low, self.high = name, number, poly, low, high

    @staticmethod
    def of(number: AlgebraicNumber, digits: int, name: str) -> Adjoined:
        """The number between neighbouring decimals of so many digits."""
        scale = 10**digits
        number.narrow(Fraction(1, 4 * scale))
        while (number.low * scale).__floor__() != (number.high * scale).__floor__():
            number.refine()
        low = Fraction((number.low * scale).__floor__(), scale)
        high = low + Fraction(1, scale)
        poly = number.poly
        return Adjoined(
            name,
            number,
            poly if number.sign_of(fmpq_poly(poly).derivative()) > 0 else -poly,
            low,
            high,
        )

    def text(self, poly: fmpq_poly) -> str:
        """A polynomial in the number as text."""
        return dense_text(poly, self.name) if poly.degree() > 0 else str(fraction(poly[0]))

    def entry(self) -> list[Any]:
        """[name, polynomial, low, high, node, node]."""
        coefficients = [int(c) for c in self.poly.coeffs()]
        return [
            self.name,
            polynomial_text(coefficients, self.name),
            str(self.low),
            str(self.high),
            ["close"],
            ["close"],
        ]


def close_at_number(state: checker.State, adjoined: Adjoined) -> list[Any] | None:
    """A node that closes the state, whose only variable is the adjoined number; None where a fact's
    sign is not yet visible."""
    if state.closed:
        return ["close"]
    for index, (poly, _) in enumerate(state.facts):
        if checker.variables_of(state.context, poly) == {adjoined.name}:
            node = _contradiction(state, index, adjoined)
            if node is not None:
                return node
    if not state.choices:
        return None
    rest, nodes = state.branch(), []
    del rest.choices[0]
    for alternative in state.choices[0]:
        node = close_at_number(rest.branch(alternative), adjoined)
        if node is None:
            return None
        nodes.append(node)
    return ["cases", 0, nodes]


def _contradiction(state: checker.State, index: int, adjoined: Adjoined) -> list[Any] | None:
    poly, relation = state.facts[index]
    dense, modulus = _dense(state.context, poly, adjoined.name), fmpq_poly(adjoined.poly)
    sign = adjoined.number.sign_of(dense)
    if {">": sign > 0, ">=": sign >= 0, "=": sign == 0, "!=": sign != 0}[relation]:
        return None
    low, high, equation = _own_facts(state, adjoined)
    if sign == 0:
        quotient = dense // modulus
        if relation == ">":
            return [
                "psatz",
                [["1", [[index, 1]], "1"]],
                [[equation, dense_text(-quotient, adjoined.name)]],
            ]
        return [
            "psatz",
            [["1", [[index, 2]], "1"]],
            [[equation, dense_text(-quotient * dense, adjoined.name)]],
        ]
    if relation == "=":
        gcd, u, v = dense.xgcd(modulus)
        cofactors = [
            [index, dense_text(-u / gcd[0], adjoined.name)],
            [equation, dense_text(-v / gcd[0], adjoined.name)],
        ]
        return ["psatz", [["1", [], "1"]], cofactors]
    if dense(exact(adjoined.low)) < 0 and _no_root(dense, adjoined):
        return ["interval", index, low, high]
    return None


def _no_root(dense: fmpq_poly, adjoined: Adjoined) -> bool:
    ends = dense(exact(adjoined.low)), dense(exact(adjoined.high))
    return (
        all(ends)
        and checker.count_roots(
            [int(c) for c in dense.numer().coeffs()], adjoined.low, adjoined.high, checker.Work()
        )
        == 0
    )


def _dense(context: checker.Context, poly: checker.Poly, name: str) -> fmpq_poly:
    """A polynomial in one variable; the checker refuses any other."""
    return fmpq_poly([int(c) for c in checker.univariate(context, poly, name)]) / poly.den


def _own_facts(state: checker.State, adjoined: Adjoined) -> tuple[int, int, int]:
    """The numbers of the facts that say low <= number, number <= high and p(number) = 0."""
    shift = checker.BITS * state.context.index[adjoined.name]
    one = 1 << shift
    found: dict[str, int] = {}
    for index, (poly, relation) in enumerate(state.facts):
        if relation == ">=" and set(poly.terms) <= {0, one} and one in poly.terms:
            end = -Fraction(poly.terms.get(0, 0), poly.terms[one])
            if poly.terms[one] > 0 and end == adjoined.low:
                found.setdefault("low", index)
            if poly.terms[one] < 0 and end == adjoined.high:
                found.setdefault("high", index)
        if relation == "=" and checker.variables_of(state.context, poly) == {adjoined.name}:
            if _dense(state.context, poly, adjoined.name) == fmpq_poly(adjoined.poly):
                found.setdefault("equation", index)
    return found["low"], found["high"], found["equation"]
