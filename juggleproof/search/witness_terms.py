"""Terms as values of points, counterexamples and witnesses: what is sought, and how the checker
takes it.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    projected,
    ring_of,
    to_flint,
    to_text,
)
from juggleproof.certificates import checker
from juggleproof.search.closing import search_closing
from juggleproof.search.psatz.facts import Weight
from juggleproof.search.scales import Normal
from juggleproof.search.terms import SPARE, AdjoinedRoot, TermChoice, TermQuotient
from juggleproof.statements.language import NO_ROLES, Roles
from juggleproof.statements.nodes import Adjoined, Node, Values, by_sign, values_at
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted

Known = dict[str, checker.Statement]

# -------------------------------------------------------------------------------------------------
# What terms are sought for, as a condition on base and unknown variables.


@dataclass
class TermTask:
    """What terms are sought for: a statement, the purpose, the variables that are given, and those
    that are unknown.
    """

    statement: checker.Statement
    purpose: str
    base: dict[str, checker.Poly]
    known: Known
    budget: Budget
    sharp: list[ast.expr] | None = None  # the domain of a sharp range, and its condition if inside
    effort: int = 2
    hints: Mapping[str, Sequence[TermQuotient]] = field(default_factory=dict)
    nodes: int = 400
    tries: int = 6
    roles: Roles = NO_ROLES


def setting(task: TermTask, state: SearchState) -> tuple[Condition, dict[str, str], frozenset[str]]:
    """The condition on base and unknowns, the key in the ring of every unknown, and the keys that
    are integers.
    """
    unfolding = checker.Unfolding(
        task.statement, checker.Context(state.context, dict(task.base)), task.sharp
    )
    if task.purpose == "witness":
        formula = unfolding.goal(True)
        needed = unfolding.variables
    else:
        premises = checker.join("and", list(unfolding.premises))
        exists = task.statement.get("exists")
        formula = (
            checker.join("and", [premises, unfolding.goal(False)])
            if task.purpose == "counterexample" and not exists
            else premises
        )
        needed = set(unfolding.universal)
    by_place = {i: key for key, i in unfolding.context.index.items()}
    keys = {}
    order = [
        n for line in (*task.statement.get("forall"), *task.statement.get("exists")) for n in line
    ]
    for name in sorted(
        needed - set(task.base),
        key=lambda n: (not task.roles.is_scale(n), order.index(n) if n in order else len(order)),
    ):
        (monomial,) = unfolding.context.values[name].terms
        keys[name] = by_place[(monomial.bit_length() - 1) // checker.BITS]
    integers = frozenset(keys[n] for n in unfolding.integers if n in keys) | frozenset(
        state.context.integers
    )
    return (
        Condition.of(unfolding.context, formula, ring_of(unfolding.context, *SPARE)).cleared(),
        keys,
        integers,
    )


def failing_goal(
    task: TermTask, state: SearchState, condition: Condition, budget: Budget
) -> tuple[Condition | None, list[fmpq_mpoly]]:
    """For a counterexample to a statement of existence: the goals, and the borders of the set on
    which they can be met.
    """
    if task.purpose != "counterexample" or not task.statement.get("exists"):
        return None, []
    unfolding = checker.Unfolding(
        task.statement, checker.Context(state.context, dict(task.base)), task.sharp
    )
    goal = Condition.of(unfolding.context, unfolding.goal(True), condition.ring)
    outer = set(condition.ring.names()) - {
        name for line in task.statement.get("exists") for name in line
    }
    try:
        return goal, projected(goal, outer, budget.part(50_000))
    except Exhausted:
        return goal, []


def margins_of(state: SearchState, condition: Condition, normal: Normal) -> list[fmpq_mpoly]:
    """What is positive by the state, dehomogenised, as long as it is short, and products:
    small where the state ends.
    """
    size = len(state.context.index)
    keys = list(state.context.index)
    ring = fmpq_mpoly_ctx.get(keys or ["none"], condition.ring.ordering())
    found: list[fmpq_mpoly] = []
    for poly, relation in state.facts:
        if relation in (">", ">="):
            dehomogenised = normal.dehomogenised(
                to_flint(poly, ring, size).project_to_context(condition.ring)
            )
            if (
                not dehomogenised.is_constant()
                and len(dehomogenised) <= 6
                and dehomogenised.total_degree() <= 4
                and dehomogenised not in found
            ):
                found.append(dehomogenised)
    least = sorted(found, key=lambda p: (p.total_degree(), len(p)))[:5]
    return least + [least[0] * q for q in least[1:3]]


def length(choice: TermChoice) -> int:
    """How long a choice of terms is to read."""
    return sum(sum(q.size()) for q in choice.values.values()) + 20 * len(choice.roots)


# -------------------------------------------------------------------------------------------------
# Terms as the checker takes them: quotients written with divisions that are licensed, roots
# adjoined, nodes searched and confirmed.


class Renamed:
    """Which variables of the ring stand under which names in the checker's context of the state."""

    def __init__(self, ring: fmpq_mpoly_ctx) -> None:
        self.ring, self.names = ring, {name: name for name in ring.names()}

    def text(self, poly: fmpq_mpoly) -> str:
        """A polynomial as text, under the names of the context."""
        names = self.ring.names()
        if all(self.names[n] == n for n in names):
            return to_text(poly)
        new = fmpq_mpoly_ctx.get([self.names[n] for n in names], self.ring.ordering())
        return to_text(new.from_dict(poly.to_dict()))


