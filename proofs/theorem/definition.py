"""The definition of the theorem: the map in normal form, what is chosen to prove it, and the
statements under the checker's map rules that come of it.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Union

from juggleproof.papers.derivations import tidied, where_positive
from juggleproof.proofs.paper.names import (
    H,
    Placed,
    alpha,
    always,
    at,
    b,
    claim,
    derived_vector,
    g,
    r,
    w,
    x,
)
from juggleproof.reading.values import Vector
from juggleproof.statements.language import (
    ClaimError,
    Formula,
    MapRule,
    Number,
    Statement,
    Term,
    conjunction,
    real,
    reals,
    substitute,
    term,
)


def opposite(strict: Formula) -> Formula:
    """The other side of a strict inequality.

    >>> from juggleproof.statements.language import reals
    >>> x, w = reals("x w")
    >>> str(opposite(x < w))
    'w <= x'
    """
    if strict.op != "<":
        raise ClaimError(f"{strict} is not one strict inequality")
    left, right = strict.sides
    return right <= left


# -------------------------------------------------------------------------------------------------
# The map in normal form, and what is chosen to prove the theorem about it: rank, stages and
# contraction.
#
# x is the height in units of r T, w = 1 - v/r the closing speed in units of r. Map, fixed points
# and energies are derived; rank, stages, weights, rates and radii are choices that the premises of
# the checker's rules have to confirm.

u, e_x, e_w = reals("u e_x e_w")
WHOLE = (
    (alpha > 0) & (alpha < 1) & (1 - alpha > 0) & (1 + alpha > 0)
)  # the last two are there for what is divided by
BELOW_A_THIRD = (alpha > 0) & (3 * alpha < 1) & (1 + alpha > 0)
FROM_A_THIRD = (3 * alpha >= 1) & (alpha < 1) & (1 + alpha > 0)

SPACE = term(0) <= x
IMPACT = where_positive("normal_margin")  # inequality (7)
PIECES = ((IMPACT, tidied("normal_f1")), (opposite(IMPACT), tidied("normal_f2")))
FIXED: Vector = tidied("normal_e_1")
OTHER: Vector = tidied(
    "normal_e_2"
)  # the orbit of e_2 at its impact: an impact, a flight, and it is back


@dataclass(frozen=True)
class Descent:
    """A rank that falls by 1 at least outside of all stages, roots that it is written with, and
    stages, the last being the trap.
    """

    rank: Term
    stages: tuple[Formula, ...]
    roots: tuple[tuple[str, Term], ...] = ()


@dataclass(frozen=True)
class Contraction:
    """A set that is mapped into itself and brought closer to the fixed point, in the weighted sup
    norm, by the rate.
    """

    on: Formula
    weights: tuple[Term, Term]
    rate: Term
    radius: Term
    size: Term


def near(*distances: Term) -> Formula:
    """Each component differs from that of the fixed point, (e_x, e_w), by no more than its
    distance.
    """
    pairs = zip((x, w), (e_x, e_w), distances)
    return conjunction(
        [
            part
            for name, entry, most in pairs
            for part in (name - entry <= most, entry - name <= most)
        ]
    )


def at_the_point(formula: Formula) -> Formula:
    """The formula with the fixed point put in for its names."""
    put_in: Formula = substitute(formula, dict(zip(("e_x", "e_w"), map(term, FIXED.entries))))
    return put_in


SPEED = ("u", 4 * x + (w - 1) ** 2)  # u^2 is twice the energy in units of r^2
TRAP = conjunction([SPACE, IMPACT, alpha * w < 1])
NEAR_IN_TRAP = TRAP & near(term(1), term(1))
CORE = at_the_point(NEAR_IN_TRAP)
# An impact with w < 6 leads to x + w <= 2, that to the trap, and one step more to within 1 of the
# fixed point.
TO_THE_POINT = Descent(
    2 * u + (1 - w) / 2, (IMPACT & (w < 6), (term(0) < w) & (x + w <= 2), TRAP, CORE), (SPEED,)
)
IN_THE_TRAP = Contraction(CORE, (term(1), term(1)), 2 * alpha, term(1) / 2, term(1))

# Near e_1 the map contracts this norm for every 0 < alpha < 1.
WEIGHTS, RADIUS = (2 * alpha / (1 - alpha), term(1)), (1 - alpha) / (1 + alpha) ** 2
NEARBY = Contraction(
    at_the_point(near(*(RADIUS * weight for weight in WEIGHTS))),
    WEIGHTS,
    (1 + alpha) / 2,
    RADIUS,
    RADIUS,
)


# -------------------------------------------------------------------------------------------------
# Terms and formulas at exact rational points, and exact comparison of integers with numbers that
# have square roots in them.

Point = Mapping[str, Fraction]
_ARITHMETIC: dict[str, Callable[..., Fraction]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "neg": operator.neg,
    "^": operator.pow,
}
_RELATIONS: dict[str, Callable[..., bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}


def value_of(expression: Term, point: Point) -> Fraction:
    """The value of a term where its variables have these values.

    >>> from juggleproof.statements.language import reals
    >>> x, w = reals("x w")
    >>> value_of((x - w**2) / 3, {"x": Fraction(1), "w": Fraction(1, 2)})
    Fraction(1, 4)
    """
    if expression.op == "num":
        return expression.value
    if expression.op == "var":
        if expression.name not in point:
            raise ClaimError(f"{expression.name} has no value here")
        return point[expression.name]
    parts = [value_of(part, point) if isinstance(part, Term) else part for part in expression.args]
    return Fraction(_ARITHMETIC[expression.op](*parts))


def holds_at(formula: Formula, point: Point) -> bool:
    """Whether a formula of `and`, `or` and `not` over relations holds where its variables have
    these values.
    """
    if formula.op in _RELATIONS:
        return _RELATIONS[formula.op](*(value_of(side, point) for side in formula.sides))
    parts = (holds_at(part, point) for part in formula.parts)
    if formula.op in ("and", "or"):
        return all(parts) if formula.op == "and" else any(parts)
    if formula.op == "not":
        return not next(parts)
    raise ClaimError(f"{formula} cannot be decided at a point")


def linear_in(expression: Term, name: str, point: Point) -> tuple[Fraction, Fraction]:
    """(constant, slope) of a term that is linear in the named variable, at a point of its other
    variables.
    """
    values = [value_of(expression, {**point, name: Fraction(k)}) for k in range(3)]
    if values[2] - values[1] != values[1] - values[0]:
        raise ClaimError(f"{expression} is not linear in {name}")
    return values[0], values[1] - values[0]


def sign_with_root(p: Fraction, q: Fraction, square: Fraction) -> int:
    """The sign of p + q sqrt(square).

    >>> triples = (1, -1, 2), (2, -1, 2), (2, -1, 4)
    >>> [sign_with_root(*map(Fraction, triple)) for triple in triples]
    [-1, 1, 0]
    """
    of_p, of_q = (p > 0) - (p < 0), ((q > 0) - (q < 0)) * (square > 0)
    if of_p * of_q >= 0:
        return of_p or of_q
    return of_p * ((p * p > q * q * square) - (p * p < q * q * square))


def least_integer(enough: Callable[[int], bool], start: int = 0) -> int:
    """The least integer from `start` on for which `enough` holds, which stays true from there
    on.
    """
    if enough(start):
        return start
    width = 1
    while not enough(start + width):
        width *= 2
    low, high = start + width // 2, start + width  # not enough at low, enough at high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high


def ceiling(constant: Fraction, factor: Fraction, square: Fraction) -> int:
    """The least integer that is not below constant + factor sqrt(square), for factor >= 0.

    >>> ceiling(Fraction(0), Fraction(2), Fraction(2))
    3
    >>> ceiling(Fraction(1, 2), Fraction(1), Fraction(9, 4))
    2
    """
    low = (constant.numerator // constant.denominator) + isqrt(factor**2 * square // 1)
    return least_integer(lambda n: sign_with_root(n - constant, -factor, square) >= 0, low)


# -------------------------------------------------------------------------------------------------
# Statements under the checker's map rules, written from the definition, in normal form or in the
# paper's units.


@dataclass(frozen=True)
class TheoremSetting:
    """The map in some coordinates: parameters, which of them are integers, state, pieces and fixed
    points, and what the x, w and units of the normal form are in them.
    """

    parameters: tuple[Term, ...]
    positive: tuple[Formula, ...]
    state: tuple[Term, ...]
    space: Formula
    pieces: tuple[tuple[Formula, Vector], ...]
    fixed: Vector
    other: Vector
    place: Vector
    units: tuple[Number, Number]
    integers: tuple[Term, ...] = ()

    def here(self, thing: Placed) -> Placed:
        """A term or formula of the normal form in these coordinates."""
        return at(thing, dict(zip(("x", "w"), (term(entry) for entry in self.place))))

    def domain(self, of_alpha: Formula) -> str:
        """The range of alpha with what is assumed of the other parameters."""
        for formula in self.positive:
            of_alpha = of_alpha & formula
        return str(of_alpha)


NORMAL = TheoremSetting((alpha,), (), (x, w), SPACE, PIECES, FIXED, OTHER, Vector((x, w)), (1, 1))
STRIKES_HERE = where_positive("collision_margin")
PHYSICAL = TheoremSetting(
    parameters=(alpha, r, g),
    positive=(r > 0, g > 0),
    state=(term(b.component(1)), term(b.component(2))),
    space=H(b),
    pieces=((STRIKES_HERE, tidied("f1")), (opposite(STRIKES_HERE), tidied("f2"))),
    fixed=tidied("e_1"),
    other=tidied("impact_fixed_point", K=2),
    place=derived_vector("scaling"),
    units=(2 * r**2 / g, r),
)


def spaced(items: Iterable[object]) -> str:
    return " ".join(map(str, items))


def listed(items: Iterable[object]) -> str:
    return ", ".join(map(str, items))


def the_map(name: str, setting: TheoremSetting, of_alpha: Formula = WHOLE) -> MapRule:
    """f maps the space into itself, by one of its pieces at each state."""
    pieces = [("piece", f"{guard} -> {listed(images)}") for guard, images in setting.pieces]
    return MapRule(
        name,
        (
            ("over", spaced(setting.parameters)),
            *((("integer", spaced(setting.integers)),) if setting.integers else ()),
            ("domain", setting.domain(of_alpha)),
            ("state", spaced(setting.state)),
            ("space", str(setting.space)),
            *pieces,
        ),
        _terms(setting.space, setting.pieces),
    )


def _roots(roots: Sequence[tuple[str, Term]], setting: TheoremSetting) -> list[tuple[str, Term]]:
    return [(name, setting.here(under)) for name, under in roots]


Nested = Union[Term, Formula, Vector, Sequence["Nested"]]


def _terms(*things: Nested) -> tuple[Term | Formula, ...]:
    """The terms and formulas in these things, and in vectors and sequences of such."""
    found: list[Term | Formula] = []
    for thing in things:
        if isinstance(thing, (Term, Formula)):
            found.append(thing)
        else:
            found += map(term, thing) if isinstance(thing, Vector) else _terms(*thing)
    return tuple(found)


def descends(
    name: str,
    of: str,
    setting: TheoremSetting,
    of_alpha: Formula,
    descent: Descent,
    lemmas: Sequence[Formula] = (),
    piece: int = 1,
) -> MapRule:
    """Every orbit is led to the last stage by the fall of the rank, by lemmas for impacts, which
    are this piece.
    """
    stages = [setting.here(stage) for stage in descent.stages]
    rank, roots = setting.here(descent.rank), _roots(descent.roots, setting)
    return MapRule(
        name,
        (
            ("map", of),
            ("domain", setting.domain(of_alpha)),
            *(("root", f"{name} = sqrt({under})") for name, under in roots),
            ("rank", str(rank)),
            *(("stage", str(stage)) for stage in stages),
            *(("lemma", f"falls-{piece}: {setting.here(lemma)}") for lemma in lemmas),
        ),
        _terms([under for _, under in roots], rank, stages),
    )


def contracts(
    name: str, of: str, setting: TheoremSetting, of_alpha: Formula, contraction: Contraction
) -> MapRule:
    """The set is mapped into itself and brought closer to the fixed point."""
    weights = [
        unit if weight == term(1) else weight if unit == 1 else weight * unit
        for weight, unit in zip(contraction.weights, setting.units)
    ]
    on = setting.here(contraction.on)
    return MapRule(
        name,
        (
            ("map", of),
            ("domain", setting.domain(of_alpha)),
            ("on", str(on)),
            ("point", listed(setting.fixed)),
            ("weights", listed(weights)),
            ("rate", str(contraction.rate)),
            ("radius", str(contraction.radius)),
            ("size", str(contraction.size)),
        ),
        _terms(on, setting.fixed, [*map(term, weights)]),
    )


def attracts(name: str, descent: str, contraction: str) -> MapRule:
    """The fixed point is stable, and attracts every orbit."""
    return MapRule(name, (("descent", descent), ("contraction", contraction)))


def escapes(
    name: str, of: str, setting: TheoremSetting, of_alpha: Formula, word: str = "1 2"
) -> MapRule:
    """The other orbit, by default that of e_2, an impact and a flight by turns, does not tend to
    the fixed point.
    """
    return MapRule(
        name,
        (
            ("map", of),
            ("domain", setting.domain(of_alpha)),
            ("point", listed(setting.fixed)),
            ("start", listed(setting.other)),
            ("word", word),
        ),
        _terms(of_alpha, setting.fixed, setting.other),
    )


def exactly(name: str, attraction: str, escape: str) -> MapRule:
    """Stable and globally attracting for these parameters and no others."""
    return MapRule(name, (("attraction", attraction), ("escape", escape)))


# -------------------------------------------------------------------------------------------------
# Numbers compare as their squares do.

low, high = reals("low high")


@claim("theorem-roots", "theorem", "lemma", parameters=())
def a_number_is_at_most_another_if_its_square_is() -> Statement:
    """A number is at most a nonnegative one if its square is at most the other's."""
    return always(low <= high, given=[high >= 0, low**2 <= high**2], label="below")


# After an impact the root u of the energy is at most 1 + alpha w, and before it at least w - 1.
AT_IMPACTS = (real("u_next") <= 1 + alpha * w, w - 1 <= u)
