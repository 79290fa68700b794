"""The measurements of the part run, at tiny sizes, and say what they are of."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

pytest.importorskip("numba")

from juggleproof.benchmarks import part


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
    assert output.count("median onset") == 2
    assert file.read_text(encoding="utf-8").startswith("<?xml") and "nan" not in output


def test_slope_of_a_power_is_its_exponent_holds() -> None:
    assert part.slope([1, 2, 4, 8], [3 * n**1.5 for n in (1, 2, 4, 8)]) == pytest.approx(1.5)
