"""Stability as a claim of one's own, and as a file of claims."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from juggleproof.map_stability.findings import MapVerdict
from juggleproof.map_stability.maps import of_rule
from juggleproof.map_stability.search import Outcome, search_stability
from juggleproof.statements.language import ClaimError, MapRule


def stability(rule: MapRule, point: Sequence[str] = ()) -> list[MapRule]:
    """The statements, found by a search, that the map's fixed point is stable and attracts every
    state.  A claim that gives a map alone returns them.

    The map has the name of the claim, since the statements refer to each other by it; `point` names
    the fixed point by its terms, where there are several.  Raises ClaimError, one line, where that
    is not certified for the whole domain and space of the map.

    >>> from juggleproof.map_stability.claiming import stability
    >>> tent = MapRule("tent", (("over", "a"), ("domain", "0 < a and a < 1"), ("state", "x"),
    ...                        ("space", "0 <= x and x <= 1"), ("piece", "a*min(x, 1 - x)")))
    >>> [one.name for one in stability(tent)]
    ['map', 'lyapunov']
    """
    found = search_stability(of_rule(rule, point=point))
    verdict, sentence = found.finding.verdict, found.finding.sentence
    if verdict is not MapVerdict.PROVED:
        raise ClaimError(
            f"{rule.name}: {verdict}: {sentence}; `juggleproof stability` tells what was tried"
        )
    return [replace(one, name=one.name.rpartition("/")[2]) for one in found.proof.rules]


def as_claims(name: str, found: Outcome) -> str:
    """The statements as a file of claims, which `certify`, `explain` and `export` take."""
    rows = []
    for rule in found.proof.rules:
        rows += [f'        MapRule("{rule.name.rpartition("/")[2]}", (']
        rows += [f"            {line!r}," for line in rule.rows]
        rows += ["        )),"]
    says = found.finding.sentence.replace('"', "'")
    return "\n".join(
        [
            "from juggleproof import MapRule, claim",
            "",
            "",
            f'@claim("{name}")',
            f"def map_{re.sub(r'[.-]', '_', name)}_is_settled():",
            f'    """{says[:1].upper() + says[1:]}."""',
            "    return [",
            *rows,
            "    ]",
            "",
        ]
    )
