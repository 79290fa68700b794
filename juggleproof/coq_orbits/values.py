"""Functions of the state less a point, which fall or grow along orbits, as theorems of Coq: the
rules on Lyapunov's and on Chetaev's functions.
"""

from __future__ import annotations

from collections.abc import Iterator

from juggleproof.certificates import checker
from juggleproof.coq_orbits import kinds
from juggleproof.coq_orbits import templates as texts
from juggleproof.coq_orbits.frame import Frame, nested
from juggleproof.coq_store.text import conjoined, conjunctive, coq_name, disjunctive

LYAPUNOV, CHETAEV = "LyapunovFunction", "ChetaevFunction"


class PremisesAroundPoint:
    """The words by which premises around a point are applied: their arguments for a state, and the
    formula that a state is near.
    """

    def __init__(self, f: Frame, own: checker.Statement, module: str) -> None:
        self.guards = [guard for guard, _ in own.get("value")]
        self.have = own.get("have")
        coordinates = f.state if len(f.axes) > 1 else ["of_s"]
        at = [f"(States.coordinate {axis} ({module}.point$a))" for axis in f.axes]
        self.apart = [f"States.coordinate {axis} of_s - {e}" for axis, e in zip(f.axes, at)]
        self.gaps = " ".join(f"({name} - {e})" for name, e in zip(coordinates, at))
        self.sums = " ".join(f"{name} (sum_is {name} {e})" for name, e in zip(coordinates, at))
        self.points = "".join(f" {e}" for e in at) if self.have else ""
        self.proofs = "".join(f" of_have_{k}" for k in range(1, len(self.have) + 1))
        self.each_axis = [f"of_{k}" for k in range(1, len(f.axes) + 1)]
        inequalities = [f"(- of_c <= {one} /\\ {one} <= of_c)" for one in self.apart]
        self.words = {
            "inequalities": " /\\\n  ".join(inequalities),
            "forth": conjoined([f"(proj1 (within_is _ _) (of_close {axis}))" for axis in f.axes]),
            "each_axis": conjunctive(self.each_axis),
            "back": "|".join(f"exact (proj2 (within_is _ _) {name})" for name in self.each_axis),
            "point": conjunctive(["of_at", *self.proofs.split()]),
            "E": self.points,
            "H": self.proofs,
            "gaps": self.gaps,
            "sums": self.sums,
            "each_value": nested("of_i", len(self.guards)),
        }

    def fill(
        self, f: Frame, text: str, own: checker.Statement, more: dict[str, str], **rest: int
    ) -> str:
        """A template with these words."""
        words = {name: f.fill(part, own) for name, part in {**self.words, **more}.items()}
        return f.fill(text, own, count=len(self.guards), **rest, **words)


def values_of(f: Frame, own: checker.Statement) -> Iterator[str]:
    """Domain, point, the terms of the value with their guards, numbers, and nearness."""
    yield f.define(own, "domain", "Prop", *own.rows("domain"), of_state=False)
    yield f.define(own, "point", "State", *own.get("point")[0], of_state=False)
    values = ""
    for k, (_, (term,)) in enumerate(own.get("value"), 1):
        yield f.define(own, f"value_{k}", "R", term)
        values += f.fill(f"{k - 1}%nat => value_{k}$a | ", own)
    yield from f.guards(own, "value")
    yield (
        f"Definition values{f.bound} (of_i : nat) : State -> R :=\n"
        f"  match of_i with {values}_ => fun _ => 0 end."
    )
    for name in ("upper", "radius"):
        yield f.define(own, name, "R", *own.get(name), of_state=False)
    yield f.fill(
        f"Definition near{f.bound} : R -> State -> Prop :=\n"
        "  Lyapunov.close coordinate (fun of_j => coordinate of_j (point$a)).",
        own,
    )


def _reals(*names: str) -> str:
    """Variables of a definition beside parameters and state."""
    return f" ({' '.join(map(coq_name, names))} : R)"


