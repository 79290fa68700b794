"""Sets of one parameter; verdicts along it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpq_poly

from juggleproof.algebra.conditions import (
    Condition,
    border_polynomials,
    candidate_numbers,
    multivariate,
    ring_of,
    univariate,
    without_equations,
)
from juggleproof.algebra.numbers import (
    AlgebraicNumber,
    fraction,
    real_roots,
    simplest_between,
)
from juggleproof.algebra.polynomials import relation_of, term_of
from juggleproof.algebra.trees import HOLDS
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.candidates import FAVOURITE_PARAMETERS, cells_between, separate
from juggleproof.search.hints.asking import ask
from juggleproof.search.scales import with_scales
from juggleproof.search.terms import ring_names
from juggleproof.statements.language import (
    NO_ROLES,
    Formula,
    Roles,
    Term,
    conjunction,
    disjunction,
    equal,
    real,
    term,
)
from juggleproof.statements.work import Budget, unfolded

# -------------------------------------------------------------------------------------------------
# Whole numbers that the hypotheses tie to a parameter, as floor and ceiling do: the pairs of both
# are where a range is sought.


def pinned(
    statements: Sequence[checker.Statement],
    parameter: str,
    domain: ast.expr,
    budget: Budget,
    roles: Roles = NO_ROLES,
) -> tuple[str, Formula] | None:
    """(a whole number of all the statements, their hypotheses on it and the parameter alone); the
    scales are 1.

    >>> text = "statement a/b\\nforall alpha n x\\ninteger n\\n"
    >>> text += "given n <= 2*alpha and 2*alpha < n + 1\\nshow x*n <= 2*x*alpha"
    >>> (one,) = checker.read_statements(text).values()
    >>> str(pinned([one], "alpha", checker.parse("alpha > 0"), Budget(10**5))[1])
    '2*alpha - n >= 0 and -2*alpha + n + 1 > 0'
    """
    for name in sorted({n for each in statements for line in each.get("integer") for n in line}):
        each_one = [_hypotheses(s, parameter, name, domain, budget, roles) for s in statements]
        if each_one and all(each_one):
            return name, conjunction(
                list(
                    {
                        str(formula): formula for formulas in each_one for formula in formulas
                    }.values()
                )
            )
    return None


def _hypotheses(
    statement: checker.Statement,
    parameter: str,
    name: str,
    domain: ast.expr,
    budget: Budget,
    roles: Roles,
) -> list[Formula]:
    unfolding = checker.Unfolding(statement, checker.Context(), [domain])
    if name not in unfolding.integers or name not in unfolding.universal:
        return []
    ring = ring_of(unfolding.context)
    premises = Condition.of(unfolding.context, checker.join("and", list(unfolding.premises)), ring)
    premises = premises.substituted(_ones(unfolding, roles))
    left, _ = without_equations(premises, {parameter, name}, budget, ())
    positive = [
        poly
        for poly, relation in left.facts()
        if relation == ">" and ring_names(poly) == {parameter}
    ]
    return [
        relation_of(_without(positive, poly), relation)
        for poly, relation in left.facts()
        if ring_names(poly) == {parameter, name}
    ]


def _ones(unfolding: checker.Unfolding, roles: Roles) -> dict[str, fmpq]:
    """1 for every scale of an unfolded statement."""
    scales = with_scales(roles, unfolding).scales or frozenset()
    return {name: fmpq(1) for name in scales & unfolding.variables}


def _without(positive: Sequence[fmpq_mpoly], poly: fmpq_mpoly) -> fmpq_mpoly:
    """The polynomial divided by what is positive, as often as that goes."""
    for factor in positive:
        while True:
            quotient, rest = divmod(poly, factor)
            if rest != 0:
                break
            poly = quotient
    return poly


# -------------------------------------------------------------------------------------------------
# Sets of one parameter as intervals with exact ends, and as conditions that the language of
# statements can write.

MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}


@dataclass(frozen=True)
class DomainCell:
    """The numbers between two ends; None is where the domain itself ends."""

    low: AlgebraicNumber | None
    low_closed: bool
    high: AlgebraicNumber | None
    high_closed: bool


@dataclass(frozen=True)
class CutDomain:
    """The domain cut at numbers: the verdicts on its open cells and at the numbers, in order: cell,
    number, cell, ..., cell.
    """

    numbers: tuple[AlgebraicNumber, ...]
    verdicts: tuple[bool, ...]

    def simplified(self) -> CutDomain:
        """The same set, cut only where the verdict changes."""
        numbers: list[AlgebraicNumber] = []
        verdicts = [self.verdicts[0]]
        for k, number in enumerate(self.numbers):
            at, after = self.verdicts[2 * k + 1], self.verdicts[2 * k + 2]
            if not verdicts[-1] == at == after:
                numbers.append(number)
                verdicts += [at, after]
        return CutDomain(tuple(numbers), tuple(verdicts))

    def intervals(self, verdict: bool) -> list[DomainCell]:
        """The maximal intervals of one verdict, in order."""
        found: list[DomainCell] = []
        start: tuple[AlgebraicNumber | None, bool] | None = None
        for k, own in enumerate(self.verdicts):
            here = self.numbers[k // 2] if k % 2 else None
            if own == verdict and start is None:
                start = (here, True) if here else (self.numbers[k // 2 - 1] if k else None, False)
            if start is not None and own != verdict:
                end = (here, False) if here else (self.numbers[k // 2 - 1], True)
                found.append(DomainCell(*start, *end))
                start = None
        return [*found, DomainCell(*start, None, False)] if start is not None else found


def line_on(condition: ast.expr, parameter: str, domain: ast.expr) -> CutDomain | None:
    """The set of one parameter on which a condition holds, within a domain; None where this is not
    one interval.

    >>> line = line_on(checker.parse("3*a < 1"), "a", checker.parse("a > 0 and a < 1"))
    >>> [str(number.as_fraction()) for number in line.numbers], line.verdicts
    (['1/3'], (True, False, False))
    """
    context = checker.Context()
    context.declare(parameter)
    within = Condition.of(context, context.formula(domain))
    holds = Condition.of(context, context.formula(condition))
    own, cells = holds.in_one_variable(parameter), within.in_one_variable(parameter)
    numbers = candidate_numbers([*holds.polys, *within.polys], parameter)
    separate(numbers)
    inner = [n for n in numbers if within.univariate_truth(parameter, n, cells)]
    samples = _cell_samples(numbers, len(inner) + 1, within, parameter, cells)
    if samples is None:
        return None
    verdicts = [holds.univariate_truth(parameter, samples[0], own)]
    for number, sample in zip(inner, samples[1:]):
        verdicts += [holds.univariate_truth(parameter, at, own) for at in (number, sample)]
    return CutDomain(tuple(inner), tuple(verdicts))


def condition_of(line: CutDomain, parameter: str, domain: Formula) -> Formula:
    """A condition that holds, within the domain, on the cells and numbers of verdict True.

    >>> from juggleproof.statements.language import reals
    >>> (a,) = reals("alpha")
    >>> line = CutDomain((AlgebraicNumber.rational(Fraction(1, 3)),), (True, False, False))
    >>> str(condition_of(line, "alpha", a > 0))
    '3*alpha < 1'
    """
    inside = line.intervals(True)
    if not line.intervals(False):
        return domain
    if (
        len(line.intervals(False)) == 1
        and len(inside) == 2
        and line.intervals(False)[0].low is line.intervals(False)[0].high
    ):
        number = line.intervals(False)[0].low
        if number is not None and number.is_rational:
            return Formula("!=", *_rational_sides(number.as_fraction(), parameter))
    single = one_relation(line, parameter, domain)
    return (
        single
        if single is not None
        else disjunction([_interval_formula(i, domain, parameter) for i in inside])
    )


def one_relation(line: CutDomain, parameter: str, domain: Formula) -> Formula | None:
    """p relation 0 for the one irreducible polynomial p of all the ends, where that is equivalent
    on the domain.

    >>> from juggleproof.statements.language import reals
    >>> (a,) = reals("alpha")
    >>> ends = real_roots(fmpq_poly([-1, 10, -20, 10]))[:2]
    >>> line = CutDomain(tuple(ends), (False, False, True, False, False))
    >>> str(one_relation(line, "alpha", (a > 0) & (a < 1)))
    '10*alpha^3 - 20*alpha^2 + 10*alpha - 1 > 0'
    """
    poly = tuple(line.numbers[0].coefficients) if line.numbers else ()
    if len(poly) <= 2 or any(tuple(number.coefficients) != poly for number in line.numbers):
        return None
    if len(isolated(poly, domain, parameter)) != len(line.numbers):
        return None
    rising = line.numbers[0].sign_of(fmpq_poly(line.numbers[0].poly).derivative()) > 0
    signs = [
        0 if k % 2 else 1 if (k // 2 % 2 == 1) == rising else -1 for k in range(len(line.verdicts))
    ]
    relation = next((r for r in HOLDS if [HOLDS[r](s) for s in signs] == list(line.verdicts)), None)
    if relation is None:
        relation = next(
            (MIRRORED[r] for r in HOLDS if [HOLDS[r](-s) for s in signs] == list(line.verdicts)),
            None,
        )
    return Formula(relation, polynomial_term(poly, parameter), term(0)) if relation else None


def _interval_formula(interval: DomainCell, domain: Formula, parameter: str) -> Formula:
    if interval.low is not None and interval.low is interval.high:
        return _bound(interval.low, "=", domain, parameter)
    parts = []
    if interval.low is not None:
        parts.append(_bound(interval.low, ">=" if interval.low_closed else ">", domain, parameter))
    if interval.high is not None:
        parts.append(
            _bound(interval.high, "<=" if interval.high_closed else "<", domain, parameter)
        )
    return conjunction(parts)


def _rational_sides(value: Fraction, parameter: str) -> tuple[Term, Term]:
    name = real(parameter)
    return (name if value.denominator == 1 else value.denominator * name), term(value.numerator)


def polynomial_term(coefficients: Sequence[int], parameter: str) -> Term:
    """An integer polynomial, constant first, as a term with the highest power first."""
    ring = fmpq_mpoly_ctx.get([parameter], Ordering.lex)
    return term_of(multivariate(fmpq_poly(list(coefficients)), ring, parameter))


def _bound(number: AlgebraicNumber, relation: str, domain: Formula, parameter: str) -> Formula:
    """parameter relation number, exact on the domain: by the sign of the polynomial on the interval
    on which this is its only root.
    """
    if number.is_rational:
        return Formula(relation, *_rational_sides(number.as_fraction(), parameter))
    rising = number.sign_of(fmpq_poly(number.poly).derivative()) > 0
    poly, name = polynomial_term(number.coefficients, parameter), real(parameter)
    intervals = isolated(number.coefficients, domain, parameter)
    low, high = next(pair for pair in intervals if pair[0] < number < pair[1])
    parts = [name > low] * (low != intervals[0][0]) + [name < high] * (high != intervals[-1][1])
    if relation == "=":
        return conjunction([equal(poly, 0), *parts])
    own = Formula(relation if rising else MIRRORED[relation], poly, term(0))
    below = [name <= low] * (low != intervals[0][0])
    above = [name >= high] * (high != intervals[-1][1])
    return disjunction([*(below if relation in ("<", "<=") else above), conjunction([*parts, own])])


def isolated(
    coefficients: Sequence[int], domain: Formula, parameter: str
) -> list[tuple[Fraction, Fraction]]:
    """Intervals that fill the domain (or what holds all roots, where it has no ends), each with one
    root of an irreducible polynomial.

    >>> a = real("alpha")
    >>> isolated([-1, 10, -20, 10], (a > 0) & (a < 1), "alpha")
    [(Fraction(0, 1), Fraction(1, 2)), (Fraction(1, 2), Fraction(1, 1))]
    """
    bottom, top = ends_of(checker.parse(str(domain)), parameter)
    roots = [
        r
        for r in real_roots(fmpq_poly(list(coefficients)))
        if (bottom is None or r > bottom) and (top is None or r < top)
    ]
    separate(roots)
    low = fraction(roots[0]._low) - 1 if bottom is None else bottom
    high = fraction(roots[-1]._high) + 1 if top is None else top
    cuts = [
        low,
        *(
            fraction(simplest_between(left._high, right._low))
            for left, right in zip(roots, roots[1:])
        ),
        high,
    ]
    return list(zip(cuts, cuts[1:]))


def ends_of(domain: ast.expr, parameter: str) -> tuple[Fraction | None, Fraction | None]:
    """The rational ends of a domain, as the checker parses it, that bounds the parameter by
    relations linear in it; None where it has no such end.
    """
    context = checker.Context()
    context.declare(parameter)
    bounds: dict[bool, list[Fraction]] = {True: [], False: []}
    for poly, relation in Condition.of(context, context.formula(domain)).facts():
        line = univariate(poly, parameter)
        if line.degree() == 1 and relation in (">", ">="):
            bounds[bool(line[1] > 0)].append(fraction(-line[0] / line[1]))
    return max(bounds[True], default=None), min(bounds[False], default=None)


# -------------------------------------------------------------------------------------------------
# What a point at which a statement fails meets, and Z3's verdict on whether there is one at a
# value of a parameter.


@dataclass(frozen=True)
class Violation:
    """What a point at which a statement fails meets: the premises, and no values of the bound
    variables that meet the goals.
    """

    name: str
    condition: Condition
    goal: Condition | None
    bound: tuple[str, ...]
    integers: tuple[str, ...]
    verdicts: dict[fmpq, bool] = field(default_factory=dict)  # at rationals, as far as known

    @staticmethod
    def of(
        statement: checker.Statement, domain: ast.expr | None = None, roles: Roles = NO_ROLES
    ) -> Violation:
        """The violations of a statement, in a domain of a parameter if given, scales being 1."""
        unfolding = unfolded(statement, None if domain is None else [domain])
        premises = list(unfolding.premises)
        ones = _ones(unfolding, roles)
        ring = ring_of(unfolding.context)
        exists = tuple(sorted(unfolding.variables - set(unfolding.universal)))
        whole = premises if exists else [*premises, unfolding.goal(False)]
        condition = Condition.of(unfolding.context, checker.join("and", whole), ring).substituted(
            ones
        )
        goal = (
            Condition.of(unfolding.context, unfolding.goal(True), ring).substituted(ones)
            if exists
            else None
        )
        return Violation(statement.name, condition, goal, exists, tuple(sorted(unfolding.integers)))

    def absent(
        self,
        parameter: str,
        at: fmpq | AlgebraicNumber,
        budget: Budget,
        resources: int = limits.Z3_WORK,
    ) -> bool | None:
        """Z3's verdict at one value of the parameter: True where there is no violation, None where
        it has none.
        """
        if isinstance(at, AlgebraicNumber) and at.is_rational:
            at = at._low
        if isinstance(at, AlgebraicNumber):
            condition, ring = self.condition, self.condition.ring
            gen = ring.gen(ring.variable_to_index(parameter))
            modulus = multivariate(fmpq_poly(at.poly), ring, parameter)
            here = Condition(
                ring,
                [modulus, gen - at._low, at._high - gen],
                ("and", [(0, "="), (1, ">"), (2, ">")]),
            )
            return self._absent(condition.conjoined(here), self.goal, budget, resources)
        if at not in self.verdicts:
            absent = self.absent_at({parameter: at}, budget, resources)
            if absent is None:
                return None
            self.verdicts[at] = absent
        return self.verdicts[at]

    def absent_at(
        self, sample: Mapping[str, fmpq], budget: Budget, resources: int = limits.Z3_WORK
    ) -> bool | None:
        """Z3's verdict at values of some variables."""
        goal = self.goal.substituted(sample) if self.goal is not None else None
        return self._absent(self.condition.substituted(sample), goal, budget, resources)

    def absent_everywhere(self, budget: Budget) -> bool | None:
        """Z3's verdict within little work, whatever the parameters are."""
        return self._absent(self.condition, self.goal, budget, limits.Z3_GUESS_WORK)

    def _absent(
        self, condition: Condition, goal: Condition | None, budget: Budget, resources: int
    ) -> bool | None:
        unreachable = (goal, self.bound) if goal is not None else None
        verdict = ask(condition, budget, self.integers, resources, unreachable=unreachable).verdict
        return {"sat": False, "unsat": True}.get(verdict)


