"""Greatest weighted ratios to the point, and what proves that they fall."""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability.certifying import Proof
from juggleproof.proofs.stability.domains import narrowed
from juggleproof.proofs.stability.functions import part_metric
from juggleproof.proofs.stability.functions.equations import with_ends
from juggleproof.proofs.stability.functions.ratios import (
    origins,
    ratio_rules,
    weighted_distance_rules,
)
from juggleproof.proofs.stability.given import of_rule
from juggleproof.proofs.stability.points import PARAMETERS, fixed_points
from juggleproof.proofs.stability.samples import region, with_licences
from juggleproof.proofs.stability.search import search_stability
from juggleproof.proofs.stability.settings import setting_of

PIELOU = ("r*x/(1 + y), x", "r", "r > 1")
RATIONAL = ("(1 + y)/(q + x), x", "q", "0 < q and q < 3")


def rule(piece: str, over: str, domain: str) -> MapRule:
    space = "x > 0 and y > 0"
    rows = [("over", over), ("domain", domain), ("state", "x y"), ("space", space)]
    return MapRule("m", (*rows, ("piece", piece)))


def test_a_delayed_map_that_turns_is_stable_holds() -> None:
    found = search_stability(of_rule(rule(*PIELOU)))
    assert found.finding.verdict == "proved"
    assert found.finding.sentence == "(r - 1, r - 1) is stable and attracts every state"
    values = [text for key, text in found.proof.rules[-1].rows if key == "value"]
    assert len(values) == 6  # those of x, y and x/y, and of their inverses


def test_a_condition_with_a_root_is_found_holds() -> None:
    system = with_licences(of_rule(rule(*RATIONAL)))
    parameters = region(system.domain, system.parameters, PARAMETERS)
    (fixed,) = (one for one in fixed_points(system) if one.exists(system, parameters).any())
    assert narrowed(system, fixed, parameters) == ["q - 1 > 0"]
    found = search_stability(of_rule(rule(*RATIONAL)))
    assert found.finding.verdict == "in part"
    assert "every state where q > 1; where q = 1, it does not attract (2, 1/2)" in (
        found.finding.sentence
    )


def test_rejects_a_domain_in_which_the_point_is_not_stable() -> None:
    system = with_licences(of_rule(rule(*RATIONAL)))
    (fixed,) = fixed_points(system)
    assert list(ratio_rules(setting_of(system, fixed, system.domain), "m/lyapunov")) == []


def test_rejects_a_loss_that_is_too_large() -> None:
    system = with_licences(of_rule(rule(*PIELOU)))
    (fixed,) = fixed_points(system)[:1]
    proof = Proof()
    assert proof.add(system.rule("m/map")) == ""
    candidate, searches = next(ratio_rules(setting_of(system, fixed, system.domain), "m/lyapunov"))
    rows = tuple((key, "value/2" if key == "loss" else text) for key, text in candidate.rows)
    wrong = MapRule(candidate.name, rows)
    assert "no proof of the premise falls" in proof.add(wrong, (1,), 100_000, searches=searches)


def test_a_point_whose_coordinates_are_quotients_of_each_other_is_stable_holds() -> None:
    leslie = of_rule(rule("2*y/(1 + y), s*x", "s", "1/2 < s and s < 1"))
    assert search_stability(leslie).finding.sentence.endswith("is stable and attracts every state")


def test_what_a_bound_of_an_eliminated_parameter_says_of_the_point_is_known_holds() -> None:
    stages = rule("b*y/(1 + y), x + s*y", "b s", "0 < s and s < 1 and b > 1 - s")
    system = with_licences(of_rule(stages))
    fixed = next(one for one in fixed_points(system) if "0" not in one.point.terms)
    candidate, _ = next(ratio_rules(setting_of(system, fixed, system.domain), "m/lyapunov"))
    assert ("have", "-x_point + y_point > 0") in candidate.rows


def test_a_point_on_the_boundary_has_ratios_of_a_variable_plus_half_of_another_holds() -> None:
    rows = [("over", "r"), ("domain", "1 < r and r < 3"), ("state", "x y")]
    rows += [("space", "x > 0 and y >= 0"), ("piece", "r*x/(1 + x + y), y/(2 + y)")]
    system = with_licences(of_rule(MapRule("m", tuple(rows))))
    (fixed,) = [one for one in fixed_points(system) if one.point.terms == ("r - 1", "0")]
    first = next(origins(setting_of(system, fixed, system.domain)))
    assert [str(one) for one in first] == ["x", "r/2 + y - 1/2"]


def test_a_cascade_with_a_jordan_block_is_stable_holds() -> None:
    """No quadratic form with constant coefficients falls for all a."""
    rows = [("over", "a"), ("domain", "0 <= a and a < 1"), ("state", "x y z")]
    system = of_rule(MapRule("m", (*rows, ("piece", "a*x, x + a*y, y + a*z"))))
    (fixed,), proof = fixed_points(system), Proof()
    assert proof.add(system.rule("m/map")) == ""
    rules = weighted_distance_rules(setting_of(system, fixed, system.domain), "m/lyapunov")
    candidate, searches = next(rules)
    assert proof.add(candidate, (1,), 100_000, searches=searches) == ""


