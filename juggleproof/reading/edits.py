"""Changes of a print at its tokens: all single changes, for mutation tests, and the plausible ones,
among which a correction is sought.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from juggleproof.reading.lexer import BINARY, RELATIONS, PrintError, Token, lex
from juggleproof.reading.parser import parse

# -------------------------------------------------------------------------------------------------
# Edits of a print at its tokens: the spans of arguments, scripts, names and bracket pairs, and
# their replacement.

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
    """A print with its tokens, and the edits of single tokens."""

    def __init__(self, latex: str) -> None:
        self.latex = latex
        self.tokens: tuple[Token, ...] = lex(latex)[:-1]
        self.words = frozenset(i for word in self._words() for i in word)

    def replaced(self, start: int, end: int, text: str) -> str:
        """The print with this text in place of the characters from start to end; spaces keep
        commands and letters apart.
        """
        after = self.latex[end:]
        gap = " " if text[-1:].isalpha() and "\\" in text and after[:1].isalpha() else ""
        before = self.latex[:start]
        if not text and after[:1].isalpha() and before[-1:].isalpha():
            gap = " "
        if text[:1].isalpha() and re.search(r"\\[A-Za-z]+$", before):
            before += " "
        return before + text + gap + after

    def without(self, i: int) -> str:
        """The print without this token."""
        return self.replaced(self.tokens[i].start, self.tokens[i].end, "")

    def instead(self, i: int, text: str) -> str:
        """The print with this text in place of the token."""
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
        """The print with a text inserted."""
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
        """The span of characters of a script, from its ^ or _ at token i on."""
        span = self.argument(i + 1)
        if span is None:
            return None
        last = self.tokens[span[1] - 1]
        one_digit = last.kind == "number" and span[1] - span[0] == 1
        end = self.tokens[span[0]].start + 1 if one_digit else last.end
        return self.tokens[i].start, end

    def after_name(self, i: int) -> int:
        """The token after the name that contains letter i; accents, subscripts and primes are parts
        of a name.
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
        """The position after the end of the token before token i."""
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


# -------------------------------------------------------------------------------------------------
# Single changes of a print: all of them, to test that every token matters; the plausible ones, to
# seek a correction.
#
# Changes without a change of meaning are left out: := for = and \equiv, \subset for \subseteq, \bar
# for \overline, layout, spacing, fonts, TeX's own braces.

Change = tuple[str, str]  # a description of the change, and the changed print

ALTERNATIVES: dict[str, tuple[str, ...]] = {
    "+": ("-",),
    "-": ("+",),
    "<": (r"\le", ">"),
    r"\le": ("<", r"\ge"),
    ">": (r"\ge", "<"),
    r"\ge": (">", r"\le"),
    "=": (r"\ne", r"\le"),
    ":=": (r"\ne", r"\le"),
    r"\equiv": (r"\ne", r"\le"),
    r"\ne": ("=",),
    r"\in": (r"\notin",),
    r"\notin": (r"\in",),
    r"\cup": (r"\cap",),
    r"\cap": (r"\cup",),
    r"\setminus": (r"\cap",),
    r"\max": (r"\min",),
    r"\min": (r"\max",),
    r"\sup": (r"\inf",),
    r"\inf": (r"\sup",),
    r"\times": ("+",),
    r"\cdot": ("+",),
    "/": ("*",),
    r"\circ": (r"\cdot",),
    r"\Delta": (r"\partial",),
    r"\partial": (r"\Delta",),
    r"\infty": ("0",),
    r"\alpha": (r"\gamma", r"\beta"),
    r"\beta": (r"\rho", r"\alpha"),
    r"\gamma": (r"\alpha",),
    r"\rho": (r"\beta",),
    r"\tau": (r"\xi",),
    r"\xi": (r"\epsilon",),
    r"\epsilon": (r"\xi",),
    r"\chi": (r"\beta",),
    r"\lambda": (r"\alpha",),
    "A": ("F",),
    "B": ("H",),
    "E": ("K", "R"),
    "F": ("A",),
    "H": ("B",),
    "I": ("A",),
    "K": ("E", "T"),
    "R": ("E",),
    "T": ("t", "K"),
    "b": ("r", "e"),
    "c": ("p",),
    "e": ("p", "b"),
    "f": ("F",),
    "k": ("K",),
    "p": ("e",),
    "r": ("b",),
    "t": ("T",),
    "u": ("e",),
    "x": ("y", r"\chi"),
    "y": ("x",),
    "z": ("b",),
}
WORDS = {"max": "sup", "sup": "max", "eq": "max", "min": "max"}
_LAYOUT = frozenset(("{", "}", "&", ",", ".", ";"))


def mutations(latex: str) -> Iterator[Change]:
    r"""All single changes of the print: a description of each, and the changed print.

    >>> changes = [change for change, _ in mutations(r"x < 2")]
    >>> [change for change in changes if "becomes" in change]  # doctest: +NORMALIZE_WHITESPACE
    ['column 1: x becomes y', 'column 1: x becomes \\chi', 'column 3: < becomes \\le',
     'column 3: < becomes >', 'column 5: the digit 2 becomes 3']
    """
    seen = {latex}
    for change, changed in _all_changes(Edits(latex)):
        if changed not in seen:
            seen.add(changed)
            yield change, changed


