"""Mutants of a statement: one coefficient, sign, exponent or relation changed in a given or in what
is shown.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

RELATIONS = {
    "<": ("<=", ">"),
    "<=": ("<", ">="),
    ">": (">=", "<"),
    ">=": (">", "<="),
    "=": ("<=", "!="),
    "!=": ("=",),
}
TOKEN = re.compile(r"\^\d+|\d+|<=|>=|!=|->|[<>=]| [+-] |[A-Za-z]\w*|.")


def mutants(text: str, keywords: tuple[str, ...] = ("given", "show")) -> Iterator[tuple[str, str]]:
    """(what was changed, the changed statement) for every single change of a number, sign, exponent
    or relation.
    """
    lines = text.splitlines()
    for row, line in enumerate(lines):
        keyword, _, said = line.partition(" ")
        if keyword not in keywords:
            continue
        for start, end, new in changes(said):
            changed = f"{keyword} {said[:start]}{new}{said[end:]}"
            yield (
                f"{keyword}: {said[start:end].strip()} becomes {new.strip()} at {start}",
                "\n".join([*lines[:row], changed, *lines[row + 1 :]]),
            )


def changes(said: str) -> Iterator[tuple[int, int, str]]:
    """(start, end, replacement) for every change of one formula."""
    for match in TOKEN.finditer(said):
        token = match[0]
        if token in RELATIONS:
            for other in RELATIONS[token]:
                yield match.start(), match.end(), other
        elif token in (" + ", " - "):
            yield match.start(), match.end(), " - " if token == " + " else " + "
        elif token[0] == "^":
            yield match.start(), match.end(), f"^{int(token[1:]) + 1}"
        elif token.isdigit():
            yield match.start(), match.end(), str(int(token) + 1)
