"""Results as named columns: written as CSV, NPZ or Parquet, shown in a notebook, and as a frame of
pandas.
"""

from __future__ import annotations

import csv
import io
from base64 import b64encode
from collections.abc import Sequence
from html import escape
from importlib import import_module
from types import ModuleType
from typing import Any, BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError

FORMS = (".csv", ".npz", ".parquet")
SHOWN = 12  # rows of a table in a notebook


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


class Shown:
    """A result with a title, named columns of one length, and mostly a picture."""

    def title(self) -> str:
        """What it is, in a line."""
        raise NotImplementedError

    def columns(self) -> Sequence[Column]:
        """Its columns."""
        raise NotImplementedError

    def picture(self) -> bytes | None:
        """Its picture, as SVG; None where it has none, SceneError without matplotlib."""
        return None

    def to_pandas(self) -> Any:
        """The columns as a frame of pandas; SceneError, one line, where pandas is absent."""
        frame = optional("pandas", "a data frame").DataFrame
        return frame({one.name: one.values for one in self.columns()})

    def write(self, file: BinaryIO, form: str) -> None:
        """Writes the columns as .csv, .npz or .parquet; SceneError for another form, and for
        Parquet without pyarrow.
        """
        if form not in FORMS:
            raise SceneError(f"{form[:20]!r} is no form of columns: choose from {', '.join(FORMS)}")
        {".csv": _csv, ".npz": _npz, ".parquet": _parquet}[form](self.columns(), file)

    def _repr_html_(self) -> str:
        """Title, the first rows and the picture, for a notebook."""
        columns, title = self.columns(), self.title()
        count = len(columns[0].values)
        rows = [_row(one.head() for one in columns).replace("td>", "th>")]
        rows += [_row(_short(one.values[k]) for one in columns) for k in range(min(count, SHOWN))]
        more = f"<p>and {count - SHOWN} more rows</p>" if count > SHOWN else ""
        try:
            drawn = self.picture()
            data = b64encode(drawn).decode() if drawn else ""
            source = f"data:image/svg+xml;base64,{data}"  # whose ids no other picture has
            picture = f'<img src="{source}" alt="{escape(title)}">' if drawn else ""
        except SceneError as absent:
            picture = f"<p>{escape(str(absent))}</p>"
        return f"<p>{escape(title)}</p><table>{''.join(rows)}</table>{more}{picture}"


def optional(library: str, purpose: str) -> ModuleType:
    """A library that is not always there; SceneError, which says how to install it, where it is
    not.
    """
    try:
        return import_module(library)
    except ImportError:
        raise SceneError(
            f"{library} is needed for {purpose}; install it with pip install {library}"
        ) from None


def graphs() -> ModuleType:
    """The module that draws; SceneError without matplotlib."""
    optional("matplotlib", "a picture")
    return import_module("juggleproof.scenes.part.graphs")


def _row(cells: Any) -> str:
    return "<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in cells) + "</tr>"


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _csv(columns: Sequence[Column], file: BinaryIO) -> None:
    """A line a row; floats to the last bit, nothing for what is not a number."""
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow([one.head() for one in columns])
    cells = ([_cell(value) for value in one.values.tolist()] for one in columns)
    lines.writerows(zip(*cells))
    text.detach()


def _cell(value: float | int | bool | str) -> str:
    if isinstance(value, float):
        return repr(value) if np.isfinite(value) else ""
    return str(int(value)) if isinstance(value, bool) else str(value)


def _npz(columns: Sequence[Column], file: BinaryIO) -> None:
    np.savez_compressed(file, allow_pickle=False, **{one.name: one.values for one in columns})


def _parquet(columns: Sequence[Column], file: BinaryIO) -> None:
    arrow = optional("pyarrow", "Parquet")
    made = [arrow.array(one.values) for one in columns]
    fields = [
        arrow.field(one.name, array.type, metadata={"unit": one.unit})
        for one, array in zip(columns, made)
    ]
    table = arrow.Table.from_arrays(made, schema=arrow.schema(fields))
    optional("pyarrow.parquet", "Parquet").write_table(table, file)
