(* The proof rules of the checker of certificates, for any state and any certificate: what they close has no point.

   Defined:  statement, valid (what it says); node (a part of a certificate), close (rule by rule as in certificates/checker/rules.py).
   Proved:   instance_of_valid   any instance of a valid statement holds, for some values of what exists;
             closes_sound        a state that a node closes, given valid statements, has no point. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool FunctionalExtensionality.
From Juggleproof Require Import Polynomials Formulas Bernstein States Boxes.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- statements *)

(* `range` and `given` lines, `have` lines, and `root` lines: the variable is the square root of the polynomial. *)
Inductive line := Given (f : formula) | Have (f : formula) | Root (v : nat) (p : poly).
(* The variables in `exist` are those that exist; every other one is for all. *)
Record statement := { whole_numbers : list nat; lines : list line; exist : list nat; goals : list formula }.

Fixpoint meaning (l : list line) (goal : assignment -> Prop) (a : assignment) : Prop :=
  match l with
  | [] => goal a
  | Given f :: l => holds a f -> meaning l goal a
  | Have f :: l => holds a f /\ meaning l goal a
  | Root v p :: l => 0 <= eval p a /\ meaning l goal (put v (sqrt (eval p a)) a)
  end.

Definition all_whole (integers : list nat) (a : assignment) : Prop := forall i, In i integers -> whole (a i).
Definition reached (s : statement) (a : assignment) : Prop :=
  exists b, (forall i, member (exist s) i = false -> b i = a i) /\ all_whole (whole_numbers s) b /\ Forall (holds b) (goals s).
Definition valid (s : statement) : Prop := forall a, all_whole (whole_numbers s) a -> meaning (lines s) (reached s) a.

Definition root_facts (v : nat) (p : poly) : list formula :=
  [atom (variable v) Nonnegative; atom (minus (mul (variable v) (variable v)) p) Zero].
Definition premises (l : list line) : list formula :=
  flat_map (fun l => match l with Given f | Have f => [f] | Root v p => root_facts v p end) l.

Lemma root_facts_hold a v p : Forall (holds a) (root_facts v p) <-> 0 <= a v /\ a v * a v = eval p a.
Proof.
  unfold root_facts. rewrite !Forall_cons_iff, !atom_holds. cbn [meets]. rewrite eval_minus, eval_mul, !eval_variable.
  split; [intros (sign & zero & _); split; lra|intros [sign zero]; repeat split; [exact sign|lra|constructor]].
Qed.

Lemma put_own v a : put v (a v) a = a.
Proof. apply functional_extensionality. intro i. unfold put. destruct (Nat.eqb_spec i v); congruence. Qed.

Lemma goal_of_meaning goal l : forall a, meaning l goal a -> Forall (holds a) (premises l) -> goal a.
Proof.
  induction l as [|[f|f|v p] l IH]; intros a means all; [exact means| | |]; cbn [premises flat_map] in all; rewrite Forall_app in all;
    destruct all as [first rest]; cbn in means.
  - apply IH; [apply means; now inversion first|exact rest].
  - now apply IH.
  - apply root_facts_hold in first. destruct first as [sign square]. apply IH; [|exact rest].
    rewrite <- square, sqrt_square, put_own in means by exact sign. apply means.
Qed.

(* ---------------------------------------------------------------- terms in place of variables *)

(* A numerator, and powers of strict facts, by which it is divided. *)
Definition term : Type := poly * list (nat * nat).

Fixpoint denominator (fs : list fact) (l : list (nat * nat)) : option poly :=
  match l with
  | [] => Some (number 1)
  | (i, e) :: rest =>
    match nth_error fs i, denominator fs rest with
    | Some (p, r), Some q => if strict r then Some (mul (power p e) q) else None
    | _, _ => None
    end
  end.

Fixpoint quotients (fs : list fact) (l : list (nat * term)) : option (list (nat * quotient)) :=
  match l with
  | [] => Some []
  | (i, (p, under)) :: rest =>
    match denominator fs under, quotients fs rest with Some d, Some q => Some ((i, (p, d)) :: q) | _, _ => None end
  end.

Lemma denominator_nonzero a fs : Forall (true_at a) fs -> forall l d, denominator fs l = Some d -> eval d a <> 0.
Proof.
  intro each. induction l as [|[i e] l IH]; cbn [denominator]; intros d found; [injection found as <-; rewrite eval_number, Q2R_1; lra|].
  destruct (nth_error fs i) as [[p r]|] eqn:fact_; [|discriminate]. destruct (denominator fs l) as [q|]; [|discriminate].
  destruct (strict r) eqn:sign; [|discriminate]. injection found as <-. rewrite eval_mul, eval_power.
  apply Rmult_integral_contrapositive_currified; [|now apply IH]. apply pow_nonzero.
  pose proof (fact_true a fs i p r each fact_) as meet. destruct r; cbn in *; try discriminate; lra.
Qed.

