"""A problem as a statement, its answer, and the certificates that are kept beside its script.

The answer is unsat with a certificate that the checker accepted, sat with an exact model that it
accepted, and unknown otherwise.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.judging.conclusions import REFUTED
from juggleproof.search.small_proofs.searches_in_turn import certificates_in_turn
from juggleproof.smtlib.script import Problem, problems_of_file
from juggleproof.smtlib.statements import denial, givens, statement_of
from juggleproof.statements.language import ClaimError
from juggleproof.statements.nodes import Certificate, Counterexample
from juggleproof.statements.store import Store, write_store
from juggleproof.statements.work import Budget, Exhausted

if TYPE_CHECKING:
    from concurrent.futures import Executor

# -------------------------------------------------------------------------------------------------
# Answers.  A question and its answer are plain text and data, so that they pass between processes
# and machines.

WORDS = {"certified": "unsat", "refuted": "sat"}


@dataclass(frozen=True)
class ScriptQuestion:
    """A question whether a problem has a solution.  The first of `texts` states that it has none; a
    second one, if the first has givens, states that these alone contradict one another.

    `stored` has certificates of an earlier run, by the text of the statement.
    """

    name: str
    texts: tuple[str, ...]
    budget: int = limits.DEFAULT_BUDGET
    stored: Mapping[str, Certificate] = field(default_factory=dict)


@dataclass(frozen=True)
class ScriptAnswer:
    """An answer: sat, unsat or unknown, with the statement that was settled and its certificate."""

    name: str
    word: str
    text: str
    certificate: Certificate

    @property
    def reason(self) -> str:
        """The reason why the answer is unknown; empty for other answers."""
        return str(self.certificate.get("unknown", ""))

    @property
    def _counterexample(self) -> Counterexample:  # a list, where it comes from a file
        return cast(Counterexample, self.certificate["refuted"])

    @property
    def model(self) -> tuple[tuple[str, str], ...]:
        """The value of every variable of the statement; empty where the answer is not sat."""
        return tuple(sorted(self._counterexample[2].items())) if self.word == "sat" else ()

    @property
    def numbers(self) -> tuple[str, ...]:
        """The algebraic numbers in the model, each a root of a polynomial between two bounds."""
        entries = self._counterexample[1] if self.word == "sat" else []
        return tuple(
            f"{low} <= {name} <= {high}, {poly} = 0" for name, poly, low, high, *_ in entries
        )


def question(
    problem: Problem, name: str, budget: int = limits.DEFAULT_BUDGET, store: Store | None = None
) -> ScriptQuestion:
    """The question whether a problem has a solution, whose statements have this name."""
    whole = statement_of(problem, name)
    parts = [whole, denial(problem, name, givens(whole))] if givens(whole) else [whole]
    texts = tuple(part.text() for part in parts)
    stored = {text: store.certificate(name, text) for text in texts} if store else {}
    return ScriptQuestion(
        name, texts, budget, {text: kept for text, kept in stored.items() if kept}
    )


def answer(asked: ScriptQuestion) -> ScriptAnswer:
    """The answer, which the checker has accepted.

    >>> text = "statement f/check-1\\nforall x\\nshow not x^2 = 2"
    >>> answer(ScriptQuestion("f/check-1", (text,))).numbers
    ('-3/2 <= theta <= -7/5, -theta^2 + 2 = 0',)
    """
    for text, certificate in asked.stored.items():
        word = settled(asked.name, text, certificate)
        if word != "unknown" and not (word == "sat" and text != asked.texts[0]):
            return ScriptAnswer(asked.name, word, text, certificate)
    first: ScriptAnswer | None = None
    for text in asked.texts:
        found = _searched(asked, text)
        if found.word != "unknown":
            return found
        first = first or found
    return first or ScriptAnswer(asked.name, "unknown", "", {"unknown": "nothing was asked"})


def settled(name: str, text: str, certificate: Certificate) -> str:
    """sat or unsat where the checker accepts the certificate, else unknown."""
    return settled_as(checker.read_statements(text)[name], certificate)


def settled_as(statement: checker.Statement, certificate: Certificate) -> str:
    """sat or unsat where the checker accepts a parsed statement's certificate, else unknown."""
    return WORDS.get(checker.check_one(statement, certificate, {}, {})[0], "unknown")


