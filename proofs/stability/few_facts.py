"""A proof from few facts, which are named: all others make a search longer."""

from __future__ import annotations

from collections.abc import Collection

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.polynomials import Ring, total_degree
from juggleproof.certificates.nodes import Node, Proof
from juggleproof.certificates.search.closing import search_closing, sign_node
from juggleproof.certificates.search.falls.by_products import (
    obligations_closed,
    renumbered,
    with_facts,
)
from juggleproof.certificates.states import State, proves, state_of
from juggleproof.certificates.work import Budget, Exhausted, unfolded

BUDGET = 50_000  # of counted work


def proof_from_few_facts(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    used: Collection[str],
    sign: str = "",
) -> Proof | None:
    """A proof of the premise from its facts that these terms are positive, and on the distance;
    if need be by cases of a sign; None where none is found.
    """
    unfolding = unfolded(premise)
    state = state_of(unfolding).assume(unfolding.goal(False))
    if state.choices or state.closed:
        return None
    goal = len(state.facts) - 1
    try:
        steps = obligations_closed(unfolding, known, Budget(BUDGET))
    except Exhausted:
        return None
    node = closed(state, known, goal, used)
    if node is None and sign:
        nodes = [closed(one, known, goal, used) for one in state.by_sign(sign)]
        node = sign_node(sign, nodes) if all(nodes) else None
    if steps is None or node is None:
        return None
    proof: Proof = ("proof", steps, node)
    return proof if proves(premise, proof, known) else None


def closed(
    state: State,
    known: dict[str, checker.Statement],
    goal: int,
    used: Collection[str],
) -> Node | None:
    """A node that contradicts few of the facts, of which `goal` is the first that is of the premise
    alone.
    """
    for powers in (False, True):
        kept = few_of(state, goal, used, powers)
        few = with_facts(state, kept)
        try:
            node = search_closing(few, known, Budget(BUDGET), effort=2, confirm=False)
        except Exhausted:
            continue
        full = renumbered(node, kept) if node else None
        if full:
            return full
    return None


def few_of(state: State, goal: int, used: Collection[str], powers: bool) -> list[int]:
    """The numbers of the facts that are used, each once: those terms, and what bounds the distance
    in names of what is shown; powers: not by linear terms alone.
    """
    ring = Ring(tuple(state.context.index))
    positive = {str(ring.read(state.context.polynomial(text))) for text in used}
    read = [ring.read(poly) for poly, _ in state.facts]
    every = [{ring.names[v] for v, power in enumerate(p.degrees()) if power} for p in read]
    found: dict[str, int] = {}
    for number, (poly, names) in enumerate(zip(read, every)):
        far = "distance" in names and names <= every[goal]
        if number >= goal or str(poly) in positive or far and (powers or total_degree(poly) == 1):
            found.setdefault(str(poly), number)
    return list(found.values())
