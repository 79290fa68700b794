(* The Bernstein coefficients of a polynomial on a box, the box that facts state, and the root of a `number` line.

   Defined:  coefficient (from those of the powers of a variable); axes_of (the bounds that facts state); one_change.
   Proved:   coefficients_value   the mean of the coefficients is the polynomial;
             axes_located         a point that meets the facts lies in the box of their bounds;
             number_sound         one change of sign: different signs at the ends, and exactly one root between them. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool FunctionalExtensionality.
From Juggleproof Require Import Polynomials Formulas Bernstein States.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- the coefficients of a polynomial on a box *)

Definition count (n : nat) : Q := inject_Z (Z.of_nat n).

Lemma count_value n : Q2R (count n) = INR n.
Proof. unfold count, inject_Z, Q2R. cbn [Qnum Qden]. rewrite Rinv_1, Rmult_1_r. symmetry. apply INR_IZR_INZ. Qed.

Definition with_line (n : nat) (a b : Q) (c : nat -> Q) (j : nat) : Q :=
  Qred (((count (S n) - count j) * a * c j + count j * b * c (pred j)) / count (S n)).

Lemma with_line_value n a b c j : Q2R (with_line n a b c j) = multiplied n (Q2R a) (Q2R b) (fun j => Q2R (c j)) j.
Proof.
  unfold with_line, multiplied. rewrite Q2R_red, Q2R_div, Q2R_plus, !Q2R_mult, Q2R_minus, !count_value; [reflexivity|].
  intro zero. apply Qeq_eqR in zero. rewrite count_value, Q2R_0 in zero. pose proof (lt_0_INR (S n) ltac:(lia)). lra.
Qed.

Fixpoint of_lines (l : list (Q * Q)) : nat -> Q :=
  match l with [] => fun _ => 1%Q | (a, b) :: rest => with_line (length rest) a b (of_lines rest) end.

Definition on_lines (t : R) (l : list (Q * Q)) (x : R) : R := fold_right (fun ab x => ((1 - t) * Q2R (fst ab) + t * Q2R (snd ab)) * x) x l.

Lemma of_lines_value t l : mean (length l) (fun j => Q2R (of_lines l j)) t = on_lines t l 1.
Proof.
  induction l as [|[a b] l IH]; cbn [of_lines length on_lines fold_right fst snd]; [exact Q2R_1|]. unfold on_lines in IH.
  rewrite <- IH, <- mean_multiplied. apply mean_ext. intros j _. apply with_line_value.
Qed.

Lemma on_lines_repeat t ab n x : on_lines t (repeat ab n) x = ((1 - t) * Q2R (fst ab) + t * Q2R (snd ab)) ^ n * x.
Proof. unfold on_lines. induction n as [|n IH]; cbn [repeat fold_right pow]; [ring|]. rewrite IH. ring. Qed.

(* x^e in degree n, where x goes from low to high. *)
Definition of_power (n e : nat) (low high : Q) : nat -> Q := of_lines (repeat (low, high) e ++ repeat (1%Q, 1%Q) (n - e)).

Lemma of_power_value n e low high t : (e <= n)%nat ->
  mean n (fun j => Q2R (of_power n e low high j)) t = ((1 - t) * Q2R low + t * Q2R high) ^ e.
Proof.
  intro less. unfold of_power. pose proof (of_lines_value t (repeat (low, high) e ++ repeat (1%Q, 1%Q) (n - e))) as lines.
  rewrite app_length, !repeat_length in lines. replace (e + (n - e))%nat with n in lines by lia. rewrite lines.
  unfold on_lines. rewrite fold_right_app. fold (on_lines t (repeat (1%Q, 1%Q) (n - e)) 1). rewrite on_lines_repeat. cbn [fst snd].
  rewrite Q2R_1. replace ((1 - t) * 1 + t * 1) with 1 by ring. rewrite pow1. fold (on_lines t (repeat (low, high) e) (1 * 1)).
  rewrite on_lines_repeat. cbn [fst snd]. ring.
Qed.

(* For each variable its bounds and the degree in it; None where it does not occur. *)
Definition axis : Type := Q * Q * nat.

