"""Ours is the impact law to rounding; general engines agree with it where it has no friction, so
that their error is their own; the table tells who is absent.
"""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("numba")

from juggleproof.benchmarks import engines
from juggleproof.scenes.part.setting import changed

SOME = [*engines.impacts(20)]
SMOOTH = [one._replace(block=changed(one.block, mu=0.0)) for one in SOME]


def test_our_impacts_are_those_of_the_law_holds() -> None:
    median, most, gains = engines.errors(SOME, engines.ours(SOME)[0])
    assert median < most < 1e-14 and gains == 0


def test_our_impacts_are_those_of_the_law_fails_without_the_same_friction() -> None:
    assert engines.errors(SOME, engines.ours(SMOOTH)[0])[0] > 1e-3


def test_energy_that_is_gained_is_counted_holds() -> None:
    found = [2 * one.start[3:] for one in SOME]
    assert engines.errors(SOME, found)[2] == len(SOME)


@pytest.mark.parametrize(("name", "least"), [("pymunk", 1e-3), ("MuJoCo", 5e-2)])
def test_an_engine_agrees_with_the_law_without_friction_holds(name: str, least: float) -> None:
    if name not in engines.present():
        pytest.skip("pymunk and MuJoCo are not installed; the extra peers has them")
    found = [engines.struck(engines.ENGINES[name], one, 1e-5)[0] for one in SMOOTH]
    assert engines.errors(SMOOTH, found)[0] < least


@pytest.mark.parametrize("name", engines.ENGINES)
def test_blocks_on_a_still_table_lie_where_they_fall_holds(name: str) -> None:
    if name not in engines.present():
        pytest.skip("pymunk and MuJoCo are not installed; the extra peers has them")
    still = changed(engines.THIRD_ROW, A_x=0.0, A_y=0.0, e=0.5, mu=0.5)
    angles = np.radians([2.0, 15.0, 45.0, 80.0])
    counts, _ = engines.ensemble(engines.ENGINES[name], still, angles, 1e-3, (0.0, 1.0))
    assert counts == [2, 2]


def test_table_tells_every_engine_that_is_there_holds(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in (("IMPACTS", 2), ("EARLY", 0.002), ("LATE", 0.004)):
        monkeypatch.setattr(engines, name, value)
    monkeypatch.setattr(engines, "STEPS", dict.fromkeys(engines.ENGINES, (1e-4,)))
    there = engines.present()
    if len(there) == len(engines.ENGINES):
        engines.main([])
    else:
        with pytest.raises(SystemExit, match="absent: .*; the extra peers has them"):
            engines.main([])
    head, rule, *lines = capsys.readouterr().out.splitlines()
    assert [line.split("|")[1].strip() for line in lines] == ["ours", *there]
    assert head.count("|") == rule.count("|") and all(line.count("|") == 10 for line in lines)
