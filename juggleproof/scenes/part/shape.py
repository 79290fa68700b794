"""A convex polygon given by its corners: centre of mass, radius of gyration, the faces on which it
can lie, and the friction from which one of its corners can jam; from exact numbers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TypeAlias

from juggleproof.scenes.errors import SceneError

Corner = tuple[float, float]
Exact: TypeAlias = "tuple[Fraction, Fraction]"
FEWEST, MOST = 3, 64  # corners
SCALE = 10**40  # of square roots in whole numbers
FLATTEST = Fraction(1, 1000)  # the sine of the least turn from one edge to the next


@dataclass(frozen=True)
class Polygon:
    """A convex polygon: its corners in metres from the centre of mass, counterclockwise; made by
    `polygon`.  Edge i goes from corner i to the next.
    """

    corners: tuple[Corner, ...]


def polygon(corners: Sequence[Sequence[float | Fraction]]) -> Polygon:
    """The convex polygon with these corners (x, y), in metres, in order around it either way; the
    first stays the first.  Raises SceneError, one line, if they make none.

    >>> polygon([(0, 0), (2, 0), (2, 4), (0, 4)]).corners
    ((-1.0, -2.0), (1.0, -2.0), (1.0, 2.0), (-1.0, 2.0))
    """
    if not FEWEST <= len(corners) <= MOST:
        raise SceneError(f"a shape of {len(corners)} corners; {FEWEST} to {MOST} are needed")
    given = [_exact(one, k) for k, one in enumerate(corners)]
    for k, one in enumerate(given):
        if one in given[:k]:
            raise SceneError(
                f"corners {given.index(one)} and {k} of the shape are the same, {_words(one)}"
            )
    if doubled_area(given) < 0:
        given = [given[0], *reversed(given[1:])]
    if doubled_area(given) == 0:
        raise SceneError("the shape has no area: its corners are on a line, or it crosses itself")
    around = 0.0
    for before, here, after in zip([given[-1], *given[:-1]], given, [*given[1:], given[0]]):
        came, goes = _less(here, before), _less(after, here)
        turn = cross(came, goes)
        if turn < 0:
            raise SceneError(f"the shape is not convex at its corner {_words(here)}")
        if turn**2 < FLATTEST**2 * dot(came, came) * dot(goes, goes):
            raise SceneError(
                f"the shape is all but straight at its corner {_words(here)}, or turns back; leave"
                " it out"
            )
        around += math.atan2(turn, dot(came, goes))
    if around > 7:
        raise SceneError("the shape goes around more than once: its corners are not in order")
    middle = centroid(given)
    return Polygon(tuple((float(one[0] - middle[0]), float(one[1] - middle[1])) for one in given))


def _exact(corner: Sequence[float | Fraction], k: int) -> Exact:
    if len(corner) != 2:
        raise SceneError(f"corner {k} of the shape has {len(corner)} numbers; x and y are needed")
    try:
        return Fraction(corner[0]), Fraction(corner[1])
    except (ValueError, OverflowError, TypeError):
        raise SceneError(f"corner {k} of the shape has no finite numbers") from None


def _words(corner: Exact) -> str:
    return f"({float(corner[0]):g}, {float(corner[1]):g}) m"


def _less(one: Exact, other: Exact) -> Exact:
    return one[0] - other[0], one[1] - other[1]


def cross(one: Exact, other: Exact) -> Fraction:
    """The cross product of two vectors of the plane.

    >>> cross((Fraction(1), Fraction(0)), (Fraction(3), Fraction(2)))
    Fraction(2, 1)
    """
    return one[0] * other[1] - one[1] * other[0]


def dot(one: Exact, other: Exact) -> Fraction:
    """The scalar product of two vectors of the plane.

    >>> dot((Fraction(1), Fraction(2)), (Fraction(3), Fraction(2)))
    Fraction(7, 1)
    """
    return one[0] * other[0] + one[1] * other[1]


# -------------------------------------------------------------------------------------------------
# Area, centre and gyration, each a sum over the triangles between the origin and an edge.


def pairs(corners: Sequence[Exact]) -> list[tuple[Exact, Exact]]:
    """The two ends of each edge."""
    return list(zip(corners, [*corners[1:], corners[0]]))


def doubled_area(corners: Sequence[Exact]) -> Fraction:
    """Twice the area, negative where the corners go around clockwise.

    >>> doubled_area([(Fraction(0), Fraction(0)), (Fraction(3), Fraction(0)), (0, Fraction(2))])
    Fraction(6, 1)
    """
    return sum((cross(one, other) for one, other in pairs(corners)), Fraction(0))


def centroid(corners: Sequence[Exact]) -> Exact:
    """The centre of mass: the sum of (p + q) (p x q) over the edges from p to q, divided by six
    areas.

    >>> centroid([(Fraction(0), Fraction(0)), (Fraction(3), Fraction(0)), (0, Fraction(6))])
    (Fraction(1, 1), Fraction(2, 1))
    """
    across, up = (
        sum((cross(p, q) * (p[axis] + q[axis]) for p, q in pairs(corners)), Fraction(0))
        / (3 * doubled_area(corners))
        for axis in range(2)
    )
    return across, up


def gyration(corners: Sequence[Exact]) -> Fraction:
    """The square of the radius of gyration about the origin: the sum of (p x q) (p.p + p.q + q.q)
    over the edges from p to q, divided by twelve areas.  Of half sides a and b: (a^2 + b^2)/3.

    >>> a, b = Fraction(1), Fraction(2)
    >>> gyration([(-a, -b), (a, -b), (a, b), (-a, b)])
    Fraction(5, 3)
    """
    total = sum(
        (cross(p, q) * (dot(p, p) + dot(p, q) + dot(q, q)) for p, q in pairs(corners)), Fraction(0)
    )
    return total / (6 * doubled_area(corners))


# -------------------------------------------------------------------------------------------------
# Faces.


@dataclass(frozen=True)
class Geometry:
    """What follows from a polygon, for each edge i: its direction (unit), the angle theta/2 pi in
    [0, 1) at which it lies on the table, how high the centre is above it, and how far to the right
    of the centre's foot its ends are; k^2; the largest distance of a corner; the shortest edge; and
    the friction from which a corner can jam, rounded down.
    """

    directions: tuple[Corner, ...]
    turns: tuple[float, ...]
    heights: tuple[float, ...]
    ends: tuple[tuple[float, float], ...]
    gyration: float
    reach: float
    shortest: float
    jams: float


@lru_cache(maxsize=256)
def geometry(shape: Polygon) -> Geometry:
    """The geometry of a polygon.

    >>> block = geometry(polygon([(0, 0), (2, 0), (2, 4), (0, 4)]))
    >>> block.heights, block.turns, block.jams
    ((2.0, 1.0, 2.0, 1.0), (0.0, 0.75, 0.5, 0.25), 1.3333333333333333)
    """
    corners = _fractions(shape)
    edges = [_less(q, p) for p, q in pairs(corners)]
    lengths = [dot(e, e) for e in edges]
    return Geometry(
        directions=tuple(
            (over_root(e[0], length), over_root(e[1], length)) for e, length in zip(edges, lengths)
        ),
        turns=tuple(
            (-math.atan2(float(e[1]), float(e[0])) / (2 * math.pi)) % 1.0 + 0.0 for e in edges
        ),
        heights=tuple(
            over_root(cross(p, e), length) for p, e, length in zip(corners, edges, lengths)
        ),
        ends=tuple(
            (over_root(dot(p, e), length), over_root(dot(q, e), length))
            for (p, q), e, length in zip(pairs(corners), edges, lengths)
        ),
        gyration=float(gyration(corners)),
        reach=max(math.hypot(*one) for one in shape.corners),
        shortest=float(min(over_root(length, length) for length in lengths)),
        jams=root_below(jamming(shape)),
    )


def _fractions(shape: Polygon) -> list[Exact]:
    return [(Fraction(x), Fraction(y)) for x, y in shape.corners]


def over_root(value: Fraction, square: Fraction) -> float:
    """value/sqrt(square), rounded once but for a part in 10^30.

    >>> over_root(Fraction(-6), Fraction(9)), over_root(Fraction(1), Fraction(2))
    (-2.0, 0.7071067811865476)
    """
    ratio = value * value / square
    found = Fraction(math.isqrt(ratio.numerator * SCALE**2 // ratio.denominator), SCALE)
    return math.copysign(float(found), value) if value else 0.0


def root_below(square: Fraction) -> float:
    """The largest float that is not above a square root.

    >>> root_below(Fraction(2)) ** 2 <= 2, root_below(Fraction(25, 4))
    (True, 2.5)
    """
    found = over_root(square, square)
    return math.nextafter(found, 0.0) if Fraction(found) ** 2 > square else found


def jamming(shape: Polygon) -> Fraction:
    """The square of the least friction with which a corner, or the middle of a face, jams at an
    angle at which the polygon meets the table there.

    A place (x, y) of the polygon, from its centre, jams where B_2 - mu |B_3| <= 0: with k^2 the
    gyration, q = k^2/(x^2 + y^2) and t = |x/y| that is mu >= q/t + (1 + q) t.  This is convex in
    t, with its minimum 2 sqrt(q (1 + q)) at t = sqrt(q/(1 + q)), or at the end of the range that is
    next to it (claim part-jamming): a corner meets the table from the angle at which one of its
    edges lies on it to that of the other.  With q = 1/3, of a rectangle, it is 4/3 (claim
    part-rectangle).  Where two corners strike as one, the impulse acts midway between them.

    >>> jamming(polygon([(0, 0), (3, 0), (0, 3)])) == Fraction(24, 25)
    True
    """
    corners = _fractions(shape)
    k2 = gyration(corners)
    least = []
    edges = [_less(other, one) for one, other in pairs(corners)]
    for here, before, after in zip(corners, [edges[-1], *edges[:-1]], edges):
        q = k2 / dot(here, here)
        # the distance to the right of the centre over that below it, at either end of the range
        low, high = (dot(here, edge) / cross(here, edge) for edge in (after, before))
        for first, last in ((low, high), (-high, -low)):
            least += [_least_on(q, max(first, Fraction(0)), last)] if last > 0 else []
    for (one, other), edge in zip(pairs(corners), edges):
        middle = ((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)
        t = abs(dot(middle, edge) / cross(middle, edge))
        least += [_least_on(k2 / dot(middle, middle), t, t)] if t else []
    return min(least)


def _least_on(q: Fraction, first: Fraction, last: Fraction) -> Fraction:
    """The square of the least q/t + (1 + q) t for t in [first, last]."""
    best = q / (1 + q)
    if first**2 <= best <= last**2:
        return 4 * q * (1 + q)
    t = last if last**2 < best else first
    return (q / t + (1 + q) * t) ** 2


# -------------------------------------------------------------------------------------------------
# Rest.
#
# A face holds a block where the vertical through the centre meets it between its ends.  Between two
# faces that hold there is an angle at which the centre is above a corner.


def stable_faces(shape: Polygon) -> tuple[int, ...]:
    """Return the edges on which a polygon can rest.

    >>> stable_faces(polygon([(0, 0), (1, 0), (4, 1), (3, 1)]))
    (1, 3)
    """
    return tuple(i for i, (left, right) in enumerate(geometry(shape).ends) if left < 0 < right)


def balances(shape: Polygon) -> list[tuple[float, int]]:
    """The angles in [-pi, pi) at which a polygon at rest can fall either way, in order; each with
    the edge on to which it falls from just below that angle.

    >>> [edge for _, edge in balances(polygon([(0, 0), (2, 0), (2, 4), (0, 4)]))]
    [2, 1, 0, 3]
    """
    found, holding = geometry(shape), stable_faces(shape)
    angles = []
    for i, (x, y) in enumerate(shape.corners):
        here, before = found.ends[i][0], found.ends[i - 1][1]
        if here < 0 < before:
            angle = math.atan2(-x, -y)
            angles.append(angle + 2 * math.pi if angle < -math.pi else angle)
    angles.sort()
    below = [
        min(((angle / (2 * math.pi) - found.turns[edge]) % 1.0, edge) for edge in holding)
        for angle in angles
    ]
    return [(angle, edge) for angle, (_, edge) in zip(angles, below)]
