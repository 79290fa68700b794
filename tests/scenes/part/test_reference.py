"""The slow reference of the part: its flights, its impacts against the derived modes, its search,
and what it refuses.
"""

from __future__ import annotations

import ast
import random
from collections import Counter
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import Path

import mpmath
import pytest
from mpmath import mpf
from sympy import Rational, Symbol

import juggleproof.symbolic as s
from juggleproof.scenes.errors import SceneError
from tests.rows import each_row
from tests.scenes.part.reference import (
    CORNERS,
    Chatter,
    Event,
    Flight,
    Gaps,
    Model,
    Motion,
    Number,
    Setting,
    Simultaneous,
    State,
    Stopped,
    Undecided,
    Vector,
    corner_velocity,
    dropped,
    first_crossing,
    impact,
    reference_orbit,
    setting,
)

MP = Model(setting(1, 1, e=1, mu=0), 50).context
SHAKEN = setting(
    "0.01", "0.02", e="0.7", mu="0.08", A_x="0.0003", f_x=60, phase_x="0.4", A_y="0.0002", f_y=60
)
STILL = setting("0.01", "0.02", e="0.7", mu="0.08")
MIRROR = (1, 0, 3, 2)
SMALL = MP.mpf(10) ** -35
STARTS = (
    (SHAKEN, "0.3", 0),
    (SHAKEN, "1.1", 0),
    (SHAKEN, "0.7", 100),
    (STILL, "-0.4", 5),
    (STILL, "2.5", -60),
)
UNTIL = "0.27"


@cache
def followed(which: int, digits: int = 50) -> tuple[Model, State, list[Event]]:
    numbers, theta, omega = STARTS[which]
    start = dropped(numbers, theta, "0.001", VX="0.05", omega=omega, digits=digits)
    try:
        events = reference_orbit(numbers, start, UNTIL, digits)
    except Chatter as stopped:
        events = list(stopped.events)
    assert len(events) >= 3
    return Model(numbers, digits), start, events


def flights(which: int) -> list[tuple[Flight, State]]:
    """Each flight between impacts, the last until the end unless impacts accumulate there, and the
    state in which it ends.
    """
    model, start, events = followed(which)
    found = [Flight(model, left) for left in (start, *(event.after for event in events))]
    ended = [event.before for event in events]
    if events[-1].time - events[-2].time > 1e-6:
        ended.append(found[-1].state(model.lift(UNTIL)))
    return list(zip(found, ended))


def energy(model: Model, state: State, frame: Vector = (0, 0)) -> mpf:
    across, up = state.VX - frame[0], state.VY - frame[1]
    return model.g * state.Y + (across**2 + up**2 + model.k2 * state.omega**2) / 2


@each_row("which", range(len(STARTS)))
def test_flight_keeps_the_energy_holds(which: int) -> None:
    for flight, landed in flights(which):
        assert abs(energy(flight.model, landed) - energy(flight.model, flight.start)) < SMALL


@pytest.mark.parametrize("which", range(len(STARTS)))
def test_flight_skips_no_contact_holds(which: int) -> None:
    for flight, landed in flights(which):
        lasted = landed.t - flight.start.t
        for part in range(1, 60):
            assert min(gap for gap, _ in flight.gaps(flight.start.t + lasted * part / 60)) > 0


@each_row("which", range(len(STARTS)))
def test_flight_ends_with_one_corner_on_the_table_and_approaching_holds(which: int) -> None:
    model, _, events = followed(which)
    for (flight, landed), event in zip(flights(which), events):
        gaps = flight.gaps(landed.t)
        assert abs(gaps[event.corner][0]) < SMALL and gaps[event.corner][1] < 0
        assert all(gap > SMALL for corner, (gap, _) in enumerate(gaps) if corner != event.corner)


