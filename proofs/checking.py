"""The checker's reading of a whole stored folder, in a process of its own while claims are stated; every run reads everything."""

from __future__ import annotations

import signal
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from certificates import checker
from certificates.store import STATEMENTS

Results = list[tuple[str, str, str]]


class Reading:
    """What `checker.check_folder` says of a folder; with two jobs it is found out meanwhile, with one when it is asked for.

    A folder without statements, one that cannot be read, and `nothing` come to no results.
    """

    def __init__(self, folder: Path, jobs: int, nothing: bool = False) -> None:
        self.folder, self.jobs = folder, jobs
        self.nothing = nothing or not (folder / STATEMENTS).exists()
        self.results: Results = []
        self._child: Any = None

    def __enter__(self) -> Reading:
        if self.jobs > 1 and not self.nothing:
            fork = get_context("fork")
            self._receiver, sender = fork.Pipe(duplex=False)
            self._child = fork.Process(target=_send, args=(self.folder, sender), daemon=True)
            self._child.start()
            sender.close()
        return self

    def __exit__(self, *_: object) -> None:
        if self._child is not None:
            self._child.kill()
            self._child.join()

    def outcomes(self) -> dict[str, str]:
        """The outcome of every stored statement, by name."""
        if not self.nothing:
            try:
                self.results = self._receiver.recv() if self._child is not None else _read(self.folder)
            except EOFError:  # the process died: the checker is asked here
                self.results = _read(self.folder)
        return {name: outcome for name, outcome, _ in self.results}


def _read(folder: Path) -> Results:
    try:
        results: Results = checker.check_folder(str(folder))
        return results
    except checker.Rejected:
        return []


def _send(folder: Path, sender: Any) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sender.send(_read(folder))
