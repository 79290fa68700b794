"""Terms of SMT-LIB in our language: core connectives, comparisons, rational arithmetic, let, and
functions that are defined before.

A term of sort Bool becomes a formula, one of sort Real a term in cases.  Terms are read without
recursion, however deep they are nested.  Source: SMT-LIB 2.6, theories Core and
Reals.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Generator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial, reduce
from operator import add, mul, sub
from typing import TypeVar, Union

from juggleproof.smtlib import limits
from juggleproof.smtlib.sexpr import Expression, Script, SexprList, SexprWord
from juggleproof.smtlib.values import (
    Parts,
    RealCases,
    TooLarge,
    Value,
    balanced,
    plain,
    relation,
)
from juggleproof.statements.language import (
    Formula,
    Term,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    implies,
    term,
)

# -------------------------------------------------------------------------------------------------
# Reading terms.

NOT_POLYNOMIAL = frozenset({"sin", "cos", "tan", "arctan", "exp", "log", "ln", "sqrt", "pow"})
Arities = Mapping[str, tuple[int, Union[int, None]]]  # least and greatest numbers of arguments
SORTS = ("Real", "Bool")
CONNECTIVES: Arities = {
    "not": (1, 1),
    "and": (1, None),
    "or": (1, None),
    "=>": (2, None),
    "xor": (2, None),
}
RELATIONS: Mapping[str, Callable[[Term, Term], Formula]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    "=": equal,
    ">=": lambda a, b: a >= b,
    ">": lambda a, b: a > b,
    "distinct": different,
}
OPERATIONS: Arities = {
    "+": (1, None),
    "*": (1, None),
    "-": (1, None),
    "/": (2, None),
    "^": (2, 2),
}
ARITIES: Arities = {
    "ite": (3, 3),
    **CONNECTIVES,
    **dict.fromkeys(RELATIONS, (2, None)),
    **OPERATIONS,
}
RESERVED = frozenset(
    {
        "true",
        "false",
        "let",
        "!",
        "forall",
        "exists",
        "_",
        "as",
        "par",
        *ARITIES,
    }
)


@dataclass(frozen=True)
class DefinedFunction:
    """A function that is defined in the script: the names and sorts of its parameters, its sort,
    its body, and the meanings of the names in the body.
    """

    parameters: tuple[tuple[str, str], ...]
    sort: str
    body: Expression
    scope: Mapping[str, Meaning]


Compared = TypeVar("Compared", Formula, RealCases)
Meaning = Union[Value, DefinedFunction]  # the meaning of a name


@dataclass
class NameScope:
    """The meanings of names: `own` has those of `let` and of parameters, `around` all others."""

    around: Mapping[str, Meaning]
    own: dict[str, Meaning]

    def get(self, name: str) -> Meaning | None:
        """The meaning of the name, or None."""
        found = self.own.get(name)
        return self.around.get(name) if found is None else found


# the reading of a term yields its parts, is sent their values, and returns the term's value
Reading = Generator[tuple[Expression, NameScope], Value, Value]


class TermReader:
    """A reader of the terms of one script; `taken` gives the names of its variables."""

    def __init__(self, script: Script, taken: Callable[[], Collection[str]]) -> None:
        self.script, self.parts, self.steps = script, Parts(taken), 0
        # values of functions, which are not read again for the same arguments
        self._known: dict[tuple[int, tuple[Value, ...]], tuple[DefinedFunction, Value]] = {}

    def formula(self, node: Expression, scope: Mapping[str, Meaning]) -> Formula:
        """The value of a term of sort Bool."""
        return self._bool(node, self.value(node, scope))

    def real(self, node: Expression, scope: Mapping[str, Meaning]) -> RealCases:
        """The value of a term of sort Real."""
        return self._real(node, self.value(node, scope))

    def value(self, node: Expression, scope: Mapping[str, Meaning]) -> Value:
        """The value of a term, read with an explicit stack."""
        opened = [self._read(node, NameScope(scope, {}))]
        step = partial(next, opened[0])
        while True:
            try:
                part, inside = step()
            except StopIteration as read:
                value: Value = read.value
                opened.pop()
                if not opened:
                    return value
                step = partial(opened[-1].send, value)
            else:
                opened.append(self._read(part, inside))
                step = partial(next, opened[-1])

    def _bool(self, node: Expression, value: Value) -> Formula:
        if isinstance(value, RealCases):
            self.script.fail(
                node,
                f"{brief(node)} is a Real where a Bool is expected",
                "compare it with <, <=, =, >= or >",
            )
        return value

    def _real(self, node: Expression, value: Value) -> RealCases:
        if isinstance(value, Formula):
            self.script.fail(
                node, f"{brief(node)} is a Bool where a Real is expected", "use (ite condition a b)"
            )
        return value

    def _of_sort(self, sort: str, node: Expression, value: Value) -> Value:
        return self._real(node, value) if sort == "Real" else self._bool(node, value)

    def _read(self, node: Expression, scope: NameScope) -> Reading:
        self.steps += 1
        if self.steps > limits.MOST_STEPS:
            self.script.fail(
                node,
                f"more than {limits.MOST_STEPS} terms, those of functions counted where they are"
                " applied",
                "split the problem",
            )
        return (
            self._word(node, scope) if isinstance(node, SexprWord) else self._applied(node, scope)
        )

    def _word(self, word: SexprWord, scope: NameScope) -> Reading:
        if word.kind in ("numeral", "decimal"):
            if len(word.text) > limits.LONGEST_NUMBER:
                self.script.fail(
                    word,
                    f"a number of {len(word.text)} signs; at most {limits.LONGEST_NUMBER} are read",
                    "scale the variables",
                )
            return plain(term(Fraction(word.text)))
        if word.kind != "symbol":
            self.script.fail(
                word, f"{word} where a term is expected", "only reals and Bools can be spoken of"
            )
        if word.text in ("true", "false"):
            return conjunction([]) if word.text == "true" else disjunction([])
        meant = scope.get(word.text)
        if meant is None and re.fullmatch(r"-[0-9.]+", word.text):
            self.script.fail(word, f"{word.text} is a symbol", f"write (- {word.text[1:]})")
        if meant is None:
            self.script.fail(
                word,
                f"{word.text} is not declared",
                f"add (declare-const {word.text} Real) before it",
            )
        if isinstance(meant, DefinedFunction):
            return (yield from self._call(word, meant, [], scope))
        return meant

    def _applied(self, node: SexprList, scope: NameScope) -> Reading:
        if not node.items:
            self.script.fail(node, "() where a term is expected", "write a term")
        head, rest = node.items[0], node.items[1:]
        if not isinstance(head, SexprWord) or head.kind != "symbol":
            self.script.fail(
                node,
                f"{brief(head)} is not the name of a function",
                "only functions of the theory of reals are known",
            )
        name, meant = head.text, scope.get(head.text)
        if isinstance(meant, DefinedFunction):
            return (yield from self._call(node, meant, rest, scope))
        if meant is not None:
            self.script.fail(node, f"{name} is no function", "write it without parentheses")
        if name == "let":
            return (yield from self._let(node, scope))
        if name == "!":
            if not rest:
                self.script.fail(node, "an annotation without a term", "write (! term :named name)")
            return (yield rest[0], scope)
        if name not in ARITIES:
            self.script.fail(node, *unknown_function(name))
        self._arity(node, name, len(rest), *ARITIES[name])
        values: list[Value] = []
        for part in rest:
            values.append((yield part, scope))
        try:
            return self._made(node, name, values)
        except TooLarge as problem:
            self.script.fail(node, str(problem), "split the problem")

    def _call(
        self,
        at: Expression,
        function: DefinedFunction,
        arguments: Sequence[Expression],
        scope: NameScope,
    ) -> Reading:
        count = len(function.parameters)
        self._arity(at, "the function", len(arguments), count, count)
        values: list[Value] = []
        for (_, sort), argument in zip(function.parameters, arguments):
            values.append(self._of_sort(sort, argument, (yield argument, scope)))
        key = id(function), tuple(values)
        if key not in self._known:
            own = {name: value for (name, _), value in zip(function.parameters, values)}
            value = yield function.body, NameScope(function.scope, dict(own))
            self._known[key] = function, self._of_sort(function.sort, function.body, value)
        return self._known[key][1]

    def _let(self, node: SexprList, scope: NameScope) -> Reading:
        self._arity(node, "let", len(node.items) - 1, 2, 2)
        values: dict[str, Meaning] = {}
        for name, part in self.pairs(node.items[1], "let"):
            # the bindings are simultaneous: none sees another
            values[name] = yield part, scope
        before = {name: scope.own.get(name) for name in values}
        scope.own.update(values)
        value = yield node.items[2], scope
        for name, meant in before.items():
            if meant is None:
                del scope.own[name]
            else:
                scope.own[name] = meant
        return value

    def pairs(self, node: Expression, what: str) -> list[tuple[str, Expression]]:
        """The pairs of a list ((name expression) ..), in which no name occurs twice."""
        bound: dict[str, Expression] = {}
        for pair in node.items if isinstance(node, SexprList) else [node]:
            if (
                not isinstance(pair, SexprList)
                or len(pair.items) != 2
                or not isinstance(pair.items[0], SexprWord)
                or pair.items[0].kind != "symbol"
            ):
                self.script.fail(
                    pair,
                    f"{brief(pair)}: not a name with what belongs to it",
                    f"write {what} ((name ..) ..)",
                )
            name = pair.items[0].text
            if name in bound or name in RESERVED:
                self.script.fail(
                    pair, f"{name} is bound twice, or is reserved", "choose another name"
                )
            bound[name] = pair.items[1]
        return list(bound.items())

    def _made(self, node: SexprList, name: str, values: Sequence[Value]) -> Value:
        """The value of a function of the theory at these values."""
        parts = list(zip(node.items[1:], values))
        if name == "ite":
            return self._ite(node, values)
        if name in CONNECTIVES:
            return self._connective(name, [self._bool(*part) for part in parts])
        if name in RELATIONS:
            return self._relation(node, name, values)
        return self._operation(node, name, [self._real(*part) for part in parts])

    def _ite(self, node: SexprList, values: Sequence[Value]) -> Value:
        condition = self._bool(node.items[1], values[0])
        first, second = values[1:]
        if isinstance(first, Formula) and isinstance(second, Formula):
            return self.parts.joined(
                lambda own: (own[0] & own[1]) | (Formula("not", own[0]) & own[2]),
                [condition, first, second],
            )
        if isinstance(first, RealCases) and isinstance(second, RealCases):
            return self.parts.chosen(condition, first, second)
        self.script.fail(node, "ite between a Bool and a Real", "give both the same sort")

    def _connective(self, name: str, parts: Sequence[Formula]) -> Formula:
        joined = self.parts.joined
        if name == "not":
            return _negation(parts[0])
        if name in ("and", "or"):
            return joined(conjunction if name == "and" else disjunction, parts)
        if name == "=>":
            *premises, goal = parts
            return reduce(lambda right, left: joined(_implies, [left, right]), premises[::-1], goal)
        return reduce(lambda left, right: joined(_xor, [left, right]), parts)

    def _relation(self, node: SexprList, name: str, values: Sequence[Value]) -> Value:
        formulas = [value for value in values if isinstance(value, Formula)]
        reals = [value for value in values if isinstance(value, RealCases)]
        if formulas and (reals or name not in ("=", "distinct")):
            self.script.fail(
                node,
                f"{brief(node)} compares a Bool" + (" with a Real" if reals else ""),
                "give both sides the sort Real",
            )
        together = self.parts.joined
        if formulas:
            make = _xor if name == "distinct" else _iff
            return together(
                conjunction, [together(make, pair) for pair in pairs_of(name, formulas)]
            )
        compare = RELATIONS[name]
        return together(
            conjunction,
            [
                relation(self.parts.few(pair), lambda two: compare(two[0], two[1]))
                for pair in pairs_of(name, reals)
            ],
        )

    def _operation(self, node: SexprList, name: str, values: Sequence[RealCases]) -> Value:
        combined = self.parts.combined
        if name == "^":
            return self._power(node, values)
        if name == "-" and len(values) == 1:
            return combined(values, lambda one: _negative(one[0]))
        if name == "-":
            return combined(values, difference)
        if name == "/":
            return reduce(lambda a, b: combined([a, b], lambda two: quotient(*two)), values)
        join = add if name == "+" else mul
        return combined(values, lambda parts: balanced(join, parts))

    def _power(self, node: SexprList, values: Sequence[RealCases]) -> Value:
        exponent = values[1].plain
        if (
            exponent is None
            or exponent.op != "num"
            or exponent.value.denominator != 1
            or not 0 <= exponent.value <= limits.LARGEST_POWER
        ):
            self.script.fail(
                node,
                f"{brief(node)}: the exponent is no numeral from 0 to {limits.LARGEST_POWER}",
                "write a polynomial, or a root as y*y = t",
            )
        power = int(exponent.value)
        return self.parts.combined(values[:1], lambda base: base[0] ** power)

    def _arity(self, at: Expression, name: str, count: int, least: int, most: int | None) -> None:
        if count < least or most is not None and count > most:
            wanted = (
                str(least)
                if least == most
                else f"at least {least}"
                if most is None
                else f"{least} to {most}"
            )
            self.script.fail(
                at,
                f"{name} takes {wanted} argument{'' if wanted in ('1', 'at least 1') else 's'}, not"
                f" {count}",
                "mend their number",
            )


def pairs_of(name: str, values: Sequence[Compared]) -> list[tuple[Compared, Compared]]:
    """The pairs that a chained relation compares: neighbours, or all for `distinct`."""
    if name != "distinct":
        return list(zip(values, values[1:]))
    return [(one, other) for k, one in enumerate(values) for other in values[:k]]


def _negation(one: Formula) -> Formula:
    return one.parts[0] if one.op == "not" else Formula("not", one)


def _implies(two: Sequence[Formula]) -> Formula:
    return implies(two[0], two[1])


def _iff(two: Sequence[Formula]) -> Formula:
    return iff(two[0], two[1])


def _xor(two: Sequence[Formula]) -> Formula:
    return iff(two[0], Formula("not", two[1]))


def difference(terms: Sequence[Term]) -> Term:
    """The first term minus all others; minus their sum where there are many."""
    return reduce(sub, terms) if len(terms) <= 8 else terms[0] - balanced(add, terms[1:])


def _negative(one: Term) -> Term:
    return number(-one.value) if one.op == "num" else -one


def unknown_function(name: str) -> tuple[str, str]:
    """The problem and the remedy for a function that the theory does not know."""
    if name in ("forall", "exists"):
        return f"{name}: quantifiers are not taken on", "free variables are sought"
    if name in NOT_POLYNOMIAL:
        return f"{name} is not polynomial", "assert polynomial bounds of it instead"
    known = "only functions of the theory of reals, and those defined before, are known"
    return f"{name}: an unknown function", known


def number(value: Fraction) -> Term:
    """The term of a rational number."""
    return term(value)


def quotient(above: Term, below: Term) -> Term:
    """The quotient of two terms; a number if both are numbers."""
    if above.op == below.op == "num" and below.value != 0:
        return number(above.value / below.value)
    return above / below


def brief(node: Expression) -> str:
    """The text of an expression, shortened to 60 characters."""
    text = str(node)
    return text if len(text) <= 60 else text[:57] + "..."
