(* What a trap that is contracted tells of the bounce.

   Proved:   fixed_flight      the trap holds a state that comes back one period later;
             bounce_flies      it is the bounce: the ball stays above the table up to its end;
             to_the_bounce     every flight in the trap comes closer to the bounce, by the rate;
             trap_attracts, trap_is_stable   so flights in it tend to the bounce, and stay near it. *)

From Coq Require Import Reals ZArith Lra Lia Bool.
From Juggleproof Require Import Rules Relation SineTable SineMotions SineLanding SineTrap.
Open Scope R_scope.

Lemma power_vanishes rate C e : 0 < rate < 1 -> 0 < C -> 0 < e -> exists n, C * rate ^ n < e.
Proof.
  intros range positive some. destruct (pow_lt_1_zero rate ltac:(rewrite Rabs_right; lra) (e / C)) as [n small]; [now apply Rdiv_lt_0_compat|].
  exists n. specialize (small n (le_n n)). pose proof (Rle_abs (rate ^ n)).
  apply Rlt_le_trans with (C * (e / C)); [apply Rmult_lt_compat_l; lra|]. right. field. lra.
Qed.

(* A sequence whose steps shrink geometrically has a limit. *)
Lemma geometric_limit (u : nat -> R) rate C : 0 < rate < 1 -> 0 < C -> (forall n k, - (C * rate ^ n) <= u (n + k)%nat - u n <= C * rate ^ n) ->
  exists l, forall n, - (C * rate ^ n) <= l - u n <= C * rate ^ n.
Proof.
  intros range positive steps. assert (cauchy : Cauchy_crit u).
  { intros e some. destruct (power_vanishes rate C (e / 2) range positive ltac:(lra)) as [N small]. exists N. intros n m late late_.
    pose proof (steps N (n - N)%nat) as one. pose proof (steps N (m - N)%nat) as two.
    replace (N + (n - N))%nat with n in one by lia. replace (N + (m - N))%nat with m in two by lia. unfold R_dist. apply Rabs_def1; lra. }
  destruct (R_complete u cauchy) as [l tends]. exists l. intro n.
  split; apply le_epsilon; intros e some; destruct (tends e some) as [N near]; specialize (near (n + N)%nat ltac:(lia));
    unfold R_dist in near; apply Rabs_def2 in near; specialize (steps n N); lra.
Qed.

