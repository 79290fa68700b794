"""The five questions about energy, from the derived expressions: what is sought, on which set,
and.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

import sympy

from juggleproof import symbolic
from juggleproof.benchmarks.bench.answers import GaveUp, Problem, Strayed
from juggleproof.certificates.language import ClaimError, Formula, Term, equal
from juggleproof.certificates.votes.questions import questions as solver_questions
from juggleproof.certificates.votes.questions import read_statement
from juggleproof.certificates.votes.smtlib import question_text
from juggleproof.proofs.encoding import from_sympy
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

# -------------------------------------------------------------------------------------------------
# The five questions about energy, from the derived expressions: what is sought, on which set, and
# the closed form that is its truth.
#
# Everything is in the normal form (x height in units of r T, w closing speed in units of r,
# energies
# in units of r^2), for all alpha of ALPHAS at once. A set is met in two forms.  As the paper has
# it,
# by polynomial inequalities in alpha, x and w: that is what solvers are asked.  And as the image of
# a
# box under a rational map (`Question.how` says which; tests/benchmarks/test_bench.py proves it):
# that
# is what box methods take, so that constraints need no search.  The supremum over a set is the
# maximum over its closure.

ALPHAS = (
    Fraction(1, 8),
    Fraction(7, 25),
)  # 2 (1 + alpha) is the square of 3/2 and of 8/5, so that the corner of R is rational at both ends
BOUND = "bound"
p, q, s = sympy.symbols(
    "p q s"
)  # the box: p and q from 0 to 1; s = sqrt(2 (1 + alpha)) in place of alpha where that root occurs


@dataclass(frozen=True)
class Question:
    """What is sought, the fraction and the variables of its box, the statement of its set, the
    closed form, and how the set became a box.
    """

    name: str
    title: str
    how: str
    fraction: Any
    variables: tuple[Any, ...]
    sign: int
    closed_form: Any
    given: tuple[Formula, ...]
    sought: tuple[Term, Term]

    def truth(self) -> Fraction:
        """The closed form at the end of ALPHAS where it is greatest (least, where the infimum is
        sought).
        """
        return truth_at_ends(self.closed_form, self.sign)

    def problem(self) -> Problem:
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
        return Problem(
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
    """The statement that over/under, whose denominator is positive, is at most (at least, where
    sign is -1) {bound}, which is still to be put in.
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
    """The denial of a statement of `bounding` in SMT-LIB, likewise with {bound} still to be put
    in.
    """
    text = statement.format(bound=BOUND).replace("forall ", f"forall {BOUND} ")
    (asked,) = solver_questions(read_statement(text))
    return question_text(asked).replace(
        f"(declare-const {BOUND} Real)", f"(define-fun {BOUND} () Real {{bound}})"
    )


def truth_at_ends(closed_form: Any, sign: int) -> Fraction:
    """The greatest value (least, where sign is -1) on ALPHAS of a function that is monotone there;
    DerivationError where it may not be.
    """
    rises = sign_for_lossy_impacts(closed_form.diff(alpha)) * sign > 0
    return fraction(closed_form.subs(alpha, rational(ALPHAS[1 if rises else 0])))


def fraction(value: Any) -> Fraction:
    """A rational of SymPy as a Fraction; raises ClaimError for what is none."""
    value = sympy.nsimplify(value) if value.is_Rational else sympy.radsimp(value)
    if not value.is_Rational:
        raise ClaimError(f"{value} is not rational; choose ends of alpha where it is")
    return Fraction(int(value.p), int(value.q))


def rational(value: Fraction) -> Any:
    """A Fraction as SymPy's rational."""
    return sympy.Rational(value.numerator, value.denominator)


def _root(value: Fraction) -> Fraction:
    return fraction(sympy.sqrt(rational(2 * (1 + value))))


def _ends(variable: Any) -> tuple[Fraction, Fraction]:
    if variable == alpha:
        return ALPHAS
    return (_root(ALPHAS[0]), _root(ALPHAS[1])) if variable == s else (Fraction(0), Fraction(1))


