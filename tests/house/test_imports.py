"""Imports run one way and make no circle, every package is this tree's, and files stay short."""

from __future__ import annotations

import importlib
import sys
from collections import Counter
from pathlib import Path

import pytest

from tests.house.graph import (
    NAME,
    PACKAGES,
    ROOT,
    Graph,
    circles,
    files,
    graph,
    imports_inside_functions,
    longest_chain,
    names_of,
)

MAY_IMPORT = {
    "symbolic": {"symbolic"},
    "certificates": {"certificates"},
    "scenes": {"scenes", "symbolic"},
    "proofs": {"proofs", "certificates", "symbolic", "scenes"},
    "benchmarks": set(PACKAGES),
}
MORE = {"proofs/command/bound.py": {"benchmarks"}}  # the only door
ALONE = {"checker", "certificates"}  # the names under which the two checkers run alone
FOREIGN = {
    "symbolic": {"sympy"},
    "certificates": {"z3", "flint", "highspy", "mpmath", "numpy"},
    "scenes": {"matplotlib", "sympy", "flint", "mpmath", "numba", "numpy"},
    "proofs": {"sympy", "numpy", "highspy", "rich", "pytest", "matplotlib", "jinja2"}
    | {"latex2mathml"},
    "benchmarks": {
        "sympy",
        "numpy",
        "flint",
        "mpmath",
        "z3",
        "cvc5",
        "cvxpy",
        "scipy",
        "matplotlib",
        "rich",
    },
}


# From the ground up: a module imports from its own floor and from those below.  The floor of a
# module is that of the longest name here that it begins with.
FLOORS = (
    ("symbolic", "certificates.checker"),
    ("certificates",),
    ("certificates.algebra", "scenes"),
    ("certificates.search.psatz",),
    ("certificates.search", "certificates.votes", "certificates.coq"),
    ("proofs.reading",),
    ("proofs",),
    ("proofs.paper", "proofs.theorem", "proofs.restitution", "proofs.part", "proofs.sine")
    + ("proofs.smtlib", "proofs.ledger"),
    ("proofs.reports", "proofs.api"),
    ("proofs.command", "proofs.pytest_plugin", "proofs.pytest_items"),
    ("benchmarks",),
)
UP = {  # arrows up that are left; nothing is added here
    ("proofs.command.bound", "benchmarks.bench.run"),  # the only door
}
CIRCLES: list[list[str]] = []  # circles that are left; nothing is added here
LONGEST = {"symbolic": 6, "certificates": 21, "scenes": 8, "proofs": 16, "benchmarks": 6}
MOST_FILES = 20
MOST_INSIDE = 20  # a ratchet; libraries of the optional extras count too


def short(module: str) -> str:
    return module.removeprefix(NAME + ".")


def floor(module: str) -> int:
    """The number of the floor of a module, such as `proofs.run`."""
    places = {begin: number for number, floor in enumerate(FLOORS) for begin in floor}
    parts = module.split(".")
    begins = [".".join(parts[:end]) for end in range(len(parts), 0, -1)]
    return next(places[begin] for begin in begins if begin in places)


def imported(path: Path) -> set[str]:
    """What a file imports, also inside functions: our modules in full, others by their first
    name.
    """
    names = {name for name in names_of(path) if not name.startswith(".")}
    return {name if name.split(".")[0] == NAME else name.split(".")[0] for name in names}


def ours(path: Path) -> set[str]:
    """The folders that a file imports from."""
    return {name.split(".")[1] for name in imported(path) if name.split(".")[0] == NAME}


def test_no_circle_of_imports_but_the_known_holds() -> None:
    found = [[short(module) for module in circle] for circle in circles(graph())]
    assert [circle for circle in found if circle not in CIRCLES] == []
    assert len(found) == len(CIRCLES), "a circle is gone: take it off the list"


def test_no_import_runs_up_but_the_known_holds() -> None:
    up = {
        (short(module), short(other))
        for module, others in graph().items()
        for other in others
        if floor(short(module)) < floor(short(other))
    }
    assert up - UP == set()
    assert UP - up == set(), "an arrow is gone: take it off the list"


def test_rejects_a_circle_and_an_arrow_up() -> None:
    edges: Graph = {
        "a": frozenset("b"),
        "b": frozenset("c"),
        "c": frozenset("a"),
        "d": frozenset("a"),
    }
    assert circles(edges) == [["a", "b", "c"]]
    assert circles({**edges, "c": frozenset()}) == []
    assert longest_chain({**edges, "c": frozenset()}) == ["d", "a", "b", "c"]
    assert floor("proofs.judging") < floor("proofs.reports.results") < floor("proofs.command.show")
    assert floor("proofs.reading.lexer") < floor("proofs.run") < floor("proofs.paper.names")


def test_imports_by_name_are_seen_holds() -> None:
    """Those of lazy packages, of the command's table, and of functions."""
    edges = {short(one): {short(other) for other in others} for one, others in graph().items()}
    assert "symbolic.corner_impact" in edges["symbolic"]
    assert {"proofs.command.certify", "proofs.command.explain"} <= edges["proofs.command.main"]
    assert "benchmarks.bench.solvers" in edges["benchmarks.bench.methods"]
    assert "benchmarks.bench.run" in edges["proofs.command.bound"]


@pytest.mark.parametrize("package", PACKAGES)
def test_chains_of_imports_stay_short_holds(package: str) -> None:
    knotted = {module for circle in CIRCLES for module in circle}
    within: dict[str, frozenset[str]] = {
        module: frozenset(
            other
            for other in others
            if other.split(".")[1] == package and short(other) not in knotted
        )
        for module, others in graph().items()
        if module.split(".")[1] == package
    }
    assert len(longest_chain(within)) <= LONGEST[package], longest_chain(within)


def test_few_imports_stand_inside_functions_holds() -> None:
    inside = [
        line
        for package in PACKAGES
        for path in files(package)
        for line in imports_inside_functions(path)
    ]
    assert len(inside) <= MOST_INSIDE, "\n".join(inside)


def test_folders_hold_few_files_holds() -> None:
    counts = Counter(
        path.parent.relative_to(ROOT).as_posix() for package in PACKAGES for path in files(package)
    )
    for folder, count in counts.items():
        assert count <= MOST_FILES, folder


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_run_one_way_holds(package: str) -> None:
    assert files(package)
    for path in files(package):
        more = MORE.get(path.relative_to(ROOT).as_posix(), set())
        assert ours(path) <= MAY_IMPORT[package] | more, path


@pytest.mark.parametrize("package", PACKAGES)
def test_only_known_libraries_are_imported_holds(package: str) -> None:
    for path in files(package):
        foreign = {name for name in imported(path) if not name.startswith(NAME + ".")}
        assert foreign - ALONE - sys.stdlib_module_names <= FOREIGN[package], path


@pytest.mark.parametrize("package", PACKAGES)
def test_packages_are_imported_from_this_tree_holds(package: str) -> None:
    module = importlib.import_module(f"{NAME}.{package}")
    assert Path(str(module.__file__)).resolve().parent == ROOT / package


@pytest.mark.parametrize("package", PACKAGES)
def test_files_stay_short_holds(package: str) -> None:
    for path in files(package):
        limit = 600 if path.parent.name == "checker" else 800  # a ratchet: 600 is the aim
        assert len(path.read_text(encoding="utf-8").splitlines()) <= limit, path
