"""Conditions on the parameters for a fixed point that can be stable: it exists, and its
multipliers lie inside the unit circle (Jury's conditions for one and two variables).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points import FixedPoint
from juggleproof.map_stability.samples import Arrays
from juggleproof.map_stability.terms import Expr, atoms, holds, symbols, value, written
from juggleproof.statements.cases import conjunction
from juggleproof.statements.language import bounds_of


def conditions(system: Map, fixed: FixedPoint, closed: bool = False) -> list[tuple[Expr, bool]]:
    """Return terms in the parameters that are > 0, or >= 0 if not strict, if the fixed point exists
    and its multipliers are below 1 in size; if `closed`, the multiplier in one variable may be -1.
    """
    state = symbols(system.state)
    at = dict(zip(state, fixed.terms))
    guard, _ = system.pieces[fixed.piece]
    space, found = atoms(system.space), []
    for poly, strict in atoms(conjunction(system.space, guard)):
        if poly.free_symbols & set(state):
            term = poly.xreplace(at)
            inside = strict or (poly, strict) not in space and jumps(system, fixed, term)
            found.append((term, inside))
    matrix = system.derivatives[fixed.piece].xreplace(at)
    matrix = matrix.applyfunc(sympy.together)  # its terms are smaller than those of `det`
    if len(state) == 1:
        found += [(1 - matrix[0, 0], True), (1 + matrix[0, 0], not closed)]
    elif len(state) == 2:
        trace = matrix[0, 0] + matrix[1, 1]
        determinant = matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]
        found += [(1 - determinant, True), (1 - trace + determinant, True)]
        found += [(1 + trace + determinant, True)]
    return found


def without_cycles(system: Map, parameters: Arrays) -> list[tuple[Expr, bool]]:
    """Return terms that are > 0, or >= 0 if not strict, if a map of one variable has no orbit of
    period two through two of its pieces.  The pieces are affine; else there are no terms.
    """
    state, found = symbols(system.state), []
    if len(state) > 1 or any(sympy.diff(one, *state, 2) != 0 for (one,) in system.images):
        return []
    (x,) = state
    for first, second in itertools.combinations(range(len(system.pieces)), 2):
        (there,), (back,) = system.images[first], system.images[second]
        slopes = sympy.diff(there, x) * sympy.diff(back, x)
        if slopes == 1:
            continue
        start = sympy.cancel(back.subs(x, there.subs(x, 0)) / (1 - slopes))
        ends = ((first, start), (second, sympy.cancel(there.subs(x, start))))
        inside = [
            (sympy.cancel(poly.subs(x, at)), strict)
            for k, at in ends
            for poly, strict in atoms(conjunction(system.space, system.pieces[k][0]))
        ]
        with np.errstate(all="ignore"):
            signs = [np.asarray(value(written(term), parameters), float) >= 0 for term, _ in inside]
        exists = np.logical_and.reduce(np.broadcast_arrays(*signs))
        if exists.any() and not exists.all():
            # one of the bounds alone decides whether the orbit exists
            one = next((k for k, sign in enumerate(signs) if (sign == exists).all()), None)
            found += [(-inside[one][0], not inside[one][1])] if one is not None else []
    return found


def jumps(system: Map, fixed: FixedPoint, term: Expr) -> bool:
    """Return whether the point is a fixed point of no other piece at parameters at which this term
    of a guard is 0.
    """
    at = dict(zip(symbols(system.state), fixed.terms))
    zeros = sympy.numer(sympy.together(term))
    for images in system.images[: fixed.piece] + system.images[fixed.piece + 1 :]:
        gaps = [image.xreplace(at) - e for image, e in zip(images, fixed.terms)]
        shares = [sympy.cancel(sympy.together(gap / term)) for gap in gaps]
        if all(sympy.gcd(sympy.denom(one), zeros) == 1 for one in shares):
            return False
    return True


def narrowed(system: Map, fixed: FixedPoint, parameters: Arrays, closed: bool = False) -> list[str]:
    """The conditions that fail for some of the parameters, as formulas: products of the factors
    that change their sign there.
    """
    every = [*conditions(system, fixed, closed), *without_cycles(system, parameters)]
    return needed(list(failing_for(every, parameters)), parameters)


def failing_at_ends(system: Map, fixed: FixedPoint, parameters: Arrays) -> list[str]:
    """The conditions that fail at ends of the domain alone, which samples miss."""
    every, ends = conditions(system, fixed), ends_of_domain(system)
    inside = set(failing_for(every, parameters))
    return [row for row in failing_for(every, parameters, ends) if row not in inside]


def ends_of_domain(system: Map) -> list[dict[Expr, Expr]]:
    """Points of the domain, each parameter at an end that belongs to its range, or in the middle of
    the range; at most MOST_POINTS of them.
    """
    ranges = []
    for name in system.parameters:
        low, high = bounds_of(system.domain, name) or (None, None)
        values = [Fraction(one[0]) for one in (low, high) if one and one[1] == "<="]
        inner = [Fraction(one[0]) for one in (low, high) if one]
        middle = sum(inner) / len(inner) if inner else Fraction(0)
        ranges.append([*values, middle + (len(inner) < 2)])
    points = (dict(zip(system.parameters, each)) for each in itertools.product(*ranges))
    inside = (
        one for one in itertools.islice(points, limits.MOST_POINTS) if holds(system.domain, one)
    )
    return [
        {symbol: sympy.Rational(value) for symbol, value in zip(symbols(one), one.values())}
        for one in inside
    ]


def failing_for(
    terms: Iterable[tuple[Expr, bool]], parameters: Arrays, ends: Sequence[dict[Expr, Expr]] = ()
) -> Iterator[str]:
    """Yield the conditions, term > 0 or term >= 0, that fail at samples or at these ends."""
    for term, strict in terms:
        term = without_root(term, parameters)
        if term is None or not term.free_symbols:
            continue
        above, below = sympy.fraction(sympy.cancel(sympy.together(term)))
        if above == 0:
            continue  # it fails for all parameters, and narrows nothing
        sign = 1
        parts: list[Expr] = []
        for poly, power in [*sympy.factor_list(above)[1], *sympy.factor_list(below)[1]]:
            with np.errstate(all="ignore"):
                at = np.asarray(value(written(poly), parameters), float)
            turn = 1 if (at > 0).all() else -1
            at_ends = [turn * poly.subs(end) for end in ends]
            if (turn * at > 0).all() and all(one > 0 or not strict and one == 0 for one in at_ends):
                sign *= turn if power % 2 else 1
            elif power % 2:
                parts.append(poly)
        constant = sympy.factor_list(above)[0] / sympy.factor_list(below)[0]
        sign *= 1 if constant > 0 else -1
        if parts:
            product = sympy.expand(sign * sympy.prod(parts))
            yield f"{written(product)} {'>' if strict else '>='} 0"


def without_root(term: Expr, parameters: Arrays) -> Expr | None:
    """A term without square roots that has the same sign at all samples: a product of factors of
    the term times its conjugate.
    """
    roots = {p for p in term.atoms(sympy.Pow) if not p.exp.is_Integer}
    if not roots:
        return term
    if len(roots) > 1 or next(iter(roots)).exp != sympy.Rational(1, 2):
        return None
    (root,) = roots
    symbol = sympy.Dummy(real=True)
    above, below = sympy.fraction(sympy.together(term.subs(root, symbol)))
    above = sympy.rem(sympy.expand(above * below), symbol**2 - root.base, symbol)
    norm = sympy.expand(above * above.subs(symbol, -symbol)).subs(symbol**2, root.base)
    numerator = sympy.numer(sympy.together(sympy.expand(norm)))
    factors = [one for one, _ in sympy.factor_list(numerator)[1]]
    with np.errstate(all="ignore"):
        names = symbols(parameters)
        sign = np.sign(sympy.lambdify(names, term, "numpy")(*parameters.values()))
        signs = [np.sign(sympy.lambdify(names, f, "numpy")(*parameters.values())) for f in factors]
    for count in range(len(factors) + 1):
        for chosen in itertools.combinations(range(len(factors)), count):
            product = sympy.prod([factors[k] for k in chosen])
            found = math.prod((signs[k] for k in chosen), start=np.ones_like(sign))
            for turn in (1, -1):
                if (turn * found == sign).all():
                    return sympy.Integer(turn) * product
    return None


def needed(rows: list[str], parameters: Arrays) -> list[str]:
    """The conditions without those that hold at all samples at which the others hold.  Long
    conditions are left out first.
    """
    kept = list(dict.fromkeys(rows))
    for row in sorted(rows, key=len, reverse=True):
        rest = [one for one in kept if one != row]
        inside = np.logical_and.reduce([holds(one, parameters) for one in rest]) if rest else None
        if (
            inside is not None
            and inside.any()
            and np.all(np.asarray(holds(row, parameters))[inside])
        ):
            kept = rest
    return kept


def middle_of(system: Map, domain: str) -> list[str]:
    """Return the middle half of each parameter's range, as formulas.  A range without an upper end
    is cut 1/2 above its lower end.  If a parameter has no lower end, there are no formulas.
    """
    rows = []
    for name in system.parameters:
        low, high = bounds_of(domain, name) or (None, None)
        if low is None:
            return []
        least, most = Fraction(low[0]), Fraction(high[0]) if high else None
        step = (most - least) / 4 if most is not None else Fraction(1, 2)
        rows.append(f"{name} >= {least + step}")
        if most is not None:
            rows.append(f"{name} <= {most - step}")
    return rows
