"""Points, counterexamples, witnesses."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from flint import fmpq, fmpq_mpoly

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.conditions import (
    Condition,
    coefficients_in,
    constant_of,
    fold,
    places,
    ring_of,
    to_text,
    univariate,
)
from juggleproof.certificates.algebra.numbers import (
    exact,
    fraction,
    real_roots,
    sign,
    simplest_between,
)
from juggleproof.certificates.language import NO_ROLES, Roles
from juggleproof.certificates.nodes import Adjoined, Node, Values, values_at
from juggleproof.certificates.search.candidates import trials
from juggleproof.certificates.search.closing import AdjoinedNumber, close_at_number, search_closing
from juggleproof.certificates.search.families import cover
from juggleproof.certificates.search.models import approximate_points, ask, model_assignments
from juggleproof.certificates.search.samples import Assignment, Sampler, base_samples
from juggleproof.certificates.search.scales import with_scales
from juggleproof.certificates.search.witness_terms import Known, Task, adjoined_entry
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget, Exhausted, unfolded

# -------------------------------------------------------------------------------------------------
# Points whose values are roots of equations with one another's values as coefficients: each root
# is adjoined between two decimals.
#
# Signs are those at rational approximations, which are only hints: the nodes that the checker asks
# for are searched as any others.

TINY = fmpq(1, 10**15)
DIGITS = (2, 4, 8, 14)


@dataclass(frozen=True)
class Tower:
    """Values of variables: terms in the roots, which are given in the order in which each can be
    adjoined.
    """

    roots: tuple[
        tuple[str, fmpq_mpoly, fmpq], ...
    ]  # variable, polynomial in it and in earlier roots, approximation
    values: Mapping[str, fmpq_mpoly]


class Towers:
    """A search for points: equations in one variable give roots, linear ones terms, and the other
    variables are tried.
    """

    def __init__(
        self,
        budget: Budget,
        names: Sequence[str],
        guide: Mapping[str, fmpq],
        nodes: int,
        width: int,
        roles: Roles,
    ) -> None:
        self.budget, self.names, self.guide = budget, list(names), guide
        self.nodes, self.width, self.roles = nodes, width, roles

    def search(
        self,
        condition: Condition,
        roots: tuple[tuple[str, fmpq_mpoly, fmpq], ...] = (),
        steps: tuple[tuple[str, fmpq_mpoly], ...] = (),
    ) -> Iterator[Tower]:
        """Points that seem to meet the condition."""
        self.nodes -= 1
        self.budget.spend(60 + 20 * len(condition.polys))
        condition = self._settled(condition, roots)
        if condition.tree is False or self.nodes < 0:
            return
        if condition.tree is True:
            yield self._completed(condition, roots, steps)
            return
        approximate = {name: value for name, _, value in roots}
        for poly, relation in condition.facts():
            free = self._free(poly, approximate)
            if relation == "=" and len(free) == 1:
                yield from self._rooted(condition, roots, steps, free[0], poly, approximate)
                return
        for poly, relation in condition.facts():
            for name in self._free(poly, approximate) if relation == "=" else ():
                rest, *slopes = coefficients_in(poly, name)
                slope = constant_of(slopes[0]) if len(slopes) == 1 else None
                if slope:
                    value = rest * (-1 / slope)
                    yield from self.search(
                        condition.replaced(name, value, condition.ring.constant(1)),
                        roots,
                        (*steps, (name, value)),
                    )
                    return
        name = next(n for n in self.names if n in condition.variables() and n not in approximate)
        for value in self._tried(condition, name, approximate):
            yield from self.search(
                condition.substituted({name: value}),
                roots,
                (*steps, (name, condition.ring.constant(value))),
            )

    def _free(self, poly: fmpq_mpoly, approximate: Mapping[str, fmpq]) -> list[str]:
        return [
            name
            for name, e in zip(places(poly.context()), poly.degrees())
            if e > 0 and name not in approximate
        ]

    def _rooted(
        self,
        condition: Condition,
        roots: tuple[tuple[str, fmpq_mpoly, fmpq], ...],
        steps: tuple[tuple[str, fmpq_mpoly], ...],
        name: str,
        poly: fmpq_mpoly,
        approximate: Mapping[str, fmpq],
    ) -> Iterator[Tower]:
        """The roots of an equation in one variable, those next to the guide first."""
        given = {places(condition.ring)[n]: v for n, v in approximate.items()}
        alone = univariate(poly.subs(given), name)
        found = [
            root
            for root in real_roots(alone)
            if root.is_rational or sign(alone.derivative()(root.approximation()))
        ]
        found.sort(
            key=lambda root: (
                abs(root.approximation() - self.guide[name]) if name in self.guide else fmpq(0)
            )
        )
        rational = not any(
            e > 0 for n, e in zip(places(poly.context()), poly.degrees()) if n in approximate
        )
        for root in found:
            if root.is_rational and rational:
                value = root.approximation()
                yield from self.search(
                    condition.substituted({name: value}),
                    roots,
                    (*steps, (name, condition.ring.constant(value))),
                )
            elif sign(alone.derivative()(root.approximation())):
                yield from self.search(
                    condition, (*roots, (name, poly, root.approximation())), steps
                )

    def _tried(
        self, condition: Condition, name: str, approximate: Mapping[str, fmpq]
    ) -> list[fmpq]:
        values: list[fmpq] = []
        if name in self.guide:
            values += [
                exact(fraction(self.guide[name]).limit_denominator(k)) for k in (1, 4, 20, 200)
            ]
            values.append(
                simplest_between(
                    self.guide[name] - fmpq(1, 10**6), self.guide[name] + fmpq(1, 10**6)
                )
            )
        values += trials(
            condition.substituted(approximate) if approximate else condition,
            name,
            False,
            self.width,
            self.roles,
        )
        return list(dict.fromkeys(values))

    def _settled(
        self, condition: Condition, roots: Sequence[tuple[str, fmpq_mpoly, fmpq]]
    ) -> Condition:
        """The condition with the signs of polynomials in roots alone, as they seem."""
        approximate = {name: value for name, _, value in roots}
        if not approximate or isinstance(condition.tree, bool):
            return condition
        given, changed = (
            {places(condition.ring)[n]: v for n, v in approximate.items()},
            list(condition.polys),
        )
        for k in condition.used():
            if changed[k].total_degree() > 0 and not self._free(changed[k], approximate):
                value = constant_of(changed[k].subs(given)) or fmpq(0)
                changed[k] = condition.ring.constant(0 if abs(value) < TINY else sign(value))
        return Condition(condition.ring, changed, fold(condition.tree, changed.__getitem__))

    def _completed(
        self,
        condition: Condition,
        roots: tuple[tuple[str, fmpq_mpoly, fmpq], ...],
        steps: Sequence[tuple[str, fmpq_mpoly]],
    ) -> Tower:
        values = {name: condition.ring.constant(1) for name in self.names}
        values.update(
            {name: condition.ring.gen(places(condition.ring)[name]) for name, _, _ in roots}
        )
        for name, value in reversed(steps):
            for other in self.names:
                if (
                    other != name
                    and value.degrees()[places(condition.ring)[other]] > 0
                    and other not in {n for n, _, _ in roots}
                ):
                    parts = coefficients_in(value, other)
                    value = parts[-1]
                    for c in reversed(parts[:-1]):
                        value = value * values[other] + c
            values[name] = value
        return Tower(roots, values)


def values_of_tower(
    statement: checker.Statement,
    state: State,
    tower: Tower,
    purpose: str,
    known: dict[str, checker.Statement],
    budget: Budget,
    digits: int,
) -> Values | None:
    """The point as `states.finds` takes it, with roots between neighbouring decimals; None where a
    node is missing.
    """
    own = state.branch()
    entries: list[Adjoined] = []
    for name, poly, approximation in tower.roots:
        place, ring = places(poly.context()), poly.context()
        at = {place[n]: value for n, _, value in tower.roots}
        rises = sign(constant_of(poly.derivative(place[name]).subs(at)) or fmpq(0)) > 0
        low = fmpq((approximation * 10**digits).floor(), 10**digits)
        text = to_text(poly if rises else ring.constant(0) - poly)
        entry = adjoined_entry(
            own, name, text, str(low), str(low + fmpq(1, 10**digits)), known, budget, 1
        )
        if entry is None:
            return None
        entries.append(entry)
    terms = {name: to_text(value) for name, value in sorted(tower.values.items())}
    try:
        values = {name: own.context.value(checker.parse(text)) for name, text in terms.items()}
        unfolding = checker.Unfolding(statement, checker.Context(own.context, values))
    except checker.Rejected:
        return None
    aims = [own.branch(checker.negate(checker.join("and", unfolding.premises)))]
    aims += (
        [own.branch(unfolding.goal(True), unfolding.context)] if purpose == "counterexample" else []
    )
    nodes = [search_closing(aim, known, budget, 1) for aim in aims]
    closed = [node for node in nodes if node is not None]
    return values_at(statement.name, entries, terms, closed) if len(closed) == len(nodes) else None


# -------------------------------------------------------------------------------------------------
# Exact points that meet a statement's premises, counterexamples that break its goals, and
# witnesses, as the checker takes them.

# For each effort: rounds of (values tried for a variable, values kept for the last one,
# substitutions in all, irrational ones too).
ROUNDS: tuple[tuple[tuple[int, int, int, bool], ...], ...] = (
    ((3, 1, 40, False),),
    ((3, 1, 60, True), (6, 2, 400, True), (12, 3, 1000, True)),
    ((3, 1, 60, True), (6, 2, 400, True), (12, 3, 3000, True), (24, 6, 8000, True)),
)


def search_values(
    statement: checker.Statement,
    state: State,
    purpose: str,
    base: dict[str, checker.Poly],
    known: Known,
    budget: Budget,
    sharp: list[ast.expr] | None = None,
    effort: int = 1,
    roles: Roles = NO_ROLES,
) -> Values | None:
    """Values as `states.finds` takes them for the purpose "point", "counterexample" or "witness";
    None where none were found.

    `base` has the values of variables that are given, in which a witness is sought as terms.
    Raises Exhausted where the budget ends.
    """
    unfolding = unfolded(statement, sharp)
    roles = with_scales(roles, unfolding)
    if base:
        task = Task(statement, purpose, base, known, budget, sharp, effort, roles=roles)
        return _terms_on_state(task, state)
    exists = bool(statement.get("exists"))
    parts = list(unfolding.premises)
    names = list(unfolding.universal)
    if purpose == "witness":
        parts, names = [unfolding.goal(True)], sorted(unfolding.variables)
    elif purpose == "counterexample" and not exists:
        parts.append(unfolding.goal(False))
    whole = checker.join("and", parts)
    if whole is False:
        return None
    condition = Condition.of(unfolding.context, whole, ring_of(unfolding.context))
    goal = (
        Condition.of(unfolding.context, unfolding.goal(True), condition.ring)
        if exists and purpose == "counterexample"
        else None
    )
    if (
        exists
        or purpose == "witness"
        or unfolding.integers
        or sharp
        or not effort
        or not any(r == "=" for _, r in condition.facts())
    ):
        return _sampled(
            statement,
            state,
            condition,
            goal,
            names,
            frozenset(unfolding.integers),
            purpose,
            known,
            budget,
            sharp,
            effort,
            roles,
        )
    try:
        part = budget.part(budget.left * 6 // 10)
        values = _sampled(
            statement,
            state,
            condition,
            goal,
            names,
            frozenset(),
            purpose,
            known,
            part,
            sharp,
            effort,
            roles,
        )
    except Exhausted:
        values = None
    return values or _by_towers(
        statement, state, condition, names, purpose, known, budget, effort, roles
    )


def _sampled(
    statement: checker.Statement,
    state: State,
    condition: Condition,
    goal: Condition | None,
    names: Sequence[str],
    integers: frozenset[str],
    purpose: str,
    known: Known,
    budget: Budget,
    sharp: list[ast.expr] | None,
    effort: int,
    roles: Roles,
) -> Values | None:
    """A point from samples and models, with one irrational number at most."""
    failures = 0
    many = goal is not None
    for assignment in assignments(condition, names, integers, budget, effort, many, roles):
        if goal is not None and not _beyond(goal, assignment, names, integers, budget, roles):
            failures += 1
        else:
            values = values_of_assignment(
                statement, state, assignment, names, purpose, known, budget, sharp, effort
            )
            if values is not None:
                return values
            failures += 5
        if failures >= 30 * (effort + 1):
            break
    return None


def _by_towers(
    statement: checker.Statement,
    state: State,
    condition: Condition,
    names: Sequence[str],
    purpose: str,
    known: Known,
    budget: Budget,
    effort: int,
    roles: Roles,
) -> Values | None:
    """A point with several irrational values, guided by points in floats."""
    for guide in approximate_points(condition, names, budget):
        failures = 0
        for tower in Towers(budget, names, guide, 60 * effort, 1, roles).search(condition):
            for digits in DIGITS:
                values = values_of_tower(statement, state, tower, purpose, known, budget, digits)
                if values is not None and state.is_served_by(values, known, purpose, statement):
                    return values
            failures += 1
            if failures >= 2 * effort:
                break
    return None


def _beyond(
    goal: Condition,
    assignment: Assignment,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    roles: Roles,
) -> bool:
    """Whether Z3 thinks that no values of the `exists` variables meet the goals at a rational
    point.
    """
    values = {name: assignment.rational(name) for name in names}
    exact = {name: value for name, value in values.items() if value is not None}
    if len(exact) < len(names):
        return False
    there = goal.substituted(exact)
    rest = sorted(there.variables())
    sampler = Sampler(budget, integers, *ROUNDS[0][0], roles=roles)
    if next(sampler.search(there, rest), None) is not None:
        return False  # so simple values that meet the goals need not be asked for
    return ask(there, budget, integers, 200_000).verdict == "unsat"


def _terms_on_state(task: Task, state: State) -> Values | None:
    """Terms in the base variables, on all of the state."""
    if task.effort == 0:
        task = replace(task, effort=1, nodes=40, tries=2)
    return cover(
        task, state, base_samples(state, task.budget, task.roles), depth=(0, 2, 4)[task.effort]
    )


def assignments(
    condition: Condition,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    effort: int,
    many: bool = False,
    roles: Roles = NO_ROLES,
) -> Iterator[Assignment]:
    """Assignments that meet a condition, from wider and wider samples; at last from Z3's models."""
    for width, last, nodes, irrational in ROUNDS[effort]:
        yield from Sampler(
            budget, integers, width, last + 12 * many, nodes, irrational, roles=roles
        ).search(condition, names)
        if effort and width == 6:
            # Where Z3 sees that there is nothing, wider samples would be in vain.
            answer = ask(condition, budget, integers, 100_000).verdict
            if answer == "unsat":
                return
            if answer == "sat" and not many:
                yield from model_assignments(condition, names, integers, budget, effort, roles)


