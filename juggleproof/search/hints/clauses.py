"""A state of many disjunctions, closed by its conflicts: few facts each that contradict one
another.

Z3 chooses an alternative of each disjunction and finds facts among them that have no point; a
search closes those alone, and no choice is made again that has all of them.  Where no choice is
left, cases lead from conflict to conflict: no disjunction is split that the conflicts below it do
not need.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cached_property
from typing import Union

import z3

from juggleproof.algebra.conditions import ring_of, to_flint
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.hints.asking import conflict, session_of
from juggleproof.search.small_proofs.linear_system import Fact, FactKey, key_of
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget

Alternative = Union[checker.Atom, checker.Join]
Choice = Sequence[Alternative]


@dataclass(frozen=True)
class Conflict:
    """Facts that contradict one another, and a node that closes the state of these facts alone."""

    facts: tuple[Fact, ...]
    node: Node

    @cached_property
    def keys(self) -> frozenset[FactKey]:
        """The facts by their keys."""
        return frozenset(map(key_of, self.facts))


@dataclass(frozen=True)
class ClauseCases:
    """One tree for each alternative of a disjunction; `needs` are the facts and disjunctions that
    the conflicts below use.
    """

    choice: Choice
    trees: Sequence[Tree]
    needs: frozenset[FactKey | int]


Tree = Union[Conflict, ClauseCases]


def search_by_conflicts(
    state: SearchState, close: Callable[[SearchState], Node | None], budget: Budget
) -> Node | None:
    """A node that closes a state with disjunctions; `close` closes states of facts alone.  None
    where Z3 sees a point, or a conflict is not closed.
    """
    search = Search(state, close, budget)
    tree = search.tree() if search.collected() else None
    return None if tree is None else written(tree, state)


@dataclass
class Search:
    """The conflicts of one state."""

    state: SearchState
    close: Callable[[SearchState], Node | None]
    budget: Budget
    conflicts: list[Conflict] = field(default_factory=list)
    cases: int = 0

    def collected(self) -> bool:
        """Whether the conflicts, each closed, leave no choice of alternatives."""
        context = session_of(self.budget).context
        solver = z3.SolverFor("QF_FD", ctx=context)
        numbers: dict[FactKey, z3.BoolRef] = {}

        def chosen(fact: Fact) -> z3.BoolRef:
            return numbers.setdefault(key_of(fact), z3.Bool(f"fact{len(numbers)}", context))

        def formula(part: Alternative) -> z3.BoolRef:
            if part[0] == "atom":
                return chosen(part[1:])
            join = z3.And if part[0] == "and" else z3.Or
            return join([formula(inner) for inner in part[1]])

        for choice in self.state.choices:
            solver.add(z3.Or([formula(part) for part in choice]))
        given = frozenset(map(key_of, self.state.facts))
        while str(solver.check()) == "sat":
            self.budget.spend(300)
            model = solver.model()
            true = {key for key, name in numbers.items() if z3.is_true(model[name])} | given
            facts = {key_of(fact): fact for fact in self.state.facts}
            for choice in self.state.choices:
                facts.update((key_of(fact), fact) for fact in taken(choice, true))
            found = self.conflict(list(facts.values()))
            if found is None or len(self.conflicts) >= limits.MOST_CONFLICTS:
                return False
            self.conflicts.append(found)
            news = sorted(str(numbers[key]) for key in found.keys - given)
            solver.add(
                z3.Or([z3.BoolVal(False, context), *(z3.Not(z3.Bool(n, context)) for n in news)])
            )
        return bool(self.conflicts)

    def conflict(self, facts: Sequence[Fact]) -> Conflict | None:
        """Facts among these that a node closes, no more than it uses."""
        names = self.state.context.index
        ring = ring_of(self.state.context)
        core = conflict(
            [(to_flint(poly, ring, len(names)), relation) for poly, relation in facts],
            self.budget,
            limits.Z3_CLAUSES_WORK,
        )
        if core is None and not self.state.context.integers:
            return None
        for few in (core, range(len(facts))) if core else (range(len(facts)),):
            chosen = [facts[k] for k in few]
            alone = SearchState(self.state.context)
            for poly, relation in chosen:
                alone.assume(("atom", poly, relation))
            node = self.close(alone)
            if node is not None:
                used = sorted({k for k in facts_used(node) if k < len(chosen)})
                places = {k: place for place, k in enumerate(used)}
                smaller = moved(node, places, len(chosen), len(used), 0)
                return Conflict(tuple(chosen[k] for k in used), smaller)
        return None

    def tree(self) -> Tree | None:
        """Cases that lead to conflicts everywhere; None where there are too many."""
        given = frozenset(map(key_of, self.state.facts))
        return self.below(given, list(self.state.choices))

    def below(self, given: frozenset[FactKey], choices: list[list[Alternative]]) -> Tree | None:
        self.cases += 1
        if self.cases > limits.MOST_CLAUSE_CASES:
            return None
        self.budget.spend(20 + len(self.conflicts) // 10)
        live = []
        for one in self.conflicts:
            missing = one.keys - given
            if not missing:
                return one
            live.append(missing)
        single = {key for missing in live if len(missing) == 1 for key in missing}
        weight: dict[FactKey, int] = {}
        for missing in live:
            for key in missing:
                weight[key] = weight.get(key, 0) + 4 ** max(0, limits.SMALL_CONFLICT - len(missing))
        best, least = None, (0, 0)
        for choice in choices:
            parts = [direct_keys(part) for part in choice]
            if any(keys <= given and not inner_choices(part) for keys, part in zip(parts, choice)):
                continue
            open_parts = [keys for keys in parts if not keys & single]
            size = (len(open_parts), -sum(weight.get(k, 0) for keys in parts for k in keys))
            if best is None or size < least:
                best, least = choice, size
        if best is None:
            return None
        rest = [choice for choice in choices if choice is not best]
        trees = []
        needs: frozenset[FactKey | int] = frozenset({id(best)})
        for part in best:
            keys, inner = direct_keys(part), inner_choices(part)
            tree = self.below(given | keys, [*rest, *inner])
            if tree is None:
                return None
            own = needs_of(tree)
            if not own & (keys - given) and not own & {id(one) for one in inner}:
                return tree  # the conflict stands without this disjunction
            needs |= own - (keys - given) - {id(one) for one in inner}
            trees.append(tree)
        return ClauseCases(best, trees, needs)


def needs_of(tree: Tree) -> frozenset[FactKey | int]:
    """The facts and disjunctions that a tree uses."""
    return frozenset(tree.keys) if isinstance(tree, Conflict) else tree.needs


def parts_of(part: Alternative) -> Sequence[Alternative]:
    """The parts of a conjunction; else the alternative alone."""
    return part[1] if part[0] == "and" else [part]


def taken(choice: Choice, true: Set[FactKey]) -> list[Fact]:
    """The facts of the first alternative that holds."""
    found: list[Fact] = []
    for one in parts_of(next(part for part in choice if met(part, true))):
        found += [one[1:]] if one[0] == "atom" else taken(one[1], true)
    return found


def met(part: Alternative, true: Set[FactKey]) -> bool:
    """Whether an alternative holds where these facts do."""
    if part[0] == "atom":
        return key_of(part[1:]) in true
    several = all if part[0] == "and" else any
    return several(met(inner, true) for inner in part[1])


def direct_keys(part: Alternative) -> frozenset[FactKey]:
    """The facts that an alternative assumes at once."""
    return frozenset(key_of(one[1:]) for one in parts_of(part) if one[0] == "atom")


def inner_choices(part: Alternative) -> list[list[Alternative]]:
    """The disjunctions that an alternative assumes."""
    return [one[1] for one in parts_of(part) if one[0] == "or"]


# -------------------------------------------------------------------------------------------------
# Nodes in a state of more facts: facts and disjunctions are renumbered.


def facts_used(node: Node) -> Iterator[int]:
    """The numbers of the facts that a node names."""
    if node[0] == "psatz":
        for _, powers, _ in node[1]:
            yield from (k for k, _ in powers)
        yield from (k for k, _ in node[2])
    elif node[0] == "boxes":
        yield node[1]
        for pair in node[2]:
            yield from pair
    elif node[0] == "integral":
        yield node[1]
        yield from facts_used(node[2])
    elif node[0] == "sign":
        for case in node[2:]:
            yield from facts_used(case)
    elif node[0] == "cases":
        for case in node[2]:
            yield from facts_used(case)


def moved(node: Node, places: Mapping[int, int], before: int, after: int, choices: int) -> Node:
    """The node where the first facts have other numbers, later ones follow `after` facts in place
    of `before`, and disjunctions come after others.
    """

    def fact(k: int) -> int:
        return places[k] if k < before else k - before + after

    def inside(one: Node) -> Node:
        return moved(one, places, before, after, choices)

    if node[0] == "psatz":
        products = [(c, [(fact(k), e) for k, e in powers], q) for c, powers, q in node[1]]
        return "psatz", products, [(fact(k), m) for k, m in node[2]]
    if node[0] == "boxes":
        return "boxes", fact(node[1]), [(fact(j), fact(k)) for j, k in node[2]], node[3]
    if node[0] == "integral":
        return "integral", fact(node[1]), inside(node[2])
    if node[0] == "sign":
        return "sign", node[1], inside(node[2]), inside(node[3]), inside(node[4])
    if node[0] == "cases":
        return "cases", node[1] + choices, [inside(case) for case in node[2]]
    return node


def written(tree: Tree, state: SearchState) -> Node:
    """The node of a tree in a state that has what the tree needs."""
    if isinstance(tree, Conflict):
        numbers: dict[FactKey, int] = {}
        for k, fact in enumerate(state.facts):
            numbers.setdefault(key_of(fact), k)
        places = {k: numbers[key_of(fact)] for k, fact in enumerate(tree.facts)}
        return moved(tree.node, places, len(places), len(state.facts), len(state.choices))
    index = next(k for k, choice in enumerate(state.choices) if choice is tree.choice)
    rest = state.branch()
    del rest.choices[index]
    nodes = [written(case, rest.branch(part)) for part, case in zip(tree.choice, tree.trees)]
    return "cases", index, nodes
