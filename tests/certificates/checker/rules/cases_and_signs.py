"""["cases", k, nodes]: one node for each alternative; ["sign", p, ., ., .]: p < 0, p = 0, p > 0."""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines, proof

ORDER = lines(
    "forall x y", "given x < y or y < x", "show x != y"
)  # choice 0: y - x > 0, x - y > 0; fact 0: x - y = 0
SIGNS = lines("forall x", "show x^2 > 0 or x = 0")  # facts 0: -x^2 >= 0, 1: x != 0
AT = {"x": "0", "y": "1"}
APART = ["psatz", [[1, [[1, 1]], "1"]], [[0, "1"]]]
TURNED = ["psatz", [[1, [[1, 1]], "1"]], [[0, "-1"]]]
STRICT = ["psatz", [[1, [[0, 1]], "1"], [1, [[2, 2]], "1"]], []]


def by_cases(*nodes: Json, number: Json = 0) -> Json:
    return proof(["cases", number, list(nodes)], at=AT)


def by_sign(text: Json, *nodes: Json) -> Json:
    return proof(["sign", text, *nodes], at={"x": "0"})


ACCEPTED = [
    Case("both alternatives", ORDER, by_cases(APART, TURNED)),
    Case(
        "three signs",
        SIGNS,
        by_sign("x", STRICT, ["psatz", [[1, [[1, 2]], "1"]], [[2, "-x"]]], STRICT),
    ),
    Case("the signs of a constant", lines("show 0 < 1"), proof(["sign", "3", CLOSE, CLOSE, CLOSE])),
]

REJECTED = [
    Case(
        "an alternative left out",
        ORDER,
        by_cases(APART),
        (Kind.CASES, "2"),
    ),
    Case(
        "an alternative too many",
        ORDER,
        by_cases(APART, TURNED, APART),
        (Kind.CASES, "2"),
    ),
    Case("alternatives swapped", ORDER, by_cases(TURNED, APART), Kind.SUM),
    Case(
        "an alternative left open",
        ORDER,
        by_cases(APART, OPEN),
        Kind.STRICT,
    ),
    Case(
        "a disjunction that is not there",
        ORDER,
        by_cases(APART, TURNED, number=1),
        (Kind.INDEX, "1"),
    ),
    Case(
        "a negative number of a disjunction",
        ORDER,
        by_cases(APART, TURNED, number=-1),
        (Kind.INDEX, "-1"),
    ),
    Case(
        "a truth value for a disjunction",
        ORDER,
        by_cases(APART, TURNED, number=False),
        (Kind.INDEX, "False"),
    ),
    Case(
        "a disjunction used twice",
        ORDER,
        by_cases(["cases", 0, [APART, TURNED]], TURNED),
        (Kind.INDEX, "0"),
    ),
    Case(
        "a fact of another alternative",
        ORDER,
        by_cases(APART, ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]),
        (Kind.INDEX, "2"),
    ),
    Case("a sign left out", SIGNS, by_sign("x", STRICT, STRICT), (Kind.MALFORMED, "TypeError")),
    Case(
        "a fourth sign",
        SIGNS,
        by_sign("x", STRICT, OPEN, STRICT, OPEN),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case(
        "a case of zero treated as strict",
        SIGNS,
        by_sign("x", STRICT, STRICT, STRICT),
        Kind.FACTOR,
    ),
    Case(
        "the sign of a quotient",
        SIGNS,
        by_sign("1/x", STRICT, STRICT, STRICT),
        (Kind.POLYNOMIAL, "1/x"),
    ),
    Case("the sign of nothing", SIGNS, by_sign(None, STRICT, STRICT, STRICT), (Kind.TEXT, "None")),
    Case(
        "the sign of a relation",
        SIGNS,
        by_sign("x > 0", STRICT, STRICT, STRICT),
        (Kind.TERM, "x > 0"),
    ),
]
