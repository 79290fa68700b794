"""["close"]: the state assumes a false constant."""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, lines, proof


def power_sum(name: str, count: int) -> str:
    return "(" + " + ".join(f"{name}^{k}" for k in range(count)) + ")"


ACCEPTED = [
    Case("a true constant", lines("show 1 < 2"), proof(CLOSE)),
    Case(
        "an identity",
        lines("forall x y", "show (x + y)^2 = x^2 + 2*x*y + y^2"),
        proof(CLOSE, at={"x": "0", "y": "0"}),
    ),
    Case(
        "an identity with a licensed denominator",
        lines("forall x", "given x > 0", "show x/x^2 = 1/x"),
        proof(CLOSE, at={"x": "1"}),
    ),
    Case("a chain", lines("show 0 <= 1 < 3/2 != 2 = 4/2 > 1 >= 1"), proof(CLOSE)),
    Case(
        "connectives",
        lines("show iff(1 < 2, not 2 < 1) and implies(1 = 2, 3 = 4) and (0 = 1 or 0 = 0)"),
        proof(CLOSE),
    ),
    Case(
        "connectives of what differs",
        lines("show implies(1 = 2, 1 = 1) and not implies(1 = 1, 1 = 2) and not iff(1 = 2, 1 = 1)"),
        proof(CLOSE),
    ),
    Case("an equivalence the other way", lines("show not iff(1 = 1, 1 = 2)"), proof(CLOSE)),
    Case(
        "an abbreviation",
        lines("forall x", "let a = x + 1", "show a^2 - 1 = x*(a + 1)"),
        proof(CLOSE, at={"x": "0"}),
    ),
    Case("the longest number", lines("show (2^4000)^9*2^3999 > 1"), proof(CLOSE)),
    Case("the longest denominator", lines("show (1/2^4000)^9/2^3999 > 0"), proof(CLOSE)),
    Case(
        "the highest degree",
        lines("forall x", "show 2*(x^3999*x) = 2*x^4000"),
        proof(CLOSE, at={"x": "0"}),
    ),
    Case(
        "as many terms as may be",
        lines(
            "forall x y", "show {0}*{1} = {1}*{0}".format(power_sum("x", 250), power_sum("y", 400))
        ),
        proof(CLOSE, at={"x": "0", "y": "0"}),
    ),
]

ACCEPTED += [
    Case(
        "a denominator of the greatest length",
        lines("forall x", "show {0} = {0}".format("((x + 1)/2^3999)^10*((x + 1)/2^9)")),
        proof(CLOSE, at={"x": "-1"}),
    ),
    Case(
        "a power 0 of a sum",
        lines("forall x y", "show (x + y)^0 = 1"),
        proof(CLOSE, at={"x": "0", "y": "0"}),
    ),
]
REJECTED = [
    Case(
        "a power so high that it would pass for another variable",
        lines("forall x y", "show " + "*".join(["x^4000"] * 16) + "*x^1536 = y"),
        proof(CLOSE, at={"x": "0", "y": "0"}),
        (Kind.SIZE, "degree 65536"),
    ),
    Case(
        "the same of sums",
        lines("forall x y", "show " + "*".join(["(x^4000 + 1 - 1)"] * 16) + "*x^1536 = y"),
        proof(CLOSE, at={"x": "0", "y": "0"}),
        (Kind.SIZE, "degree 65536"),
    ),
    Case(
        "a number too long",
        lines("show (2^4000)^10 > 1"),
        proof(CLOSE),
        (Kind.SIZE, "degree 0, 40"),
    ),
    Case(
        "a number too long beside a short one",
        lines("forall x", "show ((2^4000)^9*x + 1)*2^4000 > 0"),
        proof(CLOSE, at={"x": "0"}),
        (Kind.SIZE, "40001 bits"),
    ),
    Case(
        "a denominator too long",
        lines("show (1/2^4000)^10 > 0"),
        proof(CLOSE),
        (Kind.SIZE, "a denominator"),
    ),
    Case(
        "more terms than may be",
        lines("forall x y", "show {}*{} > 0".format(power_sum("x", 250), power_sum("y", 401))),
        proof(CLOSE, at={"x": "0", "y": "0"}),
        (Kind.SIZE, "too many terms"),
    ),
    Case("a power of a number without end", lines("show 2^4001 > 1"), proof(CLOSE), Kind.EXPONENT),
    Case("a false constant", lines("show 2 < 1"), proof(CLOSE), Kind.NOTHING_FALSE),
    Case(
        "a formula with a minus", lines("show -(2 < 1)"), proof(CLOSE), (Kind.FORMULA, "-(2 < 1)")
    ),
    Case(
        "a call of a call",
        lines("show implies(1 < 2, 1 < 2)(1, 2)"),
        proof(CLOSE),
        (Kind.FORMULA, "implies(1 < 2, 1 < 2)(1, 2)"),
    ),
    Case("a false end of a chain", lines("show 0 < 1 < 1"), proof(CLOSE), Kind.NOTHING_FALSE),
    Case(
        "an equation with a wrong coefficient",
        lines("forall x", "show (x + 1)^2 = x^2 + x + 1"),
        proof(CLOSE, at={"x": "0"}),
        (Kind.NOTHING_FALSE, "x != 0"),
    ),
    Case(
        "what needs more than constants",
        lines("forall x", "show x^2 >= 0"),
        proof(CLOSE, at={"x": "0"}),
        (Kind.NOTHING_FALSE, "-x^2 > 0"),
    ),
    Case(
        "something left over",
        lines("show 1 < 2"),
        proof([*CLOSE, 1]),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case("an unknown rule", lines("show 1 < 2"), proof(["trust me"]), (Kind.RULE, "['trust me']")),
    Case("a rule that is no text", lines("show 1 < 2"), proof([["close"]]), Kind.RULE),
    Case("a node that is an object", lines("show 1 < 2"), proof({"close": 1}), Kind.RULE),
    Case("a node that is no list", lines("show 1 < 2"), proof("close"), (Kind.RULE, "close")),
    Case("an empty node", lines("show 1 < 2"), proof([]), (Kind.RULE, "[]")),
    Case(
        "no term at all",
        lines("show 1 < 2"),
        proof(OPEN),
        Kind.STRICT,
    ),
]
