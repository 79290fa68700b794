"""The theorem of Coq that every orbit of a map tends to one of several points, by Attractors.v."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from juggleproof.certificates import checker
from juggleproof.coq_orbits.frame import Frame, theorem_name
from juggleproof.coq_orbits.readings import reading_name
from juggleproof.coq_store.text import conjoined, conjunctive, disjunctive

# Every sequence of `$letters` holds one of the words `$words`, unless it repeats one of `$repeated`
# at last; `$places` shows this. `$known` are the facts on a state along a word, in the order of the
# premises.
FOLLOWED = """\
Lemma $lemma : ${all}Descent.domain$a -> forall of_s,
  Settling.follows$a $word of_s -> $shown.
Proof.
  intros$a of_dom of_s of_along. destruct of_along as $along.
  assert (of_map : Map.domain$a) by exact (${descent}_inside$a of_dom).
  $steps
  $then_
Qed.
"""

SETTLES = """\
Definition of_places : list Attractors.Place := $places.

Lemma of_words : Attractors.every_way_ends $words $repeated $letters of_places = true.
Proof. vm_compute. reflexivity. Qed.

(* Each of the points is stable, and every orbit tends to one of them. *)
Theorem $theorem : ${all}Descent.domain$a ->
  ($stable) /\\
  forall of_s, Map.space$a of_s -> exists of_e, In of_e (Settling.points$a) /\\
  Rules.converges (Map.f$a) States.coordinate (fun of_j => States.coordinate of_j of_e) of_s.
Proof.
  intros$a of_dom.
  assert (of_map : Map.domain$a) by exact (${descent}_inside$a of_dom).
  $near
  split; [exact $stables|]. intros of_s of_there.
  destruct (Attractors.settles (End := Settling.End) (Map.f$a) States.coordinate
    (Map.space$a) (Descent.stage_$last$a) (Settling.guards$a)
    $letters (fun of_t => of_map_keeps$a of_t of_map)
    (of_stage_$last$a of_dom)) with (s := of_s)
    (never := $never) (repeated := $repeated) (ends := Settling.ends$a)
    (word := fun of_e : Settling.End => fst of_e) (rank := Settling.rank$a)
    (places := of_places)
    (on := fun of_e : Settling.End => snd (snd of_e))
    (point := fun (of_e : Settling.End) of_j => States.coordinate of_j (fst (snd of_e)))
    as (of_e & of_in & of_tends).
  { intros of_t of_here. destruct (of_map_moves$a of_t of_map of_here) as $one_piece; [$pieces]. }
  { exact of_words. }
  { intros of_u of_in of_t of_along. destruct of_in as $never_in$no_word. }
  { intros of_i of_less of_t of_along. $falls }
  { intros of_e of_in of_t of_along. destruct of_in as $end_in; [$ends]. }
  { exact (of_last_stage_reached$a of_dom). }
  { intros of_e of_in of_t _ of_on. destruct of_in as $end_in; [$tends]. }
  { exact of_there. }
  exists (fst (snd of_e)). split; [|exact of_tends].
  exact (in_map (fun of_e : Settling.End => fst (snd of_e)) _ _ of_in).
