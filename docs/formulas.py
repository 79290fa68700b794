"""A hook of mkdocs: formulas become MathML when the site is built, so that no page needs a script
to show them."""

from __future__ import annotations

import re
from html import unescape
from typing import Any

from latex2mathml.converter import convert

FORMULA = re.compile(r'<(span|div) class="arithmatex">(?:\\\((.*?)\\\)|\\\[(.*?)\\\])</\1>', re.S)


def on_page_content(html: str, **_: Any) -> str:
    """The page with every formula as MathML."""
    return FORMULA.sub(_mathml, html)


def _mathml(found: re.Match[str]) -> str:
    block = found[3] is not None
    latex = unescape(found[3] if block else found[2]).strip()
    return convert(latex, display="block" if block else "inline")
