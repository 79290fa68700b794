"""The environment, which gives meanings to the names of a print, and the values of terms and
relations in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache, reduce
from typing import ClassVar

from juggleproof.reading import tree as t
from juggleproof.reading.lexer import PrintError
from juggleproof.reading.parser import parse_name
from juggleproof.reading.tree import HOLE, Name, Tree, spelled
from juggleproof.reading.values import (
    Guarded,
    Image,
    Matrix,
    Piecewise,
    Region,
    Restricted,
    Rounded,
    Scalar,
    ShapeError,
    StateFunction,
    Value,
    Vector,
    add,
    applied,
    is_scalar,
    kind_of,
    multiply,
    negate,
    over,
    raised,
    scalar,
    subtract,
    union,
)
from juggleproof.statements.language import (
    ClaimError,
    Formula,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    implies,
    term,
)

# -------------------------------------------------------------------------------------------------
# The meanings of the names of a print: the keys are LaTeX, in which \cdot stands for an argument.
#
#     Environment(
#         {r"\alpha": alpha, r"\dot\rho_0": r, r"\overline\beta": beta, r"\dot{\overline\beta}": v,
#          r"A_{\cdot}": lambda t: Matrix(((1, t), (0, 1))),  # A_T, A_{-\xi_1}: a family
#          r"F^{\cdot}": flow,  # F^t is flow(t), a function of states
#          r"E": StateFunction(energy), r"\mathcal{B}_1": Region(in_B1),
#          r"\sqrt{\cdot}": adjoin_root, r"\Delta_1 E": StateFunction(gain)},
#         points={r"\overline b": (r"\overline\beta", r"\dot{\overline\beta}")},
#         state=r"\overline b",
#     )
#
# `points` says which names are the components of a state, so that a set {b | ..} can be evaluated
# at any state; `state` is the present one, which is the argument where a print leaves that of a
# function out. A key may be any expression (`\Delta E_{max}`, `\sqrt{2(1+\alpha)}`, `E(t)`): an
# equal part of the print has the key's value, whatever the values of its own parts are.

_key = lru_cache(maxsize=4096)(parse_name)


class Environment:
    """The meanings of names and of other expressions."""

    __slots__ = ("meanings", "kinds", "points", "state")

    def __init__(
        self,
        names: Mapping[str, Value],
        *,
        points: Mapping[str, Sequence[str]] | None = None,
        state: str | None = None,
    ) -> None:
        self.meanings: dict[Tree, Value] = {
            _key(latex): _exact(latex, value) for latex, value in names.items()
        }
        self.points = {
            _key(point): tuple(map(_key, names)) for point, names in (points or {}).items()
        }
        for point, components in self.points.items():
            if point not in self.meanings and all(name in self.meanings for name in components):
                self.meanings[point] = Vector(
                    tuple(scalar(self.meanings[name]) for name in components)
                )
        self.state: Vector | None = None
        if state is not None:
            meaning = self.meanings.get(_key(state))
            if not isinstance(meaning, Vector):
                raise ClaimError(
                    f"the state {state} has no meaning as a vector in its own environment"
                )
            self.state = meaning
        self.kinds = frozenset(type(tree) for tree in self.meanings) - {Name}

    def extended(self, names: Mapping[str, Value]) -> Environment:
        """This environment with more names, or other meanings of them."""
        return self._with(
            {_key(latex): _exact(latex, value) for latex, value in names.items()}, self.state
        )

    def meaning_of(self, latex: str) -> Value:
        """The value of this key."""
        if _key(latex) not in self.meanings:
            raise ClaimError(f"{latex} is no key of this environment")
        return self.meanings[_key(latex)]

    def at(self, point: Tree, state: Vector) -> Environment:
        """This environment with `state` as the value of the point, and of its components, and as
        the present state.
        """
        components = self.points.get(point)
        if components is None or len(components) != len(state.entries):
            raise ClaimError("the environment names no such components of a state")
        return self._with(
            {point: state, **dict(zip(components, state.entries, strict=True))}, state
        )

    def _with(self, meanings: Mapping[Tree, Value], state: Vector | None) -> Environment:
        other = object.__new__(Environment)
        other.meanings = {**self.meanings, **meanings}
        other.points, other.state = self.points, state
        other.kinds = self.kinds | {type(tree) for tree in meanings} - {Name}
        return other


def _exact(latex: str, value: Value) -> Value:
    if isinstance(value, (float, complex)):
        raise ClaimError(
            f"{latex} is given the float {value!r}; only exact numbers and terms have a meaning"
        )
    return value


# -------------------------------------------------------------------------------------------------
# The evaluation of names, sums and products, which also decides whether a juxtaposition is a
# product or an application.
#
# A factor that is a function is applied to the bracket that follows it; everything else is a
# product. A `StateFunction` may be marked as a factor before a scalar, so that \tau_c(\overline b)
# and \tau_c(\dot{\overline\beta} - \dot\rho_0) both say what the paper says.


class Evaluation:
    """The evaluation of trees in one environment: the common methods, and arithmetic.

    `rules` has the method for each kind of node, which returns the value of the node.
    """

    rules: ClassVar[dict[type[Tree], Callable[..., Value]]] = {}

    def __init__(self, environment: Environment) -> None:
        self.environment = environment
        self.meanings = environment.meanings

    def of(self, tree: Tree) -> Value:
        """The value of a tree; a function stays a function."""
        kind = type(tree)
        if kind in self.environment.kinds:
            value = self.meanings.get(tree)
            if value is not None:
                return value
        try:
            return self.rules[kind](self, tree)
        except PrintError:
            raise
        except ClaimError as problem:
            raise PrintError(tree.at, str(problem)) from problem

    def here(self, tree: Tree) -> Value:
        """The value of a tree, where a function without argument is taken at the present state."""
        return self.at_state(self.of(tree), tree)

    def at_state(self, value: Value, tree: Tree) -> Value:
        """The value itself, or a function's value at the present state."""
        if not callable(value) or isinstance(value, Region):
            return value
        if self.environment.state is None:
            raise PrintError(
                tree.at,
                f"{spelled(tree)} stands without its argument, and the environment has no state",
            )
        return self.at_state(applied(value, self.environment.state), tree)

    def triples(self, chain: t.Chain) -> list[tuple[Value, str, Value]]:
        """Each relation of a chain with the values on its two sides."""
        values = [self.side(chain.first), *(self.side(tree) for _, tree in chain.rest)]
        return [(values[i], sign, values[i + 1]) for i, (sign, _) in enumerate(chain.rest)]

    def formula(self, tree: Tree) -> Formula:
        """The formula that a chain or quantified chain states."""
        value = self.of(tree)
        if not isinstance(value, Formula):
            raise PrintError(tree.at, "this states nothing: a relation is expected")
        return value

    def side(self, tree: Tree) -> Value:
        """The value of a side of a relation: at the present state, if there is one."""
        value = self.of(tree)
        return value if self.environment.state is None else self.at_state(value, tree)

    # names, and the places of arguments
    # -------------------------------------------------------------------------------

    def _without_meaning(self, tree: Tree) -> PrintError:
        return PrintError(tree.at, f"{spelled(tree)} has no meaning here")

    def name(self, tree: t.Name) -> Value:
        r"""The meaning of the name, or of its family, such as A_{\cdot}, at its subscripts."""
        value = self.meanings.get(tree)
        if value is not None:
            return value
        if tree.subscripts:
            family = self.meanings.get(
                t.Name(tree.base, tree.accents, (HOLE,) * len(tree.subscripts), tree.primes)
            )
            if family is not None:
                return applied(family, *map(self.here, tree.subscripts))
        raise self._without_meaning(tree)

    def sign(self, tree: t.Sign) -> Value:
        """Raises PrintError: a bare sign has a meaning only as part of a key."""
        raise self._without_meaning(tree)

    def power(self, tree: t.Power) -> Value:
        r"""A family, such as F^{\cdot}, at its superscript, or a power with an integer exponent."""
        base, exponent = tree.base, tree.exponent
        family = self.meanings.get(t.Power(base, HOLE))
        if family is not None:
            return applied(family, self.here(exponent))
        if isinstance(base, t.Name) and base.subscripts:
            family = self.meanings.get(
                t.Power(t.Name(base.base, base.accents, (HOLE,), base.primes), HOLE)
            )
            if family is not None:
                return applied(family, *map(self.here, base.subscripts), self.here(exponent))
        if isinstance(exponent, t.Sign):
            raise self._without_meaning(tree)
        value = self.of(base)
        if isinstance(value, Region):
            raise self._without_meaning(tree)
        return self._raised(self.at_state(value, base), tree)

    def _raised(self, base: Value, tree: t.Power) -> Value:
        exponent = self.here(tree.exponent)
        if not isinstance(exponent, int):
            raise PrintError(
                tree.exponent.at,
                f"the exponent of {spelled(tree.base)} is not an integer, and has no other meaning"
                " here",
            )
        return raised(base, exponent)

    # sums and products
    # ----------------------------------------------------------------------------------------------

    def number(self, tree: t.Number) -> Value:
        return tree.value

    def negative(self, tree: t.Negative) -> Value:
        return negate(self.here(tree.operand))

    def quotient(self, tree: t.Quotient) -> Value:
        """A quotient of scalars, or a vector or matrix over a scalar.

        A slash before a product is refused, because the divisor is ambiguous.
        """
        if (
            tree.slash
            and isinstance(tree.bottom, t.Juxtaposition)
            and not self._is_application(tree.bottom)
        ):
            raise PrintError(tree.at, r"what / divides by is ambiguous: bracket it, or write \frac")
        top, bottom = self.here(tree.top), self.here(tree.bottom)
        if not is_scalar(bottom):
            raise PrintError(tree.bottom.at, "a division by something that is not a scalar")
        return over(top, bottom) if is_scalar(top) else multiply(over(1, bottom), top)

    def _is_application(self, tree: t.Juxtaposition) -> bool:
        return (
            len(tree.factors) == 2
            and isinstance(tree.factors[1], t.Group)
            and callable(self.of(tree.factors[0]))
        )

    def binary(self, tree: t.Binary) -> Value:
        """A sum, difference or product, a union or intersection, or a composition of functions."""
        sign = tree.sign
        if sign == r"\circ":
            return self._composed(self.of(tree.left), self.of(tree.right), tree)
        if sign == r"\cap":
            return self._region(tree.left) & self._region(tree.right)
        left, right = self.here(tree.left), self.here(tree.right)
        if sign == "+":
            return add(left, right)
        if sign in ("-", r"\setminus"):
            return subtract(left, right)
        return union(left, right) if sign == r"\cup" else multiply(left, right)

    def _region(self, tree: Tree) -> Region:
        value = self.of(tree)
        if not isinstance(value, Region):
            raise PrintError(tree.at, f"{spelled(tree)} is not a region")
        return value

    def _composed(self, outer: Value, inner: Value, tree: t.Binary) -> Value:
        if not callable(outer) or isinstance(outer, Region):
            raise PrintError(
                tree.left.at,
                f"{spelled(tree.left)} is not a function, which \\circ needs on its left",
            )
        if not callable(inner) or isinstance(inner, Region):
            return applied(outer, inner)
        if isinstance(inner, Restricted):
            return Restricted(
                lambda state: applied(outer, applied(inner.function, state)), inner.region
            )
        return StateFunction(lambda *arguments: applied(outer, applied(inner, *arguments)))

    def juxtaposition(self, tree: t.Juxtaposition) -> Value:
        """The product of the factors, where a function is applied to the bracket after it."""
        factors, values, i = tree.factors, list[Value](), 0
        while i < len(factors):
            first, value, i = factors[i], self._applied_key(factors, i), i + 1
            if value is None:
                value = self.of(first)
                while i < len(factors) and (bracket := _bracket(factors[i])) is not None:
                    applied = self._applied(value, first, bracket)
                    if applied is None:
                        break
                    last = factors[i]
                    value = (
                        self._raised(self.at_state(applied, last), last)
                        if isinstance(last, t.Power)
                        else applied
                    )
                    i += 1
            else:
                i += 1
            if not values and i == len(factors):
                return value
            values.append(self.at_state(value, first))
        return reduce(multiply, values)

    def _applied_key(self, factors: tuple[Tree, ...], i: int) -> Value | None:
        """The value of a key such as E(t), if factors i and i + 1 are one; else None."""
        if t.Juxtaposition not in self.environment.kinds or i + 1 == len(factors):
            return None
        return self.meanings.get(t.Juxtaposition(factors[i : i + 2]))

    def _applied(self, function: Value, name: Tree, bracket: t.Group) -> Value | None:
        """The function applied to the content of the bracket; None where the two are a product."""
        if isinstance(function, Region) or not (callable(function) or isinstance(function, Vector)):
            return None
        arguments: list[Value] = [self.here(item) for item in bracket.items]
        if not callable(function):
            if len(arguments) == 1 and not is_scalar(arguments[0]):
                return None
            raise PrintError(
                bracket.at, f"{spelled(name)} is a vector, not a function, and a bracket follows it"
            )
        if len(arguments) > 1 and all(map(is_scalar, arguments)):
            arguments = [Vector(tuple(map(scalar, arguments)))]
        if len(arguments) == 1 and isinstance(arguments[0], Region):
            return Image(function, arguments[0])
        if (
            isinstance(function, StateFunction)
            and function.factor
            and len(arguments) == 1
            and is_scalar(arguments[0])
        ):
            return None
        return applied(function, *arguments)


