"""The part against general engines of rigid bodies: single impacts and an ensemble on the vibrating
table, by pymunk, by MuJoCo and by ours; their error and CPU seconds.

    python -m juggleproof.benchmarks.engines [--accept]    # writes the table into the page

An impact is a block on one corner that flies into a still table, without gravity; its error is the
distance of the velocities after it from those of the impact law, as `juggleproof.symbolic` derives
it, in parts of those before.  An ensemble is 91 blocks at 30 Hz 1 mm, in the frame of the table.
Engines take restitution and friction as they offer them: pymunk by Newton, MuJoCo as the damping of
a spring that has this restitution.
"""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from juggleproof.benchmarks.generated import DOCS, Generated, in_columns
from juggleproof.benchmarks.part import THIRD_ROW
from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.scenes.part import body, fresh_notes, scene, standing
from juggleproof.scenes.part.ensemble import frames
from juggleproof.scenes.part.onsets import jittered
from juggleproof.scenes.part.setting import Array, Scene
from juggleproof.scenes.part.strike import JAMMING, first_slide, impulse, mode_of, strike

try:  # the optional extra `peers`
    import mujoco
    import pymunk
except ImportError:
    mujoco = pymunk = None

TABLE = Generated(DOCS / "benchmarks.md", "engines")
HEADS = (
    *("engine", "step, s", "error, median", "error, largest", "gain energy", "CPU us an impact"),
    *("upright at 0.8 s", "upright at 3 s", "CPU s of an ensemble"),
)
IMPACTS, SEED = 500, 1
EARLY, LATE = 0.8, 3.0  # seconds, as in figure 2
STEPS = {"pymunk": (1e-3, 1e-4, 1e-5), "MuJoCo": (1e-4, 1e-5)}  # seconds
ENSEMBLE_STEP = 1e-4  # seconds: those of an ensemble
HALF_FLOOR = 100.0  # metres
SPRING = 0.2  # radians in a step of MuJoCo's spring
SLACK = 1e-9  # by which more energy than before is more than rounding
CLEARANCE = 1e-6  # metres above the table
MOST_STEPS = 100_000  # of an impact
STILL = 1e-9  # m/s and rad/s: a step that changes less is flight


class Impact(NamedTuple):
    """A scene, and the block before an impact: (X, Y, theta, V_X, V_Y, omega)."""

    block: Scene
    start: Array


def impacts(count: int) -> Iterator[Impact]:
    """Random blocks whose lowest corner approaches a still table faster than 0.1 m/s."""
    dice = np.random.default_rng(SEED)
    while count:
        e, mu, theta, *speeds = dice.uniform([0.2, 0, 0.1, -1, -1, -20], [0.95, 1, 1.4, 1, 0, 20])
        block = scene(e=e, mu=mu, A_y=0.0)
        height = block.a * math.sin(theta) + block.b * math.cos(theta)
        one = Impact(block, np.array([0.0, height, theta, *speeds]))
        if corner(one)[3] < -0.1:
            count -= 1
            yield one


def corner(one: Impact) -> tuple[float, float, float, float]:
    """The lowest corner, from the centre of mass, and its velocity; for 0 < theta < 90 degrees."""
    theta, across, up, omega = map(float, one.start[2:])
    a, b = one.block.a, one.block.b
    x = -a * math.cos(theta) + b * math.sin(theta)
    y = -a * math.sin(theta) - b * math.cos(theta)
    return x, y, across - omega * y, up + omega * x


def by_law(one: Impact) -> Array:
    """(V_X, V_Y, omega) after an impact by the impact law, from exact numbers.

    Raises ArithmeticError where friction jams the corner, which none below 4/3 does.
    """
    x, y, S0, C0 = map(Fraction, corner(one))
    e, mu, *before = map(Fraction, (one.block.e, one.block.mu, *one.start[3:].tolist()))
    k2 = (Fraction(one.block.a) ** 2 + Fraction(one.block.b) ** 2) / 3
    B1, B2, B3 = 1 + y * y / k2, 1 + x * x / k2, x * y / k2
    sigma = first_slide(S0, B1, B3, mu)  # type: ignore[arg-type]  # exact numbers too
    mode = mode_of(S0, C0, B1, B2, B3, e, mu, sigma)  # type: ignore[arg-type]
    if mode == JAMMING:
        raise ArithmeticError(f"a corner jams at mu = {one.block.mu}")
    P_x, P_y = impulse(mode, S0, C0, B1, B2, B3, e, mu, sigma)  # type: ignore[arg-type]
    changes = (P_x, P_y, (x * P_y - y * P_x) / k2)
    return np.array([float(v + change) for v, change in zip(before, changes)])


