"""Covers a rectangle of parameters by boxes, each with a certificate; not believed.

The rectangle, in alpha and Gamma, is cut into boxes in alpha and g; where a box fails it is cut
across its longer side, until it is too narrow.  The boxes of one round are independent: any
executor may share them.  For a basin, the share is sought that holds on all boxes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeVar

from juggleproof.certificates.checker import Rejected, load
from juggleproof.certificates.sine.cells import Attraction
from juggleproof.certificates.sine.checker import (
    CERTIFICATES,
    STATEMENTS,
    Box,
    Counterexample,
    Proved,
    Rectangle,
    check_line,
    g_at,
    meets,
    outcome,
    serves,
)
from juggleproof.certificates.sine.flights import Interval
from juggleproof.sine.search import ONCE, Found, find_certificate, line_of
from juggleproof.statements.language import ClaimError
from juggleproof.statements.processes import spread
from juggleproof.statements.store import write_file

START = Fraction(1, 200), Fraction(1, 50)  # the widths of the boxes that are tried first
LEAST = Fraction(1, 4000)  # a box no wider than this is not cut
GRIDS = (256, 16), (512, 32)  # columns, and rows of a unit of speed
NARROW = Fraction(1, 1000)  # boxes no wider than this are tried on all of these grids
CELLS = 6_000  # that a box takes, about
SADDLE = 2048, 128  # the grid on which a saddle is looked for
BUDGET = 20_000_000  # cells
BASIN = 20_000  # cells of a box where a share of the impacts is asked for
EVERY = "every motion tends"

Item = TypeVar("Item")
Result = TypeVar("Result")


class Tried(NamedTuple):
    """line: the certificate of a box, or "" if there is none; proved: what it proves by the
    checker; cells: how many the search looked at.
    """

    box: Box
    line: str
    proved: Proved | None
    cells: int


class Covered(NamedTuple):
    """rectangle: what is stated of it, for a basin with the share; outcome: certified, refuted or
    unknown; boxes: those with a certificate; left: those without one; cells: how many the search
    looked at; rejected: lines of the folder that the checker did not take, with the reason;
    counterexample: for refuted.
    """

    rectangle: Rectangle
    outcome: str
    boxes: list[Box]
    left: list[Box]
    cells: int
    rejected: list[str]
    counterexample: Counterexample | None


Progress = Callable[[int, int], None]
Search = Callable[..., Found]


def cover(
    rectangles: Sequence[Rectangle],
    folder: Path,
    executor: Executor | None = None,
    budget: int | None = None,
    progress: Progress = lambda done, known: None,
) -> Iterator[Covered]:
    """Certifies the theorem on each of the rectangles as far as it can, or refutes it; keeps each
    box in the folder as soon as it is certified, and goes on from those that are there.  Where a
    rectangle asks for a basin, with the share 0, the greatest share is sought.

    budget: cells that the search may look at for a rectangle; progress: is called with the number
    of boxes that are done, and of those that are known.  Raises ClaimError, one line, where the
    folder cannot be used or the executor fails.
    """
    proved, rejected = kept(folder, executor)
    for rectangle in rectangles:
        yield cover_one(rectangle, folder, proved, executor, budget, progress)._replace(
            rejected=rejected
        )
        rejected = []


def cover_one(
    rectangle: Rectangle,
    folder: Path,
    proved: dict[str, Proved],
    executor: Executor | None,
    budget: int | None,
    progress: Progress,
) -> Covered:
    """What `cover` finds for one rectangle; `proved` is what the lines of the folder prove, and new
    lines are added to it.
    """
    counterexample = find_counterexample(rectangle, list(proved.values()))
    if counterexample is not None:
        proved[line_of(counterexample)] = counterexample
        write(folder, stated(rectangle), proved)
        return Covered(rectangle, "refuted", [], [], 0, [], counterexample)
    boxes = first_boxes(rectangle)
    budget = budget or (BASIN * len(boxes) if rectangle.basin else BUDGET)
    left: list[Box] = []
    cells = known = done = 0

    def take(_: int, one: Tried) -> None:
        nonlocal done
        done += 1
        progress(done, known)
        if one.proved:
            proved[one.line] = one.proved
            write(folder, stated(rectangle), proved)

    while boxes and outcome(rectangle, list(proved.values()))[0] != "certified":
        boxes = [box for box in boxes if not within(box, rectangle, proved.values())]
        fits = max(0, budget - cells) // CELLS
        boxes, over = boxes[:fits], boxes[fits:]
        left += over
        known += len(boxes)
        search: Search = find_certificate
        if rectangle.basin and boxes:
            each, top = (budget - cells) // len(boxes), max(ONCE, rectangle.basin[1])
            search = partial(find_certificate, basin=each, top=top)
        tried = shared(partial(try_box, search), boxes, executor, take)
        cells += sum(one.cells for one in tried)
        failed = [one.box for one in tried if not one.proved]
        left += [box for box in failed if width_of(box) <= LEAST]
        wide = [box for box in failed if width_of(box) > LEAST]
        boxes = [half for box in wide for half in halves(rectangle, box)]
    if rectangle.basin:
        rectangle = with_share(rectangle, list(proved.values()))
    write(folder, stated(rectangle), proved)
    word, _ = outcome(rectangle, list(proved.values()))
    proving = [one for one in proved.values() if serves(one, rectangle)]
    return Covered(rectangle, word, sorted(map(box_of, proving)), sorted(left), cells, [], None)


def with_share(rectangle: Rectangle, proved: Sequence[Proved]) -> Rectangle:
    """The statement with the greatest share that holds on all of the rectangle, rounded down; with
    the share 0 where it holds for none.
    """
    _, speed = rectangle.basin or (0, Fraction(1))
    shares = {int(one.share_below(speed) * 10**4) for one in proved if isinstance(one, Attraction)}
    for share in sorted(shares, reverse=True):
        basin = min(Fraction(share, 10**4), Fraction(1)), speed
        one = rectangle._replace(basin=basin)
        if share and outcome(one, proved)[0] == "certified":
            words = f"at least {basin[0]} of the impacts with closing speed below {speed} tend"
            return one._replace(text=rectangle.text.replace(EVERY, words))
    return rectangle


def stated(rectangle: Rectangle) -> list[str]:
    """The rectangle's line of statements, if it states anything."""
    return [rectangle.text] if rectangle.basin is None or rectangle.basin[0] else []


