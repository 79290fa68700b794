"""The map of the argument shows each claim once, and a line for each claim that it rests on."""

from __future__ import annotations

import re

import pytest

pytest.importorskip("matplotlib")

from juggleproof.drawing import drawing
from juggleproof.drawing.argument import Dot, map_of_argument
from juggleproof.papers.paper import opened
from juggleproof.reports.figures import what_claims_rest_on
from tests.reports.runs import contents

DOTS = (
    Dot("a", "1", "holds", ("b", "c")),
    Dot("b", "2", "false"),
    Dot("c", "1", "gap", ("b",)),
    Dot("d", "2", "holds", ("a",)),
)


def lines(svg: str) -> dict[tuple[str, str], float]:
    """The width of each line, by the claims that it joins."""
    found = re.findall(r'from-(\w)-to-(\w)"><path[^>]*stroke-width: ([\d.]+)', svg)
    return {(start, stop): float(width) for start, stop, width in found}


def test_every_claim_is_linked_and_every_line_drawn_holds() -> None:
    svg = drawing.svg(map_of_argument(DOTS), "map").decode()
    assert re.findall(r'<a href="#([^"]*)"><path', svg) == ["a", "c", "b", "d"]
    assert "_blank" not in svg
    assert lines(svg).keys() == {("a", "b"), ("a", "c"), ("c", "b"), ("d", "a")}
    assert len(set(lines(svg).values())) == 1


def test_what_belongs_to_the_theorem_is_bold_holds() -> None:
    drawn = lines(drawing.svg(map_of_argument(DOTS, "c"), "map").decode())
    bold = {pair for pair, width in drawn.items() if width > 1}
    assert bold == {("a", "b"), ("a", "c"), ("c", "b"), ("d", "a")}
    drawn = lines(drawing.svg(map_of_argument(DOTS, "d"), "map").decode())
    assert {pair for pair, width in drawn.items() if width > 1} == drawn.keys()
    alone = (*DOTS, Dot("e", "3", "holds", ("f",)), Dot("f", "3", "holds"))
    drawn = lines(drawing.svg(map_of_argument(alone, "d"), "map").decode())
    assert drawn["e", "f"] < drawn["d", "a"]


def test_claims_of_the_paper_rest_on_claims_holds() -> None:
    dots, theorem = what_claims_rest_on(contents().entries)
    of_paper = opened().theorem
    assert of_paper is not None and theorem == of_paper.claim
    below = {dot.name: dot.rests_on for dot in dots}
    assert list(below) == [entry.claim.id for entry in contents().entries]
    assert all(name in below for names in below.values() for name in names)
    assert theorem in below["s4.4-global"] and below["sB.4-e1"] == ("s3.3-e1",)
    assert below["sB.7-R"] == ("prop-1", "theorem-region")
