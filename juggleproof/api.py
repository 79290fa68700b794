"""`juggleproof certify` from Python: judges claims or scripts of SMT-LIB, in this process or by any
executor.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Union

from juggleproof.judging import limits
from juggleproof.judging.claims import Claim
from juggleproof.judging.run import Options, claims_of_file, run
from juggleproof.smtlib.answering import answer_files, in_script
from juggleproof.statements.language import ClaimError
from juggleproof.statements.nodes import Certificate

What = Union[str, Path, Sequence[Claim]]


@dataclass(frozen=True)
class Result:
    """The answer to a claim (its verdict) or to a problem (sat, unsat or unknown).

    `statements` gives the text of every statement by its name, and `certificates` its certificate,
    after the checker has read it; `model` is an exact point of a problem, in the script's own
    symbols, where an irrational value is a term in `numbers`.
    """

    name: str
    answer: str
    statements: Mapping[str, str]
    certificates: Mapping[str, Certificate]
    model: Mapping[str, str]
    numbers: tuple[str, ...] = ()


def certify(
    what: What,
    executor: Executor | None = None,
    budget: int = 0,
    store: Path | None = None,
    routes: Sequence[str] = ("exact",),
) -> list[Result]:
    """Judges every claim of a file FILE.py or of a sequence of claims, or every check-sat of a
    script FILE.smt2, in order.

    `executor` is any `concurrent.futures.Executor`, such as `ProcessPoolExecutor(8)` or Dask's
    `Client.get_executor()`; the results do not depend on it, and only text and plain data are sent
    to it.  `budget` is counted work for each statement, 0 for the default.  Statements and
    certificates are kept in `store`; without one, beside a file, but nowhere for a sequence of
    claims.  `routes` are those of `certify --routes`, for claims.

    Raises ClaimError, one line, where the input cannot be read or stated.

    >>> from juggleproof import always, claim, reals
    >>> from juggleproof.judging.claims import claims_of
    >>> x, = reals("x")
    >>> def load():
    ...     @claim("square")
    ...     def squares_are_not_negative():
    ...         '''No square is negative.'''
    ...         return always(x**2 >= 0)
    >>> [(one.name, one.answer) for one in certify(claims_of(load))]
    [('square', 'holds')]
    """
    if isinstance(what, (str, Path)):
        path = Path(what)
        if path.suffix == ".smt2":
            return _problems(path, executor, budget, store)
        folder = store or path.with_suffix(".certificates")
        return _claims(claims_of_file(path), executor, budget, folder, routes)
    claims = list(what)
    if not claims or not all(isinstance(one, Claim) for one in claims):
        raise ClaimError(
            f"{what!r}: neither a path nor claims; give FILE.py, FILE.smt2 or what `claims_of`"
            " returns"
        )
    with tempfile.TemporaryDirectory() as kept:
        return _claims(claims, executor, budget, store or Path(kept), routes)


def _problems(
    path: Path, executor: Executor | None, budget: int, store: Path | None
) -> list[Result]:
    results = []
    for one in answer_files(
        [path], budget=budget or limits.DEFAULT_BUDGET, store=store, executor=executor
    ):
        if one.rejected:
            raise ClaimError(f"{one.answer.name}: rejected by the checker: {one.rejected}")
        model = dict(in_script(one.answer, one.problem)) if one.answer.word == "sat" else {}
        results.append(
            Result(
                one.name,
                one.answer.word,
                {one.answer.name: one.answer.text},
                {one.answer.name: one.answer.certificate},
                model,
                one.answer.numbers,
            )
        )
    return results


def _claims(
    claims: Sequence[Claim],
    executor: Executor | None,
    budget: int,
    store: Path,
    routes: Sequence[str],
) -> list[Result]:
    options = Options(store, tuple(routes), budget or limits.DEFAULT_BUDGET, jobs=1)
    done = run(claims, options, executor=executor)
    if done.rejected:
        raise ClaimError("{}: rejected by the checker: {}".format(*done.rejected[0]))
    return [
        Result(one.id, one.verdict.word, dict(one.statements), one.certificates, {})
        for one in done.judgements
    ]
