"""The paper, section by section: one file of claims a section, in the paper's order."""

from __future__ import annotations

from juggleproof.proofs import part, theorem
from juggleproof.proofs.claims import Claim, claims_in

SECTIONS = (
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
    """The modules of the paper's claims in the paper's order; those of the theorem and of the part
    come after them.
    """
    packages = (
        (__name__, SECTIONS),
        (theorem.__name__, theorem.SECTIONS),
        (part.__name__, part.SECTIONS),
    )
    return [f"{package}.{section}" for package, sections in packages for section in sections]


def paper_claims() -> list[Claim]:
    """The claims of the paper in its order."""
    return claims_in(modules_of_claims())
