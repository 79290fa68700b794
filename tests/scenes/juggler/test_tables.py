"""Section by section the hard cases: what floats do, what is true, and what the bounded arithmetics
say of it.
"""

from __future__ import annotations

from fractions import Fraction

import pytest

from juggleproof.scenes.juggler.exact import as_fraction
from juggleproof.scenes.juggler.tables import CASES, ArithmeticFinding, ExactStart, finding

LONG = "10^6 periods"
WRONG = {
    "alpha -> 1/3 from below, by 10^-300": 1,
    "x = w after an impact, two limits: e_1 or e_2": 1,
    "10^-300 below x = w": 0,
}
UNDECIDED = {
    *WRONG,
    "alpha = 1/3, on e_2",
    "alpha = (K - 1)/(K + 1), K = 4, on e_4",
    "start on x = w",
    "x = w after an impact",
    "10^-300 above x = w",
    "w = 0, x = 0",
    "energy 10^300",
}
EDGES = {
    "alpha = 1/3, on e_2": 50,
    "alpha = (K - 1)/(K + 1), K = 4, on e_4": 25,
    "start on x = w": 1,
    "x = w after an impact": 1,
    "x = w after an impact, two limits: e_1 or e_2": 1,
    "w = 0, x = 0": 1,
}


@pytest.fixture(scope="module", params=CASES, ids=lambda case: case.name)
def one(request: pytest.FixtureRequest) -> ArithmeticFinding:
    case: ExactStart = request.param
    return finding(case)


def test_floats_take_the_wrong_branch_only_where_it_is_said_holds(one: ArithmeticFinding) -> None:
    assert one.wrong_at == WRONG.get(one.case.name)


def test_balls_hold_the_truth_and_prove_the_edges_holds(one: ArithmeticFinding) -> None:
    assert (
        one.enclosed.end == "reached"
        and one.enclosed.error is not None
        and max(one.enclosed.error) <= Fraction(1, 10**30)
    )
    assert one.edges == EDGES.get(one.case.name, 0)
    if one.exact.end == "reached":
        for ball, exact, radius in zip(
            (one.enclosed.x, one.enclosed.w), (one.exact.x, one.exact.w), one.enclosed.error
        ):
            assert abs(as_fraction(ball.mid().fmpq()) - exact) <= radius
    else:
        assert one.exact.end == "too long" and one.case.most_bits is not None


def test_bounded_floats_hold_the_truth_or_say_that_they_cannot_tell_holds(
    one: ArithmeticFinding,
) -> None:
    assert one.fast.error is not None
    assert one.fast.end == ("undecided" if one.case.name in UNDECIDED else "reached")
    if one.fast.end == "reached" and one.exact.end == "reached":
        for value, exact, bound in zip(
            (one.fast.x, one.fast.w), (one.exact.x, one.exact.w), one.fast.error
        ):
            assert abs(Fraction(value) - exact) <= Fraction(bound)


def test_a_false_orbit_of_floats_has_another_limit_holds() -> None:
    """At alpha = 3/7 from (4/3, 3) the state after the first impact is (5/7, 5/7); floats say x <
    w, and end in e_1 instead of e_2.
    """
    found = finding(next(case for case in CASES if "two limits" in case.name))
    assert found.wrong_at == 1
    assert abs(found.floats[0] - 21 / 50) < 1e-9 and abs(found.floats[1] - 7 / 5) < 1e-9
    assert abs(found.exact.x - Fraction(7, 25)) < Fraction(1, 10**15) and abs(
        found.exact.w - Fraction(14, 5)
    ) < Fraction(1, 10**15)
    assert (found.fast.end, found.fast.periods) == ("undecided", 1)


def test_every_hard_case_is_there_holds() -> None:
    names = " ".join(case.name for case in CASES)
    for wanted in (
        "alpha -> 0",
        "1/3 from below",
        "alpha = 1/3",
        "(K - 1)/(K + 1)",
        "alpha -> 1",
        "start on x = w",
        "x = w after an impact",
        "x = 0",
        "w = 0",
        "w < 0",
        "above x = w",
        "below x = w",
        "x = 10^-300",
        "w = 10^-300",
        "w = -10^-300",
        "energy 10^-300",
        "energy 10^300",
        LONG,
        "digits that grow",
    ):
        assert wanted in names, wanted
