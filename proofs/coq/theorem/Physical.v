(* The theorem in the paper's own units: state b = (beta, v), launch speed r of the table, gravity g.

   Defined:  period T = 2 r / g; height >= 0; strikes, inequality (7); f_1, f_2 and the map of both (equations 10, 12, 13); energy
             (equation 14), E_max (equation 34); e1; scaling x = beta / (r T), w = 1 - v / r.
   Proved:   scaling_bijective; conjugate, the map is f in other coordinates, for all r, g > 0; physical_bound; physical_global; physical_sharp;
             E_max_invariant, states of energy at most E_max keep that bound, for 0 < alpha < 1. *)

From Coq Require Import Reals Lra.
From Juggleproof Require Import Rules Map Neighbourhood Ranking GlobalStability Transfer.
Open Scope R_scope.

Definition height (b : State) : R := fst b.
Definition velocity (b : State) : R := snd b.
Definition period (r g : R) : R := 2 * r / g.

Definition above_ground (b : State) : Prop := 0 <= height b.
Definition strikes (r g : R) (b : State) : Prop := height b * g / 2 + r * velocity b < r ^ 2.
Definition f_1 (alpha r g : R) (b : State) : State :=
  ((2 * alpha * r ^ 2 - alpha * height b * g - 2 * alpha * r * velocity b) / g, alpha * r - alpha * velocity b - r).
Definition f_2 (r g : R) (b : State) : State :=
  ((height b * g + 2 * r * velocity b - 2 * r ^ 2) / g, velocity b - 2 * r).
Definition ball (alpha r g : R) (b : State) : State :=
  if Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2) then f_1 alpha r g b else f_2 r g b.

Definition e1 (alpha r g : R) : State := (4 * alpha * r ^ 2 / (g * (alpha + 1) ^ 2), (alpha * r - r) / (alpha + 1)).
Definition energy (g : R) (b : State) : R := height b * g + velocity b ^ 2 / 2.
Definition E_max (alpha r : R) : R := r ^ 2 * (alpha + 1) ^ 2 / (2 * (alpha - 1) ^ 2).

Definition scaling (r g : R) (b : State) : State := (height b * g / (2 * r ^ 2), (r - velocity b) / r).
Definition unscaling (r g : R) (s : State) : State := (2 * r ^ 2 * fst s / g, r - r * snd s).

