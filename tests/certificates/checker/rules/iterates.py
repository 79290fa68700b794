"""Iterates: P(0) is the identity and map(P(K)) = P(K + 1), for all K, as identities."""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, Case, Json, lines

DONE: Json = {"certified": {"start": ["proof", [], CLOSE], "step": ["proof", [], CLOSE]}}
MORE: Json = {"certified": {**DONE["certified"], "more": ["proof", [], CLOSE]}}
SHIFT = (
    "forall x w K",
    "integer K",
    "iterates (x, w) -> (x - w, w + 2)",
    "after K -> (x - K*w - K*(K - 1), w + 2*K)",
)


def case(defect: str, *rows: str, expected: str = "certified", certificate: Json = None) -> Case:
    return Case(defect, lines(*rows), DONE if certificate is None else certificate, expected)


ACCEPTED = [
    case("a triangular map", *SHIFT),
    case("one variable", "forall x K", "integer K", "iterates x -> x + 2", "after K -> x + 2*K"),
    case("a parameter", "forall x a K", "integer K", "iterates x -> x + a", "after K -> x + K*a"),
    case(
        "an abbreviation",
        "forall x a K",
        "integer K",
        "let b = a^2",
        "iterates x -> x + b",
        "after K -> x + K*b",
    ),
    case(
        "an involution of two",
        "forall x y K",
        "integer K",
        "iterates (x, y) -> (x, y + x)",
        "after K -> (x, y + K*x)",
    ),
]

