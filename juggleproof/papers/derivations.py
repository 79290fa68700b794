"""Derived expressions as terms that carry their origin; and the derivations in `symbolic` that a
claim's statements contain: each with its sentence, its result, and the derivations that it uses.

SymPy is not loaded for results that `derived` keeps.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple, TypeVar, Union

from juggleproof.folders import PACKAGE
from juggleproof.papers.derived import derived_by, kept
from juggleproof.reading.values import Matrix, Vector
from juggleproof.statements.language import (
    AnyStatement,
    ClaimError,
    Formula,
    Term,
    origins_in,
    term,
)

Rows = tuple[tuple[str, ...], ...]
Derived = Union[Term, Vector, Matrix]
Made = TypeVar("Made", Term, Formula, Vector, Matrix, Derived)


class Origin(NamedTuple):
    """The origin of a term: the name of a function of `symbolic`, and its arguments."""

    function: str
    arguments: tuple[Hashable, ...] = ()


def from_deriving(function: str) -> str:
    """The full name of a function in the paper's module `deriving`, which loads SymPy.

    >>> from_deriving("margin")
    'juggleproof.proofs.deriving.margin'
    """
    return f"{PACKAGE}.deriving.{function}"


def derived(name: str, *arguments: Hashable) -> Term:
    """The term that a function of `symbolic` derives, with its origin.

    >>> str(derived("E_max")), derived("E_max").origins
    ('r^2*(alpha + 1)^2/(2*(alpha - 1)^2)', (Origin(function='E_max', arguments=()),))

    Raises ClaimError where the function returns a column or matrix.
    """
    value = derived_value(Origin(name, arguments))
    if not isinstance(value, Term):
        raise ClaimError(f"symbolic.{name} is no single expression")
    return value


def derived_vector(name: str, *arguments: Hashable) -> Vector:
    """The column that a function of `symbolic` derives; each entry has this origin.

    >>> derived_vector("launch_state")
    Vector(entries=(Term('0'), Term('r')))

    Raises ClaimError where the function returns anything else.
    """
    value = derived_value(Origin(name, arguments))
    if not isinstance(value, Vector):
        raise ClaimError(f"symbolic.{name} is no column")
    return value


def derived_matrix(name: str, *arguments: Hashable) -> Matrix:
    """The matrix that a function of `symbolic` derives; each entry has this origin.

    Raises ClaimError where the function returns anything else.
    """
    value = derived_value(Origin(name, arguments))
    if not isinstance(value, Matrix):
        raise ClaimError(f"symbolic.{name} is no matrix")
    return value


@cache
def derived_value(origin: Origin) -> Derived:
    """The term, column or matrix that the function of an origin derives."""
    value = kept().value(from_deriving("value"), origin.function, *origin.arguments)
    if not isinstance(value, (Term, Vector, Matrix)):
        raise ClaimError(f"symbolic.{origin.function} is no expression")
    return made_by(origin, value)


def made_by(origin: Origin, value: Made) -> Made:
    """The same term, formula, vector or matrix, with this origin added to each entry or side."""
    if isinstance(value, Term):
        return value.made_by(origin)
    if isinstance(value, Formula):
        if value.parts:
            return Formula(value.op, *(made_by(origin, part) for part in value.parts))
        return Formula(value.op, *(made_by(origin, side) for side in value.sides))
    if isinstance(value, Vector):
        return Vector(tuple(made_by(origin, term(entry)) for entry in value.entries))
    return Matrix(tuple(tuple(made_by(origin, term(one)) for one in row) for row in value.rows))


def tidied(name: str, **values: int) -> Vector:
    """A derived column in lowest terms, with numbers put for some of its symbols.

    >>> print(*tidied("e_1"))
    4*alpha*r^2/(g*(alpha + 1)^2) (alpha*r - r)/(alpha + 1)
    """
    column: Vector = made_by(
        Origin(name), derived_by(Vector, from_deriving("in_lowest_terms"), name, *values.items())
    )
    return column


def where_positive(name: str) -> Formula:
    """The formula that a derived margin is positive.

    >>> str(where_positive("normal_margin"))
    'x < w'
    """
    formula: Formula = made_by(Origin(name), derived_by(Formula, from_deriving("margin"), name))
    return formula


def sentence(name: str) -> str:
    """The first paragraph of the docstring of a function of `symbolic`, which says what it derives.

    >>> sentence("launch_state")
    'The table as it leaves the ground: r_0 = (0, r) (section 3.1).'
    """
    return derived_by(str, from_deriving("sentence"), name)


@dataclass(frozen=True)
class Derivation:
    """A derived expression: its origin, the first sentence of the function's docstring, its entries
    by rows, and the functions that it calls.
    """

    origin: Origin
    sentence: str
    rows: Rows
    uses: tuple[str, ...]

    @property
    def function(self) -> str:
        """The function with its arguments."""
        name, arguments = self.origin
        return name + (f"({', '.join(map(str, arguments))})" if arguments else "")

    def shown(self) -> Rows:
        """The entries in the paper's notation, where T stands for 2 r/g."""
        rows = derived_by(
            tuple, from_deriving("in_paper_form"), self.origin.function, *self.origin.arguments
        )
        return tuple(tuple(map(str, row)) for row in rows if isinstance(row, tuple))

    @property
    def line(self) -> str:
        """The derivation in one line, as `explain` prints it."""
        shown = "; ".join(
            "(" * (len(row) > 1) + ", ".join(row) + ")" * (len(row) > 1) for row in self.rows
        )
        return f"symbolic.{self.function.partition('(')[0]}: {self.sentence} {shown}"

    @property
    def title(self) -> str:
        """The sentence up to its colon, without formula and source."""
        arguments = ", ".join(
            " ".join(map(str, one)) if isinstance(one, tuple) else str(one)
            for one in self.origin.arguments
        )
        title = re.sub(
            r" \((section|equation|inequality|appendix|after|figure)[^()]*\)",
            "",
            self.sentence.partition(":")[0],
        ).rstrip(".")
        return title + (f", for {arguments}" if arguments else "")


