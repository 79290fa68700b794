"""The point of a certified statement: values that meet its premises, so that it says something; and
the keys of a certificate.
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, OPEN, Case, Json, lines, refuted

NAME = "rule/case"
PREMISES = lines("forall x y", "given x > 0", "given y^2 = x", "show x = y^2")
EQUAL = ["psatz", [[1, [[2, 2]], "1"]], [[1, "x - y^2"]]]
BELOW = ["psatz", [[1, [[0, 1]], "1"], [1, [[1, 1]], "1"]], []]


def at(values: Json, adjoined: Json = (), node: Json = CLOSE, **more: Json) -> Json:
    return {
        "certified": ["proof", [], EQUAL],
        "point": [NAME, list(adjoined), values, node],
        **more,
    }


SQRT2 = ["s", "s^2 - 2", "1", "2", CLOSE, CLOSE]

ACCEPTED = [
    Case("numbers", PREMISES, at({"x": "1/4", "y": "-1/2"})),
    Case(
        "an adjoined number",
        PREMISES,
        at({"x": "2", "y": "s"}, [SQRT2], ["psatz", [[1, [[3, 2]], "1"]], [[2, "2 - s^2"]]]),
    ),
    Case(
        "premises only, where something exists",
        lines("forall x", "given x > 1", "exists y", "show y > x"),
        {
            "certified": ["witness", [], [NAME, [], {"y": "x + 1"}, CLOSE]],
            "point": [NAME, [], {"x": "2"}, CLOSE],
        },
    ),
    Case(
        "no variable",
        lines("show 1 < 2"),
        {"certified": ["proof", [], CLOSE], "point": [NAME, [], {}, CLOSE]},
    ),
    Case("nothing is said", PREMISES, {"unknown": "the search ended"}, "unknown"),
]

REJECTED = [
    Case("a premise that fails", PREMISES, at({"x": "0", "y": "0"}), Kind.NOTHING_FALSE),
    Case(
        "a premise that is not exact",
        PREMISES,
        at({"x": "2", "y": "14142136/10000000"}),
        Kind.NOTHING_FALSE,
    ),
    Case(
        "a variable left out",
        PREMISES,
        at({"x": "1"}),
        Kind.VALUES,
    ),
    Case(
        "a variable too many",
        PREMISES,
        at({"x": "1", "y": "1", "z": "1"}),
        Kind.NO_VARIABLE,
    ),
    Case("a number that is no text", PREMISES, at({"x": 1, "y": "1"}), (Kind.TEXT, "1")),
    Case("a decimal", PREMISES, at({"x": "1.0", "y": "1"}), (Kind.TEXT, "1.0")),
    Case("an infinity", PREMISES, at({"x": "inf", "y": "1"}), (Kind.UNDECLARED, "inf")),
    Case("a division by zero", PREMISES, at({"x": "1/0", "y": "1"}), Kind.ZERO_DIVISION),
    Case(
        "no point",
        PREMISES,
        {"certified": ["proof", [], EQUAL]},
        (Kind.KEYS, "['certified']"),
    ),
    Case(
        "a key left over",
        PREMISES,
        at({"x": "1", "y": "1"}, unknown="why"),
        Kind.KEYS,
    ),
    Case("no key", PREMISES, {}, (Kind.KEYS, "[]")),
    Case(
        "a point and no proof",
        PREMISES,
        {"point": [NAME, [], {"x": "1", "y": "1"}, CLOSE]},
        Kind.KEYS,
    ),
    Case(
        "another key",
        PREMISES,
        {"proved": True},
        (Kind.KEYS, "['proved']"),
    ),
    Case(
        "a list for a certificate",
        PREMISES,
        ["unknown"],
        (Kind.KEYS, "[]"),
    ),
    Case(
        "a text for a certificate",
        PREMISES,
        "unknown",
        (Kind.KEYS, "[]"),
    ),
    Case(
        "a number for a certificate",
        PREMISES,
        0,
        (Kind.KEYS, "[]"),
    ),
    Case(
        "premises that exclude one another",
        lines("forall x", "given x > 0", "given x < 0", "show 0 = 1"),
        {"certified": ["proof", [], BELOW], "point": [NAME, [], {"x": "0"}, CLOSE]},
        Kind.NOTHING_FALSE,
    ),
    Case(
        "premises that exclude one another, a point that is no case",
        lines("forall x", "given x > 0", "given x < 0", "show 0 = 1"),
        {"certified": ["proof", [], BELOW], "point": ["empty", OPEN]},
        Kind.STRICT,
    ),
    Case(
        "false premises without variables",
        lines("given 0 = 1", "show 0 = 2"),
        {"certified": ["proof", [], CLOSE], "point": [NAME, [], {}, CLOSE]},
        Kind.NOTHING_FALSE,
    ),
    Case(
        "false premises without variables, and no point",
        lines("given 0 = 1", "show 0 = 2"),
        {"certified": ["proof", [], CLOSE]},
        Kind.KEYS,
    ),
    Case(
        "a counterexample beside a proof",
        PREMISES,
        at({"x": "1", "y": "1"}) | refuted({"x": "1", "y": "2"}),
        (Kind.KEYS, "['certified', 'point', 'refuted']"),
    ),
]
