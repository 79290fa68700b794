"""Tables as plain columns or on a terminal, and exact numbers as users write and read them."""

from __future__ import annotations

import argparse
import re
import sys
import textwrap
from collections.abc import Sequence
from fractions import Fraction
from shutil import get_terminal_size
from typing import TYPE_CHECKING

from juggleproof.statements.language import ClaimError

if TYPE_CHECKING:
    from rich.console import Console

# -------------------------------------------------------------------------------------------------
# A table as plain columns, one row a line, or drawn on a terminal.


def plain(rows: Sequence[Sequence[str]]) -> str:
    """The rows in columns two blanks apart; the first row has the heads.

    >>> print(plain([("n", "x"), ("10", "1/3")]))
    n   x
    10  1/3
    """
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows
    )


def line_width(most: int) -> int:
    """The width of the terminal that is written to, at most `most`; `most` where there is none."""
    return min(most, get_terminal_size().columns) if sys.stdout.isatty() else most


def folded(text: str, width: int) -> str:
    """The text with lines of at most this width; no word is broken, and a line goes on below the
    second of its columns, or below its beginning.

    >>> print(folded("printed     an equation of the paper", 26))
    printed     an equation of
                the paper
    """
    return "\n".join(_folded(line, width) for line in text.split("\n"))


def _folded(line: str, width: int) -> str:
    columns = re.match(r" *(?:\S+ {2,})?", line)
    hanging = columns.end() if columns and columns.end() < width // 2 else 0
    return textwrap.fill(
        line,
        width,
        subsequent_indent=" " * hanging,
        break_long_words=False,
        break_on_hyphens=False,
        drop_whitespace=len(line) > width,
    )


def draw(heads: Sequence[str], rows: Sequence[Sequence[str]], console: Console) -> None:
    """Draws the table on a terminal; prints plain columns elsewhere."""
    if not console.is_terminal:
        print(plain([heads, *rows]))
        return
    from rich.table import Column, Table

    table = Table(Column(heads[0], no_wrap=True), *heads[1:], header_style="bold")
    for row in rows:
        table.add_row(*(cell.replace("[", r"\[") for cell in row))
    console.print(table)


# -------------------------------------------------------------------------------------------------
# Exact numbers as users write them, and rounded numbers for users to read.

DIGITS = 12  # digits of a rounded number
MAX_BITS = 12000  # bits of a number that is read
_WHOLE = r"(\d{1,1000})(?:\^(\d{1,5}))?"
_EXACT = re.compile(rf"(-?){_WHOLE}(?:/{_WHOLE})?", re.ASCII)
_DECIMAL = re.compile(
    r"-?(\d{1,30}\.?\d{0,30}|\.\d{1,30})(e[+-]?\d{1,3})?", re.ASCII | re.IGNORECASE
)


def exact(text: str, name: str) -> Fraction:
    """The number that is written as p, p/q, p^k or a decimal, such as -41, 3/10, 10^300 or 9.81
    (exactly 981/100).

    >>> exact("-3/10", "x"), exact("2^5", "x"), exact("9.81", "g")
    (Fraction(-3, 10), Fraction(32, 1), Fraction(981, 100))

    Raises ClaimError, one line that names the form, for anything else.
    """
    text = text.strip()
    if _DECIMAL.fullmatch(text):
        return Fraction(text)
    match = _EXACT.fullmatch(text)
    if not match:
        raise ClaimError(f"{name} = {text[:40]!r} is no number; write it as 3/10, 0.3 or 10^300")
    sign, top, top_power, bottom, bottom_power = match.groups()
    return (-1 if sign else 1) * Fraction(
        _power(top, top_power, name), _power(bottom or "1", bottom_power, name, zero=False)
    )


def whole(text: str) -> int:
    """The whole number of an option of the command line; raises ArgumentTypeError for any other
    text.
    """
    if not (text.isascii() and text.removeprefix("-").isdecimal()):
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is not a whole number")
    if len(text) > 4000:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is too long a number")
    return int(text)


def components(
    text: str, names: Sequence[str], form: str = "x=..,w=.. or beta=..,v=.."
) -> dict[str, Fraction]:
    """The numbers of a text such as x=1000,w=-41, in which each of these names occurs at most once;
    raises ClaimError, which shows the expected form, for another name, or one that occurs twice.

    >>> components("x=1/2,w=-3", ("x", "w", "r"))
    {'x': Fraction(1, 2), 'w': Fraction(-3, 1)}
    """
    given: dict[str, Fraction] = {}
    for part in text.split(","):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or name not in names:
            units = ",r=..,g=.." if "r" in names else ""
            raise ClaimError(
                f"{part.strip()[:40]!r} is no component of a state; write {form}{units}"
            )
        if name in given:
            raise ClaimError(f"{name} is given twice; give each component of the state once")
        given[name] = exact(value, name)
    return given


def _power(base: str, exponent: str | None, name: str, zero: bool = True) -> int:
    whole, power = int(base), int(exponent or "1")
    if whole.bit_length() * power > MAX_BITS:
        raise ClaimError(f"{name} is longer than {MAX_BITS} bits; choose a shorter number")
    if whole == 0 and not zero:
        raise ClaimError(f"{name} divides by 0; write it exactly, as 3/10")
    return int(whole**power)


def shown(value: Fraction | int, digits: int = DIGITS) -> str:
    """The number with at most `digits` digits, rounded half to even.

    >>> shown(Fraction(1, 3)), shown(75), shown(-Fraction(81, 1000))
    ('0.333333333333', '75', '-0.081')
    >>> shown(Fraction(10**20 + 1)), shown(Fraction(2, 3 * 10**9), 3)
    ('1.00000000000e20', '6.67e-10')
    """
    value = Fraction(value)
    if value == 0:
        return "0"
    sign, value = "-" if value < 0 else "", abs(value)
    power = (value.numerator.bit_length() - value.denominator.bit_length()) * 3 // 10 - 1
    while value >= Fraction(10) ** (power + 1):
        power += 1
    while value < Fraction(10) ** power:
        power -= 1
    scaled = round(value / Fraction(10) ** (power - digits + 1))
    power, scaled = (power + 1, scaled // 10) if scaled == 10**digits else (power, scaled)
    text = str(scaled)
    if -5 <= power < digits:
        whole, part = (
            (text[: power + 1], text[power + 1 :])
            if power >= 0
            else ("0", "0" * (-power - 1) + text)
        )
        part = part if scaled * Fraction(10) ** (power - digits + 1) != value else part.rstrip("0")
        return sign + whole + ("." + part if part else "")
    return f"{sign}{text[0]}.{text[1:]}e{power}"
