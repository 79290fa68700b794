"""Runs and contents of reports, each made once for all tests."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from juggleproof.command import formats, report
from juggleproof.judging.register import Register, load_register
from juggleproof.judging.run import Options, Run, claims_of_file, run
from juggleproof.papers.paper import opened
from juggleproof.reports import results
from juggleproof.reports.contents import Contents, contents_of
from juggleproof.reports.figures import Picture, pictures
from juggleproof.reports.page import build
from juggleproof.reports.results import ClaimResult, RunResults, results_of_run, theorem_of_run
from juggleproof.statements.store import DEFAULT

# -------------------------------------------------------------------------------------------------
# Runs whose reports are tested: of the paper, of files with every kind of verdict, and made up
# ones.

HEAD = "from juggleproof import MapRule, always, claim, exists_some, reals\nx, y = reals('x y')\n"
CLAIMS = {
    "squares": "always(x * y <= (x**2 + y**2) / 2)",
    "above": "always(x**2 > x, given=[x > 0])",
    "negative-square": "exists_some(['y'], y * y < 0)",
    # a map that leaves its space: rules are never refuted
    "open": (
        "MapRule('main', (('over', 'a'), ('domain', '0 < a'), ('state', 'x'), ('space', 'x <= 1'),"
        " ('piece', 'x <= 1 -> x + a')))"
    ),
}
HOLDS, FALSE, OPEN = ("squares",), ("squares", "above", "negative-square"), ("squares", "open")


def file_with(folder: Path, names: tuple[str, ...], says: str = "It says so.") -> Path:
    path = folder / "mine.py"
    parts = [
        f"@claim({name!r})\ndef one_{number}():\n    {says!r}\n    return {CLAIMS[name]}\n"
        for number, name in enumerate(names)
    ]
    path.write_text(HEAD + "\n\n".join(parts), encoding="utf-8")
    return path


def own(folder: Path, names: tuple[str, ...], says: str = "It says so.") -> RunResults:
    path = file_with(folder, names, says)
    options = Options(path.with_suffix(".certificates"), jobs=1)
    done = run(claims_of_file(path), options)
    return results_of_run(done.claims, done.judgements, None, rejected=done.rejected)


@cache
def paper_run() -> tuple[Run, str]:
    """A run on a copy of the store, and its line about the theorem."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(DEFAULT, Path(folder) / "store")
        done = run(opened().claims(), Options(Path(folder) / "store", jobs=1))
        return replace(done, store=DEFAULT), theorem_of_run(done)


@cache
def contents() -> Contents:
    """Of this run: what a report gathers, as the next is for."""
    return contents_of(paper_run()[0], load_register())


def made_of(patch: pytest.MonkeyPatch, gathered: Callable[[], Contents]) -> None:
    """The command makes reports of these contents, and has no store to check."""
    patch.setattr(report, "check_store", list)
    patch.setattr(formats, "gather", lambda checked: gathered())


def paper(
    register: Register | None = None,
    rejected: Sequence[tuple[str, str]] | None = None,
    accepted: bool = False,
) -> RunResults:
    if register is None and rejected is None and not accepted:
        return paper_as_registered()
    return paper_beside(register, rejected, accepted)


@cache
def paper_as_registered() -> RunResults:
    return paper_beside()


def paper_beside(
    register: Register | None = None,
    rejected: Sequence[tuple[str, str]] | None = None,
    accepted: bool = False,
) -> RunResults:
    done, theorem = paper_run()
    known = told()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(results, "_result", lambda claim, _: known[claim.id])
        return results_of_run(
            done.claims,
            done.judgements,
            load_register() if register is None else register,
            theorem=theorem,
            rejected=done.rejected if rejected is None else rejected,
            accepted=accepted,
        )


@cache
def told() -> dict[str, ClaimResult]:
    """The results for each claim of this run, whatever is registered."""
    done, _ = paper_run()
    return {one.id: results._result(one, its) for one, its in zip(done.claims, done.judgements)}


# -------------------------------------------------------------------------------------------------
# The contents of a report, gathered once for all tests, and the page that is made of them.


@cache
def drawn() -> tuple[Picture, ...]:
    return tuple(pictures(contents()))


@cache
def page() -> bytes:
    return build(contents(), drawn())


@cache
def some_contents() -> Contents:
    """One claim in six, all that the tree of the theorem and the tests name, and all of two
    verdicts and two sections: a page that loads soon.
    """
    kept = [
        entry
        for k, entry in enumerate(contents().entries)
        if k % 6 == 0
        or entry.claim.id.startswith("theorem")
        or entry.claim.id == "eq-37"
        or entry.verdict in ("gap", "false")
        or entry.claim.section in ("4.3.1", "A.2")
    ]
    return replace(contents(), entries=tuple(kept))


@cache
def page_of_some() -> bytes:
    return build(some_contents())


def refuted() -> ClaimResult:
    """A claim of the paper with a statement that is refuted."""
    return next(one for one in paper().claims if one.id == "s2.2.1-H")
