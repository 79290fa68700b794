"""A reader of LaTeX in the notation of the paper: the independent half of the test of what reports
print.
"""

from __future__ import annotations

from itertools import takewhile

from tests.reports.latex_glyphs import ACCENTS, GREEK, Glyphs
from tests.reports.nodes import (
    Arithmetic,
    Formula,
    Implied,
    Joined,
    Listed,
    Neg,
    Node,
    Not,
    NotRead,
    Num,
    Term,
    Unary,
    chain,
    value,
)
from tests.reports.statement_text import evaluate_statement_text

# -------------------------------------------------------------------------------------------------
# Terms: sums, products, powers, fractions, brackets and vectors.

BRACKETS = {"(": ")", "[": "]", r"\lfloor": r"\rfloor", r"\lceil": r"\rceil"}
SIZES = ("big", "Big", "bigg", "Bigg")
OPENERS = {
    r"\left": r"\right",
    **{f"\\{size}l": f"\\{size}r" for size in SIZES},
    **{f"\\{size}": f"\\{size}" for size in SIZES},
}
FRACTIONS = (r"\frac", r"\tfrac", r"\dfrac")
VECTORS = ("bmatrix", "pmatrix")


class Terms(Glyphs):
    """Terms; what stands in brackets is whatever `statement` reads."""

    def statement(self) -> Node:
        raise NotImplementedError

    def sum(self) -> Node:
        at = self.next().at
        negative = self.took("-")
        left = self.product()
        if negative:
            left = Neg(self.term(left, at))
        while sign := self.took("+", "-"):
            right_at = self.next().at
            left = Arithmetic(sign, self.term(left, at), self.term(self.product(), right_at))
        return left

    def product(self) -> Node:
        at = self.next().at
        if self.next().text in ("+", "-"):
            raise self.fail("ambiguous: a sign after a sign, or a leading plus")
        left, slashed, after_number = self.power(), False, self.ended_number(at)
        while True:
            right_at = self.next().at
            sign = self.took(r"\cdot", r"\times", "/")
            if not sign and not self.starts_factor():
                return left
            if slashed:
                raise self.fail("ambiguous: a product goes on after a slash", right_at)
            if not sign and (
                self.next().kind == "digit"
                or self.next().text == "{"
                and self.next(1).kind == "digit"
            ):
                raise self.fail("ambiguous: a number after a factor", right_at)
            mixed = not sign and after_number and self.next().text in FRACTIONS
            right_start = self.next().at
            right = self.power()
            if (
                mixed
                and isinstance(right, Arithmetic)
                and isinstance(right.left, Num)
                and isinstance(right.right, Num)
            ):
                raise self.fail("ambiguous: a number before a fraction of numbers", right_at)
            slashed, after_number = sign == "/", self.ended_number(right_start)
            left = Arithmetic(
                "/" if slashed else "*", self.term(left, at), self.term(right, right_at)
            )

    def ended_number(self, start: int) -> bool:
        """Whether the factor that began there, and was read just now, is a plain number."""
        read = takewhile(lambda token: token.at >= start, self.tokens[self.at - 1 :: -1])
        return not self.at or all(
            token.kind == "digit" or token.text in ("{", "}") for token in read
        )

    def starts_factor(self) -> bool:
        token = self.next()
        if token.kind == "command":
            named = (
                token.text in GREEK
                or token.text in ACCENTS
                or token.text in FRACTIONS
                or token.text in (r"\sqrt", r"\Delta")
            )
            return named or self.opens()
        return token.kind in (
            "digit",
            "letter",
            "spelled",
            "calligraphic",
            "begin",
        ) or token.text in ("(", "[", "{")

    def opens(self) -> bool:
        token = self.next()
        return token.text in BRACKETS or token.text in OPENERS and self.next(1).text in BRACKETS

    def power(self) -> Node:
        """A factor with its exponent."""
        at = self.next().at
        fraction = self.next().text in FRACTIONS
        base = self.factor()
        if self.next().text != "^":
            return base
        if fraction:
            raise self.fail("ambiguous: an exponent beside a fraction without parentheses")
        self.at += 1
        exponent = self.exponent()
        if self.next().text in ("^", "_", "'"):
            raise self.fail("an exponent with more marks after it")
        return Arithmetic("^", self.term(base, at), exponent)

    def exponent(self) -> Term:
        token = self.next()
        if self.took("{"):
            if self.next().text == "(":
                raise self.fail(
                    "ambiguous: an exponent that begins with a parenthesis may be an order"
                )
            inner = self.term(self.sum(), token.at)
            self.expect("}")
            return inner
        if token.kind == "digit":
            self.at += 1
            return Num(int(token.text))
        if token.kind == "letter" or token.text in GREEK:
            self.at += 1
            return self.name_of((token.text, (), ""), 0, token.at)
        raise self.fail("an exponent is one sign, or stands in braces")

    def factor(self) -> Node:
        token = self.next()
        if token.kind == "digit":
            return self.integer()
        if token.text in FRACTIONS:
            return self.fraction()
        if token.text == r"\sqrt":
            self.at += 1
            return Unary("sqrt", self.argument())
        if token.kind == "begin":
            return self.vector()
        if self.opens():
            return self.bracketed()
        if token.text == r"\Delta":
            return self.change()
        if (
            token.text == "{"
            or token.text in ACCENTS
            or token.text in GREEK
            or token.kind in ("letter", "spelled", "calligraphic")
        ):
            return self.name()
        raise self.fail(
            "expected a term or a formula" if token.kind != "stop" else "the text ends too early"
        )

    def fraction(self) -> Node:
        self.at += 1
        if self.next().text == "{" and self.next(1).text == r"\partial":
            return self.slope()
        upper = self.argument()
        return Arithmetic("/", upper, self.argument())

    def argument(self) -> Term:
        """What a command takes: a term in braces, or one digit, letter or Greek letter."""
        token = self.next()
        if token.text == "{":
            self.at += 1
            inner = self.term(self.sum(), token.at)
            self.expect("}")
            return inner
        if token.kind not in ("digit", "letter") and token.text not in GREEK:
            raise self.fail("an argument is one sign, or stands in braces")
        return self.exponent()

    def bracketed(self) -> Node:
        at, size = self.next().at, self.took(*OPENERS)
        opener = self.took(*BRACKETS)
        inner = self.listed()
        if size:
            self.expect(OPENERS[size])
        self.expect(BRACKETS[opener])
        if self.next().text in ("_", "'"):
            raise self.fail("a mark on a bracket")
        if opener in (r"\lfloor", r"\lceil"):
            return Unary({r"\lfloor": "floor", r"\lceil": "ceil"}[opener], self.term(inner, at))
        return inner

    def listed(self) -> Node:
        """One term or formula, or several terms with commas."""
        at = self.next().at
        entries = [self.statement()]
        while self.took(","):
            entries.append(self.statement())
        return (
            entries[0]
            if len(entries) == 1
            else Listed(tuple(self.term(entry, at) for entry in entries))
        )

    def vector(self) -> Node:
        r"""A column of terms, or the rows of a matrix."""
        kind = self.next().text
        if kind not in VECTORS:
            raise self.fail(f"no such environment: {kind}")
        self.at += 1
        rows = [[self.cell()]]
        while sign := self.took("&", r"\\"):
            if sign == "&":
                rows[-1].append(self.cell())
            else:
                rows.append([self.cell()])
        if (
            self.next().kind != "end"
            or self.next().text != kind
            or len({len(row) for row in rows}) != 1
        ):
            raise self.fail(f"rows of different lengths, or no end of {kind}")
        self.at += 1
        return Listed(tuple(row[0] if len(row) == 1 else Listed(tuple(row)) for row in rows))

    def cell(self) -> Term:
        at = self.next().at
        return self.term(self.sum(), at)


