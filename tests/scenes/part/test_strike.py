"""The impact law: as derived, and with its guarantees."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
import sympy

import juggleproof.symbolic as s
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import (
    body,
    fresh_notes,
    moving,
    run,
    scene,
    standing,
    strike,
    table_one,
)
from juggleproof.scenes.part import strike as striking
from juggleproof.scenes.part.setting import Array
from juggleproof.scenes.part.strike import first_slide, impulse, mode_of
from tests.rows import each_row

# -------------------------------------------------------------------------------------------------
# The compiled impact law is the derived one: exactly, in all five modes, where the corner does not
# slide at first, and where friction jams it.

MODES = {
    strike.SLIDING: "sliding",
    strike.STICKING_IN_COMPRESSION: "sticking-in-compression",
    strike.STICKING_IN_RESTITUTION: "sticking-in-restitution",
    strike.REVERSED_IN_COMPRESSION: "reversed-in-compression",
    strike.REVERSED_IN_RESTITUTION: "reversed-in-restitution",
}
SYMBOLS = (s.S0, s.C0, s.B1, s.B2, s.B3, s.e, s.mu, s.sigma)


@cache
def as_function(which: str, mode: str = "") -> Callable[..., Fraction | list[Fraction]]:
    """A derived expression as a function of exact numbers."""
    found = getattr(s, which)(mode) if mode else getattr(s, which)()
    return sympy.lambdify(SYMBOLS, list(found) if mode else found, modules=[])


@cache
def cases(count: int = 2400) -> list[tuple[Fraction, ...]]:
    """(S0, C0, B1, B2, B3, e, mu): (B1 - 1)(B2 - 1) = B3^2, C0 < 0; a third without sliding at
    first, a third near boundaries of modes.
    """
    dice = random.Random(1992)

    def number(low: int, high: int) -> Fraction:
        return Fraction(dice.randint(12 * low, 12 * high), 12)

    found: list[tuple[Fraction, ...]] = []
    while len(found) < count:
        u, v, mu, e = (
            number(-2, 2),
            number(0, 2),
            number(0, 2),
            dice.choice((Fraction(0), Fraction(1), number(0, 1))),
        )
        B1, B2, B3 = 1 + u * u, 1 + v * v, u * v
        S0, C0 = (
            (Fraction(0) if len(found) % 3 == 0 else number(-3, 3)),
            -number(0, 3) - Fraction(1, 12),
        )
        sigma = first_slide(S0, B1, B3, mu)
        if len(found) % 3 == 1 and S0 and B2 + sigma * mu * B3 > 0:
            edge = (
                (1 + e * dice.choice((0, Fraction(1, 3), Fraction(2, 3), 1)))
                * (mu * B1 + sigma * B3)
                * -C0
                / (B2 + sigma * mu * B3)
            )
            S0 = sigma * edge if edge > 0 else S0
        found.append((S0, C0, B1, B2, B3, e, mu))
    return found


def test_impulse_is_the_derived_one_holds() -> None:
    seen: Counter[str] = Counter()
    for S0, C0, B1, B2, B3, e, mu in cases():
        sigma = first_slide(S0, B1, B3, mu)
        mode = mode_of(S0, C0, B1, B2, B3, e, mu, sigma)
        if mode == strike.JAMMING:
            continue
        seen[MODES[mode] + (" from no sliding" if S0 == 0 else "")] += 1
        assert list(impulse(mode, S0, C0, B1, B2, B3, e, mu, sigma)) == as_function(
            "contact_impulse", MODES[mode]
        )(S0, C0, B1, B2, B3, e, mu, sigma)
    assert sum(seen.values()) >= 500 and all(seen[name] >= 20 for name in MODES.values()), seen
    assert (
        seen["sliding from no sliding"] >= 20
        and seen["sticking-in-compression from no sliding"] >= 20
    ), seen


def test_mode_is_the_one_whose_criteria_hold_holds() -> None:
    for S0, C0, B1, B2, B3, e, mu in cases():
        sigma = first_slide(S0, B1, B3, mu)
        numbers = (S0, C0, B1, B2, B3, e, mu, sigma)
        mode = mode_of(*numbers)
        restitution, compression, back, closing, stopping = (
            as_function(name)(*numbers)
            for name in (
                "slides_through_restitution",
                "slides_through_compression",
                "slides_back",
                "closing_rate",
                "stopping_rate",
            )
        )
        if closing <= 0:
            assert mode == strike.JAMMING
            continue
        assert (mode == strike.SLIDING) == (restitution >= 0)
        if mode != strike.SLIDING:
            assert stopping > 0
            assert MODES[mode].endswith("in-compression") == (compression <= 0)
            assert MODES[mode].startswith("reversed") == (back > 0)


def test_jams_exactly_where_the_closing_rate_is_not_positive_holds() -> None:
    jammed = [
        case
        for case in cases()
        if as_function("closing_rate")(*case, first_slide(case[0], case[2], case[4], case[6])) <= 0
    ]
    assert len(jammed) >= 20
    for S0, C0, B1, B2, B3, e, mu in cases():
        met = mode_of(S0, C0, B1, B2, B3, e, mu, first_slide(S0, B1, B3, mu)) == strike.JAMMING
        assert met == ((S0, C0, B1, B2, B3, e, mu) in jammed)
    assert (
        mode_of(1, -1, 2, 2, 1, 0, 2, -1) == strike.JAMMING
        and mode_of(1, -1, 2, 3, 1, 0, 2, -1) != strike.JAMMING
    )


def test_corner_that_does_not_slide_at_first_slides_where_friction_fails_holds() -> None:
    """Friction needs B3/B1 of the normal impulse: with less it slides against it, with more it
    sticks, and exactly between both are one.
    """
    for B3 in (Fraction(1), Fraction(-1)):
        for mu, sticks in ((Fraction(1, 4), False), (Fraction(1, 2), None), (Fraction(3, 4), True)):
            given = (Fraction(0), Fraction(-1), Fraction(2), Fraction(2), B3, Fraction(1, 2), mu)
            sigma = first_slide(*(given[k] for k in (0, 2, 4, 6)))
            mode = mode_of(*given, sigma)
            P_x, P_y = impulse(mode, *given, sigma)
            S = given[2] * P_x - B3 * P_y
            assert S == 0 if sticks is not False else S * B3 < 0, (B3, mu, S)


@each_row("sign", [1, -1])
def test_mirror_image_of_an_impact_is_one_holds(sign: int) -> None:
    for S0, C0, B1, B2, B3, e, mu in cases()[:300]:
        here, there = ((sign * S0, C0, B1, B2, sign * B3, e, mu) for sign in (sign, -sign))
        ways = [first_slide(given[0], given[2], given[4], mu) for given in (here, there)]
        modes = [mode_of(*given, way) for given, way in zip((here, there), ways)]
        assert modes[0] == modes[1]
        if modes[0] != strike.JAMMING:
            (x, y), (left, up) = (
                impulse(modes[0], *given, way) for given, way in zip((here, there), ways)
            )
            assert (x, y) == (-left, up)


# -------------------------------------------------------------------------------------------------
# What the impact law guarantees holds at every one of a million impacts; and each count can fail: a
# wrong law is noticed.

Law = Callable[..., tuple[float, float]]  # an impulse
SCENES: tuple[dict[str, float], ...] = (
    {"e": 0.7, "mu": 0.08},
    {"e": 1.0, "mu": 1.3},
    {"e": 0.9, "mu": 0.5},
    {"e": 0.4, "mu": 0.2},
    {"e": 0.0, "mu": 0.08},
    {"e": 0.7, "mu": 0.08, "a": 0.005, "b": 0.01},
    {"e": 0.8, "mu": 1.0, "a": 0.01, "b": 0.01},
    {"e": 0.7, "mu": 0.0, "tolerance": 1e-9},
    {"e": 0.95, "mu": 0.8, "a": 0.002, "b": 0.02},
)


@pytest.mark.exhaust
def test_million_impacts_break_no_guarantee_holds() -> None:
    impacts = 0.0
    for given in SCENES:
        block = scene(**given)
        done = table_one(block, ensembles=1, horizon=3.0, check=True).run
        impacts += done.notes[:, body.IMPACTS].sum()
        assert (
            done.violations() == dict.fromkeys(done.violations(), 0) and len(done.violations()) == 5
        )
        assert done.notes[:, body.LEAST_GAP].min() >= -block.tolerance
    assert impacts >= 1e6


def struck(law: Law, monkeypatch: pytest.MonkeyPatch) -> Array:
    """The notes of one impact by another law."""
    block = scene(e=0.5, mu=0.3, A_y=0.0)
    z, notes = moving(block, 0, 0.1, 0.3, 0.5, -0.5, 3.0)[0], fresh_notes(1)[0]
    p, c, s = block.parameters(), np.cos(0.3), np.sin(0.3)
    monkeypatch.setattr(striking, "impulse", law)
    x, y = body.corner_x(p, 0, c, s), body.corner_y(p, 0, c, s)
    assert striking.strike_at(p, z, x, y, 0.0, 0.0, notes) == body.DONE
    return notes


@pytest.mark.parametrize(
    "wrong, counted",
    [
        (lambda x, y: (x, y), set()),
        (lambda x, y: (x, -y), {body.PULLS, body.CONES, body.CLOSINGS, body.GAINS}),
        (lambda x, y: (-4 * x, y), {body.CONES, body.GAINS}),
        (lambda x, y: (x, 0.5 * y), {body.CLOSINGS}),
        (lambda x, y: (3 * x, 3 * y), {body.GAINS}),
        (lambda x, y: (0.0, 0.1 * y), {body.CLOSINGS}),
    ],
)
def test_wrong_impulse_is_counted_holds(
    wrong: Law, counted: set[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    notes = struck(lambda *given: wrong(*impulse(*given)), monkeypatch)
    assert {
        k for k in (body.PULLS, body.CONES, body.GAINS, body.CLOSINGS) if notes[k]
    } == counted and notes[body.IMPACTS] == 1


def test_violations_of_a_run_are_those_of_its_notes_holds() -> None:
    done = table_one(scene(e=0.7, mu=0.08), ensembles=1, horizon=0.01, check=True).run
    for column in (body.PULLS, body.CONES, body.GAINS, body.CLOSINGS, body.SINKS):
        done.notes[5, column] += 2
        assert sum(done.violations().values()) == 2
        done.notes[5, column] -= 2


def test_run_that_is_not_checked_claims_nothing_holds() -> None:
    block = scene(e=0.7, mu=0.08)
    with pytest.raises(SceneError, match="not checked"):
        run(block, standing(block, [0.1]), 0.01).violations()
