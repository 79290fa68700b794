"""A whole store as files of Coq, and which of its statements are written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.coq_store.lemmas import lemmas
from juggleproof.coq_store.text import PRELUDE, NotWritten, without_primes
from juggleproof.statements.language import lemmas_of
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import Store, write_file

FILES = 16
HEADER = """\
From Coq Require Import Reals Lra Lia ZArith.
From Store Require Import Prelude.
Open Scope R_scope.

"""
CLASSES = {
    "universal": "for all",
    "exists": "for all, some exist",
    "refuted": "refuted",
    "sharp": "sharp range",
    "orbit": "rule on orbits: its premises, not what it concludes",
}


class Export(NamedTuple):
    """Statements as lemmas, in the order of the store.

    texts: {name: its lemmas}; reasons: {name: why it is not written}; classes: {name: its class};
    needs: {name: the statements that its certificate uses}.
    """

    texts: Mapping[str, str]
    reasons: Mapping[str, str]
    classes: Mapping[str, str]
    needs: Mapping[str, set[str]]

    def table(self) -> list[str]:
        """One line for each class, and one for each statement that is not written."""
        every = Counter(self.classes.values())
        done = Counter(self.classes[name] for name in self.texts)
        rows = [f"{done[kind]:4} of {every[kind]:4}  {kind}" for kind in CLASSES.values()]
        rows.append(f"{len(self.texts):4} of {len(self.classes):4}  statements are written for Coq")
        return rows + [f"not written: {name}: {why}" for name, why in self.reasons.items()]


def export(store: Store, names: Iterable[str] | None = None) -> Export:
    """The lemmas of the statements named, or of all, and of those that their certificates use."""
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    certificates = {name: store.certificate(name, text) for name, text in store.texts.items()}
    needs = {name: lemmas_of(certificate) for name, certificate in certificates.items()}
    wanted = set(statements if names is None else names)
    while more := {use for name in wanted for use in needs[name]} - wanted:
        wanted |= more
    texts: dict[str, str] = {}
    reasons: dict[str, str] = {}
    classes: dict[str, str] = {}
    for name, statement in statements.items():
        if name not in wanted:
            continue
        certificate = certificates[name] or {}
        classes[name] = CLASSES[_class(statement, certificate)]
        missing = needs[name] - texts.keys()
        try:
            if missing:
                raise NotWritten(f"it rests on {min(missing)}, which is not written")
            text = lemmas(statement, certificate, statements)
            texts[name] = without_primes(text, text)
        except NotWritten as problem:
            reasons[name] = problem.reason
    return Export(texts, reasons, classes, needs)


def share_of(names: Iterable[str], share: int, place: int = 0) -> list[str]:
    """The names whose digest leaves the remainder `place` when it is divided by `share`."""
    return [name for name in names if int(sha256(name.encode()).hexdigest(), 16) % share == place]


def write(exported: Export, folder: Path, files: int = FILES) -> None:
    """Writes Prelude.v and files of similar size; a statement is in the file of those it uses."""
    write_file(folder / "Prelude.v", PRELUDE.encode())
    for count, names in enumerate(_parts(exported, files), 1):
        text = HEADER + "\n".join(exported.texts[name] for name in names)
        write_file(folder / f"Part{count:02}.v", text.encode())


def _parts(exported: Export, files: int) -> list[list[str]]:
    order = {name: place for place, name in enumerate(exported.texts)}
    group = {name: [name] for name in order}
    for name in order:
        for use in exported.needs[name]:
            if group[use] is not group[name]:
                merged = group[use] + group[name]
                group.update(dict.fromkeys(merged, merged))
    groups = {id(names): names for names in group.values()}.values()

    def size(names: Sequence[str]) -> int:
        return sum(len(exported.texts[name]) for name in names)

    parts: list[list[str]] = [[] for _ in range(files)]
    for names in sorted(groups, key=lambda names: (-size(names), order[names[0]])):
        min(parts, key=size).extend(names)
    return [sorted(part, key=order.__getitem__) for part in parts if part]


def _class(statement: checker.Statement, certificate: Certificate) -> str:
    if "refuted" in certificate:
        return "refuted"
    if statement.kind == "universal":
        return "exists" if statement.get("exists") else "universal"
    return "sharp" if statement.kind == "sharp" else "orbit"
