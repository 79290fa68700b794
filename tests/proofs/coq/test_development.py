"""The Coq development: compiled whole, on the axioms of the reals only, pinned to the table that it
is written from.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import pytest

from juggleproof.proofs.theorem import coq
from juggleproof.proofs.theorem.coq import (
    STATEMENTS,
    AttractionText,
    PieceText,
    current,
    statements,
)
from tests.proofs.coq.development import SOURCES, Coq, order, rest_on_the_reals, theorems
from tests.share import share

# One change in so many; with JUGGLEPROOF_MUTANTS=many (make exhaust) each.
SHARE = share(3, 1)


def test_every_source_is_compiled_holds() -> None:
    assert sorted(order()) == sorted(path.name for path in SOURCES.rglob("*.v"))


def test_the_sources_admit_nothing_holds() -> None:
    for path in SOURCES.rglob("*.v"):
        text = re.sub(r"\(\*.*?\*\)", "", path.read_text(), flags=re.DOTALL)
        assert not re.search(
            r"\b(Admitted|admit|Axioms?|Parameters?|Conjecture|give_up|Unset|bypass_check"
            r"|Obligations?)\b",
            text,
        ), path
        assert (
            len(path.read_text().splitlines()) < 300
            and max(map(len, path.read_text().splitlines())) <= 200
        ), path


def test_the_statements_are_those_of_the_table_holds() -> None:
    assert (STATEMENTS).read_bytes() == current().encode()


@pytest.mark.exhaust
def test_the_theorems_rest_on_the_axioms_of_the_reals_alone_holds(development: Coq) -> None:
    names = theorems(STATEMENTS.read_text(), "Theorem|Lemma")
    rules = [
        "Rules.descent",
        "Rules.contraction",
        "Rules.fixed_point",
        "Rules.weighted_stability",
        "Rules.stability",
        "Rules.approach",
        "Rules.convergence",
        "Rules.periodic_orbit_stays_away",
        "Rules.escape_refutes",
        "Rules.exactly",
        "Rules.closed_form",
        "Rules.pieces_make_a_map",
        "Lists.lists_contraction",
        "Lists.lists_stability",
        "Lists.lists_approach",
        "Lists.lists_convergence",
        "RulesInFull.attraction",
        "Lyapunov.value_falls",
        "Lyapunov.rarely_far",
        "Lyapunov.lyapunov_fixed_point",
        "Lyapunov.lyapunov_stability",
        "Lyapunov.lyapunov_attraction",
        "Lyapunov.attraction_from_a_set",
        "Lyapunov.chetaev_leaves",
        "Lyapunov.chetaev_instability",
        "Lyapunov.same_pieces_agree",
        "Lyapunov.into_attraction",
        "Lyapunov.into_stability",
        "Lyapunov.instability_refutes",
        "Attractors.leads_on",
        "Attractors.an_end_is_met",
        "Attractors.settles",
        "Returns.by_coordinates",
        "Returns.an_end",
        "Ranks.smaller_ends",
        "Ranks.lexicographic_descent",
        "Ranks.greatest_descent",
        "Relation.relation_descent",
        "RelationRanks.relation_lexicographic_descent",
        "RelationRanks.relation_greatest_descent",
        "Relation.relation_contraction",
        "Relation.relation_stability",
        "Relation.relation_convergence",
        "Relation.relation_fixed_point",
        "Relation.relation_lyapunov_fixed_point",
        "Relation.stable_point_stays",
        "Relation.relation_lyapunov_stability",
        "Relation.relation_lyapunov_attraction",
        "Relation.relation_attraction",
        "RelationInto.relation_into_attraction",
        "RelationInto.relation_into_stability",
        "RelationInto.map_into_attraction",
        "RelationInto.map_into_stability",
        "Existence.execution_is_orbit",
        "Existence.table_exists",
        "Existence.ball_exists",
        "Existence.ball_is_unique",
        "FromPhysics.settling_bound",
        "FromPhysics.theorem_from_physics",
        "FromPhysics.sharp_from_physics",
    ]
    asked = [f"Statements.{name}" for name in names] + rules
    assert len(names) > 40
    assert rest_on_the_reals(development, asked)


def changed(**changes: object) -> Callable[[AttractionText], AttractionText]:
    return lambda theorem: replace(theorem, **changes)  # type: ignore[arg-type]


def stages(k: int, text: str) -> Callable[[AttractionText], AttractionText]:
    return lambda theorem: replace(
        theorem,
        stages=tuple(
            (name, text if i == k else was) for i, (name, was) in enumerate(theorem.stages)
        ),
    )


def contraction(**changes: object) -> Callable[[AttractionText], AttractionText]:
    def with_changes(theorem: AttractionText) -> AttractionText:
        inner = replace(theorem.contraction, **changes)  # type: ignore[arg-type]
        return replace(theorem, contraction=inner)

    return with_changes


TABLES: dict[str, Callable[[AttractionText], AttractionText]] = {
    "range": changed(given="0 < alpha and alpha < 1/2"),
    "space": changed(space="0 < x"),
    "first-image": lambda t: replace(
        t, pieces=(PieceText("x < w", ("alpha*w - x", "2 - alpha*w")), t.pieces[1])
    ),
    "second-image": lambda t: replace(
        t, pieces=(t.pieces[0], PieceText("w <= x", ("x - w", "w + 1")))
    ),
    "region": lambda t: replace(
        t, pieces=(PieceText("w < x", t.pieces[0].images), PieceText("x <= w", t.pieces[1].images))
    ),
    "second-region": lambda t: replace(
        t, pieces=(t.pieces[0], PieceText("w < x", t.pieces[1].images))
    ),
    "point": lambda t: replace(t, point=(("e_x", "2*alpha/(alpha + 1)"), t.point[1])),
    "root": changed(root=("u", "4*x + (w + 1)^2")),
    "rank": changed(rank="2*u - (1 - w)/2"),
    "first-stage": stages(0, "x < w and w < 7"),
    "second-stage": stages(1, "0 < w and x + w <= 3"),
    "trap": stages(2, "0 <= x and x < w and alpha*w < 2"),
    "a-stage-less": lambda t: replace(t, stages=t.stages[1:]),
    "weights": contraction(weights=("1", "2")),
    "rate": contraction(rate="alpha"),
    "radius": contraction(radius="1"),
    "size": changed(size="1/2"),
}


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(TABLES)[::SHARE])
def test_rejects_a_changed_table(name: str, development: Coq) -> None:
    theorem = TABLES[name](coq.ball())
    text = statements(
        theorem,
        coq.NEIGHBOURHOOD,
        coq.other_orbit(),
        coq.physical(),
        coq.boundary_speed(),
    )
    assert text != current()
    assert development.ask(text).rejected


TEXTS = {
    "stronger-bound": ("<= rate alpha ^ k.", "<= rate alpha ^ (k + 1)."),
    "earlier": ("rank s + 3 <= INR n", "rank s + 2 <= INR n"),
    "wider-threshold": ("<->\n  alpha < 1 / 3.", "<->\n  alpha < 1 / 2."),
    "wider-range": (
        "Theorem global : forall alpha, 0 < alpha /\\ alpha < 1 / 3",
        "Theorem global : forall alpha, 0 < alpha /\\ alpha <= 1 / 3",
    ),
    "iterate": ("| S k => f (iterate f k s)", "| S k => iterate f k s"),
    "attracting": (
        "exists N,\n  forall n, (N <= n)%nat ->",
        "exists N,\n  forall n, (n <= N)%nat ->",
    ),
    "stable": ("dist s e < delta -> forall n,", "dist s e < delta -> exists n,"),
    "dist": ("Rmax (Rabs (fst s - fst e))", "Rmin (Rabs (fst s - fst e))"),
    "period": ("(2 * n) (e_2 alpha)", "(3 * n) (e_2 alpha)"),
    "other-orbit": ("((6 * alpha - 2) /", "((6 * alpha - 1) /"),
    "physical-map": (
        "(beta * g + 2 * r * v - 2 * r ^ 2) / g, v - 2 * r",
        "(beta * g + 2 * r * v - 2 * r ^ 2) / g, v - r",
    ),
    "physical-range": (
        "Theorem physical_global : forall r g, 0 < r -> 0 < g ->",
        "Theorem physical_global : forall r g, 0 <= r -> 0 < g ->",
    ),
    "greatest-energy": ("r ^ 2 * (alpha + 1) ^ 2 / (2 *", "r ^ 2 * (alpha + 1) ^ 2 / (3 *"),
}


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(TEXTS)[::SHARE])
def test_rejects_a_changed_statement(name: str, development: Coq) -> None:
    old, new = TEXTS[name]
    assert old in current()
    assert development.ask(current().replace(old, new)).rejected
