"""A small problem is answered without loading what is dear to load."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

DEAR = {"sympy", "numpy", "z3", "highspy", "rich", "mpmath", "multiprocessing"}
RUN = f"""
import sys
from juggleproof.command.main import run
code = run(["certify", sys.argv[1]])
print(code, *sorted({DEAR!r} & sys.modules.keys()))
"""


@pytest.mark.parametrize("body", ["(> (* x x) 2)", "(< (* x x) 0)", "(and (> x 2) (< x 1))"])
def test_a_small_problem_loads_nothing_dear_holds(body: str, tmp_path: Path) -> None:
    path = tmp_path / "small.smt2"
    path.write_text(f"(declare-const x Real)(assert {body})(check-sat)", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", RUN, str(path)], capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1] == "0"
