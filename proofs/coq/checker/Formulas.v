(* Formulas over polynomials, as the checker of certificates has them, and what they are with quotients in place of their variables.

   Defined:  meets (what a relation says of a number), formula, holds, negate, conjunction, disjunction, atom; uses (which variables
             occur); quotient, value, substitute (a polynomial with quotients in place of variables), instance (a formula with them).
   Proved:   negate_holds, conjunction_holds, disjunction_holds, atom_holds; uses_holds; substitute_value; instance_holds. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool.
From Juggleproof Require Import Polynomials.
Import ListNotations.
Open Scope R_scope.

Inductive relation := Positive | Nonnegative | Zero | Nonzero.

Definition meets (r : relation) (x : R) : Prop :=
  match r with Positive => 0 < x | Nonnegative => 0 <= x | Zero => x = 0 | Nonzero => x <> 0 end.

Definition decide (r : relation) (c : Q) : bool :=
  match r with
  | Positive => negb (Qle_bool c 0)
  | Nonnegative => Qle_bool 0 c
  | Zero => Qeq_bool c 0
  | Nonzero => negb (Qeq_bool c 0)
  end.

Lemma Qle_bool_R c d : Qle_bool c d = true <-> Q2R c <= Q2R d.
Proof. rewrite Qle_bool_iff. split; [apply Qle_Rle|apply Rle_Qle]. Qed.

Lemma Qeq_bool_R c d : Qeq_bool c d = true <-> Q2R c = Q2R d.
Proof. rewrite Qeq_bool_iff. split; [apply Qeq_eqR|apply eqR_Qeq]. Qed.

Lemma decide_holds r c : decide r c = true <-> meets r (Q2R c).
Proof.
  pose proof (Qle_bool_R c 0) as low. pose proof (Qle_bool_R 0 c) as high. pose proof (Qeq_bool_R c 0) as zero. rewrite Q2R_0 in *.
  destruct r; cbn [decide meets]; rewrite ?negb_true_iff, <- ?not_true_iff_false; try tauto; rewrite low; split; lra.
Qed.

(* No formula of the checker has a constant inside a join, and no join is inside one of the same kind. *)
Inductive formula := Truth (b : bool) | Atom (p : poly) (r : relation) | And (parts : list formula) | Or (parts : list formula).

Lemma formula_induction (P : formula -> Prop) : (forall b, P (Truth b)) -> (forall p r, P (Atom p r)) ->
  (forall l, Forall P l -> P (And l)) -> (forall l, Forall P l -> P (Or l)) -> forall f, P f.
Proof.
  intros truth atom and or. refine (fix all f := match f with Truth b => truth b | Atom p r => atom p r | And l => and l _ | Or l => or l _ end);
    exact ((fix each (l : list formula) : Forall P l := match l with [] => Forall_nil P | g :: l => Forall_cons g (all g) (each l) end) l).
Qed.

Fixpoint holds (a : assignment) (f : formula) : Prop :=
  match f with
  | Truth b => b = true
  | Atom p r => meets r (eval p a)
  | And l => fold_right (fun g P => holds a g /\ P) True l
  | Or l => fold_right (fun g P => holds a g \/ P) False l
  end.

Lemma holds_and a l : holds a (And l) <-> Forall (holds a) l.
Proof.
  induction l as [|f l IH]; cbn in *; [split; [constructor|trivial]|]. rewrite Forall_cons_iff, <- IH. reflexivity.
Qed.

Lemma holds_or a l : holds a (Or l) <-> Exists (holds a) l.
Proof.
  induction l as [|f l IH]; cbn in *; [now rewrite Exists_nil|]. rewrite Exists_cons, <- IH. reflexivity.
Qed.

Lemma meets_or_not r x : {meets r x} + {~ meets r x}.
Proof. destruct r; cbn; [apply Rlt_dec|apply Rle_dec|apply Req_EM_T|]. destruct (Req_EM_T x 0); [right; tauto|now left]. Qed.

Lemma holds_or_not a f : holds a f \/ ~ holds a f.
Proof.
  induction f as [b|p r|l IH|l IH] using formula_induction; [destruct b; [left|right]; easy|destruct (meets_or_not r (eval p a)); tauto| |].
  - rewrite holds_and. induction IH as [|f l first _ [all|not]]; [now left; constructor| |].
    + destruct first; [left; now constructor|right]. intro each. inversion each. contradiction.
    + right. intro each. inversion each. contradiction.
  - rewrite holds_or. induction IH as [|f l first _ [some|none]]; [right; now rewrite Exists_nil| |].
    + left. now right.
    + destruct first; [left; now left|right]. rewrite Exists_cons. tauto.
Qed.

(* ---------------------------------------------------------------- joins and negation *)

Definition is_truth (b : bool) (f : formula) : bool := match f with Truth c => Bool.eqb b c | _ => false end.

Definition conjunction (l : list formula) : formula :=
  if existsb (is_truth false) l then Truth false
  else match flat_map (fun f => match f with Truth _ => [] | And parts => parts | _ => [f] end) l with
       | [] => Truth true | [f] => f | parts => And parts end.

Definition disjunction (l : list formula) : formula :=
  if existsb (is_truth true) l then Truth true
  else match flat_map (fun f => match f with Truth _ => [] | Or parts => parts | _ => [f] end) l with
       | [] => Truth false | [f] => f | parts => Or parts end.

Lemma conjunction_holds a l : holds a (conjunction l) <-> Forall (holds a) l.
Proof.
  unfold conjunction. destruct (existsb (is_truth false) l) eqn:constant.
  - apply existsb_exists in constant. destruct constant as ([[]| | |] & inside & false_); try discriminate. rewrite Forall_forall.
    split; [discriminate|]. intro all. now specialize (all _ inside).
  - assert (flat : Forall (holds a) l <->
        Forall (holds a) (flat_map (fun f => match f with Truth _ => [] | And parts => parts | _ => [f] end) l)).
    { induction l as [|f l IH]; [reflexivity|]. cbn in constant. apply orb_false_elim in constant. destruct constant as [first rest].
      cbn [flat_map]. rewrite Forall_cons_iff, Forall_app, (IH rest). apply and_iff_compat_r.
      destruct f as [[]| | |]; try discriminate; rewrite ?Forall_cons_iff, <- ?holds_and; cbn; intuition. }
    rewrite flat. destruct (flat_map _ l) as [|f [|g parts]]; [cbn; intuition| |apply holds_and]. rewrite Forall_cons_iff. intuition.
Qed.

Lemma disjunction_holds a l : holds a (disjunction l) <-> Exists (holds a) l.
Proof.
  unfold disjunction. destruct (existsb (is_truth true) l) eqn:constant.
  - apply existsb_exists in constant. destruct constant as ([[]| | |] & inside & true_); try discriminate.
    split; [|reflexivity]. intros _. apply Exists_exists. now exists (Truth true).
  - assert (flat : Exists (holds a) l <->
        Exists (holds a) (flat_map (fun f => match f with Truth _ => [] | Or parts => parts | _ => [f] end) l)).
    { induction l as [|f l IH]; [reflexivity|]. cbn in constant. apply orb_false_elim in constant. destruct constant as [first rest].
      cbn [flat_map]. rewrite Exists_cons, Exists_app, (IH rest). apply or_iff_compat_r.
      destruct f as [[]| | |]; try discriminate; rewrite ?Exists_cons, <- ?holds_or, ?Exists_nil; cbn; intuition. }
    rewrite flat. destruct (flat_map _ l) as [|f [|g parts]]; [rewrite Exists_nil; now split| |apply holds_or].
    rewrite Exists_cons, Exists_nil. intuition.
Qed.

Definition atom (p : poly) (r : relation) : formula := match constant p with Some c => Truth (decide r c) | None => Atom p r end.

Lemma atom_holds a p r : holds a (atom p r) <-> meets r (eval p a).
Proof.
  unfold atom. destruct (constant p) as [c|] eqn:found; [|reflexivity]. rewrite (constant_value p c a found). apply decide_holds.
Qed.

Fixpoint negate (f : formula) : formula :=
  match f with
  | Truth b => Truth (negb b)
  | Atom p Positive => Atom (opposite p) Nonnegative
  | Atom p Nonnegative => Atom (opposite p) Positive
  | Atom p Zero => Atom p Nonzero
  | Atom p Nonzero => Atom p Zero
  | And l => disjunction (map negate l)
  | Or l => conjunction (map negate l)
  end.

Lemma negate_holds a f : holds a (negate f) <-> ~ holds a f.
Proof.
  induction f as [b|p r|l IH|l IH] using formula_induction.
  - destruct b; cbn; split; easy.
  - destruct r; cbn [negate holds meets]; rewrite ?eval_opposite; [split; lra|split; lra|tauto|].
    split; [tauto|]. destruct (Req_dec (eval p a) 0); tauto.
  - cbn [negate]. rewrite disjunction_holds, holds_and, Exists_exists, Forall_forall. split.
    + intros (g & inside & no) all. apply in_map_iff in inside. destruct inside as (f & <- & inside).
      rewrite Forall_forall in IH. apply (IH f inside) in no. exact (no (all f inside)).
    + intro not. induction IH as [|f l first rest again]; [destruct not; intros g []|].
      destruct (holds_or_not a f) as [yes|no].
      * destruct again as (g & inside & no); [|exists g; split; [now right|exact no]].
        intro all. apply not. intros g [<-|inside]; [exact yes|now apply all].
      * exists (negate f). split; [now left|now apply first].
  - cbn [negate]. rewrite conjunction_holds, holds_or, Forall_map, Forall_forall. rewrite Forall_forall in IH. rewrite Exists_exists. split.
    + intros all (f & inside & yes). exact (proj1 (IH f inside) (all f inside) yes).
    + intros none f inside. apply IH; [exact inside|]. intro yes. apply none. now exists f.
Qed.

Fixpoint uses (allowed : nat -> bool) (f : formula) : bool :=
  match f with Truth _ => true | Atom p _ => only allowed p | And l => forallb (uses allowed) l | Or l => forallb (uses allowed) l end.

Lemma uses_holds allowed (a b : assignment) f : uses allowed f = true -> (forall i, allowed i = true -> a i = b i) ->
  holds a f <-> holds b f.
Proof.
  intros good same. induction f as [c|p r|l IH|l IH] using formula_induction; [reflexivity| | |].
  - cbn in good |- *. now rewrite (eval_only allowed p a b good same).
  - rewrite !holds_and. cbn in good. induction IH as [|f l first _ IH]; [easy|]. cbn in good. apply andb_prop in good.
    rewrite !Forall_cons_iff. now rewrite (first (proj1 good)), (IH (proj2 good)).
  - rewrite !holds_or. cbn in good. induction IH as [|f l first _ IH]; [now rewrite !Exists_nil|]. cbn in good. apply andb_prop in good.
    rewrite !Exists_cons. now rewrite (first (proj1 good)), (IH (proj2 good)).
Qed.

(* ---------------------------------------------------------------- quotients in place of variables *)

Definition quotient : Type := poly * poly. (* numerator, denominator *)
Definition value (q : quotient) (a : assignment) : R := eval (fst q) a / eval (snd q) a.
Definition defined (q : quotient) (a : assignment) : Prop := eval (snd q) a <> 0.

Fixpoint same_poly (p q : poly) : bool :=
  match p, q with
  | [], [] => true
  | (c, m) :: p, (d, k) :: q => Qeq_bool c d && same_monomial m k && same_poly p q
  | _, _ => false
  end.

Lemma same_poly_value p : forall q a, same_poly p q = true -> eval p a = eval q a.
Proof.
  induction p as [|[c m] p IH]; intros [|[d k] q] a; cbn; try easy. intro same.
  apply andb_prop in same. destruct same as [same rest]. apply andb_prop in same. destruct same as [first second].
  apply Qeq_bool_eq, Qeq_eqR in first. apply same_monomial_holds in second. now rewrite first, second, (IH q a rest).
Qed.

Definition sum_of (x y : quotient) : quotient :=
  if same_poly (snd x) (snd y) then (add (fst x) (fst y), snd x)
  else (add (mul (fst x) (snd y)) (mul (fst y) (snd x)), mul (snd x) (snd y)).
Definition product_of (x y : quotient) : quotient := (mul (fst x) (fst y), mul (snd x) (snd y)).

Lemma sum_value x y a : defined x a -> defined y a -> defined (sum_of x y) a /\ value (sum_of x y) a = value x a + value y a.
Proof.
  unfold sum_of, defined, value. intros dx dy. destruct (same_poly (snd x) (snd y)) eqn:same; cbn.
  - split; [exact dx|]. rewrite eval_add, <- (same_poly_value _ _ a same). field. exact dx.
  - rewrite eval_add, !eval_mul. split; [now apply Rmult_integral_contrapositive_currified|]. field. now split.
Qed.

Lemma product_value x y a : defined x a -> defined y a -> defined (product_of x y) a /\ value (product_of x y) a = value x a * value y a.
Proof.
  unfold product_of, defined, value. intros dx dy. cbn. rewrite !eval_mul.
  split; [now apply Rmult_integral_contrapositive_currified|]. field. now split.
Qed.

Definition one : quotient := (number 1, number 1).

Lemma one_value a : defined one a /\ value one a = 1.
Proof. unfold defined, value, one. cbn [fst snd]. rewrite eval_number, Q2R_1. split; lra. Qed.

Fixpoint powers (t : quotient) (n : nat) : quotient := match n with O => one | S k => product_of t (powers t k) end.

Fixpoint substitute_monomial (m : monomial) (terms : nat -> quotient) : quotient :=
  match m with [] => one | e :: rest => product_of (powers (terms 0%nat) e) (substitute_monomial rest (fun i => terms (S i))) end.

Fixpoint substitute (p : poly) (terms : nat -> quotient) : quotient :=
  match p with
  | [] => ([], number 1)
  | (c, m) :: rest => let t := substitute_monomial m terms in sum_of (scale c (fst t), snd t) (substitute rest terms)
  end.

Lemma powers_value t n a : defined t a -> defined (powers t n) a /\ value (powers t n) a = value t a ^ n.
Proof.
  intro dt. induction n as [|n [dn IH]]; cbn; [apply one_value|].
  destruct (product_value t (powers t n) a dt dn) as [d v]. split; [exact d|]. now rewrite v, IH.
Qed.

Lemma substitute_monomial_value m a : forall terms, (forall i, defined (terms i) a) ->
  defined (substitute_monomial m terms) a /\ value (substitute_monomial m terms) a = product m (fun i => value (terms i) a).
Proof.
  induction m as [|e m IH]; intros terms each; cbn; [apply one_value|].
  destruct (powers_value (terms 0%nat) e a (each 0%nat)) as [d v]. destruct (IH (fun i => terms (S i)) (fun i => each (S i))) as [d' v'].
  destruct (product_value _ _ a d d') as [d'' v'']. split; [exact d''|]. now rewrite v'', v, v'.
Qed.

Lemma substitute_value p a terms : (forall i, defined (terms i) a) ->
  defined (substitute p terms) a /\ value (substitute p terms) a = eval p (fun i => value (terms i) a).
Proof.
  intro each. induction p as [|[c m] p [d IH]]; cbn [substitute eval].
  - unfold defined, value. cbn [fst snd]. rewrite eval_number, Q2R_1. cbn. split; lra.
  - destruct (substitute_monomial_value m a terms each) as [dm vm]. set (t := substitute_monomial m terms) in *. cbn zeta.
    assert (scaled : defined (scale c (fst t), snd t) a) by exact dm.
    destruct (sum_value _ _ a scaled d) as [ds vs]. split; [exact ds|]. rewrite vs, IH, <- vm. f_equal.
    unfold value. cbn [fst snd]. rewrite eval_scale. unfold Rdiv. ring.
Qed.

(* The sign of a quotient is that of the product of its parts; where only zero matters, of the numerator. *)
Definition compared (q : quotient) (r : relation) : formula :=
  atom (match r with Positive | Nonnegative => mul (fst q) (snd q) | _ => fst q end) r.

Lemma compared_holds q r a : defined q a -> holds a (compared q r) <-> meets r (value q a).
Proof.
  unfold compared, defined, value. intro apart. rewrite atom_holds. set (n := eval (fst q) a). set (d := eval (snd q) a) in *.
  assert (square : 0 < d * d) by now apply Rsqr_pos_lt.
  assert (same : n * d = n / d * (d * d)) by (field; exact apart).
  assert (back : n = n / d * d) by (field; exact apart).
  destruct r; cbn [meets]; rewrite ?eval_mul; fold n; fold d.
  - rewrite same. split; intro sign; nra.
  - rewrite same. split; intro sign; nra.
  - split; intro zero; [rewrite zero; unfold Rdiv; ring|rewrite back, zero; ring].
  - split; intros other zero; apply other; [rewrite back, zero; ring|rewrite zero; unfold Rdiv; ring].
Qed.

Fixpoint instance (terms : nat -> quotient) (f : formula) : formula :=
  match f with
  | Truth b => Truth b
  | Atom p r => compared (substitute p terms) r
  | And l => conjunction (map (instance terms) l)
  | Or l => disjunction (map (instance terms) l)
  end.

Lemma instance_holds terms a f : (forall i, defined (terms i) a) -> holds a (instance terms f) <-> holds (fun i => value (terms i) a) f.
Proof.
  intro each. induction f as [b|p r|l IH|l IH] using formula_induction; [reflexivity| | |].
  - cbn [instance]. destruct (substitute_value p a terms each) as [apart same]. rewrite (compared_holds _ r a apart), same. reflexivity.
  - cbn [instance]. rewrite conjunction_holds, holds_and, Forall_map. induction IH as [|f l first _ IH]; [easy|].
    rewrite !Forall_cons_iff. now rewrite first, IH.
  - cbn [instance]. rewrite disjunction_holds, holds_or, Exists_map. induction IH as [|f l first _ IH]; [now rewrite !Exists_nil|].
    rewrite !Exists_cons. now rewrite first, IH.
Qed.
