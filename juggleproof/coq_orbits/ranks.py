"""Ranks that fall along orbits until these are in a stage, as theorems of Coq: the rule on descent.

A rank of one term is a function of the state.  A rank of several terms is replaced by numbers of_v,
one for each component, that are at least the terms whose guards hold: proofs/coq/orbits/Ranks.v.
"""

from __future__ import annotations

from collections.abc import Iterator

from juggleproof.certificates import checker
from juggleproof.coq_orbits import kinds
from juggleproof.coq_orbits.frame import Frame, nested
from juggleproof.coq_store.text import conjoined, conjunctive, disjunctive

# The beginning of proofs about the next state, which is in the space.
NEXT = """\
assert (of_map : ${M}.domain$a) by exact (${P}_inside$a of_dom).
  assert (of_next := of_map_keeps$a $st of_map of_there$by)."""

# `$of_v` binds numbers, `$above` says that they are at least the rank, `$lower` that a rank is
# less.
DESCENT = """\
Lemma of_rank_bounded : ${all}Descent.domain$a ->
  forall of_s$of_v, ${M}.space$a of_s -> ${above}$positive.
Proof.
  intros$a of_dom of_s$of_v of_there$of_high. $bounded
Qed.

Lemma of_staged : ${all}forall of_s, {$staged} + {~ ($staged)}.
Proof. intros$a of_s. ${open}cbv beta iota zeta delta [$stage_names]. decidable. Qed.

Lemma of_rank_falls : ${all}Descent.domain$a -> forall $st$of_v, ${M}.space$a of_s ->
  $step${above}(exists of_k, Rules.stage (Descent.stages$a) of_k of_s) \\/
  $lower.
Proof.
  intros$a of_dom $st$of_v of_there$by$of_high. $next
  destruct (of_staged$a of_s) as [of_in|of_out]; [left|right].
  { $in_a_stage }
  $falls
Qed.
"""

ONE_TERM = {
    "of_v": "",
    "of_high": "",
    "above": "",
    "positive": "0 <= Descent.rank$a of_s",
    "lower": "Descent.rank$a $after <= Descent.rank$a of_s - 1",
    "bounded": "${open}exact (Rge_le _ _ (${P}_bounded$a $s of_dom of_there)).",
}
SEVERAL_TERMS = {
    "of_v": " of_v",
    "of_high": " of_high",
    "above": """\
Ranks.above_rank (Descent.guards$a) (Descent.ranks$a) $count $size of_s of_v ->
  """,
    "positive": "Ranks.not_negative $size of_v",
    "lower": """\
exists of_c, (of_c < $size)%nat /\\ forall of_i, (of_i < $count)%nat ->
    Descent.guards$a of_i $after ->
    (forall of_b, (of_b < of_c)%nat -> Descent.ranks$a of_i of_b $after <= of_v of_b) /\\
    Descent.ranks$a of_i of_c $after <= of_v of_c - 1""",
    "bounded": """\
$here
  intros $each_component of_less; [$components|exfalso; lia].""",
}

STAGE = """\
Lemma of_stage_$k : ${all}Descent.domain$a -> forall $st, ${M}.space$a of_s ->
  ${step}Descent.stage_$k$a of_s -> Descent.stage_$following$a $after.
Proof.
  intros$a of_dom $st of_there$by of_in. $next
  $leads
Qed.
"""

# `$late` says of of_n, or of all from some number on, that the last stage is reached by then.
DESCENDS = """\
Lemma of_stages_lead_on : ${all}Descent.domain$a ->
  forall of_k $st, (S of_k < length (Descent.stages$a))%nat -> ${M}.space$a of_s ->
  ${step}Rules.stage (Descent.stages$a) of_k of_s ->
  Rules.stage (Descent.stages$a) (S of_k) $after.
Proof.
  intros$a of_dom $each_stage $st of_less of_there$by of_in; [${lead_on}cbn in of_less; lia].
Qed.

Lemma of_last_stage_kept : ${all}Descent.domain$a -> forall $st, ${M}.space$a of_s ->
  ${step}Rules.last_stage (Descent.stages$a) of_s -> Rules.last_stage (Descent.stages$a) $after.
Proof.
  intros$a of_dom $st of_there$by of_in. exact (of_stage_$last$a of_dom $st of_there$by of_in).
Qed.

Theorem $theorem : ${all}Descent.domain$a -> forall $orbit$n, ${run}${M}.space$a $start ->
  ${late}Descent.stage_$last$a $at_n.
Proof.
  intros$a of_dom $orbit$n$runs of_there$lates.
  $descends
Qed.

Lemma of_last_stage_reached : ${all}Descent.domain$a -> forall $orbit, ${run}${M}.space$a $start ->
  exists of_n, Descent.stage_$last$a $at_n.
Proof.
  intros$a of_dom $orbit$runs of_there.
  $reached
Qed.
"""

