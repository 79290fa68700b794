"""A theorem on the orbits of a map, certified by rules of the checker, as one file of Coq: the map,
the premises proved by their certificates, and the theorem by proofs/coq/Rules.v.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from string import Template

from juggleproof.certificates import checker
from juggleproof.certificates.coq import PRELUDE, NotWritten, lemmas
from juggleproof.certificates.coq.branch import Known
from juggleproof.certificates.coq.text import conjoined, conjunctive, coq_name, disjunctive
from juggleproof.certificates.language import lemmas_of, rests_on
from juggleproof.certificates.nodes import Certificate
from juggleproof.proofs.theorem import coq_rule_templates as texts
from juggleproof.proofs.theorem.coq_readings import reading_name, readings
from juggleproof.proofs.theorem.coq_terms import coq_formula, coq_term, names_in, term_of

COQ = Path(__file__).resolve().parents[1] / "coq"
# what says nothing of the orbits that tend to a point, or is a part of what does
NO_THEOREM = ("universal", "sharp", "iterates", "map", "escapes")


def theorems_in(statements: Known) -> list[str]:
    """The theorems on the orbits of a map on which no other statement rests."""
    inner = {name for one in statements.values() for name in rests_on(one)}
    return [
        name for name, one in statements.items() if one.kind not in NO_THEOREM and name not in inner
    ]


def theorem(name: str, statements: Known, certificates: Mapping[str, Certificate]) -> str:
    """The file of a certified theorem, which coqc accepts by itself.

    The certificates are those of the statement, of all that it rests on, and of the lemmas that
    these use.  Raises NotWritten for a rule, or a part of a certificate, that is not written for
    Coq.
    """
    chain = _chain(name, statements)
    for one in chain:
        if statements[one].kind not in RULES:
            raise NotWritten(f"{one} is of a rule that is not written for Coq; claim it by another")
    frame = Frame(statements[chain[0]], statements)
    kinds = {statements[one].kind for one in chain}
    rows = [Template(texts.HEADER).substitute(name=name), _theory("lyapunov" in kinds)]
    used = _uses(chain, certificates)
    rows += [
        lemmas(statement, certificates[one], statements)
        for one, statement in statements.items()
        if one in used
    ]
    for one in chain:
        own = statements[one]
        define, prove = RULES[own.kind]
        rows += [f"(* {'-' * 60} {one} *)\n", *define(frame, own), ""]
        rows += [readings(own, certificates[one], statements), *prove(frame, own)]
    return "\n".join([*rows, f"Print Assumptions {theorem_name(name)}.", ""])


def theorem_name(name: str) -> str:
    """The name of the theorem that a statement is."""
    return "theorem_" + re.sub(r"\W", "_", name)


def _chain(name: str, statements: Known) -> list[str]:
    """The map rules that a statement rests on, the map first, and the statement."""
    chain: list[str] = []
    for one in rests_on(statements[name]):
        chain += [each for each in _chain(one, statements) if each not in chain]
    return [*chain, name]


def _uses(names: Sequence[str], certificates: Mapping[str, Certificate]) -> set[str]:
    """The lemmas that certificates use, and those that these use."""
    used: set[str] = set()
    waiting = [*names]
    while waiting:
        more = lemmas_of(certificates[waiting.pop()]) - used
        used |= more
        waiting += more
    return used


def _theory(with_lyapunov: bool) -> str:
    """The lemmas of certificates, and the rules for any map."""
    sources = ["Readings.v", "Rules.v", *["Lyapunov.v"] * with_lyapunov]
    imports = re.compile(r"^(From (Coq|Juggleproof) .*|Open Scope R_scope\.)\n", re.MULTILINE)
    prelude, read, rules, *more = (
        imports.sub("", text) for text in (PRELUDE, *((COQ / one).read_text() for one in sources))
    )
    return "\n".join(
        [
            "From Coq Require Import Reals ZArith Lra Lia List.",
            "Open Scope R_scope.\n",
            prelude,
            read,
            f"Module Rules.\n{rules}End Rules.\n",
            *(f"Module Lyapunov.\nImport Rules.\n{text}End Lyapunov.\n" for text in more),
        ]
    )


class Frame:
    """The words in which a file speaks of its map: parameters and state, bound and applied."""

    def __init__(self, own: checker.Statement, known: Known) -> None:
        (parameters,), (state,) = own.get("over"), own.get("state")
        self.known = known
        self.names = state
        self.state = [*map(coq_name, state)]
        self.axes = [f"Map.axis_{name}" for name in state]
        self.pieces = range(1, len(own.get("piece")) + 1)
        names = " ".join(map(coq_name, parameters))
        self.bound = f" ({names} : R)" if names else ""
        self.pattern = f"({self.state[0]} : State)"
        if len(state) > 1:
            self.pattern = f"'({self.tuple(self.state)} : State)"
        self.words = {
            "a": f" {names}" if names else "",
            "all": f"forall {names} : R, " if names else "",
            "open": _opened("of_s", self.state),
            "s": " ".join(self.state) if len(state) > 1 else "of_s",
        }

    def tuple(self, terms: Sequence[str]) -> str:
        """A state with these coordinates."""
        return terms[0] if len(terms) == 1 else f"({', '.join(terms)})"

    def fill(self, text: str, own: checker.Statement, **more: str | int) -> str:
        """A template with the words of the file, of a statement, and more."""
        prefix, name = reading_name(own.name), theorem_name(own.name)
        return Template(text).substitute({**self.words, "P": prefix, "theorem": name, **more})

    def define(
        self,
        own: checker.Statement,
        name: str,
        returns: str,
        *parts: str,
        of_state: bool = True,
        more: str = "",
    ) -> str:
        """A definition over the parameters, of a state, and of more, by the texts of a statement;
        of several it is the state that they are the coordinates of.
        """
        state = (f" {self.pattern}" if of_state else "") + more
        write = coq_formula if returns == "Prop" else coq_term
        body = self.lets(own, parts) + self.tuple([write(part) for part in parts])
        return f"Definition {name}{self.bound}{state} : {returns} :=\n  {body}."

    def lets(self, own: checker.Statement, parts: Sequence[str]) -> str:
        """What texts name beside parameters and state, in order, as `let` of Coq: roots, and around
        a point its coordinates, and the state less these.
        """
        roots = [(name, f"sqrt ({term_of(under, 0)})", under) for name, (under,) in own.get("root")]
        entries = roots
        if own.get("value"):
            moving, fixed = {*self.names, *(f"{name}_gap" for name in self.names)}, []
            for root in roots:
                if _names(root[2]) & moving:
                    moving.add(root[0])
                else:
                    fixed.append(root)
            point = [
                (f"{name}_point", coq_term(text), checker.parse(text))
                for name, text in zip(self.names, own.get("point")[0])
            ]
            gaps = [
                (f"{name}_gap", coq_term(text), checker.parse(text))
                for name, text in ((name, f"{name} - {name}_point") for name in self.names)
            ]
            entries = [*fixed, *point, *gaps, *(one for one in roots if one not in fixed)]
        used = set().union(*map(names_in, parts))
        rows = ""
        for name, value, node in reversed(entries):
            if name in used:
                used |= _names(node)
                rows = f"let {coq_name(name)} := {value} in " + rows
        return rows

    def by_pieces(
        self,
        own: checker.Statement,
        premise: str,
        known: str,
        point: str = "$s",
        places: str = " in of_next |- *",
        case: str = "exact {}",
    ) -> str:
        """Tactics that show something of the next state by a premise for each piece; known: what
        it assumes; point: the coordinates; places: where the next state occurs.
        """
        first, _, last = premise.partition(" ")
        cases = "|".join(
            case.format(f"(${{P}}_{first}_{k}{last}$a {point} {known})") for k in self.pieces
        )
        opened = self.words["open"].replace(". ", "; ")
        return self.fill(
            f"destruct (of_map_moves$a of_s of_map of_there) as {self.one_piece()};\n"
            f"    rewrite of_same{places}; clear of_same; {opened}[{cases}].",
            own,
        )

    def one_piece(self) -> str:
        """The pattern for the piece whose guard holds, and for the image by it."""
        return disjunctive(["[of_g of_same]"] * len(self.pieces))

    def extra_steps(self, descent: checker.Statement) -> int:
        """The steps from the first stage to the last."""
        return len(descent.get("stage")) - 1


def _opened(state: str, names: Sequence[str]) -> str:
    """The tactic that takes a state apart, where it has several coordinates."""
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


def _names(node: ast.expr) -> set[str]:
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}


def _nested(last: str, count: int) -> str:
    """The pattern for a number that is one of the first few, or more."""
    for _ in range(count):
        last = f"[|{last}]"
    return last


# -------------------------------------------------------------------------------------------------
# The rules, each by its definitions, and by what follows from its premises.


def map_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The state, its coordinates, domain and space, and the map by its pieces."""
    axes = [axis.removeprefix("Map.") for axis in f.axes]
    cases = " | ".join(f"{axis} => {name}" for axis, name in zip(axes, f.state))
    yield "Module Map."
    yield f"Definition State : Type := {' * '.join(['R'] * len(axes))}."
    yield f"Inductive axis : Set := {' | '.join(axes)}."
    yield f"Definition coordinate (of_j : axis) {f.pattern} : R :=\n  match of_j with {cases} end."
    yield texts.STABLE
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "space", "Prop", *own.get("space"))
    steps = "of_s"
    for k, ((guard,), images) in enumerate(own.get("piece"), 1):
        yield f.define(own, f"guard_{k}", "Prop", guard)
        yield f.define(own, f"image_{k}", "State", *images)
        bound, decided = f"{f.bound} (of_s : State)", "{guard_$k$a of_s} + {~ guard_$k$a of_s}"
        yield f.fill(f"Lemma decided_$k{bound} : {decided}.", own, k=k)
        yield f.fill("Proof. ${open}cbv beta iota zeta delta [guard_$k]. decidable. Qed.", own, k=k)
    for k in reversed(f.pieces):
        steps = f.fill(f"if decided_$k$a of_s then image_$k$a of_s\n  else {steps}", own, k=k)
    yield f"Definition f{f.bound} (of_s : State) : State :=\n  {steps}."
    yield "End Map."


