"""What stands in the statement file by name is what was written out, as the checker reads it."""

from __future__ import annotations

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.judging.claims import assertions, named_statements
from juggleproof.papers.paper import opened
from juggleproof.proofs.paper.names import definitions
from juggleproof.statements.definitions import (
    FORMULAS,
    TERMS,
    Definition,
    Reader,
    defining_lines,
    formula_of,
    short_line,
    shortened,
    term_of,
)
from juggleproof.statements.language import ClaimError, Term, reals, term
from juggleproof.statements.store import DEFAULT, STATEMENTS, Store, WrittenOut, statement_file
from tests.rows import each_row
from tests.statements.drawn import fractions

a, b, g, x, y = reals("a b g x y")
E = Definition("E", ("x", "y"), g * x + y**2 / 2)
F = (
    Definition("f_x", ("x", "y"), x - y),
    Definition("f_y", ("y",), 2 * y),
    Definition("f", ("x", "y"), (x - y, 2 * y)),
)
INSIDE = Definition("inside", ("x", "y"), (x >= 0) & (E.body > 0))  # type: ignore[operator, arg-type]
ALL = (E, *F, INSIDE)


def test_the_store_is_read_as_the_checker_reads_it_holds() -> None:
    """Every line of the file, written out by us, has the tree that the checker proves."""
    file = checker.load(str(DEFAULT / STATEMENTS))
    believed = checker.read_statements(file)
    texts = Store(DEFAULT).texts
    assert list(texts) == list(believed)
    for name, text in texts.items():
        alone = checker.read_statements(text)[name]
        assert len(alone.lines) == len(believed[name].lines)
        for (keyword, ours), (its, theirs) in zip(alone.lines, believed[name].lines):
            assert keyword == its
            if keyword in FORMULAS:
                assert formula_of(ours) == formula_of(theirs), name
            elif keyword in TERMS:
                assert (ours[0], term_of(ours[1])) == (theirs[0], term_of(theirs[1])), name


def test_the_store_is_as_short_as_the_definitions_make_it_holds() -> None:
    store = Store(DEFAULT)
    assert isinstance(store.texts, WrittenOut)
    assert store.texts.definitions == defining_lines(definitions())
    for name in list(store.texts)[::20]:
        rows = store.texts[name].split("\n")
        assert store.texts.shortened[name] == [short_line(row, definitions()) for row in rows]


def test_eq_37_reads_as_the_paper_defines_it_holds() -> None:
    texts = Store(DEFAULT).texts
    assert isinstance(texts, WrittenOut)
    assert texts.shortened["eq-37/bound"][-1] == "show E(f1(beta, v)) - E(beta, v) <= dE_max"


LONG = {
    "given g*a + b^2/2 > 0": "given E(a, b) > 0",
    "given g*(x - y) + (2*y)^2/2 > 0": "given E(f(x, y)) > 0",
    "given g*(x - y) + (2*b)^2/2 > 0": "given E(f_x(x, y), f_y(b)) > 0",
    "given a >= 0 and g*a + b^2/2 > 0": "given inside(a, b)",
    "given x = 1 and a >= 0 and g*a + b^2/2 > 0 and y = 2": (
        "given x = 1 and inside(a, b) and y = 2"
    ),
    "show not (a >= 0 and g*a + b^2/2 > 0) or a - b < 0": "show not inside(a, b) or f_x(a, b) < 0",
    "let e = g*0 + (-b)^2/2": "let e = E(0, -b)",
    "given b*g + a^2/2 > 0": "given b*g + a^2/2 > 0",  # the body is not written so
    "given g*a + b^2/3 > 0": "given g*a + b^2/3 > 0",
    "given a >= 0 and g*x + b^2/2 > 0": "given a >= 0 and E(x, b) > 0",  # two different heights
}


@each_row("line", LONG)
def test_lines_are_shortened_and_written_out_again_holds(line: str) -> None:
    assert short_line(line, ALL) == LONG[line]
    assert Reader(defining_lines(ALL)).long_line(LONG[line]) == line


@each_row("line", ["forall E x", "sharp E/x", "word 1 2", "statement E/f"])
def test_other_lines_stay_as_they_are_holds(line: str) -> None:
    assert short_line(line, ALL) == Reader(defining_lines(ALL)).long_line(line) == line


