"""`juggleproof bound` and `juggleproof bench`."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from fractions import Fraction
from math import ceil, floor
from pathlib import Path

from juggleproof.judging import limits
from juggleproof.judging.bounds import enclose_minimum, refuse_other_files
from juggleproof.statements.language import ClaimError


def command(parsed: argparse.Namespace) -> int:
    """Runs `bound` or `bench`; returns its exit code."""
    if parsed.command == "bench":
        return bench(parsed.question, parsed.widths, parsed.seconds, parsed.quick, parsed.output)
    return bound(parsed.polynomial, parsed.box, parsed.width, parsed.budget, parsed.output)


# -------------------------------------------------------------------------------------------------
# `juggleproof bench`: speed against error, in one table and plot a question; the engines are in
# `benchmarks`, which only a checkout has.

FOLDER = Path("juggleproof-bench")


def bench(
    asked: Sequence[str] | None,
    widths: str | None,
    seconds: str | None,
    quick: bool,
    output: Path | None,
) -> int:
    """Runs the benchmark; returns 1 where an enclosure does not contain the closed form, or nothing
    was measured.  Raises ClaimError, one line, for a question that cannot be measured.
    """
    from juggleproof.benchmarks.bench.run import BenchRun, wish

    wanted = wish(asked, widths, seconds, quick)
    folder = output or FOLDER
    fault = _fault(folder)
    if fault:
        raise ClaimError(f"-o {folder}: {fault}; name another folder")
    return BenchRun(wanted, folder, _show_progress).all()


def _fault(folder: Path) -> str:
    """The reason why files cannot be written in the folder; empty where they can."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".new").write_bytes(b"")
        (folder / ".new").unlink()
    except OSError as error:
        return f"cannot be written ({error.strerror})"
    return ""


def _show_progress(what: str) -> None:
    """Shows progress, on a terminal only."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{what}", end="", file=sys.stderr, flush=True)


# -------------------------------------------------------------------------------------------------
# `juggleproof bound`: a certified enclosure of the minimum of a polynomial over a box.

SHOWN = 12  # decimals of a printed bound; more where the width needs them
_NUMBER = re.compile(
    r"[+-]?(?:\d{1,400}(?:/\d{1,400})?|\d{0,400}\.\d{1,400}|\d{1,400}\.)(?:e[+-]?\d{1,3})?",
    re.ASCII | re.IGNORECASE,
)


def number(text: str, name: str) -> Fraction:
    """The number that is written as p, p/q, 0.1 (exactly 1/10) or 1e-9 (exactly 1/10^9).

    >>> number("-1/2", "x"), number("0.1", "x"), number("1e-9", "width")
    (Fraction(-1, 2), Fraction(1, 10), Fraction(1, 1000000000))

    Raises ClaimError, one line, for anything else.
    """
    match = _NUMBER.fullmatch(text.strip())
    try:
        if match and not ("/" in text and "e" in text.lower()):
            return Fraction(text.strip())
    except ZeroDivisionError:
        raise ClaimError(f"{name}: {text.strip()[:40]} divides by 0") from None
    raise ClaimError(
        f"{name}: {text.strip()[:40]!r} is no rational number; write it as 3/10, 0.3 or 1e-9"
    )


def box(text: str) -> dict[str, tuple[Fraction, Fraction]]:
    """The box that is written as x=0..1,y=-1/2..3.

    Raises ClaimError, one line, for any other form, and for a variable that occurs twice.
    """
    ends: dict[str, tuple[Fraction, Fraction]] = {}
    for part in text.split(","):
        name, equal, pair = part.strip().partition("=")
        bounds = pair.split("..")
        if not equal or len(bounds) != 2 or "..." in pair:
            raise ClaimError(
                f"--box: {part.strip()[:40]!r} is no side of a box; write x=0..1,y=-1/2..3"
            )
        name = name.strip()
        if name in ends:
            raise ClaimError(f"--box: {name} stands twice")
        ends[name] = (number(bounds[0], f"--box {name}"), number(bounds[1], f"--box {name}"))
    return ends


def decimals(value: Fraction, digits: int, up: bool) -> str:
    """The value with `digits` decimals, rounded up or down, without zeros at the end.

    >>> decimals(Fraction(1, 3), 3, True), decimals(Fraction(-1, 3), 3, True)
    ('0.334', '-0.333')
    >>> decimals(Fraction(1, 4), 5, False)
    '0.25'
    """
    scaled = (ceil if up else floor)(value * 10**digits)
    whole, part = divmod(abs(scaled), 10**digits)
    text = f"{whole}.{part:0{digits}d}".rstrip("0").rstrip(".")
    return ("-" if scaled < 0 else "") + text


def bound(polynomial: str, sides: str, width: str, budget: int, output: Path | None) -> int:
    """Prints the enclosure, which is certified before anything is printed; returns 0 where it has
    the width that was asked for, else 1.
    """
    ends, sought = box(sides), number(width, "--width")
    if output is not None:
        refuse_other_files(output)
    enclosed = enclose_minimum(polynomial, ends, sought, budget or limits.BOXES)
    digits = SHOWN
    while sought and digits < 400 and Fraction(1, 10**digits) * 100 > sought:
        digits += 1
    point = ", ".join(f"{name} = {value}" for name, value in enclosed.point.items())
    print(f"low     {enclosed.low}  ({decimals(enclosed.low, digits, False)}, rounded down)")
    print(f"high    {enclosed.high}  ({decimals(enclosed.high, digits, True)}, rounded up)")
    print(f"at      {point}")
    print(f"width   {enclosed.width}")
    print(f"boxes   {enclosed.boxes}")
    print(f"bytes   {enclosed.certificate_bytes} of certificates")
    where = ", ".join(f"{low} <= {name} <= {high}" for name, (low, high) in ends.items())
    print(f"checked: the polynomial is at least low where {where}, and at most high at the point")
    if output is not None:
        enclosed.write(output)
        print(f"written to {output}; `juggleproof check {output}` reads it again")
    if not enclosed.reached:
        print(
            f"the width {sought} is not reached within {enclosed.boxes} boxes; the enclosure above"
            " is certified all the same"
        )
    return 0 if enclosed.reached else 1
