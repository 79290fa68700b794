"""The map of the juggler period by period in Fractions, written out here once more."""

from __future__ import annotations

from fractions import Fraction

State = tuple[Fraction, Fraction]


def flights_of(alpha: Fraction, state: State, count: int) -> list[int]:
    """The lengths of so many flights: periods from one impact to the next."""
    (x, w), flights, since = state, [], 1
    while len(flights) < count:
        if x < w:
            flights.append(since)
            x, w, since = alpha * (w - x), 2 - alpha * w, 1
        else:
            x, w, since = x - w, w + 2, since + 1
    return flights


def word_of(alpha: Fraction, state: State) -> tuple[int, ...]:
    """The word that the flights repeat after some hundreds of impacts, from its least rotation."""
    flights = flights_of(alpha, state, 700)[-200:]
    m = next(m for m in range(1, 100) if flights[m:] == flights[:-m])
    word = tuple(flights[-m:])
    return min(word[k:] + word[:k] for k in range(m))
