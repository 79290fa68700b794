"""Greatest weighted ratios to the point: V = max (R - 1)/u_R, over products R of the powers 1 and
-1 of x_j/e_j, with weights u_R > 0 that depend on the parameters.  Close to the point it is a
polytope norm in the logarithms, far from it the part metric with weights.

Let A be the derivative at the point in the logarithms, and rows l of exponents with l A = sum of
c_lk k over rows k and their opposites, c_lk >= 0.  The norm max |l log(x/e)|/u_l falls where
C u < u: such u are the sums of the columns of the inverse of I - C, where its spectral radius is
below 1.  The same holds with x + c in place of x; c is taken from a divisor of the map.

Sources: Krause and Nussbaum, A limit set trichotomy for self-mappings of normal cones in Banach
spaces, Nonlinear Analysis 20 (1993); Kruse and Nesemann, Global asymptotic stability in some
discrete dynamical systems, J. Mathematical Analysis and Applications 235 (1999).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import sympy

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof
from juggleproof.map_stability.functions.candidates import Setting, bounded_below
from juggleproof.map_stability.functions.equations import (
    at_parameters,
    factors_of,
    products_of,
    sizes_of,
    with_ends,
    with_equations,
)
from juggleproof.map_stability.functions.ratio_searches import Row, searches_for
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.functions.weighted_terms import values
from juggleproof.map_stability.maps import bounds
from juggleproof.map_stability.samples import SEED, Floats, Samples, licence
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    atoms,
    column,
    expression,
    holds,
    symbols,
    written,
)
from juggleproof.statements.cases import conjunction


def ratio_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates that samples do not refute, those whose loss fits best first, with searches
    for most premises.
    """
    if has_ratios(setting):
        setting, put = with_equations(setting)
        every = (candidates_for(setting, put, origin) for origin in origins(setting))
        yield from next(filter(None, every), [])


def weighted_distance_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """Return the candidates for weighted distances of a map that contracts them in the whole space,
    by the comparison matrix |A| of the derivative A at the point.
    """
    if has_ratios(setting):
        setting, put = with_equations(setting)
        yield from candidates_for(setting, put, [sympy.Integer(1)] * len(setting.system.state))


def has_ratios(setting: Setting) -> bool:
    """Return whether the map has one piece, and two state variables or three."""
    return 1 < len(setting.system.state) <= limits.MOST_STATES and len(setting.system.pieces) == 1


def candidates_for(
    setting: Setting, put: dict[Expr, Expr], origin: Sequence[Expr]
) -> list[CandidateProof]:
    """The candidates for one origin, with the first rows that make any."""
    derivative = in_logarithms(setting, origin, put)
    for rows in sets_of_rows(len(setting.system.state), is_plain(origin)):
        sums = sums_of(setting, derivative, rows)
        if sums is None or len(str(sums.matrix)) > limits.MOST_SIZE:
            continue
        found = []
        for weights in weights_of(setting, sums.matrix):
            terms = terms_of(setting, put, origin, rows, weights)
            falls = falls_of(sums.matrix, weights)
            for one in _weighted(setting, put, origin, rows, weights, falls):
                found.append((one.rank + len(" ".join(terms)) / 50, one, weights))
        if found:
            best = sorted(found, key=lambda one: one[0])[: limits.TRIED]
            return [
                replace(one, searches=searches_for(setting, put, rows, origin, weights, sums.used))
                for _, one, weights in best
            ]
    return []


def origins(setting: Setting) -> Iterator[list[Expr]]:
    """Yield the terms that the ratios are of, one for each state variable: its distance to its
    lower bound, or the variable plus a number or a term in the parameters, as in divisors of the
    map.
    """
    system, state = setting.system, symbols(setting.system.state)
    low, _ = bounds(system)
    if len(low) == len(state):
        yield [expression(low[one]) for one in system.state]
    yield from origins_on_boundary(setting, low)
    shifts: dict[Expr, None] = {}
    for image in system.images[setting.piece]:
        below = sympy.fraction(sympy.together(image))[1]
        for factor, _ in sympy.factor_list(below)[1]:
            named = factor.free_symbols & set(state)
            if len(named) == 1 and sympy.diff(factor, *named).is_Rational:
                slope = sympy.diff(factor, *named)
                shifts[sympy.expand(factor / slope - named.pop())] = None
    for shift in itertools.islice(shifts, limits.MOST_SHIFTS):
        yield [one + shift for one in state]


