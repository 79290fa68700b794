"""Every link of README.md and of the pages leads to a file and a place that exist, and every page
is in the site.
"""

from __future__ import annotations

import re
from pathlib import Path

import yaml

from tests.docs.pages import PAGES, ROOT, name, text_of
from tests.rows import each_row

LINK = re.compile(r"\]\(([^)\s]+)\)")
BLOCKS = re.compile(r"^```.*?^```$|`[^`\n]*`", re.M | re.S)


def anchors(page: Path) -> set[str]:
    """The places of a page: headings as GitHub and the site name them, and `id`s."""
    text = BLOCKS.sub(
        lambda found: found[0].strip("`") if "\n" not in found[0] else "", text_of(page)
    )
    headings = re.findall(r"^#+ (.*)$", text, re.M)
    slugs = {re.sub(r"[^\w\- ]", "", one.lower()).replace(" ", "-") for one in headings}
    return slugs | set(re.findall(r'<a id="([^"]+)">', text))


@each_row("page", PAGES)
def test_links_lead_somewhere_holds(page: Path) -> None:
    for target in LINK.findall(BLOCKS.sub("", text_of(page))):
        assert not re.match(r"\w+:", target), f"{target}: a page outside cannot be tested"
        file, _, place = target.partition("#")
        there = (page.parent / file).resolve() if file else page
        assert there.is_file() and there.is_relative_to(ROOT), target
        assert not place or place in anchors(there), target


def test_every_page_is_in_the_site_and_can_be_reached_holds() -> None:
    site = yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))
    titles = [entry for part in site["nav"] for entry in part.values()]
    listed = [
        page
        for one in titles
        for page in ([one] if isinstance(one, str) else [next(iter(p.values())) for p in one])
    ]
    pages = [page.name for page in PAGES if page.parent != ROOT]
    assert sorted(listed) == sorted(pages)
    linked = set(LINK.findall(text_of(ROOT / "docs/index.md")))
    assert set(pages) - {"index.md"} <= linked


def test_a_folder_that_a_page_names_exists_holds() -> None:
    for page in PAGES:
        for path in re.findall(
            r"`((?:certificates|proofs|scenes|symbolic|benchmarks|tests)/[\w./-]+)`", text_of(page)
        ):
            assert (ROOT / path).exists(), f"{name(page)}: {path}"


def test_readme_is_short_holds() -> None:
    lines = text_of(ROOT / "README.md").splitlines()
    assert len(lines) <= 120 and max(map(len, lines)) <= 110
