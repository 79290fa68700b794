"""What the functions of `symbolic` come to, as terms: as they are, in lowest terms, and as the
paper writes such: collected by what varies, each coefficient factored, 1 - alpha below the line, T
for 2 r/g.

This file loads SymPy, and is called where nothing is kept of what it derives.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Hashable, Iterator
from fractions import Fraction
from types import CodeType
from typing import Union

from sympy import (
    Expr,
    ImmutableMatrix,
    MatrixBase,
    Rational,
    Symbol,
    cancel,
    expand,
    factor,
    fraction,
    symbols,
    together,
)

from juggleproof import symbolic
from juggleproof.encoding import from_sympy, positive, signed_sum, tidy
from juggleproof.reading.values import Matrix, Vector
from juggleproof.statements.language import ClaimError, Formula, Term, names_in, real, term

RESULTS = ("Expr", "State", "ImmutableMatrix", "Extremum", "tuple[Expr, Expr]", "tuple[Expr, ...]")
VARYING = ("x", "beta", "z1", "tau", "t", "v", "z2", "w", "u", "s")
Rows = tuple[tuple[str, ...], ...]
Derived = Union[Term, Vector, Matrix]


def value(name: str, *arguments: Hashable) -> Derived:
    """What a function of `symbolic` comes to; the name of a symbol stands for it.

    >>> print(value("E_max"))
    r^2*(alpha + 1)^2/(2*(alpha - 1)^2)
    """
    return encoded(result(name, *arguments))


def result(name: str, *arguments: Hashable) -> Expr | MatrixBase:
    """The value of the function; several expressions as a column, and an extremum as the state to
    which it belongs.
    """
    named = (getattr(symbolic, one, one) if isinstance(one, str) else one for one in arguments)
    found = getattr(symbolic, name)(*named)
    if hasattr(found, "attained"):
        return found.state
    return ImmutableMatrix(found) if isinstance(found, tuple) else found


def encoded(value: Expr | MatrixBase) -> Derived:
    """A SymPy expression, column or matrix in the values of the reader; the square root of 2 + 2
    alpha is named s.

    Raises ClaimError for floats, functions and other roots.
    """
    if isinstance(value, MatrixBase):
        if value.shape[1] == 1:
            return Vector(tuple(_term(entry) for entry in value))
        return Matrix(
            tuple(
                tuple(_term(value[i, j]) for j in range(value.shape[1]))
                for i in range(value.shape[0])
            )
        )
    return _term(value)


def _term(expression: Expr) -> Term:
    s = real("s")
    return from_sympy(
        expression, {2 * symbolic.alpha + 2: s, symbolic.alpha / 2 + symbolic.alpha**0 / 2: s / 2}
    )


def struck() -> Derived:
    """The ball's state after an impact, in the four components before it."""
    names = symbols("ball_height ball_speed table_height table_speed")
    return encoded(symbolic.collide(ImmutableMatrix(names[:2]), ImmutableMatrix(names[2:])))


def in_lowest_terms(name: str, *values: tuple[str, int]) -> Vector:
    """A column of `symbolic` in lowest terms, with numbers put for some of its symbols.

    >>> print(*in_lowest_terms("e_1"))
    4*alpha*r^2/(g*(alpha + 1)^2) (alpha*r - r)/(alpha + 1)
    """
    return Vector(tuple(tidy(entry) for entry in getattr(symbolic, name)().subs(dict(values))))


def margin(name: str) -> Formula:
    """The formula that a margin of `symbolic` is positive."""
    return positive(getattr(symbolic, name)())


# -------------------------------------------------------------------------------------------------
# What is said of a derivation: its sentence, its entries in the paper's manner, and what it calls.


def sentence(name: str) -> str:
    """What a function of `symbolic` derives: the first paragraph of its docstring.

    >>> sentence("launch_state")
    'The table as it leaves the ground: r_0 = (0, r) (section 3.1).'
    """
    text = inspect.getdoc(getattr(symbolic, name)) or ""
    return " ".join(text.partition("\n\n")[0].split())


def in_paper_form(name: str, *arguments: Hashable) -> Rows:
    """The entries in the paper's manner, where T stands for 2 r/g."""
    value = result(name, *arguments)
    parts = list(value) if isinstance(value, MatrixBase) else [value]  # by rows
    width = value.shape[1] if isinstance(value, MatrixBase) and value.shape[1] > 1 else len(parts)
    texts = tuple(str(paper_form(one)) for one in parts)
    return tuple(texts[start : start + width] for start in range(0, len(texts), width))


