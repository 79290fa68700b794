"""The suite neither reads nor writes the user's kept figures, unless a test asks for a folder of
its own; kernels are compiled once for all tests; Ctrl-C is heard, also where the shell that started
the suite ignores it; no property fails because the machine is busy; tests that share what is costly
run in one process, which checks the stored certificates once, and no process compiles a module
that another has compiled.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from juggleproof.certificates import checker
from juggleproof.certificates.store import DEFAULT

os.environ["JUGGLEPROOF_CACHE"] = "off"
os.environ.setdefault(
    "NUMBA_CACHE_DIR", str(Path(__file__).resolve().parents[1] / ".pytest_cache" / "machine-code")
)
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
gc.set_threshold(50_000)  # as the command has it
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
settings.register_profile("suite", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("suite")
pytest_plugins = ["pytester"]


@pytest.fixture(scope="session", autouse=True)
def _store_is_checked_once() -> Iterator[None]:
    """A folder with the very bytes of the store is not read again, which takes two seconds and is
    done by every run on the paper.
    """
    check_folder, check_one = checker.check_folder, checker.check_one
    of_store = cache(lambda: tuple(check_folder(str(DEFAULT))))

    def content(folder: Path) -> list[bytes]:
        return [(folder / name).read_bytes() for name in (checker.STATEMENTS, checker.CERTIFICATES)]

    stored = content(DEFAULT)

    def checked(folder: str, check: Any = check_one) -> list[tuple[str, str, str]]:
        try:
            same = check is check_one and content(Path(folder)) == stored
        except OSError:
            same = False
        return list(of_store()) if same else check_folder(folder, check)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checker, "check_folder", checked)
        yield


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The folder that takes longest comes first, so that no process is left with it at the end."""
    items.sort(key=lambda item: not item.nodeid.startswith("tests/proofs/coq/"))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Tests of a folder go to one process, which judges, derives and compiles for all of them; the
    folders in the order in which they are collected.
    """
    from xdist.scheduler import LoadScopeScheduling

    config.option.loadscopereorder = False

    class ByFolder(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return nodeid.partition("::")[0].rpartition("/")[0]

    return ByFolder(config, log)