@each_row("which", range(len(STARTS)))
def test_second_derivative_of_the_gaps_is_bounded_holds(which: int) -> None:
    step = MP.mpf(10) ** -20
    for flight, landed in flights(which):
        for part in range(5):
            t = flight.start.t + (landed.t - flight.start.t) * part / 5
            for (_, early), (_, late) in zip(flight.gaps(t - step), flight.gaps(t + step)):
                assert abs(late - early) / (2 * step) <= flight.bound()


@each_row("which", range(len(STARTS)))
def test_impact_pushes_within_the_friction_cone_and_adds_no_energy_holds(which: int) -> None:
    model, _, events = followed(which)
    for event in events:
        along, up = event.after.VX - event.before.VX, event.after.VY - event.before.VY
        frame = model.table(event.time)[1:]
        assert up > 0 and abs(along) <= model.mu * up + SMALL
        assert energy(model, event.after, frame) <= energy(model, event.before, frame) + SMALL
        assert Flight(model, event.after).gaps(event.time)[event.corner][1] > 0
        assert event.before[:4] == event.after[:4]


@each_row("which", range(len(STARTS)))
def test_mirrored_start_gives_the_mirrored_orbit_holds(which: int) -> None:
    model, start, events = followed(which)

    def mirrored(state: State) -> State:
        return state._replace(X=-state.X, theta=-state.theta, VX=-state.VX, omega=-state.omega)

    numbers = STARTS[which][0]
    turned = Setting(**{**vars(numbers), "A_x": -numbers.A_x})
    try:
        found = reference_orbit(turned, mirrored(start), UNTIL)
    except Chatter as stopped:
        found = list(stopped.events)
    assert found == [
        Event(
            event.time,
            MIRROR[event.corner],
            event.mode,
            mirrored(event.before),
            mirrored(event.after),
        )
        for event in events
    ]


@pytest.mark.exhaust
@each_row("which", range(len(STARTS)))
def test_more_digits_give_the_same_orbit_holds(which: int) -> None:
    (_, _, coarse), (_, _, fine) = followed(which), followed(which, 70)
    assert [(event.corner, event.mode) for event in coarse] == [
        (event.corner, event.mode) for event in fine
    ]
    for one, other in zip(coarse, fine):
        assert (
            max(abs(MP.mpf(ours) - MP.mpf(theirs)) for ours, theirs in zip(one.after, other.after))
            < MP.mpf(10) ** -25
        )


def test_orbit_goes_on_from_the_state_after_an_impact_holds() -> None:
    model, _, events = followed(0)
    rest = reference_orbit(SHAKEN, events[1].after, UNTIL)
    assert [(event.corner, event.mode) for event in rest] == [
        (event.corner, event.mode) for event in events[2:]
    ]
    assert max(abs(ours - theirs) for ours, theirs in zip(rest[-1].after, events[-1].after)) < SMALL


def test_drop_on_a_still_table_lands_at_the_root_of_the_parabola_holds() -> None:
    start = dropped(STILL, "0.4", "0.003", VY="-0.2", X=7, VX=2, t=5)
    event = reference_orbit(STILL, start, "5.03")[0]
    g, speed, height = (MP.mpf(number) for number in ("9.81", "0.2", "0.003"))
    lasted = (MP.sqrt(speed**2 + 2 * g * height) - speed) / g
    assert event.corner == 2
    assert abs(event.time - 5 - lasted) < SMALL and abs(event.before.X - 7 - 2 * lasted) < SMALL


def test_turning_part_lands_where_the_gap_has_its_first_root_holds() -> None:
    start = dropped(STILL, "0.4", "0.003", omega=80)
    event = reference_orbit(STILL, start, "0.05")[0]
    with mpmath.workdps(50):
        a, b = mpmath.mpf("0.01"), mpmath.mpf("0.02")

        def lowest(t: mpf) -> mpf:
            theta = mpmath.mpf("0.4") + 80 * t
            return (
                mpmath.mpf(start.Y)
                - mpmath.mpf("9.81") * t**2 / 2
                - a * abs(mpmath.sin(theta))
                - b * abs(mpmath.cos(theta))
            )

        steps = [mpmath.mpf(step) / 100000 for step in range(1, 5000)]
        under = next(t for t in steps if lowest(t) < 0)
        root = mpmath.findroot(
            lowest, (under - mpmath.mpf("1e-5"), under), solver="anderson", tol=1e-80
        )
        assert abs(mpmath.mpf(event.time) - root) < mpmath.mpf("1e-35")