def made_from(name: str) -> tuple[str, ...]:
    """The derivations that this one calls, itself or through functions that have to be given
    arguments, in the order of its code.

    >>> made_from("E_max")
    ('largest_kept_energy',)
    >>> made_from("total_energy")
    ('acceleration',)
    """
    return tuple(dict.fromkeys(_called(getattr(symbolic, name), {name})))


def _called(function: Callable[..., object], seen: set[str]) -> Iterator[str]:
    plain = inspect.unwrap(function)
    for name in _names_in(plain.__code__):
        called = plain.__globals__.get(name)
        if (
            name in seen
            or not callable(called)
            or not getattr(called, "__module__", "").startswith("juggleproof.symbolic.")
            or inspect.isclass(called)
        ):
            continue
        seen.add(name)
        if _is_derivation(called, name):
            yield name
        else:
            yield from _called(called, seen)


def _names_in(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for inner in code.co_consts:  # comprehensions and inner functions
        if isinstance(inner, CodeType):
            yield from _names_in(inner)


def _is_derivation(function: Callable[..., object], name: str) -> bool:
    """Whether it can be worked out as it is, and what it comes to has rows."""
    parameters = inspect.signature(function).parameters.values()
    if name not in dir(symbolic) or any(one.default is one.empty for one in parameters):
        return False
    return inspect.unwrap(function).__annotations__.get("return") in RESULTS


# -------------------------------------------------------------------------------------------------
# The paper's manner.


def paper_form(expression: Expr) -> Term:
    """The same expression in the paper's manner; what does not come out equal to it is refused.

    >>> from juggleproof.symbolic import E_max, delta_E_max, e_1, f1
    >>> print(paper_form(delta_E_max()), "  ", paper_form(e_1()[1]))
    (1 + alpha)/(2*(1 - alpha))*r^2    -(1 - alpha)/(1 + alpha)*r
    >>> print(paper_form(f1()[0]))
    -alpha*beta - T*alpha*v + T*alpha*r

    Raises ClaimError for floats, functions, and roots other than that of 2 (1 + alpha).
    """
    s = Symbol("s")
    plain = expression.replace(
        lambda one: one.is_Pow and one.exp.is_Rational and one.exp.q == 2,
        lambda one: _root_in_paper_form(one.base, s) ** (2 * one.exp),
    )
    above, below = fraction(factor(together(plain)))
    states = [one for one in map(_symbol, VARYING) if plain.has(one)]
    if below.free_symbols & set(states):  # one quotient
        quotient = _sum_in_paper_form(_addends(above, expand(1), states)) / from_sympy(below)
        return _equal_to(plain, quotient)
    addends = _addends(above, below, states) if states else [(above / below, expand(1))]
    if len(addends) > 1 and below.has(_symbol("g")):
        with_period = [_with_period(coefficient) for coefficient, _ in addends]
        if not any(fraction(one)[1].has(_symbol("g")) for one in with_period):
            addends = [
                (coefficient, monomial) for coefficient, (_, monomial) in zip(with_period, addends)
            ]
    return _equal_to(plain, _sum_in_paper_form(addends))


def _equal_to(plain: Expr, written: Term) -> Term:
    if cancel(_back(written).subs(Symbol("T"), symbolic.period()) - plain) != 0:
        raise ClaimError(f"{plain} is not {written}")
    return written


def _sum_in_paper_form(addends: list[tuple[Expr, Expr]]) -> Term:
    """The sum of coefficients times monomials."""
    parts = ((*_coefficient(factor(coefficient)), monomial) for coefficient, monomial in addends)
    return signed_sum(
        (negative, _times(part, from_sympy(monomial))) for negative, part, monomial in parts
    )


def _symbol(name: str) -> Symbol:
    return getattr(symbolic, name) if name in dir(symbolic) and name != "s" else Symbol(name)


def _root_in_paper_form(base: Expr, s: Symbol) -> Expr:
    """The square root of the base, in terms of s, the root of 2 (1 + alpha)."""
    ratio = cancel(base / (2 + 2 * symbolic.alpha))
    root = ratio ** Rational(1, 2)
    if not root.is_Rational:
        raise ClaimError(
            f"the square root of {base} is no rational multiple of that of 2 + 2 alpha"
        )
    return root * s


def _addends(above: Expr, below: Expr, states: list[Symbol]) -> list[tuple[Expr, Expr]]:
    """The coefficients of the monomials in the states, in the order of these, what is constant
    last.
    """
    ordered = sorted(
        _by_monomial(expand(above), states).items(), key=lambda one: _order(one[0], states)
    )
    return [(coefficient / below, monomial) for monomial, coefficient in ordered]


def _by_monomial(above: Expr, states: list[Symbol]) -> dict[Expr, Expr]:
    coefficients: dict[Expr, Expr] = {}
    for part in above.as_ordered_terms():
        coefficient, monomial = part.as_independent(*states)
        coefficients[monomial] = coefficients.get(monomial, 0) + coefficient
    return coefficients


def _order(monomial: Expr, states: list[Symbol]) -> tuple[bool, int, int]:
    held = [place for place, one in enumerate(states) if monomial.has(one)]
    return (
        not held,
        max(held, default=0),
        -sum(int(monomial.as_powers_dict().get(one, 0)) for one in states),
    )


def _with_period(coefficient: Expr) -> Expr:
    """r/g as T/2, where that takes g from below the line and puts nothing there."""
    r, g = _symbol("r"), _symbol("g")
    coefficient = cancel(coefficient)
    changed = cancel(coefficient.subs(g, 2 * r / Symbol("T")))
    return (
        changed
        if fraction(coefficient)[1].has(g) and not fraction(changed)[1].has(r)
        else coefficient
    )


def _coefficient(coefficient: Expr) -> tuple[bool, Term]:
    """Whether the coefficient is negative as written, and the rest of it as one quotient, 1 - alpha
    standing for alpha - 1 below.
    """
    above, below = fraction(coefficient)
    negative = False
    upper, lower = list[tuple[Term, int]](), list[tuple[Term, int]]()
    for side, factors in ((above, upper), (below, lower)):
        for base, exponent in _powers(side):
            if base.is_Rational:
                negative ^= bool(base < 0) and exponent % 2 == 1
                factors.append((term(Fraction(abs(int(base.p)), int(base.q))), int(exponent)))
                continue
            flipped = (
                base.is_Add and base.subs(symbolic.alpha, 0) < 0
                if base.free_symbols == {symbolic.alpha}
                else False
            )
            if flipped:
                negative ^= exponent % 2 == 1
            factors.append((_ascending(-base if flipped else base), int(exponent)))
    upper, lower = _joined(upper), _joined(lower)
    if not lower:
        return negative, _product_in_paper_form(upper)
    of_alpha = [one for one in upper if names_in(one[0]) <= {"alpha"}]
    if any(names_in(base) - {"alpha"} for base, _ in lower) or not any(
        base.op in "+-" for base, _ in of_alpha
    ):
        return negative, _product_in_paper_form(upper) / _product_in_paper_form(lower)
    return negative, _times(
        _product_in_paper_form(of_alpha) / _product_in_paper_form(lower),
        _product_in_paper_form([one for one in upper if one not in of_alpha]),
    )


def _powers(side: Expr) -> list[tuple[Expr, int]]:
    """The bases of a product with their exponents, numbers taken out of sums."""
    factors = []
    for base, exponent in side.as_powers_dict().items():
        content, rest = base.primitive() if base.is_Add else (Rational(1), base)
        factors += [(content, exponent)] * (content != 1) + [(rest, exponent)] * (rest != 1)
    return factors


def _joined(factors: list[tuple[Term, int]]) -> list[tuple[Term, int]]:
    """(1 + alpha)(1 - alpha) as 1 - alpha^2."""
    alpha = real("alpha")
    pair = [(1 + alpha, 1), (1 - alpha, 1)]
    if not all(one in factors for one in pair):
        return factors
    return [*(one for one in factors if one not in pair), (1 - alpha**2, 1)]


def _ascending(base: Expr) -> Term:
    """A sum in alpha alone by ascending powers; anything else as it is."""
    if not base.is_Add or base.free_symbols != {symbolic.alpha}:
        return from_sympy(base)
    parts = sorted(
        base.as_ordered_terms(), key=lambda one: one.as_powers_dict().get(symbolic.alpha, 0)
    )
    return signed_sum(
        (negative, from_sympy(-part if negative else part))
        for part in parts
        for negative in [part.could_extract_minus_sign()]
    )


def _product_in_paper_form(factors: list[tuple[Term, int]]) -> Term:
    total = term(1)
    for base, exponent in factors:
        total = _times(total, base**exponent if exponent != 1 else base)
    return total


def _times(left: Term, right: Term) -> Term:
    return right if left == term(1) else left if right == term(1) else left * right


def _back(value: Term) -> Expr:
    """The term as a SymPy expression again."""
    if value.op == "var":
        return _symbol(value.name)
    if value.op == "num":
        return Rational(value.value.numerator, value.value.denominator)
    left = _back(value.operands[0])
    if value.op == "neg":
        return -left
    if value.op == "^":
        return left**value.exponent
    right = _back(value.operands[1])
    return (
        {"+": left + right, "-": left - right, "*": left * right}[value.op]
        if value.op != "/"
        else left / right
    )
