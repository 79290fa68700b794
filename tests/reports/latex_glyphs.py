"""Tokens of LaTeX mathematics, and the names that they spell."""

from __future__ import annotations

import keyword
import re
from typing import NamedTuple

from tests.reports.nodes import Formula, Name, Node, NotRead, Num, Term

# -------------------------------------------------------------------------------------------------
# The tokens of LaTeX mathematics, with their positions: digits and letters one by one, as TeX takes
# them for an argument.

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


# -------------------------------------------------------------------------------------------------
# Which names of the statement language a printed name may stand for.
#
# From the paper's Table II (\gamma gravity, \alpha restitution, T the period, \dot\rho_0 the
# table's launch speed, \rho its position, \overline\beta and \dot{\overline\beta} the ball's
# position and velocity, sampled; \tau_c the time to collision, \tau_p the time since the table was
# lowest), its equations (E_{max}, \Delta E_{max}, \Delta_1 E, \Delta E_{sup}, \tau_w, z_1) and the
# README's symbols (r, g, beta, v, T, x, w). What the paper uses for something else is refused: r
# and b are states there, and \beta without a bar is the ball between samples. The impact of a
# corner, of which the paper prints no formula, has its own: e restitution, mu friction, sigma a
# direction, omega an angular velocity, B_1 to B_3, impulses P, velocities S and C.

GREEK_LETTERS = (
    "alpha beta gamma delta epsilon varepsilon lambda rho tau chi xi mu nu eta theta kappa sigma"
    " omega pi Gamma".split()
)
PLAIN = {
    letter: letter for letter in "cdhjJkKmnpqstTuwWxyz" + "BCPS" + "GV"
}  # the paper gives none to a state or a region; the last are of the corner, and of the sine
BASES = {  # (base, accents) -> name; subscripts and primes are added to it
    **{(letter, ""): name for letter, name in PLAIN.items()},
    (r"\alpha", ""): "alpha",
    (r"\gamma", ""): "g",
    (r"\beta", "bar"): "beta",
    (r"\beta", "bar dot"): "v",
    (r"\rho", ""): "rho",
    (r"\rho", "dot"): "rho_dot",
    (r"\chi", ""): "chi",
    (r"\chi", "dot"): "chi_dot",
    (r"\tau", ""): "tau",
    (r"\delta", ""): "delta",
    (r"\epsilon", ""): "eps",
    (r"\varepsilon", ""): "eps",
    (r"\lambda", ""): "lam",
    ("E", ""): "E",
    **{(rf"\{name}", ""): name for name in ("mu", "sigma", "omega", "pi", "Gamma")},
}
WHOLE = {  # (base, accents, subscript) -> names
    (r"\rho", "dot", "0"): ("r",),
    (r"\tau", "", "c"): ("tau",),
    (r"\tau", "", "p"): ("since", "tau_p"),
    ("E", "", ""): (),
    ("e", "", ""): ("e",),  # with a subscript it is a fixed point
}
CHANGES = {  # what \Delta, its subscript and what follows stand for
    (r"\Delta", "", "E", ""): ("change", "dE"),
    (r"\Delta", "1", "E", ""): ("change_1", "dE_1"),
    (r"\Delta", "2", "E", ""): ("change_2", "dE_2"),
    (r"\Delta", "", "E", "max"): ("dE_max",),
    (r"\Delta", "", "E", "sup"): ("dE_sup",),
    (r"\Delta", "", "K", ""): ("change", "dK"),
}
OF_ENERGY, OF_MARGIN = (
    ("change", "change_1"),
    "R",
)  # what the paper differentiates: \Delta_1 E and R
PRIMED = ("_after", "_next")
NEXT = "k+1"
FUNCTIONS = ("max", "min", "sup", "inf", "sqrt", "sin", "cos", "exp", "log")
ON_PAPER = frozenset(BASES.values()) | {
    "r",
    "v",
    "g",
}  # names that have a glyph of their own, so that they are never spelled out