def test_part_on_a_corner_below_its_centre_rebounds_with_e_times_its_speed_holds() -> None:
    half = Fraction(1, 2)
    for speed in (Fraction(2), Fraction(1, 3)):
        assert impact((0, -speed, 0), (0, -5), Fraction(25, 3), half, half).motion == (
            0,
            speed / 2,
            0,
        )
    block = setting("0.03", "0.04", e="0.5", mu="0.3")
    event = reference_orbit(block, dropped(block, MP.atan(MP.mpf(3) / 4), "0.01"), "0.05")[0]
    assert (
        max(abs(event.after.VY + event.before.VY / 2), abs(event.after.VX), abs(event.after.omega))
        < SMALL
    )
    assert event.before.VY < 0


# motion and place of a corner, k^2, restitution and friction
Struck = tuple[Motion, Vector, Fraction, Fraction, Fraction]


def random_impacts(count: int) -> list[Struck]:
    """Exact motions of exact rectangles turned by exact angles, at a corner that approaches; some
    without friction, restitution or sliding.
    """
    dice = random.Random(1992)

    def number(low: int, high: int) -> Fraction:
        return Fraction(dice.randint(60 * low, 60 * high), 60)

    found: list[Struck] = []
    while len(found) < count:
        a, b, half_tangent = number(0, 1) + 1, number(1, 3), number(-1, 1)
        cosine, sine = (
            (1 - half_tangent**2) / (1 + half_tangent**2),
            2 * half_tangent / (1 + half_tangent**2),
        )
        along, up = (side * half for side, half in zip(dice.choice(CORNERS), (a, b)))
        place = (cosine * along - sine * up, sine * along + cosine * up)
        motion = (number(-1, 1), number(-2, 1), number(-1, 1))
        if dice.random() < 0.2:
            motion = (motion[2] * place[1], *motion[1:])
        if corner_velocity(motion, place)[1] < 0:
            found.append(
                (
                    motion,
                    place,
                    (a**2 + b**2) / 3,
                    dice.choice((Fraction(0), Fraction(1), number(0, 1))),
                    dice.choice((Fraction(0), number(0, 1) * Fraction(9, 10), number(0, 1) / 4)),
                )
            )
    return found


def sign(number: Fraction) -> int:
    return (number > 0) - (number < 0)


def derived(
    motion: Motion, place: Vector, k2: Fraction, e: Fraction, mu: Fraction
) -> dict[Symbol, Rational]:
    """The symbols of the derived modes, and their numbers in this impact."""
    x, y = place
    tangential, normal = corner_velocity(motion, place)
    way = sign(tangential) or -sign(x * y) or 1
    numbers = {
        s.B1: 1 + y**2 / k2,
        s.B2: 1 + x**2 / k2,
        s.B3: x * y / k2,
        s.S0: tangential,
        s.C0: normal,
        s.e: e,
        s.mu: mu,
        s.sigma: Fraction(way),
    }
    return {
        name: Rational(number.numerator, number.denominator) for name, number in numbers.items()
    }


def modes_that_hold(exact: dict[Symbol, Rational]) -> set[str]:
    """By the derived conditions: all modes whose boundaries the impact lies on, if on any."""
    past_compression, past_restitution, back = (
        criterion().xreplace(exact)
        for criterion in (s.slides_through_compression, s.slides_through_restitution, s.slides_back)
    )
    if past_restitution > 0:
        return {"sliding"}
    when = [
        name
        for name, holds in (
            ("compression", past_compression <= 0),
            ("restitution", past_compression >= 0),
        )
        if holds
    ]
    then = [name for name, holds in (("sticking", back <= 0), ("reversed", back > 0)) if holds]
    return {f"{one}-in-{other}" for one in then for other in when} | (
        {"sliding"} if past_restitution == 0 else set()
    )


