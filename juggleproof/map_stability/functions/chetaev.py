"""Instability in two variables or more: Chetaev functions, linear or quadratic, W > 0 in a cone
that ends at the point, where W grows by a rate until the orbit is farther than a radius.

Sources: LaSalle, The Stability of Dynamical Systems, SIAM 1976; of matrices that map a cone into
itself or into its opposite, Berman and Plemmons, Nonnegative Matrices in the Mathematical Sciences,
SIAM 1994.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.map_stability import limits
from juggleproof.map_stability.functions.candidates import (
    Setting,
    bounded_below,
    derivatives,
    lyapunov_form,
)
from juggleproof.map_stability.functions.templates import (
    Function,
    Template,
    best_weights,
    products_of_gaps,
    rounded,
    signed,
)
from juggleproof.map_stability.samples import SEED, Arrays, Floats, after
from juggleproof.map_stability.terms import as_factor, column, holds, symbols, value, written
from juggleproof.statements.cases import conjunction
from juggleproof.statements.language import MapRule


def chetaev_rules(setting: Setting, name: str) -> Iterator[MapRule]:
    """Statements `unstable` for a point that has a multiplier outside the unit circle at all
    samples of the parameters, for each of the functions.
    """
    multipliers = np.abs(np.linalg.eigvals(derivatives(setting))).max(axis=1)
    if multipliers.min() <= 1:
        return
    for function, more in rotations(setting):
        yield from _rules(setting, function, name, more)
    for function in functions(setting):
        yield from _rules(setting, function, name)


def rotations(setting: Setting) -> Iterator[tuple[Function, str]]:
    """Yield for two variables the area W(g) = g x A g that a distance g spans with its image under
    the derivative A.  W(A g) = det(A) W(g), so that the area grows if det(A) > 1, as at an unstable
    focus.  With it comes det(A) - 1 if the map is affine, else nothing.
    """
    system = setting.system
    if len(system.state) != 2 or (np.linalg.det(derivatives(setting)) <= 1).any():
        return
    gaps, matrix = symbols([f"{one}_gap" for one in system.state]), setting.derivative
    affine = len(system.pieces) == 1 and system.is_affine
    more = written(sympy.factor(matrix.det() - 1)) if affine else ""
    first, second = matrix * sympy.Matrix(gaps)
    area = sympy.Poly(gaps[0] * second - gaps[1] * first, *gaps)
    for sign in (1, -1):
        terms = [
            sign * sympy.factor(part) * gaps[0] ** n * gaps[1] ** m for (n, m), part in area.terms()
        ]
        yield Function((" + ".join(as_factor(written(one)) for one in terms),)), more


def cone_functions(setting: Setting) -> Iterator[Function]:
    """Yield linear forms W = |l g| of the distances g to the point, in an orthant and in its
    opposite.  The derivative A maps each of these into itself (z = 1) or into the other (z = -1).
    For the signs t of the orthant l = t adj(z A - 1), so that l z A = l + det(z A - 1) t, or -l.
    """
    system, count = setting.system, setting.count
    matrix = setting.derivative
    gaps, size, slopes = (
        [f"{one}_gap" for one in system.state],
        len(system.state),
        derivatives(setting),
    )
    for z, (first, *rest) in itertools.product((1, -1), itertools.product((1, -1), repeat=size)):
        signs = sympy.Matrix([[first, *rest]])
        turned = z * slopes * np.outer([first, *rest], [first, *rest])
        if first < 0 or (turned < 0).any():
            continue
        form = signs * (z * matrix - sympy.eye(size)).adjugate()
        numbers = np.stack(
            [s * column(written(one), setting.constants, count) for s, one in zip(signs, form)]
        )
        if (numbers < 0).all():
            form, numbers = -form, -numbers
        if (numbers > 0).all():
            terms = [f"{as_factor(written(one))}*{gap}" for one, gap in zip(form, gaps)]
            cones = [
                conjunction(*(f"{gap} {'>=' if s > 0 else '<='} 0" for s, gap in zip(one, gaps)))
                for one in (signs, -signs)
            ]
            total = " + ".join(terms)
            yield Function((total, f"-({total})"), tuple(cones))


def functions(setting: Setting) -> Iterator[Function]:
    """Functions W with W(f(s)) > W(s) at samples close to the point: quadratic forms of constant
    coefficients, linear forms in a cone, quadratic forms of coefficients linear in the parameters,
    and the solution of a discrete Lyapunov equation.
    """
    forms = products_of_gaps(setting.system)
    moving = tuple(f"{name}*{one}" for name in setting.system.parameters for one in forms)
    near = states(setting, np.full(setting.count, limits.SMALL_GAP))
    for basis in (forms, (*forms, *moving)) if moving else (forms,):
        template = Template(basis)
        with np.errstate(all="ignore"):
            grown = template.columns(after(setting.system, near)) - template.columns(near)
        rows = grown[np.isfinite(grown).all(axis=1)] / limits.SMALL_GAP**2
        weights = best_weights(rows[:: 1 + len(rows) // 3000]) if len(rows) else None
        if weights is not None:
            yield from (
                Function(tuple(template.terms(numbers)))
                for numbers in itertools.islice(rounded(weights, rows), limits.TRIED)
            )
        if basis == forms:
            yield from cone_functions(setting)
    form = lyapunov_form(setting)
    if form is not None:
        yield Function((f"-({form[0]})",))


def states(setting: Setting, radius: Floats) -> Arrays:
    """Return states of the space within the radius of the point, for each parameter.  Parameters
    are left out if their point is so far that its digits hide the distances.
    """
    system = setting.system
    rng = np.random.default_rng(SEED + 2)
    which = np.repeat(np.arange(setting.count), limits.STATES_NEAR)
    direction = rng.uniform(-1, 1, (len(system.state), len(which)))
    reach = np.where(rng.random(len(which)) < 0.5, 1.0, rng.uniform(0.1, 1, len(which)))
    direction *= reach / np.abs(direction).max(axis=0)
    points = {name: values[which] for name, values in setting.constants.items()}
    for name, part in zip(system.state, direction):
        points[f"{name}_gap"] = radius[which] * part
        points[name] = points[f"{name}_point"] + points[f"{name}_gap"]
    points["which"] = which.astype(float)
    with np.errstate(all="ignore"):
        inside = np.broadcast_to(holds(system.space, points), (len(which),))
    size = np.max([np.abs(points[f"{name}_point"]) for name in system.state], axis=0)
    inside = inside & (np.finfo(float).eps * size <= limits.DIGITS * radius[which])
    return {name: values[inside] for name, values in points.items()}


def _growth(setting: Setting, function: Function, radius: Floats) -> Floats:
    """The least W(f(s))/W(s) over states within the radius with W(s) > 0, for each parameter."""
    points = states(setting, radius)
    size = len(points["which"])
    here, there = function.along(setting.system, points, size)
    with np.errstate(all="ignore"):
        share = np.where(here > 0, there / here, np.inf)
    found = np.full(setting.count, np.inf)
    np.minimum.at(found, points["which"].astype(int), np.nan_to_num(share, nan=-np.inf))
    return found


def _along(setting: Setting, direction: Sequence[Fraction], radius: Floats) -> Arrays:
    """The states at the radius in a direction."""
    points = dict(setting.constants)
    for name, part in zip(setting.system.state, direction):
        points[f"{name}_gap"] = float(part) * radius
        points[name] = points[f"{name}_point"] + points[f"{name}_gap"]
    return points


def _inside(setting: Setting, direction: Sequence[Fraction], radius: Floats) -> NDArray[np.bool_]:
    """Return for which parameters the state at the radius in the direction is in the space."""
    points = _along(setting, direction, radius)
    with np.errstate(all="ignore"):
        return np.broadcast_to(holds(setting.system.space, points), (setting.count,))


def _direction(setting: Setting, function: Function) -> tuple[Fraction, ...] | None:
    """Return the direction of size 1 in which the least W over all parameters is greatest."""
    small = np.full(setting.count, limits.SMALL_GAP)
    steps = [Fraction(k, limits.GRID) for k in range(-limits.GRID, limits.GRID + 1)]
    best, most = None, 0.0
    for direction in itertools.product(steps, repeat=len(setting.system.state)):
        if max(map(abs, direction)) == 1 and _inside(setting, direction, small).all():
            least = function.at(_along(setting, direction, small), setting.count).min()
            if least > most * (1 + 1e-6):
                best, most = direction, least
    return best


def _rules(setting: Setting, function: Function, name: str, exact: str = "") -> Iterator[MapRule]:
    """The statements for one function: a direction, a radius and a rate that samples allow, or the
    rate 1 + `exact` of a linear map.
    """
    growth = _growth(setting, function, np.full(setting.count, limits.SMALL_GAP))
    direction = _direction(setting, function)
    if direction is None:
        return
    rates = [(0.0, exact)]
    if not exact:
        rates = bounded_below(np.minimum(growth - 1, 4.0) * limits.GROWTH_LEFT, setting.products, 1)
    for _, more in rates:
        rate = 1 + np.broadcast_to(value(more, setting.constants), (setting.count,))
        largest = np.zeros(setting.count)
        for power in range(limits.RADIUS_HALVINGS):
            radius = np.full(setting.count, 0.5**power)
            fits = _inside(setting, direction, radius)
            if not exact:
                fits = fits & (_growth(setting, function, radius) >= rate)
            largest = np.where(fits & (largest == 0), radius, largest)
        for _, radius_text in bounded_below(largest, setting.products, 2):
            curve = [
                f"{one}_point + {signed(c)}*distance" if c else f"{one}_point"
                for one, c in zip(setting.system.state, direction)
            ]
            size = np.broadcast_to(value(radius_text, setting.constants), (setting.count,))
            most = max(
                function.at(_along(setting, corner, size), setting.count).max() / (size**2).min()
                for corner in itertools.product(*[(Fraction(-1), Fraction(1))] * len(curve))
            )
            rows = [("rate", f"1 + {more}"), ("radius", radius_text)]
            rows += [("upper", str(int(4 * most) + 1))]
            yield setting.rule(name, function, rows, after=[("direction", ", ".join(curve))])
