"""Votes on record: quoted where the very same was asked, cast in every other case; in what a run
prints and writes there is no difference.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from juggleproof.judging import judge, judgement
from juggleproof.judging.run import Options, Run, findings_in, run
from juggleproof.judging.searches import claim_search
from juggleproof.papers.paper import opened
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT
from juggleproof.statements.vote import VoteBudget
from tests.command.running import run as command

CHOSEN = ("eq-37", "s2.2.1-B1")
CLAIMS = [claim for claim in opened().claims() if claim.id in CHOSEN]
OWN = '''
from juggleproof import always, claim, reals

x, y = reals("x y")


@claim("mine")
def mine():
    """The product is small on the disc."""
    return always(x * y < {most}, given=[x**2 + y**2 <= 1])
'''


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the statements that votes are cast on, as they are cast."""
    names, cast = list[str](), claim_search.cast_votes

    def counted(statement: Any, *rest: Any) -> Any:
        names.append(statement.name)
        return cast(statement, *rest)

    monkeypatch.setattr(claim_search, "cast_votes", counted)
    return names


def fresh(folder: Path, revote: bool = False) -> Run:
    return run(CLAIMS, Options(folder, jobs=1, fresh=True, revote=revote))


def own(folder: Path, most: str) -> Path:
    path = folder / "mine.py"
    path.write_text(OWN.format(most=most), encoding="utf-8")
    return path


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_fresh_run_quotes_the_votes_beside_the_committed_certificates_holds(
    tmp_path: Path, asked: list[str]
) -> None:
    done = fresh(tmp_path)
    committed, votes = findings_in(DEFAULT), [vote for one in done.judgements for vote in one.votes]
    assert votes and not asked
    for name in CHOSEN:
        assert findings_in(tmp_path)[name]["votes"] == committed[name]["votes"]


@pytest.mark.parametrize("options", [(), ("--fresh",)])
def test_revote_asks_again_and_changes_no_byte_holds(
    tmp_path: Path, asked: list[str], options: Sequence[str]
) -> None:
    """Nor is what is printed another."""
    only = [word for name in CHOSEN for word in ("--only", name)]
    told, written = [], []
    for number, more in enumerate(([], ["--revote"])):
        folder, out = tmp_path / f"{number}", tmp_path / f"{number}.json"
        arguments = ["certify", "--jobs=1", *options, *only, *more]
        done = command(*arguments, f"--store={folder}", f"--json={out}")
        told.append((done.returncode, done.stdout, out.read_bytes()))
        written.append(content(folder))
        assert bool(asked) == bool(more)
    assert told[0] == told[1] and written[0] == written[1]


def test_rejects_votes_with_another_budget(
    tmp_path: Path, asked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(judge, "VoteBudget", lambda: VoteBudget(boxes=VoteBudget().boxes - 1))
    fresh(tmp_path)
    assert {name.split("/")[0] for name in asked} == {*CHOSEN}


def test_rejects_votes_of_another_version(
    tmp_path: Path, asked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(judgement, "_tools", lambda: "4.0 0.1")
    fresh(tmp_path)
    assert {name.split("/")[0] for name in asked} == {*CHOSEN}


def test_rejects_votes_on_another_text(tmp_path: Path, asked: list[str]) -> None:
    assert command("certify", "--jobs=1", str(own(tmp_path, "1"))).returncode == 0
    assert asked == ["mine/main"]
    assert command("certify", "--jobs=1", str(own(tmp_path, "1"))).returncode == 0
    assert asked == ["mine/main"]
    assert command("certify", "--jobs=1", str(own(tmp_path, "12"))).returncode == 0
    assert asked == ["mine/main", "mine/main"]


def test_rejects_votes_of_fewer_routes(tmp_path: Path, asked: list[str]) -> None:
    path = str(own(tmp_path, "1"))
    for routes, count in (("exact,z3", 1), ("exact,z3", 1), ("exact,z3,boxes", 2), ("exact", 2)):
        assert command("certify", "--jobs=1", f"--routes={routes}", path).returncode == 0
        assert len(asked) == count


def test_rejects_revote_by_some_routes() -> None:
    options = Options(Path("store"), revote=True)
    with pytest.raises(ClaimError, match="--revote: asks each route again"):
        replace(options, routes=("exact", "z3"))
