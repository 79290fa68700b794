"""The index of the paper's claims: the data that `list` prints, and the module of each claim; only
`certify --accept` writes it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from juggleproof.judging.claims import Claim, claims_in
from juggleproof.papers.indexed_claims import PATH, digest_of, stored_index
from juggleproof.papers.places import place_of
from juggleproof.statements.store import canonical, write_file


def load_index(modules: Sequence[str], path: Path = PATH) -> list[dict[str, str]]:
    """The entry of each claim, in the paper's order: id, section, place, line, says and module.

    Where the file was not made from the present sources of these modules, they are imported.
    """
    stored = stored_index(modules, path)
    return index_of(claims_in(modules)) if stored is None else stored


def index_of(claims: Sequence[Claim]) -> list[dict[str, str]]:
    """The entries of these claims, made from the claims themselves."""
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


def write_index(modules: Sequence[str]) -> bool:
    """Writes the index in canonical bytes; returns whether it changed."""
    content = {"claims": index_of(claims_in(modules)), "sources": digest_of(modules)}
    return write_file(PATH, canonical(content))
