"""No impact of a corner gains kinetic energy in the table's frame: in each mode what is gained is
minus a sum of products that are not negative.
"""

from __future__ import annotations

from collections.abc import Sequence

from certificates.statements import Statement
from certificates.terms import Formula
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
    C0,
    CLOSING,
    DIRECTION,
    FRICTION,
    NO_JAM,
    PAST_COMPRESSION,
    PAST_RESTITUTION,
    RESTITUTION,
    REVERSES,
    S0,
    SLIDES,
    STOPPING,
    Impulse,
    P_x,
    P_y,
    e,
    mu,
    sigma,
    words,
    work_of,
)

LOST = (1 - e) * (1 + e)
DETERMINANT = B1 * B2 - B3**2
CLOSING_BACK = B2 - mu * sigma * B3  # the closing rate of a corner that slides back
LEFT = (
    -(1 + e) * PAST_COMPRESSION + e * CLOSING_BACK * sigma * S0
)  # the normal impulse after the stop, without its denominators


def gains_nothing(mode: str, given: Sequence[Formula]) -> Statement:
    """The work of the mode's impulse is not positive."""
    return always(
        work_of(Impulse(P_x, P_y)) <= 0, given=given, label="gains-nothing", vocabulary=words(mode)
    )


@claim("part-sliding-energy", "part", "sliding", parameters=())
def sliding_gains_no_energy() -> Statement:
    """A corner that slides all along gains no energy."""
    return gains_nothing(
        "sliding",
        [DIRECTION, SLIDES, NO_JAM, APPROACH, FRICTION, PAST_RESTITUTION >= 0, *RESTITUTION],
    )


@claim("part-sticking-in-compression-energy", "part", "sticking in compression", parameters=())
def sticking_in_compression_gains_no_energy() -> Statement:
    """An impact by the law of sticking in compression gains no energy, wherever it is used."""
    return gains_nothing("sticking-in-compression", [*BODY, *RESTITUTION])


@claim(
    "part-sticking-in-restitution-energy",
    "part",
    "sticking in restitution",
    parameters=(),
    hints=told(
        [
            (1, 1, PAST_COMPRESSION),
            (1, 1, C0 * STOPPING),
            (LOST, DETERMINANT, C0),
            (-C0 * PAST_COMPRESSION, (1 - e) * mu * B1 - e * BACK, 1),
            (1, 1, S0 * CLOSING + (1 + e) * B3 * C0),
            (LOST, B1 * B2, C0),
            ((1 + e) * mu * B1, sigma * B3, C0),
        ]
    ),
)  # the first line for sigma B3 <= 0
def sticking_in_restitution_gains_no_energy() -> Statement:
    """A corner that stops in restitution and sticks gains no energy."""
    return gains_nothing(
        "sticking-in-restitution",
        [*BODY, DIRECTION, NO_JAM, APPROACH, FRICTION, PAST_COMPRESSION >= 0, *RESTITUTION],
    )


@claim(
    "part-reversed-in-compression-energy",
    "part",
    "reversed in compression",
    parameters=(),
    hints=told(
        [
            (mu, 2 * STOPPING + BACK, sigma * S0 * CLOSING_BACK),
            (mu, BACK, LEFT),
            (LOST, CLOSING_BACK, CLOSING_BACK * sigma * S0 - PAST_COMPRESSION),
        ]
    ),
)
def sliding_back_in_compression_gains_no_energy() -> Statement:
    """An impact by the law of sliding back in compression gains no energy where friction does not
    hold the corner.
    """
    return gains_nothing(
        "reversed-in-compression", [*BODY, DIRECTION, FRICTION, *REVERSES, *RESTITUTION]
    )


@claim(
    "part-reversed-in-restitution-energy",
    "part",
    "reversed in restitution",
    parameters=(),
    hints=told(
        [
            (LOST, CLOSING, C0 * STOPPING),
            (mu, STOPPING + 2 * BACK, PAST_RESTITUTION),
            (mu, STOPPING, S0 * CLOSING),
        ]
    ),
)
def sliding_back_in_restitution_gains_no_energy() -> Statement:
    """An impact by the law of sliding back in restitution gains no energy where friction does not
    hold the corner.
    """
    return gains_nothing(
        "reversed-in-restitution", [DIRECTION, NO_JAM, FRICTION, *REVERSES, *RESTITUTION]
    )
