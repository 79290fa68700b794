"""The definitions of the theorem, printed for Coq from its data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from certificates import checker
from certificates.terms import ClaimError
from proofs.theorem.coq_table import Piece
from proofs.theorem.coq_text import ATOM, coq_formula, coq_term, names_in, term_of

Lets = Sequence[tuple[str, str]]


@dataclass(frozen=True)
class Scope:
    """What a definition may speak of: parameters, the two coordinates of a state, and names for
    terms.
    """

    parameters: tuple[str, ...]
    state: tuple[str, ...] = ()
    names: tuple[tuple[str, str], ...] = ()

    def heading(self, *texts: str) -> tuple[str, str]:
        """The arguments and the `let` lines that texts need, of those that the scope has."""
        used = set().union(*map(names_in, texts))
        lets: list[str] = []
        for name, value in reversed(self.names):
            if name in used:
                used |= names_in(value)
                lets.insert(0, f"let {name} := {coq_value(value)} in ")
        entries = [
            f"let {name} := {part} s in "
            for name, part in zip(self.state, ("fst", "snd"))
            if name in used
        ]
        unknown = used - {*self.parameters, *self.state, *dict(self.names)}
        if unknown:
            raise ClaimError(f"{', '.join(sorted(unknown))}: not known in {texts}")
        arguments = [f"({name} : R)" for name in self.parameters if name in used]
        return " ".join([*arguments, *(["(s : R * R)"] if self.state else [])]), "".join(
            entries + lets
        ) + ("\n  " if entries + lets else "")

    def applied(self, name: str, *texts: str) -> str:
        """The definition applied to the parameters that its texts need: what is left is a function
        of the state.
        """
        heading, _ = self.heading(*texts)
        used = [p for p in self.parameters if f"({p} : R)" in heading]
        return f"({name} {' '.join(used)})" if used else name

    def defined(self, name: str, returns: str, body: str, *texts: str) -> str:
        """One definition whose body is made of the texts."""
        heading, lets = self.heading(*texts)
        return f"Definition {name} {heading}{' ' if heading else ''}: {returns} :=\n  {lets}{body}."


def coq_value(text: str) -> str:
    """The Coq term of a text, in which sqrt(..) may stand alone."""
    if text.startswith("sqrt(") and text.endswith(")"):
        return f"sqrt ({coq_term(text[5:-1])})"
    return coq_term(text)


def predicate(scope: Scope, name: str, text: str) -> str:
    """A set of states."""
    return scope.defined(name, "Prop", coq_formula(text), text)


def number(scope: Scope, name: str, text: str) -> str:
    """A number that depends on parameters and state."""
    return scope.defined(name, "R", coq_value(text), text)


def pair(scope: Scope, name: str, texts: Sequence[str]) -> str:
    """A state, or the image of a state."""
    first, second = texts
    return scope.defined(name, "R * R", f"({coq_term(first)}, {coq_term(second)})", *texts)


def piecewise(scope: Scope, name: str, pieces: Sequence[Piece]) -> str:
    """A map of two pieces: that of the first where its strict inequality holds, that of the second
    elsewhere.
    """
    first, second = pieces
    left, sign, right = first.region.partition(" < ")
    if not sign or any(mark in left + right for mark in "<>="):
        raise ClaimError(f"{first.region} is not one strict inequality")
    images = ["(" + ", ".join(map(coq_term, piece.images)) + ")" for piece in pieces]
    sides = " ".join(term_of(checker.parse(side), ATOM) for side in (left, right))
    body = f"if Rlt_dec {sides}\n  then {images[0]}\n  else {images[1]}"
    return scope.defined(name, "R * R", body, left, right, *first.images, *second.images)
