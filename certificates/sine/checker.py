"""The second checker: a ball on a table that moves as a sine, over a box of parameters.

It uses the standard library and the first checker's meter of work alone, integers and fractions
only, and believes no certificate.  Units: time in periods of the table, heights in g times the
square of a period; the phase is 0 at the period-one bounce.  Parameters: alpha in [0, 1), g > 0.

    height    P(x) = (c sin 2 pi x + g cos 2 pi x)/(2 pi),     c = (1 - alpha)/(2 (1 + alpha))
    velocity  v(x) = c cos 2 pi x - g sin 2 pi x,   drive  Gamma = 2 pi sqrt(c^2 + g^2)
    S(x) = 2 pi (c sin 2 pi x + g cos 2 pi x):  where S > 1 the table falls faster than the ball

A state is an impact: a phase x, and a closing speed s >= 0.  The ball leaves with the velocity
u = v(x) + alpha s, and F(x1) = P(x) - P(x1) + u (x1 - x) - (x1 - x)^2/2 is its height above the
table.  The next impact is the first zero x1 > x of F, with s1 = (x1 - x) + v(x1) - u >= 0.

**Theorem**, for each box that is certified.  For all alpha and g in the box, every motion that
starts on or above the table tends to the period-one bounce x = 0, s = 1/(1 + alpha), whose flights
take one period, and which is a stable fixed point of the map from impact to impact.

A statement is this theorem for a rectangle of pairs; it is refuted by one pair where a motion tends
elsewhere, or where the bounce is not stable.  Or it says, for each pair of the rectangle, that the
bounce is stable and at least a stated share of the impacts below a closing speed tends to it: the
share of the area of all (x, s) with 0 <= x < 1 and 0 <= s < that speed; it is refuted by one pair
where the bounce is not stable.

A motion is a sequence of flights and impacts.  Where impacts accumulate, or where s = 0 and
S <= 1, or where alpha = 0 and S <= 1, the ball rests on the table; it leaves where S rises through
1, as the state s = 0 there.  A touch with s = 0 in flight may count as an impact or not: both are
covered.  The rules, each with its proof: `absorbing_strip`, `Flights` (flight enclosure),
`check_rest_arc`, `check_cells` (descent of a rank), `check_trap`, `check_cover`.
"""

from __future__ import annotations

import binascii
import json
import os
import re
import sys
import zlib
from base64 import b64decode
from collections.abc import Sequence
from fractions import Fraction
from math import isqrt
from typing import Any, NamedTuple, TypeGuard

from ..checker import MAX_STATEMENTS, Rejected, Work, load
from .cells import Attraction, Certificate, check_box
from .flights import (
    MAX_CELLS,
    MAX_STEPS,
    ONE,
    PI2,
    SLACK,
    Flights,
    Grid,
    Interval,
    Refused,
    Walk,
    require,
)

# ------------------------------------------------------------ refutations


class Counterexample(NamedTuple):
    """What a line that refutes says: alpha, an interval of g on all of which the theorem fails, and
    why; columns and per_unit are the grid of a saddle's cell.
    """

    refutes: str  # saddle or multiplier
    alpha: Fraction
    g: Interval
    columns: int
    per_unit: int


def check_multiplier(one: Counterexample) -> None:
    """For this alpha and each g the bounce is unstable: a multiplier is below -1.

    At x = 0 the matrix of `check_trap` has determinant alpha^2 and trace
    1 + alpha^2 - (1 + alpha)^2 G, G = 2 pi g: its characteristic polynomial at -1 is
    2 (1 + alpha^2) - (1 + alpha)^2 G, and below 0 where one root is below -1.  The other is then
    within (-1, 0]: near the bounce, what does not start on one curve leaves.
    """
    require(0 <= one.alpha < 1 and 0 < one.g[0] <= one.g[1], "alpha or g is out of range")
    beyond = (1 + one.alpha) ** 2 * Fraction(PI2, ONE) * one.g[0] > 2 * (1 + one.alpha**2)
    require(beyond, "no multiplier is below -1")


