"""Reads SMT-LIB terms of the theory of reals: core connectives, comparisons, rational arithmetic,
let, and functions defined before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import Any

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
from juggleproof.proofs.smtlib.sexpr import (
    Expression,
    Node,
    Real,
    Script,
    Sizes,
    TooLarge,
    Value,
    Word,
    choice,
    combined,
    plain,
    relation,
)

LARGEST_POWER, LONGEST_NUMBER = 100, 1000
SORTS = ("Real", "Bool")


@dataclass(frozen=True)
class Function:
    """A function that is defined in the script: the names and sorts of its parameters, its sort,
    its body, and what was defined by then.
    """

    parameters: tuple[tuple[str, str], ...]
    sort: str
    body: Expression
    scope: Mapping[str, Any]


Scope = Mapping[str, Any]  # a name -> its value, or the function that it is


def balanced(join: Callable[[Any, Any], Any], parts: Sequence[Any]) -> Any:
    """The parts joined by an associative operation, so that no text grows deep."""
    if len(parts) <= 8:
        return reduce(join, parts)
    middle = len(parts) // 2
    return join(balanced(join, parts[:middle]), balanced(join, parts[middle:]))


def sort_of(value: Value) -> str:
    """Real or Bool."""
    return "Real" if isinstance(value, Real) else "Bool"


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
        if isinstance(scope.get(head.text), Function):
            return self._call(node, scope[head.text], rest, scope)
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
                "free variables are sought, as in QF_NRA",
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
        values = {
            name: self.value(said, scope) for name, said in bound
        }  # all at once: none of them sees another
        return self.value(node.items[2], {**scope, **values})

    def pairs(self, node: Expression, what: str) -> list[tuple[str, Expression]]:
        """A list of (name thing), each name once."""
        found: dict[str, Expression] = {}
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
            if name in found or name in RESERVED:
                self.script.fail(
                    pair, f"{name} is bound twice, or is reserved", "choose another name"
                )
            found[name] = pair.items[1]
        return list(found.items())

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
                values, lambda one: number(-one[0].args[0]) if one[0].op == "num" else -one[0]
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
            or exponent.args[0].denominator != 1
            or not 0 <= exponent.args[0] <= LARGEST_POWER
        ):
            self.script.fail(
                node,
                f"{brief(node)}: the exponent is no numeral from 0 to {LARGEST_POWER}",
                "write a polynomial, or a root as y*y = t",
            )
        power = int(exponent.args[0])
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
    if above.op == below.op == "num" and below.args[0] != 0:
        return number(above.args[0] / below.args[0])
    return above / below


def brief(node: Expression) -> str:
    """An expression as it is told in one line."""
    text = str(node)
    return text if len(text) <= 60 else text[:57] + "..."


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
