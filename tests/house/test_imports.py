"""Imports run one way, every package is this tree's, and files stay short."""

from __future__ import annotations

import ast
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("symbolic", "certificates", "scenes", "proofs", "benchmarks")
MAY_IMPORT = {
    "symbolic": {"symbolic"},
    "certificates": {"certificates"},
    "scenes": {"scenes", "symbolic"},
    "proofs": {"proofs", "certificates", "symbolic", "scenes"},
    "benchmarks": set(PACKAGES),
}
MORE = {"proofs/command/bench.py": {"benchmarks"}}  # the only door
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
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module.split(".")[0])
    return found


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_run_one_way_holds(package: str) -> None:
    assert modules(package)
    for path in modules(package):
        assert imported(path) & set(PACKAGES) <= MAY_IMPORT[package] | MORE.get(
            path.relative_to(ROOT).as_posix(), set()
        ), path


@pytest.mark.parametrize("package", PACKAGES)
def test_only_known_libraries_are_imported_holds(package: str) -> None:
    import sys

    for path in modules(package):
        foreign = {
            name
            for name in imported(path)
            if name not in sys.stdlib_module_names and name not in PACKAGES
        }
        if path.match("checker/__main__.py"):
            foreign.remove("checker")  # the folder itself, run alone
        assert foreign <= FOREIGN[package], (path, foreign)


@pytest.mark.parametrize("package", PACKAGES)
def test_packages_are_imported_from_this_tree_holds(package: str) -> None:
    module = importlib.import_module(package)
    assert Path(str(module.__file__)).resolve().parent == ROOT / package


@pytest.mark.parametrize("package", PACKAGES)
def test_files_stay_short_holds(package: str) -> None:
    for path in modules(package):
        limit = 700 if path.parent.name == "checker" else 350
        assert len(path.read_text(encoding="utf-8").splitlines()) <= limit, path
