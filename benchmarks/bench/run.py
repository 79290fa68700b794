"""The benchmark: each answer is measured in a process of its own.  The questions are measured one
after another, judged against their closed forms, printed and drawn.
"""

from __future__ import annotations

import os
import pickle
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

from juggleproof.benchmarks.bench import table
from juggleproof.benchmarks.bench.answers import Drops, MeasuredAnswer, OrbitQuestion, Work
from juggleproof.benchmarks.bench.methods import (
    BLOCKS,
    ENSEMBLE,
    GROWTH,
    METHODS,
    NOTES,
    ORBITS,
    QUICK,
    Method,
)
from juggleproof.benchmarks.bench.orbits import STARTS, STATE_STEPS
from juggleproof.benchmarks.bench.questions import ALPHAS, VARIABLE_WIDTH, balls, questions
from juggleproof.benchmarks.figures import ABSENT, can_plot
from juggleproof.benchmarks.processes import STALLED, end_with_children
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import write_file

# -------------------------------------------------------------------------------------------------
# One answer, in a process of its own, which is ended with its children when its seconds are over.

ROOT = Path(__file__).resolve().parents[2]
START = 5.0  # CPU seconds that a process may take to start and to end
Report = Callable[[str], None]


def measure(method: Method, work: Work, size: Fraction, seconds: float) -> MeasuredAnswer:
    """Cold and warm CPU seconds and the answer of one method; `seconds` limits the cold answer, and
    all answers together.
    """
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH", "")])),
    }
    process = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "juggleproof.benchmarks.bench.child",
            method.name,
            str(size),
            str(seconds),
        ],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        cwd=ROOT,
        start_new_session=True,
    )
    try:
        output, errors = process.communicate(
            pickle.dumps(work), timeout=STALLED * (seconds + START)
        )
    except subprocess.TimeoutExpired:
        return MeasuredAnswer(method.name, size, reason="gave up")
    finally:
        end_with_children(process)
    if process.returncode in (-signal.SIGKILL, -signal.SIGXCPU):
        return MeasuredAnswer(method.name, size, reason="gave up")
    if process.returncode:
        lines = errors.decode(errors="replace").strip().splitlines()
        return MeasuredAnswer(
            method.name, size, reason=f"failed: {lines[-1] if lines else process.returncode}"[:200]
        )
    measured: MeasuredAnswer = pickle.loads(output)
    if measured.cold is not None and measured.cold > seconds:
        return MeasuredAnswer(method.name, size, reason="gave up")
    return measured


Works = Callable[[Fraction], tuple[Work, Fraction, Fraction]]  # work, its own size, the truth


def same(work: Work) -> Works:
    """The same work at each size, and answers as they are."""
    return lambda size: (work, size, Fraction(0))


def measure_all(
    methods: Sequence[Method],
    works: Works,
    sizes: Sequence[Fraction],
    seconds: float,
    report: Report,
) -> Iterator[MeasuredAnswer]:
    """Every method at every size, easiest first; a method that gave up is not asked for more."""
    for method in methods:
        for size in sizes:
            report(f"{method.title}, {size}")
            work, own, truth = works(size)
            measured = table.resized(measure(method, work, own, seconds), size, truth)
            yield measured
            if measured.answer is None:
                break


# -------------------------------------------------------------------------------------------------
# The whole benchmark.

WIDTHS = tuple(Fraction(1, 10**k) for k in range(1, 13))
QUICK_WIDTHS, QUICK_SIZES, QUICK_SECONDS = (Fraction(1, 10), Fraction(1, 10**6)), 2, 2.0
SECONDS = 10.0
ENERGY = ("E-B1plus", "E-B1zero", "DE-H", "DE-outside-R", "p-outside-R")
_WIDTH = re.compile(
    r"\d{0,4}\.?\d{1,40}(?:e-?\d{1,2})?|\d{1,10}/\d{1,40}", re.ASCII | re.IGNORECASE
)


class Cost(NamedTuple):
    """A question of cost as work grows: its methods, those of a quick run, and the sizes of the
    work; the text that is printed above it, and the quantity against which seconds are compared.
    `works` gives for a size the work, its own size, and the truth.
    """

    title: str
    said: str
    methods: Mapping[str, Method]
    quick: Sequence[str]
    sizes: tuple[Fraction, ...]
    works: Works
    against: str
    inverse: bool = False


