"""`juggleproof report`: the stored claims as a page, as LaTeX, as a PDF, and as data for other
programs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path

from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.command.outputs import busy
from juggleproof.proofs.extras import needed
from juggleproof.proofs.reports.contents import Contents, gather

DEFAULT_FOLDER = Path("juggleproof-report")
LIBRARIES = {  # of each format, where it needs one
    "html": "jinja2",
    "latex": "jinja2",
    "pdf": "jinja2",
    "markdown": "",
    "json": "",
    "badge": "",
    "figures": "matplotlib",
}
MAKERS = "juggleproof.proofs.command.formats"  # which take a second to load


def command(parsed: argparse.Namespace) -> int:
    """Writes the reports that are asked for; returns the exit code."""
    return report(parsed.format, parsed.output)


def report(wanted: Sequence[str], folder: Path | None) -> int:
    """Writes a report of each of these formats into the folder and prints the paths; returns 1
    where what was made has faults that a reader would see.

    Raises ClaimError, one line, for an unknown format, a folder that cannot be written, or a
    library or program that is absent.
    """
    write = writer(wanted, folder, "--format")
    with busy("judging the stored claims"):
        contents = gather()
    return write(contents)


def writer(
    wanted: Sequence[str], folder: Path | None, option: str = "--report"
) -> Callable[[Contents], int]:
    """What does the same with contents in hand; an unknown format, what is no folder, and what
    lacks its library are refused at once.
    """
    for one in wanted:
        if one not in LIBRARIES:
            raise ClaimError(f"{option} {one}: choose from {', '.join(LIBRARIES)}")
        if LIBRARIES[one]:
            needed(LIBRARIES[one])
    place = folder or DEFAULT_FOLDER
    _refuse_what_is_no_folder(place)

    def write(contents: Contents) -> int:
        formats, faulty = import_module(MAKERS), 0
        for one in dict.fromkeys(wanted):
            with busy(f"making the report as {one}"):
                made, faults = formats.FORMATS[one](contents, place)
            formats.write_all(made, place)
            for fault in faults:
                print(f"juggleproof: {fault}", file=sys.stderr)
                faulty = 1
        return faulty

    return write


def _refuse_what_is_no_folder(place: Path) -> None:
    inner = next(one for one in (place, *place.absolute().parents) if one.exists())
    if not inner.is_dir():
        raise ClaimError(f"{inner}: not a folder; choose another with -o")
