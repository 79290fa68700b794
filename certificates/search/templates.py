"""Terms for unknown variables as rational functions of the base variables, tried on samples of the base: roots, vertices, averages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from flint import fmpq, fmpq_mpoly

from .budget import Budget
from .candidates import PARAMETERS, UNITS, favourites, solutions, trials
from .condition import Condition, coefficients_in, constant_of, replace
from .near import between, possible, ring_names, rounded
from .quotients import SPARE, Choice, Quotient, Root, Sample, insert, reduced_by, root_values, square_roots

Candidate = tuple[Quotient, Root | None]
BESIDE = tuple(fmpq(sign, size) for size in (10, 100, 1000) for sign in (1, -1))  # how far beside a border, in margins


@dataclass
class Partial:
    """A condition on its way: symbolic, and at every sample."""

    condition: Condition
    sampled: list[Condition]
    steps: list[tuple[str, fmpq_mpoly, fmpq_mpoly]] = field(default_factory=list)
    roots: list[Root] = field(default_factory=list)


class TemplateSearch:
    """One search for terms; `least` is how many of the samples a choice has to serve."""

    def __init__(self, base: Sequence[str], samples: Sequence[Sample], budget: Budget, integers: frozenset[str] = frozenset(),
                 nodes: int = 400, least: int | None = None, hints: Mapping[str, Sequence[Quotient]] | None = None,
                 margins: Sequence[fmpq_mpoly] = (), borders: Sequence[fmpq_mpoly] | None = None) -> None:
        self.base, self.samples, self.budget, self.integers = list(base), [dict(s) for s in samples], budget, integers
        self.nodes, self.hints, self.margins = nodes, dict(hints or {}), list(margins)
        self.given: dict[tuple[int, str], dict[str, fmpq]] = {}  # samples with the values of adjoined roots
        self.borders = borders  # where these are given, they are tried first
        self.least = len(self.samples) if least is None else least

    def search(self, condition: Condition, unknowns: Sequence[str]) -> Iterator[Choice]:
        """Choices of terms for the unknowns that meet the condition on enough samples, in the order that they are met."""
        start = Partial(condition, [condition.substituted(s) for s in self.samples])
        yield from self._descend(start, list(unknowns))

    def _descend(self, partial: Partial, unknowns: list[str]) -> Iterator[Choice]:
        alive = [i for i, c in enumerate(partial.sampled) if c.tree is not False]
        if len(alive) < self.least or self.nodes < 0:
            return
        if not unknowns:
            serves = [i for i, c in enumerate(partial.sampled) if c.tree is True]
            if len(serves) >= self.least:
                yield Choice(self._completed(partial), partial.roots, serves, partial.condition.ring)
            return
        self.nodes -= 1
        self.budget.spend(100 + 60 * len(self.samples) * (1 + len(partial.condition.polys)))
        forced = self._equation(partial, unknowns)
        if forced is not None:
            name, top, bottom = forced
            yield from self._descend(self._with(partial, name, top, bottom), [n for n in unknowns if n != name])
            return
        adjoined = self._square_equation(partial, unknowns)
        if adjoined is not None:
            name, poly = adjoined
            yield from self._descend(self._adjoined(partial, name, poly), [n for n in unknowns if n != name])
            spare = next((n for n in SPARE if n not in [root.name for root in partial.roots]), None)
            if spare is not None:  # the smaller root, from the larger
                gen = poly.context().gen(poly.context().variable_to_index(spare))
                larger = Root(spare, replace(poly, name, gen, gen ** 0))
                widened = Partial(partial.condition, partial.sampled, partial.steps, [*partial.roots, larger])
                value = -coefficients_in(poly, name)[1] - gen
                yield from self._descend(self._with(widened, name, value, gen ** 0), [n for n in unknowns if n != name])
            return
        name, rest = unknowns[0], unknowns[1:]
        for value, root in self._candidates(partial, name, rest):
            widened = partial if root is None else Partial(partial.condition, partial.sampled, partial.steps, [*partial.roots, root])
            if self._plausible(widened, name, value):
                yield from self._descend(self._with(widened, name, value.top, value.bottom), rest)

    def _plausible(self, partial: Partial, name: str, value: Quotient) -> bool:
        missing = len(self.samples) - self.least
        self.budget.spend(30)
        for sample, sampled in zip(self.samples, partial.sampled):
            self.budget.spend(20 + 5 * len(sampled.polys))
            at = value.at(self._given(partial, sample)) if sampled.tree is not False else None
            missing -= at is None or not possible(sampled, name, at, bool(partial.roots))
            if missing < 0:
                return False
        return True

    def _with(self, partial: Partial, name: str, top: fmpq_mpoly, bottom: fmpq_mpoly) -> Partial:
        changed = partial.condition.replaced(name, top, bottom)
        for root in partial.roots:
            changed = changed.mapped(lambda p, root=root: reduced_by(root, p))
        sampled = []
        for sample, before in zip(self.samples, partial.sampled):
            if before.tree is False:
                sampled.append(before)
                continue
            given = self._given(partial, sample)
            low, high = bottom.subs(given), top.subs(given)
            if low == 0:
                sampled.append(Condition(before.ring, before.polys, False))
            elif partial.roots:
                sampled.append(before.mapped(lambda p, high=high, low=low: rounded(replace(p, name, high, low))))
            else:
                sampled.append(before.replaced(name, high, low))
        return Partial(changed, sampled, [*partial.steps, (name, top, bottom)], partial.roots)

    # ------------------------------------------------ equations

    def _equation(self, partial: Partial, unknowns: Sequence[str]) -> tuple[str, fmpq_mpoly, fmpq_mpoly] | None:
        """An equation linear in an unknown, its coefficient free of unknowns and nonzero at the samples."""
        place = {n: i for i, n in enumerate(partial.condition.ring.names())}
        best: tuple[tuple[int, int], tuple[str, fmpq_mpoly, fmpq_mpoly]] | None = None
        for poly, relation in partial.condition.facts():
            if relation != "=":
                continue
            degrees = poly.degrees()
            for name in reversed(list(unknowns)):
                if degrees[place[name]] != 1 or name in self.integers:
                    continue
                rest, slope = coefficients_in(poly, name)
                if any(slope.degrees()[place[n]] for n in unknowns):
                    continue
                values = [slope.subs(self._given(partial, s)) for s in self.samples]
                if all(v != 0 for v in values):
                    size = (sum(rest.degrees()[place[n]] for n in unknowns), len(poly))
                    if best is None or size < best[0]:
                        best = size, (name, -rest, slope)
        return best[1] if best else None

    def _square_equation(self, partial: Partial, unknowns: Sequence[str]) -> tuple[str, fmpq_mpoly] | None:
        """An equation of degree 2 in one unknown alone, over the base: its root is adjoined."""
        place = {n: i for i, n in enumerate(partial.condition.ring.names())}
        for poly, relation in partial.condition.facts():
            degrees = poly.degrees()
            present = [n for n in unknowns if degrees[place[n]]]
            if relation == "=" and len(present) == 1 and degrees[place[present[0]]] == 2 and present[0] not in self.integers:
                lead = coefficients_in(poly, present[0])[2]
                if constant_of(lead) is not None:
                    return present[0], poly / lead.leading_coefficient()
        return None

    def _adjoined(self, partial: Partial, name: str, poly: fmpq_mpoly) -> Partial:
        """The condition with the unknown taken as a root: every polynomial is reduced modulo its equation."""
        root = Root(name, poly)
        changed = partial.condition.mapped(lambda p: reduced_by(root, p))
        roots = [*partial.roots, root]
        result = Partial(changed, [], partial.steps, roots)
        for sample, before in zip(self.samples, partial.sampled):
            given = self._given(result, sample)
            failed = before.tree is False or name not in given
            result.sampled.append(Condition(changed.ring, changed.polys, False) if failed else
                                  changed.mapped(lambda p, given=given: rounded(p.subs(given))))
        return result

    def _given(self, partial: Partial, sample: Sample) -> dict[str, fmpq]:
        """The sample with the values of the adjoined roots there."""
        if not partial.roots:
            return dict(sample)
        mark = id(sample), "; ".join(str(root.poly) for root in partial.roots)
        if mark not in self.given:
            self.budget.spend(100)
            self.given[mark] = {**sample, **root_values(partial.roots, sample)}
        return self.given[mark]

    # ------------------------------------------------ candidates

    def _candidates(self, partial: Partial, name: str, rest: Sequence[str]) -> list[Candidate]:
        ring, one = partial.condition.ring, partial.condition.ring.constant(1)
        if name in UNITS:
            return [(Quotient(one, one), None)]
        plain = list(self.hints.get(name, ()))
        constants = [Quotient(ring.constant(v), one) for v in self._constants(partial, name, rest)]
        if name in self.integers:
            gens = [ring.gen(ring.variable_to_index(n)) for n in self.base if n in self.integers]
            whole = [Quotient(gen + shift, one) for shift in (0, 1, -1) for gen in gens]
            return [(q, None) for q in [*plain, *constants, *whole]]
        lines, roots = self._lines(partial, name, rest)
        plain += [*constants[:3], *lines] if self.borders is None else [*lines, *constants[:3]]
        plain += [Quotient(margin * part, one) for margin in self.margins for part in (1, fmpq(1, 2), fmpq(1, 10), fmpq(1, 100))]
        ordered = self._ordered(partial, [*lines, Quotient(ring.constant(0), one)])
        for left, right in zip(ordered, ordered[1:]):
            for weight in (fmpq(1, 2), fmpq(1, 4), fmpq(3, 4)):
                top = left.top * right.bottom * (1 - weight) + right.top * left.bottom * weight
                plain.append(Quotient.reduced(top, left.bottom * right.bottom))
        for end, shift in ((ordered[:1], -1), (ordered[-1:], 1)):
            plain += [Quotient.reduced(q.top + shift * q.bottom, q.bottom) for q in end]
        plain += [*constants[3:], *between(lines)]
        near = [(q, None) for q in lines[:4]] + roots[:4]
        slight = [margin * c for margin in self.margins[:5] for c in BESIDE]
        small = [(m, k) for m in self.margins if not ring_names(m) & PARAMETERS for k in (4, 20)]
        slight_near = [(Quotient.reduced(q.top * (k + m) + sign * m * q.bottom, q.bottom * (k + m)), root)
                       for q, root in near for m, k in small for sign in (1, -1)]
        beside = slight_near + [(Quotient.reduced(q.top + shift * q.bottom, q.bottom), root) for q, root in near for shift in slight]
        unique: list[Candidate] = []
        seen: set[tuple[str, str]] = set()
        for candidate in [*((q, None) for q in plain), *roots, *beside]:
            mark = (str(candidate[0].top), str(candidate[0].bottom))
            if mark not in seen:
                seen.add(mark)
                unique.append(candidate)
        return unique

    def _constants(self, partial: Partial, name: str, rest: Sequence[str]) -> list[fmpq]:
        """Favourites, and numbers that serve at the middle sample or at the first and the last."""
        found = list(favourites(name, name in self.integers)[:8])
        alive = [c for c in partial.sampled if c.tree is not False]
        for condition in {id(c): c for c in (alive[len(alive) // 2], alive[0], alive[-1])}.values() if alive else ():
            if condition.tree is True or name not in condition.variables():
                continue
            if condition.variables() == {name}:
                values = [v for v in solutions(condition, name, name in self.integers, 2, False) if isinstance(v, fmpq)]
            else:
                values = trials(condition, name, name in self.integers, 2)
            found += [v for v in values if v not in found]
        return found

    def _lines(self, partial: Partial, name: str, rest: Sequence[str]) -> tuple[list[Quotient], list[Candidate]]:
        """The zeros, as quotients or with square roots, of polynomials and of resultants of two of them, as functions of the base."""
        ring = partial.condition.ring
        place = {n: i for i, n in enumerate(ring.names())}
        polys = [partial.condition.polys[k] for k in partial.condition.used()]
        polys += self._borders_at(partial)
        polys = [p for p in polys if p.degrees()[place[name]]]
        direct = [p for p in polys if not any(p.degrees()[place[n]] for n in rest)]
        for other in rest:
            mixed = [partial.condition.polys[k] for k in partial.condition.used()]
            mixed = [p for p in mixed if p.degrees()[place[other]]][:6]
            for i, p in enumerate(mixed):
                for q in mixed[:i]:
                    if sum(p.degrees()) + sum(q.degrees()) <= 14:
                        self.budget.spend(200)
                        resultant = p.resultant(q, other)
                        if resultant != 0 and resultant.degrees()[place[name]] and not any(resultant.degrees()[place[n]] for n in rest):
                            direct.append(resultant)
        found: list[Quotient] = []
        roots: list[Candidate] = []
        for p in direct:
            for factor, _ in p.factor()[1] if len(p) <= 200 else ():
                if factor.degrees()[place[name]] == 1:
                    constant, slope = coefficients_in(factor, name)
                    quotient = Quotient.reduced(-constant, slope)
                    if quotient not in found:
                        found.append(quotient)
                elif factor.degrees()[place[name]] == 2 and len(factor) <= 40:
                    zeros, fresh = square_roots(factor, name, partial.roots)
                    roots += [(q, fresh) for q in zeros]
        return sorted(found, key=lambda q: q.size())[:10], sorted(roots, key=lambda pair: pair[0].size())[:8]

    def _borders_at(self, partial: Partial) -> list[fmpq_mpoly]:
        """The borders after what was decided so far."""
        borders = list(self.borders or ())
        for name, top, bottom in partial.steps:
            borders = [replace(p, name, top, bottom) for p in borders]
        return [p for p in borders if p != 0]

    def _ordered(self, partial: Partial, lines: list[Quotient]) -> list[Quotient]:
        """The quotients in the order of their values at the middle sample, each value once."""
        if not self.samples:
            return []
        sample = self.samples[len(self.samples) // 2]
        given = self._given(partial, sample)
        valued: dict[fmpq, Quotient] = {}
        for q in lines:
            at = q.at(given)
            if at is not None:
                valued.setdefault(at, q)
        return [valued[v] for v in sorted(valued)]

    def _completed(self, partial: Partial) -> dict[str, Quotient]:
        """The values of all unknowns: what was solved for earlier may speak of what was chosen later."""
        values: dict[str, Quotient] = {}
        for name, top, bottom in reversed(partial.steps):
            value = Quotient(top, bottom)
            for other, known in values.items():
                value = insert(value, other, known)
            for root in partial.roots:
                value = Quotient(reduced_by(root, value.top), reduced_by(root, value.bottom))
            values[name] = Quotient.reduced(value.top, value.bottom)
        return values
