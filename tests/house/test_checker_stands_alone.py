"""The checker stands alone: others use its public names only, and change nothing of it."""

from __future__ import annotations

import ast
import doctest
import re
from collections.abc import Iterator, Set
from functools import cache
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from tests.house.graph import PACKAGES, ROOT, tree_of

FOLDER = "certificates/checker"
WHOLE = "juggleproof.certificates.checker"
# The checker's own tests look inside; so do this one, and those of its description.
ITS_TESTS = (
    "tests/certificates/checker",
    "tests/docs/test_language.py",
    "tests/house/test_checker_stands_alone.py",
)
METER = {"left", "work"}  # of a Work, and of what holds one
MENTIONS = r"checker|\.(left|work)\s*([-+*/]?=[^=]|,)|setattr|\bdel\b"  # itself, or a meter changed


@cache
def others() -> list[Path]:
    """The Python files outside the checker and its tests that name it, or may change a meter."""
    paths = (path for top in (*PACKAGES, "tests") for path in sorted((ROOT / top).rglob("*.py")))
    return [
        path
        for path in paths
        if not path.relative_to(ROOT).as_posix().startswith((FOLDER, *ITS_TESTS))
        and re.search(MENTIONS, path.read_text(encoding="utf-8"))
    ]


@cache
def with_examples(tree: ast.Module) -> list[ast.AST]:
    """The nodes of a file and of the examples in its docstrings."""
    texts = [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and ">>> " in node.value
    ]
    examples = [one for text in texts for one in doctest.DocTestParser().get_examples(text)]
    trees = [tree, *(ast.parse(example.source) for example in examples)]
    return [node for each in trees for node in ast.walk(each)]


def names_one(node: ast.AST, names: Set[str]) -> bool:
    """Whether the node is one of these names, and no more."""
    return isinstance(node, ast.Name) and node.id in names


def targets(node: ast.AST) -> Iterator[ast.Attribute]:
    """The attributes that a statement, or a call of `setattr`, assigns to or deletes.  Not those
    that pytest puts back: a test may put a double in place of a function that others call.
    """
    if isinstance(node, ast.Attribute) and isinstance(node.ctx, (ast.Store, ast.Del)):
        yield node
    if isinstance(node, ast.Call) and names_one(node.func, {"setattr"}):
        object_, *names = node.args
        name = names[0].value if names and isinstance(names[0], ast.Constant) else ""
        yield ast.Attribute(object_, str(name), ast.Store())


def trespasses(tree: ast.Module) -> list[str]:
    """What a file uses of the checker beyond its public names, and what it changes of it."""
    public, found = set(checker.__all__), []
    nodes, modules = with_examples(tree), set()
    for node in nodes:
        if isinstance(node, ast.Import):
            found += [one.name for one in node.names if one.name.startswith(WHOLE)]
        elif isinstance(node, ast.ImportFrom) and node.module == WHOLE.rpartition(".")[0]:
            modules |= {one.asname or one.name for one in node.names if one.name == "checker"}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith(WHOLE):
            allowed = public if node.module == WHOLE else set()
            found += [f"{node.module}.{one.name}" for one in node.names if one.name not in allowed]
    for node in nodes:
        if isinstance(node, ast.Attribute) and names_one(node.value, modules):
            found += [] if node.attr in public else [ast.unparse(node)]
        if isinstance(node, ast.ClassDef):  # a meter of one's own would count as one pleases
            meters = {"Work", *(f"{module}.Work" for module in modules)}
            found += [node.name for base in node.bases if ast.unparse(base) in meters]
        for target in targets(node) if isinstance(node, (ast.Attribute, ast.Call)) else ():
            owner = ast.unparse(target.value)
            metered = target.attr in METER and owner != "self"
            if metered or owner.split(".")[0] in modules:
                found.append(ast.unparse(target))
    return found


def test_others_use_its_public_names_only_and_change_nothing_holds() -> None:
    found = {str(path.relative_to(ROOT)): trespasses(tree_of(path)) for path in others()}
    assert {path: names for path, names in found.items() if names} == {}
    assert len(others()) > 20  # else nothing was looked at


PARTS = {"State", "close", "find", "prove", "verdict"}  # of a check


def parts_used(tree: ast.Module) -> set[str]:
    """The parts of a check that a file asks for."""
    return {
        node.attr
        for node in with_examples(tree)
        if isinstance(node, ast.Attribute)
        and node.attr in PARTS
        and names_one(node.value, {"checker"})
    }


def test_its_states_and_rules_are_asked_for_in_one_place_holds() -> None:
    inside = {
        node.name
        for node in tree_of(ROOT / FOLDER / "rules.py").body
        if isinstance(node, (ast.FunctionDef, ast.ClassDef))
    }
    assert {"State", "state_of", "close", "find", "prove", "adjoin", "check_sharp"} <= inside
    assert inside & set(checker.__all__) == PARTS - {"verdict"}
    assert not {"settle", "ORBIT_RULES"} & set(checker.__all__)
    users = {str(path.relative_to(ROOT)): parts_used(tree_of(path)) for path in others()}
    assert {path: parts for path, parts in users.items() if parts} == {
        "juggleproof/statements/states.py": PARTS
    }


IMPORT = "from juggleproof.certificates import checker\n"


@pytest.mark.parametrize(
    "text",
    [
        IMPORT + "checker.state_of(unfolding)",
        "from juggleproof.certificates import checker as c\nc.rules.close(state, node, known)",
        IMPORT + 'def f():\n    """\n    >>> checker.check_sharp(statement, proof, {})\n    """',
        "from juggleproof.certificates.checker import adjoin",
        "from juggleproof.certificates.checker.rules import close",
        "import juggleproof.certificates.checker.rules",
        IMPORT + "checker.check_one = print",
        IMPORT + "setattr(checker, 'check_one', print)",
        IMPORT + "state.context.work.left = checker.MAX_WORK",
        IMPORT + "work.left += 1",
        IMPORT + "poly.work = checker.Work()",
        IMPORT + "class Meter(checker.Work):\n    pass",
    ],
)
def test_rejects_what_trespasses(text: str) -> None:
    assert trespasses(ast.parse(text))


def test_what_is_public_may_be_used_holds() -> None:
    text = IMPORT + "checker.check_one(statement, certificate, {}, {})\nself.left = checker.Work()"
    assert trespasses(ast.parse(text)) == []
