(* The theorem of the second checker, for one pair of parameters, from what its rules find.

   Mechanised here: the map from impact to impact as a relation (touches may count as impacts, or not), with P, v and S as they are; the
   absorbing strip; accumulation, rest and launch, and that no motion is cut off by them; the rest arc; the descent of ranks; the implicit
   function theorem behind the trap, and that the bounce is the fixed point of what contracts the trap; attraction and stability.
   Not mechanised: that a box for which `check_box` does not raise has the properties in the record `certified` for each of its parameters.
   That is the enclosure of flights (`Flights`, the field flights_lead) and of S on columns (arc_outside, rank_of_rest, trap_downward), the
   tables of sines, the rounding of `absorbing_strip`, the interval products of `check_trap`, and the cover of a rectangle by boxes.
   `check_cells` looks at the columns of one period: SinePeriod.v proves that these are enough.  Its landings have a margin, so
   that the bounce is inside the trap, and not on its edge, which stability needs; `check_trap` tests that too.  Nor is it mechanised that a
   ball has a first impact, that its heights converge with its impacts, or that refutations are counterexamples.

   Proved:   every_motion_tends      to the bounce, flying only, once a period;
             bounce_is_stable        what starts close to the bounce stays close to it, and flies only;
             bounce_is_a_motion      for all times;
             motions_go_on           after every impact there is a flight, or a rest;
             endless_flights_chatter   endless flights in bounded time are the first part of a stage, a chatter, that leads beyond them;
             rests_are_few           stages in bounded time, from below the top, are flights but for finitely many: what is left of them is a chatter,
                                     and so a motion can be cut into stages for all times. *)

From Coq Require Import Reals ZArith Lra Lia Bool.
From Juggleproof Require Import Rules Relation SineMean SineTable SineMotions SineStrip SineDescent SineLanding SineTrap SineBounce SineGrid.
Open Scope R_scope.

