"""The checker's polynomials and formulas as Coq text over the reals, with integer coefficients
only; and the text with which every exported file begins.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import lcm

from juggleproof.algebra.polynomials import monomials
from juggleproof.certificates import checker
from juggleproof.coq_store.sums import SUMS
from juggleproof.statements.formulas import ClaimError

Names = Mapping[str, int]  # {variable: its number}

PRELUDE = (
    """\
(* Written by juggleproof from stored certificates. Each lemma is the polynomial form of a
   statement, denominators cleared as its strict lines allow and every constant factor dropped, and
   is proved by its certificate: products of what is known to be positive are positive, and their
   sum is 0 by computation. *)

From Coq Require Import Reals Lra Lia ZArith List.
From Coq Require Ring_polynom InitialRing RealField.
Open Scope R_scope.

Lemma square_of_nonzero p : p <> 0 -> 0 < p ^ 2.
Proof. intro apart. rewrite <- Rsqr_pow2. now apply Rlt_0_sqr. Qed.
Lemma no_positive_zero s : 0 < s -> s = 0 -> False. Proof. lra. Qed.
Lemma by_sign p q : q = - p -> 0 < q \\/ p = 0 \\/ 0 < p.
Proof. intros ->. destruct (total_order_T p 0) as [[]|]; lra. Qed.
Lemma by_half p q : q = - p -> 0 <= q \\/ 0 <= p.
Proof. intros ->. destruct (Rle_lt_dec 0 p); lra. Qed.
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

(* A number between two others where a continuous function is 0. *)
Lemma continuous_power f n : continuity f -> continuity (fun x => f x ^ n).
Proof.
  intro continuous. induction n as [|n IH]; [now apply continuity_const|].
  exact (continuity_mult f _ continuous IH).
Qed.
Ltac continuous := lazymatch goal with
  | |- continuity (fun x => x) => exact (derivable_continuous _ derivable_id)
  | |- continuity (fun x => @?f x + @?g x) => apply (continuity_plus f g); continuous
  | |- continuity (fun x => @?f x - @?g x) => apply (continuity_minus f g); continuous
  | |- continuity (fun x => @?f x * @?g x) => apply (continuity_mult f g); continuous
  | |- continuity (fun x => - @?f x) => apply (continuity_opp f); continuous
  | |- continuity (fun x => @?f x ^ ?n) => apply (continuous_power f n); continuous
  | |- continuity (fun _ => ?c) => apply continuity_const; intros ? ?; reflexivity
  end.
Lemma crossing f low high :
  continuity f -> 0 <= high - low -> 0 <= - f low -> 0 <= f high ->
  exists z, 0 <= z - low /\\ 0 <= high - z /\\ f z = 0.
Proof.
  intros smooth order below above.
  destruct (IVT_cor f low high smooth) as (z & between & zero).
  - lra.
  - assert (0 <= - f low * f high) by now apply Rmult_le_pos.
    replace (f low * f high) with (- (- f low * f high)) by ring. lra.
  - exists z. repeat split; [lra|lra|exact zero].
Qed.

(* The same atom of a multiple, and the same formula with constants decided. *)
Lemma scale_gt m w p q : 0 < m -> 0 < w -> m * p = w * q -> (0 < p <-> 0 < q).
Proof.
  intros m_positive w_positive same. split; intro positive.
  - apply (Rmult_lt_reg_l w); [exact w_positive|]. rewrite <- same, Rmult_0_r.
    now apply Rmult_lt_0_compat.
  - apply (Rmult_lt_reg_l m); [exact m_positive|]. rewrite same, Rmult_0_r.
    now apply Rmult_lt_0_compat.
Qed.
Lemma scale_eq m w p q : m <> 0 -> w <> 0 -> m * p = w * q -> (p = 0 <-> q = 0).
Proof.
  intros m_apart w_apart same. split; intros ->; rewrite Rmult_0_r in same.
  - symmetry in same. apply Rmult_integral in same. tauto.
  - apply Rmult_integral in same. tauto.
Qed.
Lemma scale_ne m w p q : m <> 0 -> w <> 0 -> m * p = w * q -> (p <> 0 <-> q <> 0).
Proof. intros m_apart w_apart same. now rewrite (scale_eq m w p q). Qed.
Lemma scale_ge m w p q : 0 < m -> 0 < w -> m * p = w * q -> (0 <= p <-> 0 <= q).
Proof.
  intros m_positive w_positive same. split; intro signed.
  - apply (Rmult_le_reg_l w); [exact w_positive|]. rewrite <- same, Rmult_0_r.
    apply Rmult_le_pos; lra.
  - apply (Rmult_le_reg_l m); [exact m_positive|]. rewrite same, Rmult_0_r.
    apply Rmult_le_pos; lra.
Qed.
Lemma both (A B C D : Prop) : (A <-> C) -> (B <-> D) -> (A /\\ B <-> C /\\ D). Proof. tauto. Qed.
Lemma either (A B C D : Prop) : (A <-> C) -> (B <-> D) -> (A \\/ B <-> C \\/ D). Proof. tauto. Qed.
Ltac number t := lazymatch t with IZR _ => idtac | - IZR _ => idtac end.
Ltac of_number H := lazymatch type of H with
  | 0 < ?t => number t
  | 0 <= ?t => number t
  | ?t = 0 => number t
  | ?t <> 0 => number t
  end.
Ltac taken_apart H := lazymatch type of H with
  | _ /\\ _ =>
      let left := fresh "of_left" in let right := fresh "of_right" in
      destruct H as [left right]; taken_apart left; taken_apart right
  | _ \\/ _ => destruct H as [H|H]; taken_apart H
  | False => destruct H
  | _ => try (of_number H; exfalso; clear - H; lra)
  end.
