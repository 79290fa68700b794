"""A mutation test of the checker: every mutant changes what becomes of a case of the tests beside
this file, or of a short stored certificate; those that cannot are in `equivalent.txt`, by reason.

    python -m tests.certificates.checker.mutate [BEGINNING OF A KEY ..]

Exit 1 where nothing notices a mutant that is not listed, or one that is listed is noticed.
"""

from __future__ import annotations

import ast
import contextlib
import io
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import types
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.statements.store import DEFAULT
from tests.certificates.checker import (
    test_definitions,
    test_files,
    test_limits,
    test_map_rules,
    test_meaning,
    test_returns,
    test_rules,
    test_settles,
    test_work,
)
from tests.certificates.checker.mutants import FILES, Mutant, mutants, parsed

MODULES = {name: import_module(f"{checker.__name__}.{name}") for name in FILES}
TABLES = (
    *(test_rules, test_files, test_work, test_definitions, test_map_rules, test_settles),
    *(test_returns, test_limits, test_meaning),
)
ELSEWHERE = ("compiled_code", "module_beside")  # what Python loads: no text of the checker
LIMIT = checker.MAX_WORK // 20  # of work, for a case
SECONDS = 4  # of CPU for a case, and five times as many for the store
MEMORY = 3 << 30
SHORT = 3_000  # bytes of a certificate of the store that is read
FOLLOWED = 300_000  # calls, after which a case is not followed further
EQUIVALENT = Path(__file__).with_name("equivalent.txt")
TREES = parsed()
MUTANTS = mutants(TREES)
Functions = set[tuple[str, str]]  # of the checker: (file, name)


def equivalent() -> dict[str, str]:
    """{key: reason} of the mutants that say the same as the checker."""
    reasons: dict[str, str] = {}
    reason = ""
    for row in EQUIVALENT.read_text().splitlines():
        if row.startswith("# "):
            reason = row[2:]
        elif row:
            reasons[row] = reason
    return reasons


# ------------------------------------------------------------ the cases


@dataclass(frozen=True)
class Case:
    """A test function with arguments, as pytest would call it."""

    function: Callable[..., object]
    arguments: dict[str, Any]

    def holds(self) -> bool:
        code = self.function.__code__
        checker.Work.__init__.__defaults__ = (LIMIT,)
        with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
            patch.setattr(test_files, "run", run)
            fixtures = {"tmp_path": Path(folder), "monkeypatch": patch, "outcomes": Outcomes()}
            names = code.co_varnames[: code.co_argcount]
            wanted = {name: fixtures[name] for name in fixtures if name in names}
            try:
                self.function(**self.arguments, **wanted)
            except (Exception, pytest.fail.Exception):
                return False
            finally:
                checker.Work.__init__.__defaults__ = (checker.MAX_WORK,)
        return True


class Outcomes(dict[str, str]):
    """What becomes of hostile sizes, each when it is asked for."""

    def __missing__(self, name: str) -> str:
        text, certificate = test_limits.CASES[name]
        *known, (_, statement) = checker.read_statements(text).items()
        work = checker.Work(LIMIT)
        return " ".join(map(str, checker.check_one(statement, certificate, dict(known), {}, work)))


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """The checker's command, in this process."""
    with (
        contextlib.redirect_stdout(io.StringIO()) as out,
        contextlib.redirect_stderr(io.StringIO()) as err,
    ):
        code = checker.main([*map(str, arguments)])
    return subprocess.CompletedProcess([], code, out.getvalue(), err.getvalue())


def cases() -> Iterator[Case]:
    """The cases of all tables; tests of random values are none."""
    for module in TABLES:
        for name, function in vars(module).items():
            apart = hasattr(function, "hypothesis") or any(word in name for word in ELSEWHERE)
            if name.startswith("test_") and not apart:
                marks = getattr(function, "pytestmark", ())
                (rows,) = [rows_of(one) for one in marks if one.name == "parametrize"] or [[{}]]
                yield from (Case(function, row) for row in rows)


