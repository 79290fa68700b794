"""Sharp ranges: for all parameters in the domain, the statements named hold <=> the condition
holds.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines

SQUARES = lines("forall a x", "range a > 5", "given x >= 1", "show x^2 >= a", name="rule/squares")
SHARP = ("sharp rule/squares", "over a", "domain a > 0 and a < 9", "holds a <= 1")
TEXT = SQUARES + "\n" + lines(*SHARP)
# facts inside: a > 0, 9 - a > 0, 1 - a >= 0, x - 1 >= 0, a - x^2 > 0
INSIDE = [
    "proof",
    [],
    ["psatz", [[1, [[4, 1]], "1"], [1, [[2, 1]], "1"], [2, [[3, 1]], "1"], [1, [[3, 2]], "1"]], []],
]
# facts outside: a > 0, 9 - a > 0, a - 1 > 0
MET = [
    "cases",
    0,
    [
        ["psatz", [[1, [[0, 1]], "1"], [1, [[3, 1]], "1"]], []],
        ["psatz", [[1, [[1, 1]], "1"], [1, [[3, 1]], "1"]], []],
    ],
]
FAILS = ["psatz", [[1, [[2, 1]], "1"], [1, [[3, 1]], "1"]], []]
LOOSE = [
    "proof",
    [],
    ["psatz", [[1, [[4, 1]], "1"], [1, [[2, 1]], "1"], [1, [[3, 1]], "1"], [1, [[3, 2]], "1"]], []],
]
EARLIER = {name: {"unknown": "holds only in a range"} for name in ("rule/squares", "rule/counts")}


def point(values: Json, node: Json = CLOSE, name: str = "rule/squares") -> Json:
    return {name: [name, [], values, node]}


HALF = point({"a": "1/2", "x": "1"})


def sharp(inside: Json, outside: Json, points: Json = None) -> Json:
    return {"certified": [inside, outside, HALF if points is None else points]}


def found(outside: Json = FAILS, premises: Json = MET, values: Json = None) -> Json:
    return ["rule/squares", [], {"x": "1"} if values is None else values, premises, outside]


def case(defect: str, certificate: Json, expected: str = "certified", text: str = TEXT) -> Case:
    return Case(defect, text, certificate, expected, EARLIER)


def over(*rows: str) -> str:
    return SQUARES + "\n" + lines(*rows)


VALID = sharp({"rule/squares": INSIDE}, found())
SQRT = (
    "sharp rule/squares",
    "over a",
    "domain a > 0 and a < 9",
    "number c = root(a^2 - a, 1/2, 2)",
    "holds a <= 1",
)

# n <= x for all x >= 1 exactly where n < 2, which is so for integers only
COUNTS = ("forall n x", "integer n", "given x >= 1", "show x >= n")
BELOW_2 = ("over n", "domain n > 0 and n < 9", "holds n < 2")
# facts inside: n > 0, 9 - n > 0, 2 - n > 0, x - 1 >= 0, n - x > 0, 1 - n >= 0; outside: n > 0, 9 -
# n > 0, n - 2 >= 0, 1 - n >= 0
COUNTED = ["proof", [], ["integral", 2, ["psatz", [[1, [[k, 1]], "1"] for k in (3, 4, 5)], []]]]
BEYOND = ["psatz", [[1, [[2, 1]], "1"], [1, [[3, 1]], "1"], [1, [], "1"]], []]


def counted(
    defect: str, expected: str = "certified", rows: tuple[str, ...] = COUNTS, n: str = "1"
) -> Case:
    text = lines(*rows, name="rule/squares") + "\n" + lines("sharp rule/squares", *BELOW_2)
    met = [
        "cases",
        0,
        [
            ["psatz", [[1, [[0, 1]], "1"], [1, [[3, 1]], "1"]], []],
            ["psatz", [[1, [[1, 1]], "1"], [1, [[3, 1]], "1"]], []],
        ],
    ]
    return Case(
        defect,
        text,
        sharp({"rule/squares": COUNTED}, found(BEYOND, met), point({"n": n, "x": "1"})),
        expected,
        EARLIER,
    )


def from_1(defect: str, expected: str | Kind, *rows: str) -> Case:
    """a >= 1, for a > 0, is so exactly where a >= 1: everywhere, if a is an integer."""
    text = lines("forall a", *rows, "show a >= 1", name="rule/squares") + "\n"
    text += lines("sharp rule/squares", "over a", "domain a > 0", "holds a >= 1")
    inside = ["proof", [], ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]]
    below = ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]
    certificate = sharp(
        {"rule/squares": inside}, ["empty", ["integral", 0, below]], point({"a": "1"})
    )
    return Case(defect, text, certificate, expected, EARLIER)


ACCEPTED = [
    from_1("an integer parameter outside", "certified", "integer a"),
    case("inside and outside", VALID),
    counted("an integer parameter"),
    case("a number", VALID, text=over(*SQRT)),
    case(
        "a number with coefficients -1 and 1",
        VALID,
        text=over(*SHARP[:3], "number c = root(2*a - 1, 0, 1)", SHARP[3]),
    ),
    case(
        "a number with coefficients 1, 0, 1 and -1",
        VALID,
        text=over(*SHARP[:3], "number c = root(1 - 3*a + 6*a^2 - 5*a^3, 0, 1)", SHARP[3]),
    ),
    case(
        "outside by cases of a sign",
        sharp(
            {"rule/squares": INSIDE},
            [
                "sign",
                "a - 1",
                ["empty", ["psatz", [[1, [[2, 1]], "1"], [1, [[3, 1]], "1"]], []]],
                ["empty", ["psatz", [[1, [[2, 1]], "1"]], [[3, "-1"]]]],
                found(
                    ["psatz", [[1, [[2, 1]], "1"], [1, [[4, 1]], "1"]], []],
                    [
                        "cases",
                        0,
                        [
                            ["psatz", [[1, [[0, 1]], "1"], [1, [[4, 1]], "1"]], []],
                            ["psatz", [[1, [[1, 1]], "1"], [1, [[4, 1]], "1"]], []],
                        ],
                    ],
                ),
            ],
        ),
    ),
]

MAP = lines("forall x K", "integer K", "iterates x -> x + 1", "after K -> x + K", name="rule/map")
EMPTY = ["empty", CLOSE]
CONTRADICTION = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]

REJECTED = [
    counted(
        "a parameter that is no integer",
        Kind.INTEGRAL,
        (COUNTS[0], *COUNTS[2:]),
    ),
    counted("a point between integers", Kind.VALUES, n="3/2"),
    case(
        "a parameter that is an integer in one statement only",
        sharp(
            {"rule/squares": INSIDE, "rule/counts": COUNTED},
            found(),
            HALF | point({"a": "1", "x": "1"}, name="rule/counts"),
        ),
        Kind.SHARP_INTEGERS,
        SQUARES
        + "\n"
        + lines("forall a x", "integer a", "given x >= 1", "show x >= a", name="rule/counts")
        + "\n"
        + lines("sharp rule/squares rule/counts", *SHARP[1:]),
    ),
    Case(
        "a statement of another kind",
        MAP + "\n" + lines("sharp rule/map", "over x", "domain x > 0", "holds 0 = 0"),
        sharp({"rule/map": ["proof", [], CLOSE]}, EMPTY, point({"x": "1"}, name="rule/map")),
        Kind.SHARP,
        {"rule/map": {"certified": {"start": ["proof", [], CLOSE], "step": ["proof", [], CLOSE]}}},
    ),
    Case(
        "a statement of another kind beside one of the right kind",
        SQUARES + "\n" + MAP + "\n" + lines("sharp rule/squares rule/map", *SHARP[1:]),
        sharp(
            {"rule/squares": INSIDE, "rule/map": ["proof", [], CLOSE]},
            found(),
            HALF | point({"x": "1"}, name="rule/map"),
        ),
        Kind.SHARP,
        EARLIER
        | {
            "rule/map": {"certified": {"start": ["proof", [], CLOSE], "step": ["proof", [], CLOSE]}}
        },
    ),
    from_1("a real parameter that is taken for an integer outside", Kind.INTEGRAL),
    case(
        "a statement that does not exist, with a proof",
        sharp({"rule/none": INSIDE}, found(), point({}, name="rule/none")),
        Kind.SHARP,
        over("sharp rule/none", *SHARP[1:]),
    ),
    case(
        "a condition too wide",
        VALID,
        Kind.SUM,
        over(*SHARP[:3], "holds a <= 2"),
    ),
    case(
        "a condition too narrow",
        VALID,
        Kind.SUM,
        over(*SHARP[:3], "holds a < 1/2"),
    ),
    case(
        "a strict condition",
        VALID,
        Kind.STRICT,
        over(*SHARP[:3], "holds a < 1"),
    ),
    case(
        "a point outside of an empty domain",
        sharp({"rule/squares": ["proof", [], CONTRADICTION]}, ["empty", CONTRADICTION]),
        Kind.NOTHING_FALSE,
        over("sharp rule/squares", "over a", "domain a > 0 and a < 0", "holds a = 5"),
    ),
    case(
        "givens that contradict one another",
        sharp({"rule/squares": ["proof", [], CONTRADICTION]}, EMPTY),
        Kind.NOTHING_FALSE,
        lines("forall a x", "given a > 0", "given a < 0", "show x > a", name="rule/squares")
        + "\n"
        + lines("sharp rule/squares", "over a", "domain 0 = 0", "holds 0 = 0"),
    ),
    case(
        "a range over what exists",
        sharp({"rule/squares": ["witness", [], found()]}, EMPTY, point({})),
        Kind.SHARP_OVER,
        lines("exists a", "show a > 0", name="rule/squares")
        + "\n"
        + lines("sharp rule/squares", "over a", "domain 0 = 0", "holds 0 = 0"),
    ),
    case(
        "a definition over what only the statement ranged over declares",
        VALID,
        (Kind.OVER, "low: x"),
        "define low over x := x - 1\n\n"
        + over(SHARP[0], SHARP[1], "domain a > 0 and low > 0", SHARP[3]),
    ),
    case(
        "a range over a root",
        sharp({"rule/squares": ["proof", [CLOSE], CLOSE]}, EMPTY, point({})),
        Kind.SHARP_OVER,
        lines("forall x", "root a = sqrt(x^2)", "show a >= 0", name="rule/squares")
        + "\n"
        + lines("sharp rule/squares", "over a", "domain 0 = 0", "holds 0 = 0"),
    ),
    case(
        "a division that only the condition licenses",
        sharp({"rule/squares": ["proof", [], CLOSE]}, ["empty", CLOSE], point({"a": "1"})),
        Kind.DIVISION,
        lines("forall a", "show a/a = 1", name="rule/squares")
        + "\n"
        + lines("sharp rule/squares", "over a", "domain a >= 0", "holds a > 0"),
    ),
    case(
        "a point outside of the domain",
        sharp({"rule/squares": INSIDE}, found(), point({"a": "10", "x": "1"})),
        Kind.NOTHING_FALSE,
    ),
    case(
        "a point that does not meet a given",
        sharp({"rule/squares": INSIDE}, found(), point({"a": "1/2", "x": "1/2"})),
        Kind.NOTHING_FALSE,
    ),
    case(
        "a point without a value",
        sharp({"rule/squares": INSIDE}, found(), point({"a": "1/2"})),
        Kind.VALUES,
    ),
    case(
        "a point with a value too many",
        sharp({"rule/squares": INSIDE}, found(), point({"a": "1/2", "x": "1", "b": "1"})),
        Kind.NO_VARIABLE,
    ),
    case(
        "a point of another statement",
        sharp({"rule/squares": INSIDE}, found(), {"rule/squares": HALF["rule/squares"][:1] * 4}),
        Kind.MALFORMED,
    ),
    case("no point", sharp({"rule/squares": INSIDE}, found(), {}), Kind.SHARP),
    case(
        "a point too many",
        sharp({"rule/squares": INSIDE}, found(), HALF | point({"a": "1/2"}, name="rule/other")),
        Kind.SHARP,
    ),
    case(
        "points left out",
        {"certified": [{"rule/squares": INSIDE}, found()]},
        (Kind.MALFORMED, "ValueError"),
    ),
    case(
        "nothing outside",
        sharp({"rule/squares": INSIDE}, ["empty", OPEN]),
        Kind.STRICT,
    ),
    case(
        "a goal that does not fail outside",
        sharp({"rule/squares": INSIDE}, found(OPEN)),
        Kind.STRICT,
    ),
    case(
        "premises that fail outside",
        sharp({"rule/squares": INSIDE}, found(premises=CLOSE)),
        Kind.NOTHING_FALSE,
    ),
    case(
        "a value for the parameter",
        sharp({"rule/squares": INSIDE}, found(values={"x": "1", "a": "2"})),
        Kind.VALUES,
    ),
    case("nothing inside", sharp({}, found()), Kind.SHARP),
    case(
        "a proof too many",
        sharp({"rule/squares": INSIDE, "rule/other": INSIDE}, found()),
        Kind.SHARP,
    ),
    case(
        "a statement that is not earlier",
        VALID,
        Kind.SHARP,
        over("sharp rule/case", *SHARP[1:]),
    ),
    case(
        "a statement that does not exist",
        VALID,
        Kind.SHARP,
        over("sharp rule/none", *SHARP[1:]),
    ),
    case(
        "no statement",
        sharp({}, found(), {}),
        Kind.SHARP,
        over("sharp", *SHARP[1:]),
    ),
    case(
        "the range line used inside",
        sharp({"rule/squares": ["proof", [], ["psatz", [[1, [[0, 1]], "1"]], []]]}, found()),
        Kind.SUM,
    ),
    case(
        "a parameter that the statement has not",
        VALID,
        (Kind.SHARP_OVER, "rule/squares"),
        over("sharp rule/squares", "over b", "domain b > 0", "holds b <= 1"),
    ),
    case(
        "a domain over another name",
        VALID,
        (Kind.UNDECLARED, "x"),
        over(*SHARP[:2], "domain a > 0 and x > 0", "holds a <= 1"),
    ),
    case(
        "a condition over another name",
        sharp({"rule/squares": LOOSE}, found()),
        (Kind.UNDECLARED, "x"),
        over(*SHARP[:3], "holds a <= x"),
    ),
    case(
        "a parameter twice",
        VALID,
        Kind.NAME,
        over("sharp rule/squares", "over a a", *SHARP[2:]),
    ),
    case(
        "two statements for a name",
        VALID,
        Kind.SHARP,
        over("sharp rule/squares rule/more", *SHARP[1:]),
    ),
    case(
        "a number with two roots",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root(a^2 - 1, -2, 2)", SHARP[3]),
    ),
    case(
        "a number with no root",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root(a^2 + 1, -2, 2)", SHARP[3]),
    ),
    case(
        "a number with a root of even order",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root((a - 1)^2, 0, 2)", SHARP[3]),
    ),
    case(
        "a number between a parameter and 2",
        VALID,
        Kind.NO_NUMBER,
        over(*SHARP[:3], "number c = root(a - 1, a, 2)", SHARP[3]),
    ),
    case(
        "a number with an empty interval",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root(a - 1, 2, 0)", SHARP[3]),
    ),
    case(
        "a number with a root at its lower end",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root((a - 1)*(2*a - 3), 1, 2)", SHARP[3]),
    ),
    case(
        "a number with a root at its upper end",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root((a - 2)*(2*a - 3), 1, 2)", SHARP[3]),
    ),
    case(
        "a number at its only end",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root(a - 1, 1, 1)", SHARP[3]),
    ),
    case(
        "a number with the name of a parameter",
        VALID,
        (Kind.NAME, "a"),
        over(*SHARP[:3], "number a = root(a^2 - 2, 0, 2)", SHARP[3]),
    ),
    case(
        "two numbers of one name",
        VALID,
        (Kind.NAME, "c"),
        over(*SHARP[:3], *["number c = root(a^2 - 2, 0, 2)"] * 2, SHARP[3]),
    ),
    case(
        "a formula for the name of a number",
        VALID,
        (Kind.NAME, "x<1"),
        over(*SHARP[:3], "number x<1 = root(a^2 - 2, 0, 2)", SHARP[3]),
    ),
    case(
        "a number with three roots",
        VALID,
        Kind.ONE_ROOT,
        over(*SHARP[:3], "number c = root(a^3 - a, -2, 2)", SHARP[3]),
    ),
    case(
        "a number with the name of a definition",
        VALID,
        (Kind.SHADOWS, "c", "statements, line 12"),
        "define c := 1\n" + over(*SQRT),
    ),
    case(
        "a number in two variables",
        VALID,
        (Kind.UNDECLARED, "x"),
        over(*SHARP[:3], "number c = root(a - x, 0, 2)", SHARP[3]),
    ),
    case(
        "a refutation",
        {"refuted": found()},
        (Kind.KEYS, "['refuted']"),
    ),
    case(
        "a point",
        {"certified": VALID["certified"], "point": []},
        Kind.KEYS,
    ),
    case(
        "no domain",
        VALID,
        Kind.ORDER,
        over(*SHARP[:2], "holds a <= 1"),
    ),
    case(
        "a given line",
        VALID,
        Kind.ORDER,
        over(*SHARP, "given a > 0"),
    ),
]
