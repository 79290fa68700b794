"""Another paper's folder does as well: one with two claims, no theorem, no figures and no hooks is
certified, listed, explained and reported, without a word of the paper of this project.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from tests.house.paper_words import WORDS

DESCRIBED = """
from juggleproof.papers.paper import Paper, Publication

PAPER = Paper(
    modules=("circles.areas",),
    publication=Publication("On circles", "A. Author", 1900, "Circles", "a circle has an area"),
    appendices={"A": "Areas"},
    headings={"A.1": "Squares"},
)
"""
CLAIMS = '''
from juggleproof import always, claim, reals

radius, side = reals("radius side")


@claim("square-about-a-circle", section="1.1", place="sentence 1")
def square():
    """The square about a circle has a greater area than the square in it."""
    return always(4 * radius**2 > 2 * radius**2, given=[radius > 0])


@claim("side-and-half", section="A.1", place="sentence 2")
def half():
    """A side is more than its half."""
    return always(side > side / 2)
'''
OPENS = """
import sys
from pathlib import Path

here = Path(sys.argv.pop(1))
sys.path.insert(0, str(here))
from juggleproof import folders

folders.PACKAGE, folders.FOLDER = "circles", here / "circles"
folders.REGISTER, folders.LEDGER = here / "circles" / "register.json", here / "circles" / "ledger"
from juggleproof.statements import store

store.DEFAULT = here / "store"
from juggleproof.command.main import run

sys.exit(run())
"""
Run = Callable[..., str]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("second")
    for name in ("circles", "circles/ledger", "store"):
        (place / name).mkdir()
    (place / "circles" / "__init__.py").write_text(DESCRIBED, encoding="utf-8")
    (place / "circles" / "areas.py").write_text(CLAIMS, encoding="utf-8")
    return place


@pytest.fixture(scope="module")
def run(folder: Path) -> Run:
    """A command on this paper, whose claims are registered; returns what it prints."""

    @cache
    def command(*options: str) -> str:
        done = subprocess.run(
            [sys.executable, "-c", OPENS, str(folder), *options],
            capture_output=True,
            text=True,
            check=True,
            cwd=folder,
            env={**os.environ, "JUGGLEPROOF_CACHE": "off"},
        )
        return done.stdout

    command("certify", "--accept")
    return command


def test_no_word_of_this_paper_is_printed_of_another_holds(run: Run, folder: Path) -> None:
    printed = {
        "certify": run("certify"),
        "list": run("list", "--long"),
        "explain": run("explain", "side-and-half"),
        "errata": run("errata"),
    }
    formats = ("html", "latex", "markdown", "json", "badge")
    run("report", *(f"--format={one}" for one in formats), "-o", "out")
    printed |= {path.name: path.read_text("utf-8") for path in (folder / "out").iterdir()}
    assert {"juggleproof.html", "juggleproof.tex", "appendix-a.tex", "errata.tex"} <= {*printed}
    assert {name: found for name, text in printed.items() if (found := WORDS.findall(text))} == {}
    ours = re.compile(r"\b(?:alpha|theorem)\b(?!\":null)")  # as data, there is no theorem
    assert not {name for name, text in printed.items() if ours.search(text)}


def test_the_claims_of_another_paper_have_their_verdicts_holds(run: Run, folder: Path) -> None:
    register = json.loads((folder / "circles" / "register.json").read_text("utf-8"))
    assert {name: one["verdict"] for name, one in register.items()} == {
        "square-about-a-circle": "holds",
        "side-and-half": "false",
    }
    line = "2 claims: 1 holds, 1 false; all as registered"
    assert run("certify").splitlines()[0] == line and run("certify", "-q") == f"{line}\n"
    assert run("certify", "--all").splitlines()[1].startswith("s")
    assert "A side is more than its half." in run("list", "--long")
    assert "-> refuted at side = -1" in run("explain", "side-and-half")
    assert "Wrong statements (1)" in run("errata")


def test_rejects_an_explanation_that_another_paper_lacks(run: Run) -> None:
    with pytest.raises(subprocess.CalledProcessError) as info:
        run("explain", "theorem", "--bounds")
    assert info.value.stderr == (
        "juggleproof: this paper explains no theorem by values; leave out the options for it\n"
    )
