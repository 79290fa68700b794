"""Scripts that are nested deep, or large when definitions are put in, are read and answered."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path

import pytest

from juggleproof.smtlib import limits
from juggleproof.smtlib.answering import answer, answer_files, question
from juggleproof.smtlib.script import Problem, read_problems
from juggleproof.smtlib.statements import statement_of
from juggleproof.statements.formulas import Formula, Term
from juggleproof.statements.language import Statement
from tests.rows import each_row
from tests.smtlib.evaluating import truth, value

XY = "(declare-const x Real)(declare-const y Real)"
MANY = 2000


def problem_of(body: str) -> Problem:
    (problem,) = read_problems(f"{XY}{body}(check-sat)", "f")
    return problem


def answered(body: str) -> str:
    return answer(question(problem_of(body), "f/check")).word


def nested(count: int, opening: str, inmost: str) -> str:
    return opening * count + inmost + ")" * count


def lets(count: int, step: str) -> str:
    return "".join(f"(let ((a{k + 1} {step.format(f'a{k}' if k else 'x')})) " for k in range(count))


def definitions(count: int, sort: str, first: str, step: str) -> str:
    parts = [first, *(step.replace("@", f"d{k}") for k in range(count))]
    return "".join(f"(define-fun d{k} () {sort} {part})" for k, part in enumerate(parts))


SIZES = {
    "sums": (f"(assert (> {nested(MANY, '(+ x ', '1')} {MANY + 1}))", "(assert (< x 1))"),
    "negations": (f"(assert {nested(MANY, '(not ', '(> (* x x) 2)')})", "(assert (< (* x x) 1))"),
    "lets": (
        f"(assert {lets(MANY, '(+ {} 1)')} (> a{MANY} (* 2 x)){')' * MANY})",
        f"(assert (> x {MANY}))",
    ),
    "alternations": (
        f"(assert {nested(100, '(and (> x 0) (or (> y 1) ', '(> y 2)')}" + ")" * 101,
        "(assert (< y 1))",
    ),
    "doubled sums": (
        definitions(100, "Real", "x", "(+ @ @)") + "(assert (> d100 1))",
        "(assert (< x 0))",
    ),
    "doubled formulas": (
        definitions(30, "Bool", "(> x 0)", "(and (or @ (> y 2)) (or @ (> x 1)))") + "(assert d30)",
        "(assert (< x 0))(assert (< y 1))",
    ),
    "doubled functions": (
        "(define-fun f0 ((u Real)) Real (+ u 1))"
        + "".join(f"(define-fun f{k + 1} ((u Real)) Real (f{k} (f{k} u)))" for k in range(10))
        + "(assert (> (f10 x) 1))",
        "(assert (< x (- 1024)))",
    ),
    "chains of ite": (
        definitions(20, "Real", "x", "(ite (> @ y) @ y)") + "(assert (> d20 x))",
        "(assert (< y x))",
    ),
    "exclusive or": (
        "".join(f"(declare-const b{k} Bool)" for k in range(16))
        + f"(assert (xor {' '.join(f'b{k}' for k in range(16))}))",
        "".join(f"(assert (not b{k}))" for k in range(16)),
    ),
}


@pytest.mark.exhaust
@each_row("kind", SIZES)
def test_what_is_large_is_answered_holds(kind: str) -> None:
    body, contrary = SIZES[kind]
    assert answered(body) == "sat"
    assert answered(body + contrary) == "unsat"


def test_small_scripts_have_no_named_parts_holds() -> None:
    body = f"(assert (> {nested(limits.DEEPEST - 3, '(+ x ', '1')} 2))"
    assert " let " not in statement_of(problem_of(body), "f/check").text().replace("\n", " ")


def holds_with_names(statement: Statement, problem: Problem, point: dict[str, Fraction]) -> bool:
    """Whether what the statement denies holds, where names have the values that their meanings
    give them.
    """
    point = dict(point)
    for name, meaning in problem.meanings.items():
        if isinstance(meaning, Term):
            point[name] = value(meaning, point)
        elif meaning.op == "iff":
            point[name] = Fraction(1 if truth(meaning.parts[1], point) else -1)
        else:  # an equation in each case, of which one applies
            point[name] = next(found for found in solutions(meaning, name, point))
    return not truth(statement.show, point)


def solutions(meaning: Formula, name: str, point: dict[str, Fraction]) -> list[Fraction]:
    equations = [meaning] if meaning.op == "=" else []
    for case in meaning.parts if not equations else ():
        equations += [part for part in (case, *case.parts) if part.op == "="]
    values = [value(one.sides[1], point) for one in equations if str(one.sides[0]) == name]
    return [found for found in values if truth(meaning, {**point, name: found})]


@each_row("seed", range(10))
def test_names_change_no_meaning_holds(seed: int) -> None:
    """A chain of definitions, evaluated by itself, agrees with the statement at random points."""
    choose = random.Random(seed)
    steps = ("(+ @ @)", "(- @ y)", "(* @ 2)", "(ite (> @ y) (- @ 1) (+ @ y))", "(- (+ @ @ x))")
    meant = {
        "(+ @ @)": lambda d, x, y: d + d,
        "(- @ y)": lambda d, x, y: d - y,
        "(* @ 2)": lambda d, x, y: 2 * d,
        "(ite (> @ y) (- @ 1) (+ @ y))": lambda d, x, y: d - 1 if d > y else d + y,
        "(- (+ @ @ x))": lambda d, x, y: -(d + d + x),
    }
    chain = choose.sample(steps * 3, 15)
    parts = ["x", *(step.replace("@", f"d{k}") for k, step in enumerate(chain))]
    text = "".join(f"(define-fun d{k} () Real {part})" for k, part in enumerate(parts))
    problem = problem_of(f"{text}(assert (> d15 (* 3 y)))")
    statement = statement_of(problem, "f/check")
    assert problem.meanings
    for _ in range(4):
        x, y = Fraction(choose.randint(-9, 9)), Fraction(choose.randint(-9, 9), 2)
        d = x
        for step in chain:
            d = meant[step](d, x, y)
        assert holds_with_names(statement, problem, {"x": x, "y": y}) == (d > 3 * y)


def test_what_the_checker_cannot_read_is_unknown_in_one_line(tmp_path: Path) -> None:
    sums = " ".join(f"(* {k}{'7' * 900} x)" for k in range(1, 400))
    path = tmp_path / "large.smt2"
    path.write_text(f"{XY}(assert (> (+ {sums}) 0))(check-sat)", encoding="utf-8")
    (found,) = answer_files([path])
    assert found.answer.word == "unknown" and not found.rejected
    assert found.answer.reason.startswith("beyond the checker's limits: a formula of 36")
