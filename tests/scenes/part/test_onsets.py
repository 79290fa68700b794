"""Averages over parts do not depend on tolerance and rest speed; the split of a still table is
exact; what has not settled is censored.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

from juggleproof.scenes.part import body, run, scene, standing, table_one
from juggleproof.scenes.part.onsets import PAPER, jittered, jittered_phases, row_of
from juggleproof.scenes.part.setting import Scene, changed
from tests.rows import each_row

HORIZON, ENSEMBLES = 6.0, 24
SPLIT = math.degrees(math.atan(0.5))  # 26.56505...


def mean_exit(block: Scene, seed: int) -> tuple[float, float]:
    """The mean over 24 x 27 parts that start upright of the last time at which they are, at most 6
    s, and its standard error.
    """
    angles = jittered(ENSEMBLES, seed)[:, :27].ravel()
    last = run(block, standing(block, angles), HORIZON).notes[:, body.LAST_UPRIGHT]
    # starts are spread evenly over 0..26 degrees: the error of the mean is at most that of
    # independent starts
    return float(last.mean()), float(last.std(ddof=1) / math.sqrt(len(last)))


ACCURACIES = ((1e-12, 1e-3), (1e-9, 1e-3), (1e-6, 1e-3), (1e-12, 1e-4), (1e-12, 1e-2), (1e-6, 1e-2))


@pytest.mark.exhaust
def test_mean_exit_time_does_not_depend_on_tolerance_and_rest_speed_holds() -> None:
    """Rule: each of six accuracies, with jitter of its own, is within 3.5 standard errors of the
    mean of the others.
    """
    found = [
        mean_exit(
            scene(e=0.7, mu=0.08, f_x=30.0, A_x=2e-3, tolerance=tolerance, rest_speed=rest), seed
        )
        for seed, (tolerance, rest) in enumerate(ACCURACIES)
    ]
    for k, (mean, error) in enumerate(found):
        others = [one for j, one in enumerate(found) if j != k]
        spread = math.sqrt(error**2 + sum(e**2 for _, e in others) / len(others) ** 2)
        assert abs(mean - sum(m for m, _ in others) / len(others)) < 3.5 * spread, found
    assert all(error < 0.06 * mean for mean, error in found), found


@pytest.mark.exhaust
def test_mean_exit_time_fails_without_the_same_friction() -> None:
    """The rule tells another scene apart: it is not one that cannot fail."""
    here, there = (mean_exit(scene(e=e, mu=0.08, f_x=30.0, A_x=2e-3), 1) for e in (0.7, 0.4))
    assert abs(here[0] - there[0]) > 3.5 * math.hypot(here[1], there[1])


@each_row("e", [0.0, 0.5, 0.7, 0.9])
def test_without_vibration_blocks_part_at_the_diagonal_holds(e: float) -> None:
    for mu in (0.0, 0.08, 0.5, 1.2):
        block = scene(e=e, mu=mu, A_y=0.0)
        angles = np.array(
            [0.0, 1.0, 26.0, 26.565, SPLIT - 1e-7, SPLIT + 1e-7, 26.5651, 27.0, 60.0, 90.0]
        )
        after = run(block, standing(block, np.radians([*angles, *-angles])), 6.0)
        ends = np.degrees(after.states[:, body.THETA])
        assert (after.states[:, body.MODE] == body.FACE).all()
        assert (
            ends == [*np.where(angles < SPLIT, 0.0, 90.0), *np.where(angles < SPLIT, 0.0, -90.0)]
        ).all()


def test_other_faces_part_at_their_own_diagonal_holds() -> None:
    block = scene(e=0.7, mu=0.3, A_y=0.0, a=0.01, b=0.04)
    angles = np.radians([14.0, 14.1, 26.0])  # atan(1/4) = 14.036...
    assert (
        run(block, standing(block, angles), 4.0).states[:, body.THETA]
        == [0, math.pi / 2, math.pi / 2]
    ).all()


# a table that starts at its lowest, gently: the block at 0 degrees lies down at once
GENTLE = scene(
    e=0.875, mu=0.92, A_y=1e-4, phase_y=-math.pi / 2, A_x=5e-5, f_x=60.0, phase_x=-math.pi / 2
)


def ends_of_the_upright(phases: Sequence[float]) -> set[tuple[float, ...]]:
    """Where the block that starts at 0 degrees is after 2 s, in ensembles with these phases."""
    ends = set()
    for angles, moved in zip(jittered(len(phases), 1), phases):
        block = changed(GENTLE, phase_x=GENTLE.phase_x + moved)
        ends.add(tuple(run(block, standing(block, angles[:1]), 2.0).states[0, body.THETA :]))
    return ends


def test_ensembles_are_independent_holds() -> None:
    assert len(ends_of_the_upright([float(moved) for moved in jittered_phases(16, 1)])) == 16


def test_ensembles_are_independent_fails_without_a_jitter_of_the_phase() -> None:
    assert len(ends_of_the_upright([0.0] * 16)) < 14


def test_ensemble_that_has_not_settled_is_censored_holds() -> None:
    table = table_one(scene(e=0.7, mu=0.08), ensembles=3, horizon=0.1)
    for row in table.rows:
        assert (
            row.censored() + sum(row.chaotic) == 3 == len(row.onsets)
            and np.isinf(row.onsets).all()
            and row.quantile(0.5) == math.inf
        )
    assert len(table.run.states) == 6 * 3 * 91


def test_one_part_that_stays_upright_censors_its_ensemble_holds() -> None:
    notes = [np.zeros((91, body.NOTES)) for _ in range(4)]
    for k, one in enumerate(notes):
        one[:, body.LAST_UPRIGHT] = np.linspace(0, 2 + k, 91)
    notes[1][7, body.LAST_UPRIGHT] = 12.0  # still upright at the end
    notes[2][3, body.FALLS], notes[2][80, body.RISES] = 1, 1  # both ways, late
    row = row_of(PAPER[0], notes, 12.0)
    assert (
        list(row.onsets) == [2.0, math.inf, math.inf, 5.0]
        and row.chaotic == (False, False, True, False)
        and row.censored() == 1
    )
    assert row.quantile(0.5) == 5.0 and row.quantile(0.51) == math.inf and not row.is_chaotic()
