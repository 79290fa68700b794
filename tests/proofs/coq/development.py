"""The Coq development compiled once for a test session, and single files compiled against it."""

from __future__ import annotations

import os
import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[3] / "proofs" / "coq"


def coqc() -> str:
    """The compiler; without one the tests skip and say so, except where CI is set."""
    found = shutil.which("coqc")
    if found is None:
        if os.environ.get("CI") == "true":
            pytest.fail("coqc is missing: Debian's package is called coq")
        pytest.skip(
            "no coqc here (Debian's package is called coq): nothing about the Coq development was"
            " tested"
        )
    return found


@cache
def order() -> tuple[str, ...]:
    """The files of the development in the order of _CoqProject."""
    return tuple(
        Path(row).name
        for row in (SOURCES / "_CoqProject").read_text().splitlines()
        if row.endswith(".v")
    )


def source(name: str) -> str:
    """The text of a file of the development, whichever folder it is in."""
    (path,) = SOURCES.glob(f"*/{name}")
    return path.read_text()


def compiled(folder: Path, name: str, text: str) -> subprocess.CompletedProcess[str]:
    """One file compiled in a folder that holds what it needs."""
    (folder / name).write_text(text)
    return subprocess.run(
        [coqc(), "-q", "-Q", ".", "Juggleproof", name],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=600,
    )


def build(folder: Path) -> Path:
    """The whole development compiled in the folder."""
    for name in order():
        result = compiled(folder, name, source(name))
        assert result.returncode == 0, (name, result.stderr)
    return folder
