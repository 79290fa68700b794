"""The suite neither reads nor writes the user's kept figures, unless a test asks for a folder of
its own; kernels are compiled once for all tests; Ctrl-C is heard, also where the shell that started
the suite ignores it; no property fails because the machine is busy, and CI tries each on more
examples; tests that share what is costly run in one process, and no process compiles a module that
another has compiled.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from tests.share import share

# Nothing that commands keep is used but machine code, which depends on its sources alone.
CHOSEN = os.environ.get("JUGGLEPROOF_CACHE", "")
os.environ["JUGGLEPROOF_CACHE"] = "off"
# as the commands have it, before a test loads NumPy: threads that wait for small matrices cost more
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
if CHOSEN == "off":
    CHOSEN = str(Path(__file__).resolve().parents[1] / ".pytest_cache" / "machine-code")
os.environ.setdefault(
    "NUMBA_CACHE_DIR",
    CHOSEN or f"{os.environ.get('XDG_CACHE_HOME') or Path.home() / '.cache'}/juggleproof",
)
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
gc.set_threshold(50_000)  # as the command has it
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
SLOW = [HealthCheck.too_slow]
settings.register_profile(
    "suite", max_examples=share(40, 100), deadline=None, suppress_health_check=SLOW
)
settings.load_profile("suite")
pytest_plugins = ["pytester"]


@pytest.fixture(scope="module")
def kept_records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A folder of kept records for the tests that ask for one, in all workers, as the runs of one
    user have: what one has derived, the next need not.
    """
    with pytest.MonkeyPatch.context() as patch:
        base = tmp_path_factory.getbasetemp()
        folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "kept"
        folder.mkdir(exist_ok=True)
        patch.setenv("JUGGLEPROOF_CACHE", str(folder))
        yield


# What takes longest comes first, so that no process is left with it at the end.
LONGEST = (
    "tests/reports",
    "tests/proofs/coq",
    "tests/scenes/part",
    "tests/docs/test_commands.py",
)
# Folders whose tests judge the paper, begin Coq, compile kernels or read all sources once for all.
WHOLE = {"tests/reports", "tests/proofs/coq", "tests/scenes/part", "tests/house"}
TOGETHER = {"tests/test_pytest_plugin.py": "tests/reports"}  # it asks for that run


def scope_of(nodeid: str) -> str:
    """What goes to one process with a test: its file, or a folder."""
    path = nodeid.partition("::")[0]
    folder = path.rpartition("/")[0]
    return TOGETHER.get(path, folder if folder in WHOLE or path[:6] != "tests/" else path)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    order = {scope: place for place, scope in enumerate(LONGEST)}
    items.sort(key=lambda item: order.get(scope_of(item.nodeid), len(order)))


def pytest_collection_finish() -> None:
    """What collecting has loaded stays, and is searched for garbage no more."""
    gc.freeze()


def pytest_sessionfinish() -> None:
    """One search for garbage at the end; pytest's own, five times over in all that is loaded, would
    take 10 s.
    """
    gc.collect()
    gc.freeze()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Tests of a file go to one process, which derives once for all of them, as do those of some
    folders; in the order in which they are collected.
    """
    from xdist.scheduler import LoadScopeScheduling

    config.option.loadscopereorder = False

    class ByScope(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return scope_of(nodeid)

    return ByScope(config, log)
