"""Names, terms and formulas of statements as LaTeX in the paper's notation, and the macros for
it.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache, partial

from juggleproof.certificates import checker
from juggleproof.papers.paper import opened

# -------------------------------------------------------------------------------------------------
# The names of statements in the notation of the paper; names that it lacks are made from their
# letters.
#
# The notation table of a report is this table with its explanations.


def glyph(name: str) -> str:
    r"""A name of a statement as LaTeX.

    >>> glyph("v"), glyph("beta0"), glyph("z2")
    ('\\dot{\\bar\\beta}', '\\bar\\beta_0', 'z_2')
    >>> glyph("v_next"), glyph("lift")
    ('\\dot{\\bar\\beta}_{\\mathrm{next}}', '\\mathit{lift}')
    """
    glyphs = opened().notation.glyphs
    if name in glyphs:
        return glyphs[name]
    base, _, below = name.partition("_")
    digits = re.fullmatch(r"([A-Za-z]+)(\d+)", base)
    if digits and not below:
        base, below = digits.group(1), digits.group(2)
    shown = glyphs.get(base, base if len(base) == 1 else rf"\mathit{{{base}}}")
    if not below:
        return shown
    if below in glyphs or len(below) == 1:
        return f"{shown}_{glyphs.get(below, below)}"
    return (
        f"{shown}_{{{below}}}"
        if below.isdecimal()
        else rf"{shown}_{{\mathrm{{{below.replace('_', ' ')}}}}}"
    )


# -------------------------------------------------------------------------------------------------
# Terms and formulas of the statement language as LaTeX, in the paper's notation and with terms and
# factors in the paper's order.
#
# The LaTeX is made from the text of the statement itself: sums and products are reordered, signs
# are collected, and nothing else is changed.

RELATIONS: Mapping[type, str] = {
    ast.Lt: "<",
    ast.LtE: r"\le",
    ast.Gt: ">",
    ast.GtE: r"\ge",
    ast.Eq: "=",
    ast.NotEq: r"\ne",
}
JOINED: Mapping[str, tuple[int, str]] = {
    "iff": (1, r"\iff"),
    "implies": (2, r"\implies"),
    "or": (3, r"\lor"),
    "and": (4, r"\land"),
}


def latex_of(text: str, like: str = "") -> str:
    r"""A term or formula of the statement language as LaTeX; the names in the text `like` come
    first in the order of factors and addends.

    >>> latex_of("beta*g + v^2/2")
    '\\gamma\\bar\\beta + \\frac{1}{2}\\dot{\\bar\\beta}^2'
    >>> latex_of("r^2*(alpha + 1)/(2*(1 - alpha))")
    '\\frac{1}{2}\\frac{1 + \\alpha}{1 - \\alpha}\\dot\\rho_0^2'
    >>> latex_of("iff(x < w, not alpha*w >= 1)")
    'x < w \\iff \\lnot (\\alpha w \\ge 1)'
    """
    return _cached(text, like)


@cache
def _cached(text: str, like: str) -> str:
    printer = _Printer(names_in_order(like) if like else [])
    node = checker.parse(text)
    return printer.formula(node, 0) if _is_formula(node) else printer.term(node)


def names_in_order(text: str) -> list[str]:
    """The names of a term or formula in order of first occurrence."""
    names = [
        (node.lineno, node.col_offset, node.id)
        for node in ast.walk(checker.parse(text))
        if isinstance(node, ast.Name)
    ]
    return [name for *_, name in sorted(names)]


def _is_formula(node: ast.AST) -> bool:
    return (
        isinstance(node, (ast.Compare, ast.BoolOp, ast.Call))
        or isinstance(node, ast.UnaryOp)
        and isinstance(node.op, ast.Not)
    )


def _names(node: ast.AST) -> frozenset[str]:
    return frozenset(one.id for one in ast.walk(node) if isinstance(one, ast.Name))


class _Printer:
    def __init__(self, leads: Sequence[str]) -> None:
        paper = opened()
        self.leads, self.first = leads, frozenset({paper.parameter})
        names = dict.fromkeys([*leads, *paper.notation.order])
        self.rank = {name: place for place, name in enumerate(names)}

    # ------------------------------------------------------------ formulas

    def formula(self, node: ast.AST, level: int) -> str:
        if isinstance(node, ast.Compare):
            signs = [RELATIONS[type(op)] for op in node.ops]
            return self.term(node.left) + "".join(
                f" {sign} {self.term(side)}" for sign, side in zip(signs, node.comparators)
            )
        if isinstance(node, ast.UnaryOp):
            inner = self.formula(node.operand, 6)
            return (
                rf"\lnot ({inner})" if isinstance(node.operand, ast.Compare) else rf"\lnot {inner}"
            )
        if isinstance(node, ast.BoolOp):
            word, parts = "and" if isinstance(node.op, ast.And) else "or", node.values
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            word, parts = node.func.id, node.args
        else:
            raise TypeError(f"no formula: {ast.dump(node)}")
        if word not in JOINED:  # a function, such as E(t)
            raise TypeError(f"no formula: {ast.dump(node)}")
        own, sign = JOINED[word]
        text = f" {sign} ".join(self.formula(part, own + 1 + (word == "or")) for part in parts)
        return rf"({text})" if own < level else text

    # ------------------------------------------------------------ sums

    def term(self, node: ast.AST) -> str:
        shown = ""
        for minus, text in self.addends(node):
            shown += (" - " if minus else " + ") + text if shown else ("-" if minus else "") + text
        return shown

    def addends(self, node: ast.AST) -> list[tuple[bool, str]]:
        """The addends in the paper's order, each with whether it is subtracted; zeros are left out
        unless nothing else remains.
        """
        found = []
        for sign, addend in _numbers_added(_flat_sum(node, 1)):
            text, negative = self.product(addend)
            if text != "0":
                found.append((addend, negative != (sign < 0), text))
        if (
            len(found) == 2 and not _names(node) - self.first
        ):  # the paper writes 1 + alpha, 1 - alpha and alpha - 1
            found.sort(
                key=lambda one: bool(_names(one[0])) if not one[1] else 1 + (not _names(one[0]))
            )
        elif self.leads:
            found.sort(key=lambda one: self.place(one[0]))
        if found and found[0][1] and not self.leads:
            first = next((one for one in found if not one[1]), found[0])
            found = [first, *(one for one in found if one is not first)]
        return [(minus, text) for _, minus, text in found] or [(False, "0")]

    def place(self, node: ast.AST) -> tuple[int, ...]:
        return tuple(
            sorted(
                (self.rank.get(name, len(self.rank)) for name in _names(node) - self.first),
                reverse=True,
            )
        )

    # ------------------------------------------------------------ products

    def product(self, node: ast.AST) -> tuple[str, bool]:
        """A product or quotient as LaTeX without its sign, and whether it is negative."""
        above, below, number = list[ast.AST](), list[ast.AST](), Fraction(1)
        for factor, inverted in _flat_product(node):
            value = _number(factor)
            if value is None or inverted and not value:
                (below if inverted else above).append(factor)
            else:
                number *= 1 / value if inverted else value
        text = self.quotient(
            abs(number),
            sorted(_powers_joined(above), key=self.factor_place),
            sorted(_powers_joined(below), key=self.factor_place),
        )
        return text, number < 0

    def quotient(self, number: Fraction, above: Sequence[ast.AST], below: Sequence[ast.AST]) -> str:
        whole, part = number.numerator, number.denominator
        if not whole:
            return "0"
        if not below:
            if part == 1:
                return (
                    self.bracketed(above[0])
                    if whole == 1 and len(above) == 1 and _is_sum(above[0])
                    else self.row(whole, above)
                )
            if not above or len(above) == 1 and _is_sum(above[0]):
                return _fraction(self.row(whole, above), str(part))
            return _side_by_side([_fraction(str(whole), str(part)), *map(self.factor, above)])
        of_first = [factor for factor in above if _names(factor) <= self.first]
        if (
            not any(_names(factor) - self.first for factor in below)
            and of_first
            and (part != 1 or any(map(_is_sum, map(_base, of_first))))
        ):
            rest = [factor for factor in above if factor not in of_first]
            if len(rest) != 1 or not _is_sum(rest[0]) or of_first:
                numeral = [_fraction(str(whole), str(part))] if part != 1 else []
                inner = _fraction(self.row(1 if numeral else whole, of_first), self.row(1, below))
                return _side_by_side([*numeral, inner, *map(self.factor, rest)])
        return _fraction(self.row(whole, above), self.row(part, below))

    def row(self, number: int, factors: Sequence[ast.AST]) -> str:
        """A number and factors side by side; a sum needs no brackets where it stands alone."""
        if number == 1 and len(factors) == 1:
            return self.term(factors[0]) if _is_sum(factors[0]) else self.factor(factors[0])
        return _side_by_side(
            [*([str(number)] if number != 1 or not factors else []), *map(self.factor, factors)]
        )

    def factor_place(self, node: ast.AST) -> tuple[int, int]:
        names = _names(node)
        if names <= self.first:
            return (0, int(_is_sum(_base(node))))
        return (
            1 + max(self.rank.get(name, len(self.rank)) for name in names),
            int(_is_sum(_base(node))),
        )

    def factor(self, node: ast.AST) -> str:
        if (
            isinstance(node, ast.BinOp)
            and isinstance(node.op, ast.Pow)
            and isinstance(node.right, ast.Constant)
        ):
            exponent = str(node.right.value)
            if exponent == "1":
                return self.factor(node.left)
            base = (
                self.factor(node.left)
                if isinstance(node.left, ast.Name)
                else self.bracketed(node.left)
            )
            base = rf"\left({base}\right)" if base.startswith(r"\frac") else base
            return f"{base}^{exponent if len(exponent) == 1 else '{' + exponent + '}'}"
        if isinstance(node, (ast.Name, ast.Constant)):
            return glyph(node.id) if isinstance(node, ast.Name) else str(node.value)
        if not isinstance(node, (ast.BinOp, ast.UnaryOp)) or isinstance(
            getattr(node, "op", None), ast.Pow
        ):
            raise TypeError(f"no term: {ast.unparse(node)}")
        return self.bracketed(node)

    def bracketed(self, node: ast.AST) -> str:
        text = self.term(node)
        return (
            text
            if isinstance(node, ast.Constant) or is_bracketed(text)
            else rf"\left({text}\right)"
            if r"\frac" in text
            else f"({text})"
        )


def is_bracketed(text: str) -> bool:
    """Whether one pair of round brackets encloses the whole text."""
    depth = 0
    for place, sign in enumerate(text):
        depth += (sign == "(") - (sign == ")")
        if not depth:
            return sign == ")" and place == len(text) - 1
    return False


def _fraction(above: str, below: str) -> str:
    return rf"\frac{{{above}}}{{{below}}}"


def _number(node: ast.AST) -> Fraction | None:
    """The value of a factor that is a numeral, a minus sign, or a power of a numeral; else None."""
    if isinstance(node, ast.UnaryOp):
        return Fraction(-1)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        base, exponent = _integer(node.left), _integer(node.right)
        return None if base is None or exponent is None else Fraction(base**exponent)
    whole = _integer(node)
    return None if whole is None else Fraction(whole)


def _integer(node: ast.AST) -> int | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, int) else None


def _side_by_side(pieces: Sequence[str]) -> str:
    """Factors in a row, with a space where LaTeX would run a command and a letter together, and a
    dot between numerals.
    """
    shown = ""
    for piece in pieces:
        if shown and shown[-1].isdigit() and piece[:1].isdigit():
            shown += r" \cdot "
        elif re.search(r"\\[A-Za-z]+$", shown) and piece[:1].isalpha():
            shown += " "
        shown += piece
    return shown


def _is_sum(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub))


def _power(node: ast.AST) -> tuple[ast.AST, int | None]:
    """Base and exponent; None for an exponent that is no whole number."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        return node.left, _integer(node.right)
    return node, 1


