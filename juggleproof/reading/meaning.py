"""The meaning of a print in an environment, and the print as a claim receives it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from juggleproof.reading import tree as t
from juggleproof.reading.evaluation import Environment, Evaluation, relate
from juggleproof.reading.lexer import PrintError
from juggleproof.reading.parser import parse, parse_name
from juggleproof.reading.tree import HOLE, Tree, spelled
from juggleproof.reading.values import (
    ExtremalValue,
    LimitValue,
    Matrix,
    Piece,
    Piecewise,
    Region,
    Restricted,
    Rounded,
    Scalar,
    Value,
    Vector,
    applied,
    is_scalar,
)
from juggleproof.statements.language import Formula, Term, conjunction, implies, term

# -------------------------------------------------------------------------------------------------
# The meaning of a tree in an environment: brackets, sets, operators and relations, on top of
# arithmetic.


class Meaning(Evaluation):
    """The meaning of every kind of node."""

    # brackets, matrices, sets
    # -----------------------------------------------------------------------------------------

    def group(self, tree: t.Group) -> Value:
        """The content of a bracket: a value, a vector or row of values, or a rounded number."""
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

    def _entry(self, tree: Tree) -> Scalar:
        value = self.here(tree)
        if is_scalar(value):
            return value
        raise PrintError(tree.at, "an entry of a vector or matrix that is not a scalar")

    def array(self, tree: t.Array) -> Value:
        """A matrix, or a vector where it has one column."""
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
        """The region {b in base | conditions}, of states whose components the environment names."""
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
        r"""The meaning of an operator, such as D_{\cdot} \cdot, at its operand."""
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
        """A limit as a value of its own, or the meaning that the environment gives to it."""
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

    def extremum(self, tree: t.PrintedExtremum) -> Value:
        """An extremum as a value of its own, or the meaning that the environment gives to it."""
        condition = None if tree.condition is None else self.formula(tree.condition)
        value = ExtremalValue(tree.sign, condition, self.here(tree.body))
        call = self.meanings.get(t.PrintedExtremum(tree.sign, HOLE, HOLE))
        return value if call is None else applied(call, value)

    def restriction(self, tree: t.Restriction) -> Value:
        """A function on a region only; a second restriction intersects the regions."""
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
        """The conjunction of the relations in the chain, each between the values beside it."""
        state = self.environment.state
        return conjunction(
            [relate(left, sign, right, state) for left, sign, right in self.triples(tree)]
        )

    def for_all(self, tree: t.ForAll) -> Formula:
        return implies(self.formula(tree.head), self.formula(tree.body))


Meaning.rules = {
    t.Number: Meaning.number,
    t.Name: Meaning.name,
    t.Sign: Meaning.sign,
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
    t.PrintedExtremum: Meaning.extremum,
    t.Restriction: Meaning.restriction,
    t.Cases: Meaning.cases,
    t.Chain: Meaning.chain,
    t.ForAll: Meaning.for_all,
}


# -------------------------------------------------------------------------------------------------
# A print as a claim receives it: its LaTeX, its tree, and its meaning in an environment.


class Printed:
    r"""The reading of one display, or of one part of it.

    >>> from juggleproof.statements.language import reals
    >>> alpha, v, r = reals("alpha v r")
    >>> names = Environment({r"\alpha": alpha, r"\dot{\overline\beta}": v, r"\dot\rho_0": r})
    >>> gain = Printed(r"\dot{\overline{\beta}} = \frac{1+\alpha}{1-\alpha} \dot\rho_0 \tag{33}")
    >>> str(gain.formula(names))
    'v = (1 + alpha)/(1 - alpha)*r'
    >>> Printed(r"\dot\beta = \dot\rho_0").formula(names)
    Traceback (most recent call last):
    juggleproof.reading.lexer.PrintError: column 1: \dot{\beta} has no meaning here
    """

    __slots__ = ("latex", "_parts")

    def __init__(self, latex: str, parts: tuple[Tree, ...] | None = None) -> None:
        self.latex = latex
        self._parts = parse(latex) if parts is None else parts

    def __repr__(self) -> str:
        return f"Printed({self.latex!r})"

    @property
    def parts(self) -> tuple[Printed, ...]:
        """The parts of a display of several lines, each as a print; columns in errors are those of
        the whole display.
        """
        return tuple(Printed(self.latex, (part,)) for part in self._parts)

    @property
    def tree(self) -> Tree:
        """The tree of a display of one part."""
        if len(self._parts) != 1:
            raise PrintError(
                self._parts[1].at, f"this print has {len(self._parts)} parts; take them from .parts"
            )
        return self._parts[0]

    @property
    def names(self) -> tuple[str, ...]:
        """The names that occur, as LaTeX, in order of first appearance."""
        return tuple(
            dict.fromkeys(spelled(name) for part in self._parts for name in _names_in(part))
        )

    def relation_chain(self, environment: Environment) -> list[tuple[Value, str, Value]]:
        """(left value, relation sign, right value) for each relation of the chain, in order."""
        chain = self._chain()
        return [
            (_as_term(a), sign, _as_term(b)) for a, sign, b in Meaning(environment).triples(chain)
        ]

    def left(self, environment: Environment) -> Value:
        """The value of the expression before the first relation."""
        return self.relation_chain(environment)[0][0]

    def right(self, environment: Environment) -> Value:
        """The value of the expression after the last relation."""
        return self.relation_chain(environment)[-1][2]

    def definition(self, environment: Environment, of: str) -> Value:
        """The value that the print gives to the expression `of`, which must stand before its only
        relation, := or =.
        """
        chain = self._chain()
        if chain.first != parse_name(of):
            raise PrintError(
                chain.first.at, f"{spelled(chain.first)} stands here, where {of} was expected"
            )
        if len(chain.rest) != 1 or chain.rest[0][0] not in (":=", "=", r"\equiv"):
            raise PrintError(chain.at, "a definition is one expression, one :=, one value")
        return _as_term(Meaning(environment).side(chain.rest[0][1]))

    def value(self, environment: Environment) -> Value:
        """The value of a print that is a single expression, without a relation."""
        if isinstance(self.tree, (t.Chain, t.ForAll)):
            raise PrintError(
                self.tree.at,
                "this is a relation, not one value; take .left, .right or .relation_chain",
            )
        return _as_term(Meaning(environment).side(self.tree))

    def formula(self, environment: Environment) -> Formula:
        """The conjunction of all relations in all parts of the print."""
        meaning = Meaning(environment)
        return conjunction([meaning.formula(part) for part in self._parts])

    def set_predicate(self, environment: Environment, of: str | None = None) -> Region:
        """The region that the print defines: state -> formula.

        The head must be the name `of`, or, where that is None, a name of the environment.  Base
        set, element and condition all enter the formula; the print may contain nothing else.
        """
        chain = self._chain()
        if len(chain.rest) != 1 or chain.rest[0][0] not in (":=", "="):
            raise PrintError(chain.at, "a definition of a region is one name, one :=, one set")
        if of is None:
            Meaning(environment).of(chain.first)
        elif chain.first != parse_name(of):
            raise PrintError(
                chain.first.at, f"{spelled(chain.first)} is defined here, where {of} was expected"
            )
        meaning, right = Meaning(environment), chain.rest[0][1]
        region = meaning.of(right)
        if not isinstance(region, Region):
            raise PrintError(right.at, "this is not a region")
        for (
            point,
            components,
        ) in environment.points.items():  # refuse now, not when the region is first used
            state = environment.meanings.get(point)
            if isinstance(state, Vector) and len(components) > 1:
                region(state)
        return region

    def _chain(self) -> t.Chain:
        tree = self.tree
        if not isinstance(tree, t.Chain):
            raise PrintError(tree.at, "this states nothing: a relation is expected")
        return tree


def read(latex: str) -> Printed:
    """The reading of a print."""
    return Printed(latex)


def _as_term(value: Value) -> Value:
    return term(value) if is_scalar(value) and not isinstance(value, Term) else value


def _names_in(tree: object) -> Iterator[Tree]:
    if isinstance(tree, t.Name):
        yield tree
    elif isinstance(tree, tuple):
        for item in tree:
            yield from _names_in(item)
    elif isinstance(tree, Tree):
        for field in tree.__dataclass_fields__:
            yield from _names_in(getattr(tree, field))
