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

from juggleproof.algebra.polynomials import (
    Packing,
    Ring,
    coefficients_in,
    total_degree,
    used_in,
)
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.closing import sign_node
from juggleproof.search.decrease_proofs.by_products import (
    Combinations,
    Multiplied,
    facts_kept,
    independent,
    proof_with,
    renumbered,
    with_facts,
)
from juggleproof.search.psatz.facts import Factors
from juggleproof.search.psatz.lifting import lift
from juggleproof.search.psatz.linear import Products
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.search.psatz.sums_of_squares import programs_of_facts, search_squares
from juggleproof.statements.nodes import Node, Proof
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted

Points = Mapping[str, NDArray[np.float64]]

VALUE = "value"


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
    budget = Budget(limits.DECREASE_WORK)

    def closed(state: SearchState) -> Node | None:
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
            nodes.append(FactorCase(ring, goal, inside, budget, sign).close(case, facts))
            if nodes[-1] is None:
                return None
        return sign_node(sign, nodes)

    return proof_with(premise, known, budget, closed)


Part = tuple[fmpz_mpoly, int | None]  # a polynomial, and the number of the fact that it multiplies


@dataclass(frozen=True)
class Identity:
    """below * goal + times * bound + rest = 0, where below > 0 and times, rest >= 0."""

    goal: int  # number of the problem's fact
    bound: int
    below: fmpz_mpoly
    times: fmpz_mpoly
    rest: fmpz_mpoly

    def parts(self) -> list[Part]:
        """The products of the sum."""
        return [(self.below, self.goal), (self.times, self.bound), (self.rest, None)]


