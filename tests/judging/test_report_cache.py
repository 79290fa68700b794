"""The file of kept figures: its key tells every source apart, and what is not whole, or cannot be
written, is let be.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from juggleproof.judging import limits, report_cache
from juggleproof.statements.store import canonical

KEY = "0" * 64
PAPER = "a-paper"  # its folder may be any
FOLDERS = (*report_cache.SOURCES, PAPER)
RECORDS = [{"id": "a", "says": "It says so."}, {"id": "b"}]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(report_cache.VARIABLE, str(tmp_path / "kept"))
    return tmp_path / "kept"


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for package in FOLDERS:
        (tmp_path / "tree" / package / "inner").mkdir(parents=True)
        (tmp_path / "tree" / package / "inner" / "one.py").write_text("x = 1\n", encoding="utf-8")
    monkeypatch.setattr(report_cache, "ROOT", tmp_path / "tree")
    monkeypatch.setattr(report_cache, "FOLDER", tmp_path / "tree" / PAPER)
    return tmp_path / "tree"


@pytest.mark.parametrize("package", FOLDERS)
def test_a_changed_source_changes_the_key_holds(package: str, tree: Path) -> None:
    path = tree / package / "inner" / "one.py"
    seen = [report_cache.key()]
    assert report_cache.key() == seen[0]
    path.write_text("x = 2\n", encoding="utf-8")
    seen.append(report_cache.key())
    path.rename(path.with_name("two.py"))
    seen.append(report_cache.key())
    path.write_text("", encoding="utf-8")
    seen.append(report_cache.key())
    assert len(set(seen)) == len(seen)


def test_settings_and_versions_change_the_key_holds(
    tree: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = {report_cache.key(1), report_cache.key(2)}
    monkeypatch.setattr(
        report_cache, "version_of", lambda tool: "another" if tool == "sympy" else "the same"
    )
    seen.add(report_cache.key(1))
    monkeypatch.setattr(report_cache.sys, "version", "another")
    seen.add(report_cache.key(1))
    assert len(seen) == 4


def test_the_key_reads_the_prints_and_the_checker_holds() -> None:
    read = {name for name, _ in report_cache.sources()}
    assert {
        "certificates/checker/rules.py",
        "proofs/paper/a3_a4_supremum.py",
        "juggleproof/reading/parser.py",
        "symbolic/bounds.py",
    } <= read


def test_records_come_back_holds(place: Path) -> None:
    assert report_cache.load(KEY) == []
    report_cache.keep(KEY, RECORDS)
    assert report_cache.load(KEY) == RECORDS
    assert report_cache.load("1" * 64) == []
    assert [path.name for path in place.iterdir()] == [f"{KEY}.json"]


def test_rejects_truncated_and_changed_files(place: Path) -> None:
    report_cache.keep(KEY, RECORDS)
    path = place / f"{KEY}.json"
    whole = path.read_bytes()
    for end in range(len(whole)):
        path.write_bytes(whole[:end])
        assert report_cache.load(KEY) == []
        path.write_bytes(whole[:end] + bytes([whole[end] ^ 1]) + whole[end + 1 :])
        assert report_cache.load(KEY) == []
    path.write_bytes(whole)
    assert report_cache.load(KEY) == RECORDS


def test_rejects_a_file_of_another_key(place: Path) -> None:
    report_cache.keep(KEY, RECORDS)
    (place / f"{KEY}.json").rename(place / f"{'1' * 64}.json")
    assert report_cache.load("1" * 64) == []


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"[]",
        b"{}",
        b'{"records": 1}',
        b'{"records": [1]}',
        b'{"records": [[]]}',
        b"\xff",
        b"[" * 100_000,
    ],
)
def test_rejects_what_is_no_list_of_records(content: bytes, place: Path) -> None:
    place.mkdir()
    digest = hashlib.sha256(KEY.encode() + content).hexdigest().encode()
    (place / f"{KEY}.json").write_bytes(digest + b"\n" + content)
    assert report_cache.load(KEY) == []


def test_rejects_a_file_that_others_may_write(place: Path) -> None:
    report_cache.keep(KEY, RECORDS)
    (place / f"{KEY}.json").chmod(0o666)
    assert report_cache.load(KEY) == []


def test_a_folder_that_cannot_be_written_is_no_error_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    for place in (tmp_path / "file", tmp_path / "file" / "below"):
        monkeypatch.setenv(report_cache.VARIABLE, str(place))
        report_cache.keep(KEY, RECORDS)
        assert report_cache.load(KEY) == []
    assert (tmp_path / "file").read_bytes() == b""


def test_off_and_no_home_keep_nothing_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv(report_cache.VARIABLE, "off")
    report_cache.keep(KEY, RECORDS)
    assert (
        report_cache.folder() is None
        and report_cache.load(KEY) == []
        and not list(tmp_path.iterdir())
    )
    monkeypatch.delenv(report_cache.VARIABLE)
    report_cache.keep(KEY, RECORDS)
    assert report_cache.load(KEY) == RECORDS and [path.name for path in tmp_path.iterdir()] == [
        "juggleproof"
    ]
    monkeypatch.delenv("XDG_CACHE_HOME")

    def homeless() -> Path:
        raise RuntimeError("no home")

    monkeypatch.setattr(report_cache.Path, "home", homeless)
    assert report_cache.folder() is None


def test_only_the_latest_files_are_kept_holds(place: Path) -> None:
    for number in range(limits.KEPT_FILES + 3):
        report_cache.keep(f"{number:064x}", RECORDS)
    assert len(list(place.iterdir())) == limits.KEPT_FILES
    (place / "notes.txt").write_text(canonical({}).decode(), encoding="utf-8")
    report_cache.keep(KEY, RECORDS)
    assert (place / "notes.txt").exists()
