(* Rules.v for states that are lists of reals of one length, which is how a table of coordinates, weights and a point gives them.

   Defined:  near (a ball of a weighted sup norm on lists), tends.
   Proved:   lists_contraction, lists_stability, lists_approach, lists_convergence. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules.
Open Scope R_scope.

Section Lists.
  Variables (f : list R -> list R) (point weights : list R).
  Let size_of := length weights.

  Definition apart (j : nat) (s : list R) : R := Rabs (nth j s 0 - nth j point 0).
  Definition near (c : R) (s : list R) : Prop := forall j, (j < size_of)%nat -> apart j s <= c * nth j weights 0.
  Definition tends (s : list R) : Prop :=
    forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat -> forall j, (j < size_of)%nat -> apart j (iterate f n s) < epsilon.

  (* The coordinates 0, 1, .. of a list as an index type, so that the general rules apply. *)
  Let Index : Type := {j : nat | (j < size_of)%nat}.
  Let entry (j : Index) (s : list R) : R := nth (proj1_sig j) s 0.
  Let target (j : Index) : R := nth (proj1_sig j) point 0.
  Let weight (j : Index) : R := nth (proj1_sig j) weights 0.

  Lemma near_is_within c s : near c s <-> within entry target weight c s.
  Proof.
    split; [intros close [j less]; exact (close j less)|intros close j less; exact (close (exist _ j less))].
  Qed.

  Lemma positive_weights_are_bounded (ws : list R) : Forall (fun w => 0 < w) ws ->
    exists low high, 0 < low /\ forall j, (j < length ws)%nat -> low <= nth j ws 0 <= high.
  Proof.
    induction 1 as [|w ws positive _ (low & high & low_positive & bounded)].
    - exists 1, 1. split; [lra|]. intros j less. cbn in less. lia.
    - exists (Rmin w low), (Rmax w high). split; [now apply Rmin_glb_lt|].
      pose proof (Rmin_l w low). pose proof (Rmin_r w low). pose proof (Rmax_l w high). pose proof (Rmax_r w high).
      intros [|j] less; cbn in less |- *; [lra|]. destruct (bounded j); [lia|]. lra.
  Qed.

  Variables (on space : list R -> Prop) (rate radius size : R) (rank : list R -> R) (stages : list (list R -> Prop)).
  Hypothesis weights_positive : Forall (fun w => 0 < w) weights.
  Hypothesis on_invariant : forall s, on s -> on (f s).
  Hypothesis rate_between : 0 <= rate < 1.
  Hypothesis contracts : forall c s, 0 <= c -> on s -> near c s -> near (rate * c) (f s).

  Lemma contracts_within c s : 0 <= c -> on s -> within entry target weight c s -> within entry target weight (rate * c) (f s).
  Proof. intros positive inside close. apply near_is_within, contracts; [exact positive|exact inside|now apply near_is_within]. Qed.

  Theorem lists_contraction n c s : 0 <= c -> on s -> near c s -> near (rate ^ n * c) (iterate f n s).
  Proof.
    intros positive inside close. apply near_is_within.
    apply (contraction f entry target weight on rate on_invariant (proj1 rate_between) contracts_within n c s positive inside).
    now apply near_is_within.
  Qed.

  Theorem lists_stability : 0 < radius -> (forall s, space s -> near radius s -> on s) ->
    forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
    forall s, space s -> (forall j, (j < size_of)%nat -> apart j s < delta) ->
    forall n j, (j < size_of)%nat -> apart j (iterate f n s) < epsilon.
  Proof.
    intros positive near_is_on epsilon epsilon_positive.
    destruct (positive_weights_are_bounded weights weights_positive) as (low & high & low_positive & bounded).
    destruct (stability f entry target weight on rate on_invariant (proj1 rate_between) contracts_within space radius low high
      (proj2 rate_between) low_positive (fun j => bounded (proj1_sig j) (proj2_sig j)) positive) with (epsilon := epsilon)
      as (delta & delta_positive & stays); [|exact epsilon_positive|].
    { intros s inside close. apply near_is_on; [exact inside|now apply near_is_within]. }
    exists delta. split; [exact delta_positive|]. intros s inside close n j less.
    apply (stays s inside (fun i => close (proj1_sig i) (proj2_sig i)) n (exist _ j less)).
  Qed.

  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis rank_nonnegative : forall s, space s -> 0 <= rank s.
  Hypothesis rank_falls : forall s, space s -> (exists k, stage stages k s) \/ rank (f s) <= rank s - 1.
  Hypothesis stage_leads_on : forall k s, (S k < length stages)%nat -> space s -> stage stages k s -> stage stages (S k) (f s).
  Hypothesis last_stage_invariant : forall s, space s -> last_stage stages s -> last_stage stages (f s).
  Hypothesis last_stage_is_on : forall s, space s -> last_stage stages s -> on s.
  Hypothesis size_nonnegative : 0 <= size.
  Hypothesis last_stage_is_small : forall s, space s -> last_stage stages s -> near size s.

  Theorem lists_approach s n k :
    space s -> rank s + INR (length stages - 1) <= INR n -> near (rate ^ k * size) (iterate f (n + k) s).
  Proof.
    intros inside late. apply near_is_within.
    apply (approach f entry target weight on rate) with (space := space) (rank := rank) (stages := stages); try assumption.
    - apply rate_between.
    - exact contracts_within.
    - intros t there last. now apply near_is_within, last_stage_is_small.
  Qed.

  Theorem lists_convergence s : space s -> tends s.
  Proof.
    intros inside epsilon positive.
    destruct (positive_weights_are_bounded weights weights_positive) as (low & high & low_positive & bounded).
    destruct (convergence f entry target weight on rate) with
      (space := space) (lowest := low) (highest := high) (rank := rank) (stages := stages) (size := size) (s := s) (epsilon := epsilon)
      as [N limit]; try assumption; try apply rate_between.
    - exact contracts_within.
    - intros [j less]. exact (bounded j less).
    - intros t there last. now apply near_is_within, last_stage_is_small.
    - exists N. intros n late j less. exact (limit n late (exist _ j less)).
  Qed.
End Lists.
