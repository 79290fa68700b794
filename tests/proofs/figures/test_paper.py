"""Every curve on a figure satisfies the equation that it stands for; the equations are evaluated by
SymPy, not by what draws.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
from sympy import Expr, Symbol

from juggleproof import symbolic
from juggleproof.proofs.figures import TABLE
from juggleproof.symbolic import State
from juggleproof.symbolic.algebra import alpha, beta, g, r, t, v
from tests.proofs.figures.drawn import curves, figure, points, states
from tests.rows import each_row

TOLERANCE = 1e-9
VANISH: dict[str, Callable[[], Expr]] = {
    "bounce-line": symbolic.collision_margin,
    "B10": symbolic.energy_change_1,
    "boundary-of-R": symbolic.region_margin,
    "E-max": lambda: symbolic.total_energy() - symbolic.E_max(),
    "level-of-p": lambda: symbolic.total_energy() - symbolic.energy_of_p(),
    "speed-of-e-1": lambda: v - symbolic.e_1()[1],
}
WHERE = [
    ("fig-6", "bounce-line"),
    ("fig-8", "bounce-line"),
    ("fig-8", "B10"),
    ("fig-8", "E-max"),
    ("fig-8", "boundary-of-R"),
    ("fig-11", "B10"),
    ("fig-11", "bounce-line"),
    ("fig-12", "boundary-of-R"),
    ("fig-12", "bounce-line"),
    ("fig-13", "B10"),
    ("fig-13", "boundary-of-R"),
    ("fig-13", "level-of-p"),
    ("fig-13", "speed-of-e-1"),
    ("fig-13", "bounce-line"),
    ("fig-14", "boundary-of-R"),
    ("fig-14", "bounce-line"),
]


def at(expression: Expr, values: dict[Symbol, float]) -> float:
    return float(expression.subs(values))


@each_row(("slug", "name"), WHERE)
def test_curve_satisfies_its_equation_holds(slug: str, name: str) -> None:
    equation = VANISH[name]()
    for where in states(slug, name):
        assert abs(at(equation, where)) < TOLERANCE, where
        assert where[beta] > -TOLERANCE


def test_line_drawn_elsewhere_fails_without_its_equation() -> None:
    equation = symbolic.collision_margin()
    assert any(abs(at(equation, where)) > 0.1 for where in states("fig-8", "B10"))


def test_levels_of_energy_are_levels_holds() -> None:
    from juggleproof.proofs.figures.paper import LEVELS

    for level in LEVELS:
        for where in states("fig-7", f"level-{level}"):
            assert abs(at(symbolic.total_energy(), where) - level) < TOLERANCE


@each_row(
    ("slug", "name", "margins"),
    [
        ("fig-6", "B1", [symbolic.collision_margin]),
        ("fig-12", "B1", [symbolic.collision_margin]),
        ("fig-6", "B2", [lambda: -symbolic.collision_margin()]),
        ("fig-12", "R", [symbolic.region_margin]),
        ("fig-11", "B1+", [symbolic.collision_margin, symbolic.energy_change_1]),
        ("fig-11", "B1-", [symbolic.collision_margin, lambda: -symbolic.energy_change_1()]),
        (
            "fig-14",
            "K",
            [
                symbolic.region_margin,
                symbolic.collision_margin,
                lambda: Fraction(1, 32) - (v - symbolic.e_1()[1]) ** 2 / 2,
            ],
        ),
    ],
)
def test_outline_stays_on_the_right_side_holds(
    slug: str, name: str, margins: list[Callable[[], Expr]]
) -> None:
    for where in states(slug, name):
        assert where[beta] > -TOLERANCE
        assert all(at(margin(), where) > -TOLERANCE for margin in margins), where


def test_band_has_the_width_that_its_caption_says_holds() -> None:
    from juggleproof.symbolic.algebra import z2

    half = max(where[v] for where in states("fig-14", "K")) - float(
        symbolic.e_1()[1].subs({alpha: Fraction(1, 4), r: 1})
    )
    assert half == pytest.approx(0.25) and "1/4" in next(
        one.caption for one in TABLE if one.slug == "fig-14"
    )
    assert float(symbolic.relative_kinetic_energy().subs(z2, half)) == pytest.approx(1 / 32)


def test_band_beyond_B1_fails_without_small_epsilon() -> None:
    from juggleproof.proofs.figures.paper import outline_band

    with pytest.raises(ValueError, match="leaves B1"):
        outline_band(1.5)


@each_row(
    ("slug", "name", "state"),
    [
        ("fig-13", "p", symbolic.point_p),
        ("fig-13", "e-1", symbolic.e_1),
        ("fig-14", "e-1", symbolic.e_1),
        ("fig-8", "greatest-kept", lambda: symbolic.largest_kept_energy().state),
        ("fig-8", "greatest-gain", lambda: symbolic.largest_energy_change().state),
    ],
)
def test_states_with_a_dot_stand_where_they_are_holds(
    slug: str, name: str, state: Callable[[], State]
) -> None:
    from matplotlib.lines import Line2D

    (dot,) = [one for one in figure(slug).findobj(Line2D) if one.get_gid() == name]
    (curve,) = curves(slug, "boundary-of-R")
    place = dot.get_transform().transform(dot.get_xydata())[0]
    across, up = curve.get_transform().inverted().transform(place)
    height, speed = (float(entry.subs({alpha: Fraction(1, 4), r: 1, g: 1})) for entry in state())
    assert (across, up) == (pytest.approx(height / 2), pytest.approx(speed))


def test_table_and_its_phase_portrait_are_the_tables_motion_holds() -> None:
    height, speed = (entry.subs({r: 1, g: 1}) for entry in symbolic.table_at())
    for time, up in points("fig-10", "table"):
        assert up * 2 == pytest.approx(float(height.subs(t, 2 * (time % 1))), abs=TOLERANCE)
    for across, up in points("fig-10", "phase-portrait"):
        assert (
            across * 2 == pytest.approx(float(height.subs(t, 1 - up)), abs=TOLERANCE)
            and abs(up) < 1 + TOLERANCE
        )
        assert up == pytest.approx(float(speed.subs(t, 1 - up)))


def test_ball_flies_falls_on_the_table_and_is_sampled_by_f_holds() -> None:
    from juggleproof.proofs.figures.paper import START

    state, at_setting = START, {alpha: Fraction(1, 4), r: 1, g: 1}
    for k in range(6):
        path = points("fig-9", f"ball-{k}")
        start, stop = path[0], path[-1]
        assert start == (pytest.approx(k), pytest.approx(float(state[0]) / 2)) and stop[
            0
        ] == pytest.approx(k + 1)
        table = symbolic.table_at()[0].subs({r: 1, g: 1})
        assert all(2 * up > float(table.subs(t, 2 * (time - k))) - TOLERANCE for time, up in path)
        branch = (
            symbolic.f1()
            if symbolic.collision_margin().subs({beta: state[0], v: state[1], **at_setting}) > 0
            else symbolic.f2()
        )
        state = tuple(
            Fraction(str(entry.subs({beta: state[0], v: state[1], **at_setting})))
            for entry in branch
        )
        assert stop[1] * 2 == pytest.approx(float(state[0]))
