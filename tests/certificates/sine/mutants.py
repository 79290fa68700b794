"""Mutants of the second checker, from `mutants.txt`: one formula or guard changed in its text; and
what notices them.

    python -m tests.certificates.sine.mutants [BEGINNING OF A FILE'S NAME ..]

Exit 1 where nothing notices a mutant.
"""

from __future__ import annotations

import os
import sys
import types
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from flint import arb

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine import cells, checker, flights
from tests.certificates.sine import bounds, states, worlds
from tests.certificates.sine.lines import ACCEPTED, REJECTED, line, refuting
from tests.certificates.sine.states import STEPS, Code, box

FILES = {"flights": flights, "cells": cells, "checker": checker}
TEXTS = {name: Path(str(one.__file__)).read_text() for name, one in FILES.items()}


class Mutant(NamedTuple):
    """`new` in place of the one `old` in the text of a file."""

    file: str
    name: str
    old: str
    new: str


def read() -> list[Mutant]:
    """All of the mutants, in their order."""
    found = []
    for block in Path(__file__).with_suffix(".txt").read_text().rstrip("\n").split("\n\n"):
        if block.startswith("# "):
            continue
        head, old, new = block.split("\n")
        file, name = head.split(": ")
        found.append(Mutant(file, name, *(one[2:].replace("\\n", "\n") for one in (old, new))))
    return found


def compiled(file: str, text: str) -> dict[str, Any]:
    other = types.ModuleType(FILES[file].__name__)
    other.__package__ = FILES[file].__package__
    exec(compile(text, f"{file}.py", "exec"), vars(other))
    return vars(other)


def text_of(mutant: Mutant) -> str:
    """The text of its file with the mutant in it."""
    times = TEXTS[mutant.file].count(mutant.old)
    if times != 1:
        raise ValueError(f"{mutant.name}: {mutant.old!r} stands {times} times")
    return TEXTS[mutant.file].replace(mutant.old, mutant.new)


def mutated(mutant: Mutant) -> Code:
    """The second checker with a mutant in it; the one that is imported stays as it is."""
    texts = TEXTS | {mutant.file: text_of(mutant)}
    made: list[dict[str, Any]] = []
    for name in FILES:  # each takes from the mutants of those before it what it imports from them
        made.append(compiled(name, texts[name]))
        for before, one in zip(FILES.values(), made[:-1]):
            taken = {name for name, value in vars(before).items() if made[-1].get(name) is value}
            made[-1].update({name: one[name] for name in taken if name[0] != "_"})
    return Code(*(types.SimpleNamespace(**one) for one in made))


# ------------------------------------------------------------ what notices a mutant

Test = Callable[[Code], object]  # true where the code is right


def rejects(make: Callable[[], str], why: str) -> Test:
    def test(code: Code) -> bool:
        proves, reason = code.checker.check_line(make())
        return proves is None and reason.startswith(why)

    return test


def accepts(make: Callable[[], str]) -> Test:
    return lambda code: code.checker.check_line(make())[0]


NO_STATEMENTS = (
    "alpha in [1/20, 1/21] and g in [1/5, 1/5]",
    "alpha in [1/20, 1] and g in [1/5, 1/5]",
    "alpha in [1/20, 1/20] and g in [1/5, 1/6]",
    "alpha in [1/20, 1/20] and g in [0, 1/5]",
    "alpha in [1/20, 1/20] and drive in [1, 2]",
    "alpha in [0.05, 0.05] and Gamma in [3, 3]",
    "alpha in [-1/20, 1/20] and Gamma in [3, 3]",
    "alpha in [1/20, 1/20] and Gamma in [3, 3] or so",
)


def in_order(code: Code) -> bool:
    """Small things of their own: what a test of its own name says beside this file."""
    why = worlds.reason
    statements = [f"{worlds.BEGINS} {one}" for one in NO_STATEMENTS]
    read = [why(code, code.checker.read_statement, one) for one in statements]
    long = code.flights.Flights(box("1/2", "1/5", 16, 1, 64), Work(STEPS))
    short = code.flights.Flights(box("1/2", "1/5", 64, 1024, 8), Work(STEPS))
    poor = code.flights.Flights(box("1/20", "197/1000", 64, 16, 22), Work(2 * 64 + 10))
    columns = [why(code, list, short.column(i, range(8))) for i in range(64)]
    square = code.flights.sines(64)
    low = code.checker.Rectangle("", *worlds.BELOW_BIRTH)
    birth = why(code, code.checker.check_cover, low, [], Work(STEPS))
    return (
        all(read)
        and why(code, code.flights.Walk(long, 0).landings, 63, 0) == "a flight without an end"
        and "a cell without a landing" in columns
        and bool(why(code, list, poor.column(0, range(22))))
        and all(abs((arb(2 * j) / 64).sin_pi() * states.UNIT - square[j]) < 1 for j in range(64))
        and bool(arb(code.flights.PI2) < 2 * arb.pi() * states.UNIT)
        and code.flights.SLACK >= 200
        and birth.startswith("Gamma is below the birth of the bounce")
    )


