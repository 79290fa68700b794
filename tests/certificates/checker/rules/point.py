"""The point of a certified statement: values that meet its premises, so that it says something; and
the keys of a certificate.
"""

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
    Case("a premise that fails", PREMISES, at({"x": "0", "y": "0"}), "nothing false is assumed"),
    Case(
        "a premise that is not exact",
        PREMISES,
        at({"x": "2", "y": "14142136/10000000"}),
        "nothing false is assumed",
    ),
    Case(
        "a variable left out",
        PREMISES,
        at({"x": "1"}),
        "every variable needs one value, an integer one an integer",
    ),
    Case(
        "a variable too many",
        PREMISES,
        at({"x": "1", "y": "1", "z": "1"}),
        "an integer, or a value, for what is not a variable",
    ),
    Case("a number that is no text", PREMISES, at({"x": 1, "y": "1"}), "unreadable text: 1"),
    Case("a decimal", PREMISES, at({"x": "1.0", "y": "1"}), "unreadable text: 1.0"),
    Case("an infinity", PREMISES, at({"x": "inf", "y": "1"}), "an undeclared name: inf"),
    Case("a division by zero", PREMISES, at({"x": "1/0", "y": "1"}), "division by zero"),
    Case(
        "no point",
        PREMISES,
        {"certified": ["proof", [], EQUAL]},
        "a certificate with missing or left over keys: ['certified']",
    ),
    Case(
        "a key left over",
        PREMISES,
        at({"x": "1", "y": "1"}, unknown="why"),
        "a certificate with missing or left over keys",
    ),
    Case("no key", PREMISES, {}, "a certificate with missing or left over keys: []"),
    Case(
        "a point and no proof",
        PREMISES,
        {"point": [NAME, [], {"x": "1", "y": "1"}, CLOSE]},
        "a certificate with missing or left over keys",
    ),
    Case(
        "another key",
        PREMISES,
        {"proved": True},
        "a certificate with missing or left over keys: ['proved']",
    ),
    Case(
        "a list for a certificate",
        PREMISES,
        ["unknown"],
        "a certificate with missing or left over keys: []",
    ),
    Case(
        "a text for a certificate",
        PREMISES,
        "unknown",
        "a certificate with missing or left over keys: []",
    ),
    Case(
        "a number for a certificate",
        PREMISES,
        0,
        "a certificate with missing or left over keys: []",
    ),
    Case(
        "premises that exclude one another",
        lines("forall x", "given x > 0", "given x < 0", "show 0 = 1"),
        {"certified": ["proof", [], BELOW], "point": [NAME, [], {"x": "0"}, CLOSE]},
        "nothing false is assumed",
    ),
    Case(
        "premises that exclude one another, a point that is no case",
        lines("forall x", "given x > 0", "given x < 0", "show 0 = 1"),
        {"certified": ["proof", [], BELOW], "point": ["empty", OPEN]},
        "no term of the certificate is strictly positive",
    ),
    Case(
        "false premises without variables",
        lines("given 0 = 1", "show 0 = 2"),
        {"certified": ["proof", [], CLOSE], "point": [NAME, [], {}, CLOSE]},
        "nothing false is assumed",
    ),
    Case(
        "false premises without variables, and no point",
        lines("given 0 = 1", "show 0 = 2"),
        {"certified": ["proof", [], CLOSE]},
        "a certificate with missing or left over keys",
    ),
    Case(
        "a counterexample beside a proof",
        PREMISES,
        at({"x": "1", "y": "1"}) | refuted({"x": "1", "y": "2"}),
        "a certificate with missing or left over keys: ['certified', 'point', 'refuted']",
    ),
]
