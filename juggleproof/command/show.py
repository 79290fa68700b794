"""`juggleproof errata` and `export`."""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.command.outputs import busy, show
from juggleproof.coq_orbits.rules import theorem, theorems_in
from juggleproof.coq_store import PRELUDE, NotWritten, export
from juggleproof.judging.claims import claim_named
from juggleproof.judging.run import (
    by_id,
    claims_of_files,
    judge_some,
    refuse_duplicates,
    store_of,
)
from juggleproof.papers.paper import opened
from juggleproof.reports.contents import entries_of, errata_text
from juggleproof.reports.tex import equation
from juggleproof.smtlib.answering import answer_files, folder_of
from juggleproof.statements.language import ClaimError
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import DEFAULT, Store, write_file, write_store
from juggleproof.votes.smtlib import script

SCRIPT = ".smt2"

# -------------------------------------------------------------------------------------------------
# `juggleproof errata`: the errata of the store, without a search.


def command(parsed: argparse.Namespace) -> int:
    """Runs `errata` or `export`; returns its exit code."""
    if parsed.command == "export":
        own = [one for one in parsed.ids if is_own(one)]
        if own and parsed.format != "coq":
            raise ClaimError(f"{own[0]}: claims of your own are exported to coq only")
        return EXPORTS[parsed.format](parsed.ids, parsed.output)
    with busy("judging what the errata name"):
        text = errata_text()
    show(text)
    return 0


# -------------------------------------------------------------------------------------------------
# `juggleproof export`: the stored statements as SMT-LIB 2 for other solvers, as Coq lemmas
# with proofs, prints as LaTeX.


