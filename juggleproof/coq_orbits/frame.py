"""The words by which a file of Coq names the parts of its map or relation."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from string import Template

from juggleproof.certificates import checker
from juggleproof.coq_orbits import kinds
from juggleproof.coq_orbits.readings import reading_name
from juggleproof.coq_orbits.terms import coq_formula, coq_term, names_in, names_of, term_of
from juggleproof.coq_store.branch import Known
from juggleproof.coq_store.text import conjunctive, coq_name, disjunctive


def theorem_name(name: str) -> str:
    """The name of the theorem for a statement."""
    return "theorem_" + re.sub(r"\W", "_", name)


class Frame:
    """The words by which a file names the parameters, state and inputs of its map or relation,
    bound and applied.  kind: "map" or "relation", since a map may be taken for a relation.

    An integer parameter is bound in type Z; terms begin with a `let` that makes it a real number.
    """

    def __init__(self, own: checker.Statement, known: Known, kind: str) -> None:
        (parameters,), (state,) = own.get("over"), own.get("state")
        self.known = known
        self.kind = kind
        self.names = state
        self.integers = [name for line in own.get("integer") for name in line]
        self.state = [*map(coq_name, state)]
        self.axes = [f"States.axis_{name}" for name in state]
        self.pieces = range(1, len(own.get("piece")) + 1)
        self.inputs = [coq_name(name) for line in own.get("input") for name in line]
        names, binders = "".join(f" {coq_name(name)}" for name in parameters), []
        for is_integer, group in groupby(parameters, self.integers.__contains__):
            binders.append(f"{' '.join(map(coq_name, group))} : {'Z' if is_integer else 'R'}")
        self.bound = "".join(f" ({one})" for one in binders)
        self.pattern = f"({self.state[0]} : State)"
        if len(state) > 1:
            self.pattern = f"'({self.tuple(self.state)} : State)"
        self.words = {
            **{
                word: Template(text).substitute(a=names) for word, text in kinds.WORDS[kind].items()
            },
            "a": names,
            "all": f"forall{self.bound if len(binders) > 1 else f' {binders[0]}'}, "
            if binders
            else "",
            "open": opened("of_s", self.state),
            "opening": opened("of_s", self.state).replace(". ", "; "),
            "s": " ".join(self.state) if len(state) > 1 else "of_s",
        }

    def tuple(self, terms: Sequence[str]) -> str:
        """A state with these coordinates."""
        return terms[0] if len(terms) == 1 else f"({', '.join(terms)})"

    def fill(self, text: str, own: checker.Statement, **more: str | int) -> str:
        """A template with the words of the file, of a statement, and more."""
        prefix, name = reading_name(own.name), theorem_name(own.name)
        return Template(text).substitute({**self.words, "P": prefix, "theorem": name, **more})

    def of_kind(
        self,
        parts: Mapping[str, Mapping[str, str]],
        own: checker.Statement,
        around: str = "",
        **more: str,
    ) -> dict[str, str]:
        """The texts that differ between a map and a relation, around the point of a module; and the
        text that this point is fixed.
        """
        words = {"around": around, "e": self.fill(kinds.POINT, own, around=around), **more}
        texts = {"is_fixed": kinds.FIXED[self.kind], **parts[self.kind]}
        return {
            "around": around,
            **{word: self.fill(text, own, **words) for word, text in texts.items()},
        }

    def define(
        self,
        own: checker.Statement,
        name: str,
        returns: str,
        *parts: str,
        of_state: bool = True,
        more: str = "",
    ) -> str:
        """A definition over the parameters, a state and more variables, by texts of a statement.
        Several texts are the coordinates of a state.
        """
        state = (f" {self.pattern}" if of_state else "") + more
        write = coq_formula if returns == "Prop" else coq_term
        body = self.lets(own, parts) + self.tuple([write(part) for part in parts])
        return f"Definition {name}{self.bound}{state} : {returns} :=\n  {body}."

    def lets(self, own: checker.Statement, parts: Sequence[str]) -> str:
        """The names in texts other than real parameters and the state, in order, as `let` of Coq:
        integers as real numbers, roots, and around a point its coordinates and the gaps to them.
        """
        entries = [
            (name, f"sqrt ({term_of(under, 0)})", under) for name, (under,) in own.get("root")
        ]
        if own.get("value"):
            moving, fixed = (
                {*self.names},
                0,
            )  # roots of parameters, which a point may name, are first
            for name, _, under in entries:
                if names_of(under) & moving:
                    moving.add(name)
                else:
                    fixed += 1
            entries.sort(key=lambda entry: entry[0] in moving)
            sums = [(f"{name}_gap", f"{name} - {name}_point") for name in self.names]
            point = zip((f"{name}_point" for name in self.names), own.get("point")[0])
            entries[fixed:fixed] = [
                (name, coq_term(text), checker.parse(text)) for name, text in [*point, *sums]
            ]
        used = set().union(*map(names_in, parts))
        rows = ""
        for name, value, node in reversed(entries):
            if name in used:
                used |= names_of(node)
                rows = f"let {coq_name(name)} := {value} in " + rows
        whole = [coq_name(name) for name in self.integers if name in used]
        return "".join(f"let {name} := IZR {name} in " for name in whole) + rows

    def by_pieces(
        self,
        own: checker.Statement,
        premise: str,
        known: str,
        value: str = "",
        point: str = "$s",
        places: str = " in of_next |- *",
        case: str = "exact {}",
    ) -> str:
        """Tactics that show a property of the next state by one premise for each piece; value: the
        end of the premise's name, for a term of the value; known: proofs of what it assumes; point:
        the coordinates; places: where the next state occurs.
        """
        before = "".join(f"{name} " for name in self.inputs)
        cases = "|".join(
            case.format(f"(${{P}}_{premise}_{k}{value}$a {point} {before}{known})")
            for k in self.pieces
        )
        moves = "(of_map_moves$a of_s of_map of_there)" if self.kind == "map" else "of_moves"
        return self.fill(
            f"destruct {moves} as {self.one_piece()};\n"
            f"    rewrite of_same{places}; clear of_same; ${{opening}}[{cases}].",
            own,
        )

    def decided(self, own: checker.Statement, k: int) -> str:
        """The lemma that a guard holds or does not."""
        bound, decided = f"{self.bound} (of_s : State)", "{guard_$k$a of_s} + {~ guard_$k$a of_s}"
        return self.fill(
            f"Lemma decided_$k{bound} : {decided}.\n"
            "Proof. ${open}cbv beta iota zeta delta [guard_$k]. decidable. Qed.",
            own,
            k=k,
        )

    def guards(self, own: checker.Statement, keyword: str) -> Iterator[str]:
        """The guards of the lines with this keyword, as a function of the number of a line from 0
        on; it is false for other numbers.
        """
        cases = ""
        for k, (guard, _) in enumerate(own.get(keyword), 1):
            if guard:
                yield self.define(own, f"guard_{k}", "Prop", *guard)
                yield self.decided(own, k)
            each = f"guard_{k}$a" if guard else "fun _ => True"
            cases += self.fill(f"{k - 1}%nat => {each} | ", own)
        yield (
            f"Definition guards{self.bound} (of_i : nat) : State -> Prop :=\n"
            f"  match of_i with {cases}_ => fun _ => False end."
        )

    def one_piece(self) -> str:
        """The pattern for the piece whose guard holds, and for its image."""
        return disjunctive([conjunctive([*self.inputs, "of_g", "of_same"])] * len(self.pieces))

    def extra_steps(self, descent: checker.Statement) -> int:
        """The steps from the first stage to the last."""
        return len(descent.get("stage")) - 1


def opened(state: str, names: Sequence[str]) -> str:
    """The tactic that takes a state apart, if it has several coordinates."""
    pattern = names[0]
    for name in names[1:]:
        pattern = f"[{pattern} {name}]"
    return f"destruct {state} as {pattern}. " if len(names) > 1 else ""


def equal_states(proofs: Sequence[str]) -> str:
    """A proof that states are equal, from proofs that their coordinates are."""
    proof = proofs[0]
    for one in proofs[1:]:
        proof = f"(f_equal2 pair {proof} {one})"
    return proof


def nested(last: str, count: int) -> str:
    """The pattern for a natural number that is one of the first `count`, or more."""
    for _ in range(count):
        last = f"[|{last}]"
    return last
