"""The index says of each claim what its source says, and `list` imports no claim."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.ledger import index
from juggleproof.proofs.paper import paper_claims

LOADED = """import sys
from juggleproof.proofs.command.main import run
code = run(["list"])
print(code, [m for m in ("sympy", "rich", "z3", "juggleproof.proofs.paper") if m in sys.modules],
      file=sys.stderr)
"""


def test_the_index_is_what_the_sources_say_holds() -> None:
    """`juggleproof certify --accept` writes it anew."""
    assert index.load_index() == index.index_of(paper_claims())


def test_list_imports_no_claim_and_no_solver_holds() -> None:
    done = subprocess.run(
        [sys.executable, "-c", LOADED], capture_output=True, text=True, check=True
    )
    assert done.stderr == "0 []\n"
    assert len(done.stdout.splitlines()) == len(index.load_index())


def test_rejects_an_index_that_cannot_be_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(index, "PATH", tmp_path / "index.json")
    for text in (None, "[{", ""):
        if text is not None:
            index.PATH.write_text(text)
        with pytest.raises(ClaimError, match="no index .*certify --accept"):
            index.load_index()
