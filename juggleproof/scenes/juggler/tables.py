"""Orbits as tables, and the hard cases, at which floats go wrong or might."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import inf, nan, nextafter
from typing import BinaryIO, NamedTuple

import numpy as np
from flint import arb, ctx
from mpmath import mpf

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.bounded import CHUNK, ENDS, Bounded, Column, radius_of
from juggleproof.scenes.juggler.compiled_map import brief, formulas, nearest
from juggleproof.scenes.juggler.exact import as_fraction, flight, impact, lifted, strikes
from juggleproof.scenes.juggler.orbits import Error, OrbitRow, Orbits, Value, orbit
from juggleproof.scenes.juggler.starts import Scene, point, scene

# -------------------------------------------------------------------------------------------------
# Tables.
#
# Orbits as tables: rows of text in either system of units, CSV, and arrays of floats with bounds.

UNITS = ("normal", "physical")
NAMES = {"normal": ("x", "w"), "physical": ("beta", "v")}
LONG_BITS, DIGITS = 4000, 40  # longer exact numbers are written as balls of this many digits


def checked_units(units: str) -> str:
    """The name of the units; raises SceneError where there are none of that name."""
    if units not in UNITS:
        raise SceneError(f"units = {brief(units)!r} is not one of {', '.join(UNITS)}")
    return units


def in_units(orbits: Orbits, row: OrbitRow, units: str) -> OrbitRow:
    """The row in the wanted units: x and w, or beta and v of the paper."""
    if checked_units(units) == "normal":
        return row
    r, g, unscaled = orbits.scene.r, orbits.scene.g, formulas().unscaled
    if isinstance(row.x, Fraction) and isinstance(row.w, Fraction):
        beta, v = unscaled(row.x, row.w, r, g)
        return row._replace(x=beta, w=v)
    if isinstance(row.x, float):
        one, two = (
            Bounded(np.array(value), np.array(error, np.float64))
            for value, error in zip((row.x, row.w), row.error or (inf, inf))
        )
        one, two = unscaled(one, two, Bounded.of(r), Bounded.of(g))
        return row._replace(x=float(one.v), w=float(two.v), error=(float(one.e), float(two.e)))
    x: arb | mpf = row.x
    w: arb | mpf = row.w
    if orbits.arithmetic == "enclosed":
        with ctx.workprec(max(x.bits(), w.bits(), 128) + 64):
            beta, v = unscaled(x, w, arb(lifted(r)), arb(lifted(g)))
        return row._replace(x=beta, w=v, error=(radius_of(beta), radius_of(v)))
    whole = x.context.mpf
    beta, v = unscaled(x, w, *(whole(one.numerator) / one.denominator for one in (r, g)))
    return row._replace(x=beta, w=v)


def as_text(value: Value, error: Error | None, digits: int = DIGITS) -> tuple[str, str]:
    """A number and its error as text: exact fractions as they are unless long, balls as enclosing
    decimals, "" for an error that is not known.
    """
    if isinstance(value, Fraction):
        if max(value.numerator.bit_length(), value.denominator.bit_length()) <= LONG_BITS:
            return str(value), "0"
        with ctx.workprec(8 * digits):
            return _ball(arb(lifted(value)), digits)
    if isinstance(value, arb):
        return _ball(value, digits)
    if isinstance(value, float):
        return repr(value), repr(error)
    return str(value.context.nstr(value, value.context.dps)), ""


def _ball(ball: arb, digits: int) -> tuple[str, str]:
    """Midpoint and radius of decimals that enclose the ball."""
    text = ball.str(digits).strip("[]")
    middle, _, radius = text.partition(" +/- ")
    return (
        ("0", middle.removeprefix("+/- ")) if middle.startswith("+/-") else (middle, radius or "0")
    )


def rows(orbits: Orbits) -> Iterator[OrbitRow]:
    """All rows: every state that was kept, or where each orbit stands."""
    for index in range(orbits.followed):
        yield from (orbits.history(index) if orbits.keep else [orbits.row(index)])


def as_csv(orbits: Orbits, file: BinaryIO, units: str = "normal") -> None:
    """Writes the rows as CSV, states with errors, row by row; the same to the byte from run to
    run.
    """
    names = NAMES[checked_units(units)]
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    table = csv.writer(text, lineterminator="\n")
    table.writerow(
        [
            "start",
            "periods",
            "impacts",
            names[0],
            f"error of {names[0]}",
            names[1],
            f"error of {names[1]}",
            "end",
        ]
    )
    for row in rows(orbits):
        shown = in_units(orbits, row, units)
        error = shown.error or (None, None)
        # In a history of fast arithmetic only one of the two is counted.
        counts = ["" if count < 0 else count for count in (shown.periods, shown.impacts)]
        table.writerow(
            [
                shown.start,
                *counts,
                *as_text(shown.x, error[0]),
                *as_text(shown.w, error[1]),
                shown.end,
            ]
        )
    text.detach()


def _as_float(value: Value, error: Error | None) -> tuple[float, float]:
    """The float next to a number, and a bound on how far the true number is from it; nan where none
    is known.
    """
    if error is None:
        return float(value), nan
    if isinstance(value, float):
        return value, float(error)
    if isinstance(value, Fraction):
        return nearest(value)
    middle, missed = nearest(as_fraction(value.mid().fmpq()))
    return middle, nextafter(nextafter(nearest(Fraction(error))[0], inf) + missed, inf)


def as_arrays(orbits: Orbits, units: str = "normal") -> dict[str, Column]:
    """Arrays of shape (n,), one entry for each row: start, periods, impacts, the state and bounds
    on its error as float64, end as its place in ENDS.

    In fast arithmetic the history, if kept, has the shape (starts, steps + 1) instead, nan where an
    orbit has no such state.
    """
    names = NAMES[checked_units(units)]
    if orbits.ensemble is not None:
        e, upto = orbits.ensemble, orbits.followed
        x, w, error_x, error_w = (
            (part[:upto] for part in (e.x, e.w, e.error_x, e.error_w))
            if e.history is None
            else np.moveaxis(e.history[:upto], 2, 0)
        )
        one, two = Bounded(x, error_x), Bounded(w, error_w)
        if units == "physical":
            one, two = _unscaled(one, two, Bounded.of(orbits.scene.r), Bounded.of(orbits.scene.g))
        return {
            "start": np.arange(upto),
            "periods": e.periods[:upto],
            "impacts": e.impacts[:upto],
            names[0]: one.v,
            f"error_{names[0]}": one.e,
            names[1]: two.v,
            f"error_{names[1]}": two.e,
            "end": e.end[:upto],
        }
    shown = [in_units(orbits, row, units) for row in rows(orbits)]
    pairs = [
        [_as_float(value, error) for value, error in zip((row.x, row.w), row.error or (None, None))]
        for row in shown
    ]
    columns = {
        "start": np.array([row.start for row in shown]),
        "end": np.array([ENDS.index(row.end) for row in shown], dtype=np.uint8),
    }
    for name, counts in (
        ("periods", [row.periods for row in shown]),
        ("impacts", [row.impacts for row in shown]),
    ):
        columns[name] = (
            np.array(counts)
            if all(count < 2**63 for count in counts)
            else np.array([str(count) for count in counts])
        )
    for place, name in enumerate(names):
        columns[name] = np.array([pair[place][0] for pair in pairs], dtype=np.float64)
        columns[f"error_{name}"] = np.array([pair[place][1] for pair in pairs], dtype=np.float64)
    return columns


def _unscaled(x: Bounded, w: Bounded, r: Bounded, g: Bounded) -> tuple[Bounded, Bounded]:
    """The states in the paper's units, a part at a time, so that what is held in between does not
    grow with their number.
    """
    beta, v = (Bounded(np.empty_like(x.v), np.empty_like(x.v)) for _ in range(2))
    for low in range(0, len(x.v), CHUNK):
        part = slice(low, low + CHUNK)
        with np.errstate(all="ignore"):
            some_beta, some_v = formulas().unscaled(x.at(part), w.at(part), r, g)
        beta.put(part, some_beta)
        v.put(part, some_v)
    return beta, v


def as_npz(orbits: Orbits, file: BinaryIO, units: str = "normal") -> None:
    """Writes the arrays of `as_arrays`, with alpha, r and g as text, as a compressed file of NumPy;
    `end` counts in `ends`.
    """
    header = {
        "alpha": str(orbits.scene.alpha),
        "r": str(orbits.scene.r),
        "g": str(orbits.scene.g),
        "arithmetic": orbits.arithmetic,
        "units": units,
    }
    np.savez_compressed(
        file, allow_pickle=False, ends=np.array(ENDS), **header, **as_arrays(orbits, units)
    )


# -------------------------------------------------------------------------------------------------
# Hard cases.
#
# The cases at which floats go wrong or might, each followed in plain float64, exactly, in bounded
# float64 and in balls.

TINY, HUGE, THIRD = Fraction(1, 10**300), Fraction(10**300), Fraction(1, 3)
FLIGHT = 1000  # periods that plain floats are followed for where a case counts impacts


@dataclass(frozen=True)
class ExactStart:
    """An exact start, followed for `steps` periods (or impacts); exact numbers have at most
    `most_bits` bits.
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


