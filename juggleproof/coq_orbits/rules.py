"""A theorem on the orbits of a map or relation, certified by rules of the checker, as one file of
Coq: the map, the premises proved by their certificates, and the theorem by proofs/coq/orbits.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from string import Template

from juggleproof.certificates import checker
from juggleproof.coq_orbits import kinds
from juggleproof.coq_orbits import templates as texts
from juggleproof.coq_orbits.frame import (
    Frame,
    equal_states,
    opened,
    theorem_name,
)
from juggleproof.coq_orbits.ranks import (
    NEXT,
    descent_definitions,
    descent_proofs,
    has_end,
    has_one_term,
    times,
)
from juggleproof.coq_orbits.readings import reading_name, readings
from juggleproof.coq_orbits.returns import returning_definitions, returning_proofs
from juggleproof.coq_orbits.settles import (
    end_module,
    settling_definitions,
    settling_proofs,
)
from juggleproof.coq_orbits.terms import coq_term
from juggleproof.coq_orbits.values import (
    CHETAEV,
    LYAPUNOV,
    PremisesAroundPoint,
    instability_definitions,
    instability_proofs,
    lyapunov_definitions,
    lyapunov_proofs,
)
from juggleproof.coq_store import PRELUDE, lemmas
from juggleproof.coq_store.branch import Known
from juggleproof.coq_store.text import conjoined, conjunctive, disjunctive, without_primes
from juggleproof.folders import FOLDER
from juggleproof.statements.language import lemmas_of, rests_on
from juggleproof.statements.nodes import Certificate

ORBITS = FOLDER / "coq" / "orbits"
# kinds of statements that say nothing of stability or attraction
NO_THEOREM = ("universal", "sharp", "iterates", "map", "relation")


def theorems_in(statements: Known) -> list[str]:
    """The names of the theorems on the orbits of a map on which no other statement rests."""
    inner = {name for one in statements.values() for name in rests_on(one)}
    return [
        name for name, one in statements.items() if one.kind not in NO_THEOREM and name not in inner
    ]


def theorem(name: str, statements: Known, certificates: Mapping[str, Certificate]) -> str:
    """The file of a certified theorem, which coqc accepts by itself.

    The certificates are those of the statement, of all that it rests on, and of the lemmas that
    these use.  Raises NotWritten for a part of a certificate that is not written for Coq.
    """
    everything = [*_chain(name, statements, whole=True)]
    own = [statements[one] for one in everything]
    frame = _frame(name, statements)
    head = [Template(texts.HEADER).substitute(name=name, M=frame.words["M"]), _theory(own)]
    space = "\n".join(states(frame, {frame.kind, *(one.kind for one in own)}))
    used = _uses(everything, certificates)
    rows = [
        lemmas(statement, certificates[one], statements)
        for one, statement in statements.items()
        if one in used
    ]
    rows += [*_chain_rows(name, frame, certificates), f"Print Assumptions {theorem_name(name)}."]
    body = "\n".join(rows)
    return "\n".join([*head, without_primes(f"{space}\n{body}", body), ""])


def _frame(name: str, known: Known, around: str = "map") -> Frame:
    """The frame of the map or relation that a statement is about; a map has that of a relation if
    the space around it belongs to a relation.
    """
    own = known[_chain(name, known)[0]]
    return Frame(own, known, "relation" if around == "relation" else own.kind)


def _chain_rows(name: str, f: Frame, certificates: Mapping[str, Certificate]) -> Iterator[str]:
    """The rows of what a statement rests on, and those of the statement."""
    within = _modules(f.known[name])
    for one in _chain(name, f.known):
        own = f.known[one]
        for inner in _inner(own):
            yield "Module Inner.\n"
            yield from _chain_rows(inner, _frame(inner, f.known, f.kind), certificates)
            yield "End Inner.\n"
        define, prove = RULES[f.kind if own.kind in ("map", "relation") else own.kind]
        yield f"(* {'-' * 60} {one} *)\n"
        if one in within:
            yield f"Module {within[one]}.\n"
        yield from define(f, own)
        yield "\n" + readings(own, certificates[one], f.known)
        yield from prove(f, own)
        if one in within:
            yield f"End {within[one]}.\n"


def _modules(own: checker.Statement) -> dict[str, str]:
    """The modules for the refutations or contractions that a statement names."""
    refuted = _refutations(own)
    modules = {name: f"Refuted_{refuted.index(name) + 1}" for name in refuted}
    if own.kind == "settles":
        modules = {name: end_module(own, name) for name in own.get("contraction")}
    return modules


def _refutations(own: checker.Statement) -> list[str]:
    """The escapes and instabilities that a sharp statement names, in order."""
    return [name for keyword, name in own.lines if keyword in ("escape", "unstable")]


def _chain(name: str, known: Known, whole: bool = False) -> list[str]:
    """The map rules that a statement rests on, the map first, and the statement; if `whole`, also
    those on another map.
    """
    own, chain = known[name], []
    for one in rests_on(own):
        if whole or one not in _inner(own):
            chain += [each for each in _chain(one, known, whole) if each not in chain]
    return [*chain, name]


def _inner(own: checker.Statement) -> list[str]:
    """The statements on another map that a statement names: on the map on the smaller space that it
    leads into, or on the map that makes several steps at once.
    """
    within = {"into": "attraction", "returns": "settling"}.get(own.kind, "")
    return own.get(within)


def _uses(names: Sequence[str], certificates: Mapping[str, Certificate]) -> set[str]:
    """The lemmas that certificates use, and those that these use."""
    used: set[str] = set()
    waiting = [*names]
    while waiting:
        more = lemmas_of(certificates[waiting.pop()]) - used
        used |= more
        waiting += more
    return used


def _theory(statements: Sequence[checker.Statement]) -> str:
    """The lemmas for certificates, and the conclusions of rules for any map or relation."""
    modules, rules = {"Rules": "Rules.v"}, {one.kind for one in statements}
    has_ranks = any(one.kind == "descends" and not has_one_term(one) for one in statements)
    if rules & {"relation", "lyapunov", "unstable", "attracts", "into"}:
        modules["Lyapunov"] = "Lyapunov.v"
    if "settles" in rules:
        modules["Attractors"] = "Attractors.v"
    if "returns" in rules:
        modules["Returns"] = "Returns.v"
    if has_ranks:
        modules["Ranks"] = "Ranks.v"
    if "relation" in rules:
        modules["Executions"] = "Relation.v"
        if has_ranks:
            modules["RelationRanks"] = "RelationRanks.v"
        if "into" in rules:
            modules["RelationInto"] = "RelationInto.v"
    imports = re.compile(r"^(From (Coq|Juggleproof) .*|Open Scope R_scope\.)\n", re.MULTILINE)
    rows = ["From Coq Require Import Reals ZArith Lra Lia List.", "Open Scope R_scope.\n"]
    rows += [imports.sub("", text) for text in (PRELUDE, (ORBITS / "Readings.v").read_text())]
    needs = ""
    for module, source in modules.items():
        text = imports.sub("", (ORBITS / source).read_text())
        rows.append(f"Module {module}.\n{needs}{text}End {module}.\n")
        needs += f"Import {module}.\n"
    return "\n".join(rows)


# -------------------------------------------------------------------------------------------------
# The rules: for each its definitions, and the proofs from its premises.


def states(f: Frame, rules: Set[str]) -> Iterator[str]:
    """The state, its coordinates, and the definitions of stable and attracting."""
    axes = [axis.removeprefix("States.") for axis in f.axes]
    cases = " | ".join(f"{axis} => {name}" for axis, name in zip(axes, f.state))
    yield "Module States."
    yield f"Definition State : Type := {' * '.join(['R'] * len(axes))}."
    yield f"Inductive axis : Set := {' | '.join(axes)}."
    yield f"Definition coordinate (of_j : axis) {f.pattern} : R :=\n  match of_j with {cases} end."
    yield from (text for kind, text in kinds.STABLE.items() if kind in rules)
    yield "End States.\n"


def map_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Domain and space, and the map by its pieces."""
    yield "Module Map.\nImport States."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "space", "Prop", *own.get("space"))
    steps = "of_s"
    for k, ((guard,), images) in enumerate(own.get("piece"), 1):
        yield f.define(own, f"guard_{k}", "Prop", guard)
        yield f.define(own, f"image_{k}", "State", *images)
        yield f.decided(own, k)
    for k in reversed(f.pieces):
        steps = f.fill(f"if decided_$k$a of_s then image_$k$a of_s\n  else {steps}", own, k=k)
    yield f"Definition f{f.bound} (of_s : State) : State :=\n  {steps}."
    yield "End Map."


