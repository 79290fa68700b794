"""The paper's claims by id; the index says which module to import when a claim is asked for."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path

from juggleproof.folders import LEDGER
from juggleproof.judging.claims import Claim, claims_in

PATH = LEDGER / "index.json"
ROWS = LEDGER / "rows.tsv"  # the ledger, from which the places of claims are computed


def stored_index(modules: Sequence[str], path: Path = PATH) -> list[dict[str, str]] | None:
    """The stored entry of each claim; None where the file was not made from the present sources of
    these modules.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        entries: list[dict[str, str]] = data["claims"]
        return entries if data["sources"] == digest_of(modules) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def digest_of(modules: Sequence[str]) -> str:
    """A digest of the ledger, if there is one, and of the sources of modules, which are not
    imported.
    """
    digest = hashlib.sha256(ROWS.read_bytes() if ROWS.is_file() else b"")
    for name in modules:
        spec = find_spec(name)
        if spec is not None and spec.origin:
            digest.update(f"\n{name} ".encode() + Path(spec.origin).read_bytes())
    return digest.hexdigest()


class IndexedClaims(Mapping[str, Claim]):
    """The claims of modules by id, in order; a module is imported when one of its claims is first
    asked for.
    """

    def __init__(self, modules: Sequence[str]) -> None:
        self.modules = modules

    @cached_property
    def _module_of(self) -> dict[str, str]:
        stored = stored_index(self.modules)
        if stored is not None:
            return {one["id"]: one["module"] for one in stored}
        return {one.id: module for module in self.modules for one in claims_in([module])}

    def __getitem__(self, name: str) -> Claim:
        return next(one for one in claims_in([self._module_of[name]]) if one.id == name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._module_of)

    def __len__(self) -> int:
        return len(self._module_of)
