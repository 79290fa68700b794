"""S-expressions of SMT-LIB 2: words and lists in parentheses, each with its line.

Source: SMT-LIB 2.6, section 3.2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn, Union

from juggleproof.statements.language import ClaimError

SYMBOL = r"[A-Za-z~!@$%^&*_+=<>.?/-][A-Za-z0-9~!@$%^&*_+=<>.?/-]*"
SIMPLE = re.compile(SYMBOL)
NUMERAL, END = r"(?:0|[1-9][0-9]*)", r"(?![^\s();\"|])"
TOKEN = re.compile(
    r"(?P<space>[ \t\r\n]+|;[^\n]*)|(?P<paren>[()])"
    r'|(?P<string>"(?:[^"]|"")*")|(?P<quoted>\|[^|\\]*\|)'
    rf"|(?P<decimal>{NUMERAL}\.[0-9]+{END})|(?P<numeral>{NUMERAL}{END})"
    rf"|(?P<keyword>:[A-Za-z0-9~!@$%^&*_+=<>.?/-]+)|(?P<symbol>{SYMBOL})"
)


@dataclass(frozen=True)
class SexprWord:
    """A symbol, numeral, decimal, keyword or string; the symbol |x| is equal to x.  `str` gives the
    text in SMT-LIB.
    """

    text: str
    kind: str
    line: int

    def __str__(self) -> str:
        if self.kind == "string":
            return '"' + self.text.replace('"', '""') + '"'
        simple = self.kind != "symbol" or SIMPLE.fullmatch(self.text)
        return self.text if simple else f"|{self.text}|"


@dataclass(frozen=True)
class SexprList:
    """A list in parentheses; `str` gives its text, on one line unless a symbol has several."""

    items: tuple[Expression, ...]
    line: int

    def __str__(self) -> str:
        pieces: list[str] = []
        left: list[Expression | str] = [self]
        while left:
            one = left.pop()
            if isinstance(one, SexprList):
                left += [")", *one.items[::-1]]
            piece = "(" if isinstance(one, SexprList) else str(one)
            pieces += [piece] if not pieces or piece == ")" or pieces[-1] == "(" else [" ", piece]
        return "".join(pieces)


Expression = Union[SexprWord, SexprList]


class Script:
    """A script with the name of its file; every error names file and line."""

    def __init__(self, text: str, file: str) -> None:
        self.text, self.file = text, file

    def fail(self, at: Expression | int, problem: str, mend: str) -> NoReturn:
        """Raises ClaimError, one line: file, line, problem and remedy."""
        line = at if isinstance(at, int) else at.line
        raise ClaimError(
            f"{self.file}:{line}: {' '.join(problem.split())}; {' '.join(mend.split())}"
        )

    def expressions(self) -> Iterator[Expression]:
        """The expressions at top level, in order.

        >>> [str(one) for one in Script("(assert (> |x y| 0.5)) ; end", "f").expressions()]
        ['(assert (> |x y| 0.5))']
        """
        opened: list[tuple[int, list[Expression]]] = []
        for kind, text, line in self._tokens():
            if text == "(" and kind == "paren":
                opened.append((line, []))
                continue
            if kind == "paren":
                if not opened:
                    self.fail(line, "a parenthesis is closed that was not opened", "remove it")
                began, items = opened.pop()
                done: Expression = SexprList(tuple(items), began)
            else:
                done = SexprWord(text, kind, line)
            if opened:
                opened[-1][1].append(done)
            else:
                yield done
        if opened:
            self.fail(opened[-1][0], "a parenthesis is opened and never closed", "close it")

    def _tokens(self) -> Iterator[tuple[str, str, int]]:
        at, line = 0, 1
        while at < len(self.text):
            match = TOKEN.match(self.text, at)
            if match is None:
                self.fail(
                    line,
                    f"{self.text[at : at + 20].split()[0]!r} is no part of SMT-LIB",
                    "mend or remove it",
                )
            kind, text = str(match.lastgroup), match[0]
            if kind == "quoted":
                yield "symbol", text[1:-1], line
            elif kind == "string":
                yield kind, text[1:-1].replace('""', '"'), line
            elif kind != "space":
                yield kind, text, line
            at, line = match.end(), line + text.count("\n")
