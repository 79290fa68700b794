"""States, the rules that close them, and what settles a statement that is for all its variables.

A state is what is assumed on one branch of a proof.  PROOF RULES show that a state has no point;
STATEMENT RULES prove a statement, or find a point, a witness or a counterexample, by closing
states.  Every rule is stated in full where it is applied.  A certificate is read as a hint: what a
rule takes from it is either checked, or cannot make a false step true.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Collection, Mapping
from fractions import Fraction
from math import prod
from typing import Any

from .algebra import (
    BITS,
    ONE,
    Atom,
    Formula,
    Join,
    Kind,
    Poly,
    Rational,
    Rejected,
    Work,
    at,
    axis_first,
    bernstein,
    conjuncts,
    fold,
    halved,
    join,
    negate,
    require,
    sign_changes,
    sum_of_products,
    variable,
)
from .language import Context, Known, Range, Statement, Unfolding, univariate, variables_of
from .text import parse, rational

Hint = Any  # of a certificate, which anyone may have written: what does not fit is refused

# ------------------------------------------------------------ states


class State:
    """What is assumed on one branch of a proof: facts (polynomial, relation) that all hold, and
    disjunctions still open.

    Certificates name variables by their keys.  Only what the facts say licenses a division here:
    nothing that is yet to be shown.
    """

    def __init__(self, variables: Context, parent: State | None = None) -> None:
        values = variables.values
        if not parent or variables is not parent.context:  # where each key stands for its variable
            values = {key: variable(at, variables.work) for key, at in variables.index.items()}
        self.context: Context = Context(variables, values)
        self.context.licensed = dict(parent.context.licensed) if parent else {}
        self.facts: list[tuple[Poly, str]] = list(parent.facts) if parent else []
        self.choices: list[list[Atom | Join]] = list(parent.choices) if parent else []
        # else branches would cost nothing
        variables.work.spend(len(values) + len(self.facts) + len(self.choices))
        self.closed: bool = parent.closed if parent else False

    def assume(self, formula: Formula) -> State:
        """Adds a formula to what holds here."""
        for part in conjuncts(formula):
            if isinstance(part, bool):
                self.closed = self.closed or not part
            elif part[0] == "atom":
                self.facts.append((part[1], part[2]))
            else:
                self.choices.append(part[1])
        self.context.license(formula)
        return self

    def branch(self, formula: Formula = True, variables: Context | None = None) -> State:
        """A state of its own that assumes one more formula."""
        return State(variables or self.context, self).assume(formula)

    def by_sign(self, text: str) -> list[State]:
        """The three states in which the polynomial is < 0, = 0 and > 0."""
        poly = self.context.polynomial(text)
        return [
            self.branch(fold(-poly, ">")),
            self.branch(fold(poly, "=")),
            self.branch(fold(poly, ">")),
        ]


def state_of(unfolding: Unfolding, count: int | None = None) -> State:
    """The state that assumes the premises of an unfolding, or the first `count` of them."""
    return State(unfolding.context).assume(join("and", unfolding.premises[:count]))


# ---------------------------- PROOF RULES: each closes a state, that is, shows that it has no point


def close_at_once(state: State, known: Known) -> None:
    """["close"]: the state assumes a false constant, such as 1 < 0."""

    def facts() -> str:
        return "; ".join(f"{state.context.show(p)} {relation} 0" for p, relation in state.facts)

    require(state.closed, Kind.NOTHING_FALSE, facts)


def close_by_positivstellensatz(
    state: State, known: Known, products: Hint, equations: Hint
) -> None:
    """["psatz", [[c, [[i, e], ...], q], ...], [[j, m], ...]]:

    sum c * prod fact_i^e * q^2  +  sum m * fact_j  =  0 identically, where every c is a rational >
    0, every fact_i is > 0 or >= 0 (or != 0, with e even), every fact_j is an equation, and one term
    at least is > 0: its facts are all strict and q is a constant other than 0.  So 0 > 0.
    Identities, cofactors of equations, Handelman and Bernstein forms are special cases.
    """
    context = state.context
    strict = False
    total: list[tuple[Rational, Poly, Poly]] = []
    for coefficient, factors, root in products:
        weight = rational(coefficient)  # a negative weight would turn an inequality
        require(weight > 0, Kind.COEFFICIENT, coefficient)
        parts = []
        positive = True
        if root != "1":
            square = context.polynomial(root)
            positive = bool(square.constant())  # a root that may vanish makes nothing strict
            parts = [square, square]
        for index, exponent in factors:
            poly, relation = at(state.facts, index)
            # an even power of an equation, or an odd one of what may be negative, has no sign
            signed = type(exponent) is int and exponent > 0
            signed = signed and relation != "=" and (relation != "!=" or exponent % 2 == 0)
            if not signed:
                fact = f"({context.show(poly)} {relation} 0)^{exponent}"
                raise Rejected(Kind.FACTOR, fact)
            parts.append(poly**exponent)
            positive = positive and relation != ">="
        last = parts.pop() if parts else ONE
        total.append((weight, prod(parts[1:], start=parts[0]) if parts else ONE, last))
        strict = strict or positive
    for index, cofactor in equations:
        poly, relation = at(state.facts, index)
        require(relation == "=", Kind.EQUATION, lambda poly=poly: context.show(poly))
        # a cofactor is a polynomial: 1/0 times an equation would be anything
        total.append((1, poly, context.polynomial(cofactor)))
    rest = sum_of_products(total, context.work)
    require(not rest.terms, Kind.SUM, lambda: context.show(rest))
    require(strict, Kind.STRICT)


def close_by_cases(state: State, known: Known, index: Hint, nodes: Hint) -> None:
    """["cases", k, [node, ...]]: one node for each alternative of the k-th open disjunction."""
    alternatives = at(state.choices, index)
    rest = state.branch()
    del rest.choices[index]
    # fewer nodes would leave an alternative out
    require(len(nodes) == len(alternatives), Kind.CASES, len(alternatives))
    for alternative, node in zip(alternatives, nodes):
        close(rest.branch(alternative), node, known)


def close_by_sign(
    state: State, known: Known, text: Hint, below: Hint, zero: Hint, above: Hint
) -> None:
    """["sign", p, node, node, node]: p < 0, p = 0 or p > 0."""
    for case, node in zip(state.by_sign(text), (below, zero, above)):
        close(case, node, known)


def bound(state: State, index: Hint, name: str, side: int) -> Fraction:
    """The number c of fact `index`, which says c <= the variable (side 1) or the variable <= c
    (side -1), or strictly.
    """
    line, sense = at(state.facts, index)
    constant, slope, *more = univariate(state.context, line, name)
    # an upper bound taken for a lower one would turn the box inside out
    linear = not more and sense in (">", ">=")
    require(linear and slope * side > 0, Kind.BOUND, lambda: state.context.show(line))
    return Fraction(-constant, slope)


def parts_of_box(
    sizes: list[int], c: list[int], letter: str, work: Work
) -> list[tuple[list[int], list[int]]]:
    """The boxes, with their Bernstein coefficients, that a letter of a box tree asks to look at:
    see `close_by_boxes`.
    """
    to_end = letter <= "Z"
    place = ord(letter) - ord("A" if to_end else "a")
    count = at(sizes, place)
    rest = sizes[:place] + sizes[place + 1 :]
    size = len(c) // count
    work.spend(len(c) * (count + 4) * (1 + (max(map(int.bit_length, c)) >> 8)))
    # the axis comes first from here on, each of its indices `size` times
    c = axis_first(sizes, c, place)
    if to_end:
        steps = [y - x for x, y in zip(c, c[size:])]
        # on one face p is largest only where all its coefficients grow, or all fall, towards it
        require(min(steps) >= 0 or max(steps) <= 0, Kind.MONOTONE, letter)
        return [(rest, c[-size:] if max(steps) > 0 else c[:size])]
    lower, upper = halved(c, size)
    return [([count, *rest], upper), ([count, *rest], lower)]


def close_by_boxes(state: State, known: Known, index: Hint, bounds: Hint, tree: Hint) -> None:
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
    signed = relation in (">", ">=") and isinstance(tree, str)
    require(signed, Kind.BOX_FACT, relation)
    used = variables_of(state.context, poly)
    axes = []
    # strict: without the ends of a variable, the box would be a face of what has to be covered
    for name, (low, high) in zip(
        (n for n in state.context.index if n in used), bounds, strict=True
    ):
        ends = bound(state, low, name, 1), bound(state, high, name, -1)
        axes.append((BITS * state.context.index[name], *ends))
    boxes = [bernstein(poly, axes)]
    for letter in tree:
        require(boxes, Kind.BOX_LONG, tree)  # nothing is left to look at
        sizes, c = boxes.pop()
        if letter == ".":
            require(max(c) < (relation == ">"), Kind.BOX_SIGN, lambda c=c: max(c))
        else:
            boxes += parts_of_box(sizes, c, letter, state.context.work)
    require(not boxes, Kind.BOX_SHORT, tree)  # a box that no letter looks at is not covered


def close_by_integrality(state: State, known: Known, index: Hint, node: Hint) -> None:
    """["integral", i, node]: fact i is p > 0 with integer coefficients in integer variables only,
    so p - 1 >= 0.
    """
    poly, relation = at(state.facts, index)
    whole = variables_of(state.context, poly) <= state.context.integers
    whole = whole and all(c % poly.den == 0 for c in poly.terms.values())
    require(whole and relation == ">", Kind.INTEGRAL, lambda: state.context.show(poly))
    close(state.branch(fold(poly - state.context.number(1), ">=")), node, known)


def close_by_use(
    state: State, known: Known, name: Hint, arguments: Hint, fresh: Hint, node: Hint
) -> None:
    """["use", name, {variable: term}, {variable: fresh name}, node]: an instance of an earlier
    certified statement.

    The instance is the formula (its range, givens and haves => what it shows) for any terms in
    place of its variables, an integer variable standing for an integer polynomial in integer ones;
    what it says to exist is named by variables that do not yet occur.
    """
    # only certified ones are known: so no statement rests on itself, or on what was refuted
    require(name in known and known[name].kind == "universal", Kind.LEMMA, name)
    context = Context(state.context)
    values = {key: state.context.value(parse(text)) for key, text in arguments.items()}
    for key, new in sorted(fresh.items()):
        context.declare(new, any(key in line for line in known[name].get("integer")))
        values[key] = context.values[new]
    unfolding = Unfolding(known[name], Context(context, values))
    one_value_each(state.context, unfolding, arguments, fresh, unfolding.variables)
    # a term for what exists would choose the witness, which only the lemma may
    require(set(arguments) == set(unfolding.universal), Kind.FRESH, name)
    instance = join("or", [negate(join("and", unfolding.premises)), unfolding.goal(True)])
    close(state.branch(instance, context), node, known)


def one_value_each(
    context: Context,
    unfolding: Unfolding,
    terms: Mapping[str, str],
    others: Collection[str],
    needed: Collection[str],
) -> None:
    """Every variable has one value, by a term or otherwise, and every integer variable with a term
    an integer polynomial in integers.
    """
    whole = True
    for name in unfolding.integers & set(terms):
        value = context.polynomial(terms[name])
        # n/2 would pass for an integer
        whole = whole and value.den == 1 and variables_of(context, value) <= context.integers
    once = not set(terms) & set(others) and set(terms) | set(others) == set(needed)
    require(once and whole, Kind.VALUES, sorted(terms))


RULES: Mapping[str, Callable[..., None]] = {
    "close": close_at_once,
    "psatz": close_by_positivstellensatz,
    "cases": close_by_cases,
    "sign": close_by_sign,
    "boxes": close_by_boxes,
    "integral": close_by_integrality,
    "use": close_by_use,
}


def close(state: State, node: Hint, known: Known) -> None:
    """Shows that the state has no point, by the rule that the node names."""
    named = isinstance(node, (list, tuple)) and node and isinstance(node[0], str)
    require(named and node[0] in RULES, Kind.RULE, node)
    RULES[node[0]](state, known, *node[1:])


# -------------------------------------------------------- STATEMENT RULES: what settles a statement


def prove(
    statement: Statement,
    certificate: Hint,
    known: Known,
    sharp: Range | None = None,
    work: Work | None = None,
) -> None:
    """For all variables: premises => goals.  ["proof", [node, ...], node] or ["witness", [node,
    ...], found].

    The first nodes show, from the premises before it, every `have` line and that the term under
    every `root` is >= 0.  Then either the state "premises and not goals" is closed, or terms are
    found for the `exists` variables that make the goals hold.
    """
    way, steps, last = certificate
    unfolding = Unfolding(statement, Context(work=work), sharp)
    # strict: a `have` without a node would be assumed, not shown
    for (count, negation), node in zip(unfolding.obligations, steps, strict=True):
        close(state_of(unfolding, count).assume(negation), node, known)
    # with `proof`, a variable that exists would be taken as one that is for all
    require(way == ("witness" if statement.get("exists") else "proof"), Kind.WAY, way)
    if way == "proof":
        close(state_of(unfolding).assume(unfolding.goal(False)), last, known)
    else:
        own = {name: unfolding.context.values[name] for name in unfolding.universal}
        find(state_of(unfolding), last, known, "witness", {statement.name: statement}, own, sharp)


def find(
    state: State,
    found: Hint,
    known: Known,
    purpose: str,
    statements: Known,
    base: Mapping[str, Poly],
    sharp: Range | None = None,
) -> None:
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
        for case, part in zip(state.by_sign(found[1]), found[2:], strict=True):
            find(case, part, known, purpose, statements, base, sharp)
        return
    if found[0] == "empty":
        _, node = found
        close(state, node, known)
        return
    name, adjoined, terms, node, *rest = found
    # a counterexample needs both nodes: one whose premises fail refutes nothing
    shaped = len(rest) == (purpose == "counterexample") and name in statements
    require(shaped, Kind.WITNESS, name)
    statement = statements[name]
    state = state.branch()
    for entry in adjoined:
        adjoin(state, known, *entry)
    # `base` comes last: a certificate has no say in what is given to it
    values = {key: state.context.value(parse(text)) for key, text in terms.items()}
    inner = Context(state.context, {**values, **base})
    unfolding = Unfolding(statement, inner, sharp, purpose != "point")
    needed = unfolding.variables if purpose == "witness" else unfolding.universal
    one_value_each(state.context, unfolding, terms, base, needed)
    shown = unfolding.goals if purpose == "witness" else unfolding.premises
    close(state.branch(negate(join("and", shown))), node, known)
    for last in rest:
        close(state.branch(unfolding.goal(True), unfolding.context), last, known)


def rational_value(context: Context, node: ast.expr) -> Fraction:
    """The value of a term that is a number."""
    value = context.value(node).constant()
    if value is None:
        raise Rejected(Kind.NO_NUMBER, ast.unparse(node))
    return value


def adjoin(
    state: State,
    known: Known,
    name: Hint,
    text: Hint,
    low: Hint,
    high: Hint,
    below: Hint,
    above: Hint,
) -> None:
    """Adds a variable with p = 0 and low <= it <= high, after showing that low <= high and p(low)
    <= 0, and that p(high) >= 0.
    """
    context = state.context
    tree = parse(text)
    low, high = context.value(parse(low)), context.value(parse(high))
    first = Context(context, {**context.values, name: low}).value(tree)
    second = Context(context, {**context.values, name: high}).value(tree)
    zero = context.number(0)
    crossed = join("or", [context.atom(low, ">", high), context.atom(first, ">", zero)])
    close(state.branch(crossed), below, known)
    close(state.branch(context.atom(second, "<", zero)), above, known)
    context.declare(name)  # fresh, or refused: else p = 0 would be assumed of an old variable
    root = context.values[name]
    state.assume(context.atom(root, ">=", low))
    state.assume(context.atom(root, "<=", high))
    state.assume(context.atom(context.value(tree), "=", zero))


def check_sharp(
    statement: Statement,
    certificate: Hint,
    known: Known,
    statements: Known,
    work: Work,
) -> None:
    """For all parameters in the domain: (all the named statements hold) <=> (the condition holds).
    [{name: prove}, found, {name: found}].

    A statement's own range lines give way to the domain and the condition; a parameter is an
    integer where the statements say so. Inside, each statement is proved; outside, counterexamples
    to one of them are found.  Each `number` line: between its ends, where its polynomial is not 0,
    the polynomial has exactly one root, as its Bernstein coefficients change their sign once
    (Descartes' rule of signs, for x = (low + high T) / (1 + T) and T > 0).  Last, a point for each
    statement: in the domain, it meets what the statement is given.
    """
    (names,) = statement.get("sharp")
    (over,) = statement.get("over")
    (domain,) = statement.get("domain")
    (condition,) = statement.get("holds")
    inside, outside, points = certificate
    ours = names and set(inside) == set(points) == set(names)
    ours = ours and all(n in statements and statements[n].kind == "universal" for n in names)
    require(ours, Kind.SHARP, names)  # one left out would hold by assertion
    integers = [{n for line in statements[name].get("integer") for n in line} for name in names]
    whole = integers[0] & set(over)
    same = all(others & set(over) == whole for others in integers)
    # else a parameter would be real outside, where a counterexample is sought, and whole inside
    require(same, Kind.SHARP_INTEGERS, names)
    state = State(Context(work=work))
    for parameter in over:
        state.context.declare(parameter, parameter in whole)
    numbers = Context(state.context)
    for name, (tree, *ends) in statement.get("number"):
        numbers.declare(name)  # fresh, though no formula names it
        poly = state.context.value(tree)
        low, high = (rational_value(state.context, end) for end in ends)
        (parameter,) = variables_of(state.context, poly)
        _, c = bernstein(poly, [(BITS * state.context.index[parameter], low, high)])
        # the first and the last one have the signs at low and at high
        once = low < high and c[0] and c[-1] and sign_changes(c) == 1
        require(once, Kind.ONE_ROOT, name)
    for name in names:
        # a witness is no parameter: the statement says nothing of each of its values
        parameters = {n for line in statements[name].get("forall") for n in line}
        require(set(over) <= parameters, Kind.SHARP_OVER, name)
        # a meaning on the whole domain, not only where a condition or a value gives it one
        Unfolding(statements[name], Context(work=work), [domain])
        prove(statements[name], inside[name], known, [domain, condition], work)
        # on an empty domain, or where the givens contradict one another, any condition is sharp
        alone = {name: statements[name]}
        find(State(Context(work=work)), points[name], known, "point", alone, {}, [domain])
    state.assume(state.context.formula(domain))
    state.assume(negate(state.context.formula(condition)))
    base = {parameter: state.context.values[parameter] for parameter in over}
    named = {name: statements[name] for name in names}
    find(state, outside, known, "counterexample", named, base, [domain])
