"""Minima of the literature, enclosed and checked: CPU seconds, boxes, bytes.

    OPENBLAS_NUM_THREADS=1 python -m juggleproof.benchmarks.bounds [--width 1e-9]

Caprasse, Lotka-Volterra, Butcher, magnetism, heart dipole, Schwefel: Munoz and Narkawicz,
Formalization of Bernstein polynomials and applications to global optimization, J. Automated
Reasoning 51 (2013), after Verschelde's list of polynomial systems; Rosenbrock, Powell, Colville
(Wood): More, Garbow and Hillstrom, Testing unconstrained optimization software, ACM TOMS 7 (1981).
Each problem is a polynomial, a box, and the published value of its minimum; the run fails where
that is not the one that is certified.
"""

from __future__ import annotations

import argparse
import statistics
import sys
from collections.abc import Sequence
from fractions import Fraction

from rich.console import Console
from rich.table import Table

from juggleproof.benchmarks.commands import measure
from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.certificates import checker
from juggleproof.command.bound import box, number
from juggleproof.judging.bounds import Enclosure, enclose_minimum

HEART = (
    (
        "-x1*x6^3 + 3*x1*x6*x7^2 - x3*x7^3 + 3*x3*x7*x6^2 - x2*x5^3 + 3*x2*x5*x8^2 - x4*x8^3 +"
        " 3*x4*x8*x5^2 - 0.9563453"
    ),
    (
        "x1=-0.1..0.4,x2=0.4..1,x3=-0.7..-0.4,x4=-0.7..0.4,x5=0.1..0.2,x6=-0.1..0.2,x7=-0.3..1.1,"
        "x8=-1.1..-0.3"
    ),
)


def sides(count: int, low: str, high: str) -> str:
    """The same side for each of x1, x2, .."""
    return ",".join(f"x{k}={low}..{high}" for k in range(1, count + 1))


def rosenbrock(count: int) -> str:
    """The extended valley of Rosenbrock."""
    return " + ".join(f"100*(x{k + 1} - x{k}^2)^2 + (1 - x{k})^2" for k in range(1, count))


PROBLEMS: dict[str, tuple[str, str, str]] = {
    "Caprasse": (
        (
            "-x1*x3^3 + 4*x2*x3^2*x4 + 4*x1*x3*x4^2 + 2*x2*x4^3 + 4*x1*x3 + 4*x3^2 - 10*x2*x4 -"
            " 10*x4^2 + 2"
        ),
        sides(4, "-0.5", "0.5"),
        "-3.18009",
    ),
    "Lotka-Volterra": ("x1*(x2^2 + x3^2 + x4^2 - 1.1) + 1", sides(4, "-2", "2"), "-20.8"),
    "Butcher": (
        "x6*x2^2 + x5*x3^2 - x1*x4^2 + x4^3 + x4^2 - 1/3*x1 + 4/3*x4",
        "x1=-1..0,x2=-0.1..0.9,x3=-0.1..0.5,x4=-1..-0.1,x5=-0.1..-0.05,x6=-0.1..-0.03",
        "-1.4393",
    ),
    "magnetism": (
        "x1^2 + 2*x2^2 + 2*x3^2 + 2*x4^2 + 2*x5^2 + 2*x6^2 + 2*x7^2 - x1",
        sides(7, "-1", "1"),
        "-0.25",
    ),
    "heart dipole": (*HEART, "-1.7434"),
    "heart dipole, greatest": (f"-({HEART[0]})", HEART[1], "-1.3677"),
    "Schwefel": (
        "(x1 - x2^2)^2 + (x2 - 1)^2 + (x1 - x3^2)^2 + (x3 - 1)^2",
        sides(3, "-10", "10"),
        "0",
    ),
    "Rosenbrock, 2 variables": (rosenbrock(2), sides(2, "-2", "2"), "0"),
    "Rosenbrock, 4 variables": (rosenbrock(4), sides(4, "-2", "2"), "0"),
    "Rosenbrock, 5 variables": (rosenbrock(5), sides(5, "-2", "2"), "0"),
    "Rosenbrock, 6 variables": (rosenbrock(6), sides(6, "-2", "2"), "0"),
    "Rosenbrock + x1*x4/10": (rosenbrock(4) + " + x1*x4/10", sides(4, "-2", "2"), ""),
    "Powell": (
        "(x1 + 10*x2)^2 + 5*(x3 - x4)^2 + (x2 - 2*x3)^4 + 10*(x1 - x4)^4",
        sides(4, "-4", "5"),
        "0",
    ),
    "Colville": (
        (
            "100*(x1^2 - x2)^2 + (x1 - 1)^2 + (x3 - 1)^2 + 90*(x3^2 - x4)^2 + 10.1*((x2 - 1)^2 +"
            " (x4 - 1)^2) + 19.8*(x2 - 1)*(x4 - 1)"
        ),
        sides(4, "-10", "10"),
        "0",
    ),
}


def seconds_of_checking(enclosure: Enclosure) -> float:
    """CPU seconds of both checks, with the reading of the statements; raises ArithmeticError if the
    checker does not certify both.
    """
    statements = checker.read_statements(enclosure.statements)
    began = cpu_seconds()
    outcomes = [
        checker.check_one(statements[name], certificate, {}, {})
        for name, certificate in enclosure.certificates.items()
    ]
    if any(outcome != "certified" for outcome, _ in outcomes):
        raise ArithmeticError(f"not certified: {outcomes}")
    return cpu_seconds() - began


def cold(polynomial: str, side: str, width: str) -> float:
    """CPU seconds of the whole command in a process of its own."""
    command = ("bound", polynomial, "--box", side, "--width", width)
    return measure([sys.executable, "-m", "juggleproof.command.main", *command])[0]


def row(name: str, width: str, runs: int) -> Sequence[str]:
    """The row of one problem, with medians of some runs.  Raises ArithmeticError if the published
    minimum is not within 10^-4 of the enclosure.
    """
    polynomial, side, published = PROBLEMS[name]
    warm = []
    for _ in range(runs + 1):
        began = cpu_seconds()
        enclosure = enclose_minimum(polynomial, box(side), number(width, "--width"))
        warm.append(cpu_seconds() - began)
    whole = statistics.median(cold(polynomial, side, width) for _ in range(runs))
    checking = statistics.median(seconds_of_checking(enclosure) for _ in range(runs))
    if published and not enclosure.low - Fraction(1, 10**4) <= Fraction(
        published
    ) <= enclosure.high + Fraction(1, 10**4):
        raise ArithmeticError(
            f"{name}: {published} is published, [{enclosure.low}, {enclosure.high}] is certified"
        )
    reached = f"{float(enclosure.width):.1e}" if enclosure.width else "0"
    return (
        name,
        published,
        f"{float(enclosure.low):.10g}",
        reached,
        f"{whole:.2f}",
        f"{statistics.median(warm[1:]):.3f}",
        str(enclosure.boxes),
        str(enclosure.certificate_bytes),
        f"{checking * 1000:.1f}",
    )


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--width", default="1e-9")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", action="append", choices=list(PROBLEMS))
    options = parser.parse_args()
    table = Table(title=f"minima on boxes, width {options.width}, {options.runs} runs")
    for heading in (
        "problem",
        "published",
        "low",
        "width",
        "cold s",
        "warm s",
        "boxes",
        "bytes",
        "check ms",
    ):
        table.add_column(heading, justify="left" if heading == "problem" else "right")
    for name in options.only or PROBLEMS:
        table.add_row(*row(name, options.width, options.runs))
    Console(width=None if sys.stdout.isatty() else 130).print(table)


if __name__ == "__main__":
    main()
