"""What the theorem says of one state, in exact numbers, against actual orbits."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from juggleproof.command.main import run
from juggleproof.proofs.theorem import explaining as theorem
from juggleproof.proofs.theorem import quantities
from juggleproof.proofs.theorem.definition import (
    CORE,
    TRAP,
    ceiling,
    least_integer,
    sign_with_root,
    value_of,
)
from juggleproof.proofs.theorem.orbits import (
    PRINTED_LOSS,
    TRUE_LOSS,
    ExactState,
    a_state,
    flight_length,
    moves,
    step,
)
from juggleproof.proofs.theorem.quantities import StepBound, bracket, entry_into_region, into_region
from juggleproof.reports.tables import exact, shown
from juggleproof.statements.language import ClaimError, reals

THIRD = Fraction(1, 3)


def between(low: Fraction | int, high: Fraction | int, largest: int) -> SearchStrategy[Fraction]:
    """All fractions in [low, high] with denominators up to the largest: sooner drawn from a list
    than by `st.fractions`.
    """

    def listed() -> SearchStrategy[Fraction]:
        found = {
            Fraction(above, below)
            for below in range(1, largest + 1)
            for above in range(ceil(low * below), floor(high * below) + 1)
        }
        return st.sampled_from(sorted(found, key=lambda one: (one.denominator, abs(one), one)))

    return st.deferred(listed)


below_a_third = between(Fraction(1, 100), Fraction(33, 100), 100)
states = st.builds(ExactState, below_a_third, between(0, 60, 12), between(-15, 15, 12))
pairs = between(-30, 30, 20)


def after(state: ExactState, periods: int) -> ExactState:
    for _ in range(periods):
        state = step(state)
    return state


def test_numbers_of_known_states_holds() -> None:
    # u^2 = 5764 and 75 < u < 76, so that the rank 2 u + 21 is between 172 and 173; at e_1, u = 1 +
    # alpha w = 19/13 and w = 20/13.
    assert quantities.by_the_theorem(
        a_state(Fraction(3, 10), Fraction(1000), Fraction(-41))
    ) == StepBound(175, 176)
    assert quantities.by_the_theorem(
        a_state(Fraction(3, 10), Fraction(60, 169), Fraction(20, 13))
    ) == StepBound(5, 6)
    assert (
        quantities.via_little_energy(a_state(Fraction(1, 5), Fraction(0), Fraction(1)), 4).to_little
        == 0
    )
    assert quantities.by_the_rate(Fraction(3, 10), 3) == Fraction(27, 125)
    assert quantities.by_the_closed_form(Fraction(3, 10), 3) == Fraction(108, 1000)


def test_the_best_way_is_no_worse_than_its_neighbours_holds() -> None:
    state = a_state(Fraction(3, 10), Fraction(10) ** 9, Fraction(-41))
    best = quantities.best_way(state)
    others = [
        quantities.via_little_energy(state, W).bound.trap for W in range(best.W // 2, 2 * best.W)
    ]
    assert best.bound.trap <= min(others) + 1  # each part is rounded up by itself
    assert best.bound.trap < quantities.by_the_theorem(state).trap / 2


def test_rejects_a_width_that_the_claim_does_not_allow() -> None:
    with pytest.raises(ClaimError, match="too small"):
        quantities.via_little_energy(a_state(Fraction(1, 5), Fraction(0), Fraction(1)), 2)


@given(state=states, more=st.integers(0, 8), past=st.integers(0, 3))
def test_orbits_keep_what_is_certified_holds(state: ExactState, more: int, past: int) -> None:
    for bound in (
        quantities.by_the_theorem(state),
        quantities.best_way(state).bound,
        quantities.certified(state),
    ):
        assert after(state, bound.trap + past).is_in(TRAP)
        core = after(state, bound.core + past)
        assert core.is_in(CORE)
        distance = after(core, more).distance
        assert distance <= quantities.by_the_rate(state.alpha, more)
        assert distance <= quantities.by_the_closed_form(state.alpha, more)


@given(state=states, periods=st.integers(0, 6))
def test_closed_form_is_the_orbit_in_the_trap_holds(state: ExactState, periods: int) -> None:
    entry = next(move.state for move in moves(state) if move.state.is_in(TRAP))
    assert theorem.later(entry, periods) == after(entry, periods)


@given(state=states)
def test_moves_are_the_orbit_holds(state: ExactState) -> None:
    here, count = state, 0
    for move in moves(state, 3):
        assert (move.state, move.start) == (here, count)
        assert move.periods == 1 if move.impact else flight_length(here) == move.periods
        here, count = after(here, move.periods), count + move.periods


def test_long_flights_are_one_move_holds() -> None:
    state = a_state(Fraction(33, 100), Fraction(10) ** 300, Fraction(0))
    entry = next(move for move in moves(state) if move.state.is_in(TRAP))
    certified = quantities.certified(state).trap
    assert 10**150 < entry.start <= certified <= entry.start + entry.start // 1000
    assert quantities.by_the_theorem(state).trap > 2 * entry.start


@given(p=pairs, q=pairs, n=st.integers(0, 40))
def test_signs_and_ceilings_with_a_root_are_exact_holds(p: Fraction, q: Fraction, n: int) -> None:
    square = Fraction(n * n, 9)  # a number with a rational root tells what the sign is
    total = p + q * Fraction(n, 3)
    assert sign_with_root(p, q, square) == (total > 0) - (total < 0)
    least = ceiling(p, abs(q), square)
    assert least - 1 < p + abs(q) * Fraction(n, 3) <= least


def test_rejects_a_name_without_a_value() -> None:
    with pytest.raises(ClaimError, match="w has no value here"):
        value_of(sum(reals("x w"), start=reals("x")[0]), {"x": Fraction(1)})


BAD = {
    "--alpha 0.3.1 --state x=1,w=2": "is no number; write it as 3/10",
    "--alpha 1 --state x=1,w=2": "not between 0 and 1",
    "--alpha 0 --state x=1,w=2": "not between 0 and 1",
    "--alpha=-1/4 --state x=1,w=2": "not between 0 and 1",
    "--alpha some --state x=1,w=2": "'some' is no number",
    "--alpha nan --state x=1,w=2": "'nan' is no number",
    "--alpha 1/0 --state x=1,w=2": "alpha divides by 0",
    "--alpha 1/4 --state x=1,w=": "'' is no number",
    "--alpha 1/4 --state x=-1/9,w=2": "below the table",
    "--alpha 1/4 --state beta=-1,v=0,r=1,g=1": "below the table",
    "--alpha 1/4 --state beta=1,v=0,r=0,g=1": "r = 0 is not positive",
    "--alpha 1/4 --state beta=1,v=0,r=1,g=-2": "g = -2 is not positive",
    "--alpha 1/4 --state x=1": "w is missing",
    "--alpha 1/4 --state beta=1,v=0,r=1": "g is missing",
    "--alpha 1/4 --state x=1,w=2,r=1": "is missing",
    "--alpha 1/4 --state x=1,z=2": "'z=2' is no component",
    "--alpha 1/4 --state nothing": "'nothing' is no component",
    "--alpha 1/4 --state x=1,x=2": "x is given twice",
    "--alpha 1/4 --state x=9^99999,w=2": "longer than",
    "--alpha 1/4": "give --alpha and --state together",
    "--state x=1,w=2": "give --alpha and --state together",
    "--bounds --alpha 1/4": "--bounds stands alone",
}


@pytest.mark.parametrize("options", sorted(BAD))
def test_rejects_input(options: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explain", "theorem", *options.split()]) == 2
    said = capsys.readouterr()
    assert said.out == "" and BAD[options] in said.err and len(said.err.splitlines()) == 1


@pytest.mark.parametrize("options", [["--bounds"], ["--alpha", "1/4"], ["--state", "x=1,w=1"]])
def test_rejects_options_of_the_theorem_with_another_claim(
    options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["explain", "eq-6", *options]) == 2
    assert "goes with `explain theorem` only" in capsys.readouterr().err


def test_rejects_premises_of_a_claim_without_map_rules(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explain", "eq-6", "--premises"]) == 2
    assert "eq-6 has no map rules" in capsys.readouterr().err


def test_numbers_are_read_and_shown_exactly_holds() -> None:
    assert [exact(text, "x") for text in ("-41", "0.3", "3e-1", "10^3", "2^3/3^2", " 7 ")] == [
        -41,
        Fraction(3, 10),
        Fraction(3, 10),
        1000,
        Fraction(8, 9),
        7,
    ]
    assert shown(Fraction(10) ** 6000 + 1) == "1.00000000000e6000"
    assert [shown(Fraction(n, 8), 3) for n in (1, 8, -10001)] == ["0.125", "1", "-1.25e3"]


def test_paper_units_are_converted_exactly_holds() -> None:
    state = theorem.read_state(
        Fraction(9, 10), "beta=3,v=2,r=1/2,g=10"
    )  # T = 2 r/g = 1/10, x = beta/(r T), w = 1 - v/r
    assert (state.x, state.w) == (60, -3)


def said_of(alpha: Fraction, x: int | Fraction, w: int | Fraction) -> str:
    return theorem.follow(a_state(alpha, Fraction(x), Fraction(w)))[2]


def test_fate_from_a_third_on_is_told_holds() -> None:
    assert (
        said_of(THIRD, 0, -1)
        == "does not tend to e_1: from n = 2 on it has period 2, the orbit of e_2"
    )
    assert said_of(Fraction(1, 2), 4, 2).startswith("tends to e_1: at n = 5")
    assert (
        said_of(Fraction(1, 2), 0, 4)
        == "does not tend to e_1: from n = 0 on it has period 3, the orbit of e_3"
    )
    assert said_of(Fraction(9, 10), 60, -3).startswith("not known")


def test_at_a_third_all_states_but_three_are_certified_holds() -> None:
    assert [
        quantities.converges(a_state(THIRD, Fraction(x), Fraction(w)))
        for x, w in ((0, 3), (1, 1), (0, -1), (5, 2))
    ] == [False] * 3 + [True]
    assert not quantities.converges(a_state(Fraction(1, 2), Fraction(5), Fraction(2)))


def test_explanation_of_a_state_shows_bounds_and_orbit_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["explain", "theorem", "--alpha", "3/10", "--state", "x=1000,w=-41"]) == 0
    said = capsys.readouterr().out
    assert (
        "every N >= 175 periods" in said
        and "flight of 58 periods" in said
        and "in the trap from n = 87 on; certified: n = 144" in said
    )
    assert run(["explain", "theorem", "--alpha", "33/100", "--state", "x=10^300,w=0"]) == 0
    assert len(capsys.readouterr().out.splitlines()) < 60


def test_tree_of_the_theorem_leads_to_its_premises_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["explain", "theorem", "--premises"]) == 0
    said = capsys.readouterr().out
    assert (
        "theorem/exactly: 2 premises: covers same-point-1" in said
        and "6 rules, 35 premises" in said
    )
    assert said.count("    statement theorem/") == 35 + said.split("rests on")[0].count(
        "    statement theorem/"
    )


def test_bounds_of_the_paper_in_known_rows_holds() -> None:
    # alpha = 2/5, u = 29/8: one impact is counted with the printed loss, and the ball of the
    # table's best state needs two.
    row = into_region(Fraction(2, 5), Fraction(29, 8))
    assert (row.true, row.printed, row.impacts.impacts) == ((3, 4), (0, 1), 2)
    assert row.time.time > row.flight == Fraction(29, 8)
    assert [
        bool(theorem.violations([row], measure, loss, "ceiling"))
        for measure in theorem.MEASURES
        for loss in theorem.LOSSES
    ] == [False, True, False, True, False, True]
    # At the border of R (26) is early of sampled states only.
    row = into_region(Fraction(3, 10), Fraction(41, 16))
    assert [
        bool(theorem.violations([row], measure, "derived", "ceiling"))
        for measure in theorem.MEASURES
    ] == [False, False, True]


@given(
    alpha=between(Fraction(1, 20), Fraction(9, 10), 20),
    more=between(0, 20, 9),
)
def test_counts_and_periods_are_enough_where_claims_say_so_holds(
    alpha: Fraction, more: Fraction
) -> None:
    u = 2 / (1 - alpha) + more  # outside R, whose border is at u^2 = 2 (1 + alpha)/(1 - alpha)^2
    row = into_region(alpha, u)
    assert row.impacts.impacts <= row.true[1] and row.time.time <= row.flight * row.true[1]
    assert row.sample.sample <= row.ours
    if alpha <= Fraction(364, 1000):
        assert (
            row.impacts.impacts <= row.printed[1] and row.time.time <= row.flight * row.printed[1]
        )


@settings(max_examples=30, deadline=None)
@given(alpha=st.fractions(Fraction(365, 1000), Fraction(19, 20), max_denominator=1000))
def test_printed_loss_is_violated_from_the_claimed_alpha_on_holds(alpha: Fraction) -> None:
    steps = 10**6  # u just below where the bracket with the printed loss is 1
    u = Fraction(
        least_integer(lambda k: bracket(PRINTED_LOSS, alpha, Fraction(k, steps))[1] > 1, steps) - 1,
        steps,
    )
    start = ExactState(alpha, Fraction(0), 1 + u)
    assert (
        bracket(PRINTED_LOSS, alpha, u)[1]
        == 1
        < entry_into_region(start).impacts
        <= bracket(TRUE_LOSS, alpha, u)[1]
    )
