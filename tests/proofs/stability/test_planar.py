"""Maps of two and three variables: what is proved or refuted of them, and that it is not where the
hypothesis is dropped.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from juggleproof import MapRule
from juggleproof.proofs.stability.certifying import Proof
from juggleproof.proofs.stability.maps import read_rows
from juggleproof.proofs.stability.search import search_stability
from tests.proofs.command import running

STABLE, AWAY = "is stable and attracts every state", "is not stable"
COMPETITION = "state x y\nspace x > 0 and y > 0\npiece 5/2*x/(1 + x + C*y), 5/2*y/(1 + y + C*x)"
SETTLED = {  # name: (text, exit code, first line)
    "spiral": (
        "over b\ndomain 1 < b and b < 2\nstate x y\npiece x - b*y, x",
        1,
        f"refuted  spiral: (0, 0) {AWAY}",
    ),
    "spirals": (
        "over b\ndomain 0 < b and b < 2\nstate x y\npiece x - b*y, x",
        3,
        f"in part  spirals: (0, 0) {STABLE} if and only if b < 1",
    ),
    "saddle": (
        "over a\ndomain 3/2 < a\nstate x y z\npiece y/2, z - x/2, a*z",
        1,
        f"refuted  saddle: (0, 0, 0) {AWAY}",
    ),
    "henon": (
        "over a b\ndomain 0 < a and a <= 1/10 and 0 < b and b <= 3/10\nstate x y\n"
        "space -2 <= x and x <= 2 and -1 <= y and y <= 1\npiece 1 - a*x^2 + y, b*x",
        0,
        "proved   henon: ((b + sqrt(4*a + b^2 - 2*b + 1) - 1)/(2*a),"
        f" b*(b + sqrt(4*a + b^2 - 2*b + 1) - 1)/(2*a)) {STABLE}",
    ),
    "coexistence": (
        COMPETITION.replace("C", "(1/4)"),
        0,
        f"proved   coexistence: (6/5, 6/5) {STABLE}",
    ),
    "exclusion": (COMPETITION.replace("C", "4"), 1, f"refuted  exclusion: (3/10, 3/10) {AWAY}"),
}
RECRUITMENT = (
    ("over", "p"),
    ("domain", "3/4 < p and p < 2"),
    ("state", "x y"),
    ("space", "x > 0 and y > 0"),
    ("piece", "x/2 + p*y/(1 + y), x"),
)


@pytest.mark.parametrize("name", SETTLED)
def test_a_map_of_several_variables_is_settled_as_it_behaves_holds(
    name: str, tmp_path: Path
) -> None:
    text, code, line = SETTLED[name]
    (tmp_path / f"{name}.map").write_text(text + "\n")
    done = running.run("stability", str(tmp_path / f"{name}.map"))
    assert (done.returncode, done.stderr, done.stdout.split("\n")[0]) == (code, "", line)


def weaker(rule: MapRule, row: tuple[str, str]) -> MapRule:
    """The rule with another line in place of that of the same keyword."""
    return replace(rule, rows=tuple(row if one[0] == row[0] else one for one in rule.rows))


def test_rejects_a_box_function_with_a_line_that_claims_more() -> None:
    found = search_stability(read_rows("recruitment", RECRUITMENT))
    assert found.finding.sentence == f"(2*p - 1, 2*p - 1) {STABLE}"
    the_map, lyapunov = found.proof.rules
    assert len([one for one in lyapunov.rows if one[0] == "value"]) == 4
    proof = Proof()
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
    text = SETTLED["spiral"][0].split("\n")
    found = search_stability(
        read_rows("spiral", [(line.split()[0], line.partition(" ")[2]) for line in text])
    )
    the_map, unstable = found.proof.rules
    for row in (("rate", "3"), ("domain", "1/2 < b and b < 2"), ("upper", "1/100")):
        proof = Proof()
        assert proof.add(the_map)
        assert not proof.add(weaker(unstable, row), (1, 2), 100_000)
