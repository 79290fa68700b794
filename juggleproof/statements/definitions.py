"""Definitions of the statement file: there, a name stands for a term that a claim writes out.

A claim is built, searched for and voted on as it is written out.  Only the file that an auditor
reads is shorter: `shortened` puts NAME(a, b) in place of every body of a definition, and the
checker, which writes definitions out when it reads, gives the same text again (`Reader`).  So a
definition that `shortened` misses makes a line longer, and a wrong one would be seen at once.
"""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Union, overload

from juggleproof.certificates import checker
from juggleproof.statements.formulas import (
    ClaimError,
    Expression,
    Formula,
    Term,
    conjunction,
    names_in,
    real,
    term,
)

MOST_WORK = 10**9  # units for writing out a file; definitions that double in size exceed it
Body = Union[Term, Formula, tuple[Term, ...]]

# -------------------------------------------------------------------------------------------------
# Trees of the checker as terms and formulas

OPERATORS: Mapping[type, str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
RELATIONS: Mapping[type, str] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Eq: "=",
    ast.NotEq: "!=",
    ast.GtE: ">=",
    ast.Gt: ">",
}


def term_of(node: ast.expr) -> Term:
    """The term of a tree from `checker.parse`; its text is the text that was parsed.

    A sign before a product belongs to the whole product, as in the text of terms.  Raises
    ClaimError for a tree that is not a term.

    >>> str(term_of(checker.parse("-(x + 1)/2*y^2")))
    '-(x + 1)/2*y^2'
    """
    if isinstance(node, ast.Name):
        return real(node.id)
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return term(node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -term_of(node.operand)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        return Term("^", term_of(node.left), ast.literal_eval(node.right))
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        op, left = OPERATORS[type(node.op)], term_of(node.left)
        if op in "*/" and left.op == "neg":
            return -Term(op, *left.operands, term_of(node.right))
        return Term(op, left, term_of(node.right))
    raise ClaimError(f"{ast.unparse(node)!r} is not a term")


def formula_of(node: ast.expr) -> Formula:
    """The formula of a tree from `checker.parse`; raises ClaimError for any other tree.

    >>> str(formula_of(checker.parse("not x < 1 and implies(x = 2, y != 0)")))
    'not x < 1 and implies(x = 2, y != 0)'
    """
    if isinstance(node, ast.Compare):
        sides = [term_of(side) for side in (node.left, *node.comparators)]
        signs = [RELATIONS[type(op)] for op in node.ops]
        return conjunction(
            Formula(op, left, right) for op, left, right in zip(signs, sides, sides[1:])
        )
    if isinstance(node, ast.BoolOp):
        op = "and" if isinstance(node.op, ast.And) else "or"
        parts: list[Formula] = []
        for part in map(formula_of, node.values):  # nested conjunctions are flattened
            parts += part.parts if part.op == op else (part,)
        return Formula(op, *parts)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return Formula("not", formula_of(node.operand))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return Formula(node.func.id, *map(formula_of, node.args))
    raise ClaimError(f"{ast.unparse(node)!r} is not a formula")


# -------------------------------------------------------------------------------------------------
# Definitions


@dataclass(frozen=True)
class Definition:
    """A name for a term, a formula or a tuple of terms, in its parameters and in variables of the
    statement (`over`); `says` is the comment above it.

    >>> x, y, g = map(real, "xyg")
    >>> Definition("E", ("x", "y"), g * x + y**2 / 2).text()
    'define E(x, y) over g := g*x + y^2/2'
    """

    name: str
    parameters: tuple[str, ...]
    body: Body
    says: str = ""

    @property
    def parts(self) -> tuple[Term | Formula, ...]:
        """The terms of the body, if it is a tuple, or the body alone."""
        return self.body if isinstance(self.body, tuple) else (self.body,)

    @cached_property
    def over(self) -> tuple[str, ...]:
        """The other names that occur, sorted."""
        return tuple(sorted(set().union(*map(names_in, self.parts)) - {*self.parameters}))

    def text(self, earlier: Sequence[Definition] = ()) -> str:
        """The line of the statement file, shortened by earlier definitions."""
        inner = f"({', '.join(self.parameters)})" if self.parameters else ""
        outer = f" over {' '.join(self.over)}" if self.over else ""
        parts = ", ".join(str(shortened(part, earlier)) for part in self.parts)
        body = f"({parts})" if isinstance(self.body, tuple) else parts
        return f"define {self.name}{inner}{outer} := {body}"


def _matches(pattern: object, thing: object, values: dict[str, Term], free: frozenset[str]) -> bool:
    """Whether the thing is the pattern with terms put for its free names; `values` collects these
    terms by name.
    """
    if isinstance(pattern, Term) and pattern.op == "var" and pattern.name in free:
        if not isinstance(thing, Term) or values.get(pattern.name, thing) != thing:
            return False
        values[pattern.name] = thing
        return True
    if isinstance(pattern, Expression):
        return (
            isinstance(thing, Expression)
            and (pattern.op, len(pattern.args)) == (thing.op, len(thing.args))
            and all(_matches(one, two, values, free) for one, two in zip(pattern.args, thing.args))
        )
    return pattern == thing


def _call(one: Definition, values: Mapping[str, Term], rest: Sequence[Definition]) -> str:
    """The definition applied to shortened arguments; arguments that are the components of a defined
    tuple are written as that tuple.
    """
    if not one.parameters:
        return one.name
    terms = [values[name] for name in one.parameters]
    for pair in rest:
        if isinstance(pair.body, tuple) and len(pair.body) == len(terms):
            inner: dict[str, Term] = {}
            free = frozenset(pair.parameters)
            if all(_matches(*both, inner, free) for both in zip(pair.body, terms)):
                return f"{one.name}({_call(pair, inner, rest)})"
    return f"{one.name}({', '.join(str(shortened(entry, rest)) for entry in terms)})"


@overload
def shortened(thing: Term, definitions: Sequence[Definition]) -> Term: ...
@overload
def shortened(thing: Formula, definitions: Sequence[Definition]) -> Formula: ...
def shortened(thing: Expression, definitions: Sequence[Definition]) -> Expression:
    """The same term or formula with definitions by name, replaced from the outside in; the last
    definition that fits is taken, since it may contain earlier ones.

    >>> x, y, g = map(real, "xyg")
    >>> E = Definition("E", ("x", "y"), g * x + y**2 / 2)
    >>> str(shortened(g * (1 - x) + (x + y) ** 2 / 2 >= 0, [E]))
    'E(1 - x, x + y) >= 0'
    """
    for one in reversed(definitions):
        if isinstance(one.body, tuple):
            continue
        whole = _instance(one, thing, definitions)
        if whole is not None:
            return whole
        if thing.op == one.body.op == "and":
            within = _part_of_conjunction(one, thing, definitions)
            if within is not None:
                return within
    args = (
        shortened(part, definitions) if isinstance(part, (Term, Formula)) else part
        for part in thing.args
    )
    return type(thing)(thing.op, *args)


def instance(thing: Term, definitions: Sequence[Definition]) -> Term:
    """The first definition whose body matches the term, applied; else the term itself."""
    alike = (one for one in definitions if isinstance(one.body, Term) and one.body.op == thing.op)
    wholes = (_instance(one, thing, definitions) for one in alike)
    return next((one for one in wholes if isinstance(one, Term)), thing)


def _instance(
    one: Definition, thing: Expression, definitions: Sequence[Definition]
) -> Expression | None:
    values: dict[str, Term] = {}
    if not _matches(one.body, thing, values, frozenset(one.parameters)):
        return None
    return type(thing)("call", _call(one, values, definitions))


def _part_of_conjunction(
    one: Definition, thing: Expression, definitions: Sequence[Definition]
) -> Formula | None:
    """The conjunction in which adjacent parts that match the body are replaced by the name; None
    where no parts match.
    """
    body, free = one.parts[0].args, frozenset(one.parameters)
    width = len(body)
    for at in range(len(thing.args) - width + 1):
        values: dict[str, Term] = {}
        if all(_matches(*both, values, free) for both in zip(body, thing.args[at : at + width])):
            named = Formula("call", _call(one, values, definitions))
            rest = Formula("and", *thing.args[:at], named, *thing.args[at + width :])
            return shortened(rest, definitions)
    return None


# -------------------------------------------------------------------------------------------------
# Lines of the statement file

WIDTH = 97  # of a comment, without its "# "
FORMULAS = ("range", "given", "have", "with", "show")  # keywords of shortened lines with a formula
TERMS = ("let",)  # keywords of shortened lines NAME = TERM


def short_line(line: str, definitions: Sequence[Definition]) -> str:
    """A line of a statement with definitions by name.

    >>> x, y, g = map(real, "xyg")
    >>> short_line("let e = g*x + y^2/2", [Definition("E", ("x", "y"), g * x + y**2 / 2)])
    'let e = E(x, y)'
    """
    keyword, _, text = line.partition(" ")
    if keyword in FORMULAS:
        return f"{keyword} {shortened(formula_of(checker.parse(text)), definitions)}"
    if keyword in TERMS:
        name, _, value = text.partition(" = ")
        return f"{keyword} {name} = {shortened(term_of(checker.parse(value)), definitions)}"
    return line


def defining_lines(definitions: Sequence[Definition]) -> list[str]:
    """The lines of the definitions, each shortened by those before it, with comments."""
    lines: list[str] = []
    for place, one in enumerate(definitions):
        lines += [
            *map("# {}".format, textwrap.wrap(one.says, WIDTH)),
            one.text(definitions[:place]),
        ]
    return lines


class Reader:
    """A reader that writes definitions out with the checker's own code.

    >>> reader = Reader(["define E(x, y) over g := g*x + y^2/2"])
    >>> reader.long_line("given E(x - 1, 2*y) > 0")
    'given g*(x - 1) + (2*y)^2/2 > 0'
    """

    def __init__(self, lines: Iterable[str]) -> None:
        self.definitions = checker.Definitions(checker.Work(MOST_WORK))
        for line in lines:
            self.definitions.define(line.removeprefix("define "))
        known = self.definitions.known
        self.over = set().union(*(over for _, over, _ in known.values()))
        self._uses = re.compile(rf"\b(?:{'|'.join(known)})\b") if known else re.compile(r"(?!)")
        self._written: dict[str, str] = {}

    def long_line(self, line: str) -> str:
        """The line with definitions written out."""
        keyword, _, text = line.partition(" ")
        if keyword not in FORMULAS + TERMS or not self._uses.search(text):
            return line
        if line not in self._written:
            name, equals, value = text.partition(" = ") if keyword in TERMS else ("", "", text)
            tree = self.definitions.read(value, self.over)
            written_out = term_of(tree) if keyword in TERMS else formula_of(tree)
            self._written[line] = f"{keyword} {name}{equals}{written_out}"
        return self._written[line]
