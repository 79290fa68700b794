"""The constants that steer the votes: what each limits, and its value.

They were made for the paper's claims; other values were not measured.
"""

from __future__ import annotations

from fractions import Fraction

MOST_BRANCHES = 64  # of a disjunction
MOST_TRIES = 16  # replacements of powers of roots by their neighbours
ROOT_BITS = 12  # after the point, of the ends between which a root is written

# Boxes.
TRIAL = 24  # spent on an unbounded region: only an exact point there counts
TRIAL_SIDE = Fraction(8)  # of a box in place of an unbounded region
MOST_SAMPLES, ENOUGH_SAMPLES = 128, 8  # points of a region that are tried, and that are kept
SAMPLES = tuple(map(Fraction, "1/4 1 1/8 0 2 1/2 3/2 -1 3 7 5/4 -3".split()))  # of a variable
ROUNDS = 4  # of narrowing all bounds
SHIFTS = 6  # doublings of a bound beyond which a fact fails
SLICES = 12  # of one bound: a solution at the far end could be neared for ever
GRID = 16  # bits of a bound after rounding outwards
SHORT = 48  # bits of a bound that is not rounded