START, STEP = (
    (Kind.NOTHING_FALSE, "", f"premise {name} of rule/case") for name in ("start", "step")
)
UNDECLARED = Kind.ITERATES_NAME
NAMES = Kind.ITERATES_SHAPE
WORD = (Kind.NAME, "", "premise start of rule/case")
ORDER = Kind.ORDER
REJECTED = [
    case("a wrong step", *SHIFT[:3], "after K -> (x - K*w - K*(K + 1), w + 2*K)", expected=STEP),
    case(
        "a wrong start", *SHIFT[:3], "after K -> (x - K*w - K*(K - 1), w + 2*K + 1)", expected=START
    ),
    case("the right start only", *SHIFT[:3], "after K -> (x - K*w, w + 2*K)", expected=STEP),
    case(
        "the right step only",
        "forall x K",
        "integer K",
        "iterates x -> x + 1",
        "after K -> x + K + 1",
        expected=START,
    ),
    case(
        "images swapped",
        "forall x w K",
        "integer K",
        "iterates (x, w) -> (w + 2, x - w)",
        SHIFT[3],
        expected=STEP,
    ),
    case(
        "a map that depends on the number of iterations",
        "forall x K",
        "integer K",
        "iterates x -> x + K",
        "after K -> x + K*(K - 1)/2",
        expected=Kind.ITERATES_COUNT,
    ),
    case(
        "a map that depends on it through an abbreviation",
        "forall x K",
        "integer K",
        "let s = K",
        "iterates x -> x + s",
        "after K -> x + K*(K - 1)/2",
        expected=Kind.ITERATES_COUNT,
    ),
    case(
        "no variable", "forall K", "integer K", "iterates () -> ()", "after K -> ()", expected=NAMES
    ),
    case(
        "an image left out",
        "forall x w K",
        "integer K",
        "iterates (x, w) -> (x,)",
        "after K -> (x, w)",
        expected=NAMES,
    ),
    case(
        "a power left out",
        "forall x w K",
        "integer K",
        "iterates (x, w) -> (x, w)",
        "after K -> (x,)",
        expected=NAMES,
    ),
    case(
        "a variable left out",
        "forall x w K",
        "integer K",
        "iterates (x,) -> (x, w)",
        "after K -> (x, w)",
        expected=NAMES,
    ),
    case(
        "variables in another order",
        "forall w x K",
        "integer K",
        "iterates (x, w) -> (x, w)",
        "after K -> (x, w)",
        expected=NAMES,
    ),
    case(
        "a count that is no integer",
        "forall x K n",
        "integer n",
        "iterates x -> x + 1",
        "after K -> x + K",
        expected=NAMES,
    ),
    case(
        "a count that is a state",
        "forall x K",
        "integer x",
        "iterates x -> x",
        "after x -> x",
        expected=NAMES,
    ),
    case(
        "a count that is a number",
        "forall x K",
        "integer 2",
        "iterates x -> x",
        "after 2 -> x",
        expected=NAMES,
    ),
    case(
        "a count that is a term",
        "forall x K",
        "integer -K",
        "iterates x -> x",
        "after -K -> x",
        expected=NAMES,
    ),
    case(
        "two counts",
        "forall x K n",
        "integer K n",
        "iterates x -> x",
        "after (K, n) -> x",
        expected=(Kind.MALFORMED, "ValueError"),
    ),
    case(
        "a variable twice",
        "forall x x K",
        "integer K",
        "iterates (x, x) -> (x, x)",
        "after K -> (x, x)",
        expected=(Kind.VARIABLE_TWICE, "", "premise start of rule/case"),
    ),
    case(
        "an abbreviation named like a variable",
        "forall x K",
        "integer K",
        "let x = 0",
        "iterates x -> x",
        "after K -> x",
        expected=Kind.ITERATES_COUNT,
    ),
    case(
        "a quotient",
        "forall x K",
        "integer K",
        "iterates x -> x/x",
        "after K -> x",
        expected=(Kind.DIVISION, "", "premise step of rule/case"),
    ),
    case(
        "a relation for an image",
        "forall x K",
        "integer K",
        "iterates x -> x > 0",
        "after K -> x",
        expected=(Kind.TERM, "", "premise step of rule/case"),
    ),
    case(
        "a name of the premises for an image",
        "forall x K",
        "integer K",
        "iterates x -> x_next",
        "after K -> x",
        expected=UNDECLARED,
    ),
    case(
        "a name of the premises for a power",
        "forall x K",
        "integer K",
        "iterates x -> x",
        "after K -> x_next",
        expected=UNDECLARED,
    ),
    # were `implies` a name, the map would depend on the number of iterations unseen: 2 steps of x
    # -> x + 2 are x + 4, not x + 1
    case(
        "a count that is a word",
        "forall x implies",
        "integer implies",
        "iterates x -> x + implies",
        "after implies -> x + implies*(implies - 1)/2",
        expected=WORD,
    ),
    case(
        "a state that is a word, in an abbreviation",
        "forall iff K",
        "integer K",
        "let c = iff",
        "iterates iff -> iff + c",
        "after K -> iff + K*iff",
        expected=WORD,
    ),
    case(
        "a starred image",
        "forall x K",
        "integer K",
        "iterates x -> (*x,)",
        "after K -> x",
        expected=(Kind.TEXT, "", "statements, line 5"),
    ),
    case(
        "an arrow too many",
        "forall x K",
        "integer K",
        "iterates x -> x -> x",
        "after K -> x",
        expected=(Kind.LINE_SHAPE, "", "statements, line 4"),
    ),
    case(
        "no arrow",
        "forall x K",
        "integer K",
        "iterates x",
        "after K -> x",
        expected=(Kind.LINE_SHAPE, "", "statements, line 4"),
    ),
    case(
        "a proof left over",
        *SHIFT,
        expected=Kind.PREMISES,
        certificate=MORE,
    ),
    case(
        "a point",
        *SHIFT,
        expected=Kind.KEYS,
        certificate={**DONE, "point": []},
    ),
    case(
        "a refutation",
        *SHIFT,
        expected=Kind.KEYS,
        certificate={"refuted": []},
    ),
    case("a given line", *SHIFT, "given x > 0", expected=ORDER),
    case("no count", "forall x K", "integer K", "iterates x -> x", expected=ORDER),
]
