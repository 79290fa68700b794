"""Exported LaTeX read back: it becomes Python, as does the text of the statement that it was made
from, and the two are compared.  Nothing here is shared with the printer.

Formulas must have the same relations in the same places, with the same signs, and the sides of each
relation must have equal values at random rational points: truth alone would hardly ever tell an
equation from another, nor a <= b from a < b.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from fractions import Fraction
from random import Random

# From the paper's table II, and what statements add to it.
GLYPHS = {
    r"\frac{\partial\Delta_1 E}{\partial\bar\beta}": "dE_dbeta",
    r"\frac{\partial\Delta_1 E}{\partial\dot{\bar\beta}}": "dE_dv",
    r"\frac{\partial R}{\partial\bar\beta}": "dR_dbeta",
    r"\frac{\partial R}{\partial\dot{\bar\beta}}": "dR_dv",
    r"\dot\rho_0": "r",
    r"\dot{\bar\beta}": "v",
    r"\dot\chi": "chi_dot",
    r"\Delta_1 E": "change_1",
    r"\Delta_2 E": "change_2",
    r"\Delta E": "dE",
    r"\bar\beta": "beta",
    r"\gamma": "g",
    r"\epsilon": "eps",
    r"\lambda": "lam",
    **{f"\\{one}": one for one in "alpha tau theta pi Gamma rho mu sigma omega delta chi".split()},
}
SIGNS = {
    "=": "==",
    r"\le": "<=",
    r"\ge": ">=",
    r"\ne": "!=",
    r"\land": "and",
    r"\lor": "or",
    r"\lnot": "not",
    r"\cdot": "*",
    **{sign: sign for sign in "<>+-"},
}
CLOSING = {"(": ")", r"\left(": r"\right)"}
LITERAL = "|".join(
    re.escape(one) + ("(?![A-Za-z])" if re.search(r"\\[A-Za-z]+$", one) else "") for one in GLYPHS
)
BELOW = (
    r"\{\\mathrm\{(?P<words>[a-z ]+)\}\}|\{\\(?P<command>max|sup)\}|\{(?P<many>\d+)\}"
    r"|\\?(?P<one>tau|\w)"
)
TOKEN = re.compile(
    rf"(?P<glyph>{LITERAL}|\\mathit\{{[a-z]+\}}|[A-Za-z])(?:_(?:{BELOW}))?"
    r"|(?P<digits>\d+)|\^(?P<power>\d|\{\d+\})|(?P<fraction>\\frac\{)"
    r"|(?P<how>\\iff|\\implies)|(?P<sign>\\left\(|\\right\)|\\[a-z]+|[-+=<>()}])"
)
FACTOR = ("glyph", "digits", "power", "fraction", "bracket")


class NotRead(ValueError):
    """LaTeX that has no meaning here, or several."""


def python_of(latex: str) -> str:
    """Return an exported term or formula as Python.

    Raises NotRead for what has no meaning here, or several, such as a number after a factor.
    """
    shown, rest = _until("", latex)
    if rest:
        raise NotRead(f"left over: {rest}")
    return shown


def _until(closing: str, latex: str) -> tuple[str, str]:
    """What stands before the closing sign, as Python, and what follows it."""
    sides, hows, last = [""], list[str](), ""
    while latex := latex.lstrip():
        token = TOKEN.match(latex)
        kind = token.lastgroup or "" if token else ""
        if token is None:
            raise NotRead(f"no such sign: {latex}")
        latex = latex[token.end() :]
        if token[0] == closing:
            break
        if token["how"]:
            hows.append(token["how"][1:])
            sides.append("")
        elif token["power"]:
            if last not in ("glyph", "digits", "bracket"):
                raise NotRead(f"a power of what? {latex}")
            sides[-1] += f"**{token['power'].strip('{}')}"
        elif token["sign"] in SIGNS:
            sides[-1] += f" {SIGNS[token['sign']]} "
        else:
            if token["glyph"]:
                kind, text = "glyph", _name(token)
            elif token["digits"]:
                text = token["digits"]
            elif token["fraction"]:
                above, latex = _until("}", latex)
                below, latex = _until("}", latex.removeprefix("{"))
                text = f"(({above})/({below}))"
            elif token["sign"] in CLOSING:
                kind, (text, latex) = "bracket", _until(CLOSING[token["sign"]], latex)
                text = f"({text})"
            else:
                raise NotRead(f"no such sign: {token[0]}")
            if last in FACTOR and kind == "digits":
                raise NotRead(f"a number after a factor: {token[0]}")
            sides[-1] += ("*" if last in FACTOR else "") + text
        last = kind
    else:
        if closing:
            raise NotRead(f"no {closing}")
    if len(hows) > 1:
        raise NotRead(f"{hows} without brackets")
    return (f"{hows[0]}({', '.join(sides)})" if hows else sides[0].strip()), latex


def _name(token: re.Match[str]) -> str:
    name = GLYPHS.get(token["glyph"]) or re.sub(r"\\mathit\{(.*)\}", r"\1", token["glyph"])
    below = next(filter(None, token.group("words", "command", "many", "one")), "")
    return f"{name}_{below.replace(' ', '_')}" if below else name


# ------------------------------------------------------------ comparison

OPPOSITE = {"Lt": "GtE", "GtE": "Lt", "Gt": "LtE", "LtE": "Gt", "Eq": "NotEq", "NotEq": "Eq"}
SAME = {"dE_1": "change_1", "dE_2": "change_2"}  # two names of one glyph
Shape = tuple[object, ...]


def differences(pairs: Iterable[tuple[str, str]]) -> list[str]:
    """A line for each pair (statement text, LaTeX) that does not say the same."""
    return [
        f"{text} | {latex} | {why}" for text, latex in pairs if (why := difference(text, latex))
    ]


def difference(text: str, latex: str) -> str:
    """Why a statement's text and LaTeX do not say the same; "" where they do."""
    stated = re.sub(r"(?<![<>!])=", "==", text.replace("^", "**"))
    stated = re.sub(r"\b([A-Za-z]+)(\d+)\b", r"\1_\2", stated)
    stated = re.sub(r"\bdE_[12]\b", lambda name: SAME[name[0]], stated)
    try:
        one, other = (
            ast.parse(stated, mode="eval").body,
            ast.parse(python_of(latex), mode="eval").body,
        )
    except (NotRead, SyntaxError) as reason:
        return f"not read: {reason}"
    names = sorted({node.id for node in ast.walk(one) if isinstance(node, ast.Name)})
    for seed in range(4):
        random = Random(f"{seed} {text}")
        point = {  # none is a whole number
            name: Fraction(2 * random.randint(1, 499) + 1, 2 * random.randint(1, 49))
            for name in names
        }
        try:
            here, there = shape(one, point), shape(other, point)
        except (KeyError, ZeroDivisionError) as reason:
            return f"no value: {reason}"
        if here != there:
            return f"{here} against {there}"
    return ""


