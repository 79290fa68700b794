"""The reports' tests, in all workers, share a folder of kept records of their own, as the runs of
one user would.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from juggleproof.proofs import kept as cache


@pytest.fixture(scope="session", autouse=True)
def kept_records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        base = tmp_path_factory.getbasetemp()
        kept = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "kept"
        kept.mkdir(exist_ok=True)
        patch.setenv(cache.VARIABLE, str(kept))
        yield
