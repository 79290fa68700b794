"""What a claim comes to, as plain data with digests in place of statements: enough to know again,
beside the store, what is judged.

A record holds no statement: it says which stored ones the claim's sources build, by the digest of
each text, and in what shape they make up the claim.  What does not agree with the store to the
letter is not known again, and the claim is stated anew from its sources.
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Collection, Mapping, Sequence
from typing import Any, get_args

from certificates.statements import MapRule, Statement
from proofs.claims import Assertion, Body, Claim, assertions, named_statements

TOLD = ("id", "section", "place", "says", "printed", "as_it_stands", "repeats", "source")
_BODIES = {kind.__name__: kind for kind in get_args(Body)}


class Forgotten(Exception):
    """The record does not agree with the store, or with the work at hand: the claim has to be
    stated from its sources.
    """


@dataclasses.dataclass(frozen=True)
class Quoted:
    """A line of a stored statement, as it stands."""

    text: str

    def __str__(self) -> str:
        return self.text


@dataclasses.dataclass(frozen=True)
class StoredStatement(Statement):
    """A statement as it stands in the store; nothing is searched for it."""

    stored: str = ""

    def text(self) -> str:
        """The stored text, word for word."""
        return f"statement {self.name}\n{self.stored}"

    def undeclared(self) -> set[str]:
        """None: the checker has read it."""
        return set()


@dataclasses.dataclass(frozen=True)
class StoredRule:
    """A recurrence, or another statement that is not for all reals, as it stands in the store."""

    name: str
    stored: str

    def text(self) -> str:
        """The stored text, word for word."""
        return f"statement {self.name}\n{self.stored}"


def digest(text: str) -> str:
    """The digest by which a text is known again."""
    return hashlib.sha256(text.encode()).hexdigest()


def record_of(
    claim: Claim,
    body: Body,
    statements: Sequence[tuple[str, str]],
    voted: Collection[str],
    correction: Mapping[str, Any] | None,
) -> dict[str, Any]:
    """The record of a claim that was just judged."""
    named: dict[int, list[Any]] = {}
    for prefix, assertion in assertions(body):
        named[id(assertion)] = [
            [part.name, whole.name, digest(whole.text()), type(part).__name__]
            for part, whole in zip(assertion.parts, named_statements(claim.id, prefix, assertion))
        ]
    if len(named) != len(assertions(body)):
        return {}
    corrected = [
        [name, digest(text), "Statement" if name in voted else "Iterates"]
        for name, text in statements
        if name.startswith(f"{claim.id}/corrected.")
    ]
    return {
        **{name: getattr(claim, name) for name in TOLD},
        "parameters": list(claim.parameters),
        "nearby": claim.nearby is not None,
        "body": _plain(body, named),
        "correction": dict(correction) if correction else None,
        "corrected": corrected,
    }


def _plain(value: Any, named: Mapping[int, list[Any]]) -> Any:
    if isinstance(value, Assertion):
        return {"Assertion": named[id(value)]}
    if type(value).__name__ in _BODIES:
        return {
            type(value).__name__: {
                one.name: _plain(getattr(value, one.name), named)
                for one in dataclasses.fields(value)
            }
        }
    if isinstance(value, Mapping):
        return {"mapping": [[key, _plain(one, named)] for key, one in value.items()]}
    if isinstance(value, tuple):
        return {"tuple": [_plain(one, named) for one in value]}
    if value is None or isinstance(value, str):
        return value
    raise TypeError(f"a body holds {type(value).__name__}, which no record can hold")


def claim_of(record: Mapping[str, Any]) -> Claim:
    """The claim as a table tells it; what it asserts is not here, and to ask for it raises
    Forgotten.
    """

    def read(*_: object) -> Any:
        raise Forgotten

    told: dict[str, Any] = {name: _text(record[name]) for name in TOLD}
    return Claim(
        **told,
        read=read,
        parameters=tuple(map(_text, record["parameters"])),
        nearby=("", read) if record["nearby"] else None,
    )


def body_of(record: Mapping[str, Any], texts: Mapping[str, str]) -> Body:
    """The body of a claim from its record and the store's texts; raises Forgotten where they do not
    agree.
    """
    body: Body = _body(record["body"], texts)
    return body


def _body(data: Any, texts: Mapping[str, str]) -> Any:
    if data is None or isinstance(data, str):
        return data
    ((kind, inside),) = data.items()
    if kind == "Assertion":
        return Assertion(
            tuple(
                stored_as(label, texts[whole], marked, kind) if whole in texts else _forget()
                for label, whole, marked, kind in inside
            )
        )
    if kind == "mapping":
        return {_text(key): _body(one, texts) for key, one in inside}
    if kind == "tuple":
        return tuple(_body(one, texts) for one in inside)
    return _BODIES[kind](**{name: _body(one, texts) for name, one in inside.items()})


def stored_as(name: str, text: str, marked: str, kind: str) -> Any:
    """A stored text as a statement of this name; raises Forgotten where the text is not the one
    that was marked.
    """
    if digest(text) != marked:
        raise Forgotten
    rest = text.partition("\n")[2]
    if kind == "MapRule":
        return MapRule(
            name,
            tuple(
                (keyword, said)
                for keyword, _, said in (line.partition(" ") for line in rest.split("\n"))
            ),
        )
    if kind not in ("Statement", "StoredStatement"):
        return StoredRule(name, rest)
    lines: Any = tuple(
        (keyword, Quoted(said))
        for keyword, _, said in (line.partition(" ") for line in rest.split("\n"))
    )
    forall, integer = (
        tuple(str(said).split())
        for keyword in ("forall", "integer")
        for said in [_said(lines, keyword)]
    )
    return StoredStatement(name, forall, lines, integer=integer, stored=rest)


def _said(lines: Any, wanted: str) -> str:
    return next((str(said) for keyword, said in lines if keyword == wanted), "")


def _forget() -> Any:
    raise Forgotten


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError("not a text")
    return value
