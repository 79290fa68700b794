"""The five questions about energy, from the derived expressions: the supremum or infimum that is
sought, the set, and the closed form that is the true value; and a question in any number of
variables.

Everything is in the normal form (x height in units of r T, w closing speed in units of r, energies
in units of r^2), for all alpha of ALPHAS at once.  A set has two forms.  Solvers are asked about
the paper's form, polynomial inequalities in alpha, x and w.  Box methods take the set as the image
of a box under a rational map (`Question.how` says which; tests/benchmarks/test_bench.py proves it),
so that constraints need no search.  The supremum over a set is the maximum over its closure.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

import sympy

from juggleproof import symbolic
from juggleproof.benchmarks.bench.answers import BoundQuestion
from juggleproof.encoding import from_sympy
from juggleproof.statements.language import ClaimError, Formula, Term, equal
from juggleproof.symbolic.algebra import (
    alpha,
    lowest_terms,
    r,
    root_of,
    sign_for_lossy_impacts,
    w,
    x,
)
from juggleproof.symbolic.energy import scaled
from juggleproof.votes.questions import questions as solver_questions
from juggleproof.votes.questions import read_statement
from juggleproof.votes.smtlib import question_text

# 2 (1 + alpha) is the square of 3/2 and of 8/5, so that the corner of R is rational at both ends
ALPHAS = (Fraction(1, 8), Fraction(7, 25))
BOUND = "bound"
# the box: p and q from 0 to 1; s = sqrt(2 (1 + alpha)) in place of alpha where that root occurs
p, q, s = sympy.symbols("p q s")


@dataclass(frozen=True)
class Question:
    """A question: the fraction and the variables of its box, the statement about its set, the
    closed form, and how the set became a box.
    """

    name: str
    title: str
    how: str
    fraction: sympy.Expr
    variables: tuple[sympy.Symbol, ...]
    sign: int
    closed_form: sympy.Expr
    given: tuple[Formula, ...]
    sought: tuple[Term, Term]

    def truth(self) -> Fraction:
        """The closed form at the end of ALPHAS where it is greatest (least, if the infimum is
        sought).
        """
        return truth_at_ends(self.closed_form, self.sign)

    def problem(self) -> BoundQuestion:
        """The question as plain data."""
        over, under = (
            sympy.Poly(part, *self.variables)
            for part in lowest_terms(self.fraction * self.sign).as_numer_denom()
        )
        middle = {
            p: sympy.Rational(1, 2),
            q: sympy.Rational(1, 2),
            s: rational(_root(ALPHAS[0])),
            alpha: rational(ALPHAS[0]),
        }
        flip = -1 if under.as_expr().xreplace(middle) < 0 else 1
        statement = self._statement()
        return BoundQuestion(
            self.name,
            tuple(map(str, self.variables)),
            tuple(_ends(v) for v in self.variables),
            as_terms(over * flip),
            as_terms(under * flip),
            self.sign,
            statement,
            denial(statement),
        )

    def _statement(self) -> str:
        low, high = ALPHAS
        givens = (f"{low} <= alpha", f"alpha <= {high}", *map(str, self.given))
        over, under = self.sought
        return bounding(
            self.name,
            "alpha x w" if self.given else "alpha",
            givens,
            str(over),
            str(under),
            self.sign,
        )


def bounding(name: str, names: str, givens: Iterable[str], over: str, under: str, sign: int) -> str:
    """The statement that over/under, whose denominator is positive, is at most (at least, if sign
    is -1) {bound}, which is still to be put in.
    """
    shown = f"show {over} {'<=' if sign > 0 else '>='} {{bound}}*({under})"
    return "\n".join(
        [
            f"statement bench/{name}",
            f"forall {names}",
            *(f"given {one}" for one in givens),
            shown,
            "",
        ]
    )


def denial(statement: str) -> str:
    """The negation of a statement of `bounding` in SMT-LIB, also with {bound} still to be put
    in.
    """
    text = statement.format(bound=BOUND).replace("forall ", f"forall {BOUND} ")
    (asked,) = solver_questions(read_statement(text))
    return question_text(asked).replace(
        f"(declare-const {BOUND} Real)", f"(define-fun {BOUND} () Real {{bound}})"
    )


def truth_at_ends(closed_form: sympy.Expr, sign: int) -> Fraction:
    """The greatest value (least, if sign is -1) on ALPHAS of a function that is monotone there;
    raises DerivationError if it may not be.
    """
    rises = sign_for_lossy_impacts(closed_form.diff(alpha)) * sign > 0
    return fraction(closed_form.subs(alpha, rational(ALPHAS[1 if rises else 0])))


def fraction(value: sympy.Expr) -> Fraction:
    """A rational of SymPy as a Fraction; raises ClaimError for what is none."""
    value = sympy.nsimplify(value) if value.is_Rational else sympy.radsimp(value)
    if not value.is_Rational:
        raise ClaimError(f"{value} is not rational; choose ends of alpha where it is")
    return Fraction(int(value.p), int(value.q))


def rational(value: Fraction) -> sympy.Rational:
    """A Fraction as SymPy's rational."""
    return sympy.Rational(value.numerator, value.denominator)


