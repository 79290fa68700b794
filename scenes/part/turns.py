"""Which way up a block is, and what is noted of it: nearer to upright or to lying, since when, and
how often it changed.

The two are parted where a block, tilted on a corner, has its centre above that corner: at atan(a/b)
from upright.
"""

from __future__ import annotations

from math import floor, pi

from scenes.part.body import FALLS, LAST_LYING, LAST_UPRIGHT, RISES, SINCE, SPLIT, Floats
from scenes.part.compiling import compiled


@compiled
def side(p: Floats, theta: float) -> int:
    """An even number where the block is nearer to upright, an odd one where to lying; it grows by 1
    whenever theta passes from one to the other.
    """
    split = p[SPLIT]
    turns = floor((theta + split) / pi)
    return 2 * int(turns) + (0 if theta + split - turns * pi < 2 * split else 1)


@compiled
def note_turn(p: Floats, notes: Floats, t0: float, theta0: float, t1: float, theta1: float) -> None:
    """Notes the sides that a block was on from t0 to t1, turning evenly."""
    before, after = side(p, theta0), side(p, theta1)
    lying = after % 2 == 1
    if before != after:
        split = p[SPLIT]
        step = 1 if after > before else -1
        last = t0
        for k in range(before, after, step):
            edge = (
                k if step == 1 else k - 1
            )  # the boundary between the sides k and k + step, after side `edge`
            angle = (edge // 2) * pi + split if edge % 2 == 0 else (edge // 2 + 1) * pi - split
            last = min(max(t0 + (t1 - t0) * (angle - theta0) / (theta1 - theta0), t0), t1)
            if last >= notes[SINCE]:
                if k % 2 == 0:
                    notes[FALLS] += 1
                else:
                    notes[RISES] += 1
        notes[LAST_UPRIGHT if lying else LAST_LYING] = last
    notes[LAST_LYING if lying else LAST_UPRIGHT] = t1
