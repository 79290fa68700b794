"""An evaluator of statement texts at rational points that shares no code with the checker or the
routes.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any


def fails_at(text: str, model: tuple[tuple[str, str], ...]) -> bool:
    """Whether every assumption of the (universal) statement holds at the point and what it shows
    does not.
    """
    scope: dict[str, Any] = {name: Fraction(value) for name, value in model}
    scope |= {"implies": lambda p, q: not p or q, "iff": lambda p, q: p == q}
    for line in text.splitlines()[1:]:
        keyword, _, rest = line.partition(" ")
        if keyword == "integer" and any(scope[name].denominator != 1 for name in rest.split()):
            return False
        if keyword in ("range", "given", "have") and not value_of(rest, scope):
            return False
        if keyword == "let":
            name, _, body = rest.partition(" = ")
            scope[name] = value_of(body, scope)
        if keyword == "root":
            name, _, body = rest.partition(" = ")
            if scope[name] < 0 or scope[name] ** 2 != value_of(body.removeprefix("sqrt"), scope):
                return False
        if keyword == "show":
            return not value_of(rest, scope)
    raise AssertionError("a statement without show")


def value_of(text: str, scope: dict[str, Any]) -> Any:
    spaced = text.replace("^", "**").replace(" = ", " == ")
    numbers = "".join(f"F({part})" if part.isdigit() else part for part in _tokens(spaced))
    return eval(
        numbers.replace("**F(", "**int("),
        {"__builtins__": {}},
        {**scope, "F": Fraction, "int": int},
    )


def _tokens(text: str) -> list[str]:
    tokens, word = [], ""
    for c in text + " ":
        if c.isalnum() or c == "_":
            word += c
        else:
            tokens += [word, c] if word else [c]
            word = ""
    return tokens
