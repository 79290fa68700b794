"""Terms tried on samples of the base."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from flint import fmpq, fmpq_mpoly

from juggleproof.algebra.conditions import (
    Condition,
    coefficients_in,
    constant_of,
    places,
    replace,
    valued,
)
from juggleproof.algebra.numbers import exact
from juggleproof.algebra.trees import leaves
from juggleproof.search import limits
from juggleproof.search.candidates import (
    favourites,
    solutions,
    trials,
)
from juggleproof.search.terms import (
    SPARE,
    AdjoinedRoot,
    Partial,
    RingPoint,
    Sample,
    TermChoice,
    TermQuotient,
    Trial,
    among,
    between,
    insert,
    partly,
    reduced_by,
    ring_names,
    root_values,
    rounded,
    square_roots,
)
from juggleproof.statements.language import NO_ROLES, Roles
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# Terms for unknown variables as rational functions of the base variables, tried on samples of the
# base: roots, vertices, averages.

Candidate = tuple[
    TermQuotient, TermQuotient | None, AdjoinedRoot | None
]  # a quotient, what is added to it, and the root adjoined for it
UNKNOWN = fmpq(0)  # itself stands for a value that was not asked for yet


class TemplateSearch:
    """One search for terms; `least` is how many of the samples a choice has to serve."""

    def __init__(
        self,
        base: Sequence[str],
        samples: Sequence[Sample],
        budget: Budget,
        integers: frozenset[str] = frozenset(),
        nodes: int = 400,
        least: int | None = None,
        hints: Mapping[str, Sequence[TermQuotient]] | None = None,
        margins: Sequence[fmpq_mpoly] = (),
        borders: Sequence[fmpq_mpoly] | None = None,
        roles: Roles = NO_ROLES,
    ) -> None:
        self.base, self.samples, self.budget, self.integers = (
            list(base),
            [dict(s) for s in samples],
            budget,
            integers,
        )
        self.roles = roles
        self.nodes, self.hints, self.margins = nodes, dict(hints or {}), list(margins)
        self.given: dict[
            tuple[int, str], dict[str, fmpq]
        ] = {}  # samples with the values of adjoined roots
        self.points: dict[tuple[int, ...], tuple[list[AdjoinedRoot], list[RingPoint]]] = {}
        self.shifts: dict[tuple[int, int], fmpq | None] = {}
        self.slight = [
            TermQuotient(margin * exact(c), margin**0)
            for margin in self.margins[:5]
            for c in limits.BESIDE
        ]
        small = [
            (m, k) for m in self.margins if roles.parameter not in ring_names(m) for k in (4, 20)
        ]
        self.small = [TermQuotient(m * sign, m + k) for m, k in small for sign in (1, -1)]
        self.borders = borders  # where these are given, they are tried first
        self.least = len(self.samples) if least is None else least

    def search(self, condition: Condition, unknowns: Sequence[str]) -> Iterator[TermChoice]:
        """Choices of terms for the unknowns that meet the condition on enough samples, in the order
        that they are met.
        """
        start = Partial(lambda: condition, [condition.substituted(s) for s in self.samples])
        self.ring = condition.ring
        yield from self._descend(start, list(unknowns))

    def _descend(self, partial: Partial, unknowns: list[str]) -> Iterator[TermChoice]:
        alive = [i for i, c in enumerate(partial.sampled) if c.tree is not False]
        if len(alive) < self.least or self.nodes < 0:
            return
        if not unknowns:
            serves = [i for i, c in enumerate(partial.sampled) if c.tree is True]
            if len(serves) >= self.least:
                yield TermChoice(self._completed(partial), partial.roots, serves, self.ring)
            return
        self.nodes -= 1
        self.budget.spend(100 + 60 * len(self.samples) * (1 + len(partial.condition.polys)))
        forced = self._equation(partial, unknowns)
        if forced is not None:
            name, top, bottom = forced
            yield from self._descend(
                self._with(partial, name, top, bottom), [n for n in unknowns if n != name]
            )
            return
        adjoined = self._square_equation(partial, unknowns)
        if adjoined is not None:
            name, poly = adjoined
            yield from self._descend(
                self._adjoined(partial, name, poly), [n for n in unknowns if n != name]
            )
            spare = next((n for n in SPARE if n not in [root.name for root in partial.roots]), None)
            if spare is not None:  # the smaller root, from the larger
                gen = poly.context().gen(poly.context().variable_to_index(spare))
                larger = AdjoinedRoot(spare, replace(poly, name, gen, gen**0))
                widened = partial.with_root(larger)
                value = -coefficients_in(poly, name)[1] - gen
                yield from self._descend(
                    self._with(widened, name, value, gen**0), [n for n in unknowns if n != name]
                )
            return
        name, rest = unknowns[0], unknowns[1:]
        rows = partial.trials(name)
        values: dict[tuple[int, int], fmpq | None] = {}
        tried: set[tuple[int, ...]] = set()
        for value, more, root in self._candidates(partial, name, rest):
            if self.nodes < 0:
                return
            widened = partial.with_root(root)
            key = () if more else value.key()
            if key in tried or not self._plausible(widened, rows, value, more, values):
                continue
            if more is not None:
                value = value.plus(more)
                key = value.key()
            if key not in tried:
                tried.add(key)
                yield from self._descend(self._with(widened, name, value.top, value.bottom), rest)

    def _plausible(
        self,
        partial: Partial,
        rows: Sequence[Trial | None],
        value: TermQuotient,
        more: TermQuotient | None,
        values: dict[tuple[int, int], fmpq | None],
    ) -> bool:
        """Whether value + more may serve at enough samples; `values` keeps what a quotient of this
        node is at each.
        """
        missing, points = len(self.samples) - self.least, self._points(partial)
        self.budget.spend(30)
        for k, row in enumerate(rows):
            at = None
            if row is not None:
                self.budget.spend(20 + 5 * row.size)
                at = (
                    value.within(points[k]) if more is None else values.get((id(value), k), UNKNOWN)
                )
                if at is UNKNOWN:
                    at = values[id(value), k] = value.within(points[k])
                if more is not None and at is not None:
                    extra = self._shift(more, k)
                    at = None if extra is None else at + extra
            missing -= row is None or at is None or row.fails(at, bool(partial.roots))
            if missing < 0:
                return False
        return True

    def _points(self, partial: Partial) -> list[RingPoint]:
        """The samples with the values of the adjoined roots, as points of the ring."""
        key = tuple(map(id, partial.roots))
        if (
            key not in self.points
        ):  # the roots are kept with their points, so that their ids stay theirs
            self.points[key] = (
                partial.roots,
                [RingPoint.of(self.ring, self._given(partial, sample)) for sample in self.samples],
            )
        return self.points[key][1]

    def _shift(self, more: TermQuotient, k: int) -> fmpq | None:
        key = id(more), k
        if key not in self.shifts:
            self.shifts[key] = more.at(self.samples[k])
        return self.shifts[key]

    def _with(self, partial: Partial, name: str, top: fmpq_mpoly, bottom: fmpq_mpoly) -> Partial:
        def make() -> Condition:
            changed = partial.condition.replaced(name, top, bottom)
            for root in partial.roots:
                changed = changed.mapped(lambda p, root=root: reduced_by(root, p))
            return changed

        sampled, one = [], bottom == 1
        for sample, before in zip(self.samples, partial.sampled):
            if before.tree is False:
                sampled.append(before)
                continue
            given = self._given(partial, sample)
            low, high = bottom if one else partly(bottom, given), partly(top, given)
            if low == 0:
                sampled.append(Condition(before.ring, before.polys, False))
            elif partial.roots:
                sampled.append(
                    before.mapped(
                        lambda p, high=high, low=low: rounded(replace(p, name, high, low))
                    )
                )
            else:
                number = constant_of(low)
                sampled.append(
                    before.replaced(name, high, low)
                    if number is None
                    else before.replaced(name, high / number, low**0)
                )
        return Partial(make, sampled, [*partial.steps, (name, top, bottom)], partial.roots)

    # ------------------------------------------------ equations

    def _equation(
        self, partial: Partial, unknowns: Sequence[str]
    ) -> tuple[str, fmpq_mpoly, fmpq_mpoly] | None:
        """An equation linear in an unknown, its coefficient free of unknowns and nonzero at the
        samples.
        """
        place = places(partial.condition.ring)
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
                if all(valued(slope, self._given(partial, s)) != 0 for s in self.samples):
                    size = (sum(rest.degrees()[place[n]] for n in unknowns), len(poly))
                    if best is None or size < best[0]:
                        best = size, (name, -rest, slope)
        return best[1] if best else None

    def _square_equation(
        self, partial: Partial, unknowns: Sequence[str]
    ) -> tuple[str, fmpq_mpoly] | None:
        """An equation of degree 2 in one unknown alone, over the base: its root is adjoined."""
        place = places(partial.condition.ring)
        for poly, relation in partial.condition.facts():
            degrees = poly.degrees()
            present = [n for n in unknowns if degrees[place[n]]]
            if (
                relation == "="
                and len(present) == 1
                and degrees[place[present[0]]] == 2
                and present[0] not in self.integers
            ):
                lead = coefficients_in(poly, present[0])[2]
                if constant_of(lead) is not None:
                    return present[0], poly / lead.leading_coefficient()
        return None

    def _adjoined(self, partial: Partial, name: str, poly: fmpq_mpoly) -> Partial:
        """The condition with the unknown taken as a root: every polynomial is reduced modulo its
        equation.
        """
        root = AdjoinedRoot(name, poly)
        changed = partial.condition.mapped(lambda p: reduced_by(root, p))
        roots = [*partial.roots, root]
        result = Partial(lambda: changed, [], partial.steps, roots)
        for sample, before in zip(self.samples, partial.sampled):
            given = self._given(result, sample)
            failed = before.tree is False or name not in given
            result.sampled.append(
                Condition(changed.ring, changed.polys, False)
                if failed
                else changed.mapped(lambda p, given=given: rounded(partly(p, given)))
            )
        return result

    def _given(self, partial: Partial, sample: Sample) -> Sample:
        """The sample with the values of the adjoined roots there."""
        if not partial.roots:
            return sample
        key = id(sample), "; ".join(str(root.poly) for root in partial.roots)
        if key not in self.given:
            self.budget.spend(100)
            self.given[key] = {**sample, **root_values(partial.roots, sample)}
        return self.given[key]

    # ------------------------------------------------ candidates

    def _candidates(self, partial: Partial, name: str, rest: Sequence[str]) -> Iterator[Candidate]:
        """Quotients to try for an unknown, made only as far as they are asked for."""
        one = self.ring.constant(1)
        if self.roles.is_scale(name):
            yield TermQuotient(one, one), None, None
            return
        simple = list(self.hints.get(name, ()))
        likely = [
            TermQuotient(self.ring.constant(v), one)
            for v in favourites(name, name in self.integers, self.roles)[:8]
        ]
        if name in self.integers:
            gens = [self.ring.gen(places(self.ring)[n]) for n in self.base if n in self.integers]
            whole = [TermQuotient(gen + shift, one) for shift in (0, 1, -1) for gen in gens]
            yield from (
                (q, None, None) for q in [*simple, *likely, *self._constants(partial, name), *whole]
            )
            return
        lines, roots = self._lines(partial, name, rest)
        simple += [*likely[:3], *lines] if self.borders is None else [*lines, *likely[:3]]
        yield from ((q, None, None) for q in simple)
        parts = (fmpq(1), fmpq(1, 2), fmpq(1, 10), fmpq(1, 100))
        yield from (
            (TermQuotient(margin * part, one), None, None)
            for margin in self.margins
            for part in parts
        )
        yield from (
            (q, None, None)
            for q in among(
                self._ordered(partial, [*lines, TermQuotient(self.ring.constant(0), one)])
            )
        )
        yield from ((q, None, None) for q in [*likely[3:], *self._constants(partial, name)])
        yield from ((q, None, None) for q in between(lines))
        yield from ((q, None, root) for q, root in roots)
        nearby = [*((q, None) for q in lines[:4]), *roots[:4]]
        for more in (self.small, self.slight):
            yield from ((q, shift, root) for q, root in nearby for shift in more)

    def _constants(self, partial: Partial, name: str) -> list[TermQuotient]:
        """Numbers that serve at the middle sample or at the first and the last."""
        found: list[fmpq] = []
        alive = [c for c in partial.sampled if c.tree is not False]
        for condition in (
            {id(c): c for c in (alive[len(alive) // 2], alive[0], alive[-1])}.values()
            if alive
            else ()
        ):
            if condition.tree is True or name not in condition.variables():
                continue
            if condition.variables() == {name}:
                values = [
                    v
                    for v in solutions(condition, name, name in self.integers, 2, False, self.roles)
                    if isinstance(v, fmpq)
                ]
            else:
                values = trials(condition, name, name in self.integers, 2, self.roles)
            found += [v for v in values if v not in found]
        return [TermQuotient(self.ring.constant(v), self.ring.constant(1)) for v in found]

    def _lines(
        self, partial: Partial, name: str, rest: Sequence[str]
    ) -> tuple[list[TermQuotient], list[tuple[TermQuotient, AdjoinedRoot | None]]]:
        """The zeros, as quotients or with square roots, of polynomials and of resultants of two of
        them, as functions of the base.
        """
        place = places(partial.condition.ring)
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
                        if (
                            resultant != 0
                            and resultant.degrees()[place[name]]
                            and not any(resultant.degrees()[place[n]] for n in rest)
                        ):
                            direct.append(resultant)
        found: list[TermQuotient] = []
        roots: list[tuple[TermQuotient, AdjoinedRoot | None]] = []
        for p in direct:
            for factor, _ in p.factor()[1] if len(p) <= 200 else ():
                if factor.degrees()[place[name]] == 1:
                    constant, slope = coefficients_in(factor, name)
                    quotient = TermQuotient.reduced(-constant, slope)
                    if quotient not in found:
                        found.append(quotient)
                elif factor.degrees()[place[name]] == 2 and len(factor) <= 40:
                    zeros, fresh = square_roots(factor, name, partial.roots)
                    roots += [(q, fresh) for q in zeros]
        return (
            sorted(found, key=lambda q: q.size())[:10],
            sorted(roots, key=lambda pair: pair[0].size())[:8],
        )

    def _borders_at(self, partial: Partial) -> list[fmpq_mpoly]:
        """The borders after what was decided so far."""
        borders = list(self.borders or ())
        for name, top, bottom in partial.steps:
            borders = [replace(p, name, top, bottom) for p in borders]
        return [p for p in borders if p != 0]

    def _ordered(self, partial: Partial, lines: list[TermQuotient]) -> list[TermQuotient]:
        """The quotients in the order of their values at the middle sample, each value once."""
        if not self.samples:
            return []
        sample = self.samples[len(self.samples) // 2]
        given = self._given(partial, sample)
        valued: dict[fmpq, TermQuotient] = {}
        for q in lines:
            at = q.at(given)
            if at is not None:
                valued.setdefault(at, q)
        return [valued[v] for v in sorted(valued)]

    def _completed(self, partial: Partial) -> dict[str, TermQuotient]:
        """The values of all unknowns: what was solved for earlier may speak of what was chosen
        later.
        """
        values: dict[str, TermQuotient] = {}
        for name, top, bottom in reversed(partial.steps):
            value = TermQuotient(top, bottom)
            for other, known in values.items():
                value = insert(value, other, known)
            for root in partial.roots:
                value = TermQuotient(reduced_by(root, value.top), reduced_by(root, value.bottom))
            values[name] = TermQuotient.reduced(value.top, value.bottom)
        return values


# -------------------------------------------------------------------------------------------------
# States on borders: unknowns put where relations that include equality are equations, the others
# in between, tried on samples of the base.

Move = tuple[str, TermQuotient, "AdjoinedRoot | None"]


class CornerSearch(TemplateSearch):
    """One search for corners: equations are solved first, then some of the relations >= are taken
    as equations, and solved too.

    The sharp end of a range lies as a rule where some inequalities meet, and beyond it the states
    that break a statement begin there.
    """

    def search(self, condition: Condition, unknowns: Sequence[str]) -> Iterator[TermChoice]:
        """Choices of terms for the unknowns, those on the most borders first."""
        self.steps, self.seen = limits.TEMPLATE_STEPS, set[frozenset[int]]()
        if (
            self.borders is None
        ):  # factors now: what an adjoined root is put into may no longer be a product
            products = [
                condition.polys[k].factor()[1]
                for k in condition.used()
                if len(condition.polys[k]) <= limits.MOST_FACTORED_TERMS
            ]
            self.borders = [
                factor for factors in products if len(factors) > 1 for factor, _ in factors
            ]
        yield from super().search(condition, unknowns)

    def _descend(self, partial: Partial, unknowns: list[str]) -> Iterator[TermChoice]:
        yield from self._corner(partial, unknowns, frozenset())

    def _corner(
        self, partial: Partial, unknowns: list[str], chosen: frozenset[int]
    ) -> Iterator[TermChoice]:
        if sum(c.tree is not False for c in partial.sampled) < self.least:
            return
        if not unknowns:
            yield from super()._descend(partial, unknowns)
            return
        scale = next((name for name in unknowns if self.roles.is_scale(name)), None)
        if scale is not None:
            one = partial.condition.ring.constant(1)
            yield from self._follow(
                partial, unknowns, chosen, [(scale, TermQuotient(one, one), None)]
            )
            return
        forced = next(
            (
                moves
                for poly, relation in partial.condition.facts()
                if relation == "="
                for moves in [self._moves(partial, poly, unknowns)]
                if moves
            ),
            None,
        )
        if forced:
            yield from self._follow(partial, unknowns, chosen, forced)
            return
        for k, relation in sorted(set(leaves(partial.condition.tree))):
            onward = chosen | {k}
            if relation in (">=", "=") and onward not in self.seen and self.steps > 0:
                self.seen.add(onward)
                yield from self._follow(
                    partial,
                    unknowns,
                    onward,
                    self._moves(partial, partial.condition.polys[k], unknowns),
                )
        if len(unknowns) == 1:
            yield from super()._descend(partial, unknowns)

    def _follow(
        self, partial: Partial, unknowns: list[str], chosen: frozenset[int], moves: Sequence[Move]
    ) -> Iterator[TermChoice]:
        seen = self.seen
        for name, value, root in moves:
            self.steps -= 1
            self.budget.spend(100 + 60 * len(self.samples) * (1 + len(partial.condition.polys)))
            widened = partial.with_root(root)
            rows = partial.trials(name)
            if (ring_names(value.top) | ring_names(value.bottom)) & set(
                unknowns
            ) or self._plausible(widened, rows, value, None, {}):
                self.seen = set(seen) if len(moves) > 1 else seen
                yield from self._corner(
                    self._with(widened, name, value.top, value.bottom),
                    [n for n in unknowns if n != name],
                    chosen,
                )
        self.seen = seen

    def _moves(self, partial: Partial, poly: fmpq_mpoly, unknowns: Sequence[str]) -> list[Move]:
        """The ways to make a polynomial 0 by the value of one unknown: of a factor linear in it, or
        of degree 2 in it alone.
        """
        found: list[Move] = []
        for factor, _ in poly.factor()[1] if len(poly) <= limits.MOST_FACTORED_TERMS else ():
            names = ring_names(factor)
            present = [n for n in unknowns if n in names and n not in self.integers]
            present.sort(key=lambda n: (self._degree(partial, n), -unknowns.index(n)))
            linear = next(
                (
                    move
                    for name in present
                    for move in self._linear(partial, factor, name, unknowns)
                ),
                None,
            )
            if linear is not None:
                found.append(linear)
            elif len(present) == 1 and len(coefficients_in(factor, present[0])) == 3:
                zeros, fresh = square_roots(factor, present[0], partial.roots)
                found += [(present[0], zero, fresh) for zero in zeros]
        return found

    @staticmethod
    def _degree(partial: Partial, name: str) -> int:
        """How high an unknown occurs: the lowest is solved for, which keeps degrees low."""
        condition = partial.condition
        place = condition.ring.variable_to_index(name)
        return max((int(condition.polys[k].degrees()[place]) for k in condition.used()), default=0)

    def _linear(
        self, partial: Partial, factor: fmpq_mpoly, name: str, unknowns: Sequence[str]
    ) -> list[Move]:
        parts = coefficients_in(factor, name)
        if len(parts) != 2 or ring_names(parts[1]) & set(unknowns):
            return []
        if any(valued(parts[1], self._given(partial, sample)) == 0 for sample in self.samples):
            return []
        return [(name, TermQuotient.reduced(-parts[0], parts[1]), None)]
