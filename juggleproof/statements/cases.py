"""Lines of a map rule as a person writes them: decimals are exact fractions, and abs, max and min
are taken apart into their cases.
"""

from __future__ import annotations

import ast
import re
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction

from juggleproof.certificates import checker
from juggleproof.statements.definitions import formula_of, term_of
from juggleproof.statements.language import ClaimError, MapRule

Piece = tuple[str, tuple[str, ...]]  # guard, terms
ANYWHERE = "0 < 1"  # a formula that always holds, as text
FUNCTIONS = ("abs", "max", "min")
MOST_PIECES = 64  # after absolute values are taken apart
LONGEST = 60  # characters of a text in a message
LISTS = ("piece", "rank", "value")  # lines GUARD -> TERM, ..
FORMULAS = ("domain", "space", "on", "stage", "have")


def with_cases(rule: MapRule) -> MapRule:
    """The rule without abs, max and min, which the checker does not know: a line `piece`, `rank` or
    `value` becomes one line for each case, and a formula becomes the disjunction of its cases.

    >>> rule = MapRule("walk/ends", (("map", "walk/map"), ("domain", "a > 0.5"),
    ...                              ("rank", "abs(x)/a"), ("stage", "max(x, -x) <= 1")))
    >>> print(with_cases(rule).text())
    statement walk/ends
    map walk/map
    domain a > (1/2)
    rank x >= 0 -> x/a
    rank x < 0 -> -x/a
    stage x >= -x and x <= 1 or -x > x and -x <= 1
    """
    rows: list[tuple[str, str]] = []
    if any([*map(type, row)] != [str, str] for row in rule.rows):
        return rule  # `read_rule` reports the row that is not a pair of texts
    for keyword, text in rule.rows:
        try:
            rows += [(keyword, one) for one in _lines(keyword, text)]
        except (checker.Rejected, RecursionError):  # the checker says later why it rejects the text
            rows.append((keyword, text))
        except ClaimError as fault:
            line = short(f"{keyword} {text}")
            raise ClaimError(f"{rule.name}: the line `{line}`: {fault}") from None
    return rule if rows == [*rule.rows] else replace(rule, rows=tuple(rows))


def _lines(keyword: str, text: str) -> list[str]:
    """The texts of the lines that replace one line of this keyword."""
    if keyword in checker.NAMED:
        return [text]
    text = exact(text)
    guard, arrow, terms = text.rpartition("->")
    called = any(re.search(rf"\b{name}\(", text) for name in FUNCTIONS)
    if keyword == "piece" and not arrow:
        guard = ANYWHERE
    elif not called:
        return [text]
    if keyword in FORMULAS:
        cases = [f"({case} and ({formula}))" for case, (formula,) in taken_apart("", (text,))]
        return [str(formula_of(checker.parse(" or ".join(cases))))]
    if keyword not in LISTS:
        return [text]
    tree = checker.parse(terms)
    each = tree.elts if isinstance(tree, ast.Tuple) else [tree]
    pieces = taken_apart(guard.strip(), tuple(map(checker_text, each)))
    return [
        f"{formula_of(checker.parse(where))} -> {', '.join(_term(image) for image in images)}"
        for where, images in pieces
    ]


def _term(text: str) -> str:
    return str(term_of(checker.parse(text)))


def exact(text: str) -> str:
    """Decimals as exact fractions.

    >>> exact("0.3*x + .25")
    '(3/10)*x + (1/4)'
    """
    return re.sub(r"(?<![\w.])\d*\.\d+(?![\w.])", lambda number: f"({Fraction(number[0])})", text)


def checker_text(node: ast.AST) -> str:
    """The text of a syntax tree."""
    return ast.unparse(node).replace(" ** ", "^").replace("==", "=")


def short(text: str) -> str:
    """The text in one line, or its beginning where it is long."""
    text = " ".join(text.split())
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 2]}.."


def conjunction(*parts: str) -> str:
    """The conjunction of the formulas, without repetitions and without those that always hold."""
    kept = list(dict.fromkeys(part for part in parts if part and part != ANYWHERE))
    one = [f"({part})" if " or " in part else part for part in kept]
    return " and ".join(one) or ANYWHERE


def taken_apart(guard: str, images: tuple[str, ...]) -> list[Piece]:
    """The pieces without abs, max and min; where there are several, each has a guard of its own."""
    texts = [*([guard] if guard else []), *images]
    call = next(filter(None, (_inmost(checker.parse(text)) for text in texts)), None)
    if call is None:
        return [(guard or ANYWHERE, images)]
    pieces: list[Piece] = []
    for condition, term in _cases(call):
        put = [_replaced(checker.parse(text), ast.unparse(call), term) for text in texts]
        rest = put[1:] if guard else put
        pieces += taken_apart(conjunction(*put[: len(put) - len(rest)], condition), tuple(rest))
        if len(pieces) > MOST_PIECES:
            raise ClaimError(f"more than {MOST_PIECES} cases of abs, max and min in one line")
    return pieces


def _inmost(node: ast.expr) -> ast.Call | None:
    """A call of abs, max or min with no such call in it."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Call) and ast.unparse(inner.func) in FUNCTIONS:
            return next(filter(None, map(_inmost, inner.args)), None) or inner
    return None


def _cases(call: ast.Call) -> list[tuple[str, str]]:
    """The cases (condition, value of the call); exactly one condition holds at each state."""
    arguments = [checker_text(argument) for argument in call.args]
    if not arguments or ast.unparse(call.func) == "abs" and len(arguments) > 1:
        raise ClaimError(f"{short(checker_text(call))}: abs takes one term, max and min more")
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
