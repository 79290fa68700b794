#!/usr/bin/env python3
"""The checker: rebuilds every statement from its text and takes a certificate as a hint.

This file is all that must be believed.  It uses the standard library only, exact integers only, and
runs alone:

    python -I -S certificates/checker.py [DIR]

DIR holds `statements.txt`, which an auditor reads, and one `ID.json` of certificates for each
claim.  The statement `ID/part` is settled by the entry of that name in `ID.json`.  Exit 0: nothing
rejected; 1: a certificate rejected or missing; 2: unusable input.  PROOF RULES, STATEMENT RULES and
ORBIT RULES below state every rule in full where it is applied.
"""

import ast
import json
import os
import re
import sys
from fractions import Fraction
from functools import lru_cache, reduce
from math import comb, gcd, lcm, prod

MAX_DEGREE, MAX_VARIABLES, MAX_TERMS, MAX_BITS, MAX_WORK, MAX_FILE = (
    4000,
    60,
    10**5,
    40000,
    2 * 10**7,
    16 << 20,
)
BITS = 16  # of one exponent inside a packed monomial; MAX_DEGREE < 2**BITS keeps exponents apart


class Rejected(Exception):
    """A certificate does not prove its statement, or a statement says nothing: the reason, then the
    offending object.
    """

    def __init__(self, reason, offender=""):
        shown = offender() if callable(offender) else offender
        super().__init__(reason + (f": {shown}"[:300] if shown != "" else ""))


def require(holds, reason, offender=""):
    """A check on which soundness rests: unlike `assert`, it cannot be switched off.  An offender
    that is long to show is a function.
    """
    if not holds:
        raise Rejected(reason, offender)


work_left = [MAX_WORK]


def spend(amount):
    """Counts elementary products, so that a hostile file ends as a rejection instead of a hang."""
    work_left[0] -= amount
    require(work_left[0] >= 0, "too much work")


# ------------------------------------ polynomials: {packed exponents: integer} over one denominator


