(* The rules on Lyapunov and Chetaev functions, and on a map that leads into a smaller space, for any set of states and any map f.

   A function V is given as the greatest of finitely many terms, each where its guard holds; `above s v` says that v >= V(s).
   The states of a set `on` are of the space. A state variable is a coordinate; coordinates are indexed by any type.

   Defined:  close, far (balls of the sup norm), stable, above.
   Proved:   above_exists, value_falls   what V is at most, at first and later;
             rarely_far           an orbit is far from the point at most V / least times;
             lyapunov_fixed_point, lyapunov_stability, lyapunov_attraction   so the point is fixed, stable, and attracts the set;
             attraction_from_a_set   what attracts a set attracts all that leads into it;
             chetaev_leaves, chetaev_instability   a function that grows from arbitrarily near makes the point unstable;
             same_pieces_agree, into_attraction, into_stability   an attraction on a smaller space is one of the larger;
             instability_refutes  so the point of an attraction is not stable where it is the unstable point. *)

From Coq Require Import Reals Lra Lia List.
From Juggleproof Require Import Rules.
Open Scope R_scope.

Section Nearness.
  Context {State Index : Type}.
  Variables (f : State -> State) (coordinate : Index -> State -> R) (point : Index -> R) (space : State -> Prop).

  Definition close (d : R) (s : State) : Prop := forall j, Rabs (coordinate j s - point j) <= d.
  Definition far (d : R) (s : State) : Prop := exists j, d <= Rabs (coordinate j s - point j).
  Definition stable : Prop := forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\
    forall s, space s -> (forall j, Rabs (coordinate j s - point j) < delta) ->
    forall n j, Rabs (coordinate j (iterate f n s) - point j) < epsilon.

  Lemma never_far d s : ~ far d s -> forall j, Rabs (coordinate j s - point j) < d.
  Proof. intros no j. destruct (Rlt_le_dec (Rabs (coordinate j s - point j)) d) as [less|more]; [exact less|]. destruct no. now exists j. Qed.

  Lemma converges_later N s : converges f coordinate point (iterate f N s) -> converges f coordinate point s.
  Proof.
    intros tends epsilon positive. destruct (tends epsilon positive) as [M near]. exists (N + M)%nat. intros n late j.
    replace n with (N + (n - N))%nat by lia. rewrite iterate_add. apply near. lia.
  Qed.

  Theorem attraction_from_a_set (on : State -> Prop) :
    (forall s, space s -> exists N, on (iterate f N s)) -> (forall s, on s -> converges f coordinate point s) ->
    forall s, space s -> converges f coordinate point s.
  Proof. intros enters attracts s inside. destruct (enters s inside) as [N there]. exact (converges_later N s (attracts _ there)). Qed.
End Nearness.

(* ---------------------------------------------------------------- a Lyapunov function *)

