"""Definitions: written out where they are used, and refused where they could mean two things."""

from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import CLOSE, Case, Expected, lines, proof

POINT = {"x": "0", "y": "0"}


def case(
    defect: str,
    defined: tuple[str, ...],
    *rows: str,
    expected: Expected = "certified",
    at: dict[str, str] | None = None,
) -> Case:
    """A statement below definitions."""
    above = "".join(f"define {one}\n" for one in defined)
    return Case(defect, above + lines(*rows), proof(CLOSE, at=at or POINT), expected)


SQUARE = "square(x) := x^2"
SWAP = "swap(x, y) := (y, x)"
LESS = "less(x, y) := x - y"
TWICE = "twice(v) over a := a*v + v"
XY = "forall x y"
ONE = {"x": "1", "y": "1"}

ACCEPTED = [
    case("a constant", ("half := 1/2",), XY, "show half + half = 1"),
    case("a function", (SQUARE,), XY, "show square(x + y) = x^2 + 2*x*y + y^2"),
    case("an argument is one thing", (SQUARE,), XY, "show 2*square(x - y) = 2*(x - y)^2"),
    case("a body is one thing", ("sum(x, y) := x + y",), XY, "show 2*sum(x, y) = 2*x + 2*y"),
    case("a power of a body", ("minus(x) := -x",), XY, "show minus(x)^2 = x^2"),
    case("a negative argument", (SQUARE,), XY, "show square(-x) = x^2"),
    case("a formula", ("same(x, y) := x - y = 0",), XY, "show same(x*y, y*x)"),
    case("a negated formula", ("apart(x, y) := x != y",), XY, "show not apart(x, x)"),
    case("a definition of definitions", (SQUARE, "fourth(x) := square(square(x))"), XY,
         "show fourth(x) = x^4"),
    case("a tuple for two arguments", (SWAP, LESS), XY, "show less(swap(x, y)) = y - x"),
    case("a tuple of a tuple", (SWAP, LESS), XY, "show less(swap(swap(x, y))) = x - y"),
    case("a tuple beside an argument", (SWAP, "three(x, y, z) := x - y + 2*z"), XY,
         "show three(swap(x, y), x) = y + x"),
    case("a pair that is declared", ("b over x y := (x, y)", LESS), XY, "show less(b) = x - y"),
    case("a parameter named like a variable, and not its value", (LESS,), XY,
         "show less(y, x) = y - x"),
    case("parameters that change places", ("turned(x, y) := (y, x)", LESS), XY,
         "show less(turned(y, x)) = x - y"),
    case("a variable of the statement", (TWICE,), "forall a x y", "show twice(x) = a*x + x",
         at={"a": "0", **POINT}),
    case("an abbreviation of the statement", (TWICE,), XY, "let a = x + 1",
         "show twice(y) = x*y + 2*y"),
    case("a name that two definitions are over", (TWICE, "more(v) over a := twice(v) + a"),
         "forall a x", "show more(x) = a*x + x + a", at={"a": "0", "x": "0"}),
    case("a division licensed where it is used", ("inverse(x) := 1/x",), XY, "given y > 0",
         "show y*inverse(y) = 1", at=ONE),
    case("a division licensed as its factors are", ("inverse(x) := 1/x",), XY,
         "given x > 0 and y > 0", "show x*y*inverse(x*y) = 1", at=ONE),
    case("an exponent", ("power(n) over x := x^n",), XY, "show power(3) = x^3"),
    case("definitions in every line", (SQUARE, "plus(x) := x + 1"), XY, "given square(x) = x*x",
         "let z = plus(x)", "show square(z) = plus(x*x + 2*x)"),
]  # fmt: skip


def wrong(
    defect: str, defined: tuple[str, ...], shown: str, kind: Kind, offender: str = ""
) -> Case:
    """What a definition is used for, or what it says, is refused, on the line or in the check."""
    return case(defect, defined, XY, f"show {shown}", expected=(kind, offender))


DOUBLE = tuple(f"d{k + 1}(x) := d{k}(d{k}(x))" for k in range(1, 40))
SUMS = tuple(f"d{k + 1}(x) := d{k}(x) + d{k}(x)" for k in range(1, 40))
NESTED = "d1(" * 40 + "x" + ")" * 40

