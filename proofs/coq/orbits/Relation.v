(* The rules for orbits where several next states are possible: what they say of a map, they say of every execution of a relation.

   An execution is an orbit of the map `shift` on executions, whose coordinates are those of the first state: so the rules for
   maps apply, and their premises hold of `shift` where they hold of each pair of states.

   Defined:  execution, shift.
   Proved:   relation_descent     an execution is in the last stage when a map's orbit would be;
             relation_contraction, relation_stability, relation_convergence   it contracts as an orbit does, stays near, and converges;
             relation_lyapunov_stability, relation_lyapunov_attraction   likewise with a Lyapunov function;
             relation_fixed_point, relation_lyapunov_fixed_point   no other state comes after the point;
             stable_point_stays   an execution from a stable point stays at it;
             relation_attraction  what attracts from a set attracts from all that leads into it. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules Lyapunov.
Open Scope R_scope.

Section Executions.
  Context {State : Type}.
  Variables (next : State -> State -> Prop) (space : State -> Prop).
  Hypothesis space_invariant : forall s t, space s -> next s t -> space t.

  Definition execution (x : nat -> State) : Prop := forall n, next (x n) (x (S n)).
  Definition shift (x : nat -> State) : nat -> State := fun n => x (S n).
  (* An execution whose first state has a property. *)
  Definition from (P : State -> Prop) (x : nat -> State) : Prop := execution x /\ P (x O).

  Lemma shifted n : forall x k, iterate shift n x k = x (n + k)%nat.
  Proof. induction n as [|n IH]; intros x k; [reflexivity|]. change (iterate shift n x (S k) = x (S n + k)%nat). rewrite IH. f_equal. lia. Qed.

  Lemma first_shifted n x : iterate shift n x O = x n.
  Proof. rewrite shifted. f_equal. lia. Qed.

  Lemma execution_keeps (P : State -> Prop) : (forall s t, P s -> next s t -> P t) -> forall x n, execution x -> P (x O) -> P (x n).
  Proof. intros keeps x n runs first. induction n as [|n IH]; [exact first|]. exact (keeps _ _ IH (runs n)). Qed.

  Lemma execution_later n x : execution x -> execution (fun k => x (n + k)%nat).
  Proof. intros runs k. rewrite Nat.add_succ_r. apply runs. Qed.

  Lemma from_shifts (P : State -> Prop) : (forall s t, P s -> next s t -> P t) -> forall x, from P x -> from P (shift x).
  Proof. intros keeps x [runs first]. split; [intro n; apply runs|exact (keeps _ _ first (runs O))]. Qed.

  (* ------------------------------------------------------------ descent *)

  Section Descent.
    Variables (rank : State -> R) (stages : list (State -> Prop)).
    Hypothesis rank_nonnegative : forall s, space s -> 0 <= rank s.
    Hypothesis rank_falls : forall s t, space s -> next s t -> (exists k, stage stages k s) \/ rank t <= rank s - 1.
    Hypothesis stage_leads_on : forall k s t, (S k < length stages)%nat -> space s -> next s t -> stage stages k s -> stage stages (S k) t.
    Hypothesis last_stage_invariant : forall s t, space s -> next s t -> last_stage stages s -> last_stage stages t.

    Let first_in (A : State -> Prop) (x : nat -> State) : Prop := A (x O).
    Lemma stage_of_first k x : stage (map first_in stages) k x <-> stage stages k (x O).
    Proof.
      unfold stage. change (fun _ : nat -> State => False) with (first_in (fun _ => False)). rewrite map_nth. unfold first_in. tauto.
    Qed.

    Theorem relation_descent x n : execution x -> space (x O) -> rank (x O) + INR (length stages - 1) <= INR n -> last_stage stages (x n).
    Proof.
      intros runs inside late. rewrite <- first_shifted. apply (stage_of_first (length stages - 1)).
      rewrite <- (map_length first_in) at 1. apply (descent shift (from space) (fun y => rank (y O)) (map first_in stages)).
      - apply from_shifts, space_invariant.
      - intros y [_ there]. now apply rank_nonnegative.
      - intros y [runs_ there]. destruct (rank_falls _ _ there (runs_ O)) as [[k staged]|falls]; [left|now right].
        exists k. now apply stage_of_first.
      - intros k y less [runs_ there] staged. rewrite map_length in less. apply stage_of_first in staged. apply stage_of_first.
        exact (stage_leads_on k _ _ less there (runs_ O) staged).
      - intros y [runs_ there] last. unfold last_stage in *. rewrite map_length in *. apply stage_of_first in last. apply stage_of_first.
        exact (last_stage_invariant _ _ there (runs_ O) last).
      - now split.
      - now rewrite map_length.
    Qed.
  End Descent.

  (* ------------------------------------------------------------ a point *)

  Context {Index : Type}.
  Variables (coordinate : Index -> State -> R) (point : Index -> R).
  Let first (j : Index) (x : nat -> State) : R := coordinate j (x O).

  Definition executions_stable : Prop := forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
    forall x, execution x -> space (x O) -> (forall j, Rabs (coordinate j (x O) - point j) < delta) ->
    forall n j, Rabs (coordinate j (x n) - point j) < epsilon.
  Definition execution_converges (x : nat -> State) : Prop :=
    forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat -> forall j, Rabs (coordinate j (x n) - point j) < epsilon.

  Theorem stable_point_stays x : executions_stable -> execution x -> space (x O) -> (forall j, coordinate j (x O) = point j) ->
    forall n j, coordinate j (x n) = point j.
  Proof.
    intros stays runs inside there n j. destruct (Req_dec (coordinate j (x n) - point j) 0) as [zero|other]; [lra|]. apply Rabs_pos_lt in other.
    destruct (stays _ other) as (delta & positive & near).
    assert (less : Rabs (coordinate j (x n) - point j) < Rabs (coordinate j (x n) - point j)); [|lra].
    apply near; try assumption. intro i. now rewrite there, Rminus_diag_eq, Rabs_R0.
  Qed.

  Lemma converges_of_shift x : converges shift first point x <-> execution_converges x.
  Proof.
    split; intros tends epsilon positive; destruct (tends epsilon positive) as [N near]; exists N; intros n late j; specialize (near n late j);
      unfold first in *; rewrite first_shifted in *; exact near.
  Qed.

  Lemma stable_of_shift : stable shift first point (from space) -> executions_stable.
  Proof.
    intros stays epsilon positive. destruct (stays epsilon positive) as (delta & delta_positive & near). exists delta. split; [exact delta_positive|].
    intros x runs inside start n j. rewrite <- (first_shifted n). exact (near x (conj runs inside) start n j).
  Qed.

  Theorem relation_attraction (on : State -> Prop) :
    (forall x, execution x -> space (x O) -> exists N, on (x N)) -> (forall x, execution x -> on (x O) -> execution_converges x) ->
    forall x, execution x -> space (x O) -> execution_converges x.
  Proof.
    intros enters attracts x runs inside. apply converges_of_shift. destruct (enters x runs inside) as [N there].
    apply converges_later with (N := N). apply converges_of_shift, attracts.
    - intro n. rewrite !shifted. exact (execution_later N x runs n).
    - now rewrite first_shifted.
  Qed.

  Section Contraction.
    Variables (on : State -> Prop) (weight : Index -> R) (rate : R).
    Hypothesis on_invariant : forall s t, on s -> next s t -> on t.
    Hypothesis rate_nonnegative : 0 <= rate.
    Hypothesis contracts : forall c s t, 0 <= c -> on s -> next s t -> within coordinate point weight c s -> within coordinate point weight (rate * c) t.

    Lemma shift_contracts c x : 0 <= c -> from on x -> within first point weight c x -> within first point weight (rate * c) (shift x).
    Proof. intros positive [runs inside] near. exact (contracts c _ _ positive inside (runs O) near). Qed.

    Theorem relation_contraction n c x : 0 <= c -> execution x -> on (x O) ->
      within coordinate point weight c (x O) -> within coordinate point weight (rate ^ n * c) (x n).
    Proof.
      intros positive runs inside near. rewrite <- (first_shifted n).
      exact (contraction shift first point weight (from on) rate (from_shifts on on_invariant) rate_nonnegative shift_contracts
        n c x positive (conj runs inside) near).
    Qed.

    Theorem relation_fixed_point s t : on s -> next s t -> (forall j, coordinate j s = point j) -> forall j, coordinate j t = point j.
    Proof.
      intros inside moves there. apply (fixed_point (fun _ => t) coordinate point weight (eq s) rate) with (s := s); [|reflexivity|exact there].
      intros c _ positive <- near. exact (contracts c s t positive inside moves near).
    Qed.

    Variables (radius lowest highest : R).
    Hypothesis rate_below_1 : rate < 1.
    Hypothesis lowest_positive : 0 < lowest.
    Hypothesis weights_bounded : forall j, lowest <= weight j <= highest.
    Hypothesis radius_positive : 0 < radius.
    Hypothesis near_is_on : forall s, space s -> within coordinate point weight radius s -> on s.

    Theorem relation_stability : executions_stable.
    Proof.
      apply stable_of_shift. unfold stable.
      apply (stability shift first point weight (from on) rate (from_shifts on on_invariant) rate_nonnegative shift_contracts
        (from space) radius lowest highest rate_below_1 lowest_positive weights_bounded radius_positive).
      intros x [runs inside] near. split; [exact runs|now apply near_is_on].
    Qed.

    Variable size : R.
    Hypothesis size_nonnegative : 0 <= size.
    Hypothesis on_is_small : forall s, on s -> within coordinate point weight size s.

    Theorem relation_convergence x : execution x -> on (x O) -> execution_converges x.
    Proof.
      intros runs inside. apply converges_of_shift.
      apply (convergence shift first point weight (from on) rate (from_shifts on on_invariant) rate_nonnegative shift_contracts (from on)
        lowest highest rate_below_1 lowest_positive weights_bounded (fun _ => 0) (from on :: nil) size (from_shifts on on_invariant)).
      - intros. apply Rle_refl.
      - intros y there. left. now exists 0%nat.
      - intros k y less. cbn in less. lia.
      - intros y _. exact (from_shifts on on_invariant y).
      - trivial.
      - exact size_nonnegative.
      - intros y [_ there] _. exact (on_is_small _ there).
      - now split.
    Qed.
  End Contraction.

  Section Lyapunov.
    Variables (on : State -> Prop) (guard : nat -> State -> Prop) (term : nat -> State -> R) (count : nat).
    Variables (loss : State -> R -> R) (least : R -> R -> R) (upper radius : R).
    Hypothesis radius_positive : 0 < radius.
    Hypothesis upper_positive : 0 < upper.
    Hypothesis least_positive : forall distance level, 0 < distance -> 0 <= level -> 0 < least distance level.
    Hypothesis near_is_on : forall s, space s -> close coordinate point radius s -> on s.
    Hypothesis small : forall i s distance, (i < count)%nat -> space s -> 0 <= distance -> close coordinate point distance s ->
      distance <= radius -> guard i s -> term i s <= upper * distance.
    Hypothesis on_invariant : forall s t, on s -> next s t -> on t.
    Hypothesis bounded : forall s v, on s -> above guard term count s v -> 0 <= v.
    Hypothesis loss_nonnegative : forall s v, on s -> above guard term count s v -> 0 <= v -> 0 <= loss s v.
    Hypothesis loss_at_least : forall s v distance level, on s -> above guard term count s v -> 0 <= v -> 0 < distance -> 0 <= level ->
      far coordinate point distance s -> v <= level -> least distance level <= loss s v.
    Hypothesis falls : forall i s t v, (i < count)%nat -> on s -> next s t -> above guard term count s v -> 0 <= v -> guard i t ->
      term i t <= v - loss s v.

    Let guard_ i (x : nat -> State) := guard i (x O).
    Let term_ i (x : nat -> State) := term i (x O).
    Let loss_ (x : nat -> State) := loss (x O).

    Theorem relation_lyapunov_attraction x : execution x -> on (x O) -> execution_converges x.
    Proof.
      intros runs inside. apply converges_of_shift.
      apply (lyapunov_attraction shift first point (from on) guard_ term_ count loss_ least); try (now split); unfold guard_, term_, loss_.
      - exact least_positive.
      - exact (from_shifts on on_invariant).
      - intros y v [_ there]. now apply bounded.
      - intros y v [_ there]. now apply loss_nonnegative.
      - intros y v distance level [_ there]. now apply loss_at_least.
      - intros i y v less [runs_ there]. exact (falls i _ _ v less there (runs_ O)).
    Qed.

    Theorem relation_lyapunov_fixed_point s t u :
      space s -> (forall j, coordinate j s = point j) -> next s t -> next t u -> forall j, coordinate j t = point j.
    Proof.
      intros inside there moves on_ j. assert (near : close coordinate point 0 s).
      { intro i. rewrite there, Rminus_diag_eq, Rabs_R0 by reflexivity. lra. }
      assert (at_point : on s). { apply near_is_on; [exact inside|]. intro i. specialize (near i). lra. }
      assert (none : above guard term count s 0).
      { intros i less here. pose proof (small i s 0 less inside (Rle_refl 0) near (Rlt_le _ _ radius_positive) here). lra. }
      pose proof (on_invariant s t at_point moves) as after.
      assert (low : above guard term count t (0 - loss s 0)) by (intros i less here; apply falls with (s := s); trivial; lra).
      pose proof (loss_nonnegative s 0 at_point none (Rle_refl 0)). pose proof (bounded t _ after low).
      replace (0 - loss s 0) with 0 in low by lra.
      destruct (Req_dec (coordinate j t - point j) 0) as [zero|other]; [lra|]. apply Rabs_pos_lt in other.
      pose proof (least_positive _ 0 other (Rle_refl 0)).
      assert (least (Rabs (coordinate j t - point j)) 0 <= loss t 0).
      { apply loss_at_least; trivial; try lra. exists j. lra. }
      assert (lower : above guard term count u (0 - loss t 0)) by (intros i less here; apply falls with (s := t); trivial; lra).
      pose proof (bounded u _ (on_invariant t u after on_) lower). lra.
    Qed.

    Theorem relation_lyapunov_stability : executions_stable.
    Proof.
      apply stable_of_shift.
      apply (lyapunov_stability shift first point (from space) (from on) guard_ term_ count loss_ least upper radius);
        try assumption; unfold guard_, term_, loss_.
      - intros y [runs there] near. split; [exact runs|now apply near_is_on].
      - intros i y distance less [_ there]. exact (small i _ distance less there).
      - exact (from_shifts on on_invariant).
      - intros y v [_ there]. now apply bounded.
      - intros y v [_ there]. now apply loss_nonnegative.
      - intros y v distance level [_ there]. now apply loss_at_least.
      - intros i y v less [runs_ there]. exact (falls i _ _ v less there (runs_ O)).
    Qed.
  End Lyapunov.
End Executions.
