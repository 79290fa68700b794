"""Nonnegative forms that are no sums of squares: cases by a variable, which is 0, or 1 but for the
scale.

Where a variable is not 0, its even powers are the multipliers of Artin's theorem: z^(2k) times the
form is a sum of squares.  Source: Reznick, Uniform denominators in Hilbert's seventeenth problem,
Mathematische Zeitschrift 220 (1995).
"""

from __future__ import annotations

from collections.abc import Sequence

from juggleproof.algebra.polynomials import Ring
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.psatz.linear import close_by_equations
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.search.psatz.sums_of_squares import programs_of_facts, search_squares
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget


def close_by_variables(state: SearchState, ring: Ring, budget: Budget) -> Node | None:
    """A node that closes a state by its facts that are forms of even degree: by sums of squares
    where a variable is 1, and again where it is 0; None where none was found.

    >>> context = checker.Context()
    >>> for name in "xyz":
    ...     context.declare(name)
    >>> motzkin = "x^4*y^2 + x^2*y^4 + z^6 - 3*x^2*y^2*z^2"
    >>> state = SearchState(context).assume(context.formula(checker.parse(f"{motzkin} < 0")))
    >>> node = close_by_variables(state, Ring(("x", "y", "z")), Budget(10**6))
    >>> state.is_closed_by(node, {})
    True

    Raises Exhausted where the budget ends.
    """
    forms = _forms_of(state)
    return None if forms is None else _closed(forms, ring, budget)


def _closed(forms: SearchState, ring: Ring, budget: Budget) -> Node | None:
    used = _variables(forms)
    node = _by_squares(forms, ring, budget, limits.FORM_STAGES[:1])
    if node is not None or not 1 < len(used) <= limits.MOST_FORM_VARIABLES:
        return node
    for name in used:
        below, at, above = forms.by_sign(name)
        node = _by_squares(above, ring, budget)
        if node is None or not below.is_closed_by(node, {}):
            continue
        zero = _closed(at, ring, budget)
        return None if zero is None else ("sign", name, node, zero, node)
    return None


def _by_squares(
    state: SearchState,
    ring: Ring,
    budget: Budget,
    stages: Sequence[tuple[int, int, bool]] = limits.FORM_STAGES,
) -> Node | None:
    problem = LeafProblem(state, ring, True)
    node = close_by_equations(problem)
    return node or search_squares(programs_of_facts(problem, budget, stages), budget)


def _forms_of(state: SearchState) -> SearchState | None:
    """The state in which 1 >= 0 stands for what is no form of even degree: so facts keep their
    numbers.  None where no other fact is left.
    """
    forms, one = state.branch(), state.context.number(1)
    for index, (poly, _) in enumerate(state.facts):
        degrees = {_degree(packed) for packed in poly.terms}
        if len(degrees) != 1 or degrees.pop() % 2:
            forms.facts[index] = one, ">="
    return forms if _variables(forms) else None


def _variables(forms: SearchState) -> list[str]:
    """The variables of the forms, but for those that are 0."""
    zero: set[str] = set()
    used: set[str] = set()
    for poly, relation in forms.facts:
        names = checker.variables_of(forms.context, poly)
        is_zero = relation == "=" and poly.deg == 1 and len(poly.terms) == 1
        (zero if is_zero else used).update(names)
    return [name for name in forms.context.index if name in used - zero]


def _degree(packed: int) -> int:
    """The total degree of a monomial."""
    total, mask = 0, (1 << checker.BITS) - 1
    while packed:
        total, packed = total + (packed & mask), packed >> checker.BITS
    return total
