"""["interval", i, j, k]: fact i is negative on the whole interval that facts j and k bound
(Sturm).
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines, proof

BOUNDED = (
    "forall x",
    "given x >= 0",
    "given x <= 1",
)  # facts 0: x >= 0, 1: 1 - x >= 0; what is shown, negated, is fact 2
LINEAR = lines(*BOUNDED, "show x - 2 < 0")
CUBIC = lines(*BOUNDED, "show 27*x*(1 - x)^2 - 4 <= 1/1000")
TOUCHING = lines(*BOUNDED, "show (2*x - 1)^2 > 0")
ROOT_AT_END = lines(*BOUNDED, "show x*(x + 1) > 0")


def on(low: Json, high: Json, fact: Json = 2) -> Json:
    return proof(["interval", fact, low, high], at={"x": "0"})


ACCEPTED = [
    Case("a line", LINEAR, on(0, 1)),
    Case("a cubic that nearly touches", CUBIC, on(0, 1)),
    Case(
        "strict bounds",
        lines("forall x", "given 0 < x", "given x < 1", "show x^2 <= 2"),
        proof(["interval", 2, 0, 1], at={"x": "1/2"}),
    ),
    Case(
        "a scaled bound",
        lines("forall x", "given 3*x >= 1", "given 5*x <= 4", "show x^2 < 65/100"),
        proof(["interval", 2, 0, 1], at={"x": "1/2"}),
    ),
    Case(
        "an interval that is one point",
        lines("forall x", "given x >= 1", "given x <= 1", "show x^2 < 2"),
        proof(["interval", 2, 0, 1], at={"x": "1"}),
    ),
    Case(
        "an empty interval",
        lines("forall x", "show not (x >= 2 and x <= 1)"),
        proof(["interval", 0, 0, 1], at={"x": "0"}),
    ),
    Case("bounds that exclude one another", LINEAR, on(2, 1)),
    Case("a repeated root outside", lines(*BOUNDED, "show (x - 2)^2*(x - 3)^3 < 0"), on(0, 1)),
]

REJECTED = [
    Case(
        "a bound of degree two that holds elsewhere as well",
        lines("forall x", "given x^2 + x >= 0", "given x <= 1", "show x > -5"),
        on(0, 1),
        Kind.BOUND,
    ),
    Case(
        "one point, where the fact holds",
        lines("forall x", "given x >= 1", "given x <= 1", "show x^2 < 1"),
        proof(["interval", 2, 0, 1], at={"x": "1"}),
        Kind.INTERVAL,
    ),
    Case("bounds swapped", LINEAR, on(1, 0), Kind.BOUND),
    Case("one bound used twice", LINEAR, on(0, 0), Kind.BOUND),
    Case(
        "a bound of degree two",
        lines("forall x", "given x^2 >= 0", "given x <= 1", "show x < 2"),
        on(0, 1),
        Kind.BOUND,
    ),
    Case("a root that touches", TOUCHING, on(0, 1), Kind.INTERVAL),
    Case(
        "a root at the lower end",
        ROOT_AT_END,
        on(0, 1),
        Kind.INTERVAL,
    ),
    Case(
        "a root at the upper end",
        lines(*BOUNDED, "show (x - 1)*(x + 1) < 0"),
        on(0, 1),
        Kind.END_ROOT,
    ),
    Case(
        "a root on either side of 0",
        lines("forall x", "given x >= -1", "given x <= 1", "show 1 - 4*x^2 < 0"),
        on(0, 1),
        Kind.INTERVAL,
    ),
    Case(
        "two roots inside",
        lines(*BOUNDED, "show (4*x - 1)*(4*x - 3) > 0"),
        on(0, 1),
        Kind.INTERVAL,
    ),
    Case(
        "an equation for the fact",
        lines(*BOUNDED, "show x != 2"),
        on(0, 1),
        Kind.INTERVAL,
    ),
    Case(
        "what is not zero for the fact",
        lines(*BOUNDED, "given x != 0", "show x < 2"),
        on(0, 1),
        Kind.INTERVAL,
    ),
    Case(
        "two variables",
        lines("forall x y", "given x >= 0", "given x <= 1", "show x - 2 < y^2"),
        proof(["interval", 2, 0, 1], at={"x": "0", "y": "0"}),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case(
        "a bound on another variable",
        lines("forall x y", "given x >= 0", "given y <= 1", "show x < 2"),
        proof(["interval", 2, 0, 1], at={"x": "0", "y": "0"}),
        (Kind.ONE_VARIABLE, "x"),
    ),
    Case(
        "an equation for a bound",
        lines("forall x", "given x = 0", "given x <= 1", "show x < 2"),
        on(0, 1),
        Kind.BOUND,
    ),
    Case("a negative number", LINEAR, on(0, 1, -1), (Kind.INDEX, "-1")),
    Case(
        "a missing bound",
        LINEAR,
        proof(["interval", 2, 0], at={"x": "0"}),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case(
        "a number too many",
        LINEAR,
        proof(["interval", 2, 0, 1, CLOSE], at={"x": "0"}),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case("nothing but text", LINEAR, on("0", "1"), (Kind.INDEX, "0")),
    Case(
        "an open node instead",
        LINEAR,
        proof(OPEN, at={"x": "0"}),
        Kind.STRICT,
    ),
]
