"""Several constraints over a box: the box is cut, until on each piece one of them fails.

A bound of a variable is a fact that is linear in it alone, or is read off a fact
c - sum a_i (x_i - m_i)^2 >= 0 with a_i > 0, as x^2 <= 2 and (x - 1) (3 - x) >= 0 are.  An equation
gives way to both of its sides, less a number.  Source: Garloff, The Bernstein algorithm, Interval
Computations 2 (1993); Kearfott, Rigorous global search (1996), for the choice of the cut.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isqrt, lcm, prod
from operator import getitem

from juggleproof.certificates import checker
from juggleproof.certificates.nodes import Node, Product
from juggleproof.certificates.search.boxes.over_box import Bound, box_of, terms_of
from juggleproof.certificates.search.boxes.small import Box, Exponents, Terms, search_tree, value_at
from juggleproof.certificates.states import State, variables_in
from juggleproof.certificates.work import Budget

MOST_COEFFICIENTS = 1000  # of the Bernstein form of a constraint
MOST_CONSTRAINTS = 24
LETTERS = 9  # of a tree of one constraint on a piece, before that is cut
MOST_PIECES = 400
MARGIN = Fraction(1, 10**9)  # by which a fact p >= 0 is to fail, of its largest coefficient
SLACK = Fraction(1, 10**4)  # of an equation, as a part of its largest coefficient
THIN = 1 << 12  # the part of a side by which a piece at a cut reaches beyond it
FINE = 1 << 8  # the part of an end by which a bound may be rounded outwards

Sides = dict[str, tuple[Bound, Bound]]


@dataclass(frozen=True)
class Constraint:
    """A fact p > 0 or p >= 0: its number, whether it is strict, the names of its variables, and -p
    by the exponents of these.
    """

    index: int
    strict: bool
    names: list[str]
    opposite: Terms
    margin: Fraction

    def tree(self, sides: Sides, letters: int) -> str | None:
        """A tree that shows that the fact fails in the box, of few letters."""
        constant = (0,) * len(self.names)
        terms = dict(self.opposite)
        if not self.strict:
            terms[constant] = terms.get(constant, Fraction(0)) - self.margin
        return search_tree(terms, self._box(sides), letters)

    def holds(self, point: dict[str, Fraction]) -> bool:
        """Whether the fact holds at a point."""
        value = value_at(self.opposite, [point[name] for name in self.names])
        return value < 0 or not self.strict and not value

    def smears(self, sides: Sides) -> dict[str, Fraction]:
        """How much p may change along each variable of the box, as a part of the sum of all terms.

        Formula: sum |c| e |x|^e / |x| width, with the largest |x| of each side.
        """
        box = self._box(sides)
        most = [max(abs(a), abs(b)) for a, b in box]
        powers = [self._powers(k, m) for k, m in enumerate(most)]
        sizes = {e: c * prod(map(getitem, powers, e)) for e, c in self._whole.items()}
        total = sum(sizes.values())
        found = {}
        for k, (name, (low, high)) in enumerate(zip(self.names, box)):
            if total and most[k]:
                changes = sum(size * e[k] for e, size in sizes.items())
                found[name] = changes * (high - low) / (most[k] * total)
        return found

    @cached_property
    def _whole(self) -> dict[Exponents, int]:
        """The sizes of the coefficients, times one number."""
        scale = lcm(*(c.denominator for c in self.opposite.values()))
        return {e: abs(int(c * scale)) for e, c in self.opposite.items()}

    def _powers(self, place: int, size: Fraction) -> list[int]:
        """The powers of a size of one variable, times one number."""
        degree = max(e[place] for e in self.opposite)
        return [size.numerator**n * size.denominator ** (degree - n) for n in range(degree + 1)]

    def _box(self, sides: Sides) -> Box:
        return [(sides[name][0].at, sides[name][1].at) for name in self.names]


def close_by_cuts(state: State, budget: Budget) -> Node | None:
    """A node that closes the state by cuts of its box; None where at the middle of a piece all
    facts hold, or that takes too many pieces.

    >>> context = checker.Context()
    >>> for name in "xy":
    ...     context.declare(name)
    >>> text = "x^2 + y^2 <= 1 and x*y >= 2/5 and x^3 - y <= 0 - 9/10 and x + y >= 0 - 9"
    >>> state = State(context).assume(context.formula(checker.parse(text)))
    >>> node = close_by_cuts(state, Budget(10**6))
    >>> state.is_closed_by(node, {})
    True

    Raises Exhausted where the budget ends.
    """
    bounded = _perhaps_bounded(state)
    facts = ((variables_in(state.context, p), p.deg) for p, one in state.facts if one != "!=")
    if not any(
        names and bounded.issuperset(names) and len(names) + deg > 2 for names, deg in facts
    ):
        return None
    return Cuts(budget).with_equations(state, _equations(state))


def _perhaps_bounded(state: State) -> set[str]:
    """The variables that have bounds on both sides, or that a ball or an equation may give some."""
    ends: set[tuple[str, bool]] = set()
    for poly, relation in state.facts:
        names, powers = variables_in(state.context, poly), poly.terms.keys() - {0}
        units = [1 << checker.BITS * state.context.index[name] for name in names]
        if relation in (">", ">=") and powers == set(units) and len(units) == 1:
            ends.add((names[0], poly.terms[units[0]] > 0))
        elif relation != "!=" and powers <= {m for unit in units for m in (unit, 2 * unit)}:
            ends.update((name, way) for name in names for way in (True, False))
    return {name for name, way in ends if (name, not way) in ends}


def _equations(state: State) -> list[int]:
    return [k for k, (poly, relation) in enumerate(state.facts) if relation == "=" and poly.deg > 0]


class Cuts:
    """One search, with its budget and the number of pieces it may still make."""

    def __init__(self, budget: Budget) -> None:
        self.budget, self.pieces = budget, MOST_PIECES

    # ---------------------------------------------------- facts that the box and its cuts need

    def with_equations(self, state: State, equations: Sequence[int]) -> Node | None:
        """A state with its equations, of which both sides are to become facts."""
        if not equations:
            return self.with_sides(state, _balls(state))
        index, *rest = equations
        poly = state.facts[index][0]
        size = max(abs(Fraction(c, poly.den)) for c in poly.terms.values()) * SLACK
        number = str(size)
        upper = f"{number} - ({state.context.show(poly)})"
        lower = f"{number} + ({state.context.show(poly)})"
        first = len(state.facts)
        inside = state.by_sign(upper)[2].by_sign(lower)[2]
        node = self.with_equations(inside, rest)
        if node is None:
            return None

        for text, fact, factor in ((lower, first + 1, "1"), (upper, first, "-1")):
            below: Node = (
                "psatz",
                [("1", ((fact, 1),), "1"), (number, (), "1")],
                [(index, factor)],
            )
            at: Node = "psatz", [(number, (), "1")], [(fact, "-1"), (index, factor)]
            node = _sign(text, [below, at, node])
        return node

    def with_sides(self, state: State, balls: Sequence[Ball]) -> Node | None:
        """A state with the bounds of variables that balls imply, one after another."""
        for ball in balls:
            for name in ball.parts:
                ends = _bounds(state, name)
                for way in (1, -1):
                    end, fact = ball.end(name, way), len(state.facts)
                    if way in ends and way * (ends[way] - end) <= ball.reach(name) / 10:
                        continue
                    text = _line(name, end)
                    below, _, above = state.by_sign(text)
                    node = self.with_sides(below if way > 0 else above, balls)
                    if node is None:
                        return None
                    there, beyond = ball.at(name, way, fact), ball.beyond(name, way, fact)
                    return _sign(text, [node, there, beyond] if way > 0 else [beyond, there, node])
        sides = box_of(state)
        return self.piece(state, _constraints(state, sides), sides)

    # ---------------------------------------------------------------------- pieces

    def piece(self, state: State, constraints: list[Constraint], sides: Sides) -> Node | None:
        """A piece of the box: by a constraint that fails in all of it, or cut."""
        self.pieces -= 1
        if self.pieces < 0 or not constraints:
            return None
        node = self.leaf(constraints, sides, LETTERS)
        if node is not None:
            return node
        middle = {name: (low.at + high.at) / 2 for name, (low, high) in sides.items()}
        if all(one.holds(middle) for one in constraints):
            return None
        self.budget.spend(20 * len(constraints))
        changes = dict.fromkeys(sides, Fraction(0))
        for one in constraints:
            for name, change in one.smears(sides).items():
                changes[name] += change
        return self.cut(state, constraints, sides, max(changes, key=changes.__getitem__))

    def leaf(self, constraints: list[Constraint], sides: Sides, letters: int) -> Node | None:
        """A constraint that fails in all of a box."""
        for one in constraints:
            size = len(one.opposite)
            self.budget.spend(20 + 4 * size)
            tree = one.tree(sides, letters)
            if tree is not None:
                facts = [(sides[name][0].fact, sides[name][1].fact) for name in one.names]
                return "boxes", one.index, facts, tree
        return None

    def cut(
        self, state: State, constraints: list[Constraint], sides: Sides, name: str
    ) -> Node | None:
        """A piece cut at the middle of a side: below it, at it and above it."""
        low, high = sides[name]
        middle, fact = (low.at + high.at) / 2, len(state.facts)
        end = Bound(middle, fact, Fraction(1))
        below, at, above = state.by_sign(_line(name, middle))
        lower = self.piece(below, constraints, {**sides, name: (low, end)})
        upper = lower and self.piece(above, constraints, {**sides, name: (end, high)})
        there = upper and self.at_cut(at, constraints, sides, name, middle)
        if lower is None or upper is None or there is None:
            return None
        return _sign(_line(name, middle), [lower, there, upper])

    def at_cut(
        self,
        state: State,
        constraints: list[Constraint],
        sides: Sides,
        name: str,
        middle: Fraction,
    ) -> Node | None:
        """Where a variable is a number: the rule for boxes wants bounds, so it is put between two
        that are close to it.
        """
        equation, (low, high) = len(state.facts) - 1, sides[name]
        step = (high.at - low.at) / THIN
        constant, one = (str(step), (), "1"), Fraction(1)
        last, upper = _line(name, middle + step), Bound(middle + step, equation + 1, one)
        first, lower = _line(name, middle - step), Bound(middle - step, equation + 2, one)
        above: list[Node] = [
            ("psatz", [constant], [(equation + 1, "1"), (equation, "-1")]),
            ("psatz", [("1", ((equation + 1, 1),), "1"), constant], [(equation, "-1")]),
        ]
        node = self.leaf(constraints, {**sides, name: (low, upper)}, LETTERS)
        if node is not None:
            return _sign(last, [node, *above])
        below: list[Node] = [
            ("psatz", [("1", ((equation + 2, 1),), "1"), constant], [(equation, "1")]),
            ("psatz", [constant], [(equation + 2, "-1"), (equation, "1")]),
        ]
        inside = state.by_sign(last)[0].by_sign(first)[2]
        node = self.piece(inside, constraints, {**sides, name: (lower, upper)})
        return None if node is None else _sign(last, [_sign(first, [*below, node]), *above])


# -------------------------------------------------------------------------------------------------
# What a state says of its box: constraints, and bounds by sums of squares.


@dataclass(frozen=True)
class Ball:
    """A fact c - sum a_i (x_i - m_i)^2 > 0 or >= 0 with a_i > 0: its number, c, and (a_i, m_i) by
    the names.
    """

    index: int
    constant: Fraction
    parts: dict[str, tuple[Fraction, Fraction]]

    def reach(self, name: str) -> Fraction:
        """A number above the root of c / a_i."""
        ratio = max(self.constant / self.parts[name][0], Fraction(0))
        return Fraction(isqrt(int(ratio * FINE**2)) + 1, FINE)

    def end(self, name: str, way: int) -> Fraction:
        """A bound of the variable, from above (way 1) or from below (way -1)."""
        return self.parts[name][1] + way * self.reach(name)

    def _products(self, name: str) -> list[Product]:
        """The fact, the squares of the other variables, and a_i s^2 - c: they sum to a_i s^2 -
        a_i (x_i - m_i)^2.
        """
        size = self.parts[name][0] * self.reach(name) ** 2 - self.constant
        squares: list[Product] = [
            (str(a), (), _line(other, m)) for other, (a, m) in self.parts.items() if other != name
        ]
        return [("1", ((self.index, 1),), "1"), *squares, (str(size), (), "1")]

    def at(self, name: str, way: int, fact: int) -> Node:
        """The node where the variable is at its bound, as the equation `fact` says."""
        a, m = self.parts[name]
        factor = f"{a}*({_line(name, m - way * self.reach(name))})"
        return "psatz", self._products(name), [(fact, factor)]

    def beyond(self, name: str, way: int, fact: int) -> Node:
        """The node where the variable is beyond its bound, as `fact` says."""
        a, s = self.parts[name][0], self.reach(name)
        own: list[Product] = [
            (str(a), (), _line(name, self.end(name, way))),
            (str(2 * a * s), ((fact, 1),), "1"),
        ]
        return "psatz", [*self._products(name), *own], []


def _balls(state: State) -> list[Ball]:
    balls = []
    for index, (poly, relation) in enumerate(state.facts):
        if relation not in (">", ">=") or poly.deg != 2:
            continue
        names = variables_in(state.context, poly)
        terms = terms_of(state, poly, names)
        units = [tuple(int(j == k) for j in range(len(names))) for k in range(len(names))]
        squares = [-terms.get(tuple(2 * e for e in unit), Fraction(0)) for unit in units]
        slopes = [terms.get(unit, Fraction(0)) for unit in units]
        if any(a <= 0 for a in squares) or any(max(e) < sum(e) for e in terms):
            continue
        centres = [b / (2 * a) for a, b in zip(squares, slopes)]
        constant = terms.get((0,) * len(names), Fraction(0))
        constant += sum((a * m**2 for a, m in zip(squares, centres)), start=Fraction(0))
        balls.append(Ball(index, constant, dict(zip(names, zip(squares, centres)))))
    return balls


def _constraints(state: State, sides: Sides) -> list[Constraint]:
    """The facts about the variables of the box, but for its bounds, smaller ones first."""
    found = []
    for index, (poly, relation) in enumerate(state.facts):
        names = variables_in(state.context, poly)
        if relation not in (">", ">=") or not sides.keys() >= set(names):
            continue
        if poly.deg == len(names) == 1:
            continue
        terms = {e: -c for e, c in terms_of(state, poly, names).items()}
        size = prod(1 + max(e[k] for e in terms) for k in range(len(names)))
        if names and size <= MOST_COEFFICIENTS:
            margin = max(map(abs, terms.values())) * MARGIN
            found.append((size, Constraint(index, relation == ">", names, terms, margin)))
    found.sort(key=lambda one: one[0])
    return [constraint for _, constraint in found[:MOST_CONSTRAINTS]]


def _bounds(state: State, name: str) -> dict[int, Fraction]:
    """The closest bound of a variable from above (1) and from below (-1), as far as there is
    one.
    """
    ends: dict[int, Fraction] = {}
    one = 1 << checker.BITS * state.context.index[name]
    for poly, relation in state.facts:
        if relation in (">", ">=") and one in poly.terms and set(poly.terms) <= {0, one}:
            at, way = Fraction(-poly.terms.get(0, 0), poly.terms[one]), -1
            way = 1 if poly.terms[one] < 0 else -1
            ends[way] = at if way not in ends else way * min(way * ends[way], way * at)
    return ends


def _line(name: str, end: Fraction) -> str:
    """The text of a variable less a number."""
    return name if not end else f"{name} - {end}" if end > 0 else f"{name} + {-end}"


def _sign(text: str, cases: Sequence[Node]) -> Node:
    below, at, above = cases
    return "sign", text, below, at, above
