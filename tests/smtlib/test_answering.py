"""Answers end to end: each is one that the checker accepted, whoever does the work, and it is told
as it is.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections import Counter
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from fractions import Fraction
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from random import Random
from typing import Any

import pytest
import z3

from juggleproof.api import certify
from juggleproof.certificates import checker
from juggleproof.judging.run import Options
from juggleproof.judging.run import run as judged
from juggleproof.papers.paper import opened
from juggleproof.reports.problems import settled_by
from juggleproof.smtlib.answering import (
    ScriptQuestion,
    answer,
    answer_files,
    question,
    settled,
)
from juggleproof.smtlib.script import Problem, problems_of_file, read_problems
from juggleproof.statements.language import ClaimError
from tests.command.running import ROOT, run, run_anew
from tests.rows import each_row
from tests.smtlib.evaluating import truth

FAST = (
    "am-gm-3",
    "nesbitt",
    "motzkin",
    "octic-no-root",
    "circles-meet",
    "two-roots-sharp",
    "ellipses-meet",
    "two-modes",
    "parrilo-mutated",
    "braking",
)
SEVERAL = """(set-logic QF_NRA)(declare-const x Real)(declare-const b Bool)
(set-info :status sat)(assert (= (* x x) 2))(check-sat)
(push 1)(set-info :status unsat)(assert (> x 3))(check-sat)(pop 1)
(assert (= b (< x 0)))(assert b)(check-sat)
(reset)(set-info :status sat)(check-sat)
(assert false)(set-info :status unsat)(check-sat)
"""


@cache
def problem_set() -> dict[str, Problem]:
    """The problems of benchmarks by name."""
    paths = sorted((ROOT / "benchmarks" / "problems").glob("*.smt2"))
    return {problem.name: problem for path in paths for problem in problems_of_file(path)}


def script(folder: Path, text: str, name: str = "mine") -> Path:
    path = folder / f"{name}.smt2"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", FAST)
def test_a_problem_is_answered_as_it_is_stated_holds(name: str, tmp_path: Path) -> None:
    (one,) = answer_files([script(tmp_path, problem_set()[name].script, name)], store=tmp_path)
    assert (
        problem_set()[name].status in ("sat", "unsat")
        and one.answer.word == problem_set()[name].status
    )
    results = checker.check_folder(str(tmp_path))
    assert [outcome for _, outcome, _ in results] == [
        "certified" if one.answer.word == "unsat" else "refuted"
    ]
    if one.answer.word == "sat" and not one.answer.numbers:
        point = {name: Fraction(value) for name, value in one.answer.model}
        assert all(truth(formula, point) for _, formula in one.problem.assertions)


def test_every_check_sat_of_a_script_is_answered_holds(tmp_path: Path) -> None:
    path = script(tmp_path, SEVERAL)
    found = certify(path)
    assert [(one.name, one.answer) for one in found] == [
        ("mine/check-1", "sat"),
        ("mine/check-2", "unsat"),
        ("mine/check-3", "sat"),
        ("mine/check-4", "sat"),
        ("mine/check-5", "unsat"),
    ]
    assert found[2].model["b"] == "true" and found[2].numbers and found[3].model == {}
    assert checker.main([str(path.with_suffix(".certificates"))]) == 0


NAMED = """(declare-const x Real)
(push 1)(set-info :name |two roots|)(assert (= (* x x) 2))(check-sat)(pop 1)
(push 1)(assert (< (* x x) 0))(check-sat)(pop 1)
(set-info :name square)(set-info :status sat)(assert (< (* x x) 0))(check-sat)
"""


def test_a_problem_bears_the_name_that_its_script_gives_it_holds(tmp_path: Path) -> None:
    found = certify(script(tmp_path, NAMED))
    assert [(one.name, one.answer) for one in found] == [
        ("mine/two-roots", "sat"),
        ("mine/check-2", "unsat"),
        ("mine/square", "unsat"),
    ]
    done = run("certify", str(tmp_path / "mine.smt2"))
    assert done.returncode == 1 and "mine/two-roots  sat" in done.stdout
    assert "mine.smt2:4 (square): the script states sat, but it is unsat" in done.stdout


NINES = "9" * 999


@pytest.mark.parametrize(
    "body",
    [
        f"(assert (> x (* {' '.join([NINES] * 5)})))",
        "(assert (> x (^ 99999 99)))(assert (< (^ x 20) 0))",
    ],
)
def test_numbers_that_the_search_cannot_hold_are_unknown_holds(body: str, tmp_path: Path) -> None:
    (found,) = answer_files([script(tmp_path, f"(declare-const x Real){body}(check-sat)")])
    assert (
        found.answer.word == "unknown"
        and found.answer.reason == "its numbers grow too long for the search"
    )


def test_a_problem_beyond_the_checkers_limits_is_unknown_and_says_so(tmp_path: Path) -> None:
    names = [f"x{k}" for k in range(401)]
    rising = "".join(f"(assert (< {one} {other}))" for one, other in zip(names, names[1:]))
    for divided in ("", "(assert (> (/ 1 x5) x6))"):
        text = "".join(f"(declare-const {name} Real)" for name in names)
        (found,) = answer_files([script(tmp_path, f"{text}{rising}{divided}(check-sat)")])
        assert found.answer.word == "unknown"
        assert found.answer.reason == "beyond the checker's limits: too many variables: x400"


def test_a_quotient_of_a_quotient_that_may_not_be_one_is_answered_holds(tmp_path: Path) -> None:
    """Whether a divisor vanishes is asked of a term that divides itself."""
    body = "(assert (< (/ (/ y y) (ite (<= 1 y) 0.0 2)) 1 0))"
    (found,) = answer_files([script(tmp_path, f"(declare-const y Real){body}(check-sat)")])
    assert found.answer.word in ("sat", "unsat", "unknown")


def test_rejects_a_symbol_that_writes_rows_of_its_own(tmp_path: Path) -> None:
    name = "|x = 0\nlater unsat certificate\n1 problem: 1 unsat|"
    text = f"(declare-const {name} Real)(assert (= {name} 2))(check-sat)"
    (found,) = answer_files([script(tmp_path, text)])
    assert found.answer.word == "sat" and "\n" not in settled_by(found)


def test_contradictory_givens_are_unsat_by_a_statement_of_their_own_holds(tmp_path: Path) -> None:
    path = script(
        tmp_path,
        "(declare-const x Real)(assert (> x 0))(assert (< x (- 1)))(assert (< (/ 1 x)"
        " 5))(check-sat)",
    )
    (found,) = certify(path)
    assert found.answer == "unsat"
    assert (
        found.statements["mine/check"]
        == "statement mine/check\nforall x\nshow not (x > 0 and x < -1)"
    )


def test_a_model_meets_what_keeps_divisors_from_zero_holds(tmp_path: Path) -> None:
    path = script(
        tmp_path,
        "(declare-const x Real)(assert (not (= x 1)))(assert (> (/ 1 (- x 1)) 7))(check-sat)",
    )
    (found,) = certify(path)
    assert found.answer == "sat" and 1 / (Fraction(found.model["x"]) - 1) > 7


def test_what_is_stored_is_used_again_and_a_changed_certificate_is_not(tmp_path: Path) -> None:
    path = script(tmp_path, "(declare-const x Real)(assert (< (* x x) (- 1)))(check-sat)")
    assert certify(path)[0].answer == "unsat"
    file = path.with_suffix(".certificates") / "certificates.jsonl"
    before = file.read_bytes()
    other = {"refuted": ["mine/check", [], {"x": "1"}, ["close"], ["close"]]}
    file.write_text(json.dumps(["mine/check", other]) + "\n", encoding="ascii")
    assert certify(path)[0].answer == "unsat" and file.read_bytes() == before


def test_rejects_a_certificate_for_another_statement() -> None:
    text, other = (f"statement a/check\nforall x\nshow not x^2 < {bound}" for bound in ("0", "1"))
    found = answer(ScriptQuestion("a/check", (text,)))
    assert settled("a/check", text, found.certificate) == "unsat"
    assert settled("a/check", other, found.certificate) == "unknown"
    assert (
        settled("a/check", text, {"certified": True})
        == settled("a/check", text, {"unsat": "z3"})
        == "unknown"
    )


def test_a_small_budget_leaves_a_problem_unknown_and_says_so(tmp_path: Path) -> None:
    (found,) = certify(
        script(tmp_path, problem_set()["minkowski-plane"].script), budget=2000, store=tmp_path
    )
    assert found.answer == "unknown"
    assert checker.check_folder(str(tmp_path))[0][1] == "unknown"


# ------------------------------------------------------------ who does the work


CLAIMS = """from juggleproof import always, claim, reals
x, y = reals("x y")
@claim("mean")
def one():
    '''A mean.'''
    return always(x * y <= (x**2 + y**2) / 2)
