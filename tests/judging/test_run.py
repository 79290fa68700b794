"""A run of claims by the library: what it writes does not depend on who does the work, and a store
that it changes is checked again.
"""

from __future__ import annotations

import json
import re
import shutil
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.judging.checked import StoreReading, shares
from juggleproof.judging.claims import Claim, claims_in
from juggleproof.judging.judgement import Judgement, Resources
from juggleproof.judging.run import (
    Options,
    by_id,
    claims_of_file,
    judge_some,
    judge_stored,
    run,
    sent,
    store_of,
)
from juggleproof.papers.paper import opened
from juggleproof.proofs.theorem import THEOREM
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import CERTIFICATES, Store, certificate_lines
from tests.command.running import run as command
from tests.judging.stores import part_of_store
from tests.rows import each_row

Json = Any

# Readings, misprints corrected in each way, a recurrence, a gap, what follows from a theorem.
CHOSEN = ("s2.2.1-B1", "eq-2", "eq-11", "s3.5.1-composite", "sA.3.2-sup3", "sB.1-so-that", "eq-26")


def claims() -> list[Claim]:
    """These, and the theorem."""
    wanted = {*CHOSEN, THEOREM.partition("/")[0]}
    return [one for one in opened().claims() if one.id in wanted]


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store of these claims alone, which is read sooner than the whole."""
    kept = {one.id for one in claims()}
    folder = part_of_store(tmp_path_factory.mktemp("small") / "store", kept.__contains__)
    run(claims(), Options(folder, jobs=1))
    return folder


@pytest.fixture
def options(tmp_path: Path, small: Path) -> Options:
    """A copy of it."""
    shutil.copytree(small, tmp_path / "store")
    return Options(tmp_path / "store", jobs=1, only=CHOSEN)


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_run_does_not_depend_on_who_works_and_keeps_the_store_holds(options: Options) -> None:
    before, heard = content(options.store), list[str]()

    def hear(claim: Claim, judgement: Judgement) -> None:
        assert claim.id == judgement.id
        heard.append(claim.id)

    alone = run(claims(), options, hear)
    assert [one.id for one in alone.judgements] == heard and set(heard) == set(CHOSEN)
    assert alone.rejected == [] and alone.outcomes["eq-2/main"] == "refuted"
    assert content(options.store) == before
    assert run(claims(), replace(options, jobs=2)).judgements == alone.judgements
    with ThreadPoolExecutor(1) as pool:
        assert run(claims(), options, executor=pool).judgements == alone.judgements
    assert content(options.store) == before


def test_a_store_that_a_run_changes_is_checked_again_holds(
    options: Options, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen, check = list[int](), checker.check_folder

    def counted(where: str, each: Any = checker.check_one) -> Any:
        results = check(where, each)
        seen.append(sum(outcome == "rejected" for _, outcome, _ in results))
        return results

    monkeypatch.setattr(checker, "check_folder", counted)
    options = replace(options, routes=("exact",), only=("s2.2.1-B1",))
    run(claims(), options)
    assert seen == [0]
    path = options.store / CERTIFICATES
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(one for one in lines if not one.startswith(b'["s2.2.1-B1/')))
    assert run(claims(), options).rejected == []
    assert seen[1] > 0 and seen[2:] == [0]


@each_row("routes", [(), ("z3",), ("exact", "magic")])
def test_rejects_routes_without_the_exact_one_or_unknown(routes: tuple[str, ...]) -> None:
    with pytest.raises(ClaimError, match="choose from exact, z3, boxes"):
        Options(Path("store"), routes)


def test_rejects_a_claim_that_is_not_there(options: Options) -> None:
    with pytest.raises(ClaimError, match="--only 38000: no such claim"):
        run(claims(), replace(options, only=("38000",)))


def test_a_claim_is_named_by_the_papers_number_holds(options: Options) -> None:
    done = run(claims(), replace(options, routes=("exact",), only=("(2)", "eq 11")))
    assert [one.id for one in done.claims] == ["eq-2", "eq-11"]


CLOSE = ["close"]
TRUE = "forall x\nshow x^2 >= 0"
ABSURD = "forall a\nshow a < 0"  # false; with it, everything follows
FOLLOWS = "forall x\nshow x < 0"
USES = {
    "certified": ["use", "a/one", {"a": "x"}, {}, ["close"]],
    "point": ["b/two", [], {"x": "0"}, ["close"]],
}


def folder_of(place: Path, statements: dict[str, str], certificates: dict[str, object]) -> Path:
    place.mkdir()
    (place / "statements.txt").write_text(
        "\n\n".join(f"statement {name}\n{text}" for name, text in statements.items()) + "\n",
        encoding="utf-8",
    )
    (place / CERTIFICATES).write_bytes(certificate_lines(certificates))
    return place


def read_by(folder: Path, jobs: int) -> list[tuple[str, str, str]]:
    with StoreReading(folder, jobs) as reading:
        reading.outcomes()
    return reading.results


@pytest.fixture
def some(tmp_path: Path) -> Path:
    """A part of the committed store."""
    return part_of_store(tmp_path / "some", lambda claim: claim.startswith("s2.2.1"))


def test_shares_and_the_whole_agree_holds(some: Path) -> None:
    whole = checker.check_folder(str(some))
    assert len(whole) > 20 and {outcome for _, outcome, _ in whole} == {"certified", "refuted"}
    for jobs in (1, 2, 3):
        assert read_by(some, jobs) == whole


def test_every_claim_is_in_one_share_holds(some: Path) -> None:
    found = shares(some, 3)
    assert sorted(claim for share in found for claim in share) == sorted(
        {name.split("/")[0] for name in Store(some).texts}
    )


def test_rejects_a_lemma_that_another_share_only_assumes(tmp_path: Path) -> None:
    false = {"certified": CLOSE, "point": ["a/one", [], {"a": "-1"}, CLOSE]}
    folder = folder_of(
        tmp_path / "store", {"a/one": ABSURD, "b/two": FOLLOWS}, {"a/one": false, "b/two": USES}
    )
    assert all(len(share) == 1 for share in shares(folder, 2))
    outcomes = {name: outcome for name, outcome, _ in read_by(folder, 2)}
    assert outcomes == {"a/one": "rejected", "b/two": "rejected"}
    assert read_by(folder, 2) == checker.check_folder(str(folder))


def test_rejects_what_is_spoilt_as_the_whole_does(some: Path) -> None:
    lines = (some / CERTIFICATES).read_bytes().splitlines(keepends=True)
    lines[0] = b"{\n"
    lines[3] = lines[4]
    lines[6], lines[7] = lines[7], lines[6]
    left_over = certificate_lines({"s2.2.1/left-over": {"unknown": ""}})
    (some / CERTIFICATES).write_bytes(b"".join([*lines[:1], *lines[2:], left_over]) + b"[")
    whole = checker.check_folder(str(some))
    assert sum(outcome == "rejected" for _, outcome, _ in whole) > 4
    for jobs in (1, 2, 3):
        assert read_by(some, jobs) == whole


def test_a_folder_without_statements_comes_to_nothing_holds(tmp_path: Path) -> None:
    assert read_by(tmp_path, 2) == []
    (tmp_path / "statements.txt").write_text("statement\n", encoding="utf-8")
    assert read_by(tmp_path, 1) == read_by(tmp_path, 2) == []


@pytest.mark.parametrize("path", ["mine.py", "./mine.py", "{0}/mine.py"])
def test_rejects_a_claim_without_a_sentence_by_its_line(
    path: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    source = "from juggleproof import claim\n\n\n@claim('bare')\ndef bare():\n    return ()\n"
    Path("mine.py").write_text(source, encoding="utf-8")
    with pytest.raises(ClaimError, match=r"mine\.py:4: bare has no docstring"):
        claims_of_file(Path(path.format(tmp_path)))


USED = """
from juggleproof import always, claim, reals
x, a = reals("x a")
@claim("lemma")
def lemma():
    "Of squares."
    return always({})
