(* The theorem as it is meant to be read: every definition in full, every theorem closed by the
   proof that stands elsewhere.

   Written by proofs/theorem/coq.py from the derivations in symbolic/ and the table in
   proofs/theorem/definition.py: do not edit.

   Defined:  iterate, dist, stable, attracting in their usual form; the ball's sampled map with its
             space, points, rank, stages and rates, in the normal form and in physical units.
   Proved:   each definition is that of the development (the lemmas named .._is); then the
             theorems. *)

From Coq Require Import Reals List.
From Juggleproof Require Rules Map Neighbourhood Ranking GlobalStability Premises Physical.
Import ListNotations.
Open Scope R_scope.

(* ------------------------------------------------------------ what stable and attracting mean *)

Fixpoint iterate {State : Type} (f : State -> State) (n : nat) (s : State) : State :=
  match n with O => s | S k => f (iterate f k s) end.

Definition dist (s e : R * R) : R := Rmax (Rabs (fst s - fst e)) (Rabs (snd s - snd e)).

Definition stable (space : R * R -> Prop) (map : R * R -> R * R) (e : R * R) : Prop :=
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
  forall s, space s -> dist s e < delta -> forall n, dist (iterate map n s) e < epsilon.

Definition attracting (space : R * R -> Prop) (map : R * R -> R * R) (e : R * R) : Prop :=
  forall s, space s -> forall epsilon, 0 < epsilon -> exists N,
  forall n, (N <= n)%nat -> dist (iterate map n s) e < epsilon.

(* Within c of e in the sup norm with these weights. *)
Definition within (weights : R * R) (c : R) (s e : R * R) : Prop :=
  Rabs (fst s - fst e) <= c * fst weights /\ Rabs (snd s - snd e) <= c * snd weights.

(* ---------------------------------------------------------------- the map in normal form, and the numbers of the theorem *)

(* x is the height in units of r T, w the closing speed in units of r, alpha the restitution. *)
Definition space (s : R * R) : Prop :=
  let x := fst s in 
  0 <= x.
Definition ball (alpha : R) (s : R * R) : R * R :=
  let x := fst s in let w := snd s in 
  if Rlt_dec x w
  then (alpha * w - alpha * x, 2 - alpha * w)
  else (x - w, w + 2).
Definition e_1 (alpha : R) : R * R :=
  (2 * alpha / (alpha + 1) ^ 2, 2 / (alpha + 1)).
Definition e_2 (alpha : R) : R * R :=
  ((6 * alpha - 2) / (alpha + 1) ^ 2, 4 / (alpha + 1)).

Definition speed (s : R * R) : R :=
  let x := fst s in let w := snd s in 
  sqrt (4 * x + (w - 1) ^ 2).
Definition rank (s : R * R) : R :=
  let x := fst s in let w := snd s in let u := sqrt (4 * x + (w - 1) ^ 2) in 
  2 * u + (1 - w) / 2.
Definition low_impact (s : R * R) : Prop :=
  let x := fst s in let w := snd s in 
  x < w /\ w < 6.
Definition corner (s : R * R) : Prop :=
  let x := fst s in let w := snd s in 
  0 < w /\ x + w <= 2.
Definition trap (alpha : R) (s : R * R) : Prop :=
  let x := fst s in let w := snd s in 
  0 <= x /\ x < w /\ alpha * w < 1.
Definition near_trap (alpha : R) (s : R * R) : Prop :=
  let x := fst s in let w := snd s in let e_x := 2 * alpha / (alpha + 1) ^ 2 in let e_w := 2 / (alpha + 1) in 
  0 <= x /\ x < w /\ alpha * w < 1 /\ x - e_x <= 1 /\ e_x - x <= 1 /\ w - e_w <= 1 /\ e_w - w <= 1.
Definition stages (alpha : R) : list (R * R -> Prop) := [low_impact; corner; trap alpha; near_trap alpha].

Definition weights : R * R :=
  (1, 1).
Definition rate (alpha : R) : R :=
  2 * alpha.
Definition radius : R :=
  1 / 2.
Definition size : R :=
  1.

(* Near e_1, for every 0 < alpha < 1. *)
Definition near_weights (alpha : R) : R * R :=
  (2 * alpha / (1 - alpha), 1).
Definition near_rate (alpha : R) : R :=
  (1 + alpha) / 2.
