"""Millions of orbits at once in float64, each with a proved bound on its error; what the bound
cannot decide is listed, not guessed.

The states of a chunk move together: a whole flight and an impact a round, the closed form once they
are in the trap.  Every number is a `Bounded`, so that the bound of each state accounts for what its
start's conversion missed, for alpha's, and for every operation.  A branch is taken only where the
margin w - x is further from 0 than its bound; a state where it is not is left there, with the
period at which that happened.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scenes.errors import SceneError
from scenes.juggler.bounded import Bounded, Floats, powers
from scenes.juggler.formulas import formulas
from scenes.juggler.setting import Goal, Scene

CHUNK = 1 << 14  # states that move together: their temporaries stay in the processor's cache
ROUND_MEMORY = 64 * 8 * CHUNK  # at most so many temporaries of one chunk are alive
HISTORY_MEMORY = 1 << 30
MOST_PERIODS = 1 << 52  # counted; whole floats
NOT_DONE, REACHED, TRAP, UNDECIDED = range(4)
ENDS = ("", "reached", "trap", "undecided", "too long")  # the last in exact arithmetic only


@dataclass
class Ensemble:
    """Where each orbit stands: arrays of shape (n,), in normal form; `history` has shape (n, steps
    + 1, 4): x, w and their bounds, or is absent.
    """

    x: Floats
    w: Floats
    error_x: Floats
    error_w: Floats
    periods: NDArray[np.int64]
    impacts: NDArray[np.int64]
    end: NDArray[np.uint8]
    history: Floats | None = None
    done: int = 0  # states before this one are followed to their ends

    @staticmethod
    def empty(count: int, goal: Goal, keep: bool) -> Ensemble:
        """Room for so many orbits; SceneError where all states of all orbits would take too
        much.
        """
        if keep and bytes_needed(count, goal.steps, True) > HISTORY_MEMORY:
            room = f"more than {HISTORY_MEMORY >> 20} MB"
            raise SceneError(
                f"all states of {count} orbits of {goal.steps} steps take {room}; keep the ends"
                " only, or ask for fewer"
            )
        history = np.full((count, goal.steps + 1, 4), np.nan) if keep else None
        x, w, error_x, error_w = (np.empty(count) for _ in range(4))
        return Ensemble(
            x,
            w,
            error_x,
            error_w,
            np.zeros(count, np.int64),
            np.zeros(count, np.int64),
            np.zeros(count, np.uint8),
            history,
        )


def bytes_needed(count: int, steps: int, keep: bool = False) -> int:
    """What `follow` holds at most, beside the program itself: 49 bytes a state, one chunk's
    temporaries, and the history if asked for.

    >>> bytes_needed(10**6, 10**9) < 60_000_000
    True
    """
    return 49 * count + ROUND_MEMORY + (32 * count * (steps + 1) if keep else 0)


def follow(
    scene: Scene,
    goal: Goal,
    ensemble: Ensemble,
    report: Callable[[int, int], None] | None = None,
    chunk: int = CHUNK,
) -> None:
    """Follows all orbits of the scene, chunk by chunk, in place."""
    if float(np.float64(2.0**-1074) * np.float64(1.0)) == 0:
        raise SceneError(
            "this processor is set to flush small floats to 0, under which no bound holds"
        )
    count = scene.starts.count
    fixed = [Bounded.of(part) for part in formulas().fixed(scene.alpha)]
    with np.errstate(all="ignore"):
        for low in range(0, count, chunk):
            high = min(low + chunk, count)
            _Chunk(
                scene.alpha,
                goal,
                ensemble,
                low,
                scene.starts.block(low, high),
                (fixed[0], fixed[1]),
            ).run()
            ensemble.done = high
            if report is not None:
                report(high, count)


class _Chunk:
    """The orbits from number `low` on, those that are not at their end: `at` are their numbers."""

    def __init__(
        self,
        alpha: Fraction,
        goal: Goal,
        ensemble: Ensemble,
        low: int,
        block: tuple[Floats, Floats, Floats, Floats],
        fixed: tuple[Bounded, Bounded],
    ) -> None:
        self.alpha, self.goal, self.all, self.fixed = Bounded.of(alpha), goal, ensemble, fixed
        x, w, error_x, error_w = block
        self.x, self.w = Bounded(x, error_x), Bounded(w, error_w)
        self.at = np.arange(low, low + len(x))
        self.periods, self.impacts = np.zeros(len(x), np.int64), np.zeros(len(x), np.int64)

    def run(self) -> None:
        self._keep(np.ones(len(self.at), np.bool_))
        while len(self.at):
            self._round()

    @property
    def left(self) -> NDArray[np.int64]:
        """How many steps of the goal are left, for each orbit."""
        return self.goal.steps - (self.periods if self.goal.unit == "periods" else self.impacts)

    def _round(self) -> None:
        """One round: who is at the end, leaves; who strikes, is struck; who flies, flies to its
        next impact as far as that is certain.
        """
        map_ = formulas()
        margin = map_.margin(self.x, self.w)
        strikes, flies = margin.is_positive(), margin.is_negative()
        kept = map_.kept(self.alpha, self.w)
        caught = strikes & kept[0].is_positive() & kept[1].is_positive()
        end = np.where(strikes | flies, NOT_DONE, UNDECIDED)
        end[self.periods >= MOST_PERIODS] = UNDECIDED
        end[self.left <= 0] = REACHED
        if self.goal.until_trap:
            end[caught] = TRAP
        elif self.all.history is None:
            leaps = caught & (end == NOT_DONE)
            self._leap(leaps)
            end[leaps] = REACHED
        stays = end == NOT_DONE
        self._leave(end, stays)
        self._strike(strikes[stays])
        self._fly(flies[stays])

    def _leap(self, who: NDArray[np.bool_]) -> None:
        if not who.any():
            return
        x, w, left = self.x.at(who), self.w.at(who), self.left[who]
        power = powers(-self.alpha, left)
        number = Bounded(
            left.astype(np.float64), np.where(left < 1 << 53, 0.0, left * 2.0**-52)
        )  # whole floats are exact below 2^53
        x, w = formulas().later(x, w, *self.fixed, number, power)
        self.x.put(who, x)
        self.w.put(who, w)
        self.periods[who] += left
        self.impacts[who] += left

    def _leave(self, end: NDArray[np.int64], stays: NDArray[np.bool_]) -> None:
        if stays.all():
            return
        gone, to = ~stays, self.at[~stays]
        for whole, part in (
            (self.all.x, self.x.v),
            (self.all.w, self.w.v),
            (self.all.error_x, self.x.e),
            (self.all.error_w, self.w.e),
            (self.all.periods, self.periods),
            (self.all.impacts, self.impacts),
            (self.all.end, end),
        ):
            whole[to] = part[gone]
        self.x, self.w, self.at = self.x.at(stays), self.w.at(stays), self.at[stays]
        self.periods, self.impacts = self.periods[stays], self.impacts[stays]

    def _strike(self, who: NDArray[np.bool_]) -> None:
        if not who.any():
            return
        x, w = formulas().impact(self.alpha, self.x.at(who), self.w.at(who))
        self.x.put(who, x)
        self.w.put(who, w)
        self.periods[who] += 1
        self.impacts[who] += 1
        self._keep(who)

    def _fly(self, who: NDArray[np.bool_]) -> None:
        if not who.any():
            return
        x, w = self.x.at(who), self.w.at(who)
        length = certain_flights(x, w)
        if self.goal.unit == "periods":
            np.minimum(length, self.left[who], out=length)
            if self.all.history is not None:
                length[:] = 1
        x, w = formulas().flight(x, w, Bounded(length.astype(np.float64), 0.0))
        self.x.put(who, x)
        self.w.put(who, w)
        self.periods[who] += length
        if self.goal.unit == "periods":
            self._keep(who)

    def _keep(self, who: NDArray[np.bool_]) -> None:
        """Adds the states to the history; its places are periods, or impacts."""
        if self.all.history is not None:
            slot = (self.periods if self.goal.unit == "periods" else self.impacts)[who]
            rows = np.stack([self.x.v[who], self.w.v[who], self.x.e[who], self.w.e[who]], axis=1)
            self.all.history[self.at[who], slot] = rows


def certain_flights(x: Bounded, w: Bounded) -> NDArray[np.int64]:
    """For states that are proved to fly on: a number K >= 1 of periods that certainly have no
    impact, the whole flight where the bound can tell.

    The margin after k periods is a convex parabola in k, negative at k = 0: where it is proved not
    to be positive at K - 1, it is not between.
    """
    map_ = formulas()
    b, square = map_.end_of_flight(x, w)
    guess = np.floor((np.sqrt(np.maximum(square.v, 0)) - b.v) / 2) + 1
    guess = np.fmax(np.fmin(guess, MOST_PERIODS / 4), 1)  # 1 where it is not a number
    length = np.ones(len(guess))
    for wish in (
        np.floor(guess * (1 - 2.0**-20)),
        guess - 1,
        guess,
    ):  # the last that is certain stays
        wish = np.maximum(wish, 1)
        sure = map_.margin(*map_.flight(x, w, Bounded(wish - 1, 0.0))).is_negative()
        length = np.where(sure & (wish > length), wish, length)
    found: NDArray[np.int64] = length.astype(np.int64)
    return found
