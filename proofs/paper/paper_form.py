"""Derived expressions as the paper writes such: collected by what varies, each coefficient
factored, 1 - alpha below the line, T for 2 r/g.
"""

from __future__ import annotations

from fractions import Fraction

from sympy import Expr, Rational, Symbol, cancel, expand, factor, fraction, together

from juggleproof import symbolic
from juggleproof.certificates.language import ClaimError, Term, names_in, real, term
from juggleproof.proofs.encoding import from_sympy

VARYING = ("x", "beta", "z1", "tau", "t", "v", "z2", "w", "u", "s")


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
    total: Term | None = None
    for coefficient, monomial in addends:
        negative, part = _coefficient(factor(coefficient))
        piece = _times(part, from_sympy(monomial))
        total = (
            (-piece if negative else piece)
            if total is None
            else total - piece
            if negative
            else total + piece
        )
    return total if total is not None else term(0)


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
    total: Term | None = None
    for part in sorted(
        base.as_ordered_terms(), key=lambda one: one.as_powers_dict().get(symbolic.alpha, 0)
    ):
        negative = part.could_extract_minus_sign()
        piece = from_sympy(-part if negative else part)
        total = (
            (-piece if negative else piece)
            if total is None
            else total - piece
            if negative
            else total + piece
        )
    return total if total is not None else term(0)


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
