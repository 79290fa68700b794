"""Bounded floats: the bound holds of every operation, chunks change nothing, and memory does not
grow with the steps.
"""

from __future__ import annotations

import operator
import tracemalloc
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import (
    arrays,
    boundary,
    grid,
    listed,
    orbit,
    physical_grid,
    point,
    random,
    scene,
)
from juggleproof.scenes.juggler import bounded as engine
from juggleproof.scenes.juggler.bounded import Bounded, powers
from juggleproof.scenes.juggler.compiled_map import N, nearest
from juggleproof.scenes.juggler.starts import goal
from juggleproof.scenes.juggler.tables import as_arrays
from tests.rows import each_row

FULL = st.floats(allow_nan=False, allow_infinity=False)
SIZES = st.floats(0, 1e300) | st.sampled_from([0.0, 5e-324, 1e-310])
Operation = Callable[[N, N], N]
OPERATIONS = (operator.add, operator.sub, operator.mul, operator.truediv)


def contains(found: Bounded, exact: Fraction) -> bool:
    value, bound = float(found.v), float(found.e)
    return (
        bound != bound or bound == float("inf") or abs(Fraction(value) - exact) <= Fraction(bound)
    )


@settings(max_examples=400, deadline=None)
@given(
    x=FULL,
    y=FULL,
    a=SIZES,
    b=SIZES,
    ends=st.tuples(st.sampled_from([-1, 0, 1]), st.sampled_from([-1, 0, 1])),
    which=st.sampled_from(OPERATIONS),
)
@example(
    x=1.0, y=1.0, a=1.0, b=1.0, ends=(1, 1), which=operator.mul
)  # the product of both errors counts
@example(x=1.0, y=1.0, a=0.5, b=0.5, ends=(1, -1), which=operator.truediv)
def test_bound_of_an_operation_holds(
    x: float, y: float, a: float, b: float, ends: tuple[int, int], which: Operation[N]
) -> None:
    with np.errstate(all="ignore"):
        found = which(Bounded(np.array(x), np.array(a)), Bounded(np.array(y), np.array(b)))
    true_x, true_y = Fraction(x) + ends[0] * Fraction(a), Fraction(y) + ends[1] * Fraction(b)
    if which is operator.truediv and true_y == 0:
        assert not (found.e < np.inf)
        return
    assert contains(found, which(true_x, true_y))


def test_bound_fails_without_the_rounding_term() -> None:
    tenth = Bounded.of(Fraction(1, 10))
    total = tenth + tenth + tenth
    off = abs(Fraction(float(total.v)) - Fraction(3, 10))
    assert 3 * Fraction(float(tenth.e)) < off <= Fraction(float(total.e))


@given(
    alpha=st.fractions(Fraction(1, 99), Fraction(98, 99), max_denominator=99),
    exponents=st.lists(st.integers(0, 400), min_size=1, max_size=4),
)
def test_bound_of_powers_holds(alpha: Fraction, exponents: list[int]) -> None:
    found = powers(-Bounded.of(alpha), np.array(exponents))
    for place, exponent in enumerate(exponents):
        assert contains(found.at(place), (-alpha) ** exponent)


def test_conversion_counts_what_it_misses_holds() -> None:
    for value in (
        Fraction(1, 3),
        Fraction(10) ** 400,
        Fraction(1, 10**400),
        Fraction(-7, 10**310),
        Fraction(2**53 + 1),
    ):
        found, missed = nearest(value)
        assert missed == float("inf") or abs(value - Fraction(found)) <= Fraction(missed)


@settings(max_examples=25, deadline=None)
@given(
    alpha=st.fractions(Fraction(1, 20), Fraction(19, 20), max_denominator=20),
    seed=st.integers(0, 999),
    steps=st.integers(0, 60),
    until=st.booleans(),
    keep=st.booleans(),
)
def test_chunks_change_nothing_holds(
    alpha: Fraction, seed: int, steps: int, until: bool, keep: bool
) -> None:
    setting, aim = scene(alpha, random(11, seed)), goal(steps, until_trap=until)
    found = []
    for chunk in (1, 4, 11, 1000):
        ensemble = engine.Ensemble.empty(11, aim, keep)
        engine.follow_fast(setting, aim, ensemble, chunk=chunk)
        assert ensemble.done == 11
        found.append(ensemble)
    for other in found[1:]:
        for name in ("x", "w", "error_x", "error_w", "periods", "impacts", "end"):
            assert np.array_equal(
                getattr(found[0], name), getattr(other, name), equal_nan=name in ("x", "w")
            ), name
        if keep:
            assert np.array_equal(found[0].history, other.history, equal_nan=True)