def as_terms(poly: Any) -> dict[tuple[int, ...], Fraction]:
    """A polynomial of SymPy as plain data."""
    return {
        tuple(map(int, exponents)): Fraction(int(c.p), int(c.q)) for exponents, c in poly.terms()
    }


def put(expression: Any, height: Any, speed: Any) -> Any:
    """The expression at a state (x, w)."""
    return lowest_terms(expression.subs({x: height, w: speed}, simultaneous=True))


@cache
def kept_curve() -> tuple[Any, Any]:
    """(x, w): the curve B1^0, where the energy change is 0, from the origin (p = 0) to its other
    zero on x = 0 (p = 1).
    """
    height = root_of(symbolic.normal_energy_change(), x)
    speed = p * root_of(lowest_terms(height / w), w)
    return lowest_terms(height.subs(w, speed)), speed


@cache
def outside_region() -> tuple[Any, Any]:
    """(x, w): B1 beyond the edge of R. U = sqrt(2 E) is its value on that edge divided by p; w = U
    - 1 + 2 q, from x = w (q = 0) to x = 0 (q = 1).
    """
    U = sympy.Symbol("U")
    edge = (
        (-symbolic.region_corner()[1] / r)
        .subs(sympy.sqrt(2 * alpha + 2), s)
        .subs(alpha, s**2 / 2 - 1)
    )  # where x = 0, U is the speed
    speed = U - 1 + 2 * q
    height = root_of(symbolic.normal_energy() - U**2 / 2, x).subs(w, speed)
    return tuple(lowest_terms(one.subs(U, edge / p)) for one in (height, speed))


def _in_units(energy: Any) -> Any:
    return scaled(energy, r**2) if energy.is_rational_function(alpha) else (energy / r**2).expand()


