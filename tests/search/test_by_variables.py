"""Nonnegative forms that are no sums of squares are closed; a form that takes a negative value is
not.
"""

from __future__ import annotations

from juggleproof.algebra.polynomials import Ring
from juggleproof.certificates import checker
from juggleproof.search.by_variables import close_by_variables
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget
from tests.rows import each_row

# Motzkin 1967; Robinson 1973; Choi and Lam 1977; Schmuedgen 1979; Delzell 1980
FORMS = {
    "Motzkin": ("xyz", "x^4*y^2 + x^2*y^4 + z^6 - 3*x^2*y^2*z^2"),
    "Robinson": (
        "xyz",
        "x^6 + y^6 + z^6 - x^4*y^2 - x^2*y^4 - x^4*z^2 - x^2*z^4 - y^4*z^2 - y^2*z^4"
        " + 3*x^2*y^2*z^2",
    ),
    "Choi and Lam": ("xyzw", "w^4 + x^2*y^2 + y^2*z^2 + z^2*x^2 - 4*x*y*z*w"),
    "Choi and Lam, S": ("xyz", "x^4*y^2 + y^4*z^2 + z^4*x^2 - 3*x^2*y^2*z^2"),
    "Schmuedgen": (
        "xyz",
        "200*((x^3 - 4*x*z^2)^2 + (y^3 - 4*y*z^2)^2)"
        " + (y^2 - x^2)*x*(x + 2*z)*(x^2 - 2*x*z + 2*y^2 - 8*z^2)",
    ),
    "Delzell": (
        "xyzw",
        "x^4*y^2*w^2 + y^4*z^2*w^2 + x^2*z^4*w^2 - 3*x^2*y^2*z^2*w^2 + z^8",
    ),
}


def closed(names: str, form: str) -> bool:
    """Whether a node was found, which the checker accepts."""
    context = checker.Context()
    for name in names:
        context.declare(name)
    state = SearchState(context).assume(context.formula(checker.parse(f"{form} < 0")))
    node: Node | None = close_by_variables(state, Ring(tuple(names)), Budget(10**6))
    assert node is None or state.is_closed_by(node, {})
    return node is not None


@each_row("name", FORMS)
def test_a_nonnegative_form_has_no_negative_value_holds(name: str) -> None:
    assert closed(*FORMS[name])


def test_a_form_is_nonnegative_fails_without_its_coefficient() -> None:
    assert not closed("xyz", "x^4*y^2 + x^2*y^4 + z^6 - 31/10*x^2*y^2*z^2")


def test_a_sum_of_other_degrees_is_left_to_others_holds() -> None:
    assert not closed("xy", "x^4*y^2 + x^2*y^4 + 1 - 3*x^2*y^2")
