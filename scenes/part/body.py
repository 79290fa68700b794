"""The compiler of the kernels, and the block and the table as numbers for them."""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Callable
from math import cos, pi, sin
from pathlib import Path
from typing import Protocol, TypeVar

# -------------------------------------------------------------------------------------------------
# The compiler: numba where it is installed, and the same functions in plain Python where it is not.

try:
    import numba
except ImportError:  # the optional extra `part`
    numba = None

Kernel = TypeVar("Kernel", bound=Callable[..., object])
COMPILED = numba is not None
KERNELS = ("body", "flight", "strike", "rest", "motion")  # the files that are compiled


def kernel_digest() -> str:
    """A digest of all kernels: numba looks at the file of a function only, not at those of the
    functions that it calls.
    """
    digest = hashlib.sha256(sys.version.encode())
    for name in KERNELS:
        digest.update(Path(__file__).with_name(f"{name}.py").read_bytes())
    return digest.hexdigest()[:16]


def _folder() -> Path | None:
    """The folder of machine code, if there is one: that of NUMBA_CACHE_DIR, or beside the other
    records of the project (see `juggleproof.proofs.kept`).
    """
    chosen = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("JUGGLEPROOF_CACHE", "")
    if chosen == "off":
        return None
    try:
        root = (
            Path(chosen)
            if chosen
            else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "juggleproof"
        )
        folder = root / f"numba-{kernel_digest()}"
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return folder if os.access(folder, os.W_OK) else None


FOLDER = _folder() if COMPILED else None


def compiled(function: Kernel) -> Kernel:
    """The function compiled for floats, without the interpreter's lock; as it is where numba is
    absent.

    Sums keep their order and nothing is contracted, so that results are the same wherever sin and
    cos are.
    """
    if numba is None:
        return function
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(FOLDER or "")
    try:
        made: Kernel = numba.njit(cache=FOLDER is not None, nogil=True, error_model="numpy")(
            function
        )
    finally:
        numba.config.CACHE_DIR = before
    return made


def plain(function: Kernel) -> Kernel:
    """The function in plain Python: it takes exact numbers too."""
    return getattr(function, "py_func", function)


# -------------------------------------------------------------------------------------------------
# The block and the table.
#
# The block and the table as numbers for the kernels: what their parameters, states and counts are
# called, and where corners and table are.
#
# Lengths in metres, times in seconds, angles in radians, energies in joules per kilogram.  theta =
# 0 is upright, with the long sides vertical, and grows counterclockwise.  A state is (t, X, Y,
# theta, V_X, V_Y, omega) of the centre of mass in the resting frame, then how the block is in
# contact.


class Floats(Protocol):
    """A row of float64, such as a NumPy array of one dimension."""

    def __getitem__(self, k: int, /) -> float: ...
    def __setitem__(self, k: int, value: float, /) -> None: ...


# the parameters of a scene
(
    G,
    A_X,
    W_X,
    PHASE_X,
    A_Y,
    W_Y,
    PHASE_Y,
    HALF_SHORT,
    HALF_LONG,
    GYRATION,
    RESTITUTION,
    FRICTION,
    TOLERANCE,
    REST_SPEED,
    STEP,
    SPLIT,
    REACH,
    CHECKED,
) = range(18)
PARAMETERS = 18

# a state; for the last two see `contact`
TIME, X, Y, THETA, V_X, V_Y, OMEGA, MODE, CORNER, SLIDE = range(10)
STATE = 10
FLIGHT, PIVOT, FACE = 0.0, 1.0, 2.0

# what is counted or noted of an orbit
(
    IMPACTS,
    STEPS,
    CONTACTS,
    LAST_UPRIGHT,
    LAST_LYING,
    FALLS,
    RISES,
    LEAST_GAP,
    PULLS,
    CONES,
    GAINS,
    CLOSINGS,
    LARGEST_REMOVED,
    IMPULSES,
    SINCE,
    SINKS,
) = range(16)
NOTES = 16

# how a run ended
DONE, TOO_MANY_STEPS, JAMMED, TOO_MANY_IMPACTS, TOO_MANY_EVENTS = range(5)

