"""What the paper says, as claims, and what is proved beside it: content, no engine.

In reading order:

- `deriving`: derived expressions, and how the paper writes such; loads SymPy.
- `paper`: the claims of the paper, section by section.
- `theorem`: the theorem in place of its main result, and the page on it.
- `restitution`, `part`, `sine`: claims about what the paper leaves open.
- `simulations`: what simulations show, as it is kept, and as the scenes compute it.
- `ledger`: what the paper prints, item by item, with the claims of each.
- `opening`, `written_proof`, `figures`, `templates`: what reports show of the theorem: what moves,
  the proof, the figures.
- `notation`, `sections`: the paper's symbols and headings.
- `coq`: the development in Coq.

`PAPER` describes it to the tool.  Names for claims of one's own are those of `juggleproof`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import juggleproof
from juggleproof.papers.paper import Paper, Publication, Theorem
from juggleproof.proofs import paper, part, restitution, sine, theorem
from juggleproof.proofs.ledger.unprinted import UNPRINTED
from juggleproof.proofs.sections import APPENDICES, HEADINGS

PAPER = Paper(
    modules=tuple(
        f"{package.__name__}.{section}"
        for package in (paper, theorem, restitution, part, sine)
        for section in package.SECTIONS
    ),
    publication=Publication(
        title="Global asymptotic stability of a passive juggling strategy: a possible parts-feeding"
        " method",
        authors="P. J. Swanson, R. R. Burridge and D. E. Koditschek",
        year=1995,
        topic="Passive juggling",
        about="a ball bounces on a table that itself moves as a lossless bouncing ball",
        keywords="juggling, impact, restitution, global asymptotic stability",
        key="SwansonBurridgeKoditschek1995",
    ),
    checked_apart=(f"{sine.__name__}.everywhere",),
    unprinted=UNPRINTED,
    theorem=Theorem(
        theorem.THEOREM, theorem.DIGEST, theorem.SENTENCE, theorem.WITNESS, theorem.EXPLAINED
    ),
    principles="Newton's equation, momentum balance, restitution and the launch of the table",
    parameter="alpha",
    domain="0 < alpha < 1",
    letters="""\
alpha is the restitution, 0 < alpha < 1; r the table's launch speed, g gravity; beta and v the \
ball's height and velocity when the table is
at its lowest; """,
    enters=("sA.3.2-sup3",),
    appendices=APPENDICES,
    headings=HEADINGS,
    pages=("README.md", "docs/results.md", "docs/errata.md", "docs/remarks.md"),
    templates=Path(__file__).parent / "templates",
    hooks={
        "explain-bounds": f"{__name__}.theorem.explaining:explain_bounds",
        "explain-state": f"{__name__}.theorem.explaining:explain_state",
        "motion": f"{__name__}.opening:motion",
        "opening": f"{__name__}.opening:opening",
        "proof-claim": f"{__name__}.opening:PROOF",
        "figures": f"{__name__}.figures:TABLE",
        "notation": f"{__name__}.notation:NOTATION",
        "proof-figure": f"{__name__}.opening:TRAP",
        "theorem-tex": f"{__name__}.written_proof:in_tex",
        "words": f"{__name__}.counterexample_words:BallAndTable",
    },
)


def __getattr__(name: str) -> Any:
    """A name of `juggleproof`, as claims written for earlier versions import it from here."""
    return getattr(juggleproof, name)
