"""Which derivations each derivation calls when it is worked out: every function of `symbolic` is
replaced, in each of its modules, by one that notes who called it.

Derivations keep their values, and what others call is noted all the same; functions that take
arguments keep none, so that what they call counts for whoever calls them.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from typing import Any

from sympy import Expr, MatrixBase

from juggleproof import symbolic
from juggleproof.judging.judgement import statements_of
from juggleproof.papers.derivations import Origin
from juggleproof.papers.paper import opened
from juggleproof.proofs.deriving import result
from juggleproof.statements.language import origins_in

calls: dict[str, set[str]] = {}
working: list[str] = []


def is_derivation(function: Any) -> bool:
    """Whether it comes to something with rows without being given arguments."""
    plain = inspect.unwrap(function) if callable(function) else None
    if not inspect.isfunction(plain) or "juggleproof.symbolic." not in plain.__module__:
        return False
    if any(one.default is one.empty for one in inspect.signature(plain).parameters.values()):
        return False
    value = function()
    parts = value if isinstance(value, tuple) and not hasattr(value, "_fields") else (value,)
    return isinstance(value, MatrixBase) or all(
        isinstance(one, Expr) and not isinstance(one, MatrixBase) or hasattr(one, "attained")
        for one in parts
    )


def noting(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, noting its name as called by the derivation that is being worked out."""

    def call(*arguments: Any) -> Any:
        if working:
            calls[working[-1]].add(name)
        return worked_out(name, function, *arguments)

    return call


def worked_out(name: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """The value of a derivation, what it calls being noted."""
    calls.setdefault(name, set())
    working.append(name)
    try:
        return function(*arguments)
    finally:
        working.pop()


def called_derivations() -> dict[str, list[str]]:
    """For every derivation behind a claim those that it calls; for a process that ends with this,
    since `symbolic` stays changed.
    """
    statements = [statements_of(claim) for claim in opened().claims()]
    origins = [one for one in dict.fromkeys(origins_in(statements)) if isinstance(one, Origin)]
    nodes = {name for name in dir(symbolic) if is_derivation(getattr(symbolic, name))}
    modules = [module for name, module in sys.modules.items() if "juggleproof.symbolic" in name]
    wrapped: dict[int, Callable[..., Any]] = {}
    for module in modules:
        for name, value in list(vars(module).items()):
            plain = inspect.unwrap(value) if callable(value) else None
            if not inspect.isfunction(plain) or "juggleproof.symbolic" not in plain.__module__:
                continue
            if hasattr(value, "cache_clear"):
                value.cache_clear()
            known = plain.__name__ in nodes
            made = noting(plain.__name__, value) if known else plain
            setattr(module, name, wrapped.setdefault(id(value), made))
    for name, arguments in origins:
        function = getattr(symbolic, name)
        if name in nodes:
            function()
        else:
            worked_out(name, result, name, *arguments)
    return {name: sorted(found) for name, found in calls.items()}
