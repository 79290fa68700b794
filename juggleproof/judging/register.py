"""The register: the committed file of expected verdicts; only `certify --accept` writes it, and
shows each entry before and after.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from juggleproof.folders import REGISTER
from juggleproof.judging.claims import VERDICTS
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import canonical, write_file

PATH = REGISTER
FIELDS = ("verdict", "detail", "correction", "sharp")
Register = Mapping[str, Mapping[str, str]]  # the entry of each claim: a text for some of FIELDS


def load_register(path: Path = PATH) -> dict[str, dict[str, str]]:
    """The registered verdicts by claim; empty where there is no register yet.

    Raises ClaimError, one line that names the file, the claim and the remedy, where the file cannot
    be read as a register.
    """
    if not path.exists():
        return {}
    try:
        data: object = json.loads(
            path.read_text(encoding="utf-8"), object_pairs_hook=_each_name_once
        )
    except _Twice as problem:
        raise ClaimError(
            f"{path}: {problem} stands there twice; keep one, or restore the file from the"
            " repository"
        ) from None
    except (OSError, ValueError, RecursionError) as error:
        raise ClaimError(
            f"{path}: not a register ({type(error).__name__}); restore it from the repository"
        ) from None
    if not isinstance(data, dict):
        raise ClaimError(
            f"{path}: not a register, which is an object of entries by claim; restore it from the"
            " repository"
        )
    for claim, entry in data.items():
        fault = _fault(entry)
        if fault:
            shown = claim if claim.isprintable() else repr(claim)
            raise ClaimError(f"{path}: {shown}: {fault}, or restore the file from the repository")
    register: dict[str, dict[str, str]] = data
    return register


class _Twice(Exception):
    """The error that an object of the register has a name twice."""


def _each_name_once(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        raise _Twice(next(name for name in names if names.count(name) > 1))
    return found


def _fault(entry: object) -> str:
    """The fault of an entry, with its remedy; empty where the entry is valid."""
    if not isinstance(entry, dict):
        return 'not an object; write {"verdict": ...}'
    if "verdict" not in entry:
        return 'no verdict; add "verdict", one of ' + ", ".join(VERDICTS)
    if entry["verdict"] not in [*VERDICTS]:  # a list, since the value may be unhashable
        return (
            f"{json.dumps(entry['verdict'])[:40]} is no verdict; write one of {', '.join(VERDICTS)}"
        )
    for name, value in entry.items():
        if name not in FIELDS:
            return f"{name[:40]!r} is no field of an entry; it has {', '.join(FIELDS)}"
        if not isinstance(value, str) or not value:
            return f"{name} is {json.dumps(value)[:40]}; write a text that is not empty"
    return ""


def registered(verdict: str, detail: str, correction: str, sharp: str) -> dict[str, str]:
    """The entry of a claim: its verdict, and those other fields that are not empty."""
    values = zip(FIELDS, (verdict, detail, correction, sharp))
    return {name: value for name, value in values if value}


@dataclass(frozen=True)
class Change:
    """A difference between the register and a run, for one claim; None where that has no entry."""

    claim: str
    before: Mapping[str, str] | None
    after: Mapping[str, str] | None

    def __str__(self) -> str:
        old, new = self.before or {}, self.after or {}
        keys = sorted(key for key in {*old, *new} if old.get(key) != new.get(key))
        return f"{self.claim}: " + "; ".join(
            f"{key} was {old.get(key, 'absent')}, is {new.get(key, 'absent')}" for key in keys
        )


def differences(before: Register, after: Register, partial: bool) -> list[Change]:
    """Each claim whose verdict, correction or sharp range differs, or that is new or gone;
    `partial` leaves absent claims alone.
    """
    names = [name for name in sorted({*before, *after}) if name in after or not partial]
    return [
        Change(name, before.get(name), after.get(name))
        for name in names
        if before.get(name) != after.get(name)
    ]


def changes(before: Register, after: Register, partial: bool) -> list[str]:
    """One line for each difference, before and after."""
    return [str(change) for change in differences(before, after, partial)]


def write_register(entries: Register, path: Path = PATH) -> bool:
    """Writes the register in canonical bytes; returns whether it changed."""
    return write_file(path, canonical(entries))
