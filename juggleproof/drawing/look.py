"""How figures look: one palette for the regions, one ink; and a figure as an element of a page.

Loads no matplotlib, which draws them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

INK = "#222222"  # text, axes and whatever is no region; a page may put its own text colour for it


@dataclass(frozen=True)
class Look:
    """How a region or its boundary is distinguished: by colour (of Okabe and Ito), by hatch and by
    dashes, so that none of them is needed alone.
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
# what is no region of the paper, or all of it: the table, H
PLAIN = Look(INK, "////", tint=0.1, hatched=0.18)
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
