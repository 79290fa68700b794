"""The parts of a theorem on the orbits of any map that do not depend on its data.

`$a` are the parameters, each after a space, `$all` binds them, `$P` begins the names of the
premises of the statement, `$open` takes the state `of_s` apart, and `$s` are its coordinates. No
name of a claim begins with `of_`. The words of `kinds` are those of a map, or of a relation.
"""

from __future__ import annotations

HEADER = """\
(* $name, a theorem on the orbits of a map, for coqc alone.

   A certificate proves each premise, as a lemma on polynomials; the lemma after it is the premise
   in the words of the rule. The modules $M, Descent and so on, one for each rule, define what
   the theorem at the end speaks of; those before States hold for any map or relation. *)

"""

SAME_STATE = """\
Lemma of_same_state : forall of_s of_t,
  (forall of_j, States.coordinate of_j of_s = States.coordinate of_j of_t) -> of_s = of_t.
Proof. intros of_s of_t of_same. $open${open_t}exact $equal. Qed.
"""

MAP = """\
Lemma of_map_moves : ${all}forall of_s, Map.domain$a -> Map.space$a of_s ->
  $moves.
Proof.
  intros$a of_s of_map of_there. unfold Map.f.
  $decided
  exfalso. ${open}pose proof (${P}_covers$a $s of_map of_there) as $one_guard; [$none].
Qed.

Lemma of_map_keeps : ${all}forall of_s, Map.domain$a -> Map.space$a of_s ->
  Map.space$a (Map.f$a of_s).
Proof.
  intros$a of_s of_map of_there.
  $stays
Qed.
"""

PIECE = """\
Lemma of_map_is_$k : ${all}forall of_s, Map.domain$a -> Map.space$a of_s ->
  Map.guard_$k$a of_s -> Map.f$a of_s = Map.image_$k$a of_s.
Proof.
  intros$a of_s of_map of_there of_here.
  destruct (of_map_moves$a of_s of_map of_there) as $one_piece.
  $others
Qed.
"""

RELATION = """\
Lemma of_goes_on : ${all}forall of_s, Relation.domain$a -> Relation.space$a of_s ->
  exists of_t, Relation.next$a of_s of_t.
Proof.
  intros$a of_s of_map of_there.
  ${open}pose proof (${P}_covers$a $s of_map of_there) as $some_guard; [$an_image].
Qed.

Lemma of_map_keeps : ${all}forall of_s of_t, Relation.domain$a -> Relation.space$a of_s ->
  Relation.next$a of_s of_t -> Relation.space$a of_t.
Proof.
  intros$a of_s of_t of_map of_there of_moves.
  $stays
Qed.

Lemma of_only_next : ${all}forall of_s, Relation.domain$a -> Relation.space$a of_s ->
  (forall of_t, Relation.next$a of_s of_t -> of_t = of_s) ->
  forall of_t, Relation.next$a of_s of_t <-> of_t = of_s.
Proof.
  intros$a of_s of_map of_there of_only of_t. split; [apply of_only|intros ->].
  destruct (of_goes_on$a of_s of_map of_there) as [of_next of_moves].
  rewrite (of_only of_next of_moves) in of_moves. exact of_moves.
Qed.

(* Each state of the space has a next one, and all next ones are in the space. *)
Theorem $theorem : ${all}Relation.domain$a -> forall of_s, Relation.space$a of_s ->
  (exists of_t, Relation.next$a of_s of_t) /\\
  forall of_t, Relation.next$a of_s of_t -> Relation.space$a of_t.
Proof.
  intros$a of_map of_s of_there. split; [exact (of_goes_on$a of_s of_map of_there)|].
  intro of_t. exact (of_map_keeps$a of_s of_t of_map of_there).
Qed.
"""

# The beginning of proofs about the next state, which is in the space.
NEXT = """\
assert (of_map : ${M}.domain$a) by exact (${P}_inside$a of_dom).
  assert (of_next := of_map_keeps$a $st of_map of_there$by)."""

CONSTANTS = """\
destruct (of_constants$a of_dom) as (of_rate & of_below_1 & of_radius & of_size & of_low & of_high
    & of_positive & of_between)."""

