"""`juggleproof certify sine`: the table that moves as a sine, over a rectangle of parameters."""

from __future__ import annotations

import argparse
import math
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from fractions import Fraction
from importlib import import_module
from pathlib import Path

import numpy as np

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine.cells import UNRANKED, Attraction, Level, read_levels
from juggleproof.certificates.sine.checker import (
    Box,
    Counterexample,
    Rectangle,
    check_line,
    check_saddle,
    g_at,
    read_statement,
)
from juggleproof.certificates.sine.flights import MAX_STEPS, ONE, PI2, Interval, Refused
from juggleproof.command.outputs import fault_of, fault_of_folder, now_and_then
from juggleproof.judging.conclusions import STABLE
from juggleproof.judging.extras import needed
from juggleproof.reports.tables import exact
from juggleproof.scenes import table
from juggleproof.scenes.table.curves import birth, g_of
from juggleproof.sine.cover import BASIN, EVERY, Covered, cover
from juggleproof.sine.search import find_certificate, line_of
from juggleproof.sine.stored import WIDE, boxes_in, wide_rectangles
from juggleproof.statements.language import ClaimError
from juggleproof.statements.processes import own_pool
from juggleproof.statements.store import write_file

NAME = "sine"
STORE = Path("sine.certificates")
GRAVITY = Fraction("9.80665")
SHOWN = 10  # printed boxes without a certificate
FASTEST = 4  # the greatest closing speed of --basin
SIMULATED = 60, 80  # numbers of speeds and of phases of the simulated impacts
GRID = 256, 16  # the grid of a certificate that is drawn
SEEN = 2  # drawn cells are cut at most this often
CLOSE = Fraction(1, 10**6)  # half the width in g of a certificate that is drawn


class SineOptions(argparse.Namespace):
    """The options of `juggleproof certify sine`; 0 and None stand for the default."""

    alpha: str | None
    gamma: str | None
    frequency: str | None
    amplitude: str | None
    jobs: int
    budget: int
    executor: str | None
    store: Path | None
    picture: Path | None
    basin: str | None = None


def command(parsed: argparse.Namespace) -> int:
    """Certifies or refutes the theorem on a rectangle; returns the exit code."""
    return certify(SineOptions(**vars(parsed)))


NOT_FOR_SINE = (
    "only",
    "accept",
    "rederive",
    "json",
    "junit",
    "markdown",
    "timings",
    "report",
    "output",
    "fresh",
    "revote",
)


def certify(options: SineOptions) -> int:
    """Covers the rectangle by boxes and prints what is proved; returns 0 where all of it is
    certified, 1 where it is refuted or boxes are left.  Raises ClaimError, one line, for unusable
    input.
    """
    for option in NOT_FOR_SINE:
        if getattr(options, option):
            raise ClaimError(f"--{option}: not for sine; leave it out")
    if options.picture is not None:
        needed("matplotlib", "picture")
        if fault := fault_of(options.picture):
            raise ClaimError(f"--picture {options.picture}: {fault}; name another file")
        if options.basin:
            raise ClaimError("--picture: not with --basin; leave it out")
    rectangles = [rectangle_of(options)] if asked(options) else wide_rectangles()
    folder, tell = options.store or STORE, now_and_then()
    if fault := fault_of_folder(folder):
        raise ClaimError(f"--store {folder}: {fault}; name another folder")
    found = []
    with _executor(options, rectangles) as executor:
        several = cover(
            rectangles,
            folder,
            executor,
            options.budget or None,
            lambda done, known: tell(f"{done} of {known} boxes tried"),
        )
        for covered in several:
            found.append(covered)
            for line in covered.rejected:
                print(f"rejected by the checker: {line}")
            print(f"{covered.outcome}: {told(covered)}")
            if options.frequency and covered.outcome == "certified":
                print(
                    f"which holds all tables of {options.frequency} Hz with an amplitude of"
                    f" {options.amplitude} mm, under 9.80665 m/s^2"
                )
            for line in explained(covered):
                print(line)
            for line in simulated(covered):
                print(line)
    print(f"the checker alone reads it: python -I -S certificates/sine {folder}")
    if options.picture is not None:
        write_file(options.picture, picture_of(rectangles, found))
        print(f"wrote {options.picture}")
    return int(any(covered.outcome != "certified" for covered in found))


def asked(options: SineOptions) -> bool:
    """Whether the options give a rectangle; without one, those of the wide cover are certified."""
    given = (
        options.alpha,
        options.gamma,
        options.frequency,
        options.amplitude,
        options.basin,
    )
    return any(one is not None for one in given)