def in_speeds(block: Scene, velocities: Array) -> Array:
    """(V_X, V_Y, k omega) in metres a second, k the radius of gyration."""
    return velocities * [1, 1, math.sqrt((block.a**2 + block.b**2) / 3)]


# -------------------------------------------------------------------------------------------------
# The engines: each takes a scene, blocks, (n, 6), and the step, and gives what moves them on by one
# step under a pull of gravity, and what tells where they are, in rows as they were given.


class Moving(NamedTuple):
    """Blocks in an engine: `step` moves them on under this pull, (x, y) in m/s^2."""

    step: Callable[[float, float], None]
    states: Callable[[], Array]


def in_pymunk(block: Scene, starts: Array, step: float) -> Moving:
    """Blocks over a still floor in pymunk; they do not meet one another."""
    space = pymunk.Space()
    space.collision_slop = CLEARANCE
    floor = pymunk.Poly(
        space.static_body, [(-HALF_FLOOR, -1), (HALF_FLOOR, -1), (HALF_FLOOR, 0), (-HALF_FLOOR, 0)]
    )
    floor.elasticity = floor.friction = 1.0  # those of a pair are multiplied
    space.add(floor)
    bodies = []
    for X, Y, theta, V_X, V_Y, omega in starts.tolist():
        one = pymunk.Body(1.0, (block.a**2 + block.b**2) / 3)
        one.position, one.angle = (X, Y), theta
        one.velocity, one.angular_velocity = (V_X, V_Y), omega
        shape = pymunk.Poly.create_box(one, (2 * block.a, 2 * block.b))
        shape.elasticity, shape.friction = block.e, block.mu
        shape.filter = pymunk.ShapeFilter(group=1)
        space.add(one, shape)
        bodies.append(one)

    def on(x: float, y: float) -> None:
        space.gravity = (x, y)
        space.step(step)

    return Moving(
        on,
        lambda: np.array([[*b.position, b.angle, *b.velocity, b.angular_velocity] for b in bodies]),
    )


def damping(e: float) -> float:
    """The damping ratio of a spring that pushes only, and sends back with restitution e.

    >>> round(damping(0.5), 3)
    0.255
    """

    def restitution(ratio: float) -> float:
        root = math.sqrt(1 - ratio**2)
        return math.exp(-2 * ratio / root * math.atan2(root, ratio))

    low, high = 0.0, 1.0 - 1e-12
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if restitution(middle) > e else (low, middle)
    return low


def in_mujoco(block: Scene, starts: Array, step: float) -> Moving:
    """Blocks in a plane over a floor in MuJoCo; they do not meet one another."""
    turn = SPRING / step
    contact = (
        f'friction="{block.mu} 0 0" solref="{-(turn**2)} {-2 * damping(block.e) * turn}"'
        ' solimp="0.9999 0.9999 0.001"'
    )
    one = (
        '<body><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
        f'<joint axis="0 -1 0"/><geom type="box" size="{block.a} {block.a} {block.b}" mass="1"'
        f' contype="1" conaffinity="0" {contact}/></body>'
    )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step}" gravity="0 0 0" cone="elliptic" impratio="100"/>'
        f'<worldbody><geom type="plane" size="0 0 1" contype="0" conaffinity="1" {contact}/>'
        f"{one * len(starts)}</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = starts[:, :3].ravel(), starts[:, 3:].ravel()

    def on(x: float, y: float) -> None:
        model.opt.gravity[:] = (x, 0, y)
        mujoco.mj_step(model, data)

    return Moving(on, lambda: np.hstack([data.qpos.reshape(-1, 3), data.qvel.reshape(-1, 3)]))


Engine = Callable[[Scene, Array, float], Moving]
ENGINES: dict[str, Engine] = {"pymunk": in_pymunk, "MuJoCo": in_mujoco}


def present() -> list[str]:
    """The engines, where both are installed."""
    return [] if mujoco is None else [*ENGINES]


# -------------------------------------------------------------------------------------------------
# Impacts.


def struck(engine: Engine, one: Impact, step: float) -> tuple[Array, float]:
    """(V_X, V_Y, omega) after an impact in an engine, and CPU seconds; RuntimeError where it does
    not come to an end.
    """
    start = one.start.copy()
    start[1] += CLEARANCE
    moving = engine(one.block, start[None], step)
    before, touched, began = start[3:], False, cpu_seconds()
    for _ in range(MOST_STEPS):
        moving.step(0.0, 0.0)
        now = moving.states()[0, 3:]
        same = float(np.abs(now - before).max()) < STILL
        if touched and same:
            return now, cpu_seconds() - began
        before, touched = now, touched or not same
    raise RuntimeError(f"an impact takes more than {MOST_STEPS} steps of {step:g} s")


