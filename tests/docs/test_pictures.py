"""The picture of README.md is the one that the program draws, on white."""

from __future__ import annotations

import pytest

from juggleproof.proofs.reports.figures import what_the_trap_shows
from tests.docs.pages import ROOT


def test_the_trap_is_what_the_program_draws_holds() -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    from juggleproof.scenes.figures import TABLE, drawing

    slug = "fig-trap"
    entry = next(one for one in TABLE if one.slug == slug)
    drawn = drawing.svg(entry.draw(*what_the_trap_shows()), slug).decode()
    on_white = drawn.replace("fill: none", "fill: #ffffff", 1)
    committed = (ROOT / f"docs/img/{slug}.svg").read_text(encoding="utf-8")
    assert committed == on_white, "run `make figure`"
