"""Closing a state: cases of disjunctions and of signs, integers rounded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import prod

from juggleproof.algebra.polynomials import Ring
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.boxes.over_box import close_over_box
from juggleproof.search.boxes.squares import close_by_bounds
from juggleproof.search.by_variables import close_by_variables
from juggleproof.search.hints.clauses import search_by_conflicts
from juggleproof.search.one_variable import close_in_one_variable
from juggleproof.search.psatz.by_monomials import search_by_monomials
from juggleproof.search.psatz.by_parameter import search_by_parameter
from juggleproof.search.psatz.candidates import Pool
from juggleproof.search.psatz.forms import search_forms
from juggleproof.search.psatz.linear import (
    FIRST,
    QUICK,
    SQUARES,
    TRIPLES,
    USUAL,
    Stage,
    close_by_equations,
    search,
)
from juggleproof.search.psatz.orthant import search_orthant
from juggleproof.search.psatz.problem import (
    LeafProblem,
    has_interior_point,
    high_facts,
)
from juggleproof.search.psatz.sums_of_squares import programs_of_facts, search_squares
from juggleproof.statements.nodes import Node, Sign
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted

# -------------------------------------------------------------------------------------------------
# Closing a state: leaves by positive combinations, disjunctions by cases, integers by rounding,
# cases by the sign of a polynomial.

SQUARED = 3  # the effort at which leaves are closed by sums of squares, without cases by sign
BOTH: tuple[Stage, ...] = (*FIRST, (2, 2, ""))
_no_forms: dict[tuple[object, ...], int] = {}  # facts without such a node -> the work that it takes


@dataclass(frozen=True)
class Hints:
    """A claim's help: earlier statements to use, each with terms for its variables."""

    uses: tuple[tuple[str, Mapping[str, str]], ...] = ()


def search_closing(
    state: SearchState,
    known: dict[str, checker.Statement],
    budget: Budget,
    effort: int = 2,
    hints: Hints | None = None,
    confirm: bool = True,
) -> Node | None:
    """A node by which the checker closes the state, or None where none was found; `confirm=False`
    leaves the confirmation to the caller.

    Raises Exhausted where the budget ends.

    >>> context = checker.Context()
    >>> context.declare("x")
    >>> formula = context.formula(checker.parse("x > 1 and x^2 <= x"))
    >>> search_closing(SearchState(context).assume(formula), {}, Budget(10**6))
    ('psatz', [('1', ((0, 1),), '1'), ('1', ((1, 1),), '1'), ('1', ((0, 2),), '1')], [])
    """
    uses, inside = with_uses(state, known, hints.uses if hints else ())
    node: Node | None = None
    if effort and len(inside.context.index) == 1:  # complete, but longer than what is close at hand
        quick = Closing(known, budget, 0)
        node = quick.close(inside) or quick.attempt(inside, FIRST)
        node = node or close_in_one_variable(inside, budget)
    node = node or Closing(known, budget, effort).close(inside)
    if node is None and has_high_facts(inside):
        node = Closing(known, budget, effort, True).close(inside)
    for name, terms in reversed(uses):
        node = None if node is None else ("use", name, terms, {}, node)
    return node if node is None or not confirm or state.is_closed_by(node, known) else None


def with_uses(
    state: SearchState,
    known: dict[str, checker.Statement],
    wanted: Sequence[tuple[str, Mapping[str, str]]],
) -> tuple[list[tuple[str, dict[str, str]]], SearchState]:
    """The instances of earlier statements that a hint names, as far as they are known and exist,
    and the state that assumes them.
    """
    uses = []
    for name, terms in wanted:
        if name not in known or known[name].get("exists"):
            continue
        values = {
            variable: state.context.value(checker.parse(text)) for variable, text in terms.items()
        }
        unfolding = checker.Unfolding(known[name], checker.Context(state.context, values))
        state = state.branch(
            checker.join(
                "or",
                [checker.negate(checker.join("and", unfolding.premises)), unfolding.goal(True)],
            ),
            unfolding.context,
        )
        uses.append((name, dict(terms)))
    return uses, state


def has_high_facts(state: SearchState) -> bool:
    """Whether some facts are left out at first for their degree."""
    ring = Ring(tuple(state.context.index))
    return bool(high_facts([ring.read(poly) for poly, _ in state.facts]))


