"""The methods by name: what each is worth, where its code is, and what it needs; their code is
loaded where it runs."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Literal

Worth = Literal["certificate", "rigorous", "unchecked", "no proof"]
NOTES = """\
certificate: what is printed was accepted by certificates/checker in this run, and that time is counted; the certificate can be read again.
rigorous: enclosed by arithmetic that rounds outwards (coq-interval: by Coq's kernel); to believe it again is to run it again.
unchecked: the answer of a solver.  no proof: floating point; its error is the distance to the truth, which it does not know itself.
The aim is judged against the certified peers and against Z3.  Certified peers: coq-interval, cvc5 where it writes its proof (nothing here reads it;
some of its steps say trust), and QEPCAD, whose answers are taken at their word.  Boxes in Arb and mpmath.iv are our own, measured beside."""


@dataclass(frozen=True)
class Method:
    """A way to answer; `place` is module:function, `package` what to install where it is absent,
    `peer` whether it is a certified peer of the aim."""

    name: str
    title: str
    worth: Worth
    place: str
    package: str = ""
    present: Callable[[], bool] = lambda: True
    peer: bool = False

    def solve(self, problem: Any, size: Fraction) -> Any:
        """The answer, at this width (or for so much work)."""
        module, function = self.place.split(":")
        return getattr(import_module(f"benchmarks.bench.{module}"), function)(problem, size)


def has(module: str) -> Callable[[], bool]:
    """Whether a Python module is there, without loading it."""
    return lambda: find_spec(module) is not None


def _interval() -> bool:
    from benchmarks.bench.coq_interval import has_coq_interval

    return has_coq_interval()


def _qepcad() -> bool:
    return shutil.which("qepcad") is not None


Z3, CVC5, QEPCAD = (
    "Z3 (pip install z3-solver)",
    "cvc5 (pip install cvc5)",
    "QEPCAD B (Debian package qepcad)",
)
COQ, SCIPY = "coq-interval (Debian packages coq and libcoq-interval)", "scipy (pip install scipy)"
METHODS = {
    one.name: one
    for one in (
        Method("bernstein", "exact Bernstein, ours", "certificate", "methods_ours:bernstein"),
        Method(
            "arb",
            "Arb boxes",
            "rigorous",
            "methods_boxes:arb_boxes",
            "python-flint (pip install python-flint)",
            has("flint"),
        ),
        Method(
            "mpmath",
            "mpmath.iv boxes",
            "rigorous",
            "methods_boxes:mpmath_boxes",
            "mpmath (pip install mpmath)",
            has("mpmath"),
        ),
        Method(
            "coq",
            "coq-interval, one question",
            "rigorous",
            "methods_solvers:coq_interval_once",
            COQ,
            _interval,
            peer=True,
        ),
        Method("z3", "Z3, bisection", "unchecked", "methods_solvers:z3_bisection", Z3, has("z3")),
        Method(
            "z3-once", "Z3, one question", "unchecked", "methods_solvers:z3_once", Z3, has("z3")
        ),
        Method(
            "cvc5",
            "cvc5, bisection",
            "unchecked",
            "methods_solvers:cvc5_bisection",
            CVC5,
            has("cvc5"),
        ),
        Method(
            "cvc5-once",
            "cvc5, one question",
            "unchecked",
            "methods_solvers:cvc5_once",
            CVC5,
            has("cvc5"),
        ),
        Method(
            "cvc5-proof",
            "cvc5, one question with its proof",
            "unchecked",
            "methods_solvers:cvc5_proof_once",
            CVC5,
            has("cvc5"),
            peer=True,
        ),
        Method(
            "qepcad",
            "QEPCAD B, bisection",
            "unchecked",
            "methods_solvers:qepcad_bisection",
            QEPCAD,
            _qepcad,
            peer=True,
        ),
        Method(
            "qepcad-once",
            "QEPCAD B, one question",
            "unchecked",
            "methods_solvers:qepcad_once",
            QEPCAD,
            _qepcad,
            peer=True,
        ),
        Method("sampling", "float sampling", "no proof", "methods_floating:sampling"),
        Method(
            "scipy",
            "scipy.optimize",
            "no proof",
            "methods_floating:scipy_optimize",
            SCIPY,
            has("scipy"),
        ),
    )
}
ORBITS = {
    one.name: one
    for one in (
        Method("exact", "exact rationals", "rigorous", "orbits:exact"),
        Method(
            "enclosed",
            "Arb balls",
            "rigorous",
            "orbits:enclosed",
            "python-flint (pip install python-flint)",
            has("flint"),
        ),
        Method("fast", "float64 with a proved bound", "rigorous", "orbits:fast"),
        Method("mp", "mpmath, 50 digits", "no proof", "orbits:mp"),
        Method("floats", "float64 alone", "no proof", "orbits:floats"),
    )
}
ENSEMBLE = {
    "ensemble": Method("ensemble", "float64 with proved bounds", "rigorous", "growth:ensemble")
}
QUICK = ("bernstein", "arb", "z3", "z3-once", "sampling")
GROWTH = (
    "bernstein",
    "arb",
    "mpmath",
    "z3-once",
)  # which are measured as the number of variables grows
