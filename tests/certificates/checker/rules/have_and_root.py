"""Obligations: every `have` line follows from the lines before it, and so does it that the term
under a root is not negative.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines, proof

HAVE = lines(
    "forall x", "given x > 1", "have x > 0", "show 1/x < 1"
)  # goal, negated: (x - 1... ) <= 0 over x
ROOT = lines("forall x", "given x >= 1", "root s = sqrt(x - 1)", "show s >= 0")
POSITIVE = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"], [1, [], "1"]], []]  # x > 1 and x <= 0
GOAL = ["psatz", [[1, [[0, 1]], "1"], [1, [[2, 1]], "1"]], []]
UNDER = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]
SIGN = ["psatz", [[1, [[1, 1]], "1"], [1, [[3, 1]], "1"]], []]
TWO, ROOTS = {"x": "2"}, {"x": "2", "s": "1"}


def have(*steps: Json, node: Json = GOAL) -> Json:
    return proof(node, *steps, at=TWO)


def root(*steps: Json, at: dict[str, str] | None = None) -> Json:
    return proof(SIGN, *steps, at=ROOTS if at is None else at)


ACCEPTED = [
    Case("a consequence", HAVE, have(POSITIVE)),
    Case("a root", ROOT, root(UNDER)),
    Case(
        "a root of a number",
        lines("root s = sqrt(9/4)", "show s = 3/2"),
        proof(
            [
                "sign",
                "s - 3/2",
                [
                    "psatz",
                    [[1, [[3, 1]], "1"], [1, [], "0"], ["2/3", [[0, 1], [3, 1]], "1"]],
                    [[1, "2/3"]],
                ],
                ["psatz", [[1, [[2, 2]], "1"]], [[3, "3/2 - s"]]],
                ["psatz", [[1, [[3, 1]], "1"], ["2/3", [[0, 1], [3, 1]], "1"]], [[1, "-2/3"]]],
            ],
            CLOSE,
            at={"s": "3/2"},
        ),
    ),
]

REJECTED = [
    Case("a consequence without proof", HAVE, have(), (Kind.MALFORMED, "ValueError")),
    Case("a proof too many", HAVE, have(POSITIVE, POSITIVE), (Kind.MALFORMED, "ValueError")),
    Case(
        "a consequence left open",
        HAVE,
        have(OPEN),
        Kind.STRICT,
    ),
    Case(
        "a consequence proved from itself",
        lines("forall x", "have x > 0", "show x > 0"),
        have(["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]),
        (Kind.INDEX, "1"),
    ),
    Case(
        "a consequence proved from a later line",
        lines("forall x", "have x > 0", "given x > 1", "show x > 0"),
        have(POSITIVE),
        (Kind.INDEX, "1"),
    ),
    Case(
        "a consequence that divides by itself",
        lines("forall x", "have 1/x != 0", "show x = x"),
        have(CLOSE, node=CLOSE),
        Kind.DIVISION,
    ),
    Case(
        "a false consequence of nothing",
        lines("forall x", "have 0 = 1", "show x = 1"),
        have(CLOSE, node=CLOSE),
        Kind.NOTHING_FALSE,
    ),
    Case("a root without proof", ROOT, root(), (Kind.MALFORMED, "ValueError")),
    Case(
        "a root of what may be negative",
        lines("forall x", "root s = sqrt(x)", "show s >= 0"),
        root(["psatz", [[1, [[0, 1]], "1"]], []]),
        Kind.SUM,
    ),
    Case(
        "a root of a negative number",
        lines("forall x", "root s = sqrt(-1)", "show x = 1"),
        root(CLOSE),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "a root proved from its own equation",
        lines("forall x", "root s = sqrt(x)", "show s >= 0"),
        root(["psatz", [[1, [[0, 1]], "1"], [1, [], "s"]], [[2, "1"]]]),
        (Kind.INDEX, "2"),
    ),
    Case(
        "a negative value of a root at the point",
        ROOT,
        root(UNDER, at={"x": "2", "s": "-1"}),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "a wrong value of a root at the point",
        ROOT,
        root(UNDER, at={"x": "2", "s": "2"}),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "a root without value at the point",
        ROOT,
        root(UNDER, at={"x": "2"}),
        Kind.VALUES,
    ),
    Case(
        "a root named like a variable",
        lines("forall x", "root x = sqrt(4)", "show x = 2"),
        root(CLOSE),
        (Kind.VARIABLE_TWICE, "x"),
    ),
    Case(
        "a root named like an abbreviation",
        lines("let s = 5", "root s = sqrt(4)", "show 0 = 1"),
        proof(CLOSE, CLOSE, at={"s": "2"}),
        Kind.NAME,
    ),
    Case(
        "a root named twice",
        lines("root s = sqrt(4)", "root s = sqrt(9)", "show 0 = 1"),
        proof(CLOSE, CLOSE, CLOSE, at={"s": "2"}),
        (Kind.VARIABLE_TWICE, "s"),
    ),
    Case(
        "a root of two terms",
        lines("root s = sqrt(4, 9)", "show 0 = 1"),
        proof(CLOSE, CLOSE, at={"s": "2"}),
        (Kind.CALL, "sqrt", "statements, line 2"),
    ),
    Case(
        "a root of another function",
        lines("root s = exp(4)", "show 0 = 1"),
        proof(CLOSE, CLOSE, at={"s": "2"}),
        (Kind.CALL, "sqrt", "statements, line 2"),
    ),
    Case(
        "an abbreviation named like a variable",
        lines("forall x", "let x = 0", "show x = 0"),
        proof(CLOSE, at={"x": "0"}),
        Kind.NAME,
    ),
    Case(
        "an abbreviation of itself",
        lines("forall x", "let a = a + 1", "show 0 = 1"),
        proof(CLOSE, at={"x": "0"}),
        (Kind.UNDECLARED, "a"),
    ),
    Case(
        "an abbreviation named twice",
        lines("forall x", "let a = 1", "let a = 2", "show 1 = 2"),
        proof(CLOSE, at={"x": "0"}),
        Kind.NAME,
    ),
    Case(
        "a name used before its line",
        lines("forall x", "given s > 0", "root s = sqrt(1)", "show 0 = 1"),
        root(CLOSE),
        (Kind.UNDECLARED, "s"),
    ),
]
