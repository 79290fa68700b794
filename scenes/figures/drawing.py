"""How figures look and are saved: one palette for the regions, one ink, and bytes that are the same
from run to run.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import wraps
from html import escape
from typing import TYPE_CHECKING, Any, ParamSpec

if TYPE_CHECKING:
    from matplotlib.figure import Figure

P = ParamSpec("P")
INK = "#222222"  # text, axes and whatever is no region; a page may put its own text colour for it


@dataclass(frozen=True)
class Look:
    """How a region or its boundary is told: by colour (of Okabe and Ito), by hatch and by dashes,
    so that none of them is needed alone.
    """

    colour: str
    hatch: str
    dashes: Sequence[float] = ()
    tint: float = 0.22  # how much of the colour fills a region
    hatched: float = 0.45  # and its hatch


B1 = Look("#0072B2", "////", tint=0.3)
B2 = Look("#E69F00", "\\\\\\\\", (6, 2))
R = Look("#009E73", "---", tint=0.3)
GAIN = Look("#F0E442", "xxx", (1, 1), tint=0.35, hatched=0.5)
LOSS = Look("#56B4E9", "///", (3, 1), tint=0.4, hatched=0.6)
KEPT = Look("#D55E00", "", (4, 1.5, 1, 1.5))
BAND = Look("#CC79A7", "|||", (2, 2), tint=0.4)
PALETTE = {"B1": B1, "B2": B2, "R": R, "B1+": GAIN, "B1-": LOSS, "B10": KEPT, "K": BAND}
PLAIN = Look(
    INK, "////", tint=0.1, hatched=0.18
)  # what is no region of the paper, or all of it: the table, H
TRAP = Look(INK, "|||", (3, 2), tint=0.16, hatched=0.15)

STYLE = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 10,
    "text.color": INK,
    "lines.color": INK,
    "figure.facecolor": "none",
    "savefig.facecolor": "none",
    "hatch.linewidth": 0.5,
    "svg.fonttype": "path",
    "pdf.fonttype": 3,
    "path.simplify": False,
}


@contextmanager
def style(**more: Any) -> Iterator[None]:
    """The style, for as long as the block lasts."""
    from matplotlib import rc_context

    with rc_context({**STYLE, **more}):
        yield


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """The same function, drawing in this style."""

    @wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with style():
            return draw(*args, **kwargs)

    return drawn


def blank(width: float, height: float) -> Figure:
    """An empty figure of this size in inches."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height))


def svg(figure: Figure, slug: str) -> bytes:
    """The figure as an SVG file in which every id begins with the slug, so that several can stand
    in one page.
    """
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text = io.StringIO()
    with style(**{"svg.hashsalt": slug}):
        FigureCanvasSVG(figure).print_svg(
            text, metadata={"Date": None, "Creator": None, "Type": None, "Format": None}
        )
    return _with_own_ids(text.getvalue(), slug).encode("utf-8")


def _with_own_ids(text: str, slug: str) -> str:
    """The same file in fewer bytes, ids told apart from those of other figures; glyphs, which it
    uses most, have the shortest ids.
    """
    text = text.replace("xlink:href=", "href=").replace(
        ' xmlns:xlink="http://www.w3.org/1999/xlink"', ""
    )
    glyphs = list(dict.fromkeys(re.findall(r'<use href="#([^"]*)"', text)))
    short = {glyph: f"{slug}-{count:x}" for count, glyph in enumerate(glyphs)}
    text = re.sub(r"<!--.*?-->|<!DOCTYPE[^>]*>", "", text, flags=re.DOTALL)
    text = re.sub(
        r'(\sid="|href="#|url\(#)([^")]*)',
        lambda found: found[1] + short.get(found[2], f"{slug}-{found[2]}"),
        text,
    )
    text = re.sub(r'(<use [^>]*?)transform="translate\(([-\d.]+) ([-\d.]+)\)"', _placed, text)
    return (
        re.sub(r">\s+<", "><", re.sub(r"\s*\n\s*", " ", text)).replace(' "/>', '"/>').strip() + "\n"
    )


def _placed(use: re.Match[str]) -> str:
    return use[1] + " ".join(
        f'{name}="{round(float(at), 1):g}"'
        for name, at in (("x", use[2]), ("y", use[3]))
        if float(at)
    )


def pdf(figure: Figure) -> bytes:
    """The figure as a PDF file, without a date."""
    from matplotlib.backends.backend_pdf import FigureCanvasPdf

    data = io.BytesIO()
    with style():
        FigureCanvasPdf(figure).print_pdf(
            data, metadata={"CreationDate": None, "Creator": None, "Producer": None}
        )
    return data.getvalue()


def inline_svg(data: bytes | str, slug: str, title: str, alt: str) -> str:
    """An SVG file of `svg` as an element of an HTML page: named for readers who do not see it, its
    ink the page's text colour.
    """
    text = data.decode("utf-8") if isinstance(data, bytes) else data
    box = re.search(r'<svg[^>]*\sviewBox="([^"]*)"', text)
    body = re.search(r"<svg[^>]*>(.*)</svg>", text, re.DOTALL)
    if box is None or body is None:
        raise ValueError(f"not an SVG file: {slug}")
    inner = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", body.group(1), flags=re.DOTALL)
    inner = inner.replace(INK, "currentColor").replace("*{", f"#{slug} *{{").strip()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" id="{slug}" viewBox="{box.group(1)}" width="100%"'
        f' role="img" aria-labelledby="{slug}-title {slug}-desc"><title'
        f' id="{slug}-title">{escape(title)}</title><desc'
        f' id="{slug}-desc">{escape(alt)}</desc>{inner}</svg>'
    )
