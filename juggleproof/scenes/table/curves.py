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

STEPS = 4000  # times at which a flight is looked at, closer together where it begins


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


def least_g(alpha: float) -> float:
    """The least g at which the flight of a bounce of one period stays above the table; the second
    solution has -g in place of g.

    At time t of the flight the ball is t (1 - t)/2 - (c sin 2 pi t - g (1 - cos 2 pi t))/(2 pi)
    above the table, which grows with g.
    """
    c, time = birth(alpha) / (2 * pi), (np.arange(1, STEPS) / STEPS) ** 2
    touches = (c * np.sin(2 * pi * time) - pi * time * (1 - time)) / (2 * np.sin(pi * time) ** 2)
    return float(touches.max())


def grazing(alpha: float) -> float:
    """The Gamma from which on the second orbit of one period is no motion: its ball would pass
    through the table; at most the doubling.

    >>> round(grazing(0.05), 3), round(grazing(0.098), 3)
    (2.888, 2.77)
    """
    return min(doubling(alpha), gamma_of(alpha, max(0.0, -least_g(alpha))))


def own_grazing(alpha: float) -> float:
    """The Gamma up to which the bounce itself is no motion: its ball would pass through the table;
    the birth, but where alpha is small.

    >>> round(own_grazing(0.002), 2), own_grazing(0.05) == birth(0.05)
    (3.2, True)
    """
    return gamma_of(alpha, max(0.0, least_g(alpha)))
