"""Terms of a statement as SMT-LIB text without expanding them: what a recurrence and an algebraic
end point are asked in.

Expanded by the checker, a recurrence that holds is 0 = 0 and leaves a solver nothing to ask; as it
stands, it does.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import Any

from certificates.checker import parse

OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}

# words that a solver reads as its own: an underscored spelling keeps the variable apart from them
TAKEN = frozenset(
    "abs div mod ite let forall exists par as xor distinct true false pi euler e exp log sin cos"
    " tan to_real to_int is_int is match select store assert push pop reset exit model".split()
)


def symbol(name: str) -> str:
    """The name as an SMT-LIB symbol that no theory has taken; names of statements hold no `!`."""
    return name + "!" if name in TAKEN else name


def write_term(tree: Any, values: Mapping[str, str]) -> str:
    """The term with these texts in place of its names; a whole power as a product.

    >>> write_term(ast.parse("x**2/2 - K", mode="eval").body, {"x": "(+ y 1)", "K": "0"})
    '(- (/ (* (+ y 1) (+ y 1)) 2) 0)'
    """
    if isinstance(tree, ast.Constant):
        return str(tree.value)
    if isinstance(tree, ast.Name):
        return values[tree.id]
    if isinstance(tree, ast.UnaryOp):
        return f"(- {write_term(tree.operand, values)})"
    left = write_term(tree.left, values)
    if isinstance(tree.op, ast.Pow):
        exponent = tree.right.value
        return f"(* {' '.join([left] * exponent)})" if exponent > 1 else left if exponent else "1"
    return f"({OPERATORS[type(tree.op)]} {left} {write_term(tree.right, values)})"


def recurrence(statement: Any) -> list[str]:
    """P(0) is not the identity, or map(P(K)) is not P(K + 1); for all real K, where what is meant
    is an integer: it is an identity.
    """
    (variables,), ((arguments, images),), ((count, powers),) = (
        statement.get(keyword) for keyword in ("forall", "iterates", "after")
    )
    images, powers = ([parse(text) for text in terms] for terms in (images, powers))
    plain = {name: symbol(name) for name in variables}
    k = count[0]

    def image(trees: Sequence[Any], changes: Mapping[str, str]) -> list[str]:
        values = {**plain, **changes}
        for name, tree in statement.get("let"):
            values[name] = write_term(tree, values)
        return [write_term(tree, values) for tree in trees]

    pairs = [
        *zip(image(powers, {k: "0"}), (plain[name] for name in arguments)),
        *zip(
            image(images, dict(zip(arguments, image(powers, {})))),
            image(powers, {k: f"(+ {plain[k]} 1)"}),
        ),
    ]
    fails = " ".join(f"(not (= {left} {right}))" for left, right in pairs)
    return [
        *(f"(declare-const {plain[name]} Real)" for name in variables),
        f"(assert (or {fails}))",
    ]


def number_checks(name: str, polynomial: Any, low: Any, high: Any) -> list[tuple[str, list[str]]]:
    """The polynomial has exactly one root between the ends: its signs at them are opposite, and no
    two roots lie there.
    """
    (variable,) = {node.id for node in ast.walk(polynomial) if isinstance(node, ast.Name)}
    ends, roots = [write_term(end, {}) for end in (low, high)], [symbol(name), name + "!second"]
    at = {point: write_term(polynomial, {variable: point}) for point in (*ends, *roots)}
    return [
        (
            (
                "a solution shows that the ends are out of order, or that the signs at them are not"
                " opposite"
            ),
            [f"(assert (or (>= {ends[0]} {ends[1]}) (>= (* {at[ends[0]]} {at[ends[1]]}) 0)))"],
        ),
        (
            "a solution is a second root between the ends",
            [
                *(f"(declare-const {root} Real)" for root in roots),
                *(f"(assert (= {at[root]} 0))" for root in roots),
                (
                    f"(assert (and (<= {ends[0]} {roots[0]}) (< {roots[0]} {roots[1]}) (<="
                    f" {roots[1]} {ends[1]})))"
                ),
            ],
        ),
    ]
