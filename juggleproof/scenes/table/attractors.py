"""What balls come to on tables that move as a sine, over restitution and drive: from many starts at
each pair, in floats, all at once.

A ball that rests is launched where S rises through 1, so that one orbit, from launch on, tells what
all balls that ever rest come to: where it rests again it repeats itself for ever.  What is found
here is simulated, not proved: a second orbit that repels is met by no start, and a ball that takes
long to come to the bounce, or to rest, counts as neither.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import nan, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.table.curves import birth, doubling
from juggleproof.scenes.table.motion import REST, Floats, Table, at_bounce, bounce_phase, landing

ALONE, BESIDE, STICKS, OTHER = range(4)  # what the balls of a pair come to
BOUNCES, RESTS, GOES_ON = range(3)  # what one ball comes to
PHASES, SPEEDS = 8, 4  # starts, and one from rest
MOST = 200  # flights of a ball, after which it goes on
AT_ONCE = 5000  # pairs, for the memory
SINE = Table(alpha=0.0, gamma=1.0)  # each ball has its own drive


class Attractors(NamedTuple):
    """kinds: ALONE (all balls come to the bounce of one period), BESIDE (some do), STICKS (all come
    to rest again and again) or OTHER, for each pair; starts: balls of a pair; flights: of all
    balls.
    """

    kinds: NDArray[np.int64]
    starts: int
    flights: int


def attractors(pairs: Sequence[tuple[float, float]]) -> Attractors:
    """What balls come to for each of these pairs of alpha and Gamma.

    >>> attractors([(0.05, 2.0), (0.05, 3.1), (0.3, 1.8785)]).kinds.tolist()
    [2, 0, 1]
    """
    parts = [_of_pairs(pairs[begin : begin + AT_ONCE]) for begin in range(0, len(pairs), AT_ONCE)]
    counts = np.concatenate([found for found, _ in parts])
    starts = PHASES * SPEEDS + 1
    kinds = np.select(
        [counts[:, BOUNCES] == starts, counts[:, BOUNCES] > 0, counts[:, RESTS] == starts],
        [ALONE, BESIDE, STICKS],
        OTHER,
    )
    return Attractors(kinds, starts, sum(flown for _, flown in parts))


def _of_pairs(pairs: Sequence[tuple[float, float]]) -> tuple[NDArray[np.int64], int]:
    """(how many balls of each pair come to the bounce, to rest again and again, and to neither,
    shape (n, 3); flights).
    """
    alpha, gamma = np.array(pairs).T
    bounce = np.array([stable_phase(*pair) for pair in pairs])
    phases, shares = np.meshgrid(
        (np.arange(PHASES) + 0.5) / PHASES, (np.arange(SPEEDS) + 0.5) / SPEEDS
    )
    speeds = np.multiply.outer(top_speed(alpha, gamma), shares.ravel()).ravel()
    phase = np.tile(phases.ravel(), len(pairs))
    per_ball = (np.repeat(one, PHASES * SPEEDS) for one in (alpha, gamma, bounce))
    fates, flights = find_fates(np.array([*per_ball, phase, speeds]))

    launched, falls = np.full(len(pairs), RESTS), gamma > 1
    if falls.any():
        alpha, gamma, bounce = alpha[falls], gamma[falls], bounce[falls]
        time = np.arcsin(1 / gamma) / (2 * pi)
        duration, hit = landing(SINE, time, gamma * SINE.derivative(time, 1), gamma)
        after = np.array([alpha, gamma, bounce, (time + duration) % 1.0, hit])
        launched[falls], flown = find_fates(after)
        flights += len(gamma) + flown

    fates = fates.reshape(len(pairs), -1)
    fates = np.where(fates == RESTS, launched[:, None], fates)
    fates = np.column_stack((fates, launched))
    found = np.column_stack([(fates == one).sum(axis=1) for one in (BOUNCES, RESTS, GOES_ON)])
    return found, flights


def stable_phase(alpha: float, gamma: float) -> float:
    """The phase of the bounce of one period; nan where there is none that is stable."""
    return bounce_phase(alpha, gamma) if birth(alpha) < gamma < doubling(alpha) else nan


def top_speed(alpha: Floats, gamma: Floats) -> Floats:
    """The closing speed s above which no motion stays: the impact after one at s is at most as fast
    as rho + sqrt((rho + alpha s)^2 + 2 rho/pi) with rho = Gamma/(2 pi), and this is s itself.
    """
    rho = gamma / (2 * pi)
    half = rho * (1 + alpha)
    return (half + np.sqrt(half**2 + (1 - alpha**2) * 2 * rho / pi)) / (1 - alpha**2)


def find_fates(balls: Floats) -> tuple[NDArray[np.int64], int]:
    """(BOUNCES, RESTS or GOES_ON for each ball; flights): what comes first, two impacts in a row at
    the bounce, or rest, or neither within MOST flights.

    balls: alpha, Gamma, phase of the stable bounce or nan, and phase and closing speed of the
    impact that it begins with, shape (5, n).
    """
    fates = np.full(balls.shape[1], GOES_ON)
    going, was = np.arange(balls.shape[1]), np.zeros(balls.shape[1], dtype=bool)
    flights = 0
    for number in range(MOST + 1):
        alpha, gamma, bounce, phase, hit = balls
        here = at_bounce(alpha, bounce, phase, hit)
        rests = (alpha * hit < REST) & (-gamma * SINE.derivative(phase, 2) <= 1)
        fates[going[rests]] = RESTS
        fates[going[here & was]] = BOUNCES
        on = ~(rests | (here & was))
        balls, going, was = balls[:, on], going[on], here[on]
        if number == MOST or not len(going):
            break
        alpha, gamma, bounce, phase, hit = balls
        up = gamma * SINE.derivative(phase, 1) + alpha * hit
        duration, hit = landing(SINE, phase, up, gamma)
        balls[3:] = (phase + duration) % 1.0, hit
        flights += len(going)
    return fates, flights
