"""The first time at which one of several gaps falls to 0, found so that none can be skipped: pieces
of time are halved until each is decided.

With |gap''| <= M, at the middle m of a piece of half-width h:
gap(m) - |gap'(m)| h - M h^2/2 > 0 leaves no root in it; |gap'(m)| > M h makes the gap rise or fall
through all of it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from juggleproof.scenes.part.reference.stops import Undecided

Gaps = Callable[[Any], list[tuple[Any, Any]]]  # the gaps at a time, each with its rate
MOST_STEPS = 1000


def first_crossing(
    gaps: Gaps, bound: Any, start: Any, end: Any, noise: Any
) -> tuple[Any, int] | None:
    """The first time from start to end at which a gap falls from above 0 to 0, and which one; none
    where there is no such time.

    Numbers closer than the noise are not told apart: a gap that touches 0 so closely is undecided.

    >>> from mpmath import mpf
    >>> first_crossing(lambda t: [(2 - t, -1), (3 - 2 * t, -2)], 0, mpf(0), mpf(8), mpf("1e-9"))
    (mpf('1.5'), 1)
    >>> touching = lambda t: [((t - 2)**2 + mpf("0.001"), 2 * (t - 2))]
    >>> first_crossing(touching, 2, mpf(0), mpf(8), mpf("1e-9"))
    """
    everyone = list(range(len(gaps(start))))
    pieces = [(start, end, everyone)]
    while pieces:
        left, right, watched = pieces.pop()
        half = (right - left) / 2
        middle = left + half
        falling, unclear = _sorted_out(gaps(middle), watched, bound, half, noise)
        if unclear:
            if bound * half**2 < noise:
                raise Undecided(f"a corner grazes the table near t = {middle}")
            pieces += [(middle, right, falling + unclear), (left, middle, falling + unclear)]
            continue
        there = gaps(right) if falling else []
        crossings = [
            (crossing(gaps, one, left, right, noise), one) for one in falling if there[one][0] <= 0
        ]
        if crossings:
            return min(crossings)
    return None


def _sorted_out(
    here: list[tuple[Any, Any]], watched: list[int], bound: Any, half: Any, noise: Any
) -> tuple[list[int], list[int]]:
    """Those of the watched gaps that fall through all of the piece, and those that are not decided;
    the others do not fall to 0 in it.
    """
    falling, unclear = [], []
    for one in watched:
        gap, rate = here[one]
        if gap - abs(rate) * half - bound * half**2 / 2 > noise:
            continue
        if abs(rate) - bound * half <= noise:
            unclear.append(one)
        elif rate < 0:
            falling.append(one)
    return falling, unclear


def crossing(gaps: Gaps, one: int, left: Any, right: Any, width: Any) -> Any:
    """The root of a gap that falls from above 0 to below, from the side where it is above, to this
    width (the Illinois method).

    >>> from mpmath import mpf
    >>> crossing(lambda t: [(1 - t**2, -2 * t)], 0, mpf(0), mpf(3), mpf("1e-15")) - 1 < mpf("1e-15")
    True
    """
    above, below = gaps(left)[one][0], gaps(right)[one][0]
    if not above > 0 >= below:
        raise Undecided(
            f"no corner is known to be above the table at t = {left} and below it at t = {right}"
        )
    if below == 0:
        return right
    moved = 0
    for _ in range(MOST_STEPS):
        if right - left <= width:
            return left
        guess = right - below * (right - left) / (below - above)
        if not left < guess < right:
            guess = (left + right) / 2
        gap = gaps(guess)[one][0]
        if gap == 0:
            return guess
        if gap > 0:
            left, above, below = guess, gap, below / 2 if moved > 0 else below
        else:
            right, below, above = guess, gap, above / 2 if moved < 0 else above
        moved = 1 if gap > 0 else -1
    raise Undecided(f"the root near t = {left} is not found to the width {width}")
