"""Files that commands write, and progress on a terminal."""

from __future__ import annotations

import argparse
import os
import pydoc
import shutil
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from itertools import count
from pathlib import Path
from time import monotonic
from typing import BinaryIO

from juggleproof.reports.tables import folded, line_width
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import write_file

# -------------------------------------------------------------------------------------------------
# Files that cannot be written are refused before a run, not after it.


def fault_of(path: Path) -> str:
    """The reason why the file cannot be written, by a trial with a file beside it; empty where it
    can.
    """
    try:
        if path.is_dir():
            return "is a folder"
        if path.exists() and not path.is_file():  # renaming would replace a device or pipe
            return "is no plain file"
        folder = path.absolute().parent
        if not folder.is_dir():
            return f"cannot be written ({folder} is no folder; make it first)"
        with tempfile.NamedTemporaryFile(prefix=".", dir=folder):
            return ""
    except (OSError, ValueError) as error:
        return f"cannot be written ({getattr(error, 'strerror', None) or error})"


def fault_of_folder(folder: Path) -> str:
    """The reason why no file can be written in the folder, which need not exist yet; else empty."""
    there = (one for one in (folder.absolute(), *folder.absolute().parents) if one.exists())
    return fault_of(next(there) / "file")


OUTPUTS = ("json", "junit", "markdown", "timings")


def asked_of(options: argparse.Namespace) -> dict[str, Path]:
    """The files that `certify` writes beside the store, by option."""
    return {
        option: getattr(options, option)
        for option in OUTPUTS
        if getattr(options, option) is not None
    }


def refuse_unwritable(files: Sequence[Path], asked: Mapping[str, Path]) -> None:
    """Raises ClaimError, one line that names option and path, where an output file cannot be
    written, or would overwrite another file of the run.
    """
    taken = {path.resolve(): f"the claims of {path}" for path in files}
    for option, path in asked.items():
        fault = fault_of(path) or (
            f"would overwrite {taken[path.resolve()]}" if path.resolve() in taken else ""
        )
        if fault:
            raise ClaimError(f"--{option} {path}: {fault}; name another file")
        taken[path.resolve()] = f"what --{option} writes"


@contextmanager
def written_aside(path: Path) -> Iterator[BinaryIO]:
    """A temporary file, which is renamed to the path when all is written, and removed where that
    fails.  Raises ClaimError where the file cannot be written, for instance on a full disk.
    """
    try:
        handle, aside = tempfile.mkstemp(prefix=".", suffix=path.suffix + ".new", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                yield file
            os.chmod(aside, 0o644)
            os.replace(aside, path)
        except BaseException:
            os.unlink(aside)
            raise
    except OSError as error:
        raise ClaimError(
            f"{path}: cannot be written ({error.strerror}); choose a folder that can be"
        ) from None


Files = Mapping[str, bytes]  # by name


def write_all(files: Files, place: Path) -> None:
    """Writes the files of a report and prints their paths."""
    clear()
    for name, content in files.items():
        write_file(place / name, content)
        print(place / name)


# -------------------------------------------------------------------------------------------------
# Long texts, shown by the user's pager where they do not fit on the terminal.


MOST_COLUMNS = 124  # of a text on a wide terminal


def fitted(text: str) -> str:
    """The text, folded at the width of the terminal, where there is one."""
    return folded(text, line_width(MOST_COLUMNS)) if sys.stdout.isatty() else text


@contextmanager
def folding() -> Iterator[None]:
    """Whatever is printed is folded at the width of the terminal, where there is one."""
    if not sys.stdout.isatty():
        yield
        return
    with redirect_stdout(StringIO()) as printed:
        yield
    show(printed.getvalue())


def show(text: str) -> None:
    """Prints the text; where it does not fit on a terminal, by the pager that PAGER names."""
    text = fitted(text)
    fits = text.count("\n") < shutil.get_terminal_size().lines
    if fits or not (sys.stdin.isatty() and sys.stdout.isatty()):
        print(text.rstrip("\n"))
    else:
        os.environ.setdefault("LESS", "FRX")  # colours are shown, a short text ends at once
        pydoc.pager(text)


# -------------------------------------------------------------------------------------------------
# The progress of a long run, on a terminal.


def progress() -> Callable[[int, int], None] | None:
    """A function (done, of) that shows the progress of a run; None unless on a terminal."""
    if not sys.stderr.isatty():
        return None
    last = [-1]

    def show(done: int, of: int) -> None:
        part = 1000 * done // max(of, 1)
        if part != last[0]:
            last[0] = part
            print(f"\r{done} of {of}", end="", file=sys.stderr, flush=True)

    return show


PAUSE = 3.0  # seconds between two lines of progress


def now_and_then() -> Callable[[str], None]:
    """A function that writes a line of progress to standard error, at most one every `PAUSE`
    seconds.
    """
    due = monotonic() + PAUSE

    def tell(line: str) -> None:
        nonlocal due
        if monotonic() >= due:
            due = monotonic() + PAUSE
            print(line, file=sys.stderr, flush=True)

    return tell


@contextmanager
def busy(doing: str) -> Iterator[None]:
    """Shows what the program is doing, and for how many seconds, on a terminal only."""
    if not sys.stderr.isatty():
        yield
        return
    done = threading.Event()

    def show() -> None:
        for seconds in count(1):
            if done.wait(1.0):
                return
            print(f"\r\x1b[K{doing}: {seconds} s", end="", file=sys.stderr, flush=True)

    shown = threading.Thread(target=show, daemon=True)
    shown.start()
    try:
        yield
    finally:
        done.set()
        shown.join()
        clear()


def clear() -> None:
    """Clears the line of progress."""
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
