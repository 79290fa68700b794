"""Points and counterexamples: simple, exact, and accepted by the checker's own functions."""

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.search.points import search_found
from juggleproof.certificates.work import accepted
from tests.certificates.search_points.cases import UNIT, budget, read, search_points

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
    "a corner that sampling misses": (
        f"""statement t/corner
forall alpha x w v
{UNIT}
given x^3 + w*v^2 + alpha*x = 17 and v*w*x = 3 and w > v and v > 0
show x < 0""",
        1,
    ),
}


@pytest.mark.parametrize("case", REFUTED)
def test_refuted(case):
    text, effort = REFUTED[case]
    statement = read(text)
    point, counterexample = search_points(statement, budget(), effort)
    named = {statement.name: statement}
    assert accepted(
        checker.find,
        checker.State(checker.Context()),
        counterexample,
        {},
        "counterexample",
        named,
        {},
    )
    assert accepted(checker.find, checker.State(checker.Context()), point, {}, "point", named, {})
    assert checker.settle(statement, {"refuted": counterexample}, {}, {}) == "refuted"


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


@pytest.mark.parametrize("case", TRUE)
@pytest.mark.parametrize("effort", [0, 1])
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
    story = checker.Unfolding(statement, checker.Context())
    found = search_found(statement, story.state(), "witness", {}, {}, budget())
    certificate = {
        "certified": ["witness", [], found],
        "point": [statement.name, [], {}, ["close"]],
    }
    assert checker.settle(statement, certificate, {}, {}) == "certified"
    assert found[1][0][1] == "theta^2 - 2"
