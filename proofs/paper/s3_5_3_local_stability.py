"""Section 3.5.3: the Jacobian of the composites, and the stability of their fixed points."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from certificates.statements import AnyStatement, Iterates, Statement
from certificates.terms import ClaimError, Formula, Number, Term, reals, term
from proofs.claims import Argument, Assertion, claim
from proofs.paper.events import speed, vector
from proofs.paper.orbits import (
    always_integer,
    b_0,
    comes_back,
    cycle,
    eigenvalue_of,
    exists_integer,
    flights,
    from_threshold_on,
    next_state_is,
    within,
)
from proofs.paper.vocabulary import (
    B1,
    B2,
    PAPER,
    H,
    K,
    T,
    alpha,
    always,
    at,
    b,
    derived,
    equals,
    exists_some,
    f1,
    f2,
    flight_matrix,
    r,
)
from proofs.reading.errors import PrintError
from proofs.reading.meaning import Meaning
from proofs.reading.printed import Printed
from proofs.reading.tree import Chain
from proofs.reading.values import Matrix, Vector

n, p, q, size, lift = reals("n p q size lift")


def composite(count: Number, state: Vector) -> Vector:
    """The state after all but one of so many periods of flight, and one with an impact."""
    return vector(f1(vector(flights(term(count) - 1)(state))))


def power_of_flight(time: Term, count: Number) -> Matrix:
    """A_t to this power, which is A of so many times t, as the statement `powers` has it."""
    return flight_matrix(term(count) * time)


def is_jacobian(value: Any, count: Number, label: str) -> Statement:
    """The matrix takes the difference of any two states to the difference of their images under the
    composite.
    """
    if not isinstance(value, Matrix):
        raise ClaimError("a matrix is expected here")
    difference = composite(count, b_0) - composite(count, b)
    return always_integer(equals(vector(value * (b_0 - b)), difference), label=label)


def for_every_k(printed: Printed) -> list[Statement]:
    """What is printed, for every integer K; a power with the exponent K of anything but A_t has a
    meaning for single K only.
    """
    chain = printed.tree
    if not isinstance(chain, Chain):
        raise ClaimError("an equation is expected here")
    meaning = Meaning(PAPER.extended({r"A_{\cdot}^{\cdot}": power_of_flight}))
    left = is_jacobian(meaning.here(chain.first), K, "left-side")
    try:
        return [left, is_jacobian(meaning.here(chain.rest[-1][1]), K, "right-side")]
    except PrintError:
        return [left]


@claim(
    "s3.5.3-jacobian",
    "3.5.3",
    "line 422",
    printed=r"-\alpha A_T^K = \begin{bmatrix} -\alpha & -\alpha T^K \\ 0 & -\alpha \end{bmatrix}",
)
def jacobian_of_the_composites(printed: Printed) -> list[AnyStatement]:
    """Both sides are the matrix of the composite for K, which is affine; and the power of A_T on
    the left is the repeated product.
    """
    one, many = (
        tuple(term(entry) for entry in vector(flight_matrix(count * T) * b)) for count in (1, K)
    )
    equations: list[AnyStatement] = []
    for count in (1, 2, 3):
        environment = PAPER.extended({"K": count})
        equations.append(always_integer(printed.formula(environment), label=f"equation-{count}"))
        equations.append(is_jacobian(printed.right(environment), count, f"right-side-{count}"))
    return [
        Iterates("powers", ("beta", "v"), one, "K", many, ("T",)),
        *for_every_k(printed),
        *equations,
    ]


@claim("s3.5.3-eigenvalues", "3.5.3", "line 424")
def eigenvalues_of_the_composites_lie_in_the_unit_circle() -> Statement:
    """For every K, each complex eigenvalue of the matrix of the composite is less than 1 in
    absolute value.
    """
    return always_integer(p**2 + q**2 < 1, given=[eigenvalue_of(derived("return_jacobian"), p, q)])


@claim("s3.5.3-locally-stable", "3.5.3", "line 424", parameters=("alpha", "K"))
def fixed_points_are_stable_where_they_exist() -> Argument:
    """The eigenvalues make every fixed point stable that exists, also at the left end of its range
    (20).

    For that, the composite has to be what the map does around the fixed point: a state that lies a
    little higher must fly on as long. And from a state that lies a little higher the orbit has to
    come back near the fixed point, whose period is 2 here.
    """
    higher = b + Vector((lift, term(0)))
    flies_on = B1(higher) & B2(vector(flights(K - 2)(vector(f1(higher)))))
    second = vector(at(derived("impact_fixed_point"), {"K": 2}))
    lifted = second + Vector((lift, term(0)))
    returns = B1(lifted) & next_state_is(
        vector(f1(lifted)), lambda state: within(r, speed(state) - speed(second))
    )
    return Argument(
        steps={
            "eigenvalues": Assertion(
                (
                    always_integer(
                        p**2 + q**2 < 1, given=[eigenvalue_of(derived("return_jacobian"), p, q)]
                    ),
                )
            ),
            "same-pieces": Assertion(
                (
                    exists_integer(
                        ["lift"],
                        flies_on,
                        within=[lift > 0],
                        given=[K >= 2, comes_back(K)],
                        in_range=from_threshold_on(),
                    ),
                )
            ),
        },
        conclusion=Assertion(
            (
                always(comes_back(2, second), label="second"),
                exists_some(
                    ["lift"],
                    returns,
                    within=[lift > 0],
                    in_range=[alpha >= Fraction(1, 3), alpha < 1],
                    label="returns",
                ),
            )
        ),
    )


@claim("s3.5.3-stable-inside", "3.5.3", "line 424", parameters=("alpha", "K"))
def fixed_points_are_stable_inside_their_range() -> list[Statement]:
    """Where the fixed point lies above the edge of H, every small box around it has the same impact
    and flights, and comes back.

    So the fixed point is stable there.
    """
    center, middle = vector(derived("impact_fixed_point")), b_0
    edge, largest = term(center.component(1)), term(middle.component(1))

    def in_box(state: Vector, around: Vector) -> Formula:
        up, ahead = (term(entry) for entry in state - around)
        return within(size, up) & within((1 - alpha) * size, alpha * K * T * ahead)

    def corner_at_most_on_the_line(around: Vector, box: Term) -> Formula:
        corner = around + Vector((box, (1 - alpha) * box / (alpha * K * T)))
        return term(at(derived("collision_margin"), corner)) >= 0

    return [
        always_integer(comes_back(K, center), label="center"),
        always_integer(
            edge > 0,
            in_range=[alpha > 0, alpha < 1, alpha * (K + 1) > K - 1],
            label="there-are-boxes",
        ),
        always_integer(corner_at_most_on_the_line(center, edge), label="corner"),
        always_integer(
            B1(b),
            given=[size <= largest, in_box(b, middle), corner_at_most_on_the_line(middle, largest)],
            label="impact",
        ),
        always_integer(
            in_box(cycle(K), center) & H(cycle(K)),
            given=[size <= edge, in_box(b, center)],
            label="comes-back",
        ),
        always_integer(
            H(vector(flights(n)(b))),
            given=[H(b), H(vector(flights(K - 1)(b))), n >= 0, n <= K - 1],
            label="above-the-table",
        ),
        always(B2(b), given=[H(b), H(vector(f2(b)))], label="flights"),
    ]
