"""A statement as the questions that decide it: formulas over the signs of integer polynomials."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Union

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from juggleproof.algebra import trees
from juggleproof.algebra.polynomials import (
    Ring,
    constant_of,
    monomials,
    used_in,
    value_at,
)
from juggleproof.certificates import checker
from juggleproof.search.psatz.facts import Scaling
from juggleproof.statements.work import unfolded

# -------------------------------------------------------------------------------------------------
# Formulas over the signs of integer polynomials: what the routes decide.


@dataclass(frozen=True)
class Atom:
    """The fact poly > 0, >= 0, = 0 or != 0."""

    poly: fmpz_mpoly
    relation: str

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.relation, str(self.poly)))  # FLINT's polynomials have no hash

    @cached_property
    def used(self) -> tuple[int, ...]:
        """The numbers of the variables that occur."""
        return used_in(self.poly)

    def holds(self, value: Fraction | int) -> bool:
        """Whether the relation holds where the polynomial has this value (or a number of the same
        sign).
        """
        return trees.HOLDS[self.relation](value)

    def holds_at(self, point: Sequence[Fraction]) -> bool:
        """Whether the relation holds at a rational point, exactly."""
        return self.holds(value_at(self.poly, point))

    def __str__(self) -> str:
        return f"{self.poly} {self.relation} 0"


Formula = Union[bool, Atom, tuple[trees.Op, Sequence["Formula"]]]


def join(op: trees.Op, formulas: Sequence[Formula]) -> Formula:
    """The conjunction or disjunction, without constants, repetitions and joins of the same kind
    inside.
    """
    whole = trees.join(op, formulas)
    if not trees.is_join(whole):
        return whole
    parts = tuple(dict.fromkeys(whole[1]))
    return parts[0] if len(parts) == 1 else (whole[0], parts)


def atom(poly: fmpz_mpoly, relation: str) -> Formula:
    """The atom over coprime integer coefficients, or its truth value where the polynomial is
    constant.
    """
    value = constant_of(poly)
    if value is not None:
        return Atom(poly, relation).holds(value)
    content = int(poly.content())
    if relation in ("=", "!=") and poly.leading_coefficient() < 0:
        content = -content
    return Atom(poly / content if content != 1 else poly, relation)


def branches(formula: Formula, limit: int) -> list[tuple[Atom, ...]] | None:
    """The disjunctive normal form: each branch a conjunction of atoms; None where it has more than
    `limit` branches.

    >>> (x,) = ring_of(("x",)).gens()
    >>> either = "or", (Atom(x, ">"), Atom(x, "="))
    >>> [[str(fact) for fact in b] for b in branches(either, 4) or []]
    [['x > 0'], ['x = 0']]
    """
    if isinstance(formula, bool):
        return [()] if formula else []
    if isinstance(formula, Atom):
        return [(formula,)]
    op, parts = formula
    disjuncts: list[tuple[Atom, ...]] = [] if op == "or" else [()]
    for part in parts:
        inner = branches(part, limit)
        if inner is None:
            return None
        if op == "or":
            disjuncts += inner
        else:
            disjuncts = [
                merged for a in disjuncts for b in inner if (merged := _merge(a, b)) is not None
            ]
        if len(disjuncts) > limit:
            return None
    return disjuncts


def _merge(first: tuple[Atom, ...], second: tuple[Atom, ...]) -> tuple[Atom, ...] | None:
    facts = dict.fromkeys(first + second)
    # p > 0 and p <= 0 in one branch: it is empty, and dropping it here keeps the normal form small
    if any(f.relation == "=" and Atom(f.poly, r) in facts for f in facts for r in (">", "!=")):
        return None
    for fact in facts:
        if fact.relation == ">" and any(Atom(-fact.poly, r) in facts for r in (">", ">=", "=")):
            return None
    return tuple(facts)


# -------------------------------------------------------------------------------------------------
# A statement as the questions that decide it: polynomials only, with the denominators cleared by
# the checker's own unfolding.
#
# A question is a formula "assumed, and for all bound variables denied"; the statement holds if and
# only if no question has a solution.


@dataclass(frozen=True)
class Denial:
    """For all values of the bound variables (none for a universal statement) there are values of
    the `chosen` ones with the formula.

    Only the outside of a sharp range chooses: a named statement with `exists` is assumed there, not
    denied.
    """

    bound: tuple[str, ...]
    formula: Formula
    chosen: tuple[str, ...] = ()


@dataclass(frozen=True)
class VoteQuestion:
    """Is there a point that meets all of `assumed` and every denial?  `part` names the line of the
    statement that is denied.

    A point refutes the statement where `refutes`; else (a `have` line, or the term under a root) it
    shows that a line does not follow.
    """

    statement: str
    part: str
    names: tuple[str, ...]
    integers: frozenset[str]
    assumed: tuple[Formula, ...]
    denials: tuple[Denial, ...]
    refutes: bool = True

    @property
    def bound(self) -> frozenset[str]:
        """The names that a denial binds."""
        return frozenset(
            name for denial in self.denials for name in (*denial.bound, *denial.chosen)
        )

    @property
    def quantified(self) -> bool:
        """Whether a denial binds variables."""
        return bool(self.bound)

    @property
    def beyond_routes(self) -> bool:
        """Whether it has one alternation of quantifiers more, or integers under a quantifier
        outside a range: only exported, no route asks.
        """
        return (
            any(denial.chosen for denial in self.denials)
            or self.part == "outside"
            and bool(self.integers)
        )

    def occurring(self) -> tuple[str, ...]:
        """The names of the variables that occur, in order."""
        formulas = [*self.assumed, *(denial.formula for denial in self.denials)]
        used = {i for formula in formulas for fact in trees.leaves(formula) for i in fact.used}
        return tuple(name for i, name in enumerate(self.names) if i in used)

    def matrix(self) -> Formula:
        """The whole question of a universal statement as one formula."""
        return join("and", [*self.assumed, *(denial.formula for denial in self.denials)])


def read_statement(text: str) -> checker.Statement:
    """The checker's statement of this text (one statement, as `Statement.text` writes it)."""
    (statement,) = checker.read_statements(text).values()
    return statement