def names_for(base: str, accents: tuple[str, ...], subscript: str, primes: int) -> tuple[str, ...]:
    """The names that a glyph may stand for; NotRead where it is none that statements use."""
    kind = " ".join(sorted(accents))
    if len(set(accents)) != len(accents) or primes > 1:
        raise NotRead("a name with an accent twice, or with two primes")
    if (base, kind, subscript) in WHOLE and not primes:
        names = WHOLE[base, kind, subscript]
    else:
        stem = BASES.get((base, kind)) or spelled_out(base, kind)
        if not stem:
            raise NotRead(
                f"{' '.join((*accents, base))} is not a name of statements, or the paper gives it"
                " another meaning"
            )
        names = subscripted(stem, subscript)
    if not names:
        raise NotRead(f"{base} alone is a function in the paper")
    return tuple(name + mark for name in names for mark in PRIMED) if primes else names


def subscripted(stem: str, subscript: str) -> tuple[str, ...]:
    if subscript == NEXT:
        return (stem + "_next",)
    if subscript.isdigit():
        return (stem + subscript, f"{stem}_{subscript}")  # a premise of a map rule names states so
    return (stem + "_" * bool(subscript) + subscript,)


def spelled_out(base: str, kind: str) -> str:
    """A name written out in letters, such as `size` or `ball_after`, and with a dot
    `folded_dot`.
    """
    if (
        kind not in ("", "dot")
        or base in FUNCTIONS
        or not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]+", base, re.ASCII)
    ):
        return ""
    stem = re.match(r"[A-Za-z]+", base)
    if not stem or stem[0] in ON_PAPER and not re.fullmatch(rf"{stem[0]}_[a-z]+", base):
        return ""
    return base + ("_dot" if kind else "")


# -------------------------------------------------------------------------------------------------
# A place in the tokens of a text, and the names that start there: base, accents, subscripts and
# primes.

ACCENTS = {r"\bar": "bar", r"\overline": "bar", r"\dot": "dot"}
GREEK = {"\\" + letter for letter in GREEK_LETTERS}
LIMITS = {r"\max": "max", r"\min": "min", r"\sup": "sup", r"\inf": "inf"}
Glyph = tuple[str, tuple[str, ...], str]  # base, accents, subscript


class Cursor:
    """Where a reading stands."""

    def __init__(self, latex: str) -> None:
        self.latex, self.tokens, self.at = latex, tokens(latex), 0

    def next(self, ahead: int = 0) -> Token:
        return self.tokens[min(self.at + ahead, len(self.tokens) - 1)]

    def fail(self, reason: str, at: int | None = None) -> NotRead:
        return NotRead(reason, self.next().at if at is None else at, self.latex)

    def took(self, *wanted: str) -> str:
        token = self.next()
        if token.kind in ("mark", "command") and token.text in wanted:
            self.at += 1
            return token.text
        return ""

    def expect(self, wanted: str) -> None:
        if not self.took(wanted):
            raise self.fail(f"expected {wanted}")

    def term(self, node: Node, at: int) -> Term:
        if not isinstance(node, Term):
            raise self.fail(
                "a formula or list stands where a term is expected: no function is applied here", at
            )
        return node

    def formula(self, node: Node, at: int) -> Formula:
        if not isinstance(node, Formula):
            raise self.fail("a term or list stands where a formula is expected", at)
        return node


