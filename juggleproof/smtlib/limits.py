"""The constants that steer the reading of SMT-LIB scripts: what each limits, and its value.

They were made for the scripts in `examples`, and for scripts that are too large, deep or long.
Other values were not measured.
"""

from __future__ import annotations

from collections import defaultdict

SIDE_WORK = 100_000  # for the proof that a divisor is not 0
MOST_STEPS = 2_000_000  # terms that are read; the body of a function counts at each application
LARGEST_POWER, LONGEST_NUMBER = 100, 1000  # exponent, and signs of a number
MOST_CASES = 64  # of the values of a term together
MOST_DEGREE = 1000  # when definitions are put in
MANY = 10**9  # larger sizes are replaced by this
DEEPEST = 60  # Python's parser, by which the checker reads, takes 200 nested parentheses
# by operation of a formula, "" for terms; a conjunction may be an assertion as a whole
MOST_SYMBOLS = defaultdict(lambda: 1000, {"": 4000, "and": 20_000})
LARGE_FORMULA, LARGE_CONDITION = 250, 100  # symbols, from which on a part gets a name