Section Theorem_.
  Variables alpha g rho weight rate S_low S_high : R.
  Variables columns per_unit rows width low high first last deep : Z.
  Variable at_rest : nat.
  Variable rank : Z -> Z -> nat.

  Local Notation flight := (flight alpha g).
  Local Notation stage := (stage alpha g).
  Local Notation motion := (motion alpha g).
  Local Notation bounce := (bounce alpha).
  Local Notation top := (top per_unit rows).
  Local Notation reach := (IZR width / IZR columns).
  Local Notation slowest := (IZR low / IZR per_unit).
  Local Notation fastest := (IZR high / IZR per_unit).
  Local Notation trap := (in_trap reach slowest fastest).

  Record certified : Prop := {
    parameters : 0 <= alpha < 1 /\ 0 < g;
    (* absorbing_strip *)
    greatest_speed : 0 <= rho /\ half_gap alpha ^ 2 + g ^ 2 <= rho ^ 2;
    strip_absorbs : greatest_arrival alpha rho top < top;
    (* check_trap *)
    trap_has_the_bounce : slowest <= 1 / (1 + alpha) <= fastest;
    trap_downward : forall x, - reach <= x <= reach -> S_low <= downward alpha g x <= S_high;
    trap_falls : 0 < S_low /\ (alpha = 0 -> 1 < S_low);
    norm_range : 0 < weight /\ 0 < rate < 1;
    norm_holds : contracts alpha reach slowest fastest weight rate S_low S_high;
    (* check_rest_arc and check_cells *)
    cells_hold : cells alpha g columns per_unit rows width low high first last deep at_rest rank }.

  Hypothesis holds : certified.

  Local Notation alpha_range := (proj1 (parameters holds)).
  Local Notation alpha_nonnegative := (proj1 alpha_range).

  Lemma ranges : 0 < IZR columns /\ 0 < IZR per_unit /\ 0 < reach <= 1 / 8 /\ 0 < slowest /\ fastest <= top /\ 0 < top.
  Proof.
    destruct (cells_hold holds) as [[columns_ per_unit_] trap_ _ _ _ _ _]. apply (IZR_lt 0) in columns_, per_unit_.
    assert (0 < / IZR columns) by now apply Rinv_0_lt_compat. assert (0 < / IZR per_unit) by now apply Rinv_0_lt_compat.
    destruct trap_ as (width_ & eighth & [low_ order] & high_). assert (0 < rows)%Z as rows_ by lia. apply (IZR_lt 0) in width_, low_, rows_. apply IZR_le in eighth, high_. rewrite mult_IZR in eighth.
    assert (0 < reach /\ 0 < slowest /\ 0 < top) as (? & ? & ?) by (unfold SineGrid.top, Rdiv; repeat split; apply Rmult_lt_0_compat; lra).
    split; [lra|]. split; [lra|]. split; [|split; [lra|split; [unfold SineGrid.top, Rdiv; apply Rmult_le_compat_r; lra|lra]]]. split; [lra|].
    apply Rmult_le_reg_r with (IZR columns); [lra|]. replace (reach * IZR columns) with (IZR width) by (field; lra). lra.
  Qed.

  Lemma in_trap_period k x s : trap k (x, s) <-> trap 0 (x - IZR k, s).
  Proof. unfold in_trap. cbn [fst snd]. now rewrite Rminus_0_r. Qed.

  Lemma bounce_in_trap : trap 0 bounce.
  Proof. pose proof ranges. pose proof (trap_has_the_bounce holds). unfold in_trap, SineTable.bounce. cbn [fst snd]. lra. Qed.

  Lemma flight_below z w : flight z w -> 0 <= snd z <= top -> 0 <= snd w <= top.
  Proof.
    intros flown speed. pose proof ranges. destruct (greatest_speed holds). split; [exact (arrives _ _ _ _ flown)|].
    apply (strip_stays alpha g rho alpha_range) with z; try assumption; [lra|exact (strip_absorbs holds)|now apply flies].
  Qed.

  Lemma trap_lands_ z w : trap 0 z -> flight z w -> trap 1 w.
  Proof.
    intros inside flown. pose proof ranges. apply (grid_trap_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds) 0 z w inside flown).
    apply (flight_below z w flown). destruct inside. lra.
  Qed.

  Lemma trap_flies_ z : trap 0 z -> flight z (lands alpha g z).
  Proof.
    apply (trap_flies alpha g reach slowest fastest S_low S_high alpha_range); [apply ranges|exact (trap_downward holds)|exact (trap_falls holds)].
  Qed.

  Lemma contract_ D z z' w w' : 0 < D -> trap 0 z -> trap 0 z' -> apart weight D z z' -> flight z w -> flight z' w' -> apart weight (rate * D) w w'.
  Proof.
    destruct ranges as (_ & _ & reach_ & slowest_ & _ & _). destruct (norm_range holds) as [weight_ rate_].
    exact (flights_contract alpha g reach slowest fastest weight rate S_low S_high alpha_range reach_ slowest_ weight_ rate_ bounce_in_trap
      trap_lands_ (trap_downward holds) (trap_falls holds) (norm_holds holds) D z z' w w').
  Qed.

  Lemma trap_rises_ x : - reach <= x <= reach -> 0 < downward alpha g x.
  Proof. intro inside. pose proof (trap_downward holds x inside). pose proof (proj1 (trap_falls holds)). lra. Qed.

  Local Notation next := (next alpha g reach slowest fastest).

  Theorem attracted x : execution next x -> trap 0 (x O) -> execution_converges coordinate (point alpha) x.
  Proof.
    apply (trap_attracts alpha g reach slowest fastest weight rate alpha_nonnegative (proj2 (parameters holds)) (proj1 (proj2 (proj2 ranges)))
      (proj1 (norm_range holds)) (proj2 (norm_range holds)) bounce_in_trap trap_lands_ trap_rises_ trap_flies_ contract_).
  Qed.

  Theorem stable : executions_stable next (trap 0) coordinate (point alpha).
  Proof.
    apply (trap_is_stable alpha g reach slowest fastest weight rate alpha_nonnegative (proj2 (parameters holds)) (proj1 (proj2 (proj2 ranges)))
      (proj1 (norm_range holds)) (proj2 (norm_range holds)) bounce_in_trap trap_lands_ trap_rises_ trap_flies_ contract_).
  Qed.

  (* ---------------------------------------------------------------- motions *)

  Section Stages.
    Variable z : nat -> Impact.
    Hypothesis first_speed : 0 <= snd (z O) <= top.
    Hypothesis goes : forall n, stage (z n) (z (S n)).

    Lemma speeds n : 0 <= snd (z n) <= top.
    Proof.
      induction n as [|n IH]; [exact first_speed|]. pose proof ranges. destruct (greatest_speed holds). split; [apply (later _ _ _ _ (goes n))|].
      apply (strip_stays alpha g rho alpha_range) with (z n); try assumption; [lra|exact (strip_absorbs holds)|apply goes].
    Qed.

    Lemma speeds_within n (x : nat -> Impact) : x O = z n -> (forall j, flight (x j) (x (S j))) -> forall j, snd (x j) <= top.
    Proof.
      intros start_ runs j. assert (all : 0 <= snd (x j) <= top); [|apply all].
      induction j as [|j IH]; [rewrite start_; apply speeds|]. exact (flight_below _ _ (runs j) IH).
    Qed.

    Lemma trap_place k y : trap k y -> IZR k - 1 / 4 <= fst y.
    Proof. intros [place _]. pose proof ranges. lra. Qed.

    Lemma trap_moves k y : trap k y -> alpha * snd y = 0 -> 1 < downward alpha g (fst y).
    Proof.
      intros [place speed] still. pose proof ranges. assert (zero : alpha = 0) by (apply Rmult_eq_reg_r with (snd y); lra).
      pose proof (proj2 (trap_falls holds) zero). pose proof (trap_downward holds (fst y - IZR k) place) as bound.
      rewrite <- (downward_periods alpha g k) in bound. replace (fst y - IZR k + IZR k) with (fst y) in bound by ring. lra.
    Qed.

    Lemma stays_in_the_trap k n : trap k (z n) -> forall j, trap (k + Z.of_nat j) (z (n + j)) /\ flight (z (n + j)) (z (S (n + j))).
    Proof.
      exact (trap_keeps alpha g (start columns first) (finish columns last) top trap (grid_arc_short _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)) trap_place
        (grid_trap_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)) trap_moves z speeds goes speeds_within k n).
    Qed.
    (* The flights of a motion in the trap, each a period back, are an execution of `next`. *)
    Lemma period_by_period k n : trap k (z n) -> let x := fun j => (fst (z (n + j)) - IZR (k + Z.of_nat j), snd (z (n + j))) in execution next x /\ trap 0 (x O).
    Proof.
      intros inside x. pose proof (stays_in_the_trap k n inside) as all.
      assert (place : forall j, trap 0 (x j)) by (intro j; unfold x; rewrite <- in_trap_period, <- surjective_pairing; apply all).
      split; [|apply place]. intro j. split; [apply place|]. unfold x. cbn [fst snd]. apply (flight_periods alpha g (k + Z.of_nat j)).
      rewrite Nat.add_succ_r, Nat2Z.inj_succ. replace (k + Z.succ (Z.of_nat j))%Z with (k + Z.of_nat j + 1)%Z by lia. rewrite (plus_IZR _ 1).
      replace (fst (z (n + j)) - IZR (k + Z.of_nat j) + IZR (k + Z.of_nat j)) with (fst (z (n + j))) by ring.
      replace (fst (z (S (n + j))) - (IZR (k + Z.of_nat j) + 1) + 1 + IZR (k + Z.of_nat j)) with (fst (z (S (n + j)))) by ring.
      rewrite <- !surjective_pairing. apply all.
    Qed.

    Theorem rests_are_few bound : (forall n, fst (z n) <= bound) -> ~ forall m, exists n, (m <= n)%nat /\ ~ flight (z n) (z (S n)).
    Proof.
      apply (no_endless_rests alpha g (start columns first) (finish columns last) (depth per_unit deep) top at_rest
        (ranked columns per_unit rows width low high first last deep rank) trap); try (now apply grid_arc_short with (1 := cells_hold holds)).
      - apply Rlt_le, Rdiv_lt_0_compat; [lra|apply ranges].
      - exact (grid_arc_holds _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact trap_place.
      - exact (grid_trap_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact trap_moves.
      - exact (grid_arc_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact (grid_ranked_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact (grid_ranked_rest _ _ _ _ _ _ _ _ _ _ _ _ _ alpha_nonnegative (cells_hold holds)).
      - exact speeds.
      - exact goes.
      - exact speeds_within.
    Qed.

    Lemma in_the_end : (forall time, exists n, time < fst (z n)) -> exists n k, trap k (z n).
    Proof.
      intro unbounded. destruct (comes_to_the_trap alpha g (start columns first) (finish columns last) (depth per_unit deep) top at_rest
        (ranked columns per_unit rows width low high first last deep rank) trap) with (z := z) as (n & k & all).
      - apply Rlt_le, Rdiv_lt_0_compat; [lra|apply ranges].
      - exact (grid_arc_short _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact (grid_arc_holds _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact (grid_located _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact trap_place.
      - exact (grid_trap_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact trap_moves.
      - exact (grid_arc_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact (grid_ranked_flight _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)).
      - exact (grid_ranked_rest _ _ _ _ _ _ _ _ _ _ _ _ _ alpha_nonnegative (cells_hold holds)).
      - exact speeds.
      - exact goes.
      - exact speeds_within.
      - exact unbounded.
      - exists n, k. destruct (all O) as [inside _]. now rewrite Nat.add_0_r, Z.add_0_r in inside.
    Qed.
  End Stages.

  (* ---------------------------------------------------------------- the theorem *)

  Theorem every_motion_tends z : motion z -> exists n k, (forall j, flight (z (n + j)%nat) (z (S (n + j)))) /\
    forall e, 0 < e -> exists m, forall j, (m <= j)%nat ->
      Rabs (fst (z (n + j)%nat) - IZR (k + Z.of_nat j)) < e /\ Rabs (snd (z (n + j)%nat) - 1 / (1 + alpha)) < e.
  Proof.
    intros moves. pose proof ranges. destruct (greatest_speed holds) as [rho_ rho_is].
    destruct (strip_enters alpha g rho alpha_range rho_ rho_is top) with (z := z) as [first_ below_]; [lra|exact (strip_absorbs holds)|exact moves|].
    pose proof (motion_speeds alpha g z moves) as positive. destruct moves as (start_ & goes & unbounded).
    set (y := fun j => z (first_ + j)%nat). assert (y_goes : forall j, stage (y j) (y (S j))) by (intro j; unfold y; rewrite Nat.add_succ_r; apply goes).
    assert (y_first : 0 <= snd (y O) <= top) by (unfold y; rewrite Nat.add_0_r; split; [apply positive|exact below_]).
    assert (y_unbounded : forall time, exists n, time < fst (y n)) by (intro time; exact (later_than alpha g z goes unbounded first_ time)).
    destruct (in_the_end y y_first y_goes y_unbounded) as (n & k & inside).
    pose proof (stays_in_the_trap y y_first y_goes k n inside) as flown. destruct (period_by_period y y_first y_goes k n inside) as [runs there].
    exists (first_ + n)%nat, k. unfold y in *. split.
    - intro j. rewrite <- Nat.add_assoc, <- Nat.add_succ_r. apply flown.
    - intros e some. destruct (attracted _ runs there e some) as [m near]. exists m. intros j late. rewrite <- Nat.add_assoc.
      split; [specialize (near j late true)|specialize (near j late false)]; unfold point, coordinate, SineTable.bounce in near; cbn [fst snd] in near; [|exact near].
      now rewrite Rminus_0_r in near.
  Qed.

  Theorem bounce_is_stable : slowest < 1 / (1 + alpha) < fastest -> forall e, 0 < e -> exists d, 0 < d /\
    forall z, (forall n, stage (z n) (z (S n))) -> Rabs (fst (z O)) < d -> Rabs (snd (z O) - 1 / (1 + alpha)) < d ->
    forall n, flight (z n) (z (S n)) /\ Rabs (fst (z n) - INR n) < e /\ Rabs (snd (z n) - 1 / (1 + alpha)) < e.
  Proof.
    intros inner e some. pose proof ranges as sizes. destruct (stable e some) as (d & positive & near).
    set (room := Rmin reach (Rmin (1 / (1 + alpha) - slowest) (fastest - 1 / (1 + alpha)))).
    assert (room_is : 0 < room /\ room <= reach /\ room <= 1 / (1 + alpha) - slowest /\ room <= fastest - 1 / (1 + alpha)).
    { unfold room. pose proof (Rmin_l reach (Rmin (1 / (1 + alpha) - slowest) (fastest - 1 / (1 + alpha)))).
      pose proof (Rmin_r reach (Rmin (1 / (1 + alpha) - slowest) (fastest - 1 / (1 + alpha)))).
      pose proof (Rmin_l (1 / (1 + alpha) - slowest) (fastest - 1 / (1 + alpha))). pose proof (Rmin_r (1 / (1 + alpha) - slowest) (fastest - 1 / (1 + alpha))).
      split; [repeat apply Rmin_glb_lt; lra|lra]. }
    exists (Rmin d room). split; [apply Rmin_glb_lt; lra|]. intros z goes place speed n.
    pose proof (Rmin_l d room). pose proof (Rmin_r d room). apply Rabs_def2 in place, speed.
    assert (inside : trap 0 (z O)) by (unfold in_trap; rewrite Rminus_0_r; lra).
    assert (first_ : 0 <= snd (z O) <= top) by lra.
    destruct (stays_in_the_trap z first_ goes 0 0 inside n) as [_ flown]. destruct (period_by_period z first_ goes 0 0 inside) as [runs there].
    split; [exact flown|]. rewrite INR_IZR_INZ.
    assert (close : forall j, Rabs (coordinate j (fst (z O) - IZR 0, snd (z O)) - point alpha j) < d).
    { intro j. unfold point, coordinate, SineTable.bounce. destruct j; cbn [fst snd]; apply Rabs_def1; lra. }
    pose proof (near _ runs there close n) as all. split; [specialize (all true)|specialize (all false)]; unfold point, coordinate, SineTable.bounce in all; cbn [fst snd] in all;
      [|exact all]. now rewrite Rminus_0_r in all.
  Qed.

  Theorem bounce_is_a_motion : motion (fun n => (INR n, 1 / (1 + alpha))).
  Proof.
    pose proof (bounce_flies alpha g reach slowest fastest weight rate alpha_nonnegative (proj2 (parameters holds)) (proj1 (proj2 (proj2 ranges)))
      (proj1 (norm_range holds)) (proj2 (norm_range holds)) bounce_in_trap trap_lands_ trap_rises_ trap_flies_ contract_) as once.
    split; [cbn [snd]; apply Rlt_le, Rdiv_lt_0_compat; pose proof alpha_nonnegative; lra|]. split.
    - intro n. apply flies. apply (flight_periods alpha g (Z.of_nat n)) in once. rewrite <- INR_IZR_INZ in once. now rewrite S_INR, Rplus_comm with (r1 := INR n), <- (Rplus_0_l (INR n)) at 1.
    - intro time. destruct (exceeded_by_a_number (time + 1)) as [n past]. exists n. cbn [fst]. lra.
  Qed.

  (* ---------------------------------------------------------------- there are motions *)

  Lemma before_the_arc_ends x : downward alpha g x <= 1 -> exists e, x < e < x + 1 /\ 1 < downward alpha g e.
  Proof.
    intro slow. pose proof (grid_arc_short _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)) as short.
    pose proof (grid_arc_holds _ _ _ _ _ _ _ _ _ _ _ _ _ (cells_hold holds)) as outside.
    destruct (slow_is_in_the_arc alpha g (start columns first) (finish columns last) outside x slow) as [k place].
    exists (finish columns last + IZR k). split; [lra|]. apply (outside k). lra.
  Qed.

  Theorem motions_go_on z : 0 <= snd z -> exists w, stage z w.
  Proof.
    intro speed. pose proof (Rmult_le_pos _ _ alpha_nonnegative speed) as fast.
    assert (flown : (exists h, 0 < h /\ airborne alpha g z (fst z + h)) -> exists w, stage z w).
    { intros (h & positive & up). exists (lands alpha g z). apply flies. exact (flies_from alpha g z h positive up). }
    destruct (Rlt_dec 0 (alpha * snd z)) as [up|still]; [now apply flown, takes_off; [|left]|].
    destruct (Rlt_dec 1 (downward alpha g (fst z))) as [falls|slow]; [now apply flown, takes_off; [|right]|].
    destruct (before_the_arc_ends (fst z) ltac:(lra)) as (e & place & high_). destruct (is_launched alpha g (fst z) e ltac:(lra) ltac:(lra) high_) as (b & early & rest).
    destruct (Rle_lt_or_eq_dec _ _ (proj1 rest)) as [less|same]; [exists (b, 0); apply sticks; try assumption; [lra|reflexivity]|].
    apply flown. exists (e - fst z). split; [lra|]. replace (fst z + (e - fst z)) with e by ring. split; [lra|]. intros y inside.
    destruct rest as (_ & _ & level & up). rewrite <- same in level, up.
    destruct (Req_dec y (fst z)) as [->|other]; [rewrite gap_start; lra|].
    destruct (mean_value_between _ _ (fst z) y ltac:(lra) (gap_derivative alpha g z)) as (m & m_place & equal).
    destruct (mean_value _ _ (fst z) m (arrival_derivative alpha g z)) as (k & k_place & equal_). rewrite gap_start in equal. rewrite arrival_start in equal_.
    assert (rising : 1 <= downward alpha g k).
    { destruct (Req_dec k (fst z)) as [->|]; [lra|]. apply Rlt_le, (rises_once alpha g (fst z) k e level up); lra. }
    assert (0 <= (downward alpha g k - 1) * (m - fst z)) by (apply Rmult_le_pos; lra).
    replace (gap alpha g z y) with (- arrival alpha g z m * (y - fst z)) by lra. apply Rmult_le_pos; lra.
  Qed.

  Theorem endless_flights_chatter x bound : 0 <= snd (x O) -> (forall n : nat, flight (x n) (x (S n))) -> (forall n, fst (x n) <= bound) ->
    Un_cv (fun n => snd (x n)) 0 /\ exists w, stage (x O) w /\ forall n, fst (x n) < fst w.
  Proof.
    intros speed runs bounded. destruct (accumulation alpha g alpha_nonnegative x bound speed runs bounded) as (limit & tends & _ & slow & still). split; [exact still|].
    destruct (before_the_arc_ends limit slow) as (e & place & high_). destruct (is_launched alpha g limit e ltac:(lra) slow high_) as (b & _ & rest).
    exists (b, 0). split; [now apply chatters with x limit|]. intro n. pose proof (flights_later alpha g x limit runs tends n). cbn [fst]. destruct rest. lra.
  Qed.
End Theorem_.
