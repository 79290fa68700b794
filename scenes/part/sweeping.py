"""Table I over a grid of restitution and friction, which the paper does not give; and the choice of
one pair for all rows, by a stated rule.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

from scenes.errors import SceneError
from scenes.part.onsets import Table, table_one
from scenes.part.setting import Scene, changed

RECORD = Path(__file__).with_name("sweep.json")
WORST = 1.0  # of a row: as if its onset were off by a factor e
MOST_POINTS = 10_000
# misfits this near one another are not told apart: two sweeps of 16 ensembles that differ in
# rounding alone differ by up to 0.12
SCATTER = 0.1


@dataclass(frozen=True)
class Point:
    """Table I at one (e, mu): each row's median onset in seconds, None where it is censored or
    chaotic; the chaotic parts; and the misfit.
    """

    e: float
    mu: float
    medians: tuple[float | None, ...]
    chaotic: tuple[int, ...]
    misfit: float


def misfit(table: Table) -> float:
    """How far a table is from the paper's: the mean over its rows of |ln(median/paper)|, at most 1.

    A row that the paper calls chaotic counts the part of its ensembles that are not.
    """
    return sum(
        _row_misfit(row.paper, row.quantile(0.5), sum(row.chaotic) / len(row.chaotic))
        for row in table.rows
    ) / len(table.rows)


def _row_misfit(paper: float | None, median: float, chaotic: float) -> float:
    if paper is None:
        return 1 - chaotic
    return min(WORST, abs(math.log(median / paper))) if 0 < median < math.inf else WORST


def sweep(
    setting: Scene,
    es: Sequence[float],
    mus: Sequence[float],
    *,
    ensembles: int,
    horizon: float,
    seed: int,
    peak: float = 1.0,
    executor: Executor | None = None,
    tell: Callable[[Point], None] | None = None,
) -> list[Point]:
    """Table I at every pair of the grid, in its order; `tell` hears of each point as it is done."""
    if not 0 < len(es) * len(mus) <= MOST_POINTS:
        raise SceneError(f"a sweep of {len(es)} by {len(mus)} points is outside 1 .. {MOST_POINTS}")
    points = []
    for e in es:
        for mu in mus:
            table = table_one(
                changed(setting, e=e, mu=mu),
                ensembles=ensembles,
                horizon=horizon,
                seed=seed,
                peak=peak,
                executor=executor,
            )
            medians = [row.quantile(0.5) for row in table.rows]
            points.append(
                Point(
                    e,
                    mu,
                    tuple(None if math.isinf(m) else round(m, 6) for m in medians),
                    tuple(sum(row.chaotic) for row in table.rows),
                    round(misfit(table), 6),
                )
            )
            if tell:
                tell(points[-1])
    return points


def chosen(points: Sequence[Point]) -> Point:
    """The pair with the least misfit; the first of the grid where several have it.

    >>> chosen([Point(0.5, 0.1, (), (), 0.9), Point(0.7, 0.1, (), (), 0.2)]).e
    0.7
    """
    return min(points, key=lambda point: point.misfit)


def as_good(points: Sequence[Point]) -> list[Point]:
    """The pairs whose misfit is within `SCATTER` of the least.

    >>> pairs = [(0.5, 0.9), (0.7, 0.2), (0.8, 0.25)]
    >>> len(as_good([Point(e, 0.1, (), (), misfit) for e, misfit in pairs]))
    2
    """
    most = chosen(points).misfit + SCATTER
    return [point for point in points if point.misfit <= most]


def as_json(points: Sequence[Point], ensembles: int, horizon: float, seed: int) -> str:
    """A record of a sweep."""
    return (
        json.dumps(
            {
                "ensembles": ensembles,
                "horizon": horizon,
                "seed": seed,
                "points": [asdict(point) for point in points],
            },
            indent=1,
        )
        + "\n"
    )


@cache
def recorded() -> tuple[Point, ...]:
    """The sweep that is stored beside this file; (e, mu) of the scene come from it.

    >>> min(point.misfit for point in recorded()) == chosen(recorded()).misfit
    True
    """
    try:
        found = json.loads(RECORD.read_text(encoding="utf-8"))["points"]
        return tuple(
            Point(p["e"], p["mu"], tuple(p["medians"]), tuple(p["chaotic"]), p["misfit"])
            for p in found
        )
    except (OSError, ValueError, KeyError, TypeError) as fault:
        raise SceneError(
            f"{RECORD.name}: the stored sweep cannot be read ({fault}); give --e and --mu, or write"
            " it anew by a sweep"
        ) from None
