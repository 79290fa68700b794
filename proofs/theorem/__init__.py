"""The theorem, that e_1 is globally asymptotically stable exactly for alpha < 1/3, as claims whose
premises the checker writes.
"""

SECTIONS = ("definition", "stability", "orbits")
THEOREM = "theorem-in-units/exactly"
SENTENCE = (
    "for 0 < alpha < 1, e_1 is stable and attracts every state of H if and only if alpha < 1/3"
)