Qed.
"""


def end_module(own: checker.Statement, name: str) -> str:
    """The module with the point of a contraction that the statement names."""
    return f"End_{own.get('contraction').index(name) + 1}"


def words_of_ends(own: checker.Statement) -> list[list[int]]:
    """The word of each contraction that the statement names, after those with a rank."""
    words: list[list[int]] = own.get("word")
    return words[len(own.get("rank")) :]


def word_of_coq(pieces: Sequence[int]) -> str:
    """A list of numbers."""
    return f"({''.join(f'{k} :: ' for k in pieces)}nil)%nat"


def words_of_coq(words: Sequence[Sequence[int]]) -> str:
    """A list of words."""
    return f"({_listed([word_of_coq(word) for word in words])}%list : list (list nat))"


def _listed(parts: Sequence[str]) -> str:
    return f"({''.join(f'{part} :: ' for part in parts)}nil)"


def _last(f: Frame, own: checker.Statement) -> int:
    return len(f.known[own.get("descent")[0]].get("stage"))


def settling_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The pieces by their numbers, what follows a word, and the ends: a word, a point and a set."""
    ends = [
        f"({word_of_coq(word)}, ({at}.point$a, {at}.set$a))"
        for word, at in zip(words_of_ends(own), _ends(own))
    ]
    ranks = [term for _, (term,) in own.get("rank")]
    which = "".join(f"{k}%nat => rank_{k + 1}$a | " for k in range(len(ranks)))
    cases = "".join(f"{k}%nat => Map.guard_{k}$a | " for k in f.pieces)
    yield "Module Settling.\nImport States."
    yield "Definition End : Type := list nat * (State * (State -> Prop))."
    rows = [
        f"Definition guards{f.bound} (of_k : nat) : State -> Prop :=",
        f"  match of_k with {cases}_ => fun _ => False end.",
        f"Definition follows{f.bound} : list nat -> State -> Prop :=",
        "  Attractors.follows (Map.f$a) (Map.space$a)",
        f"    (Descent.stage_{_last(f, own)}$a) (guards$a).",
        f"Definition ends{f.bound} : list End :=",
        f"  {_listed(ends)}%list.",
        f"Definition points{f.bound} : list State :=",
        "  map (fun of_e : End => fst (snd of_e)) (ends$a).",
    ]
    yield f.fill("\n".join(rows), own)
    for k, term in enumerate(ranks, 1):
        yield f.define(own, f"rank_{k}", "R", term)
    rows = [
        f"Definition rank{f.bound} (of_i : nat) : State -> R :=",
        f"  match of_i with {which}_ => fun _ => 0 end.",
    ]
    yield f.fill("\n".join(rows), own)
    yield "End Settling."


def _ends(own: checker.Statement) -> list[str]:
    return [f"{end_module(own, name)}.Contraction" for name in own.get("contraction")]


