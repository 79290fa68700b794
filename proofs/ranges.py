"""Sharp ranges: asks the search for one, and tells it as intervals with exact end points."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.numbers import AlgebraicNumber
from juggleproof.certificates.language import (
    Formula,
    SharpRange,
    Statement,
    Term,
    conjunction,
    disjunction,
    real,
)
from juggleproof.certificates.search.families import says_domain, solved
from juggleproof.certificates.search.ranges import Line, pinned, polynomial_term
from juggleproof.certificates.search.sharp import Range, find_sharp_range, whole_parameters
from juggleproof.certificates.search.sharp_plane import find_sharp_region
from juggleproof.certificates.work import Budget, Exhausted
from juggleproof.proofs.forms import read

DECIMALS = 12
DOMAINS = {
    "alpha": (real("alpha") > 0) & (real("alpha") < 1),
    "K": real("K") >= 1,
    "eps": real("eps") > 0,
}


def search_sharp_range(
    name: str,
    statements: Sequence[Statement],
    over: Sequence[str],
    known: Mapping[str, checker.Statement],
    budget: int,
) -> tuple[SharpRange, Any, str] | None:
    """The sharp range of the statements, its certificate and how it is told; None where the search
    does not find one.

    Over alpha it is sought in (0, 1), over alpha and K in that times K >= 1.  A whole number that
    the hypotheses tie to alpha, as floor and ceiling do, joins it, and they bound the domain.  Over
    alpha and eps first the alpha are sought for which the statements hold with every eps > 0, since
    eps has a dimension as a rule; then pairs.
    """
    parsed = [read(statement.text(), statement.name) for statement in statements]
    if "alpha" in over:
        tied = _tied(parsed, budget)
        if tied is not None:
            number, said = tied
            domain = conjunction([DOMAINS["alpha"], said])
            region = find_sharp_region(
                parsed, ("alpha", number), domain, name, known, Budget(budget // 3)
            )
            if region.statement is not None and region.certificate is not None:
                return region.statement, region.certificate, told_of_pairs(region.statement, number)
    if "alpha" in over and "K" not in over:
        try:
            found = find_sharp_range(parsed, "alpha", DOMAINS["alpha"], name, known, Budget(budget))
        except Exhausted:
            found = Range()
        if found.statement is not None and found.certificate is not None and found.line is not None:
            return (
                found.statement,
                found.certificate,
                told(found.line.simplified(), "alpha", found.statement.numbers),
            )
    if len(over) > 1:
        domain = conjunction([DOMAINS[parameter] for parameter in over])
        region = find_sharp_region(parsed, over, domain, name, known, Budget(budget))
        if region.statement is not None and region.certificate is not None:
            return (
                region.statement,
                region.certificate,
                told_plainly(region.statement, whole_parameters(over, parsed)),
            )
    return None


def _tied(parsed: Sequence[checker.Statement], budget: int) -> tuple[str, Formula] | None:
    try:
        return pinned(parsed, "alpha", checker.parse(str(DOMAINS["alpha"])), Budget(budget // 10))
    except Exhausted:
        return None


def told_plainly(statement: SharpRange, whole: Collection[str] = ()) -> str:
    """A range over several parameters as a person reads it: solved for alpha, or its condition, or
    that it is everything or nothing.

    >>> alpha, size = real("alpha"), real("eps")
    >>> domain = (alpha > 0) & (size > 0)
    >>> told_plainly(SharpRange("x/sharp", (), ("alpha", "eps"), domain, alpha**2 * size > 1))
    'alpha^2*eps > 1'
    """
    text = str(statement.condition)
    plain = {
        str(conjunction([])): str(statement.domain),
        str(statement.domain): str(statement.domain),
        str(disjunction([])): "nowhere",
    }
    return plain.get(text) or solved(statement, "alpha", whole) or text


def told_of_pairs(statement: SharpRange, number: str) -> str:
    """A range over alpha and a whole number that is tied to it; what ties them is told where the
    condition does not say it.
    """
    text = told_plainly(statement, [number])
    if text == "nowhere":
        return text
    return (
        f"{text} for a whole number {number}"
        if says_domain(statement, [number])
        else f"{text} where {statement.domain}"
    )


def told(line: Line, parameter: str, numbers: Sequence[tuple[str, Term, Any, Any]] = ()) -> str:
    """The set as a person reads it: intervals, and for each irrational end its 12 decimals and its
    equation, under its name in `numbers`.

    >>> from fractions import Fraction
    >>> told(Line((AlgebraicNumber.rational(Fraction(1, 3)),), (True, False, False)), "alpha")
    '0 < alpha < 1/3'
    """
    names = {
        id(n): next(
            (
                name
                for name, poly, low, high in numbers
                if str(poly) == str(polynomial_term(n.coefficients, parameter)) and low < n < high
            ),
            f"c{k + 1}",
        )
        for k, n in enumerate(n for n in line.numbers if not n.is_rational)
    }

    def shown(end: AlgebraicNumber | None, outer: str) -> str:
        if end is None:
            return outer
        return str(end.as_fraction()) if end.is_rational else names[id(end)]

    parts = []
    for interval in line.intervals(True):
        if interval.low is not None and interval.low is interval.high:
            parts.append(f"{parameter} = {shown(interval.low, '')}")
        else:
            low, high = (
                "<=" if closed else "<" for closed in (interval.low_closed, interval.high_closed)
            )
            parts.append(
                f"{shown(interval.low, '0')} {low} {parameter} {high} {shown(interval.high, '1')}"
            )
    text = " or ".join(parts) or "nowhere"
    ends = [
        f"{names[id(n)]} = {n.decimal(DECIMALS)}..., a root of"
        f" {polynomial(n.coefficients, parameter)}"
        for n in line.numbers
        if not n.is_rational
    ]
    return "; ".join([text, *ends])


def polynomial(coefficients: Sequence[Any], name: str) -> str:
    """A polynomial in one variable, coefficients from the constant up, as text.

    >>> polynomial([-1, 7, 1, 1], "a")
    'a^3 + a^2 + 7*a - 1'
    """
    text = ""
    for power in range(len(coefficients) - 1, -1, -1):
        c = int(coefficients[power])
        if c:
            variable = "" if not power else name if power == 1 else f"{name}^{power}"
            body = "*".join(
                [
                    *([str(abs(c))] if abs(c) != 1 or not power else []),
                    *([variable] if variable else []),
                ]
            )
            text += (" - " if c < 0 else " + ") + body if text else ("-" if c < 0 else "") + body
    return text or "0"
