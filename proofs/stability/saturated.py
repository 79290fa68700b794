"""Lyapunov functions for maps with saturation, a maximum or an absolute value of linear terms
(Lur'e and Postnikov 1944): quadratic forms in the distances to the point and in the parts of the
map that are not linear.  The integral of a saturation is one of them.

By linear programs on samples, rounded; the loss is c V/(1 + V), since such maps move by no more
than a constant far from the point.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import sympy

from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability import values
from juggleproof.proofs.stability.given import (
    ANYWHERE,
    Expr,
    Map,
    expression,
    holds,
    symbols,
    value,
    written,
)
from juggleproof.proofs.stability.samples import (
    SEED,
    Arrays,
    Floats,
    Samples,
    after,
    around,
    region,
)
from juggleproof.proofs.stability.values import (
    Function,
    Setting,
    best_weights,
    bounded_below,
    program,
    quadratic_templates,
    rounded,
    small_balls,
)

DEGREES = (0, 1, 2)  # of the coefficients in the parameters
MOST_UNKNOWNS = 40
MOST_ROWS = 2500  # of a linear program
TURNS = 6
KEPT = 10  # the margin may fall to this part of itself
SIMPLE = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20)
LOSSES = 2  # candidates for the constant of a loss
FARTHER = 1000.0
CLOSE = 1e-3  # of V, where a piece is taken to reach the point
LEAST_MARGIN = 1e-6

Signs = dict[str, list[str]]  # for a premise, polynomials whose signs are its cases


# -------------------------------------------------------------------------------------------------
# What of the map is not linear.


def shifted(setting: Setting) -> tuple[dict[Expr, Expr], list[Expr]]:
    """The state as point plus gap, and the point's terms."""
    system = setting.system
    names = [f"{one}_point" for one in system.state]
    point = symbols(names) if setting.have else [expression(t) for t in setting.point.terms]
    gaps = symbols([f"{one}_gap" for one in system.state])
    return {s: e + g for s, e, g in zip(symbols(system.state), point, gaps)}, point


def corrections(setting: Setting) -> list[list[Expr]]:
    """Terms in the gaps, one for each piece, that are linear in the point's piece and constant in
    the first of the others that is not linear: a saturation, of a linear term that is 0 at the
    point.
    """
    system = setting.system
    put, _ = shifted(setting)
    gaps = symbols([f"{one}_gap" for one in system.state])
    images = [[t.subs(put, simultaneous=True) for t in row] for row in system.images]
    found: list[list[Expr]] = []
    for j in range(len(gaps)):
        row = [sympy.expand(image[j] - images[setting.piece][j]) for image in images]
        parts = [sympy.Poly(sympy.together(term), *gaps) for term in row]
        content = sympy.gcd_list([c for part in parts for c in part.coeffs() if c != 0] or [1])
        if not content.free_symbols:
            content = sympy.Integer(1)
        row = [sympy.cancel(term / content) for term in row]
        sloped = [term for term in row if any(term.has(gap) for gap in gaps)]
        if not sloped:
            continue
        linear = sum(sympy.diff(sloped[0], gap) * gap for gap in gaps)
        row = [sympy.expand(term - linear) for term in row]
        if all(sympy.Matrix([row, one]).rank() > 1 for one in found):
            found.append(row)
    return found


