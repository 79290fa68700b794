"""Statements that the tests of this folder share, with short ways to read them."""

from typing import Any

from juggleproof.certificates import checker
from juggleproof.search.points import search_values
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget


def search_points(statement: checker.Statement, units: Budget, effort: int = 0) -> tuple[Any, Any]:
    """(a point that meets the premises, a counterexample), each as the checker accepts it, or
    None.
    """
    state = SearchState(checker.Context())
    counterexample = search_values(statement, state, "counterexample", {}, {}, units, effort=effort)
    if counterexample is not None:
        return counterexample[:4], counterexample
    return search_values(statement, state, "point", {}, {}, units, effort=effort), None


def read(text: str) -> checker.Statement:
    """The one statement of a text."""
    (statement,) = checker.read_statements(text).values()
    return statement


def budget() -> Budget:
    """Enough counted work for any one search of these tests."""
    return Budget(10**8)


UNIT = "range 0 < alpha and alpha < 1"

CONTRACTION = f"""statement paper/contraction
forall alpha
{UNIT}
have 1 - alpha > 0
let kappa = alpha*(1 + 3*alpha)/(1 - alpha)
show kappa < 1"""

SECOND_ORBIT = f"""statement paper/second-orbit
forall alpha
{UNIT}
have 1 + alpha > 0
exists x w
show w = 4/(1 + alpha) and x = 2*(3*alpha - 1)/(1 + alpha)^2 and x >= 0"""

POINT_OUTSIDE = f"""statement paper/p-outside
forall alpha
{UNIT}
have 1 - alpha > 0
have 1 + alpha > 0
show 4/(1 + alpha) + (1 - alpha)^2/(2*(1 + alpha)^2) > (1 + alpha)/(1 - alpha)^2"""

SUPREMUM = f"""statement paper/supremum
forall alpha r
{UNIT}
given r > 0
have 1 - alpha > 0
root s = sqrt(2*(1 + alpha))
show (-(1 + alpha)/(1 - alpha) + 1 + alpha - s*alpha/(1 - alpha))*(1 + alpha)*r^2 < 0"""

REGION = f"""statement paper/region
forall alpha x w
{UNIT}
have 1 - alpha > 0
let S = (1 + alpha)/(1 - alpha)^2
given 0 <= x and x < w and 2*x + (1 - w)^2/2 <= S
show 2*alpha*(w - x) + (1 - alpha*w)^2/2 <= S and alpha*(w - x) >= 0"""

LEVEL = f"""statement paper/level
forall alpha x w
{UNIT}
have 1 - alpha > 0
given x >= w and x >= 0 and 2*x + (1 - w)^2/2 <= (1 + alpha)/(1 - alpha)^2
show x - w < w + 2 or w <= 0"""

TRAP = f"""statement paper/trap
forall alpha x w
{UNIT}
given 0 <= x and x < w and w < 3
show alpha*w < 2 and alpha*(w - x) <= 1"""

# The image's velocity is misprinted here: the region is left through a corner whose place is a
# square root in alpha.
VERTEX = f"""statement paper/vertex
forall alpha r g beta v
{UNIT}
given r > 0 and g > 0
have 1 - alpha > 0
let S = (1 + alpha)*r^2/(1 - alpha)^2
given beta >= 0 and g*beta/2 + r*v < r^2 and g*beta + v^2/2 <= S
let height = -alpha*beta - alpha*(2*r/g)*v + alpha*(2*r/g)*r
let velocity = -alpha*v + (3*alpha - 1)*r
show height >= 0 and g*height + velocity^2/2 <= S"""
