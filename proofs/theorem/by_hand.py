"""The steps of argument A as a mathematician writes them, each a statement of its own: the written
proof of a report prints these and no others.

The rules of `theorem` need less, since the checker writes their premises; these are the lines in
between.
"""

from __future__ import annotations

from typing import Any

from certificates.statements import Statement
from certificates.terms import Formula, conjunction, different, equal, reals, substitute, term
from proofs.claims import claim
from proofs.paper.vocabulary import at, derived, w, x
from proofs.reading.values import Vector
from proofs.theorem.definition import BELOW_A_THIRD as BELOW
from proofs.theorem.definition import (
    FIXED,
    IMPACT,
    IN_THE_TRAP,
    OTHER,
    PIECES,
    SPACE,
    SPEED,
    TO_THE_POINT,
    TRAP,
    alpha,
    u,
)
from proofs.theorem.definition import FROM_A_THIRD as FROM
from proofs.theorem.written import opposite

u_next, p, q, c = reals("u_next p q c")
AFTER_IMPACT, AFTER_FLIGHT = (Vector(tuple(map(term, images.entries))) for _, images in PIECES)
FLIGHT = opposite(IMPACT)
RANK = TO_THE_POINT.rank
HEIGHT, CLOSING = term(FIXED.entries[0]), term(FIXED.entries[1])
STAGE_1, STAGE_2 = TO_THE_POINT.stages[:2]


def state_after(image: Vector, thing: Any) -> Any:
    """A term or formula of the state, at the image of the state."""
    return substitute(thing, dict(zip(("x", "w"), map(term, image.entries))))


def line(
    label: str, show: Formula, *given: Formula, names: str = "alpha x w", below: Formula = BELOW
) -> Statement:
    """One step: for all of the names, below 1/3 unless told otherwise, what is given implies what
    is shown.
    """
    return Statement(
        label, tuple(names.split()), tuple(("given", one) for one in (below, *given)), show
    )


@claim("theorem-by-hand", "theorem", "argument A, written out")
def argument_a_line_by_line() -> list[Statement]:
    """The lines of argument A: energy, rank, stages, trap and contraction, each of them an
    inequality or an identity.
    """
    squared, is_speed = SPEED[1], (u >= 0, equal(u**2, SPEED[1]))
    speed = "alpha x w u"
    bound_before, bound_after = 3 * (w - 1) / 2, term(3) / 2 + 5 * w / 6
    rank_after = state_after(AFTER_IMPACT, RANK)
    x_next, w_next = map(term, AFTER_IMPACT.entries)
    distance = conjunction([part for one in (p, q) for part in (-c <= one, one <= c)])
    offset = Vector((HEIGHT + p, CLOSING + q))
    image = at(AFTER_IMPACT, {"x": offset.entries[0], "w": offset.entries[1]})
    start = dict(zip(("x", "w"), map(term, OTHER.entries)))
    between = at(AFTER_IMPACT, start)
    return [
        line("units", equal(squared, 2 * term(derived("normal_energy")))),
        line("closing-speed", (1 - u <= w) & (w <= 1 + u), SPACE, *is_speed, names=speed),
        line("rank-is-not-negative", term(0) <= RANK, SPACE, *is_speed, names=speed),
        line("flight-keeps-the-speed", equal(state_after(AFTER_FLIGHT, squared), squared)),
        line(
            "flight-lowers-the-rank", equal(state_after(AFTER_FLIGHT, RANK), RANK - 1), names=speed
        ),
        line("flight-stays", term(AFTER_FLIGHT.entries[0]) >= 0, FLIGHT),
        line(
            "impact-speed",
            equal(state_after(AFTER_IMPACT, squared), (1 + alpha * w) ** 2 - 4 * alpha * x),
        ),
        line(
            "impact-speed-is-bounded",
            u_next <= 1 + alpha * w,
            SPACE,
            IMPACT,
            equal(u_next**2, state_after(AFTER_IMPACT, squared)),
            names="alpha x w u_next",
        ),
        line("rank-before", bound_before <= RANK, SPACE, *is_speed, names=speed),
        line(
            "rank-after",
            substitute(rank_after, {"u": 1 + alpha * w}) <= bound_after,
            w > 0,
            names="alpha w",
        ),
        line("rank-falls", bound_after <= bound_before - 1, w >= 6, names="alpha w"),
        line("impact-stays", x_next >= 0, IMPACT),
        line("stage-1", (term(0) < w_next) & equal(x_next + w_next, 2 - alpha * x), SPACE, STAGE_1),
        line(
            "stage-2-impact",
            (x_next < w_next) & (alpha * w_next < 2 * alpha),
            SPACE,
            IMPACT,
            STAGE_2,
        ),
        line(
            "stage-2-flight",
            (state_after(AFTER_FLIGHT, x) < state_after(AFTER_FLIGHT, w))
            & (alpha * (w + 2) <= 3 * alpha),
            SPACE,
            FLIGHT,
            STAGE_2,
        ),
        line("trap-image", (x_next < 1) & (term(1) < w_next) & (w_next <= 2), TRAP),
        line(
            "trap-fixed-point",
            (term(0) < HEIGHT) & (HEIGHT < 1) & (term(1) < CLOSING) & (CLOSING < 2),
            names="alpha",
        ),
        line(
            "core-holds-a-ball",
            TRAP,
            x - HEIGHT <= IN_THE_TRAP.radius,
            -IN_THE_TRAP.radius <= w - CLOSING,
            w - CLOSING <= IN_THE_TRAP.radius,
            SPACE,
        ),
        line(
            "fixed",
            equal(substitute(x_next, {"x": HEIGHT, "w": CLOSING}), HEIGHT)
            & equal(substitute(w_next, {"x": HEIGHT, "w": CLOSING}), CLOSING),
            names="alpha",
            below=(alpha > 0) & (alpha < 1) & (1 + alpha > 0),
        ),
        line(
            "difference",
            equal(image.entries[0], HEIGHT + alpha * (q - p))
            & equal(image.entries[1], CLOSING - alpha * q),
            names="alpha p q",
        ),
        line(
            "closer",
            conjunction(
                [
                    part
                    for one in (alpha * (q - p), -alpha * q)
                    for part in (-2 * alpha * c <= one, one <= 2 * alpha * c)
                ]
            ),
            distance,
            names="alpha p q c",
        ),
        line(
            "other-orbit-strikes",
            (term(0) <= start["x"]) & (start["x"] < start["w"]),
            names="alpha",
            below=FROM,
        ),
        line(
            "other-orbit-flies",
            (term(between.entries[1]) <= between.entries[0]),
            names="alpha",
            below=FROM,
        ),
        line(
            "other-orbit-returns",
            conjunction(
                [
                    equal(entry, back)
                    for entry, back in zip(
                        at(
                            AFTER_FLIGHT, {"x": between.entries[0], "w": between.entries[1]}
                        ).entries,
                        OTHER.entries,
                    )
                ]
            ),
            names="alpha",
            below=FROM,
        ),
        line("other-orbit-differs", different(start["w"], CLOSING), names="alpha", below=FROM),
    ]
