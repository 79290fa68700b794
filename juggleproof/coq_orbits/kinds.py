"""The texts in a file of Coq that differ between a map and a relation: the state after a state, the
orbit, and the theorems of Rules.v, Lyapunov.v and Relation.v that conclude.
"""

from __future__ import annotations

# `$F` is the map or relation; `$after` a state after of_s, `$step` says that it is, `$by` is a
# proof; `$at_n` the state after of_n steps from `$start`, on the orbit or execution `$orbit`.
WORDS = {
    "map": {
        "M": "Map",
        "stable": "States.stable",
        "attracting": "States.attracting",
        "F": "Map.f$a",
        "st": "of_s",
        "step": "",
        "by": "",
        "after": "(Map.f$a of_s)",
        "orbit": "of_s",
        "run": "",
        "runs": "",
        "start": "of_s",
        "at_n": "(Rules.iterate (Map.f$a) of_n of_s)",
        "at_n_k": "(Rules.iterate (Map.f$a) (of_n + of_k) of_s)",
    },
    "relation": {
        "M": "Relation",
        "stable": "States.executions_stable",
        "attracting": "States.executions_attracting",
        "F": "Relation.next$a",
        "st": "of_s of_t",
        "step": "Relation.next$a of_s of_t -> ",
        "by": " of_moves",
        "after": "of_t",
        "orbit": "of_x",
        "run": "States.execution (Relation.next$a) of_x ->\n  ",
        "runs": " of_runs",
        "start": "(of_x 0%nat)",
        "at_n": "(of_x of_n)",
        "at_n_k": "(of_x (of_n + of_k)%nat)",
    },
}

STABLE = {
    "map": """\
Definition stable (space : State -> Prop) (f : State -> State) (e : State) : Prop :=
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\\
  forall s, space s -> (forall j, Rabs (coordinate j s - coordinate j e) < delta) ->
  forall n j, Rabs (coordinate j (Rules.iterate f n s) - coordinate j e) < epsilon.
Definition attracting (space : State -> Prop) (f : State -> State) (e : State) : Prop :=
  forall s, space s -> forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat ->
  forall j, Rabs (coordinate j (Rules.iterate f n s) - coordinate j e) < epsilon.""",
    "relation": """\
Definition execution (next : State -> State -> Prop) (x : nat -> State) : Prop :=
  forall n, next (x n) (x (S n)).
Definition executions_stable (space : State -> Prop) (next : State -> State -> Prop)
    (e : State) : Prop :=
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\\ forall x, execution next x ->
  space (x 0%nat) -> (forall j, Rabs (coordinate j (x 0%nat) - coordinate j e) < delta) ->
  forall n j, Rabs (coordinate j (x n) - coordinate j e) < epsilon.
Definition executions_attracting (space : State -> Prop) (next : State -> State -> Prop)
    (e : State) : Prop :=
  forall x, execution next x -> space (x 0%nat) ->
  forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat ->
  forall j, Rabs (coordinate j (x n) - coordinate j e) < epsilon.""",
}

# The point of the module `$around` is fixed: no other state comes after it.
FIXED = {
    "map": "Map.f$a ($around.point$a) = $around.point$a",
    "relation": """\
(forall of_t,
    Relation.next$a ($around.point$a) of_t <-> of_t = $around.point$a)""",
}
POINT = "(fun of_j => States.coordinate of_j ($around.point$a))"

_WEIGHTS = "(fun of_j => States.coordinate of_j (Contraction.weights$a))"
_MAP_NORM = f"""\
(Map.f$a) States.coordinate $e
    {_WEIGHTS} (Contraction.set$a)
    (Contraction.rate$a)"""
_NORM = f"""\
States.coordinate $e (Contraction.set$a)
    {_WEIGHTS} (Contraction.rate$a)"""
_PREMISES = """
    (of_set_kept$a of_dom) of_rate (of_closer$a of_dom)"""

_PREMISES_OF_RANKS = """\
(of_rank_bounded$a of_dom) (of_rank_falls$a of_dom)
    (of_stages_lead_on$a of_dom) (of_last_stage_kept$a of_dom)"""
_KEEPS = "(fun $st => of_map_keeps$a $st (${P}_inside$a of_dom))"
_RANKS = "(Descent.guards$a) (Descent.ranks$a) $count $size"
_BY_RANKS = {
    "map": f"""\
(Map.f$a) (Map.space$a) (Descent.stages$a)
    {_RANKS} {_KEEPS}
    {_PREMISES_OF_RANKS}""",
    "relation": f"""\
(Relation.next$a) (Relation.space$a)
    {_KEEPS} (Descent.stages$a)
    {_RANKS}
    {_PREMISES_OF_RANKS}""",
}
# The least number that `$lates` say to be at least a rank of one component, less $extra.
_LEFT = "(fun _ => INR of_n - INR $extra) of_n"

DESCENT = {
    "map": {
        "descent": f"""\
Rules.descent (Map.f$a) (Map.space$a) (Descent.rank$a) (Descent.stages$a)
    {_KEEPS}
    {_PREMISES_OF_RANKS}""",
        "greatest": f"Ranks.greatest_descent {_BY_RANKS['map']} eq_refl of_s\n    {_LEFT}",
        "lexicographic": f"Ranks.lexicographic_descent {_BY_RANKS['map']} of_s",
    },
    "relation": {
        "descent": f"""\
Executions.relation_descent (Relation.next$a) (Relation.space$a)
    {_KEEPS} (Descent.rank$a) (Descent.stages$a)
    {_PREMISES_OF_RANKS}""",
        "greatest": f"""\
RelationRanks.relation_greatest_descent {_BY_RANKS["relation"]} of_x
    {_LEFT} eq_refl""",
        "lexicographic": f"""\
RelationRanks.relation_lexicographic_descent {_BY_RANKS["relation"]} of_x""",
    },
}

