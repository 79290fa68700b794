"""Scale variables: found by homogeneity, set to 1, and put back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    constant_of,
    ring_of,
    to_flint,
)
from juggleproof.algebra.conditions import replace as put
from juggleproof.algebra.polynomials import Ring
from juggleproof.algebra.trees import leaves
from juggleproof.certificates import checker
from juggleproof.search.psatz.facts import Scaling, Weight
from juggleproof.search.terms import AdjoinedRoot, Sample
from juggleproof.statements.language import Roles
from juggleproof.statements.states import SearchState

# -------------------------------------------------------------------------------------------------
# Which variables are scales: positive ones that a change of units makes 1, where no polynomial
# of the statement prefers a unit.


def with_scales(roles: Roles, unfolding: checker.Unfolding) -> Roles:
    """The roles with the scales of an unfolded statement, found by homogeneity where the
    roles leave them open.

    A scale is a universal variable that a premise makes positive; every polynomial of the
    statement is homogeneous in weights that give it 1, and parameters and whole numbers 0.

    >>> text = "statement a/b\\nforall r v\\ngiven r > 0 and v < r\\nshow v - 2*r < "
    >>> for end in ("0", "1"):
    ...     (one,) = checker.read_statements(text + end).values()
    ...     unfolding = checker.Unfolding(one, checker.Context())
    ...     print(sorted(with_scales(Roles(), unfolding).scales))
    ['r']
    []
    """
    if roles.scales is not None:
        return roles
    ring = ring_of(unfolding.context)
    premises = Condition.of(unfolding.context, checker.join("and", list(unfolding.premises)), ring)
    goal = Condition.of(unfolding.context, unfolding.goal(True), ring)
    names = tuple(ring.names())
    numbers = {*unfolding.context.integers, *roles.domains} & set(names)
    polys = [condition.polys[k] for condition in (premises, goal) for k in condition.used()]
    polys += [ring.gen(names.index(name)) + 1 for name in sorted(numbers)]
    positive = positive_variables(premises.facts())
    scaling = Scaling(
        Ring(names),
        [poly for poly in polys if poly != 0],
        [k for k in positive if names[k] in unfolding.universal],
    )
    return replace(roles, scales=frozenset(names[k] for k in scaling.scales))


def positive_variables(facts: Sequence[tuple[fmpq_mpoly, str]]) -> list[int]:
    """The places of the variables that a fact alone makes positive, in order."""
    return sorted(
        {
            poly.degrees().index(1)
            for poly, relation in facts
            if relation == ">"
            and len(poly) == 1
            and poly.total_degree() == 1
            and poly.leading_coefficient() > 0
        }
    )


# -------------------------------------------------------------------------------------------------
# A state in fewer variables: scales set to 1 and linear equations used up, with a way back for the
# terms found there.


class Normal:
    """The variables of a state and of the unknowns, dehomogenised: a scale is 1, and a variable
    that an equation gives is what it gives.
    """

    def __init__(self, state: SearchState, condition: Condition, equations: bool = True) -> None:
        self.ring: fmpq_mpoly_ctx = condition.ring
        names = tuple(self.ring.names())
        size = len(state.context.index)
        own = fmpq_mpoly_ctx.get(list(state.context.index) or ["none"], self.ring.ordering())
        facts = [
            (to_flint(poly, own, size).project_to_context(self.ring), relation)
            for poly, relation in state.facts
        ]
        positive = positive_variables(facts)
        choices = [
            to_flint(part[1], own, size).project_to_context(self.ring)
            for choice in state.choices
            for part in leaves(("or", choice))
        ]
        polys = [p for p in [*condition.polys, *choices, *(p for p, _ in facts)] if p != 0]
        self.scaling = Scaling(Ring(names), polys, positive)
        whole = {*state.context.integers}
        if any(
            any(self.scaling.weights[k])
            for k, name in enumerate(names)
            if name in whole and self.scaling.scales
        ):
            self.scaling = Scaling(Ring(names), polys, [])
        self.scales = {names[k]: fmpq(1) for k in self.scaling.scales}
        self.weights: dict[str, Weight] = (
            dict(zip(names, self.scaling.weights)) if self.scales else {}
        )
        self.steps: list[tuple[str, fmpq_mpoly]] = []
        if equations:
            self._use_equations(
                [p.subs(self.scales) for p, relation in facts if relation == "="],
                [n for n in state.context.index if n not in whole],
            )

    def _use_equations(self, equations: list[fmpq_mpoly], names: Sequence[str]) -> None:
        while True:
            step = next(
                (
                    (name, -rest / lead)
                    for poly in equations
                    for name in reversed(names)
                    for rest, lead in _linear(poly, name)
                ),
                None,
            )
            if step is None:
                return
            self.steps.append(step)
            equations = [put(poly, *step) for poly in equations]

    def dehomogenised(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """The polynomial in the variables that are left."""
        poly = self.at_scale_one(poly)
        for name, value in self.steps:
            poly = put(poly, name, value)
        return poly

    def at_scale_one(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """The polynomial with the scales set to 1, and no more."""
        return poly.subs(self.scales) if self.scales else poly

    def condition(self, condition: Condition) -> Condition:
        """The condition in the variables that are left."""
        return condition.mapped(self.dehomogenised) if self.scales or self.steps else condition

    def base(self, names: Sequence[str]) -> list[str]:
        """Those of the names that are left."""
        gone = {*self.scales, *(name for name, _ in self.steps)}
        return [name for name in names if name not in gone]

    def sample(self, sample: Sample) -> Sample:
        """The sample with scales of 1."""
        if not self.scales:
            return sample
        found = {}
        for name, value in sample.items():
            for scale, power in zip(self.scales, self.weights[name]):
                value = value / sample[scale] ** power
            found[name] = value
        return found

    # ------------------------------------------------ the way back

    def weight_of_root(self, root: AdjoinedRoot) -> Weight:
        """The weight that makes the polynomial of an adjoined root liftable; from now on that of
        its name.
        """
        if self.scales and root.name.startswith("root"):
            self.weights[root.name] = (0,) * len(self.scales)
            lower = coefficients_in(root.poly, root.name)
            tops = [self.weight(c) for c in lower[:2]]
            self.weights[root.name] = tuple(max(b, -(-c // 2)) for c, b in zip(*tops))
        return self.weights.get(root.name, ())

    def weight(self, poly: fmpq_mpoly) -> Weight:
        """The least weight to which a dehomogenised polynomial can be lifted."""
        names, zero = self.ring.names(), (0,) * len(self.scales)
        parts = [
            tuple(
                sum(int(e) * self.weights[n][k] for n, e in zip(names, powers) if e)
                for k in range(len(zero))
            )
            for powers in poly.to_dict()
        ]
        return tuple(map(max, zip(*parts))) if parts and zero else zero

    def lift(self, poly: fmpq_mpoly, weight: Weight | None = None) -> fmpq_mpoly:
        """The homogeneous polynomial of this weight, or the least possible, which dehomogenises to
        the given one.
        """
        if not self.scales:
            return poly
        weight = self.weight(poly) if weight is None else weight
        names, terms = self.ring.names(), {}
        places = [self.ring.variable_to_index(scale) for scale in self.scales]
        for powers, c in poly.to_dict().items():
            exponents = [int(e) for e in powers]
            for k, place in enumerate(places):
                have = sum(int(e) * self.weights[n][k] for n, e in zip(names, powers) if e)
                exponents[place] += weight[k] - have
            terms[tuple(exponents)] = c
        return self.ring.from_dict(terms)


def _linear(poly: fmpq_mpoly, name: str) -> list[tuple[fmpq_mpoly, fmpq]]:
    if poly == 0 or poly.degrees()[poly.context().variable_to_index(name)] != 1:
        return []
    rest, slope = coefficients_in(poly, name)
    value = constant_of(slope)
    return [(rest, value)] if value is not None else []
