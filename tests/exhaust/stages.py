"""The stages of `make exhaust`: what each runs, and what it depends on."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from tests.exhaust.sources import Sources

STORE = "certificates/store"
EQUIVALENT = "tests/certificates/checker/equivalent.txt"
INDEX = "proofs/ledger/index.json"
DERIVED = "proofs/ledger/derived.json"
REGISTER = "proofs/register.json"
LOCKS = ("requirements.lock",)
REPORT_LOCKS = (*LOCKS, "requirements-report.lock")
TEST_LOCKS = (*REPORT_LOCKS, "requirements-test.lock", "pyproject.toml")
PEERS_LOCKS = (*TEST_LOCKS, "requirements-peers.lock")
CHECKER = ("algebra", "text", "language", "rules", "maps", "orbits", "settling")
SINE = ("flights", "cells", "checker")
FORMATS = ("html", "latex", "markdown", "json", "badge", "figures", "pdf")
SHARES = 8  # of the store, for Coq
WIDE_SHARES = ("cover", *(f"{share}/24" for share in range(1, 25)))
WITH_PEERS = (  # tests of what needs other solvers, or Dask
    "tests.benchmarks.bench.test_bench",
    "tests.benchmarks.test_problems",
    "tests.certificates.sine.test_cover",
    "tests.votes.test_smtlib",
    "tests.command.test_show",
    "tests.smtlib.test_answering",
    "tests.scenes.part.test_setting",
)
SEARCH = ("juggleproof.judging.run", "juggleproof.judging.register")
FRESH, MUTANTS = "fresh/", "mutants/checker/"
NEW_CLAIM = 20  # CPU seconds that CI grants to a claim that no line tells of
STATEMENT = re.compile(r"[\w.+-]+/[\w.+-]+")


@dataclass(frozen=True)
class Stage:
    """A command, and the files that it depends on; `said` is what it depends on beside them.

    `bound` is a number of CPU seconds that it takes at most, where that is known of a stage that
    has never been run.
    """

    name: str
    command: tuple[str, ...]
    files: Sequence[str]
    said: str = ""
    bound: int | None = None

    def digest(self, sources: Sources) -> str:
        """The digest of the command and of all that it depends on."""
        return sources.digest(self.files, *self.command, self.said)


class Stages:
    """All stages of a tree."""

    def __init__(self, sources: Sources) -> None:
        self.sources = sources

    @cached_property
    def all(self) -> dict[str, Stage]:
        """The stages by name, in order."""
        found = [
            *self.mutants(),
            *self.tests(),
            *self.fresh(),
            *self.coq(),
            *self.commands(),
        ]
        return {stage.name: stage for stage in sorted(found, key=lambda stage: stage.name)}

    def digests(self) -> dict[str, str]:
        """The digest of each stage."""
        return {name: stage.digest(self.sources) for name, stage in self.all.items()}

    # ------------------------------------------------------------ mutants, tests and commands

    def mutants(self) -> Iterator[Stage]:
        """Every mutant of a file of a checker; of those that are listed as equivalent, the ones of
        this file count alone.
        """
        listed = (self.sources.root / EQUIVALENT).read_text(encoding="utf-8").splitlines()
        for package, module, files in (
            ("checker", "tests.certificates.checker.mutate", CHECKER),
            ("sine", "tests.certificates.sine.mutants", SINE),
        ):
            depends = [one for one in self.sources.depends_on([module], LOCKS) if one != EQUIVALENT]
            for file in files:
                own = [row for row in listed if package == "checker" and row.startswith(f"{file}.")]
                command = ("python", "-m", module, f"{file}.")
                yield Stage(f"mutants/{package}/{file}", command, depends, "\n".join(own))

    def tests(self) -> Iterator[Stage]:
        """The files of tests that try a share in the suite, and here more of it; and the marked
        tests of the others.
        """
        for module, file in self.sources.modules.items():
            if not file.rpartition("/")[2].startswith("test_"):
                continue
            whole = "tests.share" in self.sources.imports(module)
            if whole or self.sources.read(module).marked:
                named = "" if whole else "exhaust"
                above = [f"{package}.conftest" for package in folders_of(module)]
                entries = [module, *(one for one in above if one in self.sources.modules)]
                yield Stage(
                    file,
                    ("python", "-m", "pytest", "-p", "no:juggleproof", "-m", named, file),
                    self.sources.depends_on(entries, TEST_LOCKS),
                )

    def commands(self) -> Iterator[Stage]:
        """What one command does."""
        for name, module, *more in (
            ("problems", "juggleproof.benchmarks.problems", "--votes", "5"),
            *((f"reports/{form}", "tests.exhaust.reports", form) for form in FORMATS),
            *(
                (f"sine-wide/{share.partition('/')[0]}", "tests.exhaust.wide", share)
                for share in WIDE_SHARES
            ),
        ):
            depends = self.sources.depends_on([module], REPORT_LOCKS)
            yield Stage(name, ("python", "-m", module, *more), depends)
        for tests in WITH_PEERS:
            depends = self.sources.depends_on(["tests.exhaust.peers", tests], PEERS_LOCKS)
            yield Stage(f"peers/{tests}", ("python", "-m", "tests.exhaust.peers", tests), depends)

    # ------------------------------------------------------------ claims, and shares of the store

    @cached_property
    def store(self) -> dict[str, str]:
        """Each stored statement as it stands there, comments apart, with its certificate."""
        folder = self.sources.root / STORE
        text = (folder / "statements.txt").read_text(encoding="utf-8")
        lines = (folder / "certificates.jsonl").read_text(encoding="utf-8").splitlines()
        certificates = {line.split('"', 2)[1]: line for line in lines}
        found = {}
        for block in text.split("\n\n"):
            rows = [row for row in block.splitlines() if not row.startswith("#")]
            names = [row.split()[1] for row in rows if row.startswith("statement ")]
            for name in names[:1]:
                found[name] = "\n".join([*rows, certificates.get(name, "")])
        return found

    @cached_property
    def definitions(self) -> list[str]:
        """The lines that define names for all statements."""
        text = (self.sources.root / STORE / "statements.txt").read_text(encoding="utf-8")
        return [line for line in text.splitlines() if line.startswith("define ")]

    @cached_property
    def mentions(self) -> dict[str, set[str]]:
        """The statements that a stored statement, or its certificate, names."""
        return {
            name: {one for one in STATEMENT.findall(text) if one in self.store}
            for name, text in self.store.items()
        }

    def reached(self, names: set[str]) -> list[str]:
        """These statements, and all that they rest on, in order."""
        found: set[str] = set()
        while names:
            found |= names
            names = {use for name in names for use in self.mentions[name]} - found
        return sorted(found)

    def fresh(self) -> Iterator[Stage]:
        """Each claim, searched anew: the search, the modules of the claim and of those whose
        statements it may use, these statements, and what is registered.
        """
        register = json.loads((self.sources.root / REGISTER).read_text(encoding="utf-8"))
        begun: dict[frozenset[str], list[str]] = {}
        for claim in self.claims:
            reached = self.used_by(claim)
            entries = frozenset({*self.modules_of([claim]), *SEARCH})
            if entries not in begun:
                _, every = self.sources.closure(entries)
                files = {self.sources.modules[one] for one in every}
                begun[entries] = sorted({*files, *self.derived, "tests/exhaust/fresh.py", *LOCKS})
            texts = [self.store[name].rpartition("\n")[0] for name in reached]
            yield Stage(
                FRESH + claim,
                ("python", "-m", "tests.exhaust.fresh", claim),
                begun[entries],
                json.dumps([self.definitions, texts, register.get(claim)]),
                NEW_CLAIM,
            )

    @cached_property
    def derived(self) -> set[str]:
        """What is kept of derivations, and the modules that derive it."""
        held = json.loads((self.sources.root / DERIVED).read_text(encoding="utf-8"))["derived"]
        modules = {name.partition("(")[0].rpartition(".")[0] for name in held}
        return {DERIVED, *(self.sources.modules[one] for one in modules)}

    @cached_property
    def claims(self) -> dict[str, str]:
        """The module of each claim, in the paper's order."""
        index = json.loads((self.sources.root / INDEX).read_text(encoding="utf-8"))
        return {entry["id"]: entry["module"] for entry in index["claims"]}

    def used_by(self, claim: str) -> list[str]:
        """The statements of a claim, those that its module names, and all that they rest on."""
        words = self.sources.words(self.claims[claim])
        own = {name for name in self.store if name.split("/")[0] == claim}
        return self.reached(own | {name for name in words if name in self.store})

    def modules_of(self, claims: Iterable[str]) -> list[str]:
        """The modules of the claims and of those whose statements they may use, in order."""
        names = {name.split("/")[0] for claim in claims for name in [claim, *self.used_by(claim)]}
        return list(dict.fromkeys(self.claims[one] for one in self.claims if one in names))

    def coq(self) -> Iterator[Stage]:
        """The stored statements as lemmas of Coq, in shares by the digest of their names."""
        from juggleproof.coq_store.files import share_of  # what searches claims does without

        _, every = self.sources.closure(["juggleproof.coq_store.__main__"])
        files = sorted({*(self.sources.modules[one] for one in every), "Makefile", *LOCKS})
        for place in range(SHARES):
            names = self.reached(set(share_of(self.store, SHARES, place)))
            said = [*self.definitions, *(self.store[name] for name in names)]
            yield Stage(
                f"coq-store/{place + 1}",
                ("make", "coq-store", f"SHARE={SHARES}", f"PLACE={place}", "FILES=2", "JOBS=1"),
                files,
                json.dumps(said),
            )


def folders_of(module: str) -> Iterator[str]:
    """The packages above a module of tests."""
    while module := module.rpartition(".")[0]:
        yield module