Ltac put_together := lazymatch goal with
  | |- _ /\\ _ => split; put_together
  | |- _ \\/ _ => first [left; solve [put_together] | right; solve [put_together]]
  | |- True => exact I
  | |- _ => first [assumption | solve [clear; lra]]
  end.
Ltac equivalent := split; let taken := fresh "of_taken" in
  intro taken; taken_apart taken; put_together.

"""
    + SUMS
)

# Words that are no name in Coq: its keywords, and words that `intros` may begin with.
KEYWORDS = frozenset(
    "as at by cofix else end exists exists2 fix for forall fun if IF in let match mod return then"
    " until using where with Axiom CoFixpoint Definition Fixpoint Hypothesis Parameter Prop Set"
    " SProp Theorem Type Variable".split()
)


class NotWritten(ClaimError):
    """A certificate, or a part of it, that is not written for Coq; `reason` is the same for all
    certificates of its class.
    """

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


def coq_name(name: str) -> str:
    """The name of a variable: with a prime, which no other name of a written file has."""
    return name + "'"


def without_primes(text: str, beside: str = "") -> str:
    """A text in which variables have no prime, except those whose name without it is a word of Coq,
    or occurs in `beside` outside of comments.

    >>> without_primes("forall x' R' in' : R, 0 < x'", "forall x' R' in' : R, 0 < x'")
    "forall x R' in' : R, 0 < x"
    """
    taken = KEYWORDS | {*re.findall(r"[\w']+", re.sub(r"\(\*.*?\*\)", "", beside, flags=re.DOTALL))}
    return re.sub(
        r"\b([A-Za-z]\w*)'(?!\w)",
        lambda found: found[0] if found[1] in taken else found[1],
        text,
    )


def polynomial(
    names: Names,
    poly: checker.Poly,
    factor: int = 1,
    values: Mapping[str, str] | None = None,
    number: str = "",
) -> str:
    """The numerator of a polynomial, its integer coefficients times the factor, as a sum of
    monomials.  They are in lexicographic order from the largest down; the last variable counts
    most.  `names` gives the number of each variable, `values` texts that replace some variables,
    `number` the text before a number.
    """
    own = {name: coq_name(name) for name in names} | dict(values or {})
    rows = []
    terms = monomials(poly, len(names))
    for exponents in sorted(terms, key=lambda powers: powers[::-1], reverse=True):
        coefficient = terms[exponents] * factor
        powers = [
            own[name] if exponents[i] == 1 else f"{own[name]} ^ {exponents[i]}"
            for name, i in names.items()
            if exponents[i]
        ]
        size = [] if abs(coefficient) == 1 and powers else [f"{number}{numeral(abs(coefficient))}"]
        rows.append(("- " if coefficient < 0 else "+ ") + " * ".join([*size, *powers]))
    return " ".join(rows).removeprefix("+ ") or f"{number}0"


def numeral(number: int) -> str:
    """A whole number that is not negative.  A long one is in hexadecimal digits, which Coq reads in
    a time that grows with their number, not with its square.
    """
    return str(number) if number < 10**40 else hex(number)


def atom(text: str, relation: str) -> str:
    """An atom about a term that is written for Coq."""
    shapes = {">": f"0 < {text}", ">=": f"0 <= {text}", "=": f"{text} = 0"}
    return shapes.get(relation, f"{text} <> 0")


def proposition(
    names: Names, formula: checker.Formula, values: Mapping[str, str] | None = None
) -> str:
    """A formula of the checker; each polynomial stands for itself times its denominator, which is
    positive.
    """
    if isinstance(formula, bool):
        return str(formula)
    if formula[0] == "atom":
        return atom(polynomial(names, formula[1], values=values), formula[2])
    parts = []
    for part in formula[1]:
        text = proposition(names, part, values)
        parts.append(text if part[0] == "atom" else f"({text})")
    return (" /\\ " if formula[0] == "and" else " \\/ ").join(parts)


def common_factor(numbers: Iterable[Fraction]) -> int:
    """The least positive integer that makes all the numbers whole.

    >>> common_factor([Fraction(1, 4), Fraction(5, 6)])
    12
    """
    return lcm(1, *(number.denominator for number in numbers))


def conjunctive(parts: Sequence[str]) -> str:
    """The pattern that takes a conjunction apart."""
    return parts[0] if len(parts) == 1 else f"[{parts[0]} {conjunctive(parts[1:])}]"


def disjunctive(parts: Sequence[str]) -> str:
    """The pattern that takes a disjunction apart."""
    return parts[0] if len(parts) == 1 else f"[{parts[0]}|{disjunctive(parts[1:])}]"


def conjoined(proofs: Sequence[str]) -> str:
    """The proof of a conjunction from those of its parts."""
    return (
        "I"
        if not proofs
        else proofs[0]
        if len(proofs) == 1
        else f"(conj {proofs[0]} {conjoined(proofs[1:])})"
    )


def some(names: Sequence[str], parts: Sequence[str]) -> str:
    """The formula that values of these names exist for which all parts hold."""
    binder = f"exists ({' '.join(map(coq_name, names))} : R), " if names else ""
    text = " /\\ ".join(f"({part})" for part in parts) if len(parts) > 1 else "".join(parts)
    return binder + (text or "True")


def lemma_name(name: str) -> str:
    """The name of the lemma of a statement."""
    return "statement_" + re.sub(r"\W", "_", name)
