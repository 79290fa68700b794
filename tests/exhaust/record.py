"""The record of the stages: a line each, sorted, with its digest, CPU seconds and result."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

PATH = Path(__file__).with_name("record.tsv")
HEAD = "stage\tdigest\tCPU seconds\tresult"
PASSED, FAILED = "passed", "failed"


class Line(NamedTuple):
    """What a run of a stage came to, and the digest of what it depended on."""

    digest: str
    seconds: int
    result: str


def read(path: Path = PATH) -> dict[str, Line]:
    """The lines by stage; none where there is no record.

    Raises ValueError, which names the line, for one that is not as they are written.
    """
    if not path.exists():
        return {}
    head, *rows = path.read_text(encoding="utf-8").splitlines()
    if head != HEAD:
        raise ValueError(f"{path}: begins with {head[:60]!r}, not with {HEAD!r}")
    found: dict[str, Line] = {}
    for row in rows:
        cells = row.split("\t")
        if len(cells) != 4 or not cells[2].isdecimal() or cells[3] not in (PASSED, FAILED):
            raise ValueError(f"{path}: no line of a record: {row[:90]!r}")
        if cells[0] in found:
            raise ValueError(f"{path}: {cells[0]} has two lines")
        found[cells[0]] = Line(cells[1], int(cells[2]), cells[3])
    return found


def write(lines: Mapping[str, Line], path: Path = PATH) -> None:
    """Writes the record aside, and renames it."""
    rows = [f"{name}\t{one.digest}\t{one.seconds}\t{one.result}" for name, one in lines.items()]
    aside = path.with_name(f"{path.name}.{os.getpid()}")
    aside.write_text("".join(f"{row}\n" for row in (HEAD, *sorted(rows))), encoding="utf-8")
    aside.replace(path)
