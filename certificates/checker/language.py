"""What an auditor's file means: statements, and statements over polynomials.

A file is a list of lines, as `rows` reads them.  `statement ID/part` begins a statement, a blank
line ends it; the lines between say what it is (`LINES` and `ORDERS`).  Terms and formulas are
written with integers, names, + - * / ^, < <= = != >= >, and, or, not, implies(,), iff(,).
Definitions: see `text.py`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import partial
from math import prod
from typing import Any, TypeVar

from .algebra import (
    BITS,
    MASK,
    MAX_BITS,
    MAX_DEGREE,
    MAX_VARIABLES,
    ONE,
    Formula,
    Key,
    Kind,
    Licence,
    Monomial,
    Op,
    Poly,
    Rational,
    Rejected,
    Under,
    Work,
    bits_of,
    conjuncts,
    fold,
    join,
    licence_of,
    merged,
    negate,
    number,
    require,
    sum_of_monomials,
    sum_of_products,
    variable,
)
from .text import WORDS, Definitions, exponent, names_of, parse, row_text, rows, summands, written

Range = Sequence[ast.expr]  # the domain of a sharp range, and its condition
Reader = Callable[[str], ast.expr]
Known = Mapping[str, "Statement"]
T = TypeVar("T")
Said = Any  # what a line says: as `LINES` reads its keyword

PER_FACTOR = 4  # work: of a factor of a term, or a name

OPERATORS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=", ast.NotEq: "!="}


# ------------------------------------------------------------ what has been declared


class Context:
    """What has been declared so far: variables, the values of names, and the polynomials that a
    strict line made nonzero.

    index: {key: number of the variable}; integers: the keys of integer variables; values: {name:
    polynomial, or quotient of such}; licensed: {key of a polynomial: licence}; asked: what was
    found in it, see `once`; work: the meter of the check, which an inner context shares.
    """

    def __init__(
        self,
        outer: Context | None = None,
        values: Mapping[str, Poly] | None = None,
        work: Work | None = None,
    ) -> None:
        self.work: Work = outer.work if outer else work or Work()
        self.index: dict[str, int] = dict(outer.index) if outer else {}
        self.integers: set[str] = set(outer.integers) if outer else set()
        self.licensed: dict[Key, Licence] = dict(outer.licensed) if outer else {}
        self.asked: dict[Key, Licence | None] = {}
        if values is None:
            values = outer.values if outer else {}
        self.work.spend(len(self.index) + len(self.licensed) + len(values))  # else copies are free
        self.values: dict[str, Poly] = dict(values)

    def number(self, value: Rational) -> Poly:
        """A rational number as a polynomial of this check."""
        return number(value, self.work)

    def declare(self, name: str, integral: bool = False) -> None:
        """A fresh variable; where another scope has one of this name, its key grows by underscores,
        so that the two stay apart.
        """
        key = name
        while key in self.index:
            key += "_"
        place = len(self.index)
        require(place < MAX_VARIABLES, Kind.VARIABLES, name)  # `places` looks at so many
        self.define(name, variable(place, self.work))
        self.index[key] = place
        if integral:
            self.integers.add(key)

    def define(self, name: str, value: Poly) -> None:
        """A name for a value.  A word is no name: `names_in` would not see it in a premise."""
        self.work.spend(2 * PER_FACTOR)
        fresh = name not in self.values and name not in WORDS
        require(fresh and re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII), Kind.NAME, name)
        self.values[name] = value

    def license(self, formula: Formula) -> None:
        """A strict line, at top level or inside a top-level `and`, makes its polynomial nonzero
        (and tells its sign).  What stands in a disjunction licenses nothing.
        """
        for part in conjuncts(formula):
            if isinstance(part, bool) or part[0] != "atom" or part[2] not in (">", "!="):
                continue
            line = part[1], part[2] == ">"
            key, licence = self.work.once(("licence", *line), partial(licence_of, *line))
            if key not in self.licensed or licence[1] and not self.licensed[key][1]:
                self.licensed[key] = licence

    def reciprocal(self, node: ast.expr) -> Poly:
        """1 / node, where node is a nonzero number, licensed as a whole, or a product or power of
        such.
        """
        value = self.value(node)
        require(value.terms, Kind.ZERO_DIVISION, lambda: ast.unparse(node))
        if constant := value.constant():
            return self.number(1 / constant)
        content, poly = value.primitive()
        key = frozenset(poly.terms.items())
        licence = self.asked[key] = self.licensed.get(key)
        if licence or poly.constant():
            sign = -1 if licence and licence[0].terms != poly.terms else 1
            upper = self.number(Fraction(sign * value.den, content))
            if value.under:
                upper *= self.number(1).numerator(value.under)
            return upper.over({licence: 1} if licence else {})
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
            return self.reciprocal(node.left) * self.reciprocal(node.right)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            return self.reciprocal(node.left) ** exponent(node)
        raise Rejected(Kind.DIVISION, self.show(value))

    def value(self, node: ast.expr) -> Poly:
        """The value of a term."""
        if isinstance(node, ast.BinOp):  # the text has no operator but + - * / ^
            if isinstance(node.op, (ast.Add, ast.Sub)):
                return self.sum(node)
            if isinstance(node.op, ast.Pow):
                return self.value(node.left) ** exponent(node)
            return self.product(node)
        if isinstance(node, ast.Name):
            if node.id in self.values:
                return self.values[node.id]
            raise Rejected(Kind.UNDECLARED, node.id)
        if isinstance(node, ast.Constant) and type(node.value) is int:
            return self.number(node.value)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -self.value(node.operand)
        raise Rejected(Kind.TERM, ast.unparse(node))

    def sum(self, node: ast.expr) -> Poly:
        """The value of a chain of + and -, which is added up at once."""
        summands: list[tuple[int, ast.expr]] = []
        while isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
            summands.append((1 if isinstance(node.op, ast.Add) else -1, node.right))
            node = node.left
        total = self.value(node)
        values = [(sign, self.value(summand), ONE) for sign, summand in reversed(summands)]
        if not (total.under or any(value.under for _, value, _ in values)):
            return sum_of_products([(1, total, ONE), *values], self.work)
        for sign, value, _ in values:
            total = total.plus(value, sign)
        return total

    def product(self, node: ast.expr) -> Poly:
        """The value of a chain of * and /: of numbers and variables at once, then of the rest."""
        upper = lower = 1
        monomial = degree = 0
        under: Under = {}
        others: list[Poly] = []
        factors, count = [node], 0
        while factors:
            node = factors.pop()
            count += 1
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
                factors += [node.right, node.left]
                continue
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
                factors.append(node.left)
                value = self.reciprocal(node.right)
            else:
                value = self.value(node)
            if len(value.terms) != 1:
                others.append(value)
                continue
            if value.under:
                self.work.spend(len(under) + len(value.under))
                under = merged(sum, under, value.under)
            ((m, c),) = value.terms.items()
            monomial += m
            degree += value.deg
            if not c == value.den == 1:
                upper *= c
                lower *= value.den
                # a long product of constants would grow unseen
                size = max(upper.bit_length(), lower.bit_length())
                self.work.spend(size * size >> 16)
                require(size <= MAX_BITS, Kind.SIZE, f"{size} bits")
        self.work.spend(PER_FACTOR * count)  # a statement is unfolded as often as it is used
        first = Poly({monomial: upper}, lower, degree, bits_of(upper), self.work, under)
        alone = others and (monomial, upper, lower, under) == (0, 1, 1, {})
        return prod(others[1:], start=others[0]) if alone else prod(others, start=first)

    def polynomial(self, text: str) -> Poly:
        """The value of a term without quotients."""
        self.work.spend(20)
        monomials = self.monomials(text) if isinstance(text, str) else []
        if monomials:
            return sum_of_monomials(monomials, self.work)
        tree = parse(text)
        self.work.spend(len(text))
        value = self.value(tree)
        require(not value.under, Kind.POLYNOMIAL, text)
        return value

    def once(self, read: Callable[[Context, ast.expr], T], node: ast.expr) -> T:
        """What a tree says here.  That depends on the values of its names and on what the licences
        say to each division in it, in turn.
        """
        names = self.work.once(node, partial(names_of, node))
        self.work.spend(len(names))
        self.asked = {}

        # compared up to the first that differs, which `make` would come to as well
        def fits(found: tuple[T, dict[Key, Licence | None]]) -> bool:
            return all(self.licensed.get(key) is one for key, one in found[1].items())

        key = (read, node, *map(self.values.get, names))
        return self.work.once(key, lambda: (read(self, node), {**self.asked}), fits)[0]

    def monomials(self, text: str) -> list[Monomial]:
        """The monomials of a text that `summands` reads, as `product` reads them; none where a name
        is no variable: such a text is left to `value`.
        """
        monomials: list[Monomial] = []
        read: dict[str, tuple[int, int]] = {}  # of each power, its monomial and degree
        for upper, lower, powers in summands(text):
            m = degree = 0
            for power in powers:
                if power not in read:
                    name, _, e = power.partition("^")
                    value = self.values.get(name)
                    if not value or value.den != 1 or value.under or [*value.terms.values()] != [1]:
                        return []
                    (one,) = value.terms
                    read[power] = one * int(e or 1), value.deg * int(e or 1)
                    if read[power][1] > MAX_DEGREE:
                        return []
                more, count = read[power]
                m += more
                degree += count
            monomials.append((m, upper, lower, degree))
        self.work.spend(PER_FACTOR * len(text))
        return monomials

    def atom(self, left: Poly, relation: str, right: Poly) -> Formula:
        """left relation right as p > 0, p >= 0, p = 0 or p != 0: the difference times what is
        positive wherever it is defined.
        """
        if "<" in relation:
            left, right = right, left
            relation = relation.replace("<", ">")
        value = left - right
        # over an odd power of what may be negative, the numerator has not the sign of the quotient
        under = value.under.items() if ">" in relation else ()
        signless = [poly for (poly, positive), e in under if e % 2 and not positive]
        return fold(prod(signless, start=value.over({})), relation)

    def formula(self, node: ast.expr) -> Formula:
        """The formula with `not` driven down to atoms: ("atom", p, relation), ("and", ..), ("or",
        ..) or a bool.
        """
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            return negate(self.formula(node.operand))
        if isinstance(node, ast.BoolOp):
            op: Op = "and" if isinstance(node.op, ast.And) else "or"
            return join(op, [self.formula(part) for part in node.values])
        if isinstance(node, ast.Compare) and all(type(op) in OPERATORS for op in node.ops):
            sides = [self.value(side) for side in (node.left, *node.comparators)]
            signs = [OPERATORS[type(op)] for op in node.ops]
            return join("and", [self.atom(*atom) for atom in zip(sides, signs, sides[1:])])
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            word = node.func.id
            if word in ("implies", "iff") and len(node.args) == 2 and not node.keywords:
                left, right = map(self.formula, node.args)
                forth = join("or", [negate(left), right])
                if word == "implies":
                    return forth
                return join("and", [forth, join("or", [left, negate(right)])])
        raise Rejected(Kind.FORMULA, ast.unparse(node))

    def show(self, poly: Poly) -> str:
        """A polynomial as text that `parse` reads."""
        self.work.spend(len(poly.terms) * (PER_FACTOR + len(self.index)))
        parts = []
        for m in sorted(poly.terms, reverse=True):
            factors = [str(Fraction(poly.terms[m], poly.den))]
            for name, place in self.index.items():
                if exponent := m >> (BITS * place) & MASK:
                    factors.append(name if exponent == 1 else f"{name}^{exponent}")
            parts.append("*".join(factors))
        return re.sub(r"\b1\*(?=[A-Za-z])", "", " + ".join(parts)).replace("+ -", "- ") or "0"


def variables_of(context: Context, poly: Poly) -> set[str]:
    """The keys of the variables that occur."""
    places = poly.places()
    return {key for key, place in context.index.items() if place in places}


def univariate(context: Context, poly: Poly, name: str) -> list[int]:
    """The coefficients of a polynomial in one variable, from the constant up, up to the positive
    factor that the denominator is.
    """
    alone = not poly.under and variables_of(context, poly) == {name}
    require(alone, Kind.ONE_VARIABLE, lambda: f"{name}: {context.show(poly)}")
    shift = BITS * context.index[name]
    return [poly.terms.get(k << shift, 0) for k in range((max(poly.terms) >> shift) + 1)]


# ------------------------------------------------------------ lines and statements


def equation(text: str, read: Reader) -> tuple[str, ast.expr]:
    """NAME = TERM: the name and the term."""
    name, _, said = text.partition(" = ")
    return name, read(said)


def call(text: str, read: Reader, shape: str) -> tuple[str, list[ast.expr]]:
    """NAME = sqrt(term), or NAME = root(polynomial, low, high), as the shape says: the name and the
    arguments.
    """
    name, node = equation(text, read)
    word, _, arguments = shape.partition("(")
    if not isinstance(node, ast.Call) or ast.unparse(node.func) != word or node.keywords:
        raise Rejected(Kind.CALL, f"{shape}: {text}")
    require(len(node.args) == len(arguments.split(", ")), Kind.CALL, f"{shape}: {text}")
    return name, node.args


def listed(text: str, read: Reader) -> list[str]:
    """TERM, or TERM, TERM, ..: each as text."""
    node = read(text)
    return [written(part) for part in (node.elts if isinstance(node, ast.Tuple) else [node])]


def mapping(text: str, read: Reader) -> tuple[list[str], list[str]]:
    """NAMES -> TERMS or GUARD -> TERMS, as text: what the terms are the next state of, or where
    they are.
    """
    left, right = text.split(" -> ")
    return listed(left, read), listed(right, read)


def pieces(text: str, read: Reader) -> list[int]:
    """Numbers of pieces, each as it is written in one way only."""
    numbers = [int(k) for k in text.split()]
    require(text == " ".join(map(str, numbers)), Kind.LINE_SHAPE, text)
    return numbers


def guarded(text: str, read: Reader) -> tuple[list[str], list[str]]:
    """TERMS, or GUARD -> TERMS, as text."""
    return mapping(text, read) if " -> " in text else ([], listed(text, read))


NAMED = {  # the kinds of statements that a line may name
    "map": ["map"],
    "relation": ["relation"],
    "descent": ["descends"],
    "contraction": ["contracts"],
    "lyapunov": ["lyapunov"],
    "attraction": ["attracts", "into"],
    "escape": ["escapes"],
    "unstable": ["unstable"],
    "settling": ["settles"],
}
LINES = {  # how what follows each keyword is read
    **dict.fromkeys(
        ("forall", "integer", "exists", "over", "sharp", "state", "input"),
        lambda text, read: text.split(),
    ),
    "let": equation,
    "root": lambda text, read: call(text, read, "sqrt(term)"),
    "number": lambda text, read: call(text, read, "root(polynomial, low, high)"),
    **dict.fromkeys(
        ("range", "given", "have", "with", "show", "domain", "holds"), lambda text, read: read(text)
    ),
    **dict.fromkeys(("iterates", "after", "piece"), mapping),
    **dict.fromkeys(("value", "rank"), guarded),
    **dict.fromkeys(("word", "never"), pieces),
    **dict.fromkeys(NAMED, lambda text, read: text),
    **dict.fromkeys(
        ("space", "stage", "on", "rate", "radius", "size", "loss", "least", "upper"),
        lambda text, read: written(read(text)),
    ),
    **dict.fromkeys(("point", "weights", "start", "direction"), listed),
}
# what only these lines may name, beside parameters, state and roots
OWN = {"loss": ["value"], "least": ["distance", "level"], "direction": ["distance"]}
# the lines that each kind of statement has, in this order, so that none can be overlooked
ORDERS = {
    "universal": (
        r"(forall )?(integer )?((range|given|have|let|root) )*(exists ((with|let) )*)?show "
    ),
    "sharp": r"sharp over domain (number )*holds ",
    "iterates": r"forall integer (let )*iterates after ",
    "map": r"over (integer )?domain state space (piece )+",
    "relation": r"over (integer )?domain state input space (piece )+",
    "descends": r"(map|relation) domain (root )*(rank )+(stage )+",
    "contracts": r"(map|relation) domain (root )*on point weights rate radius size ",
    "lyapunov": (
        r"(map|relation) domain (root )*on point (have )*(value )+loss least upper radius "
    ),
    "attracts": r"descent (contraction|lyapunov) ",
    "into": r"descent attraction radius ",
    "escapes": r"map domain (root )*point start word ",
    "unstable": r"map domain (root )*point direction (have )*(value )+rate radius upper ",
    "exactly": r"attraction (escape |unstable )+",
    "settles": r"descent (never )*(rank word )*(contraction word )+",
    "returns": r"map settling (word )+",
}


class Statement:
    """One statement: its name, its lines in order as (keyword, what it says), and its kind, which
    their order tells.

    texts: what stands in the file after each keyword; plain: the same with definitions written out.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.lines: list[tuple[str, Said]] = []
        self.texts: list[str] = []
        self.plain: list[str] = []
        self.kind = ""
        self.declared: set[str] = set()  # the names that a definition may be over

    def get(self, keyword: str) -> list[Said]:
        """What each line of this keyword says."""
        return [said for key, said in self.lines if key == keyword]

    def rows(self, keyword: str) -> list[str]:
        """The text of each line of this keyword, with definitions written out."""
        return [text for (key, _), text in zip(self.lines, self.plain) if key == keyword]

    def text(self) -> str:
        """The text of the statement, as in the file."""
        rows = [(key, text) for (key, _), text in zip(self.lines, self.texts)]
        return "\n".join(" ".join(row) for row in [("statement", self.name), *rows])

    def add(self, keyword: str, text: str, definitions: Definitions, statements: Known) -> None:
        """Reads one line."""
        require(keyword in LINES, Kind.LINE, f"{keyword} {text}")
        said = LINES[keyword](text, lambda part: definitions.read(part, self.declared))
        out = text
        if keyword in ("let", "root", "domain", "have") and definitions.occur_in(text):
            out = row_text(keyword, said)
        self.lines.append((keyword, said))
        self.texts.append(text)
        self.plain.append(out)
        bound: Said = [said[0]] if keyword in ("let", "root", "number") else []
        if keyword in ("forall", "over", "state", "input", "exists"):
            bound = said
        for name in [*bound, *OWN.get(keyword, [])]:
            definitions.bind(name)
        if keyword in ("map", "relation") and text in statements:
            bound = statements[text].declared
        if keyword != "exists":
            self.declared.update(bound)


