"""Measures methods, each answer in a process of its own, which is ended with its children when its
seconds are over.
"""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from benchmarks.bench.answers import Measured, read_answer
from benchmarks.bench.methods import Method
from benchmarks.running import end_with_children

ROOT = Path(__file__).resolve().parents[2]
START = 5.0  # seconds that a process may take to start and to end, on a busy machine
Told = Callable[[str], None]


def measure(method: Method, work: Any, size: Fraction, seconds: float) -> Measured:
    """Cold and warm seconds and the answer of one method; `seconds` limits the cold answer, and all
    answers together.
    """
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH", "")])),
    }
    process = subprocess.Popen(
        [sys.executable, "-m", "benchmarks.bench.child", method.name, str(size), str(seconds)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        cwd=ROOT,
        start_new_session=True,
    )
    try:
        said, errors = process.communicate(pickle.dumps(work), timeout=2 * seconds + START)
    except subprocess.TimeoutExpired:
        return Measured(method.name, size, reason="gave up")
    finally:
        end_with_children(process)
    if process.returncode:
        lines = errors.decode(errors="replace").strip().splitlines()
        return Measured(
            method.name, size, reason=f"failed: {lines[-1] if lines else process.returncode}"[:200]
        )
    found = json.loads(said)
    if "gave_up" in found:
        return Measured(method.name, size, reason=f"gave up: {found['gave_up']}")
    if found["cold"] > seconds:
        return Measured(method.name, size, reason="gave up")
    return Measured(method.name, size, found["cold"], found["warm"], read_answer(found["answer"]))


def measure_all(
    methods: Sequence[Method], work: Any, sizes: Sequence[Fraction], seconds: float, tell: Told
) -> Iterator[Measured]:
    """Every method at every size, easiest first; a method that gave up is not asked for more."""
    for method in methods:
        for size in sizes:
            tell(f"{method.title}, {size}")
            found = measure(method, work, size, seconds)
            yield found
            if found.answer is None:
                break