MOMENT = 1e-10  # seconds: how long a flight or a phase of contact lasts that would end at once
QUARTER = pi / 2
TINY_TURN, SMALL_TURN = 0.05, 1.5  # radians


@compiled
def corner_x(p: Floats, i: int, c: float, s: float) -> float:
    """How far corner i is to the right of the centre, in metres, where c and s are cosine and sine
    of theta; corners 0 to 3 go around counterclockwise.
    """
    a, b = p[HALF_SHORT], p[HALF_LONG]
    if i == 0:
        return -a * c + b * s
    if i == 1:
        return a * c + b * s
    if i == 2:
        return a * c - b * s
    return -a * c - b * s


@compiled
def corner_y(p: Floats, i: int, c: float, s: float) -> float:
    """How far corner i is above the centre, in metres."""
    a, b = p[HALF_SHORT], p[HALF_LONG]
    if i == 0:
        return -a * s - b * c
    if i == 1:
        return a * s - b * c
    if i == 2:
        return a * s + b * c
    return -a * s + b * c


@compiled
def corner(sx: float, sy: float) -> int:
    """The number of the corner that at theta = 0 is right (sx = 1) or left (-1) of the centre and
    above (sy = 1) or below it.
    """
    if sy < 0:
        return 0 if sx < 0 else 1
    return 3 if sx < 0 else 2


@compiled
def turned(c: float, s: float, step: float) -> tuple[float, float]:
    """Cosine and sine of an angle after a step of at most SMALL_TURN, by series, of half of
    it where it is not tiny; to a rounding, and faster than sine and cosine.
    """
    if abs(step) < TINY_TURN:
        q = step * step
        across = step * (1 - q * (1 / 6) * (1 - q * 0.05 * (1 - q * (1 / 42))))
        back = q * (0.5 - q * (1 / 24) * (1 - q * (1 / 30) * (1 - q * (1 / 56))))
        return c - (c * back + s * across), s - (s * back - c * across)
    h = step / 2
    q = h * h
    q2 = q * q
    sine = h * (
        (1 - q * (1 / 6) + q2 * (1 / 120 - q * (1 / 5040)))
        + q2
        * q2
        * (1 / 362880 - q * (1 / 39916800) + q2 * (1 / 6227020800 - q * (1 / 1307674368000)))
    )
    less = q * (
        (0.5 - q * (1 / 24) + q2 * (1 / 720 - q * (1 / 40320)))
        + q2
        * q2
        * (1 / 3628800 - q * (1 / 479001600) + q2 * (1 / 87178291200 - q * (1 / 20922789888000)))
    )
    across, back = 2 * sine * (1 - less), 2 * sine * sine
    return c - (c * back + s * across), s - (s * back - c * across)


@compiled
def table_height(p: Floats, t: float) -> float:
    """The height of the table at the time t, in metres: A_y sin(W_y t + phase_y)."""
    return p[A_Y] * sin(p[W_Y] * t + p[PHASE_Y])


@compiled
def table_rise(p: Floats, t: float) -> float:
    """The speed of the table upwards, in m/s."""
    return p[A_Y] * p[W_Y] * cos(p[W_Y] * t + p[PHASE_Y])


@compiled
def table_lift(p: Floats, t: float) -> float:
    """The acceleration of the table upwards, in m/s^2."""
    return -p[A_Y] * p[W_Y] * p[W_Y] * sin(p[W_Y] * t + p[PHASE_Y])


@compiled
def table_place(p: Floats, t: float) -> float:
    """The displacement of the table to the right, in metres: A_x sin(W_x t + phase_x)."""
    return p[A_X] * sin(p[W_X] * t + p[PHASE_X])


@compiled
def table_glide(p: Floats, t: float) -> float:
    """The speed of the table to the right, in m/s."""
    return p[A_X] * p[W_X] * cos(p[W_X] * t + p[PHASE_X])


@compiled
def table_push(p: Floats, t: float) -> float:
    """The acceleration of the table to the right, in m/s^2."""
    return -p[A_X] * p[W_X] * p[W_X] * sin(p[W_X] * t + p[PHASE_X])
