"""The lemmas of a stored statement in Coq, proved by its certificate; see `lemmas`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from juggleproof.certificates import checker
from juggleproof.coq_store.branch import Branch, Hint, Known
from juggleproof.coq_store.roots import only_root
from juggleproof.coq_store.rules import shown
from juggleproof.coq_store.text import (
    NotWritten,
    coq_name,
    lemma_name,
)
from juggleproof.coq_store.transfer import Form, Transfer
from juggleproof.coq_store.values import (
    Range,
    as_counterexample,
    as_point,
    as_witness,
    found,
)
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.states import SearchState


def lemmas(statement: checker.Statement, certificate: Certificate, known: Known) -> str:
    """The Coq lemmas of a statement that is certified or refuted, with their proofs; known: the
    statements before it.

    For a certified statement, `statement_NAME` says the same, and `statement_NAME_possible` says
    that its premises hold somewhere; for a refuted one, `statement_NAME_refuted` says that it is
    false.  For a rule on orbits there is a lemma for each premise, `statement_NAME_PREMISE`, and
    none for the conclusion.  Raises NotWritten if a part of the certificate is not written for Coq.
    """
    if "unknown" in certificate or not certificate:
        raise NotWritten("it has no certificate that settles it")
    try:
        if "refuted" in certificate:
            return _refuted(statement, certificate["refuted"], known)
        proof: Hint = certificate["certified"]
        if statement.kind == "universal":
            return certified(statement, proof, known) + _possible(
                lemma_name(statement.name), statement, certificate["point"], known
            )
        if statement.kind == "sharp":
            return _sharp(statement, proof, known)
        premises = checker.premises_of(statement, known)
        return "\n".join(certified(premises[name], proof[name], known) for name in premises)
    except NotWritten:
        raise
    except (checker.Rejected, LookupError, TypeError, ValueError) as problem:
        raise NotWritten(f"a part of its certificate is not understood: {problem}") from None


def _lemma(name: str, comment: str, text: str, rows: Sequence[str]) -> str:
    return (
        "\n".join([f"(* {comment} *)", f"Lemma {name} :", f"  {text}.", "Proof.", *rows, "Qed."])
        + "\n"
    )


def certified(statement: checker.Statement, proof: Hint, known: Known) -> str:
    """The lemma of a universal statement, with the proof of a certificate."""
    form = Form(statement)
    count = [0]
    branch = Branch(SearchState(form.unfolding.context), known, count)
    rows = _introduced(branch, form, {}, proof)
    return _lemma(lemma_name(statement.name), statement.name, form.text(), rows)


def _introduced(
    branch: Branch,
    form: Form,
    hypotheses: Mapping[int, str],
    proof: Hint,
    sharp: Range | None = None,
) -> list[str]:
    """The proof of a form in the branch; hypotheses: the names of premises that are known."""
    hypotheses = {**hypotheses, **{k: branch.fresh() for k in form.given}}
    names = [
        *map(coq_name, form.universal),
        *(branch.fresh() for _ in form.whole(form.universal)),
        *(hypotheses[k] for k in form.given),
    ]
    rows = [" ".join(["intros", *names]) + "."] if names else []
    way, steps, last = proof
    unfolding = form.unfolding
    waiting = list(zip(unfolding.obligations, steps, strict=True))
    for k, premise in enumerate([*unfolding.premises, True]):
        while waiting and waiting[0][0][0] == k:
            (_, denial), node = waiting.pop(0)
            is_given = k in hypotheses or k == len(unfolding.premises)
            name = branch.fresh()
            if is_given:
                rows += shown(branch, checker.negate(denial), denial, node, name)
            else:
                rows += shown(branch, premise, denial, node, name)
                hypotheses[k] = name
        if k < len(unfolding.premises):
            rows += branch.assume(premise, hypotheses[k])
    if way == "witness":
        return [*rows, *found(branch, last, as_witness(form, sharp))]
    goal, final = unfolding.goal(True), branch.fresh()
    return [*rows, *shown(branch, goal, unfolding.goal(False), last, final), f"exact {final}."]


def _possible(
    name: str,
    statement: checker.Statement,
    point: Hint,
    known: Known,
    sharp: Range | None = None,
) -> str:
    form = Form(statement, (), sharp)
    form.given = sorted({*form.given, *range(len(sharp or ()))})
    rows = found(Branch(SearchState(checker.Context()), known, [0]), point, as_point(form, sharp))
    return _lemma(
        f"{name}_possible", f"{statement.name}: its premises hold somewhere", form.possible(), rows
    )


def _refuted(statement: checker.Statement, values: Hint, known: Known) -> str:
    form = Form(statement)
    branch = Branch(SearchState(checker.Context()), known, [0])
    name = branch.fresh()
    leaf = as_counterexample({statement.name: form}, {statement.name: name}, (), None)
    rows = [f"intro {name}.", *found(branch, values, leaf)]
    return _lemma(
        f"{lemma_name(statement.name)}_refuted",
        f"{statement.name}: refuted",
        f"~ ({form.text()})",
        rows,
    )


def _sharp(statement: checker.Statement, certificate: Hint, known: Known) -> str:
    """The lemma that for all parameters in the domain: the condition <=> all statements hold."""
    inside, outside, points = certificate
    (names,), (over,) = statement.get("sharp"), statement.get("over")
    (domain,), (condition,) = statement.get("domain"), statement.get("holds")
    forms = {name: Form(known[name], over, [domain]) for name in names}
    integers = forms[names[0]].integers
    context = checker.Context()
    for parameter in over:
        context.declare(parameter, parameter in integers)
    count = [0]
    branch = Branch(SearchState(context), known, count)
    context = branch.state.context
    whole = [f"whole {coq_name(name)}" for name in over if name in integers]
    in_domain, holds, all_hold, fails = (branch.fresh() for _ in range(4))
    domain_formula = context.formula(domain)
    rows = [
        " ".join(["intros", *map(coq_name, over), *(branch.fresh() for _ in whole), in_domain])
        + ".",
        f"split; [intro {holds}|intro {all_hold}].",
        "{",
    ]
    outer = branch.copy()
    taken = outer.assume(domain_formula, in_domain)
    formula = outer.state.context.formula(condition)
    for k, name in enumerate(names):
        form = Form(known[name], over, [domain, condition])
        if form.text() != forms[name].text():
            raise NotWritten("the condition of a sharp range licenses what its domain does not")
        own = Branch(SearchState(form.unfolding.context), known, count)
        transfer = Transfer(own, branch.names, {p: own.state.context.values[p] for p in over})
        assumed = []
        for left, name_, right in (
            (domain_formula, in_domain, form.unfolding.premises[0]),
            (formula, holds, form.unfolding.premises[1]),
        ):
            assumed.append(own.fresh())
            same = transfer.same(left, right)
            transfer.rows.append(f"pose proof (proj1 {same} {name_}) as {assumed[-1]}.")
        if k + 1 < len(names):
            rows += ["split.", "{"]
        rows += transfer.rows
        rows += _introduced(own, form, dict(enumerate(assumed)), inside[name], [domain, condition])
        if k + 1 < len(names):
            rows.append("}")
    rows += ["}", *taken]
    holds_text, fails_text = outer.write(formula), outer.write(checker.negate(formula))
    rows += [
        f"destruct (ltac:(decided) : ({holds_text}) \\/ ({fails_text})) as [{holds}|{fails}];",
        f"  [exact {holds}|exfalso].",
        *outer.assume(checker.negate(formula), fails),
    ]
    proofs = {}
    for k, name in enumerate(names):
        proof = all_hold
        for _ in range(k):
            proof = f"(proj2 {proof})"
        proofs[name] = proof if k + 1 == len(names) else f"(proj1 {proof})"
    rows += found(outer, outside, as_counterexample(forms, proofs, over, [domain]))
    together = " /\\ ".join(f"({forms[name].text()})" for name in names)
    text = "\n  ".join(
        [
            f"forall ({' '.join(map(coq_name, over))} : R),",
            *(f"{one} ->" for one in whole),
            f"({branch.write(domain_formula)}) ->",
            f"(({holds_text}) <-> {together})",
        ]
    )
    own_name = lemma_name(statement.name)
    parts = [_lemma(own_name, statement.name, text, rows)]
    parts += [
        _possible(f"{own_name}_{k}", known[name], points[name], known, [domain])
        for k, name in enumerate(names, 1)
    ]
    for name, ends in statement.get("number"):
        poly, low, high = map(context.value, ends)
        comment = f"{statement.name}: {name} is the only root"
        parts.append(_lemma(f"{own_name}_{name}", comment, *only_root(poly, low, high)))
    return "\n".join(parts)
