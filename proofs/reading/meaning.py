"""The meaning of a tree in an environment: brackets, sets, operators and relations, on top of
arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable

from certificates.terms import Formula, conjunction, implies
from proofs.reading import tree as t
from proofs.reading.errors import PrintError
from proofs.reading.evaluation import Evaluation, Value
from proofs.reading.notions import (
    ExtremalValue,
    LimitValue,
    Piece,
    Piecewise,
    Region,
    Restricted,
    Rounded,
    applied,
)
from proofs.reading.relations import relate
from proofs.reading.tree import HOLE, Tree, spelled
from proofs.reading.values import Matrix, Vector, is_scalar


class Meaning(Evaluation):
    """The meaning of every kind of node."""

    # brackets, matrices, sets
    # -----------------------------------------------------------------------------------------

    def group(self, tree: t.Group) -> Value:
        if tree.bracket in (r"\lfloor", r"\lceil"):
            return self._with_hole(
                t.Group(tree.bracket, (HOLE,)),
                tree,
                *tree.items,
                default=lambda value: Rounded(tree.bracket, value),
            )
        if len(tree.items) == 1:
            return self.of(tree.items[0])
        entries = tuple(self._entry(item) for item in tree.items)
        return Matrix((entries,)) if tree.bracket == "[" else Vector(entries)

    def _entry(self, tree: Tree) -> Value:
        value = self.here(tree)
        if not is_scalar(value):
            raise PrintError(tree.at, "an entry of a vector or matrix that is not a scalar")
        return value

    def array(self, tree: t.Array) -> Value:
        rows = tuple(tuple(self._entry(entry) for entry in row) for row in tree.rows)
        return Matrix(rows) if len(rows[0]) > 1 else Vector(tuple(row[0] for row in rows))

    def component(self, tree: t.Component) -> Value:
        value, index = self.here(tree.content), self.here(tree.index)
        if not isinstance(value, Vector) or not isinstance(index, int):
            raise PrintError(
                tree.at, "a component of something that is not a vector, or not numbered"
            )
        return value.component(index)

    def _with_hole(
        self,
        key: Tree,
        tree: Tree,
        *arguments: Tree,
        default: Callable[[Value], Value] | None = None,
    ) -> Value:
        call = self.meanings.get(key, default)
        if call is None:
            raise self._without_meaning(tree)
        return applied(call, *map(self.here, arguments))

    def root(self, tree: t.Root) -> Value:
        return self._with_hole(t.Root(HOLE), tree, tree.radicand)

    def absolute(self, tree: t.Absolute) -> Value:
        return self._with_hole(t.Absolute(HOLE), tree, tree.content)

    def set_builder(self, tree: t.SetBuilder) -> Value:
        base: Region | None = None
        element = tree.element
        if isinstance(element, t.Chain) and len(element.rest) == 1 and element.rest[0][0] == r"\in":
            base = self._region(element.rest[0][1])
            element = element.first
        if element not in self.environment.points:
            raise PrintError(
                element.at,
                f"{spelled(element)} is not a point whose components the environment names",
            )
        environment = self.environment

        def holds(state: Vector) -> Formula:
            inside = Meaning(environment.at(element, state))
            return conjunction(
                ([base(state)] if base else [])
                + [inside.formula(condition) for condition in tree.conditions]
            )

        return Region(holds)

    # functions, operators, relations
    # ----------------------------------------------------------------------------------

    def operator(self, tree: t.Operator) -> Value:
        family = self.meanings.get(t.Operator(tree.sign, tree.subscripts, HOLE))
        if family is not None:
            return applied(family, self.of(tree.operand))
        family = (
            self.meanings.get(t.Operator(tree.sign, (HOLE,) * len(tree.subscripts), HOLE))
            if tree.subscripts
            else None
        )
        if family is None:
            raise self._without_meaning(tree)
        return applied(family, *map(self.here, tree.subscripts), self.of(tree.operand))

    def derivative(self, tree: t.Derivative) -> Value:
        call = self.meanings.get(t.Derivative(HOLE, HOLE))
        if call is None:
            raise self._without_meaning(tree)
        return applied(call, self.of(tree.of), self.here(tree.by))

    def limit(self, tree: t.Limit) -> Value:
        condition = tree.condition
        if not isinstance(condition, t.Chain) or [sign for sign, _ in condition.rest] != [
            r"\rightarrow"
        ]:
            raise PrintError(condition.at, r"the condition of a limit is written k \to \infty")
        value = LimitValue(
            spelled(condition.first), spelled(condition.rest[0][1]), self.here(tree.body)
        )
        call = self.meanings.get(t.Limit(HOLE, HOLE))
        return value if call is None else applied(call, value)

    def extremum(self, tree: t.Extremum) -> Value:
        condition = None if tree.condition is None else self.formula(tree.condition)
        value = ExtremalValue(tree.sign, condition, self.here(tree.body))
        call = self.meanings.get(t.Extremum(tree.sign, HOLE, HOLE))
        return value if call is None else applied(call, value)

    def restriction(self, tree: t.Restriction) -> Value:
        function = self.of(tree.function)
        region = self._region(tree.region)
        if not callable(function) or isinstance(function, Region):
            raise PrintError(
                tree.at, f"a restriction of {spelled(tree.function)}, which is not a function"
            )
        if isinstance(function, Restricted):
            return Restricted(function.function, function.region & region)
        return Restricted(function, region)

    def cases(self, tree: t.Cases) -> Value:
        return Piecewise(tuple(self._piece(value, condition) for value, condition in tree.pieces))

    def _piece(self, value: Tree, condition: Tree) -> Piece:
        when = self.formula(condition)
        if not isinstance(value, t.Chain):
            return Piece(self.side(value), when)
        return Piece(self.side(value.first), when, self.chain(value))

    def chain(self, tree: t.Chain) -> Formula:
        state = self.environment.state
        return conjunction(
            [relate(left, sign, right, state) for left, sign, right in self.triples(tree)]
        )

    def for_all(self, tree: t.ForAll) -> Formula:
        return implies(self.formula(tree.head), self.formula(tree.body))


Meaning.rules = {
    t.Number: Meaning.number,
    t.Name: Meaning.name,
    t.Mark: Meaning.mark,
    t.Power: Meaning.power,
    t.Negative: Meaning.negative,
    t.Quotient: Meaning.quotient,
    t.Binary: Meaning.binary,
    t.Juxtaposition: Meaning.juxtaposition,
    t.Group: Meaning.group,
    t.Array: Meaning.array,
    t.Component: Meaning.component,
    t.Root: Meaning.root,
    t.Absolute: Meaning.absolute,
    t.SetBuilder: Meaning.set_builder,
    t.Operator: Meaning.operator,
    t.Derivative: Meaning.derivative,
    t.Limit: Meaning.limit,
    t.Extremum: Meaning.extremum,
    t.Restriction: Meaning.restriction,
    t.Cases: Meaning.cases,
    t.Chain: Meaning.chain,
    t.ForAll: Meaning.for_all,
}
