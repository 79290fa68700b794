"""A statement as the questions that decide it: polynomials only, with the denominators cleared by
the checker's own unfolding.

A question is a formula "assumed, and for all bound variables denied"; the statement holds if and
only if no question has a solution.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from certificates import checker
from certificates.routes.polynomials import Formula, Polynomial, atom, atoms, conjuncts, join
from certificates.search.stories import unfolded

TRUSTED: Any = checker  # the trusted file carries no annotations


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
class Question:
    """Is there a point that meets all of `assumed` and every denial?  `part` says of which line of
    the statement this is the denial.

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
        outside a range: only exported, no route asks."""
        return (
            any(denial.chosen for denial in self.denials)
            or self.part == "outside"
            and bool(self.integers)
        )

    def occurring(self) -> tuple[str, ...]:
        """The names of the variables that occur, in order."""
        formulas = [*self.assumed, *(denial.formula for denial in self.denials)]
        used = {i for formula in formulas for fact in atoms(formula) for i in fact.poly.used}
        return tuple(name for i, name in enumerate(self.names) if i in used)

    def matrix(self) -> Formula:
        """The whole question of a universal statement as one formula."""
        return join("and", [*self.assumed, *(denial.formula for denial in self.denials)])


def read_statement(text: str) -> Any:
    """The checker's statement of this text (one statement, as `Statement.text` writes it)."""
    (statement,) = TRUSTED.read_statements(text).values()
    return statement


def questions(statement: Any, earlier: Mapping[str, Any] | None = None) -> list[Question]:
    """The questions of a statement, in the order: `have` and `root` lines, then what is shown.

    A sharp range asks one question more than the statements it names ask inside it: outside, is
    there a parameter at which all of them hold?  Recurrences ask whether an identity fails.
    """
    if statement.kind == "sharp":
        return _sharp_questions(statement, earlier or {})
    if statement.kind == "iterates":
        return _iterate_questions(statement)
    return _universal_questions(statement, statement.name, None, "")


def _universal_questions(
    statement: Any, name: str, sharp: Sequence[Any] | None, where: str
) -> list[Question]:
    story: Any = unfolded(statement, sharp if sharp is None else list(sharp))
    own, universal = tuple(story.context.index), set(story.universal)
    free, integers = tuple(n for n in own if n in universal), frozenset(story.integers)
    asked = []
    for number, (count, negation) in enumerate(story.obligations, 1):
        asked.append(
            Question(
                name,
                f"{where}obligation {number}",
                free,
                integers & universal,
                _premises(story, own, free, count),
                (Denial((), formula_of(negation, own, free)),),
                refutes=False,
            )
        )
    denial = Denial(
        tuple(n for n in own if n not in universal), formula_of(story.goal(False), own, own)
    )
    return [
        *asked,
        Question(name, f"{where}goal", own, integers, _premises(story, own, own), (denial,)),
    ]


def _sharp_questions(statement: Any, earlier: Mapping[str, Any]) -> list[Question]:
    (named,), (over,), (domain,), (condition,) = (
        statement.get(keyword) for keyword in ("sharp", "over", "domain", "holds")
    )
    asked: list[Question] = []
    for name in named:
        asked += _universal_questions(
            earlier[name], statement.name, [domain, condition], f"inside, {name}: "
        )
    return [
        *asked,
        _outside(statement.name, over, domain, condition, [earlier[name] for name in named]),
    ]


