(* Values that a certificate finds for the variables of a statement, for any state: roots by intermediate values, cases by sign, terms.

   Defined:  adjoined, adjoin (a root of a polynomial between two terms); found (a part of a certificate), find.
   Proved:   adjoin_sound   there is such a root;
             find_sound     what the values found are shown to do is done in every point of the state. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool FunctionalExtensionality.
From Juggleproof Require Import Polynomials Formulas States Instances Leaves.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- roots of a polynomial between two terms *)

Record adjoined := { place : nat; equation : poly; lowest : term; highest : term; at_lowest : node; at_highest : node }.

Definition quotient_of (fs : list fact) (t : term) : option quotient := option_map (fun d => (fst t, d)) (denominator fs (snd t)).
Definition difference (x y : quotient) : quotient := sum_of x (opposite (fst y), snd y).
Definition at_value (v : nat) (p : poly) (q : quotient) : quotient := substitute p (fun i => if (i =? v)%nat then q else kept i).

Lemma quotient_of_defined a fs t q : Forall (true_at a) fs -> quotient_of fs t = Some q -> defined q a.
Proof.
  unfold quotient_of. intros each found. destruct (denominator fs (snd t)) as [d|] eqn:of_facts; [|discriminate]. injection found as <-.
  exact (denominator_nonzero a fs each _ d of_facts).
Qed.

Lemma difference_value x y a : defined x a -> defined y a ->
  defined (difference x y) a /\ value (difference x y) a = value x a - value y a.
Proof.
  intros dx dy. destruct (sum_value x (opposite (fst y), snd y) a dx dy) as [d v]. split; [exact d|]. unfold difference. rewrite v.
  unfold value at 2. cbn [fst snd]. rewrite eval_opposite. unfold value, Rdiv. ring.
Qed.

Lemma at_value_value v p q a : defined q a -> defined (at_value v p q) a /\ value (at_value v p q) a = eval p (put v (value q a) a).
Proof.
  intro dq. destruct (substitute_value p a (fun i => if (i =? v)%nat then q else kept i)) as [d same].
  { intro i. destruct (i =? v)%nat; [exact dq|apply kept_value]. }
  split; [exact d|]. unfold at_value. rewrite same. f_equal. apply functional_extensionality. intro i. unfold put.
  destruct (i =? v)%nat; [reflexivity|apply kept_value].
Qed.

Definition adjoin (known : list statement) (width : nat) (r : adjoined) (st : state) : option state :=
  let v := place r in
  match quotient_of (facts st) (lowest r), quotient_of (facts st) (highest r) with
  | Some low, Some high =>
    if (width <=? v)%nat && uses_state (below v) st && uses_term (below v) low && uses_term (below v) high
      && close known (at_lowest r) (assume (disjunction
           [compared (difference low high) Positive; compared (at_value v (equation r) low) Positive]) st)
      && close known (at_highest r) (assume (negate (compared (at_value v (equation r) high) Nonnegative)) st)
    then Some (assume (atom (equation r) Zero) (assume (compared (difference high (kept v)) Nonnegative)
           (assume (compared (difference (kept v) low) Nonnegative) st)))
    else None
  | _, _ => None
  end.

Lemma intermediate_value f low high : continuity f -> low <= high -> f low <= 0 -> 0 <= f high -> exists x, low <= x <= high /\ f x = 0.
Proof.
  intros continuous order below_ above. destruct (Req_dec (f low) 0) as [zero|first]; [exists low; lra|].
  destruct (Req_dec (f high) 0) as [zero|last]; [exists high; lra|]. destruct (Req_dec low high) as [same|apart]; [subst; lra|].
  destruct (IVT f low high continuous ltac:(lra) ltac:(lra) ltac:(lra)) as (x & between & root). now exists x.
Qed.

Lemma adjoin_sound known width r st st' a : Forall valid known -> adjoin known width r st = Some st' -> point st a ->
  exists x, point st' (put (place r) x a) /\ (width <= place r)%nat.
