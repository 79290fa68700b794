"""A hook of mkdocs: formulas become MathML when the site is built, so that no page needs a script
to show them.
"""

from __future__ import annotations

import re
from html import unescape

from latex2mathml.converter import convert

DISPLAY = re.compile(r"^```math\n(.*?)\n```$", re.M | re.S)
LONG = 60  # characters of LaTeX in a line of text, beyond which it may scroll
INLINE = re.compile(r'<span class="arithmatex">\\\((.*?)\\\)</span>', re.S)


def on_page_markdown(markdown: str, **_: object) -> str:
    """The page with every display as MathML."""
    return DISPLAY.sub(lambda found: f"<div>{_mathml(found[1], 'block')}</div>", markdown)


def on_page_content(html: str, **_: object) -> str:
    """The page with every formula of its text as MathML."""

    def inline(found: re.Match[str]) -> str:
        latex = unescape(found[1])
        shown = _mathml(latex, "inline")
        return f'<span class="long">{shown}</span>' if len(latex) > LONG else shown

    return INLINE.sub(inline, html)


def _mathml(latex: str, display: str) -> str:
    return convert(latex.replace(":=", r"\coloneqq "), display=display)
