"""What can be imported from `juggleproof` itself is there, and has the type of what is loaded; what
is needed for it is pinned, and told where it is absent.
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator
from importlib import import_module

import pytest

import juggleproof
from juggleproof.judging.extras import EXTRAS
from tests.house.graph import NAME, ROOT, tree_of

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def typed() -> Iterator[tuple[str, tuple[str, str]]]:
    """The names for type checkers, each with its file and its name there."""
    (choice,) = (
        node for node in tree_of(ROOT / NAME / "__init__.py").body if isinstance(node, ast.If)
    )
    assert ast.unparse(choice.test) == "TYPE_CHECKING"
    folders = {}
    for node in choice.body:
        if isinstance(node, ast.ImportFrom):
            file = str(node.module).removeprefix(f"{NAME}.")
            for one in node.names:
                folders[one.name] = file
                if one.asname:
                    yield one.asname, (file, one.name)
        else:
            assert isinstance(node, ast.Assign)
            (names,) = node.targets
            for name, place in zip(
                ast.unparse(names)[1:-1].split(", "),
                ast.unparse(node.value)[1:-1].split(", "),
                strict=True,
            ):
                module, _, inner = place.partition(".")
                yield name, (f"{folders[module]}.{module}", inner)


def test_names_have_the_types_of_what_is_loaded_holds() -> None:
    names = dict(typed())
    assert names == juggleproof.FILES and {"certify", "run_part"} <= set(names)
    for name, (file, place) in names.items():
        there = getattr(import_module(f"{NAME}.{file}"), place)
        assert getattr(juggleproof, name) is there and name in dir(juggleproof)


def test_rejects_a_name_that_is_not_there() -> None:
    with pytest.raises(AttributeError, match="no attribute 'certifies'"):
        _ = juggleproof.certifies


def pinned(lock: str) -> set[str]:
    """The distributions that a lock file pins, with those of the files that it begins with."""
    lines = (ROOT / lock).read_text(encoding="utf-8").split("\n")
    above = [line.removeprefix("-r ") for line in lines if line.startswith("-r ")]
    own = {line.partition("==")[0].lower() for line in lines if "==" in line}
    return own.union(*map(pinned, above))


def named(requirements: list[str]) -> set[str]:
    return {re.split(r"[<>=]", one)[0].lower() for one in requirements}


def test_locks_pin_what_the_project_names_and_certifying_needs_no_more_holds() -> None:
    extras = PROJECT["optional-dependencies"]
    core = named(PROJECT["dependencies"])
    assert core <= pinned("requirements.lock")
    assert named(extras["report"] + extras["part"]) <= pinned("requirements-report.lock")
    assert named(extras["test"]) <= pinned("requirements-test.lock")
    for extra in ("docs", "peers"):
        assert named(extras[extra]) <= pinned(f"requirements-{extra}.lock")
    others = named([one for extra in extras.values() for one in extra])
    assert not pinned("requirements.lock") & others


def test_what_is_told_to_install_is_what_the_extras_need_holds() -> None:
    for extra, told in EXTRAS.items():
        assert set(told.split()) == named(PROJECT["optional-dependencies"][extra])
