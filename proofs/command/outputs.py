"""Files and progress."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import write_file
from juggleproof.proofs.reports.ci import as_junit, markdown
from juggleproof.proofs.reports.contents import as_json
from juggleproof.proofs.reports.results import Results

# -------------------------------------------------------------------------------------------------
# The files that `certify` writes beside the store: refused before the run where they could not be
# written after it.

OPTIONS = ("json", "junit", "markdown", "timings")


def refuse_unwritable(options: argparse.Namespace) -> None:
    """Raises ClaimError, one line that names option and path, where a file that is asked for cannot
    be written, or would overwrite another.
    """
    taken = {path.resolve(): f"the claims of {path}" for path in options.files}
    for option, path in _asked(options).items():
        fault = fault_of(path) or (
            f"would overwrite {taken[path.resolve()]}" if path.resolve() in taken else ""
        )
        if fault:
            raise ClaimError(f"--{option} {path}: {fault}; name another file")
        taken[path.resolve()] = f"what --{option} writes"


def _asked(options: argparse.Namespace) -> dict[str, Path]:
    return {
        option: getattr(options, option)
        for option in OPTIONS
        if getattr(options, option) is not None
    }


def fault_of(path: Path) -> str:
    """Why the file cannot be written, found out by a file made beside it and removed; nothing where
    it can.
    """
    try:
        if path.is_dir():
            return "is a folder"
        if path.exists() and not path.is_file():  # a device or a pipe, which renaming would replace
            return "is no plain file"
        folder = next(above for above in path.absolute().parents if above.exists())
        with tempfile.NamedTemporaryFile(prefix=".", dir=folder):
            return ""
    except (OSError, ValueError) as error:
        return f"cannot be written ({getattr(error, 'strerror', None) or error})"


@contextmanager
def written_aside(path: Path) -> Iterator[BinaryIO]:
    """A file to write to, put in the place of the path when all is written; removed where that
    fails.  ClaimError for a full disk.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(
            prefix=".", suffix=path.suffix + ".new", dir=path.parent, delete=False
        ) as file:
            try:
                yield file  # type: ignore[misc]
                file.flush()
                os.chmod(file.name, 0o644)
                os.replace(file.name, path)
            except BaseException:
                os.unlink(file.name)
                raise
    except OSError as error:
        raise ClaimError(
            f"{path}: cannot be written ({error.strerror}); choose a folder that can be"
        ) from None


def write(options: argparse.Namespace, results: Results, seconds: Mapping[str, float]) -> None:
    """Writes each file that was asked for."""
    for option, path in _asked(options).items():
        write_file(path, _content(option, results, seconds))


def _content(option: str, results: Results, seconds: Mapping[str, float]) -> bytes:
    if option == "json":
        return as_json(results)
    if option == "junit":
        return as_junit(results)
    if option == "markdown":
        return markdown(results).encode()
    return "".join(f"{seconds[one.id]:9.3f}  {one.id}\n" for one in results.claims).encode()


# -------------------------------------------------------------------------------------------------
# How far a long run is, told on a terminal.


def progress() -> Callable[[int, int], None] | None:
    """Tells how far a run is, on a terminal only."""
    if not sys.stderr.isatty():
        return None
    last = [-1]

    def tell(done: int, of: int) -> None:
        part = 1000 * done // max(of, 1)
        if part != last[0]:
            last[0] = part
            print(f"\r{done} of {of}", end="", file=sys.stderr, flush=True)

    return tell


def clear() -> None:
    """Takes the line of progress away."""
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
