"""Facts that fail over the box of the others are closed, and others are not."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from juggleproof.algebra.conditions import Condition
from juggleproof.certificates import checker
from juggleproof.search.boxes.over_box import box_of, close_over_box
from juggleproof.search.boxes.squares import close_by_bounds
from juggleproof.search.closing import Closing
from juggleproof.search.hints.few_values import point_by_few_values
from juggleproof.smtlib.answering import ScriptQuestion, answer
from juggleproof.statements.language import NO_ROLES
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

# a polynomial, a box and a rational a little below and a little above the minimum, from
# Munoz and Narkawicz, Journal of Automated Reasoning 51 (2013), and Goldstein and Price (1971)
CAPRASSE = (
    "-x*z^3 + 4*y*z^2*w + 4*x*z*w^2 + 2*y*w^3 + 4*x*z + 4*z^2 - 10*y*w - 10*w^2 + 2",
    dict.fromkeys("xyzw", ("-1/2", "1/2")),
    ("-32/10", "-31/10"),
)
GOLDSTEIN = (
    "(1 + (x + y + 1)^2*(19 - 14*x + 3*x^2 - 14*y + 6*x*y + 3*y^2))"
    "*(30 + (2*x - 3*y)^2*(18 - 32*x + 12*x^2 + 48*y - 36*x*y + 27*y^2))",
    dict.fromkeys("xy", ("-2", "2")),
    ("29/10", "31/10"),
)


def state(text: str, names: Sequence[str]) -> SearchState:
    context = checker.Context()
    for name in names:
        context.declare(name)
    return SearchState(context).assume(context.formula(checker.parse(text)))


@each_row("poly, box, ends", [CAPRASSE, GOLDSTEIN])
@each_row("relation", ["<", "<="])
def test_a_minimum_over_a_box_is_proved_below_and_met_above_holds(
    poly: str, box: dict[str, tuple[str, str]], ends: tuple[str, str], relation: str
) -> None:
    inside = " and ".join(
        f"{low} <= {name} and {name} <= {high}" for name, (low, high) in box.items()
    )
    head, words = f"statement f/c\nforall {' '.join(box)}\nshow not ({inside} and ", []
    for value in ends:
        words.append(answer(ScriptQuestion("f/c", (f"{head}{poly} {relation} {value})",))).word)
    assert words == ["unsat", "sat"]


# minima that small trees do not reach: of the extended valley of Rosenbrock, which is 0, and of the
# same less x0 x2 / 10, which is not met at a rational point
VALLEY = " + ".join(f"100*(x{k + 1} - x{k}^2)^2 + (1 - x{k})^2" for k in range(2))
PRODUCT = "*".join(f"(1 - x{k})" for k in range(12))


@each_row("text", [f"{VALLEY} < 0", f"{VALLEY} <= -1/1000", f"{VALLEY} - x0*x2/10 < -1/8"])
def test_a_valley_is_closed_by_squares_holds(text: str) -> None:
    inside = " and ".join(f"-2 <= x{k} and 2*x{k} <= 4" for k in range(3))
    one = state(f"{inside} and {text}", ("x0", "x1", "x2"))
    node = close_by_bounds(one, 1000, Budget(10**6))
    assert node is not None and one.is_closed_by(node, {})


def test_a_valley_that_is_met_stays_open_holds() -> None:
    inside = " and ".join(f"-2 <= x{k} and x{k} <= 2" for k in range(3))
    one = state(f"{inside} and {VALLEY} <= 0", ("x0", "x1", "x2"))
    assert close_by_bounds(one, 1000, Budget(10**6)) is None


def test_a_product_of_many_variables_is_closed_holds() -> None:
    """Faces make its tree short: its Bernstein form has 4096 coefficients."""
    names = [f"x{k}" for k in range(12)]
    inside = " and ".join(f"0 <= {name} and {name} <= 1" for name in names)
    one = state(f"{inside} and {PRODUCT} + {' + '.join(names)} < 1", names)
    node = close_over_box(one, 40, Budget(10**6))
    assert node is not None and one.is_closed_by(node, {})


def test_the_closest_bounds_are_taken_holds() -> None:
    one = state("x > 0 and 2*x >= 1 and x <= 3 and x < 2 and y >= 0 and z >= 1 and z <= 1", "xyz")
    ((name, (low, high)),) = box_of(one).items()
    assert name == "x" and (low.at, low.fact, high.at, high.fact) == (1 / 2, 1, 2, 3)


def test_a_fact_with_an_unbounded_variable_stays_open_holds() -> None:
    one = state("x >= 0 and x <= 1 and y >= 0 and x*y < 0", "xy")
    assert close_over_box(one, 100, Budget(10**6)) is None


def test_the_work_is_counted_holds() -> None:
    poly, box, (low, _) = CAPRASSE
    inside = " and ".join(
        f"{left} <= {name} and {name} <= {right}" for name, (left, right) in box.items()
    )
    with pytest.raises(Exhausted):
        close_over_box(state(f"{inside} and {poly} < {low}", "xyzw"), 100, Budget(5))


def test_terms_of_large_polynomials_are_counted_holds() -> None:
    names = "abcdefghij"  # a product of sums, of 2^10 terms
    inside = " and ".join(f"0 <= {x} and {x} <= 1" for x in names)
    large = state(f"{inside} and {'*'.join(f'(1 + {x})' for x in names)} < 1/2", names)
    with pytest.raises(Exhausted):
        close_by_bounds(large, 9, Budget(2**10))
    condition = Condition.of(large.context, ("atom", *large.facts[-1]))
    budget = Budget(10**4)
    with pytest.raises(Exhausted):
        point_by_few_values(condition, budget, NO_ROLES)
    assert budget.left == 10**4  # refused ahead of the work
    with pytest.raises(Exhausted):
        Closing({}, Budget(400), 2).problem(large)
