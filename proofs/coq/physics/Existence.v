(* Executions exist, and the state at the time 0 decides each: the ball at the bounces of the table is an orbit of the paper's map.

   Defined:  table_of, the table from the phase p on; motion_of, the ball whose states at the bounces are an orbit of the map.
   Proved:   table_exists            there is a table in each phase;
             motion_is_execution     motion_of is an execution;
             execution_is_motion     every execution is such a one;
             execution_is_orbit      from bounce to bounce it goes by the map, with one impact at most between two bounces;
             execution_through       there is an execution through each state at a bounce;
             ball_exists             there is an execution of the ball from each state on or above the table;
             ball_is_unique          and only one. *)

From Coq Require Import Reals Lra Lia.
From Juggleproof Require Import Rules Map Physical Executions Bouncing.
Open Scope R_scope.

Section Existence.
  Variables g r : R.
  Hypothesis g_positive : 0 < g.
  Hypothesis r_positive : 0 < r.

  Local Notation T := (period r g).
  Local Notation launch := ((0, r) : State).

  Let T_positive : 0 < T.
  Proof. now apply period_positive. Qed.

  (* ---------------------------------------------------------------- there are tables *)

  Definition table_of (p t : R) : State :=
    let time := t - (- p + INR (number (- p) T t) * T) in if Req_EM_T time 0 then (0, - r) else fly g time launch.

  Theorem table_exists p : 0 <= p < T -> exists table, is_table g r table /\ surface_of table 0 = fly g p launch.
  Proof.
    intro range. exists (table_of p).
    assert (inner : forall k t, 0 < t < T -> table_of p (- p + INR k * T + t) = fly g t launch).
    { intros k t inside. unfold table_of. rewrite (number_unique _ _ _ k) by lra.
      replace (- p + INR k * T + t - (- p + INR k * T)) with t by ring. destruct (Req_EM_T t 0); [lra|reflexivity]. }
    assert (bounce : forall k, table_of p (- p + INR k * T) = (0, - r)).
    { intro k. unfold table_of. rewrite (number_unique _ _ _ k) by lra.
      rewrite Rminus_diag_eq by reflexivity. destruct (Req_EM_T 0 0); [reflexivity|contradiction]. }
    assert (launched : forall k t, 0 <= t < T ->
      after 1 (ground (- p + INR k * T + t)) (table_of p (- p + INR k * T + t)) = fly g t launch).
    { intros k t [low high]. destruct (Rle_lt_or_eq_dec 0 t low) as [inside|zero].
      - rewrite inner, after_no_impact; [reflexivity| |lra]. intros [touch _].
        pose proof (launch_height g r g_positive t ltac:(split; assumption)). unfold ground, height at 2 in touch.
        cbn [fst] in touch.
        lra.
      - subst t. rewrite Rplus_0_r, bounce, fly_0, after_impact by (unfold meets, ground, height, velocity; cbn [fst snd]; lra).
        unfold rebound, ground, height, velocity. cbn [fst snd]. f_equal. ring. }
    assert (first : after 1 (ground 0) (table_of p 0) = fly g p launch).
    { replace 0 with (- p + INR 0 * T + p) at 1 2 by (cbn; ring). now apply launched. }
    split; [split|exact first].
    - apply (execution_by_periods _ _ _ _ (- p) T T_positive ltac:(lra)).
      + intros t late. destruct (number_is (- p) T t T_positive ltac:(lra)) as [low high]. set (k := number (- p) T t) in *.
        replace t with (- p + INR k * T + (t - (- p + INR k * T))) by ring. set (time := t - (- p + INR k * T)) in *.
        unfold ground, height at 1. cbn [fst].
        destruct (Req_dec time 0) as [zero|other].
        * rewrite zero, Rplus_0_r, bounce. apply Rle_refl.
        * rewrite inner by (unfold time in *; lra). apply Rlt_le, (launch_height g r g_positive). unfold time in *. lra.
      + intros k s t _ order last _. set (time := s - (- p + INR k * T)).
        replace s with (- p + INR k * T + time) at 2 3 by (unfold time; ring). rewrite launched by (unfold time; lra).
        rewrite fly_fly.
        destruct (Rle_lt_or_eq_dec _ _ last) as [less|same].
        * replace t with (- p + INR k * T + (t - (- p + INR k * T))) at 1 by ring. rewrite inner by lra. f_equal. unfold time. ring.
        * replace t with (- p + INR (S k) * T) at 1 by (rewrite S_INR; lra). rewrite bounce.
          replace (time + (t - s)) with (period r g) by (unfold time; lra). symmetry. now apply launch_back.
      + intros k s _ order. exists (- p + (INR k + 1) * T). split; [lra|]. intros t inside [touch _].
        replace t with (- p + INR k * T + (t - (- p + INR k * T))) in touch by ring. rewrite inner in touch by lra.
        pose proof (launch_height g r g_positive (t - (- p + INR k * T)) ltac:(lra)) as high.
        unfold ground, height at 2 in touch. cbn [fst] in touch. lra.
    - replace 0 with (- p + INR 0 * T + p) by (cbn; ring). destruct (Rle_lt_or_eq_dec 0 p (proj1 range)) as [inside|zero].
      + rewrite inner by lra. unfold energy, fly, height, velocity. cbn [fst snd]. field.
      + replace (- p + INR 0 * T + p) with (- p + INR 0 * T) by lra. rewrite bounce. unfold energy, height, velocity.
        cbn [fst snd]. field.
  Qed.

  (* ---------------------------------------------------------------- there are executions of the ball *)

  Variable alpha : R.
  Hypothesis alpha_positive : 0 < alpha.

  Let at_bounce (b : State) (k : nat) : State := iterate (ball alpha r g) k b.

  (* The ball whose state at the bounce start + k T is the k-th iterate of b. *)
  Definition motion_of (start : R) (b : State) : Motion := fun t =>
    let k := number start T t in in_period alpha r g (at_bounce b k) (t - (start + INR k * T)).

  Section Ball.
    Variables (surface : Motion) (start : R).
    Hypothesis range : - T < start <= 0.
    Hypothesis table_is : forall k t, 0 <= t < T -> 0 <= start + INR k * T + t -> surface (start + INR k * T + t) = fly g t launch.

    Lemma ball_above q b : 0 <= q < T -> above_at r q b -> above_ground (ball alpha r g b).
    Proof.
      intros low here. rewrite <- (in_period_T _ _ g_positive r_positive _ q) by assumption.
      pose proof (in_period_above _ _ g_positive r_positive _ alpha_positive q b T low here ltac:(lra)) as high.
      rewrite (launch_back g r g_positive r_positive) in high. exact high.
    Qed.

    Lemma above_at_bounces b k : above_at r (- start) b ->
      exists q, 0 <= q < T /\ above_at r q (at_bounce b k) /\ 0 <= start + INR k * T + q /\
        forall t, 0 <= t -> 0 <= start + INR k * T + t -> q <= t.
    Proof.
      intro above. induction k as [|k (q & low & here & _)].
      - exists (- start). cbn. repeat split; try exact above; intros; lra.
      - exists 0. repeat split; try lra.
        + now apply above_at_0, (ball_above q).
        + rewrite S_INR. pose proof (pos_INR k). nra.
        + intros; assumption.
    Qed.

    Lemma motion_in_period b k t : above_at r (- start) b -> 0 <= t <= T -> 0 <= start + INR k * T + t ->
      motion_of start b (start + INR k * T + t) = in_period alpha r g (at_bounce b k) t.
    Proof.
      intros above [low high] late. unfold motion_of. destruct (Rle_lt_or_eq_dec t T high) as [less|same].
      - rewrite (number_unique _ _ _ k) by lra. f_equal. ring.
      - subst t. replace (start + INR k * T + T) with (start + INR (S k) * T) by (rewrite S_INR; ring).
        rewrite (number_unique _ _ _ (S k)) by lra.
        rewrite Rminus_diag_eq by reflexivity. destruct (above_at_bounces b k above) as (q & range_q & here & _).
        destruct (above_at_bounces b (S k) above) as (z & range_z & next & _ & least).
        rewrite (in_period_T g r g_positive r_positive alpha q) by assumption.
        assert (zero : z = 0).
        { apply Rle_antisym; [|lra]. apply least; [lra|]. rewrite S_INR. pose proof (pos_INR k). nra. }
        subst z. rewrite (in_period_start g r g_positive r_positive alpha 0) by assumption. apply fly_0.
    Qed.

    Theorem motion_is_execution b : above_at r (- start) b -> execution g alpha surface (motion_of start b).
    Proof.
      intro above. apply (execution_by_periods _ _ _ _ start T T_positive ltac:(lra)).
      - intros t late. destruct (number_is start T t T_positive ltac:(lra)) as [low high]. set (k := number start T t) in *.
        destruct (above_at_bounces b k above) as (q & range_q & here & _ & least).
        replace t with (start + INR k * T + (t - (start + INR k * T))) by ring. set (time := t - (start + INR k * T)) in *.
        rewrite table_is, motion_in_period by (assumption || unfold time; lra).
        apply (in_period_above _ _ g_positive r_positive _ alpha_positive q); [exact range_q|exact here|].
        split; [apply least|]; unfold time; lra.
      - intros k s t late order last none. destruct (above_at_bounces b k above) as (q & range_q & here & _ & least).
        set (from := s - (start + INR k * T)). set (to := t - (start + INR k * T)).
        replace t with (start + INR k * T + to) in * by (unfold to; ring).
        replace s with (start + INR k * T + from) in * by (unfold from; ring).
        replace (start + INR k * T + to - (start + INR k * T + from)) with (to - from) by ring.
        rewrite table_is, !motion_in_period by (assumption || lra).
        apply (in_period_flies _ _ g_positive r_positive _ alpha_positive q); try assumption; [split; [apply least|]; lra|lra|].
        intros time inside. rewrite <- (motion_in_period b k), <- (table_is k) by (assumption || lra). apply none. lra.
      - intros k s late order. destruct (above_at_bounces b k above) as (q & range_q & here & _ & least).
        set (from := s - (start + INR k * T)). assert (first : q <= from) by (apply least; unfold from; lra).
        assert (free : forall e, from < e <= T -> ~ (strikes r g (at_bounce b k) /\ from < contact_time r (at_bounce b k) < e) ->
          no_impact surface (motion_of start b) s (start + INR k * T + e)).
        { intros e inside no t between hit. set (time := t - (start + INR k * T)).
          replace t with (start + INR k * T + time) in hit by (unfold time; ring).
          rewrite table_is, motion_in_period in hit by (assumption || unfold time, from in *; lra).
          apply (one_impact _ _ g_positive r_positive _ alpha_positive q) in hit as [hits same]; try assumption;
            unfold time, from in *; [|lra]. apply no. split; [exact hits|lra]. }
        destruct (Rlt_dec from (contact_time r (at_bounce b k))) as [before|past];
          [destruct (Rlt_dec (contact_time r (at_bounce b k)) T) as [inside|outside]|].
        + exists (start + INR k * T + contact_time r (at_bounce b k)). split; [unfold from in before; lra|]. apply free; lra.
        + exists (start + INR k * T + T). split; [lra|]. apply free; [unfold from; lra|lra].
        + exists (start + INR k * T + T). split; [lra|]. apply free; [unfold from; lra|lra].
    Qed.

    (* Any execution of the ball is that of its state at the time 0, flown back to the bounce before. *)
    Theorem execution_is_motion body : execution g alpha surface body ->
      above_at r (- start) (fly g start (body 0)) /\
      forall k t, 0 <= t <= T -> 0 <= start + INR k * T + t ->
        body (start + INR k * T + t) = in_period alpha r g (at_bounce (fly g start (body 0)) k) t.
    Proof.
      intro moves. set (b := fly g start (body 0)).
      assert (here : body 0 = fly g (- start) b) by (unfold b; rewrite fly_fly, Rplus_opp_r; symmetry; apply fly_0).
      assert (above : above_at r (- start) b).
      { pose proof (stays_above _ _ _ _ moves 0 (Rle_refl 0)) as high. rewrite here in high.
        replace 0 with (start + INR 0 * T + (- start)) in high at 1 by (cbn; ring). rewrite table_is in high by (cbn; lra).
        unfold above_at, fly, height, velocity in *. cbn [fst snd] in *. lra. }
      split; [exact above|].
      assert (all : forall k q, 0 <= q < T -> above_at r q (at_bounce b k) -> 0 <= start + INR k * T + q ->
        (forall t, 0 <= t -> 0 <= start + INR k * T + t -> q <= t) -> body (start + INR k * T + q) = fly g q (at_bounce b k) ->
        forall t, q <= t <= T -> body (start + INR k * T + t) = in_period alpha r g (at_bounce b k) t).
      { intros k q range_q above_q late least now_.
        apply (ball_in_period _ _ g_positive r_positive _ alpha_positive surface); try assumption.
        intros t inside. apply table_is; lra. }
      assert (bounces : forall k, exists q, 0 <= q < T /\ above_at r q (at_bounce b k) /\ 0 <= start + INR k * T + q /\
        (forall t, 0 <= t -> 0 <= start + INR k * T + t -> q <= t) /\ body (start + INR k * T + q) = fly g q (at_bounce b k)).
      { intro k. induction k as [|k (q & range_q & above_q & late & least & now_)].
        - exists (- start). cbn. repeat split; try assumption; try lra; [intros; lra|]. rewrite <- here. f_equal. ring.
        - destruct (above_at_bounces b (S k) above) as (z & range_z & next & late_z & least_z). exists z.
          repeat split; try assumption; try lra.
          assert (zero : z = 0).
          { apply Rle_antisym; [|lra]. apply least_z; [lra|]. rewrite S_INR. pose proof (pos_INR k). nra. }
          subst z. rewrite fly_0. replace (start + INR (S k) * T + 0) with (start + INR k * T + T) by (rewrite S_INR; ring).
          rewrite (all k q) by (assumption || lra). now apply (in_period_T g r g_positive r_positive alpha q). }
      intros k t inside late. destruct (bounces k) as (q & range_q & above_q & late_q & least & now_).
      apply (all k q); try assumption. split; [apply least|]; lra.
    Qed.

    Lemma bounces_late k : start + T + INR k * T = start + INR (S k) * T /\ 0 <= start + INR (S k) * T.
    Proof. rewrite S_INR. pose proof (pos_INR k). split; [ring|nra]. Qed.

    Lemma orbit_from_bounce body : execution g alpha surface body -> above_ground (body (start + T)) /\ forall k t, 0 <= t <= T ->
      body (start + T + INR k * T + t) = in_period alpha r g (at_bounce (body (start + T)) k) t.
    Proof.
      intro moves. destruct (execution_is_motion body moves) as [above known]. set (b := fly g start (body 0)) in *.
      assert (one : body (start + T) = ball alpha r g b).
      { rewrite <- (in_period_T _ _ g_positive r_positive _ (- start)) by (assumption || lra).
        replace (start + T) with (start + INR 0 * T + T) by (cbn; ring). apply (known 0%nat); cbn; lra. }
      split.
      - pose proof (stays_above _ _ _ _ moves (start + T) ltac:(lra)) as high.
        replace (start + T) with (start + INR 1 * T + 0) in high at 1 by (cbn; ring).
        rewrite table_is, fly_0 in high by (cbn; lra). exact high.
      - intros k t inside. rewrite one. unfold at_bounce. rewrite <- iterate_step. destruct (bounces_late k) as [-> late].
        apply (known (S k)); lra.
    Qed.

    (* From the first bounce after the time 0 on: the map takes the ball from bounce to bounce, and between two it has an impact where
       inequality (7) holds, one, at the time (6). *)
    Theorem execution_is_orbit body k : execution g alpha surface body ->
      let b := iterate (ball alpha r g) k (body (start + T)) in
      body (start + T + INR k * T) = b /\
      forall t, 0 <= t < T -> meets (surface (start + T + INR k * T + t)) (body (start + T + INR k * T + t)) <->
        strikes r g b /\ t = contact_time r b.
    Proof.
      intros moves b. destruct (orbit_from_bounce body moves) as [first known].
      assert (above : above_at r 0 b).
      { apply above_at_0, iterate_keeps; [|exact first]. intros c above. apply (ball_above 0); [lra|now apply above_at_0]. }
      split.
      - rewrite <- (Rplus_0_r (_ + _)), known, in_period_start by (exact above || lra). apply fly_0.
      - intros t inside. rewrite known by lra. destruct (bounces_late k) as [-> late]. rewrite table_is by lra.
        now apply (one_impact _ _ g_positive r_positive _ alpha_positive 0); [lra| |].
    Qed.

    (* There is an execution through each state on or above the table at a bounce; before the first bounce it may be past its impact. *)
    Theorem execution_through b : above_ground b -> exists body, execution g alpha surface body /\
      forall k t, 0 <= t <= T -> 0 <= start + INR k * T + t -> body (start + INR k * T + t) = in_period alpha r g (at_bounce b k) t.
    Proof.
      intro above. pose proof (above_at_0 r b above) as above_0.
      assert (other : exists c, above_at r (- start) c /\ forall t, - start <= t <= T ->
        in_period alpha r g c t = in_period alpha r g b t).
      { destruct (Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)) as [hits|no].
        - destruct (contact g r g_positive r_positive 0 b) as (falls & high & order & touch); try assumption; [lra|].
          set (d := contact_time r b) in *. destruct (Rlt_dec d (- start)) as [past|before].
          + exists (reflected alpha r b).
            assert (ahead : 0 <= alpha * ((r - velocity b) * (- start - d))) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]).
            split; [unfold above_at, reflected, height, velocity in *; cbn [fst snd]; rewrite touch; lra|].
            intros t inside. rewrite (in_period_after _ _ _ b) by (assumption || fold d; lra). apply in_period_before.
            intros [again _].
            apply (strikes_is g r g_positive r_positive) in again.
            assert (0 < alpha * ((r - velocity b) * (T - d))) by (apply Rmult_lt_0_compat; [lra|apply Rmult_lt_0_compat; lra]).
            unfold reflected, height, velocity in *. cbn [fst snd] in again. rewrite touch in again. lra.
          + exists b. split; [unfold above_at; rewrite touch; nra|reflexivity].
        - exists b. split; [|reflexivity]. assert (far : (r - velocity b) * T <= height b)
            by (apply Rnot_lt_le; intro less; apply no; now apply (strikes_is g r g_positive r_positive)).
          unfold above_at, above_ground in *. destruct (Rle_dec r (velocity b)); nra. }
      destruct other as (c & above_c & same). exists (motion_of start c). split; [now apply motion_is_execution|].
      assert (next : forall k, at_bounce c (S k) = at_bounce b (S k)).
      { intro k. unfold at_bounce. rewrite !iterate_step. f_equal.
        rewrite <- (in_period_T _ _ g_positive r_positive _ (- start) c), <- (in_period_T _ _ g_positive r_positive _ 0 b) by (assumption || lra).
        apply same. lra. }
      intros k t inside late. rewrite motion_in_period by assumption. destruct k as [|k]; [apply same; cbn in late; lra|].
      now rewrite next.
    Qed.
  End Ball.

  Theorem ball_exists table b : is_table g r table -> height (surface_of table 0) <= height b ->
    exists ball, is_ball g alpha table ball /\ ball 0 = b.
  Proof.
    intros moves high. destruct (table_has_period g r g_positive r_positive table moves) as (start & range & table_is).
    assert (here : fly g (- start) (fly g start b) = b) by (rewrite fly_fly, Rplus_opp_r; apply fly_0).
    assert (above : above_at r (- start) (fly g start b)).
    { rewrite <- here in high. replace 0 with (start + INR 0 * T + - start) in high by (cbn; ring).
      rewrite table_is in high by (cbn; lra). unfold above_at, fly, height, velocity in *. cbn [fst snd] in *. lra. }
    exists (motion_of start (fly g start b)).
    split; [now apply motion_is_execution|].
    replace 0 with (start + INR 0 * T + - start) by (cbn; ring). rewrite motion_in_period by (assumption || cbn; lra).
    rewrite (in_period_start _ _ g_positive r_positive _ (- start)); [exact here|lra|exact above].
  Qed.

  Theorem ball_is_unique table ball other : is_table g r table -> is_ball g alpha table ball -> is_ball g alpha table other ->
    ball 0 = other 0 -> forall t, 0 <= t -> ball t = other t.
  Proof.
    intros moves first second same t late.
    destruct (table_has_period g r g_positive r_positive table moves) as (start & range & table_is).
    destruct (number_is start T t T_positive ltac:(lra)) as [low high]. set (k := number start T t) in *.
    replace t with (start + INR k * T + (t - (start + INR k * T))) by ring.
    rewrite (proj2 (execution_is_motion _ _ range table_is ball first)), (proj2 (execution_is_motion _ _ range table_is other second)) by lra.
    now rewrite same.
  Qed.
End Existence.
