"""How far a command is, on a terminal only."""

from __future__ import annotations

import io
import sys
import time

import pytest

from juggleproof.command.outputs import busy


class Terminal(io.StringIO):
    """A terminal that keeps what is written."""

    def isatty(self) -> bool:
        return True


def test_seconds_are_shown_on_a_terminal_and_taken_away_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    with busy("judging"):
        until = time.monotonic() + 60
        while "judging: 1 s" not in terminal.getvalue() and time.monotonic() < until:
            time.sleep(0.05)
    assert "judging: 1 s" in terminal.getvalue() and terminal.getvalue().endswith("\r\x1b[K")


def test_nothing_is_shown_without_a_terminal_holds(capsys: pytest.CaptureFixture[str]) -> None:
    with busy("judging"):
        time.sleep(1.2)
    assert capsys.readouterr() == ("", "")
