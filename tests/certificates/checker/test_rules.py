"""Every rule, from its tables: certificates that it accepts, and defects that it rejects with the
reason that names them.
"""

from __future__ import annotations

from fractions import Fraction

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind
from juggleproof.statements.states import closes, finds, proves
from tests.certificates.checker.harness import CLOSE, Case, judge, lines, refused
from tests.certificates.checker.rules import TABLES


def named(table: str) -> list[object]:
    return [
        pytest.param(case, id=f"{rule}: {case.defect}")
        for rule, module in TABLES.items()
        for case in getattr(module, table)
    ]


@pytest.mark.parametrize("case", named("ACCEPTED"))
def test_accepts(case: Case) -> None:
    assert judge(case) == (case.expected, None)


@pytest.mark.parametrize("case", named("REJECTED"))
def test_rejects(case: Case) -> None:
    outcome, reason = judge(case)
    assert outcome in ("rejected", "unreadable")
    assert refused(reason, case.expected), reason


@pytest.mark.parametrize("text", ["0", "x", "-1/2*y + x^2", "-3*x*y^2 + 7/3", "-y + 11*x"])
def test_a_polynomial_is_shown_as_text_that_reads_back(text: str) -> None:
    context = checker.Context()
    for name in ("x", "y"):
        context.declare(name)
    assert context.show(context.polynomial(text)) == text


def test_rejects_coefficients_of_a_quotient() -> None:
    context = checker.Context()
    context.declare("x")
    x = context.values["x"]
    assert checker.univariate(context, x * x, "x") == [0, 0, 1]
    with pytest.raises(checker.Rejected) as info:
        checker.univariate(context, x.over({(x, True): 2}), "x")
    assert refused(info.value, (Kind.ONE_VARIABLE, "x: x"))
    one = context.number(1)
    assert (one.constant(), one.over({(x, True): 1}).constant()) == (1, None)


def test_parts_of_a_certificate_are_judged_alone() -> None:
    """What a search asks: on a meter of its own, whatever the formulas have spent of theirs."""
    spent = checker.Work(1000)
    context = checker.Context(work=spent)
    context.declare("n", True)
    context.declare("x")
    n, x = (checker.fold(context.values[name], ">") for name in ("n", "x"))
    below_1, below_0, real = (
        checker.fold(context.polynomial(text), ">") for text in ("1 - n", "0 - x - n", "1 - x")
    )
    either = checker.join("or", [below_1, below_0])
    last = ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]
    assert closes(context, [n, below_1], ["integral", 0, last], {})
    together = checker.join("and", [n, below_1])
    spent.left = 0
    assert closes(context, [together], ["integral", 0, last], {})
    assert not closes(context, [x, real], ["integral", 0, last], {})
    assert not closes(context, [n], ["integral", 0, last], {})
    sums = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]
    both = [
        "cases",
        0,
        [["integral", 0, ["psatz", [[1, [[2, 1]], "1"], [1, [[3, 1]], "1"]], []]], sums],
    ]
    assert closes(context, [n, x, either], both, {})
    assert not closes(context, [n, x], both, {})
    assert closes(context, [False], CLOSE, {})
    assert not closes(context, [True, n], CLOSE, {})
    (statement,) = checker.read_statements(lines("forall x", "given x > 0", "show x > -1")).values()
    shown = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"], [1, [], "1"]], []]
    assert proves(statement, ["proof", [], shown], {})
    assert not proves(statement, ["proof", [], CLOSE], {})
    met = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]
    for found, assumed, base, holds in (
        (["rule/case", [], {"x": "1"}, CLOSE], [], [], True),
        (["rule/case", [], {"x": "0"}, CLOSE], [], [], False),
        (["rule/case", [], {}, met], [x], ["x"], True),
        (["rule/case", [], {}, met], [], ["x"], False),
    ):
        assert finds(context, assumed, found, {}, "point", statement, base) is holds


def test_every_case_has_a_name_of_its_own() -> None:
    for module in TABLES.values():
        defects = [case.defect for case in [*module.ACCEPTED, *module.REJECTED]]
        assert len(set(defects)) == len(defects)


def test_a_polynomial_has_its_terms_and_bounds_on_them() -> None:
    context = checker.Context()
    context.declare("x")
    context.declare("y")
    x, y = context.values["x"], context.values["y"]
    third = context.number(Fraction(-5, 3))
    shown = [
        (context.show(p), p.deg, p.bits)
        for p in (x, third, context.number(0), x + y, x - third, third * x * y, (x + y) ** 2, x**3)
    ]
    # deg: of a product the sum; bits: 2^bits is at least the sum of the absolute coefficients
    assert shown == [
        ("x", 1, 0),
        ("-5/3", 0, 3),
        ("0", 0, 0),
        ("y + x", 1, 1),
        ("x + 5/3", 1, 4),
        ("-5/3*x*y", 2, 3),
        ("y^2 + 2*x*y + x^2", 2, 2),
        ("x^3", 3, 0),
    ]


@pytest.mark.parametrize("factor", ["2^3999", "1/2^3999", "(-2^3999)", "(2/3)^2500"])
def test_rejects_a_product_of_long_numbers_before_it_grows(factor: str) -> None:
    with pytest.raises(checker.Rejected) as info:
        context = checker.Context(work=checker.Work(checker.MAX_WORK))
        context.value(checker.parse("*".join([f"({factor})"] * 11)))
    assert refused(info.value, (Kind.SIZE, "4"))
