"""The theorem of Coq that every orbit of a map comes to that of one of several points, by a map
that makes several of its steps at once; by Returns.v.
"""

from __future__ import annotations

from collections.abc import Iterator

from juggleproof.certificates import checker
from juggleproof.coq_orbits.frame import (
    Frame,
    equal_states,
    nested,
    opened,
    theorem_name,
)
from juggleproof.coq_orbits.readings import reading_name
from juggleproof.coq_orbits.settles import end_module, word_of_coq, words_of_ends
from juggleproof.coq_orbits.terms import coq_term
from juggleproof.coq_store.branch import Known
from juggleproof.coq_store.text import conjoined, conjunctive, disjunctive

# The other map, with its points, is in the module Inner. `$word` is the word of its piece `$k`,
# `$shown` that the pieces of the word apply, `$equal` that the last image is that of the piece.
GOES_ALONG = """\
Lemma of_goes_along_$k : ${all}Inner.Descent.domain$a -> forall of_s, Map.space$a of_s ->
  Inner.Map.guard_$k$a of_s ->
  Returns.leads (Returning.guards$a) (Returning.images$a) (Returning.words $k) of_s /\\
  Inner.Map.f$a of_s = Returns.run (Returning.images$a) (Returning.words $k) of_s.
Proof.
  intros$a of_dom of_s of_there of_here.
  assert (of_inner : Inner.Map.domain$a) by exact (${descent}_inside$a of_dom).
  rewrite (Inner.of_map_is_$k$a of_s of_inner of_there of_here).
  ${open}pose proof (${P}_word_$k$a $s of_dom of_there of_here) as $each.
  split; [exact $shown|exact $equal].
Qed.
"""

# `$coordinates` shows for each coordinate of the image that it is continuous.
CONTINUOUS = """\
Lemma of_continuous_$k : ${all}Map.domain$a -> forall of_s, Map.space$a of_s ->
  Map.guard_$k$a of_s -> Returns.continuous States.coordinate (Map.image_$k$a) of_s.
Proof.
  intros$a of_map of_s of_there of_here. ${open}
  cbv beta iota zeta delta [Map.domain] in of_map. cbv beta iota zeta delta [Map.space] in of_there.
  cbv beta iota zeta delta [Map.guard_$k] in of_here.
  apply (Returns.by_coordinates States.coordinate ($axes)%list);
    [intros []; repeat (first [left; reflexivity|right])|intros []; [$coordinates]].
Qed.
"""

COORDINATE = """\
apply (Returns.tends_same States.coordinate (fun of_t => $lets$term));
    [intro of_t; ${open_t}reflexivity|cbv beta zeta; Returns.all_tend
      ltac:(cbv beta iota delta [States.coordinate]; decompose [and] of_map;
        decompose [and] of_there; decompose [and] of_here; Returns.apart_from_0)]"""

PIECES = """\
Lemma of_piece_applies : ${all}Map.domain$a -> forall of_k of_s, Map.space$a of_s ->
  Returning.guards$a of_k of_s -> Map.f$a of_s = Returning.images$a of_k of_s.
Proof.
  intros$a of_map of_k of_s of_there of_here. destruct of_k as $numbers;
    [destruct of_here|$applies|destruct of_here].
Qed.

Lemma of_continuous : ${all}Map.domain$a -> forall of_k of_s, Map.space$a of_s ->
  Returning.guards$a of_k of_s ->
  Returns.continuous States.coordinate (Returning.images$a of_k) of_s.
Proof.
  intros$a of_map of_k of_s of_there of_here. destruct of_k as $numbers;
    [destruct of_here|$continuous|destruct of_here].
Qed.

Lemma of_some_piece : ${all}Inner.Descent.domain$a -> forall of_s, Map.space$a of_s ->
  exists of_k, In of_k Returning.letters /\\ Returning.pieces$a of_k of_s.
Proof.
  intros$a of_dom of_s of_there.
  assert (of_inner : Inner.Map.domain$a) by exact (${descent}_inside$a of_dom).
  destruct (Inner.of_map_moves$a of_s of_inner of_there) as $one_piece; [$some].
Qed.

Lemma of_has_steps : forall of_k, In of_k Returning.letters -> Returning.words of_k <> nil.
Proof. intros of_k of_in. destruct of_in as $letter; discriminate. Qed.

Lemma of_goes_along : ${all}Inner.Descent.domain$a -> forall of_k of_s,
  In of_k Returning.letters -> Map.space$a of_s -> Returning.pieces$a of_k of_s ->
  Returns.leads (Returning.guards$a) (Returning.images$a) (Returning.words of_k) of_s /\\
  Inner.Map.f$a of_s = Returns.run (Returning.images$a) (Returning.words of_k) of_s.
Proof.
  intros$a of_dom of_k of_s of_in of_there of_here. destruct of_in as $letter; [$goes].
Qed.
"""

