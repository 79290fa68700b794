"""Orbits as tables: rows of text in either system of units, CSV, and arrays of floats with
bounds.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from fractions import Fraction
from math import inf, nextafter
from typing import Any, BinaryIO

import numpy as np
from flint import arb, ctx

from scenes.errors import SceneError
from scenes.juggler.bounded import Bounded
from scenes.juggler.exact import lifted
from scenes.juggler.fast import CHUNK, ENDS
from scenes.juggler.formulas import formulas
from scenes.juggler.given import brief, nearest
from scenes.juggler.orbits import Orbits, Row

UNITS = ("normal", "physical")
NAMES = {"normal": ("x", "w"), "physical": ("beta", "v")}
LONG_BITS, DIGITS = 4000, 40  # exact numbers beyond are written as balls of so many digits


def checked_units(units: str) -> str:
    """The name of the units; SceneError where there are none of that name."""
    if units not in UNITS:
        raise SceneError(f"units = {brief(units)!r} is not one of {', '.join(UNITS)}")
    return units


def in_units(orbits: Orbits, row: Row, units: str) -> Row:
    """The row in the wanted units: x and w, or beta and v of the paper."""
    if checked_units(units) == "normal":
        return row
    r, g, unscaled = orbits.scene.r, orbits.scene.g, formulas().unscaled
    if isinstance(row.x, Fraction):
        return row._replace(x=unscaled(row.x, row.w, r, g)[0], w=unscaled(row.x, row.w, r, g)[1])
    if orbits.arithmetic == "fast":
        bounds = row.error or (inf, inf)
        found = unscaled(
            *(Bounded(np.float64(v), np.float64(e)) for v, e in zip((row.x, row.w), bounds)),
            Bounded.of(r),
            Bounded.of(g),
        )
        return row._replace(
            x=float(found[0].v), w=float(found[1].v), error=(float(found[0].e), float(found[1].e))
        )
    if orbits.arithmetic == "enclosed":
        with ctx.workprec(max(row.x.bits(), row.w.bits(), 128) + 64):
            found = unscaled(row.x, row.w, arb(lifted(r)), arb(lifted(g)))
        from scenes.juggler.enclosed import radius_of

        return row._replace(
            x=found[0], w=found[1], error=(radius_of(found[0]), radius_of(found[1]))
        )
    mpf = row.x.context.mpf
    found = unscaled(row.x, row.w, *(mpf(one.numerator) / one.denominator for one in (r, g)))
    return row._replace(x=found[0], w=found[1])


def written(value: Any, error: Any, digits: int = DIGITS) -> tuple[str, str]:
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


def _ball(ball: Any, digits: int) -> tuple[str, str]:
    """Midpoint and radius of decimals that enclose the ball."""
    text = ball.str(digits).strip("[]")
    middle, _, radius = text.partition(" +/- ")
    return (
        ("0", middle.removeprefix("+/- ")) if middle.startswith("+/-") else (middle, radius or "0")
    )


def rows(orbits: Orbits) -> Iterator[Row]:
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
        told = in_units(orbits, row, units)
        error = told.error or (None, None)
        # In a history of fast arithmetic only one of the two is counted.
        counts = ["" if count < 0 else count for count in (told.periods, told.impacts)]
        table.writerow(
            [told.start, *counts, *written(told.x, error[0]), *written(told.w, error[1]), told.end]
        )
    text.detach()


def _as_float(value: Any, error: Any) -> tuple[float, float]:
    """The float next to a number, and a bound on how far the true number is from it; nan where none
    is known.
    """
    if isinstance(value, float):
        return value, error
    if isinstance(value, Fraction):
        return nearest(value)
    if isinstance(value, arb):
        middle = value.mid().fmpq()
        found, missed = nearest(Fraction(int(middle.p), int(middle.q)))
        return found, nextafter(nextafter(nearest(error)[0], inf) + missed, inf)
    return float(value), float("nan")


def as_arrays(orbits: Orbits, units: str = "normal") -> dict[str, Any]:
    """Arrays of one entry a row: start, periods, impacts, the state and bounds on its error as
    float64, end as its place in ENDS.

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
    told = [in_units(orbits, row, units) for row in rows(orbits)]
    pairs = [
        [_as_float(value, error) for value, error in zip((row.x, row.w), row.error or (None, None))]
        for row in told
    ]
    found = {
        "start": np.array([row.start for row in told]),
        "end": np.array([ENDS.index(row.end) for row in told], dtype=np.uint8),
    }
    for name, counts in (
        ("periods", [row.periods for row in told]),
        ("impacts", [row.impacts for row in told]),
    ):
        found[name] = (
            np.array(counts)
            if all(count < 2**63 for count in counts)
            else np.array([str(count) for count in counts])
        )
    for place, name in enumerate(names):
        found[name] = np.array([pair[place][0] for pair in pairs], dtype=np.float64)
        found[f"error_{name}"] = np.array([pair[place][1] for pair in pairs], dtype=np.float64)
    return found


def _unscaled(x: Bounded, w: Bounded, r: Bounded, g: Bounded) -> tuple[Bounded, Bounded]:
    """The states in the paper's units, a part at a time, so that what is held in between does not
    grow with their number.
    """
    beta, v = (Bounded(np.empty_like(x.v), np.empty_like(x.v)) for _ in range(2))
    for low in range(0, len(x.v), CHUNK):
        part = slice(low, low + CHUNK)
        with np.errstate(all="ignore"):
            found = formulas().unscaled(x.at(part), w.at(part), r, g)
        beta.put(part, found[0])
        v.put(part, found[1])
    return beta, v


def as_npz(orbits: Orbits, file: BinaryIO, units: str = "normal") -> None:
    """Writes the arrays of `as_arrays`, with alpha, r and g as text, as a compressed file of NumPy;
    `end` counts in `ends`.
    """
    told = {
        "alpha": str(orbits.scene.alpha),
        "r": str(orbits.scene.r),
        "g": str(orbits.scene.g),
        "arithmetic": orbits.arithmetic,
        "units": units,
    }
    np.savez_compressed(
        file, allow_pickle=False, ends=np.array(ENDS), **told, **as_arrays(orbits, units)
    )
