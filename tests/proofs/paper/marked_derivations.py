"""Prints, as JSON, which derivations the statements of each claim contain, found without what terms
say of their origins: every function of `symbolic` adds a name of its own to all that it returns
before the claims are loaded, and the names are looked for in the texts of the statements.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from types import FunctionType
from typing import Any

from sympy import Expr, MatrixBase, Symbol

from juggleproof import symbolic
from juggleproof.judging.judgement import statements_of
from juggleproof.judging.run import findings_in
from juggleproof.papers.derived import derive_again
from juggleproof.papers.paper import opened
from juggleproof.statements.language import Term
from juggleproof.statements.store import DEFAULT

NAMED = {"collide": "impact_map"}  # the impact of two states is a value of the derived impact map
marks: list[str] = []


def marked(value: Any, mark: Symbol) -> Any:
    """The value with the mark added to every expression in it; of a vector to each entry another
    multiple, which their difference keeps.
    """
    if isinstance(value, MatrixBase):
        return type(value)(*value.shape, [n * mark + one for n, one in enumerate(value, 1)])
    if isinstance(value, Expr):
        return value + mark
    if isinstance(value, tuple):
        parts = [marked(part, mark) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value


def marking(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, with a mark for the name and the arguments added to what it returns."""

    def call(*arguments: Any) -> Any:
        own = "" if name in NAMED else f"({', '.join(map(str, arguments))})" if arguments else ""
        made = NAMED.get(name, name) + own
        if made not in marks:
            marks.append(made)
        return marked(function(*arguments), Symbol(f"mark_{marks.index(made)}"))

    return call


def count_marks_as_zero() -> None:
    """Lets the value of a term at a point be found in spite of its marks: the value is a number,
    and contains no derived expression.  To be called before the claims are loaded.
    """
    from juggleproof.proofs.theorem import definition

    plain = definition.value_of

    def value_of(expression: Term, point: Mapping[str, Fraction]) -> Fraction:
        zero = {f"mark_{index}": Fraction(0) for index in range(len(marks))}
        return plain(expression, {**zero, **point})

    definition.value_of = value_of


def main() -> None:
    derive_again()
    for name in dir(symbolic):
        function = getattr(symbolic, name)
        if isinstance(getattr(function, "__wrapped__", function), FunctionType):
            if not name.startswith("_"):
                setattr(symbolic, name, marking(name, function))
    count_marks_as_zero()
    found, findings = {}, findings_in(DEFAULT)
    for claim in opened().claims():
        correction = findings.get(claim.id, {}).get("correction")
        texts = [part.text() for part in statements_of(claim, correction)]
        numbers = re.findall(r"\bmark_(\d+)\b", "\n".join(texts))
        found[claim.id] = sorted({marks[int(number)] for number in numbers})
    print(json.dumps(found))


if __name__ == "__main__":
    main()