Fixpoint degrees (axes : list (option axis)) : list nat :=
  match axes with [] => [] | None :: axes => degrees axes | Some (_, _, n) :: axes => n :: degrees axes end.

Fixpoint suits (axes : list (option axis)) (m : monomial) : bool :=
  match axes with
  | [] => forallb (Nat.eqb 0) m
  | None :: axes => (hd O m =? 0)%nat && suits axes (tl m)
  | Some (_, _, n) :: axes => (hd O m <=? n)%nat && suits axes (tl m)
  end.

Fixpoint of_monomial (axes : list (option axis)) (m : monomial) (js : list nat) : Q :=
  match axes with
  | [] => 1
  | None :: axes => of_monomial axes (tl m) js
  | Some (low, high, n) :: axes => Qred (of_power n (hd O m) low high (hd O js) * of_monomial axes (tl m) (tl js))
  end.

Fixpoint coefficient (axes : list (option axis)) (p : poly) (js : list nat) : Q :=
  match p with [] => 0 | (c, m) :: p => Qred (c * of_monomial axes m js + coefficient axes p js) end.

(* The variables from i on are in the box, at the place t. *)
Fixpoint located (axes : list (option axis)) (i : nat) (a : assignment) (t : nat -> R) : Prop :=
  match axes with
  | [] => True
  | None :: axes => located axes (S i) a t
  | Some (low, high, _) :: axes => a i = (1 - t O) * Q2R low + t O * Q2R high /\ located axes (S i) a (fun k => t (S k))
  end.

Definition value_at (ns : list nat) (c : list nat -> Q) (t : nat -> R) : R := tensor ns (fun js => Q2R (c js)) t.

Lemma tensor_multiple ns x c t : tensor ns (fun js => x * c js) t = x * tensor ns c t.
Proof.
  pose proof (tensor_linear ns x 0 c c t) as linear. rewrite Rmult_0_l, Rplus_0_r in linear. rewrite <- linear.
  apply tensor_ext. intros js _. ring.
Qed.

Lemma product_first m (a : assignment) : product m a = a O ^ hd O m * product (tl m) (fun i => a (S i)).
Proof. destruct m; cbn; ring. Qed.

Lemma of_monomial_value axes : forall m i a t, suits axes m = true -> located axes i a t ->
  value_at (degrees axes) (of_monomial axes m) t = product m (fun k => a (i + k)%nat).
Proof.
  unfold value_at. induction axes as [|[[[low high] n]|] axes IH]; intros m i a t good place; cbn [suits located degrees of_monomial tensor] in *.
  - rewrite (product_trivial m _ good). exact Q2R_1.
  - apply andb_prop in good. destruct good as [less good]. apply Nat.leb_le in less. destruct place as [here place].
    rewrite product_first, Nat.add_0_r, here, <- (of_power_value n (hd O m) low high (t O) less).
    replace (fun k => a (i + S k)%nat) with (fun k => a (S i + k)%nat) by (apply functional_extensionality; intro k; f_equal; lia).
    rewrite <- (IH (tl m) (S i) a (fun k => t (S k)) good place), Rmult_comm, <- mean_multiple. apply mean_ext. intros j _.
    rewrite Rmult_comm, <- tensor_multiple. apply tensor_ext. intros js _. cbn [hd tl]. now rewrite Q2R_red, Q2R_mult.
  - apply andb_prop in good. destruct good as [none good]. apply Nat.eqb_eq in none. rewrite product_first, none. cbn [pow].
    replace (fun k => a (i + S k)%nat) with (fun k => a (S i + k)%nat) by (apply functional_extensionality; intro k; f_equal; lia).
    rewrite <- (IH (tl m) (S i) a t good place). ring.
Qed.

Definition suits_all (axes : list (option axis)) (p : poly) : bool := forallb (fun t => suits axes (snd t)) p.

Lemma coefficients_value axes p a t : suits_all axes p = true -> located axes 0 a t ->
  value_at (degrees axes) (coefficient axes p) t = eval p a.
