"""`juggleproof report`: the stored claims as a page, as LaTeX, as a PDF, and as data for other
programs.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import write_file
from juggleproof.proofs.command.outputs import busy, clear
from juggleproof.proofs.extras import needed
from juggleproof.proofs.reports.ci import badge, markdown
from juggleproof.proofs.reports.contents import Contents, as_json, gather
from juggleproof.proofs.reports.figures import saved
from juggleproof.proofs.reports.page import FILE, build, pictures
from juggleproof.proofs.reports.part import kept_results
from juggleproof.proofs.reports.tex import compiled, files
from juggleproof.scenes.figures import TABLE

DEFAULT_FOLDER = Path("juggleproof-report")
LIBRARIES = {"html": "jinja2", "latex": "jinja2", "pdf": "jinja2", "figures": "matplotlib"}
Files = Mapping[str, bytes]


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
        if one not in FORMATS:
            raise ClaimError(f"{option} {one}: choose from {', '.join(FORMATS)}")
        if one in LIBRARIES:
            needed(LIBRARIES[one])
    place = folder or DEFAULT_FOLDER
    _refuse_what_is_no_folder(place)

    def write(contents: Contents) -> int:
        faulty = 0
        for one in dict.fromkeys(wanted):
            with busy(f"making the report as {one}"):
                made, faults = FORMATS[one](contents, place)
            write_all(made, place)
            for fault in faults:
                print(f"juggleproof: {fault}", file=sys.stderr)
                faulty = 1
        return faulty

    return write


def write_all(files: Files, place: Path) -> None:
    """Writes the files, each aside and renamed, and prints their paths."""
    clear()
    for name, content in files.items():
        write_file(place / name, content)
        print(place / name)


def _refuse_what_is_no_folder(place: Path) -> None:
    inner = next(one for one in (place, *place.absolute().parents) if one.exists())
    if not inner.is_dir():
        raise ClaimError(f"{inner}: not a folder; choose another with -o")


def _html(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return {FILE: build(contents, pictures(contents) if _can_draw() else (), kept_results())}, []


def _latex(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return (
        files(
            contents,
            [
                (
                    one.slug,
                    f"Figure {one.number}. {one.title}" if one.number else one.title,
                    one.caption,
                )
                for one in TABLE
            ],
        ),
        [],
    )


def _pdf(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    sources = {**_latex(contents, place)[0], **_figures(contents)}
    write_all(sources, place)  # the sources stand, whatever becomes of the PDF
    made, faults = dict[str, bytes](), list[str]()
    for document in ("juggleproof", "juggleproof-twocolumn"):
        made[f"{document}.pdf"], complaints = compiled(sources, document)
        faults += [f"{document}.tex: {one}" for one in complaints]
    return made, faults


def _markdown(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return {"juggleproof.md": markdown(contents).encode()}, []


def _json(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return {"juggleproof.json": as_json(contents)}, []


def _badge(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return {"juggleproof-badge.json": badge(contents)}, []


def _figures(contents: Contents) -> dict[str, bytes]:
    """The figures as PDF; none, with a line on standard error, where matplotlib is absent."""
    if not _can_draw():
        return {}
    return {f"figures/{slug}.pdf": content for slug, *_, content in saved(contents, "pdf")}


def _can_draw() -> bool:
    """Whether matplotlib is there; says so where it is not."""
    if importlib.util.find_spec("matplotlib") is not None:
        return True
    print(
        "juggleproof: matplotlib is absent, so figures are left out; pip install matplotlib"
        " brings it",
        file=sys.stderr,
    )
    return False


def _drawings(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return {
        f"figures/{slug}.{form}": content
        for form in ("svg", "pdf")
        for slug, *_, content in saved(contents, form)
    }, []


FORMATS: Mapping[str, Callable[[Contents, Path], tuple[Files, list[str]]]] = {
    "html": _html,
    "latex": _latex,
    "pdf": _pdf,
    "markdown": _markdown,
    "json": _json,
    "badge": _badge,
    "figures": _drawings,
}
