"""Terms over one parameter, piece by piece."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice

from flint import fmpq, fmpq_mpoly, fmpq_poly

from juggleproof.algebra.conditions import Condition, constant_of, evaluate, univariate
from juggleproof.algebra.numbers import (
    AlgebraicNumber,
    polynomial_text,
    real_roots,
    sign,
    simplest_between,
)
from juggleproof.search import limits
from juggleproof.search.candidates import separate
from juggleproof.search.closing import search_closing
from juggleproof.search.hints.asking import ask
from juggleproof.search.ranges import CutDomain, DomainCell
from juggleproof.search.samples import state_condition
from juggleproof.search.scales import Normal
from juggleproof.search.templates import CornerSearch, TemplateSearch
from juggleproof.search.terms import (
    NEGLIGIBLE,
    Sample,
    TermChoice,
    reduced_by,
    root_values,
)
from juggleproof.search.witness_terms import (
    TermTask,
    confirmed,
    failing_goal,
    length,
    margins_of,
    setting,
)
from juggleproof.statements.nodes import Values, by_sign
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Exhausted

# -------------------------------------------------------------------------------------------------
# Where two pieces of a line meet: polynomials whose signs separate them.


def linear_text(value: fmpq, parameter: str) -> str:
    """A polynomial of degree 1 that rises through 0 at a rational."""
    return polynomial_text([-int(value.p), int(value.q)], parameter)


def cut_between(
    left: DomainCell, right: DomainCell, parameter: str
) -> tuple[str, int | None] | None:
    """(a polynomial that rises through the border of two pieces, which of them has the border
    itself; None: neither).
    """
    high, low = left.high, right.low
    if high is None or low is None:
        end = high if high is not None else low
        if end is None:
            return linear_text(fmpq(0), parameter), 0
        value = (
            simplest_between(end._low - 1, end._low)
            if low is None
            else simplest_between(end._high, end._high + 1)
        )
        return linear_text(value, parameter), 0
    if low < high:
        bottom = max(low._high, left.low._high) if left.low is not None else low._high
        return linear_text(simplest_between(bottom, high._low), parameter), 0
    if high < low:
        return linear_text(simplest_between(high._high, low._low), parameter), None
    middle = 0 if left.high_closed else 1 if right.low_closed else None
    if high.is_rational:
        return linear_text(high._low, parameter), middle
    return _rising_text(high, parameter), middle


def _rising_text(number: AlgebraicNumber, parameter: str) -> str:
    """The polynomial of the number with the sign that makes it rise there."""
    rising = number.sign_of(fmpq_poly(number.poly).derivative()) > 0
    if rising:
        return number.polynomial_text(parameter)
    return polynomial_text([-c for c in number.coefficients], parameter)


# -------------------------------------------------------------------------------------------------
# Families over one parameter: where exactly each choice of terms serves, and a cover of the whole
# range by a few of them.


@dataclass
class ParameterPiece:
    """An interval of the parameter and the choice of terms that serves on all of it."""

    interval: DomainCell
    choice: TermChoice


class LineCover:
    """The search for values that serve on a state in one parameter."""

    def __init__(
        self, task: TermTask, state: SearchState, parameter: str, samples: Sequence[Sample]
    ) -> None:
        self.task, self.state, self.parameter, self.samples = task, state, parameter, list(samples)
        self.condition, self.keys, self.integers = setting(task, state)
        self.normal = Normal(state, self.condition, equations=False)
        self.allowed = state_condition(state)
        self.margins = margins_of(state, self.condition, self.normal)
        self.goal, self.borders = failing_goal(task, state, self.condition, task.budget)
        self.served: list[tuple[TermChoice, list[DomainCell]]] = []

    def search(self) -> Values | None:
        """Values for the whole state, or None.

        Raises Exhausted where the budget ends.
        """
        regions = _intervals(self.allowed, self.parameter)
        if not regions:
            node = search_closing(self.state, self.task.known, self.task.budget, 1)
            return None if node is None else ("empty", node)
        count = len(self.samples)
        groups = [
            self.samples,
            self.samples[:3],
            self.samples[-3:],
            self.samples[count // 2 : count // 2 + 1],
        ]
        for number, group in enumerate(groups):
            if group and (number == 0 or group != self.samples):
                self._gather(group)
                plan = self._plan(regions)
                if isinstance(plan, list):
                    values = self._build(self.state, plan, 2)
                    if values is not None:
                        return values
        for _ in range(8):
            plan = self._plan(regions)
            if isinstance(plan, list):
                return self._build(self.state, plan, 2)
            # Nothing serves just above this sample: look there.
            before = len(self.served)
            self._gather([plan])
            if len(self.served) == before:
                return None
        return None

    def _gather(self, samples: Sequence[Sample]) -> None:
        """More choices: those that serve at all these samples."""
        task, nodes = self.task, min(self.task.nodes, 150)
        borders = self.borders if self.goal is not None else None
        searches = [
            kind(
                [self.parameter],
                samples,
                task.budget,
                self.integers,
                nodes,
                None,
                task.hints,
                self.margins,
                borders,
                task.roles,
            )
            for kind in (CornerSearch, TemplateSearch)
        ]
        for choice in self._failing(
            chain(*(search.search(self.condition, list(self.keys.values())) for search in searches))
        ):
            if all(choice.values != known.values for known, _ in self.served):
                intervals = self._intervals_of(choice)
                if intervals:
                    self.served.append((choice, intervals))
        self.served.sort(key=lambda pair: length(pair[0]))

    def _failing(self, choices: Iterator[TermChoice]) -> Iterator[TermChoice]:
        """The first choices; where the goals speak of further variables, those at which Z3 sees no
        values that meet the goals.
        """
        if self.goal is None:
            yield from islice(choices, 10)
            return
        count = 0
        for choice in islice(choices, 30):
            sample = (
                self.samples[choice.serves[len(choice.serves) // 2]]
                if choice.serves
                else self.samples[0]
            )
            given = {**sample, **root_values(choice.roots, sample)}
            values = {
                name: value
                for name, quotient in choice.values.items()
                if (value := quotient.at(given)) is not None
            }
            values = {
                name: value if value.q < 10**9 else nearest(value) for name, value in values.items()
            }
            if (
                ask(
                    self.goal.substituted({**sample, **values}),
                    self.task.budget,
                    self.integers,
                    100_000,
                ).verdict
                == "unsat"
            ):
                yield choice
                count += 1
                if count >= 4:
                    return

    def _intervals_of(self, choice: TermChoice) -> list[DomainCell]:
        """Where in the state the choice meets the condition, up to the accuracy with which roots
        are known.
        """
        condition = self.condition
        for name, value in choice.values.items():
            condition = condition.replaced(name, value.top, value.bottom)
        for root in choice.roots:
            condition = condition.mapped(lambda p, root=root: reduced_by(root, p))
        bottoms = [q.bottom for q in choice.values.values() if not q.bottom.is_constant()]
        nonzero = Condition(
            condition.ring,
            bottoms,
            ("and", [(k, "!=") for k in range(len(bottoms))]) if bottoms else True,
        )
        whole = condition.conjoined(nonzero)
        place = whole.ring.variable_to_index(self.parameter)
        for root in choice.roots:
            if any(
                e
                for i, e in enumerate(root.poly.degrees())
                if i not in (place, whole.ring.variable_to_index(root.name))
            ):
                return []
        self.task.budget.spend(300 + 200 * len(whole.polys))
        return _intervals(self.allowed, self.parameter, whole, choice)

    def _plan(self, regions: Sequence[DomainCell]) -> list[ParameterPiece] | Sample:
        """Pieces that cover the regions from left to right, or a sample just where nothing
        serves.
        """
        pieces: list[ParameterPiece] = []
        for region in regions:
            low, closed = region.low, region.low_closed
            while True:
                best: ParameterPiece | None = None
                for choice, intervals in self.served:
                    for interval in intervals:
                        if _starts(interval, low, closed) and (
                            best is None or _further(interval, best.interval)
                        ):
                            best = ParameterPiece(interval, choice)
                if best is None:
                    return {self.parameter: _just_above(low, region.high)}
                pieces.append(best)
                if not _further(region, best.interval):
                    break
                low, closed = best.interval.high, not best.interval.high_closed
        return pieces

    def _build(
        self, state: SearchState, plan: Sequence[ParameterPiece], depth: int
    ) -> Values | None:
        if len(plan) == 1:
            return self._leaf(state, plan[0], depth)
        k = len(plan) // 2
        left, right = plan[k - 1], plan[k]
        cut = cut_between(left.interval, right.interval, self.parameter)
        if cut is None:
            return None
        text, middle = cut
        branches = state.by_sign(text)
        below = self._build(branches[0], plan[:k], depth)
        if below is None:
            return None
        at = (
            self._leaf(branches[1], (left, right)[middle], 0)
            if middle is not None
            else self._empty(branches[1])
        )
        above = None if at is None else self._build(branches[2], plan[k:], depth)
        return None if at is None or above is None else ("sign", text, below, at, above)

    def _empty(self, state: SearchState) -> Values | None:
        node = search_closing(state, self.task.known, self.task.budget, 1)
        return None if node is None else ("empty", node)

    def _leaf(self, state: SearchState, piece: ParameterPiece, depth: int) -> Values | None:
        """The piece's choice, or another that serves there, or the piece in two halves."""
        others = [
            c
            for c, intervals in self.served
            if c is not piece.choice and any(_within(piece.interval, i) for i in intervals)
        ]
        task = self.task
        for part, choices in zip(
            limits.PIECE_WORK, ([piece.choice, *others[:4]], [piece.choice, *others[:1]])
        ):
            for choice in choices:
                try:
                    less = replace(task, budget=task.budget.part(part))
                    values = confirmed(less, self.normal, state, choice, self.keys)
                except Exhausted:
                    if task.budget.left <= 0:
                        raise
                    values = None
                if values is not None:
                    return values
        low, high = piece.interval.low, piece.interval.high
        if depth <= 0 or low is None or high is None or low is high:
            return None
        gap = high._low - low._high
        value = simplest_between(low._high + gap / 3, high._low - gap / 3)
        halves = (
            DomainCell(low, piece.interval.low_closed, AlgebraicNumber.rational(value), True),
            DomainCell(AlgebraicNumber.rational(value), True, high, piece.interval.high_closed),
        )
        return self._build_halves(
            state, [ParameterPiece(half, piece.choice) for half in halves], value, depth - 1
        )

    def _build_halves(
        self, state: SearchState, halves: Sequence[ParameterPiece], value: fmpq, depth: int
    ) -> Values | None:
        text = linear_text(value, self.parameter)
        cases: list[Values] = []
        for branch, piece in zip(state.by_sign(text), (halves[0], halves[0], halves[1])):
            values = self._leaf(branch, piece, depth)
            if values is None:
                return None
            cases.append(values)
        return by_sign(text, cases)


