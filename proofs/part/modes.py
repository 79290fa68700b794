"""The five modes of a corner's impact: each impulse is that of a walk by Coulomb's and Poisson's
laws, and what it guarantees.

A walk through impulse space grows the impulse from 0.  While the corner slides, friction is mu
times the normal impulse and opposes the sliding; where it has stopped, friction holds it if it can.
Compression is greatest where C = 0; the impact ends at 1 + e times the normal impulse of that
moment.  Velocities are linear on each piece of a walk, so what holds at the ends of a piece holds
all along it.
"""

from __future__ import annotations

from collections.abc import Sequence

from certificates.statements import Statement
from certificates.terms import Formula, conjunction, equal, real, reals
from proofs.claims import claim
from proofs.forms import always
from proofs.part.products import told
from proofs.part.setting import (
    APPROACH,
    B1,
    B2,
    B3,
    BACK,
    BODY,
    DEFINITE,
    DIRECTION,
    FRICTION,
    NO_JAM,
    PAST_COMPRESSION,
    REVERSES,
    S0,
    SLIDES,
    STOPPING,
    C,
    Impulse,
    P_x,
    P_y,
    S,
    conditions_of,
    e,
    mu,
    of,
    sigma,
    velocity_after,
    words,
)
from symbolic import MODES

STOP, MOST, END = (
    Impulse(*reals("x_stop y_stop")),
    Impulse(*reals("x_most y_most")),
    Impulse(P_x, P_y),
)


WALKS: dict[str, tuple[Formula, ...]] = {  # what determines a walk, beside its laws
    "sliding": (NO_JAM,),
    "sticking-in-compression": (*BODY, DIRECTION, STOPPING > 0),
    "sticking-in-restitution": (B1 > 0, DIRECTION, NO_JAM, STOPPING > 0),
    "reversed-in-compression": (*BODY, DIRECTION, *REVERSES),
    "reversed-in-restitution": (DIRECTION, NO_JAM, STOPPING > 0),
}
IMPACTS: dict[
    str, tuple[Formula, ...]
] = {  # what its guarantees need of an impact, beside the conditions of the mode
    "sliding": (DIRECTION, NO_JAM, APPROACH, e >= 0),
    "sticking-in-compression": (*BODY, DIRECTION, SLIDES, APPROACH, e >= 0),
    "sticking-in-restitution": (B1 > 0, DIRECTION, NO_JAM, APPROACH, e >= 0),
    "reversed-in-compression": (*BODY, DIRECTION, SLIDES, e >= 0),
    "reversed-in-restitution": (DIRECTION, NO_JAM, APPROACH),
}
# What is gained backwards: the speed times what impulse is left, part by part.
BACKWARDS = told(
    [(BACK, -(1 + e) * PAST_COMPRESSION, 1), (BACK, e * sigma * S0 * (B2 - mu * sigma * B3), 1)]
)


def on_line(name: str, impulse: Impulse) -> Formula:
    """The impulse is on the line of sliding, of sticking, or of sliding back."""
    if name == "sliding":
        return equal(impulse.along, -sigma * mu * impulse.away)
    if name == "reversed":
        return equal(impulse.along - STOP.along, sigma * mu * (impulse.away - STOP.away))
    return equal(velocity_after(impulse).along, 0)


def laws(mode: str) -> list[Formula]:
    """What determines a walk: where the corner stops, if it does, where compression is greatest,
    and where the impact ends.
    """
    compression, end = MODES[mode]
    stops = (
        []
        if mode == "sliding"
        else [on_line("sliding", STOP), equal(velocity_after(STOP).along, 0)]
    )
    return [
        *stops,
        on_line(compression, MOST),
        equal(velocity_after(MOST).away, 0),
        on_line(end, END),
        equal(P_y, (1 + e) * MOST.away),
    ]


def order(mode: str) -> list[Formula]:
    """The moments of a walk come in their order, and friction does on each piece what it should."""
    compression, end = MODES[mode]
    if mode == "sliding":
        return [0 <= MOST.away, MOST.away <= P_y, sigma * S >= 0]
    first, second = (MOST, STOP) if compression == "sliding" else (STOP, MOST)
    in_order = [0 <= first.away, first.away <= second.away, second.away <= P_y]
    along, away = P_x - STOP.along, P_y - STOP.away
    return in_order + (
        [along <= mu * away, -along <= mu * away] if end == "sticking" else [sigma * S <= 0]
    )


def impact(mode: str) -> list[Statement]:
    """All that is claimed of a mode: the walk, that there is no other, and what is guaranteed."""
    given = [*IMPACTS[mode], *conditions_of(mode)]
    points = {"P_x": of("contact_impulse", mode).along, "P_y": of("contact_impulse", mode).away}
    points |= dict(zip(("x_most", "y_most"), of("compressing_impulse", mode)))
    points |= dict(zip(("x_stop", "y_stop"), of("stopping_impulse"))) if mode != "sliding" else {}
    walk = {name: point for name, point in points.items() if not name.startswith("P")}

    def so(show: Formula, label: str, needs: Sequence[Formula]) -> Statement:
        return always(show, given=needs, label=label, vocabulary=words(mode, **walk))

    no_other = conjunction(equal(real(name), point) for name, point in points.items())
    return [
        so(conjunction(laws(mode)), "walk", WALKS[mode]),
        always(no_other, given=[*WALKS[mode], *laws(mode)], label="no-other", vocabulary=words()),
        so(
            conjunction(order(mode)),
            "order",
            [*given, STOPPING > 0] if mode.startswith("sticking") else given,
        ),
        so(P_y >= 0, "pushes", given),
        so(
            (P_x <= mu * P_y) & (-P_x <= mu * P_y),
            "cone",
            given if mode == "sticking-in-compression" else [*given, FRICTION],
        ),
        so(C >= 0, "parts", [*given, DEFINITE] if mode.endswith("in-restitution") else given),
    ]


@claim("part-sliding", "part", "sliding", parameters=())
def a_corner_that_slides_all_along_ends_its_approach() -> list[Statement]:
    """A corner that slides all along has this impulse; it pushes, is in the cone of friction, and
    ends the approach.
    """
    return impact("sliding")


@claim("part-sticking-in-compression", "part", "sticking in compression", parameters=())
def a_corner_that_sticks_in_compression_ends_its_approach() -> list[Statement]:
    """A corner that stops in compression and sticks has this impulse; it pushes, is in the cone of
    friction, and ends the approach.
    """
    return impact("sticking-in-compression")


@claim("part-sticking-in-restitution", "part", "sticking in restitution", parameters=())
def a_corner_that_sticks_in_restitution_ends_its_approach() -> list[Statement]:
    """A corner that stops in restitution and sticks has this impulse; it pushes, is in the cone of
    friction, and ends the approach.
    """
    return impact("sticking-in-restitution")


@claim(
    "part-reversed-in-compression",
    "part",
    "reversed in compression",
    parameters=(),
    hints=BACKWARDS,
)
def a_corner_that_slides_back_in_compression_ends_its_approach() -> list[Statement]:
    """A corner that stops in compression and slides back has this impulse; it pushes, is in the
    cone of friction, and ends the approach.
    """
    return impact("reversed-in-compression")


@claim("part-reversed-in-restitution", "part", "reversed in restitution", parameters=())
def a_corner_that_slides_back_in_restitution_ends_its_approach() -> list[Statement]:
    """A corner that stops in restitution and slides back has this impulse; it pushes, is in the
    cone of friction, and ends the approach.
    """
    return impact("reversed-in-restitution")
