"""Why a point does not attract every state, or is not stable: a periodic orbit in exact terms, or a
function that grows near the point.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

import numpy as np
import sympy

from juggleproof.certificates.language import MapRule, bounds_of
from juggleproof.proofs.stability.given import Map, expression, holds, symbols
from juggleproof.proofs.stability.points import as_point
from juggleproof.proofs.stability.samples import Arrays, Point, after, orbit_ends
from juggleproof.proofs.stability.values import Setting, bounded_below

LONGEST = 6  # period that is looked for
SETTLE, STRAY = 400, 1e-3  # steps before an orbit is looked at, and what is no convergence
MOST_WORDS = 4


def words_of_stray_orbits(setting: Setting) -> list[tuple[int, ...]]:
    """The words of pieces of periodic orbits that orbits of samples tend to, the most frequent
    first.
    """
    system, states = setting.system, setting.states.points
    with np.errstate(all="ignore"):
        away = (orbit_ends(system, states, SETTLE) > STRAY).nonzero()[0][:200]
        now = {name: values[away] for name, values in states.items()}
        for _ in range(SETTLE):
            now = after(system, now)
    count: dict[tuple[int, ...], int] = {}
    for k in range(len(away)):
        word = _word(system, {name: values[k : k + 1] for name, values in now.items()})
        if word:
            count[word] = count.get(word, 0) + 1
    return sorted(count, key=lambda word: (-count[word], word))[:MOST_WORDS]


def _word(system: Map, state: Arrays) -> tuple[int, ...]:
    """The pieces along the orbit until it is back; empty where it is not."""
    start = np.array([state[name][0] for name in system.state])
    word: list[int] = []
    with np.errstate(all="ignore"):
        for _ in range(LONGEST):
            here = [k for k, (guard, _) in enumerate(system.pieces) if np.all(holds(guard, state))]
            if not here:
                return ()
            word.append(here[0])
            state = after(system, state)
            now = np.array([state[name][0] for name in system.state])
            if np.allclose(now, start, rtol=1e-6, atol=1e-9):
                return tuple(word)
    return ()


def periodic_points(
    system: Map, word: Sequence[int], known: Mapping[str, Fraction]
) -> Iterator[Point]:
    """The states that come back along a word of pieces, in exact terms, where some parameters are
    known; of those that are free one is 1.
    """
    numbers = [*zip(symbols([*known]), map(sympy.Rational, known.values()))]
    state = symbols(system.state)
    images: list[sympy.Expr] = list(state)
    for k in word:
        values = dict(zip(state, images))
        images = [sympy.together(i.subs(values, simultaneous=True)) for i in system.images[k]]
    images = [sympy.together(image.subs(numbers)) for image in images]
    try:
        equations = [sympy.numer(sympy.together(i - s)) for i, s in zip(images, state)]
        solutions = sympy.solve(equations, state, dict=True) if any(equations) else [{}]
    except NotImplementedError:
        return
    for solution in solutions:
        free = dict.fromkeys(state, 1)
        point = as_point(tuple(sympy.simplify(solution.get(s, s)).subs(free) for s in state))
        if point is not None:
            yield point


def escape_rules(setting: Setting, name: str) -> Iterator[MapRule]:
    """Statements `escapes` for the periodic orbits that samples tend to, and for other fixed
    points.
    """
    system = setting.system
    words = words_of_stray_orbits(setting)
    ends = {name: bounds_of(setting.domain, name) or (None, None) for name in system.parameters}
    known = {
        name: Fraction(low[0]) for name, (low, high) in ends.items() if low and high and low == high
    }
    for word in [*words, *((k,) for k in range(len(system.pieces)) if (k,) not in words)]:
        for start in periodic_points(system, word, known):
            if start.terms == setting.point.terms or not _stays(setting, start, word):
                continue
            roots = dict([*setting.point.roots, *start.roots])
            if len(roots) < len({*setting.point.roots, *start.roots}):
                continue  # one name for two roots
            yield MapRule(
                name,
                (
                    ("map", name.rpartition("/")[0] + "/map"),
                    ("domain", setting.domain),
                    *(("root", f"{root} = sqrt({under})") for root, under in roots.items()),
                    ("point", ", ".join(setting.point.terms)),
                    ("start", ", ".join(start.terms)),
                    ("word", " ".join(str(k + 1) for k in word)),
                ),
            )


def _stays(setting: Setting, start: Point, word: Sequence[int]) -> bool:
    """Whether at all samples of the parameters the orbit is one of the map, and not the point."""
    system = setting.system
    with np.errstate(all="ignore"):
        state = dict(start.with_roots(setting.parameters))
        values = start.at(setting.parameters)
        if not all(np.isfinite(v).all() for v in values):
            return False
        fixed = setting.point.at(setting.parameters)
        if not np.any([np.abs(v - e) > 1e-9 for v, e in zip(values, fixed)], axis=0).all():
            return False
        state |= {n: np.broadcast_to(v, (setting.count,)) for n, v in zip(system.state, values)}
        for k in word:
            guard, images = system.pieces[k]
            if not np.all(holds(system.space, state)) or not np.all(holds(guard, state)):
                return False
            state |= dict(zip(system.state, system.next({n: state[n] for n in system.names})))
    return True


# -------------------------------------------------------------------------------------------------
# One state variable, and a multiplier beyond -1 or 1: the square of the distance grows.


def instability_rules(setting: Setting, name: str) -> Iterator[MapRule]:
    """Statements `unstable` for maps of one variable whose multiplier is beyond 1 in size."""
    system = setting.system
    if len(system.state) != 1:
        return
    (state,) = symbols(system.state)
    slope = sympy.diff(system.images[setting.piece][0], state)
    at = slope.subs(state, expression(setting.point.terms[0]))
    gap = f"{system.state[0]}_gap"
    known = setting.point.with_roots(setting.parameters)
    squared = sympy.lambdify(symbols(known), at, "numpy")(*known.values())
    with np.errstate(all="ignore"):
        excess = np.broadcast_to(np.asarray(squared, float) ** 2 - 1, (setting.count,)) / 2
    for side in ("+", "-"):
        for _, more in bounded_below(excess, setting.products):
            for radius in _radii(setting):
                yield MapRule(
                    name,
                    (
                        ("map", name.rpartition("/")[0] + "/map"),
                        ("domain", setting.domain),
                        *(("root", f"{r} = sqrt({under})") for r, under in setting.point.roots),
                        ("point", setting.point.terms[0]),
                        ("direction", f"{system.state[0]}_point {side} distance"),
                        *(("have", line) for line in setting.have),
                        ("value", f"{gap}^2"),
                        ("rate", f"1 + {more}"),
                        ("radius", radius),
                        ("upper", f"({radius})^2"),
                    ),
                )


def _radii(setting: Setting) -> list[str]:
    return ["1", "1/4", "1/16", *(text for text, _ in setting.products[1:4])]
