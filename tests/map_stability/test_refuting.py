"""Refutations, each with a map that has not the hypothesis, of which nothing like it is said; and
divisors whose sign follows from bounds.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
import sympy

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import EFFORTS, ProvedStatements
from juggleproof.map_stability.failing import is_fixed
from juggleproof.map_stability.points import as_point
from juggleproof.map_stability.refuting import instability_rules
from juggleproof.map_stability.search import without_empty_pieces
from tests.command import running
from tests.map_stability.maps import assert_settled, at_point, map_of, marked, name_of

STABLE = "is stable and attracts every state"
NO_FIXED_POINT = "no state of the space is a fixed point"
CYCLE = "over a\ndomain {}\nstate i\npiece i <= 0 -> i + 1\npiece i > 0 -> 1 - a*i"
BALL = "over r\ndomain 0 < r and r < 1\nstate v t\nspace v >= 0 and t >= 0\npiece r*v, {}"
TENT = "over m\ndomain 0 < m and m < {}\nstate x\nspace 0 <= x and x <= 1\npiece m*min(x, 1 - x)"
PHASE = "state x\npiece x < 0 -> x + {}\npiece x >= 0 -> x - 1/3"
SLOPE = "over b\ndomain 1/2 <= b and b <= 1\nstate x\n" + "\n".join(
    [
        "piece x <= -1/4 -> {0}*x + b",
        "piece -1/4 < x and x < 1/4 -> {0}*x",
        "piece x >= 1/4 -> {0}*x - b",
    ]
)
SETTLED = {  # the first line of what is printed: the map
    f"in part  unstable-cycle: (1/(a + 1)) {STABLE} if and only if a < 1": (
        CYCLE.format("0 < a and a < 2")
    ),
    f"proved   no-cycle: (1/(a + 1)) {STABLE}": CYCLE.format("0 < a and a < 1"),
    "refuted  line: (0, 0) does not attract (0, 1/2), which is a fixed point": BALL.format("t + v"),
    # a multiplier is 1 for all parameters
    "refuted  plane-of-two-rates: (0, 0) does not attract (1/2, 1/2), which is a fixed point": (
        "over a b\ndomain 0 < a and a < 1 and 0 < b and b < 1\nstate x y\n"
        "piece (1 - a)*x + a*y, (1 - b)*y + b*x"
    ),
    # L. A. Metzler, Review of Economics and Statistics 23, 1941
    (
        f"in part  focus: (-1/(b - 1), -1/(b - 1)) {STABLE} where -b*k - b + 1 > 0;"
        " where -b*k - b + 1 < 0, it is not stable; elsewhere nothing is known"
    ): (
        "over b k\ndomain 0 < b and b < 1 and 0 < k and k < 1\nstate y z\n"
        "piece (2 + k)*b*y - (1 + k)*b*z + 1, y"
    ),
    # of a divisor that is not 0 on the closed space
    (
        "refuted  quotient-in-a-guard: ((-h + sqrt(h^2 - 10*h + 9) + 3)/2) does not attract 0,"
        " which is a fixed point"
    ): "over h\ndomain 0 < h and h < 1\nstate x\nspace x >= 0\npiece max(0, 4*x/(1 + x) - h)",
    f"proved   no-line: (0, 0) {STABLE}": BALL.format("t/2 + v"),
    "refuted  rotation: (1, 1) does not attract (0, 0), which is periodic": (
        "state x y\npiece 1 - y + abs(x), x"
    ),
    f"proved   spiral: (0, 0) {STABLE}": "state x y\npiece (x - y)/2, x/2",
    "refuted  period-nine: (0, 0) does not attract (-1/2, 1/4), which is periodic": (
        "state x y\npiece abs(x) - y, x"
    ),
    f"in part  boundary: 0 {STABLE} if and only if m < 1": TENT.format("2"),
    f"proved   no-boundary: 0 {STABLE}": TENT.format("1"),
    f"refuted  nowhere: {NO_FIXED_POINT}": PHASE.format("1/2"),
    f"refuted  nowhere-in-quotients: {NO_FIXED_POINT}": "state x\nspace x > 0\npiece x + 1/x",
    "refuted  somewhere: (-1/2) does not attract (-1), which is a fixed point": PHASE.format("0"),
    # where the first variable drifts, the second may rest
    f"proved   drift-beside-rest: (0, 0) {STABLE}": (
        "over h\ndomain 0 < h and h < 1\nstate x y\n"
        "piece x - h*max(-1, min(1, x - y)), y - h*max(-1, min(1, y))"
    ),
    "refuted  each-unstable: (-b) is not stable; 0 is not stable; b is not stable": (
        SLOPE.format("2")
    ),
    f"proved   bound: 1 {STABLE}": (
        "state v\nspace 1 <= v and v <= 2\npiece v/2 + max(0, 1 - v)/v + 1/2"
    ),
    # without parameters
    f"proved   root: ((sqrt(5) - 1)/2) {STABLE}": "state x\nspace x > 0\npiece 1/(1 + x)",
}


LONG = {"focus", "drift-beside-rest", "no-line", "quotient-in-a-guard", "boundary"}
LONG |= {"unstable-cycle", "no-cycle", "root", "no-boundary"}


@pytest.mark.parametrize("line", marked(SETTLED, LONG, pytest.mark.exhaust), ids=name_of)
def test_a_map_is_refuted_where_it_has_the_hypothesis_holds(line: str, tmp_path: Path) -> None:
    assert_settled(line, SETTLED[line], tmp_path)


def test_the_divisor_of_a_point_has_no_root_holds() -> None:
    q = sympy.Symbol("q", real=True)
    point = as_point((q / (q + sympy.sqrt(q + 1)), 1 / sympy.sqrt(q + 1)))
    assert point is not None
    assert point.roots == (("root_1", "q + 1"),)
    assert point.terms == ("-q*(q - root_1)/(-q^2 + q + 1)", "root_1/(q + 1)")


def test_equal_roots_that_are_written_in_two_ways_have_one_name_holds() -> None:
    q = sympy.Symbol("q", real=True)
    point = as_point((sympy.sqrt(q * (q + 1)) + 1, sympy.sqrt(sympy.expand(q * (q + 1))) - 1))
    assert point is not None and point.roots == (("root_1", "q*(q + 1)"),)
    assert point.terms == ("root_1 + 1", "root_1 - 1")


def test_rejects_a_point_that_is_not_fixed() -> None:
    """Of such a point `escapes` is true as well."""
    text = "over a\ndomain 1 < a and a < 4\nstate x\nspace 0 < x and x < 1\npiece a*x*(1 - x)"
    setting = at_point(map_of(text))
    assert is_fixed(setting)
    for term in ("1/2", "(a + 1)/(2*a)", "2"):
        assert not is_fixed(replace(setting, point=replace(setting.point, terms=(term,))))


def test_a_false_premise_is_not_sought_for_long_holds() -> None:
    text = "statement a/a\nforall x y\ngiven x > 0 and y > 0\nshow x^3 + y^3 > 2*x*y"
    proof = ProvedStatements()
    assert (
        proof.proof_of(checker.read_statements(text)["a/a"], EFFORTS, limits.PREMISE_WORK) is None
    )
    assert proof.work < 3000


def test_the_budget_is_named_where_it_ended_the_search_holds() -> None:
    """T. S. Motzkin's polynomial is no sum of squares, nor is more work to be done for it."""
    text = "statement a/a\nforall x y\nshow x^4*y^2 + x^2*y^4 + 1 >= 3*x^2*y^2"
    premise, said = checker.read_statements(text)["a/a"], []
    for budget in (100, 10_000):
        proof = ProvedStatements(open=("lyapunov", "falls-1-1", premise))
        assert proof.proof_of(premise, (1,), budget) is None
        said.append(proof.why())
    assert "try --budget" in said[0]
    assert "and not for want of budget" in said[1] and "try" not in said[1]


