"""A mutation test of the checker: every mutant has to change what becomes of a case of the tests
beside this file, or of a stored certificate; those that cannot are in `equivalent.txt`.

    python -m tests.certificates.checker.mutate [PART OF A KEY ..]
"""

from __future__ import annotations

import ast
import contextlib
import io
import os
import resource
import signal
import subprocess
import sys
import tempfile
import types
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.store import DEFAULT
from tests.certificates.checker import (
    test_definitions,
    test_files,
    test_limits,
    test_map_rules,
    test_rules,
    test_work,
)
from tests.certificates.checker.mutants import FILES, Mutant, mutants, parsed

PACKAGE = checker.__name__
MODULES = {name: import_module(f"{PACKAGE}.{name}") for name in FILES}
TABLES = (test_rules, test_files, test_map_rules, test_definitions, test_work, test_limits)
SECONDS = 3  # of CPU for one case
MEMORY = 3 << 30
LIMIT = checker.MAX_WORK // 20  # of work, for a case
LONG = 300_000  # calls, after which a case is not followed further
ELSEWHERE = ("compiled_code", "module_beside")  # what Python loads: no text of the checker


class InProcess(dict[str, str]):
    """The outcomes of hostile sizes, each when it is asked for."""

    def __missing__(self, name: str) -> str:
        text, certificate = test_limits.CASES[name]
        *known, (_, statement) = checker.read_statements(text).items()
        work = checker.Work(LIMIT)
        return " ".join(
            map(str, checker.check_one(statement, certificate, dict(known), {}, work))
        )


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """The checker's command in this process."""
    with (
        contextlib.redirect_stdout(io.StringIO()) as out,
        contextlib.redirect_stderr(io.StringIO()) as err,
    ):
        code = checker.main([*map(str, arguments)])
    return subprocess.CompletedProcess([], code, out.getvalue(), err.getvalue())


@dataclass(frozen=True)
class Test:
    """One case: a test function of a table with arguments."""

    name: str
    function: Callable[..., object]
    arguments: dict[str, Any]

    def holds(self) -> bool:
        checker.Work.__init__.__defaults__ = (LIMIT,)
        names = self.function.__code__.co_varnames[: self.function.__code__.co_argcount]
        arguments = dict(self.arguments)
        with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
            fixtures = {"tmp_path": Path(folder), "monkeypatch": patch, "outcomes": InProcess()}
            arguments |= {name: value for name, value in fixtures.items() if name in names}
            try:
                self.function(**arguments)
            except (Exception, pytest.fail.Exception):
                return False
            finally:
                checker.Work.__init__.__defaults__ = (checker.MAX_WORK,)
        return True


def tests() -> Iterator[Test]:
    """The cases of all tables; those with random values are no tables."""
    test_files.run = run
    for module in TABLES:
        for name, function in vars(module).items():
            random = hasattr(function, "hypothesis")
            if name.startswith("test_") and not random and not any(x in name for x in ELSEWHERE):
                marks = [m for m in getattr(function, "pytestmark", ()) if m.name == "parametrize"]
                rows: list[dict[str, Any]] = [{}]
                for mark in marks:
                    keys, values = mark.args[:2]
                    keys = [key.strip() for key in keys.split(",")] if isinstance(keys, str) else keys
                    values = [getattr(one, "values", (one,)) if hasattr(one, "marks") or len(keys) == 1 else one for one in values]
                    rows = [row | dict(zip(keys, one)) for row in rows for one in values]
                for k, row in enumerate(rows):
                    yield Test(f"{module.__name__.rsplit('.')[-1]}.{name}[{k}]", function, row)


FAST = "FAST" in os.environ
SLOW = ("test_limits", "too_large", "one_meter", "missing_or_left", "at_once", "an_entry_that", "[311]", "[312]", "[313]", "[314]")


class Long(BaseException):
    pass


def reached(test: Test) -> tuple[int, set[tuple[str, str]]]:
    """(number of calls, functions of the checker that are called)."""
    calls = 0
    found: set[tuple[str, str]] = set()

    def follow(frame: types.FrameType, event: str, _: object) -> None:
        nonlocal calls
        if event == "call":
            calls += 1
            code = frame.f_code
            if "/checker/" in code.co_filename and "/tests/" not in code.co_filename:
                name = code.co_qualname.split(".<")[0]
                found.add((Path(code.co_filename).stem, name))
            if calls > LONG:
                raise Long

    MODULES["text"].tree.cache_clear()
    sys.setprofile(follow)
    try:
        test.holds()
    except Long:
        pass
    finally:
        sys.setprofile(None)
    return calls, found


