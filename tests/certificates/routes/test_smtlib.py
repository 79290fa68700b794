"""The SMT-LIB text: deterministic, without divisions, of the right logic, and read by other solvers as it is meant."""

import pytest

from certificates import checker
from certificates.routes.questions import questions, read_statement
from certificates.routes.smtlib import logic, script
from tests.certificates.routes.corpus import ITERATES, SHARP, STATEMENTS


@pytest.mark.parametrize("name", STATEMENTS)
def test_scripts_are_deterministic_balanced_and_free_of_divisions(name: str) -> None:
    statement, _ = STATEMENTS[name]
    text = script(statement)
    assert text == script(statement) and text.endswith("\n")
    body = "\n".join(line for line in text.splitlines() if not line.startswith(";"))
    assert body.count("(") == body.count(")") and "/" not in body and statement.name in text.splitlines()[0]
    assert body.count("(push 1)") == body.count("(pop 1)") == body.count("(check-sat)") == len(questions(statement))


@pytest.mark.parametrize("rows, expected", [
    (("forall x", "show x^2 >= 0"), "QF_NRA"), (("forall K", "integer K", "show K^2 >= 0"), "QF_NIA"),
    (("forall K x", "integer K", "show K*x^2 + K^2 >= 0"), "QF_NIRA"), (("forall x", "exists y", "show y > x"), "NRA"),
    (("forall x K", "integer K", "exists y", "show y > K*x"), "NIRA")])
def test_logics(rows: tuple[str, ...], expected: str) -> None:
    statement = read_statement("\n".join(("statement t/t", *rows)))
    assert logic(questions(statement)[-1]) == expected
    assert f"(set-logic {'UFNIRA' if expected == 'NIRA' else expected})" in script(statement)


def test_integers_are_declared_and_lifted_only_beside_reals() -> None:
    text = script(read_statement("statement t/t\nforall K x\ninteger K\ngiven K >= 2\nshow K*x^2 >= 0"))
    assert "(declare-const K Int)" in text and "(assert (>= (+ K (- 2)) 0))" in text and "(* (- 1) (to_real K) x x)" in text


def test_denominators_are_cleared_with_their_signs() -> None:
    text = script(read_statement("statement t/t\nforall x y\ngiven y < 0\nshow x/y > 1"))
    assert "(assert (>= (+ x (* (- 1) y)) 0))" in text  # not (x/y > 1) is x/y <= 1, that is x >= y, because y < 0


def test_names_that_solvers_have_taken_are_told_apart() -> None:
    text = script(read_statement("statement t/t\nforall pi abs\ngiven pi > abs\nshow pi >= abs"))
    assert "(declare-const pi! Real)" in text and "(declare-const abs! Real)" in text


def test_sharp_ranges_are_exported_inside_and_outside() -> None:
    statements = checker.read_statements(SHARP)
    text = script(statements["sharp/trap-range"], statements)
    assert "; inside, sharp/trap: goal" in text and "; outside: a solution is a parameter" in text and "(forall ((x Real) (w Real))" in text
    exists = checker.read_statements(SHARP.replace("show alpha*(w - x)", "exists y\nshow y > alpha and alpha*(w - x)"))
    assert "; only the part inside the range is written" in script(exists["sharp/trap-range"], exists)


def test_recurrences_are_exported_as_identities_that_fail_nowhere() -> None:
    (statement,) = checker.read_statements(ITERATES).values()
    assert "(assert false)" in script(statement)


@pytest.mark.parametrize("name, answers", [
    ("f1-in-H", ["unsat"]), ("collision-time", ["unsat"]), ("e1-in-B1", ["unsat", "unsat"]), ("open-H-invariant", ["sat"]),
    ("e2-always", ["unsat", "sat"]), ("B1-plus-not-empty", ["unsat"])])
def test_a_solver_reads_the_whole_script_as_it_is_meant(name: str, answers: list[str]) -> None:
    z3 = pytest.importorskip("z3")
    found = []
    head, *blocks = script(STATEMENTS[name][0]).split("(push 1)\n")
    assert "(set-logic " in head
    for block in blocks:
        solver = z3.Solver(ctx=z3.Context())
        solver.from_string(block.split("(check-sat)")[0])
        found.append(str(solver.check()))
    assert found == answers


@pytest.mark.parametrize("name, answers", [("f1-in-H", ["unsat"]), ("square", ["unsat"]), ("e1-in-B1", ["unsat", "unsat"])])
def test_another_solver_agrees(name: str, answers: list[str]) -> None:
    cvc5 = pytest.importorskip("cvc5")
    solver = cvc5.Solver()
    solver.setOption("incremental", "true")
    parser = cvc5.InputParser(solver)
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, script(STATEMENTS[name][0]), "statement.smt2")
    found = []
    while not (command := parser.nextCommand()).isNull():
        found.append(command.invoke(solver, parser.getSymbolManager()).strip())
    assert [line for line in found if line] == answers
