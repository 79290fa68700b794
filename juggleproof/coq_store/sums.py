"""Sums of products that are 0, though each product is positive or not negative, by computation."""

# A polynomial as a term whose coefficients Coq computes, and its value at a list of reals.
SUMS = """\
Notation expression := (Ring_polynom.PExpr Z).
Notation num n := (Ring_polynom.PEc n%Z).
Notation var n := (Ring_polynom.PEX Z n%positive).
Declare Scope expression_scope.
Delimit Scope expression_scope with expression.
Bind Scope expression_scope with Ring_polynom.PExpr.
Infix "+" := Ring_polynom.PEadd : expression_scope.
Infix "-" := Ring_polynom.PEsub : expression_scope.
Infix "*" := Ring_polynom.PEmul : expression_scope.
Notation "- p" := (Ring_polynom.PEopp p) : expression_scope.
Notation "p ^ n" := (Ring_polynom.PEpow p n%N) : expression_scope.

Definition value (l : list R) : expression -> R :=
  Ring_polynom.PEeval 0 1 Rplus Rmult Rminus Ropp IZR N.to_nat pow l.
Definition normal (p : expression) : Ring_polynom.Pol Z :=
  Ring_polynom.norm_aux 0%Z 1%Z Z.add Z.mul Z.sub Z.opp Z.eqb p.
Lemma integers_in_reals : Ring_theory.ring_morph 0 1 Rplus Rmult Rminus Ropp eq
  0%Z 1%Z Z.add Z.mul Z.sub Z.opp Z.eqb IZR.
Proof.
  constructor; try reflexivity; intros.
  - apply plus_IZR.
  - apply minus_IZR.
  - apply mult_IZR.
  - apply opp_IZR.
  - f_equal. now apply Z.eqb_eq.
Qed.
Lemma vanishes l p : Ring_polynom.Peq Z.eqb (normal p) (normal (num 0)) = true -> value l p = 0.
Proof.
  exact (Ring_polynom.ring_correct RealField.Rset RealField.Rext
    (Ring_theory.Rth_ARth RealField.Rset RealField.Rext (Field_theory.F_R RealField.Rfield))
    integers_in_reals RealField.R_power_theory
    (InitialRing.Ztriv_div_th RealField.Rset IZR) 0 l nil p (num 0) I).
Qed.

Definition holds l (fact : bool * expression) : Prop :=
  if fst fact then 0 < value l (snd fact) else 0 <= value l (snd fact).
Fixpoint all_hold l facts : Prop :=
  match facts with nil => True | fact :: more => holds l fact /\\ all_hold l more end.
Fixpoint all_vanish l equations : Prop :=
  match equations with nil => True | p :: more => value l p = 0 /\\ all_vanish l more end.

Definition fact_at (facts : list (bool * expression)) k := nth k facts (false, num 0).
Fixpoint product (facts : list (bool * expression)) (factors : list (nat * positive)) :
  expression :=
  match factors with
  | nil => num 1
  | (k, n) :: more => product facts more * snd (fact_at facts k) ^ Npos n
  end%expression.
Definition strict facts (factors : list (nat * positive)) : bool :=
  forallb (fun factor => fst (fact_at facts (fst factor))) factors.

Lemma fact_holds l facts k : all_hold l facts -> holds l (fact_at facts k).
Proof.
  revert k. induction facts as [|fact more IH]; intros [|k]; cbn; try (intros; apply Rle_refl).
  { tauto. }
  intros [_ rest]. now apply IH.
Qed.
Lemma product_sign l facts factors : all_hold l facts ->
  if strict facts factors then 0 < value l (product facts factors)
  else 0 <= value l (product facts factors).
Proof.
  intro hold. induction factors as [|[k n] more IH]; cbn; [lra|].
  pose proof (fact_holds l facts k hold) as own.
  unfold holds in own. destruct (fst (fact_at facts k)); cbn; fold (strict facts more).
  - pose proof (pow_lt _ (Pos.to_nat n) own).
    destruct (strict facts more); [now apply Rmult_lt_0_compat|].
    apply Rmult_le_pos; [exact IH|lra].
  - assert (0 <= value l (product facts more)) by (destruct (strict facts more); lra).
    apply Rmult_le_pos; [assumption|]. now apply pow_le.
Qed.

(* The weights of products, the factors of each, and the squares that it is multiplied by. *)
Definition summand := (positive * list (nat * positive) * option expression)%type.
Definition summand_value facts (s : summand) : expression :=
  let '(w, factors, root) := s in
  match root with
  | None => num (Zpos w) * product facts factors
  | Some p => num (Zpos w) * product facts factors * p ^ 2
  end%expression.
Definition summand_strict facts (s : summand) : bool :=
  let '(_, factors, root) := s in
  match root with None => strict facts factors | Some _ => false end.
Lemma summand_sign l facts s : all_hold l facts ->
  if summand_strict facts s then 0 < value l (summand_value facts s)
  else 0 <= value l (summand_value facts s).
Proof.
  intro hold. destruct s as [[w factors] [p|]]; cbn;
    pose proof (product_sign l facts factors hold) as sign;
    assert (0 < IZR (Zpos w)) by (now apply IZR_lt).
  - assert (0 <= value l (product facts factors)) by (destruct (strict facts factors); lra).
    apply Rmult_le_pos; [apply Rmult_le_pos; [lra|assumption]|]. apply pow2_ge_0.
  - destruct (strict facts factors); [now apply Rmult_lt_0_compat|].
    apply Rmult_le_pos; [lra|assumption].
Qed.
Fixpoint sum facts (summands : list summand) : expression :=
  match summands with
  | nil => num 0
  | s :: more => summand_value facts s + sum facts more
  end%expression.
Lemma sum_sign l facts summands : all_hold l facts ->
  if existsb (summand_strict facts) summands then 0 < value l (sum facts summands)
  else 0 <= value l (sum facts summands).
Proof.
  intro hold. induction summands as [|s more IH]; cbn; [lra|].
  pose proof (summand_sign l facts s hold) as own.
  destruct (summand_strict facts s), (existsb (summand_strict facts) more); cbn;
    unfold value in *; lra.
Qed.
Lemma sum_not_negative l facts summands a p : all_hold l facts ->
  Ring_polynom.Peq Z.eqb (normal (sum facts summands - num (Zpos a) * p)) (normal (num 0)) = true ->
  0 <= value l p.
Proof.
  intros hold same. apply (vanishes l) in same. pose proof (sum_sign l facts summands hold) as sign.
  assert (0 <= value l (sum facts summands)) by (destruct (existsb _ _); lra).
  assert (0 < IZR (Zpos a)) by (now apply IZR_lt). apply (Rmult_le_reg_l (IZR (Zpos a))); trivial.
  unfold value in *. cbn in same. lra.
Qed.
Fixpoint multiples (cofactors equations : list expression) : expression :=
  match cofactors, equations with
  | c :: others, p :: more => c * p + multiples others more
  | _, _ => num 0
  end%expression.
Lemma multiples_vanish l cofactors : forall equations, all_vanish l equations ->
  value l (multiples cofactors equations) = 0.
Proof.
  induction cofactors as [|c others IH]; intros [|p more]; try reflexivity. cbn. intros [own rest].
  unfold value in *. rewrite own, IH by exact rest. ring.
Qed.

Theorem no_common_point l facts equations summands cofactors :
  all_hold l facts -> all_vanish l equations ->
  (existsb (summand_strict facts) summands && Ring_polynom.Peq Z.eqb
    (normal (sum facts summands + multiples cofactors equations)) (normal (num 0)))%bool = true ->
  False.
Proof.
  intros hold zero checked. apply andb_prop in checked. destruct checked as [some same].
  apply (vanishes l) in same.
  pose proof (sum_sign l facts summands hold) as sign. rewrite some in sign.
  pose proof (multiples_vanish l cofactors equations zero). unfold value in *. cbn in same. lra.
Qed.
"""
