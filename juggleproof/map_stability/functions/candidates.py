"""A point with a part of the domain and samples of both; and statements `lyapunov`, by which a
function proves that the point is stable and attracts, with their constants.

Everything here is in floats and believed by nobody: what it proposes is a statement of the checker,
for which certificates are then sought.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial

import numpy as np
import sympy

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof, Search
from juggleproof.map_stability.functions.templates import Function, squares_of
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.premise_searches import proof_by_signs
from juggleproof.map_stability.samples import (
    SEED,
    Arrays,
    Floats,
    SamplePoint,
    Samples,
    around,
    at_samples,
    region,
)
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    atoms,
    column,
    expression,
    holds,
    symbols,
    value,
    written,
)
from juggleproof.statements.cases import conjunction
from juggleproof.statements.language import MapRule

# -------------------------------------------------------------------------------------------------
# Constants that depend on the parameters: a number times powers of what is positive on the domain.


def positive_factors(system: Map, facts: str, parameters: Arrays) -> list[str]:
    """Return the terms that facts say to be positive, in the parameters and in the point's names;
    they are linear in the latter.
    """
    points = set(symbols([f"{name}_point" for name in system.state]))
    found = [
        written(numerator)
        for term, strict in atoms(facts)
        for numerator in [sympy.numer(sympy.together(term))]
        if strict and sympy.Poly(numerator, *points).total_degree() <= 1
    ]
    texts = []
    for text in dict.fromkeys(found):
        if not checker.names_in(text) <= parameters.keys():
            continue
        with np.errstate(all="ignore"):
            at = np.asarray(value(text, parameters), float)
        if at.min() > 0 and np.ptp(at) > 0:
            texts.append(text)
    return texts


def power_products(
    factors: Sequence[str],
    parameters: Arrays,
    size: int,
    allowed: Sequence[tuple[float, tuple[int, int]]] = limits.POWERS,
) -> list[tuple[str, Floats]]:
    """Return products of powers of the factors, the simplest first, as text and at the
    parameters.
    """
    values = [column(f, parameters, size) for f in factors]
    found = []
    limit, total_limit = next(both for most, both in allowed if len(factors) <= most)
    every = itertools.product(range(-limit, limit + 1), repeat=len(factors))
    few = (powers for powers in every if sum(map(abs, powers)) <= total_limit)
    for powers in sorted(few, key=lambda p: (sum(map(abs, p)), sum(p) < 0, p)):
        total = np.ones(size)
        for v, p in zip(values, powers):
            total = total * v**p
        above = "*".join(_power(f, p) for f, p in zip(factors, powers) if p > 0)
        below = "*".join(_power(f, -p) for f, p in zip(factors, powers) if p < 0)
        found.append((f"{above or 1}/({below})" if below else above or "1", total))
    return found


def _power(text: str, exponent: int) -> str:
    return as_factor(text) if exponent == 1 else f"{as_factor(text)}^{exponent}"


def bounded_below(
    least: Floats,
    products: Sequence[tuple[str, Floats]],
    most: int = limits.TRIED,
    share: float = limits.LEFT,
) -> list[tuple[float, str]]:
    """Return positive terms in the parameters that are at most this share of `least`.  Each comes
    with a rank; terms that follow `least` closely and are simple have a small rank and come first.
    """
    used = np.isfinite(least)
    if not used.any() or least[used].min() <= 0:
        return []
    ranked = []
    for text, values in products:
        with np.errstate(all="ignore"):
            shares = np.log(least[used] / values[used])
        if np.isfinite(shares).all() and shares.min() > np.log(limits.SMALLEST):
            worst = float(shares.min())
            rank = float(np.ptp(shares)) + len(text) / 16 + max(0.0, -worst) / 2
            ranked.append((rank, text, float(np.exp(worst))))
    found = []
    for rank, text, number in sorted(ranked)[:most]:
        constant = _floor(number * share)
        found.append((rank, text if constant == 1 else _times(constant, text)))
    return found


def _times(number: Fraction, text: str) -> str:
    """A number times a product of powers, as one quotient."""
    above, slash, below = text.partition("/")
    above = above if number.numerator == 1 else f"{number.numerator}*{above}"
    above = above.removesuffix("*1")
    if number.denominator == 1:
        return above + slash + below
    return f"{above}/({number.denominator}*{below})" if slash else f"{above}/{number.denominator}"


def _floor(number: float) -> Fraction:
    """A simple number below: 4 at most, a whole number or a power of 1/2."""
    if number >= 1:
        return Fraction(int(min(number, 4.0)))
    return Fraction(1, 2 ** int(np.ceil(-np.log2(number))))


@dataclass(frozen=True)
class Setting:
    """A map with the point in question, the domain on which something is sought, and samples."""

    system: Map
    point: SamplePoint
    piece: int  # that the point is in
    have: tuple[str, ...]  # what premises know of the point; nothing where its terms are simple
    domain: str
    parameters: Arrays
    states: Samples
    outer: str = ""  # the space of the map, where that of `system` is a part of it
    map: str = "map"  # the name of its statement

    @cached_property
    def count(self) -> int:
        """The number of samples of the parameters."""
        return len(next(iter(self.parameters.values()))) if self.parameters else 1

    @cached_property
    def constants(self) -> Arrays:
        """The samples of the parameters, with the roots and the point's names."""
        known = self.point.with_roots(self.parameters)
        values = zip(self.system.state, self.point.at(self.parameters))
        return known | {f"{name}_point": np.broadcast_to(v, (self.count,)) for name, v in values}

    @cached_property
    def point_names(self) -> list[Expr]:
        """The names of the point's coordinates."""
        return symbols([f"{name}_point" for name in self.system.state])

    @cached_property
    def derivative(self) -> Expr:
        """The derivative of the point's piece there, in the parameters, and in the point's names
        where premises know of it.
        """
        at = self.point_names if self.have else map(expression, self.point.terms)
        put = dict(zip(symbols(self.system.state), at))
        return self.system.derivatives[self.piece].subs(put, simultaneous=True)

    @cached_property
    def tests(self) -> Arrays:
        """States at more parameters, at which coefficients that fit `states` are tested."""
        parameters = region(self.domain, self.system.parameters, limits.TEST_PARAMETERS)
        return around(self.system, self.point, parameters, limits.TEST_STATES).points

    @cached_property
    def products(self) -> list[tuple[str, Floats]]:
        """Products of powers, among which constants are sought."""
        return self._products(limits.POWERS)

    @cached_property
    def higher_products(self) -> list[tuple[str, Floats]]:
        """Products of higher powers, for constants that are small at an end of the parameters."""
        return self._products(limits.HIGH_POWERS)

    def _products(
        self, allowed: Sequence[tuple[float, tuple[int, int]]]
    ) -> list[tuple[str, Floats]]:
        known = self.constants
        if not self.have:
            known = {k: v for k, v in known.items() if not k.endswith("_point")}
        facts = conjunction(self.domain, *self.have)
        factors = positive_factors(self.system, facts, known)
        return power_products(factors, known, self.count, allowed)

    @cached_property
    def head(self) -> list[str]:
        """The first lines of a statement on the point, in which the state's names stand for the
        point.
        """
        names = self.system.parameters
        return [
            *([f"forall {' '.join(names)}"] if names else []),
            f"range {self.domain}",
            *(f"root {name} = sqrt({under})" for name, under in self.point.roots),
            *(f"let {name} = {term}" for name, term in zip(self.system.state, self.point.terms)),
        ]

    def inside(self, space: str) -> Setting:
        """Return the setting of the same point for the map on this part of the space."""
        system = replace(self.system, space=space)
        states = around(system, self.point, self.parameters, limits.STATES)
        return replace(self, system=system, states=states, map="map-1")

    def rule(
        self,
        name: str,
        function: Function,
        rows: Sequence[tuple[str, str]],
        before: Sequence[tuple[str, str]] = (),
        after: Sequence[tuple[str, str]] = (),
    ) -> MapRule:
        """A statement `lyapunov` or `unstable`: the rows below its function, and those before and
        after its point.
        """
        return MapRule(
            name,
            (
                ("map", f"{self.system.name}/{self.map}"),
                ("domain", self.domain),
                *(("root", f"{root} = sqrt({under})") for root, under in self.point.roots),
                *before,
                ("point", ", ".join(self.point.terms)),
                *after,
                *(("have", line) for line in self.have),
                *function.lines(),
                *rows,
            ),
        )

    def descent(self, name: str, of: str, rank: str, *stages: str) -> MapRule:
        """The statement that every orbit of a map is in the last stage after `rank` steps."""
        rows = [("map", f"{self.system.name}/{of}"), ("domain", self.domain), ("rank", rank)]
        rows += [("stage", one) for one in stages]
        return MapRule(f"{self.system.name}/{name}", tuple(rows))

    def attraction(self, name: str, descent: str, within: str = "", radius: str = "") -> MapRule:
        """The statement that the point attracts the states of this descent.  The descent's last
        stage is the set of the statement `lyapunov`; or the statement `within` says that the point
        attracts that stage, which contains all states within the radius.
        """
        rows = [("descent", f"{self.system.name}/{descent}")]
        if within:
            rows += [("attraction", f"{self.system.name}/{within}"), ("radius", radius)]
        else:
            rows += [("lyapunov", f"{self.system.name}/lyapunov")]
        return MapRule(f"{self.system.name}/{name}", tuple(rows))

    def candidate(
        self,
        function: Function,
        loss: str,
        least: str,
        ball: tuple[str, str],
        on: str = "",
        rank: float = 0.0,
        searches: Mapping[str, Search] | None = None,
    ) -> CandidateProof:
        """Return the statement `lyapunov` that V falls by the loss on a set, or on the space.

        least: a bound of the loss by the distance; ball: the texts of `radius` and `upper`, with
        V <= upper |s - e| for all states with |s - e| <= radius.
        """
        radius, upper = ball
        rows = [("loss", loss), ("least", least), ("upper", upper), ("radius", radius)]
        before = [("on", on or self.system.space)]
        rule = self.rule(f"{self.system.name}/lyapunov", function, rows, before)
        return CandidateProof((rule,), searches or {}, rank)