terms = st.recursive(
    st.sampled_from([a, b, g, x, y]) | fractions(-3, 3, 4).map(term),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: p[0] + p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] - p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] * p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] / p[1]),
        inner.map(lambda p: -p),
        inner.map(lambda p: p**2),
        st.tuples(inner, inner).map(lambda p: g * p[0] + p[1] ** 2 / 2),
        st.tuples(inner, inner).map(lambda p: p[0] - p[1]),
    ),
    max_leaves=12,
)


@given(terms)
def test_what_is_written_is_read_back_holds(thing: Term) -> None:
    text = str(thing)
    again = term_of(checker.parse(text))
    assert str(again) == text
    assert ast.dump(checker.parse(str(again))) == ast.dump(checker.parse(text))


@given(terms)
def test_a_shortened_line_means_the_same_to_the_checker_holds(thing: Term) -> None:
    """The checker's polynomials of the line are those of the line written out."""
    line = f"given {thing} > 0"
    short = short_line(line, ALL)
    file = "\n".join([*defining_lines(ALL), "statement a/b", "forall a b g x y", short])
    plain = "\n".join(["statement a/b", "forall a b g x y", line])
    ends = "\nshow 0 < 1"
    try:
        (one,) = checker.read_statements(plain + ends).values()
    except checker.Rejected:
        return
    (two,) = checker.read_statements(file + ends).values()
    said = [formula_of(dict(each.lines)["given"]) for each in (one, two)]
    assert said[0] == said[1]


@each_row("text", ["x", "1 + 2"])
def test_rejects_a_term_as_formula(text: str) -> None:
    with pytest.raises(ClaimError, match="is not a formula"):
        formula_of(checker.parse(text))


def test_rejects_a_formula_as_term() -> None:
    with pytest.raises(ClaimError, match="is not a term"):
        term_of(checker.parse("x < 1"))


TWO = ["define d(x) := x - 1", "", "statement a/b", "forall x", "show d(x) < x"]
TWO += ["", "statement a/c", "forall x", "given x > 1", "show d(x) > 0"]


@each_row("added", ["", "# statement a/d", "statement a/d", "define e := 1"])
@each_row("place", range(len(TWO) + 1))
def test_a_statement_is_what_the_checker_reads_of_it_holds(place: int, added: str) -> None:
    """Whatever stands between its lines, where the checker takes the file."""
    for lines in ([*TWO[:place], added, *TWO[place:]], [*TWO[:place], added, *TWO[place + 1 :]]):
        file = "\n".join(lines)
        try:
            believed = checker.read_statements(file)
        except checker.Rejected:
            continue
        held = WrittenOut(file)
        assert {name: one.text() for name, one in believed.items()} == {
            name: "\n".join(rows) for name, rows in held.shortened.items()
        }
        for name, one in checker.read_statements("\n\n".join(held.values())).items():
            assert list(map(ast.dump, one.get("show"))) == list(
                map(ast.dump, believed[name].get("show"))
            )


def test_statements_that_are_held_are_taken_as_they_stand_holds() -> None:
    chapters = [("One.", ["statement a/b\nforall a b g\ngiven g*a + b^2/2 > 0\nshow 0 < 1"])]
    file = statement_file("All.", chapters, ALL, {})
    assert "given E(a, b) > 0" in file
    assert statement_file("All.", chapters, ALL, WrittenOut(file)) == file
    # with other definitions nothing is taken over
    assert "E(a, b)" not in statement_file("All.", chapters, (), WrittenOut(file))


def test_a_body_that_is_itself_shortened_holds() -> None:
    assert defining_lines(ALL)[-1] == "define inside(x, y) over g := x >= 0 and E(x, y) > 0"
    assert str(shortened(x >= 0, ALL)) == "x >= 0"


def test_what_the_sources_write_is_what_the_store_holds_holds() -> None:
    """To the letter: else a stored certificate would not be found again."""
    texts = Store(DEFAULT).texts
    written = [
        part
        for claim in opened().claims()
        for prefix, assertion in assertions(claim.body())
        for part in named_statements(claim.id, prefix, assertion)
    ]
    assert len(written) > 600
    assert [part.name for part in written if texts[part.name] != part.text()] == []
