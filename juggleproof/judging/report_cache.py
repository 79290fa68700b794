"""A cache of reports and figures between runs, in files outside the tree.  A faulty file only costs
time, and nothing is concluded from one.

JUGGLEPROOF_CACHE names another folder, or is `off`.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Iterator, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from juggleproof.folders import FOLDER
from juggleproof.judging import limits
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import canonical, plain_file, write_file

Record = dict[str, Any]  # plain data, as JSON has it
VARIABLE = "JUGGLEPROOF_CACHE"
ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("juggleproof", "symbolic", "certificates")  # in a wheel the first has the rest
TOOLS = ("sympy", "mpmath", "z3-solver", "python-flint", "highspy", "numpy")


def folder() -> Path | None:
    """The folder of the cache: JUGGLEPROOF_CACHE, or juggleproof in the user's cache folder; None
    where the cache is off or there is no home.
    """
    chosen = os.environ.get(VARIABLE, "")
    if chosen == "off":
        return None
    if chosen:
        return Path(chosen)
    try:
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "juggleproof"
    except RuntimeError:
        return None


def key(*settings: object, files: str = "*.py") -> str:
    """A digest of the files of the packages and of the paper that match `files`, the versions of
    Python and of the libraries, and the settings.
    """
    digest = hashlib.sha256(
        repr((sys.version, [(tool, version_of(tool)) for tool in TOOLS], settings)).encode()
    )
    for name, path in sources(files):
        content = path.read_bytes()
        digest.update(f"\n{name} {len(content)}\n".encode())
        digest.update(content)
    return digest.hexdigest()


def version_of(tool: str) -> str:
    """The version of a library, or "absent"."""
    try:
        return version(tool)
    except PackageNotFoundError:
        return "absent"


def sources(files: str = "*.py") -> Iterator[tuple[str, Path]]:
    """The files that match, each with its name, which begins with that of its package."""
    for folder in (*(ROOT / package for package in SOURCES), FOLDER):
        for path in sorted(folder.rglob(files)):
            if path.parent.name != "__pycache__" and path.is_file():
                yield f"{folder.name}/{path.relative_to(folder).as_posix()}", path


def load(key: str) -> list[Record]:
    """The records that were kept under the key; none where there is no such file, it is damaged, or
    another user owns it or may write it.
    """
    place = folder()
    if place is None:
        return []
    path = place / f"{key}.json"
    try:
        status = path.stat()
        if (
            status.st_size > limits.KEPT_BYTES
            or hasattr(os, "getuid")
            and (status.st_uid != os.getuid() or status.st_mode & 0o022)
        ):
            return []
        head, _, rest = plain_file(path).read_bytes().partition(b"\n")
        if head.decode() != hashlib.sha256(key.encode() + rest).hexdigest():
            return []
        records = json.loads(rest)["records"]
        return (
            records
            if isinstance(records, list) and all(isinstance(one, dict) for one in records)
            else []
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError, MemoryError):
        return []


def keep(key: str, records: Sequence[Record]) -> None:
    """Keeps the records under the key, and removes all but the latest files, `KEPT_FILES` of them;
    does nothing where the folder cannot be written.
    """
    place = folder()
    if place is None:
        return
    content = canonical({"records": list(records)})
    try:
        write_file(
            place / f"{key}.json",
            hashlib.sha256(key.encode() + content).hexdigest().encode() + b"\n" + content,
        )
        files = sorted(
            place.glob(key[:-64] + "[0-9a-f]" * 64 + ".json"),
            key=lambda path: path.stat().st_mtime,
            reverse=True,
        )
        for path in files[limits.KEPT_FILES :]:
            path.unlink()
    except (OSError, ClaimError):
        return
