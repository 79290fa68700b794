"""The checker's reading of a formula agrees with a second one, at random rational points, in both
directions.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Context, Kind, Rejected, State
from juggleproof.certificates.checker.algebra import Work, sum_of_monomials
from juggleproof.certificates.checker.text import names_of, summands
from tests.certificates.checker.evaluator import formula_at, holds_at, term_at
from tests.certificates.checker.harness import (
    CLOSE,
    Case,
    judge,
    lines,
    proof,
    refused,
    refuted,
    verdict,
)
from tests.certificates.checker.rules.sharp import EARLIER, SHARP, VALID, over
from tests.statements.drawn import fractions

NAMES = ("x", "y", "z")
FEW = settings(max_examples=25, deadline=None, derandomize=True)
small = fractions(-3, 3, 4)
points = st.fixed_dictionaries(dict.fromkeys(NAMES, small))


def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    pairs = st.tuples(inner, inner)
    return st.one_of(
        st.tuples(
            pairs,
            st.sampled_from(["{} + {}", "({}) - ({})", "({})*({})", "{} - {}", "({})*({}) + 1"]),
        ).map(lambda p: p[1].format(*p[0])),
        st.tuples(
            inner, st.sampled_from(["-({})", "({})^2", "({})^3", "({})/3", "-({})^2", "({})^0"])
        ).map(lambda p: p[1].format(p[0])),
    )


atoms = st.one_of(st.sampled_from(NAMES), st.integers(0, 5).map(str))
terms = st.recursive(atoms, grown, max_leaves=5)
relations = st.tuples(terms, st.sampled_from(["<", "<=", "=", "!=", ">=", ">"]), terms).map(
    " ".join
)
chains = st.tuples(relations, st.sampled_from(["<", "<=", "=", "!=", ">=", ">"]), terms).map(
    " ".join
)


def joined(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    shapes = [
        "({}) and ({})",
        "({}) or ({})",
        "implies({}, {})",
        "iff({}, {})",
        "not ({} or {})",
        "not implies({}, {})",
        "not iff({}, {})",
        "{} or {}",
    ]
    return st.tuples(inner, inner, st.sampled_from(shapes)).map(lambda p: p[2].format(p[0], p[1]))


formulas = st.recursive(st.one_of(relations, chains), joined, max_leaves=4)


def numeral(value: Fraction) -> str:
    return f"({value})"


def outcome(text: str, certificate: object) -> str:
    return verdict(text, {"rule/case": certificate})["rule/case"][0]


@FEW
@given(terms, points)
def test_a_term_has_the_value_that_a_second_reading_gives_it(
    term: str, point: dict[str, Fraction]
) -> None:
    rows = [*(f"let {name} = {value}" for name, value in point.items())]
    value = term_at(term, point)
    assert outcome(lines(*rows, f"show {term} = {value}"), proof(CLOSE)) == "certified"
    assert outcome(lines(*rows, f"show {term} = {value} + 1/7"), proof(CLOSE)) == "rejected"


@FEW
@given(formulas, points)
def test_a_formula_is_true_at_a_point_in_both_readings_or_in_none(
    formula: str, point: dict[str, Fraction]
) -> None:
    truth = formula_at(formula, point)
    rows = [f"let {name} = {value}" for name, value in point.items()]
    assert outcome(lines(*rows, f"show {formula}"), proof(CLOSE)) == (
        "certified" if truth else "rejected"
    )
    assert outcome(lines(*rows, f"show not ({formula})"), proof(CLOSE)) == (
        "rejected" if truth else "certified"
    )


@FEW
@given(formulas, points)
def test_a_point_refutes_exactly_what_fails_there(formula: str, point: dict[str, Fraction]) -> None:
    text = lines("forall x y z", f"show {formula}")
    at = {name: str(value) for name, value in point.items()}
    assert outcome(text, refuted(at)) == ("rejected" if formula_at(formula, point) else "refuted")


quotients = st.tuples(terms, st.sampled_from(["x", "y^2", "x*y", "-2*x^3", "(1/5)*x^2*y"])).map(
    lambda p: f"({p[0]})/({p[1]})"
)


@FEW
@given(
    quotients,
    quotients,
    st.sampled_from(["<", "<=", "=", "!=", ">=", ">"]),
    st.sampled_from(["x > 0", "x < 0", "x != 0"]),
    st.sampled_from(["y != 0", "y > 0", "y < 0"]),
    points,
)
def test_quotients_compare_by_the_sign_of_their_denominators(
    left: str, right: str, relation: str, first: str, second: str, point: dict[str, Fraction]
) -> None:
    rows = [
        "forall x y z",
        f"given {first}",
        f"given {second}",
        f"let q = {left}",
        f"show q {relation} {right} + z*q",
    ]
    at = {name: str(value) for name, value in point.items()}
    holds = holds_at(rows, point)
    assert outcome(lines(*rows), refuted(at)) == ("refuted" if holds is False else "rejected")


@FEW
@given(terms, terms, points)
def test_an_identity_holds_everywhere(left: str, right: str, point: dict[str, Fraction]) -> None:
    for one, other in (
        (left, right),
        (f"({left})*({right})", f"({right})*({left})"),
        (f"({left} - ({right}))^2", f"({right} - ({left}))^2"),
    ):
        if (
            outcome(
                lines("forall x y z", f"show {one} = {other}"),
                proof(CLOSE, at=dict.fromkeys(NAMES, "0")),
            )
            == "certified"
        ):
            assert term_at(one, point) == term_at(other, point)


@FEW
@given(
    st.lists(
        st.tuples(st.integers(1, 4), st.sets(st.integers(0, 1), max_size=2), terms),
        min_size=1,
        max_size=3,
    ),
    points,
)
def test_a_sum_of_products_of_what_is_not_negative_is_not_negative(
    parts: list[tuple[int, set[int], str]], point: dict[str, Fraction]
) -> None:
    facts = ["x", "y - z"]
    total = " + ".join(
        "*".join([str(c), *(f"({facts[i]})" for i in sorted(used)), f"({q})^2"])
        for c, used, q in parts
    )
    rows = ["forall x y z", *(f"given {fact} >= 0" for fact in facts)]
    products = [[c, [[i, 1] for i in sorted(used)], q] for c, used, q in parts]
    at = {"x": "1", "y": "1", "z": "0"}
    true, false = (
        lines(*rows, f"show {total} > -1"),
        lines(*rows, f"show {total} > 0 or {total} < -1"),
    )
    node = ["psatz", [[1, [[2, 1]], "1"], *products, [1, [], "1"]], []]
    constant = formula_at(f"{total} = {term_at(total, dict.fromkeys(NAMES, Fraction(0)))}", point)
    if not constant:
        assert outcome(true, proof(node, at=at)) == "certified"
        assert holds_at(true.splitlines(), point) is not False
        assert outcome(false, proof(node, at=at)) == "rejected"


@FEW
@given(
    st.lists(st.tuples(small, st.integers(1, 3)), min_size=1, max_size=3),
    small,
    small,
    st.sampled_from(["", "-"]),
)
def test_a_number_is_the_only_root_between_its_ends(
    roots: list[tuple[Fraction, int]], low: Fraction, high: Fraction, sign: str
) -> None:
    p = f"{sign}2*" + "*".join(f"(a - {numeral(root)})^{k}" for root, k in roots)
    number = f"number c = root({p}, {low}, {high})"
    text = over(*SHARP[:3], number, SHARP[3])
    # Descartes' rule counts the roots of a polynomial whose roots are all real
    orders = sum(k for root, k in roots if low < root < high)
    once = orders == 1 and not any(root in (low, high) for root, _ in roots)
    outcome, _ = judge(Case("", text, VALID, earlier=EARLIER))
    assert outcome == ("certified" if once else "rejected")


def of_x_and_y() -> Context:
    context = Context()
    context.declare("x")
    context.declare("y")
    return context


def licensed_by(context: Context, line: str) -> Context:
    """The context, in which a strict line stands."""
    context.license(context.formula(checker.parse(line)))
    return context


@pytest.mark.parametrize(
    "text",
    [
        "2*x*3*y - x/4 + x*y/2",
        "x - x + 0*y",
        "7 - 2*3",
        "-2*x*(x + 1)",
        "3/4*x*(x + 1)*(y + 2)*(x - y)",
        "5*(x + y)*2/3 - y",
        "(x + 1)^3 + (x + 1)^2 + (x + 1)^4",
        "1 - (x - y)^5*(x - y)^2/(3 - 1) - 1/2",
    ],
)
def test_a_sum_has_the_value_of_its_summands_holds(text: str) -> None:
    value = of_x_and_y().polynomial(text)
    for x, y in [(0, 0), (1, 2), (-3, 5), (7, -2)]:
        found = sum(c * x ** (m & 65535) * y ** (m >> 16) for m, c in value.terms.items())
        point = {"x": Fraction(x), "y": Fraction(y)}
        assert Fraction(found, value.den) == term_at(text, point)


@pytest.mark.parametrize(
    "text, expected",
    [
        ("1/x + x/2", "1/2*x^2 + 1"),
        ("3*y/x - 2*(y + 1)/x + 1", "y + x - 2"),
        ("2 - (x + y)*(x - y)/x*3", "3*y^2 - 3*x^2 + 2*x"),
        ("(1/x)^3 + (1/x)^2", "x + 1"),
    ],
)
def test_a_sum_with_quotients_has_one_denominator_holds(text: str, expected: str) -> None:
    context = licensed_by(of_x_and_y(), "x > 0")
    value = context.value(checker.parse(text))
    assert context.show(value.over({})) == expected
    ((divisor, positive),) = value.under
    assert positive and context.show(divisor) == "x"


def test_a_power_is_the_same_whatever_was_asked_for_before_holds() -> None:
    context = of_x_and_y()
    base = context.polynomial("x + y - 1")
    for exponent in (5, 2, 3, 7, 4, 2):
        alone = context.polynomial("x + y - 1")
        expected = context.number(1)
        for _ in range(exponent):
            expected = expected * alone
        assert (base**exponent).terms == expected.terms


def test_rejects_a_division_licensed_in_another_branch() -> None:
    """What one branch assumes, and divides by, says nothing in the other, nor before both."""
    state = State(of_x_and_y())
    one, other = state.branch(), state.branch()
    tree = checker.parse("1/x >= 1")
    one.assume(one.context.formula(checker.parse("x > 0")))
    one.context.formula(tree)
    for context in (other.context, state.context, state.branch().context, Context(other.context)):
        with pytest.raises(Rejected) as info:
            context.formula(tree)
        assert refused(info.value, (Kind.DIVISION, "x"))
    one.branch().context.formula(tree)
    Context(one.context).formula(tree)


def test_rejects_a_division_that_only_the_variables_around_license() -> None:
    """The facts of a state license, not the lines of the context that it takes variables from."""
    around = licensed_by(of_x_and_y(), "x > 0")
    for _ in range(2):  # before and after something divides there
        with pytest.raises(Rejected) as info:
            State(around).context.value(checker.parse("1/x"))
        assert refused(info.value, (Kind.DIVISION, "x"))
        around.value(checker.parse("1/x"))


@pytest.mark.parametrize(
    "rows, expected",
    [
        (["x > 0"], "-x + 1"),
        (["x != 0"], "-x^2 + x"),
        (["x != 0", "x > 0"], "-x + 1"),
        (["x > 0", "x != 0"], "-x + 1"),
        (["-2*x > 0"], "x - 1"),
        (["x > 0 or y > 0", "3*x < 0 and y > 0"], "x - 1"),
    ],
)
def test_the_sign_of_a_divisor_is_that_of_its_strict_lines_holds(
    rows: list[str], expected: str
) -> None:
    for divided in (False, True):
        context = of_x_and_y()
        for row in rows:
            licensed_by(context, row)
            assert not divided or context.licensed is not None
        formula = Context(context).formula(checker.parse("1/x >= 1"))
        assert not isinstance(formula, bool) and formula[0] == "atom"
        assert context.show(formula[1]) == expected


def beside(context: Context, **values: str) -> Context:
    """Names with these values, in a context that has the same meter."""
    named = {name: context.polynomial(text) for name, text in values.items()}
    return Context(context, {**context.values, **named})


def test_rejects_what_was_kept_for_other_values() -> None:
    """One tree says of each value of its names what it says of that value."""
    context = of_x_and_y()
    tree = checker.parse("a - 2*b > 0")
    for a, b in [("x", "y"), ("y", "x"), ("x", "x"), ("1", "x"), ("x", "y")] * 2:
        inner = beside(context, a=a, b=b)
        kept, made = inner.once(Context.formula, tree), inner.formula(tree)
        assert not isinstance(kept, bool) and not isinstance(made, bool)
        assert kept[0] == made[0] == "atom" and kept[1].terms == made[1].terms
    context.once(Context.formula, checker.parse("x > y"))
    with pytest.raises(Rejected) as info:
        context.once(Context.formula, tree)
    assert refused(info.value, (Kind.UNDECLARED, "a"))
    with pytest.raises(Rejected) as info:
        beside(context, a="x", b="y").once(Context.value, tree)
    assert refused(info.value, Kind.TERM)


def test_rejects_what_was_kept_for_other_strict_lines() -> None:
    """A quotient has a value, and an atom with one a sign, by the strict lines of its context."""
    around = of_x_and_y()
    tree = checker.parse("1/x >= 1")
    for _ in range(2):
        for rows, expected in (
            (["x > 0"], "-x + 1"),
            (["x != 0"], "-x^2 + x"),
            (["y > 0", "x > 0"], "-x + 1"),
            (["-2*x > 0"], "x - 1"),
        ):
            context = Context(around)
            for row in rows:
                context.license(context.once(Context.formula, checker.parse(row)))
            formula = context.once(Context.formula, tree)
            assert not isinstance(formula, bool) and formula[0] == "atom"
            assert context.show(formula[1]) == expected
        for rows in ([], ["y > 0"], ["x >= 0"]):
            context = Context(around)
            for row in rows:
                context.license(context.once(Context.formula, checker.parse(row)))
            with pytest.raises(Rejected) as info:
                context.once(Context.formula, tree)
            assert refused(info.value, (Kind.DIVISION, "x"))


def test_quotients_that_were_kept_have_one_denominator_holds() -> None:
    around = licensed_by(of_x_and_y(), "3*x > 0")
    kept = Context(around).once(Context.value, checker.parse("1/x"))
    total = kept + Context(around).value(checker.parse("y/x"))
    assert around.show(total.over({})) == "y + 1" and [*total.under.values()] == [1]


@pytest.mark.parametrize(
    "text",
    [
        "3/4*x^2*y - x + 1",
        "-x",
        "-3/6*x*y^2 - 0*x - 7/2",
        "0",
        "x - x",
        "x*x^2*y*x - 2*x^4*y",
        "x^1 + 10/4",
        "-1 - 12345678901234567890*y^4000",
    ],
)
def test_a_sum_of_products_is_read_as_its_tree_holds(text: str) -> None:
    context = of_x_and_y()
    (flat, tree) = context.polynomial(text), context.value(checker.parse(text))
    assert context.monomials(text)
    assert (flat.terms, flat.den) == (tree.terms, tree.den)


@pytest.mark.parametrize(
    "text, expected",
    [
        ("3/4*x^2*y - x + 1", [(3, 4, ["x^2", "y"]), (-1, 1, ["x"]), (1, 1, [])]),
        ("-5*b", [(-5, 1, ["b"])]),
        ("-b - 2/3", [(-1, 1, ["b"]), (-2, 3, [])]),
        ("0/7", [(0, 7, [])]),
        ("x*3", []),
        ("x/2", []),
        ("(x)", []),
        ("x +y", []),
        ("x + -y", []),
        ("+x", []),
        ("1\u0663*x", []),  # a digit and a letter that are not ASCII
        ("x\u00e9", []),
        ("", []),
        ("x" * (1 << 18), [(1, 1, ["x" * (1 << 18)])]),
        ("x" * (1 + (1 << 18)), []),
    ],
)
def test_summands_are_those_of_a_sum_of_products_alone_holds(
    text: str, expected: list[tuple[int, int, list[str]]]
) -> None:
    assert summands(text) == expected


@pytest.mark.parametrize(
    "text, expected",
    [
        ("a*b > 1 + b", ["a", "b"]),
        ("a/2 + b > 0", ["a", "b"]),
        ("b > 0 and not (3 - c/a^2 >= 0)", ["a", "b", "c"]),
        ("implies(-x > 0, y/x + x = 1)", ["implies", "x", "y"]),
        ("1/2 + x", ["x"]),
        ("7", []),
    ],
)
def test_the_names_of_a_tree_are_found_holds(text: str, expected: list[str]) -> None:
    assert names_of(checker.parse(text)) == expected


@pytest.mark.parametrize(
    "text, terms, den, under",
    [
        ("1*1", {0: 1}, 1, []),
        ("x*(x + y)", {2: 1, 1 + (1 << 16): 1}, 1, []),
        ("(x + y)*(x - y)*3", {2: 3, 2 << 16: -3}, 1, []),
        ("(x + y)/2", {1: 1, 1 << 16: 1}, 2, []),
        ("(x + y)/y", {1: 1, 1 << 16: 1}, 1, [1]),
        ("2*x/y/y*x/3", {2: 2}, 3, [2]),
        ("1/y*(x/y)*(x + 1)", {2: 1, 1: 1}, 1, [2]),
    ],
)
def test_a_product_has_its_numerator_and_what_it_is_over_holds(
    text: str, terms: dict[int, int], den: int, under: list[int]
) -> None:
    value = licensed_by(of_x_and_y(), "y != 0").value(checker.parse(text))
    assert (value.terms, value.den, [*value.under.values()]) == (terms, den, under)


def test_a_sum_takes_nothing_from_its_summands_holds() -> None:
    context = of_x_and_y()
    assert context.value(checker.parse("x + y")).terms == {1: 1, 1 << 16: 1}
    assert context.values["x"].terms == {1: 1} and context.values["y"].terms == {1 << 16: 1}


def test_a_branch_has_the_variables_of_its_context_under_their_keys_holds() -> None:
    state = State(of_x_and_y())
    assert state.branch().context.values == state.context.values
    inner = Context(state.context)
    inner.define("half", inner.value(checker.parse("x/2")))
    inner.declare("z")
    assert state.branch(variables=inner).context.values.keys() == {"x", "y", "z"}


def test_monomials_are_limited_by_their_degree_and_counted_by_their_letters() -> None:
    context = of_x_and_y()
    assert context.monomials("x^4000*y") == [(4000 + (1 << 16), 1, 1, 4001)]
    assert context.monomials("x^4001") == []
    assert context.monomials("x - x^2*z") == []
    before = context.work.left
    assert context.monomials("2*x - y") == [(1, 2, 1, 1), (1 << 16, -1, 1, 1)]
    assert before - context.work.left == 4 * 7


def test_a_sum_of_monomials_has_their_bounds_holds() -> None:
    work = Work(10**6)
    total = sum_of_monomials([(1, 3, 2, 1), (2, 1 << 600, 1, 2), (0, 5, 3, 0), (1, 1, 2, 1)], work)
    assert (total.terms, total.den) == ({1: 12, 2: 6 << 600, 0: 10}, 6)
    assert total.deg == 2 and total.bits == 603 + 2
    assert 10**6 - work.left == 4 * 9 + (603**2 >> 16)
    assert sum_of_monomials([(1, 3, 2, 1), (1, -3, 2, 1)], work).terms == {}


@pytest.mark.parametrize(
    "text, expected",
    [
        ("x^4001", Kind.EXPONENT),
        ("x^4000*y", Kind.SIZE),
        ("x*z", (Kind.UNDECLARED, "z")),
        ("1/0*x", Kind.ZERO_DIVISION),
        ("01*x", Kind.TEXT),
        ("x^-1", Kind.TERM),
        ("x +", Kind.TEXT),
        ("2x", Kind.TEXT),
        ("1_0*x", Kind.TEXT),
        ("x**2", Kind.TEXT),
        ("x y", Kind.TEXT),
        ("lambda", Kind.TEXT),
        ("None*x", Kind.TERM),
        ("\u0661*x", Kind.TEXT),
    ],
)
def test_rejects_what_is_no_sum_of_products(text: str, expected: Kind | tuple[Kind, str]) -> None:
    with pytest.raises(Rejected) as info:
        of_x_and_y().polynomial(text)
    assert refused(info.value, expected)


def test_a_name_of_a_sum_of_products_may_stand_for_any_value_holds() -> None:
    context = beside(of_x_and_y(), a="x + 1", b="2*x", c="x/2", d="x*y", e="x^3", f="5")
    for text in ("a*y^2", "b^2 - x", "c*c", "d^2*x", "e^2 - d", "f*x - f^2", "3*d*e"):
        flat, tree = context.polynomial(text), context.value(checker.parse(text))
        assert (flat.terms, flat.den) == (tree.terms, tree.den)


@pytest.mark.parametrize("text", ["a", "a*y", "2*a^2 - x"])
def test_rejects_a_sum_of_products_with_a_name_for_a_quotient(text: str) -> None:
    context = licensed_by(of_x_and_y(), "x > 0")
    context.define("a", context.value(checker.parse("1/x")))
    with pytest.raises(Rejected) as info:
        context.polynomial(text)
    assert refused(info.value, (Kind.POLYNOMIAL, text))


@pytest.mark.parametrize("text", [5, None, ["x"], {}])
def test_rejects_a_polynomial_that_is_no_text(text: Any) -> None:
    with pytest.raises(Rejected) as info:
        of_x_and_y().polynomial(text)
    assert refused(info.value, Kind.TEXT)


@pytest.mark.parametrize("name", ["lambda", "None", "if", "and", "iff"])
def test_rejects_a_variable_with_the_name_of_a_word(name: str) -> None:
    with pytest.raises(Rejected) as info:
        Context().declare(name)
    assert refused(info.value, (Kind.NAME, name))


@pytest.mark.parametrize("text", ["x*True", "x + None", "1 - False", "True*2/3"])
def test_rejects_a_constant_that_is_no_integer_in_a_sum(text: str) -> None:
    with pytest.raises(Rejected) as info:
        of_x_and_y().polynomial(text)
    assert refused(info.value, Kind.TERM)