Definition kept (i : nat) : quotient := (variable i, number 1).
Fixpoint assigned (q : list (nat * quotient)) (other : nat -> quotient) (i : nat) : quotient :=
  match q with [] => other i | (k, t) :: rest => if (i =? k)%nat then t else assigned rest other i end.

Lemma kept_value i a : defined (kept i) a /\ value (kept i) a = a i.
Proof. unfold defined, value, kept. cbn [fst snd]. rewrite eval_number, eval_variable, Q2R_1. split; lra. Qed.

Lemma quotients_defined a fs : Forall (true_at a) fs -> forall l q, quotients fs l = Some q -> Forall (fun t => defined (snd t) a) q.
Proof.
  intro each. induction l as [|[i [p under]] l IH]; cbn [quotients]; intros q found; [injection found as <-; constructor|].
  destruct (denominator fs under) as [d|] eqn:of_facts; [|discriminate]. destruct (quotients fs l) as [rest|]; [|discriminate].
  injection found as <-. constructor; [exact (denominator_nonzero a fs each under d of_facts)|now apply IH].
Qed.

Lemma assigned_defined a q other i : Forall (fun t => defined (snd t) a) q -> defined (other i) a -> defined (assigned q other i) a.
Proof. intros each rest. induction each as [|[k t] q first _ IH]; cbn; [exact rest|]. destruct (i =? k)%nat; [exact first|exact IH]. Qed.

Definition integral_term (integers : list nat) (t : quotient) : bool := integral integers (fst t) && same_poly (snd t) (number 1).

Lemma integral_term_value integers a t : all_whole integers a -> integral_term integers t = true -> whole (value t a).
Proof.
  unfold integral_term, value. intros integer good. apply andb_prop in good. destruct good as [upper lower].
  rewrite (same_poly_value _ _ a lower), eval_number, Q2R_1. unfold Rdiv. rewrite Rinv_1, Rmult_1_r. now apply (integral_value integers).
Qed.

(* ---------------------------------------------------------------- instances of a statement *)

Definition below (n i : nat) : bool := (i <? n)%nat.
Definition absent (l : list nat) (i : nat) : bool := negb (member l i).
Definition uses_term (allowed : nat -> bool) (t : quotient) : bool := only allowed (fst t) && only allowed (snd t).

Lemma uses_term_value allowed a b t : uses_term allowed t = true -> (forall i, allowed i = true -> a i = b i) ->
  value t a = value t b /\ (defined t a -> defined t b).
Proof.
  unfold uses_term, value, defined. intros good same. apply andb_prop in good. destruct good as [upper lower].
  rewrite <- (eval_only _ _ a b upper same), <- (eval_only _ _ a b lower same). now split.
Qed.

(* Variables with terms get these; what exists gets new variables, from the number `fresh` on. *)
Definition instance_terms (s : statement) (q : list (nat * quotient)) (fresh i : nat) : quotient :=
  if member (exist s) i then kept (fresh + i) else assigned q (fun _ => ([], number 1)) i.
Definition instance_of (s : statement) (terms : nat -> quotient) : formula :=
  disjunction [negate (conjunction (map (instance terms) (premises (lines s)))); conjunction (map (instance terms) (goals s))].
Definition fresh_integers (s : statement) (fresh : nat) : list nat :=
  map (fun i => (fresh + i)%nat) (filter (member (exist s)) (whole_numbers s)).

(* The new variables occur nowhere, the premises do not speak of what exists, and integer variables get integers. *)
Definition fits (s : statement) (q : list (nat * quotient)) (fresh : nat) (whole_in : list nat) : bool :=
  forallb (fun t => uses_term (below fresh) (snd t)) q && forallb (uses (absent (exist s))) (premises (lines s))
  && forallb (fun i => member (exist s) i || integral_term whole_in (instance_terms s q fresh i)) (whole_numbers s).

Lemma Forall_or_not a l : Forall (holds a) l \/ ~ Forall (holds a) l.
Proof. rewrite <- holds_and. apply holds_or_not. Qed.

Lemma Forall_same (P Q : formula -> Prop) l : (forall f, P f <-> Q f) -> Forall P l <-> Forall Q l.
Proof. intro same. rewrite !Forall_forall. now split; intros all f inside; apply same, all. Qed.

Lemma instance_of_valid s q fresh whole_in a : valid s -> fits s q fresh whole_in = true ->
  all_whole whole_in a -> Forall (fun t => defined (snd t) a) q -> exists b, (forall i, below fresh i = true -> a i = b i) /\
  all_whole (fresh_integers s fresh) b /\ holds b (instance_of s (instance_terms s q fresh)).