def losses(
    setting: Setting,
    samples: Samples,
    shares: tuple[Floats, Floats],
    size: str,
    least: str,
    powers: Sequence[int] = (0,),
    products: Sequence[tuple[str, Floats]] | None = None,
    most: int = limits.TRIED,
    share: float = limits.LEFT,
) -> Iterator[tuple[float, str, str, str]]:
    """Yield losses c `size`/(1 + V)^p for each power p of 1 + V: a rank, the constant c, the loss,
    and what it is at least.

    shares: the part of `size` that V falls by at the samples, and 1 + V there.
    """
    fall, above = shares
    for power in powers:
        by = samples.least(fall * above**power, setting.count)
        over = {0: "", 1: "/(1 + {})"}.get(power, f"/(1 + {{}})^{power}")
        for rank, constant in bounded_below(by, products or setting.products, most, share):
            start = "" if constant == "1" else f"{as_factor(constant)}*"
            loss = start + size + over.format("value")
            yield rank + power / 4, constant, loss, start + least + over.format("level")


def lyapunov_candidates(setting: Setting, function: Function) -> Iterator[CandidateProof]:
    """The candidates for this V whose loss is a constant times the sum of the squares of the
    distances, or of their fourth powers, divided by a power of 1 + V.
    """
    names, samples = setting.system.state, setting.states
    here, there = function.along(setting.system, samples.points, len(samples.which))
    square = np.sum([samples.points[f"{name}_gap"] ** 2 for name in names], axis=0)
    fits = np.isfinite(here) & np.isfinite(there) & (square > 1e-12)
    samples, here, there = samples.where(fits), here[fits], there[fits]
    ball = next(small_balls(setting, function), None)
    if ball is None:
        return
    for order in limits.ORDERS:
        size = np.sum([samples.points[f"{name}_gap"] ** order for name in names], axis=0)
        total = " + ".join(f"{name}_gap^{order}" for name in names)
        total, shares = (
            total if len(names) == 1 else f"({total})",
            ((here - there) / size, 1 + here),
        )
        for rank, _, loss, least in losses(
            setting, samples, shares, total, f"distance^{order}", limits.LOSS_POWERS
        ):
            yield setting.candidate(function, loss, least, ball, rank=rank + order - 2)


