"""Certificates of the map rules: a proof for each premise that the checker writes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from certificates import checker
from certificates.statements import rests_on

from .budget import Budget, Exhausted
from .certificate import search_proof
from .closing import Hints


def search_map_rule(
    statement: checker.Statement,
    known: dict[str, checker.Statement],
    budget: int,
    hints: Mapping[str, Hints] | None = None,
) -> dict[str, Any]:
    """{"certified": {premise: proof}}, or {"unknown": the premise for which no proof was found};
    each premise may take the whole budget.

    >>> text = "statement demo/halves\\nover a\\ndomain a > 0\\nstate x\\n"
    >>> text += "space x >= 0\\npiece x >= 0 -> x/2"
    >>> statement = checker.read_statements(text)["demo/halves"]
    >>> sorted(search_map_rule(statement, {}, 10**6)["certified"])
    ['covers', 'possible', 'stays-1']
    """
    proofs: dict[str, Any] = {}
    for name in rests_on(statement):
        if name not in known:
            return {"unknown": f"it rests on {name}, which is not certified"}
    for name, premise in checker.premises_of(statement, known).items():
        proof = None
        for effort in (1, 2):
            try:
                proof = proof or search_proof(
                    premise, known, Budget(budget), effort=effort, hints=(hints or {}).get(name)
                )
            except Exhausted:
                continue
        if proof is None:
            return {"unknown": f"no proof of the premise {name} was found"}
        proofs[name] = proof
    return {"certified": proofs}
