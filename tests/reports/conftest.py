"""The reports' tests share a folder of kept records of their own, as the runs of one user would."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from proofs import cache


@pytest.fixture(scope="session", autouse=True)
def kept_records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(cache.VARIABLE, str(tmp_path_factory.mktemp("kept")))
        yield