def read_statements(text: str, definitions: Definitions | None = None) -> dict[str, Statement]:
    """The statements of a file in order, by name, with definitions written out; definitions: those
    that stand before it.
    """
    definitions = definitions or Definitions(Work())
    statements: dict[str, Statement] = {}
    current = None
    for count, keyword, rest in rows(text):
        try:
            if keyword == "statement":
                named = re.fullmatch(r"[\w.\-]+/[\w.\-]+", rest, re.ASCII)
                require(named and rest not in statements, Kind.STATEMENT_NAME, rest)
                current = statements[rest] = Statement(rest)
            elif keyword == "define":
                definitions.define(rest)
                current = None  # no line of a statement can follow, and be taken for the next one's
            elif keyword:
                if not current:
                    raise Rejected(Kind.LINE, f"{keyword} {rest}")
                current.add(keyword, rest, definitions, statements)
            else:
                current = None  # where a reader sees a block end, no line can be added to it
        except Rejected as reason:
            raise reason.within(f"statements, line {count}") from None
        except Exception as error:
            said = type(error).__name__
            raise Rejected(Kind.LINE_SHAPE, said, f"statements, line {count}") from None
    for name, statement in statements.items():
        order = "".join(keyword + " " for keyword, _ in statement.lines)
        kinds = [kind for kind, pattern in ORDERS.items() if re.fullmatch(pattern, order)]
        require(kinds, Kind.ORDER, f"{name}: {order}")
        statement.kind = kinds[0]
    return statements


