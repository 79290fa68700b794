"""Why an item of the paper may need no claim: a closed list, and the claims that no item of the
paper carries.
"""

from __future__ import annotations

# An item that asserts something about the juggler has claims; only what asserts nothing may give
# one of these.
REASONS = {
    "heading": "names a section, a proof or a part of a table",
    "names": "gives or recalls a name or notation, or is a formula that only names a thing",
    "narrative": "says what the text does or hopes, or judges without stating anything exact",
    "modelling-assumption": "sets up the model and cannot follow from anything",
    "figure-or-table": "says what a figure or table shows",
    "reference": "only points to another place",
    "connective": "joins two formulas and adds nothing to them",
}
# These two are followed by the key of another item.
REASONS_WITH_KEY = {
    "part-of": "is a piece of that item, which carries the claims",
    "repeats": "the transcription prints that earlier item again at the same place",
}

_MODES = (
    "sliding",
    "sticking-in-compression",
    "sticking-in-restitution",
    "reversed-in-compression",
    "reversed-in-restitution",
)
# Claims about the paper's system that the paper itself does not print.
UNPRINTED = {
    "region-scaling": "the change to the normal form, through which every other claim is judged",
    "region-trap": (
        "the trap of the theorem's proof, which stands in for the paper's last invariant set"
    ),
    "theorem-roots": "the lemma of the theorem's proofs",
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
    "theorem-sharper": "a bound nearer the worst case than the theorem's",
    "theorem-closed-form": (
        "the orbits in the trap, from which the second bound of the theorem follows"
    ),
    "theorem-count": "which readings of (26) and of the count of impacts hold for which alpha",
    "part-products": "the lemma of the claims about a corner's impact",
    "part-corner": (
        "what an impulse at a corner of the part of section 2.1 does, on which its simulation rests"
    ),
    "part-rectangle": "how much friction the simulation of the part may have",
    **{
        f"part-{mode}": "a mode of a corner's impact: its impulse, and what it guarantees"
        for mode in _MODES
    },
    **{f"part-{mode}-energy": "that an impact in this mode gains no energy" for mode in _MODES},
    "part-modes-cover": "that the modes of a corner's impact leave nothing out",
    "part-modes-agree": "that the modes of a corner's impact do not contradict one another",
    "part-at-rest": "the impact of a corner that does not slide at first",
    "part-newton": "why the simulation of the part has Poisson's restitution and not Newton's",
}
