(* A formula as a statement writes it, beside the polynomial formulas of its certificate; what finitely many axes give.

   Defined:  reads (a formula, and what it and its negation are as polynomial formulas).
   Proved:   reads_lt, .., reads_iff   what is read of atoms and of formulas made of them;
             decide_.., for the tactic `decidable`: such a formula or its negation, as a map by pieces asks;
             `nonzero`, for what a quotient divides by;
             bounded_by, within_one, within_is, far_is   an absolute value by inequalities;
             sum_is, one_more   steps of premises around a point;
             bounds_of    finitely many positive numbers lie between two. *)

From Coq Require Import Reals Lra List.
Open Scope R_scope.

Definition reads (N P Q : Prop) : Prop := (N /\ P /\ ~ Q) \/ (~ N /\ ~ P /\ Q).

Lemma reads_holds N P Q : reads N P Q -> (N <-> P).
Proof. unfold reads. tauto. Qed.

Lemma reads_and A P Q B S T : reads A P Q -> reads B S T -> reads (A /\ B) (P /\ S) (Q \/ T).
Proof. unfold reads. tauto. Qed.
Lemma reads_or A P Q B S T : reads A P Q -> reads B S T -> reads (A \/ B) (P \/ S) (Q /\ T).
Proof. unfold reads. tauto. Qed.
Lemma reads_not A P Q : reads A P Q -> reads (~ A) Q P.
Proof. unfold reads. tauto. Qed.
Lemma reads_implies A P Q B S T : reads A P Q -> reads B S T -> reads (A -> B) (Q \/ S) (P /\ T).
Proof. unfold reads. tauto. Qed.
Lemma reads_iff A P Q B S T : reads A P Q -> reads B S T -> reads (A <-> B) ((Q \/ S) /\ (P \/ T)) ((P /\ T) \/ (Q /\ S)).
Proof. unfold reads. tauto. Qed.

Lemma reads_lt l r p q : (0 < r - l <-> 0 < p) -> q = - p -> reads (l < r) (0 < p) (0 <= q).
Proof.
  unfold reads. intros [forth back] ->. destruct (Rlt_le_dec 0 p) as [yes|no]; [left; apply back in yes as less|right]; repeat split; try lra.
  all: intro less; assert (0 < p) by (apply forth; lra); lra.
Qed.
Lemma reads_le l r p q : (0 <= r - l <-> 0 <= p) -> q = - p -> reads (l <= r) (0 <= p) (0 < q).
Proof.
  unfold reads. intros [forth back] ->. destruct (Rlt_le_dec p 0) as [no|yes]; [right|left; apply back in yes as less]; repeat split; try lra.
  all: intro less; assert (0 <= p) by (apply forth; lra); lra.
Qed.
Lemma reads_ge l r p q : (0 <= l - r <-> 0 <= p) -> q = - p -> reads (l >= r) (0 <= p) (0 < q).
Proof.
  intros same opposite. destruct (reads_le r l p q same opposite) as [(order & rest)|(order & rest)]; [left|right]; (split; [lra|exact rest]).
Qed.
Lemma reads_eq l r p : (l - r = 0 <-> p = 0) -> reads (l = r) (p = 0) (p <> 0).
Proof.
  unfold reads. intros [forth back]. destruct (Req_dec p 0) as [yes|no]; [left; apply back in yes as same|right]; repeat split; try lra; trivial.
  all: intro same; apply no, forth; lra.
Qed.
Lemma reads_ne l r p : (l - r <> 0 <-> p <> 0) -> reads (l <> r) (p <> 0) (p = 0).
Proof.
  intro same. apply reads_not, reads_eq. destruct same as [forth back]. destruct (Req_dec p 0), (Req_dec (l - r) 0); tauto.
Qed.