@dataclass(frozen=True)
class FactorCase:
    """What is the same in all states of a case."""

    ring: Ring
    goal: int
    points: Points
    budget: Budget
    sign: str

    def close(self, state: SearchState, kept: list[int]) -> Node | None:
        """A node that contradicts the facts with these numbers."""
        problem = LeafProblem(with_facts(state, kept), self.ring, True)
        if problem.contradiction is not None:
            return None
        for identity in self.identities(problem, kept):
            node = self.by_lemmas(state, kept, identity.bound, identity.goal)
            if node is not None:
                return node
        return None

    def identities(self, problem: LeafProblem, kept: Sequence[int]) -> list[Identity]:
        """Those that samples do not refute, for all bounds of the value."""
        value = self.ring.names.index(VALUE)
        firsts = [fact.factors[0][0] for fact in problem.facts]
        goals = [k for k, number in enumerate(firsts) if kept[number] == self.goal]
        found = []
        for goal in goals[:1]:
            for k, fact in enumerate(problem.facts):
                if k != goal and fact.degrees[value] == 1:
                    one = self.identity(problem, goal, k, value)
                    parts = (one.below, one.times, one.rest)
                    if all(
                        (self.at_points(problem, part) >= -limits.FACTOR_ZERO).all()
                        for part in parts
                    ):
                        found.append(one)
        return sorted(found, key=lambda one: len(one.rest) + len(one.times))

    def identity(self, problem: LeafProblem, goal: int, bound: int, value: int) -> Identity:
        """The remainder of the goal by the bound, as polynomials in the value."""
        gen, times = self.ring.gens[value], self.ring.zero
        rest, slope = coefficients_in(problem.facts[bound].poly, value)
        parts = coefficients_in(problem.facts[goal].poly, value)
        below = self.ring.one
        while len(parts) > 1:
            top = parts.pop()
            times = times * slope + top * gen ** (len(parts) - 1)
            parts = [part * slope for part in parts]
            parts[-1] = parts[-1] - top * rest
            below = below * slope
        return Identity(goal, bound, below, -times, -parts[0])

    def at_points(self, problem: LeafProblem, poly: fmpz_mpoly) -> NDArray[np.float64]:
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

    def by_lemmas(self, state: SearchState, kept: list[int], bound: int, goal: int) -> Node | None:
        """A node by this bound, with lemmas on the factors whose signs are not known."""
        problem = LeafProblem(with_facts(state, kept), self.ring, True)
        value = self.ring.names.index(VALUE)
        identity = self.identity(problem, goal, bound, value)
        facts = {str(fact.poly): k for k, fact in enumerate(problem.facts)}
        unknown = self.unknown_factor([part for part, _ in identity.parts()], facts)
        if unknown is not None:
            return self.lemma(state, kept, bound, goal, problem, unknown)
        node = self.written(problem, identity.parts(), facts)
        return renumbered(node, kept)

    def unknown_factor(
        self, parts: Sequence[fmpz_mpoly], facts: Mapping[str, int]
    ) -> fmpz_mpoly | None:
        """The first factor of an odd power that is no fact, nor its opposite."""
        for part in parts:
            for factor, power in self.ring.factors(part):
                if power % 2 and str(factor) not in facts and str(-factor) not in facts:
                    return factor
        return None

    def lemma(
        self,
        state: SearchState,
        kept: list[int],
        bound: int,
        goal: int,
        problem: LeafProblem,
        factor: fmpz_mpoly,
    ) -> Node | None:
        """A node by the sign of this factor, which is that at the samples."""
        at = self.at_points(problem, factor)
        if (
            len(factor) > limits.FACTOR_TERMS
            or not len(at)
            or (at > limits.FACTOR_ZERO).any() == (at < -limits.FACTOR_ZERO).any()
        ):
            return None
        positive = bool((at > limits.FACTOR_ZERO).any())
        text = problem.homogeneous_text(factor)
        cases, more = state.by_sign(text), [*kept, len(state.facts)]
        opposite = cases[0 if positive else 2]
        wrong = self.sum_of_products(opposite, more)
        if wrong is None:
            parts = self.square_of_sign(factor if positive else -factor)
            facts = {str(fact.poly): k for k, fact in enumerate(problem.facts)}
            unknown = self.unknown_factor(parts, facts)
            if unknown is not None:
                return self.lemma(state, kept, bound, goal, problem, unknown)
            wrong = self.by_square(opposite, more, parts)
        wrong = wrong or self.by_squares(opposite, more)
        if wrong is None:
            return None
        number = len(state.facts)
        at_zero = as_equation(wrong, number, positive, self.texts(opposite, more))
        if at_zero is None:
            return None
        inner = self.by_lemmas(cases[2 if positive else 0], more, bound, goal)
        return sign_node(text, [wrong, at_zero, inner] if positive else [inner, at_zero, wrong])

    def texts(self, state: SearchState, kept: list[int]) -> dict[int, str]:
        """The facts as text, where no scales were set to 1."""
        source = LeafProblem(with_facts(state, kept), self.ring, True).source
        polys = [] if source.scaling.scales else source.lowered
        return {k: f"({poly})/{state.facts[k][0].den}" for k, poly in zip(kept, polys)}

    def square_of_sign(self, poly: fmpz_mpoly) -> list[fmpz_mpoly]:
        """c_0 + c_1 g + c_2 g^2 + .. in the variable g of the cases as a sum: what multiplies it,
        4 c_2, then (2 c_2 g + c_1)^2, 4 c_0 c_2 - c_1^2, and 4 c_2 c_k g^k, which are to be >= 0;
        nothing where its degree is below 2.
        """
        gen = self.ring.gens[self.ring.names.index(self.sign)]
        parts = coefficients_in(poly, self.ring.names.index(self.sign))
        if len(parts) < 3 or not parts[2]:
            return []
        low, slope, bend, *more = parts
        found = [4 * bend, (2 * bend * gen + slope) ** 2, 4 * low * bend - slope**2]
        found += [4 * bend * part * gen**k for k, part in enumerate(more, 3)]
        return [one for one in found if one]

    def by_square(
        self, state: SearchState, kept: list[int], parts: list[fmpz_mpoly]
    ) -> Node | None:
        """A node that the last fact is false, which the first of the parts multiplies."""
        problem = LeafProblem(with_facts(state, kept), self.ring, True)
        firsts = [fact.factors[0][0] for fact in problem.facts]
        if not parts or problem.contradiction is not None or len(kept) - 1 not in firsts:
            return None
        facts = {str(fact.poly): k for k, fact in enumerate(problem.facts)}
        last = firsts.index(len(kept) - 1)
        node = self.written(problem, [(parts[0], last), *((one, None) for one in parts[1:])], facts)
        return renumbered(node, kept)

    def by_squares(self, state: SearchState, kept: list[int]) -> Node | None:
        """A node that the last fact is false, by sums of squares times facts in its variables."""
        ring = Ring(tuple(state.context.index))
        inside = set(used_in(ring.read(state.facts[kept[-1]][0])))
        few = [k for k in kept if inside.issuperset(used_in(ring.read(state.facts[k][0])))]
        problem = LeafProblem(with_facts(state, few), self.ring, True)
        try:
            part = self.budget.part(limits.FACTOR_SQUARES_WORK)
            node = search_squares(programs_of_facts(problem, part), part)
        except Exhausted:
            return None
        return renumbered(node, few)

    def sum_of_products(self, state: SearchState, kept: list[int]) -> Node | None:
        """A node that the last fact is false: its opposite is a sum of products of the others."""
        problem = LeafProblem(with_facts(state, kept), self.ring, True)
        if problem.contradiction is not None:
            return None
        firsts = [fact.factors[0][0] for fact in problem.facts]
        if len(kept) - 1 not in firsts:
            return None
        last = firsts.index(len(kept) - 1)
        poly = problem.facts[last].poly
        inside = set(used_in(poly))
        known = [k for k, fact in enumerate(problem.facts) if inside.issuperset(used_in(fact.poly))]
        others = independent(problem, [k for k in known if k != last])
        packing = Packing(self.ring, problem.polys())
        parts = [Products(problem, others, packing)]
        multiplied = [
            Multiplied(self.ring.one, (), -1),
            Multiplied(poly, (last,), -1, alone=True),
        ]
        every = Combinations(
            problem, parts, packing, limits.FACTOR_COLUMNS, limits.FACTOR_PRODUCT_TERMS
        )
        node = every.node(multiplied, total_degree(poly), limits.FACTOR_DEGREES, [], self.budget)
        return renumbered(node, kept)

    def written(
        self, problem: LeafProblem, parts: Sequence[Part], facts: Mapping[str, int]
    ) -> Node | None:
        """The node of a sum that is 0, whose parts are products of facts and squares."""
        used: list[tuple[tuple[Factors, int], Fraction]] = []
        roots: list[fmpz_mpoly] = []
        for part, own in parts:
            if not part:
                continue
            powers: dict[int, int] = {} if own is None else {own: 1}
            root, product = self.ring.one, self.ring.one
            for factor, power in self.ring.factors(part):
                k = facts.get(str(factor), facts.get(str(-factor), -1))
                if k >= 0:  # no root, which might be 0
                    powers[k] = powers.get(k, 0) + power
                    product = product * problem.facts[k].poly ** power
                else:
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


def as_equation(node: Node, number: int, positive: bool, texts: Mapping[int, str]) -> Node | None:
    """The same node where the fact is that the polynomial is 0; None where others multiply it of
    which there is no text.
    """
    if node[0] != "psatz":
        return None
    _, products, equations = node
    kept, cofactors = [], list(equations)
    for c, factors, root in products:
        powers = dict(factors)
        if number not in powers:
            kept.append((c, factors, root))
            continue
        if powers.pop(number) > 1 or not powers.keys() <= texts.keys():
            return None
        parts = [str(-Fraction(c) if positive else Fraction(c)) if c else "0"]
        parts += [f"({texts[k]})^{e}" for k, e in powers.items()]
        cofactors.append((number, "*".join(parts + [f"({root})^2"] * (root != "1"))))
    return "psatz", kept, cofactors
