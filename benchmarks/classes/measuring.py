"""The answers of Z3, cvc5 and us to the problems, with their CPU seconds, and the bare checker's
verdicts on our certificates; as a table.
"""

from __future__ import annotations

import re
import statistics
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from z3 import Context, Z3_eval_smtlib2_string, Z3Exception, set_param

from juggleproof.benchmarks.classes.classes import Made
from juggleproof.benchmarks.generated import in_columns
from juggleproof.benchmarks.processes import TimedProcess, children_seconds, each, output_of
from juggleproof.smtlib.answering import answer, question
from juggleproof.smtlib.script import read_problems
from juggleproof.statements.language import ClaimError
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import certificate_lines, write_store

ROOT = Path(__file__).resolve().parents[2]
CHECKER = ROOT / "certificates/checker"
Z3_UNITS = 10_000_000  # Z3's rlimit
CVC5_UNITS = 500_000  # cvc5's rlimit
SECONDS = 6.0  # CPU seconds that end a search which no counted limit ends
OUTCOMES = ("unsat", "sat")


@dataclass(frozen=True)
class Said:
    """An answer: sat, unsat, unknown, or why there is none; ours with its statement and
    certificate.
    """

    word: str
    text: str = ""
    certificate: Certificate = field(default_factory=Certificate)


Ask = Callable[[], Callable[[Made], Callable[[], Said]]]

# -------------------------------------------------------------------------------------------------
# The solvers: each reads the script itself, within a counted limit.


def ours() -> Callable[[Made], Callable[[], Said]]:
    """Our search with its check, at the default budget."""

    def run(problem: Made) -> Said:
        try:
            (one,) = read_problems(problem.script, problem.name)
            found = answer(question(one, statement_of(problem)))
        except ClaimError as error:
            return Said(f"refused: {error}")
        return Said(found.word, found.text, found.certificate)

    return lambda problem: partial(run, problem)


def statement_of(problem: Made) -> str:
    """The name of its statement."""
    return f"{problem.group.replace(' ', '-')}/{problem.name}"


def z3() -> Callable[[Made], Callable[[], Said]]:
    """Z3, each script in a context of its own; if the script sets an option that is read before a
    context is made, by the program that comes with Z3.
    """
    set_param("rlimit", Z3_UNITS)

    def run(problem: Made) -> Said:
        context = Context()  # it has to live until all is read
        try:
            output = Z3_eval_smtlib2_string(context.ref(), problem.script)
        except Z3Exception:
            program = [str(Path(sys.executable).with_name("z3")), "-in", f"rlimit={Z3_UNITS}"]
            output = output_of(program, problem.script) or ""
        return Said(last_word(output))

    return lambda problem: partial(run, problem)


def cvc5() -> Callable[[Made], Callable[[], Said]]:
    """cvc5, each script in a solver of its own."""
    from cvc5 import InputLanguage, InputParser, Solver

    def run(problem: Made) -> Said:
        solver, output = Solver(), ""
        solver.setOption("rlimit", str(CVC5_UNITS))
        parser = InputParser(solver)
        parser.setStringInput(InputLanguage.SMT_LIB_2_6, problem.script, "check")
        try:
            while not (command := parser.nextCommand()).isNull():
                output += str(command.invoke(solver, parser.getSymbolManager()))
        except RuntimeError as error:
            return Said(f"refused: {error}")
        return Said(last_word(output))

    return lambda problem: partial(run, problem)


def last_word(output: str) -> str:
    """The last answer in what a solver writes.

    >>> last_word("unsat\\nunknown\\n"), last_word("")
    ('unknown', 'unknown')
    """
    return output.split()[-1] if output.split() else "unknown"


# -------------------------------------------------------------------------------------------------
# The answers of all solvers to the problems of a class, and the checker's verdicts on ours.

SOLVERS: Mapping[str, Ask] = {"Z3": z3, "cvc5": cvc5, "ours": ours}
_SUMMARY = re.compile(r"\d+ statements: (\d+) certified, (\d+) refuted, 0 unknown, 0 rejected")


