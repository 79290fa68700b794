"""Mutants of the checker: its text with one operator, constant, condition or line changed.

Left as they are: what a message says, how much work a step counts (a call of `spend` is only
removed), and the limits (`MAX_..`), which are choices.
"""

from __future__ import annotations

import ast
import copy
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3] / "certificates" / "checker"
FILES = ("algebra", "text", "language", "rules", "maps", "orbits", "settling")
EXCHANGED: dict[type[ast.AST], type[ast.AST]] = {
    **{ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.FloorDiv: ast.Mult},
    **{ast.Mod: ast.Mult, ast.Pow: ast.Mult, ast.LShift: ast.RShift, ast.RShift: ast.LShift},
    **{ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd, ast.BitXor: ast.BitAnd},
    **{ast.And: ast.Or, ast.Or: ast.And},
    **{ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt},
}
NAMES = {"any": "all", "all": "any", "min": "max", "max": "min"}
OPERATORS = (ast.operator, ast.cmpop, ast.boolop)
ALIASES = ("Rational", "Formula", "Check")  # types
REMOVED = (ast.Expr, ast.Raise, ast.Delete, ast.AugAssign, ast.Continue, ast.Break)


@dataclass(frozen=True)
class Mutant:
    """One change: `new` takes the place of what stands in a field of `parent`."""

    key: str  # file.function: old -> new, numbered where several read the same
    file: str
    function: str  # "" outside of all
    names: set[str]  # outside of all: what the changed line defines
    parent: ast.AST
    field: str
    new: object


def parsed() -> dict[str, ast.Module]:
    return {name: ast.parse((FOLDER / f"{name}.py").read_text()) for name in FILES}


def mutants(trees: dict[str, ast.Module]) -> list[Mutant]:
    """Every mutant of the checker, in the order of its text."""
    found = []
    counts: Counter[str] = Counter()
    for file, tree in trees.items():
        for line in tree.body:
            names = assigned(line)
            for function, parent, field, old, new in changes(line, ""):
                around = f"{shown(parent)}: " if isinstance(old, OPERATORS) else ""
                key = f"{file}.{function}: {around}{shown(old)} -> {shown(new)}"
                counts[key] += 1
                key += f" #{counts[key]}" if counts[key] > 1 else ""
                value = getattr(parent, field)
                if isinstance(value, list):
                    put = [] if new is None else [new]
                    new = [one for part in value for one in (put if part is old else [part])]
                found.append(Mutant(key, file, function, names, parent, field, new))
    return found


def assigned(line: ast.stmt) -> set[str]:
    """The names that a line of a file defines, functions and classes apart."""
    return {
        node.id
        for node in ast.walk(line)
        if isinstance(line, (ast.Assign, ast.AnnAssign))
        and isinstance(node, ast.Name)
        and isinstance(node.ctx, ast.Store)
    }


def shown(node: ast.AST | None) -> str:
    if node is None:
        return "nothing"
    if isinstance(node, OPERATORS):
        return type(node).__name__
    return " ".join(ast.unparse(node).split())[:70]


Change = tuple[str, ast.AST, str, ast.AST, "ast.AST | None"]


def changes(node: ast.AST, function: str) -> Iterator[Change]:
    """(function, parent, field, what stands there, what takes its place) of everything inside."""
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        if node.name == "Kind":
            return
        function = f"{function}.{node.name}" if function else node.name
    if silent(None, node):
        return
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "targets", "target"):
            continue
        for one in value if isinstance(value, list) else [value]:
            if not isinstance(one, ast.AST) or silent(node, one):
                continue
            for new in replacements(node, field, one):
                yield function, node, field, one, new
            yield from changes(one, function)


def silent(parent: ast.AST | None, node: ast.AST) -> bool:
    """Whether nothing is changed here: a docstring, a message, an amount of work, a limit."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return True
    if isinstance(node, (ast.Import, ast.ImportFrom, ast.JoinedStr)):
        return True
    if isinstance(node, ast.Assign):
        names = ast.unparse(node.targets[0])
        return names.startswith(("MAX_", "PER_", "__slots__")) or names in ALIASES
    if isinstance(parent, ast.Call) and node is not parent.func:
        called = ast.unparse(parent.func)
        place = parent.args.index(node) if node in parent.args else 0  # type: ignore[arg-type]
        least = {"require": 2, "Rejected": 1}.get(called.split(".")[-1], 9)
        return called.endswith(".spend") or place >= least
    return False


def replacements(parent: ast.AST, field: str, node: ast.AST) -> Iterator[ast.AST | None]:
    if isinstance(node, REMOVED):
        yield ast.Pass()
    if type(node) in EXCHANGED:
        yield EXCHANGED[type(node)]()
    tested = field == "test" or field == "ifs"
    if isinstance(node, ast.Compare) or tested and not isinstance(node, ast.BoolOp):
        joined = parent.op if isinstance(parent, ast.BoolOp) else None
        yield from [ast.Constant(True)] * (not isinstance(joined, ast.And))
        yield from [ast.Constant(False)] * (not isinstance(joined, ast.Or))
    if isinstance(node, ast.BoolOp):
        for k in range(len(node.values)):
            rest = node.values[:k] + node.values[k + 1 :]
            yield ast.BoolOp(node.op, rest) if len(rest) > 1 else rest[0]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.Not, ast.USub)):
        yield node.operand
    if isinstance(node, ast.Constant) and type(node.value) is int:
        yield ast.Constant(node.value + 1)
        if node.value:
            yield ast.Constant(node.value - 1)
    if isinstance(node, ast.Constant) and type(node.value) is bool:
        yield ast.Constant(not node.value)
    if isinstance(parent, ast.Slice):
        yield None
    if isinstance(node, ast.Name) and node.id in NAMES and field == "func":
        yield ast.Name(NAMES[node.id], ast.Load())
    if isinstance(node, ast.keyword) and ast.unparse(node.value) != "work":
        yield None
    if isinstance(node, ast.Attribute) and ast.unparse(node) == "re.ASCII":
        yield ast.Constant(0)
    several = isinstance(parent, ast.Compare) or isinstance(parent, ast.ExceptHandler)
    several = several or isinstance(parent, ast.Call) and "isinstance" == ast.unparse(parent.func)
    if several and isinstance(node, (ast.Tuple, ast.Set)):
        for k in range(len(node.elts)):
            fewer = copy.copy(node)
            fewer.elts = node.elts[:k] + node.elts[k + 1 :]
            yield fewer
