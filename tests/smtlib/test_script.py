"""What is written as SMT-LIB and read back means the same: random formulas by a tiny writer, and
our own export of stored statements.
"""

from __future__ import annotations

import random
import zlib
from fractions import Fraction
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from juggleproof.algebra.polynomials import value_at
from juggleproof.smtlib.script import read_problems
from juggleproof.statements.store import Store
from juggleproof.votes.questions import Atom, questions, read_statement
from juggleproof.votes.smtlib import script
from tests.rows import each_row
from tests.smtlib.evaluating import differences, truth
from tests.statements.drawn import fractions

NAMES = ("x", "y", "z")
numbers = fractions(-3, 3, 4)
terms = st.recursive(
    st.sampled_from(NAMES) | numbers,
    lambda inner: (
        st.tuples(st.sampled_from("+-*"), inner, inner)
        | st.tuples(st.just("neg"), inner)
        | st.tuples(st.just("^"), inner, st.integers(0, 3))
        | st.tuples(st.just("let"), inner, inner)
    ),
    max_leaves=6,
)
relations = st.tuples(st.sampled_from(("<", "<=", "=", ">=", ">")), terms, terms)
formulas = st.recursive(
    relations | st.booleans(),
    lambda inner: (
        st.tuples(st.sampled_from(("and", "or", "=>", "xor", "iff")), inner, inner)
        | st.tuples(st.just("not"), inner)
        | st.tuples(st.just("ite"), inner, inner, inner)
        | st.tuples(st.just("choose"), inner, terms, terms)
    ),
    max_leaves=6,
)


def written(thing: Any) -> str:
    """The tiny writer; `let` names the first term and adds it twice to the second, `choose`
    compares a real `ite` with 1.
    """
    if isinstance(thing, bool):
        return str(thing).lower()
    if isinstance(thing, Fraction):
        size = (
            f"{abs(thing.numerator)}.0"
            if thing.denominator == 1
            else f"(/ {abs(thing.numerator)} {thing.denominator})"
        )
        return size if thing >= 0 else f"(- {size})"
    if isinstance(thing, str):
        return thing
    op, *parts = thing
    if op == "^":
        return f"(^ {written(parts[0])} {parts[1]})"
    inner = " ".join(map(written, parts))
    if op == "let":
        return f"(let ((v {written(parts[0])}) (x y) (y x)) (+ v v {written(parts[1])}))"
    if op == "choose":
        return f"(< (ite {inner}) 1)"
    return f"({ {'neg': '-', 'iff': '='}.get(op, op) } {inner})"


def meant(thing: Any, point: dict[str, Fraction]) -> Any:
    """The value by what SMT-LIB says of each symbol."""
    if isinstance(thing, (bool, Fraction)):
        return thing
    if isinstance(thing, str):
        return point[thing]
    op, first, *rest = thing
    if op == "let":  # the names are bound all at once
        return 2 * meant(first, point) + meant(rest[0], {**point, "x": point["y"], "y": point["x"]})
    a, more = meant(first, point), [part if op == "^" else meant(part, point) for part in rest]
    b = more[0] if more else None
    return {
        "+": lambda: a + b,
        "-": lambda: a - b,
        "*": lambda: a * b,
        "neg": lambda: -a,
        "^": lambda: a**b,
        "<": lambda: a < b,
        "<=": lambda: a <= b,
        "=": lambda: a == b,
        ">=": lambda: a >= b,
        ">": lambda: a > b,
        "and": lambda: a and b,
        "or": lambda: a or b,
        "not": lambda: not a,
        "=>": lambda: not a or b,
        "xor": lambda: a != b,
        "iff": lambda: a == b,
        "ite": lambda: b if a else more[1],
        "choose": lambda: (b if a else more[1]) < 1,
    }[op]()


@given(formulas, st.lists(st.tuples(numbers, numbers, numbers), min_size=3, max_size=3))
def test_a_formula_that_is_written_and_read_back_means_the_same_holds(
    formula: Any, points: list[tuple[Fraction, ...]]
) -> None:
    declared = "".join(f"(declare-const {name} Real)" for name in NAMES)
    (problem,) = read_problems(
        f"(set-logic QF_NRA){declared}(assert {written(formula)})(check-sat)", "f"
    )
    ((_, read),) = problem.assertions
    for values in points:
        point = dict(zip(NAMES, values))
        assert truth(read, point) == meant(formula, point)


STORE = Store()
# no integers, nothing to exist, no rule
KEYWORDS = ("forall ", "range ", "given ", "have ", "let ", "root ", "show ")
SAMPLE = [
    name
    for name, text in sorted(STORE.texts.items())
    if zlib.crc32(name.encode()) % 12 == 0
    and all(row.startswith(KEYWORDS) for row in text.splitlines()[1:])
]


def holds(formula: Any, values: list[Fraction]) -> bool:
    """The truth of an exported formula, whose polynomials are those of the checker's unfolding."""
    if isinstance(formula, bool):
        return formula
    if isinstance(formula, Atom):
        at = value_at(formula.poly, values)
        return {">": at > 0, ">=": at >= 0, "=": at == 0, "!=": at != 0}[formula.relation]
    op, parts = formula
    return (all if op == "and" else any)(holds(part, values) for part in parts)


def values_in(formula: Any, values: list[Fraction]) -> set[Fraction]:
    """The values of the polynomials, each times its denominator, as the export writes it."""
    if isinstance(formula, bool):
        return set()
    if isinstance(formula, Atom):
        return {value_at(formula.poly, values)}
    return {value for part in formula[1] for value in values_in(part, values)}


@each_row("name", SAMPLE)
def test_our_own_export_read_back_is_the_same_up_to_names_holds(name: str) -> None:
    statement = read_statement(STORE.texts[name])
    asked = questions(statement)
    problems = read_problems(script(statement), name)
    assert len(problems) == len(asked)
    chance = random.Random(name)
    for problem, question in zip(problems, asked):
        formulas = [*question.assumed, *(denial.formula for denial in question.denials)]
        assert len(problem.assertions) == len(formulas)
        for _ in range(4):
            point = {
                symbol: Fraction(chance.randint(-6, 6), chance.randint(1, 4))
                for symbol in question.names
            }
            # e! where Z3 has its own e
            ours = {
                variable.name: point[variable.symbol.removesuffix("!")]
                for variable in problem.variables
            }
            values = [point[symbol] for symbol in question.names]
            for (_, read), formula in zip(problem.assertions, formulas):
                assert truth(read, ours) == holds(formula, values)
                assert differences(read, ours) == values_in(formula, values)


def test_the_sample_of_exports_is_not_empty_holds() -> None:
    assert len(SAMPLE) > 30
