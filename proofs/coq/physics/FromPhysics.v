(* The theorem from physics: for 0 < alpha < 1/3 every execution of the ball over the table settles, in continuous time.

   Proved:   settling_bound          n + k bounces after the first, n given by the rank, heights are within
                                     2 r T (2 alpha)^k of those of the limit for a whole period, the impact is within
                                     5/2 T (2 alpha)^k of its impact, and velocities elsewhere within r (2 alpha)^k;
             theorem_from_physics    for 0 < alpha < 1/3 the ball settles over each table;
             sharp_from_physics      for 0 < alpha < 1 it does so exactly for alpha < 1/3.
   What the theorems speak of is defined in Executions.v; that there are such executions is proved in Existence.v. *)

From Coq Require Import Reals Lra Lia.
From Juggleproof Require Import Rules Map Neighbourhood Ranking GlobalStability Transfer Physical Executions Bouncing Existence.
Open Scope R_scope.

Section FromPhysics.
  Variables g r alpha : R.
  Hypothesis g_positive : 0 < g.
  Hypothesis r_positive : 0 < r.
  Hypothesis alpha_range : 0 < alpha < 1.

  Local Notation T := (period r g).
  Local Notation launch := ((0, r) : State).
  Local Notation e := (e1 alpha r g).

  Let T_positive : 0 < T.
  Proof. now apply period_positive. Qed.

  Let alpha_positive : 0 < alpha.
  Proof. lra. Qed.

  (* ---------------------------------------------------------------- the periodic ball *)

  Lemma e1_is : velocity e = r - r * snd (e_1 alpha) /\ height e = r * T * fst (e_1 alpha).
  Proof. unfold e1, e_1, period, height, velocity. cbn [fst snd]. split; field; lra. Qed.

  Lemma e1_strikes : above_ground e /\ strikes r g e /\ velocity e < r.
  Proof.
    destruct (e_1_range alpha alpha_range) as (positive & order & _ & speed & _). destruct e1_is as [speed_is height_is].
    assert (scaled : scaling r g e = e_1 alpha) by now apply e1_scaled. split; [|split].
    - apply (above_ground_scaled r g r_positive g_positive). rewrite scaled. unfold H. lra.
    - apply (strikes_scaled r g r_positive). now rewrite scaled.
    - rewrite speed_is. nra.
  Qed.

  Lemma e1_is_fixed k : iterate (ball alpha r g) k e = e.
  Proof.
    assert (once : ball alpha r g e = e).
    { rewrite <- (unscaling_scaling r g r_positive g_positive (ball alpha r g e)), conjugate by assumption.
      rewrite e1_scaled, (proj2 (e_1_is_fixed alpha alpha_range)), <- e1_scaled with (r := r) (g := g) by assumption.
      now apply unscaling_scaling. }
    induction k as [|k IH]; [reflexivity|]. change (ball alpha r g (iterate (ball alpha r g) k e) = e). now rewrite IH.
  Qed.

  (* The impact of the periodic ball is before a quarter of the period is over for alpha < 1/3. *)
  Lemma e1_contact : contact_time r e = alpha / (1 + alpha) * T /\ height e = (r - velocity e) * contact_time r e.
  Proof.
    destruct e1_strikes as (_ & _ & falls). unfold contact_time. split; [|field; lra]. unfold e1, period, height, velocity.
    cbn [fst snd]. field. lra.
  Qed.

  (* ---------------------------------------------------------------- two balls with close states at a bounce *)

  Section Close.
    Variables (b : State) (q : R).
    Hypothesis above : above_ground b.
    Hypothesis hits : strikes r g b.
    Hypothesis close_height : Rabs (height b - height e) <= r * T * q.
    Hypothesis close_velocity : Rabs (velocity b - velocity e) <= r * q.

    Let b_falls : velocity b < r /\ height b = (r - velocity b) * contact_time r b.
    Proof.
      destruct (contact g r g_positive r_positive 0 b) as (falls & _ & _ & same); [lra|now apply above_at_0|exact hits|]. now split.
    Qed.

    Lemma close_heights t : 0 <= t <= T -> Rabs (height (in_period alpha r g b t) - height (in_period alpha r g e t)) <= 2 * r * T * q.
    Proof.
      intro inside. destruct e1_strikes as (_ & e_hits & e_falls). destruct b_falls as [falls touch].
      destruct e1_contact as [_ e_touch].
      apply absolute_bounds in close_height, close_velocity.
      set (c := contact_time r b) in *. set (d := contact_time r e) in *.
      assert (scale : - (r * T * q) <= (velocity b - velocity e) * t <= r * T * q) by nra.
      assert (fine : 0 <= r * T * q) by lra.
      apply Rabs_le. destruct (Rlt_dec c t) as [past|before]; destruct (Rlt_dec d t) as [e_past|e_before].
      - rewrite !in_period_after by assumption. unfold fly, reflected, height, velocity in *. cbn [fst snd] in *. nra.
      - rewrite (in_period_after _ _ _ b), (in_period_before _ _ _ e) by (assumption || tauto).
        assert (0 <= (r - velocity b) * (t - c) /\ (r - velocity e) * (t - d) <= 0) by (split; nra).
        unfold fly, reflected, height, velocity in *. cbn [fst snd] in *. nra.
      - rewrite (in_period_before _ _ _ b), (in_period_after _ _ _ e) by (assumption || tauto).
        assert ((r - velocity b) * (t - c) <= 0 /\ 0 <= (r - velocity e) * (t - d)) by (split; nra).
        unfold fly, reflected, height, velocity in *. cbn [fst snd] in *. nra.
      - rewrite !in_period_before by tauto. unfold fly, height, velocity in *. cbn [fst snd] in *. lra.
    Qed.

    Hypothesis small : alpha < 1 / 3.
    Hypothesis q_small : q <= 1.

    Lemma close_contact : Rabs (contact_time r b - contact_time r e) <= 5 / 2 * T * q.
    Proof.
      destruct e1_is as [speed_is _]. destruct b_falls as [falls touch]. destruct e1_contact as [when e_touch].
      apply absolute_bounds in close_height, close_velocity.
      set (c := contact_time r b) in *. set (d := contact_time r e) in *.
      assert (early : 0 <= d <= 1 / 4 * T).
      { assert (0 <= alpha / (1 + alpha) <= 1 / 4).
        { split; [apply Rlt_le, Rdiv_lt_0_compat; lra|]. apply Rmult_le_reg_r with (1 + alpha); [lra|].
          replace (alpha / (1 + alpha) * (1 + alpha)) with alpha by (field; lra). lra. }
        rewrite when. nra. }
      assert (fast : r / 2 <= r - velocity b).
      { assert (3 / 2 <= snd (e_1 alpha)).
        { unfold e_1. cbn [snd]. apply Rmult_le_reg_r with (alpha + 1); [lra|].
          replace (2 / (alpha + 1) * (alpha + 1)) with 2 by (field; lra). lra. }
        nra. }
      assert (gap : (r - velocity b) * (c - d) = height b - height e + (velocity b - velocity e) * d) by nra.
      assert (fine : 0 <= q) by (clear - r_positive close_velocity; nra).
      assert (part : - (r * q) * d <= (velocity b - velocity e) * d <= r * q * d) by (split; apply Rmult_le_compat_r; lra).
      assert (least : r * q * d <= r * q * (1 / 4 * T)) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
      assert (bound : - (5 / 4 * (r * T * q)) <= (r - velocity b) * (c - d) <= 5 / 4 * (r * T * q)) by (rewrite gap; lra).
      assert (length : 0 <= T * q) by (apply Rmult_le_pos; lra). clear - bound fast length r_positive.
      apply Rabs_le. split; apply Rnot_lt_le; intro beyond; nra.
    Qed.

    Lemma close_velocities t : 5 / 2 * T * q < Rabs (t - contact_time r e) ->
      Rabs (velocity (in_period alpha r g b t) - velocity (in_period alpha r g e t)) <= r * q.
    Proof.
      intro apart. destruct e1_strikes as (_ & e_hits & _). pose proof close_contact as near. apply absolute_bounds in near.
      assert (same_side : contact_time r b < t /\ contact_time r e < t \/ ~ contact_time r b < t /\ ~ contact_time r e < t).
      { unfold Rabs in apart. destruct (Rcase_abs (t - contact_time r e)); lra. }
      apply absolute_bounds in close_velocity. apply Rabs_le. destruct same_side as [[past e_past]|[before e_before]].
      - rewrite !in_period_after by assumption. unfold fly, reflected, velocity in *. cbn [fst snd] in *.
        assert (- (r * q) <= alpha * (snd b - snd e) <= r * q) by (clear - alpha_range close_velocity; nra). lra.
      - rewrite !in_period_before by tauto. unfold fly, velocity in *. cbn [fst snd] in *. lra.
    Qed.
  End Close.

  (* ---------------------------------------------------------------- every ball over the table *)

  Section Over.
    Variable table : Motion.
    Variable start : R.
    Hypothesis range : - T < start <= 0.
    Hypothesis table_is : forall k t, 0 <= t < T -> 0 <= start + INR k * T + t -> surface_of table (start + INR k * T + t) = fly g t launch.

    Let bounce : R := start + T.

    Let bounces_late k : bounce + INR k * T = start + INR (S k) * T /\ 0 <= start + INR (S k) * T.
    Proof. now apply bounces_late. Qed.

    Lemma limit_exists : exists limit, is_ball g alpha table limit /\
      forall k t, 0 <= t <= T -> 0 <= start + INR k * T + t -> limit (start + INR k * T + t) = in_period alpha r g e t.
    Proof.
      destruct (execution_through g r g_positive r_positive alpha alpha_positive _ _ range table_is e) as (limit & moves & known);
        [apply e1_strikes|]. exists limit. split; [exact moves|]. intros k t inside late. now rewrite known, e1_is_fixed.
    Qed.

    Theorem settling_bound body n k t : alpha < 1 / 3 -> is_ball g alpha table body ->
      rank (scaling r g (body bounce)) + 3 <= INR n -> 0 <= t <= T ->
      Rabs (height (body (bounce + INR (n + k) * T + t)) - height (in_period alpha r g e t)) <= 2 * r * T * (2 * alpha) ^ k /\
      (5 / 2 * T * (2 * alpha) ^ k < Rabs (t - contact_time r e) ->
        Rabs (velocity (body (bounce + INR (n + k) * T + t)) - velocity (in_period alpha r g e t)) <= r * (2 * alpha) ^ k) /\
      (t < T -> meets (surface_of table (bounce + INR (n + k) * T + t)) (body (bounce + INR (n + k) * T + t)) ->
        Rabs (t - contact_time r e) <= 5 / 2 * T * (2 * alpha) ^ k).
    Proof.
      intros small moves late inside. destruct (orbit_from_bounce g r g_positive r_positive alpha alpha_positive _ _
        range table_is body moves) as [above known].
      fold bounce in above, known. rewrite known by exact inside.
      destruct (physical_bound r g r_positive g_positive alpha (body bounce) n k ltac:(lra) above late) as [heights velocities].
      assert (trapped : trap alpha (iterate (f alpha) (n + k) (scaling r g (body bounce)))).
      { apply only_impacts; [lra|now apply (proj1 (above_ground_scaled r g r_positive g_positive _))|]. rewrite plus_INR.
        pose proof (pos_INR k). lra. }
      rewrite <- (carries_iterates (scaling r g) (ball alpha r g) (f alpha) (conjugate r g r_positive g_positive alpha)) in trapped.
      set (b := iterate (ball alpha r g) (n + k) (body bounce)) in *. set (q := (2 * alpha) ^ k) in *.
      assert (high : above_ground b) by (apply (above_ground_scaled r g r_positive g_positive); apply trapped).
      assert (hits : strikes r g b) by (apply (strikes_scaled r g r_positive); apply trapped).
      assert (at_most_1 : q <= 1) by (unfold q; rewrite <- (pow1 k); apply pow_incr; lra).
      replace (2 * r ^ 2 / g) with (r * T) in heights by (unfold period; field; lra).
      repeat split.
      - now apply close_heights.
      - now apply close_velocities.
      - intros before hit. rewrite (proj1 (bounces_late (n + k))), table_is in hit by (pose proof (bounces_late (n + k)); lra).
        apply (one_impact g r g_positive r_positive alpha alpha_positive 0) in hit as [_ ->]; [now apply close_contact|lra|now apply above_at_0|lra].
    Qed.

    Theorem every_ball_tends body limit : alpha < 1 / 3 -> is_ball g alpha table body ->
      (forall k t, 0 <= t <= T -> 0 <= start + INR k * T + t -> limit (start + INR k * T + t) = in_period alpha r g e t) ->
      tends_to (surface_of table) body limit.
    Proof.
      intros small moves known epsilon positive. destruct (exceeded_by_a_number (rank (scaling r g (body bounce)) + 3)) as [n late].
      set (scale := 2 * r * T + r + 5 / 2 * T). assert (area : 0 < r * T) by now apply Rmult_lt_0_compat.
      destruct (pow_lt_1_zero (2 * alpha)) with (y := epsilon / scale) as [m decays];
        [rewrite Rabs_right; lra|apply Rdiv_lt_0_compat; unfold scale; lra|].
      exists (bounce + INR (n + m) * T). intros t long.
      assert (first : bounce <= t) by (pose proof (pos_INR (n + m)); nra).
      destruct (number_is bounce T t T_positive first) as [low high]. set (j := number bounce T t) in *.
      assert (enough : (n + m <= j)%nat).
      { apply Nat.lt_succ_r, INR_lt. rewrite S_INR. apply Rmult_lt_reg_r with T; lra. }
      replace j with (n + (j - n))%nat in low, high by lia. set (k := (j - n)%nat) in *.
      set (time := t - (bounce + INR (n + k) * T)). assert (inside : 0 <= time < T) by (unfold time; lra).
      replace t with (bounce + INR (n + k) * T + time) in * by (unfold time; ring). set (q := (2 * alpha) ^ k).
      assert (power : 0 <= q) by (apply pow_le; lra).
      assert (bound : q * scale < epsilon).
      { specialize (decays k ltac:(unfold k; lia)). fold q in decays. rewrite Rabs_right in decays by lra.
        apply Rmult_lt_compat_r with (r := scale) in decays; [|unfold scale; lra].
        now replace (epsilon / scale * scale) with epsilon in decays by (field; unfold scale; lra). }
      assert (parts : 0 <= q * (r * T) /\ 0 <= q * r /\ 0 <= q * T) by (repeat split; apply Rmult_le_pos; lra).
      unfold scale in bound.
      assert (limit_is : forall u, 0 <= u <= T -> limit (bounce + INR (n + k) * T + u) = in_period alpha r g e u).
      { intros u in_range. destruct (bounces_late (n + k)) as [-> later]. apply known; lra. }
      rewrite limit_is by lra. destruct (settling_bound body n k time small moves late ltac:(lra)) as (heights & velocities & _).
      fold q in heights, velocities. split; [lra|]. intro away. apply Rle_lt_trans with (r * q); [|lra]. apply velocities.
      apply Rnot_le_lt. intro near.
      destruct e1_strikes as (above & hits & _).
      apply above_at_0 with (r := r) in above.
      destruct (contact g r g_positive r_positive 0 e) as (_ & _ & order & _); [lra|exact above|exact hits|].
      set (c := contact_time r e) in *. apply (away (bounce + INR (n + k) * T + c)).
      - replace (bounce + INR (n + k) * T + c - (bounce + INR (n + k) * T + time)) with (- (time - c)) by ring.
        rewrite Rabs_Ropp. lra.
      - rewrite limit_is by lra. rewrite (proj1 (bounces_late (n + k))), table_is by (pose proof (bounces_late (n + k)); lra).
        apply (one_impact g r g_positive r_positive alpha alpha_positive 0); [lra|exact above|exact order|now split].
    Qed.
  End Over.
