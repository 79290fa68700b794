"""Our method, and the table of all methods: the worth of each, its code, and what it needs.

Loading this file loads no library that may be missing or takes long to load: a method loads its own
with its first answer.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from typing import Literal, NamedTuple

from juggleproof.algebra.box_trees import search_tree
from juggleproof.benchmarks.bench import numerics, solvers
from juggleproof.benchmarks.bench.answers import (
    SHARE,
    Answer,
    BoundQuestion,
    Drops,
    GaveUp,
    Point,
    Strayed,
    Work,
    best_point,
)
from juggleproof.certificates import checker

# -------------------------------------------------------------------------------------------------
# Our method: a box tree of exact Bernstein coefficients, and the checker's verdict on it; the times
# of both count.

FEW, MANY = 8, 20000  # boxes: for width 0, which needs few or fails, and for the width asked for


def bernstein(problem: BoundQuestion, width: Fraction) -> Answer:
    """Certifies that the value at a rational point is attained, and that nothing exceeds it; or, if
    that fails, that nothing exceeds it by more than the width.

    Raises GaveUp if the boxes run out, ArithmeticError if the checker rejects the certificate.
    """
    point, low = best_point(problem, width / SHARE)
    wider = low + width * (SHARE - 1) / SHARE
    for high, most in ([(low, FEW)] if can_be_a_corner(problem, point) else []) + [(wider, MANY)]:
        tree = search_tree(problem.excess(high), problem.box, most)
        if tree is not None:
            size = _checked(problem, point, low, high, tree)
            return Answer(low, high, f"{len(tree)} letters, {size} bytes")
    raise GaveUp(f"{MANY} boxes")


def can_be_a_corner(problem: BoundQuestion, point: Point) -> bool:
    """Whether few halvings lead to boxes with the point at a corner: only at a corner is a
    Bernstein coefficient the value of the polynomial.
    """
    places = [(x - low) / (high - low) for x, (low, high) in zip(point, problem.box)]
    return all(2**FEW % place.denominator == 0 for place in places)


def _checked(problem: BoundQuestion, point: Point, low: Fraction, high: Fraction, tree: str) -> int:
    """The bytes of the certificate that the checker accepts, read back from what would be stored;
    raises ArithmeticError where it rejects it.
    """
    (statement,) = checker.read_statements(problem.of_box(low, high)).values()
    excess, size = problem.excess(high), len(problem.names)
    bounds = [[2 * k, 2 * k + 1] for k in range(size) if any(e[k] for e in excess)]
    # a constant denominator is no fact
    node = ["boxes", 2 * size + (1 if any(map(any, problem.under)) else 0) + 1, bounds, tree]
    witness = [
        statement.name,
        [],
        {name: str(value) for name, value in zip(problem.names, point)},
        ["close"],
    ]
    stored = json.dumps({"certified": ["proof", [], node], "point": witness})
    outcome, reason = checker.check_one(statement, json.loads(stored), {}, {})
    if outcome != "certified":
        raise ArithmeticError(f"the checker says of {statement.name}: {outcome} {reason}")
    return len(stored)


# -------------------------------------------------------------------------------------------------
# The methods by name.

Worth = Literal["certificate", "rigorous", "unchecked", "no proof"]
NOTES = """\
certificate: what is printed was accepted by certificates/checker in this run, and that time \
is counted; the certificate can be read again.
rigorous: enclosed by arithmetic that rounds outwards (coq-interval: by Coq's kernel); to \
believe it again is to run it again.
unchecked: the answer of a solver.  no proof: floating point; its error is the distance to the \
truth, which it does not know itself.
The aim is judged against the certified peers and against Z3.  Certified peers: coq-interval, \
cvc5 where it writes its proof (nothing here reads it;
some of its steps say trust), and QEPCAD, whose answers are taken at their word.  Boxes in Arb \
and mpmath.iv are our own, measured beside."""


Result = Answer | Strayed | Callable[[], Strayed]  # a distance that is computed untimed


class Needs(NamedTuple):
    """The needs of a method: a package to install if it is absent, and whether it is there."""

    package: str = ""
    present: Callable[[], bool] = lambda: True


@dataclass(frozen=True)
class Method:
    """A way to answer: `solve` gives the answer to a piece of work at a width (or for an amount of
    work), `peer` says whether it is a certified peer in the aim; `prepare` makes what is kept from
    run to run, before anything is measured.
    """

    name: str
    title: str
    worth: Worth
    solve: Callable[..., Result]
    needs: Needs = Needs()
    peer: bool = False
    prepare: Callable[[], object] = lambda: None


def later(place: str) -> Callable[[Work, Fraction], Result]:
    """The function that stands at "file:name" of this folder; its file is loaded when it is
    called.
    """
    file, _, name = place.partition(":")

    def solve(work: Work, size: Fraction) -> Result:
        module = import_module(f"juggleproof.benchmarks.bench.{file}")
        result: Result = getattr(module, name)(work, size)
        return result

    return solve


def library(name: str, module: str) -> Needs:
    """The need of a library of PyPI, by the name under which it is imported; its presence is found
    without loading it.
    """
    shown = f"pip install {name}"
    return Needs(f"{NAMES.get(name, name)} ({shown})", lambda: find_spec(module) is not None)


NAMES = {"z3-solver": "Z3"}
FLINT, MPMATH, NUMBA = (
    library(*pair) for pair in (("python-flint", "flint"), ("mpmath", "mpmath"), ("numba", "numba"))
)
Z3, CVC5, SCIPY = (
    library(*pair) for pair in (("z3-solver", "z3"), ("cvc5", "cvc5"), ("scipy", "scipy"))
)
QEPCAD = Needs("QEPCAD B (Debian package qepcad)", lambda: shutil.which("qepcad") is not None)
COQ = Needs("coq-interval (Debian packages coq and libcoq-interval)", solvers.has_coq_interval)


def bisected(
    name: str, title: str, ask: solvers.Exceeds, needs: Needs, peer: bool = False
) -> Method:
    """A solver that is asked by bisection."""
    return Method(
        name, f"{title}, bisection", "unchecked", partial(solvers.bisected, ask), needs, peer
    )


def once(name: str, title: str, ask: solvers.Exceeds, needs: Needs, peer: bool = False) -> Method:
    """A solver that is asked one question."""
    return Method(
        name, f"{title}, one question", "unchecked", partial(solvers.asked_once, ask), needs, peer
    )


def by_name(*methods: Method) -> dict[str, Method]:
    """The methods by their names."""
    return {one.name: one for one in methods}


METHODS = by_name(
    Method("bernstein", "exact Bernstein, ours", "certificate", bernstein),
    Method("arb", "Arb boxes", "rigorous", numerics.arb_boxes, FLINT),
    Method("mpmath", "mpmath.iv boxes", "rigorous", numerics.mpmath_boxes, MPMATH),
    replace(once("coq", "coq-interval", solvers.by_coq_interval, COQ, True), worth="rigorous"),
    bisected("z3", "Z3", solvers.by_z3, Z3),
    once("z3-once", "Z3", solvers.by_z3, Z3),
    bisected("cvc5", "cvc5", solvers.by_cvc5, CVC5),
    once("cvc5-once", "cvc5", solvers.by_cvc5, CVC5),
    replace(
        once("cvc5-proof", "cvc5", solvers.by_cvc5_with_proof, CVC5, True),
        title="cvc5, one question with its proof",
    ),
    bisected("qepcad", "QEPCAD B", solvers.by_qepcad, QEPCAD, True),
    once("qepcad-once", "QEPCAD B", solvers.by_qepcad, QEPCAD, True),
    Method("sampling", "float sampling", "no proof", later("floats:sampling")),
    Method("scipy", "scipy.optimize", "no proof", later("floats:scipy_optimize"), SCIPY),
)
ORBITS = by_name(
    Method("exact", "exact rationals", "rigorous", later("orbits:exact")),
    Method("enclosed", "Arb balls", "rigorous", later("orbits:enclosed"), FLINT),
    Method("fast", "float64 with a proved bound", "rigorous", later("orbits:fast")),
    Method("mp", "mpmath, 50 digits", "no proof", later("orbits:mp")),
    Method("floats", "float64 alone", "no proof", later("orbits:floats")),
)
ENSEMBLE = by_name(
    Method("ensemble", "float64 with proved bounds", "rigorous", later("orbits:ensemble"))
)
BLOCKS = by_name(
    Method(
        "blocks",
        "flights in closed form",
        "no proof",
        later("blocks:followed"),
        NUMBA,
        prepare=partial(later("blocks:followed"), Drops(copies=1), Fraction(1, 10**6)),
    )
)
QUICK = ("bernstein", "arb", "z3", "z3-once", "sampling")
GROWTH = ("bernstein", "arb", "mpmath", "z3-once")  # measured as the number of variables grows
