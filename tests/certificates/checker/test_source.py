"""The checker's own text: four files one on top of the other, the standard library, no float, no
assert, and how many lines of code.
"""

from __future__ import annotations

import ast
import io
import re
import sys
import tokenize
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind

FOLDER = Path(__file__).resolve().parents[3] / "certificates" / "checker"
ORDER = [
    "algebra",
    "text",
    "language",
    "rules",
    "maps",
    "orbits",
    "settling",
]  # each rests on those before it
FILES = {path.stem: path.read_text() for path in sorted(FOLDER.glob("*.py"))}
TREES = {name: ast.parse(source) for name, source in FILES.items()}
NODES = [node for tree in TREES.values() for node in ast.walk(tree)]
SILENT = (
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENDMARKER,
)


def code_lines(source: str) -> int:
    """The lines that hold code: no comments, no blank lines, no docstrings."""
    documented: set[int] = set()
    for node in ast.walk(ast.parse(source)):
        if (
            isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))
            and ast.get_docstring(node) is not None
        ):
            documented |= set(range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1))
    tokens = [
        token
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type not in SILENT
    ]
    return len(
        {line for token in tokens for line in range(token.start[0], token.end[0] + 1)} - documented
    )


def test_lines_of_code_are_counted_without_comments_and_docstrings() -> None:
    assert (
        code_lines(
            '"""One."""\n\n# two\ndef f():\n    """Three,\n    four."""\n    return (1,\n          '
            "  2)  # five\n"
        )
        == 3
    )


def test_there_are_at_most_2024_lines_of_code_with_all_rules() -> None:
    """Counted at 100 columns, all files and all rules; 77 lines are the table of kinds."""
    assert set(FILES) == {*ORDER, "__init__", "__main__"}
    assert sum(map(code_lines, FILES.values())) <= 2024


def test_only_the_standard_library_and_earlier_files_are_imported() -> None:
    modules = {alias.name for node in NODES if isinstance(node, ast.Import) for alias in node.names}
    for name, tree in TREES.items():
        froms = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        modules |= {str(node.module) for node in froms if node.level == 0}
        earlier = ORDER[: ORDER.index(name)] if name in ORDER else ORDER
        assert {node.module for node in froms if node.level} <= set(earlier), name
        assert {node.level for node in froms} <= {0, 1}
    modules.remove("checker")  # what __main__ runs
    allowed = {
        "__future__",
        "ast",
        "collections",
        "enum",
        "fractions",
        "functools",
        "hashlib",
        "gc",
        "json",
        "keyword",
        "math",
        "os",
        "re",
        "stat",
        "sys",
        "typing",
    }
    assert {name.split(".")[0] for name in modules} <= allowed
    assert {name.split(".")[0] for name in modules} <= set(sys.stdlib_module_names)


def test_imports_stand_at_the_top_of_each_file() -> None:
    for tree in TREES.values():
        inner = [node for top in tree.body for node in ast.walk(top) if node is not top]
        assert not [node for node in inner if isinstance(node, (ast.Import, ast.ImportFrom))]


def test_every_check_passes_its_meter_on() -> None:
    """A context or a proof without one would begin a meter of its own."""
    calls = [
        node
        for name in ("rules", "maps", "orbits", "settling")
        for node in ast.walk(TREES[name])
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    ]
    named = {"Context": 0, "prove": 0, "check_sharp": 0, "check_orbit_rule": 0}
    for node in calls:
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if name in named:
            arguments = [*node.args, *(keyword.value for keyword in node.keywords)]
            inner = name == "Context" and bool(node.args) and "None" != ast.unparse(node.args[0])
            assert inner or "work" in map(ast.unparse, arguments), ast.unparse(node)
            named[name] += 1
    assert all(named.values())


def test_every_kind_of_rejection_is_raised_and_has_a_case() -> None:
    raised = "\n".join(source for name, source in FILES.items() if name in ORDER)
    cases = "\n".join(path.read_text() for path in Path(__file__).parent.rglob("*.py"))
    assert len(Kind) == len(Kind.__members__)  # two of one text would be one kind
    for kind in Kind:
        assert re.search(rf"\bKind\.{kind.name}\b", raised), kind
        assert re.search(rf"\b(Kind\.{kind.name})\b", cases), kind


def test_the_public_names_are_there() -> None:
    """And no other name is there but the package's own and those of its files."""
    names = {name for name in vars(checker) if not name.startswith(("__", "@"))}  # @: pytest's
    assert names == {*checker.__all__, *ORDER}
    assert len(set(checker.__all__)) == len(checker.__all__)


def test_no_float_and_no_complex_number() -> None:
    constants = [node.value for node in NODES if isinstance(node, ast.Constant)]
    assert not [value for value in constants if isinstance(value, (float, complex))]
    names = {node.id for node in NODES if isinstance(node, ast.Name)}
    assert not names & {"float", "complex", "Decimal", "round", "divmod"}
    assert not {node.attr for node in NODES if isinstance(node, ast.Attribute)} & {
        "sqrt",
        "log",
        "exp",
        "hypot",
        "fsum",
        "limit_denominator",
    }


def test_no_assert_and_nothing_that_runs_text() -> None:
    assert not [node for node in NODES if isinstance(node, ast.Assert)]
    called = {
        node.func.id
        for node in NODES
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    assert not called & {
        "eval",
        "exec",
        "compile",
        "__import__",
        "getattr",
        "setattr",
        "globals",
        "vars",
        "input",
    }
    assert not any("__debug__" in source for source in FILES.values())


@pytest.mark.parametrize("kind", [ast.FunctionDef, ast.ClassDef])
def test_every_rule_is_stated_where_it_is_applied(
    kind: type[ast.FunctionDef] | type[ast.ClassDef],
) -> None:
    named = {
        node.name: ast.get_docstring(node)
        for tree in TREES.values()
        for node in tree.body
        if isinstance(node, kind)
    }
    rules = {
        name: said
        for name, said in named.items()
        if name.startswith(("close", "check_", "find", "prove", "settle", "adjoin"))
        or name[0].isupper()
    }
    assert rules
    assert not [name for name, said in rules.items() if not said]