def test_no_weights_are_found_where_no_sample_is_in_range_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    setting = SimpleNamespace(system=SimpleNamespace(state=("x",)), count=1)
    none = np.zeros((2, 0)), np.zeros((2, 0)), SimpleNamespace()
    monkeypatch.setattr(part_metric, "values", lambda *_: none)
    assert part_metric._weights(setting, ["x", "1/x"]) == ()  # type: ignore[arg-type]


def epidemic(domain: str) -> MapRule:
    rows = [("over", "b g"), ("domain", domain), ("state", "s i")]
    space = "s >= 0 and i >= 0 and s + i <= 1"
    piece = "(s + 1)/2 - b*s*i, (1/2 - g)*i + b*s*i"
    return MapRule("m", (*rows, ("space", space), ("piece", piece)))


SUBCRITICAL = "0 < b and b < 1 and 0 < g and g < 1/2 and b < g + 1/2"


def test_an_infection_dies_out_at_all_rates_holds() -> None:
    """By a loss that goes to 0 where b goes to g + 1/2."""
    system = of_rule(epidemic(SUBCRITICAL))
    (fixed,), proof = (
        (one for one in fixed_points(system) if one.point.terms == ("1", "0")),
        Proof(),
    )
    assert proof.add(system.rule("m/map")) == ""
    setting = setting_of(system, fixed, system.domain)
    candidate, searches = next(weighted_distance_rules(setting, "m/lyapunov"))
    assert proof.add(candidate, (1, 2), 100_000, searches=searches) == ""
    assert "(-2*b + 2*g + 1)" in dict(candidate.rows)["loss"]


def test_an_infection_fails_to_die_out_without_the_bound_of_its_rate() -> None:
    system = of_rule(epidemic(SUBCRITICAL.replace(" and b < g + 1/2", "")))
    (fixed,) = (one for one in fixed_points(system) if one.point.terms == ("1", "0"))
    setting = setting_of(system, fixed, system.domain)
    assert not list(weighted_distance_rules(setting, "m/lyapunov"))


def test_parameters_close_to_the_ends_of_the_domain_are_in_it_holds() -> None:
    system = of_rule(epidemic(SUBCRITICAL))
    (fixed,) = (one for one in fixed_points(system) if one.point.terms == ("1", "0"))
    setting = setting_of(system, fixed, system.domain)
    wide = with_ends(setting).parameters
    left = wide["g"] + 1 / 2 - wide["b"]
    assert left.min() > 0 and left[: setting.count].min() > 10 * left.min()
    assert wide["b"].min() > 0 and wide["b"].max() < 1 and wide["g"].max() < 1 / 2


def vectors() -> MapRule:
    """R. Ross, The Prevention of Malaria, 1911: infected hosts and vectors."""
    rows = [("over", "a c"), ("domain", "3/10 < a and a <= 1/2 and 3/10 < c and c <= 1/2")]
    space = "0 < h and h <= 1 and 0 < v and v <= 1"
    rows += [("state", "h v"), ("space", space)]
    return MapRule("m", (*rows, ("piece", "4*h/5 + a*v*(1 - h), 7*v/10 + c*h*(1 - v)")))


def test_a_bilinear_map_is_stable_by_the_sign_of_its_slope_at_a_corner_holds() -> None:
    system = with_licences(of_rule(vectors()))
    (fixed,) = (one for one in fixed_points(system) if "0" not in one.point.terms)
    setting, proof = setting_of(system, fixed, system.domain), Proof()
    assert proof.add(system.rule("m/map")) == ""
    candidate, searches = next(ratio_rules(setting, "m/lyapunov"))
    assert proof.add(candidate, (1, 2), 100_000, searches=searches) == ""
    search = searches["falls-1-1"]
    assert isinstance(search, partial)
    corners = [sign for sign in search.keywords["signs"] if "value" in sign]
    assert len(corners) == 2  # one for each variable


def test_juveniles_and_adults_come_to_rest_by_few_facts_holds() -> None:
    """The mean of ratios, whose inverse is below the mean of the inverses: by what is squared."""
    rows = [("over", "b s m"), ("domain", "0 < s and s < 1 and 0 < m and m < 1 and m < b*s")]
    rows += [("state", "l a"), ("space", "l > 0 and a > 0")]
    system = with_licences(
        of_rule(MapRule("m", (*rows, ("piece", "b*a/(1 + a), s*l + (1 - m)*a"))))
    )
    (fixed,) = (one for one in fixed_points(system) if "0" not in one.point.terms)
    setting, proof = setting_of(system, fixed, system.domain), Proof()
    assert proof.add(system.rule("m/map")) == ""
    candidate, searches = next(ratio_rules(setting, "m/lyapunov"))
    assert proof.add(candidate, (1, 2), 100_000, searches=searches) == ""
