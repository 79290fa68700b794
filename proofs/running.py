"""Runs the judgement of many claims over processes; results come in the paper's order and do not depend on the number of processes."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context

from certificates.statements import SharpRange
from certificates.terms import ClaimError
from proofs.claims import Claim, assertions, named_statements
from proofs.judging import Judgement, Options, judge

_work: tuple[Sequence[Claim], Options] | None = None


def _start() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _judge_one(index: int) -> tuple[int, Judgement, float]:
    if _work is None:
        raise RuntimeError("a worker started without its claims")
    began = time.perf_counter()
    return index, judge(_work[0][index], _work[1]), time.perf_counter() - began


def judge_all(
    claims: Sequence[Claim], options: Options, jobs: int, progress: Callable[[Claim, Judgement], None],
) -> tuple[list[Judgement], dict[str, float]]:
    """The judgements on all claims in order, and the seconds that each took.

    Raises ClaimError for the first claim in order that cannot be stated.
    """
    global _work
    _work = (claims, options)
    results: dict[int, Judgement] = {}
    seconds: dict[str, float] = {}
    problems: dict[int, ClaimError] = {}

    def take(index: int, judgement: Judgement, took: float) -> None:
        results[index], seconds[judgement.id] = judgement, took
        progress(claims[index], judgement)

    if jobs <= 1 or len(claims) == 1:
        for index in range(len(claims)):
            take(*_judge_one(index))
        return [results[i] for i in range(len(claims))], seconds
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork"), initializer=_start) as pool:
        try:
            futures = {pool.submit(_judge_one, index): index for index in range(len(claims))}
            for future in as_completed(futures):
                try:
                    take(*future.result())
                except ClaimError as problem:
                    problems[futures[future]] = problem
        except BaseException:
            for process in list((pool._processes or {}).values()):
                process.kill()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    if problems:
        raise problems[min(problems)]
    return [results[i] for i in range(len(claims))], seconds


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
