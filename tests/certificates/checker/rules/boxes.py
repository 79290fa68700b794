"""["boxes", i, [[j, k], ...], tree]: fact i fails on the whole box that the facts j and k bound
(Bernstein coefficients).
"""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import Case, Json, lines, proof

# facts 0: x >= 0, 1: 1 - x >= 0, 2: y + 1 >= 0, 3: 1 - 2*y >= 0; what is shown, negated, is fact 4
BOX = ("forall x y", "given x >= 0", "given x <= 1", "given y >= -1", "given 2*y <= 1")
FLAT = ("forall x y", "given x >= 0", "given x <= 0", "given y >= 0", "given y <= 1")
UNIT = ("forall x", "given x >= 0", "given x <= 1")  # facts 0: x >= 0, 1: 1 - x >= 0, then fact 2
LINEAR = lines(*UNIT, "show x <= 1")
PARABOLA = lines(*UNIT, "show x*(1 - x) <= 1/4")
STRICT_PARABOLA = lines(*UNIT, "show x*(1 - x) < 1/4")
PLANE = lines(*BOX, "show x + y < 2")
SADDLE = lines(*BOX, "show x*y <= 1/2")
HILLS = lines(*BOX, "show x^3 - 2*x*y^2 + x*y <= 6/5")
NOT_ON_FACE = lines(*BOX, "show x*(1 - x)*(y + 2) <= 4/5")
MIDDLE = lines("forall x", "given x >= 1", "given 3*x <= 4", "show x^2*(4 - 3*x) <= 1")
POINT = lines(
    "forall x y",
    "given x >= 1/2",
    "given x <= 1/2",
    "given y >= 0",
    "given y <= 1",
    "show x*y*(1 - y) <= 1/8",
)


def tree(text: Json, fact: Json = 2, bounds: Json = ((0, 1),), at: Json = None) -> Json:
    return proof(["boxes", fact, [list(pair) for pair in bounds], text], at=at or {"x": "0"})


def plane(text: Json, fact: Json = 4, bounds: Json = ((0, 1), (2, 3))) -> Json:
    return tree(text, fact, bounds, {"x": "0", "y": "0"})


ACCEPTED = [
    Case("a leaf", LINEAR, tree(".")),
    Case("a coefficient 0 against a strict fact", PARABOLA, tree("a..")),
    Case("faces of halves", PARABOLA, tree("aA.A.")),
    Case("halves of halves", STRICT_PARABOLA.replace("< 1/4", "< 13/50"), tree("aa..a..")),
    Case("a leaf of two axes", PLANE, plane(".")),
    Case("faces until one number is left", PLANE, plane("AA.")),
    Case("the second axis first", PLANE, plane("BA.")),
    Case("a saddle at a corner", SADDLE, plane(".")),
    Case("an axis that was halved becomes the first", HILLS, plane("bA.b.AaA.a.A.")),
    Case("an end that is no integer", MIDDLE, tree("A.", at={"x": "1"})),
    Case(
        "strict bounds",
        lines("forall x", "given 0 < x", "given x < 1", "show x*(1 - x) <= 1/4"),
        tree("a..", at={"x": "1/2"}),
    ),
    Case("a degenerate box", POINT, tree("b..", 4, ((0, 1), (2, 3)), {"x": "1/2", "y": "0"})),
    Case(
        "a degenerate axis as a face",
        POINT,
        tree("Aa..", 4, ((0, 1), (2, 3)), {"x": "1/2", "y": "0"}),
    ),
    Case("a box where the polynomial vanishes", lines(*FLAT, "show x*y^2 <= 0"), plane("b..")),
    Case(
        "a box where the polynomial loses a variable", lines(*FLAT, "show x*y^2 <= 1"), plane("BA.")
    ),
    Case(
        "an empty box", lines("forall x", "show not (x >= 2 and x <= 1 and x^2 > 10)"), tree(".", 2)
    ),
    Case(
        "bounds that exclude one another",
        lines(*UNIT, "show x^2 <= 9"),
        tree(".", bounds=((0, 1),)),
    ),
    Case(
        "a variable that the polynomial does not have",
        lines(*BOX, "show y^2 <= 1"),
        plane("a..", 4, ((2, 3),)),
    ),
    Case("a square that is 0 at a quarter", lines(*UNIT, "show (4*x - 1)^2 >= 0"), tree("aa...")),
    Case("a coefficient like the one before", lines(*UNIT, "show x^2 <= 1"), tree("A.")),
    Case(
        "the face at the lower end alone is monotone",
        lines(
            "forall x y",
            *UNIT[1:],
            "given y >= 0",
            "given y <= 1",
            "show y - x*(2 + 8*y*(1 - y)) <= 1",
        ),
        plane("AA."),
    ),
    Case("a face at the lower end", lines(*UNIT, "show 1 - x <= 1"), tree("A.")),
    Case(
        "an interval that is one point",
        lines("forall x", "given x >= 1", "given x <= 1", "show x^2 < 2"),
        tree(".", at={"x": "1"}),
    ),
    Case(
        "a cubic that nearly touches",
        lines(*UNIT, "show 27*x*(1 - x)^2 - 4 <= 1/1000"),
        tree("aa.aa.aa....."),
    ),
    Case("a fact that is weak", lines(*UNIT, "show x^2 - x < 1/100"), tree(".")),
]

