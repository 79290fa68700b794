(* Motions of a ball on a table that moves as a sine: flights and impacts, impacts that accumulate, rest and launch.

   Defined:  rests, the ball rests on the table from one phase to another, where it is launched; stage; motion.
   Proved:   later             every stage takes time, and ends with a closing speed >= 0;
             accumulation      impacts that go on for ever in bounded time accumulate where S <= 1, and their closing speeds tend to 0;
             is_launched       a ball that rests where S <= 1 is launched before S > 1;
             one_rest          in an arc that ends with S > 1, a ball that was launched does not rest again. *)

From Coq Require Import Reals Lra Lia.
From Juggleproof Require Import SineTable.
Open Scope R_scope.

Section Motions.
  Variables alpha g : R.
  Hypothesis alpha_nonnegative : 0 <= alpha.
  Local Notation downward := (downward alpha g).
  Local Notation flight := (flight alpha g).

  Definition rises (b : R) : Prop := downward b = 1 /\ forall d, 0 < d -> ~ forall z, b < z < b + d -> downward z <= 1.

  (* While S <= 1 the table does not fall away; the ball leaves where S rises through 1. *)
  Definition rests (a b : R) : Prop := a <= b /\ (forall y, a <= y <= b -> downward y <= 1) /\ rises b.

  (* What comes after an impact, up to the next impact or launch that is looked at.  A launch is the closing speed 0 where S rises through 1. *)
  Inductive stage (z w : Impact) : Prop :=
  | flies : flight z w -> stage z w
  | chatters (x : nat -> Impact) (limit : R) : x O = z -> (forall n, flight (x n) (x (S n))) -> Un_cv (fun n => fst (x n)) limit ->
      rests limit (fst w) -> snd w = 0 -> stage z w
  | sticks : alpha * snd z = 0 -> fst z < fst w -> rests (fst z) (fst w) -> snd w = 0 -> stage z w.

  (* From its first impact on, for all times. *)
  Definition motion (z : nat -> Impact) : Prop :=
    0 <= snd (z O) /\ (forall n, stage (z n) (z (S n))) /\ forall time, exists n, time < fst (z n).

  Lemma flights_later (x : nat -> Impact) limit : (forall n, flight (x n) (x (S n))) -> Un_cv (fun n => fst (x n)) limit -> forall n, fst (x n) < limit.
  Proof.
    intros runs tends n. assert (grows : Un_growing (fun n => fst (x n))) by (intro k; apply Rlt_le, runs).
    apply Rlt_le_trans with (fst (x (S n))); [apply runs|]. exact (growing_ineq _ _ grows tends (S n)).
  Qed.

  Lemma flights_arrive (x : nat -> Impact) : (forall n, flight (x n) (x (S n))) -> 0 <= snd (x O) -> forall n, 0 <= snd (x n).
  Proof. intros runs first [|n]; [exact first|]. exact (arrives _ _ _ _ (runs n)). Qed.

  Lemma later z w : stage z w -> fst z < fst w /\ 0 <= snd w.
  Proof.
    intros [flown|x limit <- runs tends (order & _) slow|_ less _ slow].
    - split; [apply flown|exact (arrives _ _ _ _ flown)].
    - pose proof (flights_later x limit runs tends O). lra.
    - lra.
  Qed.

  Lemma motion_speeds z : motion z -> forall n, 0 <= snd (z n).
  Proof. intros (first & goes & _) [|n]; [exact first|]. apply (later _ _ (goes n)). Qed.

  (* ---------------------------------------------------------------- accumulation *)

  Lemma downward_derivative x : exists d, derivable_pt_lim downward x d.
  Proof. eexists. exact (derivable_pt_lim_scal _ (2 * PI) x _ (wave_derivative _ _ x)). Qed.

  Lemma stays_near x e : 0 < e -> exists d, 0 < d /\ forall y, Rabs (y - x) < d -> Rabs (downward y - downward x) < e.
  Proof.
    intro positive. destruct (downward_derivative x) as [slope is]. pose proof (continuous _ _ _ is) as whole.
    destruct (whole e positive) as (d & d_positive & near). exists d. split; [exact d_positive|]. intros y close.
    destruct (Req_dec x y) as [<-|other]; [now rewrite Rminus_diag_eq, Rabs_R0|].
    apply (near y). split; [now split|exact close].
  Qed.

  Lemma downward_bounded : exists bound, forall y, Rabs (1 - downward y) <= bound.
  Proof.
    exists (1 + 2 * PI * (Rabs (half_gap alpha) + Rabs g)). intro y. pose proof PI_RGT_0.
    assert (waves : Rabs (wave (half_gap alpha) g y) <= Rabs (half_gap alpha) + Rabs g).
    { unfold wave. apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
      pose proof (Rabs_pos (half_gap alpha)). pose proof (Rabs_pos g).
      assert (Rabs (sin (2 * PI * y)) <= 1) by (apply Rabs_le, SIN_bound). assert (Rabs (cos (2 * PI * y)) <= 1) by (apply Rabs_le, COS_bound). nra. }
    unfold downward. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp, Rabs_mult, Rabs_R1, (Rabs_right (2 * PI)) by lra.
    apply Rplus_le_compat_l, Rmult_le_compat_l; lra.
  Qed.

  Lemma limit_slow (x : nat -> Impact) limit : 0 <= snd (x O) -> (forall n, flight (x n) (x (S n))) -> Un_cv (fun n => fst (x n)) limit ->
    downward limit <= 1.
  Proof.
    intros first runs tends. apply Rnot_lt_le. intro faster.
    destruct (stays_near limit (downward limit - 1) ltac:(lra)) as (d & positive & near).
    destruct (tends d positive) as [N close]. specialize (close N (le_n N)). unfold R_dist in close. apply Rabs_def2 in close.
    apply (falls_behind alpha g (x N) (x (S N)) alpha_nonnegative (flights_arrive x runs first N) (runs N)).
    intros y inside. pose proof (flights_later x limit runs tends (S N)) as less.
    assert (Rabs (downward y - downward limit) < downward limit - 1) as small by (apply near, Rabs_def1; lra).
    apply Rabs_def2 in small. lra.
  Qed.

  Theorem accumulation (x : nat -> Impact) bound : 0 <= snd (x O) -> (forall n, flight (x n) (x (S n))) -> (forall n, fst (x n) <= bound) ->
    exists limit, Un_cv (fun n => fst (x n)) limit /\ limit <= bound /\ downward limit <= 1 /\ Un_cv (fun n => snd (x n)) 0.
  Proof.
    intros first runs bounded. assert (grows : Un_growing (fun n => fst (x n))) by (intro k; apply Rlt_le, runs).
    destruct (growing_cv _ grows) as [limit tends]; [exists bound; intros t [n ->]; apply bounded|].
    exists limit. split; [exact tends|]. split; [|split].
    - apply Rnot_lt_le. intro beyond. destruct (tends (limit - bound) ltac:(lra)) as [N close]. specialize (close N (le_n N)).
      unfold R_dist in close. apply Rabs_def2 in close. specialize (bounded N). lra.
    - now apply limit_slow with x.
    - destruct downward_bounded as [M bounds]. intros e positive.
      assert (M_positive : 0 <= M) by (pose proof (bounds 0); pose proof (Rabs_pos (1 - downward 0)); lra).
      destruct (tends (e / (M + 1)) ltac:(apply Rdiv_lt_0_compat; lra)) as [N close]. exists (S N). intros [|n] late; [lia|].
      pose proof (flights_arrive x runs first (S n)). pose proof (speed_by_time _ _ _ _ M (runs n) bounds) as short.
      pose proof (flights_later x limit runs tends n). pose proof (flights_later x limit runs tends (S n)).
      pose proof (close n ltac:(lia)) as near. unfold R_dist in *. apply Rabs_def2 in near. rewrite Rminus_0_r, Rabs_right by lra.
      assert (e = e / (M + 1) * (M + 1)) by (field; lra). set (q := e / (M + 1)) in *. nra.
  Qed.

  (* ---------------------------------------------------------------- launch *)

  Theorem is_launched a e : a < e -> downward a <= 1 -> 1 < downward e -> exists b, b < e /\ rests a b.
  Proof.
    intros order low high. set (slow := fun b => a <= b <= e /\ forall y, a <= y <= b -> downward y <= 1).
    assert (some : slow a) by (split; [lra|]; intros y inside; now replace y with a by lra).
    destruct (completeness slow) as [b [bound least]]; [exists e; intros t [range _]; lra|now exists a|].
    assert (range : a <= b <= e) by (split; [now apply bound|apply least; intros t [inside _]; lra]).
    assert (before : forall y, a <= y < b -> downward y <= 1).
    { intros y inside. apply Rnot_lt_le. intro faster.
      assert (top : is_upper_bound slow y).
      { intros t [_ below]. apply Rnot_lt_le. intro less. specialize (below y ltac:(lra)). lra. }
      specialize (least y top). lra. }
    assert (at_b : downward b <= 1).
    { apply Rnot_lt_le. intro faster. destruct (stays_near b (downward b - 1) ltac:(lra)) as (d & positive & near).
      destruct (Rle_lt_or_eq_dec a b (proj1 range)) as [less|same]; [|subst b; lra].
      set (y := Rmax a (b - d / 2)). assert (inside : a <= y < b /\ b - d < y)
        by (unfold y; split; [split; [apply Rmax_l|apply Rmax_lub_lt; lra]|apply Rlt_le_trans with (b - d / 2); [lra|apply Rmax_r]]).
      specialize (before y (proj1 inside)). specialize (near y ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. lra. }
    assert (less : b < e) by (destruct (Rle_lt_or_eq_dec b e (proj2 range)) as [|same]; [assumption|subst b; lra]).
    assert (below : forall y, a <= y <= b -> downward y <= 1).
    { intros y inside. destruct (Req_dec y b) as [->|]; [exact at_b|apply before; lra]. }
    assert (beyond : forall d, 0 < d -> ~ forall z, b < z < b + d -> downward z <= 1).
    { intros d positive all. set (t := Rmin (b + d / 2) e).
      assert (inside : b < t < b + d /\ t <= e)
        by (unfold t; split; [split; [apply Rmin_glb_lt; lra|apply Rle_lt_trans with (b + d / 2); [apply Rmin_l|lra]]|apply Rmin_r]).
      assert (more : slow t); [|pose proof (bound t more); lra].
      split; [lra|]. intros y between. destruct (Rle_dec y b); [apply below|apply all]; lra. }
    exists b. split; [exact less|]. repeat split; [lra|exact below| |exact beyond].
    apply Rle_antisym; [exact at_b|]. apply Rnot_lt_le. intro slower.
    destruct (stays_near b (1 - downward b) ltac:(lra)) as (d & positive & near). apply (beyond d positive). intros z inside.
    specialize (near z ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. lra.
  Qed.

  (* An arc shorter than a period that ends with S > 1: after a launch in it, the ball does not rest in it again. *)
  Theorem one_rest b e y w : rises b -> e < b + 1 -> 1 < downward e -> b <= y <= e -> y < w -> (forall t, y <= t <= w -> downward t <= 1) -> False.
  Proof.
    intros (level & up) short high inside later below. destruct (Req_dec y e) as [->|other]; [specialize (below e ltac:(lra)); lra|].
    set (t := Rmin w e). assert (range : y < t /\ t <= w /\ t <= e) by (unfold t; repeat split; [apply Rmin_glb_lt; lra|apply Rmin_l|apply Rmin_r]).
    pose proof (below t ltac:(lra)). pose proof (rises_once alpha g b t e level up ltac:(lra) short high). lra.
  Qed.
End Motions.
