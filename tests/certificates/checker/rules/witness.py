"""Statements with `exists`: terms for what exists, from all that the premises say; and the point
that meets the premises.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, Case, Json, lines, proof, witness

NAME = "rule/case"
ABOVE = lines("forall x", "exists y", "with y > x", "show y > 0")
INVERSE = lines("forall x", "given x != 0", "exists y", "show x*y = 1")
WHOLE = lines("forall x", "given x > 0", "exists n", "with n < x", "show n = 0")
SQUARE = [
    "cases",
    0,
    [
        ["psatz", [[1, [[0, 1]], "1"], [1, [], "x - 1/2"], ["3/4", [], "1"]], []],
        ["psatz", [[1, [[0, 1]], "1"], [1, [], "x"], [1, [], "1"]], []],
    ],
]
ZERO = {"x": "0"}


def found(terms: Json, node: Json = CLOSE, name: str = NAME, adjoined: Json = ()) -> Json:
    return [name, list(adjoined), terms, node]


def by(something: Json, at: dict[str, str] | None = None) -> Json:
    return witness(something, at=ZERO if at is None else at)


def inverse(terms: Json) -> Json:
    return by(found(terms), {"x": "1"})


ACCEPTED = [
    Case("a term", ABOVE, by(found({"y": "x^2 + 1"}, SQUARE))),
    Case("a term that divides by what a premise makes nonzero", INVERSE, inverse({"y": "1/x"})),
    Case(
        "a term for each sign",
        lines("forall x", "exists y", "show x*y >= 0 and y != 0"),
        by(
            [
                "sign",
                "x",
                found({"y": "-1"}, ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]),
                found({"y": "1"}, ["psatz", [[1, [[1, 1]], "1"]], [[0, "1"]]]),
                found({"y": "1"}, ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]),
            ]
        ),
    ),
    Case(
        "a case that cannot be",
        lines("forall x", "given x > 0", "exists y", "show y*x = 1"),
        by(
            [
                "sign",
                "x",
                ["empty", ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]],
                ["empty", ["psatz", [[1, [[0, 1]], "1"]], [[1, "-1"]]]],
                found({"y": "1/x"}),
            ],
            {"x": "1"},
        ),
    ),
    Case("an integer", lines("integer n", "exists n", "show n = 3"), by(found({"n": "3"}), {})),
]

ACCEPTED.append(
    Case(
        "a goal that divides by what an earlier goal makes nonzero",
        lines("forall x", "exists y", "with y > 0", "show 1/y = 2"),
        by(found({"y": "1/2"})),
    )
)

REJECTED = [
    Case("a term that fails", ABOVE, by(found({"y": "x - 1"}, SQUARE)), (Kind.INDEX, "0")),
    Case(
        "a proof for a statement with exists",
        ABOVE,
        proof(CLOSE, at=ZERO),
        Kind.WAY,
    ),
    Case(
        "a witness for a statement without exists",
        lines("forall x", "show x = x"),
        by(found({})),
        Kind.WAY,
    ),
    Case(
        "a way that is neither",
        ABOVE,
        {"certified": ["", [], CLOSE], "point": [NAME, [], ZERO, CLOSE]},
        Kind.WAY,
    ),
    Case("no term", INVERSE, inverse({}), Kind.VALUES),
    Case(
        "a term for a universal variable",
        INVERSE,
        inverse({"x": "1", "y": "1"}),
        Kind.VALUES,
    ),
    Case(
        "a term for nothing",
        INVERSE,
        inverse({"y": "1/x", "z": "0"}),
        Kind.NO_VARIABLE,
    ),
    Case(
        "a term that divides by what may vanish",
        lines("forall x", "exists y", "show implies(x != 0, x*y = 1)"),
        by(found({"y": "1/x"})),
        Kind.DIVISION,
    ),
    Case(
        "a licence that the goal itself would give",
        lines("forall x", "exists y", "with x != 0", "show x*y = 1"),
        by(found({"y": "1/x"})),
        Kind.DIVISION,
    ),
    Case("an undeclared name", INVERSE, inverse({"y": "z"}), (Kind.UNDECLARED, "z")),
    Case(
        "another statement's name",
        INVERSE,
        by(found({"y": "1/x"}, name="rule/other"), {"x": "1"}),
        Kind.WITNESS,
    ),
    Case(
        "a node too many",
        INVERSE,
        by([*found({"y": "1/x"}), CLOSE], {"x": "1"}),
        Kind.WITNESS,
    ),
    Case(
        "no node",
        INVERSE,
        by([NAME, [], {"y": "1/x"}], {"x": "1"}),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case(
        "a sign left out",
        INVERSE,
        by(["sign", "x", found({"y": "1/x"}), found({"y": "1/x"})], {"x": "1"}),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case(
        "a case that is not empty",
        INVERSE,
        by(["sign", "x", ["empty", CLOSE], ["empty", CLOSE], found({"y": "1/x"})], {"x": "1"}),
        (Kind.NOTHING_FALSE, "x != 0; -x > 0"),
    ),
    Case(
        "an empty case with something left over",
        INVERSE,
        by(["empty", CLOSE, CLOSE], {"x": "1"}),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case(
        "a real for an integer",
        lines("forall x", "integer n", "exists n", "show n = x"),
        by(found({"n": "x"})),
        Kind.VALUES,
    ),
    Case(
        "a half for an integer",
        lines("integer n", "exists n", "show 2*n = 1"),
        by(found({"n": "1/2"}), {}),
        Kind.VALUES,
    ),
    Case(
        "one of two conjuncts",
        WHOLE,
        by(found({"n": "-1"}, ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]), {"x": "1"}),
        Kind.INDEX,
    ),
    Case(
        "an existing variable in a premise",
        lines("forall x", "given y > x", "exists y", "show y > x"),
        by(found({"y": "x + 1"})),
        (Kind.UNDECLARED, "y"),
    ),
    Case(
        "an existing variable named like an abbreviation",
        lines("forall x", "let y = x", "exists y", "show y = x + 1"),
        by(found({"y": "x + 1"})),
        Kind.NAME,
    ),
    Case(
        "an abbreviation named like an existing variable",
        lines("forall x", "exists y", "let y = x", "show y = x"),
        by(found({"y": "x"})),
        Kind.NAME,
    ),
    Case(
        "an existing variable named like a universal one",
        lines("forall x", "exists x", "show x = 1"),
        by(found({"x": "1"})),
        Kind.VARIABLE_TWICE,
    ),
]
