(* Descent of a rank on cells, and the rest arc: every motion below the top of the strip comes to the trap.

   A ranked cell leads to cells of smaller rank, to the trap or, where its rank is above that of the arc, to the arc.
   The arc, once a period, holds all phases where S <= 1 is possible; a flight from it leads to the same copy of it, to cells of smaller
   rank, or to the trap.  The trap leads to the trap one period later.

   Proved:   comes_to_the_trap    every motion does, whatever it rests, and from there on it only flies;
             no_endless_rests     stages in bounded time are flights but for finitely many: their impacts accumulate. *)

From Coq Require Import Reals ZArith Lra Lia.
From Juggleproof Require Import SineTable SineMotions.
Open Scope R_scope.

Section Descent.
  Variables alpha g : R.
  Hypothesis alpha_nonnegative : 0 <= alpha.
  Local Notation downward := (downward alpha g).
  Local Notation flight := (flight alpha g).
  Local Notation stage := (stage alpha g).
  Local Notation rests := (rests alpha g).
  Local Notation rises := (rises alpha g).
  Local Notation motion := (motion alpha g).

  Variables start finish depth top : R.
  Variable at_rest : nat.
  Variables (ranked : nat -> Impact -> Prop) (trap : Z -> Impact -> Prop).

  Definition arc (k : Z) (z : Impact) : Prop := start + IZR k <= fst z <= finish + IZR k /\ 0 <= snd z <= depth.
  Definition trapped (z : Impact) : Prop := exists k, trap k z.
  Definition below (n : nat) (z : Impact) : Prop := trapped z \/ exists m, (m < n)%nat /\ ranked m z.

  Hypothesis depth_nonnegative : 0 <= depth.
  Hypothesis arc_short : start < finish < start + 1.
  Hypothesis arc_holds : forall k y, finish + IZR k <= y <= start + IZR k + 1 -> 1 < downward y.
  Hypothesis located : forall z, 0 <= snd z <= top -> trapped z \/ (exists k, arc k z) \/ exists n, ranked n z.
  Hypothesis trap_place : forall k z, trap k z -> IZR k - 1 / 4 <= fst z.
  Hypothesis trap_flight : forall k z w, trap k z -> flight z w -> snd w <= top -> trap (k + 1) w.
  Hypothesis trap_moves : forall k z, trap k z -> alpha * snd z = 0 -> 1 < downward (fst z).
  Hypothesis arc_flight : forall k z w, arc k z -> flight z w -> snd w <= top -> arc k w \/ below at_rest w.
  Hypothesis ranked_flight : forall n z w, ranked n z -> flight z w -> snd w <= top -> below n w \/ (at_rest < n)%nat /\ exists k, arc k w.
  Hypothesis ranked_rest : forall n z, ranked n z -> alpha * snd z = 0 -> downward (fst z) <= 1 -> (at_rest < n)%nat.

  (* ---------------------------------------------------------------- where a ball rests *)

  Lemma copy_of x : exists k, start + IZR k <= x < start + IZR k + 1.
  Proof.
    exists (up (x - start) - 1)%Z. rewrite minus_IZR. destruct (archimed (x - start)). lra.
  Qed.

  Lemma slow_is_in_the_arc x : downward x <= 1 -> exists k, start + IZR k <= x < finish + IZR k.
  Proof.
    intro slow. destruct (copy_of x) as [k range]. exists k. split; [lra|]. apply Rnot_le_lt. intro beyond.
    pose proof (arc_holds k x ltac:(lra)). lra.
  Qed.

  Lemma launched_in_the_arc a w : rests a (fst w) -> snd w = 0 -> exists k, arc k w.
  Proof.
    intros (order & low & _) still. destruct (slow_is_in_the_arc a (low a ltac:(lra))) as [k range]. exists k.
    assert (fst w < finish + IZR k).
    { apply Rnot_le_lt. intro beyond. pose proof (low (finish + IZR k) ltac:(lra)). pose proof (arc_holds k (finish + IZR k) ltac:(lra)). lra. }
    unfold arc. lra.
  Qed.

  (* A stage that is not a flight ends with a launch in the arc. *)
  Definition launched (z : Impact) : Prop := rises (fst z) /\ exists k, arc k z.

  Lemma flight_or_launch z w : stage z w -> flight z w \/ launched w.
  Proof.
    intros [flown|x limit _ _ _ rest still|_ _ rest still]; [now left|right..];
      (split; [apply rest|exact (launched_in_the_arc _ _ rest still)]).
  Qed.

  (* ---------------------------------------------------------------- endless flights *)

  Section Endless.
    Variable x : nat -> Impact.
    Variable limit : R.
    Hypothesis runs : forall n, flight (x n) (x (S n)).
    Hypothesis low : forall n, snd (x n) <= top.
    Hypothesis tends : Un_cv (fun n => fst (x n)) limit.

    Lemma not_trapped n : ~ trapped (x n).
    Proof.
      intros [k inside]. assert (all : forall j, trap (k + Z.of_nat j) (x (n + j))).
      { induction j as [|j IH]; [now rewrite Nat.add_0_r, Z.add_0_r|].
        rewrite Nat.add_succ_r. replace (k + Z.of_nat (S j))%Z with (k + Z.of_nat j + 1)%Z by lia. exact (trap_flight _ _ _ IH (runs _) (low _)). }
      destruct (archimed (limit - IZR k + 1)) as [past _]. set (u := up (limit - IZR k + 1)) in *.
      pose proof (trap_place _ _ (all (Z.to_nat u))) as place. rewrite plus_IZR, Z2Nat.inj_0 || rewrite plus_IZR in place.
      pose proof (flights_later alpha g x limit runs tends (n + Z.to_nat u)) as less.
      destruct (Z_le_gt_dec 0 u) as [natural|negative]; [rewrite Z2Nat.id in place by exact natural; lra|].
      assert (IZR u < 0) by (apply (IZR_lt u 0); lia).
      pose proof (trap_place _ _ (all O)) as place_0. pose proof (flights_later alpha g x limit runs tends (n + 0)).
      rewrite Z.add_0_r in place_0. lra.
    Qed.

    Lemma not_below m : forall n, (m <= at_rest)%nat -> below m (x n) -> False.
    Proof.
      induction m as [m IH] using (well_founded_induction lt_wf). intros n small [inside|(l & less & inside)]; [exact (not_trapped n inside)|].
      destruct (ranked_flight l _ _ inside (runs n) (low _)) as [lower|[above _]]; [|lia].
      apply (IH l less (S n)); [lia|exact lower].
    Qed.

    Lemma endless_in_the_arc k n : arc k (x n) -> forall j, arc k (x (n + j)).
    Proof.
      intro inside. induction j as [|j IH]; [now rewrite Nat.add_0_r|]. rewrite Nat.add_succ_r.
      destruct (arc_flight _ _ _ IH (runs _) (low _)) as [still|lower]; [exact still|]. destruct (not_below at_rest (S (n + j)) (le_n _) lower).
    Qed.
  End Endless.

  Lemma limit_within (x : nat -> Impact) limit bound : Un_cv (fun n => fst (x n)) limit -> (forall n, fst (x n) <= bound) -> limit <= bound.
  Proof.
    intros tends bounded. apply Rnot_lt_le. intro beyond. destruct (tends (limit - bound) ltac:(lra)) as [N close].
    specialize (close N (le_n N)). unfold R_dist in close. apply Rabs_def2 in close. specialize (bounded N). lra.
  Qed.

  (* ---------------------------------------------------------------- stages *)

  Section Stages.
    Variable z : nat -> Impact.
    Hypothesis speeds : forall n, 0 <= snd (z n) <= top.
    Hypothesis goes : forall n, stage (z n) (z (S n)).
    (* The strip: what flights within a stage come to. *)
    Hypothesis low : forall n (x : nat -> Impact), x O = z n -> (forall j, flight (x j) (x (S j))) -> forall j, snd (x j) <= top.

    Lemma trapped_flies k n : trap k (z n) -> flight (z n) (z (S n)).
    Proof.
      intro inside. destruct (goes n) as [flown|x limit first runs tends _ _|still less (_ & slow & _) _]; [exact flown|exfalso..].
      - apply (not_trapped x limit runs (low n x first runs) tends O). exists k. now rewrite first.
      - pose proof (trap_moves k _ inside still). pose proof (slow (fst (z n)) ltac:(lra)). lra.
    Qed.

    Theorem trap_keeps k n : trap k (z n) -> forall j, trap (k + Z.of_nat j) (z (n + j)) /\ flight (z (n + j)) (z (S (n + j))).
    Proof.
      intro inside. assert (all : forall j, trap (k + Z.of_nat j) (z (n + j))).
      { induction j as [|j IH]; [now rewrite Nat.add_0_r, Z.add_0_r|].
        rewrite Nat.add_succ_r. replace (k + Z.of_nat (S j))%Z with (k + Z.of_nat j + 1)%Z by lia.
        exact (trap_flight _ _ _ IH (trapped_flies _ _ IH) (proj2 (speeds _))). }
      intro j. split; [apply all|]. exact (trapped_flies _ _ (all j)).
    Qed.

    Lemma below_flies m n : (m < at_rest)%nat -> ranked m (z n) -> flight (z n) (z (S n)).
    Proof.
      intros small inside. destruct (goes n) as [flown|x limit first runs tends _ _|still less (_ & slow & _) _]; [exact flown|exfalso..].
      - apply (not_below x limit runs (low n x first runs) tends at_rest O (le_n _)). right. exists m. now rewrite first.
      - pose proof (ranked_rest m _ inside still (slow (fst (z n)) ltac:(lra))). lia.
    Qed.

    Lemma below_comes m : forall n, (m <= at_rest)%nat -> below m (z n) -> exists i, trapped (z i).
    Proof.
      induction m as [m IH] using (well_founded_induction lt_wf). intros n small [inside|(l & less & inside)]; [now exists n|].
      destruct (ranked_flight l _ _ inside (below_flies l n ltac:(lia) inside) (proj2 (speeds _))) as [lower|[above _]]; [|lia].
      apply (IH l less (S n)); [lia|exact lower].
    Qed.

    (* After a launch there are flights only, until the arc is left. *)
    Lemma launched_flies b k n : rises b -> arc k (z n) -> start + IZR k <= b <= fst (z n) -> flight (z n) (z (S n)).
    Proof.
      intros up inside past. pose proof (arc_holds k (finish + IZR k) ltac:(lra)) as high.
      destruct (goes n) as [flown|x limit first runs tends (order & slow & _) _|still less (_ & slow & _) _]; [exact flown|exfalso..].
      - assert (all : forall j, arc k (x j)).
        { intro j. apply (endless_in_the_arc x limit runs (low n x first runs) tends k O). now rewrite first. }
        assert (bound : limit <= finish + IZR k) by (apply (limit_within x); [exact tends|intro j; apply all]).
        pose proof (flights_later alpha g x limit runs tends O) as later_. rewrite first in later_. destruct up as [level beyond].
        pose proof (rises_once alpha g b limit (finish + IZR k) level beyond ltac:(lra) ltac:(lra) high). pose proof (slow limit ltac:(lra)). lra.
      - apply (one_rest alpha g b (finish + IZR k) (fst (z n)) (fst (z (S n))) up ltac:(lra) high); [destruct inside; lra|exact less|exact slow].
    Qed.

    Lemma launched_stays n : launched (z n) -> exists k, forall j,
      (arc k (z (n + j)) /\ flight (z (n + j)) (z (S (n + j)))) \/ exists i, trapped (z i).
    Proof.
      intros [up [k inside]]. exists k.
      assert (all : forall j, (arc k (z (n + j)) /\ fst (z n) <= fst (z (n + j))) \/ exists i, trapped (z i)).
      { induction j as [|j [[still past]|there]]; [left; rewrite Nat.add_0_r; split; [exact inside|lra]| |now right].
        rewrite Nat.add_succ_r. assert (flown : flight (z (n + j)) (z (S (n + j)))) by (apply (launched_flies (fst (z n)) k); try assumption; destruct inside; lra).
        destruct (arc_flight _ _ _ still flown (proj2 (speeds _))) as [again|lower].
        - left. split; [exact again|]. destruct flown. lra.
        - right. exact (below_comes at_rest _ (le_n _) lower). }
      intro j. destruct (all j) as [[still past]|there]; [left|now right]. split; [exact still|].
      apply (launched_flies (fst (z n)) k); try assumption. destruct inside; lra.
    Qed.

    Theorem no_endless_rests bound : (forall n, fst (z n) <= bound) -> ~ forall N, exists n, (N <= n)%nat /\ ~ flight (z n) (z (S n)).
    Proof.
      intros bounded endless. assert (never : forall i, ~ trapped (z i)).
      { intros i [k inside]. destruct (archimed (bound - IZR k + 1)) as [past _]. set (u := up (bound - IZR k + 1)) in *.
        pose proof (trap_place _ _ (proj1 (trap_keeps k i inside (Z.to_nat u)))) as place. rewrite plus_IZR in place.
        assert (IZR u <= IZR (Z.of_nat (Z.to_nat u))) by (apply IZR_le; lia). specialize (bounded (i + Z.to_nat u)%nat). lra. }
      destruct (endless O) as (n & _ & no). destruct (flight_or_launch _ _ (goes n)) as [flown|up]; [exact (no flown)|].
      destruct (launched_stays _ up) as [k stays]. destruct (endless (S n)) as (m & late & other).
      destruct (stays (m - S n)%nat) as [[_ flown]|[i there]]; [|exact (never i there)].
      replace (S n + (m - S n))%nat with m in flown by lia. exact (other flown).
    Qed.

    (* ------------------------------------------------------------ for all times *)

    Hypothesis unbounded : forall time, exists n, time < fst (z n).

    Lemma later_than n time : exists j, time < fst (z (n + j)).
    Proof.
      assert (grows : forall i j, fst (z i) <= fst (z (i + j))).
      { intros i j. induction j as [|j IH]; [rewrite Nat.add_0_r; lra|]. rewrite Nat.add_succ_r.
        pose proof (proj1 (later alpha g _ _ (goes (i + j)))). lra. }
      destruct (unbounded time) as [m past]. exists m. pose proof (grows m n). rewrite Nat.add_comm. lra.
    Qed.

    Lemma launched_comes n : launched (z n) -> exists i, trapped (z i).
    Proof.
      intro up. destruct (launched_stays n up) as [k stays]. destruct (later_than n (finish + IZR k)) as [j past].
      destruct (stays j) as [[[inside _] _]|there]; [lra|exact there].
    Qed.

    Lemma arc_comes k n : arc k (z n) -> exists i, trapped (z i).
    Proof.
      intro inside. destruct (later_than n (finish + IZR k)) as [j past]. revert n inside past.
      induction j as [|j IH]; intros n inside past; [rewrite Nat.add_0_r in past; destruct inside; lra|].
      destruct (flight_or_launch _ _ (goes n)) as [flown|up]; [|exact (launched_comes _ up)].
      destruct (arc_flight _ _ _ inside flown (proj2 (speeds _))) as [again|lower]; [|exact (below_comes at_rest _ (le_n _) lower)].
      apply (IH (S n) again). now rewrite Nat.add_succ_comm.
    Qed.

    Lemma ranked_comes m : forall n, ranked m (z n) -> exists i, trapped (z i).
    Proof.
      induction m as [m IH] using (well_founded_induction lt_wf). intros n inside.
      destruct (flight_or_launch _ _ (goes n)) as [flown|up]; [|exact (launched_comes _ up)].
      destruct (ranked_flight m _ _ inside flown (proj2 (speeds _))) as [[there|(l & less & lower)]|[_ [k in_arc]]].
      - now exists (S n).
      - exact (IH l less (S n) lower).
      - exact (arc_comes k (S n) in_arc).
    Qed.

    Theorem comes_to_the_trap : exists n k, forall j, trap (k + Z.of_nat j) (z (n + j)) /\ flight (z (n + j)) (z (S (n + j))).
    Proof.
      assert (there : exists i, trapped (z i)).
      { destruct (located (z O) (speeds O)) as [there|[[k inside]|[n inside]]]; [now exists O|exact (arc_comes k O inside)|exact (ranked_comes n O inside)]. }
      destruct there as (n & k & inside). exists n, k. now apply trap_keeps.
    Qed.
  End Stages.
End Descent.
