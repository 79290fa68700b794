(* Box trees, for any polynomial: what a tree of halves and faces shows of the Bernstein coefficients.

   Defined:  covers (what the checker makes of a box tree), boxes (its rule, for any facts).
   Proved:   covers_sound   a tree that the checker accepts: the polynomial has the sign on all of the box;
             boxes_sound    facts that the rule refutes do not all hold. *)

From Coq Require Import QArith Qreals Reals Lra Lia List Bool.
From Juggleproof Require Import Polynomials Formulas Bernstein States Coefficients.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- halves, faces, trees *)

Definition box : Type := list nat * (list nat -> Q).

(* A table of the coefficients, so that each is computed once. *)
Inductive table := Entry (c : Q) | Row (l : list table).
Fixpoint tabulate (ns : list nat) (c : list nat -> Q) : table :=
  match ns with [] => Entry (c []) | n :: ns => Row (map (fun j => tabulate ns (fun js => c (j :: js))) (seq 0 (S n))) end.
Fixpoint entry (t : table) (js : list nat) : Q :=
  match js, t with [], Entry c => c | j :: js, Row l => entry (nth j l (Entry 0)) js | _, _ => 0%Q end.
Definition stored (b : box) : box := let t := tabulate (fst b) (snd b) in (fst b, entry t).

Lemma stored_value b t : value_at (fst (stored b)) (snd (stored b)) t = value_at (fst b) (snd b) t.
Proof.
  destruct b as [ns c]. unfold stored, value_at. cbn [fst snd]. apply tensor_ext. intros js good. f_equal. revert c.
  induction good as [|j n js ns less _ IH]; intro c; [reflexivity|]. cbn [tabulate entry].
  rewrite (nth_indep _ (Entry 0) (tabulate ns (fun js => c (0%nat :: js)))) by (rewrite map_length, seq_length; lia).
  rewrite (map_nth (fun j => tabulate ns (fun js => c (j :: js)))), seq_nth by lia. apply (IH (fun js => c (j :: js))).
Qed.

Definition first_axis (p : nat) (b : box) : box := stored (nth p (fst b) O :: without p (fst b), fun js => snd b (replaced p js)).

Lemma first_axis_value p b t : (p < length (fst b))%nat ->
  value_at (fst b) (snd b) t = value_at (fst (first_axis p b)) (snd (first_axis p b)) (front p t).
Proof. intro less. unfold first_axis. rewrite stored_value. exact (tensor_front p _ _ t less). Qed.

Fixpoint middle (n : nat) (c : nat -> Q) : Q := match n with O => c O | S m => middle m (fun j => Qred ((c j + c (S j)) / 2)) end.

Lemma middle_value n : forall c, Q2R (middle n c) = mean n (fun j => Q2R (c j)) (/ 2).
Proof.
  unfold mean. induction n as [|n IH]; intro c; cbn [middle mixed]; [reflexivity|]. rewrite IH. apply mixed_ext. intros j _.
  rewrite Q2R_red, Q2R_div, Q2R_plus by discriminate. replace (Q2R 2) with 2 by (unfold Q2R; cbn; lra). field.
Qed.

Definition lower_half (b : box) : box :=
  stored (fst b, fun js => middle (hd O js) (fun j => snd b (j :: tl js))).
Definition upper_half (b : box) : box :=
  stored (fst b, fun js => middle (hd O (fst b) - hd O js) (fun j => snd b ((hd O (fst b) - j)%nat :: tl js))).

Definition half_place (x : R) (t : nat -> R) (i : nat) : R := match i with O => x | S _ => t i end.

Lemma lower_half_value n ns c t :
  value_at (n :: ns) c t = value_at (fst (lower_half (n :: ns, c))) (snd (lower_half (n :: ns, c))) (half_place (2 * t O) t).
Proof.
  unfold lower_half. rewrite stored_value. unfold value_at. cbn [fst snd tensor half_place hd tl].
  replace (t O) with (/ 2 * (2 * t O)) at 1 by field. rewrite <- mean_lower. apply mean_ext. intros k _.
  rewrite tensor_mean. apply tensor_ext. intros js _. symmetry. apply middle_value.
Qed.

Lemma upper_half_value n ns c t :
  value_at (n :: ns) c t = value_at (fst (upper_half (n :: ns, c))) (snd (upper_half (n :: ns, c))) (half_place (2 * t O - 1) t).
