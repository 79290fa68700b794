"""A point by its equations: what premises know of it, and terms in the parameters and the point,
with their values at samples.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.functions.candidates import Setting, power_products
from juggleproof.map_stability.samples import SEED, Floats
from juggleproof.map_stability.terms import Expr, atoms, expression, holds, symbols, written


def at_parameters(setting: Setting, term: Expr) -> Floats:
    """Return the values at the samples of the parameters, (count,)."""
    known = setting.constants
    with np.errstate(all="ignore"):
        found = sympy.lambdify(symbols(known), term, "numpy")(*known.values())
    return np.broadcast_to(np.asarray(found, float), (setting.count,))


def with_ends(setting: Setting) -> Setting:
    """Return the setting with more parameters, which are close to the ends of the domain; constants
    have to follow there too.
    """
    names = setting.system.parameters
    if not names:
        return setting
    rng, inside = np.random.default_rng(SEED), setting.parameters
    size = setting.count
    chosen = rng.integers(0, size, size)
    known, far = np.zeros(size), np.full(size, limits.FAR_END)
    steps = {name: inside[name] - inside[name][chosen] for name in names}
    for _ in range(limits.END_HALVINGS):
        middle = (known + far) / 2
        here = {name: inside[name] + middle * steps[name] for name in names}
        holding = np.broadcast_to(holds(setting.domain, here), (size,))
        known, far = np.where(holding, middle, known), np.where(holding, far, middle)
    near = {name: inside[name] + (1 - limits.NEAR_END) * known * steps[name] for name in names}
    with np.errstate(all="ignore"):
        holding = np.broadcast_to(holds(setting.domain, near), (size,)) & (
            known < limits.FAR_END / 2
        )
    every = {name: np.concatenate([inside[name], near[name][holding]]) for name in names}
    return replace(setting, parameters=every)


def with_equations(setting: Setting) -> tuple[Setting, dict[Expr, Expr]]:
    """Return the setting and terms for some of the parameters and of the point's names, in the
    others.  The premises know these equations of the point and its inequalities.
    """
    names, terms = setting.point_names, list(map(expression, setting.point.terms))
    if not setting.have:
        return setting, dict(zip(names, terms))
    at = dict(zip(symbols(setting.system.state), names))
    put: dict[Expr, Expr] = {}
    for name, image in zip(names, setting.system.images[setting.piece]):
        gap = (image.subs(at, simultaneous=True) - name).subs(put, simultaneous=True)
        factors = [one for one, _ in sympy.factor_list(sympy.numer(sympy.together(gap)))[1]]
        if not factors:
            continue
        zero = min(factors, key=lambda one: np.median(np.abs(at_parameters(setting, one))))
        parameters = symbols(setting.system.parameters)
        simple = sorted(parameters, key=lambda one: _size(sympy.diff(zero, one)))
        for one in [*simple, *reversed(names)]:
            if sympy.degree(zero, one) == 1:
                (solution,) = sympy.solve(zero, one)
                put = {key: sympy.cancel(t.subs(one, solution)) for key, t in put.items()}
                put[one] = sympy.cancel(solution)
                break
    have = [line for line in setting.have if ">" in line]
    conditions = [
        (one.subs(put), strict)
        for one, strict in atoms(setting.domain)
        if one.free_symbols & put.keys()
    ]
    for strict in (True, False):
        terms = [one for one, is_strict in conditions if one.free_symbols and is_strict == strict]
        for factor in factors_of(setting, terms):
            if any(c < 0 for c in sympy.Poly(factor, *factor.free_symbols).coeffs()):
                have.append(f"{written(factor)} {'>' if strict else '>='} 0")
    for one, term in put.items():
        above, below = map(written, sympy.fraction(sympy.together(term)))
        have.insert(0, f"{one}*({below}) = {above}" if below != "1" else f"{one} = {above}")
    return replace(setting, have=tuple(have)), put


def _size(term: Expr) -> int:
    """Return the number of terms of a polynomial."""
    return len(sympy.Add.make_args(sympy.expand(term)))


def sizes_of(setting: Setting, put: dict[Expr, Expr], origin: Sequence[Expr]) -> list[Expr]:
    """Return the divisors of the ratios."""
    pairs = zip(symbols(setting.system.state), setting.point_names)
    at = {one: put.get(e, e) for one, e in pairs}
    return [one.subs(at) for one in origin]


def factors_of(setting: Setting, terms: Sequence[Expr]) -> list[Expr]:
    """The nonconstant factors of numerators and denominators, with the sign that is positive."""
    found = set()
    for one in terms:
        for part in sympy.fraction(sympy.together(one)):
            found |= {factor for factor, _ in sympy.factor_list(part)[1]}
    signs = {one: at_parameters(setting, one).max() > 0 for one in sorted(found, key=str)}
    return [one if positive else -one for one, positive in signs.items()]


def products_of(setting: Setting, factors: Sequence[Expr]) -> list[tuple[str, Floats]]:
    """Products of powers of the factors, as text and at the parameters."""
    texts = [written(one) for one in factors if (at_parameters(setting, one) > 0).all()]
    return power_products(texts, setting.constants, setting.count)
