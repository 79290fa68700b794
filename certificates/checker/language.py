"""What an auditor's file means: text, definitions, statements, and statements over polynomials.

A file is a list of lines.  A blank line, or one that starts with #, says nothing.  `statement
ID/part` begins a statement; the lines below it say what it is (`LINES` and `ORDERS`).  Terms and
formulas are written with integers, names, + - * / ^, < <= = != >= >, and, or, not, implies(,),
iff(,).

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

import ast
import re
from fractions import Fraction
from functools import lru_cache
from math import prod

from .algebra import (
    BITS,
    MASK,
    MAX_VARIABLES,
    Kind,
    Poly,
    Rejected,
    Work,
    number,
    require,
    variable,
)

# --------------------------------- text: Python's expression syntax, with ^ and = as in mathematics

WORDS = {"and", "or", "not", "implies", "iff"}  # never names: `names_in` does not count them
RESERVED = WORDS | {"sqrt", "root"}
OPPOSITE = {">": ">=", ">=": ">", "=": "!=", "!=": "="}  # not p > 0 is -p >= 0
OPERATORS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=", ast.NotEq: "!="}
ARITHMETIC = {ast.Add: Poly.__add__, ast.Sub: Poly.__sub__, ast.Mult: Poly.__mul__}


def parse(text):
    """The syntax tree of a term or formula."""
    require(isinstance(text, str) and len(text) <= 1 << 20, Kind.TEXT, text)
    return tree(text) if len(text) < 200 else tree.__wrapped__(text)  # what is kept is small


@lru_cache(4096)
def tree(text):
    # Python's own **, //, <<, ==, 0x1f, 1_0 and 1j are refused: a text has one reading only
    foreign = re.search(r"[^\w +\-*/^()<>=!,]|\*\*|//|<<|>>|==|<>|\b\d+[A-Za-z_]", text, re.ASCII)
    require(not foreign, Kind.TEXT, text)
    try:
        python = re.sub(r"(?<![<>!])=", "==", text.replace("^", "**")).strip()
        return ast.parse(python, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise Rejected(Kind.TEXT, text) from None


def written(node):
    """The text of a tree, which `parse` reads back as the same tree: one thing, whatever stands
    around it in parentheses.
    """
    return ast.unparse(node).replace(" ** ", "^").replace("==", "=")


def names_in(*texts):
    """The names that occur in terms or formulas."""
    return set(re.findall(r"[A-Za-z_]\w*", " ".join(texts))) - WORDS


def put(text, values):
    """The text with other text in place of some names."""
    return re.sub(r"[A-Za-z]\w*", lambda found: values.get(found[0], found[0]), text)


def rational(value):
    """An exact rational: an int, or the text p or p/q."""
    if type(value) is int:  # not isinstance: True is no number
        return value
    pattern = r"-?\d{1,4000}(/0*[1-9]\d{0,3999})?"
    require(isinstance(value, str) and re.fullmatch(pattern, value, re.ASCII), Kind.RATIONAL, value)
    return Fraction(value)


# ------------------------------------------------------------ definitions


class Definitions:
    """The definitions of a file so far, and the names that may not be theirs."""

    def __init__(self, work):
        self.work = work
        self.known = {}  # name: (parameters, names it is over, body as a tree, written out)
        self.bound = set()  # every name of a variable or parameter so far

    def bind(self, name):
        """A variable or parameter must not have the name of a definition: else a line would say
        one thing to who knows the definition, and another to who sees the variable.
        """
        require(name not in self.known, Kind.SHADOWS, name)
        self.bound.add(name)

    def define(self, text):
        """Reads what follows the keyword `define`."""
        pattern = r"([A-Za-z]\w*)(?:\(([\w, ]+)\))?(?: over (\w+(?: \w+)*))? := (.+)"
        head = re.fullmatch(pattern, text, re.ASCII)
        require(head, Kind.DEFINITION, text)
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

    def occur_in(self, text):
        return bool(self.known) and not self.known.keys().isdisjoint(names_in(text))

    def read(self, text, declared):
        """The tree of a term or formula, with definitions written out; declared: the names that a
        definition may be over.
        """
        return self.write_out(parse(text), {}, declared) if self.occur_in(text) else parse(text)

    def write_out(self, node, values, declared):
        """A copy of a tree, with trees in place of names, and definitions written out.  Every node
        is made anew and counted, so that definitions of definitions cannot double without end.
        """
        self.work.spend(40)
        kind = type(node)

        def copies(nodes):
            return [self.write_out(one, values, declared) for one in nodes]

        if kind is ast.Constant:
            return node
        if kind is ast.Name and node.id in values:
            # what is put in was written out before: it is copied, and no name in it is replaced
            return self.write_out(values[node.id], {}, declared)
        if kind is ast.Name:
            return self.apply(node, [], declared) if node.id in self.known else node
        if kind is ast.Call and type(node.func) is ast.Name and not node.keywords:
            arguments = copies(node.args)
            if node.func.id in self.known:
                return self.apply(node.func, arguments, declared)
            return ast.Call(node.func, arguments, [])
        if kind is ast.UnaryOp:
            return ast.UnaryOp(node.op, *copies([node.operand]))
        if kind is ast.BinOp:
            left, right = copies([node.left, node.right])
            return ast.BinOp(left, node.op, right)
        if kind is ast.BoolOp:
            return ast.BoolOp(node.op, copies(node.values))
        if kind is ast.Compare:
            return ast.Compare(*copies([node.left]), node.ops, copies(node.comparators))
        if kind is ast.Tuple:
            return ast.Tuple(copies(node.elts), node.ctx)
        raise Rejected(Kind.TEXT, ast.unparse(node))

    def apply(self, head, arguments, declared):
        """The body of a definition, with the arguments in place of its parameters."""
        parameters, over, body = self.known[head.id]
        terms = []
        for one in arguments:
            terms += one.elts if isinstance(one, ast.Tuple) else [one]
        require(len(terms) == len(parameters), Kind.ARGUMENTS, head.id)
        for one in terms:
            require(not is_formula(one), Kind.TERM, lambda one=one: written(one))
        # a name of the body means what the statement has declared: never a parameter of the
        # definition around it, never what a certificate may choose
        require(over <= declared, Kind.OVER, f"{head.id}: {', '.join(sorted(over - declared))}")
        return self.write_out(body, dict(zip(parameters, terms)), declared)


def is_formula(node):
    """Whether a tree, with definitions written out, can only be a formula."""
    negation = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    return negation or isinstance(node, (ast.Compare, ast.BoolOp, ast.Call))


# ------------------------------------------------------------ formulas over polynomials


def fold(poly, relation):
    """The atom poly relation 0; True or False where the polynomial is constant."""
    if not poly.terms.keys() <= {0}:
        return ("atom", poly, relation)
    value = poly.terms.get(0, 0)
    return {">": value > 0, ">=": value >= 0, "=": value == 0, "!=": value != 0}[relation]


def join(op, formulas):
    """The conjunction or disjunction, without constants and without joins of the same kind
    inside.
    """
    if any(formula is (op == "or") for formula in formulas):
        return op == "or"
    flat = []
    for formula in formulas:
        if not isinstance(formula, bool):
            flat += formula[1] if formula[0] == op else [formula]
    if not flat:
        return op == "and"
    # equivalences of equivalences double: counted where they are joined
    work_of(flat[0]).spend(20 * len(flat) + 100)
    return flat[0] if len(flat) == 1 else (op, flat)


def work_of(formula):
    """The meter of the polynomials in a formula."""
    while formula[0] != "atom":
        formula = formula[1][0]
    return formula[1].work


def negate(formula):
    """The negation, with `not` driven down to atoms."""
    if isinstance(formula, bool):
        return not formula
    if formula[0] == "atom":
        _, poly, relation = formula
        return ("atom", poly if relation in ("=", "!=") else -poly, OPPOSITE[relation])
    return join("or" if formula[0] == "and" else "and", [negate(part) for part in formula[1]])


def conjuncts(formula):
    """The parts of a conjunction; else the formula alone."""
    return formula[1] if not isinstance(formula, bool) and formula[0] == "and" else [formula]


class Context:
    """What has been declared so far: variables, the values of names, and the polynomials that a
    strict line made nonzero.

    index: {key: number of the variable}; integers: the keys of integer variables; values: {name:
    polynomial, or quotient of such}; licensed: {key of a polynomial: licence}; work: the meter of
    the check, which an inner context shares.
    """

    def __init__(self, outer=None, values=None, work=None):
        self.work = outer.work if outer else work or Work()
        self.index = dict(outer.index) if outer else {}
        self.integers = set(outer.integers) if outer else set()
        self.licensed = dict(outer.licensed) if outer else {}
        if values is None:
            values = outer.values if outer else {}
        self.values = dict(values)

    def number(self, value):
        """A rational number as a polynomial of this check."""
        return number(value, self.work)

    def declare(self, name, integral=False):
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

    def define(self, name, value):
        """A name for a value.  A word is no name: `names_in` would not see it in a premise."""
        fresh = name not in self.values and name not in WORDS
        require(fresh and re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII), Kind.NAME, name)
        self.values[name] = value

    def license(self, formula):
        """A strict line, at top level or inside a top-level `and`, makes its polynomial nonzero
        (and tells its sign).  What stands in a disjunction licenses nothing.
        """
        for part in conjuncts(formula):
            if isinstance(part, bool) or part[0] != "atom" or part[2] not in (">", "!="):
                continue
            content, poly = part[1].primitive()
            key = frozenset(poly.terms.items())
            positive = part[2] == ">"
            if key not in self.licensed or positive and not self.licensed[key][1]:
                self.licensed[key] = (poly if content > 0 else -poly, positive)

    def reciprocal(self, node):
        """1 / node, where node is a nonzero number, licensed as a whole, or a product or power of
        such.
        """
        value = self.value(node)
        require(value.terms, Kind.ZERO_DIVISION, lambda: ast.unparse(node))
        if value.constant():
            return self.number(1 / value.constant())
        content, poly = value.primitive()
        licence = self.licensed.get(frozenset(poly.terms.items()))
        if licence or poly.constant():
            sign = -1 if licence and licence[0].terms != poly.terms else 1
            upper = self.number(Fraction(sign * value.den, content))
            upper = self.number(1).numerator(value.under) * upper
            return upper.over({licence: 1} if licence else {})
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
            return self.reciprocal(node.left) * self.reciprocal(node.right)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            return self.reciprocal(node.left) ** node.right.value
        raise Rejected(Kind.DIVISION, self.show(value))

    def value(self, node):
        """The value of a term."""
        kind = type(node)
        if kind is ast.Name:
            if node.id in self.values:
                return self.values[node.id]
            raise Rejected(Kind.UNDECLARED, node.id)
        if kind is ast.Constant and type(node.value) is int:
            return self.number(node.value)
        if kind is ast.UnaryOp and type(node.op) is ast.USub:
            return -self.value(node.operand)
        if kind is ast.BinOp:
            left, op, right = self.value(node.left), type(node.op), node.right
            if op is ast.Pow and type(right) is ast.Constant and type(right.value) is int:
                return left**right.value
            if op is ast.Div:
                return left * self.reciprocal(right)
            if op in ARITHMETIC:
                return ARITHMETIC[op](left, self.value(right))
        raise Rejected(Kind.TERM, ast.unparse(node))

    def polynomial(self, text):
        """The value of a term without quotients."""
        value = self.value(parse(text))
        require(not value.under, Kind.POLYNOMIAL, text)
        return value

    def atom(self, left, relation, right):
        """left relation right as p > 0, p >= 0, p = 0 or p != 0: the difference times what is
        positive wherever it is defined.
        """
        if "<" in relation:
            left, right = right, left
            relation = relation.replace("<", ">")
        value = left - right
        # over an odd power of what may be negative, the numerator has not the sign of the quotient
        signless = [
            poly
            for (poly, positive), exponent in value.under.items()
            if exponent % 2 and not positive and ">" in relation
        ]
        return fold(prod(signless, start=value.over({})), relation)

    def formula(self, node):
        """The formula with `not` driven down to atoms: ("atom", p, relation), ("and", ..), ("or",
        ..) or a bool.
        """
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            return negate(self.formula(node.operand))
        if isinstance(node, ast.BoolOp):
            op = "and" if isinstance(node.op, ast.And) else "or"
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

    def show(self, poly):
        """A polynomial as text that `parse` reads."""
        parts = []
        for m in sorted(poly.terms, reverse=True):
            factors = [str(Fraction(poly.terms[m], poly.den))]
            for name, place in self.index.items():
                exponent = m >> (BITS * place) & MASK
                if exponent:
                    factors.append(name if exponent == 1 else f"{name}^{exponent}")
            parts.append("*".join(factors))
        return re.sub(r"\b1\*(?=[A-Za-z])", "", " + ".join(parts)).replace("+ -", "- ") or "0"


def variables_of(context, poly):
    """The keys of the variables that occur."""
    places = poly.places()
    return {key for key, place in context.index.items() if place in places}


def univariate(context, poly, name):
    """The coefficients of a polynomial in one variable, from the constant up, up to the positive
    factor that the denominator is.
    """
    alone = not poly.under and variables_of(context, poly) == {name}
    require(alone, Kind.ONE_VARIABLE, lambda: f"{name}: {context.show(poly)}")
    shift = BITS * context.index[name]
    return [poly.terms.get(k << shift, 0) for k in range((max(poly.terms) >> shift) + 1)]


# ------------------------------------------------------------ lines and statements


def equation(text, read):
    """NAME = TERM: the name and the term."""
    name, _, said = text.partition(" = ")
    return name, read(said)


def call(text, read, shape):
    """NAME = sqrt(term), or NAME = root(polynomial, low, high), as the shape says: the name and the
    arguments.
    """
    name, node = equation(text, read)
    expected = parse(shape)
    same = isinstance(node, ast.Call) and ast.unparse(node.func) == expected.func.id
    require(same and not node.keywords, Kind.CALL, f"{shape}: {text}")
    require(len(node.args) == len(expected.args), Kind.CALL, f"{shape}: {text}")
    return name, node.args


def listed(text, read):
    """TERM, or TERM, TERM, ..: each as text."""
    node = read(text)
    return [written(part) for part in (node.elts if isinstance(node, ast.Tuple) else [node])]


def mapping(text, read):
    """NAMES -> TERMS or GUARD -> TERMS, as text: what the terms are the next state of, or where
    they are.
    """
    left, right = text.split(" -> ")
    return listed(left, read), listed(right, read)


LINES = {  # how what follows each keyword is read
    **dict.fromkeys(
        ("forall", "integer", "exists", "over", "sharp", "state"), lambda text, read: text.split()
    ),
    "let": equation,
    "root": lambda text, read: call(text, read, "sqrt(term)"),
    "number": lambda text, read: call(text, read, "root(polynomial, low, high)"),
    **dict.fromkeys(
        ("range", "given", "have", "with", "show", "domain", "holds"), lambda text, read: read(text)
    ),
    **dict.fromkeys(("iterates", "after", "piece"), mapping),
    "word": lambda text, read: [int(k) for k in text.split()],
    **dict.fromkeys(
        ("map", "descent", "contraction", "attraction", "escape"), lambda text, read: text
    ),
    **dict.fromkeys(
        ("space", "rank", "stage", "on", "rate", "radius", "size"),
        lambda text, read: written(read(text)),
    ),
    **dict.fromkeys(("point", "weights", "start"), listed),
}
# the lines that each kind of statement has, in this order, so that none can be overlooked
ORDERS = {
    "universal": (
        r"(forall )?(integer )?((range|given|have|let|root) )*(exists ((with|let) )*)?show "
    ),
    "sharp": r"sharp over domain (number )*holds ",
    "iterates": r"forall integer (let )*iterates after ",
    "map": r"over domain state space (piece )+",
    "descends": r"map domain (root )*rank (stage )+",
    "contracts": r"map domain (root )*on point weights rate radius size ",
    "attracts": r"descent contraction ",
    "escapes": r"map domain (root )*point start word ",
    "exactly": r"attraction escape ",
}


class Statement:
    """One statement: its name, its lines in order as (keyword, what it says), and its kind, which
    their order tells.

    texts: what stands in the file after each keyword; plain: the same with definitions written out.
    """

    def __init__(self, name):
        self.name = name
        self.lines = []
        self.texts = []
        self.plain = []
        self.kind = ""
        self.declared = set()  # the names that a definition may be over

    def get(self, keyword):
        """What each line of this keyword says."""
        return [said for key, said in self.lines if key == keyword]

    def rows(self, keyword):
        """The text of each line of this keyword, with definitions written out."""
        return [text for (key, _), text in zip(self.lines, self.plain) if key == keyword]

    def text(self, keyword=""):
        """The text of the first line of this keyword, or of the whole statement, as in the file."""
        rows = [(key, text) for (key, _), text in zip(self.lines, self.texts)]
        if keyword:
            return next(text for key, text in rows if key == keyword)
        return "\n".join(" ".join(row) for row in [("statement", self.name), *rows])

    def add(self, keyword, text, definitions, statements):
        """Reads one line."""
        require(keyword in LINES, Kind.LINE, f"{keyword} {text}")
        said = LINES[keyword](text, lambda part: definitions.read(part, self.declared))
        out = text
        if keyword in ("let", "root", "domain") and definitions.occur_in(text):
            out = written_line(keyword, said)
        self.lines.append((keyword, said))
        self.texts.append(text)
        self.plain.append(out)
        if keyword in ("forall", "over", "state", "exists"):
            bound = said
        else:
            bound = [said[0]] if keyword in ("let", "root", "number") else []
        for name in bound:
            definitions.bind(name)
        if keyword == "map" and text in statements:
            bound = statements[text].declared
        if keyword != "exists":
            self.declared.update(bound)


def written_line(keyword, said):
    """The text of a line `let`, `root` or `domain`."""
    if keyword == "domain":
        return written(said)
    name, value = said
    return f"{name} = " + (written(value) if keyword == "let" else f"sqrt({written(value[0])})")


def read_statements(text, work=None):
    """The statements of a file in order, by name, with definitions written out."""
    definitions = Definitions(work or Work())
    statements = {}
    current = None
    for count, line in enumerate(text.split("\n"), 1):
        keyword, _, rest = line.strip().partition(" ")
        try:
            if keyword == "statement":
                named = re.fullmatch(r"[\w.\-]+/[\w.\-]+", rest, re.ASCII)
                require(named and rest not in statements, Kind.STATEMENT_NAME, rest)
                current = statements[rest] = Statement(rest)
            elif keyword == "define":
                definitions.define(rest)
                current = None  # no line of a statement can follow, and be taken for the next one's
            elif keyword and not keyword.startswith("#"):
                require(current, Kind.LINE, line)
                current.add(keyword, rest, definitions, statements)
        except Rejected as reason:
            raise reason.within(f"statements, line {count}") from None
        except (ValueError, TypeError, RecursionError, MemoryError) as error:
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

    def __init__(self, statement, context, sharp=None, shown=True):
        self.context = context
        self.premises = []
        self.obligations = []  # (number of premises before it, negation of what is to be shown)
        self.goals = []
        self.variables = set()
        self.universal = []
        self.given = set(context.values)
        self.integers = {name for line in statement.get("integer") for name in line}
        quantified = {
            name
            for keyword in ("forall", "exists")
            for line in statement.get(keyword)
            for name in line
        }
        # a value for anything else would put a number in place of what a line defines
        valued = self.given <= quantified | {said[0] for said in statement.get("root")}
        require(self.integers <= quantified and valued, Kind.NO_VARIABLE, statement.name)
        for keyword, said in statement.lines:
            self.line(keyword, said, sharp, shown)

    def line(self, keyword, said, sharp, shown):
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
            self.obligations.append((len(self.premises), negate(context.formula(said))))
            self.assume(said, self.premises)
        elif keyword == "let":
            name, term = said
            context.define(name, context.value(term))
        elif keyword == "root":
            name, (term,) = said
            value, zero = context.value(term), context.number(0)
            self.obligations.append((len(self.premises), context.atom(value, "<", zero)))
            self.variable(name, True)
            own = context.values[name]
            self.premises.append(context.atom(own, ">=", zero))
            self.premises.append(context.atom(own * own, "=", value))
        elif keyword == "with" or keyword == "show" and shown:
            self.assume(said, self.goals)

    def variable(self, name, universal):
        # a name for all and for some would have its witness given as a term
        require(name not in self.variables, Kind.VARIABLE_TWICE, name)
        self.variables.add(name)
        if universal:
            self.universal.append(name)
        if name not in self.given:
            self.context.declare(name, name in self.integers)

    def assume(self, node, formulas):
        formulas.append(self.context.formula(node))
        self.context.license(formulas[-1])

    def goal(self, truth):
        """What is shown, or its negation."""
        goal = join("and", self.goals)
        return goal if truth else negate(goal)
