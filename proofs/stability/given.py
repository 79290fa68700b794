"""The map as it is given: parameters, state and pieces as text, read from a file of lines or from a
map rule, and brought to the form that the checker takes.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from pathlib import Path
from typing import Any

import numpy as np
import sympy

from juggleproof.certificates import checker
from juggleproof.certificates.language import ClaimError, MapRule
from juggleproof.proofs.encoding import from_sympy

Expr = Any  # of SymPy, which has no types
Value = Any  # a float array, a Fraction or an Expr: whatever a text is evaluated in
Point = Mapping[str, Value]
Piece = tuple[str, tuple[str, ...]]  # guard, images

ORDER = ("over", "domain", "state", "space", "piece", "point")
ANYWHERE = "0 < 1"  # a formula that always holds, as text
RESERVED = re.compile(r"value|level|distance|root_\d+|.*_(next|gap|point)")
MOST_PIECES = 64  # after absolute values are taken apart


@dataclass(frozen=True)
class Map:
    """A map of states, piece by piece, with its parameters; everything is text of the statement
    language.  `point` is what the user names as the point, if anything.
    """

    name: str
    parameters: tuple[str, ...]
    domain: str
    state: tuple[str, ...]
    space: str
    pieces: tuple[Piece, ...]
    point: tuple[str, ...] = ()

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

    def next(self, point: Point) -> tuple[Value, ...]:
        """The next state of arrays of states: floats, for searches alone.

        A state that no piece applies to becomes NaN.
        """
        shape = np.broadcast_shapes(*(np.shape(value) for value in point.values()))
        after = [np.full(shape, np.nan) for _ in self.state]
        for guard, images in self.pieces:
            here = np.broadcast_to(holds(guard, point), shape)
            if here.any():
                inside = {name: np.broadcast_to(v, shape)[here] for name, v in point.items()}
                for values, image in zip(after, images):
                    values[here] = value(image, inside)
        return tuple(after)

    def exact_next(self, point: Mapping[str, Fraction]) -> tuple[int, dict[str, Fraction]]:
        """The number of the piece that applies, and the point with the next state, exactly."""
        for k, (guard, images) in enumerate(self.pieces):
            if holds(guard, point):
                after = {s: value(image, point) for s, image in zip(self.state, images)}
                return k, {**point, **after}
        raise ClaimError(f"no piece applies at {shown(point)}; let the guards cover the space")


def shown(point: Mapping[str, object]) -> str:
    """Values as a person reads them."""
    return ", ".join(f"{name} = {value}" for name, value in point.items())


# -------------------------------------------------------------------------------------------------
# Text evaluated in arrays of floats, in exact rationals, or in SymPy.

OPERATORS: Mapping[type, Callable[[Value, Value], Value]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


def value(text: str, point: Point) -> Value:
    """The value of a term."""
    return _value(checker.parse(text), point, Fraction)


def holds(text: str, point: Point) -> Value:
    """Whether a formula holds, for each state of an array."""
    return _holds(checker.parse(text), point)


def expression(text: str) -> Expr:
    """A term in SymPy, with real symbols."""
    names = {name: sympy.Symbol(name, real=True) for name in checker.names_in(text)}
    return _value(checker.parse(text), names, sympy.Integer)


def written(term: Expr) -> str:
    """A rational SymPy expression as text, one quotient at most."""
    above, below = sympy.fraction(sympy.factor_terms(sympy.together(term)))
    if below.could_extract_minus_sign():
        above, below = -above, -below
    quotient = from_sympy(above) / from_sympy(below) if below != 1 else from_sympy(above)
    return str(quotient)


def _value(node: ast.expr, point: Point, number: Callable[[int], Value]) -> Value:
    if isinstance(node, ast.Name):
        return point[node.id]
    if isinstance(node, ast.Constant):
        return number(int(str(node.value)))
    if isinstance(node, ast.UnaryOp):
        return -_value(node.operand, point, number)
    if not isinstance(node, ast.BinOp):
        raise ClaimError(f"{ast.unparse(node)} is no rational term")
    left = _value(node.left, point, number)
    if isinstance(node.op, ast.Pow):
        try:
            return left ** int(ast.literal_eval(node.right))
        except (TypeError, ValueError):
            text = checker_text(node)
            raise ClaimError(f"{text}: no whole number in the exponent; write one") from None
    right = _value(node.right, point, number)
    if isinstance(left, np.ndarray) or isinstance(right, np.ndarray):
        left, right = (float(v) if isinstance(v, Fraction) else v for v in (left, right))
    return OPERATORS[type(node.op)](left, right)


def _holds(node: ast.expr, point: Point) -> Value:
    if isinstance(node, ast.Compare):
        sides = [_value(side, point, Fraction) for side in (node.left, *node.comparators)]
        sides = [
            float(side) if isinstance(side, Fraction) and _floats(point) else side for side in sides
        ]
        parts = [OPERATORS[type(op)](a, b) for op, a, b in zip(node.ops, sides, sides[1:])]
        return reduce(operator.and_, parts)
    if isinstance(node, ast.BoolOp):
        join = operator.and_ if isinstance(node.op, ast.And) else operator.or_
        return reduce(join, (_holds(part, point) for part in node.values))
    if isinstance(node, ast.UnaryOp):
        return np.logical_not(_holds(node.operand, point))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        first, second = (_holds(part, point) for part in node.args)
        if node.func.id == "iff":
            return np.equal(first, second)
        return np.logical_or(np.logical_not(first), second)
    raise ClaimError(f"{ast.unparse(node)} is no formula")


def _floats(point: Point) -> bool:
    return any(isinstance(v, np.ndarray) for v in point.values())


def atoms(text: str) -> list[tuple[Expr, bool]]:
    """The polynomials or quotients that a conjunction says are >= 0, and whether > 0; what is no
    conjunction of inequalities is left out.
    """
    return list(_atoms(checker.parse(text)))


def _atoms(node: ast.expr) -> Iterable[tuple[Expr, bool]]:
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        for part in node.values:
            yield from _atoms(part)
    elif isinstance(node, ast.Compare):
        sides = [expression(checker_text(side)) for side in (node.left, *node.comparators)]
        for op, left, right in zip(node.ops, sides, sides[1:]):
            if isinstance(op, (ast.Lt, ast.LtE)):
                yield sympy.expand(right - left), isinstance(op, ast.Lt)
            elif isinstance(op, (ast.Gt, ast.GtE)):
                yield sympy.expand(left - right), isinstance(op, ast.Gt)


def bounds(system: Map) -> tuple[dict[str, str], dict[str, str]]:
    """What is > 0 in the space, for each state variable: its distance to a lower bound, and to an
    upper one.
    """
    low: dict[str, str] = {}
    high: dict[str, str] = {}
    for poly, strict in atoms(system.space):
        named = poly.free_symbols & set(symbols(system.state))
        if strict and len(named) == 1:
            (one,) = named
            slope = sympy.diff(poly, one)
            if slope.is_Rational:
                (low if slope > 0 else high).setdefault(str(one), written(poly / abs(slope)))
    return low, high


def checker_text(node: ast.AST) -> str:
    """The text of a syntax tree."""
    return ast.unparse(node).replace("**", "^").replace("==", "=")


def conjuncts(text: str) -> list[str]:
    """The parts of a conjunction, or the formula itself."""
    node = checker.parse(text)
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        return [inner for part in node.values for inner in conjuncts(checker_text(part))]
    return [checker_text(node)]


def conjunction(*parts: str) -> str:
    """All of these formulas, without those that always hold or stand twice."""
    kept = list(dict.fromkeys(part for part in parts if part and part != ANYWHERE))
    one = [f"({part})" if " or " in part else part for part in kept]
    return " and ".join(one) or ANYWHERE


def renamed(text: str, names: Mapping[str, str]) -> str:
    """The text with other names in place of some."""
    return re.sub(r"[A-Za-z]\w*", lambda found: names.get(found[0], found[0]), text)


# -------------------------------------------------------------------------------------------------
# Reading.


def read_file(path: Path) -> Map:
    """The map that a text file says, line by line: `over` (may be left out), `domain` (likewise),
    `state`, `space`, one `piece` or more, and `point` (may be left out).

    Raises ClaimError, one line with file and line, for anything else.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ClaimError(f"{path} cannot be read ({type(error).__name__})") from None
    rows: list[tuple[str, str]] = []
    for count, line in enumerate(lines, 1):
        keyword, _, rest = line.partition("#")[0].strip().partition(" ")
        if not keyword:
            continue
        if keyword not in ORDER:
            known = ", ".join(ORDER)
            raise ClaimError(f"{path}:{count}: {keyword} is no line of a map; write {known}")
        if rows and ORDER.index(keyword) < ORDER.index(rows[-1][0]):
            raise ClaimError(f"{path}:{count}: {keyword} comes too late; write {', '.join(ORDER)}")
        try:
            if keyword not in ("over", "state"):
                checker.parse(_readable(rest.replace(" -> ", ", ")))
        except checker.Rejected as reason:
            raise ClaimError(f"{path}:{count}: {reason}") from None
        rows.append((keyword, rest.strip()))
    try:
        return read_rows(re.sub(r"\W+", "-", path.stem), rows)
    except ClaimError as problem:
        raise ClaimError(f"{path}: {problem}") from None