Proof.
  unfold adjoin. intros truths found here. set (v := place r) in *.
  destruct (quotient_of (facts st) (lowest r)) as [low|] eqn:of_low; [|discriminate].
  destruct (quotient_of (facts st) (highest r)) as [high|] eqn:of_high; [|discriminate].
  destruct (andb _ _) eqn:good in found; [|discriminate]. injection found as <-.
  apply andb_prop in good. destruct good as [good closed']. apply andb_prop in good. destruct good as [good closed].
  apply andb_prop in good. destruct good as [good uses_high]. apply andb_prop in good. destruct good as [good uses_low].
  apply andb_prop in good. destruct good as [wide uses_st]. apply Nat.leb_le in wide.
  pose proof (quotient_of_defined a _ _ low (proj1 (proj2 here)) of_low) as dlow.
  pose proof (quotient_of_defined a _ _ high (proj1 (proj2 here)) of_high) as dhigh.
  destruct (difference_value low high a dlow dhigh) as [dd vd]. destruct (at_value_value v (equation r) low a dlow) as [dl vl].
  destruct (at_value_value v (equation r) high a dhigh) as [dh vh].
  assert (signs : value low a <= value high a /\ eval (equation r) (put v (value low a) a) <= 0 <= eval (equation r) (put v (value high a) a)).
  { assert (first : ~ (value low a > value high a \/ eval (equation r) (put v (value low a) a) > 0)).
    { intro either. apply (closes_sound known _ truths _ closed a), assume_point; [exact here|].
      rewrite disjunction_holds, Exists_cons, Exists_cons, Exists_nil, (compared_holds _ _ _ dd), (compared_holds _ _ _ dl), vd, vl. cbn. lra. }
    assert (second : ~ eval (equation r) (put v (value high a) a) < 0).
    { intro less. apply (closes_sound known _ truths _ closed' a), assume_point; [exact here|].
      rewrite negate_holds, (compared_holds _ _ _ dh), vh. cbn. lra. }
    lra. }
  destruct signs as (order & below_ & above).
  destruct (intermediate_value (fun x => eval (equation r) (put v x a)) _ _ (eval_continuous _ v a) order below_ above) as (x & between & root).
  exists x. split; [|exact wide].
  assert (agree : forall i, below v i = true -> a i = put v x a i) by (intros i less; apply Nat.ltb_lt in less; now rewrite put_other by lia).
  destruct (uses_term_value _ _ _ low uses_low agree) as [vlow dlow']. destruct (uses_term_value _ _ _ high uses_high agree) as [vhigh dhigh'].
  destruct (kept_value v (put v x a)) as [dx vx]. rewrite put_same in vx.
  destruct (difference_value _ _ _ dx (dlow' dlow)) as [d1 v1]. destruct (difference_value _ _ _ (dhigh' dhigh) dx) as [d2 v2].
  repeat apply assume_point.
  - exact (uses_state_point (below v) a _ st uses_st agree here).
  - rewrite (compared_holds _ _ _ d1), v1, vx, <- vlow. cbn. lra.
  - rewrite (compared_holds _ _ _ d2), v2, vx, <- vhigh. cbn. lra.
  - now apply atom_holds.
Qed.

Fixpoint adjoin_all (known : list statement) (width : nat) (l : list adjoined) (st : state) : option state :=
  match l with
  | [] => Some st
  | r :: l => match adjoin known width r st with Some st => adjoin_all known width l st | None => None end
  end.

Lemma adjoin_all_sound known width l : Forall valid known -> forall st st' a, adjoin_all known width l st = Some st' -> point st a ->
  exists b, point st' b /\ forall i, (i < width)%nat -> b i = a i.
Proof.
  intro truths. induction l as [|r l IH]; intros st st' a found here; cbn [adjoin_all] in found; [injection found as <-; now exists a|].
  destruct (adjoin known width r st) as [next|] eqn:one; [|discriminate].
  destruct (adjoin_sound known width r st next a truths one here) as (x & there & wide).
  destruct (IH next st' _ found there) as (b & last & same). exists b. split; [exact last|]. intros i less. rewrite same by exact less.
  apply put_other. lia.
Qed.

(* ---------------------------------------------------------------- values of variables *)

Inductive found :=
  | Found (roots : list adjoined) (which : nat) (terms : list (nat * term)) (fresh : nat) (nodes : list node)
  | BySign (p : poly) (less equal more : found)
  | Empty (n : node).

Section Find.
  Variables (known : list statement) (width : nat).
  (* What is done with the values: for the statement number `which`. *)
  Variable finish : nat -> state -> list (nat * quotient) -> nat -> list node -> bool.

  Fixpoint find (f : found) (st : state) : bool :=
    match f with
    | Found roots which terms fresh nodes =>
      match adjoin_all known width roots st with
      | Some st => match quotients (facts st) terms with Some q => finish which st q fresh nodes | None => false end
      | None => false
      end
    | BySign p less equal more =>
      find less (assume (atom (opposite p) Positive) st) && find equal (assume (atom p Zero) st) && find more (assume (atom p Positive) st)
    | Empty n => close known n st
    end.

  Variable goal : assignment -> Prop.
  Hypothesis truths : Forall valid known.
  Hypothesis goal_below : forall a b, (forall i, (i < width)%nat -> b i = a i) -> goal b -> goal a.
  Hypothesis finish_sound : forall which st q fresh nodes a, finish which st q fresh nodes = true -> point st a ->
    Forall (fun t => defined (snd t) a) q -> goal a.

  Theorem find_sound f : forall st, find f st = true -> forall a, point st a -> goal a.
  Proof.
    induction f as [roots which terms fresh nodes|p less IHl equal IHe more IHm|n]; cbn [find]; intros st good a here.
    - destruct (adjoin_all known width roots st) as [st'|] eqn:adjoined_; [|discriminate].
      destruct (adjoin_all_sound known width roots truths st st' a adjoined_ here) as (b & there & same).
      destruct (quotients (facts st') terms) as [q|] eqn:terms_; [|discriminate]. apply (goal_below a b same).
      exact (finish_sound which st' q fresh nodes b good there (quotients_defined b _ (proj1 (proj2 there)) terms q terms_)).
    - apply andb_prop in good. destruct good as [good third]. apply andb_prop in good. destruct good as [first second].
      destruct (Rtotal_order (eval p a) 0) as [sign|[sign|sign]].
      + apply (IHl _ first a), assume_point; [exact here|]. apply atom_holds. cbn. rewrite eval_opposite. lra.
      + apply (IHe _ second a), assume_point; [exact here|]. now apply atom_holds.
      + apply (IHm _ third a), assume_point; [exact here|]. now apply atom_holds.
    - destruct (closes_sound known n truths st good a here).
  Qed.
End Find.
