"""The impact of a corner: the derived modes against a walk through impulse space in exact numbers,
step by step, that knows no formulas.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from typing import Any, NamedTuple

import pytest
from sympy import Expr, S, lambdify

import juggleproof.symbolic as s
from tests.rows import each_row

COUNT = 1500
NAMES = (s.B1, s.B2, s.B3, s.S0, s.C0, s.e, s.mu, s.sigma, s.P_y)


class Impact(NamedTuple):
    """The numbers of one impact, and the corner that it is of."""

    x_c: Fraction
    y_c: Fraction
    J: Fraction
    S0: Fraction
    C0: Fraction
    e: Fraction
    mu: Fraction

    @property
    def response(self) -> tuple[Fraction, Fraction, Fraction]:
        return 1 + self.y_c**2 / self.J, 1 + self.x_c**2 / self.J, self.x_c * self.y_c / self.J


class Walked(NamedTuple):
    """The end of a walk: impulse, velocity, and the mode."""

    along: Fraction
    away: Fraction
    S: Fraction
    C: Fraction
    mode: str


def sign(number: Fraction) -> int:
    return (number > 0) - (number < 0)


def walked(one: Impact) -> Walked:
    """The walk: on each piece friction is what Coulomb says, until the corner stops, compression is
    greatest, or the impact ends.
    """
    B1, B2, B3 = one.response

    def going_on_from_rest() -> tuple[int, Fraction]:
        """(direction of sliding or 0, tangential impulse for each unit of the normal one) of a
        corner with S = 0.
        """
        for way in (1, -1):
            if (
                way * (-way * one.mu * B1 - B3) > 0
            ):  # the velocity that this friction leaves has the way that it opposes
                return way, -way * one.mu
        return 0, B3 / B1

    along, away, S, C, end = Fraction(0), Fraction(0), one.S0, one.C0, None
    way, slope = (sign(S), -sign(S) * one.mu) if S else going_on_from_rest()
    first, stopped = way, ""
    while True:
        rate_S, rate_C = B1 * slope - B3, B2 - B3 * slope
        assert rate_C > 0
        steps = [("stop", -S / rate_S)] if S * rate_S < 0 else []
        steps += [("compressed", -C / rate_C)] if end is None else [("end", end - away)]
        event, step = min(steps, key=lambda this: this[1])
        along, away, S, C = along + slope * step, away + step, S + rate_S * step, C + rate_C * step
        if event == "stop":
            way, slope = going_on_from_rest()
            stopped = "compression" if end is None else "restitution"
        elif event == "compressed":
            end = (1 + one.e) * away
        else:
            break
    mode = (
        "sliding"
        if way == first and not stopped and way
        else f"{'reversed' if way else 'sticking'}-in-{stopped or 'compression'}"
    )
    return Walked(along, away, S, C, mode)


def work(one: Impact, walk: Walked) -> Fraction:
    """What the impulse adds to the kinetic energy: velocities are linear in the impulse, so the
    mean of those before and after counts.
    """
    return (walk.along * (one.S0 + walk.S) + walk.away * (one.C0 + walk.C)) / 2


def random_impacts(count: int) -> Iterator[Impact]:
    """Impacts of corners that do not jam; some without restitution, without friction, with just
    enough of it, at rest, or above a corner.
    """
    dice = random.Random(1992)

    def number(low: int, high: int) -> Fraction:
        return Fraction(dice.randint(60 * low, 60 * high), 60)

    while count:
        x_c, y_c, J = number(-3, 3), number(-3, 3), number(0, 4) + Fraction(1, 30)
        mu = dice.choice((number(0, 1), number(0, 2), Fraction(0), abs(x_c * y_c) / (J + y_c**2)))
        e = dice.choice((number(0, 1), Fraction(0), Fraction(1)))
        S0 = dice.choice((number(-3, 3), number(-1, 1), Fraction(0)))
        one = Impact(x_c, y_c, J, S0, -number(0, 3) - Fraction(1, 60), e, mu)
        _, B2, B3 = one.response
        if B2 > mu * abs(B3):
            count -= 1
            yield one


@cache
def exactly(expression: Expr) -> Callable[..., Fraction]:
    """An expression as a function of the impact's numbers, with whole coefficients above and
    below.
    """
    above, below = (lambdify(NAMES, part, modules=[{}]) for part in S(expression).as_numer_denom())
    return lambda *values: above(*values) / Fraction(below(*values))


def numbers(one: Impact, sigma: int, normal: Fraction = Fraction(0)) -> tuple[Any, ...]:
    return (*one.response, one.S0, one.C0, one.e, one.mu, sigma, normal)


def modes_of(one: Impact, sigma: int) -> list[str]:
    """The modes whose conditions hold."""
    past_compression, past_restitution, back, stopping = (
        exactly(criterion())(*numbers(one, sigma))
        for criterion in (
            s.slides_through_compression,
            s.slides_through_restitution,
            s.slides_back,
            s.stopping_rate,
        )
    )
    found = ["sliding"] if past_restitution >= 0 else []
    then = [
        name
        for name, holds in (("sticking", back <= 0), ("reversed", back >= 0 and stopping > 0))
        if holds
    ]
    when = [
        name
        for name, holds in (
            ("compression", past_compression <= 0),
            ("restitution", past_compression >= 0 >= past_restitution),
        )
        if holds
    ]
    return found + [f"{one}-in-{other}" for one in then for other in when]


@pytest.mark.exhaust
def test_modes_are_those_of_the_walk_in_random_impacts_holds() -> None:
    met: Counter[str] = Counter()
    for one in random_impacts(COUNT):
        walk = walked(one)
        met[walk.mode] += 1
        for sigma in (sign(one.S0),) if one.S0 else (1, -1):
            modes = modes_of(one, sigma)
            assert walk.mode in modes or not one.S0, (one, walk, modes)
            assert modes
            for mode in modes:
                values = numbers(one, sigma, walk.away)
                assert [exactly(part)(*values) for part in s.contact_impulse(mode)] == [
                    walk.along,
                    walk.away,
                ], (one, mode)
                assert [exactly(part)(*values) for part in s.velocity_after_contact(mode)] == [
                    walk.S,
                    walk.C,
                ], (one, mode)
                assert exactly(s.normal_impulse(mode))(*values) == walk.away
                assert exactly(s.tangential_impulse(mode))(*values) == walk.along
                if met[mode] <= 40:
                    assert exactly(s.energy_gained_in_contact(mode))(*values) == work(one, walk), (
                        one,
                        mode,
                    )
    assert set(met) == set(s.MODES) and min(met.values()) > COUNT // 100, met


def test_impacts_keep_what_they_guarantee_holds() -> None:
    for one in random_impacts(COUNT):
        walk = walked(one)
        assert walk.away > 0 and abs(walk.along) <= one.mu * walk.away and walk.C >= 0
        assert work(one, walk) <= 0


def test_energy_gained_is_that_of_the_rigid_body_holds() -> None:
    dice = random.Random(1)
    for one in random_impacts(200):
        walk, omega = walked(one), Fraction(dice.randint(-9, 9), 7)
        v_x, v_y = one.S0 + omega * one.y_c, one.C0 - omega * one.x_c
        after = (
            v_x + walk.along,
            v_y + walk.away,
            omega + (one.x_c * walk.away - one.y_c * walk.along) / one.J,
        )
        gained = (
            after[0] ** 2
            + after[1] ** 2
            + one.J * after[2] ** 2
            - v_x**2
            - v_y**2
            - one.J * omega**2
        ) / 2
        assert gained == work(one, walk)
        assert (after[0] - after[2] * one.y_c, after[1] + after[2] * one.x_c) == (walk.S, walk.C)
        values = {
            s.x_c: one.x_c,
            s.y_c: one.y_c,
            s.J: one.J,
            s.c_x: v_x,
            s.c_y: v_y,
            s.omega: omega,
            s.P_x: walk.along,
            s.P_y: walk.away,
        }
        exact = {name: S(value.numerator) / value.denominator for name, value in values.items()}
        assert s.kinetic_energy_gained().xreplace(exact) == S(gained.numerator) / gained.denominator


def recalled() -> dict[str, tuple[Expr, Expr]]:
    """The table of Wang and Mason as it is remembered: the normal impulse, and the tangential one
    in terms of it.
    """
    B1, B2, B3, S0, C0, e, mu, sigma, P_y = NAMES
    while_sliding = -(1 + e) * C0 / (B2 + sigma * mu * B3)
    sticking, back = (B3 * P_y - S0) / B1, sigma * mu * (P_y - 2 * S0 / (B3 + sigma * mu * B1))
    return {
        "sliding": (while_sliding, -sigma * mu * P_y),
        "sticking-in-compression": (-(1 + e) * (B1 * C0 + B3 * S0) / (B1 * B2 - B3**2), sticking),
        "sticking-in-restitution": (while_sliding, sticking),
        "reversed-in-compression": (
            -(1 + e)
            * (C0 + 2 * sigma * mu * B3 * S0 / (B3 + sigma * mu * B1))
            / (B2 - sigma * mu * B3),
            back,
        ),
        "reversed-in-restitution": (while_sliding, back),
    }


@each_row("way", [1, -1])
@each_row("mode", s.MODES)
def test_modes_are_those_of_the_table_holds(mode: str, way: int) -> None:
    for ours, theirs in zip((s.normal_impulse(mode), s.tangential_impulse(mode)), recalled()[mode]):
        assert s.lowest_terms((ours - theirs).xreplace({s.sigma: S(way)})) == 0


@each_row("way", [1, -1])
def test_conditions_are_those_of_the_table_holds(way: int) -> None:
    B1, B2, B3, S0, C0, e, mu, sigma, _ = NAMES
    P_d, P_q = (B2 + sigma * mu * B3) * sigma * S0, (mu * B1 + sigma * B3) * -C0
    for ours, theirs in (
        (s.slides_through_compression(), P_d - P_q),
        (s.slides_through_restitution(), P_d - (1 + e) * P_q),
    ):
        assert s.lowest_terms((ours - theirs).xreplace({sigma: S(way)})) == 0


def test_newton_restitution_agrees_with_poisson_only_where_the_corner_sticks_at_once_holds() -> (
    None
):
    at_rest, poisson, newton = (
        {s.S0: S.Zero},
        s.contact_impulse("sticking-in-compression"),
        s.newton_impulse(),
    )
    assert all(
        s.lowest_terms((one - other).xreplace(at_rest)) == 0 for one, other in zip(poisson, newton)
    )
    assert s.lowest_terms(poisson[1] - newton[1]) != 0


def test_walk_fails_without_room_for_friction() -> None:
    with pytest.raises(AssertionError):
        walked(
            Impact(
                Fraction(1),
                Fraction(-2),
                Fraction(5, 3),
                Fraction(3),
                Fraction(-1),
                Fraction(1, 2),
                Fraction(3, 2),
            )
        )
    jammed = {s.B1: 1 + S(12) / 5, s.B2: S(8) / 5, s.B3: -S(6) / 5, s.mu: S(3) / 2, s.sigma: 1}
    assert s.closing_rate().xreplace(jammed) < 0
