(* The rules that join single inequalities to a theorem on orbits, for any set of states and any map f.

   Defined:  iterate, within (a ball of a weighted sup norm), converges, stage, last_stage.
   Proved:   descent      a falling rank leads every orbit into the last of finitely many stages, and says when;
             contraction  a map that contracts a weighted sup norm around a point does so geometrically;
             fixed_point  its point is a fixed point;
             weighted_stability, stability   and is Lyapunov stable there, in the weighted and in the plain sup norm;
             approach, convergence           both together: an explicit bound, and the limit of every orbit;
             periodic_orbit_stays_away       a periodic orbit through another point does not converge;
             escape_refutes   so the point of an attraction does not attract where an orbit escapes from it;
             exactly      what is concluded on one domain, and refuted on others that make up the whole with it, holds just on the first;
             closed_form  terms that begin with the state and go on by the map are its iterates;
             pieces_make_a_map   pieces that cover the space, and do not overlap, make one map of it into itself.
   Coordinates are indexed by any type; Lists.v says the same for states that are lists of reals.
   No rule here uses excluded middle: a state "is in a stage or loses rank" stands where "in no stage" is meant. *)

From Coq Require Import Reals ZArith Lra Lia List.
Open Scope R_scope.

Fixpoint iterate {State : Type} (f : State -> State) (n : nat) (s : State) : State :=
  match n with O => s | S k => f (iterate f k s) end.

Lemma iterate_add {State} (f : State -> State) n k s : iterate f (n + k) s = iterate f k (iterate f n s).
Proof.
  rewrite Nat.add_comm. induction k as [|k IH]; [reflexivity|]. change (f (iterate f (k + n) s) = f (iterate f k (iterate f n s))).
  now rewrite IH.
Qed.

Lemma iterate_step {State} (f : State -> State) n s : iterate f (S n) s = iterate f n (f s).
Proof. exact (iterate_add f 1 n s). Qed.

Lemma iterate_keeps {State} (f : State -> State) (P : State -> Prop) :
  (forall s, P s -> P (f s)) -> forall n s, P s -> P (iterate f n s).
Proof. intros keep n s Ps. induction n as [|n IH]; [exact Ps|]. now apply keep. Qed.

Lemma iterate_periodic {State} (f : State -> State) period s : iterate f period s = s -> forall n, iterate f (period * n) s = s.
Proof.
  intros back n. induction n as [|n IH]; [now rewrite Nat.mul_0_r|].
  rewrite Nat.mul_succ_r, iterate_add, IH. exact back.
Qed.

Lemma exceeded_by_a_number x : exists n, x <= INR n.
Proof.
  exists (Z.to_nat (up x)). destruct (archimed x) as [above _]. rewrite INR_IZR_INZ.
  apply Rle_trans with (IZR (up x)); [lra|]. apply IZR_le. lia.
Qed.

(* ---------------------------------------------------------------- descent of a rank through stages *)

Section Descent.
  Context {State : Type}.
  Variables (f : State -> State) (space : State -> Prop) (rank : State -> R) (stages : list (State -> Prop)).

  (* Stages are counted from 0; there is none beyond the end of the list. *)
  Definition stage (k : nat) : State -> Prop := nth k stages (fun _ => False).
  Definition last_stage : State -> Prop := stage (length stages - 1).

  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis rank_nonnegative : forall s, space s -> 0 <= rank s.
  Hypothesis rank_falls : forall s, space s -> (exists k, stage k s) \/ rank (f s) <= rank s - 1.
  Hypothesis stage_leads_on : forall k s, (S k < length stages)%nat -> space s -> stage k s -> stage (S k) (f s).
  Hypothesis last_stage_invariant : forall s, space s -> last_stage s -> last_stage (f s).

  Lemma stage_exists k s : stage k s -> (k < length stages)%nat.
  Proof.
    intro inside. destruct (Nat.lt_ge_cases k (length stages)) as [less|beyond]; [exact less|].
    unfold stage in inside. rewrite nth_overflow in inside by exact beyond. contradiction.
  Qed.

  Lemma enters_a_stage n : forall s, space s -> rank s < INR n -> exists j k, INR j <= rank s /\ stage k (iterate f j s).
  Proof.
    induction n as [|n IH]; intros s inside bound.
    - pose proof (rank_nonnegative s inside). cbn in bound. lra.
    - destruct (rank_falls s inside) as [[k staged]|falls].
      + exists 0%nat, k. split; [cbn; now apply rank_nonnegative|exact staged].
      + rewrite S_INR in bound.
        destruct (IH (f s) (space_invariant s inside)) as (j & k & early & staged); [lra|].
        exists (S j), k. rewrite S_INR, iterate_step. split; [lra|exact staged].
  Qed.

  Lemma stages_end_in_the_last n : forall k s, space s -> stage k s -> (length stages - 1 <= k + n)%nat -> last_stage (iterate f n s).
  Proof.
    induction n as [|n IH]; intros k s inside staged long; pose proof (stage_exists k s staged) as exists_.
    - unfold last_stage. replace (length stages - 1)%nat with k by lia. exact staged.
    - rewrite iterate_step. destruct (Nat.lt_ge_cases (S k) (length stages)) as [less|end_].
      + apply (IH (S k)); [now apply space_invariant|now apply stage_leads_on|lia].
      + apply (IH k); [now apply space_invariant| |lia].
        assert (last : k = (length stages - 1)%nat) by lia.
        rewrite last in staged |- *. now apply last_stage_invariant.
  Qed.

  Theorem descent s n : space s -> rank s + INR (length stages - 1) <= INR n -> last_stage (iterate f n s).
  Proof.
    intros inside late.
    destruct (enters_a_stage (S n) s inside) as (j & k & early & staged).
    { rewrite S_INR. pose proof (pos_INR (length stages - 1)). lra. }
    assert (long : (j + (length stages - 1) <= n)%nat) by (apply INR_le; rewrite plus_INR; lra).
    replace n with (j + (n - j))%nat by lia. rewrite iterate_add.
    apply (stages_end_in_the_last (n - j) k); [now apply iterate_keeps|exact staged|lia].
  Qed.
