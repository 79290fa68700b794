(* The cells of one period are enough: `check_cells` looks at the columns from 0 on, below `columns`.

   Proved:   one_period_leads   what holds of the flights from these cells, with ranks that repeat each period, holds of all. *)

From Coq Require Import Reals ZArith Lra Lia.
From Juggleproof Require Import SineTable SineMotions SineGrid.
Open Scope R_scope.

Section Period.
  Variables alpha g : R.
  Variables columns per_unit rows width low high first last deep : Z.
  Variable at_rest : nat.
  Variable rank : Z -> Z -> nat.
  Local Notation cell := (cell columns per_unit).
  Local Notation trap_cell := (trap_cell columns width low high).
  Local Notation arc_cell := (arc_cell columns first last deep).
  Local Notation other_cell := (other_cell columns width low high first last deep).
  Local Notation leads := (leads columns width low high first last deep at_rest rank).
  Local Notation top := (top per_unit rows).

  Hypothesis columns_positive : (0 < columns)%Z.
  Hypothesis repeats : forall k i r, rank (i + k * columns) r = rank i r.

  Lemma cell_moves k i r x s : cell (i + k * columns) r (x + IZR k, s) <-> cell i r (x, s).
  Proof.
    unfold SineGrid.cell. cbn [fst snd]. apply (IZR_lt 0) in columns_positive.
    replace (IZR (i + k * columns) / IZR columns) with (IZR i / IZR columns + IZR k) by (rewrite plus_IZR, mult_IZR; field; lra).
    replace ((IZR (i + k * columns) + 1) / IZR columns) with ((IZR i + 1) / IZR columns + IZR k) by (rewrite plus_IZR, mult_IZR; field; lra).
    split; intros [place speed]; (split; [lra|exact speed]).
  Qed.

  Lemma kinds_move k l i r : (trap_cell l (i + k * columns) r <-> trap_cell (l - k) i r) /\ (arc_cell l (i + k * columns) r <-> arc_cell (l - k) i r).
  Proof. unfold SineGrid.trap_cell, SineGrid.arc_cell. split; split; nia. Qed.

  Lemma leads_moves k i r m q : leads i r m q -> leads (i + k * columns) r (m + k * columns) q.
  Proof.
    intros (trap_ & arc_ & other_). unfold SineGrid.leads. rewrite !repeats. split; [|split].
    - intros l inside. apply (kinds_move k) in inside. apply (kinds_move k). replace (l + 1 - k)%Z with (l - k + 1)%Z by lia. now apply trap_.
    - intros l inside. apply (kinds_move k) in inside. destruct (arc_ _ inside) as [same|less]; [left; now apply (kinds_move k)|now right].
    - intros [no_trap no_arc]. apply other_. split; intros l inside; [apply (no_trap (l + k)%Z)|apply (no_arc (l + k)%Z)]; apply (kinds_move k);
        now replace (l + k - k)%Z with l by lia.
  Qed.

  Theorem one_period_leads :
    (forall i r z w, (0 <= i < columns)%Z -> (0 <= r < rows)%Z -> cell i r z -> flight alpha g z w -> snd w <= top ->
      exists m q, (0 <= q < rows)%Z /\ cell m q w /\ leads i r m q) ->
    forall i r z w, (0 <= r < rows)%Z -> cell i r z -> flight alpha g z w -> snd w <= top ->
      exists m q, (0 <= q < rows)%Z /\ cell m q w /\ leads i r m q.
  Proof.
    intros one i r [x s] [y t] range here flown bound. set (k := (i / columns)%Z). set (j := (i mod columns)%Z).
    assert (i_is : i = (j + k * columns)%Z) by (unfold j, k; pose proof (Z.div_mod i columns ltac:(lia)); lia).
    assert (j_range : (0 <= j < columns)%Z) by (apply Z.mod_pos_bound; lia). rewrite i_is in *.
    replace x with (x - IZR k + IZR k) in here, flown by ring. replace y with (y - IZR k + IZR k) in flown by ring.
    apply cell_moves in here. apply flight_periods in flown.
    destruct (one j r _ _ j_range range here flown bound) as (m & q & q_range & there & led). exists (m + k * columns)%Z, q.
    split; [exact q_range|]. split; [|now apply leads_moves]. replace y with (y - IZR k + IZR k) by ring. now apply cell_moves.
  Qed.
End Period.
