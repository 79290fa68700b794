"""Values known up to the accuracy of roots, and quotients between others."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly

from .condition import Condition
from .quotients import Quotient

NEGLIGIBLE = fmpq(1, 2**100)  # of values that come from rational approximations of roots


def possible(condition: Condition, name: str, value: fmpq, nearly: bool = False) -> bool:
    """Whether a condition can still be met with this value of a variable, as far as folding shows."""
    given = {name: value}
    return (condition.mapped(lambda p: rounded(p.subs(given))) if nearly else condition.substituted(given)).tree is not False


def rounded(poly: fmpq_mpoly) -> fmpq_mpoly:
    """The polynomial without the coefficients that are 0 but for the accuracy of roots."""
    if all(abs(c) >= NEGLIGIBLE for c in poly.coeffs()):
        return poly
    return poly.context().from_dict({powers: c for powers, c in poly.to_dict().items() if abs(c) >= NEGLIGIBLE})


def ring_names(poly: fmpq_mpoly) -> set[str]:
    """The variables that occur in a polynomial."""
    return {name for name, e in zip(poly.context().names(), poly.degrees()) if e}


def between(lines: Sequence[Quotient]) -> list[Quotient]:
    """For three of them, low + (a - low)*(b - low)/((a - low) + (b - low)): above low, and below a and b where both are above it."""
    found = []
    for k, low in enumerate(lines[:3]):
        above = [Quotient(q.top * low.bottom - low.top * q.bottom, q.bottom * low.bottom) for j, q in enumerate(lines[:5]) if j != k]
        for i, a in enumerate(above):
            for b in above[:i]:
                total = a.top * b.bottom + b.top * a.bottom
                if total != 0:
                    found.append(Quotient.reduced(low.top * total + low.bottom * a.top * b.top, low.bottom * total))
    return found
