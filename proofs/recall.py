"""Judges a claim again from its record and the store: nothing is stated, searched or voted on anew;
where that would be needed, it gives up.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from time import perf_counter
from typing import Any

from certificates.statements import AnyStatement, SharpRange, Statement
from certificates.store import Store
from proofs import cache
from proofs.claims import Body, Claim
from proofs.judging import Judge, Judgement, Options
from proofs.loading import paper_claims
from proofs.records import Forgotten, body_of, claim_of, stored_as
from proofs.running import lemmas

NOT_AS_KEPT = (
    Forgotten,
    KeyError,
    IndexError,
    TypeError,
    ValueError,
    AttributeError,
    RecursionError,
)
Judged = tuple[list[Judgement], dict[str, float]]


class Records:
    """The records of the paper's claims that were kept by an earlier run of the same sources at
    this budget; none without a budget.
    """

    def __init__(self, budget: int | None, read: bool = True) -> None:
        self.budget, self.by_claim, self.claims = (
            budget,
            dict[str, Mapping[str, Any]](),
            list[Claim](),
        )
        self.key = "" if budget is None or cache.folder() is None else cache.key(budget)
        if self.key and read:
            kept = cache.load(self.key)
            try:
                self.claims = [claim_of(record) for record in kept]
                self.by_claim = {claim.id: record for claim, record in zip(self.claims, kept)}
            except NOT_AS_KEPT:
                self.claims = []

    def keep(self, judgements: Sequence[Judgement], count: int) -> None:
        """Keeps the records of a whole run, unless they are kept already or the sources changed
        meanwhile.
        """
        records = [judgement.record for judgement in judgements]
        if (
            self.key
            and len(records) == count
            and all(records)
            and records != list(self.by_claim.values())
            and self.key == cache.key(self.budget)
        ):
            cache.keep(self.key, records)


def judge_with_records(
    claims: Sequence[Claim],
    options: Options,
    records: Records,
    judge_rest: Callable[[Sequence[Claim], Options], Judged],
) -> Judged:
    """The judgements on the claims in order: again by their records where these agree with the
    store, else from their sources.
    """
    stored: dict[str, set[str]] = {}
    for name in options.store.texts if options.store else ():
        stored.setdefault(name.split("/")[0], set()).add(name)
    found: dict[str, Judgement] = {}
    seconds: dict[str, float] = {}
    for claim in claims if records.claims else ():
        began = perf_counter()
        try:
            found[claim.id] = judge_again(
                records.by_claim[claim.id], options, stored.get(claim.id, set())
            )
        except NOT_AS_KEPT:
            continue
        seconds[claim.id] = perf_counter() - began
    rest: Sequence[Claim] = [claim for claim in claims if claim.id not in found]
    if rest and records.claims:
        sources = {claim.id: claim for claim in paper_claims()}
        rest = [sources[claim.id] for claim in rest]
        options = replace(options, lemmas=lemmas(list(sources.values()), rest))
    if rest:
        judged, took = judge_rest(rest, options)
        found.update((judgement.id, judgement) for judgement in judged)
        seconds.update(took)
    return [found[claim.id] for claim in claims], seconds


def judge_again(record: Mapping[str, Any], options: Options, names: set[str]) -> Judgement:
    """The judgement on the claim of a record, by its stored statements, which have these names, and
    what the checker said of them in this run.

    Raises Forgotten where the stored statements are not exactly the ones that the record knows, or
    one of them is not settled.
    """
    if options.store is None:
        raise Forgotten
    found = _Again(record, options, options.store).run()
    if {name for name, _ in found.statements} != names:
        raise Forgotten
    return found


class _Again(Judge):
    def __init__(self, record: Mapping[str, Any], options: Options, store: Store) -> None:
        super().__init__(claim_of(record), options)
        self.known_by, self.store = record, store

    def body(self) -> Body:
        return body_of(self.known_by, self.store.texts)

    def record(self, body: Body) -> None:
        self.found.record = self.known_by

    def stored_outcome(self, name: str, text: str, certificate: Any) -> str:
        outcome = self.options.checked.get(name, "rejected")
        if certificate is None or outcome == "rejected":
            raise Forgotten
        return outcome

    def cast(self, name: str, text: str, outcome: str, routes: Sequence[str]) -> Any:
        raise Forgotten

    def search(self, statement: AnyStatement, parsed: Any, confirm: bool) -> Any:
        raise Forgotten

    def correct(self) -> None:
        """The correction that the record knows, if the checker certified every statement of it and
        an earlier run found it too.
        """
        remembered = (self.options.findings.get(self.claim.id) or {}).get("correction")
        if remembered != self.known_by["correction"] or bool(remembered) != bool(
            self.known_by["corrected"]
        ):
            raise Forgotten
        for name, marked, kind in self.known_by["corrected"]:
            if (
                name not in self.store.texts
                or self.settle(stored_as(name, self.store.texts[name], marked, kind)) != "certified"
            ):
                raise Forgotten
        self.found.correction = remembered

    def search_sharp(
        self, name: str, ranged: Sequence[Statement], over: Sequence[str]
    ) -> tuple[SharpRange, Any, str] | None:
        raise Forgotten

    def sharp_outcome(
        self, name: str, text: str, certificate: Any, ranged: Sequence[Statement]
    ) -> str:
        if self.options.checked.get(name) != "certified":
            raise Forgotten
        return "certified"
