"""`juggleproof bound`: what it prints is certified and exact; whatever is wrong with a question is
told in one line.
"""

from __future__ import annotations

import re
import shlex
from fractions import Fraction
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.command.bound import decimals
from juggleproof.command.main import run
from juggleproof.judging.bounds import ATTAINED, LOWER, enclose_minimum
from juggleproof.statements.language import ClaimError, reals
from tests.rows import each_row

UNIT = {"x": (0, 1)}
PAGE = Path(__file__).resolve().parents[2] / "docs/your-own.md"
CAPRASSE = "-x*z^3 + 4*y*z^2*u + 4*x*z*u^2 + 2*y*u^3 + 4*x*z + 4*z^2 - 10*y*u - 10*u^2 + 2"


def bound(*arguments: str) -> int:
    return run(["bound", *arguments])


def test_the_minimum_at_a_corner_is_exact(capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        bound(
            "x1*(x2^2 + x3^2 + x4^2 - 1.1) + 1",
            "--box",
            "x1=-2..2,x2=-2..2,x3=-2..2,x4=-2..2",
            "--width",
            "1e-9",
        )
        == 0
    )
    printed = capsys.readouterr().out
    assert "low     -104/5  (-20.8, rounded down)" in printed
    assert "high    -104/5  (-20.8, rounded up)" in printed
    assert "checked" in printed


def test_the_problems_that_the_page_shows_have_their_published_minima_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = (
        PAGE.read_text(encoding="utf-8")
        .split("whose published minima are ")[1]
        .split("Valleys")[0]
        .replace("\\\n", "")
    )
    published = [Fraction(number) for number in re.findall(r"(-\d+\.\d+)\s\(", text)]
    commands = [line.strip() for line in text.splitlines() if "juggleproof bound" in line]
    assert len(commands) == len(published) == 2
    for command, minimum in zip(commands, published):
        assert bound(*shlex.split(command)[2:]) == 0
        low, high = (Fraction(line.split()[1]) for line in capsys.readouterr().out.splitlines()[:2])
        assert low <= high <= low + Fraction(1, 10**9) and abs(high - minimum) < Fraction(1, 10**5)


def test_an_irrational_minimum_is_enclosed_as_narrowly_as_asked() -> None:
    for exponent in (1, 9, 30):
        found = enclose_minimum("x^3 - 2*x", {"x": (0, 2)}, Fraction(1, 10**exponent))
        assert found.reached and 0 < found.width <= Fraction(1, 10**exponent)
        assert (
            found.high < 0 and 27 * found.high**2 <= 32 <= 27 * found.low**2
        )  # the minimum is -sqrt(32/27)


def test_four_variables_are_enclosed() -> None:
    found = enclose_minimum(
        CAPRASSE, dict.fromkeys("xyzu", (Fraction(-1, 2), Fraction(1, 2))), Fraction(1, 10**9)
    )
    assert found.reached
    assert found.low <= Fraction(-31800966258, 10**10) <= found.high + Fraction(1, 10**9)


