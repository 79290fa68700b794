"""Closing a state: leaves by positive combinations, disjunctions by cases, integers by rounding, signs told apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from flint import fmpz_mpoly

from certificates import checker

from .budget import Budget, Exhausted, accepted
from .interior import has_interior_point
from .polynomials import Ring, total_degree
from .positivstellensatz import DEEP, FIRST, QUICK, SQUARES, USUAL, Stage, close_by_equations, search
from .problem import Problem, Signs
from .squares import Pool

Node = list[Any]
DEPTH = 3  # of signs told apart below one another
CANDIDATES = 6


@dataclass(frozen=True)
class Hints:
    """What a claim may tell the search: earlier statements to use, each with terms for its variables."""

    uses: tuple[tuple[str, tuple[tuple[str, str], ...]], ...] = ()


def search_closing(state: checker.State, known: dict[str, checker.Statement], budget: Budget, effort: int = 2,
                   hints: Hints | None = None, confirm: bool = True) -> Node | None:
    """A node by which the checker closes the state, or None where none was found; `confirm=False` leaves the confirmation to the caller.

    >>> context = checker.Context()
    >>> context.declare("x")
    >>> formula = context.formula(checker.parse("x > 1 and x^2 <= x"))
    >>> search_closing(checker.State(context).assume(formula), {}, Budget(10**6))
    ['psatz', [['1', [[0, 1]], '1'], ['1', [[1, 1]], '1'], ['1', [[0, 2]], '1']], []]
    """
    node = Closing(known, budget, effort).close(state)
    return node if node is None or not confirm or accepted(checker.close, state, node, known) else None


class Closing:
    """One search with its budget; rings are made once for each list of variables."""

    def __init__(self, known: dict[str, checker.Statement], budget: Budget, effort: int) -> None:
        self.known, self.budget, self.effort = known, budget, effort
        self.rings: dict[tuple[str, ...], Ring] = {}

    def problem(self, state: checker.State) -> Problem:
        """The facts of a state, ready for a search."""
        self.budget.spend(300)
        names = tuple(state.context.index)
        if names not in self.rings:
            self.rings[names] = Ring(names)
        return Problem(state, self.rings[names])

    # -------------------------------------------------------- disjunctions

    def close(self, state: checker.State) -> Node | None:
        """The node for this state: at once, by its facts, or by the cases of a disjunction."""
        if state.closed:
            return ["close"]
        if not state.choices:
            return self.leaf(state, DEPTH if self.effort < 2 else 0)
        node = self.attempt(state, QUICK)
        return node if node is not None else self.cases(state)

    def cases(self, state: checker.State) -> Node | None:
        """Splits the last disjunction with the fewest alternatives."""
        sizes = [len(alternatives) for alternatives in state.choices]
        index = min(range(len(sizes)), key=lambda k: (sizes[k], -k))
        rest = state.branch()
        del rest.choices[index]
        nodes = []
        for alternative in state.choices[index]:
            node = self.close(rest.branch(alternative))
            if node is None:
                return None
            nodes.append(node)
        return ["cases", index, nodes]

    # -------------------------------------------------------- facts alone

    def attempt(self, state: checker.State, stages: Sequence[Stage]) -> Node | None:
        """Closes a state by its facts alone, strict integer facts rounded first."""
        if state.closed:
            return ["close"]
        rounded, inside = self.rounded(state)
        problem = self.problem(inside)
        return wrapped(rounded, close_by_equations(problem) or search(problem, stages, self.budget))

    def rounded(self, state: checker.State) -> tuple[list[int], checker.State]:
        """The strict integer facts p > 0 of a state, and the state in which p - 1 >= 0 as well."""
        numbers: list[int] = []
        if state.context.integers:
            ring_names = list(state.context.index)
            integers = {k for k, name in enumerate(ring_names) if name in state.context.integers}
            for index, (poly, relation) in enumerate(list(state.facts)):
                used = {k for k in range(len(ring_names)) if any((m >> (checker.BITS * k)) % (1 << checker.BITS) for m in poly.terms)}
                if relation == ">" and poly.den == 1 and used <= integers:
                    less = checker.fold(poly - checker.ONE, ">=")
                    if isinstance(less, bool) or not any(r == ">=" and q.terms == less[1].terms for q, r in state.facts):
                        numbers.append(index)
                        state = state.branch(less)
        return numbers, state

    def leaf(self, state: checker.State, depth: int) -> Node | None:
        """A state without disjunctions: positive combinations, then signs told apart, then larger combinations."""
        if state.closed:
            return ["close"]
        rounded, inside = self.rounded(state)
        problem = self.problem(inside)
        return wrapped(rounded, self.combinations(inside, problem, depth))

    def combinations(self, state: checker.State, problem: Problem, depth: int) -> Node | None:
        """What `leaf` does once integers are rounded."""
        node = close_by_equations(problem) or search(problem, FIRST if self.effort else QUICK, self.budget)
        if node is not None or self.effort == 0 or not state.context.integers and has_interior_point(problem, self.budget):
            return node
        node = search(problem, USUAL, self.budget)
        if node is None and problem.divide():
            node = search(problem, (*FIRST, *USUAL), self.budget)
        sure = candidates(state, problem, 2) if node is None else []
        simple = [poly for poly in sure if total_degree(poly) == 1]
        if node is None and (depth < DEPTH or state.context.integers and depth <= DEPTH):
            node = self.cut(state, simple, problem, depth, 2)
        node = node or search(problem, SQUARES, self.budget)
        if node is None and depth < DEPTH:
            node = self.cut(state, [poly for poly in sure if poly not in simple], problem, depth, 2)
        if node is None and self.effort > 1:
            node = self.cut(state, candidates(state, problem, 1), problem, depth, 1) if depth < DEPTH - 1 else None
            if node is None and depth == 0:
                node = search(problem, DEEP, self.budget)
        return node

    def cut(self, state: checker.State, polys: list[fmpz_mpoly], problem: Problem, depth: int, closed: int) -> Node | None:
        """Tells the sign of a candidate apart, where at least `closed` of the three cases close quickly."""
        for poly in polys:
            text = problem.in_units(poly)
            cases = state.by_sign(text)
            nodes = [self.attempt(case, FIRST) for case in cases]
            if sum(node is not None for node in nodes) < closed:
                continue
            for k, case in enumerate(cases):
                nodes[k] = nodes[k] or self.leaf(case, depth + 1)
                if nodes[k] is None:
                    break
            else:
                return ["sign", text, *nodes]
            if closed == 2:
                return None  # the case that is left says the same as this state and more
        return None


def candidates(state: checker.State, problem: Problem, closed: int) -> list[fmpz_mpoly]:
    """Polynomials whose sign is worth telling apart: integers and their differences, factors of facts, factors of resultants."""
    pool = Pool()
    integers = [gen for gen, name in zip(problem.ring.gens, state.context.index) if name in state.context.integers]
    if closed == 2:
        for poly in [*integers, *(a - b for a, b in combinations(integers, 2))]:
            pool.add(poly)
    for poly in problem.unsigned_factors()[:CANDIDATES]:
        pool.add(poly)
    for poly in (problem.variables_and_differences() if closed == 2 else problem.candidates("resultants"))[:2 * CANDIDATES]:
        pool.add(poly)
    signs, equations = Signs(problem), [equation.poly for equation in problem.reduction.left]
    found = []
    for poly in pool.polys:
        rest = Pool()
        rest.add(problem.reduction.reduce(poly)[1])
        if rest.polys and (not signs.of(rest.polys[0])[0] or any(not divmod(equation, rest.polys[0])[1] for equation in equations)):
            found.append(poly)
    return found


def wrapped(rounded: list[int], node: Node | None) -> Node | None:
    """The node below the nodes that round integer facts."""
    for index in reversed(rounded):
        node = None if node is None else ["integral", index, node]
    return node


__all__ = ["Closing", "Exhausted", "Hints", "search_closing"]
