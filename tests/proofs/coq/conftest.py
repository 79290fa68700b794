"""One coqtop, and in it one development, for all tests of this folder."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from juggleproof.coq_store import PRELUDE
from tests.proofs.coq.development import Coq, build


@pytest.fixture(scope="session")
def coq(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Coq]:
    """Coq with the library of the reals."""
    process = Coq(tmp_path_factory.mktemp("coq"))
    yield process
    process.end()


@pytest.fixture(scope="session")
def development(coq: Coq) -> Coq:
    """Coq with all files of the development as modules."""
    return build(coq)


@pytest.fixture(scope="session")
def prelude(coq: Coq) -> Coq:
    """Coq with what every exported file has, as a module."""
    assert coq.tell("Prelude", PRELUDE).accepted
    return coq
