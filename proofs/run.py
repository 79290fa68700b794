"""Many claims over processes: load, judge, check, store, register."""

from __future__ import annotations

import gc
import hashlib
import importlib.util
import os
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Mapping, Sequence, Set
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from time import perf_counter
from typing import Any, TypeVar

from juggleproof.certificates import checker
from juggleproof.certificates.language import AnyStatement, ClaimError, SharpRange, Statement
from juggleproof.certificates.store import STATEMENTS, Store
from juggleproof.proofs import kept
from juggleproof.proofs.claims import (
    Body,
    Claim,
    Said,
    assertions,
    claims_in,
    claims_of,
    named_statements,
)
from juggleproof.proofs.judging import Judge, Judgement, Options, judge
from juggleproof.proofs.kept import Forgotten, body_of, claim_of, stored_as
from juggleproof.proofs.paper import modules_of_claims

# -------------------------------------------------------------------------------------------------
# The checker's reading of a whole stored folder, in processes of its own while claims are stated;
# every run reads everything.

Results = list[tuple[str, str, str]]


class Reading:
    """What `checker.check_folder` says of a folder: with several jobs by shares, found out
    meanwhile; with one, when it is asked for.

    A folder without statements, one that cannot be read, and `nothing` come to no results.
    """

    def __init__(self, folder: Path, jobs: int, nothing: bool = False) -> None:
        self.folder, self.jobs = folder, jobs
        self.nothing = nothing or not (folder / STATEMENTS).exists()
        self.results: Results = []
        self._processes: list[tuple[Any, Any]] = []

    def __enter__(self) -> Reading:
        if self.jobs > 1 and not self.nothing:
            fork = get_context("fork")
            for share in shares(self.folder, self.jobs):
                receiver, sender = fork.Pipe(duplex=False)
                process = fork.Process(target=_send, args=(self.folder, share, sender), daemon=True)
                process.start()
                sender.close()
                self._processes.append((process, receiver))
        return self

    def __exit__(self, *_: object) -> None:
        for process, _receiver in self._processes:
            process.kill()
            process.join()

    def outcomes(self) -> dict[str, str]:
        """The outcome of every stored statement, by name."""
        if not self.nothing:
            self.results = self._by_shares() or _read(self.folder)
        return {name: outcome for name, outcome, _ in self.results}

    def _by_shares(self) -> Results:
        """The results of all shares, if every outcome that one of them assumed is the one that
        another found; else none.

        Then each statement was checked with the very lemmas that `check_folder` would have given
        it.
        """
        try:
            parts = [receiver.recv() for _process, receiver in self._processes]
        except EOFError:  # a process died
            return []
        true = {name: outcome for _, found, _ in parts for name, outcome in found.items()}
        if not parts or any(
            outcome != true.get(name)
            for _, _, assumed in parts
            for name, outcome in assumed.items()
        ):
            return []
        reasons = {
            (name, outcome): reason
            for results, found, _ in parts
            for name, outcome, reason in results
            if name in found
        }
        return [
            (name, outcome, reasons.get((name, outcome), reason))
            for name, outcome, reason in parts[0][0]
        ]


def results_for(folder: Path, jobs: int) -> Results:
    """What the checker says of a folder: kept from an earlier reading of these very files by this
    very checker, or found out now.
    """
    key = _key(folder)
    records = kept.load(key) if key else []
    try:
        if records:
            return [(str(one["name"]), str(one["outcome"]), str(one["reason"])) for one in records]
    except KeyError:
        pass
    with Reading(folder, jobs) as reading:
        reading.outcomes()
    keep_results(folder, reading.results)
    return reading.results


def keep_results(folder: Path, results: Results) -> None:
    """Keeps what the checker said of the files that are now in the folder."""
    key = _key(folder)
    if key and results:
        kept.keep(
            key,
            [
                {"name": name, "outcome": outcome, "reason": reason}
                for name, outcome, reason in results
            ],
        )


def _key(folder: Path) -> str:
    if kept.folder() is None or not folder.is_dir():
        return ""
    said = hashlib.sha256(sys.version.encode())
    for path in [
        Path(str(checker.__file__)),
        *sorted(
            path for path in folder.iterdir() if path.name == STATEMENTS or path.suffix == ".json"
        ),
    ]:
        content = path.read_bytes()
        said.update(f"\n{path.name} {len(content)}\n".encode())
        said.update(content)
    return "read-" + said.hexdigest()


