"""The contents of a report, gathered once for all tests, and the page that is made of them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from juggleproof.proofs.reports.contents import Contents, gather
from juggleproof.proofs.reports.page import Picture, build, pictures


@cache
def contents() -> Contents:
    return gather()


@cache
def drawn() -> tuple[Picture, ...]:
    return tuple(pictures(contents()))


@cache
def page() -> bytes:
    return build(contents(), drawn())


@cache
def some_contents() -> Contents:
    """One claim in six, all that the tree of the theorem and the tests name, and all of two
    verdicts and two sections: a page that loads soon.
    """
    kept = [
        entry
        for k, entry in enumerate(contents().entries)
        if k % 6 == 0
        or entry.claim.id.startswith("theorem")
        or entry.claim.id == "eq-37"
        or entry.verdict in ("gap", "false")
        or entry.claim.section in ("4.3.1", "A.2")
    ]
    return replace(contents(), entries=tuple(kept))


@cache
def page_of_some() -> bytes:
    return build(some_contents())
