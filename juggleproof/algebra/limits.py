"""The constants that steer the algebra: what each limits, and its value.

A word in brackets names the inputs for which a limit was made, and "never" marks one that stopped
nothing, as in `search.limits`.  Other values were not measured.
"""

from __future__ import annotations

PRECISION = 64  # bits of balls [claims]
TREE_DENOMINATORS = (1, 2, 12, 120, 1000, *(10**k for k in (4, 6, 8, 10, 13, 16, 20)))  # [bound]
MOST_LETTERS = 240  # of the tree of a polynomial in one variable [claims]
MOST_TERMS = 4000  # of a polynomial; a longer one is dropped, with candidates that it has [never]
MOST_FIELD_DEGREE = 64  # of a product of fields [problems, never]
FIELD_WORK = 10**9  # units, for the field of one point [problems]
MULTIPLES = (1, -1, 2, -2, 3, -3, 5, -5, 7, 11)  # of a second root, for a primitive one [problems]

# Semidefinite programs in floats [problems].
DUAL_STEPS = 60  # of one program; the search for a solution ends before
ENOUGH = 1e-6  # what equations may miss
DEPENDENT = 1e-13  # an eigenvalue of equations that depend on others
LARGE = 1e9  # a solution that floats do not find
HARDLY = 1e-6  # a cost of the trace below which rounding drives the dual value
TOLERANCE = 2e-3  # of a small fraction: eigenvectors of singular matrices are no better known
