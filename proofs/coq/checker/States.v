(* States of the checker of certificates: what is assumed on one branch of a proof; and its rule of combinations with positive
   coefficients, for any facts.

   Defined:  state, point, assume, uses_state (which variables occur); psatz.
   Proved:   assume_point, uses_state_point; product_sign; psatz_sound: facts that the rule refutes do not all hold. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool.
From Juggleproof Require Import Polynomials Formulas.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- states *)

Definition fact : Type := poly * relation.
Record state := { facts : list fact; choices : list (list formula); shut : bool; integers : list nat }.

Definition true_at (a : assignment) (f : fact) : Prop := meets (snd f) (eval (fst f) a).
Definition point (st : state) (a : assignment) : Prop :=
  shut st = false /\ Forall (true_at a) (facts st) /\ Forall (Exists (holds a)) (choices st) /\ (forall i, In i (integers st) -> whole (a i)).

Definition assume_part (st : state) (f : formula) : state :=
  match f with
  | Truth b => {| facts := facts st; choices := choices st; shut := shut st || negb b; integers := integers st |}
  | Atom p r => {| facts := facts st ++ [(p, r)]; choices := choices st; shut := shut st; integers := integers st |}
  | Or l => {| facts := facts st; choices := choices st ++ [l]; shut := shut st; integers := integers st |}
  | And l => {| facts := facts st; choices := choices st ++ [[And l]]; shut := shut st; integers := integers st |}
  end.
Definition assume (f : formula) (st : state) : state := match f with And l => fold_left assume_part l st | _ => assume_part st f end.

Lemma assume_part_point a st f : point st a -> holds a f -> point (assume_part st f) a.
Proof.
  intros (open & meet & some & integer) true_. destruct f as [[]|p r|l|l]; [|discriminate| | |]; repeat split; cbn; trivial.
  - now rewrite open.
  - apply Forall_app. split; [exact meet|]. now repeat constructor.
  - apply Forall_app. split; [exact some|]. now repeat constructor.
  - apply Forall_app. split; [exact some|]. constructor; [now apply holds_or|constructor].
Qed.

Lemma assume_point a st f : point st a -> holds a f -> point (assume f st) a.
Proof.
  intros here true_. destruct f as [b|p r|l|l]; try now apply assume_part_point. apply holds_and in true_. cbn.
  revert st here. induction true_ as [|f l first _ IH]; intros st here; [exact here|]. cbn. now apply IH, assume_part_point.
Qed.

Definition uses_state (allowed : nat -> bool) (st : state) : bool :=
  forallb (fun f => only allowed (fst f)) (facts st) && forallb (forallb (uses allowed)) (choices st) && forallb allowed (integers st).

Lemma uses_state_point allowed (a b : assignment) st : uses_state allowed st = true -> (forall i, allowed i = true -> a i = b i) -> point st a -> point st b.
Proof.
  unfold uses_state. intros good same (open & meet & some & integer).
  apply andb_prop in good. destruct good as [good third]. apply andb_prop in good. destruct good as [first second].
  rewrite forallb_forall in first, second, third. rewrite Forall_forall in meet, some. split; [exact open|]. repeat split.
  - apply Forall_forall. intros f inside. specialize (meet f inside). unfold true_at in *.
    now rewrite <- (eval_only allowed (fst f) a b (first f inside) same).
  - apply Forall_forall. intros l inside. specialize (some l inside). specialize (second l inside). rewrite forallb_forall in second.
    rewrite Exists_exists in *. destruct some as (f & there & true_). exists f. split; [exact there|].
    exact (proj1 (uses_holds allowed a b f (second f there) same) true_).
  - intros i inside. rewrite <- (same i (third i inside)). now apply integer.
Qed.

(* ---------------------------------------------------------------- a combination with positive coefficients *)

Definition signed (r : relation) (e : nat) : bool :=
  (0 <? e)%nat && match r with Zero => false | Nonzero => Nat.even e | _ => true end.
Definition strict (r : relation) : bool := match r with Positive | Nonzero => true | _ => false end.

(* (a product of powers of facts, whether all of them are strict) *)
Fixpoint product_of_facts (fs : list fact) (factors : list (nat * nat)) : option (poly * bool) :=
  match factors with
  | [] => Some (number 1, true)
  | (i, e) :: rest =>
    match nth_error fs i, product_of_facts fs rest with
    | Some (p, r), Some (q, all) => if signed r e then Some (mul (power p e) q, strict r && all) else None
    | _, _ => None
    end
  end.

Lemma power_sign r e x : signed r e = true -> meets r x -> 0 <= x ^ e /\ (strict r = true -> 0 < x ^ e).
Proof.
  unfold signed. intros good sign. apply andb_prop in good. destruct good as [some good].
  destruct r; cbn in *; try discriminate; (split; [|try discriminate; intros _]).
  - apply pow_le. lra.
  - now apply pow_lt.
  - now apply pow_le.
  - apply Nat.even_spec in good. destruct good as [k ->]. rewrite pow_mult. apply pow_le. nra.
  - apply Nat.even_spec in good. destruct good as [k ->]. rewrite pow_mult. apply pow_lt. nra.
Qed.

Lemma fact_true a fs i p r : Forall (true_at a) fs -> nth_error fs i = Some (p, r) -> meets r (eval p a).
Proof. intros each found. rewrite Forall_forall in each. exact (each _ (nth_error_In _ _ found)). Qed.

