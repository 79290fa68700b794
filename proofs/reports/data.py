"""The results as JSON, as `schema.json` beside this file describes it: with versions of tools,
without dates or machines.
"""

from __future__ import annotations

import sys
import tomllib
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from certificates.store import canonical
from proofs.register import Change
from proofs.reports.results import Result, Results, results_of

SCHEMA = 2
SCHEMA_FILE = Path(__file__).with_name("schema.json")
TOOLS = ("sympy", "mpmath", "z3-solver", "python-flint", "highspy")
PROJECT = Path(__file__).resolve().parents[2] / "pyproject.toml"


def as_json(contents: Any) -> bytes:
    """The document of a run or of a report's contents, in canonical bytes."""
    return canonical(document(results_of(contents)))


def document(results: Results) -> dict[str, Any]:
    """The document as data; every field is described in `schema.json`."""
    verdicts, outcomes, changes = results.verdicts(), results.outcomes(), results.change_of()
    return {
        "$schema": SCHEMA_FILE.name,
        "schema": SCHEMA,
        "tools": tools(),
        "subject": "file" if results.own else "paper",
        "partial": results.partial,
        "exit": results.exit,
        "theorem": (
            {"proved": results.is_proved, "text": results.theorem} if results.theorem else None
        ),
        "counts": {
            "claims": sum(verdicts.values()),
            "verdicts": verdicts,
            "statements": sum(outcomes.values()),
            "outcomes": outcomes,
            "changes": len(changes),
        },
        "votes": list(results.votes),
        "accepted": results.accepted,
        "changes": [_change(change) for change in results.changes],
        "rejected": [{"statement": name, "reason": reason} for name, reason in results.rejected],
        "claims": [_claim(one, changes.get(one.id)) for one in results.claims],
    }


def _claim(one: Result, change: Change | None) -> dict[str, Any]:
    told = {
        name: getattr(one, name)
        for name in (
            "id",
            "section",
            "place",
            "says",
            "printed",
            "as_it_stands",
            "repeats",
            "verdict",
            "detail",
            "verdict_text",
            "settled_by",
            "group",
        )
    }
    return {
        **told,
        "sharp": one.sharp_by_reading(),
        "correction": _correction(one),
        "wrong": list(one.wrong),
        "change": _change(change) if change else None,
        "statements": [
            {
                "name": stated.name,
                "outcome": stated.outcome,
                "votes": dict(stated.votes),
                "counterexample": stated.at or None,
                "text": stated.text,
            }
            for stated in one.statements
        ],
    }


def _correction(one: Result) -> dict[str, Any] | None:
    if not one.correction:
        return None
    return {
        "text": one.correction["text"],
        "change": one.correction["change"],
        "kind": one.correction["kind"],
        "possible_transcription_error": one.correction["possible transcription error"],
    }


def _change(change: Change) -> dict[str, Any]:
    return {
        "claim": change.claim,
        "before": change.before,
        "after": change.after,
        "text": str(change),
    }


def tools() -> dict[str, str]:
    """The versions of juggleproof, of Python without its patch level, and of the libraries, none of
    which is believed.
    """
    own = {
        "juggleproof": _own_version(),
        "python": f"{sys.version_info.major}.{sys.version_info.minor}",
    }
    return {**own, **{tool: version(tool) for tool in TOOLS}}


def _own_version() -> str:
    if PROJECT.is_file():  # a checkout, installed or not
        return str(tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]["version"])
    try:
        return version("juggleproof")
    except PackageNotFoundError:
        return "unknown"
