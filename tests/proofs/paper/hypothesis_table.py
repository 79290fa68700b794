"""The table of hypotheses, and the search that fills it."""

from __future__ import annotations

import hashlib
import json
import re
import sys
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.conditions import Condition, ring_of
from juggleproof.certificates.language import reals
from juggleproof.certificates.search.certificate import found, search_proof
from juggleproof.certificates.search.points import as_found_point, assignments
from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.certificates.votes.z3 import vote
from juggleproof.certificates.work import Budget, Exhausted
from juggleproof.proofs.paper import names, regions
from juggleproof.proofs.paper import states as orbits

# -------------------------------------------------------------------------------------------------
# What a hypothesis of a certified statement is for, searched: none of this is believed, the checker
# judges what it finds.
#
# A certified statement says P and H => S.  Without H it says P => S, that is, P and not H => S as
# well.  So a counterexample to it meets P and not H, and a proof of P and not H => S shows that H
# is not needed.

NEEDED, LICENSES, NOT_NEEDED, UNDECIDED = "needed", "licenses a division", "not needed", "undecided"
BUDGET = 2_000_000
ATTEMPTS = (
    (True, 0, 20),
    (False, 1, 20),
    (True, 1, 40),
    (False, 2, 60),
    (True, 2, 100),
)  # (refutes, effort, percent of what is left)


@dataclass(frozen=True)
class Hypothesis:
    """One conjunct of a range or given line of a statement: its line, its place in the line, and
    what it says.
    """

    row: int
    part: int
    keyword: str
    said: str


def conjuncts(said: str) -> list[str]:
    """The parts of a conjunction, split where `and` stands outside all parentheses.

    >>> conjuncts("x > 0 and (y > 0 and z > 0 or x = 1)"), conjuncts("x > 0 and y > 0 or z > 0")
    (['x > 0', '(y > 0 and z > 0 or x = 1)'], ['x > 0 and y > 0 or z > 0'])
    """
    depth, parts, begin = 0, [], 0
    for match in re.finditer(r"[()]| and | or ", said):
        depth += {"(": 1, ")": -1}.get(match[0], 0)
        if depth == 0 and match[0] == " or ":
            return [said]
        if depth == 0 and match[0] == " and ":
            parts.append(said[begin : match.start()])
            begin = match.end()
    return [*parts, said[begin:]]


def hypotheses(text: str) -> Iterator[Hypothesis]:
    """Every conjunct of the range and given lines of a statement."""
    for row, line in enumerate(text.splitlines()):
        keyword, _, said = line.partition(" ")
        if keyword in ("range", "given"):
            for part, one in enumerate(conjuncts(said)):
                yield Hypothesis(row, part, keyword, one)


def without(text: str, one: Hypothesis, *instead: str) -> str:
    """The statement without this hypothesis, or with others in its place."""
    rows = text.splitlines()
    parts = conjuncts(rows[one.row].partition(" ")[2])
    parts[one.part : one.part + 1] = instead
    rows[one.row : one.row + 1] = [f"{one.keyword} " + " and ".join(parts)] if parts else []
    return "\n".join(rows)


def obligations(text: str) -> Iterator[tuple[str, str]]:
    """(what is to be shown, statement that shows it) for every have and root line: each follows
    from what stands before it.
    """
    rows = text.splitlines()
    for row, line in enumerate(rows):
        keyword, _, said = line.partition(" ")
        if keyword in ("have", "root"):
            shown = said if keyword == "have" else re.sub(r".*? = sqrt\((.*)\)", r"\1 >= 0", said)
            yield shown, "\n".join([*rows[:row], f"show {shown}"])


def statement_of(text: str) -> checker.Statement:
    """The one statement of a text, read and unfolded by the checker; raises Rejected where it
    cannot be read.
    """
    (statement,) = checker.read_statements(text).values()
    checker.Unfolding(statement, checker.Context())
    return statement


def is_refuted(text: str, refutation: Any) -> bool:
    """Whether the checker accepts these exact values as a counterexample."""
    return bool(
        checker.check_one(statement_of(text), {"refuted": refutation}, {}, {})[0] == "refuted"
    )


