"""For 1/2 < alpha < a_c = 0.7286.., where an orbit of 12 unequal flights begins, every orbit tends
to the orbit of some e_K, but for few states where a range of some e_K begins.

Impacts are sorted by the length of the flight that follows. No state has certain words of such
lengths; every long word holds one of these, or a run of flights of K periods that is long enough
for all later flights to last K periods too, or repeats the 12 flights, which no state does for ever
below a_c.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from juggleproof.papers.derivations import tidied
from juggleproof.papers.derived import derived_by
from juggleproof.proofs.paper.names import alpha, always, at, claim, derived_vector, w
from juggleproof.proofs.restitution.impacts import RADIUS, WEIGHTS
from juggleproof.proofs.restitution.unequal import (
    ALONG,
    BORN,
    is_below_the_table,
    on_the_orbit,
    turned,
)
from juggleproof.proofs.theorem.definition import (
    AT_IMPACTS,
    IMPACT,
    NORMAL,
    PIECES,
    SPACE,
    SPEED,
    Contraction,
    Descent,
    contracts,
    descends,
    spaced,
    the_map,
    u,
)
from juggleproof.proofs.theorem.orbits import strikes
from juggleproof.proofs.theorem.stability import is_none_of
from juggleproof.reading.values import Vector
from juggleproof.statements.language import (
    AnyStatement,
    Formula,
    MapRule,
    conjunction,
    equal,
    iff,
    term,
)

STRUCK, FLOWN = PIECES


@dataclass(frozen=True)
class Restitutions:
    """A range of alpha, with what is chosen to prove of it that every orbit tends to some e_K."""

    least: Fraction  # from one of the (K - 1)/(K + 1), up to the next at most; or one of them twice
    most: Fraction
    fast: Fraction  # the closing speed from which on impacts are led on by f
    factor: int  # of the root of the energy, in the rank
    runs: str  # flights of K for so long are followed by flights of K for ever
    never: str  # lengths of flights that follow one another from no state
    # flights that bring back a point below the table: each time they are repeated, from an impact,
    # the state comes closer to it
    repeated: tuple[int, ...] = ()

    @property
    def longest(self) -> int:
        """The periods that a flight after a slower impact lasts at most."""
        return len(self.runs.split()) + 1

    def of_alpha(self) -> Formula:
        """The range, and what is divided by."""
        p, q = self.least.as_integer_ratio(), self.most.as_integer_ratio()
        between = (p[1] * alpha > p[0]) & (q[1] * alpha < q[0])
        one = equal(p[1] * alpha, p[0])
        return (one if p == q else between) & (1 - alpha > 0) & (1 + alpha > 0)

    def until_it_returns(self) -> Formula:
        """The part of the range where the point that the repeated flights bring back is below the
        table.
        """
        if not self.repeated:
            return self.of_alpha()
        return self.of_alpha() & is_below_the_table(self.repeated)

    def repeats(self) -> list[tuple[str, str]]:
        """The repeated flights, with a rank that falls by 1 each time, and is not below 0 at a slow
        impact: the sum of the heights to come, over the depth.
        """
        if not self.repeated:
            return []
        rank = derived_by(str, f"{ALONG}.rank_of_repeats", self.repeated, self.fast)
        return [("rank", rank), ("word", spaced(self.repeated))]

    def exceptions(self) -> tuple[Vector, ...]:
        """The orbit of the e_K whose range begins here, and what flies to it."""
        K = self.longest
        begins = self.least == self.most == Fraction(K - 1, K + 1)
        return tuple(Vector((j * (K - j), K + 1 - 2 * j)) for j in range(K + 1)) if begins else ()


def flown(*periods: int) -> Vector:
    """The impact after flights of this number of periods."""
    found: Vector = derived_vector("normal_impact_after", periods)
    return found


def every_orbit_settles(claim_id: str) -> list[AnyStatement]:
    """The map f, and the map of impacts that makes several steps of it; the descent of that to slow
    impacts, a contraction for each e_K, the words that no state follows; and where all orbits tend.
    """
    chosen = RANGES[claim_id]
    slow = IMPACT & (w < chosen.fast)
    of_alpha, settling = chosen.of_alpha(), chosen.until_it_returns()
    space = SPACE & is_none_of(*chosen.exceptions()) if chosen.exceptions() else SPACE

    def flies(*periods: int) -> Formula:
        """After a slow impact each flight lasts this number of periods."""
        parts = [slow]
        for count, last in enumerate(periods, 1):
            after = flown(*periods[:count])
            parts += [term(after.entries[0]) >= 0] if last > 1 else []
            parts += [strikes(after)] if last < chosen.longest else []
        return conjunction(parts)

    flights = tuple((flies(K), flown(K)) for K in range(1, chosen.longest + 1))
    pieces = (*flights, (IMPACT & (w >= chosen.fast), STRUCK[1]), FLOWN)
    setting = replace(NORMAL, space=space, pieces=pieces)
    here, runs = f"{claim_id}/impacts", chosen.runs.split()
    # none but fast impacts are followed by a flight of the longest kind
    shorter = slow & strikes(flown(chosen.longest - 1))
    descent = Descent(chosen.factor * u + (1 - w) / 2, (slow, shorter), (SPEED,))
    fast, on_high = chosen.longest + 1, chosen.longest + 2
    words = [*chosen.never.split(), *map(str, (chosen.longest, fast, on_high))]
    return [
        the_map("map", replace(NORMAL, space=space), of_alpha),
        the_map("impacts", setting, of_alpha),
        descends("descends", here, setting, settling, descent, AT_IMPACTS, fast),
        *(
            contracts(
                f"e-{run[0]}",
                here,
                replace(setting, fixed=tidied("normal_impact_fixed_point", K=int(run[0]))),
                of_alpha,
                closer_to(int(run[0]), flies(*map(int, run))),
            )
            for run in runs
        ),
        MapRule(
            "settles",
            (
                ("descent", f"{claim_id}/descends"),
                *(("never", spaced(word)) for word in words),
                *chosen.repeats(),
                *(
                    line
                    for run in runs
                    for line in (("contraction", f"{claim_id}/e-{run[0]}"), ("word", spaced(run)))
                ),
            ),
        ),
        MapRule(
            "returns",
            (
                ("map", f"{claim_id}/map"),
                ("settling", f"{claim_id}/settles"),
                *(("word", spaced("1" + "2" * (K - 1))) for K in range(1, fast)),
                *(("word", "1"), ("word", "2")),
            ),
        ),
    ]


def closer_to(K: int, on: Formula) -> Contraction:
    """T_K brings these states closer to the impact of e_K."""
    wide, high, radius = (at(one, {"K": K}) for one in (*WEIGHTS, RADIUS))
    return Contraction(on, (wide, high), (1 + alpha) / 2, radius, term(100))


# The runs and the words were found by `python -m juggleproof.benchmarks.words`.
RANGES = {
    "restitution-to-three-fifths": Restitutions(
        Fraction(1, 2),
        Fraction(3, 5),
        Fraction(13, 2),
        24,
        "111 2222 3333",
        "13 23 212 2112",
    ),
    "restitution-three-fifths": Restitutions(
        Fraction(3, 5),
        Fraction(3, 5),
        Fraction(13, 2),
        24,
        "111 2222 3333",
        "13 23 212 2112",
    ),
    "restitution-to-two-thirds": Restitutions(
        Fraction(3, 5),
        Fraction(2, 3),
        Fraction(7),
        24,
        "111 2222 3333 4444",
        "13 14 23 24 34 121 212 12221 21122112",
    ),
    "restitution-two-thirds": Restitutions(
        Fraction(2, 3),
        Fraction(2, 3),
        Fraction(7),
        24,
        "111 2222 3333 4444",
        "13 14 24 34 121 212 231 232 323 331 3322 12221 332112 21122112",
    ),
    "restitution-to-five-sevenths": Restitutions(
        Fraction(2, 3),
        Fraction(5, 7),
        Fraction(8),
        40,
        "111 2222 3333 4444 5555",
        "13 14 15 24 25 34 35 45 121 212 231 232 323 331 1223 2223 2333 3223 12221 123322"
        " 3321122 12211221122 332112332112",
    ),
    "restitution-five-sevenths": Restitutions(
        Fraction(5, 7),
        Fraction(5, 7),
        Fraction(8),
        40,
        "111 2222 3333 4444 5555",
        "13 14 15 24 25 34 35 45 121 212 231 232 323 331 1223 2223 2333 3223 12221 123322"
        " 3321122 211221122 332112332112",
    ),
    "restitution-beyond-five-sevenths": Restitutions(
        Fraction(5, 7),
        Fraction(7287, 10000),
        Fraction(8),
        48,
        "11111 22222 333333 444444 555555 666666",
        "13 14 15 16 24 25 26 34 35 36 45 46 56 121 212 231 232 323 331 2223 2333 3221 11122"
        " 21112 211222 332222 3222111 3321122 32233223 33211112 211221122 332221122 3321123322"
        " 332112332112 12332221123322",
        turned(BORN),
    ),
}


@claim("restitution-to-three-fifths", "restitution", "1/2 < alpha < 3/5", parameters=())
def every_orbit_tends_to_one_of_three() -> list[AnyStatement]:
    """For 1/2 < alpha < 3/5 every orbit of H tends to the orbit of one of e_1, e_2, e_3; all of
    these are stable.
    """
    return every_orbit_settles("restitution-to-three-fifths")


@claim("restitution-three-fifths", "restitution", "alpha = 3/5", parameters=())
def every_orbit_but_five_tends_to_one_of_three() -> list[AnyStatement]:
    """At alpha = 3/5 every orbit of H tends to the orbit of one of e_1, e_2, e_3, and these are
    stable, but those of five states: the orbit of e_4, and what flies to it.
    """
    return every_orbit_settles("restitution-three-fifths")


@claim("restitution-to-two-thirds", "restitution", "3/5 < alpha < 2/3", parameters=())
def every_orbit_tends_to_one_of_four() -> list[AnyStatement]:
    """For 3/5 < alpha < 2/3 every orbit of H tends to the orbit of one of e_1, .., e_4; all of
    these are stable.
    """
    return every_orbit_settles("restitution-to-two-thirds")


@claim("restitution-two-thirds", "restitution", "alpha = 2/3", parameters=())
def every_orbit_but_six_tends_to_one_of_four() -> list[AnyStatement]:
    """At alpha = 2/3 every orbit of H tends to the orbit of one of e_1, .., e_4, and these are
    stable, but those of six states: the orbit of e_5, and what flies to it.
    """
    return every_orbit_settles("restitution-two-thirds")


@claim("restitution-to-five-sevenths", "restitution", "2/3 < alpha < 5/7", parameters=())
def every_orbit_tends_to_one_of_five() -> list[AnyStatement]:
    """For 2/3 < alpha < 5/7 every orbit of H tends to the orbit of one of e_1, .., e_5; all of
    these are stable.
    """
    return every_orbit_settles("restitution-to-five-sevenths")


@claim("restitution-five-sevenths", "restitution", "alpha = 5/7", parameters=())
def every_orbit_but_seven_tends_to_one_of_five() -> list[AnyStatement]:
    """At alpha = 5/7 every orbit of H tends to the orbit of one of e_1, .., e_5, and these are
    stable, but those of seven states: the orbit of e_6, and what flies to it.
    """
    return every_orbit_settles("restitution-five-sevenths")


@claim("restitution-beyond-five-sevenths", "restitution", "5/7 < alpha < a_c", parameters=())
def every_orbit_tends_to_one_of_six() -> list[AnyStatement]:
    """For alpha between 5/7 and an algebraic number, 0.72863.., every orbit of H tends to the orbit
    of one of e_1, .., e_6; all of these are stable.

    From 5/7 to 7287/10000 alpha is below that number just where the impact after 8 flights of the
    orbit in restitution-unequal would be below the table, so that it exists from there on.
    """
    chosen = RANGES["restitution-beyond-five-sevenths"]
    below = term(on_the_orbit(BORN).entries[0]) < 0
    return [
        # first, as the range that is told is that of the last map rule
        always(
            iff(chosen.until_it_returns(), below),
            in_range=[chosen.of_alpha()],
            label="until-another-orbit-begins",
        ),
        *every_orbit_settles("restitution-beyond-five-sevenths"),
    ]
