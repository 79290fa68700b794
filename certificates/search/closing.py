"""Closing a state: leaves by positive combinations, disjunctions by cases, integers by rounding,
signs told apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from certificates import checker

from .budget import Budget, Exhausted, accepted
from .interior import has_interior_point
from .polynomials import Ring
from .positivstellensatz import (
    DEEP,
    FIRST,
    QUICK,
    SQUARES,
    TRIPLES,
    USUAL,
    Stage,
    close_by_equations,
    search,
)
from .problem import Problem
from .squares import Pool
from .sums_of_squares import search_squares

Node = list[Any]
DEPTH = 2  # of signs told apart below one another
CANDIDATES = 6
BRANCHES = 3  # candidates that are followed further at the first level; one less at the next
SQUARED = 3  # the effort at which leaves are closed by sums of squares, and no sign is told apart
MOST_FOR_BOTH = 9  # facts
BOTH: tuple[Stage, ...] = (*FIRST, (2, 2, ""))


@dataclass(frozen=True)
class Hints:
    """What a claim may tell the search: earlier statements to use, each with terms for its
    variables."""

    uses: tuple[tuple[str, Mapping[str, str]], ...] = ()


def search_closing(
    state: checker.State,
    known: dict[str, checker.Statement],
    budget: Budget,
    effort: int = 2,
    hints: Hints | None = None,
    confirm: bool = True,
) -> Node | None:
    """A node by which the checker closes the state, or None where none was found; `confirm=False`
    leaves the confirmation to the caller.

    >>> context = checker.Context()
    >>> context.declare("x")
    >>> formula = context.formula(checker.parse("x > 1 and x^2 <= x"))
    >>> search_closing(checker.State(context).assume(formula), {}, Budget(10**6))
    ['psatz', [['1', [[0, 1]], '1'], ['1', [[1, 1]], '1'], ['1', [[0, 2]], '1']], []]
    """
    uses, inside = with_uses(state, known, hints.uses if hints else ())
    node = Closing(known, budget, effort).close(inside)
    for name, terms in reversed(uses):
        node = None if node is None else ["use", name, terms, {}, node]
    return (
        node if node is None or not confirm or accepted(checker.close, state, node, known) else None
    )


def with_uses(
    state: checker.State,
    known: dict[str, checker.Statement],
    wanted: Sequence[tuple[str, Mapping[str, str]]],
) -> tuple[list[tuple[str, dict[str, str]]], checker.State]:
    """The instances of earlier statements that a hint names, as far as they are known and exist,
    and the state that assumes them."""
    uses = []
    for name, terms in wanted:
        if name not in known or known[name].get("exists"):
            continue
        values = {
            variable: state.context.value(checker.parse(text)) for variable, text in terms.items()
        }
        story = checker.Unfolding(known[name], checker.Context(state.context, values))
        state = state.branch(
            checker.join(
                "or", [checker.negate(checker.join("and", story.premises)), story.goal(True)]
            ),
            story.context,
        )
        uses.append((name, dict(terms)))
    return uses, state


class Closing:
    """One search with its budget; rings are made once for each list of variables."""

    def __init__(self, known: dict[str, checker.Statement], budget: Budget, effort: int) -> None:
        self.known, self.budget, self.effort = known, budget, effort
        self.rings: dict[tuple[str, ...], Ring] = {}

    def problem(self, state: checker.State, whole: bool = False) -> Problem:
        """The facts of a state, ready for a search."""
        self.budget.spend(300)
        names = tuple(state.context.index)
        if names not in self.rings:
            self.rings[names] = Ring(names)
        return Problem(state, self.rings[names], whole)

    # -------------------------------------------------------- disjunctions

    def close(self, state: checker.State) -> Node | None:
        """The node for this state: at once, by its facts, or by the cases of a disjunction."""
        if state.closed:
            return ["close"]
        if not state.choices:
            return self.leaf(state, 0)
        node = self.attempt(state, QUICK)
        return node if node is not None else self.cases(state)

    def cases(self, state: checker.State) -> Node | None:
        """Splits the last disjunction with the fewest alternatives that no fact contradicts at
        sight."""
        known = {mark(poly, relation) for poly, relation in state.facts}
        sizes = [
            sum(not contradicted(one, known) for one in alternatives)
            for alternatives in state.choices
        ]
        index = min(range(len(sizes)), key=lambda k: (sizes[k], len(state.choices[k]), -k))
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
                used = {
                    k
                    for k in range(len(ring_names))
                    if any((m >> (checker.BITS * k)) % (1 << checker.BITS) for m in poly.terms)
                }
                if relation == ">" and poly.den == 1 and used <= integers:
                    less = checker.fold(poly - state.context.number(1), ">=")
                    if isinstance(less, bool) or not any(
                        r == ">=" and q.terms == less[1].terms for q, r in state.facts
                    ):
                        numbers.append(index)
                        state = state.branch(less)
        return numbers, state

    def leaf(self, state: checker.State, depth: int) -> Node | None:
        """A state without disjunctions: positive combinations, then signs told apart, then larger
        combinations."""
        if state.closed:
            return ["close"]
        rounded, inside = self.rounded(state)
        problem = self.problem(inside)
        node = close_by_equations(problem) or search(
            problem, FIRST if self.effort else QUICK, self.budget
        )
        if node is None and self.effort == SQUARED:
            node = search_squares(self.problem(inside, True), self.budget)
        elif (
            node is None
            and self.effort
            and (state.context.integers or not has_interior_point(problem, self.budget))
        ):
            node = self.usual(problem, False) or self.with_lemmas(inside, problem, depth)
        return wrapped(rounded, node)

    def usual(self, problem: Problem, again: bool) -> Node | None:
        """Products of two facts, and single facts times squares; then the same with facts divided
        by their positive factors."""
        node = search(problem, (*FIRST, *USUAL) if again else USUAL, self.budget)
        if node is None and problem.divide():
            node = search(problem, (*FIRST, *USUAL), self.budget)
        return node

    def with_lemmas(self, state: checker.State, problem: Problem, depth: int) -> Node | None:
        """Signs that can be shown are added to the facts; where that is not enough, signs are told
        apart."""
        lemmas: list[Lemma] = []
        for kind in ("integers", "factors", "", "variables")[: 3 + (self.effort > 1)]:
            before = len(lemmas)
            stages = BOTH if kind == "variables" and len(problem.facts) <= MOST_FOR_BOTH else FIRST
            if not kind:
                node = search(problem, SQUARES, self.budget)
                if node is not None:
                    return under(lemmas, node)
                continue
            for _ in range(2):
                count = len(lemmas)
                for text in candidates(state, problem, kind):
                    lemma, state = self.lemma(state, text, stages)
                    lemmas += [lemma] if lemma else []
                    if lemma is not None and lemma.node is not None:
                        return under(lemmas, lemma.node)
                if len(lemmas) == count:
                    break
                problem = self.problem(state)
            if len(lemmas) > before:
                node = close_by_equations(problem) or self.usual(problem, True)
                if node is not None:
                    return under(lemmas, node)
        node = search(problem, TRIPLES, self.budget) if self.effort > 1 and depth < DEPTH else None
        if node is None and self.effort > 1 and depth < DEPTH:
            node = self.split(state, problem, depth)
        if node is None and self.effort > 1 and depth == 0:
            node = search(problem, DEEP, self.budget)
        return under(lemmas, node)

    def lemma(
        self, state: checker.State, text: str, stages: Sequence[Stage]
    ) -> tuple[Lemma | None, checker.State]:
        """The sign of a polynomial where two of the three cases close quickly, and the state with
        it."""
        cases = state.by_sign(text)
        nodes = [self.attempt(case, stages) for case in cases]
        open_cases = [k for k, node in enumerate(nodes) if node is None]
        if len(open_cases) > 1:
            return None, state
        place = open_cases[0] if open_cases else 2
        rounded, inside = self.rounded(cases[place])
        return Lemma(text, nodes, place, rounded, nodes[place]), inside

    def split(self, state: checker.State, problem: Problem, depth: int) -> Node | None:
        """Tells the sign of a candidate apart: the one of whose cases most close quickly comes
        first."""
        known = [
            text
            for fact in problem.facts
            for text in (problem.in_units(fact.poly), problem.in_units(-fact.poly))
        ]
        tried: list[tuple[int, str, list[Node | None]]] = []
        for kind in ("factors", "variables", "resultants"):
            for text in candidates(state, problem, kind):
                if text in known:
                    continue
                nodes = [self.attempt(case, BOTH) for case in state.by_sign(text)]
                count = sum(node is not None for node in nodes)
                if count == 3:
                    return ["sign", text, *nodes]
                tried += [(count, text, nodes)] if count else []
        tried.sort(key=lambda one: -one[0])
        for _, text, nodes in tried[: BRANCHES - depth]:
            cases = state.by_sign(text)
            for k in (1, 0, 2):
                nodes[k] = nodes[k] or self.leaf(cases[k], depth + 1)
                if nodes[k] is None:
                    break
            else:
                return ["sign", text, *nodes]
        return None


@dataclass
class Lemma:
    """A sign told apart where one case is left, in which integers are rounded; `node` closes that
    case too where it is known."""

    text: str
    nodes: list[Node | None]
    place: int
    rounded: list[int]
    node: Node | None


def under(lemmas: list[Lemma], node: Node | None) -> Node | None:
    """The node below the nodes of lemmas."""
    for lemma in reversed(lemmas if node is not None else []):
        own = lemma.node if lemma.node is not None else wrapped(lemma.rounded, node)
        node = [
            "sign",
            lemma.text,
            *(own if k == lemma.place else case for k, case in enumerate(lemma.nodes)),
        ]
    return node


def candidates(state: checker.State, problem: Problem, kind: str) -> list[str]:
    """Polynomials whose sign is worth telling apart: integers and their differences, factors of
    facts, variables, factors of resultants."""
    pool = Pool()
    if kind == "integers":
        integers = [
            gen
            for gen, name in zip(problem.ring.gens, state.context.index)
            if name in state.context.integers
        ]
        found = [*integers, *(a - b for a, b in combinations(integers, 2))]
    elif kind == "factors":
        found = problem.unsigned_factors()[:CANDIDATES]
    elif kind == "variables":
        found = problem.variables_and_differences()[: 2 * CANDIDATES]
    else:
        found = problem.candidates("resultants", 3 * CANDIDATES)
    signs, equations = problem.signs(), [equation.poly for equation in problem.reduction.left]
    texts = []
    for poly in found:
        before = len(pool.polys)
        pool.add(problem.reduction.reduce(poly)[1])
        for rest in pool.polys[before:]:
            if not signs.of(rest)[0] or any(
                not divmod(equation, rest)[1] for equation in equations
            ):
                texts.append(problem.in_units(poly))
    return texts[: 2 * CANDIDATES]


def mark(poly: checker.Poly, relation: str) -> tuple[frozenset[tuple[int, int]], str]:
    """A fact up to a positive factor."""
    content, key = poly.primitive()
    return (
        frozenset((key if content > 0 or relation in ("=", "!=") else -key).terms.items()),
        relation,
    )


CONTRARY = {
    ">": ((-1, ">"), (-1, ">="), (1, "=")),
    ">=": ((-1, ">"),),
    "=": ((1, ">"), (-1, ">"), (1, "!=")),
    "!=": ((1, "="),),
}


def contradicted(formula: Any, known: set[tuple[frozenset[tuple[int, int]], str]]) -> bool:
    """Whether a fact among the known ones is the negation of the formula, or of a part of a
    conjunction."""
    if formula[0] == "and":
        return any(contradicted(part, known) for part in formula[1])
    return formula[0] == "atom" and any(
        mark(formula[1] if sign > 0 else -formula[1], relation) in known
        for sign, relation in CONTRARY[formula[2]]
    )


def wrapped(rounded: list[int], node: Node | None) -> Node | None:
    """The node below the nodes that round integer facts."""
    for index in reversed(rounded):
        node = None if node is None else ["integral", index, node]
    return node


__all__ = ["Closing", "Exhausted", "Hints", "search_closing"]