Section Lyapunov.
  Context {State Index : Type}.
  Variables (f : State -> State) (coordinate : Index -> State -> R) (point : Index -> R) (space on : State -> Prop).
  Variables (guard : nat -> State -> Prop) (term : nat -> State -> R) (count : nat).
  Variables (loss : State -> R -> R) (least : R -> R -> R) (upper radius : R).

  Definition above (s : State) (v : R) : Prop := forall i, (i < count)%nat -> guard i s -> term i s <= v.

  Hypothesis radius_positive : 0 < radius.
  Hypothesis upper_positive : 0 < upper.
  Hypothesis least_positive : forall distance level, 0 < distance -> 0 <= level -> 0 < least distance level.
  Hypothesis near_is_on : forall s, space s -> close coordinate point radius s -> on s.
  Hypothesis small : forall i s distance, (i < count)%nat -> space s -> 0 <= distance -> close coordinate point distance s ->
    distance <= radius -> guard i s -> term i s <= upper * distance.
  Hypothesis on_invariant : forall s, on s -> on (f s).
  Hypothesis bounded : forall s v, on s -> above s v -> 0 <= v.
  Hypothesis loss_nonnegative : forall s v, on s -> above s v -> 0 <= v -> 0 <= loss s v.
  Hypothesis loss_at_least : forall s v distance level, on s -> above s v -> 0 <= v -> 0 < distance -> 0 <= level ->
    far coordinate point distance s -> v <= level -> least distance level <= loss s v.
  Hypothesis falls : forall i s v, (i < count)%nat -> on s -> above s v -> 0 <= v -> guard i (f s) -> term i (f s) <= v - loss s v.

  Lemma above_exists s : exists v, above s v.
  Proof.
    assert (first : forall n, exists v, forall i, (i < n)%nat -> term i s <= v).
    { induction n as [|n [v high]]; [exists 0; intros i none; lia|]. exists (Rmax v (term n s)). intros i less.
      pose proof (Rmax_l v (term n s)). pose proof (Rmax_r v (term n s)).
      destruct (Nat.eq_dec i n) as [->|other]; [lra|]. specialize (high i ltac:(lia)). lra. }
    destruct (first count) as [v high]. exists v. intros i less _. now apply high.
  Qed.

  (* What V is at most after n steps, if at first it is at most v. *)
  Fixpoint later (n : nat) (s : State) (v : R) : R :=
    match n with O => v | S k => later k s v - loss (iterate f k s) (later k s v) end.

  Lemma later_is_above n s v : on s -> above s v -> above (iterate f n s) (later n s v).
  Proof.
    intros inside high. induction n as [|n IH]; [exact high|]. assert (there : on (iterate f n s)) by now apply iterate_keeps.
    intros i less here. apply falls; try assumption. exact (bounded _ _ there IH).
  Qed.

  Lemma later_nonnegative n s v : on s -> above s v -> 0 <= later n s v.
  Proof. intros inside high. apply (bounded (iterate f n s)); [now apply iterate_keeps|now apply later_is_above]. Qed.

  Lemma loss_later n s v : on s -> above s v -> 0 <= loss (iterate f n s) (later n s v).
  Proof.
    intros inside high. apply loss_nonnegative; [now apply iterate_keeps|now apply later_is_above|now apply later_nonnegative].
  Qed.

  Theorem value_falls n s v : on s -> above s v -> later n s v <= v.
  Proof. intros inside high. induction n as [|n IH]; cbn; [lra|]. pose proof (loss_later n s v inside high). lra. Qed.

  Lemma far_costs n s v d level : on s -> above s v -> v <= level -> 0 < d ->
    far coordinate point d (iterate f n s) -> later (S n) s v <= later n s v - least d level.
  Proof.
    intros inside high low positive away. cbn. pose proof (value_falls n s v inside high). pose proof (bounded s v inside high).
    assert (enough : least d level <= loss (iterate f n s) (later n s v)); [|lra].
    apply loss_at_least; try assumption; try lra; [now apply iterate_keeps|now apply later_is_above|now apply later_nonnegative].
  Qed.

  (* Of any distinct times at which the orbit is so far, there are at most v / least d v. *)
  Theorem rarely_far s v d times : on s -> above s v -> 0 < d -> NoDup times ->
    (forall n, In n times -> far coordinate point d (iterate f n s)) -> INR (length times) * least d v <= v.
  Proof.
    intros inside high positive.
    assert (enough : forall N others, NoDup others -> (forall n, In n others -> (n < N)%nat /\ far coordinate point d (iterate f n s)) ->
      INR (length others) * least d v <= v - later N s v).
    { induction N as [|N IH]; intros others distinct away.
      - destruct others as [|n others]; [cbn; lra|]. destruct (away n (or_introl eq_refl)). lia.
      - destruct (in_dec Nat.eq_dec N others) as [there|no].
        + destruct (in_split N others there) as (before & after & ->). pose proof (NoDup_remove before after N distinct) as [fewer gone].
          assert (rest : INR (length (before ++ after)) * least d v <= v - later N s v).
          { apply IH; [exact fewer|]. intros n some.
            destruct (away n) as [less far_]; [apply in_or_app; cbn; apply in_app_or in some; tauto|].
            split; [|exact far_]. destruct (Nat.eq_dec n N) as [->|other]; [contradiction|lia]. }
          destruct (away N there) as [_ far_].
          pose proof (far_costs N s v d v inside high (Rle_refl v) positive far_).
          rewrite app_length in rest |- *. cbn [length]. rewrite Nat.add_succ_r, S_INR. lra.
        + pose proof (loss_later N s v inside high). cbn.
          assert (rest : INR (length others) * least d v <= v - later N s v); [|lra].
          apply IH; [exact distinct|]. intros n some. destruct (away n some) as [less far_]. split; [|exact far_].
          destruct (Nat.eq_dec n N) as [->|other]; [contradiction|lia]. }
    intros distinct away. pose proof (later_nonnegative (S (list_max times)) s v inside high).
    assert (all : INR (length times) * least d v <= v - later (S (list_max times)) s v); [|lra].
    apply enough; [exact distinct|]. intros n some. split; [|now apply away].
    pose proof (proj1 (list_max_le times (list_max times)) (Nat.le_refl _)) as bound. rewrite Forall_forall in bound.
    specialize (bound n some). lia.
  Qed.

  Lemma near_the_point d s : space s -> 0 <= d <= radius -> close coordinate point d s -> on s /\ above s (upper * d).
  Proof.
    intros inside between near. split.
    - apply near_is_on; [exact inside|]. intro j. specialize (near j). lra.
    - intros i less here. now apply small.
  Qed.

  (* So small a value keeps every later state near. *)
  Lemma stays_near s v d level : on s -> above s v -> v <= level -> 0 < d -> v < least d level ->
    forall n j, Rabs (coordinate j (iterate f n s) - point j) < d.
  Proof.
    intros inside high low positive little n. apply never_far. intro away.
    pose proof (far_costs n s v d level inside high low positive away). pose proof (value_falls n s v inside high).
    pose proof (later_nonnegative (S n) s v inside high). lra.
  Qed.

  Theorem lyapunov_fixed_point s : space s -> (forall j, coordinate j s = point j) -> forall j, coordinate j (f s) = point j.
  Proof.
    intros inside there j.
    destruct (near_the_point 0 s inside ltac:(lra)) as [at_point none].
    { intro i. rewrite there, Rminus_diag_eq, Rabs_R0 by reflexivity. lra. }
    rewrite Rmult_0_r in none.
    destruct (Req_dec (coordinate j (f s) - point j) 0) as [zero|other]; [lra|]. apply Rabs_pos_lt in other.
    pose proof (stays_near s 0 _ 0 at_point none (Rle_refl 0) other (least_positive _ 0 other (Rle_refl 0)) 1%nat j) as less.
    cbn in less. lra.
  Qed.

  Theorem lyapunov_stability : stable f coordinate point space.
  Proof.
    intros epsilon positive. set (level := upper * radius).
    assert (level_positive : 0 < level) by now apply Rmult_lt_0_compat.
    pose proof (least_positive epsilon level positive (Rlt_le _ _ level_positive)) as least_.
    set (delta := Rmin radius (least epsilon level / 2 / upper)).
    assert (delta_positive : 0 < delta) by (apply Rmin_glb_lt; [exact radius_positive|apply Rdiv_lt_0_compat; lra]).
    exists delta. split; [exact delta_positive|]. intros s inside near.
    pose proof (Rmin_l radius (least epsilon level / 2 / upper)) as inner. pose proof (Rmin_r radius (least epsilon level / 2 / upper)) as low.
    destruct (near_the_point delta s inside) as [there high]; [unfold delta in *; lra|intro j; apply Rlt_le, near|].
    apply (stays_near s (upper * delta) epsilon level there high); [|exact positive|].
    - apply Rmult_le_compat_l; [lra|exact inner].
    - apply Rle_lt_trans with (upper * (least epsilon level / 2 / upper)).
      + apply Rmult_le_compat_l; [lra|exact low].
      + replace (upper * (least epsilon level / 2 / upper)) with (least epsilon level / 2) by (field; lra). lra.
  Qed.

  Theorem lyapunov_attraction s : on s -> converges f coordinate point s.
  Proof.
    intros inside epsilon positive. destruct (above_exists s) as [v high]. pose proof (bounded s v inside high) as v_nonnegative.
    assert (decreasing : Un_decreasing (fun n => later n s v)) by (intro n; cbn; pose proof (loss_later n s v inside high); lra).
    assert (lower : has_lb (fun n => later n s v)).
    { exists 0. intros x [n ->]. unfold opp_seq. pose proof (later_nonnegative n s v inside high). lra. }
    destruct (decreasing_cv _ decreasing lower) as [limit tends].
    pose proof (least_positive epsilon v positive v_nonnegative) as least_.
    destruct (tends (least epsilon v / 2)) as [N near]; [lra|]. exists N. intros n late. apply never_far. intro away.
    pose proof (far_costs n s v epsilon v inside high (Rle_refl v) positive away) as drop.
    pose proof (near n ltac:(lia)) as here. pose proof (near (S n) ltac:(lia)) as next.
    unfold R_dist in here, next. apply Rabs_def2 in here, next. lra.
  Qed.
