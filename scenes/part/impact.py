"""The impact of one corner: Wang and Mason's five contact modes with Poisson's restitution, as
`symbolic.contact_modes` derives them.

The formulas stand here once more so that they can be compiled; a test compares them, exactly, with
the derived ones in every mode.
"""

from __future__ import annotations

from scenes.part.compiling import compiled

(
    SLIDING,
    STICKING_IN_COMPRESSION,
    STICKING_IN_RESTITUTION,
    REVERSED_IN_COMPRESSION,
    REVERSED_IN_RESTITUTION,
) = range(5)
JAMMING = -1


@compiled
def mode_of(
    S0: float, C0: float, B1: float, B2: float, B3: float, e: float, mu: float, sigma: int
) -> int:
    """The mode of an impact in which the corner slides in the direction sigma at first; C0 < 0.

    P_d and P_q are the closing rate times sigma S0, and the stopping rate times -C0.
    """
    closing, stopping = B2 + sigma * mu * B3, mu * B1 + sigma * B3
    if closing <= 0:
        return JAMMING
    P_d, P_q = closing * (sigma * S0), stopping * -C0
    if P_d >= (1 + e) * P_q:
        return SLIDING
    holds = mu * B1 >= abs(B3)
    if P_d <= P_q:
        return STICKING_IN_COMPRESSION if holds else REVERSED_IN_COMPRESSION
    return STICKING_IN_RESTITUTION if holds else REVERSED_IN_RESTITUTION


@compiled
def first_slide(S0: float, B1: float, B3: float, mu: float) -> int:
    """The direction in which the corner slides at first, 1 or -1; where S0 = 0, the one in which
    friction fails to hold it.
    """
    if S0 > 0 or S0 == 0 and B3 < 0:
        return 1
    return -1


@compiled
def impulse(
    mode: int,
    S0: float,
    C0: float,
    B1: float,
    B2: float,
    B3: float,
    e: float,
    mu: float,
    sigma: int,
) -> tuple[float, float]:
    """The impulse (P_x, P_y) at the corner, per unit of mass."""
    if mode == STICKING_IN_COMPRESSION:
        P_y = (1 + e) * -(B1 * C0 + B3 * S0) / (B1 * B2 - B3 * B3)
    elif mode == REVERSED_IN_COMPRESSION:
        P_y = (
            (1 + e)
            * -(C0 + 2 * sigma * mu * B3 * S0 / (B3 + sigma * mu * B1))
            / (B2 - sigma * mu * B3)
        )
    else:
        P_y = (1 + e) * -C0 / (B2 + sigma * mu * B3)
    if mode == SLIDING:
        return -sigma * mu * P_y, P_y
    if mode == STICKING_IN_COMPRESSION or mode == STICKING_IN_RESTITUTION:
        return (B3 * P_y - S0) / B1, P_y
    return sigma * mu * (P_y - 2 * S0 / (B3 + sigma * mu * B1)), P_y
