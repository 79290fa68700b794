"""At alpha = 1/3 the orbits that do not tend to e_1: three states and no others.

(0, 3) and (1, 1) are the orbit of e_2, an impact and a flight by turns, and (0, -1) flies to it, in
units of r T and r.  No other state leads to them, and from every other state the proof for alpha <
1/3 goes through: the stage after an impact holds (1, 1) on its border only.
"""

from __future__ import annotations

from dataclasses import replace

from certificates.statements import AnyStatement, Statement
from certificates.terms import Formula, conjunction, equal, term
from proofs.claims import claim
from proofs.paper.vocabulary import alpha, always, at, equals, w, x
from proofs.reading.values import Vector
from proofs.theorem.definition import IN_THE_TRAP, OTHER, TO_THE_POINT
from proofs.theorem.roots import AT_IMPACTS, LEMMA, compared
from proofs.theorem.rules import NORMAL, attracts, contracts, descends, escapes, the_map

THIRD = equal(3 * alpha, 1) & (1 + alpha > 0)
EXCEPTIONS = (Vector((0, 3)), Vector((1, 1)), Vector((0, -1)))


def is_none_of(*states: Vector) -> Formula:
    """The state (x, w) is none of these: its distance to each is positive."""
    return conjunction(
        [
            (x - term(state.entries[0])) ** 2 + (w - term(state.entries[1])) ** 2 > 0
            for state in states
        ]
    )


def goes_to(start: Vector, end: Vector, label: str) -> Statement:
    """One period leads from the one state to the other."""
    there = {"x": start.entries[0], "w": start.entries[1]}
    steps = [(at(guard, there), equals(at(image, there), end)) for guard, image in NORMAL.pieces]
    return always(
        conjunction([~guard | arrives for guard, arrives in steps]), in_range=[THIRD], label=label
    )


OTHERS = replace(NORMAL, space=NORMAL.space & is_none_of(*EXCEPTIONS))


@claim(
    "theorem-one-third",
    "theorem",
    "alpha = 1/3",
    hints={"uses": (LEMMA,), "premises": {"falls-1": compared(AT_IMPACTS, NORMAL)}},
)
def three_states_do_not_tend_to_the_fixed_point() -> list[AnyStatement]:
    """At alpha = 1/3 every orbit tends to e_1 but those of (0, 3), (1, 1) and (0, -1), and e_1 is
    stable.
    """
    falling, period_two, rising = EXCEPTIONS
    return [
        the_map("map", NORMAL, THIRD),
        escapes("escapes", "theorem-one-third/map", NORMAL, THIRD),
        always(equals(OTHER, falling), in_range=[THIRD], label="e_2"),
        goes_to(falling, period_two, "impact"),
        goes_to(period_two, falling, "flight"),
        goes_to(rising, period_two, "flies-to-it"),
        the_map("map-of-others", OTHERS, THIRD),
        descends("descends", "theorem-one-third/map-of-others", OTHERS, THIRD, TO_THE_POINT),
        contracts("contracts", "theorem-one-third/map-of-others", OTHERS, THIRD, IN_THE_TRAP),
        attracts("attracts", "theorem-one-third/descends", "theorem-one-third/contracts"),
    ]
