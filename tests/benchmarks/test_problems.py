"""The set of problems is what docs/your-own.md says of it; the whole of it is answered by
`python -m juggleproof.benchmarks.problems`.
"""

from __future__ import annotations

import re
import zlib

import pytest

from juggleproof.benchmarks import problems
from juggleproof.smtlib.script import Problem, problems_of_file, read_problems

SCRIPTS = problems.scripts()
SAMPLE_SCRIPTS = [path for path in SCRIPTS if path.stem in ("cases", "radicals", "roots")]


@pytest.fixture(scope="module", name="every")
def all_problems() -> list[Problem]:
    """Every problem of the set."""
    return [problem for path in SCRIPTS for problem in problems_of_file(path)]


def test_every_problem_has_a_name_a_status_a_source_and_a_comment_holds(
    every: list[Problem],
) -> None:
    for problem in every:
        assert problem.name and problem.source and problem.status in ("sat", "unsat"), problem.place
    assert len({problem.name for problem in every}) == len(every)
    for path in SCRIPTS:
        text = path.read_text(encoding="utf-8")
        described = re.findall(r"\n\n(?:; .+\n)+\(push 1\)\n\(set-info :name ", text)
        assert text.startswith("; ") and len(described) == text.count("(check-sat)") > 4, path.name


def test_the_page_counts_the_set_as_it_is_holds(every: list[Problem]) -> None:
    counted = problems.COUNTS.text()
    statuses = [problem.status for problem in every]
    assert len(SCRIPTS) == 12 and (statuses.count("unsat"), statuses.count("sat")) == (58, 56)
    assert counted.startswith(
        f"{len(every)} problems, stated unsat {statuses.count('unsat')} and sat"
        f" {statuses.count('sat')}: "
    )
    answered, open_, otherwise = map(int, re.findall(r"(\d+) (?:answered|open|otherwise)", counted))
    assert (answered, open_, otherwise) == (114, 0, 0)


def test_a_sample_is_answered_as_stated_holds() -> None:
    done = problems.answered(SAMPLE_SCRIPTS)
    assert len(done) > 20
    for one in done:
        assert one.settled, one.name
    assert "roots/golden-ratio" in [one.name for one in done]


def test_a_problem_alone_is_the_problem_in_its_script_holds(every: list[Problem]) -> None:
    for problem in every:
        (alone,) = read_problems(problem.script, "alone")
        assert alone.variables == problem.variables, problem.place
        assert [formula for _, formula in alone.assertions] == [
            formula for _, formula in problem.assertions
        ], problem.place


@pytest.mark.parametrize("peer", ["z3", "cvc5"])
def test_no_solver_contradicts_a_status_of_the_sample_holds(
    peer: str, every: list[Problem]
) -> None:
    if peer not in problems.peers():
        pytest.skip(f"{peer} is not installed")
    sample = [problem for problem in every if zlib.crc32(problem.name.encode()) % 6 == 0]
    votes = dict(
        zip([problem.name for problem in sample], problems.votes(peer, sample, 20.0), strict=True)
    )
    stated = {problem.name: problem.status for problem in sample}
    assert len(sample) > 10
    assert not {name: word for name, word in votes.items() if word not in ("unknown", stated[name])}
    assert sum(word != "unknown" for word in votes.values()) > len(sample) // 2
