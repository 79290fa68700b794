"""The searches for a certificate in turn, cheap ones first.

Each is loaded when it is first asked: what settles most small statements is loaded in a tenth of
the time that all of it takes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from types import ModuleType

from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.small_proofs.simple_counterexamples import search_at_hand
from juggleproof.statements.nodes import Certificate, Proof
from juggleproof.statements.work import Budget

HERE = "juggleproof.search"


def certificates_in_turn(statement: checker.Statement, budget: Budget) -> Iterator[Certificate]:
    """What each search finds; the last one, which goes on where the others end, always tells.

    >>> text = "statement a/b\\nforall x\\nshow x^2 >= 0"
    >>> [*certificates_in_turn(checker.read_statements(text)["a/b"], Budget(10**5))][0].keys()
    dict_keys(['certified', 'point'])
    """
    at_hand = search_at_hand(statement, budget.part(limits.CHEAP_WORK))
    if at_hand is not None:
        yield at_hand
    by_pairs: Certificate | None = _loaded("small_proofs.products_of_two").search_by_pairs(
        statement, budget.part(limits.CHEAP_WORK)
    )
    if by_pairs is not None:
        yield by_pairs
    names = [name for line in statement.get("forall") for name in line]
    many = len(names) > limits.MOST_VARIABLES
    if many and _loaded("small_proofs.linear_system").linear(statement) is None:
        most = limits.MOST_VARIABLES
        tried = f"it is not linear, in {len(names)} variables; at most {most} are tried"
        yield {"unknown": tried}
        return
    whole = _loaded("certificate")
    found: Certificate = whole.search_certificate(
        statement, {}, budget, attempts=limits.SQUARES_FIRST
    )
    yield found


def search_proof(
    statement: checker.Statement,
    known: Mapping[str, checker.Statement],
    budget: Budget,
    effort: int,
) -> Proof | None:
    """What `certificate.search_proof` finds."""
    found: Proof | None = _loaded("certificate").search_proof(
        statement, known, budget, effort=effort
    )
    return found


def _loaded(name: str) -> ModuleType:
    return import_module(f"{HERE}.{name}")
