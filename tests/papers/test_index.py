"""The index says of each claim what its source says, and `list` imports no claim."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from juggleproof.papers import index
from juggleproof.papers.paper import opened

LOADED = """import sys
from juggleproof.command.main import run
code = run(["list"])
names = ("sympy", "rich", "z3", "juggleproof.proofs.paper.names")
print(code, [one for one in names if one in sys.modules], file=sys.stderr)
"""
ONE = """import sys
from juggleproof.papers.paper import opened
from juggleproof.proofs.paper import SECTIONS
claim = opened().claims_by_id["eq-37"]
print(claim.id, [one for one in SECTIONS if f"juggleproof.proofs.paper.{one}" in sys.modules])
"""


def test_the_index_is_what_the_sources_say_holds() -> None:
    """`juggleproof certify --accept` writes it anew."""
    assert index.load_index(opened().modules) == index.index_of(opened().claims())


def test_list_imports_no_claim_and_no_solver_holds() -> None:
    done = subprocess.run(
        [sys.executable, "-c", LOADED], capture_output=True, text=True, check=True
    )
    assert done.stderr == "0 []\n"
    assert len(done.stdout.splitlines()) == len(opened().claims_by_id)


def test_an_index_that_is_not_of_the_sources_is_not_read_holds(tmp_path: Path) -> None:
    """Where it is of other sources, is no index, or is missing, the claims are loaded."""
    modules, path = opened().modules, tmp_path / "index.json"
    stored = json.loads(index.PATH.read_text())
    assert stored["sources"] == index.digest_of(modules) != index.digest_of(modules[1:])
    stored["claims"][0]["says"] = "Anything."
    path.write_text(json.dumps(stored))
    assert index.load_index(modules, path)[0]["says"] == "Anything."
    for text in (json.dumps({**stored, "sources": "0"}), "[{", "[]", None):
        path.unlink()
        if text is not None:
            path.write_text(text)
        assert index.load_index(modules, path) == index.index_of(opened().claims())


def test_a_claim_that_is_asked_for_loads_its_module_alone_holds() -> None:
    done = subprocess.run([sys.executable, "-c", ONE], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["eq-37", "['a1_a2_energy']"]
