"""The tests that need other solvers and engines, with these installed in a folder of their own.

python -m tests.exhaust.peers
"""

from __future__ import annotations

import os
import subprocess
import sys

from tests.exhaust.sources import ROOT

FOLDER = ROOT / "build" / "peers"
TESTS = (
    "tests.benchmarks.bench.test_bench",
    "tests.benchmarks.test_engines",
    "tests.benchmarks.test_peers",
    "tests.benchmarks.test_problems",
    "tests.certificates.sine.test_cover",
    "tests.certificates.votes.test_smtlib",
    "tests.proofs.command.test_show",
    "tests.proofs.smtlib.test_answering",
    "tests.scenes.part.test_setting",
)


def main() -> int:
    """Installs them, runs the tests; returns what pytest does."""
    lock = ROOT / "requirements-peers.lock"
    install = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--upgrade")
    subprocess.run(
        [sys.executable, *install, "--target", str(FOLDER), "-r", str(lock)], cwd=ROOT, check=True
    )
    files = [f"{name.replace('.', '/')}.py" for name in TESTS]
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-n", "2", "--dist", "loadfile", *files],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(FOLDER)},
        check=False,
    ).returncode


if __name__ == "__main__":
    sys.exit(main())