End Lyapunov.

(* ---------------------------------------------------------------- a Chetaev function *)

Section Chetaev.
  Context {State Index : Type}.
  Variables (f : State -> State) (coordinate : Index -> State -> R) (point : Index -> R) (space : State -> Prop).
  Variables (guard : nat -> State -> Prop) (term : nat -> State -> R) (count : nat) (direction : R -> State) (rate radius upper : R).

  Hypothesis rate_above_1 : 1 < rate.
  Hypothesis radius_positive : 0 < radius.
  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis starts : forall d, 0 < d -> d <= radius -> space (direction d) /\ close coordinate point d (direction d) /\
    exists i, (i < count)%nat /\ guard i (direction d) /\ 0 < term i (direction d).
  Hypothesis bounded : forall i s, (i < count)%nat -> space s -> close coordinate point radius s -> guard i s -> 0 < term i s -> term i s <= upper.
  Hypothesis grows : forall i s, (i < count)%nat -> space s -> close coordinate point radius s -> guard i s -> 0 < term i s ->
    exists k, (k < count)%nat /\ guard k (f s) /\ rate * term i s <= term k (f s).

  Lemma grows_on n i s : (i < count)%nat -> space s -> (forall m, close coordinate point radius (iterate f m s)) -> guard i s -> 0 < term i s ->
    exists k, (k < count)%nat /\ guard k (iterate f n s) /\ rate ^ n * term i s <= term k (iterate f n s).
  Proof.
    intros less inside stays here positive. induction n as [|n (k & less_ & there & large)].
    - exists i. cbn. rewrite Rmult_1_l. split; [exact less|]. split; [exact here|apply Rle_refl].
    - assert (power : 0 < rate ^ n) by (apply pow_lt; lra). pose proof (Rmult_lt_0_compat _ _ power positive) as product.
      destruct (grows k (iterate f n s)) as (m & last & at_last & larger); try assumption; [now apply iterate_keeps|apply stays|lra|].
      exists m. split; [exact last|]. split; [exact at_last|]. apply Rle_trans with (2 := larger). cbn. rewrite Rmult_assoc.
      apply Rmult_le_compat_l; lra.
  Qed.

  Theorem chetaev_leaves d : 0 < d -> d <= radius -> ~ forall n, close coordinate point radius (iterate f n (direction d)).
  Proof.
    intros positive short stays. destruct (starts d positive short) as (inside & _ & i & less & here & w).
    assert (big : Rabs rate > 1) by (rewrite Rabs_right; lra).
    destruct (Pow_x_infinity rate big (upper / term i (direction d) + 1)) as [n large]. specialize (large n (Nat.le_refl n)).
    assert (power : 0 < rate ^ n) by (apply pow_lt; lra). rewrite Rabs_right in large by lra.
    destruct (grows_on n i _ less inside stays here w) as (k & less_ & there & at_least).
    pose proof (Rmult_lt_0_compat _ _ power w) as product.
    assert (at_most : term k (iterate f n (direction d)) <= upper).
    { apply bounded; try assumption; [now apply iterate_keeps|apply stays|lra]. }
    assert (more : (upper / term i (direction d) + 1) * term i (direction d) <= rate ^ n * term i (direction d)).
    { apply Rmult_le_compat_r; lra. }
    replace ((upper / term i (direction d) + 1) * term i (direction d)) with (upper + term i (direction d)) in more by (field; lra). lra.
  Qed.

  Theorem chetaev_instability : ~ stable f coordinate point space.
  Proof.
    intro stays. destruct (stays radius radius_positive) as (delta & positive & near).
    pose proof (Rmin_l delta radius) as less. pose proof (Rmin_r delta radius) as short. pose proof (Rmin_glb_lt _ _ _ positive radius_positive).
    set (d := Rmin delta radius / 2) in *. assert (between : 0 < d < delta /\ d <= radius) by (unfold d; lra).
    destruct (starts d) as (inside & start & _); [lra..|]. apply (chetaev_leaves d); [lra..|]. intros n j. apply Rlt_le, near; [exact inside|].
    intro i. specialize (start i). lra.
  Qed.
