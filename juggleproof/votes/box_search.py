"""Branch and bound on boxes in Arb's balls: every box is discarded because some fact surely fails
on it, or cut in two; counted boxes only.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, fmpz_mpoly

from juggleproof.algebra.intervals import (
    Box,
    Enclosed,
    Placed,
    ball_ends,
    middle,
    split,
    surely,
    widest,
)
from juggleproof.algebra.polynomials import value_at
from juggleproof.statements.vote import VoteEnclosure
from juggleproof.votes.branches import regions
from juggleproof.votes.questions import Atom, Formula, VoteQuestion, atom, join

# -------------------------------------------------------------------------------------------------
# Whether facts have a common solution in a box.

Accept = Callable[[list[Fraction]], bool]


class BoxFact(Enclosed):
    """A fact made ready for many boxes."""

    def __init__(self, fact: Atom) -> None:
        super().__init__(fact.poly)
        self.relation = fact.relation
        # x > c holds on the box but for its edge, so no cut is made for its sake
        self.bound = fact.poly.total_degree() == 1 and len(self.used) == 1

    def truth(self, value: arb) -> bool | None:
        """Whether the fact holds for every number of the ball, or for none; None: undecided."""
        return surely(value, self.relation)


@dataclass
class Emptiness:
    """The outcome of the search for a solution of all facts: `empty`, `point` (exact) or, with
    neither, undecided; `leaves` counts the boxes that were discarded.
    """

    boxes: int
    leaves: int = 0
    point: list[Fraction] | None = None
    empty: bool = False


def refute(facts: Sequence[Atom], box: Box, allowance: int, accept: Accept) -> Emptiness:
    """Looks for a solution of all facts in the box, and proves that there is none where every box
    is discarded.

    Source: interval branch and bound, breadth first; the cut is along the side to which the
    undecided facts are most sensitive. A point counts only where `accept`, which evaluates exactly,
    says so; an undecided comparison of intervals never decides anything.
    """
    ready = [BoxFact(fact) for fact in facts]
    queue: deque[tuple[Box, tuple[int, ...]]] = deque([(box, tuple(range(len(facts))))])
    outcome = Emptiness(0)
    while queue and outcome.boxes < allowance:
        current, alive = queue.popleft()
        outcome.boxes += 1
        discarded, alive, weights, promising = _look(ready, alive, Placed(current))
        if discarded:
            outcome.leaves += 1
            continue
        if promising:
            point = middle(current)
            if accept(point):
                outcome.point = point
                return outcome
        sides = [i for i, side in enumerate(current) if side[1]]
        if not sides:
            # a single point at which nothing is decided: equality, which no cut will decide
            return outcome
        best = (
            max(sides, key=lambda i: (weights.get(i, 0.0), -i))
            if weights
            else widest(current, sides)
        )
        queue.extend((half, alive) for half in split(current, best))
    outcome.empty = not queue and outcome.point is None
    return outcome


def _look(
    ready: Sequence[BoxFact], alive: tuple[int, ...], placed: Placed
) -> tuple[bool, tuple[int, ...], dict[int, float], bool]:
    """Whether some fact surely fails; else the facts still undecided, how much each side matters to
    them, and whether the middle may be a solution.
    """
    left = []
    for k in alive:
        truth = ready[k].truth(ready[k].natural(placed))
        if truth is False:
            return True, (), {}, False
        if truth is None:
            left.append(k)
    promising, weights, kept = True, dict[int, float](), []
    for k in left:
        value, slopes, at_middle = ready[k].centred(placed)
        truth = ready[k].truth(value)
        if truth is False:
            return True, (), {}, False
        promising = promising and ready[k].truth(at_middle) is not False
        if truth is None:
            kept.append(k)
            if not ready[k].bound:
                _weigh(weights, slopes, placed)
    return False, tuple(kept), weights, promising


# -------------------------------------------------------------------------------------------------
# The infimum of a polynomial over the part of a box where facts hold.


@dataclass
class Infimum:
    """low <= inf of the polynomial over the region; where a better point than the known one was
    met, high is its value.
    """

    low: Fraction
    high: Fraction
    boxes: int = 0
    point: list[Fraction] | None = None


def enclose_infimum(
    poly: fmpz_mpoly,
    den: int,
    facts: Sequence[Atom],
    box: Box,
    known: Fraction,
    width: Fraction,
    allowance: int,
    accept: Accept,
) -> Infimum | None:
    """Encloses the infimum of the polynomial / den (den > 0) over the points of the box that meet
    all facts, best box first.

    `known` is a value already attained; parts of the region where the polynomial is larger do not
    matter.  The low end is the least lower end over the boxes that are left; it is the high end
    where none is left.  None where a box has no finite enclosure.
    """
    ready, aim = [BoxFact(fact) for fact in facts], Enclosed(poly)
    infimum = Infimum(known, known)
    heap: list[tuple[Fraction, int, Box, tuple[int, ...]]] = []
    floor: Fraction | None = None  # the lower end of a box that is a point and was set aside

    def place(current: Box, alive: tuple[int, ...], at_least: list[Fraction]) -> bool:
        placed = Placed(current)
        discarded, alive, _, promising = _look(ready, alive, placed)
        infimum.boxes += 1
        if discarded:
            return True
        if promising:
            point = middle(current)
            if accept(point):
                value = value_at(poly, point) / den
                if value < infimum.high:
                    infimum.high, infimum.point = value, point
        values = [aim.natural(placed), *_lowered(aim, [ready[k] for k in alive], placed)]
        lows = [span[0] / den for value in values if (span := ball_ends(value)) is not None]
        low = max([*lows, *at_least], default=None)
        if low is not None and low < infimum.high:
            heapq.heappush(heap, (low, infimum.boxes, current, alive))
        return low is not None

    if not place(box, tuple(range(len(facts))), []):
        return None
    while heap and infimum.boxes < allowance:
        low, _, current, alive = heap[0]
        if infimum.high - low <= width:
            break
        heapq.heappop(heap)
        sides = [i for i, side in enumerate(current) if side[1]]
        if not sides:
            floor = low if floor is None else min(floor, low)
            break
        for half in split(current, _cut(aim, ready, alive, Placed(current), sides)):
            place(half, alive, [low])
    if heap or floor is not None:
        infimum.low = min(
            [infimum.high, *([heap[0][0]] if heap else []), *([floor] if floor is not None else [])]
        )
    else:
        infimum.low = infimum.high
    return infimum


def _lowered(aim: Enclosed, facts: Sequence[BoxFact], placed: Placed) -> list[arb]:
    """Enclosures whose low ends hold for the polynomial where all facts hold, of p alone and of p
    less multiples of the facts.

    Formula: p >= q = p - sum m_k f_k for m_k >= 0 where f_k >= 0 (weak duality), and q >= q(c) +
    sum q_i(box) (x_i - c_i), where c is the low or high end of a side along which q surely rises or
    falls.  Each m_k makes the gradient at the middle small; any m_k >= 0 is sound, so it is chosen
    in floats.
    """
    slopes = aim.sharp_slopes(placed)
    enclosures, used = [_from_corner(aim, [], slopes, placed)], list[tuple[arb, BoxFact]]()
    for fact in facts:
        if fact.relation not in (">", ">="):
            continue
        other = fact.sharp_slopes(placed)
        theirs = {i: float(slope.mid()) * placed.half(i) for i, slope in other.items()}
        inner = sum(
            float(slopes[i].mid()) * placed.half(i) * h for i, h in theirs.items() if i in slopes
        )
        norm = sum(h * h for h in theirs.values())
        rounded = round(64 * inner / norm) if norm > 0 and 0 < inner < 1e9 * norm else 0
        if rounded:
            multiple = arb(rounded) / 64
            slopes = {i: slopes.get(i, 0) - multiple * other.get(i, 0) for i in {**slopes, **other}}
            used.append((multiple, fact))
    return [*enclosures, _from_corner(aim, used, slopes, placed)] if used else enclosures


def _from_corner(
    aim: Enclosed, used: Sequence[tuple[arb, BoxFact]], slopes: dict[int, arb], placed: Placed
) -> arb:
    ends = {
        i: -1 if surely(slope, ">=") else 1 if surely(-slope, ">=") else 0
        for i, slope in slopes.items()
    }
    point = placed.point(ends)
    value = aim.at(point)
    for multiple, fact in used:
        value = value - multiple * fact.at(point)
    return placed.around(value, slopes, ends)


def _weigh(weights: dict[int, float], slopes: dict[int, arb], placed: Placed) -> None:
    """Adds how much each side matters to one polynomial.  Floats choose where to cut; they decide
    nothing.
    """
    sizes = {i: float(slope.abs_upper()) * placed.half(i) for i, slope in slopes.items()}
    total = sum(sizes.values()) or 1.0
    for i, size in sizes.items():
        weights[i] = weights.get(i, 0.0) + size / total


def _cut(
    aim: Enclosed,
    ready: Sequence[BoxFact],
    alive: tuple[int, ...],
    placed: Placed,
    sides: list[int],
) -> int:
    weights, active = dict.fromkeys(sides, 0.0), [ready[k] for k in alive if not ready[k].bound]
    for fact in (*[aim] * max(1, len(active)), *active):
        _weigh(weights, fact.centred(placed)[1], placed)
    best = max(sides, key=lambda i: (weights[i], -i))
    return best if weights[best] else widest(placed.box, sides)


# -------------------------------------------------------------------------------------------------
# Where boxes cannot decide, because equality is attained: enclosures of the infimum of what is
# shown to be positive.


@dataclass(frozen=True)
class GoalBound:
    """Enclosures of inf p for each part p > 0 or p >= 0 of the goal; `positive` where they show the
    goal, `point` where one refutes it.
    """

    enclosures: tuple[VoteEnclosure, ...]
    positive: bool
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


def enclose_goal(question: VoteQuestion, width: Fraction, allowance: int) -> GoalBound | None:
    """The enclosures, for a goal that is a conjunction of inequalities; None for any other, or
    where nothing bounds the region.

    Formula: the infimum is taken over all points that meet the premises.
    """
    formula = join("or", [denial.formula for denial in question.denials])
    parts: Sequence[Formula] = (
        (formula,)
        if isinstance(formula, Atom)
        else ()
        if isinstance(formula, bool) or formula[0] == "and"
        else formula[1]
    )
    denied = [part for part in parts if isinstance(part, Atom) and part.relation in (">", ">=")]
    if not denied or len(denied) < len(parts):
        return None
    assumed, enclosures, boxes, positive = join("and", question.assumed), [], 0, True
    for part in denied:
        poly = -part.poly
        infimum = _infimum(question.names, assumed, poly, width, allowance // len(denied))
        if infimum is None:
            return None
        boxes += infimum.boxes
        enclosure = VoteEnclosure(
            str(poly), _short(infimum.low, up=False), _short(infimum.high, up=True), width
        )
        if part.holds(-infimum.high):
            return GoalBound((enclosure,), False, boxes, infimum.point)
        enclosures.append(enclosure)
        positive = positive and not part.holds(-infimum.low)
    return GoalBound(tuple(enclosures), positive, boxes)


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


def _infimum(
    names: tuple[str, ...], assumed: Formula, poly: fmpz_mpoly, width: Fraction, allowance: int
) -> Infimum | None:
    """The infimum of the polynomial where the formula holds, with a point where `high` is attained.

    It is not above a value that is attained, so only the part of the region at or below that value
    matters, and that part may be bounded.
    """
    start = _attained(names, assumed, poly)
    if start is None:
        return None
    level, point = start
    below = atom(level.numerator - poly * level.denominator, ">=")
    parts = regions(names, join("and", [assumed, below]))
    if parts is None or any(region.unbounded() for region in parts):
        return None
    infimum = Infimum(level, level, 0, point)
    for region in parts:
        reduced = region.reduced(poly)
        if reduced is None:
            return None
        inner = enclose_infimum(
            *reduced,
            region.facts,
            region.box(),
            infimum.high,
            width,
            allowance // len(parts),
            region.test(assumed),
        )
        if inner is None:
            return None
        infimum.boxes += inner.boxes
        if inner.point is not None:
            infimum.high, infimum.point = inner.high, region.complete(inner.point)
        infimum.low = min(infimum.low, inner.low, infimum.high)
    return infimum


def _attained(
    names: tuple[str, ...], assumed: Formula, poly: fmpz_mpoly
) -> tuple[Fraction, list[Fraction]] | None:
    """The least value of the polynomial at a few exact points of the region, with its point; None
    where none is met.
    """
    parts = regions(names, assumed) or ()
    met = [(value_at(poly, point), point) for part in parts for point in part.samples(assumed)]
    return min(met, key=lambda pair: pair[0]) if met else None