@claim("user", hints={{"uses": ("lemma/main",)}})
def user():
    "By the lemma."
    return always({})
"""


def by_lemma(folder: Path, lemma: str, user: str) -> tuple[Path, Path]:
    """A file of a claim and of another that uses it, and their store, where the second stands by
    the first.
    """
    path = folder / "own.py"
    path.write_text(USED.format(lemma, user), encoding="utf-8")
    run(claims_of_file(path), Options(store_of([path]), ("exact",), jobs=1))
    lines = store_of([path]) / CERTIFICATES
    data = dict(json.loads(line) for line in lines.read_text(encoding="utf-8").splitlines())
    closed: list[Json] = [["1", [[0, 1]], "1"], ["1", [[1, 1]], "1"]]
    used = ["use", "lemma/main", {"x": "a"}, {}, ["psatz", closed, []]]
    point = ["user/main", [], {"a": "0"}, ["close"]]
    data["user/main"] = {"certified": ["proof", [], used], "point": point}
    lines.write_bytes(certificate_lines(data))
    return path, store_of([path])


def test_rejects_a_proof_by_a_lemma_that_is_refuted(tmp_path: Path) -> None:
    path, store = by_lemma(tmp_path, "x**2 < 0", "a**2 < 0")
    claims = claims_of_file(path)
    assert [one.verdict.word for one in judge_some(claims, by_id(claims), store)] == [
        "false",
        "false",
    ]
    assert [one.verdict.word for one in judge_some(claims[1:], by_id(claims), store)] == ["false"]
    stored = judge_stored(claims, Options(store, ("exact",), jobs=1))
    assert [one.verdict.word for one in stored.judgements] == ["false", "false"]
    done = run(claims, Options(store, ("exact",), jobs=1))
    assert [one.verdict.word for one in done.judgements] == ["false", "unknown"]
    assert done.judgements[1].outcomes == {"user/main": "rejected"}
    shown = command("certify", str(path), "--routes", "exact")
    assert shown.returncode == 1 and "1 refuted, 1 rejected" in shown.stdout
    assert re.search(r"^user .* unknown  1 rejected ", shown.stdout, re.MULTILINE)


def test_rejects_what_the_votes_contradict_in_one_line(tmp_path: Path) -> None:
    path, _ = by_lemma(tmp_path, "x**2 < 0", "a**2 < 0")
    done = command("certify", str(path))
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "the checked certificate says certified, but z3 says fails" in done.stderr


def test_a_proof_by_a_lemma_that_is_certified_holds(tmp_path: Path) -> None:
    path, store = by_lemma(tmp_path, "x**2 >= 0", "a**2 >= 0")
    claims = claims_of_file(path)
    (judged,) = judge_some(claims[1:], by_id(claims), store)
    assert judged.verdict.word == "holds" and "use" in str(judged.certificates["user/main"])


def test_rejects_a_claim_under_a_module_and_name_of_the_papers(tmp_path: Path) -> None:
    path, module = tmp_path / "own.py", "juggleproof.proofs.paper.s3_1_s3_2_coupling"
    for name in ("read.__module__", "__name__"):
        path.write_text(
            "from juggleproof import always, claim, real\nx = real('x')\n"
            "def read():\n    'A square.'\n    return always(x**2 < 0)\n"
            f"{name} = {module!r}\nread.__module__ = {module!r}\nclaim('eq-6')(read)\n",
            encoding="utf-8",
        )
        (own,) = claims_of_file(path)
        assert not own.is_of_package and isinstance(sent(own, Resources()).claim, Claim)
        assert all(one is not own for one in claims_in([module]))
    papers = next(one for one in opened().claims() if one.id == "eq-6")
    assert sent(papers, Resources()).claim == (module, "eq-6")
    with pytest.raises(ClaimError, match="a print to be corrected"):
        sent(replace(papers, says="something else"), Resources())


def test_a_remark_goes_with_its_claim_to_another_process_holds(tmp_path: Path) -> None:
    path = tmp_path / "own.py"
    path.write_text(
        "from juggleproof import Remark, always, claim, real\n"
        'x = real("x")\n'
        'zero = Remark("It is 0 at 0.", lambda: always(x**2 >= 0, label="zero"))\n'
        '@claim("square", remark=zero)\n'
        "def squares_are_not_negative():\n"
        '    """A square is not negative."""\n'
        "    return always(x**2 + 1 > 0)\n",
        encoding="utf-8",
    )
    options = Options(tmp_path / "store", ("exact",), jobs=1)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        done = run(claims_of_file(path), options, executor=pool)
    assert [one.verdict.word for one in done.judgements] == ["holds"]
    assert done.outcomes["square/remark.zero"] == "certified"
