"""The same work on many items: here, over processes of our own, or by an executor that is given."""

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
)  # the checker counts its work in one place: threads of one process take turns


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    executor: Executor | None,
    done: Callable[[int, Result], None],
) -> list[Result]:
    """The results of the work on every item, in order; here where there is no executor.  `done`
    is called with each as it is ready.

    Raises what the work on the first item in order raised, when the others are finished.
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
    """The work on an item, while no other thread of this process does any."""
    with alone:
        return work(item)


def stop(pool: ProcessPoolExecutor) -> None:
    """Ends the processes of a pool of our own at once."""
    for process in list((pool._processes or {}).values()):
        process.kill()
    pool.shutdown(wait=False, cancel_futures=True)


@contextmanager
def own_pool(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """So many processes of our own; they end at once where the work on them is broken off."""
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork"), initializer=as_child) as pool:
        try:
            yield pool
        except ClaimError:
            raise
        except BaseException:
            stop(pool)
            raise


def as_child() -> None:
    """A process of our own leaves interruptions to the one that started it, and ends with it,
    however that one ends: its killing cannot be heard, so its absence is looked for.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_after, args=(parent.pid,), daemon=True).start()


def _end_after(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(1)
    os._exit(1)
