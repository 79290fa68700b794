"""The statements that reports print, and what LaTeX says against them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from hashlib import sha256
from random import Random

from juggleproof.statements.store import DEFAULT, Store
from tests.reports.latex_reader import read
from tests.reports.nodes import (
    Formula,
    Implied,
    Joined,
    Listed,
    Node,
    Not,
    NotRead,
    Related,
    Term,
    exact_root,
    names_in,
    value,
)
from tests.reports.statement_text import evaluate_statement_text, read_statement_text

# -------------------------------------------------------------------------------------------------
# The terms and formulas that the stored statements hold, each once: what reports print.

SAYING = (
    "range given have with show domain holds space rank stage on rate radius size point weights"
    " start".split()
)


def texts() -> list[str]:
    found: dict[str, None] = {}
    for line in "\n".join(Store(DEFAULT).texts.values()).splitlines():
        keyword, _, rest = line.strip().partition(" ")
        if keyword == "let":
            found[rest.split(" = ")[1]] = None
        elif keyword in SAYING:
            found[rest] = None
    return list(found)


TEXTS = texts()


# -------------------------------------------------------------------------------------------------
# What LaTeX says against the statement text that it was made from, at random rational points.
#
# Formulas must have the same relations in the same places, with the same signs, and the sides of
# each relation must have equal values: truth alone would hardly ever tell an equation from another,
# nor a <= b from a < b.  `not` is driven down to the relations first, and chains and nested `and`,
# `or` are taken apart, so that x \ge w may stand for `not x < w`.

OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "=": "!=", "!=": "="}
INTEGERS = ("K", "J", "n", "m", "k", "j")
POSITIVE = ("r", "g", "T")
DEFINED = {
    "T": "2*r/g",
    "tau": "beta/(r - v)",
    "x": "beta/(r*(2*r/g))",
    "w": "1 - v/r",
}  # for names that only the LaTeX has
ATTEMPTS = 20  # draws for each point that is wanted
Point = dict[str, Fraction]
read_latex = cache(read)  # what is edited, or has its macros put in, is read again


class Different(Exception):
    """Two trees that do not say the same: why."""


def differences(pairs: Iterable[tuple[str, str]], seed: int = 0, points: int = 8) -> list[str]:
    """A line for each pair (statement text, LaTeX) that does not agree, or that could not be
    compared at all of the points.
    """
    found = []
    for text, latex in pairs:
        try:
            compare(text, latex, Random(f"{seed} {text}"), points)
        except (NotRead, Different) as reason:
            found.append(f"{text}  |  {latex}  |  {reason}")
    return found


def compare(text: str, latex: str, random: Random, points: int) -> None:
    try:
        stated = read_statement_text(text)
    except NotRead as reason:
        raise Different(f"the text is not read: {reason}") from None
    try:
        printed = read_latex(latex)
    except NotRead as reason:
        raise Different(f"the LaTeX is not read: {reason}") from None
    sides = list(matched(stated, printed))
    names, wanted = unknowns(stated, printed)
    compared, why = 0, "none was tried"
    for _ in range(ATTEMPTS * points):
        if compared == points:
            return
        point = drawn(names, wanted, random)
        known: dict[int, Fraction] = {}
        values = [both(one, other, point, known) for one, other in [*sides, (stated, printed)]]
        for left, right in values:
            if isinstance(left, NotRead) is not isinstance(right, NotRead):
                raise Different(
                    f"a value on one side only: {shown(left)} against {shown(right)}, where"
                    f" {at(point)}"
                )
            if isinstance(left, NotRead):
                why = f"{left}"
            elif left != right:
                raise Different(f"{shown(left)} against {shown(right)}, where {at(point)}")
        compared += not any(isinstance(left, NotRead) for left, _ in values)
    if compared < points:
        raise Different(f"values at {compared} points only: {why}")


def both(one: Node, other: Node, point: Point, known: dict[int, Fraction]) -> tuple[object, object]:
    """The two values; a NotRead in the place of one that is not there."""
    found: list[object] = []
    for node in (one, other):
        try:
            found.append(value(node, point, opaque_root, known))
        except NotRead as reason:
            found.append(reason)
    return found[0], found[1]


def opaque_root(under: Fraction) -> Fraction:
    """The root of a square; for anything else a number that equal radicands share and others do
    not.
    """
    try:
        return exact_root(under)
    except NotRead:
        digest = sha256(f"{under}".encode()).digest()
        return Fraction(int.from_bytes(digest[:6], "big"), 1 << 40)


# ------------------------------------------------------------ structure


def matched(stated: Node, printed: Node) -> Iterator[tuple[Term, Term]]:
    """The terms that must be equal; Different where the trees have not one shape."""
    if isinstance(stated, Formula) and isinstance(printed, Formula):
        yield from alike(plain(stated), plain(printed))
    elif (
        isinstance(stated, Listed)
        and isinstance(printed, Listed)
        and len(stated.entries) == len(printed.entries)
    ):
        for one, other in zip(stated.entries, printed.entries):
            yield from matched(one, other)
    elif isinstance(stated, Term) and isinstance(printed, Term):
        yield stated, printed
    else:
        raise Different(f"{kind(stated)} against {kind(printed)}")


def alike(stated: Formula, printed: Formula) -> Iterator[tuple[Term, Term]]:
    if isinstance(stated, Related) and isinstance(printed, Related) and stated.sign == printed.sign:
        yield stated.left, printed.left
        yield stated.right, printed.right
    elif (
        isinstance(stated, Joined)
        and isinstance(printed, Joined)
        and (stated.how, len(stated.parts)) == (printed.how, len(printed.parts))
    ):
        for one, other in zip(stated.parts, printed.parts):
            yield from alike(one, other)
    elif isinstance(stated, Implied) and isinstance(printed, Implied) and stated.how == printed.how:
        yield from alike(stated.left, printed.left)
        yield from alike(stated.right, printed.right)
    elif isinstance(stated, Not) and isinstance(printed, Not):
        yield from alike(stated.of, printed.of)
    else:
        raise Different(f"{kind(stated)} against {kind(printed)}")


def plain(formula: Formula, denied: bool = False) -> Formula:
    """The formula with `not` at no relation, `and` and `or`, and no `and` in an `and`; not iff(a,
    b) stays as it is.
    """
    if isinstance(formula, Not):
        return plain(formula.of, not denied)
    if isinstance(formula, Related):
        return replace(formula, sign=OPPOSITE[formula.sign]) if denied else formula
    if isinstance(formula, Joined):
        how = {"and": "or", "or": "and"}[formula.how] if denied else formula.how
        return joined(how, [plain(part, denied) for part in formula.parts])
    if isinstance(formula, Implied):
        if denied and formula.how == "implies":
            return joined("and", [plain(formula.left), plain(formula.right, True)])
        found = Implied(formula.how, plain(formula.left), plain(formula.right))
        return Not(found) if denied else found
    raise Different(f"not a formula: {formula!r}")


def joined(how: str, parts: list[Formula]) -> Formula:
    flat = [
        inner
        for part in parts
        for inner in (part.parts if isinstance(part, Joined) and part.how == how else (part,))
    ]
    return Joined(how, tuple(flat))


def kind(node: Node) -> str:
    if isinstance(node, Related):
        return f"a relation {node.sign}"
    if isinstance(node, Joined):
        return f"{len(node.parts)} parts joined by {node.how}"
    if isinstance(node, Listed):
        return f"a list of {len(node.entries)}"
    return node.how if isinstance(node, Implied) else "a term" if isinstance(node, Term) else "not"


# ------------------------------------------------------------ points


def unknowns(stated: Node, printed: Node) -> tuple[list[str], list[str]]:
    """The names to draw a value for, and those of the LaTeX alone that are defined by others."""
    names = {name.printed for name in names_in(stated)}
    root = names & {"alpha", "s"}
    wanted: set[str] = set()
    for name in names_in(printed):
        if not names.intersection(name.stands_for):
            known = [
                one for one in name.stands_for if one in DEFINED or root and one in ("alpha", "s")
            ]
            if not known:
                raise Different(f"{name.printed} is printed, and is not in the text")
            wanted.add(known[0])
    wanted -= {"alpha", "s"}
    inner = {name.printed for one in wanted for name in names_in(read_statement_text(DEFINED[one]))}
    return sorted(names | inner), sorted(wanted)


def drawn(names: list[str], wanted: list[str], random: Random) -> Point:
    """Small rationals, no two the same and none special; alpha has a rational s, with s^2 = 2 (1 +
    alpha).
    """
    point: Point = {}
    if "alpha" in names or "s" in names:
        below = random.randint(20, 60)
        half = Fraction(random.randint(below * 73 // 100 + 1, below - 1), below)
        point |= {"alpha": 2 * half**2 - 1, "s": 2 * half}
    for name in names:
        while name not in point:
            found = (
                Fraction(random.randint(2, 9))
                if name in INTEGERS
                else Fraction(random.randint(3, 60), random.randint(2, 13))
            )
            sign = 1 if name in INTEGERS or name in POSITIVE else random.choice((1, 1, -1))
            if found != 1 and found not in map(abs, point.values()):
                point[name] = sign * found
    return point | {name: evaluate_statement_text(DEFINED[name], point) for name in wanted}


def at(point: Point) -> str:
    return ", ".join(f"{name} = {found}" for name, found in point.items())[:300]


def shown(found: object) -> str:
    return f"{found}" if isinstance(found, (NotRead, Fraction, bool)) else f"{found!r}"[:80]
