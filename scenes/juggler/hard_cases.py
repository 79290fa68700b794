"""The cases at which floats go wrong or might, each followed in plain float64, exactly, in bounded
float64 and in balls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from scenes.juggler.exact import flight, impact, strikes
from scenes.juggler.formulas import formulas
from scenes.juggler.given import nearest
from scenes.juggler.orbits import Row, orbit
from scenes.juggler.setting import Scene, scene
from scenes.juggler.starts import point

TINY, HUGE, THIRD = Fraction(1, 10**300), Fraction(10**300), Fraction(1, 3)
FLIGHT = 1000  # periods that plain floats are followed for where a case counts impacts


@dataclass(frozen=True)
class Case:
    """An exact start, followed for so many periods (or impacts); in exact numbers up to so many
    bits.
    """

    name: str
    alpha: Fraction
    x: Fraction
    w: Fraction
    steps: int
    impacts: bool = False
    most_bits: int | None = None

    @property
    def scene(self) -> Scene:
        """The scene of this one start."""
        return scene(self.alpha, point(self.x, self.w))


class Finding(NamedTuple):
    """What each arithmetic comes to: where plain floats first took a wrong branch (None: nowhere),
    and the rows of exact, fast and enclosed.
    """

    case: Case
    floats: tuple[float, float]
    wrong_at: int | None
    exact: Row
    fast: Row
    enclosed: Row
    edges: int  # states proved to lie on x = w


def _case(
    name: str, alpha: Fraction | str, x: Fraction | str, w: Fraction | str, steps: int, *more: Any
) -> Case:
    return Case(name, Fraction(alpha), Fraction(x), Fraction(w), steps, *more)


CASES = (
    _case("alpha -> 0: 10^-300", TINY, "10", "-3", 50),
    _case("alpha -> 0: 10^-400, no float", Fraction(1, 10**400), "10", "-3", 50),
    _case("alpha -> 1/3 from below, by 10^-300", THIRD - TINY, "0", "3", 100),
    _case("alpha = 1/3, on e_2", THIRD, "0", "3", 100),
    _case("alpha = (K - 1)/(K + 1), K = 4, on e_4", "3/5", "0", "5", 100),
    _case("alpha -> 1: 1 - 10^-20", 1 - Fraction(1, 10**20), "1", "-2", 100),
    _case("start on x = w", "3/10", "5/7", "5/7", 50),
    _case("x = w after an impact", "3/10", "4/3", "4", 50),
    _case("x = w after an impact, two limits: e_1 or e_2", "3/7", "4/3", "3", 100),
    _case("10^-300 above x = w", "3/10", 1 + TINY, "1", 50),
    _case("10^-300 below x = w", "3/10", 1 - TINY, "1", 50),
    _case("x = 0", "3/10", "0", "7/3", 50),
    _case("x = 10^-300", "3/10", TINY, "7/3", 50),
    _case("w = 0, x = 0", "3/10", "0", "0", 50),
    _case("w = 10^-300, x = 0", "3/10", "0", TINY, 50),
    _case("w = -10^-300, x = 0", "3/10", "0", -TINY, 50),
    _case("w < 0", "3/10", "2", "-1/4", 50),
    _case("energy 10^-300", "3/10", TINY / 2, "1", 50),
    _case("energy 10^300", "3/10", HUGE / 2, "1", 3, True),
    _case("10^6 periods", "3/10", "1000", "-41", 10**6),
    _case("digits that grow, 1000 bits allowed", "97/100", "1", "-4", 2000, False, 1000),
)


def plain_floats(case: Case, most: int = 10**5) -> tuple[tuple[float, float], int | None]:
    """The orbit of plain float64, period by period up to so many, and the first period whose branch
    is not that of the exact orbit.

    Floats are followed without an eye on their error: alpha and start are rounded, a state strikes
    where x < w as floats.  The exact orbit is followed beside them up to numbers of 5000 bits.

    >>> plain_floats(_case("", "3/7", "4/3", "3", 50))[1]
    1
    """
    alpha, x, w = (nearest(value)[0] for value in (case.alpha, case.x, case.w))
    map_, wrong = formulas(), None
    true = _branches(case)
    for period in range(min(case.steps, most) if not case.impacts else FLIGHT):
        struck = map_.margin(x, w) > 0
        branch = next(true, None) if wrong is None else None
        if branch is not None and struck != branch:
            wrong = period
        x, w = map_.impact(alpha, x, w) if struck else map_.flight(x, w, 1)
    return (x, w), wrong


def _branches(case: Case) -> Iterator[bool]:
    """Whether each period of the exact orbit has an impact."""
    x, w = case.x, case.w
    while True:
        struck = strikes(x, w)
        yield struck
        x, w = impact(case.alpha, x, w) if struck else flight(x, w, 1)
        if max(x.denominator, w.denominator).bit_length() > 5000:
            return


def finding(case: Case) -> Finding:
    """All that is found of a case."""
    floats, wrong = plain_floats(case)
    balls = orbit(case.scene, "enclosed", case.steps, impacts=case.impacts)
    return Finding(
        case,
        floats,
        wrong,
        orbit(case.scene, "exact", case.steps, impacts=case.impacts, most_bits=case.most_bits).row(
            0
        ),
        orbit(case.scene, "fast", case.steps, impacts=case.impacts).row(0),
        balls.row(0),
        balls.tracks[0].edges,
    )
