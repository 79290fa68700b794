(* The statement rules of the checker of certificates, for any statement and any certificate: proofs, witnesses, points,
   counterexamples.  (Sharp ranges: Ranges.v.)

   Defined:  prove, meets_premises, refute.
   Proved:   prove_sound    a proof, or a witness for what exists: the statement is valid;
             point_sound    a point: the premises hold somewhere;
             refute_sound   a counterexample: the statement is not valid. *)

From Coq Require Import Reals Lra Lia List Bool.
From Juggleproof Require Import Polynomials Formulas States Instances Leaves Values.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- a proof *)

Definition no_facts (whole_in : list nat) : state := {| facts := []; choices := []; shut := false; integers := whole_in |}.

Lemma no_facts_point whole_in a : all_whole whole_in a -> point (no_facts whole_in) a.
Proof. intro integer. repeat split; trivial; constructor. Qed.

Lemma assume_integers f st : integers (assume f st) = integers st.
Proof.
  assert (part : forall f st, integers (assume_part st f) = integers st) by (intros []; reflexivity).
  destruct f as [b|p r|l|l]; try apply part. cbn. revert st. induction l as [|f l IH]; intro st; [reflexivity|]. cbn. now rewrite IH, part.
Qed.

(* Every `have` and `root` line has a node, which shows from the lines before it what the line needs. *)
Fixpoint prove_lines (known : list statement) (l : list line) (nodes : list node) (st : state) : option state :=
  match l, nodes with
  | [], [] => Some st
  | Given f :: l, _ => prove_lines known l nodes (assume f st)
  | Have f :: l, n :: nodes => if close known n (assume (negate f) st) then prove_lines known l nodes (assume f st) else None
  | Root v p :: l, n :: nodes =>
    let others i := negb (i =? v)%nat in
    if close known n (assume (atom (opposite p) Positive) st) && uses_state others st && only others p
    then prove_lines known l nodes (fold_left (fun st f => assume f st) (root_facts v p) st) else None
  | _, _ => None
  end.

