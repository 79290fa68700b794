"""The text of statements: what is no term, no formula, no name or no line in its place is
refused.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, Case, lines, proof

AT = {"x": "0"}
TRUE = "show 0 = 0"
ORDER = Kind.ORDER


def shown(formula: str) -> Case:
    return Case(formula, lines("forall x", "show " + formula), proof(CLOSE, at=AT))


ACCEPTED = [
    shown(formula)
    for formula in (
        "2^3 = 8",
        "-2^2 = -4",
        "(-2)^2 = 4",
        "2 - 3 - 4 = -5",
        "8/4/2 = 1",
        "2*3 + 4 = 10",
        "not 1 = 2 and 2 = 2",
        "not (1 = 2 or 2 = 1)",
        "1 = 2 or 2 = 2 and 3 = 3",
        "1 != 2 != 1",
        "iff(x = x, 0 = 0)",
        "implies(0 = 1, x = x + 1)",
        "iff(0 = 1, 1 = 2)",
        "x - x = 0",
        "-(-x) = x",
        "implies(iff(1 = 1, 2 = 3), 0 = 1)",
        "3/2 > 4/3",
        "12345678901234567890^2 > 0",
        "(((x))) = x",
        "x^0 = 1",
        "not not 1 = 1",
        "1 <= 1 >= 1",
    )
] + [
    Case("a comment inside", lines("forall x", "# of x", TRUE), proof(CLOSE, at=AT)),
]

NOT_TERMS = [
    "True = True",
    "None = None",
    "f(x) = f(x)",
    "(x, x) = (x, x)",
    "(x for x in x) = x",
    "(yield x) = 0",
    "(await x) = 0",
    "sqrt(4) = 2",
    "(x < 1) = 0",
    "x^y = x",
    "x^-2 = 0",
    "x^True = x",
    "+x = x",
    "(1, 2) < (1, 3)",
    "x^(2) ^ 3 = 1",
    "not 0 + 1 = 0 + (not 0)",
]
NOT_FORMULAS = [
    "x",
    "1",
    "True",
    "x if x else x = 0",
    "x in x",
    "x not in x",
    "x is x",
    "x is not x",
    "implies(x = x)",
    "implies(x = x, x = x, x = x)",
    "iff()",
    "all(x = x, x = x)",
    "x = x, x = x",
    "x = x if x = x else x = x",
    "implies(*x, x = x)",
    "implies(x = x, x = x, ^x)",
    "(implies)(x, x)",
    "or_(x = x, x = x)",
    "0 < x in x",
]
UNREADABLE = [
    "x.real = x",
    "x[0] = 0",
    "'x' = 'x'",
    "{x} = {x}",
    "lambda: x = x",
    "(x := 0) = 0",
    "x @ x = 0",
    "x % 2 = 0",
    "x // 2 = 0",
    "x ** 2 = 4",
    "x == x",
    "x <> x",
    "x << 1 = 0",
    "~x = 0",
    "x & x = 0",
    "x | x = 0",
    "1.5 > 1",
    "1e5 > 1",
    "1j = 1j",
    "0x10 = 16",
    "1_0 = 10",
    "0b1 = 1",
    "01 = 1",
    "x =! x",
    "x => x",
    "x =< x",
    "x = = x",
    "x ! = x",
    "x ^^ 2 = 0",
    "x ^* 2 = 0",
    "x * * 2 = 0",
    "x; x",
    "x \\ x",
    "`x`",
    "x$ = 0",
    "x = x # y",
    "x \u2264 x",
    "\u03b1 = \u03b1",
    "x\u0301 = x",
    "\u0661 = 1",
    "x\u00b2 = x",
    "f'{x}' = x",
    "(x = x",
    "x = x)",
    "",
    "1if x else x = 1",
    "2x = x",
]

LINES = [
    ("no show line", ["forall x"], ORDER),
    ("two show lines", ["forall x", TRUE, TRUE], ORDER),
    ("a line after show", [TRUE, "given 0 = 1"], ORDER),
    ("forall after given", ["given 0 = 0", "forall x", TRUE], ORDER),
    ("with before exists", ["forall x", "with x > 0", TRUE], ORDER),
    ("given after exists", ["exists x", "given x > 0", TRUE], ORDER),
    ("a root after exists", ["exists x", "root s = sqrt(x^2)", TRUE], ORDER),
    ("two exists lines", ["exists x", "exists y", TRUE], ORDER),
    ("two forall lines", ["forall x", "forall y", TRUE], ORDER),
    ("lines of two kinds", ["forall x", "sharp rule/case", TRUE], ORDER),
    ("no line", [], ORDER),
    ("an unknown line", ["assume 0 = 1", TRUE], (Kind.LINE, "", "statements, line 2")),
    ("a keyword in capitals", ["Given 0 = 1", TRUE], (Kind.LINE, "", "statements, line 2")),
    ("a keyword and a tab", ["given\t0 = 1", TRUE], (Kind.LINE, "", "statements, line 2")),
    (
        "a comment behind a line",
        ["forall x", "given x > 0 # not really", TRUE],
        (Kind.TEXT, "", "statements, line 3"),
    ),
    ("a root of no call", ["root s = 4", TRUE], (Kind.CALL, "sqrt(term)", "statements, line 2")),
    (
        "a root of a polynomial, which is no square root",
        ["root r = root(9/4, 0, 1)", TRUE],
        (Kind.CALL, "sqrt(term)", "statements, line 2"),
    ),
    (
        "a root with keywords",
        ["root s = sqrt(4, ^x)", TRUE],
        (Kind.CALL, "sqrt(term)", "statements, line 2"),
    ),
    ("an abbreviation without value", ["let a", TRUE], (Kind.TEXT, "", "statements, line 2")),
    ("an abbreviation with two values", ["let a = 1 = 2", TRUE], Kind.TERM),
    ("an abbreviation by :=", ["let a := 1", TRUE], (Kind.TEXT, "", "statements, line 2")),
    ("a name that begins with _", ["forall _x", TRUE], (Kind.NAME, "_x")),
    ("a name that is a number", ["forall 1", TRUE], (Kind.NAME, "1")),
    ("a name with a comma", ["forall x, y", TRUE], (Kind.NAME, "x,")),
    ("a name of another script", ["forall \u03b1", TRUE], Kind.NAME),
    ("a variable twice", ["forall x x", TRUE], (Kind.VARIABLE_TWICE, "x")),
    (
        "an integer that is no variable",
        ["integer n", TRUE],
        Kind.NO_VARIABLE,
    ),
    (
        "more variables than the limit",
        ["forall " + " ".join(f"x{i}" for i in range(401)), TRUE],
        (Kind.VARIABLES, "x400"),
    ),
]
NAMES = [
    "",
    "case",
    "rule/",
    "/case",
    "rule/case/more",
    "rule/ca se",
    "rule\\case",
    "rule/c\u00e4se",
    "rule/case?",
]

REJECTED = [
    *(
        Case(text, lines("forall x", "show " + text), proof(CLOSE, at=AT), Kind.TERM)
        for text in NOT_TERMS
    ),
    *(
        Case(text, lines("forall x", "show " + text), proof(CLOSE, at=AT), Kind.FORMULA)
        for text in NOT_FORMULAS
    ),
    *(
        Case(
            ascii(text),
            lines("forall x", "show " + text),
            proof(CLOSE, at=AT),
            (Kind.TEXT, "", "statements, line 3"),
        )
        for text in UNREADABLE
    ),
    *(Case(defect, lines(*rows), proof(CLOSE), reason) for defect, rows, reason in LINES),
    *(
        Case(
            f"the name {name!a}",
            lines(TRUE, name=name),
            proof(CLOSE),
            (Kind.STATEMENT_NAME, "", "statements, line 1"),
        )
        for name in NAMES
    ),
    Case(
        "a name twice",
        lines(TRUE) + lines(TRUE),
        proof(CLOSE),
        (Kind.STATEMENT_NAME, "", "statements, line 3"),
    ),
    Case(
        "a line before the first statement",
        "given 0 = 1\n" + lines(TRUE),
        proof(CLOSE),
        (Kind.LINE, "", "statements, line 1"),
    ),
]
