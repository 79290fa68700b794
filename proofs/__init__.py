"""What the paper says, as claims; the command that derives, proves and checks them; and the
language for claims of one's own.
"""

from certificates.statements import Iterates, MapRule, Statement
from certificates.terms import (
    ClaimError,
    Formula,
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
from proofs.claims import Argument, Assertion, Claim, Following, Readings, claim
from proofs.forms import always, exists_some

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