# -------------------------------------------------------------------------------------------------
# On which values of one parameter statements hold: candidate end points by elimination, verdicts
# by Z3 between them and at them.

Verdicts = dict[str, tuple[bool, ...]]


class Undecided(Exception):
    """Why there is no line of verdicts."""


@dataclass
class CellVerdict:
    """One statement's verdicts on the cells and at the numbers between them; None where Z3 has
    none.
    """

    violation: Violation
    cells: list[bool]
    numbers: list[bool | None]


class VerdictLines:
    """The verdicts of all statements along a domain that is one interval of one parameter.

    Raises Undecided where Z3 has no verdict on an open cell, or the domain is not such.
    """

    def __init__(
        self,
        violations: Sequence[Violation],
        parameter: str,
        domain: ast.expr,
        budget: Budget,
    ) -> None:
        self.parameter, self.budget = parameter, budget
        context = checker.Context()
        context.declare(parameter)
        allowed = Condition.of(context, context.formula(domain))
        if isinstance(allowed.tree, bool):
            raise Undecided("the domain says nothing about the parameter")
        borders = border_polynomials(
            [(v.condition, v.goal) for v in violations], [parameter], budget
        )
        cells = allowed.in_one_variable(parameter)
        numbers = candidate_numbers(
            [*(p.project_to_context(allowed.ring) for p in borders), *allowed.polys], parameter
        )
        separate(numbers)
        self.inner = [n for n in numbers if allowed.univariate_truth(parameter, n, cells)]
        asked = [value for violation in violations for value in violation.verdicts]
        samples = _cell_samples(numbers, len(self.inner) + 1, allowed, parameter, cells, asked)
        if samples is None:
            raise Undecided("the domain is not one interval")
        self.each = [self._verdict(violation, samples) for violation in violations]

    def _verdict(self, violation: Violation, samples: Sequence[fmpq]) -> CellVerdict:
        cells = []
        for sample in samples:
            verdict = violation.absent(self.parameter, sample, self.budget)
            if verdict is None:
                raise Undecided(f"no verdict on {violation.name} at {self.parameter} = {sample}")
            cells.append(verdict)
        numbers = [
            self._at(violation, number, before, after)
            for number, before, after in zip(self.inner, cells, cells[1:])
        ]
        return CellVerdict(violation, cells, numbers)

    def _at(
        self, violation: Violation, number: AlgebraicNumber, before: bool, after: bool
    ) -> bool | None:
        """The verdict at a number between two cells; theirs if they agree and the number is hard
        for Z3.
        """
        if before == after and not number.is_rational:
            verdict = (
                violation.absent(self.parameter, number, self.budget, limits.Z3_GUESS_WORK)
                if number.poly.degree() <= 2
                else None
            )
            return before if verdict is None else verdict
        return violation.absent(self.parameter, number, self.budget)

    def guesses(self) -> Iterator[tuple[CutDomain, Verdicts]]:
        """The lines to try: undecided numbers held to be in, then out; then with Z3 asked at every
        number; each line once.
        """
        seen: list[Verdicts] = []
        for thorough in (False, True):
            if thorough:
                self.each = [replace(one, numbers=self._asked_again(one)) for one in self.each]
            for doubtful in (True, False):
                verdicts = {one.violation.name: _joined(one, doubtful) for one in self.each}
                if verdicts not in seen:
                    seen.append(verdicts)
                    yield (
                        CutDomain(
                            tuple(self.inner), tuple(all(v) for v in zip(*verdicts.values()))
                        ),
                        verdicts,
                    )

    def _asked_again(self, one: CellVerdict) -> list[bool | None]:
        found = []
        for number, before, after, verdict in zip(
            self.inner, one.cells, one.cells[1:], one.numbers
        ):
            if before == after == verdict and number.poly.degree() > 2:
                verdict = one.violation.absent(
                    self.parameter, number, self.budget, limits.Z3_GUESS_WORK
                )
                verdict = before if verdict is None else verdict
            found.append(verdict)
        return found


def _joined(one: CellVerdict, doubtful: bool) -> tuple[bool, ...]:
    joined = [one.cells[0]]
    for at, after in zip(one.numbers, one.cells[1:]):
        joined += [doubtful if at is None else at, after]
    return tuple(joined)


def _cell_samples(
    numbers: Sequence[AlgebraicNumber],
    count: int,
    allowed: Condition,
    parameter: str,
    cells: Mapping[int, fmpq_poly],
    asked: Sequence[fmpq] = (),
) -> list[fmpq] | None:
    """A simple rational in every open cell of the domain, which has to be one interval; one at
    which Z3 was asked before where there is one.
    """
    samples = []
    for bottom, top in cells_between(numbers):
        nice = [v for v in (*asked, *FAVOURITE_PARAMETERS) if bottom < v < top]
        value = nice[0] if nice else simplest_between(bottom, top)
        if allowed.univariate_truth(parameter, value, cells):
            samples.append(value)
    return samples if len(samples) == count else None
