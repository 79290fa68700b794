"""`juggleproof list`: the claims of the index with their registered verdicts; none is loaded."""

from __future__ import annotations

import argparse

from juggleproof.command.outputs import show
from juggleproof.judging.claims import VERDICTS
from juggleproof.judging.register import load_register
from juggleproof.papers.index import load_index
from juggleproof.papers.paper import opened
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import canonical


def command(parsed: argparse.Namespace) -> int:
    """Prints the claims that are asked for; returns the exit code."""
    return list_claims(parsed.section, parsed.verdict, parsed.lines, parsed.json, parsed.long)


def list_claims(
    section: str = "",
    verdict: str = "",
    with_lines: bool = False,
    as_json: bool = False,
    long: bool = False,
) -> int:
    """Prints a line for each claim: id, registered verdict, place; its sentence below if `long`.

    `section`, such as 4.2, or A with all below it, and `verdict` select claims; with lines, places
    are lines of the transcription.  Raises ClaimError for an unknown section or verdict.
    """
    register = load_register()
    everything = [
        {
            "id": one["id"],
            "section": one["section"],
            "place": one["line" if with_lines else "place"],
            "verdict": register[one["id"]]["verdict"] if one["id"] in register else "not judged",
            "says": one["says"],
        }
        for one in load_index(opened().modules)
    ]
    listed = [
        one
        for one in everything
        if (not section or in_section(one["section"], section))
        and (not verdict or one["verdict"] == verdict)
    ]
    if verdict and verdict not in VERDICTS:
        raise ClaimError(f"--verdict {verdict}: choose from {', '.join(VERDICTS)}")
    if section and not any(in_section(one["section"], section) for one in everything):
        raise ClaimError(f"--section {section}: no claim is of it; `juggleproof list` shows all")
    if as_json:
        print(canonical([*listed]).decode(), end="")
        return 0
    lines = []
    for one in listed:
        lines.append(f"{one['id']:20} {one['verdict']:9} {one['place']}")
        lines += [f"    {one['says']}"] if long else []
    show("\n".join(lines))
    return 0


def in_section(own: str, wanted: str) -> bool:
    """Whether a section is the wanted one, or below it.

    >>> in_section("A.3.2", "A"), in_section("4.2", "4.2"), in_section("4.2", "4.21")
    (True, True, False)
    """
    return f"{own}.".startswith(f"{wanted}.")
