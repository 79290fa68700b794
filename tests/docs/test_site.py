"""The site, and the pictures of README.md and of the pages; that of many orbits with
JUGGLEPROOF_MUTANTS=many (make exhaust).
"""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from juggleproof.command.main import run
from tests.docs.pages import PAGES, ROOT, code, text_of
from tests.proofs.figures.drawn import figure
from tests.reports.browser import chromium, requests, resize, scheme
from tests.share import MANY

# -------------------------------------------------------------------------------------------------
# The site: built without a warning, with formulas as MathML; it loads nothing from elsewhere and
# fits a phone.

BUILT = [f"{page.stem}.html" for page in PAGES if page.parent != ROOT]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    for module in ("mkdocs", "material", "latex2mathml"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed; the extra docs has it")
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
        check=False,
    )
    assert done.returncode == 0 and "WARNING" not in done.stderr, done.stderr
    yield folder


@pytest.mark.exhaust
def test_every_formula_is_mathml_holds(site: Path) -> None:
    made = "".join(text_of(site / page) for page in BUILT)
    displays = sum(len(code(page, "math")) for page in PAGES)
    assert displays > 50 and made.count('display="block"') == displays
    assert "arithmatex" not in made and "language-math" not in made
    assert "<blockquote" not in made  # a line of prose that begins with > is one


@pytest.mark.exhaust
def test_nothing_is_loaded_from_elsewhere_holds(site: Path) -> None:
    for page in BUILT:
        loaded = re.findall(
            r'<(?:script|link|img|iframe)[^>]*(?:src|href)="([^"]*)"', text_of(site / page)
        )
        assert loaded and not [one for one in loaded if re.match(r"(\w+:)?//", one)], page


@pytest.mark.exhaust
def test_pages_fit_a_phone_and_follow_the_readers_colours_holds(site: Path) -> None:
    with chromium() as driver:
        resize(driver, 390)
        requests(driver)
        for number, page in enumerate(BUILT):
            for shade, expected in (("light", "default"), ("dark", "slate"))[: 1 + (not number)]:
                scheme(driver, shade)
                driver.get(f"file://{site}/{page}")
                width = driver.execute_script("return document.documentElement.scrollWidth")
                assert width <= 390, f"{page} is {width} pixels wide"
                colours = "return document.body.getAttribute('data-md-color-scheme')"
                assert driver.execute_script(colours) == expected, f"{page}, {shade}"
                for image in driver.find_elements("css selector", "article img"):
                    assert int(image.get_property("naturalWidth")) > 0, page
        asked = requests(driver)
        assert asked and not [one for one in asked if one.startswith("http")]


# -------------------------------------------------------------------------------------------------
# The pictures of README.md and of the pages are those that the program draws.


@pytest.mark.parametrize("slug", ["fig-trap", "fig-attractors"])
def test_figures_of_the_report_are_what_the_program_draws_holds(slug: str) -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    from juggleproof.drawing import drawing

    drawn = drawing.svg(figure(slug), slug).decode()
    on_white = drawn.replace("fill: none", "fill: #ffffff", 1)
    committed = (ROOT / f"docs/img/{slug}.svg").read_text(encoding="utf-8")
    assert committed == on_white, "run `make figure`"


@pytest.mark.skipif(not MANY, reason="39,900 orbits are followed in make exhaust")
def test_what_orbits_tend_to_is_what_the_program_draws_holds(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    drawn = tmp_path / "bifurcation.svg"
    assert run(["simulate", "juggler", "--picture", "bifurcation", "-o", str(drawn)]) == 0
    committed = ROOT / "docs/img/bifurcation.svg"
    assert committed.read_bytes() == drawn.read_bytes(), "run `make figure`"