CONTRACTS = """\
Lemma of_near_is : ${all}forall of_c of_s, Contraction.near$a of_c of_s <->
  $inequalities.
Proof.
  intros$a of_c of_s. split.
  { intro of_close. exact $forth. }
  { intros $each_axis []; [$back]. }
Qed.

Lemma of_constants : ${all}Contraction.domain$a ->
  0 <= Contraction.rate$a /\\ Contraction.rate$a < 1 /\\ 0 < Contraction.radius$a /\\
  0 < Contraction.size$a /\\ exists of_low of_high, 0 < of_low /\\
  forall of_j, of_low <= States.coordinate of_j (Contraction.weights$a) <= of_high.
Proof.
  intros$a of_dom. destruct (${P}_constants$a of_dom) as $numbers.
  split; [exact (Rge_le _ _ of_least)|split; [exact of_most|]].
  split; [exact of_radius|split; [exact of_size|]].
  apply (bounds_of _ ($axes)%list).
  { intros []; repeat (first [left; reflexivity|right]). }
  { intros []; [$positive]. }
Qed.

Lemma of_closer : ${all}Contraction.domain$a ->
  forall of_c $st, 0 <= of_c -> Contraction.set$a of_s -> ${step}Contraction.near$a of_c of_s ->
  Contraction.near$a (Contraction.rate$a * of_c) $after.
Proof.
  intros$a of_dom of_c $st of_positive [of_there of_in]$by of_close. $next
  apply (of_near_is$a _ _) in of_close. apply (of_near_is$a _ _).
  pose proof (Rle_ge _ _ of_positive) as of_distance.
  $closer
Qed.

Lemma of_set_kept : ${all}Contraction.domain$a ->
  forall $st, Contraction.set$a of_s -> ${step}Contraction.set$a $after.
Proof.
  intros$a of_dom $st [of_there of_in]$by. $next
  split; [exact of_next|].
  $stays
Qed.

Lemma of_surrounded : ${all}Contraction.domain$a -> forall of_s, ${M}.space$a of_s ->
  Contraction.near$a (Contraction.radius$a) of_s -> Contraction.set$a of_s.
Proof.
  intros$a of_dom of_s of_there of_in. apply (of_near_is$a _ _) in of_in.
  split; [exact of_there|]. ${open}exact (${P}_surrounds$a $s of_dom of_there of_in).
Qed.

Lemma of_small : ${all}Contraction.domain$a -> forall of_s, Contraction.set$a of_s ->
  Contraction.near$a (Contraction.size$a) of_s.
Proof.
  intros$a of_dom of_s [of_there of_in]. apply (of_near_is$a _ _).
  ${open}exact (${P}_size$a $s of_dom of_there of_in).
Qed.

(* The point is fixed, stable, and attracts the set, at the rate. *)
Theorem $theorem : ${all}Contraction.domain$a ->
  ${M}.space$a (Contraction.point$a) /\\ $is_fixed /\\
  $stable (${M}.space$a) ($F) (Contraction.point$a) /\\
  $attracting (Contraction.set$a) ($F) (Contraction.point$a) /\\
  forall of_n of_c $orbit, ${run}0 <= of_c ->
  Contraction.set$a $start -> Contraction.near$a of_c $start ->
  Contraction.near$a (Contraction.rate$a ^ of_n * of_c) $at_n.
Proof.
  intros$a of_dom. $constants
  assert (of_map : ${M}.domain$a) by exact (${P}_inside$a of_dom).
  assert (of_there : ${M}.space$a (Contraction.point$a)) by exact (${P}_point$a of_dom).
  split; [exact of_there|split; [|split; [|split]]].
  { ${alone}apply of_same_state. $fixed
    apply (of_surrounded$a of_dom); [exact of_there|].
    intro of_j. unfold Rminus. rewrite Rplus_opp_r, Rabs_R0.
    apply Rmult_le_pos; [lra|destruct (of_between of_j); lra]. }
  { exact ($stability (Contraction.radius$a)
    of_low of_high of_below_1 of_positive of_between of_radius (of_surrounded$a of_dom)). }
  { exact ($convergence). }
  { exact ($contraction). }
Qed.
"""

