"""The one lemma of the claims about impacts: products of what is not negative, which the search is
told of rather than left to find.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from certificates.search.closing import Hints
from certificates.statements import Statement
from certificates.terms import Number, reals, term
from proofs.claims import claim
from proofs.forms import always

p, q, d = reals("p q d")
LEMMA = "part-products/main"


@claim("part-products", "part", "lemma", parameters=())
def a_product_of_two_numbers_and_a_square_is_not_negative() -> Statement:
    """A product of two numbers that are not negative and a square is not negative."""
    return always(p * q * d**2 >= 0, given=[p >= 0, q >= 0])


def told(products: Sequence[tuple[Number, Number, Number]]) -> dict[str, Any]:
    """The hints of a claim: these products, each of two numbers that are not negative and what is
    squared.
    """
    uses = tuple(
        (LEMMA, {"p": str(term(one)), "q": str(term(other)), "d": str(term(squared))})
        for one, other, squared in products
    )
    return {"uses": (LEMMA,), "search": Hints(uses)}
