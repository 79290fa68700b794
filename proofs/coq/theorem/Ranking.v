(* The rank that falls and the stages that it falls to: what leads every orbit to impacts only.

   Defined:  speed U = sqrt(4 x + (w - 1)^2), so that U^2 is twice the energy in units of r^2; rank = 2 U + (1 - w) / 2; the stages
             low_impact {x < w < 6}, corner {w > 0, x + w <= 2}, trap {0 <= x < w, alpha w < 1}, near_trap, the trap within 1 of e_1;
             below_boundary, U <= (1 + alpha) / (1 - alpha).
   Proved:   H_invariant; flight_keeps_speed; boundary_invariant for every 0 < alpha < 1; for 0 < alpha < 1/3: the rank falls by 1
             outside the stages, each stage leads to the next, the trap is invariant and only impacts happen in it. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules Map Neighbourhood.
Import ListNotations.
Open Scope R_scope.

Definition speed (s : State) : R := sqrt (4 * fst s + (snd s - 1) ^ 2).
Definition rank (s : State) : R := 2 * speed s + (1 - snd s) / 2.

Definition low_impact (s : State) : Prop := fst s < snd s /\ snd s < 6.
Definition corner (s : State) : Prop := 0 < snd s /\ fst s + snd s <= 2.
Definition trap (alpha : R) (s : State) : Prop := 0 <= fst s /\ fst s < snd s /\ alpha * snd s < 1.
Definition near_trap (alpha : R) (s : State) : Prop :=
  0 <= fst s /\ fst s < snd s /\ alpha * snd s < 1 /\
  fst s - fst (e_1 alpha) <= 1 /\ fst (e_1 alpha) - fst s <= 1 /\ snd s - snd (e_1 alpha) <= 1 /\ snd (e_1 alpha) - snd s <= 1.
Definition stages (alpha : R) : list (State -> Prop) := [low_impact; corner; trap alpha; near_trap alpha].

Definition below_boundary (alpha : R) (s : State) : Prop := H s /\ speed s <= (alpha + 1) / (1 - alpha).

Lemma speed_equation s : H s -> 0 <= speed s /\ speed s * speed s = 4 * fst s + (snd s - 1) ^ 2.
Proof.
  unfold H, speed. intro above. split; [apply sqrt_pos|]. apply sqrt_sqrt. pose proof (pow2_ge_0 (snd s - 1)). lra.
Qed.

Lemma speed_at_most s u : 0 <= u -> 4 * fst s + (snd s - 1) ^ 2 <= u * u -> speed s <= u.
Proof. intros positive bound. rewrite <- (sqrt_square u) by exact positive. now apply sqrt_le_1_alt. Qed.

Lemma speed_bounds_w s : H s -> - speed s <= snd s - 1 <= speed s.
Proof.
  intro above. destruct (speed_equation s above) as [positive square]. unfold H in above.
  split; apply Rnot_lt_le; intro beyond; nra.
Qed.

Lemma near_trap_is alpha s :
  near_trap alpha s <-> trap alpha s /\ Rabs (fst s - fst (e_1 alpha)) <= 1 /\ Rabs (snd s - snd (e_1 alpha)) <= 1.
Proof.
  unfold near_trap, trap. split.
  - intros (above & hits & narrow & close). repeat split; try lra; apply Rabs_le; lra.
  - intros ((above & hits & narrow) & first & second). apply absolute_bounds in first, second. lra.
Qed.

Section Ranking.
  Variable alpha : R.
  Hypothesis alpha_range : 0 < alpha < 1.

  Lemma H_invariant s : H s -> H (f alpha s).
  Proof.
    unfold H. intro above. destruct (Rlt_dec (fst s) (snd s)) as [hits|flies].
    - rewrite f_impact by exact hits. cbn [impact fst]. nra.
    - rewrite f_flight by lra. cbn [flight fst]. lra.
  Qed.

  Lemma flight_keeps_speed s : speed (flight s) = speed s.
  Proof. unfold speed. cbn [flight fst snd]. f_equal. ring. Qed.

  Lemma impact_speed s : 0 <= fst s -> 0 <= snd s -> speed (impact alpha s) <= 1 + alpha * snd s.
  Proof. intros height closing. apply speed_at_most; cbn [impact fst snd]; nra. Qed.

  (* The states whose energy is at most ((1 + alpha) / (1 - alpha))^2 / 2, in units of r^2, are never left. *)
  Lemma boundary_invariant s : below_boundary alpha s -> below_boundary alpha (f alpha s).
  Proof.
    intros [above bound]. split; [now apply H_invariant|].
    destruct (Rlt_dec (fst s) (snd s)) as [hits|flies].
    - rewrite f_impact by exact hits. pose proof (speed_bounds_w s above) as [_ upper]. unfold H in above.
      apply Rle_trans with (1 + alpha * snd s); [apply impact_speed; lra|].
      replace ((alpha + 1) / (1 - alpha)) with (1 + alpha * (1 + (alpha + 1) / (1 - alpha))) by (field; lra).
      apply Rplus_le_compat_l, Rmult_le_compat_l; lra.
    - rewrite f_flight by lra. now rewrite flight_keeps_speed.
  Qed.

  Lemma rank_nonnegative s : H s -> 0 <= rank s.
  Proof. intro above. destruct (speed_equation s above) as [positive _]. pose proof (speed_bounds_w s above) as bounds. unfold rank. lra. Qed.

  Hypothesis alpha_small : alpha < 1 / 3.

  Lemma rank_falls s : H s -> (exists k, stage (stages alpha) k s) \/ rank (f alpha s) <= rank s - 1.
  Proof.
    intro above. destruct (Rlt_dec (fst s) (snd s)) as [hits|flies].
    - destruct (Rlt_dec (snd s) 6) as [slow|fast]; [left; exists 0%nat; split; assumption|].
      right. rewrite f_impact by exact hits. unfold rank.
      pose proof (speed_bounds_w s above) as [_ upper]. unfold H in above.
      pose proof (impact_speed s above ltac:(lra)) as slower. cbn [impact snd] in *. nra.
    - right. rewrite f_flight by lra. unfold rank. rewrite flight_keeps_speed. cbn [flight snd]. lra.
  Qed.

  Lemma low_impact_leads_to_corner s : H s -> low_impact s -> corner (f alpha s).
  Proof.
    unfold H, low_impact, corner. intros above [hits slow]. rewrite f_impact by exact hits. cbn [impact fst snd]. split; nra.
  Qed.

  Lemma corner_leads_to_trap s : H s -> corner s -> trap alpha (f alpha s).
  Proof.
    unfold H, corner, trap. intros above [closing sum]. destruct (Rlt_dec (fst s) (snd s)) as [hits|flies].
    - rewrite f_impact by exact hits. cbn [impact fst snd]. repeat split; nra.
    - rewrite f_flight by lra. cbn [flight fst snd]. repeat split; nra.
  Qed.

  Theorem trap_invariant s : trap alpha s -> fst s < snd s /\ trap alpha (f alpha s).
  Proof.
    unfold trap. intros (above & hits & narrow). split; [exact hits|].
    rewrite f_impact by exact hits. cbn [impact fst snd]. repeat split; nra.
  Qed.

  Lemma trap_contracts c s : trap alpha s -> Rabs (fst s - fst (e_1 alpha)) <= c /\ Rabs (snd s - snd (e_1 alpha)) <= c ->
    Rabs (fst (f alpha s) - fst (e_1 alpha)) <= 2 * alpha * c /\ Rabs (snd (f alpha s) - snd (e_1 alpha)) <= 2 * alpha * c.
  Proof.
    intros inside [first second]. rewrite f_impact by apply (trap_invariant s inside).
    destruct (impact_offset alpha alpha_range s) as [-> ->].
    apply absolute_bounds in first, second. split; apply Rabs_le; nra.
  Qed.

  Lemma trap_leads_near s : trap alpha s -> near_trap alpha (f alpha s).
  Proof.
    intro inside. apply near_trap_is. split; [now apply trap_invariant|]. rewrite f_impact by apply (trap_invariant s inside).
    destruct inside as (above & hits & narrow).
    pose proof (e_1_range alpha alpha_range) as (low & order & half & speed_low & speed_high).
    pose proof (ex_equation alpha alpha_range) as EX. pose proof (ew_equation alpha alpha_range) as EW.
    cbn [impact fst snd]. split; apply Rabs_le; split; nra.
  Qed.

  Lemma near_trap_invariant s : near_trap alpha s -> near_trap alpha (f alpha s).
  Proof. intro inside. now apply trap_leads_near, near_trap_is. Qed.

  Lemma stage_leads_on k s : (S k < length (stages alpha))%nat -> H s -> stage (stages alpha) k s -> stage (stages alpha) (S k) (f alpha s).
  Proof.
    intros less above. destruct k as [|[|[|k]]]; cbn [stage nth stages].
    - now apply low_impact_leads_to_corner.
    - now apply corner_leads_to_trap.
    - apply trap_leads_near.
    - cbn in less. lia.
  Qed.
End Ranking.
