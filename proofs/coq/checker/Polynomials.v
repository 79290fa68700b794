(* Polynomials in any number of variables with rational coefficients, as the checker of certificates has them: finite sums of
   coefficients times monomials, the variables numbered.  What is computed from them is what their values are.

   Defined:  eval, add, mul, power, number, variable, constant, is_zero, only (which variables occur), integral (integer
             coefficients in integer variables), put (another value for one variable).
   Proved:   eval of each; constant_value; is_zero_holds; eval_only; integral_value; eval_continuous. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool.
Import ListNotations.
Open Scope R_scope.

Definition assignment := nat -> R.
Definition monomial := list nat. (* the exponents of the variables 0, 1, .. *)
Definition poly := list (Q * monomial).

Fixpoint product (m : monomial) (a : assignment) : R :=
  match m with [] => 1 | e :: rest => a 0%nat ^ e * product rest (fun i => a (S i)) end.

Fixpoint eval (p : poly) (a : assignment) : R :=
  match p with [] => 0 | (c, m) :: rest => Q2R c * product m a + eval rest a end.

Lemma Q2R_0 : Q2R 0 = 0.
Proof. unfold Q2R. cbn. lra. Qed.

Lemma Q2R_1 : Q2R 1 = 1.
Proof. unfold Q2R. cbn. lra. Qed.

Lemma Q2R_red c : Q2R (Qred c) = Q2R c.
Proof. apply Qeq_eqR, Qred_correct. Qed.

(* ---------------------------------------------------------------- sums and products *)

Fixpoint same_monomial (m k : monomial) : bool :=
  match m, k with [], [] => true | e :: m, d :: k => (e =? d)%nat && same_monomial m k | _, _ => false end.

Lemma same_monomial_holds m : forall k, same_monomial m k = true -> m = k.
Proof.
  induction m as [|e m IH]; intros [|d k]; cbn; try easy. intro same. apply andb_prop in same. destruct same as [first rest].
  apply Nat.eqb_eq in first. now rewrite first, (IH k rest).
Qed.

Fixpoint add_term (c : Q) (m : monomial) (p : poly) : poly :=
  match p with
  | [] => [(c, m)]
  | (d, k) :: rest =>
    if same_monomial m k then let sum := Qred (c + d) in if Qeq_bool sum 0 then rest else (sum, k) :: rest
    else (d, k) :: add_term c m rest
  end.

Lemma eval_add_term c m p a : eval (add_term c m p) a = Q2R c * product m a + eval p a.
Proof.
  induction p as [|[d k] p IH]; [reflexivity|]. cbn [add_term eval]. destruct (same_monomial m k) eqn:same.
  - apply same_monomial_holds in same as ->. assert (sum : Q2R (Qred (c + d)) = Q2R c + Q2R d) by now rewrite Q2R_red, Q2R_plus.
    cbv zeta. destruct (Qeq_bool (Qred (c + d)) 0) eqn:zero; cbn [eval]; [|rewrite sum; lra].
    apply Qeq_bool_eq, Qeq_eqR in zero. rewrite sum, Q2R_0 in zero.
    replace (Q2R c) with (- Q2R d) by lra. lra.
  - cbn [eval]. rewrite IH. lra.
Qed.

Fixpoint add (p q : poly) : poly := match p with [] => q | (c, m) :: rest => add_term c m (add rest q) end.

Lemma eval_add p q a : eval (add p q) a = eval p a + eval q a.
Proof. induction p as [|[c m] p IH]; cbn [add eval]; [lra|]. rewrite eval_add_term, IH. lra. Qed.

Fixpoint together (m k : monomial) : monomial :=
  match m, k with [], k => k | m, [] => m | e :: m, d :: k => (e + d)%nat :: together m k end.

Lemma product_together m : forall k a, product (together m k) a = product m a * product k a.
Proof.
  induction m as [|e m IH]; intros [|d k] a; cbn; try lra. rewrite IH, pow_add. lra.
Qed.

Fixpoint times (c : Q) (m : monomial) (p : poly) : poly :=
  match p with [] => [] | (d, k) :: rest => (Qred (c * d), together m k) :: times c m rest end.

Lemma eval_times c m p a : eval (times c m p) a = Q2R c * product m a * eval p a.
Proof. induction p as [|[d k] p IH]; cbn [times eval]; [lra|]. rewrite Q2R_red, Q2R_mult, product_together, IH. lra. Qed.

Fixpoint mul (p q : poly) : poly := match p with [] => [] | (c, m) :: rest => add (times c m q) (mul rest q) end.

Lemma eval_mul p q a : eval (mul p q) a = eval p a * eval q a.
Proof. induction p as [|[c m] p IH]; cbn [mul eval]; [lra|]. rewrite eval_add, eval_times, IH. lra. Qed.

Definition number (c : Q) : poly := [(c, [])].
Definition variable (i : nat) : poly := [(1%Q, repeat 0%nat i ++ [1%nat])].
Definition scale (c : Q) (p : poly) : poly := times c [] p.
Definition opposite (p : poly) : poly := scale (-1) p.
Definition minus (p q : poly) : poly := add p (opposite q).

Lemma eval_number c a : eval (number c) a = Q2R c.
Proof. cbn. lra. Qed.

Lemma eval_variable i : forall a, eval (variable i) a = a i.
Proof.
  cbn. rewrite Q2R_1. enough (unit : forall a, product (repeat 0%nat i ++ [1%nat]) a = a i) by (intro a; rewrite unit; lra).
  induction i as [|i IH]; intro a; cbn; [lra|]. rewrite IH. lra.
Qed.

Lemma eval_scale c p a : eval (scale c p) a = Q2R c * eval p a.
Proof. unfold scale. rewrite eval_times. cbn. lra. Qed.

Lemma eval_opposite p a : eval (opposite p) a = - eval p a.
Proof. unfold opposite. rewrite eval_scale. replace (Q2R (-1)) with (-1) by (unfold Q2R; cbn; lra). lra. Qed.

Lemma eval_minus p q a : eval (minus p q) a = eval p a - eval q a.
Proof. unfold minus. rewrite eval_add, eval_opposite. lra. Qed.

Fixpoint power (p : poly) (n : nat) : poly := match n with O => number 1 | S O => p | S k => mul p (power p k) end.

Lemma eval_power p n a : eval (power p n) a = eval p a ^ n.
Proof.
  induction n as [|[|n] IH]; [change (eval (number 1) a = 1); now rewrite eval_number, Q2R_1|cbn; lra|].
  change (eval (mul p (power p (S n))) a = eval p a * eval p a ^ S n). now rewrite eval_mul, IH.
Qed.

(* ---------------------------------------------------------------- what is seen from the coefficients *)

Definition is_zero (p : poly) : bool := forallb (fun t => Qeq_bool (fst t) 0) p.

Lemma is_zero_holds p a : is_zero p = true -> eval p a = 0.
Proof.
  induction p as [|[c m] p IH]; cbn; [reflexivity|]. intro zero. apply andb_prop in zero. destruct zero as [first rest].
  apply Qeq_bool_eq, Qeq_eqR in first. rewrite Q2R_0 in first. rewrite first, (IH rest). lra.
Qed.

(* The value of a polynomial without variables. *)
Fixpoint constant (p : poly) : option Q :=
  match p with
  | [] => Some 0%Q
  | (c, m) :: rest => if forallb (Nat.eqb 0) m then option_map (fun d => Qred (c + d)) (constant rest) else None
  end.

Lemma product_trivial m : forall a, forallb (Nat.eqb 0) m = true -> product m a = 1.
Proof. induction m as [|[|e] m IH]; intros a trivial; [reflexivity| |discriminate trivial]. cbn in *. rewrite IH by exact trivial. lra. Qed.

Lemma constant_value p : forall c a, constant p = Some c -> eval p a = Q2R c.
Proof.
  induction p as [|[d m] p IH]; cbn [constant eval]; intros c a found; [injection found as <-; now rewrite Q2R_0|].
  destruct (forallb (Nat.eqb 0) m) eqn:trivial; [|discriminate found]. destruct (constant p) as [e|]; [|discriminate found].
  assert (sum : c = Qred (d + e)) by (cbn [option_map] in found; congruence).
  rewrite sum, Q2R_red, Q2R_plus, (IH e a eq_refl), (product_trivial m a trivial). lra.
Qed.

(* Every variable that occurs is allowed. *)
Fixpoint only_monomial (allowed : nat -> bool) (m : monomial) : bool :=
  match m with [] => true | e :: rest => ((e =? 0)%nat || allowed 0%nat) && only_monomial (fun i => allowed (S i)) rest end.
Definition only (allowed : nat -> bool) (p : poly) : bool := forallb (fun t => only_monomial allowed (snd t)) p.

Lemma product_only m : forall allowed (a b : assignment), only_monomial allowed m = true ->
  (forall i, allowed i = true -> a i = b i) -> product m a = product m b.
Proof.
  induction m as [|e m IH]; intros allowed a b good same; cbn in *; [reflexivity|]. apply andb_prop in good. destruct good as [first rest].
  rewrite (IH _ (fun i => a (S i)) (fun i => b (S i)) rest (fun i => same (S i))). destruct e as [|e]; [reflexivity|].
  now rewrite (same 0%nat first).
Qed.

Lemma eval_only allowed p (a b : assignment) : only allowed p = true -> (forall i, allowed i = true -> a i = b i) -> eval p a = eval p b.
Proof.
  intros good same. induction p as [|[c m] p IH]; [reflexivity|]. cbn in *. apply andb_prop in good. destruct good as [first rest].
  now rewrite (IH rest), (product_only m allowed a b first same).
Qed.

Definition member (l : list nat) (i : nat) : bool := existsb (Nat.eqb i) l.

Lemma member_holds l i : member l i = true <-> In i l.
Proof.
  unfold member. rewrite existsb_exists. split; [intros (k & inside & same); apply Nat.eqb_eq in same; now subst|].
  intro inside. exists i. now rewrite Nat.eqb_refl.
Qed.

Definition whole (x : R) : Prop := exists z, x = IZR z.

Lemma whole_add x y : whole x -> whole y -> whole (x + y).
Proof. intros [z ->] [w ->]. exists (z + w)%Z. now rewrite plus_IZR. Qed.

Lemma whole_mul x y : whole x -> whole y -> whole (x * y).
Proof. intros [z ->] [w ->]. exists (z * w)%Z. now rewrite mult_IZR. Qed.

(* Every coefficient is an integer, and every variable that occurs is one of the integers named. *)
Definition integral (integers : list nat) (p : poly) : bool :=
  only (member integers) p && forallb (fun t => Pos.eqb (Qden (Qred (fst t))) 1) p.

Lemma integral_product m : forall allowed (a : assignment), only_monomial allowed m = true ->
  (forall i, allowed i = true -> whole (a i)) -> whole (product m a).
Proof.
  induction m as [|e m IH]; intros allowed a good integer; cbn in *; [now exists 1%Z|]. apply andb_prop in good. destruct good as [first rest].
  apply whole_mul; [|exact (IH _ _ rest (fun i => integer (S i)))]. destruct e as [|e]; [now exists 1%Z|]. specialize (integer 0%nat first). clear first.
  induction (S e) as [|n power]; cbn; [now exists 1%Z|]. apply whole_mul; [exact integer|exact power].
Qed.

Lemma integral_value integers (a : assignment) p : (forall i, In i integers -> whole (a i)) -> integral integers p = true -> whole (eval p a).
Proof.
  unfold integral, only. intros integer good. apply andb_prop in good. destruct good as [variables coefficients].
  induction p as [|[c m] p IH]; [now exists 0%Z|]. cbn [eval forallb fst snd] in *.
  apply andb_prop in variables, coefficients. destruct variables as [allowed variables]. destruct coefficients as [unit coefficients].
  apply whole_add; [|now apply IH]. apply whole_mul.
  - exists (Qnum (Qred c)). rewrite <- Q2R_red. unfold Q2R. apply Pos.eqb_eq in unit. rewrite unit, Rinv_1. lra.
  - apply (integral_product m (member integers) a allowed). intros i inside. now apply integer, member_holds.
Qed.

(* ---------------------------------------------------------------- values along one variable *)

Definition put (v : nat) (x : R) (a : assignment) : assignment := fun i => if (i =? v)%nat then x else a i.

Lemma put_same v x a : put v x a v = x.
Proof. unfold put. now rewrite Nat.eqb_refl. Qed.

Lemma put_other v x a i : i <> v -> put v x a i = a i.
Proof. intro other. unfold put. apply Nat.eqb_neq in other. now rewrite other. Qed.

Lemma product_continuous m : forall f : nat -> R -> R, (forall i, continuity (f i)) -> continuity (fun x => product m (fun i => f i x)).
Proof.
  induction m as [|e m IH]; intros f each; cbn.
  - apply continuity_const. now intros x y.
  - apply (continuity_mult (fun x => f 0%nat x ^ e) (fun x => product m (fun i => f (S i) x))).
    + induction e as [|e power]; cbn; [apply continuity_const; now intros x y|].
      apply (continuity_mult (f 0%nat) (fun x => f 0%nat x ^ e)); [apply each|exact power].
    + apply (IH (fun i => f (S i))). intro i. apply each.
Qed.

Lemma eval_continuous p v a : continuity (fun x => eval p (put v x a)).
Proof.
  induction p as [|[c m] p IH]; cbn; [apply continuity_const; now intros x y|].
  apply (continuity_plus (fun x => Q2R c * product m (put v x a)) (fun x => eval p (put v x a))); [|exact IH].
  apply (continuity_scal (fun x => product m (put v x a))). apply (product_continuous m (fun i x => put v x a i)).
  intro i. unfold put. destruct (i =? v)%nat; [apply derivable_continuous, derivable_id|apply continuity_const; now intros x y].
Qed.