def check_saddle(one: Counterexample, work: Work) -> tuple[int, int]:
    """For this alpha and each g a second orbit of period one exists, which is not the bounce.

    The other solution of c cos 2 pi x - g sin 2 pi x = c, with s = 1/(1 + alpha), has F = 0 one
    period later.  It is a motion where F > 0 up to then: flights from its cell land but in columns
    next to each other, with s1 > 0, among which is the cell's own one period later: F falls in all
    of these, and vanishes there once.  No landing up to there is above the rows, as its
    s1 <= 1 + 2 rho < 4.  Returned: the column and the row of the cell.
    """
    require(0 < one.alpha, "a ball with alpha = 0 may rest")
    alpha = one.alpha, one.alpha
    flights = Flights(Grid(alpha, one.g, one.columns, one.per_unit, 4 * one.per_unit), work)
    # v passes c twice a period, at 0 and at the saddle, between a half and a whole period
    home, margin = flights.velocity[0], flights.g_half + SLACK
    half = one.columns // 2
    above = [i for i in range(half, one.columns - 1) if flights.velocity[2 * i] < home - margin]
    i = above[-1] if above else 0
    crosses = above and flights.velocity[2 * i + 2] > home + margin
    require(crosses, "the saddle is not within one column of this grid")
    row = one.per_unit * one.alpha.denominator // (one.alpha.denominator + one.alpha.numerator)
    landings = Walk(flights, i).landings(row, i)
    require(landings, "a cell without a landing")
    places = [m for m, _, _ in landings]
    require(places == list(range(places[0], places[-1] + 1)), "it may land in two places")
    require(i + one.columns <= places[-1], "it does not land one period later")
    require(all(lowest > 0 for _, lowest, _ in landings), "it may touch the table before")
    return i, row


# ------------------------------------------------------------ statements

Box = tuple[Interval, Interval]  # of alpha, of g
Proved = Attraction | Counterexample  # by a line of certificates


class Rectangle(NamedTuple):
    """What one line of statements says: the theorem for alpha and Gamma, or g, in two intervals; or
    of the impacts below a closing speed, at least which share tends to the bounce.
    """

    text: str
    alpha: Interval
    drive: str  # Gamma or g
    values: Interval
    basin: tuple[Fraction, Fraction] | None = None  # share, closing speed


def serves(one: Proved, rectangle: Rectangle) -> TypeGuard[Attraction]:
    """Whether what is proved is what a statement says, of the pairs of a box."""
    if isinstance(one, Counterexample):
        return False
    if rectangle.basin is None:
        return one.everywhere()
    share, speed = rectangle.basin
    return one.share_below(speed) >= share


