"""A fixed point as a parameter: what is certified of it, and what rests on samples."""

from __future__ import annotations

from dataclasses import replace

import pytest

from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points_as_parameters import MapWithPoint, by_its_point, has_one_point
from juggleproof.map_stability.search import of_several, search_stability
from tests.map_stability.maps import map_of


def relaxed(image: str, domain: str, space: str) -> Map:
    """A map of one variable with the parameter a."""
    text = f"over a\ndomain {domain}\nstate x\nspace {space}\npiece {image}"
    return map_of(text, "relaxed")


MAPS = {
    "root": relaxed("(2*x + a/x^2)/3", "a > 0", "x > 0"),
    "between": relaxed("x/2 + (a - x^3)/8", "0 < a and a < 1", "0 < x and x < 2"),
    "falls": relaxed("x + (1 - a*x - x^3)/8", "a > 0", "0 < x and x < 2"),
    "everywhere": relaxed("x/2 + (a - x^3)/8", "-1 < a and a < 1", "-2 < x and x < 2"),
}


@pytest.mark.parametrize("name", MAPS)
def test_each_value_of_a_parameter_has_one_point_holds(name: str) -> None:
    found = by_its_point(MAPS[name])
    assert found is not None and has_one_point(MAPS[name], found)


# the term of the old parameter, and the domain of the new one
FALSE = {
    "not-monotone": ("e^3 - e", "e > 0"),
    "misses-small-values": ("e^3", "e > 1"),
    "misses-large-values": ("e^3", "0 < e and e < 2"),
    "has-a-pole": ("e^3/(e - 1)^2", "e > 0"),
}


@pytest.mark.parametrize("name", FALSE)
def test_rejects_a_point_that_some_values_have_twice_or_not_at_all(name: str) -> None:
    term, domain = FALSE[name]
    renamed = replace(MAPS["root"], parameters=("e",), domain=domain, point=("e",))
    assert not has_one_point(MAPS["root"], MapWithPoint(renamed, "a", term))


def test_what_samples_alone_say_of_the_point_is_said_to_rest_on_them_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("juggleproof.map_stability.limits.POINT_WORK", 0)
    found = search_stability(MAPS["root"]).finding
    assert found.verdict == "in part"
    assert found.sentence.endswith(
        "; here a = e^3, where samples alone say that each a has one such e"
    )


SIGMOID = "a*x^2/(1 + x^2)"  # with two fixed points, both roots, where a > 2


def test_of_several_points_with_roots_none_attracts_another_holds() -> None:
    found = by_its_point(relaxed(SIGMOID, "a > 2", "x > 0"), several=True)
    assert found is not None
    assert (found.term, found.system.domain) == ("(e^2 + 1)/e", "e > 0 and e^2 - 2*e + 1 > 0")
    settled = of_several(found, 2_000_000, lambda line: None)
    assert settled is not None
    verdict, sentence = settled.finding.verdict, settled.finding.sentence
    assert (verdict, settled.proof.rules[-1].name) == ("in part", "relaxed/escapes")
    assert sentence.startswith("e does not attract 1/e, which is a fixed point; here a = ")


def test_none_attracts_another_fails_without_several_points() -> None:
    assert by_its_point(relaxed(SIGMOID, "a > 2", "x > 1"), several=True) is None