def test_impacts_are_those_of_the_derived_modes_holds() -> None:
    seen: Counter[str] = Counter()
    for given in random_impacts(100):
        met = impact(*given)
        exact = derived(*given)
        seen[met.mode] += 1
        assert met.mode in modes_that_hold(exact), (given, met)
        assert [
            Rational(part.numerator, part.denominator) for part in map(Fraction, met.impulse)
        ] == [part.xreplace(exact) for part in s.contact_impulse(met.mode)], (given, met)
        assert [
            Rational(part.numerator, part.denominator)
            for part in corner_velocity(met.motion, given[1])
        ] == [part.xreplace(exact) for part in s.velocity_after_contact(met.mode)]
    assert set(seen) == set(s.MODES), seen


def test_corner_that_stops_just_where_a_phase_ends_holds() -> None:
    """B1 = 4, B2 = 1, B3 = 0 and C0 = -2: with mu = 1/8 a unit of normal impulse takes 1/2 from S;
    compression ends at 2, the impact at 3.
    """
    below, k2, half = (0, -5), Fraction(25, 3), Fraction(1, 2)
    for start, mode in (
        (Fraction(1), "sticking-in-compression"),
        (Fraction(5, 4), "sticking-in-restitution"),
        (Fraction(3, 2), "sliding"),
    ):
        for way in (1, -1):
            met = impact((way * start, -2, 0), below, k2, half, Fraction(1, 8))
            assert (met.mode, corner_velocity(met.motion, below)) == (mode, (0, 1))
            assert met.impulse == (-way * start / 4, 3)


def test_rounded_impacts_are_the_exact_ones_holds() -> None:
    def rounded(value: Number | tuple[Number, ...]) -> mpf | tuple[mpf, ...]:
        return (
            tuple(map(rounded, value))
            if isinstance(value, tuple)
            else MP.mpf(value.numerator) / value.denominator
        )

    moving = [given for given in random_impacts(100) if corner_velocity(given[0], given[1])[0]]
    assert len(moving) > 60
    for given in moving:
        exact, rounding = impact(*given), impact(*map(rounded, given))
        assert (
            max(abs(rounded(ours) - theirs) for ours, theirs in zip(exact.motion, rounding.motion))
            < SMALL
        )


def dip(depth: str) -> Gaps:
    """A gap that touches -depth at t = 1/3 and is high elsewhere, beside one that falls to 0 at t =
    3/4.
    """

    def gaps(t: mpf) -> list[tuple[mpf, mpf]]:
        return [
            ((t - MP.mpf(1) / 3) ** 2 - MP.mpf(depth), 2 * (t - MP.mpf(1) / 3)),
            (3 - 4 * t, MP.mpf(-4)),
        ]

    return gaps


def test_search_finds_the_first_of_two_close_roots_holds() -> None:
    time, corner = first_crossing(
        dip("1e-20"), MP.mpf(2), MP.mpf(0), MP.mpf(1), MP.mpf("1e-40")
    ) or (0, None)
    assert corner == 0 and abs(time - MP.mpf(1) / 3 + MP.mpf("1e-10")) < MP.mpf("1e-28")


def test_search_passes_a_gap_that_only_comes_close_holds() -> None:
    time, corner = first_crossing(
        dip("-1e-20"), MP.mpf(2), MP.mpf(0), MP.mpf(1), MP.mpf("1e-40")
    ) or (0, None)
    assert corner == 1 and abs(time - MP.mpf("0.75")) < SMALL


