(* The proof rules of the checker of certificates, for any state and any certificate: what they close has no point.

   Defined:  node (a part of a certificate), close (rule by rule as in certificates/checker/rules.py).
   Proved:   instance_of_valid   any instance of a valid statement holds, for some values of what exists;
             closes_sound        a state that a node closes, given valid statements, has no point. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool.
From Juggleproof Require Import Polynomials Formulas Bernstein States Boxes Instances.
Import ListNotations.
Open Scope R_scope.

(* The premises fail, or the goals hold. *)
Definition instance_of (s : statement) (terms : nat -> quotient) : formula :=
  disjunction [negate (conjunction (map (instance terms) (premises (lines s)))); conjunction (map (instance terms) (goals s))].

Lemma instance_of_valid s q fresh whole_in a : valid s -> fits s [] q fresh whole_in = true ->
  all_whole whole_in a -> Forall (fun t => defined (snd t) a) q -> exists b, (forall i, below fresh i = true -> a i = b i) /\
  all_whole (fresh_integers s fresh) b /\ holds b (instance_of s (instance_terms s [] q fresh)).
Proof.
  intros truth fit integer each. set (terms := instance_terms s [] q fresh). set (given := given_values s terms a).
  pose proof (given_whole s [] q fresh whole_in a fit integer : all_whole _ given) as integers_given.
  assert (some : exists b, (forall i, member (exist s) i = false -> b i = given i) /\ all_whole (whole_numbers s) b /\
      (Forall (holds given) (premises (lines s)) -> Forall (holds b) (goals s))).
  { destruct (Forall_or_not given (premises (lines s))) as [all|not]; [|now exists given].
    destruct (goal_of_meaning _ _ _ (truth given integers_given) all) as (b & same & integers_b & goal). now exists b. }
  destruct some as (b & same & integers_b & goal).
  destruct (instance_read s [] q fresh whole_in a fit each b same integers_b) as (c & agree & integers_c & read).
  exists c. split; [exact agree|]. split; [exact integers_c|]. unfold instance_of. fold terms in read.
  rewrite disjunction_holds, Exists_cons, Exists_cons, Exists_nil, negate_holds, !conjunction_holds, !Forall_map, !(Forall_same _ _ _ read).
  rewrite (given_premises s [] q fresh whole_in a fit b same : _ <-> Forall (holds given) _).
  destruct (Forall_or_not given (premises (lines s))) as [all|not]; tauto.
Qed.

(* ---------------------------------------------------------------- certificates *)

Inductive node :=
  | Close
  | Psatz (products : list (Q * list (nat * nat) * poly)) (equations : list (nat * poly))
  | Cases (k : nat) (nodes : list node)
  | Sign (p : poly) (less equal more : node)
  | Boxes (i : nat) (bounds : list (nat * nat)) (tree : list letter)
  | Integral (i : nat) (rest : node)
  | Use (k : nat) (terms : list (nat * term)) (fresh : nat) (rest : node).

Lemma node_induction (P : node -> Prop) : P Close -> (forall products equations, P (Psatz products equations)) ->
  (forall k nodes, Forall P nodes -> P (Cases k nodes)) -> (forall p less equal more, P less -> P equal -> P more -> P (Sign p less equal more)) ->
  (forall i bounds tree, P (Boxes i bounds tree)) -> (forall i rest, P rest -> P (Integral i rest)) -> (forall k terms fresh rest, P rest -> P (Use k terms fresh rest)) ->
  forall n, P n.
Proof.
  intros close_ psatz_ cases_ sign_ boxes_ integral_ use_. fix all 1.
  intros [|products equations|k nodes|p less equal more|i bounds tree|i rest|k terms fresh rest];
    [exact close_|apply psatz_|apply cases_|now apply sign_|apply boxes_|now apply integral_|now apply use_].
  exact ((fix each (l : list node) : Forall P l := match l with [] => Forall_nil P | n :: l => Forall_cons n (all n) (each l) end) nodes).
Qed.

Definition less_choice (k : nat) (st : state) : state :=
  {| facts := facts st; choices := without k (choices st); shut := shut st; integers := integers st |}.
Definition more_integers (l : list nat) (st : state) : state :=
  {| facts := facts st; choices := choices st; shut := shut st; integers := integers st ++ l |}.

Fixpoint close (known : list statement) (n : node) (st : state) : bool :=
  match n with
  | Close => shut st
  | Psatz products equations => psatz (facts st) products equations
  | Cases k nodes =>
    match nth_error (choices st) k with
    | None => false
    | Some alternatives =>
      (fix each (nodes : list node) (alternatives : list formula) : bool :=
        match nodes, alternatives with
        | [], [] => true
        | n :: nodes, f :: alternatives => close known n (assume f (less_choice k st)) && each nodes alternatives
        | _, _ => false
        end) nodes alternatives
    end
  | Sign p less equal more =>
    close known less (assume (atom (opposite p) Positive) st) && close known equal (assume (atom p Zero) st)
    && close known more (assume (atom p Positive) st)
  | Boxes i bounds tree => boxes (facts st) i bounds tree
  | Integral i rest =>
    match nth_error (facts st) i with
    | Some (p, Positive) => integral (integers st) p && close known rest (assume (atom (minus p (number 1)) Nonnegative) st)
    | _ => false
    end
  | Use k terms fresh rest =>
    match nth_error known k, quotients (facts st) terms with
    | Some s, Some q =>
      uses_state (below fresh) st && fits s [] q fresh (integers st)
      && close known rest (assume (instance_of s (instance_terms s [] q fresh)) (more_integers (fresh_integers s fresh) st))
    | _, _ => false
    end
  end.

Lemma whole_above_0 x : whole x -> 0 < x -> 0 <= x - 1.
Proof. intros [z ->] positive. apply lt_IZR in positive. assert (1 <= z)%Z as least by lia. apply IZR_le in least. lra. Qed.

Theorem closes_sound known n : Forall valid known -> forall st, close known n st = true -> forall a, ~ point st a.
Proof.
  intro truths.
  induction n as [|products equations|k nodes IH|p less equal more IHl IHe IHm|i bounds tree|i rest IH|k terms fresh rest IH] using node_induction;
    cbn [close]; intros st good a here.
  - destruct here as [open _]. congruence.
  - exact (psatz_sound a _ _ _ good (proj1 (proj2 here))).
  - destruct (nth_error (choices st) k) as [alternatives|] eqn:choice; [|discriminate].
    assert (rest : point (less_choice k st) a).
    { destruct here as (open & meet & some & integer). repeat split; trivial. cbn. clear -some. revert k.
      induction some as [|l choices first all IH]; intros [|k]; cbn; try constructor; auto. }
    assert (one : Exists (holds a) alternatives).
    { destruct here as (_ & _ & some & _). rewrite Forall_forall in some. exact (some _ (nth_error_In _ _ choice)). }
    clear choice. revert alternatives good one. induction IH as [|n nodes first _ again]; intros [|f alternatives] good one; try discriminate; [inversion one|].
    apply andb_prop in good. destruct good as [good others]. inversion one as [? ? true_|? ? later]; subst.
    + exact (first _ good a (assume_point a _ f rest true_)).
    + exact (again alternatives others later).
  - apply andb_prop in good. destruct good as [good third]. apply andb_prop in good. destruct good as [first second].
    destruct (Rtotal_order (eval p a) 0) as [sign|[sign|sign]].
    + apply (IHl _ first a), assume_point; [exact here|]. apply atom_holds. cbn. rewrite eval_opposite. lra.
    + apply (IHe _ second a), assume_point; [exact here|]. now apply atom_holds.
    + apply (IHm _ third a), assume_point; [exact here|]. now apply atom_holds.
  - exact (boxes_sound a _ _ _ _ good (proj1 (proj2 here))).
  - destruct (nth_error (facts st) i) as [[p []]|] eqn:found; try discriminate. apply andb_prop in good. destruct good as [integral_ good].
    apply (IH _ good a), assume_point; [exact here|]. destruct here as (_ & meet & _ & integer). apply atom_holds. cbn [meets].
    rewrite eval_minus, eval_number, Q2R_1. apply whole_above_0; [now apply (integral_value (integers st))|].
    exact (fact_true a _ i p Positive meet found).
  - destruct (nth_error known k) as [s|] eqn:found; [|discriminate]. destruct (quotients (facts st) terms) as [q|] eqn:terms_; [|discriminate].
    apply andb_prop in good. destruct good as [good rest_]. apply andb_prop in good. destruct good as [low fit].
    assert (truth : valid s) by (rewrite Forall_forall in truths; exact (truths s (nth_error_In _ _ found))).
    pose proof (quotients_defined a _ (proj1 (proj2 here)) terms q terms_) as each.
    destruct (instance_of_valid s q fresh _ a truth fit (proj2 (proj2 (proj2 here))) each) as (b & same & integers_b & instance_).
    apply (IH _ rest_ b), assume_point; [|exact instance_].
    destruct (uses_state_point _ a b st low same here) as (open & meet & some & integer). repeat split; trivial.
    intros i inside. apply in_app_or in inside. destruct inside; auto.
Qed.
