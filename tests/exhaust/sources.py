"""What a stage of `make exhaust` depends on, found from the text of the files: the closure of its
modules' imports, and the data that stands beside them or that they name.

Every import counts, wherever it stands.  A module that is only named in a string counts as well:
whole ("juggleproof.judging.run", also inside a longer text), or in parts where the file imports by
name or is a package ("run" or ".run").  More is found than is loaded, and nothing less; a test
watches what a stage opens.  Prose is never among it: the pages of docs, what ends in .md, and in a
module its comments and the docstrings of what has no decorator.
"""

from __future__ import annotations

import ast
import io
import re
import subprocess
import tokenize
from collections.abc import Iterable, Iterator
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from tests.exhaust.record import PATH

ROOT = Path(__file__).resolve().parents[2]
NAME = "juggleproof"
PACKAGES = ("symbolic", "certificates", "proofs", "benchmarks")
NAMED = re.compile(rf"\b(?:{NAME}|tests)(?:\.\w+)+")
MARK = "pytest.mark.exhaust"
RECORD = PATH.relative_to(
    ROOT
).as_posix()  # no stage depends on it: it is written as stages are done
DEFINED = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
# what a module opens as data, by a name that it does not write out
OPENS = {"juggleproof.papers.paper": "juggleproof.proofs"}
BY_NAME = ("import_module", "lazy_names", "__import__")


def committed(root: Path) -> list[str]:
    """The files that git knows below a folder and that are still there, in order."""
    told = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root,
        capture_output=True,
        text=True,
        check=True,
    )
    paths = (root / name for name in told.stdout.split("\0") if name)
    return sorted(path.relative_to(root).as_posix() for path in paths if path.is_file())


class Facts(NamedTuple):
    """What a module says: its strings, docstrings apart; what its import statements name, and those
    that run when it is loaded; whether it may import by name; whether it marks tests as long.
    """

    words: frozenset[str]
    imports: frozenset[str]
    loads: frozenset[str]
    by_name: bool
    marked: bool


class Sources:
    """The files of a tree, the modules among them, and what each module leads to."""

    def __init__(self, root: Path = ROOT, files: Iterable[str] | None = None) -> None:
        self.root = root
        self.files = sorted(committed(root) if files is None else files)
        self.modules = {name: file for file in self.files if (name := module_of(file))}
        self.kept_imports: dict[str, frozenset[str]] = {}
        self.kept_loads: dict[str, frozenset[str]] = {}
        self.kept_digests: dict[str, str] = {}
        self.kept_facts: dict[str, Facts] = {}

    def read(self, module: str) -> Facts:
        """What a module says."""
        if module not in self.kept_facts:
            file = self.modules[module]
            text = (self.root / file).read_text(encoding="utf-8")
            self.kept_facts[module] = facts_of(text, module, is_package(file))
        return self.kept_facts[module]

    def words(self, module: str) -> frozenset[str]:
        """The strings that stand in a module, docstrings apart."""
        return self.read(module).words

    def whole(self, name: str) -> str | None:
        """The module that a name in full begins with, the longest."""
        while name and name not in self.modules:
            name = name.rpartition(".")[0]
        return name or None

    def imports(self, module: str) -> frozenset[str]:
        """The modules that a module names, in import statements and in strings."""
        if module not in self.kept_imports:
            found = {self.whole(name) for name in self.named(module)} | {
                self.whole(OPENS.get(module, ""))
            }
            self.kept_imports[module] = frozenset(one for one in found if one) - {module}
        return self.kept_imports[module]

    def named(self, module: str) -> Iterator[str]:
        facts = self.read(module)
        yield from facts.imports
        for word in facts.words:
            yield from NAMED.findall(word)
        if facts.by_name:
            package = package_of(module, self.modules[module])
            begins = {package, NAME, *(word for word in facts.words if word in self.modules)}
            for word in facts.words:
                last = word.partition(":")[0].lstrip(".")
                yield from (name for one in begins if (name := f"{one}.{last}") in self.modules)

    def loads(self, module: str) -> frozenset[str]:
        """The modules that a module imports when it is loaded, which leaves out its functions and
        what is for type checkers, and the packages that these stand in.
        """
        if module not in self.kept_loads:
            names = self.read(module).loads
            found = {one for name in names if (one := self.whole(name))}
            above = {one for name in {module, *found} for one in self.above(name)}
            self.kept_loads[module] = frozenset(found | above)
        return self.kept_loads[module]

    def above(self, module: str) -> Iterator[str]:
        """The packages that a module stands in."""
        while module := module.rpartition(".")[0]:
            if module in self.modules:
                yield module

    def closure(self, entries: Iterable[str]) -> tuple[set[str], set[str]]:
        """(modules that are named from the entries on, all that are loaded): what is loaded only
        because a package is passed on the way to a module inside it is in the second alone.

        Raises KeyError for an entry that is no module of the tree.
        """
        left, named, every = list(entries), set[str](), set[str]()
        while left:
            module = left.pop()
            if module not in named:
                named.add(module)
                left += self.imports(module)
        left = [*named]
        while left:
            module = left.pop()
            if module not in every:
                every.add(module)
                left += self.loads(module)
        return named, every

    def data(self, modules: Iterable[str]) -> set[str]:
        """The files that are no modules and stand beside these, or that they name."""
        modules = set(modules)
        folders = {self.modules[module].rpartition("/")[0] for module in modules}
        segments = {
            part for module in modules for word in self.words(module) for part in word.split("/")
        }
        return {
            file
            for file, name in self.plain.items()
            if file.rpartition("/")[0] in folders or name in segments
        }

    @cached_property
    def plain(self) -> dict[str, str]:
        """The files that are no modules and no prose, each with the name that leads to it: of the
        highest folder above it that holds no module, else its own.
        """
        holding = {str(one) for file in self.modules.values() for one in Path(file).parents}
        names = {}
        for file in self.files:
            if not module_of(file) and not is_prose(file):
                within = [one.name for one in Path(file).parents if str(one) not in holding]
                names[file] = within[-1] if within else Path(file).name
        return names

    def depends_on(self, entries: Iterable[str], more: Iterable[str] = ()) -> list[str]:
        """The files of a stage that begins with these modules, and those named beside; in order."""
        named, every = self.closure(entries)
        files = {self.modules[one] for one in every} | self.data(named) | set(more)
        return sorted(files - {RECORD})

    def digest(self, files: Iterable[str], *said: str) -> str:
        """A digest of files, names and content, and of what is said beside them."""
        whole = sha256(repr(said).encode())
        for file in sorted(files):
            if file not in self.kept_digests:
                content = (self.root / file).read_bytes()
                if file.endswith(".py"):
                    content = without_prose(content.decode()).encode()
                self.kept_digests[file] = sha256(content).hexdigest()
            whole.update(f"\n{file} {self.kept_digests[file]}".encode())
        return whole.hexdigest()[:24]


