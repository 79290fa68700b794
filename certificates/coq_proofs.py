"""Certified statements as Coq lemmas, each proved by its certificate."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from certificates import checker
from certificates.coq_formulas import common_factor, coq_name, polynomial, proposition
from certificates.terms import ClaimError

SUPPORTED = "psatz, cases, sign, close and integral"


@dataclass
class Branch:
    """A state of the checker beside the names of its hypotheses in Coq."""

    names: dict[str, int]
    facts: list[tuple[Any, str, str]] = field(default_factory=list)
    choices: list[tuple[Any, str]] = field(default_factory=list)
    absurd: str = ""
    count: list[int] = field(default_factory=lambda: [0])

    def fresh(self) -> str:
        """A new name of a hypothesis."""
        self.count[0] += 1
        return f"of_{self.count[0]}"

    def copy(self) -> Branch:
        """The same state, to be changed on its own."""
        return Branch(self.names, list(self.facts), list(self.choices), self.absurd, self.count)

    def assume(self, formula: Any, name: str) -> list[str]:
        """Takes a hypothesis apart in the order of the checker; returns the tactics."""
        if isinstance(formula, bool):
            self.absurd = self.absurd or ("" if formula else name)
            return []
        if formula[0] == "atom":
            self.facts.append((formula[1], formula[2], name))
            return []
        if formula[0] == "or":
            self.choices.append((formula[1], name))
            return []
        parts = [self.fresh() for _ in formula[1]]
        rows = [f"destruct {name} as {_conjunctive(parts)}."]
        for part, inner in zip(parts, formula[1]):
            rows += self.assume(inner, part)
        return rows


def lemma(statement: Any, certificate: Any) -> str:
    """The Coq lemma of a certified statement without `exists`, with its proof; ClaimError where a
    rule is not written for Coq."""
    if (
        statement.kind != "universal"
        or sorted(certificate or {}) != ["certified", "point"]
        or certificate["certified"][0] != "proof"
    ):
        raise ClaimError(
            f"{statement.name}: only certified statements without `exists` are written for Coq, not"
            " sharp ranges or rules on orbits"
        )
    _, steps, last = certificate["certified"]
    story = checker.Unfolding(statement, checker.Context())
    names = story.context.index
    branch = Branch(names)
    derived = {
        count
        for (count, _), (keyword, _) in zip(story.obligations, _obliging(statement))
        if keyword == "have"
    }
    given = [k for k in range(len(story.premises)) if k not in derived]
    hypotheses = {k: branch.fresh() for k in given}
    whole = {
        coq_name(name): branch.fresh()
        for name in names
        if name in story.context.integers and _uses("integral", [steps, last])
    }
    goal, denied = story.goal(True), story.goal(False)
    binder = f"forall ({' '.join(map(coq_name, names))} : R), " if names else ""
    rows = [
        f"(* {statement.name}{'' if whole else _over_the_reals(statement)} *)",
        f"Lemma {_lemma_name(statement.name)} :",
        f"  {binder}".rstrip(),
    ]
    rows += [f"  whole {name} ->" for name in whole]
    rows += [f"  ({proposition(names, story.premises[k])}) ->" for k in given]
    introduced = [*map(coq_name, names), *whole.values(), *hypotheses.values()]
    rows += [
        f"  ({proposition(names, goal)}).",
        "Proof.",
        "  " + " ".join(["intros", *introduced]) + ".",
    ]
    waiting = list(zip(story.obligations, steps, strict=True))
    for k in range(len(story.premises) + 1):
        while waiting and waiting[0][0][0] == k:
            (_, denial), node = waiting.pop(0)
            shown = story.premises[k] if k in derived else checker.negate(denial)
            name = branch.fresh()
            rows += _shown(branch, shown, denial, node, name, statement.name)
            if k in derived:
                hypotheses[k] = name
        if k < len(story.premises):
            rows += branch.assume(story.premises[k], hypotheses[k])
    final = branch.fresh()
    rows += [*_shown(branch, goal, denied, last, final, statement.name), f"exact {final}.", "Qed."]
    return "\n".join(rows) + "\n"


def _lemma_name(name: str) -> str:
    return "statement_" + re.sub(r"\W", "_", name)


def _over_the_reals(statement: Any) -> str:
    whole = [name for line in statement.get("integer") for name in line]
    return f", shown for all reals {', '.join(whole)}, not for integers only" if whole else ""


def _obliging(statement: Any) -> list[tuple[str, Any]]:
    return [line for line in statement.lines if line[0] in ("have", "root")]


def _shown(
    branch: Branch, shown: Any, denied: Any, node: Any, name: str, statement: str
) -> list[str]:
    inner, against = branch.copy(), branch.fresh()
    rows = [
        f"assert ({name} : {proposition(branch.names, shown)}).",
        "{",
        (
            f"destruct (ltac:(decided) : ({proposition(branch.names, shown)}) \\/"
            f" ({proposition(branch.names, denied)})) as [{name}|{against}];"
        ),
        f"  [exact {name}|exfalso].",
    ]
    return [*rows, *inner.assume(denied, against), *_closed(inner, node, statement), "}"]


def _closed(branch: Branch, node: Any, statement: str) -> list[str]:
    rules: dict[str, Callable[..., list[str]]] = {
        "psatz": _psatz,
        "cases": _cases,
        "sign": _sign,
        "close": _close,
        "integral": _integral,
    }
    if node[0] not in rules:
        raise ClaimError(
            f"{statement}: its certificate uses the rule {node[0]}; only {SUPPORTED} are written"
            " for Coq"
        )
    return rules[node[0]](branch, statement, *node[1:])


def _close(branch: Branch, statement: str) -> list[str]:
    return [f"exact {branch.absurd}."]


def _cases(branch: Branch, statement: str, index: int, nodes: list[Any]) -> list[str]:
    alternatives, name = branch.choices[index]
    parts = [branch.fresh() for _ in alternatives]
    rows = [f"destruct {name} as {_disjunctive(parts)}."]
    for part, alternative, node in zip(parts, alternatives, nodes, strict=True):
        rest = branch.copy()
        del rest.choices[index]
        rows += ["{", *rest.assume(alternative, part), *_closed(rest, node, statement), "}"]
    return rows


def _sign(branch: Branch, statement: str, text: str, *nodes: Any) -> list[str]:
    poly = _poly(branch, text)
    parts = [branch.fresh() for _ in nodes]
    formulas = [
        checker.fold(p, relation) for p, relation in ((-poly, ">"), (poly, "="), (poly, ">"))
    ]
    if any(isinstance(formula, bool) for formula in formulas):
        raise ClaimError(
            f"{statement}: its certificate asks for the sign of a number, which is not written"
            " for Coq"
        )
    sides = f"({polynomial(branch.names, poly)}) ({polynomial(branch.names, -poly)})"
    rows = [f"destruct (by_sign {sides} ltac:(ring)) as {_disjunctive(parts)}."]
    for part, formula, node in zip(parts, formulas, nodes, strict=True):
        rest = branch.copy()
        rows += ["{", *rest.assume(formula, part), *_closed(rest, node, statement), "}"]
    return rows


def _integral(branch: Branch, statement: str, index: int, node: Any) -> list[str]:
    poly, _, name = branch.facts[index]
    if poly.den != 1:
        raise ClaimError(
            f"{statement}: its certificate rounds a polynomial with a denominator, which is not"
            " written for Coq"
        )
    formula, stronger, rest = (
        checker.fold(poly - checker.number(1, poly.work), ">="),
        branch.fresh(),
        branch.copy(),
    )
    rows = [
        f"assert ({stronger} : {proposition(branch.names, formula)}).",
        (
            f"{{ apply (at_least_one ({polynomial(branch.names, poly)})); [wholly|ring|exact"
            f" {name}]. }}"
        ),
    ]
    return [*rows, *rest.assume(formula, stronger), *_closed(rest, node, statement)]


def _uses(rule: str, node: Any) -> bool:
    return isinstance(node, list) and (
        node[:1] == [rule] or any(_uses(rule, part) for part in node)
    )


def _psatz(branch: Branch, statement: str, products: list[Any], equations: list[Any]) -> list[str]:
    """The products' signs as one proof term, the sum's being 0 by ring; everything is multiplied
    until it is whole."""
    weighed = [_product(branch, *product) for product in products]
    cofactors = [(branch.facts[index], _poly(branch, text)) for index, text in equations]
    shares = [Fraction(1, poly.den * cofactor.den) for (poly, _, _), cofactor in cofactors]
    scale = common_factor([weight for weight, _, _ in weighed] + shares)
    terms = sorted(
        ((int(weight * scale), factors, strict) for weight, factors, strict in weighed),
        key=lambda entry: not entry[2],
    )
    proof = _positive(*terms[0][:2])
    for weight, factors, _ in terms[1:]:
        proof = f"(Rplus_lt_le_0_compat _ _ {proof}\n  {_nonnegative(weight, factors)})"
    for ((_, _, name), cofactor), share in zip(cofactors, shares):
        proof = (
            f"(strict_and_zero _ _ {proof}\n  (zero_times"
            f" ({polynomial(branch.names, cofactor, int(share * scale))}) _ {name}))"
        )
    return [f"exact (no_positive_zero _ {proof}\n  ltac:(ring))."]


Factors = list[tuple[str, bool]]


def _product(
    branch: Branch, coefficient: Any, factors: list[Any], root: str
) -> tuple[Fraction, Factors, bool]:
    """The weight of a product of numerators, a proof of the sign of each (and whether it is
    strict), and whether all are strict."""
    weight, signs = Fraction(checker.rational(coefficient)), []
    for index, exponent in factors:
        poly, relation, name = branch.facts[index]
        weight /= poly.den**exponent
        if relation == "!=":
            signs.append((f"(pow_lt _ {exponent // 2} (square_of_nonzero _ {name}))", True))
        else:
            strict = relation == ">"
            signs.append(
                (
                    (
                        name
                        if exponent == 1
                        else f"({'pow_lt' if strict else 'pow_le'} _ {exponent} {name})"
                    ),
                    strict,
                )
            )
    square = _poly(branch, root)
    constant = square.constant()
    if constant:
        return weight * constant * constant, signs, all(strict for _, strict in signs)
    return (
        weight / square.den**2,
        [*signs, (f"(pow2_ge_0 ({polynomial(branch.names, square)}))", False)],
        False,
    )


def _positive(weight: int, factors: Factors) -> str:
    proof = f"(IZR_lt 0 {weight} eq_refl)"
    for name, _ in factors:
        proof = f"(Rmult_lt_0_compat _ _ {proof} {name})"
    return proof


def _nonnegative(weight: int, factors: Factors) -> str:
    proof = f"(IZR_le 0 {weight} ltac:(discriminate))"
    for name, strict in factors:
        proof = f"(Rmult_le_pos _ _ {proof} {f'(Rlt_le _ _ {name})' if strict else name})"
    return proof


def _poly(branch: Branch, text: str) -> Any:
    context = checker.Context()
    context.index = dict(branch.names)
    context.values = {key: checker.variable(i, context.work) for key, i in branch.names.items()}
    # A polynomial of a certificate divides by numbers only, except where a fact licenses more: such
    # a certificate is refused.
    try:
        return context.polynomial(text)
    except checker.Rejected as problem:
        raise ClaimError(f"a certificate's polynomial is not written for Coq: {problem}") from None


def _conjunctive(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else f"[{parts[0]} {_conjunctive(parts[1:])}]"


def _disjunctive(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else f"[{parts[0]}|{_disjunctive(parts[1:])}]"
