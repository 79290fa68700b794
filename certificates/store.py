"""The store: the statement file and one certificate file a claim, in canonical bytes, written aside
and renamed.
"""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.language import ClaimError

STATEMENTS = "statements.txt"
DEFAULT = Path(__file__).resolve().parent / "store"


def canonical(data: Any) -> bytes:
    """JSON with sorted keys, ASCII only, and a newline at the end: equal data, equal bytes.

    >>> canonical({"b": [1, "x"], "a": {}})
    b'{"a":{},\\n"b":[1,"x"]}\\n'
    """

    def write(value: Any) -> str:
        return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=True)

    if not isinstance(data, Mapping):
        return (write(data) + "\n").encode()
    rows = [f"{write(key)}:{write(data[key])}" for key in sorted(data)]
    return ("{" + ",\n".join(rows) + "}\n").encode()


def write_file(path: Path, content: bytes) -> bool:
    """Writes the file unless it has this content already; never leaves half of it.  Returns whether
    anything was written.

    Raises ClaimError, one line that names the path, where the folder cannot be written.
    """
    try:
        if path.exists() and path.read_bytes() == content:
            return False
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, aside = tempfile.mkstemp(prefix=".", suffix=path.suffix + ".new", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            os.chmod(aside, 0o644)
            os.replace(aside, path)
        except BaseException:
            os.unlink(aside)
            raise
    except OSError as error:
        raise ClaimError(
            f"{path}: cannot be written ({error.strerror}); choose a folder that can be"
        ) from None
    return True


class Store:
    """The statements and certificates of a folder, as last written; an absent folder is an empty
    store.
    """

    def __init__(self, folder: Path = DEFAULT) -> None:
        self.folder = folder
        self.texts: dict[str, str] = {}
        self._certificates: dict[str, dict[str, Any]] = {}
        path = folder / STATEMENTS
        if path.exists():
            for block in checker.load(str(path)).split("\n\n"):
                rows = [row for row in block.splitlines() if row and not row.startswith("#")]
                if rows and rows[0].startswith("statement "):
                    self.texts[rows[0].removeprefix("statement ")] = "\n".join(rows)

    def certificate(self, name: str, text: str) -> Any:
        """The stored certificate of a statement, if the stored statement has this very text; else
        None.
        """
        if self.texts.get(name) != text:
            return None
        claim = name.split("/")[0]
        if claim not in self._certificates:
            path = self.folder / f"{claim}.json"
            try:
                self._certificates[claim] = checker.read_certificates(checker.load(str(path)))
            except checker.Rejected:
                self._certificates[claim] = {}
        return self._certificates[claim].get(name)

    def only(self, claims: Collection[str]) -> Store:
        """What the store has of some claims, read from their files: plain data."""
        part = object.__new__(Store)
        part.folder, part.texts = (
            self.folder,
            {name: text for name, text in self.texts.items() if name.split("/")[0] in claims},
        )
        part._certificates = {
            claim: {
                name: self.certificate(name, text)
                for name, text in part.texts.items()
                if name.split("/")[0] == claim
            }
            for claim in claims
        }
        return part


def write_store(
    folder: Path, statements: str, certificates: Mapping[str, Mapping[str, Any]]
) -> int:
    """Writes the statement file and the certificates of every claim, removes those of claims that
    are gone; returns the files changed.
    """
    changed = int(write_file(folder / STATEMENTS, statements.encode()))
    for claim, entries in certificates.items():
        changed += write_file(folder / f"{claim}.json", canonical(entries))
    for path in sorted(folder.glob("*.json")):
        if path.stem not in certificates:
            path.unlink()
            changed += 1
    return changed
