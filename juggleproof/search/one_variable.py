"""Facts about one variable: complete.  The line is cut at rationals, so that each piece holds one
root of all that is assumed; to the left of the root, at it and to the right of it, what fails has
the wrong sign throughout, and its Bernstein form shows that.

Source: Basu, Pollack and Roy, Algorithms in Real Algebraic Geometry (2006), sections 10.2 and 10.4;
Polya and Szegoe, Problems and Theorems in Analysis II (1976), part VI, problem 49: a polynomial
without a root in a closed interval has positive Bernstein coefficients on short pieces of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from flint import fmpq, fmpq_poly

from juggleproof.algebra.numbers import (
    AlgebraicNumber,
    by_ends,
    exact,
    fraction,
    integer_polynomial,
    polynomial_text,
    real_roots,
    sign,
    simplest_between,
)
from juggleproof.algebra.trees import HOLDS, leaves
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget


def dense_poly(context: checker.Context, poly: checker.Poly, name: str) -> fmpq_poly:
    """A polynomial in one variable; the checker refuses any other."""
    return fmpq_poly([int(c) for c in checker.univariate(context, poly, name)]) / poly.den


def dense_text(poly: fmpq_poly, name: str) -> str:
    """A rational polynomial in one name as text of the statement language."""
    numerator, denominator = [int(c) for c in poly.numer().coeffs()], int(poly.denom())
    text = polynomial_text(numerator, name)
    return text if denominator == 1 else f"({text})/{denominator}"


def close_in_one_variable(state: SearchState, budget: Budget) -> Node | None:
    """A node that closes a state over one variable; None where some value of it meets what is
    assumed, or the degree of all factors together is over 60.

    >>> context = checker.Context()
    >>> context.declare("x")
    >>> text = "x^3 = 2 and x^2 > 3 or x^2 = 2 and x >= 2"
    >>> state = SearchState(context).assume(context.formula(checker.parse(text)))
    >>> node = close_in_one_variable(state, Budget(10**6))
    >>> state.is_closed_by(node, {})
    True

    Raises Exhausted where the budget ends.
    """
    if len(state.context.index) != 1:
        return None
    (name,) = state.context.index
    factors: dict[tuple[int, ...], fmpq_poly] = {}
    for _, poly, _ in (atom for formula in state.formulas for atom in leaves(formula)):
        for factor, _ in integer_polynomial(dense_poly(state.context, poly, name)).factor()[1]:
            factors[tuple(int(c) for c in factor.coeffs())] = fmpq_poly(factor)
    degree = sum(int(factor.degree()) for factor in factors.values())
    if degree > limits.MOST_LINE_DEGREE:
        return None
    budget.spend(200 + degree**3)
    whole = fmpq_poly([1])
    for factor in factors.values():
        whole *= factor
    return OneVariableSearch(name, budget).whole(state, real_roots(whole), *_bounds(whole))


def _bounds(poly: fmpq_poly) -> tuple[fmpq, fmpq]:
    """Whole numbers beyond all complex roots.  Source: Cauchy's bound."""
    lead = abs(poly[poly.degree()])
    size = 2 + max((abs(c) / lead for c in poly.coeffs()[:-1]), default=fmpq(0)).floor()
    return fmpq(-size), fmpq(size)


@dataclass(frozen=True)
class PieceEnd:
    """An end of a piece, and the number of the fact that bounds the variable there."""

    at: fmpq
    fact: int


@dataclass(frozen=True)
class OpenPiece:
    """Where a state is to be closed: between two ends, or at a root; what fails at the sample fails
    in all of it.

    `zero` is the number of an equation with the sample as a root, `side` that of a fact by which
    the root's polynomial, or its opposite, is positive.
    """

    sample: AlgebraicNumber | fmpq
    low: PieceEnd | None = None
    high: PieceEnd | None = None
    zero: int | None = None
    side: int | None = None

    def sign_of(self, poly: fmpq_poly) -> int:
        """The sign of a polynomial at the sample."""
        if isinstance(self.sample, AlgebraicNumber):
            return self.sample.sign_of(poly)
        return sign(poly(self.sample))