def _searched(asked: ScriptQuestion, text: str) -> ScriptAnswer:
    """The answer by a search on one of the texts of a question; only the first can give sat."""
    try:
        statement = checker.read_statements(text)[asked.name]
    except checker.Rejected as reason:
        return ScriptAnswer(asked.name, "unknown", "", {"unknown": beyond_reading(text, reason)})
    unknown: Certificate = {"unknown": "the checker rejects what was found"}
    try:
        for certificate in certificates_in_turn(statement, Budget(asked.budget)):
            word = settled_as(statement, certificate)
            if word == "unsat" or word == "sat" and text == asked.texts[0]:
                return ScriptAnswer(asked.name, word, text, certificate)
            if "unknown" in certificate:
                unknown = certificate
    except Exhausted:
        unknown = {"unknown": f"the budget of {asked.budget} units ran out"}
    except checker.Rejected as reason:
        unknown = {"unknown": f"beyond the checker's limits: {reason}"}
    except RecursionError:
        unknown = {"unknown": "it is nested too deep for the search"}
    except (OverflowError, ValueError) as error:
        if isinstance(error, ValueError) and "integer string conversion" not in str(error):
            raise
        # too large for a float, or for Python to write as text
        unknown = {"unknown": "its numbers grow too long for the search"}
    return ScriptAnswer(asked.name, "unknown", text, unknown)


def beyond_reading(text: str, reason: checker.Rejected) -> str:
    """The reason why the checker cannot read a statement."""
    if reason.kind is not checker.Kind.TEXT:
        return f"beyond the checker's limits: {reason}"
    longest = max(len(line) for line in text.split("\n"))
    return f"beyond the checker's limits: a formula of {longest} letters when it is written out"


def in_script(answered: ScriptAnswer, problem: Problem) -> list[tuple[str, str]]:
    """The model in the script's own symbols, in its order; a variable that no assertion mentions is
    0.

    A Bool is true where the real that stands for it is > 0: "true", "false" or that condition.
    """
    values, model = dict(answered.model), []
    for variable in problem.variables:
        value = values.get(variable.name, "0")
        if variable.sort == "Bool":
            value = (
                f"{value} > 0"
                if re.search("[A-Za-z]", value)
                else "true"
                if Fraction(value) > 0
                else "false"
            )
        model.append((variable.symbol, value))
    return model


# -------------------------------------------------------------------------------------------------
# Scripts: all of their problems are answered, by any executor, and the statements and certificates
# are kept beside each script.

TITLE = (
    f"What the problems of {{}} come to: certified says unsat, {REFUTED} says sat;"
    " certificates/checker reads this file and believes nothing else."
)


@dataclass(frozen=True)
class Answered:
    """One problem of a script with its answer; `rejected` is the reason for which the checker, on
    reading the stored file, rejects its certificate, if it does.
    """

    path: Path
    problem: Problem
    answer: ScriptAnswer
    rejected: str = ""

    @property
    def name(self) -> str:
        """The script, with the name of the problem, or its number where there are several."""
        return self.answer.name.removesuffix("/check")

    @property
    def contradicts(self) -> bool:
        """Whether the script states another answer."""
        return self.answer.word != "unknown" and self.problem.status not in (
            "",
            "unknown",
            self.answer.word,
        )

    @property
    def settled(self) -> bool:
        """Whether the answer is sat or unsat, not rejected, and not contrary to the script."""
        return self.answer.word != "unknown" and not self.contradicts and not self.rejected


def id_of(name: str) -> str:
    """The name of a script or problem in the characters that names of statements allow.

    >>> id_of("Motzkin's form")
    'Motzkin-s-form'
    """
    return re.sub(r"[^A-Za-z0-9.\-]+", "-", name, flags=re.ASCII).strip("-.") or "script"


def names_of(script: str, problems: Sequence[Problem]) -> list[str]:
    """The names of the statements of a script's problems.

    Raises ClaimError, one line, where two are the same.
    """
    names: list[str] = []
    for problem in problems:
        number = f"-{problem.number}" if len(problems) > 1 else ""
        name = f"{script}/{id_of(problem.name)}" if problem.name else f"{script}/check{number}"
        if name in names:
            raise ClaimError(
                f"{problem.place}: its statement would have the name of that of"
                f" {problems[names.index(name)].place}; rename one"
            )
        names.append(name)
    return names


