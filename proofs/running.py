"""Runs the judgement of many claims over processes, or over any executor; results come in order and
do not depend on who does the work.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context
from typing import Any, TypeVar

from certificates.statements import SharpRange
from certificates.terms import ClaimError
from proofs.claims import Claim, Said, assertions, named_statements
from proofs.judging import Judgement, Options, judge
from proofs.loading import paper_claims

Item = TypeVar("Item")
Result = TypeVar("Result")
_work: tuple[Sequence[Claim], Options] | None = None
_alone = (
    threading.Lock()
)  # the checker counts its work in one place: threads of one process take turns


def start() -> None:
    """A process of our own pool leaves interruptions to the one that started it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    executor: Executor | None,
    done: Callable[[int, Result], None],
) -> list[Result]:
    """The results of the work on every item, in order; here where there is no executor.  `done`
    hears of each as it is ready.

    Raises what the work on the first item in order raised, when the others are finished.
    """
    results: dict[int, Result] = {}
    problems: dict[int, ClaimError] = {}
    futures = (
        {executor.submit(work, item): index for index, item in enumerate(items)} if executor else {}
    )
    try:
        for future in as_completed(futures):
            try:
                results[futures[future]] = future.result()
                done(futures[future], results[futures[future]])
            except ClaimError as problem:
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


# ------------------------------------------------------------ claims


@dataclass(frozen=True)
class Sent:
    """A claim as it goes to another process: one of the paper by its name, another by what it
    asserts; with what its judge is told.
    """

    claim: str | Claim
    options: Options


@cache
def _by_name() -> dict[str, Claim]:
    return {claim.id: claim for claim in paper_claims()}


def judge_sent(sent: Sent) -> tuple[Judgement, float]:
    """The judgement on a claim that was sent, and the seconds it took."""
    with _alone:
        began = time.perf_counter()
        judgement = judge(
            _by_name()[sent.claim] if isinstance(sent.claim, str) else sent.claim, sent.options
        )
        return judgement, time.perf_counter() - began


def one_at_a_time(work: Callable[[Item], Result], item: Item) -> Result:
    """The work on an item, while no other thread of this process does any."""
    with _alone:
        return work(item)


def sent(claim: Claim, options: Options) -> Sent:
    """A claim, with what its judge needs of the options, as data that can be pickled."""
    if claim.source.startswith("proofs."):
        return Sent(claim.id, options.only(claim))
    if claim.printed or claim.derived or claim.nearby:
        raise ClaimError(
            f"{claim.id} has a print to be corrected, which only this process can do; certify it"
            " without an executor"
        )
    return Sent(replace(claim, read=Said(claim.body(), claim.where)), options.only(claim))


def judge_all(
    claims: Sequence[Claim],
    options: Options,
    jobs: int,
    progress: Callable[[Claim, Judgement], None],
    executor: Executor | None = None,
) -> tuple[list[Judgement], dict[str, float]]:
    """The judgements on all claims in order, and the seconds that each took; by an executor where
    one is given.

    Raises ClaimError for the first claim in order that cannot be stated.
    """
    seconds: dict[str, float] = {}

    def take(index: int, found: tuple[Judgement, float]) -> None:
        seconds[found[0].id] = found[1]
        progress(claims[index], found[0])

    if executor is not None:
        return [
            judgement
            for judgement, _ in spread(
                judge_sent, [sent(claim, options) for claim in claims], executor, take
            )
        ], seconds
    global _work
    _work = (claims, options)
    everything = range(len(claims))
    if jobs <= 1 or len(claims) == 1:
        return [judgement for judgement, _ in spread(_judge_one, everything, None, take)], seconds
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork"), initializer=start) as pool:
        try:
            return [
                judgement for judgement, _ in spread(_judge_one, everything, pool, take)
            ], seconds
        except ClaimError:
            raise
        except BaseException:
            stop(pool)
            raise


def _judge_one(index: int) -> tuple[Judgement, float]:
    if _work is None:
        raise RuntimeError("a worker started without its claims")
    began = time.perf_counter()
    return judge(_work[0][index], _work[1]), time.perf_counter() - began


def stop(pool: Any) -> None:
    """Ends the processes of a pool of our own at once."""
    for process in list((pool._processes or {}).values()):
        process.kill()
    pool.shutdown(wait=False, cancel_futures=True)


def lemmas(everything: Sequence[Claim], claims: Sequence[Claim]) -> dict[str, str]:
    """The texts of the statements that the selected claims use from other claims."""
    used = {name for claim in claims for name in claim.hints.get("uses", ())}
    texts: dict[str, str] = {}
    for claim in everything:
        if any(name.split("/")[0] == claim.id for name in used):
            for prefix, assertion in assertions(claim.body()):
                for part in named_statements(claim.id, prefix, assertion):
                    if not isinstance(part, SharpRange):
                        texts[part.name] = part.text()
    return {name: texts[name] for name in used if name in texts}
