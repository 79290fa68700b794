"""The encoder and SymPy agree at random rationals, on random expressions and on everything that is
derived.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import pytest
import sympy
from hypothesis import assume, given
from hypothesis import strategies as st

from juggleproof import symbolic
from juggleproof.encoding import from_sympy
from juggleproof.proofs.deriving import encoded
from juggleproof.statements.language import ClaimError
from tests.reading.paper_names import value_at

NAMES = sympy.symbols("x y alpha")
RATIONALS = st.builds(Fraction, st.integers(-35, 35), st.integers(1, 7))


def expressions() -> st.SearchStrategy[sympy.Expr]:
    leaves = st.one_of(
        st.sampled_from(NAMES), RATIONALS.map(lambda q: sympy.Rational(q.numerator, q.denominator))
    )

    def grown(inner: st.SearchStrategy[sympy.Expr]) -> st.SearchStrategy[sympy.Expr]:
        pairs = st.tuples(inner, inner)
        return st.one_of(
            pairs.map(lambda p: p[0] + p[1]),
            pairs.map(lambda p: p[0] * p[1]),
            pairs.map(lambda p: p[0] - p[1]),
            pairs.map(lambda p: -p[0] / (2 * p[1])),
            st.tuples(inner, st.integers(-2, 2)).map(lambda p: p[0] ** p[1]),
        )

    return st.recursive(leaves, grown, max_leaves=6)


def exact(expression: sympy.Expr, point: dict[str, Fraction]) -> Fraction:
    value = expression.subs(
        {
            sympy.Symbol(name): sympy.Rational(q.numerator, q.denominator)
            for name, q in point.items()
        }
    )
    assert value.is_Rational, value
    return Fraction(int(value.p), int(value.q))


@given(expressions(), st.lists(RATIONALS, min_size=3, max_size=3))
def test_encoder_agrees_with_sympy_holds(expression: sympy.Expr, values: list[Fraction]) -> None:
    assume(not expression.has(sympy.zoo, sympy.nan, sympy.oo))
    point = dict(zip(("x", "y", "alpha"), values))
    try:
        encoded_value = value_at(from_sympy(expression), point)
    except ZeroDivisionError:
        return
    assert encoded_value == exact(expression, point)


OTHER_ROOTS = {
    "worst_flight_time",
    "time_to_enter_region",
}  # the root of an energy, or a ceiling: no name of the paper's vocabulary


def derivations() -> Iterator[tuple[str, sympy.Expr | sympy.MatrixBase]]:
    """What `symbolic` derives without arguments: expressions, columns and matrices, by name."""
    for name in dir(symbolic):
        function = getattr(symbolic, name)
        if isinstance(function, type) or not getattr(function, "cache_info", None):
            continue
        try:
            value = function()
        except TypeError:
            continue
        if isinstance(value, (sympy.Expr, sympy.MatrixBase)):
            yield name, value


def test_derived_expressions_are_encoded_as_they_are_holds() -> None:
    found = 0
    for name, value in derivations():
        if name in OTHER_ROOTS:
            with pytest.raises(ClaimError):
                encoded(value)
            continue
        found += 1
        terms = encoded(value)
        if not hasattr(terms, "entries") and hasattr(terms, "rows"):
            listed = [entry for row in terms.rows for entry in row]
        else:
            listed = list(getattr(terms, "entries", [terms]))
        entries = list(value) if isinstance(value, sympy.MatrixBase) else [value]
        names = sorted({str(symbol) for entry in entries for symbol in entry.free_symbols})
        alpha = Fraction(1, 8)  # 2 (1 + alpha) = (3/2)^2
        for shift in range(3):
            point = {one: Fraction(3 * i + 2 + shift, i + 2) for i, one in enumerate(names)} | {
                "alpha": alpha,
                "s": Fraction(3, 2),
            }
            plain = {one: q for one, q in point.items() if one != "s"}
            for entry, term in zip(entries, listed, strict=True):
                assert value_at(term, point) == exact(sympy.sympify(entry), plain), name
    assert found > 90


def test_encoder_rejects_floats_and_functions() -> None:
    for bad in (sympy.Float("0.5"), sympy.sin(NAMES[0]), sympy.sqrt(NAMES[0])):
        with pytest.raises(ClaimError):
            from_sympy(bad)
