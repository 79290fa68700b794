"""The peers are asked what is meant: each translator gives the right answer on true and false
statements, where its program is there.
"""

from __future__ import annotations

import doctest
import sys
import time
from collections.abc import Callable

import pytest

from juggleproof.benchmarks import peers
from juggleproof.benchmarks.processes import Clock
from juggleproof.certificates import checker
from juggleproof.certificates.votes.questions import read_statement
from tests.certificates.votes.corpus import STATEMENTS

SECONDS = 60.0  # far more than any of them takes, also on a busy machine
Settle = Callable[[checker.Statement, float], peers.Answer]
TRUE = ("square", "f1-in-H", "e1-in-B1", "collision-time", "B1-plus-not-empty", "sup-negative")
FALSE = ("strict-square", "B2-by-time", "circle-half", "p-outside-R-whole", "some-state-gains-more")
LINEAR = ("f1-in-H", "collision-time", "gain-identity")


@pytest.mark.parametrize(
    "settle, present",
    [
        (peers.z3, peers.z3_command()),
        (peers.cvc5, peers.has_cvc5()),
        (peers.qepcad, peers.has_qepcad()),
        (peers.ours, True),
    ],
)
@pytest.mark.parametrize("name", [*TRUE, *FALSE])
def test_a_peer_gives_the_right_answer_holds(name: str, settle: Settle, present: object) -> None:
    if not present:
        pytest.skip(f"{settle.__name__} is not installed")
    statement, expected = STATEMENTS[name]
    assert settle(statement, SECONDS) == ("holds" if expected else "fails")


@pytest.mark.parametrize(
    "name, answer",
    [
        *((name, "holds") for name in LINEAR),
        ("strict-square", "unsettled"),
        ("circle-half", "unsettled"),
    ],
)
def test_nra_proves_what_is_true_and_nothing_false_holds(name: str, answer: str) -> None:
    if not peers.has_coq():
        pytest.skip("coqc is not installed")
    assert peers.coq_nra(STATEMENTS[name][0], SECONDS) == answer


def test_what_a_peer_has_no_words_for_is_not_expressible_holds() -> None:
    integer, exists = STATEMENTS["flight-count"][0], STATEMENTS["B1-plus-not-empty"][0]
    assert peers.qepcad(integer, SECONDS) == "not expressible"
    assert peers.coq_nra(integer, SECONDS) == peers.coq_nra(exists, SECONDS) == "not expressible"


def test_the_formats_are_those_of_the_examples_holds() -> None:
    result = doctest.testmod(peers)
    assert result.attempted and not result.failed


def test_disjunctions_and_fractions_are_written_for_nra_holds() -> None:
    statement = read_statement(
        "statement t/t\nforall x y\ngiven x/3 > 1 or y < -1/2\ngiven x*y != 0\nshow x^2 + y^2 > 1/4"
    )
    (text,) = [peers.goal(question) for question in peers.questions(statement)]
    assert (
        text is not None
        and text.splitlines()[0]
        == "Goal forall v0 v1 : R, (v0 - 3 > 0 \\/ - 2*v1 - 1 > 0) -> (v0*v1 < 0 \\/ v0*v1 > 0) ->"
        " - 4*v0*v0 - 4*v1*v1 + 1 >= 0 -> False."
    )


def test_a_program_that_takes_too_long_is_ended_with_its_children() -> None:
    began = time.monotonic()
    assert (
        Clock(0.3).output_of(
            [sys.executable, "-c", "import subprocess, sys; subprocess.run(['sleep', '30'])"], ""
        )
        is None
    )
    assert time.monotonic() - began < 10


def test_an_answer_that_comes_too_late_does_not_count() -> None:
    method = peers.Method("slow", lambda statement, seconds: "holds")
    method.run("t/t", None, -1.0)
    assert method.answers["t/t"][0] == "unsettled"


def test_rejects_answers_that_contradict_each_other() -> None:
    first, second = (
        peers.Method(title, peers.ours, answers={"t/t": (answer, 0.1)})
        for title, answer in (("a", "holds"), ("b", "fails"))
    )
    silent = peers.Method("c", peers.ours, answers={"t/t": ("unsettled", 0.1)})
    assert peers.contradictions("t/t", None, [first, second]) == [
        "CONTRADICTION about t/t: a: holds; b: fails"
    ]
    assert peers.contradictions(
        "t/t", {"refuted": []}, [first, silent]
    ) and not peers.contradictions("t/t", {"certified": []}, [first, silent])