class Closing:
    """One search with its budget; rings are made once for each list of variables."""

    def __init__(
        self,
        known: dict[str, checker.Statement],
        budget: Budget,
        effort: int,
        high: bool = False,
    ) -> None:
        self.known, self.budget, self.effort, self.high = known, budget, effort, high
        self.rings: dict[tuple[str, ...], Ring] = {}

    def problem(self, state: SearchState, whole: bool = False) -> LeafProblem:
        """The facts of a state, ready for a search."""
        self.count(300, [len(poly.terms) for poly, _ in state.facts])
        names = tuple(state.context.index)
        if names not in self.rings:
            self.rings[names] = Ring(names)
        problem = LeafProblem(state, self.rings[names], whole, high=self.high)
        self.count(0, [len(poly) for poly in problem.polys()])
        return problem

    def count(self, least: int, terms: Sequence[int]) -> None:
        """Spend the work of reading facts with this number of terms; large numbers cost more."""
        self.budget.spend(least + 2 * max(0, sum(terms) - limits.MANY_TERMS))

    # -------------------------------------------------------- disjunctions

    def close(self, state: SearchState) -> Node | None:
        """The node for this state: at once, by its facts, or by the cases of a disjunction."""
        if state.closed:
            return ("close",)
        known = {fact_key(*fact) for fact in state.facts} if state.choices else set()
        sizes = {
            index: sum(not contradicted(one, known) for one in alternatives)
            for index, alternatives in enumerate(state.choices)
            if not any(satisfied(one, known) for one in alternatives)
        }
        if not sizes:
            return self.leaf(state, 0)
        node = self.attempt(state, QUICK)
        if node is None and prod(sizes.values()) > limits.MANY_CASES and self.effort:
            return search_by_conflicts(state, lambda few: self.leaf(few, 0), self.budget)
        return node if node is not None else self.cases(state, sizes)

    def cases(self, state: SearchState, sizes: Mapping[int, int]) -> Node | None:
        """Splits the last of these disjunctions with the fewest alternatives that no fact
        contradicts at sight; sizes: how many, by the number of the disjunction.
        """
        index = min(sizes, key=lambda k: (sizes[k], len(state.choices[k]), -k))
        rest = state.branch()
        del rest.choices[index]
        nodes = []
        for alternative in state.choices[index]:
            node = self.close(rest.branch(alternative))
            if node is None:
                return None
            nodes.append(node)
        return "cases", index, nodes

    # -------------------------------------------------------- facts alone

    def attempt(self, state: SearchState, stages: Sequence[Stage]) -> Node | None:
        """Closes a state by its facts alone, strict integer facts rounded first."""
        if state.closed:
            return ("close",)
        rounded, inside = self.rounded(state)
        problem = self.problem(inside)
        return wrapped(rounded, close_by_equations(problem) or search(problem, stages, self.budget))

    def rounded(self, state: SearchState) -> tuple[list[int], SearchState]:
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
                    less = poly - state.context.number(1)
                    if not any(r == ">=" and q.terms == less.terms for q, r in state.facts):
                        numbers.append(index)
                        state = state.branch(checker.fold(less, ">="))
        return numbers, state

    def leaf(self, state: SearchState, depth: int) -> Node | None:
        """A state without disjunctions: positive combinations, then cases by sign, then larger
        combinations.
        """
        if state.closed:
            return ("close",)
        rounded, inside = self.rounded(state)
        problem = self.problem(inside)
        node = close_by_equations(problem)
        factors = two_factors(problem) if 1 < self.effort < SQUARED and node is None else []
        node = node or (self.by_factors(inside, factors, depth) if factors else None)
        node = node or search(problem, FIRST if self.effort else QUICK, self.budget)
        node = self.by_few(problem, node)
        if node is None and self.effort == SQUARED:
            programs = programs_of_facts(self.problem(inside, True), self.budget)
            node = close_by_variables(inside, problem.ring, self.budget)
            node = node or close_by_bounds(inside, limits.MANY_LETTERS, self.budget)
            node = node or search_squares(programs, self.budget)
        elif (
            node is None
            and self.effort
            and (state.context.integers or not has_interior_point(problem, self.budget))
        ):
            node = (
                close_over_box(inside, limits.FEW_LETTERS, self.budget)
                or self.usual(problem, False)
                or (None if depth else self.forms(inside))
                or (None if depth or self.effort == 1 else self.by_monomials(problem))
                or self.with_lemmas(inside, problem, depth)
                or (None if depth else close_over_box(inside, limits.MANY_LETTERS, self.budget))
            )
        return wrapped(rounded, node)

    def by_few(self, problem: LeafProblem, node: Node | None) -> Node | None:
        """The same, or in place of none or of a long one a node that a few facts make."""
        if node is not None and (node[0] != "psatz" or len(node[1]) <= limits.LONG_NODE):
            return node
        try:
            few = search_by_parameter(problem, self.budget.part(limits.FEW_FACTS_WORK))
        except Exhausted:
            return node
        return few if node is None or few and len(str(few)) < len(str(node)) else node

    def by_monomials(self, problem: LeafProblem) -> Node | None:
        """Products of bounds along the monomials of the goal, with little work."""
        try:
            return search_by_monomials(problem, self.budget.part(limits.FEW_FACTS_WORK))
        except Exhausted:
            return None

    def forms(self, state: SearchState) -> Node | None:
        """Quadratic forms with parameters in a box, with little work."""
        part = self.budget.part(limits.FORMS_WORK)
        facts = ((frozenset(p.terms.items()), p.den, relation) for p, relation in state.facts)
        key = (*state.context.index, *facts, part.left)
        problem = self.problem(state)
        if key in _no_forms:  # the same facts come back at greater effort
            self.budget.spend(_no_forms[key])
            return None
        before, node = part.left, None
        try:
            node = search_forms(state, problem.ring, part)
        except Exhausted:
            pass
        if node is None:
            if len(_no_forms) >= limits.MOST_PROGRAMS:
                _no_forms.clear()
            _no_forms[key] = before - part.left
        return node

    def by_factors(
        self, state: SearchState, factors: Sequence[str], depth: int, level: int = 0
    ) -> Node | None:
        """Cases by the signs of the two factors of an equation, as of that of sqrt(term^2): in each
        of them one is 0, and the same for the next equation.
        """
        if level > limits.MOST_SIGNS:
            return None
        first, *rest = factors
        nodes: list[Node | None] = []
        for place, case in enumerate(state.by_sign(first)):
            node: Node | None = ("close",) if case.closed else None
            if node is None:
                problem = self.problem(case)
                problem.divide()
                node = close_by_equations(problem) or search(problem, QUICK, self.budget)
                if node is None and place != 1 and rest:
                    node = self.by_factors(case, rest, depth, level + 1)
                elif node is None:
                    more = two_factors(problem)
                    node = (
                        self.by_factors(case, more, depth, level + 1)
                        if more
                        else self.leaf(case, depth)
                    )
            if node is None:
                return None
            nodes.append(node)
        return sign_node(first, nodes)

    def usual(self, problem: LeafProblem, again: bool) -> Node | None:
        """Products of two facts, and single facts times squares; then the same with facts divided
        by their positive factors.
        """
        node = search(problem, (*FIRST, *USUAL) if again else USUAL, self.budget)
        if node is None and problem.divide():
            node = search(problem, (*FIRST, *USUAL), self.budget)
        return node

    def with_lemmas(self, state: SearchState, problem: LeafProblem, depth: int) -> Node | None:
        """Signs that can be shown are added to the facts; where that is not enough, there are
        cases by sign.
        """
        lemmas: list[Lemma] = []
        node = search_orthant(problem, limits.FEW_COLUMNS, self.budget) if self.effort > 1 else None
        if node is not None:
            return node
        for kind in ("integers", "factors", "", "variables")[: 3 + (self.effort > 1)]:
            before = len(lemmas)
            stages = (
                BOTH
                if kind == "variables" and len(problem.facts) <= limits.MOST_FACTS_FOR_BOTH
                else FIRST
            )
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
        node = (
            search(problem, TRIPLES, self.budget)
            if self.effort > 1 and depth < limits.SIGN_DEPTH
            else None
        )
        if node is None and self.effort > 1 and self.budget.left > limits.LARGE_PROGRAM_WORK:
            node = search_orthant(problem, limits.MANY_COLUMNS, self.budget)
        if node is None and self.effort > 1 and depth < limits.SIGN_DEPTH:
            node = self.split(state, problem, depth)
        return under(lemmas, node)

    def lemma(
        self, state: SearchState, text: str, stages: Sequence[Stage]
    ) -> tuple[Lemma | None, SearchState]:
        """The sign of a polynomial where two of the three cases close quickly, and the state with
        it.
        """
        cases, nodes, open_cases = state.by_sign(text), list[Node | None](), list[int]()
        for k, case in enumerate(cases):
            nodes.append(self.attempt(case, stages))
            open_cases += [k] if nodes[k] is None else []
            if len(open_cases) > 1:
                return None, state
        place = open_cases[0] if open_cases else 2
        rounded, inside = self.rounded(cases[place])
        return Lemma(text, nodes, place, rounded, nodes[place]), inside

    def split(self, state: SearchState, problem: LeafProblem, depth: int) -> Node | None:
        """Cases by the sign of a candidate; one of whose cases most close quickly comes first."""
        known = [
            text
            for fact in problem.facts
            for text in (problem.homogeneous_text(fact.poly), problem.homogeneous_text(-fact.poly))
        ]
        tried: list[tuple[int, str, list[Node | None]]] = []
        most = limits.SIGN_BRANCHES - depth
        for kind in ("factors", "variables", "resultants"):
            for text in candidates(state, problem, kind):
                if text in known:
                    continue
                nodes = [self.attempt(case, BOTH) for case in state.by_sign(text)]
                count = sum(node is not None for node in nodes)
                node = sign_node(text, nodes)
                if node is not None:
                    return node
                tried += [(count, text, nodes)] if count else []
            if sum(count == 2 for count, _, _ in tried) >= most:
                break
        tried.sort(key=lambda one: -one[0])
        for _, text, nodes in tried[:most]:
            cases = state.by_sign(text)
            for k in (1, 0, 2):
                nodes[k] = nodes[k] or self.leaf(cases[k], depth + 1)
                if nodes[k] is None:
                    break
            else:
                return sign_node(text, nodes)
        return None


