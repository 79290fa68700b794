(* The cells of a certificate: columns of phases, counted on over periods, and rows of closing speeds.
   They are its narrowest: where a certificate has a wider cell, all of these in it have its rank, and the first `deep` rows are its row 0.

   Defined:  cell, trap_cell, arc_cell; leads, what the ranks of the cells where a flight starts and ends satisfy; cells, what `check_cells` finds.
   Proved:   every state is in a cell, those of the trap in its cells, those of the arc in its cells, and a cell is of one kind;
             flights of cells obey the premises of SineDescent.v. *)

From Coq Require Import Reals ZArith Lra Lia.
From Juggleproof Require Import SineTable SineMotions SineDescent SineLanding SineTrap.
Open Scope R_scope.

Lemma lines n a b x : 0 < n -> (a < b)%Z -> IZR a / n <= x <= IZR b / n -> exists i, (a <= i < b)%Z /\ IZR i / n <= x <= (IZR i + 1) / n.
Proof.
  intros positive order [from to]. assert (x_is : x = x * n / n) by (field; lra).
  assert (inverse : 0 < / n) by now apply Rinv_0_lt_compat.
  assert (scale : forall p, p / n <= x <-> p <= x * n).
  { intro p. unfold Rdiv. split; intro less; [apply Rmult_le_reg_r with (/ n)|]; [exact inverse|rewrite Rmult_assoc, Rinv_r, Rmult_1_r; lra|].
    rewrite x_is. unfold Rdiv. apply Rmult_le_compat_r; lra. }
  assert (scale_ : forall p, x <= p / n <-> x * n <= p).
  { intro p. unfold Rdiv. split; intro less; [apply Rmult_le_reg_r with (/ n)|]; [exact inverse|rewrite Rmult_assoc, Rinv_r, Rmult_1_r; lra|].
    rewrite x_is. unfold Rdiv. apply Rmult_le_compat_r; lra. }
  apply scale in from. apply scale_ in to. destruct (archimed (x * n)) as [above near]. set (u := up (x * n)) in *.
  assert (low : (a < u)%Z) by (apply lt_IZR; lra).
  destruct (Z_lt_le_dec (u - 1) b) as [inside|beyond].
  - exists (u - 1)%Z. split; [lia|]. rewrite scale, scale_, minus_IZR. lra.
  - exists (b - 1)%Z. split; [lia|]. rewrite scale, scale_, minus_IZR. apply IZR_le in beyond. rewrite minus_IZR in beyond. lra.
Qed.

Lemma flight_periods alpha g k x s y t : flight alpha g (x + IZR k, s) (y + IZR k, t) <-> flight alpha g (x, s) (y, t).
Proof.
  assert (up_ : forall n p q, flight alpha g (p + INR n, s) (q + INR n, t) <-> flight alpha g (p, s) (q, t)).
  { induction n as [|n IH]; intros p q; [cbn; now rewrite !Rplus_0_r|]. rewrite S_INR, <- !Rplus_assoc, flight_period. apply IH. }
  destruct (Z_le_gt_dec 0 k) as [natural|negative].
  - rewrite <- (Z2Nat.id k natural), <- INR_IZR_INZ. apply up_.
  - rewrite <- (up_ (Z.to_nat (- k)) (x + IZR k)). rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia.
    replace (x + IZR k + - IZR k) with x by ring. now replace (y + IZR k + - IZR k) with y by ring.
Qed.

