"""What the paper says, as claims; the command that derives, proves and checks them; and the
language for claims of one's own.

In reading order, each importing those before it only:

- `reading`: a print's LaTeX becomes values and formulas.
- `claims`, `forms`: an assertion with its place and print, the statements that it makes, verdicts.
- `encoding`: SymPy expressions as terms.
- `correcting`, `rules`, `ranges`: prints that may mend a refuted one; ranges of the parameters.
- `evaluating`: terms and formulas at rational values; counterexamples at simple ones.
- `orbit_rules`: the checker's rules for orbits in words, and why a premise of one has no proof.
- `judgement`, `judging`: one claim, stated, settled by the checker, corrected, with its sharp
  range.
- `register`: the verdicts that stand.
- `checked`, `run`: the checker's outcomes of what is stored; many claims over processes.
- `bounds`, `kept`, `extras`: certified enclosures of minima; figures kept between runs; libraries
  of the optional extras.
- `simulations`: what simulations show, as it is kept, and as the scenes compute it.
- `paper`, `theorem`, `part`, `ledger`, `smtlib`: the claims themselves; scripts of SMT-LIB.
- `reports`, `api`: what a run came to, in words, pages and data; the same from Python.
- `command`, `pytest_plugin`, `pytest_items`: the command line; claims as test items.
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
from juggleproof.proofs.claims import (
    Argument,
    Assertion,
    Claim,
    Following,
    NotFormalised,
    Reading,
    Readings,
    Remark,
    Simulated,
    claim,
)
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
    "NotFormalised",
    "Reading",
    "Readings",
    "Remark",
    "Simulated",
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
