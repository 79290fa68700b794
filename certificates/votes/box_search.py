"""Branch and bound on boxes: every box is discarded because some fact surely fails on it, or cut
in.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from juggleproof.certificates.algebra.intervals import (
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
from juggleproof.certificates.votes.questions import Atom, Formula, Polynomial, Question, atom, join
from juggleproof.certificates.votes.regions import Region, insert, regions
from juggleproof.certificates.votes.vote import Enclosure

# -------------------------------------------------------------------------------------------------
# Branch and bound on boxes: every box is discarded because some fact surely fails on it, or cut in
# two; counted boxes only.

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


# -------------------------------------------------------------------------------------------------
# Where boxes cannot decide, because equality is attained: enclosures of the infimum of what is
# shown to be positive.


@dataclass(frozen=True)
class GoalBound:
    """Enclosures of inf p for each part p > 0 or p >= 0 of the goal; `positive` where they show the
    goal, `point` where one refutes it.
    """

    enclosures: tuple[Enclosure, ...]
    positive: bool
    confirmed: bool
    boxes: int
    point: list[Fraction] | None = None

    @property
    def narrow(self) -> bool:
        """Whether every enclosure has the width that was wanted."""
        return all(e.high - e.low <= e.wanted for e in self.enclosures)

    @property
    def room(self) -> bool:
        """Whether the goal may hold with room to spare, so that more boxes may decide it."""
        return not self.narrow and all(e.high > e.wanted for e in self.enclosures)

    def opinions(self) -> tuple[tuple[str, str], ...]:
        """What each arithmetic found."""
        return (
            ("arb", "encloses"),
            (
                "mpmath.iv",
                "agrees on the lowest box" if self.confirmed else "undecided on the lowest box",
            ),
        )


def enclose_goal(question: Question, width: Fraction, allowance: int) -> GoalBound | None:
    """The enclosures, for a goal that is a conjunction of inequalities; None for any other, or
    where nothing bounds the region.

    Formula: the infimum is taken over all points that meet the premises.
    """
    formula = join("or", [denial.formula for denial in question.denials])
    parts = (
        (formula,)
        if isinstance(formula, Atom)
        else ()
        if isinstance(formula, bool) or formula.op == "and"
        else formula.parts
    )
    denied = [part for part in parts if isinstance(part, Atom) and part.relation in (">", ">=")]
    if not denied or len(denied) < len(parts):
        return None
    assumed, enclosures, boxes, positive, confirmed = (
        join("and", question.assumed),
        [],
        0,
        True,
        True,
    )
    for part in denied:
        poly = Polynomial.of(part.poly.names, {e: -c for e, c in part.poly.terms}, part.poly.den)
        found = _infimum(assumed, poly, width, allowance // len(denied))
        if found is None:
            return None
        boxes += found.boxes
        enclosure = Enclosure(
            str(poly), _short(found.low, up=False), _short(found.high, up=True), width
        )
        if part.holds(-found.high):
            return GoalBound((enclosure,), False, found.confirmed, boxes, found.point)
        enclosures.append(enclosure)
        confirmed = confirmed and found.confirmed
        positive = positive and not part.holds(-found.low)
    return GoalBound(tuple(enclosures), positive, confirmed, boxes)


def _short(value: Fraction, up: bool) -> Fraction:
    """The next multiple of 2^-20: an enclosure with readable ends."""
    scaled = value * (1 << 20)
    return Fraction(
        (
            -(-scaled.numerator // scaled.denominator)
            if up
            else scaled.numerator // scaled.denominator
        ),
        1 << 20,
    )


@dataclass
class Found:
    """low <= inf <= high, the latter attained at the point."""

    low: Fraction
    high: Fraction
    point: list[Fraction]
    boxes: int
    confirmed: bool


def _infimum(assumed: Formula, poly: Polynomial, width: Fraction, allowance: int) -> Found | None:
    """The infimum of the polynomial where the formula holds.

    It is not above a value that is attained, so only the part of the region at or below that value
    matters, and that part may be bounded.
    """
    start = _attained(assumed, poly)
    if start is None:
        return None
    level, point = start
    parts = regions(poly.names, join("and", [assumed, atom(_less(poly, level), ">=")]))
    if parts is None or any(region.unbounded() for region in parts):
        return None
    found = Found(level, level, point, 0, True)
    for region in parts:
        aim = poly
        for step in region.solved:
            aim = insert(aim, step)
        inner = enclose_infimum(
            aim,
            region.facts,
            region.box(),
            found.high,
            width,
            allowance // len(parts),
            region.test(assumed),
        )
        if inner is None:
            return None
        found.boxes += inner.boxes
        if inner.point is not None:
            found.high, found.point = inner.high, region.complete(inner.point)
        found.low, found.confirmed = (
            min(found.low, inner.low, found.high),
            found.confirmed and inner.confirmed,
        )
    return found


def _less(poly: Polynomial, level: Fraction) -> Polynomial:
    """level - poly, times a positive number."""
    terms = {e: -c * level.denominator for e, c in poly.terms}
    constant = (0,) * len(poly.names)
    terms[constant] = terms.get(constant, 0) + level.numerator * poly.den
    return Polynomial.of(poly.names, terms)


def _attained(assumed: Formula, poly: Polynomial) -> tuple[Fraction, list[Fraction]] | None:
    """The least value of the polynomial at a few exact points of the region, with its point; None
    where none is met.
    """
    parts: list[Region] = regions(poly.names, assumed) or []
    met = [(poly.at(point), point) for region in parts for point in region.samples(assumed)]
    return min(met, key=lambda pair: pair[0]) if met else None
