(* Flight and impact in continuous time: what an execution of ball and table is, and what it is to settle.
   State, height, velocity, energy and period are those of Map.v and Physical.v: a pair, its parts, and the paper's terms.

   Defined:  Motion; fly, the parabola of free flight (equation 1); meets, a body touches what is below it and approaches it;
             rebound, the impact law with restitution alpha (equations 2 and 3); execution, a body above a surface; is_table,
             a lossless bouncing ball on the ground (section 3.1); is_ball, the ball over a table; tends_to; settles.
   Proved:   parabolas compose; no_impact_until, no impact happens in an interval in which no first one can happen;
             execution_by_periods, a motion that obeys the laws in each period is an execution. *)

From Coq Require Import Reals ZArith Lra Lia.
From Juggleproof Require Import Map Physical.
Open Scope R_scope.

(* The state at each time t >= 0; where an impact happens, the state just before it. *)
Definition Motion : Type := R -> State.

Definition fly (g t : R) (b : State) : State := (height b + velocity b * t - g * t ^ 2 / 2, velocity b - g * t).

Definition meets (below body : State) : Prop := height body = height below /\ velocity body < velocity below.

(* The relative velocity is reversed and multiplied by alpha; what is below is not affected. *)
Definition rebound (alpha : R) (below body : State) : State :=
  (height body, velocity below - alpha * (velocity body - velocity below)).

Definition meets_dec (below body : State) : {meets below body} + {~ meets below body}.
Proof.
  unfold meets. destruct (Req_EM_T (height body) (height below)) as [touch|apart]; [|right; tauto].
  destruct (Rlt_dec (velocity body) (velocity below)) as [falls|rises]; [left|right]; tauto.
Defined.

(* The state of the body just after a time, from the two states at that time. *)
Definition after (alpha : R) (below body : State) : State := if meets_dec below body then rebound alpha below body else body.

Definition no_impact (surface body : Motion) (s t : R) : Prop :=
  forall time, s < time < t -> ~ meets (surface time) (body time).

(* A body above a surface, from the time 0 on, under gravity g and with restitution alpha:
   it is never below the surface; between impacts it flies; and after each time there is an interval without an impact. *)
Record execution (g alpha : R) (surface body : Motion) : Prop := {
  stays_above : forall t, 0 <= t -> height (surface t) <= height (body t);
  flies : forall s t, 0 <= s < t -> no_impact surface body s t -> body t = fly g (t - s) (after alpha (surface s) (body s));
  impacts_are_apart : forall s, 0 <= s -> exists t, s < t /\ no_impact surface body s t }.

Definition ground : Motion := fun _ => (0, 0).

(* The table bounces on the ground without loss, in any phase, with the energy (equation 14) of a launch at velocity r. *)
Definition is_table (g r : R) (table : Motion) : Prop := execution g 1 ground table /\ energy g (table 0) = r ^ 2 / 2.

(* Where the ball meets the table at the moment of a bounce, it meets the table just after the bounce (equation 5). *)
Definition surface_of (table : Motion) : Motion := fun t => after 1 (ground t) (table t).
Definition is_ball (g alpha : R) (table ball : Motion) : Prop := execution g alpha (surface_of table) ball.

(* Heights converge, and so do velocities, except within epsilon of the impacts of the limit. *)
Definition tends_to (surface body limit : Motion) : Prop :=
  forall epsilon, 0 < epsilon -> exists from, forall t, from <= t ->
  Rabs (height (body t) - height (limit t)) < epsilon /\
  ((forall s, Rabs (s - t) <= epsilon -> ~ meets (surface s) (limit s)) ->
   Rabs (velocity (body t) - velocity (limit t)) < epsilon).

(* Every execution of the ball over the table tends to one execution, which has the period of the table. *)
Definition settles (g alpha r : R) (table : Motion) : Prop :=
  exists limit, is_ball g alpha table limit /\ (forall t, 0 <= t -> limit (t + period r g) = limit t) /\
  forall ball, is_ball g alpha table ball -> tends_to (surface_of table) ball limit.

(* ---------------------------------------------------------------- parabolas, and single impacts *)

Lemma fly_0 g b : fly g 0 b = b.
Proof. destruct b as [y v]. unfold fly, height, velocity. cbn [fst snd]. f_equal; field. Qed.

Lemma fly_fly g s t b : fly g t (fly g s b) = fly g (s + t) b.
Proof. unfold fly, height, velocity. cbn [fst snd]. f_equal; field. Qed.

Lemma after_impact alpha below body : meets below body -> after alpha below body = rebound alpha below body.
Proof. intro yes. unfold after. destruct (meets_dec below body); [reflexivity|contradiction]. Qed.

Lemma after_no_impact alpha below body : ~ meets below body -> after alpha below body = body.
Proof. intro no. unfold after. destruct (meets_dec below body); [contradiction|reflexivity]. Qed.

(* No impact happens in an open interval in which no first one can happen. *)
Lemma no_impact_until surface body s e :
  (forall m, s <= m < e -> exists t, m < t /\ no_impact surface body m t) ->
  (forall t, s < t < e -> no_impact surface body s t -> ~ meets (surface t) (body t)) -> no_impact surface body s e.
