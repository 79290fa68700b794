"""`juggleproof export smt2`: the stored statements as SMT-LIB 2 for other solvers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from certificates import checker
from certificates.routes.smtlib import script
from certificates.store import DEFAULT, Store, write_file
from certificates.terms import ClaimError


def export_smt2(ids: Sequence[str], folder: Path | None) -> int:
    """Writes the statements of the claims named (or of all) to standard output, or to one file each.

    Every check begins with `(reset)`, so that a solver reads any number of statements as one script.
    Raises ClaimError for a name that neither a claim nor a statement bears.
    """
    store = Store(DEFAULT)
    names = [name for name in store.texts if not ids or name in ids or name.split("/")[0] in ids]
    for wanted in ids:
        if not any(wanted in (name, name.split("/")[0]) for name in names):
            raise ClaimError(f"{wanted}: no stored statement of this name; `juggleproof certify` makes them, `juggleproof list` names the claims")
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    for name in names:
        text = script(statements[name], statements)
        if folder:
            write_file(folder / (name.replace("/", ".") + ".smt2"), text.encode())
        else:
            print(text)
    return 0