class Unfolding:
    """A statement's lines in order, as variables, premises, obligations and goals over polynomials.

    A variable whose value the context knows keeps it; any other is declared.  `sharp`: the domain
    and the condition of a sharp range take the place of the statement's own range lines.  Without
    `shown`, what is shown is left out: the premises are asked for alone.
    """

    def __init__(
        self, statement: Statement, context: Context, sharp: Range | None = None, shown: bool = True
    ) -> None:
        self.context = context
        self.premises: list[Formula] = []
        # (number of premises before it, negation of what is to be shown)
        self.obligations: list[tuple[int, Formula]] = []
        self.goals: list[Formula] = []
        self.variables: set[str] = set()
        self.universal: list[str] = []
        self.given = set(context.values)
        self.integers = {name for line in statement.get("integer") for name in line}
        bound = statement.get("forall") + statement.get("exists")
        quantified = {name for line in bound for name in line}
        # a value for anything else would put a number in place of what a line defines
        valued = self.given <= quantified | {said[0] for said in statement.get("root")}
        require(self.integers <= quantified and valued, Kind.NO_VARIABLE, statement.name)
        for keyword, said in statement.lines:
            self.line(keyword, said, sharp, shown)

    def line(self, keyword: str, said: Said, sharp: Range | None, shown: bool) -> None:
        """What one line of the statement adds."""
        context = self.context
        if keyword in ("forall", "exists"):
            for name in said:
                self.variable(name, keyword == "forall")
            if keyword == "forall":
                for node in sharp or []:
                    self.assume(node, self.premises)
        elif keyword == "given" or keyword == "range" and sharp is None:
            self.assume(said, self.premises)
        elif keyword == "have":
            missing = negate(context.once(Context.formula, said))
            self.obligations.append((len(self.premises), missing))
            self.assume(said, self.premises)
        elif keyword == "let":
            name, term = said
            context.define(name, context.once(Context.value, term))
        elif keyword == "root":
            name, (term,) = said
            value, zero = context.once(Context.value, term), context.number(0)
            self.obligations.append((len(self.premises), context.atom(value, "<", zero)))
            self.variable(name, True)
            own = context.values[name]
            self.premises += [context.atom(own, ">=", zero), context.atom(own * own, "=", value)]
        elif keyword == "with" or keyword == "show" and shown:
            self.assume(said, self.goals)

    def variable(self, name: str, universal: bool) -> None:
        # a name for all and for some would have its witness given as a term
        require(name not in self.variables, Kind.VARIABLE_TWICE, name)
        self.variables.add(name)
        if universal:
            self.universal.append(name)
        if name not in self.given:
            self.context.declare(name, name in self.integers)

    def assume(self, node: ast.expr, formulas: list[Formula]) -> None:
        formulas.append(self.context.once(Context.formula, node))
        self.context.license(formulas[-1])

    def goal(self, truth: bool) -> Formula:
        """What is shown, or its negation."""
        goal = join("and", self.goals)
        return goal if truth else negate(goal)
