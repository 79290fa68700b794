(* The ranks of Ranks.v where several next states are possible.

   Proved:   relation_lexicographic_descent, relation_greatest_descent   an execution comes to the last stage as an orbit of a map does. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules Ranks Relation.
Open Scope R_scope.

Section Ranks.
  Context {State : Type}.
  Variables (next : State -> State -> Prop) (space : State -> Prop).
  Hypothesis space_invariant : forall s t, space s -> next s t -> space t.
  Local Notation execution := (execution next).
  Local Notation from := (from next).

  Variables (stages : list (State -> Prop)) (guard : nat -> State -> Prop) (term : nat -> nat -> State -> R) (count size : nat).
  Hypothesis rank_nonnegative : forall s v, space s -> above_rank guard term count size s v -> not_negative size v.
  Hypothesis rank_falls : forall s t v, space s -> next s t -> above_rank guard term count size s v -> (exists k, stage stages k s) \/
    exists c, (c < size)%nat /\ forall i, (i < count)%nat -> guard i t ->
      (forall b, (b < c)%nat -> term i b t <= v b) /\ term i c t <= v c - 1.
  Hypothesis stage_leads_on : forall k s t, (S k < length stages)%nat -> space s -> next s t -> stage stages k s -> stage stages (S k) t.
  Hypothesis last_stage_invariant : forall s t, space s -> next s t -> last_stage stages s -> last_stage stages t.

  Let stages_ := map (fun A (x : nat -> State) => A (x O)) stages.
  Let guard_ i (x : nat -> State) := guard i (x O).
  Let term_ i c (x : nat -> State) := term i c (x O).

  Lemma last_of_first x : last_stage stages_ x <-> last_stage stages (x O).
  Proof. unfold last_stage, stages_. rewrite map_length. apply (stage_of_first space). Qed.

  Lemma falls_of_first x v : from space x -> above_rank guard_ term_ count size x v -> (exists k, stage stages_ k x) \/
    exists c, (c < size)%nat /\ forall i, (i < count)%nat -> guard_ i (shift x) ->
      (forall b, (b < c)%nat -> term_ i b (shift x) <= v b) /\ term_ i c (shift x) <= v c - 1.
  Proof.
    intros [runs inside] high. destruct (rank_falls _ _ v inside (runs O) high) as [[k staged]|falls]; [left|now right].
    exists k. now apply (stage_of_first space).
  Qed.

  Lemma leads_of_first k x : (S k < length stages_)%nat -> from space x -> stage stages_ k x -> stage stages_ (S k) (shift x).
  Proof.
    intros less [runs inside] staged. unfold stages_ in less. rewrite map_length in less. apply (stage_of_first space) in staged.
    apply (stage_of_first space). exact (stage_leads_on k _ _ less inside (runs O) staged).
  Qed.

  Lemma keeps_last x : from space x -> last_stage stages_ x -> last_stage stages_ (shift x).
  Proof. intros [runs inside] last. apply last_of_first. apply last_of_first in last. exact (last_stage_invariant _ _ inside (runs O) last). Qed.

  Lemma positive_of_first x v : from space x -> above_rank guard_ term_ count size x v -> not_negative size v.
  Proof. intros [_ inside]. exact (rank_nonnegative _ v inside). Qed.

  Theorem relation_lexicographic_descent x : execution x -> space (x O) -> exists N, forall n, (N <= n)%nat -> last_stage stages (x n).
  Proof.
    intros runs inside.
    destruct (lexicographic_descent shift (from space) stages_ guard_ term_ count size (from_shifts next space space_invariant) positive_of_first
      falls_of_first leads_of_first keeps_last x (conj runs inside)) as [N late].
    exists N. intros n later. rewrite <- first_shifted. now apply last_of_first, late.
  Qed.

  Theorem relation_greatest_descent x v n : size = 1%nat -> execution x -> space (x O) -> above_rank guard term count size (x O) v ->
    v O + INR (length stages - 1) <= INR n -> last_stage stages (x n).
  Proof.
    intros one runs inside high late. rewrite <- first_shifted. apply last_of_first.
    apply (greatest_descent shift (from space) stages_ guard_ term_ count size (from_shifts next space space_invariant) positive_of_first
      falls_of_first leads_of_first keeps_last one x v n (conj runs inside) high). unfold stages_. now rewrite map_length.
  Qed.
End Ranks.
