"""The bands around e_1 of section 4.3.2: which are narrow, and which f1 keeps."""

from __future__ import annotations

from fractions import Fraction

from juggleproof.judging.evaluating import is_true_at
from juggleproof.judging.register import load_register
from juggleproof.proofs.paper.names import B1, B2, R, band, derived_vector, eps, f1, is_narrow
from juggleproof.reading.values import Vector
from juggleproof.statements.language import Formula, term
from tests.rows import each_row

REGISTER = load_register()
UNIT = {"r": Fraction(1), "g": Fraction(1)}
P_ENTERS_R = (
    "0 < alpha < c1; c1 = 0.342087213408..., a root of"
    " alpha^4 + 2*alpha^3 - 8*alpha^2 - 18*alpha + 7"
)


def holds(formula: Formula, **values: Fraction) -> bool:
    known = is_true_at(str(formula), {**UNIT, **values})
    assert known is not None
    return known


@each_row(
    "claim, reading",
    [
        ("region-near", ""),
        ("region-K", ""),
        ("s4.3.2-p-not-R", ""),
        ("s4.3.2-f1-boundary", "near-e_1: "),
        ("s4.3.2-K-invariant", "conclusion: "),
    ],
)
def test_narrow_bands_are_kept_just_where_there_are_some_holds(claim: str, reading: str) -> None:
    assert REGISTER[claim]["sharp"].endswith(reading + P_ENTERS_R)


@each_row("alpha, in_r", [(Fraction(1, 3), False), (Fraction(2, 5), True)])
def test_p_lies_in_b2_and_from_some_alpha_on_in_r_holds(alpha: Fraction, in_r: bool) -> None:
    p = derived_vector("point_p")
    assert holds(B2(p), alpha=alpha) and holds(R(p), alpha=alpha) == in_r


def test_rejects_a_narrow_band_on_the_other_side_of_e_1() -> None:
    """At alpha = 2/5 the line leaves R below e_1, whose velocity is -3/7: no band is narrow."""
    alpha, below = Fraction(2, 5), Fraction(-4, 5)
    assert not holds(is_narrow(eps)[1], alpha=alpha, c=below, eps=Fraction(1, 1000))
    assert holds(is_narrow(eps)[1], alpha=alpha, c=Fraction(1, 2), eps=Fraction(1, 1000))


@each_row("half_width, kept", [(Fraction(14, 14), True), (Fraction(15, 14), False)])
def test_the_size_of_the_bands_that_are_kept_is_exact_holds(
    half_width: Fraction, kept: bool
) -> None:
    """At alpha = 2/5, where (1 - alpha)/(alpha (1 + alpha)) = 15/14, on the ground."""
    values = {"alpha": Fraction(2, 5), "eps": half_width**2 / 2}
    edge = Vector((term(0), term(Fraction(-3, 7) - half_width)))
    assert holds(band(eps)(edge), **values)
    assert holds(B1(f1(edge)), **values) == kept == holds(band(eps)(f1(edge)), **values)


def test_what_is_kept_up_to_one_third_is_found_holds() -> None:
    assert REGISTER["region-Emax-B1"] == {"sharp": "0 < alpha < 1/3", "verdict": "holds"}
    assert REGISTER["region-K-size"] == {"sharp": "0 < alpha < 1", "verdict": "holds"}