def shared(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    executor: Executor | None,
    done: Callable[[int, Result], None] = lambda place, result: None,
) -> list[Result]:
    """The results of the work on the items, by the executor; raises ClaimError where that fails."""
    try:
        return spread(work, items, executor, done)
    except ClaimError:
        raise
    except Exception as error:
        if executor is None:
            raise
        why = f"{type(error).__name__}: {error}"[:100].partition("\n")[0]
        raise ClaimError(
            f"the executor failed ({why}); certified boxes are kept: run it again"
        ) from None


# ------------------------------------------------------------ files


def kept(folder: Path, executor: Executor | None) -> tuple[dict[str, Proved], list[str]]:
    """({line: what it proves}, what is wrong with the others), for the certificates in a folder."""
    path = folder / CERTIFICATES
    if not path.exists():
        return {}, []
    try:
        lines = load(str(path)).splitlines()
    except Rejected as reason:
        raise ClaimError(f"{path}: {reason}; name another --store") from None
    checked = shared(check_line, lines, executor)
    return (
        {line: one for line, (one, _) in zip(lines, checked) if one is not None},
        [
            f"{path}, line {number}: {reason}"
            for number, (one, reason) in enumerate(checked, 1)
            if one is None
        ],
    )


def write(folder: Path, stated: Iterable[str], proved: dict[str, Proved]) -> None:
    """Writes the certificates, by parameters, and the statements beside those that are there."""
    path = folder / STATEMENTS
    statements = set(stated)
    if path.exists():
        try:
            statements.update(load(str(path)).splitlines())
        except Rejected as reason:
            raise ClaimError(f"{path}: {reason}; name another store") from None
    write_file(path, "".join(f"{line}\n" for line in sorted(statements)).encode())
    lines = sorted(proved, key=lambda line: (box_of(proved[line]), line))
    write_file(folder / CERTIFICATES, "".join(f"{line}\n" for line in lines).encode())


