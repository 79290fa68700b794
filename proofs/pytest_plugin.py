"""Claims as test items: `pytest --juggleproof` judges the paper's,
`pytest --juggleproof-claims mine.py` those of a file of one's own.

Each claim is an item `juggleproof::ID`.  Of the paper it passes where its verdict is as registered;
of one's own where the claim holds. What is unknown fails, and nothing is skipped.  A session judges
once, as `juggleproof certify` does, and the checker reads everything. Python files named beside
`--juggleproof` that have claims are judged instead of the paper's, as with `certify FILE.py`.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Generator, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from juggleproof.proofs.reports.results import Results

NAME = "juggleproof"
CLAIMS = pytest.StashKey["Claims"]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """`--juggleproof` and `--juggleproof-claims FILE.py`."""
    group = parser.getgroup(NAME, "claims as test items")
    group.addoption(
        "--juggleproof",
        action="store_true",
        help="judge the paper's claims, or those of the files named, one test item a claim",
    )
    group.addoption(
        "--juggleproof-claims",
        action="append",
        default=[],
        metavar="FILE.py",
        help="judge the claims of this file, one test item each",
    )


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """Takes from the arguments what names claims: pytest itself would look for files of these
    names.
    """
    files = [
        config.invocation_params.dir / name for name in config.getoption("--juggleproof-claims")
    ]
    papers: bool = config.getoption("--juggleproof")
    if not papers and not files:
        return
    named: list[Path] = []
    chosen: list[str] = []
    for argument in list(config.args):
        path, _, name = argument.partition("::")
        place = config.invocation_params.dir / path
        is_file = papers and _has_claims(place) and not _is_for_tests(config, place)
        if is_file or Path(path).name == NAME and not place.exists():
            config.args.remove(argument)
            named += [place] if is_file else []
            chosen.append(name)
    config.stash[CLAIMS] = Claims(
        papers and not named, list(dict.fromkeys([*files, *named])), [] if "" in chosen else chosen
    )


def _has_claims(path: Path) -> bool:
    try:
        return path.suffix == ".py" and "@claim(" in path.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return False


def _is_for_tests(config: pytest.Config, path: Path) -> bool:
    patterns: Sequence[str] = config.getini("python_files")
    return any(path.match(pattern) for pattern in patterns)


class Claims:
    """The claims that a session has asked for, and their results, which are found once, when the
    first item runs.
    """

    def __init__(self, of_paper: bool, files: Sequence[Path], chosen: Sequence[str]) -> None:
        self.of_paper, self.files, self.chosen = of_paper, files, chosen
        self.found: dict[bool, Any] = {}

    def names(self) -> Iterator[tuple[str, bool]]:
        """The id of every claim, of the user's own or not, and of every claim that is registered
        and gone.

        Raises ClaimError for a file that cannot be read, and for an id that two claims bear, or
        none.
        """
        from juggleproof.certificates.language import ClaimError
        from juggleproof.proofs.command.certify import refuse_duplicates
        from juggleproof.proofs.command.show import kept_claims
        from juggleproof.proofs.register import PATH, load_register
        from juggleproof.proofs.run import claims_of_file

        own = [claim for path in self.files for claim in claims_of_file(path)]
        papers = kept_claims() if self.of_paper else []
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

    def results(self, own: bool) -> Results:
        """The results; the same problem is raised to every item where the claims cannot be
        judged.
        """
        if own not in self.found:
            try:
                self.found[own] = _judged(self.files if own else [])
            except Exception as problem:
                self.found[own] = problem
        if isinstance(self.found[own], Exception):
            raise self.found[own]
        found: Results = self.found[own]
        return found


def _judged(files: Sequence[Path]) -> Results:
    """A run as `certify` makes it; the paper's on a copy of the store, so that tests leave the tree
    as it is.
    """
    from juggleproof.certificates.store import DEFAULT
    from juggleproof.proofs.command.certify import run
    from juggleproof.proofs.command.main import build_parser
    from juggleproof.proofs.register import PATH, load_register
    from juggleproof.proofs.reports.results import results_of_run

    with tempfile.TemporaryDirectory() as folder:
        register = None if files else load_register(PATH)
        if not files:
            shutil.copytree(DEFAULT, Path(folder) / "store")
        options = build_parser().parse_args(["certify", "--jobs", "1", *map(str, files)])
        options.store = None if files else Path(folder) / "store"
        done = run(options)
        return results_of_run(
            done.claims, done.judgements, register, theorem=done.theorem, rejected=done.rejected
        )


class NotAsItShouldBe(Exception):
    """What is wrong with a claim, in lines."""


class ClaimItem(pytest.Item):
    """One claim."""

    def __init__(self, *, of: Claims, own: bool, **more: Any) -> None:
        super().__init__(**more)
        self.of, self.own = of, own

    def runtest(self) -> None:
        """Passes where the verdict is as registered, or the user's own claim holds."""
        lines = told(self.of.results(self.own), self.name)
        if lines:
            raise NotAsItShouldBe("\n".join([*lines, f"`juggleproof {self.hint()}` tells more"]))

    def hint(self) -> str:
        """The command that tells more of the claim."""
        return (
            f"certify {' '.join(map(_short, self.of.files))} --only {self.name}"
            if self.own
            else f"explain {self.name}"
        )

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Our own lines where they say all; no traceback through the prover."""
        from juggleproof.certificates.language import ClaimError

        return (
            str(excinfo.value)
            if isinstance(excinfo.value, (NotAsItShouldBe, ClaimError))
            else super().repr_failure(excinfo, style)
        )

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Shown by its node id; the heading is no ending of it, or pytest would write its dots as
        colons.
        """
        return self.config.rootpath / NAME, None, f"claim {self.name}"


class ClaimCollector(pytest.Collector):
    """All claims that were asked for, as items."""

    def __init__(self, *, of: Claims, **more: Any) -> None:
        super().__init__(**more)
        self.of = of

    def collect(self) -> Iterator[pytest.Item]:
        """The items; one line where the claims cannot be read."""
        from juggleproof.certificates.language import ClaimError

        try:
            names = list(self.of.names())
        except ClaimError as problem:
            raise self.CollectError(str(problem)) from None
        for name, own in names:
            yield ClaimItem.from_parent(self, name=name, of=self.of, own=own)


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Puts the claims after what the session collects."""
    report = yield
    claims = collector.config.stash.get(CLAIMS, None)
    if isinstance(collector, pytest.Session) and claims is not None and report.passed:
        report.result = [
            *(report.result or ()),
            ClaimCollector.from_parent(collector, name=NAME, nodeid=NAME, of=claims),
        ]
    return report


def told(results: Results, name: str) -> list[str]:
    """What is wrong with a claim, with before and after and where it fails; nothing where it is as
    it should be.
    """
    from juggleproof.proofs.reports.ci import failing, fails_at

    one = next((one for one in results.claims if one.id == name), None)
    change = results.change_of().get(name)
    changed = [] if change is None else [f"differs from the register: {change}"]
    if one is None:
        return [*changed, "the claim is gone from the sources"]
    if one.verdict == "unknown":
        return [f"unknown: {one.detail or 'neither proved nor refuted'}", *changed]
    if results.own:
        return [] if one.verdict == "holds" else failing(one).splitlines()
    return [*changed, *fails_at(one)] if changed else []


def _short(path: Path) -> str:
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)
