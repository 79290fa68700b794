"""The tool names no paper: what is this paper's own stands in the folder `proofs`."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import juggleproof
from tests.house.paper_words import WORDS

ROOT = Path(juggleproof.__file__).parent
SUFFIXES = (".py", ".j2", ".css", ".js", ".bib", ".json")
# the moving systems that the tool simulates, with the commands for them, and `sine` and stability,
# which have systems of their own
APART = (
    "scenes",
    "sine",
    "map_stability",
    "command/juggler",
    "command/simulate_",
    "command/sine.py",
)
ALLOWED = {  # words of files with some lines about scenes
    "__init__.py": {"juggler"},
    "command/__init__.py": {"juggler"},
    "command/main.py": {"juggler", "restitution", "bounce"},
    "drawing/look.py": {"B1", "B2"},
    "reading/evaluation.py": {r"\dot\rho", r"\mathcal{B"},  # an example
    "reading/tree.py": {r"\mathcal{B"},  # examples
}


def texts(path: Path) -> Iterator[str]:
    """What a file says: its text; of a Python file, its code and comments without examples."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        yield text
        return
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docs = [
        ast.get_docstring(node, False) or ""
        for node in ast.walk(ast.parse(text))
        if isinstance(node, documented)
    ]
    for doc in docs:
        text = text.replace(doc, doc.partition(">>>")[0]) if doc else text
    yield text


def found(path: Path) -> set[str]:
    return {one for text in texts(path) for one in WORDS.findall(text)}


def sources() -> dict[str, Path]:
    every = {path.relative_to(ROOT).as_posix(): path for path in ROOT.rglob("*")}
    return {
        name: path
        for name, path in every.items()
        if path.suffix in SUFFIXES and not name.startswith(APART)
    }


def test_no_word_of_the_paper_stands_in_the_tool_holds() -> None:
    read = sources()
    assert len(read) > 100 and "reports/templates/page.html.j2" in read
    of_paper = {name: found(path) - ALLOWED.get(name, set()) for name, path in read.items()}
    assert {name: words for name, words in of_paper.items() if words} == {}


def test_rejects_a_word_of_the_paper(tmp_path: Path) -> None:
    said = '"""Says.\n\n>>> 1  # juggler\n"""\nR = "restitution"\n'
    words = {"one.py": said, "two.j2": "B1 by Swanson"}
    for name, text in words.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert found(tmp_path / "one.py") == {"restitution"}
    assert found(tmp_path / "two.j2") == {"B1", "Swanson"}
