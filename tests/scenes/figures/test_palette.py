"""Regions that meet on a figure differ in grey and for the colour-blind, and no two regions have
both hatch and dashes in common.
"""

from __future__ import annotations

from itertools import combinations

import pytest

from juggleproof.scenes.figures.drawing import B1, B2, BAND, GAIN, INK, LOSS, PALETTE, Look, R

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
    for look in layers:
        parts = [
            part + look.tint * (int(look.colour[k : k + 2], 16) / 255 - part)
            for part, k in zip(parts, (1, 3, 5))
        ]
    return linear("#" + "".join(f"{round(255 * one):02x}" for one in parts))


def test_colours_are_those_of_okabe_and_ito_holds() -> None:
    colours = [look.colour for look in PALETTE.values()]
    assert set(colours) <= OKABE_AND_ITO and len(set(colours)) == len(colours)


def test_no_region_is_told_by_colour_alone_holds() -> None:
    for one, other in combinations(PALETTE.values(), 2):
        assert (one.hatch, tuple(one.dashes)) != (other.hatch, tuple(other.dashes))


@pytest.mark.parametrize(("one", "other"), MEET)
def test_tints_that_meet_differ_in_grey_holds(one: list[Look], other: list[Look]) -> None:
    assert abs(lab(filled(*one))[0] - lab(filled(*other))[0]) > 5


@pytest.mark.parametrize("deficiency", DEFICIENCIES)
@pytest.mark.parametrize(("one", "other"), MEET)
def test_tints_that_meet_differ_for_the_colour_blind_holds(
    one: list[Look], other: list[Look], deficiency: str
) -> None:
    assert apart(seen(filled(*one), deficiency), seen(filled(*other), deficiency)) > 9


@pytest.mark.parametrize("deficiency", DEFICIENCIES)
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