def summed(size: Fraction) -> tuple[Work, Fraction, Fraction]:
    """The energy that `size` balls gain, to one width, and its closed form."""
    problem, truth = balls(int(size))
    return problem, VARIABLE_WIDTH, truth


COSTS = {
    **{
        name: Cost(
            start.title,
            f"{start.title}: the state after so many periods; error: what is proved of it, or else"
            " the distance to the exact orbit",
            ORBITS,
            tuple(ORBITS),
            tuple(Fraction(10**k) for k in range(7)),
            same(start),
            "periods",
        )
        for name, start in STARTS.items()
    },
    "variables": Cost(
        "variables",
        "sup of the sum of Delta E over so many balls on the table, and alpha besides; to a width"
        f" of {table.power(VARIABLE_WIDTH)}",
        {name: METHODS[name] for name in GROWTH},
        GROWTH,
        tuple(Fraction(k) for k in range(1, 6)),
        summed,
        "variables",
    ),
    "states": Cost(
        "states",
        f"so many random states, each followed for {STATE_STEPS} periods; error: the largest bound"
        " of a state that is decided",
        ENSEMBLE,
        tuple(ENSEMBLE),
        tuple(Fraction(10**k) for k in range(2, 7)),
        same(OrbitQuestion()),
        "states",
    ),
    "part": Cost(
        "the part on the vibrating table",
        f"the part on the vibrating table: {Drops().copies} times 10 blocks that fall on it, for"
        " 0.2 s, by tolerance in metres; error: the median distance to ends known to 35 digits",
        BLOCKS,
        tuple(BLOCKS),
        tuple(Fraction(1, 10**k) for k in range(6, 13)),  # metres
        same(Drops()),
        "1/tolerance",
        True,
    ),
}
NAMES = (*ENERGY, *COSTS)


@dataclass(frozen=True)
class Wish:
    """The questions, widths and seconds of a run."""

    names: tuple[str, ...]
    widths: tuple[Fraction, ...]
    seconds: float
    quick: bool


def wish(asked: Sequence[str] | None, widths: str | None, seconds: str | None, quick: bool) -> Wish:
    """What the options say; raises ClaimError, one line, for what cannot be measured.

    >>> wish(["orbit"], None, None, True).names, wish(None, "1e-2,1/7", "3", False).widths
    (('orbit',), (Fraction(1, 7), Fraction(1, 100)))
    """
    for name in asked or ():
        if name not in NAMES:
            raise ClaimError(
                f"--question {name[:40]}: no such question; there are {', '.join(NAMES)}"
            )
    names = tuple(asked or (ENERGY[:1] if quick else NAMES))
    some, limit = (QUICK_WIDTHS, QUICK_SECONDS) if quick else (WIDTHS, SECONDS)
    return Wish(
        names,
        some if widths is None else _widths(widths),
        limit if seconds is None else _seconds(seconds),
        quick,
    )


def _widths(text: str) -> tuple[Fraction, ...]:
    chosen = []
    for part in text.split(","):
        try:
            width = Fraction(part.strip()) if _WIDTH.fullmatch(part.strip()) else Fraction(0)
        except ZeroDivisionError:
            width = Fraction(0)
        if not Fraction(1, 10**40) <= width <= 1:
            raise ClaimError(
                f"--widths {part.strip()[:40]!r}: a width is a number from 1e-40 to 1; write"
                " 1e-1,1e-6"
            )
        chosen.append(width)
    return tuple(sorted(set(chosen), reverse=True))


def _seconds(text: str) -> float:
    if not re.fullmatch(r"\d{1,4}(\.\d{1,3})?", text, re.ASCII) or not 0.1 <= float(text) <= 3600:
        raise ClaimError(
            f"--seconds {text[:40]!r}: a limit is a number of seconds from 0.1 to 3600"
        )
    return float(text)


