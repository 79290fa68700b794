"""Trees of the search for small problems: the checker accepts each, and none is found where a point
is negative.
"""

from __future__ import annotations

import itertools
import random
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.algebra.box_trees import search_tree, value_at
from juggleproof.certificates import checker
from juggleproof.search.boxes.branching import Branching
from tests.statements.drawn import fractions

MANY = settings(max_examples=60, deadline=None, derandomize=True)
NAMES = ("x", "y", "z")
ends = st.tuples(
    fractions(-2, 2, 3),
    fractions(0, 3, 3),
)
boxes = st.lists(ends, min_size=3, max_size=3).map(
    lambda pairs: [(low, low + width) for low, width in pairs]
)
exponents = st.tuples(st.integers(0, 4), st.integers(0, 3), st.integers(0, 2)).filter(any)
polynomials = st.dictionaries(
    exponents, st.integers(-6, 6).filter(bool).map(Fraction), min_size=1, max_size=6
)
Terms = dict[tuple[int, ...], Fraction]
Box = list[tuple[Fraction, Fraction]]


def raised(terms: Terms, box: Box, over: Fraction) -> Terms:
    """The polynomial, raised so that the least of its values at some points is `over`."""
    source = random.Random(len(terms))
    places = [
        *itertools.product((0, Fraction(1, 2), 1), repeat=3),
        *([Fraction(source.randrange(13), 12) for _ in NAMES] for _ in range(30)),
    ]
    least = min(
        value_at(terms, [low + (high - low) * t for (low, high), t in zip(box, place)])
        for place in places
    )
    return {e: c for e, c in {**terms, (0, 0, 0): over - least}.items() if c}


def outcome(terms: Terms, box: Box, tree: str) -> str:
    """What the checker says of the tree for the polynomial >= 0 on the box."""
    text = " + ".join(
        f"({c})*" + "*".join(f"{n}^{k}" for n, k in zip(NAMES, e)) for e, c in terms.items()
    )
    rows = [f"given {low} <= {name} <= {high}" for name, (low, high) in zip(NAMES, box)]
    (statement,) = checker.read_statements(
        "\n".join(["statement a/b", "forall x y z", *rows, f"show {text} >= 0"])
    ).values()
    bounds = [[2 * k, 2 * k + 1] for k in range(3) if any(e[k] for e in terms)]
    found = ["a/b", [], {name: str(low) for name, (low, _) in zip(NAMES, box)}, ["close"]]
    return str(
        checker.check_one(
            statement,
            {"certified": ["proof", [], ["boxes", 6, bounds, tree]], "point": found},
            {},
            {},
        )[0]
    )


@MANY
@given(polynomials, boxes)
def test_a_tree_that_is_found_is_accepted_holds(terms: Terms, box: Box) -> None:
    above = raised(terms, box, Fraction(1, 2))
    tree = search_tree(above, box, 300)
    assert tree is None or outcome(above, box, tree) == "certified"
    if all(any(e[k] for e in above) for k in range(3)):
        assert (
            tree is not None
            or not Branching(above, box, lambda: Fraction(0), lambda place: None, True)
            .run(150)
            .reached
        )


@MANY
@given(polynomials, boxes)
def test_rejects_a_polynomial_that_is_negative_at_a_point(terms: Terms, box: Box) -> None:
    assert search_tree(raised(terms, box, Fraction(-1, 10**6)), box, 300) is None


def test_rejects_more_boxes_than_allowed() -> None:
    terms, box = (
        {(2,): Fraction(1), (1,): Fraction(-2, 3), (0,): Fraction(1, 9) + Fraction(1, 10**6)},
        [(Fraction(0), Fraction(1))],
    )
    tree = search_tree(terms, box, 100)
    assert (
        tree is not None
        and search_tree(terms, box, len(tree)) == tree
        and search_tree(terms, box, len(tree) - 1) is None
    )
    assert (
        search_tree({(2,): Fraction(1), (1,): Fraction(-2, 3), (0,): Fraction(1, 9)}, box, 1000)
        is None
    )  # 0 at 1/3, which no halving meets
