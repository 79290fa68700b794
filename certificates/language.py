"""Terms, formulas, statements: the text an auditor reads."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, Union

from juggleproof.certificates import checker

# -------------------------------------------------------------------------------------------------
# Terms and formulas: exact rational expressions and relations, written out as the text that the
# checker reads.
#
# No floats: a `float` anywhere raises `ClaimError`.  `==` compares structure; a claimed equality is
# `equal(a, b)`.

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z")
RESERVED = frozenset({"implies", "iff", "sqrt", "root", *keyword.kwlist})
Number = Union[int, Fraction, "Term"]


class ClaimError(ValueError):
    """A claim cannot be stated as written; the message is one line that says what is wrong and how
    to mend it.
    """


class Term:
    """A rational expression over named reals, kept as it was written.

    `origins` says which derivations made it; it is no part of equality or hash.

    >>> x, w = reals("x w")
    >>> str((x - w) / 2 + x**2 * Fraction(1, 3))
    '(x - w)/2 + x^2*(1/3)'
    """

    __slots__ = ("op", "args", "origins", "_hash", "_names")

    def __init__(self, op: str, *args: Any, origins: tuple[Hashable, ...] = ()) -> None:
        self.op, self.args, self.origins = op, args, origins
        self._hash = hash((op, args))
        self._names: frozenset[str] | None = None

    def made_by(self, *origins: Hashable) -> Term:
        """The same term, made by these as well.

        >>> real("x").made_by("f").origins, real("x").made_by("f") == real("x")
        (('f',), True)
        """
        joined = tuple(dict.fromkeys((*self.origins, *origins)))
        return self if joined == self.origins else Term(self.op, *self.args, origins=joined)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Term)
            and self._hash == other._hash
            and (self.op, self.args) == (other.op, other.args)
        )

    def __reduce__(self) -> tuple[Any, ...]:  # a hash of another process would not do
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

    def __repr__(self) -> str:
        return f"Term({str(self)!r})"


def _is_operand(value: object) -> bool:
    """Whether the term answers for the operation: numbers, also those that it refuses; other
    classes may know better.
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
    if expr.op in ("var", "call"):  # a call is its text: it occurs only where it is written
        return str(expr.args[0])
    if expr.op == "num":
        value: Fraction = expr.args[0]
        own = 5 if value.denominator == 1 and value >= 0 else 2 if level <= 2 and value >= 0 else 1
        text = str(value)
    elif _is_negative(expr):
        own, text = 1, "-" + _write(_opposite(expr), 2)
    elif expr.op == "^":
        text = f"{_write(expr.args[0], 5)}^{expr.args[1]}"
    else:
        gap = " " if own == 1 else ""
        left = _write(expr.args[0], own)
        text = f"{left}{gap}{expr.op}{gap}{_write(expr.args[1], own + 1)}"
    return f"({text})" if own < level else text


def _is_negative(expr: Term) -> bool:
    """Whether a sign comes first: that of a factor is written, and read, as that of the product."""
    while expr.op in ("*", "/"):
        expr = expr.args[0]
    return expr.op == "neg" or expr.op == "num" and expr.args[0] < 0


def _opposite(expr: Term) -> Term:
    """A term without the sign that comes first."""
    if expr.op == "neg":
        inner: Term = expr.args[0]
        return inner
    if expr.op == "num":
        return Term("num", -expr.args[0])
    return Term(expr.op, _opposite(expr.args[0]), expr.args[1])


class Formula:
    """A relation between terms, or a boolean combination of such; `str` gives the text that the
    checker reads.

    >>> x, w = reals("x w")
    >>> str((x >= 0) & ~(x < w))
    'x >= 0 and not x < w'
    """

    __slots__ = ("op", "args", "_hash", "_names")

    def __init__(self, op: str, *args: Any) -> None:
        self.op, self.args = op, args
        self._hash = hash((op, args))
        self._names: frozenset[str] | None = None

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Formula) and (self.op, self.args) == (other.op, other.args)

    def __reduce__(self) -> tuple[Any, ...]:
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

    def __repr__(self) -> str:
        return f"Formula({str(self)!r})"


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
        text = "not " + _write_formula(formula.args[0], 5)
    else:
        text = f" {formula.op} ".join(_write_formula(part, own + 1) for part in formula.args)
    return f"({text})" if own < level else text


def equal(left: Number, right: Number) -> Formula:
    """The formula left = right."""
    return Formula("=", term(left), term(right))


def different(left: Number, right: Number) -> Formula:
    """The formula left != right."""
    return Formula("!=", term(left), term(right))


def conjunction(parts: Iterable[Formula]) -> Formula:
    """All of the parts hold; true when there are none."""
    return _join("and", parts, "true")


def disjunction(parts: Iterable[Formula]) -> Formula:
    """One of the parts holds at least; false when there are none."""
    return _join("or", parts, "false")