def _base(node: ast.AST) -> ast.AST:
    return _power(node)[0]


def _numbers_added(addends: list[tuple[int, ast.AST]]) -> list[tuple[int, ast.AST]]:
    """The addends with all whole numbers added up, at the place of the first one."""
    places = [place for place, (_, node) in enumerate(addends) if _integer(node) is not None]
    if len(places) < 2 or len(places) == len(addends):
        return addends
    total = sum(addends[place][0] * (_integer(addends[place][1]) or 0) for place in places)
    added = (1 if total >= 0 else -1, ast.Constant(abs(total)))
    return [
        added if place == places[0] else addend
        for place, addend in enumerate(addends)
        if place not in places[1:]
    ]


def _powers_joined(factors: list[ast.AST]) -> list[ast.AST]:
    """The factors with all powers of a name multiplied to one power."""
    exponents: dict[str, int] = {}
    others = []
    for factor in factors:
        base, exponent = _power(factor)
        if isinstance(base, ast.Name) and exponent is not None:
            exponents[base.id] = exponents.get(base.id, 0) + exponent
        else:
            others.append(factor)
    joined = [
        ast.parse(f"{name}**{exponent}" if exponent != 1 else name, mode="eval").body
        for name, exponent in exponents.items()
    ]
    return [*joined, *others]


