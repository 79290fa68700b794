"""The checker's outcomes of stored statements: of a whole folder, in processes that run while
claims are stated; or of some statements and all that they rest on.

Outcomes are never kept between runs.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.statements.language import ClaimError, lemmas_of
from juggleproof.statements.processes import as_child
from juggleproof.statements.store import (
    CERTIFICATES,
    STATEMENTS,
    Store,
    plain_file,
    written_out,
)

Checked = list[tuple[str, str, str]]  # name, outcome, reason
Check = Callable[..., tuple[str, checker.Rejected | None]]  # as `checker.check_one`


class StoreReading:
    """The results of `checker.check_folder` on a folder: with several jobs, each process checks a
    share from `__enter__` on; with one job, all is checked in `outcomes`.

    There are no results with `nothing`, or where the folder has no statements or cannot be read.
    """

    def __init__(self, folder: Path, jobs: int, nothing: bool = False) -> None:
        self.folder, self.jobs = folder, jobs
        self.nothing = nothing or not (folder / STATEMENTS).exists()
        self.results: Checked = []
        self._processes: list[tuple[BaseProcess, Connection]] = []

    def __enter__(self) -> StoreReading:
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

    def _by_shares(self) -> Checked:
        """The results of all shares, if every outcome that one share assumed is the outcome in the
        share that checked it, and the work of all leaves enough for one more statement; else none.

        Under these conditions each statement was checked with the same lemmas, and the same limit
        of work, as `check_folder` would have given it.
        """
        try:
            parts: list[Share] = [receiver.recv() for _process, receiver in self._processes]
        except EOFError:  # a process died
            return []
        true = {name: outcome for part in parts for name, outcome in part.checked.items()}
        agreed = all(
            outcome == true.get(name) for part in parts for name, outcome in part.assumed.items()
        )
        work = sum(part.work for part in parts) + checker.MAX_WORK
        if not parts or not agreed or work > checker.MAX_FOLDER_WORK:
            return []
        reasons = {
            (name, outcome): reason
            for part in parts
            for name, outcome, reason in part.results
            if name in part.checked
        }
        return [
            (name, outcome, reasons.get((name, outcome), reason))
            for name, outcome, reason in parts[0].results
        ]


def shares(folder: Path, count: int) -> list[Set[str]]:
    """The claims of a folder in `count` shares of about the same size on disk."""
    sizes: dict[str, int] = {}
    try:
        lines = plain_file(folder / CERTIFICATES).read_bytes().split(b"\n")
    except OSError:
        lines = []
    for line in (one for one in lines if one.startswith(b'["')):
        claim = line[2:].split(b"/", 1)[0].decode("ascii", "replace")  # what follows `["`
        sizes[claim] = sizes.get(claim, 0) + len(line)
    split: list[set[str]] = [set() for _ in range(count)]
    weights = [0] * count
    for claim in sorted(sizes, key=lambda claim: (-sizes[claim], claim)):
        lightest = weights.index(min(weights))
        split[lightest].add(claim)
        weights[lightest] += sizes[claim]
    return [*split]


@dataclass(frozen=True)
class Share:
    """The results of `check_folder` for some of the claims: the outcomes of their own statements
    (`checked`), the outcomes assumed for all others (`assumed`), and the work that was spent.
    """

    results: Checked
    checked: Mapping[str, str]
    assumed: Mapping[str, str]
    work: int


def check_share(folder: Path, share: Set[str]) -> Share:
    """The results of `check_folder`, where outcomes outside the share are not checked, but taken
    from the certificates.
    """
    checked, assumed, spent = dict[str, str](), dict[str, str](), list[int]()

    def check_own(
        statement: checker.Statement,
        certificate: object,
        known: Mapping[str, checker.Statement],
        earlier: Mapping[str, checker.Statement],
        work: checker.Work,
    ) -> tuple[str, checker.Rejected | None]:
        if statement.name.split("/")[0] in share:
            limit = work.left
            outcome, reason = checker.check_one(statement, certificate, known, earlier, work)
            spent.append(limit - work.left)
            checked[statement.name] = outcome
            return outcome, reason
        claimed = [
            word
            for word in ("certified", "refuted", "unknown")
            if isinstance(certificate, dict) and word in certificate
        ]
        assumed[statement.name] = claimed[0] if claimed else "rejected"
        return assumed[statement.name], None

    return Share(_read(folder, check_own), checked, assumed, sum(spent))


def _read(folder: Path, check: Check = checker.check_one) -> Checked:
    gc.disable()  # the checker makes no reference cycles
    try:
        return checker.check_folder(str(folder), check)
    except checker.Rejected:
        return []
    finally:
        gc.enable()


def _send(folder: Path, share: Set[str], sender: Connection) -> None:
    as_child()
    sender.send(check_share(folder, share))


def outcomes_of(folder: Path, names: Iterable[str]) -> dict[str, str]:
    """The checker's outcomes of some stored statements and of all that they rest on; no others are
    read or checked.

    Raises ClaimError, one line, where the folder cannot be read.
    """
    try:
        file = written_out(checker.load(str(folder / STATEMENTS), checker.MAX_STATEMENTS))
        certificates = Store(folder).certificates()
        wanted = dict.fromkeys(name for name in names if name in file)
        below = [*wanted]
        for name in below:
            under = {*lemmas_of(certificates[name]), *file.named_by(name)}
            new = sorted(one for one in under if one in file and one not in wanted)
            wanted.update(dict.fromkeys(new))
            below += new
        statements = file.read(wanted)
    except checker.Rejected as reason:
        raise ClaimError(f"{folder}: {reason}; `juggleproof certify` writes it anew") from None
    outcomes: dict[str, str] = {}
    known: dict[str, checker.Statement] = {}
    earlier: dict[str, checker.Statement] = {}
    for name, statement in statements.items():
        outcomes[name], _ = checker.check_one(statement, certificates[name], known, earlier)
        earlier[name] = statement
        if outcomes[name] == "certified":
            known[name] = statement
    return outcomes
