"""Why a point does not attract every state, or is not stable: a periodic orbit in exact terms, or a
function that grows near the point.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from math import prod

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.functions.candidates import Setting, bounded_below
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points import as_point, solutions
from juggleproof.map_stability.samples import (
    Arrays,
    Floats,
    SamplePoint,
    after,
    licence,
    matrices_of,
    orbit_ends,
    strays,
    with_point_licences,
    without_equations,
)
from juggleproof.map_stability.terms import Expr, column, expression, holds, symbols
from juggleproof.statements.cases import conjunction
from juggleproof.statements.language import MapRule


def words_of_stray_orbits(setting: Setting) -> list[tuple[int, ...]]:
    """The words of pieces of periodic orbits that orbits of samples tend to, the most frequent
    first.
    """
    system = setting.system
    ends = orbit_ends(system, setting.states.points, limits.SETTLE)
    away = strays(system, ends, limits.STRAY).nonzero()[0][: limits.MOST_ORBITS]
    count = Counter(_words_back(system, {name: values[away] for name, values in ends.items()}))
    return sorted(count, key=lambda word: (-count[word], word))[: limits.MOST_WORDS]


def _words_back(system: Map, states: Arrays) -> Iterator[tuple[int, ...]]:
    """Yield the pieces along the orbit of each state until it comes back, if it does."""
    start, letters = np.stack([states[name] for name in system.state]), []
    open_ = np.full(start.shape[1], True)
    with np.errstate(all="ignore"):
        for _ in range(limits.MOST_PERIOD):
            letters.append(np.argmax([*system.applying(states)], axis=0))
            states = after(system, states)
            now = np.stack([states[name] for name in system.state])
            back = open_ & np.isclose(now, start, rtol=1e-6, atol=1e-9).all(axis=0)
            yield from map(tuple, np.stack(letters)[:, back].T.tolist())
            open_ &= ~back


def affine_words(setting: Setting) -> Iterator[tuple[int, ...]]:
    """Yield words of affine pieces along which exactly one periodic orbit, stable or not, is an
    orbit of the map at all samples of the parameters.  Short words come first; the rotations of a
    word are left out.
    """
    system, count = setting.system, setting.count
    pieces, n = range(len(system.pieces)), len(system.state)
    stacked = matrices_of(system, setting.parameters, count).reshape(len(pieces), count, n, n)
    known = setting.point.with_roots(setting.parameters)
    origin = {**known, **{name: np.zeros(count) for name in system.state}}
    shifts = [
        np.stack([column(i, origin, count) for i in images], 1) for _, images in system.pieces
    ]
    for word in itertools.islice(_words(len(pieces)), limits.MOST_AFFINE_WORDS):
        matrix, shift = np.broadcast_to(np.eye(n), (count, n, n)), np.zeros((count, n))
        for k in word:
            matrix = stacked[k] @ matrix
            shift = np.einsum("kij,kj->ki", stacked[k], shift) + shifts[k]
        left = np.eye(n) - matrix
        if (np.abs(np.linalg.det(left)) > limits.ROUNDING).all():
            start = np.linalg.solve(left, shift[:, :, None])[:, :, 0]
            if _stays(setting, list(start.T), known, word):
                yield word


def _words(pieces: int) -> Iterator[tuple[int, ...]]:
    """Yield the words that come before all of their rotations, in order of length."""
    for length in range(1, limits.MOST_PERIOD + 1):
        for word in itertools.product(range(pieces), repeat=length):
            if all(word < word[k:] + word[:k] for k in range(1, length)):
                yield word


def periodic_points(setting: Setting, word: Sequence[int]) -> Iterator[list[SamplePoint]]:
    """Yield lists of states that come back along a word of pieces, in exact terms: an isolated
    state is alone in its list; a continuum has a list of several.
    """
    state = symbols(setting.system.state)
    _, fixed = without_equations(setting.domain, setting.system.parameters)
    linear = [(*symbols([name]), gap) for name, gap in fixed.items()]
    put = {x: -gap.coeff(x, 0) / gap.coeff(x, 1) for x, gap in linear if sympy.degree(gap, x) == 1}
    images: list[sympy.Expr] = list(state)
    for k in word:
        values = dict(zip(state, images))
        pieces = [i.subs(put) for i in setting.system.images[k]]
        images = [sympy.together(i.subs(values, simultaneous=True)) for i in pieces]
        equations = [sympy.numer(sympy.together(i - s)) for i, s in zip(images, state)]
        equations = [one for one in map(sympy.expand, equations) if one != 0]
        degrees = [sympy.Poly(one, *state).total_degree() for one in equations]
        size = sum(len(sympy.Add.make_args(one)) for one in equations)
        if prod(degrees) > limits.MOST_SOLUTIONS or len(state) > 1 and size > limits.MOST_TERMS:
            return
    for terms in solutions(equations, state):
        points = map(as_point, terms)
        yield [point for point in points if point is not None]


def short_words(setting: Setting) -> Iterator[tuple[int, ...]]:
    """Return the words of short periodic orbits, stable or not: for affine pieces the words with
    one orbit, for others in one variable all pairs.
    """
    system = setting.system
    if system.is_affine:
        return affine_words(setting)
    pieces = range(len(system.pieces)) if len(system.state) == 1 else ()
    return itertools.combinations_with_replacement(pieces, 2)


def escape_rules(
    setting: Setting, name: str, words: Iterable[tuple[int, ...]]
) -> Iterator[MapRule]:
    """Statements `escapes` for periodic orbits along these words."""
    system = setting.system
    for word in itertools.islice(words, limits.MOST_WORDS_SOLVED):
        for every in periodic_points(setting, word):
            start = next((one for one in every if _is_escape(setting, one, word)), None)
            if start is None:
                continue
            roots = dict([*setting.point.roots, *start.roots])
            if len(roots) < len({*setting.point.roots, *start.roots}):
                continue  # one name for two roots
            domain = with_point_licences(setting.domain, start)
            for divisor in divisors_along(system, start, word):
                domain = conjunction(domain, licence(divisor, domain))
            yield MapRule(
                name,
                (
                    ("map", f"{system.name}/map"),
                    ("domain", domain),
                    *(("root", f"{root} = sqrt({under})") for root, under in roots.items()),
                    ("point", ", ".join(setting.point.terms)),
                    ("start", ", ".join(start.terms)),
                    ("word", " ".join(str(k + 1) for k in word)),
                ),
            )


def divisors_along(system: Map, start: SamplePoint, word: Sequence[int]) -> Iterator[Expr]:
    """Yield what the images along the word divide by, in the parameters.  For a start with a root
    there is nothing, since a domain cannot name the root.
    """
    state, here = symbols(system.state), [expression(term) for term in start.terms]
    for k in () if start.roots else word:
        put = dict(zip(state, here))
        for image in system.images[k]:
            below = sympy.fraction(sympy.together(image))[1].subs(put, simultaneous=True)
            above = sympy.fraction(sympy.together(below))[0]
            yield from (one for one, _ in sympy.factor_list(above)[1] if one.free_symbols)
        here = [sympy.cancel(image.subs(put, simultaneous=True)) for image in system.images[k]]


def _is_escape(setting: Setting, start: SamplePoint, word: Sequence[int]) -> bool:
    """Return whether at all samples of the parameters the orbit is one of the map, and not the
    point.
    """
    known = start.with_roots(setting.parameters)
    with np.errstate(all="ignore"):
        return _stays(setting, start.at(setting.parameters), known, word)


def _stays(setting: Setting, start: list[Floats], known: Arrays, word: Sequence[int]) -> bool:
    """Return whether the orbit of states in floats, (count,) a variable, is one of the map, and not
    the point.
    """
    system = setting.system
    with np.errstate(all="ignore"):
        if not all(np.isfinite(v).all() for v in start):
            return False
        fixed = setting.point.at(setting.parameters)
        if not np.any([np.abs(v - e) > 1e-9 for v, e in zip(start, fixed)], axis=0).all():
            return False
        state = {n: np.broadcast_to(v, (setting.count,)) for n, v in zip(system.state, start)}
        state = {**known, **state}
        for k in word:
            guard, _ = system.pieces[k]
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
            for radius in filter(grows(setting, more), _radii(setting, more)):
                rows = [("rate", f"1 + {more}"), ("radius", radius), ("upper", f"({radius})^2")]
                direction = [("direction", f"{system.state[0]}_point {side} distance")]
                yield setting.rule(name, Function((f"{gap}^2",)), rows, after=direction)


def _radii(setting: Setting, more: str) -> list[str]:
    return [
        "1",
        "1/4",
        "1/16",
        *(text for text, _ in setting.products[1:4]),
        f"({more})/4",
        f"({more})/16",
    ]


def grows(setting: Setting, more: str) -> Callable[[str], bool]:
    """Return whether the square of the distance grows by more than 1 + more at samples, up to a
    radius.
    """
    system, known = setting.system, setting.constants
    (state,) = system.state
    faster = column(more, known, setting.count)
    digits = np.finfo(float).eps * np.abs(known[f"{state}_point"])

    def fits(radius: str) -> bool:
        reach = column(radius, known, setting.count)
        for share in limits.GROWTH_SHARES:
            gap = share * reach
            points = known | {state: known[f"{state}_point"] + gap}
            inside = np.broadcast_to(holds(system.space, points), gap.shape)
            points |= {f"{state}_gap": gap}
            with np.errstate(all="ignore"):
                less = after(system, points)[f"{state}_gap"] ** 2 < (1 + faster) * gap**2
            # rounding hides the growth of smaller distances
            if (less & inside & (digits < limits.GROWTH_ROUNDING * faster * np.abs(gap))).any():
                return False
        return True

    return fits
