"""All that reports tell, gathered once: claims with verdicts, derivations and statements; the
theorem's tree; what differs from the register.

Verdicts are judged again from the store, by what the checker said of these very files; nothing is
taken from the register.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from certificates import checker
from certificates.statements import rests_on
from certificates.store import DEFAULT, Store
from proofs.checking import results_for
from proofs.claims import Claim
from proofs.command import errata, table, tree
from proofs.command.certify import FINDINGS, entry
from proofs.command.show import counterexample, reading_of
from proofs.derivations import Derivation, behind, body_and_derivations, kept_derivations
from proofs.following import settle_by_rules
from proofs.judging import DEFAULT_BUDGET, Judgement, Options
from proofs.loading import paper_claims
from proofs.recall import NOT_AS_KEPT, Records, judge_with_records
from proofs.records import body_of
from proofs.register import PATH, changes, load_register
from proofs.running import judge_all, lemmas
from proofs.verdicts import VERDICTS

TOOLS = ("sympy", "mpmath", "z3-solver", "python-flint", "highspy")
ROUTES = ("exact", "z3", "boxes")


@dataclass(frozen=True)
class Shown:
    """A statement as reports show it: the text that the checker reads, outcome, certificate as
    stored, counterexample, answers of the routes.
    """

    name: str
    text: str
    outcome: str
    certificate: Any
    at: str
    votes: Mapping[str, str]


@dataclass(frozen=True)
class Entry:
    """One claim as reports tell it; `wrong` and `group` are as in the errata, and empty where
    nothing is wrong.
    """

    claim: Claim
    verdict: str
    detail: str
    verdict_text: str
    settled_by: str
    sharp: str
    reading: str
    wrong: tuple[str, ...]
    group: str
    correction: Mapping[str, Any] | None
    steps: tuple[Derivation, ...]
    statements: tuple[Shown, ...]
    rests_on: tuple[str, ...]


@dataclass(frozen=True)
class Rule:
    """A node of the theorem's tree: a map rule, its premises as the checker writes them, and what
    it rests on.
    """

    name: str
    kind: str
    text: str
    outcome: str
    premises: tuple[Shown, ...]
    rests_on: tuple[str, ...]
    uses: tuple[str, ...]


@dataclass(frozen=True)
class Contents:
    """Everything that reports tell; entries in the paper's order, derivations each after what it is
    made from, rules with the theorem first.
    """

    entries: tuple[Entry, ...]
    verdicts: Mapping[str, int]
    outcomes: Mapping[str, int]
    votes: tuple[str, ...]
    theorem: str
    rules: tuple[Rule, ...]
    derivations: tuple[Derivation, ...]
    changes: tuple[str, ...]
    tools: Mapping[str, str]

    def entry(self, claim_id: str) -> Entry:
        """The entry of this claim."""
        return next(one for one in self.entries if one.claim.id == claim_id)


def gather(register: Path = PATH) -> Contents:
    """The contents of a report on the stored claims.

    Raises ClaimError, one line, where the store holds no certificates, or the register is none.
    """
    registered = load_register(register)
    store, jobs = Store(DEFAULT), os.cpu_count() or 1
    results = results_for(DEFAULT, jobs)
    checked = {name: outcome for name, outcome, _ in results}
    records = Records(DEFAULT_BUDGET)
    claims = records.claims or paper_claims()
    findings = (
        json.loads((DEFAULT / FINDINGS).read_text(encoding="utf-8"))
        if (DEFAULT / FINDINGS).exists()
        else {}
    )
    options = Options(
        ROUTES,
        DEFAULT_BUDGET,
        store,
        findings,
        {} if records.claims else lemmas(claims, claims),
        checked,
    )
    judgements, _ = judge_with_records(
        claims,
        options,
        records,
        lambda rest, judged: judge_all(rest, judged, jobs, lambda *_: None),
    )
    records.keep(judgements, len(claims))
    settle_by_rules(judgements, checked, store.texts)
    votes = {name: cast for one in judgements for name, cast in one.votes.items()}
    by_id = {claim.id: entry(claim, judgement) for claim, judgement in zip(claims, judgements)}
    derived, told = dict[str, Derivation](), []
    for claim, judgement in zip(claims, judgements):
        steps, all_behind, reading = _derivations_and_reading(claim, records, store)
        derived.update((one.function, one) for one in all_behind)
        told.append(_entry(claim, judgement, by_id, findings, store, tuple(steps), reading))
    outcomes = Counter(outcome for one in judgements for outcome in one.outcomes.values())
    return Contents(
        tuple(told),
        {word: sum(one.verdict.word == word for one in judgements) for word in VERDICTS},
        dict(outcomes),
        tuple(table.summary(judgements).splitlines()[2:]),
        tree.theorem_line(store, checked, votes),
        _rules(store, checked, votes),
        tuple(derived.values()),
        tuple(changes(registered, by_id, partial=False)),
        tool_versions(),
    )


def tool_versions() -> dict[str, str]:
    """The versions of the libraries that search and vote, and of this project."""
    found = {}
    for tool in ("juggleproof", *TOOLS):
        try:
            found[tool] = version(tool)
        except PackageNotFoundError:
            found[tool] = "not installed"
    return found


def _derivations_and_reading(
    claim: Claim, records: Records, store: Store
) -> tuple[Sequence[Derivation], Sequence[Derivation], str]:
    try:
        record = records.by_claim[claim.id]
        body = body_of(record, store.texts)
        return (*kept_derivations(record), reading_of(body))
    except NOT_AS_KEPT:
        source = (
            next(one for one in paper_claims() if one.id == claim.id) if records.claims else claim
        )
        body, steps = body_and_derivations(source)
        return steps, behind(steps), reading_of(body)


def _entry(
    claim: Claim,
    judgement: Judgement,
    by_id: Mapping[str, Mapping[str, Any]],
    findings: Mapping[str, Any],
    store: Store,
    steps: tuple[Derivation, ...],
    reading: str,
) -> Entry:
    finding = findings.get(claim.id, {})
    group = errata.group_of(claim, by_id, findings)
    return Entry(
        claim,
        judgement.verdict.word,
        judgement.verdict.detail,
        table.verdict_text(claim, judgement),
        table.settled_by(judgement),
        table.sharp_range(judgement),
        reading,
        tuple(errata.what_is_wrong(by_id[claim.id], finding.get("sharp", {}))) if group else (),
        group,
        judgement.correction,
        steps,
        tuple(
            _shown(
                name,
                text,
                judgement.outcomes[name],
                store.certificate(name, text),
                judgement.votes.get(name, ()),
            )
            for name, text in [*judgement.statements]
        ),
        judgement.rests_on,
    )


def _shown(name: str, text: str, outcome: str, certificate: Any, votes: Sequence[Any]) -> Shown:
    refuted = certificate.get("refuted") if isinstance(certificate, dict) else None
    return Shown(
        name,
        text,
        outcome,
        certificate,
        counterexample(refuted) if refuted else "",
        {vote.route: vote.answer for vote in votes},
    )


def _rules(
    store: Store, checked: Mapping[str, str], votes: Mapping[str, Sequence[Any]]
) -> tuple[Rule, ...]:
    if tree.THEOREM not in store.texts:
        return ()
    rules, told = tree.rules_of(store), []
    for name in tree.with_all_below(tree.THEOREM, rules):
        certificate, outcome = (
            store.certificate(name, store.texts[name]),
            checked.get(name, "rejected"),
        )
        parts = certificate.get("certified", {}) if isinstance(certificate, dict) else {}
        premises = tuple(
            _shown(
                premise.name, premise.text(), outcome, parts.get(label), votes.get(premise.name, ())
            )
            for label, premise in checker.premises_of(rules[name], rules).items()
        )
        told.append(
            Rule(
                name,
                rules[name].kind,
                store.texts[name],
                outcome,
                premises,
                tuple(rests_on(rules[name])),
                tuple(sorted(tree.lemmas(certificate))),
            )
        )
    return tuple(told)
