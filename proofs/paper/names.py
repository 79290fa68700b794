"""The paper's names: what they stand for in statements, what prints mean by them, and what happens
within a period.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from typing import TypeVar

from juggleproof.judging import claims, forms
from juggleproof.judging.forms import Vocabulary
from juggleproof.papers.derivations import (
    Origin,
    derived_value,
    from_deriving,
    made_by,
    sentence,
)
from juggleproof.papers.derivations import derived as derived
from juggleproof.papers.derivations import derived_matrix as derived_matrix
from juggleproof.papers.derivations import derived_vector as derived_vector
from juggleproof.papers.derived import derived_by
from juggleproof.reading.evaluation import Environment, relate
from juggleproof.reading.meaning import Meaning, Printed
from juggleproof.reading.values import (
    Matrix,
    Region,
    Result,
    Scalar,
    ShapeError,
    StateFunction,
    Value,
    Vector,
)
from juggleproof.statements.definitions import Definition
from juggleproof.statements.language import (
    Formula,
    Number,
    Term,
    conjunction,
    disjunction,
    equal,
    names_in,
    real,
    reals,
    substitute,
    term,
)

# -------------------------------------------------------------------------------------------------
# The paper's names: what stands for what in statements, what is assumed where nothing is said, and
# what prints mean.
#
# Physical units: alpha restitution; r the table's launch speed \dot\rho_0; g gravity \gamma; beta,
# v height and velocity of the ball when the table is at its lowest; T = 2 r/g. Normal form: x =
# beta/(r T), w = 1 - v/r. Where nothing is said, 0 < alpha < 1 and r, g > 0. Formulas come from
# `symbolic`, which derives them; none is typed here.

alpha, beta, v, r, g, t, T, K, eps, s = reals("alpha beta v r g t T K eps s")
x, w, c = reals("x w c")
b = Vector((beta, v))

ORDER = ("alpha", "r", "g", "K", "n", "eps", "beta", "v", "beta0", "v0", "x", "w", "t", "tau")
STANDING = Vocabulary(
    order=ORDER,
    ranges={"alpha": (alpha > 0, alpha < 1)},
    givens={"r": (r > 0,), "g": (g > 0,)},
    abbreviations={"T": derived("period")},
    roots={"s": 2 * (1 + alpha)},
    sample={"alpha": Fraction(3, 11), "r": Fraction(1), "g": Fraction(1)},
    domains={"alpha": (alpha > 0, alpha < 1), "K": (K >= 1,), "eps": (eps > 0,)},
    scales=frozenset({"r", "g"}),
    reads=lambda: paper_names(),
    introduces=lambda section: introduced(section),
    assumes=lambda section: assumed(section),
    defines=lambda: definitions(),
)
claim = partial(claims.claim, vocabulary=STANDING)
always = partial(forms.always, vocabulary=STANDING)
exists_some = partial(forms.exists_some, vocabulary=STANDING)
is_maximum = partial(forms.is_maximum, vocabulary=STANDING)
is_supremum = partial(forms.is_supremum, vocabulary=STANDING)
same_set = partial(forms.same_set, vocabulary=STANDING)
WITH_INTEGER_K = replace(
    STANDING, givens={**STANDING.givens, "K": (K >= 1,)}, integers=frozenset({"K"})
)


Placed = TypeVar("Placed", Term, Formula, Vector)


def at(thing: Placed, place: Vector | Mapping[str, Number]) -> Placed:
    """A term, formula or vector of the state (beta, v), at another state or with other values."""
    values = (
        dict(zip(("beta", "v"), (term(entry) for entry in place.entries)))
        if isinstance(place, Vector)
        else place
    )
    if isinstance(thing, Vector):
        return Vector(tuple(substitute(term(entry), values) for entry in thing.entries))
    placed: Placed = substitute(thing, values)
    return placed


def function(name: str) -> StateFunction[Term]:
    """The derived function of a state of this name in `symbolic`, as a function that prints can
    apply.
    """
    return StateFunction(lambda state: at(derived(name), state))


def state_map(name: str) -> StateFunction[Vector]:
    """The derived map of states of this name in `symbolic`, as a function that prints can apply."""
    return StateFunction(lambda state: at(derived_vector(name), state))


f1, f2 = state_map("f1"), state_map("f2")
energy = function("total_energy")
impact_energy_change = function("energy_change_1")
collision_time = StateFunction(lambda state: at(derived("collision_time"), state), factor=True)


def flight(time: Scalar) -> StateFunction[Vector]:
    """F^t: the derived flight for this time."""
    # All three at once: the state may itself contain a time.
    return StateFunction(
        lambda state: at(
            derived_vector("flight_map"),
            {"beta": state.component(1), "v": state.component(2), "t": time},
        )
    )


def flight_matrix(time: Scalar) -> Matrix:
    """A_t, the derived linear part of flight."""
    return Matrix(
        tuple(
            tuple(at(term(entry), {"t": term(time)}) for entry in row)
            for row in derived_matrix("flight_matrix").rows
        )
    )


def flight_offset(time: Scalar) -> Vector:
    """a_t, what gravity takes off in flight, as derived."""
    return Vector(
        tuple(
            at(term(entry), {"t": term(time)}) for entry in derived_vector("flight_offset").entries
        )
    )


def collide(table: Vector) -> StateFunction[Vector]:
    """C_y: the derived change of the ball's state at an impact with a table in the state y."""

    def after(ball: Vector) -> Vector:
        names = ("ball_height", "ball_speed", "table_height", "table_speed")
        image = made_by(Origin("impact_map"), derived_by(Vector, from_deriving("struck")))
        values = dict(zip(names, (term(entry) for entry in (*ball.entries, *table.entries))))
        return at(image, values)

    return StateFunction(after)


