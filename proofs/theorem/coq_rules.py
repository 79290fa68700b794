"""A theorem on the orbits of a map, certified by rules of the checker, as one file of Coq: the map,
the premises proved by their certificates, and the theorem by Rules.v.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.certificates.coq import PRELUDE, NotWritten, lemmas
from juggleproof.certificates.coq.branch import Known
from juggleproof.certificates.coq.text import conjoined, conjunctive, coq_name, disjunctive
from juggleproof.certificates.language import lemmas_of, rests_on
from juggleproof.certificates.nodes import Certificate
from juggleproof.proofs.theorem.coq_readings import reading_name, readings
from juggleproof.proofs.theorem.coq_terms import coq_formula, coq_term, names_in, term_of

COQ = Path(__file__).resolve().parents[1] / "coq"
HEADER = """\
(* $name: $says, for coqc alone.

   The modules Map, Descent, Contraction, Escape define the map and what its rules name; the last
   theorem is about them. Each premise is a lemma that its certificate proves, first of polynomials,
   then in the words of the rule. *)

"""


def theory() -> str:
    """What every file begins with: the lemmas of certificates, and the rules for any map."""
    rules, readings_ = ((COQ / name).read_text() for name in ("Rules.v", "Readings.v"))
    return "\n".join(
        [
            "From Coq Require Import Reals ZArith Lra Lia List.",
            _without_imports(PRELUDE),
            _without_imports(readings_),
            "Module Rules.",
            _without_imports(rules),
            "End Rules.\n",
        ]
    )


def _without_imports(text: str) -> str:
    return re.sub(r"^From Coq Require Import .*\n", "", text, flags=re.MULTILINE)


def theorem(name: str, statements: Known, certificates: Mapping[str, Certificate]) -> str:
    """The file of the theorem that a stored statement is; certificates: of it, of all that it
    rests on, and of the lemmas that these use.

    Raises NotWritten for a rule, or a part of a certificate, that is not written for Coq.
    """
    chain = _chain(name, statements)
    for one in chain:
        if statements[one].kind not in RULES:
            raise NotWritten(f"{one} is of a rule that is not written for Coq; claim it by another")
    frame = Frame(statements[chain[0]], statements)
    rows = [theory()]
    used = _uses(chain, certificates)
    for one, statement in statements.items():
        if one in used:
            rows.append(lemmas(statement, certificates[one], statements))
    for one in chain:
        statement = statements[one]
        definitions, proofs = RULES[statement.kind]
        rows += [
            f"(* {'-' * 70} {one} *)\n",
            *definitions(frame, statement),
            readings(statement, certificates[one], statements),
            *proofs(frame, statement),
        ]
    return "\n".join([*rows, f"Print Assumptions {theorem_name(name)}.", ""])


NO_THEOREM = ("universal", "sharp", "iterates", "map", "escapes")


def theorems_in(statements: Known) -> list[str]:
    """The theorems on the orbits of a map on which no other statement rests."""
    inner = {name for one in statements.values() for name in rests_on(one)}
    return [
        name for name, one in statements.items() if one.kind not in NO_THEOREM and name not in inner
    ]


def _uses(names: Sequence[str], certificates: Mapping[str, Certificate]) -> set[str]:
    """The lemmas that certificates use, and those that these use."""
    found: set[str] = set()
    todo = [*names]
    while todo:
        more = lemmas_of(certificates[todo.pop()]) - found
        found |= more
        todo += more
    return found


def theorem_name(name: str) -> str:
    """The name of the theorem that a statement is."""
    return "theorem_" + re.sub(r"\W", "_", name)


def _chain(name: str, statements: Known) -> list[str]:
    """The map rules that a statement rests on, the map first, and itself."""
    chain: list[str] = []
    for one in rests_on(statements[name]):
        chain += [each for each in _chain(one, statements) if each not in chain]
    return [*chain, name]


class Frame:
    """The words in which a file speaks of its map: parameters and state, bound and applied."""

    def __init__(self, own: checker.Statement, known: Known) -> None:
        self.known = known
        (parameters,), (state,) = own.get("over"), own.get("state")
        self.parameters = [*map(coq_name, parameters)]
        self.state = [*map(coq_name, state)]
        self.count = len(own.get("piece"))
        self.args = "".join(f" {name}" for name in self.parameters)
        self.bound = f" ({' '.join(self.parameters)} : R)" if parameters else ""
        self.forall = f"forall {' '.join(self.parameters)} : R, " if parameters else ""
        single = len(state) == 1
        self.pattern = (
            f"({self.state[0]} : State)" if single else f"'({self.tuple(self.state)} : State)"
        )
        self.point = "of_s" if single else " ".join(self.state)
        self.axes = [f"Map.axis_{name}" for name in state]
        self.open = _opened("of_s", self.state)

    def tuple(self, terms: Sequence[str]) -> str:
        """A state with these coordinates."""
        return terms[0] if len(terms) == 1 else f"({', '.join(terms)})"

    def at(self, name: str, *more: str) -> str:
        """A definition applied to the parameters."""
        return " ".join([f"{name}{self.args}", *more])

    def premise(
        self, statement: checker.Statement, name: str, *hypotheses: str, at: str = ""
    ) -> str:
        """A premise applied to the parameters, to what else is bound, and to what it assumes."""
        lemma = reading_name(f"{statement.name}.{name}")
        return f"({' '.join([lemma + self.args, *filter(None, [at]), *hypotheses])})"

    def defined(
        self,
        statement: checker.Statement,
        name: str,
        returns: str,
        *texts: str,
        of_state: bool = True,
    ) -> str:
        """A definition over the parameters, and of a state, by texts of a statement; of several
        texts it is the state that they are the coordinates of.
        """
        state = f" {self.pattern}" if of_state else ""
        lets = "".join(f"let {own} := {value} in " for own, value in _roots(statement, texts))
        write = coq_formula if returns == "Prop" else coq_term
        body = self.tuple([write(text) for text in texts])
        return f"Definition {name}{self.bound}{state} : {returns} :=\n  {lets}{body}."

    def by_pieces(self, goals: Sequence[str], has_next: bool) -> list[str]:
        """Tactics for the image of a state, by pieces; of_g: the guard holds."""
        place = " in of_next |- *" if has_next else ""
        pattern = disjunctive(["[of_g of_same]"] * self.count)
        opened = self.open.replace(". ", "; ")
        cases = "|".join(f"exact {goal}" for goal in goals)
        return [
            f"destruct ({self.at('of_map_moves', 'of_s', 'of_map', 'of_there')}) as {pattern};",
            f"  rewrite of_same{place}; clear of_same; {opened}[{cases}].",
        ]


def _roots(statement: checker.Statement, texts: Sequence[str]) -> list[tuple[str, str]]:
    """The roots that texts name, in order, as Coq terms."""
    used = set().union(*map(names_in, texts))
    rows: list[tuple[str, str]] = []
    for name, (under,) in reversed(statement.get("root")):
        if name in used:
            used |= {node.id for node in ast.walk(under) if isinstance(node, ast.Name)}
            rows.insert(0, (coq_name(name), f"sqrt ({term_of(under, 0)})"))
    return rows


def _lemma(name: str, text: str, rows: Sequence[str], word: str = "Lemma") -> str:
    return "\n".join(
        [f"{word} {name} :", f"  {text}.", "Proof.", *(f"  {row}" for row in rows), "Qed."]
    )


# -------------------------------------------------------------------------------------------------
# A map: each state of the space has one piece, whose image is in the space.


def map_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    axes = [axis.removeprefix("Map.") for axis in f.axes]
    cases = " | ".join(f"{axis} => {name}" for axis, name in zip(axes, f.state))
    (domain,), (space,) = own.rows("domain"), own.get("space")
    yield "Module Map."
    yield f"Definition State : Type := {' * '.join(['R'] * len(f.state))}."
    yield f"Inductive axis : Set := {' | '.join(axes)}."
    yield f"Definition coordinate (of_j : axis) {f.pattern} : R :=\n  match of_j with {cases} end."
    yield STABLE
    yield f.defined(own, "domain", "Prop", domain, of_state=False)
    yield f.defined(own, "space", "Prop", space)
    steps = ""
    for k, ((guard,), images) in enumerate(own.get("piece"), 1):
        yield f.defined(own, f"guard_{k}", "Prop", guard)
        yield f.defined(own, f"image_{k}", "State", *images)
        holds = f.at(f"guard_{k}", "of_s")
        yield f"Lemma decided_{k}{f.bound} (of_s : State) : {{{holds}}} + {{~ {holds}}}."
        yield f"Proof. {f.open}cbv beta iota zeta delta [guard_{k}]. decidable. Qed."
        steps += f"if {f.at(f'decided_{k}', 'of_s')} then {f.at(f'image_{k}', 'of_s')}\n  else "
    yield f"Definition f{f.bound} (of_s : State) : State :=\n  {steps}of_s."
    yield "End Map."


STABLE = """\
Definition stable (space : State -> Prop) (f : State -> State) (e : State) : Prop :=
  forall epsilon, 0 < epsilon -> exists delta, 0 < delta /\\
  forall s, space s -> (forall j, Rabs (coordinate j s - coordinate j e) < delta) ->
  forall n j, Rabs (coordinate j (Rules.iterate f n s) - coordinate j e) < epsilon.
