"""Points, counterexamples and witnesses."""

import numpy as np
from flint import Ordering, fmpq_mpoly_ctx

from juggleproof.certificates import checker
from juggleproof.search.hints.models import Residuals
from juggleproof.search.points import search_values
from juggleproof.statements.states import SearchState, state_of
from tests.rows import each_row
from tests.search.cases import UNIT, budget, read, search_points

# -------------------------------------------------------------------------------------------------
# Points and counterexamples: simple, exact, and accepted by the checker's own functions.

REFUTED = {
    "rational": (
        f"""statement t/f1
forall alpha x w
{UNIT}
given 0 <= x and x < w
show alpha*(w - x) < 2 - alpha*w""",
        0,
    ),
    "square root, rational by choice of alpha": (
        f"""statement t/root
forall alpha
{UNIT}
root s = sqrt(2*(1 + alpha))
show 3*s < 4""",
        0,
    ),
    "physical units": (
        f"""statement t/units
forall alpha beta v r g
{UNIT}
given r > 0 and g > 0 and beta >= 0
given g*beta/2 + r*v < r^2
show v > 0 or beta < 2*r^2/g and v < 0""",
        0,
    ),
    "integers": (
        f"""statement t/integers
forall alpha x w K
integer K
{UNIT}
given 0 <= x and K >= 2
root U = sqrt(4*x + (w - 1)^2)
show U <= K*w + 3""",
        0,
    ),
    "algebraic": (
        """statement t/algebraic
forall x
given x^2 = 2 and x > 0
show x > 3/2""",
        1,
    ),
    "no variables": (
        """statement t/numbers
show 2 < 1""",
        0,
    ),
    "nothing exists": (
        f"""statement t/exists
forall alpha
{UNIT}
exists x w
show x >= 0 and w = 4 - alpha*w and x = alpha*(2*w - x) - 2""",
        0,
    ),
    "a bound that two irrational values attain": (
        """statement t/attained
forall x y
given x^2 + y^2 = 1
show 2*x*y < 1""",
        1,
    ),
    "three equations of three variables": (
        """statement t/isolated
forall x y z
given x^2 + y^2 + z^2 = 1
given x*y + y*z = z^2
given x^2 = 3*y*z
show x <= 0""",
        1,
    ),
    "a ball and a half-space touch": (
        """statement t/touch
forall x y z
given x^2 + y^2 + z^2 <= 3
show (x + 2*y - 2*z)^2 < 27 or x + 2*y <= 2*z""",
        1,
    ),
    "more variables than values can be tried for": (
        f"""statement t/many
forall {" ".join(f"x{k}" for k in range(16))}
given {" and ".join(f"x{k}*x{k + 1} + x{k} > {k % 3}" for k in range(15))}
show x0 > x15 or x3 >= 2*x12 - 1""",
        0,
    ),
    "a corner that sampling misses": (
        f"""statement t/corner
forall alpha x w v
{UNIT}
given x^3 + w*v^2 + alpha*x = 17 and v*w*x = 3 and w > v and v > 0
show x < 0""",
        1,
    ),
}


@each_row("case", REFUTED)
def test_refuted(case):
    text, effort = REFUTED[case]
    statement = read(text)
    point, counterexample = search_points(statement, budget(), effort)
    start = SearchState(checker.Context())
    assert start.is_served_by(counterexample, {}, "counterexample", statement)
    assert start.is_served_by(point, {}, "point", statement)
    refuted = {"refuted": counterexample}
    assert checker.check_one(statement, refuted, {}, {}) == ("refuted", None)


TRUE = {
    "squares": (
        """statement t/squares
forall x y
show x^2 + y^2 >= 2*x*y""",
        {"x": "1", "y": "1"},
    ),
    "far away": (
        """statement t/far
forall x y
given x > 1000 and y = 3*x + 1/7
show y > 3000""",
        {"x": "1001", "y": "21022/7"},
    ),
    "no variables": (
        """statement t/numbers
show 1 < 2""",
        {},
    ),
}


@each_row("case", TRUE)
@each_row("effort", [0, 1])
def test_true_statements_have_points_and_no_counterexample(case, effort):
    text, values = TRUE[case]
    point, counterexample = search_points(read(text), budget(), effort)
    assert counterexample is None
    assert point[2] == values