REJECTED = [
    Case(
        "the face at the other end",
        lines(*UNIT, "show 1 - 2*x <= 0"),
        tree("A."),
        (Kind.BOX_SIGN, "1"),
    ),
    Case(
        "a fall, then a small rise",
        lines(*UNIT, "show 1 - 3*x + 2*x^2 <= 0"),
        tree("A."),
        (Kind.MONOTONE, "A"),
    ),
    Case(
        "a face at the lower end that is not monotone",
        lines(*BOX, "show y^2 - x <= 2"),
        plane("AA."),
        (Kind.MONOTONE, "A"),
    ),
    Case(
        "a half with a coefficient that is positive and small",
        lines(*UNIT, "show 1 - 2*x <= 0"),
        tree("a.."),
        (Kind.BOX_SIGN, "2"),
    ),
    Case(
        "a coefficient that is positive",
        PARABOLA,
        tree("."),
        Kind.BOX_SIGN,
    ),
    Case(
        "a coefficient 0 against a weak fact",
        STRICT_PARABOLA,
        tree("a.."),
        (Kind.BOX_SIGN, "0"),
    ),
    Case(
        "a weak fact that touches at a corner",
        lines(*UNIT, "show x < 1"),
        tree("."),
        (Kind.BOX_SIGN, "0"),
    ),
    Case(
        "a weak fact that touches on a face",
        lines(*UNIT, "show x < 1"),
        tree("A."),
        (Kind.BOX_SIGN, "0"),
    ),
    Case(
        "a statement that is false on one half",
        lines(*UNIT, "show x <= 1/2"),
        tree("a.."),
        Kind.BOX_SIGN,
    ),
    Case("the wrong axis", HILLS, plane("aA.A."), (Kind.MONOTONE, "A")),
    Case(
        "a face of an axis that is not monotone",
        PARABOLA,
        tree("A."),
        (Kind.MONOTONE, "A"),
    ),
    Case(
        "a face that hides what is inside",
        NOT_ON_FACE,
        plane("AA."),
        (Kind.MONOTONE, "A"),
    ),
    Case(
        "a leaf after the face of another axis",
        NOT_ON_FACE,
        plane("B."),
        Kind.BOX_SIGN,
    ),
    Case("a tree too short", PARABOLA, tree("a."), (Kind.BOX_SHORT, "a.")),
    Case("a tree that ends in a halving", PARABOLA, tree("aa"), (Kind.BOX_SHORT, "aa")),
    Case("an empty tree", LINEAR, tree(""), Kind.BOX_SHORT),
    Case("a tree too long", PARABOLA, tree("a..."), (Kind.BOX_LONG, "a...")),
    Case("a letter after the last box", LINEAR, tree(".a"), (Kind.BOX_LONG, ".a")),
    Case("an axis that is not there", LINEAR, tree("b.."), (Kind.INDEX, "1")),
    Case("a face of an axis that is not there", LINEAR, tree("B."), (Kind.INDEX, "1")),
    Case("an axis that a face took away", PLANE, plane("AAA."), (Kind.INDEX, "0")),
    Case("a halving after the last face", PLANE, plane("BAa.."), (Kind.INDEX, "0")),
    Case("an unknown character", LINEAR, tree("?"), (Kind.INDEX, "-2")),
    Case("a digit", LINEAR, tree("0."), (Kind.INDEX, "-17")),
    Case("a digit of another script", LINEAR, tree("\u0661."), (Kind.INDEX, "1536")),
    Case("a letter that looks like A", LINEAR, tree("\u0410."), (Kind.INDEX, "943")),
    Case(
        "a letter whose small form is a",
        lines(*UNIT, "show x <= 1"),
        tree("\u212b."),
        (Kind.INDEX, "8394"),
    ),
    Case("a blank", LINEAR, tree(" ."), (Kind.INDEX, "-33")),
    Case("a list for a tree", PARABOLA, tree(["a", ".", "."]), Kind.BOX_FACT),
    Case("nothing for a tree", PARABOLA, tree(None), Kind.BOX_FACT),
    Case("bounds swapped", PARABOLA, tree("a..", bounds=((1, 0),)), Kind.BOUND),
    Case(
        "one bound used twice",
        PARABOLA,
        tree("a..", bounds=((0, 0),)),
        Kind.BOUND,
    ),
    Case(
        "the fact itself as a bound",
        PARABOLA,
        tree("a..", bounds=((0, 2),)),
        Kind.BOUND,
    ),
    Case(
        "bounds of the variables in the wrong order",
        HILLS,
        plane("bbA.A.bA.A.", 4, ((2, 3), (0, 1))),
        (Kind.ONE_VARIABLE, "x"),
    ),
    Case(
        "a variable without bounds",
        PLANE,
        plane(".", 4, ((0, 1),)),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case(
        "bounds left over",
        LINEAR,
        tree(".", bounds=((0, 1), (0, 1))),
        (Kind.MALFORMED, "ValueError"),
    ),
    Case("no bounds", LINEAR, tree(".", bounds=()), (Kind.MALFORMED, "ValueError")),
    Case("one bound alone", LINEAR, tree(".", bounds=((0,),)), (Kind.MALFORMED, "ValueError")),
    Case("three bounds", LINEAR, tree(".", bounds=((0, 1, 1),)), (Kind.MALFORMED, "ValueError")),
    Case(
        "numbers for bounds",
        LINEAR,
        proof(["boxes", 2, [0, 1], "."], at={"x": "0"}),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case(
        "a bound that is not there",
        LINEAR,
        tree(".", bounds=((0, 3),)),
        (Kind.INDEX, "3"),
    ),
    Case(
        "a negative number of a bound",
        LINEAR,
        tree(".", bounds=((-3, 1),)),
        (Kind.INDEX, "-3"),
    ),
    Case(
        "a truth value for a bound",
        LINEAR,
        tree(".", bounds=((False, 1),)),
        (Kind.INDEX, "False"),
    ),
    Case("text for a bound", LINEAR, tree(".", bounds=(("0", 1),)), (Kind.INDEX, "0")),
    Case("a fact that is not there", LINEAR, tree(".", 3), (Kind.INDEX, "3")),
    Case("a truth value for the fact", LINEAR, tree(".", True), (Kind.INDEX, "True")),
    Case(
        "a bound of degree two",
        lines("forall x", "given x^2 + x >= 0", "given x <= 1", "show x <= 1"),
        tree("."),
        Kind.BOUND,
    ),
    Case(
        "a bound in two variables",
        lines("forall x y", "given x + y >= 0", "given x <= 1", "show x <= 1"),
        tree(".", at={"x": "0", "y": "0"}),
        (Kind.ONE_VARIABLE, "x"),
    ),
    Case(
        "a bound on another variable",
        lines("forall x y", "given x >= 0", "given y <= 1", "show x <= 1"),
        tree(".", at={"x": "0", "y": "0"}),
        (Kind.ONE_VARIABLE, "x"),
    ),
    Case(
        "an equation for a bound",
        lines("forall x", "given x = 0", "given x <= 1", "show x <= 1"),
        tree("."),
        Kind.BOUND,
    ),
    Case(
        "what is not zero for a bound",
        lines("forall x", "given x != 0", "given x <= 1", "show x <= 1"),
        tree(".", at={"x": "1"}),
        Kind.BOUND,
    ),
    Case(
        "an equation for the fact",
        lines(*UNIT, "show x != 2"),
        tree("."),
        (Kind.BOX_FACT, "="),
    ),
    Case(
        "what is not zero for the fact",
        lines(*UNIT, "show x = x^2"),
        tree("."),
        (Kind.BOX_FACT, "!="),
    ),
    Case(
        "a missing tree",
        LINEAR,
        proof(["boxes", 2, [[0, 1]]], at={"x": "0"}),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case(
        "an entry too many",
        LINEAR,
        proof(["boxes", 2, [[0, 1]], ".", []], at={"x": "0"}),
        (Kind.MALFORMED, "TypeError"),
    ),
    Case(
        "a root that touches",
        lines(*UNIT, "show (2*x - 1)^2 > 0"),
        tree("a.."),
        (Kind.BOX_SIGN, "0"),
    ),
    Case(
        "one point, where the fact holds",
        lines("forall x", "given x >= 1", "given x <= 1", "show x^2 < 1"),
        tree("a..", at={"x": "1"}),
        Kind.BOX_SIGN,
    ),
]