def _join(op: str, parts: Iterable[Formula], empty: str) -> Formula:
    flat: list[Formula] = []
    for part in parts:
        if not isinstance(part, Formula):
            raise ClaimError(
                f"{part!r} is not a formula; compare two terms with <, <=, >, >= or equal(a, b)"
            )
        for piece in part.args if part.op == op else (part,):
            if piece.op != empty and piece not in flat:
                flat.append(piece)
    return flat[0] if len(flat) == 1 else Formula(op, *flat) if flat else Formula(empty)


def implies(premise: Formula, conclusion: Formula) -> Formula:
    """The formula premise => conclusion."""
    return Formula("implies", premise, conclusion)


def iff(left: Formula, right: Formula) -> Formula:
    """The formula left <=> right."""
    return Formula("iff", left, right)


def transform(thing: Any, leaf: Callable[[Term], Term], done: dict[Any, Any] | None = None) -> Any:
    """The same term or formula with `leaf` applied to every variable; parts that are shared are
    visited once.
    """
    done = {} if done is None else done
    if not isinstance(thing, (Term, Formula)):
        raise ClaimError(f"{thing!r} is neither a term nor a formula")
    if id(thing) not in done:
        if thing.op == "var":
            result: Any = leaf(thing)  # type: ignore[arg-type]
        elif thing.op == "num":
            result = thing
        else:
            result = type(thing)(
                thing.op,
                *(
                    transform(p, leaf, done) if isinstance(p, (Term, Formula)) else p
                    for p in thing.args
                ),
            )
        if isinstance(thing, Term) and thing.origins:  # it is still what the derivation made
            result = result.made_by(*thing.origins)
        done[id(thing)] = result
    return done[id(thing)]


def substitute(thing: Any, values: Mapping[str, Number]) -> Any:
    """The same term or formula with values in place of the named variables, all at once.

    >>> x, w = reals("x w")
    >>> str(substitute(x < w, {"x": w + 1}))
    'w + 1 < w'
    """
    return transform(
        thing, lambda name: term(values[name.args[0]]) if name.args[0] in values else name
    )


def names_in(thing: Any) -> set[str]:
    """The names of the variables that occur."""
    return set(_names_of(thing))


def origins_in(*things: object) -> Iterator[Hashable]:
    """What made the terms in these terms, formulas, statements and sequences of such, from the
    outside in and from left to right; what made several is told several times.

    >>> x, w = reals("x w")
    >>> list(origins_in([x < w.made_by("f"), x**2]))
    ['f']
    """
    for thing in things:
        if isinstance(thing, Term):
            yield from thing.origins
        if isinstance(thing, (Term, Formula)):
            yield from origins_in(*thing.args)
        elif isinstance(thing, Statement):
            yield from origins_in(thing.lines, thing.within, thing.show)
        elif isinstance(thing, Iterates):
            yield from origins_in(thing.images, thing.powers)
        elif isinstance(thing, MapRule):
            yield from origins_in(thing.made_of)
        elif isinstance(thing, (tuple, list)):
            yield from origins_in(*thing)


def _names_of(thing: Any) -> frozenset[str]:
    if not isinstance(thing, (Term, Formula)):
        raise ClaimError(f"{thing!r} is neither a term nor a formula")
    if thing._names is None:  # kept, since terms never change and share their parts
        parts = [_names_of(part) for part in thing.args if isinstance(part, (Term, Formula))]
        thing._names = (
            frozenset((thing.args[0],)) if thing.op == "var" else frozenset().union(*parts)
        )
    return thing._names


# -------------------------------------------------------------------------------------------------
# Statements built from terms and formulas, and written as the text that the checker reads and an
# auditor can read.

Line = tuple[str, Union[Formula, tuple[str, Term]]]


@dataclass(frozen=True)
class Roles:
    """What the variables of statements stand for, which their text does not say.

    `domains` has the parameters, each with what is assumed of it alone; sharp ranges are sought
    there, over the first parameter unless others are asked for. `scales` are positive variables
    that a change of units makes 1; None where homogeneity is to tell them. Searches take both as
    hints: the checker is told neither.
    """

    domains: Mapping[str, tuple[Formula, ...]] = field(default_factory=dict)
    scales: frozenset[str] | None = None

    @property
    def parameter(self) -> str:
        """The first parameter; an empty name where there is none."""
        return next(iter(self.domains), "")

    def is_scale(self, name: str) -> bool:
        """Whether the variable is known to be a scale."""
        return self.scales is not None and name in self.scales


NO_ROLES = Roles()


@dataclass(frozen=True)
class Statement:
    """For all `forall`: the lines (range, given, have, let, root) imply `show`, or that some
    `exists` meet `within` and `show`.

    >>> from juggleproof.certificates.language import reals
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
    the lines as (keyword, text), and the terms and formulas that the texts are written from.

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


# -------------------------------------------------------------------------------------------------
# The interval that conditions on one variable alone make.

End = tuple[str, str]  # a rational, and < or <=


def bounds_of(condition: str, name: str) -> tuple[End | None, End | None] | None:
    """The ends of the interval that the conditions on one variable alone make; None in place of an
    end that there is not, and in place of both where a condition is not linear.

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