@dataclass(frozen=True)
class QuadraticForms:
    """Functions that are quadratic in the gaps and in the corrections; the basis as text for each
    part, all of it with the same weights.
    """

    guards: tuple[str, ...]  # of the parts
    bases: tuple[tuple[str, ...], ...]
    part_of: tuple[int, ...]  # the part that each piece is in

    @classmethod
    def of(cls, setting: Setting, degree: int) -> QuadraticForms:
        """Those whose coefficients have this degree in the parameters."""
        system = setting.system
        rows = corrections(setting)
        gaps = symbols([f"{one}_gap" for one in system.state])
        factors = [
            sympy.prod(chosen)
            for count in range(degree + 1)
            for chosen in itertools.combinations_with_replacement(symbols(system.parameters), count)
        ]
        cells: dict[tuple[Expr, ...], list[int]] = {}
        for k in range(len(system.pieces)):
            cells.setdefault(tuple(row[k] for row in rows), []).append(k)
        bases, guards = [], []
        for cell, pieces in cells.items():
            pairs = list(itertools.combinations_with_replacement([*gaps, *cell], 2))
            bases.append(tuple(str(written(m * a * b)) for m in factors for a, b in pairs))
            one = [system.pieces[k][0] for k in pieces]
            guards.append(one[0] if len(one) == 1 else " or ".join(f"({g})" for g in one))
        place = {k: n for n, pieces in enumerate(cells.values()) for k in pieces}
        return cls(tuple(guards), tuple(bases), tuple(place[k] for k in range(len(system.pieces))))

    def columns(self, point: Arrays) -> Floats:
        """The basis at each state, (states, unknowns)."""
        size = len(next(iter(point.values())))
        found = np.zeros((size, len(self.bases[0])))
        for guard, basis in zip(self.guards, self.bases):
            inside = np.broadcast_to(holds(guard, point), (size,))
            for k, text in enumerate(basis):
                found[inside, k] = np.broadcast_to(np.asarray(value(text, point), float), (size,))[
                    inside
                ]
        return found

    def function(self, numbers: Sequence[Fraction]) -> Function:
        """V with these weights; without guards, where all its parts are one."""
        terms = []
        for basis in self.bases:
            weighted = zip(numbers, map(expression, basis))
            total = sum(sympy.Rational(c.numerator, c.denominator) * b for c, b in weighted if c)
            terms.append(written(sympy.expand(total)))
        if len(set(terms)) == 1:
            return Function((terms[0],))
        return Function(tuple(terms), self.guards)


# -------------------------------------------------------------------------------------------------
# Weights.


def margins(forms: QuadraticForms, system: Map, points: Arrays) -> Floats:
    """The rows that ask V(s) - V(f(s)) > 0, in units of min(1, |s - e|^2), and V(s) > 0."""
    with np.errstate(all="ignore"):
        here, there = forms.columns(points), forms.columns(after(system, points))
        size = np.sum([points[f"{one}_gap"] ** 2 for one in system.state], axis=0)
        falls = (here - there) / np.minimum(1, size)[:, None]
        rows = np.concatenate([falls, here / (size / (1 + np.sqrt(size)))[:, None]])
    found: Floats = rows[np.isfinite(rows).all(axis=1) & np.tile(size > 1e-10, 2)]
    return found


def greatest_margin(rows: Floats, low: Floats, high: Floats) -> tuple[Floats, float] | None:
    """Weights between the bounds with the greatest least margin, and that."""
    count, unknowns = rows.shape
    found = program(
        np.hstack([rows, -np.ones((count, 1))]),
        np.zeros(count),
        np.append(low, -1.0),
        np.append(high, 1.0),
        np.append(np.zeros(unknowns), -1.0),
    )
    if found is None or found[-1] < LEAST_MARGIN:
        return None
    return found[:-1], float(found[-1])


