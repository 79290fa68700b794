"""Small proofs: an exact linear program adds up products of at most two facts, and squares, to 0;
and linear facts.

Nothing here needs floats: so it is tried before what is dear to load.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, combinations_with_replacement

from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.small_proofs.linear_system import (
    ONE,
    Farkas,
    Row,
    search_linear,
    solve,
)
from juggleproof.statements.nodes import Certificate, Node, Point, Power
from juggleproof.statements.states import SearchState, state_of, variables_in
from juggleproof.statements.work import Budget, Exhausted, unfolded


def search_by_pairs(statement: checker.Statement, budget: Budget) -> Certificate | None:
    """The certificate of a statement for all reals without givens, or of a linear one; None where
    none is found with little work.

    >>> text = "statement a/b\\nforall x\\nshow not (x > 1 and x^2 < 1)"
    >>> search_by_pairs(checker.read_statements(text)["a/b"], Budget(10**5))["certified"][2]
    ('psatz', [('2', ((0, 1),), '1'), ('1', ((1, 1),), '1'), ('1', (), 'x - 1')], [])
    """
    found = search_linear(statement, budget.part(limits.LINEAR_WORK))
    if found is not None or any(map(statement.get, ("exists", "integer", "root"))):
        return found
    unfolding = unfolded(statement)
    if unfolding.obligations or unfolding.premises:
        return None
    try:
        state = state_of(unfolding).branch(unfolding.goal(False))
        node = close_by_pairs(state, budget.part(limits.PAIRS_WORK))
    except Exhausted:
        return None
    if node is None:
        return None
    anywhere = Point(statement.name, [], dict.fromkeys(unfolding.universal, "0"), ("close",))
    return {"certified": ("proof", [], node), "point": anywhere}


def close_by_pairs(state: SearchState, budget: Budget, cases: int = 1) -> Node | None:
    """A node that closes the state: by its facts, or by the cases of its disjunctions."""
    if state.closed:
        return ("close",)
    node = leaf_by_pairs(state, budget)
    if node is not None or not state.choices:
        return node
    alternatives = state.choices[0]
    cases *= len(alternatives)
    if cases > limits.PAIRS_CASES:
        return None
    rest, nodes = state.branch(), list[Node]()
    del rest.choices[0]
    for alternative in alternatives:
        part = close_by_pairs(rest.branch(alternative), budget, cases)
        if part is None:
            return None
        nodes.append(part)
    return "cases", 0, nodes


# a polynomial, its sign, and what it is: powers of facts times the square of a root, or an equation
# times a monomial
Summand = tuple[checker.Poly, str, tuple[Sequence[Power], str] | tuple[int, str]]


def leaf_by_pairs(state: SearchState, budget: Budget) -> Node | None:
    """A node by the facts of a state alone, of single facts or of pairs and squares."""
    used = {name for poly, _ in state.facts for name in variables_in(state.context, poly)}
    names = [name for name in state.context.index if name in used]
    if len(state.facts) > limits.PAIRS_FACTS or len(names) > limits.PAIRS_VARIABLES:
        return None
    for summands in (singles(state), [*singles(state), *pairs(state, names)]):
        found = solve([(row_of(poly), relation) for poly, relation, _ in summands], budget)
        if isinstance(found, Farkas):
            return node_of(summands, found)
    return None


def row_of(poly: checker.Poly) -> Row:
    """The coefficients of a polynomial, times its denominator, by monomials."""
    return {m or ONE: c for m, c in poly.terms.items()}


def singles(state: SearchState) -> list[Summand]:
    """The facts, those != 0 squared."""
    found: list[Summand] = []
    for k, (poly, relation) in enumerate(state.facts):
        if relation == "=":
            found.append((poly, "=", (k, "1")))
        elif relation == "!=":
            found.append((poly * poly, ">", (((k, 2),), "1")))
        else:
            found.append((poly, relation, (((k, 1),), "1")))
    return found


def pairs(state: SearchState, names: Sequence[str]) -> list[Summand]:
    """The products of two facts, squares of simple terms, and equations times variables."""
    found: list[Summand] = []
    signed = [(k, *fact) for k, fact in enumerate(state.facts) if fact[1] in (">", ">=")]
    for (i, p, one), (j, q, two) in combinations_with_replacement(signed, 2):
        powers = ((i, 1), (j, 1)) if i != j else ((i, 2),)
        found.append((p * q, ">" if one == two == ">" else ">=", (powers, "1")))
    roots = [root for name in names for root in (name, f"{name} - 1", f"{name} + 1")]
    roots += [f"{a} {sign} {b}" for a, b in combinations(names, 2) for sign in "+-"]
    for root in roots:
        square = state.context.polynomial(root)
        found.append((square * square, ">=", ((), root)))
    for k, (poly, relation) in enumerate(state.facts):
        if relation == "=":
            found += [(poly * state.context.values[name], "=", (k, name)) for name in names]
    return found


def node_of(summands: Sequence[Summand], found: Farkas) -> Node:
    """The node that adds up summands by these multiples."""
    products: list[tuple[str, Sequence[Power], str]] = []
    products += [(str(found.one), (), "1")] if found.one else []
    cofactors: dict[int, list[str]] = {}
    for k, multiple in sorted(found.multiples.items()):
        poly, _, (what, text) = summands[k]
        weight = str(Fraction(multiple * poly.den))
        if isinstance(what, int):
            cofactors.setdefault(what, []).append(f"{weight}*{text}")
        else:
            products.append((weight, what, text))
    return "psatz", products, [(k, " + ".join(parts)) for k, parts in cofactors.items()]
