"""Pictures of orbits: the same bytes from run to run, small, and in the colours that exact
iteration gives.
"""

from __future__ import annotations

import base64
import io
import re
from fractions import Fraction

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import grid, listed, physical_grid, point, scene
from juggleproof.scenes.juggler.limits import limits
from tests.rows import each_row
from tests.scenes.juggler.reference import word_of

pytest.importorskip("matplotlib")
from matplotlib.colors import to_rgb
from PIL import Image

from juggleproof.scenes.juggler import picture

HALF = Fraction(1, 2)


def rasters(svg: bytes) -> list[np.ndarray]:
    """The images within, rows from above as they are seen."""
    images = re.findall(
        rb'href="data:image/png;base64,\s*([^"]*)"[^>]*transform="matrix\(\S+ 0 0 (-?)', svg
    )
    seen = []
    for coded, turned in images:
        pixels = np.asarray(Image.open(io.BytesIO(base64.b64decode(coded))).convert("RGB"))
        seen.append(pixels[::-1] if turned else pixels)
    return seen


def nearest(pixel: np.ndarray, colours: dict[tuple[int, ...], str]) -> tuple[int, ...]:
    """The word whose colour is next to that of the pixel."""
    tints = {word: 255 - 0.75 * (255 - 255 * np.array(to_rgb(c))) for word, c in colours.items()}
    return min(tints, key=lambda word: float(abs(tints[word] - pixel).sum()))


@pytest.mark.exhaust
@each_row("units", ["normal", "physical"])
def test_colours_of_a_basin_are_those_of_exact_orbits_holds(units: str) -> None:
    starts = (
        grid((0, 5, 40), (-3, 4, 40))
        if units == "normal"
        else physical_grid((0, 4, 40), (-3, 4, 40), "3/2", "981/100")
    )
    at = scene(HALF, starts, "3/2", "981/100")
    found = limits([HALF], starts)
    drawn = picture.basin(at, found, units)
    assert drawn == picture.basin(at, limits([HALF], starts), units) and len(drawn) < 150_000
    (image,) = rasters(drawn)
    colours = {(1,): picture.OF_FLIGHT[0], (2,): picture.OF_FLIGHT[1]}
    seen = set()
    for k in range(40):
        for speed in (7, 18, 29):
            word = word_of(HALF, starts.exact(40 * k + speed))
            # w runs upwards; in physical units v does, and the speeds of the grid with it
            assert nearest(image[39 - speed, k], colours) == word, (k, speed)
            seen.add(word)
    assert seen == set(colours)


def test_undecided_states_have_a_colour_of_their_own_holds() -> None:
    starts = grid((0, 5, 4), (-3, 4, 5))
    found = limits([HALF], starts)
    found.which[0, :] = found.place((1,))
    found.which[0, 8] = -1
    (image,) = rasters(picture.basin(scene(HALF, starts), found, "normal"))
    black = np.argwhere((image == 0).all(axis=2)).tolist()
    assert black == [[4 - 8 % 5, 8 // 5]] and "undecided: 1" in picture.how(found)


def test_bifurcation_shows_e_2_from_one_third_on_holds() -> None:
    alphas = [Fraction(k, 30) for k in range(5, 16)]
    at = scene(alphas[0], grid((0, 4, 12), (-2, 4, 12)))
    drawn = picture.bifurcation(at, limits(alphas, at.starts), "normal")
    assert drawn == picture.bifurcation(at, limits(alphas, at.starts), "normal")
    speeds, shares = rasters(drawn)
    second = np.array([round(255 * part) for part in to_rgb(picture.OF_FLIGHT[1])])
    for image in (speeds, shares):
        columns = (image == second).all(axis=2).any(axis=0).tolist()
        assert columns[:5] == [False] * 5 and all(columns[6:])  # alpha = 1/3 is the sixth


def test_ball_and_table_are_drawn_to_the_same_bytes_holds() -> None:
    at = scene(HALF, listed([(4, -1), ("1/2", 3)]))
    for units in ("normal", "physical"):
        drawn = picture.orbit(at, 12, units)
        assert drawn == picture.orbit(at, 12, units) and len(drawn) < 150_000
        assert {f"orbit-ball-{k}".encode() in drawn for k in (1, 2)} == {True}
        assert b"orbit-ball-3" not in drawn and b"fill: #ffffff" in drawn


def test_rejects_what_makes_no_picture() -> None:
    one = scene(HALF, point(0, 3))
    with pytest.raises(SceneError, match="41 periods cannot be drawn; give from 1 to 40"):
        picture.orbit(one, 41, "normal")
    with pytest.raises(SceneError, match="16 starts cannot be drawn; give 6 at most"):
        picture.orbit(scene(HALF, grid((0, 1, 4), (0, 1, 4))), 5, "normal")
    with pytest.raises(SceneError, match="give --grid"):
        picture.basin(one, limits([HALF], one.starts), "normal")
    narrow = scene(HALF, grid((1, 1 + Fraction(1, 10**20), 3), (0, 1, 3)))
    with pytest.raises(SceneError, match="from 1 to 1 cannot be drawn; give ends that are further"):
        picture.basin(narrow, limits([HALF], narrow.starts), "normal")
    with pytest.raises(SceneError, match="one alpha makes no picture; give two at least"):
        picture.bifurcation(one, limits([HALF], one.starts), "normal")
