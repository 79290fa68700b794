"""Every published map in examples comes out as docs/stability.md says, with no rank typed in it;
what is written is read by the checker, by `certify` without a search, and by coqc.  `make test`
settles one of them; `make exhaust` settles all, and with JUGGLEPROOF_MUTANTS=many an attraction
and an escape are compiled.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from juggleproof.benchmarks import stability
from juggleproof.judging.searches import claim_search
from juggleproof.map_stability.findings import MapVerdict
from tests.command import running
from tests.proofs.coq.development import coqc
from tests.rows import each_row
from tests.share import MANY

OUTCOMES = stability.outcomes(stability.TABLE.text())
EXAMPLES = stability.examples()
COMPILED = ("lozi", "skew-tent") if MANY else ()
QUICK = "skew-tent"  # in each run of the tests
SETTLED = [
    path if path.stem == QUICK else pytest.param(path, marks=pytest.mark.exhaust)
    for path in EXAMPLES
]


def test_the_page_has_every_example_and_most_are_proved_holds() -> None:
    assert [path.stem for path in EXAMPLES] == list(OUTCOMES) and len(EXAMPLES) >= 12
    heads = [outcome.partition(":")[0] for outcome in OUTCOMES.values()]
    assert {"proved", "in part", "refuted"} <= set(heads) <= {*MapVerdict}
    assert heads.count("proved") > len(heads) // 2


@each_row("path", EXAMPLES)
def test_an_example_is_short_cites_its_source_and_types_no_rank_holds(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    comment = "".join(line for line in lines if line.startswith("#"))
    assert len(lines) < 15 and re.search(r"^# [A-Z]\..*\b(19|20)\d\d\b", comment)
    keywords = {line.split()[0] for line in lines if not line.startswith("#")}
    assert keywords <= {"over", "domain", "state", "space", "piece"}


@pytest.mark.parametrize("path", SETTLED, ids=lambda path: str(path.stem))
def test_an_example_is_settled_as_the_page_says_holds(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = running.run("stability", str(path), "-o", str(tmp_path))
    assert done.stderr == ""
    outcome = stability.outcome_of(done.stdout)
    assert outcome == OUTCOMES[path.stem]
    assert done.returncode == MapVerdict(outcome.partition(":")[0]).exit_code

    claims = tmp_path / f"{path.stem.replace('-', '_')}.py"
    checker = [sys.executable, "-I", "-S", "certificates/checker"]
    read = subprocess.run(
        [*checker, str(claims.with_suffix(".certificates"))],
        cwd=stability.ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    (last,) = re.findall(r"(\d+) statements: (\d+) certified, 0 refuted, 0 unknown", read.stdout)
    assert last[0] == last[1] != "0"

    def search(*_: object, **__: object) -> None:
        raise AssertionError("`certify` searches for what is stored")

    monkeypatch.setattr(claim_search, "search_premises", search)
    certified = running.run("certify", str(claims), "--routes", "exact")
    assert certified.returncode == 0, certified.stderr
    assert "1 claim: 1 holds" in certified.stdout

    if path.stem in COMPILED:
        compiler = coqc()
        assert running.run("export", "coq", str(claims), "-o", str(tmp_path)).returncode == 0
        (theorem,) = tmp_path.glob("S_*.v")
        accepted = subprocess.run(
            [compiler, "-q", theorem.name],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )
        assert accepted.returncode == 0, accepted.stderr
        assert accepted.stdout.startswith("Axioms:\n")


def test_rejects_a_table_with_a_column_that_nothing_fills(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(stability.PEERS, "cvxpy", lambda: False)
    with pytest.raises(SystemExit):
        stability.main(["--accept"])
    assert "install cvxpy, of which the table has a column" in capsys.readouterr().err
