"""The benchmark's questions are the paper's, its methods enclose the truth, a wrong closed form is
noticed, and bad input is told in one line.
"""

from __future__ import annotations

import dataclasses
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest
import sympy

from juggleproof import symbolic
from juggleproof.benchmarks.bench import child, run, table
from juggleproof.benchmarks.bench import methods as methods_ours
from juggleproof.benchmarks.bench.answers import (
    Answer,
    BoundQuestion,
    GaveUp,
    MeasuredAnswer,
    Strayed,
    best_point,
)
from juggleproof.benchmarks.bench.methods import (
    METHODS,
    ORBITS,
    Method,
    bernstein,
)
from juggleproof.benchmarks.bench.numerics import Arb, Intervals, Mpmath, never_negative
from juggleproof.benchmarks.bench.orbits import STARTS
from juggleproof.benchmarks.bench.questions import (
    ALPHAS,
    balls,
    kept_curve,
    outside_region,
    p,
    put,
    q,
    questions,
    s,
)
from juggleproof.benchmarks.bench.run import measure
from juggleproof.benchmarks.bench.solvers import goal
from juggleproof.certificates import checker
from juggleproof.command.main import run as command
from juggleproof.statements.language import ClaimError
from juggleproof.symbolic.algebra import alpha, r, w, x
from tests.rows import each_row

WIDTH, COARSE = Fraction(1, 1000), Fraction(1, 10)
NAMES = ("E-B1plus", "E-B1zero", "DE-H", "DE-outside-R", "p-outside-R")
CERTIFYING = [name for name, method in METHODS.items() if method.worth != "no proof"]
QUICKLY = {
    "coq": ("p-outside-R",),
    "qepcad": ("p-outside-R",),
    "mpmath": ("E-B1plus", "E-B1zero", "DE-H", "p-outside-R"),
}
U = sympy.Symbol("U")


def truth(name: str) -> Fraction:
    return questions()[name].truth() * questions()[name].sign


@pytest.mark.parametrize(
    "method, name", [(method, name) for method in CERTIFYING for name in QUICKLY.get(method, NAMES)]
)
def test_every_enclosure_contains_the_closed_form_holds(method: str, name: str) -> None:
    if not METHODS[method].needs.present():
        pytest.skip(f"absent: {METHODS[method].needs.package}")
    answer = METHODS[method].solve(questions()[name].problem(), WIDTH)
    assert answer.low <= truth(name) <= answer.high <= answer.low + WIDTH


def test_every_question_is_asked_here_holds() -> None:
    assert NAMES == tuple(questions())  # which derives them


@each_row("name", NAMES)
def test_floating_point_comes_near_from_below_holds(name: str) -> None:
    value = METHODS["sampling"].solve(questions()[name].problem(), WIDTH)
    assert value.high is None and truth(name) - Fraction(1, 2) < value.low <= truth(
        name
    ) + Fraction(1, 10**12)
    assert best_point(questions()[name].problem(), Fraction(1, 10**12))[1] >= truth(
        name
    ) - Fraction(1, 10**12)


@each_row("count", [1, 4, 7])
def test_a_point_is_found_in_many_variables_holds(count: int) -> None:
    problem, truth = balls(count)
    assert truth - Fraction(1, 10**12) <= best_point(problem, Fraction(1, 10**12))[1] <= truth


def test_our_method_loads_without_numpy_holds() -> None:
    """What it loads counts as part of its first answer."""
    script = (
        "import sys, juggleproof.benchmarks.bench.child, juggleproof.benchmarks.bench.methods\n"
        "print({'numpy',"
        " 'sympy', 'z3', 'flint'} & {*sys.modules})"
    )
    assert (
        subprocess.run(
            [sys.executable, "-c", script], capture_output=True, text=True, check=True
        ).stdout
        == "set()\n"
    )


@each_row("name", NAMES)
@each_row("more", [Fraction(0), Fraction(1, 10**6)])
def test_the_closed_form_is_the_bound_of_set_and_box_holds(name: str, more: Fraction) -> None:
    problem = questions()[name].problem()
    for text, holds in (
        (problem.of_set(truth(name) + more), True),
        (problem.of_set(truth(name) - Fraction(1, 10**6)), False),
        (problem.of_box(truth(name) - 1, truth(name) + more), True),
        (problem.of_box(truth(name) - 1, truth(name) - Fraction(1, 10**6)), False),
    ):
        from juggleproof.benchmarks.classes.classes import Made
        from juggleproof.benchmarks.classes.measuring import z3
        from juggleproof.votes.questions import read_statement
        from juggleproof.votes.smtlib import script

        answer = z3()(Made("", name, "", script(read_statement(text))))()
        assert answer.word == ("unsat" if holds else "sat")