@claim("false")
def two():
    '''Not so.'''
    return always(x**2 > x, given=[x > 0])
"""


def cluster() -> Any:
    distributed = pytest.importorskip("distributed")
    return distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True
    )


def stored(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def everything(folder: Path, executor: Executor | None) -> dict[str, bytes]:
    """What is stored of claims, of a script, and of a claim of the paper, with this executor."""
    folder.mkdir()
    (folder / "claims.py").write_text(CLAIMS, encoding="utf-8")
    assert [one.answer for one in certify(folder / "claims.py", executor)] == ["holds", "false"]
    assert [one.answer for one in certify(script(folder, SEVERAL), executor)] == [
        "sat",
        "unsat",
        "sat",
        "sat",
        "unsat",
    ]
    options = Options(folder / "paper", ("exact",), jobs=1, fresh=True, only=("eq-10",))
    judged(opened().claims(), options, executor=executor)
    return {
        f"{part}/{name}": content
        for part in ("claims.certificates", "mine.certificates", "paper")
        for name, content in stored(folder / part).items()
    }


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return everything(tmp_path_factory.mktemp("alone") / "here", None)


def test_a_thread_finds_the_same_bytes_holds(tmp_path: Path, alone: dict[str, bytes]) -> None:
    with ThreadPoolExecutor(1) as pool:
        assert everything(tmp_path / "here", pool) == alone


def test_several_threads_find_the_same_bytes_holds(tmp_path: Path, alone: dict[str, bytes]) -> None:
    with ThreadPoolExecutor(3) as pool:
        assert everything(tmp_path / "here", pool) == alone


@pytest.mark.exhaust
def test_processes_that_share_nothing_find_the_same_bytes_holds(
    tmp_path: Path, alone: dict[str, bytes]
) -> None:
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        assert everything(tmp_path / "here", pool) == alone


def test_a_dask_cluster_finds_the_same_bytes_holds(tmp_path: Path, alone: dict[str, bytes]) -> None:
    with cluster() as machines, machines.get_client() as client:
        assert everything(tmp_path / "here", client.get_executor()) == alone


def test_an_error_in_a_process_comes_back_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "bad.py"
    path.write_text(CLAIMS.replace("given=[x > 0]", "given=[x > 0, x < 0]"), encoding="utf-8")
    with (
        ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool,
        pytest.raises(ClaimError, match="hypotheses contradict"),
    ):
        certify(path, pool)


def test_rejects_what_is_neither_a_path_nor_claims() -> None:
    for wrong in ([], ["mine.py"]):
        with pytest.raises(ClaimError, match="neither a path nor claims"):
            certify(wrong)  # type: ignore[arg-type]


# ------------------------------------------------------------ the command


def test_the_command_answers_and_keeps_certificates_beside_the_script(tmp_path: Path) -> None:
    path = script(tmp_path, problem_set()["motzkin"].script)
    done = run_anew("certify", str(path), "--json", str(tmp_path / "out.json"))
    assert done.returncode == 0, done.stderr
    assert (
        "mine     unsat   certificate" in done.stdout
        and "1 problem: 1 unsat, 0 sat, 0 unknown" in done.stdout
    )
    assert (
        json.loads((tmp_path / "out.json").read_text(encoding="ascii"))["mine/check"]["answer"]
        == "unsat"
    )
    bare = subprocess.run(
        [
            sys.executable,
            "-I",
            "-S",
            str(ROOT / "certificates/checker"),
            str(tmp_path / "mine.certificates"),
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert bare.returncode == 0 and "1 certified" in bare.stdout
    assert run("check", str(tmp_path / "mine.certificates")).returncode == 0


def test_an_answer_that_the_script_states_otherwise_is_told_loudly(tmp_path: Path) -> None:
    done = run(
        "certify",
        str(
            script(
                tmp_path,
                "(set-info :status unsat)(declare-const x Real)(assert (= (* x x) 4))\n(check-sat)",
            )
        ),
    )
    assert done.returncode == 1
    assert (
        "CONTRADICTS" in done.stdout
        and "mine.smt2:2: the script states unsat, but it is sat" in done.stdout
    )


def test_an_open_problem_gives_exit_code_1(tmp_path: Path) -> None:
    done = run(
        "certify",
        str(script(tmp_path, problem_set()["minkowski-plane"].script)),
        "--budget",
        "2000",
    )
    assert done.returncode == 1 and "1 problem: 0 unsat, 0 sat, 1 unknown" in done.stdout


WRONG = [
    (["mine.smt2"], "(assert (> x 0))(check-sat)", "mine.smt2:1: x is not declared"),
    (["mine.smt2", "other.py"], "(check-sat)", "other.py: beside scripts of SMT-LIB"),
    (["mine.smt2", "mine.smt2"], "(check-sat)", "rename one"),
    (
        ["mine.smt2"],
        "(set-info :name a)(check-sat)\n(set-info :name a)(check-sat)",
        "mine.smt2:2 (a): its statement would have the name of that of mine.smt2:1 (a)",
    ),
    (
        ["mine.smt2"],
        "(check-sat)(set-info :name check-1)(check-sat)",
        "(check-1): its statement would have the name of that of mine.smt2:1; rename one",
    ),
    (["mine.smt2", "--only", "x"], "(check-sat)", "--only: not for scripts"),
    (["mine.smt2", "--junit", "x.xml"], "(check-sat)", "--junit: not for scripts"),
    (["mine.smt2", "--json", "mine.smt2"], "(check-sat)", "would overwrite"),
]


@pytest.mark.parametrize("arguments, text, told", WRONG)
def test_rejects_bad_input_in_one_line(
    arguments: list[str], text: str, told: str, tmp_path: Path
) -> None:
    script(tmp_path, text)
    done = run("certify", *arguments, cwd=tmp_path)
    assert done.returncode == 2 and told in done.stderr and done.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["mine.smt2"]


def _term(rng: Random, depth: int) -> str:
    if depth == 0 or rng.random() < 1 / 4:
        return rng.choice(["x", "y", "1", "2", "0", "(- 1)"])
    sign = rng.choice("+-*//")
    return f"({sign} {_term(rng, depth - 1)} {_term(rng, depth - 1)})"


def _formula(rng: Random, depth: int) -> str:
    if depth == 0 or rng.random() < 2 / 5:
        sign = rng.choice(["<", "<=", "=", ">", ">="])
        return f"({sign} {_term(rng, 2)} {_term(rng, 1)})"
    sign = rng.choice(["and", "or", "=>", "not"])
    parts = [_formula(rng, depth - 1) for _ in range(1 if sign == "not" else 2)]
    return f"({sign} {' '.join(parts)})"


@pytest.mark.exhaust
@each_row("seed", range(3))
def test_random_problems_with_divisions_by_anything_are_answered_as_by_z3_holds(seed: int) -> None:
    rng, words = Random(seed), Counter[str]()
    for _ in range(20):
        asserted = "".join(f"(assert {_formula(rng, 2)})" for _ in range(rng.randint(1, 3)))
        text = f"(declare-const x Real)(declare-const y Real){asserted}"
        (problem,) = read_problems(text + "(check-sat)", "f")
        word = answer(question(problem, "f/check")).word
        solver = z3.Solver()
        solver.set("rlimit", 3_000_000)
        solver.from_string(text)
        assert word == str(solver.check()), text
        words[word] += 1
    assert words["sat"] and words["unsat"]
