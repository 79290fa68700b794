"""Certified statements as lemmas of Coq, each proved by its certificate; see `lemma`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import lcm

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.polynomials import monomials
from juggleproof.certificates.formulas import ClaimError
from juggleproof.certificates.nodes import Certificate, Cofactor, Node, Power, Product

# -------------------------------------------------------------------------------------------------
# The checker's polynomials and formulas as Coq text over the reals, with integer coefficients
# only.

# Words that Coq keeps for itself or that the written proofs use: a variable of such a name gets an
# underscore.
TAKEN = frozenset(
    "as at cofix else end exists exists2 fix for forall fun if IF in let match mod return Set"
    " Prop SProp Type then using where with by R IZR pow whole wholly True False I eq_refl"
    " decided".split()
)

PRELUDE = """\
(* Written by juggleproof from stored certificates. Each lemma is the polynomial form of a
   statement, denominators cleared as its strict lines allow and every constant factor dropped, and
   is proved by its certificate: products of what is known to be positive are positive, and their
   sum is 0 by ring. *)

From Coq Require Import Reals Lra Lia ZArith.
Open Scope R_scope.

Lemma strict_and_zero a b : 0 < a -> b = 0 -> 0 < a + b. Proof. lra. Qed.
Lemma zero_times m p : p = 0 -> m * p = 0. Proof. intros ->. ring. Qed.
Lemma square_of_nonzero p : p <> 0 -> 0 < p ^ 2.
Proof. intro apart. rewrite <- Rsqr_pow2. now apply Rlt_0_sqr. Qed.
Lemma no_positive_zero s : 0 < s -> s = 0 -> False. Proof. lra. Qed.
Lemma by_sign p q : q = - p -> 0 < q \\/ p = 0 \\/ 0 < p.
Proof. intros ->. destruct (total_order_T p 0) as [[]|]; lra. Qed.
Lemma dec_gt p q : q = - p -> 0 < p \\/ 0 <= q.
Proof. intros ->. destruct (Rlt_le_dec 0 p); lra. Qed.
Lemma dec_ge p q : q = - p -> 0 <= p \\/ 0 < q.
Proof. intros ->. destruct (Rlt_le_dec p 0); lra. Qed.
Lemma dec_eq p : p = 0 \\/ p <> 0. Proof. destruct (total_order_T p 0) as [[]|]; lra. Qed.
Lemma dec_ne p : p <> 0 \\/ p = 0. Proof. destruct (total_order_T p 0) as [[]|]; lra. Qed.
Lemma dec_and (A B C D : Prop) : A \\/ C -> B \\/ D -> (A /\\ B) \\/ (C \\/ D). Proof. tauto. Qed.
Lemma dec_or (A B C D : Prop) : A \\/ C -> B \\/ D -> (A \\/ B) \\/ (C /\\ D). Proof. tauto. Qed.

(* An integer among the reals; what is more than 0 there is at least 1. *)
Definition whole (p : R) : Prop := exists n : Z, p = IZR n.
Lemma whole_constant n : whole (IZR n). Proof. now exists n. Qed.
Lemma whole_sum p q : whole p -> whole q -> whole (p + q).
Proof. intros [m ->] [n ->]. exists (m + n)%Z. now rewrite plus_IZR. Qed.
Lemma whole_difference p q : whole p -> whole q -> whole (p - q).
Proof. intros [m ->] [n ->]. exists (m - n)%Z. now rewrite minus_IZR. Qed.
Lemma whole_product p q : whole p -> whole q -> whole (p * q).
Proof. intros [m ->] [n ->]. exists (m * n)%Z. now rewrite mult_IZR. Qed.
Lemma whole_opposite p : whole p -> whole (- p).
Proof. intros [n ->]. exists (- n)%Z. now rewrite opp_IZR. Qed.
Lemma whole_power p k : whole p -> whole (p ^ k).
Proof. intro is_whole. induction k; [apply (whole_constant 1)|now apply whole_product]. Qed.
Lemma at_least_one p q : whole p -> q = p - 1 -> 0 < p -> 0 <= q.
Proof. intros [n ->] -> positive. apply lt_IZR in positive.
  assert (least : (1 <= n)%Z) by lia. apply IZR_le in least. lra. Qed.
Ltac wholly := repeat (
  assumption || apply whole_constant || apply whole_sum || apply whole_difference
  || apply whole_product || apply whole_opposite || apply whole_power).

(* A formula or its negation, atom by atom. *)
Ltac decided := lazymatch goal with
  | |- True \\/ _ => left; exact I
  | |- False \\/ _ => right; exact I
  | |- (_ /\\ _) \\/ _ => apply dec_and; decided
  | |- (_ \\/ _) \\/ _ => apply dec_or; decided
  | |- 0 < _ \\/ _ => apply dec_gt; ring
  | |- 0 <= _ \\/ _ => apply dec_ge; ring
  | |- _ = 0 \\/ _ => apply dec_eq
  | |- _ <> 0 \\/ _ => apply dec_ne
  end.
