(* Statements of the checker of certificates, what they say, and their instances.

   Defined:  statement, valid (what it says); quotients (terms that divide by strict facts only); instance_terms, fits.
   Proved:   goal_of_meaning   what a statement says, as premises and goals;
             instance_read     terms in place of the variables of a statement, new variables for what exists: the instance of a formula
                               holds where the formula holds at the values. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool FunctionalExtensionality.
From Juggleproof Require Import Polynomials Formulas States.
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

(* Variables in `over` stay, the others get terms; what exists gets new variables, from the number `fresh` on. *)
Definition instance_terms (s : statement) (over : list nat) (q : list (nat * quotient)) (fresh i : nat) : quotient :=
  if member (exist s) i then kept (fresh + i) else if member over i then kept i else assigned q (fun _ => ([], number 1)) i.
Definition fresh_integers (s : statement) (fresh : nat) : list nat :=
  map (fun i => (fresh + i)%nat) (filter (member (exist s)) (whole_numbers s)).

(* The new variables occur nowhere, the premises do not speak of what exists, and integer variables get integers. *)
Definition fits (s : statement) (over : list nat) (q : list (nat * quotient)) (fresh : nat) (whole_in : list nat) : bool :=
  forallb (fun t => uses_term (below fresh) (snd t)) q && forallb (fun i => below fresh i && absent (exist s) i) over
  && forallb (uses (absent (exist s))) (premises (lines s))
  && forallb (fun i => member (exist s) i || integral_term whole_in (instance_terms s over q fresh i)) (whole_numbers s).

(* The values of the terms; what exists gets 0. *)
Definition given_values (s : statement) (terms : nat -> quotient) (a : assignment) : assignment :=
  fun i => if member (exist s) i then 0 else value (terms i) a.

Section Instances.
  Variables (s : statement) (over : list nat) (q : list (nat * quotient)) (fresh : nat) (whole_in : list nat) (a : assignment).
  Let terms := instance_terms s over q fresh.
  Let given := given_values s terms a.
  Hypothesis fit : fits s over q fresh whole_in = true.
  Hypothesis integer : all_whole whole_in a.
  Hypothesis each : Forall (fun t => defined (snd t) a) q.

  Lemma given_whole : all_whole (whole_numbers s) given.
  Proof.
    intros i inside. unfold given, given_values. destruct (member (exist s) i) eqn:exists_; [now exists 0%Z|].
    unfold fits in fit. apply andb_prop in fit. destruct fit as [_ good]. rewrite forallb_forall in good. specialize (good i inside).
    rewrite exists_ in good. now apply (integral_term_value whole_in).
  Qed.

  Lemma given_over i : In i over -> given i = a i.
  Proof.
    intro inside. unfold fits in fit. apply andb_prop in fit. destruct fit as [good _]. apply andb_prop in good. destruct good as [good _].
    apply andb_prop in good. destruct good as [_ good]. rewrite forallb_forall in good. specialize (good i inside). apply andb_prop in good.
    destruct good as [_ apart]. unfold absent in apart. apply negb_true_iff in apart. apply member_holds in inside.
    unfold given, given_values, terms, instance_terms. rewrite apart, inside. apply kept_value.
  Qed.

  Lemma given_premises b : (forall i, member (exist s) i = false -> b i = given i) ->
    Forall (holds b) (premises (lines s)) <-> Forall (holds given) (premises (lines s)).
  Proof.
    intro same. unfold fits in fit. apply andb_prop in fit. destruct fit as [good _]. apply andb_prop in good. destruct good as [_ good].
    rewrite forallb_forall in good. rewrite !Forall_forall.
    assert (read : forall f, In f (premises (lines s)) -> holds b f <-> holds given f); [|now split; intros all f inside; apply read, all].
    intros f inside. apply (uses_holds (absent (exist s))); [now apply good|]. intros i apart. now apply same, negb_true_iff.
  Qed.

  Lemma instance_read b : (forall i, member (exist s) i = false -> b i = given i) -> all_whole (whole_numbers s) b ->
    exists c, (forall i, below fresh i = true -> a i = c i) /\ all_whole (fresh_integers s fresh) c /\
    forall f, holds c (instance terms f) <-> holds b f.
  Proof.
    intros same integers_b. pose proof fit as good. unfold fits in good.
    apply andb_prop in good. destruct good as [good _]. apply andb_prop in good. destruct good as [good _]. apply andb_prop in good.
    destruct good as [low stay]. rewrite forallb_forall in low, stay.
    set (c := fun i => if (i <? fresh)%nat then a i else b (i - fresh)%nat).
    assert (agree : forall i, below fresh i = true -> a i = c i) by (intros i less; unfold c, below in *; now rewrite less).
    assert (beyond : forall i, c (fresh + i)%nat = b i).
    { intro i. unfold c. destruct (Nat.ltb_spec (fresh + i) fresh); [lia|]. f_equal. lia. }
    assert (values : forall i, defined (terms i) c /\ value (terms i) c = b i).
    { intro i. destruct (member (exist s) i) eqn:exists_; [unfold terms, instance_terms; rewrite exists_, <- beyond; apply kept_value|].
      rewrite (same i exists_). unfold given, given_values. rewrite exists_. unfold terms, instance_terms. rewrite exists_.
      destruct (member over i) eqn:stays.
      - split; [apply kept_value|]. apply member_holds in stays. specialize (stay i stays). apply andb_prop in stay. destruct stay as [less _].
        rewrite (proj2 (kept_value i c)), (proj2 (kept_value i a)). symmetry. now apply agree.
      - assert (fine : uses_term (below fresh) (assigned q (fun _ => ([], number 1)) i) = true).
        { clear -low. induction q as [|[k t] l IH]; [reflexivity|]. cbn [assigned].
          destruct (i =? k)%nat; [exact (low (k, t) (or_introl eq_refl))|]. apply IH. intros x inside. apply low. now right. }
        destruct (uses_term_value (below fresh) a c _ fine agree) as [unchanged still]. rewrite unchanged. split; [|reflexivity]. apply still.
        apply assigned_defined; [exact each|]. unfold defined. cbn [snd]. rewrite eval_number, Q2R_1. lra. }
    exists c. split; [exact agree|]. split.
    - intros i inside. apply in_map_iff in inside. destruct inside as (k & <- & inside). apply filter_In in inside. rewrite beyond. now apply integers_b.
    - intro f. rewrite instance_holds by apply values.
      replace (fun i => value (terms i) c) with b by (apply functional_extensionality; intro i; symmetry; apply values). reflexivity.
  Qed.
End Instances.

Lemma Forall_same (P Q : formula -> Prop) l : (forall f, P f <-> Q f) -> Forall P l <-> Forall Q l.
Proof. intro same. rewrite !Forall_forall. now split; intros all f inside; apply same, all. Qed.

Lemma Forall_or_not a l : Forall (holds a) l \/ ~ Forall (holds a) l.
Proof. rewrite <- holds_and. apply holds_or_not. Qed.
