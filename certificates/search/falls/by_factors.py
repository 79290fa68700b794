"""A proof that a term of a function of one variable falls: a fact that bounds the value is put into
what is to be contradicted, which is then a product; the sign of each of its factors is a lemma.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from flint import fmpz_mpoly
from numpy.typing import NDArray

from juggleproof.certificates import checker
from juggleproof.certificates.algebra.polynomials import (
    Packing,
    Ring,
    coefficients_in,
    total_degree,
)
from juggleproof.certificates.nodes import Node, Proof
from juggleproof.certificates.search.closing import sign_node
from juggleproof.certificates.search.falls.by_products import (
    Combinations,
    Multiplied,
    facts_kept,
    independent,
    renumbered,
    with_facts,
)
from juggleproof.certificates.search.psatz.facts import Factors
from juggleproof.certificates.search.psatz.lifting import lift
from juggleproof.certificates.search.psatz.linear import Products
from juggleproof.certificates.search.psatz.problem import Problem
from juggleproof.certificates.states import State, proves, state_of
from juggleproof.certificates.work import Budget, Exhausted, unfolded

Points = Mapping[str, NDArray[np.float64]]

MORE = (0, 1, 2)  # degrees than those of a factor
MOST_COLUMNS, MOST_TERMS = 1500, 100_000  # of a program: products, and terms in them
MOST_FACTOR = 60  # terms of a factor
BUDGET = 1_000_000  # of counted work for a premise
VALUE = "value"
CLOSE = 1e-9  # to 0, in floats


def proof_by_factors(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    unknowns: Collection[str],
    sign: str,
    points: Points,
) -> Proof | None:
    """A proof of a premise `falls` by the cases of this sign; `points`: samples of all variables,
    by which signs are proposed.
    """
    unfolding = unfolded(premise)
    budget = Budget(BUDGET)
    try:
        for _ in unfolding.obligations:
            return None
        state = state_of(unfolding).assume(unfolding.goal(False))
        if state.choices or state.closed:
            return None
        ring = Ring(tuple(state.context.index))
        if VALUE not in ring.names or not set(ring.names) <= {VALUE, *points}:
            return None
        kept = facts_kept(state, ring, range(len(state.facts)), unknowns)
        goal, at = len(state.facts) - 1, np.sign(points[sign])
        nodes: list[Node | None] = []
        for side, case in zip((-1, 0, 1), state.by_sign(sign)):
            if side:
                inside = {name: values[at == side] for name, values in points.items()}
            else:
                inside = {**points, sign: 0 * points[sign]}
            facts = [*kept, len(state.facts)]
            nodes.append(Case(ring, goal, inside, budget).close(case, facts))
            if nodes[-1] is None:
                return None
    except Exhausted:
        return None
    node = sign_node(sign, nodes)
    proof: Proof | None = None if node is None else ("proof", [], node)
    return proof if proof is not None and proves(premise, proof, known) else None


@dataclass(frozen=True)
class Identity:
    """below * goal + times * bound + rest = 0, where below > 0 and times, rest >= 0."""

    goal: int  # number of the problem's fact
    bound: int
    below: fmpz_mpoly
    times: fmpz_mpoly
    rest: fmpz_mpoly


@dataclass(frozen=True)
class Case:
    """What is the same in all states of a case."""

    ring: Ring
    goal: int
    points: Points
    budget: Budget

    def close(self, state: State, kept: list[int]) -> Node | None:
        """A node that contradicts the facts with these numbers."""
        problem = Problem(with_facts(state, kept), self.ring, True)
        if problem.contradiction is not None:
            return None
        for identity in self.identities(problem, kept):
            node = self.by_lemmas(state, kept, identity.bound, identity.goal)
            if node is not None:
                return node
        return None

    def identities(self, problem: Problem, kept: Sequence[int]) -> list[Identity]:
        """Those that samples do not refute, for all bounds of the value."""
        value = self.ring.names.index(VALUE)
        firsts = [fact.factors[0][0] for fact in problem.facts]
        goals = [k for k, number in enumerate(firsts) if kept[number] == self.goal]
        found = []
        for goal in goals[:1]:
            for k, fact in enumerate(problem.facts):
                if k != goal and fact.degree(value) == 1:
                    one = self.identity(problem, goal, k, value)
                    parts = (one.below, one.times, one.rest)
                    if all((self.at_points(problem, part) >= -CLOSE).all() for part in parts):
                        found.append(one)
        return sorted(found, key=lambda one: len(one.rest) + len(one.times))

    def identity(self, problem: Problem, goal: int, bound: int, value: int) -> Identity:
        """The remainder of the goal by the bound, as polynomials in the value."""
        gen, times = self.ring.gens[value], self.ring.zero
        rest, slope = coefficients_in(problem.facts[bound].poly, value, gen)
        parts = coefficients_in(problem.facts[goal].poly, value, gen)
        below = self.ring.one
        while len(parts) > 1:
            top = parts.pop()
            times = times * slope + top * gen ** (len(parts) - 1)
            parts = [part * slope for part in parts]
            parts[-1] = parts[-1] - top * rest
            below = below * slope
        return Identity(goal, bound, below, -times, -parts[0])

    def at_points(self, problem: Problem, poly: fmpz_mpoly) -> NDArray[np.float64]:
        """The values at the samples, as shares of the sum of the sizes of all terms."""
        scaling = problem.source.scaling
        whole = scaling.lift(poly, scaling.largest(poly)) if scaling.scales and poly else poly
        total = np.zeros(len(next(iter(self.points.values()), ())))
        size = total + np.finfo(float).tiny
        for powers, c in zip(whole.monoms(), whole.coeffs()):
            term = np.full(len(total), float(c))
            for name, e in zip(self.ring.names, powers):
                if e:
                    term = term * self.points[name] ** float(e)
            total, size = total + term, size + np.abs(term)
        return np.asarray(total / size)

    def by_lemmas(self, state: State, kept: list[int], bound: int, goal: int) -> Node | None:
        """A node by this bound, with lemmas on the factors whose signs are not known."""
        problem = Problem(with_facts(state, kept), self.ring, True)
        value = self.ring.names.index(VALUE)
        identity = self.identity(problem, goal, bound, value)
        facts = {str(fact.poly): k for k, fact in enumerate(problem.facts)}
        for part in (identity.below, identity.times, identity.rest):
            for factor, power in self.ring.factors(part):
                if power % 2 and str(factor) not in facts and str(-factor) not in facts:
                    return self.lemma(state, kept, bound, goal, problem, factor)
        node = self.written(problem, identity, facts)
        return None if node is None else renumbered(node, kept)

    def lemma(
        self,
        state: State,
        kept: list[int],
        bound: int,
        goal: int,
        problem: Problem,
        factor: fmpz_mpoly,
    ) -> Node | None:
        """A node by the sign of this factor, which is that at the samples."""
        at = self.at_points(problem, factor)
        if len(factor) > MOST_FACTOR or not len(at) or (at > CLOSE).any() == (at < -CLOSE).any():
            return None
        positive = bool((at > CLOSE).any())
        text = problem.homogeneous_text(factor)
        cases, more = state.by_sign(text), [*kept, len(state.facts)]
        wrong = self.sum_of_products(cases[0 if positive else 2], more)
        if wrong is None:
            return None
        number = len(state.facts)
        at_zero = as_equation(wrong, number, positive)
        if at_zero is None:
            return None
        inner = self.by_lemmas(cases[2 if positive else 0], more, bound, goal)
        return sign_node(text, [wrong, at_zero, inner] if positive else [inner, at_zero, wrong])

    def sum_of_products(self, state: State, kept: list[int]) -> Node | None:
        """A node that the last fact is false: its opposite is a sum of products of the others."""
        problem = Problem(with_facts(state, kept), self.ring, True)
        if problem.contradiction is not None:
            return None
        firsts = [fact.factors[0][0] for fact in problem.facts]
        if len(kept) - 1 not in firsts:
            return None
        last = firsts.index(len(kept) - 1)
        poly = problem.facts[last].poly
        inside = variables_of(poly)
        known = [k for k, fact in enumerate(problem.facts) if variables_of(fact.poly) <= inside]
        others = independent(problem, [k for k in known if k != last])
        packing = Packing(self.ring, problem.polys())
        parts = [Products(problem, others, packing)]
        multiplied = [
            Multiplied(self.ring.one, (), -1),
            Multiplied(poly, (last,), -1, alone=True),
        ]
        every = Combinations(problem, parts, packing, MOST_COLUMNS, MOST_TERMS)
        node = every.node(multiplied, total_degree(poly), MORE, [], self.budget)
        return None if node is None else renumbered(node, kept)

    def written(
        self, problem: Problem, identity: Identity, facts: Mapping[str, int]
    ) -> Node | None:
        """The node of the identity, whose parts are products of facts."""
        used: list[tuple[tuple[Factors, int], Fraction]] = []
        roots: list[fmpz_mpoly] = []
        parts = (
            (identity.below, identity.goal),
            (identity.times, identity.bound),
            (identity.rest, None),
        )
        for part, own in parts:
            if not part:
                continue
            powers: dict[int, int] = {} if own is None else {own: 1}
            root, product = self.ring.one, self.ring.one
            for factor, power in self.ring.factors(part):
                if power % 2:
                    k = facts.get(str(factor), facts.get(str(-factor), -1))
                    powers[k] = powers.get(k, 0) + 1
                    product = product * problem.facts[k].poly
                root = root * factor ** (power // 2)
            content = part // (product * root**2)
            if not content.is_constant() or int(content.leading_coefficient()) < 0:
                return None
            at = -1
            if not root.is_constant():
                at = len(roots)
                roots.append(root)
            c = Fraction(int(content.leading_coefficient()))
            used.append(((tuple(sorted(powers.items())), at), c))
        return lift(problem, used, [], roots)


def variables_of(poly: fmpz_mpoly) -> set[int]:
    """The variables that occur, by their numbers."""
    return {v for v, power in enumerate(poly.degrees()) if power}


def as_equation(node: Node, number: int, positive: bool) -> Node | None:
    """The same node where the fact is that the polynomial is 0; None where others multiply it."""
    if node[0] != "psatz":
        return None
    _, products, equations = node
    kept, cofactors = [], list(equations)
    for c, factors, root in products:
        if number not in dict(factors):
            kept.append((c, factors, root))
        elif dict(factors) == {number: 1} and root == "1":
            cofactors.append((number, str(-Fraction(c) if positive else Fraction(c))))
        else:
            return None
    return "psatz", kept, cofactors
