"""Claims about the paper's system, and about the table that it leaves open, that the paper itself
does not print; each with its reason.
"""

from juggleproof.symbolic.modes import MODES

UNPRINTED = {
    "region-scaling": "the change to the normal form, through which every other claim is judged",
    "region-K-size": "which bands around e_1 are kept, where (32) says nothing of epsilon",
    "region-Emax-B1": "what is kept for alpha < 1/3, where B1 and R together are not",
    "region-trap": (
        "the trap of the theorem's proof, which stands in for the paper's last invariant set"
    ),
    "theorem-roots": "numbers compare as their squares do",
    "theorem": (
        "the theorem in normal form, which 4.4 concludes from an argument that does not carry it"
    ),
    "theorem-by-hand": "the lines of the written proof, which reports print",
    "theorem-in-units": "the theorem in the paper's units, on which the claims of 4.3 and 4.4 rest",
    "theorem-nearby": "the neighbourhood that e_1 attracts, on which a claim of 3.3 rests",
    "theorem-one-third": "the orbits at alpha = 1/3, where the paper's range ends",
    "theorem-region": "Proposition 1 with the number of periods, on which the claims of 4.2 rest",
    "theorem-flights": "the argument by flights, which says why the bound is 1/3",
    "theorem-kinetic": (
        "what is true of the kinetic energy in place of the decrease that 4.3 claims"
    ),
    "theorem-ends": "the stability of e_K where its range begins, which 3.5.3 claims wrongly",
    "theorem-E-max": "the energy that orbits keep to, which (22) and what follows leave unsaid",
    "theorem-sharper": "a bound that is smaller than the theorem's for great energies",
    "theorem-closed-form": (
        "the orbits in the trap, from which the second bound of the theorem follows"
    ),
    "theorem-count": "which readings of (26) and of the count of impacts hold for which alpha",
    "restitution-flights": "the map from impact to impact, by which orbits from 1/3 on are judged",
    "restitution-e-K": "a box that e_K attracts, for every K and restitution for which it exists",
    "restitution-e-K-none": "that e_K exists just for these restitutions",
    "restitution-e-K-begins": "that e_K attracts nothing else where its range begins",
    "restitution-to-a-half": "that for 1/3 < alpha < 1/2 every orbit tends to e_1 or e_2",
    "restitution-half": "the same at alpha = 1/2, but for four states",
    "restitution-to-three-fifths": "that every orbit tends to e_1, e_2 or e_3, 1/2 < alpha < 3/5",
    "restitution-three-fifths": "the same at alpha = 3/5, but for five states",
    "restitution-to-two-thirds": "that every orbit tends to e_1, .. or e_4, 3/5 < alpha < 2/3",
    "restitution-two-thirds": "the same at alpha = 2/3, but for six states",
    "restitution-to-five-sevenths": "that every orbit tends to e_1, .. or e_5, 2/3 < alpha < 5/7",
    "restitution-five-sevenths": "the same at alpha = 5/7, but for seven states",
    "restitution-beyond-five-sevenths": "that every orbit tends to e_1, .. or e_6, up to a_c",
    "restitution-unequal": "an orbit of unequal flights, no e_K, that attracts a box",
    "restitution-unequal-ends": "the restitutions for which that orbit exists",
    "restitution-unequal-room": "the restitutions for which it attracts a box",
    "part-products": "the lemma of the claims about a corner's impact",
    "part-jamming": "how much friction the simulation may have for a part of any shape",
    "part-rectangle": "how much friction the simulation of the part may have",
    **{f"part-{mode}-energy": "that an impact in this mode gains no energy" for mode in MODES},
    "part-at-rest": "the impact of a corner that does not slide at first",
    "part-newton": "why the simulation of the part has Poisson's restitution and not Newton's",
    "sine-bounces": "the bounces of one period on a table that moves as a sine",
    "sine-birth": "the drive at which they are born",
    "sine-multipliers": "the multipliers of the bounce, from flight and impact",
    "sine-stable": "where the bounce is stable",
    "sine-other": "that the other bounce is a saddle",
    "sine": "drives and restitutions for which every motion tends to one bounce",
}
