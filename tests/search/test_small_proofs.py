"""The searches that come first: what they find the checker takes, and what they leave is left to
the whole search.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Union

from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.small_proofs.products_of_two import search_by_pairs
from juggleproof.search.small_proofs.searches_in_turn import certificates_in_turn
from juggleproof.search.small_proofs.simple_counterexamples import search_at_hand
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.work import Budget
from tests.rows import each_row

Search = Callable[[checker.Statement, Budget], Union[Certificate, None]]


def statement_of(names: str, formula: str, given: str = "") -> checker.Statement:
    text = f"statement a/b\nforall {names}\n{given}show not ({formula})"
    return checker.read_statements(text)["a/b"]


@each_row(
    ("names", "formula"),
    [
        ("x", "x^2 = 9 and x < 0"),
        ("x y", "x*y > 1 and x + y < -1"),
        ("x y z", "x*y = z and z > x + y and x != y"),
        ("a b c d e f", "a + b > c and (c > d or d*e*f = 1)"),
    ],
)
def test_a_point_at_hand_is_taken_holds(names: str, formula: str) -> None:
    statement = statement_of(names, formula)
    found = search_at_hand(statement, Budget(10**5))
    assert checker.check_one(statement, found, {}, {}) == ("refuted", None)


@each_row(
    ("names", "formula"),
    [
        ("x y", "x > 1 and y > 1 and x*y < 1"),
        ("x y z", "x*y + y*z + z*x > x^2 + y^2 + z^2"),
        ("x y", "x*y > 1 and x + y < 1 and x > 0"),
        ("x y", "x^2 + y^2 = 1 and x + y > 2"),
        ("x y", "(x > 1 or x < -1) and x^2 < 1 and y > x"),
        ("x y", "x/2 > y/3 and 3*x < 2*y"),
        ("x", "x != 0 and x^2 <= 0"),
        ("x y", "x = y and x*x < x*y"),
    ],
)
def test_a_contradiction_of_pairs_is_taken_holds(names: str, formula: str) -> None:
    statement = statement_of(names, formula)
    found = search_by_pairs(statement, Budget(10**5))
    assert checker.check_one(statement, found, {}, {}) == ("certified", None)
    assert search_at_hand(statement, Budget(10**5)) is None


@each_row("search", [search_at_hand, search_by_pairs])
def test_nothing_is_found_fails_without_budget(search: Search) -> None:
    assert search(statement_of("x y", "x^2*y > 90 and x*y < 1"), Budget(5)) is None


def test_contrary_givens_are_left_to_the_whole_search_holds() -> None:
    statement = statement_of("x", "x^2 > 2", "given x^2 < 0\n")
    assert search_by_pairs(statement, Budget(10**5)) is None


def test_too_many_variables_are_told_where_it_is_not_linear_holds() -> None:
    names = [f"x{k}" for k in range(limits.MOST_VARIABLES + 1)]
    whole = " and ".join(f"{a}*{b} > 5" for a, b in zip(names, names[1:]))
    *_, last = certificates_in_turn(statement_of(" ".join(names), whole), Budget(10**6))
    assert last == {"unknown": "it is not linear, in 121 variables; at most 120 are tried"}


@each_row(("above", "key"), [(148, "certified"), (149, "refuted")])
def test_many_variables_are_decided_where_all_is_linear_holds(above: int, key: str) -> None:
    names = [f"x{k}" for k in range(150)]
    steps = " and ".join(f"{b} >= {a} + 1" for a, b in zip(names, names[1:]))
    whole = f"{steps} and x149 < x0 + {above} + 1/2"
    *_, last = certificates_in_turn(statement_of(" ".join(names), whole), Budget(2 * 10**6))
    assert key in last
