"""What the impact law guarantees holds at every one of a million impacts; and each count can fail:
a wrong law is noticed.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from juggleproof.scenes.part import body, fresh_notes, moving, scene, table_one
from juggleproof.scenes.part import strike as striking
from juggleproof.scenes.part.body import plain
from juggleproof.scenes.part.strike import impulse

SCENES: tuple[dict[str, Any], ...] = (
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


def test_million_impacts_break_no_guarantee_holds() -> None:
    impacts = 0.0
    for given in SCENES:
        block = scene(**given)
        done = table_one(block, ensembles=1, horizon=3.0).run
        impacts += done.notes[:, body.IMPACTS].sum()
        assert (
            done.violations() == dict.fromkeys(done.violations(), 0) and len(done.violations()) == 4
        )
        assert done.notes[:, body.LEAST_GAP].min() >= -block.tolerance
    assert impacts >= 1e6


def struck(law: Any, monkeypatch: pytest.MonkeyPatch) -> Any:
    """The notes of one impact by another law."""
    block = scene(e=0.5, mu=0.3, A_y=0.0)
    z, notes = moving(block, 0, 0.1, 0.3, 0.5, -0.5, 3.0)[0], fresh_notes(1)[0]
    p, c, s = block.parameters(), np.cos(0.3), np.sin(0.3)
    monkeypatch.setattr(striking, "impulse", law)
    assert (
        plain(striking.strike_at)(
            p, z, body.corner_x(p, 0, c, s), body.corner_y(p, 0, c, s), 0.0, 0.0, notes
        )
        == body.DONE
    )
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
    wrong: Any, counted: set[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    notes = struck(lambda *given: wrong(*plain(impulse)(*given)), monkeypatch)
    assert {
        k for k in (body.PULLS, body.CONES, body.GAINS, body.CLOSINGS) if notes[k]
    } == counted and notes[body.IMPACTS] == 1


def test_violations_of_a_run_are_those_of_its_notes_holds() -> None:
    done = table_one(scene(e=0.7, mu=0.08), ensembles=1, horizon=0.01).run
    for column in (body.PULLS, body.CONES, body.GAINS, body.CLOSINGS):
        done.notes[5, column] += 2
        assert sum(done.violations().values()) == 2
        done.notes[5, column] -= 2
