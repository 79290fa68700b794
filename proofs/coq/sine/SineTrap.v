(* The trap: a box around the bounce that every flight from it comes back to, one period later, and that the map contracts.

   Assumed of it: flights land in it; it holds the bounce; S > 0 on it, S > 1 if alpha = 0; and the matrix of the implicit function theorem
   has a norm of at most rate < 1 in max (|dx|, |ds| / weight), for all values of its terms in the trap.

   Proved:   local_contraction   two flights that start close to each other end closer, but for a term of second order;
             flights_contract    so do any two flights, as there is a flight from each state between them;
             trap_flies          there is a flight from each state of the trap. *)

From Coq Require Import Reals ZArith Lra Lia.
From Juggleproof Require Import Rules SineTable SineMotions SineLanding.
Open Scope R_scope.

Lemma combined a b p q r d w : Rabs a + Rabs b * w <= r -> - d <= p <= d -> - (w * d) <= q <= w * d -> 0 <= d -> 0 <= w ->
  - (r * d) <= a * p + b * q <= r * d.
Proof.
  intros bound near close positive weighted.
  assert (size : forall t, - Rabs t <= t <= Rabs t) by (intro t; pose proof (Rle_abs t); pose proof (Rle_abs (- t)); rewrite Rabs_Ropp in *; lra).
  pose proof (product_within _ _ _ _ (size a) near). pose proof (product_within _ _ _ _ (size b) close).
  pose proof (Rmult_le_compat_r d _ _ positive bound). lra.
Qed.

Lemma convex a b p q t : 0 <= t <= 1 -> a <= p <= b -> a <= q <= b -> a <= p + t * (q - p) <= b.
Proof. intros. split; nra. Qed.

Lemma scaled_within a A k : - A <= a <= A -> 0 <= k -> - (A * k) <= a * k <= A * k.
Proof. intros. split; nra. Qed.

