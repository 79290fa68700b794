"""The table of hypotheses: for each certified statement, what each of its hypotheses is for.

    statement ID/part DIGEST
    <TAB>hypothesis<TAB>need<TAB>why

`needed`: why is an exact counterexample without it, to what is shown or to a `have` line;
`licenses a division`: without it the statement cannot be read; `not needed` and `undecided`: why is
a reason from REASONS.  It takes minutes: `python -m tests.proofs.paper.hypothesis_table` writes it
to build/hypotheses.txt, and what tests expect of it, the counts and the undecided, beside this
file.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections import Counter
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

from juggleproof.certificates import checker
from juggleproof.proofs.paper import names
from juggleproof.proofs.paper import states as orbits
from juggleproof.proofs.sine.bounces import TABLE as TABLE_VOCABULARY
from juggleproof.statements.language import reals
from juggleproof.statements.store import DEFAULT, Store
from tests.proofs.paper.search_needs import (
    LICENSES,
    NEEDED,
    UNDECIDED,
    Hypothesis,
    conjuncts,
    hypotheses,
    is_refuted,
    obligations,
    search_need,
    statement_of,
    without,
)

HERE = Path(__file__).resolve().parent
TABLE = HERE.parents[2] / "build" / "hypotheses.txt"
GIVEN_REASONS = HERE / "hypothesis_reasons.tsv"
COUNTS, OPEN = HERE / "hypothesis_counts.tsv", HERE / "hypotheses_undecided.tsv"
SAMPLE = 93  # one claim in so many: six, which have hypotheses of every need and take seconds
REASONS = {
    "standing": (
        "the range of a parameter, assumed of all claims of the paper: 0 < alpha < 1, r > 0, g > 0,"
        " a whole number of periods >= 1; or of those on the sine: 0 <= alpha < 1, pi, Gamma > 0"
    ),
    "states": "the claim is about the states of this region of the plane",
    "impact": (
        "the claim is about an impact, at which ball and table are at one height and approach each"
        " other"
    ),
    "times": "the claim is about the times of one period",
    "shared": "one claim, one set of hypotheses: another statement of the claim needs it",
    "proved": "a step of the claim that another of its statements proves",
    "printed": "the paper prints it with the claim",
    "read": "it is what words of the claim come to; this statement needs less",
}
STANDING = [
    str(formula)
    for vocabulary in (names.WITH_INTEGER_K, TABLE_VOCABULARY)
    for table in (vocabulary.ranges, vocabulary.givens)
    for formulas in table.values()
    for formula in formulas
]
TIMES = re.compile(r"(t|tau|since) >= 0|(t|tau|since) <=? T")


class Row(NamedTuple):
    """What one hypothesis of a statement is for."""

    said: str
    need: str
    why: str


Table = dict[str, tuple[str, list[Row]]]


def digest(text: str) -> str:
    return hashlib.sha256(text.partition("\n")[2].encode()).hexdigest()[:12]


@cache
def certified() -> dict[str, str]:
    """The certified statements that hold for all values of their variables."""
    store = Store(DEFAULT)
    return {
        name: text
        for name, text in store.texts.items()
        if "certified" in (store.certificate(name, text) or {})
        and not re.search("^(sharp|iterates) ", text, re.MULTILINE)
    }


# --------------------------------------------------------- counterexamples, short where they can be


def written(name: str, fails: str, refutation: Any) -> str:
    """`x = 1, y = 2` or JSON where the point takes more than rational values; before it what fails,
    if not what is shown.
    """
    _, adjoined, values, *nodes = refutation
    plain = not adjoined and nodes == [["close"], ["close"]]
    point = (
        ", ".join(f"{key} = {value}" for key, value in values.items())
        if plain
        else json.dumps(refutation[1:], separators=(",", ":"))
    )
    return (f"{fails} fails at " if fails else "at ") + point


def counterexample(name: str, why: str) -> tuple[str, Any]:
    """What fails, and the counterexample in the checker's form."""
    fails, _, point = (
        why.rpartition("fails at ") if " fails at " in why else ("", "", why.removeprefix("at "))
    )
    if point.startswith("["):
        return fails.strip(), [name, *json.loads(point)]
    return fails.strip(), [
        name,
        [],
        dict(one.split(" = ") for one in point.split(", ")),
        ["close"],
        ["close"],
    ]


# ------------------------------------------------------------ reasons


@cache
def meanings() -> dict[str, str]:
    """What the conditions for regions and impacts say, as statements write them, and the reason
    that they are.
    """
    b, b_0, f1 = names.b, orbits.b_0, names.f1
    inside = (
        names.H,
        names.STRIKES,
        names.B1,
        names.B2,
        names.R,
        names.B1_ZERO,
        names.B1_PLUS,
        names.CLOSED_B1,
        names.ON_R,
    )
    states = [region(state) for region in inside for state in (b, b_0)] + [
        names.H(f1(b)),
        names.H(names.f2(b)),
    ]
    t, tau = reals("t tau")
    impacts = [names.strikes_at(t), names.meet(t)]
    impacts += [
        orbits.strikes_from(start, time)
        for start in (b, b_0, names.vector(f1(b)))
        for time in (t, tau)
    ]
    found = {
        part: word
        for word, formulas in (("impact", impacts), ("states", states))
        for one in formulas
        for part in conjuncts(str(one))
    }
    return {said: word for said, word in found.items() if not TIMES.fullmatch(said)}


