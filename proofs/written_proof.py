"""The theorem and its written proof for the LaTeX report, from the stored statements."""

from __future__ import annotations

from juggleproof.proofs.opening import PROOF
from juggleproof.reports.contents import Contents, Entry
from juggleproof.reports.latex import latex_of, with_macros
from juggleproof.reports.tex_words import ProofSteps
from juggleproof.reports.words import parts_of

BESIDE = (
    "theorem-one-third",
    "theorem-nearby",
    "theorem-region",
    "theorem-ends",
    "theorem-kinetic",
)


def in_tex(contents: Contents) -> dict[str, object]:
    """What the template of the theorem shows; raises ClaimError for a line of the written proof
    that is not certified.
    """
    by_name = {one.name: one for entry in contents.entries for one in entry.statements}

    def rows(name: str, keyword: str) -> list[str]:
        return [
            line.partition(" ")[2]
            for line in by_name[name].text.splitlines()
            if line.startswith(f"{keyword} ")
        ]

    def formulas(name: str, keyword: str) -> list[str]:
        return [with_macros(latex_of(part)) for part in parts_of(rows(name, keyword)[0])]

    def entry(name: str) -> Entry:
        return contents.entry(name)

    def conjuncts(text: str, most: int | None = None) -> str:
        """The parts of a conjunction, or the first `most`: the last part of a domain may be there
        only for a division.
        """
        return with_macros(",\\; ".join(latex_of(part) for part in text.split(" and ")[:most]))

    steps = ProofSteps(entry(PROOF))
    pieces = [row.partition(" -> ")[::2] for row in rows("theorem/map", "piece")]
    stages = rows("theorem/descends", "stage")
    scaling = next(one for one in contents.derivations if one.function == "scaling")
    return {
        "scaling": ",\\; ".join(
            f"{name} = {with_macros(latex_of(value))}"
            for name, value in zip(("x", "w"), scaling.shown()[0])
        ),
        "guards": [latex_of(guard) for guard, _ in pieces],
        "images": [
            ", ".join(with_macros(latex_of(part)) for part in parts_of(image))
            for _, image in pieces
        ],
        "fixed": formulas("theorem/contracts", "point"),
        "other": formulas("theorem/escapes", "start"),
        "speed": latex_of(rows("theorem/descends", "root")[0].partition("sqrt(")[2][:-1]),
        "rank": formulas("theorem/descends", "rank")[0],
        "stage_1": conjuncts(stages[0]),
        "stage_2": conjuncts(stages[1]),
        "trap": conjuncts(stages[2]),
        "later": len(stages) - 1,
        "below": conjuncts(rows("theorem/descends", "domain")[0], 2),
        "others": conjuncts(rows("theorem/escapes", "domain")[0], 2),
        "space": latex_of(rows("theorem/map", "space")[0]),
        "rate": formulas("theorem/contracts", "rate")[0],
        "given": steps.given,
        "radius": latex_of(rows("theorem/contracts", "radius")[0]),
        "show": steps.show,
        "says": lambda name: entry(name).claim.says,
        "verdict": lambda name: entry(name).verdict,
        "rules": contents.rules,
        "beside": [name for name in BESIDE if name in {one.claim.id for one in contents.entries}],
    }
