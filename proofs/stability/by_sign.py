"""A proof by the signs of polynomials that a search of functions suggests: a lemma on the side
where it fails, and its use on the others.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.polynomials import total_degree
from juggleproof.certificates.nodes import Node, Proof
from juggleproof.certificates.search.closing import SQUARED, Closing, search_closing, sign_node
from juggleproof.certificates.search.psatz.lifting import lift
from juggleproof.certificates.search.psatz.sums_of_squares import ProductsOfFacts, SquaresProgram
from juggleproof.certificates.states import State, proves, state_of
from juggleproof.certificates.work import Budget, Exhausted, unfolded

BUDGET = 500_000  # of counted work for a leaf
SHORT = 60_000  # of it, where there is something else to try
SQUARES = 60_000  # of it, for sums of squares of higher degree
RESERVED = ("value", "level", "distance")


def proof_by_signs(
    premise: checker.Statement, known: dict[str, checker.Statement], signs: Sequence[str]
) -> Proof | None:
    """A proof of the premise by cases of the signs of these polynomials, or None."""
    unfolding = unfolded(premise)
    steps = []
    for count, negation in unfolding.obligations:
        step = _closed(state_of(unfolding, count).assume(negation), known, ())
        if step is None:
            return None
        steps.append(step)
    node = _closed(state_of(unfolding).assume(unfolding.goal(False)), known, signs)
    proof: Proof | None = None if node is None else ("proof", steps, node)
    return proof if proof is not None and proves(premise, proof, known) else None


def _closed(
    state: State,
    known: dict[str, checker.Statement],
    signs: Sequence[str],
    lemma: bool = False,
) -> Node | None:
    """A node that closes the state: by its facts, then by the sign of the first polynomial;
    `lemma`: whether its last fact alone is to be contradicted.
    """
    closing = partial(search_closing, state, known, confirm=False)
    tries: list[tuple[Callable[..., Node | None], int]] = [(partial(closing, effort=1), SHORT)]
    tries += [(partial(_lemma, state, known), BUDGET)] if lemma else []
    tries += [] if signs else [(partial(closing, effort=effort), BUDGET) for effort in (1, 2)]
    tries += [(partial(closing, effort=SQUARED), SQUARES)] if lemma else []
    for one, units in tries:
        try:
            node = one(budget=Budget(units))
        except Exhausted:
            continue
        if node is not None:
            return node
    nodes: list[Node | None] = []
    for place, case in enumerate(state.by_sign(signs[0]) if signs else ()):
        nodes.append(_closed(case, known, signs[1:], place == 0))
        if nodes[-1] is None:
            return None
    return sign_node(signs[0], nodes) if nodes else None


def _lemma(state: State, known: dict[str, checker.Statement], budget: Budget) -> Node | None:
    """A node by sums of squares times facts whose degree and names are those of the last fact."""
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