def map_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The map stays in the space, and equals on each piece the image of the piece."""
    one, last = "(Map.guard_{k}$a of_s /\\ Map.f$a of_s = Map.image_{k}$a of_s)", f.pieces[-1]
    decided = []
    for k in f.pieces:
        which = "right; " * (k - 1) + "left; " * (k < last)
        decided.append(f"destruct (Map.decided_{k}$a of_s) as [of_g|of_not_{k}];")
        decided.append(f"  [{which}split; [exact of_g|reflexivity]|].")
    yield f.fill(
        texts.MAP,
        own,
        moves=f.fill(" \\/\n  ".join(one.format(k=k) for k in f.pieces), own),
        decided=f.fill("\n  ".join(decided), own),
        one_guard=disjunctive(["of_g"] * last),
        none="|".join(f"exact (of_not_{k} of_g)" for k in f.pieces),
        stays=f.by_pieces(own, "stays", "of_map of_there of_g", places=""),
    )
    yield _same_state(f, own)
    for k in f.pieces:
        others = []
        for i in f.pieces:
            both = "of_g of_here" if i > k else "of_here of_g"
            apart = f"${{P}}_apart_{max(i, k)}_{min(i, k)}$a $s of_map of_there {both}"
            refuted = f"exfalso. ${{open}}exact (R1_neq_R0 (eq_sym ({apart})))."
            others.append(f"{{ {'exact of_same.' if i == k else refuted} }}")
        filled = f.fill("\n  ".join(others), own)
        yield f.fill(texts.PIECE, own, k=k, one_piece=f.one_piece(), others=filled)


def _same_state(f: Frame, own: checker.Statement) -> str:
    """States with the same coordinates are the same."""
    return f.fill(
        texts.SAME_STATE,
        own,
        open_t=opened("of_t", [f"of_{axis}" for axis in range(len(f.axes))]),
        equal=equal_states([f"(of_same {axis})" for axis in f.axes]),
    )


def relation_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Domain and space, and the next states by the pieces, for some inputs."""
    yield "Module Relation.\nImport States."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "space", "Prop", *own.get("space"))
    inputs, names = "".join(f" {name}" for name in f.inputs), " ".join(f.inputs)
    more = f" ({names} : R)" if names else ""
    some, steps = (f"exists {names} : R, " if names else ""), []
    for k, ((guard,), images) in enumerate(own.get("piece"), 1):
        yield f.define(own, f"guard_{k}", "Prop", guard, more=more)
        yield f.define(own, f"image_{k}", "State", *images, more=more)
        applied = f"$a of_s{inputs}"
        steps.append(f"({some}guard_{k}{applied} /\\ of_t = image_{k}{applied})")
    text = f"Definition next{f.bound} (of_s of_t : State) : Prop :=\n  "
    yield f.fill(text + " \\/\n  ".join(steps) + ".", own)
    yield "End Relation."