End FromPhysics.

Theorem theorem_from_physics g r alpha table : 0 < g -> 0 < r -> 0 < alpha < 1 / 3 -> is_table g r table -> settles g alpha r table.
Proof.
  intros g_positive r_positive range moves. assert (lossy : 0 < alpha < 1) by lra.
  destruct (table_has_period g r g_positive r_positive table moves) as (start & phase & table_is).
  destruct (limit_exists g r alpha g_positive r_positive lossy table start phase table_is) as (limit & limit_moves & known).
  exists limit. split; [exact limit_moves|split].
  - intros t late. pose proof (period_positive r g r_positive g_positive) as positive.
    destruct (number_is start (period r g) t positive ltac:(lra)) as [low high]. set (k := number start (period r g) t) in *.
    replace t with (start + INR k * period r g + (t - (start + INR k * period r g))) at 2 by ring.
    replace (t + period r g) with (start + INR (S k) * period r g + (t - (start + INR k * period r g))) by (rewrite S_INR; ring).
    rewrite !known; [reflexivity|lra|lra|lra|rewrite S_INR; lra].
  - intros ball ball_moves. now apply (every_ball_tends g r alpha g_positive r_positive lossy table start phase table_is).
Qed.

(* From 1/3 on the ball of e_2 and that of e_1 keep apart, at every other bounce, so that they have no limit in common. *)
Theorem sharp_from_physics g r alpha table : 0 < g -> 0 < r -> 0 < alpha < 1 -> is_table g r table ->
  settles g alpha r table <-> alpha < 1 / 3.