REJECTED = [
    wrong("recursion", ("f(x) := f(x) + 1",), "f(x) = x", Kind.LOOSE, "f"),
    wrong("recursion of a constant", ("c := c + 1",), "c = 0", Kind.LOOSE, "c"),
    wrong("recursion of two", ("f(x) := g(x)", "g(x) := f(x)"), "f(x) = x", Kind.LOOSE, "g"),
    wrong("a name that is nowhere", ("f(x) := x + z",), "f(x) = x", Kind.LOOSE, "z"),
    wrong("a variable of the statement that is not said", ("f(y) := x + y",), "f(y) = y + x",
          Kind.LOOSE, "x"),
    wrong("a definition that comes later", ("f(x) := g(x)", "g(x) := x"), "f(x) = x", Kind.LOOSE,
          "g"),
    wrong("a definition twice", (SQUARE, SQUARE), "square(x) = x^2", Kind.REDEFINED, "square"),
    wrong("a definition twice, with other parameters", (SQUARE, "square := 1"), "square = 1",
          Kind.REDEFINED, "square"),
    wrong("a word defined", ("implies(x, y) := x + y",), "0 = 0", Kind.REDEFINED, "implies"),
    wrong("a root defined", ("sqrt(x) := x",), "0 = 0", Kind.REDEFINED, "sqrt"),
    wrong("a number defined", ("2 := 3",), "2 = 3", Kind.DEFINITION),
    wrong("no body", ("f(x) := ",), "0 = 0", Kind.DEFINITION),
    wrong("no sign", ("f(x) = x",), "0 = 0", Kind.DEFINITION),
    wrong("nothing", ("",), "0 = 0", Kind.DEFINITION),
    wrong("no parameter in parentheses", ("f() := 1",), "f() = 1", Kind.DEFINITION),
    wrong("a term for a parameter", ("f(x + 1) := 1",), "f(1) = 1", Kind.DEFINITION),
    wrong("a number for a parameter", ("f(2) := 2",), "f(2) = 2", Kind.NAME, "2"),
    wrong("an empty parameter", ("f(x,) := x",), "f(x) = x", Kind.NAME),
    wrong("a parameter twice", ("f(x, x) := x",), "f(x, x) = x", Kind.NAME),
    wrong("a parameter that it is over", ("f(x) over x := x",), "f(y) = y", Kind.NAME),
    wrong("a parameter that is a word", ("f(iff) := iff",), "f(x) = x", Kind.NAME, "iff"),
    wrong("a parameter with its own name", ("f(f) := f",), "f(x) = x", Kind.NAME, "f"),
    wrong("a parameter with the name of a definition", ("c := 1", "f(c) := c"), "f(x) = x",
          Kind.SHADOWS, "c"),
    wrong("over the name of a definition", ("c := 1", "f over c := c"), "f = 1", Kind.SHADOWS, "c"),
    wrong("the name of a parameter", ("f(c) := c", "c := 1"), "f(x) = x", Kind.REDEFINED, "c"),
    wrong("a parameter that is not used", ("f(x, y) := x",), "f(x, 1/0) = x", Kind.UNUSED, "y"),
    wrong("over what is not used", ("f(x) over y := x",), "f(x) = x", Kind.UNUSED, "y"),
    wrong("an argument missing", (LESS,), "less(x) = x", Kind.ARGUMENTS, "less"),
    wrong("an argument too many", (LESS,), "less(x, y, 1) = x", Kind.ARGUMENTS, "less"),
    wrong("no argument", (LESS,), "less = x", Kind.ARGUMENTS, "less"),
    wrong("arguments of a constant", ("c := 1",), "c(x) = 1", Kind.ARGUMENTS, "c"),
    wrong("a tuple that is too long", (SWAP, LESS), "less(swap(x, y), x) = 0", Kind.ARGUMENTS),
    wrong("a tuple for one", (SWAP, SQUARE), "square(swap(x, y)) = 0", Kind.ARGUMENTS, "square"),
    wrong("a keyword argument", (SQUARE,), "square(x=x) = x^2", Kind.TERM),
    wrong("a starred argument", (SQUARE,), "square(*x) = x^2", Kind.TEXT),
    wrong("a formula for a term", ("p(x) := x > 0",), "p(x) + 1 > 0", Kind.TERM, "x > 0"),
    wrong("a formula compared", ("p(x) := x = 0",), "p(x) = p(x)", Kind.TERM, "x == 0"),
    wrong("a term for a formula", (SQUARE,), "square(x)", Kind.FORMULA, "x ** 2"),
    wrong("a formula for an argument", ("no(x) := not x",), "no(x > 0)", Kind.TERM, "x > 0"),
    wrong("a negation for an argument", ("both(x) := x and x",), "both(not x > 0)", Kind.TERM,
          "not x > 0"),
    wrong("a conjunction for an argument", ("both(x) := x and x",), "both(x > 0 and y > 0)",
          Kind.TERM, "x > 0 and y > 0"),
    wrong("an implication for an argument", ("both(x) := x and x",), "both(implies(x > 0, y > 0))",
          Kind.TERM, "implies(x > 0, y > 0)"),
    wrong("a call of a call", (SQUARE,), "square(x)(y) = 0", Kind.TEXT, "square(x)(y)"),
    wrong("a power of nothing for an argument", (SQUARE,), "square(x, ^y) = x^2", Kind.TEXT),
    wrong("a letter of another script", ("f\u00e9(x) := x",), "0 = 0", Kind.DEFINITION),
    wrong("a formula of definitions for an argument", ("p(x) := x > 0", "no(x) := not x"),
          "no(p(x))", Kind.TERM, "x > 0"),
    wrong("a tuple for a term", (SWAP,), "swap(x, y) = swap(x, y)", Kind.TERM),
    wrong("a tuple for a formula", (SWAP,), "swap(x, y)", Kind.FORMULA),
    wrong("a tuple in a tuple", (SWAP, "deep(x, y) := (swap(x, y), x)", LESS),
          "less(deep(x, y)) = 0", Kind.TERM),
    wrong("a sum of tuples", (SWAP, "two(x, y) := swap(x, y) + swap(x, y)", SQUARE),
          "square(two(x, y)) = 0", Kind.TERM),
    wrong("a definition that is none", (SQUARE,), "cube(x) = x^3", Kind.TERM, "cube(x)"),
    wrong("a division that is not licensed", ("inverse(x) := 1/x",), "inverse(x) = inverse(x)",
          Kind.DIVISION, "x"),
    wrong("a division by zero", ("never(x) := 1/(x - x)",), "never(x) = never(x)",
          Kind.ZERO_DIVISION),
    case("a division licensed for another argument", ("inverse(x) := 1/x",), XY, "given x > 0",
         "show inverse(y) = inverse(y)", expected=(Kind.DIVISION, "y")),
    case("a division licensed by a later line", ("inverse(x) := 1/x",), XY, "let z = inverse(x)",
         "given x > 0", "show z = z", expected=(Kind.DIVISION, "x")),
    wrong("forty doublings", ("d1(x) := x + x", *DOUBLE), "d40(x) = x", Kind.WORK),
    wrong("forty sums", ("d1(x) := x + x", *SUMS), "d40(x) = x", Kind.WORK),
    wrong("forty arguments", ("d1(x) := x + x",), f"{NESTED} = x", Kind.WORK),
    wrong("doublings of a tuple", ("p1(x, y) := (x + y, x - y)",
          *(f"p{k + 1}(x, y) := p{k}(p{k}(x, y))" for k in range(1, 40))), "0 = 0", Kind.WORK),
    case("over what is not declared", (TWICE,), XY, "show twice(x) = x", expected=(Kind.OVER,
         "twice: a")),
    case("over what is declared below", (TWICE,), XY, "let z = twice(x)", "let a = 1",
         "show z = z", expected=(Kind.OVER, "twice: a")),
    case("over what exists, which a certificate chooses", (TWICE,), "forall x", "exists a",
         "show twice(x) = x", expected=(Kind.OVER, "twice: a")),
    # B(r) would become r + r, where the r that B is over is that of the statement
    case("capture by a parameter", ("plus(v) over r := v + r", "both(r) := plus(r)"), "forall r x",
         "show both(x) = 2*x", expected=(Kind.OVER, "plus: r")),
    case("a variable with the name of a definition", ("x := 1",), XY, "show x = 1",
         expected=(Kind.SHADOWS, "x")),
    case("an integer with the name of a definition", ("n := 1",), "forall n", "integer n",
         "show n = 1", expected=(Kind.SHADOWS, "n")),
    case("what exists with the name of a definition", ("z := 1",), "forall x", "exists z",
         "show z = x", expected=(Kind.SHADOWS, "z")),
    case("an abbreviation with the name of a definition", ("z := 1",), XY, "let z = 2",
         "show z = 2", expected=(Kind.SHADOWS, "z")),
    case("a root with the name of a definition", ("s := 1",), XY, "root s = sqrt(4)",
         "show s = 1", expected=(Kind.SHADOWS, "s")),
    Case("a definition below with the name of a variable",
         lines("forall c", "show c = c", name="rule/first") + "define c := 1\n"
         + lines("show c = 1"), proof(CLOSE), (Kind.REDEFINED, "c")),
    Case("a constant that is defined below", lines("show later = 1") + "define later := 1\n",
         proof(CLOSE), (Kind.UNDECLARED, "later")),
    Case("a function that is defined below",
         lines("forall x", "show later(x) = x") + "define later(y) := y\n",
         proof(CLOSE, at={"x": "0"}), (Kind.TERM, "later(x)")),
    Case("a definition inside a statement", "statement rule/case\nforall x\ndefine c := 1\n"
         "show x = x\n", proof(CLOSE), (Kind.LINE, "show x = x", "statements, line 4")),
]  # fmt: skip
