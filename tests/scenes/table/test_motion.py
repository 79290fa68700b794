"""A ball on a table that moves as a sine: flights, rest, launch; pictures and the command."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import islice
from math import inf, pi
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.command import sine
from juggleproof.command.main import run
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.table.motion import (
    Table,
    bounce_phase,
    events,
    flights_to_bounce,
    landing,
    rested,
)
from tests.rows import each_row


def heights(table: Table, start: float, velocity: float, times: np.ndarray) -> np.ndarray:
    """F at these times after a start."""
    ball = table.derivative(np.array(start), 0) + velocity * times - times**2 / 2
    return np.asarray(ball - table.derivative(start + times, 0))


@given(st.floats(0, 0.9), st.floats(0.2, 6), st.floats(0, 1), st.floats(0.001, 2), st.booleans())
def test_a_flight_ends_at_the_first_zero_of_the_height(
    alpha: float, gamma: float, start: float, above: float, second: bool
) -> None:
    table = Table(alpha, gamma, (1.0, 0.0, 0.2) if second else (1.0,))
    velocity = float(table.derivative(np.array(start), 1)) + above
    duration, speed = (
        float(one[0]) for one in landing(table, np.array([start]), np.array([velocity]))
    )
    assert abs(heights(table, start, velocity, np.array(duration))) < 1e-9
    inside = np.linspace(0, duration, 20_001)[1:-1]
    assert heights(table, start, velocity, inside).min() > -1e-9
    own = float(table.derivative(np.array(start + duration), 1))
    assert speed == pytest.approx(max(0.0, duration - velocity + own), abs=1e-9)


def test_flights_of_fast_balls_on_a_fast_table_end_holds() -> None:
    table, start = Table(0.9, 1000.0), np.linspace(0, 1, 60)
    velocity = table.derivative(start, 1) + np.linspace(0, 400, 60)
    durations, speeds = landing(table, start, velocity)
    for one, up, duration in zip(start, velocity, durations):
        assert abs(heights(table, one, up, np.array(duration))) < 1e-8
    assert durations.max() > 1000 and speeds.max() > 500


@each_row(("alpha", "gamma"), [(0.05, 3.1), (0.3, 1.8785), (0.0, 3.3)])
def test_the_bounce_of_one_period_is_an_orbit(alpha: float, gamma: float) -> None:
    table, phase = Table(alpha, gamma), bounce_phase(alpha, gamma)
    own = float(table.derivative(np.array(phase), 1))
    assert own == pytest.approx((1 - alpha) / (1 + alpha) / 2)
    for one, count in zip(events(table, phase, own + alpha / (1 + alpha)), range(1, 5)):
        assert one.kind == "impact" and one.speed == pytest.approx(1 / (1 + alpha))
        assert one.time == pytest.approx(phase + count)


def test_a_ball_rests_and_is_launched_where_the_table_falls_away() -> None:
    table = Table(0.05, 3.1)
    own = float(table.derivative(np.array(0.6), 1))
    rest, launch, impact = islice(events(table, 0.6, own), 3)
    assert (rest.kind, launch.kind, impact.kind) == ("rest", "launch", "impact")
    assert rest.time == 0.6
    assert 3.1 * np.sin(2 * pi * launch.time) == pytest.approx(1)
    assert 1 < launch.time < 1.1 and impact.time > 2
    # below one gravity a ball that rests does so for ever
    slow = Table(0.05, 0.9)
    assert [one.kind for one in events(slow, 0.6, float(slow.derivative(np.array(0.6), 1)))] == [
        "rest"
    ]
    assert rested(slow, np.array([0.6]), np.array([-9.0]))[1][0] == inf


def test_all_states_come_to_the_bounce_where_it_is_certified_and_not_where_it_is_refuted() -> None:
    phase, speed = (one.ravel() for one in np.meshgrid(np.arange(24) / 24, np.arange(9) / 7))
    counts = flights_to_bounce(Table(0.05, 3.1), phase, speed, 60)
    assert 0 < counts.min() and counts.max() <= 12
    counts = flights_to_bounce(Table(0.3, 1.8785), phase, speed, 60)
    assert 0.05 < ((counts >= 0) & (counts <= 60)).mean() < 0.5


@each_row(
    ("alpha", "gamma", "wave"),
    [(1.0, 3.0, (1.0,)), (0.1, 0.0, (1.0,)), (0.1, 3.0, ()), (0.1, 3.0, (inf,))],
)
def test_rejects_what_is_no_table(alpha: float, gamma: float, wave: tuple[float, ...]) -> None:
    with pytest.raises(SceneError):
        Table(alpha, gamma, wave)


def test_the_command_tells_events_and_draws_the_same_twice(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sine, "certified_for", cache(sine.certified_for))
    given_ = ["simulate", "table", "--alpha", "1/20", "--gamma", "3.1"]
    assert run([*given_, "--state", "phase=0.3,speed=0.4", "--periods", "3"]) == 0
    shown = capsys.readouterr().out
    assert "rest" in shown and "launch  1.052275" in shown
    pytest.importorskip("matplotlib")
    for kind in ("orbit", "basin"):
        pictures = [tmp_path / f"{kind}-{count}.svg" for count in (1, 2)]
        for picture in pictures:
            assert run([*given_, "--picture", kind, "-o", str(picture)]) == 0
        one, other = (picture.read_bytes() for picture in pictures)
        assert one == other and one.startswith(b"<?xml") and len(one) < 100_000


def test_ranks_that_the_checker_does_not_take_are_not_shown(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    shown = sine.certified_for(0.05, 3.1)
    assert shown is not None and shown[0] == Fraction(21, 16) and shown[2] == 1
    assert shown[1].shape == (21, 256) and shown[1].min() == 0
    monkeypatch.setattr(sine, "check_line", lambda line: (None, "refused"))
    assert sine.certified_for(0.05, 3.1) is None
    assert sine.certified_for(0.05, 2.5) is None  # below the birth


@pytest.mark.exhaust
def test_ranks_of_a_basin_are_shown_in_cells_that_are_cut_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sine, "BASIN", 5_500)
    shown = sine.certified_for(0.3, 1.8785)
    assert shown is not None
    top, ranks, share = shown
    assert top == Fraction(17, 16) and ranks.shape == (34, 512) and ranks.min() == -1
    assert share == Fraction(int((ranks >= 0).sum()), ranks.size)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--alpha", "2", "--gamma", "3"], "restitution 2"),
        (["--alpha", "x", "--gamma", "3"], "'x' is no number"),
        (["--alpha", "0", "--gamma", "3", "--state", "phase=1"], "--state phase=1: write it as"),
        (["--alpha", "0", "--gamma", "3", "--state", "phase=0,speed=-1"], "is not below 0"),
        (["--alpha", "0", "--gamma", "3", "-o", "a.svg"], "-o: is for --picture"),
        (["--alpha", "0", "--gamma", "3", "--picture", "orbit"], "--picture: needs -o F.svg"),
        (
            ["--alpha", "0", "--gamma", "3", "--picture", "film", "-o", "a.svg"],
            "draw orbit, basin or attractors",
        ),
    ],
)
def test_rejects_options_that_do_not_go_together(
    options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", "table", *options]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1
