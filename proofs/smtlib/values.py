"""What an SMT-LIB term means in our language: a formula, or a real term in cases (an `ite` between
reals is told apart by its condition).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Union

from certificates.terms import Formula, Term, conjunction, disjunction, term

MOST_CASES = 64
MOST_NODES = 20_000
DEEPEST = 120  # the checker reads texts by Python's parser, which takes 200 nested parentheses
Guards = tuple[tuple[Formula, bool], ...]


class TooLarge(Exception):
    """An expression has more cases, or more symbols when definitions are put in, than we take
    on.
    """


@dataclass(frozen=True)
class Real:
    """A real term: in each case its value under the conditions of the case, of which exactly one
    applies.
    """

    cases: tuple[tuple[Guards, Term], ...]

    @property
    def plain(self) -> Term | None:
        """The term, where there are no cases to tell apart."""
        return self.cases[0][1] if len(self.cases) == 1 and not self.cases[0][0] else None


Value = Union[Formula, Real]


def plain(value: Term | int) -> Real:
    """A term without cases."""
    return Real((((), term(value)),))


def merged(parts: Sequence[Guards]) -> Guards | None:
    """All conditions together; None where one of them is wanted both true and false."""
    found: dict[Formula, bool] = {}
    for condition, truth in (pair for part in parts for pair in part):
        if found.setdefault(condition, truth) is not truth:
            return None
    return tuple(found.items())


def combined(values: Sequence[Real], make: Callable[[Sequence[Term]], Term]) -> Real:
    """The term made of the values, in every case that they can be in together."""
    return Real(tuple((guards, make(terms)) for guards, terms in together(values)))


def together(values: Sequence[Real]) -> list[tuple[Guards, tuple[Term, ...]]]:
    """The cases that several values can be in together, with the value of each."""
    if len(values) == 1:
        return [(guards, (value,)) for guards, value in values[0].cases]
    found: list[tuple[Guards, tuple[Term, ...]]] = [((), ())]
    for value in values:
        pairs = [
            (merged((guards, more)), (*terms, last))
            for (guards, terms), (more, last) in product(found, value.cases)
        ]
        found = [(guards, terms) for guards, terms in pairs if guards is not None]
        if len(found) > MOST_CASES:
            raise TooLarge(f"an atom with more than {MOST_CASES} cases of ite")
    return found


def relation(values: Sequence[Real], make: Callable[[Sequence[Term]], Formula]) -> Formula:
    """The formula about the values: in one of the cases, its conditions and what is said there
    hold.

    >>> from certificates.terms import reals
    >>> x, y = reals("x y")
    >>> larger = choice(x > y, plain(x), plain(y))
    >>> str(relation([larger], lambda terms: terms[0] >= 0))
    'x > y and x >= 0 or not x > y and y >= 0'
    """
    return disjunction(
        [conjunction([*map(said, guards), make(terms)]) for guards, terms in together(values)]
    )


def said(guard: tuple[Formula, bool]) -> Formula:
    """A condition, or its negation."""
    return guard[0] if guard[1] else Formula("not", guard[0])


def choice(condition: Formula, first: Real, second: Real) -> Real:
    """The first value where the condition holds, else the second."""
    pairs = [
        (merged((((condition, truth),), guards)), value)
        for truth, one in ((True, first), (False, second))
        for guards, value in one.cases
    ]
    cases = tuple((guards, value) for guards, value in pairs if guards is not None)
    if len(cases) > MOST_CASES:
        raise TooLarge(f"a term with more than {MOST_CASES} cases of ite")
    return Real(cases)


class Sizes:
    """The number of symbols of terms and formulas written out, and how deep they are; parts that
    are shared are looked at once.
    """

    def __init__(self) -> None:
        self.known: dict[int, tuple[object, int, int]] = {}

    def of(self, thing: Term | Formula) -> tuple[int, int]:
        """The size and the depth; raises TooLarge where they are beyond what we take on."""
        if id(thing) not in self.known:
            parts = [self.of(part) for part in thing.args if isinstance(part, (Term, Formula))]
            size, depth = (
                1 + sum(size for size, _ in parts),
                1 + max((depth for _, depth in parts), default=0),
            )
            self.known[id(thing)] = thing, size, depth
        _, size, depth = self.known[id(thing)]
        if size > MOST_NODES or depth > DEEPEST:
            raise TooLarge(
                f"an expression of more than {MOST_NODES} symbols, or {DEEPEST} levels, when its"
                " definitions are put in"
            )
        return size, depth

    def check(self, value: Value) -> Value:
        """The value, if it is not too large."""
        if isinstance(value, Formula):
            self.of(value)
            return value
        for guards, one in value.cases:
            self.of(one)
            for condition, _ in guards:
                self.of(condition)
        return value