def ours(some: Sequence[Impact]) -> tuple[list[Array], float]:
    """(V_X, V_Y, omega) after impacts by our kernel, and CPU seconds of them all."""
    parameters, states = [], np.zeros((len(some), body.STATE))
    for one, state in zip(some, states):
        parameters.append(one.block.parameters(False))
        state[body.X : body.X + 6] = one.start
    notes, began = fresh_notes(len(some)), cpu_seconds()
    for p, state, note in zip(parameters, states, notes):
        strike(p, state, note)
    return [*states[:, body.V_X : body.V_X + 3]], cpu_seconds() - began


def errors(some: Sequence[Impact], found: Sequence[Array]) -> tuple[float, float, int]:
    """The median and the largest error, in parts of the speed before, and how many impacts gain
    energy.
    """
    parts, gains = [], 0
    for one, after in zip(some, found):
        speeds, law = in_speeds(one.block, after), in_speeds(one.block, by_law(one))
        before = float(np.linalg.norm(in_speeds(one.block, one.start[3:])))
        parts.append(float(np.linalg.norm(speeds - law)) / before)
        gains += float(np.linalg.norm(speeds)) > before * (1 + SLACK)
    return statistics.median(parts), max(parts), gains


# -------------------------------------------------------------------------------------------------
# Ensembles.


def ensemble(
    engine: Engine, block: Scene, angles: Array, step: float, times: Sequence[float]
) -> tuple[list[int], float]:
    """How many blocks are upright at these times, in an engine, in the frame of the table, and CPU
    seconds.
    """
    p = block.parameters(False)
    states = standing(block, angles)
    starts = states[:, body.X : body.X + 6].copy()
    starts[:, 0] -= body.table_place(p, 0.0)
    starts[:, 1] -= body.table_height(p, 0.0)
    starts[:, 3] -= body.table_glide(p, 0.0)
    starts[:, 4] -= body.table_rise(p, 0.0)
    moving, counts, done, began = engine(block, starts, step), [], 0, cpu_seconds()
    for until in times:
        while done < round(until / step):
            t = (done + 0.5) * step
            moving.step(body.table_push(p, t) * -1.0, -block.g - body.table_lift(p, t))
            done += 1
        counts.append(upright(moving.states()[:, 2]))
    return counts, cpu_seconds() - began


def upright(theta: Array) -> int:
    """How many of these angles are within 45 degrees of upright or of upside down."""
    return int((np.floor(theta / (math.pi / 2) + 0.5) % 2 == 0).sum())


# -------------------------------------------------------------------------------------------------
# The table.


def rows(count: int, angles: Array, times: Sequence[float]) -> Iterator[tuple[str, ...]]:
    """The lines of the table: ours, then each engine that is installed, by step."""
    some = [*impacts(count)]
    ours(some[:1])  # compiles
    found, seconds = ours(some)
    frames(THIRD_ROW, angles[:1], times[:1])  # compiles
    began = cpu_seconds()
    turned = frames(THIRD_ROW, angles, times)[:, :, body.THETA]
    standings = [upright(one) for one in turned]
    yield line("ours", "", errors(some, found), seconds / count, standings, cpu_seconds() - began)
    for name in present():
        for step in STEPS[name]:
            ends = [struck(ENGINES[name], one, step) for one in some]
            told = errors(some, [after for after, _ in ends])
            each = sum(seconds for _, seconds in ends) / count
            if step == ENSEMBLE_STEP:
                many = ensemble(ENGINES[name], THIRD_ROW, angles, step, times)
                yield line(name, f"{step:g}", told, each, *many)
            else:
                yield line(name, f"{step:g}", told, each, [], None)


def line(
    name: str,
    step: str,
    told: tuple[float, float, int],
    each: float,
    standings: Sequence[int],
    seconds: float | None,
) -> tuple[str, ...]:
    """One line of the table, in words."""
    median, most, gains = told
    many = ("",) * 3 if seconds is None else (*map(str, standings), f"{seconds:.2g}")
    return name, step, f"{median:.1g}", f"{most:.1g}", str(gains), f"{1e6 * each:,.0f}", *many


def main(arguments: Sequence[str] | None = None) -> None:
    """Prints the table, or writes it into the page."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.engines")
    parser.add_argument("--accept", action="store_true")
    accept = parser.parse_args(arguments).accept
    text = in_columns(HEADS, *rows(IMPACTS, jittered(1, SEED)[0], (EARLY, LATE)))
    absent = [name for name in ENGINES if name not in present()]
    if accept and not absent:
        TABLE.write(text)
    else:
        print(text)
    if absent:
        raise SystemExit(f"absent: {', '.join(absent)}; the extra peers has them")


if __name__ == "__main__":
    main()