def _outside(
    name: str, over: Sequence[str], domain: Any, condition: Any, named: Sequence[Any]
) -> Question:
    """Is there a parameter in the domain, but outside the range, at which all the named statements
    hold?"""
    stories = [TRUSTED.Unfolding(statement, TRUSTED.Context(), [domain]) for statement in named]
    names, integers = list[str](over), {p for p in over if p in stories[0].integers}
    renamed = list[tuple[str, ...]]()
    # every denial binds its own variables; a name is shared unless it is an integer in one
    # statement only
    for story in stories:
        own = [
            (
                n
                if n in over or n not in names or (n in integers) == (n in story.integers)
                else _fresh(n, {*names, *story.context.index})
            )
            for n in story.context.index
        ]
        names += [n for n in own if n not in names]
        integers |= {n for n, key in zip(own, story.context.index) if key in story.integers}
        renamed.append(tuple(own))
    context, order = TRUSTED.Context(), tuple(names)
    for parameter in over:
        context.declare(parameter)
    outside = [
        formula_of(f, tuple(over), order)
        for f in (context.formula(domain), TRUSTED.negate(context.formula(condition)))
    ]
    denials = []
    for story, bound in zip(stories, renamed):
        held = TRUSTED.join(
            "or", [TRUSTED.negate(TRUSTED.join("and", story.premises)), story.goal(True)]
        )
        of_all = {n for n, key in zip(bound, story.context.index) if key in story.universal}
        denials.append(
            Denial(
                tuple(n for n in bound if n in of_all and n not in over),
                formula_of(held, bound, order),
                tuple(n for n in bound if n not in of_all),
            )
        )
    return Question(name, "outside", order, frozenset(integers), flat(outside), tuple(denials))


def _fresh(name: str, taken: set[str]) -> str:
    """The name with underscores until it is none of those taken."""
    while name in taken:
        name += "_"
    return name


def _iterate_questions(statement: Any) -> list[Question]:
    (variables,), ((arguments, images),), ((count, powers),) = (
        statement.get(keyword) for keyword in ("forall", "iterates", "after")
    )
    images, powers = ([TRUSTED.parse(text) for text in terms] for terms in (images, powers))
    context = TRUSTED.Context()
    for name in variables:
        context.declare(name)
    plain, (k,), names = dict(context.values), count, tuple(context.index)

    def image(trees: Sequence[Any], changes: Mapping[str, Any]) -> list[Any]:
        inner = TRUSTED.Context(context, {**plain, **changes})
        for name, tree in statement.get("let"):
            inner.define(name, inner.value(tree))
        return [inner.value(tree) for tree in trees]

    pairs = [
        *zip(image(powers, {k: context.number(0)}), (plain[name] for name in arguments)),
        *zip(
            image(images, dict(zip(arguments, image(powers, {})))),
            image(powers, {k: context.value(TRUSTED.parse(k + " + 1"))}),
        ),
    ]
    fails = join(
        "or", [formula_of(context.atom(left, "!=", right), names, names) for left, right in pairs]
    )
    # the identities hold for all real K where they hold for all integers, so no variable need be an
    # integer here
    return [Question(statement.name, "recurrence", names, frozenset(), (), (Denial((), fails),))]


def _premises(
    story: Any, own: tuple[str, ...], names: tuple[str, ...], count: int | None = None
) -> tuple[Formula, ...]:
    return flat([formula_of(premise, own, names) for premise in story.premises[:count]])


def flat(formulas: Sequence[Formula]) -> tuple[Formula, ...]:
    """The formulas with top-level conjunctions taken apart, each once."""
    return tuple(dict.fromkeys(part for formula in formulas for part in conjuncts(formula)))


def formula_of(formula: Any, own: tuple[str, ...], names: tuple[str, ...]) -> Formula:
    """The checker's formula, whose variables are `own` in order, over the variables `names`."""
    if isinstance(formula, bool):
        return formula
    if formula[0] == "atom":
        return atom(polynomial_of(formula[1], own, names), formula[2])
    return join(formula[0], [formula_of(part, own, names) for part in formula[1]])


def polynomial_of(poly: Any, own: tuple[str, ...], names: tuple[str, ...]) -> Polynomial:
    """The checker's polynomial, unpacked: 16 bits for each variable."""
    bits, terms = TRUSTED.BITS, dict[tuple[int, ...], int]()
    for packed, c in poly.terms.items():
        powers = {name: packed >> (bits * i) & ((1 << bits) - 1) for i, name in enumerate(own)}
        terms[tuple(powers.get(name, 0) for name in names)] = c
    return Polynomial.of(names, terms, poly.den)
