"""The theorem from flight and impact: no other law of motion, and no other range, is accepted."""

from __future__ import annotations

import pytest

from tests.proofs.coq.development import Coq, order, rejects
from tests.share import share

SHARE = share(4, 1)
PHYSICS = ("Executions.v", "Bouncing.v", "Existence.v", "FromPhysics.v")

DEFINITIONS = {
    "no-impact-law": (
        "velocity below - alpha * (velocity body - velocity below))",
        "velocity body)",
    ),
    "impact-law-sign": ("velocity below - alpha *", "velocity below + alpha *"),
    "flight": ("- g * t ^ 2 / 2,", "- g * t ^ 2,"),
    "below-the-surface": ("height (surface t) <= height (body t);", "True;"),
    "impacts-accumulate": (
        "apart : forall s, 0 <= s -> exists t, s < t",
        "apart : forall s, 0 <= s -> exists t, s <= t",
    ),
    "table-with-loss": ("execution g 1 ground table", "execution g (1 / 2) ground table"),
    "table-energy": ("energy g (table 0) = r ^ 2 / 2", "energy g (table 0) = r ^ 2"),
    "table-before-its-bounce": ("after 1 (ground t) (table t)", "table t"),
    "early": ("from <= t ->", "t <= from ->"),
    "velocities-at-impacts": ("Rabs (s - t) <= epsilon -> ~", "False -> ~"),
    "period": ("limit (t + period r g)", "limit (t + period r g / 2)"),
}

THEOREMS = {
    "range": ("0 < alpha < 1 / 3 -> is_table", "0 < alpha < 1 / 2 -> is_table"),
    "no-table": ("0 < alpha < 1 / 3 -> is_table g r table ->", "0 < alpha < 1 / 3 ->"),
    "sharp": ("<-> alpha < 1 / 3", "<-> alpha < 1 / 2"),
    "no-gravity": ("alpha table : 0 < g ->", "alpha table : 0 <= g ->"),
    "rank": ("(body bounce)) + 3 <= INR n", "(body bounce)) + 2 <= INR n"),
    "heights": ("<= 2 * r * T * (2 * alpha) ^ k /\\", "<= 2 * r * T * (2 * alpha) ^ S k /\\"),
    "velocities": ("<= r * (2 * alpha) ^ k) /\\", "<= r / 2 * (2 * alpha) ^ k) /\\"),
}


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(DEFINITIONS)[::SHARE])
def test_rejects_a_changed_definition(name: str, development: Coq) -> None:
    assert [file for file in order() if file in PHYSICS] == list(PHYSICS)
    assert rejects(development, PHYSICS[0], *DEFINITIONS[name], later=PHYSICS[1:])


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(THEOREMS)[::SHARE])
def test_rejects_a_changed_theorem(name: str, development: Coq) -> None:
    assert rejects(development, PHYSICS[-1], *THEOREMS[name])
