"""Greatest weighted ratios to the point, and what proves that they fall."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from juggleproof.map_stability import limits
from juggleproof.map_stability.domains import narrowed
from juggleproof.map_stability.functions import weighted_terms
from juggleproof.map_stability.functions.equations import with_ends
from juggleproof.map_stability.functions.ratios import (
    origins,
    ratio_candidates,
    weighted_distance_candidates,
)
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points import fixed_points
from juggleproof.map_stability.samples import region, with_licences
from juggleproof.map_stability.search import search_stability
from tests.map_stability.maps import at_point, map_of, of_its_map, proved


def planar(piece: str, over: str, domain: str, state: str = "x y", space: str = "") -> Map:
    """A map of the quadrant x > 0 and y > 0, or of another space."""
    space = space or "x > 0 and y > 0"
    return map_of(f"over {over}\ndomain {domain}\nstate {state}\nspace {space}\npiece {piece}")


PIELOU = planar("r*x/(1 + y), x", "r", "r > 1")
RATIONAL = planar("(1 + y)/(q + x), x", "q", "0 < q and q < 3")
STAGES = planar("b*y/(1 + y), x + s*y", "b s", "0 < s and s < 1 and b > 1 - s")
SUBCRITICAL = "0 < b and b < 1 and 0 < g and g < 1/2 and b < g + 1/2"
EPIDEMIC = "(s + 1)/2 - b*s*i, (1/2 - g)*i + b*s*i"
INFECTED = "s >= 0 and i >= 0 and s + i <= 1"
# R. Ross, The Prevention of Malaria, 1911: infected hosts and vectors
VECTORS = planar(
    "4*h/5 + a*v*(1 - h), 7*v/10 + c*h*(1 - v)",
    "a c",
    "3/10 < a and a <= 1/2 and 3/10 < c and c <= 1/2",
    "h v",
    "0 < h and h <= 1 and 0 < v and v <= 1",
)
# the mean of ratios, whose inverse is below the mean of the inverses: by what is squared
JUVENILES = planar(
    "b*a/(1 + a), s*l + (1 - m)*a",
    "b s m",
    "0 < s and s < 1 and 0 < m and m < 1 and m < b*s",
    "l a",
    "l > 0 and a > 0",
)


@pytest.mark.exhaust
def test_a_delayed_map_that_turns_is_stable_holds() -> None:
    found = search_stability(PIELOU)
    assert found.finding.verdict == "proved"
    assert found.finding.sentence == "(r - 1, r - 1) is stable and attracts every state"
    values = [text for key, text in found.proof.rules[-1].rows if key == "value"]
    assert len(values) == 6  # those of x, y and x/y, and of their inverses


@pytest.mark.exhaust
def test_a_condition_with_a_root_is_found_holds() -> None:
    system = with_licences(RATIONAL)
    parameters = region(system.domain, system.parameters, limits.PARAMETERS)
    (fixed,) = (one for one in fixed_points(system) if one.exists(system, parameters).any())
    assert narrowed(system, fixed, parameters) == ["q - 1 > 0"]
    found = search_stability(RATIONAL)
    assert found.finding.verdict == "in part"
    assert "every state where q > 1; where q = 1, it does not attract (2, 1/2)" in (
        found.finding.sentence
    )


def test_rejects_a_domain_in_which_the_point_is_not_stable() -> None:
    assert not list(ratio_candidates(at_point(RATIONAL)))


@pytest.mark.exhaust
def test_rejects_a_loss_that_is_too_large() -> None:
    setting = at_point(PIELOU, inside=True)
    proof, one = of_its_map(setting), next(ratio_candidates(setting))
    rows = tuple((key, "value/2" if key == "loss" else text) for key, text in one.rule.rows)
    assert not proof.add(replace(one.rule, rows=rows), (1,), 100_000, one.searches)
    assert "no proof of the premise falls" in proof.fault


@pytest.mark.exhaust
def test_a_point_whose_coordinates_are_quotients_of_each_other_is_stable_holds() -> None:
    leslie = planar("2*y/(1 + y), s*x", "s", "1/2 < s and s < 1")
    assert search_stability(leslie).finding.sentence.endswith("is stable and attracts every state")


@pytest.mark.exhaust
def test_what_a_bound_of_an_eliminated_parameter_says_of_the_point_is_known_holds() -> None:
    one = next(ratio_candidates(at_point(STAGES, inside=True)))
    assert ("have", "-x_point + y_point > 0") in one.rule.rows


def test_a_point_on_the_boundary_has_ratios_of_a_variable_plus_half_of_another_holds() -> None:
    piece, space = "r*x/(1 + x + y), y/(2 + y)", "x > 0 and y >= 0"
    system = planar(piece, "r", "1 < r and r < 3", space=space)
    first = next(origins(at_point(system, "r - 1", "0")))
    assert [str(one) for one in first] == ["x", "r/2 + y - 1/2"]


@pytest.mark.exhaust
def test_a_cascade_with_a_jordan_block_is_stable_holds() -> None:
    """No quadratic form with constant coefficients falls for all a."""
    text = "over a\ndomain 0 <= a and a < 1\nstate x y z\npiece a*x, x + a*y, y + a*z"
    assert "lyapunov" in proved(at_point(map_of(text)), weighted_distance_candidates, 1)


def test_no_weights_are_found_where_no_sample_is_in_range_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    setting = SimpleNamespace(system=SimpleNamespace(state=("x",)), count=1)
    none = np.zeros((2, 0)), np.zeros((2, 0)), SimpleNamespace()
    monkeypatch.setattr(weighted_terms, "values", lambda *_: none)
    assert weighted_terms._weights(setting, ["x", "1/x"]) == ()  # type: ignore[arg-type]


def epidemic(domain: str) -> Map:
    return planar(EPIDEMIC, "b g", domain, "s i", INFECTED)


@pytest.mark.exhaust
def test_an_infection_dies_out_at_all_rates_holds() -> None:
    """By a loss that goes to 0 where b goes to g + 1/2."""
    setting = at_point(epidemic(SUBCRITICAL), "1", "0")
    assert "lyapunov" in proved(setting, weighted_distance_candidates, 1)
    loss = dict(next(weighted_distance_candidates(setting)).rule.rows)["loss"]
    assert "(-2*b + 2*g + 1)" in loss


def test_an_infection_fails_to_die_out_without_the_bound_of_its_rate() -> None:
    setting = at_point(epidemic(SUBCRITICAL.replace(" and b < g + 1/2", "")), "1", "0")
    assert not list(weighted_distance_candidates(setting))


def test_parameters_close_to_the_ends_of_the_domain_are_in_it_holds() -> None:
    setting = at_point(epidemic(SUBCRITICAL), "1", "0")
    wide = with_ends(setting).parameters
    left = wide["g"] + 1 / 2 - wide["b"]
    assert left.min() > 0 and left[: setting.count].min() > 10 * left.min()
    assert wide["b"].min() > 0 and wide["b"].max() < 1 and wide["g"].max() < 1 / 2


@pytest.mark.exhaust
def test_a_bilinear_map_is_stable_by_the_sign_of_its_slope_at_a_corner_holds() -> None:
    setting = at_point(VECTORS, inside=True)
    assert "lyapunov" in proved(setting, ratio_candidates, 1)
    search = next(ratio_candidates(setting)).searches["falls-1-1"]
    assert isinstance(search, partial)
    corners = [sign for sign in search.keywords["signs"] if "value" in sign]
    assert len(corners) == 2  # one for each variable


@pytest.mark.exhaust
def test_juveniles_and_adults_come_to_rest_by_few_facts_holds() -> None:
    assert "lyapunov" in proved(at_point(JUVENILES, inside=True), ratio_candidates, 1)
