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
    package_of,
)

MAY_IMPORT = {
    "symbolic": {"symbolic"},
    "certificates": {"certificates"},
    "juggleproof": {"juggleproof", "certificates"},
    "proofs": {"proofs", "certificates", "symbolic", "juggleproof"},
    "benchmarks": set(PACKAGES),
}
MORE = {
    "juggleproof/command/bound.py": {"benchmarks"},  # the only door
    "symbolic/__init__.py": {"juggleproof"},  # lazy names
    "juggleproof/scenes": {"symbolic"},  # the scenes iterate the maps that are derived there
}
ALONE = {"checker", "certificates"}  # the names under which the two checkers run alone
FOREIGN = {
    "symbolic": {"sympy"},
    "certificates": set(),
    "juggleproof": {"z3", "flint", "highspy", "mpmath", "numpy", "sympy", "rich", "pytest"}
    | {"matplotlib", "jinja2", "latex2mathml", "numba"},
    "proofs": {"sympy", "numpy", "matplotlib"},
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
    ("symbolic", "certificates", "folders", "lazy", "scenes.errors"),
    ("statements", "drawing"),
    ("algebra", "sine", "scenes"),
    ("search.psatz", "search.limits"),
    ("search", "votes", "coq_store"),
    ("reading", "encoding"),
    ("judging", "coq_orbits"),
    ("papers", "smtlib", "map_stability"),
    ("reports", "api"),
    ("command", "pytest_plugin", "pytest_items", NAME),
    ("proofs",),
    ("benchmarks",),
)
UP = {  # arrows up that are left; nothing is added here
    ("command.bound", "benchmarks.bench.run"),  # the only door
}
CIRCLES: list[list[str]] = []  # circles that are left; nothing is added here
LONGEST = {"symbolic": 6, "certificates": 10, "juggleproof": 27, "proofs": 16, "benchmarks": 6}
MOST_FILES = 20
MOST_INSIDE = 20  # a ratchet; libraries of the optional extras count too


def short(module: str) -> str:
    return module.removeprefix(NAME + ".")


def floor(module: str) -> int:
    """The number of the floor of a module, such as `judging.run`."""
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
    return {package_of(name) for name in imported(path) if name.split(".")[0] == NAME}


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
    assert floor("judging.judging") < floor("reports.results") < floor("command.show")
    assert floor("reading.lexer") < floor("judging.run") < floor("proofs.paper.names")


def test_imports_by_name_are_seen_holds() -> None:
    """Those of lazy packages, of the command's table, and of functions."""
    edges = {short(one): {short(other) for other in others} for one, others in graph().items()}
    assert "symbolic.corner_impact" in edges["symbolic"]
    assert {"command.certify", "command.explain"} <= edges["command.main"]
    assert "benchmarks.bench.solvers" in edges["benchmarks.bench.methods"]
    assert "benchmarks.bench.run" in edges["command.bound"]


@pytest.mark.parametrize("package", PACKAGES)
def test_chains_of_imports_stay_short_holds(package: str) -> None:
    knotted = {module for circle in CIRCLES for module in circle}
    within: dict[str, frozenset[str]] = {
        module: frozenset(
            other
            for other in others
            if package_of(other) == package and short(other) not in knotted
        )
        for module, others in graph().items()
        if package_of(module) == package
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
        place = path.relative_to(ROOT).as_posix()
        more = set().union(*(more for begin, more in MORE.items() if place.startswith(begin)))
        assert ours(path) <= MAY_IMPORT[package] | more, path


@pytest.mark.parametrize("package", PACKAGES)
def test_only_known_libraries_are_imported_holds(package: str) -> None:
    for path in files(package):
        foreign = {name for name in imported(path) if name.split(".")[0] != NAME}
        assert foreign - ALONE - sys.stdlib_module_names <= FOREIGN[package], path


@pytest.mark.parametrize("package", PACKAGES)
def test_packages_are_imported_from_this_tree_holds(package: str) -> None:
    module = importlib.import_module(package if package == NAME else f"{NAME}.{package}")
    assert Path(str(module.__file__)).resolve().parent == ROOT / package


@pytest.mark.parametrize("package", PACKAGES)
def test_files_stay_short_holds(package: str) -> None:
    for path in files(package):
        limit = 600 if path.parent.name == "checker" else 800  # a ratchet: 600 is the aim
        assert len(path.read_text(encoding="utf-8").splitlines()) <= limit, path
