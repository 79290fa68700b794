"""The badge says what the verdicts say, in red where something is wrong, and loads nothing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from juggleproof.proofs.register import load_register
from juggleproof.proofs.reports.ci import BAD, GOOD, NAME, badge
from juggleproof.proofs.reports.results import Results
from tests.proofs.reports.runs import HOLDS, OPEN, gathered, own, paper

SVG = "{http://www.w3.org/2000/svg}"


def read(results: Results) -> tuple[str, bool]:
    """What the badge says, and whether it is green."""
    content = badge(results)
    assert content == badge(results)
    root = ElementTree.fromstring(content)
    title = root.find(f"{SVG}title")
    assert title is not None and root.get("role") == "img" and root.get("aria-label") == title.text
    assert {node.tag for node in root.iter()} == {
        SVG + name for name in ("svg", "title", "rect", "path", "g", "text")
    }
    assert not any(
        "href" in name or "url(" in value or "http" in value
        for node in root.iter()
        for name, value in node.attrib.items()
    )
    shown = [str(node.text) for node in root.iter(f"{SVG}text")]
    assert ": ".join(shown) == title.text
    fills = {node.get("fill") for node in root.iter(f"{SVG}path")}
    assert fills in ({GOOD}, {BAD})
    return shown[1], fills == {GOOD}


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


@pytest.mark.parametrize("colour", [GOOD, BAD, NAME])
def test_white_on_the_badge_is_legible_holds(colour: str) -> None:
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    )
    assert 1.05 / (0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.05) >= 4.5
