(* Bernstein coefficients: what the rule of boxes concludes, and that of one root, for any polynomial.

   Defined:  mixed (a form of degree n in u, v from its Bernstein coefficients, by de Casteljau's recursion); mean, its value at
             (1 - t, t); tensor, the same along several axes, by nested means.
   Proved:   mean_below         a mean of coefficients less than c is less than c, and so for "at most";
             mean_multiplied    the coefficients of a product with a line; so those of any power (Coefficients.v);
             mean_lower, mean_upper   the coefficients on a part of the interval are means themselves;
             mean_at_end        where the coefficients grow, the mean is at most the last;
             one_root           one change of sign of the coefficients: exactly one root inside;
             tensor_below, tensor_front  along several axes, in any order. *)

From Coq Require Import Reals Lra Lia List.
Import ListNotations.
Open Scope R_scope.

Fixpoint mixed (n : nat) (c : nat -> R) (u v : R) : R :=
  match n with O => c O | S m => mixed m (fun j => u * c j + v * c (S j)) u v end.

Definition mean (n : nat) (c : nat -> R) (t : R) : R := mixed n c (1 - t) t.

Lemma mixed_ext n u v : forall c d, (forall j, (j <= n)%nat -> c j = d j) -> mixed n c u v = mixed n d u v.
Proof.
  induction n as [|n IH]; intros c d same; cbn; [apply same; lia|]. apply IH. intros j less. now rewrite !same by lia.
Qed.

Lemma mixed_linear n u v : forall x y c d, mixed n (fun j => x * c j + y * d j) u v = x * mixed n c u v + y * mixed n d u v.
Proof.
  induction n as [|n IH]; intros x y c d; cbn; [reflexivity|]. rewrite <- IH. apply mixed_ext. intros j _. ring.
Qed.

Lemma mixed_multiple n x c u v : mixed n (fun j => x * c j) u v = x * mixed n c u v.
Proof. pose proof (mixed_linear n u v x 0 c c) as linear. rewrite Rmult_0_l, Rplus_0_r in linear. rewrite <- linear. apply mixed_ext. intros j _. ring. Qed.

Lemma mixed_nonnegative n u v : 0 <= u -> 0 <= v -> forall c, (forall j, (j <= n)%nat -> 0 <= c j) -> 0 <= mixed n c u v.
Proof.
  intros u_positive v_positive. induction n as [|n IH]; intros c signs; cbn; [apply signs; lia|]. apply IH. intros j less.
  apply Rplus_le_le_0_compat; apply Rmult_le_pos; try assumption; apply signs; lia.
Qed.

Lemma mixed_positive n u v : 0 < u -> 0 <= v -> forall c, 0 < c O -> (forall j, (j <= n)%nat -> 0 <= c j) -> 0 < mixed n c u v.
Proof.
  intros u_positive v_positive. induction n as [|n IH]; intros c first signs; cbn; [exact first|]. apply IH.
  - apply Rplus_lt_le_0_compat; [now apply Rmult_lt_0_compat|]. apply Rmult_le_pos; [exact v_positive|apply signs; lia].
  - intros j less. apply Rplus_le_le_0_compat; apply Rmult_le_pos; try lra; apply signs; lia.
Qed.

Lemma mean_ext n c d t : (forall j, (j <= n)%nat -> c j = d j) -> mean n c t = mean n d t.
Proof. apply mixed_ext. Qed.

Lemma mean_linear n x y c d t : mean n (fun j => x * c j + y * d j) t = x * mean n c t + y * mean n d t.
Proof. apply mixed_linear. Qed.

Lemma mean_multiple n x c t : mean n (fun j => x * c j) t = x * mean n c t.
Proof. apply mixed_multiple. Qed.

Lemma mean_constant n x t : mean n (fun _ => x) t = x.
Proof.
  unfold mean. induction n as [|n IH]; cbn [mixed]; [reflexivity|]. transitivity (mixed n (fun _ => x) (1 - t) t); [|exact IH].
  apply mixed_ext. intros j _. ring.
Qed.

Lemma mean_monotone n c d t : 0 <= t <= 1 -> (forall j, (j <= n)%nat -> c j <= d j) -> mean n c t <= mean n d t.
Proof.
  intros between order. enough (0 <= mean n (fun j => 1 * d j + (-1) * c j) t) as positive by (rewrite mean_linear in positive; lra).
  apply mixed_nonnegative; try lra. intros j less. specialize (order j less). lra.
Qed.

Lemma mean_at_most n c t x : 0 <= t <= 1 -> (forall j, (j <= n)%nat -> c j <= x) -> mean n c t <= x.
Proof. intros between each. rewrite <- (mean_constant n x t). now apply mean_monotone. Qed.

Lemma mean_below n t x : 0 <= t <= 1 -> forall c, (forall j, (j <= n)%nat -> c j < x) -> mean n c t < x.
Proof.
  intros between. unfold mean. induction n as [|n IH]; intros c each; cbn; [apply each; lia|]. apply IH. intros j less.
  pose proof (each j ltac:(lia)). pose proof (each (S j) ltac:(lia)). destruct (Req_dec t 0) as [->|other]; [lra|].
  assert (0 < t * (x - c (S j))) by (apply Rmult_lt_0_compat; lra). assert (0 <= (1 - t) * (x - c j)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma mean_at_end n c t : 0 <= t <= 1 -> (forall j, (j < n)%nat -> c j <= c (S j)) -> mean n c t <= c n.
Proof.
  intros between steps. apply mean_at_most; [exact between|]. intros j less.
  replace j with (n - (n - j))%nat by lia. generalize (n - j)%nat as k. intro k. induction k as [|k IH].
  - rewrite Nat.sub_0_r. lra.
  - destruct (Nat.lt_ge_cases k n) as [inside|outside].
    + apply Rle_trans with (2 := IH). replace (n - k)%nat with (S (n - S k)) by lia. apply steps. lia.
    + replace (n - S k)%nat with (n - k)%nat by lia. exact IH.
Qed.

(* ---------------------------------------------------------------- products with a line, parts of an interval *)

Definition multiplied (n : nat) (a b : R) (c : nat -> R) (j : nat) : R :=
  ((INR (S n) - INR j) * a * c j + INR j * b * c (pred j)) / INR (S n).

Lemma mean_multiplied n a b t : forall c, mean (S n) (multiplied n a b c) t = ((1 - t) * a + t * b) * mean n c t.
Proof.
  unfold mean. induction n as [|n IH]; intro c.
  - unfold multiplied. cbn. field.
  - set (line := (1 - t) * a + t * b) in *. set (step := fun j => (1 - t) * c j + t * c (S j)).
    change (mixed (S n) (fun j => (1 - t) * multiplied (S n) a b c j + t * multiplied (S n) a b c (S j)) (1 - t) t = line * mixed n step (1 - t) t).
    assert (positive : 0 < INR (S n)) by (apply lt_0_INR; lia).
    rewrite (mixed_ext _ _ _ _ (fun j => (INR (S n) / INR (S (S n))) * multiplied n a b step j + (line / INR (S (S n))) * c j)).
    + rewrite mixed_linear, (IH step). change (mixed (S n) c (1 - t) t) with (mixed n step (1 - t) t).
      rewrite (S_INR (S n)). field. lra.
    + intros j _. unfold multiplied, step, line. rewrite (S_INR (S n)). destruct j as [|j].
      * change (INR 1) with 1. change (INR 0) with 0. cbn [pred]. field. lra.
      * rewrite !(S_INR (S j)). cbn [pred]. field. lra.
Qed.

Lemma mean_lower n s t : forall c, mean n (fun k => mean k c s) t = mean n c (s * t).
Proof.
  unfold mean. induction n as [|n IH]; intro c; cbn [mixed]; [reflexivity|].
  rewrite <- (IH (fun j => (1 - s * t) * c j + s * t * c (S j))). apply mixed_ext. intros k _. cbn [mixed].
  rewrite <- mixed_linear. apply mixed_ext. intros j _. ring.
Qed.

Definition turned (n : nat) (c : nat -> R) (j : nat) : R := c (n - j)%nat.

Lemma mean_turned n t : forall c, mean n (turned n c) (1 - t) = mean n c t.
Proof.
  unfold mean. replace (1 - (1 - t)) with t by ring. induction n as [|n IH]; intro c; [reflexivity|]. cbn [mixed].
  rewrite <- (IH (fun j => (1 - t) * c j + t * c (S j))). apply mixed_ext. intros j less. unfold turned.
  replace (S n - j)%nat with (S (n - j)) by lia. replace (S n - S j)%nat with (n - j)%nat by lia. ring.
Qed.

Lemma mean_upper n c s t : mean n (fun k => mean (n - k) (turned n c) (1 - s)) t = mean n c (s + (1 - s) * t).
Proof.
  rewrite <- (mean_turned n t), <- (mean_turned n (s + (1 - s) * t)).
  replace (1 - (s + (1 - s) * t)) with ((1 - s) * (1 - t)) by ring. rewrite <- mean_lower. apply mean_ext. intros k less.
  unfold turned at 1. now replace (n - (n - k))%nat with k by lia.
Qed.

(* ---------------------------------------------------------------- one change of sign, one root *)

Lemma mixed_scaled n u v r : forall c, mixed n c u (r * v) = mixed n (fun j => r ^ j * c j) u v.
Proof.
  induction n as [|n IH]; intro c; cbn [mixed]; [cbn; ring|]. rewrite IH. apply mixed_ext. intros j _. cbn. ring.
Qed.

Lemma mixed_homogeneous n x u v : forall c, mixed n c (x * u) (x * v) = x ^ n * mixed n c u v.
Proof.
  induction n as [|n IH]; intro c; cbn [mixed pow]; [ring|]. rewrite IH.
  rewrite (mixed_ext n u v _ (fun j => x * (u * c j + v * c (S j)))) by (intros j _; ring). rewrite mixed_multiple. ring.
Qed.

Lemma power_above_1 r k : 1 < r -> (0 < k)%nat -> 1 < r ^ k.
Proof. intros above positive. now apply Rlt_pow_R1. Qed.

Lemma mean_at_0 n c : mean n c 0 = c O.
Proof.
  unfold mean. rewrite Rminus_0_r. revert c. induction n as [|n IH]; intro c; cbn [mixed]; [reflexivity|]. rewrite IH. ring.
Qed.

Lemma mean_at_1 n c : mean n c 1 = c n.
Proof. rewrite <- mean_turned, Rminus_diag_eq by reflexivity. rewrite mean_at_0. unfold turned. now rewrite Nat.sub_0_r. Qed.

Section OneRoot.
  Variables (n k : nat) (c : nat -> R).
  Hypothesis first_negative : c O < 0.
  Hypothesis at_most_0_before : forall j, (j < k)%nat -> c j <= 0.
  Hypothesis at_least_0_after : forall j, (k <= j <= n)%nat -> 0 <= c j.

  (* For t > 0 the form divided by t^k grows strictly, so that it has no second root. *)
  Lemma no_second_root x y : 0 < x < y -> y < 1 -> mean n c x = 0 -> mean n c y <> 0.
  Proof.
    intros order inside root_x root_y. unfold mean in *. set (r := y * (1 - x) / (x * (1 - y))).
    assert (below : 0 < x * (1 - y)) by (apply Rmult_lt_0_compat; lra).
    assert (above : 1 < r).
    { unfold r. apply Rmult_lt_reg_r with (1 := below). unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra. }
    replace (mixed n c (1 - y) y) with (((1 - y) / (1 - x)) ^ n * mixed n (fun j => r ^ j * c j) (1 - x) x) in root_y
      by (rewrite <- mixed_scaled, <- mixed_homogeneous; f_equal; unfold r; field; lra).
    apply Rmult_integral in root_y.
    assert (ratio : 0 < (1 - y) / (1 - x)) by (apply Rdiv_lt_0_compat; lra).
    destruct root_y as [zero|zero]; [pose proof (pow_lt _ n ratio); lra|].
    assert (positive : (0 < k)%nat).
    { destruct (Nat.eq_dec k 0) as [none|some]; [|lia]. pose proof (at_least_0_after O ltac:(lia)). lra. }
    assert (growth : 0 < mixed n (fun j => 1 * (r ^ j * c j) + - r ^ k * c j) (1 - x) x).
    { apply mixed_positive; try lra.
      - pose proof (power_above_1 r k above positive). cbn [pow]. nra.
      - intros j less. replace (1 * (r ^ j * c j) + - r ^ k * c j) with ((r ^ j - r ^ k) * c j) by ring.
        destruct (Nat.lt_ge_cases j k) as [before|after].
        + pose proof (at_most_0_before j before). pose proof (Rle_pow r j k ltac:(lra) ltac:(lia)). nra.
        + pose proof (at_least_0_after j ltac:(lia)). pose proof (Rle_pow r k j ltac:(lra) ltac:(lia)). nra. }
    rewrite mixed_linear, zero, root_x in growth. lra.
  Qed.

  Hypothesis last_positive : 0 < c n.

  Lemma mean_continuous : continuity (fun t => mean n c t).
  Proof.
    unfold mean. enough (forall m (d : nat -> R -> R), (forall j, continuity (d j)) -> continuity (fun t => mixed m (fun j => d j t) (1 - t) t)) as all.
    { apply (all n (fun j _ => c j)). intro j. apply continuity_const. now intros x y. }
    assert (same : continuity (fun t => t)) by apply derivable_continuous, derivable_id.
    assert (other : continuity (fun t => 1 - t)).
    { apply (continuity_minus (fun _ => 1) (fun t => t)); [apply continuity_const; now intros x y|exact same]. }
    induction m as [|m IH]; intros d each; cbn; [apply each|]. apply (IH (fun j t => (1 - t) * d j t + t * d (S j) t)). intro j.
    apply (continuity_plus (fun t => (1 - t) * d j t) (fun t => t * d (S j) t)).
    - now apply (continuity_mult (fun t => 1 - t) (d j)).
    - now apply (continuity_mult (fun t => t) (d (S j))).
  Qed.

  Theorem one_root : mean n c 0 < 0 < mean n c 1 /\
    exists x, 0 < x < 1 /\ mean n c x = 0 /\ forall y, 0 < y < 1 -> mean n c y = 0 -> y = x.
  Proof.
    assert (signs : mean n c 0 < 0 < mean n c 1) by (rewrite mean_at_0, mean_at_1; now split).
    split; [exact signs|].
    destruct (IVT (fun t => mean n c t) 0 1 mean_continuous ltac:(lra) (proj1 signs) (proj2 signs)) as (x & between & root).
    assert (x <> 0) by (intros ->; lra). assert (x <> 1) by (intros ->; lra).
    exists x. split; [lra|]. split; [exact root|]. intros y inside zero.
    destruct (Rtotal_order x y) as [less|[same|more]]; [|now symmetry|].
    - destruct (no_second_root x y ltac:(lra) ltac:(lra) root zero).
    - destruct (no_second_root y x ltac:(lra) ltac:(lra) zero root).
  Qed.
End OneRoot.

(* ---------------------------------------------------------------- several axes *)

(* The value at t of the polynomial of degrees ns with the coefficients c, which are numbered by a list, an index for each axis. *)
Fixpoint tensor (ns : list nat) (c : list nat -> R) (t : nat -> R) : R :=
  match ns with
  | [] => c []
  | n :: ns => mean n (fun j => tensor ns (fun js => c (j :: js)) (fun i => t (S i))) (t O)
  end.

Definition in_box (t : nat -> R) : Prop := forall i, 0 <= t i <= 1.
Definition numbered (ns js : list nat) : Prop := Forall2 le js ns.

Lemma tensor_ext ns : forall c d t, (forall js, numbered ns js -> c js = d js) -> tensor ns c t = tensor ns d t.
Proof.
  induction ns as [|n ns IH]; intros c d t same; cbn; [apply same; constructor|]. apply mean_ext. intros j less. apply IH.
  intros js good. apply same. now constructor.
Qed.

Lemma tensor_linear ns : forall x y c d t, tensor ns (fun js => x * c js + y * d js) t = x * tensor ns c t + y * tensor ns d t.
Proof.
  induction ns as [|n ns IH]; intros x y c d t; cbn; [reflexivity|]. rewrite <- mean_linear. apply mean_ext. intros j _. apply IH.
Qed.

Lemma tensor_at_most ns x : forall c t, in_box t -> (forall js, numbered ns js -> c js <= x) -> tensor ns c t <= x.
Proof.
  induction ns as [|n ns IH]; intros c t inside each; cbn; [apply each; constructor|]. apply mean_at_most; [apply inside|].
  intros j less. apply IH; [intro i; apply inside|]. intros js good. apply each. now constructor.
Qed.

Lemma tensor_below ns x : forall c t, in_box t -> (forall js, numbered ns js -> c js < x) -> tensor ns c t < x.
Proof.
  induction ns as [|n ns IH]; intros c t inside each; cbn; [apply each; constructor|]. apply mean_below; [apply inside|].
  intros j less. apply IH; [intro i; apply inside|]. intros js good. apply each. now constructor.
Qed.

Lemma tensor_monotone ns c d t : in_box t -> (forall js, numbered ns js -> c js <= d js) -> tensor ns c t <= tensor ns d t.
Proof.
  intros inside order. enough (tensor ns (fun js => 1 * c js + (-1) * d js) t <= 0) as less by (rewrite tensor_linear in less; lra).
  apply tensor_at_most; [exact inside|]. intros js good. specialize (order js good). lra.
Qed.

(* A mean of tensors is the tensor of the means. *)
Lemma tensor_mixed ns m u v t : forall c : nat -> list nat -> R,
  mixed m (fun j => tensor ns (c j) t) u v = tensor ns (fun js => mixed m (fun j => c j js) u v) t.
Proof.
  induction m as [|m IH]; intro c; cbn [mixed]; [reflexivity|].
  rewrite <- (IH (fun j js => u * c j js + v * c (S j) js)). apply mixed_ext. intros j _. now rewrite tensor_linear.
Qed.

Lemma tensor_mean ns m s t (c : nat -> list nat -> R) :
  mean m (fun j => tensor ns (c j) t) s = tensor ns (fun js => mean m (fun j => c j js) s) t.
Proof. apply tensor_mixed. Qed.

Lemma mean_exchanged n m s t (c : nat -> nat -> R) : mean n (fun i => mean m (c i) s) t = mean m (fun j => mean n (fun i => c i j) t) s.
Proof.
  unfold mean. revert c. induction n as [|n IH]; intro c; cbn [mixed]; [reflexivity|].
  rewrite <- (IH (fun i j => (1 - t) * c i j + t * c (S i) j)). apply mixed_ext. intros i _. now rewrite mixed_linear.
Qed.

(* The axis at a place comes first: for the degrees, the point, and the other way round for an index. *)
Fixpoint without {A} (p : nat) (l : list A) : list A := match p, l with _, [] => [] | O, _ :: l => l | S p, x :: l => x :: without p l end.
Fixpoint skip (p : nat) (t : nat -> R) : nat -> R :=
  match p with O => fun i => t (S i) | S p => fun i => match i with O => t O | S i => skip p (fun i => t (S i)) i end end.
Definition front (p : nat) (t : nat -> R) (i : nat) : R := match i with O => t p | S i => skip p t i end.
Fixpoint insert (p j : nat) (js : list nat) : list nat := match p, js with S p, i :: js => i :: insert p j js | _, _ => j :: js end.
Definition replaced (p : nat) (js : list nat) : list nat := match js with [] => [] | j :: js => insert p j js end.

Lemma front_in_box p : forall t, in_box t -> in_box (front p t).
Proof.
  induction p as [|p IH]; intros t inside [|i]; cbn; try apply inside. destruct i as [|i]; [apply inside|].
  exact (IH (fun i => t (S i)) (fun i => inside (S i)) (S i)).
Qed.

Lemma tensor_front p : forall ns c t, (p < length ns)%nat ->
  tensor ns c t = tensor (nth p ns O :: without p ns) (fun js => c (replaced p js)) (front p t).
Proof.
  induction p as [|p IH]; intros [|n ns] c t less; cbn in less; try lia; [reflexivity|].
  cbn [tensor nth without front replaced]. rewrite mean_exchanged. cbn [skip]. apply mean_ext. intros i _.
  rewrite (IH ns (fun js => c (i :: js)) (fun i => t (S i))) by lia. reflexivity.
Qed.
