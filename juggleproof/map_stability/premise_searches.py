"""Searches for proofs of a premise that a family of functions suggests: from few facts, which are
named, since all others make a search longer; by the cases of signs; and by sums of squares.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import partial

from juggleproof.algebra.polynomials import Ring, total_degree
from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.search.certificate import search_proof
from juggleproof.search.closing import (
    SQUARED,
    Closing,
    fact_key,
    search_closing,
    sign_node,
)
from juggleproof.search.decrease_proofs.by_products import (
    proof_with,
    renumbered,
    with_facts,
)
from juggleproof.search.psatz.lifting import lift
from juggleproof.search.psatz.sums_of_squares import ProductsOfFacts, SquaresProgram
from juggleproof.statements.nodes import Node, Proof
from juggleproof.statements.states import SearchState, proves, state_of
from juggleproof.statements.work import Budget, Exhausted, unfolded

RESERVED = ("value", "level", "distance")


def proof_by_signs(
    premise: checker.Statement, known: dict[str, checker.Statement], signs: Sequence[str]
) -> Proof | None:
    """A proof of the premise by cases of the signs of these polynomials, or None."""
    unfolding = unfolded(premise)
    steps = []
    for count, negation in unfolding.obligations:
        step = closed_by_signs(state_of(unfolding, count).assume(negation), known, ())
        if step is None:
            return None
        steps.append(step)
    node = closed_by_signs(state_of(unfolding).assume(unfolding.goal(False)), known, signs)
    proof: Proof | None = None if node is None else ("proof", steps, node)
    return proof if proof is not None and proves(premise, proof, known) else None


def closed_by_signs(
    state: SearchState,
    known: dict[str, checker.Statement],
    signs: Sequence[str],
    lemma: bool = False,
) -> Node | None:
    """A node that closes the state: by its facts, then by the sign of the first polynomial;
    `lemma`: whether its last fact alone is to be contradicted.
    """
    closing = partial(search_closing, state, known, confirm=False)
    tries: list[tuple[Callable[..., Node | None], int]] = [
        (partial(closing, effort=1), limits.SHORT_WORK)
    ]
    tries += [(partial(_lemma, state, known), limits.LEAF_WORK)] if lemma else []
    tries += (
        [] if signs else [(partial(closing, effort=effort), limits.LEAF_WORK) for effort in (1, 2)]
    )
    tries += [(partial(closing, effort=SQUARED), limits.SHORT_WORK)] if lemma else []
    for one, units in tries:
        try:
            node = one(budget=Budget(units))
        except Exhausted:
            continue
        if node is not None:
            return node
    nodes: list[Node | None] = []
    for place, case in enumerate(state.by_sign(signs[0]) if signs else ()):
        nodes.append(closed_by_signs(case, known, signs[1:], place == 0))
        if nodes[-1] is None:
            return None
    return sign_node(signs[0], nodes) if nodes else None


def _lemma(state: SearchState, known: dict[str, checker.Statement], budget: Budget) -> Node | None:
    """Return a node by sums of squares times facts that have the degree and the names of the last
    fact.
    """
    problem = Closing(known, budget, SQUARED).problem(state, True)
    last = problem.source.lowered[-1]
    top = max(2, total_degree(last))
    strange = [
        place
        for place, name in enumerate(problem.ring.names)
        if name in RESERVED and not last.degrees()[place]
    ]
    only = [
        k
        for k, fact in enumerate(problem.facts)
        if total_degree(fact.poly) <= top and not any(fact.poly.degrees()[v] for v in strange)
    ]
    for count in (1, 2):
        found = ProductsOfFacts(problem, count, top + top % 2, only, budget)
        lifted = partial(lift, problem)
        node = SquaresProgram(problem.ring, found.blocks, found.cofactors, lifted).node(budget)
        if node is not None:
            return node
    return None


def proof_from_few_facts(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    used: Collection[str],
    signs: Sequence[str] = (),
    terms: Collection[int] = (),
    unknowns: Collection[str] = (),
) -> Proof | None:
    """Return a proof of the premise from few facts, by cases of signs if need be; None if none is
    found.  The facts are that the `used` terms are positive, those on the distance, those on these
    terms of V, and the equations of unknowns in the conclusion.
    """

    def closed(state: SearchState) -> Node | None:
        if state.closed:
            return None
        return by_signs(state, known, few_of(state, used, terms, unknowns), signs)

    return proof_with(premise, known, Budget(limits.FEW_FACTS_WORK), closed)


def closed_from(
    state: SearchState,
    known: dict[str, checker.Statement],
    numbers: Sequence[int],
    effort: int,
    work: int = limits.FEW_FACTS_WORK,
) -> Node | None:
    """Return a node that contradicts the facts with these numbers; None if none is found."""
    try:
        few = with_facts(state, numbers)
        node = search_closing(few, known, Budget(work), effort=effort, confirm=False)
    except Exhausted:
        return None
    return renumbered(node, numbers)


def by_signs(
    state: SearchState,
    known: dict[str, checker.Statement],
    kept: Sequence[Sequence[int]],
    signs: Sequence[str],
) -> Node | None:
    """Return a node that contradicts the facts with one of these lists of numbers: by the cases of
    disjunctions, then by the cases of the signs, one after the other.
    """
    if state.choices:
        rest = state.branch()
        every: list[Node] = []
        for one in rest.choices.pop(0):
            case = rest.branch(one)
            added = range(len(rest.facts), len(case.facts))
            node = by_signs(case, known, [[*numbers, *added] for numbers in kept], signs)
            if node is None:
                return None
            every.append(node)
        return "cases", 0, every
    for numbers in kept:
        node = closed_from(state, known, numbers, 2)
        if node:
            return node
    nodes: list[Node | None] = []
    for case in state.by_sign(signs[0]) if signs else ():
        more = [[*numbers, len(state.facts)] for numbers in kept]
        nodes.append(by_signs(case, known, more, signs[1:]))
        if nodes[-1] is None:
            return None
    return sign_node(signs[0], nodes) if nodes else None


def few_of(
    state: SearchState, used: Collection[str], terms: Collection[int], unknowns: Collection[str]
) -> list[list[int]]:
    """Return lists of the numbers of the facts to use, each fact once: one list without the facts
    that bound the distance by nonlinear terms and, unless `terms` are given, one with them.
    """
    ring = Ring(tuple(state.context.index))
    positive = {str(ring.read(state.context.polynomial(text))) for text in used}
    read = [ring.read(poly) for poly, _ in state.facts]
    every = [{ring.names[v] for v, power in enumerate(p.degrees()) if power} for p in read]
    found: dict[bool, dict[str, int]] = {False: {}, True: {}}
    count = 0
    for number, ((_, relation), poly, names) in enumerate(zip(state.facts, read, every)):
        gaps = any(name.endswith("_gap") for name in names)
        count += "value" in names and gaps
        of_value = bool(terms) and (
            gaps
            and "value" in names
            and count - 1 in terms
            or relation == "="
            and bool(names & every[-1] & set(unknowns))
            or relation != "="
            and len(names) == 1
            and names <= every[-1]
            and (len(poly) == 1 or total_degree(poly) == 1 and not names & {"value", *unknowns})
        )
        far = "distance" in names and names <= every[-1]
        if number == len(read) - 1 or str(poly) in positive or of_value or far:
            linear = total_degree(poly) == 1 or not far or number == len(read) - 1
            for powers in (False, True) if linear else (True,):
                found[powers].setdefault(str(poly), number)
    return [list(numbers.values()) for numbers in found.values()][: 1 if terms else 2]


def proof_by_squares(
    premise: checker.Statement, known: dict[str, checker.Statement]
) -> Proof | None:
    """Return a proof of the premise without squares, which is short; else by the cases of
    disjunctions, each from its facts, or by sums of squares times the facts on the value.  None if
    none is found.
    """
    for effort in (1, 2):
        try:
            found = search_proof(premise, known, Budget(limits.FEW_FACTS_WORK), effort=effort)
        except Exhausted:
            continue
        if found is not None:
            return found
    closed = partial(closed_by_squares, known=known)
    return proof_with(premise, known, Budget(limits.FEW_FACTS_WORK), closed)


def proof_without_next(
    premise: checker.Statement, known: dict[str, checker.Statement]
) -> Proof | None:
    """Return a proof of the premise by sums of squares, without the facts on the next state, which
    make the programs large; None if none is found.
    """
    rows = premise.text().splitlines()
    bare = [row for row in rows if not (row.startswith("given ") and "_next" in row)]
    (without,) = checker.read_statements("\n".join(bare)).values()
    few = unfolded(without)
    facts = [fact_key(*fact) for fact in state_of(few).assume(few.goal(False)).facts]

    def closed(state: SearchState) -> Node | None:
        numbers = [k for k, fact in enumerate(state.facts) if fact_key(*fact) in facts]
        if state.choices:
            return None
        return closed_from(state, known, numbers, SQUARED, limits.SQUARES_WORK)

    return proof_with(premise, known, Budget(limits.FEW_FACTS_WORK), closed)


def closed_by_squares(state: SearchState, known: dict[str, checker.Statement]) -> Node | None:
    """A node that contradicts the facts of the state, by the cases of its disjunctions."""
    if state.closed:
        return ("close",)
    ring = Ring(tuple(state.context.index))
    value = ring.names.index("value")
    every = list(range(len(state.facts)))
    on_it = [k for k, (poly, _) in enumerate(state.facts) if ring.read(poly).degrees()[value]]
    # a case that the facts contradict by themselves needs no more cases
    tries = [(every, 1)] if state.choices else [(every, 2), (on_it, SQUARED)]
    for numbers, effort in tries:
        node = closed_from(state, known, numbers, effort)
        if node:
            return node
    if not state.choices:
        return None
    rest = state.branch()
    nodes: list[Node] = []
    for one in rest.choices.pop(0):
        node = closed_by_squares(rest.branch(one), known)
        if node is None:
            return None
        nodes.append(node)
    return "cases", 0, nodes