Section Grid.
  Variables alpha g : R.
  Variables columns per_unit rows width low high first last deep : Z.
  Variable at_rest : nat.
  Variable rank : Z -> Z -> nat.

  Local Notation N := (IZR columns).
  Local Notation K := (IZR per_unit).
  Local Notation flight := (flight alpha g).
  Local Notation downward := (downward alpha g).

  Definition top : R := IZR rows / K.
  Definition cell (i r : Z) (z : Impact) : Prop := IZR i / N <= fst z <= (IZR i + 1) / N /\ IZR r / K <= snd z <= (IZR r + 1) / K.
  Definition trap_cell (k i r : Z) : Prop := (k * columns - width <= i < k * columns + width /\ low <= r < high)%Z.
  Definition arc_cell (k i r : Z) : Prop := (first + k * columns <= i < last + k * columns /\ 0 <= r < deep)%Z.
  Definition other_cell (i r : Z) : Prop := (forall k, ~ trap_cell k i r) /\ forall k, ~ arc_cell k i r.

  (* A flight from the cell (i, r) to the cell (m, q). *)
  Definition leads (i r m q : Z) : Prop :=
    (forall k, trap_cell k i r -> trap_cell (k + 1) m q) /\
    (forall k, arc_cell k i r -> arc_cell k m q \/ (rank m q < at_rest)%nat) /\
    (other_cell i r -> (rank m q < rank i r)%nat).

  Record cells : Prop := {
    grid_positive : (0 < columns)%Z /\ (0 < per_unit)%Z;
    trap_range : (0 < width /\ 8 * width <= columns /\ 0 < low < high /\ high <= rows)%Z;
    arc_range : (0 <= first < columns /\ first < last < first + columns /\ 0 < deep <= rows)%Z;
    arc_rank : forall k i r, arc_cell k i r -> rank i r = at_rest;
    arc_outside : forall y, IZR last / N <= y <= IZR first / N + 1 -> 1 < downward y;
    rank_of_rest : forall i r z, (0 <= r < rows)%Z -> other_cell i r -> cell i r z -> alpha = 0 -> downward (fst z) <= 1 -> (at_rest < rank i r)%nat;
    flights_lead : forall i r z w, (0 <= r < rows)%Z -> cell i r z -> flight z w -> snd w <= top ->
      exists m q, (0 <= q < rows)%Z /\ cell m q w /\ leads i r m q }.

  Hypothesis alpha_nonnegative : 0 <= alpha.
  Hypothesis certified : cells.

  Definition start : R := IZR first / N.
  Definition finish : R := IZR last / N.
  Definition depth : R := IZR deep / K.
  Definition ranked (n : nat) (z : Impact) : Prop := exists i r, (0 <= r < rows)%Z /\ cell i r z /\ other_cell i r /\ rank i r = n.
  Local Notation trap := (in_trap (IZR width / N) (IZR low / K) (IZR high / K)).
  Local Notation arc := (arc start finish depth).

  Lemma N_positive : 0 < N.
  Proof. apply (IZR_lt 0), certified. Qed.
  Lemma K_positive : 0 < K.
  Proof. apply (IZR_lt 0), certified. Qed.

  Lemma per_period t k : IZR (t + k * columns) / N = IZR t / N + IZR k.
  Proof. pose proof N_positive. rewrite plus_IZR, mult_IZR. field. lra. Qed.

  Lemma scaled a b n : 0 < n -> (a <= b)%Z -> IZR a / n <= IZR b / n.
  Proof. intros positive less. apply IZR_le in less. unfold Rdiv. apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat|]; lra. Qed.

  Lemma next_line i n : (IZR i + 1) / n = IZR (i + 1) / n.
  Proof. now rewrite plus_IZR. Qed.

  (* ---------------------------------------------------------------- kinds of cells *)

  Lemma kind i r : (exists k, trap_cell k i r) \/ (exists k, arc_cell k i r) \/ other_cell i r.
  Proof.
    destruct certified as [[columns_ _] trap_ arc_ _ _ _ _].
    assert (copy : forall from, exists k, (from + k * columns <= i < from + k * columns + columns)%Z).
    { intro from. exists ((i - from) / columns)%Z. pose proof (Z.div_mod (i - from) columns ltac:(lia)). pose proof (Z.mod_pos_bound (i - from) columns columns_). nia. }
    destruct (copy (- width)%Z) as [k k_is]. destruct (copy first) as [l l_is].
    assert (decided : (trap_cell k i r \/ ~ trap_cell k i r) /\ (arc_cell l i r \/ ~ arc_cell l i r)) by (unfold trap_cell, arc_cell; lia).
    destruct decided as [[yes|no] [yes_|no_]]; [left; now exists k|left; now exists k|right; left; now exists l|].
    right. right. split; intros m inside.
    - apply no. replace k with m; [exact inside|]. destruct inside. nia.
    - apply no_. replace l with m; [exact inside|]. destruct inside. nia.
  Qed.

  Lemma trap_cell_is k i r z : trap_cell k i r -> cell i r z -> trap k z.
  Proof.
    intros [columns_ rows_] [place speed]. pose proof N_positive. pose proof K_positive. rewrite next_line in *.
    pose proof (scaled (- width + k * columns) i N ltac:(lra) ltac:(lia)) as one. pose proof (scaled (i + 1) (width + k * columns) N ltac:(lra) ltac:(lia)) as two.
    rewrite per_period in one, two. rewrite opp_IZR in one. unfold Rdiv in one. rewrite Ropp_mult_distr_l_reverse in one. fold (IZR width / N) in one.
    pose proof (scaled low r K ltac:(lra) ltac:(lia)). pose proof (scaled (r + 1) high K ltac:(lra) ltac:(lia)). unfold in_trap. lra.
  Qed.

  Lemma trap_has_cell k z : trap k z -> exists i r, (0 <= r < rows)%Z /\ trap_cell k i r /\ cell i r z.
  Proof.
    intros [place speed]. pose proof N_positive. pose proof K_positive. destruct certified as [_ trap_ _ _ _ _ _].
    destruct (lines N (- width + k * columns) (width + k * columns) (fst z)) as (i & i_range & i_place); [lra|lia| |].
    { rewrite !per_period, opp_IZR. unfold Rdiv. rewrite Ropp_mult_distr_l_reverse. fold (IZR width / N). lra. }
    destruct (lines K low high (snd z) ltac:(lra) ltac:(lia) speed) as (r & r_range & r_place).
    exists i, r. split; [lia|]. split; [unfold trap_cell; lia|now split].
  Qed.

  Lemma arc_cell_is k i r z : arc_cell k i r -> cell i r z -> arc k z.
  Proof.
    intros [columns_ rows_] [place speed]. pose proof N_positive. pose proof K_positive. rewrite next_line in *.
    pose proof (scaled (first + k * columns) i N ltac:(lra) ltac:(lia)) as one. pose proof (scaled (i + 1) (last + k * columns) N ltac:(lra) ltac:(lia)) as two.
    pose proof (scaled 0 r K ltac:(lra) ltac:(lia)) as three. pose proof (scaled (r + 1) deep K ltac:(lra) ltac:(lia)).
    rewrite per_period in one, two. unfold SineDescent.arc, start, finish, depth. unfold Rdiv in three at 1. rewrite Rmult_0_l in three. lra.
  Qed.

  Lemma arc_has_cell k z : arc k z -> exists i r, arc_cell k i r /\ cell i r z.
  Proof.
    intros [place speed]. pose proof N_positive. pose proof K_positive. destruct certified as [_ _ arc_ _ _ _ _].
    destruct (lines N (first + k * columns) (last + k * columns) (fst z)) as (i & i_range & i_place); [lra|lia| |].
    { rewrite !per_period. exact place. }
    destruct (lines K 0 deep (snd z)) as (r & r_range & r_speed); [lra|lia| |].
    { unfold depth in speed. unfold Rdiv at 1. rewrite Rmult_0_l. lra. }
    exists i, r. split; [unfold arc_cell; lia|now split].
  Qed.

  Lemma cell_of_state z : 0 <= snd z <= top -> exists i r, (0 <= r < rows)%Z /\ cell i r z.
  Proof.
    intros speed. pose proof N_positive. pose proof K_positive. destruct certified as [_ trap_ _ _ _ _ _].
    destruct (lines K 0 rows (snd z)) as (r & r_range & r_place); [lra|lia|unfold top in *; unfold Rdiv in *; lra|].
    destruct (archimed (fst z * N)) as [above near]. set (u := up (fst z * N)) in *.
    assert (range : IZR (u - 1) / N <= fst z <= IZR u / N).
    { rewrite minus_IZR. assert (z_is : fst z = fst z * N / N) by (field; lra). assert (0 < / N) by (apply Rinv_0_lt_compat; lra).
      split; rewrite z_is; unfold Rdiv; apply Rmult_le_compat_r; lra. }
    destruct (lines N (u - 1) u (fst z) ltac:(lra) ltac:(lia) range) as (i & _ & i_place). exists i, r. now split; [|split].
  Qed.

  (* ---------------------------------------------------------------- the premises of the descent *)

  Lemma grid_arc_short : start < finish < start + 1.
  Proof.
    pose proof N_positive. assert (inverse : 0 < / N) by now apply Rinv_0_lt_compat. destruct (arc_range certified) as [_ [short long]].
    apply IZR_lt in short, long. rewrite plus_IZR in long. unfold start, finish. replace 1 with (N * / N) by (field; lra).
    split; unfold Rdiv; [|rewrite <- Rmult_plus_distr_r]; apply Rmult_lt_compat_r; lra.
  Qed.

  Lemma grid_located z : 0 <= snd z <= top -> trapped trap z \/ (exists k, arc k z) \/ exists n, ranked n z.
  Proof.
    intro speed. destruct (cell_of_state z speed) as (i & r & range & here). destruct (kind i r) as [[k kind_]|[[k kind_]|kind_]].
    - left. exists k. exact (trap_cell_is k i r z kind_ here).
    - right. left. exists k. exact (arc_cell_is k i r z kind_ here).
    - right. right. exists (rank i r), i, r. auto.
  Qed.

  Lemma grid_below n m q w : (0 <= q < rows)%Z -> cell m q w -> (rank m q < n)%nat -> below ranked trap n w \/ (at_rest < n)%nat /\ exists k, arc k w.
  Proof.
    intros range here less. destruct (kind m q) as [[k kind_]|[[k kind_]|kind_]].
    - left. left. exists k. exact (trap_cell_is k m q w kind_ here).
    - right. rewrite (arc_rank certified k m q kind_) in less. split; [exact less|]. exists k. exact (arc_cell_is k m q w kind_ here).
    - left. right. exists (rank m q). split; [exact less|]. exists m, q. auto.
  Qed.

  Lemma grid_trap_flight k z w : trap k z -> flight z w -> snd w <= top -> trap (k + 1) w.
  Proof.
    intros inside flown bound. destruct (trap_has_cell k z inside) as (i & r & range & kind_ & here).
    destruct (flights_lead certified i r z w range here flown bound) as (m & q & _ & there & (in_trap_ & _)).
    exact (trap_cell_is (k + 1) m q w (in_trap_ k kind_) there).
  Qed.

  Lemma grid_arc_flight k z w : arc k z -> flight z w -> snd w <= top -> arc k w \/ below ranked trap at_rest w.
  Proof.
    intros inside flown bound. destruct (arc_has_cell k z inside) as (i & r & kind_ & here). destruct (arc_range certified) as (_ & _ & deep_). pose proof (proj2 kind_) as row.
    destruct (flights_lead certified i r z w ltac:(lia) here flown bound) as (m & q & range & there & (_ & in_arc & _)).
    destruct (in_arc k kind_) as [same|less]; [left; exact (arc_cell_is k m q w same there)|right].
    destruct (grid_below at_rest m q w range there less) as [yes|[no _]]; [exact yes|lia].
  Qed.

  Lemma grid_ranked_flight n z w : ranked n z -> flight z w -> snd w <= top -> below ranked trap n w \/ (at_rest < n)%nat /\ exists k, arc k w.
  Proof.
    intros (i & r & range & here & kind_ & <-) flown bound.
    destruct (flights_lead certified i r z w range here flown bound) as (m & q & range_ & there & (_ & _ & falls)).
    exact (grid_below _ m q w range_ there (falls kind_)).
  Qed.

  Lemma downward_periods k y : downward (y + IZR k) = downward y.
  Proof.
    assert (up_ : forall n x, downward (x + INR n) = downward x).
    { induction n as [|n IH]; intro x; [cbn; now rewrite Rplus_0_r|]. rewrite S_INR, <- Rplus_assoc, downward_period. apply IH. }
    destruct (Z_le_gt_dec 0 k) as [natural|negative].
    - rewrite <- (Z2Nat.id k natural), <- INR_IZR_INZ. apply up_.
    - rewrite <- (up_ (Z.to_nat (- k)) (y + IZR k)). rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. f_equal. ring.
  Qed.

  Lemma grid_arc_holds k y : finish + IZR k <= y <= start + IZR k + 1 -> 1 < downward y.
  Proof.
    intro range. rewrite <- (downward_periods k (y - IZR k)) || replace y with (y - IZR k + IZR k) by ring. rewrite downward_periods.
    apply (arc_outside certified). unfold start, finish in range. lra.
  Qed.

  Lemma grid_ranked_rest n z : ranked n z -> alpha * snd z = 0 -> downward (fst z) <= 1 -> (at_rest < n)%nat.
  Proof.
    intros (i & r & range & here & kind_ & <-) still slow. destruct (Req_dec alpha 0) as [zero|other]; [exact (rank_of_rest certified i r z range kind_ here zero slow)|].
    exfalso. assert (no_speed : snd z = 0) by (apply Rmult_eq_reg_l with alpha; lra). destruct here as [place speed]. pose proof N_positive. pose proof K_positive.
    assert (row : r = 0%Z).
    { assert (IZR r <= 0); [|apply (le_IZR r 0) in H1; lia]. rewrite no_speed in speed. apply Rmult_le_reg_r with (/ K); [now apply Rinv_0_lt_compat|].
      unfold Rdiv in speed. lra. }
    destruct (grid_positive certified) as [columns_ _]. destruct (arc_range certified) as (_ & arc_ & deep_).
    set (k := ((i - first) / columns)%Z). assert (copy : (first + k * columns <= i < first + k * columns + columns)%Z).
    { unfold k. pose proof (Z.div_mod (i - first) columns ltac:(lia)). pose proof (Z.mod_pos_bound (i - first) columns columns_). nia. }
    apply (proj2 kind_ k). split; [|lia]. split; [lia|]. apply Znot_ge_lt. intro beyond.
    pose proof (scaled (last + k * columns) i N ltac:(lra) ltac:(lia)) as one. pose proof (scaled (i + 1) (first + (k + 1) * columns) N ltac:(lra) ltac:(lia)) as two.
    rewrite per_period in one, two. rewrite (plus_IZR k 1) in two. rewrite next_line in place.
    pose proof (grid_arc_holds k (fst z) ltac:(unfold start, finish; lra)). lra.
  Qed.
End Grid.
