"""Stages, run two at a time, each in a process of its own, with the CPU seconds that it takes."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import NamedTuple

from tests.exhaust.record import FAILED, PASSED
from tests.exhaust.stages import FRESH, Stage

LANES = 2
TOGETHER = 90  # claims that one process searches, which loads what they share once
LOGS = Path("build/exhaust")


class Done(NamedTuple):
    """What became of a stage: its CPU seconds rounded up, and `passed` or `failed`."""

    stage: Stage
    seconds: int
    result: str


class Job(NamedTuple):
    """Stages that one process runs."""

    stages: Sequence[Stage]

    @property
    def command(self) -> list[str]:
        """The command of the one stage; of claims, one command with all their names."""
        first, *others = self.stages
        words = [*first.command, *(other.command[-1] for other in others)]
        return [sys.executable, *words[1:]] if words[0] == "python" else words


def jobs(stages: Sequence[Stage]) -> list[Job]:
    """The stages as jobs, those that take long in one process first; claims together."""
    claims = [stage for stage in stages if stage.name.startswith(FRESH)]
    parts = math.ceil(len(claims) / TOGETHER)
    together = [Job(claims[part::parts]) for part in range(parts)]
    return [*together, *(Job([stage]) for stage in stages if stage not in claims)]


class Lanes:
    """Runs jobs side by side in a tree."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.lock = threading.Lock()
        self.running: set[subprocess.Popen[bytes]] = set()
        self.ended = False

    def run(self, stages: Sequence[Stage]) -> Iterator[Done]:
        """What becomes of each stage, as it is done; stops all when it is closed."""
        pool = ThreadPoolExecutor(LANES)
        try:
            left: set[Future[list[Done]]] = {pool.submit(self.job, job) for job in jobs(stages)}
            while left:
                done, left = wait(left, return_when=FIRST_COMPLETED)
                for one in done:
                    yield from one.result()
        finally:
            self.end()
            pool.shutdown(cancel_futures=True)

    def end(self) -> None:
        """Ends what runs, and lets nothing begin."""
        with self.lock:
            self.ended = True
            for process in self.running:
                process.terminate()

    def job(self, job: Job) -> list[Done]:
        """Runs a job; nothing is told of one that was ended."""
        log = self.root / LOGS / f"{job.stages[0].name.replace('/', '-')}.log"
        log.parent.mkdir(parents=True, exist_ok=True)
        with log.open("wb") as out:
            with self.lock:
                if self.ended:
                    return []
                process = subprocess.Popen(
                    job.command, cwd=self.root, env=environment(), stdout=out, stderr=out
                )
                self.running.add(process)
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        with self.lock:
            self.running.discard(process)
            if self.ended:
                return []
        text = log.read_text(encoding="utf-8", errors="replace")
        seconds = used.ru_utime + used.ru_stime
        return results(job.stages, process.returncode, seconds, text)


def environment() -> dict[str, str]:
    """What a stage is run with: more than the share of the suite, and no figures that are kept."""
    return {**os.environ, "JUGGLEPROOF_MUTANTS": "many", "JUGGLEPROOF_CACHE": "off"}


def results(stages: Sequence[Stage], code: int, seconds: float, text: str) -> list[Done]:
    """What a process that ended with a code and printed a text says of its stages.

    Claims pass by the line that each has; one without fails.  Where all that are told of passed,
    but the process failed, all fail.
    """
    if not stages[0].name.startswith(FRESH):
        return [Done(stages[0], math.ceil(seconds), FAILED if code else PASSED)]
    told = {}
    for line in text.splitlines():
        cells = line.split("\t")
        if len(cells) == 4 and cells[2] in (PASSED, FAILED):
            told[FRESH + cells[0]] = math.ceil(float(cells[1])), cells[2]
    failed = any(result == FAILED for _, result in told.values())
    if bool(code) != failed:
        told = {}
    return [Done(stage, *told.get(stage.name, (math.ceil(seconds), FAILED))) for stage in stages]
