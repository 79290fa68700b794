(* The mean value theorem, with the axioms of the reals alone: that of Coq's library rests on excluded middle too.

   Proved:   chord        a continuous function with equal values at two ends has equal values at half their distance, between them;
             mean_value   so, by halving, the derivative takes the slope of a chord. *)

From Coq Require Import Reals Lra Lia.
Open Scope R_scope.

Section Halving.
  Variable f : R -> R.
  Hypothesis whole : continuity f.

  Definition Chord : Type := {pq : R * R | fst pq < snd pq /\ f (fst pq) = f (snd pq)}.
  Definition left (c : Chord) : R := fst (proj1_sig c).
  Definition right (c : Chord) : R := snd (proj1_sig c).

  Lemma chord (c : Chord) : {d : Chord | left c <= left d /\ right d <= right c /\ right d - left d = (right c - left c) / 2}.
  Proof.
    destruct c as [[a b] [order same]]. unfold left, right. cbn [proj1_sig fst snd] in *. set (L := (b - a) / 2).
    assert (L_positive : 0 < L) by (unfold L; lra). assert (b_is : a + L + L = b) by (unfold L; field).
    set (h := fun x => f (x + L) - f x).
    assert (h_whole : continuity h).
    { intro x. apply continuity_pt_minus; [|apply whole]. apply (continuity_pt_comp (fun y => y + L) f); [|apply whole].
      apply continuity_pt_plus; [apply derivable_continuous_pt, derivable_pt_id|apply continuity_pt_const; now intros]. }
    assert (opposite : h (a + L) = - h a) by (unfold h; rewrite b_is; lra).
    assert (found : {x | a <= x <= a + L /\ h x = 0}).
    { destruct (total_order_T (h a) 0) as [[less|zero]|more].
      - apply IVT; [exact h_whole|lra|exact less|lra].
      - exists a. lra.
      - destruct (IVT (fun x => - h x) a (a + L)) as [x [inside zero]]; [|lra..|].
        + intro x. apply continuity_pt_opp, h_whole.
        + exists x. lra. }
    destruct found as [x [inside zero]].
    assert (good : fst (x, x + L) < snd (x, x + L) /\ f (fst (x, x + L)) = f (snd (x, x + L))) by (cbn [fst snd]; unfold h, L in *; lra).
    exists (exist _ (x, x + L) good). cbn [proj1_sig fst snd]. unfold L in *. lra.
  Qed.

  Fixpoint nested (c : Chord) (n : nat) : Chord := match n with O => c | S k => proj1_sig (chord (nested c k)) end.

  Lemma nested_within c n k : left (nested c n) <= left (nested c (n + k)) /\ right (nested c (n + k)) <= right (nested c n).
  Proof.
    induction k as [|k IH]; [rewrite Nat.add_0_r; lra|]. rewrite Nat.add_succ_r. cbn [nested].
    destruct (chord (nested c (n + k))) as [d inside]. cbn [proj1_sig]. lra.
  Qed.

  Lemma nested_short c n : right (nested c n) - left (nested c n) = (right c - left c) * (/ 2) ^ n.
  Proof.
    induction n as [|n IH]; [cbn; ring|]. cbn [nested pow]. destruct (chord (nested c n)) as [d inside]. cbn [proj1_sig]. lra.
  Qed.

  Lemma order (c : Chord) : left c < right c /\ f (left c) = f (right c).
  Proof. destruct c as [pq both]. exact both. Qed.

  Lemma rolle c f' : (forall x, derivable_pt_lim f x (f' x)) -> exists m, left c <= m <= right c /\ f' m = 0.
  Proof.
    intro is. assert (crossed : forall n k, left (nested c n) <= right (nested c k)).
    { intros n k. pose proof (nested_within c n k). pose proof (nested_within c k n) as other. rewrite Nat.add_comm in other.
      pose proof (proj1 (order (nested c (n + k)))). lra. }
    destruct (completeness (fun x => exists n, x = left (nested c n))) as [m [above least]].
    { exists (right c). intros x [n ->]. exact (crossed n O). }
    { now exists (left c), O. }
    assert (inside : forall n, left (nested c n) <= m <= right (nested c n)).
    { intro n. split; [apply above; now exists n|]. apply least. intros x [k ->]. apply crossed. }
    exists m. split; [exact (inside O)|]. destruct (Req_dec (f' m) 0) as [zero|other]; [exact zero|exfalso]. apply Rabs_pos_lt in other.
    set (e := Rabs (f' m) / 2). destruct (is m e ltac:(unfold e; lra)) as [d near]. pose proof (cond_pos d) as positive.
    assert (bound : forall x, Rabs (x - m) < d -> - (e * Rabs (x - m)) <= f x - f m - f' m * (x - m) <= e * Rabs (x - m)).
    { intros x close. destruct (Req_dec x m) as [->|apart]; [rewrite !Rminus_diag_eq, Rabs_R0 by reflexivity; lra|].
      specialize (near (x - m) ltac:(lra) close). replace (m + (x - m)) with x in near by ring.
      assert (all : Rabs (f x - f m - f' m * (x - m)) <= e * Rabs (x - m)).
      { replace (f x - f m - f' m * (x - m)) with (((f x - f m) / (x - m) - f' m) * (x - m)) by (field; lra).
        rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|lra]. }
      pose proof (Rle_abs (f x - f m - f' m * (x - m))). pose proof (Rle_abs (- (f x - f m - f' m * (x - m)))). rewrite Rabs_Ropp in *. lra. }
    destruct (pow_lt_1_zero (/ 2) ltac:(rewrite Rabs_right; lra) (d / (right c - left c))) as [n small].
    { apply Rdiv_lt_0_compat; [exact positive|]. pose proof (order c). lra. }
    specialize (small n (le_n n)). pose proof (Rle_abs ((/ 2) ^ n)). pose proof (order c) as [less _]. pose proof (nested_short c n) as short.
    assert (narrow : right (nested c n) - left (nested c n) < d).
    { rewrite short. apply Rlt_le_trans with ((right c - left c) * (d / (right c - left c))); [apply Rmult_lt_compat_l; lra|]. right. field. lra. }
    destruct (order (nested c n)) as [step same]. specialize (inside n). set (p := left (nested c n)) in *. set (q := right (nested c n)) in *.
    assert (p_size : Rabs (p - m) = m - p) by (rewrite Rabs_left1; lra). assert (q_size : Rabs (q - m) = q - m) by (rewrite Rabs_right; lra).
    pose proof (bound p ltac:(lra)) as first. pose proof (bound q ltac:(lra)) as second. rewrite p_size in first. rewrite q_size in second. rewrite same in first.
    assert (sum : - (e * (q - p)) <= f' m * (q - p) <= e * (q - p)) by lra.
    assert (- e <= f' m <= e) by (split; apply Rmult_le_reg_r with (q - p); lra).
    assert (Rabs (f' m) <= e) by now apply Rabs_le. unfold e in *. lra.
  Qed.
End Halving.

Lemma line_derivative a b x : derivable_pt_lim (fun y => a * (y - b)) x a.
Proof.
  cut (derivable_pt_lim (fun y => a * (y - b)) x (a * (1 - 0))); [now replace (a * (1 - 0)) with a by ring|].
  exact (derivable_pt_lim_scal _ a x _ (derivable_pt_lim_minus id (fct_cte b) x _ _ (derivable_pt_lim_id x) (derivable_pt_lim_const b x))).
Qed.

Lemma mean_value_between f f' a b : a < b -> (forall x, derivable_pt_lim f x (f' x)) -> exists m, a <= m <= b /\ f b - f a = f' m * (b - a).
Proof.
  intros less is. set (slope := (f b - f a) / (b - a)). set (h := fun x => f x - slope * (x - a)).
  assert (h_is : forall x, derivable_pt_lim h x (f' x - slope)) by (intro x; exact (derivable_pt_lim_minus _ _ x _ _ (is x) (line_derivative slope a x))).
  assert (whole : continuity h) by (intro x; apply derivable_continuous_pt; exists (f' x - slope); apply h_is).
  assert (good : fst (a, b) < snd (a, b) /\ h (fst (a, b)) = h (snd (a, b))) by (cbn [fst snd]; split; [exact less|unfold h, slope; field; lra]).
  destruct (rolle h whole (exist _ (a, b) good) _ h_is) as (m & inside & zero). unfold left, right in inside. cbn [proj1_sig fst snd] in inside.
  exists m. split; [exact inside|]. replace (f' m) with slope by lra. unfold slope. field. lra.
Qed.

Lemma mean_value f f' a b : (forall x, derivable_pt_lim f x (f' x)) -> exists m, (a <= m <= b \/ b <= m <= a) /\ f b - f a = f' m * (b - a).
Proof.
  intro is. destruct (Rtotal_order a b) as [less|[<-|more]].
  - destruct (mean_value_between f f' a b less is) as (m & inside & equal). exists m. split; [left; lra|exact equal].
  - exists a. split; [left; lra|ring].
  - destruct (mean_value_between f f' b a more is) as (m & inside & equal). exists m. split; [right; lra|lra].
Qed.