Proof.
  unfold value_at. intros good place. induction p as [|[c m] p IH]; cbn [coefficient eval].
  - transitivity (tensor (degrees axes) (fun _ => 0 * 1) t); [apply tensor_ext; intros js _; rewrite Q2R_0; ring|].
    rewrite tensor_multiple. ring.
  - apply andb_prop in good. destruct good as [first good]. rewrite <- (IH good).
    rewrite <- (of_monomial_value axes m 0 a t first place : _ = product m a). unfold value_at.
    rewrite <- (Rmult_1_l (tensor _ (fun js => Q2R (coefficient _ _ _)) _)), <- tensor_linear. apply tensor_ext. intros js _.
    rewrite Q2R_red, Q2R_plus, Q2R_mult. ring.
Qed.

(* ---------------------------------------------------------------- the bounds that facts state *)

(* (c, k), where the polynomial is c + k x in the variable v alone. *)
Definition line_in (v : nat) (p : poly) : option (Q * Q) :=
  let slope := fold_right Qplus 0%Q (map (fun t => if (nth v (snd t) O =? 1)%nat then fst t else 0%Q) p) in
  option_map (fun c => (c, slope)) (constant (minus p (scale slope (variable v)))).

Lemma line_in_value v p c k a : line_in v p = Some (c, k) -> eval p a = Q2R c + Q2R k * a v.
Proof.
  unfold line_in. destruct (constant _) as [d|] eqn:found; [|discriminate]. cbn [option_map]. intro same. injection same as <- <-.
  pose proof (constant_value _ _ a found) as value. rewrite eval_minus, eval_scale, eval_variable in value. lra.
Qed.

(* Fact j says that the bound is at most the variable (upper: false), or at least (upper: true). *)
Definition bound (upper : bool) (fs : list fact) (v j : nat) : option Q :=
  match nth_error fs j with
  | Some (p, (Positive | Nonnegative)) =>
    match line_in v p with
    | Some (c, k) => if decide Positive (if upper then - k else k) then Some (Qred (- c / k)) else None
    | None => None
    end
  | _ => None
  end.

Lemma bound_holds upper fs v j b a : Forall (true_at a) fs -> bound upper fs v j = Some b -> if upper then a v <= Q2R b else Q2R b <= a v.
Proof.
  unfold bound. intros each found. destruct (nth_error fs j) as [[p r]|] eqn:fact_; [|discriminate].
  assert (sign : r = Positive \/ r = Nonnegative) by (destruct r; auto; discriminate).
  assert (weak : 0 <= eval p a) by (pose proof (fact_true a fs j p r each fact_); destruct sign; subst r; cbn in *; lra).
  destruct (line_in v p) as [[c k]|] eqn:line; [|destruct r; discriminate]. rewrite (line_in_value v p c k a line) in weak.
  destruct (decide Positive _) eqn:slope; [|destruct r; discriminate]. apply decide_holds in slope. cbn [meets] in slope.
  replace b with (Qred (- c / k)) by (destruct r; congruence). assert (other : Q2R k <> 0) by (destruct upper; rewrite ?Q2R_opp in slope; lra).
  rewrite Q2R_red, Q2R_div, Q2R_opp by (intro zero; apply other; rewrite (Qeq_eqR _ _ zero); exact Q2R_0).
  destruct upper; rewrite ?Q2R_opp in slope; [apply Rmult_le_reg_l with (- Q2R k)|apply Rmult_le_reg_l with (Q2R k)]; try lra;
    unfold Rdiv; [replace (- Q2R k * (- Q2R c * / Q2R k)) with (Q2R c)|replace (Q2R k * (- Q2R c * / Q2R k)) with (- Q2R c)];
    try lra; field; exact other.
Qed.

Definition degree_in (v : nat) (p : poly) : nat := fold_right Nat.max O (map (fun t => nth v (snd t) O) p).
Definition width (p : poly) : nat := fold_right Nat.max O (map (fun t => length (snd t)) p).

