"""The contents of a report, gathered once for all tests, and the page that is made of them."""

from __future__ import annotations

from functools import cache

from proofs.reports.contents import Contents, gather
from proofs.reports.page import Picture, build, pictures


@cache
def contents() -> Contents:
    return gather()


@cache
def drawn() -> tuple[Picture, ...]:
    return tuple(pictures(contents()))


@cache
def page() -> bytes:
    return build(contents(), drawn())
