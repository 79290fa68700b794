(* The theorem: for 0 < alpha < 1/3 every orbit converges to e_1, which is Lyapunov stable; and 1/3 is sharp.

   Defined:  globally_asymptotically_stable.
   Proved:   only_impacts      from rank(s) + 2 periods on, the orbit stays in the trap;
             distance_bound    dist(f^(N+k) s, e_1) <= (2 alpha)^k for N >= rank(s) + 3;
             sharper_bound     and <= (1 + k) alpha^k;
             global            0 < alpha < 1/3 implies that e_1 is globally asymptotically stable on H;
             e_2_has_period_2  for 1/3 <= alpha < 1 the orbit of e_2 is in H, has period 2 and stays away from e_1;
             sharp             for 0 < alpha < 1: globally asymptotically stable <-> alpha < 1/3. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules Map Neighbourhood Ranking.
Open Scope R_scope.

Definition globally_asymptotically_stable (space : State -> Prop) (map : State -> State) (e : State) : Prop :=
  stable space map e /\ attracting space map e.

Section Global.
  Variable alpha : R.
  Hypothesis alpha_range : 0 < alpha < 1 / 3.

  Let below_1 : 0 < alpha < 1.
  Proof. lra. Qed.

  Let plain (j : bool) : R := if j then 1 else 1.
  Let near (c : R) (s : State) : Prop := within coordinate (fun j => coordinate j (e_1 alpha)) plain c s.

  Lemma near_is_dist c s : near c s <-> dist s (e_1 alpha) <= c.
  Proof.
    unfold near, plain. rewrite dist_weighted, dist_at_most. now rewrite !Rmult_1_r.
  Qed.

  Lemma plain_bounded (j : bool) : 1 <= plain j <= 1.
  Proof. destruct j; cbn; lra. Qed.

  Lemma trap_contracts_near c s : 0 <= c -> trap alpha s -> near c s -> near (2 * alpha * c) (f alpha s).
  Proof.
    intros positive inside close. apply near_is_dist, dist_at_most in close. apply near_is_dist, dist_at_most.
    apply trap_contracts; [exact below_1|lra|exact inside|exact close].
  Qed.

  Lemma near_trap_is_near s : near_trap alpha s -> near 1 s.
  Proof. intro inside. apply near_trap_is in inside as [_ close]. now apply near_is_dist, dist_at_most. Qed.

  Theorem only_impacts s n : H s -> rank s + 2 <= INR n -> trap alpha (iterate (f alpha) n s).
  Proof.
    intros above late.
    apply (descent (f alpha) H rank (low_impact :: corner :: trap alpha :: nil)%list) with (s := s) (n := n).
    - now apply H_invariant.
    - now apply rank_nonnegative.
    - intros t there. destruct (rank_falls alpha below_1 ltac:(lra) t there) as [[k staged]|falls]; [left|now right].
      destruct k as [|[|[|[|k]]]]; [exists 0%nat|exists 1%nat|exists 2%nat|exists 2%nat|destruct k; contradiction];
        try exact staged. now apply near_trap_is.
    - intros [|[|k]] t less there; cbn [stage nth];
        [now apply low_impact_leads_to_corner; try lra|now apply corner_leads_to_trap; try lra|cbn in less; lia].
    - intros t _ inside. apply trap_invariant; [exact below_1|lra|exact inside].
    - exact above.
    - cbn [length Nat.sub INR]. lra.
  Qed.

  Theorem distance_bound s n k : H s -> rank s + 3 <= INR n -> dist (iterate (f alpha) (n + k) s) (e_1 alpha) <= (2 * alpha) ^ k.
  Proof.
    intros above late. apply near_is_dist. rewrite <- (Rmult_1_r ((2 * alpha) ^ k)).
    apply (approach (f alpha) coordinate (fun j => coordinate j (e_1 alpha)) plain (trap alpha) (2 * alpha))
      with (space := H) (rank := rank) (stages := stages alpha).
    - intros t inside. apply trap_invariant; [exact below_1|lra|exact inside].
    - lra.
    - exact trap_contracts_near.
    - now apply H_invariant.
    - now apply rank_nonnegative.
    - apply rank_falls; [exact below_1|lra].
    - apply stage_leads_on; [exact below_1|lra].
    - intros t _. apply near_trap_invariant; [exact below_1|lra].
    - intros t _ inside. now apply near_trap_is.
    - lra.
    - intros t _. apply near_trap_is_near.
    - exact above.
    - cbn [length stages Nat.sub INR]. lra.
  Qed.

  Theorem sharper_bound s n k :
    H s -> rank s + 3 <= INR n -> dist (iterate (f alpha) (n + k) s) (e_1 alpha) <= (1 + INR k) * alpha ^ k.
  Proof.
    intros above late. rewrite iterate_add. set (t := iterate (f alpha) n s).
    assert (close : dist t (e_1 alpha) <= 1).
    { pose proof (distance_bound s n 0 above late) as close. rewrite PeanoNat.Nat.add_0_r in close. exact close. }
    assert (inside : trap alpha t) by (apply only_impacts; [exact above|lra]).
    destruct (impact_closed_form alpha below_1 (trap alpha) (trap_invariant alpha below_1 ltac:(lra)) t inside k) as [first second].
    apply dist_at_most in close as [small_x small_w]. apply dist_at_most. rewrite first, second, !Rabs_mult.
    rewrite <- RPow_abs, Rabs_Ropp, (Rabs_right alpha), (Rmult_comm (1 + INR k)) by lra.
    pose proof (pos_INR k) as count. assert (power : 0 <= alpha ^ k) by (apply pow_le; lra).
    split; apply Rmult_le_compat_l; try exact power.
    - apply absolute_bounds in small_x, small_w. apply Rabs_le. nra.
    - lra.
  Qed.

  Theorem global : globally_asymptotically_stable H (f alpha) (e_1 alpha).
  Proof.
    split; [now apply e_1_is_stable|]. intros s above. apply converges_by_coordinates.
    apply (convergence (f alpha) coordinate (fun j => coordinate j (e_1 alpha)) plain (trap alpha) (2 * alpha))
      with (space := H) (lowest := 1) (highest := 1) (rank := rank) (stages := stages alpha) (size := 1).
    - intros t inside. apply trap_invariant; [exact below_1|lra|exact inside].
    - lra.
    - exact trap_contracts_near.
    - lra.
    - lra.
    - exact plain_bounded.
    - now apply H_invariant.
    - now apply rank_nonnegative.
    - apply rank_falls; [exact below_1|lra].
    - apply stage_leads_on; [exact below_1|lra].
    - intros t _. apply near_trap_invariant; [exact below_1|lra].
    - intros t _ inside. now apply near_trap_is.
    - lra.
    - intros t _. apply near_trap_is_near.
    - exact above.
  Qed.
End Global.

(* ---------------------------------------------------------------- 1/3 is sharp *)

Theorem e_2_has_period_2 alpha : 1 / 3 <= alpha < 1 ->
  H (e_2 alpha) /\ f alpha (e_2 alpha) = impact alpha (e_2 alpha) /\ f alpha (f alpha (e_2 alpha)) = flight (impact alpha (e_2 alpha)) /\
  iterate (f alpha) 2 (e_2 alpha) = e_2 alpha /\ snd (e_1 alpha) < snd (e_2 alpha).
Proof.
  intro range.
  assert (square : 0 < (alpha + 1) ^ 2) by (apply pow_lt; lra).
  assert (hits : fst (e_2 alpha) < snd (e_2 alpha)).
  { apply Rminus_gt_0_lt. replace (snd (e_2 alpha) - fst (e_2 alpha)) with ((6 - 2 * alpha) / (alpha + 1) ^ 2).
    - apply Rdiv_lt_0_compat; lra.
    - unfold e_2. cbn [fst snd]. field. lra. }
  assert (flies : snd (impact alpha (e_2 alpha)) <= fst (impact alpha (e_2 alpha))).
  { apply Rminus_le. replace (snd (impact alpha (e_2 alpha)) - fst (impact alpha (e_2 alpha))) with (- ((6 * alpha - 2) / (alpha + 1) ^ 2)).
    - assert (0 <= (6 * alpha - 2) / (alpha + 1) ^ 2) by (apply Rmult_le_pos; [lra|now apply Rlt_le, Rinv_0_lt_compat]). lra.
    - unfold e_2, impact. cbn [fst snd]. field. lra. }
  assert (first : f alpha (e_2 alpha) = impact alpha (e_2 alpha)) by now apply f_impact.
  assert (second : f alpha (f alpha (e_2 alpha)) = flight (impact alpha (e_2 alpha))) by (rewrite first; now apply f_flight).
  split; [|split; [exact first|split; [exact second|split]]].
  - unfold H, e_2. cbn [fst]. apply Rmult_le_pos; [lra|now apply Rlt_le, Rinv_0_lt_compat].
  - change (f alpha (f alpha (e_2 alpha)) = e_2 alpha). rewrite second. unfold e_2, impact, flight. cbn [fst snd]. f_equal; field; lra.
  - unfold e_1, e_2. cbn [snd]. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat|]; lra.