Section Trap.
  Variables alpha g reach low high weight rate S_low S_high : R.
  Local Notation downward := (downward alpha g).
  Local Notation flight := (flight alpha g).
  Local Notation bounce := (bounce alpha).
  Local Notation lands := (lands alpha g).
  Local Notation apart := (apart weight).

  Definition in_trap (k : Z) (z : Impact) : Prop := - reach <= fst z - IZR k <= reach /\ low <= snd z <= high.

  Hypothesis alpha_range : 0 <= alpha < 1.
  Hypothesis g_positive : 0 < g.
  Hypothesis reach_range : 0 < reach <= 1 / 8.
  Hypothesis low_positive : 0 < low.
  Hypothesis weight_positive : 0 < weight.
  Hypothesis rate_range : 0 < rate < 1.
  Hypothesis trap_holds : in_trap 0 bounce.
  Hypothesis trap_lands : forall z w, in_trap 0 z -> flight z w -> in_trap 1 w.
  Hypothesis trap_downward : forall x, - reach <= x <= reach -> S_low <= downward x <= S_high.
  Hypothesis trap_falls : 0 < S_low /\ (alpha = 0 -> 1 < S_low).

  (* The norm of the matrix: lag stands for 1 - S, time for the duration of the flight, s and t for the closing speeds at its ends. *)
  Definition contracts : Prop := forall time lag lag_ lag_end s t, 1 - 2 * reach <= time <= 1 + 2 * reach -> 1 - S_high <= lag <= 1 - S_low ->
    1 - S_high <= lag_ <= 1 - S_low -> 1 - S_high <= lag_end <= 1 - S_low -> low <= s <= high -> low <= t <= high ->
    let x_by_x := (time * lag - alpha * s) / t in let x_by_s := alpha * time / t in
    Rabs x_by_x + Rabs x_by_s * weight <= rate /\
    Rabs (- lag_ + lag_end * x_by_x) + Rabs (- alpha + lag_end * x_by_s) * weight <= rate * weight.
  Hypothesis norm : contracts.

  Lemma trap_flies z : in_trap 0 z -> flight z (lands z).
  Proof.
    intros [place speed]. rewrite Rminus_0_r in place.
    destruct (takes_off alpha g z) as (h & positive & up); [apply Rmult_le_pos; lra| |exact (flies_from alpha g z h positive up)].
    destruct (Rle_lt_or_eq_dec 0 alpha (proj1 alpha_range)) as [positive|zero].
    - left. apply Rmult_lt_0_compat; lra.
    - right. pose proof (trap_downward _ place). destruct trap_falls as [_ faster]. specialize (faster (eq_sym zero)). lra.
  Qed.

  Section Bounded.
    Variables M V : R.
    Hypothesis M_large : 1 <= M.
    Hypothesis V_positive : 0 <= V.
    Hypothesis bounds : forall y, - M <= 1 - downward y <= M /\ - V <= velocity alpha g y <= V /\ - V <= height alpha g y <= V.

    Local Notation spread := (spread M V weight high low).
    Local Notation curvature := (curvature M V weight high low).

    Lemma trap_nearby z : in_trap 0 z -> nearby high z.
    Proof. intros [place speed]. rewrite Rminus_0_r in place. split; lra. Qed.

    Lemma spread_positive : 0 < spread.
    Proof.
      destruct trap_holds as [_ speed]. unfold SineLanding.spread, gap_change. apply Rdiv_lt_0_compat; lra.
    Qed.

    Definition excess : R := curvature / low * (1 + M / weight).

    Lemma close_landings d z w z' w' : in_trap 0 z -> in_trap 0 z' -> apart d z z' -> flight z w -> flight z' w' -> 0 < d -> spread * d * (2 * M) <= low ->
      - (spread * d) <= fst w' - fst w <= spread * d.
    Proof.
      intros inside inside' close flown flown' positive short.
      destruct (trap_lands _ _ inside flown) as [place speed]. destruct (trap_lands _ _ inside' flown') as [place' speed'].
      apply (steady alpha g alpha_range M V M_large V_positive bounds weight high low weight_positive low_positive d z w z' w'); try assumption;
        try (now apply trap_nearby); lra.
    Qed.

    Theorem local_contraction d z w z' w' : in_trap 0 z -> in_trap 0 z' -> apart d z z' -> flight z w -> flight z' w' -> 0 < d ->
      spread * d * (2 * M) <= low -> apart (rate * d + excess * d ^ 2) w w'.
    Proof.
      intros inside inside' close flown flown' positive short.
      pose proof (close_landings d z w z' w' inside inside' close flown flown' positive short) as move.
      destruct (first_order alpha g alpha_range M V M_large bounds weight high low d z w z' w' positive spread_positive close flown flown' move)
        as (p & q & rest & p_place & q_place & dy_is & ds_is & rest_small).
      destruct (trap_lands _ _ inside flown) as [w_place w_speed]. destruct (trap_lands _ _ inside' flown') as [w_place' w_speed'].
      destruct inside as [place speed]. destruct inside' as [place' speed']. destruct close as [near close]. rewrite Rminus_0_r in *.
      pose proof (trap_downward p ltac:(lra)) as p_lag. pose proof (trap_downward (q - 1) ltac:(lra)) as q_lag.
      rewrite <- downward_period in q_lag. replace (q - 1 + 1) with q in q_lag by ring.
      destruct (norm (fst w - fst z) (1 - downward p) (1 - downward p) (1 - downward q) (snd z) (snd w)) as [first second]; [lra..|].
      set (A := ((fst w - fst z) * (1 - downward p) - alpha * snd z) / snd w) in *. set (B := alpha * (fst w - fst z) / snd w) in *.
      assert (solved : fst w' - fst w = A * (fst z' - fst z) + B * (snd z' - snd z) + rest / snd w).
      { apply Rmult_eq_reg_l with (snd w); [|lra]. rewrite dy_is. unfold A, B. field. lra. }
      pose proof (combined _ _ _ _ _ d weight first near close ltac:(lra) ltac:(lra)) as x_part.
      pose proof (combined _ _ _ _ _ d weight second near close ltac:(lra) ltac:(lra)) as s_part.
      assert (rest_bound : - (curvature / low * d ^ 2) <= rest / snd w <= curvature / low * d ^ 2).
      { assert (0 < / snd w <= / low) by (split; [apply Rinv_0_lt_compat|apply Rinv_le_contravar]; lra).
        replace (curvature / low * d ^ 2) with (curvature * d ^ 2 * / low) by (unfold Rdiv; ring).
        apply product_within; [exact rest_small|lra]. }
      set (Q := curvature / low * d ^ 2) in *. assert (Q_positive : 0 <= Q) by lra.
      assert (share : 0 <= M / weight) by (apply Rlt_le, Rdiv_lt_0_compat; lra).
      assert (excess_is : excess * d ^ 2 = Q + Q * (M / weight)) by (unfold excess, Q; ring).
      assert (more : 0 <= Q * (M / weight)) by now apply Rmult_le_pos.
      rewrite excess_is. split; [rewrite solved; lra|].
      pose proof (product_within (1 - downward q) (rest / snd w) M Q (proj1 (bounds q)) rest_bound) as last.
      assert (weighted : weight * (Q + Q * (M / weight)) = weight * Q + M * Q) by (field; lra).
      assert (0 <= weight * Q) by (apply Rmult_le_pos; lra).
      rewrite ds_is, solved, Rmult_plus_distr_l, weighted. lra.
    Qed.

    Lemma flight_is_lands z w : in_trap 0 z -> flight z w -> w = lands z.
    Proof.
      intros inside flown. pose proof spread_positive as wide.
      assert (same : fst w = fst (lands z)).
      { destruct (Req_dec (fst w - fst (lands z)) 0) as [zero|other]; [lra|]. exfalso. apply Rabs_pos_lt in other.
        set (gap_ := Rabs (fst w - fst (lands z))) in *. set (d := Rmin (low / (2 * M)) (gap_ / 2) / spread).
        assert (d_positive : 0 < d) by (unfold d; apply Rdiv_lt_0_compat; [apply Rmin_glb_lt; [apply Rdiv_lt_0_compat|]|]; lra).
        assert (d_is : spread * d = Rmin (low / (2 * M)) (gap_ / 2)) by (unfold d; field; lra).
        pose proof (Rmin_l (low / (2 * M)) (gap_ / 2)) as first. pose proof (Rmin_r (low / (2 * M)) (gap_ / 2)) as second. rewrite <- d_is in first, second.
        pose proof (close_landings d z w z (lands z) inside inside ltac:(unfold SineLanding.apart; assert (0 < weight * d) by (now apply Rmult_lt_0_compat); lra)
          flown (trap_flies z inside) d_positive) as close.
        assert (short : spread * d * (2 * M) <= low).
        { apply Rmult_le_compat_r with (r := 2 * M) in first; [|lra]. replace (low / (2 * M) * (2 * M)) with low in first by (field; lra). exact first. }
        specialize (close short). unfold gap_, Rabs in *. destruct (Rcase_abs (fst w - fst (lands z))); lra. }
      destruct w as [y t]. destruct flown as (_ & _ & _ & speed). cbn [fst snd] in *. unfold SineLanding.lands in *. cbn [fst] in same. now rewrite speed, same.
    Qed.

    (* ------------------------------------------------------------ along the segment between two states *)

    Definition between (t : R) (z z' : Impact) : Impact := (fst z + t * (fst z' - fst z), snd z + t * (snd z' - snd z)).

    Lemma between_in_trap t z z' : 0 <= t <= 1 -> in_trap 0 z -> in_trap 0 z' -> in_trap 0 (between t z z').
    Proof.
      intros range [place speed] [place' speed']. unfold in_trap, between. cbn [fst snd]. rewrite Rminus_0_r in *. split; now apply convex.
    Qed.

    Theorem trap_contracts D z z' : 0 < D -> in_trap 0 z -> in_trap 0 z' -> apart D z z' -> apart (rate * D) (lands z) (lands z').
    Proof.
      intros positive inside inside' far. pose proof spread_positive as wide.
      assert (steps : forall n, (0 < n)%nat -> spread * (D / INR n) * (2 * M) <= low ->
        apart (rate * D + excess * D ^ 2 / INR n) (lands z) (lands z')).
      { intros n some short. assert (n_positive : 0 < INR n) by now apply lt_0_INR. set (d := D / INR n) in *.
        assert (d_positive : 0 < d) by now apply Rdiv_lt_0_compat. assert (D_is : D = INR n * d) by (unfold d; field; lra).
        assert (all : forall i, (i <= n)%nat -> apart (INR i * (rate * d + excess * d ^ 2)) (lands z) (lands (between (INR i / INR n) z z'))).
        { induction i as [|i IH]; intro small.
          - unfold Rdiv. rewrite Rmult_0_l. unfold between, SineLanding.apart. rewrite !Rmult_0_l, !Rplus_0_r, <- surjective_pairing. lra.
          - assert (range : forall j, (j <= n)%nat -> 0 <= INR j / INR n <= 1).
            { intros j bound. pose proof (pos_INR j). apply le_INR in bound. split; [unfold Rdiv; apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|].
              apply Rmult_le_reg_r with (INR n); [lra|]. replace (INR j / INR n * INR n) with (INR j) by (field; lra). lra. }
            pose proof (between_in_trap _ z z' (range i ltac:(lia)) inside inside') as here. pose proof (between_in_trap _ z z' (range (S i) small) inside inside') as there.
            assert (close : apart d (between (INR i / INR n) z z') (between (INR (S i) / INR n) z z')).
            { unfold SineLanding.apart, between in *. cbn [fst snd]. rewrite S_INR.
              replace (fst z + (INR i + 1) / INR n * (fst z' - fst z) - (fst z + INR i / INR n * (fst z' - fst z))) with ((fst z' - fst z) * / INR n) by (field; lra).
              replace (snd z + (INR i + 1) / INR n * (snd z' - snd z) - (snd z + INR i / INR n * (snd z' - snd z))) with ((snd z' - snd z) * / INR n) by (field; lra).
              assert (0 < / INR n) by now apply Rinv_0_lt_compat. replace (weight * d) with (weight * D * / INR n) by (unfold d, Rdiv; ring).
              replace d with (D * / INR n) by reflexivity. destruct far. split; apply scaled_within; lra. }
            pose proof (local_contraction d _ _ _ _ here there close (trap_flies _ here) (trap_flies _ there) d_positive short) as step.
            specialize (IH ltac:(lia)). set (w := lands (between (INR (S i) / INR n) z z')) in *. rewrite S_INR. unfold SineLanding.apart in *. lra. }
        specialize (all n (le_n n)). replace (INR n / INR n) with 1 in all by (field; lra).
        replace (between 1 z z') with z' in all by (unfold between; destruct z'; cbn [fst snd]; f_equal; ring).
        replace (rate * D + excess * D ^ 2 / INR n) with (INR n * (rate * d + excess * d ^ 2)); [exact all|]. unfold d. field. lra. }
      assert (limits : forall e, 0 < e -> apart (rate * D + e) (lands z) (lands z')).
      { intros e e_positive. destruct (exceeded_by_a_number (Rabs (excess * D ^ 2) / e + spread * D * (2 * M) / low)) as [n enough].
        assert (first : 0 <= Rabs (excess * D ^ 2) / e) by (unfold Rdiv; apply Rmult_le_pos; [apply Rabs_pos|apply Rlt_le, Rinv_0_lt_compat; lra]).
        assert (second : 0 < spread * D * (2 * M) / low) by (apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; [now apply Rmult_lt_0_compat|lra]|lra]).
        assert (n_positive : 0 < INR n) by lra.
        assert (some : (0 < n)%nat) by (apply INR_lt; cbn; lra).
        assert (short : spread * (D / INR n) * (2 * M) <= low).
        { assert (spread * D * (2 * M) <= INR n * low).
          { replace (spread * D * (2 * M)) with (spread * D * (2 * M) / low * low) by (field; lra). apply Rmult_le_compat_r; lra. }
          apply Rmult_le_reg_r with (INR n); [lra|]. replace (spread * (D / INR n) * (2 * M) * INR n) with (spread * D * (2 * M)) by (field; lra). lra. }
        specialize (steps n some short).
        assert (small : excess * D ^ 2 / INR n <= e).
        { apply Rmult_le_reg_r with (INR n); [lra|]. replace (excess * D ^ 2 / INR n * INR n) with (excess * D ^ 2) by (field; lra).
          apply Rle_trans with (1 := Rle_abs _). replace (Rabs (excess * D ^ 2)) with (e * (Rabs (excess * D ^ 2) / e)) by (field; lra). apply Rmult_le_compat_l; lra. }
        unfold SineLanding.apart in *. assert (weight * (excess * D ^ 2 / INR n) <= weight * e) by (apply Rmult_le_compat_l; lra). lra. }
      assert (weights : forall e, 0 < e -> exists f, 0 < f /\ weight * f = e)
        by (intros e some; exists (e / weight); split; [now apply Rdiv_lt_0_compat|field; lra]).
      split; split; apply le_epsilon; intros e some.
      1, 2: destruct (limits e some); lra.
      all: destruct (weights e some) as (f & less & equal); destruct (limits f less); lra.
    Qed.
  End Bounded.

  Theorem flights_contract D z z' w w' : 0 < D -> in_trap 0 z -> in_trap 0 z' -> apart D z z' -> flight z w -> flight z' w' -> apart (rate * D) w w'.
  Proof.
    intros positive inside inside' far flown flown'. destruct (table_bounded alpha g) as (M & V & M_large & V_positive & bounds).
    rewrite (flight_is_lands M V M_large V_positive bounds z w inside flown), (flight_is_lands M V M_large V_positive bounds z' w' inside' flown').
    exact (trap_contracts M V M_large V_positive bounds D z z' positive inside inside' far).
  Qed.
End Trap.