End Descent.

(* ---------------------------------------------------------------- contraction of a weighted sup norm *)

Section Contraction.
  Context {State Index : Type}.
  Variables (f : State -> State) (coordinate : Index -> State -> R) (point weight : Index -> R).

  (* s lies within c of the point: |s_j - e_j| <= c weight_j for every coordinate j. *)
  Definition within (c : R) (s : State) : Prop := forall j, Rabs (coordinate j s - point j) <= c * weight j.

  (* Every coordinate of the orbit of s tends to that of the point. *)
  Definition converges (s : State) : Prop :=
    forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat -> forall j, Rabs (coordinate j (iterate f n s) - point j) < epsilon.

  Variables (on : State -> Prop) (rate : R).
  Hypothesis on_invariant : forall s, on s -> on (f s).
  Hypothesis rate_nonnegative : 0 <= rate.
  Hypothesis contracts : forall c s, 0 <= c -> on s -> within c s -> within (rate * c) (f s).

  Theorem contraction n c s : 0 <= c -> on s -> within c s -> within (rate ^ n * c) (iterate f n s).
  Proof.
    intros positive inside near. induction n as [|n IH].
    - intro j. cbn. rewrite Rmult_1_l. apply near.
    - replace (rate ^ S n * c) with (rate * (rate ^ n * c)) by (cbn; ring).
      change (within (rate * (rate ^ n * c)) (f (iterate f n s))).
      apply contracts; [|now apply iterate_keeps|exact IH].
      apply Rmult_le_pos; [now apply pow_le|exact positive].
  Qed.

  Theorem fixed_point s : on s -> (forall j, coordinate j s = point j) -> forall j, coordinate j (f s) = point j.
  Proof.
    intros inside there j. pose proof (contracts 0 s (Rle_refl 0) inside) as close. unfold within in close.
    specialize (close ltac:(intro i; rewrite there, Rminus_diag_eq, Rabs_R0 by reflexivity; lra) j).
    rewrite Rmult_0_r, Rmult_0_l in close. pose proof (Rabs_pos (coordinate j (f s) - point j)).
    destruct (Req_dec (coordinate j (f s) - point j) 0) as [zero|other]; [lra|]. apply Rabs_pos_lt in other. lra.
  Qed.

  Variables (space : State -> Prop) (radius lowest highest : R).
  Hypothesis rate_below_1 : rate < 1.
  Hypothesis lowest_positive : 0 < lowest.
  Hypothesis weights_bounded : forall j, lowest <= weight j <= highest.

  Lemma within_monotone c d s : c <= d -> within c s -> within d s.
  Proof.
    intros order near j. apply Rle_trans with (1 := near j).
    apply Rmult_le_compat_r; [destruct (weights_bounded j); lra|exact order].
  Qed.

  Lemma rate_power_at_most_1 n : 0 <= rate ^ n <= 1.
  Proof.
    split; [now apply pow_le|]. induction n as [|n IH]; [cbn; lra|].
    cbn. replace 1 with (1 * 1) by ring. apply Rmult_le_compat; try lra. now apply pow_le.
  Qed.

  Hypothesis radius_positive : 0 < radius.
  Hypothesis near_is_on : forall s, space s -> within radius s -> on s.

  Theorem weighted_stability epsilon : 0 < epsilon -> exists delta, 0 < delta /\
    forall s, space s -> within delta s -> forall n, within epsilon (iterate f n s).
  Proof.
    intro positive. exists (Rmin epsilon radius). split; [now apply Rmin_glb_lt|].
    intros s inside near n. apply within_monotone with (rate ^ n * Rmin epsilon radius).
    - pose proof (Rmin_l epsilon radius). pose proof (rate_power_at_most_1 n).
      apply Rle_trans with (1 * Rmin epsilon radius); [|lra].
      apply Rmult_le_compat_r; [apply Rlt_le; now apply Rmin_glb_lt|lra].
    - apply contraction; [apply Rlt_le; now apply Rmin_glb_lt| |exact near].
      apply near_is_on; [exact inside|]. exact (within_monotone _ _ _ (Rmin_r epsilon radius) near).
  Qed.

  (* The same in the plain sup norm, as stability is usually defined. *)
  Theorem stability epsilon : 0 < epsilon -> exists delta, 0 < delta /\
    forall s, space s -> (forall j, Rabs (coordinate j s - point j) < delta) ->
    forall n j, Rabs (coordinate j (iterate f n s) - point j) < epsilon.
  Proof.
    intro positive.
    set (high := Rmax highest 1). assert (high_positive : 0 < high) by (pose proof (Rmax_r highest 1); unfold high; lra).
    destruct (weighted_stability (epsilon / 2 / high)) as (delta & delta_positive & stays).
    { apply Rdiv_lt_0_compat; lra. }
    exists (delta * lowest). split; [now apply Rmult_lt_0_compat|].
    intros s inside near n j. apply Rle_lt_trans with (epsilon / 2 / high * high).
    - apply Rle_trans with (epsilon / 2 / high * weight j).
      + apply (stays s inside). intro i. apply Rlt_le, Rlt_le_trans with (1 := near i).
        apply Rmult_le_compat_l; [lra|apply weights_bounded].
      + apply Rmult_le_compat_l; [apply Rlt_le, Rdiv_lt_0_compat; lra|].
        pose proof (Rmax_l highest 1). destruct (weights_bounded j). unfold high. lra.
    - replace (epsilon / 2 / high * high) with (epsilon / 2) by (field; lra). lra.
  Qed.

  (* ------------------------------------------------------------ descent and contraction together *)

  Variables (rank : State -> R) (stages : list (State -> Prop)) (size : R).
  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis rank_nonnegative : forall s, space s -> 0 <= rank s.
  Hypothesis rank_falls : forall s, space s -> (exists k, stage stages k s) \/ rank (f s) <= rank s - 1.
  Hypothesis stage_leads_on : forall k s, (S k < length stages)%nat -> space s -> stage stages k s -> stage stages (S k) (f s).
  Hypothesis last_stage_invariant : forall s, space s -> last_stage stages s -> last_stage stages (f s).
  Hypothesis last_stage_is_on : forall s, space s -> last_stage stages s -> on s.
  Hypothesis size_nonnegative : 0 <= size.
  Hypothesis last_stage_is_small : forall s, space s -> last_stage stages s -> within size s.

  Theorem approach s n k : space s -> rank s + INR (length stages - 1) <= INR n -> within (rate ^ k * size) (iterate f (n + k) s).
  Proof.
    intros inside late. rewrite iterate_add.
    assert (there : space (iterate f n s)) by now apply iterate_keeps.
    assert (last : last_stage stages (iterate f n s)) by now apply (descent f space rank stages).
    apply contraction; [exact size_nonnegative|now apply last_stage_is_on|now apply last_stage_is_small].
  Qed.

  Theorem convergence s : space s -> converges s.
  Proof.
    intros inside epsilon positive.
    set (high := Rmax highest 1). assert (high_positive : 0 < high) by (pose proof (Rmax_r highest 1); unfold high; lra).
    set (room := (size + 1) * high). assert (room_positive : 0 < room) by (apply Rmult_lt_0_compat; lra).
    assert (small : Rabs rate < 1) by (rewrite Rabs_right; lra).
    destruct (pow_lt_1_zero rate small (epsilon / room)) as [K vanishes]; [now apply Rdiv_lt_0_compat|].
    destruct (exceeded_by_a_number (rank s + INR (length stages - 1))) as [N late].
    exists (N + K)%nat. intros n long j.
    replace n with (N + (n - N))%nat by lia.
    apply Rle_lt_trans with (rate ^ (n - N) * size * weight j); [apply approach; [exact inside|exact late]|].
    apply Rle_lt_trans with (rate ^ (n - N) * room).
    - rewrite Rmult_assoc. apply Rmult_le_compat_l; [now apply pow_le|]. unfold room.
      pose proof (Rmax_l highest 1). destruct (weights_bounded j). apply Rmult_le_compat; unfold high; lra.
    - replace epsilon with (epsilon / room * room) by (field; lra). apply Rmult_lt_compat_r; [exact room_positive|].
      apply Rle_lt_trans with (1 := Rle_abs _). apply vanishes. lia.
  Qed.
