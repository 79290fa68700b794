"""A badge for a page: what the verdicts say in a few words, as an SVG of our own that loads
nothing.
"""

from __future__ import annotations

from typing import Any
from xml.sax.saxutils import escape

from proofs.reports.results import Results, results_of

LABEL = "juggleproof"
GOOD, BAD, NAME = "#1a7f37", "#b42318", "#3b4148"  # white on each of them has a contrast above 6
NARROW, WIDE = "fijlrt,.: 1", "mwMWNOD%"
PAD = 8


def badge(contents: Any) -> bytes:
    """The badge as SVG, the same bytes for the same verdicts."""
    text, colour = told(results_of(contents))
    left, right = _width(LABEL) + 2 * PAD, _width(text) + 2 * PAD
    title = escape(f"{LABEL}: {text}", {'"': "&quot;"})
    return f"""\
<svg xmlns="http://www.w3.org/2000/svg" width="{left + right}" height="20" \
viewBox="0 0 {left + right} 20" role="img" aria-label="{title}">
<title>{title}</title>
<rect width="{left + right}" height="20" rx="3" fill="{NAME}"/>
<path d="M{left} 0h{right - 3}a3 3 0 0 1 3 3v14a3 3 0 0 1-3 3h-{right - 3}z" fill="{colour}"/>
<g fill="#fff" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11">
<text x="{PAD}" y="14" textLength="{left - 2 * PAD}" lengthAdjust="spacingAndGlyphs">{LABEL}</text>
<text x="{left + PAD}" y="14" textLength="{right - 2 * PAD}" \
lengthAdjust="spacingAndGlyphs">{escape(text)}</text>
</g>
</svg>
""".encode()


def told(results: Results) -> tuple[str, str]:
    """The words and the colour: red where the theorem is not proved, something is unknown or
    rejected, or a verdict is not as registered.
    """
    count, unknown = len(results.claims), results.verdicts()["unknown"]
    claims = f"{count} claim{'' if count == 1 else 's'}, {unknown} unknown"
    if results.own:
        holds = results.verdicts()["holds"]
        return (
            f"{holds} of {count} {'holds' if holds == 1 else 'hold'}, {unknown} unknown",
            BAD if results.exit else GOOD,
        )
    words = [f"theorem {'' if results.is_proved else 'NOT '}proved", claims]
    if results.changes and not results.accepted:
        words.append(f"{len(results.changes)} changed")
    if results.rejected:
        words.append(f"{len(results.rejected)} rejected")
    return ", ".join(words), BAD if results.exit or unknown or not results.is_proved else GOOD


def _width(text: str) -> int:
    """About the width of the text in Verdana of 11 pixels; the text is set to this very width."""
    return round(sum(4.2 if c in NARROW else 9.2 if c in WIDE else 6.8 for c in text))