Section Physical.
  Variables r g : R.
  Hypothesis r_positive : 0 < r.
  Hypothesis g_positive : 0 < g.

  Lemma period_positive : 0 < period r g.
  Proof. apply Rdiv_lt_0_compat; lra. Qed.

  Lemma unit_positive : 0 < r * period r g.
  Proof. now apply Rmult_lt_0_compat, period_positive. Qed.

  Lemma unscaling_scaling b : unscaling r g (scaling r g b) = b.
  Proof.
    pose proof period_positive. destruct b as [beta v]. unfold unscaling, scaling, height, velocity. cbn [fst snd]. f_equal; field; lra.
  Qed.

  Lemma scaling_unscaling s : scaling r g (unscaling r g s) = s.
  Proof.
    pose proof period_positive. destruct s as [x w]. unfold unscaling, scaling, height, velocity. cbn [fst snd]. f_equal; field; lra.
  Qed.

  Theorem scaling_bijective s : exists! b, scaling r g b = s.
  Proof.
    exists (unscaling r g s). split; [apply scaling_unscaling|]. intros b same. rewrite <- same. apply unscaling_scaling.
  Qed.

  (* Inequality (7) is x < w. *)
  Lemma strikes_scaled b : strikes r g b <-> fst (scaling r g b) < snd (scaling r g b).
  Proof.
    unfold strikes, scaling. cbn [fst snd].
    assert (gap : r ^ 2 * ((r - velocity b) / r - height b * g / (2 * r ^ 2)) = r ^ 2 - (height b * g / 2 + r * velocity b)) by (field; lra).
    assert (square : 0 < r ^ 2) by (apply pow_lt; lra). split; intro less; nra.
  Qed.

  Lemma above_ground_scaled b : above_ground b <-> H (scaling r g b).
  Proof.
    unfold above_ground, H, scaling. cbn [fst]. pose proof unit_positive as positive. pose proof period_positive.
    assert (back : height b * g / (2 * r ^ 2) * (r * period r g) = height b) by (unfold period; field; lra).
    set (x := height b * g / (2 * r ^ 2)) in *. split; intro above; nra.
  Qed.

  Theorem conjugate alpha b : scaling r g (ball alpha r g b) = f alpha (scaling r g b).
  Proof.
    unfold ball. destruct (Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)) as [hits|flies].
    - rewrite f_impact by now apply strikes_scaled.
      unfold scaling, impact, f_1, period, height, velocity. cbn [fst snd]. f_equal; field; lra.
    - rewrite f_flight by (apply Rnot_lt_le; intro hits; now apply flies, strikes_scaled).
      unfold scaling, flight, f_2, period, height, velocity. cbn [fst snd]. f_equal; field; lra.
  Qed.

  Theorem e1_scaled alpha : 0 < alpha < 1 -> scaling r g (e1 alpha r g) = e_1 alpha.
  Proof. intro range. unfold scaling, e1, e_1, period, height, velocity. cbn [fst snd]. f_equal; field; lra. Qed.

  (* Distances in physical units and in the normal form differ by bounded factors. *)
  Let stretch := Rmax (/ (r * period r g)) (/ r).
  Let shrink := Rmax (r * period r g) r.

  Lemma scaling_stretches b c : dist (scaling r g b) (scaling r g c) <= stretch * dist b c.
  Proof.
    pose proof unit_positive as positive. pose proof period_positive.
    pose proof (Rinv_0_lt_compat _ positive). pose proof (Rinv_0_lt_compat _ r_positive).
    destruct (proj1 (dist_at_most b c (dist b c)) (Rle_refl _)) as [first second].
    apply dist_at_most. unfold scaling, height, velocity. cbn [fst snd]. split.
    - replace (fst b * g / (2 * r ^ 2) - fst c * g / (2 * r ^ 2)) with (/ (r * period r g) * (fst b - fst c)) by (unfold period; field; lra).
      rewrite Rabs_mult, Rabs_right by lra. apply Rmult_le_compat; try lra; [apply Rabs_pos|apply Rmax_l].
    - replace ((r - snd b) / r - (r - snd c) / r) with (- / r * (snd b - snd c)) by (field; lra).
      rewrite Rabs_mult, Rabs_Ropp, Rabs_right by lra. apply Rmult_le_compat; try lra; [apply Rabs_pos|apply Rmax_r].
  Qed.

  Lemma unscaling_shrinks s t : dist (unscaling r g s) (unscaling r g t) <= shrink * dist s t.
  Proof.
    pose proof unit_positive as positive. pose proof period_positive.
    destruct (proj1 (dist_at_most s t (dist s t)) (Rle_refl _)) as [first second].
    apply dist_at_most. unfold unscaling. cbn [fst snd]. split.
    - replace (2 * r ^ 2 * fst s / g - 2 * r ^ 2 * fst t / g) with (r * period r g * (fst s - fst t)) by (unfold period; field; lra).
      rewrite Rabs_mult, Rabs_right by lra. apply Rmult_le_compat; try lra; [apply Rabs_pos|apply Rmax_l].
    - replace (r - r * snd s - (r - r * snd t)) with (- r * (snd s - snd t)) by ring.
      rewrite Rabs_mult, Rabs_Ropp, Rabs_right by lra. apply Rmult_le_compat; try lra; [apply Rabs_pos|apply Rmax_r].
  Qed.

  Lemma factors_positive : 0 < stretch /\ 0 < shrink.
  Proof.
    pose proof (Rmax_r (/ (r * period r g)) (/ r)) as low. pose proof (Rinv_0_lt_compat _ r_positive).
    pose proof (Rmax_r (r * period r g) r). unfold stretch, shrink. split; lra.
  Qed.

  (* A property of the ball at e1 is that of f at e_1. *)
  Theorem same_stability alpha : 0 < alpha < 1 ->
    globally_asymptotically_stable above_ground (ball alpha r g) (e1 alpha r g) <-> globally_asymptotically_stable H (f alpha) (e_1 alpha).
  Proof.
    intro range. destruct factors_positive as [stretch_positive shrink_positive].
    assert (back : unscaling r g (e_1 alpha) = e1 alpha r g) by (rewrite <- e1_scaled by exact range; apply unscaling_scaling).
    assert (out : forall b, above_ground b -> H (scaling r g b)) by (intro b; apply above_ground_scaled).
    assert (home : forall s, H s -> above_ground (unscaling r g s)).
    { intros s above. apply above_ground_scaled. now rewrite scaling_unscaling. }
    assert (returns : forall s, unscaling r g (f alpha s) = ball alpha r g (unscaling r g s)).
    { intro s. rewrite <- (unscaling_scaling (ball alpha r g _)), conjugate. now rewrite scaling_unscaling. }
    assert (narrow : forall b c, dist b c <= shrink * dist (scaling r g b) (scaling r g c)).
    { intros b c. pose proof (unscaling_shrinks (scaling r g b) (scaling r g c)) as bound. now rewrite !unscaling_scaling in bound. }
    assert (wide : forall s t, dist s t <= stretch * dist (unscaling r g s) (unscaling r g t)).
    { intros s t. pose proof (scaling_stretches (unscaling r g s) (unscaling r g t)) as bound. now rewrite !scaling_unscaling in bound. }
    split; intros [stays tends]; split.
    - apply (transfer_stable (unscaling r g) (f alpha) (ball alpha r g) H above_ground _ shrink stretch); try assumption;
        auto using unscaling_shrinks.
      now rewrite back.
    - apply (transfer_attracting (unscaling r g) (f alpha) (ball alpha r g) H above_ground _ stretch); try assumption; auto.
      now rewrite back.
    - apply (transfer_stable (scaling r g) (ball alpha r g) (f alpha) above_ground H _ stretch shrink); try assumption;
        auto using scaling_stretches, conjugate. now rewrite e1_scaled.
    - apply (transfer_attracting (scaling r g) (ball alpha r g) (f alpha) above_ground H _ shrink); try assumption; auto using conjugate.
      now rewrite e1_scaled.
  Qed.

  Theorem physical_global alpha : 0 < alpha < 1 / 3 -> globally_asymptotically_stable above_ground (ball alpha r g) (e1 alpha r g).
  Proof. intro range. apply same_stability; [lra|]. now apply global. Qed.

  Theorem physical_sharp alpha : 0 < alpha < 1 ->
    globally_asymptotically_stable above_ground (ball alpha r g) (e1 alpha r g) <-> alpha < 1 / 3.
  Proof. intro range. rewrite same_stability by exact range. now apply sharp. Qed.

  Theorem physical_stable alpha : 0 < alpha < 1 -> stable above_ground (ball alpha r g) (e1 alpha r g).
  Proof.
    intro range. destruct factors_positive as [stretch_positive shrink_positive].
    apply (transfer_stable (scaling r g) (ball alpha r g) (f alpha) above_ground H _ stretch shrink); try assumption.
    - apply conjugate.
    - intro b. apply above_ground_scaled.
    - intro b. apply scaling_stretches.
    - intro b. pose proof (unscaling_shrinks (scaling r g b) (scaling r g (e1 alpha r g))) as bound. now rewrite !unscaling_scaling in bound.
    - rewrite e1_scaled by exact range. now apply e_1_is_stable.
  Qed.

  (* The explicit bound: heights in units of r T, velocities in units of r. *)
  Theorem physical_bound alpha b n k : 0 < alpha < 1 / 3 -> above_ground b -> rank (scaling r g b) + 3 <= INR n ->
    Rabs (height (iterate (ball alpha r g) (n + k) b) - height (e1 alpha r g)) <= 2 * r ^ 2 / g * (2 * alpha) ^ k /\
    Rabs (velocity (iterate (ball alpha r g) (n + k) b) - velocity (e1 alpha r g)) <= r * (2 * alpha) ^ k.
  Proof.
    intros range above late. pose proof unit_positive as positive. pose proof period_positive.
    replace (2 * r ^ 2 / g) with (r * period r g) by (unfold period; field; lra).
    pose proof (distance_bound alpha range (scaling r g b) n k (proj1 (above_ground_scaled b) above) late) as bound.
    rewrite <- (carries_iterates (scaling r g) (ball alpha r g) (f alpha) (conjugate alpha)) in bound.
    rewrite <- e1_scaled in bound by lra. apply dist_at_most in bound as [first second].
    set (c := iterate (ball alpha r g) (n + k) b) in *. set (e := e1 alpha r g) in *.
    replace (height c - height e) with (r * period r g * (fst (scaling r g c) - fst (scaling r g e)))
      by (unfold scaling, period; cbn [fst]; field; lra).
    replace (velocity c - velocity e) with (- r * (snd (scaling r g c) - snd (scaling r g e))) by (unfold scaling; cbn [snd]; field; lra).
    rewrite !Rabs_mult, Rabs_Ropp, (Rabs_right r), (Rabs_right (period r g)) by lra.
    split; apply Rmult_le_compat_l; lra.
  Qed.

  Lemma energy_scaled b : above_ground b -> 2 * energy g b = r ^ 2 * (speed (scaling r g b) * speed (scaling r g b)).
  Proof.
    intro above. apply above_ground_scaled, speed_equation in above as [_ square]. rewrite square.
    unfold energy, scaling. cbn [fst snd]. field. lra.
  Qed.

  Theorem E_max_invariant alpha b : 0 < alpha < 1 ->
    above_ground b /\ energy g b <= E_max alpha r -> above_ground (ball alpha r g b) /\ energy g (ball alpha r g b) <= E_max alpha r.
  Proof.
    intro range. assert (square : 0 < r ^ 2) by (apply pow_lt; lra).
    assert (level : 0 <= (alpha + 1) / (1 - alpha)) by (apply Rlt_le, Rdiv_lt_0_compat; lra).
    assert (same : forall c, above_ground c -> energy g c <= E_max alpha r <-> speed (scaling r g c) <= (alpha + 1) / (1 - alpha)).
    { intros c above. pose proof (energy_scaled c above) as twice.
      apply above_ground_scaled, speed_equation in above as [positive _].
      replace (E_max alpha r) with (r ^ 2 * (((alpha + 1) / (1 - alpha)) * ((alpha + 1) / (1 - alpha))) / 2) by (unfold E_max; field; lra).
      set (m := (alpha + 1) / (1 - alpha)) in *. set (u := speed (scaling r g c)) in *. split; intro bound.
      - apply Rnot_lt_le. intro beyond. assert (m * m < u * u) by nra. nra.
      - assert (u * u <= m * m) by nra. nra. }
    intros [above bound].
    destruct (boundary_invariant alpha range (scaling r g b)) as [higher slower];
      [split; [exact (proj1 (above_ground_scaled b) above)|now apply same]|].
    rewrite <- conjugate in higher, slower. apply (proj2 (above_ground_scaled _)) in higher. split; [exact higher|now apply same].
  Qed.
End Physical.
