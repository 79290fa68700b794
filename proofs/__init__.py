"""What the paper says, as claims, and what is proved beside it: content, no engine.

In reading order:

- `deriving`: derived expressions, and how the paper writes such; loads SymPy.
- `paper`: the claims of the paper, section by section.
- `theorem`: the theorem in place of its main result, and the page on it.
- `restitution`, `part`, `sine`: claims about what the paper leaves open.
- `simulations`: what simulations show, as it is kept, and as the scenes compute it.
- `ledger`: what the paper prints, item by item, with the claims of each.
- `opening`, `figures`: what reports show of the theorem: what moves, the proof, the figures.
- `coq`: the development in Coq.

`PAPER` describes it to the tool.  Names for claims of one's own are those of `juggleproof`.
"""

from __future__ import annotations

from typing import Any

import juggleproof
from juggleproof.papers.paper import Paper, Theorem
from juggleproof.proofs import paper, part, restitution, sine, theorem
from juggleproof.proofs.ledger.unprinted import UNPRINTED

PAPER = Paper(
    modules=tuple(
        f"{package.__name__}.{section}"
        for package in (paper, theorem, restitution, part, sine)
        for section in package.SECTIONS
    ),
    checked_apart=(f"{sine.__name__}.everywhere",),
    unprinted=UNPRINTED,
    theorem=Theorem(theorem.THEOREM, theorem.DIGEST, theorem.SENTENCE),
    hooks={
        "explain-bounds": f"{__name__}.theorem.explaining:explain_bounds",
        "explain-state": f"{__name__}.theorem.explaining:explain_state",
        "motion": f"{__name__}.opening:motion",
        "opening": f"{__name__}.opening:opening",
        "proof-claim": f"{__name__}.opening:PROOF",
        "figures": f"{__name__}.figures:TABLE",
        "words": f"{__name__}.counterexample_words:BallAndTable",
    },
)


def __getattr__(name: str) -> Any:
    """A name of `juggleproof`, as claims written for earlier versions import it from here."""
    return getattr(juggleproof, name)
