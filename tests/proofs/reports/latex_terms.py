"""Terms: sums, products, powers, fractions, brackets and vectors."""

from __future__ import annotations

from tests.proofs.reports.latex_glyphs import ACCENTS, GREEK, Glyphs
from tests.proofs.reports.nodes import Arithmetic, Listed, Neg, Node, Num, Term, Unary

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
        return all(
            token.kind == "digit" or token.text in ("{", "}")
            for token in self.tokens[: self.at]
            if token.at >= start
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