Lemma prove_lines_sound known (goal : assignment -> Prop) : Forall valid known -> forall l nodes st st', prove_lines known l nodes st = Some st' ->
  (forall a, point st' a -> goal a) -> forall a, point st a -> meaning l goal a.
Proof.
  intro truths. induction l as [|[f|f|v p] l IH]; intros nodes st st' found reach a here; cbn [prove_lines meaning] in *.
  - destruct nodes; [injection found as <-|discriminate]. now apply reach.
  - intro true_. exact (IH _ _ _ found reach a (assume_point a st f here true_)).
  - destruct nodes as [|n nodes]; [discriminate|]. destruct (close known n (assume (negate f) st)) eqn:closed; [|discriminate].
    assert (true_ : holds a f).
    { destruct (holds_or_not a f) as [yes|no]; [exact yes|]. apply negate_holds in no.
      destruct (closes_sound known n truths _ closed a (assume_point a st _ here no)). }
    split; [exact true_|]. exact (IH _ _ _ found reach a (assume_point a st f here true_)).
  - destruct nodes as [|n nodes]; [discriminate|]. destruct (andb _ _) eqn:good in found; [|discriminate].
    apply andb_prop in good. destruct good as [good apart]. apply andb_prop in good. destruct good as [closed uses_].
    assert (sign : 0 <= eval p a).
    { destruct (Rle_dec 0 (eval p a)) as [yes|no]; [exact yes|].
      destruct (closes_sound known n truths _ closed a (assume_point a st _ here (proj2 (atom_holds a (opposite p) Positive) ltac:(cbn; rewrite eval_opposite; lra)))). }
    split; [exact sign|]. set (b := put v (sqrt (eval p a)) a).
    assert (agree : forall i, negb (i =? v)%nat = true -> a i = b i).
    { intros i other. apply negb_true_iff, Nat.eqb_neq in other. unfold b. now rewrite put_other. }
    assert (roots : Forall (holds b) (root_facts v p)).
    { apply root_facts_hold. unfold b at 1 2 3. rewrite put_same. split; [apply sqrt_pos|].
      rewrite sqrt_sqrt by exact sign. now apply (eval_only (fun i => negb (i =? v)%nat)). }
    refine (IH _ _ _ found reach b _). unfold root_facts in *. cbn [fold_left].
    inversion roots as [|? ? first rest]; subst. inversion rest as [|? ? second _]; subst.
    apply assume_point; [|exact second]. apply assume_point; [|exact first].
    exact (uses_state_point _ a b st uses_ agree here).
Qed.

Lemma prove_lines_integers known l : forall nodes st st', prove_lines known l nodes st = Some st' -> integers st' = integers st.
Proof.
  induction l as [|[f|f|v p] l IH]; intros nodes st st' found; cbn [prove_lines] in found.
  - destruct nodes; [now injection found as <-|discriminate].
  - now rewrite (IH _ _ _ found), assume_integers.
  - destruct nodes as [|n nodes]; [discriminate|]. destruct (close _ _ _); [|discriminate]. now rewrite (IH _ _ _ found), assume_integers.
  - destruct nodes as [|n nodes]; [discriminate|]. destruct (andb _ _); [|discriminate]. rewrite (IH _ _ _ found). cbn [fold_left root_facts].
    now rewrite !assume_integers.
Qed.

(* ---------------------------------------------------------------- a witness *)

Definition own_integers (s : statement) : list nat := filter (member (exist s)) (whole_numbers s).
Definition universal_integers (s : statement) : list nat := filter (absent (exist s)) (whole_numbers s).

(* What exists gets terms; every other variable stays. *)
Definition witness_terms (s : statement) (q : list (nat * quotient)) (i : nat) : quotient :=
  if member (exist s) i then assigned q kept i else kept i.
Definition finish_witness (known : list statement) (s : statement) (_ : nat) (st : state) (q : list (nat * quotient)) (_ : nat) (nodes : list node) : bool :=
  match nodes with
  | [n] =>
    forallb (fun i => integral_term (integers st) (witness_terms s q i)) (own_integers s)
    && close known n (assume (negate (conjunction (map (instance (witness_terms s q)) (goals s)))) st)
  | _ => false
  end.

(* The goals for some values of what exists, as far as the variables below a number can tell. *)
Definition reached_below (width : nat) (s : statement) (a : assignment) : Prop :=
  exists b, (forall i, (i < width)%nat -> member (exist s) i = false -> b i = a i) /\ all_whole (own_integers s) b /\ Forall (holds b) (goals s).

Lemma finish_witness_sound known width s which st q fresh nodes a : Forall valid known ->
  finish_witness known s which st q fresh nodes = true -> point st a -> Forall (fun t => defined (snd t) a) q -> reached_below width s a.
Proof.
  intros truths good here each. destruct nodes as [|n [|]]; try discriminate. apply andb_prop in good. destruct good as [integer closed].
  rewrite forallb_forall in integer.
  assert (defined_ : forall i, defined (witness_terms s q i) a).
  { intro i. unfold witness_terms. destruct (member (exist s) i); [apply assigned_defined; [exact each|]|]; apply kept_value. }
  exists (fun i => value (witness_terms s q i) a). repeat split.
  - intros i _ other. unfold witness_terms. rewrite other. apply kept_value.
  - intros i inside. apply (integral_term_value (integers st)); [exact (proj2 (proj2 (proj2 here)))|now apply integer].
  - rewrite <- (Forall_same _ _ (goals s) (fun f => instance_holds _ a f defined_)), <- Forall_map, <- conjunction_holds.
    match goal with |- holds a ?f => destruct (holds_or_not a f) as [yes|no]; [exact yes|] end. apply negate_holds in no.
    destruct (closes_sound known n truths _ closed a (assume_point a st _ here no)).
Qed.

Lemma reached_of_below width s a : all_whole (universal_integers s) a ->
  forallb (uses (fun i => (i <? width)%nat || member (exist s) i)) (goals s) = true -> reached_below width s a -> reached s a.
Proof.
  intros integer low (b & same & integers_b & goal). rewrite forallb_forall in low. exists (fun i => if member (exist s) i then b i else a i).
  repeat split.
  - intros i other. now rewrite other.
  - intros i inside. destruct (member (exist s) i) eqn:exists_; [apply integers_b|apply integer]; apply filter_In; unfold absent; now rewrite exists_.
  - rewrite Forall_forall in goal |- *. intros f inside. apply (uses_holds _ b _ f (low f inside)); [|now apply goal]. intros i allowed.
    destruct (member (exist s) i) eqn:exists_; [reflexivity|]. rewrite orb_false_r in allowed. apply Nat.ltb_lt in allowed. now apply same.
Qed.

Inductive proof := Proof (n : node) | Witness (width : nat) (f : found).

Definition prove (known : list statement) (s : statement) (nodes : list node) (last : proof) : bool :=
  match prove_lines known (lines s) nodes (no_facts (universal_integers s)) with
  | None => false
  | Some st =>
    match last with
    | Proof n => match exist s with [] => close known n (assume (negate (conjunction (goals s))) st) | _ => false end
    | Witness width f =>
      forallb (uses (fun i => (i <? width)%nat || member (exist s) i)) (goals s)
      && find known width (finish_witness known s) f st
    end
  end.

Theorem prove_sound known s nodes last : Forall valid known -> prove known s nodes last = true -> valid s.
Proof.
  unfold prove, valid. intros truths good a integer. set (st0 := no_facts (universal_integers s)) in good.
  assert (start : point st0 a) by (apply no_facts_point; intros i inside; apply filter_In in inside; now apply integer).
  destruct (prove_lines known (lines s) nodes st0) as [st|] eqn:found; [|discriminate].
  apply (prove_lines_sound known _ truths _ _ _ _ found); [|exact start]. clear a integer start. intros a here.
  assert (integer : all_whole (universal_integers s) a).
  { destruct here as (_ & _ & _ & integer). now rewrite (prove_lines_integers _ _ _ _ _ found) in integer. }
  destruct last as [n|width f].
  - destruct (exist s) as [|] eqn:none; [|discriminate]. exists a. repeat split.
    + intros i inside. apply integer, filter_In. unfold absent. rewrite none. now split.
    + rewrite <- conjunction_holds.
      match goal with |- holds a ?f => destruct (holds_or_not a f) as [yes|no]; [exact yes|] end. apply negate_holds in no.
      destruct (closes_sound known n truths _ good a (assume_point a st _ here no)).
  - apply andb_prop in good. destruct good as [low good]. apply (reached_of_below width); [exact integer|exact low|].
    refine (find_sound known width _ (reached_below width s) truths _ _ f st good a here).
    + intros b c same (d & agree & rest). exists d. split; [|exact rest]. intros i less other. rewrite (agree i less other). now apply same.
    + intros which st' q fresh nodes' b good' there each. now apply (finish_witness_sound known width s which st' q fresh nodes' b).
Qed.

(* ---------------------------------------------------------------- points and counterexamples *)

Definition shown (known : list statement) (st : state) (s : statement) (terms : nat -> quotient) (n : node) : bool :=
  close known n (assume (negate (conjunction (map (instance terms) (premises (lines s))))) st).

(* Premises that hold at some values, those of `over` as they are; where `fails`, what is shown fails there. *)
Definition finish_values (known : list statement) (over : list nat) (fails_ : bool) (ss : list statement)
    (which : nat) (st : state) (q : list (nat * quotient)) (fresh : nat) (nodes : list node) : bool :=
  match nth_error ss which with
  | None => false
  | Some s =>
    let terms := instance_terms s over q fresh in
    uses_state (below fresh) st && fits s over q fresh (integers st)
    && match nodes, fails_ with
       | [n], false => shown known st s terms n
       | [n; m], true =>
         shown known st s terms n
         && close known m (assume (conjunction (map (instance terms) (goals s))) (more_integers (fresh_integers s fresh) st))
       | _, _ => false
       end
  end.

Definition values_for (over : list nat) (fails_ : bool) (ss : list statement) (a : assignment) : Prop :=
  exists s b, In s ss /\ (forall i, In i over -> b i = a i) /\ all_whole (whole_numbers s) b /\ Forall (holds b) (premises (lines s))
    /\ (fails_ = true -> ~ reached s b).

Lemma more_integers_point l st a : point st a -> all_whole l a -> point (more_integers l st) a.
Proof.
  intros (open & meet & some & integer) more. repeat split; trivial. intros i inside. apply in_app_or in inside. destruct inside; auto.
Qed.

Lemma finish_values_sound known over fails_ ss which st q fresh nodes a : Forall valid known ->
  finish_values known over fails_ ss which st q fresh nodes = true -> point st a -> Forall (fun t => defined (snd t) a) q ->
  values_for over fails_ ss a.
Proof.
  unfold finish_values. intros truths good here each. destruct (nth_error ss which) as [s|] eqn:found; [|discriminate].
  apply nth_error_In in found. apply andb_prop in good. destruct good as [good closed]. apply andb_prop in good. destruct good as [low fit].
  pose proof (proj2 (proj2 (proj2 here)) : all_whole (integers st) a) as integer. set (given := given_values s (instance_terms s over q fresh) a).
  pose proof (given_whole s over q fresh _ a fit integer : all_whole _ given) as whole_given.
  assert (step : forall n, shown known st s (instance_terms s over q fresh) n = true -> Forall (holds given) (premises (lines s))).
  { intros n closed_. destruct (instance_read s over q fresh _ a fit each given (fun _ _ => eq_refl) whole_given) as (c & agree & _ & read).
    rewrite <- (Forall_same _ _ _ read), <- Forall_map, <- conjunction_holds.
    match goal with |- holds c ?f => destruct (holds_or_not c f) as [yes|no]; [exact yes|] end. apply negate_holds in no.
    destruct (closes_sound known n truths _ closed_ c (assume_point c st _ (uses_state_point _ a c st low agree here) no)). }
  exists s, given. split; [exact found|]. split; [exact (given_over s over q fresh _ a fit)|]. split; [exact whole_given|].
  destruct nodes as [|n [|m [|]]]; try discriminate; destruct fails_; try discriminate.
  - split; [now apply (step n)|discriminate].
  - apply andb_prop in closed. destruct closed as [first second]. split; [now apply (step n)|]. intros _ (b & same & integers_b & goal).
    destruct (instance_read s over q fresh _ a fit each b same integers_b) as (c & agree & integers_c & read).
    apply (closes_sound known m truths _ second c), assume_point.
    + apply more_integers_point; [exact (uses_state_point _ a c st low agree here)|exact integers_c].
    + rewrite conjunction_holds, Forall_map, (Forall_same _ _ _ read). exact goal.
Qed.

Lemma values_sound known over width fails_ ss f st : Forall valid known -> forallb (below width) over = true ->
  find known width (finish_values known over fails_ ss) f st = true -> forall a, point st a -> values_for over fails_ ss a.
Proof.
  intros truths low good. rewrite forallb_forall in low. refine (find_sound known width _ (values_for over fails_ ss) truths _ _ f st good).
  - intros a b same (s & c & inside & stay & rest). exists s, c. split; [exact inside|]. split; [|exact rest].
    intros i here. rewrite (stay i here). apply same, Nat.ltb_lt, low, here.
  - intros which st' q fresh nodes a good' here each. now apply (finish_values_sound known over fails_ ss which st' q fresh nodes).
Qed.

Definition meets_premises (known : list statement) (s : statement) (f : found) : bool :=
  find known 0 (finish_values known [] false [s]) f (no_facts []).
Definition refute (known : list statement) (s : statement) (f : found) : bool :=
  find known 0 (finish_values known [] true [s]) f (no_facts []).

Lemma origin : point (no_facts []) (fun _ => 0).
Proof. apply no_facts_point. intros i []. Qed.

Theorem point_sound known s f : Forall valid known -> meets_premises known s f = true ->
  exists a, all_whole (whole_numbers s) a /\ Forall (holds a) (premises (lines s)).
Proof.
  intros truths good. destruct (values_sound known [] 0 false [s] f _ truths eq_refl good _ origin) as (s' & b & [<-|[]] & _ & integer & all & _).
  now exists b.
Qed.

Theorem refute_sound known s f : Forall valid known -> refute known s f = true -> ~ valid s.
Proof.
  intros truths good truth. destruct (values_sound known [] 0 true [s] f _ truths eq_refl good _ origin) as (s' & b & [<-|[]] & _ & integer & all & fails_).
  exact (fails_ eq_refl (goal_of_meaning _ _ _ (truth b integer) all)).
Qed.