def derivatives(setting: Setting) -> Floats:
    """The derivative of the point's piece there, for each of the parameters, (count, n, n)."""
    at = dict(zip(symbols(setting.system.state), setting.point_names))
    matrix = setting.system.derivatives[setting.piece].subs(at, simultaneous=True)
    return at_samples(matrix, setting.constants, setting.count)


def symmetric(size: int) -> tuple[Expr, list[Expr]]:
    """A symmetric matrix of unknowns, and a list of these unknowns."""
    entry = [[sympy.Symbol(f"p_{min(i, j)}{max(i, j)}") for j in range(size)] for i in range(size)]
    return sympy.Matrix(entry), sorted({one for row in entry for one in row}, key=str)


def lyapunov_form(setting: Setting) -> tuple[str, str] | None:
    """The form V and the term D > 0 with V(A g) - V(g) = -D |g|^2 for the derivative A at the point
    (the discrete Lyapunov equation), in the parameters; None if they are not found.
    """
    system = setting.system
    n, matrix = len(system.state), system.derivatives[setting.piece]
    moving = not matrix.free_symbols.isdisjoint(symbols(system.state))
    if n > limits.MOST_STATES or moving and setting.have and len(system.pieces) > 1:
        return None
    (form, unknowns), matrix = symmetric(n), setting.derivative
    equations = list(matrix.T * form * matrix - form + sympy.eye(n))
    solutions = sympy.solve(equations, unknowns, dict=True)
    if not solutions:
        return None
    found = [sympy.together(solutions[0].get(one, 0)) for one in unknowns]
    divisor = sympy.lcm([sympy.fraction(one)[1] for one in found])
    known = setting.constants
    with np.errstate(all="ignore"):
        signs = np.sign(np.asarray(value(written(divisor), known), float))
    if (signs < 0).all():
        divisor = -divisor
    elif not (signs > 0).all():
        return None
    values = dict(zip(unknowns, found))
    gaps = symbols([f"{one}_gap" for one in system.state])
    total = sum(
        sympy.factor(sympy.cancel(values[form[i, j]] * divisor)) * gaps[i] * gaps[j]
        for i in range(n)
        for j in range(n)
    )
    return written(total), written(sympy.factor(divisor))