def simple_weights(rows: Floats) -> list[Fraction] | None:
    """Rational weights with positive margins: those not needed are 0, the others are made simple
    one by one.
    """
    unknowns = rows.shape[1]
    low, high = -np.ones(unknowns), np.ones(unknowns)
    kept = rows[np.linspace(0, len(rows) - 1, min(len(rows), MOST_ROWS)).astype(int)]

    def solved() -> tuple[Floats, float] | None:
        nonlocal kept
        for _ in range(TURNS):
            found = greatest_margin(kept, low, high)
            if found is None:
                return None
            missed = np.flatnonzero(rows @ found[0] <= 0)
            if not len(missed):
                return found
            kept = np.concatenate([kept, rows[missed[:: 1 + len(missed) // 300]]])
        return None

    best = solved()
    if best is None:
        return None
    weights, margin = best
    worst = np.argsort(rows @ weights)[:MOST_ROWS]
    kept = np.concatenate([kept[:: 1 + len(kept) // 500], rows[worst[::4]]])
    for j in map(int, np.argsort(np.abs(weights))):
        low[j] = high[j] = 0.0
        found = solved()
        if found is None or found[1] < margin / KEPT:
            low[j], high[j] = -1.0, 1.0
        else:
            weights = found[0]
    open_ = [int(j) for j in np.argsort(-np.abs(weights)) if high[j] > low[j]]
    numbers = [Fraction(0)] * unknowns
    for place, j in enumerate(open_):
        if not place:
            choices = [Fraction(1 if weights[j] > 0 else -1)]
        else:
            choices = list(dict.fromkeys(Fraction(round(weights[j] * d), d) for d in SIMPLE))
        for number in choices:
            before = low[j], high[j]
            low[j] = high[j] = float(number)
            found = solved()
            if found is not None and (place == 0 or found[1] > margin / KEPT**2):
                weights, numbers[j] = found[0], number
                break
            low[j], high[j] = before
        else:
            return None
    return numbers


def far_too(system: Map, samples: Samples, on: str) -> Arrays:
    """The states, and others in their directions up to FARTHER times as far."""
    count = len(samples.which)
    reach = FARTHER ** np.random.default_rng(SEED).random(count)
    there = dict(samples.points)
    for one in system.state:
        there[f"{one}_gap"] = samples.points[f"{one}_gap"] * reach
        there[one] = there[f"{one}_point"] + there[f"{one}_gap"]
    inside = np.broadcast_to(holds(f"({system.space}) and ({on})", there), (count,))
    return {
        name: np.concatenate([numbers, there[name][inside]])
        for name, numbers in samples.points.items()
    }


def functions(setting: Setting, on: str) -> Iterator[tuple[QuadraticForms, Function]]:
    """Candidates for V, the simplest first, that fall at all samples of the set."""
    system = setting.system
    samples = far_too(system, around(system, setting.point, setting.parameters, 40, on), on)
    parameters = region(setting.domain, system.parameters, 500)
    tests = far_too(system, around(system, setting.point, parameters, 20, on), on)
    for degree in DEGREES if system.parameters else DEGREES[:1]:
        forms = QuadraticForms.of(setting, degree)
        if len(forms.bases[0]) > MOST_UNKNOWNS:
            return
        rows, every = margins(forms, system, samples), margins(forms, system, tests)
        simple = simple_weights(rows)
        if simple is not None and (every @ np.array([float(one) for one in simple]) > 0).all():
            yield forms, forms.function(simple)


# -------------------------------------------------------------------------------------------------
# The statement, and the polynomials whose signs prove it.


def saturated_rules(setting: Setting, on: str, name: str) -> Iterator[tuple[MapRule, Signs]]:
    """The statements `lyapunov` of these functions with a loss c V/(1 + V), those with one term
    first, each with the cases that its premises are to be proved by.
    """
    system = setting.system
    parameters = region(setting.domain, system.parameters, 500)
    tests = around(system, setting.point, parameters, 20, on).points
    states = around(system, setting.point, setting.parameters, 40, on).points
    one = next(quadratic_templates(system, setting.piece, ()))
    rows, _ = values.margins(one, system, states)
    every, _ = values.margins(one, system, tests)
    weights = best_weights(rows)
    for numbers in itertools.islice(rounded(weights, every), 2) if weights is not None else ():
        yield from rules_of(setting, (), Function(tuple(one.terms(numbers))), on, name)
    for forms, function in dict.fromkeys(functions(setting, on)):
        yield from rules_of(setting, forms.part_of, function, on, name)


def rules_of(
    setting: Setting, part_of: Sequence[int], function: Function, on: str, name: str
) -> Iterator[tuple[MapRule, Signs]]:
    """The statements for one function, whose part at each piece is given.

    Where V falls by c V in the pieces that reach the point and by c in the others, it falls by
    c V/(1 + V) in all.
    """
    system = setting.system
    samples = around(system, setting.point, setting.parameters, 40, on)
    count = len(samples.which)
    with np.errstate(all="ignore"):
        nexts = after(system, samples.points)
        here, there = function.at(samples.points, count), function.at(nexts, count)
    gaps = [samples.points[f"{one}_gap"] for one in system.state]
    size = np.sum([gap**2 for gap in gaps], axis=0)
    fits = np.isfinite(here) & np.isfinite(there) & (size > 1e-10)
    shares, reach = np.full(count, np.inf), {}
    guards = function.guards or (ANYWHERE,)
    for i, (guard, _) in enumerate(system.pieces):
        before = np.broadcast_to(holds(guard, samples.points), (count,)) & fits
        for k, part in enumerate(guards):
            inside = before & np.broadcast_to(holds(part, nexts), (count,))
            reach[i, k] = bool((here[inside] < CLOSE).any())
            shares[inside] = (here - there)[inside] / (here[inside] if reach[i, k] else 1)
    grows = f"(1 + {FAR_SIZE})" if function.guards else ""
    under = here / size * (1 + np.max(np.abs(gaps), axis=0) if grows else 1)
    floor = samples.least(np.where(fits, under, np.inf), setting.count)
    lowest = bounded_below(floor, setting.products, 1)
    ball = next(small_balls(setting, function), None)
    if not lowest or ball is None:
        return
    steepness = lowest[0][1]
    products = setting.products[:1] if function.guards else setting.products
    for _, drop in bounded_below(
        samples.least(shares, setting.count) / 2, products, LOSSES
    ):
        constant = written(expression(drop) * expression(steepness) / 2)
        below = f"{constant_start(constant)}distance^2/(1 + level)"
        rows = [
            ("on", on),
            ("loss", f"{constant_start(drop)}value/(1 + value)"),
            ("least", below + (f"/{grows}" if grows else "")),
            ("upper", ball[1]),
            ("radius", ball[0]),
        ]
        signs = {
            "least": least_signs(setting, function, expression(steepness), bool(grows)),
            **falls_signs(setting, function, part_of, reach, expression(drop)),
        }
        yield setting.rule(name, function, rows), signs


FAR_SIZE = "distance"


def constant_start(constant: str) -> str:
    """A constant as a factor that stands first."""
    return (
        "" if constant == "1" else f"{constant}*" if constant.isidentifier() else f"({constant})*"
    )


def numerator(setting: Setting, term: Expr) -> str:
    """The term times its denominator, and without factors that are positive."""
    above = sympy.numer(sympy.together(sympy.expand(term)))
    constant, factors = sympy.factor_list(above)
    rest = [sympy.Integer(1 if constant > 0 else -1)]
    for factor, power in factors:
        names = {str(symbol) for symbol in factor.free_symbols}
        if names <= setting.constants.keys():
            at = np.asarray(value(written(factor), setting.constants), float)
            if (at > 0).all() or (at < 0).all():
                rest += [] if (at > 0).all() or power % 2 == 0 else [sympy.Integer(-1)]
                continue
        rest.append(factor**power)
    return written(sympy.expand(sympy.prod(rest)))


def least_signs(setting: Setting, function: Function, steepness: Expr, grows: bool) -> list[str]:
    """V less its lower bound, in the gaps and in the distance."""
    (distance, level) = symbols(["distance", "value"])
    lower = steepness * distance**2 / (1 + distance if grows else 1) / 2
    found = [numerator(setting, level - lower)]
    if not function.guards:
        squares = sum(gap**2 for gap in symbols([f"{one}_gap" for one in setting.system.state]))
        more = expression(function.terms[0]) - steepness * (squares - distance**2 / 4)
        found = [numerator(setting, more), *found]
    return found


def falls_signs(
    setting: Setting,
    function: Function,
    part_of: Sequence[int],
    reach: Mapping[tuple[int, int], bool],
    drop: Expr,
) -> Mapping[str, list[str]]:
    """By how much more V falls than it has to, for each piece and each part of V after it."""
    put, point = shifted(setting)
    gaps = symbols([f"{one}_gap" for one in setting.system.state])
    found = {}
    for i, images in enumerate(setting.system.images):
        following = {
            gap: (image - e).subs(put, simultaneous=True)
            for gap, image, e in zip(gaps, images, point)
        }
        here = expression(function.terms[part_of[i] if function.guards else 0])
        for k, term in enumerate(function.terms):
            there = expression(term).subs(following, simultaneous=True)
            more = here - there - drop * (here if reach[i, k] else 1)
            signs = [more]
            if function.guards and reach[i, k]:
                signs.insert(0, symbols(["value"])[0] * (1 - drop) - there)
            found[f"falls-{i + 1}-{k + 1}"] = [numerator(setting, one) for one in signs]
    return found