# -------------------------------------------------------------------------------------------------
# LaTeX in the notation of the paper, read back into something that has a value: the independent
# half of the test of what reports print.
#
# `read` understands a text completely or raises NotRead, with the position and the reason.  Nothing
# is shared with the printer, with the parser of prints or with the checker.  Decisions, strict
# wherever a human reader might hesitate:
#
#     -x^2           -(x^2); a sign takes the whole product after it; two signs in a row are refused
#     a/b c          refused, as are a/b/c, a/b \cdot c and 1/2 x: after a slash stands one
#                    factor, and then the product ends
#     x 2, 2\frac12  refused: a number is the first factor of a product, or follows \cdot or \times
#     \frac{a}{b}^2  refused; {x+1} c refused, for plain braces cannot be seen; x^12 refused
#     x (a + b)      a product; x (a, b) a function applied, which is refused
#     and, or        never side by side without parentheses; neither are \implies and \iff; a
#                    relation is never in a relation
#     a < b \le c    a chain in one direction; \ne stands alone
#     \sqrt{a}       has a value where a is the square of a rational number; x^K where K has an
#                    integer as value

__all__ = ["Node", "NotRead", "evaluate_statement_text", "read", "value"]

RELATIONS = {
    **dict.fromkeys(("<", r"\lt"), "<"),
    **dict.fromkeys((r"\le", r"\leq", r"\leqslant"), "<="),
    **dict.fromkeys((">", r"\gt"), ">"),
    **dict.fromkeys((r"\ge", r"\geq", r"\geqslant"), ">="),
    "=": "=",
    **dict.fromkeys((r"\ne", r"\neq"), "!="),
}
DIRECTIONS = ({"<", "<=", "="}, {">", ">=", "="})  # what one chain may hold
CONNECTIVES = {
    **dict.fromkeys((r"\land", r"\wedge"), "and"),
    **dict.fromkeys((r"\lor", r"\vee"), "or"),
    **dict.fromkeys((r"\lnot", r"\neg"), "not"),
    **dict.fromkeys((r"\Rightarrow", r"\implies", r"\Longrightarrow"), "implies"),
    **dict.fromkeys((r"\Leftrightarrow", r"\iff", r"\Longleftrightarrow"), "iff"),
}
LONGEST = 100_000