# `$E` are the coordinates of the point, if premises are about all points for which the lines `have`
# hold; `$H` are proofs of these lines. `$gaps` are the coordinates of the state less those of the
# point, `$sums` the state as the sum; `$here` says that of_v is at least the value.
LYAPUNOV = """\
Lemma of_near_point_is : ${all}forall of_c of_s, LyapunovFunction.near$a of_c of_s <->
  $inequalities.
Proof.
  intros$a of_c of_s. split.
  { intro of_close. exact $forth. }
  { intros $each_axis []; [$back]. }
Qed.

(* The point is fixed, stable, and attracts the set. *)
Theorem $theorem : ${all}LyapunovFunction.domain$a ->
  ${M}.space$a (LyapunovFunction.point$a) /\\
  $is_fixed /\\
  $stable (${M}.space$a) ($F) (LyapunovFunction.point$a) /\\
  $attracting (LyapunovFunction.set$a) ($F) (LyapunovFunction.point$a).
Proof.
  intros$a of_dom. pose proof (${P}_point$a of_dom) as $point.
  assert (of_map : ${M}.domain$a) by exact (${P}_inside$a$E of_dom$H).
  destruct (${P}_constants$a$E of_dom$H) as [of_radius of_upper].
  assert (of_positive : forall of_d of_c, 0 < of_d -> 0 <= of_c ->
    0 < LyapunovFunction.least$a of_d of_c).
  { intros of_d of_c of_1 of_2.
    exact (${P}_positive$a$E of_d of_c of_dom$H of_1 (Rle_ge _ _ of_2) (one_more _ of_2)). }
  assert (of_surrounded : forall of_s, ${M}.space$a of_s ->
    LyapunovFunction.near$a (LyapunovFunction.radius$a) of_s -> LyapunovFunction.set$a of_s).
  { intros of_s of_there of_close. apply (of_near_point_is$a _ _) in of_close.
    split; [exact of_there|].
    ${open}exact (${P}_surrounds$a$E $gaps of_dom$H $sums of_there of_close). }
  assert (of_small : forall of_i of_s of_d, (of_i < $count)%nat -> ${M}.space$a of_s -> 0 <= of_d ->
    LyapunovFunction.near$a of_d of_s -> of_d <= LyapunovFunction.radius$a ->
    LyapunovFunction.guards$a of_i of_s ->
    LyapunovFunction.values$a of_i of_s <= LyapunovFunction.upper$a * of_d).
  { intros $each_value of_s of_d of_less of_there of_1 of_close of_2 of_here;
      [$small|exfalso; lia]. }
  assert (of_kept : forall $st,
    LyapunovFunction.set$a of_s -> ${step}LyapunovFunction.set$a $after).
  { intros $st [of_there of_in]$by.
    assert (of_next := of_map_keeps$a $st of_map of_there$by). split; [exact of_next|].
    $stays }
  pose (of_above := Lyapunov.above (LyapunovFunction.guards$a) (LyapunovFunction.values$a) $count).
  assert (of_bounded : forall of_s of_v, LyapunovFunction.set$a of_s -> of_above of_s of_v ->
    0 <= of_v).
  { intros of_s of_v [of_there of_in] of_high. $here
    ${open}exact (Rge_le _ _ (${P}_bounded$a$E $gaps of_v of_dom$H $sums of_there of_in
      $at_least)). }
  assert (of_loses : forall of_s of_v, LyapunovFunction.set$a of_s -> of_above of_s of_v ->
    0 <= of_v -> 0 <= $loss).
  { intros of_s of_v [of_there of_in] of_high of_1. $own_value$here
    ${open}exact (Rge_le _ _ (${P}_loss$a$E $gaps$v of_dom$H $sums of_there of_in$given)). }
  assert (of_least : forall of_s of_v of_d of_c, LyapunovFunction.set$a of_s ->
    of_above of_s of_v -> 0 <= of_v -> 0 < of_d -> 0 <= of_c ->
    Lyapunov.far States.coordinate (fun of_j => States.coordinate of_j (LyapunovFunction.point$a))
      of_d of_s -> of_v <= of_c -> LyapunovFunction.least$a of_d of_c <= $loss).
  { intros of_s of_v of_d of_c [of_there of_in] of_high of_1 of_2 of_3 of_far of_4.
    assert (of_apart : $far).
    { destruct of_far as [[] of_far]; apply far_is in of_far; [$each_far]. }
    $own_value$level$here
    ${open}exact (Rge_le _ _ (${P}_least$a$E $gaps $value of_d of_c of_dom$H $sums of_there of_in
      $reached (Rle_ge _ _ of_1) (one_more _ of_1) of_2 (Rle_ge _ _ of_3) (one_more _ of_3)
      of_apart (Rle_ge _ _ of_4))). }
  assert (of_falls : forall of_i $st of_v, (of_i < $count)%nat -> LyapunovFunction.set$a of_s ->
    ${step}of_above of_s of_v -> 0 <= of_v -> LyapunovFunction.guards$a of_i $after ->
    LyapunovFunction.values$a of_i $after <= of_v - $loss).
  { intros $each_value $st of_v of_less [of_there of_in]$by of_high of_1 of_guard.
    $falls
    exfalso; lia. }
  split; [exact of_at|split; [|split]].
  { ${alone}apply of_same_state.
    exact (${rules}_fixed_point $function of_radius of_positive of_surrounded of_small
      of_kept of_bounded of_loses of_least of_falls (LyapunovFunction.point$a) $at_point). }
  { exact (${rules}_stability $function of_radius of_upper of_positive of_surrounded
      of_small of_kept of_bounded of_loses of_least of_falls). }
  { exact (${rules}_attraction $attraction of_positive of_kept of_bounded of_loses
      of_least of_falls). }
Qed.
"""

