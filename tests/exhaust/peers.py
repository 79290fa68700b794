"""Tests that need other solvers and engines, with these installed in a folder of their own.

python -m tests.exhaust.peers MODULE ..
"""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence

from tests.exhaust.sources import ROOT

FOLDER = ROOT / "build" / "peers"
LOCK = ROOT / "requirements-peers.lock"
INSTALLED = FOLDER / LOCK.name


def install() -> None:
    """Installs what the lock names, unless this lock was installed.  One process at a time does so:
    another waits, and finds it done.
    """
    wanted = LOCK.read_bytes()
    FOLDER.parent.mkdir(exist_ok=True)
    with FOLDER.with_suffix(".flock").open("w") as guard:
        fcntl.flock(guard, fcntl.LOCK_EX)
        if INSTALLED.exists() and INSTALLED.read_bytes() == wanted:
            return
        shutil.rmtree(FOLDER, ignore_errors=True)
        pip = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check")
        into = ("--target", str(FOLDER), "-r", str(LOCK))
        subprocess.run([sys.executable, *pip, *into], cwd=ROOT, check=True)
        INSTALLED.write_bytes(wanted)


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
