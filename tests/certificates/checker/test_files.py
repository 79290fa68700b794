"""The checker as it is run, alone on a folder: exit codes, and one line for each thing that is
wrong, whatever the files hold.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CHECKER = Path(__file__).resolve().parents[3] / "certificates" / "checker.py"
TRUE = "statement a/b\nforall x\nshow x^2 + 1 > 0\n"
GOOD = (
    '{"a/b": {"certified": ["proof", [], ["psatz", [[1, [[0, 1]], "1"], [1, [], "x"], [1, [],'
    ' "1"]], []]], "point": ["a/b", [], {"x": "0"}, ["close"]]}}'
)
UNKNOWN = '{"a/b": {"unknown": "no search"}}'


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-I", "-S", str(CHECKER), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=60,
    )


def check(
    folder: Path, statements: str | bytes, **files: str | bytes
) -> subprocess.CompletedProcess[str]:
    for name, content in {
        "statements.txt": statements,
        **{f"{name}.json": content for name, content in files.items()},
    }.items():
        (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    return run(folder)


def test_exit_0_where_nothing_is_rejected(tmp_path: Path) -> None:
    done = check(
        tmp_path,
        "# a title\n\n" + TRUE + "\n" + TRUE.replace("a/b", "a/c"),
        a=GOOD[:-1] + ', "a/c": {"unknown": ""}}',
    )
    assert (done.returncode, done.stdout, done.stderr) == (
        0,
        "2 statements: 1 certified, 0 refuted, 1 unknown, 0 rejected\n",
        "",
    )


def test_exit_1_where_a_certificate_is_rejected(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE, a=GOOD.replace('"x"]', '"x + 1"]'))
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.splitlines() == [
        "rejected  a/b: the certificate's sum is not zero: 2*x + 1",
        "1 statements: 0 certified, 0 refuted, 0 unknown, 1 rejected",
    ]


def test_exit_2_where_the_folder_cannot_be_used(tmp_path: Path) -> None:
    for arguments in ([tmp_path], [tmp_path / "none"], [CHECKER], [tmp_path, tmp_path]):
        done = run(*arguments)
        assert (done.returncode, done.stdout) == (2, "")
        assert one_line(done.stderr).startswith("checker: ")


def one_line(text: str) -> str:
    assert text.endswith("\n")
    assert text.count("\n") == 1
    assert text.rstrip("\n").isascii()
    assert text.rstrip("\n").isprintable()
    return text


DEEP = "[" * 100_000
CERTIFICATES: dict[str, tuple[str | bytes, str]] = {
    "nothing": ("", "not a certificate file"),
    "half a file": (GOOD[:-1], "not a certificate file"),
    "two files": (GOOD + GOOD, "not a certificate file"),
    "a list": ("[]", "not a certificate file"),
    "a number": ("1", "not a certificate file"),
    "a byte order mark": (b"\xef\xbb\xbf" + GOOD.encode(), "a file"),
    "bytes that are no text": (b"\xff\xfe\x00", "a file"),
    "a null character": ('{"a/b": "\0"}', "a file"),
    "deep nesting": (DEEP, "not a certificate file"),
    "deep nesting of objects": ('{"a":' * 100_000, "not a certificate file"),
    "a key twice": (GOOD[:-1] + ", " + GOOD[1:], "a key stands twice"),
    "a key twice deep inside": (
        GOOD.replace('"x": "0"', '"x": "0", "x": "0"'),
        "a key stands twice: ['x', 'x']",
    ),
    "a float": (GOOD.replace("[[1,", "[[1.0,", 1), "not an exact integer: 1.0"),
    "an exponent": (GOOD.replace("[[1,", "[[1e0,", 1), "not an exact integer: 1e0"),
    "NaN": (GOOD.replace("[[1,", "[[NaN,", 1), "not an exact integer: NaN"),
    "Infinity": (GOOD.replace("[[1,", "[[-Infinity,", 1), "not an exact integer: -Infinity"),
    "a number of 10000 digits": (
        GOOD.replace("[[1,", "[[1" + "0" * 10_000 + ",", 1),
        "not a certificate file",
    ),
    "a comment": ("// " + GOOD, "not a certificate file"),
}


def closing(node: str) -> str:
    """A certificate, as text, whose node is closed by the text of a node."""
    return f'{{"certified": ["proof", [], {node}], "point": []}}'


def sign(term: str) -> str:
    return closing(f'["sign", "{term}", [], [], []]')


ENTRIES: dict[str, tuple[str, str]] = {
    "null": ("null", "no certificate"),
    "a text": ('"certified"', "a certificate with missing or left over keys: []"),
    "a list": ('["unknown"]', "a certificate with missing or left over keys: []"),
    "nothing": ("{}", "no certificate"),
    "a line break in a term": (sign("x\\n1 statements: 1 certified"), "unreadable text: "),
    "half a character": (sign("\\ud800"), "unreadable text: "),
    "an escape sequence": (sign("\\u001b[2J"), "unreadable text: "),
    "a line break in a rule": (closing('["no\\nrule"]'), "an unknown rule: "),
    "a deep term": (sign("(" * 90 + "x" + ")" * 90 + "+x" * 2000), ""),
    "a long sum": (sign("x" + "+x" * 100_000), ""),
    "many minuses": (sign("-" * 100_000 + "x"), ""),
    "deep nodes": (closing('["sign", "x", ' * 300 + "[]" + ", [], []]" * 300), ""),
}


def test_rejects_a_file_that_is_no_certificate_file(tmp_path: Path) -> None:
    files = {f"e{k}": content for k, (content, _) in enumerate(CERTIFICATES.values())}
    done = check(tmp_path, "\n".join(TRUE.replace("a/b", name + "/b") for name in files), **files)
    assert (done.returncode, done.stderr) == (1, "")
    rows = done.stdout.splitlines(keepends=True)
    for name, (_, reason) in zip(files, CERTIFICATES.values()):
        assert one_line(
            next(row for row in rows if row.startswith(f"rejected  {name}: "))
        ).startswith(f"rejected  {name}: {reason}")
        assert f"rejected  {name}/b: no certificate\n" in rows
    assert rows[-1].endswith(f" 0 certified, 0 refuted, 0 unknown, {2 * len(files)} rejected\n")


def test_rejects_an_entry_that_is_no_certificate(tmp_path: Path) -> None:
    names = {f"e{k}/b": entry for k, entry in enumerate(ENTRIES.values())}
    files = {name.split("/")[0]: f'{{"{name}": {entry}}}' for name, (entry, _) in names.items()}
    done = check(tmp_path, "\n".join(TRUE.replace("a/b", name) for name in names), **files)
    assert (done.returncode, done.stderr) == (1, "")
    *rows, last = done.stdout.splitlines(keepends=True)
    assert [
        row
        for row, (name, (_, reason)) in zip(rows, names.items(), strict=True)
        if not one_line(row).startswith(f"rejected  {name}: {reason}")
    ] == []
    assert (
        last
        == f"{len(names)} statements: 0 certified, 0 refuted, 0 unknown, {len(names)} rejected\n"
    )


def test_rejects_what_is_left_over(tmp_path: Path) -> None:
    done = check(
        tmp_path,
        TRUE,
        a=GOOD[:-1] + ', "a/c": 1, "a/d\\n1 statements: 1 certified": 2, "\\ud800": 3}',
        z=UNKNOWN,
    )
    assert (done.returncode, done.stderr) == (1, "")
    rows = done.stdout.splitlines()
    assert [
        row.startswith("rejected  ") and row.endswith(": a certificate without a statement")
        for row in rows
    ] == [True] * 4 + [False]
    assert rows[-1] == "5 statements: 1 certified, 0 refuted, 0 unknown, 4 rejected"


def test_rejects_a_missing_certificate(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE)
    assert done.returncode == 1
    assert done.stdout.splitlines()[0].startswith("rejected  a: a file cannot be read")
    done = check(tmp_path, TRUE, a="{}")
    assert (done.returncode, done.stdout.splitlines()[0]) == (1, "rejected  a/b: no certificate")


def test_rejects_an_empty_set_of_statements(tmp_path: Path) -> None:
    for nothing in ("", "\n\n", "# only a title\n"):
        done = check(tmp_path, nothing)
        assert (done.returncode, done.stdout) == (
            1,
            "0 statements: 0 certified, 0 refuted, 0 unknown, 0 rejected\n",
        )


STATEMENTS: dict[str, str | bytes] = {
    "a line of another script": "statement a/b\nforall x\n# \u2028given x > 0\nshow x > 0\n",
    "a mark that turns the text around": "statement a/b\nforall x\n# \u202egiven\nshow x > 0\n",
    "a form feed": "statement a/b\nforall x\n# \x0cgiven x > 0\nshow x > 0\n",
    "a blank that is none": "statement a/b\nforall x\u00a0y\nshow x > y\n",
    "a separator": "statement a/b\nforall x\x1cy\nshow x > y\n",
    "bytes that are no text": b"statement a/b\nshow 1 < 2 \xff\n",
    "a byte order mark": b"\xef\xbb\xbfstatement a/b\nshow 1 < 2\n",
    "no name": "statement\nshow 1 < 2\n",
    "a path for a name": "statement ../../a/b\nshow 1 < 2\n",
    "a line out of order": "statement a/b\nshow 1 < 2\nforall x\n",
    "a number of 5000 hexadecimal digits": (
        "statement a/b\nforall x K\ninteger K\niterates 0x" + "f" * 5000 + " -> x\nafter K -> x\n"
    ),
    "calls of calls": "statement a/b\nroot s = sqrt" + "(x)" * 950 + "\nshow 0 = 0\n",
    "a formula of 200000 brackets": "statement a/b\nshow " + "(" * 200_000 + "\n",
    "a formula of two million characters": (
        "statement a/b\nshow 1 < 2" + " and 1 < 2" * 200_000 + "\n"
    ),
    "a sum of 100000 terms": "statement a/b\nshow 0 < 1" + "+1" * 100_000 + "\n",
    "starred arguments": "statement a/b\nroot s = sqrt(*x)\nfrom os import path\n",
}


@pytest.mark.parametrize("name", STATEMENTS)
def test_exit_2_where_statements_cannot_be_read(tmp_path: Path, name: str) -> None:
    done = check(tmp_path, STATEMENTS[name], a=UNKNOWN)
    assert (done.returncode, done.stdout) == (2, "")
    assert one_line(done.stderr).startswith("checker: ")


def test_a_file_without_end_is_rejected(tmp_path: Path) -> None:
    (tmp_path / "a.json").symlink_to("/dev/zero")
    (tmp_path / "statements.txt").write_text(TRUE)
    done = run(tmp_path)
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.startswith("rejected  a: a file")


def test_names_of_files_cannot_fake_a_line(tmp_path: Path) -> None:
    (tmp_path / "x\n1 statements: 1 certified.json").write_text("{}")
    (tmp_path / os.fsdecode(b"\xff.json")).write_text("{}")
    done = check(tmp_path, TRUE, a=GOOD)
    assert (done.returncode, done.stderr) == (1, "")
    assert len(done.stdout.splitlines()) == 3
    assert done.stdout.isascii()