def _root(value: Fraction) -> Fraction:
    return fraction(sympy.sqrt(rational(2 * (1 + value))))


def _ends(variable: sympy.Symbol) -> tuple[Fraction, Fraction]:
    if variable == alpha:
        return ALPHAS
    return (_root(ALPHAS[0]), _root(ALPHAS[1])) if variable == s else (Fraction(0), Fraction(1))


def as_terms(poly: sympy.Poly) -> dict[tuple[int, ...], Fraction]:
    """A polynomial of SymPy as plain data."""
    return {
        tuple(map(int, exponents)): Fraction(int(c.p), int(c.q)) for exponents, c in poly.terms()
    }


def put(expression: sympy.Expr, height: sympy.Expr, speed: sympy.Expr) -> sympy.Expr:
    """The expression at a state (x, w)."""
    return lowest_terms(expression.subs({x: height, w: speed}, simultaneous=True))


@cache
def kept_curve() -> tuple[sympy.Expr, sympy.Expr]:
    """(x, w): the curve B1^0, where the energy change is 0, from the origin (p = 0) to its other
    zero on x = 0 (p = 1).
    """
    height = root_of(symbolic.normal_energy_change(), x)
    speed = p * root_of(lowest_terms(height / w), w)
    return lowest_terms(height.subs(w, speed)), speed


@cache
def outside_region() -> tuple[sympy.Expr, sympy.Expr]:
    """(x, w): B1 beyond the edge of R. U = sqrt(2 E) is its value on that edge divided by p; w = U
    - 1 + 2 q, from x = w (q = 0) to x = 0 (q = 1).
    """
    U = sympy.Symbol("U")
    # where x = 0, U is the speed
    edge = (
        (-symbolic.region_corner()[1] / r)
        .subs(sympy.sqrt(2 * alpha + 2), s)
        .subs(alpha, s**2 / 2 - 1)
    )
    speed = U - 1 + 2 * q
    height = root_of(symbolic.normal_energy() - U**2 / 2, x).subs(w, speed)
    return tuple(lowest_terms(one.subs(U, edge / p)) for one in (height, speed))


def _in_units(energy: sympy.Expr) -> sympy.Expr:
    return scaled(energy, r**2) if energy.is_rational_function(alpha) else (energy / r**2).expand()


def cleared(expression: sympy.Expr) -> tuple[Term, Term]:
    """Numerator and denominator, the latter positive for 0 < alpha < 1."""
    over, under = lowest_terms(expression).as_numer_denom()
    sign = sign_for_lossy_impacts(under)
    return from_sympy((over * sign).expand()), from_sympy((under * sign).expand())


