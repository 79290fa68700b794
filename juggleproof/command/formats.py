"""The files that `juggleproof report` writes, by format."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from juggleproof.command.outputs import Files, write_all
from juggleproof.reports.ci import badge, markdown
from juggleproof.reports.contents import Contents, as_json, gather
from juggleproof.reports.figures import labels, of_paper, pictures, saved
from juggleproof.reports.page import FILE, build
from juggleproof.reports.part import kept_results
from juggleproof.reports.tex import compiled, files

__all__ = ["FORMATS", "gather"]


def _html(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return {FILE: build(contents, pictures(contents) if _can_draw() else (), kept_results())}, []


def _latex(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    return files(contents, [labels(one)[:3] for one in of_paper()]), []


def _pdf(contents: Contents, place: Path) -> tuple[Files, list[str]]:
    sources = {**_latex(contents, place)[0], **_figures(contents)}
    write_all(sources, place)  # the sources are kept even if the PDF fails
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
    """Whether matplotlib is installed; prints a line where it is not."""
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