Proof.
  intros truth good integer each. unfold fits in good.
  apply andb_prop in good. destruct good as [good integral_]. apply andb_prop in good. destruct good as [low apart].
  rewrite forallb_forall in low, apart, integral_. set (terms := instance_terms s q fresh) in *.
  set (given := fun i => if member (exist s) i then 0 else value (terms i) a).
  assert (integers_given : all_whole (whole_numbers s) given).
  { intros i inside. unfold given. destruct (member (exist s) i) eqn:exists_; [now exists 0%Z|].
    specialize (integral_ i inside). rewrite exists_ in integral_. now apply (integral_term_value whole_in). }
  assert (some : exists b, (forall i, member (exist s) i = false -> b i = given i) /\ all_whole (whole_numbers s) b /\
      (Forall (holds given) (premises (lines s)) -> Forall (holds b) (goals s))).
  { destruct (Forall_or_not given (premises (lines s))) as [all|not]; [|now exists given].
    destruct (goal_of_meaning _ _ _ (truth given integers_given) all) as (b & same & integers_b & goal). now exists b. }
  destruct some as (b & same & integers_b & goal).
  set (c := fun i => if (i <? fresh)%nat then a i else b (i - fresh)%nat).
  assert (agree : forall i, below fresh i = true -> a i = c i) by (intros i less; unfold c, below in *; now rewrite less).
  assert (beyond : forall i, c (fresh + i)%nat = b i).
  { intro i. unfold c. destruct (Nat.ltb_spec (fresh + i) fresh); [lia|]. f_equal. lia. }
  assert (values : forall i, defined (terms i) c /\ value (terms i) c = b i).
  { intro i. destruct (member (exist s) i) eqn:exists_.
    - unfold terms, instance_terms. rewrite exists_, <- beyond. apply kept_value.
    - assert (fine : value (terms i) a = value (terms i) c /\ (defined (terms i) a -> defined (terms i) c)).
      { apply (uses_term_value (below fresh)); [|exact agree]. unfold terms, instance_terms. rewrite exists_.
        clear -low. induction q as [|[k t] q IH]; [reflexivity|]. cbn [assigned]. destruct (i =? k)%nat; [exact (low (k, t) (or_introl eq_refl))|].
        apply IH. intros x inside. apply low. now right. }
      split.
      + apply fine. unfold terms, instance_terms. rewrite exists_. apply assigned_defined; [exact each|].
        unfold defined. cbn [snd]. rewrite eval_number, Q2R_1. lra.
      + rewrite <- (proj1 fine), (same i exists_). unfold given. now rewrite exists_. }
  exists c. split; [exact agree|]. split.
  - intros i inside. apply in_map_iff in inside. destruct inside as (k & <- & inside). apply filter_In in inside.
    rewrite beyond. now apply integers_b.
  - assert (point_ : (fun i => value (terms i) c) = b) by (apply functional_extensionality; apply values).
    assert (read : forall f, holds c (instance terms f) <-> holds b f).
    { intro f. rewrite instance_holds by apply values. now rewrite point_. }
    unfold instance_of. rewrite disjunction_holds, Exists_cons, Exists_cons, Exists_nil, negate_holds, !conjunction_holds, !Forall_map.
    rewrite !(Forall_same _ _ _ read). destruct (Forall_or_not b (premises (lines s))) as [all|not]; [|tauto]. right. left. apply goal.
    rewrite Forall_forall in all |- *. intros f inside. apply (uses_holds (absent (exist s)) given b f (apart f inside)); [|now apply all].
    intros i absent_. unfold absent in absent_. apply negb_true_iff in absent_. symmetry. now apply same.
Qed.

(* ---------------------------------------------------------------- certificates *)

Inductive node :=
  | Close
  | Psatz (products : list (Q * list (nat * nat) * poly)) (equations : list (nat * poly))
  | Cases (k : nat) (nodes : list node)
  | Sign (p : poly) (less equal more : node)
  | Boxed (i : nat) (bounds : list (nat * nat)) (tree : list letter)
  | Integral (i : nat) (rest : node)
  | Use (k : nat) (terms : list (nat * term)) (fresh : nat) (rest : node).

Lemma node_induction (P : node -> Prop) : P Close -> (forall products equations, P (Psatz products equations)) ->
  (forall k nodes, Forall P nodes -> P (Cases k nodes)) -> (forall p less equal more, P less -> P equal -> P more -> P (Sign p less equal more)) ->
  (forall i bounds tree, P (Boxed i bounds tree)) -> (forall i rest, P rest -> P (Integral i rest)) -> (forall k terms fresh rest, P rest -> P (Use k terms fresh rest)) ->
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
  | Boxed i bounds tree => boxes (facts st) i bounds tree
  | Integral i rest =>
    match nth_error (facts st) i with
    | Some (p, Positive) => integral (integers st) p && close known rest (assume (atom (minus p (number 1)) Nonnegative) st)
    | _ => false
    end
  | Use k terms fresh rest =>
    match nth_error known k, quotients (facts st) terms with
    | Some s, Some q =>
      uses_state (below fresh) st && fits s q fresh (integers st)
      && close known rest (assume (instance_of s (instance_terms s q fresh)) (more_integers (fresh_integers s fresh) st))
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
