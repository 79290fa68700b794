"""LaTeX of the paper and of `latex_of` as MathML Core, which browsers draw without a script.  An
unknown command is an error; nothing is left out.

latex2mathml converts. It draws an unknown command as text, skips environments and comments, and
splits words into letters.  So a formula may have only the tokens listed here; it is first spelled
in a form that latex2mathml draws correctly, and then its operators are set as MathML Core needs it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from html import escape, unescape
from xml.etree.ElementTree import Element, tostring

from juggleproof.judging.extras import needed
from juggleproof.statements.language import ClaimError

# -------------------------------------------------------------------------------------------------
# The tokens that a formula may have.

COMMANDS = frozenset(
    r"""
    alpha beta gamma delta epsilon varepsilon eta theta kappa lambda mu nu xi pi rho sigma tau phi
    chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega infty partial emptyset
    le leq ge geq ne neq equiv approx lt gt in notin subset subseteq cap cup setminus cdot times
    circ pm mid to mapsto colon coloneq land lor lnot neg implies iff forall exists dots ldots
    { } lfloor rfloor lceil rceil langle rangle lvert rvert , : ; quad qquad \
    overline bar dot ddot hat tilde vec lim max min sup inf det sin cos exp log ln
    frac sqrt left middle right mathcal mathbb mathrm mathit text begin end
    """.split()
)
ENVIRONMENTS = frozenset({"bmatrix", "pmatrix", "matrix", "array", "cases"})
FENCES = frozenset("()[]|.") | frozenset(
    r"\{ \} \mid \lfloor \rfloor \lceil \rceil \langle \rangle \lvert \rvert".split()
)
TOKEN = re.compile(r"\\(?:begin|end|text)\{[^{}]*\}|\\[A-Za-z]+|\\.|.", re.DOTALL)
SIGNS = frozenset("+-=<>,;:!.*/|()[]{}_^&' ")


def _checked(latex: str) -> list[str]:
    """The tokens of a formula; raises ValueError where one is unknown or a bracket stays open."""
    tokens: list[str] = TOKEN.findall(latex)
    braces, environments = 0, list[str]()
    for before, token in zip(["", *tokens], tokens):
        command, name = token, ""
        if token.startswith((r"\begin", r"\end", r"\text")):
            command, _, name = token.removesuffix("}").partition("{")
        if token[0] == "\\" and (
            command[1:] not in COMMANDS
            or command in (r"\begin", r"\end")
            and name not in ENVIRONMENTS
            or token == r"\text"
        ):
            raise ValueError(f"{token} is not known")
        if token[0] != "\\" and not (token.isascii() and token.isalnum() or token in SIGNS):
            raise ValueError(f"{token} has no meaning there")
        if before in (r"\left", r"\middle", r"\right") and token not in FENCES:
            raise ValueError(f"{token} is no bracket")
        if command == r"\begin":
            environments.append(name)
        if command == r"\end" and (not environments or environments.pop() != name):
            raise ValueError(f"{token} without its beginning")
        braces += (token == "{") - (token == "}")
        if braces < 0:
            raise ValueError("} without its beginning")
    if braces or environments:
        raise ValueError("it ends too early")
    return tokens


# -------------------------------------------------------------------------------------------------
# The spelling for latex2mathml, and the changes to its markup.

SPELLED = (
    (re.compile(r":="), r"\\coloneq "),
    (re.compile(r"\\text\{\s*([^{}]*?)\s*\}"), r"\\text{ \1 }"),  # spaces around words
    (re.compile(r"\\mathrm\{([^{}]+)\}"), r"\\text{\1}"),  # a word is one element
    (re.compile(r"\\mathit\{([^{}]+)\}"), r"\\textit{\1}"),
    (re.compile(r"([_^])\{\\(lim|max|min|sup|inf)\}"), r"\1{\\text{\2}}"),
    (re.compile(r"\\(lim|max|min|sup|inf)\s*_"), r"\\\1\\limits_"),
    (re.compile(r"(\\begin\{[bp]matrix\}.*?\\end\{[bp]matrix\})"), r"{\1}"),
)
OPERATORS = frozenset(":¬′⟹⟺⌊⌋⌈⌉⟨⟩±⧵…")  # latex2mathml takes these for names
NAMES = frozenset("∂∞∅")  # latex2mathml takes these for operators
UPRIGHT = frozenset("ΓΔΘΛΞΠΣΦΨΩ∂∞∅")  # set upright by TeX
PREFIX = frozenset("+−±")  # written closer to what follows where no operand stands before them
CLOSING = frozenset(")]}|!⌋⌉⟩′")
CHILDREN = {"mfrac": 2, "msup": 2, "msub": 2, "msubsup": 3, "mover": 2, "munder": 2}


@cache
def mathml(latex: str, block: bool = False) -> str:
    r"""The formula as one <math> element, with its LaTeX as alternative text.

    Raises ClaimError, one line, for an unknown token.

    >>> mathml("x_1 < -2")  # doctest: +NORMALIZE_WHITESPACE
    '<math alttext="x_1 &lt; -2"><msub><mi>x</mi><mn>1</mn></msub><mo>&lt;</mo><mo
    form="prefix">−</mo><mn>2</mn></math>'
    """
    source = " ".join(latex.split())
    converter = needed("latex2mathml.converter").Converter()
    try:
        row: Element = converter.convert_to_element(_spelled(_checked(source)))[0]
        _set(row)
    except Exception as problem:  # latex2mathml's errors have no common class
        reason = str(problem) or type(problem).__name__
        raise ClaimError(f"{source!r} cannot be shown as MathML: {reason}") from None
    display = ' display="block"' if block else ""
    inner = "".join(tostring(one, "unicode", short_empty_elements=False) for one in row)
    return f'<math{display} alttext="{escape(source)}">{inner}</math>'


def _spelled(tokens: list[str]) -> str:
    """The formula in a form that latex2mathml draws correctly; several lines become one table.

    Outside of an environment, alignment marks are dropped, and so are line ends at the end.
    """
    lines, depth = [""], 0
    for token in tokens:
        depth += token.startswith(r"\begin") - token.startswith(r"\end")
        if token == r"\\" and not depth:
            lines.append("")
        elif token != "&" or depth:
            lines[-1] += token
    lines = [line for line in lines if line.strip()]
    if not lines:
        raise ValueError("there is nothing in it")
    latex = lines[0]
    if len(lines) > 1:
        latex = r"\displaylines{" + r"\\".join(lines) + "}"
    for pattern, spelled in SPELLED:
        latex = pattern.sub(spelled, latex)
    return latex


def _set(element: Element) -> None:
    """Changes an element and its descendants as MathML Core needs it; raises ValueError where an
    element lacks a part.
    """
    element.text = text = unescape(element.text or "")
    if element.tag == "mi" and text in OPERATORS:
        element.tag = "mo"
    elif element.tag == "mo" and text in NAMES:
        element.tag = "mi"
    if element.tag == "mi" and text in UPRIGHT:
        element.set("mathvariant", "normal")
    if element.tag == "mi" and not (text.isalpha() or text in NAMES):
        raise ValueError(f"{text or 'a script'} has no meaning there")
    if element.get("mathvariant", "normal") not in ("normal", "italic"):
        raise ValueError(f"{text} is no letter of this alphabet")
    if text == "/":
        element.attrib.update(lspace="0", rspace="0")
    for fence in [child for child in element if child.tag == "mo" and not child.text]:
        element.remove(fence)  # \left. and \right. leave an empty operator
    if len(element) != CHILDREN.get(element.tag, len(element)):
        raise ValueError("it ends too early")
    for at, child in enumerate(element):
        _set(child)
        if child.tag == "mrow" and len(child) == 1:
            element[at] = child[0]
    if element.tag == "mover":  # only accents stand above
        element.set("accent", "true")
        element[1].text = (element[1].text or "").translate({ord("―"): "‾", ord("¯"): "‾"})
        if element[1].text == "‾":
            element[1].attrib.pop("stretchy", None)  # MathML Core stretches it by default
    for row in [[child] for child in element] if element.tag in CHILDREN else [element]:
        _set_prefixes(row)


def _set_prefixes(row: Iterable[Element]) -> None:
    """Marks each sign without an operand before it as a prefix."""
    follows = False
    for child in row:
        if child.tag == "mo" and child.text in PREFIX and not follows:
            child.set("form", "prefix")
        if child.tag != "mspace":
            follows = child.tag != "mo" or child.text in CLOSING