class BenchRun:
    """A run, which prints as it goes, and counts wrong answers."""

    def __init__(self, wanted: Wish, folder: Path, report: Report) -> None:
        self.wanted, self.folder, self.report = wanted, folder, report
        self.wrong, self.answered = 0, False
        self.judged: list[table.Judged] = []

    def all(self) -> int:
        """Measures every question; returns 1 if an enclosure does not hold the truth, no method
        that is present answers a question, or nothing is answered at all, else 0.
        """
        print(head(self.wanted))
        for name in self.wanted.names:
            print(f"\n== {name}")
            if name in ENERGY:
                self.energy(name)
            else:
                self.cost(name, COSTS[name])
        if sum(name in ENERGY for name in self.wanted.names) > 1:
            print(
                "\n== the aim, over all questions and widths of this run\n"
                + "\n".join(one.line() for one in table.together(self.judged))
            )
        if not can_plot():
            print(ABSENT)
        return 1 if self.wrong or not self.answered else 0

    def energy(self, name: str) -> None:
        """Measures one of the questions about energy."""
        question = questions()[name]
        problem, truth, present = question.problem(), question.truth(), self.present(METHODS, QUICK)
        print(
            f"{question.title}, for alpha in [{ALPHAS[0]}, {ALPHAS[1]}]; box methods:"
            f" {question.how}"
        )
        print(
            f"closed form: {question.closed_form}; over these alphas {truth} ="
            f" {float(truth):.15g}\n"
        )
        truth *= problem.sign
        results = self.measure(present, same(problem), self.wanted.widths)
        self.show(name, question.title, present, self.wanted.widths, results, truth)
        print("\n" + table.ratios(present, self.wanted.widths, results, self.wanted.seconds))
        judged = table.judged(name, present, self.wanted.widths, results, self.wanted.seconds)
        self.judged += judged
        print("\n" + "\n".join(one.line() for one in judged))
        if not any(method.peer for method in present):
            print("no certified peer was measured")
        print("\n" + table.slopes(present, results, "1/width", True))

    def cost(self, name: str, asked: Cost) -> None:
        """Measures a question of cost, by the size of the work."""
        present = self.present(asked.methods, asked.quick)
        sizes = asked.sizes[:QUICK_SIZES] if self.wanted.quick else asked.sizes
        print(f"{asked.said}\n")
        results = self.measure(present, asked.works, sizes)
        self.show(name, asked.title, present, sizes, results, Fraction(0))
        print("\n" + table.slopes(present, results, asked.against, asked.inverse))

    def present(self, methods: Mapping[str, Method], quick: Sequence[str]) -> list[Method]:
        """The methods that are installed, in a quick run only some; prints which are absent."""
        absent = [method for method in methods.values() if not method.needs.present()]
        if absent:
            print("absent: " + ", ".join(dict.fromkeys(method.needs.package for method in absent)))
        return [
            method
            for name, method in methods.items()
            if method not in absent and (not self.wanted.quick or name in quick)
        ]

    def measure(
        self, present: Sequence[Method], works: Works, sizes: Sequence[Fraction]
    ) -> table.Results:
        """Measures all methods at all sizes."""
        found = measure_all(present, works, sizes, self.wanted.seconds, self.report)
        return table.by_method(list(found))

    def show(
        self,
        name: str,
        title: str,
        present: Sequence[Method],
        sizes: Sequence[Fraction],
        results: table.Results,
        truth: Fraction,
    ) -> None:
        """Prints the table and the wrong answers, and writes the plot; prints none if nothing was
        measured.
        """
        self.report("")
        print(table.measured(present, sizes, results, truth))
        for line in table.faults(present, results):
            print(line)
        measurements = [one for by_size in results.values() for one in by_size.values()]
        if all(one.answer is None for one in measurements):
            print("nothing was measured")
            self.wrong += bool(present)
            return
        self.answered = True
        wrong = table.wrong(present, results, truth)
        self.wrong += len(wrong)
        print("\n".join(wrong) or "every enclosure holds the truth")
        if can_plot():
            path = self.folder / f"{name}.svg"
            write_file(path, table.plot(title, present, results, truth))
            print(f"plot: {path}")


def head(wanted: Wish) -> str:
    """The lines that say what the numbers mean."""
    return (
        "warm: the least of 3 answers after the first in one process, of more where they are"
        " quick; cold: the first, with all that the method\nloads, not the start of Python. Each"
        f" answer has {wanted.seconds:g} s; a method that gave up is not asked for what is"
        f" harder.\n{NOTES}"
    )
