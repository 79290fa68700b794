"""The suite neither reads nor writes the user's kept figures, unless a test asks for a folder of
its own; kernels are compiled once for all tests; Ctrl-C is heard, also where the shell that started
the suite ignores it; no property fails because the machine is busy; tests that share what is costly
run in one process, and no process compiles a module that another has compiled.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

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
settings.register_profile("suite", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("suite")
pytest_plugins = ["pytester"]


# The folders that take longest come first, so that no process is left with one of them at the end.
LONGEST = ("tests/proofs/coq", "tests/proofs/reports", "tests/proofs/stability", "tests/benchmarks")
TOGETHER = {"tests/proofs": "tests/proofs/reports"}  # one process, which judges the paper once


def folder_of(nodeid: str) -> str:
    """The folder of a test, of those together the one that they are named by."""
    folder = nodeid.partition("::")[0].rpartition("/")[0]
    return TOGETHER.get(folder, folder)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    order = {folder: place for place, folder in enumerate(LONGEST)}
    items.sort(key=lambda item: order.get(folder_of(item.nodeid), len(order)))


def pytest_sessionfinish() -> None:
    """One search for garbage at the end; pytest's own, five times over in all that is loaded, would
    take 10 s.
    """
    gc.collect()
    gc.freeze()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Tests of a folder go to one process, which judges, derives and compiles for all of them; the
    folders in the order in which they are collected.
    """
    from xdist.scheduler import LoadScopeScheduling

    config.option.loadscopereorder = False

    class ByFolder(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return folder_of(nodeid)

    return ByFolder(config, log)
