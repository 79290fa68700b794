r"""The evaluation of names, sums and products, where juxtaposition is settled as product or
application.

A factor that is a function is applied to the bracket that follows it; everything else is a product.
A `StateFunction` may be marked as a factor before a scalar, so that \tau_c(\overline b) and
\tau_c(\dot{\overline\beta} - \dot\rho_0) both say what the paper says.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from certificates.terms import ClaimError, Formula
from proofs.reading import tree as t
from proofs.reading.arithmetic import add, multiply, negate, raised, subtract, union
from proofs.reading.environment import Environment
from proofs.reading.errors import PrintError
from proofs.reading.notions import Image, Region, Restricted, StateFunction, applied
from proofs.reading.tree import HOLE, Tree, spelled
from proofs.reading.values import Vector, is_scalar, over

Value = Any  # a scalar, Vector, Matrix, callable, Region, Formula or one of the notions
_MISSING = object()


class Evaluation:
    """The evaluation of trees in one environment: what holds for all of them, and arithmetic."""

    rules: ClassVar[dict[type, Callable[[Any, Any], Value]]] = {}

    def __init__(self, environment: Environment) -> None:
        self.environment = environment
        self.meanings = environment.meanings

    def of(self, tree: Tree) -> Value:
        """The value of a tree; a function stays a function."""
        kind = type(tree)
        if kind in self.environment.kinds:
            value = self.meanings.get(tree, _MISSING)
            if value is not _MISSING:
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
        value = self.meanings.get(tree, _MISSING)
        if value is not _MISSING:
            return value
        if tree.subscripts:
            family = self.meanings.get(
                t.Name(tree.base, tree.accents, (HOLE,) * len(tree.subscripts), tree.primes)
            )
            if family is not None:
                return applied(family, *map(self.here, tree.subscripts))
        raise self._without_meaning(tree)

    def mark(self, tree: t.Mark) -> Value:
        raise self._without_meaning(tree)

    def power(self, tree: t.Power) -> Value:
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
        if isinstance(exponent, t.Mark):
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
        factors, result, i = tree.factors, _MISSING, 0
        while i < len(factors):
            first, value, i = factors[i], self._applied_key(factors, i), i + 1
            if value is _MISSING:
                value = self.of(first)
                while i < len(factors) and (bracket := _bracket(factors[i])) is not None:
                    applied = self._applied(value, first, bracket)
                    if applied is _MISSING:
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
            if result is _MISSING and i == len(factors):
                return value
            value = self.at_state(value, first)
            result = value if result is _MISSING else multiply(result, value)
        return result

    def _applied_key(self, factors: tuple[Tree, ...], i: int) -> Value:
        """The meaning of a key such as E(t), where it stands among the factors."""
        if t.Juxtaposition not in self.environment.kinds or i + 1 == len(factors):
            return _MISSING
        return self.meanings.get(t.Juxtaposition(factors[i : i + 2]), _MISSING)

    def _applied(self, function: Value, name: Tree, bracket: t.Group) -> Value:
        """The function at what the bracket holds, or _MISSING where the two are a product."""
        is_function = callable(function) and not isinstance(function, Region)
        if not is_function and not isinstance(function, Vector):
            return _MISSING
        arguments: list[Value] = [self.here(item) for item in bracket.items]
        if not is_function:
            if len(arguments) == 1 and not is_scalar(arguments[0]):
                return _MISSING
            raise PrintError(
                bracket.at, f"{spelled(name)} is a vector, not a function, and a bracket follows it"
            )
        if len(arguments) > 1 and all(map(is_scalar, arguments)):
            arguments = [Vector(tuple(arguments))]
        if len(arguments) == 1 and isinstance(arguments[0], Region):
            return Image(function, arguments[0])
        if (
            isinstance(function, StateFunction)
            and function.factor
            and len(arguments) == 1
            and is_scalar(arguments[0])
        ):
            return _MISSING
        return applied(function, *arguments)


def _bracket(tree: Tree) -> t.Group | None:
    """The round bracket that this factor is, perhaps under an exponent."""
    inner = tree.base if isinstance(tree, t.Power) else tree
    return inner if isinstance(inner, t.Group) and inner.bracket == "(" else None
