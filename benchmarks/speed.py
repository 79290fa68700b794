"""Whole commands, each in a process of its own: CPU seconds and peak memory against the aims.

python -m juggleproof.benchmarks.speed [--runs 3]
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
COMMAND = [sys.executable, "-m", "juggleproof.proofs.command.main"]
THEOREM = ["--only", "theorem-roots", "--only", "theorem"]


def measure(arguments: list[str]) -> tuple[float, float]:
    """CPU seconds and peak megabytes (largest single process) of one command."""
    process = subprocess.Popen(
        arguments, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _, _, usage = os.wait4(process.pid, 0)
    process.returncode = 0
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main() -> None:
    """Prints seconds and memory of each command beside its aim."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3)
    runs = parser.parse_args().runs
    theorem = tempfile.mkdtemp()
    measure([*COMMAND, "certify", "--routes", "exact", *THEOREM, "--store", theorem])
    rows: list[tuple[str, float, Callable[[str], list[str]]]] = [
        (
            "certify, exact route, empty store",
            6.0,
            lambda d: [*COMMAND, "certify", "--fresh", "--routes", "exact", "--store", d],
        ),
        (
            "certify, all routes, empty store",
            12.0,
            lambda d: [*COMMAND, "certify", "--fresh", "--store", d],
        ),
        ("certify, from the store", 1.5, lambda d: [*COMMAND, "certify"]),
        (
            "checker over everything",
            0.2,
            lambda d: [sys.executable, "-I", "-S", "certificates/checker"],
        ),
        (
            "the theorem, exact route, empty store",
            2.0,
            lambda d: [*COMMAND, "certify", "--fresh", "--routes", "exact", *THEOREM, "--store", d],
        ),
        (
            "checker over the theorem",
            0.1,
            lambda d: [sys.executable, "-I", "-S", "certificates/checker", theorem],
        ),
        *(
            [("the theorem in Coq, all of it", 20.0, lambda d: ["make", "-s", "coq"])]
            if shutil.which("coqc")
            else []
        ),
        ("juggleproof --help", 0.15, lambda d: [*COMMAND, "--help"]),
    ]
    print(f"{'command':36} {'aim':>6} {'median':>8} {'least':>8} {'most':>8} {'MB':>6}")
    for title, aim, command in rows:
        measured = []
        for _ in range(runs):
            with tempfile.TemporaryDirectory() as folder:
                measured.append(measure(command(folder)))
        seconds = [one for one, _ in measured]
        print(
            f"{title:36} {aim:6.2f} {statistics.median(seconds):8.2f} {min(seconds):8.2f}"
            f" {max(seconds):8.2f} {max(m for _, m in measured):6.0f}"
        )


if __name__ == "__main__":
    main()