def read_rows(name: str, rows: Sequence[tuple[str, str]]) -> Map:
    """The map that lines (keyword, text) say; absolute values, maxima and minima are taken apart
    into pieces, and decimals are exact fractions.
    """
    said: dict[str, list[str]] = {keyword: [] for keyword in ORDER}
    for keyword, text in rows:
        if keyword not in said:
            raise ClaimError(f"{keyword} is no line of a map; write {', '.join(ORDER)}")
        said[keyword].append(_readable(text))
    for keyword in ("state", "piece"):
        if not said[keyword]:
            raise ClaimError(f"a line `{keyword} ..` is missing")
    for keyword in ORDER:
        if keyword != "piece" and len(said[keyword]) > 1:
            raise ClaimError(f"{keyword} stands twice; write one such line")
    state = tuple(said["state"][0].split())
    pieces: list[Piece] = []
    for text in said["piece"]:
        if text.count(" -> ") > 1:
            raise ClaimError(f"piece {text}: two arrows; write GUARD -> TERM, ..")
        guard, arrow, images = text.rpartition(" -> ")
        node = checker.parse(f"({images},)")
        terms = tuple(map(checker_text, node.elts)) if isinstance(node, ast.Tuple) else ()
        if len(terms) != len(state):
            raise ClaimError(
                f"piece {text}: {len(terms)} terms for {len(state)} state variables; write"
                f" GUARD -> a term for each of {' '.join(state)}"
            )
        pieces += [one for one in _taken_apart(guard if arrow else "", terms) if not _never(one[0])]
    found = Map(
        name,
        tuple(" ".join(said["over"]).split()),
        " and ".join(said["domain"]) or ANYWHERE,
        state,
        " and ".join(said["space"]) or ANYWHERE,
        tuple(pieces),
        tuple(text.strip() for text in said["point"][0].split(",")) if said["point"] else (),
    )
    for text in (found.space, *(part for guard, images in pieces for part in (guard, *images))):
        strange = sorted(checker.names_in(text) - set(found.names))
        if strange:
            raise ClaimError(f"{strange[0]} in {text} is neither parameter nor state variable")
    for _, terms in pieces:
        for term in terms:
            expression(term)  # raises what cannot be worked out
    for text in (found.domain, *found.point):
        strange = sorted(checker.names_in(text) - set(found.parameters))
        if strange:
            raise ClaimError(f"{strange[0]} in {text} is no parameter; name it in `over`")
    for name in found.names:
        if not re.fullmatch(r"[A-Za-z]\w*", name):
            raise ClaimError(f"{name} is no name; write letters, digits and _")
        if RESERVED.fullmatch(name):
            raise ClaimError(f"{name} is a name of the rules; choose another")
        if found.names.count(name) > 1:
            raise ClaimError(f"{name} is named twice; write it once, in `over` or in `state`")
    if found.point and len(found.point) != len(state):
        raise ClaimError(f"point has not a term for each of {' '.join(state)}; write so many")
    return found


