"""The constants that steer the searches: what each limits, and its value.

They were set on the maps in `examples`, and on 37 more that others brought.  A comment in brackets
names the map that comes closest to a limit, with what it takes.  Work is counted in the units of
`statements.work`; a unit at the effort of squares counts SQUARES_COST times, and a premise may
end above its limit by that factor.

All limits of work, most of those on how many are tried, and some numbers of samples were halved at
once for all of these maps.  Five outcomes changed: hassell and hassell-rate lost the end of their
domain; coupled-logistic, drag-ball-one and sir-endemic came out as unknown.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from juggleproof.search.closing import SQUARED

# -------------------------------------------------------------------------------------------------
# Counted work.

PREMISE_WORK = 2_000_000  # for a premise, or what --budget says (saturated-filter: 223,015)
MAP_WORK = 12_000_000  # for a map (drag-ball: 8,455,345)
REFUTATION_WORK = 2_000_000  # after that, for refutations, and again for what holds in part
FAMILY_WORK = 4_000_000  # for the candidates that fit samples
BOX_WORK = 300_000  # for a premise of most families (goodwin: 119,642)
TWO_SIDED_WORK = 40_000  # for a premise of two-sided functions (drag-ball-one: 27,162)
TWO_SIDED_AGAIN_WORK = 600_000  # for the same after two rounds below (no map needs it)
ENVELOPE_WORK = 4_000_000  # for a premise of an envelope or contracting box (hassell: 4,240,112)
LOCAL_WORK = 200_000  # for a premise of a norm close to the point (henon-attractors: 203,933)
GROWTH_WORK = 2_000_000  # for all functions that grow
GROWTH_ROUNDS = (  # efforts and work for one of these
    ((1, 2), 50_000),  # (lozi-attractor: 31,229)
    ((1, 2, SQUARED), 400_000),  # (maynard-smith-slatkin: 320,171)
)
ROUNDS = (  # efforts and work for a candidate that fits samples, and how many candidates get them
    ((1,), 20_000, 24),  # (cubic: 32,887)
    ((1, 2), 50_000, 12),  # (fire: 39,144, at the first of them, as is sis-epidemic)
    ((1, 2, SQUARED), 100_000, 6),  # (no map needs these)
    ((1, 2, SQUARED), 400_000, 4),
)
LEAF_WORK = 500_000  # for a case of signs
SHORT_WORK = 60_000  # for the same, where there is something else to try
FEW_FACTS_WORK = 100_000  # for a proof from few facts
SQUARES_WORK = 1_000_000  # for sums of squares without what is given of the next state
POINT_WORK = 200_000  # for a statement about a point that is a parameter
EMPTY_PIECE_WORK = 20_000  # for the statement that no state is in a piece
SQUARES_COST = 8  # units of work for one at the effort of squares
LONG_SEARCH = 300_000  # work, before which Z3 is asked for a counter-model
VOTE = 50_000  # Z3's limit of resources for that

# -------------------------------------------------------------------------------------------------
# How many are tried.

TRIED = 2  # candidates of one form, those that fit best
TRIED_OF_FAMILY = 3  # candidates of a family (drag-ball-one: the third)
ENVELOPES = 4  # candidates with an envelope (on all maps the first one is certified)
MOST_REFUTED = 3  # fixed points
MOST_RATES = 6  # rates of growth
MOST_STATES = 3  # state variables of ratios, boxes and Lyapunov equations
MOST_SHIFTS = 2  # divisors of a map that ratios take their origin from
MOST_ROWS = 24  # rows of a norm, before those that others span are left out (anti-windup)
CORNERS = 24  # parameters at which rows of a norm are carried back
MOST_WORST_PART = 8.0  # rank of a part metric
MOST_WORST_SUM = 4.0  # rank of a weighted sum
MOST_SIZE = 400  # characters of the matrix that weights of ratios come from
MOST_CONSTANT = 80  # characters of a constant
MOST_SHARES = 6  # shares of V that constants are products of
TOGETHER = 3  # factors of a constant of a contracting box
POWERS = ((3, (2, 4)), (6, (1, 4)), (9, (1, 2)), (np.inf, (0, 0)))
HIGH_POWERS = ((2, (6, 6)), (np.inf, (0, 0)))  # (most factors, (exponent and sum of them at most))
MOST_DEGREE = 12  # degree of the equation of a fixed point
MOST_ZEROS = 40  # solutions of the equations of a fixed point, by their degrees
MOST_POINTS = 100  # ends of a domain, or values of variables that are free
MOST_PERIOD = 12  # period of an orbit
MOST_AFFINE_WORDS = 300  # words of affine pieces
MOST_ORBITS = 200  # orbits that stray
MOST_WORDS = 4  # words of orbits that stray
MOST_WORDS_SOLVED = 12  # words whose orbits are sought in exact terms
MOST_TERMS = 60  # terms of the equations of an orbit; elimination has no other bound
MOST_SOLUTIONS = 9  # solutions of these equations, by their degrees
MOST_POWER = 100  # exponent in a map; SymPy takes too long with larger ones
MOST_COLUMNS = 1500  # columns of a program of products for two-sided functions
MOST_SIGNS = 3000  # samples at which signs of factors are looked at

# -------------------------------------------------------------------------------------------------
# Samples.

PARAMETERS = 150  # of the parameters
STATES = 40  # states at each of them
STATES_NEAR = 60  # states close to the point, or of a box, at each of them
STATES_MANY = 200  # states at each of them, where few constants depend on all
TEST_PARAMETERS, TEST_STATES = 500, 20  # samples that coefficients are tested at
NORM_STATES = 4000  # states of norm 1, for how far a norm is contracted
PIECE_STATES = 1000  # states, at which pieces apply that are not empty
DRAWS = 40  # rounds of drawing, after which fewer samples than were asked for are taken
SPREAD = 2.5  # variables without an end run from 10^-SPREAD to 10^SPREAD
SIZES = np.logspace(-3, 3, 48)  # distances, relative to those of the point from an end
END_SHARE = 0.3  # share of the states that are put at an end
BOX_SHARES = (1e-6, 1 - 1e-6, 0.5, -1.0)  # of the side of a box, for states; -1: a random share
GROWTH_SHARES = (-1, -0.5, -0.1, 0.1, 0.5, 1)  # of a radius, at which growth is looked at
THINNED = 4  # every fourth state is used in the first program of a weighted sum
SETTLE, STRAY = 400, 1e-3  # steps before an orbit is looked at; distance that is no convergence
FAR_END, NEAR_END = 64.0, 1e-3  # reach of a search for an end, in steps; share of the way left
END_HALVINGS = 30  # halvings of that search
FREE_VALUES = ("0", "1/2", "1", "-1/2", "-1", "2", "-2", "1/4", "-1/4")  # of variables

# -------------------------------------------------------------------------------------------------
# What counts as rounding, as small or as close.

ROUNDING = 1e-9  # relative, of values, determinants and imaginary parts
PROGRAM_TOLERANCE = 1e-7  # HiGHS's own, and of a margin
NEARLY_FIXED = 1e-6  # of a state
FALL_ROUNDING = 1e-11  # of a value, by which an envelope falls
GROWTH_ROUNDING = 1e-3  # of a growth
DIGITS = 1e-8  # rounding of the point over a distance to it, above which samples say nothing
POINT_ROUNDINGS = 1e4  # times the rounding of the point: closer to it, samples say nothing
END_CLOSE = 1e-6  # of the distance to an end
FEW = 0.25  # of the parameters
SMALL_GAP = 1e-4  # distance at which higher terms do not count
SMALL_BOUND = 0.01  # of the greatest value of a bound, for saturated maps
SMALL_SCALE = 0.1  # the same, for weighted sums
SMALL_VALUE = 1e-3  # of V, where a piece is taken to reach the point
BOX_FAR = 1e-3  # of the greatest value of V, above which its fall is not rounding
SMALLEST = 1e-5  # constant
FEW_FOLD = 3  # powers of e over which a constant may vary and be taken as a number
LOOSE = 4.0  # rank of a constant, above which the fall at the end itself is taken
LEFT = 0.75  # share of the greatest constant that samples allow, which is taken
PART_LEFT = 0.375  # the same, of a part metric: facts bound the point less closely
GROWTH_LEFT = 0.5  # the same, of a growth

# -------------------------------------------------------------------------------------------------
# What is tried, in order.

DENOMINATORS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 32, 64, 100, 256, 1000)  # of coefficients
ROW_DENOMINATORS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 50, 100)  # of a norm's rows
PROGRAM_ROWS = 300  # rows that a linear program begins with; those that it breaks are added
TURNS = 6  # of adding the samples that are missed
ORDERS = (2, 4)  # of a loss in the distance: 4 at a multiplier on the unit circle
LOSS_POWERS = (0, 1, 2)  # of 1 + V, that such a loss is divided by
VALUE_POWERS = (0, 1)  # the same, of a loss in V
LOSS_SHAPES = ((1, 0), (1, 1))  # (k, j) for losses V^k/(1 + V)^j
SLOW_LOSS_SHAPES = ((2, 1), (3, 2))  # the same, where the multiplier is 1
SIDE_POWERS = (0, 1, 2)  # of a bound, that a side is divided by
SLOPES = (0, 1, 2, 3)  # of the involutions that are tried for all maps
MEANS = ((0, 1), (1, 1), (3, 1))  # (p, q): 1/c = (p + q l)/(p + q), where -l is the slope at e
WEIGHTS = ("1", "9/10", "3/4", "2/3", "1/2", "1/4")  # of the distances of a part metric
SWEEPS = 3  # over all of these
RATE_SHARES = (0.5, 0.75, 0.9, 0.97)  # of the way from the spectral radius to 1, for a rate
SLOWEST = Fraction(1, 256)  # fall, as a share of a norm
LOCAL_SHARES = (Fraction(1), Fraction(1, 2), Fraction(1, 8))  # of a norm that samples allow
LOCAL_HALVINGS = 8  # of the neighbourhood of a norm
RADIUS_HALVINGS = 12  # of the radius of growth, from 1
GRID = 3  # directions have coordinates that are multiples of 1/GRID
STEPS = 64  # parts of 1; the interval of a number is one of them, or shorter
