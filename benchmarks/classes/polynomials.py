"""Random problems about few variables.  Each is made to be solvable, or not: a point that solves it
is planted, or an identity that leaves it no solution.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, product
from math import comb, isqrt, prod
from random import Random

from flint import fmpq, fmpq_mpoly, fmpz_poly

from juggleproof.benchmarks.classes.writing import (
    atom,
    linear,
    point,
    polynomial,
    rational,
    script,
    some,
    squares,
    variables,
)

Names = Sequence[fmpq_mpoly]
Sides = list[tuple[fmpq, fmpq]]
MARGINS = (fmpq(1, 10), fmpq(1, 100), fmpq(1, 1000))

# -------------------------------------------------------------------------------------------------
# Boxes.


def sides(random: Random, count: int) -> Sides:
    """The ends of random intervals."""
    ends = [rational(random, -3, 2) for _ in range(count)]
    return [(low, low + rational(random, 1, 3)) for low in ends]


def inside(random: Random, box: Sides) -> list[fmpq]:
    """A random point of a box."""
    return [low + (high - low) * fmpq(random.randint(0, 8), 8) for low, high in box]


def bounded(random: Random, names: Names, box: Sides) -> list[str]:
    """The facts of a box: by its ends, by a product of both sides, or by a square."""
    facts = []
    for x, (low, high) in zip(names, box):
        middle, half = (low + high) / 2, (high - low) / 2
        facts += random.choice(
            (
                [atom(x, ">=", low), atom(x, "<=", high)],
                [atom((x - low) * (high - x), ">=")],
                [atom((x - middle) ** 2, "<=", half**2)],
            )
        )
    return facts


def products_of_sides(random: Random, names: Names, box: Sides, degree: int) -> fmpq_mpoly:
    """A positive combination of products of sides of a box.  Source: Handelman 1988."""
    ends = [side for x, (low, high) in zip(names, box) for side in (x - low, high - x)]
    return sum(
        (random.randint(1, 3) * prod(random.choices(ends, k=degree), start=0 * names[0] + 1))
        for _ in range(4)
    )


def over_a_box(random: Random, solvable: bool) -> str:
    """A sum of products of sides, squares and a margin is not negative on a box; a polynomial less
    its value at a point and a margin is negative there.
    """
    count, margin = random.randint(2, 4), random.choice(MARGINS)
    names, box = variables(count), sides(random, count)
    if solvable:
        wave = polynomial(random, names, random.randint(2, 4), 6)
        asked = wave - wave(*inside(random, box)) - margin
    else:
        asked = products_of_sides(random, names, box, random.randint(2, 3))
        asked += random.choice((0, margin)) + squares(random, names, 2, 1)
    return script(names, [*bounded(random, names, box), atom(asked, "<")])


def least_coefficient(wave: fmpq_mpoly, box: Sides) -> fmpq:
    """The least Bernstein coefficient on a box; no value is below it.

    >>> (x,) = variables(1)
    >>> least_coefficient(x**2 - x, [(fmpq(0), fmpq(1))])
    -1/2
    """
    names = wave.context().gens()
    moved = wave.compose(*(low + (high - low) * x for x, (low, high) in zip(names, box)))
    powers, degrees = dict(moved.terms()), moved.degrees()
    return min(
        sum(
            (
                value * prod(fmpq(comb(i, k), comb(n, k)) for i, k, n in zip(place, term, degrees))
                for term, value in powers.items()
            ),
            fmpq(0),
        )
        for place in product(*(range(n + 1) for n in degrees))
    )


def above_a_bound(random: Random, solvable: bool) -> str:
    """A random polynomial is not below the least Bernstein coefficient on the parts of a box, less
    a margin; somewhere it is below its least value at their corners, plus a margin.
    """
    count, margin = random.randint(2, 3), random.choice(MARGINS)
    names, box = variables(count), sides(random, count)
    wave = polynomial(random, names, random.randint(3, 4), 6)
    if solvable:
        corners = product(*((low, (low + high) / 2, high) for low, high in box))
        bound = min(wave(*corner) for corner in corners) + margin
    else:
        parts = product(*(((low, (low + high) / 2), ((low + high) / 2, high)) for low, high in box))
        bound = min(least_coefficient(wave, list(part)) for part in parts) - margin
    return script(names, [*bounded(random, names, box), atom(wave, "<", bound)])


def box_and_constraints(random: Random, solvable: bool) -> str:
    """The same with constraints g >= 0, where squares times g are added."""
    count, margin = random.randint(2, 3), random.choice(MARGINS)
    names, box = variables(count), sides(random, count)
    there = inside(random, box)
    waves = [polynomial(random, names, 2, 3) for _ in range(random.randint(1, 2))]
    given = [wave - wave(*there) + margin for wave in waves]
    if solvable:
        wave = polynomial(random, names, random.randint(2, 4), 6)
        asked = wave - wave(*there) - margin
    else:
        asked = products_of_sides(random, names, box, 2) / 8 + margin
        for one in given:
            asked += one * random.choice((fmpq(1), fmpq(2), (names[0] - names[1]) ** 2))
    facts = [atom(one, ">=") for one in given]
    return script(names, [*bounded(random, names, box), *facts, atom(asked, "<")])


def bonferroni(random: Random, solvable: bool) -> str:
    """sum x_i - sum x_i x_j <= 1 on [0, 1]^n, with equality at corners.  Source: Bonferroni
    1936.
    """
    count, margin = random.randint(3, 8), random.choice(MARGINS)
    names = variables(count)
    total = sum(names) - sum(x * y for x, y in combinations(names, 2))
    bounds = [part for x in names for part in (atom(x, ">="), atom(x, "<=", 1))]
    return script(names, [*bounds, atom(total, ">", 1 - margin if solvable else 1)])


def product_below_mean(random: Random, solvable: bool) -> str:
    """x1 x2 .. xn is at most the weighted mean of x1, .., xn on [0, 1]^n, with equality at
    (1, .., 1).
    """
    count, margin = random.randint(3, 10), random.choice(MARGINS)
    names = variables(count)
    weights = [random.randint(1, 4) for _ in names]
    mean = sum((w * x for w, x in zip(weights, names)), 0 * names[0]) / sum(weights)
    bounds = [part for x in names for part in (atom(x, ">="), atom(x, "<=", 1))]
    whole = prod(names, start=0 * names[0] + 1)
    return script(names, [*bounds, atom(whole, ">", mean - margin if solvable else mean)])


# -------------------------------------------------------------------------------------------------
# Nonnegative forms.


def _cyclic(names: Names, powers: tuple[int, int, int], both: bool = False) -> fmpq_mpoly:
    """The sum of a monomial in three names over their rotations, or all their different orders."""
    x, y, z = names
    orders = [(x, y, z), (y, z, x), (z, x, y)] + ([(y, x, z), (z, y, x), (x, z, y)] if both else [])
    monomials = {str(term): term for o in orders if (term := _monomial(o, powers))}
    return sum(monomials.values(), 0 * x)


def _monomial(names: Names, powers: Sequence[int]) -> fmpq_mpoly:
    return prod((x**n for x, n in zip(names, powers)), start=0 * names[0] + 1)


def motzkin(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Motzkin, The arithmetic-geometric inequality (1967)."""
    return x**4 * y**2 + x**2 * y**4 + z**6 - 3 * x**2 * y**2 * z**2