def rectangle_of(options: SineOptions) -> Rectangle:
    """The rectangle of the options; raises ClaimError, one line, where they give none."""
    try:
        rectangle = read_statement(statement_of(options.alpha, drive_of(options)))
    except Refused as reason:  # numbers that are too long for a statement
        raise ClaimError(f"certify sine: {reason}; choose shorter numbers") from None
    low = rectangle.values[0]
    if not g_at(rectangle.alpha[0], low, up=False):
        raise ClaimError(
            f"Gamma = {low}: below pi (1 - alpha)/(1 + alpha) at alpha = {rectangle.alpha[0]} no"
            " bounce of one period exists; begin higher"
        )
    if options.basin is None:
        return rectangle
    speed, _ = interval(options.basin, "--basin")
    if not 0 < speed <= FASTEST or ":" in options.basin:
        raise ClaimError(f"--basin {options.basin[:40]}: give a closing speed up to {FASTEST}")
    return rectangle._replace(basin=(Fraction(0), speed))


def drive_of(options: SineOptions) -> str | None:
    """Gamma as FROM:TO, from --gamma, or from frequency and amplitude: 4 pi^2 f^2 A/g with
    g = 9.80665 m/s^2, rounded outward to 1/10000.
    """
    pair = options.frequency, options.amplitude
    if None not in pair and options.gamma is None:
        hertz, metres = interval(str(pair[0]), "--frequency"), interval(str(pair[1]), "--amplitude")
        turns = Fraction(PI2, ONE), Fraction(PI2 + 1, ONE)
        low, high = (
            (turn * f) ** 2 * a / 1000 / GRAVITY for turn, f, a in zip(turns, hertz, metres)
        )
        return f"{int(low * 10**4)}/10000:{-int(-high * 10**4 // 1)}/10000"
    if pair != (None, None):
        raise ClaimError("certify sine: --frequency and --amplitude go together, without --gamma")
    return options.gamma


def statement_of(alpha: str | None, gamma: str | None) -> str:
    """The statement for alpha and Gamma between ends that are written A0:A1, or A.

    >>> statement_of("0.04:0.06", "3.1")[-57:]
    'for all alpha in [1/25, 3/50] and Gamma in [31/10, 31/10]'
    """
    if alpha is None or gamma is None:
        raise ClaimError(
            "certify sine: needs --alpha A0:A1, and --gamma G0:G1 or --frequency and --amplitude;"
            " or none of them, for the wide cover"
        )
    (a_low, a_high), (low, high) = interval(alpha, "--alpha"), interval(gamma, "--gamma")
    if a_high >= 1:
        raise ClaimError(f"--alpha {alpha}: restitution is at least 0 and below 1")
    if not low:
        raise ClaimError(f"--gamma {gamma}: a table at rest drives nothing; begin above 0")
    return (
        f"the period-one bounce is {STABLE} and {EVERY} to it for all"
        f" alpha in [{a_low}, {a_high}] and Gamma in [{low}, {high}]"
    )


def interval(text: str, option: str) -> Interval:
    """The exact ends of an interval that is written A0:A1, or A."""
    try:
        ends = [exact(end, option) for end in text.split(":")]
    except ClaimError:
        ends = []
    if not 0 < len(ends) < 3 or min(ends) < 0:
        raise ClaimError(f"{option} {text[:40]}: no interval; write it as 0.04:0.06, or 1/20")
    low, high = ends[0], ends[-1]
    if low > high:
        raise ClaimError(
            f"{option} {text}: begins above its end; write {':'.join(text.split(':')[::-1])}"
        )
    return low, high


def picture_of(rectangles: Sequence[Rectangle], found: Sequence[Covered]) -> bytes:
    """The boxes, with the curves between which the theorem may hold, as SVG."""
    picture = needed("juggleproof.scenes.table.cover", "picture")
    asked_for = [(in_floats(one.alpha), one.drive, in_floats(one.values)) for one in rectangles]
    certified, left = (
        sorted({(in_floats(alpha), in_floats(g)) for boxes in several for alpha, g in boxes})
        for several in zip(*((covered.boxes, covered.left) for covered in found))
    )
    drawn: bytes = picture.cover(asked_for, certified, left)
    return drawn


def in_floats(ends: Interval) -> tuple[float, float]:
    """The ends of an interval as floats."""
    return float(ends[0]), float(ends[1])


def told(covered: Covered) -> str:
    """The sentence that the verdict is about."""
    text, basin = covered.rectangle.text, covered.rectangle.basin
    if basin is None or basin[0]:
        return text
    if covered.outcome == "refuted":
        return text.replace(f" and {EVERY} to it", "")
    return text.replace(EVERY, f"a share of the impacts with closing speed below {basin[1]} tends")


def simulated(covered: Covered) -> Iterator[str]:
    """A line with the certified share of impacts, and the simulated share at the middle of the
    rectangle; no line where no share is certified.
    """
    rectangle = covered.rectangle
    if not (rectangle.basin and rectangle.basin[0]):
        return
    share, speed = map(float, rectangle.basin)
    alpha, value = (sum(in_floats(ends)) / 2 for ends in (rectangle.alpha, rectangle.values))
    counts = table.flights_by_state(table.Table(alpha, value), speed, *SIMULATED)
    there = ((counts >= 0) & (counts <= table.MOST)).mean()
    yield (
        f"certified: {share:.2%} of these impacts; simulated, at alpha = {alpha:g} and"
        f" Gamma = {value:g}: {there:.2%} of {counts.size:,}"
    )


