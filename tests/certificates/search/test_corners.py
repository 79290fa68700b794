"""States on borders: families of counterexamples that begin where inequalities meet, an adjoined
root among them.
"""

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.language import reals
from juggleproof.certificates.search.sharp import find_sharp_range, read
from tests.certificates.search import cases

(alpha,) = reals("alpha")
UNIT = (alpha > 0) & (alpha < 1)

# c is where the energy R leaves the line on which the ball just closes; e_1 flies with -(1 -
# alpha)/(1 + alpha).
LEAVES = """given c < 1 and (2 - 2*c)*(1 - alpha)^2 + c^2*(1 - alpha)^2/2 = 1 + alpha
have 1 + alpha > 0
let e = (alpha - 1)/(1 + alpha)"""

NEAR = f"""statement corner/near
forall alpha beta v c
{cases.UNIT}
{LEAVES}
given beta >= 0 and (beta + v^2/2)*(1 - alpha)^2 <= 1 + alpha
given (v - e)^2 < (c - e)^2
show beta/2 < 1 - v"""

BAND = f"""statement corner/band
forall alpha eps beta v c
{cases.UNIT}
{LEAVES}
given eps > 0
given (c - e)^2 > eps
given beta >= 0 and beta/2 < 1 - v and (beta + v^2/2)*(1 - alpha)^2 <= 1 + alpha
given (v - e)^2 <= eps
let above = 2*alpha - alpha*beta - 2*alpha*v
let faster = alpha - alpha*v - 1
show above/2 < 1 - faster"""

CASES = {
    "NEAR": (NEAR, "alpha^4 + 2*alpha^3 - 8*alpha^2 - 18*alpha + 7 >= 0", "0.342087213408"),
    "BAND": (BAND, "alpha^3 - 3*alpha^2 - alpha + 1 >= 0", "0.460811127189"),
}


@pytest.mark.parametrize("case", CASES)
def test_a_family_begins_in_a_corner(case):
    text, condition, end = CASES[case]
    statement = cases.read(text)
    found = find_sharp_range([statement], "alpha", UNIT, "corner/sharp", {}, cases.budget())
    assert (found.failure, str(found.statement.condition)) == ("", condition)
    assert [one.decimal(12) for one in found.ends] == [end]
    outcome = checker.settle(
        read(found.statement), {"certified": found.certificate}, {}, {statement.name: statement}
    )
    assert outcome == "certified"


def test_the_corner_says_nothing_beyond_the_other_side():
    # the same certificate does not serve a range that is a little smaller
    statement = cases.read(NEAR)
    found = find_sharp_range([statement], "alpha", UNIT, "corner/sharp", {}, cases.budget())
    smaller = cases.read(found.statement.text().split("number")[0] + "holds 3*alpha <= 1")
    with pytest.raises(checker.Rejected):
        checker.settle(smaller, {"certified": found.certificate}, {}, {statement.name: statement})
