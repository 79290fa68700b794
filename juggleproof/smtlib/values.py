"""Values of the terms of a script: formulas, and real terms in cases.  Parts that are too large, or
nested too deep, are replaced by names.

A real term has a case for each combination of truth values of its `ite` conditions.  A polynomial
that is short when written out is named by a definition (a line `let`); any other term is named by a
new variable with an equation as an assertion, and a formula F by a variable b with b > 0 <=> F.  So
the assertions with names have a solution if and only if those without have one.

Source, for formulas: Tseitin, On the complexity of derivation in propositional calculus (1968).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import product
from math import comb, prod
from typing import TypeVar, Union

from juggleproof.smtlib import limits
from juggleproof.statements.formulas import (
    RELATIONS,
    Formula,
    Term,
    conjunction,
    disjunction,
    equal,
    iff,
    names_in,
    real,
    term,
)

# -------------------------------------------------------------------------------------------------
# Real terms in cases.

Guards = tuple[tuple[Formula, bool], ...]


@dataclass(frozen=True)
class RealCases:
    """A real term as cases (conditions, value); exactly one case applies at each point."""

    cases: tuple[tuple[Guards, Term], ...]

    @property
    def plain(self) -> Term | None:
        """The term, if there is only one case, without conditions; else None."""
        return self.cases[0][1] if len(self.cases) == 1 and not self.cases[0][0] else None


Value = Union[Formula, RealCases]


def plain(value: Term | int) -> RealCases:
    """The real term with this value as its only case."""
    return RealCases((((), term(value)),))


def merged(parts: Sequence[Guards]) -> Guards | None:
    """The conjunction of all conditions; None where one of them is to be both true and false."""
    joined: dict[Formula, bool] = {}
    for condition, truth in (pair for part in parts for pair in part):
        if joined.setdefault(condition, truth) is not truth:
            return None
    return tuple(joined.items())


def together(values: Sequence[RealCases]) -> list[tuple[Guards, tuple[Term, ...]]]:
    """The joint cases of several values: the conditions, and the value of each under them."""
    if all(value.plain is not None for value in values):
        return [((), tuple(value.cases[0][1] for value in values))]
    joined: list[tuple[Guards, tuple[Term, ...]]] = [((), ())]
    for value in values:
        pairs = [
            (merged((guards, more)), (*terms, last))
            for (guards, terms), (more, last) in product(joined, value.cases)
        ]
        joined = [(guards, terms) for guards, terms in pairs if guards is not None]
    return joined


def relation(values: Sequence[RealCases], make: Callable[[Sequence[Term]], Formula]) -> Formula:
    """The formula that in one of the joint cases, its conditions and the result of `make` on its
    values hold.

    >>> from juggleproof.statements.language import reals
    >>> x, y = reals("x y")
    >>> larger = choice(x > y, plain(x), plain(y))
    >>> str(relation([larger], lambda terms: terms[0] >= 0))
    'x > y and x >= 0 or not x > y and y >= 0'
    """
    return disjunction(
        [conjunction([*map(holding, guards), make(terms)]) for guards, terms in together(values)]
    )


def holding(guard: tuple[Formula, bool]) -> Formula:
    """The condition of a pair (condition, truth value), negated where the truth value is False."""
    return guard[0] if guard[1] else Formula("not", guard[0])


def choice(condition: Formula, first: RealCases, second: RealCases) -> RealCases:
    """The real term that is the first value where the condition holds, else the second."""
    pairs = [
        (merged((((condition, truth),), guards)), value)
        for truth, one in ((True, first), (False, second))
        for guards, value in one.cases
    ]
    return RealCases(tuple((guards, value) for guards, value in pairs if guards is not None))


# -------------------------------------------------------------------------------------------------
# Sizes of terms and formulas, and of the polynomials that terms are.


@dataclass(frozen=True)
class Size:
    """The size of a term or formula: the number of its symbols and their nesting depth; for a term,
    also bounds on the degree, the number of terms and the bits of its polynomial, the degree with
    all names written out (`whole`), and whether it has a divisor that is not a number.
    """

    symbols: int
    depth: int
    degree: int = 0
    terms: int = 1
    bits: int = 0
    whole: int = 0
    divides: bool = False

    @property
    def fits(self) -> bool:
        """Whether the term or formula is small enough to stand without names, if its parts are."""
        return (
            self.depth <= limits.DEEPEST
            and self.degree <= 100
            and self.terms <= 20_000
            and self.bits <= 20_000
        )

    @property
    def is_part(self) -> bool:
        """Whether a term is large enough to get a name where a term around it does not fit."""
        return (
            self.symbols > 300
            or self.depth > limits.DEEPEST // 3
            or self.degree > 10
            or self.terms > 50
            or self.bits > 500
        )

    @property
    def is_short(self) -> bool:
        """Whether the polynomial of a term is short when written out."""
        return not self.divides and self.terms <= 500 and self.degree <= 60 and self.bits <= 5000


class TooLarge(Exception):
    """The error for a term that is too large; the message says in which way."""


class Sizes:
    """A cache of the sizes of terms and formulas, in which shared parts are visited once."""

    def __init__(self) -> None:
        self.known: dict[int, tuple[Term | Formula, Size]] = {}
        self.defined: dict[str, tuple[Size, frozenset[str]]] = {}  # sizes and variables of names

    def define(self, name: str, meaning: Term) -> None:
        """Adds a name that stands for a polynomial."""
        self.defined[name] = self.of(meaning), self.variables(meaning)

    def declare(self, name: str, meanings: Sequence[Term]) -> None:
        """Adds a variable that has one of these values."""
        whole = max(self.of(one).whole for one in meanings)
        self.defined[name] = Size(1, 1, 1, whole=whole), frozenset((name,))

    def variables(self, one: Term) -> frozenset[str]:
        """The variables of the polynomial with names written out."""
        own = (self.defined[k][1] if k in self.defined else {k} for k in names_in(one))
        return frozenset().union(*own)

    def of(self, one: Term | Formula) -> Size:
        """The size of a term or formula."""
        if id(one) not in self.known:
            parts = [self.of(part) for part in one.args if isinstance(part, (Term, Formula))]
            size = self._term(one, parts) if isinstance(one, Term) else self._formula(one, parts)
            self.known[id(one)] = one, size
        return self.known[id(one)][1]

    def _formula(self, one: Formula, parts: Sequence[Size]) -> Size:
        # the checker writes an equivalence as two implications
        symbols = (1 + (one.op == "iff")) * sum(part.symbols for part in parts)
        depth = 0 if one.op in RELATIONS else max((part.depth for part in parts), default=0)
        return Size(min(limits.MANY, 1 + symbols), 1 + depth)

    def _term(self, one: Term, parts: Sequence[Size]) -> Size:
        if one.op == "var":
            size, _ = self.defined.get(one.name, (Size(1, 1, 1, whole=1), ()))
            return replace(size, symbols=1, depth=1)
        if one.op == "num":
            return Size(1, 1, bits=max(one.value.numerator.bit_length(), 1))
        symbols = min(limits.MANY, 1 + sum(part.symbols for part in parts))
        depth = 1 + max(part.depth for part in parts)
        divides = any(part.divides for part in parts)
        degrees, terms = [part.degree for part in parts], [part.terms for part in parts]
        bits, wholes = [part.bits for part in parts], [part.whole for part in parts]
        whole = max(wholes)
        if one.op in "^*":
            whole = wholes[0] * one.exponent if one.op == "^" else sum(wholes)
        if whole > limits.MOST_DEGREE:
            raise TooLarge(f"a degree over {limits.MOST_DEGREE} when definitions are put in")
        if one.op == "^":
            most = one.exponent
            found = degrees[0] * most, min(terms[0], limits.MANY) ** min(most, 9), bits[0] * most
        elif one.op == "*":
            found = sum(degrees), prod(terms), sum(bits)
        elif one.op == "/":
            divides = divides or one.operands[1].op != "num"
            found = sum(degrees), terms[0], sum(bits)
        else:
            found = max(degrees), sum(terms), max(bits) + 1
        degree, count, length = (min(limits.MANY, each) for each in found)
        if count > 50:
            count = min(count, most_terms(len(self.variables(one)), degree))
        return Size(symbols, depth, degree, count, length, whole, divides)


def most_terms(variables: int, degree: int) -> int:
    """The greatest number of terms of a polynomial of this degree, at most `limits.MANY`."""
    return (
        limits.MANY
        if min(variables, degree) > 30
        else min(limits.MANY, comb(variables + degree, degree))
    )


# -------------------------------------------------------------------------------------------------
# Names of parts.

Joined = TypeVar("Joined", Term, Formula)


class Parts:
    """The names of the parts of a script's terms, in order, with the meaning of each: a term that
    it stands for, or a formula that is asserted of it.
    """

    def __init__(self, taken: Callable[[], Collection[str]]) -> None:
        self.taken, self.sizes = taken, Sizes()
        self.meanings: dict[str, Term | Formula] = {}
        self._named: dict[Value, Value] = {}
        self._count = 0

    def named(self, value: Value) -> Value:
        """The name of the value; a new one if it has none."""
        if value not in self._named:
            self._named[value] = self._new(value)
        return self._named[value]

    def _new(self, value: Value) -> Value:
        while True:
            self._count += 1
            name = f"part_{self._count}"
            if name not in self.taken():
                break
        own = real(name)
        if isinstance(value, Formula):
            self.meanings[name] = iff(own > 0, value)
            return own > 0
        whole = value.plain
        if whole is not None and self.sizes.of(whole).is_short:
            self.meanings[name] = whole
            self.sizes.define(name, whole)
        else:
            self.meanings[name] = relation([value], lambda terms: equal(own, terms[0]))
            self.sizes.declare(name, [one for _, one in value.cases])
        return plain(own)

    def joined(self, make: Callable[[Sequence[Joined]], Joined], parts: Sequence[Joined]) -> Joined:
        """The result of `make` on the parts; where it is too large, large parts are replaced by
        names.
        """
        whole = make(parts)
        size = self.sizes.of(whole)
        most = limits.MOST_SYMBOLS[whole.op if isinstance(whole, Formula) else ""]
        if size.fits and size.symbols <= most:
            return whole
        return make([self._shorter(part) for part in parts])

    def _shorter(self, part: Joined) -> Joined:
        size = self.sizes.of(part)
        if isinstance(part, Term):
            if part.op in ("var", "num") or not size.is_part:
                return part
            named = self.named(plain(part))
            return named.cases[0][1] if isinstance(named, RealCases) else part
        if (
            size.depth > limits.DEEPEST // 3
            or size.symbols > limits.LARGE_FORMULA
            and part.op not in RELATIONS
        ):
            named = self.named(part)
            return named if isinstance(named, Formula) else part
        return part

    def few(self, values: Sequence[RealCases]) -> list[RealCases]:
        """The values, some replaced by names: they have at most `MOST_CASES` joint cases."""
        few = list(values)
        while prod(len(one.cases) for one in few) > limits.MOST_CASES:
            k = max(range(len(few)), key=lambda k: len(few[k].cases))
            named = self.named(few[k])
            few[k] = named if isinstance(named, RealCases) else few[k]
        return few

    def chosen(self, condition: Formula, first: RealCases, second: RealCases) -> Value:
        """The value that is the first where the condition holds, else the second."""
        if (
            len(first.cases) + len(second.cases) > 2
            and self.sizes.of(condition).symbols > limits.LARGE_CONDITION
        ):
            named = self.named(condition)  # every case has the condition
            condition = named if isinstance(named, Formula) else condition
        cases = choice(condition, first, second)
        return cases if len(cases.cases) <= limits.MOST_CASES else self.named(cases)

    def combined(
        self, values: Sequence[RealCases], make: Callable[[Sequence[Term]], Term]
    ) -> RealCases:
        """The real term that has the result of `make` in every joint case of the values."""
        cases = together(self.few(values))
        return RealCases(tuple((guards, self.joined(make, terms)) for guards, terms in cases))


def balanced(join: Callable[[Joined, Joined], Joined], parts: Sequence[Joined]) -> Joined:
    """The parts joined by an associative operation as a balanced tree, which is not deep."""
    if len(parts) <= 8:
        return reduce(join, parts)
    middle = len(parts) // 2
    return join(balanced(join, parts[:middle]), balanced(join, parts[middle:]))
