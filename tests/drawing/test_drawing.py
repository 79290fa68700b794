"""How figures are drawn: their files, and their colours."""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
from functools import cache
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest

from juggleproof.drawing import drawing, look
from juggleproof.drawing.look import B1, B2, BAND, GAIN, INK, LOSS, PALETTE, Look, R
from juggleproof.proofs.figures import TABLE, entry
from tests.proofs.figures.drawn import figure
from tests.rows import each_row

# -------------------------------------------------------------------------------------------------
# The files: well-formed, small, the same from run to run and from process to process, and able to
# stand together in one page.

ROOT = Path(__file__).resolve().parents[2]
SLUGS = [one.slug for one in TABLE]
PAPER = [f"fig-{number}" for number in (3, *range(5, 15))]
DRAWN = ("fig-3", "fig-8", "fig-11", "fig-trap", "fig-ranges")
PRINT_DIGESTS = f"""
import hashlib, sys
from juggleproof.drawing import drawing
from tests.proofs.figures.drawn import figure
for slug in {DRAWN}:
    data = figure(slug)
    drawn = drawing.svg(data, slug), drawing.pdf(data)
    print(slug, *(hashlib.sha256(one).hexdigest() for one in drawn))
print("matplotlib.pyplot" in sys.modules)
"""


def digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


@cache
def svg(slug: str) -> str:
    return drawing.svg(figure(slug), slug).decode("utf-8")


@cache
def pdf(slug: str) -> bytes:
    return drawing.pdf(figure(slug))


def inline(slug: str) -> str:
    one = entry(slug)
    return look.inline_svg(svg(slug), slug, one.title, one.alt)


def ids(text: str) -> list[str]:
    return re.findall(r'\sid="([^"]*)"', text)


def test_figures_of_the_paper_come_in_its_order_holds() -> None:
    assert [one.slug for one in TABLE if one.number] == PAPER
    assert [one.number for one in TABLE if one.number] == [
        slug.removeprefix("fig-") for slug in PAPER
    ] and len(set(SLUGS)) == len(SLUGS)


@each_row("slug", SLUGS)
def test_words_beside_a_figure_are_sentences_holds(slug: str) -> None:
    one = entry(slug)
    for text in (one.alt, one.caption):
        assert (
            len(text.split()) >= 10
            and text.endswith(".")
            and text[0].isupper()
            and "  " not in text
        ), text
    assert one.title and not one.title.endswith(".") and one.alt != one.caption


@each_row("slug", SLUGS)
def test_file_is_well_formed_and_small_holds(slug: str) -> None:
    text = svg(slug)
    assert ElementTree.fromstring(text).tag == "{http://www.w3.org/2000/svg}svg"
    assert (
        len(text) < (130_000 if slug == "fig-argument" else 60_000)
        and "<text" not in text
        and "<image" not in text
    )  # letters are paths, nothing is a bitmap
    assert pdf(slug).startswith(b"%PDF-")


def test_figures_drawn_again_are_the_same_holds() -> None:
    again = entry("fig-12").draw()
    assert drawing.svg(again, "fig-12") == drawing.svg(figure("fig-12"), "fig-12")


@pytest.mark.exhaust
def test_same_bytes_in_every_process_holds() -> None:
    seed = "1" if os.environ.get("PYTHONHASHSEED") == "0" else "0"  # another than this one's
    run = subprocess.run(
        [sys.executable, "-c", PRINT_DIGESTS],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(ROOT)},
    )
    assert run.returncode == 0, run.stderr
    here = [[slug, *map(digest, (svg(slug).encode(), pdf(slug)))] for slug in DRAWN]
    *there, pyplot = run.stdout.splitlines()
    assert [line.split() for line in there] == here
    assert pyplot == "False"  # it and its state are not used


@each_row("slug", SLUGS)
def test_no_date_and_no_version_is_told_holds(slug: str) -> None:
    assert not re.search(
        r"dc:date|Matplotlib|metadata|20\d\d-\d\d-\d\d",
        svg(slug).replace("http://www.w3.org/2000/svg", ""),
    )
    assert b"CreationDate" not in pdf(slug) and b"Matplotlib" not in pdf(slug)


