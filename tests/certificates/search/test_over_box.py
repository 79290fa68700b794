"""Facts that fail over the box of the others are closed, and others are not."""

from __future__ import annotations

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.search.over_box import box_of, close_over_box
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget, Exhausted
from juggleproof.proofs.smtlib.answering import Question, answer

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


def state(text: str, names: str) -> State:
    context = checker.Context()
    for name in names:
        context.declare(name)
    return State(context).assume(context.formula(checker.parse(text)))


@pytest.mark.parametrize("poly, box, ends", [CAPRASSE, GOLDSTEIN])
@pytest.mark.parametrize("relation", ["<", "<="])
def test_a_minimum_over_a_box_is_proved_below_and_met_above_holds(
    poly: str, box: dict[str, tuple[str, str]], ends: tuple[str, str], relation: str
) -> None:
    inside = " and ".join(
        f"{low} <= {name} and {name} <= {high}" for name, (low, high) in box.items()
    )
    head, words = f"statement f/c\nforall {' '.join(box)}\nshow not ({inside} and ", []
    for value in ends:
        words.append(answer(Question("f/c", (f"{head}{poly} {relation} {value})",))).word)
    assert words == ["unsat", "sat"]


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