def origins_on_boundary(setting: Setting, low: dict[str, str]) -> Iterator[list[Expr]]:
    """Yield origins for a point that is 0 in some variables.  No ratio is to 0: half of another
    coordinate of the point is added to these variables.
    """
    pairs = dict(zip(symbols(setting.system.state), map(expression, setting.point.terms)))
    zero = [one for one, e in pairs.items() if e == 0]
    if zero and all(str(one) in low for one in pairs if one not in zero):
        for e in dict.fromkeys(e for e in pairs.values() if e != 0):
            yield [one + e / 2 if one in zero else expression(low[str(one)]) for one in pairs]


def is_plain(origin: Sequence[Expr]) -> bool:
    """Return whether there are no ratios: V is the greatest of weighted distances, which ratios
    of x + c tend to for large c.
    """
    return all(one.is_number for one in origin)


def sets_of_rows(count: int, plain: bool) -> Iterator[list[Row]]:
    """Yield the variables; for two variables, also these with their quotient or their product."""
    units = [tuple(int(i == j) for j in range(count)) for i in range(count)]
    yield units
    if count == 2 and not plain:
        yield [*units, (1, -1)]
        yield [*units, (1, 1)]


# -------------------------------------------------------------------------------------------------
# The weights, as terms in the parameters and the point.


def in_logarithms(setting: Setting, origin: Sequence[Expr], put: dict[Expr, Expr]) -> Expr:
    """The derivative at the point, in the logarithms of what the ratios are of."""
    state, matrix = symbols(setting.system.state), setting.system.derivatives[setting.piece]
    n = len(state)
    scaled = sympy.Matrix(n, n, lambda i, j: matrix[i, j] * origin[j] / origin[i])
    scaled = scaled.subs(dict(zip(state, setting.point_names)), simultaneous=True)
    return scaled.subs(put, simultaneous=True).applyfunc(sympy.cancel)


@dataclass(frozen=True)
class Sums:
    """The images of the rows as sums of rows and of their opposites.

    matrix: the coefficients c >= 0; signs: 1 for a row, -1 for its opposite, 0 for c = 0.
    """

    matrix: Expr
    signs: list[list[int]]

    def used(self, term: int) -> list[int]:
        """Return the numbers of the terms of V that bound the next value of this term."""
        size = len(self.signs)
        side, row = divmod(term, size)
        return [
            k + size * ((sign < 0) != (side == 1)) for k, sign in enumerate(self.signs[row]) if sign
        ]


def sums_of(setting: Setting, derivative: Expr, rows: Sequence[Row]) -> Sums | None:
    """Return the sums with the least coefficients; None if there are none, or if the spectral
    radius is 1 or more at some parameters.
    """
    images = [_combination(setting, sympy.Matrix([row]) * derivative, rows) for row in rows]
    found = [image for image in images if image is not None]
    if len(found) < len(images):
        return None
    size = len(rows)
    signs = [[sign for _, sign in image] for image in found]
    matrix = sympy.Matrix([[c for c, _ in image] for image in found])
    numbers = np.stack([at_parameters(setting, one) for one in matrix], axis=1)
    radius = np.abs(np.linalg.eigvals(numbers.reshape(-1, size, size))).max(axis=1)
    return Sums(matrix, signs) if (radius < 1).all() else None


def weights_of(setting: Setting, matrix: Expr) -> list[list[Expr]]:
    """Candidates for the weights u with C u < u: sums of the columns of the adjugate of I - C, as
    they are without common factors, or scaled so that they agree in an entry.
    """
    size = matrix.rows
    adjugate = (sympy.eye(size) - matrix).adjugate().applyfunc(sympy.cancel)
    columns = [without_divisors(setting, adjugate[:, k]) for k in range(size)]
    found: dict[tuple[Expr, ...], None] = {}
    for entry in (None, *range(size)):
        if entry is not None and any(column[entry] == 0 for column in columns):
            continue
        scaled = [column if entry is None else column / column[entry] for column in columns]
        total = sum(scaled[1:], scaled[0]).applyfunc(sympy.together)
        found[tuple(without_divisors(setting, total))] = None
    return list(map(list, found))