Definition near_radius (alpha : R) : R :=
  (1 - alpha) / (1 + alpha) ^ 2.

(* The states of energy at most E_max. *)
Definition below_boundary (alpha : R) (s : R * R) : Prop :=
  let x := fst s in let w := snd s in let u := sqrt (4 * x + (w - 1) ^ 2) in 
  0 <= x /\ u <= (alpha + 1) / (1 - alpha).

(* ---------------------------------------------------------------- the map in physical units *)

(* beta is the height, v the velocity, r the launch speed of the table, g gravity. *)
Definition physical_space (s : R * R) : Prop :=
  let beta := fst s in 
  0 <= beta.
Definition physical_ball (alpha : R) (r : R) (g : R) (s : R * R) : R * R :=
  let beta := fst s in let v := snd s in 
  if Rlt_dec (beta * g / 2 + r * v) (r ^ 2)
  then ((2 * alpha * r ^ 2 - alpha * beta * g - 2 * alpha * r * v) / g, alpha * r - alpha * v - r)
  else ((beta * g + 2 * r * v - 2 * r ^ 2) / g, v - 2 * r).
Definition physical_e_1 (alpha : R) (r : R) (g : R) : R * R :=
  (4 * alpha * r ^ 2 / (g * (alpha + 1) ^ 2), (alpha * r - r) / (alpha + 1)).
Definition scaling (r : R) (g : R) (s : R * R) : R * R :=
  let beta := fst s in let v := snd s in 
  (beta * g / (2 * r ^ 2), (r - v) / r).
Definition energy (g : R) (s : R * R) : R :=
  let beta := fst s in let v := snd s in 
  beta * g + v ^ 2 / 2.
Definition greatest_energy (alpha : R) (r : R) : R :=
  r ^ 2 * (alpha + 1) ^ 2 / (2 * (alpha - 1) ^ 2).

(* ------------------------------------------ these are the definitions that the proofs are about *)

Lemma iterate_is : @iterate = @Rules.iterate. Proof. reflexivity. Qed.
Lemma dist_is : dist = Map.dist. Proof. reflexivity. Qed.
Lemma stable_is : stable = Map.stable. Proof. reflexivity. Qed.
Lemma attracting_is : attracting = Map.attracting. Proof. reflexivity. Qed.
Lemma space_is : space = Map.H. Proof. reflexivity. Qed.
Lemma ball_is : ball = Map.f. Proof. reflexivity. Qed.
Lemma e_1_is : e_1 = Map.e_1. Proof. reflexivity. Qed.
Lemma e_2_is : e_2 = Map.e_2. Proof. reflexivity. Qed.
Lemma speed_is : speed = Ranking.speed. Proof. reflexivity. Qed.
Lemma rank_is : rank = Ranking.rank. Proof. reflexivity. Qed.
Lemma stages_is : stages = Ranking.stages. Proof. reflexivity. Qed.
Lemma trap_is : trap = Ranking.trap. Proof. reflexivity. Qed.
Lemma below_boundary_is : below_boundary = Ranking.below_boundary. Proof. reflexivity. Qed.
Lemma near_rate_is : near_rate = Neighbourhood.local_rate. Proof. reflexivity. Qed.
Lemma near_radius_is : near_radius = Neighbourhood.local_radius. Proof. reflexivity. Qed.
Lemma near_weights_is alpha :
  near_weights alpha =
    (Neighbourhood.local_weight alpha true, Neighbourhood.local_weight alpha false).
Proof. reflexivity. Qed.
Lemma physical_space_is : physical_space = Physical.above_ground. Proof. reflexivity. Qed.
Lemma physical_ball_is : physical_ball = Physical.ball. Proof. reflexivity. Qed.
Lemma physical_e_1_is : physical_e_1 = Physical.e1. Proof. reflexivity. Qed.
Lemma scaling_is : scaling = Physical.scaling. Proof. reflexivity. Qed.
Lemma energy_is : energy = Physical.energy. Proof. reflexivity. Qed.
Lemma greatest_energy_is : greatest_energy = Physical.E_max. Proof. reflexivity. Qed.

