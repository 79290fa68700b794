"""The file of statements: lines, kinds, and the names that each line may use."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from tests.certificates.reader.syntax import (
    Definition,
    Parser,
    Rejected,
    Tree,
    flat,
    is_name,
    names_in,
    parse_definition,
    require,
    require_formula,
    require_term,
)

ORDERS = {
    "universal": "(forall )?(integer )?((range|given|have|let|root) )*"
    "(exists ((with|let) )*)?show ",
    "sharp": "sharp over domain (number )*holds ",
    "iterates": "forall integer (let )*iterates after ",
    "map": "over (integer )?domain state space (piece )+",
    "relation": "over (integer )?domain state input space (piece )+",
    "descends": "(map|relation) domain (root )*(rank )+(stage )+",
    "contracts": "(map|relation) domain (root )*on point weights rate radius size ",
    "lyapunov": "(map|relation) domain (root )*on point (have )*(value )+loss least upper radius ",
    "unstable": "map domain (root )*point direction (have )*(value )+rate radius upper ",
    "attracts": "descent (contraction|lyapunov) ",
    "into": "descent attraction radius ",
    "escapes": "map domain (root )*point start word ",
    "exactly": "attraction (escape |unstable )+",
    "settles": "descent (never )*(rank word )*(contraction word )+",
    "returns": "map settling (word )+",
}
NAMES = ("forall", "integer", "exists", "over", "state", "input")
FORMULAS = ("range", "given", "have", "with", "show", "domain", "holds", "space", "stage", "on")
TERMS = ("rate", "radius", "size", "loss", "least", "upper")
TUPLES = ("point", "weights", "start", "direction")
OTHERS = {  # the kinds of statements that a line may name
    "map": ("map",),
    "relation": ("relation",),
    "descent": ("descends",),
    "contraction": ("contracts",),
    "lyapunov": ("lyapunov",),
    "attraction": ("attracts", "into"),
    "escape": ("escapes",),
    "unstable": ("unstable",),
    "settling": ("settles",),
}
# the names that a line may use beside those declared before it
OWN = {
    "loss": frozenset({"value"}),
    "least": frozenset({"distance", "level"}),
    "direction": frozenset({"distance"}),
}
STATEMENT_NAME = re.compile(r"[A-Za-z0-9_.-]+/[A-Za-z0-9_.-]+")


class Line(NamedTuple):
    """A keyword and what it says: names, a formula, a term, or several of these."""

    word: str
    says: Any


class Statement(NamedTuple):
    """A statement: its name, its kind, and its lines in order."""

    name: str
    kind: str
    lines: tuple[Line, ...]

    def all(self, word: str) -> list[Any]:
        return [line.says for line in self.lines if line.word == word]

    def one(self, word: str) -> Any:
        (says,) = self.all(word)
        return says

    def names(self, word: str) -> tuple[str, ...]:
        """The names of the one line with this keyword, if there is one."""
        return tuple(name for says in self.all(word) for name in says)


def read_statements(text: str) -> dict[str, Statement]:
    """Every statement of a file, in its order."""
    require(text.isascii(), "statements are ASCII")
    statements: dict[str, Statement] = {}
    known: dict[str, Definition] = {}
    block: list[str] = []
    for line in [*text.split("\n"), ""]:
        if line.startswith("#"):
            continue
        if not block and line.startswith("define "):
            name, definition = parse_definition(line[len("define ") :], known)
            require(name not in known, f"{name} is defined twice")
            known[name] = definition
        elif line:
            block.append(line)
        elif block:
            statement = read_statement(block, known, statements)
            require(statement.name not in statements, f"{statement.name} stands twice")
            statements[statement.name] = statement
            block = []
    return statements


def names_below(
    statement: Statement, earlier: Mapping[str, Statement], states: bool = False
) -> set[str]:
    """The parameters and roots of a statement and of those that it names; with state variables."""
    names = {*statement.names("over"), *(name for name, _ in statement.all("root"))}
    names |= {*statement.names("state")} if states else set()
    for line in statement.lines:
        if line.word in OTHERS:
            names |= names_below(earlier[line.says], earlier, states)
    return names


def read_statement(
    block: list[str], known: Mapping[str, Definition], earlier: Mapping[str, Statement]
) -> Statement:
    word, _, name = block[0].partition(" ")
    require(word == "statement", f"no statement begins with {block[0]!r}")
    require(STATEMENT_NAME.fullmatch(name) is not None, f"{name!r} is no ID/part")
    pairs = [line.partition(" ") for line in block[1:]]
    order = "".join(f"{word} " for word, _, _ in pairs)
    kinds = [kind for kind, wanted in ORDERS.items() if re.fullmatch(wanted, order)]
    require(len(kinds) == 1, f"{name}: no kind of statement has these lines")
    around, moves = kinds[0] in ("lyapunov", "unstable"), kinds[0] == "settles"
    scope = Scope(known, earlier, around, moves)
    lines = tuple(scope.line(word, text) for word, _, text in pairs)
    statement = Statement(name, kinds[0], lines)
    variables = {name for word in ("forall", "exists", "over") for name in statement.names(word)}
    require(set(statement.names("integer")) <= variables, f"{name}: an integer is no variable")
    return statement


class Scope:
    """The names that the lines of one statement have declared."""

    def __init__(
        self,
        known: Mapping[str, Definition],
        earlier: Mapping[str, Statement],
        around: bool = False,
        moves: bool = False,
    ) -> None:
        self.known = known
        self.earlier = earlier
        self.around = around  # whether the lines may speak of a point, and of the gap to it
        self.moves = moves  # whether they may name the state of a descent
        self.near: set[str] = set()
        self.names: set[str] = set()
        self.hidden: set[str] = set()  # of these no definition is over

    def line(self, word: str, text: str) -> Line:
        return Line(word, self._says(word, text))

    def _says(self, word: str, text: str) -> Any:
        if word == "integer":
            return self._listed(text)
        if word in NAMES:
            names = self._listed(text) if text or word not in ("over", "input") else ()
            for name in names:
                self._declare(name, hidden=word == "exists")
            return names
        if word in FORMULAS:
            return require_formula(self._tree(text))
        if word in TERMS:
            return require_term(self._tree(text, OWN.get(word, frozenset())))
        if word in TUPLES:
            return self._parts(text, OWN.get(word, frozenset()))
        if word == "value":
            *guard, term = self._arrow(text) if " -> " in text else [text]
            tree = require_term(self._tree(term))
            return tuple(require_formula(self._tree(one)) for one in guard), tree
        if word == "rank":
            *guard, terms = self._arrow(text) if " -> " in text else [text]
            return tuple(require_formula(self._tree(one)) for one in guard), self._parts(terms)
        if word == "let":
            name, term = self._equation(text)
            tree = require_term(self._tree(term))
            self._declare(name)
            return name, tree
        if word == "root":
            name, value = self._equation(text)
            require(value.startswith("sqrt(") and value.endswith(")"), "a root is sqrt(TERM)")
            tree = require_term(self._tree(value[len("sqrt(") : -1]))
            self._declare(name)
            return name, tree
        if word == "number":
            return self._number(text)
        if word in OTHERS:
            return self._other(word, text)
        if word == "sharp":
            return self._sharp(text)
        if word == "iterates":
            before, after = self._arrow(text)
            state = [tree[1] for tree in self._parts(before) if tree[0] == "name"]
            terms = self._parts(after)
            return tuple(state), terms
        if word == "after":
            before, after = self._arrow(text)
            count, *more = self._parts(before)
            require(count[0] == "name" and not more, "the number of steps is a variable")
            return count[1], self._parts(after)
        if word == "piece":
            before, after = self._arrow(text)
            return require_formula(self._tree(before)), self._parts(after)
        require(
            word in ("word", "never")
            and re.fullmatch(r"[1-9]\d{0,8}( [1-9]\d{0,8})*", text) is not None,
            "pieces",
        )
        return tuple(map(int, text.split()))

    def _listed(self, text: str) -> tuple[str, ...]:
        names = tuple(text.split(" "))
        require(all(map(is_name, names)) and len(set(names)) == len(names), f"names: {text!r}")
        return names

    def _declare(self, name: str, hidden: bool = False) -> None:
        require(is_name(name), f"{name!r} is no name")
        require(name not in self.names and name not in self.known, f"{name} is taken")
        self.names.add(name)
        if hidden:
            self.hidden.add(name)

    def _equation(self, text: str) -> tuple[str, str]:
        name, separator, value = text.partition(" = ")
        require(bool(separator), f"no equation: {text!r}")
        return name, value

    def _arrow(self, text: str) -> list[str]:
        sides = text.split(" -> ")
        require(len(sides) == 2, f"one arrow: {text!r}")
        return sides

    def _tree(self, text: str, own: frozenset[str] = frozenset()) -> Tree:
        parser = Parser(text, self.known)
        tree = parser.disjunction()
        parser.end()
        require(own.isdisjoint(self.known), "a definition of what a line names")
        known = self.names | self.near | own
        require(names_in(tree) <= known, f"{names_in(tree) - known} are not declared")
        require(parser.used <= self.names - self.hidden, "a definition is over other names")
        return tree

    def _parts(self, text: str, own: frozenset[str] = frozenset()) -> tuple[Tree, ...]:
        """Terms with commas between them, in parentheses or not."""
        tree = self._tree(f"({text},)", own)
        return tuple(flat(tree[1:]))

    def _number(self, text: str) -> tuple[str, Tree, Tree, Tree]:
        name, value = self._equation(text)
        require(value.startswith("root(") and value.endswith(")"), "a number is a root")
        parts = self._parts(value[len("root(") : -1])
        require(len(parts) == 3, "a polynomial and two ends")
        self._declare(name)
        return name, parts[0], parts[1], parts[2]

    def _other(self, word: str, name: str) -> str:
        """An earlier statement; parameters and state of a map are declared by naming it.  What a
        descent and an attraction name a radius may name, without definitions.
        """
        kinds = OTHERS[word]
        if name not in self.earlier or self.earlier[name].kind not in kinds:
            raise Rejected(f"{name} is no earlier statement of kind {' or '.join(kinds)}")
        if word in ("descent", "attraction"):
            known = names_below(self.earlier[name], self.earlier, self.moves)
            self.names |= known
            self.hidden |= known
        if word in ("map", "relation"):
            other = self.earlier[name]
            for own in (*other.names("over"), *other.names("state")):
                self._declare(own)
            if self.around:
                ends = ("point", "gap")
                self.near = {f"{name}_{end}" for name in other.names("state") for end in ends}
        return name

    def _sharp(self, text: str) -> tuple[str, ...]:
        names = tuple(text.split(" "))
        for name in names:
            require(
                name in self.earlier and self.earlier[name].kind == "universal",
                f"{name} is no earlier universal statement",
            )
        return names
