"""Statements built from terms and formulas, and written as the text that the checker reads and an
auditor can read.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Union

from certificates import checker
from certificates.terms import Formula, Number, Term, conjunction, names_in, term

Line = tuple[str, Union[Formula, tuple[str, Term]]]


@dataclass(frozen=True)
class Statement:
    """For all `forall`: the lines (range, given, have, let, root) imply `show`, or that some
    `exists` meet `within` and `show`.

    >>> from certificates.terms import reals
    >>> x, y = reals("x y")
    >>> print(Statement("demo/square", ("x",), (("given", x > 1),), show=x**2 > x).text())
    statement demo/square
    forall x
    given x > 1
    show x^2 > x
    """

    name: str
    forall: tuple[str, ...] = ()
    lines: tuple[Line, ...] = ()
    show: Formula = field(default_factory=lambda: conjunction([]))
    integer: tuple[str, ...] = ()
    exists: tuple[str, ...] = ()
    within: tuple[Line, ...] = ()

    def text(self) -> str:
        """The statement, one line for each keyword, in the order that the checker asks for."""
        rows = [f"statement {self.name}"]
        rows += ["forall " + " ".join(self.forall)] if self.forall else []
        rows += ["integer " + " ".join(self.integer)] if self.integer else []
        rows += [_line(line) for line in self.lines]
        rows += ["exists " + " ".join(self.exists)] if self.exists else []
        rows += [_line(line) for line in self.within]
        return "\n".join([*rows, f"show {self.show}"])

    def named(self, name: str) -> Statement:
        """The same statement under another name."""
        return replace(self, name=name)

    def undeclared(self) -> set[str]:
        """Names that occur and are declared nowhere."""
        declared, loose = {*self.forall, *self.exists}, set()
        for _, said in (*self.lines, *self.within, ("show", self.show)):
            if isinstance(said, tuple):
                loose |= names_in(said[1]) - declared
                declared.add(said[0])
            else:
                loose |= names_in(said) - declared
        return loose


@dataclass(frozen=True)
class SharpRange:
    """For all `over` in the domain: all the statements named hold <=> the condition holds.

    `numbers` names algebraic end points: (name, polynomial, low, high), exactly one root in
    between.
    """

    name: str
    of: tuple[str, ...]
    over: tuple[str, ...]
    domain: Formula
    condition: Formula
    numbers: tuple[tuple[str, Term, Number, Number], ...] = ()

    def text(self) -> str:
        """The sharp range as the checker reads it."""
        rows = [
            f"statement {self.name}",
            "sharp " + " ".join(self.of),
            "over " + " ".join(self.over),
            f"domain {self.domain}",
        ]
        rows += [
            f"number {name} = root({poly}, {term(low)}, {term(high)})"
            for name, poly, low, high in self.numbers
        ]
        return "\n".join([*rows, f"holds {self.condition}"])


@dataclass(frozen=True)
class Iterates:
    """For every integer K >= 0, the K-th iterate of the map state -> images is the map state ->
    powers.
    """

    name: str
    state: tuple[str, ...]
    images: tuple[Term, ...]
    count: str
    powers: tuple[Term, ...]
    parameters: tuple[str, ...] = ()

    def text(self) -> str:
        """The recurrence as the checker reads it."""

        def tuple_of(terms: Iterable[object]) -> str:
            return "(" + ", ".join(map(str, terms)) + ("" if len(self.state) > 1 else ",") + ")"

        return "\n".join(
            [
                f"statement {self.name}",
                "forall " + " ".join([*self.state, *self.parameters, self.count]),
                f"integer {self.count}",
                f"iterates {tuple_of(self.state)} -> {tuple_of(self.images)}",
                f"after {self.count} -> {tuple_of(self.powers)}",
            ]
        )


@dataclass(frozen=True)
class MapRule:
    """What holds of every orbit of a map, by a rule of the checker that writes its own premises:
    the lines as (keyword, text).

    >>> over = (("over", "a"), ("domain", "a > 0"))
    >>> map = (("state", "x"), ("space", "x >= 0"), ("piece", "x >= 0 -> x/2"))
    >>> print(MapRule("demo/halves", over + map).text())
    statement demo/halves
    over a
    domain a > 0
    state x
    space x >= 0
    piece x >= 0 -> x/2
    """

    name: str
    rows: tuple[tuple[str, str], ...]

    def text(self) -> str:
        """The statement as the checker reads it."""
        return "\n".join(
            [f"statement {self.name}", *(f"{keyword} {said}" for keyword, said in self.rows)]
        )


RESTING = (
    "attraction",
    "escape",
    "descent",
    "contraction",
    "map",
)  # the lines that name an earlier statement


def rests_on(statement: checker.Statement) -> list[str]:
    """The map rules that a parsed map rule names."""
    return [said for keyword, said in statement.lines if keyword in RESTING]


AnyStatement = Union[Statement, SharpRange, Iterates, MapRule]


def _line(line: Line) -> str:
    keyword, said = line
    if isinstance(said, Formula):
        return f"{keyword} {said}"
    name, value = said
    return f"{keyword} {name} = " + (f"sqrt({value})" if keyword == "root" else str(value))