class TermWriter:
    """Writes quotients of dehomogenised polynomials, whose bottoms the context licenses."""

    def __init__(self, context: checker.Context, renamed: Renamed, normal: Normal) -> None:
        self.context, self.renamed, self.normal = context, renamed, normal
        self.taken: set[str] = set()
        ring = renamed.ring
        size = len(context.index)
        keys = list(context.index)
        self.licensed: list[tuple[fmpq_mpoly, fmpq_mpoly]] = []  # each as it is, and dehomogenised
        for poly, _ in context.licensed.values():
            if set(keys) <= set(ring.names()):
                whole = to_flint(
                    poly, fmpq_mpoly_ctx.get(keys, ring.ordering()), size
                ).project_to_context(ring)
                dehomogenised = normal.dehomogenised(whole)
                if not dehomogenised.is_constant():
                    self.licensed.append((whole, dehomogenised))

    def fresh(self, name: str) -> str:
        """A name that the context does not have."""
        while name in self.context.values or name in self.context.index or name in self.taken:
            name += "_root" if not name.endswith("_root") else "_"
        self.taken.add(name)
        return name

    def licence(self, factor: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly] | None:
        """What is licensed and has this factor, as it is and dehomogenised."""
        return next((pair for pair in self.licensed if (pair[1] % factor) == 0), None)

    def unlicensed(self, value: TermQuotient) -> list[fmpq_mpoly]:
        """The factors of the bottom that no licence has."""
        return [
            f
            for f, _ in value.bottom.factor()[1]
            if not f.is_constant() and self.licence(f) is None
        ]

    def text(self, value: TermQuotient, weight: Weight = ()) -> str:
        """The quotient as text, of this weight.  Raises ValueError where no licence has a factor of
        its bottom.
        """
        normal = self.normal
        top, bottoms = value.top, []
        scale, factors = value.bottom.factor()
        top = top / scale
        need = list(weight)
        for factor, power in factors:
            licence = self.licence(factor)
            if licence is None:
                raise ValueError(f"{factor} has no licence")
            top = top * (licence[1] / factor) ** power
            bottoms += [(self.renamed.text(licence[0]), power)]
            need = [
                n + power * w for n, w in zip(need, normal.weight(normal.at_scale_one(licence[0])))
            ]
        missing = [n - w for n, w in zip(need, normal.weight(top))]
        whole = normal.lift(top)
        for scale, power in zip(normal.scales, missing):
            if power > 0:
                whole = (
                    whole * whole.context().gen(whole.context().variable_to_index(scale)) ** power
                )
            elif power < 0 and top != 0:
                bottoms.append((scale, -power))
        text = self.renamed.text(whole)
        if bottoms:
            below = "*".join(_whole(b) if e == 1 else f"{_whole(b)}^{e}" for b, e in bottoms)
            text = f"{_whole(text)}/" + (below if len(bottoms) == 1 else f"({below})")
        return text


def _whole(text: str) -> str:
    return text if text.isalnum() else f"({text})"


def confirmed(
    task: TermTask,
    normal: Normal,
    state: SearchState,
    choice: TermChoice,
    keys: dict[str, str],
) -> Values | None:
    """The choice as values with all nodes, confirmed by the checker; None where a node is missing.

    Raises Exhausted where the budget ends.
    """
    values = _with_nodes(task, normal, state, choice, keys, 3)
    ok = values is not None and state.is_served_by(
        values, task.known, task.purpose, task.statement, task.base, task.sharp
    )
    return values if ok else None