# The paper's regions: H; B1 and B2 of (7), by whether the collision comes before the period ends;
# the parts of B1 whose impact gains, loses or keeps energy; R of section 4.1.
H = Region(lambda state: term(state.component(1)) >= 0)
STRIKES = Region(lambda state: at(derived("collision_margin") > 0, state))
B1 = H & STRIKES
B2 = H - STRIKES
B1_PLUS = B1 & Region(lambda state: at(derived("energy_change_1") > 0, state))
B1_MINUS = B1 & Region(lambda state: at(derived("energy_change_1") < 0, state))
B1_ZERO = B1 & Region(lambda state: equal(at(derived("energy_change_1"), state), 0))
R = H & Region(lambda state: at(derived("region_margin"), state) >= 0)
# Where R(b) < 0; the states of H, and of B1, there.  B1 with the line between B1 and B2; where
# R(b) = 0; the state of B1 there on the ground; the boundary of R as printed, with the edge of H.
BEYOND_R = Region(lambda state: at(derived("region_margin"), state) < 0)
OUTSIDE, B1_OUTSIDE = H & BEYOND_R, B1 & BEYOND_R
CLOSED_B1 = H & Region(lambda state: at(derived("collision_margin"), state) >= 0)
ON_R = Region(lambda state: equal(at(derived("region_margin"), state), 0))
CORNER = B1 & ON_R & Region(lambda state: equal(state.component(1), 0))
BOUNDARY_OF_R = R & Region(
    lambda state: equal(at(derived("region_margin"), state), 0) | equal(height(state), 0)
)
r_0 = derived_vector("launch_state")
e_1 = derived_vector("e_1")
I = Matrix(((1, 0), (0, 1)))  # noqa: E741  (the paper's name)


def next_states(state: Vector, image: Vector) -> Formula:
    """image = f(state), for the piecewise map f."""
    one, two = f1(state), f2(state)
    return (B1(state) & equals(image, one)) | (B2(state) & equals(image, two))


def equals(left: Vector | Matrix, right: Vector | Matrix) -> Formula:
    """The vectors or matrices are equal entry by entry."""
    return relate(left, "=", right)


POINTS = {
    r"\overline b": (r"\overline\beta", r"\dot{\overline\beta}"),
    r"\overline b_0": (r"\overline\beta_0", r"\dot{\overline\beta}_0"),
}


