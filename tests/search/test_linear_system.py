"""Linear facts and disjunctions are decided as Z3 decides them: by a point, or by contradictions,
that the checker takes.
"""

from __future__ import annotations

import random

import z3

from juggleproof.certificates import checker
from juggleproof.search.psatz.basis import last_basis
from juggleproof.search.small_proofs.linear_system import (
    ONE,
    Farkas,
    Row,
    Vertex,
    by_pivots,
    search_linear,
    solve,
)
from juggleproof.statements.work import Budget
from tests.rows import each_row

WORDS = {"certified": "unsat", "refuted": "sat"}
RELATIONS = ("<", "<=", "=", "!=", ">=", ">")


def answered(names: list[str], formula: str, budget: int = 10**6) -> str:
    """sat or unsat as the checker takes it; else unknown."""
    text = f"statement a/b\nforall {' '.join(names)}\nshow not ({formula})"
    statement = checker.read_statements(text)["a/b"]
    found = search_linear(statement, Budget(budget), last_basis)
    if found is None:
        return "unknown"
    return WORDS[checker.check_one(statement, found, {}, {})[0]]


def as_z3(names: list[str], formula: str) -> str:
    text = formula.replace("!=", "<>").replace("<=", "=<").replace(">=", "=>")
    solver = z3.Solver()
    solver.set(rlimit=10**6)
    clauses = [[one.strip("() ") for one in part.split(" or ")] for part in text.split(" and ")]
    own = {name: z3.Real(name) for name in names}

    def side(words: str) -> z3.ArithRef:
        pairs = [word.split("*") for word in words.split(" + ")]
        return sum(
            (z3.RealVal(c) * (own[name[0]] if name else 1) for c, *name in pairs), z3.RealVal(0)
        )

    def atom(words: str) -> z3.BoolRef:
        left, relation, _ = words.rsplit(" ", 2)
        value = side(left)
        return {
            "<": value < 0, "=<": value <= 0, "=": value == 0,
            "<>": value != 0, "=>": value >= 0, ">": value > 0,
        }[relation]  # fmt: skip

    solver.add([z3.Or([atom(one) for one in clause]) for clause in clauses])
    return str(solver.check())


def clause(choose: random.Random, names: list[str], largest: int) -> str:
    atoms = []
    for _ in range(choose.choice((1, 1, 2, 3))):
        own = choose.sample(names, choose.randint(1, len(names)))
        sums = [f"{choose.randint(-largest, largest)}*{name}" for name in own]
        atoms.append(
            f"{' + '.join([*sums, str(choose.randint(-largest, largest))])}"
            f" {choose.choice(RELATIONS)} 0"
        )
    return "(" + " or ".join(atoms) + ")"


@each_row("largest", [3, 10**13])
@each_row("seed", range(25))
def test_random_systems_are_decided_as_z3_does_holds(seed: int, largest: int) -> None:
    choose = random.Random(seed)
    names = ["x", "y", "z", "w"][: choose.randint(1, 4)]
    formula = " and ".join(clause(choose, names, largest) for _ in range(choose.randint(2, 9)))
    assert answered(names, formula) == as_z3(names, formula)


def test_exact_pivots_agree_with_the_basis_of_floats_holds() -> None:
    choose = random.Random(1)
    kinds = set()
    for _ in range(40):
        facts: list[tuple[Row, str]] = [
            (
                {k: choose.randint(-3, 3) or 1 for k in (0, 1, 2, ONE)},
                choose.choice((">", ">=", "=")),
            )
            for _ in range(choose.randint(3, 7))
        ]
        rows = [*(row for row, _ in facts), {ONE: 1}]
        entries = [
            {(3 if k == ONE else k): c for k, c in row.items()} | ({4: -1} if strict else {})
            for row, strict in zip(rows, [*(relation == ">" for _, relation in facts), True])
        ]
        exactly = by_pivots(facts, entries, [0, 1, 2, ONE], (), (), Budget(10**6))
        assert type(exactly) is type(solve(facts, Budget(10**6), last_basis))
        kinds.add(type(exactly))
    assert kinds == {Vertex, Farkas}


def test_a_gap_that_floats_do_not_see_is_seen_holds() -> None:
    close = "10^20*x <= 10^20 + 1 and 10^20*x >= 10^20 + {}"
    assert answered(["x"], close.format(1)) == "sat"
    assert answered(["x"], close.format(2)) == "unsat"


def test_cases_that_do_not_matter_are_left_out_holds() -> None:
    names = [f"x{k}" for k in range(14)]
    cases = " and ".join(f"({name} >= 1 or {name} <= -1)" for name in names[2:])
    contrary = "(x0 > 1 or x0 < 0) and (x1 > x0 or x1 < -1) and x0 = 1/2"
    assert answered(names, f"{cases} and {contrary}", 20_000) == "unsat"


def test_a_budget_that_ends_is_no_answer_holds() -> None:
    assert answered(["x", "y"], "x > y and y > x", 10) == "unknown"


@each_row("show", ["x^2 >= 0", "x*y > 1", "x > 0 or x*x*x < 1"])
def test_no_answer_fails_without_linearity(show: str) -> None:
    assert answered(["x", "y"], show) == "unknown"


def test_givens_that_contradict_one_another_are_not_certified_holds() -> None:
    text = "statement a/b\nforall x\ngiven x > 1\ngiven x < 1\nshow x > 2"
    assert search_linear(checker.read_statements(text)["a/b"], Budget(10**6)) is None
    text = "statement a/b\nforall x y\ngiven x > 1\ngiven y = x + 1\nshow y > 2"
    statement = checker.read_statements(text)["a/b"]
    found = search_linear(statement, Budget(10**6))
    assert checker.check_one(statement, found, {}, {}) == ("certified", None)
