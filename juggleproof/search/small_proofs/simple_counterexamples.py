"""Counterexamples at hand: small rational values for every variable, tried in turn.

This comes first, and loads nothing that is dear to load.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product

from juggleproof.algebra.trees import HOLDS, truth
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.statements.nodes import Certificate, Counterexample, Node
from juggleproof.statements.work import Budget, Exhausted, unfolded

Term = tuple[int, Sequence[tuple[int, int]]]  # a coefficient, and powers of variables


def search_at_hand(statement: checker.Statement, budget: Budget) -> Certificate | None:
    """A counterexample to a statement for all reals; None where none is at hand.

    >>> text = "statement a/b\\nforall x y\\nshow x*y < 2"
    >>> search_at_hand(checker.read_statements(text)["a/b"], Budget(10**4))["refuted"].terms
    {'x': '1', 'y': '2'}
    """
    if any(map(statement.get, ("exists", "integer", "root"))):
        return None
    unfolding = unfolded(statement)
    names = unfolding.universal
    if unfolding.obligations or len(names) > limits.MOST_SIMPLE:
        return None
    assumed = checker.join("and", [*unfolding.premises, unfolding.goal(False)])
    values = limits.SIMPLE_VALUES[min(len(names), len(limits.SIMPLE_VALUES) - 1)]
    known: dict[int, Sequence[Term]] = {}
    try:
        for point in product(values, repeat=len(names)):
            if holds_at(assumed, point, known, budget):
                terms = {name: str(value) for name, value in zip(names, point)}
                close: Node = ("close",)
                return {"refuted": Counterexample(statement.name, [], terms, close, close)}
    except Exhausted:
        pass
    return None


def holds_at(
    formula: checker.Formula,
    point: Sequence[int | Fraction],
    known: dict[int, Sequence[Term]],
    budget: Budget,
) -> bool:
    """Whether a formula holds at a point; `known` keeps the terms of polynomials."""

    def decide(atom: checker.Atom) -> bool:
        _, poly, relation = atom
        if id(poly) not in known:
            known[id(poly)] = [(c, powers(m)) for m, c in poly.terms.items()]
        budget.spend(1 + len(poly.terms) // 4)
        value: int | Fraction = 0
        for c, factors in known[id(poly)]:
            part: int | Fraction = c
            for place, exponent in factors:
                part *= point[place] ** exponent
            value += part
        return HOLDS[relation](value)

    return truth(formula, decide) is True


def powers(monomial: int) -> list[tuple[int, int]]:
    """The variables of a packed monomial by their numbers, with exponents."""
    found, place = [], 0
    while monomial:
        monomial, exponent = divmod(monomial, 1 << checker.BITS)
        if exponent:
            found.append((place, exponent))
        place += 1
    return found