@cache
def meanings() -> dict[str, Value]:
    """What the paper's names stand for."""
    return {
        r"\alpha": alpha,
        r"\gamma": g,
        r"\overline\beta": beta,
        r"\dot{\overline\beta}": v,
        r"\dot\rho_0": r,
        r"t": t,
        r"T": T,
        r"\overline\beta_0": real("beta0"),
        r"\dot{\overline\beta}_0": real("v0"),
        r"I": I,
        r"r_0": r_0,
        r"K": K,
        r"\epsilon": eps,
        r"A_{\cdot}": flight_matrix,
        r"a_{\cdot}": flight_offset,
        r"F^{\cdot}": flight,
        r"C_{\cdot}": collide,
        r"R_\alpha": derived_matrix("restitution_matrix"),
        r"\xi_1": derived("xi_1"),
        r"\epsilon_1": derived("epsilon_1"),
        r"e_1": e_1,
        r"\tau_c": collision_time,
        r"\overline f_1": f1,
        r"\overline f_2": f2,
        r"E": energy,
        r"\Delta_1 E": impact_energy_change,
        r"E_{max}": derived("E_max"),
        r"\Delta E_{max}": derived("delta_E_max"),
        r"\Delta E_{sup}": derived("delta_E_sup"),
        r"\sqrt{2(1+\alpha)}": s,
        r"\mathcal{H}": H,
        r"\mathcal{B}_1": B1,
        r"\mathcal{B}_2": B2,
        r"\mathcal{R}": R,
        r"R": StateFunction(lambda state: at(derived("region_margin"), state)),
    }


def paper_names() -> Environment:
    """The names in which the paper's prints are read."""
    return _paper_names()


@cache
def _paper_names() -> Environment:
    return Environment(meanings(), points=POINTS, state=r"\overline b")


# -------------------------------------------------------------------------------------------------
# What happens within a period, in formulas of derived flight and impact: ball and table meet,
# approach, collide, and fly on.
#
# A time at which something happens is left unknown and defined by what happens then: nothing that
# was solved for enters here.


def ball_at(time: Number, start: Vector = b) -> Vector:
    """The ball's state after free flight for this time."""
    return flight(time)(start)


def table_at(time: Number, start: Vector | None = None) -> Vector:
    """The table's state after free flight for this time, from its launch if no state is given."""
    return flight(time)(r_0 if start is None else start)


def vector(value: object) -> Vector:
    """The value itself, which has to be a state."""
    if not isinstance(value, Vector):
        raise ShapeError("a state was expected")
    return value


def matrix(value: object) -> Matrix:
    """The value itself, which has to be a matrix."""
    if not isinstance(value, Matrix):
        raise ShapeError("a matrix was expected")
    return value


def as_region(value: object) -> Region:
    """The value itself, which has to be a region."""
    if not isinstance(value, Region):
        raise ShapeError("a region was expected")
    return value


def height(state: Vector) -> Term:
    """The first component of a state."""
    return term(state.component(1))


def speed(state: Vector) -> Term:
    """The second component of a state."""
    return term(state.component(2))


def meet(time: Number, ball: Vector = b) -> Formula:
    """Ball and table are at one height at this time, if neither is deflected before."""
    return equal(height(ball_at(time, ball)), height(table_at(time)))


def strikes_at(time: Term) -> Formula:
    """The ball strikes the table at this time, which lies within the period: they meet, and
    approach each other.
    """
    return conjunction([time >= 0, time < T, meet(time), v < r])


def after_impact(time: Number) -> Vector:
    """The ball's state just after an impact at this time."""
    return collide(table_at(time))(ball_at(time))


def only_at(place: Vector, value: Result, factor: bool = False) -> StateFunction[Result]:
    """The function that has this value at this state, and is refused at any other."""

    def call(state: Vector) -> Result:
        if state != place:
            raise ShapeError("this function is known at the state of the claim only")
        return value

    return StateFunction(call, factor)


def value_of(printed: Printed, environment: Environment) -> Value:
    """The value of a print that is an expression and states no relation."""
    return Meaning(environment).here(printed.tree)


# -------------------------------------------------------------------------------------------------
# The band around e_1 of section 4.3.2, and where R leaves B1.


def of_z(value: Placed) -> StateFunction[Placed]:
    """A derived term or state of z = b - e_1, as a function of z."""
    return StateFunction(lambda state: at(value, {"z1": height(state), "z2": speed(state)}))


kinetic_energy = of_z(derived("relative_kinetic_energy"))


def from_e_1(state: Vector) -> Term:
    """K(b - e_1): the kinetic energy of the motion relative to e_1."""
    return term(kinetic_energy(state - e_1))


def on_the_line(velocity: Term) -> Vector:
    """The state of this velocity from which ball and table meet just when the table bounces
    next.
    """
    return Vector((at(derived("boundary_height"), {"v": velocity}), velocity))


