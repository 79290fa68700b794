"""Box trees in lists of integers, and polynomials as dictionaries; loads no NumPy.

Measured beside `search.boxes.branching` on the 15 bounds of the benchmark of speed against error:
0.05 to 0.16 ms here for a tree, 0.1 to 0.84 ms there, and 65 ms more for loading NumPy; so there
are two.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import ceil, floor, lcm, prod
from typing import TypeVar

from juggleproof.algebra import limits
from juggleproof.certificates import checker

# -------------------------------------------------------------------------------------------------
# Polynomials and boxes as dictionaries and tuples, and what is computed of them exactly.

Exponents = tuple[int, ...]
Terms = Mapping[Exponents, Fraction]  # a polynomial: its coefficients, none of them 0
Number = TypeVar("Number", Fraction, float)
Box = Sequence[tuple[Fraction, Fraction]]
LETTERS = "abcdefghijklmnopqrstuvwxyz"  # the axes of a box, in the text of a tree


def value_at(terms: Terms, point: Sequence[Fraction]) -> Fraction:
    """The exact value at a point."""
    powers = (
        [
            [x**e for e in range(1 + max(exponents[i] for exponents in terms))]
            for i, x in enumerate(point)
        ]
        if terms
        else []
    )
    total = Fraction(0)
    for exponents, c in terms.items():
        for table, e in zip(powers, exponents):
            c = c * table[e] if e else c
        total += c
    return total


def derivative(part: Mapping[Exponents, Number], axis: int) -> dict[Exponents, Number]:
    """The derivative along an axis."""
    slope: dict[Exponents, Number] = {}
    for e, c in part.items():
        if e[axis]:
            slope[e[:axis] + (e[axis] - 1,) + e[axis + 1 :]] = c * e[axis]
    return slope


def simple_points(x: Iterable[float], box: Box) -> Iterator[tuple[Fraction, ...]]:
    """Rational points of the box close to x, the simplest first."""
    seen = set()
    for most in limits.TREE_DENOMINATORS:
        point = tuple(
            min(max(Fraction(float(v)).limit_denominator(most), low), high)
            for v, (low, high) in zip(x, box)
        )
        if point not in seen:
            seen.add(point)
            yield point


def rounded_up(value: Fraction, unit: Fraction) -> Fraction:
    """The least multiple of the unit that is not below the value."""
    return ceil(value / unit) * unit


def rounded_down(value: Fraction, unit: Fraction) -> Fraction:
    """The greatest multiple of the unit that is not above the value."""
    return floor(value / unit) * unit


# -------------------------------------------------------------------------------------------------
# A box tree that shows that a polynomial is nowhere negative on a box: depth first, in plain lists
# of integers, for small problems.
#
# Where boxes have few coefficients this takes about as long as the check; `branching` is for bounds
# that are not known before, and for large boxes.

Part = tuple[
    list[int], list[int]
]  # the sizes of a box's coefficients, and these, as the checker orders them


def search_tree(terms: Terms, box: Box, most: int, strict: bool = False) -> str | None:
    """The text of a tree of at most `most` letters for `terms` >= 0, or > 0 where `strict`; None
    where it has more, or where a corner has another value.

    >>> from fractions import Fraction as F
    >>> search_tree({(2,): F(1), (1,): F(-1), (0,): F(1, 4)}, [(F(0), F(1))], 9)
    'a..'
    """
    used = [k for k in range(len(box)) if any(e[k] for e in terms)]
    unit = lcm(*(c.denominator for c in terms.values()))
    packed = {
        sum(e[k] << checker.BITS * k for k in used): -c.numerator * (unit // c.denominator)
        for e, c in terms.items()
    }
    try:
        boxes = [
            checker.bernstein(
                checker.Poly(packed, 1, 0, 0, checker.Work()),
                [(checker.BITS * k, *box[k]) for k in used],
            )
        ]
    except checker.Rejected:
        return None
    letters: list[str] = []
    top = -1 if strict else 0
    while boxes:
        letter, parts = (_on_a_line if len(boxes[-1][0]) == 1 else _treated)(*boxes.pop(), top)
        letters.append(letter)
        boxes += parts
        if not letter or len(letters) > most:
            return None
    return "".join(letters)


def _on_a_line(sizes: list[int], c: list[int], top: int) -> tuple[str, list[Part]]:
    """The same as `_treated`, for one axis: which nearly all boxes have that are close to the
    minimum.
    """
    if max(c) <= top:
        return ".", []
    if c[0] > top or c[-1] > top:
        return "", []
    return LETTERS[0], _halves(sizes, c)


def _treated(sizes: list[int], c: list[int], top: int) -> tuple[str, list[Part]]:
    """The letter of a box, and its parts: a leaf, where no coefficient is above `top`, a face, or
    halves along the axis with the largest n (n - 1) max |second difference|.

    No letter where halving is in vain: a corner has a value above, or all are corners.
    """
    if max(c) <= top:
        return ".", []
    weight, choice, best = 0, 0, c
    for axis, count in enumerate(sizes):
        step, size = prod(sizes[axis + 1 :]), len(c) // count
        first = (
            [
                x
                for j in range(0, step * count, step)
                for k in range(j, len(c), count * step)
                for x in c[k : k + step]
            ]
            if axis
            else c
        )
        rises = [y - x for x, y in zip(first, first[size:])]
        least, greatest = min(rises), max(rises)
        if least >= 0 or greatest <= 0:
            return LETTERS[axis].upper(), [
                (sizes[:axis] + sizes[axis + 1 :], first[-size:] if greatest > 0 else first[:size])
            ]
        bends = [y - x for x, y in zip(rises, rises[size:])]
        found = max(max(bends), -min(bends)) * (count - 1) * (count - 2) if bends else 0
        if found > weight:
            weight, choice, best = found, axis, first
    if not weight or _corner_is_above(sizes, c, top):
        return "", []
    return LETTERS[choice], _halves([sizes[choice], *sizes[:choice], *sizes[choice + 1 :]], best)


def _halves(sizes: list[int], c: list[int]) -> list[Part]:
    """The halves along the first axis, the lower one last."""
    n, size = sizes[0] - 1, len(c) // sizes[0]
    levels = [c]
    for _ in range(n):
        levels.append([x + y for x, y in zip(levels[-1], levels[-1][size:])])
    return [
        (sizes, [x << k for k, level in enumerate(levels[::-1]) for x in level[-size:]]),
        (sizes, [x << n - k for k, level in enumerate(levels) for x in level[:size]]),
    ]


def _corner_is_above(sizes: list[int], c: list[int], top: int) -> bool:
    places, step = [0], len(c)
    for size in sizes:
        step //= size
        places += [place + (size - 1) * step for place in places]
    return any(c[place] > top for place in places)


def tree_above_zero(coefficients: Iterable[Fraction], low: Fraction, high: Fraction) -> str | None:
    """The tree of one axis that shows that a polynomial is positive from low to high; None where it
    is not, or where that takes many letters.  The coefficient of x^0 comes first.

    >>> tree_above_zero(map(Fraction, [1, -4, 5]), Fraction(0), Fraction(1))
    'aa...'
    """
    terms: Terms = {(k,): c for k, c in enumerate(coefficients) if c}
    if low > high or not terms:
        return None
    return search_tree(terms, [(low, high)], limits.MOST_LETTERS, strict=True)
