"""Sharp ranges of claims: whole numbers tied to alpha, a single point, what holds on the whole
range left out, names of end points, no range line left out, nowhere only where nothing holds.
"""

from dataclasses import replace
from fractions import Fraction

import pytest
from flint import fmpq_poly

from juggleproof.algebra.numbers import real_roots
from juggleproof.certificates import checker
from juggleproof.judging.claims import Assertion, Claim
from juggleproof.judging.forms import always, speaks_of_range
from juggleproof.judging.judge import Judge, judge
from juggleproof.judging.judgement import Resources, Sharp
from juggleproof.judging.searches.range_search import line_text, search_sharp_range, text_of_range
from juggleproof.search.ranges import CutDomain
from juggleproof.statements.language import (
    ClaimError,
    Roles,
    Statement,
    conjunction,
    real,
    reals,
)
from juggleproof.statements.work import read
from tests.rows import each_row

alpha, K, n, k, x = reals("alpha K n k x")
WHOLE = (("range", alpha > 0), ("range", alpha < 1))
ROLES = Roles({"alpha": (alpha > 0, alpha < 1)})
BUDGET = 6_000_000
CEILING = Statement(
    "round/up",
    ("alpha", "n", "k"),
    (*WHOLE, ("given", n * (1 - alpha) >= 1 + alpha), ("given", (n - 1) * (1 - alpha) < 1 + alpha)),
    show=~((k <= n) & (k >= n))
    | (k * (1 - alpha) <= 1 + alpha) & ((k + 1) * (1 - alpha) > 1 + alpha),
    integer=("n", "k"),
)


def sought(*statements, over=("alpha",)):
    """(the display, the sharp statement, its certificate, the statements by name)."""
    found = search_sharp_range("round/sharp", statements, over, {}, BUDGET, ROLES)
    assert found is not None
    sharp, certificate = found
    return (
        text_of_range(sharp.text(), statements, over, ROLES, BUDGET),
        read(sharp.text(), sharp.name),
        certificate,
        {one.name: read(one.text(), one.name) for one in statements},
    )


def test_rounding_up_holds_where_nothing_is_rounded():
    shown, sharp, certificate, named = sought(CEILING)
    assert shown == "alpha = (n - 1)/(n + 1) for a whole number n"
    assert checker.check_one(sharp, {"certified": certificate}, {}, named) == ("certified", None)


def test_rounding_up_fails_without_the_condition():
    sharp, certificate = search_sharp_range("round/sharp", [CEILING], ("alpha",), {}, BUDGET, ROLES)
    everywhere = replace(sharp, condition=alpha > 0)
    outcome, _ = checker.check_one(
        read(everywhere.text(), "round/sharp"),
        {"certified": certificate},
        {},
        {"round/up": read(CEILING.text(), "round/up")},
    )
    assert outcome == "rejected"


def test_single_point_is_told_as_one():
    point = Statement(
        "point/root",
        ("alpha",),
        WHOLE,
        show=(alpha**3 - 33 * alpha**2 - alpha + 1 <= 0)
        & (alpha**3 - 33 * alpha**2 - alpha + 1 >= 0),
    )
    shown, sharp, certificate, named = sought(point)
    assert shown == "alpha = c1; c1 = 0.159938682399..., a root of alpha^3 - 33*alpha^2 - alpha + 1"
    ((_, (_, low, high)),) = sharp.get("number")
    assert (low.value, high.value) == (0, 1)
    assert checker.check_one(sharp, {"certified": certificate}, {}, named) == ("certified", None)


def test_every_root_in_the_domain_has_its_number_line():
    # 10 a^3 - 20 a^2 + 10 a - 1 has two roots in (0, 1); only the lower end is one of the set.
    cubic = Statement(
        "roots/two",
        ("alpha",),
        WHOLE,
        show=(10 * alpha**3 - 20 * alpha**2 + 10 * alpha - 1 < 0) & (2 * alpha < 1),
    )
    shown, sharp, certificate, named = sought(cubic)
    assert shown.startswith("0 < alpha < c1; c1 = 0.")
    assert [name for name, _ in sharp.get("number")] == ["c1", "c2"]
    assert checker.check_one(sharp, {"certified": certificate}, {}, named) == ("certified", None)


def test_end_points_are_told_under_their_names_in_the_statement():
    second = real_roots(fmpq_poly([-1, 10, -20, 10]))[1]
    poly = 10 * alpha**3 - 20 * alpha**2 + 10 * alpha - 1
    numbers = (("c1", poly, Fraction(0), Fraction(1, 2)), ("c2", poly, Fraction(1, 2), Fraction(1)))
    assert line_text(
        CutDomain((second,), (False, False, True)), "alpha", numbers, (("0", "<"), ("1", "<"))
    ).startswith("c2 < alpha < 1; c2 = 0.")


