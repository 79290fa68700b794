"""The checker's polynomials and formulas as Coq text over the reals, with integer coefficients
only.
"""

from __future__ import annotations

from fractions import Fraction
from math import lcm
from typing import Any

from certificates import checker

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


def polynomial(names: dict[str, int], poly: Any, factor: int = 1) -> str:
    """The numerator of a polynomial, its integer coefficients times the factor, as a sum of
    monomials.
    """
    rows = []
    for packed in sorted(poly.terms, reverse=True):
        coefficient = poly.terms[packed] * factor
        exponents = [
            (name, (packed >> (checker.BITS * i)) % (1 << checker.BITS))
            for name, i in names.items()
        ]
        powers = [
            coq_name(name) if e == 1 else f"{coq_name(name)} ^ {e}" for name, e in exponents if e
        ]
        size = [] if abs(coefficient) == 1 and powers else [str(abs(coefficient))]
        rows.append(("- " if coefficient < 0 else "+ ") + " * ".join([*size, *powers]))
    return " ".join(rows).removeprefix("+ ") or "0"


def proposition(names: dict[str, int], formula: Any) -> str:
    """A formula of the checker; each polynomial stands for itself times its denominator, which is
    positive.
    """
    if isinstance(formula, bool):
        return str(formula)
    if formula[0] == "atom":
        text = polynomial(names, formula[1])
        return {">": f"0 < {text}", ">=": f"0 <= {text}", "=": f"{text} = 0", "!=": f"{text} <> 0"}[
            formula[2]
        ]
    parts = [proposition(names, part) for part in formula[1]]
    enclosed = [
        part if inner[0] == "atom" else f"({part})" for part, inner in zip(parts, formula[1])
    ]
    return (" /\\ " if formula[0] == "and" else " \\/ ").join(enclosed)


def common_factor(numbers: list[Fraction]) -> int:
    """The least positive integer that makes all the numbers whole."""
    return lcm(1, *(number.denominator for number in numbers))
