"""Sharp ranges in two parameters: the border is found, and both sides are certified."""

from juggleproof.certificates import checker
from juggleproof.search.sharp import read
from juggleproof.search.sharp_plane import find_sharp_region
from juggleproof.statements.language import reals
from tests.search import cases

alpha, K, eps = reals("alpha K eps")
UNIT = (alpha > 0) & (alpha < 1)

ORBIT = f"""statement plane/orbit
forall alpha K
integer K
{cases.UNIT}
given K >= 1
have 1 + alpha > 0
let x = K*(alpha*(K + 1) - (K - 1))/(1 + alpha)^2
show x >= 0"""

STRIP = f"""statement plane/strip
forall alpha eps w
{cases.UNIT}
given eps > 0
given 0 < w and w < 2 + eps
show alpha*w < 2"""


def settled(statement, found):
    outcome, _ = checker.check_one(
        read(found.statement), {"certified": found.certificate}, {}, {statement.name: statement}
    )
    return outcome


def test_the_orbit_of_period_K_exists_from_its_own_ratio_on():
    statement = cases.read(ORBIT)
    found = find_sharp_region(
        [statement], ["alpha", "K"], UNIT & (K >= 1), "plane/sharp", {}, cases.budget()
    )
    assert str(found.statement.condition) == "alpha*K + alpha - K + 1 >= 0"
    assert settled(statement, found) == "certified"


def test_a_strip_that_grows_with_eps():
    statement = cases.read(STRIP)
    found = find_sharp_region(
        [statement], ["alpha", "eps"], UNIT & (eps > 0), "plane/sharp", {}, cases.budget()
    )
    assert str(found.statement.condition) == "-alpha*eps - 2*alpha + 2 >= 0"
    assert settled(statement, found) == "certified"


FLIGHTS = f"""statement plane/flights
forall alpha K n x
integer K n
{cases.UNIT}
given K >= 1
given n >= 1
given K <= n and n <= K
given x*(1 - alpha) = 1 + alpha
show n <= x"""


def test_a_range_over_a_whole_number_has_a_whole_point():
    statement = cases.read(FLIGHTS)
    found = find_sharp_region(
        [statement], ["alpha", "K"], UNIT & (K >= 1), "plane/sharp", {}, cases.budget()
    )
    assert str(found.statement.condition) == "alpha*K + alpha - K + 1 >= 0"
    assert settled(statement, found) == "certified"
    inside, outside, points = found.certificate
    name, adjoined, values, node = points[statement.name]
    half = [inside, outside, {name: [name, adjoined, {**values, "K": "3/2"}, node]}]
    named = {statement.name: statement}
    outcome, reason = checker.check_one(read(found.statement), {"certified": half}, {}, named)
    assert outcome == "rejected" and reason.kind == checker.Kind.VALUES
