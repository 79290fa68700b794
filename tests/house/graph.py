"""Which module of ours imports which: at the top of a file, inside its functions, for types only,
and by `import_module` with a literal or with names from a table in the same file.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAME = "juggleproof"  # the one import name that holds the folders
PACKAGES = ("symbolic", "certificates", "juggleproof", "proofs", "benchmarks")
Graph = Mapping[str, frozenset[str]]


def files(package: str) -> list[Path]:
    """The Python files of a folder, in order."""
    return sorted((ROOT / package).rglob("*.py"))


def module_of(path: Path) -> str:
    """The name under which a file is imported, such as `juggleproof.judging.run`."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    inner = parts[1:] if parts[0] == NAME else parts
    return ".".join((NAME, *(inner[:-1] if inner[-1] == "__init__" else inner)))


def package_of(module: str) -> str:
    """The folder at the top in which a module stands.

    >>> package_of("juggleproof.judging.run"), package_of("juggleproof.proofs.paper.names")
    ('juggleproof', 'proofs')
    """
    first = [*module.split("."), ""][1]
    return first if first in PACKAGES else NAME


@cache
def tree_of(path: Path) -> ast.Module:
    """The parsed file."""
    return ast.parse(path.read_text(encoding="utf-8"))


def names_in(tree: ast.AST) -> Iterator[str]:
    """What import statements name, also inside functions: each name in full."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            begin = "." * node.level + (node.module or "")
            yield from (f"{begin}.{alias.name}" for alias in node.names)


@cache
def names_of(path: Path) -> tuple[str, ...]:
    """What the import statements of a file name."""
    return tuple(names_in(tree_of(path)))


def loaded_by_name(path: Path) -> Iterator[str]:
    """What `import_module` may load: its literal, or a beginning with each string of the file after
    it, up to a colon (as in "module:function"); and the files of a lazy package.
    """
    text = path.read_text(encoding="utf-8")
    if "import_module" not in text and "lazy_names" not in text:
        return
    tree = tree_of(path)
    package = module_of(path.with_name("__init__.py"))
    words = {
        node.value.partition(":")[0]
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and called(node) == "lazy_names":
            yield from (package + word for word in words if word.startswith("."))
        if not (isinstance(node, ast.Call) and called(node) == "import_module" and node.args):
            continue
        argument = node.args[0]
        if isinstance(argument, ast.Constant):
            yield str(argument.value)
        else:
            begin = beginning(argument, module_of(path))
            yield from (begin + word for word in words)


def called(node: ast.Call) -> str:
    """The last part of the name that is called."""
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def beginning(argument: ast.expr, here: str) -> str:
    """What stands in an f-string before its last value; nothing for any other expression."""
    if not isinstance(argument, ast.JoinedStr):
        return ""
    parts = [
        str(part.value) if isinstance(part, ast.Constant) else here for part in argument.values
    ]
    return "".join(parts[:-1])


@cache
def graph() -> Graph:
    """What each module imports of ours; `from package import module` is an import of the module."""
    paths = {module_of(path): path for package in PACKAGES for path in files(package)}
    found = {}
    for module, path in paths.items():
        here = module_of(path.with_name("__init__.py"))
        absolute = (here + name if name[0] == "." else name for name in names_of(path))
        named = {*absolute, *loaded_by_name(path)}
        ends = {name if name in paths else name.rpartition(".")[0] for name in named}
        found[module] = frozenset((ends & set(paths)) - {module, NAME})
    return found


def circles(edges: Graph) -> list[list[str]]:
    """The sets of modules that import one another, each sorted (Tarjan's algorithm)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(module: str) -> None:
        index[module] = low[module] = len(index)
        stack.append(module)
        for other in sorted(edges[module]):
            if other not in index:
                visit(other)
            if other in stack:
                low[module] = min(low[module], low[other])
        if low[module] == index[module]:
            at = stack.index(module)
            if len(stack) > at + 1:
                found.append(sorted(stack[at:]))
            del stack[at:]

    for module in sorted(edges):
        if module not in index:
            visit(module)
    return sorted(found)


def longest_chain(edges: Graph) -> list[str]:
    """The longest chain of imports, where there are no circles."""
    chain: dict[str, list[str]] = {}

    def below(module: str) -> list[str]:
        if module not in chain:
            chains = [below(other) for other in sorted(edges[module])]
            chain[module] = [module, *max(chains, key=len, default=[])]
        return chain[module]

    return max((below(module) for module in sorted(edges)), key=len)


def imports_inside_functions(path: Path) -> list[str]:
    """What a file imports inside its functions, each import statement once."""
    inner = {
        node
        for function in ast.walk(tree_of(path))
        if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef))
        for node in ast.walk(function)
        if isinstance(node, (ast.Import, ast.ImportFrom))
    }
    return [
        f"{path.relative_to(ROOT).as_posix()}: {', '.join(names_in(node))}"
        for node in sorted(inner, key=lambda node: node.lineno)
    ]
