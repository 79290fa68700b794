(* Where a flight lands, and how this depends on its start.

   Defined:  landing, the greatest phase up to which the ball has been on or above the table.
   Proved:   flies_from    a ball that takes off flies, and lands at the landing;
             takes_off     it does so with a speed above that of the table, or where S > 1;
             steady        two flights that start close to each other, and end with closing speeds >= low > 0, end close to each other;
             first_order   the ends of two flights differ by the derivatives of the implicit function theorem, and a rest of second order. *)

From Coq Require Import Reals Lra Lia.
From Juggleproof Require Import SineMean SineTable SineMotions.
Open Scope R_scope.

Lemma product_within a b A B : - A <= a <= A -> - B <= b <= B -> - (A * B) <= a * b <= A * B.
Proof. intros. split; nra. Qed.

Section Landing.
  Variables alpha g : R.
  Local Notation height := (height alpha g).
  Local Notation velocity := (velocity alpha g).
  Local Notation downward := (downward alpha g).
  Local Notation rebound := (rebound alpha g).
  Local Notation gap := (gap alpha g).
  Local Notation arrival := (arrival alpha g).
  Local Notation flight := (flight alpha g).

  Lemma waves_within a b x : - (Rabs a + Rabs b) <= wave a b x <= Rabs a + Rabs b.
  Proof.
    unfold wave. pose proof (SIN_bound (2 * PI * x)). pose proof (COS_bound (2 * PI * x)).
    assert (- Rabs a <= a <= Rabs a) by (pose proof (Rle_abs a); pose proof (Rle_abs (- a)); rewrite Rabs_Ropp in *; lra).
    assert (- Rabs b <= b <= Rabs b) by (pose proof (Rle_abs b); pose proof (Rle_abs (- b)); rewrite Rabs_Ropp in *; lra).
    pose proof (product_within a (sin (2 * PI * x)) (Rabs a) 1 ltac:(lra) ltac:(lra)).
    pose proof (product_within b (cos (2 * PI * x)) (Rabs b) 1 ltac:(lra) ltac:(lra)). lra.
  Qed.

  (* M bounds 1 - S, and V the velocity and the height. *)
  Lemma table_bounded : exists M V, 1 <= M /\ 0 <= V /\ forall y, - M <= 1 - downward y <= M /\ - V <= velocity y <= V /\ - V <= height y <= V.
  Proof.
    set (B := Rabs (half_gap alpha) + Rabs g). exists (1 + 2 * PI * B), (B + / (2 * PI) * B). pose proof PI_RGT_0 as pi.
    assert (positive : 0 <= B) by (unfold B; pose proof (Rabs_pos (half_gap alpha)); pose proof (Rabs_pos g); lra).
    assert (inverse : 0 < / (2 * PI)) by (apply Rinv_0_lt_compat; lra).
    assert (part : 0 <= 2 * PI * B /\ 0 <= / (2 * PI) * B) by (split; apply Rmult_le_pos; lra).
    split; [lra|]. split; [lra|]. intro y. pose proof (waves_within (half_gap alpha) g y) as one. fold B in one.
    pose proof (waves_within (- g) (half_gap alpha) y) as two. rewrite Rabs_Ropp, Rplus_comm in two. fold B in two.
    unfold downward, velocity, height. pose proof (product_within (2 * PI) _ (2 * PI) B ltac:(lra) one).
    pose proof (product_within (/ (2 * PI)) _ (/ (2 * PI)) B ltac:(lra) one). lra.
  Qed.

  (* ---------------------------------------------------------------- there is a flight *)

  Definition airborne (z : Impact) (t : R) : Prop := fst z <= t /\ forall y, fst z <= y <= t -> 0 <= gap z y.

  Lemma airborne_start z : exists t, airborne z t.
  Proof. exists (fst z). split; [lra|]. intros y inside. replace y with (fst z) by lra. rewrite gap_start. lra. Qed.

  Lemma airborne_bounded z : bound (airborne z).
  Proof.
    destruct table_bounded as (M & V & _ & V_positive & bounds).
    set (d := 2 * (Rabs (rebound z) + 2 * V + 1)). pose proof (Rabs_pos (rebound z)). pose proof (Rle_abs (rebound z)).
    assert (d_large : 2 <= d) by (unfold d; lra). exists (fst z + d). intros t [later high].
    apply Rnot_lt_le. intro beyond. specialize (high (fst z + d) ltac:(lra)). unfold SineTable.gap in high.
    pose proof (proj2 (proj2 (bounds (fst z)))). pose proof (proj2 (proj2 (bounds (fst z + d)))).
    replace (fst z + d - fst z) with d in high by ring.
    assert (d ^ 2 / 2 = d * (Rabs (rebound z) + 2 * V + 1)) as equal by (unfold d; field).
    rewrite equal in high. nra.
  Qed.

  Definition landing (z : Impact) : R := proj1_sig (completeness (airborne z) (airborne_bounded z) (airborne_start z)).
  Definition lands (z : Impact) : Impact := (landing z, arrival z (landing z)).

  Lemma gap_near z y e : 0 < e -> exists d, 0 < d /\ forall t, Rabs (t - y) < d -> Rabs (gap z t - gap z y) < e.
  Proof.
    intro positive. pose proof (continuous _ _ _ (gap_derivative alpha g z y)) as whole.
    destruct (whole e positive) as (d & d_positive & near). exists d. split; [exact d_positive|]. intros t close.
    destruct (Req_dec y t) as [<-|other]; [now rewrite Rminus_diag_eq, Rabs_R0|]. apply (near t). split; [now split|exact close].
  Qed.

  Theorem flies_from z h : 0 < h -> airborne z (fst z + h) -> flight z (lands z).
  Proof.
    intros positive up. unfold lands, landing. destruct (completeness _ _ _) as [b [above least]]. cbn [proj1_sig].
    pose proof (above _ up) as past.
    assert (before : forall y, fst z <= y < b -> 0 <= gap z y).
    { intros y inside. apply Rnot_lt_le. intro under. assert (top : is_upper_bound (airborne z) y).
      { intros t [_ high]. apply Rnot_lt_le. intro beyond. specialize (high y ltac:(lra)). lra. }
      specialize (least y top). lra. }
    assert (high : 0 <= gap z b).
    { apply Rnot_lt_le. intro under. destruct (gap_near z b (- gap z b) ltac:(lra)) as (d & d_positive & near).
      set (y := Rmax (fst z) (b - d / 2)).
      assert (inside : fst z <= y < b /\ b - d < y)
        by (unfold y; split; [split; [apply Rmax_l|apply Rmax_lub_lt; lra]|apply Rlt_le_trans with (b - d / 2); [lra|apply Rmax_r]]).
      specialize (before y (proj1 inside)). specialize (near y ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. lra. }
    assert (all : forall y, fst z <= y <= b -> 0 <= gap z y).
    { intros y inside. destruct (Req_dec y b) as [->|]; [exact high|apply before; lra]. }
    repeat split; cbn [fst snd]; [lra| |exact all]. apply Rle_antisym; [|exact high].
    apply Rnot_lt_le. intro over. destruct (gap_near z b (gap z b) over) as (d & d_positive & near).
    assert (more : airborne z (b + d / 2)); [|pose proof (above _ more); lra].
    split; [lra|]. intros y inside. destruct (Rle_dec y b) as [yes|no]; [apply all; lra|].
    specialize (near y ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. lra.
  Qed.

  Theorem takes_off z : 0 <= alpha * snd z -> 0 < alpha * snd z \/ 1 < downward (fst z) -> exists h, 0 < h /\ airborne z (fst z + h).
  Proof.
    intros slow either. destruct table_bounded as (M & V & M_large & _ & bounds).
    assert (enough : exists h, 0 < h /\ forall m k, fst z <= k <= m -> m <= fst z + h -> 0 <= alpha * snd z + (downward k - 1) * (m - fst z)).
    { destruct either as [fast|falls].
      - exists (alpha * snd z / M). split; [apply Rdiv_lt_0_compat; lra|]. intros m k order early.
        pose proof (bounds k) as [near _]. assert (equal : alpha * snd z = alpha * snd z / M * M) by (field; lra).
        set (h := alpha * snd z / M) in *. rewrite equal. nra.
      - destruct (stays_near alpha g (fst z) (downward (fst z) - 1) ltac:(lra)) as (d & positive & near). exists (d / 2). split; [lra|].
        intros m k order early. specialize (near k ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. nra. }
    destruct enough as (h & positive & holds). exists h. split; [exact positive|]. split; [lra|]. intros y inside.
    destruct (Rle_lt_or_eq_dec _ _ (proj1 inside)) as [less|<-]; [|rewrite gap_start; lra].
    destruct (mean_value_between _ _ _ _ less (gap_derivative alpha g z)) as (m & m_inside & equal).
    destruct (mean_value _ _ (fst z) m (arrival_derivative alpha g z)) as (k & k_inside & equal_).
    rewrite gap_start in equal. rewrite arrival_start in equal_. specialize (holds m k ltac:(lra) ltac:(lra)).
    replace (gap z y) with (- arrival z m * (y - fst z)) by lra. apply Rmult_le_pos; lra.
  Qed.

  (* ---------------------------------------------------------------- two flights *)

  Hypothesis alpha_range : 0 <= alpha < 1.
  Variables M V : R.
  Hypothesis M_large : 1 <= M.
  Hypothesis V_positive : 0 <= V.
  Hypothesis bounds : forall y, - M <= 1 - downward y <= M /\ - V <= velocity y <= V /\ - V <= height y <= V.
  Variables weight high low : R.
  Hypothesis weight_positive : 0 < weight.
  Hypothesis low_positive : 0 < low.

  (* The states that are looked at, and the phases where they land. *)
  Definition nearby (z : Impact) : Prop := - (1 / 4) <= fst z <= 1 / 4 /\ 0 <= snd z <= high.
  Definition apart (d : R) (z w : Impact) : Prop := - d <= fst w - fst z <= d /\ - (weight * d) <= snd w - snd z <= weight * d.

  Definition gap_change : R := 2 * V + high + 2 * (M + 1 + weight) + 2.

  Lemma velocity_change a b d : - d <= b - a <= d -> - ((M + 1) * d) <= velocity b - velocity a <= (M + 1) * d.
  Proof.
    intro near. destruct (mean_value velocity _ a b (velocity_derivative alpha g)) as (m & _ & ->).
    apply product_within; [|exact near]. destruct (bounds m). lra.
  Qed.

  Lemma gap_changes d z w y : nearby z -> nearby w -> apart d z w -> 1 / 2 <= y <= 3 / 2 -> gap w y - gap z y <= gap_change * d.
  Proof.
    intros [z_place z_speed] [w_place w_speed] [near close] inside. unfold SineTable.gap, SineTable.rebound.
    destruct (mean_value height velocity (fst z) (fst w) (height_derivative alpha g)) as (m & _ & equal).
    pose proof (product_within _ _ V d (proj1 (proj2 (bounds m))) near). rewrite <- equal in *.
    pose proof (velocity_change _ _ _ near) as v_change. pose proof (bounds (fst z)) as (_ & v_z & _).
    assert (u_change : - ((M + 1 + weight) * d) <= velocity (fst w) - velocity (fst z) + alpha * (snd w - snd z) <= (M + 1 + weight) * d).
    { pose proof (product_within alpha _ 1 _ ltac:(lra) close). lra. }
    pose proof (product_within _ (y - fst w) _ 2 u_change ltac:(lra)) as first.
    assert (u_bound : - (V + high) <= velocity (fst z) + alpha * snd z <= V + high)
      by (pose proof (product_within alpha (snd z) 1 high ltac:(lra) ltac:(lra)); lra).
    pose proof (product_within _ _ _ _ u_bound near) as second.
    pose proof (product_within ((y - fst w + (y - fst z)) / 2) _ 2 d ltac:(lra) near) as third.
    unfold gap_change. lra.
  Qed.

  Lemma steady_one_way d h z w z' w' : nearby z -> nearby z' -> apart d z' z -> flight z w -> flight z' w' -> low <= snd w' ->
    1 / 2 <= fst w' -> fst w <= 3 / 2 -> 0 < h -> h * (2 * M) <= low -> gap_change * d < low * h / 2 -> fst w < fst w' + h.
  Proof.
    intros near near' close (_ & _ & above & _) (_ & zero & _ & speed) fast place place' positive short little.
    apply Rnot_le_lt. intro beyond. set (y := fst w' + h) in *.
    pose proof (above y ltac:(unfold nearby in *; unfold y in *; lra)) as not_under.
    pose proof (gap_changes d z' z y near' near close ltac:(unfold y in *; lra)) as change.
    destruct (mean_value_between _ _ (fst w') y ltac:(unfold y; lra) (gap_derivative alpha g z')) as (m & m_inside & equal).
    destruct (mean_value _ _ (fst w') m (arrival_derivative alpha g z')) as (k & k_inside & equal_).
    rewrite zero in equal. rewrite <- speed in equal_. unfold y in *.
    assert (M * h <= low / 2) by lra.
    pose proof (product_within (1 - downward k) (m - fst w') M h ltac:(destruct (bounds k); lra) ltac:(lra)).
    pose proof (Rmult_le_compat_r h (low / 2) (arrival z' m) ltac:(lra) ltac:(lra)). lra.
  Qed.

  Definition spread : R := 3 * gap_change / low.

  Theorem steady d z w z' w' : nearby z -> nearby z' -> apart d z z' -> flight z w -> flight z' w' -> low <= snd w -> low <= snd w' ->
    1 / 2 <= fst w <= 3 / 2 -> 1 / 2 <= fst w' <= 3 / 2 -> 0 < d -> spread * d * (2 * M) <= low -> - (spread * d) <= fst w' - fst w <= spread * d.
  Proof.
    intros near near' close flown flown' fast fast' place place' positive short.
    assert (back : apart d z' z) by (unfold apart in *; lra).
    assert (change_positive : 0 < gap_change) by (unfold gap_change, nearby in *; lra).
    assert (spread_is : spread * low = 3 * gap_change) by (unfold spread; field; lra).
    assert (spread_positive : 0 < spread) by (unfold spread; apply Rdiv_lt_0_compat; lra).
    assert (h_positive : 0 < spread * d) by now apply Rmult_lt_0_compat.
    assert (little : gap_change * d < low * (spread * d) / 2).
    { replace (low * (spread * d) / 2) with (spread * low * d / 2) by field. rewrite spread_is.
      assert (0 < gap_change * d) by now apply Rmult_lt_0_compat. lra. }
    pose proof (steady_one_way d (spread * d) z w z' w' near near' back flown flown' fast' (proj1 place') (proj2 place) h_positive short little).
    pose proof (steady_one_way d (spread * d) z' w' z w near' near close flown' flown fast (proj1 place) (proj2 place') h_positive short little). lra.
  Qed.

  (* ---------------------------------------------------------------- to first order *)

  Lemma height_second_order a b : exists e, height b - height a = velocity a * (b - a) + e /\ - ((M + 1) * (b - a) ^ 2) <= e <= (M + 1) * (b - a) ^ 2.
  Proof.
    destruct (mean_value height velocity a b (height_derivative alpha g)) as (m & place & equal).
    exists ((velocity m - velocity a) * (b - a)). split; [rewrite equal; ring|].
    pose proof (velocity_change a m (Rabs (b - a)) ltac:(unfold Rabs; destruct (Rcase_abs (b - a)); lra)) as near.
    replace ((M + 1) * (b - a) ^ 2) with ((M + 1) * Rabs (b - a) * Rabs (b - a))
      by (unfold Rabs; destruct (Rcase_abs (b - a)); ring).
    apply product_within; [exact near|]. unfold Rabs. destruct (Rcase_abs (b - a)); lra.
  Qed.

  Definition curvature : R := (M + 1) * (1 + spread ^ 2) + (M + 1 + weight) * (spread + 1) + (spread + 1) ^ 2 / 2.

  Theorem first_order d z w z' w' : 0 < d -> 0 < spread -> apart d z z' -> flight z w -> flight z' w' -> - (spread * d) <= fst w' - fst w <= spread * d ->
    exists p q rest, (fst z <= p <= fst z' \/ fst z' <= p <= fst z) /\ (fst w <= q <= fst w' \/ fst w' <= q <= fst w) /\
    snd w * (fst w' - fst w) = ((fst w - fst z) * (1 - downward p) - alpha * snd z) * (fst z' - fst z) + alpha * (fst w - fst z) * (snd z' - snd z) + rest /\
    snd w' - snd w = (1 - downward q) * (fst w' - fst w) - (1 - downward p) * (fst z' - fst z) - alpha * (snd z' - snd z) /\
    - (curvature * d ^ 2) <= rest <= curvature * d ^ 2.
  Proof.
    intros positive wide [near close] (_ & zero & _ & speed) (_ & zero' & _ & speed') move.
    destruct (mean_value velocity _ (fst z) (fst z') (velocity_derivative alpha g)) as (p & p_place & p_is).
    destruct (mean_value velocity _ (fst w) (fst w') (velocity_derivative alpha g)) as (q & q_place & q_is).
    destruct (height_second_order (fst z) (fst z')) as (e & e_is & e_small). destruct (height_second_order (fst w) (fst w')) as (f & f_is & f_small).
    rewrite speed, speed'. unfold SineTable.gap, SineTable.arrival, SineTable.rebound in *.
    set (dx := fst z' - fst z) in *. set (ds := snd z' - snd z) in *. set (dy := fst w' - fst w) in *.
    exists p, q, (e - f + (- downward p * dx + alpha * ds) * (dy - dx) - (dy - dx) ^ 2 / 2).
    split; [exact p_place|]. split; [exact q_place|]. split; [|split].
    - assert (fst z' = fst z + dx) as x_is by (unfold dx; ring). assert (snd z' = snd z + ds) as s_is by (unfold ds; ring).
      assert (fst w' = fst w + dy) as y_is by (unfold dy; ring).
      assert (velocity (fst z') = velocity (fst z) + - downward p * dx) as v_is by lra.
      assert (height (fst z') = height (fst z) + velocity (fst z) * dx + e) as h_is by lra.
      assert (height (fst w') = height (fst w) + velocity (fst w) * dy + f) as k_is by lra.
      rewrite v_is, h_is, k_is, s_is in zero'. rewrite x_is, y_is in zero'. lra.
    - unfold dy, dx, ds in *. lra.
    - pose proof (product_within dx dx d d near near). pose proof (product_within dy dy _ _ move move).
      assert (M_positive : 0 <= M + 1) by lra.
      assert ((M + 1) * dx ^ 2 <= (M + 1) * d ^ 2) by (apply Rmult_le_compat_l; lra).
      assert ((M + 1) * dy ^ 2 <= (M + 1) * (spread * d) ^ 2) by (apply Rmult_le_compat_l; lra).
      pose proof (product_within (- downward p) dx (M + 1) d ltac:(destruct (bounds p); lra) near).
      pose proof (product_within alpha ds 1 (weight * d) ltac:(lra) close).
      assert (turn : - ((spread + 1) * d) <= dy - dx <= (spread + 1) * d) by lra.
      pose proof (product_within (- downward p * dx + alpha * ds) (dy - dx) ((M + 1 + weight) * d) ((spread + 1) * d) ltac:(lra) turn).
      pose proof (product_within _ _ _ _ turn turn) as square. pose proof (pow2_ge_0 (dy - dx)) as square_.
      replace (curvature * d ^ 2) with ((M + 1) * d ^ 2 + (M + 1) * (spread * d) ^ 2 + (M + 1 + weight) * d * ((spread + 1) * d) +
        (spread + 1) * d * ((spread + 1) * d) / 2) by (unfold curvature; field).
      replace ((dy - dx) ^ 2) with ((dy - dx) * (dy - dx)) in * by ring. fold dx in e_small. fold dy in f_small.
      set (a1 := (M + 1) * dx ^ 2) in *. set (a2 := (M + 1) * dy ^ 2) in *. lra.
  Qed.
End Landing.