@pytest.mark.exhaust
def test_memory_depends_on_states_only_holds() -> None:
    assert engine.bytes_needed(10**6, 1) == engine.bytes_needed(10**6, 10**18) < 60 * 10**6
    used = []
    for steps in (5, 150):
        setting = scene("7/10", random(20000, 3))
        orbit(setting, "fast", 1)  # what is loaded once
        tracemalloc.start()
        orbit(setting, "fast", steps)
        used.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert max(used) <= engine.bytes_needed(20000, 150), used
    assert used[1] < 1.5 * used[0]


MILLION = {
    "grid of heights": lambda: grid((0, 10, 10**6), (-5, 5, 1)),
    "grid of speeds": lambda: grid((0, 10, 1), (-5, 5, 10**6)),
    "boundary": lambda: boundary("3/10", 10**6),
    "physical grid": lambda: physical_grid((0, 10, 1), (-5, 5, 10**6), 2, 3),
}


@each_row("name", MILLION)
def test_a_million_starts_are_not_made_before_they_are_asked_for_holds(name: str) -> None:
    MILLION[name]().block(0, 1)  # what is loaded once
    tracemalloc.start()
    starts = MILLION[name]()
    x, w, error_x, error_w = starts.block(10**6 - 5, 10**6)
    used = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert starts.count == 10**6 and used < 10**6, used
    for place in range(5):
        exact = starts.exact(10**6 - 5 + place)
        assert abs(Fraction(float(x[place])) - exact[0]) <= Fraction(float(error_x[place]))
        assert abs(Fraction(float(w[place])) - exact[1]) <= Fraction(float(error_w[place]))


def test_results_of_many_states_take_little_beside_them_holds() -> None:
    count = 300000
    found = orbit(
        scene("3/10", random(count, 1, (0, 0), (0, 0)), r=2, g=3), "fast", 3
    )  # all on x = w
    used = {}
    for name, use in (
        ("undecided", lambda: next(found.each_undecided())),
        ("arrays", lambda: as_arrays(found, "physical")["v"][-1]),
    ):
        tracemalloc.start()
        assert use() == {"undecided": (0, 0), "arrays": 2}[name]
        used[name] = tracemalloc.get_traced_memory()[1] / count
        tracemalloc.stop()
    assert found.counts() == {"undecided": count}
    assert used["undecided"] < 12 and used["arrays"] < 50, used  # bytes a state


def test_undecided_states_are_counted_and_listed_holds() -> None:
    found = orbit(scene("1/3", listed([(0, 3), (1, 2), (1, 1), ("1/7", 2)])), "fast", 40)
    assert found.undecided == [(0, 1), (2, 0)] and found.counts() == {"reached": 2, "undecided": 2}
    assert found.row(0).end == "undecided" and (found.row(0).periods, found.row(0).impacts) == (
        1,
        1,
    )


def test_overflow_is_undecided_holds() -> None:
    found = orbit(
        scene("1/3", arrays(np.array([1e308, 0.0, 1e308]), np.array([-1e308, 1e308, 1.0]))),
        "fast",
        10**4,
        impacts=True,
    )
    assert all(row.end == "undecided" for row in map(found.row, range(3)))


def test_a_million_periods_of_one_state_end_in_no_time_holds() -> None:
    row = orbit(scene("3/10", point(1000, -41)), "fast", 10**6).row(0)
    exact = orbit(scene("3/10", point(1000, -41)), "exact", 10**6).row(0)
    assert row.error is not None and abs(Fraction(row.x) - exact.x) <= Fraction(
        row.error[0]
    ) < Fraction(1, 10**12)


def test_rejects_a_history_that_does_not_fit() -> None:
    with pytest.raises(SceneError, match="1024 MB"):
        orbit(scene("3/10", random(10**6, 1)), "fast", 1000, keep=True)
