"""The table of times names every command, and holds what a run prints."""

from __future__ import annotations

import argparse

from juggleproof.benchmarks.speed import COMMANDS, TABLE
from juggleproof.proofs.command.main import build_parser


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
    assert [line.split("  ")[-1].strip() for line in lines] == [one.command for one in COMMANDS]
    assert all(0 < float(line.split()[0]) < 1000 for line in lines)
