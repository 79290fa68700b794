"""Derived expressions as terms that carry their origin; what a claim rests on in `symbolic`: each
derivation that its statements contain, with its sentence, its result, and what it is made from.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from types import CodeType
from typing import NamedTuple, TypeVar, Union

from sympy import Expr, ImmutableMatrix, MatrixBase

from juggleproof import symbolic
from juggleproof.certificates.language import (
    AnyStatement,
    ClaimError,
    Formula,
    Term,
    origins_in,
    real,
    term,
)
from juggleproof.proofs.encoding import from_sympy
from juggleproof.proofs.paper.paper_form import paper_form
from juggleproof.proofs.reading.values import Matrix, Vector

RESULTS = ("Expr", "State", "ImmutableMatrix", "Extremum", "tuple[Expr, Expr]", "tuple[Expr, ...]")
Rows = tuple[tuple[str, ...], ...]
Derived = Union[Term, Vector, Matrix]
Made = TypeVar("Made", Term, Formula, Vector, Matrix, Derived)


class Origin(NamedTuple):
    """What made a term: a function of `symbolic` by its name, and its arguments."""

    function: str
    arguments: tuple[Hashable, ...] = ()


def derived(name: str, *arguments: Hashable) -> Term:
    """A derived expression of `symbolic` by its function's name, as a term that says what made it.

    >>> str(derived("E_max")), derived("E_max").origins
    ('r^2*(alpha + 1)^2/(2*(alpha - 1)^2)', (Origin(function='E_max', arguments=()),))

    Raises ClaimError where the function comes to a column or matrix.
    """
    value = derived_value(Origin(name, arguments))
    if not isinstance(value, Term):
        raise ClaimError(f"symbolic.{name} is no single expression")
    return value


def derived_vector(name: str, *arguments: Hashable) -> Vector:
    """A derived column, each of whose entries says what made it.

    >>> derived_vector("launch_state")
    Vector(entries=(Term('0'), Term('r')))

    Raises ClaimError where the function comes to anything else.
    """
    value = derived_value(Origin(name, arguments))
    if not isinstance(value, Vector):
        raise ClaimError(f"symbolic.{name} is no column")
    return value


def derived_matrix(name: str, *arguments: Hashable) -> Matrix:
    """A derived matrix, each of whose entries says what made it.

    Raises ClaimError where the function comes to anything else.
    """
    value = derived_value(Origin(name, arguments))
    if not isinstance(value, Matrix):
        raise ClaimError(f"symbolic.{name} is no matrix")
    return value


@cache
def derived_value(origin: Origin) -> Derived:
    """What the function of an origin derives, whatever it is."""
    return made_by(origin, encoded(_result(origin)))


def _result(origin: Origin) -> Expr | MatrixBase:
    """The value of the function; several expressions as a column, and an extremum as the state to
    which it belongs.
    """
    value = getattr(symbolic, origin.function)(*origin.arguments)
    if hasattr(value, "attained"):
        return value.state
    return ImmutableMatrix(value) if isinstance(value, tuple) else value


def made_by(origin: Origin, value: Made) -> Made:
    """The same term, formula, vector or matrix, each of whose entries or sides says that this made
    it.
    """
    if isinstance(value, Term):
        return value.made_by(origin)
    if isinstance(value, Formula):
        if value.parts:
            return Formula(value.op, *(made_by(origin, part) for part in value.parts))
        return Formula(value.op, *(made_by(origin, side) for side in value.sides))
    if isinstance(value, Vector):
        return Vector(tuple(made_by(origin, term(entry)) for entry in value.entries))
    return Matrix(tuple(tuple(made_by(origin, term(one)) for one in row) for row in value.rows))


def encoded(value: Expr | MatrixBase) -> Derived:
    """A SymPy expression, column or matrix in the values of the reader; the square root of 2 + 2
    alpha is named s.

    Raises ClaimError for floats, functions and other roots.
    """
    if isinstance(value, MatrixBase):
        if value.shape[1] == 1:
            return Vector(tuple(_term(entry) for entry in value))
        return Matrix(
            tuple(
                tuple(_term(value[i, j]) for j in range(value.shape[1]))
                for i in range(value.shape[0])
            )
        )
    return _term(value)


def _term(expression: Expr) -> Term:
    s = real("s")
    return from_sympy(
        expression, {2 * symbolic.alpha + 2: s, symbolic.alpha / 2 + symbolic.alpha**0 / 2: s / 2}
    )


@dataclass(frozen=True)
class Derivation:
    """A derived expression: the function of `symbolic` with its arguments, its docstring's first
    sentence, its entries, what it calls.
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

    @cached_property
    def shown(self) -> Rows:
        """The entries in the paper's manner, where T stands for 2 r/g."""
        return _rows(_result(self.origin), paper_form)

    @property
    def line(self) -> str:
        """The derivation in one line, as `explain` prints it."""
        shown = "; ".join(
            "(" * (len(row) > 1) + ", ".join(row) + ")" * (len(row) > 1) for row in self.rows
        )
        return f"symbolic.{self.function.partition('(')[0]}: {self.sentence} {shown}"

    @property
    def title(self) -> str:
        """What is derived, in words: the sentence up to its colon, without formula or source."""
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
    """The derivation behind an origin, worked out.

    >>> derivation(Origin("launch_state")).line
    'symbolic.launch_state: The table as it leaves the ground: r_0 = (0, r) (section 3.1). (0, r)'
    """
    name = origin.function
    summary = (inspect.getdoc(getattr(symbolic, name)) or "").partition("\n\n")[0]
    sentence = " ".join(summary.split())
    return Derivation(origin, sentence, _rows(_result(origin), _term), made_from(name))


