"""What claims say of their parameters and scales, and what is found where they say nothing: the
engine knows no name.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from juggleproof.certificates import checker
from juggleproof.judging.claims import Assertion, CheckedApart, Claim
from juggleproof.judging.forms import Vocabulary, always, domains_of
from juggleproof.judging.judge import judge
from juggleproof.judging.judgement import Judgement, Resources
from juggleproof.papers.paper import opened
from juggleproof.proofs.paper.names import STANDING
from juggleproof.search.scales import with_scales
from juggleproof.statements.language import (
    NO_ROLES,
    Formula,
    Roles,
    Statement,
    Term,
    equal,
    reals,
)
from tests.rows import each_row

ROOT = Path(__file__).resolve().parents[2]
SINE = ROOT / "certificates" / "sine"  # of one theorem, whose parameters it names
# The reader, the reports, the scenes and the command speak of this paper's symbols still
SPEAKING = {"reading", "reports", "scenes", "command", "sine", "drawing"}
SPEAKING |= {"coq_orbits"}  # where g is a function of Coq
ENGINE = [
    *(path for path in sorted((ROOT / "certificates").rglob("*.py")) if path.parent != SINE),
    *(
        path
        for path in sorted((ROOT / "juggleproof").rglob("*.py"))
        if path.relative_to(ROOT).parts[1] not in SPEAKING
    ),
]
a, alpha, q, r, g, v = reals("a alpha q r g v")


def judged(*statements: Statement, **said: Any) -> Judgement:
    """The judgement on a claim of one's own."""
    parts = [one.named(f"part-{k}") for k, one in enumerate(statements)]
    claim = Claim("own", "", "", "says", lambda: Assertion(tuple(parts)), **said)
    return judge(claim, Resources(routes=("exact",)))


def scales(show: Formula, given: Sequence[Formula], roles: Roles = NO_ROLES) -> set[str]:
    """The scales that homogeneity finds in a statement."""
    statement = always(show, given=given, label="own/main")
    (parsed,) = checker.read_statements(statement.text()).values()
    return set(with_scales(roles, checker.Unfolding(parsed, checker.Context())).scales or ())


# -------------------------------------------------------------------------------------------------
# Names mean nothing.


@each_row("among", ["range lines", "givens"])
@each_row(("parameter", "other"), [(alpha, q), (alpha, r), (a, q), (g, r)])
def test_a_claim_has_one_sharp_range_however_it_is_spelled_holds(
    parameter: Term, other: Term, among: str
) -> None:
    domain, bounds = [parameter > 0, parameter < 1], [other > 2, other < 3]
    found = judged(
        always(parameter * other < 1, in_range=domain, given=bounds)
        if among == "range lines"
        else always(parameter * other < 1, given=[*domain, *bounds])
    )
    assert found.sharp[""].text == f"0 < {parameter} <= 1/3"
    assert found.outcomes["own/sharp"] == "certified"


def _docstrings(tree: ast.AST) -> Iterator[int]:
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and node.body:
            first = node.body[0]
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
                yield id(first.value)


def names_of_the_paper(text: str) -> list[str]:
    """Where a source file names the paper's parameter, or holds the names of its scales."""
    if not re.search(r"alpha|[\"'][rg][\"']", text):
        return []
    tree = ast.parse(text)
    outside = set(_docstrings(tree))
    return [
        f"{node.lineno}: {ast.unparse(node)}"
        for node in ast.walk(tree)
        if isinstance(node, ast.Name)
        and node.id == "alpha"
        or isinstance(node, ast.Attribute)
        and node.attr == "alpha"
        or isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and id(node) not in outside
        and re.search(r"\balpha\b|^[rg]$", node.value)
    ]


@each_row("path", ENGINE)
def test_engine_names_nothing_of_the_paper_holds(path: Path) -> None:
    assert names_of_the_paper(path.read_text(encoding="utf-8")) == []


@each_row(
    "text",
    [
        'x = {"alpha"}',
        'x = n not in ("r", "g")',
        'x = "0 < alpha < 1"',
        "x = alpha > 0",
        "x = symbolic.alpha",
    ],
)
def test_rejects_an_engine_that_names_the_paper(text: str) -> None:
    assert names_of_the_paper(text)
    assert not names_of_the_paper(f"def f():\n    '''{text}'''")


# -------------------------------------------------------------------------------------------------
# Parameters and their domains.


def texts(*statements: Statement, named: Sequence[str] | None = None) -> dict[str, list[str]]:
    return {
        name: [str(one) for one in said] for name, said in domains_of(statements, named).items()
    }


