"""["use", name, {variable: term}, {variable: fresh}, node]: an instance of an earlier certified
statement.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines, proof, witness

INVERSE = lines("forall a b", "given a*b = 1", "show a != 0", name="rule/inverse")
BELOW = lines("forall a", "exists b", "show b < a", name="rule/below")
GAP = lines("forall n", "integer n", "show n <= 0 or n >= 1", name="rule/gap")
SHIFT = lines(
    "forall x K", "integer K", "iterates x -> x + 1", "after K -> x + K", name="rule/shift"
)
SOME = lines("forall a", "integer n", "exists n", "show n = 2", name="rule/some")
TWO_INTEGERS = lines("forall m n", "integer m n", "show 0 = 0", name="rule/two")
BESIDE = lines("forall n", "integer n", "exists b", "show b < n", name="rule/beside")
EARLIER = {
    "rule/beside": witness(
        ["rule/beside", [], {"b": "n - 1"}, CLOSE], at={"n": "0"}, name="rule/beside"
    ),
    "rule/two": proof(CLOSE, at={"m": "0", "n": "0"}, name="rule/two"),
    "rule/inverse": proof(
        ["psatz", [[1, [], "1"]], [[0, "1"], [1, "-b"]]],
        at={"a": "1", "b": "1"},
        name="rule/inverse",
    ),
    "rule/below": witness(
        ["rule/below", [], {"b": "a - 1"}, CLOSE], at={"a": "0"}, name="rule/below"
    ),
    "rule/shift": {"certified": {"start": ["proof", [], CLOSE], "step": ["proof", [], CLOSE]}},
    "rule/some": witness(["rule/some", [], {"n": "2"}, CLOSE], at={"a": "0"}, name="rule/some"),
    "rule/gap": proof(
        ["integral", 0, ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []]],
        at={"n": "0"},
        name="rule/gap",
    ),
}
TWO = lines("forall x y", "given x*y = 2", "show x != 0")  # facts 0: x*y - 2 = 0, 1: x = 0
MET = ["psatz", [[1, [[2, 2]], "1"]], [[0, "1/2 - x*y/4"]]]  # x*y/2 - 1 != 0 contradicts x*y = 2
ZERO = ["psatz", [[1, [[2, 2]], "1"]], [[1, "-x"]]]
AT = {"x": "1", "y": "2"}


def use(name: Json, arguments: Json, fresh: Json, node: Json) -> Json:
    return ["use", name, arguments, fresh, node]


def case(
    defect: str,
    earlier: str,
    name: str,
    statement: str,
    node: Json,
    expected: str = "certified",
    **point: str,
) -> Case:
    return Case(
        defect, earlier + "\n" + statement, proof(node, at=point), expected, {name: EARLIER[name]}
    )


def inverse(defect: str, node: Json, expected: str = "certified", statement: str = TWO) -> Case:
    return case(defect, INVERSE, "rule/inverse", statement, node, expected, **AT)


def gap(defect: str, node: Json, expected: str = "certified", integral: bool = True) -> Case:
    rows = (
        ["forall n", "integer n", "show n <= 0 or n >= 1"]
        if integral
        else ["forall n", "show n <= 0 or n >= 1"]
    )
    return case(defect, GAP, "rule/gap", lines(*rows), node, expected, n="0")


BETWEEN = [
    "cases",
    0,
    [
        ["psatz", [[1, [[0, 1]], "1"], [1, [[2, 1]], "1"]], []],
        ["psatz", [[1, [[1, 1]], "1"], [1, [[2, 1]], "1"]], []],
    ],
]
NOTHING_BELOW = lines("forall x", "show not (x >= 0 and x < 0)")

ACCEPTED = [
    inverse(
        "an instance with terms",
        use("rule/inverse", {"a": "x", "b": "y/2"}, {}, ["cases", 0, [MET, ZERO]]),
    ),
    gap("an integer for an integer", use("rule/gap", {"n": "n"}, {}, BETWEEN)),
    gap(
        "a numeral for an integer",
        use("rule/gap", {"n": "-3"}, {}, ["integral", 0, EARLIER["rule/gap"]["certified"][2][2]]),
    ),
    case(
        "a fresh name for what exists",
        BELOW,
        "rule/below",
        lines("forall x", "show 0 < 1"),
        use("rule/below", {"a": "x"}, {"b": "z"}, CLOSE),
        x="0",
    ),
    case(
        "a fresh integer",
        SOME,
        "rule/some",
        lines("show 0 < 1"),
        use(
            "rule/some",
            {"a": "0"},
            {"n": "z"},
            [
                "sign",
                "z - 1",
                ["psatz", [[1, [[1, 1]], "1"], [1, [], "1"]], [[0, "1"]]],
                ["psatz", [[1, [], "1"]], [[0, "1"], [1, "-1"]]],
                ["integral", 1, CLOSE],
            ],
        ),
    ),
]
REJECTED = [
    inverse(
        "a statement that is not earlier",
        use("rule/case", {"x": "x", "y": "y"}, {}, ZERO),
        Kind.LEMMA,
    ),
    inverse(
        "a statement that does not exist",
        use("rule/none", {}, {}, ZERO),
        Kind.LEMMA,
    ),
    inverse(
        "premises that are not met",
        use("rule/inverse", {"a": "x", "b": "y"}, {}, ZERO),
        (Kind.INDEX, "2"),
    ),
    inverse(
        "premises that are left open",
        use("rule/inverse", {"a": "x", "b": "y"}, {}, ["cases", 0, [OPEN, ZERO]]),
        Kind.STRICT,
    ),
    inverse(
        "a variable left out",
        use("rule/inverse", {"a": "x"}, {}, ZERO),
        Kind.VALUES,
    ),
    inverse(
        "a variable too many",
        use("rule/inverse", {"a": "x", "b": "y", "c": "x"}, {}, ZERO),
        Kind.NO_VARIABLE,
    ),
    inverse(
        "a universal variable given as fresh",
        use("rule/inverse", {"a": "x"}, {"b": "z"}, ZERO),
        Kind.FRESH,
    ),
    inverse(
        "a variable given twice",
        use("rule/inverse", {"a": "x", "b": "y"}, {"b": "z"}, ZERO),
        Kind.VALUES,
    ),
    inverse(
        "a term that divides by what may vanish",
        use("rule/inverse", {"a": "x", "b": "1/x"}, {}, ZERO),
        Kind.DIVISION,
    ),
    inverse(
        "a licence that only the line to be shown would give",
        use(
            "rule/inverse", {"a": "x", "b": "1/x"}, {}, ["psatz", [[1, [[1, 2]], "1"]], [[0, "-x"]]]
        ),
        Kind.DIVISION,
        lines("forall x y", "show x != 0"),
    ),
    gap(
        "a real for an integer",
        use("rule/gap", {"n": "n"}, {}, BETWEEN),
        Kind.VALUES,
        integral=False,
    ),
    gap(
        "a half for an integer",
        use("rule/gap", {"n": "1/2"}, {}, BETWEEN),
        Kind.VALUES,
    ),
    gap(
        "half an integer for an integer",
        use("rule/gap", {"n": "n*(n + 1)/2"}, {}, BETWEEN),
        Kind.VALUES,
    ),
    gap(
        "digits and a line break for an integer",
        use("rule/gap", {"n": "1\n"}, {}, BETWEEN),
        Kind.TEXT,
    ),
    *(
        case(
            f"a half for the integer {half}, with another",
            TWO_INTEGERS,
            "rule/two",
            lines("forall x", "show 0 < 1"),
            use("rule/two", {"m": "1", "n": "1", half: "1/2"}, {}, CLOSE),
            Kind.VALUES,
            x="0",
        )
        for half in "mn"
    ),
    case(
        "a fresh real taken for an integer, beside one",
        BESIDE,
        "rule/beside",
        lines("forall x", "show 0 < 1"),
        use("rule/beside", {"n": "0"}, {"b": "z"}, ["integral", 0, OPEN]),
        Kind.INTEGRAL,
        x="0",
    ),
    case(
        "a fresh real taken for an integer",
        BELOW,
        "rule/below",
        lines("forall x", "show 0 < 1"),
        use("rule/below", {"a": "0"}, {"b": "z"}, ["integral", 0, OPEN]),
        Kind.INTEGRAL,
        x="0",
    ),
    case(
        "a statement of another kind",
        SHIFT,
        "rule/shift",
        NOTHING_BELOW,
        use("rule/shift", {"x": "x", "K": "1"}, {}, CLOSE),
        (Kind.LEMMA, "rule/shift"),
        x="0",
    ),
    case(
        "a fresh name that occurs",
        BELOW,
        "rule/below",
        NOTHING_BELOW,
        use("rule/below", {"a": "x"}, {"b": "x"}, CLOSE),
        Kind.NAME,
        x="0",
    ),
    case(
        "a fresh name that is none",
        BELOW,
        "rule/below",
        NOTHING_BELOW,
        use("rule/below", {"a": "x"}, {"b": "1"}, CLOSE),
        Kind.NAME,
        x="0",
    ),
    case(
        "a fresh name in another script",
        BELOW,
        "rule/below",
        NOTHING_BELOW,
        use("rule/below", {"a": "x"}, {"b": "z\u00e9"}, CLOSE),
        (Kind.NAME, "z\u00e9"),
        x="0",
    ),
    case(
        "a term for what exists",
        BELOW,
        "rule/below",
        NOTHING_BELOW,
        use("rule/below", {"a": "x", "b": "x"}, {}, CLOSE),
        Kind.FRESH,
        x="0",
    ),
    case(
        "an argument that mentions the fresh name",
        BELOW,
        "rule/below",
        NOTHING_BELOW,
        use("rule/below", {"a": "z"}, {"b": "z"}, CLOSE),
        (Kind.UNDECLARED, "z"),
        x="0",
    ),
]
