"""The resources for judging a claim, its judgement, and findings that a later run tries first."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import import_module
from typing import TypedDict

from juggleproof.judging import limits
from juggleproof.judging.claims import Claim, Verdict, as_body, assertions
from juggleproof.statements.language import NO_ROLES, AnyStatement, Roles
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import Store
from juggleproof.statements.vote import ANSWERS, Vote, VoteBudget

ROUTES = ("exact", "z3", "boxes")

# -------------------------------------------------------------------------------------------------
# Findings: the entry of a claim in the file `findings` of a store; it saves time, proves nothing.

# `text` is the corrected LaTeX, the corrected right-hand side, or the true assertion nearby
Correction = TypedDict(
    "Correction",
    {"kind": str, "change": str, "text": str, "possible transcription error": bool},
)


class RecordedVote(TypedDict):
    """A vote in the file of findings."""

    route: str
    answer: str
    detail: str


class RecordedVotes(TypedDict):
    """The votes on one statement, and the digest of the question (`digest_of_question`)."""

    on: str
    votes: list[RecordedVote]


# sharp ranges as text, and digests of searches that found none, both by the prefix of an assertion;
# the correction; the votes by the name of the statement
Finding = TypedDict(
    "Finding",
    {
        "sharp": dict[str, str],
        "not found": dict[str, str],
        "correction": Correction,
        "votes": dict[str, RecordedVotes],
    },
    total=False,
)


def is_finding(data: object) -> bool:
    """Whether data of a file, which anyone may have written, has the shape of a finding."""
    if not isinstance(data, dict) or not data.keys() <= Finding.__annotations__.keys():
        return False
    texts = [*_values(data.get("sharp", {})), *_values(data.get("not found", {}))]
    correction = data.get("correction", dict.fromkeys(Correction.__annotations__, ""))
    if not isinstance(correction, dict) or {*correction} != {*Correction.__annotations__}:
        return False
    if not all(isinstance(correction[name], str) for name in ("kind", "change", "text")):
        return False
    for votes in _values(data.get("votes", {})):
        if not isinstance(votes, dict) or {*votes} != {"on", "votes"}:
            return False
        cast = votes["votes"]
        shaped = isinstance(cast, list) and all(isinstance(one, dict) for one in cast)
        if not shaped or any({*one} != {"route", "answer", "detail"} for one in cast):
            return False
        if any(one["answer"] not in ANSWERS for one in cast):
            return False
        texts += [votes["on"], *(text for one in cast for text in one.values())]
    return all(isinstance(text, str) and text.isprintable() for text in texts)


def _values(data: object) -> list[object]:
    """The values of a mapping; [None] for anything else, so that a test for texts fails."""
    return [*data.values()] if isinstance(data, dict) else [None]


@cache
def _tools() -> str:
    version = import_module("importlib.metadata").version  # loading it takes 0.01 s or more
    return " ".join(version(tool) for tool in ("z3-solver", "python-flint"))


def digest(text: str) -> str:
    """The text together with the versions of the tools that vote and search, in 16 hex digits."""
    return hashlib.sha256(f"{_tools()}\n{text}".encode()).hexdigest()[:16]


def digest_of_question(text: str, budget: VoteBudget) -> str:
    """The digest of all that a vote depends on, apart from our own sources: the text of the
    statement, the budget, and the versions of the tools that vote.
    """
    work = f"rlimit={budget.rlimit}, boxes={budget.boxes}, width={budget.width!r}"
    return digest(f"Budget({work})\n{text}")


# -------------------------------------------------------------------------------------------------
# Resources and judgements.


@dataclass(frozen=True)
class Resources:
    """The resources for judging a claim: the routes that vote, the counted work for each statement,
    and the findings of an earlier run by claim.  `votes` has the recorded votes that need not be
    cast again, by claim and by the digest of the question.

    `lemmas` has the texts of statements of other claims, by name; `checked` has the checker's
    outcomes of the stored statements, by name, from its reading at the start of this run.
    """

    routes: tuple[str, ...] = ROUTES
    budget: int = limits.DEFAULT_BUDGET
    store: Store | None = None
    findings: Mapping[str, Finding] = field(default_factory=dict)
    votes: Mapping[str, Mapping[str, RecordedVotes]] = field(default_factory=dict)
    lemmas: Mapping[str, str] = field(default_factory=dict)
    checked: Mapping[str, str] = field(default_factory=dict)

    def only(self, claim: Claim) -> Resources:
        """The part of these resources that one claim needs, with the stored certificates loaded, so
        that no folder is needed.
        """
        used = {claim.id, *(name.split("/")[0] for name in claim.hints.get("uses", ()))}
        return replace(
            self,
            store=self.store.only(used) if self.store else None,
            findings={id: one for id, one in self.findings.items() if id == claim.id},
            votes={id: one for id, one in self.votes.items() if id == claim.id},
            checked={
                name: outcome
                for name, outcome in self.checked.items()
                if name.split("/")[0] in used
            },
            lemmas={
                name: text
                for name, text in self.lemmas.items()
                if name in claim.hints.get("uses", ())
            },
        )


@dataclass(frozen=True)
class Sharp:
    """A sharp range of the parameters: its text, and the names of the statements that settle it.

    Where the search found none, `tried` is a digest of its question, so that the same search is not
    made again.
    """

    text: str
    by: tuple[str, ...] = ()
    tried: str = ""


@dataclass
class Judgement:
    """The judgement on one claim: plain data, which passes between processes.

    `statements` has names and texts in order; certificates, outcomes and votes are by the name of
    the statement, as is `unproved`: the texts of those premises of map rules for which no proof was
    found.
    """

    id: str
    statements: list[tuple[str, str]] = field(default_factory=list)
    certificates: dict[str, Certificate] = field(default_factory=dict)
    outcomes: dict[str, str] = field(default_factory=dict)
    votes: dict[str, Sequence[Vote]] = field(default_factory=dict)
    unproved: dict[str, list[str]] = field(default_factory=dict)
    sharp: dict[str, Sharp] = field(default_factory=dict)  # by the prefix of an assertion
    verdict: Verdict = field(default_factory=lambda: Verdict("unknown"))
    correction: Correction | None = None
    recorded: dict[str, RecordedVotes] = field(default_factory=dict)
    rests_on: tuple[str, ...] = ()  # map rules, mostly of other claims
    awaits: tuple[str, ...] = ()  # these map rules, and the claim `proved_by` of an argument
    # the verdict if all of `awaits` are certified
    by_rules: Verdict = field(default_factory=lambda: Verdict("unknown"))
    follows: bool = False
    is_conclusion: bool = False
    checked_by: str = ""  # the other checker, for a `CheckedApart`
    roles: Roles = NO_ROLES

    def finding(self) -> Finding:
        """The finding that a later run tries first: sharp ranges, correction and votes."""
        finding: Finding = {"sharp": {prefix: one.text for prefix, one in self.sharp.items()}}
        tried = {prefix: one.tried for prefix, one in self.sharp.items() if one.tried}
        if tried:
            finding["not found"] = tried
        if self.correction:
            finding["correction"] = self.correction
        if self.recorded:
            finding["votes"] = self.recorded
        return finding


def statements_of(claim: Claim, correction: Correction | None = None) -> list[AnyStatement]:
    """The statements of a claim, of its correction and of its remark."""
    found, beside = assertions(claim.body()), claim.shown_beside()
    if correction and correction["kind"] == "nearby" and claim.true_nearby:
        found += assertions(as_body(claim.true_nearby[1](), claim.id))
    elif correction:
        found += assertions(claim.body(claim.read_print(correction["text"])))
    return [part for _, one in found for part in one.parts] + [*(beside.parts if beside else ())]
