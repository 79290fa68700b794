"""Exact values for variables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice

from flint import fmpq, fmpq_mpoly, fmpq_poly

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    constant_of,
    evaluate,
    fold,
    places,
    replace,
    ring_of,
    univariate,
)
from juggleproof.algebra.numbers import AlgebraicNumber, exact, real_roots, simplest_between
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.candidates import (
    Cells,
    Value,
    favourites,
    solutions,
    trials,
)
from juggleproof.search.terms import Sample
from juggleproof.statements.language import NO_ROLES, Roles
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# Exact values for all variables of a condition: equations are solved, the other variables sampled,
# the last one decided on its cells.

Steps = list[tuple[str, fmpq_mpoly]]  # what was decided for each variable, in order
Theta = tuple[str, AlgebraicNumber] | None  # the variable that stands for the adjoined number


@dataclass
class Assignment:
    """Values of all variables: rationals, or polynomials in one adjoined algebraic number."""

    values: dict[str, fmpq_poly]
    number: AlgebraicNumber | None = None

    def rational(self, name: str) -> fmpq | None:
        """The value of a variable where it is rational."""
        poly = self.values[name]
        return poly[0] if poly.degree() <= 0 else None


@dataclass
class Sampler:
    """One search: how many values to try for each variable, and how many substitutions to spend in
    all.
    """

    budget: Budget
    integers: frozenset[str] = frozenset()
    width: int = 5
    last: int = 1
    nodes: int = 80
    irrational: bool = False
    order: Sequence[str] = ()
    roles: Roles = NO_ROLES

    def search(self, condition: Condition, names: Sequence[str]) -> Iterator[Assignment]:
        """Assignments of the names that meet the condition, the simplest first as far as the
        sampling goes.
        """
        self.order = list(names)
        yield from self._descend(condition, [], None)

    def _descend(self, condition: Condition, steps: Steps, theta: Theta) -> Iterator[Assignment]:
        if condition.tree is False or self.nodes < 0:
            return
        if condition.tree is True:
            result = self._complete(condition, steps, theta)
            if result is not None:
                yield result
            return
        names = condition.variables() - ({theta[0]} if theta else set())
        place = {name: i for i, name in enumerate(self.order)}
        free = sorted(names, key=lambda n: place[n])
        scale = next((n for n in free if self.roles.is_scale(n)), None)
        if scale is not None:
            for value in favourites(scale, False, self.roles)[: 1 if self.width < 7 else 3]:
                yield from self._step(condition, steps, theta, scale, value)
            return
        equation = self._equation_in_one(condition, theta)
        if equation is not None:
            name, poly = equation
            for root in sorted(real_roots(poly), key=lambda r: not r.is_rational):
                if root.is_rational and (name not in self.integers or root._low.q == 1):
                    yield from self._step(condition, steps, theta, name, root._low)
                elif (
                    not root.is_rational
                    and self.irrational
                    and theta is None
                    and name not in self.integers
                ):
                    yield from self._step(condition, steps, theta, name, root)
            return
        implied = (
            self._eliminated(condition)
            if self.irrational and theta is None and len(free) > 1
            else None
        )
        if implied is not None:
            self._spend(condition)
            yield from self._descend(condition.conjoined(implied), steps, theta)
            return
        solved = self._linear_equation(condition, free, theta)
        if solved is not None:
            name, value = solved
            self._spend(condition)
            if degree_after(condition, name, value) > limits.MOST_DEGREE:
                return
            changed = condition.replaced(name, value)
            yield from self._descend(self._settled(changed, theta), [*steps, (name, value)], theta)
            return
        name = free[0]
        if len(free) == 1:
            alone = (
                condition
                if theta is None
                else condition.substituted({theta[0]: theta[1].approximation()})
            )
            self._spend(condition)
            if theta is not None and not alone.variables() == {name}:
                return
            for value in solutions(
                alone,
                name,
                name in self.integers,
                self.last,
                self.irrational and theta is None,
                self.roles,
            ):
                yield from self._step(condition, steps, theta, name, value)
            return
        self._spend(condition)
        for value in trials(condition, name, name in self.integers, self.width, self.roles):
            yield from self._step(condition, steps, theta, name, value)

    def _spend(self, condition: Condition) -> None:
        self.nodes -= 1
        self.budget.spend(40 + 10 * len(condition.polys))

    def _step(
        self, condition: Condition, steps: Steps, theta: Theta, name: str, value: Value
    ) -> Iterator[Assignment]:
        self._spend(condition)
        if isinstance(value, AlgebraicNumber):
            adjoined = (name, value)
            gen = condition.ring.gen(self._index(condition, name))
            yield from self._descend(
                self._settled(condition, adjoined), [*steps, (name, gen)], adjoined
            )
        else:
            changed = self._settled(condition.substituted({name: value}), theta)
            yield from self._descend(
                changed, [*steps, (name, condition.ring.constant(value))], theta
            )

    @staticmethod
    def _index(condition: Condition, name: str) -> int:
        return places(condition.ring)[name]

    def _settled(self, condition: Condition, theta: Theta) -> Condition:
        """The condition with polynomials in the adjoined number alone decided."""
        if theta is None or isinstance(condition.tree, bool):
            return condition
        name, number = theta
        place, changed = self._index(condition, name), list(condition.polys)
        for k in condition.used():
            degrees = changed[k].degrees()
            if not any(e for i, e in enumerate(degrees) if i != place):
                changed[k] = condition.ring.constant(number.sign_of(univariate(changed[k], name)))
        return Condition(condition.ring, changed, fold(condition.tree, changed.__getitem__))

    def _equation_in_one(self, condition: Condition, theta: Theta) -> tuple[str, fmpq_poly] | None:
        for poly, relation in condition.facts():
            if relation == "=":
                used = [name for name, e in zip(places(condition.ring), poly.degrees()) if e]
                if len(used) == 1 and (theta is None or used[0] != theta[0]):
                    return used[0], univariate(poly, used[0])
        return None

    def _eliminated(self, condition: Condition) -> Condition | None:
        """An equation in one variable that follows from two in the same two variables; none of them
        linear.
        """
        equations = [
            poly
            for poly, relation in condition.facts()
            if relation == "=" and poly.total_degree() > 1
        ]
        pairs = [(p, q) for p, q in combinations(equations, 2) if len(p) * len(q) <= 100]
        for p, q in pairs:
            shared = {
                name
                for poly in (p, q)
                for name, e in zip(places(condition.ring), poly.degrees())
                if e > 0
            }
            if len(shared) == 2 and not shared & self.integers:
                name = max(shared, key=places(condition.ring).__getitem__)
                result, line = p.resultant(q, name), linear_remainder(p, q, name)
                if not result.is_constant():
                    return Condition(condition.ring, [result, line], ("and", [(0, "="), (1, "=")]))
        return None

    def _linear_equation(
        self, condition: Condition, free: Sequence[str], theta: Theta
    ) -> tuple[str, fmpq_mpoly] | None:
        """(variable, value) from an equation that is linear in it with a number as its coefficient;
        the parameter last.
        """
        for poly, relation in condition.facts():
            if relation != "=":
                continue
            degrees = poly.degrees()
            for name in sorted(
                free, key=lambda n: (n == self.roles.parameter, -self._index(condition, n))
            ):
                if degrees[self._index(condition, name)] != 1 or name in self.integers:
                    continue
                rest, slope = coefficients_in(poly, name)
                inverse = self._inverse(slope, theta)
                if inverse is not None:
                    return name, -rest * inverse
        return None

    def _inverse(self, slope: fmpq_mpoly, theta: Theta) -> fmpq_mpoly | None:
        ring = slope.context()
        value = constant_of(slope)
        if value is not None:
            return ring.constant(1 / value)
        if theta is None:
            return None
        place = ring.variable_to_index(theta[0])
        if any(e for i, e in enumerate(slope.degrees()) if i != place):
            return None
        gcd, inverse, _ = univariate(slope, theta[0]).xgcd(fmpq_poly(theta[1].poly))
        if gcd.degree() != 0:
            return None
        gen = ring.gen(place)
        result = ring.constant(0)
        for c in reversed((inverse / gcd[0]).coeffs()):
            result = result * gen + c
        return result

    def _complete(self, condition: Condition, steps: Steps, theta: Theta) -> Assignment | None:
        """The values of all variables, from the last decided back to the first; what does not
        matter is 1, or 1/2 for the parameter.
        """
        decided = {name for name, _ in steps}
        ring = condition.ring
        values: dict[str, fmpq_mpoly] = {
            name: ring.constant(fmpq(1, 2) if name == self.roles.parameter else 1)
            for name in self.order
            if name not in decided
        }
        for name, value in reversed(steps):
            for other, known in values.items():
                value = replace(value, other, known)
            values[name] = value
        if theta is None:
            dense = {name: fmpq_poly([constant_of(value)]) for name, value in values.items()}
        else:
            modulus = fmpq_poly(theta[1].poly)
            dense = {name: univariate(value, theta[0]) % modulus for name, value in values.items()}
        if any(dense[n].degree() > 0 or (dense[n][0].q != 1) for n in self.integers if n in dense):
            return None
        return Assignment(dense, theta[1] if theta else None)


def degree_after(condition: Condition, name: str, value: fmpq_mpoly) -> int:
    """A bound on the degree of a condition when a term is put in place of a variable."""
    place, degree = places(condition.ring)[name], max(1, value.total_degree())
    grown = (
        poly.total_degree() + int(poly.degrees()[place]) * (degree - 1)
        for poly in (condition.polys[k] for k in condition.used())
        if poly
    )
    return max(grown, default=0)


def linear_remainder(p: fmpq_mpoly, q: fmpq_mpoly, name: str) -> fmpq_mpoly:
    """A combination of two polynomials whose degree in a variable is 1 at most, by pseudo-division:
    it gives the variable where both vanish.
    """
    gen = p.context().gen(places(p.context())[name])
    while True:
        one, other = sorted((coefficients_in(p, name), coefficients_in(q, name)), key=len)
        p, q = (sum((c * gen**k for k, c in enumerate(part)), p * 0) for part in (one, other))
        if len(one) <= 2:
            return p
        rest = q * one[-1] - p * other[-1] * gen ** (len(other) - len(one))
        p, q = rest / rest.leading_coefficient() if rest != 0 else rest, p


# -------------------------------------------------------------------------------------------------
# Exact sample points of a state: for one parameter over every cell and close to its ends,
# otherwise by sampling all variables.


def state_condition(state: SearchState) -> Condition:
    """What a state assumes, as a condition."""
    formula = checker.join("and", state.formulas)
    return Condition.of(state.context, formula, ring_of(state.context))


def base_samples(state: SearchState, budget: Budget, roles: Roles, count: int = 12) -> list[Sample]:
    """Points of the state, in a fixed order."""
    condition = state_condition(state)
    if condition.tree is False:
        return []
    names = list(state.context.index)
    used, scales = condition.variables(), roles.scales or frozenset()
    if len(used) == 1:
        return [
            {**{n: fmpq(1) for n in names}, **s} for s in _on_a_line(condition, next(iter(used)))
        ]
    found: list[Sample] = _close_to_ends(condition, names, used, roles)
    for width, last, nodes in ((4, 3, 300), (9, 3, 3000), (24, 3, 3000)):
        every = list(
            islice(
                Sampler(
                    budget, frozenset(state.context.integers), width, last, nodes, roles=roles
                ).search(condition, names),
                400,
            )
        )
        for assignment in every[:: max(1, len(every) // count)]:
            sample = {name: assignment.rational(name) for name in names}
            if all(v is not None for v in sample.values()) and sample not in found:
                found.append({n: v for n, v in sample.items() if v is not None})
        if len(found) >= count // 2 or found and width >= 9:
            break
    found += [
        s
        for s in _scattered(condition, names, state.context.integers, count, roles)
        if s not in found
    ]
    return found + _extreme(
        condition,
        found[:1] + found[len(found) // 2 :][:1],
        sorted(used - scales - set(state.context.integers)),
    )


def _close_to_ends(
    condition: Condition, names: list[str], used: set[str], roles: Roles
) -> list[Sample]:
    """Where scales aside there is one variable: points all along its line, close to the ends too,
    with scales of 1.
    """
    others = {name for name in used if not roles.is_scale(name)}
    line = condition.substituted({name: fmpq(1) for name in used - others})
    if len(others) != 1 or others == used or line.variables() != others:
        return []
    return [{**{n: fmpq(1) for n in names}, **s} for s in _on_a_line(line, *others)]


def _extreme(condition: Condition, samples: list[Sample], names: list[str]) -> list[Sample]:
    """The samples with one variable at a time made very small or very large: what serves by chance
    does not serve there.
    """
    found: list[Sample] = []
    for sample in samples:
        for name in names:
            for value in (fmpq(1, 1000), fmpq(1000)):
                moved = {**sample, name: value}
                if moved not in found and condition.substituted(moved).tree is True:
                    found.append(moved)
    return found


def _scattered(
    condition: Condition, names: list[str], integers: set[str], count: int, roles: Roles
) -> list[Sample]:
    """Favourite values combined in a fixed pseudo-random order, so that variables are not all tied
    to one another.
    """
    found: list[Sample] = []
    state = 20
    for _ in range(10 * count):
        sample = {}
        for name in names:
            state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
            values = favourites(name, name in integers, roles)[:12]
            sample[name] = values[(state >> 33) % len(values)]
        if sample not in found and condition.substituted(sample).tree is True:
            found.append(sample)
        if len(found) >= count:
            break
    return found


def _on_a_line(condition: Condition, name: str) -> list[Sample]:
    cells = Cells(condition.in_one_variable(name))
    found: list[Sample] = []
    for low, high in cells.intervals():
        if low < high and evaluate(condition.tree, cells.signs(simplest_between(low, high))):
            length = high - low
            for part in map(exact, limits.CLOSENESS):
                slack = min(part, 1 - part) / 4
                found.append(
                    {
                        name: simplest_between(
                            low + length * (part - slack), low + length * (part + slack)
                        )
                    }
                )
    for root in cells.roots:
        if root.is_rational and evaluate(condition.tree, cells.signs(root)):
            found.append({name: root._low})
    return sorted(found, key=lambda sample: sample[name])
