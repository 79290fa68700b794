(* The rule on several attractors, for any set of states, any map f in pieces, and any words of pieces.

   Words are lists of the numbers of pieces. A state follows a word where its pieces apply to s, f s, and so on, all of them in the space and in the
   last stage of a descent. Coordinates are indexed by any type.

   Defined:  factor, tail_of (a word in another, at its end), every_way_ends (what is checked of words: read a letter at a time, with a number that does
             not rise, each sequence holds one of them or goes round a repeated one), follows.
   Proved:   leads_on        the next letter ends one of the words, or leads lower, or round a repeated word;
             an_end_is_met   so some state of each orbit is in the set of an end, where no state follows the words `never`, and a rank falls with
                             each time that a repeated word is followed;
             settles         and every orbit tends to the point of one of the ends.
   That each point is stable is concluded of its contraction, by Rules.v. *)

From Coq Require Import Reals Lra Lia List.
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

Lemma same_is_equal u w : same u w = true -> u = w.
Proof. unfold same. now destruct (list_eq_dec Nat.eq_dec u w). Qed.

Lemma tails_are_tails e w : In e (tails w) -> tail_of e w.
Proof.
  induction w as [|k w IH]; cbn; intros [<-|inside]; try (now exists []).
  destruct (IH inside) as [before ->]. now exists (k :: before).
Qed.

Section Words.
  Variables (words repeated : list (list nat)) (letters : list nat).

  Definition held (w : list nat) : bool := existsb (fun e => existsb (same e) words) (tails w).
  (* The longest end with which a word begins; any end would do. *)
  Definition kept (w : list nat) : list nat :=
    match find (fun e => existsb (begins e) words) (tails w) with Some e => e | None => [] end.

  Lemma kept_is_a_tail w : tail_of (kept w) w.
  Proof.
    unfold kept. destruct (find _ _) as [e|] eqn:found; [|exists w; symmetry; apply app_nil_r].
    apply tails_are_tails. now apply find_some in found.
  Qed.

  Lemma held_is_a_factor w : held w = true -> exists u, In u words /\ factor u w.
  Proof.
    unfold held. intro held_. apply existsb_exists in held_ as (e & inside & one). apply existsb_exists in one as (u & named & equal).
    exists u. split; [exact named|]. apply same_is_equal in equal as ->.
    destruct (tails_are_tails u w inside) as [before ->]. exists before, []. now rewrite app_nil_r.
  Qed.

  (* An end that is kept; how many lie below it; of which repeated word it is on the circle; and how many letters of that are read. *)
  Record Place := place { end_of : list nat; height : nat; circle : nat; along : nat }.
  Variable places : list Place.

  Definition place_of (e : list nat) : option Place := find (fun p => same e (end_of p)) places.
  Definition round (i : nat) : list nat := nth i repeated [].
  Definition goes_round (p : Place) (k : nat) (q : Place) : bool :=
    Nat.eqb (height q) (height p) && Nat.eqb (circle q) (circle p) &&
    match nth_error (round (circle p)) (along p) with Some l => Nat.eqb k l | None => false end &&
    Nat.eqb (along q) (if Nat.eqb (S (along p)) (length (round (circle p))) then 0 else S (along p)).
  Definition leads (p : Place) (k : nat) : bool :=
    held (end_of p ++ [k]) ||
    match place_of (kept (end_of p ++ [k])) with Some q => Nat.ltb (height q) (height p) || goes_round p k q | None => false end.
  (* No letter leads higher, and all others but those round a circle lead lower, or to one of the words. *)
  Definition every_way_ends : bool :=
    match place_of [] with Some _ => true | None => false end && forallb (fun p => forallb (leads p) letters) places.

  Lemma place_is_of e p : place_of e = Some p -> In p places /\ end_of p = e.
  Proof. intro found. apply find_some in found as [inside equal]. split; [exact inside|]. symmetry. now apply same_is_equal. Qed.

  Lemma leads_on p k : every_way_ends = true -> In p places -> In k letters -> held (end_of p ++ [k]) = true \/
    exists q, place_of (kept (end_of p ++ [k])) = Some q /\ ((height q < height p)%nat \/ goes_round p k q = true).
  Proof.
    intros ends inside letter. apply andb_prop in ends as [_ all].
    apply (proj1 (forallb_forall _ _) all p), (proj1 (forallb_forall _ _)) with (x := k) in inside as way; [|exact letter].
    apply Bool.orb_prop in way as [now_|way]; [now left|right]. destruct (place_of _) as [q|]; [|discriminate].
    exists q. split; [reflexivity|]. apply Bool.orb_prop in way as [lower|same_]; [left; now apply Nat.ltb_lt|now right].
  Qed.
