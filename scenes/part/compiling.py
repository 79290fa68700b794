"""The compiler of the part scene: numba where it is installed, and the same functions in plain
Python where it is not.
"""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

try:
    import numba
except ImportError:  # the optional extra `part`
    numba = None

Kernel = TypeVar("Kernel", bound=Callable[..., object])
COMPILED = numba is not None
KERNELS = (
    "body",
    "compiling",
    "impact",
    "flight",
    "contact",
    "turns",
    "strike",
    "pivot",
    "face",
    "motion",
    "watch",
    "ending",
)


def _digest() -> str:
    """A digest of all kernels: numba looks at the file of a function only, not at those of the
    functions that it calls.
    """
    said = hashlib.sha256(sys.version.encode())
    for name in KERNELS:
        said.update(Path(__file__).with_name(f"{name}.py").read_bytes())
    return said.hexdigest()[:16]


def _folder() -> Path | None:
    """Where machine code is kept, if anywhere: where numba is told to, or beside the other records
    of the project (see `proofs.cache`).
    """
    chosen = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("JUGGLEPROOF_CACHE", "")
    if chosen == "off":
        return None
    try:
        root = (
            Path(chosen)
            if chosen
            else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "juggleproof"
        )
        found = root / f"numba-{_digest()}"
        found.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return found if os.access(found, os.W_OK) else None


FOLDER = _folder() if COMPILED else None


def compiled(function: Kernel) -> Kernel:
    """The function compiled for floats, without the interpreter's lock; as it is where numba is
    absent.

    Sums keep their order and nothing is contracted, so that results are the same wherever sin and
    cos are.
    """
    if numba is None:
        return function
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(FOLDER or "")
    try:
        made: Kernel = numba.njit(cache=FOLDER is not None, nogil=True)(function)
    finally:
        numba.config.CACHE_DIR = before
    return made


def plain(function: Kernel) -> Kernel:
    """The function in plain Python: it takes exact numbers too."""
    return getattr(function, "py_func", function)
