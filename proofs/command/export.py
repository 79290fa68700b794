"""`juggleproof export`: the stored statements as SMT-LIB 2 for other solvers, the certified ones as
Coq lemmas with proofs, prints as LaTeX.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from certificates import checker
from certificates.coq_formulas import PRELUDE
from certificates.coq_proofs import lemma
from certificates.routes.smtlib import script
from certificates.store import DEFAULT, Store, write_file
from certificates.terms import ClaimError


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
    from proofs.reports.contents import gather
    from proofs.reports.tex.equations import equation

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
