"""Maps as text: parameters, state and pieces, read from a file of lines or from a map rule, and
brought to the form that the checker takes.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from pathlib import Path

import numpy as np
import sympy

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.terms import (
    Expr,
    Point,
    Value,
    atoms,
    expression,
    formula_holds,
    symbols,
    term_value,
    written,
)
from juggleproof.statements.cases import (
    ANYWHERE,
    FUNCTIONS,
    Piece,
    checker_text,
    exact,
    short,
    taken_apart,
)
from juggleproof.statements.definitions import formula_of, term_of
from juggleproof.statements.formulas import RESERVED as WORDS
from juggleproof.statements.language import ClaimError, MapRule
from juggleproof.statements.store import plain_file

Side = tuple[int, int]  # the number of a state variable, LOW or HIGH

ORDER = ("over", "domain", "state", "space", "piece", "point")
LOW, HIGH = -1, 1
SIGNS = "names, 3/10 or 0.3, + - * / ^, abs max min, < <= = != >= >, and or not"
RESERVED = re.compile(r"value|level|distance|root_\d+|.*_(next|gap|point)")


@dataclass(frozen=True)
class Map:
    """A map of states, piece by piece, with its parameters; everything is text of the statement
    language.  `point` is the point that the user names, if any; `lines` are the places of the
    pieces in the map's file, if there is one.
    """

    name: str
    parameters: tuple[str, ...]
    domain: str
    state: tuple[str, ...]
    space: str
    pieces: tuple[Piece, ...]
    point: tuple[str, ...] = ()
    lines: tuple[int, ...] = field(default=(), compare=False)

    def rule(self, name: str = "map") -> MapRule:
        """The map as a statement of the checker."""
        return MapRule(
            name,
            (
                ("over", " ".join(self.parameters)),
                ("domain", self.domain),
                ("state", " ".join(self.state)),
                ("space", self.space),
                *(("piece", f"{guard} -> {', '.join(images)}") for guard, images in self.pieces),
            ),
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Parameters and state variables."""
        return (*self.parameters, *self.state)

    @cached_property
    def images(self) -> tuple[tuple[Expr, ...], ...]:
        """The image of each piece in SymPy."""
        return tuple(tuple(map(expression, images)) for _, images in self.pieces)

    @cached_property
    def derivatives(self) -> tuple[Expr, ...]:
        """The matrix of derivatives of each piece."""
        state = symbols(self.state)
        return tuple(sympy.Matrix(images).jacobian(state) for images in self.images)

    @cached_property
    def is_affine(self) -> bool:
        """Return whether every piece is affine in the state."""
        state = symbols(self.state)
        return all(one.free_symbols.isdisjoint(state) for one in self.derivatives)

    @cached_property
    def trees(self) -> tuple[tuple[ast.expr, tuple[ast.expr, ...]], ...]:
        """Guards and images as syntax trees."""
        return tuple((checker.parse(g), tuple(map(checker.parse, i))) for g, i in self.pieces)

    def applying(self, point: Point) -> Iterator[Value]:
        """Yield for each piece whether it applies at arrays of states.  A comparison that several
        guards share is made once.
        """
        known: dict[str, Value] = {}
        shape = np.broadcast_shapes(*(np.shape(value) for value in point.values()))
        for guard, _ in self.trees:
            yield np.broadcast_to(formula_holds(guard, point, known), shape)

    def next(self, point: Point) -> tuple[Value, ...]:
        """The next state of arrays of states: floats, for searches alone.

        A state that no piece applies to becomes NaN.
        """
        shape = np.broadcast_shapes(*(np.shape(value) for value in point.values()))
        point = {name: np.broadcast_to(values, shape) for name, values in point.items()}
        after = [np.full(shape, np.nan) for _ in self.state]
        for here, (_, images) in zip(self.applying(point), self.trees):
            if here.any():
                where = ... if here.all() else here  # most maps have one piece; no copies for it
                inside = {name: values[where] for name, values in point.items()}
                for values, image in zip(after, images):
                    values[where] = term_value(image, inside, Fraction)
        return tuple(after)


def ends_of_space(system: Map, space: str = "", strict: bool = False) -> dict[Side, Expr]:
    """The ends of the space, or of a part of it, that bound a single variable; if `strict`, only
    those that do not belong to it.
    """
    state = symbols(system.state)
    found: dict[Side, Expr] = {}
    for poly, is_strict in atoms(space or system.space):
        named = poly.free_symbols & set(state)
        slope = sympy.diff(poly, *named) if len(named) == 1 else sympy.Integer(0)
        if slope.is_Rational and slope != 0 and (is_strict or not strict):
            (one,) = named
            side = state.index(one), LOW if slope > 0 else HIGH
            found.setdefault(side, sympy.expand(one - poly / slope))
    return found


