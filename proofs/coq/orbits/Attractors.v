(* The rule on several attractors, for any set of states, any map f in pieces, and any words of pieces.

   Words are lists of the numbers of pieces. A state follows a word where its pieces apply to s, f s, and so on, all of them in the space and in the
   last stage of a descent. Coordinates are indexed by any type.

   Defined:  factor, tail_of (a word in another, at its end), left_after (what the checker keeps of the words that hold none of some words),
             follows, pieces_from.
   Proved:   none_is_left    where nothing is left after n letters, every word of n letters holds one of the words;
             follows_own     a state follows the pieces that apply from it on;
             an_end_is_met   so some state of the next n is in the set of an end, where every word of n letters holds one that no state follows, or
                             the word of an end;
             settles         and every orbit tends to the point of one of the ends.
   That each point is stable is concluded of its contraction, by Rules.v. *)

From Coq Require Import Reals Lia List.
From Juggleproof Require Import Rules.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- words *)

Definition factor (u w : list nat) : Prop := exists before after, w = before ++ u ++ after.
Definition tail_of (e w : list nat) : Prop := exists before, w = before ++ e.

Fixpoint tails (w : list nat) : list (list nat) := w :: match w with [] => [] | _ :: rest => tails rest end.

Fixpoint begins (e u : list nat) : bool :=
  match e, u with
  | [], _ :: _ => true
  | a :: e, b :: u => Nat.eqb a b && begins e u
  | _, _ => false
  end.

Definition same (u w : list nat) : bool := if list_eq_dec Nat.eq_dec u w then true else false.

Lemma tails_are_tails e w : In e (tails w) -> tail_of e w.
Proof.
  induction w as [|k w IH]; cbn; intros [<-|inside]; try (now exists []).
  destruct (IH inside) as [before ->]. now exists (k :: before).
Qed.

Section Words.
  Variables (words : list (list nat)) (letters : list nat).

  Definition held (w : list nat) : bool := existsb (fun e => existsb (same e) words) (tails w).
  (* The longest end with which a word begins; any end would do. *)
  Definition kept (w : list nat) : list nat :=
    match find (fun e => existsb (begins e) words) (tails w) with Some e => e | None => [] end.
  Definition read_on (ends : list (list nat)) : list (list nat) :=
    nodup (list_eq_dec Nat.eq_dec)
      (map kept (filter (fun w => negb (held w)) (flat_map (fun e => map (fun k => e ++ [k]) letters) ends))).
  Fixpoint left_after (n : nat) : list (list nat) := match n with O => [[]] | S m => read_on (left_after m) end.

  Lemma kept_is_a_tail w : tail_of (kept w) w.
  Proof.
    unfold kept. destruct (find _ _) as [e|] eqn:found; [|exists w; symmetry; apply app_nil_r].
    apply tails_are_tails. now apply find_some in found.
  Qed.

  Lemma held_is_a_factor w : held w = true -> exists u, In u words /\ factor u w.
  Proof.
    unfold held. intro held_. apply existsb_exists in held_ as (e & inside & one). apply existsb_exists in one as (u & named & equal).
    unfold same in equal. destruct (list_eq_dec Nat.eq_dec e u) as [->|]; [|discriminate].
    exists u. split; [exact named|]. destruct (tails_are_tails u w inside) as [before ->]. exists before, []. now rewrite app_nil_r.
  Qed.

  Lemma one_or_an_end n : forall w, length w = n -> Forall (fun k => In k letters) w ->
    (exists u, In u words /\ factor u w) \/ exists e, In e (left_after n) /\ tail_of e w.
  Proof.
    induction n as [|n IH]; intros w long all; [right; exists []; split; [now left|now exists w; rewrite app_nil_r]|].
    destruct (exists_last (l := w)) as (first & k & ->); [intros ->; discriminate|].
    rewrite app_length in long. cbn in long. apply Forall_app in all as [before last]. inversion last as [|? ? letter _]. subst.
    destruct (IH first) as [(u & named & b & a & ->)|(e & inside & b & ->)]; [lia|exact before| |].
    - left. exists u. split; [exact named|]. exists b, (a ++ [k]). now rewrite <- !app_assoc.
    - destruct (held (e ++ [k])) eqn:stops.
      + left. destruct (held_is_a_factor _ stops) as (u & named & c & a & equal). exists u. split; [exact named|].
        exists (b ++ c), a. now rewrite <- !app_assoc, equal.
      + right. exists (kept (e ++ [k])). split.
        * cbn. unfold read_on. apply nodup_In, in_map, filter_In. split; [|now rewrite stops].
          apply in_flat_map. exists e. split; [exact inside|]. apply in_map_iff. now exists k.
        * destruct (kept_is_a_tail (e ++ [k])) as [c equal]. exists (b ++ c). now rewrite <- !app_assoc, <- equal.
  Qed.

  Theorem none_is_left n : left_after n = [] -> forall w, length w = n -> Forall (fun k => In k letters) w -> exists u, In u words /\ factor u w.
  Proof.
    intros none w long all. destruct (one_or_an_end n w long all) as [one|(e & inside & _)]; [exact one|]. rewrite none in inside. contradiction.
  Qed.
