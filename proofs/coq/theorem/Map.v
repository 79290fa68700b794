(* The ball's sampled map in normal form, and what stable and attracting mean.

   Defined:  State = (x, w): x the height in units of r T, w the closing speed in units of r; H: x >= 0; impact, flight and the map f
             that takes impact where x < w and flight elsewhere; e_1, e_2; dist, the sup norm; stable, attracting in their usual
             epsilon form.
   Proved:   f on either region; dist below a bound, coordinate by coordinate. *)

From Coq Require Import Reals Lra.
From Juggleproof Require Import Rules.
Open Scope R_scope.

Definition State : Type := R * R.

Definition H (s : State) : Prop := 0 <= fst s.
Definition impact (alpha : R) (s : State) : State := (alpha * snd s - alpha * fst s, 2 - alpha * snd s).
Definition flight (s : State) : State := (fst s - snd s, snd s + 2).
Definition f (alpha : R) (s : State) : State := if Rlt_dec (fst s) (snd s) then impact alpha s else flight s.

Definition e_1 (alpha : R) : State := (2 * alpha / (alpha + 1) ^ 2, 2 / (alpha + 1)).
Definition e_2 (alpha : R) : State := ((6 * alpha - 2) / (alpha + 1) ^ 2, 4 / (alpha + 1)).

Definition dist (s e : State) : R := Rmax (Rabs (fst s - fst e)) (Rabs (snd s - snd e)).

(* Lyapunov stable, for a map on a space. *)
Definition stable (space : State -> Prop) (map : State -> State) (e : State) : Prop :=
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
  forall s, space s -> dist s e < delta -> forall n, dist (iterate map n s) e < epsilon.

(* Every orbit that starts in the space converges to e. *)
Definition attracting (space : State -> Prop) (map : State -> State) (e : State) : Prop :=
  forall s, space s -> forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat -> dist (iterate map n s) e < epsilon.

Lemma f_impact alpha s : fst s < snd s -> f alpha s = impact alpha s.
Proof. intro less. unfold f. destruct (Rlt_dec (fst s) (snd s)); [reflexivity|contradiction]. Qed.

Lemma f_flight alpha s : snd s <= fst s -> f alpha s = flight s.
Proof. intro above. unfold f. destruct (Rlt_dec (fst s) (snd s)); [lra|reflexivity]. Qed.

(* The two coordinates as an index type: true for x, false for w. *)
Definition coordinate (j : bool) (s : State) : R := if j then fst s else snd s.

Lemma absolute_bounds a c : Rabs a <= c -> - c <= a <= c.
Proof. unfold Rabs. destruct (Rcase_abs a); lra. Qed.

Lemma dist_below s e c : dist s e < c <-> forall j, Rabs (coordinate j s - coordinate j e) < c.
Proof.
  unfold dist. split.
  - intros near [|]; [apply Rle_lt_trans with (2 := near), Rmax_l|apply Rle_lt_trans with (2 := near), Rmax_r].
  - intro near. apply Rmax_lub_lt; [exact (near true)|exact (near false)].
Qed.

Lemma dist_at_most s e c : dist s e <= c <-> Rabs (fst s - fst e) <= c /\ Rabs (snd s - snd e) <= c.
Proof.
  unfold dist. split.
  - intro near. split; [apply Rle_trans with (2 := near), Rmax_l|apply Rle_trans with (2 := near), Rmax_r].
  - intros [first second]. now apply Rmax_lub.
Qed.

Lemma dist_weighted s e c weight_x weight_w :
  within coordinate (fun j => coordinate j e) (fun j : bool => if j then weight_x else weight_w) c s <->
  Rabs (fst s - fst e) <= c * weight_x /\ Rabs (snd s - snd e) <= c * weight_w.
Proof. split; [intro near; exact (conj (near true) (near false))|intros [first second] [|]; assumption]. Qed.

Lemma stable_by_coordinates space map e :
  stable space map e <->
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
  forall s, space s -> (forall j, Rabs (coordinate j s - coordinate j e) < delta) ->
  forall n j, Rabs (coordinate j (iterate map n s) - coordinate j e) < epsilon.
Proof.
  split; intros stays epsilon positive; destruct (stays epsilon positive) as (delta & delta_positive & stays_near);
    exists delta; (split; [exact delta_positive|]); intros s inside near n.
  - apply dist_below, stays_near; [exact inside|now apply dist_below].
  - apply dist_below. apply stays_near; [exact inside|now apply dist_below].
Qed.

Lemma converges_by_coordinates map e s :
  (forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat -> dist (iterate map n s) e < epsilon) <->
  converges map coordinate (fun j => coordinate j e) s.
Proof.
  split; intros tends epsilon positive; destruct (tends epsilon positive) as [N near]; exists N; intros n late.
  - apply dist_below, near, late.
  - apply dist_below. exact (near n late).
Qed.
