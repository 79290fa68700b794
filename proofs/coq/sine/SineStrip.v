(* The absorbing strip: every motion comes to closing speeds below top, and stays there.

   Proved:   strip         s1 <= rho + sqrt ((rho + alpha s)^2 + 2 rho/pi) for every flight, rho being the greatest speed of the table;
             strip_stays   where this is below top at s = top, no stage leads from s <= top above top;
             strip_enters  and every motion comes below. *)

From Coq Require Import Reals Lra Lia.
From Juggleproof Require Import Rules SineTable SineMotions.
Open Scope R_scope.

Section Strip.
  Variables alpha g rho : R.
  Hypothesis alpha_range : 0 <= alpha < 1.
  Hypothesis rho_nonnegative : 0 <= rho.
  Hypothesis rho_is : half_gap alpha ^ 2 + g ^ 2 <= rho ^ 2.
  Local Notation flight := (flight alpha g).
  Local Notation stage := (stage alpha g).
  Local Notation motion := (motion alpha g).

  Definition greatest_arrival (s : R) : R := rho + sqrt ((rho + alpha * s) ^ 2 + 2 * rho / PI).

  Lemma wave_bound a b x : a ^ 2 + b ^ 2 <= rho ^ 2 -> - rho <= wave a b x <= rho.
  Proof.
    intro bound. unfold wave. pose proof (sin2_cos2 (2 * PI * x)) as unit. unfold Rsqr in unit.
    set (u := sin (2 * PI * x)) in *. set (w := cos (2 * PI * x)) in *.
    assert (square : (a * u + b * w) ^ 2 <= rho ^ 2).
    { apply Rle_trans with (2 := bound). replace (a ^ 2 + b ^ 2) with ((a ^ 2 + b ^ 2) * (u * u + w * w)) by (rewrite unit; ring).
      pose proof (pow2_ge_0 (a * w - b * u)). lra. }
    split; nra.
  Qed.

  Theorem strip z w : flight z w -> 0 <= snd z -> snd w <= greatest_arrival (snd z).
  Proof.
    intros (_ & zero & _ & ->) slow. unfold greatest_arrival. pose proof PI_RGT_0 as pi.
    assert (speed : forall x, - rho <= velocity alpha g x <= rho) by (intro; apply wave_bound; lra).
    assert (high : forall x, - (rho / (2 * PI)) <= height alpha g x <= rho / (2 * PI)).
    { intro x. pose proof (wave_bound (half_gap alpha) g x rho_is) as bound.
      assert (0 < / (2 * PI)) by (apply Rinv_0_lt_compat; lra). unfold height, Rdiv. nra. }
    unfold arrival, gap in *. set (u := rebound alpha g z) in *. set (d := fst w - fst z) in *.
    pose proof (speed (fst w)). pose proof (high (fst z)). pose proof (high (fst w)).
    assert (u_bound : u ^ 2 <= (rho + alpha * snd z) ^ 2).
    { pose proof (speed (fst z)). assert (0 <= alpha * snd z) by (apply Rmult_le_pos; lra).
      assert (- (rho + alpha * snd z) <= u <= rho + alpha * snd z) by (unfold u, rebound; lra). nra. }
    assert (room : 2 * rho / PI = 4 * (rho / (2 * PI))) by (field; lra).
    assert (square : (d - u) ^ 2 <= (rho + alpha * snd z) ^ 2 + 2 * rho / PI) by nra.
    assert (d - u <= sqrt ((rho + alpha * snd z) ^ 2 + 2 * rho / PI)); [|lra].
    apply Rle_trans with (Rabs (d - u)); [apply Rle_abs|]. rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr. lra.
  Qed.

  Variable top : R.
  Hypothesis top_nonnegative : 0 <= top.
  Hypothesis absorbs : greatest_arrival top < top.

  Lemma room_nonnegative : 0 <= 2 * rho / PI.
  Proof. pose proof PI_RGT_0. unfold Rdiv. apply Rmult_le_pos; [lra|]. apply Rlt_le, Rinv_0_lt_compat. lra. Qed.

  Theorem strip_stays z w : stage z w -> 0 <= snd z <= top -> snd w <= top.
  Proof.
    intros [flown|? ? ? ? ? ? ->|? ? ? ->] [slow below]; try lra.
    apply Rle_trans with (1 := strip z w flown slow). apply Rle_trans with (greatest_arrival top); [|lra].
    apply Rplus_le_compat_l, sqrt_le_1_alt. pose proof (Rmult_le_pos _ _ (proj1 alpha_range) slow).
    assert (alpha * snd z <= alpha * top) by (apply Rmult_le_compat_l; lra). nra.
  Qed.

  (* Above top, a flight loses at least what greatest_arrival leaves below top. *)
  Lemma above_falls z w : stage z w -> top <= snd z -> snd w <= top \/ snd w <= snd z - (top - greatest_arrival top).
  Proof.
    intros [flown|? ? ? ? ? ? ->|? ? ? ->] above; [right|left; lra|left; lra].
    apply Rle_trans with (1 := strip z w flown ltac:(lra)). set (s := snd z) in *. unfold greatest_arrival.
    pose proof room_nonnegative as room. set (h := 2 * rho / PI) in *.
    set (p := rho + alpha * top). set (q := rho + alpha * s).
    assert (order : 0 <= p <= q) by (unfold p, q; split; [apply Rplus_le_le_0_compat; [lra|apply Rmult_le_pos; lra]|apply Rplus_le_compat_l, Rmult_le_compat_l; lra]).
    pose proof (sqrt_pos (p ^ 2 + h)). pose proof (pow2_sqrt (p ^ 2 + h) ltac:(pose proof (pow2_ge_0 p); lra)) as square.
    set (r := sqrt (p ^ 2 + h)) in *.
    assert (p <= r) by nra.
    assert (sqrt (q ^ 2 + h) <= r + (q - p)).
    { rewrite <- (sqrt_pow2 (r + (q - p))) by lra. apply sqrt_le_1_alt. nra. }
    assert (q - p <= s - top) by (unfold p, q; nra). lra.
  Qed.

  Theorem strip_enters z : motion z -> exists n, snd (z n) <= top.
  Proof.
    intros moves. pose proof (motion_speeds alpha g z moves) as speeds. destruct moves as (_ & goes & _).
    set (loss := top - greatest_arrival top). assert (positive : 0 < loss) by (unfold loss; lra).
    assert (falls : forall k n, snd (z n) <= top + INR k * loss -> exists m, snd (z m) <= top).
    { induction k as [|k IH]; intros n bound; [exists n; cbn in bound; lra|]. rewrite S_INR in bound.
      destruct (Rle_dec (snd (z n)) top) as [yes|no]; [now exists n|].
      destruct (above_falls _ _ (goes n) ltac:(lra)) as [below|less]; [now exists (S n)|]. apply (IH (S n)). fold loss in less. lra. }
    destruct (exceeded_by_a_number ((snd (z O) - top) / loss)) as [k enough]. apply (falls k O).
    apply Rmult_le_compat_r with (r := loss) in enough; [|lra]. replace ((snd (z O) - top) / loss * loss) with (snd (z O) - top) in enough by (field; lra). lra.
  Qed.
End Strip.
