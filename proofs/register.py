"""The register: the verdicts that stand, committed; only `certify --accept` writes it, showing before and after."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from certificates.store import canonical, write_file
from certificates.terms import ClaimError

PATH = Path(__file__).with_name("register.json")


def load_register(path: Path = PATH) -> dict[str, dict[str, Any]]:
    """The registered verdicts by claim; empty where there is no register yet.

    Raises ClaimError, one line, where the file cannot be read as a register.
    """
    if not path.exists():
        return {}
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ClaimError(f"{path}: not a register ({type(error).__name__}); restore it from the repository") from None
    if not isinstance(data, dict) or not all(isinstance(entry, dict) for entry in data.values()):
        raise ClaimError(f"{path}: not a register; restore it from the repository")
    return data


def changes(before: Mapping[str, Mapping[str, Any]], after: Mapping[str, Mapping[str, Any]], partial: bool) -> list[str]:
    """One line for each verdict, correction or sharp range that differs, before and after; `partial` leaves absent claims alone."""
    lines = []
    for claim in sorted({*before, *after}):
        if claim not in after and partial:
            continue
        old, new = before.get(claim), after.get(claim)
        if old != new:
            keys = sorted(k for k in {*(old or {}), *(new or {})} if (old or {}).get(k) != (new or {}).get(k))
            told = [f"{k} was {(old or {}).get(k, 'absent')}, is {(new or {}).get(k, 'absent')}" for k in keys]
            lines.append(f"{claim}: " + "; ".join(told))
    return lines


def write_register(entries: Mapping[str, Mapping[str, Any]], path: Path = PATH) -> bool:
    """Writes the register in canonical bytes; returns whether it changed."""
    return write_file(path, canonical(entries))
