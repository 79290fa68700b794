"""The readers and the comparison that the tests of reports rest on, tested."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from operator import add, mul, sub, truediv
from random import Random

import pytest
import sympy

from juggleproof.reports.latex import latex_of
from tests.reports.comparison import TEXTS, differences, drawn, read_latex, unknowns
from tests.reports.nodes import (
    Arithmetic,
    Formula,
    Implied,
    Joined,
    Listed,
    Name,
    Neg,
    Node,
    Not,
    NotRead,
    Num,
    Related,
    Unary,
    names_in,
)
from tests.reports.statement_text import evaluate_statement_text, read_statement_text

# -------------------------------------------------------------------------------------------------
# The evaluator of statement texts against Python's own evaluation of the same text, and what it
# refuses.

VALUES = {
    "alpha": Fraction(1, 8),
    "x": Fraction(11),
    "w": Fraction(13),
    "r": Fraction(3),
    "v": Fraction(-5),
    "dE_max": Fraction(2),
}


def by_python(text: str, values: dict[str, Fraction]) -> object:
    """The value as Python finds it, with ^ and = as in mathematics."""
    integers = re.sub(r"\b\d+\b", r"Fraction(\g<0>)", text)
    source = re.sub(r"(?<![<>!])=", "==", integers.replace("^", "**"))
    known = {"Fraction": Fraction, "implies": lambda a, b: not a or b, "iff": lambda a, b: a == b}
    return eval(source, {"__builtins__": {}}, {**known, **values})  # the texts are our own


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-x^2", -121),
        ("(-x)^2", 121),
        ("-1^2*x", -11),
        ("x - w - r", -5),
        ("x - -w", 24),
        ("x/w/r", Fraction(11, 39)),
        ("x/w*r", Fraction(33, 13)),
        ("2*-x", -22),
        ("x^0", 1),
        ("sqrt(2*(1 + alpha))", Fraction(3, 2)),
        ("x < w", True),
        ("x < w <= 13", True),
        ("not x < w", False),
        ("not x < w or x = 11", True),
        ("x = w or x < w and w < x", False),
        ("x != w and not w < x", True),
        ("iff(x < w, w < x)", False),
        ("implies(w < x, x = w)", True),
        ("alpha^2*r^2/2 - v <= dE_max and not x < w", False),
        ("x, -w", (11, -13)),
        ("(x, w)", (11, 13)),
    ],
)
def test_text_has_this_value_holds(text: str, expected: object) -> None:
    found = evaluate_statement_text(text, VALUES)
    assert found == expected and type(found) is not int


def test_every_statement_has_the_value_that_python_finds_holds() -> None:
    assert [text for text in TEXTS if not has_the_value_that_python_finds(text)] == []


def has_the_value_that_python_finds(text: str) -> bool:
    tree = read_statement_text(text)
    point = drawn(unknowns(tree, tree)[0], [], Random(text))
    assert {name.printed for name in names_in(tree)} <= set(point)
    return evaluate_statement_text(text, point) == by_python(text, point)


@pytest.mark.parametrize(
    "text",
    ["", "x +", "2x", "x w", "x(w)", "x^w", "x^-1", "x^2^3", "x == w", "x ** 2", "0.5", "(x", "x)",
     "x < w and", "and x", "not x", "x and w",
     "(x < w) < r", "x = not w < r", "iff(x < w)", "implies(x < w, x < r, w < r)", "iff", "+x",
     "1_000", "007", "sin(x)", "x < (w, r)",
     "lambda", "x; w"],
)  # fmt: skip
def test_rejects_what_is_not_in_the_language(text: str) -> None:
    with pytest.raises(NotRead):
        read_statement_text(text)


def test_rejects_a_name_without_a_value() -> None:
    with pytest.raises(NotRead, match="no one value"):
        evaluate_statement_text("x + y", VALUES)


# -------------------------------------------------------------------------------------------------
# The comparison notices what an edit of the exported LaTeX changes.
#
# Whether an edit changes the meaning is SymPy's to say: relations of cancelled differences, whose
# order in `and` and `or` does not matter.

EVERY = 6  # of the statements, for the edits
EDITS_EACH = 4
LONGEST = 160


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("not x < w", r"x \ge w"),
        ("not (x < w and w != 2)", r"x \ge w \lor w = 2"),
        ("0 <= x and x < w", r"0 \le x < w"),
        ("s*v > 0", r"\sqrt{2(1 + \alpha)}\,\dot{\bar\beta} > 0"),
        ("2*(1 + alpha) = s^2", r"2(1 + \alpha) = 2(1 + \alpha)"),
        ("beta/(r - v) < 2*r/g", r"\tau_c < T"),
        ("beta*g/(2*r^2) < 1 - v/r", r"x < w"),
        ("u = sqrt(4*x + (w - 1)^2)", r"u = \sqrt{(w - 1)^2 + 4x}"),
        ("x = w", r"x = w^{1}\cdot 1 + 0"),
        ("alpha < r^2/r", r"\alpha < \dot\rho_0"),
        ("0 = 1", "0 = 1"),
        (
            "2*alpha/(alpha + 1)^2, 2/(alpha + 1)",
            r"\begin{bmatrix} \frac{2\alpha}{(1+\alpha)^2} \\ \frac{2}{1+\alpha} \end{bmatrix}",
        ),
        ("not iff(x < w, w < u)", r"\lnot (x < w \iff w < u)"),
        ("not implies(x < w, w < u)", r"x < w \land w \ge u"),
    ],
)
def test_what_means_the_same_agrees_holds(text: str, latex: str) -> None:
    assert differences([(text, latex)]) == []


@pytest.mark.parametrize(
    ("text", "latex", "reason"),
    [
        ("x <= w", "x < w", "a relation <="),
        ("x < w", "w > x", "a relation <"),
        ("x = w", "x = 2w", "against"),
        ("x < w and w < u", r"x < w \lor w < u", "joined by and"),
        ("implies(x < w, w < u)", r"x < w \iff w < u", "implies"),
        ("not iff(x < w, w < u)", r"x < w \iff w < u", "not against iff"),
        ("x < w", "x", "a term"),
        ("x, w", "(x, w, x)", "a list of 2"),
        ("x", "u", "not in the text"),
        ("x/(w - w)", r"\frac{x}{w - w}", "values at 0 points only"),
        ("x", r"x + \frac{0}{w - w}", "on one side only"),
        ("x", r"x + y + \sqrt", "not read"),
        ("x +", "x", "text is not read"),
        ("sqrt(x + w)", r"\sqrt{x - w}", "against"),
        ("x^2", "x^{2+w}", "on one side only"),
        ("T = 2*r/g", r"T = T", "against"),
        ("change_1 + dE_1", r"\Delta_1 E", "on one side only"),
    ],
)
def test_differences_tells_the_reason_holds(text: str, latex: str, reason: str) -> None:
    found = differences([(text, latex)])
    assert len(found) == 1 and reason in found[0] and text in found[0] and latex in found[0]


def test_points_depend_on_the_seed_alone_holds() -> None:
    pair = ("beta*g < r^2", r"\bar\beta\gamma < \dot\rho_0")
    assert differences([pair]) == differences([("x", "x"), pair]) != differences([pair], seed=1)


# ------------------------------------------------------------ edits

GLYPH = re.compile(
    r"\\dot\{\\rho\}_\{?0\}?|\\dot\{\\(?:bar|overline)\{?\\beta\}?\}(?:_\{?0\}?)?"
    r"|\\(?:alpha|gamma)\b|\b[xwutTK]\b(?!_)|\\tau_c"
)
SWAPS = [
    (r"\\leq?\b", "<"), (r"\\geq?\b", ">"), ("<", r"\\le "), (">", r"\\ge "), ("<", ">"),
    (">", "<"), ("=", r"\\ne "), (r"\\neq?\b", "="), ("<", "="),
    (r"\\(?:land|wedge)\b|\\text\{ and \}", r"\\lor "),
    (r"\\(?:lor|vee)\b|\\text\{ or \}", r"\\land "), (r"\\(?:lnot|neg)\b|\\text\{not \}", " "),
    (r"\\(?:Rightarrow|implies)\b", r"\\iff "), (r"\\(?:iff|Leftrightarrow)\b", r"\\implies "),
    ("-", ""), ("-", "+"), (r"\+", "-"),
    (r"\^(?:2|\{2\})", "^3"), (r"\^(?:\d|\{\d+\})", ""), (r"\b2\b", "3"), (r"\b1\b", "2"),
    (r"_(?:0|\{0\})", ""),
    (r"\\dot(?=\{)", ""), (r"\\overline|\\bar", ""),
    (r"\\t?frac", r"\\sqrt"), (r"\\max", r"\\sup"), (r"\\sqrt\{", "{"), (r"\\cdot", "+"),
    (r"\(", ""), (r"\)", ""),
]  # fmt: skip


def edits(latex: str, random: Random) -> Iterator[str]:
    """The LaTeX with one mark changed, or two names exchanged: an edit of a kind that is drawn
    first.
    """
    while True:
        pattern, put = random.choice(SWAPS)
        if random.random() < 0.2:
            names = list(GLYPH.finditer(latex))
            if len({name[0] for name in names}) > 1:
                one = random.choice(names)
                other = random.choice([name for name in names if name[0] != one[0]])
                yield latex[: one.start()] + other[0] + " " + latex[one.end() :]
        elif places := list(re.finditer(pattern, latex)):
            place = random.choice(places)
            yield latex[: place.start()] + place.expand(put) + latex[place.end() :]


OPERATORS = {"+": add, "-": sub, "*": mul, "/": truediv, "^": pow}
cancelled = cache(sympy.cancel)  # an edit leaves most relations as they were
OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "=": "!=", "!=": "="}


def meaning(node: Node, known: set[str]) -> object:
    """What a tree says, so that equal meanings are equal objects: up to algebra on each relation,
    and to the order of and, or, iff.
    """
    if isinstance(node, Listed):
        return tuple(meaning(entry, known) for entry in node.entries)
    if isinstance(node, Related):
        left, right = (node.right, node.left) if ">" in node.sign else (node.left, node.right)
        apart = cancelled(sympy_of(left, known) - sympy_of(right, known))
        if node.sign in ("=", "!="):
            apart = cancelled(-apart) if apart.could_extract_minus_sign() else apart
        return (node.sign.replace(">", "<"), apart)
    if isinstance(node, Not):
        inner = node.of
        if isinstance(inner, Related):
            return meaning(Related(inner.left, OPPOSITE[inner.sign], inner.right), known)
        return ("not", meaning(inner, known))
    if isinstance(node, Joined):
        return (node.how, frozenset(meaning(part, known) for part in node.parts))
    if isinstance(node, Implied):
        sides = (meaning(node.left, known), meaning(node.right, known))
        return (node.how, frozenset(sides) if node.how == "iff" else sides)
    return cancelled(sympy_of(node, known))


def sympy_of(node: Node, known: set[str]) -> sympy.Expr:
    if isinstance(node, Num):
        return sympy.Integer(node.number)
    if isinstance(node, Name):
        return sympy.Symbol(
            next((name for name in node.stands_for if name in known), node.stands_for[0])
        )
    if isinstance(node, Neg):
        return -sympy_of(node.of, known)
    if isinstance(node, Unary):
        return sympy.Function(node.function)(cancelled(sympy_of(node.of, known)))
    assert isinstance(node, Arithmetic)
    left, right = sympy_of(node.left, known), sympy_of(node.right, known)
    return OPERATORS[node.sign](left, right)


def test_edits_of_the_print_are_noticed_holds() -> None:
    random, noticed, missed, refused, idle = Random(5), 0, [], 0, 0
    for text in [text for text in TEXTS if 8 < len(text) < LONGEST][::EVERY]:
        stated = read_statement_text(text)
        if isinstance(stated, Listed):
            continue
        latex = latex_of(text)
        known = {name.printed for name in names_in(stated)}
        before = meaning(stated, known)
        for _, edited in zip(range(EDITS_EACH), edits(latex, random)):
            try:
                after = meaning(read_latex(edited), known)
            except NotRead:
                refused += 1
                continue
            if after == before:
                idle += 1
            elif differences([(text, edited)]):
                noticed += 1
            else:
                missed.append((text, edited))
    assert noticed > 300 and refused < noticed
    assert len(missed) <= 0.01 * noticed, missed


def test_the_judge_tells_formulas_apart_holds() -> None:
    def same(one: str, other: str) -> bool:
        known = {"x", "w", "u"}
        return meaning(read_latex(one), known) == meaning(read_latex(other), known)

    assert (
        same("x < w", "w > x")
        and same(r"x < w \land u < w", r"u - w < 0 \land x < w")
        and same("2x = w + x", "x = w")
    )
    assert (
        not same("x < w", r"x \le w")
        and not same("x < w", "w < x")
        and not same(r"x < w \land u < w", r"x < w \lor u < w")
    )
    assert isinstance(read_latex("x < w"), Formula)
