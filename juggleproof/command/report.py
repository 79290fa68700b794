"""`juggleproof report`: the stored claims as a page, as LaTeX, as a PDF, and as data for other
programs.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import sys
from base64 import b64decode, b64encode
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from juggleproof.command.outputs import busy, write_all
from juggleproof.judging import report_cache
from juggleproof.judging.checked import Checked, StoreReading
from juggleproof.judging.extras import needed
from juggleproof.sine.stored import stored_outcomes
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT, Store

if TYPE_CHECKING:
    from juggleproof.reports.contents import Contents

DEFAULT_FOLDER = Path("juggleproof-report")
LIBRARIES = {  # the library that a format needs, by format
    "html": "jinja2",
    "latex": "jinja2",
    "pdf": "jinja2",
    "markdown": "",
    "json": "",
    "badge": "",
    "figures": "matplotlib",
}
MAKERS = "juggleproof.command.formats"  # takes a second to load
NOT_KEPT = "pdf"  # never kept: the digest does not cover the programs that make it
DRAWN_BY = ("jinja2", "markupsafe", "latex2mathml", "matplotlib")


def command(parsed: argparse.Namespace) -> int:
    """Writes the reports; returns the exit code."""
    return report(parsed.format, parsed.output)


def report(wanted: Sequence[str], folder: Path | None) -> int:
    """Writes a report in each of these formats into the folder and prints the paths; returns 1
    where a report has faults that a reader would see.

    Raises ClaimError, one line, for an unknown format, a folder that cannot be written, or a
    library or program that is absent.
    """
    write = writer(wanted, folder, "--format")
    checked = check_store()
    under = key_of(checked)
    found = {one: kept_files(f"{one}-{under}") for one in dict.fromkeys(wanted)} if under else {}
    if found and all(found.values()):
        for files in found.values():
            write_all(files, folder or DEFAULT_FOLDER)
        return 0
    with busy("judging the stored claims"):
        contents: Contents = import_module(MAKERS).gather(checked=checked)
    return write(contents, under if settles(checked, contents) else "")


def check_store() -> Checked:
    """The checker's outcome of every stored statement; none where the store cannot be read."""
    with (
        busy("checking the stored certificates"),
        StoreReading(DEFAULT, os.cpu_count() or 1) as reading,
    ):
        reading.outcomes()
    return reading.results


def writer(
    wanted: Sequence[str], folder: Path | None, option: str = "--report"
) -> Callable[..., int]:
    """Return a function (contents, key) that writes the reports of given contents, and keeps them
    under the key if it is not empty.  An unknown format, a file in place of a folder, and a format
    without its library are refused at once.
    """
    for one in wanted:
        if one not in LIBRARIES:
            raise ClaimError(f"{option} {one}: choose from {', '.join(LIBRARIES)}")
        if LIBRARIES[one]:
            needed(LIBRARIES[one])
    place = folder or DEFAULT_FOLDER
    _refuse_what_is_no_folder(place)

    def write(contents: Contents, under: str = "") -> int:
        formats, faulty = import_module(MAKERS), 0
        for one in dict.fromkeys(wanted):
            with busy(f"making the report as {one}"):
                made, faults = formats.FORMATS[one](contents, place)
            write_all(made, place)
            if under and one != NOT_KEPT:
                report_cache.keep(f"{one}-{under}", [_record(name, made[name]) for name in made])
            for fault in faults:
                print(f"juggleproof: {fault}", file=sys.stderr)
                faulty = 1
        return faulty

    return write


def _refuse_what_is_no_folder(place: Path) -> None:
    inner = next(one for one in (place, *place.absolute().parents) if one.exists())
    if not inner.is_dir():
        raise ClaimError(f"{inner}: not a folder; choose another with -o")


# -------------------------------------------------------------------------------------------------
# The kept report of an earlier run is written again where both checkers, which each run asks, give
# the same outcomes for the same store, and the sources are the same: these determine the
# judgements, and so every byte of the report.


def key_of(checked: Checked) -> str:
    """A digest of all that a report depends on: the outcomes of both checkers in this run, the
    store, the files of the packages, the kept results of the part's scene, and the versions of
    libraries.

    Empty where nothing can be kept, the checker has no results, or figures cannot be drawn, which
    each run must report.
    """
    place = report_cache.folder()
    if place is None or not checked or find_spec("matplotlib") is None:
        return ""
    scene = [report_cache.load(path.stem) for path in sorted(place.glob("part-*.json"))]
    files = [*sorted(DEFAULT.iterdir()), report_cache.ROOT / "pyproject.toml"]
    digests = [
        hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "" for path in files
    ]
    versions = [report_cache.version_of(tool) for tool in ("juggleproof", *DRAWN_BY)]
    said = (checked, stored_outcomes())
    return report_cache.key(said, digests, versions, scene, files="*")


def settles(checked: Checked, contents: Contents) -> bool:
    """Whether every outcome that the report shows is the checker's outcome of the same text in the
    store.  It is not where a certificate was found in this run, since that is not stored.
    """
    outcomes, texts = {name: outcome for name, outcome, _ in checked}, Store(DEFAULT).texts
    return all(
        outcomes.get(one.name) == one.outcome and texts.get(one.name) == one.text
        for entry in contents.entries
        for one in entry.statements
    )


def kept_files(key: str) -> dict[str, bytes]:
    """The files of a report that were kept under the key; none where the record is missing or
    damaged, or a file would be written outside of the report's folder.
    """
    try:
        files = {
            record["name"]: b64decode(record["data"], validate=True)
            for record in report_cache.load(key)
        }
    except (KeyError, TypeError, ValueError):
        return {}
    inside = all(re.fullmatch(r"(figures/)?\w[\w.-]*", name) for name in files)
    return files if inside else {}


def _record(name: str, content: bytes) -> report_cache.Record:
    return {"name": name, "data": b64encode(content).decode("ascii")}
