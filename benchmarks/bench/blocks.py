"""The part on the vibrating table as work to be measured: blocks that fall on it, by the tolerance
of the flights, against ends that are known to 35 digits.
"""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np

from juggleproof.benchmarks.bench.answers import Drops, Strayed
from juggleproof.scenes.part import body, run, scene

THIRD_ROW = scene(e=0.7, mu=0.08, f_x=30.0, A_x=1e-3)  # of table I: 30 Hz, 1 mm
UNTIL = 0.2  # seconds
KNOWN = (
    # Y, theta and omega of a start that is otherwise at rest, 1 mm above the table; X and theta at
    # UNTIL, as tests/scenes/part/reference.py gives them to 35 digits
    (0.023061931849125517, 0.3, 0.0, -0.003101475204388124, 0.017600327998065483),
    (0.023061931849125517, 0.3, 20.0, 0.00025592713805318345, 1.7743708745265574),
    (0.023345906623849486, 0.5, 0.0, 0.0026708993436094495, -0.19195112214818577),
    (0.023345906623849486, 0.5, 20.0, -0.0018088531708368276, 1.5722365266224454),
    (0.022107695095938535, 0.8, 0.0, -0.005627797910479694, 1.590688899520696),
    (0.022107695095938535, 0.8, 20.0, -0.0022336009557193943, 1.5495416012118293),
    (0.0189839960291259, 1.1, 0.0, -0.00011313208206649776, 1.561524492678009),
    (0.0189839960291259, 1.1, 20.0, 0.0028584303379096464, 1.5637618350945488),
    (0.015985558426663677, 1.3, 0.0, -0.002068432040313402, 1.653887053002308),
    (0.015985558426663677, 1.3, 20.0, -0.0024788585952853397, 1.5682129428516045),
)


def followed(work: Drops, size: Fraction) -> Strayed:
    """Follows copies of each known block at a tolerance of `size` metres; the answer is the median
    distance from the known places, the note gives the number of impacts.
    """
    states = np.zeros((len(KNOWN), body.STATE))
    states[:, [body.Y, body.THETA, body.OMEGA]] = [one[:3] for one in KNOWN]
    block = replace(THIRD_ROW, tolerance=float(size), rest_speed=1e-6)
    done = run(block, np.repeat(states, work.copies, axis=0), UNTIL)
    ends = np.repeat([one[3:] for one in KNOWN], work.copies, axis=0)
    reach = math.hypot(block.a, block.b)
    away = np.abs(done.states[:, [body.X, body.THETA]] - ends) * [1, reach]
    impacts = int(done.notes[:, body.IMPACTS].sum())
    return Strayed(Fraction(float(np.median(away.max(axis=1)))), None, f"{impacts} impacts")
