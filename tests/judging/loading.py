"""What loading the claims of the paper loads."""

from __future__ import annotations

import json
import subprocess
import sys
from functools import cache
from typing import NamedTuple


class Loaded(NamedTuple):
    """The claims of the paper in a process that loads them, and the modules that it loads."""

    claims: list[str]
    modules: list[str]


LOAD = """
import json, sys
import juggleproof.proofs.theorem.orbits, juggleproof.proofs.paper.s4_2_proposition  # before others
from juggleproof.papers.paper import opened
print(json.dumps([[one.id for one in opened().claims()], [*sys.modules]]))
"""


@cache
def loaded_anew() -> Loaded:
    """What a process of its own loads; one for all tests."""
    done = subprocess.run([sys.executable, "-c", LOAD], capture_output=True, text=True, check=True)
    return Loaded(*json.loads(done.stdout))
