"""A store that somebody else wrote: what is shown of a claim is what the checker says of the
statements that the sources write, whatever else the folder holds.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from juggleproof.command import explain
from juggleproof.command.main import run as command
from juggleproof.judging.claims import assertions, named_statements
from juggleproof.judging.judgement import Correction, Judgement
from juggleproof.judging.run import FINDINGS, Options, Run, run
from juggleproof.judging.searches.range_search import search_sharp_range
from juggleproof.papers.paper import opened
from juggleproof.reports.results import summary
from juggleproof.statements.language import real
from juggleproof.statements.store import CERTIFICATES, STATEMENTS, certificate_lines
from tests.certificates.checker.maps import SUBTRACT, searched
from tests.judging.stores import part_of_store

BOUND, RANGED = "eq-37/bound", "eq-21"
FALSE_PROOF = {"certified": ["proof", [], ["close"]], "point": [BOUND, [], {}, ["close"]]}
CLAIMS = [claim for claim in opened().claims() if claim.id in ("eq-37", RANGED)]
Json = Any


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is stored of two claims."""
    kept = {claim.id for claim in CLAIMS}
    folder = part_of_store(tmp_path_factory.mktemp("small") / "store", kept.__contains__)
    run(CLAIMS, Options(folder, jobs=1))
    return folder


@pytest.fixture
def folder(small: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(small, tmp_path / "store"))


def judged(folder: Path, routes: tuple[str, ...] = ("exact",)) -> Run:
    return run(CLAIMS, Options(folder, routes, jobs=1))


@pytest.fixture(scope="module")
def good(small: Path) -> Judgement:
    """What is judged of a claim where nothing is forged."""
    return of(judged(small), "eq-37")


def of(done: Run, claim: str) -> Judgement:
    return next(one for one in done.judgements if one.id == claim)


def change(path: Path, edit: Callable[[dict[str, Json]], object]) -> None:
    """Rewrites certificates or findings, as a dictionary by name."""
    if path.name == FINDINGS:
        data = json.loads(path.read_text())
        edit(data)
        path.write_text(json.dumps(data))
    else:
        data = dict(json.loads(line) for line in path.read_text().splitlines())
        edit(data)
        path.write_bytes(certificate_lines(data))


def restate(path: Path, name: str, statement: str) -> None:
    """Puts another statement in the place of one."""
    blocks = path.read_text().split("\n\n")
    at = next(i for i, block in enumerate(blocks) if f"statement {name}\n" in block)
    blocks[at] = statement
    path.write_text("\n\n".join(blocks))


def test_another_statement_under_the_name_of_one_is_told_and_replaced(folder: Path) -> None:
    path = folder / STATEMENTS
    good = path.read_text()
    restate(path, BOUND, f"statement {BOUND}\nshow 0 < 1")
    change(folder / CERTIFICATES, lambda data: data.update({BOUND: FALSE_PROOF}))
    done = judged(folder)
    assert done.restated == (BOUND,) and done.rejected == []
    assert path.read_text() == good