Definition attracting (space : State -> Prop) (f : State -> State) (e : State) : Prop :=
  forall s, space s -> forall epsilon, 0 < epsilon -> exists N, forall n, (N <= n)%nat ->
  forall j, Rabs (coordinate j (Rules.iterate f n s) - coordinate j e) < epsilon."""


def map_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    head = f"{f.forall}forall of_s, {f.at('Map.domain')} -> {f.at('Map.space', 'of_s')} ->\n  "
    intros = f"intros{f.args} of_s of_map of_there."
    here = f.at("Map.f", "of_s")
    guards = [f.at(f"Map.guard_{k}", "of_s") for k in range(1, f.count + 1)]
    images = [f.at(f"Map.image_{k}", "of_s") for k in range(1, f.count + 1)]
    cases = " \\/\n  ".join(f"({g} /\\ {here} = {image})" for g, image in zip(guards, images))
    rows = [intros, "unfold Map.f."]
    for k in range(1, f.count + 1):
        which = "right; " * (k - 1) + "left; " * (k < f.count)
        rows.append(f"destruct ({f.at(f'Map.decided_{k}', 'of_s')}) as [of_g|of_not_{k}];")
        rows.append(f"  [{which}split; [exact of_g|reflexivity]|].")
    covers = f.premise(own, "covers", "of_map", "of_there", at=f.point)
    contradictions = "|".join(f"exact (of_not_{k} of_g)" for k in range(1, f.count + 1))
    pattern = disjunctive(["of_g"] * f.count)
    rows.append(f"exfalso. {f.open}pose proof {covers} as {pattern}; [{contradictions}].")
    yield _lemma("of_map_moves", head + cases, rows)
    stays = [
        f.premise(own, f"stays-{k}", "of_map", "of_there", "of_g", at=f.point)
        for k in range(1, f.count + 1)
    ]
    rows = [intros, *f.by_pieces(stays, has_next=False)]
    yield _lemma("of_map_keeps", f"{head}{f.at('Map.space', f'({here})')}", rows)
    for k, (guard, image) in enumerate(zip(guards, images), 1):
        goals = []
        for i in range(1, f.count + 1):
            both = ("of_g", "of_here") if i > k else ("of_here", "of_g")
            name = f"apart-{max(i, k)}-{min(i, k)}"
            apart = f.premise(own, name, "of_map", "of_there", *both, at=f.point)
            other = f"exfalso. {f.open}exact (R1_neq_R0 (eq_sym {apart}))."
            goals.append("exact of_same." if i == k else other)
        pattern = disjunctive(["[of_g of_same]"] * f.count)
        moves = f"destruct ({f.at('of_map_moves', 'of_s', 'of_map', 'of_there')}) as {pattern}."
        rows = [intros, "intro of_here.", moves, *(f"{{ {goal} }}" for goal in goals)]
        yield _lemma(f"of_map_is_{k}", f"{head}{guard} -> {here} = {image}", rows)
    same = "forall of_s of_t, (forall of_j, Map.coordinate of_j of_s = Map.coordinate of_j of_t) -> of_s = of_t"
    other = _opened("of_t", [f"of_t{k}" for k in range(len(f.state))])
    equal = _equal_states([f"(of_same {axis})" for axis in f.axes])
    yield _lemma(
        "of_same_state", same, ["intros of_s of_t of_same.", f"{f.open}{other}exact {equal}."]
    )


def _opened(state: str, names: Sequence[str]) -> str:
    """The tactic that takes a state apart, which is a number where it has one coordinate."""
    pattern = names[0]
    for name in names[1:]:
        pattern = f"[{pattern} {name}]"
    return f"destruct {state} as {pattern}. " if len(names) > 1 else ""


def _equal_states(proofs: Sequence[str]) -> str:
    """A proof that states are equal, from those for the coordinates."""
    proof = proofs[0]
    for one in proofs[1:]:
        proof = f"(f_equal2 pair {proof} {one})"
    return proof


# -------------------------------------------------------------------------------------------------
# The descent of a rank through stages.


def descent_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    (domain,), (rank,), stages = own.rows("domain"), own.get("rank"), own.get("stage")
    yield "Module Descent.\nImport Map."
    yield f.defined(own, "domain", "Prop", domain, of_state=False)
    yield f.defined(own, "rank", "R", rank)
    for k, stage in enumerate(stages, 1):
        yield f.defined(own, f"stage_{k}", "Prop", stage)
    each = [f.at(f"stage_{k}") for k in range(1, len(stages) + 1)]
    yield f"Definition stages{f.bound} : list (State -> Prop) := ({' :: '.join([*each, 'nil'])})%list."
    yield "End Descent."


def descent_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    stages, pieces = own.get("stage"), range(1, f.count + 1)
    last = len(stages)
    domain, space, here = f.at("Descent.domain"), f.at("Map.space", "of_s"), f.at("Map.f", "of_s")
    start = [
        f"assert (of_map : {f.at('Map.domain')}) by exact {f.premise(own, 'inside', 'of_dom')}.",
        f"assert (of_next := {f.at('of_map_keeps', 'of_s', 'of_map', 'of_there')}).",
    ]
    head = f"{f.forall}{domain} ->\n  forall of_s, {space} -> "
    intros = f"intros{f.args} of_dom of_s of_there."
    bounded = f.premise(own, "bounded", "of_dom", "of_there", at=f.point)
    rank = f.at("Descent.rank", "of_s")
    yield _lemma(
        "of_rank_bounded", f"{head}0 <= {rank}", [intros, f"{f.open}exact (Rge_le _ _ {bounded})."]
    )
    staged = [f.at(f"Descent.stage_{k}", "of_s") for k in range(1, last + 1)]
    inside = " \\/ ".join(staged)
    names = " ".join(f"Descent.stage_{k}" for k in range(1, last + 1))
    rows = [f"intros{f.args} of_s. {f.open}cbv beta iota zeta delta [{names}]. decidable."]
    yield _lemma("of_staged", f"{f.forall}forall of_s, {{{inside}}} + {{~ ({inside})}}", rows)
    falls = [
        f.premise(own, f"falls-{k}", "of_dom", "of_there", "of_out", "of_g", "of_next", at=f.point)
        for k in pieces
    ]
    which = "|".join(f"exists {k}%nat; exact of_in" for k in range(last))
    text = (
        f"{head}\n  (exists k, Rules.stage ({f.at('Descent.stages')}) k of_s) \\/"
        f" {f.at('Descent.rank', f'({here})')} <= {rank} - 1"
    )
    rows = [
        intros,
        *start,
        f"destruct ({f.at('of_staged', 'of_s')}) as [of_in|of_out]; [left|right].",
        f"{{ destruct of_in as {disjunctive(['of_in'] * last)}; [{which}]. }}"
        if last > 1
        else f"{{ {which}. }}",
        *f.by_pieces(falls, has_next=True),
    ]
    yield _lemma("of_rank_falls", text, rows)
    for k in range(1, last + 1):
        following = min(k + 1, last)
        goals = [
            f.premise(
                own, f"stage-{k}-{i}", "of_dom", "of_there", "of_in", "of_g", "of_next", at=f.point
            )
            for i in pieces
        ]
        text = f"{head}{staged[k - 1]} -> {f.at(f'Descent.stage_{following}', f'({here})')}"
        rows = [
            f"intros{f.args} of_dom of_s of_there of_in.",
            *start,
            *f.by_pieces(goals, has_next=True),
        ]
        yield _lemma(f"of_stage_{k}", text, rows)
    listed = f.at("Descent.stages")
    leads = "|".join(
        f"exact ({f.at(f'of_stage_{k}', 'of_dom', 'of_s', 'of_there', 'of_in')})"
        for k in range(1, last)
    )
    text = (
        f"{f.forall}{domain} -> forall of_k of_s, (S of_k < length ({listed}))%nat -> {space} ->\n"
        f"  Rules.stage ({listed}) of_k of_s -> Rules.stage ({listed}) (S of_k) ({here})"
    )
    more = "of_k"
    for _ in range(last - 1):
        more = f"[|{more}]"
    rows = [
        f"intros{f.args} of_dom {more} of_s of_less of_there of_in;",
        f"  [{leads}|cbn in of_less; lia]." if last > 1 else "  cbn in of_less; lia.",
    ]
    yield _lemma("of_stages_lead_on", text, rows)
    text = f"{head}Rules.last_stage ({listed}) of_s -> Rules.last_stage ({listed}) ({here})"
    kept = f.at(f"of_stage_{last}", "of_dom", "of_s", "of_there", "of_in")
    rows = [f"intros{f.args} of_dom of_s of_there of_in. exact ({kept})."]
    yield _lemma("of_last_stage_kept", text, rows)
    rows = [
        f"intros{f.args} of_dom of_s of_n of_there of_late.",
        f"exact (Rules.descent ({f.at('Map.f')}) ({f.at('Map.space')}) ({f.at('Descent.rank')}) ({listed})",
        f"  (fun of_t => {f.at('of_map_keeps', 'of_t')} {f.premise(own, 'inside', 'of_dom')})",
        f"  ({f.at('of_rank_bounded', 'of_dom')}) ({f.at('of_rank_falls', 'of_dom')})"
        f" ({f.at('of_stages_lead_on', 'of_dom')})",
        f"  ({f.at('of_last_stage_kept', 'of_dom')}) of_s of_n of_there of_late).",
    ]
    later = f"(Rules.iterate ({f.at('Map.f')}) of_n of_s)"
    text = (
        f"{f.forall}{domain} ->\n  forall of_s of_n, {space} -> {rank} + INR {last - 1} <= INR of_n ->"
        f"\n  {f.at(f'Descent.stage_{last}', later)}"
    )
    yield _lemma(theorem_name(own.name), text, rows, "Theorem")


# -------------------------------------------------------------------------------------------------
# Contraction in a weighted sup norm.


def contraction_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    (domain,), (on,), (point,) = own.rows("domain"), own.get("on"), own.get("point")
    (weights,) = own.get("weights")
    yield "Module Contraction.\nImport Map."
    yield f.defined(own, "domain", "Prop", domain, of_state=False)
    yield f.defined(own, "on", "Prop", on)
    yield f.defined(own, "point", "State", *point, of_state=False)
    yield f.defined(own, "weights", "State", *weights, of_state=False)
    for name in ("rate", "radius", "size"):
        yield f.defined(own, name, "R", *own.get(name), of_state=False)
    holds = f"{f.at('space', 'of_s')} /\\ {f.at('on', 'of_s')}"
    yield f"Definition set{f.bound} (of_s : State) : Prop := {holds}."
    entries = [f"fun of_j => coordinate of_j ({f.at(name)})" for name in ("point", "weights")]
    near = f"Rules.within coordinate ({entries[0]}) ({entries[1]})"
    yield f"Definition near{f.bound} : R -> State -> Prop :=\n  {near}."
    yield "End Contraction."


def contraction_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    pieces, count = range(1, f.count + 1), len(f.axes)
    here, on = f.at("Map.f", "of_s"), f.at("Contraction.set", "of_s")
    domain, space = f.at("Contraction.domain"), f.at("Map.space", "of_s")
    point = f.at("Contraction.point")
    head = f"{f.forall}{domain} -> "
    inside = f.premise(own, "inside", "of_dom")
    start = [
        f"assert (of_map : {f.at('Map.domain')}) by exact {inside}.",
        f"assert (of_next := {f.at('of_map_keeps', 'of_s', 'of_map', 'of_there')}).",
    ]
    parts = []
    for axis in f.axes:
        apart = f"Map.coordinate {axis} of_s - Map.coordinate {axis} ({point})"
        weight = f"Map.coordinate {axis} ({f.at('Contraction.weights')})"
        parts.append(f"(- of_c * {weight} <= {apart} /\\ {apart} <= of_c * {weight})")
    names = [f"of_{k}" for k in range(1, count + 1)]
    forth = conjoined([f"(proj1 (bounded_by _ _ _) (of_close {axis}))" for axis in f.axes])
    back = "|".join(f"exact (proj2 (bounded_by _ _ _) {name})" for name in names)
    yield _lemma(
        "of_near_is",
        f"{f.forall}forall of_c of_s, {f.at('Contraction.near', 'of_c', 'of_s')} <->\n  "
        + " /\\\n  ".join(parts),
        [
            f"intros{f.args} of_c of_s. split.",
            f"{{ intro of_close. exact {forth}. }}",
            f"{{ intros {conjunctive(names)} []; [{back}]. }}",
        ],
    )
    near_is = f"{f.at('of_near_is')} _ _"
    closer = [
        f.premise(
            own, f"closer-{k}", "of_dom", "of_there", "of_in", "(Rle_ge _ _ of_positive)",
            "of_close", "of_g", "of_next", at=f"{f.point} of_c",
        )
        for k in pieces
    ]  # fmt: skip
    rate = f.at("Contraction.rate")
    yield _lemma(
        "of_closer",
        f"{head}forall of_c of_s, 0 <= of_c -> {on} ->\n"
        f"  {f.at('Contraction.near', 'of_c', 'of_s')} -> {f.at('Contraction.near', f'({rate} * of_c)', f'({here})')}",
        [
            f"intros{f.args} of_dom of_c of_s of_positive [of_there of_in] of_close.",
            f"apply ({near_is}) in of_close. apply ({near_is}).",
            *start,
            *f.by_pieces(closer, has_next=True),
        ],
    )
    stays = [
        f.premise(own, f"stays-{k}", "of_dom", "of_there", "of_in", "of_g", "of_next", at=f.point)
        for k in pieces
    ]
    yield _lemma(
        "of_set_kept",
        f"{head}forall of_s, {on} -> {f.at('Contraction.set', f'({here})')}",
        [
            f"intros{f.args} of_dom of_s [of_there of_in].",
            *start,
            "split; [exact of_next|].",
            *f.by_pieces(stays, has_next=True),
        ],
    )
    for name, left, right in (
        ("surrounds", f.at("Contraction.near", f"({f.at('Contraction.radius')})", "of_s"), on),
        ("size", on, f.at("Contraction.near", f"({f.at('Contraction.size')})", "of_s")),
    ):
        premise = f.premise(own, name, "of_dom", "of_there", "of_in", at=f.point)
        rows = (
            [f"apply ({near_is}) in of_in.", f"split; [exact of_there|]. {f.open}exact {premise}."]
            if name == "surrounds"
            else [f"destruct of_in as [_ of_in]. apply ({near_is}). {f.open}exact {premise}."]
        )
        yield _lemma(
            f"of_set_{name}",
            f"{head}forall of_s, {space} -> {left} -> {right}",
            [f"intros{f.args} of_dom of_s of_there of_in.", *rows],
        )
    weights = [f"of_weight_{k}" for k in range(1, count + 1)]
    positive = "|".join(f"exact {name}" for name in weights)
    yield _lemma(
        "of_constants",
        f"{head}0 <= {rate} /\\ {rate} < 1 /\\ 0 < {f.at('Contraction.radius')} /\\"
        f" 0 < {f.at('Contraction.size')} /\\\n"
        "  exists low high, 0 < low /\\ forall of_j,"
        f" low <= Map.coordinate of_j ({f.at('Contraction.weights')}) <= high",
        [
            f"intros{f.args} of_dom.",
            f"destruct {f.premise(own, 'constants', 'of_dom')}",
            f"  as {conjunctive(['of_least', 'of_most', *weights, 'of_radius', 'of_size'])}.",
            "split; [exact (Rge_le _ _ of_least)|split; [exact of_most|]].",
            "split; [exact of_radius|split; [exact of_size|]].",
            f"apply (bounds_of _ ({' :: '.join([*f.axes, 'nil'])})%list).",
            "{ intros []; repeat (first [left; reflexivity|right]). }",
            f"{{ intros []; [{positive}]. }}",
        ],
    )
    constants = _constants(f, "of_dom")
    norm = _norm(f)
    stable = f"Map.stable ({f.at('Map.space')}) ({f.at('Map.f')}) ({point})"
    yield _lemma(
        "of_stable",
        f"{head}{stable}",
        [
            f"intros{f.args} of_dom. {constants}",
            f"exact (Rules.stability {norm}",
            f"  ({f.at('of_set_kept', 'of_dom')}) of_least ({f.at('of_closer', 'of_dom')})",
            f"  ({f.at('Map.space')}) ({f.at('Contraction.radius')}) of_low of_high of_most of_positive",
            f"  of_between of_radius ({f.at('of_set_surrounds', 'of_dom')})).",
        ],
    )
    in_space = f.premise(own, "point", "of_dom")
    fixed = f"{f.at('Map.space', f'({point})')} /\\ {f.at('Map.f', f'({point})')} = {point}"
    yield _lemma(
        "of_fixed",
        f"{head}{fixed}",
        [
            f"intros{f.args} of_dom. {constants}",
            f"assert (of_there : {f.at('Map.space', f'({point})')}) by exact {in_space}.",
            "split; [exact of_there|]. apply of_same_state.",
            f"apply (Rules.fixed_point {norm}",
            f"  ({f.at('of_closer', 'of_dom')})); [|reflexivity].",
            f"apply ({f.at('of_set_surrounds', 'of_dom')}); [exact of_there|].",
            "intro of_j. unfold Rminus. rewrite Rplus_opp_r, Rabs_R0.",
            "apply Rmult_le_pos; [lra|destruct (of_between of_j); lra].",
        ],
    )
    attracts = f"Map.attracting ({f.at('Contraction.set')}) ({f.at('Map.f')}) ({point})"
    rows = _convergence(
        f,
        norm,
        "of_dom",
        f.at("Contraction.set"),
        "fun _ => 0",
        f"({f.at('Contraction.set')} :: nil)%list",
        [
            f"exact ({f.at('of_set_kept', 'of_dom')})",
            "intros; lra",
            "intros of_t of_in; left; exists 0%nat; exact of_in",
            "intros of_k of_t of_less; cbn in of_less; lia",
            f"intros of_t _; exact ({f.at('of_set_kept', 'of_dom', 'of_t')})",
            "intros of_t _ of_in; exact of_in",
            f"intros of_t [of_here _]; exact ({f.at('of_set_size', 'of_dom', 'of_t', 'of_here')})",
        ],
    )
    yield _lemma("of_attracts", f"{head}{attracts}", [f"intros{f.args} of_dom. {constants}", *rows])
    both = f"{fixed} /\\\n  {stable} /\\\n  {attracts}"
    yield _lemma(
        theorem_name(own.name),
        f"{f.forall}{domain} ->\n  {both}",
        [
            f"intros{f.args} of_dom. destruct ({f.at('of_fixed', 'of_dom')}) as [of_there of_same].",
            f"exact (conj of_there (conj of_same (conj ({f.at('of_stable', 'of_dom')})"
            f" ({f.at('of_attracts', 'of_dom')})))).",
        ],
        "Theorem",
    )


def _norm(f: Frame) -> str:
    """The map, its coordinates, the point, the weights, the set and the rate, as Rules.v has
    them.
    """
    entries = [
        f"(fun of_j => Map.coordinate of_j ({f.at(name)}))"
        for name in ("Contraction.point", "Contraction.weights")
    ]
    on, rate = f.at("Contraction.set"), f.at("Contraction.rate")
    return f"({f.at('Map.f')}) Map.coordinate {' '.join(entries)}\n    ({on}) ({rate})"


def _constants(f: Frame, known: str) -> str:
    return (
        f"destruct ({f.at('of_constants', known)}) as (of_least & of_most & of_radius & of_size"
        " & of_low & of_high & of_positive & of_between)."
    )


def _convergence(
    f: Frame, norm: str, known: str, space: str, rank: str, stages: str, goals: Sequence[str]
) -> list[str]:
    """Tactics for `attracting` by Rules.convergence; known: that the parameters are in the domain
    of the contraction; the goals: the space is kept, rank >= 0, it falls, stages lead on, the last
    one stays, is in the set, and is small.
    """
    return [
        "intros of_s of_there.",
        f"refine (Rules.convergence {norm}",
        f"  ({f.at('of_set_kept', known)}) of_least ({f.at('of_closer', known)})",
        f"  ({space}) of_low of_high of_most of_positive of_between",
        f"  ({rank}) ({stages}) ({f.at('Contraction.size')})",
        "  _ _ _ _ _ _ (Rlt_le _ _ of_size) _ of_s of_there).",
        *(f"{{ {goal}. }}" for goal in goals),
    ]


# -------------------------------------------------------------------------------------------------
# A descent into the set of a contraction.


def no_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    return iter(())


def attraction_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    map_, space, point = f.at("Map.f"), f.at("Map.space"), f.at("Contraction.point")
    last, descent = f.at("Descent.stages"), own.text("descent")
    inside = f"({reading_name(f'{descent}.inside')}{f.args} of_dom)"
    enters = f.premise(
        own, "enters", "of_dom", "of_here", "of_in", at=f.point.replace("of_s", "of_t")
    )
    opened = f.open.replace("of_s", "of_t")
    into = (
        f"assert (of_into : forall of_t, {f.at('Map.space', 'of_t')} -> Rules.last_stage ({last}) of_t"
        f" -> {f.at('Contraction.set', 'of_t')})\n"
        f"    by (intros of_t of_here of_in; split; [exact of_here|{opened.replace('. ', '; ')}"
        f"exact {enters}])."
    )
    rows = [
        f"intros{f.args} of_dom.",
        f"assert (of_con : {f.at('Contraction.domain')}) by exact {f.premise(own, 'inside', 'of_dom')}.",
        f"{into} {_constants(f, 'of_con')}",
        f"split; [exact ({f.at('of_stable', 'of_con')})|].",
        *_convergence(
            f,
            _norm(f),
            "of_con",
            space,
            f.at("Descent.rank"),
            last,
            [
                f"intro of_t. exact ({f.at('of_map_keeps', 'of_t', inside)})",
                f"exact ({f.at('of_rank_bounded', 'of_dom')})",
                f"exact ({f.at('of_rank_falls', 'of_dom')})",
                f"exact ({f.at('of_stages_lead_on', 'of_dom')})",
                f"exact ({f.at('of_last_stage_kept', 'of_dom')})",
                "exact of_into",
                "intros of_t of_here of_in."
                f" exact ({f.at('of_set_size', 'of_con', 'of_t', 'of_here', '(of_into of_t of_here of_in)')})",
            ],
        ),
    ]
    text = (
        f"{f.forall}{f.at('Descent.domain')} ->\n  Map.stable ({space}) ({map_}) ({point}) /\\\n"
        f"  Map.attracting ({space}) ({map_}) ({point})"
    )
    yield _lemma(theorem_name(own.name), text, rows, "Theorem")


# -------------------------------------------------------------------------------------------------
# A periodic orbit, and a theorem that is sharp.


def escape_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    (domain,), (point,), (start,) = own.rows("domain"), own.get("point"), own.get("start")
    yield "Module Escape.\nImport Map."
    yield f.defined(own, "domain", "Prop", domain, of_state=False)
    yield f.defined(own, "point", "State", *point, of_state=False)
    yield f.defined(own, "start", "State", *start, of_state=False)
    yield "End Escape."


def escape_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    (word,) = own.get("word")
    start, point = f.at("Escape.start"), f.at("Escape.point")
    guards = [f"of_guard_{k}" for k in range(len(word))]
    back = [f"of_back_{k}" for k in range(len(f.state))]
    names = ["of_there_0", guards[0], "of_apart", *guards[1:], *back]
    rows = [
        f"intros{f.args} of_dom.",
        f"assert (of_map : {f.at('Map.domain')}) by exact {f.premise(own, 'inside', 'of_dom')}.",
        f"destruct {f.premise(own, 'start', 'of_dom')} as {conjunctive(names)}.",
    ]
    state = f"({start})"
    rows.append(f"change ({f.at('Map.space', state)}) in of_there_0.")
    for k, piece in enumerate(word):
        image = f"({f.at(f'Map.image_{piece}', state)})"
        is_ = f.at(f"of_map_is_{piece}", state, "of_map", f"of_there_{k}", guards[k])
        rows.append(f"pose proof ({is_}) as of_step_{k}.")
        rows.append(
            f"pose proof ({f.at('of_map_keeps', state, 'of_map', f'of_there_{k}')}) as of_there_{k + 1}."
        )
        rows.append(f"rewrite of_step_{k} in of_there_{k + 1}.")
        state = image
    which = disjunctive(["of_apart"] * len(f.axes))
    steps = ", ".join(f"of_step_{k}" for k in range(len(word)))
    cases = "|".join(f"exists {axis}; exact of_apart" for axis in f.axes)
    if len(f.axes) > 1:
        rows.append(f"split; [exact of_there_0|split; [|destruct of_apart as {which}; [{cases}]]].")
    else:
        rows.append(f"split; [exact of_there_0|split; [|{cases}]].")
    rows.append(f"cbn [Rules.iterate]. rewrite {steps}.")
    rows.append(f"exact {_equal_states([f'(eq_sym {one})' for one in back])}.")
    text = (
        f"{f.forall}{f.at('Escape.domain')} ->\n  {f.at('Map.space', f'({start})')} /\\"
        f" Rules.iterate ({f.at('Map.f')}) {len(word)} ({start}) = {start} /\\\n"
        f"  exists of_j, Map.coordinate of_j ({start}) <> Map.coordinate of_j ({point})"
    )
    yield _lemma(theorem_name(own.name), text, rows, "Theorem")


def sharp_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    map_, space, point = f.at("Map.f"), f.at("Map.space"), f.at("Contraction.point")
    attraction, escape = own.text("attraction"), own.text("escape")
    stable = f"Map.stable ({space}) ({map_}) ({point})"
    entries = [
        f"(fun of_j => Map.coordinate of_j ({f.at(name)}))"
        for name in ("Contraction.point", "Escape.point")
    ]
    same = [f"of_{k}" for k in range(1, len(f.axes) + 1)]
    cases = "|".join(f"exact (eq_sym {one})" for one in same)
    rows = [
        f"intros{f.args} of_dom.",
        f"refine (Rules.exactly ({map_}) Map.coordinate {' '.join(entries)}",
        f"  ({space}) {len(f.known[escape].get('word')[0])} ({f.at('Escape.start')}) ({f.at('Descent.domain')})",
        f"  ({f.at('Escape.domain')}) ({stable})",
        f"  {f.premise(own, 'covers', 'of_dom')} _ _ _ _).",
        f"{{ intro of_in. exact (proj1 ({theorem_name(attraction)}{f.args} of_in)). }}",
        f"{{ intro of_in. exact (proj2 ({theorem_name(attraction)}{f.args} of_in)). }}",
        f"{{ intro of_out. split; [lia|exact ({theorem_name(escape)}{f.args} of_out)]. }}",
        f"{{ intro of_out. pose proof {f.premise(own, 'same-point', 'of_out')} as {conjunctive(same)}.",
        f"  intros []; [{cases}]. }}",
    ]
    text = (
        f"{f.forall}{f.at('Map.domain')} ->\n  ({f.at('Descent.domain')} <->\n   {stable} /\\\n"
        f"   Map.attracting ({space}) ({map_}) ({point}))"
    )
    yield _lemma(theorem_name(own.name), text, rows, "Theorem")


Rows = Callable[[Frame, checker.Statement], Iterator[str]]
# by the kind of statement: its definitions, and what it proves from its premises
RULES: Mapping[str, tuple[Rows, Rows]] = {
    "map": (map_definitions, map_proofs),
    "descends": (descent_definitions, descent_proofs),
    "contracts": (contraction_definitions, contraction_proofs),
    "attracts": (no_definitions, attraction_proofs),
    "escapes": (escape_definitions, escape_proofs),
    "exactly": (no_definitions, sharp_proofs),
}
