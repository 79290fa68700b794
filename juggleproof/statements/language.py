"""Statements built from terms and formulas, and written as the text that the checker reads and an
auditor can read.
"""

from __future__ import annotations

import sys
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Union

from juggleproof.certificates import checker
from juggleproof.statements.formulas import (
    NAME,
    RELATIONS,
    RESERVED,
    ClaimError,
    Expression,
    Formula,
    Number,
    Term,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    implies,
    names_in,
    real,
    reals,
    substitute,
    term,
)

# the whole language, with the terms and formulas that statements are built from
# fmt: off
__all__ = [
    "NAME", "NO_ROLES", "RELATIONS", "RESERVED", "AnyStatement", "ClaimError", "End", "Formula",
    "Iterates", "Line", "MapRule", "Number", "Roles", "SharpRange", "Statement", "Term",
    "bounds_of", "conjunction", "different", "disjunction", "equal", "iff", "implies",
    "interval_text", "lemmas_of", "names_in", "origins_in", "real", "reals", "rests_on",
    "substitute", "term",
]
# fmt: on

Line = tuple[str, Union[Formula, tuple[str, Term]]]


@dataclass(frozen=True)
class Roles:
    """The roles of variables, which the text of statements does not say: parameters and scales.

    `domains` gives each parameter the assumptions on it alone; sharp ranges are sought there, over
    the first parameter unless others are asked for. `scales` are positive variables that a change
    of units makes 1; where it is None, homogeneity decides. Searches take both as hints; the
    checker sees neither.
    """

    domains: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    scales: frozenset[str] | None = None

    @property
    def parameter(self) -> str:
        """The first parameter; an empty name where there is none."""
        return next(iter(self.domains), "")

    def is_scale(self, name: str) -> bool:
        """Whether `scales` names the variable."""
        return self.scales is not None and name in self.scales


NO_ROLES = Roles()


@dataclass(frozen=True)
class Statement:
    """A statement: for all values of `forall`, the lines (range, given, have, let, root) imply
    `show`, or that some values of `exists` meet `within` and `show`.

    >>> from juggleproof.statements.language import reals
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
        """The names that occur but are not declared."""
        declared, loose = {*self.forall, *self.exists}, set()
        for _, content in (*self.lines, *self.within, ("show", self.show)):
            if isinstance(content, tuple):
                name, value = content
                loose |= names_in(value) - declared
                declared.add(name)
            else:
                loose |= names_in(content) - declared
        return loose


@dataclass(frozen=True)
class SharpRange:
    """A sharp range: for all `over` in the domain, the statements `of` hold <=> `condition` holds.

    `numbers` names algebraic end points: (name, polynomial, low, high), where the polynomial has
    exactly one root between low and high.
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
    """A recurrence: for every integer K >= 0, the K-th iterate of the map state -> images is the
    map state -> powers.
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
    """A statement on all orbits of a map, whose premises the checker generates by one of its rules.

    `rows` are its lines (keyword, text), `made_of` the terms and formulas in them, `place` the file
    and line of the call that made it.  A row ("lemma", "PREMISE: FORMULA") is for the search alone,
    which proves the formula first, and uses it in the proof of the premise.

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
    made_of: tuple[Term | Formula, ...] = field(default=(), compare=False)
    place: tuple[str, int] | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if self.place is None:
            caller = sys._getframe(2)  # the caller of the dataclass's __init__
            object.__setattr__(self, "place", (caller.f_code.co_filename, caller.f_lineno))

    def text(self) -> str:
        """The statement as the checker reads it."""
        return "\n".join(
            [f"statement {self.name}", *(f"{keyword} {text}" for keyword, text in self.lines)]
        )

    @property
    def lines(self) -> list[tuple[str, str]]:
        """The lines without lemmas."""
        return [row for row in self.rows if row[0] != "lemma"]

    @property
    def lemmas(self) -> dict[str, list[str]]:
        """The formulas of the lemmas, by premise."""
        found: dict[str, list[str]] = {}
        for keyword, text in self.rows:
            if keyword == "lemma":
                premise, _, formula = text.partition(":")
                found.setdefault(premise.strip(), []).append(formula.strip())
        return found


