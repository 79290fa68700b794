"""The theorem, that e_1 is globally asymptotically stable exactly for alpha < 1/3, as claims whose
premises the checker writes.

    definition     the map, rank, stages and rates, and the statements that come of them
    stability      the rules, the written proof, alpha = 1/3, and Proposition 1
    orbits         flights, where stability ends, and bounds that come near the worst case
    quantities     what is certified of one state, in exact numbers
    explaining     `explain theorem`: the paper's bounds and ours, and one state with its orbit
    coq            the texts of the definition for Coq, and Statements.v
    coq_templates  the parts of Statements.v without data
"""

SECTIONS = ("definition", "stability", "orbits")
THEOREM = "theorem-in-units/exactly"
# of the statements that the theorem and all that it rests on are, as the sources write them: a
# certified statement of the same name may say anything
DIGEST = "f04e6abda0ad366483f97f4d3c08568e3fb46b61d5c96b1b247c08449e6b4193"
SENTENCE = (
    "for 0 < alpha < 1, e_1 is stable and attracts every state of H if and only if alpha < 1/3"
)
WITNESS = (  # who proves it too
    "`make coq` in a checkout proves the same from the definition of the map",
    "alone, and from flight and impact that ball and table settle in continuous time",
)
EXPLAINED = (  # where its proof can be read
    "docs/theorem.md; `juggleproof explain theorem-by-hand` has its lines, `juggleproof report`"
    " prints them"
)
