"""Terms and formulas: exact rational expressions and relations, written out as the text that the
checker reads.

No floats: a `float` anywhere raises `ClaimError`.  `==` compares structure; a claimed equality is
`equal(a, b)`.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Hashable, Iterable, Mapping
from fractions import Fraction
from typing import TypeVar, Union, overload

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z")
RESERVED = frozenset({"implies", "iff", "sqrt", "root", *keyword.kwlist})
Number = Union[int, Fraction, "Term"]


class ClaimError(ValueError):
    """A claim cannot be stated as written; the message is one line that says what is wrong and how
    to mend it.
    """


class Expression:
    """An operation and its arguments: an immutable term or formula.

    `args` of a term: the name of a variable ("var"), the value of a number ("num"), the text of a
    definition applied ("call"), (base, exponent) for "^", else terms.  Of a formula: the two sides
    of a relation, the text of a "call", else formulas.
    """

    __slots__ = ("op", "args", "_hash", "_names")

    def __init__(self, op: str, *args: Argument) -> None:
        self.op, self.args = op, args
        self._hash = hash((op, args))
        self._names: frozenset[str] | None = None

    def _argument(self, kind: type[Kind]) -> Kind:
        """The first argument of this type; raises TypeError where there is none."""
        for part in self.args:
            if isinstance(part, kind):
                return part
        raise TypeError(f"{self!r} has no argument that is a {kind.__name__}")

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, type(self))
            and self._hash == other._hash
            and (self.op, self.args) == (other.op, other.args)
        )

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"


Argument = Union[Expression, Fraction, int, str]
Kind = TypeVar("Kind", Fraction, int, str)


class Term(Expression):
    """A rational expression over named reals, kept as it was written.

    `origins` are the derivations that made it; they are no part of equality or hash.

    >>> x, w = reals("x w")
    >>> str((x - w) / 2 + x**2 * Fraction(1, 3))
    '(x - w)/2 + x^2*(1/3)'
    """

    __slots__ = ("origins",)

    def __init__(self, op: str, *args: Argument, origins: tuple[Hashable, ...] = ()) -> None:
        super().__init__(op, *args)
        self.origins = origins

    @property
    def name(self) -> str:
        """The name of a variable; raises TypeError for a number or an operation."""
        return self._argument(str)

    @property
    def value(self) -> Fraction:
        """The value of a number; raises TypeError for any other term."""
        return self._argument(Fraction)

    @property
    def exponent(self) -> int:
        """The exponent of a power; raises TypeError for any other term."""
        return self._argument(int)

    @property
    def operands(self) -> tuple[Term, ...]:
        """The terms that the operation is applied to, from left to right.

        >>> x, w = reals("x w")
        >>> [str(part) for part in (x**2 - w).operands]
        ['x^2', 'w']
        """
        return tuple(part for part in self.args if isinstance(part, Term))

    def made_by(self, *origins: Hashable) -> Term:
        """The same term with these origins added.

        >>> real("x").made_by("f").origins, real("x").made_by("f") == real("x")
        (('f',), True)
        """
        joined = tuple(dict.fromkeys((*self.origins, *origins)))
        return self if joined == self.origins else Term(self.op, *self.args, origins=joined)

    # the cached hash is left out: hashes of strings differ between processes
    def __reduce__(self) -> tuple[type[Term], tuple[Argument, ...], tuple[None, dict[str, object]]]:
        return Term, (self.op, *self.args), (None, {"origins": self.origins})

    def __bool__(self) -> bool:
        raise ClaimError(
            "a term has no truth value; compare it with <, <=, >, >=, equal() or different()"
        )

    def __add__(self, other: Number) -> Term:
        return Term("+", self, term(other)) if _is_operand(other) else NotImplemented

    def __radd__(self, other: Number) -> Term:
        return Term("+", term(other), self) if _is_operand(other) else NotImplemented

    def __sub__(self, other: Number) -> Term:
        return Term("-", self, term(other)) if _is_operand(other) else NotImplemented

    def __rsub__(self, other: Number) -> Term:
        return Term("-", term(other), self) if _is_operand(other) else NotImplemented

    def __mul__(self, other: Number) -> Term:
        return Term("*", self, term(other)) if _is_operand(other) else NotImplemented

    def __rmul__(self, other: Number) -> Term:
        return Term("*", term(other), self) if _is_operand(other) else NotImplemented

    def __truediv__(self, other: Number) -> Term:
        return Term("/", self, term(other)) if _is_operand(other) else NotImplemented

    def __rtruediv__(self, other: Number) -> Term:
        return Term("/", term(other), self) if _is_operand(other) else NotImplemented

    def __neg__(self) -> Term:
        return Term("neg", self)

    def __pow__(self, exponent: int) -> Term:
        if not isinstance(exponent, int) or isinstance(exponent, bool):
            raise ClaimError(
                f"the exponent {exponent!r} is not an integer; only integer powers are rational"
            )
        return (
            Term("^", self, exponent)
            if exponent >= 0
            else Term("/", term(1), Term("^", self, -exponent))
        )

    def __lt__(self, other: Number) -> Formula:
        return Formula("<", self, term(other))

    def __le__(self, other: Number) -> Formula:
        return Formula("<=", self, term(other))

    def __gt__(self, other: Number) -> Formula:
        return Formula(">", self, term(other))

    def __ge__(self, other: Number) -> Formula:
        return Formula(">=", self, term(other))

    def __str__(self) -> str:
        return _write(self, 0)


def _is_operand(value: object) -> bool:
    """Whether `Term` handles the other operand, by computing or by refusing it; the operators of
    other classes are tried instead.
    """
    return isinstance(value, (Term, int, Fraction, float, complex, str)) or value is None


def term(value: Number) -> Term:
    """The term for an int, a Fraction or a term.

    >>> str(term(Fraction(-1, 3)))
    '-1/3'

    Raises ClaimError for a float, which is never exact.
    """
    if isinstance(value, Term):
        return value
    if isinstance(value, bool) or not isinstance(value, (int, Fraction)):
        raise ClaimError(f"{value!r} is not exact; write it as an int or as Fraction(p, q)")
    return Term("num", Fraction(value))


def reals(names: str) -> tuple[Term, ...]:
    """The named real variables, in order.

    >>> [str(name) for name in reals("alpha x")]
    ['alpha', 'x']
    """
    return tuple(real(name) for name in names.replace(",", " ").split())


def real(name: str) -> Term:
    """The real variable of this name."""
    if not NAME.match(name) or name in RESERVED:
        raise ClaimError(f"{name!r} is not a name; use a letter followed by letters, digits or _")
    return Term("var", name)


_LEVEL = {"+": 1, "-": 1, "*": 2, "/": 2, "neg": 2, "^": 4, "var": 5, "num": 5, "call": 5}


def _write(expr: Term, level: int) -> str:
    own = _LEVEL[expr.op]
    if expr.op in ("var", "call"):  # calls are made for writing only: the argument is their text
        return str(expr.args[0])
    if expr.op == "num":
        value = expr.value
        own = 5 if value.denominator == 1 and value >= 0 else 2 if level <= 2 and value >= 0 else 1
        text = str(value)
    elif _is_negative(expr):
        own, text = 1, "-" + _write(_opposite(expr), 2)
    elif expr.op == "^":
        (base,) = expr.operands
        text = f"{_write(base, 5)}^{expr.exponent}"
    else:
        gap = " " if own == 1 else ""
        left, right = expr.operands
        text = f"{_write(left, own)}{gap}{expr.op}{gap}{_write(right, own + 1)}"
    return f"({text})" if own < level else text


def _is_negative(expr: Term) -> bool:
    """Whether the text begins with a minus sign; that of a first factor belongs to the product."""
    while expr.op in ("*", "/"):
        expr = expr.operands[0]
    return expr.op == "neg" or expr.op == "num" and expr.value < 0


def _opposite(expr: Term) -> Term:
    """The term without the minus sign at its beginning."""
    if expr.op == "neg":
        return expr.operands[0]
    if expr.op == "num":
        return Term("num", -expr.value)
    left, right = expr.operands
    return Term(expr.op, _opposite(left), right)


class Formula(Expression):
    """A relation between terms, or a boolean combination of relations; `str` gives the text that
    the checker reads.

    >>> x, w = reals("x w")
    >>> str((x >= 0) & ~(x < w))
    'x >= 0 and not x < w'
    """

    __slots__ = ()

    @property
    def sides(self) -> tuple[Term, Term]:
        """The two sides of a relation; raises ValueError for any other formula."""
        left, right = (part for part in self.args if isinstance(part, Term))
        return left, right

    @property
    def parts(self) -> tuple[Formula, ...]:
        """The formulas that a boolean combination joins; none for a relation."""
        return tuple(part for part in self.args if isinstance(part, Formula))

    def __reduce__(self) -> tuple[type[Formula], tuple[Argument, ...]]:
        return Formula, (self.op, *self.args)

    def __bool__(self) -> bool:
        raise ClaimError(
            "a formula has no truth value here; join formulas with &, | and ~, and write a < b, b <"
            " c apart"
        )

    def __and__(self, other: Formula) -> Formula:
        return conjunction([self, other])

    def __or__(self, other: Formula) -> Formula:
        return disjunction([self, other])

    def __invert__(self) -> Formula:
        return Formula("not", self)

    def __str__(self) -> str:
        return _write_formula(self, 0)


RELATIONS = frozenset({"<", "<=", "=", "!=", ">=", ">"})
_FORMULA_LEVEL = {"or": 3, "and": 4, "not": 5}


def _write_formula(formula: Formula, level: int) -> str:
    if formula.op == "call":
        return str(formula.args[0])
    if formula.op in RELATIONS:
        return f"{formula.args[0]} {formula.op} {formula.args[1]}"
    if formula.op in ("true", "false"):
        return "0 = 0" if formula.op == "true" else "0 = 1"
    if formula.op in ("implies", "iff"):
        return f"{formula.op}({formula.args[0]}, {formula.args[1]})"
    own = _FORMULA_LEVEL[formula.op]
    if formula.op == "not":
        text = "not " + _write_formula(formula.parts[0], 5)
    else:
        text = f" {formula.op} ".join(_write_formula(part, own + 1) for part in formula.parts)
    return f"({text})" if own < level else text


def equal(left: Number, right: Number) -> Formula:
    """The formula left = right."""
    return Formula("=", term(left), term(right))


def different(left: Number, right: Number) -> Formula:
    """The formula left != right."""
    return Formula("!=", term(left), term(right))


def conjunction(parts: Iterable[Formula]) -> Formula:
    """The formula that all parts hold; true when there are none."""
    return _join("and", parts, "true")


def disjunction(parts: Iterable[Formula]) -> Formula:
    """The formula that at least one part holds; false when there are none."""
    return _join("or", parts, "false")


def _join(op: str, parts: Iterable[Formula], empty: str) -> Formula:
    flat: dict[Formula, None] = {}
    for part in parts:
        if not isinstance(part, Formula):
            raise ClaimError(
                f"{part!r} is not a formula; compare two terms with <, <=, >, >= or equal(a, b)"
            )
        for piece in part.parts if part.op == op else (part,):
            if piece.op != empty:
                flat[piece] = None
    if len(flat) == 1:
        return next(iter(flat))
    return Formula(op, *flat) if flat else Formula(empty)


def implies(premise: Formula, conclusion: Formula) -> Formula:
    """The formula premise => conclusion."""
    return Formula("implies", premise, conclusion)


def iff(left: Formula, right: Formula) -> Formula:
    """The formula left <=> right."""
    return Formula("iff", left, right)


@overload
def substitute(thing: Term, values: Mapping[str, Number]) -> Term: ...
@overload
def substitute(thing: Formula, values: Mapping[str, Number]) -> Formula: ...
def substitute(thing: Expression, values: Mapping[str, Number]) -> Expression:
    """The same term or formula with values put for the named variables simultaneously.

    >>> x, w = reals("x w")
    >>> str(substitute(x < w, {"x": w + 1}))
    'w + 1 < w'

    Raises ClaimError for a float, and where `thing` is neither a term nor a formula.
    """
    _refuse_others(thing)
    done: dict[int, Expression] = {}  # parts that are shared are visited once

    def changed(part: Expression) -> Expression:
        if id(part) not in done:
            if isinstance(part, Term) and part.op == "var":
                new: Expression = term(values[part.name]) if part.name in values else part
            else:
                args = (
                    changed(each) if isinstance(each, Expression) else each for each in part.args
                )
                new = type(part)(part.op, *args)
            if isinstance(part, Term) and isinstance(new, Term):  # the origins stay
                new = new.made_by(*part.origins)
            done[id(part)] = new
        return done[id(part)]

    return changed(thing)


def names_in(thing: Expression) -> set[str]:
    """The names of the variables that occur in a term or formula; raises ClaimError for any other
    object.
    """
    _refuse_others(thing)
    return set(_names_of(thing))


def _refuse_others(thing: object) -> None:
    if not isinstance(thing, Expression):
        raise ClaimError(f"{thing!r} is neither a term nor a formula")


def _names_of(thing: Expression) -> frozenset[str]:
    if thing._names is None:  # kept, since terms never change and share their parts
        if isinstance(thing, Term) and thing.op == "var":
            thing._names = frozenset((thing.name,))
        else:
            parts = (_names_of(part) for part in thing.args if isinstance(part, Expression))
            thing._names = frozenset().union(*parts)
    return thing._names
