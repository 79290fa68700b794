"""The constants that steer the searches: what each limits, and its value.

A word in brackets names the inputs for which the search with this limit was written, as far as the
history of the sources tells: the paper's claims, maps (of `stability`), problems (SMT-LIB scripts)
or `bound`.  How a value was chosen is not recorded, and other values were not measured, unless the
comment has figures.

"Never" marks a limit that stopped nothing in a fresh exact search over the paper's claims, nor in
the tests of the searches, of maps, of problems and of votes.  Most of these keep memory and time in
bounds on larger inputs.  All of these but SQUARES_VARIABLES, SQUARES_BASIS and LEAST_WIDTH were
halved at once, with seven limits of work (EASY_PROOF, SHARP, FAMILY, SLOPE, DECREASE,
FACTOR_SQUARES, BOUND_SQUARES) and with CHEAP_WORK, MOST_ITERATIONS, MOST_SETS, MOST_DIGITS,
MOST_PRODUCTS, PRODUCT_ITERATED and TREE_PRODUCTS.  Of the paper's claims one lost its sharp range,
region-DE-sup, for which halving the first four limits of work is enough; and one had another
certificate, s3.5.3-locally-stable.

Work is counted in the units of `statements.work`.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

# -------------------------------------------------------------------------------------------------
# Counted work.

# (whether a refutation is sought, effort, share of the budget left in percent), in order: cheap
# attempts of both kinds come first [claims]
ATTEMPTS = (
    (True, 0, 50),
    (False, 1, 20),
    (False, 2, 20),
    (True, 1, 40),
    (False, 2, 60),
    (False, 3, 50),
    (True, 2, 100),
)
SQUARES_FIRST = (  # the same, where sums of squares are likely [problems]
    (True, 0, 50),
    (False, 1, 10),
    (True, 1, 20),
    (False, 3, 40),
    (False, 2, 20),
    (True, 1, 40),
    (False, 3, 60),
    (False, 2, 60),
    (True, 2, 100),
)
CHEAP_WORK = 20_000  # for each cheap search before others [problems]
LINEAR_WORK, PAIRS_WORK = 3000, 8000  # for linear multiples, and for products of two [problems]
EASY_PROOF_WORK = 600_000  # for a proof inside a range at effort 1 [claims]
SHARP_WORK = 2_500_000  # for families, for proofs on the whole domain, for verdicts [claims]
FAMILY_WORK = 300_000  # for one family on the whole domain [claims]
SLOPE_WORK = 200_000  # for the sign of one slope [claims]
PIECE_WORK = (250_000, 1_500_000)  # for a piece of a line: with each choice, with the best [claims]
FEW_FACTS_WORK = 25_000  # for products of few facts, by a parameter or by monomials [maps]
FORM_WORK = 20  # for the Bernstein form of a sum of these products [maps]
FORMS_WORK = 8000  # for quadratic forms [maps]
COEFFICIENT_WORK = 1500  # for one coefficient of a form with parameters [maps]
LARGE_PROGRAM_WORK = 500_000  # that has to be left, for a program with most columns [maps]
GIVEN_UP_WORK = 1000  # for a program that is given up while it is made [maps]
DECREASE_WORK = 1_000_000  # for a premise, where the caller says no other budget [maps]
FACTOR_SQUARES_WORK = 20_000  # for the sign of a factor by sums of squares [maps]
BOUND_SQUARES_WORK = 100_000_000  # for squares times facts, for one bound [bound]
TREE_PRODUCTS = 10**8  # of integers in one tree; a hundred times as many of floats [bound]
MANY_TERMS = 1000  # of all facts, beyond which reading counts: 16 sums multiplied took 1.1 GB

# Work of Z3, in its own unit: 200,000 take a tenth of a second where numbers are rational.
Z3_WORK = 200_000  # for a verdict [claims]
Z3_GUESS_WORK = 100_000  # where a guess will do [claims, problems]
Z3_CLAUSES_WORK = 60_000  # for one choice of alternatives [problems]
Z3_VALUES_WORK = 4_000_000  # for one round of few values [problems]
Z3_LINEAR_STEPS = 20  # that count as one unit of ours there: linear steps are quicker [problems]

# -------------------------------------------------------------------------------------------------
# Leaves: products of facts that cancel.

MOST_COLUMNS = 20_000  # of a program: memory [maps, never]
MOST_ENTRIES = 6_000_000  # of its matrix: memory [maps]
MOST_PRODUCT_TERMS = 3_000_000  # of the columns of a program together: some 300 MB [maps, never]
MOST_ITERATIONS = 5000  # of the simplex method [maps]
MOST_EQUATIONS_ON_A_MONOMIAL = 60  # used one after another [claims, never]
FEW_COLUMNS, MANY_COLUMNS = 150, 1200  # in coordinates, before and after signs are sought [maps]
JITTER = (0.0, 0.7)  # of the costs of columns: for short solutions, then for others [claims]
NONZERO = 1e-9  # a value of a solution above it is used [claims]
MOST_PER_KIND = 6  # candidates of one kind [claims]
MOST_PAIRS = 500  # pairs of facts with a resultant [claims: the greatest number was 308]
MOST_DIGITS = 50_000  # of a resultant that is factored [claims: 5,324 at most]
MOST_PRODUCTS = 1_000_000  # that a resultant is made of [claims: 57,354 at most]
MOST_FACTS_FOR_TRIPLES = 10  # whose products of three are taken [claims]
MOST_FACTS_IN_SQUARES = 12  # whose products of two are taken beside squares [problems, never]
MOST_FACTS_IN_ORTHANT = 8  # the same, beside coordinates [maps]
MOST_FACTS_FOR_BOTH = 9  # of a case by a variable, for which higher products follow [claims]
FACTS_IN_TURN = 7  # from which on those in the goal's variables come first [claims]
HIGH_DEGREE = 12  # of facts in one variable, which are left out where others are lower [claims]
ORTHANT_ROUNDS = 2  # of multipliers, each for the monomials of those before [maps]
ORTHANT_MORE = 2  # degrees beyond that of the facts [maps]
ORTHANT_TERMS = 8  # of a fact that coordinates are chosen by [maps]
ORTHANT_ROOTS = 12  # squares that are multiplied [maps]
MONOMIALS_DEGREE = 3  # least degree of a fact: for less, pairs are sought elsewhere [maps]
MONOMIALS_PRODUCTS = 3000  # of bounds along monomials [maps]
MOST_OTHERS = 4  # variables beside the parameter, for minors [maps]
MOST_SETS = 20_000  # of facts whose minors are tried [maps]
MINOR, MINOR_ROUNDING = 1e-12, 1e-7  # least minor; rounding of sums, where entries are <= 1 [maps]
MINORS_AT = (Fraction(1, 8), Fraction(1, 2), Fraction(7, 8))  # of the side, for these signs [maps]
HIGHER = 12  # degrees that a Bernstein form may be raised by to have no negative number [maps]
MOST_BOUNDED = 10  # variables with bounds; some of them are parameters [maps, never]
SIMPLIFICATIONS = 8  # passes over the products of an identity [claims]
LONG_NUMBER = 200  # bits of a number of an identity, from which on a shorter form is sought [maps]

# Samples in floats, which end the search for a proof that cannot exist [claims].
POINTS, POINT_ROUNDS, POINTS_KEPT = 160, 5, 8  # drawn, rounds, those that the next round begins at
POINT_MARGIN = 1e-6  # by which facts hold at a point that counts
FLOAT_BITS = 900  # of coefficients; longer ones are divided by a power of two: floats overflow

# Quadratic forms with parameters [maps].
FORM_PARTS = 100  # Bernstein polynomials of one box (never)
FORM_GUARDS = 6  # facts of degree 1 or 2 in the form's variables
FORM_RAISED = 3  # by how much a degree is raised
FORM_POINTS, FORM_MARGIN = 1000, 1e-3  # samples at which a form may not be negative by more
FORM_DENOMINATORS = (1, 4, 12, 1 << 6, 1 << 8, 1 << 12, 1 << 18)
FORM_GOALS = ((1e-4, 1e-5), (1e-6, 1e-6))  # as SQUARES_GOALS, but in the middle of the cone

# Sums of squares times facts [problems].
# (facts in a product at most, degree beyond that of the facts, whether bounds and signs of single
# variables are left out)
SQUARES_STAGES = (
    (1, 0, True),
    (1, 0, False),
    (2, 0, False),
    (1, 2, True),
    (1, 2, False),
    (2, 2, False),
    (1, 4, True),
    (1, 4, False),
)
FORM_STAGES = ((1, 0, False), (1, 2, False), (1, 4, False))  # the same, by cases of a variable
MOST_FORM_VARIABLES = 8  # of a form by cases of a variable
SQUARES_ENTRIES = 2_000_000  # of the equations
SQUARES_MONOMIALS = 70  # in one block (never)
SQUARES_BITS = 6000  # of a coefficient (never)
SQUARES_ROUNDS = 6  # of leaving out what a solution does not need
# (what the trace costs, where to stop), from simple solutions to the middle of all
SQUARES_GOALS = ((1e-4, 1e-9), (1e-5, 1e-8), (1e-6, 1e-7))
SQUARES_DENOMINATORS = (1, 2, 12, 60, 1 << 8, 1 << 14, 1 << 20, 1 << 28)
KERNELS = (1e-3, 1e-5, 1e-2, 1e-7)  # relative eigenvalues that are taken as 0

# -------------------------------------------------------------------------------------------------
# Cases.

SIGN_DEPTH = 2  # of cases by sign below one another [claims]
SIGN_CANDIDATES = 6  # factors; twice as many variables, three times as many resultants [claims]
SIGN_BRANCHES = 3  # candidates followed further at the first level; one less at the next [claims]
MOST_SIGNS = 15  # of factors of equations below one another [claims, never]
MANY_CASES = 100  # of disjunctions, from which on they are led by conflicts [problems]
MOST_CONFLICTS = 400  # of such cases [problems, never]
MOST_CLAUSE_CASES = 20_000  # which conflicts leave [problems, never]
SMALL_CONFLICT = 8  # facts: what smaller conflicts miss weighs more [problems]
LONG_NODE = 12  # terms, beyond which a shorter node is looked for [maps]
MOST_SPLITS = 150  # of linear facts below one another: the checker goes down as many [problems]
MOST_VARIABLES = 120  # of what is not linear: beyond, a leaf's work is not counted [problems]
PAIRS_FACTS, PAIRS_VARIABLES, PAIRS_CASES = 10, 4, 16  # for products of two at first [problems]
MOST_LINE_DEGREE = 60  # of all factors together, for the cells of one variable [claims]

# Decrease of a function [maps].
PRODUCT_DEGREES = (0, 1, 2, 3)  # beyond those of the goal
PRODUCT_COLUMNS, PRODUCT_TERMS = 6000, 2_000_000  # of a program
PRODUCT_ITERATED = 5_000_000  # columns in all iterations of a linear program
FACTOR_DEGREES = (0, 1, 2)  # beyond those of a factor
FACTOR_COLUMNS, FACTOR_PRODUCT_TERMS = 1500, 100_000  # of a program
FACTOR_TERMS = 60  # of a factor whose sign is sought (never)
FACTOR_ZERO = 1e-9  # what counts as 0 at samples

# -------------------------------------------------------------------------------------------------
# Boxes.

FEW_LETTERS, MANY_LETTERS = 40, 4000  # of a tree, before signs are sought and after [bound]
MOST_COEFFICIENTS = 1 << 16  # of the Bernstein form of a fact over a box [bound, never]
BOX_MARGINS = (Fraction(1, 100), Fraction(1, 10**5))  # parts of the value at the middle [bound]
TREE_BITS = 1500  # of the common denominator on a box [bound, never]
TREE_ROUNDING = 2.0**-46  # of the largest coefficient: lost by floats down a tree [bound]
BOXES_BEFORE_SQUARES = 300  # [bound]
SQUARES_VARIABLES, SQUARES_BASIS = 6, 28  # of a program of squares around a point [bound, never]
AROUND_DENOMINATORS = (1 << 4, 1 << 7, 1 << 10, 1 << 14, 1 << 20, 1 << 28, 1 << 36)  # [bound]
DESCENT_STEPS = 200  # of one descent to a minimum [bound]
LEAST_WIDTH = Fraction(1, 10**13)  # for which floats have a point good enough [bound, never]
WIDTH_SHARE = 8  # of the width, which the value at a point and its rounding may each take [bound]
WIDTHS = [Fraction(10) ** -k for k in range(-3, 17)]  # in turn, where none is reached [bound]
NEAR, FAR = Fraction(1, 10**9), Fraction(1, 10**4)  # how far below it a simple value may be [bound]
SIMPLE = 10**6  # denominator of a value that may be the minimum itself [bound]
SIMPLEST = (1, 60, 1000, SIMPLE)  # the same, in order [bound]

# -------------------------------------------------------------------------------------------------
# Points.

# For each effort: rounds of (values tried for a variable, values kept for the last one,
# substitutions in all, irrational ones too) [claims]
SAMPLER_ROUNDS: tuple[tuple[tuple[int, int, int, bool], ...], ...] = (
    ((3, 1, 40, False),),
    ((3, 1, 60, True), (6, 2, 400, True), (12, 3, 1000, True)),
    ((3, 1, 60, True), (6, 2, 400, True), (12, 3, 3000, True), (24, 6, 8000, True)),
)
MANY_VARIABLES = 12  # or disjunctions, from which on Z3 is asked for whole points [problems]
MOST_DEGREE = 500  # of what values are put into [problems, never]
# parts of an interval, at which a value is taken [claims]
CLOSENESS = tuple(map(Fraction, "1/2 1/4 3/4 1/20 19/20 1/1000 999/1000".split()))
FAVOURITES = tuple(  # values of a variable, in order [claims]
    map(
        Fraction,
        "1 2 1/2 0 -1 3 4 -1/2 3/2 -2 1/4 5 3/4 -3 1/3 6 10 5/2 -3/2 1/10 -4 8 -1/4 7/2 1/8 -1/10"
        " 20 1/100 100".split(),
    )
)
FAVOURITE_PARAMETERS = tuple(  # of a parameter: 2*(1 + 1/8) is a square, and so on [claims]
    map(
        Fraction,
        "1/2 1/4 3/4 1/5 3/10 9/10 1/10 2/5 3/5 4/5 1/3 2/3 1/8 7/25 19/20 1/20 99/100 1/100 17/32"
        " 7/18 31/50 161/200".split(),
    )
)
SIMPLE_VALUES: Sequence[Sequence[Fraction]] = [  # by the number of variables [problems]
    [Fraction(value) for value in values.split()]
    for values in (
        "",
        "0 1 -1 2 -2 1/2 -1/2 3 -3 1/3 3/2 10",
        "0 1 -1 2 -2 1/2 -1/2 3",
        "0 1 -1 2 1/2",
        "0 1 -1 2",
        "0 1",  # and for more variables
    )
]
MOST_SIMPLE = 8  # variables; each combination of two values is tried [problems]
FIRST_VALUES, MOST_VALUES = 3, 24  # of a variable; twice as many from round to round [problems]
WINDOWS = tuple(Fraction(1, 4**k) for k in range(6))  # around a value of a model [claims]
STARTS, STEPS = 12, 40  # of Gauss-Newton in floats, from each start [problems]
START_MARGINS = (0.2, 0.02, 0.001, 0.0)  # by which inequalities are to be met, ever less [problems]
TOWER_DIGITS = (2, 4, 8, 14)  # of the point in floats that a tower of roots is near to [problems]
TOWER_ZERO = Fraction(1, 10**15)  # what counts as 0 on the way up a tower [problems]

# Points that equations determine [problems].
ISOLATED_VARIABLES = 4  # at most
ISOLATED_DEGREES = (2, 4, 8, 12, 16)  # of a number that is recognised
ISOLATED_BITS, ISOLATED_STEPS = 1200, 9  # of precision, and steps of Newton's method
ATTAINED = Fraction(1, 10**4)  # an inequality that is closer to 0 is taken as an equation
SHORT = 40  # bits of a coefficient that is no chance
COMBINATIONS = ((1, 0, 0, 0), (0, 1, 0, 0), (1, 1, 0, 0), (1, 2, 3, 5), (3, -1, 2, 7))  # generators

# -------------------------------------------------------------------------------------------------
# Terms and ranges [claims].

NEGLIGIBLE = Fraction(1, 2**100)  # values from rational approximations of roots
NEGLIGIBLE_WIDTH = Fraction(1, 2**200)  # of the enclosure of a root
FAMILY_ROUNDS = 3  # of choices, each with the points at which those before do not serve
TEMPLATE_STEPS = 120  # substitutions in one search
MOST_FACTORED_TERMS = 200  # of a polynomial that is factored (never)
BESIDE = tuple(Fraction(sign, size) for size in (10, 100, 1000) for sign in (1, -1))  # in margins
PROBES = (Fraction(1, 2), Fraction(1, 10), Fraction(9, 10))  # of a range, where a family may fail

# -------------------------------------------------------------------------------------------------
# What is kept, for memory; no outcome depends on it.

MOST_CERTIFICATES = 256  # an assertion made twice under two names is settled once
MOST_PROGRAMS = 5000  # linear programs that were solved, and facts without a form
