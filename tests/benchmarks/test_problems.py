"""The set of problems is what docs/your-own.md says of it; the whole of it is answered in CI by
`python -m juggleproof.benchmarks.problems`.
"""

from __future__ import annotations

import re
import zlib

import pytest

from juggleproof.benchmarks import problems
from juggleproof.proofs.smtlib.script import problems_of_file

SCRIPTS = problems.scripts()
SAMPLE = [path for path in SCRIPTS if zlib.crc32(path.name.encode()) % 6 == 0]


def test_every_problem_has_a_status_a_source_and_a_comment_holds() -> None:
    for path in SCRIPTS:
        text = path.read_text(encoding="utf-8")
        (one,) = problems_of_file(path)
        assert (
            one.status in ("sat", "unsat")
            and text.startswith("; ")
            and re.search(r"\(set-info :source \|\S", text)
        ), path.name


def test_the_page_counts_the_set_as_it_is_holds() -> None:
    said = problems.stated_in_page()
    statuses = [problems_of_file(path)[0].status for path in SCRIPTS]
    assert len(SCRIPTS) >= 60 and 0.4 < statuses.count("sat") / len(statuses) < 0.6
    assert said.startswith(
        f"{len(SCRIPTS)} problems, stated unsat {statuses.count('unsat')} and sat"
        f" {statuses.count('sat')}: "
    )
    answered, open_, otherwise = map(int, re.findall(r"(\d+) (?:answered|open|otherwise)", said))
    assert answered + open_ + otherwise == len(SCRIPTS) and otherwise == 0 and answered >= 54


def test_a_sample_is_answered_as_stated_holds() -> None:
    assert len(SAMPLE) > 10
    for one in problems.answered(SAMPLE):
        assert one.settled, one.name


@pytest.mark.parametrize("peer", ["z3", "cvc5"])
def test_no_solver_contradicts_a_status_of_the_sample_holds(peer: str) -> None:
    if peer not in problems.peers():
        pytest.skip(f"{peer} is not installed")
    votes = {path.stem: problems.vote(peer, path, 20.0) for path in SAMPLE}
    stated = {path.stem: problems_of_file(path)[0].status for path in SAMPLE}
    assert not {name: word for name, word in votes.items() if word not in ("unknown", stated[name])}
    assert sum(word != "unknown" for word in votes.values()) > len(SAMPLE) // 2