def test_growth_is_seen_where_the_rate_begins_at_1_holds() -> None:
    """E. Oja, Journal of Mathematical Biology 15, 1982: for h near 1 only very near the point."""
    text = "over h\ndomain 1 < h and h < 3/2\nstate w\nspace w > 0\npiece w + h*w*(1 - w^2)"
    rules = instability_rules(at_point(map_of(text)), "m/unstable")
    found = {dict(rule.rows)["rate"] for rule in rules}
    assert "1 + (h - 1)" in found


@pytest.mark.exhaust
def test_what_is_tried_names_the_roots_of_the_point_holds(tmp_path: Path) -> None:
    """R. M. May, Journal of Animal Ecology 47, 1978; numbers in place of l are advised."""
    path = tmp_path / "host.map"
    path.write_text(
        "over l\ndomain 1 < l and l < 10\nstate h p\nspace h > 0 and p > 0\n"
        "piece l*h/(1 + p/2)^2, h - h/(1 + p/2)^2\n"
    )
    lines = running.run("stability", str(path)).stdout.split("\n")
    assert "  fixed point ((-2*l + 2*root_1^3)/(l - 1), 2*root_1 - 2), root_1 = sqrt(l)" in lines
    assert "advice   with numbers in place of l more may be found" in lines


def test_pieces_that_samples_miss_are_kept_holds() -> None:
    guards = ("x <= 10^4", "10^4 < x and x < 10^4 + 1", "x >= 10^4 + 1")
    system = map_of("\n".join(["state x", *(f"piece {guard} -> x/2" for guard in guards)]))
    assert without_empty_pieces(system) == system


@pytest.mark.parametrize(("image", "known"), [("(x + a)/4", 0), ("(a*x + 1)/4", 1)])
def test_a_point_without_parameters_in_divisors_needs_no_equations_holds(
    image: str, known: int
) -> None:
    """a/3 is put in; of 1/(4 - a) premises have the equation."""
    setting = at_point(map_of(f"over a\ndomain 0 < a and a < 2\nstate x\npiece {image}"))
    assert len(setting.have) == known
