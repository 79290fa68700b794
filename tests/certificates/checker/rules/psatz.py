"""["psatz", products, equations]: a sum of nonnegative products and multiples of equations is zero,
yet strictly positive.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import Case, Json, lines, proof

SQUARE = lines("forall x", "show x^2 >= 0")  # fact 0: -x^2 > 0
AMGM = lines(
    "forall x y", "given x >= 0", "given y > 0", "show x*y + x^2 >= 0"
)  # facts: x >= 0, y > 0, -x*y - x^2 > 0
EQUATION = lines("forall x y", "given x*y = 1", "show x != 0")  # facts: x*y - 1 = 0, x = 0
UNEQUAL = lines("forall x", "given x != 0", "show x^2 > 0")  # facts: x != 0, -x^2 >= 0
ORIGIN, UNITS = {"x": "0"}, {"x": "1", "y": "1"}


def psatz(products: Json, equations: Json = ()) -> Json:
    return ["psatz", products, list(equations)]


def square(products: Json, equations: Json = ()) -> Json:
    return proof(psatz(products, equations), at=ORIGIN)


def with_units(products: Json, equations: Json = ()) -> Json:
    return proof(psatz(products, equations), at=UNITS)


ACCEPTED = [
    Case("a square", SQUARE, square([[1, [[0, 1]], "1"], [1, [], "x"]])),
    Case("rational coefficients", SQUARE, square([["2/3", [[0, 1]], "1"], ["6", [], "x/3"]])),
    Case(
        "a product of facts",
        AMGM,
        with_units([[1, [[2, 1]], "1"], [1, [[0, 1], [1, 1]], "1"], [1, [], "x"]]),
    ),
    Case(
        "a power of a fact",
        AMGM,
        with_units([[1, [[2, 1]], "1"], [1, [[0, 1], [1, 1]], "1"], [1, [[0, 2]], "1"]]),
    ),
    Case("multiples of equations", EQUATION, with_units([[1, [], "1"]], [[0, "1"], [1, "-y"]])),
    Case(
        "an even power of what is not zero",
        UNEQUAL,
        proof(psatz([[1, [[1, 1]], "1"], [1, [[0, 2]], "1"]]), at={"x": "1"}),
    ),
    Case(
        "a strict square of a constant",
        lines("forall x", "show x^2 + 4 > 0"),
        square([[1, [[0, 1]], "1"], [1, [], "x"], [1, [], "2"]]),
    ),
]

REJECTED = [
    Case(
        "a sum that is not zero",
        SQUARE,
        square([[1, [[0, 1]], "1"], [2, [], "x"]]),
        (Kind.SUM, "x^2"),
    ),
    Case(
        "a negative coefficient",
        SQUARE,
        square([[1, [[0, 1]], "1"], [-1, [], "x"]]),
        (Kind.COEFFICIENT, "-1"),
    ),
    Case(
        "a coefficient zero",
        SQUARE,
        square([[0, [[0, 1]], "1"]]),
        (Kind.COEFFICIENT, "0"),
    ),
    Case(
        "a float as coefficient",
        SQUARE,
        square([[1.0, [[0, 1]], "1"], [1, [], "x"]]),
        (Kind.RATIONAL, "1.0"),
    ),
    Case(
        "a truth value as coefficient",
        SQUARE,
        square([[True, [[0, 1]], "1"], [1, [], "x"]]),
        (Kind.RATIONAL, "True"),
    ),
    Case(
        "a decimal as coefficient",
        SQUARE,
        square([["1.0", [[0, 1]], "1"], [1, [], "x"]]),
        (Kind.RATIONAL, "1.0"),
    ),
    Case(
        "a division by zero as coefficient",
        SQUARE,
        square([["1/0", [[0, 1]], "1"], [1, [], "x"]]),
        (Kind.RATIONAL, "1/0"),
    ),
    Case(
        "blanks in a coefficient",
        SQUARE,
        square([[" 1", [[0, 1]], "1"], [1, [], "x"]]),
        Kind.RATIONAL,
    ),
    Case(
        "digits of another script",
        SQUARE,
        square([["\u0661", [[0, 1]], "1"], [1, [], "x"]]),
        Kind.RATIONAL,
    ),
    Case(
        "nothing strict",
        lines("forall x", "given x >= 0", "show x > 0"),
        square([[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]]),
        Kind.STRICT,
    ),
    Case(
        "nothing strict but a root that may vanish",
        lines("forall x", "show x^2 > 0"),
        square([[1, [[0, 1]], "1"], [1, [], "x"]]),
        Kind.STRICT,
    ),
    Case(
        "a strict product with a root that is zero",
        lines("forall x", "given x > 0", "show x < 0"),
        proof(psatz([[1, [[0, 1]], "0"]]), at={"x": "1"}),
        Kind.STRICT,
    ),
    Case(
        "a strict product with a weak factor",
        lines("forall x", "given x > 0", "given x <= 0", "show 0 = 1"),
        proof(psatz([[1, [[0, 1], [1, 1]], "1"], [1, [], "x"]]), at={"x": "1"}),
        Kind.STRICT,
    ),
    Case(
        "an equation as a factor",
        EQUATION,
        with_units([[1, [[0, 1]], "1"]]),
        Kind.FACTOR,
    ),
    Case(
        "an odd power of what is not zero",
        UNEQUAL,
        proof(psatz([[1, [[0, 1]], "1"]]), at={"x": "1"}),
        Kind.FACTOR,
    ),
    Case("an exponent zero", AMGM, with_units([[1, [[0, 0]], "1"]]), Kind.FACTOR),
    Case("a negative exponent", AMGM, with_units([[1, [[0, -2]], "1"]]), Kind.FACTOR),
    Case(
        "a truth value as exponent",
        AMGM,
        with_units([[1, [[0, True]], "1"]]),
        Kind.FACTOR,
    ),
    Case(
        "an exponent beyond the limit",
        AMGM,
        with_units([[1, [[0, 10**30]], "1"]]),
        Kind.EXPONENT,
    ),
    Case(
        "a fact that is not there",
        AMGM,
        with_units([[1, [[3, 1]], "1"]]),
        (Kind.INDEX, "3"),
    ),
    Case(
        "a negative number of a fact",
        AMGM,
        with_units([[1, [[-1, 1]], "1"]]),
        (Kind.INDEX, "-1"),
    ),
    Case(
        "a truth value for a fact",
        AMGM,
        with_units([[1, [[True, 1]], "1"]]),
        (Kind.INDEX, "True"),
    ),
    Case(
        "an inequality as equation",
        AMGM,
        with_units([[1, [], "1"]], [[0, "1"]]),
        (Kind.EQUATION, "x"),
    ),
    Case(
        "a negative number of an equation",
        EQUATION,
        with_units([[1, [], "1"]], [[-1, "-y"], [0, "1"]]),
        (Kind.INDEX, "-1"),
    ),
    Case(
        "a cofactor with a denominator",
        EQUATION,
        with_units([[1, [], "1"]], [[1, "1/y"]]),
        Kind.DIVISION,
    ),
    Case(
        "an undeclared name",
        SQUARE,
        square([[1, [[0, 1]], "1"], [1, [], "z"]]),
        (Kind.UNDECLARED, "z"),
    ),
    Case(
        "a term missing its root",
        SQUARE,
        square([[1, [[0, 1]]]]),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case(
        "a fourth entry",
        SQUARE,
        square([[1, [[0, 1]], "1", "1"]]),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case("a number for a root", SQUARE, square([[1, [[0, 1]], 1]]), (Kind.TEXT, "1")),
    Case("nothing for a list", SQUARE, square(None), (Kind.MALFORMED, "TypeError")),
]