def test_certify_says_what_was_restated(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mine = tmp_path / "mine.py"
    mine.write_text(
        "from juggleproof import always, claim, reals\n(x,) = reals('x')\n"
        "@claim('mine')\ndef _():\n    'A square.'\n    return always(x**2 >= 0)\n"
    )
    assert command(["certify", str(mine)]) == 0
    assert "restated" not in capsys.readouterr().out
    mine.write_text(mine.read_text().replace(">= 0", "+ 1 > 0"))
    assert command(["certify", str(mine)]) == 0
    assert "restated mine/main: what was stored is not" in capsys.readouterr().out


def test_a_line_below_a_blank_one_belongs_to_no_statement(folder: Path) -> None:
    """Two readers of the file would else disagree on what was certified."""
    path = folder / STATEMENTS
    good = path.read_text()
    end = good.index("\n\n", good.index(f"statement {BOUND}\n"))
    path.write_text(good[:end] + "\n\ngiven 0 = 1" + good[end:])
    done = judged(folder)
    assert done.outcomes[BOUND] == "certified" and path.read_text() == good


def test_a_range_in_the_findings_is_not_shown(folder: Path) -> None:
    shown = of(judged(folder), "eq-37").sharp
    change(folder / FINDINGS, lambda data: data["eq-37"].update(sharp={"": "0 < alpha < 9"}))
    assert of(judged(folder), "eq-37").sharp == shown


def test_a_range_on_a_part_of_the_domain_is_not_shown(folder: Path) -> None:
    """Certified as it is, but about alpha < 1/5 only."""
    claim = next(one for one in CLAIMS if one.id == RANGED)
    good = of(judged(folder), RANGED)
    ((prefix, assertion), *_) = assertions(claim.body())
    parts = [
        part for part in named_statements(claim.id, prefix, assertion) if hasattr(part, "forall")
    ]
    name, alpha = f"{RANGED}/{prefix}sharp", real("alpha")
    assert name in good.certificates
    narrow = {"alpha": (alpha > 0, alpha < Fraction(1, 5))}
    roles = type(good.roles)(narrow, good.roles.scales)
    found = search_sharp_range(name, parts, ("alpha",), {}, 10**7, roles)
    assert found is not None
    sharp, certificate = found
    restate(folder / STATEMENTS, name, sharp.text())
    change(folder / CERTIFICATES, lambda data: data.update({name: {"certified": certificate}}))
    again = judged(folder)
    assert of(again, RANGED).sharp == good.sharp
    assert name in again.restated


def test_votes_are_said_to_be_on_record(folder: Path) -> None:
    done = judged(folder, ("exact", "z3", "boxes"))
    assert "z3 votes on record: " in summary(done.judgements)


def test_a_vote_that_contradicts_the_checker_is_cast_again(folder: Path) -> None:
    def forge(data: dict[str, Json]) -> None:
        for entry in data["eq-37"]["votes"].values():
            for vote in entry["votes"]:
                vote["answer"] = "fails"

    change(folder / FINDINGS, forge)
    done = of(judged(folder, ("exact", "z3", "boxes")), "eq-37")
    votes = [vote for cast in done.votes.values() for vote in cast]
    assert votes and not any(vote.answer == "fails" for vote in votes)


@pytest.mark.parametrize(
    "entry",
    [
        [],
        {"votes": 5},
        {"votes": {BOUND: {"on": "x"}}},
        {"votes": {BOUND: {"on": "x", "votes": [{"route": "z3"}]}}},
        {"votes": {BOUND: {"on": 1, "votes": []}}},
        {"votes": {BOUND: {"on": "\x1b[2J", "votes": []}}},
        {"sharp": ["0 < alpha"]},
        {"sharp": {"": 3}},
        {"correction": {"kind": "nearby"}},
        {"correction": dict.fromkeys(Correction.__annotations__, 1)},
        {"more": {}},
    ],
)
def test_rejects_findings_of_another_shape(folder: Path, entry: Json, good: Judgement) -> None:
    change(folder / FINDINGS, lambda data: data.update({"eq-37": entry}))
    again = of(judged(folder), "eq-37")
    assert (again.verdict, again.sharp, again.outcomes) == (good.verdict, good.sharp, good.outcomes)


def test_explain_asks_the_checker(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    change(folder / CERTIFICATES, lambda data: data.update({BOUND: FALSE_PROOF}))
    monkeypatch.setattr(explain, "DEFAULT", folder)
    assert explain.explain("eq-37") == 0
    shown = capsys.readouterr().out
    bound = shown[shown.index(f"statement {BOUND}") :]
    assert bound[bound.index("-> ") :].startswith("-> certified by [")
    assert not bound[bound.index("-> ") :].startswith('-> certified by ["proof",[],["close"]]')


def test_a_conclusion_does_not_follow_from_another_theorem_of_that_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Certified as it is, but under another map."""
    folder = part_of_store(
        tmp_path / "store", lambda claim: claim.startswith(("theorem", "s4.3.1-plain"))
    )
    monkeypatch.setattr(explain, "DEFAULT", folder)
    assert explain.explain("s4.3.1-plain-english") == 0
    assert "\nverdict     holds; by theorem-in-units/exactly" in capsys.readouterr().out
    path = folder / STATEMENTS
    blocks = path.read_text().split("\n\n")
    another = SUBTRACT.replace("demo/", "theorem-in-units/").strip().split("\n\n")
    kept = [one for one in blocks if not one.startswith("statement theorem-in-units/")]
    path.write_text("\n\n".join([*(one.strip() for one in kept), *another]) + "\n")
    certificates = {
        name.replace("demo/", "theorem-in-units/"): one for name, one in searched(SUBTRACT).items()
    }
    change(folder / CERTIFICATES, lambda data: data.update(certificates))
    assert explain.explain("s4.3.1-plain-english") == 0
    assert "\nverdict     unknown" in capsys.readouterr().out
