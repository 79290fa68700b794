"""The theorem of the second checker: no other law of motion, and no weaker finding, is accepted."""

from __future__ import annotations

import pytest

from tests.proofs.coq.development import Coq, order, rejects, rest_on_the_reals, source, theorems
from tests.share import share

SHARE = share(6, 1)
SINE = tuple(file for file in order() if file.startswith("Sine"))

# (file, what it says, what it does not prove)
CHANGES = {
    "flight": ("SineTable.v", "- (y - fst z) ^ 2 / 2.", "- (y - fst z) ^ 2."),
    "restitution": (
        "SineTable.v",
        "velocity (fst z) + alpha * snd z.",
        "velocity (fst z) - alpha * snd z.",
    ),
    "through-the-table": ("SineTable.v", "fst w -> 0 <= gap z y) /\\", "fst w -> True) /\\"),
    "saddle": ("SineTable.v", "Rabs x < 1 / 2 -> 0 < downward x ->", "Rabs x < 1 / 2 ->"),
    "rests-where-it-falls": (
        "SineMotions.v",
        "(forall y, a <= y <= b -> downward y <= 1) /\\ rises b.",
        "(forall y, a <= y < a -> downward y <= 1) /\\ rises b.",
    ),
    "launch": ("SineMotions.v", "~ forall z, b < z < b + d -> downward z <= 1.", "True."),
    "no-time": ("SineMotions.v", "= 0 -> fst z < fst w ->", "= 0 -> fst z <= fst w ->"),
    "in-bounded-time": (
        "SineMotions.v",
        "forall time, exists n, time < fst (z n).",
        "exists time, forall n, time < fst (z n).",
    ),
    "strip": (
        "SineStrip.v",
        ":= rho + sqrt ((rho + alpha * s) ^ 2 + 2 * rho / PI).",
        ":= rho + sqrt ((rho + alpha * s) ^ 2 + rho / PI).",
    ),
    "any-copy-of-the-arc": (
        "SineDescent.v",
        "snd w <= top -> arc k w \\/ below",
        "snd w <= top -> (exists l, arc l w) \\/ below",
    ),
    "rank-of-rest": (
        "SineDescent.v",
        "downward (fst z) <= 1 -> (at_rest < n)%nat.",
        "downward (fst z) <= 1 -> (at_rest <= n)%nat.",
    ),
    "convexity": (
        "SineLanding.v",
        "+ (spread + 1) ^ 2 / 2.",
        "+ (spread + 1) ^ 2 / 4.",
    ),
    "norm": ("SineTrap.v", "* weight <= rate * weight.", "* weight <= 2 * rate * weight."),
    "trap-falls": ("SineTrap.v", "(alpha = 0 -> 1 < S_low)", "(alpha = 0 -> 0 < S_low)"),
    "rate": ("SineBounce.v", "rate_range : 0 < rate < 1.", "rate_range : 0 < rate <= 1."),
    "real-saddle": ("SineBounce.v", "reach -> 0 < downward x.", "reach -> -1 < downward x."),
    "next-copy-of-the-arc": ("SineGrid.v", "-> arc_cell k m q \\/", "-> arc_cell (k + 1) m q \\/"),
    "rank-stays": (
        "SineGrid.v",
        "(rank m q < rank i r)%nat)",
        "(rank m q <= rank i r)%nat)",
    ),
    "arc-left-out": (
        "SineGrid.v",
        "IZR last / N <= y <= IZR first / N + 1 ->",
        "IZR last / N < y <= IZR first / N + 1 ->",
    ),
    "absorbs": (
        "SineTheorem.v",
        "greatest_arrival alpha rho top < top",
        "greatest_arrival alpha rho top <= top",
    ),
    "without-the-bounce": (
        "SineTheorem.v",
        "trap_has_the_bounce : slowest <= 1 / (1 + alpha) <=",
        "trap_has_the_bounce : 1 / (1 + alpha) <=",
    ),
    "edge": (
        "SineTheorem.v",
        "slowest < 1 / (1 + alpha) < fastest ->",
        "slowest <= 1 / (1 + alpha) <= fastest ->",
    ),
    "period": ("SineTheorem.v", "motion (fun n => (INR n,", "motion (fun n => (2 * INR n,"),
}


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(CHANGES)[::SHARE])
def test_rejects_a_changed_law_or_finding(name: str, development: Coq) -> None:
    file, old, new = CHANGES[name]
    assert rejects(development, file, old, new, later=SINE[SINE.index(file) + 1 :])


@pytest.mark.exhaust
def test_the_theorems_rest_on_the_axioms_of_the_reals_alone_holds(development: Coq) -> None:
    names = [
        f"{file.removesuffix('.v')}.{name}" for file in SINE for name in theorems(source(file))
    ]
    assert len(names) > 20
    assert rest_on_the_reals(development, names)