def folder_of(path: Path, store: Path | None) -> Path:
    """The folder for the certificates of a script."""
    return store or path.with_suffix(".certificates")


def answer_files(
    paths: Sequence[Path],
    *,
    budget: int = limits.DEFAULT_BUDGET,
    store: Path | None = None,
    fresh: bool = False,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Callable[[ScriptAnswer], None] = lambda answered: None,
) -> list[Answered]:
    """Every problem of the scripts with its answer, in order, by an executor or by `jobs`
    processes; statements and certificates are written, and the checker reads them again.

    Raises ClaimError, one line, for a file that is not a script of QF_NRA, and where two problems
    or two scripts would have the same name.
    """
    read = [(path, problems_of_file(path)) for path in paths]
    ids = [id_of(path.stem) for path in paths]
    folders = [folder_of(path, store) for path in paths]
    for k, (path, _) in enumerate(read):
        same = next(
            (other for other in range(k) if folders[other] == folders[k] and ids[other] == ids[k]),
            None,
        )
        if same is not None:
            raise ClaimError(
                f"{path}: its statements would have the names of those of {paths[same]}; rename one"
            )
    asked: list[ScriptQuestion] = []
    for (_, problems), script, folder in zip(read, ids, folders):
        stored = Store(Path(os.devnull) if fresh else folder)
        for problem, name in zip(problems, names_of(script, problems)):
            asked.append(question(problem, name, budget, stored))
    answers = iter(_answers(asked, executor, jobs, progress))
    answered = [
        Answered(path, problem, next(answers)) for path, problems in read for problem in problems
    ]
    rejected = {
        folder: _kept(folder, [one for one in answered if folder_of(one.path, store) == folder])
        for folder in dict.fromkeys(folders)
    }
    return [
        Answered(
            one.path,
            one.problem,
            one.answer,
            rejected[folder_of(one.path, store)].get(one.answer.name, ""),
        )
        for one in answered
    ]


def _answers(
    asked: Sequence[ScriptQuestion],
    executor: Executor | None,
    jobs: int,
    progress: Callable[[ScriptAnswer], None],
) -> list[ScriptAnswer]:
    if executor is None and (jobs == 1 or len(asked) == 1):
        answers = []
        for one in asked:
            answers.append(answer(one))
            progress(answers[-1])
        return answers
    processes = import_module("juggleproof.statements.processes")  # slow to load
    pool: AbstractContextManager[Executor] = (
        processes.own_pool(jobs) if executor is None else nullcontext(executor)
    )
    with pool as own:
        spread: list[ScriptAnswer] = processes.spread(
            partial(processes.one_at_a_time, answer), asked, own, lambda _, one: progress(one)
        )
    return spread


def _kept(folder: Path, answered: Sequence[Answered]) -> dict[str, str]:
    """Writes statements and certificates to the folder; returns the names that the checker rejects
    there, each with the reason.
    """
    scripts = ", ".join(dict.fromkeys(ascii(one.path.name)[1:-1] for one in answered))
    blocks = [f"# {TITLE.format(scripts)}"]
    certificates: dict[str, dict[str, Certificate]] = {}
    for one in answered:
        renamed = [
            f"{variable.name} is {ascii(variable.symbol)[1:-1]}"
            for variable in one.problem.variables
            if variable.name != variable.symbol
        ]
        if not one.answer.text:
            continue
        blocks.append((f"# {', '.join(renamed)}\n" if renamed else "") + one.answer.text)
        certificates.setdefault(one.answer.name.split("/")[0], {})[one.answer.name] = (
            one.answer.certificate
        )
    write_store(folder, "\n\n".join(blocks) + "\n", certificates)
    try:
        checked = checker.check_folder(str(folder))
    except checker.Rejected as reason:  # the whole folder is too large
        return {one.answer.name: str(reason) for one in answered}
    return {name: reason for name, outcome, reason in checked if outcome == "rejected"}