def test_width_zero_is_not_reached_where_the_minimum_is_irrational(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert bound("x^3 - 2*x", "--box", "x=0..2", "--width", "0", "--budget", "50") == 1
    printed = capsys.readouterr().out
    assert "width 0 is not reached" in printed and "checked" in printed


def test_what_a_small_budget_comes_to_is_certified() -> None:
    found = enclose_minimum(
        CAPRASSE,
        dict.fromkeys("xyzu", (Fraction(-1, 2), Fraction(1, 2))),
        Fraction(1, 10**9),
        budget=5,
    )
    assert not found.reached and found.width > Fraction(1, 10**9)
    statements = checker.read_statements(found.statements)
    assert {
        checker.check_one(statements[name], entry, {}, {})[0]
        for name, entry in found.certificates.items()
    } == {"certified"}


def test_a_larger_budget_comes_at_least_as_far() -> None:
    box = dict.fromkeys("xyzu", (Fraction(-1, 2), Fraction(1, 2)))
    widths = [
        enclose_minimum(CAPRASSE, box, Fraction(1, 10**9), budget=boxes).width
        for boxes in (1, 10, 40, 400)
    ]
    assert widths == sorted(widths, reverse=True) and widths[-1] <= Fraction(1, 10**9)


# a polynomial whose least value is met on a curve or at several points, an end of its box, and that
# value
VALLEYS = {
    "a square": ("(x^2 + y^2 - 1/2)^2", 1, Fraction(0)),
    "two squares": ("(x^2 + y - 11)^2 + (x + y^2 - 7)^2", 5, Fraction(0)),
    "a square times a side": ("(x^2 + y^2 - 1/2)^2*(x + 3) - 1/3", 1, Fraction(-1, 3)),
    "Motzkin's polynomial": ("x^4*y^2 + x^2*y^4 - 3*x^2*y^2 + 1", 2, Fraction(0)),
}


@each_row("kind", VALLEYS)
def test_what_a_wider_or_a_narrower_width_reaches_is_not_missed_holds(kind: str) -> None:
    text, end, least = VALLEYS[kind]
    box = dict.fromkeys("xy", (-end, end))
    widths = [Fraction(1, 10**k) for k in (1, 9)]
    found = [enclose_minimum(text, box, width, 2000) for width in (*widths, 0)]
    for width, enclosure in zip(widths, found):
        assert enclosure.reached and enclosure.low <= least <= enclosure.high
        assert enclosure.width <= width
    assert found[-1].low == least and found[-1].width < widths[-1]


def test_what_is_asked_in_vain_comes_as_close_as_other_widths_do_holds() -> None:
    text, box = "x^4 - 2*x^2*y + y^3 + x", {"x": (-1, 2), "y": (-1, 2)}
    enclosure = enclose_minimum(text, box, 0)
    other = enclose_minimum(text, box, Fraction(1, 10**9))
    assert not enclosure.reached and other.reached and enclosure.width <= other.width


def test_a_changed_bound_is_rejected() -> None:
    found = enclose_minimum("x^2 - x", UNIT, 0)
    assert found.low == found.high == Fraction(-1, 4)
    changes = [
        (LOWER, ">= -1/4", "> -1/4"),
        (LOWER, ">= -1/4", ">= -6/25"),
        (ATTAINED, "<= -1/4", "< -1/4"),
        (ATTAINED, "<= -1/4", "<= -1/3"),
    ]
    for name, old, new in changes:
        statement = checker.read_statements(found.statements.replace(old, new))[name]
        assert checker.check_one(statement, found.certificates[name], {}, {})[0] == "rejected"


def test_files_are_read_by_check(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        bound(
            "x^2 - x*y", "--box", "x=0..1,y=-1/2..3", "--width", "0", "-o", str(tmp_path / "there")
        )
        == 0
    )
    assert run(["check", str(tmp_path / "there")]) == 0
    assert "2 certified" in capsys.readouterr().out
    assert bound("x^2", "--box", "x=0..1", "--width", "0", "-o", str(tmp_path / "there")) == 0
    assert run(["check", str(tmp_path / "there")]) == 0


def test_files_of_others_are_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "certificates.jsonl").write_text("", encoding="utf-8")
    assert bound("x", "--box", "x=0..1", "--width", "0", "-o", str(tmp_path)) == 2
    assert "holds certificates.jsonl" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["certificates.jsonl"]


def test_numbers_are_exact(capsys: pytest.CaptureFixture[str]) -> None:
    assert bound("0.1*x", "--box", "x=0.1..1/2", "--width", "0.0") == 0
    assert "low     1/100  (0.01, rounded down)" in capsys.readouterr().out


def test_a_polynomial_may_begin_with_a_minus(capsys: pytest.CaptureFixture[str]) -> None:
    assert bound("-x", "--box", "x=0..3", "--width", "0") == 0
    assert "low     -3 " in capsys.readouterr().out


def test_terms_are_taken_as_text_is() -> None:
    x, y = reals("x y")
    box = {"x": (0, 1), "y": (-1, 1)}
    assert enclose_minimum(x * y + x**2, box, 0) == enclose_minimum("x*y + x^2", box, 0)


def test_constants_and_points_hold() -> None:
    assert enclose_minimum("3/2", UNIT, 0).low == Fraction(3, 2)
    assert enclose_minimum("x - x", UNIT, 0).high == 0
    assert enclose_minimum("x^2*y", {"x": (2, 2), "y": (3, 3)}, 0).low == 12
    assert enclose_minimum("x", {"x": (2, 3), "unused": (0, 1)}, 0).point == {"x": 2, "unused": 0}


