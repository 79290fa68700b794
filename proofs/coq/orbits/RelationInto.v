(* An attraction on a smaller space, where several next states are possible.

   Proved:   relation_into_attraction, relation_into_stability   it is one on the larger space;
             map_into_attraction, map_into_stability   likewise for a map on the larger space, and a relation on the smaller. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules Lyapunov Relation.
Open Scope R_scope.

Section Into.
  Context {State Index : Type}.
  Variables (F G : State -> State -> Prop) (coordinate : Index -> State -> R) (point : Index -> R) (space inner : State -> Prop) (radius : R).
  Hypothesis space_invariant : forall s t, space s -> F s t -> space t.
  Hypothesis inner_invariant : forall s t, inner s -> G s t -> inner t.
  Hypothesis agree : forall s t, space s -> inner s -> F s t -> G s t.

  Lemma inner_execution x : execution F x -> space (x O) -> inner (x O) -> execution G x.
  Proof.
    intros runs there inside. assert (both : forall n, space (x n) /\ inner (x n)).
    { induction n as [|n [space_ inner_]]; [now split|]. split; [exact (space_invariant _ _ space_ (runs n))|].
      exact (inner_invariant _ _ inner_ (agree _ _ space_ inner_ (runs n))). }
    intro n. destruct (both n). now apply agree.
  Qed.

  Theorem relation_into_attraction : (forall x, execution F x -> space (x O) -> exists N, inner (x N)) ->
    (forall x, execution G x -> inner (x O) -> execution_converges coordinate point x) ->
    forall x, execution F x -> space (x O) -> execution_converges coordinate point x.
  Proof.
    intros enters attracts. apply (relation_attraction F space coordinate point (fun s => space s /\ inner s)).
    - intros x runs there. destruct (enters x runs there) as [N inside]. exists N. split; [|exact inside].
      exact (execution_keeps F space space_invariant x N runs there).
    - intros x runs [there inside]. apply attracts; [now apply inner_execution|exact inside].
  Qed.

  Theorem relation_into_stability : 0 < radius -> (forall s, space s -> close coordinate point radius s -> inner s) ->
    executions_stable G inner coordinate point -> executions_stable F space coordinate point.
  Proof.
    intros positive surrounds stays epsilon some. destruct (stays epsilon some) as (delta & delta_positive & near).
    exists (Rmin delta radius). split; [now apply Rmin_glb_lt|]. intros x runs there start.
    pose proof (Rmin_l delta radius). pose proof (Rmin_r delta radius).
    assert (inside : inner (x O)) by (apply surrounds; [exact there|]; intro i; specialize (start i); lra).
    apply near; [now apply inner_execution|exact inside|]. intro i. specialize (start i). lra.
  Qed.
End Into.

Section MapInto.
  Context {State Index : Type}.
  Variables (f : State -> State) (G : State -> State -> Prop) (coordinate : Index -> State -> R) (point : Index -> R).
  Variables (space inner : State -> Prop) (radius : R).
  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis inner_invariant : forall s t, inner s -> G s t -> inner t.
  Hypothesis agree : forall s, space s -> inner s -> G s (f s).

  (* The map as a relation, whose executions are orbits. *)
  Let F s t := t = f s.
  Let F_invariant s t : space s -> F s t -> space t.
  Proof. intros there ->. now apply space_invariant. Qed.
  Let F_agrees s t : space s -> inner s -> F s t -> G s t.
  Proof. intros there inside ->. now apply agree. Qed.
  Let is_orbit x : execution F x -> forall n, x n = iterate f n (x O).
  Proof. intros runs n. induction n as [|n IH]; [reflexivity|].
    change (x (S n) = f (iterate f n (x O))). rewrite <- IH. apply runs. Qed.

  Theorem map_into_attraction : (forall s, space s -> exists N, inner (iterate f N s)) ->
    (forall x, execution G x -> inner (x O) -> execution_converges coordinate point x) ->
    forall s, space s -> converges f coordinate point s.
  Proof.
    intros enters attracts s there.
    apply (relation_into_attraction F G coordinate point space inner F_invariant inner_invariant F_agrees) with (x := fun n => iterate f n s);
      [|exact attracts|now intro n|exact there].
    intros x runs start. destruct (enters _ start) as [N inside]. exists N. now rewrite is_orbit.
  Qed.

  Theorem map_into_stability : 0 < radius -> (forall s, space s -> close coordinate point radius s -> inner s) ->
    executions_stable G inner coordinate point -> stable f coordinate point space.
  Proof.
    intros positive surrounds stays epsilon some.
    destruct (relation_into_stability F G coordinate point space inner radius F_invariant inner_invariant F_agrees positive surrounds stays epsilon some)
      as (delta & delta_positive & near).
    exists delta. split; [exact delta_positive|]. intros s there start. apply (near (fun n => iterate f n s)); trivial. now intro n.
  Qed.
End MapInto.
