(* Stability and attraction do not depend on the units.

   Proved:   transfer_stable, transfer_attracting: if h carries map to other, and neither stretches nor shrinks distances by more than a
             factor, then what holds of other at h e holds of map at e. *)

From Coq Require Import Reals Lra.
From Juggleproof Require Import Rules Map.
Open Scope R_scope.

Section Transfer.
  Variables (h map other : State -> State) (space image : State -> Prop) (e : State) (stretch shrink : R).
  Hypothesis stretch_positive : 0 < stretch.
  Hypothesis shrink_positive : 0 < shrink.
  Hypothesis carries : forall s, h (map s) = other (h s).
  Hypothesis into : forall s, space s -> image (h s).
  Hypothesis stretches : forall s, dist (h s) (h e) <= stretch * dist s e.
  Hypothesis shrinks : forall s, dist s e <= shrink * dist (h s) (h e).

  Lemma carries_iterates n s : h (iterate map n s) = iterate other n (h s).
  Proof.
    induction n as [|n IH]; [reflexivity|].
    change (h (map (iterate map n s)) = other (iterate other n (h s))). now rewrite carries, IH.
  Qed.

  Lemma near_after epsilon n s : dist (iterate other n (h s)) (h e) < epsilon / shrink -> dist (iterate map n s) e < epsilon.
  Proof.
    intro near. apply Rle_lt_trans with (1 := shrinks _). rewrite carries_iterates.
    replace epsilon with (shrink * (epsilon / shrink)) by (field; lra). now apply Rmult_lt_compat_l.
  Qed.

  Theorem transfer_stable : stable image other (h e) -> stable space map e.
  Proof.
    intros stays epsilon positive. destruct (stays (epsilon / shrink)) as (delta & delta_positive & near); [now apply Rdiv_lt_0_compat|].
    exists (delta / stretch). split; [now apply Rdiv_lt_0_compat|].
    intros s inside close n. apply near_after, near; [now apply into|].
    apply Rle_lt_trans with (1 := stretches s).
    replace delta with (stretch * (delta / stretch)) by (field; lra). now apply Rmult_lt_compat_l.
  Qed.

  Theorem transfer_attracting : attracting image other (h e) -> attracting space map e.
  Proof.
    intros tends s inside epsilon positive. destruct (tends (h s) (into s inside) (epsilon / shrink)) as [N near]; [now apply Rdiv_lt_0_compat|].
    exists N. intros n late. now apply near_after, near.
  Qed.
End Transfer.
