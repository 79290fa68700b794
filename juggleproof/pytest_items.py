"""The items of the pytest plugin: claims judged in a session, and the faults of one."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from juggleproof.judging.register import PATH, load_register
from juggleproof.judging.run import Options, claims_of_files, refuse_duplicates, run, store_of
from juggleproof.papers.paper import opened
from juggleproof.reports.ci import NEITHER, failing, fails_at
from juggleproof.reports.results import RunResults, results_of_run, theorem_of_run
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT

NAME = "juggleproof"


class Claims:
    """The claims of a session, with their results, which are computed once, when the first item
    runs.
    """

    def __init__(self, of_paper: bool, files: Sequence[Path], chosen: Sequence[str]) -> None:
        self.of_paper, self.files, self.chosen = of_paper, files, chosen
        self.judged: dict[bool, RunResults | Exception] = {}

    def names(self) -> Iterator[tuple[str, bool]]:
        """The id of every claim, with whether it is the user's; and the ids that are registered but
        have no claim any more.

        Raises ClaimError for a file that cannot be read, for an id of two claims, and for a chosen
        id that does not exist.
        """
        own = claims_of_files(self.files)
        papers = opened().claims() if self.of_paper else []
        refuse_duplicates([*papers, *own])
        known = [claim.id for claim in papers]
        known += sorted(set(load_register(PATH)) - set(known)) if self.of_paper else []
        names = [*((name, False) for name in known), *((claim.id, True) for claim in own)]
        missing = set(self.chosen) - {name for name, _ in names}
        if missing:
            raise ClaimError(
                f"{NAME}::{sorted(missing)[0]}: no such claim; `pytest --collect-only` with the"
                " same options lists them"
            )
        yield from (item for item in names if not self.chosen or item[0] in self.chosen)

    def results(self, own: bool) -> RunResults:
        """The results; where the claims cannot be judged, every item raises the same exception."""
        if own not in self.judged:
            try:
                self.judged[own] = _judged(self.files if own else [])
            except Exception as problem:
                self.judged[own] = problem
        results = self.judged[own]
        if isinstance(results, Exception):
            raise results
        return results

    def collector(self, session: pytest.Session) -> pytest.Collector:
        """The collector of these claims as items of a session."""
        collector: pytest.Collector = ClaimCollector.from_parent(
            session, name=NAME, nodeid=NAME, of=self
        )
        return collector


def _judged(files: Sequence[Path]) -> RunResults:
    """The results of a run as by `certify`; for the paper it uses a copy of the store, so that
    tests do not change the source tree.
    """
    if files:
        own = Options(store_of(files), jobs=1)
        done = run(claims_of_files(files), own)
        return results_of_run(done.claims, done.judgements, None, rejected=done.rejected)
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"
        shutil.copytree(DEFAULT, store)
        done = run(opened().claims(), Options(store, jobs=1))
        return results_of_run(
            done.claims,
            done.judgements,
            load_register(PATH),
            theorem=theorem_of_run(done),
            rejected=done.rejected,
        )


class NotAsItShouldBe(Exception):
    """The error of an item: the message has the faults of the claim, in lines."""


class ClaimItem(pytest.Item):
    """An item that tests one claim."""

    def __init__(self, *, name: str, parent: pytest.Collector, of: Claims, own: bool) -> None:
        super().__init__(name, parent)
        self.of, self.own = of, own

    def runtest(self) -> None:
        """Passes where the verdict is as registered, or the user's own claim holds."""
        lines = faults(self.of.results(self.own), self.name)
        if lines:
            raise NotAsItShouldBe("\n".join([*lines, f"`juggleproof {self.hint()}` tells more"]))

    def hint(self) -> str:
        """The command that shows more of the claim."""
        return (
            f"explain {self.name} {' '.join(map(_short, self.of.files))}"
            if self.own
            else f"explain {self.name}"
        )

    # pytest does not export the types of `style` and of the result
    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The message alone for our own errors, without a traceback through the prover."""
        return (
            str(excinfo.value)
            if isinstance(excinfo.value, (NotAsItShouldBe, ClaimError))
            else super().repr_failure(excinfo, style)
        )

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """The location and heading for pytest's report.  The heading must not be the end of the
        node id, or pytest would write the id's dots as colons.
        """
        return self.config.rootpath / NAME, None, f"claim {self.name}"


class ClaimCollector(pytest.Collector):
    """A collector of the claims of a session as items."""

    def __init__(self, *, name: str, parent: pytest.Session, nodeid: str, of: Claims) -> None:
        super().__init__(name, parent, nodeid=nodeid)
        self.of = of

    def collect(self) -> Iterator[pytest.Item]:
        """The items; raises CollectError, one line, where the claims cannot be read."""
        try:
            names = list(self.of.names())
        except ClaimError as problem:
            raise self.CollectError(str(problem)) from None
        for name, own in names:
            yield ClaimItem.from_parent(self, name=name, of=self.of, own=own)


def faults(results: RunResults, name: str) -> list[str]:
    """The faults of a claim: how it differs from the register, and where it fails; none where it is
    as registered, or the user's own claim holds.
    """
    one = next((one for one in results.claims if one.id == name), None)
    change = results.change_of().get(name)
    changed = [] if change is None else [f"differs from the register: {change}"]
    if one is None:
        return [*changed, "the claim is gone from the sources"]
    if one.is_open:
        return [f"unknown: {one.detail or NEITHER}", *changed, *fails_at(one)]
    if results.own:
        return [] if one.verdict == "holds" else failing(one).splitlines()
    return [*changed, *fails_at(one)] if changed else []


def _short(path: Path) -> str:
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)
