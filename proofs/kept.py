"""What is kept between runs."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, get_args

from juggleproof.certificates.language import ClaimError, MapRule, Statement
from juggleproof.certificates.store import canonical, write_file
from juggleproof.proofs.claims import Assertion, Body, Claim, assertions, named_statements

# -------------------------------------------------------------------------------------------------
# A file outside the tree with the records of the last runs, under a digest of all that they depend
# on; every fault of it only costs time.
#
# What is read back is compared, statement by statement, with the store (`juggleproof.proofs.kept`),
# and the
# checker reads the store in every run. Figures are kept likewise
# (`juggleproof.proofs.reports.figures`): they are
# shown, and nothing is concluded from them. JUGGLEPROOF_CACHE names another folder, or is `off`.

VARIABLE = "JUGGLEPROOF_CACHE"
ROOT = Path(__file__).resolve().parents[1]
SOURCES = ("symbolic", "proofs", "certificates")
TOOLS = ("sympy", "mpmath", "z3-solver", "python-flint", "highspy", "numpy")
KEPT = 8  # files of a kind, each of one state of the sources, or of the store
LARGEST = 50_000_000


def folder() -> Path | None:
    """Where records are kept: JUGGLEPROOF_CACHE, or juggleproof in the user's cache folder; None
    where it is off or there is no home.
    """
    chosen = os.environ.get(VARIABLE, "")
    if chosen == "off":
        return None
    if chosen:
        return Path(chosen)
    try:
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "juggleproof"
    except RuntimeError:
        return None


def key(*settings: object, root: Path = ROOT, packages: Sequence[str] = SOURCES) -> str:
    """A digest of the packages' sources, the versions of Python and of the libraries, and the
    settings.
    """
    said = hashlib.sha256(
        repr((sys.version, [(tool, version_of(tool)) for tool in TOOLS], settings)).encode()
    )
    for path in _sources(root, packages):
        content = path.read_bytes()
        said.update(f"\n{path.relative_to(root).as_posix()} {len(content)}\n".encode())
        said.update(content)
    return said.hexdigest()


def version_of(tool: str) -> str:
    """The version of a library, or that it is absent."""
    try:
        return version(tool)
    except PackageNotFoundError:
        return "absent"


def _sources(root: Path, packages: Sequence[str] = SOURCES) -> Iterator[Path]:
    for package in packages:
        yield from sorted((root / package).rglob("*.py"))


def load(key: str) -> list[dict[str, Any]]:
    """The records that were kept under the key; none where there is no such file, or it is not
    whole, or not the user's own.
    """
    place = folder()
    if place is None:
        return []
    path = place / f"{key}.json"
    try:
        found = path.stat()
        if (
            found.st_size > LARGEST
            or hasattr(os, "getuid")
            and (found.st_uid != os.getuid() or found.st_mode & 0o022)
        ):
            return []
        head, _, rest = path.read_bytes().partition(b"\n")
        if head.decode() != hashlib.sha256(key.encode() + rest).hexdigest():
            return []
        records = json.loads(rest)["records"]
        return (
            records
            if isinstance(records, list) and all(isinstance(one, dict) for one in records)
            else []
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError, MemoryError):
        return []


def keep(key: str, records: Sequence[dict[str, Any]]) -> None:
    """Keeps the records under the key, and only the latest few files; a folder that cannot be
    written is let be.
    """
    place = folder()
    if place is None:
        return
    content = canonical({"records": list(records)})
    try:
        write_file(
            place / f"{key}.json",
            hashlib.sha256(key.encode() + content).hexdigest().encode() + b"\n" + content,
        )
        files = sorted(
            place.glob(key[:-64] + "[0-9a-f]" * 64 + ".json"),
            key=lambda path: path.stat().st_mtime,
            reverse=True,
        )
        for path in files[KEPT:]:
            path.unlink()
    except (OSError, ClaimError):
        return


# -------------------------------------------------------------------------------------------------
# What a claim comes to, as plain data with digests in place of statements: enough to know again,
# beside the store, what is judged.
#
# A record holds no statement: it says which stored ones the claim's sources build, by the digest of
# each text, and in what shape they make up the claim.  What does not agree with the store to the
# letter is not known again, and the claim is stated anew from its sources.

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
        "nearby": claim.true_nearby is not None,
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
        true_nearby=("", read) if record["nearby"] else None,
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
