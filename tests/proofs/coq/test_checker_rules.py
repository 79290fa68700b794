"""The rules of the checker in Coq: they accept and reject the certificates of its tables as the
checker does, a rule that checks less is not proved, and all rest on the axioms of the reals only.
"""

from __future__ import annotations

import json
import re

import pytest

from juggleproof.certificates import checker
from tests.certificates.checker.harness import Case, judge
from tests.certificates.checker.rules import TABLES
from tests.proofs.coq.development import SOURCES, Coq, rejects, rest_on_the_reals, source, theorems
from tests.proofs.coq.model import HEAD, NotWritten, accepted
from tests.share import share

# The tables of what is not among Coq's functions.
ELSEWHERE = {"iterates"}
# One change in so many; with JUGGLEPROOF_MUTANTS=many each.
SHARE = share(3, 1)
FILES = (
    *("Polynomials", "Formulas", "Bernstein", "States", "Coefficients", "Boxes"),
    *("Instances", "Leaves", "Values", "Settling", "Ranges"),
)


@pytest.mark.exhaust
def test_the_rules_rest_on_the_axioms_of_the_reals_alone_holds(development: Coq) -> None:
    asked = [
        f"{file}.{name}"
        for file in FILES
        for name in theorems(source(f"{file}.v"), "Theorem|Lemma")
    ]
    assert len(asked) > 100 and "Leaves.closes_sound" in asked
    assert rest_on_the_reals(development, asked)


def test_every_proof_rule_is_one_of_coqs_holds() -> None:
    text = source("Leaves.v")
    (cases,) = re.findall(r"^Inductive node :=\n(.*?)\.\n", text, re.DOTALL | re.MULTILINE)
    page = (SOURCES.parents[1] / "docs" / "certificates.md").read_text()
    rules = re.findall(r"^### `(\w+)`", page.split("## Proof rules")[1].split("\n## ")[0], re.M)
    assert {name.lower() for name in re.findall(r"\| (\w+)", cases)} == set(rules)


# (file, what is weakened, what stands in its place), of theorems: the functions that Coq has of the
# proof rules are compared with the checker on what the tables reject.
WEAKER = {
    "first-iterate": ("Rules", "(forall s, after O s = s) ->", "(forall s : State, s = s) ->"),
    "two-domains": (
        "Rules",
        "Exists (fun domain : Prop => domain) (inside :: outside) -> ",
        "True -> ",
    ),
    "not-refuted": ("Rules", "Forall (fun domain : Prop => domain -> ~ concluded) outside", "True"),
    "another-point": (
        "Rules",
        "other j) -> (forall j, other j = point j) ->",
        "other j) -> True ->",
    ),
    "pieces-overlap": ("Rules", "guard i s -> ~ guard k s.", "guard i s -> False -> ~ guard k s."),
    "pieces-with-gaps": (
        "Rules",
        "exists k, (k < count)%nat /\\ guard k s.",
        "exists k, guard k s.",
    ),
    "after-the-point": ("Relation", "next t u -> forall j,", "next s u -> forall j,"),
    "loss-at-the-point": ("Lyapunov", "0 <= v -> 0 <= loss s v.", "0 <= v -> -1 <= loss s v."),
    "direction-elsewhere": (
        "Lyapunov",
        "close coordinate point d (direction d) /\\",
        "close coordinate point (d + 1) (direction d) /\\",
    ),
    "inner-space-beside-the-point": (
        "Lyapunov",
        "space s -> close coordinate point radius s -> inner s) ->",
        "space s -> close coordinate point 0 s -> inner s) ->",
    ),
    "one-change": (
        "Bernstein",
        "  Hypothesis at_most_0_before : forall j, (j < k)%nat -> c j <= 0.\n",
        "",
    ),
    "later-change": (
        "Bernstein",
        "  Hypothesis at_least_0_after : forall j, (k <= j <= n)%nat -> 0 <= c j.\n",
        "",
    ),
    "first-sign": ("Bernstein", "  Hypothesis first_negative : c O < 0.\n", ""),
    "last-sign": ("Bernstein", "  Hypothesis last_positive : 0 < c n.\n", ""),
    "outside-the-box": (
        "Bernstein",
        "Definition in_box (t : nat -> R) : Prop := forall i, 0 <= t i <= 1.",
        "Definition in_box (t : nat -> R) : Prop := forall i, 0 <= t i.",
    ),
}


def test_every_change_is_of_a_line_that_is_there_holds() -> None:
    absent = [name for name, (file, old, _) in WEAKER.items() if old not in source(f"{file}.v")]
    assert not absent


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(WEAKER)[::SHARE])
def test_rejects_a_weaker_rule(name: str, development: Coq) -> None:
    file, old, new = WEAKER[name]
    assert rejects(development, f"{file}.v", old, new)


# What a certificate that has no shape, or names what is not there, ends in before Coq is asked.
SHAPELESS = (NotWritten, checker.Rejected, ValueError, TypeError, LookupError)


def written(case: Case) -> str:
    """What Coq is asked of the last statement of a case."""
    known, earlier = {}, {}
    *before, last = checker.read_statements(case.text).values()
    for statement in before:
        outcome, _ = checker.check_one(statement, case.earlier[statement.name], known, earlier)
        earlier[statement.name] = statement
        if outcome == "certified":
            known[statement.name] = statement
    return accepted(last, json.loads(json.dumps(case.certificate)), known, earlier)


@pytest.mark.exhaust
def test_coq_accepts_what_the_checker_accepts_and_nothing_else_holds(development: Coq) -> None:
    asked, expected = [], []
    for rule, module in TABLES.items():
        for case in [*module.ACCEPTED, *module.REJECTED]:
            outcome = judge(case)[0]
            if outcome == "unreadable":
                continue
            fine = outcome in ("certified", "refuted")
            try:
                asked.append(written(case))
            except SHAPELESS:
                assert not fine or rule in ELSEWHERE, (rule, case.defect)
                continue
            expected.append((rule, case.defect, "true" if fine else "false"))
    text = HEAD + "".join(f"Eval vm_compute in ({question}).\n" for question in asked)
    answer = development.ask(text)
    assert answer.accepted, answer.output
    said = re.findall(r"= (true|false)\s+: bool", answer.output)
    assert len(said) == len(expected)
    differ = [one for one, value in zip(expected, said) if one[2] != value]
    assert differ == []
    assert said.count("true") > 130 and said.count("false") > 130
