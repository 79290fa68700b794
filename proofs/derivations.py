"""What a claim rests on in `symbolic`: each derivation that it uses, with what this says of itself,
its result, and what it is made from.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from types import CodeType
from typing import Any

from juggleproof import symbolic
from juggleproof.certificates import checker
from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.claims import Body, Claim

Rows = tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Derivation:
    """A derived expression: the function of `symbolic` with its arguments, its docstring's first
    sentence, its entries, what it calls.

    `shown` has the entries in the paper's manner, where T stands for 2 r/g.
    """

    function: str
    said: str
    rows: Rows
    shown: Rows
    uses: tuple[str, ...]

    @property
    def line(self) -> str:
        """The derivation in one line, as `explain` tells it."""
        shown = "; ".join(
            "(" * (len(row) > 1) + ", ".join(row) + ")" * (len(row) > 1) for row in self.rows
        )
        return f"symbolic.{self.function.partition('(')[0]}: {self.said} {shown}"

    @property
    def title(self) -> str:
        """What is derived, in words: the sentence up to its colon, without formula or source."""
        arguments = self.function.partition("(")[2].rstrip(")")
        said = re.sub(
            r" \((section|equation|inequality|appendix|after|figure)[^()]*\)",
            "",
            self.said.partition(":")[0],
        ).rstrip(".")
        return said + (f", for {arguments}" if arguments else "")

    def data(self) -> dict[str, Any]:
        """The derivation as plain data."""
        return asdict(self)


def kept_derivations(record: Mapping[str, Any]) -> tuple[list[Derivation], list[Derivation]]:
    """From a claim's record: the derivations that it uses, and all that these are made from."""
    known = [derivation_of(data) for data in record["behind"]]
    by_name = {one.function: one for one in known}
    return [by_name[name] for name in record["derivations"]], known


def derivation_of(data: Mapping[str, Any]) -> Derivation:
    """The derivation from its data, also where this came back from a file."""
    rows, shown = (tuple(tuple(map(str, row)) for row in data[kind]) for kind in ("rows", "shown"))
    return Derivation(
        str(data["function"]), str(data["said"]), rows, shown, tuple(map(str, data["uses"]))
    )


@cache
def derivation(name: str, arguments: tuple[Any, ...] = ()) -> Derivation:
    """The derivation of this name in `symbolic`, worked out.

    >>> derivation("launch_state").line
    'symbolic.launch_state: The table as it leaves the ground: r_0 = (0, r) (section 3.1). (0, r)'
    """
    from juggleproof.proofs.encoding import paper_form
    from juggleproof.proofs.paper.names import rows_of

    value = getattr(symbolic, name)(*arguments)
    rows = rows_of(name, arguments)
    entries = [
        str(paper_form(entry)) for entry in (value if hasattr(value, "shape") else [value])
    ]  # by rows
    width = value.shape[1] if getattr(value, "shape", (1, 1))[1] > 1 else len(entries)
    manner = tuple(tuple(entries[start : start + width]) for start in range(0, len(entries), width))
    summary = (inspect.getdoc(getattr(symbolic, name)) or "").partition("\n\n")[0]
    said = " ".join(summary.split())
    shown = f"({', '.join(map(str, arguments))})" if arguments else ""
    return Derivation(name + shown, said, rows, manner, made_from(name))


@cache
def made_from(name: str) -> tuple[str, ...]:
    """The derivations without arguments that this one calls, itself or through functions that take
    some, in the order of its code.

    >>> made_from("E_max")
    ('normal_energy_change', 'unscaling', 'collision_margin', 'period', 'normal_energy')
    >>> made_from("total_energy")
    ('acceleration',)
    """
    return tuple(dict.fromkeys(_called(getattr(symbolic, name), {name})))


def _called(function: Any, seen: set[str]) -> Iterator[str]:
    plain = inspect.unwrap(function)
    for name in _names_in(plain.__code__):
        called = plain.__globals__.get(name)
        if (
            name in seen
            or not callable(called)
            or not getattr(called, "__module__", "").startswith("juggleproof.symbolic.")
            or inspect.isclass(called)
        ):
            continue
        seen.add(name)
        if _is_derivation(called, name):
            yield name
        else:
            yield from _called(called, seen)


def _names_in(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for inner in code.co_consts:  # comprehensions and inner functions
        if isinstance(inner, CodeType):
            yield from _names_in(inner)


def _is_derivation(function: Any, name: str) -> bool:
    """Whether it takes no arguments and comes to an expression, column or matrix."""
    if name not in dir(symbolic) or inspect.signature(function).parameters:
        return False
    return inspect.unwrap(function).__annotations__.get("return") in (
        "Expr",
        "State",
        "ImmutableMatrix",
    )


def behind(derivations: Sequence[Derivation]) -> list[Derivation]:
    """All that the derivations are made from, themselves included, each after what it is made from.

    >>> [one.function for one in behind([derivation("total_energy")])]
    ['acceleration', 'total_energy']
    """
    ordered: dict[str, Derivation] = {}

    def visit(one: Derivation) -> None:
        for name in one.uses:
            if name not in ordered:
                visit(derivation(name))
        ordered.setdefault(one.function, one)

    for one in derivations:
        visit(one)
    return list(ordered.values())


def body_and_derivations(claim: Claim) -> tuple[Body, list[Derivation]]:
    """What the claim asserts, and each derivation used: the constants that its print names, then
    what its reading asks for.

    Raises ClaimError, naming the claim, for whatever the function of a claim outside of this
    package raises.
    """
    if not claim.source.startswith(
        ("juggleproof.proofs.paper.", "juggleproof.proofs.theorem.", "juggleproof.proofs.part.")
    ):
        try:
            return claim.body(), []
        except (checker.Rejected, ClaimError):
            raise
        except Exception as problem:
            raise ClaimError(
                f"{claim.id} raises {type(problem).__name__}: {problem}; mend its function"
            ) from problem
    from juggleproof.proofs.paper import names

    names.derivations_used.clear()
    body = claim.body()
    used = dict.fromkeys([*((name, ()) for name in _constants_in(claim)), *names.derivations_used])
    return body, [derivation(name, arguments) for name, arguments in used]


def _constants_in(claim: Claim) -> list[str]:
    """The derivations behind the constants that the print names."""
    from juggleproof.proofs.paper.names import CONSTANTS
    from juggleproof.proofs.reading.parser import parse_name

    if not claim.printed:
        return []
    printed = set()
    for name in claim.read_print().names:
        try:
            printed.add(parse_name(name))
        except ClaimError:  # a name with a place for an argument is no constant
            continue
    return [derivation for latex, derivation in CONSTANTS.items() if parse_name(latex) in printed]
