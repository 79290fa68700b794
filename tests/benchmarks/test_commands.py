"""The table of commands names every command, and holds what a run prints."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

import pytest

from juggleproof.benchmarks import commands
from juggleproof.benchmarks.commands import COMMANDS, TABLE
from juggleproof.command.main import build_parser


def test_every_command_is_timed_holds() -> None:
    (subparsers,) = (
        action
        for action in build_parser()._actions
        if isinstance(action, argparse._SubParsersAction)
    )
    timed = {one.command.split()[1] for one in COMMANDS if one.command.startswith("juggleproof ")}
    assert set(subparsers.choices) <= timed


def test_the_page_has_a_row_for_every_command_holds() -> None:
    lines = TABLE.text().splitlines()[2:-1]
    named = [one.command + ", again" * one.again for one in COMMANDS]
    assert [line.split("  ")[-1].strip() for line in lines] == named
    assert all(0 < float(line.split()[0]) < 1000 for line in lines)


def test_rejects_a_command_that_takes_over_twice_its_aim(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    spent = {"import sympy": 0.5, "list": 0.5, "list --json": 0.51}
    monkeypatch.setattr(
        commands, "measure", lambda words, kept="off": (spent[last_words(words)], 20.0)
    )
    for only, code in (("list --json", 1), ("juggleproof list", 1), ("explain", 0)):
        spent.update(dict.fromkeys(("explain eq-37", "explain theorem"), 0.9))
        spent["explain theorem --alpha 3/10 --state x=1000,w=-41"] = 9.0
        monkeypatch.setattr(sys, "argv", ["commands", "--check", "--only", only])
        assert commands.main() == code
        assert ("over twice its aim: juggleproof list --json: 1" in capsys.readouterr().out) == code


def last_words(words: Sequence[str]) -> str:
    """What is run, without the interpreter and the module."""
    return " ".join(words).rpartition("juggleproof.command.main ")[2].rpartition("-c ")[2]