@dataclass
class Lemma:
    """Cases by sign: one is left open, in which integers are rounded; `node` closes it where that
    is known.
    """

    text: str
    nodes: list[Node | None]
    place: int
    rounded: list[int]
    node: Node | None


def sign_node(text: str, nodes: Sequence[Node | None]) -> Sign | None:
    """The node of the cases p < 0, p = 0 and p > 0; None where one of them is open."""
    below, at, above = nodes
    if below is None or at is None or above is None:
        return None
    return "sign", text, below, at, above


def under(lemmas: list[Lemma], node: Node | None) -> Node | None:
    """The node below the nodes of lemmas."""
    for lemma in reversed(lemmas if node is not None else []):
        own = lemma.node if lemma.node is not None else wrapped(lemma.rounded, node)
        node = sign_node(
            lemma.text, [own if k == lemma.place else case for k, case in enumerate(lemma.nodes)]
        )
    return node


def two_factors(problem: LeafProblem) -> list[str]:
    """The factors of the first equation that has two; none where there is none."""
    for equation in problem.reduction.left:
        factors = problem.ring.factors(equation.poly)
        if len(factors) == 2:
            return [problem.homogeneous_text(factor) for factor, _ in factors]
    return []


def candidates(state: SearchState, problem: LeafProblem, kind: str) -> list[str]:
    """Polynomials worth cases by sign: integers and their differences, factors of
    facts, variables, factors of resultants.
    """
    pool = Pool()
    if kind == "integers":
        integers = [
            gen
            for gen, name in zip(problem.ring.gens, state.context.index)
            if name in state.context.integers
        ]
        found = [*integers, *(a - b for a, b in combinations(integers, 2))]
    elif kind == "factors":
        found = problem.unsigned_factors()[: limits.SIGN_CANDIDATES]
    elif kind == "variables":
        found = problem.variables_and_differences()[: 2 * limits.SIGN_CANDIDATES]
    else:
        found = problem.candidates("resultants", 3 * limits.SIGN_CANDIDATES)
    signs, equations = problem.signs(), [equation.poly for equation in problem.reduction.left]
    texts = []
    for poly in found:
        before = len(pool.polys)
        pool.add(problem.reduction.reduce(poly)[1])
        for rest in pool.polys[before:]:
            if not signs.of(rest)[0] or any(
                not divmod(equation, rest)[1] for equation in equations
            ):
                texts.append(problem.homogeneous_text(poly))
    return texts[: 2 * limits.SIGN_CANDIDATES]


