"""The displays of the paper, and the names in them."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

from juggleproof.reading.evaluation import Environment
from juggleproof.reading.values import Matrix, Region, Scalar, StateFunction, Vector
from juggleproof.statements.language import Formula, Term, equal, reals, term

# -------------------------------------------------------------------------------------------------
# The table of displays in displays.txt: as printed, and as transcribed beside the restored print.


def _blocks() -> list[tuple[str, str]]:
    text = Path(__file__).with_name("displays.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    blocks = "\n".join(lines).split("== ")[1:]
    return [(where, body.strip()) for where, _, body in (block.partition("\n") for block in blocks)]


AS_PRINTED = [(where, body) for where, body in _blocks() if "~~" not in body]
RESTORED = [
    (where, garbled.strip(), print_.strip())
    for where, body in _blocks()
    if "~~" in body
    for garbled, _, print_ in [body.partition("~~")]
]
ALL = AS_PRINTED + [(where, print_) for where, _, print_ in RESTORED]


# -------------------------------------------------------------------------------------------------
# The names of the paper in physical units, as an author of claims would give them meaning.

ALPHA, BETA, V, R, G, TIME, K, EPS, S, LAMBDA = reals("alpha beta v r g t K eps s mu")
BETA0, V0 = reals("beta0 v0")
PERIOD = 2 * R / G
LAUNCH = Vector((0, R))
IDENTITY = Matrix(((1, 0), (0, 1)))
HALF = Fraction(1, 2)


def flight_matrix(time: Scalar) -> Matrix:
    return Matrix(((1, time), (0, 1)))


def fall(time: Scalar) -> Vector:
    return Vector((G * time * time * HALF, G * time))


def flow(time: Scalar) -> StateFunction:
    return StateFunction(lambda state: flight_matrix(time) * state - fall(time))


def energy(state: Vector) -> Scalar:
    height, velocity = state
    return G * height + HALF * velocity * velocity


def collision_time(state: Vector) -> Scalar:
    height, velocity = state
    return height / (R - velocity)


def strikes(state: Vector) -> Formula:
    height, velocity = state
    return HALF * G * height + R * velocity < term(R**2)


def impact_map(state: Vector) -> Vector:
    kicked = flight_matrix(-ALPHA * PERIOD / (1 - ALPHA)) * LAUNCH
    return (flight_matrix(PERIOD) * state) * -ALPHA + kicked * (ALPHA - 1)


def impact_gain(state: Vector) -> Scalar:
    return energy(impact_map(state)) - energy(state)


def collide_with(table: Vector) -> StateFunction:
    restitution = Matrix(((1, 0), (0, -ALPHA)))
    return StateFunction(lambda ball: restitution * ball + (IDENTITY - restitution) * table)


def change(function: Any) -> StateFunction:
    """Delta: what a function gains over one period with an impact."""
    return StateFunction(lambda state: function(impact_map(state)) - function(state))


PHYSICAL = Region(lambda state: term(state.component(1)) >= 0)
B1 = Region(lambda state: PHYSICAL(state) & strikes(state))
B2 = PHYSICAL - Region(strikes)
E_MAX = HALF * ((1 + ALPHA) / (1 - ALPHA) * R) ** 2
GAIN_MAX = HALF * ((1 + ALPHA) / (1 - ALPHA)) * R**2
FIXED_POINT = Vector((4 * ALPHA * R**2 / ((1 + ALPHA) ** 2 * G), -(1 - ALPHA) * R / (1 + ALPHA)))

NAMES: dict[str, Any] = {
    r"\alpha": ALPHA,
    r"\gamma": G,
    r"\overline\beta": BETA,
    r"\dot{\overline\beta}": V,
    r"\overline\beta_0": BETA0,
    r"\dot{\overline\beta}_0": V0,
    r"\dot\rho_0": R,
    r"t": TIME,
    r"T": PERIOD,
    r"I": IDENTITY,
    r"r_0": LAUNCH,
    r"e_1": FIXED_POINT,
    r"E_0": energy(Vector((BETA0, V0))),
    r"\lambda": LAMBDA,
    r"\epsilon": EPS,
    r"\xi_1": ALPHA * PERIOD / (1 - ALPHA),
    r"\epsilon_1": 2 * ALPHA * PERIOD / (1 - ALPHA**2),
    r"A_{\cdot}": flight_matrix,
    r"a_{\cdot}": fall,
    r"F^{\cdot}": flow,
    r"C_{\cdot}": collide_with,
    r"E": StateFunction(energy),
    r"\tau_c": StateFunction(collision_time, factor=True),
    r"\overline f_1": StateFunction(impact_map),
    r"\overline f_2": flow(PERIOD),
    r"\Delta_1 E": StateFunction(impact_gain),
    r"\Delta_2 E": StateFunction(lambda state: energy(flow(PERIOD)(state)) - energy(state)),
    r"\Delta \cdot": change,
    r"E_{max}": E_MAX,
    r"\Delta E_{max}": GAIN_MAX,
    r"R": StateFunction(lambda state: E_MAX + GAIN_MAX - energy(state)),
    r"\mathcal{R}": Region(lambda state: term(E_MAX + GAIN_MAX - energy(state)) >= 0),
    r"\mathcal{A}": PHYSICAL,
    r"\mathcal{H}": PHYSICAL,
    r"\mathcal{B}_1": B1,
    r"\beta_1": B1,
    r"\mathcal{B}_2": B2,
    r"\beta_2": B2,
    r"\partial\mathcal{B}_2": Region(
        lambda state: PHYSICAL(state) & equal(collision_time(state), PERIOD)
    ),
    r"\sqrt{2(1+\alpha)}": S,
    r"p": Vector((2 * PERIOD / (1 + ALPHA) * R, -(1 - ALPHA) / (1 + ALPHA) * R)),
}
POINTS = {
    r"\overline b": (r"\overline\beta", r"\dot{\overline\beta}"),
    r"\overline b_0": (r"\overline\beta_0", r"\dot{\overline\beta}_0"),
}
PAPER = Environment(NAMES, points=POINTS, state=r"\overline b")


def value_at(expression: Any, point: dict[str, Fraction]) -> Any:
    """The exact value of a term, vector or formula at a rational point."""
    if isinstance(expression, Vector):
        return tuple(value_at(entry, point) for entry in expression.entries)
    if isinstance(expression, Matrix):
        return tuple(tuple(value_at(entry, point) for entry in row) for row in expression.rows)
    if isinstance(expression, (int, Fraction)):
        return Fraction(expression)
    parts = [
        value_at(part, point) if isinstance(part, (Term, Formula)) else part
        for part in expression.args
    ]
    if isinstance(expression, Term):
        if expression.op == "var":
            return point[expression.args[0]]
        if expression.op == "num":
            return parts[0]
        return {
            "+": lambda a, b: a + b,
            "-": lambda a, b: a - b,
            "*": lambda a, b: a * b,
            "/": lambda a, b: a / b,
            "neg": lambda a: -a,
            "^": lambda a, n: a**n,
        }[expression.op](*parts)
    return {
        "<": lambda a, b: a < b,
        "<=": lambda a, b: a <= b,
        ">": lambda a, b: a > b,
        ">=": lambda a, b: a >= b,
        "=": lambda a, b: a == b,
        "!=": lambda a, b: a != b,
        "not": lambda a: not a,
        "and": lambda *all_of: all(all_of),
        "or": lambda *any_of: any(any_of),
        "implies": lambda a, b: not a or b,
        "iff": lambda a, b: a == b,
        "true": lambda: True,
        "false": lambda: False,
    }[expression.op](*parts)


UB, UV, RHO, RHODOT, AFTER, CHI1, CHI2, TP, ROUNDED = reals(
    "ub uv rho rho_dot after chi chi_dot tp n"
)
ZK, ZV, BK, BV = reals("zk zv bk bv")


def stand_in(scale: int) -> StateFunction:
    """Some map of states, for prints whose tokens are tested and not their truth."""
    return StateFunction(lambda state: state * scale)


def integer_power(base: Matrix) -> Any:
    """A_T^K for a name K, by its defining property only: here the unipotent closed form."""
    return lambda exponent: Matrix(((1, base.rows[0][1] * exponent), (0, 1)))


WIDE = PAPER.extended(
    {
        r"K": K,
        r"K_{max}": ROUNDED,
        r"A_T^{\cdot}": integer_power(flight_matrix(PERIOD)),
        r"T^{\cdot}": lambda exponent: PERIOD * exponent,
        r"\overline f_2^{\cdot}": lambda exponent: flow(PERIOD * exponent),
        r"\overline f": stand_in(2),
        r"f": stand_in(3),
        r"\beta": UB,
        r"\dot\beta": UV,
        r"\rho": RHO,
        r"\dot\rho": lambda time: RHODOT - G * time,
        r"\dot\beta'": AFTER,
        r"\dot\beta_{eq}": AFTER,
        r"\dot\chi": CHI2,
        r"\dot\chi'": AFTER,
        r"b": Vector((UB, UV)),
        r"t_f": 2 * UV / G,
        r"\sqrt{\cdot}": lambda under: S * under,
        r"\lceil\cdot\rceil": lambda value: ROUNDED * value,
        r"\tau_w": 2 / G * S,
        r"\overline b_s": Vector((0, -S * R / (1 - ALPHA))),
        r"\Delta E_{sup}": EPS,
        r"\mathcal{B}_1^0": Region(lambda state: B1(state) & equal(impact_gain(state), 0)),
        r"\beta_1^0": Region(lambda state: B1(state) & equal(impact_gain(state), 0)),
        r"\overline C_{\cdot}": lambda table: StateFunction(
            lambda state: (state - table) * -ALPHA + table
        ),
        r"R_{\cdot}": lambda factor: Matrix(((1, 0), (0, -factor))),
        r"\frac{\partial \Delta_1 E}{\partial \dot{\overline\beta}}": -ALPHA * G * PERIOD,
        r"D_{\cdot}\cdot": lambda by, function: StateFunction(lambda state: by * function(state)),
    }
)
KINETIC = PAPER.extended(
    {
        r"K": StateFunction(lambda state: HALF * state.component(2) ** 2),
        r"f": stand_in(3),
        r"\overline f": stand_in(2),
        r"z": Vector((ZK, ZV)),
        r"z_k": Vector((ZK, ZV)),
        r"b_k": Vector((BK, BV)),
        r"b_{k+1}": impact_map(Vector((BK, BV))),
        r"z_{k+1}": impact_map(Vector((BK, BV))) - FIXED_POINT,
        r"u_2'": Matrix(((0, 1),)),
        r"\xi": ALPHA * PERIOD / (1 - ALPHA),
        r"k": K,
        r"B_1": B1,
        r"R": PAPER.meaning_of(r"\mathcal{R}"),
        r"\mathcal{K}": Region(
            lambda state: B1(state) & (term((state - FIXED_POINT).component(2)) <= EPS)
        ),
        r"\partial \mathcal{K}": Region(
            lambda state: equal((state - FIXED_POINT).component(2), EPS)
        ),
    }
)