def read(latex: str) -> Node:
    """The term, formula or vector that the text says."""
    if len(latex) > LONGEST:
        raise NotRead("too long")
    try:
        return _Reading(latex).whole()
    except RecursionError:
        raise NotRead("too deep") from None


class _Reading(Terms):
    """Formulas."""

    def connective(self) -> str:
        token = self.next()
        return (
            token.text
            if token.kind == "word"
            else CONNECTIVES.get(token.text, "")
            if token.kind == "command"
            else ""
        )

    def whole(self) -> Node:
        found = self.statement()
        if self.next().kind != "stop":
            raise self.fail("something is left over")
        return found

    def statement(self) -> Node:
        """One implication or equivalence at most; another needs parentheses."""
        at = self.next().at
        left = self.joined()
        how, in_words = self.connective(), self.next().kind == "word"
        if how not in ("implies", "iff"):
            return left
        several = self.several
        self.at += 1
        right_at = self.next().at
        right = self.joined()
        if self.connective() in ("implies", "iff"):
            raise self.fail("ambiguous: a second implication or equivalence without parentheses")
        if in_words and (several or self.several):
            raise self.fail(
                "ambiguous: an implication in words beside and, or without parentheses", at
            )
        return Implied(how, self.formula(left, at), self.formula(right, right_at))

    def joined(self) -> Node:
        """Formulas joined by `and` alone or by `or` alone."""
        at, how = self.next().at, ""
        parts = [self.negation()]
        while (found := self.connective()) in ("and", "or"):
            if how and found != how:
                raise self.fail("ambiguous: and beside or without parentheses")
            how = found
            self.at += 1
            parts.append(self.negation())
        self.several = bool(how)  # whether what was read last is joined without parentheses
        return Joined(how, tuple(self.formula(part, at) for part in parts)) if how else parts[0]

    def negation(self) -> Node:
        if self.connective() != "not":
            return self.relation()
        in_words = self.next().kind == "word"
        self.at += 1
        at = self.next().at
        if in_words and (bracketed := self.formula_in_brackets()):
            return Not(bracketed)
        denied = Not(self.formula(self.negation(), at))
        if in_words and self.connective():
            raise self.fail("ambiguous: the word not before formulas without parentheses")
        return denied

    def formula_in_brackets(self) -> Formula | None:
        """A formula in brackets of its own; nothing is read where something else stands here."""
        start = self.at
        if self.opens():
            inner = self.bracketed()
            if isinstance(inner, Formula):
                return inner
        self.at = start
        return None

    def relation(self) -> Node:
        at = self.next().at
        sides, signs = [self.sum()], []
        while (token := self.next()).kind in ("mark", "command") and token.text in RELATIONS:
            signs.append(RELATIONS[token.text])
            self.at += 1
            sides.append(self.sum())
        if not signs:
            return sides[0]
        if len(signs) > 1 and not any(set(signs) <= one_way for one_way in DIRECTIONS):
            raise self.fail(
                "ambiguous: a chain of relations in two directions, or with a sign for different",
                at,
            )
        return chain([self.term(side, at) for side in sides], signs)
