"""Without vibration, blocks part at atan(a/b), whatever restitution and friction are."""

from __future__ import annotations

from math import atan, degrees

import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import scene
from juggleproof.scenes.part.ensemble import WIDTH, ends_of, no_vibration

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")


@pytest.mark.parametrize(("e", "mu"), [(0.7, 0.08), (0.0, 0.0), (0.4, 1.0), (0.9, 0.3)])
def test_split_is_as_printed_and_at_the_exact_angle_holds(e: float, mu: float) -> None:
    found = no_vibration(scene(e=e, mu=mu, A_x=1e-3, f_x=30.0))
    assert found.as_printed() and 0 < found.lying - found.upright <= WIDTH
    assert found.upright < found.exact == degrees(atan(0.5)) < found.lying


def test_split_as_printed_fails_without_sides_of_one_to_two() -> None:
    """1 x 4 cm in the plane: 14 degrees is the last to stand up."""
    found = no_vibration(scene(e=0.7, mu=0.08, a=0.005, b=0.02))
    assert not found.as_printed() and found.ends.index(90) == 15
    assert found.upright - WIDTH < degrees(atan(0.25)) < found.lying + WIDTH


def test_square_is_parted_at_45_degrees_holds() -> None:
    found = no_vibration(scene(e=0.5, mu=0.3, a=0.01, b=0.01))
    assert found.upright - WIDTH <= 45 <= found.lying + WIDTH


def test_rejects_a_block_that_does_not_come_to_rest() -> None:
    with pytest.raises(SceneError, match="not at rest after 64 s; e = 1 is too near to 1"):
        ends_of(scene(e=1.0, mu=0.0, A_y=0.0, f_y=0.0), [10.0])


def test_rejects_ends_that_are_not_parted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from juggleproof.scenes.part import ensemble

    for ends in ([0] * 91, [90] * 91, [0, 90, *[0] * 89]):
        monkeypatch.setattr(ensemble, "ends_of", lambda *_, ends=ends: ends)
        with pytest.raises(SceneError, match="not parted once"):
            no_vibration(scene(e=0.7, mu=0.08))