def questions(
    statement: checker.Statement, earlier: Mapping[str, checker.Statement] | None = None
) -> list[VoteQuestion]:
    """The questions of a statement, in the order: `have` and `root` lines, then what is shown.

    A sharp range asks one question more than the statements it names ask inside it: outside, is
    there a parameter at which all of them hold?  Recurrences ask whether an identity fails.  Raises
    KeyError where `earlier` lacks a statement that a sharp range names.
    """
    if statement.kind == "sharp":
        return _sharp_questions(statement, earlier or {})
    if statement.kind == "iterates":
        return _iterate_questions(statement)
    return _universal_questions(statement, statement.name, None, "")


def _universal_questions(
    statement: checker.Statement, name: str, sharp: Sequence[ast.expr] | None, where: str
) -> list[VoteQuestion]:
    unfolding = unfolded(statement, sharp)
    own, universal = tuple(unfolding.context.index), set(unfolding.universal)
    free, integers = tuple(n for n in own if n in universal), frozenset(unfolding.integers)
    asked = []
    for number, (count, negation) in enumerate(unfolding.obligations, 1):
        asked.append(
            VoteQuestion(
                name,
                f"{where}obligation {number}",
                free,
                integers & universal,
                _premises(unfolding, own, free, count),
                (Denial((), formula_of(negation, own, free)),),
                refutes=False,
            )
        )
    denial = Denial(
        tuple(n for n in own if n not in universal), formula_of(unfolding.goal(False), own, own)
    )
    return [
        *asked,
        VoteQuestion(
            name, f"{where}goal", own, integers, _premises(unfolding, own, own), (denial,)
        ),
    ]


def _sharp_questions(
    statement: checker.Statement, earlier: Mapping[str, checker.Statement]
) -> list[VoteQuestion]:
    (named,), (over,), (domain,), (condition,) = (
        statement.get(keyword) for keyword in ("sharp", "over", "domain", "holds")
    )
    asked: list[VoteQuestion] = []
    for name in named:
        asked += _universal_questions(
            earlier[name], statement.name, [domain, condition], f"inside, {name}: "
        )
    return [
        *asked,
        _outside(statement.name, over, domain, condition, [earlier[name] for name in named]),
    ]


def _outside(
    name: str,
    over: Sequence[str],
    domain: ast.expr,
    condition: ast.expr,
    named: Sequence[checker.Statement],
) -> VoteQuestion:
    """Is there a parameter in the domain, but outside the range, at which all the named statements
    hold?
    """
    unfoldings = [checker.Unfolding(statement, checker.Context(), [domain]) for statement in named]
    names, integers = list[str](over), {p for p in over if p in unfoldings[0].integers}
    renamed = list[tuple[str, ...]]()
    # every denial binds its own variables; a name is shared unless it is an integer in one
    # statement only
    for unfolding in unfoldings:
        own = [
            (
                n
                if n in over or n not in names or (n in integers) == (n in unfolding.integers)
                else _fresh(n, {*names, *unfolding.context.index})
            )
            for n in unfolding.context.index
        ]
        names += [n for n in own if n not in names]
        integers |= {n for n, key in zip(own, unfolding.context.index) if key in unfolding.integers}
        renamed.append(tuple(own))
    context, order = checker.Context(), tuple(names)
    for parameter in over:
        context.declare(parameter)
    outside = [
        formula_of(f, tuple(over), order)
        for f in (context.formula(domain), checker.negate(context.formula(condition)))
    ]
    denials = []
    for unfolding, bound in zip(unfoldings, renamed):
        held = checker.join(
            "or", [checker.negate(checker.join("and", unfolding.premises)), unfolding.goal(True)]
        )
        of_all = {n for n, key in zip(bound, unfolding.context.index) if key in unfolding.universal}
        denials.append(
            Denial(
                tuple(n for n in bound if n in of_all and n not in over),
                formula_of(held, bound, order),
                tuple(n for n in bound if n not in of_all),
            )
        )
    return VoteQuestion(name, "outside", order, frozenset(integers), flat(outside), tuple(denials))