End Words.

(* Of 3 letters, every word of 2 holds one of these. *)
Example every_word_of_two_letters : left_after [[1]; [2; 2]; [2; 3]; [3; 2]; [3; 3]]%nat [1; 2; 3]%nat 2 = [].
Proof. reflexivity. Qed.

(* ---------------------------------------------------------------- orbits *)

Section Settling.
  Context {State Index End : Type}.
  Variables (f : State -> State) (coordinate : Index -> State -> R) (space last : State -> Prop) (guard : nat -> State -> Prop) (letters : list nat).

  Fixpoint follows (w : list nat) (s : State) : Prop :=
    match w with [] => True | k :: rest => space s /\ last s /\ guard k s /\ follows rest (f s) end.

  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis last_invariant : forall s, space s -> last s -> last (f s).
  Hypothesis some_piece : forall s, space s -> exists k, In k letters /\ guard k s.

  Lemma pieces_from n : forall s, space s -> last s -> exists w, length w = n /\ Forall (fun k => In k letters) w /\ follows w s.
  Proof.
    induction n as [|n IH]; intros s inside there; [now exists []; repeat split|].
    destruct (some_piece s inside) as (k & letter & applies).
    destruct (IH (f s)) as (w & long & all & along); [now apply space_invariant|now apply last_invariant|].
    exists (k :: w). repeat split; cbn; [now rewrite long|now constructor|assumption..].
  Qed.

  Lemma follows_a_factor before : forall u after s, follows (before ++ u ++ after) s -> follows u (iterate f (length before) s).
  Proof.
    induction before as [|k before IH]; intros u after s along.
    - revert s along. induction u as [|k u shorter]; intros s along; [exact I|].
      destruct along as (inside & there & applies & along). repeat split; try assumption. now apply shorter.
    - destruct along as (_ & _ & _ & along). cbn [length]. rewrite iterate_step. now apply (IH u after).
  Qed.

  Variables (never : list (list nat)) (ends : list End) (word : End -> list nat) (on : End -> State -> Prop) (point : End -> Index -> R) (n : nat).
  Hypothesis every_word : forall w, length w = n -> Forall (fun k => In k letters) w -> exists u, In u (never ++ map word ends) /\ factor u w.
  Hypothesis none_follows : forall u, In u never -> forall s, ~ follows u s.
  Hypothesis ends_lead : forall e, In e ends -> forall s, follows (word e) s -> on e s.

  Theorem an_end_is_met s : space s -> last s -> exists e j, In e ends /\ (j <= n)%nat /\ on e (iterate f j s).
  Proof.
    intros inside there. destruct (pieces_from n s inside there) as (w & long & all & along).
    destruct (every_word w long all) as (u & named & before & after & ->). rewrite app_length in long.
    pose proof (follows_a_factor before u after s along) as from. apply in_app_or in named as [no|some].
    - destruct (none_follows u no _ from).
    - apply in_map_iff in some as (e & <- & named). exists e, (length before). repeat split; [exact named|lia|now apply ends_lead].
  Qed.

  Hypothesis descends : forall s, space s -> exists N, last (iterate f N s).
  Hypothesis attracts : forall e, In e ends -> forall s, space s -> on e s -> converges f coordinate (point e) s.

  Theorem settles s : space s -> exists e, In e ends /\ converges f coordinate (point e) s.
  Proof.
    intro inside. destruct (descends s inside) as [N there].
    assert (kept_inside : forall j t, space t -> space (iterate f j t)) by (intro j; now apply iterate_keeps).
    destruct (an_end_is_met (iterate f N s)) as (e & j & named & _ & met); [now apply kept_inside|exact there|].
    rewrite <- iterate_add in met. exists e. split; [exact named|]. intros epsilon positive.
    destruct (attracts e named (iterate f (N + j) s) (kept_inside _ s inside) met epsilon positive) as [M near].
    exists (N + j + M)%nat. intros m late i. replace m with (N + j + (m - (N + j)))%nat by lia. rewrite iterate_add. apply near. lia.
  Qed.
End Settling.
