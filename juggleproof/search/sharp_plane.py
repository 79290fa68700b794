"""Sharp ranges in several parameters: one polynomial border, or two, by whose signs statements hold
or fail.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from flint import fmpq, fmpq_mpoly

from juggleproof.algebra.conditions import (
    Condition,
    border_polynomials,
    coefficients_in,
    constant_of,
    replace,
)
from juggleproof.algebra.numbers import sign
from juggleproof.algebra.polynomials import relation_of
from juggleproof.algebra.trees import HOLDS
from juggleproof.certificates import checker
from juggleproof.search.closing import search_closing
from juggleproof.search.ranges import Violation
from juggleproof.search.samples import base_samples
from juggleproof.search.sharp import (
    Known,
    Range,
    RangeSearch,
    among,
    read,
    whole_parameters,
)
from juggleproof.search.terms import Sample
from juggleproof.statements.language import (
    NO_ROLES,
    Formula,
    Roles,
    SharpRange,
    conjunction,
    disjunction,
)
from juggleproof.statements.nodes import Sharp, Values
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted

RELATIONS = ("=", "!=", ">", ">=")
Guess = tuple[
    str, list[tuple[fmpq_mpoly, str]]
]  # "and" or "or", and relations of border polynomials to 0


def find_sharp_region(
    statements: Sequence[checker.Statement],
    parameters: Sequence[str],
    domain: Formula,
    name: str,
    known: Known,
    budget: Budget,
    roles: Roles = NO_ROLES,
) -> Range:
    """The set of several parameters on which all the statements hold, as at most two relations of
    border polynomials to 0; with the reason as its `failure` where the budget ends, or none was
    found.
    """
    tree = checker.parse(str(domain))
    roles = among(roles, dict.fromkeys(parameters, ()))
    state = SearchState(checker.Context())
    for parameter in parameters:
        state.context.declare(parameter, parameter in whole_parameters(parameters, statements))
    state.assume(state.context.formula(tree))
    try:
        violations = [Violation.of(s, tree, roles) for s in statements]
        polys = _borders(state, violations, parameters, budget)
        samples = _samples(state, polys, parameters, budget, roles)
        verdicts = []
        for sample in samples:
            verdict = _verdict(violations, sample, budget)
            if verdict is None:
                return Range(failure=f"no verdict at {_shown(sample)}")
            verdicts.append(verdict)
        for guess in _guesses(polys, samples, verdicts):
            condition = _formula(guess)
            statement = SharpRange(
                name, tuple(s.name for s in statements), tuple(parameters), domain, condition
            )
            search = RangeSearch(statements, known, roles)
            certificate, failure = _certified(search, read(statement), budget)
            return Range(statement, [], certificate, failure)
    except Exhausted:
        return Range(failure="the budget ran out")
    return Range(failure="no two borders tell the samples apart")


def _borders(
    state: SearchState, violations: Sequence[Violation], parameters: Sequence[str], budget: Budget
) -> list[fmpq_mpoly]:
    """Polynomials from resultants, and for whole numbers those of the next one."""
    empty = Condition.of(state.context, True)
    found = border_polynomials([(v.condition, v.goal) for v in violations], parameters, budget)
    own = [p.project_to_context(empty.ring) for p in found]
    for name in sorted(state.context.integers):  # of one whole number and the next
        gen = empty.ring.gen(empty.ring.variable_to_index(name))
        own += [replace(p, name, gen + 1, empty.ring.constant(1)) for p in own if len(p) > 2]
    return list({str(q): q for q in own}.values())[:24]


def _samples(
    state: SearchState,
    polys: Sequence[fmpq_mpoly],
    parameters: Sequence[str],
    budget: Budget,
    roles: Roles,
) -> list[Sample]:
    """Points of the domain on both sides of the borders, and on them where a border is linear in a
    parameter.
    """
    found = base_samples(state, budget, roles, 24)
    inside = [
        Condition.of(
            state.context,
            checker.join("and", [("atom", poly, relation) for poly, relation in state.facts]),
        )
    ]
    for sample in list(found):
        for poly in polys:
            for name in sorted(set(parameters) - state.context.integers):
                parts = coefficients_in(
                    poly.subs({n: v for n, v in sample.items() if n != name}), name
                )
                slope = constant_of(parts[1]) if len(parts) == 2 else None
                rest = constant_of(parts[0])
                if slope and rest is not None:
                    for shift in (fmpq(0), fmpq(1, 50), fmpq(-1, 50)):
                        moved = {**sample, name: -rest / slope + shift}
                        if moved not in found and inside[0].substituted(moved).tree is True:
                            found.append(moved)
    return found[:150]


def _verdict(violations: Sequence[Violation], sample: Sample, budget: Budget) -> bool | None:
    for violation in violations:
        absent = violation.absent_at(sample, budget)
        if not absent:
            return absent
    return True


def _guesses(
    polys: Sequence[fmpq_mpoly], samples: Sequence[Sample], verdicts: Sequence[bool]
) -> Iterator[Guess]:
    """Conditions that agree with every verdict, the shortest first."""
    atoms: list[tuple[tuple[fmpq_mpoly, str], list[bool]]] = []
    if all(verdicts):
        yield "and", []
    if not any(verdicts):
        yield "or", []
    for poly in polys:
        signs = [sign(constant_of(poly.subs(dict(s))) or fmpq(0)) for s in samples]
        for factor, oriented in ((poly, signs), (-poly, [-s for s in signs])):
            for relation in RELATIONS:
                truths = [HOLDS[relation](s) for s in oriented]
                if truths == list(verdicts):
                    yield "and", [(factor, relation)]
                atoms.append(((factor, relation), truths))
    for (left, a), (right, b) in combinations(atoms, 2):
        if [p and q for p, q in zip(a, b)] == list(verdicts):
            yield "and", [left, right]
        if [p or q for p, q in zip(a, b)] == list(verdicts):
            yield "or", [left, right]


def _formula(guess: Guess) -> Formula:
    op, atoms = guess
    return (conjunction if op == "and" else disjunction)(
        [relation_of(poly, relation) for poly, relation in atoms]
    )


def _certified(
    search: RangeSearch, statement: checker.Statement, budget: Budget
) -> tuple[Sharp | None, str]:
    inside, failure = search.proofs_inside(statement, budget)
    if inside is None:
        return None, failure
    state = search.outside_state(statement)
    (domain,) = statement.get("domain")
    node = search_closing(state, dict(search.known), budget, 1)
    outside: Values | None = None if node is None else ("empty", node)
    for each in search.statements if outside is None else ():
        outside = search.family(each, state, domain, budget, 3)
        if outside is not None:
            break
    points = search.points(statement, budget)
    if outside is None or points is None:
        return None, "no family of counterexamples outside the range"
    if not search.checked(statement, (inside, outside, points)):
        return None, "the checker does not accept the certificate"
    return (inside, outside, points), ""


def _shown(sample: Sample) -> str:
    return ", ".join(f"{name} = {value}" for name, value in sorted(sample.items()))
