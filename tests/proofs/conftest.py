"""Tests that make reports share a folder of kept records of their own, in all workers, as the runs
of one user would.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

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
