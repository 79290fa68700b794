"""Each route says what is true of true and false statements, where its program is there; what is
wrong ends the run with 1, and work ends when its CPU seconds are used up.
"""

from __future__ import annotations

import doctest
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from juggleproof.benchmarks import processes
from juggleproof.benchmarks.peers import __main__ as peers
from juggleproof.benchmarks.peers import notation, routes, table
from juggleproof.benchmarks.peers.routes import Answer, Problem, Result, Route
from juggleproof.benchmarks.processes import children_seconds, each, output_of
from juggleproof.coq_store import share_of
from juggleproof.statements.store import DEFAULT, Store, write_store
from juggleproof.votes.questions import questions, read_statement
from tests.rows import each_row
from tests.votes.corpus import FALSE, TRUE

SECONDS = 60.0  # of CPU, far more than any of them takes
HOLD = ("square", "f1-in-H", "e1-in-B1", "collision-time", "B1-plus-not-empty", "sup-negative")
FAIL = ("strict-square", "B2-by-time", "circle-half", "p-outside-R-whole", "some-state-gains-more")
LINEAR = ("f1-in-H", "collision-time", "gain-identity")
ROUTES = {route.title: route for route in routes.routes()}


def problem(name: str) -> Problem:
    text = TRUE.get(name) or FALSE[name]
    statement = read_statement(text)
    return Problem(statement.name, text, statement, {}, "", "holds" if name in TRUE else "fails")


def words(title: str, names: Sequence[str]) -> list[Answer]:
    """The answers of a route to statements of the corpus, in order."""
    if not ROUTES[title].present:
        pytest.skip(f"{ROUTES[title].package} is absent")
    asked = [problem(name) for name in names]
    results = {one.name: one.answer for one in ROUTES[title].run(asked, SECONDS)}
    return [results[one.name] for one in asked]


@each_row(
    "title",
    [
        "ours, search and check",
        "Z3, unchecked",
        "cvc5, unchecked",
        "cvc5 with its proof",
        "QEPCAD B",
    ],
)
def test_a_route_gives_the_right_answers_holds(title: str) -> None:
    answers = [answer.word for answer in words(title, [*HOLD, *FAIL])]
    assert answers == ["holds"] * len(HOLD) + ["fails"] * len(FAIL)


def test_nra_proves_what_is_true_and_nothing_false_holds() -> None:
    names = [LINEAR[0], "strict-square", LINEAR[1], "circle-half", LINEAR[2]]
    answers = [answer.word for answer in words("Coq's nra, or psatz", names)]
    assert answers == ["holds", "gave up", "holds", "gave up", "holds"]


@each_row(
    "title, name, why",
    [
        ("QEPCAD B", "flight-count", "integers"),
        ("Coq's nra, or psatz", "flight-count", "integers"),
        ("Coq's nra, or psatz", "B1-plus-not-empty", "quantifiers"),
    ],
)
def test_what_a_route_has_no_words_for_is_not_taken_holds(title: str, name: str, why: str) -> None:
    assert words(title, [name]) == [("not taken", why)]


@each_row("module", [notation, routes])
def test_the_formats_are_those_of_the_examples_holds(module: object) -> None:
    result = doctest.testmod(module)  # type: ignore[arg-type]
    assert result.attempted and not result.failed


def test_disjunctions_and_fractions_are_written_for_nra_holds() -> None:
    statement = read_statement(
        "statement t/t\nforall x y\ngiven x/3 > 1 or y < -1/2\ngiven x*y != 0\nshow x^2 + y^2 > 1/4"
    )
    (text,) = [notation.goal(question) for question in questions(statement)]
    assert (
        text is not None
        and text.splitlines()[0]
        == "Goal forall v0 v1 : R, (v0 - 3 > 0 \\/ - 2*v1 - 1 > 0) -> (v0*v1 < 0 \\/ v0*v1 > 0) ->"
        " - 4*v0*v0 - 4*v1*v1 + 1 >= 0 -> False."
    )


# -------------------------------------------------------------------------------------------------
# The whole run, on few statements.


SHARE = 420


@pytest.fixture
def few(tmp_path: Path) -> Path:
    """A store of one statement in so many of the paper's, and of some beside this share; but for
    the rules on orbits that name another statement than these.
    """
    whole = Store(DEFAULT)
    names = {*share_of(whole.texts, SHARE), *list(whole.texts)[:20]}
    others = whole.texts.keys() - names
    names = {name for name in names if others.isdisjoint(whole.texts[name].split())}
    texts = {name: text for name, text in whole.texts.items() if name in names}
    entries = {name: whole.certificate(name, text) for name, text in texts.items()}
    certificates = {name: entry for name, entry in entries.items() if entry is not None}
    write_store(tmp_path / "few", "\n\n".join(texts.values()), {"few": certificates})
    return tmp_path / "few"


