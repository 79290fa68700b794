"""One variable is complete: what has no solution is closed, whatever the coefficients, and one more
line that holds loses nothing.
"""

from __future__ import annotations

from random import Random

from juggleproof.certificates import checker
from juggleproof.search.one_variable import close_in_one_variable
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget
from tests.rows import each_row

NUMBERS = ("0", "1", "-2", "1/2", "-7/5", "1414213563/1000000000", "2000001/1000000")
RELATIONS = ("<", "<=", "=", "!=", ">=", ">")
BUDGET = 10**7


def state(text: str) -> SearchState:
    context = checker.Context()
    context.declare("x")
    return SearchState(context).assume(context.formula(checker.parse(text)))


def closed(text: str) -> bool:
    """Whether a node was found, which the checker accepts."""
    whole = state(text)
    node = close_in_one_variable(whole, Budget(BUDGET))
    assert node is None or whole.is_closed_by(node, {}), text
    return node is not None


CLOSED = (
    "x^2 <= 2 and x >= 1414213563/1000000000 and x <= 2",
    "x^2 = 2 and x^3 != 2*x",
    "x^2 = 2 and x^4 - 4 > 0",
    "x^2 > 2 and x^4 < 4",
    "(x^2 - 2)^3 < 0 and (x^2 - 2)^2*x > 0 and x > 3/2",
    "x^4 + x + 1 <= 0",
    "x^5 - x - 1 = 0 and (x < 1 or x > 6/5)",
    "(x = 1 or x = 2 or x > 5) and x^2 - 6*x + 7 > 0 and x < 5 and x != 1",
    "x^2 < 0",
    "x - x = 1",
)


@each_row("text", CLOSED)
def test_what_has_no_solution_is_closed_holds(text: str) -> None:
    assert closed(text)
    for more in ("x <= 10", "x >= -10", "x^2 + 1 > 0", "x <= 10^9", "(x - 1/3)^2 >= 0"):
        assert closed(f"{text} and {more}"), more


OPEN = (
    "x^2 <= 2 and x >= 1414213562/1000000000 and x <= 2",
    "x^2 = 2 and x^4 - 4 >= 0",
    "x^2 >= 2 and x^4 <= 4",
    "x^5 - x - 1 = 0 and (x < 1 or x > 1)",
)


@each_row("text", OPEN)
def test_what_has_a_solution_stays_open_holds(text: str) -> None:
    assert not closed(text)


def _polynomial(rng: Random, depth: int) -> str:
    if depth == 0 or rng.random() < 1 / 3:
        return rng.choice(["x", "x", "x^2", "x^3", *NUMBERS])
    return f"({_polynomial(rng, depth - 1)} {rng.choice('+-**')} {_polynomial(rng, depth - 1)})"


@each_row("seed", range(2))
def test_random_conditions_are_closed_or_met_at_a_sample_holds(seed: int) -> None:
    """A condition that is left open with strict relations alone holds on an interval, which a fine
    grid meets, or the roots are close together: none of these is.
    """
    rng, counts = Random(seed), [0, 0]
    for _ in range(40):
        parts = [
            f"{_polynomial(rng, 2)} {rng.choice('<>')} {_polynomial(rng, 1)}"
            for _ in range(rng.randint(1, 4))
        ]
        text = " and ".join(parts)
        one = state(text)
        polys = [_at_fractions(poly, 97) for poly, _ in one.facts]
        met = not one.closed and any(
            all(sum(c * k**m for m, c in poly) > 0 for poly in polys) for k in range(-4000, 4000)
        )
        assert closed(text) is not met, text
        counts[met] += 1
    assert min(counts) > 5


def _at_fractions(poly: checker.Poly, n: int) -> list[tuple[int, int]]:
    """(exponent, coefficient) of a polynomial that has at k the sign of this one at k/n."""
    degree = max(poly.terms, default=0)
    return [(m, c * n ** (degree - m)) for m, c in poly.terms.items()]
