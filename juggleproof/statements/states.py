"""States of a search: the assumptions on one branch, and the branches below it."""

from __future__ import annotations

import ast
from collections.abc import Collection, Mapping, Sequence
from functools import reduce
from operator import or_

from juggleproof.certificates import checker
from juggleproof.statements.nodes import Node, Values

Known = Mapping[str, checker.Statement]


class SearchState:
    """The assumptions on one branch of a search: facts (polynomial, relation), which all hold, and
    disjunctions, which are still to be split.

    Its context has the variables of another context, the licences that the assumptions give, and a
    meter of its own, so that no branch spends the work of another.

    >>> context = checker.Context()
    >>> context.declare("x")
    >>> formula = checker.parse("x > 1 and (x < 2 or x = 3)")
    >>> state = SearchState(context).assume(context.formula(formula))
    >>> len(state.facts), len(state.choices), state.closed
    (1, 1, False)
    >>> [len(case.facts) for case in state.by_sign("x - 2")]
    [2, 2, 2]
    """

    def __init__(self, variables: checker.Context, parent: SearchState | None = None) -> None:
        work = checker.Work()
        values = {key: checker.variable(place, work) for key, place in variables.index.items()}
        self.context = checker.Context(None, values, work)
        self.context.index.update(variables.index)
        self.context.integers.update(variables.integers)
        self.facts: list[tuple[checker.Poly, str]] = []
        self.choices: list[list[checker.Atom | checker.Join]] = []
        self.closed = False  # whether something false is assumed
        if parent is not None:
            self.context.licensed.update(parent.context.licensed)
            self.facts += parent.facts
            self.choices += parent.choices
            self.closed = parent.closed

    @property
    def formulas(self) -> list[checker.Formula]:
        """The assumptions: False where the state is closed, then the facts and the disjunctions."""
        facts: list[checker.Formula] = [("atom", poly, relation) for poly, relation in self.facts]
        choices: list[checker.Formula] = [("or", list(one)) for one in self.choices]
        return [*[False] * self.closed, *facts, *choices]

    def assume(self, formula: checker.Formula) -> SearchState:
        """This state itself, after one more formula is assumed."""
        for part in checker.conjuncts(formula):
            if isinstance(part, bool):
                self.closed = self.closed or not part
            elif part[0] == "atom":
                self.facts.append(part[1:])
                self.context.license(part)
            else:
                self.choices.append(part[1])
        return self

    def branch(
        self, formula: checker.Formula = True, variables: checker.Context | None = None
    ) -> SearchState:
        """A new state that assumes one more formula; `variables` is a context with more variables,
        if there are more.
        """
        return SearchState(variables or self.context, self).assume(formula)

    def by_sign(self, text: str) -> list[SearchState]:
        """The three states in which the polynomial is < 0, = 0 and > 0.

        Raises Rejected where the text is no polynomial in the variables.
        """
        poly = self.context.polynomial(text)
        cases = ((-poly, ">"), (poly, "="), (poly, ">"))
        return [self.branch(checker.fold(*case)) for case in cases]

    def adjoin(self, name: str, text: str, low: str, high: str) -> None:
        """Adds a variable between low and high at which the polynomial is 0.

        Raises Rejected where the name is taken, or a text is not a term.
        """
        context = self.context
        ends = [context.value(checker.parse(end)) for end in (low, high)]
        context.declare(name)
        root = context.values[name]
        self.assume(context.atom(root, ">=", ends[0]))
        self.assume(context.atom(root, "<=", ends[1]))
        self.assume(context.atom(context.value(checker.parse(text)), "=", context.number(0)))

    def is_closed_by(self, node: Node, known: Mapping[str, checker.Statement]) -> bool:
        """Whether the checker accepts that the node closes this state."""
        return closes(self.context, self.formulas, node, known)

    def is_served_by(
        self,
        values: Values,
        known: Mapping[str, checker.Statement],
        purpose: str,
        statement: checker.Statement,
        base: Collection[str] = (),
        sharp: Sequence[ast.expr] | None = None,
    ) -> bool:
        """Whether the checker accepts the values in this state, as a "point", a "witness" or a
        "counterexample"; `base` has the variables of the statement that keep the value they have in
        this state.
        """
        assumed = self.context, self.formulas
        return finds(*assumed, values, known, purpose, statement, base, sharp)


def variables_in(context: checker.Context, poly: checker.Poly) -> list[str]:
    """The variables that occur in the polynomial, in order: the same as the checker's function
    finds, at less cost.
    """
    together = reduce(or_, poly.terms, 0)
    mask = (1 << checker.BITS) - 1
    return [
        name for name, place in context.index.items() if together >> (checker.BITS * place) & mask
    ]


def state_of(unfolding: checker.Unfolding, count: int | None = None) -> SearchState:
    """The state that assumes the premises of an unfolding, or the first `count` of them."""
    return SearchState(unfolding.context).assume(checker.join("and", unfolding.premises[:count]))


# -------------------------------------------------------------------------------------------------
# Whether the checker accepts a part of a certificate, on a meter of its own.


def closes(
    context: checker.Context, formulas: Sequence[checker.Formula], node: object, known: Known
) -> bool:
    """Whether the node closes the state that assumes the formulas over the variables of a
    context.
    """
    return not checker.verdict(checker.close, _assuming(context, formulas), node, known)[1]


def finds(
    context: checker.Context,
    formulas: Sequence[checker.Formula],
    values: object,
    known: Known,
    purpose: str,
    statement: checker.Statement,
    base: Collection[str] = (),
    sharp: Sequence[ast.expr] | None = None,
) -> bool:
    """Whether values serve their purpose in the state that assumes the formulas over the variables
    of a context; `base` has the variables of the statement that are also variables of the state.
    """
    state = _assuming(context, formulas)
    own = {name: state.context.values[name] for name in base}
    named = {statement.name: statement}
    return not checker.verdict(checker.find, state, values, known, purpose, named, own, sharp)[1]


def proves(
    statement: checker.Statement,
    proof: object,
    known: Known,
    sharp: Sequence[ast.expr] | None = None,
) -> bool:
    """Whether the checker accepts the proof of a whole statement, or inside a sharp range."""
    return not checker.verdict(checker.prove, statement, proof, known, sharp)[1]


def _assuming(context: checker.Context, formulas: Sequence[checker.Formula]) -> checker.State:
    work = checker.Work()
    variables = checker.Context(work=work)
    for key in context.index:
        variables.declare(key, key in context.integers)
    state = checker.State(variables)
    for formula in formulas:
        state.assume(formula if isinstance(formula, bool) else _on_meter(formula, work))
    return state


def _on_meter(
    formula: checker.Atom | checker.Join, work: checker.Work
) -> checker.Atom | checker.Join:
    """The same formula, whose polynomials spend from this meter."""
    if formula[0] == "atom":
        _, poly, relation = formula
        return ("atom", checker.Poly(poly.terms, poly.den, poly.deg, poly.bits, work), relation)
    return (formula[0], [_on_meter(part, work) for part in formula[1]])
