"""Trees: every display of the paper is read, marks tell names apart, and what is not a formula is
refused.
"""

from __future__ import annotations

import pytest

from juggleproof.reading.lexer import PrintError
from juggleproof.reading.parser import parse
from juggleproof.reading.tree import (
    Absolute,
    Binary,
    Cases,
    Chain,
    Component,
    Derivative,
    ForAll,
    Group,
    Juxtaposition,
    Limit,
    Name,
    Negative,
    Number,
    Operator,
    Power,
    PrintedExtremum,
    Quotient,
    Restriction,
    Root,
    SetBuilder,
    Sign,
    Tree,
)
from tests.reading.paper_names import ALL, RESTORED
from tests.rows import each_row

B, F, X = Name("b"), Name("f"), Name("x")
E = Name("E")
B_BAR = Name("b", ("bar",))


@each_row(("where", "latex"), ALL)
def test_every_display_of_the_paper_is_read(where: str, latex: str) -> None:
    parts = parse(latex)
    assert parts and all(part.at < len(latex) for part in parts)


@each_row(("where", "garbled", "restored"), RESTORED)
def test_a_garbled_display_is_refused_or_says_something_else(
    where: str, garbled: str, restored: str
) -> None:
    try:
        assert parse(garbled) != parse(restored)
    except PrintError as refusal:
        assert refusal.column > 0


@each_row(
    ("one", "other"),
    [
        (r"\dot{\overline{\beta}}", r"\overline{\dot{\beta}}"),
        (r"\dot{\overline{\beta}}_0", r"\overline{\dot\beta_0}"),
        (r"\bar b", r"\overline{b}"),
        (r"\ddot{x}", r"\dot{\dot{x}}"),
        (r"\dot\beta'", r"\dot{\beta'}"),
        (r"\mathcal{B}_1^0", r"\mathcal{B}^0_1"),
        (r"u'", r"u^{\prime}"),
        (r"E_{max}", r"E_{\max}"),
        (r"E_{max}", r"E_{\mathrm{max}}"),
        (r"\frac12", r"\frac{1}{2}"),
        (r"\overline{\mathbf{b}}", r"\overline{b}"),
        (r"a_{1}", "a_1"),
    ],
)
def test_the_same_name_in_two_spellings_is_one_tree(one: str, other: str) -> None:
    assert parse(one) == parse(other)


@each_row(
    ("one", "other"),
    [
        (r"\dot\beta", r"\overline\beta"),
        (r"\dot\beta", r"\dot\beta'"),
        (r"\dot\rho_0", r"\dot\rho"),
        (r"\mathcal{K}", "K"),
        (r"\mathcal{B}_1^+", r"\mathcal{B}_1^0"),
        (r"\ddot x", r"\dot x"),
        (r"K T", r"K_T"),
        (r"E_{max}", r"E_{sup}"),
        (r"a^2", r"a_2"),
        (r"\Delta_1 E", r"\Delta E_1"),
        (r"\Delta E(b)", r"\Delta E b"),
        (r"x \le y", r"x < y"),
    ],
)
def test_different_marks_are_different_trees(one: str, other: str) -> None:
    assert parse(one) != parse(other)


