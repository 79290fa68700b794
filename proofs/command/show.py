"""`juggleproof list` and `explain ID`: what is stored, told without searching again."""

from __future__ import annotations

import json
from typing import Any

from certificates.store import DEFAULT, Store
from certificates.terms import ClaimError
from proofs.claims import Argument, Assertion, Body, Claim, Following, Readings
from proofs.command.tree import print_tree
from proofs.derivations import body_and_derivations, kept_derivations
from proofs.judging import DEFAULT_BUDGET
from proofs.loading import paper_claims
from proofs.recall import NOT_AS_KEPT, Records
from proofs.records import body_of
from proofs.register import load_register


def list_claims() -> int:
    """One line a claim: id, place, registered verdict, what it says."""
    register = load_register()
    for claim in kept_claims():
        verdict = register.get(claim.id, {}).get("verdict", "not judged")
        print(f"{claim.id:32} {claim.section + ' ' + claim.place:24} {verdict:12} {claim.says}")
    return 0


def explain(claim_id: str, with_premises: bool = False) -> int:
    """One claim whole: print, derivation, reading, statements, certificates or counterexamples,
    sharp range, verdict; the tree of its rules.
    """
    records = Records(DEFAULT_BUDGET)
    claims = {claim.id: claim for claim in records.claims or paper_claims()}
    if claim_id not in claims:
        near = [name for name in claims if claim_id in name][:5]
        raise ClaimError(
            f"{claim_id}: no such claim"
            + (f"; did you mean {', '.join(near)}?" if near else "; `juggleproof list` names them")
        )
    claim, store = claims[claim_id], Store(DEFAULT)
    try:
        body = body_of(records.by_claim[claim_id], store.texts)
        derivations = kept_derivations(records.by_claim[claim_id])[0]
    except NOT_AS_KEPT:
        if records.claims:
            claim = next(one for one in paper_claims() if one.id == claim_id)
        body, derivations = body_and_derivations(claim)
    print(f"{claim.id}   section {claim.section} {claim.place}")
    print(f"  {claim.says}")
    _print_of(claim)
    for one in derivations:
        print(f"derived     {one.line}")
    print(f"reading     {reading_of(body)}")
    for name, text in store.texts.items():
        if name.split("/")[0] == claim_id:
            _statement(name, text, store)
    entry = load_register().get(claim_id, {})
    print(f"sharp range {entry.get('sharp', 'none: the claim has no range of alpha to settle')}")
    if "correction" in entry:
        print(f"correction  {entry['correction']}")
    print(
        f"verdict     {entry.get('verdict', 'not judged')}"
        + (f"; {entry['detail']}" if "detail" in entry else "")
    )
    print_tree(claim_id, getattr(body, "rests_on", ()), store, with_premises)
    return 0


def kept_claims() -> list[Claim]:
    """The paper's claims as a table tells them: from the records of an earlier run of the same
    sources, else loaded.
    """
    return Records(DEFAULT_BUDGET).claims or paper_claims()


def _print_of(claim: Claim) -> None:
    if claim.as_it_stands:
        print(f"stands      {claim.as_it_stands}")
        print(f"restored    {claim.printed}")
    elif claim.printed:
        print(f"printed     {claim.printed}")
    if claim.repeats:
        print(f"repeats     {claim.repeats}")


def reading_of(body: Body) -> str:
    """How the statements of a body make up the claim, in a few words."""
    if isinstance(body, Assertion):
        return (
            f"all {len(body.parts)} statements hold"
            if len(body.parts) > 1
            else "the statement holds"
        )
    if isinstance(body, Readings):
        return "can be read as " + ", or as ".join(body.of)
    if isinstance(body, Following):
        return "the conclusion of " + ", ".join(body.rests_on)
    if isinstance(body, Argument):
        return (
            "argued from "
            + ", ".join(body.steps)
            + (f"; rescued by {body.rescue}" if body.rescue else "")
        )
    raise ClaimError("a body of unknown kind")


def _statement(name: str, text: str, store: Store) -> None:
    certificate = store.certificate(name, text)
    print()
    for line in text.splitlines():
        print(f"    {line}")
    if not isinstance(certificate, dict):
        print("    -> no certificate is stored")
    elif "unknown" in certificate:
        print(f"    -> unknown: {certificate['unknown']}")
    elif "refuted" in certificate:
        print(f"    -> refuted at {counterexample(certificate['refuted'])}")
    else:
        shown = json.dumps(certificate["certified"], separators=(",", ":"))
        if len(shown) >= 400:
            shown = f"{shown[:400]}... ({len(shown)} characters)"
        print(f"    -> certified by {shown}")


def counterexample(found: Any) -> str:
    """The values of a counterexample as text."""
    if found[0] == "sign":
        return f"a family by the sign of {found[1]}"
    values = ", ".join(f"{name} = {value}" for name, value in found[2].items())
    adjoined = "".join(
        f" where {entry[0]} is a root of {entry[1]} between {entry[2]} and {entry[3]}"
        for entry in found[1]
    )
    return values + adjoined