def bounds(system: Map) -> tuple[dict[str, str], dict[str, str]]:
    """Return the distances of the state variables to their lower ends, and those to their upper
    ends; they are > 0.
    """
    found: dict[int, dict[str, str]] = {LOW: {}, HIGH: {}}
    for (k, side), end in ends_of_space(system, strict=True).items():
        gap = sympy.expand(side * (end - symbols(system.state)[k]))
        found[side][system.state[k]] = written(gap)
    return found[LOW], found[HIGH]


# -------------------------------------------------------------------------------------------------
# Reading.


def read_file(path: Path) -> Map:
    """The map that a text file says, line by line: `over` (may be left out), `domain` (likewise),
    `state`, `space`, one `piece` or more, and `point` (may be left out).

    Raises ClaimError, one line with file and line, for anything else.
    """
    try:
        text = plain_file(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ClaimError(f"{path} cannot be read: not in UTF-8; save it so") from None
    except OSError as error:
        raise ClaimError(f"{path} cannot be read: {error.strerror}; name a text file") from None
    rows, numbers = [], []
    for number, line in enumerate(text.split("\n"), 1):
        words = line.partition("#")[0].split()
        if words:
            rows.append((words[0], " ".join(words[1:])))
            numbers.append(number)
    name = re.sub(r"[^A-Za-z0-9]+", "-", path.stem).strip("-") or "map"
    return read_rows(name, rows, str(path), numbers)


def read_rows(
    name: str, rows: Sequence[tuple[str, str]], file: str = "", numbers: Sequence[int] = ()
) -> Map:
    """The map that lines (keyword, text) say; absolute values, maxima and minima are taken apart
    into pieces, and decimals are exact fractions.

    Raises ClaimError for anything else, which names file and number of the line, or else the line.
    """

    def place(k: int) -> str:
        return f"{file}:{numbers[k]}" if file else f"the line `{short(' '.join(rows[k]))}`"

    keywords = [keyword for keyword, _ in rows]
    for k, (keyword, before) in enumerate(zip(keywords, ["", *keywords])):
        if keyword not in ORDER:
            raise ClaimError(f"{place(k)}: {keyword} is no line of a map; write {', '.join(ORDER)}")
        if before and ORDER.index(keyword) < ORDER.index(before):
            raise ClaimError(f"{place(k)}: {keyword} comes too late; write {', '.join(ORDER)}")
        if keyword == before != "piece":
            raise ClaimError(f"{place(k)}: {keyword} stands twice; write one such line")
    for keyword in ("state", "piece"):
        if keyword not in keywords:
            raise ClaimError(f"{file}: " * bool(file) + f"a line `{keyword} ..` is missing")
    system = Map(name, (), ANYWHERE, (), ANYWHERE, ())
    for k, (keyword, text) in enumerate(rows):
        try:
            system = _with_line(system, keyword, text)
            if numbers and keyword == "piece":
                added = len(system.pieces) - len(system.lines)
                system = replace(system, lines=(*system.lines, *[numbers[k]] * added))
        except ClaimError as problem:
            raise ClaimError(f"{place(k)}: {problem}") from None
        except (checker.Rejected, RecursionError):
            what = f"unreadable: {short(text)}; write shorter formulas of {SIGNS}"
            raise ClaimError(f"{place(k)}: {what}") from None
    return system


def _with_line(system: Map, keyword: str, text: str) -> Map:
    """Return the map with one more line."""
    if keyword in ("over", "state"):
        names = tuple(text.split())
        for k, one in enumerate(names):
            _refuse_name(one, (*system.names, *names[:k]))
        if keyword == "over":
            return replace(system, parameters=names)
        if not names:
            raise ClaimError("no state variable; name one or more")
        return replace(system, state=names)
    names = system.parameters if keyword in ("domain", "point") else system.names
    if keyword == "domain":
        return replace(system, domain=_formula(_tree(text, names, keyword)))
    if keyword == "space":
        return replace(system, space=_formula(_tree(text, names, keyword)))
    guard, arrow, images = text.rpartition("->")
    if "->" in guard or arrow and keyword == "point":
        raise ClaimError("too many arrows; write one, in a piece with a guard")
    terms = _tree(images, names, keyword)
    each = terms.elts if isinstance(terms, ast.Tuple) else [terms]
    if len(each) != len(system.state):
        raise ClaimError(
            f"{len(each)} terms for {len(system.state)} state variables; write a term for each of"
            f" {' '.join(system.state)}"
        )
    if keyword == "point":
        return replace(system, point=tuple(map(_term, each)))
    where = checker_text(_tree(guard, names, keyword)) if guard.strip() else ""
    cases = taken_apart(where, tuple(map(checker_text, each)))
    pieces = [
        (_formula(checker.parse(guard)), tuple(_term(checker.parse(one)) for one in after))
        for guard, after in cases
    ]
    found = (piece for piece in pieces if not _never(piece[0]))
    return replace(system, pieces=(*system.pieces, *found))


def _refuse_name(name: str, others: Collection[str]) -> None:
    if not re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII):
        raise ClaimError(f"{name} is no name; write letters a to z, digits and _, spaces between")
    if name in WORDS or name in FUNCTIONS:
        raise ClaimError(f"{name} is a word of the language; choose another")
    if RESERVED.fullmatch(name):
        raise ClaimError(f"{name} is a name of the rules; choose another")
    if name in others:
        raise ClaimError(f"{name} is named twice; write it once, in `over` or in `state`")


