"""Points whose values are roots of equations with one another's values as coefficients: each root
is adjoined between two decimals.

Signs are those at rational approximations, which are only hints: the nodes that the checker asks
for are searched as any others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from flint import fmpq, fmpq_mpoly

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    constant_of,
    fold,
    places,
    replace,
    to_text,
    univariate,
)
from juggleproof.algebra.numbers import (
    exact,
    fraction,
    real_roots,
    sign,
    simplest_between,
)
from juggleproof.search import limits
from juggleproof.search.candidates import trials
from juggleproof.search.closing import search_closing
from juggleproof.search.witness_terms import TermTask, adjoined_entry, nodes_at
from juggleproof.statements.language import Roles
from juggleproof.statements.nodes import Adjoined, Values, values_at
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget


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
                        condition.replaced(name, value),
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
                close = abs(value) < exact(limits.TOWER_ZERO)
                changed[k] = condition.ring.constant(0 if close else sign(value))
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
                if other != name and other not in {n for n, _, _ in roots}:
                    value = replace(value, other, values[other])
            values[name] = value
        return Tower(roots, values)


def values_of_tower(task: TermTask, state: SearchState, tower: Tower, digits: int) -> Values | None:
    """The point as `states.finds` takes it, with roots between neighbouring decimals; None where a
    node is missing.
    """
    own, known, budget = state.branch(), task.known, task.budget
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
    nodes = nodes_at(task, own, terms, lambda aim: search_closing(aim, known, budget, 1))
    return None if nodes is None else values_at(task.statement.name, entries, terms, nodes)
