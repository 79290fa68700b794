"""Ranges of the results are read whole; figures get what they show from the claims and
from the theorem's definition.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

import pytest

from juggleproof.proofs.figures import TABLE, certified
from juggleproof.reports import figures
from juggleproof.reports.figures import rows, without_range
from juggleproof.reports.words import read
from juggleproof.statements.language import ClaimError, equal, reals
from tests.reports.results_table import results

if TYPE_CHECKING:
    from juggleproof.proofs.figures.ours import Interval

F = Fraction

OF_VERDICTS = sorted(one.slug for one in TABLE if one.of_verdicts)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0 < alpha < 1/3", [("", [(F(0), F(1, 3), False, False)])]),
        ("nowhere", [("", [])]),
        ("1/3 <= alpha < 1", [("", [(F(1, 3), F(1), True, False)])]),
        ("alpha = 1/3", [("", [(F(1, 3), F(1, 3), True, True)])]),
        (
            "0 < alpha <= 1/2 or alpha = 3/4",
            [("", [(F(0), F(1, 2), False, True), (F(3, 4), F(3, 4), True, True)])],
        ),
        (
            "rest-of-H: 0 < alpha < 1; as-in-11: nowhere",
            [("rest-of-H", [(F(0), F(1), False, False)]), ("as-in-11", [])],
        ),
        (
            "(K - 1)/(K + 1) <= alpha < K/(K + 2)",
            [
                ("K = 2", [(F(1, 3), F(1, 2), True, False)]),
                ("K = 3", [(F(1, 2), F(3, 5), True, False)]),
            ],
        ),
        (
            "ceiling: alpha = (n - 1)/(n + 1) for a whole number n",
            [
                ("ceiling, n = 2", [(F(1, 3), F(1, 3), True, True)]),
                ("ceiling, n = 3", [(F(1, 2), F(1, 2), True, True)]),
            ],
        ),
        (
            (
                "a: 0 < alpha < c1; c1 = 0.25..., a root of 4*alpha - 1; b: 0 < alpha <= c1; c1 ="
                " 0.5..., a root of 2*alpha - 1"
            ),
            [("a", [(F(0), F(1, 4), False, False)]), ("b", [(F(0), F(1, 2), False, True)])],
        ),
        ("floor: nowhere; sampled: not found", [("floor", []), ("sampled", None)]),
    ],
)
def test_range_is_read_holds(text: str, expected: list[tuple[str, list[Interval]]]) -> None:
    assert read(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "alpha^2*eps > 1",
        "0 < alpha < c1",
        "0 < alpha < 1 where K = 2",
        "0 < alpha < __import__('os')",
        "alpha = 1/0",
        "0 < alpha < 2**3",
        "0 < alpha < 0.5",
        "alpha = 1/3 and more",
        "0 < alpha < )",
    ],
)
def test_rejects_what_it_does_not_read(text: str) -> None:
    assert [intervals for _, intervals in read(text)] == [None] * len(read(text))


def test_every_range_of_the_results_is_read_holds() -> None:
    entries = results()
    ranges = rows(entries)
    assert len(entries) > 250 and without_range(entries) > 50
    # a range told as "at least" has no known end: it is not drawn
    assert {name for name, _, intervals in ranges if intervals is None} == {
        one.claim.id for one in entries if (one.sharp or "").startswith("at least ")
    }
    assert {name.split(" ")[0] for name, _, _ in ranges} | {
        one.claim.id for one in entries if one.sharp == "no alpha"
    } == {one.claim.id for one in entries}
    assert ("theorem", "holds", [(F(0), F(1, 3), False, False)]) in ranges
    assert all(
        0 <= low <= high <= 1 for _, _, intervals in ranges for low, high, _, _ in intervals or []
    )


def test_trap_and_rank_are_those_of_the_theorem_holds() -> None:
    from sympy import symbols

    from juggleproof.proofs.theorem.definition import TO_THE_POINT, TRAP

    alpha, u, w, x = symbols("alpha u w x")
    rank, (root, square), margins = certified.what_the_trap_shows()
    assert str(TO_THE_POINT.rank) == "2*u + (1 - w)/2" and rank.equals(2 * u + (1 - w) / 2)
    assert root == u and square.equals(4 * x + (w - 1) ** 2)
    assert str(TRAP) == "0 <= x and x < w and alpha*w < 1" and margins == [
        (x, False),
        (w - x, True),
        (1 - alpha * w, True),
    ]


def test_rejects_a_margin_of_an_equation() -> None:
    x, w = reals("x w")
    with pytest.raises(ClaimError, match="no inequality"):
        certified.margin(equal(x, w))
    assert [certified.margin(one)[1] for one in (x < w, x <= w, x > w, x >= w)] == [
        True,
        False,
        True,
        False,
    ]


def test_term_becomes_the_same_expression_holds() -> None:
    from sympy import Rational

    x, w = reals("x w")
    expression = certified.to_sympy(-((x - 3 * w) ** 2) / (w + F(1, 2)))
    assert expression.subs({"x": 1, "w": 2}) == -25 / Rational(5, 2)


def test_saved_figures_are_all_there_and_kept_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib")
    contents = SimpleNamespace(entries=results())
    monkeypatch.setenv("JUGGLEPROOF_CACHE", str(tmp_path))
    first = figures.saved(contents)
    assert [one.slug for one in first] == [one.slug for one in TABLE] and all(
        one.data.startswith(b"<?xml") for one in first
    )
    assert (
        sum(len(one.data) for one in first) < 600_000
        and max(len(one.data) for one in first if not of_all_claims(one.slug)) < 60_000
    )
    drawn = drawn_again(monkeypatch)
    again = figures.saved(contents)
    assert drawn == OF_VERDICTS
    assert [one for one in again if one.slug not in drawn] == [
        one for one in first if one.slug not in drawn
    ]


def of_all_claims(slug: str) -> bool:
    return slug in ("fig-ranges", "fig-argument")


def drawn_again(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of figures that are drawn from now on, quickly."""
    drawn: list[str] = []

    def quick(contents: object, leaving_out: Sequence[str]) -> list[tuple[object, ...]]:
        made = [one.slug for one in TABLE if one.slug not in leaving_out]
        drawn.extend(sorted(made))
        return [(slug, "", "", "", None) for slug in made]

    monkeypatch.setattr(figures, "figures", quick)
    monkeypatch.setattr(figures, "_file", lambda figure, slug, form: slug.encode())
    return drawn


