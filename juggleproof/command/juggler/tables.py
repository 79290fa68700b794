"""The tables that `juggleproof simulate juggler` prints."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import islice

from rich.console import Console
from sympy import Expr, factor

from juggleproof.reports.tables import DIGITS, draw, shown
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.compiled_map import Number, counted
from juggleproof.scenes.juggler.orbits import MOST_TIMES, Error, OrbitRow, Orbits, Value, heights
from juggleproof.scenes.juggler.periodic import (
    attracts_for,
    exists_for,
    family,
    longest_flight,
    orbit_of,
    search_words,
)
from juggleproof.scenes.juggler.starts import Scene, axis
from juggleproof.scenes.juggler.tables import (
    CASES,
    NAMES,
    UNITS,
    ArithmeticFinding,
    as_text,
    finding,
    in_units,
)

MOST_ROWS, SHORT_BITS, LONG_TEXT = 40, 4000, 100
ACCURACY = {
    "exact": "exact",
    "enclosed": "enclosed: the true state differs by the error at most",
    "mp": "mp: rounded to {} digits, without a bound of the error",
    "fast": "fast: the true state differs from the floats by the error at most",
}
MARKS = {
    "": "not at its end",
    "reached": "",
    "trap": "in the trap",
    "undecided": "branch undecided",
    "too long": "numbers too long",
}


def _draw(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    draw(heads, rows, Console(highlight=False))


def rounded(value: Value) -> str:
    """A number, rounded to 12 digits where it is longer."""
    if (
        isinstance(value, Fraction)
        and max(value.numerator.bit_length(), value.denominator.bit_length()) <= SHORT_BITS
    ):
        return shown(value)
    if isinstance(value, float):
        return f"{value:.{DIGITS}g}"
    return (
        as_text(value, None, DIGITS)[0]
        if not hasattr(value, "context")
        else str(value.context.nstr(value, DIGITS))
    )


def _number(value: Value) -> str:
    """The text of a number: an exact one as a fraction, or rounded behind a ~ where it is long."""
    if not isinstance(value, Fraction):
        return rounded(value)
    bits = max(value.numerator.bit_length(), value.denominator.bit_length())
    text = str(value) if bits < 4 * LONG_TEXT else ""
    return text if 0 < len(text) <= LONG_TEXT else f"~{rounded(value)}"


def _print_rounded(rows: Sequence[Sequence[str]]) -> None:
    if any(cell.startswith("~") for row in rows for cell in row):
        print(f"~: rounded to {DIGITS} digits from an exact number of more than {LONG_TEXT} signs")


def rounded_error(error: Error | None) -> str:
    """A bound on an error, rounded up to two digits."""
    if error is None:
        return "unknown"
    if isinstance(error, float):
        return f"{error * 1.06:.1e}" if error else "0"
    if error == 0:
        return "0"
    power = len(str(error.numerator)) - len(str(error.denominator))
    while error > Fraction(10) ** power:
        power += 1
    while error <= Fraction(10) ** (power - 1):
        power -= 1
    return f"1e{power}"


def orbits(run: Orbits, units: str) -> None:
    """Prints the table of all kept states, or of the last state of each orbit: its first rows, and
    the first undecided orbits.
    """
    setting = run.scene
    print(
        f"alpha = {_short(setting.alpha)}, {len(run)} start{'s' * (len(run) != 1)},"
        f" {run.goal.steps} {run.goal.unit}{' or until the trap' * run.goal.until_trap};"
        f" {ACCURACY[run.arithmetic].format(run.precision)}"
    )
    names = NAMES[units]
    heads = ("start", "periods", "impacts", names[0], names[1], "error", "")
    rows: list[tuple[str, ...]] = []
    for index in range(min(run.followed, MOST_ROWS)):
        kept = run.history(index) if run.keep else [run.row(index)]
        rows += [_line(in_units(run, row, units), not run.keep) for row in kept]
        if len(rows) >= MOST_ROWS:
            break
    _draw(heads, rows[:MOST_ROWS])
    _print_rounded(rows[:MOST_ROWS])
    if len(rows) > MOST_ROWS or run.followed > MOST_ROWS:
        print(f"the first {MOST_ROWS} rows; --output F.csv or F.npz writes all")
    _print_ends(run)


def _line(row: OrbitRow, last: bool) -> tuple[str, ...]:
    error = "unknown" if row.error is None else rounded_error(max(row.error))
    counts = ["" if count < 0 else shown(count) for count in (row.periods, row.impacts)]
    return (
        str(row.start),
        *counts,
        _number(row.x),
        _number(row.w),
        error,
        MARKS[row.end] if last else "",
    )


def _print_ends(orbits: Orbits) -> None:
    counts = orbits.counts()
    if len(orbits) > 1:
        print(", ".join(f"{count} {name or 'not at the end'}" for name, count in counts.items()))
    undecided = counts.get("undecided", 0)
    if undecided:
        first = ", ".join(
            f"{index} (period {shown(period)})"
            for index, period in islice(orbits.each_undecided(), 10)
        )
        more = f" and {undecided - 10} more" if undecided > 10 else ""
        print(
            f"undecided: {first}{more}; whether the table strikes there is not known from these"
            " numbers; --arithmetic enclosed or exact tells"
        )
    edges = sum(track.edges for track in orbits.tracks)
    if edges:
        print(
            f"on x = w: {edges} state{'s' * (edges != 1)}, exactly"
            if orbits.arithmetic != "mp"
            else f"on x = w: {edges} as rounded"
        )


def times(setting: Scene, low: Number, high: Number, count: int) -> int:
    """Prints the heights of ball and table at times, in the units of r and g; raises SceneError for
    several starts.
    """
    if setting.starts.count > 1:
        raise SceneError(f"times of {setting.starts.count} starts; give one start")
    samples = heights(
        setting,
        list(axis(low, high, counted(count, "the number of times", 1, MOST_TIMES), "times")),
    )
    print(f"alpha = {_short(setting.alpha)}; exact heights")
    rows = [tuple(map(_number, one)) for one in samples]
    _draw(("time", "ball", "table"), rows)
    _print_rounded(rows)
    return 0


def words(alpha: Fraction, longest: int, flight: int | None) -> int:
    """Prints all periodic orbits with at most `longest` impacts."""
    cycles = search_words(alpha, longest, flight)
    most = longest_flight(alpha) if flight is None else min(flight, longest_flight(alpha))
    print(
        f"alpha = {_short(alpha)}: every periodic orbit with at most {longest} impacts and flights"
        f" of at most {most} periods"
    )
    if most == longest_flight(alpha):
        print(
            "no periodic orbit has a longer flight: (1 + alpha)/(1 - alpha) is the limit, by"
            " theorem-flights"
        )
    rows = []
    for one in cycles:
        name = f"e_{one.word[0]}" if len(one.word) == 1 else ""
        verdict = (
            "near states tend to it" if one.attracts else "on x = w: the affine map does not tell"
        )
        rows.append(
            (
                ",".join(map(str, one.word)),
                name,
                str(sum(one.word)),
                *map(_number, one.impacts[0]),
                _number(one.radius),
                verdict,
            )
        )
    _draw(("word", "", "periods", "x at impact", "w at impact", "spectral radius", ""), rows)
    _print_rounded(rows)
    return 0


def word(wanted: tuple[int, ...], alpha: Fraction | None = None) -> int:
    """Prints the orbit of a word, at this alpha or as formulas in alpha, and the alphas for which
    it exists and attracts.
    """
    exists, attracts = exists_for(wanted), attracts_for(wanted)
    at = orbit_of(wanted, alpha) if alpha is not None else None
    print(
        f"word {','.join(map(str, wanted))}: {sum(wanted)} periods, impacts {len(wanted)}, spectral"
        f" radius alpha^{len(wanted)}"
    )
    print("exists for " + ("; ".join(map(str, exists)) if exists else "no alpha in (0, 1)"))
    if attracts:
        print(f"near states tend to it for {'; '.join(map(str, attracts))}")
    if exists != attracts:
        print(
            "for the other alpha of these a state of it lies on x = w, where the affine map does"
            " not tell whether near states tend to it"
        )
    if alpha is None and exists:
        _draw(
            ("impact", "x", "w"),
            [
                (str(k + 1), *(_formula(part) for part in place))
                for k, place in enumerate(family(wanted))
            ],
        )
    elif alpha is not None and at is None:
        print(f"at alpha = {_short(alpha)} no orbit has this word")
    elif at is not None:
        print(
            f"at alpha = {_short(at.alpha)}, exactly;"
            f" {'near states tend to it' if at.attracts else 'a state lies on x = w'}"
        )
        rows = [(str(k + 1), *map(_number, place)) for k, place in enumerate(at.impacts)]
        _draw(("impact", "x", "w"), rows)
        _print_rounded(rows)
    return 0


def _formula(expression: Expr) -> str:
    """The text of a rational function of alpha."""
    text = str(factor(expression)).replace("**", "^")
    return text if len(text) <= LONG_TEXT else "a long formula; --alpha gives the numbers"


def hard_cases() -> int:
    """Prints the hard cases: states by floats, true states, and states by bounded arithmetics."""
    print(
        "float64: plain floats, period by period; exact: the truth; fast: float64 with a bound"
        " of its error; enclosed: balls"
    )
    rows = []
    for case in CASES:
        rows.append(_finding(finding(case)))
    _draw(("case", "alpha", "start x, w", "steps", "float64", "exact", "fast", "enclosed"), rows)
    return 0


def _pair(x: Value, w: Value) -> str:
    return f"{_short(x)}, {_short(w)}"


def _short(value: Value) -> str:
    if (
        isinstance(value, Fraction)
        and value.numerator.bit_length() + value.denominator.bit_length() < 24
    ):
        return str(value)
    if (
        isinstance(value, Fraction)
        and max(value.numerator.bit_length(), value.denominator.bit_length()) <= SHORT_BITS
    ):
        return shown(value, 6)
    return f"{value:.6g}" if isinstance(value, float) else as_text(value, None, 6)[0]


def _finding(one: ArithmeticFinding) -> tuple[str, ...]:
    case = one.case
    floats = _pair(*one.floats) + (
        f"; WRONG BRANCH at period {one.wrong_at}" if one.wrong_at is not None else ""
    )
    in_rationals = (
        MARKS["too long"] + f" after {shown(one.exact.periods)} periods"
        if one.exact.end == "too long"
        else _pair(one.exact.x, one.exact.w)
    )
    fast = (
        f"undecided at period {shown(one.fast.periods)}"
        if one.fast.end == "undecided"
        else f"{_pair(one.fast.x, one.fast.w)} +/- {rounded_error(max(one.fast.error or (0.0,)))}"
    )
    balls = (
        f"{_pair(one.enclosed.x, one.enclosed.w)} +/-"
        f" {rounded_error(max(one.enclosed.error or (Fraction(0),)))}"
    )
    balls += f"; {one.edges} on x = w" if one.edges else ""
    steps = f"{shown(case.steps)} {'impacts' if case.impacts else 'periods'}"
    return (
        case.name,
        _short(case.alpha),
        _pair(case.x, case.w),
        steps,
        floats,
        in_rationals,
        fast,
        balls,
    )


__all__ = ["UNITS", "hard_cases", "orbits", "times", "word", "words"]