def map_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The map keeps the space, and is on each piece what the piece says."""
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
        open_t=_opened("of_t", [f"of_{axis}" for axis in range(len(f.axes))]),
        equal=_equal_states([f"(of_same {axis})" for axis in f.axes]),
    )
    for k in f.pieces:
        others = []
        for i in f.pieces:
            both = "of_g of_here" if i > k else "of_here of_g"
            apart = f"${{P}}_apart_{max(i, k)}_{min(i, k)}$a $s of_map of_there {both}"
            refuted = f"exfalso. ${{open}}exact (R1_neq_R0 (eq_sym ({apart})))."
            others.append(f"{{ {'exact of_same.' if i == k else refuted} }}")
        filled = f.fill("\n  ".join(others), own)
        yield f.fill(texts.PIECE, own, k=k, one_piece=f.one_piece(), others=filled)


def descent_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Rank and stages."""
    yield "Module Descent.\nImport Map."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "rank", "R", *own.get("rank"))
    stages = own.get("stage")
    for k, stage in enumerate(stages, 1):
        yield f.define(own, f"stage_{k}", "Prop", stage)
    each = "".join(f"stage_{k}$a :: " for k in range(1, len(stages) + 1))
    kind = f"{f.bound} : list (State -> Prop)"
    yield f"Definition stages{kind} :=\n  ({f.fill(each, own)}nil)%list."
    yield "End Descent."


