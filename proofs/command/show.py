"""List, explain, check, export."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.coq import PRELUDE, lemma
from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import DEFAULT, Store, write_file
from juggleproof.certificates.votes.smtlib import script
from juggleproof.proofs.claims import Argument, Assertion, Body, Claim, Following, Readings
from juggleproof.proofs.derivations import body_and_derivations, kept_derivations
from juggleproof.proofs.judging import DEFAULT_BUDGET
from juggleproof.proofs.kept import body_of
from juggleproof.proofs.register import load_register
from juggleproof.proofs.rules import print_tree, theorem_line
from juggleproof.proofs.run import NOT_AS_KEPT, Records, paper_claims

# -------------------------------------------------------------------------------------------------
# `juggleproof check`: the bare checker over a folder, and what its results mean for the
# theorem.


def check(folder: Path | None) -> int:
    """Prints what the checker rejects, the counts of outcomes, and one line for the theorem; 0
    where nothing is rejected, else 1.

    Raises ClaimError, one line, where the folder cannot be read.
    """
    where = folder or DEFAULT
    try:
        results = checker.check_folder(str(where))
    except checker.Rejected as reason:
        raise ClaimError(
            f"{where}: {reason}; name a folder that `juggleproof certify` wrote"
        ) from None
    code = checker.report(results)
    line = theorem_line(Store(where), {name: outcome for name, outcome, _ in results})
    if line:
        print(line)
    return int(code)


# -------------------------------------------------------------------------------------------------
# `juggleproof export`: the stored statements as SMT-LIB 2 for other solvers, the certified ones as
# Coq lemmas with proofs, prints as LaTeX.


def export_smt2(ids: Sequence[str], folder: Path | None) -> int:
    """Writes the statements of the claims named (or of all) to standard output, or to one file
    each.

    Every check begins with `(reset)`, so that a solver reads any number of statements as one
    script. Raises ClaimError for a name that neither a claim nor a statement bears.
    """
    store = Store(DEFAULT)
    names = _names(store, ids)
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    for name in names:
        text = script(statements[name], statements)
        if folder:
            write_file(folder / (name.replace("/", ".") + ".smt2"), text.encode())
        else:
            print(text)
    return 0


def export_coq(ids: Sequence[str], folder: Path | None) -> int:
    """Writes the certified statements named (or all) as Coq lemmas with proofs; says on standard
    error which it cannot, and why.

    Raises ClaimError for an unknown name, or where nothing at all can be written.
    """
    store = Store(DEFAULT)
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    written = 0
    for name in _names(store, ids):
        try:
            text = lemma(statements[name], store.certificate(name, store.texts[name]))
        except ClaimError as problem:
            print(f"juggleproof: not written for Coq: {problem}", file=sys.stderr)
            continue
        if folder:
            write_file(folder / (_file_name(name) + ".v"), f"{PRELUDE}\n{text}".encode())
        else:
            print(text if written else f"{PRELUDE}\n{text}")
        written += 1
    if not written:
        raise ClaimError("none of the statements named can be written for Coq")
    return 0


def export_latex(ids: Sequence[str], folder: Path | None) -> int:
    """Writes the equations of the claims named (or all that the paper prints) as LaTeX, corrected
    where the print is false.

    Raises ClaimError for a name that no claim bears, or one without a printed formula.
    """
    from juggleproof.proofs.reports.contents import gather
    from juggleproof.proofs.reports.tex import equation

    contents = gather()
    by_id = {entry.claim.id: entry for entry in contents.entries}
    for wanted in ids:
        if wanted not in by_id:
            raise ClaimError(f"{wanted}: no such claim; `juggleproof list` names them")
    texts = {
        name: equation(by_id[name])
        for name in ids or [name for name, entry in by_id.items() if entry.claim.printed]
    }
    for name, text in texts.items():
        if folder:
            write_file(folder / f"{name}.tex", text.encode())
        else:
            print(text)
    return 0


def _file_name(name: str) -> str:
    # Coq takes the name of a file for that of a module, so it must be an identifier.
    return "S_" + "".join(c if c.isalnum() else "_" for c in name)


def _names(store: Store, ids: Sequence[str]) -> list[str]:
    names = [name for name in store.texts if not ids or name in ids or name.split("/")[0] in ids]
    for wanted in ids:
        if not any(wanted in (name, name.split("/")[0]) for name in names):
            raise ClaimError(
                f"{wanted}: no stored statement of this name; `juggleproof certify` makes them,"
                " `juggleproof list` names the claims"
            )
    return names


# -------------------------------------------------------------------------------------------------
# `juggleproof list` and `explain ID`: what is stored, told without searching again.


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
            + (f"; rescued by {body.proved_by}" if body.proved_by else "")
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
