"""Imports run one way, every package is this tree's, and files stay short."""

from __future__ import annotations

import ast
import importlib
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NAME = "juggleproof"  # the one import name that holds the folders
PACKAGES = ("symbolic", "certificates", "scenes", "proofs", "benchmarks")
MAY_IMPORT = {
    "symbolic": {"symbolic"},
    "certificates": {"certificates"},
    "scenes": {"scenes", "symbolic"},
    "proofs": {"proofs", "certificates", "symbolic", "scenes"},
    "benchmarks": set(PACKAGES),
}
MORE = {"proofs/command/bound.py": {"benchmarks"}}  # the only door
FOREIGN = {
    "symbolic": {"sympy"},
    "certificates": {"z3", "flint", "highspy", "mpmath", "numpy"},
    "scenes": {"matplotlib", "sympy", "flint", "mpmath", "numba", "numpy"},
    "proofs": {"sympy", "rich", "pytest", "matplotlib", "jinja2", "latex2mathml"},
    "benchmarks": {
        "sympy",
        "numpy",
        "flint",
        "mpmath",
        "z3",
        "cvc5",
        "scipy",
        "matplotlib",
        "rich",
    },
}


def modules(package: str) -> list[Path]:
    return sorted((ROOT / package).rglob("*.py"))


def imported(path: Path) -> set[str]:
    """What a file imports, also inside functions: our modules in full, others by their first
    name.
    """
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            if node.level:  # only the checker, which runs under two names, and in its own folder
                assert path.parent.name == "checker" and node.level == 1, path
                continue
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return {name if name.split(".")[0] == NAME else name.split(".")[0] for name in found}


def ours(path: Path) -> set[str]:
    """The folders that a file imports from."""
    return {name.split(".")[1] for name in imported(path) if name.split(".")[0] == NAME}


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_run_one_way_holds(package: str) -> None:
    assert modules(package)
    for path in modules(package):
        more = MORE.get(path.relative_to(ROOT).as_posix(), set())
        assert ours(path) <= MAY_IMPORT[package] | more, path


@pytest.mark.parametrize("package", PACKAGES)
def test_only_known_libraries_are_imported_holds(package: str) -> None:
    for path in modules(package):
        foreign = {name for name in imported(path) if not name.startswith(NAME + ".")}
        assert foreign - {"checker"} - sys.stdlib_module_names <= FOREIGN[package], path


@pytest.mark.parametrize("package", PACKAGES)
def test_packages_are_imported_from_this_tree_holds(package: str) -> None:
    module = importlib.import_module(f"{NAME}.{package}")
    assert Path(str(module.__file__)).resolve().parent == ROOT / package


@pytest.mark.parametrize("package", PACKAGES)
def test_files_stay_short_holds(package: str) -> None:
    for path in modules(package):
        limit = 700 if path.parent.name == "checker" else 800  # a ratchet: 600 is the aim
        assert len(path.read_text(encoding="utf-8").splitlines()) <= limit, path
