"""CPU seconds, and work in processes of its own, which end when they have used up their seconds.

A machine that others use as well delays programs, so nothing here is measured by the clock on the
wall; the clock only ends programs that stand still.
"""

from __future__ import annotations

import os
import resource
import signal
import subprocess
from collections.abc import Callable, Iterator, Sequence
from math import inf
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Generic, NamedTuple, TypeVar

GRACE = 2.0  # seconds that a process has to end its own children
STALLED = 60  # seconds of the clock for each CPU second allowed, after which a program stands still
UNCOUNTED = 600  # CPU seconds for what is written before the work begins

Item = TypeVar("Item")
Answer = TypeVar("Answer")


def cpu_seconds() -> float:
    """CPU seconds, of user and system, of this process and of those that it has waited for.

    This does not use `time.process_time`, which counts in ticks of some milliseconds as soon as CPU
    seconds are limited.
    """
    return _used(resource.RUSAGE_SELF) + children_seconds()


def children_seconds() -> float:
    """CPU seconds, of user and system, of the processes that this one has waited for, and of those
    that they have waited for.
    """
    return _used(resource.RUSAGE_CHILDREN)


def _used(who: int) -> float:
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def allow(seconds: float) -> None:
    """Lets this process, with those that it waits for, use this many CPU seconds from now on, up to
    one more; then the system sends it SIGXCPU.
    """
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (int(cpu_seconds() + seconds) + 1, hard))


def left() -> float:
    """The CPU seconds that this process, with those that it waits for, may still use."""
    soft, _ = resource.getrlimit(resource.RLIMIT_CPU)
    return inf if soft == resource.RLIM_INFINITY else soft - cpu_seconds()


def output_of(command: Sequence[str], text: str, seconds: float = inf) -> str | None:
    """The output of the program when it reads the text; None if it uses up its CPU seconds or all
    that are left, or stands still.
    """
    seconds = min(seconds, left(), UNCOUNTED)
    if seconds <= 0:
        return None
    process = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: allow(seconds),
    )
    try:
        output = process.communicate(text, timeout=STALLED * (seconds + 1))[0]
    except subprocess.TimeoutExpired:
        return None
    finally:
        kill_with_children(process)
    return None if process.returncode == -signal.SIGXCPU else output


# -------------------------------------------------------------------------------------------------
# One warm process for many pieces of work; if one piece uses up its seconds, another process goes
# on with the next.


class TimedProcess(NamedTuple, Generic[Answer]):
    """The answer to one piece of work, None if it used up its CPU seconds; and those it took."""

    answer: Answer | None
    seconds: float


def each(
    start: Callable[[], Callable[[Item], Callable[[], Answer]]],
    items: Sequence[Item],
    seconds: float,
) -> Iterator[TimedProcess[Answer]]:
    """The answers to all items in order.

    `start` is called in the warm process and loads what it needs; it returns the function that
    turns an item into the work that is timed.  Raises ChildProcessError if the work raises.
    """
    fork, done = get_context("fork"), 0
    while done < len(items):
        receiver, sender = fork.Pipe(duplex=False)
        before = children_seconds()
        process = fork.Process(target=_work, args=(start, items[done:], seconds, sender))
        process.start()
        sender.close()
        last = began = 0.0  # in its CPU seconds: the end of its last answer, the beginning of this
        try:
            while done < len(items) and receiver.poll(STALLED * seconds):
                kind, at, answer = receiver.recv()
                if kind == "began":
                    began = at
                    continue
                done += 1
                yield TimedProcess(answer, at - began)
                last = at
        except EOFError:
            pass
        finally:
            if done < len(items):
                process.kill()  # it has ended, or stands still
            process.join()
            receiver.close()
        if done < len(items):
            if (process.exitcode or 0) > 0:
                raise ChildProcessError("the work raised what is printed above")
            used = children_seconds() - before
            done += 1
            yield TimedProcess(None, used - max(began, last))


def _work(
    start: Callable[[], Callable[[Item], Callable[[], Answer]]],
    items: Sequence[Item],
    seconds: float,
    sender: Connection,
) -> None:
    prepare = start()
    for item in items:
        allow(UNCOUNTED)
        run = prepare(item)
        allow(seconds)
        sender.send(("began", cpu_seconds(), None))
        answer = run()
        sender.send(("ended", cpu_seconds(), answer))


# -------------------------------------------------------------------------------------------------


def kill_with_children(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> None:
    """Kills a process that leads a session, and those that it started in that session; does nothing
    if it has ended.
    """
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def end_with_children(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> None:
    """Asks a process to end, which gives it time to end the processes that it started; kills it if
    it does not end.
    """
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(GRACE)
        except subprocess.TimeoutExpired:
            kill_with_children(process)
    for stream in (process.stdin, process.stdout, process.stderr):
        if stream is not None:
            stream.close()