@cache
def plan() -> list[tuple[Test, set[tuple[str, str]]]]:
    """The cases, the short ones first, with what they reach."""
    rows = []
    for test in tests():
        if not test.holds():  # also: what the search has found is kept from here on
            raise ValueError(f"{test.name} fails without a mutant")
        rows.append((*reached(test), test))
    if "-v" in sys.argv:
        for row in sorted(rows, key=lambda row: row[0])[-40:]:
            print(row[0], row[2].name)
    rows.sort(key=lambda row: row[0])
    return [(test, found) for _, found, test in rows]


@cache
def outcomes() -> dict[str, str]:
    return {name: outcome for name, outcome, _ in checker.check_folder(str(DEFAULT))}


class Changed(BaseException):
    pass


def store_changes() -> bool:
    """Whether a stored certificate has another fate."""

    def check(statement: checker.Statement, *rest: Any) -> Any:
        found = checker.check_one(statement, *rest)
        if found[0] != outcomes()[statement.name]:
            raise Changed
        return found

    try:
        return {name: one for name, one, _ in checker.check_folder(str(DEFAULT), check)} != outcomes()
    except (Changed, Exception):
        return True


TREES = parsed()
ALL = mutants(TREES)


def install(mutant: Mutant) -> None:
    """Puts the mutant's functions and tables in place of the checker's, in this process."""
    setattr(mutant.parent, mutant.field, mutant.new)
    tree = ast.fix_missing_locations(TREES[mutant.file])
    module = MODULES[mutant.file]
    scratch = types.ModuleType(module.__name__)
    scratch.__package__ = PACKAGE
    scratch.__file__ = module.__file__
    sys.modules[module.__name__] = scratch
    exec(compile(tree, str(module.__file__), "exec"), scratch.__dict__)
    sys.modules[module.__name__] = module
    for name, new in list(vars(scratch).items()):
        old = vars(module).get(name)
        if getattr(new, "__module__", "") == module.__name__:
            transplant(old, new)
        elif not name.startswith("__") and not mutant.function:
            for one in MODULES.values():
                if name in vars(one) and name in assigned(mutant):
                    setattr(one, name, new)
    MODULES["text"].tree.cache_clear()


def assigned(mutant: Mutant) -> set[str]:
    """The names of the line of a module that the mutant changes."""
    return {
        name.id
        for line in TREES[mutant.file].body
        if isinstance(line, (ast.Assign, ast.AnnAssign))
        and line.lineno <= mutant.line <= (line.end_lineno or 0)
        for name in ast.walk(line)
        if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
    }


def transplant(old: Any, new: Any) -> None:
    old, new = (getattr(one, "__wrapped__", one) for one in (old, new))
    if isinstance(new, types.FunctionType):
        old.__code__ = new.__code__
        old.__defaults__ = new.__defaults__
        old.__kwdefaults__ = new.__kwdefaults__
    elif isinstance(new, type) and new.__name__ != "Kind":
        for name, value in vars(new).items():
            if isinstance(value, types.FunctionType):
                transplant(vars(old)[name], value)


def noticed(mutant: Mutant) -> str:
    """By which case, or "the store"; "" where nothing changes."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.alarm(300)
    try:
        install(mutant)
    except Exception as error:
        return f"loading: {error!r}"
    for test, found in plan():
        if FAST and any(x in test.name for x in SLOW):
            continue
        if not mutant.function or (mutant.file, mutant.function) in found:
            signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
            if not test.holds():
                return test.name
    if FAST:
        return ""
    signal.setitimer(signal.ITIMER_VIRTUAL, 3 * SECONDS)
    return "the store" if store_changes() else ""


def judged(index: int) -> str:
    """The same, in a process of its own, which may not end."""
    end, begin = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(end)
            with open(os.devnull, "w") as nothing, contextlib.redirect_stdout(nothing):
                found = noticed(ALL[index])
            os.write(begin, (found or "-").encode())
        finally:
            os._exit(0)
    os.close(begin)
    with open(end, "rb") as pipe:
        answer = pipe.read().decode()
    os.waitpid(child, 0)
    return answer.removeprefix("-") if answer else "no end"


def main(parts: list[str]) -> None:
    chosen = [k for k, one in enumerate(ALL) if not parts or any(p in one.key for p in parts)]
    if "-v" in parts:
        for test, found in plan():
            print(test.name, len(found))
        return
    plan(), outcomes()
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("fork")) as pool:
        for k, found in zip(chosen, pool.map(judged, chosen, chunksize=1)):
            print(f"{ALL[k].line}\t{ALL[k].key}\t{found}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
