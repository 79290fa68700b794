"""Division: only by what an earlier strict line makes nonzero, at top level or inside a top-level
`and`.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, Case, lines, proof

ZERO, ONE = {"x": "0"}, {"x": "1"}


def same(*rows: str, divisor: str = "x", variables: str = "x") -> str:
    return lines(f"forall {variables}", *rows, f"show 1/({divisor}) = 1/({divisor})")


def at(value: str, variables: str = "x") -> dict[str, str]:
    return dict.fromkeys(variables.split(), value)


LICENSED = [
    ("a positive line", same("given x > 0"), ONE),
    ("a negative line", same("given x < 0"), {"x": "-1"}),
    ("a line that says not zero", same("given x != 0"), ONE),
    ("a negated equation", same("given not x = 0"), ONE),
    (
        "a sign told after all",
        lines("forall x", "given x != 0", "given x > 0", "show 1/x > 0"),
        ONE,
    ),
    (
        "a sign told before",
        lines("forall x", "given x > 0", "given x != 0", "show 1/x > 0"),
        ONE,
    ),
    ("a negative sign", lines("forall x", "given x < 0", "show 1/x < 0"), {"x": "-1"}),
    ("an even power", lines("forall x", "given x != 0", "show 1/x^2 > 0"), ONE),
    ("what is not 0", lines("forall x", "given x != 0", "show 1/x != 0"), ONE),
    ("a conjunct", same("given x > 0 and x < 2"), ONE),
    ("a chain", same("given 0 < x < 2"), ONE),
    ("a range", same("range x > 0"), ONE),
    ("a multiple", same("given x > 0", divisor="-3*x/2"), ONE),
    ("a power", same("given x > 0", divisor="x^3"), ONE),
    ("a sum licensed whole", same("given 1 - x^2 > 0", divisor="x^2 - 1"), ZERO),
    ("factors", same("given x > 0 and x + 1 > 0", divisor="x*(x + 1)"), ONE),
    (
        "a product licensed by a relation of quotients",
        same("given x > 0", "given 1/x > 2", divisor="1 - 2*x"),
        {"x": "1/3"},
    ),
    ("a number", lines("forall x", "show x/3 = x*(1/3)"), ZERO),
    ("a quotient", lines("forall x", "given x > 0", "show 1/(1/x) = x"), ONE),
    ("a power zero", lines("forall x", "show 1/x^0 = 1"), ZERO),
]
ACCEPTED = [Case(defect, text, proof(CLOSE, at=point)) for defect, text, point in LICENSED]

UNLICENSED = [
    ("no line", same()),
    ("a weak line", same("given x >= 0")),
    ("an equation", same("given x = 1")),
    (Kind.CASES, same("given x > 0 or x > 1")),
    ("an implication", same("given implies(x > -9, x > 0)")),
    ("an equivalence", same("given iff(x > 0, x > 1)")),
    ("a negated conjunction", same("given not (x = 0 and x = 1)")),
    ("another polynomial", same("given x > 0", divisor="x + 1")),
    ("a sum of licensed terms", same("given x > 0", divisor="x + x^2")),
    ("only one factor", same("given x > 0", divisor="x*(x - 5)")),
    ("a later line", lines("forall x", "let a = 1/x", "given x > 0", "show a = a")),
    ("the line itself", lines("forall x", "given 1/x > 0", "show x = x")),
    ("the goal itself", lines("forall x", "show x != 0 and 1/x != 0")),
    ("an expanded product", same("given x > 0 and x + 1 > 0", divisor="x^2 + x")),
]
REJECTED = [
    Case(defect, text, proof(CLOSE, at=ONE), Kind.DIVISION) for defect, text in UNLICENSED
] + [
    Case(
        "division by zero",
        lines("forall x", "show 1/0 = 1/0"),
        proof(CLOSE, at=ONE),
        Kind.ZERO_DIVISION,
    ),
    Case(
        "division by what is identically zero",
        lines("forall x", "show 1/(x - x) = 1"),
        proof(CLOSE, at=ONE),
        Kind.ZERO_DIVISION,
    ),
    Case(
        "a quotient taken for its numerator",
        lines("forall x", "given x > 0", "show 1/(1/x) = 1"),
        proof(CLOSE, at=ONE),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "a sign turned",
        lines("forall x", "given x < 0", "show 1/x > 0"),
        proof(CLOSE, at={"x": "-1"}),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "a cube whose sign is unknown",
        lines("forall x", "given x != 0", "show 1/x^3 > 0"),
        proof(CLOSE, at=ONE),
        (Kind.NOTHING_FALSE, "x != 0; -x >= 0"),
    ),
    Case(
        "a negative exponent",
        lines("forall x", "given x > 0", "show x^-1 = 1/x"),
        proof(CLOSE, at=ONE),
        (Kind.TERM, "x ** (-1)"),
    ),
    Case(
        "a variable exponent",
        lines("forall x", "show 2^x = 2^x"),
        proof(CLOSE, at=ONE),
        (Kind.TERM, "2 ** x"),
    ),
    Case(
        "a fractional exponent",
        lines("forall x", "show x^(1/2) = x^(1/2)"),
        proof(CLOSE, at=ONE),
        Kind.TERM,
    ),
    Case(
        "an exponent beyond the limit",
        lines("forall x", "show x^4001 = x^4001"),
        proof(CLOSE, at=ONE),
        (Kind.EXPONENT, "4001"),
    ),
    Case(
        "a tower of exponents",
        lines("forall x", "show x^2^3 = x^8"),
        proof(CLOSE, at=ONE),
        Kind.TERM,
    ),
    Case(
        "a quotient whose sign is unknown",
        lines("forall x", "given x != 0", "show 1/x > 0"),
        proof(["psatz", [[1, [[1, 1]], "1"], [1, [[0, 2]], "1"]], []], at=ONE),
        Kind.SUM,
    ),
]
