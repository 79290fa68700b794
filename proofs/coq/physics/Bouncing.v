(* What table and ball do in one period of the table.

   Defined:  contact_time (equation 6); reflected (equation 9); in_period, the ball at each time of a period.
   Proved:   table_has_period   from each bounce on, the table is the paper's (5), whose period is T = 2 r / g;
             in_period_T        at the end of a period the ball is where the map of equation (13) takes it;
             one_impact         in_period has an impact where inequality (7) holds, one, at contact_time;
             ball_in_period     an execution of the ball is in_period from one bounce of the table to the next. *)

From Coq Require Import Reals Lra Lia.
From Juggleproof Require Import Rules Map Physical Executions.
Open Scope R_scope.

Definition contact_time (r : R) (b : State) : R := height b / (r - velocity b).
Definition reflected (alpha r : R) (b : State) : State := (- alpha * height b, r - alpha * (velocity b - r)).
Definition in_period (alpha r g : R) (b : State) (t : R) : State :=
  if Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)
  then if Rlt_dec (contact_time r b) t then fly g t (reflected alpha r b) else fly g t b
  else fly g t b.

Section Bouncing.
  Variables g r : R.
  Hypothesis g_positive : 0 < g.
  Hypothesis r_positive : 0 < r.

  Let T := period r g.
  Let launch : State := (0, r).

  Let T_positive : 0 < T.
  Proof. now apply period_positive. Qed.

  Let g_T : g * T = 2 * r.
  Proof. unfold T, period. field. lra. Qed.

  Lemma launch_back : fly g T launch = (0, - r).
  Proof. unfold fly, launch, height, velocity. cbn [fst snd]. f_equal; nra. Qed.

  (* ---------------------------------------------------------------- the table *)

  Lemma launch_height t : 0 < t < T -> 0 < height (fly g t launch).
  Proof.
    intro inside. unfold fly, launch, height, velocity. cbn [fst snd].
    replace (0 + r * t - g * t ^ 2 / 2) with (g / 2 * (t * (T - t))) by nra.
    apply Rmult_lt_0_compat; [lra|]. apply Rmult_lt_0_compat; lra.
  Qed.

  Section Table.
    Variable table : Motion.
    Hypothesis moves : is_table g r table.

    Lemma table_flies s p : 0 <= s -> 0 <= p < T -> surface_of table s = fly g p launch ->
      (forall t, s <= t < s + (T - p) -> surface_of table t = fly g (p + (t - s)) launch) /\ surface_of table (s + (T - p)) = launch.
    Proof.
      destruct moves as [[above falls apart] _]. intros late range now_.
      assert (step : forall t, s < t -> no_impact ground table s t -> table t = fly g (p + (t - s)) launch).
      { intros t less none. rewrite (falls s t) by (assumption || lra).
        change (after 1 (ground s) (table s)) with (surface_of table s). now rewrite now_, fly_fly. }
      assert (high : forall t, s < t < s + (T - p) -> no_impact ground table s t -> ~ meets (ground t) (table t)).
      { intros t inside none [touch _]. rewrite step in touch by (assumption || lra).
        pose proof (launch_height (p + (t - s)) ltac:(lra)). unfold ground, height at 2 in touch. cbn [fst] in touch. lra. }
      assert (none : no_impact ground table s (s + (T - p))).
      { apply no_impact_until; [|exact high]. intros m inside. apply apart. lra. }
      split.
      - intros t [from to]. destruct (Rle_lt_or_eq_dec s t from) as [less|same].
        + unfold surface_of. rewrite after_no_impact by (apply none; lra). apply step; [exact less|].
          apply (no_impact_part _ _ _ _ _ _ none); lra.
        + subst t. now rewrite Rminus_diag_eq, Rplus_0_r.
      - unfold surface_of. rewrite step by (assumption || lra). replace (p + (s + (T - p) - s)) with T by ring.
        rewrite launch_back, after_impact by (unfold meets, ground, height, velocity; cbn [fst snd]; lra).
        unfold rebound, ground, launch, height, velocity. cbn [fst snd]. f_equal. ring.
    Qed.

    Lemma table_phase : exists p, 0 <= p < T /\ surface_of table 0 = fly g p launch.
    Proof.
      destruct moves as [[above _ _] level]. pose proof (above 0 (Rle_refl 0)) as high. unfold surface_of.
      destruct (table 0) as [h u]. unfold energy, ground, height, velocity in *. cbn [fst snd] in *.
      assert (bound : - r <= u <= r) by nra.
      destruct (meets_dec (0, 0) (h, u)) as [hit|free].
      - exists 0. split; [lra|]. rewrite fly_0, after_impact by exact hit. destruct hit as [touch down].
        unfold height, velocity in *. cbn [fst snd] in *. unfold rebound, launch, height, velocity. cbn [fst snd]. f_equal; nra.
      - assert (faster : - r < u).
        { apply Rnot_le_lt. intro slow. apply free. unfold meets, height, velocity. cbn [fst snd]. split; nra. }
        exists ((r - u) / g). assert (back : g * ((r - u) / g) = r - u) by (field; lra).
        set (p := (r - u) / g) in *. split; [split; nra|].
        rewrite after_no_impact by exact free. unfold fly, launch, height, velocity. cbn [fst snd].
        f_equal; [|lra]. apply Rmult_eq_reg_l with g; [|lra].
        replace (g * (0 + r * p - g * p ^ 2 / 2)) with (r * (g * p) - (g * p) ^ 2 / 2) by field. rewrite back. nra.
    Qed.

    (* The bounces are at start + k T, and from each on the table is the paper's. *)
    Theorem table_has_period : exists start, - T < start <= 0 /\
      forall k t, 0 <= t < T -> 0 <= start + INR k * T + t -> surface_of table (start + INR k * T + t) = fly g t launch.
    Proof.
      destruct table_phase as (p & range & first). exists (- p). split; [lra|].
      assert (all : forall k, surface_of table (- p + INR (S k) * T) = launch /\ forall t, 0 <= t < T -> 0 <= - p + INR k * T + t ->
        surface_of table (- p + INR k * T + t) = fly g t launch).
      { intro k. induction k as [|k [again _]].
        - destruct (table_flies 0 p (Rle_refl 0) range first) as [during next]. split.
          + rewrite <- next. f_equal. cbn. ring.
          + intros t inside late. cbn [INR] in *. rewrite during by lra. f_equal. ring.
        - pose proof (pos_INR k) as natural. rewrite <- (fly_0 g launch) in again.
          destruct (table_flies (- p + INR (S k) * T) 0) as [during next]; [rewrite S_INR; nra|lra|exact again|]. split.
          + rewrite <- next. f_equal. rewrite (S_INR (S k)). ring.
          + intros t inside late. rewrite during by lra. f_equal. ring. }
      intro k. exact (proj2 (all k)).
    Qed.
  End Table.

  (* ---------------------------------------------------------------- the ball in one period *)

  (* Above the table, or on it, at the time p of the period, unless the ball has met the table before. *)
  Definition above_at (p : R) (b : State) : Prop := 0 <= height b + (velocity b - r) * p.

  Lemma above_at_0 b : above_ground b -> above_at 0 b.
  Proof. unfold above_at, above_ground. lra. Qed.

  Variable alpha : R.
  Hypothesis alpha_positive : 0 < alpha.

  Lemma strikes_is b : strikes r g b <-> height b < (r - velocity b) * T.
  Proof. unfold strikes. split; intro less; nra. Qed.

  Lemma contact p b : 0 <= p < T -> above_at p b -> strikes r g b ->
    velocity b < r /\ 0 <= height b /\ p <= contact_time r b < T /\ height b = (r - velocity b) * contact_time r b.
  Proof.
    unfold above_at. intros range above hits. apply strikes_is in hits. assert (falls : velocity b < r) by nra.
    assert (same : height b = (r - velocity b) * contact_time r b) by (unfold contact_time; field; lra).
    set (c := contact_time r b) in *. repeat split; [exact falls|nra|nra|nra|exact same].
  Qed.

  (* The ball at a time of a period, by the three cases. *)
  Lemma in_period_before b t : ~ (strikes r g b /\ contact_time r b < t) -> in_period alpha r g b t = fly g t b.
  Proof.
    intro not_after. unfold in_period. destruct (Rlt_dec (_ + _) _) as [hits|]; [|reflexivity].
    destruct (Rlt_dec _ _) as [later|]; [|reflexivity]. destruct not_after. now split.
  Qed.

  Lemma in_period_after b t : strikes r g b -> contact_time r b < t -> in_period alpha r g b t = fly g t (reflected alpha r b).
  Proof.
    intros hits later. unfold in_period. destruct (Rlt_dec (_ + _) _) as [|no]; [|destruct (no hits)].
    destruct (Rlt_dec _ _); [reflexivity|contradiction].
  Qed.

  Lemma in_period_start p b : 0 <= p < T -> above_at p b -> in_period alpha r g b p = fly g p b.
  Proof.
    intros range above. apply in_period_before. intros [hits less]. destruct (contact p b range above hits) as (_ & _ & low & _).
    lra.
  Qed.

  Lemma in_period_T p b : 0 <= p < T -> above_at p b -> in_period alpha r g b T = ball alpha r g b.
  Proof.
    intros range above. unfold ball. destruct (Rlt_dec (_ + _) _) as [hits|flies].
    - rewrite in_period_after; [|exact hits|apply (contact p b range above hits)].
      unfold fly, reflected, f_1, T, period, height, velocity. cbn [fst snd]. f_equal; field; lra.
    - rewrite in_period_before by (intros [hits _]; exact (flies hits)).
      unfold fly, f_2, T, period, height, velocity. cbn [fst snd]. f_equal; field; lra.
  Qed.

  Lemma meets_launch t b : meets (fly g t launch) (fly g t b) <-> height b = (r - velocity b) * t /\ velocity b < r.
  Proof. unfold meets, fly, launch, height, velocity. cbn [fst snd]. split; intros []; split; lra. Qed.

  (* An impact happens at the contact time, where the ball strikes, and at no other time of the period. *)
  Lemma one_impact p b t : 0 <= p < T -> above_at p b -> p <= t < T ->
    meets (fly g t launch) (in_period alpha r g b t) <-> strikes r g b /\ t = contact_time r b.
  Proof.
    intros range above inside. split.
    - intro hit. destruct (Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)) as [hits|no].
      + destruct (contact p b range above hits) as (falls & _ & _ & same). split; [exact hits|].
        destruct (Rlt_dec (contact_time r b) t) as [later|].
        * rewrite in_period_after in hit by assumption. apply meets_launch in hit as [_ slow].
          unfold reflected, velocity in slow. cbn [snd] in slow. fold (velocity b) in slow. nra.
        * rewrite in_period_before in hit by tauto. apply meets_launch in hit as [touch _]. nra.
      + rewrite in_period_before in hit by (intros [hits _]; exact (no hits)). apply meets_launch in hit as [touch falls].
        destruct no. apply strikes_is. rewrite touch. apply Rmult_lt_compat_l; lra.
    - intros [hits same]. destruct (contact p b range above hits) as (falls & _ & _ & touch).
      rewrite in_period_before by (intros [_ later]; lra). apply meets_launch. split; [|exact falls]. now rewrite same.
  Qed.

  Lemma rebound_is_reflected b t : height b = (r - velocity b) * t ->
    rebound alpha (fly g t launch) (fly g t b) = fly g t (reflected alpha r b).
  Proof.
    intro touch. unfold rebound, fly, launch, reflected, height, velocity in *. cbn [fst snd] in *. rewrite touch. f_equal; ring.
  Qed.

  (* in_period obeys the law of flight and impact. *)
  Lemma in_period_flies p b s t : 0 <= p < T -> above_at p b -> p <= s < t -> t <= T ->
    (forall time, s < time < t -> ~ meets (fly g time launch) (in_period alpha r g b time)) ->
    in_period alpha r g b t = fly g (t - s) (after alpha (fly g s launch) (in_period alpha r g b s)).
  Proof.
    intros range above first last none.
    assert (free : ~ (strikes r g b /\ s < contact_time r b < t)).
    { intros [hits inside]. apply (none (contact_time r b) inside), (one_impact p); auto; lra. }
    assert (compose : forall c, fly g (t - s) (fly g s c) = fly g t c) by (intro c; rewrite fly_fly; f_equal; ring).
    destruct (meets_dec (fly g s launch) (in_period alpha r g b s)) as [hit|apart].
    - rewrite after_impact by exact hit. apply (one_impact p) in hit as [hits same]; [|assumption|assumption|lra].
      rewrite in_period_after, in_period_before by (intros [_ later]; lra) || exact hits || lra.
      rewrite rebound_is_reflected by (rewrite same; apply (contact p b range above hits)). now rewrite compose.
    - rewrite after_no_impact by exact apart. rewrite (one_impact p) in apart by (assumption || lra).
      destruct (Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)) as [hits|no]; [destruct (Rlt_dec (contact_time r b) s) as [past|]|].
      + rewrite !in_period_after by (exact hits || lra). now rewrite compose.
      + rewrite !in_period_before; [now rewrite compose|intros []; lra|].
        intros [_ later]. destruct (Req_dec s (contact_time r b)) as [same|]; [tauto|]. apply free. split; [exact hits|lra].
      + rewrite !in_period_before by (intros [hits _]; exact (no hits)). now rewrite compose.
  Qed.

  Lemma in_period_above p b t : 0 <= p < T -> above_at p b -> p <= t <= T -> height (fly g t launch) <= height (in_period alpha r g b t).
  Proof.
    intros range above inside. destruct (Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)) as [hits|no].
    - destruct (contact p b range above hits) as (falls & high & _ & touch). set (c := contact_time r b) in *.
      destruct (Rlt_dec c t) as [later|early].
      + rewrite in_period_after by assumption. unfold fly, reflected, launch, height, velocity in *. cbn [fst snd] in *.
        rewrite touch.
        assert (0 <= alpha * ((r - snd b) * (t - c))) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]). lra.
      + rewrite in_period_before by tauto. unfold fly, launch, height, velocity in *. cbn [fst snd] in *. nra.
    - rewrite in_period_before by (intros [hits _]; exact (no hits)). unfold above_at in above.
      assert (far : (r - velocity b) * T <= height b) by (apply Rnot_lt_le; intro hits; now apply no, strikes_is).
      unfold fly, launch, height, velocity in *. cbn [fst snd] in *. destruct (Rle_dec r (snd b)); nra.
  Qed.

  (* ---------------------------------------------------------------- an execution of the ball from one bounce to the next *)

  (* The period begins at s; from the time p of it on, the ball is in an execution. *)
  Section Ball.
    Variables surface body : Motion.
    Variables (s p : R) (b : State).
    Hypothesis moves : execution g alpha surface body.
    Hypothesis range : 0 <= p < T.
    Hypothesis late : 0 <= s + p.
    Hypothesis table_is : forall t, p <= t < T -> surface (s + t) = fly g t launch.
    Hypothesis above : above_at p b.
    Hypothesis start : body (s + p) = fly g p b.

    Lemma from_here m e : p <= m < e -> e <= T -> body (s + m) = in_period alpha r g b m -> ~ (strikes r g b /\ m < contact_time r b < e) ->
      forall t, m < t <= e -> body (s + t) = in_period alpha r g b t.
    Proof.
      destruct moves as [_ flight apart]. intros order last now_ free.
      assert (all : forall t, m < t <= e -> no_impact surface body (s + m) (s + t) ->
        body (s + t) = fly g (t - m) (after alpha (fly g m launch) (in_period alpha r g b m))).
      { intros t inside none. rewrite (flight (s + m) (s + t)), table_is, now_ by (assumption || lra). f_equal. ring. }
      assert (same : forall t, m < t <= e ->
        in_period alpha r g b t = fly g (t - m) (after alpha (fly g m launch) (in_period alpha r g b m))).
      { intros t inside. apply (in_period_flies p); try (assumption || lra). intros time between hit.
        apply (one_impact p) in hit as [hits at_]; [|assumption|assumption|lra]. apply free. split; [exact hits|lra]. }
      assert (none : no_impact surface body (s + m) (s + e)).
      { apply no_impact_until; [intros; apply apart; lra|]. intros t inside none hit.
        replace t with (s + (t - s)) in hit, none by ring. rewrite all, <- same, table_is in hit by (assumption || lra).
        apply (one_impact p) in hit as [hits at_]; [|assumption|assumption|lra]. apply free. split; [exact hits|lra]. }
      intros t inside. rewrite all, <- same; [reflexivity|exact inside|exact inside|].
      apply (no_impact_part _ _ _ _ _ _ none); lra.
    Qed.

    Theorem ball_in_period t : p <= t <= T -> body (s + t) = in_period alpha r g b t.
    Proof.
      assert (first : body (s + p) = in_period alpha r g b p) by now rewrite in_period_start.
      assert (go : forall m e, p <= m <= e -> e <= T -> body (s + m) = in_period alpha r g b m ->
        ~ (strikes r g b /\ m < contact_time r b < e) -> forall t, m <= t <= e -> body (s + t) = in_period alpha r g b t).
      { intros m e order last now_ free u [low high]. destruct (Rle_lt_or_eq_dec m u low) as [less|same]; [|now subst u].
        apply (from_here m e); try assumption; lra. }
      intro inside. destruct (Rlt_dec (height b * g / 2 + r * velocity b) (r ^ 2)) as [hits|no].
      - destruct (contact p b range above hits) as (_ & _ & between & _). set (c := contact_time r b) in *.
        assert (until : forall u, p <= u <= c -> body (s + u) = in_period alpha r g b u) by (apply go; try assumption; fold c; lra).
        destruct (Rle_dec t c) as [before|past]; [apply until; lra|].
        apply (go c T); [lra|lra|apply until; lra|fold c; lra|lra].
      - apply (go p T); try (assumption || lra). intros [hits _]. exact (no hits).
    Qed.
  End Ball.
End Bouncing.
