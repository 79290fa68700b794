"""The table of orbits: its slopes and errors are what they are called, each arithmetic has its row,
and a million states stay below 200 MB.
"""

from __future__ import annotations

from fractions import Fraction

import pytest

from juggleproof.benchmarks import orbits
from juggleproof.scenes.juggler import orbit, point, scene
from tests.rows import each_row


def test_slopes_are_those_of_powers_holds() -> None:
    for power in (0, 1, 2):
        assert (
            abs(
                orbits.slope((10, 100, 1000), [3.0 * size**power for size in (10, 100, 1000)])
                - power
            )
            < 1e-12
        )


@each_row("kind", ["exact", "enclosed", "mp", "fast"])
def test_errors_are_distances_to_the_exact_orbit_holds(kind: str) -> None:
    setting = scene("9/10", point(1, -4))
    exact = orbit(setting, "exact", 50).row(0)
    row = orbit(setting, kind, 50).row(0)
    off, _, bound = orbits.error(row, exact).partition(" <= ")
    assert (float(off) == 0.0) is (kind == "exact") and float(off) < 1e-12
    assert bound == "" if kind == "mp" else float(off) <= float(bound)
    assert orbits.error(row, exact._replace(x=exact.x + Fraction(1, 2))).startswith("5.0e-01")


def test_each_arithmetic_has_its_row_holds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(orbits, "STEPS", (10, 20, 40))
    monkeypatch.setattr(orbits, "STATES", (10, 20, 40))
    monkeypatch.setattr(orbits, "memory", lambda: None)
    orbits.main()
    found = capsys.readouterr().out
    for alpha in orbits.ALPHAS:
        for kind in ("exact", "enclosed", "mp", "fast"):
            assert f"{alpha:>6} {kind:>10} " in found
    assert found.count("height 1e+12") == 1 and found.count("40 states") == 1


@pytest.mark.exhaust
def test_a_million_states_stay_below_200_megabytes_holds() -> None:
    """And what the parent holds, here 300 MB, is not counted as theirs."""
    held = bytearray(b"\1") * 300_000_000
    assert orbits.memory() < 200 and len(held) == 300_000_000
