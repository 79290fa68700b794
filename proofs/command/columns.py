"""A table as plain columns, one row a line, or drawn on a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def plain(rows: Sequence[Sequence[str]]) -> str:
    """The rows, the first being the heads, in columns two blanks apart.

    >>> print(plain([("n", "x"), ("10", "1/3")]))
    n   x
    10  1/3
    """
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows
    )


def draw(heads: Sequence[str], rows: Sequence[Sequence[str]], console: Any) -> None:
    """Draws the table on a terminal; plain columns where there is none."""
    if not console.is_terminal:
        print(plain([heads, *rows]))
        return
    from rich.table import Table

    table = Table(*heads, header_style="bold")
    for row in rows:
        table.add_row(*(cell.replace("[", r"\[") for cell in row))
    console.print(table)