def test_rejects_a_gap_that_touches_the_table() -> None:
    with pytest.raises(Undecided, match="grazes"):
        first_crossing(dip("0"), MP.mpf(2), MP.mpf(0), MP.mpf(1), MP.mpf("1e-40"))


def test_rejects_two_corners_that_strike_together() -> None:
    with pytest.raises(Simultaneous, match="corners 2 and 3 strike together"):
        reference_orbit(STILL, dropped(STILL, 0, "0.001"), 1)


def tipping() -> State:
    """Lying on its long side: corner 1 strikes at once, while corner 2, as good as on the table,
    rises until then.
    """
    return dropped(STILL, MP.pi / 2 + MP.mpf("1e-14"), "1e-20", VY="-0.1", omega="5.1")


def test_rejects_a_corner_on_the_table_that_the_impact_of_another_pushes_down() -> None:
    with pytest.raises(Simultaneous, match="corners 1 and 2"):
        reference_orbit(STILL, tipping(), "0.001")


def test_corners_farther_apart_than_together_strike_one_after_the_other_holds() -> None:
    first, second = reference_orbit(STILL, tipping(), "1e-9", together="1e-18")
    assert (first.corner, second.corner) == (1, 2) and 0 < first.time < second.time < MP.mpf("1e-9")


def test_part_that_leaves_the_table_at_the_start_flies_holds() -> None:
    block = setting(3, 4, e="1/2", mu="1/2")
    assert reference_orbit(block, State(0, 0, 4, 0, 0, 1, 0), "0.1") == []
    with pytest.raises(SceneError, match="is not above the table"):
        reference_orbit(block, State(0, 0, 4, 0, 0, -1, 0), "0.1")


def test_rejects_chatter_with_the_impacts_until_then() -> None:
    upright = setting("0.03", "0.04", e="0.2", mu="0.3")
    with pytest.raises(Chatter, match="more than 20 impacts within") as stopped:
        reference_orbit(upright, dropped(upright, MP.atan(MP.mpf(3) / 4), "0.001"), 1)
    times = [event.time for event in stopped.value.events]
    assert (
        len(times) > 20
        and times[-1] - times[-21] < 1e-6
        and all(early < late for early, late in pairwise(times))
    )


def test_rejects_a_corner_that_stays_on_the_table() -> None:
    dead = setting("0.01", "0.02", e=0, mu="0.3")
    with pytest.raises(Chatter, match="corner 2 stays on the table") as stopped:
        reference_orbit(dead, dropped(dead, "0.3", "0.001"), 1)
    assert len(stopped.value.events) == 1 and isinstance(stopped.value, Stopped)


def test_rejects_a_start_under_the_table() -> None:
    with pytest.raises(SceneError, match="corner 2 is not above the table"):
        reference_orbit(STILL, dropped(STILL, "0.3", "-0.001"), 1)


def test_rejects_an_impact_of_a_corner_that_leaves() -> None:
    with pytest.raises(SceneError, match="does not approach"):
        impact((0, 1, 0), (0, -5), Fraction(25, 3), 1, 0)


def test_rejects_a_corner_that_jams() -> None:
    with pytest.raises(SceneError, match="jams"):
        impact((Fraction(9), -1, 0), (Fraction(1), Fraction(-1)), Fraction(2, 3), Fraction(1, 2), 9)


def test_reference_shares_nothing_with_what_it_measures_holds() -> None:
    text = Path(__file__).with_name("reference.py").read_text(encoding="utf-8")
    nodes = list(ast.walk(ast.parse(text)))
    named = {name.name for node in nodes if isinstance(node, ast.Import) for name in node.names}
    named |= {str(node.module) for node in nodes if isinstance(node, ast.ImportFrom)}
    ours = {"juggleproof.scenes.errors"}
    assert ours <= named
    assert named - ours == {
        "__future__",
        "collections.abc",
        "dataclasses",
        "fractions",
        "mpmath",
        "typing",
    }