def test_ids_do_not_collide_in_one_page_holds() -> None:
    found = [name for slug in SLUGS for name in ids(inline(slug))]
    assert len(found) > 100 and len(set(found)) == len(found)
    assert all(name.startswith(("fig-",)) for name in found)


@each_row("slug", SLUGS)
def test_every_reference_has_its_target_in_the_same_figure_holds(slug: str) -> None:
    for text in (svg(slug), inline(slug)):
        used = {
            *re.findall(r'<use [^>]*?href="#([^"]*)"', text),
            *re.findall(r"url\(#(.*?)\)", text),
        }
        assert used and used <= set(ids(text)) and all(name.startswith(f"{slug}-") for name in used)


@each_row("slug", SLUGS)
def test_inline_figure_is_named_and_takes_the_colour_of_the_page_holds(slug: str) -> None:
    text, one = inline(slug), entry(slug)
    root = ElementTree.fromstring(text)
    assert root.get("role") == "img" and root.get("width") == "100%" and root.get("height") is None
    assert root.get("viewBox") == ElementTree.fromstring(svg(slug)).get("viewBox")
    title, described = list(root)[:2]
    assert (title.text, described.text) == (one.title, one.alt)
    assert root.get("aria-labelledby") == f"{title.get('id')} {described.get('id')}"
    assert "currentColor" in text and look.INK not in text
    assert (
        not re.search(r"<\?xml|<!|<metadata|<script|#000000|#ffffff", text)
        and text.count("http") == 1
    )  # the name space


@each_row("slug", SLUGS)
def test_only_the_palette_and_the_ink_are_drawn_holds(slug: str) -> None:
    colours = {one.upper() for one in re.findall(r"#[0-9a-fA-F]{6}\b(?![^<]*\")", svg(slug))} | {
        one.upper() for one in re.findall(r"(?:fill|stroke): (#[0-9a-fA-F]{6})", svg(slug))
    }
    assert colours <= {one.colour.upper() for one in look.PALETTE.values()} | {look.INK.upper()}


def test_words_of_the_page_cannot_become_tags_holds() -> None:
    text = look.inline_svg(drawing.svg(figure("fig-5"), "fig-5"), "fig-5", "a < b", 'x & "y"')
    assert [one.text for one in list(ElementTree.fromstring(text))[:2]] == ["a < b", 'x & "y"']


def test_rejects_what_is_no_svg() -> None:
    with pytest.raises(ValueError, match="not an SVG file: fig-5"):
        look.inline_svg("<p>", "fig-5", "title", "alt")


