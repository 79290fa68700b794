"""The judged content of a claim: its statements as formulas over polynomials, apart from how they
are written.
"""

from __future__ import annotations

import re
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.language import Statement
from juggleproof.proofs.claims import Claim, assertions, named_statements
from juggleproof.proofs.reading.meaning import read


def content(claim: Claim, latex: str) -> list[Any]:
    """What would be judged if the claim's print were this LaTeX; equal lists mean the same
    statements.

    Raises ClaimError where the print is refused and checker.Rejected where the statement is.
    """
    body = claim.body(read(latex))
    found: list[Any] = [type(body).__name__, getattr(body, "proved_by", "")]
    for prefix, assertion in assertions(body):
        for part in named_statements(claim.id, prefix, assertion):
            statement = checker.read_statements(part.text())[part.name]
            if isinstance(part, Statement):
                story = checker.Unfolding(statement, checker.Context())
                goals = normal(list(story.goals))
                said = (
                    str(part.show) if goals in (("True",), ("False",)) else ""
                )  # an identity folds to a constant, its relation with it
                found.append(
                    (part.name, normal(list(story.premises)), goals, relations(said), part.exists)
                )
            else:
                found.append(part.text())
    return found


def relations(text: str) -> list[str]:
    """The relation signs of a formula's text, in order."""
    return re.findall(r"<=|>=|!=|[<>=]", text)


def normal(formula: Any) -> Any:
    """A formula with each polynomial as its sorted integer coefficients, up to a positive factor
    (any factor for equations).
    """
    if isinstance(formula, bool):
        return formula
    if isinstance(formula, list):
        return tuple(sorted(map(repr, map(normal, formula))))
    if formula[0] == "atom":
        content_, primitive = formula[1].primitive()
        sign = 1 if content_ > 0 or formula[2] in ("=", "!=") else -1
        return formula[2], tuple(sorted((m, sign * c) for m, c in primitive.terms.items()))
    return formula[0], tuple(sorted(map(repr, map(normal, formula[1]))))