End Chetaev.

(* ---------------------------------------------------------------- an attraction on a smaller space *)

Theorem same_pieces_agree {State : Type} (f g : State -> State) (one other : State -> Prop) (guard : nat -> State -> Prop)
    (image : nat -> State -> State) (count : nat) :
  (forall s, one s -> exists k, (k < count)%nat /\ guard k s) ->
  (forall k s, (k < count)%nat -> one s -> guard k s -> f s = image k s) ->
  (forall k s, (k < count)%nat -> other s -> guard k s -> g s = image k s) -> forall s, one s -> other s -> f s = g s.
Proof. intros covers of_f of_g s first second. destruct (covers s first) as (k & less & here). now rewrite (of_f k), (of_g k). Qed.

Section Into.
  Context {State Index : Type}.
  Variables (f g : State -> State) (coordinate : Index -> State -> R) (point : Index -> R) (space inner : State -> Prop) (radius : R).
  Hypothesis space_invariant : forall s, space s -> space (f s).
  Hypothesis inner_invariant : forall s, inner s -> inner (g s).
  Hypothesis agree : forall s, space s -> inner s -> f s = g s.

  Lemma same_orbit n s : space s -> inner s -> iterate f n s = iterate g n s.
  Proof.
    intros outside inside. induction n as [|n IH]; [reflexivity|]. cbn. rewrite agree; [now rewrite IH|now apply iterate_keeps|].
    rewrite IH. now apply iterate_keeps.
  Qed.

  Theorem into_attraction : (forall s, space s -> exists N, inner (iterate f N s)) ->
    (forall s, inner s -> converges g coordinate point s) -> forall s, space s -> converges f coordinate point s.
  Proof.
    intros enters attracts. apply (attraction_from_a_set f coordinate point space (fun s => space s /\ inner s)).
    - intros s there. destruct (enters s there) as [N inside]. exists N. split; [now apply iterate_keeps|exact inside].
    - intros s [there inside] epsilon positive. destruct (attracts s inside epsilon positive) as [N near]. exists N. intros n late j.
      rewrite same_orbit by assumption. now apply near.
  Qed.

  Theorem into_stability : 0 < radius -> (forall s, space s -> close coordinate point radius s -> inner s) ->
    stable g coordinate point inner -> stable f coordinate point space.
  Proof.
    intros positive surrounds stays epsilon some. destruct (stays epsilon some) as (delta & delta_positive & near).
    exists (Rmin delta radius). split; [now apply Rmin_glb_lt|]. intros s there start n j.
    pose proof (Rmin_l delta radius). pose proof (Rmin_r delta radius).
    assert (inside : inner s) by (apply surrounds; [exact there|]; intro i; specialize (start i); lra).
    rewrite same_orbit by assumption. apply near; [exact inside|]. intro i. specialize (start i). lra.
  Qed.
End Into.

Theorem instability_refutes {State Index : Type} (f : State -> State) (coordinate : Index -> State -> R) (point other : Index -> R)
    (space : State -> Prop) :
  ~ stable f coordinate other space -> (forall j, other j = point j) -> ~ stable f coordinate point space.
Proof.
  intros escapes same near. apply escapes. intros epsilon positive. destruct (near epsilon positive) as (delta & some & keeps).
  exists delta. split; [exact some|]. intros s there start n j. rewrite (same j). apply keeps; [exact there|].
  intro i. rewrite <- (same i). apply start.
Qed.
