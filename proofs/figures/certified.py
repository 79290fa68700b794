"""What the figures show that the paper lacks: the trap, and what orbits come to."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from sympy import Expr, Rational, Symbol

from juggleproof.proofs.restitution.settling import RANGES
from juggleproof.proofs.restitution.unequal import FLIGHTS
from juggleproof.proofs.theorem.definition import TO_THE_POINT, TRAP
from juggleproof.reports.contents import Entry
from juggleproof.reports.results import no_range
from juggleproof.reports.words import read
from juggleproof.statements.language import ClaimError, Formula, Term

Range = tuple[Fraction, Fraction]
Flights = tuple[int, ...]

SETTLED = ("theorem", "theorem-one-third", "restitution-to-a-half", "restitution-half", *RANGES)


def what_attracts(entries: Iterable[Entry]) -> tuple[list[Range], Flights, Range]:
    """The ranges of the claims by which every orbit tends to some e_K; and the flights of another
    orbit, and where it attracts. Raises ClaimError where one of them fails.
    """
    sharp = {entry.claim.id: entry.sharp for entry in entries if entry.verdict == "holds"}

    def span(claim_id: str) -> Range:
        found = read(sharp.get(claim_id, no_range()).removeprefix("at least "))[0][1]
        if not found:
            raise ClaimError(f"{claim_id} holds on no range that can be drawn")
        return found[0][0], found[-1][1]

    return [span(claim_id) for claim_id in SETTLED], FLIGHTS, span("restitution-unequal-room")


def what_the_trap_shows(_: object = ()) -> tuple[Expr, tuple[Expr, Expr], list[tuple[Expr, bool]]]:
    """The rank, the root that it is written with and its square, and the margins of the trap, as
    the theorem's definition has them.
    """
    ((root, square),) = TO_THE_POINT.roots
    parts = TRAP.parts if TRAP.op == "and" else (TRAP,)
    return (
        to_sympy(TO_THE_POINT.rank),
        (to_sympy(Term("var", root)), to_sympy(square)),
        [margin(part) for part in parts],
    )


def margin(relation: Formula) -> tuple[Expr, bool]:
    """What is positive where a strict relation holds, or not negative where one that is not strict
    does; and whether it is strict.  Raises ClaimError for what is no inequality.
    """
    less, more = relation.sides if relation.op in ("<", "<=") else reversed(relation.sides)
    if relation.op not in ("<", "<=", ">", ">="):
        raise ClaimError(f"{relation} has no margin; it is no inequality")
    return to_sympy(more) - to_sympy(less), relation.op in ("<", ">")


def to_sympy(expression: Term) -> Expr:
    """The SymPy expression of a term.

    >>> from juggleproof.statements.language import reals
    >>> x, w = reals("x w")
    >>> to_sympy((x - w) / 2 + 3 * x**2)
    -w/2 + 3*x**2 + x/2
    """
    if expression.op == "var":
        return Symbol(expression.name)
    if expression.op == "num":
        return Rational(expression.value.numerator, expression.value.denominator)
    if expression.op == "neg":
        return -to_sympy(expression.operands[0])
    if expression.op == "^":
        return to_sympy(expression.operands[0]) ** expression.exponent
    left, right = (to_sympy(part) for part in expression.operands)
    return {
        "+": lambda: left + right,
        "-": lambda: left - right,
        "*": lambda: left * right,
        "/": lambda: left / right,
    }[expression.op]()