CONTRACTION = {
    "map": {
        "alone": "",
        "fixed": f"apply (Rules.fixed_point {_MAP_NORM} (of_closer$a of_dom)); [|reflexivity].",
        "stability": f"Rules.stability {_MAP_NORM}{_PREMISES} (Map.space$a)",
        "contraction": f"Rules.contraction {_MAP_NORM}{_PREMISES}",
        "convergence": f"""\
Rules.convergence {_MAP_NORM}{_PREMISES} (Contraction.set$a) of_low of_high
    of_below_1 of_positive of_between (fun _ => 0) (Contraction.set$a :: nil)%list
    (Contraction.size$a) (of_set_kept$a of_dom) (fun _ _ => Rle_refl 0)
    (fun _ of_in => or_introl (ex_intro _ 0%nat of_in))
    ltac:(intros of_k of_t of_less; cbn in of_less; lia)
    (fun of_t _ => of_set_kept$a of_dom of_t) (fun _ _ of_in => of_in) (Rlt_le _ _ of_size)
    (fun of_t _ => of_small$a of_dom of_t)""",
    },
    "relation": {
        "alone": "apply (of_only_next$a _ of_map of_there). intros of_t of_moves.\n  ",
        "fixed": f"""\
apply (Executions.relation_fixed_point (Relation.next$a) {_NORM}
    (of_closer$a of_dom) (Contraction.point$a) of_t); [|exact of_moves|reflexivity].""",
        "stability": f"""\
Executions.relation_stability (Relation.next$a) (Relation.space$a)
    {_NORM}{_PREMISES}""",
        "contraction": f"""\
fun of_n of_c of_x of_runs of_1 => Executions.relation_contraction (Relation.next$a)
    {_NORM}{_PREMISES}
    of_n of_c of_x of_1 of_runs""",
        "convergence": f"""\
Executions.relation_convergence (Relation.next$a) {_NORM}{_PREMISES}
    of_low of_high of_below_1 of_positive of_between (Contraction.size$a) (Rlt_le _ _ of_size)
    (of_small$a of_dom)""",
    },
}

LYAPUNOV = {
    "map": {
        "alone": "",
        "at_point": "of_at (fun _ => eq_refl)",
        "rules": "Lyapunov.lyapunov",
        "system": "(Map.f$a) States.coordinate $e\n      (Map.space$a)",
        "orbits": "(Map.f$a) States.coordinate $e\n     ",
    },
    "relation": {
        "alone": """\
apply (of_only_next$a ($around.point$a) of_map of_at). intros of_t of_moves.
    pose proof (of_map_keeps$a ($around.point$a) of_t of_map of_at of_moves) as of_there.
    destruct (of_goes_on$a of_t of_map of_there) as [of_u of_on].
    """,
        "at_point": "of_t of_u of_at (fun _ => eq_refl) of_moves of_on",
        "rules": "Executions.relation_lyapunov",
        "system": "(Relation.next$a) (Relation.space$a) States.coordinate\n      $e",
        "orbits": "(Relation.next$a) States.coordinate $e\n     ",
    },
}

# A set that the descent enters, and stays in.
ENTERED = {
    "map": {
        "kept": "(Rules.iterate_keeps (Map.f$a) (Map.space$a) of_keeps of_n of_s of_there)",
        "from_a_set": """\
Lyapunov.attraction_from_a_set (Map.f$a) States.coordinate $e
    (Map.space$a)""",
        "approach": """\
rewrite Rules.iterate_add.
    exact (of_nearer of_k _ _ (Rlt_le _ _ of_size) of_in (of_small$a of_near _ of_in)).""",
    },
    "relation": {
        "kept": """\
(Executions.execution_keeps (Relation.next$a) (Relation.space$a) of_keeps
      of_x of_n of_runs of_there)""",
        "from_a_set": """\
Executions.relation_attraction (Relation.next$a) (Relation.space$a) States.coordinate
    $e""",
        "approach": """\
rewrite <- (Nat.add_0_r of_n) in of_in.
    exact (of_nearer of_k _ (fun of_m => of_x (of_n + of_m)%nat)
      (Executions.execution_later _ of_n of_x of_runs) (Rlt_le _ _ of_size) of_in
      (of_small$a of_near _ of_in)).""",
    },
}

# The same pieces on a smaller space, in the module Inner; the keys are the kind on the larger space
# and that on the smaller.
INTO = {
    ("map", "map"): {
        "into": "Lyapunov.into",
        "same_step": "Map.f$a of_s = Inner.Map.f$a of_s",
        "agree": """\
intros of_s of_there of_within.
    destruct (of_map_moves$a of_s of_map of_there) as $one_piece; rewrite of_same; symmetry;
      [$same].""",
    },
    ("map", "relation"): {
        "into": "RelationInto.map_into",
        "same_step": "Inner.Relation.next$a of_s (Map.f$a of_s)",
        "agree": """\
intros of_s of_there of_within.
    destruct (of_map_moves$a of_s of_map of_there) as $one_piece; rewrite of_same;
      [$moves].""",
    },
    ("relation", "relation"): {
        "into": "RelationInto.relation_into",
        "same_step": "Relation.next$a of_s of_t -> Inner.Relation.next$a of_s of_t",
        "agree": """\
intros of_s of_t of_there of_within of_moves.
    destruct of_moves as $one_piece;
      [$moves].""",
    },
}
