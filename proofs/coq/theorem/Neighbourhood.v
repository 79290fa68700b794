(* The map near its fixed point e_1, for every restitution 0 < alpha < 1.

   Defined:  local_rate, local_weight, local_radius: the neighbourhood of e_1 that is contracted.
   Proved:   e_1_is_fixed; impact_closed_form, f^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q) while only impacts happen;
             e_1_is_stable and e_1_attracts_its_neighbourhood for every 0 < alpha < 1. *)

From Coq Require Import Reals Lra.
From Juggleproof Require Import Rules Map.
Open Scope R_scope.

Definition local_rate (alpha : R) : R := (1 + alpha) / 2.
Definition local_weight (alpha : R) (j : bool) : R := if j then 2 * alpha / (1 - alpha) else 1.
Definition local_radius (alpha : R) : R := (1 - alpha) / (1 + alpha) ^ 2.

Section Local.
  Variable alpha : R.
  Hypothesis alpha_range : 0 < alpha < 1.
  Let ex := fst (e_1 alpha).
  Let ew := snd (e_1 alpha).

  Lemma ew_equation : ew * (1 + alpha) = 2.
  Proof. unfold ew, e_1. cbn [snd]. field. lra. Qed.

  Lemma ex_equation : ex * (1 + alpha) = alpha * ew.
  Proof. unfold ex, ew, e_1. cbn [fst snd]. field. lra. Qed.

  Lemma e_1_range : 0 < ex /\ ex < ew /\ ex < alpha * 2 /\ 1 < ew < 2.
  Proof.
    pose proof ew_equation as EW. pose proof ex_equation as EX.
    assert (below : ew < 2) by nra. assert (above : 1 < ew) by nra.
    assert (low : 0 < ex) by nra. repeat split; nra.
  Qed.

  Lemma impact_offset s :
    fst (impact alpha s) - ex = - alpha * ((fst s - ex) - (snd s - ew)) /\ snd (impact alpha s) - ew = - alpha * (snd s - ew).
  Proof. pose proof ew_equation. pose proof ex_equation. cbn [impact fst snd]. split; nra. Qed.

  Theorem e_1_is_fixed : H (e_1 alpha) /\ f alpha (e_1 alpha) = e_1 alpha.
  Proof.
    pose proof e_1_range as (low & order & _). split; [apply Rlt_le, low|].
    rewrite f_impact by exact order. destruct (impact_offset (e_1 alpha)) as [first second].
    fold ex ew in first, second. apply injective_projections; fold ex ew; lra.
  Qed.

  Theorem impact_closed_form (on : State -> Prop) :
    (forall s, on s -> fst s < snd s /\ on (f alpha s)) -> forall s, on s -> forall n,
    fst (iterate (f alpha) n s) - ex = (- alpha) ^ n * ((fst s - ex) - INR n * (snd s - ew)) /\
    snd (iterate (f alpha) n s) - ew = (- alpha) ^ n * (snd s - ew).
  Proof.
    intros invariant s inside n. induction n as [|n [first second]]; [cbn; lra|].
    assert (there : on (iterate (f alpha) n s)) by (apply iterate_keeps; [intros t within_; apply invariant, within_|exact inside]).
    change (iterate (f alpha) (S n) s) with (f alpha (iterate (f alpha) n s)).
    rewrite f_impact by apply invariant, there.
    destruct (impact_offset (iterate (f alpha) n s)) as [-> ->]. rewrite first, second, S_INR.
    change ((- alpha) ^ S n) with (- alpha * (- alpha) ^ n). split; ring.
  Qed.

  (* Within c of e_1 in the norm of the local weights. *)
  Let close := within coordinate (fun j => coordinate j (e_1 alpha)) (local_weight alpha).

  Lemma weights_positive : 0 < local_weight alpha true /\ 0 < local_weight alpha false.
  Proof. cbn [local_weight]. split; [apply Rdiv_lt_0_compat; lra|lra]. Qed.

  Lemma close_bounds c s : close c s -> - (c * local_weight alpha true) <= fst s - ex <= c * local_weight alpha true /\ - c <= snd s - ew <= c.
  Proof.
    intro near. pose proof (near true) as first. pose proof (near false) as second.
    cbn [coordinate] in first, second. fold ex in first. fold ew in second.
    cbn [local_weight] in second. rewrite Rmult_1_r in second.
    apply absolute_bounds in first. apply absolute_bounds in second. split; assumption.
  Qed.

  Lemma radius_positive : 0 < local_radius alpha.
  Proof. apply Rdiv_lt_0_compat; [lra|]. apply pow_lt. lra. Qed.

  (* Inside the radius every period has an impact. *)
  Lemma close_is_impact s : close (local_radius alpha) s -> 0 <= fst s < snd s.
  Proof.
    intro near. apply close_bounds in near.
    assert (reach : local_radius alpha * local_weight alpha true = ex) by (unfold local_radius, ex, e_1; cbn [local_weight fst]; field; lra).
    assert (gap : ew - ex - (local_radius alpha * local_weight alpha true + local_radius alpha) = (1 - alpha) / (1 + alpha) ^ 2).
    { unfold local_radius, ex, ew, e_1. cbn [local_weight fst snd]. field. lra. }
    pose proof radius_positive as positive. unfold local_radius in positive at 1. lra.
  Qed.

  Lemma impact_contracts c s : 0 <= c -> close c s -> close (local_rate alpha * c) (impact alpha s).
  Proof.
    intros positive near. apply close_bounds in near. destruct (impact_offset s) as [first second].
    set (weight := local_weight alpha true) in *.
    assert (balance : weight * (1 - alpha) = 2 * alpha) by (unfold weight; cbn [local_weight]; field; lra).
    assert (step : local_rate alpha * c * weight = alpha * (c * weight + c)).
    { replace (local_rate alpha * c * weight) with (alpha * c * weight + c * (weight * (1 - alpha)) / 2) by (unfold local_rate; field).
      rewrite balance. field. }
    intros [|]; cbn [coordinate]; apply Rabs_le; fold ex ew.
    - rewrite first. change (local_weight alpha true) with weight. rewrite step. nra.
    - rewrite second. cbn [local_weight]. unfold local_rate. nra.
  Qed.

  Lemma local_bounded j : Rmin (local_weight alpha true) 1 <= local_weight alpha j <= Rmax (local_weight alpha true) 1.
  Proof. destruct j; cbn [local_weight]; split; solve [apply Rmin_l|apply Rmin_r|apply Rmax_l|apply Rmax_r]. Qed.

  Lemma lowest_weight_positive : 0 < Rmin (local_weight alpha true) 1.
  Proof. apply Rmin_glb_lt; [apply weights_positive|lra]. Qed.

  Lemma rate_range : 0 <= local_rate alpha < 1.
  Proof. unfold local_rate. lra. Qed.

  Lemma f_contracts c s : 0 <= c -> close (local_radius alpha) s -> close c s -> close (local_rate alpha * c) (f alpha s).
  Proof.
    intros positive inside near. rewrite f_impact by now apply close_is_impact. now apply impact_contracts.
  Qed.

  Lemma neighbourhood_invariant s : close (local_radius alpha) s -> close (local_radius alpha) (f alpha s).
  Proof.
    intro inside. pose proof radius_positive. pose proof rate_range.
    apply (within_monotone coordinate (fun j => coordinate j (e_1 alpha)) (local_weight alpha) _ _ lowest_weight_positive local_bounded)
      with (local_rate alpha * local_radius alpha); [nra|].
    apply f_contracts; [lra|exact inside|exact inside].
  Qed.

  Theorem e_1_is_stable : stable H (f alpha) (e_1 alpha).
  Proof.
    apply stable_by_coordinates. intros epsilon positive.
    apply (stability (f alpha) coordinate (fun j => coordinate j (e_1 alpha)) (local_weight alpha) (close (local_radius alpha)) (local_rate alpha)
      neighbourhood_invariant (proj1 rate_range) f_contracts H (local_radius alpha) _ _ (proj2 rate_range)
      lowest_weight_positive local_bounded radius_positive (fun s _ near => near) epsilon positive).
  Qed.

  (* |x - ex| and |w - ew| within the radius times the weights: the orbit stays in H and comes near at the local rate. *)
  Theorem e_1_attracts_its_neighbourhood n s : close (local_radius alpha) s ->
    close (local_rate alpha ^ n * local_radius alpha) (iterate (f alpha) n s) /\ H (iterate (f alpha) n s).
  Proof.
    intro inside. split.
    - apply contraction with (on := close (local_radius alpha)); try assumption.
      + exact neighbourhood_invariant.
      + apply rate_range.
      + exact f_contracts.
      + apply Rlt_le, radius_positive.
    - apply (iterate_keeps (f alpha) _ neighbourhood_invariant n s) in inside. apply close_is_impact in inside. unfold H. lra.
  Qed.
End Local.