def leaves_R_at(velocity: Term) -> Formula:
    """The line between B1 and B2 meets the boundary of R at this velocity, below the table's launch
    speed.
    """
    return conjunction(
        [velocity < r, equal(energy(on_the_line(velocity)), derived("region_energy"))]
    )


def band(size: Term) -> Region:
    """The states of B1 and R whose kinetic energy relative to e_1 is at most `size`."""
    return B1 & R & Region(lambda state: from_e_1(state) <= size)


def boundary_of_band(size: Term) -> Region:
    """What bounds the band: its closure, at height 0, on the line between B1 and B2, at the energy
    of R, or at `size`.
    """

    def holds(state: Vector) -> Formula:
        margins = (
            height(state),
            at(derived("collision_margin"), state),
            at(derived("region_margin"), state),
            size - from_e_1(state),
        )
        return conjunction([margin >= 0 for margin in margins]) & disjunction(
            [equal(margin, 0) for margin in margins]
        )

    return Region(holds)


def is_narrow(size: Term) -> tuple[Formula, ...]:
    """The band of this size does not reach up to the velocity c, at which R leaves B1."""
    above_e_1 = (speed(e_1) < c) & (from_e_1(on_the_line(c)) > size)
    return leaves_R_at(c), above_e_1


# -------------------------------------------------------------------------------------------------
# The names that stand in the statement file; each body is derived, but that of the trap.

STATE = ("beta", "v")

# Name, function of `symbolic`, parameters of a term; a vector has a name for each entry as well.
DERIVED: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("E", "total_energy", STATE),
    ("dE1", "energy_change_1", STATE),
    ("F", "flight_map", (*STATE, "t")),
    ("f1", "f1", STATE),
    ("f2", "f2", STATE),
    ("e_1", "e_1", ()),
    ("e_K", "fixed_point", ("K",)),
    ("struck_e_K", "impact_fixed_point", ("K",)),
    ("value_of_E_max", "E_max", ()),
    ("value_of_dE_max", "delta_E_max", ()),
    ("value_of_dE_sup", "delta_E_sup", ()),
    ("level_of_R", "region_energy", ("r",)),
    ("tau_c", "collision_time", STATE),
    ("height_on_line", "boundary_height", ("v",)),
    ("collision_margin", "collision_margin", STATE),
    ("region_margin", "region_margin", STATE),
)


def sets() -> tuple[tuple[str, tuple[str, ...], Term | Formula, str], ...]:
    """Sets and conditions that sentences name: name, parameters, body, and what it says.  A later
    one is put in place of a whole of which an earlier one is a part.
    """
    trap, narrow = (term(0) <= x) & (x < w) & (alpha * w < 1), is_narrow(eps)
    return (
        ("in_R", STATE, R(b), "The region R, on or above the table."),
        ("in_B1", STATE, B1(b), "On or above the table, and an impact comes within the period."),
        ("in_B2", STATE, B2(b), "On or above the table, and no impact comes within the period."),
        ("meet", (*STATE, "t"), meet(t), "Ball and table are at one height after this time."),
        (
            "on_line",
            STATE,
            meet(T),
            "The line between B1 and B2: ball and table meet as the period ends.",
        ),
        ("in_closed_B1", STATE, CLOSED_B1(b), "B1 with the line between B1 and B2."),
        ("in_B1_plus", STATE, B1_PLUS(b), "B1^+: the states of B1 whose impact gains energy."),
        ("in_B1_minus", STATE, B1_MINUS(b), "B1^-: the states of B1 whose impact loses energy."),
        ("in_B1_0", STATE, B1_ZERO(b), "B1^0: the states of B1 whose impact keeps the energy."),
        ("outside_R", STATE, OUTSIDE(b), "The states of H outside R."),
        (
            "in_B1_outside_R",
            STATE,
            B1_OUTSIDE(b),
            "The states of B1 outside R, whose impacts are those outside R.",
        ),
        (
            "on_boundary_of_R",
            STATE,
            BOUNDARY_OF_R(b),
            "The boundary of R: its states with R(b) = 0, and those on the ground.",
        ),
        (
            "at_corner_of_R",
            STATE,
            CORNER(b),
            "The corner of R: the state of B1 on the ground with R(b) = 0.",
        ),
        (
            "K_from_e_1",
            ("v",),
            from_e_1(b),
            "The kinetic energy of the motion relative to e_1, K(b - e_1) of equation 28.",
        ),
        (
            "in_band",
            (*STATE, "eps"),
            band(eps)(b),
            "The band around e_1: the states of B1 and R whose kinetic energy relative to e_1 is at"
            " most eps (equation 32).",
        ),
        (
            "on_boundary_of_band",
            (*STATE, "eps"),
            boundary_of_band(eps)(b),
            "The boundary of the band: its closure on the ground, on the line between B1 and B2, at"
            " the level of R, and where the kinetic energy relative to e_1 is eps.",
        ),
        (
            "R_leaves_B1_at",
            ("c",),
            narrow[0],
            "At this velocity, below the launch speed, the line between B1 and B2 meets the level"
            " of R: there R leaves B1.",
        ),
        (
            "narrow",
            ("eps",),
            narrow[1],
            "The band of this size is narrow: it does not reach to the velocity c, at which R"
            " leaves B1.",
        ),
        (
            "in_trap",
            ("x", "w"),
            trap,
            "The trap, in normal form: B1 with a closing speed < 1/alpha.",
        ),
    )


