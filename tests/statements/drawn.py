"""Fractions for properties."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st


def fractions(low: int, high: int, most: int) -> st.SearchStrategy[Fraction]:
    """Those between two integers with a denominator of at most `most`, from a list: Hypothesis's
    own takes many times as long.
    """
    every = {Fraction(n, d) for d in range(1, most + 1) for n in range(low * d, high * d + 1)}
    return st.sampled_from(sorted(every, key=lambda one: (one.denominator, abs(one), one)))
