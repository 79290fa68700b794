"""Answers all problems of some scripts, by any executor, and keeps statements and certificates
beside each script."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from certificates import checker
from certificates.store import Store, write_store
from certificates.terms import ClaimError
from proofs.running import one_at_a_time, spread

from .answering import BUDGET, Answer, Question, answer, question
from .script import Problem, problems_of_file

TITLE = (
    "What the problems of {} come to: certified says unsat, refuted says sat;"
    " certificates/checker reads this file and believes nothing else."
)


@dataclass(frozen=True)
class Answered:
    """One problem of a script with its answer; `rejected` is why the checker, reading the stored
    file, rejects its certificate."""

    path: Path
    problem: Problem
    answer: Answer
    rejected: str = ""

    @property
    def name(self) -> str:
        """The script, and the line of the check-sat where it has several."""
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
        """Whether it is answered, and as the script states."""
        return self.answer.word != "unknown" and not self.contradicts and not self.rejected


def id_of(path: Path) -> str:
    """The name of a script's statements.

    >>> id_of(Path("a/Motzkin's form.smt2"))
    'Motzkin-s-form'
    """
    return re.sub(r"[^A-Za-z0-9.\-]+", "-", path.stem, flags=re.ASCII).strip("-.") or "script"


def folder_of(path: Path, store: Path | None) -> Path:
    """Where the certificates of a script are kept."""
    return store or path.with_suffix(".certificates")


def answer_files(
    paths: Sequence[Path],
    *,
    budget: int = BUDGET,
    store: Path | None = None,
    fresh: bool = False,
    executor: Executor | None = None,
    progress: Callable[[Answer], None] = lambda answered: None,
) -> list[Answered]:
    """Every problem of the scripts with its answer, in order; statements and certificates are
    written, and the checker reads them again.

    Raises ClaimError, one line, for what is no script of QF_NRA.
    """
    read = [(path, problems_of_file(path)) for path in paths]
    ids = [id_of(path) for path in paths]
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
    asked: list[Question] = []
    for (_, problems), name, folder in zip(read, ids, folders):
        stored = Store(Path(os.devnull) if fresh else folder)
        for problem in problems:
            asked.append(
                question(
                    problem,
                    f"{name}/check" + (f"-{problem.number}" if len(problems) > 1 else ""),
                    budget,
                    stored,
                )
            )
    answers = iter(
        spread(
            partial(one_at_a_time, answer), asked, executor, lambda _, answered: progress(answered)
        )
    )
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


def _kept(folder: Path, answered: Sequence[Answered]) -> dict[str, str]:
    """Writes what was found to the folder; what the checker rejects there, and why."""
    scripts = ", ".join(dict.fromkeys(ascii(one.path.name)[1:-1] for one in answered))
    blocks = [f"# {TITLE.format(scripts)}"]
    certificates: dict[str, dict[str, object]] = {}
    for one in answered:
        renamed = [
            f"{variable.name} is {ascii(variable.symbol)[1:-1]}"
            for variable in one.problem.variables
            if variable.name != variable.symbol
        ]
        blocks.append((f"# {', '.join(renamed)}\n" if renamed else "") + one.answer.text)
        certificates.setdefault(one.answer.name.split("/")[0], {})[one.answer.name] = (
            one.answer.certificate
        )
    write_store(folder, "\n\n".join(blocks) + "\n", certificates)
    return {
        name: reason
        for name, outcome, reason in checker.check_folder(str(folder))
        if outcome == "rejected"
    }
