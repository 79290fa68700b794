"""The one lemma of the theorem: numbers compare as their squares do."""

from __future__ import annotations

from collections.abc import Sequence

from certificates.search.closing import Hints
from certificates.statements import Statement
from certificates.terms import Term, real, reals
from proofs.claims import claim
from proofs.paper.vocabulary import alpha, always, w
from proofs.theorem.definition import u
from proofs.theorem.rules import Setting

low, high = reals("low high")
LEMMA = "theorem-roots/below"


@claim("theorem-roots", "theorem", "lemma", parameters=())
def a_number_is_at_most_another_if_its_square_is() -> Statement:
    """A number is at most a nonnegative one if its square is at most the other's."""
    return always(low <= high, given=[high >= 0, low**2 <= high**2], label="below")


def compared(pairs: Sequence[tuple[Term, Term]], setting: Setting) -> Hints:
    """The lemma for these pairs of a smaller and a greater term of the normal form."""
    return Hints(
        tuple(
            (LEMMA, {"low": str(setting.here(less)), "high": str(setting.here(more))})
            for less, more in pairs
        )
    )


# After an impact the root u of the energy is at most 1 + alpha w, and before it at least w - 1.
AT_IMPACTS = ((real("u_next"), 1 + alpha * w), (w - 1, u))
