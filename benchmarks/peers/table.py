"""What the routes took, as text and as a plot: a table, ratios to ours, what is wrong."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from juggleproof.benchmarks.figures import as_svg, new_figure
from juggleproof.benchmarks.peers.routes import Problem, Result, Route
from juggleproof.reports.tables import plain


class Measured(NamedTuple):
    """What a route said of each statement, by name, and the CPU seconds of all its processes."""

    route: Route
    results: Mapping[str, Result]
    total: float

    def decided(self) -> dict[str, float]:
        """The statements that it decides, with their CPU seconds."""
        return {
            name: one.seconds
            for name, one in self.results.items()
            if one.answer.word in ("holds", "fails")
        }

    def taken(self) -> list[Result]:
        """The statements that it can be asked."""
        return [one for one in self.results.values() if one.answer.word != "not taken"]


def wrong(problems: Sequence[Problem], measured: Sequence[Measured]) -> list[str]:
    """One line for each answer that is not what the checker says of the stored certificate."""
    return [
        f"WRONG: {one.route.title} says of {problem.name}: {word}; the checker: {problem.outcome}"
        for one in measured
        for problem in problems
        if (word := one.results[problem.name].answer.word) in ("holds", "fails")
        and word != problem.outcome
    ]


def table(problems: Sequence[Problem], measured: Sequence[Measured]) -> str:
    """A row for each route."""
    heads = (
        "route",
        "taken",
        "decided",
        "wrong",
        "gave up",
        "median s",
        "most s",
        "sum s",
        "rest s",
    )
    rows = [(*heads, "to be believed")]
    for one in measured:
        seconds = [result.seconds for result in one.taken()]
        decided = one.decided()
        rows.append(
            (
                one.route.title,
                str(len(seconds)),
                str(len(decided)),
                str(len(wrong(problems, [one]))),
                str(len(seconds) - len(decided)),
                f"{statistics.median(seconds or [0.0]):.4f}",
                f"{max(seconds, default=0.0):.2f}",
                f"{sum(seconds):.2f}",
                f"{one.total - sum(seconds):.2f}",
                one.route.believed,
            )
        )
    return plain(rows)


def notes(measured: Sequence[Measured]) -> list[str]:
    """A line for each route: how it runs, what it does not take and why, what its proofs are."""
    lines = []
    for one in measured:
        counts = Counter(
            f"{'not taken: ' if word == 'not taken' else ''}{note}"
            for word, note in (result.answer for result in one.results.values())
            if note
        )
        parts = [one.route.how, *(f"{note} {count}" for note, count in sorted(counts.items()))]
        lines.append(f"{one.route.title}: {'; '.join(parts)}")
    return lines


def ratios(measured: Sequence[Measured], ours: Measured) -> str:
    """The CPU seconds of every other route as multiples of ours, over the statements that both
    decide: of the sums, and the median of the statements.
    """
    own = ours.decided()
    rows = [(f"times {ours.route.title}", "statements", "sum", "median")]
    for one in measured:
        peer = one.decided()
        both = peer.keys() & own.keys()
        if one is ours or not both:
            continue
        total = sum(peer[name] for name in both) / sum(own[name] for name in both)
        middle = statistics.median(peer[name] / own[name] for name in both)
        rows.append((one.route.title, str(len(both)), f"{total:.3g}", f"{middle:.3g}"))
    return plain(rows)


def plot(measured: Sequence[Measured]) -> bytes:
    """The cactus plot as SVG: how many statements each route decides within so many CPU seconds
    each.
    """
    figure = new_figure()
    axes = figure.add_subplot()
    for one in measured:
        seconds = sorted(one.decided().values())
        ours = one.route.ours
        axes.step(
            [max(each, 1e-4) for each in seconds],
            range(1, len(seconds) + 1),
            where="post",
            linestyle="-" if ours else "--",
            linewidth=1.8 if ours else 1.1,
            label=f"{one.route.title} ({len(seconds)})",
        )
    axes.set_xscale("log")
    axes.set(
        xlabel="CPU seconds for one statement (below 0.0001 drawn there)",
        ylabel="statements decided within them",
    )
    axes.set_ylim(bottom=0)
    axes.grid(True, which="major", linewidth=0.3)
    figure.legend(loc="outside lower center", ncols=3, fontsize=7, frameon=False)
    return as_svg(figure)
