"""Terms of SMT-LIB in our language: core connectives, comparisons, rational arithmetic, let, and
functions defined before.

A term of sort Bool becomes a formula.  A term of sort Real becomes a term in cases, one for each
way in which the conditions of its `ite` can come out.  Source: SMT-LIB 2.6, theories Core and
Reals.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import product
from typing import TypeVar, Union

from juggleproof.certificates.language import (
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
from juggleproof.proofs.smtlib.sexpr import Expression, Node, Script, Word

# -------------------------------------------------------------------------------------------------
# Real terms in cases.

MOST_CASES = 64
MOST_NODES = 20_000
DEEPEST_TERM = 120  # the checker reads texts by Python's parser, which takes 200 nested parentheses
Guards = tuple[tuple[Formula, bool], ...]


class TooLarge(Exception):
    """An expression has more cases, or more symbols when definitions are put in, than we take
    on.
    """


@dataclass(frozen=True)
class Real:
    """A real term: in each case its value under the conditions of the case, of which exactly one
    applies.
    """

    cases: tuple[tuple[Guards, Term], ...]

    @property
    def plain(self) -> Term | None:
        """The term, where there are no cases to distinguish."""
        return self.cases[0][1] if len(self.cases) == 1 and not self.cases[0][0] else None


Value = Union[Formula, Real]


def plain(value: Term | int) -> Real:
    """A term without cases."""
    return Real((((), term(value)),))


def merged(parts: Sequence[Guards]) -> Guards | None:
    """All conditions together; None where one of them is wanted both true and false."""
    joined: dict[Formula, bool] = {}
    for condition, truth in (pair for part in parts for pair in part):
        if joined.setdefault(condition, truth) is not truth:
            return None
    return tuple(joined.items())


def combined(values: Sequence[Real], make: Callable[[Sequence[Term]], Term]) -> Real:
    """The term made of the values, in every case that they can be in together."""
    return Real(tuple((guards, make(terms)) for guards, terms in together(values)))


def together(values: Sequence[Real]) -> list[tuple[Guards, tuple[Term, ...]]]:
    """The cases that several values can be in together, with the value of each."""
    if len(values) == 1:
        return [(guards, (value,)) for guards, value in values[0].cases]
    joined: list[tuple[Guards, tuple[Term, ...]]] = [((), ())]
    for value in values:
        pairs = [
            (merged((guards, more)), (*terms, last))
            for (guards, terms), (more, last) in product(joined, value.cases)
        ]
        joined = [(guards, terms) for guards, terms in pairs if guards is not None]
        if len(joined) > MOST_CASES:
            raise TooLarge(f"an atom with more than {MOST_CASES} cases of ite")
    return joined


def relation(values: Sequence[Real], make: Callable[[Sequence[Term]], Formula]) -> Formula:
    """The formula about the values: in one of the cases, its conditions and what `make` makes
    hold.

    >>> from juggleproof.certificates.language import reals
    >>> x, y = reals("x y")
    >>> larger = choice(x > y, plain(x), plain(y))
    >>> str(relation([larger], lambda terms: terms[0] >= 0))
    'x > y and x >= 0 or not x > y and y >= 0'
    """
    return disjunction(
        [conjunction([*map(holding, guards), make(terms)]) for guards, terms in together(values)]
    )


def holding(guard: tuple[Formula, bool]) -> Formula:
    """A condition, or its negation."""
    return guard[0] if guard[1] else Formula("not", guard[0])


def choice(condition: Formula, first: Real, second: Real) -> Real:
    """The first value where the condition holds, else the second."""
    pairs = [
        (merged((((condition, truth),), guards)), value)
        for truth, one in ((True, first), (False, second))
        for guards, value in one.cases
    ]
    cases = tuple((guards, value) for guards, value in pairs if guards is not None)
    if len(cases) > MOST_CASES:
        raise TooLarge(f"a term with more than {MOST_CASES} cases of ite")
    return Real(cases)


class Sizes:
    """The number of symbols of terms and formulas written out, and how deep they are; parts that
    are shared are looked at once.
    """

    def __init__(self) -> None:
        self.known: dict[int, tuple[object, int, int]] = {}

    def of(self, expression: Term | Formula) -> tuple[int, int]:
        """The size and the depth; raises TooLarge where they are beyond what we take on."""
        if id(expression) not in self.known:
            parts = [self.of(part) for part in expression.args if isinstance(part, (Term, Formula))]
            size, depth = (
                1 + sum(size for size, _ in parts),
                1 + max((depth for _, depth in parts), default=0),
            )
            self.known[id(expression)] = expression, size, depth
        _, size, depth = self.known[id(expression)]
        if size > MOST_NODES or depth > DEEPEST_TERM:
            raise TooLarge(
                f"an expression of more than {MOST_NODES} symbols, or {DEEPEST_TERM} levels, when"
                " its definitions are put in"
            )
        return size, depth

    def check(self, value: Value) -> Value:
        """The value, if it is not too large."""
        if isinstance(value, Formula):
            self.of(value)
            return value
        for guards, one in value.cases:
            self.of(one)
            for condition, _ in guards:
                self.of(condition)
        return value


# -------------------------------------------------------------------------------------------------
# Reading terms.

LARGEST_POWER, LONGEST_NUMBER = 100, 1000
NOT_POLYNOMIAL = frozenset({"sin", "cos", "tan", "arctan", "exp", "log", "ln", "sqrt", "pow"})
SORTS = ("Real", "Bool")
CONNECTIVES = {"not": 1, "and": 1, "or": 1, "=>": 2, "xor": 2}
RELATIONS: Mapping[str, Callable[[Term, Term], Formula]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    "=": equal,
    ">=": lambda a, b: a >= b,
    ">": lambda a, b: a > b,
    "distinct": different,
}
OPERATIONS: Mapping[str, tuple[int, int | None]] = {
    "+": (1, None),
    "*": (1, None),
    "-": (1, None),
    "/": (2, None),
    "^": (2, 2),
}
RESERVED = frozenset(
    {
        "true",
        "false",
        "let",
        "!",
        "forall",
        "exists",
        "ite",
        "_",
        "as",
        "par",
        *CONNECTIVES,
        *RELATIONS,
        *OPERATIONS,
    }
)


@dataclass(frozen=True)
class Function:
    """A function that is defined in the script: the names and sorts of its parameters, its sort,
    its body, and what was defined by then.
    """

    parameters: tuple[tuple[str, str], ...]
    sort: str
    body: Expression
    scope: Scope


Scope = Mapping[str, Union[Value, Function]]  # a name -> its value, or the function that it is
Joined = TypeVar("Joined")


def balanced(join: Callable[[Joined, Joined], Joined], parts: Sequence[Joined]) -> Joined:
    """The parts joined by an associative operation, so that no text grows deep."""
    if len(parts) <= 8:
        return reduce(join, parts)
    middle = len(parts) // 2
    return join(balanced(join, parts[:middle]), balanced(join, parts[middle:]))


class Reader:
    """Reads the terms of one script."""

    def __init__(self, script: Script) -> None:
        self.script, self.sizes = script, Sizes()

    def formula(self, node: Expression, scope: Scope) -> Formula:
        """A term of sort Bool."""
        value = self.value(node, scope)
        if isinstance(value, Real):
            self.script.fail(
                node,
                f"{brief(node)} is a Real where a Bool is expected",
                "compare it with <, <=, =, >= or >",
            )
        return value

    def real(self, node: Expression, scope: Scope) -> Real:
        """A term of sort Real."""
        value = self.value(node, scope)
        if isinstance(value, Formula):
            self.script.fail(
                node, f"{brief(node)} is a Bool where a Real is expected", "use (ite condition a b)"
            )
        return value

    def value(self, node: Expression, scope: Scope) -> Value:
        """The value of a term."""
        try:
            return self.sizes.check(
                self._word(node, scope) if isinstance(node, Word) else self._applied(node, scope)
            )
        except TooLarge as problem:
            self.script.fail(node, str(problem), "split the problem")

    def _word(self, word: Word, scope: Scope) -> Value:
        if word.kind in ("numeral", "decimal"):
            if len(word.text) > LONGEST_NUMBER:
                self.script.fail(
                    word,
                    f"a number of {len(word.text)} signs; at most {LONGEST_NUMBER} are read",
                    "scale the variables",
                )
            return plain(term(Fraction(word.text)))
        if word.kind != "symbol":
            self.script.fail(
                word, f"{word} where a term is expected", "only reals and Bools can be spoken of"
            )
        if word.text in ("true", "false"):
            return conjunction([]) if word.text == "true" else disjunction([])
        if word.text not in scope and re.fullmatch(r"-[0-9.]+", word.text):
            self.script.fail(word, f"{word.text} is a symbol", f"write (- {word.text[1:]})")
        if word.text not in scope:
            self.script.fail(
                word,
                f"{word.text} is not declared",
                f"add (declare-const {word.text} Real) before it",
            )
        meant = scope[word.text]
        return self._call(word, meant, [], scope) if isinstance(meant, Function) else meant

    def _applied(self, node: Node, scope: Scope) -> Value:
        if not node.items:
            self.script.fail(node, "() where a term is expected", "write a term")
        head, rest = node.items[0], node.items[1:]
        if not isinstance(head, Word) or head.kind != "symbol":
            self.script.fail(
                node,
                f"{brief(head)} is not the name of a function",
                "only functions of the theory of reals are known",
            )
        meant = scope.get(head.text)
        if isinstance(meant, Function):
            return self._call(node, meant, rest, scope)
        if head.text in scope:
            self.script.fail(node, f"{head.text} is no function", "write it without parentheses")
        if head.text == "let":
            return self._let(node, scope)
        if head.text == "!":
            if not rest:
                self.script.fail(node, "an annotation without a term", "write (! term :named name)")
            return self.value(rest[0], scope)
        if head.text in ("forall", "exists"):
            self.script.fail(
                node,
                f"{head.text}: quantifiers are not taken on",
                "free variables are sought",
            )
        if head.text == "ite":
            return self._ite(node, rest, scope)
        for table, read in (
            (CONNECTIVES, self._connective),
            (RELATIONS, self._relation),
            (OPERATIONS, self._operation),
        ):
            if head.text in table:
                return read(node, head.text, rest, scope)
        if head.text in NOT_POLYNOMIAL:
            self.script.fail(
                node, f"{head.text} is not polynomial", "assert polynomial bounds of it instead"
            )
        self.script.fail(
            node,
            f"{head.text}: an unknown function",
            "only functions of the theory of reals, and those defined before, are known",
        )

    def _call(
        self, at: Expression, function: Function, arguments: Sequence[Expression], scope: Scope
    ) -> Value:
        self._arity(
            at, "the function", len(arguments), len(function.parameters), len(function.parameters)
        )
        values = {}
        for (name, sort), argument in zip(function.parameters, arguments):
            values[name] = (
                self.real(argument, scope) if sort == "Real" else self.formula(argument, scope)
            )
        inner = {**function.scope, **values}
        return (
            self.real(function.body, inner)
            if function.sort == "Real"
            else self.formula(function.body, inner)
        )

    def _let(self, node: Node, scope: Scope) -> Value:
        self._arity(node, "let", len(node.items) - 1, 2, 2)
        bound = self.pairs(node.items[1], "let")
        # all at once: none of them sees another
        values = {name: self.value(value, scope) for name, value in bound}
        return self.value(node.items[2], {**scope, **values})

    def pairs(self, node: Expression, what: str) -> list[tuple[str, Expression]]:
        """A list of (name expression), each name once."""
        bound: dict[str, Expression] = {}
        for pair in node.items if isinstance(node, Node) else [node]:
            if (
                not isinstance(pair, Node)
                or len(pair.items) != 2
                or not isinstance(pair.items[0], Word)
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

    def _ite(self, node: Node, rest: Sequence[Expression], scope: Scope) -> Value:
        self._arity(node, "ite", len(rest), 3, 3)
        condition, first, second = (
            self.formula(rest[0], scope),
            self.value(rest[1], scope),
            self.value(rest[2], scope),
        )
        if isinstance(first, Formula) and isinstance(second, Formula):
            return (condition & first) | (Formula("not", condition) & second)
        if isinstance(first, Real) and isinstance(second, Real):
            return choice(condition, first, second)
        self.script.fail(node, "ite between a Bool and a Real", "give both the same sort")

    def _connective(self, node: Node, name: str, rest: Sequence[Expression], scope: Scope) -> Value:
        self._arity(node, name, len(rest), CONNECTIVES[name], 1 if name == "not" else None)
        parts = [self.formula(part, scope) for part in rest]
        if name == "not":
            return Formula("not", parts[0])
        if name in ("and", "or"):
            return conjunction(parts) if name == "and" else disjunction(parts)
        if name == "=>":
            return reduce(lambda right, left: implies(left, right), reversed(parts))
        return reduce(lambda left, right: iff(left, Formula("not", right)), parts)

    def _relation(self, node: Node, name: str, rest: Sequence[Expression], scope: Scope) -> Value:
        self._arity(node, name, len(rest), 2, None)
        values = [self.value(part, scope) for part in rest]
        formulas = [value for value in values if isinstance(value, Formula)]
        reals = [value for value in values if isinstance(value, Real)]
        if formulas and (reals or name not in ("=", "distinct")):
            self.script.fail(
                node,
                f"{brief(node)} compares a Bool" + (" with a Real" if reals else ""),
                "give both sides the sort Real",
            )
        if formulas:
            if name == "=":
                return conjunction([iff(one, other) for one, other in zip(formulas, formulas[1:])])
            return conjunction(
                [
                    iff(one, Formula("not", other))
                    for k, one in enumerate(formulas)
                    for other in formulas[:k]
                ]
            )
        if name == "distinct":
            return conjunction(
                [
                    relation((one, other), lambda two: different(*two))
                    for k, one in enumerate(reals)
                    for other in reals[:k]
                ]
            )
        compare = RELATIONS[name]
        return conjunction(
            [
                relation((one, other), lambda two: compare(*two))
                for one, other in zip(reals, reals[1:])
            ]
        )

    def _operation(self, node: Node, name: str, rest: Sequence[Expression], scope: Scope) -> Value:
        self._arity(node, name, len(rest), *OPERATIONS[name])
        values = [self.real(part, scope) for part in rest]
        if name == "^":
            return self._power(node, values)
        if name == "-" and len(values) == 1:
            return combined(
                values, lambda one: number(-one[0].value) if one[0].op == "num" else -one[0]
            )
        if name == "-":
            return combined(values, lambda parts: reduce(lambda a, b: a - b, parts))
        if name == "/":
            return combined(values, lambda parts: reduce(quotient, parts))
        join = (lambda a, b: a + b) if name == "+" else (lambda a, b: a * b)
        return combined(values, lambda parts: balanced(join, parts))

    def _power(self, node: Node, values: Sequence[Real]) -> Value:
        exponent = values[1].plain
        if (
            exponent is None
            or exponent.op != "num"
            or exponent.value.denominator != 1
            or not 0 <= exponent.value <= LARGEST_POWER
        ):
            self.script.fail(
                node,
                f"{brief(node)}: the exponent is no numeral from 0 to {LARGEST_POWER}",
                "write a polynomial, or a root as y*y = t",
            )
        power = int(exponent.value)
        return combined(values[:1], lambda base: base[0] ** power)

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


def number(value: Fraction) -> Term:
    """The term of a rational number."""
    return term(value)


def quotient(above: Term, below: Term) -> Term:
    """A quotient; of two numbers, the number."""
    if above.op == below.op == "num" and below.value != 0:
        return number(above.value / below.value)
    return above / below


def brief(node: Expression) -> str:
    """An expression, shortened to 60 signs."""
    text = str(node)
    return text if len(text) <= 60 else text[:57] + "..."