def work_is_bounded(code: Code) -> bool:
    """All cells that are read count; lines and statements share what a folder may spend."""
    levels = Work(STEPS)
    there = code.cells.read_levels(code.checker.read_line(line("cut")), levels)
    cells_read = sum(len(level.ranks) * level.grid.rows for level in there)
    whole = Work(STEPS)
    code.checker.check_line(line(), whole)
    spent = STEPS - whole.left
    tables, rows = Work(STEPS), Work(STEPS)
    wide = code.flights.Grid(
        (Fraction(), Fraction(9, 10)), (Fraction(1, 10), Fraction(1)), 16, 1024, 8192
    )
    lands = code.flights.Walk(code.flights.Flights(wide, rows), 3).landings(10, 3)
    code.flights.Flights(wide, tables)
    lines, looked = len({m for m, _, _ in lands}), sum(top - low for _, low, top in lands) // 64

    def found(lines: list[str], left: int, greatest: str = "197/1000") -> list[str]:
        statement = f"{worlds.BEGINS} alpha in [1/20, 1/20] and g in [197/1000, {greatest}]\n"
        with TemporaryDirectory() as folder:
            Path(folder, "statements.txt").write_text(statement)
            Path(folder, "certificates.jsonl").write_text("".join(f"{one}\n" for one in lines))
            results = code.checker.check_folder(folder, left)
        return [f"{word} {why}".rstrip() for _, word, why in results]

    unstable = refuting("multiplier", "1/20", "290/1000", 16, 16)
    cost = 10 + len(unstable) // 4 + 20
    return (
        STEPS - levels.left == cells_read
        and STEPS - tables.left == 2 * 16
        and tables.left - rows.left >= lines + looked > lines > 0
        and code.checker.check_line(unstable, Work(cost - 20))[0] is not None
        and code.checker.check_line(unstable, Work(cost - 21)) == (None, "too much work")
        and len(found(["{}"] * 2000, STEPS)) == 1002
        and found([line()], spent + 1000) == ["certified"]
        and found([line()], spent + 5) == ["unknown too much work"]
        and found([line()] * 2, spent + 1000) == ["rejected too much work", "unknown too much work"]
        and found([unstable], cost, "290/1000") == ["refuted"]
        and found([unstable], cost - 1, "290/1000") == ["unknown too much work"]
    )


def tests_of_rules() -> Iterator[Test]:
    for _, make, why in REJECTED:
        yield rejects(make, why)
    for world in worlds.WORLDS:
        yield lambda code, world=world: worlds.seen(code, world) == world.reason
    for _, rectangle, rows, why in worlds.COVERS:
        yield lambda code, all=(rectangle, rows, why): worlds.covered(code, *all[:2]) == all[2]
    for _, text, expected in worlds.MEETS:
        yield lambda code, both=(text, expected): worlds.refuted(code, both[0]) == both[1]
    yield lambda code: not worlds.wrong_shares(code)
    yield worlds.basins_in_order
    yield lambda code: not worlds.wrong_strips(code)
    yield lambda code: not worlds.wrong_drives(code, 30, seed=1)
    yield lambda code: not worlds.wrong_traps(code, 20, seed=1)[1]
    yield in_order
    yield work_is_bounded
    for _, make in ACCEPTED:
        yield accepts(make)


def tests_of_flights() -> Iterator[Test]:
    for grid in bounds.GRIDS:
        yield lambda code, grid=grid: not bounds.broken_bounds(code, grid, 40, seed=3)
    yield lambda code: not bounds.missed_zeros(code, 300, seed=3)[1]
    for grid in states.GRIDS:
        yield lambda code, grid=grid: not states.escapes(code, grid, 60, seed=6)[1]


def noticed(mutant: Mutant) -> bool:
    """Whether any test says that the mutant is wrong, or it ends in an error."""
    tests = [*tests_of_rules()]
    if mutant.file == "flights":
        tests = [*tests_of_flights(), *tests]
    try:
        code = mutated(mutant)
        return not all(test(code) for test in tests)
    except Exception as error:
        if isinstance(error, ValueError) and "stands" in str(error):
            raise
        return True


def main(parts: list[str]) -> int:
    """Tries the mutants of the files whose names begin so; returns 1 where one is not noticed, or
    none is tried.
    """
    chosen = [one for one in read() if not parts or f"{one.file}.".startswith(tuple(parts))]
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("fork")) as pool:
        found = list(pool.map(noticed, chosen))
    for one, seen in zip(chosen, found):
        if not seen:
            print("nothing notices", one.file, one.name)
    print(f"{len(found)} mutants, {sum(found)} noticed")
    return int(not chosen or not all(found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
