"""Maps are read as they are written, exactly, or refused in one line that names file and mend."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from juggleproof.proofs.stability.given import holds, read_rows
from tests.proofs.command import running

Number = Fraction | int
NUMBERS = some.fractions(-3, 3, max_denominator=4)  # ties are frequent

REJECTED = {
    "": "{file}: a line `state ..` is missing",
    "state x": "{file}: a line `piece ..` is missing",
    "state x\npiece x/2\nover a": (
        "{file}:3: over comes too late; write over, domain, state, space, piece, point"
    ),
    "state x\nmap x/2": (
        "{file}:2: map is no line of a map; write over, domain, state, space, piece, point"
    ),
    "state x\nspace 0 <= x <\npiece x/2": "{file}:2: unreadable text: 0 <= x <",
    "state x\npiece 1.2.3*x": "{file}:2: unreadable text: 1.2.3*x",
    "state x\npiece x/2, x": (
        "{file}: piece x/2, x: 2 terms for 1 state variables; write GUARD -> a term for each of x"
    ),
    "state x\npiece x > 0 -> x/2 -> x": (
        "{file}: piece x > 0 -> x/2 -> x: two arrows; write GUARD -> TERM, .."
    ),
    "state x\npiece a*x": "{file}: a in a * x is neither parameter nor state variable",
    "state x\npiece sin(x)": "{file}: sin in sin(x) is neither parameter nor state variable",
    "over a\ndomain a > b\nstate x\npiece a*x": (
        "{file}: b in a > b is no parameter; name it in `over`"
    ),
    "state x\nstate y\npiece x": "{file}: state stands twice; write one such line",
    "over x\nstate x\npiece x/2": (
        "{file}: x is named twice; write it once, in `over` or in `state`"
    ),
    "state 1x\npiece 2": "{file}: 1x is no name; write letters, digits and _",
    "state x\npiece abs(x, 1)": "{file}: abs(x, 1): abs takes one term, max and min one or more",
    "state x\npiece x/2\npoint 0, 0": ("{file}: point has not a term for each of x; write so many"),
    "state x\npiece " + " + ".join(f"abs(x - {k})" for k in range(7)): (
        "{file}: more than 64 cases of abs, max and min in one piece"
    ),
}


@pytest.mark.parametrize("text", REJECTED)
def test_rejects_a_file_that_is_no_map_in_one_line(text: str, tmp_path: Path) -> None:
    file = tmp_path / "wrong.map"
    file.write_text(text + "\n")
    done = running.run("stability", str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"juggleproof: {REJECTED[text].format(file=file)}\n"


def test_rejects_a_file_that_is_not_there(tmp_path: Path) -> None:
    done = running.run("stability", str(tmp_path / "none.map"))
    assert done.returncode == 2 and "none.map cannot be read" in done.stderr


CASES: dict[str, Callable[[Number, Number], Number]] = {
    "abs(x)": lambda x, y: abs(x),
    "max(x, y, -1)": lambda x, y: max(x, y, -1),
    "min(x*y, 1/2)": lambda x, y: min(x * y, Fraction(1, 2)),
    "max(-1, min(1, 2*x - y))": lambda x, y: max(-1, min(1, 2 * x - y)),
    "abs(x - abs(y)) - max(x, abs(y))/3": (
        lambda x, y: abs(x - abs(y)) - Fraction(max(x, abs(y))) / 3
    ),
    "0.1*x + .25": lambda x, y: Fraction(1, 10) * x + Fraction(1, 4),
}


@pytest.mark.parametrize("term", CASES)
@given(x=NUMBERS, y=NUMBERS)
def test_cases_of_abs_max_and_min_are_those_of_python_holds(
    term: str, x: Fraction, y: Fraction
) -> None:
    system = read_rows("cases", [("state", "x y"), ("piece", f"{term}, x")])
    point = {"x": x, "y": y}
    assert sum(bool(holds(guard, point)) for guard, _ in system.pieces) == 1
    _, after = system.exact_next(point)
    assert after == {"x": CASES[term](x, y), "y": x}
    first, second = system.next({name: np.array([float(v)]) for name, v in point.items()})
    assert np.isclose(first[0], float(after["x"])) and second[0] == float(x)


@given(x=NUMBERS, y=NUMBERS)
def test_cases_within_a_guard_are_those_of_python_holds(x: Fraction, y: Fraction) -> None:
    rows = [("piece", "abs(x) <= max(y, 1) -> 1, 0"), ("piece", "abs(x) > max(y, 1) -> 2, 0")]
    system = read_rows("guards", [("state", "x y"), *rows])
    _, after = system.exact_next({"x": x, "y": y})
    assert after["x"] == (1 if abs(x) <= max(y, 1) else 2)