Lemma product_sign a fs : Forall (true_at a) fs -> forall factors q all, product_of_facts fs factors = Some (q, all) ->
  0 <= eval q a /\ (all = true -> 0 < eval q a).
Proof.
  intros each. induction factors as [|[i e] factors IH]; cbn [product_of_facts]; intros q all found.
  - injection found as <- <-. rewrite eval_number, Q2R_1. split; [lra|intros; lra].
  - destruct (nth_error fs i) as [[p r]|] eqn:fact_; [|discriminate]. destruct (product_of_facts fs factors) as [[q' all']|]; [|discriminate].
    destruct (signed r e) eqn:good; [|discriminate]. injection found as <- <-. destruct (IH q' all' eq_refl) as [weak strong].
    destruct (power_sign r e (eval p a) good (fact_true a fs i p r each fact_)) as [weak' strong'].
    rewrite eval_mul, eval_power. split; [now apply Rmult_le_pos|]. intro both. apply andb_prop in both. destruct both.
    apply Rmult_lt_0_compat; auto.
Qed.

Definition nonzero_constant (p : poly) : bool := match constant p with Some c => negb (Qeq_bool c 0) | None => false end.

(* The sum of c * product of facts * root^2, and whether one term of it is > 0. *)
Fixpoint sum_of_products (fs : list fact) (products : list (Q * list (nat * nat) * poly)) : option (poly * bool) :=
  match products with
  | [] => Some ([], false)
  | (c, factors, root) :: rest =>
    match product_of_facts fs factors, sum_of_products fs rest with
    | Some (q, all), Some (s, some) =>
      if decide Positive c then Some (add (scale c (mul q (mul root root))) s, (all && nonzero_constant root) || some) else None
    | _, _ => None
    end
  end.

Fixpoint sum_of_equations (fs : list fact) (equations : list (nat * poly)) : option poly :=
  match equations with
  | [] => Some []
  | (j, m) :: rest =>
    match nth_error fs j, sum_of_equations fs rest with Some (p, Zero), Some s => Some (add (mul p m) s) | _, _ => None end
  end.

Lemma sum_sign a fs : Forall (true_at a) fs -> forall products s some, sum_of_products fs products = Some (s, some) ->
  0 <= eval s a /\ (some = true -> 0 < eval s a).
Proof.
  intros each. induction products as [|[[c factors] root] products IH]; cbn [sum_of_products]; intros s some found.
  - injection found as <- <-. cbn. split; [lra|discriminate].
  - destruct (product_of_facts fs factors) as [[q all]|] eqn:of_facts; [|discriminate].
    destruct (sum_of_products fs products) as [[s' some']|]; [|discriminate].
    destruct (decide Positive c) eqn:positive; [|discriminate]. injection found as <- <-. apply decide_holds in positive. cbn in positive.
    destruct (product_sign a fs each factors q all of_facts) as [weak strong]. destruct (IH s' some' eq_refl) as [weak' strong'].
    rewrite eval_add, eval_scale, !eval_mul. set (x := eval q a) in *. set (y := eval root a).
    assert (square : 0 <= y * y) by nra. assert (0 <= Q2R c * (x * (y * y))) by (apply Rmult_le_pos; [lra|now apply Rmult_le_pos]).
    split; [lra|]. intro one. apply orb_prop in one. destruct one as [one|one]; [|specialize (strong' one); lra].
    apply andb_prop in one. destruct one as [one root_]. specialize (strong one).
    assert (0 < y * y).
    { unfold nonzero_constant in root_. destruct (constant root) as [d|] eqn:found; [|discriminate]. apply negb_true_iff in root_.
      apply (Rsqr_pos_lt y). unfold y. rewrite (constant_value root d a found). intro zero. rewrite <- Q2R_0 in zero.
      apply Qeq_bool_R in zero. congruence. }
    assert (0 < Q2R c * (x * (y * y))) by (apply Rmult_lt_0_compat; [|apply Rmult_lt_0_compat]; assumption). lra.
Qed.

Lemma sum_zero a fs : Forall (true_at a) fs -> forall equations s, sum_of_equations fs equations = Some s -> eval s a = 0.
Proof.
  intros each. induction equations as [|[j m] equations IH]; cbn [sum_of_equations]; intros s found; [now injection found as <-|].
  destruct (nth_error fs j) as [[p []]|] eqn:fact_; try discriminate. destruct (sum_of_equations fs equations) as [s'|]; [|discriminate].
  injection found as <-. pose proof (fact_true a fs j p Zero each fact_) as zero. cbn in zero. rewrite eval_add, eval_mul, zero, (IH s' eq_refl). lra.
Qed.

Definition psatz (fs : list fact) (products : list (Q * list (nat * nat) * poly)) (equations : list (nat * poly)) : bool :=
  match sum_of_products fs products, sum_of_equations fs equations with
  | Some (s, some), Some t => some && is_zero (add s t)
  | _, _ => false
  end.

Lemma psatz_sound a fs products equations : psatz fs products equations = true -> ~ Forall (true_at a) fs.
Proof.
  unfold psatz. intros good each. destruct (sum_of_products fs products) as [[s some]|] eqn:first; [|discriminate].
  destruct (sum_of_equations fs equations) as [t|] eqn:second; [|discriminate]. apply andb_prop in good. destruct good as [one zero].
  apply is_zero_holds with (a := a) in zero. rewrite eval_add, (sum_zero a fs each equations t second) in zero.
  pose proof (proj2 (sum_sign a fs each products s some first) one). lra.
Qed.