@cache
def questions() -> dict[str, Question]:
    """The questions by name."""
    energy, change = symbolic.normal_energy(), symbolic.normal_energy_change()
    region = cleared(scaled(symbolic.region_energy(), r**2))
    struck = (from_sympy(x) >= 0, from_sympy(symbolic.normal_margin()) > 0)
    gains, keeps = from_sympy(change) > 0, equal(from_sympy(change), 0)
    beyond = from_sympy(energy) * region[1] > region[0]
    curve, far = kept_curve(), p / (1 - p)
    gap = scaled(symbolic.energy_of_p() - symbolic.E_max() - symbolic.delta_E_max(), r**2)
    every = [
        Question(
            "E-B1plus",
            "sup of E on B1+",
            "x is a part q of its height on B1^0, and w runs along that curve as p goes from 0"
            " to 1",
            put(energy, q * curve[0], curve[1]),
            (alpha, p, q),
            1,
            _in_units(symbolic.E_max()),
            (*struck, gains),
            cleared(energy),
        ),
        Question(
            "E-B1zero",
            "sup of E on B1^0",
            "the curve is solved for x, and w runs along it as p goes from 0 to 1",
            put(energy, *curve),
            (alpha, p),
            1,
            _in_units(symbolic.E_max()),
            (*struck, keeps),
            cleared(energy),
        ),
        Question(
            "DE-H",
            "sup of Delta E on H",
            "x = q w and w = p/(1 - p), infinite at p = 1; on B2 the change is 0, which is less",
            put(change, q * far, far),
            (alpha, p, q),
            1,
            _in_units(symbolic.delta_E_max()),
            struck,
            cleared(change),
        ),
        Question(
            "DE-outside-R",
            "sup of Delta E on B1 - R",
            "by U = sqrt(2 E), its value on the edge of R over p, and w = U - 1 + 2 q",
            put(change.subs(alpha, s**2 / 2 - 1), *outside_region()),
            (s, p, q),
            1,
            _in_units(symbolic.delta_E_sup()),
            (*struck, beyond),
            cleared(change),
        ),
        Question(
            "p-outside-R",
            "min of E(p) - E_max - Delta E_max",
            "alpha alone, without a constraint",
            gap,
            (alpha,),
            -1,
            gap,
            (),
            cleared(gap),
        ),
    ]
    return {one.name: one for one in every}


# -------------------------------------------------------------------------------------------------
# The energy that a number of balls gain together: a question with one more variable for each.

TOP = Fraction(4)  # the greatest closing speed, beyond that at which the energy change is greatest
VARIABLE_WIDTH = Fraction(1, 1000)


def balls(count: int) -> tuple[BoundQuestion, Fraction]:
    """The most energy that `count` balls gain together, each struck as it leaves the table (x = 0),
    in count + 1 variables; and the closed form.

    The polynomial is sum_i Delta E(0, w_i) on ALPHAS x [0, TOP]^count, its maximum is count Delta
    E_max.
    """
    speeds = sympy.symbols([f"w{i + 1}" for i in range(count)])
    change = symbolic.normal_energy_change().xreplace({x: sympy.S.Zero})
    total = sum((change.xreplace({w: speed}) for speed in speeds), start=sympy.S.Zero)
    names = ("alpha", *map(str, speeds))
    box = (ALPHAS, *((Fraction(0), TOP) for _ in speeds))
    one = {(0,) * len(names): Fraction(1)}
    over = as_terms(sympy.Poly(total, alpha, *speeds))
    givens = [
        side
        for name, (low, high) in zip(names, box)
        for side in (f"{low} <= {name}", f"{name} <= {high}")
    ]
    statement = bounding(f"{count}-balls", " ".join(names), givens, str(from_sympy(total)), "1", 1)
    truth = truth_at_ends(lowest_terms(symbolic.delta_E_max() / r**2), 1) * count
    return BoundQuestion(
        f"{count}-balls", names, box, over, one, 1, statement, denial(statement)
    ), truth
