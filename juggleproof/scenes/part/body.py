"""The compiler of the kernels, and the block and the table as numbers for them."""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from math import cos, floor, pi, sin
from pathlib import Path
from typing import Any, Protocol, TypeVar

# -------------------------------------------------------------------------------------------------
# The compiler: numba where it is installed, and the same functions in plain Python where it is not.
#
# By itself numba optimizes every function and makes machine code of it, and does so again for each
# of its callers: this took most of the time of compiling.  Here one kernel is compiled.  The
# functions that it calls are its parts: numba translates them one by one, and optimizes them and
# makes machine code of them once, with the kernel.

try:
    import numba
except ImportError:  # the optional extra `part`
    numba = None
if numba is not None:
    from numba import types
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import Compiler
    from numba.core.typing.templates import builtin_registry
    from numba.extending import models, register_model

Kernel = TypeVar("Kernel", bound=Callable[..., object])
COMPILED = numba is not None
KERNELS = ("body", "flight", "strike", "rest", "motion")  # the files that are compiled
# Sums keep their order and nothing is contracted, so that results are the same on all machines with
# the same sin and cos.  Kernels make no arrays: references to arrays are not counted, which saves a
# tenth of the time.
OPTIONS = {"error_model": "numpy", "_nrt": False}


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
    records of the project (see `juggleproof.judging.report_cache`).
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


def kernel(function: Kernel) -> Kernel:
    """The function compiled for floats when it is first called, without the interpreter's lock, and
    kept on disk; if numba is absent, the function itself.
    """
    if numba is None:
        return function
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(FOLDER or "")
    try:
        made: Kernel = numba.njit(cache=FOLDER is not None, nogil=True, **OPTIONS)(function)
    finally:
        numba.config.CACHE_DIR = before
    return made


def compiled(function: Kernel) -> Kernel:
    """The function as a part of the kernel; called from Python it is plain Python, and takes exact
    numbers too.
    """
    return _part(function)


def inlined(function: Kernel) -> Kernel:
    """The same, but inlined wherever it is called; this saves another tenth of the time in a
    function that many events pass through.
    """
    return _part(function, forceinline=True)


def _part(function: Kernel, **options: bool) -> Kernel:
    if numba is not None:
        wrappers = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        part = numba.njit(pipeline_class=_PartCompiler, **wrappers, **OPTIONS, **options)(function)
        builtin_registry.register_global(function, _Part(part))
    return function


if numba is not None:

    class _Part(types.Dispatcher):  # type: ignore[misc]
        """The type of a part for the compiler: a function that is compiled once for each set of
        types, whatever constants it is called with.
        """

        def __init__(self, part: object) -> None:
            self.part = part  # the base class does not keep it
            super().__init__(part)

        def get_call_type(self, context: object, args: Iterable[object], kws: object) -> object:
            return super().get_call_type(context, tuple(map(types.unliteral, args)), kws)

    register_model(_Part)(models.OpaqueModel)

    class _PartLibrary(JITCodeLibrary):  # type: ignore[misc]
        """The code of a part as it was translated, which the kernel takes in with that of all parts
        that it calls.  It never runs by itself: what numba does to make it run is left out.
        """

        def finalize(self) -> None:
            self._finalized = True

        def _get_module_for_linking(self) -> object:
            whole = self._final_module.clone()
            for one in self._all_called({self}):
                whole.link_in(one._final_module, preserve=True)
            for function in whole.functions:
                if not function.is_declaration:
                    function.linkage = "linkonce_odr"  # the kernel may have it from others too
            return whole

        def _all_called(self, seen: set[object]) -> Iterator[Any]:
            for one in self._linking_libraries:
                if one not in seen:
                    seen.add(one)
                    yield one
                    if isinstance(one, _PartLibrary):
                        yield from one._all_called(seen)

        @property
        def codegen(self) -> _PartLibrary:
            return self

        def set_env(self, name: str, environment: object) -> None:
            pass

    class _PartCompiler(Compiler):  # type: ignore[misc]
        def __init__(self, typingctx: object, targetctx: Any, library: object, *more: object):
            library = _PartLibrary(targetctx.codegen(), "part")
            super().__init__(typingctx, targetctx, library, *more)