def _never(guard: str) -> bool:
    """Whether the guard says something false of numbers alone."""
    return any(
        not poly.free_symbols and (poly < 0 or strict and poly == 0)
        for poly, strict in atoms(guard)
    )


def of_rule(rule: MapRule, name: str = "") -> Map:
    """The map of a map rule, under its own name or this one."""
    return read_rows(name or rule.name.rpartition("/")[2], rule.rows)


def _readable(text: str) -> str:
    """Decimals as exact fractions."""
    return re.sub(r"(?<![\w.])\d*\.\d+(?![\w.])", lambda number: f"({Fraction(number[0])})", text)


# -------------------------------------------------------------------------------------------------
# Absolute values, maxima and minima: one piece for each of their cases.


def _taken_apart(guard: str, images: tuple[str, ...]) -> list[Piece]:
    """The pieces without abs, max and min; where there are several, each has a guard of its own."""
    texts = [*([guard] if guard else []), *images]
    call = next(filter(None, (_inmost(checker.parse(text)) for text in texts)), None)
    if call is None:
        return [(guard or ANYWHERE, images)]
    pieces: list[Piece] = []
    for condition, term in _cases(call):
        put = [_replaced(checker.parse(text), ast.unparse(call), term) for text in texts]
        rest = put[1:] if guard else put
        pieces += _taken_apart(conjunction(*put[: len(put) - len(rest)], condition), tuple(rest))
        if len(pieces) > MOST_PIECES:
            raise ClaimError(f"more than {MOST_PIECES} cases of abs, max and min in one piece")
    return pieces