(* The variables i, i + 1, .., as many as `size`: each that occurs has two facts as its bounds. *)
Fixpoint axes_of (fs : list fact) (p : poly) (i size : nat) (bounds : list (nat * nat)) : option (list (option axis)) :=
  match size with
  | O => match bounds with [] => Some [] | _ => None end
  | S size =>
    match degree_in i p, bounds with
    | O, _ => option_map (cons None) (axes_of fs p (S i) size bounds)
    | n, (j, k) :: bounds =>
      match bound false fs i j, bound true fs i k with
      | Some low, Some high => option_map (cons (Some (low, high, n))) (axes_of fs p (S i) size bounds)
      | _, _ => None
      end
    | _, [] => None
    end
  end.

Lemma place_between low high x : low <= x <= high -> exists t, 0 <= t <= 1 /\ x = (1 - t) * low + t * high.
Proof.
  intro between. destruct (Req_dec low high) as [same|apart]; [exists 0; lra|]. exists ((x - low) / (high - low)).
  split; [|field; lra]. assert (positive : 0 < / (high - low)) by (apply Rinv_0_lt_compat; lra). unfold Rdiv.
  split; [apply Rmult_le_pos; lra|]. apply Rmult_le_reg_r with (high - low); [lra|]. rewrite Rmult_assoc, Rinv_l; lra.
Qed.

Lemma axes_located fs p a : Forall (true_at a) fs -> forall size i bounds axes, axes_of fs p i size bounds = Some axes ->
  exists t, in_box t /\ located axes i a t.