def _bracket(tree: Tree) -> t.Group | None:
    """The factor itself, or its base if it is a power, where that is a round bracket; else None."""
    inner = tree.base if isinstance(tree, t.Power) else tree
    return inner if isinstance(inner, t.Group) and inner.bracket == "(" else None


# -------------------------------------------------------------------------------------------------
# The formula that `left sign right` states, for values of every kind.
#
# A definition := and an identity \equiv state equality; vectors are compared entry by entry,
# regions at the present state, a list of cases case by case; a relation with a restricted function
# is stated inside its region only; \subset allows equality.

EQUALITIES = frozenset(("=", ":=", r"\equiv"))
_INCLUSIONS = frozenset((r"\subset", r"\subseteq"))
_OF_TERMS: dict[str, Callable[[Scalar, Scalar], Formula]] = {
    "=": equal,
    ":=": equal,
    r"\equiv": equal,
    r"\ne": different,
    "<": lambda a, b: term(a) < b,
    ">": lambda a, b: term(a) > b,
    r"\le": lambda a, b: term(a) <= b,
    r"\ge": lambda a, b: term(a) >= b,
}


def relate(left: Value, sign: str, right: Value, state: Vector | None = None) -> Formula:
    """The formula of one relation; regions are compared at `state`."""
    if is_scalar(left) and is_scalar(right) and sign in _OF_TERMS:
        return _OF_TERMS[sign](left, right)
    for value, other, turned in ((left, right, False), (right, left, True)):
        if isinstance(value, Guarded):
            inner = (other, sign, value.value) if turned else (value.value, sign, other)
            return value.under(relate(*inner, state))
        if isinstance(value, Piecewise) and sign in EQUALITIES:
            return _by_cases(other, value, state)
        if isinstance(value, Rounded) and sign in EQUALITIES and is_scalar(value.value):
            return _rounds(other, value)
    if sign in (r"\in", r"\notin"):
        return _member(left, sign, right)
    if isinstance(left, (Region, Image)) and isinstance(right, Region):
        return _of_regions(left, sign, right, state)
    pairs = _pairs(left, right)
    if pairs is not None and sign == r"\ne":
        return disjunction([different(a, b) for a, b in pairs])
    if pairs is not None and sign in EQUALITIES:
        return conjunction([equal(a, b) for a, b in pairs])
    raise ShapeError(f"{sign} between {kind_of(left)} and {kind_of(right)} states no formula")


