"""The badge says what the verdicts say, in red where something is wrong."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from juggleproof.proofs.register import load_register
from juggleproof.proofs.reports.ci import BAD, GOOD, badge
from juggleproof.proofs.reports.results import Results
from tests.reports.runs import HOLDS, OPEN, gathered, own, paper


def read(results: Results) -> tuple[str, bool]:
    """What the badge says, and whether it is green."""
    content = badge(results)
    assert content == badge(results) and content.endswith(b"}\n")
    shown = json.loads(content)
    assert set(shown) == {"schemaVersion", "label", "message", "color"}
    assert shown["schemaVersion"] == 1 and shown["label"] == "juggleproof"
    assert shown["color"] in (GOOD, BAD)
    return shown["message"], shown["color"] == GOOD


def test_badge_of_the_paper_is_green_holds() -> None:
    assert read(paper()) == (f"theorem proved, {len(load_register())} claims, 0 unknown", True)
    assert badge(gathered()) == badge(paper())


def test_badge_is_red_where_something_is_wrong_holds(tmp_path: Path) -> None:
    register = {**load_register(), "eq-2": {"verdict": "holds"}}
    stated = paper().claims[0].statements[0].name
    for results, told in (
        (paper(register), "1 changed"),
        (replace(paper(), theorem=""), "theorem NOT proved"),
        (paper(rejected=[(stated, "no")]), "1 unknown"),
        (own(tmp_path, OPEN), "1 of 2 holds, 1 unknown"),
    ):
        said, is_green = read(results)
        assert told in said and not is_green
    assert read(own(tmp_path, HOLDS)) == ("1 of 1 holds, 0 unknown", True)
