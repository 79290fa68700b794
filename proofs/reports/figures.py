"""The figures of a report: those that need no claims as they are, and those that show ranges and the trap with what they show."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certificates.terms import ClaimError, Formula, Term
from proofs.reports.contents import Contents, gather
from proofs.reports.extras import needed
from proofs.reports.ranges import rows, without_alpha

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def figures(contents: Contents | None = None) -> list[tuple[str, str, str, str, Figure]]:
    """Every figure in order: slug, title, caption, alternative text and the figure; raises ClaimError where matplotlib is absent."""
    needed("matplotlib")
    from scenes.figures import TABLE

    entries = (contents or gather()).entries
    given = {"fig-ranges": lambda: (rows(entries), without_alpha(entries)), "fig-trap": what_the_trap_shows}
    return [(one.slug, f"Figure {one.number}. {one.title}" if one.number else one.title, one.caption, one.alt,
             one.draw(*given.get(one.slug, tuple)())) for one in TABLE]


def what_the_trap_shows() -> tuple[Any, tuple[Any, Any], list[tuple[Any, bool]]]:
    """The rank, the root that it is written with and its square, and the margins of the trap, as the theorem's definition has them."""
    from proofs.theorem.definition import TO_THE_POINT, TRAP

    ((root, square),) = TO_THE_POINT.roots
    parts = TRAP.args if TRAP.op == "and" else (TRAP,)
    return to_sympy(TO_THE_POINT.rank), (to_sympy(Term("var", root)), to_sympy(square)), [margin(part) for part in parts]


def margin(relation: Formula) -> tuple[Any, bool]:
    """What is positive where a strict relation holds, or not negative where one that is not strict does; and whether it is strict."""
    less, more = relation.args if relation.op in ("<", "<=") else reversed(relation.args)
    if relation.op not in ("<", "<=", ">", ">="):
        raise ClaimError(f"{relation} has no margin; it is no inequality")
    return to_sympy(more) - to_sympy(less), relation.op in ("<", ">")


def to_sympy(expression: Term) -> Any:
    """The SymPy expression of a term.

    >>> from certificates.terms import reals
    >>> x, w = reals("x w")
    >>> to_sympy((x - w) / 2 + 3 * x**2)
    -w/2 + 3*x**2 + x/2
    """
    from sympy import Rational, Symbol

    if expression.op == "var":
        return Symbol(expression.args[0])
    if expression.op == "num":
        return Rational(expression.args[0].numerator, expression.args[0].denominator)
    if expression.op == "neg":
        return -to_sympy(expression.args[0])
    if expression.op == "^":
        return to_sympy(expression.args[0]) ** expression.args[1]
    left, right = (to_sympy(part) for part in expression.args)
    return {"+": lambda: left + right, "-": lambda: left - right, "*": lambda: left * right, "/": lambda: left / right}[expression.op]()