(* The second region of the map is where the first is not. *)
Lemma second_region_is : forall x w : R, w <= x <-> ~ x < w.
Proof. intros x w. split; [apply Rle_not_lt|apply Rnot_lt_le]. Qed.
Lemma physical_second_region_is : forall beta v r g : R, r ^ 2 <= beta * g / 2 + r * v <-> ~ beta * g / 2 + r * v < r ^ 2.
Proof. intros beta v r g. split; [apply Rle_not_lt|apply Rnot_lt_le]. Qed.

(* ------------------------------------------ the premises of the rules: single inequalities *)

Theorem space_is_kept : forall alpha s, 0 < alpha /\ alpha < 1 / 3 -> space s -> space (ball alpha s).
Proof. exact Premises.space_kept. Qed.

Theorem rank_is_at_least_0 : forall s, space s -> 0 <= rank s.
Proof. exact Premises.rank_at_least_0. Qed.

Theorem rank_falls_outside_the_stages : forall alpha s, 0 < alpha /\ alpha < 1 / 3 -> space s ->
  low_impact s \/ corner s \/ trap alpha s \/ near_trap alpha s \/ rank (ball alpha s) <= rank s - 1.
Proof. exact Premises.rank_or_stage. Qed.

Theorem stages_lead_on : forall alpha s, 0 < alpha /\ alpha < 1 / 3 -> space s ->
  (low_impact s -> corner (ball alpha s)) /\
  (corner s -> trap alpha (ball alpha s)) /\
  (trap alpha s -> near_trap alpha (ball alpha s)) /\
  (near_trap alpha s -> near_trap alpha (ball alpha s)).
Proof. exact Premises.stages_lead_on. Qed.

Theorem last_stage_contracts : forall alpha c s, 0 < alpha /\ alpha < 1 / 3 -> 0 <= c -> near_trap alpha s ->
  within weights c s (e_1 alpha) -> within weights (rate alpha * c) (ball alpha s) (e_1 alpha).
Proof. exact Premises.trap_contracts_weighted. Qed.

Theorem last_stage_is_small : forall alpha s, near_trap alpha s -> within weights size s (e_1 alpha).
Proof. exact Premises.near_trap_size. Qed.

Theorem last_stage_holds_a_neighbourhood : forall alpha s, 0 < alpha /\ alpha < 1 / 3 -> space s ->
  within weights radius s (e_1 alpha) -> near_trap alpha s.
Proof. exact Premises.near_trap_radius. Qed.

(* ---------------------------------------------------------------- the theorem *)

Theorem e_1_is_a_fixed_point : forall alpha, 0 < alpha /\ alpha < 1 ->
  space (e_1 alpha) /\ ball alpha (e_1 alpha) = e_1 alpha.
Proof. exact Neighbourhood.e_1_is_fixed. Qed.

(* Every orbit is within rate^k of e_1 after its rank and 3 and k more periods,
   rounded up. *)
Theorem distance_bound : forall alpha, 0 < alpha /\ alpha < 1 / 3 -> forall s n k, space s ->
  rank s + 3 <= INR n ->
  dist (iterate (ball alpha) (n + k) s) (e_1 alpha) <= rate alpha ^ k.
Proof. exact GlobalStability.distance_bound. Qed.

Theorem sharper_bound : forall alpha, 0 < alpha /\ alpha < 1 / 3 -> forall s n k, space s ->
  rank s + 3 <= INR n ->
  dist (iterate (ball alpha) (n + k) s) (e_1 alpha) <= (1 + INR k) * alpha ^ k.
Proof. exact GlobalStability.sharper_bound. Qed.

Theorem only_impacts : forall alpha, 0 < alpha /\ alpha < 1 / 3 -> forall s n, space s ->
  rank s + 2 <= INR n -> trap alpha (iterate (ball alpha) n s).
Proof. exact GlobalStability.only_impacts. Qed.

Theorem global : forall alpha, 0 < alpha /\ alpha < 1 / 3 ->
  stable space (ball alpha) (e_1 alpha) /\ attracting space (ball alpha) (e_1 alpha).
Proof. exact GlobalStability.global. Qed.

(* For every restitution below 1 the fixed point is stable, and attracts an explicit
   neighbourhood. *)
Theorem locally_stable : forall alpha, 0 < alpha /\ alpha < 1 -> stable space (ball alpha) (e_1 alpha).
Proof. exact Neighbourhood.e_1_is_stable. Qed.