def test_kept_figures_are_drawn_again_where_damaged_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("JUGGLEPROOF_CACHE", str(tmp_path))
    drawn, every = drawn_again(monkeypatch), len(TABLE)
    contents = SimpleNamespace(entries=results())
    figures.saved(contents)
    assert len(drawn) == every
    (kept,) = tmp_path.glob("figures-svg-*.json")
    kept.write_bytes(kept.read_bytes()[:-40])
    figures.saved(contents)
    assert len(drawn) == 2 * every
    figures.saved(contents, "pdf")
    assert len(drawn) == 3 * every


def test_rejects_verdicts_from_a_kept_figure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a changed file says of them is drawn over."""
    monkeypatch.setenv("JUGGLEPROOF_CACHE", str(tmp_path))
    drawn_again(monkeypatch)
    contents = SimpleNamespace(entries=results())
    figures.saved(contents)
    (kept,) = tmp_path.glob("figures-svg-*.json")
    records = [{"slug": one.slug, "data": "bGll"} for one in TABLE]
    kept.write_text(json.dumps(records))
    said = {one.slug: one.data for one in figures.saved(contents)}
    assert all(said[slug] == slug.encode() for slug in OF_VERDICTS)


def test_rejects_an_unknown_form() -> None:
    with pytest.raises(ClaimError, match="'gif' is no form of figures"):
        figures.saved(SimpleNamespace(entries=()), "gif")


def test_figures_fail_without_matplotlib(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ClaimError, match="matplotlib is needed"):
        figures.figures(SimpleNamespace(entries=()))