def test_ours_rests_on_the_checker_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checker, "check_one", lambda *given: ("rejected", "on purpose"))
    with pytest.raises(ArithmeticError, match="on purpose"):
        bernstein(questions()["DE-H"].problem(), WIDTH)


@pytest.mark.parametrize("name", NAMES)
def test_rejects_a_value_that_no_point_has(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    point, low = best_point(questions()[name].problem(), WIDTH)
    monkeypatch.setattr(methods_ours, "best_point", lambda *given: (point, low + WIDTH / 10**6))
    with pytest.raises(ArithmeticError, match="rejected nothing false is assumed"):
        bernstein(questions()[name].problem(), WIDTH)


@pytest.mark.parametrize("name", NAMES)
def test_rejects_a_bound_that_is_exceeded(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    point, low = best_point(questions()[name].problem(), WIDTH)
    monkeypatch.setattr(methods_ours, "best_point", lambda *given: (point, low - COARSE))
    monkeypatch.setattr(methods_ours, "search_tree", lambda *given: ".")
    with pytest.raises(
        ArithmeticError, match="a Bernstein coefficient of a leaf has the wrong sign"
    ):
        bernstein(questions()[name].problem(), WIDTH)


@each_row("numbers", [Arb(), Mpmath()])
def test_rejects_a_bound_below_the_supremum_by_boxes(numbers: Intervals) -> None:
    for name in ("E-B1zero", "p-outside-R", "DE-H"):
        problem = questions()[name].problem()
        assert (
            never_negative(problem.excess(truth(name) - Fraction(1, 100)), problem.box, numbers)
            is None
        )
        assert never_negative(problem.excess(truth(name) + COARSE), problem.box, numbers)


def test_the_curve_bounds_the_states_that_keep_energy_holds() -> None:
    """B1+ is 0 <= x < the curve's height, and the curve lies in B1: change falls with x, and is 0
    on the curve, which runs from 0 to x = 0 again.
    """
    change, (height, speed) = symbolic.normal_energy_change(), kept_curve()
    assert (
        put(change, height, speed) == 0
        and sympy.expand(sympy.diff(change, x) + 2 * (alpha + 1)) == 0
    )
    assert [height.subs(p, 0), speed.subs(p, 0), height.subs(p, 1)] == [0, 0, 0]
    assert sympy.cancel(height / (p * (1 - p)) - 1 / (1 - alpha)) == 0
    assert sympy.cancel(put(w - x, height, speed) / p - (1 + p) / (1 - alpha)) == 0
    assert sympy.cancel(speed / p - 2 / (1 - alpha)) == 0


def test_the_states_outside_the_region_are_reached_holds() -> None:
    """With U^2 = 2 E and w = U - 1 + 2 q, x = (1 - q)(U - 1 + q) and w - x = q (U + q): for U > 1,
    x >= 0 and w > x mean 0 < q <= 1.
    """
    speed = U - 1 + 2 * q
    height = (1 - q) * (U - 1 + q)
    assert sympy.expand(put(symbolic.normal_energy(), height, speed) - U**2 / 2) == 0
    assert sympy.expand(speed - height - q * (U + q)) == 0
    edge = 2 * symbolic.region_energy() / r**2
    found_x, found_w = outside_region()
    at_edge = sympy.cancel((found_w + 1 - 2 * q) * p)
    assert sympy.cancel(at_edge**2 - edge.subs(alpha, s**2 / 2 - 1)) == 0
    assert (
        sympy.cancel(found_w - speed.subs(U, at_edge / p)) == 0
        and sympy.cancel(found_x - height.subs(U, at_edge / p)) == 0
    )
    assert all(
        at_edge.subs(s, sympy.sqrt(2 * (1 + sympy.Rational(a.numerator, a.denominator)))) > 1
        for a in ALPHAS
    )


def test_a_wrong_closed_form_is_noticed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    question = questions()["p-outside-R"]
    wrong = dataclasses.replace(question, closed_form=question.closed_form + sympy.Rational(1, 100))
    monkeypatch.setattr(run, "questions", lambda: {"p-outside-R": wrong})
    monkeypatch.setattr(run, "METHODS", {"bernstein": METHODS["bernstein"]})
    assert (
        run.BenchRun(
            run.Wish(("p-outside-R",), (Fraction(1, 1000),), 60.0, False),
            tmp_path,
            lambda what: None,
        ).all()
        == 1
    )
    assert "WRONG: exact Bernstein, ours at 1e-3 does not enclose" in capsys.readouterr().out


def test_a_bound_that_the_exact_orbit_breaks_is_noticed() -> None:
    assert Strayed(Fraction(2), Fraction(1), beyond=True).wrong(Fraction(0)) and not Strayed(
        Fraction(1), Fraction(1)
    ).wrong(Fraction(0))
    assert not Answer(Fraction(1), None).wrong(Fraction(5)) and Answer(
        Fraction(1), Fraction(2)
    ).wrong(Fraction(5))


@each_row("arithmetic", ORBITS)
@each_row("steps", [1, 1000])
def test_orbits_stay_within_their_bounds_holds(arithmetic: str, steps: int) -> None:
    found = ORBITS[arithmetic].solve(STARTS["orbit"], Fraction(steps))()
    assert not found.beyond and found.distance < Fraction(1, 10**12)


def test_floats_stray_where_the_others_do_not_holds() -> None:
    start, steps = STARTS["orbit-edge"], Fraction(50)
    assert (
        ORBITS["floats"].solve(start, steps)().distance
        > 1
        > 10**20 * ORBITS["enclosed"].solve(start, steps)().error(Fraction(0))
    )
    with pytest.raises(GaveUp, match="undecided"):
        ORBITS["fast"].solve(start, steps)


@each_row("count", [1, 2])
def test_the_sum_over_balls_has_its_closed_form_holds(count: int) -> None:
    problem, expected = balls(count)
    for name in ("bernstein", "arb", "z3-once"):
        answer = METHODS[name].solve(problem, COARSE)
        assert answer.low <= expected <= answer.high <= answer.low + COARSE


def test_coq_is_asked_for_the_excess_on_the_box() -> None:
    box = ((Fraction(-1, 2), Fraction(3)), (Fraction(0), Fraction(1)))
    problem = BoundQuestion(
        "t", ("a", "b"), box, {(1, 0): Fraction(1)}, {(0, 1): Fraction(2)}, 1, "", ""
    )
    assert (
        "Goal forall v0 v1 : R, -1/2 <= v0 <= 3/1 -> 0/1 <= v1 <= 1/1 -> 0 <= v1*(6/1) + v0*(-1/1)."
        in goal(problem, Fraction(3))
    )


@pytest.mark.exhaust
def test_a_method_that_gives_up_is_ended_and_shown() -> None:
    began = time.monotonic()
    found = measure(
        METHODS["sampling"], questions()["DE-outside-R"].problem(), Fraction(1, 10**12), 0.1
    )
    assert (
        found.answer is None
        and found.reason.startswith("gave up")
        and time.monotonic() - began < 60
    )
    own = {"sampling": {found.size: found}}
    assert "gave up" in table.measured([METHODS["sampling"]], [found.size], own, Fraction(0))
    assert table.faults([METHODS["sampling"]], own)[0].startswith(
        "float sampling at 1e-12: gave up"
    )


@pytest.mark.parametrize("present", [True, False])
def test_rejects_a_run_that_measures_nothing(
    present: bool,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    needs = methods_ours.Needs("numba", lambda: present)
    method = dataclasses.replace(methods_ours.BLOCKS["blocks"], needs=needs)
    asked = run.COSTS["part"]._replace(methods={"blocks": method})
    monkeypatch.setitem(run.COSTS, "part", asked)
    monkeypatch.setattr(
        run,
        "measure",
        lambda method, work, size, _: MeasuredAnswer(method.name, size, reason="gave up"),
    )
    wish = run.Wish(("part",), (), 1.0, False)
    assert run.BenchRun(wish, tmp_path, lambda what: None).all() == 1
    assert "nothing was measured" in capsys.readouterr().out
    assert not list(tmp_path.iterdir())


def test_what_is_kept_is_made_before_anything_is_measured_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    done = list[str]()
    method = dataclasses.replace(
        METHODS["sampling"],
        prepare=lambda: done.append("prepared"),
        solve=lambda work, size: done.append("solved"),
    )
    monkeypatch.setattr(child, "METHODS", {"sampling": method})
    monkeypatch.setattr(child, "allow", lambda seconds: None)
    monkeypatch.setattr(child.signal, "signal", lambda *given: None)
    monkeypatch.setattr(child.resource, "setrlimit", lambda *given: None)
    monkeypatch.setattr(child.pickle, "load", lambda file: None)
    monkeypatch.setattr(sys, "argv", ["child", "sampling", "1/10", "0.01"])
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=None))
    assert child.measured().cold is not None
    assert done[0] == "prepared" and set(done[1:]) == {"solved"}


def test_the_aim_is_judged_by_the_ratios_of_the_run() -> None:
    methods = [METHODS[name] for name in ("bernstein", "arb", "cvc5-proof", "z3")]
    answer, sizes = Answer(Fraction(0), Fraction(0)), [COARSE, WIDTH]
    found = [MeasuredAnswer("bernstein", size, 0.5, 0.001, answer) for size in sizes]
    found += [
        MeasuredAnswer("cvc5-proof", COARSE, 5.0, 0.02, answer),
        MeasuredAnswer("cvc5-proof", WIDTH, 5.0, 0.005, answer),
    ]
    found += [
        MeasuredAnswer("arb", COARSE, 0.4, 0.001, answer),
        MeasuredAnswer("z3", COARSE, reason="gave up"),
    ]  # Arb's boxes are our own
    lines = [
        one.line() for one in table.judged("DE-H", methods, sizes, table.by_method(found), 10.0)
    ]
    peers = "every certified peer (cvc5, one question with its proof)"
    assert (
        lines[0]
        == f"warm: 10 times faster than {peers}: NOT met, at 1 of 2 widths; least 5 times, DE-H at"
        f" 1e-3, by {METHODS['cvc5-proof'].title}"
    )
    assert lines[1].startswith(
        "warm: faster than Z3, bisection: met, at 2 of 2 widths; least 10000 times"
    )
    assert lines[2].startswith(f"cold: 10 times faster than {peers}: met, at 2 of 2 widths")
    both = table.together(table.judged("DE-H", methods, sizes, table.by_method(found), 10.0) * 2)
    assert both[0].line() == lines[0].replace("1 of 2", "2 of 4")


@pytest.mark.exhaust
def test_a_quick_run_ends_with_table_plot_and_verdict_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert (
        command(
            [
                "bench",
                "--quick",
                "--question",
                "p-outside-R",
                "--seconds",
                "60",
                "-o",
                str(tmp_path / "bench"),
            ]
        )
        == 0
    )
    output = capsys.readouterr().out
    assert (
        "exact Bernstein, ours" in output
        and "every enclosure holds the truth" in output
        and "faster than Z3, one question" in output
    )
    assert (
        "no certified peer was measured" in output
        and "faster than every certified peer" not in output
    )
    assert "1e-1" in output and "1e-6" in output and "slope" in output
    from juggleproof.benchmarks.figures import ABSENT, can_plot

    assert (
        (tmp_path / "bench" / "p-outside-R.svg").read_bytes().startswith(b"<?xml")
        if can_plot()
        else ABSENT in output
    )


def test_absent_peers_are_named_holds(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    absent: dict[str, Method] = {
        name: dataclasses.replace(
            METHODS[name], needs=METHODS[name].needs._replace(present=lambda: False)
        )
        for name in ("cvc5", "coq")
    }
    monkeypatch.setattr(run, "METHODS", absent)
    run.BenchRun(
        run.Wish(("p-outside-R",), (COARSE,), 1.0, False), tmp_path, lambda what: None
    ).all()
    output = capsys.readouterr().out
    assert (
        "absent: cvc5 (pip install cvc5), coq-interval (Debian packages coq and libcoq-interval)"
        in output
    )


BAD = {
    "an unknown question": (["--question", "magic"], "no such question"),
    "a width that is none": (
        ["--widths", "1e-1,abc"],
        "'abc': a width is a number from 1e-40 to 1",
    ),
    "a width of 0": (["--widths", "0"], "a width is a number"),
    "a width above 1": (["--widths", "2"], "a width is a number"),
    "a width divided by 0": (["--widths", "1/0"], "a width is a number"),
    "a width of no number": (["--widths", "nan"], "a width is a number"),
    "an empty width": (["--widths", "1e-1,"], "a width is a number"),
    "no width": (["--widths", ""], "a width is a number"),
    "no number of seconds": (["--seconds", ""], "a limit is a number of seconds"),
    "no seconds": (["--seconds", "0"], "a limit is a number of seconds"),
    "seconds that are none": (["--seconds", "inf"], "a limit is a number of seconds"),
    "a folder that is a file": (["-o", __file__], "cannot be written"),
}


@pytest.mark.parametrize("defect", BAD)
def test_rejects(defect: str, capsys: pytest.CaptureFixture[str]) -> None:
    arguments, reason = BAD[defect]
    assert command(["bench", *arguments]) == 2
    output = capsys.readouterr()
    assert reason in output.err and len(output.err.strip().splitlines()) == 1 and not output.out


def test_rejects_a_question_that_is_not_rational() -> None:
    from juggleproof.benchmarks.bench.questions import fraction

    with pytest.raises(ClaimError, match="not rational"):
        fraction(sympy.sqrt(2))
