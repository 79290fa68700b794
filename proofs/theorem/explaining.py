"""`juggleproof explain theorem`: the paper's bounds and ours, and one state with its orbit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from juggleproof.judging.claims import claims_in
from juggleproof.judging.conclusions import ATTRACTS, STABLE
from juggleproof.judging.run import by_id, judge_some
from juggleproof.proofs.paper.names import derived_vector
from juggleproof.proofs.theorem import quantities, stability
from juggleproof.proofs.theorem.definition import (
    FIXED,
    NEARBY,
    OTHER,
    PHYSICAL,
    SPEED,
    TO_THE_POINT,
    TRAP,
    holds_at,
    value_of,
)
from juggleproof.proofs.theorem.orbits import (
    MAX_BITS,
    MAX_IMPACTS,
    ExactState,
    OrbitMove,
    a_state,
    moves,
)
from juggleproof.proofs.theorem.quantities import (
    PHASES,
    IntoRegion,
    RegionEntry,
    attracted,
    energies,
    into_core,
    into_region,
)
from juggleproof.reports.tables import DIGITS, components, exact, shown
from juggleproof.scenes.juggler.exact import impact_power as in_the_trap
from juggleproof.statements.language import ClaimError, term
from juggleproof.statements.store import DEFAULT

# -------------------------------------------------------------------------------------------------
# `juggleproof explain theorem --bounds`: the paper's bounds and ours, and where orbits violate
# what is printed.

ALPHAS = tuple(
    Fraction(text)
    for text in ("1/20", "1/10", "1/5", "3/10", "33/100", "7/20", "2/5", "1/2", "9/10")
)
ROUNDINGS, LOSSES = ("floor", "ceiling"), ("derived", "printed")
NEVER, ALWAYS, LARGE = (
    "no alpha in (0, 1)",
    "every alpha in (0, 1)",
    "every alpha in (c1, 1), 0.364 < c1 < 0.365",
)


def counted(row: IntoRegion, loss: str, rounding: str) -> int:
    """The bracket of (26) in this reading."""
    return (row.true if loss == "derived" else row.printed)[ROUNDINGS.index(rounding)]


def time_allowed(row: IntoRegion, loss: str, rounding: str) -> Fraction:
    """t_R of (26) in periods, in this reading."""
    return counted(row, loss, rounding) * row.flight


MEASURES: dict[
    str,
    tuple[
        Callable[[IntoRegion, str, str], Fraction | int],
        Callable[[IntoRegion], tuple[Fraction | int, RegionEntry]],
    ],
] = {
    "impacts": (counted, lambda row: (row.impacts.impacts, row.impacts)),
    "continuous time": (time_allowed, lambda row: (row.time.time, row.time)),
    "sampled time": (time_allowed, lambda row: (row.sample.sample, row.sample)),
}


def false_for(measure: str, loss: str, rounding: str) -> tuple[str, str]:
    """For which alpha there is a state that violates the reading, and the claims that say so."""
    if rounding == "floor":
        return (
            ALWAYS,
            (
                "s4.2-count (floor)"
                if loss == "derived"
                else "theorem-count/losses: the bracket is 0 just outside R"
            ),
        )
    if measure == "sampled time":
        return ALWAYS, "theorem-count/flight"
    if loss == "derived":
        return NEVER, "s4.2-count (ceiling)" if measure == "impacts" else "eq-26 (ceiling)"
    return LARGE, "theorem-count: one-is-not-enough, enough-by-alpha"


def violations(
    rows: Sequence[IntoRegion], measure: str, loss: str, rounding: str
) -> list[tuple[IntoRegion, Fraction | int, RegionEntry]]:
    """The rows whose worst orbit takes more than the reading allows."""
    allowed, worst = MEASURES[measure]
    return [(row, *worst(row)) for row in rows if worst(row)[0] > allowed(row, loss, rounding)]


def explain_bounds(alphas: Sequence[Fraction] = ALPHAS) -> int:
    """Prints both tables, and the violated readings each with an exact state."""
    rows = [into_region(alpha, u) for alpha in alphas for u in energies(alpha)]
    print(
        f"states      for each alpha and u, u^2 = {SPEED[1]} twice the energy in units of r^2: the"
        f" {PHASES} flights that end with"
    )
    print(
        f"            closing speed w = u - 1 + j/{PHASES // 2}, j = 1 .. {PHASES}, each from its"
        " first state; exact orbits, shown to 4 digits"
    )
    print(
        "impacts     that lead into R: the worst, and the bracket of (26), floor..ceiling, with"
        " Delta E_sup derived, and as printed in A.3.2"
    )
    print(
        "time        in periods until R is entered: the worst, t_R of (26) by the ceiling, u"
        " periods being tau_w of (25), and their ratio"
    )
    print(
        "samples     once a period, until R is entered: the worst, ours by theorem-region/enters,"
        " and their ratio"
    )
    print(
        f"  {'alpha':>7} {'u':>7} | {'impacts':>7} {'derived':>17} {'printed':>17} | {'time':>8}"
        f" {'t_R derived':>11} {'ratio':>9} {'t_R printed':>11} {'ratio':>9} | {'samples':>8}"
        f" {'ours':>8} {'ratio':>7}"
    )
    for row in rows:
        _region_line(row)
    print()
    print(
        "readings of the count and of (26): all alpha for which some state violates it, with the"
        " first exact state found in the table"
    )
    for measure in MEASURES:
        for loss in LOSSES:
            for rounding in ROUNDINGS:
                _reading(rows, measure, loss, rounding)
    print()
    print(
        "periods to within 1 of e_1 in the trap: the worst of the same states, by the rank of the"
        " theorem, and by theorem-sharper"
    )
    print(
        f"  {'alpha':>7} {'u':>7} | {'worst':>8} | {'theorem':>8} {'ratio':>7} | {'sharper':>8}"
        f" {'ratio':>7}"
    )
    for row in rows:
        if attracted(row.alpha):
            _core_line(row)
    return 0


def _ratio(bound: Fraction | int, actual: Fraction | int) -> str:
    return shown(Fraction(bound) / Fraction(actual), 4)


def _region_line(row: IntoRegion) -> None:
    brackets = " ".join(f"{f'{low}..{high}':>17}" for low, high in (row.true, row.printed))
    times = [time_allowed(row, loss, "ceiling") for loss in LOSSES]
    allowed = " ".join(f"{shown(time, 4):>11} {_ratio(time, row.time.time):>9}" for time in times)
    print(
        f"  {str(row.alpha):>7} {str(row.u):>7} | {row.impacts.impacts:>7} {brackets} |"
        f" {shown(row.time.time, 4):>8} {allowed} | {row.sample.sample:>8} {row.ours:>8}"
        f" {_ratio(row.ours, row.sample.sample):>7}"
    )


def _reading(rows: Sequence[IntoRegion], measure: str, loss: str, rounding: str) -> None:
    violating = violations(rows, measure, loss, rounding)
    where, claims = false_for(measure, loss, rounding)
    print(f"  {measure}, {loss} Delta E_sup, {rounding}: false for {where} ({claims})")
    if violating:
        row, actual, entry = violating[0]
        allowed = MEASURES[measure][0](row, loss, rounding)
        print(
            f"      at alpha = {row.alpha} from x = {entry.start.x}, w = {entry.start.w}:"
            f" {shown(actual, 4)}, where {shown(allowed, 4)} is allowed; in the table for alpha ="
            f" {', '.join(dict.fromkeys(str(one.alpha) for one, _, _ in violating))}"
        )


def _core_line(row: IntoRegion) -> None:
    core = into_core(row.alpha, row.u)
    print(
        f"  {str(row.alpha):>7} {str(row.u):>7} | {core.worst:>8} | {core.by_rank:>8}"
        f" {_ratio(core.by_rank, core.worst):>7} | {core.sharper:>8}"
        f" {_ratio(core.sharper, core.worst):>7}"
    )


# -------------------------------------------------------------------------------------------------
# `juggleproof explain theorem --alpha A --state S`: what is certified of one state, and its actual
# orbit beside it.

NORMAL_FORM, UNITS = ("x", "w"), ("beta", "v", "r", "g")
HEAD, TAIL, AFTER = 8, 3, 5  # moves shown of the start, before the end of interest, and after it
LATER = (0, 1, 2, 5, 10, 20)  # periods after the certified number
MAX_POWER = 3000  # the greatest power of alpha that is computed
FOLLOWED = 200  # impacts that an orbit is followed for where nothing is certified of it


def read_alpha(text: str) -> Fraction:
    """The restitution; raises ClaimError unless 0 < alpha < 1."""
    alpha = exact(text, "alpha")
    if not 0 < alpha < 1:
        raise ClaimError(
            f"alpha = {shown(alpha)} is not between 0 and 1; the restitution has 0 < alpha < 1"
        )
    return alpha


def read_state(alpha: Fraction, text: str) -> ExactState:
    """The state `x=..,w=..`, or `beta=..,v=..,r=..,g=..` in the paper's units, as a state of the
    normal form.  Raises ClaimError for other components, r <= 0, g <= 0 or beta < 0.
    """
    given = components(text, NORMAL_FORM + UNITS)
    names = UNITS if set(given) & set(UNITS) else NORMAL_FORM
    if set(given) != set(names):
        odd = next(
            (f"{name} is missing" for name in names if name not in given),
            f"{text[:40]} mixes two kinds of components",
        )
        raise ClaimError(f"{odd}; a state has {', '.join(names[:-1])} and {names[-1]}")
    if names == NORMAL_FORM:
        return a_state(alpha, given["x"], given["w"])
    for name in ("r", "g"):
        if given[name] <= 0:
            raise ClaimError(
                f"{name} = {shown(given[name])} is not positive; the launch speed r and gravity"
                " g are"
            )
    if not holds_at(PHYSICAL.space, given):
        raise ClaimError(f"beta = {shown(given['beta'])} is below the table; a state has beta >= 0")
    x, w = (value_of(term(entry), given) for entry in PHYSICAL.place.entries)
    return a_state(alpha, x, w)


def explain_state(alpha_text: str, state_text: str) -> int:
    """Prints what is certified of the state, and its orbit."""
    alpha = read_alpha(alpha_text)
    state = read_state(alpha, state_text)
    fixed = state.moved(FIXED)
    print(f"alpha       {alpha}" if len(str(alpha)) < 40 else f"alpha       about {shown(alpha)}")
    print(
        f"state       x = {shown(state.x)}, w = {shown(state.w)}, u^2 = {SPEED[1]} ="
        f" {shown(state.speed_squared)}, in units of r T and r"
    )
    print(f"e_1         x = {shown(fixed.x)}, w = {shown(fixed.w)}")
    print(f"numbers are exact and shown rounded to {DIGITS} digits")
    print()
    if quantities.converges(state):
        _certified(state)
        _orbit_to_the_trap(state)
    else:
        _not_certified(state)
    return 0


def _confirm(*ids: str) -> None:
    """Has the checker read the certificates of these claims.

    Raises ClaimError, one line, where one does not hold.
    """
    claims = by_id(claims_in([stability.__name__]))
    for one in judge_some([claims[name] for name in claims if name in ids], claims, DEFAULT):
        if one.verdict.word != "holds":
            raise ClaimError(f"{DEFAULT}: {one.id} is not certified; run `juggleproof certify`")


def _certified(state: ExactState) -> None:
    claim = "theorem" if quantities.attracted(state.alpha) else "theorem-one-third"
    _confirm(claim, "theorem-sharper", "theorem-closed-form")
    plain, sharper, best = (
        quantities.by_the_theorem(state),
        quantities.best_way(state),
        quantities.certified(state),
    )
    print("certified   trap: " + str(TRAP))
    print(
        f"  {claim}/descends: with the rank {TO_THE_POINT.rank}, in the trap after every N >="
        f" {shown(plain.trap)} periods,"
    )
    print(f"      and there within 1 of e_1 after every N >= {shown(plain.core)}")
    print(
        f"  theorem-sharper/descends with W = {shown(sharper.W)}: u <= W - 1 after"
        f" {shown(sharper.to_little)} periods, where that rank is at most"
    )
    print(
        f"      {shown(sharper.then)}: in the trap after every N >= {shown(sharper.bound.trap)}, "
        f"within 1 of e_1 after every N >= {shown(sharper.bound.core)}"
    )
    print(
        f"  {claim}/attracts: after N + k periods, N = {shown(best.core)}, within (2 alpha)^k of"
        " e_1; theorem-closed-form: within (1 + k) alpha^k"
    )
    print()


def _orbit_to_the_trap(state: ExactState) -> None:
    path = _until(state, MAX_IMPACTS, AFTER)
    entered = next((count for count, move in enumerate(path) if move.state.is_in(TRAP)), None)
    print("orbit")
    best = quantities.certified(state)
    _lines(path, entered, " (the trap)")
    if entered is None:
        print(
            f"  not followed further: {MAX_IMPACTS} impacts or {MAX_BITS} bits of a number are the"
            " limit; it enters the trap by the theorem"
        )
        return
    at = path[entered]
    print(
        f"  in the trap from n = {shown(at.start)} on; certified: n = {shown(best.trap)}"
        + (
            f", which is {shown(Fraction(best.trap, at.start), 4)} times as many"
            if at.start
            else ""
        )
    )
    print()
    _after_the_certified_number(at, best.core, state.alpha)


def _until(state: ExactState, impacts: int, more: int = 0) -> list[OrbitMove]:
    """The moves of the orbit up to the trap, and some more."""
    orbit: list[OrbitMove] = []
    left = -1
    for move in moves(state, impacts):
        orbit.append(move)
        left = left - 1 if left >= 0 else more if move.state.is_in(TRAP) else -1
        if left == 0:
            break
    return orbit


def _lines(orbit: Sequence[OrbitMove], turn: int | None, note: str = "") -> None:
    """The first moves, those around the turn, and a line for what is left out between them."""
    print(f"  {'n':>20} {'x':>20} {'w':>20} {'distance to e_1':>20}  then")
    last = len(orbit) if turn is None else turn
    gap = range(HEAD, last - TAIL)
    for count, move in enumerate(orbit):
        if count not in gap:
            _line(move, note if count == turn else "")
        elif count == gap.start:
            periods = orbit[gap.stop].start - move.start
            print(f"  {'...':>20} {len(gap)} moves, {shown(periods)} periods, are left out")


def _line(move: OrbitMove, note: str) -> None:
    then = (
        "impact"
        if move.impact
        else f"flight of {shown(move.periods)} period" + "s" * (move.periods > 1)
    )
    print(
        f"  {shown(move.start):>20} {shown(move.state.x):>20} {shown(move.state.w):>20}"
        f" {shown(move.state.distance):>20}  {then}{note}"
    )


def _after_the_certified_number(entry: OrbitMove, core: int, alpha: Fraction) -> None:
    """Actual distances after the certified number of periods, by the closed form from the entry in
    the trap on.
    """
    print(f"after N + k periods, N = {shown(core)}")
    print(f"  {'k':>4} {'actual distance':>20} {'(2 alpha)^k':>20} {'(1 + k) alpha^k':>20}")
    for k in LATER:
        passed = core + k - entry.start
        actual = (
            shown(later(entry.state, passed).distance) if passed <= MAX_POWER else "not computed"
        )
        print(
            f"  {k:>4} {actual:>20} {shown(quantities.by_the_rate(alpha, k)):>20}"
            f" {shown(quantities.by_the_closed_form(alpha, k)):>20}"
        )
    if core - entry.start + LATER[-1] > MAX_POWER:
        print(
            f"  where it is not computed, more than {MAX_POWER} periods have passed since the trap"
            " was entered"
        )


def later(state: ExactState, periods: int) -> ExactState:
    """The state of the trap this number of periods later, by the closed form."""
    return ExactState(state.alpha, *in_the_trap(state.alpha, state.x, state.w, periods))


def _not_certified(state: ExactState) -> None:
    _confirm("theorem", "theorem-one-third", "theorem-nearby")
    other = state.moved(OTHER)
    print(
        "certified   theorem/escapes: from alpha = 1/3 on e_1 is not globally attracting, for the"
        " orbit of e_2 has period 2:"
    )
    print(f"      x = {shown(other.x)}, w = {shown(other.w)}, an impact and a flight by turns")
    if quantities.is_exception(state):
        print(
            f"  theorem-one-third/attracts: at alpha = 1/3 e_1 is {STABLE} and {ATTRACTS} all"
            " states but three, and this is one of them"
        )
    radii = (shown(value_of(weight * NEARBY.radius, state.point())) for weight in NEARBY.weights)
    print(
        f"  theorem-nearby/contracts: e_1 is {STABLE}, and {ATTRACTS} all states within"
        f" {next(radii)} in x and {next(radii)} in w of it"
    )
    print()
    orbit, turn, end = follow(state)
    print("orbit")
    _lines(orbit, turn)
    print(f"  {end}")


def follow(state: ExactState) -> tuple[list[OrbitMove], int | None, str]:
    """The orbit until its end is known, where that is, and what is known of it."""
    path: list[OrbitMove] = []
    seen: dict[tuple[Fraction, Fraction], int] = {}
    for move in moves(state, FOLLOWED):
        here = move.state
        path.append(move)
        if quantities.is_nearby(here):
            return (
                path,
                len(path) - 1,
                (
                    f"tends to e_1: at n = {shown(move.start)} it is in the neighbourhood of"
                    " theorem-nearby"
                ),
            )
        if move.impact and (here.x, here.w) in seen:
            first = seen[here.x, here.w]
            return (
                path,
                len(path) - 1,
                (
                    f"does not tend to e_1: from n = {shown(first)} on it has period"
                    f" {shown(move.start - first)}" + _known_as(here)
                ),
            )
        if move.impact:
            seen[here.x, here.w] = move.start
    return (
        path,
        None,
        (
            f"not known: {FOLLOWED} impacts or {MAX_BITS} bits of a number are the limit, and it"
            " has neither come near e_1 nor met a periodic orbit"
        ),
    )


def _known_as(state: ExactState) -> str:
    """Which fixed point of the paper has its impact at this state."""
    K = state.w * (1 + state.alpha) / 2
    there = state.moved(derived_vector("normal_impact_fixed_point"), K=K)
    return (
        f", the orbit of e_{K}"
        if K.denominator == 1 and (there.x, there.w) == (state.x, state.w)
        else ""
    )
