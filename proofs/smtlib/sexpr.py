"""S-expressions of SMT-LIB 2 with the line of each: words, numbers, strings and lists."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn, Union

from certificates.terms import ClaimError

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
