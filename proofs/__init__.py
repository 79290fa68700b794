"""What the paper says, as claims; the command that derives, proves and checks them; and the
language for claims of one's own.
"""

from juggleproof.certificates.language import (
    ClaimError,
    Formula,
    Iterates,
    MapRule,
    Statement,
    Term,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    implies,
    real,
    reals,
    term,
)
from juggleproof.proofs.claims import Argument, Assertion, Claim, Following, Readings, claim
from juggleproof.proofs.forms import always, exists_some

__all__ = [
    "Argument",
    "Assertion",
    "Claim",
    "ClaimError",
    "Following",
    "Formula",
    "Iterates",
    "MapRule",
    "Readings",
    "Statement",
    "Term",
    "always",
    "claim",
    "conjunction",
    "different",
    "disjunction",
    "equal",
    "exists_some",
    "iff",
    "implies",
    "real",
    "reals",
    "term",
]
