"""Edits of a print at its tokens: the spans of arguments, scripts, names and bracket pairs, and
their replacement.
"""

from __future__ import annotations

from proofs.reading.lexer import Token, lex
from proofs.reading.vocabulary import BINARY, RELATIONS

_CLOSING = {
    "{": "}",
    "(": ")",
    "[": "]",
    r"\{": r"\}",
    r"\lfloor": r"\rfloor",
    r"\lceil": r"\rceil",
}
_OPENS_A_TERM = RELATIONS | frozenset(
    ("+", "-", "(", "[", "{", ",", "&", r"\{", "|", r"\lfloor", r"\lceil")
)


class Edits:
    """A print with its tokens, and the edits that single marks of it allow."""

    def __init__(self, latex: str) -> None:
        self.latex = latex
        self.tokens: tuple[Token, ...] = lex(latex)[:-1]
        self.words = frozenset(i for word in self._words() for i in word)

    def replaced(self, start: int, end: int, text: str) -> str:
        """The print with this text in place of a span; a command is kept apart from a letter that
        follows.
        """
        after = self.latex[end:]
        gap = " " if text[-1:].isalpha() and "\\" in text and after[:1].isalpha() else ""
        before = self.latex[:start]
        if not text and after[:1].isalpha() and before[-1:].isalpha():
            gap = " "
        return before + text + gap + after

    def without(self, i: int) -> str:
        """The print without this token."""
        return self.replaced(self.tokens[i].start, self.tokens[i].end, "")

    def instead(self, i: int, text: str) -> str:
        """The print with this text for the token."""
        return self.replaced(self.tokens[i].start, self.tokens[i].end, text)

    def around(self, i: int, command: str) -> str:
        """The print with a command over the token."""
        token = self.tokens[i]
        return self.replaced(
            token.start,
            token.end,
            f"{{{command}{{{self.latex[token.start : token.end].strip()}}}}}",
        )

    def inserted(self, at: int, text: str) -> str:
        """The print with a text put in."""
        return self.replaced(at, at, text)

    def partner(self, i: int) -> int | None:
        """The bracket that closes this one."""
        closing = _CLOSING.get(self.tokens[i].text)
        if closing is None:
            return None
        depth = 0
        for j in range(i, len(self.tokens)):
            text = self.tokens[j].text
            depth += (text == self.tokens[i].text) - (text == closing)
            if depth == 0:
                return j
        return None

    def argument(self, i: int) -> tuple[int, int] | None:
        """The span of tokens, end excluded, that TeX takes as one argument from token i on."""
        if i >= len(self.tokens):
            return None
        if self.tokens[i].text == "{":
            closing = self.partner(i)
            return None if closing is None else (i, closing + 1)
        if self.tokens[i].kind == "accent":
            inner = self.argument(i + 1)
            return None if inner is None else (i, inner[1])
        return i, i + 1

    def script(self, i: int) -> tuple[int, int] | None:
        """The characters of a script, with its ^ or _ at token i."""
        span = self.argument(i + 1)
        if span is None:
            return None
        last = self.tokens[span[1] - 1]
        one_digit = last.kind == "number" and span[1] - span[0] == 1
        end = self.tokens[span[0]].start + 1 if one_digit else last.end
        return self.tokens[i].start, end

    def after_name(self, i: int) -> int:
        """The token after the name that the letter i belongs to, with its accents, subscripts and
        primes.
        """
        j = i + 1
        start = i
        while True:
            if start > 0 and self.tokens[start - 1].kind == "accent":
                start -= 1
            elif (
                start > 1
                and self.tokens[start - 1].text == "{"
                and self.tokens[start - 2].kind == "accent"
                and j < len(self.tokens)
                and self.tokens[j].text == "}"
            ):
                start, j = start - 2, j + 1
            else:
                break
        while j < len(self.tokens) and self.tokens[j].text in ("_", "'"):
            span = self.argument(j + 1) if self.tokens[j].text == "_" else None
            j = span[1] if span is not None else j + 1
        return j

    def end_of(self, i: int) -> int:
        """The character after the token before token i."""
        return self.tokens[i - 1].end

    def term_starts(self) -> list[int]:
        """The tokens at which a term begins."""
        found = []
        for i, token in enumerate(self.tokens):
            if (
                token.text in BINARY
                or token.text in RELATIONS
                or token.kind in ("line", "end", "text")
            ):
                continue
            before = self.tokens[i - 1] if i else None
            opens = (
                before is None or before.text in _OPENS_A_TERM or before.kind in ("line", "begin")
            )
            if opens and not (
                before is not None and before.text == "{" and i > 1 and self._not_a_formula(i - 2)
            ):
                found.append(i)
        return found

    def _not_a_formula(self, i: int) -> bool:
        return self.tokens[i].kind == "accent" or self.tokens[i].text == "_"

    def _words(self) -> list[range]:
        words = []
        for i, token in enumerate(self.tokens):
            if (
                token.text in ("_", "^")
                and i + 1 < len(self.tokens)
                and self.tokens[i + 1].text == "{"
            ):
                closing = self.partner(i + 1)
                inside = self.tokens[i + 2 : closing] if closing else ()
                if len(inside) > 1 and all(
                    t.kind == "letter" and t.text.isalpha() and t.text.islower() for t in inside
                ):
                    words.append(range(i + 2, i + 2 + len(inside)))
        return words