End Words.

(* Of 3 letters, all sequences hold one of these words, or are 1 2 1 2 .. at last. *)
Example every_way_of_three_letters :
  every_way_ends [[1; 1]; [2; 2]; [3]]%nat [[1; 2]]%nat [1; 2; 3]%nat [place [] 1 0 0; place [1] 0 0 1; place [2] 0 0 0]%nat = true.
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

  Lemma follows_both u : forall v s, follows (u ++ v) s <-> follows u s /\ follows v (iterate f (length u) s).
  Proof.
    induction u as [|k u IH]; intros v s; [cbn; tauto|]. cbn [app follows length]. rewrite iterate_step, IH. tauto.
  Qed.

  Lemma follows_a_factor before u after s : follows (before ++ u ++ after) s -> follows u (iterate f (length before) s).
  Proof. intro along_. apply follows_both in along_ as [_ along_]. now apply follows_both in along_ as [along_ _]. Qed.

  Variables (never repeated : list (list nat)) (ends : list End) (word : End -> list nat) (on : End -> State -> Prop) (point : End -> Index -> R).
  Variables (rank : nat -> State -> R) (places : list Place).
  Let words : list (list nat) := never ++ map word ends.
  Hypothesis all_end : every_way_ends words repeated letters places = true.
  Hypothesis none_follows : forall u, In u never -> forall s, ~ follows u s.
  Hypothesis falls : forall i, (i < length repeated)%nat -> forall s, follows (round repeated i) s ->
    0 <= rank i s /\ rank i (iterate f (length (round repeated i)) s) <= rank i s - 1.
  Hypothesis ends_lead : forall e, In e ends -> forall s, follows (word e) s -> on e s.

  Section From.
    Variable start : State.
    Hypotheses (inside : space start) (there : last start).
    Definition met : Prop := exists e j, In e ends /\ on e (iterate f j start).
    Definition after (w : list nat) : State := iterate f (length w) start.
    (* What is read from the start on ends as the place says. *)
    Definition reads (w : list nat) (p : Place) : Prop := In p places /\ follows w start /\ tail_of (end_of p) w.

    Lemma kept_there n : space (iterate f n start) /\ last (iterate f n start).
    Proof.
      induction n as [|n [IHs IHl]]; [now split|]. cbn. split; [now apply space_invariant|now apply last_invariant].
    Qed.

    Lemma reads_on w p : reads w p -> met \/ exists k q, reads (w ++ [k]) q /\ ((height q < height p)%nat \/ goes_round repeated p k q = true).
    Proof.
      intros (named & so_far & before & equal). destruct (kept_there (length w)) as [in_space in_last].
      destruct (some_piece _ in_space) as (k & letter & applies).
      assert (longer : follows (w ++ [k]) start) by (apply follows_both; cbn; tauto).
      destruct (leads_on words repeated letters places p k all_end named letter) as [stops|(q & found & way)].
      - left. destruct (held_is_a_factor _ _ stops) as (u & one & b & a & holds).
        assert (from : follows u (iterate f (length (before ++ b)) start)).
        { apply (follows_a_factor (before ++ b) u a). rewrite <- app_assoc, <- holds, app_assoc, <- equal. exact longer. }
        apply in_app_or in one as [no|some]; [destruct (none_follows u no _ from)|].
        apply in_map_iff in some as (e & <- & end_). exists e, (length (before ++ b)). split; [exact end_|now apply ends_lead].
      - right. exists k, q. split; [|exact way]. apply place_is_of in found as [placed is_end]. repeat split; [exact placed|exact longer|].
        rewrite is_end. destruct (kept_is_a_tail words (end_of p ++ [k])) as [more cut]. exists (before ++ more).
        now rewrite <- app_assoc, <- cut, app_assoc, <- equal.
    Qed.

    Lemma skips {A} (l : list A) : forall n x, nth_error l n = Some x -> skipn n l = x :: skipn (S n) l.
    Proof. induction l as [|a l IH]; intros [|n] x found; cbn in *; [discriminate..|now injection found as ->|now apply IH]. Qed.

    Section AtHeight.
      Variable h : nat.
      Hypothesis lower : forall w q, (height q < h)%nat -> reads w q -> met.

      (* The rest of the word is read, or an end is met. *)
      Lemma comes_round r : forall w p, reads w p -> height p = h -> (length (round repeated (circle p)) - along p = r)%nat ->
        met \/ exists q, reads (w ++ skipn (along p) (round repeated (circle p))) q /\ height q = h /\ circle q = circle p /\ along q = O /\
          round repeated (circle p) <> [].
      Proof.
        induction r as [|r IH]; intros w p from high rest.
        all: destruct (reads_on w p from) as [now_|(k & q & next & [less|goes])]; [now left|left; now apply (lower (w ++ [k]) q); [rewrite <- high|]|].
        all: unfold goes_round in goes; apply andb_prop in goes as [goes counts]; apply andb_prop in goes as [goes is_next].
        all: apply andb_prop in goes as [same_height same_circle]; apply Nat.eqb_eq in same_height, same_circle, counts.
        all: destruct (nth_error _ _) as [l|] eqn:found; [|discriminate]; apply Nat.eqb_eq in is_next as <-.
        all: assert (short : (along p < length (round repeated (circle p)))%nat) by (apply nth_error_Some; now rewrite found).
        { lia. }
        assert (some : round repeated (circle p) <> []) by (intro none; now rewrite none in short).
        rewrite (skips _ _ _ found).
        replace (w ++ k :: skipn (S (along p)) (round repeated (circle p))) with ((w ++ [k]) ++ skipn (S (along p)) (round repeated (circle p)))
          by now rewrite <- app_assoc.
        revert counts. destruct (Nat.eqb_spec (S (along p)) (length (round repeated (circle p)))) as [full|more]; intro counts.
        - right. exists q. rewrite full, skipn_all, app_nil_r, same_height. repeat split; assumption || apply next.
        - destruct (IH (w ++ [k]) q next) as [now_|(q' & reads_ & high' & circle' & along' & _)]; [lia|rewrite same_circle, counts; lia|now left|].
          right. exists q'. rewrite same_circle, counts in reads_. rewrite circle', same_circle. repeat split; assumption || apply reads_.
      Qed.

      Lemma comes_round_to_an_end n : forall w p, reads w p -> height p = h -> along p = O -> rank (circle p) (after w) < INR n -> met.
      Proof.
        induction n as [|n IH]; intros w p from high fresh small.
        all: destruct (comes_round _ w p from high eq_refl) as [now_|(q & next & high' & circle' & fresh' & some)]; [exact now_|].
        all: rewrite fresh in next; cbn [skipn] in next; destruct next as (named & along_ & tail).
        all: assert (number : (circle p < length repeated)%nat) by
          (destruct (Nat.lt_ge_cases (circle p) (length repeated)) as [less|beyond]; [exact less|]; destruct some; now apply nth_overflow).
        all: destruct (falls _ number (after w)) as [positive less]; [now apply follows_both in along_|].
        { cbn in small. lra. }
        apply (IH (w ++ round repeated (circle p)) q); [now repeat split|exact high'|exact fresh'|].
        rewrite circle'. unfold after in *. rewrite app_length, iterate_add. rewrite S_INR in small. lra.
      Qed.
    End AtHeight.

    Theorem an_end_is_met : met.
    Proof.
      assert (all : forall h w p, height p = h -> reads w p -> met).
      { induction h as [h lower] using (well_founded_induction lt_wf). intros w p high from.
        assert (below : forall v q, (height q < h)%nat -> reads v q -> met) by (intros v q less; now apply (lower (height q) less v q)).
        destruct (comes_round h below _ w p from high eq_refl) as [now_|(q & next & high' & _ & fresh & _)]; [exact now_|].
        destruct (exceeded_by_a_number (rank (circle q) (after (w ++ skipn (along p) (round repeated (circle p)))) + 1)) as [n large].
        apply (comes_round_to_an_end h below n _ q next high' fresh). lra. }
      pose proof all_end as first. apply andb_prop in first as [first _]. destruct (place_of places []) as [p|] eqn:found; [|discriminate].
      apply place_is_of in found as [named is_end]. apply (all (height p) [] p); [reflexivity|]. repeat split; [exact named|]. now exists [].
    Qed.
  End From.

  Hypothesis descends : forall s, space s -> exists N, last (iterate f N s).
  Hypothesis attracts : forall e, In e ends -> forall s, space s -> on e s -> converges f coordinate (point e) s.

  Theorem settles s : space s -> exists e, In e ends /\ converges f coordinate (point e) s.
  Proof.
    intro inside. destruct (descends s inside) as [N there].
    assert (kept_inside : forall j t, space t -> space (iterate f j t)) by (intro j; now apply iterate_keeps).
    destruct (an_end_is_met (iterate f N s)) as (e & j & named & met_); [now apply kept_inside|exact there|].
    rewrite <- iterate_add in met_. exists e. split; [exact named|]. intros epsilon positive.
    destruct (attracts e named (iterate f (N + j) s) (kept_inside _ s inside) met_ epsilon positive) as [M near].
    exists (N + j + M)%nat. intros m late i. replace m with (N + j + (m - (N + j)))%nat by lia. rewrite iterate_add. apply near. lia.
  Qed.
End Settling.