Proof.
  unfold upper_half. rewrite stored_value. unfold value_at. cbn [fst snd tensor half_place hd tl].
  replace (t O) with (/ 2 + (1 - / 2) * (2 * t O - 1)) at 1 by field. rewrite <- mean_upper. replace (1 - / 2) with (/ 2) by field.
  apply mean_ext. intros k _. unfold turned. rewrite tensor_mean. apply tensor_ext. intros js _. symmetry. apply middle_value.
Qed.

(* What refutes a fact p > 0 or p >= 0. *)
Definition fails (r : relation) (x : R) : Prop := match r with Positive => x <= 0 | Nonnegative => x < 0 | _ => False end.
Definition refuted (r : relation) (c : Q) : bool := match r with Positive => Qle_bool c 0 | Nonnegative => negb (Qle_bool 0 c) | _ => false end.

Lemma refuted_fails r c : refuted r c = true -> fails r (Q2R c).
Proof.
  pose proof (Qle_bool_R c 0) as low. pose proof (Qle_bool_R 0 c) as high. rewrite Q2R_0 in *.
  destruct r; cbn [refuted fails]; try discriminate; [apply low|]. rewrite negb_true_iff, <- not_true_iff_false, high. lra.
Qed.

Fixpoint indices (ns : list nat) : list (list nat) :=
  match ns with [] => [[]] | n :: ns => flat_map (fun j => map (cons j) (indices ns)) (seq 0 (S n)) end.

Lemma numbered_indices ns js : numbered ns js -> In js (indices ns).
Proof.
  induction 1 as [|j n js ns less _ IH]; cbn [indices]; [now left|]. apply in_flat_map. exists j. split; [apply in_seq; lia|]. now apply in_map.
Qed.

Lemma signs_fail r ns c t : in_box t -> forallb (fun js => refuted r (c js)) (indices ns) = true -> fails r (value_at ns c t).
Proof.
  intros inside good. rewrite forallb_forall in good. assert (each : forall js, numbered ns js -> fails r (Q2R (c js))).
  { intros js here. apply refuted_fails, good, numbered_indices, here. }
  destruct r; cbn [fails] in *; [now apply tensor_at_most|now apply tensor_below| |].
  all: apply (each (map (fun _ => O) ns)); clear; induction ns; constructor; auto; lia.
Qed.

Lemma fails_below r x y : x <= y -> fails r y -> fails r x.
Proof. destruct r; cbn; lra. Qed.

(* The face on which p is largest, where along the first axis all coefficients grow towards it, or all fall. *)
Definition face (b : box) : option box :=
  match b with
  | ([], _) => None
  | (n :: ns, c) =>
    let all order := forallb (fun js => forallb (fun j => order (c (j :: js)) (c (S j :: js))) (seq 0 n)) (indices ns) in
    if all Qle_bool then Some (ns, fun js => c (n :: js))
    else if all (fun x y => Qle_bool y x) then Some (ns, fun js => c (O :: js)) else None
  end.

Lemma face_value b f t : in_box t -> face b = Some f ->
  exists s, in_box s /\ value_at (fst b) (snd b) t <= value_at (fst f) (snd f) s.