def _rows(value: Expr | MatrixBase, written: Callable[[Expr], Term]) -> Rows:
    """The entries of a value as text, in rows; those of a column in one."""
    entries = list(value) if isinstance(value, MatrixBase) else [value]  # by rows
    width = value.shape[1] if isinstance(value, MatrixBase) and value.shape[1] > 1 else len(entries)
    texts = tuple(str(written(one)) for one in entries)
    return tuple(texts[start : start + width] for start in range(0, len(texts), width))


@cache
def made_from(name: str) -> tuple[str, ...]:
    """The derivations that this one calls, itself or through functions that have to be given
    arguments, in the order of its code.

    >>> made_from("E_max")
    ('largest_kept_energy',)
    >>> made_from("total_energy")
    ('acceleration',)
    """
    return tuple(dict.fromkeys(_called(getattr(symbolic, name), {name})))


def _called(function: Callable[..., object], seen: set[str]) -> Iterator[str]:
    plain = inspect.unwrap(function)
    for name in _names_in(plain.__code__):
        called = plain.__globals__.get(name)
        if (
            name in seen
            or not callable(called)
            or not getattr(called, "__module__", "").startswith("juggleproof.symbolic.")
            or inspect.isclass(called)
        ):
            continue
        seen.add(name)
        if _is_derivation(called, name):
            yield name
        else:
            yield from _called(called, seen)


def _names_in(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for inner in code.co_consts:  # comprehensions and inner functions
        if isinstance(inner, CodeType):
            yield from _names_in(inner)


def _is_derivation(function: Callable[..., object], name: str) -> bool:
    """Whether it can be worked out as it is, and what it comes to has rows."""
    parameters = inspect.signature(function).parameters.values()
    if name not in dir(symbolic) or any(one.default is one.empty for one in parameters):
        return False
    return inspect.unwrap(function).__annotations__.get("return") in RESULTS


def behind(derivations: Sequence[Derivation]) -> list[Derivation]:
    """All that the derivations are made from, themselves included, each after what it is made from.

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
    """The derived expressions that the statements contain, each once, in the order in which they
    stand there.

    >>> from juggleproof.proofs.forms import always
    >>> [one.function for one in derivations_of([always(derived("E_max") > 0)])]
    ['E_max']
    """
    origins = dict.fromkeys(origins_in([*statements]))
    return [derivation(one) for one in origins if isinstance(one, Origin)]