Lemma decide_and (A B : Prop) : {A} + {~ A} -> {B} + {~ B} -> {A /\ B} + {~ (A /\ B)}.
Proof. intros [|] [|]; (left; tauto) || (right; tauto). Qed.
Lemma decide_or (A B : Prop) : {A} + {~ A} -> {B} + {~ B} -> {A \/ B} + {~ (A \/ B)}.
Proof. intros [|] [|]; (left; tauto) || (right; tauto). Qed.
Lemma decide_not (A : Prop) : {A} + {~ A} -> {~ A} + {~ ~ A}.
Proof. intros [|]; (left; tauto) || (right; tauto). Qed.
Lemma decide_implies (A B : Prop) : {A} + {~ A} -> {B} + {~ B} -> {A -> B} + {~ (A -> B)}.
Proof. intros [|] [|]; (left; tauto) || (right; tauto). Qed.
Lemma decide_iff (A B : Prop) : {A} + {~ A} -> {B} + {~ B} -> {A <-> B} + {~ (A <-> B)}.
Proof. intros [|] [|]; (left; tauto) || (right; tauto). Qed.
Lemma decide_equal (l r : R) : {l = r} + {l <> r}.
Proof. destruct (total_order_T l r) as [[|]|]; (left; lra) || (right; lra). Qed.

Ltac decidable := lazymatch goal with
  | |- {_ /\ _} + {_} => apply decide_and; decidable
  | |- {_ \/ _} + {_} => apply decide_or; decidable
  | |- {_ <-> _} + {_} => apply decide_iff; decidable
  | |- {~ _} + {_} => apply decide_not; decidable
  | |- {_ <> _} + {_} => apply decide_not; decidable
  | |- {_ -> _} + {_} => apply decide_implies; decidable
  | |- {_ < _} + {_} => apply Rlt_dec
  | |- {_ <= _} + {_} => apply Rle_dec
  | |- {_ > _} + {_} => apply Rgt_dec
  | |- {_ >= _} + {_} => apply Rge_dec
  | |- {_ = _} + {_} => apply decide_equal
  end.

(* What `field` divides by is not 0. *)
Ltac nonzero := lazymatch goal with
  | |- _ /\ _ => split; nonzero
  | |- _ <> 0 => first [assumption | apply Rgt_not_eq; lra | apply Rlt_not_eq; lra
      | let zero := fresh in intro zero; match goal with apart : ?p <> 0 |- _ => apply apart; lra end
      | let zero := fresh in intro zero; nra]
  end.

Lemma bounded_by a c w : Rabs a <= c * w <-> - c * w <= a /\ a <= c * w.
Proof. unfold Rabs. destruct (Rcase_abs a); lra. Qed.

Lemma within_one a c : Rabs a <= c -> - c * 1 <= a /\ a <= c * 1.
Proof. unfold Rabs. destruct (Rcase_abs a); lra. Qed.
Lemma within_is a c : Rabs a <= c <-> - c <= a /\ a <= c.
Proof. unfold Rabs. destruct (Rcase_abs a); lra. Qed.
Lemma far_is a c : c <= Rabs a -> a >= c \/ a <= - c.
Proof. unfold Rabs. destruct (Rcase_abs a); lra. Qed.
Lemma sum_is a b : a = b + (a - b).
Proof. ring. Qed.
Lemma one_more a : 0 <= a -> 1 + a > 0.
Proof. lra. Qed.

Lemma bounds_of {Index : Type} (weight : Index -> R) (all : list Index) : (forall j, In j all) -> (forall j, 0 < weight j) ->
  exists low high, 0 < low /\ forall j, low <= weight j <= high.
Proof.
  intros every positive. enough (some : exists low high, 0 < low /\ forall j, In j all -> low <= weight j <= high).
  { destruct some as (low & high & least & between). exists low, high. split; [exact least|]. intro j. apply between, every. }
  clear every. induction all as [|i all (low & high & least & between)].
  - exists 1, 1. split; [lra|]. intros j [].
  - exists (Rmin (weight i) low), (Rmax (weight i) high). split; [now apply Rmin_glb_lt|].
    pose proof (Rmin_l (weight i) low). pose proof (Rmin_r (weight i) low).
    pose proof (Rmax_l (weight i) high). pose proof (Rmax_r (weight i) high).
    intros j [<-|inside]; [lra|]. destruct (between j inside). lra.
Qed.