def rows_of(mark: pytest.Mark) -> list[dict[str, Any]]:
    """The arguments of each row of a parametrized test."""
    names, rows = mark.args[:2]
    names = [name.strip() for name in names.split(",")] if isinstance(names, str) else names
    found = []
    for row in rows:
        if hasattr(row, "marks"):  # pytest.param
            row = row.values
        elif len(names) == 1:
            row = (row,)
        found.append(dict(zip(names, row, strict=True)))
    return found


class FollowedLongEnough(BaseException):
    pass


def reached(case: Case) -> tuple[int, Functions]:
    """(number of calls, functions of the checker that a case calls)."""
    calls = 0
    found: Functions = set()

    def follow(frame: types.FrameType, event: str, _: object) -> None:
        nonlocal calls
        if event == "call":
            calls += 1
            path = Path(frame.f_code.co_filename)
            if path.stem in MODULES and path.parts[-3:-1] == ("certificates", "checker"):
                name = frame.f_code.co_qualname.replace(".<locals>", "")
                found.add((path.stem, name.split(".<")[0]))
            if calls > FOLLOWED:
                raise FollowedLongEnough

    MODULES["text"].tree.cache_clear()
    sys.setprofile(follow)
    try:
        case.holds()
    except FollowedLongEnough:
        pass
    finally:
        sys.setprofile(None)
    return calls, found


@cache
def followed() -> list[tuple[Case, Functions]]:
    """The cases with what they reach, the short ones first."""
    rows = []
    for case in cases():
        if not case.holds():  # what the search has found for it is kept from here on
            raise ValueError(f"{case} fails without a mutant")
        rows.append((case, *reached(case)))
    rows.sort(key=lambda row: row[1])
    return [(case, found) for case, _, found in rows]


@cache
def short_store() -> tempfile.TemporaryDirectory[str]:
    """A folder of the stored statements, with those of their certificates that are read quickly."""
    folder = tempfile.TemporaryDirectory()
    shutil.copy(DEFAULT / "statements.txt", folder.name)
    with (Path(folder.name) / "certificates.jsonl").open("w") as file:
        for line in (DEFAULT / "certificates.jsonl").open():
            if len(line) <= SHORT:
                file.write(line)
    return folder


@cache
def outcomes_of_store() -> str:
    """What the checker prints of it."""
    return run(short_store().name).stdout


# ------------------------------------------------------------ a mutant in place of the checker


def install(mutant: Mutant) -> None:
    """Puts the mutant's functions and constants in place of the checker's, in this process."""
    setattr(mutant.parent, mutant.field, mutant.new)
    tree = ast.fix_missing_locations(TREES[mutant.file])
    module = MODULES[mutant.file]
    other = types.ModuleType(module.__name__)
    other.__package__ = module.__package__
    sys.modules[module.__name__] = other
    exec(compile(tree, str(module.__file__), "exec"), vars(other))
    sys.modules[module.__name__] = module
    for name, new in vars(other).items():
        if callable(new) and getattr(new, "__module__", "") == module.__name__:
            transplant(vars(module)[name], new)
        elif not mutant.function and name in mutant.names:
            for user in MODULES.values():
                if name in vars(user):
                    setattr(user, name, new)
    MODULES["text"].tree.cache_clear()


def transplant(old: Any, new: Any) -> None:
    """Gives a function, or the methods of a class, the code of another."""
    old, new = (getattr(one, "__wrapped__", one) for one in (old, new))
    if isinstance(new, types.FunctionType):
        old.__code__ = new.__code__
        old.__defaults__ = new.__defaults__
    elif isinstance(new, type) and new.__name__ != "Kind":
        for name, value in vars(new).items():
            if isinstance(value, types.FunctionType):
                transplant(vars(old)[name], value)


