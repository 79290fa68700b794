"""The table that moves as a sine: what is derived against differences of the simulated motion, and
against the curves that the scene draws.
"""

from __future__ import annotations

import re
from fractions import Fraction
from math import cos, hypot, pi, sin, sqrt
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Expr, Rational, lambdify, sympify

import juggleproof.symbolic as s
from juggleproof.scenes.table import curves
from tests.rows import each_row

STEP = 1e-6
shares = st.fractions(Fraction(1, 40), Fraction(9, 10), max_denominator=40)


def number(value: Expr, alpha: float, G: float, **others: float) -> float:
    """The value of a derived expression in floats."""
    values = {s.alpha: alpha, s.G: G, s.half_turn: pi}
    return float(value.subs(values | {getattr(s, name): one for name, one in others.items()}))


def next_impact(
    alpha: float, G: float, phase: float, closing: float, near: float
) -> tuple[float, float]:
    """Phase and closing speed of the impact near this phase, by Newton's method, with no formula of
    `symbolic`; the bounce where the table falls at G is at phase 0.
    """
    c = pi * (1 - alpha) / (1 + alpha)

    def table(x: float) -> tuple[float, float]:
        turn = 2 * pi * x
        height = (c * sin(turn) + G * cos(turn)) / (2 * pi) ** 2
        return height, (c * cos(turn) - G * sin(turn)) / (2 * pi)

    height, velocity = table(phase)
    speed = velocity + alpha * closing
    for _ in range(20):
        flown = near - phase
        gap = height + speed * flown - flown**2 / 2 - table(near)[0]
        near -= gap / (speed - flown - table(near)[1])
    return near, table(near)[1] - (speed - (near - phase))


@given(alpha=shares, G=st.fractions(-2, 2, max_denominator=40))
@settings(max_examples=20, deadline=None)
def test_jacobian_is_that_of_impacts_nearby_holds(alpha: Fraction, G: Fraction) -> None:
    a, fall = float(alpha), float(G)
    closing = number(s.bounce_closing_speed(), a, fall)
    assert next_impact(a, fall, 0, closing, 1) == pytest.approx((1, closing), abs=1e-12)
    for column, (dx, ds) in enumerate([(STEP, 0.0), (0.0, STEP)]):
        ahead = next_impact(a, fall, dx, closing + ds, 1)
        behind = next_impact(a, fall, -dx, closing - ds, 1)
        for row in range(2):
            slope = (ahead[row] - behind[row]) / (2 * STEP)
            assert slope == pytest.approx(
                number(s.bounce_jacobian()[row, column], a, fall), abs=1e-6
            )


@given(alpha=shares, G=st.fractions(-1, 3, max_denominator=40))
@settings(max_examples=30, deadline=None)
def test_multipliers_lie_in_the_unit_circle_between_birth_and_doubling_holds(
    alpha: Fraction, G: Fraction
) -> None:
    at = {s.alpha: Rational(str(alpha)), s.G: Rational(str(G))}
    trace, product = (float(one.subs(at)) for one in (s.bounce_trace(), s.bounce_determinant()))
    doubling = s.doubling_fall().subs(at)
    root = complex(trace**2 - 4 * product) ** 0.5
    largest = max(abs(trace + root), abs(trace - root)) / 2
    if abs(largest - 1) > 1e-9:
        assert (largest < 1) == (0 < G < doubling)


def test_curves_at_exact_points_hold() -> None:
    at = {s.alpha: Rational(1, 3)}
    assert s.birth_drive().subs(at) == s.half_turn / 2
    assert s.doubling_fall().subs(at) == Rational(5, 4)
    assert (
        s.squared_drive()
        .subs(at | {s.G: Rational(5, 4)})
        .equals(s.half_turn**2 / 4 + Rational(25, 16))
    )
    assert s.bounce_closing_speed().subs(at) == Rational(3, 4)


def test_the_page_shows_what_is_derived_holds() -> None:
    page = (Path(__file__).parents[2] / "docs" / "sine.md").read_text(encoding="utf-8")
    closed, gap = re.findall(r"```text\n(.*?)```", page, re.DOTALL)
    names = {name: getattr(s, name) for name in s.NAMES[".sine_table"].split() + ["alpha", "t"]}
    names |= {"pi": s.half_turn, "birth_drive": s.birth_drive()}
    shown = dict(line.split(" = ") for line in closed.splitlines())
    derived = {name: getattr(s, name)() for name in shown}
    pairs = list(zip(map(shown.get, derived), derived.values()))
    pairs += zip(gap.splitlines(), s.other_bounce_gap(), strict=True)
    assert len(pairs) == 8
    for text, value in pairs:
        assert s.lowest_terms(sympify(text, locals=names) - value) == 0, text


@each_row("alpha", [0.02, 0.05, 0.098, 0.3])
def test_curves_are_those_that_the_scene_draws_holds(alpha: float) -> None:
    birth, doubling = number(s.birth_drive(), alpha, 0), number(s.doubling_fall(), alpha, 0)
    assert curves.birth(alpha) == pytest.approx(birth)
    assert curves.doubling(alpha) == pytest.approx(hypot(birth, doubling))
    assert curves.doubling(alpha) == pytest.approx(sqrt(number(s.squared_drive(), alpha, doubling)))


@each_row("alpha", [0.05, 0.098, 0.13])
def test_gap_and_rate_of_the_other_bounce_vanish_where_the_scene_has_it_graze_holds(
    alpha: float,
) -> None:
    names = (s.G, s.t, s.cosine_t, s.sine_t)
    gap_and_rate = lambdify(
        names, list(s.other_bounce_gap().subs({s.alpha: alpha, s.half_turn: pi}))
    )

    def lowest(drive: float) -> list[float]:
        fall = sqrt(drive**2 - curves.birth(alpha) ** 2)
        times = (k / 1000 for k in range(50, 990))
        return min(gap_and_rate(fall, t, cos(2 * pi * t), sin(2 * pi * t)) for t in times)

    height, rate = lowest(curves.grazing(alpha))
    assert abs(height) < 1e-6 and abs(rate) < 1e-3
    assert lowest(curves.grazing(alpha) - 0.02)[0] > 1e-4
    assert lowest(curves.grazing(alpha) + 0.02)[0] < -1e-4