def test_decimals_are_rounded_outward() -> None:
    for value in (Fraction(1, 3), Fraction(-1, 3), Fraction(7, 8), Fraction(-(10**20) - 1, 3)):
        assert Fraction(decimals(value, 2, False)) <= value <= Fraction(decimals(value, 2, True))


MANY = [f"a{k}" for k in range(20)]
BAD = {
    "a width below 0": (("x", "--box", "x=0..1", "--width", "-1"), "width -1 is below 0"),
    "nan": (("x", "--box", "x=0..1", "--width", "nan"), "'nan' is no rational number"),
    "inf": (("x", "--box", "x=0..inf", "--width", "1"), "'inf' is no rational number"),
    "an empty box": (("x", "--box", "x=1..0", "--width", "1"), "the box is empty: x from 1 to 0"),
    "an unknown variable": (("x + z", "--box", "x=0..1", "--width", "1"), "an undeclared name: z"),
    "a division by a variable": (
        ("1/x", "--box", "x=1..2", "--width", "1"),
        "division by what may vanish",
    ),
    "a relation": (("x < 1", "--box", "x=0..1", "--width", "1"), "not a polynomial in x"),
    "half a polynomial": (("x +", "--box", "x=0..1", "--width", "1"), "unreadable text: x +"),
    "a product without a sign": (
        ("2x", "--box", "x=0..1", "--width", "1"),
        "write it as x^2 - 3/2*x*y",
    ),
    "no polynomial": (("", "--box", "x=0..1", "--width", "1"), "unreadable text"),
    "a call": (("sin(x)", "--box", "x=0..1", "--width", "1"), "not a term: sin(x)"),
    "a high degree": (("x^61", "--box", "x=0..1", "--width", "1"), "at most 60 can be searched"),
    "an exponent beyond all": (
        ("x^99999", "--box", "x=0..1", "--width", "1"),
        "an exponent is too large",
    ),
    "a large expansion": (
        ("(x + y + z)^300", "--box", "x=0..1,y=0..1,z=0..1", "--width", "1"),
        "too",
    ),
    "many variables": (
        ("*".join(MANY), "--box", "=0..1,".join(MANY) + "=0..1", "--width", "1"),
        "product times sum may be at most 1000000",
    ),
    "huge values": (("x^60", "--box", "x=0..1000", "--width", "1"), "exceeds 10^100 on the box"),
    "a name that is none": (("x", "--box", "and=0..1", "--width", "1"), "'and' is not a name"),
    "a digit of another script": (
        ("x", "--box", "x=0..\u0663", "--width", "1"),
        "is no rational number",
    ),
    "three dots": (("x", "--box", "x=0...5", "--width", "1"), "is no side of a box"),
    "a side without an end": (("x", "--box", "x=0", "--width", "1"), "is no side of a box"),
    "a side twice": (("x", "--box", "x=0..1,x=0..2", "--width", "1"), "x stands twice"),
    "an end divided by 0": (("x", "--box", "x=0..1/0", "--width", "1"), "divides by 0"),
    "no box": (("x", "--box", "", "--width", "1"), "is no side of a box"),
}


@pytest.mark.parametrize("kind", BAD)
def test_rejects_a_bad_question_in_one_line(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    arguments, expected = BAD[kind]
    assert bound(*arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("juggleproof: ") and printed.err.count("\n") == 1
    assert expected in printed.err


def test_rejects_a_float_and_an_empty_budget() -> None:
    with pytest.raises(ClaimError, match=r"width = 0\.1 is not exact"):
        enclose_minimum("x", UNIT, 0.1)  # type: ignore[arg-type]
    with pytest.raises(ClaimError, match=r"x = 0\.5 is not exact"):
        enclose_minimum("x", {"x": (0, 0.5)}, 1)
    with pytest.raises(ClaimError, match="budget 0 is below 1"):
        enclose_minimum("x", UNIT, 1, budget=0)


def test_rejects_a_long_text_in_a_short_line() -> None:
    with pytest.raises(ClaimError, match="not a polynomial in x") as caught:
        enclose_minimum("(" * 5000 + "x" + ")" * 5000, UNIT, 0)
    assert len(str(caught.value)) < 300
