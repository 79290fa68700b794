"""The store, and its statements, read once for all tests of a process."""

from __future__ import annotations

from functools import cache

from juggleproof.certificates import checker
from juggleproof.statements.store import DEFAULT, Store

STORE = Store(DEFAULT)


@cache
def statements() -> dict[str, checker.Statement]:
    """All statements of the store by name, in order."""
    return checker.read_statements("\n\n".join(STORE.texts.values()))
