"""A claim with stored certificates is judged without a search, and without what searches need."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from juggleproof.statements.store import DEFAULT
from tests.house.graph import ROOT

SEARCHES = ("juggleproof.search", "juggleproof.votes")
TOOLS = {"z3", "highspy", "flint", "numpy", "mpmath", "sympy"}
CODE = """
import json, pathlib, sys
from juggleproof.papers.paper import opened
from juggleproof.judging.run import judge_some
claims = opened().claims_by_id
(judged,) = judge_some([claims["eq-37"]], claims, pathlib.Path(sys.argv[1]))
print(json.dumps([judged.verdict.word, sorted(sys.modules)]))
"""


def loaded(folder: Path) -> set[str]:
    """What a judgement of eq-37 by the certificates of a folder has loaded of these."""
    done = subprocess.run(
        [sys.executable, "-c", CODE, folder], cwd=ROOT, capture_output=True, text=True, check=True
    )
    verdict, modules = json.loads(done.stdout)
    assert verdict == "holds"
    return {name for name in modules if name in TOOLS or name.startswith(SEARCHES)}


@pytest.mark.parametrize("stored", [True, False])
def test_only_a_judgement_without_certificates_loads_a_search_holds(
    stored: bool, tmp_path: Path
) -> None:
    found = loaded(DEFAULT if stored else tmp_path)
    assert found == set() if stored else {*SEARCHES, "z3", "flint"} <= found