def reason(name: str, one: Hypothesis, tables: Mapping[str, list[Row]]) -> str:
    """The reason from REASONS why a hypothesis that is not known to be needed stands in a
    statement; empty where there is none.
    """
    if one.said in STANDING:
        return "standing"
    if TIMES.fullmatch(one.said):
        return "times"
    if one.said in meanings():
        return meanings()[one.said]
    family = [
        other for other in tables if other.split("/")[0] == name.split("/")[0] and other != name
    ]
    for other in family:
        if any(row.said == one.said and row.need in (NEEDED, LICENSES) for row in tables[other]):
            return f"shared: {other.split('/')[1]}"
    for other in family:
        if certified()[other].endswith(f"\nshow {one.said}"):
            return f"proved: {other.split('/')[1]}"
    return next(
        (
            why
            for (of, said), why in given_reasons().items()
            if of == name and is_meant(one.said, said)
        ),
        "",
    )


@cache
def given_reasons() -> dict[tuple[str, str], str]:
    """The reasons that a reader gave, from the file beside this one: (statement, hypothesis or how
    it begins): reason.
    """
    rows = [
        line.split("\t")
        for line in GIVEN_REASONS.read_text().splitlines()
        if line and not line.startswith("#")
    ]
    return {(name, said): why for name, said, why in rows}


def is_meant(said: str, meant: str) -> bool:
    """Whether a hypothesis is the one that a reason is given for.

    >>> is_meant("n < x + 1", "n < ..."), is_meant("x < 1", "x < 2")
    (True, False)
    """
    return said.startswith(meant.removesuffix("...")) if meant.endswith("...") else said == meant


# ------------------------------------------------------------ the file


def write_table(table: Table) -> str:
    lines = [
        "# What each hypothesis of each certified statement is for; generated by"
        " tests/proofs/paper/hypothesis_table.py."
    ]
    lines += [f"# {word}: {meaning}." for word, meaning in REASONS.items()]
    for name, (mark, rows) in table.items():
        lines += [f"statement {name} {mark}", *("\t" + "\t".join(row) for row in rows)]
    return "\n".join(lines) + "\n"


def searched(job: tuple[str, str]) -> list[Row]:
    """The rows of one statement, searched; reasons are given later."""
    name, text = job
    rows = []
    for one in hypotheses(text):
        need, fails, refutation = search_need(text, one)
        rows.append(Row(one.said, need, written(name, fails, refutation) if need == NEEDED else ""))
    return rows


def with_reasons(table: Table) -> Table:
    """The table with the reasons of what is not needed or undecided."""
    rows_of = {name: rows for name, (_, rows) in table.items()}
    new: Table = {}
    for name, (mark, rows) in table.items():
        new[name] = (
            mark,
            [
                (
                    row
                    if row.need in (NEEDED, LICENSES)
                    else row._replace(why=reason(name, one, rows_of))
                )
                for row, one in zip(rows, hypotheses(certified()[name]), strict=True)
            ],
        )
    return new


def searched_table(texts: Mapping[str, str], jobs: int | None = None) -> Table:
    """The table of these statements, which are all those of their claims; statements that differ in
    nothing but their name are searched once.
    """
    todo = {digest(text): (name, text) for name, text in texts.items()}
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork")) as pool:
        rows = dict(zip(todo, pool.map(searched, todo.values())))
    return with_reasons({name: (digest(text), rows[digest(text)]) for name, text in texts.items()})


def is_sampled(name: str) -> bool:
    """Whether the statement is one of the sample, which depends on nothing but the claim's name."""
    claim = name.partition("/")[0]
    return int(hashlib.sha256(claim.encode()).hexdigest()[:8], 16) % SAMPLE == 0


def counts(table: Table) -> Counter[tuple[str, str]]:
    """How many hypotheses there are of each need and, where it is not known to be needed, of each
    kind of reason.
    """
    return Counter(
        (row.need, "" if row.need in (NEEDED, LICENSES) else row.why.partition(":")[0])
        for _, rows in table.values()
        for row in rows
    )


def undecided(table: Table) -> set[tuple[str, str]]:
    """The hypotheses, with their statements, of which it is not known whether they are needed."""
    return {
        (name, row.said)
        for name, (_, rows) in table.items()
        for row in rows
        if row.need == UNDECIDED
    }


def cells(path: Path) -> list[list[str]]:
    """The rows of a file of cells that tabs separate, without its heading."""
    return [line.split("\t") for line in path.read_text(encoding="utf-8").splitlines()[1:]]


def write_expected(table: Table) -> None:
    """Writes what tests expect: the counts of the whole and of the sample, and the undecided."""
    every = counts(table)
    sample = counts({name: rows for name, rows in table.items() if is_sampled(name)})
    lines = ["need\treason\tall\tsample"]
    lines += [
        f"{need}\t{why}\t{n}\t{sample[need, why]}" for (need, why), n in sorted(every.items())
    ]
    COUNTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    lines = ["statement\thypothesis", *("\t".join(one) for one in sorted(undecided(table)))]
    OPEN.write_text("\n".join(lines) + "\n", encoding="utf-8")


def checked(name: str, text: str, one: Hypothesis, row: Row) -> bool:
    """Whether the checker accepts the counterexample of a row, or cannot read the statement without
    the hypothesis, as the row says.
    """
    plain = without(text, one)
    if row.need == LICENSES:
        try:
            statement_of(plain)
        except checker.Rejected as problem:
            return "division" in str(problem)
        return False
    fails, refutation = counterexample(name, row.why)
    return is_refuted(dict(obligations(plain))[fails] if fails else plain, refutation)


def main() -> None:
    table = searched_table(certified())
    TABLE.parent.mkdir(exist_ok=True)
    TABLE.write_text(write_table(table), encoding="utf-8")
    write_expected(table)


if __name__ == "__main__":
    main()
