"""The same work on many items: in this process, in a pool of processes, or by an executor."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from typing import TypeVar

from juggleproof.statements.language import ClaimError

Item = TypeVar("Item")
Result = TypeVar("Result")
alone = (
    threading.Lock()
)  # the checker's count of work is global in a process, so threads take turns


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    executor: Executor | None,
    done: Callable[[int, Result], None],
) -> list[Result]:
    """The results of the work on every item, in order; without an executor the work is done in this
    process.  `done` is called with the index and the result of each item as it is ready.

    If the work of an executor fails on some items, the exception of the first is raised at the end.
    """
    results: dict[int, Result] = {}
    problems: dict[int, Exception] = {}
    futures = (
        {executor.submit(work, item): index for index, item in enumerate(items)} if executor else {}
    )
    try:
        for future in as_completed(futures):
            try:
                results[futures[future]] = future.result()
                done(futures[future], results[futures[future]])
            except Exception as problem:
                problems[futures[future]] = problem
        for index, item in enumerate(items if executor is None else ()):
            results[index] = work(item)
            done(index, results[index])
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    if problems:
        raise problems[min(problems)]
    return [results[index] for index in range(len(items))]


def one_at_a_time(work: Callable[[Item], Result], item: Item) -> Result:
    """The result of the work on an item; threads of this process take turns."""
    with alone:
        return work(item)


def stop(pool: ProcessPoolExecutor) -> None:
    """Kills the processes of a pool."""
    for process in list((pool._processes or {}).values()):
        process.kill()
    pool.shutdown(wait=False, cancel_futures=True)


@contextmanager
def own_pool(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of `jobs` processes, which are killed where the work is interrupted."""
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork"), initializer=as_child) as pool:
        try:
            yield pool
        except ClaimError:
            raise
        except BaseException:
            stop(pool)
            raise


def as_child() -> None:
    """Makes a worker ignore interruptions, which its parent handles, and end with its parent.

    A killed parent sends no signal, so a thread asks every second whether it is still there.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_after, args=(parent.pid,), daemon=True).start()


def _end_after(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(1)
    os._exit(1)