def relation_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Each state of the space has a next one, and all next ones are in the space."""
    last, exists = f.pieces[-1], "".join(f"exists {name}; " for name in f.inputs)
    images = []
    for k in f.pieces:
        which = "right; " * (k - 1) + "left; " * (k < last)
        images.append(f"eexists; {which}{exists}split; [exact of_g|reflexivity]")
    yield f.fill(
        texts.RELATION,
        own,
        some_guard=conjunctive([*f.inputs, disjunctive(["of_g"] * last)]),
        an_image="|".join(images),
        stays=f.by_pieces(own, "stays", "of_map of_there of_g", places=""),
    )
    yield _same_state(f, own)


def contraction_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The set, the point, and the numbers of the norm."""
    yield f"Module Contraction.\nImport States {f.words['M']}."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "on", "Prop", *own.get("on"))
    for name in ("point", "weights"):
        yield f.define(own, name, "State", *own.get(name)[0], of_state=False)
    for name in ("rate", "radius", "size"):
        yield f.define(own, name, "R", *own.get(name), of_state=False)
    bound = f"{f.bound} (of_s : State) : Prop"
    yield f.fill(f"Definition set{bound} := space$a of_s /\\ on$a of_s.", own)
    yield "(* |s_j - e_j| <= c weight_j for every coordinate j. *)"
    yield f.fill(
        f"Definition near{f.bound} : R -> State -> Prop :=\n"
        "  Rules.within coordinate (fun of_j => coordinate of_j (point$a))\n"
        "    (fun of_j => coordinate of_j (weights$a)).",
        own,
    )
    yield "End Contraction."