Qed.

(* The orbit of e_2 keeps coming back to e_2, which is not e_1. *)
Theorem e_2_stays_away alpha : 1 / 3 <= alpha < 1 -> forall n, iterate (f alpha) (2 * n) (e_2 alpha) = e_2 alpha /\ 0 < dist (e_2 alpha) (e_1 alpha).
Proof.
  intros range n. destruct (e_2_has_period_2 alpha range) as (_ & _ & _ & back & apart). split; [now apply iterate_periodic|].
  unfold dist. apply Rlt_le_trans with (2 := Rmax_r _ _). apply Rabs_pos_lt. lra.
Qed.

Theorem not_attracting alpha : 1 / 3 <= alpha < 1 -> ~ attracting H (f alpha) (e_1 alpha).
Proof.
  intros range attracts. destruct (e_2_has_period_2 alpha range) as (above & _ & _ & back & apart).
  apply (periodic_orbit_stays_away (f alpha) coordinate (fun j => coordinate j (e_1 alpha)) 2 (e_2 alpha) false).
  - lia.
  - exact back.
  - cbn [coordinate]. lra.
  - apply converges_by_coordinates, attracts, above.
Qed.

Theorem sharp alpha : 0 < alpha < 1 -> globally_asymptotically_stable H (f alpha) (e_1 alpha) <-> alpha < 1 / 3.
Proof.
  intro range. split.
  - intros [_ attracts]. apply Rnot_le_lt. intro large. apply (not_attracting alpha); [lra|exact attracts].
  - intro small. apply global. lra.
Qed.