def _with_nodes(
    task: TermTask,
    normal: Normal,
    state: SearchState,
    choice: TermChoice,
    keys: dict[str, str],
    depth: int,
) -> Values | None:
    """The values; cases by the signs of what they divide by come first where no licence settles
    them.
    """
    known, budget, effort = task.known, task.budget, task.effort
    own = state.branch()
    renamed = Renamed(choice.ring)
    writer = TermWriter(own.context, renamed, normal)
    spare = {root.name for root in choice.roots}
    for value in choice.values.values():
        for factor in writer.unlicensed(value):
            used = {n for n, e in zip(choice.ring.names(), factor.degrees()) if e}
            if depth == 0 or spare & used:
                return None
            text = renamed.text(normal.lift(factor))
            cases: list[Values] = []
            for case, branch in enumerate(own.by_sign(text)):
                node = search_closing(branch, known, budget, min(effort, 1))
                if node is None and case == 1:
                    return None
                part: Values | None = (
                    ("empty", node)
                    if node is not None
                    else _with_nodes(task, normal, branch, choice, keys, depth - 1)
                )
                if part is None:
                    return None
                cases.append(part)
            return by_sign(text, cases)
    adjoined: list[Adjoined] = []
    try:
        for root in choice.roots:
            entry = _adjoined_root(task, own, root, renamed, writer)
            if entry is None:
                return None
            adjoined.append(entry)
        terms: dict[str, str] = {}
        for variable, key in sorted(keys.items()):
            terms[variable] = (
                writer.text(choice.values[key], normal.weights.get(key, ()))
                if key in choice.values
                else renamed.names[key]
            )
    except checker.Rejected:
        return None
    nodes = nodes_at(task, own, terms, lambda aim: search_closing(aim, known, budget, effort))
    return None if nodes is None else values_at(task.statement.name, adjoined, terms, nodes)


def nodes_at(
    task: TermTask,
    state: SearchState,
    terms: Mapping[str, str],
    close: Callable[[SearchState], Node | None],
) -> list[Node] | None:
    """The nodes that show of terms in a state that they serve; None where one is missing, or a term
    cannot be read.
    """
    try:
        values = {name: state.context.value(checker.parse(text)) for name, text in terms.items()}
        context = checker.Context(state.context, {**values, **task.base})
        unfolding = checker.Unfolding(task.statement, context, task.sharp)
        wanted = unfolding.goals if task.purpose == "witness" else unfolding.premises
        aims = [state.branch(checker.negate(checker.join("and", wanted)))]
        if task.purpose == "counterexample":
            aims.append(state.branch(unfolding.goal(True), unfolding.context))
    except checker.Rejected:
        return None
    nodes: list[Node] = []
    for aim in aims:
        node = close(aim)
        if node is None:
            return None
        nodes.append(node)
    return nodes


def _adjoined_root(
    task: TermTask, state: SearchState, root: AdjoinedRoot, renamed: Renamed, writer: TermWriter
) -> Adjoined | None:
    """The larger root of a polynomial of degree 2 with leading coefficient 1, between 0 or its
    vertex and a bound.
    """
    normal = writer.normal
    name = writer.fresh(root.name)
    renamed.names[root.name] = name
    parts = coefficients_in(root.poly, root.name)
    half = parts[1] * fmpq(-1, 2)
    under = half * half - parts[0]  # root = half + sqrt(under)
    weight = normal.weight_of_root(root)
    poly, one = normal.lift(root.poly, tuple(2 * w for w in weight)), under.context().constant(1)
    low = renamed.text(normal.lift(half, weight))
    highs = [renamed.text(normal.lift(one * k, weight)) for k in range(1, 5)]
    quotients = [half + 1 + under]
    for high in [*highs, *(writer.text(TermQuotient(q, one), weight) for q in quotients)]:
        entry = adjoined_entry(
            state, name, renamed.text(poly), low, high, task.known, task.budget, task.effort
        )
        if entry is not None:
            return entry
    return None


def adjoined_entry(
    state: SearchState,
    name: str,
    text: str,
    low: str,
    high: str,
    known: Known,
    budget: Budget,
    effort: int,
) -> Adjoined | None:
    """The adjoined root with its nodes; the state then has the new variable.  None where a node is
    missing, or the name is taken.

    Raises Exhausted where the budget ends, Rejected where a text is none.
    """
    context, zero, tree = state.context, state.context.number(0), checker.parse(text)
    ends = [context.value(checker.parse(end)) for end in (low, high)]
    first, second = (
        checker.Context(context, {**context.values, name: end}).value(tree) for end in ends
    )
    wrong = checker.join(
        "or", [context.atom(ends[0], ">", ends[1]), context.atom(first, ">", zero)]
    )
    below = search_closing(state.branch(wrong), known, budget, min(effort, 1))
    if below is None:
        return None
    above = search_closing(
        state.branch(context.atom(second, "<", zero)), known, budget, min(effort, 1)
    )
    if above is None:
        return None
    try:
        state.adjoin(name, text, low, high)
    except checker.Rejected:
        return None
    return name, text, low, high, below, above
