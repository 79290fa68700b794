"""Fixed points that square roots do not express, of maps none of whose parameters is a term in the
point.  A coordinate of the point becomes one more parameter, and the domain has the equation that
elimination leaves for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.findings import ParameterMeaning
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points_as_parameters import (
    NAMES,
    MapWithPoint,
    changes_sign,
    interval,
    needed_of,
    shows,
    with_parameter,
    without_divisors,
    zeros_inside,
)
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    column,
    conjuncts,
    holds,
    renamed,
    symbols,
    written,
)
from juggleproof.statements.cases import ANYWHERE, conjunction


@dataclass(frozen=True)
class WithEquation:
    """The map with a coordinate of its point as a parameter, which is a zero of a polynomial."""

    system: Map
    name: str
    polynomial: Expr
    where: str  # what tells it from the other zeros

    def meaning(self, before: Map) -> ParameterMeaning:
        """Return what the name stands for, and whether there is such a zero for all parameters."""
        which = "" if self.where == ANYWHERE else f" with {self.where}"
        says = f"here {self.name} is the zero of {written(self.polynomial)}{which}"
        if has_a_zero(before, self):
            return ParameterMeaning(says, certified=True)
        return ParameterMeaning(
            f"{says}, where samples alone say that there is one", certified=False
        )


def by_an_equation(system: Map) -> WithEquation | MapWithPoint | None:
    """Return the map with a coordinate of its fixed point as one more parameter, which is a zero of
    a polynomial.  If the polynomial is linear in a parameter, the coordinate replaces it.  Return
    None if there is no polynomial with exactly one zero, at samples, that is such a coordinate.

    >>> from juggleproof.map_stability.maps import read_rows
    >>> rows = [("state", "x"), ("space", "x > 0"), ("piece", "(2*x + 2/x^2)/3")]
    >>> found = by_an_equation(read_rows("cube-root", rows))
    >>> found.system.domain, found.system.point
    ('e^3 - 2 = 0 and e > 5/4 and e < 81/64', ('e',))
    """
    taken = {*system.names, *(f"{name}_point" for name in system.state)}
    free = [one for one in NAMES if one not in taken]
    if system.point or not free:
        return None
    (name,) = symbols(free[:1])
    for piece, (guard, _) in enumerate(system.pieces):
        inside = conjunction(system.space, guard)
        for polynomial, terms in eliminated(system, piece, name):
            if not (zeros_inside(system, polynomial, str(name), terms, inside) == 1).all():
                continue
            every = symbols(system.parameters)
            linear = [one for one in every if sympy.degree(polynomial, one) == 1]
            if not linear:
                return with_equation(system, polynomial, terms, inside, str(name))
            old = linear[0]
            term = sympy.factor(sympy.solve(polynomial, old)[0])
            point = tuple(written(sympy.factor(one.xreplace({old: term}))) for one in terms)
            return with_parameter(system, inside, str(name), point, str(old), term)
    return None


def eliminated(system: Map, piece: int, name: Expr) -> Iterator[tuple[Expr, tuple[Expr, ...]]]:
    """Yield irreducible polynomials for one coordinate of the fixed points of a piece, and all
    coordinates as terms in that one.
    """
    state, parameters = symbols(system.state), symbols(system.parameters)
    field = sympy.QQ.frac_field(*parameters) if parameters else sympy.QQ
    gaps = [sympy.numer(sympy.together(i - s)) for i, s in zip(system.images[piece], state)]
    degrees = [sympy.Poly(one, *state).total_degree() for one in gaps]
    if not 0 < np.prod(degrees) <= limits.MOST_ZEROS:
        return
    for last in reversed(state):
        order = [*(one for one in state if one != last), last]
        polys = [sympy.Poly(one, *order, domain=field) for one in gaps]
        basis = polys if len(state) == 1 else sympy.groebner(polys, *order, order="lex").polys
        for factor, _ in sympy.factor_list(sympy.numer(sympy.together(basis[-1].as_expr())))[1]:
            if not factor.has(last) or factor.has(*order[:-1]):
                continue
            if not 1 < sympy.degree(factor, last) <= limits.MOST_DEGREE:
                continue
            terms = {last: name}
            if len(state) > 1:
                with_factor = [*polys, sympy.Poly(factor, *order, domain=field)]
                terms |= linear_in(sympy.groebner(with_factor, *order, order="lex").polys, last)
            if len(terms) == len(state):
                points = tuple(sympy.factor(terms[one].xreplace({last: name})) for one in state)
                yield factor.xreplace({last: name}), points


def linear_in(basis: list[sympy.Poly], last: Expr) -> dict[Expr, Expr]:
    """Return the variables that are terms in the last one.  Each is the only other variable of an
    equation in the basis, and has degree 1 in it.
    """
    found = {}
    for poly in basis:
        others = [one for one in poly.gens if one != last and poly.has(one)]
        if len(others) == 1 and poly.degree(others[0]) == 1:
            gap = poly.as_expr().expand()
            below = gap.coeff(others[0], 1)
            if not below.has(last):
                found[others[0]] = sympy.cancel(-gap.coeff(others[0], 0) / below)
    return found


def with_equation(
    system: Map, polynomial: Expr, terms: tuple[Expr, ...], inside: str, name: str
) -> WithEquation:
    """The map with the name as a parameter, the equation in its domain, and what tells its zero
    from others.
    """
    over = (*system.parameters, name)
    equation = f"{written(polynomial)} = 0"
    point = tuple(map(written, terms))
    put = {one: as_factor(term) for one, term in zip(system.state, point)}
    at_point = conjuncts(renamed(inside, put))
    known = conjunction(system.domain, equation)
    if not system.parameters:
        known = conjunction(known, *isolated(polynomial, terms, system, inside, name))
    every = without_divisors([*conjuncts(known), *at_point])[len(conjuncts(known)) :]
    domain = conjunction(known, *needed_of(every, [known], over))
    changed = replace(system, parameters=over, domain=domain, point=point)
    where = [
        one
        for one in conjuncts(domain)
        if one not in conjuncts(conjunction(system.domain, equation))
    ]
    return WithEquation(changed, name, polynomial, conjunction(*where))


def isolated(
    polynomial: Expr, terms: tuple[Expr, ...], system: Map, inside: str, name: str
) -> list[str]:
    """Return rational ends of an interval that has the zero of the point and no other: 1/64 wide,
    or less if zeros are closer.
    """
    variable = sympy.Symbol(name, real=True)
    for (low, high), _ in sympy.Poly(polynomial, variable).intervals(
        eps=sympy.Rational(1, limits.STEPS)
    ):
        middle = {name: np.array([float((low + high) / 2)])}
        states = [column(written(term), middle, 1) for term in terms]
        if np.all(holds(inside, {**middle, **dict(zip(system.state, states))})):
            grid = [
                Fraction(int(sympy.floor(low * limits.STEPS)) + k, limits.STEPS) for k in range(3)
            ]
            for one, other in pairwise(grid):
                signs = [polynomial.subs(variable, sympy.Rational(end)) for end in (one, other)]
                if signs[0] * signs[1] < 0 and one <= low and high <= other:
                    return [f"{name} > {one}", f"{name} < {other}"]
            return [f"{name} > {low}", f"{name} < {high}"] if low < high else []
    return []


def has_a_zero(before: Map, found: WithEquation) -> bool:
    """Return whether it is certified that there is such a zero for all of the parameters: the
    polynomial has different signs at the ends of an interval, within which the rest of the domain
    holds.
    """
    low, high = interval(before, found.name, found.system.domain)
    head = [f"forall {' '.join(before.parameters)}"] if before.parameters else []
    given = [*head, f"given {before.domain}"] if before.domain != ANYWHERE else head
    text = written(found.polynomial)
    if not changes_sign(given, text, found.name, low, high):
        return False
    between = [f"forall {' '.join(found.system.parameters)}", *given[len(head) :]]
    between += [f"given {low} < {found.name}", f"given {found.name} < {high}"]
    return shows([*between, f"given {text} = 0"], found.where)
