"""Tests of what loading the claims loads share a process that does."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import NamedTuple

import pytest


class Loaded(NamedTuple):
    """The claims of the paper in a process that loads them, and the modules that it loads."""

    claims: list[str]
    modules: list[str]


LOAD = """
import json, sys
import juggleproof.proofs.theorem.orbits, juggleproof.proofs.paper.s4_2_proposition  # before others
from juggleproof.proofs.paper import paper_claims
print(json.dumps([[one.id for one in paper_claims()], [*sys.modules]]))
"""


@pytest.fixture(scope="session")
def loaded_anew() -> Loaded:
    done = subprocess.run([sys.executable, "-c", LOAD], capture_output=True, text=True, check=True)
    return Loaded(*json.loads(done.stdout))
