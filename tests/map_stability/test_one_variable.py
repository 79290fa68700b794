"""Maps of one variable are proved stable by the distances on both sides of the point, and sharp
conditions by what fails outside: each with the same map where that is not so.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import sympy

from juggleproof.algebra.polynomials import Packing, Ring
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import ProvedStatements
from juggleproof.map_stability.domains import narrowed
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.chetaev import cone_functions
from juggleproof.map_stability.functions.two_sided import two_sided_candidates
from juggleproof.map_stability.points import fixed_points, roots_of
from juggleproof.map_stability.samples import region
from juggleproof.map_stability.search import search_stability
from juggleproof.map_stability.settings import setting_of
from juggleproof.search.psatz.linear_program import Program, normal_forms
from juggleproof.statements.work import Budget, Exhausted
from tests.map_stability.maps import assert_settled, map_of, marked, name_of

STABLE = "is stable and attracts every state"
CONVERTER = (
    "over k\ndomain {}\nstate v\nspace 22 <= v and v <= 29\n"
    "piece 0.88*v + 25/22*max(0, min(1, 1/2 - k*(v - 25)))^2*33*(33 - v)/v"
)
SIGMOID = "over r\ndomain r > 2\nstate x\nspace x >= {}\npiece r*x^2/(1 + x^2)"
HARVEST = "over r h\ndomain r > 1 and {}\nstate x\nspace x > 0\npiece (1 - h)*r*x/(1 + x)"
MOMENTUM = "over h m\ndomain {} and 0 <= m and m < 1\nstate x y\npiece (1 - h)*(x + m*(x - y)), x"
BORDER = (
    "over a b\ndomain {} and -1 < b and b < 0\nstate x\n"
    "piece x <= 0 -> a*x + 1\npiece x > 0 -> b*x + 1"
)
LOGISTIC = "state x\nspace 0 < x and x < 1\npiece {}*x*(1 - x)"
SETTLED = {  # the first line of what is printed: the map
    f"proved   converter: 25 {STABLE}": CONVERTER.format("0 < k and k < 0.03"),
    f"proved   threshold: ((r + sqrt(r^2 - 4))/2) {STABLE}": SIGMOID.format(1),
    "refuted  below-it: ((r + sqrt(r^2 - 4))/2) does not attract 0, which is a fixed point": (
        SIGMOID.format(0)
    ),
    (
        f"in part  harvest: (-h*r + r - 1) {STABLE} where -h*r + r - 1 > 0; elsewhere no state of"
        " the space is a fixed point"
    ): HARVEST.format("0 < h and h < 1"),
    "refuted  all-harvested: no state of the space is a fixed point": (
        HARVEST.format("(1 - h)*r <= 1 and 0 < h and h < 1")
    ),
    f"proved   peak: sqrt(r - 1) {STABLE}": (
        "over r\ndomain 1 < r and r < 10\nstate x\nspace x > 0\npiece r*x/(1 + x^2)"
    ),
    f"proved   cube-root: e {STABLE}; here a = e^3": (
        "over a\ndomain a > 0\nstate x\nspace x > 0\npiece (2*x + a/x^2)/3"
    ),
    f"proved   recessive: 0 {STABLE}": (
        "over s\ndomain 0 < s and s < 1\nstate q\nspace 0 <= q and q < 1\n"
        "piece q*(1 - s*q)/(1 - s*q^2)"
    ),
    "refuted  not-selected: 0 does not attract 1/2, which is a fixed point": (
        "state q\nspace 0 <= q and q < 1\npiece q*(1 - q^2)/(1 - q^2)"
    ),
    "refuted  two-cycles: sqrt(a) does not attract 1, which is periodic": (
        "over a\ndomain a > 1\nstate x\nspace x > 0\npiece max(a/x, 1)"
    ),
    f"in part  momentum: (0, 0) {STABLE} if and only if -2*h*m - h + 2*m + 2 > 0": (
        MOMENTUM.format("0 < h and h < 2")
    ),
    "refuted  too-long-steps: (0, 0) is not stable": (
        MOMENTUM.format("7/4 <= h and h < 2 and m >= 1/2")
    ),
    (
        f"in part  border: (-1/(b - 1)) {STABLE} where -a*b + 1 > 0; where -a*b + 1 < 0, it does"
        " not attract ((-b - 1)/(a*b - 1)), which is periodic; elsewhere nothing is known"
    ): BORDER.format("-3 < a and a < 0"),
    "refuted  cycle: (-1/(b - 1)) does not attract ((-b - 1)/(a*b - 1)), which is periodic": (
        BORDER.format("-3 < a and a < -2 and a*b > 1")
    ),
    f"proved   logistic-inside: 199/299 {STABLE}": LOGISTIC.format("2.99"),
    f"proved   logistic-at-end: 2/3 {STABLE}": LOGISTIC.format("3"),
    f"proved   logistic-by-name: ((a - 1)/a) {STABLE}": (
        "over a\ndomain a = 3\nstate x\nspace 0 < x and x < 1\npiece a*x*(1 - x)"
    ),
}


LONG = {"momentum", "border", "below-it", "harvest", "logistic-inside", "converter", "cycle"}
LONG |= {"threshold", "recessive", "logistic-by-name", "logistic-at-end", "peak", "too-long-steps"}


@pytest.mark.parametrize("line", marked(SETTLED, LONG, pytest.mark.exhaust), ids=name_of)
def test_a_map_is_settled_on_both_sides_of_its_condition_holds(line: str, tmp_path: Path) -> None:
    assert_settled(line, SETTLED[line], tmp_path)


def test_rejects_a_point_beyond_its_condition() -> None:
    assert search_stability(map_of(LOGISTIC.format("3.01"))).finding.verdict != "proved"


def setting_at(text: str) -> Setting:
    system = map_of(text)
    return setting_of(system, fixed_points(system)[0], system.domain)


@pytest.mark.parametrize(("step", "fits"), [("1/2", True), ("3/2", False)])
def test_rejects_distances_that_grow(step: str, fits: bool) -> None:
    """The multiplier at the point is 1 - 2 h for a step h, 0 or -2."""
    text = f"state x\nspace x > 0\npiece x - {step}*(x - 4/x)"
    assert bool(list(two_sided_candidates(setting_at(text)))) is fits


def test_a_condition_with_a_square_root_is_a_polynomial_holds() -> None:
    """The multiplier at (sqrt(4 s + 1) - 1)/(2 s) is 1 - sqrt(4 s + 1)."""
    text = "over s\ndomain 0 < s and s < {}\nstate p\nspace 0 <= p and p <= 1\npiece 1 - s*p^2"
    for end, rows in (("1", ["3 - 4*s > 0"]), ("1/2", [])):
        system = map_of(text.format(end))
        (fixed,) = fixed_points(system)
        assert narrowed(system, fixed, region(system.domain, ("s",), limits.PARAMETERS)) == rows


def test_linear_forms_grow_in_a_cone_that_is_kept_holds() -> None:
    """(x, y) -> (-(3 x + y), -(x + 3 y)) keeps x, y >= 0 up to the sign, with x + y 4 times."""
    (function,) = cone_functions(setting_at("state x y\npiece -3*x - y, -x - 3*y"))
    here = {name: np.array([v]) for name, v in (("x_gap", 1.0), ("y_gap", 2.0))}
    there = {name: np.array([v]) for name, v in (("x_gap", -5.0), ("y_gap", -7.0))}
    assert function.at(there, 1)[0] == 4 * function.at(here, 1)[0] > 0


def test_rejects_a_cone_that_is_turned() -> None:
    assert not list(cone_functions(setting_at("state x y\npiece 2*y, -2*x")))


@pytest.mark.parametrize(
    "text", ["(a*x - 1)*(x - b)", "x^2 - 2*a*x + b", "(2*x^2 - 8*a)*(x^3 - 2)"]
)
def test_factors_of_low_degree_have_these_zeros_holds(text: str) -> None:
    x, a, b = (sympy.Symbol(name, real=True) for name in "xab")
    equation = sympy.sympify(text.replace("^", "**"), {"x": x, "a": a, "b": b})
    found = list(roots_of(equation, x))
    assert len(found) == 2
    assert all(sympy.expand(equation.subs(x, root)).equals(0) for root in found)


def test_rejects_premises_beyond_the_work_that_is_granted() -> None:
    rule = map_of("state x\nspace 0 <= x and x <= 1\npiece x/2").rule("m/map")
    proof = ProvedStatements(most=0)
    assert not proof.add(rule) and proof.fault.startswith("no proof of the premise")
    proof.grant(10_000)
    assert proof.add(rule)


def test_rejects_normal_forms_beyond_the_budget() -> None:
    """x^40 modulo x = y + z has 41 terms."""
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    packing, program = Packing(ring, [x**40 * y**40 * z**40]), Program()
    keys, values = packing.row(x - y - z)
    program.add_rewriting(packing.exponents(keys[:1])[0], keys, values)
    program.exponents = packing.exponents
    power, _ = packing.row(x**40)
    with pytest.raises(Exhausted):
        normal_forms(power, program, Budget(10))
    (form,) = normal_forms(power, program, Budget(10_000))
    assert len(form) == 41
