(* The rule on a map g that makes several steps of a map f at once, for any set of states, and maps in any pieces.

   Words are lists of the numbers of pieces of f, and each piece of g has one. Coordinates are indexed by any type.

   Defined:  near, tends, continuous (at a state, of a function and of a map), leads, run (along a word), joins (an orbit comes to that of a state,
             step for step), orbit_stable.
   Proved:   tends_plus, .., tends_divided, by_coordinates   what is written with + - * / and powers is continuous where it divides by nothing that is 0;
             runs             the steps of f along a word;
             continuous_along f^j is continuous where it goes along one word;
             comes_back, stays_near, comes_near, an_end   where one piece of g applies around a stable fixed point of g, the orbit of this under f is
                              periodic and stable, and an orbit whose returns tend to the point comes to that of the point. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules.
Import ListNotations.
Open Scope R_scope.

(* ---------------------------------------------------------------- continuity *)

Section Continuity.
  Context {State Index : Type}.
  Variable (coordinate : Index -> State -> R).

  Definition near (c : R) (s t : State) : Prop := forall j, Rabs (coordinate j s - coordinate j t) < c.
  Definition tends (h : State -> R) (t : State) : Prop :=
    forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\ forall s, near delta s t -> Rabs (h s - h t) < epsilon.
  Definition continuous (h : State -> State) (t : State) : Prop :=
    forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\ forall s, near delta s t -> near epsilon (h s) (h t).

  Lemma near_less c d s t : c <= d -> near c s t -> near d s t.
  Proof. intros less close j. specialize (close j). lra. Qed.

  Lemma near_itself c s : 0 < c -> near c s s.
  Proof. intros positive j. now rewrite Rminus_diag_eq, Rabs_R0. Qed.

  Lemma tends_same h k t : (forall s, h s = k s) -> tends h t -> tends k t.
  Proof.
    intros same goes epsilon positive. destruct (goes epsilon positive) as (delta & some & close).
    exists delta. split; [exact some|]. intros s nearby. rewrite <- !same. now apply close.
  Qed.

  Lemma tends_constant c t : tends (fun _ => c) t.
  Proof. intros epsilon positive. exists 1. split; [lra|]. intros s _. now rewrite Rminus_diag_eq, Rabs_R0. Qed.

  Lemma tends_coordinate j t : tends (fun s => coordinate j s) t.
  Proof. intros epsilon positive. exists epsilon. split; [exact positive|]. intros s close. apply close. Qed.

  Lemma tends_plus h k t : tends h t -> tends k t -> tends (fun s => h s + k s) t.
  Proof.
    intros one two epsilon positive.
    destruct (one (epsilon / 2) ltac:(lra)) as (c & c_positive & near_one), (two (epsilon / 2) ltac:(lra)) as (d & d_positive & near_two).
    exists (Rmin c d). split; [now apply Rmin_glb_lt|]. intros s close.
    pose proof (near_one s (near_less _ _ _ _ (Rmin_l c d) close)) as first.
    pose proof (near_two s (near_less _ _ _ _ (Rmin_r c d) close)) as second.
    pose proof (Rabs_triang (h s - h t) (k s - k t)).
    replace (h s + k s - (h t + k t)) with (h s - h t + (k s - k t)) by ring. lra.
  Qed.

  (* What is continuous in one variable is so of a function. *)
  Lemma tends_through phi h t : continuity_pt phi (h t) -> tends h t -> tends (fun s => phi (h s)) t.
  Proof.
    intros goes one epsilon positive. destruct (goes epsilon positive) as (c & c_positive & close_to).
    destruct (one c c_positive) as (delta & some & nearby). exists delta. split; [exact some|]. intros s close.
    destruct (Req_dec (h t) (h s)) as [<-|apart]; [now rewrite Rminus_diag_eq, Rabs_R0|].
    apply (close_to (h s)). split; [now split|]. now apply nearby.
  Qed.

  Lemma tends_scaled c h t : tends h t -> tends (fun s => c * h s) t.
  Proof. apply (tends_through (fun y => c * y)). apply derivable_continuous_pt. reg. Qed.

  Lemma tends_opposite h t : tends h t -> tends (fun s => - h s) t.
  Proof. apply (tends_through (fun y => - y)). apply derivable_continuous_pt. reg. Qed.

  Lemma tends_minus h k t : tends h t -> tends k t -> tends (fun s => h s - k s) t.
  Proof. intros one two. exact (tends_plus h (fun s => - k s) t one (tends_opposite k t two)). Qed.

  Lemma tends_power h n t : tends h t -> tends (fun s => h s ^ n) t.
  Proof. apply (tends_through (fun y => y ^ n)). apply derivable_continuous_pt. apply derivable_pt_pow. Qed.

  (* A product by squares: 4 h k = (h + k)^2 - (h - k)^2. *)
  Lemma tends_times h k t : tends h t -> tends k t -> tends (fun s => h s * k s) t.
  Proof.
    intros one two. apply (tends_same (fun s => / 4 * ((h s + k s) ^ 2 - (h s - k s) ^ 2))); [intro s; field|].
    apply (tends_scaled (/ 4) (fun s => (h s + k s) ^ 2 - (h s - k s) ^ 2)).
    apply (tends_minus (fun s => (h s + k s) ^ 2) (fun s => (h s - k s) ^ 2)).
    - apply (tends_power (fun s => h s + k s)). now apply tends_plus.
    - apply (tends_power (fun s => h s - k s)). now apply tends_minus.
  Qed.

  Lemma tends_divided h k t : k t <> 0 -> tends h t -> tends k t -> tends (fun s => h s / k s) t.
  Proof.
    intros apart one two. apply (tends_times h (fun s => / k s) t one). apply (tends_through (fun y => / y)); [|exact two].
    exact (continuity_pt_inv id (k t) (derivable_continuous_pt _ _ (derivable_pt_id _)) apart).
  Qed.

  Lemma by_coordinates (axes : list Index) h t : (forall j, In j axes) -> (forall j, tends (fun s => coordinate j (h s)) t) -> continuous h t.
  Proof.
    intros all each epsilon positive.
    assert (some : exists delta, 0 < delta /\ forall s, near delta s t -> forall j, In j axes -> Rabs (coordinate j (h s) - coordinate j (h t)) < epsilon).
    { clear all. induction axes as [|i axes (c & c_positive & others)]; [exists 1; split; [lra|intros _ _ _ []]|].
      destruct (each i epsilon positive) as (d & d_positive & this). exists (Rmin c d). split; [now apply Rmin_glb_lt|].
      intros s close j [<-|inside]; [exact (this s (near_less _ _ _ _ (Rmin_r c d) close))|].
      exact (others s (near_less _ _ _ _ (Rmin_l c d) close) j inside). }
    destruct some as (delta & delta_positive & close). exists delta. split; [exact delta_positive|].
    intros s nearby j. exact (close s nearby j (all j)).
  Qed.
End Continuity.

(* That a written term is continuous; the tactic is for what it divides by. *)
Ltac all_tend nonzero :=
  first
    [ apply tends_constant
    | apply tends_coordinate
    | apply tends_power; all_tend nonzero
    | apply tends_divided; [nonzero|all_tend nonzero|all_tend nonzero]
    | apply tends_minus; all_tend nonzero
    | apply tends_opposite; all_tend nonzero
    | apply tends_plus; all_tend nonzero
    | apply tends_times; all_tend nonzero ].

(* A product or power of what facts say is not 0. *)
Ltac apart_from_0 :=
  repeat first [apply Rmult_integral_contrapositive_currified|apply pow_nonzero];
  first [assumption|let zero := fresh in intro zero; first [lra|nra|match goal with other : _ <> 0 |- _ => apply other; lra end]].

(* ---------------------------------------------------------------- words *)

Section Returns.
  Context {State Index : Type}.
  Variables (coordinate : Index -> State -> R) (f : State -> State) (space : State -> Prop).
  Variables (guard : nat -> State -> Prop) (image : nat -> State -> State).

  Fixpoint leads (w : list nat) (s : State) : Prop := match w with [] => True | k :: rest => guard k s /\ leads rest (image k s) end.
  Fixpoint run (w : list nat) (s : State) : State := match w with [] => s | k :: rest => run rest (image k s) end.

  Definition joins (e s : State) : Prop :=
    exists N, forall epsilon, 0 < epsilon -> exists M, forall n, (M <= n)%nat -> near coordinate epsilon (iterate f (N + n) s) (iterate f n e).
  Definition orbit_stable (e : State) : Prop :=
    forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
    forall s, space s -> near coordinate delta s e -> forall n, near coordinate epsilon (iterate f n s) (iterate f n e).

  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis piece_applies : forall k s, space s -> guard k s -> f s = image k s.
  Hypothesis piece_continuous : forall k s, space s -> guard k s -> continuous coordinate (image k) s.

  Lemma runs w : forall s, space s -> leads w s -> iterate f (length w) s = run w s.
  Proof.
    induction w as [|k w IH]; intros s inside along; [reflexivity|]. destruct along as [applies along].
    cbn [length]. rewrite iterate_step, (piece_applies k s inside applies). cbn. apply IH; [|exact along].
    rewrite <- (piece_applies k s inside applies). now apply space_invariant.
  Qed.

  (* The states j <= the length of the word after those that it leads from. *)
  Lemma continuous_along (on : State -> Prop) (e : State) w : (forall s, on s -> space s /\ leads w s) -> on e ->
    forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
    forall s, on s -> near coordinate delta s e -> forall j, (j <= length w)%nat -> near coordinate epsilon (iterate f j s) (iterate f j e).
  Proof.
    intros from there epsilon positive.
    assert (step : forall w h t, space t -> leads w t -> (forall s, on s -> space (h s) /\ leads w (h s)) ->
      (forall c, 0 < c -> exists delta, 0 < delta /\ forall s, on s -> near coordinate delta s e -> near coordinate c (h s) t) ->
      exists delta, 0 < delta /\
      forall s, on s -> near coordinate delta s e -> forall j, (j <= length w)%nat -> near coordinate epsilon (iterate f j (h s)) (iterate f j t)).
    { clear w from. induction w as [|k w IH]; intros h t inside along from goes.
      - destruct (goes epsilon positive) as (delta & some & close). exists delta. split; [exact some|].
        intros s here nearby j none. replace j with 0%nat by (cbn in none; lia). now apply close.
      - destruct along as [applies along].
        assert (next : forall s, space s -> guard k s -> space (image k s)).
        { intros s inside_ applies_. rewrite <- (piece_applies k s inside_ applies_). now apply space_invariant. }
        destruct (IH (fun s => image k (h s)) (image k t)) as (c & c_positive & later); [now apply next|exact along| | |].
        { intros s here. destruct (from s here) as [inside_ [applies_ along_]]. split; [now apply next|exact along_]. }
        { intros b b_positive. destruct (piece_continuous k t inside applies b b_positive) as (d & d_positive & close).
          destruct (goes d d_positive) as (delta & some & nearby). exists delta. split; [exact some|]. intros s here near_. now apply close, nearby. }
        destruct (goes epsilon positive) as (d & d_positive & first). exists (Rmin c d). split; [now apply Rmin_glb_lt|].
        intros s here nearby [|j] early; [exact (first s here (near_less _ _ _ _ _ (Rmin_r c d) nearby))|].
        destruct (from s here) as [inside_ [applies_ _]].
        rewrite !iterate_step, (piece_applies k t inside applies), (piece_applies k (h s) inside_ applies_).
        apply (later s here (near_less _ _ _ _ _ (Rmin_l c d) nearby)). cbn in early. lia. }
    destruct (from e there) as [inside along]. apply (step w (fun s => s) e inside along from).
    intros c c_positive. exists c. now split.
  Qed.

  (* ---------------------------------------------------------------- orbits *)

  Variables (g : State -> State) (piece : nat -> State -> Prop) (letters : list nat) (word : nat -> list nat).
  Hypothesis some_piece : forall s, space s -> exists k, In k letters /\ piece k s.
  Hypothesis has_steps : forall k, In k letters -> word k <> [].
  Hypothesis goes_along : forall k s, In k letters -> space s -> piece k s -> leads (word k) s /\ g s = run (word k) s.

  Lemma one_return k s : In k letters -> space s -> piece k s -> g s = iterate f (length (word k)) s.
  Proof. intros letter inside applies. destruct (goes_along k s letter inside applies) as [along ->]. now rewrite runs. Qed.

  Lemma returns_inside n : forall s, space s -> space (iterate g n s) /\ exists N, iterate g n s = iterate f N s.
  Proof.
    induction n as [|n IH]; intros s inside; [split; [exact inside|now exists 0%nat]|].
    destruct (some_piece s inside) as (k & letter & applies). rewrite iterate_step, (one_return k s letter inside applies).
    destruct (IH (iterate f (length (word k)) s)) as (kept & N & same); [now apply iterate_keeps|]. split; [exact kept|].
    exists (length (word k) + N)%nat. now rewrite iterate_add.
  Qed.

  (* An end: a state e that g fixes, with states around it to which one piece k of g applies. *)
  Variables (e : State) (on : State -> Prop) (k : nat).
  Hypothesis letter : In k letters.
  Hypothesis on_inside : forall s, on s -> space s.
  Hypothesis on_kept : forall s, on s -> on (g s).
  Hypothesis on_one_piece : forall s, on s -> piece k s.
  Hypothesis point_inside : space e.
  Hypothesis point_fixed : g e = e.
  Hypothesis surrounded : exists c, 0 < c /\ forall s, space s -> near coordinate c s e -> on s.

  Lemma point_on : on e.
  Proof. destruct surrounded as (c & positive & around). apply around; [exact point_inside|now apply near_itself]. Qed.

  Lemma all_returns n s : on s -> on (iterate g n s) /\ iterate g n s = iterate f (length (word k) * n) s.
  Proof.
    intro there. split; [now apply iterate_keeps|]. induction n as [|n IH]; [now rewrite Nat.mul_0_r|].
    rewrite Nat.mul_succ_r, iterate_add, <- IH. cbn [iterate].
    apply one_return; [exact letter|apply on_inside|apply on_one_piece]; now apply iterate_keeps.
  Qed.

  Theorem comes_back : iterate f (length (word k)) e = e.
  Proof. pose proof (all_returns 1 e point_on) as [_ same]. rewrite Nat.mul_1_r in same. rewrite <- same. exact point_fixed. Qed.

  (* Where returns are near e, so is the orbit to that of e. *)
  Lemma between epsilon : 0 < epsilon -> exists delta, 0 < delta /\ forall s M, on s ->
    (forall n, (M <= n)%nat -> near coordinate delta (iterate g n s) e) ->
    forall n, (length (word k) * M <= n)%nat -> near coordinate epsilon (iterate f n s) (iterate f n e).
  Proof.
    intro positive. destruct (continuous_along on e (word k)) with (epsilon := epsilon) as (delta & some & close); [|exact point_on|exact positive|].
    { intros s there. split; [now apply on_inside|]. apply goes_along; [exact letter|now apply on_inside|now apply on_one_piece]. }
    exists delta. split; [exact some|]. intros s M there late n after.
    assert (long : length (word k) <> 0%nat) by (intro none; apply (has_steps k letter); now apply length_zero_iff_nil).
    rewrite (Nat.div_mod n (length (word k)) long), !iterate_add.
    rewrite <- (proj2 (all_returns _ s there)), (iterate_periodic f _ e comes_back).
    apply close; [now apply all_returns| |].
    - apply late. apply Nat.div_le_lower_bound; assumption.
    - apply Nat.lt_le_incl, Nat.mod_upper_bound, long.
  Qed.

  Hypothesis stable : forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
    forall s, space s -> near coordinate delta s e -> forall n, near coordinate epsilon (iterate g n s) e.

  Theorem stays_near : orbit_stable e.
  Proof.
    intros epsilon positive. destruct (between epsilon positive) as (c & c_positive & close).
    destruct (stable c c_positive) as (d & d_positive & stays). destruct surrounded as (b & b_positive & around).
    exists (Rmin b d). split; [now apply Rmin_glb_lt|]. intros s inside nearby n.
    apply (close s 0%nat); [|intros m _|rewrite Nat.mul_0_r; lia].
    - exact (around s inside (near_less _ _ _ _ _ (Rmin_l b d) nearby)).
    - exact (stays s inside (near_less _ _ _ _ _ (Rmin_r b d) nearby) m).
  Qed.

  Theorem comes_near s : space s -> converges g coordinate (fun j => coordinate j e) s -> joins e s.
  Proof.
    intros inside goes. destruct surrounded as (b & b_positive & around). destruct (goes b b_positive) as (M & enters).
    destruct (returns_inside M s inside) as (kept & N & same).
    assert (there : on (iterate g M s)) by (apply around; [exact kept|exact (enters M (le_n M))]).
    exists N. intros epsilon positive. destruct (between epsilon positive) as (c & c_positive & close).
    destruct (goes c c_positive) as (L & later). exists (length (word k) * L)%nat. intros n after.
    rewrite iterate_add, <- same. apply (close _ L there); [|exact after]. intros m late. rewrite <- iterate_add. exact (later (M + m)%nat ltac:(lia)).
  Qed.

  Theorem an_end : iterate f (length (word k)) e = e /\ orbit_stable e /\
    forall s, space s -> converges g coordinate (fun j => coordinate j e) s -> joins e s.
  Proof. exact (conj comes_back (conj stays_near comes_near)). Qed.
End Returns.
