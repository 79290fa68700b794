"""The store: the statement file, and the certificate file with a line for each statement.  Both
have canonical bytes; each is written to a temporary file, which is then renamed.
"""

from __future__ import annotations

import json
import operator
import os
import re
import tempfile
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache, partial
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.folders import folder_of
from juggleproof.statements.definitions import Definition, Reader, defining_lines, short_line
from juggleproof.statements.formulas import ClaimError
from juggleproof.statements.nodes import Certificate

STATEMENTS, CERTIFICATES = checker.STATEMENTS, checker.CERTIFICATES
DEFAULT = folder_of("juggleproof.certificates") / "store"


def canonical(data: object) -> bytes:
    """JSON with sorted keys, ASCII only, and a newline at the end: equal data, equal bytes.

    Raises TypeError for what JSON cannot hold.

    >>> canonical({"b": [1, "x"], "a": {}})
    b'{"a":{},\\n"b":[1,"x"]}\\n'
    """

    def write(value: object) -> str:
        return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=True)

    if not isinstance(data, Mapping):
        return (write(data) + "\n").encode()
    rows = [f"{write(key)}:{write(data[key])}" for key in sorted(data)]
    return ("{" + ",\n".join(rows) + "}\n").encode()


def plain_file(path: Path) -> Path:
    """The path, unless it is a pipe, a device or a folder: reading one might never end, so every
    path of a user is tested here before it is opened.

    Raises ClaimError, one line, where something else than a file is there; a file may be missing.

    >>> plain_file(Path("/dev/zero"))
    Traceback (most recent call last):
    juggleproof.statements.formulas.ClaimError: /dev/zero: is no plain file; name one that is
    """
    if os.path.exists(path) and not os.path.isfile(path):
        raise ClaimError(f"{path}: is no plain file; name one that is")
    return path


def write_file(path: Path, content: bytes) -> bool:
    """Writes the file unless it has this content already; never leaves a part of the content.
    Returns whether anything was written.

    Raises ClaimError, one line that names the path, where the folder cannot be written, or where
    something else than a file has the name.
    """
    try:
        if plain_file(path).exists() and path.read_bytes() == content:
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


def certificate_lines(certificates: Mapping[str, Certificate]) -> bytes:
    """A line ["ID/part", certificate] for each statement, sorted by name, as the checker reads it.

    >>> certificate_lines({"b/main": {"unknown": ""}, "a/main": {"refuted": []}})
    b'["a/main",{"refuted":[]}]\\n["b/main",{"unknown":""}]\\n'
    """
    return b"".join(canonical([name, certificates[name]]) for name in sorted(certificates))


NAMED_LINE = re.compile(r'\["([\w.\-]+/[\w.\-]+)",.*', re.ASCII)
UNPRINTABLE = re.compile(r"[^ -~]")


class WrittenOut(Mapping[str, str]):
    r"""The statements of a statement file by name, as the checker reads them: each has its
    definitions written out when it is first asked for.

    >>> file = "define d(x) := x - 1\n\n# of d\nstatement a/b\nforall x\nshow d(x) < x"
    >>> WrittenOut(file)["a/b"]
    'statement a/b\nforall x\nshow x - 1 < x'
    """

    def __init__(self, text: str) -> None:
        head = next((one for one in text.split("\n\n") if "\ndefine " in "\n" + one), "")
        self.definitions = head.splitlines()  # with their comments
        self.shortened: dict[str, list[str]] = {}  # the lines of each statement as they stand
        defined, rows = list[str](), list[str]()
        for _, keyword, rest in checker.rows(text):
            if keyword == "define":
                defined.append(f"{keyword} {rest}")
            elif keyword:
                if keyword == "statement":
                    self.shortened[rest] = rows = []
                rows.append(f"{keyword} {rest}")
        self._defined = defined
        self._reader = Reader(defined)
        self._texts: dict[str, str] = {}

    def __getitem__(self, name: str) -> str:
        if name not in self._texts:
            self._texts[name] = "\n".join(map(self._reader.long_line, self.shortened[name]))
        return self._texts[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.shortened)

    def __len__(self) -> int:
        return len(self.shortened)

    def named_by(self, name: str) -> list[str]:
        """The statements whose names occur in the lines of this one."""
        lines = (line.partition(" ") for line in self.shortened[name])
        return [
            one
            for keyword, _, rest in lines
            if keyword in checker.NAMED or keyword == "sharp"
            for one in rest.split()
        ]

    def read(self, names: Iterable[str]) -> dict[str, checker.Statement]:
        r"""These statements and all that they name, parsed by the checker, in the file's order; no
        others are parsed.

        >>> [*WrittenOut("statement a/b\nshow 0 < 1\n\nstatement a/c\nshow 0 < 2").read(["a/c"])]
        ['a/c']
        """
        below = [name for name in names if name in self.shortened]
        wanted = {*below}
        for name in below:
            new = {*self.named_by(name)} & self.shortened.keys() - wanted
            wanted |= new
            below += new
        blocks = ["\n".join(lines) for name, lines in self.shortened.items() if name in wanted]
        return checker.read_statements("\n\n".join(["\n".join(self._defined), *blocks]))