class Glyphs(Cursor):
    """Names."""

    def name(self) -> Name | Num:
        """A name with accents, subscript and primes; a number or a name may stand in braces, and
        takes its marks outside.
        """
        at = self.next().at
        if self.next().text == "{" and self.next(1).kind == "digit":
            self.at += 1
            found = self.integer()
            self.expect("}")
            return found
        glyph = self.glyph()
        # an exponent may be printed before the subscript: \dot{\overline\beta}^2_0
        if self.next().text == "^" and self.next(2).text == "_":
            self.tokens[self.at : self.at + 2], moved = [], self.tokens[self.at : self.at + 2]
            glyph = self.marked(glyph)
            self.tokens[self.at : self.at] = moved
        primes = 0
        while self.took("'"):
            primes += 1
        if self.next().text == "_":
            glyph = self.marked(glyph)
        return self.name_of(glyph, primes, at)

    def glyph(self) -> Glyph:
        token = self.next()
        if self.took("{"):
            glyph = self.glyph()
            self.expect("}")
            return self.marked(glyph)
        if accent := self.took(*ACCENTS):
            inner = self.next()
            if inner.text in ACCENTS or inner.kind in ("spelled", "calligraphic"):
                raise self.fail("what an accent stands on is one sign, or stands in braces")
            if inner.text == "{":
                base, accents, subscript = self.glyph_in_braces()
            else:
                base, accents, subscript = self.letter()
            return self.marked((base, (ACCENTS[accent], *accents), subscript))
        if token.kind == "calligraphic":
            raise self.fail("a calligraphic letter is a region, not a number")
        return self.marked(self.letter())

    def glyph_in_braces(self) -> Glyph:
        self.expect("{")
        glyph = self.glyph()
        self.expect("}")
        return glyph

    def letter(self) -> Glyph:
        token = self.next()
        if token.kind not in ("letter", "spelled") and token.text not in GREEK:
            raise self.fail("expected a name")
        self.at += 1
        return (token.text, (), "")

    def marked(self, glyph: Glyph) -> Glyph:
        if not self.took("_"):
            return glyph
        base, accents, subscript = glyph
        if subscript:
            raise self.fail("a second subscript")
        return (base, accents, self.subscript())

    def subscript(self) -> str:
        """0, max, next, R, k+1 .. as text."""
        if not self.took("{"):
            token = self.next()
            if token.kind not in ("digit", "letter") and token.text not in LIMITS:
                raise self.fail("a subscript is one sign, or stands in braces")
            self.at += 1
            return LIMITS.get(token.text, token.text)
        parts = []
        while not self.took("}"):
            token = self.next()
            if (
                token.kind not in ("digit", "letter", "spelled", "calligraphic")
                and token.text not in LIMITS
                and token.text != "+"
            ):
                raise self.fail("not a subscript of a name")
            self.at += 1
            parts.append(LIMITS.get(token.text, token.text))
        said = "".join(parts)
        if not said or not said.isalpha() and not said.isdigit() and said != NEXT:
            raise self.fail("not a subscript of a name")
        return said

    def name_of(self, glyph: Glyph, primes: int, at: int) -> Name:
        base, accents, subscript = glyph
        try:
            names = names_for(base, accents, subscript, primes)
        except NotRead as refused:
            raise self.fail(refused.reason, at) from None
        shown = " ".join((*accents, base)) + (f"_{subscript}" if subscript else "") + "'" * primes
        return Name(shown, names)

    def change(self) -> Name:
        r"""\Delta E, \Delta_1 E, \Delta E_{max}: one name each."""
        at = self.next().at
        self.expect(r"\Delta")
        which = self.subscript() if self.took("_") else ""
        if self.next().kind != "letter":
            raise self.fail("the change of what?")
        of, _, subscript = self.marked(self.letter())
        names = CHANGES.get((r"\Delta", which, of, subscript))
        if not names:
            raise self.fail("no such change", at)
        if self.next().text in ("_", "'") or self.next().text == "^" and self.next(2).text == "_":
            raise self.fail("a mark on a change")
        return Name(
            rf"\Delta{'_' * bool(which)}{which} {of}{'_' * bool(subscript)}{subscript}", names
        )

    def slope(self) -> Name:
        r"""\frac{\partial \Delta_1 E}{\partial \overline\beta}: one name."""
        at = self.next().at
        self.expect("{")
        self.expect(r"\partial")
        if self.next().text == r"\Delta":
            what = "dE" if self.change().stands_for[0] in OF_ENERGY else ""
        else:
            what = "dR" if self.next().text == OF_MARGIN else ""
            self.at += 1
        self.expect("}")
        self.expect("{")
        self.expect(r"\partial")
        by = self.name()
        self.expect("}")
        if not what or not isinstance(by, Name) or by.stands_for not in (("beta",), ("v",)):
            raise self.fail("no such derivative", at)
        name = f"{what}_d{by.stands_for[0]}"
        return Name(name, (name,))

    def integer(self) -> Num:
        digits, after = "", self.next().at
        while (token := self.next()).kind == "digit":
            if token.at != after:
                raise self.fail("ambiguous: a number with a space inside")
            digits, after = digits + token.text, token.after
            self.at += 1
        if len(digits) > 1 and digits[0] == "0":
            raise self.fail("a number that begins with 0")
        return Num(int(digits))
