"""The proof rules as tactics: each replays its node."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from juggleproof.certificates import checker
from juggleproof.coq_store.boxes import boxes
from juggleproof.coq_store.branch import Branch
from juggleproof.coq_store.psatz import psatz
from juggleproof.coq_store.text import (
    NotWritten,
    coq_name,
    disjunctive,
    lemma_name,
    polynomial,
    some,
)
from juggleproof.coq_store.transfer import Form, Transfer, nonzero, premise_proofs
from juggleproof.statements.nodes import Node


def shown(
    branch: Branch, formula: checker.Formula, denied: checker.Formula, node: Node, name: str
) -> list[str]:
    """Proves a formula under this name by a node that closes the state of its negation."""
    inner, against = branch.copy(), branch.fresh()
    rows = [
        f"assert ({name} : {branch.write(formula)}).",
        "{",
        (
            f"destruct (ltac:(decided) : ({branch.write(formula)}) \\/ ({branch.write(denied)}))"
            f" as [{name}|{against}];"
        ),
        f"  [exact {name}|exfalso].",
    ]
    return [*rows, *inner.assume(denied, against), *closed(inner, node), "}"]


def closed(branch: Branch, node: Node) -> list[str]:
    """The tactics that show the goal False as the node closes the state."""
    if node[0] not in RULES:
        raise NotWritten(f"its certificate uses the rule {node[0]}, which is not written for Coq")
    return RULES[node[0]](branch, *node[1:])


def _close(branch: Branch) -> list[str]:
    # if nothing false is assumed, Coq has to say so
    return [f"destruct {branch.absurd}." if branch.absurd else "contradiction."]


def _cases(branch: Branch, index: int, nodes: Sequence[Node]) -> list[str]:
    alternatives, name = branch.state.choices[index], branch.choices[index]
    parts = [branch.fresh() for _ in alternatives]
    rows = [f"destruct {name} as {disjunctive(parts)}."]
    for part, alternative, node in zip(parts, alternatives, nodes, strict=True):
        rest = branch.copy()
        del rest.state.choices[index], rest.choices[index]
        rows += ["{", *rest.assume(alternative, part), *closed(rest, node), "}"]
    return rows


def signs(branch: Branch, text: str) -> tuple[str, list[tuple[list[str], Branch]]]:
    """The tactic that distinguishes p < 0, p = 0 and p > 0, and the beginning of each case."""
    poly = branch.poly(text)
    parts = [branch.fresh() for _ in range(3)]
    sides = f"({polynomial(branch.names, poly)}) ({polynomial(branch.names, -poly)})"
    cases = []
    for part, (p, relation) in zip(parts, ((-poly, ">"), (poly, "="), (poly, ">"))):
        rest = branch.copy()
        cases.append((rest.assume_number(checker.fold(p, relation), part), rest))
    return f"destruct (by_sign {sides} ltac:(ring)) as {disjunctive(parts)}.", cases


def _sign(branch: Branch, text: str, *nodes: Node) -> list[str]:
    first, cases = signs(branch, text)
    rows = [first]
    for (begin, rest), node in zip(cases, nodes, strict=True):
        rows += ["{", *begin, *closed(rest, node), "}"]
    return rows


def _integral(branch: Branch, index: int, node: Node) -> list[str]:
    poly, name = branch.state.facts[index][0], branch.facts[index]
    if poly.den != 1:
        raise NotWritten("its certificate rounds a polynomial with a denominator")
    formula = checker.fold(poly - checker.number(1, poly.work), ">=")
    stronger, rest = branch.fresh(), branch.copy()
    rows = [
        f"assert ({stronger} : {branch.write(formula)}).",
        (
            f"{{ apply (at_least_one ({polynomial(branch.names, poly)})); [wholly|ring|exact"
            f" {name}]. }}"
        ),
    ]
    return [*rows, *rest.assume(formula, stronger), *closed(rest, node)]


def _use(
    branch: Branch,
    name: str,
    arguments: Mapping[str, str],
    fresh: Mapping[str, str],
    node: Node,
) -> list[str]:
    """The instance of an earlier lemma: its premises fail, or its conclusion holds."""
    statement = branch.known[name]
    context = checker.Context(branch.state.context)
    values = {key: branch.state.context.value(checker.parse(t)) for key, t in arguments.items()}
    rows = nonzero(branch, values)
    form = Form(statement)
    names: dict[str, str] = {}  # in the branch, of the values that exist
    for key, new in sorted(fresh.items()):
        context.declare(new, key in form.integers)
        values[key] = context.values[new]
        names[key] = list(context.index)[-1]
    inner = checker.Unfolding(statement, checker.Context(context, values))
    together, goal = checker.join("and", inner.premises), inner.goal(True)
    instance = checker.join("or", [checker.negate(together), goal])
    rest = branch.copy(context)
    holds, fails, shows, own = (branch.fresh() for _ in range(4))
    variables = [coq_name(names[key]) for key in form.existential]
    integers = [coq_name(names[key]) for key in form.existential if key in form.integers]
    whole = [branch.fresh() for _ in integers]
    parts = [*(f"whole {integer}" for integer in integers), rest.write(instance)]
    claim = some([names[key] for key in form.existential], parts)
    inside = rest.copy()
    more, proofs = premise_proofs(inside, form, inner, holds, values)
    transfer = Transfer(inside, form.names, values)
    same = transfer.same(form.unfolding.goal(True), goal)
    terms = [transfer.texts[key] for key in form.universal]
    facts = transfer.whole(form, form.universal)
    applied = " ".join([lemma_name(name), *terms, *facts, *proofs])
    result = f"({' & '.join([*variables, *whole, shows])})" if variables else shows
    rows += [
        f"assert ({own} : {claim}).",
        "{",
        (
            f"destruct (ltac:(decided) : ({branch.write(together)}) \\/"
            f" ({branch.write(checker.negate(together))})) as [{holds}|{fails}]."
        ),
        "{",
        *more,
        f"pose proof ({applied}) as {shows}.",
        *([f"destruct {shows} as {result}."] if variables else []),
        *transfer.rows,
        f"pose proof (proj1 {same} {shows}) as {own}.",
        *(f"exists {variable}." for variable in variables),
        *("split; [assumption|]." for _ in whole),
        f"taken_apart {own}; put_together.",
        "}",
        *("exists 0." for _ in variables),
        *("split; [wholly|]." for _ in whole),
        f"taken_apart {fails}; put_together.",
        "}",
    ]
    if variables:
        rows.append(f"destruct {own} as ({' & '.join([*variables, *whole, own])}).")
    return [*rows, *rest.assume(instance, own), *closed(rest, node)]


RULES: dict[str, Callable[..., list[str]]] = {
    "close": _close,
    "psatz": psatz,
    "cases": _cases,
    "sign": _sign,
    "integral": _integral,
    "boxes": boxes,
    "use": _use,
}