End Contraction.

Theorem periodic_orbit_stays_away {State Index : Type} (f : State -> State) (coordinate : Index -> State -> R) (point : Index -> R)
    (period : nat) (s : State) (j : Index) :
  (0 < period)%nat -> iterate f period s = s -> coordinate j s <> point j -> ~ converges f coordinate point s.
Proof.
  intros positive back apart tends.
  assert (gap : 0 < Rabs (coordinate j s - point j)) by (apply Rabs_pos_lt; lra).
  destruct (tends _ gap) as [N near]. specialize (near (period * N)%nat).
  rewrite iterate_periodic in near by exact back. specialize (near ltac:(nia) j). lra.
Qed.

(* For one value of the parameters: what refutes that the point attracts, on the domain of an escape. *)
Theorem escape_refutes {State Index : Type} (f : State -> State) (coordinate : Index -> State -> R) (point other : Index -> R)
    (space : State -> Prop) (period : nat) (s : State) :
  (0 < period)%nat -> space s /\ iterate f period s = s /\ (exists j, coordinate j s <> other j) -> (forall j, other j = point j) ->
  ~ forall t, space t -> converges f coordinate point t.
Proof.
  intros positive (there & back & j & apart) same all. rewrite (same j) in apart.
  exact (periodic_orbit_stays_away f coordinate point period s j positive back apart (all s there)).