def contraction_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is fixed, stable, and attracts the set."""
    each = [f"of_{k}" for k in range(1, len(f.axes) + 1)]
    parts = []
    for axis in f.axes:
        apart = f"States.coordinate {axis} of_s - States.coordinate {axis} (Contraction.point$a)"
        reach = f"of_c * States.coordinate {axis} (Contraction.weights$a)"
        parts.append(f"(- {reach} <= {apart} /\\\n   {apart} <= {reach})")
    yield f.fill(
        texts.CONTRACTS,
        own,
        inequalities=f.fill(" /\\\n  ".join(parts), own),
        forth=conjoined([f"(proj1 (bounded_by _ _ _) (of_close {axis}))" for axis in f.axes]),
        each_axis=conjunctive(each),
        back="|".join(f"exact (proj2 (bounded_by _ _ _) {name})" for name in each),
        numbers=conjunctive(["of_least", "of_most", *each, "of_radius", "of_size"]),
        axes=" :: ".join([*f.axes, "nil"]),
        positive="|".join(f"exact {name}" for name in each),
        next=f.fill(NEXT, own),
        closer=f.by_pieces(
            own,
            "closer",
            "of_dom of_there of_in (Rle_ge _ _ of_positive) of_close of_g of_next",
            point="$s of_c",
        ),
        stays=f.by_pieces(own, "stays", "of_dom of_there of_in of_g of_next"),
        constants=f.fill(texts.CONSTANTS, own),
        **f.of_kind(kinds.CONTRACTION, own, "Contraction"),
    )


def no_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """None: the statement names what others define."""
    return iter(())


def attraction_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is stable, and attracts every state; with a contraction within a bound."""
    descent, bounded = f.known[own.get("descent")[0]], bool(own.get("contraction"))
    words = f.of_kind(kinds.ENTERED, own, _around(f, own))
    words |= times(f, descent, " of_k")
    words["descends"] = f"{theorem_name(descent.name)}{f.words['a']} of_dom"
    words |= {
        word: f.fill(text, own, **words) for word, text in texts.IN_TIME[has_end(descent)].items()
    }
    yield f.fill(
        texts.ATTRACTS,
        own,
        within_a_bound=", within a bound" * bounded,
        bound=f.fill(texts.BOUND, own, **words) * bounded,
        settles=theorem_name((own.get("lyapunov") + own.get("contraction"))[0]),
        tends="of_tends & of_nearer" if bounded else "of_tends",
        split="split" * bounded,
        bounded=f.fill(texts.BOUNDED, own, **words) * bounded,
        last=f.extra_steps(descent) + 1,
        descent=reading_name(descent.name),
        **words,
    )


def escape_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Where the periodic orbit starts, and the point that it stays away from."""
    yield "Module Escape.\nImport States Map."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    for name in ("point", "start"):
        yield f.define(own, name, "State", *own.get(name)[0], of_state=False)
    yield "End Escape."


def escape_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The start is back after a period, so that the point does not attract it."""
    (word,) = own.get("word")
    guards = [f"of_guard_{k}" for k in range(len(word))]
    back = [f"of_back_{k}" for k in range(len(f.axes))]
    state, steps = "(Escape.start$a)", []
    for k, piece in enumerate(word):
        here = f"$a {state} of_map of_there_{k}"
        steps += [
            f"pose proof (of_map_is_{piece}{here} {guards[k]}) as of_step_{k}.",
            f"pose proof (of_map_keeps{here}) as of_there_{k + 1}.",
            f"rewrite of_step_{k} in of_there_{k + 1}.",
        ]
        state = f"(Map.image_{piece}$a {state})"
    apart = "|".join(f"exists {axis}; exact of_apart" for axis in f.axes)
    if len(f.axes) > 1:
        pattern = disjunctive(["of_apart"] * len(f.axes))
        apart = f"destruct of_apart as {pattern}; [{apart}]"
    yield f.fill(
        texts.ESCAPES,
        own,
        period=len(word),
        shown=conjunctive(["of_there_0", guards[0], "of_apart", *guards[1:], *back]),
        steps=f.fill("\n  ".join(steps), own),
        apart=apart,
        rewritten=", ".join(f"of_step_{k}" for k in range(len(word))),
        equal=equal_states([f"(eq_sym {one})" for one in back]),
    )


def _around(f: Frame, attraction: checker.Statement) -> str:
    """The module with the point of an attraction."""
    if attraction.kind == "into":
        return "Inner." + _around(f, f.known[attraction.get("attraction")[0]])
    return LYAPUNOV if attraction.get("lyapunov") else "Contraction"


def _tends(attraction: checker.Statement) -> str:
    """The function that takes from its theorem the part that every state is attracted."""
    bounded = bool(attraction.get("contraction"))
    return "(fun of_all => proj1 (proj2 of_all))" if bounded else "proj2"


