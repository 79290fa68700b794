"""The parts of Statements.v that do not depend on the data of the theorem, and its theorems with
the data left open.
"""

from __future__ import annotations

HEADER = """\
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
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\\
  forall s, space s -> dist s e < delta -> forall n, dist (iterate map n s) e < epsilon.

Definition attracting (space : R * R -> Prop) (map : R * R -> R * R) (e : R * R) : Prop :=
  forall s, space s -> forall epsilon, 0 < epsilon -> exists N,
  forall n, (N <= n)%nat -> dist (iterate map n s) e < epsilon.

(* Within c of e in the sup norm with these weights. *)
Definition within (weights : R * R) (c : R) (s e : R * R) : Prop :=
  Rabs (fst s - fst e) <= c * fst weights /\\ Rabs (snd s - snd e) <= c * snd weights.
"""

PINS = """
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
"""

THEOREMS = """
(* The second region of the map is where the first is not. *)
Lemma second_region_is : forall x w : R, $second <-> ~ $first.
Proof. intros x w. split; [apply Rle_not_lt|apply Rnot_lt_le]. Qed.
Lemma physical_second_region_is : forall beta v r g : R, $physical_second <-> ~ $physical_first.
Proof. intros beta v r g. split; [apply Rle_not_lt|apply Rnot_lt_le]. Qed.

(* ------------------------------------------ the premises of the rules: single inequalities *)

Theorem space_is_kept : forall alpha s, $given -> space s -> space (ball alpha s).
Proof. exact Premises.space_kept. Qed.

Theorem rank_is_at_least_0 : forall s, space s -> 0 <= rank s.
Proof. exact Premises.rank_at_least_0. Qed.

Theorem rank_falls_outside_the_stages : forall alpha s, $given -> space s ->
  $in_a_stage \\/ rank (ball alpha s) <= rank s - 1.
Proof. exact Premises.rank_or_stage. Qed.

Theorem stages_lead_on : forall alpha s, $given -> space s ->
  $stages_lead_on.
Proof. exact Premises.stages_lead_on. Qed.

Theorem last_stage_contracts : forall alpha c s, $given -> 0 <= c -> $last_stage s ->
  within weights c s (e_1 alpha) -> within weights (rate alpha * c) (ball alpha s) (e_1 alpha).
Proof. exact Premises.trap_contracts_weighted. Qed.

Theorem last_stage_is_small : forall alpha s, $last_stage s -> within weights size s (e_1 alpha).
Proof. exact Premises.near_trap_size. Qed.

Theorem last_stage_holds_a_neighbourhood : forall alpha s, $given -> space s ->
  within weights radius s (e_1 alpha) -> $last_stage s.
Proof. exact Premises.near_trap_radius. Qed.

(* ---------------------------------------------------------------- the theorem *)

Theorem e_1_is_a_fixed_point : forall alpha, $lossy ->
  space (e_1 alpha) /\\ ball alpha (e_1 alpha) = e_1 alpha.
Proof. exact Neighbourhood.e_1_is_fixed. Qed.

(* Every orbit is within rate^k of e_1 after its rank and $extra_steps and k more periods,
   rounded up. *)
Theorem distance_bound : forall alpha, $given -> forall s n k, space s ->
  rank s + $extra_steps <= INR n ->
  dist (iterate (ball alpha) (n + k) s) (e_1 alpha) <= rate alpha ^ k.
Proof. exact GlobalStability.distance_bound. Qed.

Theorem sharper_bound : forall alpha, $given -> forall s n k, space s ->
  rank s + $extra_steps <= INR n ->
  dist (iterate (ball alpha) (n + k) s) (e_1 alpha) <= (1 + INR k) * alpha ^ k.
Proof. exact GlobalStability.sharper_bound. Qed.

Theorem only_impacts : forall alpha, $given -> forall s n, space s ->
  rank s + $steps_to_trap <= INR n -> trap alpha (iterate (ball alpha) n s).
Proof. exact GlobalStability.only_impacts. Qed.

Theorem global : forall alpha, $given ->
  stable space (ball alpha) (e_1 alpha) /\\ attracting space (ball alpha) (e_1 alpha).
Proof. exact GlobalStability.global. Qed.

(* For every restitution below 1 the fixed point is stable, and attracts an explicit
   neighbourhood. *)
Theorem locally_stable : forall alpha, $lossy -> stable space (ball alpha) (e_1 alpha).
Proof. exact Neighbourhood.e_1_is_stable. Qed.

Theorem neighbourhood_contracts : forall alpha c s, $lossy -> 0 <= c ->
  within (near_weights alpha) (near_radius alpha) s (e_1 alpha) ->
  within (near_weights alpha) c s (e_1 alpha) ->
  within (near_weights alpha) (near_rate alpha * c) (ball alpha s) (e_1 alpha).
Proof. exact Premises.neighbourhood_contracts. Qed.

Theorem neighbourhood_is_attracted : forall alpha n s, $lossy ->
  within (near_weights alpha) (near_radius alpha) s (e_1 alpha) ->
  within (near_weights alpha) (near_rate alpha ^ n * near_radius alpha)
    (iterate (ball alpha) n s) (e_1 alpha).
Proof. exact Premises.neighbourhood_attracted. Qed.

(* From $threshold on the orbit of e_2 is another one, so that the theorem is sharp. *)
Theorem other_orbit : forall alpha, $other_given ->
  space (e_2 alpha) /\\
  (forall n, iterate (ball alpha) ($period * n) (e_2 alpha) = e_2 alpha /\\
    0 < dist (e_2 alpha) (e_1 alpha)).
Proof.
  intros alpha range.
  exact (conj (proj1 (GlobalStability.e_2_has_period_2 alpha range))
    (GlobalStability.e_2_stays_away alpha range)).
Qed.

Theorem sharp : forall alpha, $lossy ->
  (stable space (ball alpha) (e_1 alpha) /\\ attracting space (ball alpha) (e_1 alpha)) <->
  alpha < $threshold.
Proof. exact GlobalStability.sharp. Qed.

Theorem boundary_is_kept : forall alpha, $lossy -> forall s,
  below_boundary alpha s -> below_boundary alpha (ball alpha s).
Proof. exact Ranking.boundary_invariant. Qed.

(* ------------------------------------------------ in physical units, for every r > 0 and g > 0 *)

Theorem conjugate : forall r g, 0 < r -> 0 < g -> forall alpha b,
  scaling r g (physical_ball alpha r g b) = ball alpha (scaling r g b).
Proof. exact Physical.conjugate. Qed.

Theorem scaling_is_one_to_one_and_onto : forall r g, 0 < r -> 0 < g -> forall s,
  exists! b, scaling r g b = s.
Proof. exact Physical.scaling_bijective. Qed.

Theorem physical_bound : forall r g, 0 < r -> 0 < g -> forall alpha b n k, $given ->
  physical_space b -> rank (scaling r g b) + $extra_steps <= INR n ->
  Rabs (fst (iterate (physical_ball alpha r g) (n + k) b) - fst (physical_e_1 alpha r g)) <=
    $unit_1 * rate alpha ^ k /\\
  Rabs (snd (iterate (physical_ball alpha r g) (n + k) b) - snd (physical_e_1 alpha r g)) <=
    $unit_2 * rate alpha ^ k.
Proof. exact Physical.physical_bound. Qed.

Theorem physical_global : forall r g, 0 < r -> 0 < g -> forall alpha, $given ->
  stable physical_space (physical_ball alpha r g) (physical_e_1 alpha r g) /\\
  attracting physical_space (physical_ball alpha r g) (physical_e_1 alpha r g).
Proof. exact Physical.physical_global. Qed.

Theorem physical_sharp : forall r g, 0 < r -> 0 < g -> forall alpha, $lossy ->
  (stable physical_space (physical_ball alpha r g) (physical_e_1 alpha r g) /\\
   attracting physical_space (physical_ball alpha r g) (physical_e_1 alpha r g)) <->
  alpha < $threshold.
Proof. exact Physical.physical_sharp. Qed.

Theorem greatest_energy_is_kept : forall r g, 0 < r -> 0 < g -> forall alpha b, $lossy ->
  physical_space b /\\ energy g b <= greatest_energy alpha r ->
  physical_space (physical_ball alpha r g b) /\\
  energy g (physical_ball alpha r g b) <= greatest_energy alpha r.
Proof. exact Physical.E_max_invariant. Qed.
"""