def falls_of(matrix: Expr, weights: Sequence[Expr]) -> list[Expr]:
    """The shares that the terms of V fall by, close to the point."""
    pairs = zip(matrix * sympy.Matrix(weights), weights)
    return [sympy.factor(1 - image / weight) for image, weight in pairs]


def _combination(
    setting: Setting, image: Expr, rows: Sequence[Row]
) -> list[tuple[Expr, int]] | None:
    """Return the least coefficients >= 0 with which rows or their opposites make up the image, and
    for each the sign of its row; None if the signs change between parameters.
    """
    best: tuple[float, list[tuple[Expr, int]]] | None = None
    for chosen in itertools.combinations(range(len(rows)), image.cols):
        basis = sympy.Matrix([rows[k] for k in chosen])
        if basis.det() == 0:
            continue
        found = [(sympy.Integer(0), 0)] * len(rows)
        total = 0.0
        for k, one in zip(chosen, (image * basis.inv()).applyfunc(sympy.cancel)):
            at = at_parameters(setting, one)
            if not np.isfinite(at).all() or (
                at.min() < -limits.ROUNDING and at.max() > limits.ROUNDING
            ):
                break
            if np.abs(at).max() > limits.ROUNDING:
                found[k] = (one, 1) if at.max() > limits.ROUNDING else (-one, -1)
            total += float(np.abs(at).mean())
        else:
            if best is None or total < best[0] - limits.ROUNDING:
                best = total, found
    return best and best[1]


def without_divisors(setting: Setting, column: Expr) -> Expr:
    """The column times a term, so that its entries are positive polynomials, as low as may be."""
    below = sympy.lcm([sympy.fraction(sympy.together(one))[1] for one in column])
    column = (column * below).applyfunc(sympy.cancel)
    column = (column / sympy.gcd(list(column))).applyfunc(lambda one: sympy.factor(one))
    return column if at_parameters(setting, sum(column)).min() > 0 else -column


# -------------------------------------------------------------------------------------------------
# The statement.


def terms_of(
    setting: Setting,
    put: dict[Expr, Expr],
    origin: Sequence[Expr],
    rows: Sequence[Row],
    weights: Sequence[Expr],
) -> list[str]:
    """The terms (R - 1)/u of V, those of the rows first, then those of their opposites."""
    names, sizes = setting.system.state, sizes_of(setting, put, origin)
    terms = []
    for sign, (row, weight) in itertools.product((1, -1), zip(rows, weights)):
        above, below = sympy.Integer(1), sympy.Integer(1)
        for power, one, size in zip(row, origin, sizes):
            here, there = (one, size) if power * sign > 0 else (size, one)
            above, below = (above * here, below * there) if power else (above, below)
        gap = f"{'-' if sign < 0 else ''}{names[row.index(1)]}_gap"
        top = gap if sum(map(abs, row)) == 1 else written(above - below)
        terms.append(_divided(f"({top})", below * weight))
    return terms


def _divided(text: str, term: Expr) -> str:
    """The text divided by a term, as one quotient."""
    over, under = sympy.fraction(sympy.factor(1 / term))
    return f"{'' if over == 1 else as_factor(written(over)) + '*'}{text}/({written(under)})"


