"""Maps are read as they are written, exactly, or refused in one line that names file and mend."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from juggleproof.map_stability.maps import Map, read_file, read_rows
from tests.command import running
from tests.map_stability.maps import exact_next
from tests.statements.drawn import fractions

Number = Fraction | int
NUMBERS = fractions(-3, 3, 4)  # ties are frequent

LINES = "write over, domain, state, space, piece, point"
SIGNS = "write names, 3/10 or 0.3, + - * / ^, abs max min, < <= = != >= >, and or not"
NAMES = "write letters a to z, digits and _, spaces between"
COMPARE = "write comparisons, with and, or, not"
REJECTED = {
    "": "{file}: a line `state ..` is missing",
    "state x": "{file}: a line `piece ..` is missing",
    "state x\npiece x/2\nover a": f"{{file}}:3: over comes too late; {LINES}",
    "# a map\n\nspace x > 0\nstate x\npiece x/2": f"{{file}}:4: state comes too late; {LINES}",
    "state x\nmap x/2": f"{{file}}:2: map is no line of a map; {LINES}",
    "State x\npiece x/2": f"{{file}}:1: State is no line of a map; {LINES}",
    "state x\nx' = x/2": f"{{file}}:2: x' is no line of a map; {LINES}",
    "state x\nstate y\npiece x": "{file}:2: state stands twice; write one such line",
    "state x\nspace 0 <= x <\npiece x/2": f"{{file}}:2: unreadable: 0 <= x <; {SIGNS}",
    "state x\npiece": f"{{file}}:2: unreadable: no text; {SIGNS}",
    "state x\npiece 1.2.3*x": f"{{file}}:2: unreadable: 1.2.3*x; {SIGNS}",
    "state x\npiece 1e-3*x": f"{{file}}:2: unreadable: 1e-3*x; {SIGNS}",
    "state x\npiece x**3": f"{{file}}:2: unreadable: x**3; {SIGNS}",
    "state x\npiece 1/2 x": f"{{file}}:2: unreadable: 1/2 x; {SIGNS}",
    "state x\npiece x == 0 -> 0": f"{{file}}:2: unreadable: x == 0; {SIGNS}",
    "state x\npiece x/" + "9" * 5000: f"{{file}}:2: unreadable: x/{'9' * 56}..; {SIGNS}",
    "state x\nspace x ≤ 1\npiece x/2": f"{{file}}:2: ≤ in a formula; {SIGNS}",
    "state x\npiece x > 0 → x/2": f"{{file}}:2: → in a formula; {SIGNS}",
    "state x\npiece x/2, x": (
        "{file}:2: 2 terms for 1 state variables; write a term for each of x"
    ),
    "state x\npiece x > 0 -> x/2 -> x": (
        "{file}:2: too many arrows; write one, in a piece with a guard"
    ),
    "state x\npiece x -> x/2": f"{{file}}:2: x is no formula; {COMPARE}",
    "over a\ndomain 0 < a, a < 1\nstate x\npiece x": (
        f"{{file}}:2: (0 < a, a < 1) is no formula; {COMPARE}"
    ),
    "state x\npiece x > 0": ("{file}:2: x > 0 is no term; write a piece as GUARD -> TERM, .."),
    "state x\npiece x/2 if x > 0 else x": (
        "{file}:2: x / 2 if x > 0 else x is no term; write a piece as GUARD -> TERM, .."
    ),
    "state x\npiece a*x": (
        "{file}:2: a is neither parameter nor state variable; name it in `over` or `state`"
    ),
    "state x\npiece y > 0 -> x": (
        "{file}:2: y is neither parameter nor state variable; name it in `over` or `state`"
    ),
    "over a\ndomain a > b\nstate x\npiece a*x": ("{file}:2: b is no parameter; name it in `over`"),
    "state x\npiece x/2\npoint x": "{file}:3: x is no parameter; name it in `over`",
    "state x\npiece sin(x)": "{file}:2: sin(..) is no function here; write abs, max or min",
    "state x\nspace implies(x > 0)\npiece x": (
        "{file}:2: implies(..) is no function here; write abs, max or min"
    ),
    "state x\npiece max(*x)": (
        f"{{file}}:2: unreadable: max(*x); write shorter formulas of {SIGNS.removeprefix('write ')}"
    ),
    "state x\npiece " + " + ".join(["x"] * 999): (
        "{file}:2: unreadable: "
        + "x + " * 14
        + f"x ..; write shorter formulas of {SIGNS.removeprefix('write ')}"
    ),
    "state x\npiece max(x > 0, 1)": "{file}:2: max of a formula; it takes terms",
    "state x\nspace abs(x) <= 1\npiece x/2": (
        "{file}:2: abs stands outside of a piece; write comparisons without it"
    ),
    "state x\npiece abs(x, 1)": "{file}:2: abs(x, 1): abs takes one term, max and min more",
    "state x\npiece x/0": "{file}:2: x/0 divides by 0; mend the divisor",
    "state x\npiece x > 1/(2 - 2) -> x": "{file}:2: 1/(2 - 2) divides by 0; mend the divisor",
    "state x\npiece max(x/(1 - 1), 0)": "{file}:2: x/(1 - 1) divides by 0; mend the divisor",
    "state x\npiece x^0.5": "{file}:2: x^(1 / 2): no whole number in the exponent; write one",
    "state x\npiece x/10^1000000000": "{file}:2: a power above 100; write lower ones",
    "state x\npiece ((x^50)^50)^50": "{file}:2: a power above 100; write lower ones",
    "over x\nstate x\npiece x/2": (
        "{file}:2: x is named twice; write it once, in `over` or in `state`"
    ),
    "state\npiece 1": "{file}:1: no state variable; name one or more",
    "state 1x\npiece 2": f"{{file}}:1: 1x is no name; {NAMES}",
    "over a, b\nstate x\npiece a*x": f"{{file}}:1: a, is no name; {NAMES}",
    "over α\nstate x\npiece α*x": f"{{file}}:1: α is no name; {NAMES}",
    "state lambda\npiece lambda/2": ("{file}:1: lambda is a word of the language; choose another"),
    "state max\npiece max/2": "{file}:1: max is a word of the language; choose another",
    "state value\npiece value/2": "{file}:1: value is a name of the rules; choose another",
    "state x\npiece x/2\npoint 0, 0": (
        "{file}:3: 2 terms for 1 state variables; write a term for each of x"
    ),
    "state x\npiece " + " + ".join(f"abs(x - {k})" for k in range(7)): (
        "{file}:2: more than 64 cases of abs, max and min in one line"
    ),
}


@pytest.mark.parametrize("text", REJECTED)
def test_rejects_a_file_that_is_no_map_in_one_line(text: str, tmp_path: Path) -> None:
    file = tmp_path / "wrong.map"
    file.write_text(text + "\n", encoding="utf-8")
    done = running.run("stability", str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"juggleproof: {REJECTED[text].format(file=file)}\n"


def test_rejects_what_is_no_text_file(tmp_path: Path) -> None:
    (tmp_path / "latin.map").write_bytes("# Hénon\nstate x\npiece x/2\n".encode("latin-1"))
    for name, reason in (
        ("none.map", " cannot be read: No such file or directory; name a text file"),
        ("", ": is no plain file; name one that is"),
        ("latin.map", " cannot be read: not in UTF-8; save it so"),
    ):
        done = running.run("stability", str(tmp_path / name))
        line = f"juggleproof: {tmp_path / name}{reason}\n"
        assert (done.returncode, done.stdout, done.stderr) == (2, "", line)


SAME = {
    "bytes of Windows": b"\xef\xbb\xbfover a\r\ndomain 0 < a and a < 1\r\nstate x\r\npiece a*x\r\n",
    "tabs": b"over\ta\ndomain\t0 < a  and\ta < 1\n\tstate x\npiece \ta*x",
    "comments": b"over a # slope\ndomain 0 < a and a < 1#\nstate x\n# it falls\npiece a*x # so",
    "chains and brackets": b"over a\ndomain 0 < a < 1\nstate x\npiece ((a*x))",
}


@pytest.mark.parametrize("text", SAME)
def test_a_file_is_read_however_it_is_laid_out_holds(text: str, tmp_path: Path) -> None:
    path = tmp_path / "Hénon_1.map"
    path.write_bytes(SAME[text])
    wanted = Map("H-non-1", ("a",), "0 < a and a < 1", ("x",), "0 < 1", (("0 < 1", ("a*x",)),))
    assert read_file(path) == wanted


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


@cache
def system_of(*pieces: str) -> Map:
    """The map of these pieces, read once for all examples."""
    return read_rows("cases", [("state", "x y"), *(("piece", piece) for piece in pieces)])


@pytest.mark.parametrize("term", CASES)
@given(x=NUMBERS, y=NUMBERS)
def test_cases_of_abs_max_and_min_are_those_of_python_holds(
    term: str, x: Fraction, y: Fraction
) -> None:
    system = system_of(f"{term}, x")
    point = {"x": x, "y": y}
    after = exact_next(system, point)
    assert after == {"x": CASES[term](x, y), "y": x}
    first, second = system.next({name: np.array([float(v)]) for name, v in point.items()})
    assert np.isclose(first[0], float(after["x"])) and second[0] == float(x)


@given(x=NUMBERS, y=NUMBERS)
def test_cases_within_a_guard_are_those_of_python_holds(x: Fraction, y: Fraction) -> None:
    system = system_of("abs(x) <= max(y, 1) -> 1, 0", "abs(x) > max(y, 1) -> 2, 0")
    after = exact_next(system, {"x": x, "y": y})
    assert after["x"] == (1 if abs(x) <= max(y, 1) else 2)