def values_of_assignment(
    statement: checker.Statement,
    state: State,
    assignment: Assignment,
    names: Sequence[str],
    purpose: str,
    known: Known,
    budget: Budget,
    sharp: list[ast.expr] | None,
    effort: int,
) -> Values | None:
    """The assignment in the checker's form, with its nodes, confirmed by the checker; None where it
    does not serve.
    """
    nodes: list[Node] = [("close",)] * (2 if purpose == "counterexample" else 1)
    if assignment.number is None:
        terms = {name: str(fraction(assignment.values[name][0])) for name in names}
        if purpose == "counterexample" and statement.get("exists"):
            node = _goal_node(statement, state, terms, known, budget, sharp, effort)
            if node is None:
                return None
            nodes[1] = node
        values = values_at(statement.name, [], terms, nodes)
        return (
            values if state.is_served_by(values, known, purpose, statement, sharp=sharp) else None
        )
    for digits in (1, 2, 3, 4, 6, 9, 14, 20, 40):
        adjoined = AdjoinedNumber.of(assignment.number, digits, _fresh("theta", statement))
        terms = {name: adjoined.text(assignment.values[name]) for name in names}
        closed = _nodes_at_number(statement, state, terms, adjoined, sharp, purpose)
        if closed is not None:
            values = values_at(statement.name, [adjoined.entry()], terms, closed)
            if state.is_served_by(values, known, purpose, statement, sharp=sharp):
                return values
    return None


