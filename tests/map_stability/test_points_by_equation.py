"""A fixed point by an equation: what is certified of it, and what rests on samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import sympy

from juggleproof.map_stability.functions.contracting_boxes import beside
from juggleproof.map_stability.maps import HIGH
from juggleproof.map_stability.points import fixed_points
from juggleproof.map_stability.points_as_parameters import MapWithPoint
from juggleproof.map_stability.points_by_equation import WithEquation, by_an_equation, has_a_zero
from juggleproof.map_stability.samples import region
from juggleproof.map_stability.search import search_stability
from tests.map_stability.maps import at_point, map_of

HASSELL = map_of("state x\nspace x > 0\npiece 2*x/(1 + x)^3")
PLANE = "state x y\nspace x >= 0 and y >= 0\npiece "
UNIT = "over a\ndomain 0 < a and a < 1\n"
UNITS = map_of(f"{PLANE}x/4 + 1/(2*(1 + y^2)), y/3 + 1/(2*(1 + x))")
TOGGLE = map_of(f"{UNIT}{PLANE}x/2 + a/(2*(1 + y^2)), y/2 + a/(2*(1 + x^2))")
SUM = map_of("over a\ndomain 0 < a\nstate x\nspace x > 0\npiece x + (a^2 - x^3 - a^3*x)/8")


def test_a_number_is_a_zero_in_an_interval_holds() -> None:
    found = by_an_equation(HASSELL)
    assert isinstance(found, WithEquation) and has_a_zero(HASSELL, found)
    assert found.system.domain == "e^3 + 3*e^2 + 3*e - 1 = 0 and e > 1/4 and e < 17/64"


@pytest.mark.exhaust
def test_a_map_whose_fixed_point_is_a_number_is_settled_holds() -> None:
    outcome = search_stability(HASSELL)
    assert outcome.finding.verdict == "proved"
    assert outcome.finding.sentence == (
        "e is stable and attracts every state; here e is the zero of"
        " e^3 + 3*e^2 + 3*e - 1 with e > 1/4 and e < 17/64"
    )


def test_coordinates_are_terms_in_one_of_them_holds() -> None:
    found = by_an_equation(UNITS)
    assert isinstance(found, WithEquation)
    assert found.system.point == ("e^2 - 3*e/4 + 2/3", "e")
    (point,) = fixed_points(found.system)
    zeros = np.roots([12, -9, 20, -9])
    e = zeros.real[np.abs(zeros.imag) < 1e-9]
    x, y = point.point.at({"e": e})
    assert np.allclose(y, e) and np.allclose(UNITS.next({"x": x, "y": y}), [x, y])


def test_a_parameter_that_the_equation_is_linear_in_makes_room_holds() -> None:
    found = by_an_equation(TOGGLE)
    assert isinstance(found, MapWithPoint)
    assert (found.term, found.system.point) == ("e*(e^2 + 1)", ("e", "e"))


def test_an_equation_with_parameters_stays_in_the_domain_holds() -> None:
    found = by_an_equation(SUM)
    assert isinstance(found, WithEquation) and has_a_zero(SUM, found)
    points = region(found.system.domain, found.system.parameters, 50)
    a, e = points["a"], points["e"]
    assert len(e) == 50 and np.allclose(a**2 - e**3 - a**3 * e, 0, atol=1e-6 * (1 + a**2).max())


def test_the_only_zero_of_an_equation_is_told_by_it_alone_holds() -> None:
    found = by_an_equation(map_of(f"{UNIT}state x\npiece x - (x^3 + x - a^2)/8"))
    assert found is not None
    says = found.meaning(map_of(f"{UNIT}state x\npiece x")).sentence
    assert says.startswith("here e is the zero of -a^2 + e^3 + e")


FALSE = {
    "no-zero": ("e^2 + 1", "e > 0 and e < 1"),
    "no-change-of-sign": ("(2*e - 1)^2", "e > 0 and e < 1"),
    "elsewhere": ("2*e - 1", "e > 2 and e < 3"),
    "not-all-of-the-conditions": ("2*e - 1", "e > 0 and e < 1 and e > 1/2"),
}


@pytest.mark.parametrize("name", FALSE)
def test_rejects_that_there_is_a_zero_where_there_is_none(name: str) -> None:
    text, where = FALSE[name]
    e = sympy.Symbol("e", real=True)
    polynomial = sympy.sympify(text.replace("^", "**"), locals={"e": e})
    system = replace(HASSELL, parameters=("e",), domain=f"{text} = 0 and {where}", point=("e",))
    assert not has_a_zero(HASSELL, WithEquation(system, "e", polynomial, where))


@pytest.mark.exhaust
def test_what_samples_alone_say_of_the_zero_is_said_to_rest_on_them_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("juggleproof.map_stability.limits.POINT_WORK", 0)
    found = search_stability(HASSELL).finding
    assert found.verdict == "in part"
    assert found.sentence.endswith("e < 17/64, where samples alone say that there is one")


def test_no_equation_is_taken_where_two_zeros_are_states() -> None:
    assert by_an_equation(map_of("state x\npiece x + (x^3 - 3*x + 1)/8")) is None


def test_ends_of_boxes_that_are_roots_of_numbers_are_left_out_holds() -> None:
    found = by_an_equation(UNITS)
    assert found is not None
    setting = at_point(found.system)
    ends = [sympy.sqrt(34), sympy.Integer(6)]
    assert beside(setting, (1, HIGH), None, ends) == 6
