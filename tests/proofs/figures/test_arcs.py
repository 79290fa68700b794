"""Figure 3 shows the exact images of the boundary of R: no point is off its orbit, and no piece
joins what f tears apart.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import Rational

from juggleproof import symbolic
from juggleproof.drawing.lines import Arc
from juggleproof.proofs.figures.arcs import cut_at_the_bounce, images, margin
from juggleproof.proofs.figures.paper import STEPS, boundary_image, torn_ends
from juggleproof.symbolic.algebra import alpha, beta, g, r, v
from tests.proofs.figures.drawn import points
from tests.rows import each_row

SETTING = {alpha: Rational(1, 4), r: 1, g: 1}
BRANCHES = [
    tuple(entry.subs(SETTING) for entry in branch()) for branch in (symbolic.f1, symbolic.f2)
]
MARGIN = symbolic.collision_margin().subs(SETTING)


def exact_orbit(height: Fraction, speed: Fraction, steps: int) -> tuple[Rational, Rational]:
    """f^steps by SymPy's rationals, from the derived branches and inequality (7) alone."""
    state = (
        Rational(height.numerator, height.denominator),
        Rational(speed.numerator, speed.denominator),
    )
    for _ in range(steps):
        at = {beta: state[0], v: state[1]}
        branch = BRANCHES[0] if MARGIN.subs(at) > 0 else BRANCHES[1]
        state = branch[0].subs(at), branch[1].subs(at)
    return state


def start_of(parameter: Fraction, arc_of_boundary: bool) -> tuple[Fraction, Fraction]:
    """The state of the boundary with this parameter: its velocity on the arc, and how far along the
    edge beta = 0 from its lowest point.
    """
    if arc_of_boundary:
        height = symbolic.region_margin().subs(
            {**SETTING, v: Rational(parameter.numerator, parameter.denominator), beta: 0}
        )
        return Fraction(int(height.p), int(height.q)), parameter
    low, high = (Fraction(boundary_image(0)[1].at(end)[1]) for end in (0.0, 1.0))
    return Fraction(0), low + parameter * (high - low)


def of_the_arc(piece: Arc) -> bool:
    """The edge's pieces are affine in their parameter, which lies between 0 and 1; those of the arc
    are quadratic.
    """
    return piece.across[2] != 0


@each_row("step", range(STEPS))
def test_images_are_the_exact_images_holds(step: int) -> None:
    seen = 0
    for piece in boundary_image(step):
        for part in (0.2, 0.5, 0.8):
            parameter = piece.start + part * (piece.stop - piece.start)
            exact = exact_orbit(*start_of(Fraction(parameter), of_the_arc(piece)), step)
            assert piece.at(parameter) == (
                pytest.approx(float(exact[0]), abs=1e-12),
                pytest.approx(float(exact[1]), abs=1e-12),
            )
            seen += 1
    assert seen >= 6


@each_row("step", range(STEPS))
def test_whole_boundary_is_mapped_holds(step: int) -> None:
    for whole in boundary_image(0):
        pieces = [one for one in boundary_image(step) if of_the_arc(one) == of_the_arc(whole)]
        covered = sorted(tuple(sorted((one.start, one.stop))) for one in pieces)
        assert all(first[1] == second[0] for first, second in zip(covered, covered[1:]))
        assert (covered[0][0], covered[-1][1]) == tuple(sorted((whole.start, whole.stop)))


@each_row("step", range(STEPS))
def test_what_is_drawn_is_the_image_holds(step: int) -> None:
    pieces = [part for arc in boundary_image(step) for part in cut_at_the_bounce(arc)]
    for strikes, name in ((True, f"image-{step}-in-B1"), (False, f"image-{step}-in-B2")):
        expected = [arc for arc, inside in pieces if inside is strikes]
        if not expected:
            continue
        drawn = points("fig-3", name, parts=2)
        middles = {(round(x * 2, 9), round(y, 9)) for x, y in drawn[1::3]}
        assert middles == {
            tuple(round(one, 9) for one in arc.at((arc.start + arc.stop) / 2)) for arc in expected
        }


def test_no_drawn_piece_crosses_the_line_where_f_jumps_holds() -> None:
    for step in range(STEPS):
        for arc in boundary_image(step):
            for part, strikes in cut_at_the_bounce(arc):
                inside = [
                    float(margin(*part.at(part.start + k / 10 * (part.stop - part.start))))
                    for k in range(1, 10)
                ]
                assert all(one > 0 for one in inside) if strikes else all(one < 0 for one in inside)


def test_f_tears_the_boundary_holds() -> None:
    whole = Arc((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), -2.0, 2.0)  # beta = 1, across the line at v = 1/2
    struck, flown = images([whole])
    assert struck.at(struck.stop) != pytest.approx(flown.at(flown.start))
    assert not torn_ends(0) and len(torn_ends(1)) == 2


def test_f_tears_nothing_at_the_corner_of_the_line_holds() -> None:
    """At beta = 0, v = r both branches give the same state."""
    struck, flown = images([Arc((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), -2.0, 2.0)])
    assert struck.at(struck.stop) == pytest.approx(flown.at(flown.start))


def test_image_by_one_branch_fails_without_the_cut() -> None:
    """The other side's branch gives other states, so that a piece that is not cut would be seen."""
    low = exact_orbit(Fraction(0), Fraction(3, 2), 1)
    at = {beta: 0, v: Rational(3, 2)}
    assert low != tuple(entry.subs(at) for entry in BRANCHES[0])
