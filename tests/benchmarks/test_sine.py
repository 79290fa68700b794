"""The benchmark of the sine tells each of its tables, here of few and small boxes."""

from __future__ import annotations

import sys

import pytest

from juggleproof.benchmarks import sine

AREA = (
    "the period-one bounce is stable and every motion tends to it for all"
    " alpha in [49/1000, 51/1000] and Gamma in [309/100, 311/100]"
)


@pytest.mark.exhaust
def test_every_table_is_told_holds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    less = {"WIDTHS": (1,), "DISTANCES": (100,), "RUNS": 1, "AREA": AREA}
    for name, value in {**less, "COMMANDS": sine.COMMANDS[:1]}.items():
        monkeypatch.setattr(sine, name, value)
    monkeypatch.setattr(sys, "argv", ["sine", "--jobs", "1"])
    sine.main()
    boxes, processes, commands = capsys.readouterr().out.split("\n\n")
    named = ("half width 0.001 ", "0.1 above the second orbit ", "0.1 below period doubling ")
    for line, name in zip(boxes.splitlines()[1:], named, strict=True):
        assert line.startswith(name) and "none found" not in line
    assert " certified " in processes and sine.COMMANDS[0][0] in commands
