"""The paper, section by section: one file of claims a section, in the paper's order.

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
"""

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
