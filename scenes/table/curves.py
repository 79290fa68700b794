"""Curves in the plane of restitution and drive between which the bounce of one period may attract
every motion; in floats, to be drawn.

Units: time in periods of the table, heights in gravity times the square of a period; alpha is the
restitution, Gamma the peak acceleration of the table in units of gravity, and the phase is 0 at the
bounce.  With c = (1 - alpha)/(2 (1 + alpha)) and g^2 = (Gamma/(2 pi))^2 - c^2 the height of the
table is (c sin 2 pi x + g cos 2 pi x)/(2 pi).
"""

from __future__ import annotations

from math import atan, pi, sqrt

import numpy as np

STEPS = 4000  # times at which a flight is looked at
HALVINGS = 40


def birth(alpha: float) -> float:
    """The least Gamma with a bounce of one period: pi (1 - alpha)/(1 + alpha).

    >>> round(birth(0.05), 4)
    2.8424
    """
    return pi * (1 - alpha) / (1 + alpha)


def doubling(alpha: float) -> float:
    """The Gamma above which a multiplier of the bounce is below -1: 2 pi g there is
    2 (1 + alpha^2)/(1 + alpha)^2.

    >>> round(doubling(0.05), 4)
    3.3744
    """
    return sqrt(birth(alpha) ** 2 + (2 * (1 + alpha**2) / (1 + alpha) ** 2) ** 2)


def g_of(alpha: float, gamma: float) -> float:
    """g, where Gamma is not below the birth."""
    return sqrt(max(0.0, gamma**2 - birth(alpha) ** 2)) / (2 * pi)


def gamma_of(alpha: float, g: float) -> float:
    """Gamma for a value of g."""
    return sqrt(birth(alpha) ** 2 + (2 * pi * g) ** 2)


def second_orbit(alpha: float, gamma: float) -> float:
    """The phase, from that of the bounce on, of the second solution of the equations of a bounce of
    one period.
    """
    return 1 - atan(2 * pi * g_of(alpha, gamma) / birth(alpha)) / pi


def clearance(alpha: float, gamma: float) -> float:
    """The least height above the table of a ball in flight that starts as the second solution of
    the equations of a bounce of one period: below 0 where the table is in its way.
    """
    c, g = birth(alpha) / (2 * pi), g_of(alpha, gamma)
    start = second_orbit(alpha, gamma)
    time = np.arange(1, STEPS) / STEPS

    def height(x: np.ndarray) -> np.ndarray:
        return (c * np.sin(2 * pi * x) + g * np.cos(2 * pi * x)) / (2 * pi)

    ball = height(np.array(start)) + time / 2 - time**2 / 2
    return float(np.min(ball - height(start + time)))


def grazing(alpha: float) -> float:
    """The Gamma from which on the second orbit of one period is no motion: its ball would pass
    through the table.  Bisection between the birth and the doubling; the doubling where it is a
    motion up to there.

    >>> round(grazing(0.05), 3), round(grazing(0.098), 3)
    (2.888, 2.77)
    """
    low, high = birth(alpha), doubling(alpha)
    if clearance(alpha, high) >= 0:
        return high
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if clearance(alpha, middle) >= 0 else (low, middle)
    return high
