r"""Every print, correction and formula is drawn whole as MathML; what is not known is refused, not
left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import unescape
from xml.etree import ElementTree

import pytest

from juggleproof.reports.latex import latex_of
from juggleproof.reports.markup import FORMULAS, lines_of
from juggleproof.reports.mathml import mathml
from juggleproof.statements.language import ClaimError
from tests.reports.runs import contents
from tests.share import share

SIGNS = {
    **dict.fromkeys((r"\frac", r"\left", r"\middle", r"\right", r"\quad", r"\qquad", r"\\"), ""),
    **dict.fromkeys((r"\mathrm", r"\mathit", r"\text", r"\sqrt", r"\,", r"\right."), ""),
    r"\dot": "˙",
    r"\ddot": "¨",
    r"\overline": "‾",
    r"\bar": "‾",
    r"\circ": "∘",
    r"\epsilon": "ϵ",
    **{rf"\mathcal{{{letter}}}": seen for letter, seen in zip("BHKR", "ℬℋ𝒦ℛ")},
    r"\land": "∧",
    r"\lnot": "¬",
    r"\lor": "∨",
    r"\partial": "∂",
    r"\infty": "∞",
    r"\sup": "sup",
    r"\cdot": "·",
    r"\iff": "⟺",
    r"\implies": "⟹",
    r"\to": "→",
    r"\{": "{",
    r"\}": "}",
    ":=": "≔",
    "-": "−",
    "'": "′",
}
FENCED = {r"\begin{bmatrix}": "[", r"\end{bmatrix}": "]", r"\begin{cases}": "{"}
CHILDREN = {"mfrac": 2, "msup": 2, "msub": 2, "msubsup": 3, "mover": 2, "munder": 2, "msqrt": 1}
LEAVES = {"mi", "mo", "mn", "mtext"}
KNOWN = LEAVES | set(CHILDREN) | {"math", "mrow", "mspace", "mtable", "mtr", "mtd"}


def prints() -> list[str]:
    found = [entry.claim.printed for entry in contents().entries if entry.claim.printed]
    found += [
        str(entry.correction["text"])
        for entry in contents().entries
        if entry.correction and entry.correction["kind"] not in ("coefficients", "derived")
    ]
    return sorted(set(found))


def formulas() -> Iterator[str]:
    for entry in contents().entries:
        for shown in entry.statements:
            for keyword, content in lines_of(shown.text):
                if keyword in FORMULAS:
                    yield from content


def tree_of(latex: str) -> ElementTree.Element:
    return ElementTree.fromstring(mathml(latex))


def characters(element: ElementTree.Element) -> str:
    """What is seen of a formula, from left to right, without spaces."""
    return re.sub(r"\s", "", "".join(one.text or "" for one in element.iter() if one.tag in LEAVES))


def signs(latex: str) -> str:
    """What must be seen of a formula, in the order of its tokens: HTML's entities name most signs
    as LaTeX does.
    """
    seen = ""
    for token in re.findall(
        r"\\(?:begin|end|mathcal)\{\w+\}(?:\{l+\})?|\\right\.|\\[A-Za-z]+|\\.|:=|\S", latex
    ):
        if token.startswith((r"\begin", r"\end")):
            seen += FENCED.get(token, "")
        elif token in SIGNS:
            seen += SIGNS[token]
        elif token[:1] == "\\":
            entity = unescape(f"&{token[1:]};")
            seen += token[1:] if entity.startswith("&") else entity
        elif token not in "{}_^&":
            seen += token
    return seen


def test_every_print_is_drawn_holds() -> None:
    assert len(prints()) > 150
    for latex in prints():
        root = tree_of(latex)
        assert root.get("alttext") == " ".join(latex.split())
        assert characters(root) and "\\" not in characters(root), latex


def test_every_formula_of_a_statement_is_drawn_holds() -> None:
    found = sorted(set(formulas()))
    assert len(found) > 600
    for text in found[:: share(5, 1)]:
        assert "\\" not in characters(tree_of(latex_of(text))), text


def test_elements_have_the_children_that_they_need_holds() -> None:
    for latex in [*prints(), *map(latex_of, sorted(set(formulas()))[:: share(5, 1)])]:
        for element in tree_of(latex).iter():
            assert element.tag in KNOWN, (latex, element.tag)
            assert (
                len(element) == CHILDREN.get(element.tag, len(element))
                or element.tag == "msqrt"
                and len(element)
            ), (latex, element.tag)
            assert (
                not len(element) if element.tag in LEAVES else not (element.text or "").strip()
            ), (latex, element.tag)


def test_every_sign_is_seen_once_holds() -> None:
    for latex in [*prints(), *map(latex_of, sorted(set(formulas()))[:: share(5, 1)])]:
        assert sorted(characters(tree_of(latex))) == sorted(signs(latex)), latex


@pytest.mark.parametrize(
    "defect",
    [
        r"\unheard x",
        r"\frac{1}",
        r"\frac",
        r"{x",
        r"x}",
        r"\left( x",
        r"\left( x \right",
        r"x \right)",
        r"\begin{bmatrix} 1",
        r"\begin{unheard} 1 \end{unheard}",
        r"\begin{bmatrix} 1 \end{cases}",
        r"\end{bmatrix}",
        r"\mathcal{AB}",
        r"\mathcal{1}",
        r"\left\unheard x \right)",
        "",
        r"\\",
        "x_",
        "x^",
        "#",
        "$x$",
        r"\text{a {b} c}",
        "a\\",
        "%",
        "~",
        r"\color{red} x",
        r"\href{http://example.org}{x}",
        r"\left\alpha x \right)",
        r"{\left( x } \right)",
        r"\dot_0 x",
        "x^2^3",
        "x % y",
        r"\newcommand{\x}{y} x",
    ],
)
def test_rejects_what_cannot_be_drawn(defect: str) -> None:
    with pytest.raises(ClaimError, match="cannot be shown as MathML") as caught:
        mathml(defect)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("latex", "markup"),
    [
        (r"a = -b", '<mi>a</mi><mo>=</mo><mo form="prefix">−</mo><mi>b</mi>'),
        (r"a) - b", '<mi>a</mi><mo stretchy="false">)</mo><mo>−</mo><mi>b</mi>'),
        (r"x' - 1", "<msup><mi>x</mi><mo>′</mo></msup><mo>−</mo><mn>1</mn>"),
        (r"u_2'", "<msubsup><mi>u</mi><mn>2</mn><mo>′</mo></msubsup>"),
        (
            r"{\dot\rho}_0",
            '<msub><mover accent="true"><mi>ρ</mi><mo>˙</mo></mover><mn>0</mn></msub>',
        ),
        (
            r"\lim_{k\to\infty} K",
            (
                "<munder><mo>lim</mo><mrow><mi>k</mi><mo>→</mo><mi"
                ' mathvariant="normal">∞</mi></mrow></munder><mi>K</mi>'
            ),
        ),
        (r"E_{\max}", "<msub><mi>E</mi><mtext>max</mtext></msub>"),
        (r"E_{\mathrm{next}}", "<msub><mi>E</mi><mtext>next</mtext></msub>"),
        (r"a/b", '<mi>a</mi><mo lspace="0" rspace="0">/</mo><mi>b</mi>'),
        (r"\Delta", '<mi mathvariant="normal">Δ</mi>'),
        (r"a < b & c", "<mi>a</mi><mo>&lt;</mo><mi>b</mi><mi>c</mi>"),
        (r"\text{so that} T", "<mtext>\u00a0so\u00a0that\u00a0</mtext><mi>T</mi>"),
    ],
)
def test_markup_is_as_it_should_be_holds(latex: str, markup: str) -> None:
    assert re.sub(r"^<math[^>]*>|</math>$", "", mathml(latex)) == markup


def test_lines_become_a_table_of_lines_holds() -> None:
    root = tree_of(
        r"0 < \alpha < 1 \\ \begin{bmatrix} 1 & 2 \\ 3 & 4 \end{bmatrix} = \begin{cases} a : b \\ c"
        r" : d \end{cases}"
    )
    assert [child.tag for child in root] == ["mtable"] and len(root[0]) == 2
    assert [len(table) for table in root[0].iter("mtable")] == [2, 2, 2]


def test_text_is_escaped_holds() -> None:
    assert mathml(r"a < b \text{<script>}") == (
        r'<math alttext="a &lt; b \text{&lt;script&gt;}">'
        "<mi>a</mi><mo>&lt;</mo><mi>b</mi><mtext>\u00a0&lt;script&gt;\u00a0</mtext></math>"
    )
