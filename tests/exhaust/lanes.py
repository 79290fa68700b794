"""Stages, run two at a time, each in a process of its own, with the CPU seconds that it takes."""

from __future__ import annotations

import math
import os
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from tests.exhaust.record import FAILED, PASSED
from tests.exhaust.stages import FRESH, MUTANTS, Stage

LANES = 2
TOGETHER = 90  # claims that one process searches, which loads what they share once
LOGS = Path("build/exhaust")


class Done(NamedTuple):
    """What became of a stage: its CPU seconds rounded, and `passed` or `failed`."""

    stage: Stage
    seconds: int
    result: str


class Job(NamedTuple):
    """Stages that one process runs: it prints a line for each, its name, CPU seconds and result,
    where they are more than one.
    """

    stages: Sequence[Stage]

    @property
    def command(self) -> list[str]:
        """The command of the one stage; of several, one with the last words of all."""
        first, *others = self.stages
        words = [*first.command, *(other.command[-1] for other in others)]
        return [sys.executable, *words[1:]] if words[0] == "python" else words


def jobs(stages: Sequence[Stage]) -> list[Job]:
    """The stages as jobs: those that load the same are run together, and begin first."""
    claims = [stage for stage in stages if stage.name.startswith(FRESH)]
    mutants = [stage for stage in stages if stage.name.startswith(MUTANTS)]
    parts = math.ceil(len(claims) / TOGETHER)
    together = [mutants, *(claims[part::parts] for part in range(parts))]
    alone = [[stage] for stage in stages if not stage.name.startswith((FRESH, MUTANTS))]
    return [Job(one) for one in (*together, *alone) if one]


def is_told(job: Job) -> bool:
    """Whether the process of a job tells of each stage."""
    return job.stages[0].name.startswith((FRESH, MUTANTS))


class Lanes:
    """Runs jobs side by side in a tree."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.lock = threading.Lock()
        self.running: set[subprocess.Popen[str]] = set()
        self.ended = False
        self.done: queue.SimpleQueue[Done | BaseException | None] = queue.SimpleQueue()

    def run(self, stages: Sequence[Stage]) -> Iterator[Done]:
        """What becomes of each stage, as it is done; ends all when it is closed."""
        left = jobs(stages)
        waiting = len(left)
        pool = ThreadPoolExecutor(LANES)
        try:
            for job in left:
                pool.submit(self.job, job)
            while waiting:
                done = self.done.get()
                if isinstance(done, BaseException):
                    raise done
                waiting -= done is None
                if done is not None:
                    yield done
        finally:
            self.end()
            pool.shutdown(cancel_futures=True)

    def end(self) -> None:
        """Ends what runs, and lets nothing begin."""
        with self.lock:
            self.ended = True
            for process in self.running:
                os.killpg(process.pid, signal.SIGTERM)

    def job(self, job: Job) -> None:
        """Runs a job, and hands on what is done, with None at the end."""
        try:
            for done in self.follow(job):
                self.done.put(done)
            self.done.put(None)
        except BaseException as problem:
            self.done.put(problem)

    def follow(self, job: Job) -> Iterator[Done]:
        """What becomes of the stages of a job; nothing is told of one that was ended."""
        log = self.root / LOGS / f"{job.stages[0].name.replace('/', '-')}.log"
        log.parent.mkdir(parents=True, exist_ok=True)
        with self.lock:
            if self.ended:
                return
            process = subprocess.Popen(
                job.command,
                cwd=self.root,
                env=environment(),
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                start_new_session=True,
            )
            self.running.add(process)
        left = {stage.name: stage for stage in job.stages}
        failed = False
        if process.stdout is None:
            raise ValueError("a process without output")
        with log.open("w", encoding="utf-8") as out, process.stdout as lines:
            for line in lines:
                out.write(line)
                out.flush()
                cells = line.rstrip("\n").split("\t")
                if is_told(job) and len(cells) == 3 and cells[0] in left:
                    failed = failed or cells[2] != PASSED
                    yield Done(left.pop(cells[0]), round(float(cells[1])), cells[2])
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        with self.lock:
            self.running.discard(process)
            if self.ended:
                return
        seconds = round(used.ru_utime + used.ru_stime)
        if is_told(job):
            if process.returncode and not failed and not left:
                raise ValueError(f"{' '.join(job.command[:4])} failed after its last line: {log}")
            yield from (Done(stage, seconds, FAILED) for stage in left.values())
        else:
            yield Done(job.stages[0], seconds, FAILED if process.returncode else PASSED)


def environment() -> dict[str, str]:
    """What a stage is run with: more than the share of the suite, no figures that are kept, and
    bytecode, which many processes share.
    """
    settings = {"JUGGLEPROOF_MUTANTS": "many", "JUGGLEPROOF_CACHE": "off"}
    others = {name: one for name, one in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**others, **settings}
