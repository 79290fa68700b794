"""Hostile files: no input hangs the checker, exhausts memory, or ends in a traceback.

    python -m tests.certificates.checker.fuzz COUNT [SEED]

Each file of the accepted cases is changed at random, in its statements, in its certificates or in
both, and checked as a folder, within 2 GB and 20 seconds of CPU.  Prints how many were refused
whole, and how many statements had which outcome; exit 1 at the first fault, with the files.
"""

from __future__ import annotations

import json
import random
import resource
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.certificates.checker import settling
from juggleproof.statements.store import certificate_lines
from tests.certificates.checker.maps import DOUBLE, FLIP, NEST, PUSH, SUBTRACT, searched
from tests.certificates.checker.rules import TABLES

MEMORY, SECONDS = 2 << 30, 20
WORK = 3 * 10**6  # for a folder, so that what is counted ends within seconds
BITS = ("(", ")", "^4000", "^99999", "*", "/", "-", " ", "\n", "\n\n", ",", "0", "1/0", "x", "n")
BITS += ("sqrt(", "root(", "implies(", "iff(", "not ", " and ", " or ", "<", "=", "9" * 5000)
BITS += ("\nstatement a/b\n", "\ndefine f(x) := f(x)\n", "\nexists x\n", "\x00", "\r", "\u2028")
BITS += ("value", "distance", "x_next", " -> ", "\nover\n", "\nradius distance\n")
BITS += ("[" * 3000, "{", "}", "]", '"', "null", "true", "1.5", "1e9", "-1", '"x"', "[]", "[[]]")
MAPS = (SUBTRACT, FLIP, NEST, DOUBLE, PUSH)


def folders() -> list[tuple[str, str]]:
    """The statements and the certificates of every accepted case and map, as files."""
    found = []
    for module in TABLES.values():
        for case in module.ACCEPTED:
            (*_, name) = (
                row.removeprefix("statement ")
                for row in case.text.splitlines()
                if row.startswith("statement ")
            )
            entries = {**case.earlier, name: case.certificate}
            found.append((case.text, certificate_lines(entries).decode()))
    found += [(text, certificate_lines(searched(text)).decode()) for text in MAPS]
    return found


def doubled(text: str, source: random.Random) -> str:
    """A part of the text up to 2,000 times."""
    a, b = sorted(source.randrange(len(text) + 1) for _ in range(2))
    return text[:b] + text[a:b] * min(source.choice((1, 3, 40, 2000)), 10**6 // (1 + b - a))


def cut(text: str, source: random.Random) -> str:
    """The text without a part."""
    a, b = sorted(source.randrange(len(text) + 1) for _ in range(2))
    return text[:a] + text[b:]


def put_in(text: str, source: random.Random) -> str:
    """The text with something else in it."""
    at = source.randrange(len(text) + 1)
    return text[:at] + source.choice(BITS) * source.choice((1, 1, 1, 100)) + text[at:]


def exchanged(text: str, source: random.Random) -> str:
    """The text with a word in the place of another one."""
    words = text.split(" ")
    words[source.randrange(len(words))] = source.choice(words)
    return " ".join(words)


CHANGES: tuple[Callable[[str, random.Random], str], ...] = (doubled, cut, put_in, exchanged)


def hostile(source: random.Random, seeds: list[tuple[str, str]]) -> tuple[str, str]:
    """One pair of files."""
    files = list(source.choice(seeds))
    for _ in range(source.choice((1, 1, 2, 5))):
        place = source.choice((0, 1, 1))
        files[place] = source.choice(CHANGES)(files[place], source)
    return files[0], files[1]


def outcomes(folder: Path, files: tuple[str, str]) -> Counter[str]:
    """How many statements have which outcome, or that the folder is refused."""
    for name, text in zip((checker.STATEMENTS, checker.CERTIFICATES), files):
        (folder / name).write_text(text, encoding="utf-8", newline="")
    try:
        results = checker.check_folder(str(folder))
    except checker.Rejected:
        return Counter({"refused": 1})
    if not {outcome for _, outcome, _ in results} <= {
        "certified",
        "refuted",
        "unknown",
        "rejected",
    }:
        raise ValueError(f"an outcome that is none: {results}")
    return Counter(outcome for _, outcome, _ in results)


def ended(*_: object) -> None:
    raise TimeoutError(f"more than {SECONDS} seconds of CPU")


def main(count: int, seed: int = 0) -> int:
    """Checks so many pairs of files; 0 where there was no fault."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGVTALRM, ended)
    settling.MAX_FOLDER_WORK = WORK
    source, seeds, total = random.Random(seed), folders(), Counter[str]()
    with tempfile.TemporaryDirectory() as name:
        for number in range(count):
            files = hostile(source, seeds)
            signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
            try:
                total += outcomes(Path(name), files)
            except BaseException as fault:
                print(f"file {number} of seed {seed}: {type(fault).__name__}: {fault}")
                print(json.dumps(files))
                return 1
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    print(
        f"{count} pairs of files: " + ", ".join(f"{n} {word}" for word, n in sorted(total.items()))
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
