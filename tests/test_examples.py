"""The examples in the docstrings of the package."""

from __future__ import annotations

import doctest
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "juggleproof"
FOLDERS = (PACKAGE, "benchmarks", "certificates", "proofs", "scenes", "symbolic")


def modules_with_examples() -> list[str]:
    """The modules whose text has an example, by name; none of them is imported."""
    found = []
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.py")):
            if ">>>" in path.read_text(encoding="utf-8"):
                parts = path.relative_to(ROOT).with_suffix("").parts
                names = [part for part in parts if part not in (PACKAGE, "__init__")]
                found.append(".".join([PACKAGE, *names]))
    return found


@pytest.mark.parametrize("name", modules_with_examples())
def test_the_examples_of_a_module_hold(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = doctest.testmod(import_module(name))
    assert result.attempted and not result.failed
