"""The store read in shares gives, to the letter, what the checker says of the whole."""

from __future__ import annotations

from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.store import CERTIFICATES, DEFAULT, Store, certificate_lines
from juggleproof.proofs.run import Reading, shares

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
    with Reading(folder, jobs) as reading:
        reading.outcomes()
    return reading.results


@pytest.fixture
def some(tmp_path: Path) -> Path:
    """A part of the committed store."""
    texts = [
        block
        for block in (DEFAULT / "statements.txt").read_text(encoding="utf-8").split("\n\n")
        if block.startswith("statement s2.2.1")
    ]
    (tmp_path / "some").mkdir()
    (tmp_path / "some" / "statements.txt").write_text("\n\n".join(texts) + "\n", encoding="utf-8")
    lines = (DEFAULT / CERTIFICATES).read_bytes().splitlines(keepends=True)
    own = [line for line in lines if line.startswith(b'["s2.2.1')]
    (tmp_path / "some" / CERTIFICATES).write_bytes(b"".join(own))
    return tmp_path / "some"


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