def test_range_lines_tell_the_parameters_holds() -> None:
    assert texts(always(a * q < 9, in_range=[a > 1, a <= 4], given=[q > 0, q < 1])) == {
        "a": ["a > 1", "a <= 4"]
    }


def test_givens_tell_a_parameter_between_0_and_1_holds() -> None:
    assert texts(always(a * q < 1, given=[a > 0, a < 1, q > 2, q < 3])) == {"a": ["a > 0", "a < 1"]}


def test_parameter_fails_without_both_bounds() -> None:
    assert texts(always(a * q < 1, given=[a > 0, q > 2])) == {}


def test_parameter_fails_without_being_the_only_one_between_0_and_1() -> None:
    assert texts(always(a * q < 1, given=[a > 0, a < 1, q > 0, q < 1])) == {}


def test_rejects_a_domain_of_which_two_statements_say_different_things() -> None:
    low, high = always(a < 2, in_range=[a > 0, a < 1]), always(a < 2, in_range=[a > 0, a < 3])
    assert texts(low, low) == {"a": ["a > 0", "a < 1"]}
    assert texts(low, high) == {}


def test_a_claim_names_its_parameters_holds() -> None:
    both = [a > 3, a < 4, q > 2, q < 5]
    assert texts(always(a * q > 10, given=both), named=("q",)) == {"q": ["q > 2", "q < 5"]}
    found = judged(always(a * q > 10, given=both), parameters=("q",))
    assert found.sharp[""].text == "10/3 <= q < 5"


def test_no_range_is_sought_over_no_parameter_holds() -> None:
    assert judged(always(3 * a < 1, in_range=[a > 0, a < 1]), parameters=()).sharp == {}


def test_a_domain_without_an_end_holds() -> None:
    assert judged(always(a * q > 10, in_range=[a > 1], given=[q > 2])).sharp[""].text == "a >= 5"


def test_vocabulary_says_the_domain_holds() -> None:
    wide = Vocabulary(domains={"a": (a > 0, a < 1)}, scales=frozenset())
    part = always(3 * a < 1, in_range=[4 * a < 1, a > 0])
    assert judged(part, vocabulary=wide).sharp[""].text == "0 < a < 1/3"
    assert judged(part).sharp[""].text == "0 < a < 1/4"


def test_every_claim_of_the_paper_has_the_papers_parameter_holds() -> None:
    for claim in opened().claims():
        roles = claim.roles([])
        # the part of section 2.1 has no restitution alpha, what another checker reads no statement
        other = claim.section in ("part", "2.1") or isinstance(claim.body(), CheckedApart)
        assert roles.parameter == "alpha" or other, claim.id
    assert STANDING.scales == {"r", "g"}


def test_sign_of_a_denominator_is_guessed_where_its_variable_lies_holds() -> None:
    lines = always(1 / (1 - a**2) > 0, given=[a > 0, a < 1]).text().splitlines()
    assert "have 1 - a^2 > 0" in lines


# -------------------------------------------------------------------------------------------------
# Scales.


def test_a_unit_of_homogeneous_formulas_is_a_scale_holds() -> None:
    assert scales(v * v < 4 * r * r, [r > 0, v > -r, v < r]) == {"r"}


def test_scale_fails_without_being_positive() -> None:
    assert scales(v * v < 4 * r * r, [v > -r, v < r]) == set()


def test_scale_fails_without_homogeneity() -> None:
    assert scales(v * r < 9, [r > 2, r < 3, v < r]) == set()
    assert scales(v * r < 9, [r > 0, v < r]) == set()


def test_scale_fails_without_being_free_of_the_parameter() -> None:
    homogeneous = [r > 0, a > 0, v < a * r]
    assert scales(v < 2 * a * r, homogeneous) == {"a", "r"}
    assert scales(v < 2 * a * r, homogeneous, Roles({"a": (a > 0,)})) == {"r"}


def test_a_vocabulary_without_scales_is_asked_before_homogeneity_holds() -> None:
    roles = Roles(scales=frozenset())
    assert scales(v * v < 4 * r * r, [r > 0, v > -r, v < r], roles) == set()


def test_range_fails_without_the_bounds_of_what_looks_like_a_unit() -> None:
    bounded = judged(always(a * r < 1, in_range=[a > 0, a < 1], given=[r > 2, r < 3]))
    free = judged(always(a * r < 1, in_range=[a > 0, a < 1], given=[r > 0]))
    assert bounded.sharp[""].text == "0 < a <= 1/3"
    assert free.sharp[""].text == "nowhere"


def test_equation_with_a_scale_holds() -> None:
    found = judged(always(v <= r, in_range=[a > 0, a < 1], given=[r > 0, equal(v, 3 * a * r)]))
    assert found.sharp[""].text == "0 < a <= 1/3"