@pytest.mark.exhaust
def test_a_share_of_the_store_is_decided_by_every_route_holds(
    tmp_path: Path, few: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(peers, "DEFAULT", few)
    file = tmp_path / "peers.svg"
    assert peers.main(["--share", str(SHARE), "--plot", str(file)]) == 0
    output = capsys.readouterr().out
    drawn = file.read_text(encoding="utf-8")
    for route in ROUTES.values():
        assert not route.present or f"\n{route.title}: {route.how}" in output
        assert route.present or route.package in output.split("absent: ")[1]
    ours, check = (
        row for row in output.splitlines() if row.startswith("ours, ") and "lines" in row
    )
    taken, decided = check.split()[3:5]
    assert int(taken) == int(decided) > 0 and ours.split()[6] == "0"
    assert "times ours, search and check" in output and "times ours, check alone" in output
    assert "every answer is what the checker says" in output and drawn.startswith("<?xml")


def saying(word: routes.Word, title: str = "a liar", present: bool = True) -> Route:
    """A route that says the same of every statement."""

    def run(asked: Sequence[Problem], seconds: float) -> Iterator[Result]:
        return (Result(one.name, Answer(word), 0.5) for one in asked)

    return Route(title, "nobody", "at once", run, present, f"{title}'s package")


def test_rejects_a_route_that_is_wrong(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    arguments = ["--plot", str(tmp_path / "peers.svg")]
    monkeypatch.setattr(peers, "problems", lambda store: [problem(name) for name in LINEAR])
    monkeypatch.setattr(peers, "routes", lambda: [saying("fails"), saying("holds", "c", False)])
    assert peers.main(arguments) == 1
    output = capsys.readouterr().out
    assert "WRONG: a liar says of " in output and "fails; the checker: holds" in output
    assert "absent: c's package" in output
    monkeypatch.setattr(peers, "routes", lambda: [saying("gave up")])
    assert peers.main(arguments) == 0


def test_rejects_a_route_that_leaves_a_statement_out() -> None:
    asked = [problem(name) for name in LINEAR]
    silent = replace(saying("holds"), run=lambda asked, seconds: iter(()))
    with pytest.raises(ChildProcessError, match="has not answered on every statement"):
        peers.measured(silent, asked, 1.0)


def test_ratios_are_over_what_both_decide_holds() -> None:
    def measured(title: str, seconds: dict[str, float]) -> table.Measured:
        results = {
            name: Result(name, Answer("holds" if took else "gave up"), took)
            for name, took in seconds.items()
        }
        return table.Measured(saying("holds", title), results, 0.0)

    ours = measured("ours", {"a": 1.0, "b": 2.0, "c": 3.0})
    peer = measured("peer", {"a": 2.0, "b": 2.0, "c": 0.0})
    assert table.ratios([ours, peer], ours).splitlines()[1].split() == ["peer", "2", "1.33", "1.5"]


# -------------------------------------------------------------------------------------------------
# CPU seconds.


def squares() -> Callable[[int], Callable[[], int]]:
    def square(number: int) -> int:
        while number == 2:
            pass
        return number**2

    return lambda number: lambda: square(number)


def test_work_that_uses_up_its_cpu_seconds_is_given_up_and_the_next_is_done_holds() -> None:
    before = children_seconds()
    done = list(each(squares, [1, 2, 3], 0.1))
    assert [one.answer for one in done] == [1, None, 9]
    spent = sum(one.seconds for one in done)
    assert 0.1 < spent <= children_seconds() - before < 10


def test_rejects_work_that_fails() -> None:
    with pytest.raises(ChildProcessError):
        list(each(lambda: lambda number: lambda: 1 // number, [1, 0], 1.0))


def test_a_program_that_uses_up_its_cpu_seconds_is_ended() -> None:
    before = children_seconds()
    assert output_of([sys.executable, "-c", "while True: pass"], "", 0.1) is None
    assert 0.1 < children_seconds() - before < 10
    assert output_of([sys.executable, "-c", "print(input())"], "text", 5.0) == "text\n"


def test_a_program_that_stands_still_is_ended_with_its_children(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(processes, "STALLED", 0.3)
    began = time.monotonic()
    program = "import subprocess, sys; subprocess.run(['sleep', '600'])"
    assert output_of([sys.executable, "-c", program], "", 0.3) is None
    assert time.monotonic() - began < 300
