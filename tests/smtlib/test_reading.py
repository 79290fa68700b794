"""What the reader of SMT-LIB accepts, as the statement that it becomes, and what it refuses, in one
line that names file, line and mend.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from juggleproof.smtlib.script import problems_of_file, read_problems
from juggleproof.smtlib.statements import statement_of
from juggleproof.statements.language import ClaimError, real
from tests.rows import each_row

XY = "(declare-const x Real)(declare-fun y () Real)"
B = "(declare-const b Bool)"

ACCEPTED = [
    ("(assert (> x 0.5))", "x > 1/2"),
    ("(assert (>= (/ 1 3) x))", "1/3 >= x"),
    ("(assert (= x (- 3)))", "x = -3"),
    ("(assert (< x y 2))", "x < y and y < 2"),
    ("(assert (> (- x y 1) (+ x y 1)))", "x - y - 1 > x + y + 1"),
    ("(assert (> (- x) (* 2 x y)))", "-x > 2*x*y"),
    ("(assert (= (^ x 3) (/ y 2)))", "x^3 = y/2"),
    ("(assert (distinct x y 1))", "y != x and 1 != x and 1 != y"),
    ("(assert (=> (> x 0) (> y 0) (> x y)))", "implies(x > 0, implies(y > 0, x > y))"),
    ("(assert (xor (> x 0) (> y 0)))", "iff(x > 0, not y > 0)"),
    ("(assert (= (> x 0) (> y 0)))", "iff(x > 0, y > 0)"),
    ("(assert (or (not (= x y)) (and (< x 1) true)))", "not x = y or x < 1"),
    ("(assert (ite (> x 0) (> y 1) (< y 1)))", "x > 0 and y > 1 or not x > 0 and y < 1"),
    ("(assert (> (ite (> x 0) x (- x)) 1))", "x > 0 and x > 1 or not x > 0 and -x > 1"),
    ("(assert (let ((x y) (y x)) (> x (* 2 y))))", "y > 2*x"),
    ("(assert (let ((z (+ x 1))) (let ((z (* z z))) (> z 0))))", "(x + 1)*(x + 1) > 0"),
    (
        "(define-fun sq ((t Real)) Real (* t t))(assert (< (sq (+ x 1)) (sq y)))",
        "(x + 1)*(x + 1) < y*y",
    ),
    ("(define-fun pos ((x Real)) Bool (> x 0))(assert (pos y))", "y > 0"),
    ("(define-const c Real 2.50)(assert (> x c))", "x > 5/2"),
    ("(define-fun c () Real 2)(assert (> x c))", "x > 2"),
    ("(assert (! (> x 0) :named positive))", "x > 0"),
    ("(push 1)(assert (> x 9))(pop 1)(assert (> x 1))", "x > 1"),
    (
        (
            "(set-info :source |it; is ) so|)(set-option :produce-models true)(assert (> x 0)) ;"
            " (assert (< x 0))\n"
        ),
        "x > 0",
    ),
    (f"{B}(assert (and b (> x 0)))", "b > 0 and x > 0"),
    ("(assert (> (ite (> x 0) 1 0) (ite (> x 0) 0 1)))", "x > 0 and 1 > 0 or not x > 0 and 0 > 1"),
    (
        "(declare-const |a b'| Real)(declare-const lambda Real)(assert (> |a b'| lambda))",
        "a_b_ > lambda_",
    ),
    ("(declare-const |x| Bool)", None),
]


@each_row("body, shown", ACCEPTED)
def test_a_script_is_read_as_this_statement_holds(body: str, shown: str | None) -> None:
    if shown is None:
        with pytest.raises(ClaimError, match="x is declared already"):
            read_problems(f"{XY}{body}(check-sat)", "f")
        return
    (problem,) = read_problems(
        f"(set-logic QF_NRA){XY}{body}(check-sat)(get-model)(exit)(nonsense)", "f"
    )
    text = statement_of(problem, "f/check").text()
    assert (
        text.splitlines()[-1]
        == f"show not {shown if ' and ' not in shown and ' or ' not in shown else f'({shown})'}"
    )


DIVISIONS = [
    ("(assert (> x 0))(assert (< (/ 1 x) y))", ["given x > 0", "show not 1/x < y"]),
    (
        "(assert (not (= x y)))(assert (< (/ 1 (- x y)) 1))",
        ["given not x = y", "show not 1/(x - y) < 1"],
    ),
    ("(assert (< (/ y (+ 1 (* x x))) 1))", ["have 1 + x*x > 0", "show not y/(1 + x*x) < 1"]),
    (
        "(assert (< x (- 1)))(assert (< (/ y (* 2 x)) 1))",
        ["given x < -1", "have 2*x < 0", "show not y/(2*x) < 1"],
    ),
    (
        "(assert (and (> x 1) (< (/ 1 (- 1 (/ 1 x))) y)))",
        ["given x > 1", "have x > 0", "show not 1/(1 - 1/x) < y"],
    ),
    (
        "(assert (not (=> (and (> x 0) (> y 0)) (>= (+ (/ x y) (/ y x)) 2))))",
        ["given x > 0", "given y > 0", "show x/y + y/x >= 2"],
    ),
    ("(assert (not (or (<= x 0) (not (> y (/ 1 x))))))", ["given not x <= 0", "show not y > 1/x"]),
    (
        "(assert (= (/ x y) (/ x y)))",
        ["show not (implies(y != 0, quotient*y = x) and quotient = quotient)"],
    ),
    (
        "(assert (< (/ x 0) (/ y 0)))",
        [
            "show not (implies(0 != 0, quotient*0 = x) and implies(0 != 0, quotient_2*0 = y) and"
            " implies(0 = 0 and y = x, quotient_2 = quotient) and quotient < quotient_2)"
        ],
    ),
    (
        "(assert (> (/ 1 (/ 1 x)) 0))",
        [
            "show not (implies(x != 0, quotient*x = 1) and"
            " implies(quotient != 0, quotient_2*quotient = 1) and"
            " implies(quotient = 0 and x = 0 and 1 = 1, quotient_2 = quotient) and quotient_2 > 0)"
        ],
    ),
]


@each_row("body, rows", DIVISIONS)
def test_what_keeps_a_divisor_from_zero_stands_before_it_holds(body: str, rows: list[str]) -> None:
    (problem,) = read_problems(f"{XY}{body}(check-sat)", "f")
    assert statement_of(problem, "f/check").text().splitlines()[2:] == rows


REJECTED = [
    ("(assert (> z 0))", 2, "z is not declared"),
    ("\n\n(assert (> x 0)", 4, "opened and never closed"),
    ("(assert (> x 0)))", 2, "closed that was not opened"),
    ("(assert (> (sin x) 0))", 2, "sin is not polynomial"),
    ("(assert (> x -4))", 2, "-4 is a symbol; write (- 4)"),
    ("(assert (> (div x 2) 0))", 2, "div: an unknown function"),
    ("(assert (forall ((z Real)) (> z x)))", 2, "quantifiers"),
    ("(assert x)", 2, "x is a Real where a Bool is expected"),
    ("(assert (> (> x 0) 0))", 2, "compares a Bool"),
    ("(assert (= x (> y 0)))", 2, "compares a Bool with a Real"),
    ("(assert (+ x 1))", 2, "is a Real where a Bool is expected"),
    ("(assert (and x (> y 0)))", 2, "x is a Real where a Bool is expected"),
    ("(assert (> x))", 2, "> takes at least 2 arguments, not 1"),
    ("(assert (not (> x 0) (> y 0)))", 2, "not takes 1 argument, not 2"),
    ("(assert (ite (> x 0) (> y 0)))", 2, "ite takes 3 arguments, not 2"),
    ("(assert (ite (> x 0) x (> y 0)))", 2, "ite between a Bool and a Real"),
    ("(assert (> (^ x y) 0))", 2, "the exponent is no numeral"),
    ("(assert (> (^ x (- 1)) 0))", 2, "the exponent is no numeral"),
    ("(assert (> (^ x 101) 0))", 2, "the exponent is no numeral"),
    (f"(assert (> x {'9' * 6000}))", 2, "a number of 6000 signs; at most 1000 are read"),
    ("(assert (> |x\ny| 0))", 2, "x y is not declared"),
    ("(assert (> x #b01))", 2, "is no part of SMT-LIB"),
    ("(assert (> x 01))", 2, "is no part of SMT-LIB"),
    ("(assert (> x 1e3))", 2, "is no part of SMT-LIB"),
    ('(assert (> x "one"))', 2, '"one" where a term is expected'),
    ("(assert)", 2, "assert takes 1 arguments, not 0"),
    ("(assert ())", 2, "() where a term is expected"),
    ("(assert ((x) 1))", 2, "is not the name of a function"),
    ("(assert (x 1))", 2, "x is no function"),
    ("(define-fun f ((t Real)) Real (* t s))", 2, "s is not declared"),
    ("(define-fun f ((t Real)) Real (> t 0))", 2, "is a Bool where a Real is expected"),
    ("(define-fun f ((t Real) (t Real)) Real t)", 2, "t is bound twice"),
    ("(define-fun f ((t Real)) Real t)(assert (> (f x y) 0))", 2, "takes 1 argument, not 2"),
    ("(define-fun f ((t Real)) Real t)(assert (> f 0))", 2, "takes 1 argument, not 0"),
    ("(define-fun f ((t Real)) Real (f t))", 2, "f: an unknown function"),
    ("(assert (let ((z 1) (z 2)) (> x z)))", 2, "z is bound twice"),
    ("(assert (let (z 1) (> x z)))", 2, "not a name with what belongs to it"),
    ("(declare-const n Int)", 2, "the sort Int is not taken on"),
    ("(declare-const x Real)", 2, "x is declared already"),
    ("(declare-const and Real)", 2, "and is declared already, or is reserved"),
    ("(declare-fun f (Real) Real)", 2, "uninterpreted functions are not taken on"),
    ("(declare-sort S 0)", 2, "declare-sort: an unknown command"),
    ("(set-logic 5)", 2, "5 names no logic"),
    ("(set-option :global-declarations yes)", 2, ":global-declarations is true or false"),
    ("(check-sat-assuming x)", 2, "x is no list"),
    ("(check-sat-assuming ((+ x 1)))", 2, "is a Real where a Bool is expected"),
    ("(set-info :status maybe)", 2, "the status maybe is none"),
    ("(pop 1)", 2, "(pop 1) without that many (push)"),
    ("(pop x)", 2, "x is no number of levels"),
    ("(push 1)(declare-const z Real)(pop 1)(assert (> z 0))", 2, "z is not declared"),
    ("(reset)(assert (> x 0))", 2, "x is not declared"),
    ("assert", 2, "assert is no command"),
    (
        "(define-fun a0 () Real (+ x y))"
        + "".join(f"(define-fun a{k} () Real (* a{k - 1} a{k - 1}))" for k in range(1, 30)),
        2,
        "a degree over 1000",
    ),
]


@each_row("body, line, told", REJECTED)
def test_rejects_what_is_not_understood_in_one_line(body: str, line: int, told: str) -> None:
    with pytest.raises(ClaimError) as caught:
        for problem in read_problems(f"{XY}\n{body}\n(check-sat)", "bad.smt2"):
            statement_of(problem, "bad/check")
    message = str(caught.value)
    assert (
        message.startswith(f"bad.smt2:{line}: ")
        and told in message
        and "; " in message
        and "\n" not in message
    ), message


def test_rejects_a_script_without_check_sat_and_a_file_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(ClaimError, match=r"no \(check-sat\)"):
        read_problems(XY, "f")
    with pytest.raises(ClaimError, match="no such file"):
        problems_of_file(tmp_path / "absent.smt2")
    (tmp_path / "bytes.smt2").write_bytes(b"\xff\xfe(")
    with pytest.raises(ClaimError, match="cannot be read"):
        problems_of_file(tmp_path / "bytes.smt2")


def test_every_check_sat_has_the_assertions_and_the_status_of_its_place_holds() -> None:
    text = (
        "(declare-const x Real)(set-info :status sat)(assert (> x 0))(check-sat)\n(push)(set-info"
        " :status unsat)(assert (< x"
        " 0))(check-sat)\n(pop)(check-sat)(reset-assertions)(declare-const x Real)(assert (= x"
        " 7))(check-sat)(exit)(check-sat)"
    )
    found = [
        (problem.line, problem.status, [str(formula) for _, formula in problem.assertions])
        for problem in read_problems(text, "f")
    ]
    assert found == [
        (1, "sat", ["x > 0"]),
        (2, "unsat", ["x > 0", "x < 0"]),
        (3, "", ["x > 0"]),
        (3, "", ["x = 7"]),
    ]


def test_a_name_and_a_status_are_of_the_next_problem_and_a_source_of_all_that_follow_holds() -> (
    None
):
    text = (
        "(set-info :name first)(set-info :source |a; book|)(set-info :status sat)(check-sat)"
        '(push 1)(set-info :name "the second")(check-sat)(pop 1)(check-sat)'
        "(set-info :name lost)(set-info :status sat)(reset)(check-sat)"
    )
    assert [(one.name, one.source, one.status) for one in read_problems(text, "f")] == [
        ("first", "a; book", "sat"),
        ("the second", "a; book", ""),
        ("", "a; book", ""),
        ("", "", ""),
    ]


def test_a_script_of_one_problem_holds_what_is_in_force_at_its_check_sat_holds() -> None:
    text = (
        "(set-logic QF_NRA)(declare-const |a b| Real)(define-fun |f(| ((t Real)) Real (* t t))"
        "(push 1)(assert (> |a b| 1))(check-sat)(pop 1)(push 1)(declare-const b Bool)"
        "(assert (! (=> b (< (|f(| |a b|) 2.50)) :named |n 1|))(push)(assert b)(pop)(check-sat)"
    )
    first, second = read_problems(text, "f")
    assert second.script.splitlines() == [
        "(set-logic QF_NRA)",
        "(declare-const |a b| Real)",
        "(define-fun |f(| ((t Real)) Real (* t t))",
        "(declare-const b Bool)",
        "(assert (! (=> b (< (|f(| |a b|) 2.50)) :named |n 1|))",
        "(check-sat)",
    ]
    for one in (first, second):
        (alone,) = read_problems(one.script, "alone")
        assert alone.variables == one.variables and alone.commands != ()
        assert [said for _, said in alone.assertions] == [said for _, said in one.assertions]


def test_names_that_two_symbols_would_share_are_kept_apart_holds() -> None:
    (problem,) = read_problems(
        "(declare-const |a b| Real)(declare-const a_b Real)(assert (> |a b| a_b))(check-sat)", "f"
    )
    assert [variable.name for variable in problem.variables] == ["a_b", "a_b_2"]
    assert statement_of(problem, "f/check").text().splitlines()[1:] == [
        "forall a_b a_b_2",
        "show not a_b > a_b_2",
    ]


def test_variables_named_like_those_of_the_paper_keep_their_names_holds() -> None:
    names = ("alpha", "r", "g")
    declared = "".join(f"(declare-const {name} Real)" for name in names)
    (problem,) = read_problems(f"{declared}(assert (< alpha r g))(check-sat)", "f")
    assert tuple(variable.name for variable in problem.variables) == names


ASSUMED = """(set-logic ALL)(set-option :global-declarations true)(declare-const x Real)
(push 1)(define-fun square () Real (* x x))(assert (= square 2))(check-sat)(pop 1)
(check-sat-assuming ((< square 0) (not (> x 1))))
(reset-assertions)(assert (> square 0))(check-sat)
"""


def test_what_is_assumed_holds_for_one_question_and_global_names_outlive_their_scope_holds() -> (
    None
):
    problems = read_problems(ASSUMED, "f")
    assert [[str(said) for _, said in one.assertions] for one in problems] == [
        ["x*x = 2"],
        ["x*x < 0", "not x > 1"],
        ["x*x > 0"],
    ]
    for one in problems:
        (alone,) = read_problems(one.script, "alone")
        assert [said for _, said in alone.assertions] == [said for _, said in one.assertions]


@each_row("name", ["ALL", "NRA", "LRA", "QF_UFNRA", "QF_NIRA"])
def test_the_content_of_a_script_is_read_whatever_its_logic_is_called_holds(name: str) -> None:
    (problem,) = read_problems(f"(set-logic {name}){XY}(assert (> x y))(check-sat)", "f")
    assert problem.assertions == ((1, real("x") > real("y")),)