def test_a_single_point_is_found_by_wider_samples():
    statement = read("statement t/point\nforall x y\ngiven x^2 + (y - 1/3)^2 <= 0\nshow x = 0")
    point, counterexample = search_points(statement, budget(), 1)
    assert (point[2], counterexample) == ({"x": "0", "y": "1/3"}, None)


def test_nothing_meets_contradictory_premises():
    statement = read("statement t/void\nforall x\ngiven x > 1 and x < 1/2\nshow x = 0")
    assert search_points(statement, budget(), 1) == (None, None)


def test_the_counterexample_is_the_one_a_reader_would_take():
    statement = read(
        f"statement t/simple\nforall alpha r x\n{UNIT}\ngiven r > 0 and x >= 0\nshow alpha*x <= r"
    )
    _, counterexample = search_points(statement, budget())
    assert counterexample[2] == {"alpha": "1/2", "r": "1", "x": "3"}


def test_a_witness_in_numbers():
    statement = read("statement t/two\nexists y\nshow y^2 = 2 and y > 0")
    unfolding = checker.Unfolding(statement, checker.Context())
    found = search_values(statement, state_of(unfolding), "witness", {}, {}, budget())
    certificate = {
        "certified": ["witness", [], found],
        "point": [statement.name, [], {}, ["close"]],
    }
    assert checker.check_one(statement, certificate, {}, {}) == ("certified", None)
    assert found[1][0][1] == "theta^2 - 2"


# -------------------------------------------------------------------------------------------------
# Witnesses for `exists`: rational functions, adjoined roots and case splits, each accepted by the
# checker.

WITNESSES = {
    "linear system": (
        f"""statement w/fixed
forall alpha
{UNIT}
have 1 + alpha > 0
exists x w
show x = alpha*(w - x) and w = 2 - alpha*w""",
        {"w": "2/(alpha + 1)", "x": "(2*alpha)/(alpha + 1)^2"},
    ),
    "an end of a constraint": (
        """statement w/between
forall w
given w > 0
exists x
with x >= 0
show x < w""",
        {"x": "0"},
    ),
    "a square root": (
        """statement w/root
forall a
given a > 0
exists y
with y > 0
show y^2 = a""",
        {"y": "y_"},
    ),
    "below two bounds": (
        f"""statement w/delta
forall alpha
{UNIT}
exists delta
with delta > 0
show delta < alpha and delta < 1 - alpha""",
        {"delta": "-alpha^2 + alpha"},
    ),
    "time to collision": (
        """statement w/collision
forall r g beta v
given r > 0 and g > 0
given beta >= 0
given g*beta/2 + r*v < r^2
have v < r
exists t
with 0 <= t and t < 2*r/g
show beta + v*t = r*t""",
        {"t": "beta/(r - v)"},
    ),
}


def witness(statement: checker.Statement) -> list:
    unfolding = checker.Unfolding(statement, checker.Context())
    base = {name: unfolding.context.values[name] for name in unfolding.universal}
    found = search_values(statement, state_of(unfolding), "witness", base, {}, budget(), effort=1)
    assert state_of(unfolding).is_served_by(found, {}, "witness", statement, base)
    return found


@each_row("case", WITNESSES)
def test_witness(case):
    text, terms = WITNESSES[case]
    assert witness(read(text))[2] == terms


def test_the_larger_of_two_needs_a_case_split():
    found = witness(
        read(
            "statement w/maximum\nforall a b\nexists m\nshow m >= a and m >= b and (m = a or m = b)"
        )
    )
    assert found[:2] == ("sign", "a - b")
    assert [part[2] for part in found[2:]] == [{"m": "b"}, {"m": "a"}, {"m": "a"}]


def test_no_witness_for_what_does_not_exist():
    statement = read("statement w/none\nforall a\nexists y\nshow y^2 = a - 1 and a > 2")
    unfolding = checker.Unfolding(statement, checker.Context())
    base = {"a": unfolding.context.values["a"]}
    assert (
        search_values(statement, state_of(unfolding), "witness", base, {}, budget(), effort=1)
        is None
    )


def leaves(found: list) -> list[dict[str, str]]:
    """The terms of every case that is not empty."""
    if found[0] == "sign":
        return [terms for part in found[2:] for terms in leaves(part)]
    return [] if found[0] == "empty" else [found[2]]