def package_of(module: str, file: str) -> str:
    return module if is_package(file) else module.rpartition(".")[0]


def is_package(file: str) -> bool:
    return file.endswith("/__init__.py")


def is_prose(file: str) -> bool:
    """Whether a file is read by people alone, so that no stage is asked for when it changes."""
    return file.startswith("docs/") or file.endswith(".md") or file == "CITATION.cff"


def module_of(file: str) -> str:
    """The name under which a file of the tree is imported; "" where it is no module of ours.

    >>> module_of("juggleproof/reading/__init__.py"), module_of("juggleproof/__init__.py")
    ('juggleproof.reading', 'juggleproof')
    >>> module_of("tests/share.py"), module_of("examples/skew-tent.py")
    ('tests.share', '')
    """
    parts = Path(file).with_suffix("").parts
    if not file.endswith(".py") or parts[0] not in (*PACKAGES, NAME, "tests"):
        return ""
    parts = parts[:-1] if parts[-1] == "__init__" else parts
    return ".".join(parts if parts[0] in (NAME, "tests") else (NAME, *parts))


def without_prose(text: str) -> str:
    """A module without comments, blank lines, and the docstrings of what has no decorator: a
    decorator may read the docstring, as that of a claim does.

    >>> without_prose("# why\\nx = 1  # one\\n\\ndef f():\\n    'Return 1.'\\n    return 1\\n")
    'x = 1\\ndef f():\\n    return 1\\n'
    """
    lines = text.splitlines(keepends=True)
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Module) or isinstance(node, DEFINED) and not node.decorator_list:
            first = node.body[0] if node.body else None
            if isinstance(first, ast.Expr) and ast.get_docstring(node) is not None:
                begin, end = first.lineno, first.end_lineno or first.lineno
                if not lines[begin - 1][: first.col_offset].strip():
                    lines[begin - 1 : end] = [""] * (end - begin + 1)
    return "".join(f"{line.rstrip()}\n" for line in lines if line.strip())


def facts_of(text: str, module: str, package: bool) -> Facts:
    """What stands in the text of a module."""
    begin = module if package else module.rpartition(".")[0]
    words: set[str] = set()
    imports: set[str] = set()
    loads: set[str] = set()
    marked = False
    left: list[tuple[ast.AST, bool]] = [(ast.parse(text), True)]
    while left:
        node, runs = left.pop()
        if isinstance(node, ast.Constant):
            if isinstance(node.value, str):
                words.add(node.value)
            continue
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            names = set(names_in(node, begin))
            imports |= names
            loads |= names if runs else set()
            continue
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue  # a docstring
        if isinstance(node, ast.Attribute):
            marked = marked or node.attr == "exhaust" and ast.unparse(node) == MARK
        within = runs and not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            left += [(inner, False) for inner in node.body]
            left += [(inner, within) for inner in node.orelse]
            continue
        for field in node._fields:
            value = getattr(node, field, None)
            if isinstance(value, ast.AST):
                left.append((value, within))
            elif isinstance(value, list):
                left += [(inner, within) for inner in value if isinstance(inner, ast.AST)]
    by_name = package or any(way in text for way in BY_NAME)
    return Facts(frozenset(words), frozenset(imports), frozenset(loads), by_name, marked)


def names_in(node: ast.Import | ast.ImportFrom, package: str) -> Iterator[str]:
    """What an import statement names, in full, in a file of a package."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    else:
        begin = package.split(".")
        above = begin[: len(begin) + 1 - node.level] if node.level else []
        module = ".".join([*above, *filter(None, [node.module])])
        yield from (f"{module}.{alias.name}" for alias in node.names)
