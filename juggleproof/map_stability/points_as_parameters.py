"""Fixed points that square roots do not express: the point becomes a parameter.  It replaces an old
parameter in which the equation of the point is linear.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, replace

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import beyond, is_certified
from juggleproof.map_stability.findings import ParameterMeaning
from juggleproof.map_stability.maps import HIGH, LOW, Map, ends_of_space
from juggleproof.map_stability.samples import (
    Arrays,
    divides,
    licence,
    multiplied_out,
    real_zeros,
    region,
)
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    atoms,
    column,
    conjuncts,
    expression,
    holds,
    renamed,
    symbols,
    written,
)
from juggleproof.statements.cases import ANYWHERE, conjunction

NAMES = "ecuvwz"  # for the point, the first that is free


@dataclass(frozen=True)
class MapWithPoint:
    """A map with its fixed point as a parameter, which replaced another: `parameter` = `term`."""

    system: Map
    parameter: str
    term: str

    def meaning(self, before: Map) -> ParameterMeaning:
        """Return what the old parameter stands for, and whether each of its values has a point."""
        says, one = f"here {self.parameter} = {self.term}", f"one such {self.name()}"
        if has_one_point(before, self):
            return ParameterMeaning(says, certified=True)
        doubt = f"where samples alone say that each {self.parameter} has {one}"
        return ParameterMeaning(f"{says}, {doubt}", certified=False)

    def name(self) -> str:
        """The parameter that replaces the old one."""
        return self.system.parameters[-1]


def by_its_point(system: Map, several: bool = False) -> MapWithPoint | None:
    """Return the map of one variable with its fixed point as a parameter, or None.  The equation of
    the point has to be linear in a parameter, which the point replaces.  At samples the point has
    to be the only one in the space; if `several`, there have to be more.

    >>> from juggleproof.map_stability.maps import read_rows
    >>> rows = [("over", "a"), ("domain", "a > 0"), ("state", "x"), ("space", "x > 0"),
    ...         ("piece", "(2*x + a/x^2)/3")]
    >>> found = by_its_point(read_rows("cube-root", rows))
    >>> found.term, found.system.domain, found.system.pieces[0][1], found.system.point
    ('e^3', 'e > 0', ('(2*x + (e^3)/x^2)/3',), ('e',))
    """
    taken = {*system.names, *(f"{name}_point" for name in system.state)}
    free = [one for one in NAMES if one not in taken]
    if len(system.state) > 1 or system.point or not system.parameters or not free:
        return None
    (state,), name = symbols(system.state), free[0]
    for (guard, _), (image,) in zip(system.pieces, system.images):
        gap = sympy.numer(sympy.together(image - state))
        for factor, _ in sympy.factor_list(gap)[1]:
            linear = [
                one for one in symbols(system.parameters) if sympy.Poly(factor, one).degree() == 1
            ]
            inside = conjunction(system.space, guard)
            high = sympy.degree(factor, state) > (1 if several else 2)
            if linear and high and is_the_point(system, factor, inside, several):
                # polynomials first, which need no licences
                old = min(linear, key=lambda one: sympy.Poly(factor, one).LC().has(state))
                (term,) = sympy.solve(factor, old)
                at = sympy.factor(term.subs(state, *symbols([name])))
                return with_parameter(system, inside, name, (name,), str(old), at)
    return None


def with_parameter(
    system: Map, inside: str, name: str, point: tuple[str, ...], old: str, term: Expr
) -> MapWithPoint:
    """The map with a coordinate of its point as a parameter of this name.  It replaces the
    parameter `old`, which equals the term.
    """
    put = {old: as_factor(written(term))}
    over = tuple(one for one in system.parameters if one != old) + (name,)
    at_point = renamed(inside, dict(zip(system.state, map(as_factor, point))))
    every = conjuncts(renamed(conjunction(at_point, system.domain), put))
    every = without_divisors(every)
    kept = needed_of(every, (), over)
    for _ in range(2):  # again with what the first turn says to be positive
        positive = {atoms(one)[0][0] for one in kept if atoms(one) and atoms(one)[0][1]}
        kept = [without_positive_factors(one, positive) for one in kept]
    pieces = tuple(
        (renamed(guard, put), tuple(renamed(image, put) for image in images))
        for guard, images in system.pieces
    )
    space = renamed(system.space, put)
    domain = conjunction(*kept) or ANYWHERE
    changed = replace(system, parameters=over, domain=domain, space=space, pieces=pieces)
    return MapWithPoint(replace(changed, point=point), old, written(term))


def needed_of(parts: Sequence[str], known: Sequence[str], over: Sequence[str]) -> list[str]:
    """Return the conditions that are not certified to follow from the others and from what is
    known.
    """
    kept = [one for one in parts if one != ANYWHERE]
    for part in reversed(parts):
        rest = [*known, *(one for one in kept if one != part)]
        if part in kept and rest and not beyond(conjunction(*rest), part, over):
            kept = [one for one in kept if one != part]
    return kept


def without_divisors(parts: Sequence[str]) -> list[str]:
    """Return the conditions, multiplied by their divisors.  A divisor has one sign at samples.

    >>> without_divisors(["e > 0", "1/(e + 1) < 1"])
    ['e > 0', '-e < 0']
    """
    known = conjunction(*(one for one in parts if not divides(one)))
    facts = {poly: f"{written(poly)} > 0" for poly, strict in atoms(known) if strict}
    for part in parts:
        for poly, _ in atoms(part) if divides(part) else ():
            below = sympy.denom(sympy.together(poly))
            for one, _ in sympy.factor_list(below)[1]:
                facts.setdefault(one, licence(one, known))
    return [multiplied_out(one, facts) if divides(one) else one for one in parts]


def without_positive_factors(part: str, positive: Set[Expr]) -> str:
    """Return an inequality without the factors that have one sign at all parameters, if one other
    factor is left; `positive` are the names of positive parameters.

    >>> e = sympy.Symbol("e", real=True)
    >>> without_positive_factors("e*(e^2 + 1) < 2", set())
    '1 - e > 0'
    >>> without_positive_factors("(e + 1)^4 < 16", {e})
    '1 - e > 0'
    """
    rows = atoms(part)
    if len(rows) != 1 or not rows[0][0].is_polynomial():
        return part
    ((poly, strict),) = rows
    sign, factors = sympy.factor_list(poly)
    left = []
    for factor, power in factors:
        names = factor.free_symbols
        signs = {c > 0 for c in sympy.Poly(factor, *names).coeffs()}
        if len(signs) == 1 and names <= positive:
            sign *= 1 if True in signs else -1
        elif len(names) == 1 and sympy.Poly(factor, *names).count_roots() == 0:
            sign *= sympy.sign(factor.subs(dict.fromkeys(names, 0)))
        else:
            left.append((factor, power))
    if len(left) != 1 or left[0][1] > 1:
        return part
    return f"{written(sympy.sign(sign) * left[0][0])} {'>' if strict else '>='} 0"


def has_one_point(before: Map, found: MapWithPoint) -> bool:
    """Return whether it is certified that each value of the old parameter is the term at exactly
    one value of the point.  The term is monotone on the new domain, and the equation of both has
    different signs at the ends of an interval.

    >>> from juggleproof.map_stability.maps import read_rows
    >>> rows = [("over", "a"), ("domain", "a > 0"), ("state", "x"), ("space", "x > 0"),
    ...         ("piece", "(2*x + a/x^2)/3")]
    >>> system = read_rows("cube-root", rows)
    >>> has_one_point(system, by_its_point(system))
    True
    """
    name, old, term = found.name(), found.parameter, found.term
    over, domain = found.system.parameters, found.system.domain
    second = f"{name}_2"
    other = {name: second}
    two = [f"forall {' '.join((*over, second))}"]
    two += [f"given {one}" for one in conjuncts(domain)]
    two += [f"given {one}" for one in (*conjuncts(renamed(domain, other)), f"{name} < {second}")]
    if not any(shows(two, f"{term} {than} {renamed(term, other)}") for than in "<>"):
        return False
    low, high = interval(before, name, domain)
    equation, divisor = sympy.fraction(sympy.together(expression(f"{term} - {old}")))
    given = [f"forall {' '.join(before.parameters)}", f"given {before.domain}"]
    if not changes_sign(given, written(equation), name, low, high):
        return False
    between = [f"forall {' '.join((*before.parameters, name))}", f"given {before.domain}"]
    between += [f"given {low} < {name}", f"given {name} < {high}"]
    is_finite = f"{written(divisor)} != 0"
    where_both = [f"given {is_finite}", f"given {old} = {term}"]
    return shows(between, is_finite) and shows([*between, *where_both], domain)


def changes_sign(given: Sequence[str], text: str, name: str, low: str, high: str) -> bool:
    """Return whether it is certified that a term has different signs at the ends of an interval."""
    ends = [renamed(text, {name: f"({end})"}) for end in (low, high)]
    return shows(given, f"{low} < {high}") and any(
        shows(given, f"{ends[0]} {left} 0") and shows(given, f"{ends[1]} {right} 0")
        for left, right in ("<>", "><")
    )


def interval(before: Map, name: str, domain: str) -> tuple[str, str]:
    """The ends of the domain in the parameter `name`; if one is missing, a term that is far out."""
    ends = ends_of_space(replace(before, state=(name,)), domain, strict=True)
    low, high = (written(ends[0, side]) if (0, side) in ends else "" for side in (LOW, HIGH))
    far = " + ".join(["1", *(f"{one}^2" for one in before.parameters)])
    return low or f"{high or 0} - ({far})", high or f"{low or 0} + {far}"


def shows(lines: Sequence[str], formula: str) -> bool:
    """Return whether it is certified that the formula follows from the lines."""
    return is_certified([*lines, f"show {formula}"], limits.POINT_WORK)


def is_the_point(system: Map, equation: Expr, inside: str, several: bool) -> bool:
    """Return whether at all samples exactly one zero of the equation is in the set, or several
    are.
    """
    (state,) = symbols(system.state)
    if sympy.degree(equation, state) > limits.MOST_DEGREE:
        return False
    counts = zeros_inside(system, equation, str(state), (state,), inside)
    return bool(len(counts)) and bool((counts > 1).all() if several else (counts == 1).all())


def zeros_inside(
    system: Map, polynomial: Expr, name: str, terms: Sequence[Expr], inside: str
) -> NDArray[np.int64]:
    """Return, for each sample of the parameters, the number of real zeros of a polynomial at which
    these terms are a state of the set.
    """
    parameters = region(system.domain, system.parameters, limits.PARAMETERS)
    count = len(next(iter(parameters.values()))) if parameters else 1
    which, zeros = real_zeros(polynomial, name, parameters, count)
    known: Arrays = {one: values[which] for one, values in parameters.items()} | {name: zeros}
    with np.errstate(all="ignore"):
        states = [column(written(term), known, len(zeros)) for term in terms]
        there = np.broadcast_to(
            holds(inside, {**known, **dict(zip(system.state, states))}), zeros.shape
        )
    return np.bincount(which[there], minlength=count)
