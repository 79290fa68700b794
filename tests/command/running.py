"""The command, run in this process or in one of its own."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import NamedTuple

from juggleproof.command import main

ROOT = Path(__file__).resolve().parents[2]


class Done(NamedTuple):
    """What a command came to: its exit code and what it wrote."""

    returncode: int
    stdout: str
    stderr: str


def run(*arguments: str, cwd: Path = ROOT) -> Done:
    """The command in this process, which has imported all that it needs already."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err), chdir(cwd):
        try:
            code = main.run(arguments)
        except SystemExit as ended:  # argparse rejects arguments so
            code = int(ended.code or 0)
    return Done(code, out.getvalue(), err.getvalue())


def run_anew(*arguments: str) -> Done:
    """The command in a process of its own, which has no search behind it."""
    done = subprocess.run(
        [sys.executable, "-m", "juggleproof.command.main", *arguments],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1"},
        timeout=240,
        check=False,
    )
    return Done(done.returncode, done.stdout, done.stderr)
