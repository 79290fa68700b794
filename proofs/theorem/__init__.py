"""The theorem, that e_1 is globally asymptotically stable exactly for alpha < 1/3, as claims whose
premises the checker writes.
"""

SECTIONS = ("definition", "stability", "orbits")