# The least value of a function without guards, in place of a number that is at least the value.
OWN_VALUE = """\
assert (of_own : LyapunovFunction.value_1$a of_s <= of_v) by exact (of_high 0%nat ltac:(lia) I).
    clear of_1. assert (of_1 : of_above of_s (LyapunovFunction.value_1$a of_s)).
    { intros [|of_i] of_first _; [apply Rle_refl|exfalso; lia]. }
    apply (of_bounded of_s _ (conj of_there of_in)) in of_1.
    """

UNSTABLE = """\
Lemma of_near_centre_is : ${all}forall of_c of_s, ChetaevFunction.near$a of_c of_s <->
  $inequalities.
Proof.
  intros$a of_c of_s. split.
  { intro of_close. exact $forth. }
  { intros $each_axis []; [$back]. }
Qed.

(* The point is not stable. *)
Theorem $theorem : ${all}ChetaevFunction.domain$a ->
  ~ States.stable (Map.space$a) (Map.f$a) (ChetaevFunction.point$a).
Proof.
  intros$a of_dom. pose proof (${P}_point$a of_dom) as $point.
  assert (of_map : Map.domain$a) by exact (${P}_inside$a$E of_dom$H).
  destruct (${P}_constants$a$E of_dom$H) as [of_rate [of_radius of_upper]].
  refine (Lyapunov.chetaev_instability (Map.f$a) States.coordinate
    (fun of_j => States.coordinate of_j (ChetaevFunction.point$a)) (Map.space$a)
    (ChetaevFunction.guards$a) (ChetaevFunction.values$a) $count (ChetaevFunction.direction$a)
    (ChetaevFunction.rate$a) (ChetaevFunction.radius$a) (ChetaevFunction.upper$a)
    of_rate of_radius (fun of_s => of_map_keeps$a of_s of_map) _ _ _).
  { intros of_d of_1 of_2. split; [exact (${P}_direction_line_$line$a$E of_d of_dom$H of_1 of_2)|].
    destruct (${P}_direction$a$E of_d of_dom$H of_1 of_2) as [of_close of_start].
    split; [apply (of_near_centre_is$a _ _); exact of_close|].
    revert of_start. intros $values; [$starts]. }
  { intros $each_value of_s of_less of_there of_close of_here of_1;
      [$bounded|exfalso; lia]. }
  { intros $each_value of_s of_less of_there of_close of_here of_1.
    $grows
    exfalso; lia. }
Qed.
"""

