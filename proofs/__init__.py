"""What the paper says, as claims; the command that derives, proves and checks them; and the
language for claims of one's own.

In reading order, each importing those before it only:

- `reading`: a print's LaTeX becomes values and formulas.
- `claims`, `forms`: an assertion with its place and print, the statements that it makes, verdicts.
- `encoding`: SymPy expressions as terms.
- `correcting`: prints that may mend a refuted one.
- `evaluating`: terms and formulas at rational values; counterexamples at simple ones.
- `conclusions`, `orbit_rules`: what a certified rule for orbits says; rules as a claim writes them.
- `searches`: certificates, votes and sharp ranges are searched, which loads when first asked.
- `rule_ranges`: the parameters for which the conclusion of a rule is proved.
- `judgement`, `judging`: one claim, stated, settled by the checker, corrected, with its sharp
  range.
- `register`: the verdicts that stand.
- `checked`, `run`: the checker's outcomes of what is stored; many claims over processes.
- `bounds`, `kept`, `extras`: certified enclosures of minima; figures kept between runs; libraries
  of the optional extras.
- `simulations`: what simulations show, as it is kept, and as the scenes compute it.
- `paper`, `theorem`, `part`, `sine`, `ledger`, `smtlib`: the claims themselves; scripts of SMT-LIB.
- `reports`, `api`: what a run came to, in words, pages and data; the same from Python.
- `command`, `pytest_plugin`, `pytest_items`: the command line; claims as test items.

A name loads its file when first used (PEP 562), so that no command loads what another needs.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from juggleproof.certificates.language import ClaimError as ClaimError
    from juggleproof.certificates.language import Formula as Formula
    from juggleproof.certificates.language import Iterates as Iterates
    from juggleproof.certificates.language import MapRule as MapRule
    from juggleproof.certificates.language import Statement as Statement
    from juggleproof.certificates.language import Term as Term
    from juggleproof.certificates.language import conjunction as conjunction
    from juggleproof.certificates.language import different as different
    from juggleproof.certificates.language import disjunction as disjunction
    from juggleproof.certificates.language import equal as equal
    from juggleproof.certificates.language import iff as iff
    from juggleproof.certificates.language import implies as implies
    from juggleproof.certificates.language import real as real
    from juggleproof.certificates.language import reals as reals
    from juggleproof.certificates.language import term as term
    from juggleproof.proofs.claims import Argument as Argument
    from juggleproof.proofs.claims import Assertion as Assertion
    from juggleproof.proofs.claims import Claim as Claim
    from juggleproof.proofs.claims import Following as Following
    from juggleproof.proofs.claims import NotFormalised as NotFormalised
    from juggleproof.proofs.claims import Reading as Reading
    from juggleproof.proofs.claims import Readings as Readings
    from juggleproof.proofs.claims import Remark as Remark
    from juggleproof.proofs.claims import Simulated as Simulated
    from juggleproof.proofs.claims import claim as claim
    from juggleproof.proofs.forms import always as always
    from juggleproof.proofs.forms import exists_some as exists_some

else:
    PLACES = {  # the same once more, for whoever runs
        "certificates.language": (
            "ClaimError Formula Iterates MapRule Statement Term conjunction different disjunction"
            " equal iff implies real reals term"
        ),
        "proofs.claims": (
            "Argument Assertion Claim Following NotFormalised Reading Readings Remark Simulated"
            " claim"
        ),
        "proofs.forms": "always exists_some",
    }
    FILES = {name: file for file, names in PLACES.items() for name in names.split()}
    __all__ = sorted(FILES)

    def __getattr__(name):
        if name not in FILES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return getattr(import_module(f"juggleproof.{FILES[name]}"), name)