BY_ONE_TERM = {
    "descends": "exact ($descent $orbit of_n$runs of_there of_late).",
    "reached": """\
destruct (Rules.exceeded_by_a_number (Descent.rank$a $start + INR $extra)) as [of_n of_late].
  exists of_n. exact ($theorem$a of_dom $orbit of_n$runs of_there of_late).""",
}
BY_ONE_COMPONENT = {
    "descends": """\
assert (of_enough : INR of_n - INR $extra + INR $extra <= INR of_n) by lra.
  refine ($greatest$runs of_there _ of_enough).
  intros of_i of_c of_less of_lower of_guard. replace of_c with 0%nat by lia.
  destruct of_i as $each_line; [$early|exfalso; lia].""",
    "reached": """\
destruct (Rules.exceeded_by_a_number
    (Ranks.top (Descent.ranks$a) $count 0 $start + INR $extra)) as [of_n of_late].
  pose proof (Ranks.top_is_above (Descent.ranks$a) $count 0 $start) as of_top.
  exists of_n. apply ($theorem$a of_dom $orbit of_n$runs of_there).
  $each_late""",
}
BY_COMPONENTS = {
    "descends": "exact ($lexicographic$runs of_there).",
    "reached": """\
destruct ($theorem$a of_dom $orbit$runs of_there) as [of_N of_late].
  exists of_N. exact (of_late of_N (le_n of_N)).""",
}


def has_one_term(own: checker.Statement) -> bool:
    """Whether the rank is one term, without a guard."""
    return [(guards, len(terms)) for guards, terms in own.get("rank")] == [([], 1)]


def components(own: checker.Statement) -> range:
    """The components of the rank, from 0 on."""
    return range(len(own.get("rank")[0][1]))


def descent_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Rank and stages."""
    yield f"Module Descent.\nImport States {f.words['M']}."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    if has_one_term(own):
        yield f.define(own, "rank", "R", *own.get("rank")[0][1])
    else:
        yield from _terms(f, own)
    stages = own.get("stage")
    for k, stage in enumerate(stages, 1):
        yield f.define(own, f"stage_{k}", "Prop", stage)
    each = "".join(f"stage_{k}$a :: " for k in range(1, len(stages) + 1))
    kind = f"{f.bound} : list (State -> Prop)"
    yield f"Definition stages{kind} :=\n  ({f.fill(each, own)}nil)%list."
    yield "End Descent."


def _terms(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The terms of a rank by line and component, and the guards of the lines."""
    cases = ""
    for k, (_, terms) in enumerate(own.get("rank"), 1):
        for c, term in enumerate(terms, 1):
            yield f.define(own, f"rank_{k}_{c}", "R", term)
            cases += f.fill(f"{k - 1}%nat, {c - 1}%nat => rank_{k}_{c}$a | ", own)
    yield from f.guards(own, "rank")
    yield (
        f"Definition ranks{f.bound} (of_i of_c : nat) : State -> R :=\n"
        f"  match of_i, of_c with {cases}_, _ => fun _ => 0 end."
    )


