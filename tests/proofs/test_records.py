"""A run that knows claims again by their records prints and writes what a run from the sources
does; a record that lies is not believed.
"""

from __future__ import annotations

import copy
import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.proofs import kept as cache
from juggleproof.proofs import run as loading
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.command import certify as command
from juggleproof.proofs.command import show
from juggleproof.proofs.command.main import run
from juggleproof.proofs.derivations import body_and_derivations
from juggleproof.proofs.judging import DEFAULT_BUDGET
from juggleproof.proofs.kept import claim_of

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
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
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
    place: Path,
    output: Callable[..., dict[str, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(cache.VARIABLE, "off")
    plain = output("--jobs", "1")
    assert "misprint" in plain["printed"] and plain["complaints"] == ""
    assert output("--jobs", "2") == plain
    monkeypatch.setenv(cache.VARIABLE, str(place))
    assert output("--jobs", "2") == plain and len(records_of(place)) == len(PAPER)
    with monkeypatch.context() as patch:
        nothing_is_stated(patch)
        assert output("--jobs", "1") == plain
        assert output("--jobs", "2") == plain
        one = output("--jobs", "1", "--only", "eq-2")
    monkeypatch.setenv(cache.VARIABLE, "off")
    assert output("--jobs", "1", "--only", "eq-2") == one


def test_claims_are_told_from_records_as_from_sources_holds(
    place: Path,
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
    monkeypatch.setenv(cache.VARIABLE, str(place))
    output("--jobs", "2")
    nothing_is_stated(monkeypatch)
    assert told() == plain


def test_fresh_search_keeps_and_reads_no_records_holds(
    place: Path,
    output: Callable[..., dict[str, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(*_: object) -> Any:
        raise AssertionError("records were asked for")

    for name in ("load", "keep", "key"):
        monkeypatch.setattr(cache, name, refuse)
    done = output("--fresh", "--only", "s2.2.1-B1", "--routes", "exact", "--jobs", "1")
    assert "1 claim:" in done["printed"] and not place.exists()


def test_derivations_of_a_claim_do_not_depend_on_what_was_stated_before_holds() -> None:
    first = {claim.id: body_and_derivations(claim)[1] for claim in PAPER}
    assert any(first.values())
    assert first == {claim.id: body_and_derivations(claim)[1] for claim in reversed(PAPER)}


def records_of(place: Path) -> list[dict[str, Any]]:
    (path,) = place.glob("[0-9a-f]" * 64 + ".json")
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
    place: Path, output: Callable[..., dict[str, str]]
) -> None:
    plain = output("--jobs", "1")
    key = loading.Records(DEFAULT_BUDGET).key
    kept = records_of(place)
    for defect, records in lies(kept):
        cache.keep(key, records)
        assert cache.load(key) == records != kept, defect
        assert output("--jobs", "1") == plain, defect
        assert records_of(place) == kept, defect


def test_rejects_the_body_of_a_claim_from_its_record_alone() -> None:
    record = dict.fromkeys(
        ("id", "section", "place", "says", "printed", "as_it_stands", "repeats", "source"), ""
    )
    claim = claim_of({**record, "parameters": ["alpha"], "nearby": True})
    with pytest.raises(loading.Forgotten):
        claim.body()
    assert claim.true_nearby is not None
    with pytest.raises(loading.Forgotten):
        claim.true_nearby[1]()


def test_a_store_that_a_run_changes_is_checked_again_holds(
    store: Path,
    place: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    folder, seen, check = tmp_path / "spoilt", list[int](), checker.check_folder
    shutil.copytree(store, folder)

    def counted(where: str) -> Any:
        results = check(where)
        seen.append(sum(outcome == "rejected" for _, outcome, _ in results))
        return results

    monkeypatch.setattr(checker, "check_folder", counted)
    arguments = ["certify", "--store", str(folder), "--jobs", "1", "--routes", "exact"]
    run(arguments)
    assert seen == [0]
    (folder / "s2.2.1-B1.json").write_text("{}\n", encoding="utf-8")
    run(arguments)
    assert seen[1] > 0 and seen[2:] == [0]
    assert "rejected by the checker" not in capfd.readouterr().out