def equation_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates whose V solves the discrete Lyapunov equation at the point."""
    found = lyapunov_form(setting)
    if found is None:
        return
    function, loss = Function(found[:1]), found[1]
    samples = setting.states
    here, there = function.along(setting.system, samples.points, len(samples.which))
    if (there > here * (1 + 1e-9) + 1e-9).any():
        return
    squares = " + ".join(squares_of(setting.system))
    least, by_sign = f"({loss})*distance^2", partial(proof_by_signs, signs=found[:1])
    for ball in itertools.islice(small_balls(setting, function), limits.TRIED):
        drop, searches = f"({loss})*({squares})", {"bounded": by_sign}
        yield setting.candidate(function, drop, least, ball, searches=searches)


def small_balls(setting: Setting, function: Function) -> Iterator[tuple[str, str]]:
    """Terms `radius` and `upper` with V <= upper |s - e| where |s - e| <= radius, at samples."""
    rng = np.random.default_rng(SEED)
    which = np.repeat(np.arange(setting.count), limits.STATES_MANY)
    known = setting.constants
    points = {name: values[which] for name, values in known.items()}
    middle = [
        np.broadcast_to(e, (setting.count,))[which] for e in setting.point.at(setting.parameters)
    ]
    direction = rng.uniform(-1, 1, (len(middle), len(which)))
    direction /= np.abs(direction).max(axis=0)
    reach = np.where(rng.random(len(which)) < 0.5, 1.0, rng.random(len(which)))
    candidates = ["1"] if function.divisor == "1" else []
    if function.divisor != "1":
        candidates += [f"({e})/2" for e in setting.point.terms]
    if setting.outer:  # the distances to the bounds that this part of the space adds
        names = [f"{one}_point" for one in setting.system.state]
        put = dict(zip(symbols(setting.system.state), symbols(names)))
        given = atoms(setting.outer)
        added = [one for one in atoms(setting.system.space) if one not in given]
        candidates += [written(bound.subs(put)) for bound, _ in added]
    candidates += [text for text, _ in setting.products[:8] if text != "1"]
    for radius in candidates:
        with np.errstate(all="ignore"):
            size = column(radius, known, setting.count)
            if not (size > 0).all():
                continue
            states = dict(points)
            for name, e, d in zip(setting.system.state, middle, direction):
                states |= {name: e + size[which] * reach * d, name + "_point": e}
                states[name + "_gap"] = size[which] * reach * d
            space = setting.system.space
            inside = np.broadcast_to(holds(setting.outer or space, states), (len(which),))
            if setting.outer and not np.all(holds(space, states)[inside]):
                continue
            v = function.at(states, len(which))[inside]
        if not np.isfinite(v).all() or (v < -1e-12).any():
            continue
        shares = (size[which] * reach)[inside] / np.maximum(v, 1e-12)
        least = Samples({}, which[inside]).least(shares, setting.count)
        number = str(1 / _floor(float(least.min()) / 2)) if least.min() > limits.SMALLEST else ""
        if number and np.ptp(np.log(least[np.isfinite(least)])) < limits.FEW_FOLD:
            yield radius, number
        for _, under in bounded_below(least, setting.products, 1):
            yield radius, inverse(under)
        if number:
            yield radius, number


def inverse(text: str) -> str:
    """1 over a quotient."""
    above, _, below = text.partition("/")
    below = below.removeprefix("(").removesuffix(")") if below.count("(") == 1 else below
    return below if above == "1" and below else f"{below or 1}/({above})"