def search_need(text: str, one: Hypothesis, budget: int = BUDGET) -> tuple[str, str, Any]:
    """(need, what fails without the hypothesis if not what is shown, counterexample to that or a
    reason).
    """
    plain = without(text, one)
    try:
        statement_of(plain)
    except checker.Rejected as reason:
        if "division" not in str(reason):
            raise
        return LICENSES, "", None
    for shown, obligation in obligations(plain):
        if len(obligation.splitlines()) > one.row and (
            refutation := refuted_among(obligation, [negated_in(obligation, one)], budget // 8)
        ):
            return NEEDED, shown, refutation
    opposite = statement_of(without(text, one, f"not ({one.said})"))
    whole = Budget(budget)
    for refutes, effort, share in ATTEMPTS:
        try:
            part = whole.part(whole.left * share // 100)
            if not refutes:
                if search_proof(opposite, {}, part, effort=effort) is not None:
                    return NOT_NEEDED, "", None
            elif (
                refutation := found(opposite, "counterexample", {}, part, effort)
            ) is not None and is_refuted(plain, refutation):
                return NEEDED, "", refutation
        except Exhausted:
            continue
    refutation = refuted_among(plain, list(special(text, one)), budget // 8)
    return (NEEDED if refutation else UNDECIDED), "", refutation


def is_not_needed(text: str, one: Hypothesis, budget: int = BUDGET) -> bool:
    """Whether the search proves, and the checker accepts, that the statement holds where the
    hypothesis fails as well.
    """
    opposite, whole = statement_of(without(text, one, f"not ({one.said})")), Budget(budget)
    for refutes, effort, share in ATTEMPTS:
        part = whole.part(whole.left * share // 100)
        try:
            if not refutes and search_proof(opposite, {}, part, effort=effort) is not None:
                return True
        except Exhausted:
            continue
    return False


def negated_in(text: str, one: Hypothesis) -> str:
    """A statement without the hypothesis, with its negation in its place."""
    rows = text.splitlines()
    return "\n".join([*rows[: one.row], f"{one.keyword} not ({one.said})", *rows[one.row :]])


def special(text: str, one: Hypothesis) -> Iterator[str]:
    """The statement with simple values in place of the hypothesis: for its own variable, for r and
    g, and for alpha (2 + 2/8 is a square).
    """
    bound = re.fullmatch(r"(\w+) (?:<|<=|>|>=|!=) (\d+(?:/\d+)?)|(\d+) < (\w+)", one.said)
    own = [f"not ({one.said})"]
    if bound:
        name, limit = bound[1] or bound[4], bound[2] or bound[3]
        own = [f"{name} = {limit}{move}" for move in ("", " - 1", " + 1", " - 1/2", " - 3", " + 3")]
    variables = text.split("\nforall ")[1].split("\n")[0].split()
    units = [
        f"{name} = 1" for name in ("r", "g") if name in variables and f"{name} > 0" != one.said
    ]
    for first in own:
        for alpha in (
            ("1/2", "1/4", "3/4", "1/8", "")
            if "alpha" in variables and "alpha" not in one.said
            else ("",)
        ):
            yield without(text, one, *([first, *units] + ([f"alpha = {alpha}"] if alpha else [])))


def refuted_among(plain: str, narrowed: list[str], budget: int) -> Any:
    """A counterexample to the statement among the points of its narrower forms, by samples and by
    Z3's models.
    """
    for text in narrowed:
        try:
            answer = vote(statement_of(text))
            points = [
                f"given {name} = {value}"
                for name, value in answer.model
                if re.fullmatch(r"-?\d+(/\d+)?", value)
            ]
            forms = (
                [with_givens(text, points)]
                if answer.answer == "fails"
                else [text]
                if answer.answer == "unknown"
                else []
            )
            for form in forms:
                refutation = refuted_there(statement_of(plain), statement_of(form), Budget(budget))
                if refutation is not None and is_refuted(plain, refutation):
                    return refutation
        except (checker.Rejected, Exhausted):
            continue
    return None


def with_givens(text: str, givens: list[str]) -> str:
    """The statement with more premises, after all of its own."""
    rows = text.splitlines()
    last = next(row for row, line in enumerate(rows) if line.startswith(("exists ", "show ")))
    return "\n".join([*rows[:last], *givens, *rows[last:]])


def refuted_there(plain: checker.Statement, narrow: checker.Statement, budget: Budget) -> Any:
    """A counterexample to the plain statement at a point that meets the premises of the narrow one
    and, without `exists`, breaks its goal.
    """
    story = checker.Unfolding(narrow, checker.Context())
    parts = [*story.premises, *([] if narrow.get("exists") else [story.goal(False)])]
    condition = Condition.of(story.context, checker.join("and", parts), ring_of(story.context))
    names, integers = list(story.universal), frozenset(story.integers)
    for effort in (0, 1):
        for assignment in islice(assignments(condition, names, integers, budget, effort), 8):
            refutation = as_found_point(
                plain,
                checker.State(checker.Context()),
                assignment,
                names,
                "counterexample",
                {},
                budget,
                None,
                1,
            )
            if refutation is not None:
                return refutation
    return None


# -------------------------------------------------------------------------------------------------
# The table of hypotheses: for each certified statement, what each of its hypotheses is for.
#
#     statement ID/part DIGEST
#     <TAB>hypothesis<TAB>need<TAB>why
#
# `needed`: why is an exact counterexample without it, to what is shown or to a `have` line;
# `licenses a division`: without it the statement cannot be read; `not needed` and `undecided`: why
# is a reason from REASONS.  `python -m tests.proofs.paper.hypothesis_table` writes it anew and
# keeps what an unchanged statement has.

HERE = Path(__file__).resolve().parent
TABLE, GIVEN_REASONS = HERE / "hypotheses.txt", HERE / "hypothesis_reasons.tsv"
REASONS = {
    "standing": (
        "the range of a parameter of the paper, assumed of all its claims: 0 < alpha < 1, r > 0, g"
        " > 0, a whole number of periods >= 1"
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
    for table in (names.WITH_INTEGER_K.ranges, names.WITH_INTEGER_K.givens)
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
        regions.CLOSED_B1,
        regions.ON_R,
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


def read_table(text: str) -> Table:
    table: Table = {}
    for line in text.splitlines():
        if line.startswith("statement "):
            _, name, mark = line.split()
            table[name] = (mark, [])
        elif line.startswith("\t"):
            table[name][1].append(Row(*line[1:].split("\t")))
    return table


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


def renewed(old: Table, jobs: int = 2) -> Table:
    """The table of the statements as they are stored now."""
    texts = certified()
    known = dict(old.values())
    todo = {digest(text): (name, text) for name, text in texts.items() if digest(text) not in known}
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork")) as pool:
        for (mark, (name, _)), rows in zip(todo.items(), pool.map(searched, todo.values())):
            known[mark] = rows
            print(name, sum(row.need == UNDECIDED for row in rows), file=sys.stderr, flush=True)
    return with_reasons({name: (digest(text), known[digest(text)]) for name, text in texts.items()})


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


if __name__ == "__main__":
    TABLE.write_text(write_table(renewed(read_table(TABLE.read_text()) if TABLE.exists() else {})))
