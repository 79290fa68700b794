"""Figure 2 shows the blocks where they are, in the paper's order, told apart without colour, and is
the same to the byte from run to run.
"""

from __future__ import annotations

import io
import re
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest

from juggleproof.drawing.look import Look
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, run, scene, standing
from juggleproof.scenes.part import picture as p
from juggleproof.scenes.part.layout import ANGLES, lying, pitch, place, rows
from juggleproof.scenes.part.rest import side
from juggleproof.scenes.part.setting import Array
from tests.drawing.test_drawing import DEFICIENCIES, apart, filled, lab, seen
from tests.rows import each_row

if TYPE_CHECKING:
    from matplotlib.figure import Figure

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")
PathPatch = pytest.importorskip(
    "matplotlib.patches", reason="matplotlib is not installed"
).PathPatch

SETTING = p.as_in_figure_two(scene(e=0.7, mu=0.08))


@cache
def states() -> Array:
    return p.frames(SETTING, ANGLES, p.TIMES)


@cache
def drawn() -> Figure:
    return p.drawn(SETTING, states())


def rectangles(name: str) -> Array:
    """The corners of the rectangles of this name, in metres: shape (n, 4, 2)."""
    patches = [one for one in drawn().findobj(PathPatch) if one.get_gid() == name]
    return (
        np.concatenate([patch.get_path().vertices.reshape(-1, 5, 2)[:, :4] for patch in patches])
        if patches
        else np.zeros((0, 4, 2))
    )


def test_rectangles_are_blocks_at_their_true_angle_and_height_holds() -> None:
    for k, frame in enumerate(states()):
        some = lying(SETTING, frame)
        for name, chosen in (("lying", some), ("upright", ~some)):
            corners = rectangles(f"{name}-{k}")
            assert len(corners) == chosen.sum()
            for block, found in zip(np.flatnonzero(chosen), corners):
                column, row = place(int(block))
                level = body.table_height(SETTING.parameters(), frame[block, body.TIME])
                centre = (
                    column * pitch(SETTING),
                    row * pitch(SETTING) + frame[block, body.Y] - level,
                )
                assert np.allclose(found.mean(axis=0), centre, atol=1e-12)
                short, long = found[1] - found[0], found[2] - found[1]
                assert (
                    np.isclose(np.hypot(*short), 0.02)
                    and np.isclose(np.hypot(*long), 0.04)
                    and abs(short @ long) < 1e-12
                )
                theta = frame[block, body.THETA]
                assert np.allclose(short / 0.02, (np.cos(theta), np.sin(theta)), atol=1e-9)
                assert found[:, 1].min() >= row * pitch(SETTING) - 1e-9


def test_blocks_stand_in_the_order_of_the_paper_holds() -> None:
    assert [place(k) for k in (0, 9, 10, 90)] == [(0, 0), (9, 0), (0, 1), (0, 9)] and rows(91) == 10
    assert np.allclose(np.degrees(states()[0][:, body.THETA]), np.arange(91))
    tables = [one for one in drawn().findobj(PathPatch) if str(one.get_gid()).startswith("table-")]
    assert len(tables) == 3 and all(len(one.get_path().vertices) == 20 for one in tables)


def test_colours_are_as_table_one_judges_holds() -> None:
    numbers = SETTING.parameters()
    angles = np.linspace(-9, 9, 1801)
    some = np.zeros((len(angles), body.STATE))
    some[:, body.THETA] = angles
    assert lying(SETTING, some).tolist() == [side(numbers, theta) % 2 == 1 for theta in angles]


def test_picture_is_of_the_orbit_without_stops_holds() -> None:
    assert (states()[2] == run(SETTING, standing(SETTING, ANGLES), 3.0).states).all()


def test_the_two_kinds_differ_in_grey_and_for_the_colour_blind_holds() -> None:
    def worst(one: Look, other: Look) -> tuple[float, float]:
        colours = [filled(one), filled(other)]
        return abs(lab(colours[0])[0] - lab(colours[1])[0]), min(
            apart(*(seen(colour, kind) for colour in colours)) for kind in DEFICIENCIES
        )

    grey, blind = worst(p.UPRIGHT, p.LYING)
    assert grey > 20 and blind > 20


def saved(form: str) -> bytes:
    file = io.BytesIO()
    p.figure_two(SETTING, file, form)
    return file.getvalue()


def test_figure_is_the_same_from_run_to_run_holds() -> None:
    first, second = saved("svg"), saved("svg")
    assert (
        first == second
        and len(first) < 100_000
        and saved("pdf") == saved("pdf")
        and saved("pdf").startswith(b"%PDF")
    )
    ids = re.findall(r'id="([^"]*)"', first.decode())
    assert len(ids) == len(set(ids)) and all(one.startswith(p.SLUG) for one in ids)


def test_words_tell_the_counts_holds() -> None:
    counts = [int(lying(SETTING, frame).sum()) for frame in states()]
    assert counts[0] == 64 and f"after 0.8 s, {counts[1]} of 91" in p.caption(SETTING, states())
    assert f"{91 - counts[1]} at 0.8 s, {91 - counts[2]} at 3 s" in p.alt(SETTING, states())


def test_rejects_another_form() -> None:
    with pytest.raises(SceneError, match="choose from svg, pdf"):
        saved("png")


@each_row("count", [0, 601])
def test_rejects_blocks_that_no_picture_shows(count: int) -> None:
    with pytest.raises(SceneError, match=r"outside 1 \.\. 600"):
        rows(count)