def descent_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Every orbit is in the last stage, from a step on that the rank tells."""
    stages = range(1, len(own.get("stage")) + 1)
    last, next_ = stages[-1], f.fill(texts.NEXT, own)
    yield f.fill(
        texts.DESCENT,
        own,
        next=next_,
        staged=f.fill(" \\/ ".join(f"Descent.stage_{k}$a of_s" for k in stages), own),
        stage_names=" ".join(f"Descent.stage_{k}" for k in stages),
        in_a_stage=_in_a_stage(len(stages)),
        falls=f.by_pieces(own, "falls", "of_dom of_there of_out of_g of_next"),
    )
    for k in stages:
        leads = f.by_pieces(own, f"stage_{k}", "of_dom of_there of_in of_g of_next")
        yield f.fill(texts.STAGE, own, k=k, next=next_, following=min(k + 1, last), leads=leads)
    lead_on = "".join(f"exact (of_stage_{k}$a of_dom of_s of_there of_in)|" for k in stages[:-1])
    yield f.fill(
        texts.DESCENDS,
        own,
        each_stage=_nested("of_k", len(stages) - 1),
        lead_on=f.fill(lead_on, own),
        last=last,
        extra=f.extra_steps(own),
    )


def _in_a_stage(count: int) -> str:
    """Tactics that give the number of the stage which a state is in."""
    cases = "|".join(f"exists {k}%nat; exact of_in" for k in range(count))
    return (
        f"destruct of_in as {disjunctive(['of_in'] * count)}; [{cases}]."
        if count > 1
        else f"{cases}."
    )


def contraction_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The set, the point, and the numbers of the norm."""
    yield "Module Contraction.\nImport Map."
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
        apart = f"Map.coordinate {axis} of_s - Map.coordinate {axis} (Contraction.point$a)"
        reach = f"of_c * Map.coordinate {axis} (Contraction.weights$a)"
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
        next=f.fill(texts.NEXT, own),
        closer=f.by_pieces(
            own,
            "closer",
            "of_c of_dom of_there of_in (Rle_ge _ _ of_positive) of_close of_g of_next",
        ),
        stays=f.by_pieces(own, "stays", "of_dom of_there of_in of_g of_next"),
        constants=f.fill(texts.CONSTANTS, own, known="of_dom"),
        norm=f.fill(texts.NORM, own),
    )


