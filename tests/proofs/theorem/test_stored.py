"""The theorem as it is stored: take any certificate from it, or weaken any line of it, and the
checker names the place and the theorem is lost.
"""

from __future__ import annotations

from typing import Any

from juggleproof.certificates import checker
from juggleproof.statements.store import DEFAULT, Store
from tests.rows import each_row

Json = Any
STORE = Store(DEFAULT)
TEXTS = {name: text for name, text in STORE.texts.items() if name.startswith("theorem/")}
CERTIFICATES = {name: STORE.certificate(name, text) for name, text in TEXTS.items()}
NODES = [
    (name, premise)
    for name, one in CERTIFICATES.items()
    if isinstance(one["certified"], dict)
    for premise in one["certified"]
]

# Lines of the theorem, each with what says more than is true, or proves less than is asked.
WEAKENED = [
    ("theorem/map", "space 0 <= x", "space -1 <= x"),
    ("theorem/map", "piece x < w ->", "piece x <= w ->"),
    ("theorem/map", "piece x < w ->", "piece x + 1 < w ->"),
    ("theorem/map", "2 - alpha*w", "1 - alpha*w"),
    ("theorem/map", "w + 2", "w + 1"),
    ("theorem/map", "x - w, w + 2", "x - 2*w, w + 2"),
    ("theorem/descends", "3*alpha < 1", "3*alpha < 2"),
    ("theorem/descends", "3*alpha < 1", "3*alpha <= 1"),
    ("theorem/descends", "rank 2*u", "rank u"),
    ("theorem/descends", "rank 2*u + (1 - w)/2", "rank 2*u + (1 - w)/3"),
    ("theorem/descends", "w < 6", "w < 5"),
    ("theorem/descends", "x + w <= 2", "x + w <= 1"),
    ("theorem/descends", "alpha*w < 1\n", "alpha*w < 1/2\n"),
    ("theorem/contracts", "rate 2*alpha", "rate alpha"),
    ("theorem/contracts", "radius 1/2", "radius 2"),
    ("theorem/contracts", "size 1", "size 1/2"),
    ("theorem/contracts", "point 2*alpha/(alpha + 1)^2", "point alpha/(alpha + 1)^2"),
    ("theorem/contracts", "3*alpha < 1", "5*alpha < 3"),
    ("theorem/contracts", "on 0 <= x and x < w and alpha*w < 1", "on alpha*w < 1"),
    ("theorem/attracts", "descent theorem/descends", "descent theorem/contracts"),
    ("theorem/escapes", "3*alpha >= 1", "4*alpha >= 1"),
    ("theorem/escapes", "word 1 2", "word 1"),
    ("theorem/escapes", "start (6*alpha - 2)/(alpha + 1)^2", "start 2*alpha/(alpha + 1)^2"),
    ("theorem/exactly", "escape theorem/escapes", "escape theorem/attracts"),
]


def results(texts: dict[str, str], certificates: dict[str, Json]) -> dict[str, tuple[str, str]]:
    """{name: (outcome, reason)} by the checker."""
    known: dict[str, Any] = {}
    found: dict[str, tuple[str, str]] = {}
    for name, statement in checker.read_statements("\n\n".join(texts.values())).items():
        outcome, reason = checker.check_one(statement, certificates.get(name, {}), known, {})
        found[name] = outcome, str(reason or "")
        if outcome == "certified":
            known[name] = statement
    return found


def test_theorem_holds() -> None:
    assert {outcome for outcome, _ in results(TEXTS, CERTIFICATES).values()} == {"certified"}
    assert len(NODES) >= 30


@each_row(("name", "premise"), NODES)
def test_theorem_fails_without_a_premise(name: str, premise: str) -> None:
    fewer = {key: proof for key, proof in CERTIFICATES[name]["certified"].items() if key != premise}
    found = results(TEXTS, {**CERTIFICATES, name: {"certified": fewer}})
    assert found[name] == (
        "rejected",
        f"the premises of a rule are missing or left over: ['{premise}']",
    )
    assert found["theorem/exactly"][0] == "rejected"


@each_row("name", list(TEXTS))
def test_theorem_fails_without_a_certificate(name: str) -> None:
    found = results(TEXTS, {key: one for key, one in CERTIFICATES.items() if key != name})
    assert found[name][0] == found["theorem/exactly"][0] == "rejected"
    resting = [
        other
        for other, (outcome, reason) in found.items()
        if other != name and outcome == "rejected" and name in reason
    ]
    assert resting or name == "theorem/exactly"


@each_row(("name", "old", "new"), WEAKENED)
def test_theorem_fails_with_a_weakened_line(name: str, old: str, new: str) -> None:
    if old not in TEXTS[name]:
        raise ValueError(f"{old!r} does not stand in {name}")
    found = results({**TEXTS, name: TEXTS[name].replace(old, new)}, CERTIFICATES)
    rejected = [other for other, (outcome, _) in found.items() if outcome == "rejected"]
    assert rejected and rejected[-1] == "theorem/exactly"
    assert name == "theorem/map" or rejected[0] == name
