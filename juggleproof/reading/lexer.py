"""The tokens of a print, the commands that a print may use, and the error for one that cannot be
read.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from juggleproof.statements.language import ClaimError

# -------------------------------------------------------------------------------------------------
# The error of a print: a single line that names the token and its column.


class PrintError(ClaimError):
    r"""The error of a print that cannot be read, or has no meaning in its environment.

    >>> str(PrintError(4, r"unknown command \foo"))
    'column 5: unknown command \\foo'
    """

    def __init__(self, at: int, problem: str) -> None:
        super().__init__(f"column {at + 1}: {problem}")
        self.column = at + 1
        self.problem = problem


# -------------------------------------------------------------------------------------------------
# The commands that a print may use, in tables: those that are dropped, other spellings, operators.

# Layout and fonts: they carry no meaning and are dropped.
DROPPED = frozenset(
    rf"\{word}"
    for word in (
        "quad qquad displaystyle textstyle limits nolimits nonumber notag allowbreak "
        "mathrm mathbf mathit mathsf boldsymbol pmb bm rm bf it"
    ).split()
)

# Environments that are only layout: their line ends and & marks join the lines.
LAYOUT = frozenset(
    "split aligned align align* alignedat gathered gather gather* equation equation*"
    " multline".split()
)
# Environments whose & and line ends separate cells.
TABLES = frozenset("bmatrix pmatrix matrix array cases".split())

SAME = {
    r"\overline": r"\bar",
    r"\leq": r"\le",
    r"\leqslant": r"\le",
    r"\geq": r"\ge",
    r"\geqslant": r"\ge",
    r"\neq": r"\ne",
    r"\to": r"\rightarrow",
    r"\mid": "|",
    r"\vert": "|",
    r"\lvert": "|",
    r"\rvert": "|",
    r"\lbrace": r"\{",
    r"\rbrace": r"\}",
    r"\dfrac": r"\frac",
    r"\tfrac": r"\frac",
    r"\ast": "*",
    r"\mathscr": r"\mathcal",
    r"\colon": ":",
}

LETTERS = frozenset(
    rf"\{word}"
    for word in (
        "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu"
        " xi pi rho varrho sigma tau upsilon phi varphi chi psi omega Gamma Theta Lambda Xi Pi"
        " Sigma Upsilon Phi Psi Omega ell infty emptyset"
    ).split()
)

# Commands over or around a letter that make another name of it.  Two dots are `dot` twice:
# \ddot x = \dot{\dot x}.
ACCENTS = {
    r"\bar": ("bar",),
    r"\dot": ("dot",),
    r"\ddot": ("dot", "dot"),
    r"\hat": ("hat",),
    r"\tilde": ("tilde",),
    r"\vec": ("vec",),
    r"\mathcal": ("script",),
    r"\mathbb": ("blackboard",),
}

RELATIONS = frozenset(
    (
        "=",
        ":=",
        "<",
        ">",
        r"\le",
        r"\ge",
        r"\ne",
        r"\in",
        r"\notin",
        r"\subset",
        r"\subseteq",
        r"\equiv",
        r"\rightarrow",
    )
)

# Infix operators with their binding power; juxtaposition binds more tightly than all of them.
BINARY = {
    r"\cup": 20,
    r"\cap": 22,
    "+": 30,
    "-": 30,
    r"\setminus": 30,
    "*": 40,
    r"\cdot": 40,
    r"\times": 40,
    "/": 40,
    r"\circ": 45,
}
SIGN = 35  # the binding power of a leading minus: -a b + c is (-(a b)) + c

EXTREMA = frozenset((r"\max", r"\min", r"\sup", r"\inf"))
OPERATORS = frozenset((r"\Delta", r"\partial", r"\nabla"))
BRACKETS = {"(": ")", "[": "]", r"\lfloor": r"\rfloor", r"\lceil": r"\rceil"}

OTHER = frozenset((r"\frac", r"\sqrt", r"\forall", r"\lim", r"\prime", r"\{", r"\}"))
KNOWN = (
    LETTERS
    | ACCENTS.keys()
    | {sign for sign in RELATIONS if sign[0] == "\\"}
    | {sign for sign in BINARY if sign[0] == "\\"}
    | EXTREMA
    | OPERATORS
    | {r"\lfloor", r"\rfloor", r"\lceil", r"\rceil"}
    | OTHER
)


# -------------------------------------------------------------------------------------------------
# LaTeX to tokens with their positions; spacing, fonts and layout are dropped, an unknown command is
# refused.
#
# A line end joins two lines where the next one begins with a relation or an infix operator, also
# with a minus; otherwise it separates two parts of a display.

_PATTERN = re.compile(
    r"""
      (?P<space>  \s+ | ~ | \\[,;:!>\ ] | \\(?:tag|label)\*?\s*\{[^{}]*\}
                      | \\hspace\*?\s*\{[^{}]*\} )
    | (?P<sized>  \\(?:left|right|middle|[bB]igg?[lrm]?)(?![A-Za-z])\s*(?P<delimiter>
                      \\[{}] | [()\[\]|./]
                    | \\(?:lfloor|rfloor|lceil|rceil|mid|[lr]?vert|lbrace|rbrace)(?![A-Za-z]) ))
    | (?P<line>   \\\\(?:\[[0-9.]+(?:pt|em|ex|mm)\])? )
    | (?P<table>  \\(?P<edge>begin|end)\s*\{(?P<environment>[A-Za-z]+\*?)\}
                    (?:(?<=array\})\s*\{[lcr|\s]*\})? )
    | (?P<text>   \\(?:text|textrm|textit|mbox)\s*\{(?P<words>[^{}]*)\} )
    | (?P<command>\\[A-Za-z]+ | \\[{}] )
    | (?P<number> [0-9]+(?:\.[0-9]+)? )
    | (?P<letter> [A-Za-z] )
    | (?P<define> :\s*= )
    | (?P<symbol> [-+*/^_{}()\[\]|,;.:'=<>&] )
    """,
    re.VERBOSE,
)
_ENDS = frozenset(BINARY) | RELATIONS | frozenset((",", "(", "["))
_GOES_ON = frozenset(BINARY) | RELATIONS | frozenset((")", "]", r"\}", ",", "."))


@dataclass(frozen=True, slots=True)
class Token:
    """A piece of a print: its kind, its text in normal spelling, and where it starts and ends."""

    kind: str  # number, letter, command, symbol, accent, begin, end, text, line, stop
    text: str
    start: int
    end: int


@lru_cache(maxsize=4096)
def lex(latex: str) -> tuple[Token, ...]:
    r"""The tokens of a print, closed by one of kind `stop`.

    >>> [token.text for token in lex(r"\Delta_1\,E \leq \overline{\beta}.")][:6]
    ['\\Delta', '_', '1', 'E', '\\le', '\\bar']
    >>> lex(r"\alpha \foo")
    Traceback (most recent call last):
    juggleproof.reading.lexer.PrintError: column 8: unknown command \foo
    """
    return tuple(_joined(_raw(latex)))


def _raw(latex: str) -> list[Token]:
    tokens: list[Token] = []
    at, match_at = 0, _PATTERN.match
    while at < len(latex):
        match = match_at(latex, at)
        if match is None:
            word = latex[at : at + 2] if latex[at] == "\\" else latex[at]
            raise PrintError(at, f"unknown character {word}")
        kind, text, end = str(match.lastgroup), match.group(), match.end()
        if match.group("sized"):
            text = match.group("delimiter")
            text = SAME.get(text, text)
            if text != ".":
                tokens.append(Token("command" if text[0] == "\\" else "symbol", text, at, end))
        elif match.group("table"):
            tokens.append(
                Token(match.group("edge"), _environment(match.group("environment"), at), at, end)
            )
        elif match.group("text"):
            tokens.append(Token("text", match.group("words").strip(), at, end))
        elif kind == "command":
            text = SAME.get(text, text)
            if text not in DROPPED:
                tokens.append(Token(_kind_of(text, latex[at:end], at), text, at, end))
        elif kind == "define":
            tokens.append(Token("symbol", ":=", at, end))
        elif kind != "space":
            tokens.append(Token(kind, text, at, end))
        at = end
    tokens.append(Token("stop", "the end of the print", len(latex), len(latex)))
    return tokens


def _environment(name: str, at: int) -> str:
    if name not in TABLES and name not in LAYOUT:
        raise PrintError(at, f"unknown environment {name}")
    return name


def _kind_of(command: str, spelled: str, at: int) -> str:
    if command in LETTERS:
        return "letter"
    if command in ACCENTS:
        return "accent"
    if command[0] != "\\":
        return "symbol"
    if command not in KNOWN:
        raise PrintError(at, f"unknown command {spelled}")
    return "command"


def _joined(tokens: list[Token]) -> list[Token]:
    """The tokens without layout environments, alignment marks, and line ends in the middle of a
    formula.
    """
    kept: list[Token] = []
    open_tables: list[Token] = []
    for token in tokens:
        if token.kind == "begin":
            open_tables.append(token)
        elif token.kind == "end":
            if not open_tables or open_tables[-1].text != token.text:
                raise PrintError(token.start, rf"\end{{{token.text}}} closes nothing")
            open_tables.pop()
        if token.kind in ("begin", "end") and token.text in LAYOUT:
            continue
        inside = any(table.text in TABLES for table in open_tables)
        if token.text == "&" and not inside:
            continue
        if (
            kept
            and kept[-1].kind == "line"
            and not inside
            and (token.text in _GOES_ON or token.kind in ("line", "stop"))
        ):
            kept.pop()
        if token.kind == "line" and not inside and (not kept or kept[-1].text in _ENDS):
            continue
        kept.append(token)
    if open_tables:
        raise PrintError(
            open_tables[-1].start, rf"\begin{{{open_tables[-1].text}}} is never closed"
        )
    return kept