@dataclass(frozen=True)
class Measured:
    """The answers to the problems of a class by solver, each with its CPU seconds; the number of
    our certificates that the bare checker takes, their bytes, and its CPU seconds.
    """

    group: str
    problems: Sequence[Made]
    said: Mapping[str, Sequence[TimedProcess[Said]]]
    certified: int
    size: int
    checking: float

    def decided(self, solver: str) -> dict[str, float]:
        """The problems that a solver decides, with their CPU seconds."""
        return {
            problem.name: one.seconds
            for problem, one in zip(self.problems, self.said.get(solver, ()))
            if one.answer and one.answer.word in OUTCOMES
        }

    def faults(self) -> list[str]:
        """One line for each wrong answer, and one if the checker rejects a certificate."""
        lines = [
            f"WRONG: {problem.group}: {problem.name} is {problem.status}; {solver} says"
            f" {one.answer.word}"
            for solver, said in self.said.items()
            for problem, one in zip(self.problems, said)
            if one.answer and one.answer.word in OUTCOMES and one.answer.word != problem.status
        ]
        if self.certified != len(self.decided("ours")):
            lines.append(f"REJECTED: {self.group}: the checker takes {self.certified} only")
        return lines


def measured(group: str, problems: Sequence[Made]) -> Measured:
    """The answers of every installed solver to the problems, one solver after the other."""
    said = {
        solver: list(each(start, problems, SECONDS))
        for solver, start in SOLVERS.items()
        if solver != "cvc5" or find_spec("cvc5")
    }
    found = {
        statement_of(problem): one.answer
        for problem, one in zip(problems, said["ours"])
        if one.answer and one.answer.word in OUTCOMES
    }
    return Measured(group, problems, said, *checked(found))


def checked(found: Mapping[str, Said]) -> tuple[int, int, float]:
    """The number of our certificates that the checker takes, in a process of its own; their bytes,
    and its CPU seconds.
    """
    certificates = {name: one.certificate for name, one in found.items()}
    with tempfile.TemporaryDirectory() as folder:
        text = "\n\n".join(one.text for one in found.values()) + "\n"
        write_store(Path(folder), text, {"": certificates})
        before = children_seconds()
        output = output_of([sys.executable, "-I", "-S", str(CHECKER), folder], "") or ""
        seconds = children_seconds() - before
    taken = _SUMMARY.search(output)
    words = [one.word for one in found.values()]
    claimed = tuple(str(words.count(word)) for word in OUTCOMES)
    accepted = len(found) if taken and taken.groups() == claimed else 0
    return accepted, len(certificate_lines(certificates)), seconds


# -------------------------------------------------------------------------------------------------
# The table.


def table(classes: Sequence[Measured]) -> str:
    """A row for each class, and for all of them, in Markdown."""
    solvers = [solver for solver in SOLVERS if solver in classes[0].said]
    heads = ["class", "problems", *solvers, "certified", "ours of Z3's"]
    heads += [*(f"{solver}, CPU s" for solver in solvers), "bytes", "checker, CPU s"]
    rows = [_row(one.group, [one], solvers) for one in classes]
    return in_columns(heads, *rows, _row("all", classes, solvers))


def _row(title: str, classes: Sequence[Measured], solvers: Sequence[str]) -> list[str]:
    both = sum(len(one.decided("Z3").keys() & one.decided("ours").keys()) for one in classes)
    of_z3 = sum(len(one.decided("Z3")) for one in classes)
    return [
        title,
        str(sum(len(one.problems) for one in classes)),
        *(str(sum(len(one.decided(solver)) for one in classes)) for solver in solvers),
        str(sum(one.certified for one in classes)),
        f"{both}/{of_z3}",
        *(
            f"{sum(timed.seconds for one in classes for timed in one.said[solver]):.3g}"
            for solver in solvers
        ),
        str(sum(one.size for one in classes)),
        f"{sum(one.checking for one in classes):.2g}",
    ]


def ratios(classes: Sequence[Measured]) -> list[str]:
    """Our CPU seconds as multiples of each other solver's, over the problems that both decide."""
    lines = []
    for solver in list(SOLVERS)[:-1]:
        pairs = [
            (one.decided("ours")[name], seconds)
            for one in classes
            for name, seconds in one.decided(solver).items()
            if name in one.decided("ours")
        ]
        if pairs:
            total = sum(own for own, _ in pairs) / sum(peer for _, peer in pairs)
            middle = statistics.median(own / peer for own, peer in pairs)
            lines.append(
                f"Of the {len(pairs)} problems that both decide, ours takes {total:.2g} times the"
                f" CPU seconds of {solver} in all, and {middle:.2g} times in the median."
            )
    return lines
