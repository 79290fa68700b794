"""Records of claims: the file that keeps them, and runs that know claims again by them."""

from __future__ import annotations

import copy
import hashlib
import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.store import canonical
from juggleproof.proofs import kept
from juggleproof.proofs import kept as cache
from juggleproof.proofs import run as loading
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.command import certify as command
from juggleproof.proofs.command import show
from juggleproof.proofs.command.main import run
from juggleproof.proofs.derivations import body_and_derivations
from juggleproof.proofs.judging import DEFAULT_BUDGET
from juggleproof.proofs.kept import claim_of

# -------------------------------------------------------------------------------------------------
# The file of records: its key tells every source apart, and what is not whole, or cannot be
# written, is let be.

KEY = "0" * 64
RECORDS = [{"id": "a", "says": "It says so."}, {"id": "b"}]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(kept.VARIABLE, str(tmp_path / "kept"))
    return tmp_path / "kept"


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    for package in kept.SOURCES:
        (tmp_path / "tree" / package / "inner").mkdir(parents=True)
        (tmp_path / "tree" / package / "inner" / "one.py").write_text("x = 1\n", encoding="utf-8")
    return tmp_path / "tree"


@pytest.mark.parametrize("package", kept.SOURCES)
def test_a_changed_source_changes_the_key_holds(package: str, tree: Path) -> None:
    path = tree / package / "inner" / "one.py"
    seen = [kept.key(root=tree)]
    assert kept.key(root=tree) == seen[0]
    path.write_text("x = 2\n", encoding="utf-8")
    seen.append(kept.key(root=tree))
    path.rename(path.with_name("two.py"))
    seen.append(kept.key(root=tree))
    path.write_text("", encoding="utf-8")
    seen.append(kept.key(root=tree))
    assert len(set(seen)) == len(seen)


