"""Hostile sizes end as rejections within counted work: no hang, and no memory without bound."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from pathlib import Path

import pytest

from tests.certificates.checker.harness import CLOSE, OPEN, Json, lines, proof

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = f"""
import json, resource, sys
resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
resource.setrlimit(resource.RLIMIT_CPU, (20, 20))
sys.path.insert(0, {str(ROOT)!r})
from juggleproof.certificates import checker
for text, certificate in json.load(sys.stdin):
    *known, (_, statement) = checker.read_statements(text).items()
    work = checker.Work(checker.MAX_WORK // 20)
    outcome = checker.check_one(statement, certificate, dict(known), {{}}, work)
    print(*outcome, flush=True)
"""
AT = {"x": "0", "y": "0", "z": "0"}
ROWS = ("forall x y z", "given x >= 0", "given x <= 1", "show x < 2")
BIG = str(10**4000)


def sampled(bits: int, degree: int) -> str:
    source = random.Random(degree)
    return " + ".join(f"{source.getrandbits(bits)}*x^{k}" for k in range(degree + 1))


def power_sum(name: str, step: int = 1, count: int = 60) -> str:
    return "(" + " + ".join(f"{name}^{step * k}" for k in range(count)) + ")"


def summand(term: str) -> Json:
    return ["psatz", [[1, [], term]], []]


def nested(depth: int) -> str:
    return "x < y" if depth == 0 else f"iff({nested(depth - 1)}, x < {depth})"


def negated(p: str, node: Json) -> Json:
    return ["sign", f"-({p})", node, OPEN, OPEN]


def on_unit(tree: str) -> Json:
    return ["boxes", 3, [[0, 1]], tree]


NODES: dict[str, Json] = {
    "a power of a power": summand("((x + y + z)^40)^40"),
    "a tower of powers": summand("(((x^60)^60)^60)^60"),
    "terms without number": summand(
        "*".join(power_sum(name, step) for name in "xyz" for step in (1, 60))
    ),
    "huge coefficients": summand(
        power_sum(f"{BIG}*x") + "*" + power_sum(f"{BIG}*y") + "*" + power_sum(f"{BIG}*z")
    ),
    "a product of numbers without end": summand("*".join(["2^4000"] * 30_000)),
    "a product of fractions without end": summand("*".join(["((1/3)^2500)"] * 20_000)),
    "a huge number": summand(f"{BIG}^4000"),
    "many summands after a long one": [
        "psatz",
        [[1, [], "(x + y + z + 1)^12"], *[[1, [], "1"]] * 200_000],
        [],
    ],
    "a box tree of degree 150": negated(f"{sampled(60, 150)} - 2^61", on_unit("a" * 500)),
    "a box tree of degree 40, long coefficients": negated(
        f"{sampled(4000, 40)} - 2^3999*4", on_unit("a" * 5000)
    ),
    "a long numerator at the end of an interval": negated(
        f"{BIG}*x + {BIG[:-1]}7", negated("x^3000 - 3", ["boxes", 4, [[3, 1]], "a."])
    ),
    "a long denominator at the end of an interval": negated(
        f"{BIG}*x - 1", negated("x^3000 - 3", ["boxes", 4, [[3, 1]], "a."])
    ),
    "denominators without bound": [
        "psatz",
        [[f"1/{10**300 + k}", [], "1"] for k in range(300)],
        [],
    ],
    "a power of a fact": ["psatz", [[1, [[0, 4000], [1, 4000], [2, 4000]], "1"]], []],
}
SHOWS: dict[str, str] = {
    "a denominator to a power of a power": "(((1/z)^4000)^4000)^4000 + 1 > 0",
    "a product of quotients": "*".join(f"((x + {k})/z^{k})" for k in range(80)) + " + 1/z >= 0",
    "equivalences of equivalences": nested(60),
}
WIDE = (
    "forall x y z",
    *(f"given {name} {side}" for name in "xyz" for side in (">= -1/7", "<= 3/5")),
)
LONG = (
    "forall x y z",
    *(
        f"given {name} {side}"
        for name in "xyz"
        for side in (f">= 1/{BIG[:-3]}1", f"<= {BIG[:-2]}7")
    ),
)
VARIABLES = [f"v{k}" for k in range(40)]
MANY = (
    "forall " + " ".join(VARIABLES),
    *(f"given {name} {side}" for name in VARIABLES for side in (">= 0", "<= 1")),
)
SIDES = [[2 * k, 2 * k + 1] for k in range(40)]
BOXES: dict[str, tuple[tuple[str, ...], str, list[list[int]], str]] = {
    "a box tree of halves without end": (WIDE, "x^2 + y^2 + z^2 > -1", SIDES[:3], "a" * 500_000),
    "a box tree of halves of a high degree": (WIDE, "x^200 > -1", SIDES[:1], "a" * 100_000),
    "a box tree of two axes without end": (WIDE, "(x + y + z)^2 > -1", SIDES[:3], "cba" * 100_000),
    "a degree that no box tree can have": (WIDE, "x^3999 > -1", SIDES[:1], "."),
    "a power on the unit box": (
        ("forall x y z", "given x >= 0", "given x <= 1"),
        "x^3999 < 2",
        SIDES[:1],
        ".",
    ),
    "three degrees that no box tree can have": (WIDE, "(x*y*z)^200 > -1", SIDES[:3], "."),
    "ends with long numbers": (LONG, "(x*y*z)^20 > -1", SIDES[:3], "abc" * 1000),
    "an axis for each of forty variables": (MANY, "*".join(VARIABLES) + " <= 2", SIDES, "."),
    "the faces of forty variables": (MANY, " + ".join(VARIABLES) + " <= 41", SIDES, "A" * 40 + "."),
}
PIECES = [f"piece x >= {k} and x < {k + 1} -> x" for k in range(1500)]
DEEP: Json = CLOSE
for _ in range(150):
    DEEP = ["sign", "x", CLOSE, CLOSE, DEEP]
FORKS: Json = ["cases", 0, [CLOSE, CLOSE]]
LEMMAS: dict[str, tuple[str, Json]] = {
    "a map of 1,500 pieces": (
        lines("over a", "domain a > 0", "state x", "space x >= 0", *PIECES),
        {"certified": {}},
    ),
    "a periodic orbit of a million steps": (
        lines(
            "over a", "domain a > 0", "state x", "space x >= 0", "piece x >= 0 -> x", name="a/map"
        )
        + "\n"
        + lines("map a/map", "domain a > 0", "point 0", "start 1", "word" + " 1" * 900_000),
        {"certified": {}},
    ),
    "branches of a state with many facts": (
        lines("forall x", *[f"given x > -{k}" for k in range(4000)], "show x < 2"),
        proof(["sign", "x", *[["sign", "x", *[["sign", "x", *[DEEP] * 3]] * 3]] * 3], at=AT),
    ),
    "licences without number": (
        lines(
            "forall x",
            *[f"given x > -{k + 1}" for k in range(1500)],
            "show " + "*".join(f"(1/(x + {k + 1}))" for k in range(1500)) + " > 0",
        ),
        proof(CLOSE, at=AT),
    ),
}
CASES: dict[str, tuple[str, Json]] = {
    **LEMMAS,
    **{
        name: (lines(*rows, f"show {shown}"), proof(["boxes", len(rows) - 1, sides, tree], at=AT))
        for name, (rows, shown, sides, tree) in BOXES.items()
    },
    **{name: (lines(*ROWS), proof(node, at=AT)) for name, node in NODES.items()},
    **{
        name: (lines("forall x y z", "given z > 0", f"show {text}"), proof(CLOSE, at=AT))
        for name, text in SHOWS.items()
    },
}


@pytest.fixture(scope="module")
def outcomes() -> dict[str, str]:
    """{name: what the checker says}, from one process with bounded memory and time; a name is
    missing where it did not end.
    """
    sent = json.dumps(list(CASES.values()))
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], input=sent, capture_output=True, text=True, timeout=120
    )
    return dict(zip(CASES, done.stdout.splitlines()))


@pytest.mark.parametrize("name", CASES)
def test_ends_in_a_rejection(outcomes: dict[str, str], name: str) -> None:
    assert outcomes[name].startswith("rejected ")


def test_hostile_files_end_in_an_outcome_or_are_refused() -> None:
    """`python -m tests.certificates.checker.fuzz 100000` tries more."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.certificates.checker.fuzz", "1000"],
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    assert done.returncode == 0, done.stdout
    for word in ("certified", "refuted", "rejected", "refused"):
        assert f" {word}" in done.stdout