CASES_BY_SIGN = {
    "a positive denominator that no line names": (
        f"""statement w/inverse
forall alpha
{UNIT}
exists w
show w = 2 - alpha*w""",
        {"w": "2/(alpha + 1)"},
    ),
    "a denominator positive by two facts together": (
        """statement w/meets
forall r g beta v
given r > 0 and g > 0
given beta >= 0
given g*beta/2 + r*v < r^2
exists t
with 0 <= t and t < 2*r/g
show beta + v*t = r*t""",
        {"t": "beta/(r - v)"},
    ),
}
MARGIN = "r^2*(1 + alpha)/(1 - alpha)^2"
FALL = "alpha^2*(r - v)^2/2 + r^2/2 + alpha*r*(r - v) - v^2/2"
NEAR_A_BOUNDARY = {
    "either of two parallel equations": (
        """statement w/parallel
forall g v a b
given g > 0
given b*(-g) = a*(-v)
exists lam
show a = lam*(-g) and b = lam*(-v)"""
    ),
    "two variables near a given state": (
        f"""statement w/beside
forall alpha r g beta v size
{UNIT}
given r > 0 and g > 0
given beta >= 0
given beta + (v - r)*2*r/g = 0
given v < r
given size > 0
exists beta0 v0
show beta0 >= 0 and g*beta0/2 + r*v0 < r^2 and v - size < v0 and v0 < v + size and beta0 = beta"""
    ),
    "beyond a border that holds irrational states": (
        f"""statement w/height
forall alpha r g eps v
{UNIT}
have 1 - alpha > 0
given r > 0 and g > 0
given r*v < r^2 and v^2/2 = {MARGIN}
given eps > 0
exists height
with height > 0
show g*height/2 + r*v < r^2 and (1 + alpha)*g*height < eps"""
    ),
    "a supremum is approached": (
        f"""statement w/supremum
forall alpha r g eps
{UNIT}
have 1 - alpha > 0
given r > 0 and g > 0
given eps > 0
root s = sqrt(2*(1 + alpha))
exists beta v
with beta >= 0 and r^2 - g*beta/2 - r*v > 0 and {MARGIN} - g*beta - v^2/2 < 0
show {FALL} - (1 + alpha)*g*beta > r^2*(s*alpha*(1 + alpha)/(1 - alpha) - (1 + alpha)^3/(2*(1 - \
alpha))) - eps"""
    ),
}


@each_row("case", CASES_BY_SIGN)
def test_what_a_term_divides_by_makes_cases_by_sign(case):
    text, terms = CASES_BY_SIGN[case]
    assert leaves(witness(read(text))) == [terms]


@each_row("case", NEAR_A_BOUNDARY)
def test_a_witness_near_a_boundary(case):
    statement = read(NEAR_A_BOUNDARY[case])
    unknown = {name for line in statement.get("exists") for name in line}
    assert [set(terms) for terms in leaves(witness(statement))] == [unknown]


# -------------------------------------------------------------------------------------------------
# Points in floats, which guide the search.


def test_residuals_and_gradients_are_those_of_each_polynomial_holds():
    """Of each fact, divided by its largest coefficient: all numbers here are exact in floats, but
    for the thirds.
    """
    ring = fmpq_mpoly_ctx.get(("x", "y", "z"), Ordering.lex)
    x, y, _ = ring.gens()
    facts = [
        (x**2 * y - 3, "="),
        (1 - x, ">"),  # met with room to spare
        (y - 2, ">="),
        (x * y + 1, "!="),  # no point misses it but by chance
        (x * 0, "="),
    ]
    missed, gradients = Residuals(facts, [0, 1]).at(np.array([0.5, -1.5]), 0.25)
    assert missed.tolist() == [-1.125, 0, 2, 0, 0]
    expected = [[-1 / 2, 1 / 12], [0, 0], [0, -1 / 2], [0, 0], [0, 0]]
    assert np.allclose(gradients, expected, rtol=1e-15, atol=0)


def test_residuals_of_no_fact_vanish_holds():
    missed, gradients = Residuals([], [0, 2]).at(np.array([0.5, 2.0]), 0.25)
    assert missed.shape == (0,) and gradients.shape == (0, 2)
