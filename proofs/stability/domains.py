"""For which parameters a fixed point can be stable: where it exists, and where its multipliers lie
inside the unit circle (Jury's conditions for one and two variables).
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import sympy

from juggleproof.certificates.language import bounds_of
from juggleproof.proofs.stability.given import (
    Expr,
    Map,
    atoms,
    conjunction,
    expression,
    symbols,
    value,
    written,
)
from juggleproof.proofs.stability.points import FixedPoint
from juggleproof.proofs.stability.samples import Arrays


def conditions(system: Map, fixed: FixedPoint, closed: bool = False) -> list[tuple[Expr, bool]]:
    """Terms in the parameters that are > 0, or >= 0 where not strict, where the fixed point exists
    and its multipliers are below 1 in size; `closed`: that of one variable may be -1.
    """
    state = symbols(system.state)
    at = dict(zip(state, fixed.terms))
    guard, images = system.pieces[fixed.piece]
    space, found = atoms(system.space), []
    for poly, strict in atoms(conjunction(system.space, guard)):
        if poly.free_symbols & set(state):
            term = poly.xreplace(at)
            inside = strict or (poly, strict) not in space and jumps(system, fixed, term)
            found.append((term, inside))
    matrix = sympy.Matrix(list(map(expression, images))).jacobian(state)
    matrix = matrix.xreplace(at).applyfunc(sympy.together)  # of smaller terms than what det makes
    if len(state) == 1:
        found += [(1 - matrix[0, 0], True), (1 + matrix[0, 0], not closed)]
    elif len(state) == 2:
        trace = matrix[0, 0] + matrix[1, 1]
        determinant = matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]
        found += [(1 - determinant, True), (1 - trace + determinant, True)]
        found += [(1 + trace + determinant, True)]
    return found


def jumps(system: Map, fixed: FixedPoint, term: Expr) -> bool:
    """Whether no other piece takes the point to itself too where the term, of a guard, is 0."""
    at = dict(zip(symbols(system.state), fixed.terms))
    for images in system.images[: fixed.piece] + system.images[fixed.piece + 1 :]:
        gaps = [image.xreplace(at) - e for image, e in zip(images, fixed.terms)]
        shares = [sympy.cancel(sympy.together(gap / term)) for gap in gaps]
        zeros = sympy.numer(sympy.together(term))
        if all(sympy.gcd(sympy.denom(one), zeros) == 1 for one in shares):
            return False
    return True


def narrowed(system: Map, fixed: FixedPoint, parameters: Arrays, closed: bool = False) -> list[str]:
    """The conditions that fail for some of the parameters, as formulas: products of the factors
    that change their sign there.
    """
    rows = []
    for term, strict in conditions(system, fixed, closed):
        if not term.free_symbols:
            continue
        term = without_root(term, parameters)
        above, below = sympy.fraction(sympy.together(term))
        sign = 1
        parts: list[Expr] = []
        for poly, power in [*sympy.factor_list(above)[1], *sympy.factor_list(below)[1]]:
            with np.errstate(all="ignore"):
                at = np.asarray(value(written(poly), parameters), float)
            if (at > 0).all() or (at < 0).all():
                sign *= 1 if (at > 0).all() or power % 2 == 0 else -1
            elif power % 2:
                parts.append(poly)
        constant = sympy.factor_list(above)[0] / sympy.factor_list(below)[0]
        sign *= 1 if constant > 0 else -1
        if parts:
            product = sympy.expand(sign * sympy.prod(parts))
            rows.append(f"{written(product)} {'>' if strict else '>='} 0")
    return list(dict.fromkeys(rows))


def without_root(term: Expr, parameters: Arrays) -> Expr:
    """A polynomial that has the sign of a term a + b sqrt(u) at all samples: a^2 - b^2 u, or this
    times -1; 1 where there is none.
    """
    under = {power.base for power in term.atoms(sympy.Pow) if not power.exp.is_Integer}
    if not under:
        return term
    root = sympy.Dummy("root", real=True)
    (base, *others) = under
    named = term.replace(
        lambda e: e.is_Pow and e.base == base and not e.exp.is_Integer,
        lambda e: root ** (2 * e.exp),
    )
    if others or not named.is_rational_function():
        return sympy.Integer(1)
    above, below = sympy.fraction(sympy.together(named))
    linear = sympy.rem(sympy.expand(above * below), root**2 - base, root)
    norm = sympy.expand(sympy.rem(linear * linear.subs(root, -root), root**2 - base, root))
    names = symbols(parameters)
    with np.errstate(all="ignore"):
        signs = [
            np.sign(np.asarray(sympy.lambdify(names, one, "numpy")(*parameters.values())))
            for one in (term, norm)
        ]
    return next(
        (s * norm for s in (1, -1) if np.array_equal(signs[0], s * signs[1])), sympy.Integer(1)
    )


def middle_of(system: Map, domain: str) -> list[str]:
    """The middle half of each parameter's range, as formulas; of one without an upper end, that
    which begins 1/2 above the lower.  None of these where a parameter has neither end.
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
