"""The same statements by our search with its check, and by peers: Z3 alone, cvc5, QEPCAD B and
Coq's nra; absent ones are named.

Run: python benchmarks/peers.py [--every 20] [--seconds 10].  A peer's answer is no certificate;
ours is checked, and that time is counted. Exit 1 where two answers contradict each other, or one of
them what the stored certificate says.
"""

from __future__ import annotations

import argparse
import signal
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks.peer_coq import coq_nra, has_coq
from benchmarks.peer_qepcad import has_qepcad, qepcad
from benchmarks.peer_smt import cvc5, has_cvc5, z3, z3_command
from benchmarks.running import Answer
from certificates import checker
from certificates.search.budget import Budget, Exhausted
from certificates.search.certificate import search_certificate
from certificates.store import DEFAULT, Store

TRIVIAL = "statement peers/start\nforall x\ngiven x > 0\nshow x + 1 > 0"
SAID: dict[str, Answer] = {"certified": "holds", "refuted": "fails"}
NOTES = """\
settled: of the statements that the method can express (no integers for QEPCAD B; neither \
integers nor what is said to exist for nra).
median, total: seconds of those, the limit where nothing was settled in time; start: seconds \
for x > 0 => x + 1 > 0.  Every peer is a
process of its own; our search and check run in this one.  nra proves, but refutes nothing."""


@dataclass
class Method:
    """A way to settle a statement, and what it said: answer and seconds by name."""

    title: str
    settle: Callable[[Any, float], Answer]
    present: bool = True
    package: str = ""
    said: dict[str, tuple[Answer, float]] = field(default_factory=dict)

    def run(self, name: str, statement: Any, seconds: float) -> None:
        """Asks about one statement; an answer that comes too late does not count."""
        began = time.perf_counter()
        answer = self.settle(statement, seconds)
        took = time.perf_counter() - began
        self.said[name] = (
            "unsettled" if took > seconds and answer != "not expressible" else answer,
            took,
        )

    def row(self, start: float) -> str:
        """The method's line in the table."""
        asked = [
            (answer, took) for answer, took in self.said.values() if answer != "not expressible"
        ]
        settled, seconds = (
            [answer for answer, _ in asked if answer != "unsettled"],
            [took for _, took in asked] or [0.0],
        )
        return (
            f"{self.title:26} {len(settled):4}/{len(asked):<4} {settled.count('holds'):6}"
            f" {settled.count('fails'):6} {len(self.said) - len(asked):15}"
            f" {statistics.median(seconds):9.3f} {sum(seconds):9.2f} {start:8.3f}"
        )


def ours(statement: Any, seconds: float) -> Answer:
    """Our search, and the checker's word on what it found; nothing else is believed."""

    def late(*_: object) -> None:
        raise TimeoutError

    held = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        found = search_certificate(statement, {}, Budget(int(seconds * 1_000_000)))
        outcome = checker.check_one(statement, found, {}, {})[0]
    except (Exhausted, TimeoutError):
        return "unsettled"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, held)
    return SAID.get(outcome, "unsettled")


def methods() -> list[Method]:
    """Ours and every peer, present or not."""
    return [
        Method("juggleproof, with its check", ours),
        Method("Z3 alone", z3, z3_command() is not None, "z3 (pip install z3-solver)"),
        Method("cvc5", cvc5, has_cvc5(), "cvc5 (pip install cvc5)"),
        Method("QEPCAD B", qepcad, has_qepcad(), "QEPCAD B (Debian package qepcad)"),
        Method("Coq's nra", coq_nra, has_coq(), "coqc (Debian package coq)"),
    ]


def contradictions(name: str, stored: Any, asked: Sequence[Method]) -> list[str]:
    """One line where the stored certificate and the methods do not all say the same of a
    statement.
    """
    said: dict[str, Answer] = {method.title: method.said[name][0] for method in asked}
    if isinstance(stored, dict):
        said["the stored certificate"] = next(
            (word for key, word in SAID.items() if key in stored), "unsettled"
        )
    if {"holds", "fails"} <= set(said.values()):
        return [
            f"CONTRADICTION about {name}: "
            + "; ".join(f"{title}: {word}" for title, word in said.items())
        ]
    return []


def main() -> int:
    """Runs every method that is present on the sample; prints the table, what contradicts, and what
    is absent.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=20, help="one statement in so many")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="limit for each statement and method"
    )
    options = parser.parse_args()
    store = Store(DEFAULT)
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    names = [name for name, statement in statements.items() if statement.kind == "universal"][
        :: options.every
    ]
    present, wrong = [method for method in methods() if method.present], list[str]()
    print(f"{len(names)} statements, {options.seconds:g} s for each")
    print(
        f"{'method':26} {'settled':>9} {'true':>6} {'false':>6} {'not expressible':>15}"
        f" {'median s':>9} {'total s':>9} {'start s':>8}"
    )
    (trivial,) = checker.read_statements(TRIVIAL).values()
    for method in present:
        method.settle(trivial, options.seconds)  # once before, so that files are in memory
        began = time.perf_counter()
        method.settle(trivial, options.seconds)
        start = time.perf_counter() - began
        for name in names:
            method.run(name, statements[name], options.seconds)
        print(method.row(start), flush=True)
    for name in names:
        wrong += contradictions(name, store.certificate(name, store.texts[name]), present)
    print(NOTES)
    for method in present:
        left = [name for name, (answer, _) in method.said.items() if answer == "unsettled"]
        print(f"unsettled by {method.title}: {', '.join(left) or 'none'}")
    print(
        "absent: "
        + (", ".join(method.package for method in methods() if not method.present) or "none")
    )
    print("\n".join(wrong) or "no two answers contradict each other")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
