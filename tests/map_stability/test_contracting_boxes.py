"""Boxes that a map takes into smaller ones, and how orbits enter them."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy

from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.contracting_boxes import (
    box_of,
    contracting_box_candidates,
    ends_at_point,
    ends_for,
    height_of,
)
from juggleproof.map_stability.maps import HIGH, LOW
from juggleproof.map_stability.terms import expression
from juggleproof.statements.language import MapRule
from tests.map_stability.maps import at_point, map_of, of_its_map, proved

COMPETITION = "2*x/(1 + x + c*y), 3*y/(1 + y + c*x)"
PREDATOR = "2*x/(1 + x + y), y*(1 + c*x)/2"


def setting(piece: str, domain: str) -> Setting:
    """The map where both variables are above 0, and its point inside."""
    text = f"over c\ndomain {domain}\nstate x y\nspace x > 0 and y > 0\npiece {piece}"
    return at_point(map_of(text), inside=True)


def where_it_dies_out(domain: str, space: str = "x > 0 and y >= 0") -> Setting:
    """The point at which there is no predator."""
    text = f"over c\ndomain {domain}\nstate x y\nspace {space}\npiece {PREDATOR}"
    return at_point(map_of(text), "1", "0")


@pytest.mark.exhaust
def test_the_ends_of_the_box_of_two_competing_species_holds() -> None:
    found = box_of(replace(setting(COMPETITION, "0 < c and c < 1/2"), have=()))
    assert found is not None
    # capacities 1 and 2; 1 - 2 c and 2 - c are left below them, and halved; 1/2 + c = c y at y
    ends = {(0, HIGH): "(1 + (2 + c)/(2*c))/2", (1, HIGH): "(2 + (1 + 2*c)/(2*c))/2"}
    ends |= {(0, LOW): "1/2 - c", (1, LOW): "1 - c/2"}
    assert list(found) == list(ends)  # in the order in which orbits enter them
    assert all(sympy.cancel(found[one] - expression(ends[one])) == 0 for one in ends)


@pytest.mark.exhaust
def test_competing_species_come_to_rest_holds() -> None:
    of = setting(COMPETITION, "0 < c and c < 1/2")
    assert proved(of, contracting_box_candidates, 1)[-2:] == ["attracts-1", "attracts"]


@pytest.mark.exhaust
def test_like_species_come_to_rest_by_distances_holds() -> None:
    """For all rates: a step beyond the capacity takes back by what it does there."""
    piece = "b*x/(1 + x + c*y), b*y/(1 + y + c*x)"
    rows = f"domain b > 1 and 0 < c and c < 1\nstate x y\nspace x > 0 and y > 0\npiece {piece}"
    of = at_point(map_of(f"over b c\n{rows}"), inside=True)
    assert proved(of, contracting_box_candidates, 1)[-1] == "attracts"
    function = next(contracting_box_candidates(of)).rule
    values = [text for key, text in function.rows if key == "value"]
    assert values == ["(x_gap)/(1)", "(y_gap)/(1)", "(-x_gap)/(1)", "(-y_gap)/(1)"]


def test_a_box_fails_without_weak_competition() -> None:
    assert box_of(replace(setting(COMPETITION, "2 < c and c < 3"), have=())) is None


def test_rejects_a_bound_that_orbits_do_not_enter() -> None:
    of = setting(COMPETITION, "0 < c and c < 1/2")
    chain = next(contracting_box_candidates(of)).rules
    (descent,) = (one for one in chain if one.name == "m/descends")
    rows = tuple((key, "x < 1/2" if key == "stage" else text) for key, text in descent.rows)
    proof = of_its_map(of)
    assert not proof.add(MapRule(descent.name, rows), (1,), 100_000) and "falls-1" in proof.fault


def test_the_ends_of_the_box_where_a_predator_dies_out_holds() -> None:
    found = box_of(replace(where_it_dies_out("0 < c and c < 1"), have=()))
    # the prey alone comes to 1, the predator grows from 1/c on, and takes 1/2 to 1/2 where y = 1/2
    ends = {(0, HIGH): "(1 + 1/c)/2", (1, HIGH): "1/4", (0, LOW): "1/2"}
    assert found is not None and list(found) == list(ends)
    assert all(sympy.cancel(found[one] - expression(ends[one])) == 0 for one in ends)


@pytest.mark.exhaust
def test_a_predator_that_grows_too_slowly_dies_out_holds() -> None:
    of = where_it_dies_out("0 < c and c < 1")
    assert proved(of, contracting_box_candidates, 1)[-1] == "attracts"


def test_a_box_fails_where_the_predator_grows() -> None:
    assert not list(contracting_box_candidates(where_it_dies_out("0 < c and c < 2")))


def test_a_step_up_has_a_height_where_states_are_at_the_lower_end_holds() -> None:
    of = where_it_dies_out("0 < c and c < 1", "x >= 0 and y >= 0")
    assert ends_at_point(of) == {(1, LOW): 0} == ends_for(of)
    assert height_of(of, {}, (0, LOW)) is None
    assert str(height_of(of, {(0, HIGH): sympy.Integer(2)}, (0, LOW))) == "2 - x"
    assert str(height_of(of, {}, (0, HIGH))) == "x"