def g_at(alpha: Fraction, gamma: Fraction, up: bool) -> Fraction:
    """A bound of g, from below or above, where g^2 = (Gamma/(2 pi))^2 - c^2; 0 from below where
    this is negative.
    """
    c = (1 - alpha) / (2 * (1 + alpha))
    square = (gamma * ONE / (PI2 + (0 if up else 1))) ** 2 - c * c
    root = isqrt(max(0, square.numerator * ONE * ONE // square.denominator))
    return Fraction(root + up, ONE)


def check_cover(rectangle: Rectangle, boxes: list[Box], work: Work, cuts: int = 12) -> None:
    """Every pair of the rectangle lies in one of the boxes of (alpha, g).

    On an interval of alpha, g is between its values at two corners, as it grows with alpha and
    Gamma.  Where boxes over the whole interval leave no gap there, the interval is covered; else it
    is cut where a box ends, or, `cuts` times at most, in the middle.
    """
    work.spend(6 * len(boxes) + 20)
    low, high = rectangle.alpha
    g_low, g_high = rectangle.values
    if rectangle.drive == "Gamma":
        g_low, g_high = g_at(low, g_low, up=False), g_at(high, g_high, up=True)
        require(g_low > 0, "Gamma is below the birth of the bounce, pi (1 - alpha)/(1 + alpha)")
    reached = None
    for (a_low, a_high), (b_low, b_high) in sorted(boxes, key=lambda box: box[1]):
        if not (a_low <= low and high <= a_high and g_low <= b_high):
            continue  # elsewhere, or all below
        if b_low <= (g_low if reached is None else reached):
            reached = b_high if reached is None else max(reached, b_high)
    if reached is not None and reached >= g_high:
        return
    ends = sorted({end for alpha, _ in boxes for end in alpha if low < end < high})
    require(ends or (cuts and low < high), "the boxes do not cover the rectangle")
    middle = ends[len(ends) // 2] if ends else (low + high) / 2
    for part in (low, middle), (middle, high):
        check_cover(rectangle._replace(alpha=part), boxes, work, cuts - (not ends))


def meets(one: Counterexample, rectangle: Rectangle) -> bool:
    """Whether a pair where the statement fails is surely one of the rectangle."""
    if rectangle.basin and one.refutes != "multiplier":
        return False
    low, high = rectangle.values
    if rectangle.drive == "Gamma":
        low, high = g_at(one.alpha, low, up=True), g_at(one.alpha, high, up=False)
    inside = rectangle.alpha[0] <= one.alpha <= rectangle.alpha[1]
    return inside and one.g[0] <= high and low <= one.g[1]


# ------------------------------------------------------------ files

STATEMENTS, CERTIFICATES = "statements.txt", "certificates.jsonl"
# For all lines and statements of a folder: the wide cover beside this file takes 28 million, and
# its dearest line 227 thousand.  The files of tests/certificates/sine/test_work.py take no longer
# for a step than it does.
MAX_FOLDER_STEPS = 1 << 26
MAX_REFUSED = 1000  # lines of certificates, after which no more are read
NUMBER = r"([0-9]{1,30}(?:/[1-9][0-9]{0,29})?)"
STATEMENT = re.compile(
    "the period-one bounce is stable and (?:every motion tends"
    rf"|at least {NUMBER} of the impacts with closing speed below {NUMBER} tend) to it for all"
    rf" alpha in \[{NUMBER}, {NUMBER}\] and (Gamma|g) in \[{NUMBER}, {NUMBER}\]"
)


def read_statement(line: str) -> Rectangle:
    """The rectangle of a line of statements."""
    match = STATEMENT.fullmatch(line)
    require(match, "not a statement")
    share, speed, a_low, a_high, drive, low, high = match.groups() if match else ("",) * 7
    alpha, values = (Fraction(a_low), Fraction(a_high)), (Fraction(low), Fraction(high))
    require(alpha[0] <= alpha[1] < 1, "alpha is not an interval within 0 <= alpha < 1")
    require(0 < values[0] <= values[1], f"{drive} is not an interval above 0")
    if share is None:
        return Rectangle(line, alpha, drive, values)
    basin = Fraction(share), Fraction(speed)
    require(0 < basin[0] <= 1 and 0 < basin[1], "no share, or no closing speed, above 0")
    return Rectangle(line, alpha, drive, values, basin)


def rational(text: object) -> Fraction:
    """The number of a text such as 3/50."""
    require(isinstance(text, str) and re.fullmatch(NUMBER, text), "not an exact number")
    return Fraction(str(text))


def whole(value: object) -> int:
    """A whole number, neither a truth value nor a float."""
    require(type(value) is int and abs(value) < 1 << 40, "not a whole number")
    return value if isinstance(value, int) else 0


def listed(value: object) -> list[object]:
    """A list: neither a text nor an object, whose letters or keys could be read one by one."""
    require(isinstance(value, list), "not a list")
    return value if isinstance(value, list) else []


def unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
    require(len(dict(pairs)) == len(pairs), "a key stands twice")
    return dict(pairs)


def read_line(line: str) -> Certificate | Counterexample:
    """What a line of certificates says; ranks are compressed by zlib, as base64."""
    try:
        data: Any = json.loads(line, object_pairs_hook=unique)
    except (ValueError, RecursionError):
        data = None
    require(isinstance(data, dict), "not a line of certificates")
    keys = sorted(data)
    if keys == ["alpha", "g", "grid", "refutes"]:
        require(data["refutes"] in ("saddle", "multiplier"), "an unknown kind of refutation")
        columns, per_unit = map(whole, listed(data["grid"]))
        g_low, g_high = map(rational, listed(data["g"]))
        alpha = rational(data["alpha"])
        return Counterexample(data["refutes"], alpha, (g_low, g_high), columns, per_unit)
    require(keys == ["alpha", "arc", "g", "grid", "ranks", "trap"], "not a line of certificates")
    a_low, a_high = map(rational, listed(data["alpha"]))
    g_low, g_high = map(rational, listed(data["g"]))
    columns, per_unit, rows = map(whole, listed(data["grid"]))
    *sides, weight = listed(data["trap"])
    width, low, high = map(whole, sides)
    start, end = map(whole, listed(data["arc"]))
    packed = b64decode(data["ranks"], validate=True)
    ranks = zlib.decompressobj().decompress(packed, MAX_CELLS + 1)
    require(len(ranks) <= MAX_CELLS, "too many cells")
    grid = Grid((a_low, a_high), (g_low, g_high), columns, per_unit, rows)
    return Certificate(grid, width, low, high, rational(weight), (start, end), ranks)


def check_line(line: str, work: Work | None = None) -> tuple[Proved | None, str]:
    """(what the line proves, ""), or (None, why it proves nothing)."""
    work = work or Work(MAX_STEPS)
    try:
        work.spend(10 + len(line) // 4)  # zlib makes a thousand letters of one at most
        read = read_line(line)
        if isinstance(read, Certificate):
            return check_box(read, work), ""
        if read.refutes == "saddle":
            check_saddle(read, work)
        else:
            check_multiplier(read)
        return read, ""
    except (Refused, Rejected) as reason:
        return None, str(reason)
    except (ValueError, TypeError, zlib.error, binascii.Error) as error:
        return None, f"malformed ({type(error).__name__})"


def outcome(
    rectangle: Rectangle, proved: Sequence[Proved], work: Work | None = None
) -> tuple[str, str]:
    """(certified, refuted or unknown; why it is unknown), by what the lines prove."""
    work = work or Work(MAX_STEPS)
    try:
        # of a basin, the shares of rows are added up
        rows = sum(len(one.shares) for one in proved if isinstance(one, Attraction))
        work.spend(10 + 10 * len(proved) + rows)
        boxes = [(one.alpha, one.g) for one in proved if serves(one, rectangle)]
        if any(isinstance(one, Counterexample) and meets(one, rectangle) for one in proved):
            return "refuted", ""
        check_cover(rectangle, boxes, work)
    except (Refused, Rejected) as reason:
        return "unknown", str(reason)
    return "certified", ""


def check_folder(folder: str, left: int = MAX_FOLDER_STEPS) -> list[tuple[str, str, str]]:
    """[(statement or line, outcome, reason)]: each line of certificates that is rejected, and each
    statement, certified, refuted or unknown; `left`: the steps that may be spent on all of them.
    """
    lines = load(os.path.join(folder, STATEMENTS), MAX_STATEMENTS).splitlines()
    rectangles = [read_statement(line) for line in lines]
    proved: list[Proved] = []
    results = []
    for number, line in enumerate(load(os.path.join(folder, CERTIFICATES)).splitlines(), 1):
        limit = min(MAX_STEPS, left)
        work = Work(limit)
        proves, why = check_line(line, work)
        left -= limit - work.left
        if proves:
            proved.append(proves)
        else:
            results.append((f"{CERTIFICATES}, line {number}", "rejected", why))
        if len(results) > MAX_REFUSED:
            break  # what is not read certifies nothing
    rest = Work(left)
    return results + [(one.text, *outcome(one, proved, rest)) for one in rectangles]


def main(arguments: list[str]) -> int:
    """Checks the folder named, or the store beside this file; the exit code is 0 where every
    statement is certified or refuted and no line rejected, 1 else, 2 for unusable input.
    """
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), "store")
    try:
        require(len(arguments) < 2, "name one folder")
        results = check_folder(arguments[0] if arguments else beside)
    except (Refused, Rejected) as reason:
        print("checker:", ascii(str(reason))[1:-1], file=sys.stderr)
        return 2
    for name, word, why in results:
        print(f"{word:10}{name}" + (f": {why}" if why else ""))
    return int(not results or any(word in ("unknown", "rejected") for _, word, _ in results))
