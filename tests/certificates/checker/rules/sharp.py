"""Sharp ranges: for all parameters in the domain, the statements named hold <=> the condition
holds.
"""

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
HALF = {"a": "1/2"}
EARLIER = {name: {"unknown": "holds only in a range"} for name in ("rule/squares", "rule/counts")}


def sharp(inside: Json, outside: Json, sample: Json = None) -> Json:
    return {"certified": [inside, outside, HALF if sample is None else sample]}


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
    defect: str, expected: str = "certified", rows: tuple[str, ...] = COUNTS, sample: str = "1"
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
        sharp({"rule/squares": COUNTED}, found(BEYOND, met), {"n": sample}),
        expected,
        EARLIER,
    )


ACCEPTED = [
    case("inside and outside", VALID),
    counted("an integer parameter"),
    case("a number", VALID, text=over(*SQRT)),
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

REJECTED = [
    counted(
        "a parameter that is no integer",
        "not a strict fact with integer coefficients in integers",
        (COUNTS[0], *COUNTS[2:]),
    ),
    counted("a sample between integers", "the sample is not in the domain", sample="3/2"),
    case(
        "a parameter that is an integer in one statement only",
        sharp({"rule/squares": INSIDE, "rule/counts": COUNTED}, found()),
        "a parameter is an integer in one statement of a sharp range and not in another",
        SQUARES
        + "\n"
        + lines("forall a x", "integer a", "given x >= 1", "show x >= a", name="rule/counts")
        + "\n"
        + lines("sharp rule/squares rule/counts", *SHARP[1:]),
    ),
    Case(
        "a statement of another kind",
        MAP + "\n" + lines("sharp rule/map", "over x", "domain x > 0", "holds 0 = 0"),
        sharp({"rule/map": ["proof", [], CLOSE]}, EMPTY, {"x": "1"}),
        "a sharp range proves each of its earlier statements",
        {"rule/map": {"certified": {"start": ["proof", [], CLOSE], "step": ["proof", [], CLOSE]}}},
    ),
    case(
        "a statement that does not exist, with a proof",
        sharp({"rule/none": INSIDE}, found()),
        "a sharp range proves each of its earlier statements",
        over("sharp rule/none", *SHARP[1:]),
    ),
    case(
        "a condition too wide",
        VALID,
        "the certificate's sum is not zero",
        over(*SHARP[:3], "holds a <= 2"),
    ),
    case(
        "a condition too narrow",
        VALID,
        "the certificate's sum is not zero",
        over(*SHARP[:3], "holds a < 1/2"),
    ),
    case(
        "a strict condition",
        VALID,
        "no term of the certificate is strictly positive",
        over(*SHARP[:3], "holds a < 1"),
    ),
    case(
        "an empty domain",
        VALID,
        "the sample is not in the domain",
        over("sharp rule/squares", "over a", "domain a^2 < 0", "holds a = 5"),
    ),
    case(
        "a sample outside of the domain",
        sharp({"rule/squares": INSIDE}, found(), {"a": "10"}),
        "the sample is not in the domain",
    ),
    case(
        "a sample without value",
        sharp({"rule/squares": INSIDE}, found(), {}),
        "the sample is not in the domain",
    ),
    case(
        "a sample with a value too many",
        sharp({"rule/squares": INSIDE}, found(), {"a": "1/2", "x": "1"}),
        "the sample",
    ),
    case(
        "a float for a sample",
        sharp({"rule/squares": INSIDE}, found(), {"a": 0.5}),
        "expected an exact rational: 0.5",
    ),
    case(
        "no sample",
        {"certified": [{"rule/squares": INSIDE}, found()]},
        "malformed certificate (ValueError)",
    ),
    case(
        "nothing outside",
        sharp({"rule/squares": INSIDE}, ["empty", OPEN]),
        "no term of the certificate is strictly positive",
    ),
    case(
        "a goal that does not fail outside",
        sharp({"rule/squares": INSIDE}, found(OPEN)),
        "no term of the certificate is strictly positive",
    ),
    case(
        "premises that fail outside",
        sharp({"rule/squares": INSIDE}, found(premises=CLOSE)),
        "nothing false is assumed",
    ),
    case(
        "a value for the parameter",
        sharp({"rule/squares": INSIDE}, found(values={"x": "1", "a": "2"})),
        "every variable needs one value, an integer one an integer",
    ),
    case(
        "nothing inside", sharp({}, found()), "a sharp range proves each of its earlier statements"
    ),
    case(
        "a proof too many",
        sharp({"rule/squares": INSIDE, "rule/other": INSIDE}, found()),
        "a sharp range proves each of its earlier statements",
    ),
    case(
        "a statement that is not earlier",
        VALID,
        "a sharp range proves each of its earlier statements",
        over("sharp rule/case", *SHARP[1:]),
    ),
    case(
        "a statement that does not exist",
        VALID,
        "a sharp range proves each of its earlier statements",
        over("sharp rule/none", *SHARP[1:]),
    ),
    case(
        "no statement",
        sharp({}, found()),
        "a sharp range proves each of its earlier statements",
        over("sharp", *SHARP[1:]),
    ),
    case(
        "the range line used inside",
        sharp({"rule/squares": ["proof", [], ["psatz", [[1, [[0, 1]], "1"]], []]]}, found()),
        "the certificate's sum",
    ),
    case(
        "a parameter that the statement has not",
        sharp({"rule/squares": INSIDE}, found(), {"b": "1/2"}),
        "an undeclared name: b",
        over("sharp rule/squares", "over b", "domain b > 0", "holds b <= 1"),
    ),
    case(
        "a domain over another name",
        VALID,
        "an undeclared name: x",
        over(*SHARP[:2], "domain a > 0 and x > 0", "holds a <= 1"),
    ),
    case(
        "a condition over another name",
        sharp({"rule/squares": LOOSE}, found()),
        "an undeclared name: x",
        over(*SHARP[:3], "holds a <= x"),
    ),
    case(
        "a parameter twice",
        VALID,
        "a name is declared twice",
        over("sharp rule/squares", "over a a", *SHARP[2:]),
    ),
    case(
        "two statements for a name",
        VALID,
        "a sharp range",
        over("sharp rule/squares rule/more", *SHARP[1:]),
    ),
    case(
        "a number with two roots",
        VALID,
        "not one root",
        over(*SHARP[:3], "number c = root(a^2 - 1, -2, 2)", SHARP[3]),
    ),
    case(
        "a number with no root",
        VALID,
        "not one root",
        over(*SHARP[:3], "number c = root(a^2 + 1, -2, 2)", SHARP[3]),
    ),
    case(
        "a number with a root of even order",
        VALID,
        "not one root",
        over(*SHARP[:3], "number c = root((a - 1)^2, 0, 2)", SHARP[3]),
    ),
    case(
        "a number with an empty interval",
        VALID,
        "not one root",
        over(*SHARP[:3], "number c = root(a - 1, 2, 0)", SHARP[3]),
    ),
    case(
        "a number with a root at its end",
        VALID,
        "a polynomial vanishes at an end",
        over(*SHARP[:3], "number c = root(a - 1, 1, 2)", SHARP[3]),
    ),
    case(
        "a number in two variables",
        VALID,
        "an undeclared name: x",
        over(*SHARP[:3], "number c = root(a - x, 0, 2)", SHARP[3]),
    ),
    case(
        "a refutation",
        {"refuted": found()},
        "a certificate with missing or left over keys: ['refuted']",
    ),
    case(
        "a point",
        {"certified": VALID["certified"], "point": []},
        "a certificate with missing or left over keys",
    ),
    case(
        "no domain",
        VALID,
        "the lines of a statement are missing or out of order",
        over(*SHARP[:2], "holds a <= 1"),
    ),
    case(
        "a given line",
        VALID,
        "the lines of a statement are missing or out of order",
        over(*SHARP, "given a > 0"),
    ),
]
