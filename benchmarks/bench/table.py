"""The measurements, as text and as a plot: seconds and errors by method and size, the aims as
ratios of this run, and slopes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

from juggleproof.benchmarks.bench.answers import Answer, MeasuredAnswer
from juggleproof.benchmarks.bench.methods import Method
from juggleproof.benchmarks.figures import as_svg, new_figure
from juggleproof.reports.tables import plain

Time = Literal["cold", "seconds"]
AIM = 10
Results = Mapping[str, Mapping[Fraction, MeasuredAnswer]]  # by method and size
WORDS: dict[Time, str] = {"seconds": "warm", "cold": "cold"}


def by_method(measurements: Sequence[MeasuredAnswer]) -> dict[str, dict[Fraction, MeasuredAnswer]]:
    """The measurements, by method and size."""
    results: dict[str, dict[Fraction, MeasuredAnswer]] = {}
    for one in measurements:
        results.setdefault(one.method, {})[one.size] = one
    return results


def resized(one: MeasuredAnswer, size: Fraction, truth: Fraction) -> MeasuredAnswer:
    """The same measurement for work of this size; its answer becomes the distance from the truth,
    so that the truth is 0.
    """
    answer = one.answer
    if isinstance(answer, Answer):
        answer = Answer(
            answer.low - truth, None if answer.high is None else answer.high - truth, answer.note
        )
    return replace(one, size=size, answer=answer)


def power(value: Fraction) -> str:
    """A size as a short text.

    >>> sizes = Fraction(1, 10**9), Fraction(10**6), Fraction(3, 100), Fraction(7)
    >>> tuple(map(power, sizes))
    ('1e-9', '1e6', '3e-2', '7')
    """
    text = (
        f"{float(value):.3e}" if value < Fraction(1, 2) or value >= 1000 else f"{float(value):.3g}"
    )
    mantissa, _, exponent = text.partition("e")
    return mantissa if not exponent else f"{float(mantissa):g}e{int(exponent)}"


def number(value: float | None) -> str:
    """Two digits of a positive number.

    >>> number(0.00123), number(12.3), number(None)
    ('0.0012', '12', '-')
    """
    return (
        "-"
        if value is None
        else (
            f"{value:.0f}"
            if value >= 10
            else f"{value:.1e}".replace("e-0", "e-")
            if 0 < value < 1e-4
            else f"{value:.2g}"
        )
    )


def measured(
    methods: Sequence[Method], sizes: Sequence[Fraction], results: Results, truth: Fraction
) -> str:
    """Three lines for each method: its seconds warm and cold, and its error."""
    rows = [("method", "worth", "", *(power(size) for size in sizes))]
    for method in methods:
        own = results.get(method.name, {})
        for word in ("warm s", "cold s", "error"):
            cells = [_cell(own.get(size), word, truth) for size in sizes]
            first = word == "warm s"
            rows.append(
                (method.title if first else "", method.worth if first else "", word, *cells)
            )
    return plain(rows)


def _cell(one: MeasuredAnswer | None, word: str, truth: Fraction) -> str:
    if one is None:
        return "not asked" if word == "warm s" else ""
    if one.answer is None:
        return "gave up" if word == "warm s" else ""
    if word == "error":
        error = one.answer.error(truth)
        return number(float(error)) if error else "0"
    return number(one.warm if word == "warm s" else one.cold)


def wrong(methods: Sequence[Method], results: Results, truth: Fraction) -> list[str]:
    """One line for each enclosure that does not hold the closed form (for orbits: whose bound the
    exact state is beyond).
    """
    titles = {method.name: method.title for method in methods}
    return [
        f"WRONG: {titles[name]} at {power(size)} does not enclose the truth {float(truth):.12g}"
        for name, own in results.items()
        for size, one in own.items()
        if one.answer is not None and one.answer.wrong(truth)
    ]


def faults(methods: Sequence[Method], results: Results) -> list[str]:
    """One line for each method that gave up or failed: at which size, and why."""
    titles = {method.name: method.title for method in methods}
    return [
        f"{titles[name]} at {power(size)}: {one.reason}"
        for name, own in results.items()
        for size, one in own.items()
        if one.answer is None
    ]


def ratios(
    methods: Sequence[Method], sizes: Sequence[Fraction], results: Results, seconds: float
) -> str:
    """The multiples of the seconds of our best certificate that the other methods take; for a
    method that gave up, more than its limit.
    """
    parts = []
    for time in WORDS:
        rows = [(f"{WORDS[time]}: times ours", "worth", *(power(size) for size in sizes))]
        for method in (one for one in methods if one.worth in ("rigorous", "unchecked")):
            rows.append(
                (
                    method.title,
                    method.worth,
                    *(
                        _shown(ratio(methods, method, size, results, seconds, time))
                        for size in sizes
                    ),
                )
            )
        parts.append(plain(rows))
    return "\n\n".join(parts)


def _shown(found: tuple[float, bool] | None) -> str:
    return "-" if found is None else ("> " if found[1] else "") + number(found[0])


def ours(methods: Sequence[Method], size: Fraction, results: Results, time: Time) -> float | None:
    """The seconds of our best method whose certificate was checked; None if there is none."""
    times = [
        getattr(one, time)
        for method in methods
        if method.worth == "certificate"
        if (one := results.get(method.name, {}).get(size)) is not None and one.answer is not None
    ]
    return min(times, default=None)


def ratio(
    methods: Sequence[Method],
    method: Method,
    size: Fraction,
    results: Results,
    seconds: float,
    time: Time,
) -> tuple[float, bool] | None:
    """(the multiple of our seconds, whether it is more than that because the method gave up at this
    size or before); None if we have no answer ourselves.
    """
    base, own = ours(methods, size, results, time), results.get(method.name)
    if base is None or not own:
        return None
    one = own.get(size)
    if one is not None and one.answer is not None:
        return getattr(one, time) / base, False
    return seconds / base, True


@dataclass(frozen=True)
class Judged:
    """How often the aim was met against some peers, and where it was missed most (or met least)."""

    time: Time
    against: str
    aim: int
    met: int
    of: int
    least: float
    where: str

    def line(self) -> str:
        """The judgement in words."""
        held = "met" if self.met == self.of else "NOT met"
        aim = (
            f"{self.aim} times faster than {self.against}"
            if self.aim > 1
            else f"faster than {self.against}"
        )
        return (
            f"{WORDS[self.time]}: {aim}: {held}, at {self.met} of {self.of} widths; least"
            f" {number(self.least)} times, {self.where}"
        )


def judged(
    title: str,
    methods: Sequence[Method],
    sizes: Sequence[Fraction],
    results: Results,
    seconds: float,
) -> list[Judged]:
    """The aim judged by the measurements of this run: against all certified peers together, and
    against Z3 in each way of asking it, warm and cold.
    """
    found = []
    for time in WORDS:
        certified = [method for method in methods if method.peer and method.name in results]
        z3 = [
            method for method in methods if method.name.startswith("z3") and method.name in results
        ]
        every = f"every certified peer ({'; '.join(method.title for method in certified)})"
        for against, aim, peers in (
            (every, AIM, certified),
            *((one.title, 1, [one]) for one in z3),
        ):
            least = [
                min(
                    (
                        _times(methods, peer, size, results, seconds, time),
                        f"{title} at {power(size)}, by {peer.title}",
                    )
                    for peer in peers
                )
                for size in sizes
                if peers
            ]
            if least:
                found.append(
                    Judged(
                        time,
                        against,
                        aim,
                        sum(times >= aim for times, _ in least),
                        len(least),
                        *min(least),
                    )
                )
    return found


def _times(
    methods: Sequence[Method],
    peer: Method,
    size: Fraction,
    results: Results,
    seconds: float,
    time: Time,
) -> float:
    found = ratio(methods, peer, size, results, seconds, time)
    return found[0] if found else 0.0  # nothing of ours was certified


def together(judgements: Sequence[Judged]) -> list[Judged]:
    """The judgements on several questions, taken together."""
    kinds = dict.fromkeys((one.time, one.against, one.aim) for one in judgements)
    groups = [
        [one for one in judgements if (one.time, one.against, one.aim) == kind] for kind in kinds
    ]
    return [
        Judged(
            *kind,
            sum(one.met for one in group),
            sum(one.of for one in group),
            *min((one.least, one.where) for one in group),
        )
        for kind, group in zip(kinds, groups)
    ]


def slopes(methods: Sequence[Method], results: Results, of: str, inverse: bool) -> str:
    """The slope of log warm seconds against log size for each method, over the sizes that it
    answered.
    """
    rows = [("method", f"slope of seconds against {of}", "over")]
    for method in methods:
        own = [
            one
            for one in results.get(method.name, {}).values()
            if one.answer is not None and one.seconds
        ]
        sizes = [float(1 / one.size if inverse else one.size) for one in own]
        found = slope(sizes, [one.seconds for one in own if one.seconds])
        if found is not None:
            rows.append(
                (method.title, f"{found:.2f}", f"{power(own[0].size)} .. {power(own[-1].size)}")
            )
    return plain(rows)


def slope(sizes: Sequence[float], seconds: Sequence[float]) -> float | None:
    """The slope of the line through log seconds against log sizes, by least squares; None if there
    are not two sizes.

    >>> round(slope([1, 10, 100], [2.0, 20.0, 200.0]), 6)
    1.0
    """
    if len(set(sizes)) < 2:
        return None
    xs, ys = [math.log(size) for size in sizes], [math.log(one) for one in seconds]
    middle, level = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - middle) * (b - level) for a, b in zip(xs, ys)) / sum(
        (a - middle) ** 2 for a in xs
    )


# -------------------------------------------------------------------------------------------------
# The plot: error against seconds, both logarithmic, as SVG; matplotlib is optional.

LOOKS = {
    "certificate": ("o", "-"),
    "rigorous": ("s", "--"),
    "unchecked": ("^", ":"),
    "no proof": ("x", ":"),
}
FLOOR = 1e-20  # where an error of 0, or one below it, is drawn


def plot(title: str, methods: Sequence[Method], results: Results, truth: Fraction) -> bytes:
    """The plot: a line for each method, with its warm seconds across and its errors upwards; filled
    marks and full lines are certificates.
    """
    figure = new_figure()
    axes = figure.add_subplot()
    for method in methods:
        own = [
            one
            for one in results.get(method.name, {}).values()
            if one.answer is not None and one.seconds
        ]
        mark, line = LOOKS[method.worth]
        if own:
            errors = [
                max(float(one.answer.error(truth)), FLOOR) for one in own if one.answer is not None
            ]
            axes.loglog(
                [one.seconds or 0.0 for one in own],
                errors,
                marker=mark,
                linestyle=line,
                markersize=4,
                linewidth=1,
                label=f"{method.title} ({method.worth})",
            )
    axes.set(
        xlabel="seconds, warm, with check",
        ylabel=f"error (0 drawn at {FLOOR:.0e})",
        title=title,
    )
    axes.grid(True, which="major", linewidth=0.3)
    if axes.lines:
        figure.legend(loc="outside right upper", fontsize=7, frameon=False)
    return as_svg(figure)
