"""Closing a state whose only variable is an adjoined algebraic number: signs on its interval,
arithmetic modulo its polynomial.
"""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq_poly, fmpz_poly

from juggleproof.algebra.box_trees import tree_above_zero
from juggleproof.algebra.numbers import (
    AlgebraicNumber,
    fraction,
    polynomial_text,
)
from juggleproof.algebra.trees import HOLDS
from juggleproof.certificates import checker
from juggleproof.search.one_variable import dense_poly, dense_text
from juggleproof.statements.nodes import Adjoined, Node
from juggleproof.statements.states import SearchState


class AdjoinedNumber:
    """An algebraic number under a name, between decimals, as the checker adjoins it: its polynomial
    rises through the root.
    """

    def __init__(
        self, name: str, number: AlgebraicNumber, poly: fmpz_poly, low: Fraction, high: Fraction
    ) -> None:
        self.name, self.number, self.poly, self.low, self.high = name, number, poly, low, high

    @staticmethod
    def of(number: AlgebraicNumber, digits: int, name: str) -> AdjoinedNumber:
        """The number between neighbouring decimals with this number of digits."""
        scale = 10**digits
        number.narrow(Fraction(1, 4 * scale))
        while (number.low * scale).__floor__() != (number.high * scale).__floor__():
            number.refine()
        low = Fraction((number.low * scale).__floor__(), scale)
        high = low + Fraction(1, scale)
        poly = number.poly
        return AdjoinedNumber(
            name,
            number,
            poly if number.sign_of(fmpq_poly(poly).derivative()) > 0 else -poly,
            low,
            high,
        )

    def text(self, poly: fmpq_poly) -> str:
        """A polynomial in the number as text."""
        return dense_text(poly, self.name) if poly.degree() > 0 else str(fraction(poly[0]))

    def entry(self) -> Adjoined:
        """The number as values adjoin it; its change of sign, of rationals, closes at once."""
        text = polynomial_text([int(c) for c in self.poly.coeffs()], self.name)
        return self.name, text, str(self.low), str(self.high), ("close",), ("close",)


def close_at_number(state: SearchState, adjoined: AdjoinedNumber) -> Node | None:
    """A node that closes the state, whose only variable is the adjoined number; None where a fact's
    sign is not yet visible.
    """
    if state.closed:
        return ("close",)
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
    return "cases", 0, nodes


def _contradiction(state: SearchState, index: int, adjoined: AdjoinedNumber) -> Node | None:
    poly, relation = state.facts[index]
    dense, modulus = dense_poly(state.context, poly, adjoined.name), fmpq_poly(adjoined.poly)
    sign = adjoined.number.sign_of(dense)
    if HOLDS[relation](sign):
        return None
    low, high, equation = _own_facts(state, adjoined)
    if sign == 0:
        quotient = dense // modulus
        power, cofactor = (1, -quotient) if relation == ">" else (2, -quotient * dense)
        cofactors = [(equation, dense_text(cofactor, adjoined.name))]
        return "psatz", [("1", [(index, power)], "1")], cofactors
    if relation == "=":
        gcd, u, v = dense.xgcd(modulus)
        cofactors = [
            (index, dense_text(-u / gcd[0], adjoined.name)),
            (equation, dense_text(-v / gcd[0], adjoined.name)),
        ]
        return "psatz", [("1", [], "1")], cofactors
    tree = tree_above_zero(map(fraction, (-dense).coeffs()), adjoined.low, adjoined.high)
    return None if tree is None else ("boxes", index, [(low, high)], tree)


def _own_facts(state: SearchState, adjoined: AdjoinedNumber) -> tuple[int, int, int]:
    """The numbers of the facts low <= number, number <= high and p(number) = 0."""
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
            if dense_poly(state.context, poly, adjoined.name) == fmpq_poly(adjoined.poly):
                found.setdefault("equation", index)
    return found["low"], found["high"], found["equation"]
