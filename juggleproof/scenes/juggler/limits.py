"""What orbits tend to: the periodic orbit of each state, proved, or undecided.

Let an orbit be at a state z, just before an impact, and let e be the state that comes back with the
word of its last flights.  As long as the orbit keeps to that word, j impacts and N periods later it
differs from the orbit of e by (-alpha)^j (p - N q, q), where (p, q) = z - e: the matrix of an
impact and n further periods is -alpha ((1, -n - 1), (0, 1)).  With K the longest flight of the
word, N <= j K and j alpha^j <= alpha + alpha^2 + .. = alpha/(1 - alpha), so that the entries of the
difference never exceed

    P = |p| + K alpha/(1 - alpha) |q|  and  Q = |q|,

and w - x changes by at most P + Q before an impact, and by at most alpha (P + (n + 2) Q) n periods
after one.  Where the orbit of e meets the conditions of its word with that much to spare, z keeps
to the word for ever, and tends to the orbit of e.  This is decided in float64 with bounds; for
states whose branch floats cannot tell, such as those on x = w, in exact rationals.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from flint import fmpq
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.bounded import (
    EXACT,
    MOST_PERIODS,
    Booleans,
    Bounded,
    certain_flights,
    refuse_flushing,
)
from juggleproof.scenes.juggler.compiled_map import formulas, nearest
from juggleproof.scenes.juggler.exact import Exact, as_fraction, lifted
from juggleproof.scenes.juggler.periodic import Place, Word, returning_state
from juggleproof.scenes.juggler.starts import Starts
from juggleproof.scenes.juggler.track import certain_flight

# -------------------------------------------------------------------------------------------------
# When an orbit keeps the flights of a word for ever.

F = TypeVar("F", Bounded, fmpq)  # numbers: floats with bounds, or python-flint's rationals
LONGEST = 128  # flights of a word
UNDECIDED = -1
Report = Callable[[int, int], None]  # how many orbits are done, of how many


class Slack(NamedTuple, Generic[F]):
    """What an orbit and all that follow it have to spare: at each impact of its word, and in the
    first and in the last period of the flight after it; the latter two mean nothing where the
    flight is of one period.
    """

    strikes: list[F]
    flies: list[tuple[F, F]]


def slack(
    alpha: F, x: F, w: F, word: Sequence[F] | Sequence[int], longest: F | int, zero: F
) -> Slack[F]:
    """The least slack of the orbit from this state, just before the impact that begins the word: it
    keeps to the word for ever if the slack is > 0 at impacts and >= 0 in flights.

    >>> half, two = fmpq(1, 2), fmpq(2)
    >>> held = slack(half, fmpq(4, 9), fmpq(8, 3), [two], two, fmpq(0))
    >>> str(held.strikes[0]), [str(one) for one in held.flies[0]]
    ('20/9', ['4/9', '4/9'])
    """
    map_ = formulas()
    here = returning_state(alpha, word, zero)
    q = abs(w - here[1])
    p = abs(x - here[0]) + longest * alpha / (1 - alpha) * q
    found: Slack[F] = Slack([], [])
    for periods in word:
        found.strikes.append(map_.margin(*here) - p - q)
        struck = map_.impact(alpha, *here)
        last = map_.flight(*struck, periods - 2)
        # along a flight w - x is convex in time: between first and last period it is not greater
        found.flies.append(
            (
                -map_.margin(*struck) - alpha * (p + 2 * q),
                -map_.margin(*last) - alpha * (p + periods * q),
            )
        )
        here = map_.flight(*struck, periods - 1)
    return found


def repeats(flights: NDArray[np.int64], m: int) -> Booleans:
    """Which rows end with the same m flights twice, if these are no repetition of fewer.

    >>> [repeats(np.array([[3, 2, 2, 3, 2, 2], [2, 2, 2, 2, 2, 2]]), m).tolist() for m in (1, 2, 3)]
    [[True, True], [False, False], [True, False]]
    """
    word = flights[:, -m:]
    found: Booleans = flights[:, -1] == flights[:, -1 - m]
    found[found] = (word[found] == flights[found, -2 * m : -m]).all(axis=1)
    for part in range(1, m // 2 + 1):
        if m % part == 0 and found.any():
            found[found] = (word[found] != np.roll(word[found], part, axis=1)).any(axis=1)
    return found


def least_rotation(word: Word) -> Word:
    """The name of a word: the least of its rotations.

    >>> least_rotation((2, 3, 1))
    (1, 2, 3)
    """
    return min(word[k:] + word[:k] for k in range(len(word)))


# -------------------------------------------------------------------------------------------------
# The limits of many states.

MOST_STATES = 4 * 10**6
CHUNK = 1 << 14  # states that move together
# how many impacts have passed when the flights are compared; the last number is the most allowed
TESTS = tuple(16 << k for k in range(9))
MEMORY = 2 * LONGEST  # flights that are kept of an orbit
MOST_EXACT = 64  # impacts in exact numbers


@dataclass
class Limits:
    """The limits of all starts at all alpha: `which` has shape (alphas, starts), places in `words`,
    -1 where it is undecided; `exact` is how many orbits took exact rationals.
    """

    alphas: tuple[Fraction, ...]
    which: NDArray[np.int64]
    words: list[Word] = field(default_factory=list)
    exact: int = 0

    def place(self, word: Word) -> int:
        """The place of a word, which is added where it is new."""
        name = least_rotation(word)
        if name not in self.words:
            self.words.append(name)
        return self.words.index(name)

    def counts(self) -> Counter[int]:
        """How many orbits tend to each place; -1: undecided."""
        return Counter(self.which.ravel().tolist())

    def span(self, places: Sequence[int]) -> tuple[int, Fraction, Fraction] | None:
        """How many orbits tend to one of these places, and the first and the last alpha at which
        any does; None where none does.
        """
        here = np.isin(self.which, places)
        at = np.flatnonzero(here.any(axis=1))
        return (int(here.sum()), self.alphas[at[0]], self.alphas[at[-1]]) if len(at) else None


def limits(alphas: Iterable[Fraction], starts: Starts, report: Report | None = None) -> Limits:
    """What the orbits of all starts tend to at all alpha; raises SceneError for too many.

    >>> from juggleproof.scenes.juggler import listed
    >>> found = limits([Fraction(1, 4), Fraction(1, 2)], listed([(0, 1), ("4/9", "8/3")]))
    >>> [[found.words[place] for place in row] for row in found.which]
    [[(1,), (1,)], [(1,), (2,)]]
    """
    found = tuple(alphas)
    total = len(found) * starts.count
    if not 1 <= total <= MOST_STATES:
        raise SceneError(
            f"{starts.count} starts at {len(found)} alpha are outside 1 .. {MOST_STATES} orbits;"
            " give fewer"
        )
    refuse_flushing()
    result = Limits(found, np.full((len(found), starts.count), UNDECIDED))
    numbers = np.array([nearest(alpha) for alpha in found]).T
    x, w, error_x, error_w = starts.block(0, starts.count)

    def follow(places: NDArray[np.int64], x: Bounded, w: Bounded) -> list[int]:
        alpha = Bounded(*(one[places // starts.count] for one in numbers))
        with np.errstate(all="ignore"):
            return _LimitsChunk(result, places, alpha, x, w).run(report)

    unsure: list[int] = []
    for low in range(0, total, CHUNK):
        places = np.arange(low, min(low + CHUNK, total))
        some = places % starts.count
        unsure += follow(places, Bounded(x[some], error_x[some]), Bounded(w[some], error_w[some]))
    result.exact = len(unsure)
    further = {
        place: state
        for place in unsure
        if (state := _exactly(result, place, starts.exact(place % starts.count)))
    }
    if further:
        pairs = np.array([[nearest(part) for part in state] for state in further.values()])
        one, two = (Bounded(pairs[:, k, 0], pairs[:, k, 1]) for k in (0, 1))
        follow(np.array(list(further)), one, two)
    return result


class _LimitsChunk:
    """The orbits with these places, as far as their limits are not known."""

    def __init__(
        self, found: Limits, at: NDArray[np.int64], alpha: Bounded, x: Bounded, w: Bounded
    ) -> None:
        self.found, self.at, self.alpha, self.x, self.w = found, at, alpha, x, w
        self.since, self.impacts = np.zeros(len(at), np.int64), np.zeros(len(at), np.int64)
        self.flights = np.zeros((len(at), MEMORY), np.int64)  # the last is at impacts - 1, modulo
        self.unsure: list[int] = []

    def run(self, report: Report | None) -> list[int]:
        """Follows them; returns the places of those whose branch floats cannot tell."""
        for count in range(TESTS[-1] + 1):
            if not len(self.at):
                break
            self._round(count in TESTS)
            if report is not None and count % 64 == 0:
                which = self.found.which
                report(int(np.count_nonzero(which != UNDECIDED)), which.size)
        return self.unsure

    def _round(self, test: bool) -> None:
        """Carries out one impact of each orbit, of most of them after a flight; before it, if
        `test`, the orbits whose limit is proved leave.
        """
        map_ = formulas()
        flies = map_.margin(self.x, self.w).is_negative()
        if flies.any():
            x, w = self.x.at(flies), self.w.at(flies)
            length = certain_flights(x, w)
            x, w = map_.flight(x, w, Bounded(length.astype(np.float64), EXACT))
            self.x.put(flies, x)
            self.w.put(flies, w)
            self.since[flies] += length
        margin = map_.margin(self.x, self.w)
        strikes = margin.is_positive()
        lost = ~(strikes | margin.is_negative())
        self.unsure += self.at[lost].tolist()
        self.flights[strikes, self.impacts[strikes] % MEMORY] = self.since[strikes] + 1
        self.since[strikes] = 0
        self.impacts[strikes] += 1
        known = self._settled(strikes) if test else np.zeros(len(self.at), np.bool_)
        if (known | lost).any():
            stays = ~(known | lost)
            self.at, self.since, self.impacts = (
                self.at[stays],
                self.since[stays],
                self.impacts[stays],
            )
            self.alpha, self.x, self.w = (part.at(stays) for part in (self.alpha, self.x, self.w))
            self.flights, strikes = self.flights[stays], strikes[stays]
        x, w = map_.impact(self.alpha.at(strikes), self.x.at(strikes), self.w.at(strikes))
        self.x.put(strikes, x)
        self.w.put(strikes, w)

    def _settled(self, strikes: Booleans) -> Booleans:
        """Which of the orbits about to be struck have a proved limit; the limits are recorded."""
        known = np.zeros(len(self.at), np.bool_)
        rows = np.flatnonzero(strikes)
        back = np.arange(-MEMORY, 0)
        last = self.flights[rows[:, None], (self.impacts[rows, None] + back) % MEMORY]
        for m in range(1, LONGEST + 1):
            again = repeats(last, m) & (self.impacts[rows] >= 2 * m)
            if not again.any():
                continue
            some, flights = rows[again], last[again, -m:]
            word = [Bounded(one, EXACT) for one in flights.T.astype(np.float64)]
            held = slack(
                self.alpha.at(some),
                self.x.at(some),
                self.w.at(some),
                word,
                Bounded(flights.max(axis=1).astype(np.float64), EXACT),
                Bounded(np.array(0.0), EXACT),
            )
            sure = flights.max(axis=1) < MOST_PERIODS  # which are whole floats
            for one in held.strikes:
                sure &= one.is_positive()
            for one, pair in zip(flights.T, held.flies):
                sure &= (one == 1) | (pair[0].is_positive() & pair[1].is_positive())
            known[some[sure]] = True
            words, which = np.unique(flights[sure], axis=0, return_inverse=True)
            places = np.array([self.found.place(tuple(one)) for one in words.tolist()], np.int64)
            self.found.which.flat[self.at[some[sure]]] = places[which.ravel()]
            rows, last = rows[~known[rows]], last[~known[rows]]
        return known


def _exactly(found: Limits, at: int, start: Place) -> Place | None:
    """Records the limit of the orbit with this place, in exact rationals.  If some dozens of
    impacts do not decide it, returns the state after them.
    """
    alpha_at = found.alphas[at // found.which.shape[1]]
    map_, numbers, alpha = formulas(), Exact(alpha_at), lifted(alpha_at)
    here = lifted(start[0]), lifted(start[1])
    flights: list[int] = []
    while len(flights) < MOST_EXACT:
        since = 1
        while map_.margin(*here) <= 0:
            length = certain_flight(numbers, *here)
            here, since = map_.flight(*here, length), since + length
        flights.append(since)
        if len(flights) in TESTS:
            for m in range(1, len(flights) // 2 + 1):
                word = flights[-m:]
                if repeats(np.array([flights]), m)[0] and _keeps(
                    slack(alpha, *here, word, max(word), fmpq(0)), word
                ):
                    found.which.flat[at] = found.place(tuple(word))
                    return None
        here = map_.impact(alpha, *here)
    return as_fraction(here[0]), as_fraction(here[1])


def _keeps(held: Slack[fmpq], word: Sequence[int]) -> bool:
    return min(held.strikes) > 0 and all(
        periods == 1 or min(pair) >= 0 for periods, pair in zip(word, held.flies)
    )
