"""Long exact numbers, which are not kept in lowest terms, are those of plain fractions; what does
not grow stays short.
"""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.scenes.juggler import orbit, point, scene
from juggleproof.scenes.juggler.exact import (
    FEW_BITS,
    Powers,
    Ratio,
    as_fraction,
    flight,
    flight_length,
    impact,
    lifted,
    lowest,
    shortened,
    strikes,
)
from tests.rows import each_row

numbers = st.fractions(-50, 50, max_denominator=600)


@given(
    q=st.integers(1, 60), one=numbers, two=numbers, whole=st.integers(-9, 9), k=st.integers(0, 4)
)
def test_sums_and_products_are_those_of_fractions_holds(
    q: int, one: Fraction, two: Fraction, whole: int, k: int
) -> None:
    powers = Powers(q)
    a, b = (Ratio.of(lifted(value), powers) for value in (one, two / q**k))
    two /= q**k
    found = [
        a + b,
        a - b,
        a * b,
        -a,
        whole + a,
        whole - a,
        a - whole,
        whole * a,
        a * fmpq(2, 3),
        fmpq(2, 3) - a,
        a + fmpq(2, 3),
    ]
    wanted = [
        one + two,
        one - two,
        one * two,
        -one,
        whole + one,
        whole - one,
        one - whole,
        whole * one,
        one * Fraction(2, 3),
        Fraction(2, 3) - one,
        one + Fraction(2, 3),
    ]
    assert [as_fraction(value) for value in found] == wanted
    assert [as_fraction(shortened(value)) for value in found[:8]] == wanted[:8]


@given(q=st.integers(2, 60), value=numbers, k=st.integers(0, 40))
def test_what_is_common_is_taken_out_holds(q: int, value: Fraction, k: int) -> None:
    powers = Powers(q)
    short = Ratio.of(lifted(value), powers)
    piled = Ratio(short.top * powers[k], short.rest, short.k + k, powers)
    assert shortened(piled).k <= short.k and lowest(piled) == lifted(value)
    assert short.rest.gcd(powers.q) == 1


@each_row(
    "alpha, x, w, periods",
    [
        ("9/10", "1", "-4", 6000),
        ("5/6", "22/9", "-7/4", 3000),
        ("7/8", "1/3", "-5/2", 3000),
        ("1/2", "100000", "7/10", 3000),
    ],
)
def test_long_orbits_are_those_of_fractions_holds(alpha: str, x: str, w: str, periods: int) -> None:
    here, left = (Fraction(x), Fraction(w)), periods
    while left:
        if strikes(*here):
            here, left = impact(Fraction(alpha), *here), left - 1
        else:
            length = min(flight_length(*here), left)
            here, left = flight(*here, length), left - length
    row = orbit(scene(alpha, point(x, w)), "exact", periods).row(0)
    assert (row.x, row.w) == here
    assert here[0].denominator.bit_length() > FEW_BITS


@each_row("most_bits", [None, 2500])
def test_what_is_told_is_in_lowest_terms_holds(most_bits: int | None) -> None:
    found = orbit(scene("9/10", point(1, -4)), "exact", 9000, keep=True, most_bits=most_bits)
    track = found.tracks[0]
    assert track.end == ("too long" if most_bits else "reached")
    assert all(
        isinstance(part, fmpq)
        for sample in (track.here, *(track.samples or []))
        for part in sample[2:]
    )


@each_row("alpha, x, w", [("1/3", "0", "3"), ("1/2", "4/9", "8/3"), ("9/10", "180/361", "20/19")])
def test_periodic_orbits_stay_short_holds(alpha: str, x: str, w: str) -> None:
    found = orbit(scene(alpha, point(x, w)), "exact", 5000, keep=True)
    assert max(row.x.denominator.bit_length() for row in found.history(0)) < 20
    assert all(isinstance(part, fmpq) for part in found.tracks[0].here[2:])
