"""The random problems by classes are what their makers say, and a wrong answer is seen."""

from __future__ import annotations

from pathlib import Path

import pytest

from juggleproof.benchmarks.classes import __main__ as command
from juggleproof.benchmarks.classes import measuring
from juggleproof.benchmarks.classes.classes import CLASSES, SEEDS, Made, every_problem, made
from juggleproof.benchmarks.classes.polynomials import FORMS
from juggleproof.benchmarks.classes.writing import variables
from juggleproof.benchmarks.processes import TimedProcess
from juggleproof.coq_store import share_of
from juggleproof.smtlib.script import problems_of_file


@pytest.fixture(scope="module", name="every")
def all_problems() -> list[Made]:
    """Every problem of every class."""
    return every_problem()


def test_every_kind_is_made_with_and_without_a_solution_holds(every: list[Made]) -> None:
    names = [problem.name for problem in every]
    assert len(set(names)) == len(names) == SEEDS * len(CLASSES)
    for group, makers in CLASSES.items():
        of_group = [problem for problem in every if problem.group == group]
        for maker in makers:
            kind = maker.__name__.replace("_", "-") + "-"
            assert {one.status for one in of_group if one.name.startswith(kind)} == {"sat", "unsat"}


def test_a_seed_makes_the_same_script_again_holds(every: list[Made]) -> None:
    assert [made(one.group, int(one.name.rsplit("-", 1)[1])) for one in every] == every


def test_the_published_forms_are_not_negative_on_a_grid_holds() -> None:
    for form, there in FORMS:
        polynomial = form(*variables(len(there)))
        degrees = {sum(powers) for powers in polynomial.monoms()}
        assert len(degrees) == 1, form.__name__
        ends: list[tuple[int, ...]] = [()]
        for _ in there:
            ends = [(*end, value) for end in ends for value in range(-3, 4)]
        assert min(polynomial(*end) for end in ends) == 0, form.__name__


def test_z3_and_we_say_what_each_problem_of_a_sample_is_holds(every: list[Made]) -> None:
    sample = set(share_of([one.name for one in every], 24))
    solvers = {"Z3": measuring.z3(), "ours": measuring.ours()}
    decided = dict.fromkeys(solvers, 0)
    for problem in every:
        if problem.name not in sample or problem.group in ("size", "many variables"):
            continue
        for solver, ask in solvers.items():
            word = ask(problem)().word
            assert word in (problem.status, "unknown"), (solver, problem.name)
            decided[solver] += word != "unknown"
    assert min(decided.values()) > 4


def test_the_page_has_every_class_and_no_certificate_is_refused_holds(every: list[Made]) -> None:
    rows = [row.strip("| ").split(" | ") for row in command.TABLE.text().splitlines()[2:]]
    cells = {row[0]: row[1:] for row in rows if len(row) > 2}
    assert [*cells] == [*CLASSES, "all"]
    for group, (problems, _, _, ours, certified, *_) in cells.items():
        assert int(problems) == (len(every) if group == "all" else SEEDS)
        assert ours == certified


def measured(word: str) -> measuring.Measured:
    problem = Made("forms", "square-0", "unsat", "")
    said = {"ours": [TimedProcess(measuring.Said(word), 0.1)]}
    return measuring.Measured("forms", [problem], said, int(word == "unsat"), 10, 0.1)


def test_rejects_a_wrong_answer() -> None:
    assert measured("unsat").faults() == measured("unknown").faults() == []
    wrong, rejected = measured("sat").faults()
    assert wrong == "WRONG: forms: square-0 is unsat; ours says sat"
    assert rejected == "REJECTED: forms: the checker takes 0 only"


def test_rejects_a_certificate_that_does_not_prove_the_statement() -> None:
    ask = measuring.ours()
    first, second = (made("commands", seed) for seed in (0, 3))
    said = {measuring.statement_of(one): ask(one)() for one in (first, second)}
    accepted, size, _ = measuring.checked(said)
    assert accepted == 2 and size > 100
    (one, other) = said
    changed = measuring.Said("unsat", said[other].text, said[one].certificate)
    assert measuring.checked({one: said[one], other: changed})[0] == 0


def test_the_written_scripts_state_what_they_are_holds(every: list[Made], tmp_path: Path) -> None:
    assert command.main(["-o", str(tmp_path)]) == 0
    paths = sorted(tmp_path.glob("*/*.smt2"))
    assert len(paths) == len(every)
    (problem,) = problems_of_file(tmp_path / "forms/agiform-2.smt2")
    assert problem.status == made("forms", 2).status


def test_the_table_goes_only_with_all_problems_holds(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        command.main(["--accept", "--share", "2"])
    assert "--accept goes with all problems" in capsys.readouterr().err
