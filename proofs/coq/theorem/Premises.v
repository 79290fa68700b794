(* Every premise of the rules of Rules.v for the ball, as single inequalities: what a checker has to find true for 0 < alpha < 1/3.

   Proved:   space_kept, rank_at_least_0, rank_or_stage, stages_lead_on, trap_contracts_weighted, near_trap_size, near_trap_radius;
             neighbourhood_contracts and neighbourhood_radius, for every 0 < alpha < 1, from which e_1 is stable. *)

From Coq Require Import Reals Lra.
From Juggleproof Require Import Rules Map Neighbourhood Ranking.
Open Scope R_scope.

Theorem space_kept alpha s : 0 < alpha < 1 / 3 -> H s -> H (f alpha s).
Proof. intro range. apply H_invariant. lra. Qed.

Theorem rank_at_least_0 s : H s -> 0 <= rank s.
Proof. apply rank_nonnegative. Qed.

Theorem rank_or_stage alpha s : 0 < alpha < 1 / 3 -> H s ->
  low_impact s \/ corner s \/ trap alpha s \/ near_trap alpha s \/ rank (f alpha s) <= rank s - 1.
Proof.
  intros range above. destruct (rank_falls alpha ltac:(lra) ltac:(lra) s above) as [[k staged]|falls]; [|now do 4 right].
  destruct k as [|[|[|[|k]]]]; [now left|now right; left|now do 2 right; left|now do 3 right; left|destruct k; contradiction].
Qed.

Theorem stages_lead_on alpha s : 0 < alpha < 1 / 3 -> H s ->
  (low_impact s -> corner (f alpha s)) /\ (corner s -> trap alpha (f alpha s)) /\ (trap alpha s -> near_trap alpha (f alpha s)) /\
  (near_trap alpha s -> near_trap alpha (f alpha s)).
Proof.
  intros range above. assert (lossy : 0 < alpha < 1) by lra. assert (small : alpha < 1 / 3) by lra.
  split; [|split; [|split]]; intro staged.
  - exact (low_impact_leads_to_corner alpha lossy small s above staged).
  - exact (corner_leads_to_trap alpha lossy small s above staged).
  - exact (trap_leads_near alpha lossy small s staged).
  - exact (near_trap_invariant alpha lossy small s staged).
Qed.

Theorem trap_contracts_weighted alpha c s : 0 < alpha < 1 / 3 -> 0 <= c -> near_trap alpha s ->
  Rabs (fst s - fst (e_1 alpha)) <= c * 1 /\ Rabs (snd s - snd (e_1 alpha)) <= c * 1 ->
  Rabs (fst (f alpha s) - fst (e_1 alpha)) <= 2 * alpha * c * 1 /\ Rabs (snd (f alpha s) - snd (e_1 alpha)) <= 2 * alpha * c * 1.
Proof.
  intros range positive inside close. rewrite !Rmult_1_r in *.
  apply trap_contracts; [lra|lra|now apply near_trap_is|exact close].
Qed.

Theorem near_trap_size alpha s : near_trap alpha s -> Rabs (fst s - fst (e_1 alpha)) <= 1 * 1 /\ Rabs (snd s - snd (e_1 alpha)) <= 1 * 1.
Proof. intro inside. rewrite Rmult_1_r. now apply near_trap_is. Qed.

Theorem near_trap_radius alpha s : 0 < alpha < 1 / 3 -> H s ->
  Rabs (fst s - fst (e_1 alpha)) <= 1 / 2 * 1 /\ Rabs (snd s - snd (e_1 alpha)) <= 1 / 2 * 1 -> near_trap alpha s.
Proof.
  unfold H. intros range above [first second]. apply absolute_bounds in first, second.
  pose proof (ew_equation alpha ltac:(lra)) as EW. pose proof (ex_equation alpha ltac:(lra)) as EX.
  pose proof (e_1_range alpha ltac:(lra)) as (low & order & half & speed_low & speed_high).
  set (ex := fst (e_1 alpha)) in *. set (ew := snd (e_1 alpha)) in *.
  assert (wide : 3 / 2 < ew) by nra.
  assert (gap : 1 < ew - ex) by nra.
  unfold near_trap. fold ex ew. repeat split; try lra. nra.
Qed.

Theorem neighbourhood_contracts alpha c s : 0 < alpha < 1 -> 0 <= c ->
  Rabs (fst s - fst (e_1 alpha)) <= local_radius alpha * local_weight alpha true /\
  Rabs (snd s - snd (e_1 alpha)) <= local_radius alpha * local_weight alpha false ->
  Rabs (fst s - fst (e_1 alpha)) <= c * local_weight alpha true /\ Rabs (snd s - snd (e_1 alpha)) <= c * local_weight alpha false ->
  Rabs (fst (f alpha s) - fst (e_1 alpha)) <= local_rate alpha * c * local_weight alpha true /\
  Rabs (snd (f alpha s) - snd (e_1 alpha)) <= local_rate alpha * c * local_weight alpha false.
Proof.
  intros range positive [first second] [close_x close_w].
  pose proof (f_contracts alpha range c s positive) as step. split.
  - apply (step (fun j => match j with true => first | false => second end) (fun j => match j with true => close_x | false => close_w end) true).
  - apply (step (fun j => match j with true => first | false => second end) (fun j => match j with true => close_x | false => close_w end) false).
Qed.

(* The explicit neighbourhood is attracted, at the local rate. *)
Theorem neighbourhood_attracted alpha n s : 0 < alpha < 1 ->
  Rabs (fst s - fst (e_1 alpha)) <= local_radius alpha * local_weight alpha true /\
  Rabs (snd s - snd (e_1 alpha)) <= local_radius alpha * local_weight alpha false ->
  Rabs (fst (iterate (f alpha) n s) - fst (e_1 alpha)) <= local_rate alpha ^ n * local_radius alpha * local_weight alpha true /\
  Rabs (snd (iterate (f alpha) n s) - snd (e_1 alpha)) <= local_rate alpha ^ n * local_radius alpha * local_weight alpha false.
Proof.
  intros range [first second].
  destruct (e_1_attracts_its_neighbourhood alpha range n s (fun j => match j with true => first | false => second end)) as [near _].
  exact (conj (near true) (near false)).
Qed.
