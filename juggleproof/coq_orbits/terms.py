"""Texts in the checker's syntax as Coq terms and propositions over the reals."""

from __future__ import annotations

import ast

from juggleproof.certificates import checker
from juggleproof.coq_store.text import coq_name
from juggleproof.statements.language import ClaimError

SUM, PRODUCT, SIGN, POWER, ATOM = 1, 2, 3, 4, 5
OPERATORS: dict[type, tuple[str, int]] = {
    ast.Add: (" + ", SUM),
    ast.Sub: (" - ", SUM),
    ast.Mult: (" * ", PRODUCT),
    ast.Div: (" / ", PRODUCT),
}
RELATIONS: dict[type, str] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "=",
    ast.NotEq: "<>",
}


def coq_term(text: str) -> str:
    """The Coq term of a text, each name with a prime.

    >>> coq_term("alpha*w - (x + 1)^2/2")
    "alpha' * w' - (x' + 1) ^ 2 / 2"
    """
    return term_of(checker.parse(text), 0)


def coq_formula(text: str) -> str:
    """The Coq proposition of a text, each name with a prime.

    >>> print(coq_formula("0 <= x and (x < w or not alpha*w = 1)"))
    0 <= x' /\\ (x' < w' \\/ ~ alpha' * w' = 1)
    """
    return formula_of(checker.parse(text), 0)


def term_of(node: ast.expr, level: int) -> str:
    """The Coq term of a syntax tree, in parentheses if its operator binds less tightly than the
    `level` around it.
    """
    if isinstance(node, ast.Constant) and type(node.value) is int:
        return str(node.value)
    if isinstance(node, ast.Name):
        return coq_name(node.id)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return _enclosed(f"- {term_of(node.operand, POWER)}", SUM, level)
    if (
        isinstance(node, ast.BinOp)
        and isinstance(node.op, ast.Pow)
        and isinstance(node.right, ast.Constant)
    ):
        return _enclosed(f"{term_of(node.left, ATOM)} ^ {term_of(node.right, ATOM)}", POWER, level)
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        sign, own = OPERATORS[type(node.op)]
        return _enclosed(term_of(node.left, own) + sign + term_of(node.right, own + 1), own, level)
    raise ClaimError(f"no Coq term for {ast.unparse(node)}")


def formula_of(node: ast.expr, level: int) -> str:
    """The Coq proposition of a syntax tree; level 0, 1, 2, 3: inside an implication, a disjunction,
    a conjunction, a negation.
    """
    if isinstance(node, ast.Compare) and all(type(op) in RELATIONS for op in node.ops):
        sides = [term_of(side, 0) for side in (node.left, *node.comparators)]
        atoms = [
            f"{left} {RELATIONS[type(op)]} {right}"
            for left, op, right in zip(sides, node.ops, sides[1:])
        ]
        return _enclosed(" /\\ ".join(atoms), 3 if len(atoms) == 1 else 2, level)
    if isinstance(node, ast.BoolOp):
        own, sign = (2, " /\\ ") if isinstance(node.op, ast.And) else (1, " \\/ ")
        return _enclosed(sign.join(formula_of(part, own + 1) for part in node.values), own, level)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return _enclosed(f"~ {formula_of(node.operand, 3)}", 3, level)
    if (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id in ("implies", "iff")
        and len(node.args) == 2
    ):
        sign = " -> " if node.func.id == "implies" else " <-> "
        return _enclosed(
            formula_of(node.args[0], 1) + sign + formula_of(node.args[1], 1), 0, level + 1
        )
    raise ClaimError(f"no Coq proposition for {ast.unparse(node)}")


def _enclosed(text: str, own: int, level: int) -> str:
    return f"({text})" if own < level else text


def names_in(text: str) -> set[str]:
    """The names that occur in a text, without `sqrt`."""
    return names_of(checker.parse(text)) - {"sqrt"}


def names_of(node: ast.AST) -> set[str]:
    """The names that occur in a syntax tree."""
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
