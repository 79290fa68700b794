"""The index of the paper's claims: what `list` prints, and in which module each claim stands; only
`certify --accept` writes it.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import canonical, write_file
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.ledger.places import place_of

PATH = Path(__file__).with_name("index.json")


def load_index() -> list[dict[str, str]]:
    """The entry of each claim, in the paper's order: id, section, place, line, says and module.

    Raises ClaimError, one line, where the file cannot be read.
    """
    try:
        entries: list[dict[str, str]] = json.loads(PATH.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ClaimError(
            f"{PATH}: no index ({type(error).__name__}); `juggleproof certify --accept` writes it"
        ) from None
    return entries


def index_of(claims: Sequence[Claim]) -> list[dict[str, str]]:
    """The entries of these claims, as the sources have them."""
    return [
        {
            "id": claim.id,
            "section": claim.section,
            "place": place_of(claim).removeprefix("section "),
            "line": f"{claim.section} {claim.place}",
            "says": claim.says,
            "module": claim.read.__module__,
        }
        for claim in claims
    ]


def write_index(claims: Sequence[Claim]) -> bool:
    """Writes the index in canonical bytes; returns whether it changed."""
    return write_file(PATH, canonical(index_of(claims)))