Theorem neighbourhood_contracts : forall alpha c s, 0 < alpha /\ alpha < 1 -> 0 <= c ->
  within (near_weights alpha) (near_radius alpha) s (e_1 alpha) ->
  within (near_weights alpha) c s (e_1 alpha) ->
  within (near_weights alpha) (near_rate alpha * c) (ball alpha s) (e_1 alpha).
Proof. exact Premises.neighbourhood_contracts. Qed.

Theorem neighbourhood_is_attracted : forall alpha n s, 0 < alpha /\ alpha < 1 ->
  within (near_weights alpha) (near_radius alpha) s (e_1 alpha) ->
  within (near_weights alpha) (near_rate alpha ^ n * near_radius alpha)
    (iterate (ball alpha) n s) (e_1 alpha).
Proof. exact Premises.neighbourhood_attracted. Qed.

(* From 1 / 3 on the orbit of e_2 is another one, so that the theorem is sharp. *)
Theorem other_orbit : forall alpha, 1 / 3 <= alpha /\ alpha < 1 ->
  space (e_2 alpha) /\
  (forall n, iterate (ball alpha) (2 * n) (e_2 alpha) = e_2 alpha /\
    0 < dist (e_2 alpha) (e_1 alpha)).
Proof.
  intros alpha range.
  exact (conj (proj1 (GlobalStability.e_2_has_period_2 alpha range))
    (GlobalStability.e_2_stays_away alpha range)).
Qed.

Theorem sharp : forall alpha, 0 < alpha /\ alpha < 1 ->
  (stable space (ball alpha) (e_1 alpha) /\ attracting space (ball alpha) (e_1 alpha)) <->
  alpha < 1 / 3.
Proof. exact GlobalStability.sharp. Qed.

Theorem boundary_is_kept : forall alpha, 0 < alpha /\ alpha < 1 -> forall s,
  below_boundary alpha s -> below_boundary alpha (ball alpha s).
Proof. exact Ranking.boundary_invariant. Qed.

(* ------------------------------------------------ in physical units, for every r > 0 and g > 0 *)

Theorem conjugate : forall r g, 0 < r -> 0 < g -> forall alpha b,
  scaling r g (physical_ball alpha r g b) = ball alpha (scaling r g b).
Proof. exact Physical.conjugate. Qed.

Theorem scaling_is_one_to_one_and_onto : forall r g, 0 < r -> 0 < g -> forall s,
  exists! b, scaling r g b = s.
Proof. exact Physical.scaling_bijective. Qed.

Theorem physical_bound : forall r g, 0 < r -> 0 < g -> forall alpha b n k, 0 < alpha /\ alpha < 1 / 3 ->
  physical_space b -> rank (scaling r g b) + 3 <= INR n ->
  Rabs (fst (iterate (physical_ball alpha r g) (n + k) b) - fst (physical_e_1 alpha r g)) <=
    2 * r ^ 2 / g * rate alpha ^ k /\
  Rabs (snd (iterate (physical_ball alpha r g) (n + k) b) - snd (physical_e_1 alpha r g)) <=
    r * rate alpha ^ k.
Proof. exact Physical.physical_bound. Qed.

Theorem physical_global : forall r g, 0 < r -> 0 < g -> forall alpha, 0 < alpha /\ alpha < 1 / 3 ->
  stable physical_space (physical_ball alpha r g) (physical_e_1 alpha r g) /\
  attracting physical_space (physical_ball alpha r g) (physical_e_1 alpha r g).
Proof. exact Physical.physical_global. Qed.

Theorem physical_sharp : forall r g, 0 < r -> 0 < g -> forall alpha, 0 < alpha /\ alpha < 1 ->
  (stable physical_space (physical_ball alpha r g) (physical_e_1 alpha r g) /\
   attracting physical_space (physical_ball alpha r g) (physical_e_1 alpha r g)) <->
  alpha < 1 / 3.
Proof. exact Physical.physical_sharp. Qed.

Theorem greatest_energy_is_kept : forall r g, 0 < r -> 0 < g -> forall alpha b, 0 < alpha /\ alpha < 1 ->
  physical_space b /\ energy g b <= greatest_energy alpha r ->
  physical_space (physical_ball alpha r g b) /\
  energy g (physical_ball alpha r g b) <= greatest_energy alpha r.
Proof. exact Physical.E_max_invariant. Qed.