ATTRACTS = """\
(* The point is stable and attracts every state$within_a_bound. *)
Theorem $theorem : ${all}Descent.domain$a ->
  $stable (${M}.space$a) ($F) ($around.point$a) /\\
  $attracting (${M}.space$a) ($F) ($around.point$a)$bound.
Proof.
  intros$a of_dom. assert (of_near : $around.domain$a) by exact (${P}_inside$a of_dom).
  destruct ($settles$a of_near) as (_ & _ & of_stays & $tends).
  pose (of_keeps $st := of_map_keeps$a $st (${descent}_inside$a of_dom)).
  assert (of_into : forall of_s, ${M}.space$a of_s -> Descent.stage_$last$a of_s ->
    $around.set$a of_s).
  { intros of_s of_there of_in. split; [exact of_there|].
    ${open}exact (${P}_enters$a $s of_dom of_there of_in). }
  split; [exact of_stays|$split].
  { refine ($from_a_set
      ($around.set$a) _ of_tends).
    intros $orbit$runs of_there.
    destruct (of_last_stage_reached$a of_dom $orbit$runs of_there) as [of_n of_in].
    exists of_n. exact (of_into _
      $kept of_in). }$bounded
Qed.
"""

BOUND = """ /\\
  forall $orbit$n, ${run}${M}.space$a $start ->
  ${late}Contraction.near$a (Contraction.rate$a ^ of_k * Contraction.size$a)
    $at_n_k"""

BOUNDED = """
  { $by_then
    pose proof (of_into _
      $kept
      $there) as of_in.
    destruct (of_constants$a of_near) as (_ & _ & _ & of_size & _).
    $approach }"""

# The last stage from a number of steps on that a theorem gives, or says to exist.
IN_TIME = {
    True: {
        "by_then": "intros $orbit$n$runs of_there$lates.",
        "there": "($descends $orbit of_n$runs of_there$lates)",
    },
    False: {
        "by_then": """\
intros $orbit$n$runs of_there. destruct ($descends $orbit$runs of_there) as [of_N of_last].
    exists of_N. intros of_n of_k of_late.""",
        "there": "(of_last of_n of_late)",
    },
}

INTO = """\
(* The point is stable and attracts every state, on the larger space. *)
Theorem $theorem : ${all}Descent.domain$a ->
  $stable (${M}.space$a) ($F) ($around.point$a) /\\
  $attracting (${M}.space$a) ($F) ($around.point$a).
Proof.
  intros$a of_dom.
  assert (of_map : ${M}.domain$a) by exact (${descent}_inside$a of_dom).
  assert (of_inner : Inner.Descent.domain$a) by exact (${P}_inside$a of_dom).
  assert (of_inner_map : Inner.${N}.domain$a) by exact (${inner}_inside$a of_inner).
  assert (of_agree : forall $st, ${M}.space$a of_s -> Inner.${N}.space$a of_s ->
    $same_step).
  { $agree }
  pose (of_keeps $st := of_map_keeps$a $st of_map).
  pose (of_inner_keeps $inner_st := Inner.of_map_keeps$a $inner_st of_inner_map). split.
  { refine (${into}_stability ($F) (Inner.$G) States.coordinate
      (fun of_j => States.coordinate of_j ($around.point$a)) (${M}.space$a) (Inner.${N}.space$a)
      (Into.radius$a) of_keeps of_inner_keeps of_agree _ _ (proj1 ($attraction$a of_inner))).
    { exact (${P}_constants$a of_dom). }
    { intros of_s of_there of_close. pose proof $within as of_within.
      ${open}exact (${P}_surrounds$a $s of_dom of_there of_within). } }
  refine (${into}_attraction ($F) (Inner.$G) States.coordinate
    (fun of_j => States.coordinate of_j ($around.point$a)) (${M}.space$a) (Inner.${N}.space$a)
    of_keeps of_inner_keeps of_agree _ ($tends ($attraction$a of_inner))).
  assert (of_enters : forall of_s, ${M}.space$a of_s -> Descent.stage_$last$a of_s ->
    Inner.${N}.space$a of_s).
  { intros of_s of_there of_in. ${open}exact (${P}_enters$a $s of_dom of_there of_in). }
  intros $orbit$runs of_there.
  destruct (of_last_stage_reached$a of_dom $orbit$runs of_there) as [of_n of_in].
  exists of_n. exact (of_enters _
    $kept of_in).
Qed.
"""