FactKey = tuple[frozenset[tuple[int, int]], str]


def fact_key(poly: checker.Poly, relation: str) -> FactKey:
    """The same for two facts that differ by a positive factor."""
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

STRONGER = {
    ">": ((1, ">"),),
    ">=": ((1, ">"), (1, ">="), (1, "=")),
    "=": ((1, "="),),
    "!=": ((1, ">"), (-1, ">"), (1, "!=")),
}


def contradicted(formula: checker.Formula, known: set[FactKey]) -> bool:
    """Whether a fact among the known ones is the negation of the formula, or of a part of a
    conjunction.
    """
    if isinstance(formula, bool):
        return not formula
    if formula[0] == "and":
        return any(contradicted(part, known) for part in formula[1])
    return formula[0] == "atom" and any(
        fact_key(formula[1] if sign > 0 else -formula[1], relation) in known
        for sign, relation in CONTRARY[formula[2]]
    )


def satisfied(formula: checker.Formula, known: set[FactKey]) -> bool:
    """Whether the formula follows from single facts among the known ones."""
    if isinstance(formula, bool):
        return formula
    if formula[0] == "and":
        return all(satisfied(part, known) for part in formula[1])
    return formula[0] == "atom" and any(
        fact_key(formula[1] if sign > 0 else -formula[1], relation) in known
        for sign, relation in STRONGER[formula[2]]
    )


def wrapped(rounded: list[int], node: Node | None) -> Node | None:
    """The node below the nodes that round integer facts."""
    for index in reversed(rounded):
        node = None if node is None else ("integral", index, node)
    return node