Qed.

(* For one value of the parameters: inside the domain of an attraction, or in one of those where something refutes what it concludes. *)
Theorem exactly (inside concluded : Prop) (outside : list Prop) :
  Exists (fun domain : Prop => domain) (inside :: outside) -> (inside -> concluded) -> Forall (fun domain : Prop => domain -> ~ concluded) outside ->
  inside <-> concluded.
Proof.
  intros covers concludes refutes. split; [exact concludes|]. intro all. apply Exists_cons in covers.
  destruct covers as [yes|out]; [exact yes|exfalso]. apply Exists_exists in out. destruct out as (domain & one & there).
  rewrite Forall_forall in refutes. exact (refutes domain one there all).
Qed.

Theorem closed_form {State : Type} (f : State -> State) (after : nat -> State -> State) :
  (forall s, after O s = s) -> (forall k s, f (after k s) = after (S k) s) -> forall k s, iterate f k s = after k s.
Proof. intros start step k s. induction k as [|k IH]; cbn; [now rewrite start|]. now rewrite IH. Qed.

Section Pieces.
  Context {State : Type}.
  Variables (space : State -> Prop) (guard : nat -> State -> Prop) (image : nat -> State -> State) (count : nat).
  Hypothesis decided : forall k s, {guard k s} + {~ guard k s}.
  Hypothesis covers : forall s, space s -> exists k, (k < count)%nat /\ guard k s.
  Hypothesis apart : forall i k s, (k < i < count)%nat -> space s -> guard i s -> ~ guard k s.
  Hypothesis stays : forall k s, (k < count)%nat -> space s -> guard k s -> space (image k s).

  Fixpoint piecewise (n : nat) (s : State) : State :=
    match n with O => s | S k => if decided k s then image k s else piecewise k s end.

  Theorem pieces_make_a_map :
    (forall k s, (k < count)%nat -> space s -> guard k s -> piecewise count s = image k s) /\ (forall s, space s -> space (piecewise count s)).
  Proof.
    assert (given : forall n k s, (n <= count)%nat -> (k < n)%nat -> space s -> guard k s -> piecewise n s = image k s).
    { induction n as [|n IH]; intros k s less before inside here; [lia|]. cbn. destruct (decided n s) as [yes|no].
      - destruct (Nat.eq_dec k n) as [->|other]; [reflexivity|]. destruct (apart n k s); [lia|assumption..].
      - apply IH; try assumption; [lia|]. destruct (Nat.eq_dec k n) as [->|]; [contradiction|lia]. }
    split; [intros k s before; now apply given|]. intros s inside. destruct (covers s inside) as (k & before & here).
    rewrite (given count k s); auto.
  Qed.
End Pieces.
