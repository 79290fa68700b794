r"""The tokens of LaTeX mathematics, with their positions: digits and letters one by one, as TeX
takes them for an argument.
"""

from __future__ import annotations

import keyword
import re
from typing import NamedTuple

from tests.proofs.reports.nodes import NotRead

SPACING = {
    r"\,",
    r"\;",
    r"\:",
    r"\!",
    r"\ ",
    r"\quad",
    r"\qquad",
    r"\thinspace",
    r"\displaystyle",
    r"\textstyle",
}
SPELLED = {r"\text", r"\mathrm", r"\mathit", r"\textrm", r"\textit"}
SAYING = {  # words between formulas
    "and": ("and",),
    "or": ("or",),
    "not": ("not",),
    "and not": ("and", "not"),
    "or not": ("or", "not"),
    "implies": ("implies",),
    "if and only if": ("iff",),
    "iff": ("iff",),
}
PROSE = {
    *keyword.kwlist,
    "then",
    "where",
    "when",
    "all",
    "every",
    "some",
    "implies",
}  # words that are never names
TOKEN = re.compile(
    r"(?P<space>["
    r" \t\n~]+)|(?P<command>\\(?:[A-Za-z]+|.))|(?P<digit>[0-9])|(?P<letter>[A-Za-z])"
    r"|(?P<mark>[-+/^_{}()\[\]<>=,&'])",
    re.ASCII,
)
CONTENT = re.compile(r"\s*\{([^{}]*)\}")


class Token(NamedTuple):
    # command digit letter mark; spelled: a name in letters; word: and, or, not ..; calligraphic;
    # begin; end; stop
    kind: str
    text: str
    at: int
    after: int  # where the token ends


def tokens(latex: str) -> list[Token]:
    found, at = [], 0
    while at < len(latex):
        match = TOKEN.match(latex, at)
        if not match:
            raise NotRead("no such sign", at, latex)
        start, at, kind, text = at, match.end(), str(match.lastgroup), match[0]
        if kind == "space" or text in SPACING:
            continue
        if text in SPELLED or text in (r"\mathcal", r"\begin", r"\end"):
            inner = CONTENT.match(latex, at)
            if not inner:
                raise NotRead(f"{text} without plain text in braces", start, latex)
            at = inner.end()
            found += [Token(*named, start, at) for named in spelled(text, inner[1], start, latex)]
        else:
            found.append(Token(kind, text, start, at))
    return [*found, Token("stop", "", len(latex), len(latex))]


def spelled(command: str, content: str, start: int, latex: str) -> list[tuple[str, str]]:
    """What a command with plain text in braces comes to."""
    if command not in SPELLED:
        kind = {r"\mathcal": "calligraphic"}.get(command, command[1:])
        return [(kind, content.strip())]
    said = " ".join(content.replace("~", " ").split())
    if said in SAYING:
        if command not in (r"\text", r"\textrm", r"\textit"):
            raise NotRead(f"{command} around a word between formulas", start, latex)
        return [("word", word) for word in SAYING[said]]
    name = said.replace(r"\_", "_")
    if (
        not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name, re.ASCII)
        or "_" in said.replace(r"\_", "")
        or name in PROSE
    ):
        raise NotRead(f"neither a word between formulas nor a name: {content!r}", start, latex)
    return [("letter" if len(name) == 1 else "spelled", name)]