def descent_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Every orbit is in the last stage, from a step on that the rank gives."""
    stages = range(1, len(own.get("stage")) + 1)
    last, next_ = stages[-1], f.fill(NEXT, own)
    sizes = {"count": len(own.get("rank")), "size": len(components(own))}
    if has_one_term(own):
        parts, by, bounded = ONE_TERM, BY_ONE_TERM, dict[str, str]()
        falls = f.by_pieces(own, "falls", "of_dom of_there of_out of_g of_next")
    else:
        parts = SEVERAL_TERMS
        by = BY_ONE_COMPONENT if has_end(own) else BY_COMPONENTS
        bounded, falls = _bounded(f, own), _falls(f, own)
    yield f.fill(
        DESCENT,
        own,
        next=next_,
        staged=f.fill(" \\/ ".join(f"Descent.stage_{k}$a of_s" for k in stages), own),
        stage_names=" ".join(f"Descent.stage_{k}" for k in stages),
        in_a_stage=_in_a_stage(len(stages)),
        falls=falls,
        **{word: f.fill(text, own, **sizes, **bounded) for word, text in parts.items()},
    )
    for k in stages:
        leads = f.by_pieces(own, f"stage_{k}", "of_dom of_there of_in of_g of_next")
        yield f.fill(STAGE, own, k=k, next=next_, following=min(k + 1, last), leads=leads)
    known = "of_dom $st of_there$by of_in"
    lead_on = "".join(f"exact (of_stage_{k}$a {known})|" for k in stages[:-1])
    extra = f.extra_steps(own)
    rules = f.of_kind(kinds.DESCENT, own, extra=str(extra), **{k: str(n) for k, n in sizes.items()})
    words: dict[str, str | int] = {"extra": extra, **sizes, **rules, **_by_lines(f, own)}
    yield f.fill(
        DESCENDS,
        own,
        each_stage=nested("of_k", len(stages) - 1),
        lead_on=f.fill(lead_on, own),
        last=last,
        **{word: f.fill(text, own, **words) for word, text in by.items()},
        **times(f, own),
    )


def has_end(own: checker.Statement) -> bool:
    """Whether the rank bounds the step at which the last stage is reached: it has one component."""
    return len(components(own)) == 1


def times(f: Frame, own: checker.Statement, more: str = "") -> dict[str, str]:
    """The words `$n`, `$late` and `$lates` of a theorem, which say when the last stage is reached;
    `more`: further numbers that the theorem is about.
    """
    if not has_end(own):
        late = f"exists of_N, forall of_n{more}, (of_N <= of_n)%nat ->\n  "
        return {"n": "", "late": late, "lates": ""}
    rest = f"$start + INR {f.extra_steps(own)} <= INR of_n"
    if has_one_term(own):
        rows, names = [f"Descent.rank$a {rest}"], ["of_late"]
    else:
        rows, names = [], []
        for k, (guard, _) in enumerate(own.get("rank"), 1):
            row = f"Descent.rank_{k}_1$a {rest}"
            rows.append(f"(Descent.guard_{k}$a $start -> {row})" if guard else row)
            names.append(f"of_late_{k}")
    return {
        "n": " of_n" + more,
        "late": f.fill("".join(f"{row} ->\n  " for row in rows), own),
        "lates": "".join(f" {name}" for name in names),
    }


def _here(f: Frame, own: checker.Statement) -> str:
    """Tactics that show, line by line, that the numbers of_v are at least the rank, which premises
    assume.
    """
    rows = []
    for k, (guard, _) in enumerate(own.get("rank"), 1):
        each = [f"Descent.rank_{k}_{c + 1}$a of_s <= of_v {c}%nat" for c in components(own)]
        holds = "of_g" if guard else "I"
        known = [f"of_high {k - 1}%nat {c}%nat ltac:(lia) ltac:(lia)" for c in components(own)]
        proof = conjoined([f"({one} {holds})" for one in known])
        text = " /\\ ".join(each)
        if not guard:
            rows.append(f"assert (of_here_{k} : {text}) by exact {proof}.")
            continue
        rows.append(
            f"assert (of_here_{k} : ~ Descent.guard_{k}$a of_s \\/ {text}).\n"
            f"  {{ destruct (Descent.decided_{k}$a of_s) as [of_g|of_g]; [right|left].\n"
            f"    exact {proof}. exact of_g. }}"
        )
    return f.fill("\n  ".join(rows), own)


def _arguments(own: checker.Statement) -> tuple[str, str]:
    """The numbers of_v that premises are about beside the state, and the proofs of what they assume
    of these.  Both are empty for a rank on one line without guards.
    """
    ranks = own.get("rank")
    if [guards for guards, _ in ranks] == [[]]:
        return "", ""
    each = "".join(f" (of_v {c}%nat)" for c in components(own))
    return each, "".join(f" of_here_{k}" for k in range(1, len(ranks) + 1))


def _bounded(f: Frame, own: checker.Statement) -> dict[str, str]:
    """The proof that numbers which are at least the rank are not negative."""
    numbers, heres = _arguments(own)
    least = [f"of_least_{c}" for c in components(own)]
    shown = [f"(Rge_le _ _ {one})" for one in least]
    if not numbers:
        above = [f"of_above_{c}" for c in components(own)]
        shown = [f"(Rle_trans _ _ _ {one} {up})" for one, up in zip(shown, above)]
    here = _here(f, own)
    here += f.fill(
        f"\n  ${{open}}pose proof (${{P}}_bounded$a $s{numbers} of_dom of_there{heres})"
        f" as {conjunctive(least)}.",
        own,
    )
    if not numbers:
        here += f"\n  destruct of_here_1 as {conjunctive(above)}."
    return {
        "here": here,
        "each_component": nested("of_c", len(least)),
        "components": "|".join(f"exact {one}" for one in shown),
    }


def _falls(f: Frame, own: checker.Statement) -> str:
    """The proof that a component falls, and that none before it grows."""
    numbers, heres = _arguments(own)
    ranks, given, cases = own.get("rank"), f"of_dom of_there of_out{heres} of_g of_next", []
    patterns = []
    for c in components(own):
        lines, before = [], []
        for k, (guard, _) in enumerate(ranks, 1):
            names = [f"of_low_{k}_{b}" for b in range(c + 1)]
            exact = [f"exact {name}" for name in names]
            if not numbers:  # less than a term, and so than the number that is at least this term
                exact = [
                    f"exact (Rle_trans _ _ _ {name} {_above(b, len(components(own)), b == c)})"
                    for b, name in enumerate(names)
                ]
            smaller = "|".join([*exact[:-1], "exfalso; lia"])
            line = f"split; [intros {nested('of_b', c)} of_lower; [{smaller}]|{exact[-1]}]"
            if guard:
                before.append(f"of_low_{k}")
                alternatives = f"[of_no|{conjunctive(names)}]"
                line = f"destruct of_low_{k} as {alternatives}; [destruct (of_no of_guard)|{line}]"
            else:
                before += names
            lines.append(line)
        each = "|".join(lines)
        cases.append(
            f"exists {c}%nat; split; [lia|]; intros {nested('of_i', len(ranks))} of_less of_guard;"
            f" [{each}|exfalso; lia]"
        )
        patterns.append(conjunctive(before))
    case = f"pose proof {{}} as {disjunctive(patterns)}; [{'|'.join(cases)}]"
    pieces = f.by_pieces(own, "falls", given, point=f"$s{numbers}", case=case)
    return f"{_here(f, own)}\n  {pieces}"


def _above(component: int, count: int, is_last: bool) -> str:
    """A proof that a component of the first line is at most its number of_v; if `is_last`, that the
    same holds of both less 1.
    """
    proof = "of_here_1"
    for _ in range(component):
        proof = f"(proj2 {proof})"
    proof = proof if component == count - 1 else f"(proj1 {proof})"
    return f"(Rplus_le_compat_r _ _ _ {proof})" if is_last else proof


def _by_lines(f: Frame, own: checker.Statement) -> dict[str, str]:
    """For a rank of one component: proofs that the number of a step is at least each of its terms,
    from that of the rank.
    """
    early, lates = [], []
    for k, (guard, _) in enumerate(own.get("rank"), 1):
        late = f"(of_late_{k} of_guard)" if guard else f"of_late_{k}"
        early.append(
            f"pose proof {late} as of_early;"
            f" change (Descent.rank_{k}_1$a $start <= INR of_n - INR {f.extra_steps(own)});"
            " clear - of_early; lra"
        )
        top = f"(Rplus_le_compat_r _ _ _ (of_top {k - 1}%nat ltac:(lia)))"
        intro = "intros _. " if guard else ""
        lates.append(f"{{ {intro}exact (Rle_trans _ _ _ {top} of_late). }}")
    return {
        "each_line": nested("of_i", len(early)),
        "early": f.fill("|".join(early), own),
        "each_late": "\n  ".join(lates),
    }


def _in_a_stage(count: int) -> str:
    """Tactics that give the number of the stage which a state is in."""
    cases = "|".join(f"exists {k}%nat; exact of_in" for k in range(count))
    return (
        f"destruct of_in as {disjunctive(['of_in'] * count)}; [{cases}]."
        if count > 1
        else f"{cases}."
    )
