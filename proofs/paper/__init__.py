"""The paper, section by section: one file of claims a section, in the paper's order."""

from __future__ import annotations

import sys
from importlib import import_module, reload

SECTIONS = (
    "s2_2_1_regions",
    "s2_2_2_models",
    "s2_3_control",
    "s3_1_table",
    "s3_2_coupling",
    "s3_3_local",
    "s3_3_1_extension",
    "s3_4_energy",
    "s3_5_fixed_points",
    "s3_5_2_energy_of_fixed_points",
    "s3_5_3_local_stability",
    "s4_1_energy_boundary",
    "s4_2_proposition",
    "s4_3_kinetic_energy",
    "s4_3_2_invariant_set",
    "s4_4_attractor",
    "a1_sustainable_energy",
    "a2_energy_change",
    "a3_supremum",
    "a4_impacts",
    "b_time_and_regions",
    "b_dynamics",
    "b_notation",
    "inclusions",
)


def load_claims() -> None:
    """Registers every claim of the paper, in the paper's order, and those of the theorem and of the
    part after them.
    """
    from proofs import part, theorem

    loaded = set(sys.modules)
    packages = (
        (__name__, SECTIONS),
        (theorem.__name__, theorem.SECTIONS),
        (part.__name__, part.SECTIONS),
    )
    for name in (f"{package}.{section}" for package, sections in packages for section in sections):
        module = import_module(name)
        if (
            name in loaded
        ):  # its claims were registered then: they are registered again, here and in order
            reload(module)
