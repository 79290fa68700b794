"""Terms on all of a state, split by signs."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import islice
from math import lcm

from flint import fmpq, fmpq_mpoly

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    constant_of,
    ring_of,
    to_flint,
    to_text,
)
from juggleproof.algebra.numbers import sign
from juggleproof.algebra.polynomials import term_of
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.closing import search_closing
from juggleproof.search.families_on_a_line import LineCover
from juggleproof.search.hints.asking import ask
from juggleproof.search.ranges import MIRRORED
from juggleproof.search.samples import state_condition
from juggleproof.search.scales import Normal
from juggleproof.search.templates import TemplateSearch
from juggleproof.search.terms import SPARE, Sample, TermChoice, TermQuotient
from juggleproof.search.witness_terms import (
    TermTask,
    confirmed,
    length,
    margins_of,
    setting,
)
from juggleproof.statements.language import End, SharpRange, bounds_of
from juggleproof.statements.nodes import Values, by_sign
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted

# -------------------------------------------------------------------------------------------------
# Terms on all of a state: one choice of terms where it serves, and the state split by a sign where
# it does not.


def cover(
    task: TermTask,
    state: SearchState,
    samples: Sequence[Sample],
    depth: int = 3,
    former: Sequence[TermChoice] = (),
) -> Values | None:
    """Values that serve on the whole state; None where none were found.

    Raises Exhausted where the budget ends.
    """
    if state.closed:
        return "empty", ("close",)
    line = list(state.context.index)
    if len(line) == 1 and samples:
        return LineCover(task, state, line[0], samples).search()
    condition, keys, integers = setting(task, state)
    unknowns = list(keys.values())
    normal = Normal(state, condition)
    condition = normal.condition(condition)
    base = normal.base([n for n in condition.ring.names() if n not in unknowns and n not in SPARE])
    margins = margins_of(state, condition, normal)
    if not samples:
        node = search_closing(state, task.known, task.budget, 1)
        if node is not None:
            return "empty", node
    for _ in range(limits.FAMILY_ROUNDS):
        given = [normal.sample(sample) for sample in samples]
        tried: list[TermChoice] = list(former)
        if samples:
            search = TemplateSearch(
                base,
                given,
                task.budget,
                integers,
                task.nodes,
                None,
                task.hints,
                margins,
                roles=task.roles,
            )
            tried += islice(search.search(condition, unknowns), task.tries)
        failing: list[Sample] = []
        for choice in _shortest(tried):
            point = (
                _failing_point(task, normal, state, condition, choice) if task.effort > 1 else None
            )
            values = confirmed(task, normal, state, choice, keys) if not point else None
            if values is not None:
                return values
            failing += [point] if point and point not in [*samples, *failing] else []
        if not failing:
            break
        samples = [*samples, *failing]
    if depth <= 0 or len(samples) < 2:
        return None
    partial = TemplateSearch(
        base, given, task.budget, integers, task.nodes, 1, task.hints, margins, roles=task.roles
    )
    choices = sorted(
        islice(partial.search(condition, unknowns), 60), key=lambda c: (-len(c.serves), length(c))
    )
    for first in choices[:3]:
        for poly in _splitters(condition, first, given, base)[:2]:
            values = _split(task, state, normal.lift(poly), samples, depth, choices[:4])
            if values is not None:
                return values
    return None


def _failing_point(
    task: TermTask, normal: Normal, state: SearchState, condition: Condition, choice: TermChoice
) -> Sample | None:
    """A point of the state at which a choice of terms does not serve, where Z3 sees one."""
    if choice.roots:
        return None
    for name, value in choice.values.items():
        condition = condition.replaced(name, value.top, value.bottom)
    inside = state_condition(state)
    polys = [poly.project_to_context(condition.ring) for poly in inside.polys]
    there = Condition(condition.ring, polys, inside.tree).conjoined(condition.negated())
    there, integers = there.substituted(normal.scales), state.context.integers
    model = ask(there, task.budget, integers, limits.Z3_GUESS_WORK, model=True).model
    point = {name: model.get(name, fmpq(1)) for name in state.context.index}
    exact = {name: value for name, value in point.items() if isinstance(value, fmpq)}
    return exact if model and len(exact) == len(point) else None


def _split(
    task: TermTask,
    state: SearchState,
    poly: fmpq_mpoly,
    samples: Sequence[Sample],
    depth: int,
    former: Sequence[TermChoice],
) -> Values | None:
    text = to_text(poly)
    groups: list[list[Sample]] = [[], [], []]
    for sample in samples:
        value = constant_of(poly.subs(dict(sample)))
        if value is None:
            return None
        groups[sign(value) + 1].append(sample)
    cases: list[Values] = []
    for branch, group in zip(state.by_sign(text), groups):
        values = cover(task, branch, group, depth - 1, former if not group else ())
        if values is None:
            return None
        cases.append(values)
    whole = by_sign(text, cases)
    ok = state.is_served_by(whole, task.known, task.purpose, task.statement, task.base, task.sharp)
    return whole if ok else None


def _splitters(
    condition: Condition, choice: TermChoice, samples: Sequence[Sample], base: Sequence[str]
) -> list[fmpq_mpoly]:
    """Polynomials in the base whose sign separates the samples that a choice serves from others."""
    if choice.roots or len(choice.serves) == len(samples):
        return []
    changed = condition
    for name, value in choice.values.items():
        changed = changed.replaced(name, value.top, value.bottom)
    found: list[tuple[int, fmpq_mpoly]] = []
    for k in sorted(set(range(len(changed.polys)))):
        if changed.polys[k].is_constant():
            continue
        for factor, _ in changed.polys[k].factor()[1]:
            signs = [sign(constant_of(factor.subs(dict(s))) or 0) for s in samples]
            inside = {signs[i] for i in choice.serves}
            outside = {s for i, s in enumerate(signs) if i not in choice.serves}
            if not inside & outside and factor not in [f for _, f in found]:
                found.append((len(factor) + int(factor.total_degree()), factor))
    return [f for _, f in sorted(found, key=lambda pair: pair[0])]


def _shortest(choices: Sequence[TermChoice]) -> list[TermChoice]:
    return sorted(choices, key=length)


# -------------------------------------------------------------------------------------------------
# A condition in several parameters, solved for one of them; every step of it is decided by
# certificates that the checker accepts.


def solved(statement: SharpRange, parameter: str, whole: Collection[str] = ()) -> str | None:
    """The condition of a range as bounds on one parameter, those of the domain being understood;
    None where it is not linear in it.

    A relation slope*parameter + rest > 0 means parameter > -rest/slope where slope > 0, and
    parameter < -rest/slope where slope < 0. Which of the two it is on the whole domain is proved:
    the checker accepts that the domain with slope <= 0, or >= 0, has no point.

    >>> from juggleproof.statements.language import reals
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
    ends = bounds_of(str(statement.domain), parameter) or (None, None)
    texts = [_interval(checker.conjuncts(case), parameter, state, ends) for case in cases]
    return None if None in texts else " or ".join(text for text in texts if text)


