"""What balls come to over restitution and drive: against balls that are followed one by one, and
against what is certified.
"""

from __future__ import annotations

from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from juggleproof.command.main import run
from juggleproof.command.sine import wide_boxes
from juggleproof.scenes.table import attractors as many
from juggleproof.scenes.table import cover
from juggleproof.scenes.table.curves import birth, doubling, gamma_of
from juggleproof.scenes.table.motion import Table, at_bounce, bounce_phase, events, landing

PAIRS = [
    (0.0, 3.3),
    (0.0, 2.5),
    (0.05, 3.1),
    (0.05, 2.78),
    (0.1, 9.7),
    (0.3, 1.8785),
    (0.5, 4.0),
    (0.05, 0.9),
]


def fate(alpha: float, gamma: float, phase: float, speed: float) -> int:
    """What one ball comes to first, by the events of its orbit."""
    table, was = Table(alpha, gamma), False
    stable = birth(alpha) < gamma < doubling(alpha)
    bounce = bounce_phase(alpha, gamma) if stable else np.nan
    own = float(table.derivative(np.array(phase), 1))
    for event in islice(events(table, phase, own + alpha * speed), many.MOST):
        if event.kind == "rest":
            return many.RESTS
        here = bool(at_bounce(alpha, bounce, np.array(event.time), np.array(event.speed)))
        if here and was:
            return many.BOUNCES
        was = here
    return many.GOES_ON


def test_balls_on_many_tables_fly_as_those_on_each_holds() -> None:
    rng = np.random.default_rng(0)
    gamma, start = rng.uniform(0.5, 20, 300), rng.uniform(0, 1, 300)
    up = gamma * many.SINE.derivative(start, 1) + rng.uniform(0, 6, 300) ** 3 / 20
    found = np.array(landing(many.SINE, start, up, gamma))
    each = [
        landing(Table(0.0, one), *pair)
        for one, *pair in zip(gamma, *np.array([start, up])[..., None])
    ]
    assert found == pytest.approx(np.array(each)[..., 0].T, abs=1e-6)


def test_balls_of_many_pairs_come_to_what_each_comes_to_alone_holds() -> None:
    rng = np.random.default_rng(1)
    balls = [
        (*pair, phase, 2 * speed) for pair in PAIRS for phase, speed in rng.uniform(0, 1, (6, 2))
    ]
    # where the table is in the way of the bounce: one that begins so, one that lands so
    bounce = bounce_phase(0.002, 3.15)
    balls += [(0.002, 3.15, bounce, 1 / 1.002), (0.002, 3.15, bounce + 0.04, 0.5)]
    bounces = [many.stable_phase(alpha, gamma) for alpha, gamma, _, _ in balls]
    alpha, gamma, phase, speed = np.array(balls).T
    found, flights = many.find_fates(np.array([alpha, gamma, bounces, phase, speed]))
    each = [fate(*ball) for ball in balls]
    assert found.tolist() == each and set(each) == {many.BOUNCES, many.RESTS, many.GOES_ON}
    assert 0 < flights < many.MOST * len(balls)


def test_no_motion_stays_above_the_strip_of_starts_holds() -> None:
    alpha, gamma = np.array([0.0, 0.3, 0.8]), np.array([3.3, 2.0, 9.0])
    top, rho = many.top_speed(alpha, gamma), gamma / (2 * np.pi)
    assert rho + np.sqrt((rho + alpha * top) ** 2 + 2 * rho / np.pi) == pytest.approx(top)


def test_from_all_starts_balls_come_to_the_bounce_wherever_that_is_certified_holds() -> None:
    pairs = [
        (at, gamma_of(at, drive))
        for (a, b), (low, high) in wide_boxes()
        for at, drive in ((a, low), (a, high), (b, low), (b, high), ((a + b) / 2, (low + high) / 2))
    ]
    assert len(pairs) > 900 and set(many.attractors(pairs).kinds.tolist()) == {many.ALONE}


def test_kinds_are_told_apart_and_a_pair_does_not_depend_on_the_others_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # a table that falls no faster than the ball, and one between: 2 impacts in each period
    pairs = [(0.05, 3.1), (0.3, 1.8785), (0.05, 2.0), (0.05, 2.78), (0.05, 0.9)]
    kinds = [many.ALONE, many.BESIDE, many.STICKS, many.OTHER, many.STICKS]
    found = many.attractors(pairs)
    assert found.kinds.tolist() == kinds
    monkeypatch.setattr(many, "AT_ONCE", 2)
    again = many.attractors(pairs)
    assert again.kinds.tolist() == kinds and again.flights == found.flights


def test_the_command_draws_the_same_map_twice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(cover, "COLUMNS", 9)
    monkeypatch.setattr(cover, "ROWS", 8)
    drawn = []
    for name in ("one.svg", "other.svg"):
        command = ["simulate", "table", "--wave", "sine", "--picture", "attractors"]
        assert run([*command, "-o", str(tmp_path / name)]) == 0
        drawn.append((tmp_path / name).read_bytes())
    assert drawn[0] == drawn[1] and len(drawn[0]) < 200_000
    for name in ("raster", "certified", "birth", "own-grazing", "grazing", "doubling", "key-8"):
        assert f'id="attractors-{name}"'.encode() in drawn[0], name


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--alpha", "0.1"], "attractors: give --alpha A0:A1 within 0 and 1"),
        (["--alpha", "0.1:1"], "attractors: give --alpha A0:A1 within 0 and 1"),
        (["--gamma", "0:3"], "and --gamma G0:G1 above 0"),
        (["--gamma", "3:2"], "--gamma 3:2: begins above its end; write 2:3"),
        (["--gamma", "1:1e400"], "--gamma is too large to be simulated"),
        (["--wave", "1,0.2"], "--picture attractors: is for --wave sine"),
    ],
)
def test_rejects_a_rectangle_that_is_none(
    options: list[str], message: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    command = ["simulate", "table", "--picture", "attractors", "-o", str(tmp_path / "a.svg")]
    assert run([*command, *options]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1
