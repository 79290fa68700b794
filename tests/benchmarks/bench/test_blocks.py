"""Blocks that fall on the table, as a question of the benchmark: their ends, and the error."""

from __future__ import annotations

from fractions import Fraction

import pytest

pytest.importorskip("numba")

from juggleproof.benchmarks.bench import blocks
from juggleproof.benchmarks.bench.answers import Drops
from tests.scenes.part import reference


def test_error_of_the_benchmark_falls_with_the_tolerance_holds() -> None:
    coarse, fine = (blocks.followed(Drops(1), Fraction(1, 10**k)) for k in (6, 12))
    assert fine.distance < 1e-12 and 1e-10 < coarse.distance < 1e-6
    assert fine.note == coarse.note and int(fine.note.split()[0]) > 50


def test_the_ends_of_the_benchmark_are_those_of_the_reference_holds() -> None:
    block = reference.setting(
        0.01, 0.02, e=0.7, mu=0.08, g=9.81, A_x=1e-3, f_x=30.0, A_y=2e-4, f_y=60.0
    )
    for Y, theta, omega, *end in blocks.KNOWN:
        dropped = reference.dropped(block, theta, 0.001, omega=omega)
        start = reference.State(*map(float, dropped))
        assert start == (0, 0, Y, theta, 0, 0, omega)
        last = reference.reference_orbit(block, start, blocks.UNTIL, 35)[-1].after
        after = blocks.UNTIL - last.t
        assert [float(last.X + last.VX * after), float(last.theta + last.omega * after)] == end
