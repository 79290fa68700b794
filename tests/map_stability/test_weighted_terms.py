"""Sums of absolute values with weights that depend on the parameters, up to the end of the domain
where a map contracts no norm of constant coefficients; and what a map does that jumps.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from juggleproof.map_stability.functions.templates import SizesOfForms, program
from juggleproof.map_stability.functions.weighted_terms import weighted_sum_candidates
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.search import Outcome, search_stability
from tests.map_stability.maps import at_point, map_of, proved


def lozi(domain: str) -> Map:
    """R. Lozi's map with b = 1/2 (Journal de Physique Colloques 39, 1978)."""
    return map_of(f"over a\ndomain {domain}\nstate x y\npiece 1 - a*abs(x) + y, x/2", "lozi")


def lozi_in_two(domain: str) -> Map:
    """The same with b as a parameter."""
    rows = f"domain 0 < a and 0 < b and {domain}\nstate x y\npiece 1 - a*abs(x) + y, b*x"
    return map_of(f"over a b\n{rows}", "lozi")


def proved_by_sums(system: Map) -> list[str]:
    """What is certified of the map by two such sums alone."""
    return proved(at_point(system), weighted_sum_candidates, 2)


@cache
def found_of_lozi() -> Outcome:
    """What is found of the map over the whole domain."""
    return search_stability(lozi("0 < a and a < 1"))


@pytest.mark.exhaust
def test_a_map_of_lozi_is_stable_if_and_only_if_it_contracts_holds() -> None:
    outcome = found_of_lozi()
    assert outcome.finding.verdict == "in part"
    assert outcome.finding.sentence.endswith("attracts every state if and only if a < 1/2")
    assert len(str(outcome.proof.certificates)) < 45_000


@pytest.mark.exhaust
def test_no_statement_is_left_that_the_theorem_does_not_name_holds() -> None:
    rules = {rule.name: rule for rule in found_of_lozi().proof.rules}
    named = {text for rule in rules.values() for _, text in rule.rows}
    assert set(rules) - named == {"lozi/exactly"}


def test_a_map_of_lozi_in_two_parameters_is_stable_where_it_contracts_holds() -> None:
    """The loss goes to 0 at an end of the domain that is given, not found."""
    assert proved_by_sums(lozi_in_two("a + b < 1")) == ["map", "lyapunov"]


@pytest.mark.exhaust
def test_a_map_of_lozi_in_two_parameters_fails_without_a_contraction() -> None:
    assert proved_by_sums(lozi_in_two("a + b <= 1")) == ["map"]


def test_rejects_a_map_of_lozi_beyond_where_it_contracts() -> None:
    assert proved_by_sums(lozi("1/2 <= a and a < 1")) == ["map"]


@pytest.mark.exhaust
def test_a_point_at_which_a_map_jumps_is_not_said_to_be_stable_holds() -> None:
    """At u = 1 the point of a leaky integrator behind a comparator is 0, from whose left all states
    go to 2 and beyond.
    """
    pieces = "piece x >= 0 -> p*x + u - 1\npiece x < 0 -> p*x + u + 1"
    rows = f"domain 0 < p and p < 1 and 0 < u and u < 2\nstate x\n{pieces}"
    outcome = search_stability(map_of(f"over p u\n{rows}"))
    assert outcome.finding.verdict == "in part"
    assert outcome.finding.sentence.endswith("attracts every state at least where u > 1")


@pytest.mark.parametrize("even", [True, False])
def test_the_terms_at_samples_are_those_of_the_statement_holds(even: bool) -> None:
    """max(0, t) and max(0, -t), or |t|, times 1 and a > 0, at states of all signs."""
    sides = SizesOfForms(("x_gap", "y_gap"), ("1", "a"), even)
    rng = np.random.default_rng(5)
    points = {name: rng.uniform(-1, 1, 40) for name in ("x_gap", "y_gap")}
    points["a"] = rng.uniform(0, 1, 40)
    numbers = list(map(int, rng.integers(0, 6, len(sides.every_term()))))
    values = sides.function(list(map(Fraction, numbers))).at(points, 40)
    assert np.allclose(sides.columns(points) @ numbers, values)


def test_a_program_of_many_rows_keeps_every_row_and_one_that_breaks_some_has_no_point_holds() -> (
    None
):
    angles = np.linspace(0, np.pi / 2, 5000)
    rows = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    bounds = np.full(2, -4.0), np.full(2, 4.0)
    found = program(rows, np.ones(5000), *bounds, np.array([3.0, 4.0]))
    assert found is not None and (rows @ found >= 1 - 1e-6).all()
    assert abs(found @ [3, 4] - 7) < 1e-6  # the least that the first and the last row allow
    corner = np.zeros((5000, 2))
    corner[1237] = 1, 1  # a row that the program does not begin with
    assert program(corner, 9 * corner[:, 0], *bounds, np.ones(2)) is None
    assert program(corner, 8 * corner[:, 0], *bounds, np.ones(2)) is not None