def _inmost(node: ast.expr) -> ast.Call | None:
    """A call of abs, max or min with no such call in it."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Call) and ast.unparse(inner.func) in ("abs", "max", "min"):
            return next(filter(None, map(_inmost, inner.args)), None) or inner
    return None


def _cases(call: ast.Call) -> list[tuple[str, str]]:
    """(condition, what the call is there), of which one holds at each state."""
    arguments = [checker_text(argument) for argument in call.args]
    if not arguments or ast.unparse(call.func) == "abs" and len(arguments) > 1:
        raise ClaimError(f"{ast.unparse(call)}: abs takes one term, max and min one or more")
    if ast.unparse(call.func) == "abs":
        (one,) = arguments
        return [(f"{one} >= 0", one), (f"{one} < 0", f"-({one})")]
    strict, weak = (">", ">=") if ast.unparse(call.func) == "max" else ("<", "<=")
    cases = []
    for i, one in enumerate(arguments):
        order = [
            f"{one} {strict if k < i else weak} {other}"
            for k, other in enumerate(arguments)
            if k != i
        ]
        cases.append((" and ".join(order), one))
    return cases


def _replaced(node: ast.expr, call: str, term: str) -> str:
    class Put(ast.NodeTransformer):
        def visit_Call(self, one: ast.Call) -> ast.AST:
            if ast.unparse(one) == call:
                return checker.parse(f"({term})")
            self.generic_visit(one)
            return one

    return checker_text(Put().visit(deepcopy(node)))


def symbols(names: Iterable[str]) -> list[Expr]:
    """The names as SymPy's real symbols."""
    return [sympy.Symbol(name, real=True) for name in names]
