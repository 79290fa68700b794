"""Counterexamples about ball and table in words: where the ball is, what terms are called."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property

from juggleproof.judging.evaluating import is_true_at, value_at
from juggleproof.proofs.paper.names import collide, definitions, derived, derived_vector
from juggleproof.reading.values import Vector
from juggleproof.reports.counterexample_words import Failure, Named, parts_of
from juggleproof.statements.definitions import Definition, instance
from juggleproof.statements.formulas import (
    RELATIONS,
    Expression,
    Formula,
    Term,
    real,
    substitute,
    term,
)

STATES = {"b": ("beta", "v"), "b_0": ("beta0", "v0"), "the start": ("y", "u")}
LETTERS = {name: letter for letter, pair in STATES.items() for name in pair}
NOUNS = {  # of definitions, of `named_terms`, and of variables that mean one thing throughout
    "E": "the energy",
    "dE1": "the value of Delta_1 E",
    "F_beta": "the height",
    "F_v": "the velocity",
    "f1_beta": "the height",
    "f1_v": "the velocity",
    "f2_beta": "the height",
    "f2_v": "the velocity",
    "value_of_E_max": "E_max",
    "value_of_dE_max": "Delta E_max",
    "value_of_dE_sup": "Delta E_sup",
    "region_margin": "the value of R(b)",
    "collision_time": "the time to collision by (6)",
    "relative_kinetic_energy": "the kinetic energy relative to e_1",
    "relative_kinetic_energy_change": "the change of the kinetic energy relative to e_1",
    "distance_of_kinetic_energies": "the squared difference of the kinetic energy from that of e_1",
    "velocity_after_impact": "the velocity after the impact",
    "T": "the period",
    "beta": "the height",
    "beta0": "the height",
    "v": "the velocity",
    "v0": "the velocity",
    "chi_dot": "the relative velocity before the impact",
    "chi_dot_after": "the relative velocity after the impact",
    "time": "the time since the launch",
}
# The left and the right side of statements that compare longer terms.
SIDES = {
    "s2.1-impact-velocity/of-a-ball.with-amplitude": (
        "the second relative velocity times the first amplitude",
        "the first relative velocity times the second amplitude",
    ),
    "s2.1-impact-velocity/of-a-ball.with-frequency": (
        "the second relative velocity times the first frequency",
        "the first relative velocity times the second frequency",
    ),
    "s2.2.2-newton/speed": ("the second difference quotient of the velocity", ""),
    "s3.2-b-bar/main": ("the difference quotient of the height", ""),
    "s3.3-e1-closed/main": ("", "what is printed"),
    "s3.5.3-jacobian/equation-2": ("an entry of the product", "the printed one"),
    "s3.5.3-jacobian/equation-3": ("an entry of the product", "the printed one"),
    "s3.5.3-jacobian/right-side-2": (
        "an entry of the printed matrix times b_0 - b",
        "that of the difference of their images",
    ),
    "s3.5.3-jacobian/right-side-3": (
        "an entry of the printed matrix times b_0 - b",
        "that of the difference of their images",
    ),
    **dict.fromkeys(
        ("s4.2-count/floor.losses-cover", "eq-26/floor.losses-cover")
        + ("sA.4-count/floor.losses-cover",),
        ("", "the energy at the edge of R plus n least losses"),
    ),
    "sA.3-sup/bound": ("the energy change of b in the period", ""),
    "s4.3.2-K-invariant/boundary-is-enough.main": ("the value of the map at y", ""),
    "sA.1-in-step/in-step.main": ("the time of flight", "K periods"),
    "eq-38/main": ("the slope of Delta_1 E with the velocity", "lam times that of R"),
    "sB.1-collision/equation": (
        "the printed height of the ball",
        "the printed height of the table",
    ),
    "sB.1-collision/ball": ("", "the printed one"),
    "sB.1-collision/table": ("", "the printed one"),
    "sB.1-tau/main": ("", "what is printed"),
    "sA.3.2-sup3/main": ("", "what is printed"),
    "sB.3-f1/map": ("", "what is printed"),
    "sB.3-f2/main": ("", "what is printed"),
    "sB.7-DE/main": ("the energy change of the impact", "what is printed"),
    "sB.1-period/main": ("", "what is printed"),
}
FLIGHT = ("F", "F_beta", "F_v")
MAPS = {  # each with the region where it is the next state
    **dict.fromkeys(("f1", "f1_beta", "f1_v"), "in_B1"),
    **dict.fromkeys(("f2", "f2_beta", "f2_v"), "in_B2"),
}


@cache
def named_terms() -> tuple[Definition, ...]:
    """The definitions of the statement file that are terms, and more derived terms with a noun."""
    v, at_e_1 = real("v"), derived_vector("e_1").component(2)
    relative = derived("relative_kinetic_energy")
    own, of_e_1, apart = (substitute(relative, {"z2": one}) for one in (v, at_e_1, v - at_e_1))
    change = derived("relative_kinetic_energy_change")
    after = collide(Vector((0, real("u"))))(Vector((0, v))).component(2)
    return (
        Definition("distance_of_kinetic_energies", ("v",), (own - of_e_1) ** 2),
        Definition("relative_kinetic_energy", ("v",), apart),
        Definition("relative_kinetic_energy_change", (), change),
        Definition("collision_time", ("beta", "v"), derived("collision_time")),
        Definition("velocity_after_impact", ("v", "u"), term(after)),
        *(one for one in definitions() if not isinstance(one.body, Formula)),
    )


def name_of(node: ast.expr | None) -> str:
    """The name of a variable, or of what is applied; nothing of anything else."""
    head = node.func if isinstance(node, ast.Call) else node
    return head.id if isinstance(head, ast.Name) else ""


def terms_in(thing: Expression) -> Iterator[Term]:
    """The terms in a term or formula, itself first."""
    if isinstance(thing, Term):
        yield thing
    for part in thing.args:
        if isinstance(part, Expression):
            yield from terms_in(part)


@dataclass(frozen=True)
class BallAndTable(Failure):
    """A statement about ball and table, and a point at which it fails."""

    @cached_property
    def states(self) -> dict[str, tuple[Fraction, Fraction]]:
        """The states of the ball that the point gives, each by its letter."""
        return {
            letter: (self.point[height], self.point[speed])
            for letter, (height, speed) in STATES.items()
            if {height, speed} <= {*self.point}
        }

    def call_of(self, part: Term) -> ast.Call | ast.Name | None:
        """The variable that this is, or the named term with its arguments; None of anything
        else.
        """
        named = instance(part, named_terms())
        tree = ast.parse(str(named), mode="eval").body if named.op in ("call", "var") else None
        return tree if isinstance(tree, (ast.Call, ast.Name)) else None

    @cached_property
    def mentioned(self) -> set[str]:
        """The variables and named terms that the statement mentions."""
        formulas = (*self.premises, *self.goals)
        return {name_of(self.call_of(part)) for one in formulas for part in terms_in(one)}

    @cached_property
    def times(self) -> dict[str, Named]:
        """What the premises say of times: when ball and table meet, or one is on the ground."""
        known = dict[str, Named]()
        for atom in (one for premise in self.premises for one in parts_of(premise)):
            node, other = map(self.call_of, atom.sides) if atom.op == "=" else (None, None)
            if not isinstance(node, ast.Call) or name_of(node) != "F_beta":
                continue
            time, body = name_of(node.args[-1]), self.body(node.args[:-1])
            if not time or body != "the ball":
                continue
            if isinstance(other, ast.Call) and self.body(other.args[:-1]) == "the table":
                known[time] = Named("the time at which ball and table meet")
            elif str(atom.sides[1]) == "0":
                of = self.of_state(node.args[:-1])
                known[time] = Named("the time to the ground", *(of or ()))
        return known

    # ---------------------------------------------------------------------------------------------
    # Where the ball is.

    def situations(self) -> Iterator[str]:
        """Height and motion in each state, and where the statement mentions it whether it lies in
        R, and whether ball and table meet within the period.
        """
        for letter, (height, speed) in self.states.items():
            ball = f"in {letter} the ball" if len(self.states) > 1 else "the ball"
            motion = f"{'rising' if speed > 0 else 'falling'} at {abs(speed)}"
            text = f"{ball} is at height {height}, {motion if speed else 'at rest'}"
            if "region_margin" in self.mentioned:
                own = dict(zip(("beta", "v"), map(real, STATES[letter])))
                margin = self.value(substitute(derived("region_margin"), own))
                text += f", {'in' if height >= 0 and margin >= 0 else 'outside'} R"
            if self.mentioned & {"collision_margin", "collision_time"} and height >= 0:
                text += f", and {meeting(height, speed, self.point['r'], self.point['g'])}"
            yield text

    def assumed(self) -> Iterator[str]:
        """The situations, and each quantity of which the premises compare two values."""
        yield from self.situations()
        for atom in (one for premise in self.premises for one in parts_of(premise)):
            if atom.op in RELATIONS:
                one, two = (self.named(side).noun for side in atom.sides)
                if one == two and one in NOUNS.values():
                    yield self.compared(*atom.sides)

    def compared(self, left: Term, right: Term) -> str:
        """The same, and of the margin of (7) whether an impact comes within the period."""
        node = self.call_of(left)
        collides = (name_of(node), str(right)) == ("collision_margin", "0")
        if collides and isinstance(node, ast.Call):
            return self.impact(node.args, self.value(left))
        return super().compared(left, right)

    def sides(self) -> tuple[str, str]:
        """What the sides of this statement are called, where they compare longer terms."""
        return SIDES.get(self.name, ("", ""))

    def beside(self, one: Named, two: Named) -> str:
        """The same noun once."""
        if one.noun == two.noun:
            return f"that {two.of or f'of {next(iter(self.states))}'}"
        return two.whole

    @staticmethod
    def state_named(chosen: str) -> str:
        """Variables that are chosen, a state by its letter."""
        for letter, pair in STATES.items():
            chosen = chosen.replace(" ".join(pair), letter)
        return chosen

    def impact(self, state: Sequence[ast.expr], margin: Fraction) -> str:
        """Whether an impact comes within the period, which on H is whether (7) holds."""
        letter = self.letter(state)
        if letter is None or self.states[letter][0] < 0:
            of = self.of_state(state)
            if of is None:
                raise LookupError("a state without a name")
            verb = "holds" if margin > 0 else "does not hold"
            return " ".join(part for part in ("inequality (7)", verb, *of) if part)
        if not margin:
            return "ball and table meet as the period ends"
        return f"{'an' if margin > 0 else 'no'} impact comes within the period"

    def named(self, part: Term, otherwise: str = "") -> Named:
        """What a term is called: by its noun, by what the premises say of it, else by the name that
        is given, or by its formula where that is short.
        """
        node = self.call_of(part)
        name = name_of(node)
        if name in self.times:
            return self.times[name]
        if isinstance(node, ast.Call) and name in NOUNS:
            called = self.applied(name, node.args)
            if called:
                return called
        elif node and name in NOUNS:
            of = self.of_state([node]) if name in LETTERS else ("", "")
            if of is not None:
                return Named(NOUNS[name], *of)
        return Named(otherwise or str(part))

    def applied(self, name: str, args: Sequence[ast.expr]) -> Named | None:
        """What a derived term is called at these arguments; None where they have no name."""
        noun = NOUNS[name]
        if name == "velocity_after_impact":
            ball, table = (value_at(ast.unparse(one), self.point) for one in args)
            if ball is None or table is None:
                return None
            return Named(noun, when=f"for ball velocity {ball} and table velocity {table}")
        if name in FLIGHT:
            time, body = self.flown(args), self.body(args[:-1])
            return Named(f"{noun} of {body}", when=time) if time and body else None
        of = self.of_state([ast.Call(ast.Name(name), [*args], [])] if name in MAPS else args)
        return None if of is None else Named(noun, *of)

    def of_state(self, state: Sequence[ast.expr]) -> tuple[str, str] | None:
        """Of which state, and when; None where the state has no name."""
        letter = self.letter(state)
        if letter is not None:
            return (f"of {letter}" if len(self.states) > 1 else "", "")
        node = state[0] if state else None
        if not isinstance(node, ast.Call):
            return None if state else ("", "")
        if name_of(node) in FLIGHT:
            time = self.flown(node.args)
            return ("", time) if time and self.body(node.args[:-1]) == "the ball" else None
        before = self.letter(node.args)
        if name_of(node) not in MAPS or before is None:
            return None
        branch = name_of(node)[:2]
        if self.is_mapped(branch, before):
            return (f"of {before}" if len(self.states) > 1 else "", "a period later")
        return (f"of {branch}({before})", "")

    def is_mapped(self, branch: str, letter: str) -> bool:
        """Whether f maps this state by f1, or by f2: whether it lies in B1, or in B2."""
        height, speed = self.states[letter]
        region = {one.name: one.body for one in definitions()}[MAPS[branch]]
        return is_true_at(str(region), {**self.point, "beta": height, "v": speed}) is True

    def flown(self, args: Sequence[ast.expr]) -> str:
        """The time of a flight; nothing where it has no value."""
        time = value_at(ast.unparse(args[-1]), self.point)
        return "" if time is None else f"at time {time}"

    def body(self, state: Sequence[ast.expr]) -> str:
        """What flies from this state: the ball or the table; nothing where that is not known."""
        if tuple(map(ast.unparse, state)) in (("0", "r"), ("r",)):
            return "the table"
        names = [name_of(one) for one in state]
        return "the ball" if set(names) <= {*LETTERS} else ""

    def letter(self, state: Sequence[ast.expr]) -> str | None:
        """The letter of a state, or of the one that has this velocity; None where it has none."""
        letters = {LETTERS.get(name_of(one), "") for one in state}
        only = letters.pop() if len(letters) == 1 else ""
        return only if only in self.states else None


def meeting(height: Fraction, speed: Fraction, launch: Fraction, gravity: Fraction) -> str:
    """Whether ball and table meet within the period, the ball being on or above the table at its
    lowest: their distance is beta + (v - r) t while both fly.

    >>> meeting(Fraction(1), Fraction(1, 2), Fraction(1), Fraction(1))
    'meets the table only as the period ends, at time 2'
    """
    period = 2 * launch / gravity
    if speed >= launch:
        if height:
            return "does not meet the table, which is no faster"
        return "keeps to the table" if speed == launch else "leaves the table behind"
    time = height / (launch - speed)
    if time < period:
        return f"meets the table at time {time}, before the period ends, at {period}"
    met = "meets the table only as" if time == period else "does not meet the table before"
    return f"{met} the period ends, at time {period}"