class ArithmeticFinding(NamedTuple):
    """The results of each arithmetic: the last state in plain floats, the period at which they
    first took a wrong branch (None: nowhere), and the rows of exact, fast and enclosed.
    """

    case: ExactStart
    floats: tuple[float, float]
    wrong_at: int | None
    exact: OrbitRow
    fast: OrbitRow
    enclosed: OrbitRow
    edges: int  # states proved to lie on x = w


def _case(
    name: str,
    alpha: Fraction | str,
    x: Fraction | str,
    w: Fraction | str,
    steps: int,
    impacts: bool = False,
    most_bits: int | None = None,
) -> ExactStart:
    return ExactStart(name, Fraction(alpha), Fraction(x), Fraction(w), steps, impacts, most_bits)


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


def plain_floats(case: ExactStart, most: int = 10**5) -> tuple[tuple[float, float], int | None]:
    """The last state of the orbit in plain float64, followed for at most `most` periods, and the
    first period whose branch is not that of the exact orbit.

    Floats are followed without regard to their error: alpha and start are rounded, a state strikes
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


def _branches(case: ExactStart) -> Iterator[bool]:
    """Whether each period of the exact orbit has an impact."""
    x, w = case.x, case.w
    while True:
        struck = strikes(x, w)
        yield struck
        x, w = impact(case.alpha, x, w) if struck else flight(x, w, 1)
        if max(x.denominator, w.denominator).bit_length() > 5000:
            return


def finding(case: ExactStart) -> ArithmeticFinding:
    """The case in plain floats and in three arithmetics."""
    floats, wrong = plain_floats(case)
    balls = orbit(case.scene, "enclosed", case.steps, impacts=case.impacts)
    return ArithmeticFinding(
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