def _weighted(
    setting: Setting,
    put: dict[Expr, Expr],
    origin: Sequence[Expr],
    rows: Sequence[Row],
    weights: Sequence[Expr],
    falls: Sequence[Expr],
) -> Iterator[CandidateProof]:
    """The candidates with these weights, for several shapes of the loss."""
    terms = terms_of(setting, put, origin, rows, weights)
    if is_plain(origin):
        setting = at_corners(setting, weights)
    here, there, samples = values(setting, terms)
    before, now = here.max(axis=0), there.max(axis=0)
    if not len(before) or (now > before * (1 + limits.ROUNDING)).any():
        return
    factors = factors_of(setting, falls)
    # the least of positive numbers is above 1/(the sum of 1/each), and the greatest below the sum
    sizes = sizes_of(setting, put, origin)
    total = sympy.factor(sum(size * weight for size, weight in zip(sizes, weights)))
    inverses = sum(1 / size for size in set(sizes))
    radius = sympy.factor(1 / (2 * inverses))
    upper = sympy.factor(
        sum(
            (2 if sum(map(abs, row)) == 1 else 4)
            * sum(abs(power) / size for power, size in zip(row, sizes))
            / weight
            for row, weight in zip(rows, weights)
        )
    )
    ball, far = (written(radius), written(upper)), _divided("distance", total)
    positive = [*factors, *factors_of(setting, [total, radius]), *factors_of(setting, weights)]
    licensed, on = _licensed(setting, origin, positive)
    for power in limits.VALUE_POWERS:
        least = samples.least((before - now) / before * (1 + before) ** power, setting.count)
        constants = _constants(setting, factors, falls, least)
        for rank, constant in constants:
            over = "/(1 + {})" if power else ""
            loss = f"({constant})*value" + over.format("value")
            at_least = f"({constant})*{far}" + over.format("level")
            function, rank = Function(tuple(terms)), rank + power / 4
            yield licensed.candidate(function, loss, at_least, ball, on, rank)
        if constants and is_plain(origin):
            return


def _constants(
    setting: Setting, factors: Sequence[Expr], falls: Sequence[Expr], least: Floats
) -> list[tuple[float, str]]:
    """Return terms below `least` and below the falls close to the point, also at parameters close
    to an end.  Terms that follow `least` come first; else they follow both there.
    """
    wide = with_ends(setting)
    fall = np.min([at_parameters(wide, one) for one in falls], axis=0)
    least = np.append(least + limits.ROUNDING, np.full(wide.count - setting.count, np.inf))
    below = np.minimum(least, fall)
    found = [
        (rank, text)
        for rank, text in bounded_below(below[: setting.count], products_of(setting, factors))
        if (column(text, wide.constants, wide.count) < fall).all()
    ]
    return found or bounded_below(below, products_of(wide, factors))


def at_corners(setting: Setting, weights: Sequence[Expr]) -> Setting:
    """Return the setting with more states, at the corners of boxes around the point with these
    sides: a map that is monotone in each variable moves most there.
    """
    system, samples = setting.system, setting.states
    sides = [at_parameters(setting, one)[samples.which] for one in weights]
    gaps = zip(system.state, sides)
    size = np.max([np.abs(samples.points[f"{one}_gap"]) / side for one, side in gaps], axis=0)
    rng, points = np.random.default_rng(SEED), dict(samples.points)
    for name, side in zip(system.state, sides):
        points[f"{name}_gap"] = size * side * rng.choice((-1, 1), len(size))
        points[name] = points[f"{name}_point"] + points[f"{name}_gap"]
    corners = Samples(points, samples.which).where(
        np.broadcast_to(holds(system.space, points), size.shape)
    )
    both = {
        name: np.concatenate([states, corners.points[name]])
        for name, states in samples.points.items()
    }
    which = np.concatenate([samples.which, corners.which])
    return replace(setting, states=Samples(both, which))


def _licensed(
    setting: Setting, origin: Sequence[Expr], positive: Sequence[Expr]
) -> tuple[Setting, str]:
    """Return the setting whose domain or premises say that these terms are positive, and the set of
    the statement, which says that the origins are.
    """
    domain, have = setting.domain, list(setting.have)
    for factor in positive:
        if checker.names_in(written(factor)) <= set(setting.system.parameters):
            domain = conjunction(domain, licence(factor, domain))
        elif not factor.is_Symbol:
            have.append(f"{written(factor)} > 0")
    if have:
        at = dict(zip(symbols(setting.system.state), setting.point_names))
        have += [f"{written(one.subs(at))} > 0" for one in origin if not one.is_number]
    strict = [poly for poly, is_strict in atoms(setting.system.space) if is_strict]
    more = [f"{written(one)} > 0" for one in origin if one not in strict and not one.is_number]
    on = conjunction(setting.system.space, *more)
    return replace(setting, domain=domain, have=tuple(dict.fromkeys(have))), on
