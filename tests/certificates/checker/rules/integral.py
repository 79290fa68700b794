"""["integral", i, node]: a strict fact with integer coefficients in integer variables is at least
one.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import OPEN, Case, Json, lines, proof

GAP = lines("forall n", "integer n", "show n <= 0 or n >= 1")  # facts 0: n > 0, 1: 1 - n > 0
THIRDS = lines("forall n", "integer n", "show n <= 0 or n/2 >= 1/2")  # fact 1: -n/2 + 1/2 > 0
HALVES = lines("forall n", "integer n", "show 2*n != 1")
BOTH = ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]
ONE = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]


def integral(fact: Json, node: Json) -> Json:
    return proof(["integral", fact, node], at={"n": "0"})


HALF = [
    "sign",
    "n",
    ["psatz", [[2, [[1, 1]], "1"], [1, [], "1"]], [[0, "1"]]],
    ["psatz", [[1, [], "1"]], [[0, "1"], [1, "-2"]]],
    ["integral", 1, ["psatz", [[2, [[2, 1]], "1"], [1, [], "1"]], [[0, "-1"]]]],
]

ACCEPTED = [
    Case("no integer between", GAP, integral(0, BOTH)),
    Case("no integer is a half", HALVES, proof(HALF, at={"n": "0"})),
    Case(
        "a product of integers",
        lines("forall m n", "integer m n", "show m*n <= 0 or m*n >= 1"),
        proof(["integral", 0, BOTH], at={"m": "0", "n": "0"}),
    ),
]

REJECTED = [
    Case(
        "what remains is left open",
        GAP,
        integral(0, OPEN),
        Kind.STRICT,
    ),
    Case(
        "a real variable",
        lines("forall n", "show n <= 0 or n >= 1"),
        integral(0, BOTH),
        Kind.INTEGRAL,
    ),
    Case(
        "another variable is real",
        lines("forall m n", "integer n", "show m*n <= 0 or m*n >= 1"),
        proof(["integral", 0, BOTH], at={"m": "0", "n": "0"}),
        Kind.INTEGRAL,
    ),
    Case(
        "an integer beside a half",
        lines("forall m n", "integer m n", "show m + n/2 <= 0 or m + n/2 >= 1"),
        proof(["integral", 0, BOTH], at={"m": "0", "n": "0"}),
        Kind.INTEGRAL,
    ),
    Case("halves", THIRDS, integral(1, BOTH), Kind.INTEGRAL),
    Case(
        "a weak fact",
        lines("forall n", "integer n", "show n < 0"),
        integral(0, ONE),
        Kind.INTEGRAL,
    ),
    Case("an equation", HALVES, integral(0, ONE), Kind.INTEGRAL),
    Case(
        "what is not zero",
        lines("forall n", "integer n", "show n = 0"),
        integral(0, ONE),
        Kind.INTEGRAL,
    ),
    Case("a fact that is not there", GAP, integral(2, BOTH), (Kind.INDEX, "2")),
    Case("no node", GAP, proof(["integral", 0], at={"n": "0"}), (Kind.MALFORMED, "TypeError")),
    Case(
        "a root that is called an integer",
        lines("forall x", "integer s", "root s = sqrt(2)", "show x = x"),
        proof(["close"], ["close"], at={"x": "0", "s": "0"}),
        Kind.NO_VARIABLE,
    ),
    Case(
        "an abbreviation that is called an integer",
        lines("forall x", "integer a", "let a = x", "show x = x"),
        proof(["close"], at={"x": "0"}),
        Kind.NO_VARIABLE,
    ),
    Case(
        "a point that is no integer",
        lines("forall n", "integer n", "show n = n"),
        proof(["close"], at={"n": "1/2"}),
        Kind.VALUES,
    ),
]