# `$at` is the contraction of an end, and `$piece` the number of the piece that its set lies in.
END = """\
Lemma of_orbit_$k : ${all}Inner.Descent.domain$a ->
  $says /\\
  forall of_s, Map.space$a of_s -> Rules.converges (Inner.Map.f$a) States.coordinate
    (fun of_j => States.coordinate of_j ($at.point$a)) of_s ->
  Returns.joins States.coordinate (Map.f$a) ($at.point$a) of_s.
Proof.
  intros$a of_dom.
  assert (of_map : Map.domain$a) by exact (${P}_inside$a of_dom).
  assert (of_inner : Inner.Map.domain$a) by exact (${descent}_inside$a of_dom).
  assert (of_near : $at.domain$a) by exact (${settling}_inside_$k$a of_dom).
  destruct ($within.$contracts$a of_near) as (of_point & of_fixed & of_stays & _).
  destruct ($within.of_constants$a of_near) as (_ & _ & of_radius & _ & of_low & of_high
    & of_positive & of_between).
  apply and_assoc. apply (Returns.an_end States.coordinate (Map.f$a) (Map.space$a)
    (Returning.guards$a) (Returning.images$a) (fun of_s => of_map_keeps$a of_s of_map)
    (of_piece_applies$a of_map) (of_continuous$a of_map) (Inner.Map.f$a) (Returning.pieces$a)
    Returning.letters Returning.words (of_some_piece$a of_dom) of_has_steps
    (of_goes_along$a of_dom) ($at.point$a) ($at.set$a) $piece).
  { repeat (first [left; reflexivity|right]). }
  { intros of_s [of_there _]. exact of_there. }
  { exact ($within.of_set_kept$a of_near). }
  { intros of_s [of_there of_on]. ${open}
    exact (${P}_piece_$k$a $s of_near of_there of_dom of_on). }
  { exact of_point. }
  { exact of_fixed. }
  { exists ($at.radius$a * of_low). split; [exact (Rmult_lt_0_compat _ _ of_radius of_positive)|].
    intros of_s of_there of_close. apply ($within.of_surrounded$a of_near); [exact of_there|].
    intro of_j. apply Rle_trans with ($at.radius$a * of_low); [apply Rlt_le, of_close|].
    apply Rmult_le_compat_l; [lra|exact (proj1 (of_between of_j))]. }
  { exact of_stays. }
Qed.
"""

RETURNS = """\
(* Each point is back, its orbit is stable, and every orbit comes to one of these. *)
Theorem $theorem : ${all}Inner.Descent.domain$a ->
  ($ends) /\\
  forall of_s, Map.space$a of_s -> exists of_e, In of_e (Inner.Settling.points$a) /\\
  Returns.joins States.coordinate (Map.f$a) of_e of_s.
Proof.
  intros$a of_dom. split; [exact $all_ends|]. intros of_s of_there.
  destruct (proj2 (Inner.$settles$a of_dom) of_s of_there) as (of_e & of_in & of_tends).
  exists of_e. split; [exact of_in|]. destruct of_in as $which;
    [$comes].
Qed.
"""


