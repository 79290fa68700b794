"""Values found for variables: points, witnesses and counterexamples as tactics."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence

from juggleproof.certificates import checker
from juggleproof.coq_store.branch import Branch, Hint
from juggleproof.coq_store.rules import closed, shown, signs
from juggleproof.coq_store.text import (
    NotWritten,
    conjoined,
    conjunctive,
    coq_name,
    polynomial,
)
from juggleproof.coq_store.transfer import (
    Form,
    Numbers,
    Transfer,
    nonzero,
    premise_proofs,
    value_text,
)
from juggleproof.statements.nodes import Node

Range = Sequence[ast.expr]


def found(branch: Branch, values: Hint, leaf: Callable[..., list[str]]) -> list[str]:
    """The tactics for values that are found by cases; `leaf` writes one case."""
    if values[0] == "sign":
        first, cases = signs(branch, values[1])
        rows = [first]
        for (begin, rest), part in zip(cases, values[2:], strict=True):
            rows += ["{", *begin, *found(rest, part, leaf), "}"]
        return rows
    if values[0] == "empty":
        return ["exfalso.", *closed(branch, values[1])]
    name, adjoined, terms, *nodes = values
    branch = branch.copy()
    rows = []
    for entry in adjoined:
        rows += adjoin(branch, *entry)
    return [*rows, *leaf(branch, name, terms, *nodes)]


def adjoin(
    branch: Branch, name: str, text: str, low: str, high: str, below: Node, above: Node
) -> list[str]:
    """Adds a variable between two values at which a polynomial is 0 (intermediate value)."""
    context = branch.state.context
    tree, zero = checker.parse(text), context.number(0)
    ends = [context.value(checker.parse(end)) for end in (low, high)]
    first, second = (
        checker.Context(context, {**context.values, name: end}).value(tree) for end in ends
    )
    crossed = checker.join(
        "or", [context.atom(ends[0], ">", ends[1]), context.atom(first, ">", zero)]
    )
    rises = context.atom(second, "<", zero)
    before, after = branch.fresh(), branch.fresh()
    rows = shown(branch, checker.negate(crossed), crossed, below, before)
    rows += shown(branch, checker.negate(rises), rises, above, after)
    rows += nonzero(branch, {"low": ends[0], "high": ends[1]})
    inner = checker.Context(context)
    inner.declare(name)
    poly = inner.value(tree)
    if poly.under:
        raise NotWritten("an adjoined number is a root of a quotient")
    low_text, high_text = (value_text(branch, end) for end in ends)
    at_low, at_high, function = (
        polynomial(inner.index, poly, values={name: value})
        for value in (low_text, high_text, coq_name(name))
    )
    order, falls = (
        checker.negate(context.atom(ends[0], ">", ends[1])),
        checker.negate(context.atom(first, ">", zero)),
    )
    pieces = checker.conjuncts(checker.negate(crossed))
    parts = [before] if len(pieces) == 1 else [branch.fresh() for _ in pieces]
    if len(pieces) > 1:
        rows.append(f"destruct {before} as {conjunctive(parts)}.")
    whole = context.number(poly.den)
    transfer = Transfer(branch, {}, {})
    sides: list[str] = []
    for term, value, target in (
        (f"({high_text} - {low_text})", ends[1] - ends[0], order),
        (f"(- ({at_low}))", -(first * whole), falls),
        (f"({at_high})", second * whole, checker.negate(rises)),
    ):
        known = after if len(sides) == 2 else parts.pop(0) if target is not True else ""
        if isinstance(target, bool):
            known = branch.fresh()
            transfer.rows.append(f"assert ({known} : 0 <= {term}) by (clear; lra).")
            sides.append(known)
        else:
            sides.append(f"(proj2 {transfer.fact(term, value, target)} {known})")
    ranges = [branch.fresh() for _ in range(3)]
    own = coq_name(name)
    rows += [
        *transfer.rows,
        f"destruct (crossing (fun {own} => {function}) {low_text} {high_text}",
        f"  ltac:(continuous) {' '.join(sides)}) as ({' & '.join([own, *ranges])}).",
    ]
    context.declare(name)
    root = context.values[name]
    transfer = Transfer(branch, {}, {})
    for known, term, value, target in (
        (ranges[0], f"({own} - {low_text})", root - ends[0], context.atom(root, ">=", ends[0])),
        (ranges[1], f"({high_text} - {own})", ends[1] - root, context.atom(root, "<=", ends[1])),
        (ranges[2], f"({function})", poly * whole, context.atom(poly, "=", zero)),
    ):
        same, new = transfer.fact(term, value, target), branch.fresh()
        transfer.rows.append(f"pose proof (proj1 {same} {known}) as {new}.")
        transfer.rows += branch.assume(target, new)
    return [*rows, *transfer.rows]


# -------------------------------------------------------------------------------------------------
# The uses of values: points, witnesses and counterexamples.


def values_of(
    branch: Branch, terms: Mapping[str, str], base: Sequence[str]
) -> dict[str, checker.Poly]:
    """The value of each variable: a term, or for those of `base` the variable itself."""
    context = branch.state.context
    values = {key: context.value(checker.parse(text)) for key, text in terms.items()}
    return {**values, **{key: context.values[key] for key in base}}


def exhibited(
    transfer: Transfer, form: Form, names: Sequence[str], proofs: Sequence[str]
) -> list[str]:
    """Proves that variables exist, from what holds at their values."""
    facts = transfer.whole(form, names)
    rows = [f"exists {transfer.texts[name]}." for name in names]
    return [*transfer.rows, *rows, f"exact {conjoined([*facts, *proofs])}."]


def as_point(form: Form, sharp: Range | None = None) -> Callable[..., list[str]]:
    """The function that writes a point of a statement: its premises hold there."""

    def write(branch: Branch, name: str, terms: Mapping[str, str], node: Node) -> list[str]:
        values = values_of(branch, terms, ())
        context = checker.Context(branch.state.context, values)
        inner = checker.Unfolding(form.statement, context, sharp, False)
        rows, proofs, _ = _premises(branch, form, inner, values, node)
        transfer = Transfer(branch, form.names, values)
        return [*rows, *exhibited(transfer, form, form.universal, proofs)]

    return write


def _premises(
    branch: Branch, form: Form, inner: checker.Unfolding, values: Numbers, node: Node
) -> tuple[list[str], list[str], Branch]:
    """Tactics that show the premises, a proof of each, and the branch that assumes them."""
    together, holds, parts = checker.join("and", inner.premises), branch.fresh(), branch.fresh()
    rows = nonzero(branch, values)
    rows += shown(branch, together, checker.negate(together), node, holds)
    known = branch.copy()
    rows += [f"pose proof {holds} as {parts}.", *known.assume(together, parts)]
    more, proofs = premise_proofs(known, form, inner, holds, values)
    return [*rows, *more], proofs, known


def as_witness(form: Form, sharp: Range | None = None) -> Callable[..., list[str]]:
    """The function that writes a witness of a statement: its goals hold there."""

    def write(branch: Branch, name: str, terms: Mapping[str, str], node: Node) -> list[str]:
        values = values_of(branch, terms, form.unfolding.universal)
        context = checker.Context(branch.state.context, values)
        inner = checker.Unfolding(form.statement, context, sharp)
        goal, holds = inner.goal(True), branch.fresh()
        rows = nonzero(branch, values)
        rows += shown(branch, goal, checker.negate(goal), node, holds)
        transfer = Transfer(branch, form.names, values)
        proof = f"(proj2 {transfer.same(form.unfolding.goal(True), goal)} {holds})"
        return [*rows, *exhibited(transfer, form, form.existential, [proof])]

    return write


def as_counterexample(
    forms: Mapping[str, Form], all_hold: Mapping[str, str], base: Sequence[str], sharp: Range | None
) -> Callable[..., list[str]]:
    """The function that writes a counterexample to one of the statements; all_hold: a proof of
    each.
    """

    def write(
        branch: Branch, name: str, terms: Mapping[str, str], node: Node, fails: Node
    ) -> list[str]:
        form = forms[name]
        values = values_of(branch, terms, base)
        inner = checker.Unfolding(
            form.statement, checker.Context(branch.state.context, values), sharp
        )
        rows, proofs, known = _premises(branch, form, inner, values, node)
        rest = branch.copy(inner.context)
        values |= {key: inner.context.values[key] for key in form.existential}
        transfer = Transfer(known.copy(inner.context), form.names, values)
        same = transfer.same(form.unfolding.goal(True), inner.goal(True))
        terms_ = [transfer.texts[key] for key in form.universal]
        facts = transfer.whole(form, form.universal)
        shows, goal = branch.fresh(), branch.fresh()
        applied = " ".join([all_hold[name], *terms_, *facts, *proofs])
        rows.append(f"pose proof ({applied}) as {shows}.")
        if form.existential:
            parts = [transfer.texts[key] for key in form.existential]
            parts += [branch.fresh() for _ in form.whole(form.existential)]
            rows.append(f"destruct {shows} as ({' & '.join([*parts, shows])}).")
        rows += [*transfer.rows, f"pose proof (proj1 {same} {shows}) as {goal}."]
        return [*rows, *rest.assume(inner.goal(True), goal), *closed(rest, fails)]

    return write
