"""The tests stand where what they test stands, and reach each other by name."""

from __future__ import annotations

import ast
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.house.graph import NAME, PACKAGES, ROOT, tree_of

TESTS = ROOT / "tests"
# What is no package: the house itself, the pages, the action, the long runs; and the tables of
# rules, a folder of cases for each rule of the checker, which is tested as one.
OTHERS = {
    "house",
    "docs",
    "action",
    "exhaust",
    "certificates/checker",
    "certificates/checker/rules",
}
UNTESTED = {"sine", "coq_store", "coq_orbits"}  # by tests/certificates/sine and tests/proofs/coq


def sources() -> Iterator[tuple[Path, ast.Module]]:
    for path in sorted(TESTS.rglob("*.py")):
        yield path, tree_of(path)


def test_tests_mirror_the_packages_holds() -> None:
    folders = {path.parent.relative_to(TESTS).as_posix() for path in TESTS.rglob("*.py")} - {"."}
    for folder in folders - OTHERS:
        places = ROOT / folder, ROOT / NAME / folder
        assert any(place.is_dir() for place in places), f"tests/{folder} tests no folder"
    tested = {folder.split("/")[0] for folder in folders}
    assert {*PACKAGES, *(path.name for path in (ROOT / NAME).iterdir() if path.is_dir())} <= {
        *tested,
        NAME,
        "__pycache__",
        *UNTESTED,
    }


def test_no_test_touches_sys_path_holds() -> None:
    for path, tree in sources():
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute):
                assert node.attr != "path" or ast.unparse(node) != "sys.path", (
                    f"{path}:{node.lineno}"
                )
            elif isinstance(node, ast.ImportFrom) and node.module == "sys":
                assert "path" not in {alias.name for alias in node.names}, f"{path}:{node.lineno}"


def test_tests_import_each_other_by_their_names_holds() -> None:
    for path, tree in sources():
        for node in ast.walk(tree):
            if not isinstance(node, ast.ImportFrom):
                continue
            assert not node.level, f"{path}: a relative import"
            if str(node.module).split(".")[0] == "tests":
                place = ROOT / str(node.module).replace(".", "/")
                assert place.with_suffix(".py").is_file() or place.is_dir(), (
                    f"{path}: {node.module}"
                )


def test_no_other_folder_is_committed_at_the_root() -> None:
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if listed.returncode:
        pytest.skip("no repository")
    folders = {line.split("/")[0] for line in listed.stdout.splitlines() if "/" in line}
    others = {"tests", "docs", "examples", ".ci", ".github"}
    assert folders == {*PACKAGES, *others}
