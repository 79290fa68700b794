"""The drives and amplitudes that docs/sine.md tells are those that are certified, and no fewer."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest

from juggleproof.benchmarks import feeder
from juggleproof.certificates.sine.checker import Rectangle, outcome
from juggleproof.command.sine import SineOptions, interval, rectangle_of
from juggleproof.sine.stored import boxes_in
from tests.rows import each_row

ROWS = [
    [":".join(re.findall(r"[\d.]+", cell)) for cell in line.strip("| ").split(" | ")]
    for line in feeder.TABLE.text().splitlines()[2:]
]
PROVED = boxes_in(feeder.WIDE)


def certified(rectangle: Rectangle) -> bool:
    return outcome(rectangle, PROVED)[0] == "certified"


def test_the_page_has_the_restitutions_of_the_generator_holds() -> None:
    assert [[Fraction(end) for end in row[0].split(":")] for row in ROWS] == [
        [Fraction(end) for end in alpha.split(":")] for alpha in feeder.ALPHAS
    ]


@pytest.mark.exhaust
@each_row(("alpha", "gamma", "slow", "fast"), ROWS)
def test_what_the_page_tells_is_certified_and_as_much_as_is_certified_holds(
    alpha: str, gamma: str, slow: str, fast: str
) -> None:
    for hertz, mm in zip(feeder.HERTZ, (slow, fast), strict=True):
        options = SineOptions(alpha=alpha, gamma=None, frequency=str(hertz), amplitude=mm)
        assert certified(rectangle_of(options))
        assert interval(mm, "mm") == feeder.amplitudes(interval(gamma, "Gamma"), hertz)
    a, (low, high) = interval(alpha, "alpha"), interval(gamma, "Gamma")
    assert certified(Rectangle("", a, "Gamma", (low, high)))
    assert not certified(Rectangle("", a, "Gamma", (low - feeder.STEP, low)))
    assert not certified(Rectangle("", a, "Gamma", (high, high + feeder.STEP)))


@pytest.mark.exhaust
def test_a_row_is_found_as_the_page_has_it_holds() -> None:
    alpha, gamma, _, _ = ROWS[-1]
    assert feeder.drives(interval(alpha, "alpha"), PROVED) == interval(gamma, "Gamma")


def test_no_drive_is_told_without_certificates_for_all_the_restitutions_holds() -> None:
    assert feeder.drives((Fraction(0), Fraction(1, 10)), PROVED[::30]) is None
