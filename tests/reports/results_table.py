"""The table of results, as it stands in the pages, as the entries of a report."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace

from juggleproof.papers.paper import opened

RESULTS = Path(__file__).resolve().parents[2] / "docs/results.md"
ROW = re.compile(r"\| <a.*</a>([\w.-]+) \| [^|]* \| \[?(\w+)[^|]* \| [^|]* \| `?([^|`]*)`? \|")


def results() -> list[SimpleNamespace]:
    """Entries as in the table of results: id, verdict and range; with the claim of each, and no
    certificates.
    """
    claims = opened().claims_by_id
    found = [ROW.fullmatch(line) for line in RESULTS.read_text(encoding="utf-8").splitlines()]
    return [
        SimpleNamespace(
            claim=claims[one[1]], verdict=one[2], sharp=one[3], rests_on=(), statements=()
        )
        for one in found
        if one
    ]
