"""Sharp ranges of one parameter."""

import mpmath
import pytest

from juggleproof.certificates import checker
from juggleproof.search.sharp import find_sharp_range, read
from juggleproof.statements.language import reals
from tests.rows import each_row
from tests.search import cases

# -------------------------------------------------------------------------------------------------
# Sharp ranges: the exact set of alpha, its end points to twelve decimals, and certificates of both
# sides.

(alpha,) = reals("alpha")
UNIT = (alpha > 0) & (alpha < 1)
EVERYWHERE = "alpha > 0 and alpha < 1"

RANGES = {
    "CONTRACTION": ("3*alpha < 1", ["0.333333333333"]),
    "SECOND_ORBIT": ("3*alpha >= 1", ["0.333333333333"]),
    "POINT_OUTSIDE": ("alpha^4 + 2*alpha^3 - 8*alpha^2 - 18*alpha + 7 > 0", ["0.342087213408"]),
    "SUPREMUM": (EVERYWHERE, []),
    "REGION": (EVERYWHERE, []),
    "LEVEL": ("9*alpha^2 - 20*alpha + 7 >= 0", ["0.435248607745"]),
    "VERTEX": (
        "81*alpha^6 - 234*alpha^5 + 87*alpha^4 - 164*alpha^3 + 23*alpha^2 + 14*alpha + 1 >= 0",
        ["0.398910074286"],
    ),
    "TRAP": ("3*alpha <= 1", ["0.333333333333"]),
}


@each_row("case", RANGES)
def test_range(case):
    condition, ends = RANGES[case]
    statement = cases.read(getattr(cases, case))
    found = find_sharp_range([statement], "alpha", UNIT, "paper/sharp", {}, cases.budget())
    assert (found.failure, str(found.statement.condition)) == ("", condition)
    assert [end.decimal(12) for end in found.ends] == ends
    outcome = checker.check_one(
        read(found.statement), {"certified": found.certificate}, {}, {statement.name: statement}
    )
    assert outcome == ("certified", None)


def test_statements_together_hold_where_each_does():
    chosen = [cases.read(getattr(cases, case)) for case in ("CONTRACTION", "SECOND_ORBIT")]
    found = find_sharp_range(chosen, "alpha", UNIT, "paper/sharp", {}, cases.budget())
    assert str(found.statement.condition) == "0 = 1"
    named = {s.name: s for s in chosen}
    assert checker.check_one(
        read(found.statement), {"certified": found.certificate}, {}, named
    ) == ("certified", None)


def test_gaps_points_and_several_ends():
    statement = cases.read("""statement s/gaps
forall alpha
show (2*alpha - 1)^2*(3*alpha - 1)*(5*alpha - 4) >= 0""")
    found = find_sharp_range([statement], "alpha", UNIT, "s/sharp", {}, cases.budget())
    assert str(found.statement.condition) == "3*alpha <= 1 or 2*alpha = 1 or 5*alpha >= 4"
    assert found.failure == ""


def test_algebraic_ends_of_one_polynomial_are_kept_apart():
    # The cubic has two roots in (0, 1): separators lie between them.
    statement = cases.read("""statement s/cubic
forall alpha
show 10*alpha^3 - 20*alpha^2 + 10*alpha - 1 > 0""")
    found = find_sharp_range([statement], "alpha", UNIT, "s/sharp", {}, cases.budget())
    with mpmath.workdps(40):
        roots = sorted(mpmath.polyroots([10, -20, 10, -1], maxsteps=200, extraprec=200))
        inside = [mpmath.nstr(root, 12) for root in roots if 0 < root < 1]
    assert [end.decimal(12) for end in found.ends] == inside
    assert found.failure == ""
    outcome = checker.check_one(
        read(found.statement), {"certified": found.certificate}, {}, {statement.name: statement}
    )
    assert outcome == ("certified", None)


NOWHERE = {
    "a root of the parameter": (
        f"""statement x/edge
forall alpha v
{cases.UNIT}
root s = sqrt(2*(1 + alpha))
given v^2 = 2*(1 + alpha)
show v != -s"""
    ),
    "no room at the boundary": (
        f"""statement x/room
forall alpha x
{cases.UNIT}
given x >= 0
exists d
with d > 0
show x - d >= 0 and alpha*d < 1"""
    ),
    "an equation times what does not vanish": (
        f"""statement x/quotient
forall alpha h slope v
{cases.UNIT}
given h != 0 and alpha*(v + h)^2 - alpha*v^2 - alpha*h^2 = slope*h
show slope != 2*alpha"""
    ),
}


@each_row("case", NOWHERE)
def test_one_family_breaks_a_statement_everywhere(case):
    statement = cases.read(NOWHERE[case])
    found = find_sharp_range([statement], "alpha", UNIT, "x/sharp", {}, cases.budget())
    assert str(found.statement.condition) == "0 = 1"
    assert checker.check_one(
        read(found.statement), {"certified": found.certificate}, {}, {statement.name: statement}
    ) == ("certified", None)


# -------------------------------------------------------------------------------------------------
# States on borders: families of counterexamples that begin where inequalities meet, an adjoined
# root among them.

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


@pytest.mark.exhaust
@each_row("case", CASES)
def test_a_family_begins_in_a_corner(case):
    text, condition, end = CASES[case]
    statement = cases.read(text)
    found = find_sharp_range([statement], "alpha", UNIT, "corner/sharp", {}, cases.budget())
    assert (found.failure, str(found.statement.condition)) == ("", condition)
    assert [one.decimal(12) for one in found.ends] == [end]
    outcome = checker.check_one(
        read(found.statement), {"certified": found.certificate}, {}, {statement.name: statement}
    )
    assert outcome == ("certified", None)


def test_the_corner_proves_nothing_beyond_the_other_side():
    # the same certificate does not serve a range that is a little smaller
    statement = cases.read(NEAR)
    found = find_sharp_range([statement], "alpha", UNIT, "corner/sharp", {}, cases.budget())
    smaller = cases.read(found.statement.text().split("number")[0] + "holds 3*alpha <= 1")
    certificate = {"certified": found.certificate}
    outcome, _ = checker.check_one(smaller, certificate, {}, {statement.name: statement})
    assert outcome == "rejected"