class Poly:
    """terms / den / product of `under`: a polynomial with rational coefficients, over polynomials
    that are known to be nonzero.

    terms: {packed exponents: integer other than 0}; deg: a bound on their degree; under: {licence:
    exponent}, where a licence is (polynomial other than 0, whether it is > 0).  Only a term that
    divides has an `under`: facts and cofactors are polynomials.
    """

    __slots__ = ("terms", "den", "deg", "under")

    def __init__(self, terms, den, deg, under=None):
        if deg > MAX_DEGREE or den.bit_length() > MAX_BITS:
            raise Rejected("a polynomial is too large", f"degree {deg}")
        self.terms, self.den, self.deg, self.under = terms, den, deg, under or {}

    def over(self, under):
        """The same terms, over other polynomials."""
        return Poly(self.terms, self.den, self.deg, under)

    def numerator(self, under):
        """The numerator over a denominator that is a multiple of the present one."""
        return prod(
            (x[0] ** (e - self.under.get(x, 0)) for x, e in under.items()), start=self.over({})
        )

    def plus(self, other, factor=1):
        """self + factor * other, for a rational factor other than 0."""
        if self.under or other.under:
            under = merged(max, self.under, other.under)
            return self.numerator(under).plus(other.numerator(under), factor).over(under)
        den = lcm(self.den, other.den * factor.denominator)
        spend(len(self.terms))
        terms = (
            dict(self.terms) if den == self.den else add_multiple({}, den // self.den, self.terms)
        )
        add_multiple(terms, den // (other.den * factor.denominator) * factor.numerator, other.terms)
        return Poly(terms, den, max(self.deg, other.deg))

    __add__ = plus

    def __sub__(self, other):
        return self.plus(other, -1)

    def __neg__(self):
        return Poly({m: -c for m, c in self.terms.items()}, self.den, self.deg, self.under)

    def __mul__(self, other):
        if other is ONE:
            return self
        few, many = (
            (self.terms, other.terms)
            if len(self.terms) < len(other.terms)
            else (other.terms, self.terms)
        )
        terms = {}
        for m, c in few.items():
            add_multiple(terms, c, many, m)
        return Poly(
            terms,
            self.den * other.den,
            self.deg + other.deg,
            merged(sum, self.under, other.under) if self.under or other.under else None,
        )

    def __pow__(self, exponent):
        require(exponent * max(self.deg, 1) <= MAX_DEGREE, "an exponent is too large", exponent)
        return prod([self] * (exponent - 1), start=self) if exponent else ONE

    def constant(self):
        """The value of a constant; None for anything else."""
        return (
            Fraction(self.terms.get(0, 0), self.den)
            if not self.under and self.terms.keys() <= {0}
            else None
        )

    def primitive(self):
        """(c, p) with terms = c * p, where p has coprime integer coefficients, that of the largest
        monomial positive.
        """
        content = gcd(*self.terms.values()) * (-1 if self.terms[max(self.terms)] < 0 else 1)
        return content, Poly({m: c // content for m, c in self.terms.items()}, 1, self.deg)


def add_multiple(terms, factor, others, shift=0):
    """terms += factor * x^shift * others, for an integer factor other than 0; the work on
    polynomials is counted and limited here.

    No factor * c is longer than `bits`, so that coefficients are looked at only where one may be
    too long.
    """
    bits = (
        factor.bit_length() + max(map(int.bit_length, others.values()), default=0)
        if not -2 < factor < 2
        else 0
    )
    spend(1 + len(others) * (1 + (factor.bit_length() * bits >> 16)))
    for m, c in others.items():
        total = terms.get(m + shift, 0) + factor * c
        if total:
            terms[m + shift] = total
        else:
            del terms[m + shift]
    if (
        len(terms) > MAX_TERMS
        or bits > MAX_BITS
        and any(c.bit_length() > MAX_BITS for c in terms.values())
    ):
        raise Rejected("a polynomial is too large", f"{len(terms)} terms")
    return terms


def merged(rule, one, other):
    """Exponents of licences, brought together by a rule: max or sum."""
    return {x: rule((one.get(x, 0), other.get(x, 0))) for x in {**one, **other}}


def number(value):
    return Poly({0: value.numerator} if value else {}, value.denominator, 0)


ONE, ZERO = number(1), number(0)
VARIABLES = [Poly({1 << (BITS * i): 1}, 1, 1) for i in range(MAX_VARIABLES)]
ARITHMETIC = {ast.Add: Poly.__add__, ast.Sub: Poly.__sub__, ast.Mult: Poly.__mul__}


# --------------------------------- text: Python's expression syntax, with ^ and = as in mathematics


def parse(text):
    """The syntax tree of a term or formula: integers, names, + - * / ^, < <= = != >= >, and, or,
    not, implies(,), iff(,).
    """
    require(isinstance(text, str) and len(text) <= 1 << 20, "unreadable text", text)
    return tree(text) if len(text) < 200 else tree.__wrapped__(text)  # what is kept is small


@lru_cache(4096)
def tree(text):
    require(
        not re.search(r"[^\w +\-*/^()<>=!,]|\*\*|//|<<|>>|==|<>|\b\d+[A-Za-z_]", text, re.ASCII),
        "unreadable text",
        text,
    )
    try:
        return ast.parse(
            re.sub(r"(?<![<>!])=", "==", text.replace("^", "**")).strip(), mode="eval"
        ).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise Rejected("unreadable text", text) from None


WORDS = {"and", "or", "not", "implies", "iff"}  # never names: `names_in` does not count them
OPPOSITE = {">": ">=", ">=": ">", "=": "!=", "!=": "="}  # not p > 0 is -p >= 0
OPERATORS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=", ast.NotEq: "!="}


def fold(poly, relation):
    """The atom poly relation 0; True or False where the polynomial is constant."""
    if not poly.terms.keys() <= {0}:
        return ("atom", poly, relation)
    value = poly.terms.get(0, 0)
    return {">": value > 0, ">=": value >= 0, "=": value == 0, "!=": value != 0}[relation]


def join(op, formulas):
    """The conjunction or disjunction, without constants and without joins of the same kind
    inside.
    """
    if any(formula is (op == "or") for formula in formulas):
        return op == "or"
    flat = [
        part
        for formula in formulas
        if not isinstance(formula, bool)
        for part in (formula[1] if formula[0] == op else [formula])
    ]
    spend(20 * len(flat) + 100)
    return op == "and" if not flat else flat[0] if len(flat) == 1 else (op, flat)


def negate(formula):
    """The negation, with `not` driven down to atoms."""
    if isinstance(formula, bool):
        return not formula
    if formula[0] == "atom":
        return (
            "atom",
            formula[1] if formula[2] in ("=", "!=") else -formula[1],
            OPPOSITE[formula[2]],
        )
    return join("or" if formula[0] == "and" else "and", [negate(part) for part in formula[1]])


def conjuncts(formula):
    return formula[1] if not isinstance(formula, bool) and formula[0] == "and" else [formula]


class Context:
    """What has been declared so far: variables, the values of names, and the polynomials that a
    strict line made nonzero.
    """

    def __init__(self, outer=None, values=None):
        self.index, self.integers = (
            (dict(outer.index), set(outer.integers)) if outer else ({}, set())
        )
        self.licensed = dict(outer.licensed) if outer else {}
        self.values = dict(values if values is not None else outer.values if outer else {})

    def declare(self, name, integral=False):
        """A fresh variable; where another scope has one of this name, its key grows by underscores,
        so that the two stay apart.
        """
        key = name
        while key in self.index:
            key += "_"
        require(len(self.index) < MAX_VARIABLES, "too many variables", name)
        self.define(name, VARIABLES[len(self.index)])
        self.index[key] = len(self.index)
        self.integers |= {key} if integral else set()

    def define(self, name, value):
        fresh = (
            name not in self.values
            and name not in WORDS
            and re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII)
        )
        require(fresh, "a name is declared twice, or is none", name)
        self.values[name] = value

    def license(self, formula):
        """A strict line, at top level or inside a top-level `and`, makes its polynomial nonzero
        (and tells its sign).
        """
        for part in conjuncts(formula):
            if not isinstance(part, bool) and part[0] == "atom" and part[2] in (">", "!="):
                content, key = part[1].primitive()
                mark, positive = frozenset(key.terms.items()), part[2] == ">"
                if mark not in self.licensed or positive and not self.licensed[mark][1]:
                    self.licensed[mark] = (key if content > 0 else -key, positive)

    def reciprocal(self, node):
        """1 / node, where node is a nonzero number, licensed as a whole, or a product or power of
        such.
        """
        value = self.value(node)
        require(value.terms, "division by zero", lambda: ast.unparse(node))
        if value.constant():
            return number(1 / value.constant())
        content, key = value.primitive()
        licence = self.licensed.get(frozenset(key.terms.items()))
        if licence or key.constant():
            sign = -1 if licence and licence[0].terms != key.terms else 1
            upper = ONE.numerator(value.under) * number(Fraction(sign * value.den, content))
            return upper.over({licence: 1} if licence else {})
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
            return self.reciprocal(node.left) * self.reciprocal(node.right)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            return self.reciprocal(node.left) ** node.right.value
        raise Rejected(
            "division by what may vanish; no strict line before it makes this nonzero",
            self.show(value),
        )

    def value(self, node):
        """The value of a term."""
        kind = type(node)
        if kind is ast.Name and node.id in self.values:
            return self.values[node.id]
        if kind is ast.Constant and type(node.value) is int:
            return number(node.value)
        if kind is ast.UnaryOp and type(node.op) is ast.USub:
            return -self.value(node.operand)
        if kind is ast.BinOp:
            left, op, right = self.value(node.left), type(node.op), node.right
            if op is ast.Pow and type(right) is ast.Constant and type(right.value) is int:
                return left**right.value
            if op is ast.Div:
                return left * self.reciprocal(right)
            if op in ARITHMETIC:
                return ARITHMETIC[op](left, self.value(right))
        raise Rejected(
            "an undeclared name" if kind is ast.Name else "not a term", ast.unparse(node)
        )

    def polynomial(self, text):
        value = self.value(parse(text))
        require(not value.under, "expected a polynomial", text)
        return value

    def atom(self, left, relation, right):
        """left relation right as p > 0, p >= 0, p = 0 or p != 0: the difference times what is
        positive wherever it is defined.
        """
        value, relation = (
            (right - left, relation.replace("<", ">"))
            if "<" in relation
            else (left - right, relation)
        )
        signless = (
            poly
            for (poly, positive), e in value.under.items()
            if e % 2 and not positive and ">" in relation
        )
        return fold(prod(signless, start=value.over({})), relation)

    def formula(self, node):
        """The formula with `not` driven down to atoms: ("atom", p, relation), ("and", ..), ("or",
        ..) or a bool.
        """
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            return negate(self.formula(node.operand))
        if isinstance(node, ast.BoolOp):
            return join(
                "and" if isinstance(node.op, ast.And) else "or",
                [self.formula(part) for part in node.values],
            )
        if isinstance(node, ast.Compare) and all(type(op) in OPERATORS for op in node.ops):
            sides, signs = (
                [self.value(side) for side in (node.left, *node.comparators)],
                [OPERATORS[type(op)] for op in node.ops],
            )
            return join("and", [self.atom(*atom) for atom in zip(sides, signs, sides[1:])])
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and len(node.args) == 2
            and not node.keywords
        ):
            left, right = self.formula(node.args[0]), self.formula(node.args[1])
            if node.func.id == "implies":
                return join("or", [negate(left), right])
            if node.func.id == "iff":
                return join(
                    "and", [join("or", [negate(left), right]), join("or", [left, negate(right)])]
                )
        raise Rejected("not a formula", ast.unparse(node))

    def show(self, poly):
        """A polynomial as text that `parse` reads."""
        parts = []
        for m in sorted(poly.terms, reverse=True):
            powers = [(n, (m >> (BITS * i)) % (1 << BITS)) for n, i in self.index.items()]
            parts.append(
                "*".join(
                    [
                        str(Fraction(poly.terms[m], poly.den)),
                        *(n if e == 1 else f"{n}^{e}" for n, e in powers if e),
                    ]
                )
            )
        return re.sub(r"\b1\*(?=[A-Za-z])", "", " + ".join(parts)).replace("+ -", "- ") or "0"


def variables_of(context, poly):
    return {
        n
        for n, i in context.index.items()
        if any((m >> (BITS * i)) % (1 << BITS) for m in poly.terms)
    }


# ------------------------------ polynomials in one variable: lists of integers from the constant up


def univariate(context, poly, name):
    """The coefficients, up to the positive factor that the denominator is."""
    require(
        not poly.under and variables_of(context, poly) == {name},
        f"expected a polynomial in {name} alone",
        lambda: context.show(poly),
    )
    shift = BITS * context.index[name]
    return [poly.terms.get(k << shift, 0) for k in range((max(poly.terms) >> shift) + 1)]


def sign_at(p, at):
    """The sign of p at a rational number."""
    value, scale = 0, 1
    for c in reversed(p):
        spend(
            1
            + (
                (value.bit_length() + scale.bit_length())
                * (sum(map(int.bit_length, at.as_integer_ratio())) + c.bit_length())
                >> 16
            )
        )
        value, scale = value * at.numerator + c * scale, scale * at.denominator
    return (value > 0) - (value < 0)


def remainder(p, q):
    """A positive multiple of the remainder of p by q, without common factors."""
    rest = list(p)
    while len(rest) >= len(q):
        factor, shift = rest[-1] if q[-1] > 0 else -rest[-1], len(rest) - len(q)
        spend(len(rest) * (1 + (factor.bit_length() * q[-1].bit_length() >> 16)))
        rest = [
            c * abs(q[-1]) - (factor * q[k - shift] if k >= shift else 0)
            for k, c in enumerate(rest)
        ][:-1]
        while rest and rest[-1] == 0:
            rest.pop()
        content = gcd(*rest)
        rest = [c // content for c in rest]
    return rest


def count_roots(p, low, high):
    """The number of distinct real roots between two numbers where p is not 0, by Sturm's
    theorem.
    """
    chain = [p, [k * c for k, c in enumerate(p)][1:]]
    while chain[-1]:
        chain.append([-c for c in remainder(chain[-2], chain[-1])])
    signs = [[sign_at(q, at) for q in chain[:-1]] for at in (low, high)]
    require(signs[0][0] and signs[1][0], "a polynomial vanishes at an end of the interval")
    below, above = ([sign for sign in row if sign] for row in signs)
    return sum(a != b for a, b in zip(below, below[1:])) - sum(
        a != b for a, b in zip(above, above[1:])
    )


# ------------------------------------------------------------ states


class State:
    """What is assumed on one branch of a proof: facts (polynomial, relation) that all hold, and
    disjunctions still open.

    Certificates name variables by their keys.  Only what the facts say licenses a division here:
    nothing that is yet to be shown.
    """

    def __init__(self, variables, parent=None):
        self.context = Context(variables, {key: VARIABLES[i] for key, i in variables.index.items()})
        self.context.licensed = dict(parent.context.licensed) if parent else {}
        self.facts, self.choices, self.closed = (
            (list(parent.facts), list(parent.choices), parent.closed) if parent else ([], [], False)
        )

    def assume(self, formula):
        for part in conjuncts(formula):
            if isinstance(part, bool):
                self.closed = self.closed or not part
            elif part[0] == "atom":
                self.facts.append(part[1:])
                self.context.license(part)
            else:
                self.choices.append(part[1])
        return self

    def branch(self, formula=True, variables=None):
        return State(variables or self.context, self).assume(formula)

    def by_sign(self, text):
        """The three states in which the polynomial is < 0, = 0 and > 0."""
        poly = self.context.polynomial(text)
        return [
            self.branch(fold(p, relation))
            for p, relation in ((-poly, ">"), (poly, "="), (poly, ">"))
        ]


def at(sequence, index):
    require(type(index) is int and 0 <= index < len(sequence), "nothing has this number", index)
    return sequence[index]


def rational(value):
    """An exact rational: an int, or the text p or p/q."""
    exact = (
        type(value) is int
        or isinstance(value, str)
        and re.fullmatch(r"-?\d{1,4000}(/0*[1-9]\d{0,3999})?", value, re.ASCII)
    )
    require(exact, "expected an exact rational", value)
    return value if type(value) is int else Fraction(value)


# ---------------------------- PROOF RULES: each closes a state, that is, shows that it has no point


def close_at_once(state, known):
    """["close"]: the state assumes a false constant, such as 1 < 0."""
    require(
        state.closed,
        "nothing false is assumed",
        lambda: "; ".join(f"{state.context.show(p)} {r} 0" for p, r in state.facts),
    )


def close_by_positivstellensatz(state, known, products, equations):
    """["psatz", [[c, [[i, e], ...], q], ...], [[j, m], ...]]:

    sum c * prod fact_i^e * q^2  +  sum m * fact_j  =  0 identically, where every c is a rational >
    0, every fact_i is > 0 or >= 0 (or != 0, with e even), every fact_j is an equation, and one term
    at least is > 0: its facts are all strict and q is a constant other than 0.  So 0 > 0.
    Identities, cofactors of equations, Handelman and Bernstein forms are special cases.
    """
    total, strict = ZERO, False
    for coefficient, factors, root in products:
        square = ONE if root == "1" else state.context.polynomial(root)
        weight, product, positive = rational(coefficient), square * square, bool(square.constant())
        require(weight > 0, "a coefficient is not positive", coefficient)
        for index, exponent in factors:
            poly, relation = at(state.facts, index)
            if (
                type(exponent) is not int
                or not 0 < exponent <= MAX_DEGREE
                or relation == "="
                or relation == "!="
                and exponent % 2
            ):
                raise Rejected(
                    "a factor of unknown sign",
                    f"({state.context.show(poly)} {relation} 0)^{exponent}",
                )
            product, positive = product * poly**exponent, positive and relation != ">="
        total, strict = total.plus(product, weight), strict or positive
    for index, cofactor in equations:
        poly, relation = at(state.facts, index)
        require(relation == "=", "not an equation", lambda poly=poly: state.context.show(poly))
        total = total + poly * state.context.polynomial(cofactor)
    require(not total.terms, "the certificate's sum is not zero", lambda: state.context.show(total))
    require(strict, "no term of the certificate is strictly positive")


def close_by_cases(state, known, index, nodes):
    """["cases", k, [node, ...]]: one node for each alternative of the k-th open disjunction."""
    alternatives, rest = at(state.choices, index), state.branch()
    del rest.choices[index]
    require(
        len(nodes) == len(alternatives),
        "a disjunction needs one node for each alternative",
        len(alternatives),
    )
    for alternative, node in zip(alternatives, nodes):
        close(rest.branch(alternative), node, known)


def close_by_sign(state, known, text, below, zero, above):
    """["sign", p, node, node, node]: p < 0, p = 0 or p > 0."""
    for case, node in zip(state.by_sign(text), (below, zero, above)):
        close(case, node, known)


def bound(state, index, name, side):
    """The number c of fact `index`, which says c <= the variable (side 1) or the variable <= c
    (side -1), or strictly.
    """
    line, sense = at(state.facts, index)
    constant, slope, *more = univariate(state.context, line, name)
    require(
        not more and sense in (">", ">=") and slope * side > 0,
        "not a bound of the right sense",
        lambda: state.context.show(line),
    )
    return Fraction(-constant, slope)


def close_by_interval(state, known, index, low, high):
    """["interval", i, j, k]: fact i is p > 0 or p >= 0 in one variable; facts j and k say low <= it
    and it <= high (or strictly).

    p is not 0 at low and high, has no root between them (Sturm), and is negative at low: so fact i
    fails on all of [low, high].
    """
    poly, relation = at(state.facts, index)
    (name,) = variables_of(state.context, poly)
    p, first, last = (
        univariate(state.context, poly, name),
        bound(state, low, name, 1),
        bound(state, high, name, -1),
    )
    fails = (
        first > last
        or sign_at(p, first) < 0
        and (first == last or count_roots(p, first, last) == 0)
    )
    require(
        fails and relation in (">", ">="),
        "the fact does not fail on the whole interval",
        lambda: state.context.show(poly),
    )


def times(p, factor):
    """p times first + last T, where (first, last) is the factor."""
    return [factor[0] * x + factor[1] * y for x, y in zip([*p, 0], [0, *p])]


def bernstein(poly, axes):
    """(sizes, coefficients): the Bernstein coefficients of poly on a box, up to one positive
    factor, the first axis varying slowest.

    An axis is (shift, low, high).  x = (a + b T) / (d + d T), where a/d = low and b/d = high, takes
    [low, high] to T >= 0; in degree n, the coefficient of T^j in (d + d T)^n poly is d^n C(n, j)
    times the j-th Bernstein coefficient.
    """
    sizes, parts, bits = (
        [],
        {m: [c] for m, c in poly.terms.items()},
        max(map(int.bit_length, poly.terms.values())),
    )
    for shift, low, high in reversed(
        axes
    ):  # parts: by what is left of a monomial, the coefficients along the axes that are done
        n, d, done, parts = (
            max((m >> shift) % (1 << BITS) for m in poly.terms),
            lcm(low.denominator, high.denominator),
            parts,
            {},
        )
        a, b, whole, count = (
            int(low * d),
            int(high * d),
            lcm(*(comb(n, j) for j in range(n + 1))),
            sum(map(len, done.values())),
        )
        sizes, bits = (
            [n + 1, *sizes],
            bits + n * (3 + max(map(int.bit_length, (a, b, d)))),
        )  # so long at most, as (n + 1) * whole <= 8^n
        spend((8 * (n + 1) ** 3 + (n + 1) * count) * (1 + (bits * bits >> 16)))
        require(
            bits <= MAX_BITS and (n + 1) * count <= MAX_TERMS,
            "a polynomial is too large",
            lambda bits=bits: f"{bits} bits",
        )
        powers = [reduce(times, [(a, b)] * e + [(d, d)] * (n - e), [1]) for e in range(n + 1)]
        columns = [[whole // comb(n, j) * x for j, x in enumerate(power)] for power in powers]
        for m, c in done.items():
            e = (m >> shift) % (1 << BITS)
            rest, image = m - (e << shift), [factor * x for factor in columns[e] for x in c]
            parts[rest] = [x + y for x, y in zip(parts[rest], image)] if rest in parts else image
    return (sizes, *parts.values())


def parts_of_box(sizes, c, letter):
    """The boxes, with their Bernstein coefficients, that a letter of a box tree asks to look at:
    see `close_by_boxes`.
    """
    to_end, place = (
        (True, ord(letter) - ord("A")) if letter <= "Z" else (False, ord(letter) - ord("a"))
    )
    count, rest, step, size = (
        at(sizes, place),
        sizes[:place] + sizes[place + 1 :],
        prod(sizes[place + 1 :]),
        len(c) // sizes[place],
    )
    spend(
        len(c) * (count + 4) * (1 + (max(map(int.bit_length, c)) >> 8))
    )  # the axis comes first from here on, each of its indices `size` times
    c = (
        [
            x
            for j in range(0, step * count, step)
            for k in range(j, len(c), count * step)
            for x in c[k : k + step]
        ]
        if place
        else c
    )
    if to_end:
        steps = [y - x for x, y in zip(c, c[size:])]
        require(min(steps) >= 0 or max(steps) <= 0, "not monotone along an axis", letter)
        return [(rest, c[-size:] if max(steps) > 0 else c[:size])]
    levels = [c]  # de Casteljau's triangle, with sums for means: so level k is 2^k times too large
    while len(levels[-1]) > size:
        levels.append([x + y for x, y in zip(levels[-1], levels[-1][size:])])
    return [
        ([count, *rest], [x << k for k, level in enumerate(levels[::-1]) for x in level[-size:]]),
        (
            [count, *rest],
            [x << (count - 1 - k) for k, level in enumerate(levels) for x in level[:size]],
        ),
    ]


def close_by_boxes(state, known, index, bounds, tree):
    """["boxes", i, [[j, k], ...], "tree"]: fact i is p > 0 or p >= 0; for each variable of p in
    order, facts j and k say low <= it and it <= high (or strictly).  The tree shows that p < 0 (p
    <= 0, where fact i is strict) on the box of these bounds, so that the facts have no point.

    It has a character for each box in preorder.  `.`: all Bernstein coefficients of p on the box
    have that sign; p is a mean of them. `a`, `b`, ..: the first, second, .. axis of the box is
    halved, and is the first axis of both halves; the lower one comes first. `A`, `B`, ..: along the
    first, second, .. axis no Bernstein coefficient is less than the one before, so that p is
    largest at the upper end of the axis; or none is greater, so at the lower end.  The box that
    comes is this face: it has the other axes.
    """
    poly, relation = at(state.facts, index)
    require(
        relation in (">", ">=") and isinstance(tree, str),
        "a box tree is a text about a fact p > 0 or p >= 0",
        relation,
    )
    names = [name for name in state.context.index if name in variables_of(state.context, poly)]
    ends = [
        (bound(state, low, name, 1), bound(state, high, name, -1))
        for name, (low, high) in zip(names, bounds, strict=True)
    ]
    boxes = [
        bernstein(
            poly, [(BITS * state.context.index[name], *pair) for name, pair in zip(names, ends)]
        )
    ]
    for letter in tree:
        require(boxes, "a box tree is too long", tree)
        sizes, c = boxes.pop()
        require(
            letter != "." or max(c) < (relation == ">"),
            "a Bernstein coefficient of a leaf has the wrong sign",
            lambda c=c: max(c),
        )
        boxes += [] if letter == "." else parts_of_box(sizes, c, letter)
    require(not boxes, "a box tree is too short", tree)


def close_by_integrality(state, known, index, node):
    """["integral", i, node]: fact i is p > 0 with integer coefficients in integer variables only,
    so p - 1 >= 0.
    """
    poly, relation = at(state.facts, index)
    if (
        relation != ">"
        or not variables_of(state.context, poly) <= state.context.integers
        or any(c % poly.den for c in poly.terms.values())
    ):
        raise Rejected(
            "not a strict fact with integer coefficients in integers", state.context.show(poly)
        )
    close(state.branch(fold(poly - ONE, ">=")), node, known)


def close_by_use(state, known, name, arguments, fresh, node):
    """["use", name, {variable: term}, {variable: fresh name}, node]: an instance of an earlier
    certified statement.

    The instance is the formula (its range, givens and haves => what it shows) for any terms in
    place of its variables, an integer variable standing for an integer polynomial in integer ones;
    what it says to exist is named by variables that do not yet occur.
    """
    require(
        name in known and known[name].kind == "universal",
        "no earlier certified statement of this name",
        name,
    )
    context = Context(state.context)
    values = {variable: state.context.value(parse(text)) for variable, text in arguments.items()}
    for variable, new in sorted(fresh.items()):
        context.declare(new, any(variable in line for line in known[name].get("integer")))
        values[variable] = context.values[new]
    story = Unfolding(known[name], Context(context, values))
    one_value_each(state.context, story, arguments, fresh, story.variables)
    require(set(arguments) == set(story.universal), "only what exists is named afresh", name)
    close(
        state.branch(join("or", [negate(join("and", story.premises)), story.goal(True)]), context),
        node,
        known,
    )


def one_value_each(context, story, terms, others, needed):
    """Every variable has one value, by a term or otherwise, and every integer variable with a term
    an integer polynomial in integers.
    """
    values = [context.polynomial(terms[name]) for name in story.integers & set(terms)]
    whole = all(
        value.den == 1 and variables_of(context, value) <= context.integers for value in values
    )
    once = not set(terms) & set(others) and set(terms) | set(others) == set(needed)
    require(
        once and whole, "every variable needs one value, an integer one an integer", sorted(terms)
    )


RULES = {
    "close": close_at_once,
    "psatz": close_by_positivstellensatz,
    "cases": close_by_cases,
    "sign": close_by_sign,
    "interval": close_by_interval,
    "boxes": close_by_boxes,
    "integral": close_by_integrality,
    "use": close_by_use,
}


def close(state, node, known):
    """Shows that the state has no point, by the rule that the node names."""
    require(
        isinstance(node, list) and node and isinstance(node[0], str) and node[0] in RULES,
        "an unknown rule",
        node,
    )
    RULES[node[0]](state, known, *node[1:])


# ------------------------------------------------------------ statements


def definition(text):
    name, _, said = text.partition(" = ")
    return name, parse(said)


def call(text, shape):
    """NAME = sqrt(term), or NAME = root(polynomial, low, high), as the shape says: the name and the
    arguments.
    """
    (name, node), expected = definition(text), parse(shape)
    same = (
        isinstance(node, ast.Call)
        and not node.keywords
        and ast.unparse(node.func) == expected.func.id
    )
    require(same and len(node.args) == len(expected.args), "expected " + shape, text)
    return name, node.args


def written(node):
    """The text of a tree, which `parse` reads back as the same tree: one thing, whatever stands
    around it in parentheses.
    """
    return ast.unparse(node).replace(" ** ", "^").replace("==", "=")


def listed(text):
    node = parse(text)
    return [written(part) for part in (node.elts if isinstance(node, ast.Tuple) else [node])]


def mapping(text):
    """NAMES -> TERMS or GUARD -> TERMS, as text: what the terms are the next state of, or where
    they are.
    """
    left, right = text.split(" -> ")
    return listed(left), listed(right)


LINES = {  # how what follows each keyword is read
    **dict.fromkeys(("forall", "integer", "exists", "over", "sharp", "state"), str.split),
    "let": definition,
    "root": lambda text: call(text, "sqrt(term)"),
    "number": lambda text: call(text, "root(polynomial, low, high)"),
    **dict.fromkeys(("range", "given", "have", "with", "show", "domain", "holds"), parse),
    **dict.fromkeys(("iterates", "after", "piece"), mapping),
    "word": lambda text: [int(k) for k in text.split()],
    **dict.fromkeys(("map", "descent", "contraction", "attraction", "escape"), str),
    **dict.fromkeys(
        ("space", "rank", "stage", "on", "rate", "radius", "size"),
        lambda text: written(parse(text)),
    ),
    **dict.fromkeys(("point", "weights", "start"), listed),
}
# the lines that each kind of statement has, in this order, so that none can be overlooked
ORDERS = {
    "universal": (
        r"(forall )?(integer )?((range|given|have|let|root) )*(exists ((with|let) )*)?show "
    ),
    "sharp": r"sharp over domain (number )*holds ",
    "iterates": r"forall integer (let )*iterates after ",
    "map": r"over domain state space (piece )+",
    "descends": r"map domain (root )*rank (stage )+",
    "contracts": r"map domain (root )*on point weights rate radius size ",
    "attracts": r"descent contraction ",
    "escapes": r"map domain (root )*point start word ",
    "exactly": r"attraction escape ",
}


class Statement:
    """One statement as text: its name, its lines in order as (keyword, what it says), and its kind,
    which their order tells.
    """

    def __init__(self, name):
        self.name, self.lines, self.texts, self.kind = name, [], [], ""

    def get(self, keyword):
        return [said for key, said in self.lines if key == keyword]

    def text(self, keyword=""):
        """The text of the first line of this keyword, or of the whole statement."""
        rows = [(key, text) for (key, _), text in zip(self.lines, self.texts)]
        return (
            next(text for key, text in rows if key == keyword)
            if keyword
            else "\n".join(" ".join(row) for row in [("statement", self.name), *rows])
        )


def read_statements(text):
    """The statements of a file in order; a blank line or a line that starts with # says nothing."""
    statements, current = {}, None
    for count, line in enumerate(text.split("\n"), 1):
        keyword, _, rest = line.strip().partition(" ")
        try:
            if keyword == "statement":
                named = (
                    re.fullmatch(r"[\w.\-]+/[\w.\-]+", rest, re.ASCII) and rest not in statements
                )
                require(named, "a statement's name is not ID/part, or stands twice", rest)
                current = statements[rest] = Statement(rest)
            elif keyword and not keyword.startswith("#"):
                require(
                    current and keyword in LINES,
                    "an unknown kind of line, or one before the first statement",
                    line,
                )
                current.lines.append((keyword, LINES[keyword](rest)))
                current.texts.append(rest)
        except (Rejected, ValueError, TypeError, RecursionError, MemoryError) as reason:
            raise Rejected(f"statements, line {count}: {reason}") from None
    for name, statement in statements.items():
        order = "".join(keyword + " " for keyword, _ in statement.lines)
        statement.kind = next(
            (kind for kind, pattern in ORDERS.items() if re.fullmatch(pattern, order)), ""
        )
        require(
            statement.kind,
            "the lines of a statement are missing or out of order",
            f"{name}: {order}",
        )
    return statements


class Unfolding:
    """A statement's lines in order, as variables, premises, obligations and goals over polynomials.

    A variable whose value the context knows keeps it; any other is declared.  `sharp`: the domain
    and the condition of a sharp range take the place of the statement's own range lines.  Without
    `shown`, what is shown is left out: the premises are asked for alone.
    """

    def __init__(self, statement, context, sharp=None, shown=True):
        self.context, self.premises, self.obligations, self.goals = context, [], [], []
        self.variables, self.universal, self.given = set(), [], set(context.values)
        self.integers = {name for line in statement.get("integer") for name in line}
        quantified = {
            name
            for keyword in ("forall", "exists")
            for line in statement.get(keyword)
            for name in line
        }
        valued = self.given <= quantified | {said[0] for said in statement.get("root")}
        require(
            self.integers <= quantified and valued,
            "an integer, or a value, for what is not a variable",
            statement.name,
        )
        for keyword, said in statement.lines:
            for name in said if keyword in ("forall", "exists") else []:
                self.variable(name, keyword == "forall")
            for node in sharp or [] if keyword == "forall" else []:
                self.assume(node, self.premises)
            if keyword == "given" or keyword == "range" and sharp is None:
                self.assume(said, self.premises)
            elif keyword == "have":
                self.obligations.append((len(self.premises), negate(context.formula(said))))
                self.assume(said, self.premises)
            elif keyword == "let":
                context.define(said[0], context.value(said[1]))
            elif keyword == "root":
                name, value = said[0], context.value(said[1][0])
                self.obligations.append((len(self.premises), context.atom(value, "<", ZERO)))
                self.variable(name, True)
                root = context.values[name]
                self.premises += [
                    context.atom(root, ">=", ZERO),
                    context.atom(root * root, "=", value),
                ]
            elif keyword == "with" or keyword == "show" and shown:
                self.assume(said, self.goals)

    def variable(self, name, universal):
        require(name not in self.variables, "a variable is declared twice", name)
        self.variables.add(name)
        self.universal += [name] if universal else []
        if name not in self.given:
            self.context.declare(name, name in self.integers)

    def assume(self, node, formulas):
        formulas.append(self.context.formula(node))
        self.context.license(formulas[-1])

    def goal(self, truth):
        return join("and", self.goals) if truth else negate(join("and", self.goals))

    def state(self, count=None):
        """The state that assumes the premises, or the first `count` of them."""
        return State(self.context).assume(join("and", self.premises[:count]))


# -------------------------------------------------------- STATEMENT RULES: what settles a statement


def prove(statement, certificate, known, sharp=None):
    """For all variables: premises => goals.  ["proof", [node, ...], node] or ["witness", [node,
    ...], found].

    The first nodes show, from the premises before it, every `have` line and that the term under
    every `root` is >= 0.  Then either the state "premises and not goals" is closed, or terms are
    found for the `exists` variables that make the goals hold.
    """
    way, steps, last = certificate
    story = Unfolding(statement, Context(), sharp)
    for (count, negation), node in zip(story.obligations, steps, strict=True):
        close(story.state(count).assume(negation), node, known)
    require(
        way == ("witness" if statement.get("exists") else "proof"),
        "a statement with exists needs a witness, any other a proof",
        way,
    )
    if way == "proof":
        close(story.state().assume(story.goal(False)), last, known)
    else:
        own = {name: story.context.values[name] for name in story.universal}
        find(story.state(), last, known, "witness", {statement.name: statement}, own, sharp)


def find(state, found, known, purpose, statements, base, sharp=None):
    """Values for variables of a statement, given all that the state assumes, with nodes that show
    what they are for.

    [name, [adjoined, ...], {variable: term}, node] for the purposes "point" (the premises hold) and
    "witness" (the goals hold); [name, [adjoined, ...], {variable: term}, node, node] for
    "counterexample": the first node shows that the premises hold, the second that the goals fail,
    whatever the `exists` variables are.  Adjoined: [new name, p, low, high, node, node] names a
    root of the polynomial p in the new name between the terms low and high; the nodes show low <=
    high and p(low) <= 0, and p(high) >= 0 (intermediate value). ["sign", p, found, found, found]
    tells p < 0, p = 0 and p > 0 apart first; ["empty", node] closes such a case.
    """
    if found[0] == "sign":
        return [
            find(case, part, known, purpose, statements, base, sharp)
            for case, part in zip(state.by_sign(found[1]), found[2:], strict=True)
        ]
    if found[0] == "empty":
        return close(state, *found[1:], known)
    name, adjoined, terms, node, *rest = found
    require(
        len(rest) == (purpose == "counterexample") and name in statements,
        "a witness of the wrong shape, or for another statement",
        name,
    )
    statement, state = statements[name], state.branch()
    for entry in adjoined:
        adjoin(state, known, *entry)
    values = {variable: state.context.value(parse(text)) for variable, text in terms.items()}
    story = Unfolding(
        statement, Context(state.context, {**values, **base}), sharp, purpose != "point"
    )
    one_value_each(
        state.context,
        story,
        terms,
        base,
        story.variables if purpose == "witness" else story.universal,
    )
    close(
        state.branch(negate(join("and", story.goals if purpose == "witness" else story.premises))),
        node,
        known,
    )
    for last in rest:
        close(state.branch(story.goal(True), story.context), last, known)


def adjoin(state, known, name, text, low, high, below, above):
    """Adds a variable with p = 0 and low <= it <= high, after showing that low <= high and p(low)
    <= 0, and that p(high) >= 0.
    """
    context, tree = state.context, parse(text)
    ends = [context.value(parse(end)) for end in (low, high)]
    first, second = (Context(context, {**context.values, name: end}).value(tree) for end in ends)
    close(
        state.branch(
            join("or", [context.atom(ends[0], ">", ends[1]), context.atom(first, ">", ZERO)])
        ),
        below,
        known,
    )
    close(state.branch(context.atom(second, "<", ZERO)), above, known)
    context.declare(name)
    root = context.values[name]
    for left, relation, right in (
        (root, ">=", ends[0]),
        (root, "<=", ends[1]),
        (context.value(tree), "=", ZERO),
    ):
        state.assume(context.atom(left, relation, right))


def check_sharp(statement, certificate, known, statements):
    """For all parameters in the domain: (all the named statements hold) <=> (the condition holds).
    [{name: prove}, found, sample].

    A statement's own range lines give way to the domain and the condition; a parameter is an
    integer where the statements say so. Inside, each statement is proved; outside, counterexamples
    to one of them are found.  Each `number` line: its polynomial has exactly one root between its
    ends, where it changes its sign.  The sample {parameter: value} is a point of the domain.
    """
    (names,), (over,), (domain,), (condition,) = (
        statement.get(keyword) for keyword in ("sharp", "over", "domain", "holds")
    )
    inside, outside, sample = certificate
    ours = (
        names
        and set(inside) == set(names)
        and all(n in statements and statements[n].kind == "universal" for n in names)
    )
    require(ours, "a sharp range proves each of its earlier statements", names)
    whole, *others = [
        {p for p in over if any(p in line for line in statements[name].get("integer"))}
        for name in names
    ]
    require(
        all(other == whole for other in others),
        "a parameter is an integer in one statement of a sharp range and not in another",
        names,
    )
    state, values = (
        State(Context()),
        {name: number(rational(value)) for name, value in sample.items()},
    )
    for parameter in over:
        state.context.declare(parameter, parameter in whole)
    met = (
        set(values) == set(over)
        and all(values[p].den == 1 for p in whole)
        and Context(None, values).formula(domain) is True
    )
    require(met, "the sample is not in the domain of a sharp range", sample)
    for name, (tree, *ends) in statement.get("number"):
        poly, low, high = (
            state.context.value(tree),
            *(state.context.value(end).constant() for end in ends),
        )
        p = univariate(state.context, poly, *variables_of(state.context, poly))
        once = low < high and count_roots(p, low, high) == 1 and sign_at(p, low) != sign_at(p, high)
        require(once, "not one root, with a change of sign, between the ends of a number", name)
    for name in names:
        prove(statements[name], inside[name], known, [domain, condition])
    state.assume(state.context.formula(domain))
    state.assume(negate(state.context.formula(condition)))
    base = {parameter: state.context.values[parameter] for parameter in over}
    find(
        state,
        outside,
        known,
        "counterexample",
        {name: statements[name] for name in names},
        base,
        [domain],
    )


# ------------- ORBIT RULES: what holds of every orbit of a map, from premises that this file writes


def put(text, values):
    """The text with other text in place of some names."""
    return re.sub(r"[A-Za-z]\w*", lambda found: values.get(found[0], found[0]), text)


def names_in(*texts):
    return set(re.findall(r"[A-Za-z_]\w*", " ".join(texts))) - WORDS


def premises_of_iterates(statement, known):
    """The K-th iterate of the map, for every integer K >= 0.  Premises: P(0) is the identity, and
    map(P(K)) = P(K + 1).
    """
    (variables,), (counts,), ((state, images),), ((count, powers),) = map(
        statement.get, ("forall", "integer", "iterates", "after")
    )
    lets = [
        f"let {text}"
        for (keyword, _), text in zip(statement.lines, statement.texts)
        if keyword == "let"
    ]
    shaped = state == variables[: len(state)] and 0 < len(state) == len(images) == len(powers)
    apart = count == counts and set(count) <= set(variables[len(state) :])
    require(
        shaped and apart,
        "a map names its variables first, an image for each, and one integer apart",
        statement.name,
    )
    still = not names_in(*images) & set(count) and not names_in(*lets) & {*count, *state}
    require(
        still, "a map that is iterated cannot depend on the number of iterations", statement.name
    )
    declared = {*variables, *(name for name, _ in statement.get("let"))}
    require(names_in(*images, *powers) <= declared, "an undeclared name in a map", statement.name)
    (k,), after = count, {name: name + "_next" for name in state}
    head = [f"forall {' '.join(variables)}", f"integer {k}", *lets]
    step = [
        f"({put(image, after)}) = ({put(power, {k: f'({k} + 1)'})})"
        for image, power in zip(images, powers)
    ]
    return {
        "start": [
            *head,
            "show "
            + " and ".join(
                f"({put(power, {k: '0'})}) = {name}" for name, power in zip(state, powers)
            ),
        ],
        "step": [
            *head,
            *(f"let {name}_next = {power}" for name, power in zip(state, powers)),
            "show " + " and ".join(step),
        ],
    }


class Orbits:
    """A map with the lines of a statement about it, from which the text of the premises is
    written.
    """

    def __init__(self, statement, known):
        self.own, self.map = (
            statement,
            (
                statement
                if statement.kind == "map"
                else earlier_of("map", statement.text("map"), known)
            ),
        )
        (self.parameters,), (self.state,), (self.space,) = map(
            self.map.get, ("over", "state", "space")
        )
        self.domain, self.pieces, self.moving, self.roots, self.fixed = (
            statement.text("domain"),
            self.map.get("piece"),
            set(self.state),
            [],
            [],
        )
        for line in (
            text
            for (keyword, _), text in zip(statement.lines, statement.texts)
            if keyword == "root"
        ):
            name, _, under = line.partition(" = ")
            moves = self.moving & names_in(under)
            self.moving |= {name} if moves else set()
            (self.roots if moves else self.fixed).append("root " + line)
        fits = all(
            len(guard) == 1 and len(images) == len(self.state) for guard, images in self.pieces
        )
        own = names_in(*(text for piece in self.pieces for side in piece for text in side)) <= {
            *self.parameters,
            *self.state,
        }
        require(
            fits and own,
            "a piece gives one term in parameters and state for each state variable",
            self.map.name,
        )

    def next(self, text):
        return put(text, {name: name + "_next" for name in self.moving})

    def for_all(self, *rows, extra=()):
        """For all parameters in the domain, with the roots of parameters."""
        return [
            "forall " + " ".join([*self.parameters, *extra]),
            f"range {self.domain}",
            *self.fixed,
            *rows,
        ]

    def at(self, *rows, extra=()):
        """For all parameters in the domain and all states of the space."""
        return self.for_all(f"given {self.space}", *self.roots, *rows, extra=[*self.state, *extra])

    def step(self, k, *rows, show, extra=()):
        """Where the k-th piece applies: something of the next state, which is in the space by the
        map's premises.
        """
        (guard,), images = self.pieces[k]
        known = (
            []
            if self.own is self.map
            else ["given " + self.next(self.space), *map(self.next, self.roots)]
        )
        image = [f"let {name}_next = {image}" for name, image in zip(self.state, images)]
        return self.at(*rows, f"given {guard}", *image, *known, f"show {show}", extra=extra)

    def terms(self, keyword):
        (terms,) = self.own.get(keyword)
        constants = {*self.parameters, *(line.split(" ")[1] for line in self.fixed)}
        fits = len(terms) == len(self.state) and names_in(*terms) <= constants
        require(
            fits, "one term in the parameters for each state variable is expected", self.own.name
        )
        return terms

    def with_domain(self, premises):
        """Beside other premises: the domain is not empty, and is part of the map's."""
        inside = (
            {}
            if self.own is self.map
            else {"inside": self.for_all("show " + self.map.text("domain"))}
        )
        return {
            "possible": ["exists " + " ".join(self.parameters), f"show {self.domain}"],
            **inside,
            **premises,
        }


def earlier_of(kind, name, known):
    require(
        name in known and known[name].kind == kind,
        f"no earlier certified statement of kind {kind} has this name",
        name,
    )
    return known[name]


def all_of(parts, op=" and "):
    return op.join(f"({part})" for part in parts)


def premises_of_map(statement, known):
    """A map f of the space into itself: for all parameters in the domain, each state of the space
    has exactly one piece whose guard holds, f(state) is given by that piece, and f(state) is in the
    space.
    """
    f = Orbits(statement, known)
    guards = [guard for (guard,), _ in f.pieces]
    pairs = [(i, k) for i in range(len(guards)) for k in range(i)]
    return f.with_domain(
        {
            "covers": f.at("show " + all_of(guards, " or ")),
            **{
                f"apart-{i + 1}-{k + 1}": f.at(
                    f"given {guards[i]}", f"given {guards[k]}", "show 0 = 1"
                )
                for i, k in pairs
            },
            **{f"stays-{k + 1}": f.step(k, show=f.next(f.space)) for k in range(len(guards))},
        }
    )


def premises_of_descent(statement, known):
    """Descent of a rank to a trap: stages A_1, .., A_m.  For all parameters in the domain and all
    states s of the space, f^N(s) is in A_m for every integer N >= rank(s) + m - 1.

    Premises: rank >= 0; outside of all stages rank(f(s)) <= rank(s) - 1; f takes A_k into A_(k+1),
    and A_m into itself. So the first visit to a stage is after at most rank(s) steps, and m - 1
    more steps, or fewer, lead to A_m.
    """
    f, (rank,), stages = Orbits(statement, known), statement.get("rank"), statement.get("stage")
    premises = {"bounded": f.at(f"show ({rank}) >= 0")}
    for k in range(len(f.pieces)):
        premises[f"falls-{k + 1}"] = f.step(
            k, f"given not ({all_of(stages, ' or ')})", show=f"({f.next(rank)}) <= ({rank}) - 1"
        )
        for i, (stage, after) in enumerate(zip(stages, [*stages[1:], stages[-1]])):
            premises[f"stage-{i + 1}-{k + 1}"] = f.step(k, f"given {stage}", show=f.next(after))
    return f.with_domain(premises)


def premises_of_contraction(statement, known):
    """Contraction in a weighted sup norm, |s - e| = max |s_j - e_j| / weight_j, e the point.  For
    all parameters in the domain: f(e) = e; for all states s of the space in the set `on` and all
    integers n >= 0, f^n(s) is in it and |f^n(s) - e| <= rate^n |s - e| <= rate^n size; and all
    states of the space with |s - e| <= radius are in it.  So e is stable, and attracts the set.

    Premises: 0 <= rate < 1, weights > 0, radius > 0, size > 0; e is in the space; `on` holds where
    |s - e| <= radius, is taken into itself, and has |s - e| <= size; and on it |s - e| <= distance
    implies |f(s) - e| <= rate distance, for every distance >= 0.
    """
    f, (on,), (rate,), (radius,), (size,) = (
        Orbits(statement, known),
        *map(statement.get, ("on", "rate", "radius", "size")),
    )
    point, weights = f.terms("point"), f.terms("weights")

    def within(distance, names=f.state):
        return all_of(
            f"-({distance})*({weight}) <= {name} - ({e}) and {name} - ({e}) <="
            f" ({distance})*({weight})"
            for name, e, weight in zip(names, point, weights)
        )

    premises = {
        "constants": f.for_all(
            "show "
            + all_of(
                [
                    f"({rate}) >= 0",
                    f"({rate}) < 1",
                    *(f"({c}) > 0" for c in [*weights, radius, size]),
                ]
            )
        ),
        "point": f.for_all(
            *(f"let {name}_next = {e}" for name, e in zip(f.state, point)),
            "show " + put(f.space, {n: n + "_next" for n in f.state}),
        ),
        "surrounds": f.at("given " + within(radius), f"show {on}"),
        "size": f.at(f"given {on}", "show " + within(size)),
    }
    near, after = (
        ["given distance >= 0", "given " + within("distance")],
        [name + "_next" for name in f.state],
    )
    for k in range(len(f.pieces)):
        premises[f"stays-{k + 1}"] = f.step(k, f"given {on}", show=f.next(on))
        premises[f"closer-{k + 1}"] = f.step(
            k, f"given {on}", *near, show=within(f"({rate})*distance", after), extra=["distance"]
        )
    return f.with_domain(premises)


def premises_of_attraction(statement, known):
    """A descent whose last stage lies in the set of a contraction of the same map.  For all
    parameters in the descent's domain, the point is stable, f^n(s) tends to it for all states s of
    the space, and |f^(N+k)(s) - e| <= rate^k size for all integers N >= rank(s) + m - 1, k >= 0.
    """
    f = Orbits(earlier_of("descends", statement.text("descent"), known), known)
    other = Orbits(earlier_of("contracts", statement.text("contraction"), known), known)
    require(f.map is other.map, "two statements about different maps are joined", statement.name)
    roots = [root for root in other.fixed + other.roots if root not in f.fixed + f.roots]
    return {
        "inside": f.for_all(f"show {other.domain}"),
        "enters": f.at(*roots, f"given {f.own.get('stage')[-1]}", f"show {other.own.get('on')[0]}"),
    }


def premises_of_escape(statement, known):
    """A periodic orbit: for all parameters in the domain the start is in the space, f^n(start) =
    start for the length n of the word of pieces, and start is not the point; so the orbit of the
    start does not tend to the point.
    """
    f, (word,) = Orbits(statement, known), statement.get("word")
    require(word, "a periodic orbit has at least one step", statement.name)
    here, rows, shown = (
        f.terms("start"),
        [f"let {name}_point = {e}" for name, e in zip(f.state, f.terms("point"))],
        [],
    )
    for count, number_of_piece in enumerate(word):
        (guard,), images = at(f.pieces, number_of_piece - 1)
        now = {name: f"{name}_{count}" for name in f.state}
        rows += [f"let {now[name]} = {term}" for name, term in zip(f.state, here)]
        shown += (
            [put(guard, now)]
            if count
            else [
                put(f.space, now),
                put(guard, now),
                all_of((f"{n}_0 != {n}_point" for n in f.state), " or "),
            ]
        )
        here = [put(image, now) for image in images]
    shown += [f"{name}_0 = ({last})" for name, last in zip(f.state, here)]
    return f.with_domain({"start": f.for_all(*rows, "show " + all_of(shown))})


def premises_of_sharpness(statement, known):
    """An attraction and an escape, from the same point of the same map, on domains that make up the
    map's.  For all parameters in the map's domain: the point is stable and attracts every state of
    the space <=> the parameters are in the domain of the attraction's descent.
    """
    attraction = earlier_of("attracts", statement.text("attraction"), known)
    f, inner = (Orbits(known[attraction.text(line)], known) for line in ("descent", "contraction"))
    other = Orbits(earlier_of("escapes", statement.text("escape"), known), known)
    require(f.map is other.map, "two statements about different maps are joined", statement.name)
    roots = [root for root in inner.fixed if root not in other.fixed]
    same = all_of(
        f"({one}) = ({two})" for one, two in zip(inner.terms("point"), other.terms("point"))
    )
    return {
        "covers": Orbits(f.map, known).for_all(f"show ({f.domain}) or ({other.domain})"),
        "same-point": other.for_all(*roots, f"show {same}"),
    }


ORBIT_RULES = {
    "iterates": premises_of_iterates,
    "map": premises_of_map,
    "descends": premises_of_descent,
    "contracts": premises_of_contraction,
    "attracts": premises_of_attraction,
    "escapes": premises_of_escape,
    "exactly": premises_of_sharpness,
}


def premises_of(statement, known):
    """The premises of an orbit rule, as statements that a certificate has to prove: {name:
    statement}.
    """
    premises = {
        name: [f"statement {statement.name}.{name}", *rows]
        for name, rows in ORBIT_RULES[statement.kind](statement, known).items()
    }
    return {name: read_statements("\n".join(rows))[rows[0][10:]] for name, rows in premises.items()}


def check_orbit_rule(statement, certificate, known, statements):
    """{premise: prove}: each of the premises that the rule asks for is proved, and there is no
    other.
    """
    premises = premises_of(statement, known)
    require(
        set(certificate) == set(premises),
        "the premises of a rule are missing or left over",
        sorted(set(certificate) ^ set(premises)),
    )
    for name, premise in premises.items():
        try:
            prove(premise, certificate[name], known)
        except Rejected as reason:
            raise Rejected(f"premise {name} of {statement.name}: {reason}") from None


def settle(statement, certificate, known, statements):
    """The outcome: {"unknown": why}, {"refuted": found}, {"certified": proof} or, for all but sharp
    and iterates, {.., "point": found}.

    A certified statement carries a point that meets its premises, so that it says something.  A
    refuted one has a counterexample.
    """
    says = sorted(certificate) if isinstance(certificate, dict) else []
    if says == ["unknown"]:
        return "unknown"
    allowed = (
        (["refuted"], ["certified", "point"]) if statement.kind == "universal" else (["certified"],)
    )
    require(says in allowed, "a certificate with missing or left over keys", says)
    if statement.kind != "universal":
        (check_sharp if statement.kind == "sharp" else check_orbit_rule)(
            statement, certificate["certified"], known, statements
        )
        return "certified"
    if says[0] == "certified":
        prove(statement, certificate["certified"], known)
    find(
        State(Context()),
        certificate[says[-1]],
        known,
        "counterexample" if says == ["refuted"] else "point",
        {statement.name: statement},
        {},
    )
    return says[0]


# ------------------------------------------------------------ files


def unique(pairs):
    require(
        len(dict(pairs)) == len(pairs),
        "a key stands twice",
        lambda: sorted(key for key, _ in pairs),
    )
    return dict(pairs)


def refuse(text):
    raise Rejected("not an exact integer", text)


def load(path):
    try:
        with open(path, encoding="ascii") as file:
            text = file.read(MAX_FILE + 1)
    except (OSError, UnicodeDecodeError) as error:
        raise Rejected("a file cannot be read", f"{path} ({type(error).__name__})") from None
    fits = len(text) <= MAX_FILE and not re.search(r"[^\x20-\x7e\n]", text)
    require(fits, "a file is too large, or holds other characters than printable ASCII", path)
    return text


def read_certificates(text):
    try:
        data = json.loads(text, object_pairs_hook=unique, parse_float=refuse, parse_constant=refuse)
    except (ValueError, RecursionError) as error:
        raise Rejected("not a certificate file", error) from None
    require(isinstance(data, dict), "not a certificate file")
    return data


def check_one(statement, certificate, known, earlier):
    """(outcome, reason) of one statement; whatever is wrong with the certificate is a rejection,
    never a crash.
    """
    work_left[0] = MAX_WORK
    try:
        return settle(statement, certificate, known, earlier), ""
    except Exception as error:
        return "rejected", (
            str(error)
            if isinstance(error, Rejected)
            else f"malformed certificate ({type(error).__name__})"
        )


def check_folder(folder):
    """[(name, outcome, reason)] for every statement of a folder in order, and for every certificate
    that has no statement.
    """
    statements, files, results, known, earlier = (
        read_statements(load(os.path.join(folder, "statements.txt"))),
        {},
        [],
        {},
        {},
    )
    for claim in dict.fromkeys(name.split("/")[0] for name in statements):
        try:
            files[claim] = read_certificates(load(os.path.join(folder, claim + ".json")))
        except Rejected as reason:
            files[claim] = {}
            results.append((claim, "rejected", str(reason)))
    for name, statement in statements.items():
        certificate = files[name.split("/")[0]].pop(name, {})
        outcome, reason = check_one(statement, certificate, known, earlier)
        results.append((name, outcome, reason if certificate else "no certificate"))
        earlier[name] = statement
        if outcome == "certified":
            known[name] = statement
    left = [name for rest in files.values() for name in rest] + sorted(
        f for f in os.listdir(folder) if f.endswith(".json") and f[:-5] not in files
    )
    return results + [(name, "rejected", "a certificate without a statement") for name in left]


def report(results):
    """Prints what is rejected, and how many statements have which outcome; 0 where nothing is
    rejected, else 1.
    """
    for name, _, reason in (one for one in results if one[1] == "rejected"):
        print("rejected ", ascii(f"{name}: {reason}")[1:-1])
    kinds = ("certified", "refuted", "unknown", "rejected")
    print(
        f"{len(results)} statements: "
        + ", ".join(f"{sum(o == kind for _, o, _ in results)} {kind}" for kind in kinds)
    )
    return int(not results or any(outcome == "rejected" for _, outcome, _ in results))


def main(arguments):
    try:
        return report(
            check_folder(
                *arguments or [os.path.join(os.path.dirname(os.path.abspath(__file__)), "store")]
            )
        )
    except (Rejected, TypeError) as reason:
        print("checker:", ascii(str(reason))[1:-1], file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