RESTING = tuple(checker.NAMED)  # the lines that name an earlier statement


def rests_on(statement: checker.Statement) -> list[str]:
    """The map rules that a parsed map rule names."""
    return [name for keyword, name in statement.lines if keyword in RESTING]


def lemmas_of(certificate: object) -> set[str]:
    """The earlier statements that a certificate uses."""
    if isinstance(certificate, Mapping):
        return set().union(*map(lemmas_of, certificate.values()))
    if not isinstance(certificate, (list, tuple)):
        return set()
    own = {certificate[1]} if len(certificate) == 5 and certificate[0] == "use" else set()
    return own.union(*map(lemmas_of, certificate))


AnyStatement = Union[Statement, SharpRange, Iterates, MapRule]


def _line(line: Line) -> str:
    keyword, content = line
    if isinstance(content, Formula):
        return f"{keyword} {content}"
    name, value = content
    return f"{keyword} {name} = " + (f"sqrt({value})" if keyword == "root" else str(value))


def origins_in(*things: object) -> Iterator[Hashable]:
    """The origins of all terms in these terms, formulas, statements and sequences, from the outside
    in and from left to right; the origin of several terms is repeated.

    >>> x, w = reals("x w")
    >>> list(origins_in([x < w.made_by("f"), x**2]))
    ['f']
    """
    for thing in things:
        if isinstance(thing, Term):
            yield from thing.origins
        if isinstance(thing, Expression):
            yield from origins_in(*thing.args)
        elif isinstance(thing, Statement):
            yield from origins_in(thing.lines, thing.within, thing.show)
        elif isinstance(thing, Iterates):
            yield from origins_in(thing.images, thing.powers)
        elif isinstance(thing, MapRule):
            yield from origins_in(thing.made_of)
        elif isinstance(thing, (tuple, list)):
            yield from origins_in(*thing)


# -------------------------------------------------------------------------------------------------
# The interval that is given by conditions on one variable.

End = tuple[str, str]  # a rational, and < or <=


def bounds_of(condition: str, name: str) -> tuple[End | None, End | None] | None:
    """The lower and the upper end of the interval that is given by the conditions on this variable
    alone.  None stands for a missing end, and for the whole result where a condition is not linear,
    or is a disjunction.

    >>> bounds_of("3*a >= 1 and a < 1 and g > 0", "a")
    (('1/3', '<='), ('1', '<'))
    >>> bounds_of("a > 2", "a")
    (('2', '<'), None)
    """
    context = checker.Context()
    for each in sorted(checker.names_in(condition)):
        context.declare(each)
    lows: list[tuple[Fraction, bool]] = []
    highs: list[tuple[Fraction, bool]] = []
    for part in checker.conjuncts(context.formula(checker.parse(condition))):
        if isinstance(part, bool) or part[0] != "atom":
            return None
        _, poly, relation = part
        if checker.variables_of(context, poly) == {name}:
            coefficients = checker.univariate(context, poly, name)
            if len(coefficients) != 2 or relation == "!=":
                return None
            constant, slope = coefficients
            end = Fraction(-constant, slope)
            if slope > 0 or relation == "=":
                lows.append((end, relation == ">"))
            if slope < 0 or relation == "=":
                highs.append((end, relation != ">"))
    low, high = max(lows, default=None), min(highs, default=None)
    return (
        (str(low[0]), "<" if low[1] else "<=") if low else None,
        (str(high[0]), "<=" if high[1] else "<") if high else None,
    )


def interval_text(name: str, low: End | None, high: End | None) -> str:
    """The interval as a person reads it.

    >>> interval_text("a", ("0", "<"), ("1/3", "<=")), interval_text("a", ("2", "<"), None)
    ('0 < a <= 1/3', 'a > 2')
    """
    if low and high:
        return (
            f"{name} = {low[0]}"
            if low[0] == high[0]
            else f"{low[0]} {low[1]} {name} {high[1]} {high[0]}"
        )
    if low:
        return f"{name} {'>' if low[1] == '<' else '>='} {low[0]}"
    return f"{name} {high[1]} {high[0]}" if high else f"every {name}"
