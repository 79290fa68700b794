"""Tests that make reports share a folder of kept records of their own, in all workers, as the runs
of one user would; tests of what loading the claims loads share a process that does.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from typing import NamedTuple

import pytest

from juggleproof.proofs import kept


@pytest.fixture(scope="module")
def kept_records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        base = tmp_path_factory.getbasetemp()
        folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "kept"
        folder.mkdir(exist_ok=True)
        patch.setenv(kept.VARIABLE, str(folder))
        yield


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