def lyapunov_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The value, its least loss, and the set."""
    yield f"Module {LYAPUNOV}.\nImport States {f.words['M']}."
    yield from values_of(f, own)
    yield f.define(own, "on", "Prop", *own.get("on"))
    yield f.define(own, "loss", "R", *own.get("loss"), more=_reals("value"))
    both = _reals("distance", "level")
    yield f.define(own, "least", "R", *own.get("least"), of_state=False, more=both)
    bound = f"{f.bound} (of_s : State) : Prop"
    yield f.fill(f"Definition set{bound} := space$a of_s /\\ on$a of_s.", own)
    yield f"End {LYAPUNOV}."


def lyapunov_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is fixed, stable, and attracts the set.

    If the value is one term without a guard, premises are about it, else about all numbers that are
    at least the value.
    """
    around = PremisesAroundPoint(f, own, LYAPUNOV)
    is_plain = around.guards == [[]]
    value = f"({LYAPUNOV}.value_1$a of_s)" if is_plain else "of_v"
    loss = f"{LYAPUNOV}.loss$a of_s {value}"
    here = "".join(_at_least(k, bool(guard)) for k, guard in enumerate(around.guards, 1))
    heres = " ".join(f"of_here_{k}" for k in range(1, len(around.guards) + 1))
    known = "(Rle_ge _ _ of_1) (one_more _ of_1)"
    given = known if is_plain else f"{heres} {known}"
    own_value = texts.OWN_VALUE if is_plain else ""
    before = f"of_dom{around.proofs} {around.sums} of_there of_in"
    extra = "" if is_plain else " of_v"
    falls, small = [], []
    for k, guard in enumerate(around.guards, 1):
        rows = "{ assert (of_next := of_map_keeps$a $st of_map of_there$by).\n"
        rows += f"    {own_value}{here}"
        if is_plain:
            rows += f"apply Rle_trans with ({value} - {loss});\n      "
            rows += "[|exact (Rplus_le_compat_r _ _ _ of_own)].\n    "
        choice = "destruct {} as [of_no|of_le]; [destruct (of_no of_guard)|exact of_le]"
        rows += f.by_pieces(
            own,
            "falls",
            f"{before} {given} of_g of_next",
            value=f"_{k}",
            point=f"{around.points} {around.gaps}{extra}",
            places=" in of_next, of_guard |- *",
            case=choice if guard else "exact {}",
        )
        falls.append(rows + " }")
        small.append(
            f"apply (of_near_point_is$a _ _) in of_close; ${{opening}}"
            f"exact (${{P}}_small_{k}$a{around.points} {around.gaps} of_d of_dom{around.proofs}"
            f" {around.sums} of_there (Rle_ge _ _ of_1) of_close of_2{' of_here' if guard else ''})"
        )
    rules = f.of_kind(kinds.LYAPUNOV, own, LYAPUNOV)
    parts = f"({LYAPUNOV}.guards$a) ({LYAPUNOV}.values$a) {len(around.guards)}"
    losses = f"(fun of_s {'_' if is_plain else 'of_v'} => {loss}) ({LYAPUNOV}.least$a)"
    more = {
        "small": "|".join(small),
        "stays": f.by_pieces(
            own, "stays", f"{before} of_g of_next", point=f"{around.points} {around.gaps}"
        ),
        "here": here,
        "at_least": heres,
        "loss": loss,
        "own_value": own_value,
        "level": "apply (Rle_trans _ _ _ of_own) in of_4. " if is_plain else "",
        "v": extra,
        "given": f" {given}",
        "far": " \\/ ".join(f"({one} >= of_d \\/ {one} <= - of_d)" for one in around.apart),
        "each_far": "|".join(
            f"exact {_side('of_far', k, len(f.axes))}" for k in range(len(f.axes))
        ),
        "value": value.replace("of_s", f.tuple(f.state)) if len(f.state) > 1 else value,
        "reached": "(Rle_refl _)" if is_plain else heres,
        "falls": "\n    ".join(falls),
        "function": f"{rules['system']} ({LYAPUNOV}.set$a) {parts} {losses}"
        f"\n      ({LYAPUNOV}.upper$a) ({LYAPUNOV}.radius$a)",
        "attraction": f"{rules['orbits']} ({LYAPUNOV}.set$a) {parts} {losses}",
        **rules,
    }
    yield around.fill(f, texts.LYAPUNOV, own, more)


