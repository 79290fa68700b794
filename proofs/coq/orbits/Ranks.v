(* Descent by a rank with several components, each the greatest of the terms whose guard holds, for any set of states and any map f.

   Component c of the rank is the greatest of the terms `term i c`, i < count, whose guard i holds; `above_rank s v` says that v is at least
   the rank of s, in each component. On every step outside of the stages some component falls by 1, and none before it grows.

   Defined:  above_rank, smaller (one component falls by 1, and none before it grows).
   Proved:   smaller_ends             there is no endless descent of vectors that are not negative;
             lexicographic_descent    every orbit is in the last of the stages from some step on;
             greatest_descent         with one component, from the step on that Rules.descent tells. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules.
Open Scope R_scope.

Definition smaller (size : nat) (u v : nat -> R) : Prop :=
  exists c, (c < size)%nat /\ (forall b, (b < c)%nat -> u b <= v b) /\ u c <= v c - 1.
Definition not_negative (size : nat) (v : nat -> R) : Prop := forall c, (c < size)%nat -> 0 <= v c.
Definition descends_to (size : nat) (u v : nat -> R) : Prop := not_negative size u /\ smaller size u v.

Theorem smaller_ends size : forall v, not_negative size v -> Acc (descends_to size) v.
Proof.
  induction size as [|size IH]; intros v positive; [constructor; intros u [_ (c & none & _)]; lia|].
  assert (bounded : forall n w, Acc (descends_to size) w -> forall v, (fun c => v (S c)) = w -> not_negative (S size) v -> v O < INR n ->
    Acc (descends_to (S size)) v).
  { clear v positive. induction n as [|n less]; intros w ends; [intros v _ positive below|].
    - specialize (positive O ltac:(lia)). cbn in below. lra.
    - induction ends as [w _ after]. intros v same positive below. rewrite S_INR in below. constructor.
      intros u [u_positive (c & small & before & drop)].
      assert (rest : not_negative size (fun c => u (S c))) by (intros b lower; apply u_positive; lia).
      destruct c as [|c].
      + apply (less (fun c => u (S c))); [now apply IH|reflexivity|exact u_positive|lra].
      + apply (after (fun c => u (S c))); [|reflexivity|exact u_positive|specialize (before O ltac:(lia)); rewrite S_INR; lra].
        split; [exact rest|]. exists c. rewrite <- same. split; [lia|]. split; [|exact drop]. intros b lower. apply before. lia. }
  destruct (exceeded_by_a_number (v O + 1)) as [n high]. apply (bounded n (fun c => v (S c))); [|reflexivity|exact positive|lra].
  apply IH. intros c small. apply positive. lia.
Qed.

Section Ranks.
  Context {State : Type}.
  Variables (f : State -> State) (space : State -> Prop) (stages : list (State -> Prop)).
  Variables (guard : nat -> State -> Prop) (term : nat -> nat -> State -> R) (count size : nat).

  Definition above_rank (s : State) (v : nat -> R) : Prop :=
    forall i c, (i < count)%nat -> (c < size)%nat -> guard i s -> term i c s <= v c.

  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis rank_nonnegative : forall s v, space s -> above_rank s v -> not_negative size v.
  Hypothesis rank_falls : forall s v, space s -> above_rank s v -> (exists k, stage stages k s) \/
    exists c, (c < size)%nat /\ forall i, (i < count)%nat -> guard i (f s) ->
      (forall b, (b < c)%nat -> term i b (f s) <= v b) /\ term i c (f s) <= v c - 1.
  Hypothesis stage_leads_on : forall k s, (S k < length stages)%nat -> space s -> stage stages k s -> stage stages (S k) (f s).
  Hypothesis last_stage_invariant : forall s, space s -> last_stage stages s -> last_stage stages (f s).

  (* What is at least a component, whatever the guards are. *)
  Fixpoint top (n c : nat) (s : State) : R := match n with O => 0 | S k => Rmax (top k c s) (term k c s) end.

  Lemma top_is_above n c s : forall i, (i < n)%nat -> term i c s <= top n c s.
  Proof.
    induction n as [|n IH]; intros i less; [lia|]. cbn. pose proof (Rmax_l (top n c s) (term n c s)). pose proof (Rmax_r (top n c s) (term n c s)).
    destruct (Nat.eq_dec i n) as [->|other]; [lra|]. specialize (IH i ltac:(lia)). lra.
  Qed.

  Lemma stays_in_the_last j k s n : space s -> stage stages k (iterate f j s) -> (j + (length stages - 1) <= n)%nat ->
    last_stage stages (iterate f n s).
  Proof.
    intros inside staged late. replace n with (j + (n - j))%nat by lia. rewrite iterate_add.
    apply (stages_end_in_the_last f space stages) with (k := k); try assumption; [now apply iterate_keeps|lia].
  Qed.

  Lemma enters v : Acc (descends_to size) v -> forall s, space s -> above_rank s v -> exists j k, stage stages k (iterate f j s).
  Proof.
    intro ends. induction ends as [v _ IH]. intros s inside high.
    destruct (rank_falls s v inside high) as [[k staged]|(c & small & falls)]; [now exists 0%nat, k|].
    set (next := fun b => if Nat.ltb b c then v b else if Nat.eqb b c then v c - 1 else top count b (f s)).
    assert (high_next : above_rank (f s) next).
    { intros i b less _ here. destruct (falls i less here) as [before drop]. unfold next.
      destruct (Nat.ltb_spec b c) as [lower|]; [now apply before|]. destruct (Nat.eqb_spec b c) as [->|]; [exact drop|now apply top_is_above]. }
    destruct (IH next) with (s := f s) as (j & k & staged); [|now apply space_invariant|exact high_next|].
    - split; [exact (rank_nonnegative (f s) next (space_invariant s inside) high_next)|]. exists c. split; [exact small|]. unfold next. split.
      + intros b lower. destruct (Nat.ltb_spec b c); [lra|lia].
      + rewrite Nat.ltb_irrefl, Nat.eqb_refl. lra.
    - exists (S j), k. now rewrite iterate_step.
  Qed.

  Theorem lexicographic_descent s : space s -> exists N, forall n, (N <= n)%nat -> last_stage stages (iterate f n s).
  Proof.
    intro inside. assert (high : above_rank s (fun c => top count c s)) by (intros i c less _ _; now apply top_is_above).
    destruct (enters _ (smaller_ends size _ (rank_nonnegative s _ inside high)) s inside high) as (j & k & staged).
    exists (j + (length stages - 1))%nat. intros n late. now apply (stays_in_the_last j k).
  Qed.

  Hypothesis one_component : size = 1%nat.

  Lemma enters_in_time n : forall s v, space s -> above_rank s v -> v O < INR n -> exists j k, INR j <= v O /\ stage stages k (iterate f j s).
  Proof.
    induction n as [|n IH]; intros s v inside high below; pose proof (rank_nonnegative s v inside high O ltac:(lia)) as positive.
    - cbn in below. lra.
    - destruct (rank_falls s v inside high) as [[k staged]|(c & small & falls)]; [now exists 0%nat, k|]. rewrite S_INR in below.
      destruct (IH (f s) (fun _ => v O - 1)) as (j & k & early & staged); [now apply space_invariant| |lra|].
      + intros i b less lower here. replace b with c by lia. destruct (falls i less here) as [_ drop].
        replace c with O in * by lia. exact drop.
      + exists (S j), k. rewrite S_INR, iterate_step. split; [lra|exact staged].
  Qed.

  Theorem greatest_descent s v n : space s -> above_rank s v -> v O + INR (length stages - 1) <= INR n -> last_stage stages (iterate f n s).
  Proof.
    intros inside high late. destruct (enters_in_time (S n) s v inside high) as (j & k & early & staged).
    { rewrite S_INR. pose proof (pos_INR (length stages - 1)). lra. }
    apply (stays_in_the_last j k); [exact inside|exact staged|]. apply INR_le. rewrite plus_INR. lra.
  Qed.
End Ranks.