def _intervals(
    allowed: Condition,
    parameter: str,
    whole: Condition | None = None,
    choice: TermChoice | None = None,
) -> list[DomainCell]:
    """The maximal intervals on which the allowed condition, and the other one where there is one,
    hold.
    """
    numbers: list[AlgebraicNumber] = []
    roots = choice.roots if choice else []
    polys = [univariate(p, parameter) for k in allowed.used() for p in [allowed.polys[k]]]
    for poly in [whole.polys[k] for k in whole.used()] if whole else []:
        polys.append(univariate(_norm(poly, choice), parameter))
    for root in roots:
        polys.append(univariate(root.poly.discriminant(root.name), parameter))
    for dense in polys:
        if dense != 0:
            numbers += [r for r in real_roots(dense) if r not in numbers]
    numbers.sort()
    separate(numbers)
    verdicts = []
    for k in range(2 * len(numbers) + 1):
        if k % 2:
            at: fmpq | AlgebraicNumber = numbers[k // 2]
        elif not numbers:
            at = fmpq(1, 2)
        elif k == 0:
            at = numbers[0]._low - 1
        elif k == 2 * len(numbers):
            at = numbers[-1]._high + 1
        else:
            at = simplest_between(numbers[k // 2 - 1]._high, numbers[k // 2]._low)
        verdicts.append(
            _holds(allowed, parameter, at)
            and (whole is None or _holds(whole, parameter, at, choice))
        )
    return CutDomain(tuple(numbers), tuple(verdicts)).intervals(True)


def _norm(poly: fmpq_mpoly, choice: TermChoice | None) -> fmpq_mpoly:
    """A polynomial in the parameter alone that vanishes where this one does, for some sign of the
    roots.
    """
    for root in reversed(choice.roots if choice else []):
        if poly.degrees()[poly.context().variable_to_index(root.name)]:
            poly = poly.resultant(root.poly, root.name)
    return poly


def _holds(
    condition: Condition,
    parameter: str,
    at: fmpq | AlgebraicNumber,
    choice: TermChoice | None = None,
) -> bool:
    if isinstance(condition.tree, bool):
        return condition.tree
    if not choice or not choice.roots:
        return condition.univariate_truth(parameter, at, condition.in_one_variable(parameter))
    if isinstance(at, AlgebraicNumber):
        at.narrow(limits.NEGLIGIBLE_WIDTH)
        at = (at._low + at._high) / 2
    sample = {parameter: at}
    values = {**sample, **root_values(choice.roots, sample)}
    signs: dict[int, int] = {}
    for k in condition.used():
        value = constant_of(condition.polys[k].subs(values))
        if value is None:
            return False
        signs[k] = 0 if abs(value) < NEGLIGIBLE else sign(value)
    return evaluate(condition.tree, signs)


def _starts(interval: DomainCell, low: AlgebraicNumber | None, closed: bool) -> bool:
    """Whether an interval has the first numbers above `low`, and `low` itself where that is
    asked.
    """
    if low is None:
        return interval.low is None
    if interval.low is None or interval.low < low:
        return (
            interval.high is None
            or interval.high > low
            or (closed and interval.high == low and interval.high_closed)
        )
    return interval.low == low and (interval.low_closed or not closed)


def _further(interval: DomainCell, than: DomainCell) -> bool:
    """Whether an interval ends beyond another."""
    if than.high is None:
        return False
    if interval.high is None:
        return True
    return interval.high > than.high or (
        interval.high == than.high and interval.high_closed and not than.high_closed
    )


def _within(inner: DomainCell, outer: DomainCell) -> bool:
    return _starts(outer, inner.low, inner.low_closed) and not _further(inner, outer)


def _just_above(low: AlgebraicNumber | None, high: AlgebraicNumber | None) -> fmpq:
    if low is None:
        return high._low - 1 if high is not None else fmpq(0)
    if high is None:
        return simplest_between(low._high, low._high + 1)
    return simplest_between(low._high, low._high + (high._low - low._high) / 64)


def nearest(value: fmpq) -> fmpq:
    """A short rational close to a long one, for Z3."""
    return fmpq(int((value * 10**6).floor()), 10**6)