def returning_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The pieces of both maps by their numbers, and the words."""
    other = _other(f, own)
    words = own.get("word")

    def numbered(name: str, kind: str, cases: list[str], none: str) -> str:
        rows = "".join(f"{k}%nat => {one} | " for k, one in enumerate(cases, 1))
        bound = f.bound if name != "words" else ""
        head = f"Definition {name}{bound} (of_k : nat) : {kind} :=\n"
        return f.fill(f"{head}  match of_k with {rows}_ => {none} end.", own)

    yield "Module Returning.\nImport States."
    prop, none = "State -> Prop", "fun _ => False"
    yield numbered("guards", prop, [f"Map.guard_{k}$a" for k in f.pieces], none)
    images = [f"Map.image_{k}$a" for k in f.pieces]
    yield numbered("images", "State -> State", images, "fun of_s => of_s")
    yield numbered("pieces", prop, [f"Inner.Map.guard_{k}$a" for k in other.pieces], none)
    yield numbered("words", "list nat", [word_of_coq(word) for word in words], "nil")
    yield f"Definition letters : list nat := {word_of_coq(other.pieces)}."
    yield "End Returning."


def _other(f: Frame, own: checker.Statement) -> Frame:
    """The frame of the map that makes several steps at once."""
    settling = f.known[own.get("settling")[0]]
    descent = f.known[settling.get("descent")[0]]
    return Frame(f.known[descent.get("map")[0]], f.known, "map")


def returning_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The orbit of each point is periodic and stable, and every orbit comes to one of these."""
    other, settling = _other(f, own), f.known[own.get("settling")[0]]
    words, contractions = own.get("word"), settling.get("contraction")
    descent = f"Inner.{reading_name(settling.get('descent')[0])}"
    shown = _lines_shown(own, f.known)
    equal = [f"of_{axis}" for axis in range(len(f.axes))]
    for k in other.pieces:
        lines = [f.fill(f"({one}$a $s of_dom of_there of_here)", own) for one in shown[k - 1]]
        yield f.fill(
            GOES_ALONG,
            own,
            k=k,
            descent=descent,
            each=conjunctive(equal),
            shown=conjoined([*lines, "I"]),
            equal=equal_states([f"(eq_sym {one})" for one in equal]),
        )
    yield from (_continuous(f, own, k) for k in f.pieces)
    letter = "split; [repeat (first [left; reflexivity|right])|exact of_g]"
    here, numbers = "$a of_map of_s of_there of_here", range(1, len(contractions) + 1)
    yield f.fill(
        PIECES,
        own,
        descent=descent,
        numbers=nested("of_k", len(f.pieces) + 1),
        applies=f.fill(
            "|".join(f"exact (of_map_is_{k}$a of_s of_map of_there of_here)" for k in f.pieces), own
        ),
        continuous=f.fill("|".join(f"exact (of_continuous_{k}{here})" for k in f.pieces), own),
        one_piece=other.one_piece(),
        some="|".join(f"exists {k}%nat; {letter}" for k in other.pieces),
        letter=disjunctive(["<-"] * len(other.pieces) + ["[]"]),
        goes=f.fill(
            "|".join(
                f"exact (of_goes_along_{k}$a of_dom of_s of_there of_here)" for k in other.pieces
            ),
            own,
        ),
    )
    says = []
    for k, (name, word) in enumerate(zip(contractions, words_of_ends(settling)), 1):
        within = f"Inner.{end_module(settling, name)}"
        at, piece = f"{within}.Contraction", word[0]
        says.append(_says(f, own, at, len(words[piece - 1])))
        yield f.fill(
            END,
            own,
            k=k,
            says=says[-1],
            at=at,
            within=within,
            piece=f"{piece}%nat",
            contracts=theorem_name(name),
            descent=descent,
            settling=f"Inner.{reading_name(settling.name)}",
        )
    yield f.fill(
        RETURNS,
        own,
        ends=" /\\\n  ".join(says),
        all_ends=conjoined([f.fill(f"(proj1 (of_orbit_{k}$a of_dom))", own) for k in numbers]),
        settles=theorem_name(settling.name),
        which=disjunctive(["<-"] * len(contractions) + ["[]"]),
        comes=f.fill(
            "|".join(
                f"exact (proj2 (of_orbit_{k}$a of_dom) of_s of_there of_tends)" for k in numbers
            ),
            own,
        ),
    )


def _says(f: Frame, own: checker.Statement, at: str, steps: int) -> str:
    """The text that the orbit of a point is periodic and stable."""
    return f.fill(
        f"(Rules.iterate (Map.f$a) {steps} ({at}.point$a) = {at}.point$a /\\\n"
        f"  Returns.orbit_stable States.coordinate (Map.f$a) (Map.space$a) ({at}.point$a))",
        own,
    )


def _continuous(f: Frame, own: checker.Statement, k: int) -> str:
    """The image of a piece is continuous where its guard holds."""
    whole = f.known[own.get("map")[0]]
    _, images = whole.get("piece")[k - 1]
    state = "".join(
        f"let {name} := States.coordinate {axis} of_t in " for name, axis in zip(f.state, f.axes)
    )
    coordinates = [
        f.fill(
            COORDINATE,
            own,
            lets=state + f.lets(whole, [image]),
            term=coq_term(image),
            open_t=opened("of_t", [f"of_{n}" for n in range(len(f.axes))]).replace(". ", "; "),
        )
        for image in images
    ]
    axes = " :: ".join([*f.axes, "nil"])
    return f.fill(CONTINUOUS, own, k=k, axes=axes, coordinates="|".join(coordinates))


def _lines_shown(own: checker.Statement, known: Known) -> list[list[str]]:
    """For each word, the lemmas that its pieces apply, from the lines `have` in its premise; the
    same lines in two premises have one lemma.
    """
    names: dict[tuple[str, ...], str] = {}
    found = []
    for name, premise in checker.premises_of(own, known).items():
        lines = premise.text().splitlines()[1:]
        shown = [
            names.setdefault((*lines[: n + 1],), reading_name(f"{premise.name}.line-{n}"))
            for n, line in enumerate(lines)
            if line.startswith("have ")
        ]
        if name.startswith("word-"):
            found.append(shown)
    return found
