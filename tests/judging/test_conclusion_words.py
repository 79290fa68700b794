"""The words of results stand in one file: who says that something is proved, names a constant of
the file that makes sentences from certified statements.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from juggleproof.judging import conclusions
from tests.rows import each_row

ROOT = Path(conclusions.__file__).resolve().parents[2]
WORD = re.compile(r"(?<!/)\b(stable|attracts?|proved|refuted)\b")
SOURCE = ROOT / "juggleproof/judging/conclusions.py"
# what the paper's claims say in their own words, and the statements that a second checker reads
CONTENT = (
    *("proofs/paper", "proofs/theorem", "proofs/restitution", "proofs/part", "proofs/sine"),
    *("proofs/__init__", "proofs/ledger", "certificates/sine", "juggleproof/sine"),
    *("juggleproof/coq_store", "juggleproof/coq_orbits"),
)


def sources() -> Iterator[Path]:
    """The files of the tool."""
    for folder in ("juggleproof", "proofs", "certificates"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            if path != SOURCE and not str(path.relative_to(ROOT)).startswith(CONTENT):
                yield path


def sentences_in(text: str) -> list[str]:
    """The texts of a file that have a word of results and others beside it; no docstrings, and no
    keys of data.

    >>> sentences_in('x = f"{e} is stable"')
    ['{} is stable']
    >>> sentences_in('x = f"{e} is {STABLE}"; y = data["refuted"]')
    []
    """
    nodes = [*ast.walk(ast.parse(text))] if WORD.search(text) else []
    apart = {id(one.value) for one in nodes if isinstance(one, ast.Expr)}
    for node in nodes:
        apart |= {id(one) for one in node.values} if isinstance(node, ast.JoinedStr) else set()
    found = []
    for node in nodes:
        if isinstance(node, ast.JoinedStr):
            parts = (p.value if isinstance(p, ast.Constant) else "{}" for p in node.values)
            found.append("".join(map(str, parts)))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found += [] if id(node) in apart else [node.value]
    return [one for one in found if WORD.search(one) and " " in one.strip()]


def test_no_other_file_writes_the_words_of_results_holds() -> None:
    found = {str(path.relative_to(ROOT)): sentences_in(path.read_text()) for path in sources()}
    assert {path: texts for path, texts in found.items() if texts} == {}
    assert "juggleproof/map_stability/findings.py" in found


@each_row("text", ['print("it is proved")', 'print(f"{e} attracts all")', 'x = ["not " "stable"]'])
def test_rejects_a_sentence_about_a_result(text: str) -> None:
    assert sentences_in(text)
