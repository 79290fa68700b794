"""Branch and bound on boxes: every box is discarded because some fact surely fails on it, or cut in
two; counted boxes only.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from certificates.routes.arithmetic import (
    Balls,
    Box,
    Ends,
    Fact,
    Kernel,
    Placed,
    middle,
    split,
    widest,
)
from certificates.routes.polynomials import Atom, Polynomial

SECOND_OPINIONS = 48
Accept = Callable[[list[Fraction]], bool]


@dataclass(frozen=True)
class Leaf:
    """A discarded box: the number of the fact that fails on it, and whether the mean value form was
    needed to see it.
    """

    box: Box
    fact: int
    centred: bool


@dataclass
class Emptiness:
    """What became of the search for a solution of all facts: `empty`, `point` (exact) or, with
    neither, undecided.
    """

    boxes: int
    leaves: list[Leaf] = field(default_factory=list)
    point: list[Fraction] | None = None
    empty: bool = False


def refute(facts: Sequence[Atom], box: Box, allowance: int, accept: Accept) -> Emptiness:
    """Looks for a solution of all facts in the box, and proves that there is none where every box
    is discarded.

    Source: interval branch and bound, breadth first; the cut is along the side to which the
    undecided facts are most sensitive. A point counts only where `accept`, which evaluates exactly,
    says so; an undecided comparison of intervals never decides anything.
    """
    kernel = Balls()
    ready = [Fact(kernel, fact) for fact in facts]
    queue: deque[tuple[Box, tuple[int, ...]]] = deque([(box, tuple(range(len(facts))))])
    found = Emptiness(0)
    while queue and found.boxes < allowance:
        current, alive = queue.popleft()
        found.boxes += 1
        placed = Placed(kernel, current)
        leaf, alive, weights, promising = _look(ready, alive, placed)
        if leaf is not None:
            found.leaves.append(leaf)
            continue
        if promising:
            point = middle(current)
            if accept(point):
                found.point = point
                return found
        sides = [i for i, side in enumerate(current) if side[1]]
        if not sides:
            # a single point at which nothing is decided: equality, which no cut will decide
            return found
        best = (
            max(sides, key=lambda i: (weights.get(i, 0.0), -i))
            if weights
            else widest(current, sides)
        )
        queue.extend((half, alive) for half in split(current, best))
    found.empty = not queue and found.point is None
    return found


def _look(
    ready: Sequence[Fact], alive: tuple[int, ...], placed: Placed
) -> tuple[Leaf | None, tuple[int, ...], dict[int, float], bool]:
    """A leaf, or the facts still undecided, how much each side matters to them, and whether the
    middle may be a solution.
    """
    left = []
    for k in alive:
        value = ready[k].natural(placed)
        if ready[k].fails(value):
            return Leaf(placed.box, k, False), (), {}, False
        if not ready[k].holds(value):
            left.append(k)
    promising, weights, kept = True, dict[int, float](), []
    for k in left:
        value, slopes, at_middle = ready[k].centred(placed)
        if ready[k].fails(value):
            return Leaf(placed.box, k, True), (), {}, False
        promising = promising and not ready[k].fails(at_middle)
        if ready[k].holds(value):
            continue
        kept.append(k)
        if not ready[k].bound:
            _weigh(weights, slopes, placed)
    return None, tuple(kept), weights, promising


def second_opinion(facts: Sequence[Atom], leaves: Sequence[Leaf]) -> tuple[int, int, str]:
    """(leaves asked, leaves confirmed, a leaf that is contradicted or "") by `mpmath.iv` on evenly
    chosen leaves.

    Contradicted: the two enclosures of one polynomial on one box have no number in common.
    """
    kernel, balls = Ends(), Balls()
    ready, first = [Fact(kernel, fact) for fact in facts], [Fact(balls, fact) for fact in facts]
    step = max(1, -(-len(leaves) // SECOND_OPINIONS))
    chosen = leaves[::step]
    confirmed = 0
    for leaf in chosen:
        values = [
            _enclose(fact[leaf.fact], Placed(arithmetic, leaf.box), leaf.centred)
            for fact, arithmetic in ((ready, kernel), (first, balls))
        ]
        confirmed += ready[leaf.fact].fails(values[0])
        spans = kernel.ends(values[0]), balls.ends(values[1])
        if spans[0] and spans[1] and (spans[0][1] < spans[1][0] or spans[1][1] < spans[0][0]):
            return len(chosen), confirmed, f"{facts[leaf.fact].poly} on {leaf.box}"
    return len(chosen), confirmed, ""


def _enclose(fact: Fact, placed: Placed, centred: bool) -> Any:
    return fact.centred(placed)[0] if centred else fact.natural(placed)


@dataclass
class Infimum:
    """low <= inf of the polynomial over the region; where a better point than the known one was
    met, high is its value.
    """

    low: Fraction
    high: Fraction
    boxes: int = 0
    point: list[Fraction] | None = None
    confirmed: bool = True


def enclose_infimum(
    poly: Polynomial,
    facts: Sequence[Atom],
    box: Box,
    known: Fraction,
    width: Fraction,
    allowance: int,
    accept: Accept,
) -> Infimum | None:
    """Encloses the infimum of the polynomial over the points of the box that meet all facts, best
    box first.

    `known` is a value already attained; parts of the region where the polynomial is larger do not
    matter.  The low end is the least lower end over the boxes that are left; it is the high end
    where none is left.  None where a box has no finite enclosure.
    """
    kernel: Kernel = Balls()
    ready, aim = [Fact(kernel, fact) for fact in facts], Fact(kernel, Atom(poly, ">="))
    found = Infimum(known, known)
    heap: list[tuple[Fraction, int, Box, tuple[int, ...]]] = []
    floor: Fraction | None = None  # the lower end of a box that is a point and was set aside

    def place(current: Box, alive: tuple[int, ...], at_least: list[Fraction]) -> bool:
        placed = Placed(kernel, current)
        leaf, alive, _, promising = _look(ready, alive, placed)
        found.boxes += 1
        if leaf is not None:
            return True
        if promising:
            point = middle(current)
            if accept(point):
                value = poly.at(point)
                if value < found.high:
                    found.high, found.point = value, point
        values = [aim.natural(placed), *_lowered(aim, [ready[k] for k in alive], placed)]
        lows = [span[0] / poly.den for value in values if (span := kernel.ends(value)) is not None]
        low = max([*lows, *at_least], default=None)
        if low is not None and low < found.high:
            heapq.heappush(heap, (low, found.boxes, current, alive))
        return low is not None

    if not place(box, tuple(range(len(facts))), []):
        return None
    while heap and found.boxes < allowance:
        low, _, current, alive = heap[0]
        if found.high - low <= width:
            break
        heapq.heappop(heap)
        sides = [i for i, side in enumerate(current) if side[1]]
        if not sides:
            floor = low if floor is None else min(floor, low)
            break
        for half in split(current, _cut(aim, ready, alive, Placed(kernel, current), sides)):
            place(half, alive, [low])
    if heap or floor is not None:
        found.low = min(
            [found.high, *([heap[0][0]] if heap else []), *([floor] if floor is not None else [])]
        )
        found.confirmed = _confirm(poly, found, heap[0][2] if heap else box)
    else:
        found.low = found.high
    return found


def _lowered(aim: Fact, facts: Sequence[Fact], placed: Placed) -> list[Any]:
    """Enclosures whose low ends hold for the polynomial where all facts hold, of p alone and of p
    less multiples of the facts.

    Formula: p >= q = p - sum m_k f_k for m_k >= 0 where f_k >= 0 (weak duality), and q >= q(c) +
    sum q_i(box) (x_i - c_i), where c is the low or high end of a side along which q surely rises or
    falls.  Each m_k makes the gradient at the middle small; any m_k >= 0 is sound, so it is chosen
    in floats.
    """
    slopes = aim.sharp_slopes(placed)
    found, used = [_from_corner(aim, [], slopes, placed)], list[tuple[Any, Fact]]()
    for fact in facts:
        if fact.atom.relation not in (">", ">="):
            continue
        other = fact.sharp_slopes(placed)
        theirs = {i: float(slope.mid()) * placed.half(i) for i, slope in other.items()}
        inner = sum(
            float(slopes[i].mid()) * placed.half(i) * h for i, h in theirs.items() if i in slopes
        )
        norm = sum(h * h for h in theirs.values())
        rounded = round(64 * inner / norm) if norm > 0 and 0 < inner < 1e9 * norm else 0
        if rounded:
            multiple = placed.kernel.integer(rounded) / 64
            slopes = {i: slopes.get(i, 0) - multiple * other.get(i, 0) for i in {**slopes, **other}}
            used.append((multiple, fact))
    return [*found, _from_corner(aim, used, slopes, placed)] if used else found


def _from_corner(
    aim: Fact, used: Sequence[tuple[Any, Fact]], slopes: dict[int, Any], placed: Placed
) -> Any:
    ends = {
        i: (
            -1
            if placed.kernel.at_most_zero(-slope)
            else 1
            if placed.kernel.at_most_zero(slope)
            else 0
        )
        for i, slope in slopes.items()
    }
    point = placed.point(ends)
    value = aim.at(point)
    for multiple, fact in used:
        value = value - multiple * fact.at(point)
    return placed.around(value, slopes, ends)


def _weigh(weights: dict[int, float], slopes: dict[int, Any], placed: Placed) -> None:
    """Adds how much each side matters to one polynomial.  Floats choose where to cut; they decide
    nothing.
    """
    sizes = {i: float(slope.abs_upper()) * placed.half(i) for i, slope in slopes.items()}
    total = sum(sizes.values()) or 1.0
    for i, size in sizes.items():
        weights[i] = weights.get(i, 0.0) + size / total


def _cut(
    aim: Fact, ready: Sequence[Fact], alive: tuple[int, ...], placed: Placed, sides: list[int]
) -> int:
    weights, active = dict.fromkeys(sides, 0.0), [ready[k] for k in alive if not ready[k].bound]
    for fact in (*[aim] * max(1, len(active)), *active):
        _weigh(weights, fact.centred(placed)[1], placed)
    best = max(sides, key=lambda i: (weights[i], -i))
    return best if weights[best] else widest(placed.box, sides)


def _confirm(poly: Polynomial, found: Infimum, box: Box) -> bool:
    """Whether `mpmath.iv` agrees on the box with the least lower end: its enclosure there does not
    lie below what is claimed.
    """
    kernel = Ends()
    aim = Fact(kernel, Atom(poly, ">="))
    placed = Placed(kernel, box)
    spans = [kernel.ends(aim.natural(placed)), kernel.ends(aim.centred(placed)[0])]
    highs = [span[1] / poly.den for span in spans if span is not None]
    return bool(highs) and min(highs) >= found.low