@each_row("slug", SLUGS)
def test_nothing_is_cut_off_or_overlaps_holds(slug: str) -> None:
    """Words stay inside the figure, and no two of them touch."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text

    shown = figure(slug)
    with drawing.style():
        renderer = FigureCanvasAgg(shown).get_renderer()
        words = [
            (one.get_text(), one.get_window_extent(renderer))
            for one in shown.findobj(Text)
            if one.get_text()
        ]
    for text, box in words:
        assert (
            shown.bbox.x0 <= box.x0
            and box.x1 <= shown.bbox.x1
            and shown.bbox.y0 <= box.y0
            and box.y1 <= shown.bbox.y1
        ), text
    for index, (text, box) in enumerate(words):
        for other, other_box in words[index + 1 :]:
            shared = [
                min(box.x1, other_box.x1) - max(box.x0, other_box.x0),
                min(box.y1, other_box.y1) - max(box.y0, other_box.y0),
            ]
            assert min(shared) < 1.5, (text, other)


def test_matplotlib_is_left_as_it_was_holds() -> None:
    import matplotlib

    before = dict.copy(matplotlib.rcParams)
    drawing.svg(entry("fig-5").draw(), "fig-5")
    assert dict.copy(matplotlib.rcParams) == before


# -------------------------------------------------------------------------------------------------
# Regions that meet on a figure differ in grey and for the colour-blind, and no two regions have
# both hatch and dashes in common.

Colour = tuple[float, float, float]
OKABE_AND_ITO = {
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#F0E442",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
}
# Machado, Oliveira and Fernandes (2009), severity 1: what is left of linear red, green and blue.
DEFICIENCIES = {
    "protanopia": (
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ),
    "deuteranopia": (
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.011820, 0.042940, 0.968881),
    ),
}
MEET = [
    ([B1], [B2]),
    ([GAIN], [LOSS]),
    ([LOSS], [B2]),
    ([R, BAND], [R]),
    ([R], []),
    ([B1, R], [B1]),
    ([B2, R], [B2]),
    ([B1, R], [B2, R]),
]


def linear(colour: str) -> Colour:
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    red, green, blue = (
        one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts
    )
    return red, green, blue


def encoded(one: float) -> float:
    return 12.92 * one if one <= 0.0031308 else 1.055 * one ** (1 / 2.4) - 0.055


def lab(colour: Colour) -> Colour:
    red, green, blue = (min(max(one, 0.0), 1.0) for one in colour)
    sums = (
        (0.4124564 * red + 0.3575761 * green + 0.1804375 * blue) / 0.95047,
        0.2126729 * red + 0.7151522 * green + 0.0721750 * blue,
        (0.0193339 * red + 0.1191920 * green + 0.9503041 * blue) / 1.08883,
    )
    fx, fy, fz = (
        one ** (1 / 3) if one > (6 / 29) ** 3 else one / (3 * (6 / 29) ** 2) + 4 / 29
        for one in sums
    )
    return 116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)


def seen(colour: Colour, deficiency: str) -> Colour:
    red, green, blue = (
        sum(part * one for part, one in zip(row, colour)) for row in DEFICIENCIES[deficiency]
    )
    return red, green, blue


def apart(one: Colour, other: Colour) -> float:
    return sum((a - b) ** 2 for a, b in zip(lab(one), lab(other))) ** 0.5


def filled(*layers: Look) -> Colour:
    """The tints of regions one over another on white paper, mixed as a screen mixes them."""
    parts = [1.0, 1.0, 1.0]
    for one in layers:
        parts = [
            part + one.tint * (int(one.colour[k : k + 2], 16) / 255 - part)
            for part, k in zip(parts, (1, 3, 5))
        ]
    return linear("#" + "".join(f"{round(255 * one):02x}" for one in parts))


def test_colours_are_those_of_okabe_and_ito_holds() -> None:
    colours = [look.colour for look in PALETTE.values()]
    assert set(colours) <= OKABE_AND_ITO and len(set(colours)) == len(colours)


def test_no_region_is_told_by_colour_alone_holds() -> None:
    for one, other in combinations(PALETTE.values(), 2):
        assert (one.hatch, tuple(one.dashes)) != (other.hatch, tuple(other.dashes))


@each_row(("one", "other"), MEET)
def test_tints_that_meet_differ_in_grey_holds(one: list[Look], other: list[Look]) -> None:
    assert abs(lab(filled(*one))[0] - lab(filled(*other))[0]) > 5


@each_row("deficiency", DEFICIENCIES)
@each_row(("one", "other"), MEET)
def test_tints_that_meet_differ_for_the_colour_blind_holds(
    one: list[Look], other: list[Look], deficiency: str
) -> None:
    assert apart(seen(filled(*one), deficiency), seen(filled(*other), deficiency)) > 9


@each_row("deficiency", DEFICIENCIES)
def test_lines_differ_for_the_colour_blind_holds(deficiency: str) -> None:
    for one, other in combinations(PALETTE.values(), 2):
        assert (
            apart(seen(linear(one.colour), deficiency), seen(linear(other.colour), deficiency)) > 10
        ), (one, other)


def test_red_and_green_fail_without_more_than_colour() -> None:
    """The measure sees what it should: a red and a green that differ to others meet for a
    deuteranope.
    """
    red, green = linear("#C85028"), linear("#9A6A00")
    assert apart(seen(red, "deuteranopia"), seen(green, "deuteranopia")) < 0.7 * apart(red, green)


def test_ink_is_dark_on_white_holds() -> None:
    assert lab(linear(INK))[0] < 20
