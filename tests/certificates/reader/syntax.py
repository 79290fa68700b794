"""Terms and formulas: tokens, a parser by recursive descent, and definitions written out.

A node of the tree is a tuple: `("number", n)`, `("name", x)`, `("-", a)`, `("^", a, n)`,
`("+" "-" "*" "/", a, b)`, `("tuple", a, ..)`, `("call", x, a, ..)`; and of formulas
`("<" "<=" ">" ">=" "=" "!=", a, b)`, `("not", f)`, `("and" "or", f, g)`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from keyword import iskeyword
from typing import Any, NamedTuple

Tree = tuple[Any, ...]  # each tag has its own length and types, as above

RELATIONS = ("<", "<=", ">", ">=", "=", "!=")
WORDS = ("and", "or", "not", "implies", "iff")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
TOKEN = re.compile(
    r" *(?:(0+|[1-9][0-9]*)(?![A-Za-z_0-9])|([A-Za-z][A-Za-z0-9_]*)|(<=|>=|!=|[-+*/^()<>=,]))"
)
MAX_DEGREE = 4000  # no greater exponent
MAX_SIZE = 65536  # no term of more parts


class Rejected(Exception):
    """What is read is not a statement, or not a certificate of it."""


def require(holds: bool, reason: str) -> None:
    if not holds:
        raise Rejected(reason)


def tokens_of(text: str) -> list[str]:
    tokens, at, end = [], 0, len(text.rstrip(" "))
    while at < end:
        found = TOKEN.match(text, at)
        if found is None:
            raise Rejected(f"unreadable: {text[at : at + 20]!r}")
        tokens.append(found[found.lastindex or 0])
        at = found.end()
    return tokens


def is_name(text: str) -> bool:
    return NAME.fullmatch(text) is not None and text not in WORDS and not iskeyword(text)


def is_formula(tree: Tree) -> bool:
    return tree[0] in RELATIONS or tree[0] in ("and", "or", "not")


def require_term(tree: Tree) -> Tree:
    require(not is_formula(tree) and tree[0] != "tuple", "a term was expected")
    return tree


def require_formula(tree: Tree) -> Tree:
    require(is_formula(tree), "a formula was expected")
    return tree


class Parser:
    """One method for each rank of operators, from the loosest; `known` are the definitions."""

    def __init__(
        self, text: str, known: Mapping[str, Definition], exponents: Iterable[str] = ()
    ) -> None:
        self.tokens = tokens_of(text)
        self.exponents = tuple(exponents)  # parameters of the definition that is read
        self.at = 0
        self.known = known
        self.size = 0  # of definitions that are written out
        self.used: set[str] = set()  # what definitions take from the statement

    def next(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        token = self.next()
        self.at += 1
        return token

    def accept(self, *tokens: str) -> str:
        return self.take() if self.next() in tokens and self.next() else ""

    def expect(self, token: str) -> None:
        require(self.take() == token, f"{token!r} was expected")

    def end(self) -> None:
        require(self.at == len(self.tokens), f"{self.next()!r} is left over")

    def disjunction(self) -> Tree:
        left = self.conjunction()
        while self.accept("or"):
            left = ("or", require_formula(left), require_formula(self.conjunction()))
        return left

    def conjunction(self) -> Tree:
        left = self.negation()
        while self.accept("and"):
            left = ("and", require_formula(left), require_formula(self.negation()))
        return left

    def negation(self) -> Tree:
        if self.accept("not"):
            return ("not", require_formula(self.negation()))
        return self.chain()

    def chain(self) -> Tree:
        left = self.sum()
        links: list[Tree] = []
        while sign := self.accept(*RELATIONS):
            right = self.sum()
            links.append((sign, require_term(left), require_term(right)))
            left = right
        tree = links[0] if links else left
        for link in links[1:]:
            tree = ("and", tree, link)
        return tree

    def sum(self) -> Tree:
        left = self.product()
        while sign := self.accept("+", "-"):
            left = (sign, require_term(left), require_term(self.product()))
        return left

    def product(self) -> Tree:
        left = self.negative()
        while sign := self.accept("*", "/"):
            left = (sign, require_term(left), require_term(self.negative()))
        return left

    def negative(self) -> Tree:
        if self.accept("-"):
            return ("-", require_term(self.negative()))
        return self.power()

    def power(self) -> Tree:
        base = self.atom()
        if self.accept("^"):
            exponent = self.take()
            require(self.next() != "^", "a power of a power has no parentheses")
            if exponent in self.exponents:
                return ("^", require_term(base), ("name", exponent))
            require(exponent.isdigit() and len(exponent) < 9, "an exponent is an integer")
            return power(require_term(base), ("number", int(exponent)))
        return base

    def atom(self) -> Tree:
        token = self.take()
        if token.isdigit():
            return ("number", int(token))
        if token == "(":
            parts = [self.disjunction()]
            is_tuple = False
            while self.accept(","):
                is_tuple = True
                if self.next() == ")":
                    break
                parts.append(self.disjunction())
            self.expect(")")
            if not is_tuple:
                return parts[0]
            return ("tuple", *flat(parts))
        if token in ("implies", "iff"):
            self.expect("(")
            first = require_formula(self.disjunction())
            self.expect(",")
            second = require_formula(self.disjunction())
            self.expect(")")
            forth: Tree = ("or", ("not", first), second)
            return forth if token == "implies" else ("and", forth, ("or", first, ("not", second)))
        require(is_name(token), f"{token!r} was not expected")
        if token not in self.known:
            require(self.next() != "(", f"{token} has no definition")
            return ("name", token)
        arguments: list[Tree] = []
        definition = self.known[token]
        if definition.parameters:
            self.expect("(")
            arguments.append(self.disjunction())
            while self.accept(","):
                arguments.append(self.disjunction())
            self.expect(")")
        arguments = flat(arguments)
        require(len(arguments) == len(definition.parameters), f"the arguments of {token}")
        self.used |= set(definition.over)
        terms = dict(zip(definition.parameters, arguments))
        sizes = {name: size(term, {}) for name, term in terms.items()}
        self.size += size(definition.body, sizes)
        require(self.size <= MAX_SIZE, "definitions grow without end")
        return substitute(definition.body, terms)


class Definition(NamedTuple):
    """A name for a term, a formula or a tuple."""

    parameters: tuple[str, ...]
    over: tuple[str, ...]
    body: Tree


def flat(parts: Iterable[Tree]) -> list[Tree]:
    """The terms, with those of a tuple in place of it."""
    terms: list[Tree] = []
    for part in parts:
        terms += part[1:] if part[0] == "tuple" else [require_term(part)]
    return terms


def names_in(tree: Tree) -> set[str]:
    if tree[0] == "name":
        return {tree[1]}
    return set().union(*(names_in(part) for part in tree[1:] if isinstance(part, tuple)))


def size(tree: Tree, sizes: Mapping[str, int]) -> int:
    """The number of parts, with terms of some sizes in place of names."""
    if tree[0] == "name":
        return sizes.get(tree[1], 1)
    return 1 + sum(size(part, sizes) for part in tree[1:] if isinstance(part, tuple))


def power(base: Tree, exponent: Tree) -> Tree:
    require(
        exponent[0] == "number" and exponent[1] <= MAX_DEGREE, "no exponent, or too great a one"
    )
    return ("^", base, exponent[1])


def substitute(tree: Tree, terms: Mapping[str, Tree]) -> Tree:
    if tree[0] == "name":
        return terms.get(tree[1], tree)
    if not terms:
        return tree
    if tree[0] == "^" and isinstance(tree[2], tuple):
        base, exponent = substitute(tree[1], terms), substitute(tree[2], terms)
        return ("^", base, exponent) if exponent[0] == "name" else power(base, exponent)
    return tuple(substitute(part, terms) if isinstance(part, tuple) else part for part in tree)


def renamed(tree: Tree, names: Mapping[str, str]) -> Tree:
    return substitute(tree, {old: ("name", new) for old, new in names.items()})


def parse_definition(line: str, known: Mapping[str, Definition]) -> tuple[str, Definition]:
    """`NAME(x, y) over a b := BODY`."""
    head, separator, body = line.partition(":=")
    require(bool(separator), "a definition has :=")
    found = re.fullmatch(
        r"([A-Za-z]\w*)(?:\(([A-Za-z]\w*(?:, [A-Za-z]\w*)*)\))?(?: over((?: [A-Za-z]\w*)+))? ",
        head,
        re.ASCII,
    )
    if found is None:
        raise Rejected(f"no head of a definition: {head!r}")
    name = found[1]
    parameters = tuple(found[2].split(", ")) if found[2] else ()
    over = tuple(found[3].split()) if found[3] else ()
    own = {*parameters, *over}
    require(len(own) == len(parameters) + len(over), f"{name}: a name stands twice")
    require(all(map(is_name, (name, *own))), f"{name}: a word is no name")
    require(not {name, *own} & {"sqrt", "root"}, f"{name}: sqrt and root have a meaning")
    taken = {other for one in known.values() for other in (*one.parameters, *one.over)}
    require(name not in own | taken and not own & set(known), f"{name}: a name is taken")
    parser = Parser(body, known, parameters)
    tree = parser.disjunction()
    parser.end()
    require(names_in(tree) | parser.used == own, f"{name}: the body names other things")
    return name, Definition(parameters, over, tree)