Proof.
  intro each. induction size as [|size IH]; intros i bounds axes found; cbn [axes_of] in found.
  - destruct bounds; [injection found as <-|discriminate]. exists (fun _ => 0). split; [intro; lra|exact I].
  - destruct (degree_in i p) as [|n].
    + destruct (axes_of fs p (S i) size bounds) as [rest|] eqn:more; [|discriminate]. injection found as <-. exact (IH _ _ _ more).
    + destruct bounds as [|[j k] bounds]; [discriminate|]. destruct (bound false fs i j) as [low|] eqn:first; [|discriminate].
      destruct (bound true fs i k) as [high|] eqn:second; [|discriminate].
      destruct (axes_of fs p (S i) size bounds) as [rest|] eqn:more; [|discriminate]. injection found as <-.
      apply (bound_holds false fs i j low a each) in first. apply (bound_holds true fs i k high a each) in second.
      destruct (IH _ _ _ more) as (t & inside & place). destruct (place_between _ _ _ (conj first second)) as (x & between & same).
      exists (fun k => match k with O => x | S k => t k end). split; [intros [|k']; [exact between|apply inside]|]. now split.
Qed.

(* ---------------------------------------------------------------- the root of a number line *)

(* The coefficients are negative at first, then from some index on at least 0, and at last positive. *)
Definition one_change (n : nat) (c : nat -> Q) : bool :=
  decide Positive (- c O) && decide Positive (c n)
  && existsb (fun k => forallb (fun j => if (j <? k)%nat then Qle_bool (c j) 0 else Qle_bool 0 (c j)) (seq 0 (S n))) (seq 0 (S n)).

Definition rises_once (v : nat) (p : poly) (low high : Q) : bool :=
  let n := degree_in v p in
  let axes := repeat None v ++ [Some (low, high, n)] in
  decide Positive (high - low) && suits_all axes p && one_change n (fun j => coefficient axes p [j]).

(* The rule of a `number` line: exactly one root between low and high, where p changes its sign. *)
Definition one_root_between (v : nat) (p : poly) (low high : Q) : bool := rises_once v p low high || rises_once v (opposite p) low high.

Lemma located_alone v low high n a t : forall i,
  located (repeat None v ++ [Some (low, high, n)]) i a t <-> a (i + v)%nat = (1 - t O) * Q2R low + t O * Q2R high.
Proof.
  induction v as [|v IH]; intro i; cbn [repeat app located]; [rewrite Nat.add_0_r; tauto|]. rewrite IH. now replace (S i + v)%nat with (i + S v)%nat by lia.
Qed.

Lemma degrees_alone v low high n : degrees (repeat None v ++ [Some (low, high, n)]) = [n].
Proof. induction v as [|v IH]; [reflexivity|exact IH]. Qed.

(* A polynomial as a function of one of its variables. *)
Definition along (v : nat) (p : poly) (a : assignment) (x : R) : R := eval p (put v x a).
Definition only_root (f : R -> R) (low high : R) : Prop :=
  exists x, low < x < high /\ f x = 0 /\ forall y, low < y < high -> f y = 0 -> y = x.

Lemma rises_once_sound v p low high a : rises_once v p low high = true -> Q2R low < Q2R high /\
  along v p a (Q2R low) < 0 < along v p a (Q2R high) /\ only_root (along v p a) (Q2R low) (Q2R high).
Proof.
  unfold rises_once. set (n := degree_in v p). set (axes := repeat None v ++ _). set (c := fun j => coefficient axes p [j]).
  intros good. apply andb_prop in good. destruct good as [good change]. apply andb_prop in good. destruct good as [order suit].
  apply decide_holds in order. cbn [meets] in order. rewrite Q2R_minus in order. set (l := Q2R low) in *. set (h := Q2R high) in *.
  unfold one_change in change. apply andb_prop in change. destruct change as [change some]. apply andb_prop in change. destruct change as [first last].
  apply decide_holds in first, last. cbn [meets] in first, last. rewrite Q2R_opp in first.
  apply existsb_exists in some. destruct some as (k & _ & signs). rewrite forallb_forall in signs.
  assert (sign : forall j, (j <= n)%nat -> if (j <? k)%nat then Q2R (c j) <= 0 else 0 <= Q2R (c j)).
  { intros j less. specialize (signs j ltac:(apply in_seq; lia)).
    destruct (j <? k)%nat; apply Qle_bool_R in signs; rewrite Q2R_0 in signs; exact signs. }
  assert (as_mean : forall t, along v p a ((1 - t) * l + t * h) = mean n (fun j => Q2R (c j)) t).
  { intro t. unfold along. rewrite <- (coefficients_value axes p _ (fun _ => t) suit); [|apply located_alone; apply put_same].
    unfold value_at, axes. now rewrite degrees_alone. }
  destruct (one_root n k (fun j => Q2R (c j))) as [[below above] (x & inside & root & unique)]; [lra| | |exact last|].
  { intros j less. destruct (Nat.le_gt_cases j n) as [here|beyond].
    - specialize (sign j here). destruct (Nat.ltb_spec j k); [exact sign|lia].
    - exfalso. specialize (sign n (Nat.le_refl n)). destruct (Nat.ltb_spec n k); [lra|lia]. }
  { intros j between. specialize (sign j ltac:(lia)). destruct (Nat.ltb_spec j k); [lia|exact sign]. }
  rewrite <- as_mean in below, above, root. replace ((1 - 0) * l + 0 * h) with l in below by ring. replace ((1 - 1) * l + 1 * h) with h in above by ring.
  split; [lra|]. split; [now split|]. exists ((1 - x) * l + x * h). split; [nra|]. split; [exact root|]. intros y between zero.
  set (t := (y - l) / (h - l)). assert (back : y = (1 - t) * l + t * h) by (unfold t; field; lra).
  rewrite back in zero |- *. rewrite as_mean in zero. rewrite (unique t); [reflexivity| |exact zero]. nra.
Qed.

Theorem number_sound v p low high a : one_root_between v p low high = true -> Q2R low < Q2R high /\
  along v p a (Q2R low) * along v p a (Q2R high) < 0 /\ only_root (along v p a) (Q2R low) (Q2R high).
Proof.
  unfold one_root_between. intro good. apply orb_prop in good. destruct good as [good|good].
  - destruct (rises_once_sound v p low high a good) as (order & signs & root). split; [exact order|]. split; [nra|exact root].
  - destruct (rises_once_sound v _ low high a good) as (order & signs & root). unfold along, only_root in *. split; [exact order|].
    rewrite !eval_opposite in signs. split; [nra|]. destruct root as (x & inside & zero & unique). rewrite eval_opposite in zero.
    exists x. split; [exact inside|]. split; [lra|]. intros y between of_y. apply unique; [exact between|]. rewrite eval_opposite. lra.
Qed.