def _all_changes(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if token.kind in ("line", "begin", "end", "text") or token.text in _LAYOUT:
            continue
        where = f"column {token.start + 1}: {token.text}"
        if i in print_.words:
            yield from _of_words(print_, i, where)
            continue
        yield f"{where} is deleted", print_.without(i)
        if (
            token.kind in ("letter", "number", "accent") or token.text == "'"
        ) and token.text != "0":
            shown = print_.latex[token.start : token.end]
            yield (
                f"{where} is doubled",
                print_.instead(i, f"{shown} {shown}" if shown[0] == "\\" else shown * 2),
            )
        for other in ALTERNATIVES.get(token.text, ("x",) if token.kind == "letter" else ()):
            yield f"{where} becomes {other}", print_.instead(i, other)
        if token.kind == "letter":
            for accent in (r"\dot", r"\overline"):
                yield f"{where} gets {accent}", print_.around(i, accent)
            yield f"{where} gets a prime", print_.inserted(token.end, "'")
        if token.kind == "accent":
            other = r"\overline" if token.text == r"\dot" else r"\dot"
            yield f"{where} becomes {other}", print_.instead(i, other)
        if token.kind == "number":
            yield from _of_digits(print_, i)
        yield from _of_spans(print_, i, where)


def _of_words(print_: Edits, i: int, where: str) -> Iterator[Change]:
    if i - 1 in print_.words:
        return
    last = i
    while last + 1 in print_.words:
        last += 1
    start, end = print_.tokens[i].start, print_.tokens[last].end
    word = print_.latex[start:end]
    yield f"{where}: the word {word} changes", print_.replaced(start, end, WORDS.get(word, "max"))


def _of_digits(print_: Edits, i: int) -> Iterator[Change]:
    token = print_.tokens[i]
    for at, digit in enumerate(token.text, token.start):
        if digit.isdigit():
            other = str(int(digit) + 1) if digit != "9" else "8"
            yield (
                f"column {at + 1}: the digit {digit} becomes {other}",
                print_.replaced(at, at + 1, other),
            )


def _of_spans(print_: Edits, i: int, where: str) -> Iterator[Change]:
    token = print_.tokens[i]
    if token.text in ("^", "_") and (span := print_.script(i)):
        yield f"{where} is dropped with what it carries", print_.replaced(*span, "")
    partner = print_.partner(i)
    if partner is not None:
        closing = print_.tokens[partner]
        inner = print_.latex[token.end : closing.start]
        yield (
            f"{where} and its partner are dropped",
            print_.replaced(token.start, closing.end, f" {inner} "),
        )
    if (
        token.text == r"\frac"
        and (top := print_.argument(i + 1))
        and (bottom := print_.argument(top[1]))
    ):
        spans = [(print_.tokens[a].start, print_.tokens[b - 1].end) for a, b in (top, bottom)]
        over, under = (print_.latex[a:b] for a, b in spans)
        if bottom[1] - bottom[0] > 1 or top[1] - top[0] > 1:
            swapped = "".join(side if side[0] == "{" else f"{{{side}}}" for side in (under, over))
            yield (
                f"{where}: numerator and denominator change places",
                print_.replaced(spans[0][0], spans[1][1], swapped),
            )


def one_mark_changes(latex: str) -> Iterator[Change]:
    r"""Prints that differ by one mark and can still be read, the simplest marks first.

    The order of kinds is dot, bar, prime, sign, exponent, half, index, strictness, letter, swap.
    Within a kind, changes to the right of the first relation come before those to its left.  Each
    description begins with the kind.

    >>> changes = one_mark_changes(r"a \le b")
    >>> [changed for change, changed in changes if change.startswith("strictness")]
    ['a < b']
    """
    seen = {parse(latex)}
    print_ = Edits(latex)
    first_sign = next((token.end for token in print_.tokens if token.text in RELATIONS), 0)
    for kind, changes in _MARKS.items():
        # The right of the first relation comes before its left, which often only names something.
        for change, changed in sorted(
            changes(print_), key=lambda found: not found[1].startswith(latex[:first_sign])
        ):
            try:
                tree = parse(changed)
            except PrintError:
                continue
            if tree not in seen:
                seen.add(tree)
                yield f"{kind}: {change}", changed


def _accents(*commands: str) -> Callable[[Edits], Iterator[Change]]:
    def changes(print_: Edits) -> Iterator[Change]:
        for i, token in enumerate(print_.tokens):
            if token.kind == "accent" and token.text == commands[0]:
                yield f"dropped at column {token.start + 1}", print_.without(i)
        for i, token in enumerate(print_.tokens):
            if token.kind == "letter" and i not in print_.words:
                yield (
                    f"put over {token.text} at column {token.start + 1}",
                    print_.around(i, commands[-1]),
                )

    return changes


def _primes(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if token.text == "'":
            yield f"dropped at column {token.start + 1}", print_.without(i)
    for i, token in enumerate(print_.tokens):
        if token.kind == "letter" and i not in print_.words:
            yield (
                f"put after {token.text} at column {token.start + 1}",
                print_.inserted(token.end, "'"),
            )


def _signs(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if token.text in ("+", "-"):
            yield (
                f"turned at column {token.start + 1}",
                print_.instead(i, "-" if token.text == "+" else "+"),
            )
    for i in print_.term_starts():
        start = print_.tokens[i].start
        if i and print_.tokens[i - 1].text in ("+", "-"):
            continue
        yield f"minus put at column {start + 1}", print_.inserted(start, "-")


def _exponents(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if token.text == "^" and (span := print_.script(i)):
            yield f"dropped at column {token.start + 1}", print_.replaced(*span, "")
            yield (
                f"brought down at column {token.start + 1}",
                print_.replaced(token.start, token.end, " "),
            )
    for i, token in enumerate(print_.tokens):
        bracket = token.text in (")", "]")
        if bracket or token.kind == "letter" and i not in print_.words:
            after = i + 1 if bracket else print_.after_name(i)
            if after == len(print_.tokens) or print_.tokens[after].text != "^":
                at = print_.end_of(after)
                yield f"2 put at column {at + 1}", print_.inserted(at, "^2")


def _halves(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if (
            token.text == r"\frac"
            and (top := print_.argument(i + 1))
            and (bottom := print_.argument(top[1]))
        ):
            start, end = token.start, print_.tokens[bottom[1] - 1].end
            if "".join(print_.latex[start:end].split()) in (
                r"\frac{1}{2}",
                r"\frac1{2}",
                r"\frac{1}2",
            ):
                yield f"dropped at column {start + 1}", print_.replaced(start, end, "")
        if token.text == "12" and i and print_.tokens[i - 1].text == r"\frac":
            start = print_.tokens[i - 1].start
            yield f"dropped at column {start + 1}", print_.replaced(start, token.end, "")
        if token.text == "2" and i and print_.tokens[i - 1].text == "/":
            yield (
                f"dropped at column {token.start}",
                print_.replaced(print_.tokens[i - 1].start, token.end, ""),
            )
        if token.text == "2":
            yield f"2 dropped at column {token.start + 1}", print_.without(i)
    for i in print_.term_starts():
        start = print_.tokens[i].start
        if i > 1 and print_.tokens[i - 2].text == "^":
            continue
        yield f"put at column {start + 1}", print_.inserted(start, r"\frac{1}{2} ")


def _indices(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if token.text != "_" or not (span := print_.script(i)):
            continue
        for at in range(span[0] + 1, span[1]):
            digit = print_.latex[at]
            if digit.isdigit():
                for other in (int(digit) - 1, int(digit) + 1):
                    if 0 <= other <= 9:
                        yield (
                            f"{digit} to {other} at column {at + 1}",
                            print_.replaced(at, at + 1, str(other)),
                        )
        yield f"dropped at column {token.start + 1}", print_.replaced(*span, "")
    for i, token in enumerate(print_.tokens):
        if token.kind == "letter" and i not in print_.words:
            for index in "012":
                yield (
                    f"{index} put after {token.text} at column {token.end + 1}",
                    print_.inserted(token.end, f"_{index}"),
                )


def _strictness(print_: Edits) -> Iterator[Change]:
    turns = {"<": r"\le", r"\le": "<", ">": r"\ge", r"\ge": ">"}
    for i, token in enumerate(print_.tokens):
        if token.text in turns:
            yield (
                f"{token.text} to {turns[token.text]} at column {token.start + 1}",
                print_.instead(i, turns[token.text]),
            )


def _letters(print_: Edits) -> Iterator[Change]:
    for i, token in enumerate(print_.tokens):
        if token.kind == "letter" and i not in print_.words:
            for other in ALTERNATIVES.get(token.text, ()):
                yield (
                    f"{token.text} to {other} at column {token.start + 1}",
                    print_.instead(i, other),
                )


def _swaps(print_: Edits) -> Iterator[Change]:
    """Two different letters that change places."""
    letters = [i for i, one in enumerate(print_.tokens) if one.kind == "letter"]
    letters = [i for i in letters if i not in print_.words]
    for place, i in enumerate(letters):
        for j in letters[place + 1 :]:
            one, other = print_.tokens[i].text, print_.tokens[j].text
            if one != other:
                later = Edits(print_.instead(j, one))
                yield (
                    f"{one} and {other} at columns {print_.tokens[i].start + 1} and"
                    f" {print_.tokens[j].start + 1}",
                    later.instead(i, other),
                )


_MARKS: dict[str, Callable[[Edits], Iterator[Change]]] = {
    "dot": _accents(r"\dot"),
    "bar": _accents(r"\bar", r"\overline"),
    "prime": _primes,
    "sign": _signs,
    "exponent": _exponents,
    "half": _halves,
    "index": _indices,
    "strictness": _strictness,
    "letter": _letters,
    "swap": _swaps,
}