FUNCTION = "LyapunovFunction"


def lyapunov_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The set, the point, the terms of the value, and the numbers."""
    yield f"Module {FUNCTION}.\nImport Map."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "on", "Prop", *own.get("on"))
    yield f.define(own, "point", "State", *own.get("point")[0], of_state=False)
    guards = values = ""
    for k, (guard, (term,)) in enumerate(own.get("value"), 1):
        yield f.define(own, f"value_{k}", "R", term)
        values += f.fill(f"{k - 1}%nat => value_{k}$a | ", own)
        if guard:
            yield f.define(own, f"guard_{k}", "Prop", *guard)
            holds = f.fill(f"guard_{k}$a of_s", own)
            yield f"Lemma decided_{k}{f.bound} (of_s : State) : {{{holds}}} + {{~ {holds}}}."
            opened = f.words["open"]
            yield f"Proof. {opened}cbv beta iota zeta delta [guard_{k}]. decidable. Qed."
        each = f"guard_{k}$a" if guard else "fun _ => True"
        guards += f.fill(f"{k - 1}%nat => {each} | ", own)
    match = "(of_i : nat) : State -> {} :=\n  match of_i with {} end."
    yield f"Definition guards{f.bound} " + match.format("Prop", guards + "_ => fun _ => False")
    yield f"Definition values{f.bound} " + match.format("R", values + "_ => fun _ => 0")
    yield f.define(own, "loss", "R", *own.get("loss"), more=" (value : R)")
    both = " (distance level : R)"
    yield f.define(own, "least", "R", *own.get("least"), of_state=False, more=both)
    for name in ("upper", "radius"):
        yield f.define(own, name, "R", *own.get(name), of_state=False)
    bound = f"{f.bound} (of_s : State) : Prop"
    yield f.fill(f"Definition set{bound} := space$a of_s /\\ on$a of_s.", own)
    yield f.fill(
        f"Definition near{f.bound} : R -> State -> Prop :=\n"
        "  Lyapunov.close coordinate (fun of_j => coordinate of_j (point$a)).",
        own,
    )
    yield f"End {FUNCTION}."


def lyapunov_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is fixed, stable, and attracts the set."""
    values, have = own.get("value"), own.get("have")
    count, is_plain = len(values), len(values) == 1 and not values[0][0]
    names = f.state if len(f.axes) > 1 else ["of_s"]
    at = [f"(Map.coordinate {axis} ({FUNCTION}.point$a))" for axis in f.axes]
    gaps = " ".join(f"({name} - {e})" for name, e in zip(names, at))
    sums = " ".join(f"{name} (sum_is {name} {e})" for name, e in zip(names, at))
    points = "".join(f" {e}" for e in at) if have else ""
    proofs = "".join(f" of_have_{k}" for k in range(1, len(have) + 1))
    each = [f"of_{k}" for k in range(1, len(f.axes) + 1)]
    apart = [f"Map.coordinate {axis} of_s - {e}" for axis, e in zip(f.axes, at)]
    here, heres = "", " ".join(f"of_here_{k}" for k in range(1, count + 1))
    for k, (guard, _) in enumerate(values, 1):
        least = f"{FUNCTION}.value_{k}$a of_s <= of_v"
        if guard:
            here += (
                f"assert (of_here_{k} : ~ {FUNCTION}.guard_{k}$a of_s \\/ {least}).\n"
                f"    {{ destruct ({FUNCTION}.decided_{k}$a of_s) as [of_g|of_g]; [right|left].\n"
                f"      exact (of_high {k - 1}%nat ltac:(lia) of_g). exact of_g. }}\n    "
            )
        else:
            here += (
                f"assert (of_here_{k} : {least}) by exact (of_high {k - 1}%nat ltac:(lia) I).\n    "
            )
    value = f"({FUNCTION}.value_1$a of_s)" if is_plain else "of_v"
    loss = f"{FUNCTION}.loss$a of_s {value}"
    known = "(Rle_ge _ _ of_1) (one_more _ of_1)"
    given = known if is_plain else f"{heres} {known}"
    own_value = f.fill(texts.OWN_VALUE, own) if is_plain else ""
    before = f"of_dom{proofs} {sums} of_there of_in"
    extra = "" if is_plain else " of_v"
    falls = []
    for k, (guard, _) in enumerate(values, 1):
        rows = f"{{ assert (of_next := of_map_keeps$a of_s of_map of_there).\n    {own_value}{here}"
        if is_plain:
            rows += f"apply Rle_trans with ({value} - {loss});\n      "
            rows += "[|exact (Rplus_le_compat_r _ _ _ of_own)].\n    "
        choice = "destruct {} as [of_no|of_le]; [destruct (of_no of_guard)|exact of_le]"
        rows += f.by_pieces(
            own,
            f"falls _{k}",
            f"{before} {given} of_g of_next",
            point=f"{points} {gaps}{extra}",
            places=" in of_next, of_guard |- *",
            case=choice if guard else "exact {}",
        )
        falls.append(rows + " }")
    small = [
        f"apply (of_near_point_is$a _ _) in of_close; {f.words['open'].replace('. ', '; ')}"
        f"exact (${{P}}_small_{k}$a{points} {gaps} of_d of_dom{proofs} {sums} of_there"
        f" (Rle_ge _ _ of_1) of_close of_2{' of_here' if guard else ''})"
        for k, (guard, _) in enumerate(values, 1)
    ]
    norm = f"(Map.f$a) Map.coordinate (fun of_j => Map.coordinate of_j ({FUNCTION}.point$a))"
    parts = f"({FUNCTION}.guards$a) ({FUNCTION}.values$a) {count}"
    losses = f"(fun of_s {'_' if is_plain else 'of_v'} => {loss})"
    far = []
    for k in range(len(f.axes)):
        side = "of_far" if k == len(f.axes) - 1 else "(or_introl of_far)"
        for _ in range(k):
            side = f"(or_intror {side})"
        far.append(f"exact {side}")
    words = {
        "inequalities": " /\\\n  ".join(f"(- of_c <= {one} /\\ {one} <= of_c)" for one in apart),
        "forth": conjoined([f"(proj1 (within_is _ _) (of_close {axis}))" for axis in f.axes]),
        "each_axis": conjunctive(each),
        "back": "|".join(f"exact (proj2 (within_is _ _) {name})" for name in each),
        "point": conjunctive(["of_at", *proofs.split()]),
        "E": points,
        "H": proofs,
        "gaps": gaps,
        "sums": sums,
        "each_value": _nested("of_i", count),
        "small": "|".join(small),
        "stays": f.by_pieces(own, "stays", f"{before} of_g of_next", point=f"{points} {gaps}"),
        "here": here,
        "at_least": heres,
        "loss": loss,
        "own_value": own_value,
        "level": "apply (Rle_trans _ _ _ of_own) in of_4. " if is_plain else "",
        "v": extra,
        "given": f" {given}",
        "far": " \\/ ".join(f"({one} >= of_d \\/ {one} <= - of_d)" for one in apart),
        "each_far": "|".join(far),
        "value": value,
        "reached": "(Rle_refl _)" if is_plain else heres,
        "falls": "\n    ".join(falls),
        "function": f"{norm} (Map.space$a)\n      ({FUNCTION}.set$a) {parts} {losses}"
        f" ({FUNCTION}.least$a)\n      ({FUNCTION}.upper$a) ({FUNCTION}.radius$a)",
        "attraction": f"{norm}\n      ({FUNCTION}.set$a) {parts} {losses} ({FUNCTION}.least$a)",
    }
    filled = {name: f.fill(text, own) for name, text in words.items()}
    yield f.fill(texts.LYAPUNOV, own, count=count, **filled)


