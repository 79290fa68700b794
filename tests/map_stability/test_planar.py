"""Maps of two and three variables: what is proved or refuted of them, and that it is not where the
hypothesis is dropped.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from juggleproof import MapRule
from juggleproof.map_stability.certifying import ProvedStatements
from juggleproof.map_stability.search import search_stability
from tests.map_stability.maps import assert_settled, map_of, marked, name_of

STABLE, AWAY = "is stable and attracts every state", "is not stable"
COMPETITION = "state x y\nspace x > 0 and y > 0\npiece 5/2*x/(1 + x + C*y), 5/2*y/(1 + y + C*x)"
SPIRAL = "over b\ndomain {} < b and b < 2\nstate x y\npiece x - b*y, x"
SETTLED = {  # the first line of what is printed: the map
    f"refuted  spiral: (0, 0) {AWAY}": SPIRAL.format(1),
    f"in part  spirals: (0, 0) {STABLE} if and only if b < 1": SPIRAL.format(0),
    f"refuted  saddle: (0, 0, 0) {AWAY}": (
        "over a\ndomain 3/2 < a\nstate x y z\npiece y/2, z - x/2, a*z"
    ),
    (
        "proved   henon: ((b + sqrt(4*a + b^2 - 2*b + 1) - 1)/(2*a),"
        f" b*(b + sqrt(4*a + b^2 - 2*b + 1) - 1)/(2*a)) {STABLE}"
    ): (
        "over a b\ndomain 0 < a and a <= 1/10 and 0 < b and b <= 3/10\nstate x y\n"
        "space -2 <= x and x <= 2 and -1 <= y and y <= 1\npiece 1 - a*x^2 + y, b*x"
    ),
    f"proved   coexistence: (6/5, 6/5) {STABLE}": COMPETITION.replace("C", "(1/4)"),
    f"refuted  exclusion: (3/10, 3/10) {AWAY}": COMPETITION.replace("C", "4"),
}
RECRUITMENT = (
    "over p\ndomain 3/4 < p and p < 2\nstate x y\nspace x > 0 and y > 0\npiece x/2 + p*y/(1 + y), x"
)


LONG = {"henon", "coexistence", "spirals", "exclusion", "spiral"}


@pytest.mark.parametrize("line", marked(SETTLED, LONG, pytest.mark.exhaust), ids=name_of)
def test_a_map_of_several_variables_is_settled_as_it_behaves_holds(
    line: str, tmp_path: Path
) -> None:
    assert_settled(line, SETTLED[line], tmp_path)


def weaker(rule: MapRule, row: tuple[str, str]) -> MapRule:
    """The rule with another line in place of that of the same keyword."""
    return replace(rule, rows=tuple(row if one[0] == row[0] else one for one in rule.rows))


@pytest.mark.exhaust
def test_rejects_a_box_function_with_a_line_that_claims_more() -> None:
    found = search_stability(map_of(RECRUITMENT))
    assert found.finding.sentence == f"(2*p - 1, 2*p - 1) {STABLE}"
    the_map, lyapunov = found.proof.rules
    assert len([one for one in lyapunov.rows if one[0] == "value"]) == 4
    proof = ProvedStatements()
    assert proof.add(the_map)
    assert proof.add(lyapunov, (1,), 45_000)
    proof.keep(1)
    for row, premise in (
        (("domain", "1/4 < p and p < 2"), "falls-1-1"),
        (("upper", "1/4"), "small-1"),
        (("loss", "value"), "falls-1-1"),
        (("radius", "p"), "small-3"),
    ):
        assert not proof.add(weaker(lyapunov, row), (1,), 45_000)
        assert proof.fault == f"no proof of the premise {premise} was found"


def test_rejects_a_growth_rate_that_is_too_large() -> None:
    found = search_stability(map_of(SPIRAL.format(1)))
    the_map, unstable = found.proof.rules
    for row in (("rate", "3"), ("domain", "1/2 < b and b < 2"), ("upper", "1/100")):
        proof = ProvedStatements()
        assert proof.add(the_map)
        assert not proof.add(weaker(unstable, row), (1, 2), 100_000)
