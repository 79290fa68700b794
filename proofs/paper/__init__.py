"""The paper, section by section: one file of claims a section, in the paper's order.

deriving              derived expressions, and how the paper writes such; loads SymPy
derivations           derived expressions as terms that say what made them
names                 what names stand for, and what happens within a period
states                impacts and their energy, orbits, motion relative to e_1
regions               the states outside the region R
s0_s2_1_setting       title and abstract; the part on the vibrating table
s2_models             the regions H, B1, B2; flight and impact
s3_1_s3_2_coupling    the table, and the ball coupled to it
s3_3_local            the fixed point e_1 and its neighbourhood
s3_4_energy           total energy, and its change by an impact
s3_5_fixed_points     fixed points of composites, periods, stability
s4_1_energy           which impacts gain energy, and the region R
s4_2_proposition      Proposition 1 and its proof
s4_3_kinetic_energy   the kinetic energy about e_1, and whether it decreases
s4_3_2_invariant_set  the band around e_1, and what it attracts; the conclusion
a1_a2_energy          the energy that impacts sustain, and its greatest change
a3_a4_supremum        the least loss outside R, and the count of impacts
b_summary             the summary of appendix B
inclusions            the inclusions of regions that section 4 rests on

What derives the paper's terms loads SymPy; of this package it is loaded when first used, so that
claims of one's own are judged without.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING

from juggleproof.proofs import part, restitution, sine, theorem
from juggleproof.proofs.claims import Claim, claims_in
from juggleproof.proofs.ledger.indexed_claims import IndexedClaims
from juggleproof.symbolic.lazy import lazy_names

if TYPE_CHECKING:
    from juggleproof.proofs.paper.derivations import behind as behind
    from juggleproof.proofs.paper.derivations import derivations_of as derivations_of
    from juggleproof.proofs.paper.derivations import derived as derived
    from juggleproof.proofs.paper.derivations import derived_vector as derived_vector
    from juggleproof.proofs.paper.names import collide as collide
    from juggleproof.proofs.paper.names import definitions as definitions
else:
    LAZY = {  # the same once more, for whoever runs
        ".derivations": "behind derivations_of derived derived_vector",
        ".names": "collide definitions",
    }
    _, __getattr__, __dir__ = lazy_names(__name__, LAZY)

SECTIONS = (
    "s0_s2_1_setting",
    "s2_models",
    "s3_1_s3_2_coupling",
    "s3_3_local",
    "s3_4_energy",
    "s3_5_fixed_points",
    "s4_1_energy",
    "s4_2_proposition",
    "s4_3_kinetic_energy",
    "s4_3_2_invariant_set",
    "a1_a2_energy",
    "a3_a4_supremum",
    "b_summary",
    "inclusions",
)


def modules_of_claims() -> list[str]:
    """The modules of the paper's claims in the paper's order; those of the theorem, of the part and
    of the table that moves as a sine come after them.
    """
    packages = (
        (__name__, SECTIONS),
        (theorem.__name__, theorem.SECTIONS),
        (restitution.__name__, restitution.SECTIONS),
        (part.__name__, part.SECTIONS),
        (sine.__name__, sine.SECTIONS),
    )
    return [f"{package}.{section}" for package, sections in packages for section in sections]


@cache
def claims_by_id() -> Mapping[str, Claim]:
    """The claims of the paper by id, in its order; each loads its module when it is first used."""
    return IndexedClaims(modules_of_claims())


def paper_claims() -> list[Claim]:
    """The claims of the paper in its order."""
    return claims_in(modules_of_claims())
