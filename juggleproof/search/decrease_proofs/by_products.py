"""A proof that a function falls by a linear program: few facts, each times many products of what is
positive, in the parameters above all.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import prod
from typing import NamedTuple

from flint import fmpz_mpoly

from juggleproof.algebra.polynomials import (
    Packing,
    Ring,
    total_degree,
)
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.closing import search_closing, sign_node
from juggleproof.search.psatz.lifting import lift, powers_of
from juggleproof.search.psatz.linear import Products
from juggleproof.search.psatz.linear_program import Program, solve
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node, Proof
from juggleproof.statements.states import SearchState, proves, state_of
from juggleproof.statements.work import Budget, Exhausted, unfolded

MOVING = ("value", "level", "distance")


def proof_by_products(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    terms: Collection[int],
    unknowns: Collection[str],
    squares: Sequence[str],
    signs: Sequence[str],
    most: int = limits.PRODUCT_COLUMNS,
) -> Proof | None:
    """A proof of a premise `falls` or `least` from these terms of V, by their numbers, and from
    what is known of the parameters but the unknowns; products times these squares are used too,
    then cases of these signs.
    """
    budget = Budget(limits.DECREASE_WORK)

    def closed(state: SearchState) -> Node | None:
        ring = Ring(tuple(state.context.index))
        kept, goal = facts_kept(state, ring, terms, unknowns), len(state.facts) - 1
        return by_cases(state, goal, kept, ring, squares, unknowns, signs, budget, most)

    return proof_with(premise, known, budget, closed)


def proof_with(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    budget: Budget,
    closed: Callable[[SearchState], Node | None],
) -> Proof | None:
    """The proof with the node that closes the premise's facts and the negation of its conclusion;
    None where there is no such node, an obligation stays open, or the budget ends.
    """
    unfolding = unfolded(premise)
    try:
        steps = obligations_closed(unfolding, known, budget)
        if steps is None:
            return None
        node = closed(state_of(unfolding).assume(unfolding.goal(False)))
    except Exhausted:
        return None
    proof: Proof | None = None if node is None else ("proof", steps, node)
    return proof if proof is not None and proves(premise, proof, known) else None


def by_cases(
    state: SearchState,
    goal: int,
    kept: Sequence[int],
    ring: Ring,
    squares: Sequence[str],
    unknowns: Collection[str],
    signs: Sequence[str],
    budget: Budget,
    most: int,
) -> Node | None:
    """A node that contradicts the facts with these numbers, by the cases of disjunctions, if need
    be by cases of signs; goal: the number of the first fact that is of this premise alone.
    """
    nodes: list[Node | None] = []
    if state.closed:
        return ("close",)
    if state.choices:
        rest = state.branch()
        every: list[Node] = []
        for one in rest.choices.pop(0):
            case = rest.branch(one)
            more = [*kept, *range(len(rest.facts), len(case.facts))]
            node = by_cases(case, goal, more, ring, squares, unknowns, signs, budget, most)
            if node is None:
                return None
            every.append(node)
        return "cases", 0, every
    node = leaf(state, goal, kept, ring, squares, unknowns, budget, most)
    if node is not None or not signs:
        return node
    for case in state.by_sign(signs[0]):
        more = [*kept, len(state.facts)]
        node = by_cases(case, goal, more, ring, squares, unknowns, signs[1:], budget, most)
        nodes.append(node)
        if nodes[-1] is None:
            return None
    return sign_node(signs[0], nodes)


def facts_kept(
    state: SearchState, ring: Ring, terms: Collection[int], unknowns: Collection[str]
) -> list[int]:
    """The numbers of the facts that are used: the equations that are linear in the unknowns, but
    for those that only define one; the last fact, which is the negated goal, these terms of V,
    value >= 0, and what is linear in the state or in the parameters alone.
    """
    kept, count = [], 0
    unknown = [v for v, name in enumerate(ring.names) if name in unknowns]
    read = [ring.read(poly) for poly, _ in state.facts]
    every = [{ring.names[v] for v, power in enumerate(p.degrees()) if power} for p in read]
    tied = Counter(name for used in every if len(used) > 1 for name in used)
    defined = {name for name in unknowns if tied[name] == 1}  # an equation that tells nothing else
    for k, ((_, relation), lowered, used) in enumerate(zip(state.facts, read, every)):
        gaps = any(name.endswith("_gap") for name in used)
        alone = used <= set(MOVING)
        if "value" in used and gaps:
            count += 1
        if (
            k == len(state.facts) - 1
            or (
                relation == "="
                and not any(map(is_moving, used))
                and not used & defined
                and is_linear(lowered, unknown)
            )
            or ("value" in used and gaps and count - 1 in terms)
            or (alone and (len(lowered) == 1 or any(c < 0 for c in lowered.coeffs())))
            or ("value" not in used and gaps and is_bound(lowered, ring))
            or (
                not any(map(is_moving, used))
                and not used & set(unknowns)
                and any(c < 0 for c in lowered.coeffs())
            )
            or (len(used) == 1 and len(lowered) == 1 and not used & set(unknowns))
        ):
            kept.append(k)
    return kept


def obligations_closed(
    unfolding: checker.Unfolding, known: dict[str, checker.Statement], budget: Budget
) -> list[Node] | None:
    """Nodes for what a premise needs to be read, as that a root exists; None where one is open."""
    steps = []
    for count, negation in unfolding.obligations:
        state = state_of(unfolding, count).assume(negation)
        step = search_closing(state, known, budget, effort=1, confirm=False)
        if step is None:
            return None
        steps.append(step)
    return steps


def with_facts(state: SearchState, kept: Sequence[int]) -> SearchState:
    """The state with these facts only."""
    few = SearchState(state.context)
    few.facts = [state.facts[k] for k in kept]
    return few


def is_end(problem: LeafProblem, number: int, ring: Ring) -> bool:
    """Whether a fact bounds one variable of the state by terms in the parameters; such a fact is
    multiplied by V alone.
    """
    lowered = problem.source.lowered[problem.facts[number].factors[0][0]]
    return total_degree(lowered) > 1 and is_bound(lowered, ring)


def is_bound(poly: fmpz_mpoly, ring: Ring) -> bool:
    """Whether it is linear in all, or bounds one variable of the state by the parameters."""
    powers = poly.degrees()
    moving = [v for v, power in enumerate(powers) if power and is_moving(ring.names[v])]
    return total_degree(poly) == 1 or len(moving) == 1 and powers[moving[0]] == 1


def is_linear(poly: fmpz_mpoly, variables: Collection[int]) -> bool:
    """Whether no power of these variables is above 1."""
    return all(poly.degrees()[v] <= 1 for v in variables)


def is_moving(name: str) -> bool:
    """Whether it is no parameter and no part of the point."""
    return name in MOVING or name.endswith("_gap")


def leaf(
    state: SearchState,
    goal: int,
    kept: Sequence[int],
    ring: Ring,
    squares: Sequence[str],
    unknowns: Collection[str],
    budget: Budget,
    most: int,
) -> Node | None:
    """A node that contradicts the facts with these numbers."""
    problem = LeafProblem(with_facts(state, kept), ring, True)
    roots = [problem.source.scaling.lower(ring.read(state.context.polynomial(s))) for s in squares]
    roots = [problem.reduction.reduce(root)[1] for root in roots]
    if problem.contradiction is not None:
        return None
    moving = {v for v, name in enumerate(ring.names) if is_moving(name)}
    unknown = {v for v, name in enumerate(ring.names) if name in unknowns}
    generators, positive = [], []
    for k, fact in enumerate(problem.facts):
        number = fact.factors[0][0]
        first, now = problem.source.lowered[number].degrees(), fact.poly.degrees()
        if now[ring.names.index("value")] or kept[number] >= goal:
            generators.append(k)
        if not now[ring.names.index("value")] and (
            any(now[v] for v in moving) or not any(first[v] for v in unknown)
        ):
            positive.append(k)
    ends = [k for k in positive if is_end(problem, k, ring)]
    positive = independent(problem, [k for k in positive if k not in ends])
    packing = Packing(ring, [*problem.polys(), *roots])
    first = [k for k in generators if kept[problem.facts[k].factors[0][0]] == goal]
    common = [
        k
        for one in first
        for poly, power in ring.factors(problem.facts[one].poly)
        for k in positive
        for _ in range(power)
        if problem.facts[k].poly in (poly, -poly)
    ]
    level = ring.names.index("level") if "level" in ring.names else None
    if level is not None and not any(problem.facts[k].poly.degrees()[level] for k in first):
        generators = [k for k in generators if not problem.facts[k].poly.degrees()[level]]
    polys: list[tuple[fmpz_mpoly, tuple[int, ...], int]]
    polys = [(problem.facts[k].poly, (k,), -1) for k in generators]
    values = [ring.gens[ring.names.index("value")]] if "value" in ring.names else []
    polys += [
        (one * problem.facts[k].poly, (*own, k), -1)
        for one, own, _ in list(polys)
        if one in values
        for k in ends
    ]
    polys += [(root**2, (), k) for k, root in enumerate(roots)]
    shared = prod((problem.facts[k].poly for k in common), start=ring.one)
    used = [poly // shared if own and own[0] in first else poly for poly, own, _ in polys]
    inside = {v for poly in used for v, power in enumerate(poly.degrees()) if power}
    positive = [
        k
        for k in positive
        if all(v in inside for v, power in enumerate(problem.facts[k].poly.degrees()) if power)
    ]
    parts = [Products(problem, positive, packing)]
    polys = [
        (poly, own, root) if own and own[0] in first else (poly * shared, (*own, *common), root)
        for poly, own, root in polys
    ]
    multiplied = [Multiplied(*one) for one in polys]
    top = max(total_degree(one.poly) for one in multiplied if one.root < 0)
    node = Combinations(problem, parts, packing, most).node(
        multiplied, top, limits.PRODUCT_DEGREES, roots, budget
    )
    return renumbered(node, kept)


class Multiplied(NamedTuple):
    """What stands in an identity times products of facts: itself a product of facts, or the square
    of a root.
    """

    poly: fmpz_mpoly
    own: tuple[int, ...]  # numbers of the facts
    root: int  # number of the root, or -1
    alone: bool = False  # times 1 only


@dataclass(frozen=True)
class Combinations:
    """Combinations of products of facts, `parts`, of one factor more in each."""

    problem: LeafProblem
    parts: list[Products]
    packing: Packing
    most: int  # products
    most_terms: int = limits.PRODUCT_TERMS

    def node(
        self,
        multiplied: Sequence[Multiplied],
        top: int,
        mores: Sequence[int],
        roots: list[fmpz_mpoly],
        budget: Budget,
    ) -> Node | None:
        """A node that combines them to a contradiction, of degrees that are above `top` by one of
        the numbers, the least first.
        """
        for more in mores:
            program = Program()
            columns: list[tuple[tuple[int, ...], int]] = []
            for poly, own, root, alone in multiplied:
                row = self.packing.row(poly)
                for count in range(1 if alone else top + more - total_degree(poly) + 1):
                    if not self.has(count):
                        return None
                    part = self.parts[count]
                    block = part.times_row(row)
                    strict = root < 0 and all(self.problem.facts[k].strict for k in own)
                    costs = 1.0 + block.widths / 4
                    program.add(block.at, block.keys, block.values, block.strict & strict, costs)
                    columns += [(tuple(one) + own, root) for one in part.chosen.tolist()]
            if len(columns) > self.most:
                return None
            budget.spend(3 * program.count)
            iterations = min(
                limits.MOST_ITERATIONS, limits.PRODUCT_ITERATED // max(1, program.count)
            )
            found = solve(program, budget, iterations)
            if found is not None:
                used = [((powers_of(columns[k][0]), columns[k][1]), c) for k, c in found[0].items()]
                return lift(self.problem, used, [], roots)
        return None

    def has(self, count: int) -> bool:
        """Whether there are products of this number of facts, and not too many."""
        while len(self.parts) <= count:
            products, terms = self.parts[-1].sizes_with_facts()
            if products > self.most or terms > self.most_terms:
                return False
            self.parts.append(self.parts[-1].times_facts())
        return True


def independent(problem: LeafProblem, positive: Sequence[int]) -> list[int]:
    """Those of the facts that are no sum of two others, or of another and of products of positive
    variables.
    """
    polys = {k: problem.facts[k].poly for k in positive}
    single = {
        poly.degrees().index(1)
        for poly in polys.values()
        if len(poly) == 1 and total_degree(poly) == 1 and poly.leading_coefficient() > 0
    }

    def is_sum(poly: fmpz_mpoly) -> bool:
        return all(
            c > 0 and all(v in single for v, e in enumerate(monomial) if e)
            for monomial, c in zip(poly.monoms(), poly.coeffs())
        )

    every = set(map(str, polys.values()))
    for k, poly in list(polys.items()):
        parts = problem.ring.factors(poly)
        if len(parts) > 1 and all(str(p) in every or str(-p) in every for p, _ in parts):
            del polys[k]
    for k, poly in list(polys.items()):
        others = [one for other, one in polys.items() if other != k]
        if len(poly) > 1 and any(poly == a + b for a, b in combinations(others, 2)):
            del polys[k]
    return [
        k
        for k, poly in polys.items()
        if len(poly) == 1
        or not is_sum(poly)
        and not any(
            is_sum(
                poly * abs(int(other.leading_coefficient()))
                - other * abs(int(poly.leading_coefficient()))
            )
            for other in polys.values()
            if other is not poly
        )
    ]


def renumbered(node: Node | None, kept: Sequence[int]) -> Node | None:
    """The node with the numbers that the facts have in the state; None where there is none, or it
    has cases.
    """
    if node is None or node[0] != "psatz":
        return None
    _, products, equations = node
    return (
        "psatz",
        [(c, tuple((kept[k], e) for k, e in factors), root) for c, factors, root in products],
        [(kept[k], cofactor) for k, cofactor in equations],
    )