def _tree(text: str, names: Collection[str], keyword: str) -> ast.expr:
    """The tree of a text in these names, on a line of this keyword; decimals are exact fractions.

    Raises ClaimError for what cannot be read.
    """
    if not text.isascii():
        strange = next(one for one in text if not one.isascii())
        raise ClaimError(f"{strange} in a formula; write {SIGNS}")
    try:
        node = checker.parse(exact(text))
    except checker.Rejected:
        raise ClaimError(f"unreadable: {short(text) or 'no text'}; write {SIGNS}") from None
    calls = [inner for inner in ast.walk(node) if isinstance(inner, ast.Call)]
    for call in calls:
        _refuse_call(call, in_piece=keyword == "piece")
    called = [call.func for call in calls]
    for inner in ast.walk(node):
        if isinstance(inner, ast.Name) and inner not in called and inner.id not in names:
            if keyword in ("domain", "point"):
                raise ClaimError(f"{inner.id} is no parameter; name it in `over`")
            raise ClaimError(
                f"{inner.id} is neither parameter nor state variable; name it in `over` or `state`"
            )
    if _degree(node) > limits.MOST_POWER:
        raise ClaimError(f"a power above {limits.MOST_POWER}; write lower ones")
    return node


def _refuse_call(call: ast.Call, in_piece: bool) -> None:
    name = ast.unparse(call.func)
    if name in ("implies", "iff") and len(call.args) == 2:
        return
    if name not in FUNCTIONS:
        raise ClaimError(f"{short(name)}(..) is no function here; write abs, max or min")
    if not in_piece:
        raise ClaimError(f"{name} stands outside of a piece; write comparisons without it")
    if any(isinstance(inner, (ast.Compare, ast.BoolOp)) for inner in ast.walk(call)):
        raise ClaimError(f"{name} of a formula; it takes terms")


def _degree(node: ast.AST) -> int:
    """The greatest product of nested exponents."""
    inner = max(map(_degree, ast.iter_child_nodes(node)), default=1)
    if not (isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow)):
        return inner
    try:
        return inner * abs(int(ast.literal_eval(node.right)))
    except (TypeError, ValueError):
        text = short(checker_text(node))
        raise ClaimError(f"{text}: no whole number in the exponent; write one") from None


def _term(node: ast.expr) -> str:
    """The term as text; raises ClaimError if the node is no term, or divides by 0."""
    try:
        text = str(term_of(node))
    except ClaimError:
        bare = short(checker_text(node))
        raise ClaimError(f"{bare} is no term; write a piece as GUARD -> TERM, ..") from None
    if expression(text).has(sympy.zoo, sympy.nan):
        raise ClaimError(f"{short(text)} divides by 0; mend the divisor")
    return text


def _formula(node: ast.expr) -> str:
    """The formula as text; raises ClaimError if the node is no formula, or divides by 0."""
    try:
        text = str(formula_of(node))
    except ClaimError:
        bare = short(checker_text(node))
        raise ClaimError(f"{bare} is no formula; write comparisons, with and, or, not") from None
    for inner in ast.walk(node):
        if isinstance(inner, ast.Compare):
            for side in (inner.left, *inner.comparators):
                _term(side)
    return text


def _never(guard: str) -> bool:
    """Return whether the guard says something false of numbers alone."""
    return any(
        not poly.free_symbols and (poly < 0 or strict and poly == 0)
        for poly, strict in atoms(guard)
    )


def of_rule(rule: MapRule, name: str = "", point: Sequence[str] = ()) -> Map:
    """The map of a map rule, under its own name or this one, with this point where there is one;
    raises ClaimError for lines that make no map.
    """
    named = [("point", ", ".join(map(str, point)))] if point else []
    return read_rows(name or rule.name.rpartition("/")[2], [*pairs_of(rule), *named])


def pairs_of(rule: MapRule) -> list[tuple[str, str]]:
    """The lines of a rule; raises ClaimError where one is no pair of texts."""
    rows = []
    for row in rule.rows:
        if not isinstance(row, (tuple, list)) or [type(part) for part in row] != [str, str]:
            raise ClaimError(f"{row!r} is no line of a rule; write a pair (keyword, text)")
        rows.append((row[0], row[1]))
    return rows