@cache
def derivation(origin: Origin) -> Derivation:
    """The derivation of an origin, computed or taken from the stored results.

    >>> derivation(Origin("launch_state")).line
    'symbolic.launch_state: The table as it leaves the ground: r_0 = (0, r) (section 3.1). (0, r)'
    """
    name = origin.function
    uses = derived_by(tuple, from_deriving("made_from"), name)
    return Derivation(origin, sentence(name), rows_of(derived_value(origin)), tuple(map(str, uses)))


def rows_of(value: Derived) -> Rows:
    """The entries of a value as text, by rows; the entries of a column are one row.

    >>> rows_of(derived_vector("launch_state"))
    (('0', 'r'),)
    """
    if isinstance(value, Matrix):
        return tuple(tuple(str(term(one)) for one in row) for row in value.rows)
    return (
        tuple(str(term(one)) for one in (value.entries if isinstance(value, Vector) else [value])),
    )


def behind(derivations: Sequence[Derivation]) -> list[Derivation]:
    """The derivations and all that they use, directly or not, each after those that it uses.

    >>> [one.function for one in behind([derivation(Origin("total_energy"))])]
    ['acceleration', 'total_energy']
    """
    ordered: dict[str, Derivation] = {}

    def visit(one: Derivation) -> None:
        for name in one.uses:
            if name not in ordered:
                visit(derivation(Origin(name)))
        ordered.setdefault(one.function, one)

    for one in derivations:
        visit(one)
    return list(ordered.values())


def derivations_of(statements: Sequence[AnyStatement]) -> list[Derivation]:
    """The derived expressions that the statements contain, each once, in their order there.

    >>> from juggleproof.judging.forms import always
    >>> [one.function for one in derivations_of([always(derived("E_max") > 0)])]
    ['E_max']
    """
    origins = dict.fromkeys(origins_in([*statements]))
    return [derivation(one) for one in origins if isinstance(one, Origin)]
