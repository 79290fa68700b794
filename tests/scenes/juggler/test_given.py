"""What the scene takes from the derivations and the theorem: the map, and the trap."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from sympy import Symbol, sympify

from juggleproof.command.main import run
from juggleproof.proofs.theorem.definition import FIXED, PIECES, TRAP, holds_at, value_of
from juggleproof.proofs.theorem.orbits import SHEARED, from_the_fixed_point
from juggleproof.scenes.juggler.compiled_map import formulas, region
from juggleproof.scenes.juggler.exact import flight, flight_length, impact, impact_power, strikes
from juggleproof.statements.language import term
from juggleproof.symbolic import (
    lowest_terms,
    normal_e_1,
    normal_energy,
    normal_f1,
    normal_flight_power,
    normal_margin,
    region_energy,
    scaling,
    unscaling,
)
from juggleproof.symbolic.algebra import r

# -------------------------------------------------------------------------------------------------
# The scene iterates the very map that the proofs are about: its compiled text is the derived
# expression, and the checker's pieces say the same.

alphas = st.fractions(Fraction(1, 100), Fraction(99, 100), max_denominator=100)
heights = st.fractions(0, 30, max_denominator=60)
speeds = st.fractions(-9, 9, max_denominator=60)


def test_compiled_text_is_the_derived_expression_holds() -> None:
    f = formulas()
    pairs = [
        (f.impact, normal_f1()),
        (f.flight, normal_flight_power()),
        (f.margin, [normal_margin()]),
        (f.fixed, normal_e_1()),
        (f.energy, [normal_energy()]),
        (f.scaled, scaling()),
        (f.unscaled, unscaling()),
        (region(), [region_energy() / r**2]),
    ]
    for compiled, derived in pairs:
        names, _, body = str(compiled.__doc__).removeprefix("lambda ").partition(": ")
        text = sympify(body, locals={name: Symbol(name) for name in names.split(", ")})
        entries = list(text) if isinstance(text, tuple) or hasattr(text, "__iter__") else [text]
        assert len(entries) == len(list(derived))
        for one, other in zip(entries, derived):
            assert lowest_terms(one - other) == 0, compiled.__doc__


@given(alpha=alphas, x=heights, w=speeds)
def test_one_period_is_the_map_of_the_statements_holds(
    alpha: Fraction, x: Fraction, w: Fraction
) -> None:
    point = {"alpha": alpha, "x": x, "w": w}
    guard, image = next(piece for piece in PIECES if holds_at(piece[0], point))
    assert strikes(x, w) == (guard == PIECES[0][0])
    there = impact(alpha, x, w) if strikes(x, w) else flight(x, w, 1)
    assert there == tuple(value_of(term(entry), point) for entry in image.entries)


@given(alpha=alphas, x=heights, w=speeds)
def test_scene_trap_is_the_trap_of_the_theorem_up_to_one_half_holds(
    alpha: Fraction, x: Fraction, w: Fraction
) -> None:
    caught = strikes(x, w) and all(part > 0 for part in formulas().trap_margins(alpha, w))
    of_theorem = holds_at(TRAP, {"alpha": alpha, "x": x, "w": w})
    assert caught == of_theorem if 2 * alpha <= 1 else caught <= of_theorem


@given(
    alpha=alphas, share=st.fractions(0, 1, max_denominator=50), w=speeds, periods=st.integers(0, 12)
)
def test_trap_is_invariant_and_its_closed_form_is_the_iteration_holds(
    alpha: Fraction, share: Fraction, w: Fraction, periods: int
) -> None:
    w = abs(w) / 9 / alpha
    x = share * w
    if not (strikes(x, w) and all(part > 0 for part in formulas().trap_margins(alpha, w))):
        return
    place = (x, w)
    for _ in range(periods):
        place = impact(alpha, *place)
        assert (
            strikes(*place)
            and place[0] >= 0
            and all(part > 0 for part in formulas().trap_margins(alpha, place[1]))
        )
    assert impact_power(alpha, x, w, periods) == place
    fixed = [value_of(term(entry), {"alpha": alpha}) for entry in FIXED.entries]
    offset = [
        value_of(part, {"p": x - fixed[0], "q": w - fixed[1], "n": Fraction(periods)})
        for part in SHEARED
    ]
    claimed = from_the_fixed_point(term((-alpha) ** periods), (term(offset[0]), term(offset[1])))
    assert tuple(value_of(term(entry), {"alpha": alpha}) for entry in claimed.entries) == place


def test_trap_of_the_theorem_is_not_invariant_above_one_half_holds() -> None:
    alpha = Fraction(9, 10)
    place = (Fraction(0), Fraction(1, 10))
    assert holds_at(TRAP, {"alpha": alpha, "x": place[0], "w": place[1]})
    assert not strikes(*impact(alpha, *impact(alpha, *place)))
    assert not all(part > 0 for part in formulas().trap_margins(alpha, place[1]))


@given(x=heights, w=speeds, more=st.integers(0, 10**40))
def test_whole_flight_is_the_single_periods_holds(x: Fraction, w: Fraction, more: int) -> None:
    length, place = flight_length(x, w), (x, w)
    for _ in range(length):
        assert not strikes(*place)
        place = flight(*place, 1)
    assert strikes(*place) and place == flight(x, w, length)
    high = flight_length(x + more, w)
    assert strikes(*flight(x + more, w, high)) and (
        high == 0 or not strikes(*flight(x + more, w, high - 1))
    )


# -------------------------------------------------------------------------------------------------
# The trap of the scene, which holds for every alpha, is certified by the checker: it is mapped into
# itself and every state of it strikes.

CLAIM = '''from juggleproof import always, claim, reals

a, x, w = reals("a x w")


@claim("trap")
def the_trap_is_invariant():
    """The image of the trap under f1 lies in the trap."""
    above, after = a * (w - x), 2 - a * w
    trap = [a > 0, a < 1, x >= 0, x < w, a * w < 1, {third}]
    kept = (a * after < 1) & (a * (2 - a * after) < 1)
    return always((above >= 0) & (above < after) & kept, given=trap)
'''


def certified(third: str, folder: Path) -> int:
    path = folder / "trap.py"
    path.write_text(CLAIM.format(third=third), encoding="utf-8")
    return run(["certify", str(path), "--routes", "exact", "--jobs", "1"])


def test_trap_is_invariant_holds(tmp_path: Path) -> None:
    assert certified("a * (2 - a * w) < 1", tmp_path) == 0


def test_trap_is_invariant_fails_without_its_third_condition(tmp_path: Path) -> None:
    assert certified("w > 0", tmp_path) == 1
