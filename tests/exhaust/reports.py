"""A report is the same to the byte when it is made again, without what the first has kept and with
it.

python -m tests.exhaust.reports FORMAT
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

from juggleproof.command.main import run
from juggleproof.judging import report_cache


def made(form: str, folder: Path) -> dict[str, bytes]:
    """The files of a report by name; what it keeps is kept beside them.

    Raises ValueError where it is not made.
    """
    os.environ[report_cache.VARIABLE] = str(folder / "kept")
    if run(["report", "--format", form, "-o", str(folder / "made")]) != 0:
        raise ValueError(f"no report as {form}")
    paths = (path for path in (folder / "made").rglob("*") if path.is_file())
    return {path.relative_to(folder / "made").as_posix(): path.read_bytes() for path in paths}


def main(form: str) -> int:
    """Makes it three times; returns 1 where two differ."""
    with tempfile.TemporaryDirectory() as folder:
        first, *others = (made(form, Path(folder, name)) for name in ("1", "2", "1"))
    differ = sorted(
        name
        for other in others
        for name in {*first, *other}
        if first.get(name, b"") != other.get(name, b"")
    )
    for name in differ:
        print(f"{name} differs from run to run")
    return int(bool(differ) or not first)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
