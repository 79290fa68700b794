"""The checker as it is run, alone on a folder: exit codes, and one line for each thing that is
wrong, whatever the files hold.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import py_compile
import shutil
import subprocess
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout
from importlib.util import cache_from_source
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind, Rejected
from tests.certificates.checker.harness import Expected, refused

CHECKER = Path(__file__).resolve().parents[3] / "certificates" / "checker"
TRUE = "statement a/b\nforall x\nshow x^2 + 1 > 0\n"
PROOF = (
    '{"certified": ["proof", [], ["psatz", [[1, [[0, 1]], "1"], [1, [], "x"], [1, [], "1"]], []]],'
    ' "point": ["a/b", [], {"x": "0"}, ["close"]]}'
)
UNKNOWN = '{"unknown": "no search"}'


def line(name: str, certificate: str) -> str:
    """A line of certificates; the certificate is any text."""
    return f'["{name}", {certificate}]\n'


GOOD = line("a/b", PROOF)


def run(
    *arguments: str | Path,
    folder: Path = CHECKER,
    flags: Sequence[str] = ("-I", "-S"),
    environment: dict[str, str] | None = None,
) -> subprocess.CompletedProcess[str]:
    """The bare checker; the digests of its files, which it prints first, are compared and left
    out.
    """
    program = [sys.executable, *flags, str(folder), *map(str, arguments)]
    done = subprocess.run(program, capture_output=True, text=True, env=environment, timeout=60)
    digests = "".join(
        f"{path.name:12} sha256 {hashlib.sha256(path.read_bytes()).hexdigest()}\n"
        for path in sorted(folder.glob("*.py"))
    )
    assert done.stdout.startswith(digests)
    done.stdout = done.stdout.removeprefix(digests)
    return done


def check(
    folder: Path, statements: str | bytes, certificates: str | bytes | None = None
) -> subprocess.CompletedProcess[str]:
    contents = {"statements.txt": statements, "certificates.jsonl": certificates}
    for name, content in contents.items():
        if content is not None:
            (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    return run(folder)


def test_exit_0_where_every_statement_is_settled(tmp_path: Path) -> None:
    done = check(tmp_path, "# a title\n\n" + TRUE, GOOD)
    assert (done.returncode, done.stdout, done.stderr) == (
        0,
        "1 statements: 1 certified, 0 refuted, 0 unknown, 0 rejected\n",
        "",
    )


def test_exit_1_where_a_statement_is_open(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE + "\n" + TRUE.replace("a/b", "a/c"), GOOD + line("a/c", UNKNOWN))
    assert (done.returncode, done.stdout, done.stderr) == (
        1,
        "2 statements: 1 certified, 0 refuted, 1 unknown, 0 rejected\n",
        "",
    )


def test_exit_1_where_a_certificate_is_rejected(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE, GOOD.replace('"x"]', '"x + 1"]'))
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


def test_without_a_folder_the_store_beside_the_checker_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "store").mkdir()
    check(tmp_path / "store", TRUE, GOOD)
    module = sys.modules[checker.main.__module__]
    monkeypatch.setattr(module, "__file__", str(tmp_path / "checker" / "settling.py"))
    with redirect_stdout(io.StringIO()) as out:
        assert checker.main([]) == 0
    assert out.getvalue() == "1 statements: 1 certified, 0 refuted, 0 unknown, 0 rejected\n"


def test_both_ways_of_running_are_the_same_files(tmp_path: Path) -> None:
    check(tmp_path, TRUE, GOOD)
    assert checker.check_folder(str(tmp_path)) == [("a/b", "certified", "")]
    assert Path(str(checker.__file__)).resolve().parent == CHECKER


def test_compiled_code_beside_the_text_is_not_run(tmp_path: Path) -> None:
    copy = tmp_path / "checker"
    shutil.copytree(CHECKER, copy, ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "all").mkdir()
    check(tmp_path / "all", TRUE, GOOD)
    forged = tmp_path / "forged.py"
    forged.write_text("print('forged')\n")
    source = copy / "rules.py"
    place = Path(cache_from_source(str(source)))
    place.parent.mkdir()
    py_compile.compile(
        str(forged), str(place), invalidation_mode=py_compile.PycInvalidationMode.UNCHECKED_HASH
    )
    done = run(tmp_path / "all", folder=copy)
    assert done.stdout == "1 statements: 1 certified, 0 refuted, 0 unknown, 0 rejected\n"
    # of __main__ alone, Python itself keeps and runs compiled code
    assert {path.name.split(".")[0] for path in place.parent.iterdir()} <= {"rules", "__main__"}


def test_a_module_beside_the_folder_is_not_run(tmp_path: Path) -> None:
    copy = tmp_path / "checker"
    shutil.copytree(CHECKER, copy)
    for name in ("json", "re", "fractions", "sys", "heapq"):
        (tmp_path / f"{name}.py").write_text("print('forged')\n")
    (tmp_path / "all").mkdir()
    check(tmp_path / "all", TRUE, GOOD)
    (tmp_path / "other" / "checker").mkdir(parents=True)
    (tmp_path / "other" / "checker" / "__init__.py").write_text("print('forged')\n")
    for flags in (["-I", "-S"], []):
        other = {"PYTHONPATH": str(tmp_path / "other")}
        done = run(tmp_path / "all", folder=copy, flags=flags, environment=other)
        assert done.stdout == "1 statements: 1 certified, 0 refuted, 0 unknown, 0 rejected\n"


def one_line(text: str) -> str:
    assert text.endswith("\n")
    assert text.count("\n") == 1
    assert text.rstrip("\n").isascii()
    assert text.rstrip("\n").isprintable()
    return text


DEEP = "[" * 100_000
NO_LINE = Kind.CERTIFICATE_LINE
LINES: dict[str, tuple[str, Expected]] = {
    "nothing": ("", NO_LINE),
    "half a line": (GOOD[:-5], NO_LINE),
    "two certificates": (GOOD[:-1] + GOOD[:-1], NO_LINE),
    "an object": (PROOF, NO_LINE),
    "a number": ("1", NO_LINE),
    "one entry": ('["a/b"]', NO_LINE),
    "three entries": (GOOD[:-2] + ", 1]", NO_LINE),
    "a name that is no text": (line("a/b", PROOF)[:-1].replace('"a/b"', "1", 1), NO_LINE),
    "deep nesting": (DEEP, NO_LINE),
    "deep nesting of objects": ('{"a":' * 100_000, NO_LINE),
    "a key twice": (
        GOOD[:-3] + ', "point": []}]',
        (Kind.KEY_TWICE, "['certified', 'point', 'point']"),
    ),
    "a key twice deep inside": (
        GOOD[:-1].replace('"x": "0"', '"x": "0", "x": "0"'),
        (Kind.KEY_TWICE, "['x', 'x']"),
    ),
    "a float": (GOOD[:-1].replace("[[1,", "[[1.0,", 1), (Kind.INEXACT, "1.0")),
    "an exponent": (GOOD[:-1].replace("[[1,", "[[1e0,", 1), (Kind.INEXACT, "1e0")),
    "NaN": (GOOD[:-1].replace("[[1,", "[[NaN,", 1), (Kind.INEXACT, "NaN")),
    "Infinity": (GOOD[:-1].replace("[[1,", "[[-Infinity,", 1), (Kind.INEXACT, "-Infinity")),
    "a number of 10000 digits": (GOOD[:-1].replace("[[1,", "[[1" + "0" * 10_000 + ",", 1), NO_LINE),
    "a comment": ("// " + GOOD[:-1], NO_LINE),
}


@pytest.mark.parametrize("defect", LINES)
def test_rejects_a_line_that_is_no_certificate(defect: str) -> None:
    text, expected = LINES[defect]
    certificates, ((count, reason),) = checker.read_certificates(text + "\n" + GOOD)
    assert (list(certificates), count) == (["a/b"], 1)
    assert refused(reason, expected), reason


def test_says_which_line_is_no_certificate(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE, "".join(f"{text}\n" for text, _ in LINES.values()))
    assert (done.returncode, done.stderr) == (1, "")
    first, *rows, last = done.stdout.splitlines(keepends=True)
    assert first == "rejected  a/b: no certificate\n"
    for count, (row, (_, expected)) in enumerate(zip(rows, LINES.values(), strict=True), 1):
        kind = expected[0] if isinstance(expected, tuple) else expected
        start = f"rejected  certificates.jsonl, line {count}: "
        assert one_line(row).startswith(f"{start}{kind.value}")  # type: ignore[union-attr]
    assert last.endswith(f" 0 certified, 0 refuted, 0 unknown, {len(LINES) + 1} rejected\n")


WHOLE: dict[str, tuple[str | bytes, str]] = {
    "a byte order mark": (b"\xef\xbb\xbf" + GOOD.encode(), Kind.CHARACTERS.value),
    "bytes that are no text": (b"\xff\xfe\x00", Kind.CHARACTERS.value),
    "a null character": (line("a/b", '"\0"'), Kind.CHARACTERS.value),
    "a carriage return": (GOOD.replace("\n", "\r\n"), Kind.CHARACTERS.value),
}


@pytest.mark.parametrize("defect", WHOLE)
def test_rejects_a_file_of_other_characters(tmp_path: Path, defect: str) -> None:
    content, reason = WHOLE[defect]
    done = check(tmp_path, TRUE, content)
    assert (done.returncode, done.stderr) == (1, "")
    first, second, last = done.stdout.splitlines(keepends=True)
    assert first == "rejected  a/b: no certificate\n"
    assert one_line(second).startswith(f"rejected  certificates.jsonl: {reason}")
    assert last == "2 statements: 0 certified, 0 refuted, 0 unknown, 2 rejected\n"


def closing(node: str) -> str:
    """A certificate, as text, whose node is closed by the text of a node."""
    return f'{{"certified": ["proof", [], {node}], "point": []}}'


def sign(term: str) -> str:
    return closing(f'["sign", "{term}", [], [], []]')


ENTRIES: dict[str, tuple[str, str]] = {
    "null": ("null", "a certificate with missing or left over keys: []"),
    "a text": ('"certified"', "a certificate with missing or left over keys: []"),
    "a list": ('["unknown"]', "a certificate with missing or left over keys: []"),
    "nothing": ("{}", "a certificate with missing or left over keys: []"),
    "a line break in a term": (sign("x\\n1 statements: 1 certified"), "unreadable text: "),
    "half a character": (sign("\\ud800"), "unreadable text: "),
    "an escape sequence": (sign("\\u001b[2J"), "unreadable text: "),
    "a line break in a rule": (closing('["no\\nrule"]'), "an unknown rule: "),
    "a deep term": (sign("(" * 90 + "x" + ")" * 90 + "+x" * 2000), ""),
    "a long sum": (sign("x" + "+x" * 100_000), ""),
    "many minuses": (sign("-" * 100_000 + "x"), ""),
    "deep nodes": (closing('["sign", "x", ' * 300 + "[]" + ", [], []]" * 300), ""),
}


def test_rejects_an_entry_that_is_no_certificate(tmp_path: Path) -> None:
    names = {f"e{k:02}/b": entry for k, entry in enumerate(ENTRIES.values())}
    done = check(
        tmp_path,
        "\n".join(TRUE.replace("a/b", name) for name in names),
        "".join(line(name, entry) for name, (entry, _) in names.items()),
    )
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
    left = ("a/c", "a/d\\n1 statements: 1 certified", "\\ud800")
    done = check(tmp_path, TRUE, GOOD + "".join(line(name, UNKNOWN) for name in left))
    assert (done.returncode, done.stderr) == (1, "")
    rows = done.stdout.splitlines()
    assert [
        row.startswith("rejected  ") and row.endswith(f": {Kind.LEFT_OVER.value}") for row in rows
    ] == [True] * 3 + [False]
    assert rows[-1] == "4 statements: 1 certified, 0 refuted, 0 unknown, 3 rejected"


def test_rejects_a_missing_certificate(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE)
    assert done.returncode == 1
    first, second, _ = done.stdout.splitlines()
    assert first == f"rejected  a/b: {Kind.NO_CERTIFICATE.value}"
    assert second.startswith(f"rejected  certificates.jsonl: {Kind.FILE.value}")
    done = check(tmp_path, TRUE, "")
    assert (done.returncode, done.stdout.splitlines()[0]) == (1, "rejected  a/b: no certificate")


def test_rejects_a_line_that_stands_twice() -> None:
    for second in (PROOF, UNKNOWN):
        certificates, ((count, reason),) = checker.read_certificates(GOOD + line("a/b", second))
        assert (count, certificates["a/b"]) == (2, json.loads(PROOF))
        assert refused(reason, (Kind.CERTIFICATE_TWICE, "a/b"))


def test_rejects_a_line_out_of_order() -> None:
    text = line("b/a", UNKNOWN) + line("a/b", UNKNOWN) + line("b/c", UNKNOWN)
    certificates, ((count, reason),) = checker.read_certificates(text)
    assert (count, list(certificates)) == (2, ["b/a", "b/c"])
    assert refused(reason, (Kind.CERTIFICATE_ORDER, "a/b"))


def test_rejects_a_last_line_that_is_cut() -> None:
    _, ((count, reason),) = checker.read_certificates(GOOD + GOOD[:-1])
    assert count == 2
    assert refused(reason, NO_LINE)


@pytest.mark.parametrize("row", [*TRUE.splitlines(), "# a title", "define d := 1", ""])
def test_rejects_a_line_that_is_set_in(row: str) -> None:
    """It would be a line of its own to one reader, and the end of the line above to another."""
    file = "define d := 1\n\n# a title\n" + TRUE
    assert list(checker.read_statements(file)) == ["a/b"]
    with pytest.raises(Rejected) as info:
        checker.read_statements(f"\n{file}".replace(f"\n{row}\n", f"\n {row}\n", 1))
    assert refused(info.value, (Kind.LINE_SHAPE, f" {row}"))


def test_rejects_an_empty_set_of_statements(tmp_path: Path) -> None:
    for nothing in ("", "\n\n", "# only a title\n"):
        done = check(tmp_path, nothing, "")
        assert (done.returncode, done.stdout) == (
            1,
            "0 statements: 0 certified, 0 refuted, 0 unknown, 0 rejected\n",
        )


STATEMENTS: dict[str, str | bytes] = {
    "a line of another script": "statement a/b\nforall x\n# \u2028given x > 0\nshow x > 0\n",
    "a mark that turns the text around": "statement a/b\nforall x\n# \u202egiven\nshow x > 0\n",
    "a form feed": "statement a/b\nforall x\n# \x0cgiven x > 0\nshow x > 0\n",
    "a blank that is none": "statement a/b\nforall x\u00a0y\nshow x > y\n",
    "a line end of another system": "statement a/b\nforall x\n# \rgiven x > 0\nshow x > 0\n",
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
    done = check(tmp_path, STATEMENTS[name], line("a/b", UNKNOWN))
    assert (done.returncode, done.stdout) == (2, "")
    assert one_line(done.stderr).startswith("checker: ")


def test_a_file_without_end_is_rejected(tmp_path: Path) -> None:
    (tmp_path / "certificates.jsonl").symlink_to("/dev/zero")
    (tmp_path / "statements.txt").write_text(TRUE)
    done = run(tmp_path)
    assert (done.returncode, done.stderr) == (1, "")
    assert "\nrejected  certificates.jsonl: a file cannot be read" in done.stdout


def test_a_pipe_is_rejected_and_not_waited_for(tmp_path: Path) -> None:
    (tmp_path / "certificates.jsonl").write_text("")
    os.mkfifo(tmp_path / "statements.txt")
    done = run(tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert one_line(done.stderr).startswith("checker: a file cannot be read")


@pytest.mark.parametrize(
    "name, most", [("statements.txt", 2 << 20), ("certificates.jsonl", 1 << 24)]
)
def test_a_file_that_is_too_large_is_rejected(tmp_path: Path, name: str, most: int) -> None:
    (tmp_path / "statements.txt").write_text(TRUE)
    (tmp_path / "certificates.jsonl").write_text(line("a/b", UNKNOWN))
    (tmp_path / name).write_text("\n" * most)
    assert "too large" not in (done := run(tmp_path)).stdout + done.stderr
    (tmp_path / name).write_text("\n" * (most + 1))
    assert "a file is too large" in (done := run(tmp_path)).stdout + done.stderr


def test_a_reason_is_one_printable_line() -> None:
    for text in ("x\ny", "x\ry", "x\u2028y", "\ud800", "\x1b[2J", "x" * 1000):
        with pytest.raises(checker.Rejected) as info:
            checker.rational(text)
        assert refused(info.value, (Kind.RATIONAL, text))
        assert str(info.value).isprintable() and len(str(info.value)) < 400


def test_rejects_a_lemma_that_is_not_certified(tmp_path: Path) -> None:
    lemma = "statement a/a\nforall x\nshow x > 0\n\n"
    use = PROOF.replace(
        '["psatz", [[1, [[0, 1]], "1"], [1, [], "x"], [1, [], "1"]], []]',
        '["use", "a/a", {"x": "x"}, {}, []]',
    )
    done = check(tmp_path, lemma + TRUE, line("a/a", UNKNOWN) + line("a/b", use))
    assert done.stdout.startswith(f"rejected  a/b: {Kind.LEMMA.value}: a/a\n")


def test_a_reason_is_cut_after_300_characters() -> None:
    shown = [str(checker.Rejected(Kind.RATIONAL, "x" * count, "here")) for count in (298, 299)]
    assert shown == [f"here: {Kind.RATIONAL.value}: " + "x" * 298] * 2
    assert str(checker.Rejected(Kind.RATIONAL)) == Kind.RATIONAL.value


def test_rejects_two_folders(tmp_path: Path) -> None:
    check(tmp_path, TRUE, GOOD)
    done = run(tmp_path, tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"checker: {Kind.FILE.value}: name one folder\n"


def test_after_1001_lines_refused_no_more_are_read() -> None:
    certificates, refused_lines = checker.read_certificates("[]\n" * 1001 + GOOD)
    assert (certificates, len(refused_lines)) == ({}, 1001)
    certificates, refused_lines = checker.read_certificates("[]\n" * 1000 + GOOD)
    assert (list(certificates), len(refused_lines)) == (["a/b"], 1000)


def test_a_name_cannot_fake_a_line(tmp_path: Path) -> None:
    done = check(tmp_path, TRUE, GOOD + line("x\\n1 statements: 1 certified", UNKNOWN))
    assert (done.returncode, done.stderr) == (1, "")
    assert len(done.stdout.splitlines()) == 2
    assert done.stdout.isascii()


def test_a_blank_line_ends_a_statement(tmp_path: Path) -> None:
    text = "statement a/b\nforall x\n\nshow x > 0\n"
    done = check(tmp_path, text, line("a/b", UNKNOWN))
    assert (done.returncode, done.stdout) == (2, "")
    assert "line 4: an unknown kind of line" in one_line(done.stderr)