def explained(covered: Covered) -> Iterator[str]:
    """The lines that explain the verdict: why it is refuted, or the numbers of cells and boxes."""
    if covered.counterexample is not None:
        yield why_refuted(covered.counterexample)
        return
    yield f"{covered.cells:,} cells were looked at; boxes with a certificate: {len(covered.boxes)}"
    if covered.left:
        yield f"boxes that are left: {len(covered.left)}"
    for one in covered.left[:SHOWN]:
        yield "  " + in_words(one)
    if len(covered.left) > SHOWN:
        yield f"  and {len(covered.left) - SHOWN} more"


def in_words(box: Box) -> str:
    """The text of a box of alpha and g, in decimals."""
    alpha, g = map(in_floats, box)
    return f"alpha {alpha[0]:.6f} to {alpha[1]:.6f}, g {g[0]:.6f} to {g[1]:.6f}"


def why_refuted(one: Counterexample) -> str:
    """The reason why the theorem fails at a pair of parameters."""
    at = f"at alpha = {one.alpha}, g = {float(one.g[0]):.6f}"
    if one.refutes == "multiplier":
        return f"{at} the bounce is unstable: one of its multipliers is below -1"
    column, row = check_saddle(one, Work(MAX_STEPS))
    return (
        f"{at} a second orbit of period one exists: from a phase between {column}/{one.columns}"
        f" and {column + 1}/{one.columns}, with the closing speed 1/(1 + alpha), the ball lands"
        " there again one period later; the phase of the bounce is 0"
    )


@contextmanager
def _executor(options: SineOptions, rectangles: Sequence[Rectangle]) -> Iterator[Executor | None]:
    """The executor of the options: a Dask cluster, a pool of processes, or None for a single job,
    such as a rectangle that is a point.
    """
    if options.executor:
        try:
            distributed = import_module("distributed")
        except ImportError:
            raise ClaimError("--executor: needs the extra `peers`, for Dask") from None
        try:
            client = distributed.Client(options.executor, timeout=10)
        except (OSError, ValueError, TypeError) as error:
            raise ClaimError(
                f"--executor {options.executor}: no Dask cluster answers ({type(error).__name__})"
            ) from None
        with client:
            yield client.get_executor()
        return
    jobs = options.jobs or os.cpu_count() or 1
    point = all(low == high for one in rectangles for low, high in (one.alpha, one.values))
    if jobs == 1 or point:
        yield None
        return
    with own_pool(jobs) as pool:
        yield pool


# -------------------------------------------------------------------------------------------------
# Certificates in the pictures of the simulation.


def wide_boxes() -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """The boxes of the wide cover as floats, for pictures; `python -I -S certificates/sine` reads
    their certificates.
    """
    return sorted((in_floats(one.alpha), in_floats(one.g)) for one in boxes_in(WIDE))


def certified_for(restitution: float, drive: float) -> tuple[Fraction, np.ndarray, Fraction] | None:
    """(top, ranks, share) of a certificate for alpha and Gamma, for a picture: it is about closing
    speeds below top; ranks are those of cells; share is the share of states with a rank.  None
    where no certificate is found, which proves nothing.
    """
    if not drive > birth(restitution) or not math.isfinite(drive):
        return None
    alpha = Fraction(str(restitution))
    middle = Fraction(round(g_of(restitution, drive) * 10**9), 10**9)
    between: Interval = (middle - CLOSE, middle + CLOSE)
    for basin in (0, BASIN):
        found = find_certificate((alpha, alpha), between, *GRID, basin).certificate
        proved = found and check_line(line_of(found))[0]
        if found and isinstance(proved, Attraction):  # certified only if the checker accepts it
            top = Fraction(found.grid.rows, found.grid.per_unit)
            return top, ranks_of(read_levels(found, Work(MAX_STEPS))), proved.share_below(top)
    return None


def ranks_of(levels: Sequence[Level]) -> np.ndarray:
    """The ranks of cells that are cut at most `SEEN` times, shape (rows, columns).  A cell that is
    cut further has the greatest rank of its parts; -1 stands for no rank.
    """
    shown = min(SEEN, len(levels) - 1)
    grid = levels[shown].grid
    ranks = np.zeros((grid.rows, grid.columns), dtype=np.int64)
    for number, level in enumerate(levels[: shown + 1]):
        wide = 2 ** (shown - number)
        for i, column in level.ranks.items():
            ranks[:, i * wide : (i + 1) * wide] = np.repeat(list(column), wide)[:, None]
    return np.where(ranks < UNRANKED, ranks, -1)