def into_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """A neighbourhood of the point that is in the smaller space."""
    inner = own
    while inner.kind in ("into", "attracts"):
        (name,) = (
            text
            for (key, _), text in zip(inner.lines, inner.texts)
            if key in ("attraction", "contraction", "lyapunov")
        )
        inner = f.known[name]
    yield "Module Into.\nImport States."
    radius = f.lets(inner, own.get("radius")) + coq_term(*own.get("radius"))
    yield f"Definition radius{f.bound} : R :=\n  {radius}."
    yield "End Into."


def into_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is stable and attracts every state of the larger space."""
    descent, attraction = f.known[own.get("descent")[0]], f.known[own.get("attraction")[0]]
    inner, around = _frame(attraction.name, f.known, f.kind), _around(f, own)
    same, moves = [], []
    image = "reflexivity" if f.kind == "map" else "exact of_same"
    exists = "".join(f"exists {one if one in f.inputs else 0}; " for one in inner.inputs)
    for k in f.pieces:
        which = "right; " * (k - 1) + "left; " * (k < f.pieces[-1])
        same.append(f"exact (Inner.of_map_is_{k}$a of_s of_inner_map of_within of_g)")
        moves.append(f"{which}{exists}split; [exact of_g|{image}]")
    pieces = {"one_piece": f.one_piece(), "same": "|".join(same), "moves": "|".join(moves)}
    words = f.of_kind(kinds.ENTERED, own, around)
    for word, text in kinds.INTO[f.kind, inner.kind].items():
        words[word] = f.fill(f.fill(text, own, **pieces), own)
    yield f.fill(
        texts.INTO,
        own,
        N=inner.words["M"],
        G=inner.words["F"],
        inner_st=inner.words["st"],
        tends=_tends(attraction),
        attraction=f"Inner.{theorem_name(attraction.name)}",
        descent=reading_name(descent.name),
        inner=f"Inner.{reading_name(attraction.get('descent')[0])}",
        last=f.extra_steps(descent) + 1,
        within=conjoined([f"(within_one _ _ (of_close {axis}))" for axis in f.axes]),
        **words,
    )


def sharp_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is stable and attracts every state exactly on the domain of the descent."""
    attraction, refuted = f.known[own.get("attraction")[0]], _refutations(own)
    each = [f"of_{k}" for k in range(1, len(f.axes) + 1)]
    words = {
        "around": _around(f, attraction),
        "each_axis": conjunctive(each),
        "back": "|".join(f"exact (eq_sym {one})" for one in each),
    }
    domains, rows = [], []
    for k, name in enumerate(refuted, 1):
        other, within = f.known[name], f"Refuted_{refuted.index(name) + 1}"
        words.update(k=str(k), within=within, refutes=theorem_name(name))
        if other.kind == "escapes":
            domains.append(f.fill(f"{within}.Escape.domain$a", own))
            (word,) = other.get("word")
            rows.append(f.fill(texts.ESCAPE_REFUTES, own, period=len(word), **words))
            continue
        domains.append(f.fill(f"{within}.{CHETAEV}.domain$a", own))
        around = PremisesAroundPoint(f, other, f"{within}.{CHETAEV}").words
        words.update(E=f.fill(around["E"], own), H=around["H"], point=around["point"])
        words["at_point"] = reading_name(f"{name}.point")
        rows.append(f.fill(texts.INSTABILITY_REFUTES, own, **words))
    first = "apply Exists_cons_hd; exact of_in"
    yield f.fill(
        texts.EXACTLY,
        own,
        tends=_tends(attraction),
        attraction=theorem_name(attraction.name),
        domains=" :: ".join(domains),
        alternatives=disjunctive(["of_in"] * (len(refuted) + 1)),
        covered="|".join(f"{k * 'apply Exists_cons_tl; '}{first}" for k in range(len(refuted) + 1)),
        refuted="  ".join(rows).rstrip(),
        around=words["around"],
    )


Rows = Callable[[Frame, checker.Statement], Iterator[str]]
RULES: Mapping[str, tuple[Rows, Rows]] = {
    "map": (map_definitions, map_proofs),
    "relation": (relation_definitions, relation_proofs),
    "descends": (descent_definitions, descent_proofs),
    "contracts": (contraction_definitions, contraction_proofs),
    "lyapunov": (lyapunov_definitions, lyapunov_proofs),
    "unstable": (instability_definitions, instability_proofs),
    "attracts": (no_definitions, attraction_proofs),
    "into": (into_definitions, into_proofs),
    "escapes": (escape_definitions, escape_proofs),
    "exactly": (no_definitions, sharp_proofs),
    "settles": (settling_definitions, settling_proofs),
    "returns": (returning_definitions, returning_proofs),
}
