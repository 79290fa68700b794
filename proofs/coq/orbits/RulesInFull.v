(* The rule that a checker applies, in one theorem without sections: every premise is a single statement of real arithmetic.

   Proved:   attraction  for states that are lists of reals: from the premises on space, rank, stages and contraction follow the explicit
                         bound, the convergence of every orbit, and Lyapunov stability in the plain sup norm. *)

From Coq Require Import Reals Lra List.
From Juggleproof Require Import Rules Lists.
Open Scope R_scope.

Theorem attraction (f : list R -> list R) (space : list R -> Prop) (rank : list R -> R) (stages : list (list R -> Prop))
    (point weights : list R) (rate size radius : R) :
  let m := length stages in
  let in_stage k s := nth k stages (fun _ => False) s in
  let last s := in_stage (m - 1)%nat s in
  let apart j s := Rabs (nth j s 0 - nth j point 0) in
  let coordinate j := (j < length weights)%nat in
  (* numbers *)
  Forall (fun w => 0 < w) weights -> 0 <= rate < 1 -> 0 <= size -> 0 < radius ->
  (* the space is kept, and the rank falls to the stages *)
  (forall s, space s -> space (f s)) ->
  (forall s, space s -> 0 <= rank s) ->
  (forall s, space s -> (exists k, in_stage k s) \/ rank (f s) <= rank s - 1) ->
  (forall k s, (S k < m)%nat -> space s -> in_stage k s -> in_stage (S k) (f s)) ->
  (forall s, space s -> last s -> last (f s)) ->
  (* the last stage is small, is contracted, and holds a neighbourhood *)
  (forall s, space s -> last s -> forall j, coordinate j -> apart j s <= size * nth j weights 0) ->
  (forall c s, 0 <= c -> space s -> last s -> (forall j, coordinate j -> apart j s <= c * nth j weights 0) ->
     forall j, coordinate j -> apart j (f s) <= rate * c * nth j weights 0) ->
  (forall s, space s -> (forall j, coordinate j -> apart j s <= radius * nth j weights 0) -> last s) ->
  (* conclusions *)
  (forall s n k, space s -> rank s + INR (m - 1) <= INR n ->
     forall j, coordinate j -> apart j (iterate f (n + k) s) <= rate ^ k * size * nth j weights 0) /\
  (forall s, space s -> forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat -> forall j, coordinate j -> apart j (iterate f n s) < epsilon) /\
  (forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\ forall s, space s -> (forall j, coordinate j -> apart j s < delta) ->
     forall n j, coordinate j -> apart j (iterate f n s) < epsilon).
Proof.
  intros m in_stage last apart_ coordinate positive rates sizes radii kept ranked falls leads stays small contracts holds.
  set (on := fun s => space s /\ last s).
  assert (on_kept : forall s, on s -> on (f s)) by (intros s [inside there]; split; [now apply kept|now apply stays]).
  assert (on_contracts : forall c s, 0 <= c -> on s -> near point weights c s -> near point weights (rate * c) (f s)).
  { intros c s c_positive [inside there] close. exact (contracts c s c_positive inside there close). }
  split; [|split].
  - intros s n k inside late.
    apply (lists_approach f point weights on space rate size rank stages) with (n := n) (k := k); try assumption.
    intros t there staged. now split.
  - apply (lists_convergence f point weights on space rate size rank stages); try assumption. intros t there staged. now split.
  - apply (lists_stability f point weights on space rate radius); try assumption.
    intros s inside close. split; [exact inside|now apply holds].
Qed.