@each_row(
    ("latex", "tree"),
    [
        (r"-\alpha b + x", Binary("+", Negative(Juxtaposition((Name(r"\alpha"), B))), X)),
        (r"-x^2", Negative(Power(X, Number(2)))),
        (r"2x/b", Quotient(Juxtaposition((Number(2), X)), B)),
        (r"a^{k+1}", Power(Name("a"), Binary("+", Name("k"), Number(1)))),
        (r"E \circ f(b)", Binary(r"\circ", E, Juxtaposition((F, Group("(", (B,)))))),
        (
            r"E \circ f |_{\beta_2}",
            Binary(r"\circ", E, Restriction(F, Name(r"\beta", (), (Number(2),)))),
        ),
        (r"[x]_1", Component(X, Number(1))),
        (r"(x, b)", Group("(", (X, B))),
        (r"|x - b|", Absolute(Binary("-", X, B))),
        (r"2|x|", Juxtaposition((Number(2), Absolute(X)))),
        (r"\sqrt{2(b)}", Root(Juxtaposition((Number(2), Group("(", (B,)))))),
        (r"\frac{\partial E}{\partial b}", Derivative(E, B)),
        (
            r"\frac{\partial \Delta_1 E}{\partial b}",
            Derivative(Operator(r"\Delta", (Number(1),), E), B),
        ),
        (r"D_{x} E", Operator("D", (X,), E)),
        (
            r"D_x \Delta E(b)",
            Juxtaposition((Operator("D", (X,), Operator(r"\Delta", (), E)), Group("(", (B,)))),
        ),
        (r"\lim_{k\to\infty} f", Limit(Chain(Name("k"), ((r"\rightarrow", Name(r"\infty")),)), F)),
        (r"\max_{x \le b} f", PrintedExtremum(r"\max", Chain(X, ((r"\le", B),)), F)),
        (r"B^+", Power(Name("B"), Sign("+"))),
        (r"k^{th}", Power(Name("k"), Name("th"))),
        (r"\forall x \in f, x < b", ForAll(Chain(X, ((r"\in", F),)), Chain(X, (("<", B),)))),
        (r"\{b \mid x < b\}", SetBuilder(B, (Chain(X, (("<", B),)),))),
        (
            r"\{b \in f \mid |x| < b\}",
            SetBuilder(Chain(B, ((r"\in", F),)), (Chain(Absolute(X), (("<", B),)),)),
        ),
        (
            r"\begin{cases} x & \text{if } b < 1 \end{cases}",
            Cases(((X, Chain(B, (("<", Number(1)),))),)),
        ),
        (r"\left\lfloor x \right\rfloor", Group(r"\lfloor", (X,))),
        (r"a - b - x", Binary("-", Binary("-", Name("a"), B), X)),
        (r"0 \le x < b", Chain(Number(0), ((r"\le", X), ("<", B)))),
        (r"\overline{b}", B_BAR),
    ],
)
def test_a_formula_has_this_tree(latex: str, tree: Tree) -> None:
    assert parse(latex) == (tree,)


@each_row(
    ("latex", "parts"),
    [
        (r"0 < \alpha < 1 \\ \chi = x - y", 2),
        (r"x = 1, \qquad x \ge 0.", 2),
        (r"x = 1 \text{ and } y = 2.", 2),
        (r"x = 1 \\ = 2", 1),
        (r"x = 1 \\ y = 2 \\ z = 3.", 3),
    ],
)
def test_a_display_of_several_lines_has_its_parts(latex: str, parts: int) -> None:
    assert len(parse(latex)) == parts


@each_row(
    ("latex", "message"),
    [
        (r"x = ", "column 5: expected a formula instead of the end of the print"),
        (r"", "column 1: a print without a formula: the end of the print"),
        (r"(x + b", "column 7: expected ) before the end of the print"),
        (r"x + b)", "column 6: unexpected )"),
        (r"x 2", "column 3: a numeral after a factor: 2"),
        (r"x^2^3", "column 4: a second superscript ^"),
        (r"x_1_2", "column 4: a second subscript _"),
        (r"(x)_1", "column 4: a subscript under something that is not a name: _"),
        (r"\frac{1}{2}'", "column 12: a prime on something that is not a name: '"),
        (r"\dot{x+b}", r"column 1: \dot stands over something that is not a name"),
        (r"\{b, x\}", r"column 4: a set needs a bar and a condition before ,"),
        (r"\Delta = 1", "column 8: an operator needs a name before ="),
        (
            r"\begin{bmatrix} 1 & 2 \\ 3 \end{bmatrix}",
            "column 1: the rows of this bmatrix are not equally long",
        ),
        (r"\begin{cases} x \\ b \end{cases}", r"column 17: expected a condition before \\"),
        (r"\sqrt[3]{x}", "column 6: only square roots are read, not ["),
        (r"\frac{1}", "column 9: expected an argument instead of the end of the print"),
        (r"x = 1 . y = 2", "column 7: unexpected ."),
        (r"\lim f = 0", "column 8: a limit needs a condition before ="),
        (r"x \text{impacts}", "column 3: unexpected impacts"),
    ],
)
def test_what_is_not_a_formula_is_refused_by_token_and_column(latex: str, message: str) -> None:
    with pytest.raises(PrintError) as refusal:
        parse(latex)
    assert str(refusal.value) == message


def test_a_superscript_takes_one_digit_as_tex_does() -> None:
    with pytest.raises(PrintError, match="column 4: a numeral after a factor: 0"):
        parse(r"x^10")
    assert parse(r"x^{10}") == (Power(X, Number(10)),)
