"""The figures of the paper, drawn again from what is derived, and four that it lacks; in the
paper's order.

    arcs     derived expressions as numbers, and the arcs that they draw
    states   the plane of the sampled states
    paper    the figures of the paper
    ours     two that it lacks
    attractors  what orbits come to, for every restitution
    certified   the data of those that show what is certified
"""

from __future__ import annotations

from juggleproof.papers.figures import PaperFigure

SETTING = "Drawn for alpha = 1/4."  # below 1/3

TABLE = (
    PaperFigure(
        "3",
        "fig-3",
        "The boundary of R under f",
        "The boundary of R and its images under f, for n = 0 to 5. Solid: states whose next period"
        " brings an impact; dashed: states that fly on. f jumps at the thin line: the image is"
        " torn there, at the small circles, and nothing joins the pieces. The lower row shows the"
        f" dotted frame; the cross is the fixed point. {SETTING}",
        "Six panels show the plane of height and velocity. The boundary of R, a parabola closed by"
        " the velocity axis, is folded and torn by the map and shrinks: after two periods to two"
        " thin wedges, after five to a few specks at the fixed point e_1.",
        f"{__name__}.paper:boundary_under_f",
    ),
    PaperFigure(
        "5",
        "fig-5",
        "The states: the half plane H",
        "H, the states in which the ball is on or above the table when the table is lowest.",
        "In the plane of height across and velocity up, the half plane to the right of height zero"
        " is shaded and called H.",
        f"{__name__}.paper:half_plane",
    ),
    PaperFigure(
        "6",
        "fig-6",
        "The regions B1 and B2",
        "B1, where the table strikes the ball within the period, B2, where it does not, and the"
        " line between them, which belongs to B2.",
        "A straight line falls from velocity 1 at height 0 through velocity 0 at height 1. B1 is"
        " the part of the half plane below it, B2 the line and the part above.",
        f"{__name__}.paper:strikes_and_flights",
    ),
    PaperFigure(
        "7",
        "fig-7",
        "Levels of the energy",
        "Lines of equal energy. In free flight the state moves along them, downwards; the numbers"
        " are energies in units of the square of the launch speed.",
        "Six nested parabolas open to the left, for energies from 0.5 to 3, with arrows from upward"
        " to downward velocities.",
        f"{__name__}.paper:levels",
    ),
    PaperFigure(
        "8",
        "fig-8",
        "Lines of energy in B1",
        "B1^0, on which an impact keeps the energy; the level of E_max, the greatest energy that"
        " B1^0 reaches; and the boundary of R, which is the level above that by Delta E_max."
        f" {SETTING}",
        "The parabola B1^0 touches the dashed level E = E_max at height 0. The boundary of R is a"
        " like parabola further out, everywhere the same distance to the right. A dot at height 0"
        " marks where Delta E_max is gained, another where E_max is kept.",
        f"{__name__}.paper:important_lines",
    ),
    PaperFigure(
        "9",
        "fig-9",
        "Ball and table against time",
        "The coupled motion. The ball is sampled (dots) whenever the table is lowest; the dashed"
        " flight meets no table within its period, the solid ones are struck at the circles."
        f" {SETTING}",
        "The table's height is a row of equal parabolic arches. The ball falls onto them from"
        " above, flies through the first period without an impact, is struck once in each later"
        " one, and its bounces become alike.",
        f"{__name__}.paper:coupled_motion",
    ),
    PaperFigure(
        "10",
        "fig-10",
        "The table as a lossless oscillator",
        "The table's height against time, and its path in the plane of height and velocity; the"
        " bounce reverses the velocity.",
        "On the left three equal parabolic arches, one a period T. On the right one closed loop: a"
        " parabola from launch to landing, and a dashed line back up, the bounce.",
        f"{__name__}.paper:oscillator",
    ),
    PaperFigure(
        "11",
        "fig-11",
        "Impacts that gain, keep and lose energy",
        "The parts of B1: impacts gain energy in B1^+, keep it on B1^0 and lose it in B1^-."
        f" Flights in B2 keep it. {SETTING}",
        "The triangle B1 is parted by the parabola B1^0 into B1^+, a lens at small heights, and"
        " B1^-, all the rest.",
        f"{__name__}.paper:gains_and_losses",
    ),
    PaperFigure(
        "12",
        "fig-12",
        "The regions R, B1 and B2",
        f"R, the states with no more energy than E_max + Delta E_max, with B1 and B2. {SETTING}",
        "R is bounded by a parabola and by height zero. The line between B1 and B2 cuts it near its"
        " tip, so that most of R lies in B1.",
        f"{__name__}.paper:region",
    ),
    PaperFigure(
        "13",
        "fig-13",
        "The point p and the curves through it",
        "The point p, where the line between B1 and B2 has the velocity of e_1. Its level lies"
        f" outside the boundary of R. {SETTING}",
        "A horizontal dashed line at the velocity of e_1 passes through e_1, leaves R, and meets"
        " the line between B1 and B2 at p. The dotted level of energy through p surrounds the"
        " boundary of R.",
        f"{__name__}.paper:intersections",
    ),
    PaperFigure(
        "14",
        "fig-14",
        "The region K",
        "K, the states of R and B1 whose velocity differs from that of e_1 by the root of 2"
        f" epsilon at most; here that is 1/4 of the launch speed. {SETTING}",
        "A horizontal band of R about the velocity of e_1, below the line between B1 and B2, is"
        " shaded and called K.",
        f"{__name__}.paper:band",
    ),
    PaperFigure(
        "",
        "fig-trap",
        "The trap, the rank and orbits that fall into the trap",
        "In the normal form: levels of the rank, which falls by 1 at least in every period"
        " outside, four orbits, drawn from exact states, and the trap, in which only impacts"
        f" happen. Dashed sides do not belong to it. {SETTING}",
        "In the plane of x and w, nested parabolas are levels of the rank, from 1 to 12. The trap"
        " is a triangle with a side at x = 0. Arrows of four orbits cross the levels inwards,"
        " upwards while the ball flies and to the lower left at impacts, and end in the trap.",
        f"{__name__}.ours:trap_and_rank",
        f"{__name__}.certified:what_the_trap_shows",
    ),
    PaperFigure(
        "",
        "fig-ranges",
        "The restitutions for which the claims hold",
        "For each claim, or each reading of it, the alpha for which it holds. Full circles belong"
        " to the range, open ones do not. Where a range depends on a whole number K or n, it is"
        " drawn for 2 and 3.",
        "A table of bars over alpha from 0 to 1, with 1/3 marked. Most claims hold on the whole"
        " range; the theorem and what leads to it end at 1/3, others a little before or beyond it,"
        " and subharmonic orbits begin there.",
        f"{__name__}.ours:ranges",
        "juggleproof.reports.figures:what_ranges_show",
        of_verdicts=True,
    ),
    PaperFigure(
        "",
        "fig-argument",
        "How the claims rest on one another",
        "Every claim in a circle, section by section. A line leads from a claim to one that it"
        " rests on: one that it repeats, or whose certificate settles it. Bold: the theorem, with"
        " what it rests on and what rests on it.",
        "A circle of dots in the colours and shapes of their verdicts. Bold lines lead from the"
        " abstract and from section 4 to the theorem, others from appendix B to its sources.",
        "juggleproof.drawing.argument:map_of_argument",
        "juggleproof.reports.figures:what_claims_rest_on",
        of_verdicts=True,
    ),
    PaperFigure(
        "",
        "fig-attractors",
        "What orbits come to, for every restitution",
        "The closing speeds w at the impacts of orbits to which others tend. Shaded: it is"
        " certified that every orbit tends to that of some e_K, but for few states at the open"
        " circles. Solid: it is certified that all states of a box tend to it; the short"
        " lines are one orbit of 12 unequal flights. Dashed: orbits that simulations end in.",
        "Over alpha from 0 to 1 there are nine falling curves, e_1 to e_9; e_K begins at an open"
        " circle at alpha = (K - 1)/(K + 1), at closing speed K + 1. All is shaded up to 0.7286."
        " From there up to about 0.8 there are bundles of short lines between the curves.",
        f"{__name__}.attractors:attractors",
        f"{__name__}.certified:what_attracts",
        of_verdicts=True,
    ),
)


def entry(slug: str) -> PaperFigure:
    """The figure of this slug."""
    return next(one for one in TABLE if one.slug == slug)
