(* A ball on a table that moves as a sine: the flight from one impact to the next.
   Units: time in periods of the table, heights in g times the square of a period; the phase is 0 at the period-one bounce.

   Defined:  height, velocity, downward (P, v and S: where S > 1 the table falls faster than the ball); gap (F, the height of the ball
             above the table after an impact); arrival (the closing speed); flight, the relation from impact to impact; bounce.
   Proved:   height' = velocity, velocity' = - downward, gap' = - arrival, arrival' = 1 - downward, and all have the period 1;
             arrives           a flight ends with a closing speed >= 0;
             falls_behind      no flight ends within an interval on which S > 1;
             speed_by_time     a short flight ends with a small closing speed;
             rises_once        where S rises through 1, it stays above 1 until the end of any arc that ends with S > 1;
             bounce_returns    the bounce solves the equations of a flight of one period, for every alpha and g;
             one_period        and so does, of the states with S > 0 and less than half a period away, no other. *)

From Coq Require Import Reals Lra.
From Juggleproof Require Import SineMean.
Open Scope R_scope.

(* An impact: its phase, counted on over periods, and its closing speed. *)
Definition Impact : Type := R * R.

Definition wave (a b x : R) : R := a * sin (2 * PI * x) + b * cos (2 * PI * x).

Section Table.
  Variables alpha g : R.

  Definition half_gap : R := (1 - alpha) / (2 * (1 + alpha)).
  Definition height (x : R) : R := / (2 * PI) * wave half_gap g x.
  Definition velocity (x : R) : R := wave (- g) half_gap x.
  Definition downward (x : R) : R := 2 * PI * wave half_gap g x.

  (* After the impact z the ball leaves with the velocity of the table and alpha times the closing speed. *)
  Definition rebound (z : Impact) : R := velocity (fst z) + alpha * snd z.
  Definition gap (z : Impact) (y : R) : R := height (fst z) - height y + rebound z * (y - fst z) - (y - fst z) ^ 2 / 2.
  Definition arrival (z : Impact) (y : R) : R := (y - fst z) + velocity y - rebound z.

  (* The next impact is at a zero of the gap, which is >= 0 before: touches on the way may count as impacts, or not. *)
  Definition flight (z w : Impact) : Prop :=
    fst z < fst w /\ gap z (fst w) = 0 /\ (forall y, fst z <= y <= fst w -> 0 <= gap z y) /\ snd w = arrival z (fst w).

  Definition bounce : Impact := (0, 1 / (1 + alpha)).

  (* ---------------------------------------------------------------- derivatives *)

  Lemma derivative_is f x l m : derivable_pt_lim f x l -> l = m -> derivable_pt_lim f x m.
  Proof. now intros is <-. Qed.

  Lemma scaled_derivative k x : derivable_pt_lim (fun y => k * y) x k.
  Proof. apply (derivative_is _ x (k * 1)); [|ring]. exact (derivable_pt_lim_scal id k x 1 (derivable_pt_lim_id x)). Qed.

  Lemma wave_derivative a b x : derivable_pt_lim (wave a b) x (wave (- (2 * PI * b)) (2 * PI * a) x).
  Proof.
    set (k := 2 * PI).
    assert (s : derivable_pt_lim (fun y => sin (k * y)) x (cos (k * x) * k)).
    { exact (derivable_pt_lim_comp (fun y => k * y) sin x k _ (scaled_derivative k x) (derivable_pt_lim_sin (k * x))). }
    assert (d : derivable_pt_lim (fun y => cos (k * y)) x (- sin (k * x) * k)).
    { exact (derivable_pt_lim_comp (fun y => k * y) cos x k _ (scaled_derivative k x) (derivable_pt_lim_cos (k * x))). }
    eapply derivative_is.
    - exact (derivable_pt_lim_plus _ _ x _ _ (derivable_pt_lim_scal _ a x _ s) (derivable_pt_lim_scal _ b x _ d)).
    - unfold wave. fold k. ring.
  Qed.

  Lemma height_derivative x : derivable_pt_lim height x (velocity x).
  Proof.
    eapply derivative_is; [exact (derivable_pt_lim_scal _ (/ (2 * PI)) x _ (wave_derivative _ _ x))|].
    unfold velocity, wave. field. exact PI_neq0.
  Qed.

  Lemma velocity_derivative x : derivable_pt_lim velocity x (- downward x).
  Proof. eapply derivative_is; [exact (wave_derivative _ _ x)|]. unfold downward, wave. ring. Qed.

  Lemma square_derivative b x : derivable_pt_lim (fun y => (y - b) ^ 2 / 2) x (x - b).
  Proof.
    assert (half : derivable_pt_lim (fun y => (1 * (y - b)) * (/ 2 * (y - b))) x (1 * (/ 2 * (x - b)) + 1 * (x - b) * / 2))
      by exact (derivable_pt_lim_mult _ _ x _ _ (line_derivative 1 b x) (line_derivative (/ 2) b x)).
    intros e positive. destruct (half e positive) as [d near]. exists d. intros h other small.
    specialize (near h other small). replace (x - b) with (1 * (/ 2 * (x - b)) + 1 * (x - b) * / 2) at 2 by field.
    replace ((x + h - b) ^ 2 / 2 - (x - b) ^ 2 / 2) with
      (1 * (x + h - b) * (/ 2 * (x + h - b)) - 1 * (x - b) * (/ 2 * (x - b))) by field. exact near.
  Qed.

  Lemma gap_derivative z y : derivable_pt_lim (gap z) y (- arrival z y).
  Proof.
    eapply derivative_is; [exact (derivable_pt_lim_minus _ _ y _ _ (derivable_pt_lim_plus _ _ y _ _
      (derivable_pt_lim_minus (fct_cte (height (fst z))) height y _ _ (derivable_pt_lim_const _ y) (height_derivative y))
      (line_derivative (rebound z) (fst z) y)) (square_derivative (fst z) y))|].
    unfold arrival. ring.
  Qed.

  Lemma arrival_derivative z y : derivable_pt_lim (arrival z) y (1 - downward y).
  Proof.
    assert (line : derivable_pt_lim (fun y => y - fst z) y 1).
    { eapply derivative_is; [exact (derivable_pt_lim_minus id (fct_cte (fst z)) y _ _ (derivable_pt_lim_id y) (derivable_pt_lim_const _ y))|]. ring. }
    eapply derivative_is; [exact (derivable_pt_lim_minus _ (fct_cte (rebound z)) y _ _
      (derivable_pt_lim_plus _ _ y _ _ line (velocity_derivative y)) (derivable_pt_lim_const _ y))|]. ring.
  Qed.

  Lemma gap_start z : gap z (fst z) = 0.
  Proof. unfold gap. field. Qed.

  Lemma arrival_start z : arrival z (fst z) = - (alpha * snd z).
  Proof. unfold arrival, rebound. ring. Qed.

  Lemma continuous f f' x : derivable_pt_lim f x f' -> continuity_pt f x.
  Proof. intro is. apply derivable_continuous_pt. now exists f'. Qed.

  (* ---------------------------------------------------------------- single flights *)

  Lemma arrives z w : flight z w -> 0 <= snd w.
  Proof.
    intros (later & zero & above & ->). apply Rnot_lt_le. intro less.
    destruct (gap_derivative z (fst w) (- arrival z (fst w)) ltac:(lra)) as [d near].
    pose proof (cond_pos d) as positive. set (h := Rmin (d / 2) (fst w - fst z)).
    assert (small : 0 < h /\ h <= d / 2 /\ h <= fst w - fst z)
      by (unfold h; repeat split; [apply Rmin_glb_lt; lra|apply Rmin_l|apply Rmin_r]).
    specialize (near (- h) ltac:(lra)). rewrite Rabs_Ropp, Rabs_right in near by lra.
    specialize (near ltac:(lra)). rewrite zero in near. apply Rabs_def2 in near.
    pose proof (above (fst w + - h) ltac:(lra)) as high.
    assert (sign : (gap z (fst w + - h) - 0) / - h <= 0).
    { replace ((gap z (fst w + - h) - 0) / - h) with (- (gap z (fst w + - h) * / h)) by (field; lra).
      pose proof (Rmult_le_pos _ (/ h) high ltac:(apply Rlt_le, Rinv_0_lt_compat; lra)). lra. }
    lra.
  Qed.

  Lemma falls_behind z w : 0 <= alpha -> 0 <= snd z -> flight z w -> (forall y, fst z <= y <= fst w -> 1 < downward y) -> False.
  Proof.
    intros nonnegative slow (later & zero & _ & _) faster. pose proof (Rmult_le_pos _ _ nonnegative slow).
    assert (below : forall y, fst z <= y <= fst w -> arrival z y <= 0 /\ (fst z < y -> arrival z y < 0)).
    { intros y inside. destruct (mean_value _ _ (fst z) y (arrival_derivative z)) as (k & place & equal). rewrite arrival_start in equal.
      pose proof (faster k ltac:(lra)). split; [|intro past]; nra. }
    set (c := (fst z + fst w) / 2). assert (middle : fst z < c < fst w) by (unfold c; lra).
    destruct (mean_value_between _ _ _ _ (proj1 middle) (gap_derivative z)) as (m & place & equal).
    destruct (mean_value_between _ _ _ _ (proj2 middle) (gap_derivative z)) as (k & place_ & equal_).
    rewrite gap_start in equal. rewrite zero in equal_.
    pose proof (proj1 (below m ltac:(lra))). pose proof (proj2 (below k ltac:(lra)) ltac:(lra)). nra.
  Qed.

  Lemma speed_by_time z w bound : flight z w -> (forall y, Rabs (1 - downward y) <= bound) -> snd w <= bound * (fst w - fst z).
  Proof.
    intros (later & zero & _ & ->) bounded.
    destruct (mean_value_between _ _ _ _ later (gap_derivative z)) as (m & inside & equal). rewrite zero, gap_start in equal.
    destruct (mean_value _ _ m (fst w) (arrival_derivative z)) as (k & _ & equal_).
    assert (arrival z m = 0) by nra. pose proof (bounded k) as near. pose proof (Rle_abs (1 - downward k)).
    pose proof (Rabs_pos (1 - downward k)). nra.
  Qed.

  (* ---------------------------------------------------------------- periods *)

  Lemma wave_period a b x : wave a b (x + 1) = wave a b x.
  Proof.
    unfold wave. replace (2 * PI * (x + 1)) with (2 * PI * x + 2 * PI) by ring. rewrite sin_plus, cos_plus, sin_2PI, cos_2PI. ring.
  Qed.

  Lemma flight_period x s x1 s1 : flight (x + 1, s) (x1 + 1, s1) <-> flight (x, s) (x1, s1).
  Proof.
    assert (same : forall y, gap (x + 1, s) (y + 1) = gap (x, s) y).
    { intro y. unfold gap, rebound, height, velocity. cbn [fst snd]. rewrite !wave_period. f_equal; [f_equal; ring|f_equal; ring]. }
    assert (same_ : arrival (x + 1, s) (x1 + 1) = arrival (x, s) x1).
    { unfold arrival, rebound, velocity. cbn [fst snd]. rewrite !wave_period. ring. }
    unfold flight. cbn [fst snd]. rewrite same, same_. split; intros (later & zero & above & speed); repeat split; try (assumption || lra).
    - intros y inside. rewrite <- same. apply above. lra.
    - intros y inside. replace y with (y - 1 + 1) by ring. rewrite same. apply above. lra.
  Qed.

  Lemma downward_period x : downward (x + 1) = downward x.
  Proof. unfold downward. now rewrite wave_period. Qed.

  (* ---------------------------------------------------------------- where S rises through 1 *)

  Lemma rises_once b y e : downward b = 1 -> (forall d, 0 < d -> ~ forall z, b < z < b + d -> downward z <= 1) ->
    b < y <= e -> e < b + 1 -> 1 < downward e -> 1 < downward y.
  Proof.
    intros level rises order short high. pose proof PI_RGT_0 as pi. apply Rnot_le_lt. intro not_above.
    set (half := fun x => half_gap * cos (PI * (x + b)) - g * sin (PI * (x + b))).
    assert (product : forall x, downward x - 1 = 4 * PI * (sin (PI * (x - b)) * half x)).
    { intro x. rewrite <- level. unfold downward, wave, half.
      replace (2 * PI * x) with (PI * (x + b) + PI * (x - b)) by ring.
      replace (2 * PI * b) with (PI * (x + b) - PI * (x - b)) by ring.
      rewrite !sin_plus, !cos_plus, !sin_minus, !cos_minus. ring. }
    assert (between : forall p q, p < q < p + 1 -> 0 < sin (PI * (q - p))).
    { intros p q inside. apply sin_gt_0; [apply Rmult_lt_0_compat; lra|]. rewrite <- (Rmult_1_r PI) at 2. apply Rmult_lt_compat_l; lra. }
    assert (sign : forall x, b < x < b + 1 -> 1 < downward x -> 0 < half x).
    { intros x inside above. pose proof (product x) as equal. pose proof (between b x inside).
      apply Rnot_le_lt. intro small. assert (0 <= 4 * PI * (sin (PI * (x - b)) * - half x)); [|lra].
      apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; lra. }
    destruct (Rle_lt_or_eq_dec y e (proj2 order)) as [before|same]; [|subst y; lra].
    apply (rises (y - b)); [lra|]. intros z near. apply Rnot_lt_le. intro above.
    assert (identity : sin (PI * (e - z)) * half y = sin (PI * (e - y)) * half z + sin (PI * (y - z)) * half e).
    { unfold half.
      replace (PI * (e - z)) with (PI * (e + b) - PI * (z + b)) by ring. replace (PI * (e - y)) with (PI * (e + b) - PI * (y + b)) by ring.
      replace (PI * (y - z)) with (PI * (y + b) - PI * (z + b)) by ring. rewrite !sin_minus. ring. }
    pose proof (sign z ltac:(lra) above). pose proof (sign e ltac:(lra) high).
    pose proof (between z e ltac:(lra)). pose proof (between y e ltac:(lra)). pose proof (between z y ltac:(lra)). pose proof (between b y ltac:(lra)).
    assert (0 < sin (PI * (e - y)) * half z) by now apply Rmult_lt_0_compat.
    assert (0 < sin (PI * (y - z)) * half e) by now apply Rmult_lt_0_compat.
    assert (0 < half y) by (apply Rmult_lt_reg_l with (sin (PI * (e - z))); lra).
    assert (0 < 4 * PI * (sin (PI * (y - b)) * half y)); [|pose proof (product y); lra].
    apply Rmult_lt_0_compat; [lra|]. now apply Rmult_lt_0_compat.
  Qed.

  (* ---------------------------------------------------------------- flights of one period *)

  Lemma at_0 : height 1 = height 0 /\ velocity 0 = half_gap /\ velocity 1 = half_gap.
  Proof.
    replace 1 with (0 + 1) by ring. unfold height, velocity. rewrite !wave_period. unfold wave.
    rewrite Rmult_0_r, sin_0, cos_0. repeat split; ring.
  Qed.

  Theorem bounce_returns : 0 <= alpha -> gap bounce 1 = 0 /\ arrival bounce 1 = 1 / (1 + alpha).
  Proof.
    intro nonnegative. destruct at_0 as (same & first & second). unfold gap, arrival, rebound, bounce. cbn [fst snd].
    rewrite same, first, second. unfold half_gap. split; field; lra.
  Qed.

  Theorem one_period x s : 0 <= alpha -> 0 < g -> Rabs x < 1 / 2 -> 0 < downward x -> flight (x, s) (x + 1, s) -> (x, s) = bounce.
  Proof.
    intros nonnegative positive near above (_ & zero & _ & speed). pose proof PI_RGT_0 as pi. apply Rabs_def2 in near.
    unfold gap, arrival, rebound, height, velocity in *. cbn [fst snd] in *. rewrite !wave_period in *.
    replace (x + 1 - x) with 1 in * by ring.
    assert (s_is : s = 1 / (1 + alpha)) by (apply Rmult_eq_reg_l with (1 + alpha); [|lra]; replace ((1 + alpha) * (1 / (1 + alpha))) with 1 by (field; lra); lra).
    assert (v_is : wave (- g) half_gap x = half_gap).
    { assert (half : half_gap = 1 / 2 - alpha * (1 / (1 + alpha))) by (unfold half_gap; field; lra). rewrite s_is in *. lra. }
    pose proof (sin2_cos2 (PI * x)) as unit. unfold downward, wave, Rsqr in *. replace (2 * PI * x) with (2 * (PI * x)) in above, v_is by ring.
    rewrite sin_2a, cos_2a_sin in above, v_is.
    assert (sign : forall y, 0 < y < 1 / 2 -> 0 < sin (PI * y)) by (intros y inside; apply sin_gt_0; nra).
    pose proof (sign x) as right. pose proof (sign (- x)) as left. rewrite Ropp_mult_distr_r_reverse, sin_neg in left.
    revert unit above v_is right left. generalize (sin (PI * x)) as u, (cos (PI * x)) as d, half_gap as h. intros.
    assert (either : u * (g * d + h * u) = 0) by lra.
    apply Rmult_integral in either. destruct either as [zero_|other].
    - unfold bounce. f_equal; [|exact s_is]. destruct (Rtotal_order x 0) as [less|[same|more]]; [|exact same|]; exfalso; lra.
    - exfalso. assert (h * (2 * u * d) + g * (1 - 2 * u * u) = - g + 2 * d * (g * d + h * u) + 2 * g * (1 - u * u - d * d)) as equal by ring.
      rewrite other in equal. assert (h * (2 * u * d) + g * (1 - 2 * u * u) = - g) by nra. nra.
  Qed.
End Table.
