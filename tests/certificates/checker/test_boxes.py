"""Box trees against an independent evaluation: whatever tree is accepted, random ones too, what it
shows is true at every point tried.
"""

from __future__ import annotations

import itertools
import random
from fractions import Fraction
from math import comb, lcm, prod

from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.certificates import checker
from tests.certificates.checker.evaluator import term_at
from tests.certificates.checker.harness import lines, proof, verdict
from tests.statements.drawn import fractions

NAMES = ("x", "y", "z")
MANY = settings(max_examples=60, deadline=None, derandomize=True)
ends = st.tuples(
    fractions(-3, 3, 4),
    fractions(0, 3, 3),
)
boxes = st.lists(ends, min_size=3, max_size=3).map(
    lambda pairs: [(low, low + width) for low, width in pairs]
)
monomials = st.tuples(
    st.integers(-5, 5).filter(bool), st.integers(0, 3), st.integers(0, 2), st.integers(0, 2)
)
polynomials = st.lists(monomials, min_size=1, max_size=5).map(
    lambda parts: " + ".join(["0", *(f"({c})*x^{a}*y^{b}*z^{d}" for c, a, b, d in parts)])
)
trees = st.text("aabcABC....", max_size=14)


def used_in(text: str) -> list[int]:
    context = checker.Context()
    for name in NAMES:
        context.declare(name)
    return [
        k
        for k, name in enumerate(NAMES)
        if name in checker.variables_of(context, context.polynomial(text))
    ]


def judged(
    text: str, box: list[tuple[Fraction, Fraction]], relation: str, level: Fraction, tree: str
) -> str:
    rows = [
        f"given {side}"
        for name, (low, high) in zip(NAMES, box)
        for side in (f"{low} <= {name}", f"{name} <= {high}")
    ]
    node = ["boxes", 6, [[2 * k, 2 * k + 1] for k in used_in(text)], tree]
    at = {name: str(low) for name, (low, _) in zip(NAMES, box)}
    return verdict(
        lines("forall x y z", *rows, f"show {text} {relation} {level}"),
        {"rule/case": proof(node, at=at)},
    )["rule/case"][0]


def values(text: str, box: list[tuple[Fraction, Fraction]], seed: int) -> list[Fraction]:
    """The values at corners, edges and random points of a box, by the second reading."""
    source = random.Random(seed)
    parts = [Fraction(k, 4) for k in range(5)]
    places = [
        *itertools.product((Fraction(0), Fraction(1, 2), Fraction(1)), repeat=3),
        *([source.choice(parts) for _ in NAMES] for _ in range(30)),
    ]
    points = [
        {n: low + (high - low) * t for n, (low, high), t in zip(NAMES, box, place)}
        for place in places
    ]
    return [term_at(text, point) for point in points]


def grown(source: random.Random, depth: int, axes: int) -> str:
    """A random tree of the right shape: halves, and faces that need not be monotone."""
    kind = source.random()
    if depth == 0 or axes == 0 or kind < 0.25:
        return "."
    letter = "abc"[source.randrange(axes)]
    if kind < 0.5:
        return letter.upper() + grown(source, depth - 1, axes - 1)
    return letter + grown(source, depth - 1, axes) + grown(source, depth - 1, axes)


@MANY
@given(polynomials, boxes, st.sampled_from([">=", ">", "<=", "<"]), st.integers(0, 10**6))
def test_what_a_random_tree_shows_is_true(
    text: str, box: list[tuple[Fraction, Fraction]], relation: str, seed: int
) -> None:
    source = random.Random(seed)
    used = used_in(text)
    if not used:
        return
    found = values(text, box, seed)
    for _ in range(6):
        extreme = min(found) if ">" in relation else max(found)
        level = extreme + source.choice([-1, 1]) * Fraction(source.randrange(-1, 12), 4)
        tree = grown(source, 4, len(used))
        if judged(text, box, relation, level, tree) == "certified":
            compare = {
                ">=": min(found) >= level,
                ">": min(found) > level,
                "<=": max(found) <= level,
                "<": max(found) < level,
            }
            assert compare[relation], (text, box, relation, level, tree)


@MANY
@given(polynomials, boxes, trees)
def test_no_text_shows_what_is_false(
    text: str, box: list[tuple[Fraction, Fraction]], tree: str
) -> None:
    found = values(text, box, len(tree))
    if used_in(text) and len(set(found)) > 1:
        middle = (min(found) + max(found)) / 2
        assert judged(text, box, ">=", middle, tree) == "rejected"
        assert judged(text, box, "<", middle, tree) == "rejected"


@MANY
@given(
    polynomials,
    boxes,
    st.lists(fractions(0, 1, 7), min_size=3, max_size=3),
)
def test_coefficients_are_those_of_the_polynomial(
    text: str, box: list[tuple[Fraction, Fraction]], place: list[Fraction]
) -> None:
    """sum of coefficients times Bernstein polynomials = one positive factor times the polynomial,
    at any point.
    """
    context = checker.Context()
    for name in NAMES:
        context.declare(name)
    poly, used = context.polynomial(text), used_in(text)
    if not used:
        return
    sizes, c = checker.bernstein(poly, [(checker.BITS * k, *box[k]) for k in used])
    factors = set()
    for t in (place, [Fraction(1, 3)] * 3, [Fraction(0), Fraction(1), Fraction(1, 2)]):
        indices = itertools.product(*map(range, sizes))
        terms = (
            prod(
                comb(n - 1, j) * t[k] ** j * (1 - t[k]) ** (n - 1 - j)
                for n, j, k in zip(sizes, index, used)
            )
            for index in indices
        )
        total = sum(x * weight for x, weight in zip(c, terms, strict=True))
        value = term_at(
            text, {name: low + (high - low) * s for name, (low, high), s in zip(NAMES, box, t)}
        )
        assert (total > 0) == (value > 0) and (total < 0) == (value < 0)
        factors |= {total / value} if value else set()
    assert len(factors) <= 1 and all(factor > 0 for factor in factors)


@MANY
@given(
    st.lists(st.integers(-(2**40), 2**40), min_size=3, max_size=9).filter(lambda c: c[-1] != 0),
    ends,
)
def test_coefficients_are_as_short_as_the_limit_assumes(
    c: list[int], end: tuple[Fraction, Fraction]
) -> None:
    low, high, n = end[0], sum(end), len(c) - 1
    poly = checker.Poly({k: value for k, value in enumerate(c) if value}, 1, n, 50, checker.Work())
    d = lcm(low.denominator, high.denominator)
    more = n * (3 + max(x.bit_length() for x in (d, int(low * d), int(high * d))))
    found = checker.bernstein(poly, [(0, low, high)])[1]
    assert max(map(int.bit_length, found)) <= max(map(int.bit_length, c)) + more
    assert all((k + 1) * lcm(*(comb(k, j) for j in range(k + 1))) <= 8**k for k in range(1, 200))


def test_random_trees_are_accepted_often_enough_to_tell() -> None:
    source, accepted = random.Random(5), 0
    for _ in range(300):
        accepted += (
            judged(
                "x^2 - x*y + y^2*z",
                [(Fraction(0), Fraction(1))] * 3,
                ">=",
                Fraction(-9, 20),
                grown(source, 5, 3),
            )
            == "certified"
        )
    assert accepted > 5
