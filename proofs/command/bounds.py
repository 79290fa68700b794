"""`juggleproof explain theorem --bounds`: the paper's bounds and ours, and where orbits violate
what is printed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from proofs.command.numbers import shown
from proofs.theorem.comparison import PHASES, Entry, IntoRegion, energies, into_core, into_region
from proofs.theorem.definition import SPEED
from proofs.theorem.quantities import attracted

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
        Callable[[IntoRegion], tuple[Fraction | int, Entry]],
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
) -> list[tuple[IntoRegion, Fraction | int, Entry]]:
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
    told = " ".join(f"{shown(time, 4):>11} {_ratio(time, row.time.time):>9}" for time in times)
    print(
        f"  {str(row.alpha):>7} {str(row.u):>7} | {row.impacts.impacts:>7} {brackets} |"
        f" {shown(row.time.time, 4):>8} {told} | {row.sample.sample:>8} {row.ours:>8}"
        f" {_ratio(row.ours, row.sample.sample):>7}"
    )


def _reading(rows: Sequence[IntoRegion], measure: str, loss: str, rounding: str) -> None:
    found = violations(rows, measure, loss, rounding)
    where, claims = false_for(measure, loss, rounding)
    print(f"  {measure}, {loss} Delta E_sup, {rounding}: false for {where} ({claims})")
    if found:
        row, actual, entry = found[0]
        allowed = MEASURES[measure][0](row, loss, rounding)
        print(
            f"      at alpha = {row.alpha} from x = {entry.start.x}, w = {entry.start.w}:"
            f" {shown(actual, 4)}, where {shown(allowed, 4)} is allowed; in the table for alpha ="
            f" {', '.join(dict.fromkeys(str(one.alpha) for one, _, _ in found))}"
        )


def _core_line(row: IntoRegion) -> None:
    core = into_core(row.alpha, row.u)
    print(
        f"  {str(row.alpha):>7} {str(row.u):>7} | {core.worst:>8} | {core.by_rank:>8}"
        f" {_ratio(core.by_rank, core.worst):>7} | {core.sharper:>8}"
        f" {_ratio(core.sharper, core.worst):>7}"
    )
