"""Bad input is answered by one line with the value and what is allowed, as a ValueError."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import (
    arrays,
    boundary,
    grid,
    listed,
    orbit,
    physical,
    physical_box,
    physical_grid,
    point,
    random,
    scene,
)
from juggleproof.scenes.juggler.orbits import heights
from juggleproof.scenes.juggler.periodic import exists_for, family, orbit_of
from juggleproof.scenes.juggler.tables import as_arrays
from tests.rows import each_row

NAN, INF = float("nan"), float("inf")
STARTS = point(0, 1)
WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "alpha 0": (lambda: scene(0, STARTS), "alpha = 0 is not between 0 and 1"),
    "alpha 1": (lambda: scene(1, STARTS), "alpha = 1 is not between 0 and 1"),
    "alpha negative": (lambda: scene(Fraction(-1, 3), STARTS), "0 < alpha < 1"),
    "alpha nan": (lambda: scene(NAN, STARTS), "alpha = nan is no finite number"),
    "alpha text": (lambda: scene("a third", STARTS), "'?a third'? is no finite number"),
    "alpha over 0": (lambda: scene("1/0", STARTS), "no finite number"),
    "alpha None": (lambda: scene(None, STARTS), "no finite number"),
    "r": (lambda: scene("1/3", STARTS, r=0), "r = 0 is not positive"),
    "g": (lambda: scene("1/3", STARTS, g=-1), "g = -1 is not positive"),
    "below": (lambda: point(-1, 0), "x = -1 is below the table; a state has x >= 0"),
    "just below": (lambda: point(Fraction(-1, 10**300), 0), "below the table"),
    "beta": (lambda: physical(-1, 0, 1, 1), "beta = -1 is below the table"),
    "infinite": (lambda: point(INF, 0), "x = inf is no finite number"),
    "w nan": (lambda: point(0, NAN), "w = nan is no finite number"),
    "none": (lambda: listed([]), "no states are given"),
    "shape": (lambda: arrays(np.zeros((2, 2)), np.zeros((2, 2))), r"shapes \(2, 2\)"),
    "shapes": (lambda: arrays(np.zeros(2), np.zeros(3)), r"\(2,\) and \(3,\)"),
    "dtype": (
        lambda: arrays(np.zeros(2, dtype=np.float32), np.zeros(2, dtype=np.float32)),
        "float64",
    ),
    "array nan": (lambda: arrays(np.zeros(2), np.array([0, NAN])), "w = nan"),
    "array below": (lambda: arrays(np.array([0.0, -1e-300]), np.zeros(2)), "x = -1e-300 is below"),
    "array empty": (lambda: arrays(np.zeros(0), np.zeros(0)), "n >= 1"),
    "grid": (lambda: grid((0, 1, 0), (0, 1, 2)), "is not a whole number from 1"),
    "grid parts": (lambda: grid((0, 1), (0, 1, 2)), "has not 3 parts"),
    "grid order": (lambda: grid((1, 0, 2), (0, 1, 2)), "the second is to be the greater"),
    "grid below": (lambda: grid((-1, 0, 2), (0, 1, 2)), "below the table"),
    "grid size": (lambda: grid((0, 1, 10**5), (0, 1, 10**5)), "the number of states = 10000000000"),
    "random count": (lambda: random(0, 1), "the number of states = 0"),
    "random seed": (lambda: random(1, -1), "seed = -1"),
    "random box": (lambda: random(1, 1, x=(2, 1)), "x runs from 2 to 1"),
    "boundary": (lambda: boundary("1/3", 1), "whole number from 2"),
    "boundary alpha": (lambda: boundary(2, 5), "alpha = 2"),
    "steps": (
        lambda: orbit(scene("1/3", STARTS), steps=-1),
        "steps = -1 is not a whole number from 0",
    ),
    "steps half": (lambda: orbit(scene("1/3", STARTS), steps=0.5), "steps = 0.5"),
    "steps true": (lambda: orbit(scene("1/3", STARTS), steps=True), "steps = True"),
    "arithmetic": (
        lambda: orbit(scene("1/3", STARTS), "double"),
        "'double' is not one of exact, enclosed, mp, fast",
    ),
    "precision": (
        lambda: orbit(scene("1/3", STARTS), "mp", precision=1),
        "precision = 1 is not a whole number from 2",
    ),
    "bits": (lambda: orbit(scene("1/3", STARTS), "enclosed", precision=0), "precision = 0"),
    "no precision": (
        lambda: orbit(scene("1/3", STARTS), "exact", precision=50),
        "has no meaning in exact arithmetic",
    ),
    "radius": (
        lambda: orbit(scene("1/3", STARTS), "enclosed", radius=Fraction(0)),
        "radius = 0 is not positive",
    ),
    "row": (lambda: orbit(scene("1/3", STARTS)).row(1), "orbit 1 is not among the 1"),
    "history": (lambda: orbit(scene("1/3", STARTS)).history(0), "keep=True"),
    "long": (lambda: point(Fraction(1, 2**200000), 0), "longer than 14000 bits"),
    "long power": (
        lambda: scene("1e999999999", STARTS),
        "longer than 14000 bits",
    ),  # not written out, which would take all memory
    "long power, parted": (lambda: scene("1e-9_999_999", STARTS), "longer than 14000 bits"),
    "two lines": (lambda: scene("a\nthird", STARTS), "alpha = a third is no finite number"),
    "alpha True": (lambda: scene(True, STARTS), "alpha = True is no finite number"),
    "alpha of many": (lambda: scene(np.array([0.1, 0.2]), STARTS), "no finite number"),
    "no starts": (lambda: scene("1/3", (0, 3)), r"starts = \(0, 3\) are no starting states"),
    "no scene": (lambda: orbit(None), "scene = None is no scene"),
    "no pairs": (lambda: listed([1, 2]), "1 is no state; give pairs"),
    "triples": (lambda: listed([(1, 2, 3)]), r"\(1, 2, 3\) is no state"),
    "ragged": (lambda: arrays([[1.0], [1.0, 2.0]], [1.0]), "is no array"),
    "grid none": (lambda: grid(None, None), "x = None has not 3 parts"),
    "box none": (lambda: random(1, 1, x=None), "x = None has not 2 parts"),
    "grid beta": (
        lambda: physical_grid((-1, 0, 2), (0, 1, 2), 1, 1),
        "beta = -1 is below the table",
    ),
    "grid v": (lambda: physical_grid((0, 1, 2), (1, 0, 2), 1, 1), "v runs from 1 to 0"),
    "box beta": (lambda: physical_box((-1, 0), (0, 1), 1, 1), "beta = -1 is below the table"),
    "box r": (lambda: physical_box((0, 1), (0, 1), 0, 1), "r = 0 is not positive"),
    "radius nan": (
        lambda: orbit(scene("1/3", STARTS), "enclosed", radius=NAN),
        "radius = nan is no finite number",
    ),
    "radius text": (
        lambda: orbit(scene("1/3", STARTS), "enclosed", radius="wide"),
        "radius = wide is no finite number",
    ),
    "steps huge": (
        lambda: orbit(scene("1/3", STARTS), steps=10**5000),
        "steps = a number of 16610 bits is not",
    ),
    "row half": (lambda: orbit(scene("1/3", STARTS)).row(0.5), "orbit 0.5 is not among the 1"),
    "arrays in feet": (
        lambda: as_arrays(orbit(scene("1/3", STARTS)), "feet"),
        "units = 'feet' is not one of",
    ),
    "time": (
        lambda: heights(scene("1/3", STARTS), [-Fraction(1, 10**300)]),
        "time = a number of 997 bits is before the start",
    ),
    "time nan": (lambda: heights(scene("1/3", STARTS), [NAN]), "time = nan is no finite number"),
    "times": (lambda: heights(scene("1/3", STARTS), 1), "times are to be a list"),
    "times index": (
        lambda: heights(scene("1/3", STARTS), [1], 1),
        "index = 1 is not a whole number from 0 to 0",
    ),
    "word": (lambda: exists_for(None), "None is no word"),
    "word text": (lambda: orbit_of("12", "1/2"), "12 is no word"),
    "word half": (lambda: family((1.5,)), "a flight = 1.5 is not a whole number"),
    "many exact": (
        lambda: orbit(scene("1/3", random(10**7, 1)), "exact", 1),
        "10000000 starts in exact arithmetic; at most 1000000",
    ),
    "keep exact": (
        lambda: orbit(scene("1/3", STARTS), "exact", 10**9, keep=True),
        "1000000000 steps are more than 4000000",
    ),
}


def test_numbers_of_numpy_are_taken_exactly_holds() -> None:
    setting = scene(np.float32(0.5), listed(np.array([[1.0, 2.0]])), r=np.int64(2))
    assert (setting.alpha, setting.r, setting.starts.exact(0)) == (Fraction(1, 2), 2, (1, 2))
    assert orbit(setting, steps=np.int64(3)).row(0).periods == 3


@each_row("name", WRONG)
def test_rejects_bad_input_in_one_line(name: str) -> None:
    wrong, message = WRONG[name]
    with pytest.raises(SceneError, match=message) as refused:
        wrong()
    assert (
        isinstance(refused.value, ValueError)
        and "\n" not in str(refused.value)
        and len(str(refused.value)) < 200
    )
