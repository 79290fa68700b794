"""Terms and formulas as syntax trees, and definitions, written out where they are used.

Definitions stand at top level, before their first use:

    define NAME(x, y) over r g := BODY

`(x, y)` and `over r g` may be left out.  BODY is a term, a formula, or a tuple of terms.  It names
its parameters, the names after `over`, and earlier definitions; of the first two it uses all.
NAME(a, b) is BODY with the terms a and b for x and y.  A tuple among the arguments stands for its
parts: with `define f(x, y) := (x - y, y)`, E(f(x, y)) is E(x - y, y).  The names after `over` are
those of the statement that uses the definition, which has declared them on a line above: by forall,
over, state, let, root or number, not by exists.  A definition is written out wherever it is used,
on lines about maps too, before anything else reads the line.  So it adds nothing to what can be
said: a division in it has to be licensed where it is used.  The name of a definition is never that
of a variable or parameter.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from keyword import kwlist
from typing import Any

from .algebra import Kind, Rational, Rejected, Work, require

MAX_TEXT = 1 << 18  # letters of a term or formula: its syntax tree takes some 500 bytes for each

# --------------------------------- text: Python's expression syntax, with ^ and = as in mathematics

WORDS = {*kwlist, "implies", "iff"}  # never names: `names_in` does not count them
RESERVED = WORDS | {"sqrt", "root"}

# sums of products of a number, which may come first, and powers of names
PRODUCT = r"(?:(?:0|[1-9]\d{0,60})(?:/[1-9]\d{0,60})?|NAME)(?:\*NAME)*"
FLAT = re.compile(
    f"-?{PRODUCT}(?: [+-] {PRODUCT})*".replace("NAME", r"[A-Za-z]\w*(?:\^[1-9]\d{0,3})?"), re.ASCII
)
NUMBER = re.compile(r"-?\d{1,4000}(/0*[1-9]\d{0,3999})?", re.ASCII)


def parse(text: object) -> ast.expr:
    """The syntax tree of a term or formula."""
    if not isinstance(text, str) or len(text) > MAX_TEXT:
        raise Rejected(Kind.TEXT, text)
    return tree(text) if len(text) < 200 else tree.__wrapped__(text)  # what is kept is small


@lru_cache(4096)
def tree(text: str) -> ast.expr:
    # Python's own **, //, <<, ==, 0x1f, 1_0 and 1j are refused: a text has one reading only
    foreign = re.search(r"[^\w +\-*/^()<>=!,]|\*\*|//|<<|>>|==|<>|\b\d+[A-Za-z_]", text, re.ASCII)
    require(not foreign, Kind.TEXT, text)
    try:
        python = re.sub(r"(?<![<>!])=", "==", text.replace("^", "**")).strip()
        return ast.parse(python, mode="eval").body
    except Exception:  # SyntaxError, and what a deep text raises, by the version of Python
        raise Rejected(Kind.TEXT, text) from None


def written(node: ast.AST) -> str:
    """The text of a tree, which `parse` reads back as the same tree: one thing, whatever stands
    around it in parentheses.
    """
    return ast.unparse(node).replace(" ** ", "^").replace("==", "=")


def row_text(keyword: str, said: Any) -> str:
    """The text of a line `let`, `root`, `domain` or `have`."""
    if keyword in ("domain", "have"):
        return written(said)
    name, value = said
    return f"{name} = " + (written(value) if keyword == "let" else f"sqrt({written(value[0])})")


def names_in(*texts: str) -> set[str]:
    """The names that occur in terms or formulas."""
    return set(re.findall(r"[A-Za-z_]\w*", " ".join(texts))) - WORDS


def names_of(node: ast.expr) -> list[str]:
    """The names in a tree, sorted."""
    names: set[str] = set()
    nodes: list[ast.AST] = [node]
    while nodes:
        part = nodes.pop()
        if isinstance(part, ast.Name):
            names.add(part.id)
        elif isinstance(part, ast.BinOp):
            nodes += [part.left, part.right]
        elif not isinstance(part, ast.Constant):
            nodes += ast.iter_child_nodes(part)
    return sorted(names)


def exponent(node: ast.BinOp) -> int:
    """The exponent of a power: an integer as it stands."""
    if isinstance(node.right, ast.Constant) and type(node.right.value) is int:
        return node.right.value
    raise Rejected(Kind.TERM, ast.unparse(node))


def summands(text: str) -> list[tuple[int, int, list[str]]]:
    """Of a text like 3/4*x^2*y - x + 1, (upper, lower part of its number, powers of names) of each
    summand, as `parse` reads it, without a tree; none for any other text.
    """
    found = []
    if len(text) <= MAX_TEXT and FLAT.fullmatch(text):
        for summand in text.replace(" - ", " + -").split(" + "):
            first, *powers = summand.removeprefix("-").split("*")
            if not first[0].isdigit():  # the first alone can be a number, in such a text
                first, powers = "1", [first, *powers]
            upper, _, lower = first.partition("/")
            whole = -int(upper) if summand[0] == "-" else int(upper)
            found.append((whole, int(lower or 1), powers))
    return found


def put(text: str, values: Mapping[str, str]) -> str:
    """The text with other text in place of some names."""
    return re.sub(r"[A-Za-z]\w*", lambda found: values.get(found[0], found[0]), text)


def rational(value: object) -> Rational:
    """An exact rational: an int, or the text p or p/q."""
    if type(value) is int:  # not isinstance: True is no number
        return value
    if not isinstance(value, str) or not NUMBER.fullmatch(value):
        raise Rejected(Kind.RATIONAL, value)
    upper, _, lower = value.partition("/")
    return Fraction(int(upper), int(lower)) if lower else int(upper)


def rows(text: str) -> Iterator[tuple[int, str, str]]:
    """(number, keyword, what follows it) of each line of a file of statements; of a blank line both
    are empty, and a comment, which starts with #, is left out.

    Every reader of such a file reads its lines here, so that no two can differ on what is a line.
    """
    for count, line in enumerate(text.split("\n"), 1):
        if line.startswith(" "):  # to one who reads it could be a part of the line above
            raise Rejected(Kind.LINE_SHAPE, line, f"statements, line {count}")
        if not line.startswith("#"):
            keyword, _, rest = line.partition(" ")
            yield count, keyword, rest


# ------------------------------------------------------------ definitions


class Definitions:
    """The definitions of a file so far, and the names that may not be theirs."""

    def __init__(self, work: Work) -> None:
        self.work = work
        self.known: dict[str, tuple[list[str], set[str], ast.expr]] = {}
        # name: (parameters, names it is over, body as a tree, written out)
        self.bound: set[str] = set()  # every name of a variable or parameter so far

    def bind(self, name: str) -> None:
        """A variable or parameter must not have the name of a definition: else a line would say
        one thing to who knows the definition, and another to who sees the variable.
        """
        require(name not in self.known, Kind.SHADOWS, name)
        self.bound.add(name)

    def define(self, text: str) -> None:
        """Reads what follows the keyword `define`."""
        pattern = r"([A-Za-z]\w*)(?:\(([\w, ]+)\))?(?: over (\w+(?: \w+)*))? := (.+)"
        head = re.fullmatch(pattern, text, re.ASCII)
        if not head:
            raise Rejected(Kind.DEFINITION, text)
        name, inner, outer, body = head.groups()
        taken = name in self.known or name in self.bound or name in RESERVED
        require(not taken, Kind.REDEFINED, name)
        parameters = [one.strip() for one in inner.split(",")] if inner else []
        over = outer.split() if outer else []
        for one in [*parameters, *over]:
            require(re.fullmatch(r"[A-Za-z]\w*", one) and one not in RESERVED, Kind.NAME, one)
            self.bind(one)
        own = {*parameters, *over}
        # one name in both lists would be put in place of what the statement means by it
        require(len(own) == len(parameters) + len(over) and name not in own, Kind.NAME, name)
        # the name itself is not yet known: so there is no recursion, of one or of several
        loose = names_in(body) - own - self.known.keys()
        require(not loose, Kind.LOOSE, ", ".join(sorted(loose)))
        out = self.write_out(parse(body), {}, set(over))
        # an argument that is not used would never be looked at: 1/0, a formula, any name
        unused = own - {node.id for node in ast.walk(out) if isinstance(node, ast.Name)}
        require(not unused, Kind.UNUSED, ", ".join(sorted(unused)))
        self.known[name] = parameters, set(over), out

    def occur_in(self, text: str) -> set[str]:
        """The definitions that a text names."""
        return self.known.keys() & names_in(text) if self.known else set()

    def read(self, text: str, declared: set[str]) -> ast.expr:
        """The tree of a term or formula, with definitions written out; declared: the names that a
        definition may be over.
        """
        used = self.occur_in(text)

        def tree() -> ast.expr:
            self.work.room -= 5 * len(text)  # see MAX_TEXT
            return self.write_out(parse(text), {}, declared) if used else parse(text)

        # what a definition says never changes, and no name in it is that of a later one; that it
        # may be used here is asked for each time, or refused by `apply`
        key = (text, frozenset(used)) if used else text
        return self.work.once(key, tree, lambda _: all(self.known[x][1] <= declared for x in used))

    def write_out(
        self, node: ast.expr, values: Mapping[str, ast.expr], declared: set[str]
    ) -> ast.expr:
        """A copy of a tree, with trees in place of names, and definitions written out.  Every node
        is made anew and counted, so that definitions of definitions cannot double without end.
        """
        self.work.spend(40)

        def copies(nodes: Sequence[ast.expr]) -> list[ast.expr]:
            return [self.write_out(one, values, declared) for one in nodes]

        if isinstance(node, ast.Constant):
            return node
        if isinstance(node, ast.Name) and node.id in values:
            # what is put in was written out before: it is copied, and no name in it is replaced
            return self.write_out(values[node.id], {}, declared)
        if isinstance(node, ast.Name):
            return self.apply(node, [], declared) if node.id in self.known else node
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
            arguments = copies(node.args)
            if node.func.id in self.known:
                return self.apply(node.func, arguments, declared)
            return ast.Call(node.func, arguments, [])
        if isinstance(node, ast.UnaryOp):
            return ast.UnaryOp(node.op, *copies([node.operand]))
        if isinstance(node, ast.BinOp):
            left, right = copies([node.left, node.right])
            return ast.BinOp(left, node.op, right)
        if isinstance(node, ast.BoolOp):
            return ast.BoolOp(node.op, copies(node.values))
        if isinstance(node, ast.Compare):
            left, *others = copies([node.left, *node.comparators])
            return ast.Compare(left, node.ops, others)
        if isinstance(node, ast.Tuple):
            return ast.Tuple(copies(node.elts), node.ctx)
        raise Rejected(Kind.TEXT, ast.unparse(node))

    def apply(self, head: ast.Name, arguments: Sequence[ast.expr], declared: set[str]) -> ast.expr:
        """The body of a definition, with the arguments in place of its parameters."""
        parameters, over, body = self.known[head.id]
        terms: list[ast.expr] = []
        for one in arguments:
            terms += one.elts if isinstance(one, ast.Tuple) else [one]
        require(len(terms) == len(parameters), Kind.ARGUMENTS, head.id)
        for one in terms:
            require(not is_formula(one), Kind.TERM, lambda one=one: written(one))
        # a name of the body means what the statement has declared: never a parameter of the
        # definition around it, never what a certificate may choose
        require(over <= declared, Kind.OVER, f"{head.id}: {', '.join(sorted(over - declared))}")
        return self.write_out(body, dict(zip(parameters, terms)), declared)


def is_formula(node: ast.expr) -> bool:
    """Whether a tree, with definitions written out, can only be a formula."""
    negation = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    return negation or isinstance(node, (ast.Compare, ast.BoolOp, ast.Call))
