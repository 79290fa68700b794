"""The checker's reading of a whole stored folder, in processes of its own while claims are stated;
every run reads everything."""

from __future__ import annotations

import gc
import hashlib
import signal
import sys
from collections.abc import Set
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from certificates import checker
from certificates.store import CERTIFICATES, STATEMENTS
from proofs import cache

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
    very checker, or found out now."""
    key = _key(folder)
    kept = cache.load(key) if key else []
    try:
        if kept:
            return [(str(one["name"]), str(one["outcome"]), str(one["reason"])) for one in kept]
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
        cache.keep(
            key,
            [
                {"name": name, "outcome": outcome, "reason": reason}
                for name, outcome, reason in results
            ],
        )


def _key(folder: Path) -> str:
    if cache.folder() is None or not folder.is_dir():
        return ""
    said = hashlib.sha256(sys.version.encode())
    for path in [
        *sorted(Path(str(checker.__file__)).parent.glob("*.py")),
        *(path for path in (folder / STATEMENTS, folder / CERTIFICATES) if path.exists()),
    ]:
        content = path.read_bytes()
        said.update(f"\n{path.name} {len(content)}\n".encode())
        said.update(content)
    return "read-" + said.hexdigest()


def shares(folder: Path, count: int) -> list[Set[str]]:
    """The claims of a folder in `count` shares of about the same size on disk."""
    sizes: dict[str, int] = {}
    try:
        lines = (folder / CERTIFICATES).read_bytes().split(b"\n")
    except OSError:
        lines = []
    for line in (one for one in lines if one.startswith(b'["')):
        claim = line[2:].split(b"/", 1)[0].decode("ascii", "replace")  # what follows `["`
        sizes[claim] = sizes.get(claim, 0) + len(line)
    found: list[set[str]] = [set() for _ in range(count)]
    weights = [0] * count
    for claim in sorted(sizes, key=lambda claim: (-sizes[claim], claim)):
        lightest = weights.index(min(weights))
        found[lightest].add(claim)
        weights[lightest] += sizes[claim]
    return [*found]


def check_share(folder: Path, share: Set[str]) -> tuple[Results, dict[str, str], dict[str, str]]:
    """What `check_folder` says where outcomes outside the share are assumed to be what their
    certificates claim; with what was found, and assumed."""
    found, assumed = dict[str, str](), dict[str, str]()

    def check_own(statement: Any, certificate: Any, known: Any, earlier: Any) -> tuple[str, Any]:
        if statement.name.split("/")[0] in share:
            outcome, reason = checker.check_one(statement, certificate, known, earlier)
            found[statement.name] = outcome
            return outcome, reason
        claimed = [
            word
            for word in ("certified", "refuted", "unknown")
            if isinstance(certificate, dict) and word in certificate
        ]
        assumed[statement.name] = claimed[0] if claimed else "rejected"
        return assumed[statement.name], None

    return _read(folder, check_own), found, assumed


def _read(folder: Path, check: Any = checker.check_one) -> Results:
    try:
        results: Results = checker.check_folder(str(folder), check)
        return results
    except checker.Rejected:
        return []


def _send(folder: Path, share: Set[str], sender: Any) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.disable()  # the checker makes no cycles, and the process ends with its share
    sender.send(check_share(folder, share))
