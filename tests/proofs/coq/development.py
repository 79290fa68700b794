"""The Coq development in one coqtop for a test session: a module for each file, so that the
library of the reals is loaded once; and files that coqc compiles by themselves.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import threading
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

SOURCES = Path(__file__).resolve().parents[3] / "proofs" / "coq"
# Loaded, not imported: each module imports what its file does.
LIBRARIES = "Reals Qreals QArith ZArith Lra Lia List Bool FunctionalExtensionality"
LONGEST = 600  # seconds for one answer
# What Coq's standard Reals rest on; nothing else may be assumed.
REALS = {
    "ClassicalDedekindReals.sig_forall_dec",
    "ClassicalDedekindReals.sig_not_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
}


def coqc() -> str:
    """The compiler; without one the tests skip and say so, except where CI is set."""
    found = shutil.which("coqc")
    if found is None:
        if os.environ.get("CI") == "true":
            pytest.fail("coqc is missing: Debian's package is called coq")
        pytest.skip(
            "no coqc here (Debian's package is called coq): nothing about the Coq development was"
            " tested"
        )
    return found


@cache
def order() -> tuple[str, ...]:
    """The files of the development in the order of _CoqProject."""
    return tuple(
        Path(row).name
        for row in (SOURCES / "_CoqProject").read_text().splitlines()
        if row.endswith(".v")
    )


def source(name: str) -> str:
    """The text of a file of the development, whichever folder it is in."""
    (path,) = SOURCES.glob(f"*/{name}")
    return path.read_text()


def compiled(folder: Path, name: str, text: str) -> subprocess.CompletedProcess[str]:
    """One file compiled by coqc in a folder that holds what it needs."""
    (folder / name).write_text(text)
    return subprocess.run(
        [coqc(), "-q", "-Q", ".", "Juggleproof", name],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=LONGEST,
    )


def module(name: str, text: str) -> str:
    """A file as a module of that name, which finds modules where the file finds files."""
    text = re.sub(r"\bFrom Juggleproof Require Import\b", "Import", text)
    text = re.sub(r"\bFrom Juggleproof Require\b[^.]*\.", "", text)
    return f"Module {name}.\n{text}\nEnd {name}.\n"


class Answer(NamedTuple):
    """What Coq says of a text: whether it accepts all of it, and what it prints."""

    accepted: bool
    output: str

    @property
    def rejected(self) -> bool:
        """Whether a definition or proof is wrong, in a text that is well written."""
        return not self.accepted and "Error:" in self.output and "yntax" not in self.output


class Coq:
    """A coqtop that is told modules; one that it refuses leaves nothing behind."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.told = set[str]()
        self.asked = 0
        self.process = subprocess.Popen(
            [str(Path(coqc()).with_name("coqtop")), "-q", "-w", "none"],
            cwd=folder,
            env={**os.environ, "OCAMLRUNPARAM": "s=32M,o=400"},  # memory is collected less often
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self._write(f"From Coq Require {LIBRARIES}.\n")

    def _write(self, text: str) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(text)
        self.process.stdin.flush()

    def tell(self, name: str, text: str) -> Answer:
        """What it says of a module; one that it accepts stays."""
        path, end = self.folder / f"{name}.v", f"end_of_{name}"
        path.write_text(f"{module(name, text)}Definition {end} := Prop.\n")
        self._write(f'Load "{path}".\nLocate {end}.\n')
        assert self.process.stdout is not None
        ends = re.compile(rf"^(Constant Top\.{end}|No object .*\b{end})$")
        lines: list[str] = []
        watch = threading.Timer(LONGEST, self.process.kill)
        watch.start()
        for line in self.process.stdout:
            said = line.replace("Coq < ", "")
            if found := ends.search(said):
                watch.cancel()
                if accepted := found[1].startswith("Constant"):
                    self.told.add(name)
                return Answer(accepted, "".join(lines))
            lines.append(said)
        raise AssertionError("".join(lines))

    def ask(self, text: str) -> Answer:
        """What it says of a text, in a module of its own."""
        self.asked += 1
        return self.tell(f"Question_{self.asked}", text)

    def end(self) -> None:
        self.process.communicate("Quit.\n")


def build(coq: Coq) -> Coq:
    """The whole development, told."""
    for name in order():
        answer = coq.tell(name.removesuffix(".v"), source(name))
        assert answer.accepted, (name, answer.output)
    return coq


def axioms(answer: Answer) -> set[str]:
    """The axioms that an accepted text has printed last."""
    assert answer.accepted, answer.output
    _, begins, named = answer.output.partition("Axioms:\n")
    assert begins
    return set(re.findall(r"^([\w.]+)\s*:", named, flags=re.MULTILINE))


def theorems(text: str, kinds: str = "Theorem") -> list[str]:
    """What a text proves, of these kinds, by name."""
    return re.findall(rf"^ *(?:{kinds}) (\w+)", text, flags=re.MULTILINE)


def rest_on_the_reals(coq: Coq, names: Sequence[str]) -> bool:
    """Whether theorems (MODULE.NAME) rest on the axioms of the Reals, and on no others."""
    everything = ", ".join(f"@{name}" for name in names)
    text = f"Definition everything := ({everything}).\nPrint Assumptions everything.\n"
    return axioms(coq.ask(text)) == REALS


def rejects(coq: Coq, file: str, old: str, new: str, later: Sequence[str] = ()) -> bool:
    """Whether a file that says something else, or one of the later files, is rejected."""
    text = source(file)
    assert old in text, (file, old)
    texts = {file: text.replace(old, new), **{name: source(name) for name in later}}
    modules = [module(name.removesuffix(".v"), text) for name, text in texts.items()]
    return coq.ask("".join(modules)).rejected