Section Bounce.
  Variables alpha g reach low high weight rate : R.
  Local Notation downward := (downward alpha g).
  Local Notation flight := (flight alpha g).
  Local Notation bounce := (bounce alpha).
  Local Notation lands := (lands alpha g).
  Local Notation apart := (apart weight).
  Local Notation in_trap := (in_trap reach low high).

  Hypothesis alpha_nonnegative : 0 <= alpha.
  Hypothesis g_positive : 0 < g.
  Hypothesis reach_range : 0 < reach <= 1 / 8.
  Hypothesis weight_positive : 0 < weight.
  Hypothesis rate_range : 0 < rate < 1.
  Hypothesis trap_holds : in_trap 0 bounce.
  Hypothesis trap_lands : forall z w, in_trap 0 z -> flight z w -> in_trap 1 w.
  Hypothesis trap_rises : forall x, - reach <= x <= reach -> 0 < downward x.
  Hypothesis flies : forall z, in_trap 0 z -> flight z (lands z).
  Hypothesis contract : forall D z z' w w', 0 < D -> in_trap 0 z -> in_trap 0 z' -> apart D z z' -> flight z w -> flight z' w' -> apart (rate * D) w w'.

  (* The next impact, a period back. *)
  Definition back (w : Impact) : Impact := (fst w - 1, snd w).

  Lemma back_in_trap w : in_trap 1 w -> in_trap 0 (back w).
  Proof. unfold SineTrap.in_trap, back. cbn [fst snd]. rewrite Rminus_0_r. tauto. Qed.

  Lemma back_apart D w w' : apart D (back w) (back w') <-> apart D w w'.
  Proof. unfold SineLanding.apart, back. cbn [fst snd]. replace (fst w' - 1 - (fst w - 1)) with (fst w' - fst w) by ring. tauto. Qed.

  Lemma same_if_close z w : (forall e, 0 < e -> apart e z w) -> z = w.
  Proof.
    intro close. destruct z as [x s], w as [y t]. unfold SineLanding.apart in close. cbn [fst snd] in close.
    assert (weights : forall e, 0 < e -> exists f, 0 < f /\ weight * f = e) by (intros e some; exists (e / weight); split; [now apply Rdiv_lt_0_compat|field; lra]).
    f_equal; apply Rle_antisym; apply le_epsilon; intros e some.
    1, 2: destruct (close e some); lra.
    all: destruct (weights e some) as (f & less & equal); destruct (close f less); lra.
  Qed.

  Definition orbit (n : nat) : Impact := iterate (fun z => back (lands z)) n bounce.

  Lemma orbit_in_trap n : in_trap 0 (orbit n).
  Proof. apply (iterate_keeps (fun z => back (lands z)) (in_trap 0)); [|exact trap_holds]. intros z inside. apply back_in_trap, (trap_lands z); [exact inside|now apply flies]. Qed.

  Definition size : R := (2 * reach + (high - low) / weight + 1).

  Lemma size_positive : 0 < size.
  Proof. destruct trap_holds as [_ speed]. assert (0 <= (high - low) / weight) by (apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]). unfold size. lra. Qed.

  Lemma trap_is_small z w : in_trap 0 z -> in_trap 0 w -> apart size z w.
  Proof.
    intros [place speed] [place' speed']. rewrite Rminus_0_r in *. pose proof size_positive.
    assert (weight * size = 2 * reach * weight + (high - low) + weight) as equal by (unfold size; field; lra).
    assert (0 <= (high - low) / weight) by (apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]).
    assert (0 < reach * weight) by (apply Rmult_lt_0_compat; lra).
    unfold SineLanding.apart. rewrite equal. unfold size. lra.
  Qed.

  Lemma orbit_steps n : apart (size * rate ^ n) (orbit n) (orbit (S n)).
  Proof.
    induction n as [|n IH]; [cbn; rewrite Rmult_1_r; apply trap_is_small; [exact trap_holds|exact (orbit_in_trap 1)]|].
    change (apart (size * rate ^ S n) (back (lands (orbit n))) (back (lands (orbit (S n))))). apply back_apart.
    replace (size * rate ^ S n) with (rate * (size * rate ^ n)) by (cbn; ring).
    exact (contract (size * rate ^ n) _ _ _ _ ltac:(apply Rmult_lt_0_compat; [exact size_positive|apply pow_lt; lra]) (orbit_in_trap n) (orbit_in_trap (S n)) IH
      (flies _ (orbit_in_trap n)) (flies _ (orbit_in_trap (S n)))).
  Qed.

  Definition reached : R := size / (1 - rate).

  Lemma reached_positive : 0 < reached.
  Proof. pose proof size_positive. unfold reached. apply Rdiv_lt_0_compat; lra. Qed.

  Lemma orbit_near n k : apart (reached * rate ^ n) (orbit n) (orbit (n + k)).
  Proof.
    pose proof reached_positive as positive. assert (size_is : size = reached * (1 - rate)) by (unfold reached; field; lra).
    assert (powers : forall j, 0 < rate ^ j) by (intro j; apply pow_lt; lra).
    assert (all : apart (reached * rate ^ n * (1 - rate ^ k)) (orbit n) (orbit (n + k))).
    { induction k as [|k IH]; [rewrite Nat.add_0_r; unfold SineLanding.apart; cbn; lra|].
      pose proof (orbit_steps (n + k)) as step. rewrite Nat.add_succ_r. rewrite size_is, pow_add in step.
      unfold SineLanding.apart in *. cbn [pow]. lra. }
    assert (0 < reached * rate ^ n * rate ^ k) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; [exact positive|apply powers]|apply powers]).
    assert (0 < weight * (reached * rate ^ n * rate ^ k)) by now apply Rmult_lt_0_compat.
    unfold SineLanding.apart in *. lra.
  Qed.

  Theorem fixed_flight : exists x s, in_trap 0 (x, s) /\ flight (x, s) (x + 1, s).
  Proof.
    pose proof reached_positive as positive. assert (positive_ : 0 < weight * reached) by now apply Rmult_lt_0_compat.
    destruct (geometric_limit (fun n => fst (orbit n)) rate reached rate_range positive) as [x x_near]; [intros n k; apply (orbit_near n k)|].
    destruct (geometric_limit (fun n => snd (orbit n)) rate (weight * reached) rate_range positive_) as [s s_near].
    { intros n k. rewrite Rmult_assoc. apply (orbit_near n k). }
    assert (near : forall n, apart (reached * rate ^ n) (orbit n) (x, s)).
    { intro n. unfold SineLanding.apart. cbn [fst snd]. rewrite <- Rmult_assoc. split; [apply x_near|apply s_near]. }
    assert (inside : in_trap 0 (x, s)).
    { unfold SineTrap.in_trap. cbn [fst snd]. split; split; apply le_epsilon; intros e some.
      1, 2: destruct (power_vanishes rate reached e rate_range positive some) as [n small]; destruct (orbit_in_trap n) as [place _]; pose proof (x_near n); lra.
      all: destruct (power_vanishes rate (weight * reached) e rate_range positive_ some) as [n small];
        destruct (orbit_in_trap n) as [_ speed]; pose proof (s_near n); lra. }
    exists x, s. split; [exact inside|]. pose proof (flies _ inside) as flown.
    assert (same : back (lands (x, s)) = (x, s)).
    { symmetry. apply same_if_close. intros e some. destruct (power_vanishes rate (2 * reached) e rate_range ltac:(lra) some) as [n small].
      assert (power : 0 < rate ^ n) by (apply pow_lt; lra). assert (large : 0 < reached * rate ^ n) by now apply Rmult_lt_0_compat.
      pose proof (contract _ _ _ _ _ large (orbit_in_trap n) inside (near n) (flies _ (orbit_in_trap n)) flown) as closer. apply back_apart in closer.
      pose proof (near (S n)) as next. change (orbit (S n)) with (back (lands (orbit n))) in next. cbn [pow] in next.
      assert (small_ : 2 * (reached * rate ^ n) < e) by lra. set (q := reached * rate ^ n) in *.
      assert (less : rate * q < 1 * q) by (apply Rmult_lt_compat_r; lra).
      assert (sum : 2 * (rate * q) <= e) by lra. replace (reached * (rate * rate ^ n)) with (rate * q) in next by (unfold q; ring).
      assert (weight * (2 * (rate * q)) <= weight * e) by (apply Rmult_le_compat_l; lra).
      unfold SineLanding.apart in *. lra. }
    assert (x_is : fst (lands (x, s)) - 1 = x) by exact (f_equal fst same). assert (s_is : snd (lands (x, s)) = s) by exact (f_equal snd same).
    rewrite (surjective_pairing (lands (x, s))), s_is in flown. now replace (fst (lands (x, s))) with (x + 1) in flown by lra.
  Qed.

  Theorem bounce_flies : flight bounce (1, 1 / (1 + alpha)).
  Proof.
    destruct fixed_flight as (x & s & inside & flown). destruct inside as [place _]. cbn [fst] in place. rewrite Rminus_0_r in place.
    pose proof (one_period alpha g x s alpha_nonnegative g_positive ltac:(apply Rabs_def1; lra) (trap_rises x place) flown) as same.
    rewrite same in flown. unfold SineTable.bounce in same. injection same as x_is s_is. rewrite x_is, s_is in flown. now rewrite Rplus_0_l in flown.
  Qed.

  Theorem to_the_bounce c z w : 0 <= c -> in_trap 0 z -> apart c bounce z -> flight z w -> apart (rate * c) bounce (back w).
  Proof.
    intros nonnegative inside near flown.
    assert (all : forall e, 0 < e -> apart (rate * (c + e)) bounce (back w)).
    { intros e some. assert (0 < weight * e) by now apply Rmult_lt_0_compat.
      assert (base : bounce = back (1, 1 / (1 + alpha))) by (unfold back, SineTable.bounce; cbn [fst snd]; f_equal; ring).
      rewrite base. apply back_apart. apply (contract (c + e) bounce z); try assumption; [lra| |exact bounce_flies].
      unfold SineLanding.apart in *. lra. }
    unfold SineLanding.apart in *. assert (weights : forall e, 0 < e -> exists f, 0 < f /\ weight * rate * f = e)
      by (intros e some; exists (e / (weight * rate)); split; [apply Rdiv_lt_0_compat; [|apply Rmult_lt_0_compat]; lra|field; lra]).
    split; split; apply le_epsilon; intros e some.
    1, 2: destruct (all e some); assert (rate * e <= 1 * e) by (apply Rmult_le_compat_r; lra); lra.
    all: destruct (weights e some) as (f & less & equal); destruct (all f less); lra.
  Qed.

  (* ---------------------------------------------------------------- flights in the trap *)

  Definition next (a b : Impact) : Prop := in_trap 0 a /\ flight a (fst b + 1, snd b).
  Definition coordinate (j : bool) (z : Impact) : R := if j then fst z else snd z.
  Definition point (j : bool) : R := coordinate j bounce.
  Definition weights (j : bool) : R := if j then 1 else weight.

  Lemma next_in_trap a b : in_trap 0 a -> next a b -> in_trap 0 b.
  Proof.
    intros inside [_ flown]. apply (trap_lands _ _ inside) in flown. apply back_in_trap in flown. unfold back in flown. cbn [fst snd] in flown.
    replace (fst b + 1 - 1) with (fst b) in flown by ring. now rewrite <- surjective_pairing in flown.
  Qed.

  Lemma apart_is_within c z : apart c bounce z <-> within coordinate point weights c z.
  Proof.
    unfold SineLanding.apart, within. split.
    - intros [near close] j. apply Rabs_le. destruct j; unfold point, coordinate, weights; lra.
    - intro near. pose proof (near true) as first. pose proof (near false) as second. unfold point, coordinate, weights in *.
      assert (size : forall a b, Rabs a <= b -> - b <= a <= b) by (intros a b bound; pose proof (Rle_abs a); pose proof (Rle_abs (- a)); rewrite Rabs_Ropp in *; lra).
      apply size in first, second. lra.
  Qed.

  Lemma next_contracts c a b : 0 <= c -> in_trap 0 a -> next a b -> within coordinate point weights c a -> within coordinate point weights (rate * c) b.
  Proof.
    intros positive inside [_ flown] near. apply apart_is_within. apply apart_is_within in near.
    replace b with (back (fst b + 1, snd b)); [now apply to_the_bounce with a|]. unfold back. cbn [fst snd]. rewrite (surjective_pairing b) at 3. f_equal. ring.
  Qed.

  Let least := Rmin 1 weight.
  Let greatest := Rmax 1 weight.
  Lemma weights_bounded j : least <= weights j <= greatest.
  Proof. unfold least, greatest. destruct j; cbn; split; first [apply Rmin_l|apply Rmin_r|apply Rmax_l|apply Rmax_r]. Qed.
  Lemma least_positive : 0 < least.
  Proof. apply Rmin_glb_lt; lra. Qed.

  Theorem trap_attracts x : execution next x -> in_trap 0 (x O) -> execution_converges coordinate point x.
  Proof.
    apply (relation_convergence next coordinate point (in_trap 0) weights rate next_in_trap (Rlt_le _ _ (proj1 rate_range)) next_contracts
      least greatest (proj2 rate_range) least_positive weights_bounded size (Rlt_le _ _ size_positive)).
    intros z inside. apply apart_is_within. now apply trap_is_small.
  Qed.

  Theorem trap_is_stable : executions_stable next (in_trap 0) coordinate point.
  Proof.
    apply (relation_stability next (in_trap 0) coordinate point (in_trap 0) weights rate next_in_trap (Rlt_le _ _ (proj1 rate_range)) next_contracts
      1 least greatest (proj2 rate_range) least_positive weights_bounded Rlt_0_1).
    intros z inside _. exact inside.
  Qed.
End Bounce.
