"""A condition in several parameters, solved for one of them; every step of it is decided by
certificates that the checker accepts.
"""

from __future__ import annotations

from collections.abc import Collection
from math import lcm
from typing import Any

from flint import fmpq_mpoly

from certificates import checker
from certificates.statements import SharpRange

from .budget import Budget, Exhausted
from .closing import search_closing
from .condition import coefficients_in, ring_of, to_flint
from .quotients import Quotient
from .writing import term_of

WORK = 200_000  # units for the sign of one slope
TURNED = {">": "<", ">=": "<=", "=": "=", "!=": "!="}


def solved(statement: SharpRange, parameter: str, whole: Collection[str] = ()) -> str | None:
    """The condition of a range as bounds on one parameter, 0 < parameter < 1 being understood; None
    where it is not linear in it.

    A relation slope*parameter + rest > 0 says parameter > -rest/slope where slope > 0, and
    parameter < -rest/slope where slope < 0. Which of the two it is on the whole domain is proved:
    the checker accepts that the domain with slope <= 0, or >= 0, has no point.

    >>> from certificates.terms import reals
    >>> alpha, K = reals("alpha K")
    >>> domain = (alpha > 0) & (alpha < 1) & (K >= 1)
    >>> condition = alpha*K + alpha - K + 1 >= 0
    >>> orbit = SharpRange("x/sharp", (), ("alpha", "K"), domain, condition)
    >>> solved(orbit, "alpha", ["K"])
    '(K - 1)/(K + 1) <= alpha < 1'
    """
    state = _state(statement, whole)
    condition = state.context.formula(checker.parse(str(statement.condition)))
    if isinstance(condition, bool):
        return None
    cases = condition[1] if condition[0] == "or" else [condition]
    texts = [_interval(case[1] if case[0] == "and" else [case], parameter, state) for case in cases]
    return None if None in texts else " or ".join(text for text in texts if text)


def says_domain(statement: SharpRange, whole: Collection[str]) -> bool:
    """Whether the condition, with 0 < parameter < 1 and the whole numbers being whole, implies the
    rest of the domain: proved.
    """
    state = checker.State(_state(statement, whole).context)
    context = state.context
    own = [
        context.formula(checker.parse(f"{name} > 0 and {name} < 1"))
        for name in statement.over
        if name not in whole
    ]
    state.assume(
        checker.join("and", [context.formula(checker.parse(str(statement.condition))), *own])
    )
    return _impossible(
        state.assume(checker.negate(context.formula(checker.parse(str(statement.domain)))))
    )


def _state(statement: SharpRange, whole: Collection[str]) -> checker.State:
    state: checker.State = checker.State(checker.Context())
    for name in statement.over:
        state.context.declare(name, name in whole)
    return state.assume(state.context.formula(checker.parse(str(statement.domain))))


def _interval(atoms: list[Any], parameter: str, state: checker.State) -> str | None:
    """The bounds that relations set, as text; None where one is not linear, has a slope of unknown
    sign, or repeats a bound.
    """
    bounds: dict[str, str] = {}
    for atom in atoms:
        bound = _bound(atom[1], atom[2], parameter, state) if atom[0] == "atom" else None
        if bound is None or bound[0][0] in {relation[0] for relation in bounds}:
            return None
        bounds[bound[0]] = bound[1]
    exact = [
        f"{parameter} {relation} {text}"
        for relation, text in bounds.items()
        if relation in ("=", "!=")
    ]
    if exact:
        return exact[0] if len(bounds) == 1 else None
    low = next(
        (f"{text} {TURNED[relation]} " for relation, text in bounds.items() if relation[0] == ">"),
        "0 < ",
    )
    high = next(
        (f" {relation} {text}" for relation, text in bounds.items() if relation[0] == "<"), " < 1"
    )
    return low + parameter + high


def _bound(
    poly: checker.Poly, relation: str, parameter: str, state: checker.State
) -> tuple[str, str] | None:
    """(relation, text) of the bound that poly relation 0 is."""
    ring = ring_of(state.context)
    parts = coefficients_in(to_flint(poly, ring, len(state.context.index)), parameter)
    if len(parts) != 2:
        return None
    value = Quotient.reduced(-parts[0], parts[1])
    rising, up = (_positive(part, state) for part in (parts[1], value.bottom))
    if rising is None or up is None:
        return None
    top, bottom = (value.top, value.bottom) if up else (-value.top, -value.bottom)
    scale = lcm(*(int(c.q) for part in (top, bottom) for c in part.coeffs()))
    above, below = (term_of(part * scale) for part in (top, bottom))
    return relation if rising else TURNED[relation], (
        str(above) if str(below) == "1" else str(above / below)
    )


def _positive(poly: fmpq_mpoly, state: checker.State) -> bool | None:
    """Whether a polynomial is positive on the whole of a state, or negative there; None where
    neither is proved.
    """
    text = str(term_of(poly))
    for relation, verdict in (("<=", True), (">=", False)):
        if _impossible(state.branch(state.context.formula(checker.parse(f"{text} {relation} 0")))):
            return verdict
    return None


def _impossible(state: checker.State) -> bool:
    try:
        return search_closing(state, {}, Budget(WORK)) is not None
    except Exhausted:
        return False
