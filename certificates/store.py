"""The store: the statement file and the certificate file, a line for each statement, in canonical
bytes, written aside and renamed.
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

STATEMENTS, CERTIFICATES = checker.STATEMENTS, checker.CERTIFICATES
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


def certificate_lines(certificates: Mapping[str, Any]) -> bytes:
    """A line ["ID/part", certificate] for each statement, sorted by name, as the checker reads it.

    >>> certificate_lines({"b/main": {"unknown": ""}, "a/main": {"refuted": []}})
    b'["a/main",{"refuted":[]}]\\n["b/main",{"unknown":""}]\\n'
    """
    return b"".join(canonical([name, certificates[name]]) for name in sorted(certificates))


class Store:
    """The statements and certificates of a folder, as last written; an absent folder is an empty
    store.
    """

    def __init__(self, folder: Path = DEFAULT) -> None:
        self.folder = folder
        self.texts: dict[str, str] = {}
        self._certificates: dict[str, Any] | None = None
        path = folder / STATEMENTS
        if path.exists():
            for block in checker.load(str(path)).split("\n\n"):
                rows = [
                    row
                    for row in block.splitlines()
                    if row and not row.startswith(("#", "define "))
                ]
                if rows and rows[0].startswith("statement "):
                    self.texts[rows[0].removeprefix("statement ")] = "\n".join(rows)

    def certificate(self, name: str, text: str) -> Any:
        """The stored certificate of a statement, if the stored statement has this very text; else
        None.
        """
        if self.texts.get(name) != text:
            return None
        if self._certificates is None:
            try:
                lines = checker.load(str(self.folder / CERTIFICATES))
                self._certificates, _ = checker.read_certificates(lines)
            except checker.Rejected:
                self._certificates = {}
        return self._certificates.get(name)

    def only(self, claims: Collection[str]) -> Store:
        """What the store has of some claims, read from their files: plain data."""
        part = object.__new__(Store)
        part.folder = self.folder
        part.texts = {
            name: text for name, text in self.texts.items() if name.split("/")[0] in claims
        }
        part._certificates = {
            name: self.certificate(name, text) for name, text in part.texts.items()
        }
        return part


def write_store(
    folder: Path, statements: str, certificates: Mapping[str, Mapping[str, Any]]
) -> int:
    """Writes the statement file and the certificates of every claim; returns the files changed."""
    lines = {name: one for entries in certificates.values() for name, one in entries.items()}
    changed = write_file(folder / STATEMENTS, statements.encode())
    return changed + write_file(folder / CERTIFICATES, certificate_lines(lines))