def definitions() -> tuple[Definition, ...]:
    """The definitions in the order of the file: a later one may name an earlier one.

    >>> print(definitions()[0].text())
    define E(beta, v) over g := beta*g + v^2/2
    """
    return _definitions()


@cache
def _definitions() -> tuple[Definition, ...]:
    made: list[Definition] = []
    for name, function, parameters in DERIVED:
        value = derived_value(Origin(function))
        says = sentence(function)
        if isinstance(value, Term):
            made.append(Definition(name, parameters, value, says))
            continue
        entries = tuple(map(term, vector(value).entries))
        for part, entry in zip(STATE, entries):
            own = tuple(one for one in parameters if one in names_in(entry))
            made.append(Definition(f"{name}_{part}", own, entry, says))
            says = ""
        if parameters:
            made.append(Definition(name, parameters, entries))
    return (*made, *(Definition(*row) for row in sets()))


def assumed(section: str) -> tuple[Formula, ...]:
    """What the section assumes: (21) in section 4, "assuming favorable parameter values", and in
    appendix A, which serves it.
    """
    serves = section.split(".")[0] in ("4", "A")
    return (alpha < derived("restitution_threshold", 2),) if serves else ()


# -------------------------------------------------------------------------------------------------
# The names that the paper's prose introduces, section by section; its displays define others.

# By section, names that its prose introduces, with what they name; "" holds throughout, as the
# table of B.7 repeats.
PROSE: dict[str, dict[str, str]] = {
    "": {
        r"\overline{b}": "the ball's state when the table is at its lowest",
        r"\overline{\beta}": "the ball's height when the table is at its lowest",
        r"\dot{\overline{\beta}}": "the ball's velocity when the table is at its lowest",
        r"\overline{b}_{\cdot}": "such a state, by the number of the bounce, or another index",
        r"\overline{f}": "the map of such states",
        "b": "the ball's state",
        r"\beta": "the ball's height",
        r"\dot{\beta}": "the ball's velocity",
        r"\rho": "the table's height",
        r"\dot{\rho}": "the table's velocity",
        "K": "a number of periods; from 4.3 on, the kinetic energy",
    },
    "2.2.2": {
        "x": "a point mass with its state",
        "y": "another point mass with its state",
        r"\chi": "the position of a mass; relative to another from (2) on",
        r"\dot{\chi}": "the velocity that goes with it",
        r"\dot{\chi}'": "that velocity after an impact",
        r"\dot{\dot{\chi}}": "the acceleration that goes with it",
    },
    "3.5.1": {"t_{f}": "the time of flight"},
    "4.3.1": {r"\Delta K": "the change of K by an impact", "k": "the number of impacts"},
    "B.7": {
        "x": "the state that a function is applied to, or the table's",
        "y": "the ball's state before an impact",
        "C_{x}": "the impact with a table in the state x",
        "f": "the map of sampled states",
    },
}


def introduced(section: str) -> frozenset[str]:
    """The names that hold throughout, and those that the prose of the section, or of one that holds
    it, introduces.

    >>> ["x" in introduced(section) for section in ("2.2.2", "B.3")]
    [True, False]
    """
    parts = section.split(".")
    holders = ["", *(".".join(parts[: k + 1]) for k in range(len(parts)))]
    return frozenset(name for one in holders for name in PROSE.get(one, ()))