class OneVariableSearch:
    """The search over one variable, with its budget."""

    def __init__(self, name: str, budget: Budget) -> None:
        self.name, self.budget = name, budget

    def dense(self, state: SearchState, index: int) -> fmpq_poly:
        """The polynomial of a fact."""
        return dense_poly(state.context, state.facts[index][0], self.name)

    # ------------------------------------------------------------ the pieces

    def whole(
        self, state: SearchState, roots: Sequence[AlgebraicNumber], low: fmpq, high: fmpq
    ) -> Node | None:
        """All of the line, with its roots between two bounds."""
        cuts = [low]
        for left, right in zip(roots, roots[1:]):
            while left.high >= right.low:
                left.refine()
                right.refine()
            cuts.append(simplest_between(exact(left.high), exact(right.low)))
        return self.between(state, roots, [*cuts, high], None, None)

    def between(
        self,
        state: SearchState,
        roots: Sequence[AlgebraicNumber],
        cuts: Sequence[fmpq],
        low: PieceEnd | None,
        high: PieceEnd | None,
    ) -> Node | None:
        """The part of the line between two ends, with the cuts in it."""
        if cuts:
            middle = len(cuts) // 2
            return self.cut(
                state,
                cuts[middle],
                lambda below, end: self.between(below, roots, cuts[:middle], low, end),
                lambda above, end: self.between(above, roots, cuts[middle + 1 :], end, high),
            )
        inside = [one for one in roots if _after(low, one) and _before(one, high)]
        if inside:
            return self.at_root(state, inside[0], low, high)
        sample = low.at + 1 if low and not high else high.at - 1 if high and not low else fmpq(0)
        if low and high:
            sample = (low.at + high.at) / 2
        return self.settle(state, OpenPiece(sample, low, high))

    def cut(
        self,
        state: SearchState,
        at: fmpq,
        lower: Callable[[SearchState, PieceEnd], Node | None],
        upper: Callable[[SearchState, PieceEnd], Node | None],
    ) -> Node | None:
        """A part of the line cut at a rational, with what closes it below and above that."""
        text = dense_text(fmpq_poly([-at.p, at.q]), self.name)
        below, there, above = state.by_sign(text)
        end = PieceEnd(at, len(state.facts))
        return _by_sign(
            text,
            lambda: lower(below, end),
            lambda: self.settle(there, OpenPiece(at, zero=end.fact)),
            lambda: upper(above, end),
        )

    def at_root(
        self, state: SearchState, root: AlgebraicNumber, low: PieceEnd | None, high: PieceEnd | None
    ) -> Node | None:
        """A piece with one root: where the root's polynomial is negative, 0 and positive."""
        text, fact = polynomial_text(root.coefficients, self.name), len(state.facts)
        while not (_after(low, root, False) and _before(root, high, False)):
            root.refine()
        left = exact(root.low) - 1 if low is None else (low.at + exact(root.low)) / 2
        right = exact(root.high) + 1 if high is None else (exact(root.high) + high.at) / 2
        if fmpq_poly(root.coefficients)(left) > 0:
            left, right = right, left
        below, there, above = state.by_sign(text)
        return _by_sign(
            text,
            lambda: self.settle(below, OpenPiece(left, low, high, side=fact)),
            lambda: self.settle(there, OpenPiece(root, low, high, zero=fact)),
            lambda: self.settle(above, OpenPiece(right, low, high, side=fact)),
        )

    # ------------------------------------------------------------ what fails in a piece

    def settle(self, state: SearchState, piece: OpenPiece) -> Node | None:
        """A node by a fact that fails, or by cases in each of which one does."""
        self.budget.spend(20 + 5 * len(state.facts))
        if state.closed:
            return ("close",)
        for index, (_, relation) in enumerate(state.facts):
            if not HOLDS[relation](piece.sign_of(self.dense(state, index))):
                return self.refuted(state, index, piece)
        for index, alternatives in enumerate(state.choices):
            rest = state.branch()
            del rest.choices[index]
            nodes: list[Node] = []
            for alternative in alternatives:
                node = self.settle(rest.branch(alternative), piece)
                if node is None:
                    break
                nodes.append(node)
            else:
                return "cases", index, nodes
        return None

    def refuted(self, state: SearchState, index: int, piece: OpenPiece) -> Node | None:
        """The node for a fact that fails at the sample of a piece."""
        poly, relation = self.dense(state, index), state.facts[index][1]
        value = piece.sign_of(poly)
        if piece.zero is not None:
            equation = self.dense(state, piece.zero)
            rest = poly % equation
            if rest.degree() < 1:
                cofactor = (poly - rest) / equation
                return self.by_remainder(index, relation, rest[0], cofactor, poly, piece.zero)
        power = 0
        if piece.side is not None:
            factor = self.dense(state, piece.side)
            while poly % factor == 0:
                poly, power = poly / factor, power + 1
        positive = [] if piece.side is None or not power else [(piece.side, power)]
        form = self.form(state, poly * value, piece.low, piece.high)
        if form is None:
            return self.halved(state, index, piece)
        products = [(str(c), (*positive, *powers), "1") for c, powers in form]
        if relation == "=":
            return "psatz", products, [(index, str(-value))]
        return "psatz", [("1", ((index, 1),), "1"), *products], []

    def by_remainder(
        self, index: int, relation: str, rest: fmpq, cofactor: fmpq_poly, poly: fmpq_poly, zero: int
    ) -> Node:
        """The node for a fact v + m E, where the equation E = 0 holds and v is a number."""

        def times(factor: fmpq_poly) -> list[tuple[int, str]]:
            return [(zero, dense_text(factor, self.name))] if factor else []

        constant = [(str(abs(fraction(rest))), (), "1")] if rest else []
        if relation == "=":
            way = sign(rest)
            return "psatz", constant, [(index, str(-way)), *times(way * cofactor)]
        if relation == "!=":
            return "psatz", [("1", ((index, 2),), "1")], times(-cofactor * poly)
        return "psatz", [("1", ((index, 1),), "1"), *constant], times(-cofactor)

    def halved(self, state: SearchState, index: int, piece: OpenPiece) -> Node | None:
        """The same fact in the two halves of a piece, and what fails between them."""
        low, high = piece.low, piece.high
        if low is None or high is None:
            raise ValueError("beyond its bounds a polynomial has coefficients of one sign")
        return self.cut(
            state,
            (low.at + high.at) / 2,
            lambda below, end: self.refuted(below, index, replace(piece, high=end)),
            lambda above, end: self.refuted(above, index, replace(piece, low=end)),
        )

    def form(
        self, state: SearchState, poly: fmpq_poly, low: PieceEnd | None, high: PieceEnd | None
    ) -> list[tuple[Fraction, list[tuple[int, int]]]] | None:
        """A polynomial without a root between the ends as a positive combination of powers of what
        is positive there; None where its coefficients differ in sign.

        Formula: sum b_k comb(n, k) (x - low)^k (high - x)^(n - k) / (high - low)^n, or with one end
        sum c_k |x - end|^k.
        """
        degree = max(int(poly.degree()), 0)
        self.budget.spend(10 + degree**2)
        if low is None and high is None:
            constant = fraction(poly[0])
            return None if degree or constant < 0 else [(constant, [])] if constant else []

        def scaled(end: PieceEnd | None) -> tuple[Fraction, Fraction] | None:
            if end is None:
                return None
            return fraction(end.at), abs(fraction(self.dense(state, end.fact)[1]))

        def powers(k: int) -> list[tuple[int, int]]:
            own = [(low.fact, k)] if low else []
            own += [(high.fact, degree - k if low else k)] if high else []
            return [(fact, power) for fact, power in own if power]

        values = by_ends(poly, degree, scaled(low), scaled(high))
        if min(values) < 0:
            return None
        return [(value, powers(k)) for k, value in enumerate(values) if value]


def _after(end: PieceEnd | None, root: AlgebraicNumber, root_only: bool = True) -> bool:
    """Whether the root, or all of its interval, is above the end."""
    return end is None or (fraction(end.at) < (root if root_only else root.low))


def _before(root: AlgebraicNumber, end: PieceEnd | None, root_only: bool = True) -> bool:
    """Whether the root, or all of its interval, is below the end."""
    return end is None or (root < fraction(end.at) if root_only else root.high < fraction(end.at))


def _by_sign(text: str, *cases: Callable[[], Node | None]) -> Node | None:
    """The node of three cases, as far as each is closed."""
    nodes: list[Node] = []
    for case in cases:
        node = case()
        if node is None:
            return None
        nodes.append(node)
    below, at, above = nodes
    return "sign", text, below, at, above