ESCAPES = """\
Lemma of_periodic : ${all}Escape.domain$a -> Map.space$a (Escape.start$a) /\\
  Rules.iterate (Map.f$a) $period (Escape.start$a) = Escape.start$a /\\
  exists of_j, States.coordinate of_j (Escape.start$a) <> States.coordinate of_j (Escape.point$a).
Proof.
  intros$a of_dom.
  assert (of_map : Map.domain$a) by exact (${P}_inside$a of_dom).
  destruct (${P}_start$a of_dom) as $shown.
  change (Map.space$a (Escape.start$a)) in of_there_0.
  $steps
  split; [exact of_there_0|split; [|$apart]].
  cbn [Rules.iterate]. rewrite $rewritten. exact $equal.
Qed.

(* The orbit of the start is periodic, and the point does not attract it. *)
Theorem $theorem : ${all}Escape.domain$a -> Map.space$a (Escape.start$a) /\\
  Rules.iterate (Map.f$a) $period (Escape.start$a) = Escape.start$a /\\
  Escape.start$a <> Escape.point$a /\\
  ~ States.attracting (Map.space$a) (Map.f$a) (Escape.point$a).
Proof.
  intros$a of_dom. destruct (of_periodic$a of_dom) as (of_there & of_back & of_j & of_apart).
  split; [exact of_there|split; [exact of_back|split]].
  { intro of_same. apply of_apart. now rewrite of_same. }
  { intro of_all. exact (Rules.periodic_orbit_stays_away (Map.f$a) States.coordinate
      (fun of_j => States.coordinate of_j (Escape.point$a)) $period (Escape.start$a) of_j
      ltac:(lia) of_back of_apart (of_all _ of_there)). }
Qed.
"""

EXACTLY = """\
(* The point is stable and attracts every state just for the parameters of the descent. *)
Theorem $theorem : ${all}Map.domain$a ->
  (Descent.domain$a <-> States.stable (Map.space$a) (Map.f$a) ($around.point$a) /\\
   States.attracting (Map.space$a) (Map.f$a) ($around.point$a)).
Proof.
  intros$a of_map. apply (Rules.exactly _ _ ($domains :: nil)%list).
  { destruct (${P}_covers$a of_map) as $alternatives; [$covered]. }
  { intro of_dom. split; [exact (proj1 ($attraction$a of_dom))|].
    exact ($tends ($attraction$a of_dom)). }
  $refuted
  apply Forall_nil.
Qed.
"""

# `$within` is the module of the refutation.
ESCAPE_REFUTES = """\
apply Forall_cons.
  { intros of_out [_ of_all]. revert of_all.
    refine (Rules.escape_refutes (Map.f$a) States.coordinate
      (fun of_j => States.coordinate of_j ($around.point$a))
      (fun of_j => States.coordinate of_j ($within.Escape.point$a)) (Map.space$a) $period
      ($within.Escape.start$a) ltac:(lia) ($within.of_periodic$a of_out) _).
    pose proof (${P}_same_point_$k$a of_out) as $each_axis. intros []; [$back]. }
"""

INSTABILITY_REFUTES = """\
apply Forall_cons.
  { intros of_out [of_all _]. revert of_all.
    refine (Lyapunov.instability_refutes (Map.f$a) States.coordinate
      (fun of_j => States.coordinate of_j ($around.point$a))
      (fun of_j => States.coordinate of_j ($within.ChetaevFunction.point$a)) (Map.space$a)
      ($within.$refutes$a of_out) _).
    pose proof ($within.$at_point$a of_out) as $point.
    pose proof (${P}_same_point_$k$a$E of_out$H) as $each_axis. intros []; [$back]. }
"""