Proof.
  destruct b as [[|n ns] c]; cbn [face]; [discriminate|]. intros inside found.
  assert (step : forall order, forallb (fun js => forallb (fun j => order (c (j :: js)) (c (S j :: js))) (seq 0 n)) (indices ns) = true ->
      forall js, numbered ns js -> forall j, (j < n)%nat -> order (c (j :: js)) (c (S j :: js)) = true).
  { intros order all js good j less. rewrite forallb_forall in all. specialize (all js (numbered_indices ns js good)).
    rewrite forallb_forall in all. apply all, in_seq. lia. }
  assert (inside' : in_box (fun i => t (S i))) by (intro i; apply inside). exists (fun i => t (S i)). split; [exact inside'|].
  destruct (forallb _ (indices ns)) eqn:rising in found.
  - injection found as <-. unfold value_at. cbn [fst snd tensor].
    apply (mean_at_end n (fun j => tensor ns (fun js => Q2R (c (j :: js))) (fun i => t (S i)))); [apply inside|]. intros j less.
    apply tensor_monotone; [exact inside'|]. intros js good. apply Qle_bool_R. exact (step _ rising js good j less).
  - clear rising. destruct (forallb _ (indices ns)) eqn:falling in found; [|discriminate]. injection found as <-. unfold value_at. cbn [fst snd tensor].
    rewrite <- mean_turned. set (d := turned n _). replace (tensor ns (fun js => Q2R (c (O :: js))) (fun i => t (S i))) with (d n)
      by (unfold d, turned; now rewrite Nat.sub_diag).
    apply mean_at_end; [specialize (inside O); lra|]. intros j less. unfold d, turned. apply tensor_monotone; [exact inside'|].
    intros js good. apply Qle_bool_R. replace (n - j)%nat with (S (n - S j)) by lia. apply (step (fun x y => Qle_bool y x) falling js good). lia.
Qed.

Inductive letter := Signs | Halve (p : nat) | Face (p : nat).

(* The boxes that are still to be looked at come last in, first out, as the letters have them in preorder. *)
Fixpoint covers (r : relation) (tree : list letter) (boxes : list box) : bool :=
  match tree, boxes with
  | [], [] => true
  | Signs :: tree, (ns, c) :: boxes => forallb (fun js => refuted r (c js)) (indices ns) && covers r tree boxes
  | Halve p :: tree, b :: boxes =>
    let moved := first_axis p b in (p <? length (fst b))%nat && covers r tree (lower_half moved :: upper_half moved :: boxes)
  | Face p :: tree, b :: boxes =>
    (p <? length (fst b))%nat && match face (first_axis p b) with Some f => covers r tree (f :: boxes) | None => false end
  | _, _ => false
  end.

Theorem covers_sound r tree : forall boxes, covers r tree boxes = true ->
  Forall (fun b => forall t, in_box t -> fails r (value_at (fst b) (snd b) t)) boxes.
Proof.
  induction tree as [|[|p|p] tree IH]; intros [|[ns c] boxes] good; cbn [covers fst] in good; try discriminate; [constructor|..];
    apply andb_prop in good; destruct good as [first good].
  - constructor; [|now apply IH]. intros t inside. now apply signs_fail.
  - apply IH in good. inversion good as [|? ? low rest]; subst. inversion rest as [|? ? high others]; subst. constructor; [|exact others].
    intros t inside. apply Nat.ltb_lt in first. rewrite (first_axis_value p (ns, c) t first). set (moved := first_axis p (ns, c)) in *.
    pose proof (front_in_box p t inside) as inside'. set (s := front p t) in *.
    change (fst moved) with (nth p ns O :: without p ns) in *. destruct (Rle_dec (s O) (/ 2)) as [left_|right_].
    + replace moved with (nth p ns O :: without p ns, snd moved) in low by reflexivity.
      rewrite lower_half_value. apply low. intros [|i]; cbn [half_place]; [specialize (inside' O); lra|apply inside'].
    + replace moved with (nth p ns O :: without p ns, snd moved) in high by reflexivity.
      rewrite upper_half_value. apply high. intros [|i]; cbn [half_place]; [specialize (inside' O); lra|apply inside'].
  - destruct (face (first_axis p (ns, c))) as [f|] eqn:found; [|discriminate]. apply IH in good. inversion good as [|? ? here others]; subst.
    constructor; [|exact others]. intros t inside. apply Nat.ltb_lt in first. rewrite (first_axis_value p (ns, c) t first).
    destruct (face_value _ f (front p t) (front_in_box p t inside) found) as (s & inside' & less). exact (fails_below r _ _ less (here s inside')).
Qed.

(* The rule: fact i is p > 0 or p >= 0; for each variable of p in order, two facts are its bounds. *)
Definition boxes (fs : list fact) (i : nat) (bounds : list (nat * nat)) (tree : list letter) : bool :=
  match nth_error fs i with
  | Some (p, r) =>
    match axes_of fs p 0 (width p) bounds with
    | Some axes => suits_all axes p && covers r tree [stored (degrees axes, coefficient axes p)]
    | None => false
    end
  | None => false
  end.

Theorem boxes_sound a fs i bounds tree : boxes fs i bounds tree = true -> ~ Forall (true_at a) fs.
Proof.
  unfold boxes. intros good each. destruct (nth_error fs i) as [[p r]|] eqn:fact_; [|discriminate].
  destruct (axes_of fs p 0 (width p) bounds) as [axes|] eqn:found; [|discriminate]. apply andb_prop in good. destruct good as [suit good].
  destruct (axes_located fs p a each _ _ _ _ found) as (t & inside & place).
  apply covers_sound in good. inversion good as [|? ? sign _]; subst. specialize (sign t inside).
  rewrite stored_value in sign. cbn [fst snd] in sign. rewrite (coefficients_value axes p a t suit place) in sign.
  pose proof (fact_true a fs i p r each fact_) as meet. destruct r; cbn in *; lra.
Qed.
