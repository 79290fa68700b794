"""Searches for the premises of weighted ratios: proofs from few facts, each times products of
positive terms, with the squares and the cases of signs that the map suggests.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from functools import partial

import sympy

from juggleproof.certificates import checker
from juggleproof.map_stability.certifying import Search
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.equations import (
    at_parameters,
    factors_of,
    sizes_of,
)
from juggleproof.map_stability.premise_searches import proof_from_few_facts
from juggleproof.map_stability.terms import Expr, symbols, written
from juggleproof.search.decrease_proofs.by_products import proof_by_products
from juggleproof.statements.nodes import Proof

Row = tuple[int, ...]


def searches_for(
    setting: Setting,
    put: dict[Expr, Expr],
    rows: Sequence[Row],
    origin: Sequence[Expr],
    weights: Sequence[Expr],
    terms_used: Callable[[int], Sequence[int]],
) -> dict[str, Search]:
    """Return searches for most premises, with the facts that they use, squares and signs."""
    unknowns = [str(one) for one in put] + [root for root, _ in setting.point.roots]
    points, sizes = points_of(setting, put), sizes_of(setting, put, origin)
    sides = [size * weight for size, weight in zip(sizes, weights)]
    corners = _slopes_at_corners(setting, put, sides) if len(rows) == len(points) else []
    gaps = _gaps(setting)
    squares = list(dict.fromkeys([*gaps, *_differences(setting, put)]))
    names = setting.system.state
    own = symbols([f"{name}_gap" for name in names])
    halves = [written(sympy.numer(sympy.together(2 * gap + size))) for gap, size in zip(own, sizes)]
    moved = {one: e + gap for one, e, gap in zip(symbols(names), points, own)}
    origins = [sympy.numer(sympy.together(one.subs(moved))) for one in origin]
    used = [written(one) for one in [*origins, *factors_of(setting, [*sizes, *weights])]]
    found: dict[str, Search] = {}
    for k, (_, row) in enumerate(itertools.product((1, -1), rows)):
        found[f"falls-1-{k + 1}"] = partial(
            proof_that_it_falls,
            terms=terms_used(k),
            unknowns=unknowns,
            squares=squares,
            signs=[*gaps, *corners],
            used=used,
        )
        half = halves[row.index(1)] if k >= len(rows) and sum(map(abs, row)) == 1 else ""
        signs = [half] if half else []
        found[f"small-{k + 1}"] = partial(proof_from_few_facts, used=used, signs=signs)
    found["bounded"] = partial(
        proof_by_products,
        terms=[0, len(rows)],
        unknowns=unknowns,
        squares=(),
        signs=[f"{setting.system.state[rows[0].index(1)]}_gap"],
    )
    found["least"] = partial(
        proof_that_it_falls,
        terms=[k for k, row in enumerate([*rows, *rows]) if sum(map(abs, row)) == 1],
        unknowns=unknowns,
        squares=(),
        signs=(),
        used=used,
    )
    return found


def proof_that_it_falls(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    terms: Sequence[int],
    unknowns: Sequence[str],
    squares: Sequence[str],
    signs: Sequence[str],
    used: Sequence[str],
) -> Proof | None:
    """A proof by products of positive terms; or from few facts, by the cases of the sign of a
    squared difference, or of the signs of gaps and slopes.
    """
    found = proof_by_products(premise, known, terms, unknowns, squares, signs)
    differences = [one for one in squares if one not in signs]
    for cases in dict.fromkeys((tuple(differences[:1]), tuple(signs))):
        found = found or proof_from_few_facts(premise, known, used, cases, terms, unknowns)
    return found


def points_of(setting: Setting, put: dict[Expr, Expr]) -> list[Expr]:
    """The point, as premises name it."""
    names = setting.point_names
    return names if setting.have else [put[one] for one in names]


def _slopes_at_corners(setting: Setting, put: dict[Expr, Expr], sides: Sequence[Expr]) -> list[str]:
    """Return factors of slopes at the upper corner of a box V <= value with these sides: a slope of
    an image that is linear in each variable may have their sign.
    """
    state, images = symbols(setting.system.state), setting.system.images[setting.piece]
    (above,) = symbols(["value"])
    places = zip(state, points_of(setting, put), sides)
    corner = {one: e + side * above for one, e, side in places}
    found: dict[str, None] = {}
    for image, one in itertools.product(images, state):
        slope = sympy.diff(image, one)
        if slope.free_symbols & set(state) and slope.is_polynomial(*state):
            at_corner = sympy.numer(sympy.together(slope.subs(corner, simultaneous=True)))
            for factor, _ in sympy.factor_list(at_corner)[1]:
                both = len({c > 0 for c in sympy.Poly(factor, *factor.free_symbols).coeffs()}) > 1
                if both and above in factor.free_symbols and not set(put) & factor.free_symbols:
                    found[written(factor)] = None
    return list(found)


def _gaps(setting: Setting) -> list[str]:
    """The gaps; those of the variables in which the map is not affine come first."""
    names, images = setting.system.state, setting.system.images[setting.piece]
    affine = {
        name: all(sympy.cancel(sympy.diff(image, one, 2)) == 0 for image in images)
        for name, one in zip(names, symbols(names))
    }
    return [f"{name}_gap" for name in sorted(names, key=lambda name: affine[name])]


def _differences(setting: Setting, put: dict[Expr, Expr]) -> list[str]:
    """Return the differences of T/T(e) between two terms T of an image, which is a sum of terms.
    The difference of two means of numbers has the squares of such differences as factors.
    """
    state, names = symbols(setting.system.state), points_of(setting, put)
    gaps = symbols([f"{one}_gap" for one in setting.system.state])
    at = dict(zip(state, names))
    moved = {one: e + gap for one, e, gap in zip(state, names, gaps)}
    found: dict[str, None] = {}
    for image in setting.system.images[setting.piece]:
        for a, b in itertools.combinations(_parts(setting, image), 2):
            gap = a * b.subs(at, simultaneous=True) - b * a.subs(at, simultaneous=True)
            above = sympy.numer(sympy.together(gap)).subs(moved, simultaneous=True)
            for factor, _ in sympy.factor_list(sympy.expand(above))[1]:
                if factor.free_symbols & set(gaps) and not factor.is_Symbol:
                    found[written(factor)] = None
    return list(found)


def _parts(setting: Setting, image: Expr) -> list[Expr]:
    """The image as a sum of terms of different state variables, without negative ones."""
    state = symbols(setting.system.state)
    for one in state:
        image = sum(sympy.apart(part, one) for part in sympy.Add.make_args(sympy.expand(image)))
    sums: dict[frozenset[Expr], Expr] = {}
    for part in sympy.Add.make_args(sympy.expand(image)):
        own = frozenset(part.free_symbols & set(state))
        sums[own] = sums.get(own, 0) + part
    alone = sums.pop(frozenset(), sympy.Integer(0))
    at = dict(zip(state, setting.point_names))
    for own, part in sums.items():
        if at_parameters(setting, part.subs(at, simultaneous=True)).min() < 0:
            sums[own], alone = part + alone, sympy.Integer(0)
    return [one for one in (*sums.values(), alone) if one != 0]