def no_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """None: the statement names what others define."""
    return iter(())


def attraction_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is stable, and attracts every state."""
    descent = f.known[own.text("descent")]
    if own.get("lyapunov"):
        yield f.fill(
            texts.ATTRACTS_BY_LYAPUNOV,
            own,
            extra=f.extra_steps(descent),
            last=f.extra_steps(descent) + 1,
            descent=reading_name(descent.name),
            descends=theorem_name(descent.name),
            lyapunov=theorem_name(own.text("lyapunov")),
        )
        return
    yield f.fill(
        texts.ATTRACTS,
        own,
        extra=f.extra_steps(descent),
        descent=reading_name(descent.name),
        constants=f.fill(texts.CONSTANTS, own, known="of_con"),
        norm=f.fill(texts.NORM, own),
    )


def escape_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Where the periodic orbit starts, and the point that it stays away from."""
    yield "Module Escape.\nImport Map."
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    for name in ("point", "start"):
        yield f.define(own, name, "State", *own.get(name)[0], of_state=False)
    yield "End Escape."


def escape_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The start is not the point, and is back after a period."""
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
        equal=_equal_states([f"(eq_sym {one})" for one in back]),
    )


def sharp_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is stable and attracts every state just on the domain of the descent."""
    escape, attraction = f.known[own.text("escape")], f.known[own.text("attraction")]
    by_lyapunov = bool(attraction.get("lyapunov"))
    each = [f"of_{k}" for k in range(1, len(f.axes) + 1)]
    yield f.fill(
        texts.EXACTLY,
        own,
        period=len(escape.get("word")[0]),
        around=FUNCTION if by_lyapunov else "Contraction",
        tends="proj2" if by_lyapunov else "(fun of_all => proj1 (proj2 of_all))",
        attraction=theorem_name(attraction.name),
        escape=theorem_name(escape.name),
        each_axis=conjunctive(each),
        back="|".join(f"exact (eq_sym {one})" for one in each),
    )


Rows = Callable[[Frame, checker.Statement], Iterator[str]]
RULES: Mapping[str, tuple[Rows, Rows]] = {
    "map": (map_definitions, map_proofs),
    "descends": (descent_definitions, descent_proofs),
    "contracts": (contraction_definitions, contraction_proofs),
    "lyapunov": (lyapunov_definitions, lyapunov_proofs),
    "attracts": (no_definitions, attraction_proofs),
    "escapes": (escape_definitions, escape_proofs),
    "exactly": (no_definitions, sharp_proofs),
}
