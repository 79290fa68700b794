"""Section 4.4: the fixed point e_1 attracts the band around it, and so the whole state space."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import reals
from proofs.claims import Assertion, Following, Readings, claim
from proofs.paper.events import height, speed, vector
from proofs.paper.orbits import within
from proofs.paper.relative_motion import (
    AROUND_E1,
    RANGE_21,
    STABILITY,
    image,
    narrow_band_stays,
    relative_step,
    z,
)
from proofs.paper.vocabulary import T, alpha, always, b, eps, equals, f1, next_states
from proofs.reading.notions import StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

size, y1, y2, p, q = reals("size y1 y2 p q")
y = Vector((y1, y2))


@claim(
    "s4.4-linear",
    "4.4",
    "line 569",
    printed=r"\overline{f}|_{\mathcal{K}} = \overline{f}_1",
    repeats="s4.3.2-f-K-continuous",
)
def map_on_the_band_is_linear(printed: Printed) -> Readings:
    """On the band f is f1, which is linear: in the differences to e_1, or in the states
    themselves.
    """
    agrees = always(printed.formula(AROUND_E1), given=[next_states(b, image)], label="agrees")

    def combines(one: Vector, other: Vector, f: StateFunction) -> Statement:
        mixed = one.scaled(p) + other.scaled(q)
        return always(
            equals(vector(f(mixed)), vector(f(one)).scaled(p) + vector(f(other)).scaled(q)),
            label="linear",
        )

    return Readings(
        {
            "in-z": Assertion((agrees, combines(z, y, relative_step))),
            "in-b": Assertion((agrees, combines(b, y, f1))),
        }
    )


@claim("s4.4-e1-attracts-K", "4.4", "line 569")
def fixed_point_attracts_the_band() -> Following:
    """e_1 is stable and attracts the band; a narrow band is mapped into itself, and each impact
    brings its states closer to e_1.

    An impact multiplies the greater of the differences to e_1, in height and in speed times T, by 2
    alpha at most.
    """
    after = relative_step(z)
    before = within(size, height(z)) & within(size, T * speed(z))
    shrunk = within(2 * alpha * size, height(after)) & within(2 * alpha * size, T * speed(after))
    return Following(
        STABILITY,
        Assertion(
            (
                *narrow_band_stays(eps),
                always(shrunk, given=[before], in_range=RANGE_21, label="contracts"),
            )
        ),
    )


@claim("s4.4-global", "4.4", "line 569")
def fixed_point_is_a_global_attractor() -> Following:
    """Every orbit on H tends to e_1."""
    return Following(STABILITY)
