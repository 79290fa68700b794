"""Trees of formulas: True, False, a leaf, or ("and" or "or", parts); what formulas of all kinds
have in common.

A leaf is whatever is no join: an atom of the checker, a relation of a numbered polynomial, a fact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, TypeGuard, TypeVar

Op = Literal["and", "or"]
Tree = TypeVar("Tree")  # a kind of tree; a kind is told by its leaves
HOLDS: Mapping[str, Callable[[Any], bool]] = {  # of a value, or only its sign
    ">": lambda value: bool(value > 0),
    ">=": lambda value: bool(value >= 0),
    "=": lambda value: bool(value == 0),
    "!=": lambda value: bool(value != 0),
}
OPPOSITE = {">": ">=", ">=": ">", "=": "!=", "!=": "="}  # not p > 0 is -p >= 0


def is_join(tree: object) -> TypeGuard[tuple[Op, Sequence[Any]]]:
    """Whether the tree is a conjunction or a disjunction."""
    return isinstance(tree, tuple) and tree[0] in ("and", "or")


def join(op: Op, parts: Sequence[Tree]) -> Tree:
    """The conjunction or disjunction, without constants and joins of the same kind inside.

    >>> join("or", [False, ("or", ["p", "q"]), ("and", ["r", "s"])])
    ('or', ('p', 'q', ('and', ['r', 's'])))
    """
    flat: list[Any] = []
    for part in parts:
        if isinstance(part, bool):
            if part is (op == "or"):
                return part
        elif is_join(part) and part[0] == op:
            flat += part[1]
        else:
            flat.append(part)
    whole: Any = (op, tuple(flat)) if len(flat) > 1 else flat[0] if flat else op == "and"
    joined: Tree = whole
    return joined


def conjuncts(tree: Tree) -> Sequence[Tree]:
    """The parts of a conjunction, none of True; of anything else the tree alone."""
    if tree is True:
        return ()
    return tree[1] if is_join(tree) and tree[0] == "and" else (tree,)


def leaves(tree: object) -> Iterator[Any]:
    """Every leaf, from left to right."""
    if is_join(tree):
        for part in tree[1]:
            yield from leaves(part)
    elif not isinstance(tree, bool):
        yield tree


def mapped(
    tree: object,
    change: Callable[[Any], Tree],
    joining: Callable[[Op, Sequence[Tree]], Tree] = join,
) -> Tree:
    """The tree with changed leaves; they are changed from left to right, as far as they matter.

    >>> mapped(("and", ["p", "q", "r"]), lambda leaf: leaf.upper() if leaf > "p" else True)
    ('and', ('Q', 'R'))
    """
    if isinstance(tree, bool):
        return joining("and" if tree else "or", [])
    if not is_join(tree):
        return change(tree)
    op, parts = tree
    changed: list[Tree] = []
    for part in parts:
        new = mapped(part, change, joining)
        if new is (op == "or"):
            return new
        changed.append(new)
    return joining(op, changed)


def negated(
    tree: object,
    opposite: Callable[[Any], Tree],
    joining: Callable[[Op, Sequence[Tree]], Tree] = join,
) -> Tree:
    """The negation, with `not` driven down to the leaves."""
    if isinstance(tree, bool):
        return joining("or" if tree else "and", [])
    if not is_join(tree):
        return opposite(tree)
    parts = [negated(part, opposite, joining) for part in tree[1]]
    return joining("or" if tree[0] == "and" else "and", parts)


def truth(tree: object, decide: Callable[[Any], bool | None]) -> bool | None:
    """The truth value of a tree from those of its leaves; None where they leave it open.

    >>> truth(("and", ["p", ("or", ["q", "r"])]), {"p": True, "q": None, "r": True}.__getitem__)
    True
    """
    if isinstance(tree, bool):
        return tree
    if not is_join(tree):
        return decide(tree)
    decisive, unsure = tree[0] == "or", False
    for part in tree[1]:
        value = truth(part, decide)
        if value is decisive:
            return value
        unsure = unsure or value is None
    return None if unsure else not decisive


def written(tree: object, text: Callable[[Any], str]) -> str:
    """The tree as an s-expression.

    >>> written(("and", ["p", ("or", ["q", False])]), str)
    '(and p (or q false))'
    """
    if isinstance(tree, bool):
        return "true" if tree else "false"
    if not is_join(tree):
        return text(tree)
    return f"({tree[0]} {' '.join(written(part, text) for part in tree[1])})"