def shape(node: ast.expr, point: dict[str, Fraction], denied: bool = False) -> Shape:
    """A formula with `not` at no relation, `and` and `or`, and no `and` in an `and`, and the values
    of its terms at a point; not iff(a, b) stays as it is.
    """
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return shape(node.operand, point, not denied)
    if isinstance(node, ast.BoolOp):
        how = "and" if isinstance(node.op, ast.And) is not denied else "or"
        return joined(how, [shape(part, point, denied) for part in node.values])
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        left, right = node.args
        if denied and node.func.id == "implies":
            return joined("and", [shape(left, point), shape(right, point, True)])
        return (denied, node.func.id, shape(left, point), shape(right, point))
    if isinstance(node, ast.Compare):
        sides = [value(side, point) for side in (node.left, *node.comparators)]
        signs = [type(sign).__name__ for sign in node.ops]
        parts = [
            (OPPOSITE[sign] if denied else sign, left, right)
            for left, sign, right in zip(sides, signs, sides[1:])
        ]
        return joined("or" if denied else "and", parts) if len(parts) > 1 else parts[0]
    return (value(node, point),)


def joined(how: str, parts: Iterable[Shape]) -> Shape:
    return (how, *(one for part in parts for one in (part[1:] if part[0] == how else (part,))))


def value(node: ast.expr, point: dict[str, Fraction]) -> Fraction:
    if isinstance(node, ast.Name):
        return point[node.id]
    if isinstance(node, ast.Constant) and type(node.value) is int:
        return Fraction(node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -value(node.operand, point)
    if isinstance(node, ast.BinOp):
        left, right = value(node.left, point), value(node.right, point)
        if isinstance(node.op, ast.Add):
            return left + right
        if isinstance(node.op, ast.Sub):
            return left - right
        if isinstance(node.op, ast.Mult):
            return left * right
        if isinstance(node.op, ast.Div):
            return left / right
        if isinstance(node.op, ast.Pow) and right.denominator == 1:
            return left**right.numerator
    raise KeyError(f"no term: {ast.unparse(node)}")