def test_what_holds_on_the_whole_range_is_left_out():
    sure = Statement("", ("alpha", "x"), WHOLE, show=alpha * x**2 >= 0).named("sure")
    third = Statement("", ("alpha",), WHOLE, show=3 * alpha <= 1).named("third")
    claim = Claim(
        "left-out", "", "", "one part holds for every alpha", lambda: Assertion((sure, third))
    )
    judgement = judge(claim, Resources(routes=("exact",)))
    assert judgement.sharp[""] == Sharp("0 < alpha <= 1/3", ("left-out/sharp", "left-out/sure"))
    assert "sharp left-out/third" in dict(judgement.statements)["left-out/sharp"].splitlines()


def test_a_range_among_the_givens_counts():
    low, high, none = (
        ("given", real("alpha") > 0),
        ("given", real("alpha") < 1),
        ("given", real("alpha") >= 0),
    )
    assert speaks_of_range(Statement("a/b", ("alpha",), (low, high), show=alpha < 2), ROLES.domains)
    assert not speaks_of_range(Statement("a/b", ("alpha",), (none,), show=alpha < 2), ROLES.domains)
    assert not speaks_of_range(
        Statement("a/b", ("x",), (("given", x > 0),), show=conjunction([])), ROLES.domains
    )


a, b, q, y = reals("a b q y")
UNIT = (a > 0, a < 1)


def told(*statements, parameters=None):
    """The display of the sharp range of a claim that asserts these."""
    claim = Claim(
        "own", "", "", "what they say", lambda: Assertion(statements), parameters=parameters
    )
    sharp = judge(claim, Resources(routes=("exact",))).sharp.get("")
    return sharp and sharp.text


@each_row(
    ("statement", "parameters"),
    [
        (always(a * q < 1, in_range=UNIT, given=[q > 0, q < 1]), ("q",)),
        (always(2 * a * b < 1, in_range=[*UNIT, b > 0, b < a]), ("a",)),
        (always(a > 0, in_range=[*UNIT, (2 * a > 1) | (b > 0)], given=[b < 5]), ("a",)),
    ],
)
def test_rejects_range_that_leaves_out_a_line_of_another_variable(statement, parameters):
    assert told(statement, parameters=parameters) == "not found"


def test_range_lines_of_two_variables_are_both_replaced_holds():
    product = always(a * q < 1, in_range=[*UNIT, q > 2, q < 3])
    assert told(product) == "0 < a < 1/q"
    roles = Roles({"a": UNIT, "q": (q > 2, q < 3)})
    text = "statement own/sharp\nsharp own/main\nover a\ndomain a > 0 and a < 1\nholds 0 = 1"
    assert text_of_range(text, [product.named("own/main")], ("a", "q"), roles, BUDGET) is None


@each_row(
    ("show", "domain", "shown"),
    [
        (a**2 < 2, [a**2 < 1], "a^2 < 1"),
        (a**2 > 1, [a**2 > 2], "a^2 > 2"),
        (2 * a < 1, [a**2 < 1], "not found (not on the whole domain)"),
    ],
)
def test_a_domain_that_is_not_linear_is_told_whole_holds(show, domain, shown):
    assert told(always(show, in_range=domain)) == shown


def test_rejects_nowhere_for_a_refutation_at_some_parameters_only():
    part = always(4 * a < 3, given=[2 * a > 1, a < 1])
    assert told(always(a + y**2 > 0, in_range=UNIT), part) == "0 < a < 3/4"
    assert told(always(a + y**2 > 0, in_range=UNIT), always(y**2 > 1)) == "nowhere"


def test_rejects_range_beside_a_statement_that_is_not_settled():
    open_part = always(y**2 >= 0)
    refuted = always(2 * a < 1, in_range=UNIT)
    claim = Claim("own", "", "", "what they say", lambda: Assertion((refuted, open_part)))
    one = Judge(claim, Resources(routes=("exact",)))
    one.judgement.roles = Roles({"a": UNIT})
    one.judgement.outcomes = {"own/main": "refuted", "own/main-2": "unknown"}
    assert one.find_sharp_range("", Assertion((refuted, open_part))) is None


@each_row(
    "statements",
    [
        [always(2 * a < 1, in_range=UNIT, label="sharp")],
        [always(y**2 >= 0), always(y**4 >= 0), always(y**6 >= 0, label="main-2")],
    ],
)
def test_rejects_two_statements_of_one_name(statements):
    with pytest.raises(ClaimError, match=r": own/\S+ is the name of two statements, .*a label$"):
        told(*statements)
