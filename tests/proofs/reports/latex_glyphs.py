"""A place in the tokens of a text, and the names that start there: base, accents, subscripts and
primes.
"""

from __future__ import annotations

from tests.proofs.reports import latex_names
from tests.proofs.reports.latex_tokens import Token, tokens
from tests.proofs.reports.nodes import Formula, Name, Node, NotRead, Num, Term

ACCENTS = {r"\bar": "bar", r"\overline": "bar", r"\dot": "dot"}
GREEK = {"\\" + letter for letter in latex_names.GREEK}
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
        if not said or not said.isalpha() and not said.isdigit() and said != latex_names.NEXT:
            raise self.fail("not a subscript of a name")
        return said

    def name_of(self, glyph: Glyph, primes: int, at: int) -> Name:
        base, accents, subscript = glyph
        try:
            names = latex_names.names_for(base, accents, subscript, primes)
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
        names = latex_names.CHANGES.get((r"\Delta", which, of, subscript))
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
            what = "dE" if self.change().stands_for[0] in latex_names.OF_ENERGY else ""
        else:
            what = "dR" if self.next().text == latex_names.OF_MARGIN else ""
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
