"""Tests that need other solvers and engines, with these installed in a folder of their own.

python -m tests.exhaust.peers MODULE ..
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tests.exhaust.sources import ROOT

FOLDER = ROOT / "build" / "peers"
LOCK = ROOT / "requirements-peers.lock"
INSTALLED = FOLDER / LOCK.name


def install() -> None:
    """Installs what the lock names, unless this lock was installed; aside, as two may install."""
    wanted = LOCK.read_bytes()
    if INSTALLED.exists() and INSTALLED.read_bytes() == wanted:
        return
    FOLDER.parent.mkdir(exist_ok=True)
    aside = tempfile.mkdtemp(dir=FOLDER.parent)
    pip = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check")
    subprocess.run([sys.executable, *pip, "--target", aside, "-r", str(LOCK)], cwd=ROOT, check=True)
    Path(aside, LOCK.name).write_bytes(wanted)
    shutil.rmtree(FOLDER, ignore_errors=True)
    try:
        os.rename(aside, FOLDER)
    except OSError:  # another has just done the same
        shutil.rmtree(aside)


def main(modules: Sequence[str]) -> int:
    """Installs them, runs the tests; returns what pytest does."""
    install()
    files = [f"{name.replace('.', '/')}.py" for name in modules]
    return subprocess.run(
        [sys.executable, "-m", "pytest", *files],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(FOLDER)},
        check=False,
    ).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
