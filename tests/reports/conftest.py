"""All tests of this folder make reports."""

from __future__ import annotations

import pytest


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_records: None) -> None:
    """With the records that other tests keep."""
