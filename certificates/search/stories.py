"""Statements unfolded once: the searches for points, proofs and witnesses share what the checker
makes of a text.
"""

from __future__ import annotations

from typing import Any

from certificates import checker

MOST = 32
_kept: dict[tuple[int, ...], tuple[Any, ...]] = {}


def unfolded(statement: checker.Statement, sharp: list[Any] | None = None) -> checker.Unfolding:
    """The statement's variables, premises, obligations and goals in a context of its own; not to be
    changed.

    >>> text = "statement a/b\\nforall x\\ngiven x > 1\\nshow x > 0"
    >>> story = unfolded(checker.read_statements(text)["a/b"])
    >>> story.universal, len(story.premises)
    (['x'], 1)
    """
    key = (id(statement), *map(id, sharp or ()))
    if key not in _kept:
        while len(_kept) >= MOST:
            del _kept[next(iter(_kept))]
        # the statement and the trees are kept with it, so that their ids stay theirs
        _kept[key] = (
            checker.Unfolding(statement, checker.Context(), sharp),
            statement,
            sharp and list(sharp),
        )
    return _kept[key][0]
