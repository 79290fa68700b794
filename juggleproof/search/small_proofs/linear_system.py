"""Linear facts and disjunctions of such: decided, by an exact point or by Farkas certificates.

Formula: linear facts p_i > 0, p_j >= 0 and p_k = 0 have no common point <=> there are numbers c,
those of inequalities >= 0 and not all of a strict one 0, with sum c_i p_i = 0 identically, where
1 > 0 counts as a strict fact.  Both are read off one linear program: maximise t <= 1 under
p_i >= t x_0 for the strict p_i made homogeneous by x_0.  A basis that floats propose, if any, is
solved exactly; where it is not the last one, exact pivots go on from it.

Source: Motzkin's transposition theorem; Schrijver, Theory of Linear and Integer Programming (1986),
sections 7.3 and 7.8.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Union

from flint import fmpq, fmpz_mat

from juggleproof.algebra.numbers import fraction
from juggleproof.algebra.trees import HOLDS, leaves, truth
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.statements.nodes import Certificate, Counterexample, Node, Point
from juggleproof.statements.states import SearchState, state_of
from juggleproof.statements.work import Budget, Exhausted, unfolded

ONE = -1  # the place of x_0, which the constant of a polynomial is a multiple of
Row = dict[int, int]  # the number of a variable -> its coefficient
Fact = tuple[checker.Poly, str]
Choice = list[Union[checker.Atom, checker.Join]]
FactKey = tuple[frozenset[tuple[int, int]], int, str]
Values = dict[int, Fraction]  # the number of a variable -> its value

# -------------------------------------------------------------------------------------------------
# Whether all is linear.


def row_of(poly: checker.Poly) -> Row | None:
    """The coefficients of a polynomial times its denominator; None where it is not linear.

    >>> context = checker.Context()
    >>> context.declare("x")
    >>> row_of(context.polynomial("x/2 - 3")), row_of(context.polynomial("x^2"))
    ({0: 1, -1: -6}, None)
    """
    row: Row = {}
    for m, c in poly.terms.items():
        place, exponent = divmod(m.bit_length() - 1, checker.BITS)
        if m and (exponent or m & m - 1):
            return None
        row[place if m else ONE] = c
    return row


def is_linear(formula: checker.Formula) -> bool:
    """Whether every atom of a formula is linear."""
    return all(row_of(poly) is not None for _, poly, _ in leaves(formula))


def holds_at(formula: checker.Formula, point: Mapping[int, Fraction]) -> bool:
    """Whether a formula of linear atoms holds at a point, which is 0 where it says nothing."""

    def decide(atom: checker.Atom) -> bool:
        return HOLDS[atom[2]](value_at(row_of(atom[1]) or {}, point))

    return truth(formula, decide) is True


def value_at(row: Row, point: Mapping[int, Fraction]) -> Fraction:
    """The value of a row at a point."""
    zero = Fraction(0)
    return sum((c * point.get(k, zero) for k, c in row.items() if k != ONE), zero) + row.get(ONE, 0)


# -------------------------------------------------------------------------------------------------
# Facts alone: one linear program.


@dataclass(frozen=True)
class Vertex:
    """A point that meets all facts."""

    values: Values


@dataclass(frozen=True)
class Farkas:
    """Positive multiples of inequalities, and multiples of equations, whose sum is 0 identically,
    by the number of the fact; `one` is what 1 > 0 is multiplied by.
    """

    multiples: dict[int, int]
    one: int


# the rows that a basis holds with equality, and its columns, for a program in rows whose last
# column is maximised
Basis = tuple[Sequence[int], Sequence[int]]
FindBasis = Callable[[Sequence[Row], Sequence[str], int, Budget], Basis]


def no_basis(entries: Sequence[Row], relations: Sequence[str], t: int, budget: Budget) -> Basis:
    """No proposal: what is small needs none."""
    return (), ()


def solve(
    facts: Sequence[tuple[Row, str]], budget: Budget, find_basis: FindBasis = no_basis
) -> Vertex | Farkas | None:
    """A point of facts > 0, >= 0 and = 0, or how they contradict one another.

    Raises Exhausted where the budget ends.

    >>> solve([({0: 1, ONE: -1}, ">"), ({0: -2, ONE: 5}, ">=")], Budget(10**4))
    Vertex(values={0: Fraction(2, 1)})
    >>> solve([({0: 1, ONE: -1}, ">"), ({0: -2, ONE: 1}, ">=")], Budget(10**4))
    Farkas(multiples={0: 2, 1: 1}, one=1)
    """
    rows = [*(row for row, _ in facts), {ONE: 1}]
    relations = [*(relation for _, relation in facts), ">"]
    places = sorted({place for row in rows for place in row})
    column = {place: k for k, place in enumerate(places)}
    t = len(places)
    entries = [{column[place]: c for place, c in row.items()} for row in rows]
    for entry, relation in zip(entries, relations):
        if relation == ">":
            entry[t] = -1
    budget.spend(100 + sum(map(len, entries)))
    active, basic = find_basis(entries, relations, t, budget)
    by_floats = from_basis(facts, entries, places, active, basic, budget)
    return by_floats or by_pivots(facts, entries, places, {*active}, basic, budget)


def from_basis(
    facts: Sequence[tuple[Row, str]],
    entries: Sequence[Row],
    places: Sequence[int],
    active: Sequence[int],
    basic: Sequence[int],
    budget: Budget,
) -> Vertex | Farkas | None:
    """What the basis gives that holds these rows with equality; None where it gives nothing."""
    t = len(places)
    budget.spend(len(active) ** 3 // 500)
    square = [[entries[r].get(k, 0) for k in basic] for r in active]
    if t not in basic:
        solved = dict(zip(basic, solution(square, [-entries[r].get(t, 0) for r in active])))
        return vertex(facts, {places[k]: value for k, value in solved.items()})
    turned = [list(line) for line in zip(*square)]
    weights = dict(zip(active, solution(turned, [-int(k == t) for k in basic])))
    return farkas(facts, {r: c for r, c in weights.items() if c})


def vertex(facts: Sequence[tuple[Row, str]], ray: Values) -> Vertex | None:
    """The point on a ray where x_0 = 1; None where there is none, or it does not meet the facts."""
    scale = ray.get(ONE, Fraction(0))
    if scale <= 0:
        return None
    point = {place: value / scale for place, value in ray.items() if place != ONE}
    fits = all(HOLDS[relation](value_at(row, point)) for row, relation in facts)
    return Vertex(simplest(facts, point)) if fits else None


def farkas(facts: Sequence[tuple[Row, str]], weights: Mapping[int, Fraction]) -> Farkas | None:
    """The contradiction by these multiples, those of 1 > 0 last; None where they make none."""
    scale = Fraction(lcm(*(c.denominator for c in weights.values())))
    scale /= gcd(*(int(c * scale) for c in weights.values())) or 1
    multiples = {r: int(c * scale) for r, c in sorted(weights.items())}
    one = multiples.pop(len(facts), 0)
    total: Row = {ONE: one}
    strict = one > 0
    for r, c in multiples.items():
        row, relation = facts[r]
        if c < 0 and relation != "=":
            return None
        strict = strict or relation == ">"
        for place, value in row.items():
            total[place] = total.get(place, 0) + c * value
    return Farkas(multiples, one) if strict and one >= 0 and not any(total.values()) else None


def simplest(facts: Sequence[tuple[Row, str]], point: Values) -> Values:
    """A point with the same small denominator for all values where one is near, else this one."""
    for most in (1, 2, 10, 1000):
        near = {place: value.limit_denominator(most) for place, value in point.items()}
        if all(HOLDS[relation](value_at(row, near)) for row, relation in facts):
            return near
    return point


def solution(matrix: Sequence[Sequence[int]], right: Sequence[int]) -> list[Fraction]:
    """The solution of a square system; no numbers where it is none, or has no single solution."""
    if not right or len(matrix) != len(matrix[0]):
        return []
    try:
        found = fmpz_mat(matrix).solve(fmpz_mat([[c] for c in right]))
    except ZeroDivisionError:
        return []
    return [Fraction(int(c.p), int(c.q)) for c in found.entries()]


def by_pivots(
    facts: Sequence[tuple[Row, str]],
    entries: Sequence[Row],
    places: Sequence[int],
    active: Collection[int],
    basic: Sequence[int],
    budget: Budget,
) -> Vertex | Farkas | None:
    """The same by an exact simplex that begins with a basis, where floats have not shown enough.

    Every basis is feasible, as the program is homogeneous; Bland's rule ends the pivots.

    Source: Bland, New finite pivoting rules for the simplex method, Mathematics of Operations
    Research 2 (1977).
    """
    t = len(places)
    # a row is a slack >= 0, an equation two opposite ones: their numbers follow those of columns
    signed = [(r, 1) for r in range(len(entries))]
    signed += [(r, -1) for r, (_, relation) in enumerate(facts) if relation == "="]
    table: dict[int, dict[int, fmpq]] = {
        t + 1 + k: {column: fmpq(sign * c) for column, c in entries[r].items()}
        for k, (r, sign) in enumerate(signed)
    }

    def pivot(leaving: int, entering: int) -> None:
        row = table.pop(leaving)
        slope = row.pop(entering)
        new = {k: -c / slope for k, c in row.items()}
        new[leaving] = 1 / slope
        for other in table.values():
            c = other.pop(entering, None)
            if c is not None:
                budget.spend(1 + len(new) // 4)
                for k, value in new.items():
                    total = other.get(k, 0) + c * value
                    if total:
                        other[k] = total
                    else:
                        other.pop(k, None)
        table[entering] = new

    order = {k: (signed[k - t - 1][0] not in active, len(row), k) for k, row in table.items()}
    for column in [*(k for k in basic if k != t), *range(t + 1)]:
        rows = [k for k, row in table.items() if k > t and column in row]
        if rows and column not in table:
            pivot(min(rows, key=order.__getitem__), column)
    while True:
        budget.spend(10 + len(table))
        # where no row holds t back, it is not in the table
        rising = [k for k, c in table[t].items() if c > 0] if t in table else [t]
        if not rising:
            weights: dict[int, Fraction] = {}
            for k, c in table[t].items():
                r, sign = signed[k - t - 1]
                weights[r] = weights.get(r, Fraction(0)) - sign * fraction(c)
            return farkas(facts, {r: c for r, c in weights.items() if c})
        entering = min(rising)
        blocking = [k for k, row in table.items() if k > t and row.get(entering, 0) < 0]
        if not blocking:
            own = (table.get(k, {}).get(entering, fmpq(0)) for k in range(t))
            return vertex(facts, dict(zip(places, map(fraction, own))))
        pivot(min(blocking), entering)


# -------------------------------------------------------------------------------------------------
# Facts and disjunctions: the program again on each branch, as far as its point fails.


@dataclass(frozen=True)
class ContradictoryFacts:
    """Facts that contradict one another."""

    products: Sequence[tuple[FactKey | None, Fraction]]
    cofactors: Sequence[tuple[FactKey, Fraction]]

    @property
    def uses(self) -> frozenset[object]:
        """The facts and disjunctions below which this holds."""
        return frozenset(key for key, _ in (*self.products, *self.cofactors))


@dataclass(frozen=True)
class CaseSplit:
    """Cases of a disjunction, or of the sign of the polynomial of a fact != 0."""

    on: Choice | Fact
    parts: Sequence[Tree]
    uses: frozenset[object]


Tree = Union["ContradictoryFacts", "CaseSplit"]


def key_of(fact: Fact) -> FactKey:
    """The same for equal facts of any branch."""
    poly, relation = fact
    return frozenset(poly.terms.items()), poly.den, relation


def decide(
    state: SearchState, budget: Budget, find_basis: FindBasis, depth: int = 0
) -> Vertex | Tree | None:
    """A point that satisfies a state of linear facts and disjunctions, or why there is
    none; None where cases are nested too deep.

    A case whose contradiction does not use what the case assumes settles all cases.
    """
    facts = [fact for fact in state.facts if fact[1] != "!="]
    found = solve([(row_of(poly) or {}, relation) for poly, relation in facts], budget, find_basis)
    if isinstance(found, Farkas):
        return leaf(facts, found)
    if found is None or depth > limits.MOST_SPLITS:
        return None
    open_choices = [
        one for one in state.choices if not any(holds_at(part, found.values) for part in one)
    ]
    zeros = (
        (poly, relation)
        for poly, relation in state.facts
        if relation == "!=" and not holds_at(("atom", poly, relation), found.values)
    )
    different = next(zeros, None)
    if different is None and not open_choices:
        return found
    on = different or min(open_choices, key=len)
    parts: list[Tree] = []
    uses: set[object] = {use_of(on)}
    assumed = uses_of(state)
    undecided = False
    for case in cases_of(state, on):
        part = decide(case, budget, find_basis, depth + 1)
        if isinstance(part, Vertex):
            return part
        if part is None:
            undecided = True
        elif part.uses <= assumed:
            return part
        else:
            parts.append(part)
            uses |= part.uses & assumed
    return None if undecided else CaseSplit(on, parts, frozenset(uses))


def cases_of(state: SearchState, on: Choice | Fact) -> list[SearchState]:
    """The states of the cases: of a disjunction each alternative, of p != 0 p < 0 and p > 0."""
    if isinstance(on, tuple):
        below, _, above = state.by_sign(state.context.show(on[0]))
        return [below, above]
    rest = state.branch()
    rest.choices = [one for one in rest.choices if one is not on]
    return [rest.branch(alternative) for alternative in on]


def use_of(on: Choice | Fact) -> object:
    """What tells a fact or disjunction from others."""
    return key_of(on) if isinstance(on, tuple) else id(on)


def uses_of(state: SearchState) -> frozenset[object]:
    """All that a contradiction may use in a state."""
    return frozenset((None, *map(use_of, state.facts), *map(use_of, state.choices)))


def leaf(facts: Sequence[Fact], found: Farkas) -> ContradictoryFacts:
    """A contradiction by the facts themselves, for their numbers."""
    products: list[tuple[FactKey | None, Fraction]] = [(None, Fraction(found.one))]
    cofactors: list[tuple[FactKey, Fraction]] = []
    for k, multiple in sorted(found.multiples.items()):
        poly, relation = facts[k]
        if relation == "=":
            cofactors.append((key_of(facts[k]), Fraction(multiple * poly.den)))
        else:
            products.append((key_of(facts[k]), Fraction(multiple * poly.den)))
    return ContradictoryFacts([pair for pair in products if pair[1]], cofactors)


def node_of(state: SearchState, tree: Tree) -> Node:
    """The node by which the checker closes the state."""
    place = {use_of(fact): k for k, fact in reversed(list(enumerate(state.facts)))}
    if isinstance(tree, ContradictoryFacts):
        return (
            "psatz",
            [(str(c), ((place[key], 1),) if key else (), "1") for key, c in tree.products],
            [(place[key], str(c)) for key, c in tree.cofactors],
        )
    cases = cases_of(state, tree.on)
    nodes = [node_of(case, part) for case, part in zip(cases, tree.parts)]
    if isinstance(tree.on, tuple):
        poly, _ = tree.on
        text = state.context.show(poly)
        square = ("1", ((place[use_of(tree.on)], 2),), "1")
        zero: Node = ("psatz", [square], [(len(state.facts), state.context.show(-poly))])
        return "sign", text, nodes[0], zero, nodes[1]
    return "cases", next(k for k, one in enumerate(state.choices) if one is tree.on), nodes


# -------------------------------------------------------------------------------------------------
# Statements.


def linear(statement: checker.Statement) -> checker.Unfolding | None:
    """The unfolding of a statement for all reals whose lines are linear; None for any other."""
    if statement.get("exists") or statement.get("integer") or statement.get("root"):
        return None
    unfolding = unfolded(statement)
    formulas = (*unfolding.premises, unfolding.goal(False))
    return None if unfolding.obligations or not all(map(is_linear, formulas)) else unfolding


def search_linear(
    statement: checker.Statement, budget: Budget, find_basis: FindBasis = no_basis
) -> Certificate | None:
    """The certificate of a statement for all reals whose lines are linear; None for any other, and
    where the budget ends.

    >>> text = "statement a/b\\nforall x y\\nshow not (x > y and y > x + 1)"
    >>> found = search_linear(checker.read_statements(text)["a/b"], Budget(10**5))
    >>> found["certified"][2]
    ('psatz', [('1', (), '1'), ('1', ((0, 1),), '1'), ('1', ((1, 1),), '1')], [])
    """
    unfolding = linear(statement)
    if unfolding is None:
        return None
    names = {name: unfolding.context.index[name] for name in unfolding.universal}

    def terms(found: Vertex) -> dict[str, str]:
        return {name: str(found.values.get(k, 0)) for name, k in names.items()}

    inside = state_of(unfolding)
    state = inside.branch(unfolding.goal(False))
    try:
        found = ContradictoryFacts([], []) if state.closed else decide(state, budget, find_basis)
        if isinstance(found, Vertex):
            close: Node = ("close",)
            return {"refuted": Counterexample(statement.name, [], terms(found), close, close)}
        point = decide(inside, budget, find_basis) if not inside.closed else None
    except Exhausted:
        return None
    if found is None or not isinstance(point, Vertex):
        return None
    node: Node = ("close",) if state.closed else node_of(state, found)
    return {
        "certified": ("proof", [], node),
        "point": Point(statement.name, [], terms(point), ("close",)),
    }
