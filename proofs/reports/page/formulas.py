"""Sentences, statements and values with their formulas as MathML."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from html import escape

from proofs.reports.latex import latex_of
from proofs.reports.names import glyph
from proofs.reports.page.mathml import mathml
from proofs.reports.prose import pieces
from proofs.reports.statements import WORDS, parts_of

NAMES = ("exists", "integer", "over", "state")
FORMULAS = (
    "given",
    "have",
    "show",
    "with",
    "domain",
    "holds",
    "space",
    "stage",
    "rank",
    "on",
    "rate",
    "radius",
    "size",
)
TUPLES = ("point", "start", "weights")
LINKS = ("sharp", "map", "descent", "contraction", "attraction", "escape")
ONE_LINE = {
    "show": 144,
    "with": 144,
    "holds": 144,
}  # characters of a formula that stands in one line
ELSE = 64
ARROW = r"\mapsto"


@dataclass(frozen=True)
class Row:
    """A line of a statement: the word for its keyword, and what it says as markup, in parts between
    which a line may break; or names to link to.
    """

    word: str
    parts: tuple[str, ...] = ()
    links: tuple[str, ...] = ()


@cache
def prose(sentence: str) -> str:
    """A sentence as markup."""
    return "".join(
        escape(said, quote=False) if kind == "text" else mathml(said)
        for kind, said in pieces(sentence)
    )


def line(said: str) -> str:
    """A line of the program's own output as markup: what stands between backquotes is code."""
    return "".join(
        f"<code>{escape(part, quote=False)}</code>" if i % 2 else escape(part, quote=False)
        for i, part in enumerate(said.split("`"))
    )


@cache
def formula(text: str, block: bool = False) -> str:
    """A term or formula of the statement language as markup."""
    return mathml(latex_of(text), block)


def shown(text: str, longest: int) -> str:
    """A formula as markup, or as the checker reads it where it is too long for one line: as text it
    can be broken.
    """
    return formula(text) if len(text) <= longest else f"<code>{escape(text, quote=False)}</code>"


def change(text: str) -> str:
    """What a correction changes: LaTeX commands in it as what they stand for."""
    return "".join(
        mathml(part) if part.startswith("\\") else escape(part, quote=False)
        for part in re.split(r"(\\[A-Za-z]+)", text)
    )


SIDE = r"-?[\w/()*^]+(?: [+-] [\w/()*^]+)*"  # a term, whose signs stand between spaces
RANGE = re.compile(
    rf"(?P<point>\bc\d+ = \d\.\d+\.{{3}})|\ba root of (?P<polynomial>{SIDE})"
    rf"|(?P<condition>(?:{SIDE} <=? )?\balpha (?:<=?|>=?|=) {SIDE})|(?P<alpha>\balpha\b)"
)


def ranged(said: str) -> str:
    """A sharp range, or a line with one: conditions on alpha, end points and the polynomials that
    they are roots of as formulas.

    Labels of readings and steps stay as they are.
    """
    shown, at = "", 0
    for found in RANGE.finditer(said):
        shown += escape(said[at : found.start()], quote=False)
        kind, text, at = str(found.lastgroup), str(found.group(found.lastgroup or 0)), found.end()
        if kind == "point":
            name, _, value = text.partition(" = ")
            shown += f"{mathml(glyph(name))} = {value}"
        else:
            shown += f"a root of {polynomial(text)}" if kind == "polynomial" else formula(text)
    return shown + escape(said[at:], quote=False)


def polynomial(text: str) -> str:
    """A polynomial as markup, its terms in the order in which they are written."""
    latex = re.sub(
        r"\^(\d+)", r"^{\1}", re.sub(r"[A-Za-z]\w*", lambda name: glyph(name.group()), text)
    ).replace("*", " ")
    return mathml(latex)


ADJOINED = re.compile(r"(\w+) is a root of (.+?) between (\S+) and (\S+?)(?= \w+ is a root|$)")


def values(at: str) -> str:
    """A counterexample: values of names, and where adjoined roots lie; or a family, told by the
    sign of a polynomial.
    """
    family = "a family by the sign of "
    if at.startswith(family):
        return family + polynomial(at.removeprefix(family))
    found, where, rest = at.partition(" where ")
    shown = ", ".join(formula(one) for one in found.split(", "))
    for name, of, low, high in ADJOINED.findall(rest):
        shown += (
            f"{where}{mathml(glyph(name))} is a root of {polynomial(of)} between {formula(low)} and"
            f" {formula(high)}"
        )
        where = ", and "
    return shown