def _pairs(left: Value, right: Value) -> list[tuple[Scalar, Scalar]] | None:
    """The entries of two vectors or two matrices side by side; None for other values."""
    if isinstance(left, Matrix) and isinstance(right, Matrix):
        if left.shape != right.shape:
            raise ShapeError("an equation of matrices of different shapes")
        return [
            pair
            for rows in zip(left.rows, right.rows, strict=True)
            for pair in zip(*rows, strict=True)
        ]
    if isinstance(left, Vector) and isinstance(right, Vector):
        if len(left.entries) != len(right.entries):
            raise ShapeError("an equation of vectors of different lengths")
        return list(zip(left.entries, right.entries, strict=True))
    return None


def _by_cases(value: Value, cases: Piecewise, state: Vector | None) -> Formula:
    stated = []
    for piece in cases.pieces:
        line = relate(value, "=", piece.value, state)
        stated.append(
            implies(piece.condition, line if piece.besides is None else line & piece.besides)
        )
    return conjunction(stated)


def _rounds(value: Value, rounded: Rounded) -> Formula:
    if not is_scalar(value):
        raise ShapeError(f"a rounded number equal to {kind_of(value)}")
    whole, exact = term(scalar(value)), term(scalar(rounded.value))
    if rounded.bracket == r"\lfloor":
        return (whole <= exact) & (exact < whole + 1)
    return (exact <= whole) & (whole < exact + 1)


def _member(left: Value, sign: str, right: Value) -> Formula:
    if not isinstance(left, Vector) or not isinstance(right, Region):
        raise ShapeError(f"{sign} between {kind_of(left)} and {kind_of(right)} states no formula")
    inside = right(left)
    return inside if sign == r"\in" else ~inside


def _of_regions(left: Region | Image, sign: str, right: Region, state: Vector | None) -> Formula:
    if state is None:
        raise ShapeError("regions are compared at the state of the environment, which has none")
    if sign in _INCLUSIONS:
        if isinstance(left, Region):
            return implies(left(state), right(state))
        image = applied(left.function, state)
        if not isinstance(image, Vector):
            raise ShapeError(f"the image of a region, whose states are {kind_of(image)}")
        return implies(left.region(state), right(image))
    if isinstance(left, Region) and sign in EQUALITIES:
        return iff(left(state), right(state))
    raise ShapeError(f"{sign} between {kind_of(left)} and {kind_of(right)} states no formula")
