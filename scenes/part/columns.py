"""Results as named columns: printed as a table, written as CSV, and drawn."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any, BinaryIO, NamedTuple, Protocol

from numpy.typing import NDArray


class Column(NamedTuple):
    """One column: its name, its unit, "" where it has none, and its values, one a row."""

    name: str
    unit: str
    values: NDArray[Any]

    def head(self) -> str:
        """Name and unit, as the head of a column of text.

        >>> Column("t", "s", np.zeros(1)).head(), Column("part", "", np.zeros(1)).head()
        ('t [s]', 'part')
        """
        return f"{self.name} [{self.unit}]" if self.unit else self.name


class Shown(Protocol):
    """A result with a title, named columns of one length, and a picture."""

    def title(self) -> str:
        """Return what it is, in a line."""
        ...

    def columns(self) -> Sequence[Column]:
        """Return its columns."""
        ...

    def picture(self) -> bytes:
        """Return its picture as SVG, drawn by matplotlib."""
        ...


def write_csv(columns: Sequence[Column], file: BinaryIO) -> None:
    """Writes a line a row, with floats to the last bit."""
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow([one.head() for one in columns])
    lines.writerows(zip(*(one.values.tolist() for one in columns)))
    text.detach()