Proof.
  intros g_positive r_positive range moves. split; [|intro small; apply theorem_from_physics; try assumption; lra].
  intros (limit & _ & _ & tends). apply Rnot_le_lt. intro large.
  pose proof (period_positive r g r_positive g_positive) as positive.
  destruct (table_has_period g r g_positive r_positive table moves) as (start & phase & table_is).
  assert (through : forall b, above_ground b -> exists body, is_ball g alpha table body /\
    forall k, body (start + INR (S k) * period r g) = in_period alpha r g (iterate (ball alpha r g) (S k) b) 0).
  { intros b above. destruct (execution_through g r g_positive r_positive alpha ltac:(lra) _ _ phase table_is b above) as (body & body_moves & known).
    exists body. split; [exact body_moves|]. intro k. rewrite <- known; [f_equal; ring|lra|]. rewrite S_INR.
    pose proof (pos_INR k). nra. }
  set (c := unscaling r g (e_2 alpha)). assert (scaled : scaling r g c = e_2 alpha) by now apply scaling_unscaling.
  destruct (e_2_has_period_2 alpha ltac:(lra)) as (above_2 & first & _ & back & _).
  assert (above_c : above_ground c) by (apply (above_ground_scaled r g r_positive g_positive); now rewrite scaled).
  destruct (e1_strikes g r alpha g_positive r_positive range) as (above_e & _ & _).
  destruct (through _ above_e) as (body & body_moves & body_is). destruct (through c above_c) as (other & other_moves & other_is).
  assert (height_is : forall b, height b = r * period r g * fst (scaling r g b)).
  { intro b. unfold scaling, period. cbn [fst]. field. lra. }
  assert (apart : forall j, height (body (start + INR (S (2 * j)) * period r g)) = r * period r g * fst (e_1 alpha) /\
    height (other (start + INR (S (2 * j)) * period r g)) = r * period r g * fst (impact alpha (e_2 alpha))).
  { intro j. rewrite body_is, other_is, (e1_is_fixed g r alpha) by assumption. set (d := iterate (ball alpha r g) (S (2 * j)) c).
    assert (scaled_d : scaling r g d = impact alpha (e_2 alpha)).
    { unfold d. rewrite (carries_iterates (scaling r g) (ball alpha r g) (f alpha) (conjugate r g r_positive g_positive alpha)), scaled.
      change (f alpha (iterate (f alpha) (2 * j) (e_2 alpha)) = impact alpha (e_2 alpha)).
      now rewrite (iterate_periodic (f alpha) 2 _ back), first. }
    assert (above_d : above_ground d).
    { apply (above_ground_scaled r g r_positive g_positive). rewrite scaled_d, <- first. now apply H_invariant. }
    assert (here : forall b, above_ground b -> in_period alpha r g b 0 = b).
    { intros b above. rewrite in_period_start; try assumption; [apply fly_0|lra|now apply above_at_0]. }
    rewrite !here, (height_is d), (height_is (e1 alpha r g)), scaled_d, e1_scaled by assumption. now split. }
  assert (gap : 0 < fst (impact alpha (e_2 alpha)) - fst (e_1 alpha)).
  { unfold impact, e_1, e_2. cbn [fst snd]. replace (_ - _) with ((4 - 2 * alpha) * alpha / (alpha + 1) ^ 2) by (field; lra).
    apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; lra|apply pow_lt; lra]. }
  set (epsilon := r * period r g * (fst (impact alpha (e_2 alpha)) - fst (e_1 alpha)) / 2).
  assert (area : 0 < r * period r g) by now apply Rmult_lt_0_compat.
  assert (some : 0 < epsilon) by (unfold epsilon; pose proof (Rmult_lt_0_compat _ _ area gap); lra).
  destruct (tends body body_moves epsilon some) as [from_1 tends_1].
  destruct (tends other other_moves epsilon some) as [from_2 tends_2].
  destruct (exceeded_by_a_number ((Rmax from_1 from_2 - start) / period r g)) as [j late].
  set (t := start + INR (S (2 * j)) * period r g).
  assert (long : Rmax from_1 from_2 <= t).
  { apply Rmult_le_compat_r with (r := period r g) in late; [|lra].
    replace ((Rmax from_1 from_2 - start) / period r g * period r g) with (Rmax from_1 from_2 - start) in late by (field; lra).
    assert (INR j <= INR (S (2 * j))) by (apply le_INR; lia). unfold t. nra. }
  destruct (tends_1 t) as [close_1 _]; [pose proof (Rmax_l from_1 from_2); lra|].
  destruct (tends_2 t) as [close_2 _]; [pose proof (Rmax_r from_1 from_2); lra|].
  destruct (apart j) as [height_1 height_2]. fold t in height_1, height_2. rewrite height_1 in close_1. rewrite height_2 in close_2.
  apply Rabs_def2 in close_1, close_2. unfold epsilon in *. lra.
Qed.
