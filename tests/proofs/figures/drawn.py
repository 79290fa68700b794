"""The figures as drawn, and the states that the curves on them stand for."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

import pytest
from sympy import Symbol

from juggleproof.proofs.figures import TABLE
from juggleproof.proofs.figures.ours import Row, ranges
from tests.reports.results_table import results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Path = pytest.importorskip("matplotlib.path", reason="matplotlib is not installed").Path
PathPatch = pytest.importorskip("matplotlib.patches").PathPatch
ROWS: list[Row] = [
    ("whole", "holds", [(Fraction(0), Fraction(1), False, False)]),
    ("theorem", "holds", [(Fraction(0), Fraction(1, 3), False, False)]),
    ("at one", "misprint", [(Fraction(3, 25), Fraction(3, 25), True, True)]),
    ("empty", "false", []),
    ("unread", "unknown", None),
]


@cache
def figure(slug: str) -> Figure:
    if slug == "fig-ranges":
        return ranges(ROWS, 3)
    return next(one for one in TABLE if one.slug == slug).draw(results())


def curves(slug: str, name: str) -> list[PathPatch]:
    """The curves of this name, in the figure of this slug."""
    found = [one for one in figure(slug).findobj(PathPatch) if one.get_gid() == name]
    assert found, (slug, name)
    return found


def points(slug: str, name: str, parts: int = 7) -> list[tuple[float, float]]:
    """Points along every piece of the curves of this name, ends included, in the coordinates of
    their axes.
    """
    found = []
    for patch in curves(slug, name):
        here = (0.0, 0.0)
        for vertices, code in patch.get_path().iter_segments(curves=True, simplify=False):
            if code == Path.MOVETO:
                here = tuple(map(float, vertices))
                continue
            ends = [
                here,
                *[tuple(map(float, vertices[k : k + 2])) for k in range(0, len(vertices), 2)],
            ]
            found += [_bezier(ends, k / parts) for k in range(parts + 1)]
            here = ends[-1]
    return found


def _bezier(ends: list[tuple[float, float]], t: float) -> tuple[float, float]:
    while len(ends) > 1:
        ends = [
            ((1 - t) * a + t * c, (1 - t) * b + t * d) for (a, b), (c, d) in zip(ends, ends[1:])
        ]
    return ends[0]


def states(slug: str, name: str) -> list[dict[Symbol, float]]:
    """The states beta, v of the points of a curve in the plane of states, where 1 is r T across and
    r up, at alpha = 1/4 and r = g = 1.
    """
    from juggleproof.symbolic import period
    from juggleproof.symbolic.algebra import alpha, beta, g, r, v

    at = {alpha: Fraction(1, 4), r: 1, g: 1}
    unit = float(period().xreplace({r: 1, g: 1}))
    return [{**at, beta: x * unit, v: y} for x, y in points(slug, name)]