def _at_least(k: int, has_guard: bool) -> str:
    """Tactics that show that a number is at least the value, as premises assume."""
    least = f"{LYAPUNOV}.value_{k}$a of_s <= of_v"
    if not has_guard:
        return f"assert (of_here_{k} : {least}) by exact (of_high {k - 1}%nat ltac:(lia) I).\n    "
    return (
        f"assert (of_here_{k} : ~ {LYAPUNOV}.guard_{k}$a of_s \\/ {least}).\n"
        f"    {{ destruct ({LYAPUNOV}.decided_{k}$a of_s) as [of_g|of_g]; [right|left].\n"
        f"      exact (of_high {k - 1}%nat ltac:(lia) of_g). exact of_g. }}\n    "
    )


def _side(proof: str, k: int, count: int) -> str:
    """The proof of a disjunction from that of one of its parts."""
    side = proof if k == count - 1 else f"(or_introl {proof})"
    for _ in range(k):
        side = f"(or_intror {side})"
    return side


def instability_definitions(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The value, its rate of growth, and states as near the point as one likes."""
    yield f"Module {CHETAEV}.\nImport States Map."
    yield from values_of(f, own)
    yield f.define(own, "rate", "R", *own.get("rate"), of_state=False)
    terms = own.get("direction")[0]
    yield f.define(own, "direction", "State", *terms, of_state=False, more=_reals("distance"))
    yield f"End {CHETAEV}."


def instability_proofs(f: Frame, own: checker.Statement) -> Iterator[str]:
    """The point is not stable."""
    around = PremisesAroundPoint(f, own, CHETAEV)
    premise = checker.premises_of(own, f.known)["direction"]
    (line,) = (count for count, (key, _) in enumerate(premise.lines) if key == "have")
    later = disjunctive(["[of_h of_t]" if guard else "of_t" for guard in around.guards])
    found = []
    for k, guard in enumerate(around.guards):
        holds = "exact of_h" if guard else "exact I"
        found.append(f"exists {k}%nat; split; [lia|split; [{holds}|{{}}]]")
    starts = "|".join(found).format(*["exact of_t"] * len(found))
    grows = "|".join(found).format(*["exact (Rge_le _ _ of_t)"] * len(found))
    bounded, steps = [], []
    for k, guard in enumerate(around.guards, 1):
        given = f"of_dom{around.proofs} {around.sums} of_there of_close"
        given += " of_here of_1" if guard else " of_1"
        bounded.append(
            f"apply (of_near_centre_is$a _ _) in of_close; ${{opening}}"
            f"exact (${{P}}_bounded_{k}$a{around.points} {around.gaps} {given})"
        )
        by = f.by_pieces(
            own,
            "grows",
            f"{given} of_g of_next",
            value=f"_{k}",
            point=f"{around.points} {around.gaps}",
            case=f"pose proof {{}} as {later}; [{grows}]",
        )
        steps.append(
            "{ apply (of_near_centre_is$a _ _) in of_close.\n"
            f"    assert (of_next := of_map_keeps$a of_s of_map of_there).\n    {by} }}"
        )
    more = {
        "values": later,
        "starts": starts,
        "bounded": "|".join(bounded),
        "grows": "\n    ".join(steps),
    }
    yield around.fill(f, texts.UNSTABLE, own, more, line=line)
