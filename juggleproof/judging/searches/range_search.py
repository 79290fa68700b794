"""Sharp ranges: the search for one, and the text of a certified one as intervals with exact end
points.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction

from juggleproof.algebra.numbers import AlgebraicNumber, exact, simplest_between
from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.search.families import implies_domain, solved
from juggleproof.search.ranges import CutDomain, line_on, pinned, polynomial_term
from juggleproof.search.sharp import Range, find_sharp_range, whole_parameters
from juggleproof.search.sharp_plane import find_sharp_region
from juggleproof.statements.definitions import formula_of, term_of
from juggleproof.statements.language import (
    End,
    Formula,
    Number,
    Roles,
    SharpRange,
    Statement,
    Term,
    bounds_of,
    conjunction,
    disjunction,
    interval_text,
    names_in,
)
from juggleproof.statements.nodes import Sharp
from juggleproof.statements.work import Budget, Exhausted, read

DECIMALS = 12


def search_sharp_range(
    name: str,
    statements: Sequence[Statement],
    over: Sequence[str],
    known: Mapping[str, checker.Statement],
    budget: int,
    roles: Roles,
) -> tuple[SharpRange, Sharp] | None:
    """The sharp range of the statements and its certificate; None where the search does not find
    one.

    It is sought in the domains of the parameters `over`.  If the hypotheses determine a whole
    number by the first parameter, as floor and ceiling do, the range is first sought over both.
    Then it is sought over the first parameter alone, with all values of the others; and then over
    all parameters.
    """
    if not _replaces(over, statements, roles):
        return None
    parsed = [read(statement.text(), statement.name) for statement in statements]
    first, whole = over[0], whole_parameters(over, parsed)
    domains = {name: conjunction(roles.domains.get(name, ())) for name in over}
    first_alone = _replaces(over[:1], statements, roles)
    if first == roles.parameter and first_alone:
        tied = _tied(parsed, first, domains[first], budget, roles)
        if tied is not None:
            number, hypothesis = tied
            domain = conjunction([domains[first], hypothesis])
            region = find_sharp_region(
                parsed, (first, number), domain, name, known, Budget(budget // 3), roles
            )
            if region.statement is not None and region.certificate is not None:
                return region.statement, region.certificate
    if first == roles.parameter and first_alone and not whole:
        try:
            sharp = find_sharp_range(
                parsed, first, domains[first], name, known, Budget(budget), roles=roles
            )
        except Exhausted:
            sharp = Range()
        if sharp.statement is not None and sharp.certificate is not None:
            return sharp.statement, sharp.certificate
    if len(over) > 1:
        domain = conjunction([domains[parameter] for parameter in over])
        region = find_sharp_region(parsed, over, domain, name, known, Budget(budget), roles)
        if region.statement is not None and region.certificate is not None:
            return region.statement, region.certificate
    return None


def text_of_range(
    text: str, statements: Sequence[Statement], over: Sequence[str], roles: Roles, budget: int
) -> str | None:
    """The text for a reader of a certified sharp range of the statements, made from its own lines;
    None where it is over other parameters, on a domain other than the whole one, or where a range
    line names a variable that it is not over, since the range would ignore that line.

    The whole domain is that of the parameters, with the hypothesis that determines a whole number
    by the first parameter, if there is one.
    """
    sharp = sharp_range_of(text)
    parsed = [read(statement.text(), statement.name) for statement in statements]
    first, domains = sharp.over[0], {name: roles.domains.get(name, ()) for name in sharp.over}
    if sharp.of != tuple(one.name for one in statements) or first != over[0]:
        return None
    if not _replaces(sharp.over, statements, roles):
        return None
    if str(sharp.domain) == str(conjunction([conjunction(one) for one in domains.values()])):
        if sharp.over not in ((first,), tuple(over)):
            return None
        if len(sharp.over) > 1:
            return region_text(sharp, whole_parameters(sharp.over, parsed))
        line = line_on(checker.parse(str(sharp.condition)), first, checker.parse(str(sharp.domain)))
        ends = bounds_of(str(sharp.domain), first)
        if line is None or ends is None:
            return None
        return line_text(line.simplified(), first, sharp.numbers, ends)
    tied = _tied(parsed, first, conjunction(domains[first]), budget, roles)
    if tied is None or sharp.over != (first, tied[0]):
        return None
    whole = conjunction([conjunction(domains[first]), tied[1]])
    return paired_text(sharp, tied[0]) if str(sharp.domain) == str(whole) else None


def sharp_range_of(text: str) -> SharpRange:
    """The sharp range that a text of the statement language states.

    >>> text = "statement x/sharp\\nsharp x/main\\nover a\\ndomain a > 0\\nholds a < 1/3"
    >>> sharp_range_of(text).text() == text
    True
    """
    statement = read(text, text.split("\n")[0].removeprefix("statement "))
    (of,), (over,), (domain,), (condition,) = map(
        statement.get, ("sharp", "over", "domain", "holds")
    )
    numbers = [(name, *map(term_of, ends)) for name, ends in statement.get("number")]
    return SharpRange(
        statement.name,
        tuple(of),
        tuple(over),
        formula_of(domain),
        formula_of(condition),
        tuple((name, poly, low, high) for name, poly, low, high in numbers),
    )


def _replaces(over: Collection[str], statements: Sequence[Statement], roles: Roles) -> bool:
    """Whether a sharp range over these parameters can replace all range lines of the statements:
    each line names only those parameters that have a domain.
    """
    replaced = {name for name in over if name in roles.domains}
    return all(
        isinstance(line, Formula) and names_in(line) <= replaced
        for statement in statements
        for keyword, line in statement.lines
        if keyword == "range"
    )


def _tied(
    parsed: Sequence[checker.Statement],
    parameter: str,
    domain: Formula,
    budget: int,
    roles: Roles,
) -> tuple[str, Formula] | None:
    try:
        return pinned(parsed, parameter, checker.parse(str(domain)), Budget(budget // 10), roles)
    except Exhausted:
        return None


def region_text(statement: SharpRange, whole: Collection[str] = ()) -> str:
    """The text of a range over several parameters: solved for the first one, or else its condition;
    the domain if it is all of it, `nowhere` if it is empty.

    >>> from juggleproof.statements.language import reals
    >>> a, size = reals("a eps")
    >>> domain = (a > 0) & (size > 0)
    >>> region_text(SharpRange("x/sharp", (), ("a", "eps"), domain, a**2 * size > 1))
    'a^2*eps > 1'
    """
    text = str(statement.condition)
    plain = {
        str(conjunction([])): str(statement.domain),
        str(statement.domain): str(statement.domain),
        str(disjunction([])): "nowhere",
    }
    return plain.get(text) or solved(statement, statement.over[0], whole) or text


def paired_text(statement: SharpRange, number: str) -> str:
    """The text of a range over a parameter and a whole number that it determines; the domain is
    added where the condition does not imply it.
    """
    text = region_text(statement, [number])
    if text == "nowhere":
        return text
    return (
        f"{text} for a whole number {number}"
        if implies_domain(statement, [number])
        else f"{text} where {statement.domain}"
    )


def line_text(
    line: CutDomain,
    parameter: str,
    numbers: Sequence[tuple[str, Term, Number, Number]] = (),
    ends: tuple[End | None, End | None] = (None, None),
) -> str:
    """The text of a set of reals: its intervals, with the ends of the domain where an interval has
    none, and for each irrational end its name in `numbers`, its decimals and its equation.

    >>> from fractions import Fraction
    >>> line_text(CutDomain((AlgebraicNumber.rational(Fraction(1, 3)),), (True, False, False)), "a")
    'a < 1/3'
    """
    names = {
        id(n): next(
            (
                name
                for name, poly, low, high in numbers
                if str(poly) == str(polynomial_term(n.coefficients, parameter))
                and Fraction(str(low)) < n < Fraction(str(high))
            ),
            f"c{k + 1}",
        )
        for k, n in enumerate(n for n in line.numbers if not n.is_rational)
    }

    def shown(end: AlgebraicNumber, closed: bool) -> End:
        value = str(end.as_fraction()) if end.is_rational else names[id(end)]
        return value, "<=" if closed else "<"

    parts = [
        interval_text(
            parameter,
            shown(each.low, each.low_closed) if each.low is not None else ends[0],
            shown(each.high, each.high_closed) if each.high is not None else ends[1],
        )
        for each in line.intervals(True)
    ]
    text = " or ".join(parts) or "nowhere"
    equations = [
        f"{names[id(n)]} = {n.decimal(DECIMALS)}..., a root of"
        f" {polynomial(n.coefficients, parameter)}"
        for n in line.numbers
        if not n.is_rational
    ]
    return "; ".join([text, *equations])


def polynomial(coefficients: Sequence[int], name: str) -> str:
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


# -------------------------------------------------------------------------------------------------
# A domain of one parameter as an interval.


def ends_inside(domain: str, parameter: str) -> tuple[End | None, End | None] | None:
    """The ends of a domain of one parameter, if it is an interval, with rational numbers just
    inside in place of irrational ends; None where it is not an interval, or is tiny.
    """
    line = line_on(checker.parse(domain), parameter, checker.parse("0 = 0"))
    intervals = line.simplified().intervals(True) if line else []
    if len(intervals) != 1:
        return None
    (found,) = intervals
    low = _inside(found.low, found.low_closed, limits.END_DISTANCE) if found.low else None
    high = _inside(found.high, found.high_closed, -limits.END_DISTANCE) if found.high else None
    if low and high and Fraction(low[0]) >= Fraction(high[0]):
        return None
    return low, high


def _inside(end: AlgebraicNumber, closed: bool, near: Fraction) -> End:
    """The end; for an irrational one, the simplest rational within `near` of it, further inside."""
    if end.is_rational:
        return str(end.as_fraction()), "<=" if closed else "<"
    low, high = end.enclosure(limits.END_BITS)
    beyond = (high, high + near) if near > 0 else (low + near, low)
    return str(simplest_between(*map(exact, beyond))), "<="
