"""The drives that a feeder may have: for intervals of restitution, the drives, and the amplitudes
at some frequencies, for which stored certificates prove that every motion comes to the bounce.

    python -m juggleproof.benchmarks.feeder
    python -m juggleproof.benchmarks.feeder --accept     # writes the table into the page

The certificates are read; `python -I -S certificates/sine certificates/sine/wide` checks them.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import ceil, floor

from juggleproof.benchmarks.generated import DOCS, Generated, in_columns
from juggleproof.certificates.sine.cells import Attraction
from juggleproof.certificates.sine.checker import Rectangle, outcome
from juggleproof.certificates.sine.flights import ONE, PI2, Interval
from juggleproof.command.sine import GRAVITY, interval
from juggleproof.scenes.table.curves import birth, doubling
from juggleproof.sine.stored import WIDE, boxes_in

TABLE = Generated(DOCS / "sine.md", "feeder")
ALPHAS = (
    "0:0.02 0.01:0.03 0.02:0.04 0.03:0.05 0.04:0.06 0.05:0.07 0.06:0.08 0.07:0.09 0.08:0.1 0.1:0.12"
).split()
HERTZ = 25, 50
STEP = Fraction(1, 1000)  # of Gamma, and of an amplitude in mm
COARSE = 20  # steps between the values of Gamma that are tried first


def drives(alpha: Interval, proved: Sequence[Attraction]) -> Interval | None:
    """The ends, multiples of STEP, of an interval of Gamma that boxes cover for all of these
    restitutions: the lowest one, as long as it can be; None if there is none.
    """

    def covered(low: int, high: int) -> bool:
        rectangle = Rectangle("", alpha, "Gamma", (low * STEP, high * STEP))
        return outcome(rectangle, proved)[0] == "certified"

    below, above = floor(birth(float(alpha[1])) / STEP), ceil(doubling(float(alpha[0])) / STEP)
    inside = next((k for k in range(below, above, COARSE) if covered(k, k)), None)
    if inside is None:
        return None
    low = below + bisect_left(range(below, inside), True, key=lambda k: covered(k, inside))
    after = bisect_left(range(inside, above), True, key=lambda k: not covered(inside, k))
    return low * STEP, (inside + after - 1) * STEP


def amplitudes(gamma: Interval, hertz: int) -> Interval:
    """The amplitudes A in mm between which Gamma = 4 pi^2 f^2 A/9.80665 m/s^2 surely lies in the
    interval, rounded inward to multiples of STEP.

    >>> low, high = amplitudes((Fraction(3), Fraction(3)), 25)
    >>> low == high + STEP and (low + high) / 2 == Fraction("1.1925")
    True
    """
    low, high = (
        1000 * one * GRAVITY / (Fraction(turn, ONE) * hertz) ** 2
        for one, turn in zip(gamma, (PI2, PI2 + 1))
    )
    return ceil(low / STEP) * STEP, floor(high / STEP) * STEP


def rows() -> Iterator[tuple[str, ...]]:
    """The table, with its head."""
    yield "restitution", "Gamma", *(f"mm at {hertz} Hz" for hertz in HERTZ)
    proved = boxes_in(WIDE)
    for alpha in ALPHAS:
        gamma = drives(interval(alpha, "--alpha"), proved)
        if gamma is None:
            raise RuntimeError(f"no drive is certified for all restitutions in {alpha}")
        mm = (amplitudes(gamma, hertz) for hertz in HERTZ)
        yield alpha.replace(":", " to "), *map(between, [gamma, *mm])


def between(ends: Interval) -> str:
    """An interval between multiples of STEP, in decimals."""
    return " to ".join(f"{float(end):.3f}" for end in ends)


def table() -> str:
    """The table as the page has it."""
    return in_columns(*rows())


if __name__ == "__main__":
    TABLE.main(table)
