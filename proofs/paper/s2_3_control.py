"""Section 2.3: the ball from one impact to the next, steered by the table's speed and the time of
flight.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import equal, reals
from proofs.claims import claim
from proofs.paper.events import ball_at, height, speed, vector
from proofs.paper.vocabulary import PAPER, alpha, always, at, collide, derived, equals
from proofs.reading.notions import StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import ShapeError, Vector

u1, u2, rho, rebound = reals("u1 u2 rho rebound")
control = Vector((u1, u2))
ball = Vector(reals("beta_before v_before"))  # just before an impact
parts_by_restitution = equal(
    rebound - u2, -alpha * (speed(ball) - u2)
)  # rebound: the ball's velocity just after the impact
just_before_the_next = ball_at(u1, Vector((height(ball), rebound)))


def _steered(state: Vector, steering: Vector) -> Vector:
    if (state, steering) != (ball, control):
        raise ShapeError("this function is known at the state and the control of the claim only")
    return just_before_the_next


@claim("eq-4", "2.3", "(4)", printed=r"f(b, u) := F^{u_1} \circ C_{u_2}(b)")
def next_state_by_control(printed: Printed) -> Statement:
    """The state just before the next impact: rebound off a table of velocity u_2 by the law of
    restitution, then free flight for u_1.

    C is given a velocity where (3) has a state: the table's height plays no part, whatever it is.
    """
    here = PAPER.extended(
        {
            "f": _steered,
            "b": ball,
            "u": control,
            "u_1": u1,
            "u_2": u2,
            r"C_{\cdot}": lambda velocity: StateFunction(collide(Vector((rho, velocity)))),
        }
    )
    return always(printed.formula(here), given=[parts_by_restitution])


@claim("s2.3-next-state", "2.3", "line 201")
def next_state_by_impact_and_flight() -> list[Statement]:
    """The state just before the next impact comes of a rebound and a flight, and so does the one
    after it, steered anew.
    """
    import symbolic

    u3, u4, again = reals("u3 u4 again")
    once = derived("controlled_step", symbolic.u, symbolic.t)

    def step(state: Vector, steering: Vector) -> Vector:
        return vector(
            at(
                once,
                {
                    "beta": height(state),
                    "v": speed(state),
                    "u": speed(steering),
                    "t": height(steering),
                },
            )
        )

    parts_again = equal(again - u4, -alpha * (speed(just_before_the_next) - u4))
    twice = ball_at(u3, Vector((height(just_before_the_next), again)))
    return [
        always(
            equals(step(ball, control), just_before_the_next),
            given=[parts_by_restitution],
            label="once",
        ),
        always(
            equals(step(step(ball, control), Vector((u3, u4))), twice),
            given=[parts_by_restitution, parts_again],
            label="twice",
        ),
    ]