def cleared(expression: Any) -> tuple[Term, Term]:
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
    found = [
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
    return {one.name: one for one in found}


# -------------------------------------------------------------------------------------------------
# Work that grows by one number at a time: variables of a bound, states of an ensemble; and the
# slope of seconds against size.

TOP = Fraction(4)  # of the closing speeds, beyond where the energy change is greatest
VARIABLE_WIDTH = Fraction(1, 1000)
STATE_STEPS, SEED = 100, 1


def balls(count: int) -> tuple[Problem, Fraction]:
    """The most energy that so many balls gain together, each struck as it leaves the table (x = 0):
    count + 1 variables; and the closed form.

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
    return Problem(f"{count}-balls", names, box, over, one, 1, statement, denial(statement)), truth


@dataclass(frozen=True)
class Ensemble:
    """Random states for one alpha, all followed for STATE_STEPS periods."""

    alpha: Fraction = Fraction(3, 10)


def ensemble(work: Ensemble, size: Fraction) -> Strayed:
    """So many states in float64 with their bounds; the answer is the largest bound, the note counts
    what is undecided.
    """
    import numpy as np

    from juggleproof.scenes.juggler import orbit, random, scene

    found: Any = orbit(scene(work.alpha, random(int(size), seed=SEED)), "fast", STATE_STEPS)
    here = found.ensemble
    decided = here.end == 1
    bound = float(np.maximum(here.error_x, here.error_w)[decided].max(initial=0.0))
    return Strayed(Fraction(bound), Fraction(bound), f"{len(found.undecided)} undecided")


def slope(sizes: Sequence[float], seconds: Sequence[float]) -> float | None:
    """The slope of the line through log seconds against log sizes, by least squares; None where
    there are not two sizes.

    >>> round(slope([1, 10, 100], [2.0, 20.0, 200.0]), 6)
    1.0
    """
    if len(set(sizes)) < 2:
        return None
    xs, ys = [math.log(size) for size in sizes], [math.log(one) for one in seconds]
    middle, level = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - middle) * (b - level) for a, b in zip(xs, ys)) / sum(
        (a - middle) ** 2 for a in xs
    )


# -------------------------------------------------------------------------------------------------
# The state after so many periods in each arithmetic of the scene, and in float64 alone; how far it
# is from the exact one is computed untimed.

BITS = 256  # of a distance, rounded up
DIGITS = 50


@dataclass(frozen=True)
class Start:
    """An orbit: restitution and starting state, in normal form."""

    name: str
    title: str
    alpha: Fraction
    x: Fraction
    w: Fraction


STARTS = {
    one.name: one
    for one in (
        Start(
            "orbit",
            "the orbit of x = 1000, w = -41 for alpha = 3/10, which ends in the trap",
            Fraction(3, 10),
            Fraction(1000),
            Fraction(-41),
        ),
        Start(
            "orbit-edge",
            "the orbit of x = 4/3, w = 3 for alpha = 3/7, which meets x = w exactly, where f jumps",
            Fraction(3, 7),
            Fraction(4, 3),
            Fraction(3),
        ),
    )
}
Later = Callable[[], Strayed]


def _followed(start: Start, arithmetic: str, steps: int, **more: Any) -> Any:
    from juggleproof.scenes.juggler import orbit, point, scene

    found = orbit(scene(start.alpha, point(start.x, start.w)), arithmetic, steps, **more)
    if found.counts() != {"reached": 1}:
        raise GaveUp(", ".join(found.counts()))
    return found


def _away(start: Start, steps: int, x: Any, w: Any, bound: Any, note: str = "") -> Strayed:
    """How far (x, w), in rationals of python-flint, is from the exact state, in the sup norm."""
    from flint import arb, ctx, fmpq

    true = _followed(start, "exact", steps).tracks[0].here
    distance = max(abs(x - true.x), abs(w - true.w))
    kept, ctx.prec = ctx.prec, BITS
    above = arb(distance).upper().fmpq() if distance else fmpq(0)
    ctx.prec = kept
    return Strayed(
        Fraction(int(above.p), int(above.q)),
        None if bound is None else Fraction(int(bound.p), int(bound.q)),
        note,
        bound is not None and distance > bound,
    )


def exact(start: Start, size: Fraction) -> Later:
    """Exact rationals: what the others are measured against."""
    found = _followed(start, "exact", int(size)).tracks[0].here
    return lambda: Strayed(
        Fraction(0), Fraction(0), f"{max(found.x.height_bits(), found.w.height_bits())} bits"
    )


def enclosed(start: Start, size: Fraction) -> Later:
    """Arb balls; their radius is the bound."""
    here = _followed(start, "enclosed", int(size)).tracks[0].here

    def later() -> Strayed:
        from flint import arb

        x, w = (arb(value) for value in (here.x, here.w))
        radius = max(x.rad().upper().fmpq(), w.rad().upper().fmpq())
        return _away(start, int(size), x.mid().fmpq(), w.mid().fmpq(), radius)

    return later


def fast(start: Start, size: Fraction) -> Later:
    """float64 with its running bound."""
    row = _followed(start, "fast", int(size)).row(0)
    return lambda: _away(
        start, int(size), _of_float(row.x), _of_float(row.w), max(map(_of_float, row.error))
    )


def mp(start: Start, size: Fraction) -> Later:
    """mpmath: nothing is proved."""
    here = _followed(start, "mp", int(size), precision=DIGITS).tracks[0].here

    def later() -> Strayed:
        from flint import fmpq
        from mpmath.libmp import to_rational

        x, w = (fmpq(*map(int, to_rational(value._mpf_))) for value in (here.x, here.w))
        return _away(start, int(size), x, w, None)

    return later


def floats(start: Start, size: Fraction) -> Later:
    """float64 period by period, as one writes it down: every branch is what rounding makes of
    it.
    """
    from juggleproof.scenes.juggler.given import formulas

    map_of, alpha, x, w = formulas(), float(start.alpha), float(start.x), float(start.w)
    for _ in range(int(size)):
        x, w = map_of.impact(alpha, x, w) if map_of.margin(x, w) > 0 else map_of.flight(x, w, 1)
    return lambda: _away(start, int(size), _of_float(x), _of_float(w), None)


def _of_float(value: float) -> Any:
    from flint import fmpq

    return fmpq(*float(value).as_integer_ratio())
