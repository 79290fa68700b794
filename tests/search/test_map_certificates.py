"""The certificates that the checker's tests of map rules read are those that the search finds."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.certificates.checker.maps import FOUND


@pytest.mark.exhaust
def test_certificates_of_maps_are_those_that_the_search_finds_holds(tmp_path: Path) -> None:
    again = tmp_path / "again.json"
    command = [sys.executable, "-m", "tests.search.map_certificates", str(again)]
    subprocess.run(command, check=True, capture_output=True)
    assert again.read_bytes() == FOUND.read_bytes()