# -------------------------------------------------------------------------------------------------
# The block and the table.
#
# The block and the table as numbers for the kernels: what their parameters, states and counts are
# called, and where corners and table are.
#
# Lengths in metres, times in seconds, angles in radians, energies in joules per kilogram.  At theta
# = 0 corners are as given, a rectangle upright; theta grows counterclockwise.  A state is (t, X, Y,
# theta, V_X, V_Y, omega) of the centre of mass in the resting frame, X along the table and Y away
# from it, then how the block is in contact.


class Floats(Protocol):
    """A row of float64, such as a NumPy array of one dimension."""

    def __getitem__(self, k: int, /) -> float: ...
    def __setitem__(self, k: int, value: float, /) -> None: ...


# the parameters of a scene: numbers, then corners and more from EDGES on
(
    G,
    A_X,
    W_X,
    PHASE_X,
    A_Y,
    W_Y,
    PHASE_Y,
    GYRATION,
    RESTITUTION,
    FRICTION,
    TOLERANCE,
    REST_SPEED,
    STEP,
    LEAST_TURN,
    REACH,
    SIZE,
    CHECKED,
    CORNERS,
    FIRST,
    SIDES,
    AT_FACES,
    AT_SIDES,
    DRIVE,
    AT_DRIVE,
    EDGES,
) = range(25)
# of each corner: its place from the centre at theta = 0, and the direction of the edge to the next
CORNER_X, CORNER_Y, EDGE_X, EDGE_Y = range(4)
SINE, SINES = 0.0, 1.0  # how the table moves

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
TURN = 2 * pi
TINY_TURN, SMALL_TURN = 0.05, 1.5  # radians


@inlined
def corner_x(p: Floats, i: int, c: float, s: float) -> float:
    """How far corner i is to the right of the centre, in metres, where c and s are cosine and sine
    of theta; corners go around counterclockwise.
    """
    at = EDGES + 4 * i
    return p[at] * c - p[at + CORNER_Y] * s


@inlined
def corner_y(p: Floats, i: int, c: float, s: float) -> float:
    """How far corner i is above the centre, in metres."""
    at = EDGES + 4 * i
    return p[at] * s + p[at + CORNER_Y] * c


@inlined
def edge_rise(p: Floats, i: int, c: float, s: float) -> float:
    """The sine of the angle of edge i, from corner i to the next, to the table."""
    at = EDGES + 4 * i
    return p[at + EDGE_X] * s + p[at + EDGE_Y] * c


@inlined
def edge_run(p: Floats, i: int, c: float, s: float) -> float:
    """The cosine of the angle of edge i to the table."""
    at = EDGES + 4 * i
    return p[at + EDGE_X] * c - p[at + EDGE_Y] * s


@inlined
def next_corner(p: Floats, i: int) -> int:
    """The corner after corner i."""
    return i + 1 if i + 1 < int(p[CORNERS]) else 0


@inlined
def last_corner(p: Floats, i: int) -> int:
    """The corner before corner i."""
    return i - 1 if i > 0 else int(p[CORNERS]) - 1


@inlined
def lowest(p: Floats, i: int, c: float, s: float, omega: float) -> int:
    """The lowest corner, looked for from corner i on; of two that are equally low the one that will
    be lower as the block turns, and the later one where it does not turn.
    """
    count = int(p[CORNERS])
    if not 0 <= i < count:
        i = 0
    for _ in range(count):
        up = edge_rise(p, i, c, s)
        if up > 0 or up == 0 and omega * edge_run(p, i, c, s) > 0:
            break
        i = next_corner(p, i)
    for _ in range(count):
        before = last_corner(p, i)
        up = edge_rise(p, before, c, s)
        if up < 0 or up == 0 and omega * edge_run(p, before, c, s) <= 0:
            break
        i = before
    return i


# The angles at which edges lie on the table are numbered as the block turns, 0 the first from 0 up
# to a turn; edge FIRST lies at angle 0, and the next angle is that of the edge before it.


