"""Section 3.5.2: which restitutions allow which periods of orbits with one impact."""

from __future__ import annotations

from collections.abc import Callable

from certificates.statements import Statement
from certificates.terms import ClaimError, Formula, Term, conjunction, iff, reals, term
from proofs.claims import Assertion, Readings, claim
from proofs.paper.orbits import always_integer, comes_back, from_threshold_on, relations_of
from proofs.paper.outside import ceiling_of, floor_of
from proofs.paper.vocabulary import B1, NAMES, PAPER, K, alpha, always, b, derived
from proofs.reading.environment import Environment
from proofs.reading.meaning import Meaning
from proofs.reading.notions import Region
from proofs.reading.printed import Printed
from proofs.reading.relations import relate
from proofs.reading.values import Vector

n, k = reals("n k")
BOUND = term(derived("subharmonic_bound"))  # the real number that K_max rounds


def threshold(count: int) -> Term:
    """The restitution from which on the fastest table can keep up flights of so many periods."""
    from sympy import Integer

    return term(derived("restitution_threshold", Integer(count)))


def allows_just(printed: Printed, rounded: Callable[[Term], Formula]) -> Assertion:
    """The print, with K_max rounded in this way, says that there is an orbit for K and none for K +
    1.
    """
    says = printed.formula(PAPER.extended({"K_{max}": n}))
    return Assertion(
        (
            always_integer(iff(B1(b), K <= BOUND), given=[comes_back(K)], label="orbits"),
            always_integer(
                iff(says, (K <= BOUND) & (BOUND < K + 1)), given=[rounded(BOUND)], label="longest"
            ),
        )
    )


@claim("eq-19", "3.5.2", "(19)", printed=r"K \le K_{max} < K + 1", parameters=("alpha", "K"))
def periods_up_to_k(printed: Printed) -> Readings:
    """There are orbits for the periods up to K, and for no longer one, exactly if the rounded bound
    lies between K and K + 1.
    """
    return Readings(
        {"floor": allows_just(printed, floor_of), "ceiling": allows_just(printed, ceiling_of)}
    )


@claim("eq-20", "3.5.2", "(20)", printed=r"\frac{K-1}{K+1} \le \alpha < \frac{K}{K+2}")
def restitution_for_periods_up_to_k(printed: Printed) -> list[Statement]:
    """For these restitutions K is the longest period: the left end is where the orbit for K begins
    to exist, the right that for K + 1.
    """
    from_k_on, to_next = (
        relate(left, sign, right) for left, sign, right in relations_of(printed, PAPER, 2)
    )
    return [
        always_integer(
            iff(from_k_on & to_next, (K <= n) & (n < K + 1)),
            given=[floor_of(BOUND)],
            label="inserted",
        ),
        always_integer(iff(B1(b), from_k_on), given=[comes_back(K)], label="orbit-for-K"),
        always_integer(iff(~B1(b), to_next), given=[comes_back(K + 1)], label="none-for-the-next"),
    ]


@claim(
    "s3.5.2-set", "3.5.2", "line 410", printed=r"\{ e_k \mid k \le K \}", parameters=("alpha", "K")
)
def periods_that_exist(printed: Printed) -> Statement:
    """For the restitutions of (20), the orbits with one impact are those whose period is not above
    K.
    """
    meant = Environment({**NAMES, "k": k}, points={"e_k": ("k",)})
    held = Meaning(meant).of(printed.tree)
    if not isinstance(held, Region):
        raise ClaimError("a set of fixed points is expected here")
    return always_integer(
        iff(B1(b), held(Vector((n,)))),
        given=[n >= 1, comes_back(n)],
        in_range=[*from_threshold_on(K), ~conjunction(from_threshold_on(K + 1)[2:])],
    )


@claim("eq-21", "3.5.2", "(21)", printed=r"0 < \alpha < \frac{1}{3}")
def restitution_for_one_fixed_point(printed: Printed) -> list[Statement]:
    """These are the restitutions for which no period but one has an orbit with one impact."""
    single = printed.formula(PAPER)
    return [
        always_integer(
            ~B1(b), given=[K >= 2, comes_back(K)], in_range=[single], label="no-longer-period"
        ),
        always(single, given=[comes_back(2), ~B1(b)], label="only-these"),
    ]


@claim("s3.5.2-note8", "4.1", "note 8", printed=r"\alpha = 0")
def no_restitution_is_left_out(printed: Printed) -> Statement:
    """For K = 1, (20) also admits that value of the restitution, and (21) is (20) without it."""
    zero = printed.formula(PAPER)
    admitted = (threshold(1) <= alpha) & (alpha < threshold(2))
    return always(iff(admitted & ~zero, (alpha > 0) & (alpha < threshold(2))), in_range=[])
