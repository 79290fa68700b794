"""Machine code of the part is kept for one run of the suite, so that the processes which tests start need not compile it again."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator

import pytest

_kept = tempfile.TemporaryDirectory()
_before = os.environ.get("JUGGLEPROOF_CACHE")
os.environ["JUGGLEPROOF_CACHE"] = _kept.name
try:
    import scenes.part.compiling  # noqa: F401
finally:
    if _before is None:
        del os.environ["JUGGLEPROOF_CACHE"]
    else:
        os.environ["JUGGLEPROOF_CACHE"] = _before


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Processes started meanwhile use that machine code."""
    monkeypatch.setenv("JUGGLEPROOF_CACHE", _kept.name)
    yield
