"""The constants that steer judging: what each limits, and its value.

They were made for the paper's claims, and those of enclosures on `bound`.  Other values were not
measured.  Work is counted in the units of `statements.work`.
"""

from __future__ import annotations

from fractions import Fraction

DEFAULT_BUDGET = 2_000_000  # work for a statement or an SMT-LIB problem, unless the user says
QUICK_WORK = 150_000  # for a certificate that a range or a reading needs on the way
TRIAL_SHARE = 10  # a look for a contradiction, simple values or a correction gets this part
SHARP_FACTOR = 3  # a sharp range takes many proofs and families, each within the budget
TRIAL_VALUES = 4  # of the parameter, in simple counterexamples
TRIAL_DENOMINATOR = 32  # of these, at most
PLAIN = 16  # numerators and denominators up to here are simple
END_BITS, END_DISTANCE = (
    32,
    Fraction(1, 10**6),
)  # of an irrational end: enclosure, rational inside

# Enclosures of a minimum on a box.
BOXES = 20_000  # where the user says no other number
SQUARES_WORK = 1_000_000  # for squares times facts
STAGES = ((1, 0, True), (1, 0, False), (2, 0, False), (1, 2, True))  # as in `search.limits`
MOST_PRODUCTS = 10**6  # of the product of all degree + 1 and their sum
MOST_DEGREE = 60  # in one variable
MOST_VALUE = 10**100  # of a term on the box, which floats still hold

# What is kept of results between runs.
KEPT_FILES = 8  # with the same prefix, each for one state of the sources
KEPT_BYTES = 50_000_000  # of one file
