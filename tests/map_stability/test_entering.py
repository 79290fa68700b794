"""Boxes that every orbit enters: what a map saturates to, and no more."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from juggleproof.map_stability.entering import boxes_of, radius_of, spaces_entered
from juggleproof.map_stability.maps import Map, read_file
from juggleproof.map_stability.search import search_stability
from juggleproof.map_stability.terms import holds
from tests.map_stability.maps import at_point, map_of

EXAMPLES = Path(__file__).parents[2] / "examples"
CLIPPED = "max(-1, min(1, a*x + b*y))"
BOXES = {
    f"{CLIPPED}, x": ["x <= 1 and x >= -1", "x <= 1 and x >= -1 and y <= 1 and y >= -1"],
    f"{CLIPPED}, a*y": ["x <= 1 and x >= -1"],  # a y is beyond no one term for a of both signs
    "max(0, x - y), x/2 - 1": ["x >= 0", "x >= 0 and y >= -1"],
    "max(0, 2 - 3*x) + 1, y/2": ["x >= 1", "x <= 1 and x >= 1"],
    "max(a, x/2), y/2": ["x >= a"],
    "x/2, y/2": [],
    "x + y, max(-x, y)": [],
}


def planar(images: str, domain: str = "-1 < a and a < 1 and -1 < b and b < 1") -> Map:
    return map_of(f"over a b\ndomain {domain}\nstate x y\npiece {images}")


@pytest.mark.parametrize("images", BOXES)
def test_the_bounds_of_images_are_those_of_the_pieces_holds(images: str) -> None:
    assert boxes_of(planar(images)) == BOXES[images]


@pytest.mark.parametrize("images", BOXES)
def test_every_orbit_is_in_each_box_after_as_many_steps_holds(images: str) -> None:
    system = planar(images)
    rng = np.random.default_rng(2)
    points = {name: rng.uniform(-9, 9, 500) for name in ("x", "y")}
    points |= {name: rng.uniform(-1, 1, 500) for name in ("a", "b")}
    for box in boxes_of(system):
        points |= dict(zip(system.state, system.next(points)))
        assert np.all(holds(box, points))


@pytest.mark.exhaust
def test_a_filter_that_saturates_comes_to_rest_wherever_the_linear_one_does_holds() -> None:
    """P. M. Ebert, J. E. Mazo and M. G. Taylor (1969), in the whole triangle."""
    outcome = search_stability(read_file(EXAMPLES / "saturated-filter.map"))
    assert outcome.finding.verdict == "proved"
    assert outcome.finding.sentence == "(0, 0) is stable and attracts every state"
    assert "saturated-filter/descends" in outcome.proof.known


@pytest.mark.exhaust
def test_rejects_a_filter_beyond_the_triangle() -> None:
    outcome = search_stability(planar(f"{CLIPPED}, x", "1/4 < a and a < 1 and 1 - a < b and b < 1"))
    assert outcome.finding.verdict == "refuted"


def rational(images: str, space: str, domain: str) -> Map:
    return map_of(f"over a\ndomain {domain}\nstate x y\nspace {space}\npiece {images}", "rational")


def test_a_closed_space_is_left_for_its_inside_variable_by_variable_holds() -> None:
    system = rational("x/2 + a/(2*(1 + y)), y/2 + x/2", "x >= 0 and y >= 0", "a > 0")
    inside = ["x > 0 and y >= 0", "y > 0 and x > 0"]
    assert spaces_entered(at_point(system), False) == inside


def test_an_end_that_images_attain_is_not_left_holds() -> None:
    system = rational("a*x/(1 + y), y/2 + x/2", "x >= 0 and y >= 0", "0 < a and a < 1")
    assert spaces_entered(at_point(system), False) == []


def test_a_bound_that_all_states_keep_limits_no_radius_holds() -> None:
    system = rational("a/(1 + y), a/(1 + x)", "x >= 0 and y >= 0", "a > 0")
    setting = at_point(system)
    assert radius_of(setting, "x >= 0 and y >= 0 and x + 1 > 0 and y + 1 > 0") == "1"
    assert "root_1" in radius_of(setting, "x > 0 and y >= 0")


def test_the_bounds_of_a_rational_image_are_its_limits_holds() -> None:
    system = rational("a + y/x, x", "x > 0 and y > 0", "a > 1")
    assert spaces_entered(at_point(system), True)[-1] == "y > a and x > a and x > 0 and y > 0"


@pytest.mark.exhaust
def test_the_part_that_orbits_enter_carries_the_proof_holds() -> None:
    """A. M. Amleh, E. A. Grove, G. Ladas and D. A. Georgiou (1999), in the whole range."""
    found = search_stability(rational("a + y/x, x", "x > 0 and y > 0", "a > 1"))
    assert found.finding.sentence == "(a + 1, a + 1) is stable and attracts every state"
    assert [one.name for one in found.proof.rules][-1] == "rational/attracts"
