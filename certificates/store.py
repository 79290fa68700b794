"""The store: the statement file and the certificate file, a line for each statement, in canonical
bytes, written aside and renamed.
"""

from __future__ import annotations

import json
import os
import re
import tempfile
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache, partial
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.certificates.definitions import Definition, Reader, defining_lines, short_line
from juggleproof.certificates.formulas import ClaimError
from juggleproof.certificates.nodes import Certificate

STATEMENTS, CERTIFICATES = checker.STATEMENTS, checker.CERTIFICATES
DEFAULT = Path(__file__).resolve().parent / "store"


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
    """The path of a file that a user names, or that lies in a folder of the user's: every such file
    is asked about here before it is opened, since a pipe or a device might never end.

    Raises ClaimError, one line, where something else than a file is there; a file may be missing.

    >>> plain_file(Path("/dev/zero"))
    Traceback (most recent call last):
    juggleproof.certificates.formulas.ClaimError: /dev/zero: is no plain file; name one that is
    """
    if os.path.exists(path) and not os.path.isfile(path):
        raise ClaimError(f"{path}: is no plain file; name one that is")
    return path


def write_file(path: Path, content: bytes) -> bool:
    """Writes the file unless it has this content already; never leaves half of it.  Returns whether
    anything was written.

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


UNPRINTABLE = re.compile(r"[^ -~]")


class WrittenOut(Mapping[str, str]):
    r"""The statements of a statement file by name, each with its definitions written out when it is
    asked for; of a file that the checker takes, the very ones that it reads.

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


# Stores of one process that read the same file share what is written out of it, and what it holds.
written_out = lru_cache(maxsize=4)(WrittenOut)


@lru_cache(maxsize=1)
def _certificates_of(lines: str) -> Mapping[str, Certificate | None]:
    return checker.read_certificates(lines)[0]


class Store:
    """The statements and certificates of a folder, as last written; an absent folder is an empty
    store.  Raises ClaimError, one line, where its statements cannot be read.
    """

    def __init__(self, folder: Path = DEFAULT) -> None:
        self.folder = folder
        self.texts: Mapping[str, str] = {}
        self._certificates: Mapping[str, Certificate | None] | None = None
        path = folder / STATEMENTS
        if path.exists():
            try:
                self.texts = written_out(checker.load(str(path)))
            except checker.Rejected as reason:
                raise ClaimError(f"{folder}: {reason}; name another folder") from None

    def certificate(self, name: str, text: str) -> Certificate | None:
        """The stored certificate of a statement, if the stored statement has this very text; else
        None.  It is what the file holds, with lists for tuples, and not checked.
        """
        if self.texts.get(name) != text:
            return None
        if self._certificates is None:
            try:
                lines = checker.load(str(self.folder / CERTIFICATES))
                self._certificates = _certificates_of(lines)
            except checker.Rejected:
                self._certificates = {}
        return self._certificates.get(name)

    def only(self, claims: Collection[str]) -> Store:
        """What the store has of some claims, read from their files: plain data."""
        part = object.__new__(Store)
        part.folder = self.folder
        part.texts = {name: self.texts[name] for name in self.texts if name.split("/")[0] in claims}
        part._certificates = {
            name: self.certificate(name, text) for name, text in part.texts.items()
        }
        return part


def statement_file(
    title: str,
    chapters: Iterable[tuple[str, Sequence[str]]],
    definitions: Sequence[Definition],
    held: Mapping[str, str],
) -> str:
    r"""The text of a statement file: the title and what stands above the statements of each claim
    as comments, the definitions, and the statements, shortened by them.

    Statements that are as they are `held` by a file with the same definitions are taken from it.

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