def _fresh(name: str, taken: set[str]) -> str:
    """The name with underscores until it is none of those taken."""
    while name in taken:
        name += "_"
    return name


def _iterate_questions(statement: checker.Statement) -> list[VoteQuestion]:
    (variables,), ((arguments, images),), ((count, powers),) = (
        statement.get(keyword) for keyword in ("forall", "iterates", "after")
    )
    images, powers = ([checker.parse(text) for text in terms] for terms in (images, powers))
    context = checker.Context()
    for name in variables:
        context.declare(name)
    values, (k,), names = dict(context.values), count, tuple(context.index)

    def image(trees: Sequence[ast.expr], changes: Mapping[str, checker.Poly]) -> list[checker.Poly]:
        inner = checker.Context(context, {**values, **changes})
        for name, tree in statement.get("let"):
            inner.define(name, inner.value(tree))
        return [inner.value(tree) for tree in trees]

    pairs = [
        *zip(image(powers, {k: context.number(0)}), (values[name] for name in arguments)),
        *zip(
            image(images, dict(zip(arguments, image(powers, {})))),
            image(powers, {k: context.value(checker.parse(k + " + 1"))}),
        ),
    ]
    fails = join(
        "or", [formula_of(context.atom(left, "!=", right), names, names) for left, right in pairs]
    )
    # the identities hold for all real K where they hold for all integers, so no variable need be an
    # integer here
    return [
        VoteQuestion(statement.name, "recurrence", names, frozenset(), (), (Denial((), fails),))
    ]


def _premises(
    unfolding: checker.Unfolding,
    own: tuple[str, ...],
    names: tuple[str, ...],
    count: int | None = None,
) -> tuple[Formula, ...]:
    return flat([formula_of(premise, own, names) for premise in unfolding.premises[:count]])


def changed(question: VoteQuestion, change: Callable[[Atom], Formula]) -> VoteQuestion:
    """The question with `change` applied to every atom."""
    return replace(
        question,
        assumed=flat([trees.mapped(formula, change, join) for formula in question.assumed]),
        denials=tuple(
            replace(d, formula=trees.mapped(d.formula, change, join)) for d in question.denials
        ),
    )


def scale_variables(question: VoteQuestion) -> tuple[str, ...]:
    """The positive variables that may be set to 1 without loss, because every fact is homogeneous
    in some grading of the variables; integers have weight 0, they keep their values.

    Formula: if every fact is homogeneous for the weights W_i of a grading, then x_i -> t^(W_i) x_i
    keeps all signs for every t > 0.  Source: the quotient of the positive torus by its action on
    the solutions (dimensional analysis).
    """
    ring = Ring(question.names, Ordering.lex)
    formulas = [*question.assumed, *(denial.formula for denial in question.denials)]
    polys = [fact.poly for formula in formulas for fact in trees.leaves(formula)]
    polys += [x + 1 for x, name in zip(ring.gens, question.names) if name in question.integers]
    positive = sorted(
        fact.used[0]
        for fact in question.assumed
        if isinstance(fact, Atom) and fact.relation == ">" and fact.poly in ring.gens
    )
    free = [i for i in positive if question.names[i] not in question.bound | question.integers]
    return tuple(question.names[i] for i in Scaling(ring, polys, free).scales) if free else ()


def with_scales_one(question: VoteQuestion, names: tuple[str, ...]) -> VoteQuestion:
    """The question with 1 in place of the named variables."""
    values = {question.names.index(name): 1 for name in names}
    return changed(question, lambda fact: atom(fact.poly.subs(values), fact.relation))


def flat(formulas: Sequence[Formula]) -> tuple[Formula, ...]:
    """The formulas with top-level conjunctions taken apart, each once."""
    return tuple(dict.fromkeys(part for formula in formulas for part in trees.conjuncts(formula)))


def formula_of(formula: checker.Formula, own: tuple[str, ...], names: tuple[str, ...]) -> Formula:
    """The checker's formula, whose variables are `own` in order, over the variables `names`."""
    return trees.mapped(formula, lambda one: atom(polynomial_of(one[1], own, names), one[2]), join)


def polynomial_of(poly: checker.Poly, own: tuple[str, ...], names: tuple[str, ...]) -> fmpz_mpoly:
    """The numerator of the checker's polynomial, whose variables are `own` in order, over the
    variables `names`.
    """
    ring, terms = ring_of(names), monomials(poly, len(own))
    if own != names:
        places = [own.index(name) if name in own else None for name in names]
        terms = {tuple(0 if k is None else m[k] for k in places): c for m, c in terms.items()}
    return ring.from_dict({m or (0,): c for m, c in terms.items()})


def ring_of(names: tuple[str, ...]) -> fmpz_mpoly_ctx:
    """The integer polynomials in these variables, written from the largest exponents down."""
    return fmpz_mpoly_ctx.get(names or ("none",), Ordering.lex)
