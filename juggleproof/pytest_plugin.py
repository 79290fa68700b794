"""Claims as test items: `pytest --juggleproof` judges the paper's,
`pytest --juggleproof-claims mine.py` those of a user's file.

Each claim is an item `juggleproof::ID`.  The paper's claim passes where its verdict is as
registered, a user's where it holds.  An unknown claim fails, and nothing is skipped.  A session
judges once, as `juggleproof certify` does, and the checker reads everything.  The claims of Python
files named beside `--juggleproof` are judged instead of the paper's, as with `certify FILE.py`.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from juggleproof.pytest_items import Claims

NAME = "juggleproof"
CLAIMS: pytest.StashKey[Claims] = pytest.StashKey()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the options `--juggleproof` and `--juggleproof-claims FILE.py`."""
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
    """Removes the arguments that name claims, because pytest itself would look for such files.

    Raises UsageError for a test file named beside `--juggleproof`: its claims would not be judged.
    """
    files = [
        config.invocation_params.dir / name for name in config.getoption("--juggleproof-claims")
    ]
    papers: bool = config.getoption("--juggleproof")
    if not papers and not files:
        return
    from juggleproof import pytest_items  # only where claims are asked for

    named: list[Path] = []
    chosen: list[str] = []
    for argument in list(config.args):
        path, _, name = argument.partition("::")
        place = config.invocation_params.dir / path
        is_file = papers and place.suffix == ".py" and place.is_file()
        if is_file and _is_for_tests(config, place):
            if "juggleproof" not in place.read_text("utf-8", "ignore"):
                continue  # a file without claims: its tests run beside the paper's claims
            raise pytest.UsageError(
                f"{path}: a test file by its name, so --juggleproof does not judge it; name it"
                " with --juggleproof-claims, or run its tests without --juggleproof"
            )
        if is_file or Path(path).name == NAME and not place.exists():
            config.args.remove(argument)
            named += [place] if is_file else []
            chosen.append(name)
    config.stash[CLAIMS] = pytest_items.Claims(
        papers and not named, list(dict.fromkeys([*files, *named])), [] if "" in chosen else chosen
    )


def _is_for_tests(config: pytest.Config, path: Path) -> bool:
    patterns: Sequence[str] = config.getini("python_files")
    return any(path.match(pattern) for pattern in patterns)


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
            claims.collector(collector),
        ]
    return report