def export_smt2(ids: Sequence[str], folder: Path | None) -> int:
    """Writes the statements of the claims named (or of all) to standard output, or each to a file.

    Every check begins with `(reset)`, so that a solver reads any number of statements as one
    script. Raises ClaimError for a name that no claim and no statement has.
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
    """Writes the statements named (or all) as Coq lemmas with proofs, after those that their
    certificates use; prints on standard error the number of each class, and which it cannot write.

    For Python files of claims, it writes each theorem on the orbits of a map as a file of its own;
    where there is none, and for scripts of SMT-LIB and folders of certificates, all statements.
    Raises ClaimError for an unknown name, or where nothing at all can be written.
    """
    paths = [Path(one) for one in ids if is_own(one)]
    if paths and len(paths) < len(ids):
        raise ClaimError("files and claims of the paper together; export them one after the other")
    if not paths:
        store = Store(DEFAULT)
        return export_lemmas(store, _names(store, ids), folder)
    if len({path.suffix for path in paths}) > 1 or len(paths) > 1 and paths[0].suffix != ".py":
        raise ClaimError(f"{paths[1]}: a second store; export them one after the other")
    if paths[0].suffix == ".py":
        return export_claims(paths, folder)
    if paths[0].suffix == SCRIPT:
        with busy("answering the script"):
            answer_files(paths)
        store = Store(folder_of(paths[0], None))
    else:
        store = Store(paths[0])
    if not store.texts:
        raise ClaimError(f"{paths[0]}: no statements; name a folder that `juggleproof` wrote")
    return export_lemmas(store, list(store.texts), folder)


def is_own(name: str) -> bool:
    """Whether the name is of a user's file or folder, not of a claim of the paper.

    >>> is_own("mine.py"), is_own("mean.certificates"), is_own("eq-37/main")
    (True, True, False)
    """
    path = Path(name)
    return path.suffix in (".py", SCRIPT, ".certificates") or (path / checker.STATEMENTS).is_file()


def export_lemmas(store: Store, names: Sequence[str], folder: Path | None) -> int:
    """Writes statements of a store as lemmas; raises ClaimError where none can be written."""
    with busy("writing the statements for Coq"):
        exported = export(store, names)
    print("\n".join(exported.table()), file=sys.stderr)
    if not exported.texts:
        raise ClaimError("none of the statements named can be written for Coq")
    if not folder:
        print("\n".join([PRELUDE, *exported.texts.values()]))
        return 0
    files = _coq_files(names, folder)
    for name in names:
        if name in exported.texts:
            texts = export(store, [name]).texts.values() if exported.needs[name] else ()
            content = "\n".join([PRELUDE, *(texts or [exported.texts[name]])])
            write_file(files[name], content.encode())
    return 0


def export_claims(files: Sequence[Path], folder: Path | None) -> int:
    """Writes the theorems on maps among the claims of these files; all their statements, where
    there is no such theorem.
    """
    claims = claims_of_files(files)
    refuse_duplicates(claims)
    with busy("judging the claims"):
        judgements = judge_some(claims, by_id(claims), store_of(files))
    texts = {name: text for one in judgements for name, text in one.statements}
    certificates = {name: entry for one in judgements for name, entry in one.certificates.items()}
    statements = checker.read_statements("\n\n".join(texts.values()))
    if theorems_in(statements):
        outcomes = {name: word for one in judgements for name, word in one.outcomes.items()}
        return export_theorems(files, statements, outcomes, certificates, folder)
    with tempfile.TemporaryDirectory() as judged:
        text = "\n\n".join(texts.values()) + "\n"
        write_store(Path(judged), text, {"": certificates})
        return export_lemmas(Store(Path(judged)), list(texts), folder)


def export_theorems(
    files: Sequence[Path],
    statements: Mapping[str, checker.Statement],
    outcomes: Mapping[str, str],
    certificates: Mapping[str, Certificate],
    folder: Path | None,
) -> int:
    """Writes each certified theorem on the orbits of a map, unless another theorem of the files
    rests on it, as a file that coqc accepts by itself.  Returns 1 where one cannot be written, and
    prints a line with the reason.

    Raises ClaimError for several theorems without a folder.
    """
    names, where = theorems_in(statements), " ".join(map(str, files))
    if len(names) > 1 and not folder:
        raise ClaimError(f"{where}: several theorems, {', '.join(names)}; give -o DIR")
    written, paths = 0, _coq_files(names, folder) if folder else {}
    for name in names:
        try:
            if outcomes[name] != "certified":
                raise NotWritten(f"it is {outcomes[name]}; `juggleproof certify {where}` says why")
            text = theorem(name, statements, certificates)
        except NotWritten as problem:
            print(f"juggleproof: {where}: {name}: {problem}", file=sys.stderr)
            continue
        written += 1
        if folder:
            write_file(paths[name], text.encode())
        else:
            print(text, end="")
    return int(written < len(names))


def export_latex(ids: Sequence[str], folder: Path | None) -> int:
    """Writes the equations of the claims named (or all that the paper prints) as LaTeX, corrected
    where the print is false.

    Raises ClaimError for a name that no claim has, and for a claim without a printed formula.
    """
    claims = opened().claims_by_id
    named = [claims[claim_named(wanted, claims)] for wanted in ids]
    chosen = named or [one for one in claims.values() if one.printed]
    with busy("judging what is exported"):
        texts = {entry.claim.id: equation(entry) for entry in entries_of(chosen)}
    for name, text in texts.items():
        if folder:
            write_file(folder / f"{name}.tex", text.encode())
        else:
            print(text)
    return 0


def _coq_files(names: Sequence[str], folder: Path) -> dict[str, Path]:
    """The file for each statement, whose name is an identifier, since Coq makes it a module's name.

    Raises ClaimError where two statements would have the same file.
    """
    files = {name: folder / f"S_{re.sub('[^A-Za-z0-9]', '_', name)}.v" for name in names}
    first = {path: name for name, path in reversed(files.items())}
    for name, path in files.items():
        if first[path] != name:
            raise ClaimError(f"{path}: {first[path]} and {name} have this one name; rename one")
    return files


def _names(store: Store, ids: Sequence[str]) -> list[str]:
    claims = [*opened().claims_by_id] if ids else []
    ids = [claim_named(wanted, [*claims, *store.texts]) for wanted in ids]
    names = [name for name in store.texts if not ids or name in ids or name.split("/")[0] in ids]
    for wanted in ids:
        if not any(wanted in (name, name.split("/")[0]) for name in names):
            raise ClaimError(
                f"{wanted}: no statement is stored for it; `juggleproof explain {wanted}` says why"
            )
    return names


EXPORTS: Mapping[str, Callable[[Sequence[str], Path | None], int]] = {
    "coq": export_coq,
    "smt2": export_smt2,
    "latex": export_latex,
}
