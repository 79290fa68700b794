r"""The tree of a print: plain frozen nodes for what is on paper, before names get a meaning.

Every node has the position `at` where it starts; two nodes are equal when they have the same
content, whatever their positions are.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

ACCENT_COMMANDS = {
    "bar": r"\overline",
    "dot": r"\dot",
    "hat": r"\hat",
    "tilde": r"\tilde",
    "vec": r"\vec",
    "script": r"\mathcal",
    "blackboard": r"\mathbb",
}


@dataclass(frozen=True, slots=True)
class Tree:
    """A node of the tree, with the position of its first token in the print."""

    at: int = field(compare=False, kw_only=True, default=0)


@dataclass(frozen=True, slots=True)
class Number(Tree):
    """A numeral."""

    value: int | Fraction


@dataclass(frozen=True, slots=True)
class Sign(Tree):
    r"""A bare sign as a script, as in \mathcal{B}_1^+; in an environment's key, \cdot is the place
    of an argument.
    """

    sign: str


@dataclass(frozen=True, slots=True)
class Name(Tree):
    """A letter (or a word, in a subscript) with its sorted accents, its subscripts and its
    primes.
    """

    base: str
    accents: tuple[str, ...] = ()
    subscripts: tuple[Tree, ...] = ()
    primes: int = 0


@dataclass(frozen=True, slots=True)
class Quotient(Tree):
    r"""\frac{top}{bottom}, or top/bottom when `slash` is set."""

    top: Tree
    bottom: Tree
    slash: bool = field(compare=False, default=False)


@dataclass(frozen=True, slots=True)
class Root(Tree):
    r"""\sqrt{radicand}."""

    radicand: Tree


@dataclass(frozen=True, slots=True)
class Power(Tree):
    """base^exponent: a power or a superscript; the environment decides which."""

    base: Tree
    exponent: Tree


@dataclass(frozen=True, slots=True)
class Binary(Tree):
    r"""left sign right, for + - * \cdot \times \circ \cup \cap \setminus."""

    sign: str
    left: Tree
    right: Tree


@dataclass(frozen=True, slots=True)
class Negative(Tree):
    """-operand."""

    operand: Tree


@dataclass(frozen=True, slots=True)
class Juxtaposition(Tree):
    """Factors side by side: products or applications, not yet distinguished."""

    factors: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Group(Tree):
    r"""(..), [..], \lfloor..\rfloor or \lceil..\rceil around one or more items."""

    bracket: str
    items: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Absolute(Tree):
    """|content|."""

    content: Tree


@dataclass(frozen=True, slots=True)
class Component(Tree):
    """[content]_index."""

    content: Tree
    index: Tree


@dataclass(frozen=True, slots=True)
class Array(Tree):
    """A matrix by rows; a single column is a vector."""

    rows: tuple[tuple[Tree, ...], ...]


@dataclass(frozen=True, slots=True)
class Cases(Tree):
    """Values, each with the condition under which it holds."""

    pieces: tuple[tuple[Tree, Tree], ...]


@dataclass(frozen=True, slots=True)
class SetBuilder(Tree):
    r"""{element | conditions}."""

    element: Tree
    conditions: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Operator(Tree):
    r"""\Delta, \partial, \nabla or D before a name: \Delta_1 E, \partial\mathcal{B}_2,
    D_{\overline\beta} R.
    """

    sign: str
    subscripts: tuple[Tree, ...]
    operand: Tree


@dataclass(frozen=True, slots=True)
class Derivative(Tree):
    r"""\frac{\partial of}{\partial by}."""

    of: Tree
    by: Tree


@dataclass(frozen=True, slots=True)
class Limit(Tree):
    r"""\lim_{variable \to destination} body."""

    condition: Tree
    body: Tree


@dataclass(frozen=True, slots=True)
class PrintedExtremum(Tree):
    r"""\max_{condition} body, and so \min, \sup, \inf."""

    sign: str
    condition: Tree | None
    body: Tree


@dataclass(frozen=True, slots=True)
class Restriction(Tree):
    """function|_{region}."""

    function: Tree
    region: Tree


@dataclass(frozen=True, slots=True)
class Chain(Tree):
    """The first side of a chain of relations, then pairs of a relation sign and the next side."""

    first: Tree
    rest: tuple[tuple[str, Tree], ...]


@dataclass(frozen=True, slots=True)
class ForAll(Tree):
    r"""\forall head, body."""

    head: Tree
    body: Tree


HOLE = Sign(r"\cdot")


def spelled(name: Tree) -> str:
    r"""A name as LaTeX, for messages; any other node as a word for its kind.

    >>> spelled(Name(r"\beta", ("bar", "dot"), (Number(0),)))
    '\\dot{\\overline{\\beta}}_{0}'
    """
    if isinstance(name, Number):
        return str(name.value)
    if isinstance(name, Sign):
        return name.sign
    if isinstance(name, Operator):
        return name.sign + _subscript(name.subscripts) + " " + spelled(name.operand)
    if isinstance(name, Power) and isinstance(name.base, Name):
        return f"{spelled(name.base)}^{{{spelled(name.exponent)}}}"
    if isinstance(name, Derivative):
        return rf"\frac{{\partial {spelled(name.of)}}}{{\partial {spelled(name.by)}}}"
    if isinstance(name, Group):
        return "(...)"
    if not isinstance(name, Name):
        return f"this {type(name).__name__.lower()}"
    text = name.base
    for accent in name.accents:
        text = f"{ACCENT_COMMANDS[accent]}{{{text}}}"
    return text + _subscript(name.subscripts) + "'" * name.primes


def _subscript(items: tuple[Tree, ...]) -> str:
    return (
        "_{"
        + ",".join("..." if spelled(item).startswith("this ") else spelled(item) for item in items)
        + "}"
        if items
        else ""
    )
