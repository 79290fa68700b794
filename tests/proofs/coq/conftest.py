"""One compiled development for all tests of this folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.proofs.coq.development import build, coqc


@pytest.fixture(scope="session")
def development(tmp_path_factory: pytest.TempPathFactory) -> Path:
    coqc()
    return build(tmp_path_factory.mktemp("coq"))