@cache
def lines_of(text: str) -> list[tuple[str, tuple[str, ...]]]:
    """The lines of a statement below its name, each keyword with what it says; lines of one keyword
    that follow each other are joined.

    The names that `forall` lists are left out: they are all that stand in the lines.

    >>> lines_of("statement a/b\\nforall x y\\ngiven x > 0 and y > 1\\ngiven x < y\\nshow x > y")
    [('given', ('x > 0', 'y > 1', 'x < y')), ('show', ('x > y',))]
    """
    joined: list[tuple[str, list[str]]] = []
    for line in text.splitlines()[1:]:
        keyword, _, said = line.partition(" ")
        keyword = "given" if keyword == "range" else keyword
        parts = conjuncts(said) if keyword in FORMULAS else [said]
        if joined and joined[-1][0] == keyword and keyword in FORMULAS and keyword != "stage":
            joined[-1][1].extend(parts)
        elif keyword != "forall":
            joined.append((keyword, parts))
    return [
        (keyword, tuple(chained(parts) if keyword in FORMULAS else parts))
        for keyword, parts in joined
    ]


def rows_of(lines: Sequence[tuple[str, Sequence[str]]]) -> list[Row]:
    """The lines as markup."""
    return [_row(keyword, said) for keyword, said in lines]


def _row(keyword: str, said: Sequence[str]) -> Row:
    word = WORDS.get(keyword, keyword)
    if keyword in LINKS:
        return Row(word, links=tuple(said[0].split()))
    if keyword in NAMES:
        return Row(word, (mathml(", ".join(map(glyph, said[0].split()))),))
    if keyword == "holds" and said == ("0 = 1",):
        return Row(word, ("never",))
    if keyword in FORMULAS:
        return Row(word, tuple(shown(one, ONE_LINE.get(keyword, ELSE)) for one in said))
    if keyword in TUPLES:
        return Row(word, (_tuple(parts_of(said[0])),))
    if keyword in ("let", "root", "number"):
        name, _, value = said[0].partition(" = ")
        return Row(word, (named(name, value),))
    if keyword in ("piece", "iterates", "after"):
        before, _, images = said[0].partition(" -> ")
        source = _tuple(_listed(before)) if keyword == "iterates" else formula(before)
        return Row(
            word,
            (
                (
                    f"{source} {mathml(ARROW)}"
                    f" {_tuple(parts_of(images) if keyword == 'piece' else _listed(images))}"
                ),
            ),
        )
    return Row(word, (escape(said[0], quote=False),))


def _listed(text: str) -> list[str]:
    """The entries of a list in brackets; a list of one ends with a comma."""
    return [part for part in parts_of(text[1:-1]) if part]


def _tuple(parts: Sequence[str]) -> str:
    return mathml(r"\left(" + ", ".join(map(latex_of, parts)) + r"\right)")


def named(name: str, value: str) -> str:
    """A name with its value, a square root, or a root of a polynomial between two bounds."""
    if value.startswith("sqrt(") and value.endswith(")"):
        return mathml(rf"{glyph(name)} = \sqrt{{{latex_of(value[5:-1])}}}")
    if value.startswith("root(") and value.endswith(")"):
        polynomial, low, high = parts_of(value[5:-1])
        between = rf"{latex_of(low)} \le {glyph(name)} \le {latex_of(high)}"
        return f"{mathml(between)}, a root of {formula(polynomial)}"
    return mathml(f"{glyph(name)} = {latex_of(value)}")


def _apart(text: str, by: str) -> list[str]:
    """The parts of a text between separators that stand outside of brackets.

    >>> _apart("(a, b)*c, d", ", ")
    ['(a, b)*c', 'd']
    """
    parts, depth = [""], 0
    for piece in re.split(f"({re.escape(by)}|[()])", text):
        depth += (piece == "(") - (piece == ")")
        if piece == by and not depth:
            parts.append("")
        else:
            parts[-1] += piece
    return parts


def conjuncts(text: str) -> list[str]:
    """What a formula joins by `and`, each apart.

    >>> conjuncts("x > 0 and (y > 0 and z > 0 or x < 1)"), conjuncts("x > 0 and y > 0 or z > 0")
    (['x > 0', '(y > 0 and z > 0 or x < 1)'], ['x > 0 and y > 0 or z > 0'])
    """
    return [text] if len(_apart(text, " or ")) > 1 else _apart(text, " and ")


def chained(parts: Sequence[str]) -> list[str]:
    """A lower bound of a name and then an upper one as one chain.

    >>> chained(["r > 0", "alpha > 0", "alpha < 1", "0 <= t", "t < T"])
    ['r > 0', '0 < alpha < 1', '0 <= t < T']
    """
    found: list[str] = []
    for part in parts:
        upper = re.fullmatch(r"(\w+) (<=?) (\w+)", part)
        lower = found and re.fullmatch(r"(\w+) (>=?) ([\w/]+)|([\w/]+) (<=?) (\w+)", found[-1])
        if upper and lower and upper.group(1) in (lower.group(1), lower.group(6)):
            bound = (
                f"{lower.group(4)} {lower.group(5)}"
                if lower.group(4)
                else f"{lower.group(3)} {lower.group(2).replace('>', '<')}"
            )
            found[-1] = f"{bound} {part}"
        else:
            found.append(part)
    return found