def settling_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Each point is stable, and every orbit tends to one of them."""
    never, words = own.get("never"), words_of_ends(own)
    repeated = own.get("word")[: len(own.get("rank"))]
    numbers = range(1, len(words) + 1)
    for k, word in enumerate(never, 1):
        then = f"${{open}}exact (R1_neq_R0 (eq_sym ({_premise(f, own, f'never_{k}', word)})))."
        yield _followed(f, own, f"of_never_{k}", word, "False", then)
    for k, word in enumerate(repeated, 1):
        then = f"${{open}}destruct ({_premise(f, own, f'falls_{k}', word)}) as [of_high of_low]."
        then = f"{then}\n  split; [exact (Rge_le _ _ of_high)|exact of_low]."
        rank, last = f"Settling.rank$a {k - 1}%nat", f"(Rules.iterate (Map.f$a) {len(word)} of_s)"
        shown = f"0 <= {rank} of_s /\\ {rank} {last} <= {rank} of_s - 1"
        yield _followed(f, own, f"of_fall_{k}", word, shown, then, to_the_last=True)
    for k, (word, at) in enumerate(zip(words, _ends(own)), 1):
        then = f"${{open}}exact ({_premise(f, own, f'ends_{k}', word)})."
        then = f"split; [exact of_there_0|].\n  {then}"
        yield _followed(f, own, f"of_end_{k}", word, f"{at}.set$a of_s", then)
    near = [
        f"assert (of_near_{k} : {at}.domain$a) by exact (${{P}}_inside_{k}$a of_dom)."
        for k, at in zip(numbers, _ends(own))
    ]
    concluded = [
        f"({end_module(own, name)}.{theorem_name(name)}$a of_near_{k})"
        for k, name in zip(numbers, own.get("contraction"))
    ]
    impossible = [f"exact (of_never_{k}$a of_dom of_t of_along)" for k in range(1, len(never) + 1)]
    which = [
        f"destruct of_i as [|of_i]; [exact (of_fall_{k}$a of_dom of_t of_along)|].\n    "
        for k in range(1, len(repeated) + 1)
    ]
    letter = "split; [repeat (first [left; reflexivity|right])|exact of_g]"
    yield f.fill(
        SETTLES,
        own,
        words=words_of_coq([*never, *words]),
        never=words_of_coq(never),
        repeated=words_of_coq(repeated),
        letters=word_of_coq(f.pieces),
        places=_listed([*places([*never, *words], repeated, len(f.pieces))]) + "%list",
        falls=f.fill("".join(which), own) + "cbn in of_less. lia.",
        stable=f.fill(
            " /\\\n  ".join(
                f"States.stable (Map.space$a) (Map.f$a) ({at}.point$a)" for at in _ends(own)
            ),
            own,
        ),
        stables=conjoined([f"(proj1 (proj2 (proj2 {one})))" for one in concluded]).replace(
            "$a", f.words["a"]
        ),
        near=f.fill("\n  ".join(near), own),
        descent=reading_name(own.get("descent")[0]),
        last=_last(f, own),
        one_piece=f.one_piece(),
        pieces="|".join(f"exists {k}%nat; {letter}" for k in f.pieces),
        never_in=disjunctive(["<-"] * len(never) + ["[]"]),
        no_word=f.fill(f"; [{'|'.join(impossible)}]" * bool(never), own),
        end_in=disjunctive(["<-"] * len(words) + ["[]"]),
        ends=f.fill("|".join(f"exact (of_end_{k}$a of_dom of_t of_along)" for k in numbers), own),
        tends=f.fill(
            "|".join(
                f"exact (proj1 (proj2 (proj2 (proj2 {one}))) of_t of_on)" for one in concluded
            ),
            own,
        ),
    )


def places(
    words: Sequence[Sequence[int]], repeated: Sequence[Sequence[int]], letters: int
) -> Iterator[str]:
    """For each end of what is read that is kept (`checker.ways_on`): its height, a number that is
    greater than that of the ends to which it leads, or equal round a circle; and on a circle, which
    of the repeated words it is, and how many of its letters are read.
    """
    ways, height = checker.ways_on(words, letters, checker.Work()), 0
    while ways:
        ways = {e: {k: to for k, to in way.items() if to in ways} for e, way in ways.items()}
        found = {end: (0, 0) for end, way in ways.items() if not way}
        if not found:
            circle = checker.closed_circle(ways)
            once = [k for end in circle for k in ways[end]]
            turns = [once[n:] + once[:n] for n in range(len(once))]
            which, word = next((i, [*one]) for i, one in enumerate(repeated) if [*one] in turns)
            for count, end in enumerate(circle):
                found[end] = which, (count - turns.index(word)) % len(once)
        for end, (which, along) in sorted(found.items()):
            yield f"Attractors.place {word_of_coq(end)} {height}%nat {which}%nat {along}%nat"
        ways = {end: way for end, way in ways.items() if end not in found}
        height += 1


def _premise(f: Frame, own: checker.Statement, name: str, word: Sequence[int]) -> str:
    """A premise for a state that follows a word."""
    known = [f"of_there_{n} of_in_{n} of_g_{n}" for n in range(len(word))]
    return f"${{P}}_{name}$a $s of_dom {' '.join(known)}"


def _followed(
    f: Frame,
    own: checker.Statement,
    lemma: str,
    word: Sequence[int],
    shown: str,
    then: str,
    to_the_last: bool = False,
) -> str:
    """The lemma for a state that follows a word: the states on the way are the images, and so is
    the state after the word if `to_the_last`.
    """
    state, steps, rewrites = "of_s", list[str](), list[str]()
    for n, piece in enumerate(word[:-1]):
        rewrites.append(f"of_step_{n}")
        known = ", ".join(f"of_{one}_{n + 1}" for one in ("there", "in", "g"))
        applied = f"of_map_is_{piece}$a {state} of_map of_there_{n} of_g_{n}"
        steps.append(f"pose proof ({applied}) as of_step_{n}.")
        steps.append(f"rewrite {', '.join(rewrites)} in {known}.")
        state = f"(Map.image_{piece}$a {state})"
    if to_the_last:
        n, piece = len(word) - 1, word[-1]
        applied = f"of_map_is_{piece}$a {state} of_map of_there_{n} of_g_{n}"
        steps.append(f"pose proof ({applied}) as of_step_{n}.")
        steps.append(f"cbn [Rules.iterate]. rewrite {', '.join([*rewrites, f'of_step_{n}'])}.")
    names = [f"of_{one}_{n}" for n in range(len(word)) for one in ("there", "in", "g")]
    return f.fill(
        FOLLOWED,
        own,
        lemma=lemma,
        word=word_of_coq(word),
        shown=f.fill(shown, own),
        along=conjunctive([*names, "_"]),
        descent=reading_name(own.get("descent")[0]),
        steps=f.fill("\n  ".join(steps), own),
        then_=f.fill(then, own),
    )
