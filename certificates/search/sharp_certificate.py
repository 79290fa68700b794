"""The certificate of a sharp range: counterexamples on every interval outside on which one
statement fails, then proofs inside.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from flint import fmpq_poly

from certificates import checker

from .algebraic import AlgebraicNumber, fraction, real_roots, simplest_between
from .base_samples import base_samples
from .budget import Budget, Exhausted
from .certificate import search_proof
from .closing import search_closing
from .condition import Condition
from .families import cover
from .ranges import Line, ends_of
from .sampler import Sampler
from .setting import Task

Node = list[Any]
FIRST = 600_000  # units of work for a proof with little effort
OUTSIDE = 2_500_000  # units of work for the families; those that are found at all are found early


def sharp_certificate(
    statement: checker.Statement,
    statements: Sequence[checker.Statement],
    parameter: str,
    line: Line,
    verdicts: Mapping[str, Sequence[bool]],
    known: Mapping[str, checker.Statement],
    budget: Budget,
) -> tuple[Node | None, str]:
    """([{name: proof}, found, sample], "") or (None, what could not be certified)."""
    (domain,) = statement.get("domain")
    named = {each.name: each for each in statements}
    try:
        sample = sample_of(statement, statements, budget)
        outside = _outside(
            outside_state(statement, statements),
            named,
            parameter,
            line,
            verdicts,
            domain,
            dict(known),
            budget.part(OUTSIDE),
        )
    except Exhausted:
        sample = outside = None
    if outside is None or sample is None:
        return None, "no family of counterexamples outside the range"
    try:
        inside, failure = proofs_inside(statement, statements, known, budget)
    except Exhausted:
        return None, "the budget ran out"
    return (None, failure) if inside is None else ([inside, outside, sample], "")


def proofs_inside(
    statement: checker.Statement,
    statements: Sequence[checker.Statement],
    known: Mapping[str, checker.Statement],
    budget: Budget,
) -> tuple[dict[str, Any] | None, str]:
    """({name: proof}, "") where the condition holds, or (None, which proof is missing)."""
    (domain,), (condition,) = statement.get("domain"), statement.get("holds")
    inside: dict[str, Any] = {}
    for each in statements:
        proof = None
        for effort, part in ((1, min(FIRST, budget.left // 3)), (2, budget.left)):
            try:
                proof = proof or search_proof(
                    each, dict(known), budget.part(part), sharp=[domain, condition], effort=effort
                )
            except Exhausted:
                if effort == 2:
                    raise
        if proof is None:
            return None, f"no proof of {each.name} inside the range"
        inside[each.name] = proof
    return inside, ""


def whole_parameters(
    over: Sequence[str], statements: Sequence[checker.Statement]
) -> frozenset[str]:
    """The parameters that the statements say to be integers."""
    return frozenset(
        p for p in over if any(p in line for each in statements for line in each.get("integer"))
    )


def outside_state(
    statement: checker.Statement, statements: Sequence[checker.Statement]
) -> checker.State:
    """The state that assumes the domain and not the condition."""
    (over,), (domain,), (condition,) = (
        statement.get(keyword) for keyword in ("over", "domain", "holds")
    )
    state: checker.State = checker.State(checker.Context())
    for parameter in over:
        state.context.declare(parameter, parameter in whole_parameters(over, statements))
    state.assume(state.context.formula(domain))
    state.assume(checker.negate(state.context.formula(condition)))
    return state


def sample_of(
    statement: checker.Statement, statements: Sequence[checker.Statement], budget: Budget
) -> dict[str, str] | None:
    """A simple point of the domain."""
    (over,), (domain,) = statement.get("over"), statement.get("domain")
    context = checker.Context()
    for parameter in over:
        context.declare(parameter)
    condition = Condition.of(context, context.formula(domain))
    for assignment in Sampler(
        budget, whole_parameters(over, statements), width=8, nodes=400
    ).search(condition, over):
        return {name: str(fraction(assignment.values[name][0])) for name in over}
    return None


def _outside(
    state: checker.State,
    named: Mapping[str, checker.Statement],
    parameter: str,
    line: Line,
    verdicts: Mapping[str, Sequence[bool]],
    domain: Any,
    known: dict[str, checker.Statement],
    budget: Budget,
) -> Node | None:
    base = {parameter: state.context.values[parameter]}
    failing = [k for k, verdict in enumerate(line.verdicts) if not verdict]
    if not failing:
        node = search_closing(state, known, budget, 2)
        return None if node is None else ["empty", node]
    whole = [name for name in sorted(named) if not any(verdicts[name][k] for k in failing)]
    for name in whole:
        task = Task(named[name], "counterexample", base, known, budget, [domain])
        found = cover(task, state, base_samples(state, budget), depth=4)
        if found is not None:
            return found
    cut = _cut(line, failing, verdicts, parameter, domain)
    if cut is None:
        return None
    text, pieces = cut
    founds = []
    for branch, piece in zip(state.by_sign(text), pieces):
        part = Line(
            line.numbers,
            tuple(verdict or k not in piece for k, verdict in enumerate(line.verdicts)),
        )
        found = _outside(branch, named, parameter, part, verdicts, domain, known, budget)
        if found is None:
            return None
        founds.append(found)
    return ["sign", text, *founds]


def _cut(
    line: Line,
    failing: Sequence[int],
    verdicts: Mapping[str, Sequence[bool]],
    parameter: str,
    domain: Any,
) -> tuple[str, list[set[int]]] | None:
    """A polynomial of degree 1 or that of a number, and which cells and numbers lie below, on and
    above its sign change.
    """
    cells = set(range(len(line.verdicts)))
    gaps = [k for k in cells if failing[0] < k < failing[-1] and line.verdicts[k]]
    opened = [k for k in gaps if k % 2 == 0]
    if opened:
        # A rational inside an open cell on which all statements hold.
        k = opened[len(opened) // 2]
        value = simplest_between(line.numbers[k // 2 - 1]._high, line.numbers[k // 2]._low)
        text = (
            f"{int(value.q)}*{parameter} - {int(value.p)}"
            if value.q != 1
            else f"{parameter} - {int(value.p)}"
        )
        return text, [{i for i in cells if i < k}, set(), {i for i in cells if i > k}]
    changes = [k for k in failing if k % 2 and failing[0] < k < failing[-1]] or gaps
    if not changes:
        changes = [k for k in failing if k % 2] if len(failing) > 1 else []
    if not changes:
        return None
    k = changes[len(changes) // 2]
    number = line.numbers[k // 2]
    if not _separates(number, line, failing, ends_of(domain, parameter)):
        return None
    rising = number.sign_of(_derivative(number)) > 0
    below, above = {i for i in cells if i < k}, {i for i in cells if i > k}
    return number.polynomial_text(parameter), [
        below if rising else above,
        {k},
        above if rising else below,
    ]


def _separates(
    number: AlgebraicNumber,
    line: Line,
    failing: Sequence[int],
    ends: tuple[Fraction | None, Fraction | None],
) -> bool:
    """Whether the number's polynomial has no other root among the failing cells and numbers."""
    low = line.numbers[failing[0] // 2 - 1] if failing[0] >= 2 else ends[0]
    high = line.numbers[failing[-1] // 2] if failing[-1] // 2 < len(line.numbers) else ends[1]
    others = [r for r in real_roots(fmpq_poly(number.poly)) if r != number]
    return not any((low is None or low < r) and (high is None or r < high) for r in others)


def _derivative(number: AlgebraicNumber) -> Any:
    return fmpq_poly(number.poly).derivative()
