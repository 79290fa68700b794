"""The report as one HTML page: nothing is fetched, formulas are MathML, pictures are SVG, and what
moves is a few lines of script.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from proofs.reports.contents import Contents
from proofs.reports.extras import needed
from proofs.reports.names import NOTATION, glyph
from proofs.reports.page import formulas, view
from proofs.reports.page.mathml import mathml
from proofs.reports.part import HEADS, Results

HERE = Path(__file__).parent
FILE = "juggleproof.html"


@dataclass(frozen=True)
class Picture:
    """A figure as it stands in the page: SVG that bears its own title and description."""

    slug: str
    title: str
    caption: str
    svg: str


def pictures(contents: Contents) -> list[Picture]:
    """The report's figures."""
    from proofs.reports.figures import saved
    from scenes.figures.drawing import inline_svg

    return [
        Picture(
            one.slug, one.title, one.caption, inline_svg(one.data, one.slug, one.title, one.alt)
        )
        for one in saved(contents)
    ]


def scene_picture(scene: Results | None) -> str:
    """Figure 2 as it stands in the page; empty where it was not drawn."""
    if scene is None or not scene.figure:
        return ""
    from scenes.figures.drawing import inline_svg

    return inline_svg(
        scene.figure["svg"], scene.figure["slug"], scene.figure["title"], scene.figure["alt"]
    )


def build(contents: Contents, drawn: Sequence[Picture] = (), scene: Results | None = None) -> bytes:
    """The page, the same to the byte for the same contents; `scene` is what is told of the part on
    the vibrating table.

    Raises ClaimError, one line, where a formula cannot be shown.
    """
    jinja2, markupsafe = needed("jinja2"), needed("markupsafe")
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        auto_reload=False,
    )
    environment.filters["markup"] = markupsafe.Markup
    environment.filters["text"] = lambda text: markupsafe.Markup(escape(text, quote=False))
    environment.filters["prose"] = lambda text: markupsafe.Markup(formulas.prose(text))
    text: str = environment.get_template("page.html.j2").render(
        **_shown(contents, drawn, scene, markupsafe.Markup)
    )
    return (text.rstrip() + "\n").encode()


def _shown(
    contents: Contents, drawn: Sequence[Picture], scene: Results | None, raw: Any
) -> dict[str, Any]:
    by_section = view.sections(contents)
    outcomes = {one.name: one.outcome for entry in contents.entries for one in entry.statements}
    headline, *further = [
        line.strip().rstrip(";") for line in contents.theorem.removeprefix("theorem: ").splitlines()
    ] or [""]
    return {
        "contents": contents,
        "sections": by_section,
        "errata": view.errata(by_section),
        "panels": view.panels(contents.rules),
        "derivations": view.derivations(contents),
        "tree": view.tree(contents.rules, outcomes),
        "drawn": drawn,
        "scene": scene,
        "scene_heads": HEADS,
        "scene_picture": raw(scene_picture(scene)),
        "impact_law": [
            entry.verdict for entry in contents.entries if entry.claim.section == "part"
        ],
        "verdicts": view.VERDICTS,
        "kinds": view.KINDS,
        "section_title": view.section_title,
        "headline": headline[:1].upper() + headline[1:],
        "further": list(map(formulas.line, further)),
        "notation": [(mathml(glyph(name)), name, said) for name, _, said in NOTATION if said],
        "linked": {*outcomes, *(entry.claim.id for entry in contents.entries)},
        "style": raw((HERE / "style.css").read_text(encoding="utf-8")),
        "script": raw((HERE / "page.js").read_text(encoding="utf-8")),
    }