def shares(folder: Path, count: int) -> list[Set[str]]:
    """The claims of a folder in `count` shares of about the same size on disk."""
    sizes = {
        entry.name.removesuffix(".json"): entry.stat().st_size
        for entry in os.scandir(folder)
        if entry.name.endswith(".json")
    }
    found: list[set[str]] = [set() for _ in range(count)]
    weights = [0] * count
    for claim in sorted(sizes, key=lambda claim: (-sizes[claim], claim)):
        lightest = weights.index(min(weights))
        found[lightest].add(claim)
        weights[lightest] += sizes[claim]
    return [*found]


def check_share(folder: Path, share: Set[str]) -> tuple[Results, dict[str, str], dict[str, str]]:
    """What `check_folder` says where outcomes outside the share are assumed to be what their
    certificates claim; with what was found, and assumed.
    """
    check_one, found, assumed = checker.check_one, dict[str, str](), dict[str, str]()

    def check_own(statement: Any, certificate: Any, known: Any, earlier: Any) -> tuple[str, str]:
        if statement.name.split("/")[0] in share:
            outcome, reason = check_one(statement, certificate, known, earlier)
            found[statement.name] = outcome
            return outcome, reason
        claimed = [
            word
            for word in ("certified", "refuted", "unknown")
            if isinstance(certificate, dict) and word in certificate
        ]
        assumed[statement.name] = claimed[0] if claimed else "rejected"
        return assumed[statement.name], ""

    checker.check_one = check_own
    try:
        return _read(folder), found, assumed
    finally:
        checker.check_one = check_one


def _read(folder: Path) -> Results:
    try:
        results: Results = checker.check_folder(str(folder))
        return results
    except checker.Rejected:
        return []


def _send(folder: Path, share: Set[str], sender: Any) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.disable()  # the checker makes no cycles, and the process ends with its share
    sender.send(check_share(folder, share))


# -------------------------------------------------------------------------------------------------
# Loads claims: the paper's, or those of a user's own file.


def paper_claims() -> list[Claim]:
    """The claims of the paper in its order."""
    return claims_in(modules_of_claims())


