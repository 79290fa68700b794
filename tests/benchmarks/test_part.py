"""The measurements of the part run, at tiny sizes, and say what they are of."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

pytest.importorskip("numba")

from juggleproof.benchmarks import part
from tests.scenes.part import reference


def test_benchmark_prints_every_figure_and_draws_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    file = tmp_path / "part.svg"
    assert (
        part.main(["--ensembles", "6", "--horizon", "0.2", "--runs", "1", "--plot", str(file)]) == 0
    )
    output = capsys.readouterr().out
    assert len(re.findall(r"table I once, [12] core", output)) == 2 and re.search(
        r"parts\^-?[\d.]+ and time\^-?[\d.]+", output
    )
    assert (
        output.count("median error") == len(part.TOLERANCES) and output.count("median onset") == 2
    )
    assert file.read_text(encoding="utf-8").startswith("<?xml") and "nan" not in output


def test_error_of_the_benchmark_falls_with_the_tolerance_holds() -> None:
    (_, fine, _), (_, coarse, _) = part.accuracy((1e-12, 1e-6), 3, 1)
    assert fine < 1e-9 < coarse


def test_the_ends_of_the_benchmark_are_those_of_the_reference_holds() -> None:
    block = reference.setting(
        0.01, 0.02, e=0.7, mu=0.08, g=9.81, A_x=1e-3, f_x=30.0, A_y=2e-4, f_y=60.0
    )
    for Y, theta, omega, *end in part.KNOWN:
        dropped = reference.dropped(block, theta, 0.001, omega=omega)
        start = reference.State(*map(float, dropped))
        assert start == (0, 0, Y, theta, 0, 0, omega)
        last = reference.reference_orbit(block, start, part.UNTIL, 35)[-1].after
        after = part.UNTIL - last.t
        assert [float(last.X + last.VX * after), float(last.theta + last.omega * after)] == end


def test_slope_of_a_power_is_its_exponent_holds() -> None:
    assert part.slope([1, 2, 4, 8], [3 * n**1.5 for n in (1, 2, 4, 8)]) == pytest.approx(1.5)
