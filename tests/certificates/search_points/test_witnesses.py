"""Witnesses for `exists`: rational functions, adjoined roots and case splits, each accepted by the checker."""

import pytest

from certificates import checker
from certificates.search.points import search_found
from tests.certificates.search_points.cases import UNIT, budget, read

WITNESSES = {
    "linear system": (f"""statement w/fixed
forall alpha
{UNIT}
have 1 + alpha > 0
exists x w
show x = alpha*(w - x) and w = 2 - alpha*w""", {"w": "2/(alpha + 1)", "x": "(2*alpha)/(alpha + 1)^2"}),
    "without a licensed denominator": (f"""statement w/inverse
forall alpha
{UNIT}
exists w
show w = 2 - alpha*w""", {"w": "2*inverse"}),
    "an end of a constraint": ("""statement w/between
forall w
given w > 0
exists x
with x >= 0
show x < w""", {"x": "0"}),
    "a square root": ("""statement w/root
forall a
given a > 0
exists y
with y > 0
show y^2 = a""", {"y": "y_"}),
    "below two bounds": (f"""statement w/delta
forall alpha
{UNIT}
exists delta
with delta > 0
show delta < alpha and delta < 1 - alpha""", {"delta": "-alpha^2 + alpha"}),
    "time to collision": ("""statement w/collision
forall r g beta v
given r > 0 and g > 0
given beta >= 0
given g*beta/2 + r*v < r^2
have v < r
exists t
with 0 <= t and t < 2*r/g
show beta + v*t = r*t""", {"t": "beta/(r - v)"}),
}


def witness(statement: checker.Statement) -> list:
    story = checker.Unfolding(statement, checker.Context())
    base = {name: story.context.values[name] for name in story.universal}
    found = search_found(statement, story.state(), "witness", base, {}, budget(), effort=1)
    checker.find(story.state(), found, {}, "witness", {statement.name: statement}, base)
    return found


@pytest.mark.parametrize("case", WITNESSES)
def test_witness(case):
    text, terms = WITNESSES[case]
    assert witness(read(text))[2] == terms


def test_the_larger_of_two_needs_a_case_split():
    found = witness(read("statement w/maximum\nforall a b\nexists m\nshow m >= a and m >= b and (m = a or m = b)"))
    assert found[:2] == ["sign", "a - b"]
    assert [part[2] for part in found[2:]] == [{"m": "b"}, {"m": "a"}, {"m": "a"}]


def test_no_witness_for_what_does_not_exist():
    statement = read("statement w/none\nforall a\nexists y\nshow y^2 = a - 1 and a > 2")
    story = checker.Unfolding(statement, checker.Context())
    base = {"a": story.context.values["a"]}
    assert search_found(statement, story.state(), "witness", base, {}, budget(), effort=1) is None