def claims_of_file(path: Path) -> list[Claim]:
    """The claims of a Python file.

    Raises ClaimError, one line with file and line, where it does not parse, fails, or holds no
    claim.
    """
    if path.is_dir():
        raise ClaimError(f"{path}: a folder; name a Python file with claims")
    if not path.is_file():
        raise ClaimError(f"{path}: no such file; name a Python file with claims")

    def load() -> None:
        spec = importlib.util.spec_from_file_location(f"claims_of_{path.stem}", path)
        if spec is None or spec.loader is None:
            raise ClaimError(f"{path}: not a Python file; its name must end with .py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        try:
            spec.loader.exec_module(module)
        except ClaimError as problem:
            raise ClaimError(f"{path}:{_line_in(path)}: {problem}") from None
        except SyntaxError as problem:
            raise ClaimError(
                f"{path}:{problem.lineno}: does not parse ({problem.msg}); mend the syntax"
            ) from None
        except (Exception, SystemExit) as problem:
            raise ClaimError(
                f"{path}:{_line_in(path)}: {type(problem).__name__}: {problem}; mend this line"
            ) from None

    claims = claims_of(load)
    if not claims:
        raise ClaimError(f'{path}: no claims; decorate a function with @claim("its-name")')
    return claims


def _line_in(path: Path) -> int:
    """The last line of the file on the stack of the error at hand."""
    frames = traceback.extract_tb(sys.exc_info()[2])
    lines = [frame.lineno for frame in frames if frame.filename == str(path) and frame.lineno]
    return lines[-1] if lines else 1


# -------------------------------------------------------------------------------------------------
# Runs the judgement of many claims over processes, or over any executor; results come in order and
# do not depend on who does the work.

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
    if claim.source.startswith("juggleproof.proofs."):
        return Sent(claim.id, options.only(claim))
    if claim.printed or claim.derived or claim.true_nearby:
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


# -------------------------------------------------------------------------------------------------
# Judges a claim again from its record and the store: nothing is stated, searched or voted on anew;
# where that would be needed, it gives up.

NOT_AS_KEPT = (
    Forgotten,
    KeyError,
    IndexError,
    TypeError,
    ValueError,
    AttributeError,
    RecursionError,
)
Judged = tuple[list[Judgement], dict[str, float]]


class Records:
    """The records of the paper's claims that were kept by an earlier run of the same sources at
    this budget; none without a budget.
    """

    def __init__(self, budget: int | None, read: bool = True) -> None:
        self.budget, self.by_claim, self.claims = (
            budget,
            dict[str, Mapping[str, Any]](),
            list[Claim](),
        )
        self.key = "" if budget is None or kept.folder() is None else kept.key(budget)
        if self.key and read:
            loaded = kept.load(self.key)
            try:
                self.claims = [claim_of(record) for record in loaded]
                self.by_claim = {claim.id: record for claim, record in zip(self.claims, loaded)}
            except NOT_AS_KEPT:
                self.claims = []

    def keep(self, judgements: Sequence[Judgement], count: int) -> None:
        """Keeps the records of a whole run, unless they are kept already or the sources changed
        meanwhile.
        """
        records = [judgement.record for judgement in judgements]
        if (
            self.key
            and len(records) == count
            and all(records)
            and records != list(self.by_claim.values())
            and self.key == kept.key(self.budget)
        ):
            kept.keep(self.key, records)


def judge_with_records(
    claims: Sequence[Claim],
    options: Options,
    records: Records,
    judge_rest: Callable[[Sequence[Claim], Options], Judged],
) -> Judged:
    """The judgements on the claims in order: again by their records where these agree with the
    store, else from their sources.
    """
    stored: dict[str, set[str]] = {}
    for name in options.store.texts if options.store else ():
        stored.setdefault(name.split("/")[0], set()).add(name)
    found: dict[str, Judgement] = {}
    seconds: dict[str, float] = {}
    for claim in claims if records.claims else ():
        began = perf_counter()
        try:
            found[claim.id] = judge_again(
                records.by_claim[claim.id], options, stored.get(claim.id, set())
            )
        except NOT_AS_KEPT:
            continue
        seconds[claim.id] = perf_counter() - began
    rest: Sequence[Claim] = [claim for claim in claims if claim.id not in found]
    if rest and records.claims:
        sources = {claim.id: claim for claim in paper_claims()}
        rest = [sources[claim.id] for claim in rest]
        options = replace(options, lemmas=lemmas(list(sources.values()), rest))
    if rest:
        judged, took = judge_rest(rest, options)
        found.update((judgement.id, judgement) for judgement in judged)
        seconds.update(took)
    return [found[claim.id] for claim in claims], seconds


def judge_again(record: Mapping[str, Any], options: Options, names: set[str]) -> Judgement:
    """The judgement on the claim of a record, by its stored statements, which have these names, and
    what the checker said of them in this run.

    Raises Forgotten where the stored statements are not exactly the ones that the record knows, or
    one of them is not settled.
    """
    if options.store is None:
        raise Forgotten
    found = _Again(record, options, options.store).run()
    if {name for name, _ in found.statements} != names:
        raise Forgotten
    return found


class _Again(Judge):
    def __init__(self, record: Mapping[str, Any], options: Options, store: Store) -> None:
        super().__init__(claim_of(record), options)
        self.known_by, self.store = record, store

    def body(self) -> Body:
        return body_of(self.known_by, self.store.texts)

    def record(self, body: Body) -> None:
        self.found.record = self.known_by

    def stored_outcome(self, name: str, text: str, certificate: Any) -> str:
        outcome = self.options.checked.get(name, "rejected")
        if certificate is None or outcome == "rejected":
            raise Forgotten
        return outcome

    def cast(self, name: str, text: str, outcome: str, routes: Sequence[str]) -> Any:
        raise Forgotten

    def search(self, statement: AnyStatement, parsed: Any, confirm: bool) -> Any:
        raise Forgotten

    def correct(self) -> None:
        """The correction that the record knows, if the checker certified every statement of it and
        an earlier run found it too.
        """
        remembered = (self.options.findings.get(self.claim.id) or {}).get("correction")
        if remembered != self.known_by["correction"] or bool(remembered) != bool(
            self.known_by["corrected"]
        ):
            raise Forgotten
        for name, marked, kind in self.known_by["corrected"]:
            if (
                name not in self.store.texts
                or self.settle(stored_as(name, self.store.texts[name], marked, kind)) != "certified"
            ):
                raise Forgotten
        self.found.correction = remembered

    def search_sharp(
        self, name: str, ranged: Sequence[Statement], over: Sequence[str]
    ) -> tuple[SharpRange, Any, str] | None:
        raise Forgotten

    def sharp_outcome(
        self, name: str, text: str, certificate: Any, ranged: Sequence[Statement]
    ) -> str:
        if self.options.checked.get(name) != "certified":
            raise Forgotten
        return "certified"