Proof.
  intros apart no_first time [later earlier] impact.
  set (without := fun t => s <= t <= time /\ no_impact surface body s t).
  assert (start : without s) by (split; [lra|]; intros other inside; lra).
  destruct (completeness without) as [m [bound least]]; [exists time; intros t [range _]; lra|now exists s|].
  assert (range : s <= m <= time) by (split; [now apply bound|apply least; intros t [range _]; lra]).
  assert (free : no_impact surface body s m).
  { intros t inside hit.
    assert (top : is_upper_bound without t).
    { intros other [_ none]. apply Rnot_lt_le. intro beyond. exact (none t ltac:(lra) hit). }
    pose proof (least t top). lra. }
  destruct (Rle_lt_or_eq_dec m time (proj2 range)) as [early|last]; [|subst m; exact (no_first time (conj later earlier) free impact)].
  destruct (apart m) as (t & longer & none); [lra|].
  assert (more : without (Rmin t time)).
  { assert (Rmin t time <= time /\ Rmin t time <= t) by (split; [apply Rmin_r|apply Rmin_l]).
    split; [split; [unfold Rmin; destruct (Rle_dec t time)|]; lra|]. intros other inside.
    destruct (Rtotal_order other m) as [less|[same|greater]].
    - apply free. lra.
    - subst other. apply no_first; [lra|exact free].
    - apply none. lra. }
  pose proof (bound _ more). unfold Rmin in *. destruct (Rle_dec t time); lra.
Qed.

Lemma no_impact_part surface body s t u v : no_impact surface body s t -> s <= u -> v <= t -> no_impact surface body u v.
Proof. intros none first second time inside. apply none. lra. Qed.

(* ---------------------------------------------------------------- times in periods *)

(* The time t is in the period with the number k, which begins at start + k T. *)
Definition number (start T t : R) : nat := Z.to_nat (Int_part ((t - start) / T)).

Lemma number_is start T t : 0 < T -> start <= t -> start + INR (number start T t) * T <= t < start + (INR (number start T t) + 1) * T.
Proof.
  intros positive late. unfold number. set (q := (t - start) / T).
  assert (count : q * T = t - start) by (unfold q; field; lra).
  assert (low : 0 <= q) by (apply Rmult_le_reg_r with T; lra).
  destruct (base_Int_part q) as [below above].
  assert (natural : (0 <= Int_part q)%Z) by (apply Z.lt_succ_r, lt_IZR; rewrite succ_IZR; lra).
  rewrite INR_IZR_INZ, Z2Nat.id by exact natural. nra.
Qed.

Lemma number_unique start T t k : 0 < T -> start + INR k * T <= t < start + (INR k + 1) * T -> number start T t = k.
Proof.
  intros positive [low high]. pose proof (pos_INR k) as natural.
  destruct (number_is start T t positive ltac:(nra)) as [below above]. set (n := number start T t) in *.
  assert (INR n < INR (S k)) by (rewrite S_INR; nra). assert (INR k < INR (S n)) by (rewrite S_INR; nra).
  assert ((n < S k)%nat /\ (k < S n)%nat) by (split; now apply INR_lt). lia.
Qed.

(* A motion that flies between impacts within each period does so altogether. *)
Theorem execution_by_periods g alpha surface body start T : 0 < T -> start <= 0 ->
  (forall t, 0 <= t -> height (surface t) <= height (body t)) ->
  (forall k s t, 0 <= s -> start + INR k * T <= s < t -> t <= start + (INR k + 1) * T ->
    no_impact surface body s t -> body t = fly g (t - s) (after alpha (surface s) (body s))) ->
  (forall k s, 0 <= s -> start + INR k * T <= s < start + (INR k + 1) * T -> exists t, s < t /\ no_impact surface body s t) ->
  execution g alpha surface body.
Proof.
  intros positive early above inside apart. split; [exact above| |].
  - intros s t [first less]. destruct (number_is start T s positive ltac:(lra)) as [low high]. set (k := number start T s) in *.
    assert (steps : forall n t, s < t <= start + (INR (k + n) + 1) * T -> no_impact surface body s t ->
      body t = fly g (t - s) (after alpha (surface s) (body s))).
    { clear t less. intro n. induction n as [|n IH]; intros t [less more] none.
      - rewrite Nat.add_0_r in more. now apply (inside k).
      - set (c := start + (INR (k + n) + 1) * T) in *.
        destruct (Rle_dec t c) as [still|beyond]; [now apply IH|].
        replace (INR (k + S n)) with (INR (k + n) + 1) in more by (rewrite <- S_INR; f_equal; lia).
        assert (s < c) by (unfold c; rewrite plus_INR; pose proof (pos_INR n); nra).
        assert (before : body c = fly g (c - s) (after alpha (surface s) (body s))).
        { apply IH; [lra|]. apply (no_impact_part _ _ s t); [exact none|lra|lra]. }
        rewrite (inside (S (k + n)) c t), (after_no_impact alpha _ (body c)), before, fly_fly.
        + f_equal. lra.
        + apply none. lra.
        + lra.
        + rewrite S_INR. unfold c in *. lra.
        + rewrite S_INR. lra.
        + apply (no_impact_part _ _ s t); [exact none|lra|lra]. }
    intro none. destruct (number_is start T t positive ltac:(lra)) as [low' high']. set (l := number start T t) in *.
    apply (steps l); [|exact none]. rewrite plus_INR. pose proof (pos_INR k). nra.
  - intros s first. apply (apart (number start T s)); [exact first|]. apply number_is; lra.
Qed.
