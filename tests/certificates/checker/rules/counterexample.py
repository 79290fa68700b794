"""A refutation: values that meet the premises, and a node that shows that the goals fail whatever
the `exists` variables are.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines, refuted

GREATER = lines("forall x y", "given x > y", "show x^2 > y^2")
ROOT = lines("forall x", "given x >= 0", "root s = sqrt(x)", "show s <= 3")
INVERSE = lines("forall x", "exists y", "show x*y = 1")
GAP = lines("forall n", "integer n", "show n <= 0 or n >= 2")
SQRT2 = ["s", "s^2 - 2", "0", "2", CLOSE, CLOSE]  # facts 0: s >= 0, 1: 2 - s >= 0, 2: s^2 - 2 = 0
IRRATIONAL = lines("forall x", "show x^2 != 2 or x < 0")
MET = ["psatz", [[1, [[3, 2]], "1"]], [[2, "2 - s^2"]]]
FAILS = [
    "cases",
    0,
    [
        ["psatz", [[1, [[3, 2]], "1"]], [[2, "2 - s^2"]]],
        ["psatz", [[1, [[0, 1]], "1"], [1, [[3, 1]], "1"]], []],
    ],
]


def values(**at: str) -> dict[str, str]:
    return at


ACCEPTED = [
    Case("numbers", GREATER, refuted(values(x="1", y="-2")), "refuted"),
    Case("a root", ROOT, refuted(values(x="16", s="4")), "refuted"),
    Case("nothing exists", INVERSE, refuted(values(x="0")), "refuted"),
    Case(
        "nothing exists between",
        lines("forall x", "exists y", "with y > x", "show y < x"),
        refuted(values(x="0"), goals=["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]),
        "refuted",
    ),
    Case("an integer", GAP, refuted(values(n="1")), "refuted"),
    Case(
        "an adjoined number",
        IRRATIONAL,
        refuted(values(x="s"), goals=FAILS, adjoined=[SQRT2]),
        "refuted",
    ),
    Case(
        "no integer exists",
        lines("forall x", "integer n", "exists n", "show 2*n = x"),
        refuted(
            values(x="1"),
            goals=[
                "sign",
                "n",
                ["psatz", [[2, [[1, 1]], "1"], [1, [], "1"]], [[0, "1"]]],
                ["psatz", [[1, [], "1"]], [[0, "1"], [1, "-2"]]],
                ["integral", 1, ["psatz", [[2, [[2, 1]], "1"], [1, [], "1"]], [[0, "-1"]]]],
            ],
        ),
        "refuted",
    ),
]

REJECTED = [
    Case(
        "a root that is used before its line",
        lines("forall x", "given s > 3", "root s = sqrt(x)", "show x < 16"),
        refuted(values(x="16", s="4")),
        (Kind.UNDECLARED, "s"),
    ),
    Case(
        "a root of itself",
        lines("root s = sqrt(s)", "show s < 1"),
        refuted(values(s="1")),
        (Kind.UNDECLARED, "s"),
    ),
    Case(
        "a division that only the value allows",
        lines("forall x", "show 1/x > 2"),
        refuted(values(x="1")),
        Kind.DIVISION,
    ),
    Case("a premise that fails", GREATER, refuted(values(x="-2", y="1")), Kind.NOTHING_FALSE),
    Case("a goal that holds", GREATER, refuted(values(x="2", y="1")), Kind.NOTHING_FALSE),
    Case(
        "a premise left open",
        GREATER,
        refuted(values(x="1", y="-2"), premises=OPEN),
        Kind.STRICT,
    ),
    Case(
        "a goal left open",
        GREATER,
        refuted(values(x="1", y="-2"), goals=OPEN),
        Kind.STRICT,
    ),
    Case(
        "a value left out",
        GREATER,
        refuted(values(x="1")),
        Kind.VALUES,
    ),
    Case(
        "a value too many",
        GREATER,
        refuted(values(x="1", y="-2", z="0")),
        Kind.NO_VARIABLE,
    ),
    Case(
        "a free variable as value", GREATER, refuted(values(x="x", y="-2")), (Kind.UNDECLARED, "x")
    ),
    Case(
        "no second node",
        GREATER,
        {"refuted": ["rule/case", [], {"x": "1", "y": "-2"}, CLOSE]},
        Kind.WITNESS,
    ),
    Case(
        "a third node",
        GREATER,
        {"refuted": ["rule/case", [], {"x": "1", "y": "-2"}, CLOSE, CLOSE, CLOSE]},
        Kind.WITNESS,
    ),
    Case(
        "another statement's name",
        GREATER,
        refuted(values(x="1", y="-2"), name="rule/other"),
        Kind.WITNESS,
    ),
    Case(
        "a case that is not empty",
        GREATER,
        {"refuted": ["empty", CLOSE]},
        Kind.NOTHING_FALSE,
    ),
    Case("the other root", ROOT, refuted(values(x="16", s="-4")), Kind.NOTHING_FALSE),
    Case(
        "a value for what exists",
        INVERSE,
        refuted(values(x="1", y="0")),
        Kind.VALUES,
    ),
    Case("only one candidate excluded", INVERSE, refuted(values(x="1")), Kind.NOTHING_FALSE),
    Case(
        "a half for an integer",
        GAP,
        refuted(values(n="1/2")),
        Kind.VALUES,
    ),
    Case(
        "a false consequence that the statement claims",
        lines("forall x", "have x > 0", "show x != -1"),
        refuted(values(x="-1")),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "an abbreviation that captures what exists",
        lines("forall x", "let y = x", "exists y", "show y = x + 1"),
        refuted(values(x="0")),
        Kind.NAME,
    ),
    Case(
        "an adjoined number that passes for an integer",
        lines("forall n", "integer n", "show n <= 0 or n >= 1", name="rule/gap")
        + "\n"
        + lines("forall K_", "integer K", "exists K", "show 0 = 0"),
        refuted(
            values(K_="K/2"),
            adjoined=[["K", "K - 1", "1", "1", CLOSE, CLOSE]],
            goals=[
                "use",
                "rule/gap",
                {"n": "K_"},
                {},
                [
                    "cases",
                    0,
                    [
                        ["psatz", [[2, [[3, 1]], "1"], [1, [], "1"]], [[2, "1"]]],
                        ["psatz", [[2, [[3, 1]], "1"], [1, [], "1"]], [[2, "-1"]]],
                    ],
                ],
            ],
        ),
        Kind.SUM,
        {
            "rule/gap": {
                "certified": [
                    "proof",
                    [],
                    ["integral", 0, ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]],
                ],
                "point": ["rule/gap", [], {"n": "0"}, CLOSE],
            }
        },
    ),
    Case(
        "an adjoined number that is a real, for an integer",
        GAP,
        refuted(values(n="s"), adjoined=[["s", "2*s - 1", "0", "1", CLOSE, CLOSE]]),
        Kind.VALUES,
    ),
]

ADJOINED: list[tuple[str, Json, str]] = [
    ("no change of sign", ["s", "s^2 + 1", "0", "2", CLOSE, CLOSE], Kind.NOTHING_FALSE),
    (
        "the sign changes the other way",
        ["s", "2 - s^2", "0", "2", CLOSE, CLOSE],
        Kind.NOTHING_FALSE,
    ),
    (
        "ends swapped, signs that suit",
        ["s", "1 - s", "2", "0", CLOSE, CLOSE],
        Kind.NOTHING_FALSE,
    ),
    ("ends swapped", ["s", "s^2 - 2", "2", "0", CLOSE, CLOSE], Kind.NOTHING_FALSE),
    ("both ends above", ["s", "s^2 - 2", "2", "3", CLOSE, CLOSE], Kind.NOTHING_FALSE),
    (
        "an end below left open",
        ["s", "s^2 - 2", "0", "2", OPEN, CLOSE],
        Kind.STRICT,
    ),
    (
        "an end above left open",
        ["s", "s^2 - 2", "0", "2", CLOSE, OPEN],
        Kind.STRICT,
    ),
    (
        "an end that mentions itself",
        ["s", "s^2 - 2", "0", "s", CLOSE, CLOSE],
        (Kind.UNDECLARED, "s"),
    ),
    (
        "a pole between the ends",
        ["s", "1/s", "-1", "1", CLOSE, CLOSE],
        Kind.DIVISION,
    ),
    ("a name that is none", ["2", "s^2 - 2", "0", "2", CLOSE, CLOSE], (Kind.UNDECLARED, "s")),
    ("a name with a blank", ["s t", "4", "0", "2", CLOSE, CLOSE], Kind.NOTHING_FALSE),
    ("a missing node", ["s", "s^2 - 2", "0", "2", CLOSE], (Kind.MALFORMED, "TypeError")),
    ("a decimal end", ["s", "s^2 - 2", "0", "2.0", CLOSE, CLOSE], (Kind.TEXT, "2.0")),
]
REJECTED += [
    Case(
        f"an adjoined number, {defect}",
        IRRATIONAL,
        refuted(values(x="s"), MET, FAILS, [entry]),
        reason,
    )
    for defect, entry, reason in ADJOINED
]
REJECTED += [
    Case(
        "an adjoined number named twice",
        IRRATIONAL,
        refuted(values(x="s"), CLOSE, FAILS, [SQRT2, SQRT2]),
        Kind.NAME,
    ),
    Case(
        "a number that does not exist makes anything fail",
        lines("show 0 = 0"),
        refuted(
            {},
            goals=["psatz", [[1, [], "s"], [1, [], "1"]], [[2, "-1"]]],
            adjoined=[["s", "s^2 + 1", "0", "0", CLOSE, CLOSE]],
        ),
        Kind.NOTHING_FALSE,
    ),
]