@compiled
def face_angle(p: Floats, turn: int) -> float:
    """The angle with this number, in radians."""
    count = int(p[CORNERS])
    around = turn // count
    return (around + p[int(p[AT_FACES]) + turn - around * count]) * TURN


@compiled
def first_angle(p: Floats, i: int, theta: float) -> int:
    """The number of the angle near theta between which and the next one corner i is the lowest."""
    count, at = int(p[CORNERS]), int(p[AT_FACES])
    turn = (int(p[FIRST]) - i) % count
    end = p[at + turn + 1] if turn + 1 < count else p[at] + 1
    around = floor(theta / TURN - (p[at + turn] + end) / 2 + 0.5)
    return int(around) * count + turn


@compiled
def flat_angle(p: Floats, i: int, theta: float) -> float:
    """The angle nearest to theta at which edge i lies on the table."""
    turn = (int(p[FIRST]) - i) % int(p[CORNERS])
    start = p[int(p[AT_FACES]) + turn]
    return (floor(theta / TURN - start + 0.5) + start) * TURN


@inlined
def turned(c: float, s: float, step: float) -> tuple[float, float]:
    """The cosine and sine of an angle after a step of at most SMALL_TURN, up to rounding: by series
    in the step if it is tiny, else in half of it.  This is faster than sin and cos.
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


# -------------------------------------------------------------------------------------------------
# The table: at (A_x sin(W_x t + phase_x), A_y sin(W_y t + phase_y)), or along each axis a sum of
# such.
#
# For both A W^k bounds the derivatives from the second to the fourth.  A sum is stored from
# AT_DRIVE on: the number of its terms, then A, W and phase of each; first along, then up.


@compiled
def shaken(p: Floats, t: float, axis: int, order: int) -> float:
    """Return a derivative of the table's place, of order 0 to 3, along it (axis 0) or up (1)."""
    at = int(p[AT_DRIVE])
    if axis == 1:
        at += 1 + 3 * int(p[at])
    total = 0.0
    for k in range(int(p[at])):
        A, W, phase = p[at + 1 + 3 * k], p[at + 2 + 3 * k], p[at + 3 + 3 * k]
        wave = sin(W * t + phase) if order % 2 == 0 else cos(W * t + phase)
        total += (A if order < 2 else -A) * W**order * wave
    return total


@inlined
def table_height(p: Floats, t: float) -> float:
    """The height of the table at the time t, in metres."""
    if p[DRIVE] != SINE:
        return shaken(p, t, 1, 0)
    return p[A_Y] * sin(p[W_Y] * t + p[PHASE_Y])


@inlined
def table_rise(p: Floats, t: float) -> float:
    """The speed of the table upwards, in m/s."""
    if p[DRIVE] != SINE:
        return shaken(p, t, 1, 1)
    return p[A_Y] * p[W_Y] * cos(p[W_Y] * t + p[PHASE_Y])


@inlined
def table_lift(p: Floats, t: float) -> float:
    """The acceleration of the table upwards, in m/s^2."""
    if p[DRIVE] != SINE:
        return shaken(p, t, 1, 2)
    return -p[A_Y] * p[W_Y] * p[W_Y] * sin(p[W_Y] * t + p[PHASE_Y])


@compiled
def table_place(p: Floats, t: float) -> float:
    """The displacement of the table to the right, in metres."""
    if p[DRIVE] != SINE:
        return shaken(p, t, 0, 0)
    return p[A_X] * sin(p[W_X] * t + p[PHASE_X])


@inlined
def table_glide(p: Floats, t: float) -> float:
    """The speed of the table to the right, in m/s."""
    if p[DRIVE] != SINE:
        return shaken(p, t, 0, 1)
    return p[A_X] * p[W_X] * cos(p[W_X] * t + p[PHASE_X])


@compiled
def table_push(p: Floats, t: float) -> float:
    """The acceleration of the table to the right, in m/s^2."""
    if p[DRIVE] != SINE:
        return shaken(p, t, 0, 2)
    return -p[A_X] * p[W_X] * p[W_X] * sin(p[W_X] * t + p[PHASE_X])