def noticed(
    mutant: Mutant, rows: Sequence[tuple[Case, Functions | None]], first: Iterable[int]
) -> str:
    """What notices the mutant that is installed: "tables" and the number of the row that does,
    "store" or ""; these rows are tried first.
    """
    for number in dict.fromkeys([*first, *range(len(rows))]):
        case, found = rows[number]
        if found is None or not mutant.function or (mutant.file, mutant.function) in found:
            signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
            if not case.holds():
                return f"tables {number}"
    before = outcomes_of_store()
    outcomes_of_store.cache_clear()
    signal.setitimer(signal.ITIMER_VIRTUAL, 5 * SECONDS)
    try:
        return "store" if outcomes_of_store() != before else ""
    except Exception:
        return "store"


# The rows that noticed a mutant of a function, the last one last: they notice others of it, too.
rejecting: defaultdict[tuple[str, str], list[int]] = defaultdict(list)


def judged(index: int, follow: bool) -> tuple[str, float]:
    """The same, in a process of its own, and its CPU seconds; one that does not end, or too late,
    is noticed.
    """
    end, begin = os.pipe()
    place = (MUTANTS[index].file, MUTANTS[index].function)
    child = os.fork()
    if child == 0:
        try:
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            signal.alarm(
                1200
            )  # for one that waits; on a busy machine one that works may take minutes
            rows: Sequence[tuple[Case, Functions | None]]
            rows = followed() if follow else [(case, None) for case in cases()]
            try:
                install(MUTANTS[index])
                found = noticed(MUTANTS[index], rows, reversed(rejecting[place]))
            except Exception:  # a table of the checker that cannot be built
                found = "tables"
            os.write(begin, found.encode() or b"-")
        finally:
            os._exit(0)
    os.close(begin)
    with open(end, "rb") as pipe:
        answer = pipe.read().decode()
    _, _, used = os.wait4(child, 0)
    found, _, number = (answer.removeprefix("-") if answer else "tables").partition(" ")
    if number:
        rejecting[place] = [one for one in rejecting[place] if one != int(number)] + [int(number)]
    return found, used.ru_utime + used.ru_stime


def judge_all(indices: Sequence[int], follow: bool) -> Iterator[tuple[str, str, float]]:
    """(key, what notices it, CPU seconds) of these mutants."""
    outcomes_of_store()
    if follow:
        followed()
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("fork")) as pool:
        found = pool.map(judged, indices, [follow] * len(indices))
        yield from ((MUTANTS[index].key, *one) for index, one in zip(indices, found))


def score(found: dict[str, str]) -> str:
    """The line of the score, a row of a table in Markdown."""
    same = list(found.values()).count("")
    counts = [len(found), len(found) - same, same]
    return f"| {' | '.join(f'{count:,}' for count in counts)} |"


def main(parts: list[str]) -> int:
    """Tries the mutants whose keys begin so, and prints a line for each file when it is done;
    returns 1 where one is not as listed, or none is tried.
    """
    known, found, failed = equivalent(), dict[str, str](), False
    for file in FILES:
        begins = tuple(part for part in parts if f"{part}.".startswith(f"{file}."))
        keys = [k for k, one in enumerate(MUTANTS) if one.file == file]
        if begins or not parts:
            keys = [k for k in keys if not parts or MUTANTS[k].key.startswith(begins)]
            judged = list(judge_all(keys, follow=True))
            wrong = [key for key, one, _ in judged if (one == "") != (key in known)]
            for key, one, _ in judged:
                if key in wrong:
                    print("listed, but noticed:" if one else "nothing notices", key)
            result = "failed" if wrong or not judged else "passed"
            failed = failed or result == "failed"
            found.update((key, one) for key, one, _ in judged)
            seconds = sum(used for _, _, used in judged)
            print(f"mutants/checker/{file}", f"{seconds:.0f}", result, sep="\t", flush=True)
    print(score(found))
    return int(failed or not found)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