def box_of(one: Proved) -> Box:
    """The box of (alpha, g) of what is proved."""
    if isinstance(one, Attraction):
        return one.alpha, one.g
    return (one.alpha, one.alpha), one.g


# ------------------------------------------------------------ boxes


def within(box: Box, rectangle: Rectangle, proved: Iterable[Proved]) -> bool:
    """Whether boxes that have a certificate of what is stated cover a box."""
    near = [
        one for one in proved if all(a <= d and c <= b for (a, b), (c, d) in zip(box_of(one), box))
    ]
    one = rectangle._replace(alpha=box[0], drive="g", values=box[1])
    return outcome(one, near)[0] == "certified"


def width_of(box: Box) -> Fraction:
    """The length of the longer side."""
    return max(end - start for start, end in box)


def try_box(search: Search, box: Box) -> Tried:
    """Looks for a certificate for a box, and has the checker read it."""
    cells = 0
    for grid in GRIDS if width_of(box) <= NARROW else GRIDS[:1]:
        found = search(*box, *grid)
        cells += found.cells
        line = line_of(found.certificate) if found.certificate else ""
        proved = check_line(line)[0] if line else None
        if proved:
            return Tried(box, line, proved, cells)
    return Tried(box, "", None, cells)


def g_between(rectangle: Rectangle, alpha: Interval) -> Interval:
    """Bounds of g for an interval of alpha within the rectangle."""
    low, high = rectangle.values
    if rectangle.drive == "g":
        return low, high
    low, high = g_at(alpha[0], low, up=False), g_at(alpha[1], high, up=True)
    return Fraction(int(low * 10**6), 10**6), Fraction(-int(-high * 10**6 // 1), 10**6)


def cut(interval: Interval, width: Fraction) -> list[Interval]:
    """The interval in the fewest equal parts no wider than this."""
    low, high = interval
    parts = max(1, -int(-(high - low) / width // 1))
    ends = [low + (high - low) * n / parts for n in range(parts + 1)]
    return list(zip(ends, ends[1:]))


def first_boxes(rectangle: Rectangle) -> list[Box]:
    """Boxes that cover the rectangle."""
    return [
        (alpha, g)
        for alpha in cut(rectangle.alpha, START[0])
        for g in cut(g_between(rectangle, alpha), START[1])
    ]


def halves(rectangle: Rectangle, box: Box) -> Iterator[Box]:
    """Yields the halves of a box cut across its longer side, without those outside the
    rectangle.
    """
    alpha, g = box
    if alpha[1] - alpha[0] > g[1] - g[0]:
        parts = [(half, g) for half in cut(alpha, (alpha[1] - alpha[0]) / 2)]
    else:
        parts = [(alpha, half) for half in cut(g, (g[1] - g[0]) / 2)]
    for one_alpha, one_g in parts:
        low, high = g_between(rectangle, one_alpha)
        low, high = max(low, one_g[0]), min(high, one_g[1])
        if low < high:
            yield one_alpha, (low, high)


# ------------------------------------------------------------ refutations


def find_counterexample(rectangle: Rectangle, proved: Sequence[Proved]) -> Counterexample | None:
    """A pair of the rectangle at which the checker refutes the theorem: one that is known, or one
    of the corners.
    """
    known = [one for one in proved if isinstance(one, Counterexample)]
    corners = [
        Counterexample(why, alpha, g, *SADDLE)
        for alpha in rectangle.alpha
        for g in corner_values(rectangle, alpha)
        for why in ("multiplier", "saddle")
    ]
    for one in known + corners:
        if meets(one, rectangle) and check_line(line_of(one))[0]:
            return one
    return None


def corner_values(rectangle: Rectangle, alpha: Fraction) -> list[Interval]:
    """The least and the greatest g of the rectangle at this alpha, each between bounds."""
    low, high = rectangle.values
    if rectangle.drive == "g":
        return [(low, low), (high, high)]
    return [g_between(rectangle._replace(values=(end, end)), (alpha, alpha)) for end in (low, high)]
