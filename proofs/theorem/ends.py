"""Where stability ends: e_K at the least alpha for which it exists, and the energy that no orbit
exceeds.

At alpha = (K - 1)/(K + 1), K >= 2, the orbit of e_K meets the table just at a bounce, one period
before its impact.  However little the ball starts higher, it strikes a period early, and after K
periods is far from where it started: e_K comes back after K periods, and is not stable.
"""

from __future__ import annotations

from certificates.statements import AnyStatement
from certificates.terms import Formula, Term, equal, term
from proofs.claims import claim
from proofs.paper.vocabulary import B1, B2, alpha, at, b, derived, energy, equals, f1, f2
from proofs.paper.vocabulary import always as always_real
from proofs.reading.values import Vector
from proofs.theorem.definition import IMPACT
from proofs.theorem.flights import K, always, d, n, next_impact

AT_THE_END = [alpha > 0, alpha < 1, equal(alpha * (K + 1), K - 1), K >= 2]
E_K = Vector((0, K + 1))  # at the impact
HIGHER = Vector((d, K + 1))


def strikes(state: Vector) -> Formula:
    """The state is in B1."""
    found: Formula = at(IMPACT, {"x": term(state.entries[0]), "w": term(state.entries[1])})
    return found


def after_impact(periods: Term, start: Vector) -> Vector:
    """The state after an impact and so many periods of flight."""
    return next_impact(periods + 1, start)


@claim("theorem-ends", "theorem", "alpha = (K - 1)/(K + 1)", parameters=())
def fixed_points_are_not_stable_where_they_begin() -> list[AnyStatement]:
    """At alpha = (K - 1)/(K + 1), K >= 2, e_K comes back after K periods, and states however near
    it are far from it after K periods.
    """
    struck = after_impact(K - 2, HIGHER)
    back = Vector(
        tuple(
            at(entry, {"x": term(struck.entries[0]), "w": term(struck.entries[1])})
            for entry in derived("normal_f1").entries
        )
    )
    raised = [d > 0, d < 1]
    return [
        always(equals(derived("normal_impact_fixed_point"), E_K), in_range=AT_THE_END, label="e_K"),
        always(
            strikes(E_K) & equals(next_impact(K, E_K), E_K), in_range=AT_THE_END, label="comes-back"
        ),
        always(
            ~strikes(after_impact(n, E_K)),
            given=[n >= 0, n <= K - 2],
            in_range=AT_THE_END,
            label="in-flight-between",
        ),
        always(strikes(HIGHER), given=raised, in_range=AT_THE_END, label="higher-strikes"),
        always(
            ~strikes(after_impact(n, HIGHER)),
            given=[*raised, n >= 0, n <= K - 3],
            in_range=AT_THE_END,
            label="higher-flies",
        ),
        always(strikes(struck), given=raised, in_range=AT_THE_END, label="strikes-a-period-early"),
        always(
            term(back.entries[1]) <= K, given=raised, in_range=AT_THE_END, label="is-far-after-K"
        ),
    ]


@claim("theorem-E-max", "theorem", "after (22)")
def orbits_of_little_energy_keep_to_it() -> list[AnyStatement]:
    """The states of energy at most E_max are mapped into themselves, for every 0 < alpha < 1."""
    little = derived("E_max")
    return [
        always_real(
            energy(f1(b)) <= little, given=[B1(b), energy(b) <= little], label="with-impact"
        ),
        always_real(
            energy(f2(b)) <= little, given=[B2(b), energy(b) <= little], label="without-impact"
        ),
    ]
