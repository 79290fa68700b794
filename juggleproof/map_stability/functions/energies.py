"""Energies that a piece conserves, for maps that are affine in pieces: forms E with E(A g) = E(g)
for the linear part A of a piece, and g the gap to the point.

Where no piece raises E, states may still keep it for a step.  V = E + E(f) then falls by the loss
of the first of two steps and that of the second, as for an oscillator whose damping saturates.

Source: J. P. LaSalle, The Stability and Control of Discrete Processes (1986).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof, Search
from juggleproof.map_stability.functions.candidates import (
    Setting,
    lyapunov_candidates,
    symmetric,
)
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.premise_searches import proof_by_squares
from juggleproof.map_stability.terms import Expr, column, expression, symbols, written
from juggleproof.search.decrease_proofs.by_products import proof_by_products


def energy_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates that samples do not refute, those that fit best first, with searches for the
    premises that V falls, and by how much at least.
    """
    system = setting.system
    if setting.have or len(system.pieces) == 1 or not system.is_affine:
        return
    numbers = range(1, len(system.pieces) + 1)
    falls = [f"falls-{i}-{k}" for i, k in product(numbers, numbers)]
    searches: dict[str, Search] = dict.fromkeys(falls, proof_by_squares)
    searches["least"] = partial(
        proof_by_products,
        terms=range(len(system.pieces)),
        unknowns=(),
        squares=[f"{one}_gap" for one in system.state],
        signs=(),
    )
    for energy in energies(setting):
        every = lyapunov_candidates(setting, over_two_steps(setting, energy))
        for one in sorted(every, key=lambda one: one.rank)[: limits.TRIED_OF_FAMILY]:
            yield replace(one, searches=searches)


def energies(setting: Setting) -> Iterator[Expr]:
    """Yield the forms in the gaps that are positive at samples and that a piece conserves, if it
    conserves their multiples only.
    """
    seen: set[Expr] = set()
    gaps = symbols([f"{one}_gap" for one in setting.system.state])
    samples = setting.states.points
    form, unknowns = symmetric(len(gaps))
    for matrix in setting.system.derivatives:
        rows, _ = sympy.linear_eq_to_matrix(list(matrix.T * form * matrix - form), unknowns)
        kernel = rows.nullspace()
        if len(kernel) != 1:
            continue
        (vector,) = kernel
        found = form.subs(dict(zip(unknowns, vector * sympy.ilcm(1, *_divisors(vector)))))
        energy = sympy.expand((sympy.Matrix(gaps).T * found * sympy.Matrix(gaps))[0])
        at = column(written(energy), samples, len(setting.states.which))
        energy = energy if np.median(at) > 0 else -energy
        if ((at > 0).all() or (at < 0).all()) and energy not in seen:
            seen.add(energy)
            yield energy


def _divisors(vector: sympy.Matrix) -> list[Expr]:
    """The numbers that the entries divide by."""
    return [sympy.Rational(entry).q for entry in vector if entry.is_Rational]


def over_two_steps(setting: Setting, energy: Expr) -> Function:
    """The energy of a state and that of the next one, a term for each piece."""
    system = setting.system
    gaps = symbols([f"{one}_gap" for one in system.state])
    point = list(map(expression, setting.point.terms))
    here = {one: e + gap for one, e, gap in zip(symbols(system.state), point, gaps)}
    terms = []
    for images in system.images:
        after = [image.subs(here, simultaneous=True) - e for image, e in zip(images, point)]
        later = energy.subs(dict(zip(gaps, after)), simultaneous=True)
        terms.append(written(sympy.expand(energy + later)))
    return Function(tuple(terms), tuple(guard for guard, _ in system.pieces))