def implies_domain(statement: SharpRange, whole: Collection[str]) -> bool:
    """Whether the condition, with what the domain demands of each parameter alone and the whole
    numbers being whole, implies the rest of the domain: proved.
    """
    state = SearchState(_state(statement, whole).context)
    context = state.context
    domain = context.formula(checker.parse(str(statement.domain)))
    own = [
        part
        for part in checker.conjuncts(domain)
        if not isinstance(part, bool)
        and part[0] == "atom"
        and len(checker.variables_of(context, part[1]) - set(whole)) == 1
        and not checker.variables_of(context, part[1]) & set(whole)
    ]
    state.assume(
        checker.join("and", [context.formula(checker.parse(str(statement.condition))), *own])
    )
    return _impossible(state.assume(checker.negate(domain)))


def _state(statement: SharpRange, whole: Collection[str]) -> SearchState:
    state = SearchState(checker.Context())
    for name in statement.over:
        state.context.declare(name, name in whole)
    return state.assume(state.context.formula(checker.parse(str(statement.domain))))


def _interval(
    atoms: Sequence[checker.Formula],
    parameter: str,
    state: SearchState,
    ends: tuple[End | None, End | None],
) -> str | None:
    """The bounds that relations set, as text, else the ends of the domain; None where one is not
    linear, has a slope of unknown sign, or repeats a bound.
    """
    bounds: dict[str, str] = {}
    for atom in atoms:
        if isinstance(atom, bool) or atom[0] != "atom":
            return None
        bound = _bound(atom[1], atom[2], parameter, state)
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
    low = f"{ends[0][0]} {ends[0][1]} " if ends[0] else ""
    high = f" {ends[1][1]} {ends[1][0]}" if ends[1] else ""
    for relation, text in bounds.items():
        if relation[0] == ">":
            low = f"{text} {MIRRORED[relation]} "
        else:
            high = f" {relation} {text}"
    return low + parameter + high


def _bound(
    poly: checker.Poly, relation: str, parameter: str, state: SearchState
) -> tuple[str, str] | None:
    """(relation, text) of the bound that poly relation 0 is."""
    ring = ring_of(state.context)
    parts = coefficients_in(to_flint(poly, ring, len(state.context.index)), parameter)
    if len(parts) != 2:
        return None
    value = TermQuotient.reduced(-parts[0], parts[1])
    rising, up = (_positive(part, state) for part in (parts[1], value.bottom))
    if rising is None or up is None:
        return None
    top, bottom = (value.top, value.bottom) if up else (-value.top, -value.bottom)
    scale = lcm(*(int(c.q) for part in (top, bottom) for c in part.coeffs()))
    above, below = (term_of(part * scale) for part in (top, bottom))
    return relation if rising else MIRRORED[relation], (
        str(above) if str(below) == "1" else str(above / below)
    )


def _positive(poly: fmpq_mpoly, state: SearchState) -> bool | None:
    """Whether a polynomial is positive on the whole of a state, or negative there; None where
    neither is proved.
    """
    text = str(term_of(poly))
    for relation, verdict in (("<=", True), (">=", False)):
        if _impossible(state.branch(state.context.formula(checker.parse(f"{text} {relation} 0")))):
            return verdict
    return None


def _impossible(state: SearchState) -> bool:
    try:
        return search_closing(state, {}, Budget(limits.SLOPE_WORK)) is not None
    except Exhausted:
        return False
