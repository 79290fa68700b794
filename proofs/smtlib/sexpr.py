"""Names of an SMT-LIB script in our language: the same where they can be, else made from their."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NoReturn, Union

from juggleproof.certificates.language import (
    NAME,
    RESERVED,
    ClaimError,
    Formula,
    Term,
    conjunction,
    disjunction,
    term,
)

# -------------------------------------------------------------------------------------------------
# Names of an SMT-LIB script in our language: the same where they can be, else made from their
# letters.

OURS = RESERVED | {
    "alpha",
    "r",
    "g",
}  # the search gives these favoured values, as the paper's parameter and units have them


def our_name(symbol: str, taken: Collection[str]) -> str:
    """A name for a variable of the script that our language allows and that no other bears.

    >>> our_name("x", []), our_name("x'", ["x_1"]), our_name("lambda", []), our_name("|", [])
    ('x', 'x_', 'lambda_', 'v')
    """
    base = re.sub(r"\W", "_", symbol, flags=re.ASCII).lstrip("_0123456789") or "v"
    name = base if NAME.match(base) and base not in OURS else base + "_"
    count = 1
    while name in taken:
        count += 1
        name = f"{base}_{count}"
    return name


# -------------------------------------------------------------------------------------------------
# S-expressions of SMT-LIB 2 with the line of each: words, numbers, strings and lists.

DEEPEST = 200
TOKEN = re.compile(
    r"(?P<space>["
    r' \t\r\n]+|;[^\n]*)|(?P<paren>[()])|(?P<string>"(?:[^"]|"")*")|(?P<quoted>\|[^|\\]*\|)'
    r"|(?P<decimal>(?:0|[1-9][0-9]*)\.[0-9]+(?![^\s();\"|]))|(?P<numeral>(?:0|[1-9][0-9]*)(?![^\s();\"|]))"
    r"|(?P<keyword>:[A-Za-z0-9~!@$%^&*_+=<>.?/-]+)|(?P<symbol>[A-Za-z~!@$%^&*_+=<>.?/-][A-Za-z0-9~!@$%^&*_+=<>.?/-]*)"
)


@dataclass(frozen=True)
class Word:
    """A symbol, numeral, decimal, keyword or string; a symbol written |so| is the same as one
    written so.
    """

    text: str
    kind: str
    line: int

    def __str__(self) -> str:
        return f'"{self.text}"' if self.kind == "string" else self.text


@dataclass(frozen=True)
class Node:
    """A list in parentheses."""

    items: tuple[Expression, ...]
    line: int

    def __str__(self) -> str:
        return f"({' '.join(map(str, self.items))})"


Expression = Union[Word, Node]


class Script:
    """The text of one file; every error names file and line."""

    def __init__(self, text: str, file: str) -> None:
        self.text, self.file = text, file

    def fail(self, at: Expression | int, problem: str, mend: str) -> NoReturn:
        """Raises ClaimError, one line: file, line, what is wrong and how to mend it."""
        line = at if isinstance(at, int) else at.line
        raise ClaimError(
            f"{self.file}:{line}: {' '.join(problem.split())}; {' '.join(mend.split())}"
        )

    def expressions(self) -> Iterator[Expression]:
        """The expressions at top level, in order.

        >>> [str(one) for one in Script("(assert (> |x y| 0.5)) ; end", "f").expressions()]
        ['(assert (> x y 0.5))']
        """
        opened: list[tuple[int, list[Expression]]] = []
        for kind, text, line in self._tokens():
            if text == "(" and kind == "paren":
                if len(opened) >= DEEPEST:
                    self.fail(
                        line,
                        f"parentheses nested more than {DEEPEST} deep",
                        "define parts by define-fun or let",
                    )
                opened.append((line, []))
                continue
            if kind == "paren":
                if not opened:
                    self.fail(line, "a parenthesis is closed that was not opened", "remove it")
                began, items = opened.pop()
                done: Expression = Node(tuple(items), began)
            else:
                done = Word(text, kind, line)
            if opened:
                opened[-1][1].append(done)
            else:
                yield done
        if opened:
            self.fail(opened[-1][0], "a parenthesis is opened and never closed", "close it")

    def _tokens(self) -> Iterator[tuple[str, str, int]]:
        at, line = 0, 1
        while at < len(self.text):
            found = TOKEN.match(self.text, at)
            if found is None:
                self.fail(
                    line,
                    f"{self.text[at : at + 20].split()[0]!r} is no part of SMT-LIB",
                    "mend or remove it",
                )
            kind, text = str(found.lastgroup), found[0]
            if kind == "quoted":
                yield "symbol", text[1:-1], line
            elif kind == "string":
                yield kind, text[1:-1].replace('""', '"'), line
            elif kind != "space":
                yield kind, text, line
            at, line = found.end(), line + text.count("\n")


# -------------------------------------------------------------------------------------------------
# What an SMT-LIB term means in our language: a formula, or a real term in cases (an `ite` between
# reals is told apart by its condition).

MOST_CASES = 64
MOST_NODES = 20_000
DEEPEST_TERM = 120  # the checker reads texts by Python's parser, which takes 200 nested parentheses
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

    >>> from juggleproof.certificates.language import reals
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
        if size > MOST_NODES or depth > DEEPEST_TERM:
            raise TooLarge(
                f"an expression of more than {MOST_NODES} symbols, or {DEEPEST_TERM} levels, when"
                " its definitions are put in"
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