def robinson(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Robinson, Some definite polynomials which are not sums of squares (1973)."""
    names = (x, y, z)
    return (
        _cyclic(names, (6, 0, 0))
        - _cyclic(names, (4, 2, 0), both=True)
        + 3 * _cyclic(names, (2, 2, 2))
    )


def choi_lam(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Choi and Lam, Extremal positive semidefinite forms (1977)."""
    return _cyclic((x, y, z), (4, 2, 0)) - 3 * _cyclic((x, y, z), (2, 2, 2))


def choi_lam_quartic(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly, w: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Choi and Lam, Extremal positive semidefinite forms (1977)."""
    return _cyclic((x, y, z), (2, 2, 0)) + w**4 - 4 * x * y * z * w


def schmuedgen(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Schmuedgen, An example of a positive polynomial which is not a sum of squares of
    polynomials (1979).
    """
    cubics = (x**3 - 4 * x * z**2) ** 2 + (y**3 - 4 * y * z**2) ** 2
    rest = (y**2 - x**2) * x * (x + 2 * z) * (x * (x - 2 * z) + 2 * (y**2 - 4 * z**2))
    return 200 * cubics + rest


def stengle(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Stengle, Integral solution of Hilbert's seventeenth problem (1979)."""
    return x**3 * z**3 + (y**2 * z - x**3 - z**2 * x) ** 2


def scheiderer(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """A sum of squares over the reals, not over the rationals.  Source: Scheiderer, Sums of squares
    of polynomials with rational coefficients (2016).
    """
    cubic = x * z**3 + y * z**3 - 3 * x**2 * y * z - 4 * x * y**2 * z
    return x**4 + x * y**3 + y**4 + cubic + 2 * x**2 * z**2 + z**4


def harris(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Harris, Real even symmetric ternary forms (1999)."""
    names = (x, y, z)
    return (
        16 * _cyclic(names, (10, 0, 0))
        - 36 * _cyclic(names, (8, 2, 0), both=True)
        + 20 * _cyclic(names, (6, 4, 0), both=True)
        + 57 * _cyclic(names, (6, 2, 2))
        - 38 * _cyclic(names, (4, 4, 2))
    )


def delzell(x: fmpq_mpoly, y: fmpq_mpoly, z: fmpq_mpoly, w: fmpq_mpoly) -> fmpq_mpoly:
    """Source: Delzell, A constructive, continuous solution to Hilbert's 17th problem (1980)."""
    return w**2 * motzkin(x, y, z) + z**8


FORMS: Sequence[tuple[Callable[..., fmpq_mpoly], tuple[int, ...]]] = (  # each at a point: 0 or near
    (motzkin, (1, 1, 1)),
    (robinson, (1, 1, 1)),
    (choi_lam, (1, 1, 1)),
    (choi_lam_quartic, (1, 1, 1, 1)),
    (schmuedgen, (0, 0, 1)),
    (stengle, (0, 0, 1)),
    (scheiderer, (1, -1, 1)),
    (harris, (1, 1, 0)),
    (delzell, (1, 0, 0, 0)),
)


def _lowered(form: fmpq_mpoly, names: Names, there: Sequence[int | fmpq], by: fmpq) -> fmpq_mpoly:
    """The form less a multiple of (x1^2 + .. + xn^2)^k, by which it is negative at a point."""
    norm = sum(x**2 for x in names) ** (form.total_degree() // 2)
    return form - (form(*there) / norm(*there) + by) * norm


def published_form(random: Random, solvable: bool) -> str:
    """A nonnegative form that is no sum of squares (over the rationals) is not negative; with a
    little subtracted it is, at some point.
    """
    form, there = random.choice(FORMS)
    names = variables(len(there))
    asked = form(*names)
    if solvable:
        asked = _lowered(asked, names, there, random.choice(MARGINS))
    return script(names, [atom(asked, "<")])


def moved_form(random: Random, solvable: bool) -> str:
    """The same in other coordinates: a multiple of the next variable is added to each."""
    form, there = random.choice(FORMS[:6])
    names = variables(len(there))
    factors = [random.choice((-1, 0, 1)) for _ in names[1:]]
    moved = [x + m * y for x, m, y in zip(names, factors, names[1:])] + [names[-1]]
    ends = list(there)
    for k in reversed(range(len(factors))):
        ends[k] -= factors[k] * ends[k + 1]
    asked = form(*moved)
    if solvable:
        asked = _lowered(asked, names, ends, random.choice(MARGINS))
    return script(names, [atom(asked, "<")])


def agiform(random: Random, solvable: bool) -> str:
    """The weighted inequality of the means, in monomials.

    Formula: m1 x^a1 + .. + mk x^ak >= (m1 + .. + mk) x^b for m1 a1 + .. + mk ak = (m1 + .. + mk) b,
    ai even. Source: Reznick, Forms derived from the arithmetic-geometric inequality (1989).
    """
    count, degree = random.choice(((2, 6), (3, 6), (3, 8), (4, 4)))
    names = variables(count)
    while True:
        weights = [random.randint(1, 3) for _ in range(random.randint(2, 3))]
        corners = []
        for _ in weights:
            cuts = sorted(random.choices(range(degree // 2 + 1), k=count - 1))
            ends = [0, *cuts, degree // 2]
            corners.append([2 * (b - a) for a, b in zip(ends, ends[1:])])
        total = sum(weights)
        mean = [sum(w * a[k] for w, a in zip(weights, corners)) for k in range(count)]
        if all(entry % total == 0 for entry in mean) and corners[0] != corners[1]:
            break
    inner = _monomial(names, [entry // total for entry in mean])
    more = random.choice(MARGINS) if solvable else fmpq(0)
    asked = sum((w * _monomial(names, a) for w, a in zip(weights, corners)), 0 * names[0])
    return script(names, [atom(asked - (total + more) * inner, "<")])


def sum_of_squares(random: Random, solvable: bool) -> str:
    """A random sum of few squares of forms is not negative; with a little subtracted it is, at a
    common zero of the forms or near it.
    """
    count, degree = random.randint(2, 4), random.choice((2, 4))
    names, there = variables(count), [random.choice((-1, 1, 2)) for _ in range(count)]
    asked = 0 * names[0]
    for _ in range(random.randint(2, 3)):
        form = linear(random, names) * (random.choice(names) if degree == 4 else 1)
        power = names[0] ** (degree // 2)
        asked += (form - form(*there) / power(*there) * power) ** 2
    if solvable:
        asked = _lowered(asked, names, there, random.choice(MARGINS))
    return script(names, [atom(asked, "<")])


# -------------------------------------------------------------------------------------------------
# One variable.


def _positive(random: Random, x: fmpq_mpoly) -> fmpq_mpoly:
    """A polynomial without a real root."""
    return (x - rational(random, -2, 2)) ** 2 + rational(random, 1, 2)


def between_roots(random: Random, solvable: bool) -> str:
    """(x - a)(x - b) q(x) with q > 0 is not positive on [a, b]; it is 0 at both ends."""
    (x,) = variables(1)
    low = rational(random, -3, 3)
    high = low + rational(random, 1, 3)
    wave = (x - low) * (x - high) * _positive(random, x) * random.choice((1, (x - low) ** 2))
    asked = atom(wave, ">=" if solvable else ">")
    return script([x], [asked, atom(x, ">", low), atom(x, "<=", high)])


def beside_a_root(random: Random, solvable: bool) -> str:
    """x^2 <= d, and x is above a decimal just below or just above the square root of d."""
    (x,) = variables(1)
    digits = random.randint(3, 12)
    size = random.choice((2, 3, 5, 7, 11))
    near = fmpq(isqrt(size * 10 ** (2 * digits)) + (not solvable), 10**digits)
    facts = [atom((x**2 - size) * random.choice((1, _positive(random, x))), "<=")]
    facts += [atom(x, ">=", near), *([atom(x, "<=", size)] if random.random() < 0.5 else [])]
    return script([x], facts)


def chebyshev(random: Random, solvable: bool) -> str:
    """A Chebyshev polynomial of degree n is at most 1 on [-1, 1]; it is 1 between -1 and 1 too, for
    n >= 3.
    """
    (x,) = variables(1)
    wave = fmpz_poly.chebyshev_t(random.randint(3, 24))
    asked = sum((int(c) * x**k for k, c in enumerate(wave.coeffs())), 0 * x)
    facts = [atom(x, ">", -1), atom(x, "<", 1)]
    return script([x], [*facts, atom(asked, ">=" if solvable else ">", 1)])


def sparse(random: Random, solvable: bool) -> str:
    """x^n + (n - 1) c^n >= n c^(n-1) x for x > 0, with equality at c."""
    (x,) = variables(1)
    degree, there = random.randint(5, 40), rational(random, 1, 2)
    less = random.choice(MARGINS) if solvable else fmpq(0)
    asked = x**degree + (degree - 1 - less) * there**degree - degree * there ** (degree - 1) * x
    return script([x], [atom(x, ">"), atom(asked, "<")])


def clauses_on_a_line(random: Random, solvable: bool) -> str:
    """One part of each clause holds at a planted point; or no part holds between two numbers."""
    (x,) = variables(1)
    low = rational(random, -3, 2)
    high = low + rational(random, 1, 2)
    there = (low + high) / 2
    clauses = []
    for _ in range(random.randint(3, 6)):
        parts = []
        for _ in range(2):
            wave = polynomial(random, [x], 3, 4)
            if solvable:
                wave -= wave(there) - rational(random, -2, 1)
            else:
                wave = (x - low) * (high - x) * _positive(random, x) + random.choice(MARGINS)
            parts.append(atom(wave, "<="))
        if solvable:
            wave = polynomial(random, [x], 3, 4)
            parts[random.randint(0, 1)] = atom(wave - wave(there), "<=")
        clauses.append(some(parts))
    return script([x], [*clauses, atom(x, ">=", low), atom(x, "<=", high)])


# -------------------------------------------------------------------------------------------------
# Small, by equations.


def touching(random: Random, solvable: bool) -> str:
    """a^2 x^2 + b^2 y^2 = c and x y >= c/(2 a b): both coordinates of the point are irrational;
    with a greater bound there is no point.
    """
    x, y = variables(2)
    a, b, c = (fmpq(random.randint(1, 5)) for _ in range(3))
    more = fmpq(0) if solvable else random.choice(MARGINS)
    ellipse = atom((a * x) ** 2 + (b * y) ** 2, "=", c)
    return script([x, y], [ellipse, atom(x * y, ">=", c / (2 * a * b) + more)])


def tower(random: Random, solvable: bool) -> str:
    """x^2 = d, y^2 = x + e and so on: solvable for x > 0, and not for x < -e."""
    count = random.randint(2, 3)
    names = variables(count)
    size = random.choice((2, 3, 5, 6, 7))
    facts = [atom(names[0] ** 2, "=", size)]
    for k in range(1, count):
        facts.append(atom(names[k] ** 2, "=", names[k - 1] + random.randint(0, 1)))
    if solvable:
        facts += [atom(x, ">") for x in names]
    else:
        facts += [atom(names[0], "<", -1)] if random.random() < 0.5 else [atom(names[1], ">", 3)]
    return script(names, facts)


def symmetric(random: Random, solvable: bool) -> str:
    """x + y + z, x y + y z + z x and x y z are those of the roots of a cubic, which has three real
    roots; or only one, since another factor has the form a^2 + b^2 > 0.
    """
    x, y, z = names = variables(3)
    root, shift = rational(random, -3, 3), rational(random, -2, 2)
    rest = random.choice((1, 2, 3)) * (-1 if solvable else 1)
    # (t - root)((t - shift)^2 + rest)
    facts = [
        atom(x + y + z, "=", root + 2 * shift),
        atom(x * y + y * z + z * x, "=", 2 * root * shift + shift**2 + rest),
        atom(x * y * z, "=", root * (shift**2 + rest)),
    ]
    return script(names, facts)


def ideal(random: Random, solvable: bool) -> str:
    """Polynomials that are 0 at a planted point; or the last is 1 and a combination of the
    others.
    """
    count = random.randint(2, 3)
    names = variables(count)
    there = point(random, count, 2)
    given = [(wave := polynomial(random, names, 2, 4)) - wave(*there) for _ in range(count - 1)]
    last = polynomial(random, names, 2, 4)
    last -= last(*there)
    if not solvable:
        last = sum((linear(random, names) * one for one in given), 0 * names[0]) + 1
    return script(names, [atom(one, "=") for one in [*given, last]])


# -------------------------------------------------------------------------------------------------
# Several constraints in 2 to 4 variables.


def planted_certificate(random: Random, solvable: bool) -> str:
    """Constraints with -1 as a combination of them, their products and squares; or all hold at a
    planted point.  Source: Stengle, A Nullstellensatz and a Positivstellensatz (1974).
    """
    count = random.randint(2, 4)
    names, there = variables(count), point(random, count, 2)
    given = [(wave := polynomial(random, names, 2, 3)) - wave(*there) for _ in range(2)]
    if solvable:
        last = polynomial(random, names, 3, 4)
        last -= last(*there) - random.choice(MARGINS)
    else:
        last = -1 - squares(random, names, 2, 2) - given[0] * given[1] * random.randint(0, 1)
        last -= given[0] * linear(random, names, 2) ** 2 + given[1] * random.randint(1, 3)
    return script(names, [atom(one, ">=") for one in [*given, last]])


def balls(random: Random, solvable: bool) -> str:
    """Two balls whose centres are a little less or more apart than the sum of their radii; and a
    third that holds the point between.
    """
    count = random.randint(2, 4)
    names, first = variables(count), point(random, count, 2)
    legs = random.choice(((3, 4, 0, 0), (1, 2, 2, 0), (2, 3, 6, 0), (1, 1, 1, 1)))
    step = [fmpq(leg) for leg in legs]
    if any(step[count:]):
        step = [fmpq(3), fmpq(4), fmpq(0), fmpq(0)]
    distance = isqrt(int(sum(s**2 for s in step)))
    share = fmpq(random.randint(1, 4), 5)
    less = random.choice(MARGINS) * (1 if solvable else -1)
    second = [a + s for a, s in zip(first, step)]
    touch = [a + share * s for a, s in zip(first, step)]
    three = (first, share * distance + less), (second, (1 - share) * distance + less), (touch, 1)
    facts = [
        atom(sum(((x - a) ** 2 for x, a in zip(names, centre)), 0 * names[0]), "<=", radius**2)
        for centre, radius in three
    ]
    return script(names, facts)


def bent(random: Random, solvable: bool) -> str:
    """Two discs that share a point, or do not, in coordinates that a square bends."""
    x, y = variables(2)
    (a, b), share = point(random, 2, 2), fmpq(random.randint(1, 4), 5)
    less = random.choice(MARGINS) * (1 if solvable else -1)
    bend = x + random.choice((-2, -1, 1, 2)) * y**2
    facts = [
        atom((bend - a) ** 2 + (y - b) ** 2, "<=", (5 * share + less) ** 2),
        atom((bend - a - 3) ** 2 + (y - b - 4) ** 2, "<=", (5 * (1 - share) + less) ** 2),
    ]
    return script([x, y], facts)


def above_and_below(random: Random, solvable: bool) -> str:
    """A convex power above a line that touches it, or a little higher, between two bounds."""
    x, y = variables(2)
    power, there = random.choice((2, 4, 6)), rational(random, -2, 2)
    slope, gap = power * there ** (power - 1), random.choice(MARGINS)
    height = there**power + (0 if solvable else gap)
    line = slope * (x - there) + there**power
    facts = [atom(y, ">=", x**power + height - there**power), atom(y, "<=", line)]
    return script([x, y], [*facts, atom(x * y, "<=", there * height + 1)])


def binomials(random: Random, solvable: bool) -> str:
    """x, y >= 0, x + y = 1, and comb(n, k) x^k y^(n - k) is more than 1, or at least its value at a
    planted point.
    """
    x, y = variables(2)
    degree = random.randint(3, 8)
    k = random.randint(1, degree - 1)
    there = fmpq(random.randint(1, 7), 8)
    value = comb(degree, k) * there**k * (1 - there) ** (degree - k) if solvable else fmpq(1)
    facts = [atom(x, ">="), atom(y, ">="), atom(x + y, "=", 1)]
    return script([x, y], [*facts, atom(comb(degree, k) * x**k * y ** (degree - k), ">=", value)])