"""


def coq_name(name: str) -> str:
    """The name of a variable; names of hypotheses in the written proofs start with `of_`, which no
    variable then does.
    """
    return name + "_" if name in TAKEN or name.startswith("of_") else name


def polynomial(names: Mapping[str, int], poly: checker.Poly, factor: int = 1) -> str:
    """The numerator of a polynomial, its integer coefficients times the factor, as a sum of
    monomials, lexicographically from the largest down, where the last variable counts most;
    `names` gives the number of each variable.
    """
    rows = []
    terms = monomials(poly, len(names))
    for exponents in sorted(terms, key=lambda powers: powers[::-1], reverse=True):
        coefficient = terms[exponents] * factor
        powers = [
            coq_name(name) if exponents[i] == 1 else f"{coq_name(name)} ^ {exponents[i]}"
            for name, i in names.items()
            if exponents[i]
        ]
        size = [] if abs(coefficient) == 1 and powers else [str(abs(coefficient))]
        rows.append(("- " if coefficient < 0 else "+ ") + " * ".join([*size, *powers]))
    return " ".join(rows).removeprefix("+ ") or "0"


def proposition(names: Mapping[str, int], formula: checker.Formula) -> str:
    """A formula of the checker; each polynomial stands for itself times its denominator, which is
    positive.
    """
    if isinstance(formula, bool):
        return str(formula)
    if formula[0] == "atom":
        _, poly, relation = formula
        text = polynomial(names, poly)
        shapes = {">": f"0 < {text}", ">=": f"0 <= {text}", "=": f"{text} = 0"}
        return shapes.get(relation, f"{text} <> 0")
    parts = []
    for part in formula[1]:
        text = proposition(names, part)
        parts.append(text if isinstance(part, bool) or part[0] == "atom" else f"({text})")
    return (" /\\ " if formula[0] == "and" else " \\/ ").join(parts)


def common_factor(numbers: Iterable[Fraction]) -> int:
    """The least positive integer that makes all the numbers whole.

    >>> common_factor([Fraction(1, 4), Fraction(5, 6)])
    12
    """
    return lcm(1, *(number.denominator for number in numbers))


# -------------------------------------------------------------------------------------------------
# Certified statements as Coq lemmas, each proved by its certificate.

SUPPORTED = "psatz, cases, sign, close and integral"


@dataclass
class Branch:
    """A state of the checker beside the names of its hypotheses in Coq: facts as (polynomial,
    relation, hypothesis), disjunctions as (alternatives, hypothesis), both numbered as the checker
    has them, and a hypothesis that is false.
    """

    names: dict[str, int]
    facts: list[tuple[checker.Poly, str, str]] = field(default_factory=list)
    choices: list[tuple[Sequence[checker.Formula], str]] = field(default_factory=list)
    absurd: str = ""
    count: list[int] = field(default_factory=lambda: [0])

    def fresh(self) -> str:
        """A new name of a hypothesis."""
        self.count[0] += 1
        return f"of_{self.count[0]}"

    def copy(self) -> Branch:
        """The same state, to be changed on its own."""
        return Branch(self.names, list(self.facts), list(self.choices), self.absurd, self.count)

    def assume(self, formula: checker.Formula, name: str) -> list[str]:
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


def lemma(statement: checker.Statement, certificate: Certificate | None) -> str:
    """The Coq lemma of a certified statement without `exists`, with its proof.

    Raises ClaimError, one line, for any other statement, and where the certificate has a rule that
    is not written for Coq.
    """
    proof = (certificate or {}).get("certified")
    if (
        statement.kind != "universal"
        or sorted(certificate or {}) != ["certified", "point"]
        or not isinstance(proof, Sequence)
        or proof[0] != "proof"
    ):
        raise ClaimError(
            f"{statement.name}: only certified statements without `exists` are written for Coq, not"
            " sharp ranges or rules on orbits"
        )
    _, steps, last = proof
    unfolding = checker.Unfolding(statement, checker.Context())
    names = unfolding.context.index
    branch = Branch(names)
    derived = {
        count
        for (count, _), keyword in zip(unfolding.obligations, _obliging(statement))
        if keyword == "have"
    }
    given = [k for k in range(len(unfolding.premises)) if k not in derived]
    hypotheses = {k: branch.fresh() for k in given}
    whole = {
        coq_name(name): branch.fresh()
        for name in names
        if name in unfolding.context.integers and any(_rounds(node) for node in (*steps, last))
    }
    goal, denied = unfolding.goal(True), unfolding.goal(False)
    binder = f"forall ({' '.join(map(coq_name, names))} : R), " if names else ""
    rows = [
        f"(* {statement.name}{'' if whole else _over_the_reals(statement)} *)",
        f"Lemma {_lemma_name(statement.name)} :",
        f"  {binder}".rstrip(),
    ]
    rows += [f"  whole {name} ->" for name in whole]
    rows += [f"  ({proposition(names, unfolding.premises[k])}) ->" for k in given]
    introduced = [*map(coq_name, names), *whole.values(), *hypotheses.values()]
    rows += [
        f"  ({proposition(names, goal)}).",
        "Proof.",
        "  " + " ".join(["intros", *introduced]) + ".",
    ]
    waiting = list(zip(unfolding.obligations, steps, strict=True))
    for k in range(len(unfolding.premises) + 1):
        while waiting and waiting[0][0][0] == k:
            (_, denial), node = waiting.pop(0)
            shown = unfolding.premises[k] if k in derived else checker.negate(denial)
            name = branch.fresh()
            rows += _shown(branch, shown, denial, node, name, statement.name)
            if k in derived:
                hypotheses[k] = name
        if k < len(unfolding.premises):
            rows += branch.assume(unfolding.premises[k], hypotheses[k])
    final = branch.fresh()
    rows += [*_shown(branch, goal, denied, last, final, statement.name), f"exact {final}.", "Qed."]
    return "\n".join(rows) + "\n"


def _lemma_name(name: str) -> str:
    return "statement_" + re.sub(r"\W", "_", name)


def _over_the_reals(statement: checker.Statement) -> str:
    whole = [name for line in statement.get("integer") for name in line]
    return f", shown for all reals {', '.join(whole)}, not for integers only" if whole else ""


def _obliging(statement: checker.Statement) -> list[str]:
    """The keywords of the lines that have to be proved, in order."""
    return [keyword for keyword, _ in statement.lines if keyword in ("have", "root")]


def _shown(
    branch: Branch,
    shown: checker.Formula,
    denied: checker.Formula,
    node: Node,
    name: str,
    statement: str,
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


def _closed(branch: Branch, node: Node, statement: str) -> list[str]:
    if node[0] == "psatz":
        return _psatz(branch, *node[1:])
    if node[0] == "cases":
        return _cases(branch, statement, *node[1:])
    if node[0] == "sign":
        return _sign(branch, statement, *node[1:])
    if node[0] == "integral":
        return _integral(branch, statement, *node[1:])
    if node[0] == "close":
        return [f"exact {branch.absurd}."]
    raise ClaimError(
        f"{statement}: its certificate uses the rule {node[0]}; only {SUPPORTED} are written for"
        " Coq"
    )


def _cases(branch: Branch, statement: str, index: int, nodes: Sequence[Node]) -> list[str]:
    alternatives, name = branch.choices[index]
    parts = [branch.fresh() for _ in alternatives]
    rows = [f"destruct {name} as {_disjunctive(parts)}."]
    for part, alternative, node in zip(parts, alternatives, nodes, strict=True):
        rest = branch.copy()
        del rest.choices[index]
        rows += ["{", *rest.assume(alternative, part), *_closed(rest, node, statement), "}"]
    return rows


def _sign(branch: Branch, statement: str, text: str, *nodes: Node) -> list[str]:
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


def _integral(branch: Branch, statement: str, index: int, node: Node) -> list[str]:
    poly, _, name = branch.facts[index]
    if poly.den != 1:
        raise ClaimError(
            f"{statement}: its certificate rounds a polynomial with a denominator, which is not"
            " written for Coq"
        )
    formula = checker.fold(poly - checker.number(1, poly.work), ">=")
    stronger, rest = branch.fresh(), branch.copy()
    rows = [
        f"assert ({stronger} : {proposition(branch.names, formula)}).",
        (
            f"{{ apply (at_least_one ({polynomial(branch.names, poly)})); [wholly|ring|exact"
            f" {name}]. }}"
        ),
    ]
    return [*rows, *rest.assume(formula, stronger), *_closed(rest, node, statement)]


def _rounds(node: Node) -> bool:
    """Whether the rule `integral` is used in the proof."""
    if node[0] == "cases":
        return any(map(_rounds, node[2]))
    if node[0] == "sign":
        return any(map(_rounds, node[2:]))
    return node[0] == "integral"


def _psatz(branch: Branch, products: Sequence[Product], equations: Sequence[Cofactor]) -> list[str]:
    """The products' signs as one proof term, the sum's being 0 by ring; everything is multiplied
    until it is whole.
    """
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


Factors = list[tuple[str, bool]]  # a proof of the sign of each, and whether it is strict


def _product(
    branch: Branch, coefficient: str, factors: Sequence[Power], root: str
) -> tuple[Fraction, Factors, bool]:
    """The weight of a product of numerators, its factors, and whether all are strict."""
    weight, signs = Fraction(checker.rational(coefficient)), Factors()
    for index, exponent in factors:
        poly, relation, name = branch.facts[index]
        weight /= poly.den**exponent
        strict = relation in (">", "!=")
        if relation == "!=":
            name = f"(pow_lt _ {exponent // 2} (square_of_nonzero _ {name}))"
        elif exponent != 1:
            name = f"({'pow_lt' if strict else 'pow_le'} _ {exponent} {name})"
        signs.append((name, strict))
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


def _poly(branch: Branch, text: str) -> checker.Poly:
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
