"""The excess of a problem as a goal for Coq's tactic interval (Debian package libcoq-interval)."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from fractions import Fraction
from functools import cache
from pathlib import Path

from benchmarks.bench.problems import Problem, horner
from benchmarks.running import Clock

HEAD = "From Coq Require Import Reals.\nFrom Interval Require Import Tactic.\nOpen Scope R_scope.\n"
BITS, DEPTH = 100, 60


@cache
def has_coq_interval() -> bool:
    """Whether the compiler and the library are there."""
    coqc = shutil.which("coqc")
    if coqc is None:
        return False
    where = subprocess.run(
        [coqc, "-where"], capture_output=True, text=True, check=False
    ).stdout.strip()
    folders = [
        Path(where) / "user-contrib",
        *map(Path, filter(None, os.environ.get("COQPATH", "").split(":"))),
    ]
    return any((folder / "Interval" / "Tactic.vo").exists() for folder in folders)


def goal(problem: Problem, bound: Fraction) -> str:
    """That the excess is >= 0 on the box, by bisection of all variables, with slopes along the
    last.

    >>> from fractions import Fraction as F
    >>> one = Problem("half", ("p",), ((F(0), F(1)),), {(1,): F(1)}, {(0,): F(2)}, 1, "", "")
    >>> print(goal(one, F(1)).splitlines()[-2])
    Goal forall v0 : R, 0/1 <= v0 <= 1/1 -> 0 <= 2/1 + v0*(-1/1).
    """
    short = [f"v{i}" for i in range(len(problem.names))]
    sides = "".join(
        f"{_number(low)} <= {v} <= {_number(high)} -> "
        for v, (low, high) in zip(short, problem.box)
    )
    excess = horner(problem.excess(bound), short, _number)
    halved = ", ".join(f"i_bisect {v}" for v in short)
    return (
        f"{HEAD}Goal forall {' '.join(short)} : R, {sides}0 <= {excess}.\nProof. intros; interval"
        f" with ({halved}, i_autodiff {short[-1]}, i_prec {BITS}, i_depth {DEPTH}). Qed.\n"
    )


def _number(value: Fraction) -> str:
    return f"{value.numerator}/{value.denominator}"


def proves(text: str, seconds: float) -> bool:
    """Whether coqc accepts the goal."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "goal.v"
        path.write_text(text, encoding="utf-8")
        return (
            Clock(seconds).output_of(["coqc", "-q", str(path)], "") is not None
            and path.with_suffix(".vo").exists()
        )