def _flat_sum(node: ast.AST, sign: int) -> list[tuple[int, ast.AST]]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
        return [
            *_flat_sum(node.left, sign),
            *_flat_sum(node.right, -sign if isinstance(node.op, ast.Sub) else sign),
        ]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return _flat_sum(node.operand, -sign)
    return [(sign, node)]


def _flat_product(node: ast.AST, inverted: bool = False) -> list[tuple[ast.AST, bool]]:
    """The factors, each with whether it divides; a minus is the unary operator itself."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Mult, ast.Div)):
        return [
            *_flat_product(node.left, inverted),
            *_flat_product(node.right, inverted != isinstance(node.op, ast.Div)),
        ]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return [(node, False), *_flat_product(node.operand, inverted)]
    return [(node, inverted)]


# -------------------------------------------------------------------------------------------------
# The notation macros of the LaTeX reports, one for each of the paper's accented names and regions,
# so that an author can change the notation in one place.

PREFIX = "jug"
_NARROW = re.compile(
    r"\\overline(?=\s*(?:\{\s*(?:\\[A-Za-z]+|[A-Za-z])\s*\}|\\[A-Za-z]+|[A-Za-z]))"
)


def narrow(latex: str) -> str:
    r"""The LaTeX with \bar for each bar over one letter.

    >>> narrow(r"\dot{\overline{\beta}} + \overline b")
    '\\dot{\\bar{\\beta}} + \\bar b'
    """
    return _NARROW.sub(r"\\bar", latex)


def with_macros(latex: str) -> str:
    r"""The same LaTeX with the notation macros, and with spaces between words and formulas.

    >>> with_macros(r"\gamma\overline{\beta} + \frac{1}{2} \dot{\overline{\beta}}^2")
    '\\juggravity\\jugheight + \\frac{1}{2} \\jugspeed^2'
    >>> with_macros(r"a = b \text{so that} c = d")
    'a = b \\text{ so that } c = d'
    """
    shown = re.sub(r"(?<!^)\\text\{ ?([^{}]*?) ?\}(?!$)", r"\\text{ \1 }", narrow(latex))
    for name, _, pattern in opened().notation.macros:
        set_as = partial(_macro, f"\\{PREFIX}{name}")
        shown = re.sub(pattern + r"(\s*)(?=(.?))", set_as, shown, flags=re.DOTALL)
    return shown


def _macro(macro: str, match: re.Match[str]) -> str:
    """The macro, with a space before a letter that follows."""
    return macro + (" " if match[2].isalpha() else match[1])


def without_macros(latex: str) -> str:
    r"""The LaTeX with every notation macro replaced by its meaning.

    >>> without_macros(r"\juggravity T")
    '\\gamma T'
    """
    for name, means, _ in opened().notation.macros:
        meaning = means.replace("\\", r"\\")  # re.sub reads backslashes in the replacement
        latex = re.sub(rf"\\{PREFIX}{name}(?![A-Za-z])", meaning, latex)
    return latex