def _unfolding(
    statement: checker.Statement,
    state: State,
    adjoined: Sequence[Adjoined],
    terms: Mapping[str, str],
    sharp: list[ast.expr] | None,
) -> tuple[State, checker.Unfolding]:
    """The state and the unfolding that the checker has when it comes to the nodes of values without
    a base.
    """
    state = state.branch()
    for name, text, low, high, _, _ in adjoined:
        state.adjoin(name, text, low, high)
    values = {name: state.context.value(checker.parse(text)) for name, text in terms.items()}
    return state, checker.Unfolding(statement, checker.Context(state.context, values), sharp)


def _goal_node(
    statement: checker.Statement,
    state: State,
    terms: Mapping[str, str],
    known: Known,
    budget: Budget,
    sharp: list[ast.expr] | None,
    effort: int,
) -> Node | None:
    state, unfolding = _unfolding(statement, state, [], terms, sharp)
    return search_closing(
        state.branch(unfolding.goal(True), unfolding.context), known, budget, min(effort, 1)
    )


def _nodes_at_number(
    statement: checker.Statement,
    state: State,
    terms: Mapping[str, str],
    adjoined: AdjoinedNumber,
    sharp: list[ast.expr] | None,
    purpose: str,
) -> list[Node] | None:
    """The nodes of values at an adjoined number; None where one is missing."""
    try:
        state, unfolding = _unfolding(statement, state, [adjoined.entry()], terms, sharp)
        branches = [
            state.branch(
                checker.negate(
                    checker.join(
                        "and", unfolding.goals if purpose == "witness" else unfolding.premises
                    )
                )
            )
        ]
        if purpose == "counterexample":
            branches.append(state.branch(unfolding.goal(True), unfolding.context))
        nodes: list[Node] = []
        for branch in branches:
            node = close_at_number(branch, adjoined)
            if node is None:
                return None
            nodes.append(node)
    except checker.Rejected:
        return None
    return nodes


def _fresh(name: str, statement: checker.Statement) -> str:
    kinds = ("forall", "exists", "let", "root")
    taken = {
        n
        for kind in kinds
        for line in statement.get(kind)
        for n in (line if isinstance(line, list) else [line[0]])
    }
    while name in taken:
        name += "_"
    return name