def test_settings_and_versions_change_the_key_holds(
    tree: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = {kept.key(1, root=tree), kept.key(2, root=tree)}
    monkeypatch.setattr(
        kept, "version_of", lambda tool: "another" if tool == "sympy" else "the same"
    )
    seen.add(kept.key(1, root=tree))
    monkeypatch.setattr(kept.sys, "version", "another")
    seen.add(kept.key(1, root=tree))
    assert len(seen) == 4


def test_the_key_reads_the_prints_and_the_checker_holds() -> None:
    read = {path.relative_to(kept.ROOT).as_posix() for path in kept._sources(kept.ROOT)}
    assert {
        "certificates/checker/rules.py",
        "proofs/paper/a3_a4_supremum.py",
        "proofs/reading/parser.py",
        "symbolic/bounds.py",
    } <= read


def test_records_come_back_holds(place: Path) -> None:
    assert kept.load(KEY) == []
    kept.keep(KEY, RECORDS)
    assert kept.load(KEY) == RECORDS
    assert kept.load("1" * 64) == []
    assert [path.name for path in place.iterdir()] == [f"{KEY}.json"]


def test_rejects_truncated_and_changed_files(place: Path) -> None:
    kept.keep(KEY, RECORDS)
    path = place / f"{KEY}.json"
    whole = path.read_bytes()
    for end in range(len(whole)):
        path.write_bytes(whole[:end])
        assert kept.load(KEY) == []
        path.write_bytes(whole[:end] + bytes([whole[end] ^ 1]) + whole[end + 1 :])
        assert kept.load(KEY) == []
    path.write_bytes(whole)
    assert kept.load(KEY) == RECORDS


def test_rejects_a_file_of_another_key(place: Path) -> None:
    kept.keep(KEY, RECORDS)
    (place / f"{KEY}.json").rename(place / f"{'1' * 64}.json")
    assert kept.load("1" * 64) == []


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
    assert kept.load(KEY) == []


def test_rejects_a_file_that_others_may_write(place: Path) -> None:
    kept.keep(KEY, RECORDS)
    (place / f"{KEY}.json").chmod(0o666)
    assert kept.load(KEY) == []


def test_a_folder_that_cannot_be_written_is_no_error_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    for place in (tmp_path / "file", tmp_path / "file" / "below"):
        monkeypatch.setenv(kept.VARIABLE, str(place))
        kept.keep(KEY, RECORDS)
        assert kept.load(KEY) == []
    assert (tmp_path / "file").read_bytes() == b""


def test_off_and_no_home_keep_nothing_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv(kept.VARIABLE, "off")
    kept.keep(KEY, RECORDS)
    assert kept.folder() is None and kept.load(KEY) == [] and not list(tmp_path.iterdir())
    monkeypatch.delenv(kept.VARIABLE)
    kept.keep(KEY, RECORDS)
    assert kept.load(KEY) == RECORDS and [path.name for path in tmp_path.iterdir()] == [
        "juggleproof"
    ]
    monkeypatch.delenv("XDG_CACHE_HOME")

    def homeless() -> Path:
        raise RuntimeError("no home")

    monkeypatch.setattr(kept.Path, "home", homeless)
    assert kept.folder() is None


def test_only_the_latest_files_are_kept_holds(place: Path) -> None:
    for number in range(kept.KEPT + 3):
        kept.keep(f"{number:064x}", RECORDS)
    assert len(list(place.iterdir())) == kept.KEPT
    (place / "notes.txt").write_text(canonical({}).decode(), encoding="utf-8")
    kept.keep(KEY, RECORDS)
    assert (place / "notes.txt").exists()


# -------------------------------------------------------------------------------------------------
# A run that knows claims again by their records prints and writes what a run from the sources does;
# a record that lies is not believed.

# Readings, misprints corrected in each way, a recurrence, a gap, what follows from a theorem and
# one, one that nothing corrects, sharp ranges.
CHOSEN = (
    "s2.2.1-H",
    "s2.2.1-B1",
    "eq-2",
    "eq-11",
    "s3.5.1-composite",
    "s3.5.3-jacobian",
    "sA.3.2-sup3",
    "sB.7-C",
    "sB.1-so-that",
    "s4.2-invariant",
    "eq-26",
    "theorem-roots",
    "theorem",
)
PAPER = [claim for claim in loading.paper_claims() if claim.id in CHOSEN]


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the committed store holds of the chosen claims, as a run without records writes it."""
    folder = tmp_path_factory.mktemp("records") / "store"
    shutil.copytree(command.DEFAULT, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(cache.VARIABLE, "off")
        few(patch)
        run(["certify", "--store", str(folder), "--jobs", "1"])
    return folder


@pytest.fixture
def place_of_few(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    few(monkeypatch)
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "kept"))
    yield tmp_path / "kept"


def few(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(command, "paper_claims", lambda: PAPER)
    patch.setattr(loading, "paper_claims", lambda: PAPER)
    patch.setattr(show, "paper_claims", lambda: PAPER)


@pytest.fixture
def output(
    store: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> Callable[..., dict[str, str]]:
    """Everything that a run prints and writes."""

    def certified(*more: str) -> dict[str, str]:
        folder, told = tmp_path / "store", tmp_path / "verdicts.json"
        shutil.copytree(store, folder, dirs_exist_ok=True)
        capfd.readouterr()
        code = run(["certify", "--store", str(folder), "--json", str(told), *more])
        said = capfd.readouterr()
        written = {
            path.name: path.read_text(encoding="utf-8") for path in [*folder.iterdir(), told]
        }
        return {"code": str(code), "printed": said.out, "complaints": said.err, **written}

    return certified


def nothing_is_stated(patch: pytest.MonkeyPatch) -> None:
    def refuse() -> list[Claim]:
        raise AssertionError("the claims were loaded from their sources")

    patch.setattr(loading, "paper_claims", refuse)
    patch.setattr(command, "paper_claims", refuse)
    patch.setattr(show, "paper_claims", refuse)


def test_outputs_do_not_depend_on_records_or_jobs_holds(
    place_of_few: Path,
    output: Callable[..., dict[str, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(cache.VARIABLE, "off")
    plain = output("--jobs", "1")
    assert "misprint" in plain["printed"] and plain["complaints"] == ""
    assert output("--jobs", "2") == plain
    monkeypatch.setenv(cache.VARIABLE, str(place_of_few))
    assert output("--jobs", "2") == plain and len(records_of(place_of_few)) == len(PAPER)
    with monkeypatch.context() as patch:
        nothing_is_stated(patch)
        assert output("--jobs", "1") == plain
        assert output("--jobs", "2") == plain
        one = output("--jobs", "1", "--only", "eq-2")
    monkeypatch.setenv(cache.VARIABLE, "off")
    assert output("--jobs", "1", "--only", "eq-2") == one


def test_claims_are_told_from_records_as_from_sources_holds(
    place_of_few: Path,
    output: Callable[..., dict[str, str]],
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    def told() -> str:
        capfd.readouterr()
        assert [run([word]) for word in ("list", "errata")] == [0, 0]
        assert {run(["explain", claim]) for claim in CHOSEN} == {0}
        return capfd.readouterr().out

    monkeypatch.setenv(cache.VARIABLE, "off")
    plain = told()
    assert "derived     symbolic." in plain and "can be read as" in plain
    monkeypatch.setenv(cache.VARIABLE, str(place_of_few))
    output("--jobs", "2")
    nothing_is_stated(monkeypatch)
    assert told() == plain


def test_fresh_search_keeps_and_reads_no_records_holds(
    place_of_few: Path,
    output: Callable[..., dict[str, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(*_: object) -> Any:
        raise AssertionError("records were asked for")

    for name in ("load", "keep", "key"):
        monkeypatch.setattr(cache, name, refuse)
    done = output("--fresh", "--only", "s2.2.1-B1", "--routes", "exact", "--jobs", "1")
    assert "1 claim:" in done["printed"] and not place_of_few.exists()


def test_derivations_of_a_claim_do_not_depend_on_what_was_stated_before_holds() -> None:
    first = {claim.id: body_and_derivations(claim)[1] for claim in PAPER}
    assert any(first.values())
    assert first == {claim.id: body_and_derivations(claim)[1] for claim in reversed(PAPER)}


def records_of(place_of_few: Path) -> list[dict[str, Any]]:
    (path,) = place_of_few.glob("[0-9a-f]" * 64 + ".json")
    return list(json.loads(path.read_text(encoding="utf-8").split("\n", 1)[1])["records"])


def lies(records: list[dict[str, Any]]) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """Records that are whole and say something else."""

    def told(change: Callable[[list[dict[str, Any]]], object]) -> list[dict[str, Any]]:
        other = copy.deepcopy(records)
        change(other)
        return other

    at = {record["id"]: index for index, record in enumerate(records)}
    plain, misprint, jacobian = at["s3.5.1-composite"], at["eq-2"], at["s3.5.3-jacobian"]
    yield "a statement is left out", told(lambda r: r[plain]["body"]["Assertion"].pop())
    yield (
        "a statement is another",
        told(lambda r: r[plain]["body"]["Assertion"][0].__setitem__(2, "0" * 64)),
    )
    yield (
        "a statement is another claim's",
        told(lambda r: r[plain].__setitem__("body", r[jacobian]["body"])),
    )
    yield "no statement is left", told(lambda r: r[plain].__setitem__("body", {"Assertion": []}))
    yield "a body of no kind", told(lambda r: r[plain].__setitem__("body", {"Proved": []}))
    yield "a body too deep", told(lambda r: r[plain].__setitem__("body", deep()))
    yield "a body that is a word", told(lambda r: r[plain].__setitem__("body", "holds"))
    yield "a correction is left out", told(lambda r: r[misprint].__setitem__("correction", None))
    yield (
        "a correction is another",
        told(lambda r: r[misprint]["correction"].__setitem__("text", "0 = 0")),
    )
    yield "a correction's statement is left out", told(lambda r: r[misprint]["corrected"].pop())
    yield "a field is missing", told(lambda r: r[plain].pop("says"))
    yield "a field is no text", told(lambda r: r[plain].__setitem__("place", 3))
    yield "nothing", [{} for _ in records]


def deep() -> Any:
    value: Any = None
    for _ in range(400):
        value = {"tuple": [value]}
    return value


def test_rejects_records_that_say_something_else(
    place_of_few: Path, output: Callable[..., dict[str, str]]
) -> None:
    plain = output("--jobs", "1")
    key = loading.Records(DEFAULT_BUDGET).key
    kept = records_of(place_of_few)
    for defect, records in lies(kept):
        cache.keep(key, records)
        assert cache.load(key) == records != kept, defect
        assert output("--jobs", "1") == plain, defect
        assert records_of(place_of_few) == kept, defect


def test_rejects_the_body_of_a_claim_from_its_record_alone() -> None:
    record = dict.fromkeys(
        ("id", "section", "place", "says", "printed", "as_it_stands", "repeats", "source"), ""
    )
    claim = claim_of({**record, "parameters": ["alpha"], "domains": [], "nearby": True})
    with pytest.raises(loading.Forgotten):
        claim.body()
    assert claim.nearby is not None
    with pytest.raises(loading.Forgotten):
        claim.nearby[1]()


def test_a_store_that_a_run_changes_is_checked_again_holds(
    store: Path,
    place_of_few: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    folder, seen, check = tmp_path / "spoilt", list[int](), checker.check_folder
    shutil.copytree(store, folder)

    def counted(where: str, *more: Any) -> Any:
        results = check(where, *more)
        seen.append(sum(outcome == "rejected" for _, outcome, _ in results))
        return results

    monkeypatch.setattr(checker, "check_folder", counted)
    arguments = ["certify", "--store", str(folder), "--jobs", "1", "--routes", "exact"]
    run(arguments)
    assert seen == [0]
    stored = folder / "certificates.jsonl"
    lines = stored.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith('["s2.2.1-B1/')]
    assert 0 < len(kept) < len(lines)
    stored.write_text("".join(kept), encoding="utf-8")
    run(arguments)
    assert seen[1] > 0 and seen[2:] == [0]
    assert "rejected by the checker" not in capfd.readouterr().out