# Stores of one process that read the same file share its statements and its certificates.
written_out = lru_cache(maxsize=4)(WrittenOut)


class CertificateLines:
    """The certificates of a file by name; a line is parsed when its certificate is asked for."""

    def __init__(self, text: str, read: Mapping[str, Certificate | None] | None = None) -> None:
        found = [NAMED_LINE.match(line) for line in text.split("\n")[:-1]]
        names = [one[1] for one in found if one]
        self._lines: dict[str, str] = {}
        self._read: dict[str, Certificate | None] = {**(read or {})}
        if len(names) == len(found) and all(map(operator.lt, names, names[1:])):
            self._lines = {one[1]: one.string for one in found if one}
        else:  # not in the form that is written here: the checker reads the whole file
            self._read.update(checker.read_certificates(text)[0])

    def __getitem__(self, name: str) -> Certificate | None:
        if name not in self._read and name in self._lines:
            line = self._lines[name] + "\n"
            self._read[name] = checker.read_certificates(line)[0].get(name)
        return self._read.get(name)


lines_of = lru_cache(maxsize=1)(CertificateLines)


class Store:
    """The statements and certificates of a folder, as last written; an absent folder is an empty
    store.  Raises ClaimError, one line, where its statements cannot be read.
    """

    def __init__(self, folder: Path = DEFAULT) -> None:
        self.folder = folder
        self.texts: Mapping[str, str] = {}
        self._lines: CertificateLines | None = None
        path = folder / STATEMENTS
        if path.exists():
            try:
                self.texts = written_out(checker.load(str(path)))
            except checker.Rejected as reason:
                raise ClaimError(f"{folder}: {reason}; name another folder") from None

    def certificate(self, name: str, text: str) -> Certificate | None:
        """The stored certificate of a statement, if the stored statement has this very text; else
        None.  It is unchecked, and has lists in place of tuples.
        """
        return self.certificate_named(name) if self.texts.get(name) == text else None

    def certificate_named(self, name: str) -> Certificate | None:
        """The stored certificate of this name; None where there is none, or the file cannot be
        read.
        """
        try:
            return self.certificates()[name]
        except checker.Rejected:
            return None

    def certificates(self) -> CertificateLines:
        """The stored certificates by name; raises Rejected where their file cannot be read."""
        if self._lines is None:
            self._lines = lines_of(checker.load(str(self.folder / CERTIFICATES)))
        return self._lines

    def only(self, claims: Collection[str]) -> Store:
        """The part of the store that belongs to some claims, read from the files, as plain data."""
        part = object.__new__(Store)
        part.folder = self.folder
        part.texts = {name: self.texts[name] for name in self.texts if name.split("/")[0] in claims}
        part._lines = CertificateLines(
            "", {name: self.certificate_named(name) for name in part.texts}
        )
        return part


def statement_file(
    title: str,
    chapters: Iterable[tuple[str, Sequence[str]]],
    definitions: Sequence[Definition],
    held: Mapping[str, str],
) -> str:
    r"""The text of a statement file: the title and the heading of each claim as comments, the
    definitions, and the statements, shortened by the definitions.

    `held` is a file that is there; if it has the same definitions, statements that it has with the
    same text are copied from it.

    >>> print(statement_file("All.", [("One.", ["statement a/b\nshow 0 < 1"])], [], {}))
    # All.
    <BLANKLINE>
    # One.
    <BLANKLINE>
    statement a/b
    show 0 < 1
    <BLANKLINE>
    """
    lines = defining_lines(definitions)
    known = held if isinstance(held, WrittenOut) and held.definitions == lines else None
    short = cache(partial(short_line, definitions=definitions))  # claims share many lines
    blocks = [comment(title), *(["\n".join(lines)] if lines else [])]
    for heading, texts in chapters:
        if texts and heading:
            blocks.append(comment(heading))
        for text in texts:
            first, *rows = text.split("\n")
            name = first.removeprefix("statement ")
            if known is not None and known.get(name) == text:
                blocks.append("\n".join(known.shortened[name]))
            else:
                blocks.append("\n".join([first, *map(short, rows)]))
    return "\n\n".join(blocks) + "\n"


def comment(text: str) -> str:
    r"""The lines of a text, each a comment of the statement file, which is printable ASCII only.

    >>> print(comment("alpha\u00b2\ndefine x := 1"))
    # alpha\xb2
    # define x := 1
    """
    lines = (ascii(line)[1:-1] if not line.isascii() else line for line in text.splitlines())
    return "\n".join(f"# {re.sub(UNPRINTABLE, '?', line)}".rstrip() for line in lines)


def write_store(
    folder: Path, statements: str, certificates: Mapping[str, Mapping[str, Certificate]]
) -> int:
    """Writes the statement file and the certificates of every claim; returns how many of the two
    files are changed.  Raises ClaimError where the folder cannot be written.
    """
    lines = {name: one for entries in certificates.values() for name, one in entries.items()}
    changed = write_file(folder / STATEMENTS, statements.encode())
    return changed + write_file(folder / CERTIFICATES, certificate_lines(lines))
