"""The lines of a statement as words and formulas: what an auditor reads, set as mathematics."""

from __future__ import annotations

import re
from collections.abc import Iterator

from proofs.reports.latex import latex_of
from proofs.reports.names import glyph

WORDS = {
    "forall": "for all",
    "integer": "whole numbers",
    "range": "given",
    "given": "given",
    "have": "so that",
    "let": "where",
    "root": "where",
    "exists": "there are",
    "with": "with",
    "show": "then",
    "iterates": "the map",
    "after": "after",
    "over": "for all",
    "domain": "given",
    "holds": "exactly if",
    "number": "where",
    "state": "of the state",
    "space": "in",
    "piece": "the map",
    "rank": "rank",
    "stage": "stage",
    "on": "on",
    "point": "point",
    "weights": "weights",
    "rate": "rate",
    "radius": "radius",
    "size": "size",
    "start": "start",
}
NAMES = {
    "sharp",
    "map",
    "descent",
    "contraction",
    "attraction",
    "escape",
    "word",
}  # lines that name statements, or pieces by number


def lines_of(text: str) -> list[tuple[str, str, str]]:
    r"""The lines after the first as (word, "math" or "text", content).

    >>> text = "statement a/b\nforall r\ngiven r > 0\nshow r^2 > 0"
    >>> lines_of(text)  # doctest: +NORMALIZE_WHITESPACE
    [('for all', 'math', '\\dot\\rho_0'), ('given', 'math', '\\dot\\rho_0 > 0'),
     ('then', 'math', '\\dot\\rho_0^2 > 0')]
    """
    found = []
    for line in text.splitlines()[1:]:
        keyword, _, said = line.partition(" ")
        if keyword in NAMES:
            found.append((keyword, "text", said))
        else:
            found.append((WORDS.get(keyword, keyword), "math", _content(keyword, said)))
    return list(_merged(found))


def _content(keyword: str, said: str) -> str:
    if keyword in ("forall", "integer", "exists", "over", "state"):
        return ",\\ ".join(map(glyph, said.split()))
    if keyword in ("let", "root", "number"):
        name, _, value = said.partition(" = ")
        rooted = re.fullmatch(r"(sqrt|root)\((.*)\)", value)
        if not rooted:
            return f"{glyph(name)} = {latex_of(value)}"
        if rooted.group(1) == "sqrt":
            return rf"{glyph(name)} = \sqrt{{{latex_of(rooted.group(2))}}}"
        polynomial, low, high = parts_of(rooted.group(2))
        held = rf"{latex_of(low)} \le {glyph(name)} \le {latex_of(high)}"
        return (
            rf"{glyph(name)}\ \text{{is the root"
            rf" of}}\ {latex_of(polynomial)}\ \text{{with}}\ {held}"
        )
    if keyword in ("iterates", "piece") and "->" in said:
        source, _, image = said.partition(" -> ")
        if keyword == "piece":
            return rf"{latex_of(source)} \;\mapsto\; ({', '.join(map(latex_of, parts_of(image)))})"
        return (
            rf"({', '.join(map(latex_of, parts_of(_bare(source))))}) \mapsto"
            rf" ({', '.join(map(latex_of, parts_of(_bare(image))))})"
        )
    if keyword == "after":
        count, _, image = said.partition(" -> ")
        return rf"{glyph(count)}:\ ({', '.join(map(latex_of, parts_of(_bare(image))))})"
    if keyword in ("point", "weights", "start"):
        return f"({', '.join(map(latex_of, parts_of(said)))})"
    return r"\text{never}" if keyword == "holds" and said == "0 = 1" else latex_of(said)


def _bare(text: str) -> str:
    return text[1:-1].rstrip(",") if text.startswith("(") and text.endswith(")") else text


def parts_of(text: str) -> list[str]:
    """What commas outside of brackets part."""
    parts, depth, start = list[str](), 0, 0
    for place, sign in enumerate(text):
        depth += (sign == "(") - (sign == ")")
        if sign == "," and not depth:
            parts.append(text[start:place].strip())
            start = place + 1
    return [*parts, text[start:].strip()]


def _merged(lines: list[tuple[str, str, str]]) -> Iterator[tuple[str, str, str]]:
    """Lines with the same word in a row as one; 0 < alpha < 1 as one formula."""
    place = 0
    while place < len(lines):
        word, kind, content = lines[place]
        held = [content]
        while (
            word != "then"
            and kind == "math"
            and place + 1 < len(lines)
            and lines[place + 1][:2] == (word, kind)
        ):
            place += 1
            held.append(lines[place][2])
        if held[:2] == [r"\alpha > 0", r"\alpha < 1"]:
            held[:2] = [r"0 < \alpha < 1"]
        yield word, kind, ",\\quad ".join(held)
        place += 1


def formulas_of(text: str) -> Iterator[tuple[str, str]]:
    """Every formula of a statement with its LaTeX, for comparison."""
    for line in text.splitlines()[1:]:
        keyword, _, said = line.partition(" ")
        if keyword in (
            "range",
            "given",
            "have",
            "with",
            "show",
            "domain",
            "holds",
            "space",
            "rank",
            "stage",
            "on",
            "rate",
            "radius",
            "size",
        ):
            yield said, latex_of(said)
        elif keyword in ("point", "weights", "start"):
            yield from ((part, latex_of(part)) for part in parts_of(said))
        elif keyword in ("let", "root", "number"):
            value = said.partition(" = ")[2]
            rooted = re.fullmatch(r"(?:sqrt|root)\((.*)\)", value)
            for part in parts_of(rooted.group(1)) if rooted else [value]:
                yield part, latex_of(part)
        elif keyword in ("piece", "iterates", "after") and "->" in said:
            source, _, image = said.partition(" -> ")
            for part in [
                *(parts_of(_bare(source)) if keyword != "after" else []),
                *parts_of(_bare(image)),
            ]:
                yield part, latex_of(part)
